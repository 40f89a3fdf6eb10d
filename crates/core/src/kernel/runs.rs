//! The results of runs that show more than a verdict: margins, a run without rounding, a run with its exceptions.

use super::{Deciding, Hit, Kernel, Verdict};
use crate::arith::{Arithmetic, Exceptions, Float, Notes, Real, Tracked, tracked};
use crate::case::Target;
use crate::truth::Facing;

/// The margins of one case, and the values computed along the way.
#[derive(Clone, Debug)]
pub struct Measured<R> {
    /// One margin a gate; +inf if the kernel never compared.
    pub margins: Vec<R>,
    /// The values that a hit would report.
    pub values: Option<Hit<R>>,
}

/// A kernel's run without rounding, by the comparisons of its source.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ExactRun {
    /// One flag a gate: true if the gate passes.
    pub passed: Vec<bool>,
    /// True if the values that a hit would report are numbers.
    pub finite: bool,
    /// The side that a hit would report.
    pub facing: Option<Facing>,
}

impl ExactRun {
    /// The first gate that refuses; none if it hits.
    pub fn refused_by(&self) -> Option<usize> {
        self.passed.iter().position(|passes| !passes)
    }

    /// True if it is a hit.
    pub fn hit(&self) -> bool {
        self.refused_by().is_none()
    }

    /// The run in which these gates passed, with the values that its hit would report.
    pub(super) fn of<R: Real>(passed: Vec<bool>, values: Option<Hit<R>>) -> ExactRun {
        let finite = values
            .as_ref()
            .is_some_and(|hit| hit.numbers().all(R::is_finite));
        ExactRun {
            passed,
            finite,
            facing: values.and_then(|hit| hit.facing),
        }
    }
}

/// A kernel's float run, with the exceptions that it met.
#[derive(Clone, Copy, Debug)]
pub struct TrackedRun<F> {
    /// The verdict.
    pub verdict: Verdict<F>,
    /// The exceptions of the numbers behind its decisions.
    pub decision: Exceptions,
    /// The exceptions of the values of a hit.
    pub values: Exceptions,
}

impl<F: Float> TrackedRun<F> {
    /// The run of a kernel in some arithmetic.
    pub(super) fn of<T: Target, K: Kernel<T>>(
        case: &T::Case<F>,
        epsilons: &[F],
        arithmetic: Arithmetic,
    ) -> TrackedRun<F> {
        let track = |x: F| Tracked::new(x, arithmetic);
        let (ray, shape) = T::lift(case, track);
        let epsilons: Vec<_> = epsilons.iter().map(|e| track(*e)).collect();
        let mut sink = Deciding::new(&epsilons);
        let (hit, decision) = tracked(|| K::test(&K::prepare(&shape), &ray, &mut sink));
        let mut values = Exceptions::default();
        for number in hit.iter().flat_map(Hit::numbers) {
            values = values.and(number.notes());
        }
        let hit = hit.map(|hit| hit.map(|number| number.value()));
        TrackedRun {
            verdict: Verdict::of(hit, sink.refused_by),
            decision,
            values,
        }
    }
}
