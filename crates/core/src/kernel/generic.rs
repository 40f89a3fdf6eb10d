//! Kernels that are written once for every arithmetic, as subjects of either scalar.

use super::subject::KernelIn;
use super::{Deciding, Kernel, KernelInfo, Verdict};
use crate::arith::{Arithmetic, Float};
use crate::case::{Ray, Target, Triangles};
use std::marker::PhantomData;
#[cfg(feature = "margins")]
use {super::Hit, super::margins::each_case, super::subject::Gated};

/// A [`Kernel`], written for every arithmetic, as a [`KernelIn`] of either scalar, in some [`Arithmetic`]. Without
/// rounding it is the same kernel in all of them.
pub struct Generic<K, T: Target = Triangles> {
    pub(super) arithmetic: Arithmetic,
    pub(super) info: &'static KernelInfo,
    kernel: PhantomData<fn() -> (K, T)>,
}

impl<T: Target, K: Kernel<T>> Generic<K, T> {
    /// In the machine's own arithmetic.
    pub const SUBJECT: Generic<K, T> = Generic {
        arithmetic: Arithmetic::IEEE,
        info: &const { K::INFO },
        kernel: PhantomData,
    };
}

impl<F: Float, T: Target, K: Kernel<T>> KernelIn<F, T> for Generic<K, T> {
    fn run(&self, cases: &[T::Case<F>], epsilons: &[F], verdicts: &mut [Verdict<F>]) {
        #[cfg(feature = "margins")]
        if self.arithmetic != Arithmetic::IEEE {
            return self.run_emulated(cases, epsilons, verdicts);
        }
        for (case, verdict) in cases.iter().zip(verdicts) {
            let mut sink = Deciding::new(epsilons);
            let hit = K::test(&K::prepare(T::shape(case)), T::ray(case), &mut sink);
            *verdict = Verdict::of(hit, sink.refused_by);
        }
    }

    fn run_polygon(
        &self,
        vertices: &[F::Vector],
        ray: &Ray<F::Vector>,
        epsilons: &[F],
    ) -> Verdict<F> {
        #[cfg(feature = "margins")]
        if self.arithmetic != Arithmetic::IEEE {
            return self.run_polygon_emulated(vertices, ray, epsilons);
        }
        let mut sink = Deciding::new(epsilons);
        let hit = K::test_polygon(vertices, ray, &mut sink);
        Verdict::of(hit, sink.refused_by)
    }

    #[cfg(feature = "margins")]
    fn gated(&self) -> Option<&dyn Gated<F, T>> {
        Some(self)
    }

    #[cfg(feature = "margins")]
    fn margins(
        &self,
        info: &KernelInfo,
        cases: &[T::Case<F>],
        margins: &mut [F],
        values: &mut [Option<Hit<F>>],
    ) {
        each_case(info, cases, margins, values, |case, margins| {
            self.measure_into(case, margins, false)
        });
    }

    #[cfg(feature = "margins")]
    fn in_arithmetic(
        &self,
        arithmetic: Arithmetic,
        info: &'static KernelInfo,
    ) -> Option<&'static dyn KernelIn<F, T>> {
        Some(Box::leak(Box::new(Generic::<K, T> {
            arithmetic,
            info,
            kernel: PhantomData,
        })))
    }
}
