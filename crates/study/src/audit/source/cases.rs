//! The cases of a source, by index: how they are made, their truths, and the triangles around them.

use super::{Source, Stock};
use crate::arith::Float;
use crate::audit::aimed::{AimedRay, is_on_target};
use crate::case::Case;
use crate::family::{CaseGroup, add_ring};
use crate::kernel::Scalar;
use crate::mesh::Aim;
use crate::oracle::{self, Layers};
use crate::truth::Truth;

impl Source {
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

    /// The target and the class of the ray of an index; none of sources that are no part of a mesh.
    pub(in crate::audit) fn aimed<F: Float>(
        &self,
        index: u64,
        truths: &[Truth],
    ) -> Option<AimedRay> {
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
}
