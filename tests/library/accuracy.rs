//! Errors of values against the definition's rationals.

use hairline::internals::arith::Float;
use hairline::internals::audit::Errors;
use hairline::internals::case::{Case, Parameters};
use hairline::internals::family::FAMILIES;
use hairline::internals::kernel::{KERNELS, Scalar, Verdict, find};
use hairline::internals::oracle::define;
use hairline::internals::truth::{Feature, Truth};
use num_rational::BigRational as Rational;
use num_traits::{Signed, ToPrimitive, Zero};

fn rational(x: f64) -> Rational {
    Rational::from_float(x).unwrap()
}

/// |found - exact| in ulps of the float nearest to the exact value, or of `unit` where that is zero.
fn ulps<F: Float>(found: F, exact: &Rational, unit: f64) -> f64 {
    if !found.is_finite() {
        return f64::INFINITY;
    }
    let nearest = F::from_f64(exact.to_f64().unwrap());
    let ulp = if exact.is_zero() {
        unit
    } else {
        nearest.ulp().to_f64()
    };
    ((rational(found.to_f64()) - exact).abs() / rational(ulp))
        .to_f64()
        .unwrap()
}

fn errors_are_those_of_rationals<F: Scalar>() {
    let (mut measured, mut zeros) = (0, 0);
    for family in FAMILIES {
        for index in 0..25 {
            for case in family.make::<F>(&Parameters::default(), 1, index).cases() {
                let definition = define(case);
                let Truth::Transversal(crossing) = definition.truth else {
                    continue;
                };
                if crossing.feature == Feature::Outside {
                    continue;
                }
                let exact = definition.exact;
                let [t, u, v] = [exact.t, exact.u, exact.v].map(|x| x.unwrap());
                let [o, d, a, b, c] = case.vectors();
                let largest = |v: &[F]| v.iter().fold(0.0f64, |m, x| m.max(x.to_f64().abs()));
                let coordinate = largest(&[o, a, b, c].concat());
                let t_unit = F::from_f64(coordinate).ulp().to_f64() / largest(&d);
                for entry in KERNELS {
                    let gives = entry.info.gives;
                    let zero = vec![F::zero(); entry.info.gates.len()];
                    let mut verdict = [Verdict::miss(None)];
                    F::subject(entry)
                        .unwrap()
                        .run(std::slice::from_ref(case), &zero, &mut verdict);
                    let [verdict] = verdict;
                    if !verdict.hit {
                        continue;
                    }
                    let found = Errors::of(case, &crossing, gives, &verdict);
                    let near = |found: Option<f64>, expected: f64| {
                        let found = found.expect("given");
                        let name = entry.info.name;
                        assert!(
                            found == expected
                                || (found - expected).abs() <= 1e-4 + 1e-4 * expected.abs(),
                            "{name} {found} {expected} {}",
                            case.hex()
                        );
                    };
                    if gives.t {
                        near(found.t, ulps(verdict.t, &t, t_unit));
                        let exact: [Rational; 3] = std::array::from_fn(|i| {
                            rational(o[i].to_f64()) + &t * rational(d[i].to_f64())
                        });
                        let ulp = F::from_f64(coordinate).ulp().to_f64();
                        let off = (0..3).map(|i| {
                            let found = o[i] + verdict.t * d[i];
                            if !found.is_finite() {
                                return f64::INFINITY;
                            }
                            let off = (rational(found.to_f64()) - &exact[i]).abs();
                            (off / rational(ulp)).to_f64().unwrap()
                        });
                        near(found.point, off.fold(0.0, f64::max));
                    }
                    if gives.uv {
                        let unit = F::EPSILON.to_f64();
                        near(
                            found.uv,
                            ulps(verdict.u, &u, unit).max(ulps(verdict.v, &v, unit)),
                        );
                    }
                    measured += 1;
                    zeros += usize::from(u.is_zero());
                }
            }
        }
    }
    assert!(measured > 2_000 && zeros > 100, "{measured} {zeros}");
}

#[test]
fn errors_are_those_of_rationals_in_either_scalar() {
    errors_are_those_of_rationals::<f32>();
    errors_are_those_of_rationals::<f64>();
}

#[test]
fn errors_worked_out_by_hand() {
    // Down onto (1/2, 1/2): t = 1, u = v = 1/4. A t of 1 + 2^-23 is one ulp off; the point's z of
    // -2^-23 is half an ulp of the largest coordinate of the case, 2.
    let triangle = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 2.0, 0.0]];
    let case = Case::<f32>::new([0.5, 0.5, 1.0], [0.0, 0.0, -1.0], triangle);
    let Truth::Transversal(crossing) = define(&case).truth else {
        panic!()
    };
    let gives = find("cramer").unwrap().info.gives;
    let [t, u, v] = [1.0 + f32::EPSILON, 0.25, 0.25 + 2.0 * f32::EPSILON / 4.0];
    let verdict = Verdict {
        hit: true,
        refused_by: None,
        facing: None,
        t,
        u,
        v,
        failure: None,
    };
    let errors = Errors::of(&case, &crossing, gives, &verdict);
    assert_eq!(
        (errors.t, errors.uv, errors.point),
        (Some(1.0), Some(2.0), Some(0.5))
    );
}
