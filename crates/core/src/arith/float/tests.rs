//! Tests of floats.

use super::*;

#[test]
fn scaling_by_powers_of_two_is_exact_or_rounds_once() {
    assert_eq!(scale_by_power_of_two(1.0, -1074), f64::from_bits(1));
    assert_eq!(
        scale_by_power_of_two(f64::MAX, -2000),
        f64::MAX * 2f64.powi(-1000) * 2f64.powi(-1000)
    );
    assert_eq!(scale_by_power_of_two(1.5, 1023), 1.5 * 2f64.powi(1023));
    assert_eq!(
        scale_by_power_of_two(f64::from_bits(1), 1100),
        2f64.powi(26)
    );
    assert_eq!(scale_by_power_of_two(-3.0, 0), -3.0);
    assert_eq!(scale_by_power_of_two(1.0, -2100), 0.0);
    assert_eq!(scale_by_power_of_two(1e300, -4000), 0.0);
}

#[test]
fn floats_come_apart_at_both_ends_of_the_range() {
    assert_eq!(decompose(-6.0), (-3, 1));
    assert_eq!(decompose(f64::from_bits(1)), (1, -1074));
    assert_eq!(decompose(f64::from(f32::from_bits(3))), (3, -149));
    assert_eq!(decompose(f64::MAX), ((1 << 53) - 1, 971));
    assert_eq!(decompose(-0.0), (0, 0));
}

#[test]
fn places_count_ulps_through_zero() {
    assert_eq!((-0.0f32).place(), 0);
    assert_eq!(f32::from_bits(1).offset_ulps(-2), -f32::from_bits(1));
    assert_eq!(1.0f64.offset_ulps(1), 1.0 + f64::EPSILON);
    assert_eq!(f64::MAX.offset_ulps(5), f64::INFINITY);
    assert_eq!(f32::MIN.offset_ulps(-5), f32::NEG_INFINITY);
}

#[test]
fn bisection_finds_the_last_accepted_float() {
    // Wherever the search starts.
    for start in [
        f64::NAN,
        f64::NEG_INFINITY,
        f64::MIN,
        -1.0,
        -0.0,
        0.5,
        0.6,
        f64::MAX,
    ] {
        assert_eq!(Real::largest_accepted(|e: &f64| *e <= 0.5, || start), 0.5);
    }
    for target in [
        f32::MIN,
        -1.5f32,
        -0.0,
        1e-40,
        1e-6,
        3.0e38,
        f32::MAX.next_down(),
    ] {
        for start in [f32::NAN, f32::MIN, 0.0, target, target.next_up(), f32::MAX] {
            let found = Real::largest_accepted(|e: &f32| *e <= target, || start);
            assert_eq!(found, target);
        }
    }
    assert_eq!(
        <f64 as Real>::largest_accepted(|_| true, || 0.0),
        f64::INFINITY
    );
    assert_eq!(
        <f64 as Real>::largest_accepted(|_| false, || 0.0),
        f64::NEG_INFINITY
    );
}

#[test]
fn the_wide_difference_is_zero_only_for_equal_products() {
    let (a, b) = (1.0 + f64::EPSILON, 1.0 - f64::EPSILON);
    assert_eq!(a * b - 1.0, 0.0, "plain products cannot tell these apart");
    assert_eq!(wide_f64(a, b, 1.0, 1.0), -f64::EPSILON * f64::EPSILON);
}
