//! Each family keeps its promise, and the fast oracle agrees with the definition on its cases.

use hairline::internals::case::Parameters;
use hairline::internals::family::{FAMILIES, Family};
use hairline::internals::kernel::Scalar;
use hairline::internals::oracle;
use hairline::internals::truth::Truth;

fn check<F: Scalar>(family: &Family, count: u64) {
    for index in 0..count {
        let made = family.make::<F>(&Parameters::default(), 1, index);
        let truths: Vec<Truth> = made.cases().iter().map(oracle::truth).collect();
        let id = family.id::<F>(&Parameters::default(), 1, index);
        assert!(family.keeps(&truths), "{id} breaks its promise: {truths:?} {made:?}");
        if index < count / 10 {
            for (case, truth) in made.cases().iter().zip(&truths) {
                assert_eq!(*truth, oracle::define(case).truth, "{id}: {case:?}");
            }
        }
    }
}

#[test]
fn every_family_keeps_its_promise_in_f32() {
    FAMILIES.iter().for_each(|family| check::<f32>(family, 3000));
}

#[test]
fn every_family_keeps_its_promise_in_f64() {
    FAMILIES.iter().for_each(|family| check::<f64>(family, 3000));
}
