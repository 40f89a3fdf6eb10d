//! Other machines' arithmetic: fused products against exact rationals, flushing and rearranging against their
//! definitions.

use hairline::internals::arith::{
    Arithmetic, Emulated, Float, Real, Triple, Vector, scale_by_power_of_two,
};
use hairline::internals::case::Draw;
use num_bigint::BigInt;
use num_traits::Signed;

/// A finite float as an integer in units of 2^-1074, from the fields of its bits.
fn integer<F: Float>(x: F) -> BigInt {
    let bits = x.to_f64().to_bits();
    let (field, fraction) = (bits >> 52 & 0x7ff, bits & ((1 << 52) - 1));
    assert!(field < 0x7ff, "finite");
    let hidden = u64::from(field > 0) << 52;
    let size = BigInt::from(fraction | hidden) << (field.max(1) - 1);
    if x.is_sign_negative() { -size } else { size }
}

/// A finite float in the units of products: 2^-2148.
fn wide<F: Float>(x: F) -> BigInt {
    integer(x) << 1074
}

/// The float nearest to an integer in units of 2^-2148, ties to even, by bisection over all floats:
/// independent of every operation on floats.
fn nearest<F: Float>(exact: &BigInt) -> F {
    let most = F::infinity().place() - 1;
    let size = exact.abs();
    let at = |place: i64| wide(F::from_place(place));
    let (mut low, mut high) = (0, most + 1);
    while high - low > 1 {
        let middle = low.midpoint(high);
        if at(middle) <= size {
            low = middle
        } else {
            high = middle
        }
    }
    // The largest number is as far from the next power of two as from its neighbour below.
    let step = if low == most {
        at(low) - at(low - 1)
    } else {
        at(low + 1) - at(low)
    };
    let twice_above = (&size - at(low)) << 1;
    let up = twice_above > step || twice_above == step && low % 2 == 1;
    let found = F::from_place(low + i64::from(up));
    if exact.is_negative() { -found } else { found }
}

/// Numbers of every size: moderate, subnormal, huge, few digits and all.
fn number<F: Float>(draw: &mut Draw) -> F {
    let (lowest, highest) = (i64::from(F::MIN_EXPONENT), i64::from(F::MAX_EXPONENT));
    let exponent = match draw.below(6) {
        0..=2 => draw.integer(-4, 4),
        3 => draw.integer(lowest, lowest + i64::from(F::DIGITS) + 4),
        4 => draw.integer(lowest / 2 - 8, lowest / 2 + 8),
        _ => draw.integer(highest / 2 - 3, highest - 3),
    };
    match draw.below(8) {
        0 => F::zero(),
        1..=2 => F::from_f64(scale_by_power_of_two(
            draw.integer(-5, 5) as f64,
            exponent as i32,
        )),
        _ => draw.with_exponent(exponent as i32),
    }
}

/// a, b and a c near -a*b half of the time, so that sums cancel.
fn factors_and_term<F: Float>(draw: &mut Draw) -> [F; 3] {
    let [a, b] = [number::<F>(draw), number(draw)];
    let c = match draw.coin() {
        true => number(draw),
        false => (-(a * b)).offset_ulps(draw.integer(-2, 2)),
    };
    [a, b, if c.is_finite() { c } else { F::one() }]
}

fn numbers<F: Float, const N: usize>(values: [F; N], arithmetic: Arithmetic) -> [Emulated<F>; N] {
    values.map(|x| Emulated::new(x, arithmetic))
}

