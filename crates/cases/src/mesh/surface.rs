//! A mesh with what it is in each scalar: the source of the rays at its edges and vertices.

use super::rays::{AimedPart, Targets, VERSION};
use super::topology::Topology;
use crate::arith::Float;
use crate::case::{CaseId, Parameters};
use crate::family::MeshFamily;
use crate::files::mesh::Mesh;
use std::sync::Arc;

/// A mesh and its topology in `f32`, in `f64` or in both.
pub struct Surface {
    family: Arc<MeshFamily>,
    topologies: [Option<Topology>; 2],
}

impl Surface {
    /// In the chosen scalars.
    #[cfg(feature = "studies")]
    pub fn new(family: Arc<MeshFamily>, scalars: [bool; 2]) -> Surface {
        let mesh = family.mesh();
        let f32 = scalars[0].then(|| Topology::of::<f32>(mesh));
        let f64 = scalars[1].then(|| Topology::of::<f64>(mesh));
        Surface {
            family,
            topologies: [f32, f64],
        }
    }

    /// The mesh and where it comes from.
    pub fn family(&self) -> &MeshFamily {
        &self.family
    }

    /// The mesh.
    pub fn mesh(&self) -> &Mesh {
        self.family.mesh()
    }

    /// The topology of the mesh in a scalar; none if the scalar was not chosen.
    pub fn topology<F: Float>(&self) -> Option<&Topology> {
        self.topologies[usize::from(F::NAME == f64::NAME)].as_ref()
    }

    /// The edges and vertices that rays are aimed at; none if the scalar was not chosen.
    pub fn targets<'m, F: Float>(
        &'m self,
        parameters: &'m Parameters,
        seed: u64,
    ) -> Option<Targets<'m>> {
        Some(Targets::new(
            self.mesh(),
            self.topology::<F>()?,
            parameters,
            seed,
        ))
    }

    /// The id of an index; it holds the mesh's digest.
    pub fn id<F: Float>(
        &self,
        part: AimedPart,
        parameters: &Parameters,
        seed: u64,
        index: u64,
    ) -> CaseId {
        self.family
            .id_of::<F>((part.name(), VERSION), parameters, seed, index)
    }
}
