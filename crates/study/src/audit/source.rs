//! Where a plan's cases come from, by index.

use super::corpus_set::CorpusSet;
use super::row::quoted;
use crate::arith::Float;
use crate::case::{Case, Instance, Matrix, Parameters, Ray, SceneKind, Toward};
use crate::family::{Family, Grouping, LATTICE_SIZE, Made, MeshFamily, Stratum};
use crate::kernel::Scalar;
use crate::mesh::{Part, SceneMesh, Surface, Targets};
use crate::oracle::{self, Layers};
use crate::truth::Truth;
use std::sync::Arc;

/// Indices that go through a run together.
pub const CHUNK: u64 = 1024;

/// A source of cases.
#[derive(Clone)]
pub enum Source {
    /// A family's set.
    Family {
        /// The family.
        family: &'static Family,
        /// The parameters of its cases.
        parameters: Parameters,
        /// The seed of the set.
        seed: u64,
        /// How many indices.
        count: u64,
        /// Every case of a finite family, in its natural order.
        exhaustive: bool,
    },
    /// Rays at a mesh.
    Mesh {
        /// The mesh and its rays.
        family: Arc<MeshFamily>,
        /// The parameters of its cases.
        parameters: Parameters,
        /// The seed of the set.
        seed: u64,
        /// How many indices.
        count: u64,
    },
    /// Groups at the edges, or at the vertices, of a mesh: a ray and the triangles around its target.
    MeshPart {
        /// The mesh, in the scalars of the run.
        surface: Arc<Surface>,
        /// Edges or vertices.
        part: Part,
        /// The parameters of its cases.
        parameters: Parameters,
        /// The seed of the set.
        seed: u64,
        /// Rays at each edge or vertex.
        directions: u64,
    },
    /// A stratum of the scene that a mesh is.
    SceneMesh {
        /// The mesh.
        mesh: Arc<SceneMesh>,
        /// Which rays.
        stratum: Stratum,
        /// The mesh's digest, and what rays there are.
        parameters: Parameters,
        /// The seed of the set.
        seed: u64,
        /// How many indices.
        count: u64,
    },
    /// Stored cases.
    Corpus(CorpusSet),
}

/// True if a source of this name in tables makes its cases from a mesh.
pub fn is_of_mesh(name: &str) -> bool {
    name.split_once(':').is_some_and(|(kind, file)| {
        kind == "mesh"
            || Part::named(kind).is_some()
            || Stratum::named(kind).is_some() && SceneKind::named(file).is_none()
    })
}

/// The kind of planes and rays of the scene whose source has this name in tables; the generic one of other sources.
pub fn kind_of(name: &str) -> SceneKind {
    let kind = name.split_once(':').and_then(|(_, kind)| SceneKind::named(kind));
    kind.unwrap_or(SceneKind::ALL[0])
}

/// A matrix as `--instance` takes it.
pub fn words(matrix: &Matrix<f64>) -> String {
    matrix.as_flattened().iter().map(f64::to_string).collect::<Vec<_>>().join(" ")
}

impl Source {
    /// A stratum of a scene, or of the scene that a mesh is: its parameters get the mesh's digest.
    pub fn of_stratum(
        stratum: Stratum,
        mesh: Option<&Arc<SceneMesh>>,
        parameters: Parameters,
        seed: u64,
        count: u64,
    ) -> Source {
        let Some(mesh) = mesh else {
            let family = stratum.family();
            return Source::Family { family, parameters, seed, count, exhaustive: false };
        };
        let digest = mesh.surface().mesh().digest.clone();
        let parameters = Parameters { mesh: Some(digest), ..parameters };
        Source::SceneMesh { mesh: mesh.clone(), stratum, parameters, seed, count }
    }

    /// The same source with its triangles put somewhere.
    pub fn placed(mut self, matrix: Matrix<f64>) -> Source {
        let instance = match &mut self {
            Source::Family { parameters, .. }
            | Source::Mesh { parameters, .. }
            | Source::MeshPart { parameters, .. }
            | Source::SceneMesh { parameters, .. } => &mut parameters.instance,
            Source::Corpus(set) => &mut set.instance,
        };
        *instance = Some(matrix);
        self
    }

