//! Kernels behind one object-safe interface: what the audit and users' own kernels go through. And your own kernel in one
//! scalar, from a closure or a small trait.

use super::margins::{by_running, each_case, open_epsilons, values_of};
use super::recording::Path;
use super::runs::{ExactRun, Measured, TrackedRun};
use super::{Failure, Hit, KernelInfo, Verdict};
use crate::arith::{Arithmetic, Exact, Float};
use crate::case::{Ray, Target, Triangles};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::slice;
use std::sync::atomic::{AtomicU64, Ordering};

/// A kernel in one scalar: all that an audit needs.
pub trait Subject<F: Float, T: Target = Triangles>: Sync {
    /// The verdict on each case; `epsilons` has one entry a gate, `verdicts` one a case.
    fn run(&self, cases: &[T::Case<F>], epsilons: &[F], verdicts: &mut [Verdict<F>]);

    /// The same, and the nanoseconds that went by in the kernel, if it measures them itself: what runs in a
    /// process of its own does.
    fn run_timed(
        &self,
        cases: &[T::Case<F>],
        epsilons: &[F],
        verdicts: &mut [Verdict<F>],
    ) -> Option<u64> {
        self.run(cases, epsilons, verdicts);
        None
    }

    /// The verdict on a planar convex polygon; a miss if the kernel takes none.
    fn run_polygon(
        &self,
        _vertices: &[F::Vector],
        _ray: &Ray<F::Vector>,
        _epsilons: &[F],
    ) -> Verdict<F> {
        Verdict::miss(None)
    }

    /// Its gates, if it shows them. A kernel that does not is audited at the epsilons that it takes.
    fn gated(&self) -> Option<&dyn Gated<F, T>> {
        None
    }

    /// The same kernel in another arithmetic, called by another name; none of a kernel that is not
    /// written for every arithmetic. It lives as long as the process.
    fn in_arithmetic(
        &self,
        _arithmetic: Arithmetic,
        _info: &'static KernelInfo,
    ) -> Option<&'static dyn Subject<F, T>> {
        None
    }

    /// True if [`Subject::margins`] is quick enough to be used.
    fn tells_margins(&self) -> bool {
        true
    }

    /// Every gate's margin on each case, one entry a gate for each case in turn, and what a hit would report,
    /// unless `values` is empty.
    ///
    /// Where gates are not shown the kernel runs at many epsilons. Then margins are -inf if it misses whatever
    /// the epsilons are, and NaN if it fails at some.
    #[cfg(feature = "margins")]
    fn margins(
        &self,
        info: &KernelInfo,
        cases: &[T::Case<F>],
        margins: &mut [F],
        values: &mut [Option<Hit<F>>],
    ) {
        margins_by_running(self, info, cases, margins, values);
    }

    /// Why no more margins are found, in one line.
    fn margins_gave_up(&self) -> Option<String> {
        None
    }

    /// Notes on it, besides its verdicts, which stand; each in one line.
    fn notes(&self) -> Vec<String> {
        Vec::new()
    }

    /// Ends what it started; more verdicts start it again.
    fn finish(&self) {}

    /// True if it wrote something for people, which answers to more cases would bury.
    fn talks(&self) -> bool {
        false
    }

    /// Why its verdicts are invalid from some case on, in one line.
    fn gave_up(&self) -> Option<String> {
        None
    }
}

/// [`Subject::margins`] of a kernel that does not show its gates: found by running it.
fn margins_by_running<F: Float, T: Target, S: Subject<F, T> + ?Sized>(
    subject: &S,
    info: &KernelInfo,
    cases: &[T::Case<F>],
    margins: &mut [F],
    values: &mut [Option<Hit<F>>],
) {
    let open = open_epsilons(info);
    each_case(info, cases, margins, values, |case, margins| {
        let verdict = |epsilons: &[F]| {
            let mut verdict = [Verdict::miss(None)];
            subject.run(slice::from_ref(case), epsilons, &mut verdict);
            verdict[0]
        };
        let is_hit = |epsilons: &[F]| verdict(epsilons).hit;
        let measured = catch_unwind(AssertUnwindSafe(|| {
            let values = values_of(info, &verdict(&open));
            by_running(&open, values.is_some(), is_hit, margins);
            values
        }));
        measured.unwrap_or_else(|_| {
            margins.fill(F::from_f64(f64::NAN));
            None
        })
    });
}

/// Runs a kernel on all cases; a panic is the verdict on the case at which it happens. Returns the
/// nanoseconds in it, if it measures them itself.
pub fn verdicts_of<F: Float, T: Target>(
    subject: &dyn Subject<F, T>,
    cases: &[T::Case<F>],
    epsilons: &[F],
    verdicts: &mut [Verdict<F>],
) -> Option<u64> {
    let run = |cases: &[T::Case<F>], verdicts: &mut [Verdict<F>]| {
        catch_unwind(AssertUnwindSafe(|| {
            subject.run_timed(cases, epsilons, verdicts)
        }))
    };
    if let Ok(took) = run(cases, verdicts) {
        return took;
    }
    // Once more, one by one, to pin the cases at which it panicked.
    for i in 0..cases.len() {
        if run(&cases[i..=i], &mut verdicts[i..=i]).is_err() {
            verdicts[i] = Verdict::failed(Failure::Panic);
        }
    }
    None
}

