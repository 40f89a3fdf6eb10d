//! Your own kernel in one scalar, from a closure or a small trait.

use super::subject::margins_by_running;
use super::{Hit, KernelInfo, Subject, Verdict};
use crate::arith::Float;
use crate::case::Case;
use std::sync::atomic::{AtomicU64, Ordering};

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
pub(super) struct Own<T> {
    test: T,
    /// Cases without margins, because it panics at some epsilon.
    without_margins: AtomicU64,
}

impl<T> Own<T> {
    pub fn new(test: T) -> Own<T> {
        Own { test, without_margins: AtomicU64::new(0) }
    }
}

impl<F: Float, T: Test<F>> Subject<F> for Own<T> {
    fn run(&self, cases: &[Case<F>], epsilons: &[F], verdicts: &mut [Verdict<F>]) {
        for (case, verdict) in cases.iter().zip(verdicts) {
            *verdict = Verdict::of(self.test.test(case, epsilons), None);
        }
    }

    #[cfg(feature = "margins")]
    fn margins(
        &self,
        info: &KernelInfo,
        cases: &[Case<F>],
        margins: &mut [F],
        values: &mut [Option<Hit<F>>],
    ) {
        margins_by_running(self, info, cases, margins, values);
        let rows = margins.chunks(info.gates.len().max(1));
        let panicked = rows.filter(|row| row.iter().any(|margin| margin.is_nan())).count();
        self.without_margins.fetch_add(panicked as u64, Ordering::Relaxed);
    }

    fn notes(&self) -> Vec<String> {
        match self.without_margins.load(Ordering::Relaxed) {
            0 => Vec::new(),
            count => vec![format!(
                "on {count} cases it panics at some epsilon, and they are left out of what epsilons do"
            )],
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::case::{Case, hard_cases};
    use crate::contract::Contract;
    use crate::kernel::{
        Dimension, Entry, EpsilonSet, Gate, Hit, KernelInfo, Role, Scalar, Tunable,
    };

    #[cfg(feature = "margins")]
    #[test]
    fn a_panic_at_some_epsilon_is_noted() {
        const GATES: &[Gate] = &[Gate {
            name: "parallel",
            role: Role::Parallel,
            refuses: "det < e",
            dimension: Dimension::new(2, 1),
            epsilon: Tunable::NonNegative,
        }];
        const INFO: KernelInfo = KernelInfo {
            gates: GATES,
            epsilon_sets: &[EpsilonSet { name: "own", values: &["0"] }],
            ..KernelInfo::own("panics", Contract::CLOSED_RAY)
        };
        let entry = Entry::new(&INFO).f32(|case: &Case<f32>, epsilons: &[f32]| {
            assert!(epsilons[0] < 1.0 || 0.0 < case.ray.origin.x);
            Some(Hit::at(1.0))
        });
        let cases: Vec<Case<f32>> = hard_cases(1, 50);
        assert_eq!(entry.notes(), [""; 0]);
        let mut margins = vec![0.0; cases.len()];
        f32::subject(&entry).unwrap().margins(&INFO, &cases, &mut margins, &mut []);
        let panicked = cases.iter().filter(|case| case.ray.origin.x <= 0.0).count();
        assert!(5 < panicked && panicked < 45);
        assert!(
            entry.notes()[0].starts_with(&format!("on {panicked} cases it panics at some epsilon"))
        );
    }
}
