//! Judges the groups of a chunk by the verdicts of one row.

use super::chunk::Chunk;
use super::group_count::JudgedGroup;
use super::neighbours::{KnownNeighbours, Neighbours};
use super::rows::RowIn;
use super::source::Source;
use crate::contract::Contract;
use crate::judge::{GroupTruth, may_be_elsewhere};
use crate::kernel::{Scalar, Verdict, verdicts_of};
use crate::truth::Facing;
use std::rc::Rc;

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
        known: &mut KnownNeighbours<F>,
    ) -> impl Iterator<Item = Result<JudgedGroup, u64>> + use<'c, F> {
        let elsewhere = match source.has_neighbours() {
            true => self.elsewhere(source, chunk, (contract, truths), verdicts, known),
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
        known: &mut KnownNeighbours<F>,
    ) -> Vec<u64> {
        let missed = chunk.groups().zip(truths).filter(|((_, cases), truth)| {
            let mut verdicts = verdicts[cases.clone()].iter();
            **truth == GroupTruth::Crossing
                && verdicts.all(|verdict| !verdict.hit && verdict.failure.is_none())
        });
        let (mut elsewhere, mut waiting, mut cases) = (Vec::new(), Vec::new(), 0);
        for ((index, group), _) in missed {
            let Some(crossing) = chunk.truths[group.start].crossing() else {
                continue;
            };
            // Where the neighbours are too many to be tried, nobody is accused.
            let Some(around) = known.of(source, index, &chunk.cases[group]) else {
                elsewhere.push(index);
                continue;
            };
            cases += around.cases.len();
            waiting.push(Missed {
                index,
                facing: crossing.facing,
                around,
            });
            if cases >= NEIGHBOURS {
                elsewhere.extend(self.with_hit_nearby(contract, &waiting));
                waiting.clear();
                cases = 0;
            }
        }
        elsewhere.extend(self.with_hit_nearby(contract, &waiting));
        elsewhere.sort_unstable();
        elsewhere
    }

    /// The indices whose hit may be among the neighbours.
    fn with_hit_nearby(&self, contract: &Contract, missed: &[Missed<F>]) -> Vec<u64> {
        let mut cases = Vec::new();
        for group in missed {
            cases.extend_from_slice(&group.around.cases);
        }
        let mut verdicts = vec![Verdict::miss(None); cases.len()];
        if !cases.is_empty() {
            verdicts_of(self.subject, &cases, &self.epsilons, &mut verdicts);
        }
        let mut found = Vec::new();
        let mut rest = &verdicts[..];
        for group in missed {
            let Neighbours { cases, truths } = &*group.around;
            let (verdicts, others) = rest.split_at(cases.len());
            rest = others;
            if may_be_elsewhere(group.facing, cases, truths, verdicts, contract) {
                found.push(group.index);
            }
        }
        found
    }
}

/// A crossing without a hit.
struct Missed<F: Scalar> {
    index: u64,
    /// The side that its group faces.
    facing: Facing,
    around: Rc<Neighbours<F>>,
}
