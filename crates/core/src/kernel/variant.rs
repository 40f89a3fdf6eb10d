//! A kernel in another arithmetic than IEEE 754's: the same source on another machine.

use super::gate::Either;
use super::margins::each_case;
use super::recording::{Path, paths};
use super::{
    Deciding, ExactRun, Gated, Generic, Hit, Kernel, KernelInfo, Measured, Measuring, Subject,
    TrackedRun, Verdict,
};
use crate::arith::{Arithmetic, Emulated, Exact, Float, Triple};
use crate::case::{Case, Ray, Triangle};
use std::marker::PhantomData;

/// A [`Kernel`] in some [`Arithmetic`], as a [`Subject`] of either scalar. Without rounding it is the
/// same kernel: its exact runs are those of [`Generic`].
pub(super) struct Variant<K> {
    arithmetic: Arithmetic,
    info: &'static KernelInfo,
    kernel: PhantomData<fn() -> K>,
}

impl<K: Kernel> Variant<K> {
    pub fn new(arithmetic: Arithmetic, info: &'static KernelInfo) -> Variant<K> {
        Variant { arithmetic, info, kernel: PhantomData }
    }

    fn measure_into<F: Float>(&self, case: &Case<F>, margins: &mut [F]) -> Option<Hit<F>> {
        let (ray, triangle) = lift(case, self.arithmetic);
        let mut emulated = numbers(margins, self.arithmetic);
        let mut sink = Measuring::new(&mut emulated);
        let values = test::<F, K>(&ray, &triangle, &mut Either::Other(&mut sink));
        for (margin, emulated) in margins.iter_mut().zip(&emulated) {
            *margin = self.arithmetic.largest_epsilon(emulated.value());
        }
        values.map(|hit| hit.map(|x| x.value()))
    }
}

type EmulatedVector<F> = Triple<Emulated<F>>;

fn lift<F: Float>(
    case: &Case<F>,
    arithmetic: Arithmetic,
) -> (Ray<EmulatedVector<F>>, Triangle<EmulatedVector<F>>) {
    case.lift(|x| Emulated::new(x, arithmetic))
}

fn numbers<F: Float>(values: &[F], arithmetic: Arithmetic) -> Vec<Emulated<F>> {
    values.iter().map(|x| Emulated::new(*x, arithmetic)).collect()
}

/// Not inlined, and one for both sinks: a kernel's code is large.
#[inline(never)]
fn test<F: Float, K: Kernel>(
    ray: &Ray<EmulatedVector<F>>,
    triangle: &Triangle<EmulatedVector<F>>,
    sink: &mut Either<&mut Deciding<Emulated<F>>, &mut Measuring<Emulated<F>>>,
) -> Option<Hit<Emulated<F>>> {
    K::test(&K::prepare(triangle), ray, sink)
}

fn verdict<F: Float>(hit: Option<Hit<Emulated<F>>>, refused_by: Option<usize>) -> Verdict<F> {
    Verdict::of(hit.map(|hit| hit.map(|x| x.value())), refused_by)
}

impl<F: Float, K: Kernel> Subject<F> for Variant<K> {
    fn run(&self, cases: &[Case<F>], epsilons: &[F], verdicts: &mut [Verdict<F>]) {
        let epsilons = numbers(epsilons, self.arithmetic);
        for (case, place) in cases.iter().zip(verdicts) {
            let (ray, triangle) = lift(case, self.arithmetic);
            let mut sink = Deciding::new(&epsilons);
            let hit = test::<F, K>(&ray, &triangle, &mut Either::One(&mut sink));
            *place = verdict(hit, sink.refused_by);
        }
    }

    fn run_polygon(
        &self,
        vertices: &[F::Vector],
        ray: &Ray<F::Vector>,
        epsilons: &[F],
    ) -> Verdict<F> {
        // A case has room for a ray and three vertices.
        let lifted = |vertex: &F::Vector| {
            let triangle = Triangle::new(*vertex, *vertex, *vertex);
            lift(&Case { ray: *ray, triangle }, self.arithmetic)
        };
        let Some((ray, _)) = vertices.first().map(lifted) else { return Verdict::miss(None) };
        let vertices: Vec<EmulatedVector<F>> =
            vertices.iter().map(|vertex| lifted(vertex).1.a).collect();
        let epsilons = numbers(epsilons, self.arithmetic);
        let mut sink = Deciding::new(&epsilons);
        let hit = K::test_polygon(&vertices, &ray, &mut sink);
        verdict(hit, sink.refused_by)
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
        each_case(info, cases, margins, values, |case, margins| self.measure_into(case, margins));
    }
}

impl<F: Float, K: Kernel> Gated<F> for Variant<K> {
    fn info(&self) -> &'static KernelInfo {
        self.info
    }

    fn measure(&self, case: &Case<F>) -> Measured<F> {
        let mut margins = vec![F::zero(); self.info.gates.len()];
        let values = self.measure_into(case, &mut margins);
        Measured { margins, values }
    }

    fn thresholds(&self, case: &Case<F>) -> Vec<F> {
        let (ray, triangle) = lift(case, self.arithmetic);
        let mut thresholds = numbers(&vec![F::zero(); self.info.gates.len()], self.arithmetic);
        let mut sink = Measuring::thresholds(&mut thresholds);
        test::<F, K>(&ray, &triangle, &mut Either::Other(&mut sink));
        thresholds.iter().map(Emulated::value).collect()
    }

    fn measure_exact(&self, case: &Case<F>) -> Measured<Exact> {
        Generic::<K>::SUBJECT.measure_exact(case)
    }

    fn run_exact(&self, case: &Case<F>, epsilons: &[F]) -> ExactRun {
        Generic::<K>::SUBJECT.run_exact(case, epsilons)
    }

    fn run_tracked(&self, case: &Case<F>, epsilons: &[F]) -> TrackedRun<F> {
        TrackedRun::of::<K>(case, epsilons, self.arithmetic)
    }

    fn paths(&self) -> Result<Vec<Path>, String> {
        paths::<K>(self.arithmetic)
    }
}
