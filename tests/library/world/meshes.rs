//! The second world's meshes: level ground, a bumpy sphere, a room of boxes, and a scan of uneven triangles.

use super::dice::Dice;
use super::exact::{Point, cross, length, minus, plus, unit};
use std::collections::{BTreeMap, HashMap};

/// A mesh, and where rays start that look at it.
pub struct Mesh {
    pub name: &'static str,
    pub faces: Vec<[Point; 3]>,
    /// The edges with two faces.
    pub edges: Vec<Edge>,
    /// The vertices inside closed fans.
    pub fans: Vec<Fan>,
    /// Two opposite corners of the box from which rays start.
    pub air: [Point; 2],
    /// The same for all three coordinates.
    pub center: f64,
    pub extent: f64,
    /// The word for planes that are not parallel to two axes.
    pub ground: &'static str,
}

/// The ends of an edge, and its faces.
type Edge = ([Point; 2], Vec<usize>);

/// A vertex, and its faces.
type Fan = (Point, Vec<usize>);

/// A mesh whose coordinates are rounded as a function says.
type Make = fn(fn(f64) -> f64) -> Mesh;

/// In the order of the tests.
pub const MESHES: [Make; 5] = [field, sphere, room, loft, scan];

fn bits(point: Point) -> [u64; 3] {
    // Adding 0 makes -0 and 0 one.
    point.map(|x| (x + 0.0).to_bits())
}

impl Mesh {
    fn new(name: &'static str, faces: Vec<[Point; 3]>, round: fn(f64) -> f64) -> Mesh {
        // Files begin a triangle with any of its corners.
        let mut dice = Dice::new(faces.len() as u64);
        let turned = |face: [Point; 3]| {
            let first = dice.one_of(3);
            [0, 1, 2].map(|i| face[(first + i) % 3].map(round))
        };
        let faces: Vec<[Point; 3]> = faces.into_iter().map(turned).collect();
        let mut of_edges = BTreeMap::<[[u64; 3]; 2], Edge>::new();
        let mut of_vertices = HashMap::<[u64; 3], Fan>::new();
        let mut order = Vec::new();
        for (i, face) in faces.iter().enumerate() {
            assert!(0.0 < length(cross(minus(face[1], face[0]), minus(face[2], face[0]))));
            for k in 0..3 {
                let (from, to) = (face[k], face[(k + 1) % 3]);
                let mut ends = [bits(from), bits(to)];
                ends.sort();
                of_edges
                    .entry(ends)
                    .or_insert(([from, to], Vec::new()))
                    .1
                    .push(i);
                let of_vertex = of_vertices.entry(bits(from)).or_insert_with(|| {
                    order.push(bits(from));
                    (from, Vec::new())
                });
                of_vertex.1.push(i);
            }
        }
        // A fan is closed if each edge at its vertex has two faces.
        let rims: Vec<[u64; 3]> = of_edges
            .iter()
            .filter(|(_, (_, faces))| faces.len() != 2)
            .flat_map(|(ends, _)| *ends)
            .collect();
        let fans = order.iter().filter(|vertex| !rims.contains(vertex));
        let fans = fans.map(|vertex| of_vertices[vertex].clone()).collect();
        let edges = of_edges
            .into_values()
            .filter(|(_, faces)| faces.len() == 2)
            .collect();
        let all = || faces.iter().flatten().flatten().copied();
        let (low, high) = (
            all().fold(f64::MAX, f64::min),
            all().fold(f64::MIN, f64::max),
        );
        let air = [[low; 3], [high; 3]];
        let extent = high.max(-low);
        Mesh {
            name,
            faces,
            edges,
            fans,
            air,
            center: 0.0,
            extent,
            ground: "generic",
        }
    }
}

/// Both halves of a quadrangle.
fn halves([p, q, r, s]: [Point; 4]) -> [[Point; 3]; 2] {
    [[p, q, r], [r, s, p]]
}

