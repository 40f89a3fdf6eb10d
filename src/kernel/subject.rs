//! Kernels behind one object-safe interface: what the audit and users' own kernels go through.

use super::gate::Either;
use super::margins::{by_running, each_case, of_miss, open_epsilons, values_of};
use super::recording::{Path, paths};
use super::variant::Variant;
use super::{Deciding, Failure, Hit, Kernel, KernelInfo, Measuring, Verdict, Watching};
use crate::arith::{
    Arithmetic, Bounded, Exact, Exceptions, Float, Real, Tracked, Triple, Vector, bounded, tracked,
};
use crate::case::{Case, Ray, Triangle};
use crate::truth::Facing;
use std::marker::PhantomData;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::slice;

/// The margins of one case, and the values computed along the way.
#[derive(Clone, Debug)]
pub struct Measured<R> {
    /// One margin a gate; +inf if the kernel never compared.
    pub margins: Vec<R>,
    /// What a hit would report.
    pub values: Option<Hit<R>>,
}

/// Every gate's margin into `margins`, one entry a gate. Not inlined: a kernel's code is large, and
/// compiled for every arithmetic.
#[inline(never)]
fn measure_into<K: Kernel, V: Vector>(
    ray: &Ray<V>,
    triangle: &Triangle<V>,
    margins: &mut [V::Real],
) -> Option<Hit<V::Real>> {
    K::test(&K::prepare(triangle), ray, &mut Measuring::new(margins))
}

/// A kernel's run without rounding, by the comparisons of its source.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ExactRun {
    /// Whether each gate passes.
    pub passed: Vec<bool>,
    /// Whether the values that a hit would report are numbers.
    pub finite: bool,
    /// The side that a hit would report.
    pub facing: Option<Facing>,
}

impl ExactRun {
    /// Whether it is a hit.
    pub fn hit(&self) -> bool {
        self.passed.iter().all(|passes| *passes)
    }

    fn of<R: Real>(passed: Vec<bool>, values: Option<Hit<R>>) -> ExactRun {
        let finite = values.as_ref().is_some_and(|Hit { t, uv, .. }| {
            t.iter().chain(uv.iter().flat_map(|(u, v)| [u, v])).all(R::is_finite)
        });
        ExactRun { passed, finite, facing: values.and_then(|hit| hit.facing) }
    }
}

/// A case and epsilons in an arithmetic that does not round. Both scalars share it as `f64`, so that a
/// kernel is compiled once for it.
struct Lifted<R: Real> {
    ray: Ray<Triple<R>>,
    triangle: Triangle<Triple<R>>,
    epsilons: Vec<R>,
}

impl<R: Real> Lifted<R> {
    fn new<F: Float>(case: &Case<F>, epsilons: &[F], number: fn(f64) -> R) -> Lifted<R> {
        let (ray, triangle) = case.widen().lift(number);
        Lifted { ray, triangle, epsilons: epsilons.iter().map(|e| number(e.to_f64())).collect() }
    }

    fn run<K: Kernel>(&self) -> ExactRun {
        let mut watching = Watching::new(&self.epsilons);
        let values = self.test::<K>(&mut Either::One(&mut watching));
        ExactRun::of(watching.passed, values)
    }

    fn measure<K: Kernel>(&self) -> Measured<R> {
        let mut margins = vec![R::zero(); K::INFO.gates.len()];
        let values = self.test::<K>(&mut Either::Other(&mut Measuring::new(&mut margins)));
        Measured { margins, values }
    }

    #[inline(never)]
    fn test<K: Kernel>(
        &self,
        sink: &mut Either<&mut Watching<R>, &mut Measuring<R>>,
    ) -> Option<Hit<R>> {
        K::test(&K::prepare(&self.triangle), &self.ray, sink)
    }
}

/// A kernel's float run, with the exceptions that it met.
#[derive(Clone, Copy, Debug)]
pub struct TrackedRun<F> {
    /// The verdict.
    pub verdict: Verdict<F>,
    /// Of the numbers behind its decisions.
    pub decision: Exceptions,
    /// Of the values of a hit.
    pub values: Exceptions,
}

impl<F: Float> TrackedRun<F> {
    /// The run of a kernel in some arithmetic.
    pub(super) fn of<K: Kernel>(
        case: &Case<F>,
        epsilons: &[F],
        arithmetic: Arithmetic,
    ) -> TrackedRun<F> {
        let (ray, triangle, epsilons) = TrackedRun::lift(case, epsilons, arithmetic);
        let mut sink = Deciding::new(&epsilons);
        let (hit, decision) = tracked(|| K::test(&K::prepare(&triangle), &ray, &mut sink));
        TrackedRun::new(hit, decision, sink.refused_by)
    }

    fn lift(case: &Case<F>, epsilons: &[F], arithmetic: Arithmetic) -> TrackedInput<F> {
        let number = |x: F| Tracked::new(x, arithmetic);
        let (ray, triangle) = case.lift(number);
        (ray, triangle, epsilons.iter().map(|e| number(*e)).collect())
    }

