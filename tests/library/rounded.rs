//! A kernel whose verdicts are exact and whose values are correctly rounded has no finding at all: not at the ends of the
//! range, not where t is beyond the largest number, not at the ends of an interval.

use hairline::internals::case::Case;
use hairline::internals::contract::{Contract, Extent};
use hairline::internals::kernel::{Entry, Gives, Hit, KernelInfo, Scalar};
use hairline::internals::oracle;
use num_rational::BigRational;
use num_traits::ToPrimitive;

const ROUNDED: KernelInfo = KernelInfo {
    gives: Gives {
        t: true,
        uv: true,
        facing: true,
    },
    ..KernelInfo::own("rounded", CLOSED_INTERVAL)
};

const CLOSED_INTERVAL: Contract = Contract {
    extent: Extent::Interval,
    ..Contract::CLOSED_RAY
};

/// The double next to a fraction; infinite beyond the largest.
fn rounded<F: Scalar>(exact: Option<BigRational>) -> F {
    F::from_f64(
        exact
            .and_then(|x| x.to_f64())
            .expect("a transversal case has values"),
    )
}

fn right<F: Scalar>(case: &Case<F>) -> Option<Hit<F>> {
    let truth = oracle::truth(case);
    let crossing = truth.crossing()?;
    if truth.hits_closed() != Some(true) {
        return None;
    }
    let exact = oracle::exact_values(case, &truth);
    let facing = Some(crossing.facing);
    let uv = Some((rounded(exact.u), rounded(exact.v)));
    Some(Hit {
        t: Some(rounded(exact.t)),
        uv,
        facing,
    })
}

#[test]
fn a_kernel_that_is_correctly_rounded_has_no_finding() {
    let kernel = Entry::new(&ROUNDED)
        .f32(|case: &Case<f32>, _: &[f32]| right(case))
        .f64(|case: &Case<f64>, _: &[f64]| right(case));
    hairline::audit(&kernel).count(1000).assert_conforms();
    hairline::audit(&kernel)
        .scene("room")
        .count(300)
        .assert_conforms();
}
