//! Distances and bands against an independent computation in rationals.

use hairline::internals::arith::Float;
use hairline::internals::case::{Case, Draw, Parameters};
use hairline::internals::contract::{Band, BandUnit, Boundary, Contract, Extent, Sides};
use hairline::internals::family::FAMILIES;
use hairline::internals::judge::{Distances, Obligation, asked, obligation};
use hairline::internals::kernel::Scalar;
use hairline::internals::oracle::{define, truth};
use hairline::internals::truth::{Facing, Feature, Place, Truth};
use num_rational::BigRational as Rational;
use num_traits::{Signed, ToPrimitive, Zero};
use std::cmp::Ordering;

type Point = [Rational; 3];

fn rational(x: f64) -> Rational {
    Rational::from_float(x).unwrap()
}

fn minus(a: &Point, b: &Point) -> Point {
    std::array::from_fn(|i| &a[i] - &b[i])
}

fn dot(a: &Point, b: &Point) -> Rational {
    &a[0] * &b[0] + &a[1] * &b[1] + &a[2] * &b[2]
}

/// The square of the distance from a line to a segment: with the part along d taken out, |w + s·e|² is
/// a parabola in s.
fn line_to_segment(o: &Point, d: &Point, p: &Point, q: &Point) -> Rational {
    let d2 = dot(d, d);
    let (w, e) = (minus(p, o), minus(q, p));
    let flat = |x: &Point, y: &Point| dot(x, y) - dot(x, d) * dot(y, d) / &d2;
    let (constant, linear, square) = (flat(&w, &w), flat(&w, &e), flat(&e, &e));
    let at = |s: &Rational| &constant + rational(2.0) * s * &linear + s * s * &square;
    let ends = at(&rational(0.0)).min(at(&rational(1.0)));
    if square.is_zero() {
        return ends;
    }
    let s = -&linear / &square;
    if s.is_negative() || s > rational(1.0) {
        ends
    } else {
        at(&s).min(ends)
    }
}

/// Squares of the distance to change, of the longest edge and of the ulp.
fn squares<F: Float>(case: &Case<F>, contract: &Contract) -> [Rational; 3] {
    let [o, d, a, b, c] = case.vectors().map(|v| v.map(|x| rational(x.to_f64())));
    let edges = [(&a, &b), (&b, &c), (&c, &a)];
    let to_edges = edges.map(|(p, q)| line_to_segment(&o, &d, p, q));
    let in_space = to_edges.into_iter().min().unwrap();
    let lengths = edges.map(|(p, q)| dot(&minus(q, p), &minus(q, p)));
    let longest = lengths.into_iter().max().unwrap();
    let longest = if longest.is_zero() {
        rational(1.0)
    } else {
        longest
    };
    let [o, _, a, b, c] = case.vectors();
    let largest = [o, a, b, c]
        .concat()
        .into_iter()
        .map(|x| x.to_f64().abs())
        .fold(0.0, f64::max);
    let ulp = rational(F::from_f64(largest).ulp().to_f64());
    let definition = define(case);
    let change = match definition.truth {
        Truth::Transversal(crossing) => {
            let t = definition.exact.t.unwrap();
            let to = |end: f64| {
                end.is_finite()
                    .then(|| (&t - rational(end)) * (&t - rational(end)) * dot(&d, &d))
            };
            let (t_min, t_max) = (case.ray.t_min.to_f64(), case.ray.t_max.to_f64());
            let (along, off) = match contract.extent {
                Extent::Line => (None, false),
                Extent::Ray => (to(0.0), crossing.t_sign == Ordering::Less),
                Extent::Interval => (
                    [to(t_min), to(t_max)].into_iter().flatten().min(),
                    matches!(crossing.place, Place::Before | Place::Beyond),
                ),
            };
            let outside = crossing.feature == Feature::Outside;
            match along {
                _ if contract.sides == Sides::Front && crossing.facing == Facing::Back => in_space,
                None => in_space,
                Some(along) if off && outside => along.max(in_space),
                Some(along) if off => along,
                Some(_) if outside => in_space,
                Some(along) => along.min(in_space),
            }
        }
        _ => in_space,
    };
    [change, longest, &ulp * &ulp]
}

fn contracts() -> [Contract; 4] {
    let ray = Contract::CLOSED_RAY;
    [
        ray,
        Contract {
            extent: Extent::Line,
            boundary: Boundary::Open,
            ..ray
        },
        Contract {
            extent: Extent::Interval,
            ..ray
        },
        Contract {
            sides: Sides::Front,
            ..ray
        },
    ]
}