    fn new(
        hit: Option<Hit<Tracked<F>>>,
        decision: Exceptions,
        refused_by: Option<usize>,
    ) -> TrackedRun<F> {
        let values = hit.as_ref().map_or(Exceptions::default(), |Hit { t, uv, .. }| {
            let uv = uv.iter().flat_map(|(u, v)| [u, v]);
            t.iter().chain(uv).fold(Exceptions::default(), |sum, x| sum | x.raised())
        });
        let verdict = Verdict::of(hit.map(|hit| hit.map(|x| x.value())), refused_by);
        TrackedRun { verdict, decision, values }
    }
}

type TrackedInput<F> = (Ray<Triple<Tracked<F>>>, Triangle<Triple<Tracked<F>>>, Vec<Tracked<F>>);

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

    /// Whether [`Subject::margins`] is quick enough to be asked.
    fn tells_margins(&self) -> bool {
        true
    }

    /// Every gate's margin on each case, one entry a gate for each case in turn, and what a hit would report,
    /// unless `values` is empty.
    ///
    /// Where gates are not shown the kernel runs at many epsilons. Then margins are -inf if it misses whatever
    /// the epsilons are, and NaN if it fails at some.
    fn margins(
        &self,
        info: &KernelInfo,
        cases: &[Case<F>],
        margins: &mut [F],
        values: &mut [Option<Hit<F>>],
    ) {
        let open = open_epsilons(info);
        each_case(info, cases, margins, values, |case, margins| {
            let verdict = |epsilons: &[F]| {
                let mut verdict = [Verdict::miss(None)];
                self.run(slice::from_ref(case), epsilons, &mut verdict);
                verdict[0]
            };
            let is_hit = |epsilons: &[F]| verdict(epsilons).hit;
            let measured = catch_unwind(AssertUnwindSafe(|| {
                let values = values_of(info, &verdict(&open));
                match values {
                    Some(_) => by_running(&open, is_hit, margins),
                    None => of_miss(&open, is_hit, margins),
                }
                values
            }));
            measured.unwrap_or_else(|_| {
                margins.fill(F::from_f64(f64::NAN));
                None
            })
        });
    }

    /// Why no more margins are found, in one line.
    fn margins_gave_up(&self) -> Option<String> {
        None
    }

    /// What should be known beside its verdicts, which stand; each in one line.
    fn notes(&self) -> Vec<String> {
        Vec::new()
    }

    /// Why its verdicts are invalid from some case on, in one line.
    fn gave_up(&self) -> Option<String> {
        None
    }
}

/// Runs a kernel on all cases; a panic is the verdict on the case at which it happens. Returns the
/// nanoseconds in it, if it measures them itself.
pub(crate) fn verdicts_of<F: Float>(
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
    /// What it is and what it promises.
    fn info(&self) -> &'static KernelInfo;

    /// Every gate's margin on a case, and the values of a hit.
    fn measure(&self, case: &Case<F>) -> Measured<F>;

    /// Every gate's threshold on a case: the least upper bound of the epsilons that it accepts, whether
    /// or not it accepts the bound itself.
    fn thresholds(&self, case: &Case<F>) -> Vec<F>;

    /// Every gate's margin on a case, in exact arithmetic, where it is also the threshold.
    fn measure_exact(&self, case: &Case<F>) -> Measured<Exact>;

    /// The run without rounding; none if the kernel does not run in exact arithmetic.
    fn run_exact(&self, _case: &Case<F>, _epsilons: &[F]) -> Option<ExactRun> {
        None
    }

    /// The run of [`Subject::run`] with its exceptions; none if the kernel does not run in tracked numbers.
    fn run_tracked(&self, _case: &Case<F>, _epsilons: &[F]) -> Option<TrackedRun<F>> {
        None
    }

    /// Its straight-line programs, one a path; an error in one sentence if they cannot be recorded.
    fn paths(&self) -> Result<Vec<Path>, String> {
        Err("it is not written for every arithmetic".to_owned())
    }
}

/// A [`Kernel`], written for every arithmetic, as a [`Subject`] of either scalar.
pub struct Generic<K>(PhantomData<fn() -> K>);

impl<K> Generic<K> {
    /// The only value.
    pub const SUBJECT: Generic<K> = Generic(PhantomData);
}

impl<F: Float, K: Kernel> Subject<F> for Generic<K> {
    fn run(&self, cases: &[Case<F>], epsilons: &[F], verdicts: &mut [Verdict<F>]) {
        for (case, verdict) in cases.iter().zip(verdicts) {
            let mut sink = Deciding::new(epsilons);
            let hit = K::test(&K::prepare(&case.triangle), &case.ray, &mut sink);
            *verdict = Verdict::of(hit, sink.refused_by);
        }
    }

