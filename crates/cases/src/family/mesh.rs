//! `mesh`: rays at the edges, vertices and faces of a mesh: near, and exact where such a ray exists on
//! the float grid. The oracle tells which are; reports give the share.

use super::boundary::{middle, nudged, toward};
use super::control::{combination, interior_weights};
use super::drawn_interval::draw_interval;
use super::{Grouping, apply, id_of};
use crate::arith::Float;
use crate::case::{Case, CaseId, Draw, Parameters};
use crate::files::mesh::Mesh;
use std::slice;

const NAME: &str = "mesh";
const VERSION: u32 = 2;

/// A mesh as a source of cases.
pub struct MeshFamily {
    mesh: Mesh,
    path: String,
}

impl MeshFamily {
    /// The family of a mesh read from a path. The mesh has triangles.
    pub fn new(mesh: Mesh, path: &str) -> MeshFamily {
        MeshFamily {
            mesh,
            path: path.to_owned(),
        }
    }

    /// The mesh.
    pub fn mesh(&self) -> &Mesh {
        &self.mesh
    }

    /// The path as the user gave it.
    pub fn path(&self) -> &str {
        &self.path
    }

    /// The last part of the path.
    pub fn file_name(&self) -> &str {
        self.path.rsplit(['/', '\\']).next().unwrap_or(&self.path)
    }

    /// The id of a case; it holds the mesh's digest.
    pub fn id<F: Float>(&self, parameters: &Parameters, seed: u64, index: u64) -> CaseId {
        self.id_of::<F>((NAME, VERSION), parameters, seed, index)
    }

    /// The id of a case that another family makes of this mesh.
    pub(crate) fn id_of<F: Float>(
        &self,
        family: (&str, u32),
        parameters: &Parameters,
        seed: u64,
        index: u64,
    ) -> CaseId {
        let mut with_mesh = parameters.clone();
        with_mesh.mesh = Some(self.mesh.digest.clone());
        id_of::<F>(family, with_mesh, seed, index)
    }

    /// Case `index` of the set of a seed.
    pub fn make<F: Float>(&self, parameters: &Parameters, seed: u64, index: u64) -> Case<F> {
        let mut draw = Draw::new(NAME, seed, index);
        let number = draw.below(self.mesh.triangles.len());
        let triangle = self.mesh.vertices::<F>(number);
        let target = target(&mut draw, triangle);
        let (origin, direction) = if draw.coin() {
            ray_through(&mut draw, target)
        } else {
            near_ray(&mut draw, target, triangle)
        };
        let mut case = Case::new(origin, direction, triangle);
        apply(parameters, &mut case);
        draw_interval(Grouping::Single, &mut draw, slice::from_mut(&mut case));
        case
    }
}

/// A vertex, a point of an edge (its middle, if that is a float) or a point of the face.
fn target<F: Float>(draw: &mut Draw, triangle: [[F; 3]; 3]) -> [F; 3] {
    let corner = draw.below(3);
    let p = triangle[corner];
    let q = triangle[(corner + 1) % 3];
    match draw.below(4) {
        0 => p,
        1 => middle(p, q),
        2 => {
            let s = F::from_f64(0.0625 + 0.875 * draw.unit());
            std::array::from_fn(|axis| p[axis] + (q[axis] - p[axis]) * s)
        }
        _ => {
            let weights = interior_weights(draw).map(F::from_f64);
            combination(triangle, weights)
        }
    }
}

/// A ray whose point at t = 1 is the target exactly: each coordinate of the direction is a multiple
/// of the target's ulp, smaller than the target and of its sign, so that the origin is a float.
fn ray_through<F: Float>(draw: &mut Draw, target: [F; 3]) -> ([F; 3], [F; 3]) {
    let size = positive_or_one(extent(target, [F::zero(); 3]));
    let direction = target.map(|x| {
        if x.is_zero() || !x.is_finite() {
            // Any float will do: the origin is its negative.
            let share = 2.0 * draw.unit() - 1.0;
            return F::from_f64(share * size);
        }
        let ulps = draw.integer(1, 1 << (F::DIGITS - 2)) as f64;
        let step = x.ulp() * F::from_f64(ulps);
        if x.is_sign_negative() { -step } else { step }
    });
    let origin = toward(direction, target);
    (origin, direction)
}

/// A ray from about the triangle's size away, aimed at the target and nudged by ulps.
fn near_ray<F: Float>(draw: &mut Draw, target: [F; 3], [a, b, c]: [[F; 3]; 3]) -> ([F; 3], [F; 3]) {
    let longest = extent(a, b).max(extent(b, c)).max(extent(c, a));
    let size = positive_or_one(longest);
    let distance = F::from_f64(size * (0.5 + 7.5 * draw.unit()));
    let away = draw.point::<F>();
    let origin = std::array::from_fn(|axis| target[axis] + away[axis] * distance);
    let ulps = draw.pick(&[0, 0, 1, 4]);
    let direction = nudged(draw, toward(origin, target), ulps);
    (origin, direction)
}

/// The largest difference between two points along an axis.
fn extent<F: Float>(p: [F; 3], q: [F; 3]) -> f64 {
    let mut largest: f64 = 0.0;
    for axis in 0..3 {
        let difference = p[axis].to_f64() - q[axis].to_f64();
        largest = largest.max(difference.abs());
    }
    largest
}

/// A size, or 1 in place of 0.
fn positive_or_one(size: f64) -> f64 {
    if 0.0 < size { size } else { 1.0 }
}
