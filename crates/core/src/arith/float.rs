//! `f32` on glam's `Vec3`, `f64` on glam's `DVec3`: the scalar vectors, never `Vec3A`.

use super::{Real, Vector};
use glam::{DVec3, Vec3};
use std::fmt::{Display, LowerExp};

named! {
    pub names
    /// A scalar that kernels are judged in, where text or a record names it; [`Float`] is its numbers.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
    pub enum ScalarName {
        /// IEEE 754 binary32.
        F32 = "f32",
        /// IEEE 754 binary64.
        F64 = "f64",
    }
}

impl ScalarName {
    /// Those that are chosen, where `f32` and `f64` are each chosen or not.
    pub fn among(are_chosen: [bool; 2]) -> impl Iterator<Item = ScalarName> + Clone {
        let all = ScalarName::ALL.into_iter().zip(are_chosen);
        all.filter_map(|(scalar, is_chosen)| is_chosen.then_some(scalar))
    }

    /// The choice of this one alone, `f32` before `f64`.
    pub fn alone(self) -> [bool; 2] {
        ScalarName::ALL.map(|scalar| scalar == self)
    }
}

#[cfg(feature = "schema")]
impl schemars::JsonSchema for ScalarName {
    fn schema_name() -> std::borrow::Cow<'static, str> {
        "ScalarName".into()
    }

    fn json_schema(_: &mut schemars::SchemaGenerator) -> schemars::Schema {
        schemars::json_schema!({ "type": "string", "enum": ScalarName::ALL })
    }
}

/// An IEEE 754 binary float that kernels are judged in: `f32` or `f64`.
pub trait Float: Real + Copy + PartialOrd + Display + LowerExp + Default {
    /// The glam vector of this scalar.
    type Vector: Vector<Real = Self> + Copy + From<[Self; 3]> + Into<[Self; 3]>;
    /// `f32` or `f64`, as text and records name it.
    const NAME: ScalarName;
    /// Bits in the significand, the hidden one included.
    const DIGITS: u32;
    /// Exponent of the smallest positive number: it is 2 to this power.
    const MIN_EXPONENT: i32;
    /// Exponent of the largest finite number: it is at least 2 to this power, and less than twice that.
    const MAX_EXPONENT: i32;
    /// The distance from 1 to the next number above.
    const EPSILON: Self;
    /// Rounded to nearest, ties to even.
    fn from_f64(value: f64) -> Self;
    /// Exactly.
    fn to_f64(self) -> f64;
    /// The bit pattern, in the low bits.
    fn to_bits(self) -> u64;
    /// From a bit pattern in the low bits.
    fn from_bits(bits: u64) -> Self;
    /// The nearest number to a decimal text, correctly rounded; also `inf`, `nan`.
    fn parse(text: &str) -> Option<Self>;
    /// The place in the order of all floats, counted from the zeros (which share place 0).
    fn place(self) -> i64;
    /// The float at a place; positive zero at place 0.
    fn from_place(place: i64) -> Self;
    /// The unit in the last place: the distance from `|self|` to the next larger number, or from the largest number
    /// to the one before. NaN of infinities and of a NaN.
    fn ulp(self) -> Self;
    /// The bit pattern in hexadecimal, all digits.
    fn hex(self) -> String;

    /// `self*factor + term`, rounded once (IEEE 754's fusedMultiplyAdd), on every machine: where the
    /// processor has no such instruction a library computes the same.
    fn mul_add(self, factor: Self, term: Self) -> Self;

    /// The float `ulps` places above (below if negative); stops at the infinities; a NaN stays.
    fn offset_ulps(self, ulps: i64) -> Self {
        if self.is_nan() {
            return self;
        }
        let end = Self::infinity().place();
        Self::from_place(self.place().saturating_add(ulps).clamp(-end, end))
    }
}

/// A float strictly between two others, halfway in the order of all floats; none between
/// neighbours.
pub fn ordered_midpoint<F: Float>(low: F, high: F) -> Option<F> {
    let (low, high) = (low.place(), high.place());
    let middle = low.midpoint(high);
    (middle != low && middle != high).then(|| F::from_place(middle))
}

