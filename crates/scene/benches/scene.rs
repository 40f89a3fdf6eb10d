//! The cost of the exact nearest hit: `cargo bench -p hairline-scene [-- MESH]`.
//!
//! Microseconds a ray on one thread. `plain` is Möller and Trumbore in `f64` over the same tree in the same run, without
//! any bound; the figure to watch is the exact nearest hit over it. Meshes and rays lie on the grid 2^-18, so that rays
//! meet vertices, edges and planes exactly.

mod meshes;

use hairline_core::case::Draw;
use hairline_scene::{Ray, Scene, Triangle};
use meshes::{Mesh, icosphere, on_grid, soup, terrain};
use std::hint::black_box;
use std::time::Instant;

const RAYS: usize = 20_000;

type Maker = fn(&mut Draw, &Mesh) -> Ray<f32>;

const KINDS: [(&str, Maker, f64); 6] = [
    ("random", random, 1.25),
    ("vertex", vertex, 2.0),
    ("edge", edge, 2.0),
    ("axis", axis, 2.0),
    ("in plane", in_plane, 2.0),
    ("grazing", grazing, 2.0),
];

fn ray(origin: [f64; 3], target: [f64; 3]) -> Ray<f32> {
    let direction = [0, 1, 2].map(|i| target[i] - origin[i]);
    Ray::new(origin.map(|x| x as f32), direction.map(|x| x as f32))
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

fn random(draw: &mut Draw, _: &Mesh) -> Ray<f32> {
    let target = [(); 3].map(|()| 2.0 * draw.unit() - 1.0);
    ray(around(draw, 3.5), target)
}

fn vertex(draw: &mut Draw, mesh: &Mesh) -> Ray<f32> {
    let [a, ..] = mesh.face(draw);
    ray(around(draw, 2.0), a)
}

fn edge(draw: &mut Draw, mesh: &Mesh) -> Ray<f32> {
    let [a, b, _] = mesh.face(draw);
    let middle = [0, 1, 2].map(|i| (a[i] + b[i]) / 2.0);
    ray(around(draw, 2.0), middle)
}

fn axis(draw: &mut Draw, _: &Mesh) -> Ray<f32> {
    let [x, y] = [(); 2].map(|()| (draw.integer(-512, 512) as f64) / 512.0);
    ray([x, y, 2.0], [x, y, 1.0])
}

/// In the plane of a face, exactly, and through it.
fn in_plane(draw: &mut Draw, mesh: &Mesh) -> Ray<f32> {
    let [a, b, c] = mesh.face(draw);
    let [k, l] = [(); 2].map(|()| (2 * draw.integer(-8, 8) + 1) as f64);
    let at = |k: f64, l: f64| [0, 1, 2].map(|i| a[i] + k * (b[i] - a[i]) + l * (c[i] - a[i]));
    ray(at(k, l), at(0.25, 0.5))
}

/// In the plane of a face but for rounding, and through it.
fn grazing(draw: &mut Draw, mesh: &Mesh) -> Ray<f32> {
    let [a, b, c] = mesh.face(draw);
    let [k, l, m, n] = [(); 4].map(|()| draw.unit());
    let at = |k: f64, l: f64| [0, 1, 2].map(|i| a[i] + k * (b[i] - a[i]) + l * (c[i] - a[i]));
    ray(at(3.0 + 37.0 * k, 3.0 + 37.0 * l), at(0.45 * m, 0.45 * n))
}

/// The nearest face and its t, as a renderer would have them.
fn plain(scene: &Scene<f32>, ray: &Ray<f32>) -> Option<(u32, f64)> {
    let (o, d) = (ray.origin.map(f64::from), ray.direction.map(f64::from));
    let mut least = f64::INFINITY;
    let mut nearest = None;
    let visited = scene.visit(ray, |face, triangle| {
        let t = moller_trumbore(o, d, triangle)?;
        if t < 0.0 || least <= t {
            return None;
        }
        least = t;
        nearest = Some((face, t));
        nearest.map(|(_, t)| t)
    });
    visited.ok()?;
    nearest
}

#[inline(always)]
fn moller_trumbore(o: [f64; 3], d: [f64; 3], [a, b, c]: &Triangle<f64>) -> Option<f64> {
    let minus = |p: &[f64; 3], q: &[f64; 3]| [p[0] - q[0], p[1] - q[1], p[2] - q[2]];
    let dot = |p: &[f64; 3], q: &[f64; 3]| p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
    let cross = |p: &[f64; 3], q: &[f64; 3]| {
        [
            p[1] * q[2] - p[2] * q[1],
            p[2] * q[0] - p[0] * q[2],
            p[0] * q[1] - p[1] * q[0],
        ]
    };
    let (e, f) = (minus(b, a), minus(c, a));
    let p = cross(&d, &f);
    let determinant = dot(&e, &p);
    if determinant == 0.0 {
        return None;
    }
    let inverse = 1.0 / determinant;
    let s = minus(&o, a);
    let u = dot(&s, &p) * inverse;
    if !(0.0..=1.0).contains(&u) {
        return None;
    }
    let q = cross(&s, &e);
    let v = dot(&d, &q) * inverse;
    (0.0 <= v && u + v <= 1.0).then(|| dot(&f, &q) * inverse)
}

type Work<'a, T> = &'a mut dyn FnMut(&[T]);

/// Microseconds a ray. Rays come in small groups and each group's least time of several runs counts, so that other programs
/// on the machine disturb little.
fn microseconds<T, const N: usize>(rays: &[T], mut work: [Work<T>; N]) -> [f64; N] {
    let mut sums = [0.0; N];
    for group in rays.chunks(500) {
        let mut least = [f64::INFINITY; N];
        for _ in 0..7 {
            for (work, least) in work.iter_mut().zip(&mut least) {
                let start = Instant::now();
                work(group);
                *least = least.min(start.elapsed().as_secs_f64());
            }
        }
        for (sum, least) in sums.iter_mut().zip(least) {
            *sum += least;
        }
    }
    sums.map(|sum| sum * 1e6 / rays.len() as f64)
}

fn lines(name: &str, mesh: &Mesh) {
    let start = Instant::now();
    let scene = Scene::new(&mesh.vertices, &mesh.faces).expect("a mesh");
    println!(
        "{name}: {} faces, built in {:.2} s",
        mesh.faces.len(),
        start.elapsed().as_secs_f64()
    );
    for (kind, make, aim) in KINDS {
        let mut draw = Draw::new(kind, 1, 0);
        let rays: Vec<Ray<f32>> = (0..RAYS).map(|_| make(&mut draw, mesh)).collect();
        let hit = rays.iter().filter(|ray| plain(&scene, ray).is_some());
        let share = 100.0 * hit.count() as f64 / RAYS as f64;
        let [plain, nearest, all] = microseconds(
            &rays,
            [
                &mut |rays| {
                    rays.iter().for_each(|ray| {
                        black_box(plain(&scene, ray));
                    })
                },
                &mut |rays| {
                    rays.iter()
                        .for_each(|ray| drop(black_box(scene.nearest(ray))))
                },
                &mut |rays| rays.iter().for_each(|ray| drop(black_box(scene.hits(ray)))),
            ],
        );
        println!(
            "  {kind:9} plain {plain:6.2}  nearest {nearest:6.2}  all {all:6.2}  nearest/plain {:5.2} (aim {aim})  hit {share:.0} %",
            nearest / plain,
        );
    }
}

/// Points inside and outside, at vertices, and near the surface.
fn points(mesh: &Mesh) {
    let scene = Scene::new(&mesh.vertices, &mesh.faces).expect("a mesh");
    let mut draw = Draw::new("points", 1, 0);
    let mut anywhere = Vec::new();
    let mut near = Vec::new();
    let mut vertices = Vec::new();
    for _ in 0..2000 {
        anywhere.push([(); 3].map(|()| (2.0 * draw.unit() - 1.0) as f32));
        let [a, b, c] = mesh.face(&mut draw);
        let factor = 1.0 + 1e-7 * (draw.unit() - 0.5);
        near.push([0, 1, 2].map(|i| (factor * (a[i] + b[i] + c[i]) / 3.0) as f32));
        vertices.push(a.map(|x| x as f32));
    }
    // The edges are compared once, at the first point.
    black_box(scene.locate(anywhere[0]).ok());
    println!("points, µs each:");
    for (name, points) in [
        ("anywhere", anywhere),
        ("near the surface", near),
        ("vertices", vertices),
    ] {
        let [time] = microseconds(
            &points,
            [&mut |points: &[[f32; 3]]| {
                points
                    .iter()
                    .for_each(|point| drop(black_box(scene.locate(*point))))
            }],
        );
        println!("  {name:16} {time:.2}");
    }
}

/// Scenes in which a ray meets very many faces: microseconds a face that is met.
fn crowds() {
    let line = |name: &str, scene: &Scene<f32>, rays: &[Ray<f32>]| {
        let all = rays.iter().filter_map(|ray| scene.hits(ray).ok());
        let met: usize = all.flatten().map(|hit| hit.faces.len()).sum();
        let [nearest, hits] = microseconds(
            rays,
            [
                &mut |rays| {
                    rays.iter()
                        .for_each(|ray| drop(black_box(scene.nearest(ray))))
                },
                &mut |rays| rays.iter().for_each(|ray| drop(black_box(scene.hits(ray)))),
            ],
        );
        let met = met as f64 / rays.len() as f64;
        println!(
            "  {name:24} {met:5.0} faces met, nearest {:.2}, all {:.2}",
            nearest / met,
            hits / met
        );
    };
    println!("crowds, µs a face that is met:");
    let at = |i: i32| i as f32 / 256.0;
    let flat = meshes::flat(316);
    let flat = Scene::new(&flat.vertices, &flat.faces).expect("a mesh");
    let along = |y: f32, slope: f32| Ray::new([-1.0, y, 0.0], [1.0, slope, 0.0]);
    let rays = |make: &dyn Fn(i32) -> Ray<f32>| (0..100).map(make).collect::<Vec<_>>();
    line(
        "in a plane, on its lines",
        &flat,
        &rays(&|i| along(i as f32, 0.0)),
    );
    line(
        "in a plane, beside them",
        &flat,
        &rays(&|i| along(i as f32 + 0.25, 0.0)),
    );
    line(
        "in a plane, slanted",
        &flat,
        &rays(&|i| along(i as f32 + 0.25, 0.375)),
    );
    let vertices = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.1]];
    let copies = Scene::new(&vertices, &[[0, 1, 2]; 1000]).expect("a mesh");
    let at_copies = |i: i32| Ray::new([0.1, 0.1 + at(i), 1.0], [0.01, 0.02, -1.0]);
    line("1000 copies of a face", &copies, &rays(&at_copies));
    let fan = meshes::fan(1000);
    let fan = Scene::new(&fan.vertices, &fan.faces).expect("a mesh");
    let at_fan = |i: i32| Ray::new([0.5, at(i), 1.0], [-0.5, -at(i), -1.0]);
    line("1000 faces at a vertex", &fan, &rays(&at_fan));
    let shrinking = meshes::shrinking(1000);
    let shrinking = Scene::new(&shrinking.vertices, &shrinking.faces).expect("a mesh");
    let at_shrinking = |i: i32| Ray::new([0.5, at(i) + 0.002, 1.0], [-0.5, -at(i) - 0.002, -1.0]);
    line("sizes from 1 to 2^-60", &shrinking, &rays(&at_shrinking));
}

fn main() {
    let chosen = std::env::args()
        .skip(1)
        .find(|word| !word.starts_with("--"));
    let is_chosen = |name| chosen.as_deref().is_none_or(|chosen| chosen == name);
    if is_chosen("icosphere") {
        lines("icosphere", &icosphere(6));
    }
    if is_chosen("terrain") {
        lines("terrain", &terrain(224));
    }
    if is_chosen("soup") {
        lines("soup", &soup(100_000));
    }
    if is_chosen("points") {
        points(&icosphere(6));
    }
    // Only if it is asked for: 10^7 faces.
    if chosen.as_deref() == Some("large") {
        lines("large", &terrain(2236));
    }
    if is_chosen("crowds") {
        crowds();
    }
}
