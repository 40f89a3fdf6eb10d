//! Floor 0: one trait for numbers, one for vectors. They are implemented by `f32` and `f64` on glam, by
//! exact numbers, by floats that know whether they are exact, and by floats that compute as other
//! machines do.
//!
//! A kernel is written once against [`Real`] and [`Vector`], and runs unchanged in every arithmetic.
//! Comparisons go through the trait too. In [`Tracked`] numbers a comparison records the exceptions of
//! the compared numbers; in [`Bounded`] numbers it records whether the bounds could not decide.

#![forbid(unsafe_code)]

/// The operators of a number with methods for them on references. How a right operand is taken that is borrowed:
/// as it is, or as its clone, a name that is used again.
macro_rules! operators {
    ($generics:tt $number:ty, $borrowed:path) => {
        operators!($generics $number, $borrowed, Add add sum);
        operators!($generics $number, $borrowed, Sub sub difference);
        operators!($generics $number, $borrowed, Mul mul product);
        operators!($generics $number, $borrowed, Div div quotient);
        operators!($generics $number);
    };
    ([$($generic:tt)*] $number:ty, $borrowed:path, $trait:ident $method:ident $with:ident) => {
        impl<$($generic)*> std::ops::$trait for $number {
            type Output = Self;
            #[inline]
            fn $method(self, other: Self) -> Self {
                self.$with(&other)
            }
        }
        impl<$($generic)*> std::ops::$trait<&Self> for $number {
            type Output = Self;
            #[inline]
            fn $method(self, other: &Self) -> Self {
                let other = $borrowed(other);
                self.$with(&other)
            }
        }
    };
    ([$($generic:tt)*] $number:ty) => {
        impl<$($generic)*> std::ops::Neg for $number {
            type Output = Self;
            #[inline]
            fn neg(self) -> Self {
                self.negation()
            }
        }
    };
}

mod arithmetic;
mod bounded;
mod digits;
mod emulated;
mod environment;
mod exact;
mod expression;
mod float;
mod fraction;
mod rearranged;
pub mod recorded;
mod tracked;
mod triple;

pub use arithmetic::Arithmetic;
pub use bounded::{Bounded, bounded};
pub use digits::{three_digits, two_digits};
pub use emulated::{Emulated, Notes};
pub use environment::FloatEnvironment;
pub use exact::Exact;
pub use float::{
    Float, ScalarName, decompose, ordered_midpoint, scale_by_power_of_two, smallest_normal,
};
pub use fraction::Fraction;
pub use tracked::{Exceptions, Tracked, tracked};
pub use triple::{ExactVector, Triple};

use std::fmt::Debug;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// A number a kernel can compute with.
///
/// Not `Copy`: exact numbers own their digits. The left operand of an operator is consumed and the
/// right one may be borrowed, which keeps formulas readable: `(k - n.dot(p)) / n.dot(d)`.
pub trait Real:
    Clone
    + Debug
    + Send
    + Sync
    + 'static
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + for<'a> Add<&'a Self, Output = Self>
    + for<'a> Sub<&'a Self, Output = Self>
    + for<'a> Mul<&'a Self, Output = Self>
    + for<'a> Div<&'a Self, Output = Self>
{
    /// Positive zero.
    fn zero() -> Self;
    /// One.
    fn one() -> Self;
    /// A constant of a source, rounded to the arithmetic's format.
    fn number(value: f64) -> Self;
    /// Absolute value.
    fn abs(&self) -> Self;
    /// Square root; NaN of a negative number.
    fn sqrt(&self) -> Self;
    /// The sign bit, as `f32::is_sign_negative`. An exact zero reads positive, and so does a NaN,
    /// whose sign bit machines do not agree on.
    fn is_sign_negative(&self) -> bool;
    /// `self < other`; false if either is NaN.
    fn is_less(&self, other: &Self) -> bool;
    /// `self <= other`; false if either is NaN.
    fn is_at_most(&self, other: &Self) -> bool;
    /// `self == 0`; false if NaN.
    fn is_zero(&self) -> bool;
    /// True if this is NaN.
    fn is_nan(&self) -> bool;
    /// True if this is neither NaN nor infinite.
    fn is_finite(&self) -> bool;
    /// Positive infinity.
    fn infinity() -> Self;
    /// The next number below: for a float the next representable one, for an exact number itself
    /// (read as "anything below").
    fn just_below(&self) -> Self {
        self.clone()
    }
    /// The smaller of two numbers; the first where neither is less.
    fn smaller(self, other: Self) -> Self {
        if other.is_less(&self) { other } else { self }
    }
    /// The larger of two numbers; the first where neither is less.
    fn larger(self, other: Self) -> Self {
        if self.is_less(&other) { other } else { self }
    }
    /// `a*b - c*d` in the wider arithmetic that Woop's fallback needs: `f32` through `f64`, `f64`
    /// by exact products (an addition of this project), exact numbers as they are.
    fn difference_of_products(a: &Self, b: &Self, c: &Self, d: &Self) -> Self {
        a.clone() * b - c.clone() * d
    }
    /// `a*b + c`, rounded once where a source calls for the fused operation itself, in whatever arithmetic.
    fn fused(a: &Self, b: &Self, c: &Self) -> Self {
        a.clone() * b + c
    }
    /// The largest epsilon at which `accepts` still holds, for a test in which the source rounds
    /// with the epsilon in it. `accepts` is monotone: once false it stays false as its argument
    /// grows. `exact` is the threshold of the same test without rounding.
    ///
    /// A float searches its ordered bit patterns, outwards from `exact`; an exact number takes `exact`.
    fn largest_accepted(_accepts: impl Fn(&Self) -> bool, exact: impl FnOnce() -> Self) -> Self {
        exact()
    }
}

/// Three [`Real`]s.
pub trait Vector: Clone + Debug + Send + Sync + 'static {
    /// The coordinates' arithmetic.
    type Real: Real;
    /// From coordinates.
    fn new(x: Self::Real, y: Self::Real, z: Self::Real) -> Self;
    /// Coordinate 0, 1 or 2.
    fn at(&self, axis: usize) -> Self::Real;
    /// `self - other`.
    fn minus(&self, other: &Self) -> Self;
    /// `self + other`.
    fn plus(&self, other: &Self) -> Self;
    /// `self * factor`.
    fn times(&self, factor: &Self::Real) -> Self;
    /// `self + factor·vector`, as a point of a ray. `self` is moved: where it is a product itself, an
    /// arithmetic with fused products may take it before it is rounded.
    #[inline(always)]
    fn plus_scaled(self, vector: &Self, factor: &Self::Real) -> Self {
        self.plus(&vector.times(factor))
    }
    /// The dot product, summed from the left.
    fn dot(&self, other: &Self) -> Self::Real;
    /// The cross product.
    fn cross(&self, other: &Self) -> Self;

    /// `self * (1 / sqrt(self·self))`, as glm and glam normalise.
    fn normalize(&self) -> Self {
        self.times(&(Self::Real::one() / self.dot(self).sqrt()))
    }

    /// The axis of the coordinate that is largest in absolute value; the first of equals.
    fn largest_axis(&self) -> usize {
        let [x, y, z] = [self.at(0).abs(), self.at(1).abs(), self.at(2).abs()];
        match (x.is_less(&y), x.is_less(&z), y.is_less(&z)) {
            (false, false, _) => 0,
            (_, _, false) => 1,
            _ => 2,
        }
    }
}