fn fused_products_are_correctly_rounded<F: Float>() {
    let (mut subnormal, mut huge, mut differ) = (0, 0, 0);
    let smallest_normal = F::from_place(1 << (F::DIGITS - 1));
    for index in 0..3_000 {
        let mut draw = Draw::new("fused", 1, index);
        let [a, b, c] = factors_and_term::<F>(&mut draw);
        let d = number::<F>(&mut draw);
        let [p, q, r, s] = [a, b, c, d].map(integer);
        let (product, term) = (&p * &q, &r << 1074);
        let new = || numbers([a, b, c, d], Arithmetic::FMA);
        let check = |found: Emulated<F>, exact: BigInt, what: &str| {
            let (found, expected) = (found.value(), nearest::<F>(&exact));
            assert_eq!(
                found,
                expected,
                "{} {what}: {a:e} {b:e} {c:e} {d:e}",
                F::NAME
            );
        };
        let [x, y, z, _] = new();
        let fused = x * y + z;
        subnormal += usize::from(!fused.is_zero() && fused.value().abs() < smallest_normal);
        huge += usize::from(!fused.is_finite());
        differ += usize::from(fused.value() != a * b + c);
        check(fused, &product + &term, "a*b + c");
        let [x, y, z, _] = new();
        check(x * y - z, &product - &term, "a*b - c");
        let [x, y, z, _] = new();
        check(z + x * y, &product + &term, "c + a*b");
        let [x, y, z, _] = new();
        check(z - x * y, &term - &product, "c - a*b");
        let [x, y, z, _] = new();
        check(-(x * y) + z, &term - &product, "-(a*b) + c");
        // Of two products the left one is fused, the right one rounded.
        if (c * d).is_finite() {
            let right = wide(nearest::<F>(&(&r * &s)));
            let [x, y, z, w] = new();
            check(x * y + z * w, &product + &right, "a*b + c*d");
            let [x, y, z, w] = new();
            check(x * y - z * w, &product - &right, "a*b - c*d");
        }
        // A name that is used again has been rounded.
        if (a * b).is_finite() {
            let rounded = wide(nearest::<F>(&product));
            let [x, y, z, _] = new();
            let product = x * y;
            check(product.clone() + &z, &rounded + &term, "p + c");
            check(z + &product, &rounded + &term, "c + p");
        }
        let [x, y, z, _] = numbers([a, b, c, d], Arithmetic::IEEE);
        assert!(!(a * b).is_finite() || (x * y + z).value() == a * b + c);
    }
    let counts = [subnormal, huge, differ];
    assert!(counts.iter().all(|count| *count > 20), "{counts:?}");
}

#[test]
fn fused_products_are_correctly_rounded_in_either_scalar() {
    fused_products_are_correctly_rounded::<f32>();
    fused_products_are_correctly_rounded::<f64>();
}

#[test]
fn the_oracle_of_rounding_knows_ties_and_ends() {
    let half_up = wide(1.0f32) + (wide(f32::EPSILON) >> 1);
    assert_eq!(nearest::<f32>(&half_up), 1.0);
    assert_eq!(nearest::<f32>(&(&half_up + 1)), 1.0 + f32::EPSILON);
    assert_eq!(
        nearest::<f32>(&(half_up + wide(f32::EPSILON))),
        1.0 + 2.0 * f32::EPSILON
    );
    let limit = wide(f32::MAX) + (wide(f32::MAX - f32::MAX.next_down()) >> 1);
    assert_eq!(nearest::<f32>(&limit), f32::INFINITY);
    assert_eq!(nearest::<f32>(&(BigInt::from(1) - limit)), f32::MIN);
    assert_eq!(nearest::<f64>(&(wide(f64::from_bits(1)) >> 1)), 0.0);
    assert_eq!(nearest::<f64>(&BigInt::from(-1)), 0.0);
}

#[test]
fn dot_cross_and_points_of_rays_are_fused_in_the_stated_order() {
    for index in 0..2_000 {
        let mut draw = Draw::new("order", 1, index);
        let [a, b] = [draw.point::<f64>(), draw.point::<f64>()];
        let t: f64 = draw.symmetric();
        let vector = |v: [f64; 3]| {
            let [x, y, z] = numbers(v, Arithmetic::FMA);
            Triple::new(x, y, z)
        };
        let (x, y) = (vector(a), vector(b));
        let dot = a[2].mul_add(b[2], a[0].mul_add(b[0], a[1] * b[1]));
        assert_eq!(x.dot(&y).value(), dot);
        let cross = [(1, 2), (2, 0), (0, 1)].map(|(j, k)| a[j].mul_add(b[k], -(b[j] * a[k])));
        let [factor] = numbers([t], Arithmetic::FMA);
        let along = std::array::from_fn::<f64, 3, _>(|i| b[i].mul_add(t, a[i]));
        let (product, point) = (x.cross(&y), x.clone().plus_scaled(&y, &factor));
        for i in 0..3 {
            assert_eq!(product.at(i).value(), cross[i]);
            assert_eq!(point.at(i).value(), along[i]);
        }
        // A named vector of products is rounded.
        let named = y.times(&factor);
        assert_eq!(named.plus(&x).at(0).value(), b[0] * t + a[0]);
    }
}

