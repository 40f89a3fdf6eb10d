//! Judges the groups of a chunk by the verdicts of one row.

use super::chunk::Chunk;
use super::group_count::JudgedGroup;
use super::rows::RowIn;
use super::source::Source;
use crate::case::Case;
use crate::contract::Contract;
use crate::judge::{GroupTruth, may_be_elsewhere};
use crate::kernel::{Scalar, Verdict, verdicts_of};
use crate::oracle::Layers;
use crate::truth::Facing;

/// Neighbours of crossings without a hit that go through together, about.
const NEIGHBOURS: usize = 4096;

impl<F: Scalar> RowIn<F> {
    /// Judges the groups of a chunk, of which a contract asks `truths`. Those on which the kernel failed
    /// come as their index alone.
    pub fn judge_groups<'c>(
        &self,
        source: &Source,
        chunk: &'c Chunk<F>,
        (contract, truths): (&Contract, &'c [GroupTruth]),
        verdicts: &'c [Verdict<F>],
    ) -> impl Iterator<Item = Result<JudgedGroup, u64>> + use<'c, F> {
        let elsewhere = match source.has_neighbours() {
            true => self.elsewhere(source, chunk, (contract, truths), verdicts),
            false => Vec::new(),
        };
        chunk
            .groups()
            .zip(truths)
            .map(move |((index, cases), truth)| {
                let verdicts = &verdicts[cases];
                if verdicts.iter().any(|verdict| verdict.failure.is_some()) {
                    return Err(index);
                }
                let hits = verdicts.iter().filter(|verdict| verdict.hit).count();
                let elsewhere = elsewhere.binary_search(&index).is_ok();
                Ok(JudgedGroup {
                    index,
                    truth: *truth,
                    hits,
                    elsewhere,
                })
            })
    }

    /// The indices of crossings without a hit whose hit may be among the neighbours.
    fn elsewhere(
        &self,
        source: &Source,
        chunk: &Chunk<F>,
        (contract, truths): (&Contract, &[GroupTruth]),
        verdicts: &[Verdict<F>],
    ) -> Vec<u64> {
        let missed = chunk.groups().zip(truths).filter(|((_, cases), truth)| {
            let mut verdicts = verdicts[cases.clone()].iter();
            **truth == GroupTruth::Crossing
                && verdicts.all(|verdict| !verdict.hit && verdict.failure.is_none())
        });
        let (mut elsewhere, mut cases, mut waiting) = (Vec::new(), Vec::new(), Vec::new());
        for ((index, group), _) in missed {
            let Some(crossing) = chunk.truths[group.start].crossing() else {
                continue;
            };
            // Where the neighbours are too many to be tried, nobody is accused.
            if !source.add_neighbours(index, &chunk.cases[group], &mut cases) {
                elsewhere.push(index);
                continue;
            }
            waiting.push((index, crossing.facing, cases.len()));
            if cases.len() >= NEIGHBOURS {
                elsewhere.extend(self.with_hit_nearby(source, contract, &mut cases, &waiting));
                cases.clear();
                waiting.clear();
            }
        }
        elsewhere.extend(self.with_hit_nearby(source, contract, &mut cases, &waiting));
        elsewhere.sort_unstable();
        elsewhere
    }

    /// The indices whose hit may be among the neighbours: each with the side that its group faces, and
    /// where its neighbours end.
    fn with_hit_nearby(
        &self,
        source: &Source,
        contract: &Contract,
        cases: &mut [Case<F>],
        waiting: &[(u64, Facing, usize)],
    ) -> Vec<u64> {
        let mut truths = Vec::with_capacity(cases.len());
        source.ask(cases, &mut truths, &mut Layers::default());
        let mut verdicts = vec![Verdict::miss(None); cases.len()];
        if !cases.is_empty() {
            verdicts_of(self.subject, cases, &self.epsilons, &mut verdicts);
        }
        let mut start = 0;
        let found = waiting.iter().filter_map(|(index, facing, end)| {
            let around = std::mem::replace(&mut start, *end)..*end;
            let (truths, verdicts) = (&truths[around.clone()], &verdicts[around.clone()]);
            may_be_elsewhere(*facing, &cases[around], truths, verdicts, contract).then_some(*index)
        });
        found.collect()
    }
}
