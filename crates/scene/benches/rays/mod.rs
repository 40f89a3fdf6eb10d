//! The kinds of rays of the bench.

use crate::meshes::{Mesh, on_grid};
use hairline_core::case::Draw;

/// An origin and a direction.
pub type Line = [[f64; 3]; 2];

type Maker = fn(&mut Draw, &Mesh) -> Line;

/// The name of a kind, its rays, and the ratio to the plain kernel that the project sets itself.
pub const KINDS: [(&str, Maker, f64); 6] = [
    ("random", random, 1.25),
    ("vertex", vertex, 2.0),
    ("edge", edge, 2.0),
    ("axis", axis, 2.0),
    ("in plane", in_plane, 2.0),
    ("grazing", grazing, 2.0),
];

fn ray(origin: [f64; 3], target: [f64; 3]) -> Line {
    [origin, [0, 1, 2].map(|i| target[i] - origin[i])]
}

/// A point at some distance from the origin.
fn around(draw: &mut Draw, distance: f64) -> [f64; 3] {
    loop {
        let point: [f64; 3] = draw.point();
        let length = point.iter().map(|x| x * x).sum::<f64>().sqrt();
        if 0.1 < length && length < 1.0 {
            return point.map(|x| on_grid(x * distance / length));
        }
    }
}

fn random(draw: &mut Draw, _: &Mesh) -> Line {
    let target = [(); 3].map(|()| 2.0 * draw.unit() - 1.0);
    ray(around(draw, 3.5), target)
}

fn vertex(draw: &mut Draw, mesh: &Mesh) -> Line {
    let [a, ..] = mesh.face(draw);
    ray(around(draw, 2.0), a)
}

fn edge(draw: &mut Draw, mesh: &Mesh) -> Line {
    let [a, b, _] = mesh.face(draw);
    let middle = [0, 1, 2].map(|i| (a[i] + b[i]) / 2.0);
    ray(around(draw, 2.0), middle)
}

fn axis(draw: &mut Draw, _: &Mesh) -> Line {
    let [x, y] = [(); 2].map(|()| (draw.integer(-512, 512) as f64) / 512.0);
    ray([x, y, 2.0], [x, y, 1.0])
}

/// In the plane of a face, exactly, and through it.
fn in_plane(draw: &mut Draw, mesh: &Mesh) -> Line {
    let [a, b, c] = mesh.face(draw);
    let [k, l] = [(); 2].map(|()| (2 * draw.integer(-8, 8) + 1) as f64);
    let at = |k: f64, l: f64| [0, 1, 2].map(|i| a[i] + k * (b[i] - a[i]) + l * (c[i] - a[i]));
    ray(at(k, l), at(0.25, 0.5))
}

/// In the plane of a face but for rounding, and through it.
fn grazing(draw: &mut Draw, mesh: &Mesh) -> Line {
    let [a, b, c] = mesh.face(draw);
    let [k, l, m, n] = [(); 4].map(|()| draw.unit());
    let at = |k: f64, l: f64| [0, 1, 2].map(|i| a[i] + k * (b[i] - a[i]) + l * (c[i] - a[i]));
    ray(at(3.0 + 37.0 * k, 3.0 + 37.0 * l), at(0.45 * m, 0.45 * n))
}
