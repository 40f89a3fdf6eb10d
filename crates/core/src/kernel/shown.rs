//! The margins of kernels that are written once for every arithmetic, and their runs without rounding, with
//! exceptions, and as other machines compute. An audit without causes does not need them.

use super::gate::Either;
use super::recording::{Path, paths};
use super::runs::{ExactRun, Measured, TrackedRun};
use super::subject::Gated;
use super::{Deciding, Generic, Hit, Kernel, KernelInfo, Measuring, Verdict};
use crate::arith::{Arithmetic, Bounded, Emulated, Exact, Float, Real, Triple, bounded};
use crate::case::{Ray, Target};

/// A case in an arithmetic that is not the machine's own.
struct Lifted<R: Real, T: Target> {
    ray: Ray<Triple<R>>,
    shape: T::Shape<Triple<R>>,
}

impl<R: Real, T: Target> Lifted<R, T> {
    fn new<F: Float>(case: &T::Case<F>, number: impl Fn(F) -> R) -> Lifted<R, T> {
        let (ray, shape) = T::lift(case, number);
        Lifted { ray, shape }
    }

    /// Runs a kernel. One function takes both sinks and is not inlined: a kernel's code is large, and compiled for every
    /// arithmetic.
    #[inline(never)]
    fn test<K: Kernel<T>>(
        &self,
        sink: &mut Either<&mut Deciding<R>, &mut Measuring<R>>,
    ) -> Option<Hit<R>> {
        K::test(&K::prepare(&self.shape), &self.ray, sink)
    }
}

/// A run in an arithmetic that does not round. The scalars share that arithmetic, so a kernel is compiled once for both.
fn run<F: Float, T: Target, K: Kernel<T>, R: Real>(
    case: &T::Case<F>,
    epsilons: &[F],
    number: fn(f64) -> R,
) -> ExactRun {
    let lift = |x: F| number(x.to_f64());
    let epsilons: Vec<R> = epsilons.iter().map(|epsilon| lift(*epsilon)).collect();
    let mut sink = Deciding::watching(&epsilons);
    let lifted = Lifted::<R, T>::new(case, lift);
    let values = lifted.test::<K>(&mut Either::One(&mut sink));
    ExactRun::of(sink.passed, values)
}

/// A run in the machine's own arithmetic that takes margins or thresholds. It is not inlined, since a kernel's code is
/// large.
#[inline(never)]
fn measure<F: Float, T: Target, K: Kernel<T>>(
    case: &T::Case<F>,
    mut sink: Measuring<F>,
) -> Option<Hit<F>> {
    K::test(&K::prepare(T::shape(case)), T::ray(case), &mut sink)
}

/// Runs as another machine computes.
impl<T: Target, K: Kernel<T>> Generic<K, T> {
    fn number<F: Float>(&self, x: F) -> Emulated<F> {
        Emulated::new(x, self.arithmetic)
    }

    fn numbers<F: Float>(&self, values: &[F]) -> Vec<Emulated<F>> {
        values.iter().map(|x| self.number(*x)).collect()
    }

    fn vector<F: Float>(&self, vector: F::Vector) -> Triple<Emulated<F>> {
        let coordinates: [F; 3] = vector.into();
        coordinates.map(|x| self.number(x)).into()
    }

    fn lifted<F: Float>(&self, case: &T::Case<F>) -> Lifted<Emulated<F>, T> {
        Lifted::new(case, |x: F| self.number(x))
    }

    /// [`KernelIn::run`](super::KernelIn::run).
    pub(super) fn run_emulated<F: Float>(
        &self,
        cases: &[T::Case<F>],
        epsilons: &[F],
        verdicts: &mut [Verdict<F>],
    ) {
        let epsilons = self.numbers(epsilons);
        for (case, place) in cases.iter().zip(verdicts) {
            let mut sink = Deciding::new(&epsilons);
            let hit = self.lifted(case).test::<K>(&mut Either::One(&mut sink));
            *place = verdict(hit, sink.refused_by);
        }
    }

