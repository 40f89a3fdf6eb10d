//! Some indices of a source together: their cases, truths and groups.

use super::aimed::AimedRay;
use super::digest::CasePlace;
use super::source::Source;
use crate::arith::ScalarName;
use crate::case::{Case, Instance};
use crate::contract::Contract;
use crate::engine::Observer;
use crate::family::Grouping;
use crate::judge::{
    self, Class, Demands, Distances, GroupTruth, Kinds, Obligation, ValueLimits, group_obligation,
    owes_groups_alike,
};
use crate::kernel::{Gives, Scalar};
use crate::oracle::Layers;
use crate::truth::Truth;
use serde::{Deserialize, Serialize};
use std::ops::Range;
use std::sync::Arc;

/// The summary of a source in one scalar.
#[derive(Clone, Serialize, Deserialize)]
pub struct SourceSummary {
    /// The source's place in the plan.
    pub source: usize,
    /// `f32` or `f64`.
    pub scalar: ScalarName,
    /// Indices made.
    pub indices: u64,
    /// Cases in them: a group has several.
    pub cases: u64,
    /// Indices whose truths do not keep the family's promise.
    pub promise_broken: u64,
    /// The first of them.
    pub first_broken: Option<u64>,
    /// Which layer of the oracle decided.
    pub layers: Layers,
    /// Time spent in the oracle, over all threads.
    pub oracle_nanoseconds: u64,
}

impl SourceSummary {
    /// A summary without cases.
    pub fn new(source: usize, scalar: ScalarName) -> SourceSummary {
        SourceSummary {
            source,
            scalar,
            indices: 0,
            cases: 0,
            promise_broken: 0,
            first_broken: None,
            layers: Layers::default(),
            oracle_nanoseconds: 0,
        }
    }

    /// Adds what another part of the same source gave.
    pub fn merge(&mut self, other: &SourceSummary) {
        self.indices += other.indices;
        self.cases += other.cases;
        self.promise_broken += other.promise_broken;
        self.first_broken = [self.first_broken, other.first_broken]
            .into_iter()
            .flatten()
            .min();
        self.layers.merge(&other.layers);
        self.oracle_nanoseconds += other.oracle_nanoseconds;
    }
}

/// The cases of some indices, flat, with their groups: as kernels get them, while the truths of an instance are of the
/// world.
pub struct Chunk<F: Scalar> {
    /// Which cases belong together.
    pub grouping: Grouping,
    /// Each case, as a kernel gets it.
    pub cases: Vec<Case<F>>,
    pub(crate) places: Vec<CasePlace>,
    /// The truth of each case.
    pub truths: Vec<Truth>,
    kinds: Kinds,
    /// An instance, and the cases with their rays of the world.
    world: Option<(Instance<F>, Vec<Case<F>>)>,
    /// Where each index's cases start, and the end.
    starts: Vec<usize>,
    first_index: u64,
    /// One an index of a mesh's part; none of other sources.
    aimed: Vec<AimedRay>,
}

impl<F: Scalar> Chunk<F> {
    /// Makes the cases and asks the oracle.
    pub fn make(
        source: &Source,
        indices: Range<u64>,
        observer: &dyn Observer,
        summary: &mut SourceSummary,
    ) -> Chunk<F> {
        let first_index = indices.start;
        let count = (indices.end - indices.start) as usize;
        let (mut cases, mut places, mut starts) = (Vec::new(), Vec::new(), Vec::new());
        starts.reserve(count + 1);
        starts.push(0);
        for index in indices {
            let start = cases.len();
            source.add::<F>(index, &mut cases);
            if start == 0 {
                places.reserve(count * cases.len());
                cases.reserve(count * cases.len());
            }
            let triangles = 0..(cases.len() - start) as u32;
            places.extend(triangles.map(|triangle| CasePlace { index, triangle }));
            starts.push(cases.len());
        }
        let start = observer.now();
        let mut truths = Vec::with_capacity(cases.len());
        let world = source.instance().map(|instance| (instance, cases.clone()));
        source.ask(&mut cases, &mut truths, &mut summary.layers);
        summary.oracle_nanoseconds += observer.now() - start;
        let mut chunk = Chunk {
            grouping: source.grouping(),
            kinds: Kinds::new(&truths),
            cases,
            places,
            truths,
            world,
            starts,
            first_index,
            aimed: Vec::new(),
        };
        let aimed =
            |(index, cases): (u64, Range<usize>)| source.aimed::<F>(index, &chunk.truths[cases]);
        chunk.aimed = chunk.groups().filter_map(aimed).collect();
        summary.indices += chunk.starts.len() as u64 - 1;
        summary.cases += chunk.cases.len() as u64;
        for (index, range) in chunk.groups() {
            if !source.keeps_promise(&chunk.truths[range]) {
                summary.promise_broken += 1;
                summary.first_broken = Some(summary.first_broken.map_or(index, |i| i.min(index)));
            }
        }
        chunk
    }