    /// Where its triangles are put, if not where they are.
    pub fn instance<F: Float>(&self) -> Option<Instance<F>> {
        match self {
            Source::Corpus(set) => Instance::new(set.instance?.map(|row| row.map(F::from_f64))),
            _ => self.parameters()?.instance_in(),
        }
    }

    /// The parameters of cases that are made.
    fn parameters(&self) -> Option<&Parameters> {
        match self {
            Source::Family { parameters, .. }
            | Source::Mesh { parameters, .. }
            | Source::MeshPart { parameters, .. }
            | Source::SceneMesh { parameters, .. } => Some(parameters),
            Source::Corpus(_) => None,
        }
    }

    /// The truths of cases that it makes, which become those that kernels get: of an instance the ray by the rounded
    /// inverse.
    pub fn ask<F: Float>(
        &self,
        cases: &mut [Case<F>],
        truths: &mut Vec<Truth>,
        layers: &mut Layers,
    ) {
        let Some(instance) = self.instance() else {
            return oracle::truths(cases, truths, layers);
        };
        oracle::truths_of_instance(cases, &instance, truths, layers);
        cases.iter_mut().for_each(|case| *case = instance.in_object(case));
    }

    /// A case that it makes, as kernels get it.
    pub fn seen<F: Float>(&self, case: &Case<F>) -> Case<F> {
        self.instance().map_or(*case, |instance| instance.in_object(case))
    }

    /// The same stratum of a scene in the other kinds of planes and rays that it can have; none of other sources.
    pub fn in_other_kinds(&self) -> Vec<Source> {
        let Source::Family { family, parameters, seed, count, exhaustive } = self else {
            return Vec::new();
        };
        let Some(scene) = &parameters.scene else { return Vec::new() };
        // Rays that are parallel to a triangle, or almost, go where that needs.
        let is_flat =
            [Stratum::Grazing, Stratum::Parallel].map(|it| it.family().name).contains(&family.name);
        let others = scene.of_all_kinds().into_iter().skip(1);
        let others = others.filter(|scene| !is_flat || scene.toward == Toward::Any);
        let of = |scene| Source::Family {
            family,
            parameters: Parameters { scene: Some(scene), ..parameters.clone() },
            seed: *seed,
            count: *count,
            exhaustive: *exhaustive,
        };
        others.map(of).collect()
    }

    /// The name in tables: one line, whatever a file is called.
    pub fn name(&self) -> String {
        let name = match self {
            Source::Family { family, parameters, .. } => match &parameters.scene {
                Some(scene) if scene.kind() != SceneKind::ALL[0] => {
                    format!("{}:{}", family.name, scene.kind())
                }
                _ => family.name.to_owned(),
            },
            Source::Mesh { family, .. } => format!("mesh:{}", family.file_name()),
            Source::MeshPart { surface, part, .. } => {
                format!("{}:{}", part.name(), surface.file_name())
            }
            Source::SceneMesh { mesh, stratum, .. } => {
                format!("{}:{}", stratum.family().name, mesh.surface().file_name())
            }
            Source::Corpus(set) if set.is_secondary => format!("corpus-secondary:{}", set.file),
            Source::Corpus(set) => format!("corpus:{}", set.file),
        };
        let shown = |c: char| match c.is_control() {
            true => c.escape_default().to_string(),
            false => c.to_string(),
        };
        name.chars().map(shown).collect()
    }

    /// The number of indices in a scalar.
    pub fn count<F: Float>(&self) -> u64 {
        match self {
            Source::Family { exhaustive: true, family, .. } => family.size.unwrap_or(LATTICE_SIZE),
            Source::Family { family, count, .. } => {
                family.size.map_or(*count, |size| size.min(*count))
            }
            Source::Mesh { count, .. } => *count,
            Source::MeshPart { part, directions, .. } => {
                self.targets::<F>().map_or(0, |targets| targets.count(*part) * directions)
            }
            Source::SceneMesh { mesh, stratum, count, .. } => mesh.count::<F>(*stratum, *count),
            Source::Corpus(set) if F::NAME == f32::NAME => set.f32.len() as u64,
            Source::Corpus(set) => set.f64.len() as u64,
        }
    }

