//! Where a plan's cases come from, by index.

use super::aimed::{AimedRay, is_on_target};
use super::corpus_set::CorpusSet;
use super::row::quoted;
use crate::arith::Float;
use crate::case::{Case, Instance, Matrix, Parameters, SceneKind, Toward};
use crate::family::{CaseGroup, Family, Grouping, LATTICE_SIZE, MeshFamily, Stratum, add_ring};
use crate::kernel::Scalar;
use crate::mesh::{Aim, AimedPart, SceneMesh, Surface, Targets};
use crate::oracle::{self, Layers};
use crate::printable::printable;
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

/// True if a source of this name in tables makes its cases from a mesh.
pub fn is_of_mesh(name: &str) -> bool {
    name.split_once(':').is_some_and(|(kind, file)| {
        kind == "mesh"
            || AimedPart::named(kind).is_some()
            || Stratum::named(kind).is_some() && SceneKind::named(file).is_none()
    })
}

/// The kind of planes and rays of the scene whose source has this name in tables; the generic one of other sources.
pub fn kind_of(name: &str) -> SceneKind {
    let kind = name
        .split_once(':')
        .and_then(|(_, kind)| SceneKind::named(kind));
    kind.unwrap_or(SceneKind::ALL[0])
}

/// A matrix as `--instance` takes it.
pub fn words(matrix: &Matrix<f64>) -> String {
    matrix
        .as_flattened()
        .iter()
        .map(f64::to_string)
        .collect::<Vec<_>>()
        .join(" ")
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
        cases
            .iter_mut()
            .for_each(|case| *case = instance.in_object(case));
    }

    /// A case that it makes, as kernels get it.
    pub fn seen<F: Float>(&self, case: &Case<F>) -> Case<F> {
        self.instance()
            .map_or(*case, |instance| instance.in_object(case))
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

    /// The name in tables: one line, whatever a file is called.
    pub fn name(&self) -> String {
        let name = match &self.stock {
            Stock::Family(family) | Stock::Whole(family) => match &self.parameters.scene {
                Some(scene) if scene.kind() != SceneKind::ALL[0] => {
                    format!("{}:{}", family.name, scene.kind())
                }
                _ => family.name.to_owned(),
            },
            Stock::Mesh(family) => format!("mesh:{}", family.file_name()),
            Stock::MeshPart(surface, part) => {
                format!("{}:{}", part.name(), surface.family().file_name())
            }
            Stock::SceneMesh(mesh, stratum) => {
                format!(
                    "{}:{}",
                    stratum.family().name,
                    mesh.surface().family().file_name()
                )
            }
            Stock::Corpus(set) if set.is_secondary => format!("corpus-secondary:{}", set.file),
            Stock::Corpus(set) => format!("corpus:{}", set.file),
        };
        printable(&name)
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

    /// The target and the class of the ray of an index; none of sources that are no part of a mesh.
    pub(super) fn aimed<F: Float>(&self, index: u64, truths: &[Truth]) -> Option<AimedRay> {
        let Stock::MeshPart(_, part) = &self.stock else {
            return None;
        };
        let (target, number) = self.targets::<F>()?.place(*part, index);
        let is_near = !is_on_target(*part, truths);
        let class = 2 * usize::from(is_near) + usize::from(Aim::of(number).grazing);
        Some(AimedRay {
            target: target as u32,
            class,
        })
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

    /// Adds the triangles around those of an index, with its ray: of a mesh its faces, of other groups a ring. False if
    /// they are too many, or if there are none.
    pub fn add_neighbours<F: Scalar>(
        &self,
        index: u64,
        group: &[Case<F>],
        cases: &mut Vec<Case<F>>,
    ) -> bool {
        // Of an instance the ray is another for the kernel than in the world.
        let ray = match self.instance::<F>() {
            Some(_) => self.make::<F>(index).cases()[0].ray,
            None => group[0].ray,
        };
        match &self.stock {
            Stock::MeshPart(_, part) => {
                let targets = self.targets::<F>().expect("a scalar of the run");
                targets.add_neighbours((*part, index), &ray, cases)
            }
            Stock::SceneMesh(mesh, stratum) => {
                let draw = &mut stratum.draw(self.seed, index);
                mesh.add_neighbours(*stratum, draw, &ray, cases)
            }
            _ => add_ring(group, &ray, cases),
        }
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

    /// The cases of an index. Of an instance the rays are of the world and the triangles of the object.
    pub fn make<F: Scalar>(&self, index: u64) -> CaseGroup<F> {
        let Source {
            parameters, seed, ..
        } = self;
        let mut made = match &self.stock {
            Stock::Whole(family) => family.make_in_order(parameters, index),
            Stock::Family(family) => family.make(parameters, *seed, index),
            Stock::Mesh(family) => CaseGroup::One(family.make(parameters, *seed, index)),
            Stock::MeshPart(_, part) => {
                let mut cases = Vec::new();
                let targets = self.targets::<F>().expect("a scalar of the run");
                targets.make(*part, index, &mut cases);
                CaseGroup::Group(cases)
            }
            Stock::SceneMesh(mesh, stratum) => mesh.make(*stratum, parameters, *seed, index),
            // Stored rays are of the world, as they are.
            Stock::Corpus(set) => return CaseGroup::One(set.get(index).1),
        };
        if let Some(instance) = self.instance() {
            made.cases_mut()
                .iter_mut()
                .for_each(|case| *case = instance.in_world(case));
        }
        made
    }

    /// Adds the cases of an index.
    pub fn add<F: Scalar>(&self, index: u64, cases: &mut Vec<Case<F>>) {
        match &self.stock {
            Stock::MeshPart(_, part) if self.parameters.instance.is_none() => {
                self.targets::<F>()
                    .expect("a scalar of the run")
                    .make(*part, index, cases);
            }
            _ => cases.extend_from_slice(self.make(index).cases()),
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

    /// The id of a case, or of triangle k of a group.
    pub fn id<F: Float>(&self, index: u64, triangle: Option<usize>) -> String {
        let Source {
            parameters, seed, ..
        } = self;
        let id = match &self.stock {
            Stock::Whole(family) => {
                // In its natural order the lattice has a name of its own: `lattice-all@1/f32/-/0/17`,
                // whose seed is always 0.
                let mut id = family.id::<F>(parameters, 0, index);
                id.family = format!("{}-all", family.name);
                id
            }
            Stock::Family(family) => family.id::<F>(parameters, *seed, index),
            Stock::Mesh(family) => family.id::<F>(parameters, *seed, index),
            Stock::MeshPart(surface, part) => surface.id::<F>(*part, parameters, *seed, index),
            Stock::SceneMesh(_, stratum) => stratum.family().id::<F>(parameters, *seed, index),
            Stock::Corpus(set) => return set.get::<F>(index).0.to_owned(),
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
        let Stock::Corpus(set) = &self.stock else {
            return self
                .mesh()
                .map(|family| format!("--mesh {}", quoted(family.path())));
        };
        let instance = self.parameters.instance.as_ref();
        let instance = instance.map(|matrix| format!(" --instance {}", quoted(&words(matrix))));
        Some(format!(
            "--corpus {}{}",
            quoted(&set.file),
            instance.unwrap_or_default()
        ))
    }
}