fn for_valid_cases<F: Scalar>(indices: u64, mut check: impl FnMut(&Case<F>, &Truth, &mut Draw)) {
    for family in FAMILIES {
        for index in 0..indices {
            let mut draw = Draw::new("severity", 1, index);
            let scale = draw.pick(&[0, 0, 0, -40, 30]);
            let parameters = Parameters {
                scale,
                ..Parameters::default()
            };
            for case in family.make::<F>(&parameters, 1, index).cases() {
                let truth = truth(case);
                if truth != Truth::Invalid {
                    check(case, &truth, &mut draw);
                }
            }
        }
    }
}

fn distances_are_right_to_a_thousandth<F: Scalar>() {
    let mut zeros = 0;
    for_valid_cases::<F>(12, |case, truth, _| {
        let distances = Distances::of(case, truth);
        for contract in contracts() {
            let [change, longest, ulp] = squares(case, &contract);
            let found = distances.nearest_change(truth, &contract);
            let told = || format!("{found} {:?} {}", (&change / &longest).to_f64(), case.hex());
            if change.is_zero() {
                zeros += 1;
                assert_eq!(found, 0.0, "{}", told());
                continue;
            }
            let near = |found: f64, square: Rational| {
                let ratio = rational(found) * rational(found) / square;
                (rational(0.998)..=rational(1.002)).contains(&ratio)
            };
            // Squares of the ends of the range have no float.
            if found > 1e-150 && found < 1e150 {
                assert!(near(found, &change / &longest), "{}", told());
                assert!(near(distances.edge_in_ulps, &longest / &ulp), "{}", told());
            }
        }
    });
    assert!(zeros > 200, "{zeros}");
}

#[test]
fn distances_are_those_of_rationals_in_either_scalar() {
    distances_are_right_to_a_thousandth::<f32>();
    distances_are_right_to_a_thousandth::<f64>();
}

fn a_band_frees_exactly_what_is_nearer<F: Scalar>() {
    let (mut freed, mut asked_still) = (0, 0);
    for_valid_cases::<F>(10, |case, truth, draw| {
        for contract in contracts() {
            if obligation(truth, &contract, false) == Obligation::Free {
                continue;
            }
            let [change, longest, ulp] = squares(case, &contract);
            for (unit, square) in [(BandUnit::Edges, &longest), (BandUnit::Ulps, &ulp)] {
                // At the distance itself, and a few floats beside it.
                let distance = (&change / square).to_f64().unwrap().sqrt();
                if !(1e-150..1e150).contains(&distance) {
                    continue;
                }
                let size = distance.offset_ulps(draw.integer(-3, 3));
                let band = Some(Band { size, unit });
                let expected = change < rational(size) * rational(size) * square;
                let found = asked(case, truth, &Contract { band, ..contract }, false);
                assert_eq!(
                    found == Obligation::Free,
                    expected,
                    "{size} {unit:?} {}",
                    case.hex()
                );
                freed += usize::from(expected);
                asked_still += usize::from(!expected);
            }
        }
    });
    assert!(freed > 300 && asked_still > 300, "{freed} {asked_still}");
}

#[test]
fn a_band_frees_exactly_what_is_nearer_in_either_scalar() {
    a_band_frees_exactly_what_is_nearer::<f32>();
    a_band_frees_exactly_what_is_nearer::<f64>();
}

#[test]
fn what_lies_on_the_boundary_is_in_every_band_and_a_band_needs_a_size() {
    let triangle = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 2.0, 0.0]];
    let case = Case::<f32>::new([1.0, 0.0, 1.0], [0.0, 0.0, -1.0], triangle);
    let band = Some("1e-300".parse().unwrap());
    let contract = Contract {
        band,
        ..Contract::CLOSED_RAY
    };
    assert_eq!(
        asked(&case, &truth(&case), &contract, false),
        Obligation::Free
    );
    for bad in ["0", "-1", "ulps", "inf", "4 miles"] {
        assert!(bad.parse::<Band>().is_err(), "{bad}");
    }
    assert_eq!("4ulps".parse::<Band>().unwrap().to_string(), "4ulps");
    assert_eq!("1e-6".parse::<Band>().unwrap().to_string(), "1e-6");
}
