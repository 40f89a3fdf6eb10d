//! The cost of the exact nearest hit: `cargo bench -p hairline-scene [-- MESH]`.
//!
//! Microseconds a ray on one thread. `plain` is Möller and Trumbore in `f64` over the same tree in the same run, without
//! any bound; the figure to watch is the exact nearest hit over it. Meshes and rays lie on the grid 2^-18, so that rays
//! meet vertices, edges and planes exactly. Turned, they fill all bits of `f64`, and rays miss their aims by roundings.

mod meshes;
mod rays;

use hairline_core::Float;
use hairline_core::case::Draw;
use hairline_scene::{Ray, Scene, Triangle};
use meshes::{Mesh, icosphere, soup, terrain, turned};
use rays::KINDS;
use std::hint::black_box;
use std::time::Instant;

const RAYS: usize = 20_000;

/// The nearest face and its t, as a renderer would have them.
fn plain<F: Float>(scene: &Scene<F>, ray: &Ray<F>) -> Option<(u32, f64)> {
    let (o, d) = (ray.origin.map(F::to_f64), ray.direction.map(F::to_f64));
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

fn scene_of<F: Float>(mesh: &Mesh) -> Scene<F> {
    let vertices = mesh.vertices.iter().map(|vertex| vertex.map(F::from_f64));
    Scene::new(&vertices.collect::<Vec<_>>(), &mesh.faces).expect("a mesh")
}

fn lines<F: Float>(name: &str, mesh: &Mesh) {
    let start = Instant::now();
    let scene = scene_of::<F>(mesh);
    println!(
        "{name}: {} faces, built in {:.2} s",
        mesh.faces.len(),
        start.elapsed().as_secs_f64()
    );
    for (kind, make, aim) in KINDS {
        let mut draw = Draw::new(kind, 1, 0);
        let rays = (0..RAYS).map(|_| make(&mut draw, mesh));
        let rays = rays.map(|[o, d]| Ray::new(o.map(F::from_f64), d.map(F::from_f64)));
        let rays: Vec<Ray<F>> = rays.collect();
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
    let scene = scene_of::<f32>(mesh);
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
    let start = Instant::now();
    black_box(scene.locate(anywhere[0]).ok());
    println!(
        "points, µs each ({} faces found closed in {:.2} s):",
        mesh.faces.len(),
        start.elapsed().as_secs_f64()
    );
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
    let flat = scene_of(&meshes::flat(316));
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
    let fan = scene_of(&meshes::fan(1000));
    let at_fan = |i: i32| Ray::new([0.5, at(i), 1.0], [-0.5, -at(i), -1.0]);
    line("1000 faces at a vertex", &fan, &rays(&at_fan));
    let shrinking = scene_of(&meshes::shrinking(1000));
    let at_shrinking = |i: i32| Ray::new([0.5, at(i) + 0.002, 1.0], [-0.5, -at(i) - 0.002, -1.0]);
    line("sizes from 1 to 2^-60", &shrinking, &rays(&at_shrinking));
}

fn main() {
    let chosen = std::env::args()
        .skip(1)
        .find(|word| !word.starts_with("--"));
    let is_chosen = |name| chosen.as_deref().is_none_or(|chosen| chosen == name);
    if is_chosen("icosphere") {
        lines::<f32>("icosphere", &icosphere(6));
    }
    if is_chosen("terrain") {
        lines::<f32>("terrain", &terrain(224));
    }
    if is_chosen("soup") {
        lines::<f32>("soup", &soup(100_000));
    }
    if is_chosen("turned") {
        lines::<f64>("icosphere, turned", &turned(icosphere(6)));
        lines::<f64>("terrain, turned", &turned(terrain(224)));
    }
    if is_chosen("points") {
        points(&icosphere(6));
    }
    // Only if it is asked for: 10^7 faces.
    if chosen.as_deref() == Some("large") {
        lines::<f32>("large", &terrain(2236));
    }
    if is_chosen("crowds") {
        crowds();
    }
}