/// Hummocks on a square kilometre, up to 40 cm high, in squares of 20 m whose diagonals alternate.
fn field(round: fn(f64) -> f64) -> Mesh {
    let height = |x: f64, z: f64| {
        0.1 * (x / 31.0).sin() * (z / 23.0).cos()
            + 0.07 * (x / 11.0 + z / 17.0).sin()
            + 0.2 * ((x * 12.9898 + z * 78.233).sin() * 43758.5453).fract()
    };
    let corner = |i: i32, k: i32| {
        let (x, z) = (f64::from(i) * 20.0 - 500.0, f64::from(k) * 20.0 - 500.0);
        [x, height(x, z), z]
    };
    let squares = (0..50).flat_map(|i| (0..50).map(move |k| (i, k)));
    let faces = squares.flat_map(|(i, k)| {
        let square = [
            corner(i, k),
            corner(i, k + 1),
            corner(i + 1, k + 1),
            corner(i + 1, k),
        ];
        let [p, q, r, s] = square;
        halves(if (i + k) % 2 == 0 {
            [p, q, r, s]
        } else {
            [q, r, s, p]
        })
    });
    let mesh = Mesh::new("field", faces.collect(), round);
    Mesh {
        air: [[-500.0, 0.5, -500.0], [500.0, 800.0, 500.0]],
        ground: "terrain",
        ..mesh
    }
}

/// An octahedron, each of its faces cut into 24 by 24, blown up to a sphere of radius about 1 with dents; 0 is near
/// its surface.
fn sphere(round: fn(f64) -> f64) -> Mesh {
    const CUTS: i32 = 24;
    let blown = |p: Point| {
        let [x, y, z] = unit(p);
        let radius =
            1.0 + 0.06 * (5.0 * x).sin() * (4.0 * y + 1.0).cos() + 0.04 * (7.0 * z + 2.0 * x).sin();
        [x * radius + 0.6, y * radius - 0.5, z * radius + 0.55]
    };
    let mut faces = Vec::new();
    for octant in 0..8 {
        let side = |axis: i32| if octant >> axis & 1 == 0 { 1.0 } else { -1.0 };
        let (x, y, z) = (
            [side(0), 0.0, 0.0],
            [0.0, side(1), 0.0],
            [0.0, 0.0, side(2)],
        );
        let corner = |i: i32, k: i32| {
            let [i, k, rest] = [i, k, CUTS - i - k].map(|n| f64::from(n) / f64::from(CUTS));
            blown(plus(plus(x.map(|c| c * rest), y, i), z, k))
        };
        let mut add = |p: Point, q: Point, r: Point| {
            let is_outside = 0.0 < side(0) * side(1) * side(2);
            faces.push(if is_outside { [p, q, r] } else { [r, q, p] });
        };
        for i in 0..CUTS {
            for k in 0..CUTS - i {
                add(corner(i, k), corner(i + 1, k), corner(i, k + 1));
                if i + k + 1 < CUTS {
                    add(corner(i + 1, k), corner(i + 1, k + 1), corner(i, k + 1));
                }
            }
        }
    }
    let mesh = Mesh::new("sphere", faces, round);
    Mesh {
        air: [[-2.0; 3], [2.0; 3]],
        ..mesh
    }
}

/// Cuts a box's faces along all planes of a list for each axis; faces point out of the box.
fn add_box(faces: &mut Vec<[Point; 3]>, cuts: [&[f64]; 3], is_inside_out: bool) {
    for axis in 0..3 {
        let (j, k) = ((axis + 1) % 3, (axis + 2) % 3);
        for (at, is_far) in [
            (cuts[axis][0], false),
            (cuts[axis][cuts[axis].len() - 1], true),
        ] {
            for of_j in cuts[j].windows(2) {
                for of_k in cuts[k].windows(2) {
                    let corner = |x: f64, y: f64| {
                        let mut p = [at; 3];
                        (p[j], p[k]) = (x, y);
                        p
                    };
                    let mut square = [
                        corner(of_j[0], of_k[0]),
                        corner(of_j[1], of_k[0]),
                        corner(of_j[1], of_k[1]),
                        corner(of_j[0], of_k[1]),
                    ];
                    if is_far == is_inside_out {
                        square.reverse();
                    }
                    faces.extend(halves(square));
                }
            }
        }
    }
}

