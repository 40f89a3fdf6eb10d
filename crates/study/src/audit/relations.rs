//! How often simple relations hold between the wrong answers of a kernel and the exact values: what its mistake may be.

use super::chunk::Chunk;
use super::judging::ChunkDemands;
use super::rows::RowIn;
use crate::arith::Float;
use crate::case::Case;
use crate::contract::Contract;
use crate::family::Grouping;
use crate::judge::{
    Finding, MISSES, Obligation, Part, RelatedValues, Relation, answers_as, asked,
    is_hit_far_beside, is_plain, judge, other_demands, stands_for_miss,
};
use crate::kernel::{Gives, Scalar, Verdict};
use crate::oracle;
use crate::plot::group_digits;
use crate::truth::Truth;
use serde::{Deserialize, Serialize};
use std::fmt;

/// The fewest cases by which a relation is known.
const FEWEST: u64 = 5;

/// The least share of the cases, in percent, on which a relation holds that is named. A wrong kernel also rounds, and some of
/// its values are wrong by that alone.
const LEAST: u64 = 90;

/// How often each relation holds, and on how many cases it could.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Relations {
    /// By [`Relation::ALL`]: the cases on which it holds, and all that could show it.
    counts: [[u64; 2]; Relation::ALL.len()],
    /// The wrong verdicts to plain cases ([`is_plain`]) that no relation demands.
    unexplained: u64,
}

/// A relation that holds, and how often.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Related {
    /// The relation.
    pub relation: Relation,
    /// The cases on which it holds.
    pub count: u64,
    /// All cases that could show it.
    pub of: u64,
}

impl Relations {
    /// Counts a hit with a wrong value. `before` is the verdict on the case before it.
    pub fn add_values<F: Float>(
        &mut self,
        values: &RelatedValues,
        verdict: &Verdict<F>,
        before: Option<&Verdict<F>>,
    ) {
        let bits = |it: &Verdict<F>| [it.t, it.u, it.v].map(F::to_bits);
        let is_repeated = before.is_some_and(|it| it.hit && bits(it) == bits(verdict));
        for relation in Relation::ALL
            .into_iter()
            .filter(|it| values.wrong.contains(&it.part()))
        {
            let holds = match relation {
                Relation::Previous => is_repeated,
                relation => values.holding.contains(&relation),
            };
            self.add(relation, holds);
        }
    }

    fn add(&mut self, relation: Relation, holds: bool) {
        let [count, of] = &mut self.counts[relation as usize];
        *count += u64::from(holds);
        *of += 1;
    }

    /// Adds those of other cases.
    pub fn merge(&mut self, other: &Relations) {
        self.unexplained += other.unexplained;
        for (sum, more) in self
            .counts
            .iter_mut()
            .flatten()
            .zip(other.counts.iter().flatten())
        {
            *sum += more;
        }
    }

    /// Those of a kernel's answers to some cases under a contract, each answer beside the one before it.
    pub fn of<F: Scalar>(
        cases: &[Case<F>],
        contract: &Contract,
        gives: Gives,
        verdicts: &[Verdict<F>],
    ) -> Relations {
        let mut relations = Relations::default();
        for (i, (case, verdict)) in cases.iter().zip(verdicts).enumerate() {
            let truth = oracle::truth(case);
            let owed = asked(case, &truth, contract, false);
            if judge((contract, owed), (case, &truth), gives, verdict) == Some(Finding::WrongValue)
            {
                let values = RelatedValues::of(case, gives, verdict, contract.value_tolerance);
                let before = i.checked_sub(1).map(|place| &verdicts[place]);
                relations.add_values(&values, verdict, before);
            }
            relations.add_answer((case, &truth), (contract, owed), gives, verdict);
        }
        relations
    }

    /// Counts the answer to a case with an obligation.
    fn add_answer<F: Float>(
        &mut self,
        (case, truth): (&Case<F>, &Truth),
        (contract, owed): (&Contract, Obligation),
        gives: Gives,
        verdict: &Verdict<F>,
    ) {
        if owed == Obligation::Free || verdict.failure.is_some() {
            return;
        }
        let demands = other_demands(case, truth, contract);
        for (relation, demand) in &demands {
            let holds = answers_as(*relation, *demand, truth, gives, verdict);
            self.add(*relation, holds);
        }
        if owed == Obligation::MustMiss && is_hit_far_beside(case, truth, gives, verdict) {
            let shown = stands_for_miss(verdict);
            for relation in MISSES {
                self.add(relation, shown == Some(relation));
            }
        }
        let is_wrong = verdict.hit != (owed == Obligation::MustHit);
        if demands.is_empty() && is_wrong && is_plain(case) {
            self.unexplained += 1;
        }
    }

    /// True if a relation about hit or miss explains at least half of the wrong verdicts that rounding does not: a kernel that
    /// misses whatever it is asked misses behind the origin too. Values say by themselves what they are.
    fn explains_most(&self, related: &Related) -> bool {
        let is_of_verdicts = matches!(related.relation.part(), Part::Start | Part::End);
        !is_of_verdicts || self.unexplained <= related.count
    }

    /// The relations that hold on (nearly) all cases that could show them, of each part of an answer the one with the most.
    pub fn known(&self) -> Vec<Related> {
        let all = Relation::ALL.into_iter().map(|relation| {
            let [count, of] = self.counts[relation as usize];
            Related {
                relation,
                count,
                of,
            }
        });
        let mut known: Vec<Related> = Vec::new();
        for related in all.filter(|it| it.is_known() && self.explains_most(it)) {
            let part = |it: &Related| it.relation.part();
            match known.iter_mut().find(|other| part(other) == part(&related)) {
                Some(other) if other.count < related.count => *other = related,
                Some(_) => {}
                None => known.push(related),
            }
        }
        // What takes |t| for t also reports it.
        if known.iter().any(|it| it.relation == Relation::AbsoluteT) {
            known.retain(|it| it.relation != Relation::OppositeT);
        }
        // A t that stands for a miss is no wrong t.
        if known.iter().any(|it| it.relation.part() == Part::Miss) {
            known.retain(|it| it.relation.part() == Part::Miss);
        }
        known
    }
}

impl<F: Scalar> RowIn<F> {
    /// Counts the answers to a chunk where a relation demands another than the contract. In an instance the truth belongs to
    /// another ray than the one that the kernel got, and a secondary ray has an obligation of its own.
    pub fn relate_answers(
        &self,
        chunk: &Chunk<F>,
        contract: &Contract,
        asked: &ChunkDemands,
        verdicts: &[Verdict<F>],
        relations: &mut Relations,
    ) {
        if chunk.is_placed() || chunk.grouping == Grouping::SecondaryRay {
            return;
        }
        let gives = self.info.gives;
        for (i, expected) in asked.expectations.of.iter().enumerate() {
            let asked = (&chunk.cases[i], &chunk.truths[i]);
            let owed = (contract, expected.obligation());
            relations.add_answer(asked, owed, gives, &verdicts[i]);
        }
    }
}

impl Related {
    fn is_known(&self) -> bool {
        FEWEST <= self.of && LEAST * self.of <= 100 * self.count
    }
}

/// `t is twice the exact t on all 707,378 hits with a wrong t`.
impl fmt::Display for Related {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Related {
            relation,
            count,
            of,
        } = self;
        let cases = relation.part().cases();
        let how_many = match count == of {
            true => format!("all {}", group_digits(*of)),
            false => format!("{} of {}", group_digits(*count), group_digits(*of)),
        };
        write!(f, "{} on {how_many} {cases}", relation.about())
    }
}
