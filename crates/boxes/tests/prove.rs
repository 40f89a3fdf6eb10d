//! The least growth of a far end: the constants of docs/design/boxes-proof.md in exact rationals, the rays that a smaller growth
//! loses, the bound on boxes that are drawn to break it, and the hypothesis.

use hairline_boxes::{BoxCase, Domain, Growth, Made, TABLE, least_growths, truth};
use hairline_core::Verdict;
use hairline_core::case::Draw;
use hairline_core::kernel::Scalar;
use num_rational::BigRational as Rational;
use num_traits::{One, pow};

fn ordinary() -> Domain {
    Domain::new([1e-6, 1e6], [1e-6, 1e6]).unwrap()
}

fn least_growth<F: Made + Scalar>(test: &str, domain: &Domain) -> Growth<F> {
    let mut all = least_growths::<F>(domain).into_iter();
    all.find(|growth| growth.test == test).unwrap()
}

fn exact(x: f64) -> Rational {
    Rational::from_float(x).unwrap()
}

fn hits<F: Made + Scalar>(test: &str, case: &BoxCase<F>, growth: f64) -> bool {
    let mut verdict = [Verdict::miss(None)];
    let subject = F::subject(TABLE.find(test).unwrap()).unwrap();
    subject.run(&[*case], &[F::from_f64(-growth)], &mut verdict);
    verdict[0].hit
}

/// Each step of the page, with the numbers that it states, for a precision and a number of roundings.
fn steps_hold(precision: i32, n: usize) {
    let u = exact((-f64::from(precision)).exp2());
    let one = Rational::one;
    let two = || exact(2.0);
    // Step 2: a rounding is off by at most u/(1 + u) of the exact number.
    let off = &u / (one() + &u);
    let up = pow(one() + &off, n);
    let down = pow(one() - &off, n);
    assert_eq!(&up / &down, pow(one() + two() * &u, n));
    // Step 4: the grown far end is at least this share of the near one.
    let grown = one() + exact(2.0 * n as f64) * &u;
    let share = &grown / pow(one() + two() * &u, n);
    assert!(share <= one());
    // Step 5: that is more than the middle between the near end and the float below.
    assert!(one() - &u / two() < share);
    // The bound of the page: 1 - 2n(n-1)u^2 - ... is far from it.
    let bound = exact((2 * n * (n - 1)) as f64) * pow(u.clone(), 2);
    assert!(one() - &bound * exact(1.001) < share && share <= one());
}

#[test]
fn the_constants_of_the_page_hold_in_both_scalars_for_two_and_three_roundings() {
    for precision in [24, 53] {
        steps_hold(precision, 2);
        steps_hold(precision, 3);
    }
}

fn smaller_ones_lose<F: Made + Scalar>() {
    for (test, units) in [("divided", 2), ("multiplied", 3)] {
        let growth = least_growth::<F>(test, &ordinary());
        assert_eq!(growth.enough, Some(units));
        for (what, holds) in &growth.conditions {
            assert!(holds, "{} {test}: {what}", F::NAME);
        }
        let case = &growth.witness;
        let epsilon = F::EPSILON.to_f64();
        assert!(truth(case).hits_closed().unwrap());
        assert!(!hits(test, case, f64::from(units - 1) * epsilon));
        assert!(hits(test, case, f64::from(units) * epsilon));
        // The witness is of ordinary sizes, and the same at every power of two.
        let vectors = case.vectors();
        let sizes = vectors.as_flattened().iter().map(|x| x.to_f64().abs());
        assert!(
            sizes
                .clone()
                .all(|size| size == 0.0 || (0.003..=8.0).contains(&size))
        );
        let scaled = |factor: f64| vectors.map(|vector| vector.map(|x| x * F::from_f64(factor)));
        for factor in [1024.0, 1.0 / 1024.0] {
            let [origin, _, min, max] = scaled(factor);
            let moved = BoxCase::new(origin, vectors[1], [min, max]);
            assert!(!hits(test, &moved, f64::from(units - 1) * epsilon));
        }
    }
}

#[test]
fn a_smaller_growth_loses_a_ray_that_is_met() {
    smaller_ones_lose::<f32>();
    smaller_ones_lose::<f64>();
}

#[test]
fn no_growth_is_enough_for_fused_products() {
    let growth = least_growth::<f32>("fused", &ordinary());
    assert_eq!(growth.enough, None);
    assert!(growth.conditions.iter().all(|(_, holds)| *holds));
    assert!(!hits("fused", &growth.witness, 1e20));
    let growth = least_growth::<f64>("fused", &ordinary());
    assert!(growth.conditions.iter().all(|(_, holds)| *holds));
    // At a plane through the origin the near end is an error alone. So where the far end is 0 no factor helps.
    let [origin, direction, min, mut max] = growth.witness.vectors();
    max[1] = origin[1];
    let touching = BoxCase::new(origin, direction, [min, max]);
    assert!(truth(&touching).hits_closed().unwrap());
    assert!(!hits("fused", &touching, 1e300));
    assert!(hits("multiplied", &touching, 0.0));
}

