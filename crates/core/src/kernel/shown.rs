//! The margins of kernels that are written once for every arithmetic, and their runs without rounding
//! and with exceptions. An audit without causes does not need them.

use super::gate::Either;
use super::recording::{Path, paths};
use super::runs::{ExactRun, Measured, TrackedRun};
use super::subject::Gated;
use super::{Deciding, Generic, Hit, Kernel, KernelInfo, Measuring};
use crate::arith::{Arithmetic, Bounded, Exact, Float, Real, Triple, Vector, bounded};
use crate::case::{Case, Ray, Triangle};

/// Every gate's margin into `margins`, one entry a gate. Not inlined: a kernel's code is large, and
/// compiled for every arithmetic.
#[inline(never)]
pub(super) fn measure_into<K: Kernel, V: Vector>(
    ray: &Ray<V>,
    triangle: &Triangle<V>,
    margins: &mut [V::Real],
) -> Option<Hit<V::Real>> {
    K::test(&K::prepare(triangle), ray, &mut Measuring::new(margins))
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
        let mut watching = Deciding::watching(&self.epsilons);
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
        sink: &mut Either<&mut Deciding<R>, &mut Measuring<R>>,
    ) -> Option<Hit<R>> {
        K::test(&K::prepare(&self.triangle), &self.ray, sink)
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

    fn run_exact(&self, case: &Case<F>, epsilons: &[F]) -> ExactRun {
        let near = Lifted::new(case, epsilons, Bounded::new);
        let exact = || Lifted::new(case, epsilons, Exact::from_f64).run::<K>();
        bounded(|| near.run::<K>()).unwrap_or_else(exact)
    }

    fn run_tracked(&self, case: &Case<F>, epsilons: &[F]) -> TrackedRun<F> {
        TrackedRun::of::<K>(case, epsilons, Arithmetic::IEEE)
    }

    fn paths(&self) -> Result<Vec<Path>, String> {
        paths::<K>(Arithmetic::IEEE)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::case::hard_cases;

    /// Runs of one kernel: the bounds decide as exact numbers do, or leave it. Of numbers with any exponents they
    /// leave most.
    fn bounds_decide_as_exact_numbers<F: crate::kernel::Scalar, K: Kernel>() {
        let (mut decided, mut runs) = (0, 0);
        for (index, case) in hard_cases::<F>(1, 1000).iter().enumerate() {
            let epsilon = F::from_f64([0.0, 1e-6][index % 2]);
            let epsilons = vec![epsilon; K::INFO.gates.len()];
            let exact = Lifted::new(case, &epsilons, Exact::from_f64).run::<K>();
            let near = Lifted::new(case, &epsilons, Bounded::new);
            let near = bounded(|| near.run::<K>());
            let is_ordinary = index % 4 != 3;
            runs += usize::from(is_ordinary);
            if let Some(near) = near {
                decided += usize::from(is_ordinary);
                assert_eq!(near, exact, "{} {}", K::INFO.name, case.hex());
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
