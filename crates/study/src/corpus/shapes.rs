//! Meshes that the project makes itself, from integers and IEEE + - * / and square roots only, so
//! that every machine makes the same ones.

use crate::case::Draw;
use std::collections::BTreeMap;

/// A mesh in memory: what [`write_obj`](super::mesh::write_obj) writes.
#[derive(Clone, Debug, PartialEq)]
pub struct MadeMesh {
    /// Lower-case letters: the name of its object and of its file.
    pub name: &'static str,
    /// A description in one line.
    pub about: &'static str,
    /// Positions, of any unit; every coordinate is an `f32` value.
    pub vertices: Vec<[f64; 3]>,
    /// For each face its vertices, counted from 0, counter-clockwise seen from the front.
    pub faces: Vec<Vec<u32>>,
}

/// All shapes, always the same.
pub fn all() -> Vec<MadeMesh> {
    vec![icosphere(), torus(), heightfield(), needles(), far()]
}

/// An OBJ file of what a [`MadeMesh`] cannot say: a closed house of quads and pentagons in four groups
/// (16 triangles), with negative indices, texture and normal indices and a continued line, and an
/// arrow head whose fan folds over (2 triangles).
pub const POLYGONS_OBJ: &str = "\
# A house of quads and pentagons, and a concave polygon.
mtllib none.mtl
o house
v 0 0 0
v 4 0 0
v 4 3 0
v 2 5 0
v 0 3 0
v 0 0 -6
v 4 0 -6
v 4 3 -6
v 2 5 -6
v 0 3 -6
vt 0 0
vn 1 0 0
g gables
usemtl plaster
s off
f 1 2 3 4 5
f -4 -5 -1 -2 -3
g floor
f 1 6 7 2
g sides
f 2//1 7//1 8//1 3//1
f 1/1/1 5/1/1 10/1/1 6/1/1
g roof
f 3/1 8/1 9/1 4/1
f 4 9 \\
  10 5
o arrow
v 10 -2 0
v 12 0 0
v 14 -2 0
v 12 3 0
f -4 -3 -2 -1
";

fn shape(
    name: &'static str,
    about: &'static str,
    mut vertices: Vec<[f64; 3]>,
    triangles: Vec<[u32; 3]>,
) -> MadeMesh {
    for coordinate in vertices.as_flattened_mut() {
        *coordinate = f64::from(*coordinate as f32);
    }
    MadeMesh { name, about, vertices, faces: triangles.into_iter().map(Vec::from).collect() }
}

fn icosphere() -> MadeMesh {
    let (vertices, triangles) = subdivided_icosahedron(3);
    shape("icosphere", "a closed unit sphere of 1,280 even triangles", vertices, triangles)
}

fn far() -> MadeMesh {
    let (mut vertices, triangles) = subdivided_icosahedron(1);
    for vertex in &mut vertices {
        let centre = [1e6, -2e6, 3e6];
        *vertex = std::array::from_fn(|axis| vertex[axis] + centre[axis]);
    }
    let about = "a closed ball of radius 1 at (1e6, -2e6, 3e6), where f32 steps by up to 1/4";
    shape("far", about, vertices, triangles)
}

