//! A source of a plan's cases: a family, a mesh or a file, and what is known of it before a case is made.

mod cases;
mod names;

pub use names::{is_of_mesh, kind_of, words};

use super::corpus_set::CorpusSet;
use crate::arith::Float;
use crate::case::{Instance, Matrix, Parameters, Toward};
use crate::family::{Family, Grouping, LATTICE_SIZE, MeshFamily, Stratum};
use crate::mesh::{AimedPart, SceneMesh, Surface, Targets};
use crate::truth::Truth;
use std::sync::Arc;

/// Indices that go through a run together.
pub const CHUNK: u64 = 1024;

/// A source of cases.
#[derive(Clone)]
pub struct Source {
    /// The family, mesh or file behind them.
    pub stock: Stock,
    /// The parameters of its cases.
    pub parameters: Parameters,
    /// The seed of the set.
    pub seed: u64,
    /// How many indices; of a mesh's part, rays at each edge or vertex. What is taken whole has its own number.
    pub count: u64,
}

/// A family, a mesh or a file of cases.
#[derive(Clone)]
pub enum Stock {
    /// A family.
    Family(&'static Family),
    /// Every case of a finite family, in its natural order.
    Whole(&'static Family),
    /// Rays at a mesh.
    Mesh(Arc<MeshFamily>),
    /// Groups at the edges, or at the vertices, of a mesh, in the scalars of the run: a ray and the triangles around
    /// its target.
    MeshPart(Arc<Surface>, AimedPart),
    /// A stratum of the scene that a mesh is.
    SceneMesh(Arc<SceneMesh>, Stratum),
    /// Stored cases.
    Corpus(CorpusSet),
}

impl Source {
    /// So many cases of a family.
    pub fn of(family: &'static Family, parameters: Parameters, seed: u64, count: u64) -> Source {
        Source {
            stock: Stock::Family(family),
            parameters,
            seed,
            count,
        }
    }

    /// A stratum of a scene, or of the scene that a mesh is: its parameters get the mesh's digest.
    pub fn of_stratum(
        stratum: Stratum,
        mesh: Option<&Arc<SceneMesh>>,
        parameters: Parameters,
        seed: u64,
        count: u64,
    ) -> Source {
        let Some(mesh) = mesh else {
            return Source::of(stratum.family(), parameters, seed, count);
        };
        let digest = mesh.surface().mesh().digest.clone();
        let parameters = Parameters {
            mesh: Some(digest),
            ..parameters
        };
        Source {
            stock: Stock::SceneMesh(mesh.clone(), stratum),
            parameters,
            seed,
            count,
        }
    }

    /// Stored cases; a matrix puts their triangles somewhere.
    pub fn stored(set: CorpusSet, instance: Option<Matrix<f64>>) -> Source {
        let parameters = Parameters {
            instance,
            ..Parameters::default()
        };
        Source {
            stock: Stock::Corpus(set),
            parameters,
            seed: 0,
            count: 0,
        }
    }

    /// The same source with its triangles put somewhere.
    pub fn placed(mut self, matrix: Matrix<f64>) -> Source {
        self.parameters.instance = Some(matrix);
        self
    }

    /// Where its triangles are put, if not where they are.
    pub fn instance<F: Float>(&self) -> Option<Instance<F>> {
        self.parameters.instance_in()
    }

    /// The mesh that its rays are aimed at.
    fn mesh(&self) -> Option<&MeshFamily> {
        match &self.stock {
            Stock::Mesh(family) => Some(family),
            Stock::MeshPart(surface, _) => Some(surface.family()),
            Stock::SceneMesh(mesh, _) => Some(mesh.surface().family()),
            Stock::Family(_) | Stock::Whole(_) | Stock::Corpus(_) => None,
        }
    }

    /// The same stratum of a scene in the other kinds of planes and rays that it can have; none of other sources.
    pub fn in_other_kinds(&self) -> Vec<Source> {
        let (Stock::Family(family), Some(scene)) = (&self.stock, &self.parameters.scene) else {
            return Vec::new();
        };
        // Rays that are parallel to a triangle, or almost, go where that needs.
        let is_flat = [Stratum::Grazing, Stratum::Parallel]
            .map(|it| it.family().name)
            .contains(&family.name);
        let others = scene.of_all_kinds().into_iter().skip(1);
        let others = others.filter(|scene| !is_flat || scene.toward == Toward::Any);
        let of = |scene| {
            let mut other = self.clone();
            other.parameters.scene = Some(scene);
            other
        };
        others.map(of).collect()
    }

    /// The number of indices in a scalar.
    pub fn count<F: Float>(&self) -> u64 {
        match &self.stock {
            Stock::Whole(family) => family.size.unwrap_or(LATTICE_SIZE),
            Stock::Family(family) => family.size.map_or(self.count, |size| size.min(self.count)),
            Stock::Mesh(_) => self.count,
            Stock::MeshPart(_, part) => self
                .targets::<F>()
                .map_or(0, |targets| targets.count(*part) * self.count),
            Stock::SceneMesh(mesh, stratum) => mesh.count::<F>(*stratum, self.count),
            Stock::Corpus(set) if F::NAME == f32::NAME => set.f32.len() as u64,
            Stock::Corpus(set) => set.f64.len() as u64,
        }
    }

    /// Indices that go through a run together; of vertices fewer, which have more triangles.
    pub fn chunk(&self) -> u64 {
        match self.stock {
            Stock::MeshPart(_, AimedPart::Vertices) => CHUNK / 4,
            _ => CHUNK,
        }
    }

    /// The groups at the edges and at the vertices of a mesh, in some scalars; none of other sources.
    #[cfg(feature = "studies")]
    pub fn mesh_parts(&self, directions: u64, scalars: [bool; 2]) -> Vec<Source> {
        let Stock::Mesh(family) = &self.stock else {
            return Vec::new();
        };
        let surface = Arc::new(Surface::new(family.clone(), scalars));
        let parameters = &self.parameters;
        Source::parts_of(&surface, parameters, self.seed, directions).into()
    }

    /// The groups at the edges and at the vertices of a surface: so many rays at each.
    pub fn parts_of(
        surface: &Arc<Surface>,
        parameters: &Parameters,
        seed: u64,
        directions: u64,
    ) -> [Source; 2] {
        AimedPart::ALL.map(|part| Source {
            stock: Stock::MeshPart(surface.clone(), part),
            parameters: parameters.clone(),
            seed,
            count: directions,
        })
    }

    /// The edges and vertices of a mesh; none of other sources, or in another scalar.
    pub fn targets<F: Float>(&self) -> Option<Targets<'_>> {
        let Stock::MeshPart(surface, _) = &self.stock else {
            return None;
        };
        surface.targets::<F>(&self.parameters, self.seed)
    }

    /// How many polygons of its mesh's file are not in the mesh.
    pub fn left_out(&self) -> usize {
        self.mesh()
            .and_then(|family| family.mesh().left_out())
            .map_or(0, |note| note.count)
    }

    /// True if there are triangles around those of a group, which may have the hit that it lacks.
    pub fn has_neighbours(&self) -> bool {
        matches!(self.grouping(), Grouping::SharedEdge | Grouping::Fan)
    }

    /// True if its rates are those of a random sample, which has an interval; false if those of a whole set.
    pub fn is_sample(&self) -> bool {
        match &self.stock {
            Stock::Family(family) => family.size.is_none_or(|size| self.count < size),
            Stock::Mesh(_) | Stock::MeshPart(..) | Stock::SceneMesh(..) => true,
            Stock::Whole(_) | Stock::Corpus(_) => false,
        }
    }

    /// How the triangles of one index belong together.
    pub fn grouping(&self) -> Grouping {
        match &self.stock {
            Stock::Family(family) | Stock::Whole(family) => family.grouping,
            Stock::MeshPart(_, part) => part.grouping(),
            Stock::SceneMesh(_, stratum) => stratum.family().grouping,
            Stock::Corpus(set) if set.is_secondary => Grouping::SecondaryRay,
            Stock::Mesh(_) | Stock::Corpus(_) => Grouping::Single,
        }
    }

    /// True if the truths of an index keep the family's promise; it counts only if [`Source::promises`].
    pub fn keeps_promise(&self, truths: &[Truth]) -> bool {
        match &self.stock {
            Stock::Family(family) | Stock::Whole(family) => family.keeps(truths),
            _ => true,
        }
    }

    /// True if the parameters leave the promise standing.
    pub fn promises(&self) -> bool {
        let Parameters {
            scale, instance, ..
        } = &self.parameters;
        // Scaling can leave the range at either end.
        !matches!(self.stock, Stock::Family(_) | Stock::Whole(_))
            || self.keeps_truth() && *scale == 0 && instance.is_none()
    }

    /// True if the parameters do not change truths, except at the ends of the range.
    pub fn keeps_truth(&self) -> bool {
        self.parameters.keep_truth()
    }
}