/// The definition, in the words of the standard library.
trait Subnormal: Float {
    fn flushed(self) -> Self;
}

macro_rules! subnormal {
    ($scalar:ident) => {
        impl Subnormal for $scalar {
            fn flushed(self) -> Self {
                if self.is_subnormal() {
                    0.0f64.copysign(self.into()) as $scalar
                } else {
                    self
                }
            }
        }
    };
}
subnormal!(f32);
subnormal!(f64);

fn subnormal_numbers_are_zeros<F: Subnormal>() {
    let mut flushed = 0;
    for index in 0..10_000 {
        let mut draw = Draw::new("flushed", 1, index);
        let [a, b, c] = factors_and_term::<F>(&mut draw);
        let [p, q, r] = [a, b, c].map(Subnormal::flushed);
        for arithmetic in [Arithmetic::FTZ, Arithmetic::FMA_FTZ] {
            let new = || numbers([a, b, c], arithmetic);
            let mut check = |found: Emulated<F>, ieee: F, what: &str| {
                let (found, expected) = (found.value(), ieee.flushed());
                let same = found.to_bits() == expected.to_bits() || found.is_nan() && ieee.is_nan();
                assert!(
                    same,
                    "{arithmetic} {} {what}: {a:e} {b:e} {c:e}: {found:e}",
                    F::NAME
                );
                flushed += usize::from(ieee.to_bits() != expected.to_bits());
            };
            let [x, y, z] = new();
            check(x + y, p + q, "a + b");
            let [x, y, _] = new();
            check(x - &y, p - q, "a - b");
            let [x, y, _] = new();
            check(x * y, p * q, "a * b");
            let [x, y, _] = new();
            check(x / y, p / q, "a / b");
            check(z.abs().sqrt(), r.abs().sqrt(), "sqrt");
            check(-z, -r, "-c");
            let [x, y, z] = new();
            let sum = match arithmetic.fused {
                true => p.mul_add(q, r),
                false => (p * q).flushed() + r,
            };
            check(x * y + z, sum, "a*b + c");
            let [x, y, z] = new();
            let wide = F::difference_of_products(&p, &q, &r, &p);
            check(
                Real::difference_of_products(&x, &y, &z, &x),
                wide,
                "a*b - c*a",
            );
        }
        let [x, y] = numbers([a, b], Arithmetic::FTZ);
        assert_eq!(x.is_zero(), p.is_zero());
        assert_eq!((x.is_less(&y), x.is_at_most(&y)), (p < q, p <= q));
    }
    assert!(flushed > 500, "{flushed}");
}

#[test]
fn subnormal_numbers_are_zeros_of_their_sign_in_either_scalar() {
    subnormal_numbers_are_zeros::<f32>();
    subnormal_numbers_are_zeros::<f64>();
}

#[test]
fn epsilons_below_the_normal_numbers_are_zero_where_subnormal_numbers_are() {
    let (ftz, largest) = (Arithmetic::FTZ, f32::MIN_POSITIVE.next_down());
    assert_eq!(ftz.largest_epsilon(-0.0f32), largest);
    assert_eq!(ftz.largest_epsilon(f32::MIN_POSITIVE), f32::MIN_POSITIVE);
    assert_eq!(Arithmetic::FMA.largest_epsilon(0.0f32), 0.0);
    let below = |x: f32| Emulated::new(x, ftz).just_below().value();
    assert_eq!(
        [below(f32::MIN_POSITIVE), below(0.0)],
        [0.0, -f32::MIN_POSITIVE]
    );
    assert_eq!(
        [below(1.0), below(-f32::MIN_POSITIVE)],
        [1f32.next_down(), (-f32::MIN_POSITIVE).next_down()]
    );
}

