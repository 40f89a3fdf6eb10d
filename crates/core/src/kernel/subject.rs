//! Kernels behind one object-safe interface: what the audit and users' own kernels go through.

use super::margins::{by_running, each_case, open_epsilons, values_of};
use super::recording::Path;
use super::runs::{ExactRun, Measured, TrackedRun};
use super::{Failure, Hit, KernelInfo, Verdict};
use crate::arith::{Arithmetic, Exact, Float};
use crate::case::{Case, Ray};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::slice;

/// A kernel in one scalar: all that an audit needs.
pub trait Subject<F: Float>: Sync {
    /// The verdict on each case; `epsilons` has one entry a gate, `verdicts` one a case.
    fn run(&self, cases: &[Case<F>], epsilons: &[F], verdicts: &mut [Verdict<F>]);

    /// The same, and the nanoseconds that went by in the kernel, if it measures them itself: what runs in a
    /// process of its own does.
    fn run_timed(
        &self,
        cases: &[Case<F>],
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
    fn gated(&self) -> Option<&dyn Gated<F>> {
        None
    }

    /// The same kernel in another arithmetic, called by another name; none of a kernel that is not
    /// written for every arithmetic. It lives as long as the process.
    fn in_arithmetic(
        &self,
        _arithmetic: Arithmetic,
        _info: &'static KernelInfo,
    ) -> Option<&'static dyn Subject<F>> {
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
        cases: &[Case<F>],
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
pub(super) fn margins_by_running<F: Float, S: Subject<F> + ?Sized>(
    subject: &S,
    info: &KernelInfo,
    cases: &[Case<F>],
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
pub fn verdicts_of<F: Float>(
    subject: &dyn Subject<F>,
    cases: &[Case<F>],
    epsilons: &[F],
    verdicts: &mut [Verdict<F>],
) -> Option<u64> {
    let run = |cases: &[Case<F>], verdicts: &mut [Verdict<F>]| {
        catch_unwind(AssertUnwindSafe(|| subject.run_timed(cases, epsilons, verdicts)))
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
pub trait Gated<F: Float>: Sync {
    /// The description of the kernel, with its promise.
    fn info(&self) -> &'static KernelInfo;

    /// Every gate's margin on a case, and the values of a hit.
    fn measure(&self, case: &Case<F>) -> Measured<F>;

    /// Every gate's threshold on a case: the least upper bound of the epsilons that it accepts, whether
    /// or not it accepts the bound itself.
    fn thresholds(&self, case: &Case<F>) -> Vec<F>;

    /// Every gate's margin on a case, in exact arithmetic, where it is also the threshold.
    fn measure_exact(&self, case: &Case<F>) -> Measured<Exact>;

    /// The run without rounding.
    fn run_exact(&self, case: &Case<F>, epsilons: &[F]) -> ExactRun;

    /// The run of [`Subject::run`] with its exceptions.
    fn run_tracked(&self, case: &Case<F>, epsilons: &[F]) -> TrackedRun<F>;

    /// Its straight-line programs, one a path; an error in one sentence if they cannot be recorded.
    fn paths(&self) -> Result<Vec<Path>, String>;
}