/// A unit sphere from an icosahedron whose triangles are cut in four, `levels` times.
fn subdivided_icosahedron(levels: u32) -> (Vec<[f64; 3]>, Vec<[u32; 3]>) {
    let golden = (1.0 + 5f64.sqrt()) / 2.0;
    let mut vertices = Vec::new();
    for axis in 0..3 {
        for (one, phi) in [(-1.0, -golden), (1.0, -golden), (-1.0, golden), (1.0, golden)] {
            let mut vertex = [0.0; 3];
            (vertex[(axis + 1) % 3], vertex[(axis + 2) % 3]) = (one, phi);
            vertices.push(on_unit_sphere(vertex));
        }
    }
    // Three vertices make a face if they are 2 apart, before they are brought to the sphere.
    let near = |a: usize, b: usize| distance(&vertices[a], &vertices[b]) < 1.2;
    let mut triangles = Vec::new();
    for a in 0..12 {
        for b in a + 1..12 {
            for c in b + 1..12 {
                if near(a, b) && near(b, c) && near(c, a) {
                    let corners = [vertices[a], vertices[b], vertices[c]];
                    let [a, b, c] = [a, b, c].map(|vertex| vertex as u32);
                    triangles.push(if volume(corners) > 0.0 { [a, b, c] } else { [a, c, b] });
                }
            }
        }
    }
    for _ in 0..levels {
        let mut middles = BTreeMap::new();
        let mut middle = |a: u32, b: u32| {
            *middles.entry((a.min(b), a.max(b))).or_insert_with(|| {
                let [a, b] = [vertices[a as usize], vertices[b as usize]];
                // Addition commutes, so the order of a and b does not matter.
                vertices.push(on_unit_sphere(std::array::from_fn(|axis| a[axis] + b[axis])));
                vertices.len() as u32 - 1
            })
        };
        let quarters = |[a, b, c]: [u32; 3]| {
            let [ab, bc, ca] = [middle(a, b), middle(b, c), middle(c, a)];
            [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
        };
        triangles = triangles.into_iter().flat_map(quarters).collect();
    }
    (vertices, triangles)
}

fn on_unit_sphere(vertex: [f64; 3]) -> [f64; 3] {
    let length = distance(&vertex, &[0.0; 3]);
    vertex.map(|coordinate| coordinate / length)
}

fn distance(a: &[f64; 3], b: &[f64; 3]) -> f64 {
    let [x, y, z] = std::array::from_fn(|axis| a[axis] - b[axis]);
    (x * x + y * y + z * z).sqrt()
}

/// Six times the volume of the tetrahedron of three points and the origin.
fn volume([a, b, c]: [[f64; 3]; 3]) -> f64 {
    a[0] * (b[1] * c[2] - b[2] * c[1])
        + a[1] * (b[2] * c[0] - b[0] * c[2])
        + a[2] * (b[0] * c[1] - b[1] * c[0])
}

/// Points on the unit circle, counter-clockwise from (1, 0); their number is a multiple of four.
/// Rational in s = tan of half the angle, over a quarter, which is then turned without error.
fn circle(points: u32) -> Vec<[f64; 2]> {
    let quarter = points / 4;
    let turn = |[x, y]: [f64; 2], quarters: u32| match quarters {
        0 => [x, y],
        1 => [0.0 - y, x],
        2 => [0.0 - x, 0.0 - y],
        _ => [y, 0.0 - x],
    };
    let place = |point: u32| {
        let s = f64::from(point % quarter) / f64::from(quarter);
        let below = 1.0 + s * s;
        turn([(1.0 - s * s) / below, 2.0 * s / below], point / quarter)
    };
    (0..points).map(place).collect()
}

fn torus() -> MadeMesh {
    let (around, across) = (48, 24);
    let mut vertices = Vec::new();
    for [x, y] in circle(around) {
        for [out, up] in circle(across) {
            let radius = 2.0 + 0.75 * out;
            vertices.push([radius * x, radius * y, 0.75 * up]);
        }
    }
    let at = |i: u32, j: u32| i % around * across + j % across;
    let mut triangles = Vec::new();
    for i in 0..around {
        for j in 0..across {
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
    shape(
        "torus",
        "a closed torus of radii 2 and 3/4, 48 x 24 quads cut in two",
        vertices,
        triangles,
    )
}

fn heightfield() -> MadeMesh {
    const ROWS: u32 = 39;
    let half = |power: u32| 1.0 / f64::from(1u32 << power);
    let widths: Vec<f64> = (0..=12).chain((0..=12).rev()).map(half).collect();
    let columns = widths.len() as u32;
    let (mut vertices, mut x) = (Vec::new(), 0.0);
    for column in 0..=columns {
        let before = widths[column.saturating_sub(1) as usize];
        let after = widths[column.min(columns - 1) as usize];
        for row in 0..=ROWS {
            let index = column * (ROWS + 1) + row;
            let bump = Draw::new("heightfield", 0, index.into()).integer(0, 64) as f64 / 256.0;
            let shift = if is_shifted(column) { 1.0 / 16.0 } else { 0.0 };
            let y = f64::from(row) / 8.0 + shift;
            // A slope, and bumps that shrink with the width of the cells, so that narrow cells
            // stay narrow in space.
            vertices.push([x, y, y / 4.0 + bump * before.min(after)]);
        }
        x += after;
    }
    let at = |column: u32, row: u32| column * (ROWS + 1) + row;
    let mut triangles = Vec::new();
    for column in 0..columns {
        for row in 0..ROWS {
            let [a, b] = [at(column, row), at(column + 1, row)];
            let [c, d] = [b + 1, a + 1];
            // Between columns of which one is shifted, the shorter diagonal leaves two caps.
            triangles.extend(if is_shifted(column + 1) {
                [[a, b, d], [b, c, d]]
            } else {
                [[a, b, c], [a, c, d]]
            });
        }
    }
    let about = "an open height field whose cells narrow to 2^-12: 2,028 triangles, many needles \
                 and caps";
    shape("heightfield", about, vertices, triangles)
}

/// True if the vertices of a column lie half a row further up: two columns in four.
fn is_shifted(column: u32) -> bool {
    column & 2 != 0
}

fn needles() -> MadeMesh {
    let rim = circle(1000);
    let mut vertices = vec![[0.0; 3]];
    vertices.extend(rim.iter().map(|[x, y]| [*x, *y, (x * x - y * y) / 32.0]));
    let spokes = rim.len() as u32;
    let triangles = (0..spokes).map(|i| [0, 1 + i, 1 + (i + 1) % spokes]).collect();
    shape("needles", "a saddle-shaped disc of 1,000 needles around one vertex", vertices, triangles)
}

#[cfg(test)]
mod tests {
    use super::super::mesh::{Mesh, read_obj, write_obj};
    use super::*;
    use std::collections::BTreeSet;

    fn written(shape: &MadeMesh) -> Vec<u8> {
        let mut text = Vec::new();
        write_obj(shape, &mut text).unwrap();
        text
    }

    fn read(text: &[u8]) -> Mesh {
        read_obj(text, "shape.obj", &mut |_| {}).unwrap()
    }

    /// Directed edges that lack their reverse; none may occur twice.
    fn open_edges(triangles: &[[u32; 3]]) -> Vec<(u32, u32)> {
        let mut edges = BTreeSet::new();
        for [a, b, c] in triangles {
            for edge in [(*a, *b), (*b, *c), (*c, *a)] {
                assert!(edges.insert(edge), "the edge {edge:?} occurs twice");
            }
        }
        edges.iter().filter(|(a, b)| !edges.contains(&(*b, *a))).copied().collect()
    }

    /// Longest edge by altitude on it, and shortest edge by longest.
    fn slenderness(corners: [[f64; 3]; 3]) -> (f64, f64) {
        let [a, b, c] = corners;
        let sides = [distance(&a, &b), distance(&b, &c), distance(&c, &a)];
        let longest = sides.iter().copied().fold(0.0, f64::max);
        let shortest = sides.iter().copied().fold(f64::MAX, f64::min);
        let half = (sides[0] + sides[1] + sides[2]) / 2.0;
        let area = (half * (half - sides[0]) * (half - sides[1]) * (half - sides[2])).sqrt();
        (longest * longest / (2.0 * area), shortest / longest)
    }

    #[test]
    fn shapes_are_the_same_on_every_machine() {
        let found: Vec<String> = all()
            .iter()
            .map(|shape| format!("{} {}", shape.name, read(&written(shape)).digest))
            .chain([format!("polygons {}", read(POLYGONS_OBJ.as_bytes()).digest)])
            .collect();
        let expected = [
            "icosphere 5bc56b8aeb0c90c3",
            "torus 0ec207d2aeabcfda",
            "heightfield 7957c95c13e190ca",
            "needles 631fdc6a79a30b35",
            "far 5050ce53d9c1ee33",
            "polygons 438e2f2c69b8c30a",
        ];
        assert_eq!(found, expected);
    }

    #[test]
    fn shapes_read_back_as_they_were() {
        for shape in all() {
            let mesh = read(&written(&shape));
            assert_eq!(mesh.positions_f64.len(), shape.vertices.len());
            for (read, made) in
                mesh.positions_f64.as_flattened().iter().zip(shape.vertices.as_flattened())
            {
                assert_eq!(read.to_bits(), made.to_bits());
            }
            for (narrow, made) in
                mesh.positions_f32.as_flattened().iter().zip(shape.vertices.as_flattened())
            {
                assert_eq!(f64::from(*narrow).to_bits(), made.to_bits(), "{}", shape.name);
            }
            let triangles: Vec<Vec<u32>> = mesh.triangles.iter().map(|t| t.to_vec()).collect();
            assert_eq!(triangles, shape.faces);
            assert_eq!((mesh.groups, mesh.notes), (1, vec![]), "{}", shape.name);
        }
    }

    #[test]
    fn closed_shapes_are_closed_and_face_outwards() {
        for shape in all() {
            let mesh = read(&written(&shape));
            let open = open_edges(&mesh.triangles).len();
            match shape.name {
                "heightfield" => assert_eq!(open, 2 * (26 + 39)),
                "needles" => assert_eq!(open, 1000),
                _ => assert_eq!(open, 0, "{}", shape.name),
            }
            if open == 0 {
                let origin = mesh.vertices::<f64>(0)[0];
                let volumes = (0..mesh.triangles.len()).map(|triangle| {
                    volume(
                        mesh.vertices::<f64>(triangle)
                            .map(|corner| std::array::from_fn(|axis| corner[axis] - origin[axis])),
                    ) / 6.0
                });
                let total: f64 = volumes.sum();
                assert!((3.0..30.0).contains(&total), "{} has volume {total}", shape.name);
            }
        }
        let house = read(POLYGONS_OBJ.as_bytes());
        // The arrow lies by itself.
        assert_eq!(open_edges(&house.triangles).len(), 4);
        assert_eq!((house.triangles.len(), house.groups, house.notes.len()), (18, 5, 0));
    }

    #[test]
    fn shapes_have_the_triangles_they_promise() {
        let count = |name: &str| {
            all().iter().find(|shape| shape.name == name).map(|shape| shape.faces.len())
        };
        let names = ["icosphere", "torus", "heightfield", "needles", "far"];
        assert_eq!(names.map(count), [1280, 2304, 2028, 1000, 80].map(Some));
    }

    #[test]
    fn needles_are_needles_and_the_height_field_has_caps_too() {
        let slender = |shape: MadeMesh| -> Vec<(f64, f64)> {
            let mesh = read(&written(&shape));
            (0..mesh.triangles.len()).map(|i| slenderness(mesh.vertices::<f64>(i))).collect()
        };
        assert!(slender(needles()).iter().all(|(ratio, _)| *ratio > 100.0));
        let field = slender(heightfield());
        let needles = field.iter().filter(|(ratio, sides)| *ratio > 100.0 && *sides < 0.01).count();
        let caps = field.iter().filter(|(ratio, sides)| *ratio > 100.0 && *sides > 0.4).count();
        // Six strips of 78 triangles, every other one of needles.
        assert_eq!((needles, caps), (234, 234));
        let worst = field.iter().map(|(ratio, _)| *ratio).fold(0.0, f64::max);
        assert!(worst > 500.0, "{worst}");
    }
}