/// Sums that become others, and sums that only look as if they did.
fn sums_are_rearranged<F: Float>(arithmetic: Arithmetic) {
    let (mut changed, mut undone) = (0, 0);
    for index in 0..3_000 {
        let mut draw = Draw::new("rearranged", 1, index);
        let [a, b, h] = factors_and_term::<F>(&mut draw).map(|x| arithmetic.flush(x));
        let flushed = |x: F| arithmetic.flush(x);
        let product = |a: F, b: F| flushed(a * b);
        let sum = flushed(a + b);
        let new = || numbers([a, b, h], arithmetic);
        let check = |found: Emulated<F>, expected: F, what: &str| {
            let found = found.value();
            let same = found.to_bits() == expected.to_bits() || found.is_nan() && expected.is_nan();
            let told = format!("{arithmetic} {} {what}: {a:e} {b:e} {h:e}", F::NAME);
            assert!(same, "{told}: {found:e}, expected {expected:e}");
        };
        let [x, y, z] = new();
        check(x * &z + y * &z, product(sum, h), "a*h + b*h");
        let [x, y, z] = new();
        check(z.clone() * x + y * z, product(sum, h), "h*a + b*h");
        let [x, y, z] = new();
        check(-x * &z + y * z, product(flushed(b - a), h), "-a*h + b*h");
        // Names of products make no difference.
        let [x, y, z] = new();
        let [u, v] = [x * &z, y * &z];
        check(u.clone() + &v, product(sum, h), "u + v");
        check(u + &v, product(sum, h), "u + v again");
        // The factor may be an expression that is written twice.
        let [x, y, z] = new();
        let inverse = || Emulated::one() / &z;
        let expected = product(sum, flushed(F::one() / h));
        check(x * inverse() + y * inverse(), expected, "a*(1/h) + b*(1/h)");
        let [x, y, z] = new();
        check((x.clone() + &y) - &x, b, "(a + b) - a");
        check((x.clone() - &y) - &x, -b, "(a - b) - a");
        check((x.clone() - &y) + &y, a, "(a - b) + b");
        // No rule looks through a minus.
        check(
            x.clone() - (x.clone() + &y),
            flushed(a - sum),
            "a - (a + b)",
        );
        let two_products = |a: F, b: F| match arithmetic.fused {
            true => flushed(a.mul_add(h, product(b, h))),
            false => flushed(product(a, h) + product(b, h)),
        };
        check(x * &z - y * &z, two_products(a, -b), "a*h - b*h");
        let [x, y, z] = new();
        check(x * &z + y * -z, two_products(a, -b), "a*h + b*-h");
        // Equal values are not the same expression.
        let [x, y, z] = new();
        let [_, _, equal] = new();
        let apart = two_products(a, b);
        check(x * z + y * equal, apart, "a*h + b*k, h = k");
        let [x, y, _] = new();
        let [other, ..] = new();
        check((x + &y) - &other, flushed(sum - a), "(a + b) - c, a = c");
        changed += usize::from(apart != product(sum, h));
        undone += usize::from(sum - a != b);
    }
    assert!(changed > 150 && undone > 300, "{changed} {undone}");
}

#[test]
fn sums_are_rearranged_by_their_expressions_in_either_scalar() {
    for arithmetic in [Arithmetic::REARRANGED, Arithmetic::FMA_FTZ_REARRANGED] {
        sums_are_rearranged::<f32>(arithmetic);
        sums_are_rearranged::<f64>(arithmetic);
    }
}

#[test]
fn what_only_looks_alike_stays() {
    let [a, b, h] = [0.3f32, 0.4, 0.3];
    let new = || numbers([a, b, h], Arithmetic::REARRANGED);
    // Roots, absolute values, and numbers just below others are no factors of their own number.
    let [x, y, z] = new();
    let roots = x * z.abs() + y * &z;
    assert_eq!(roots.value(), a * h + b * h);
    let [x, y, z] = new();
    let below = x * z.just_below() + y * &z;
    assert_eq!(below.value(), a * h.next_down() + b * h);
    let [x, y, z] = new();
    assert_eq!((x / &z + y / &z).value(), a / h + b / h);
    // Without the liberty nothing is rearranged.
    let [x, y, z] = numbers([a, b, h], Arithmetic::IEEE);
    assert_eq!((x * &z + y * &z).value(), a * h + b * h);
    assert_ne!(a * h + b * h, (a + b) * h);
}
