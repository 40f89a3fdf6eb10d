//! Closed surfaces with small integer coordinates, and their windings from solid angles (van Oosterom and Strackee 1983).

use hairline_scene::{Scene, Triangle};

pub type Faces = Vec<Triangle<f64>>;

/// A box with faces that show their front to the outside.
pub fn cuboid(low: [f64; 3], high: [f64; 3]) -> Faces {
    let corner = |k: usize| [0, 1, 2].map(|axis| [low, high][k >> axis & 1][axis]);
    let faces = [
        [0, 2, 3],
        [0, 3, 1],
        [4, 5, 7],
        [4, 7, 6],
        [0, 1, 5],
        [0, 5, 4],
        [2, 6, 7],
        [2, 7, 3],
        [0, 4, 6],
        [0, 6, 2],
        [1, 3, 7],
        [1, 7, 5],
    ];
    faces.map(|face| face.map(corner)).to_vec()
}

pub fn cube() -> Faces {
    cuboid([-2.0; 3], [2.0; 3])
}

pub fn octahedron() -> Faces {
    let mut faces = Faces::new();
    for k in 0..8 {
        let sign = |axis: usize| if k >> axis & 1 == 0 { 2.0 } else { -2.0 };
        let (x, y, z) = (
            [sign(0), 0.0, 0.0],
            [0.0, sign(1), 0.0],
            [0.0, 0.0, sign(2)],
        );
        let is_positive = 0.0 < sign(0) * sign(1) * sign(2);
        faces.push(if is_positive { [x, y, z] } else { [x, z, y] });
    }
    faces
}

/// The cube with one face cut at the middle of an edge. The slit is exactly closed, with or without a face in it.
pub fn cut_cube(has_filled_slit: bool) -> Faces {
    let mut faces = cube();
    let [a, b, c] = faces.remove(0);
    let middle = [0, 1, 2].map(|i| (a[i] + b[i]) / 2.0);
    faces.push([a, middle, c]);
    faces.push([middle, b, c]);
    if has_filled_slit {
        faces.push([a, b, middle]);
    }
    faces
}

/// Closed surfaces with every coincidence: T-junctions, common walls, overlaps, repeated faces.
pub fn solids() -> Vec<(&'static str, Faces)> {
    let joined = |parts: &[Faces]| parts.concat();
    vec![
        ("cube", cube()),
        ("octahedron", octahedron()),
        ("T-junction with a face in it", cut_cube(true)),
        ("T-junction", cut_cube(false)),
        (
            "common wall",
            joined(&[cube(), cuboid([2.0, -2.0, -2.0], [4.0, 2.0, 2.0])]),
        ),
        (
            "part of a wall",
            joined(&[cube(), cuboid([2.0, -1.0, -2.0], [4.0, 1.0, 1.0])]),
        ),
        (
            "overlap",
            joined(&[cube(), cuboid([0.0, -1.0, -1.0], [5.0, 3.0, 3.0])]),
        ),
        (
            "common edge",
            joined(&[cube(), cuboid([2.0, 2.0, -2.0], [4.0, 4.0, 2.0])]),
        ),
        (
            "common vertex",
            joined(&[cube(), cuboid([2.0; 3], [4.0; 3])]),
        ),
        ("twice", joined(&[cube(), cube()])),
        ("three", joined(&[cube(), octahedron(), octahedron()])),
        (
            "hole",
            joined(&[
                cube(),
                cuboid([-1.0; 3], [1.0; 3])
                    .into_iter()
                    .map(turned)
                    .collect(),
            ]),
        ),
    ]
}

/// The face with its front behind.
pub fn turned([a, b, c]: Triangle<f64>) -> Triangle<f64> {
    [a, c, b]
}

/// A scene in which no two faces share a vertex by its number.
pub fn scene(faces: &[Triangle<f64>]) -> Scene<f64> {
    let vertices: Vec<[f64; 3]> = faces.iter().flatten().copied().collect();
    let numbers = (0..faces.len() as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]);
    Scene::new(&vertices, &numbers.collect::<Vec<_>>()).unwrap()
}

/// The winding number around a point off the surface.
pub fn winding(faces: &[Triangle<f64>], point: [f64; 3]) -> i64 {
    let mut angles = 0.0;
    for face in faces {
        let [a, b, c] = face.map(|vertex| [0, 1, 2].map(|i| vertex[i] - point[i]));
        let [x, y, z] = [&a, &b, &c].map(|vertex| dot(vertex, vertex).sqrt());
        let volume = dot(&a, &cross(&b, &c));
        let size = x * y * z + dot(&a, &b) * z + dot(&b, &c) * x + dot(&c, &a) * y;
        angles += 2.0 * volume.atan2(size);
    }
    let winding = angles / (4.0 * std::f64::consts::PI);
    assert!((winding - winding.round()).abs() < 1e-6, "{winding}");
    winding.round() as i64
}

fn dot(a: &[f64; 3], b: &[f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: &[f64; 3], b: &[f64; 3]) -> [f64; 3] {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}