/// A ray of ordinary sizes through a point of a box that is met in little more: where growth is needed most.
fn tight(draw: &mut Draw) -> BoxCase<f32> {
    let number = |draw: &mut Draw| {
        let size = (40.0 * draw.unit() - 20.0).exp2() as f32;
        if draw.coin() { size } else { -size }
    };
    let origin = [0; 3].map(|_| number(draw));
    let direction = [0; 3].map(|_| number(draw));
    let t = draw.unit().abs() as f32 + 0.01;
    let [mut min, mut max] = [[0f32; 3]; 2];
    for i in 0..3 {
        let at = (f64::from(origin[i]) + f64::from(t) * f64::from(direction[i])) as f32;
        let beside = number(draw).abs();
        let steps = draw.below(3) as i32 - 1;
        let plane = if steps < 0 {
            at.next_down()
        } else if steps > 0 {
            at.next_up()
        } else {
            at
        };
        if draw.coin() {
            (min[i], max[i]) = (plane, plane + beside);
        } else {
            (min[i], max[i]) = (plane - beside, plane);
        }
    }
    BoxCase::new(origin, direction, [min, max])
}

#[test]
fn the_proved_growth_loses_none_of_many_tight_boxes_and_less_loses_some() {
    let mut draw = Draw::new("tight boxes", 1, 1);
    let mut lost = [0; 2];
    let mut met = 0;
    for _ in 0..200_000 {
        let case = tight(&mut draw);
        if truth(&case).hits_closed() != Some(true) {
            continue;
        }
        met += 1;
        let epsilon = f64::from(f32::EPSILON);
        assert!(hits("divided", &case, 2.0 * epsilon), "{}", case.hex());
        assert!(hits("multiplied", &case, 3.0 * epsilon), "{}", case.hex());
        lost[0] += u64::from(!hits("divided", &case, 0.0));
        lost[1] += u64::from(!hits("multiplied", &case, 0.0));
    }
    assert!(20_000 < met, "{met}");
    assert!(lost.iter().all(|lost| 100 < *lost), "{lost:?}");
}

#[test]
fn the_hypothesis_fails_where_numbers_leave_the_range() {
    let fails = |domain: &Domain, test: &str| {
        let growth = least_growth::<f32>(test, domain);
        let failed = growth.conditions.into_iter().filter(|(_, holds)| !holds);
        failed.map(|(what, _)| what).collect::<Vec<_>>()
    };
    let with = |coordinates, directions| Domain::new(coordinates, directions).unwrap();
    assert_eq!(fails(&ordinary(), "multiplied"), [""; 0]);
    let tiny = with([1e-30, 1.0], [1e-6, 1e6]);
    assert_eq!(fails(&tiny, "divided"), ["no t but 0 underflows"]);
    let large = with([1.0, 3e38], [1.0, 1.0]);
    assert_eq!(
        fails(&large, "divided"),
        ["b - o does not overflow", "t does not overflow"]
    );
    let slow = with([1.0, 1.0], [1e-39, 1.0]);
    assert_eq!(fails(&slow, "divided"), ["t does not overflow"]);
    assert_eq!(
        fails(&slow, "multiplied"),
        ["1 / d does not overflow", "t does not overflow"]
    );
    let fast = with([1.0, 1.0], [1.0, 2e38]);
    assert_eq!(
        fails(&fast, "multiplied"),
        ["1 / d does not underflow", "no t but 0 underflows"]
    );
    for [least, most] in [
        [0.0, 1.0],
        [2.0, 1.0],
        [f64::NAN, 1.0],
        [1.0, f64::INFINITY],
    ] {
        assert!(Domain::new([least, most], [1.0, 1.0]).is_err());
        assert!(Domain::new([1.0, 1.0], [least, most]).is_err());
    }
}

/// Where t is 1.5 times the least subnormal number: the near end rounds up to two of them, the far end down to one.
#[test]
fn where_t_underflows_a_growth_of_a_few_units_loses_a_ray() {
    let u = f32::EPSILON / 2.0;
    let k = 1.0 / 256.0;
    let small = (-30f32).exp2();
    let fast = 119f32.exp2();
    let plane = (1.0 - k) * small;
    let origin = [-(u + u / 64.0) - k, -(u - u / 64.0) - k, 0.0].map(|x| x * small);
    let slope = |numerator: f32| numerator * u * fast;
    let direction = [slope(11_184_812.0), slope(11_184_811.0), 0.0];
    let bounds = [[plane, -1.0, -1.0], [1.0, plane, 1.0]];
    let case = BoxCase::<f32>::new(origin, direction, bounds);
    assert_eq!(truth(&case).hits_closed(), Some(true));
    let epsilon = f64::from(f32::EPSILON);
    assert!(!hits("divided", &case, 100.0 * epsilon));
    assert!(hits("divided", &case, 1.0));
}