/// A number that is accepted and a higher one that is not, near a guess: from there the search takes steps of 1, 2, 4 …
/// places. The scalar's lowest finite number is accepted and its largest is not.
fn bracket<F: Float>(guess: F, accepts: &impl Fn(&F) -> bool) -> (F, F) {
    let largest = F::infinity().offset_ulps(-1);
    if !guess.is_finite() {
        return (-largest, largest);
    }
    let end = largest.place();
    let goes_up = accepts(&guess);
    let mut step: i64 = if goes_up { 1 } else { -1 };
    let mut at = guess;
    loop {
        let place = at.place().saturating_add(step).clamp(-end, end);
        let next = F::from_place(place);
        if accepts(&next) != goes_up {
            return if goes_up { (at, next) } else { (next, at) };
        }
        at = next;
        step = step.saturating_mul(2);
    }
}

/// The smallest positive number of a scalar that no machine flushes to zero.
pub fn smallest_normal<F: Float>() -> f64 {
    scale_by_power_of_two(1.0, F::MIN_EXPONENT + F::DIGITS as i32 - 1)
}

/// `value * 2^exponent`, rounded once (the steps but the last are exact or already zero or
/// infinite).
#[inline]
pub fn scale_by_power_of_two(mut value: f64, mut exponent: i32) -> f64 {
    while exponent > 1000 {
        value *= power_of_two(1000);
        exponent -= 1000;
    }
    // Downwards the large step comes last, so that only one product rounds. Only an infinity comes here again.
    while exponent < -1000 && value.abs() > power_of_two(1000 - 52) {
        value *= power_of_two(-900);
        exponent += 900;
    }
    if exponent < -2022 {
        // Not above 2^948 by now, so it rounds to zero.
        return value * 0.0;
    }
    if exponent < -1022 {
        return value * power_of_two(exponent + 1000) * power_of_two(-1000);
    }
    value * power_of_two(exponent)
}

/// 2 to a power in -1022..=1023.
fn power_of_two(exponent: i32) -> f64 {
    f64::from_bits(((exponent + 1023) as u64) << 52)
}

/// A finite float as an odd integer (or zero) times a power of two: digits and exponent.
pub fn decompose(value: f64) -> (i64, i64) {
    let bits = value.to_bits();
    let field = (bits >> 52 & 0x7ff) as i64;
    let fraction = (bits & ((1 << 52) - 1)) as i64;
    let (digits, exponent) = if field == 0 {
        (fraction, -1074)
    } else {
        (fraction | 1 << 52, field - 1075)
    };
    if digits == 0 {
        return (0, 0);
    }
    let zeros = digits.trailing_zeros();
    let size = digits >> zeros;
    let odd = if value < 0.0 { -size } else { size };
    (odd, exponent + i64::from(zeros))
}

/// `a*b - c*d` through `f64`, where the products of two `f32` are exact: Woop's fallback.
fn wide_f32(a: f32, b: f32, c: f32, d: f32) -> f32 {
    (f64::from(a) * f64::from(b) - f64::from(c) * f64::from(d)) as f32
}

/// `a*b - c*d` from exact products: each is a rounded product and its exact remainder, and the two
/// differences are added. Zero exactly when the products are equal (Jeannerod, Louvet and Muller
/// 2013 bound the error of this scheme by 1.5 ulps, barring underflow of the remainders).
fn wide_f64(a: f64, b: f64, c: f64, d: f64) -> f64 {
    let (p, q) = (a * b, c * d);
    if !(p.is_finite() && q.is_finite()) {
        return p - q;
    }
    (p - q) + (a.mul_add(b, -p) - c.mul_add(d, -q))
}

