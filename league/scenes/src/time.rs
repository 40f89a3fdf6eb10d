//! The time of hairline-scene's exact nearest hit, on one thread.

use crate::library::{Line, Mesh, in_f32};
use hairline_scene::{Ray, Scene};
use std::hint::black_box;
use std::time::Instant;

/// Microseconds a ray in f32: the least of three runs over all rays.
pub fn microseconds(mesh: &Mesh, rays: &[Line]) -> Result<f64, String> {
    let vertices: Vec<[f32; 3]> = mesh.vertices.iter().copied().map(in_f32).collect();
    let scene = Scene::new(&vertices, &mesh.faces).map_err(|error| error.to_string())?;
    let rays: Vec<Ray<f32>> = rays
        .iter()
        .map(|[o, d]| Ray::new(in_f32(*o), in_f32(*d)))
        .collect();
    let run = |_| {
        let start = Instant::now();
        for ray in &rays {
            drop(black_box(scene.nearest(ray)));
        }
        start.elapsed().as_secs_f64() * 1e6 / rays.len() as f64
    };
    Ok((0..3).map(run).fold(f64::INFINITY, f64::min))
}
