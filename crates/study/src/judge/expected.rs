//! The obligations of many cases, ready to be compared with the verdicts of many kernels.

use super::{Class, Obligation, TruthKind, ValueLimits, asked, obligation};
use crate::arith::Float;
use crate::case::Case;
use crate::contract::Contract;
use crate::kernel::{Gives, Verdict};
use crate::truth::{Facing, Truth};

/// The kinds of many truths.
pub struct Kinds {
    /// One a truth.
    pub of: Vec<TruthKind>,
    /// Each kind that occurs.
    each: Vec<KindCount>,
}

/// A kind that occurs among many truths.
struct KindCount {
    kind: TruthKind,
    /// The place of its first truth.
    first: usize,
    count: u64,
}

impl Kinds {
    pub(crate) fn new(truths: &[Truth]) -> Kinds {
        let mut of = Vec::with_capacity(truths.len());
        let mut each: Vec<KindCount> = Vec::new();
        let mut slots = [None; TruthKind::COUNT];
        for (first, truth) in truths.iter().enumerate() {
            let kind = TruthKind::of(truth);
            let slot = *slots[kind.number()].get_or_insert(each.len());
            if slot == each.len() {
                each.push(KindCount {
                    kind,
                    first,
                    count: 0,
                });
            }
            each[slot].count += 1;
            of.push(kind);
        }
        Kinds { of, each }
    }
}

/// A contract's demands on many cases.
#[derive(Default)]
pub struct Demands {
    /// One a case.
    pub of: Vec<Expected>,
    /// The cases on which nothing is demanded.
    pub free: Vec<usize>,
    /// How many cases of a class have which obligation; several lines may have the same class.
    pub counts: Vec<(Class, Obligation, u64)>,
}

/// The contract's demands on many cases with their truths, whose kinds are known.
pub fn ask_all<F: Float>(
    cases: &[Case<F>],
    truths: &[Truth],
    kinds: &Kinds,
    contract: &Contract,
    secondary: bool,
) -> Demands {
    let mut demands = Demands::default();
    if contract.asks_of_truths_alone() {
        // Few kinds occur, and all truths of a kind have the same obligation.
        let mut of_kind = [Expected::FREE; TruthKind::COUNT];
        for KindCount { kind, first, count } in &kinds.each {
            let asked = obligation(&truths[*first], contract, secondary);
            of_kind[kind.number()] = Expected::new(asked, *kind);
            demands.counts.push((kind.class(), asked, *count));
        }
        let expected = kinds.of.iter().map(|kind| of_kind[kind.number()]);
        demands.of.extend(expected);
    } else {
        for ((case, truth), kind) in cases.iter().zip(truths).zip(&kinds.of) {
            let asked = asked(case, truth, contract, secondary);
            demands.of.push(Expected::new(asked, *kind));
            demands.counts.push((kind.class(), asked, 1));
        }
    }
    for (i, expected) in demands.of.iter().enumerate() {
        if expected.obligation() == Obligation::Free {
            demands.free.push(i);
        }
    }
    demands
}

/// The demand on a case, as flags.
#[derive(Clone, Copy, Debug)]
pub struct Expected {
    may_hit: bool,
    may_miss: bool,
    /// The side that the ray comes from; none if it does not cross the plane.
    facing: Option<Facing>,
}

impl Expected {
    /// Nothing.
    const FREE: Expected = Expected {
        may_hit: true,
        may_miss: true,
        facing: None,
    };

    /// The demand on a case with its obligation and the kind of its truth.
    pub fn new(obligation: Obligation, kind: TruthKind) -> Expected {
        Expected {
            may_hit: obligation != Obligation::MustMiss,
            may_miss: obligation != Obligation::MustHit,
            facing: kind.facing(),
        }
    }

    /// The obligation.
    pub fn obligation(&self) -> Obligation {
        match (self.may_hit, self.may_miss) {
            (true, false) => Obligation::MustHit,
            (false, _) => Obligation::MustMiss,
            (true, true) => Obligation::Free,
        }
    }

    /// True if [`super::judge()`] surely finds nothing; computed without a branch.
    #[inline(always)]
    fn is_met<F: Float, const T: bool, const UV: bool, const FACING: bool>(
        &self,
        limits: &ValueLimits<F>,
        verdict: &Verdict<F>,
    ) -> bool {
        let is_near = |i: usize, value: F| (limits.low[i] <= value) & (value <= limits.high[i]);
        let near_t = !T | is_near(0, verdict.t);
        let near_uv = !UV | (is_near(1, verdict.u) & is_near(2, verdict.v));
        let right_side = !FACING | (verdict.facing == self.facing);
        let right_hit = verdict.hit & self.may_hit & near_t & near_uv & right_side;
        let right_miss = !verdict.hit & self.may_miss;
        (right_hit | right_miss) & verdict.failure.is_none()
    }
}

/// The places, in order, of the verdicts on which [`super::judge()`] may find something; on all others it
/// finds nothing. Most verdicts of a run are among these.
pub fn suspects<F: Float>(
    (expected, limits): (&[Expected], &[ValueLimits<F>]),
    gives: Gives,
    verdicts: &[Verdict<F>],
    found: &mut Vec<usize>,
) {
    let collect = match (gives.t, gives.uv, gives.facing) {
        (false, false, false) => collect::<F, false, false, false>,
        (false, false, true) => collect::<F, false, false, true>,
        (false, true, false) => collect::<F, false, true, false>,
        (false, true, true) => collect::<F, false, true, true>,
        (true, false, false) => collect::<F, true, false, false>,
        (true, false, true) => collect::<F, true, false, true>,
        (true, true, false) => collect::<F, true, true, false>,
        (true, true, true) => collect::<F, true, true, true>,
    };
    collect((expected, limits), verdicts, found);
}

fn collect<F: Float, const T: bool, const UV: bool, const FACING: bool>(
    (expected, limits): (&[Expected], &[ValueLimits<F>]),
    verdicts: &[Verdict<F>],
    found: &mut Vec<usize>,
) {
    found.resize(expected.len().min(verdicts.len()), 0);
    let mut count = 0;
    for (i, ((expected, limits), verdict)) in expected.iter().zip(limits).zip(verdicts).enumerate()
    {
        // Written always, kept where it is one: no branch to mispredict.
        found[count] = i;
        count += usize::from(!expected.is_met::<F, T, UV, FACING>(limits, verdict));
    }
    found.truncate(count);
}