    /// Each index with the range of its cases.
    pub fn groups(&self) -> impl Iterator<Item = (u64, Range<usize>)> {
        let first = self.first_index;
        self.starts
            .windows(2)
            .zip(first..)
            .map(|(ends, index)| (index, ends[0]..ends[1]))
    }

    /// The target and the class of the ray of an index; none of sources that are no part of a mesh.
    pub(super) fn aimed(&self, index: u64) -> Option<AimedRay> {
        self.aimed.get((index - self.first_index) as usize).copied()
    }

    /// The contract's demands on each case.
    pub fn expectations(&self, contract: &Contract) -> Demands {
        let secondary = self.grouping == Grouping::SecondaryRay;
        judge::ask_all(&self.cases, &self.truths, &self.kinds, contract, secondary)
    }

    /// The values of a kernel that are judged. In an instance they belong to the ray that the kernel got, and not to
    /// the truth.
    pub fn judged(&self, gives: Gives) -> Gives {
        if self.world.is_some() {
            Gives::NOTHING
        } else {
            gives
        }
    }

    /// True if a matrix puts the triangles into the world.
    pub(super) fn is_placed(&self) -> bool {
        self.world.is_some()
    }

    /// How far a valid case is from where its truth would change.
    pub fn distances(&self, case: usize) -> Distances {
        match &self.world {
            Some((it, world)) => Distances::of_instance(&world[case], it, &self.truths[case]),
            None => Distances::of(&self.cases[case], &self.truths[case]),
        }
    }

    /// The ranges in which the values of a hit on each case are surely right.
    pub fn limits(&self) -> Vec<ValueLimits<F>> {
        self.cases
            .iter()
            .zip(&self.truths)
            .map(|(case, truth)| ValueLimits::of(case, truth))
            .collect()
    }

    /// The same, without what else is known of the cases.
    pub fn obligations(&self, contract: &Contract) -> Vec<Obligation> {
        self.expectations(contract)
            .of
            .iter()
            .map(|expected| expected.obligation())
            .collect()
    }

    /// The class of a case.
    pub fn class(&self, case: usize) -> Class {
        self.kinds.of[case].class()
    }

    /// The contract's demand on each group; empty if the source's cases stand alone.
    pub fn group_truths(&self, contract: &Contract) -> Vec<GroupTruth> {
        if !self.grouping.shares_a_ray() {
            return Vec::new();
        }
        let ask = |(_, range): (u64, Range<usize>)| {
            let (cases, truths) = (&self.cases[range.clone()], &self.truths[range]);
            group_obligation(cases, truths, contract, self.grouping)
        };
        self.groups().map(ask).collect()
    }

    /// The same of each of some contracts, many of which ask alike.
    pub fn group_truths_of_all(&self, contracts: &[Contract]) -> Vec<Arc<[GroupTruth]>> {
        let mut all: Vec<Arc<[GroupTruth]>> = Vec::with_capacity(contracts.len());
        for contract in contracts {
            let alike = |(other, _): &(&Contract, _)| owes_groups_alike(contract, other);
            let truths = match contracts.iter().zip(&all).find(alike) {
                Some((_, truths)) => truths.clone(),
                None => self.group_truths(contract).into(),
            };
            all.push(truths);
        }
        all
    }
}