macro_rules! float {
    ($scalar:ident, $name:ident, $vector:ident, $bits:ident, $wide:expr) => {
        impl Real for $scalar {
            #[inline(always)]
            fn zero() -> Self {
                0.0
            }
            #[inline(always)]
            fn one() -> Self {
                1.0
            }
            #[inline(always)]
            fn number(value: f64) -> Self {
                value as $scalar
            }
            #[inline(always)]
            fn abs(&self) -> Self {
                $scalar::abs(*self)
            }
            #[inline(always)]
            fn sqrt(&self) -> Self {
                $scalar::sqrt(*self)
            }
            #[inline(always)]
            fn is_sign_negative(&self) -> bool {
                $scalar::is_sign_negative(*self) && !$scalar::is_nan(*self)
            }
            #[inline(always)]
            fn is_less(&self, other: &Self) -> bool {
                self < other
            }
            #[inline(always)]
            fn is_at_most(&self, other: &Self) -> bool {
                self <= other
            }
            #[inline(always)]
            fn is_zero(&self) -> bool {
                *self == 0.0
            }
            #[inline(always)]
            fn is_nan(&self) -> bool {
                $scalar::is_nan(*self)
            }
            #[inline(always)]
            fn is_finite(&self) -> bool {
                $scalar::is_finite(*self)
            }
            #[inline(always)]
            fn infinity() -> Self {
                $scalar::INFINITY
            }
            #[inline]
            fn just_below(&self) -> Self {
                if *self == $scalar::INFINITY {
                    *self
                } else {
                    self.next_down()
                }
            }
            #[inline]
            fn difference_of_products(a: &Self, b: &Self, c: &Self, d: &Self) -> Self {
                $wide(*a, *b, *c, *d)
            }
            #[inline]
            fn fused(a: &Self, b: &Self, c: &Self) -> Self {
                $scalar::mul_add(*a, *b, *c)
            }
            fn largest_accepted(
                accepts: impl Fn(&Self) -> bool,
                exact: impl FnOnce() -> Self,
            ) -> Self {
                if accepts(&$scalar::MAX) {
                    return $scalar::INFINITY;
                }
                if !accepts(&$scalar::MIN) {
                    return $scalar::NEG_INFINITY;
                }
                let (mut low, mut high) = bracket(exact(), &accepts);
                while let Some(middle) = ordered_midpoint(low, high) {
                    if accepts(&middle) {
                        low = middle
                    } else {
                        high = middle
                    }
                }
                low
            }
        }

        impl Float for $scalar {
            type Vector = $vector;
            const NAME: ScalarName = ScalarName::$name;
            const DIGITS: u32 = $scalar::MANTISSA_DIGITS;
            const MIN_EXPONENT: i32 = $scalar::MIN_EXP - $scalar::MANTISSA_DIGITS as i32;
            const MAX_EXPONENT: i32 = $scalar::MAX_EXP - 1;
            const EPSILON: Self = $scalar::EPSILON;
            #[inline]
            fn from_f64(value: f64) -> Self {
                value as $scalar
            }
            #[inline]
            fn to_f64(self) -> f64 {
                f64::from(self)
            }
            #[inline]
            fn to_bits(self) -> u64 {
                u64::from($scalar::to_bits(self))
            }
            #[inline]
            fn from_bits(bits: u64) -> Self {
                $scalar::from_bits(bits as $bits)
            }
            fn parse(text: &str) -> Option<Self> {
                text.parse().ok()
            }
            fn place(self) -> i64 {
                let magnitude = $scalar::to_bits(self.abs()) as i64;
                if self.is_sign_negative() {
                    -magnitude
                } else {
                    magnitude
                }
            }
            fn from_place(place: i64) -> Self {
                let magnitude = $scalar::from_bits(place.unsigned_abs() as $bits);
                if place < 0 { -magnitude } else { magnitude }
            }
            fn ulp(self) -> Self {
                let magnitude = self.abs();
                if !magnitude.is_finite() {
                    return $scalar::NAN;
                }
                if magnitude == $scalar::MAX {
                    return magnitude - magnitude.next_down();
                }
                magnitude.next_up() - magnitude
            }
            #[inline]
            fn mul_add(self, factor: Self, term: Self) -> Self {
                $scalar::mul_add(self, factor, term)
            }
            fn hex(self) -> String {
                format!(
                    "{:0width$x}",
                    $scalar::to_bits(self),
                    width = size_of::<$scalar>() * 2
                )
            }
        }

        impl Vector for $vector {
            type Real = $scalar;
            #[inline(always)]
            fn new(x: $scalar, y: $scalar, z: $scalar) -> Self {
                $vector::new(x, y, z)
            }
            #[inline(always)]
            fn at(&self, axis: usize) -> $scalar {
                self.to_array()[axis]
            }
            #[inline(always)]
            fn minus(&self, other: &Self) -> Self {
                *self - *other
            }
            #[inline(always)]
            fn plus(&self, other: &Self) -> Self {
                *self + *other
            }
            #[inline(always)]
            fn times(&self, factor: &$scalar) -> Self {
                *self * *factor
            }
            #[inline(always)]
            fn dot(&self, other: &Self) -> $scalar {
                $vector::dot(*self, *other)
            }
            #[inline(always)]
            fn cross(&self, other: &Self) -> Self {
                $vector::cross(*self, *other)
            }
        }
    };
}

float!(f32, F32, Vec3, u32, wide_f32);
float!(f64, F64, DVec3, u64, wide_f64);

#[cfg(test)]
mod tests;
