//! Your own kernel in one scalar, from a closure or a small trait.

use super::{Hit, Subject, Verdict};
use crate::arith::Float;
use crate::case::Case;

/// A ray–triangle test in one scalar. Any closure of the same signature is one.
///
/// It is a function of its arguments: the same case and epsilons give the same answer, on any thread.
pub trait Test<F: Float>: Send + Sync {
    /// The hit that it reports, or none. `epsilons` has one entry for each gate of its
    /// [`KernelInfo`](super::KernelInfo). A panic is a finding.
    fn test(&self, case: &Case<F>, epsilons: &[F]) -> Option<Hit<F>>;
}

impl<F, T> Test<F> for T
where
    F: Float,
    T: Fn(&Case<F>, &[F]) -> Option<Hit<F>> + Send + Sync,
{
    fn test(&self, case: &Case<F>, epsilons: &[F]) -> Option<Hit<F>> {
        self(case, epsilons)
    }
}

/// A [`Test`] as a [`Subject`].
pub(super) struct Own<T>(pub T);

impl<F: Float, T: Test<F>> Subject<F> for Own<T> {
    fn run(&self, cases: &[Case<F>], epsilons: &[F], verdicts: &mut [Verdict<F>]) {
        for (case, verdict) in cases.iter().zip(verdicts) {
            *verdict = Verdict::of(self.0.test(case, epsilons), None);
        }
    }
}