/// A room of 8 m by 6 m in centimetres, with its floor at height 0, boxes, and carpets that are almost as low.
fn room(round: fn(f64) -> f64) -> Mesh {
    let mut faces = Vec::new();
    let even = |low: f64, high: f64, parts: i32| -> Vec<f64> {
        (0..=parts)
            .map(|i| low + (high - low) * f64::from(i) / f64::from(parts))
            .collect()
    };
    // Its faces look into the room.
    let (x, y, z) = (
        even(-400.0, 400.0, 9),
        even(0.0, 275.0, 4),
        even(-300.0, 300.0, 7),
    );
    add_box(&mut faces, [&x, &y, &z], true);
    let mut dice = Dice::new(7);
    for _ in 0..24 {
        let low = [
            dice.between(-390.0, 300.0),
            dice.between(5.0, 200.0),
            dice.between(-290.0, 200.0),
        ];
        let of_axis =
            |i: usize, dice: &mut Dice| even(low[i], low[i] + dice.between(20.0, 70.0), 2);
        let [x, y, z] = [0, 1, 2].map(|i| of_axis(i, &mut dice));
        add_box(&mut faces, [&x, &y, &z], false);
    }
    for height in [0.0006, 0.002, 0.007, 0.02, 0.07, 0.2] {
        let (x, z) = (dice.between(-390.0, 200.0), dice.between(-290.0, 100.0));
        let (x, z) = (even(x, x + 180.0, 3), even(z, z + 150.0, 3));
        for of_x in x.windows(2) {
            for of_z in z.windows(2) {
                let corner = |i: usize, k: usize| [of_x[i], height, of_z[k]];
                faces.extend(halves([
                    corner(0, 0),
                    corner(0, 1),
                    corner(1, 1),
                    corner(1, 0),
                ]));
            }
        }
    }
    let mesh = Mesh::new("room", faces, round);
    Mesh {
        air: [[-399.0, 1.0, -299.0], [399.0, 274.0, 299.0]],
        ..mesh
    }
}

/// The same room with uneven triangles: corners are moved along the planes on which all their faces lie.
fn loft(round: fn(f64) -> f64) -> Mesh {
    let room = room(round);
    let mut dice = Dice::new(9);
    let mut moved = HashMap::<[u64; 3], Point>::new();
    for (vertex, faces) in &room.fans {
        let all = || faces.iter().flat_map(|face| room.faces[*face]);
        let is_flat = |axis: usize| all().all(|corner| corner[axis] == vertex[axis]);
        if let Some(flat) = (0..3).find(|axis| is_flat(*axis)) {
            let nearest = all()
                .map(|corner| length(minus(corner, *vertex)))
                .filter(|way| 0.0 < *way);
            let reach = 0.25 * nearest.fold(f64::MAX, f64::min);
            let mut to = *vertex;
            (0..3)
                .filter(|axis| *axis != flat)
                .for_each(|axis| to[axis] += dice.between(-reach, reach));
            moved.insert(bits(*vertex), to);
        }
    }
    let faces = room
        .faces
        .iter()
        .map(|face| face.map(|p| *moved.get(&bits(p)).unwrap_or(&p)));
    let mesh = Mesh::new("loft", faces.collect(), round);
    Mesh {
        air: room.air,
        ..mesh
    }
}

/// A bust of 30 cm, a metre away from 0 along each axis, as a scanner sees it: rings of points that are moved at random,
/// ever fewer toward its poles, with the shorter diagonals.
fn scan(round: fn(f64) -> f64) -> Mesh {
    let mut dice = Dice::new(3);
    let (rings, around) = (60, 80);
    let mut point = |ring: i32, place: i32| {
        let along = (f64::from(ring) + 1.0 + dice.between(-0.3, 0.3)) / f64::from(rings + 1);
        let turn = (f64::from(place) + dice.between(-0.3, 0.3)) / f64::from(around);
        let (height, turn) = ((1.0 - 2.0 * along) * 0.15, turn * std::f64::consts::TAU);
        let bulge = 1.0 + 0.2 * (3.0 * turn).sin() * (20.0 * height).cos();
        let radius = 0.14 * (4.0 * along * (1.0 - along)).sqrt() * bulge;
        [
            1.0 + radius * turn.cos(),
            1.0 + height,
            1.0 + radius * turn.sin(),
        ]
    };
    let points: Vec<Vec<Point>> = (0..rings)
        .map(|ring| (0..around).map(|place| point(ring, place)).collect())
        .collect();
    let mut faces = Vec::new();
    for (upper, lower) in points.iter().zip(&points[1..]) {
        for place in 0..around as usize {
            let next = (place + 1) % around as usize;
            let [p, q, r, s] = [upper[place], upper[next], lower[next], lower[place]];
            let is_first = length(minus(p, r)) < length(minus(q, s));
            faces.extend(halves(if is_first { [p, q, r, s] } else { [q, r, s, p] }));
        }
    }
    let mesh = Mesh::new("scan", faces, round);
    Mesh {
        air: [[0.5; 3], [1.5; 3]],
        center: 1.0,
        extent: 0.2,
        ..mesh
    }
}