    /// [`KernelIn::run_polygon`](super::KernelIn::run_polygon).
    pub(super) fn run_polygon_emulated<F: Float>(
        &self,
        vertices: &[F::Vector],
        ray: &Ray<F::Vector>,
        epsilons: &[F],
    ) -> Verdict<F> {
        if vertices.is_empty() {
            return Verdict::miss(None);
        }
        let vertices: Vec<_> = vertices.iter().map(|v| self.vector::<F>(*v)).collect();
        let ray = Ray {
            origin: self.vector::<F>(ray.origin),
            direction: self.vector::<F>(ray.direction),
            t_min: self.number(ray.t_min),
            t_max: self.number(ray.t_max),
        };
        let epsilons = self.numbers(epsilons);
        let mut sink = Deciding::new(&epsilons);
        let hit = K::test_polygon(&vertices, &ray, &mut sink);
        verdict(hit, sink.refused_by)
    }

    /// Writes every gate's margin, or its threshold, into `margins`, one entry a gate; returns the values of a hit.
    pub(super) fn measure_into<F: Float>(
        &self,
        case: &T::Case<F>,
        margins: &mut [F],
        thresholds: bool,
    ) -> Option<Hit<F>> {
        if self.arithmetic == Arithmetic::IEEE {
            return measure::<F, T, K>(case, Measuring::new(margins, thresholds));
        }
        let mut emulated = self.numbers(margins);
        let mut sink = Measuring::new(&mut emulated, thresholds);
        let values = self.lifted(case).test::<K>(&mut Either::Other(&mut sink));
        for (place, number) in margins.iter_mut().zip(&emulated) {
            let margin = number.value();
            *place = if thresholds {
                margin
            } else {
                self.arithmetic.largest_epsilon(margin)
            };
        }
        values.map(|hit| hit.map(|x| x.value()))
    }
}

fn verdict<F: Float>(hit: Option<Hit<Emulated<F>>>, refused_by: Option<usize>) -> Verdict<F> {
    Verdict::of(hit.map(|hit| hit.map(|x| x.value())), refused_by)
}

impl<F: Float, T: Target, K: Kernel<T>> Gated<F, T> for Generic<K, T> {
    fn info(&self) -> &'static KernelInfo {
        self.info
    }

    fn measure(&self, case: &T::Case<F>) -> Measured<F> {
        let mut margins = vec![F::zero(); self.info.gates.len()];
        let values = self.measure_into(case, &mut margins, false);
        Measured { margins, values }
    }

    fn thresholds(&self, case: &T::Case<F>) -> Vec<F> {
        let mut thresholds = vec![F::zero(); self.info.gates.len()];
        self.measure_into(case, &mut thresholds, true);
        thresholds
    }

    fn measure_exact(&self, case: &T::Case<F>) -> Measured<Exact> {
        let lifted = Lifted::<_, T>::new(case, |x: F| Exact::from_f64(x.to_f64()));
        let mut margins = vec![Exact::zero(); self.info.gates.len()];
        let mut sink = Measuring::new(&mut margins, false);
        let values = lifted.test::<K>(&mut Either::Other(&mut sink));
        Measured { margins, values }
    }

    fn run_exact(&self, case: &T::Case<F>, epsilons: &[F]) -> ExactRun {
        let in_bounds = bounded(|| run::<F, T, K, _>(case, epsilons, Bounded::new));
        in_bounds.unwrap_or_else(|| run::<F, T, K, _>(case, epsilons, Exact::from_f64))
    }

    fn run_tracked(&self, case: &T::Case<F>, epsilons: &[F]) -> TrackedRun<F> {
        TrackedRun::of::<T, K>(case, epsilons, self.arithmetic)
    }

    fn paths(&self) -> Result<Vec<Path>, String> {
        paths::<T, K>(self.arithmetic)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::case::{Triangles, hard_cases};

    /// Runs of one kernel: the bounds decide as exact numbers do, or leave it. Of numbers with any exponents they
    /// leave most.
    fn bounds_decide_as_exact_numbers<F: crate::kernel::Scalar, K: Kernel>() {
        let (mut decided, mut runs) = (0, 0);
        for (index, case) in hard_cases::<F>(1, 1000).iter().enumerate() {
            let epsilon = F::from_f64([0.0, 1e-6][index % 2]);
            let epsilons = vec![epsilon; K::INFO.gates.len()];
            let exact = run::<F, Triangles, K, _>(case, &epsilons, Exact::from_f64);
            let near = bounded(|| run::<F, Triangles, K, _>(case, &epsilons, Bounded::new));
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
