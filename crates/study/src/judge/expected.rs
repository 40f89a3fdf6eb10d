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
    /// Each kind that occurs, with the place of its first truth and their number.
    each: Vec<(TruthKind, usize, u64)>,
}

impl Kinds {
    pub(crate) fn new(truths: &[Truth]) -> Kinds {
        let mut slots = [None; TruthKind::COUNT];
        let mut each: Vec<(TruthKind, usize, u64)> = Vec::new();
        let mut count = |(i, truth): (usize, &Truth)| {
            let kind = TruthKind::of(truth);
            let slot = *slots[kind.number()].get_or_insert_with(|| {
                each.push((kind, i, 0));
                each.len() - 1
            });
            each[slot].2 += 1;
            kind
        };
        Kinds {
            of: truths.iter().enumerate().map(&mut count).collect(),
            each,
        }
    }
}

/// A contract's demands on many cases.
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
    let (of, counts): (Vec<Expected>, Vec<_>) = if contract.asks_of_truths_alone() {
        // Few kinds occur, and each is asked the same.
        let mut of_kind = [Expected::FREE; TruthKind::COUNT];
        let ask = |&(kind, first, count): &(TruthKind, usize, u64)| {
            let asked = obligation(&truths[first], contract, secondary);
            of_kind[kind.number()] = Expected::new(asked, kind);
            (kind.class(), asked, count)
        };
        let counts = kinds.each.iter().map(ask).collect();
        (
            kinds.of.iter().map(|kind| of_kind[kind.number()]).collect(),
            counts,
        )
    } else {
        let cases = cases.iter().zip(truths).zip(&kinds.of);
        let ask = |((case, truth), kind): ((&Case<F>, &Truth), &TruthKind)| {
            let asked = asked(case, truth, contract, secondary);
            (Expected::new(asked, *kind), (kind.class(), asked, 1))
        };
        cases.map(ask).unzip()
    };
    let free = (0..of.len())
        .filter(|&i| of[i].obligation() == Obligation::Free)
        .collect();
    Demands { of, free, counts }
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
        let near =
            |which: usize, value: F| (limits.low[which] <= value) & (value <= limits.high[which]);
        let near = (!T | near(0, verdict.t)) & (!UV | (near(1, verdict.u) & near(2, verdict.v)));
        let facing = !FACING | (verdict.facing == self.facing);
        let right_hit = verdict.hit & self.may_hit & near & facing;
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
    let asked = (expected, limits);
    match (gives.t, gives.uv, gives.facing) {
        (false, false, false) => collect::<F, false, false, false>(asked, verdicts, found),
        (false, false, true) => collect::<F, false, false, true>(asked, verdicts, found),
        (false, true, false) => collect::<F, false, true, false>(asked, verdicts, found),
        (false, true, true) => collect::<F, false, true, true>(asked, verdicts, found),
        (true, false, false) => collect::<F, true, false, false>(asked, verdicts, found),
        (true, false, true) => collect::<F, true, false, true>(asked, verdicts, found),
        (true, true, false) => collect::<F, true, true, false>(asked, verdicts, found),
        (true, true, true) => collect::<F, true, true, true>(asked, verdicts, found),
    }
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
