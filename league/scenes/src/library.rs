//! The libraries, in one table.

use crate::{bvh, obvhs, parry3d};

/// A mesh and a ray as files have them. All numbers are floats of f32, so libraries that compute in f32 get them exactly.
pub struct Mesh {
    pub vertices: Vec<[f64; 3]>,
    pub faces: Vec<[u32; 3]>,
}

impl Mesh {
    /// The vertices of a face.
    pub fn triangle(&self, face: u32) -> [[f64; 3]; 3] {
        self.faces[face as usize].map(|vertex| self.vertices[vertex as usize])
    }
}

/// An origin and a direction.
pub type Line = [[f64; 3]; 2];

/// A nearest face and its t, in units of the direction's length.
pub type Answer = Option<(u32, f64)>;

pub struct Library {
    pub name: &'static str,
    pub version: &'static str,
    /// What it computes in.
    pub scalar: &'static str,
    pub answers: fn(&Mesh, &[Line]) -> Vec<Answer>,
}

pub const LIBRARIES: &[Library] = &[
    parry3d::IN_F32,
    parry3d::IN_F64,
    bvh::IN_F32,
    bvh::IN_F64,
    obvhs::BVH2,
    obvhs::CWBVH,
];

/// A point or a direction in f32.
pub fn in_f32(point: [f64; 3]) -> [f32; 3] {
    point.map(|x| x as f32)
}
