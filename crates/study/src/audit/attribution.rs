//! Why a kernel was wrong: its convention, its epsilon, rounding, or the range of its numbers.
//!
//! The same source runs in exact arithmetic, with the given epsilons and with none. A float run in
//! which no operation rounded is its own exact run. This matters because floats have two zeros, and some
//! sources decide on the sign of one; exact arithmetic has a single zero.

use crate::arith::{Float, Notes};
use crate::case::Case;
use crate::contract::Contract;
use crate::judge::{Answer, Finding, Obligation, exact_values_are_near, judge, judge_answer};
use crate::kernel::{
    ExactRun, Gives, KernelInfo, Subject, TrackedRun, Tunable, Verdict, verdicts_of,
};
use crate::truth::Truth;
use std::slice;

named! {
    pub names
    /// Why a finding happened.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
    pub enum Attribution {
        /// The formula means something else than the contract: even without rounding and without an
        /// epsilon it gives this finding.
        Convention = "convention",
        /// The epsilon itself: without rounding the formula is right at zero, and wrong at this epsilon.
        Epsilon = "epsilon",
        /// Rounding: the formula is right, epsilon and all.
        Rounding = "rounding",
        /// As rounding, and a number behind the decisions overflowed or lost bits to underflow.
        Range = "range",
        /// Not its epsilons: the kernel does not show its formula, and it is wrong with every epsilon 0 too.
        NotEpsilon = "not-epsilon",
        /// The rounded inverse of an instance: on the ray that the kernel got, it is right.
        Transform = "transform",
    }
}

impl Attribution {
    /// A word or two for a table.
    pub fn in_short(self) -> &'static str {
        match self {
            Attribution::NotEpsilon => "not its epsilons",
            other => other.name(),
        }
    }

    /// In short, and what it means.
    pub fn describe(self) -> String {
        let meaning = match self {
            Attribution::Convention => {
                "without rounding and with every epsilon 0 it is still wrong"
            }
            Attribution::Epsilon => {
                "without rounding it is right with every epsilon 0, and wrong with these"
            }
            Attribution::Rounding => "without rounding it is right, epsilons and all",
            Attribution::Range => {
                "without rounding it is right; a number behind the decision overflowed or underflowed"
            }
            Attribution::NotEpsilon => {
                "with every epsilon 0 it is wrong too; whether its formula or rounding is to blame only the formula \
                 tells, and it does not show that"
            }
            Attribution::Transform => {
                "on the ray that it got it is right: the instance's rounded inverse moved that ray"
            }
        };
        format!("{} ({meaning})", self.in_short())
    }
}

/// Why a kernel's verdict on a case differs from its obligation; none if it does not, or if the kernel
/// does not run in exact arithmetic.
pub fn attribute<F: Float>(
    subject: &dyn Subject<F>,
    case: &Case<F>,
    epsilons: &[F],
    truth: &Truth,
    (contract, obligation): (&Contract, Obligation),
) -> Option<Attribution> {
    let exact = || Some(subject.gated()?.run_exact(case, epsilons));
    attribute_with(
        subject,
        case,
        epsilons,
        truth,
        (contract, obligation),
        exact,
    )
}

/// The same with the run without rounding from elsewhere, which is asked for where it is needed.
pub fn attribute_with<F: Float>(
    subject: &dyn Subject<F>,
    case: &Case<F>,
    epsilons: &[F],
    truth: &Truth,
    (contract, obligation): (&Contract, Obligation),
    exact: impl FnOnce() -> Option<ExactRun>,
) -> Option<Attribution> {
    let subject = subject.gated()?;
    let gives = subject.info().gives;
    let right = |answer| judge_answer(obligation, truth, gives, answer).is_none();
    let given = subject.run_tracked(case, epsilons);
    let finding = judge((contract, obligation), (case, truth), gives, &given.verdict)?;
    // Which values a formula gives does not depend on its epsilons. They are asked for where they were wrong.
    let near = finding != Finding::WrongValue || {
        let values = subject.measure_exact(case).values;
        values.is_some_and(|hit| exact_values_are_near(case, gives, hit, contract.value_tolerance))
    };
    let right = |answer: Answer| right(Answer { near, ..answer });
    if right(without_rounding(
        contract,
        (case, truth, gives),
        &given,
        exact,
    )?) {
        let raised = match finding {
            Finding::BadValue | Finding::WrongValue => given.decision.and(given.values),
            _ => given.decision,
        };
        let range = raised.overflow || raised.underflow;
        return Some(if range {
            Attribution::Range
        } else {
            Attribution::Rounding
        });
    }
    if epsilons.iter().all(F::is_zero) {
        return Some(Attribution::Convention);
    }
    let zeros = vec![F::zero(); epsilons.len()];
    let zero = subject.run_tracked(case, &zeros);
    let answer = without_rounding(contract, (case, truth, gives), &zero, || {
        Some(subject.run_exact(case, &zeros))
    })?;
    Some(if right(answer) {
        Attribution::Epsilon
    } else {
        Attribution::Convention
    })
}

/// Why a kernel that does not show its formula is wrong on a case, as far as a run with every epsilon 0 tells; none
/// if it takes no epsilons.
pub fn attribute_by_running<F: Float>(
    subject: &dyn Subject<F>,
    info: &KernelInfo,
    case: &Case<F>,
    epsilons: &[F],
    truth: &Truth,
    (contract, obligation): (&Contract, Obligation),
) -> Option<Attribution> {
    if info.gates.iter().all(|gate| gate.epsilon == Tunable::Fixed) {
        return None;
    }
    let is_wrong = |epsilons: &[F]| {
        let mut verdict = [Verdict::miss(None)];
        verdicts_of(subject, slice::from_ref(case), epsilons, &mut verdict);
        judge(
            (contract, obligation),
            (case, truth),
            info.gives,
            &verdict[0],
        )
        .is_some()
    };
    let zeros = vec![F::zero(); epsilons.len()];
    Some(match epsilons != zeros && !is_wrong(&zeros) {
        true => Attribution::Epsilon,
        false => Attribution::NotEpsilon,
    })
}

/// The kernel's answer without rounding; the caller adds what it says of the values.
fn without_rounding<F: Float>(
    contract: &Contract,
    (case, truth, gives): (&Case<F>, &Truth, Gives),
    float: &TrackedRun<F>,
    exact: impl FnOnce() -> Option<ExactRun>,
) -> Option<Answer> {
    let answer = Answer::of(contract, (case, truth), gives, &float.verdict);
    let decided = !float.decision.inexact;
    if decided && !(answer.hit && float.values.inexact) {
        return Some(answer);
    }
    let exact = exact()?;
    if decided {
        return Some(Answer {
            finite: exact.finite,
            ..answer
        });
    }
    Some(Answer {
        hit: exact.hit(),
        finite: exact.finite,
        facing: exact.facing,
        ..answer
    })
}
