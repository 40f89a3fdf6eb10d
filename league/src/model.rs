//! Models: an entrant's formula written against hairline's numbers, so that its gates show their
//! margins and it can be run without rounding. The verdicts are still the published function's.

mod moller_trumbore;

pub use moller_trumbore::{GATES, GATES_CULLING, GATES_INTERVAL, MollerTrumbore, Style, T};

use hairline::internals::arith::Float;
use hairline::internals::case::Case;
use hairline::internals::kernel::{Entry, Gated, Generic, Kernel, KernelIn, Scalar, Test, Verdict};
use std::marker::PhantomData;

/// A published function with the model of it. At the epsilons of its source the function itself runs;
/// at others, which it cannot be given, the model does.
struct Modelled<K, T, F> {
    function: T,
    source: Vec<F>,
    model: PhantomData<fn() -> K>,
}

/// The entry of a function in `f32`, with its model.
pub fn with_f32<K: Kernel>(entry: Entry, function: impl Test<f32> + 'static) -> Entry {
    entry.with_f32(modelled::<K, f32>(function))
}

/// The entry of a function in `f64`, with its model.
pub fn with_f64<K: Kernel>(entry: Entry, function: impl Test<f64> + 'static) -> Entry {
    entry.with_f64(modelled::<K, f64>(function))
}

fn modelled<K: Kernel, F: Scalar>(function: impl Test<F> + 'static) -> &'static dyn KernelIn<F> {
    let source = K::INFO.epsilon_sets[0]
        .values
        .iter()
        .map(|text| number(text))
        .collect();
    Box::leak(Box::new(Modelled {
        function,
        source,
        model: PhantomData::<fn() -> K>,
    }))
}

/// An epsilon of a source, as hairline reads it.
fn number<F: Float>(text: &str) -> F {
    match text.strip_suffix("EPSILON") {
        Some("") => F::EPSILON,
        Some(factor) => {
            F::EPSILON * F::parse(factor.trim_end_matches('*')).expect("a multiple of EPSILON")
        }
        None => F::parse(text).expect("an epsilon"),
    }
}

impl<F: Scalar, K: Kernel, T: Test<F>> KernelIn<F> for Modelled<K, T, F> {
    fn run(&self, cases: &[Case<F>], epsilons: &[F], verdicts: &mut [Verdict<F>]) {
        if epsilons != self.source {
            return Generic::<K>::SUBJECT.run(cases, epsilons, verdicts);
        }
        for (case, verdict) in cases.iter().zip(verdicts) {
            *verdict = Verdict::of(self.function.test(case, epsilons), None);
        }
    }

    fn gated(&self) -> Option<&dyn Gated<F>> {
        Some(&const { Generic::<K>::SUBJECT })
    }
}