/// A kernel that shows its gates: each one's margin, and its formula without rounding.
pub trait Gated<F: Float, T: Target = Triangles>: Sync {
    /// The description of the kernel, with its promise.
    fn info(&self) -> &'static KernelInfo;

    /// Every gate's margin on a case, and the values of a hit.
    fn measure(&self, case: &T::Case<F>) -> Measured<F>;

    /// Every gate's threshold on a case: the least upper bound of the epsilons that it accepts, whether
    /// or not it accepts the bound itself.
    fn thresholds(&self, case: &T::Case<F>) -> Vec<F>;

    /// Every gate's margin on a case, in exact arithmetic, where it is also the threshold.
    fn measure_exact(&self, case: &T::Case<F>) -> Measured<Exact>;

    /// The run without rounding.
    fn run_exact(&self, case: &T::Case<F>, epsilons: &[F]) -> ExactRun;

    /// The run of [`Subject::run`] with its exceptions.
    fn run_tracked(&self, case: &T::Case<F>, epsilons: &[F]) -> TrackedRun<F>;

    /// Its straight-line programs, one a path; an error in one sentence if they cannot be recorded.
    fn paths(&self) -> Result<Vec<Path>, String>;
}

/// A test in one scalar, of a ray and a triangle or of another target. Any closure of the same signature is one.
///
/// It is a function of its arguments: the same case and epsilons give the same answer, on any thread.
pub trait Test<F: Float, T: Target = Triangles>: Send + Sync {
    /// The hit that it reports, or none. `epsilons` has one entry for each gate of its
    /// [`KernelInfo`](super::KernelInfo). A panic is a finding.
    fn test(&self, case: &T::Case<F>, epsilons: &[F]) -> Option<Hit<F>>;
}

impl<F, T, C> Test<F, T> for C
where
    F: Float,
    T: Target,
    C: Fn(&T::Case<F>, &[F]) -> Option<Hit<F>> + Send + Sync,
{
    fn test(&self, case: &T::Case<F>, epsilons: &[F]) -> Option<Hit<F>> {
        self(case, epsilons)
    }
}

/// A [`Test`] as a [`Subject`].
pub(super) struct Own<C> {
    test: C,
    /// Cases without margins, because it panics at some epsilon.
    without_margins: AtomicU64,
}

impl<C> Own<C> {
    pub fn new(test: C) -> Own<C> {
        Own {
            test,
            without_margins: AtomicU64::new(0),
        }
    }
}

impl<F: Float, T: Target, C: Test<F, T>> Subject<F, T> for Own<C> {
    fn run(&self, cases: &[T::Case<F>], epsilons: &[F], verdicts: &mut [Verdict<F>]) {
        for (case, verdict) in cases.iter().zip(verdicts) {
            *verdict = Verdict::of(self.test.test(case, epsilons), None);
        }
    }

    #[cfg(feature = "margins")]
    fn margins(
        &self,
        info: &KernelInfo,
        cases: &[T::Case<F>],
        margins: &mut [F],
        values: &mut [Option<Hit<F>>],
    ) {
        margins_by_running(self, info, cases, margins, values);
        let rows = margins.chunks(info.gates.len().max(1));
        let panicked = rows
            .filter(|row| row.iter().any(|margin| margin.is_nan()))
            .count();
        self.without_margins
            .fetch_add(panicked as u64, Ordering::Relaxed);
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
            printed: None,
            dimension: Dimension::new(2, 1),
            epsilon: Tunable::NonNegative,
        }];
        const INFO: KernelInfo = KernelInfo {
            gates: GATES,
            epsilon_sets: &[EpsilonSet {
                name: "own",
                values: &["0"],
            }],
            ..KernelInfo::own("panics", Contract::CLOSED_RAY)
        };
        let entry = Entry::new(&INFO).f32(|case: &Case<f32>, epsilons: &[f32]| {
            assert!(epsilons[0] < 1.0 || 0.0 < case.ray.origin.x);
            Some(Hit::at(1.0))
        });
        let cases: Vec<Case<f32>> = hard_cases(1, 50);
        assert_eq!(entry.notes(), [""; 0]);
        let mut margins = vec![0.0; cases.len()];
        f32::subject(&entry)
            .unwrap()
            .margins(&INFO, &cases, &mut margins, &mut []);
        let panicked = cases.iter().filter(|case| case.ray.origin.x <= 0.0).count();
        assert!(5 < panicked && panicked < 45);
        assert!(
            entry.notes()[0].starts_with(&format!("on {panicked} cases it panics at some epsilon"))
        );
    }
}