    /// Indices that go through a run together; of vertices fewer, which have more triangles.
    pub fn chunk(&self) -> u64 {
        match self {
            Source::MeshPart { part: Part::Vertices, .. } => CHUNK / 4,
            _ => CHUNK,
        }
    }

    /// The groups at the edges and at the vertices of a mesh, in some scalars; none of other sources.
    #[cfg(feature = "studies")]
    pub fn mesh_parts(&self, directions: u64, scalars: [bool; 2]) -> Vec<Source> {
        let Source::Mesh { family, parameters, seed, .. } = self else { return Vec::new() };
        let surface = Arc::new(Surface::new(family.clone(), scalars));
        let of = |part| Source::MeshPart {
            surface: surface.clone(),
            part,
            parameters: parameters.clone(),
            seed: *seed,
            directions,
        };
        Part::ALL.map(of).into()
    }

    /// The edges and vertices of a mesh; none of other sources, or in another scalar.
    fn targets<F: Float>(&self) -> Option<Targets<'_>> {
        let Source::MeshPart { surface, parameters, seed, .. } = self else { return None };
        surface.targets::<F>(parameters, *seed)
    }

    /// How many polygons of its mesh's file are not in the mesh.
    pub fn left_out(&self) -> usize {
        let mesh = match self {
            Source::Mesh { family, .. } => family.mesh(),
            Source::MeshPart { surface, .. } => surface.mesh(),
            Source::SceneMesh { mesh, .. } => mesh.surface().mesh(),
            Source::Family { .. } | Source::Corpus(_) => return 0,
        };
        mesh.left_out().map_or(0, |note| note.count)
    }

    /// True if there are triangles around those of a group, which may have the hit that it lacks.
    pub fn has_neighbours(&self) -> bool {
        matches!(self, Source::MeshPart { .. })
    }

    /// Adds the triangles around those of an index, with its ray; false if they are too many, or if there are
    /// none.
    pub fn add_neighbours<F: Scalar>(
        &self,
        index: u64,
        ray: &Ray<F::Vector>,
        cases: &mut Vec<Case<F>>,
    ) -> bool {
        let Source::MeshPart { part, .. } = self else { return false };
        // Of an instance the ray is another for the kernel than in the world.
        let ray = match self.instance::<F>() {
            Some(_) => self.make::<F>(index).cases()[0].ray,
            None => *ray,
        };
        let targets = self.targets::<F>();
        targets.is_some_and(|targets| targets.add_neighbours((*part, index), &ray, cases))
    }

    /// True if its rates are those of a random sample, which has an interval; false if those of a whole set.
    pub fn is_sample(&self) -> bool {
        match self {
            Source::Family { exhaustive, family, count, .. } => {
                !exhaustive && family.size.is_none_or(|size| *count < size)
            }
            Source::Mesh { .. } | Source::MeshPart { .. } | Source::SceneMesh { .. } => true,
            Source::Corpus(_) => false,
        }
    }

    /// How the triangles of one index belong together.
    pub fn grouping(&self) -> Grouping {
        match self {
            Source::Family { family, .. } => family.grouping,
            Source::MeshPart { part, .. } => part.grouping(),
            Source::SceneMesh { stratum, .. } => stratum.family().grouping,
            Source::Corpus(set) if set.is_secondary => Grouping::SecondaryRay,
            Source::Mesh { .. } | Source::Corpus(_) => Grouping::Single,
        }
    }

    /// The cases of an index. Of an instance the rays are of the world and the triangles of the object.
    pub fn make<F: Scalar>(&self, index: u64) -> Made<F> {
        let mut made = match self {
            Source::Family { family, parameters, exhaustive: true, .. } => {
                family.make_in_order(parameters, index)
            }
            Source::Family { family, parameters, seed, .. } => {
                family.make(parameters, *seed, index)
            }
            Source::Mesh { family, parameters, seed, .. } => {
                Made::One(family.make(parameters, *seed, index))
            }
            Source::MeshPart { part, .. } => {
                let mut cases = Vec::new();
                let targets = self.targets::<F>().expect("a scalar of the run");
                targets.make(*part, index, &mut cases);
                Made::Group(cases)
            }
            Source::SceneMesh { mesh, stratum, parameters, seed, .. } => {
                mesh.make(*stratum, parameters, *seed, index)
            }
            // Stored rays are of the world, as they are.
            Source::Corpus(set) => return Made::One(set.get(index).1),
        };
        if let Some(instance) = self.instance() {
            made.cases_mut().iter_mut().for_each(|case| *case = instance.in_world(case));
        }
        made
    }

    /// Adds the cases of an index.
    pub fn add<F: Scalar>(&self, index: u64, cases: &mut Vec<Case<F>>) {
        match self {
            Source::MeshPart { part, parameters, .. } if parameters.instance.is_none() => {
                self.targets::<F>().expect("a scalar of the run").make(*part, index, cases);
            }
            _ => cases.extend_from_slice(self.make(index).cases()),
        }
    }

    /// True if the truths of an index keep the family's promise; it counts only if [`Source::promises`].
    pub fn keeps_promise(&self, truths: &[Truth]) -> bool {
        match self {
            Source::Family { family, .. } => family.keeps(truths),
            _ => true,
        }
    }

    /// True if the parameters leave the promise standing.
    pub fn promises(&self) -> bool {
        match self {
            // Scaling can leave the range at either end.
            Source::Family { parameters, .. } => {
                parameters.keep_truth() && parameters.scale == 0 && parameters.instance.is_none()
            }
            _ => true,
        }
    }

    /// True if the parameters do not change truths, except at the ends of the range.
    pub fn keeps_truth(&self) -> bool {
        self.parameters().is_none_or(Parameters::keep_truth)
    }

    /// The id of a case, or of triangle k of a group.
    pub fn id<F: Float>(&self, index: u64, triangle: Option<usize>) -> String {
        let id = match self {
            Source::Family { family, parameters, exhaustive: true, .. } => {
                // In its natural order the lattice has a name of its own: `lattice-all@1/f32/-/0/17`,
                // whose seed is always 0.
                let mut id = family.id::<F>(parameters, 0, index);
                id.family = format!("{}-all", family.name);
                id
            }
            Source::Family { family, parameters, seed, .. } => {
                family.id::<F>(parameters, *seed, index)
            }
            Source::Mesh { family, parameters, seed, .. } => {
                family.id::<F>(parameters, *seed, index)
            }
            Source::MeshPart { surface, part, parameters, seed, .. } => {
                surface.id::<F>(*part, parameters, *seed, index)
            }
            Source::SceneMesh { stratum, parameters, seed, .. } => {
                stratum.family().id::<F>(parameters, *seed, index)
            }
            Source::Corpus(set) => return set.get::<F>(index).0.to_owned(),
        };
        crate::case::CaseId { triangle, ..id }.to_string()
    }

    /// The words after `hairline explain` that show a case again.
    pub fn explain_arguments<F: Float>(&self, index: u64, triangle: Option<usize>) -> String {
        let id = quoted(&self.id::<F>(index, triangle));
        match self.file_flag() {
            Some(flag) => format!("{id} {flag}"),
            None => id,
        }
    }

    /// The flag that names the file from which an id makes its case; none of families.
    pub fn file_flag(&self) -> Option<String> {
        match self {
            Source::Family { .. } => None,
            Source::Mesh { family, .. } => Some(format!("--mesh {}", quoted(family.path()))),
            Source::MeshPart { surface, .. } => Some(format!("--mesh {}", quoted(surface.path()))),
            Source::SceneMesh { mesh, .. } => {
                Some(format!("--mesh {}", quoted(mesh.surface().path())))
            }
            Source::Corpus(CorpusSet { file, instance: None, .. }) => {
                Some(format!("--corpus {}", quoted(file)))
            }
            Source::Corpus(CorpusSet { file, instance: Some(matrix), .. }) => {
                Some(format!("--corpus {} --instance {}", quoted(file), quoted(&words(matrix))))
            }
        }
    }
}
