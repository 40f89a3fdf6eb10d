//! obvhs 0.4.0: `Bvh2::ray_traverse` and `CwBvh::ray_traverse` with `Triangle::intersect`, as its examples do it. "Traverse
//! the bvh for a given `Ray`. Returns the closest intersected primitive."

use crate::library::{Answer, Library, Line, Mesh, in_f32};
use glam::Vec3A;
use obvhs::BvhBuildParams;
use obvhs::bvh2::builder::build_bvh2_from_tris;
use obvhs::cwbvh::builder::build_cwbvh_from_tris;
use obvhs::ray::{Ray, RayHit};
use obvhs::triangle::Triangle;
use std::time::Duration;

pub const BVH2: Library = Library {
    name: "obvhs",
    version: "0.4.0",
    scalar: "f32",
    answers: in_bvh2,
};

pub const CWBVH: Library = Library {
    name: "obvhs-cwbvh",
    answers: in_cwbvh,
    ..BVH2
};

fn in_bvh2(mesh: &Mesh, rays: &[Line]) -> Vec<Answer> {
    let triangles = triangles(mesh);
    let took = &mut Duration::default();
    let tree = build_bvh2_from_tris(&triangles, BvhBuildParams::medium_build(), took);
    let face = |place: u32| tree.primitive_indices[place as usize];
    let answer = |line: &Line| {
        let mut hit = RayHit::none();
        let test = |ray: &Ray, place: usize| triangles[face(place as u32) as usize].intersect(ray);
        let is_hit = tree.ray_traverse(ray(line), &mut hit, test);
        is_hit.then(|| (face(hit.primitive_id), f64::from(hit.t)))
    };
    rays.iter().map(answer).collect()
}

fn in_cwbvh(mesh: &Mesh, rays: &[Line]) -> Vec<Answer> {
    let triangles = triangles(mesh);
    let took = &mut Duration::default();
    let tree = build_cwbvh_from_tris(&triangles, BvhBuildParams::medium_build(), took);
    let face = |place: u32| tree.primitive_indices[place as usize];
    let answer = |line: &Line| {
        let mut hit = RayHit::none();
        let test = |ray: &Ray, place: usize| triangles[face(place as u32) as usize].intersect(ray);
        let is_hit = tree.ray_traverse(ray(line), &mut hit, test);
        is_hit.then(|| (face(hit.primitive_id), f64::from(hit.t)))
    };
    rays.iter().map(answer).collect()
}

fn triangles(mesh: &Mesh) -> Vec<Triangle> {
    let faces = 0..mesh.faces.len() as u32;
    let triangle = |face| {
        let [v0, v1, v2] = mesh.triangle(face).map(|point| Vec3A::from(in_f32(point)));
        Triangle { v0, v1, v2 }
    };
    faces.map(triangle).collect()
}

fn ray(line: &Line) -> Ray {
    let [origin, direction] = line.map(|point| Vec3A::from(in_f32(point)));
    Ray::new_inf(origin, direction)
}
