//! Kernels that are written once for every arithmetic, as subjects of either scalar.

use super::subject::Subject;
use super::{Deciding, Kernel, Verdict};
use crate::arith::Float;
use crate::case::{Case, Ray};
use std::marker::PhantomData;
#[cfg(feature = "margins")]
use {
    super::margins::each_case,
    super::shown::measure_into,
    super::subject::Gated,
    super::variant::Variant,
    super::{Hit, KernelInfo},
    crate::arith::Arithmetic,
};

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

    #[cfg(feature = "margins")]
    fn gated(&self) -> Option<&dyn Gated<F>> {
        Some(self)
    }

    #[cfg(feature = "margins")]
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

    #[cfg(feature = "margins")]
    fn in_arithmetic(
        &self,
        arithmetic: Arithmetic,
        info: &'static KernelInfo,
    ) -> Option<&'static dyn Subject<F>> {
        Some(Box::leak(Box::new(Variant::<K>::new(arithmetic, info))))
    }
}