    fn run_polygon(
        &self,
        vertices: &[F::Vector],
        ray: &Ray<F::Vector>,
        epsilons: &[F],
    ) -> Verdict<F> {
        let mut sink = Deciding::new(epsilons);
        let hit = K::test_polygon(vertices, ray, &mut sink);
        Verdict::of(hit, sink.refused_by)
    }

    fn gated(&self) -> Option<&dyn Gated<F>> {
        Some(self)
    }

    fn margins(
        &self,
        info: &KernelInfo,
        cases: &[Case<F>],
        margins: &mut [F],
        values: &mut [Option<Hit<F>>],
    ) {
        each_case(info, cases, margins, values, |case, margins| {
            measure_into::<K, F::Vector>(&case.ray, &case.triangle, margins)
        });
    }

    fn in_arithmetic(
        &self,
        arithmetic: Arithmetic,
        info: &'static KernelInfo,
    ) -> Option<&'static dyn Subject<F>> {
        Some(Box::leak(Box::new(Variant::<K>::new(arithmetic, info))))
    }
}

impl<F: Float, K: Kernel> Gated<F> for Generic<K> {
    fn info(&self) -> &'static KernelInfo {
        &const { K::INFO }
    }

    fn measure(&self, case: &Case<F>) -> Measured<F> {
        let mut margins = vec![F::zero(); K::INFO.gates.len()];
        let values = measure_into::<K, F::Vector>(&case.ray, &case.triangle, &mut margins);
        Measured { margins, values }
    }

    fn thresholds(&self, case: &Case<F>) -> Vec<F> {
        let mut thresholds = vec![F::zero(); K::INFO.gates.len()];
        let mut sink = Measuring::thresholds(&mut thresholds);
        K::test(&K::prepare(&case.triangle), &case.ray, &mut sink);
        thresholds
    }

    fn measure_exact(&self, case: &Case<F>) -> Measured<Exact> {
        Lifted::new(case, &[], Exact::from_f64).measure::<K>()
    }

    fn run_exact(&self, case: &Case<F>, epsilons: &[F]) -> Option<ExactRun> {
        let near = Lifted::new(case, epsilons, Bounded::new);
        let exact = || Lifted::new(case, epsilons, Exact::from_f64).run::<K>();
        Some(bounded(|| near.run::<K>()).unwrap_or_else(exact))
    }

    fn run_tracked(&self, case: &Case<F>, epsilons: &[F]) -> Option<TrackedRun<F>> {
        Some(TrackedRun::of::<K>(case, epsilons, Arithmetic::IEEE))
    }

    fn paths(&self) -> Result<Vec<Path>, String> {
        paths::<K>(Arithmetic::IEEE)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::case::Parameters;
    use crate::family::FAMILIES;

    /// Runs of one kernel on all families: the bounds decide as exact numbers do, or leave it.
    fn bounds_decide_as_exact_numbers<F: crate::kernel::Scalar, K: Kernel>() {
        let (mut decided, mut runs) = (0, 0);
        for family in FAMILIES {
            for index in 0..40 {
                let epsilon = F::from_f64([0.0, 1e-6][index as usize % 2]);
                let epsilons = vec![epsilon; K::INFO.gates.len()];
                for case in family.make::<F>(&Parameters::default(), 1, index).cases() {
                    let exact = Lifted::new(case, &epsilons, Exact::from_f64).run::<K>();
                    let near = Lifted::new(case, &epsilons, Bounded::new);
                    let near = bounded(|| near.run::<K>());
                    runs += 1;
                    if let Some(near) = near {
                        decided += 1;
                        assert_eq!(near, exact, "{} {}", K::INFO.name, case.hex());
                    }
                }
            }
        }
        assert!(decided * 2 > runs, "{}: {decided} of {runs}", K::INFO.name);
    }

    #[test]
    fn bounds_decide_most_runs_of_every_kind_of_kernel_as_exact_numbers_do() {
        use crate::kernel::*;
        bounds_decide_as_exact_numbers::<f32, plane_unit_normal::PlaneUnitNormal>();
        bounds_decide_as_exact_numbers::<f64, plane_unit_normal::PlaneUnitNormal>();
        bounds_decide_as_exact_numbers::<f32, half_space::HalfSpace>();
        bounds_decide_as_exact_numbers::<f64, scalar_triple::ScalarTripleTwoSided>();
        bounds_decide_as_exact_numbers::<f32, cramer::Cramer>();
        bounds_decide_as_exact_numbers::<f64, plane_inside_out::PlaneInsideOut>();
        bounds_decide_as_exact_numbers::<f32, moller_trumbore::MollerTrumbore>();
        bounds_decide_as_exact_numbers::<f64, woop_watertight::WoopWatertight>();
        bounds_decide_as_exact_numbers::<f64, plucker::Plucker>();
        bounds_decide_as_exact_numbers::<f32, baldwin_weber::BaldwinWeber>();
        bounds_decide_as_exact_numbers::<f64, havel_herout::HavelHerout>();
    }
}
