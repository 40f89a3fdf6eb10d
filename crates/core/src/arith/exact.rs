//! Exact numbers: `p + q√r` over the rationals, with the infinities and NaN of IEEE 754.
//!
//! A kernel run takes at most one square root (a normalisation), so one radicand a run suffices;
//! a second, different one makes the result NaN rather than wrong.

use super::{Fraction, Real, scale_by_power_of_two};
use num_rational::BigRational;
use std::cmp::Ordering;
use std::sync::Arc;

/// An exact number of a kernel run. One zero, whose sign bit reads positive.
#[derive(Clone, Debug)]
pub enum Exact {
    /// Not a number.
    Nan,
    /// Positive infinity, or negative if true.
    Infinite(bool),
    /// A rational.
    Rational(Fraction),
    /// `p + q√r`, with `q` not zero and `r` positive.
    Root {
        /// The rational part.
        p: Fraction,
        /// The factor of the root.
        q: Fraction,
        /// The radicand, shared by a run.
        r: Arc<Fraction>,
    },
}

use Exact::{Infinite, Nan, Rational, Root};

impl Exact {
    /// The exact value of a float; infinities and NaN stay what they are.
    pub fn from_f64(value: f64) -> Exact {
        if value.is_nan() {
            Nan
        } else if value.is_infinite() {
            Infinite(value < 0.0)
        } else {
            Rational(Fraction::from_f64(value))
        }
    }

    /// The sign of the number; none of NaN.
    pub fn sign(&self) -> Option<Ordering> {
        match self {
            Nan => None,
            Infinite(negative) => Some(if *negative {
                Ordering::Less
            } else {
                Ordering::Greater
            }),
            Rational(p) => Some(p.sign()),
            Root { p, q, r } => {
                let (sp, sq) = (p.sign(), q.sign());
                Some(if sp == Ordering::Equal || sp == sq {
                    sq
                } else {
                    // Opposite signs: the larger square wins. p² - q²r has p's sign if p does.
                    let squares = p.mul(p).add(&q.mul(q).mul(r).negated());
                    if sp == Ordering::Greater {
                        squares.sign()
                    } else {
                        squares.sign().reverse()
                    }
                })
            }
        }
    }

    /// The exact value of a rational.
    pub fn from_rational(value: &BigRational) -> Exact {
        Rational(Fraction::from_rational(value))
    }

    /// As a reduced rational; none of NaN, the infinities and irrational numbers.
    pub fn to_rational(&self) -> Option<BigRational> {
        match self {
            Rational(p) => Some(p.to_rational()),
            _ => None,
        }
    }

    /// The nearest float, within a few ulps whatever cancels or leaves the floats' range on the way: for
    /// people to read, never for a decision.
    pub fn approximate(&self) -> f64 {
        match self {
            Nan => f64::NAN,
            Infinite(true) => f64::NEG_INFINITY,
            Infinite(false) => f64::INFINITY,
            Rational(p) => float(p.significand()),
            Root { p, q, r } if p.sign() != q.sign().reverse() => float(sum_of_parts(p, q, r)),
            Root { p, q, r } => {
                // Of opposite signs the parts may cancel: p + q√r = (p² - q²r) / (p - q√r).
                let norm = p.mul(p).add(&q.mul(q).mul(r).negated());
                let (above, i) = norm.significand();
                let (below, j) = sum_of_parts(p, &q.negated(), r);
                float((above / below, i - j))
            }
        }
    }

    /// The square root of a rational that is not negative, as a float within a few ulps, even where
    /// the number itself is out of the floats' range; NaN of any other number.
    pub fn approximate_root(&self) -> f64 {
        match self {
            Rational(p) => float(p.root_significand()),
            _ => f64::NAN,
        }
    }

    fn combine(p: Fraction, q: Fraction, r: &Arc<Fraction>) -> Exact {
        if q.is_zero() {
            Rational(p)
        } else {
            Root {
                p,
                q,
                r: Arc::clone(r),
            }
        }
    }

    fn sum(&self, other: &Exact) -> Exact {
        match (self, other) {
            (Nan, _) | (_, Nan) => Nan,
            (Infinite(a), Infinite(b)) => {
                if a == b {
                    Infinite(*a)
                } else {
                    Nan
                }
            }
            (Infinite(a), _) | (_, Infinite(a)) => Infinite(*a),
            (Rational(a), Rational(b)) => Rational(a.add(b)),
            (Rational(a), Root { p, q, r }) | (Root { p, q, r }, Rational(a)) => Root {
                p: p.add(a),
                q: q.clone(),
                r: Arc::clone(r),
            },
            (
                Root { p, q, r },
                Root {
                    p: p2,
                    q: q2,
                    r: r2,
                },
            ) => match same_root(r, r2) {
                true => Exact::combine(p.add(p2), q.add(q2), r),
                false => Nan,
            },
        }
    }

    fn difference(&self, other: &Exact) -> Exact {
        self.sum(&other.negation())
    }

    fn negation(&self) -> Exact {
        match self {
            Nan => Nan,
            Infinite(negative) => Infinite(!negative),
            Rational(p) => Rational(p.negated()),
            Root { p, q, r } => Root {
                p: p.negated(),
                q: q.negated(),
                r: Arc::clone(r),
            },
        }
    }

    fn product(&self, other: &Exact) -> Exact {
        match (self, other) {
            (Nan, _) | (_, Nan) => Nan,
            (Infinite(_), _) | (_, Infinite(_)) => match (self.sign(), other.sign()) {
                (Some(Ordering::Equal), _) | (_, Some(Ordering::Equal)) => Nan,
                (a, b) => Infinite(a != b),
            },
            (Rational(a), Rational(b)) => Rational(a.mul(b)),
            (Rational(a), Root { p, q, r }) | (Root { p, q, r }, Rational(a)) => {
                Exact::combine(p.mul(a), q.mul(a), r)
            }
            (
                Root { p, q, r },
                Root {
                    p: p2,
                    q: q2,
                    r: r2,
                },
            ) => match same_root(r, r2) {
                true => Exact::combine(
                    p.mul(p2).add(&q.mul(q2).mul(r)),
                    p.mul(q2).add(&q.mul(p2)),
                    r,
                ),
                false => Nan,
            },
        }
    }

    fn reciprocal(&self) -> Exact {
        match self {
            Nan => Nan,
            Infinite(_) => Rational(Fraction::zero()),
            // One zero, read as positive, so dividing by it gives positive infinity.
            _ if self.sign() == Some(Ordering::Equal) => Infinite(false),
            Rational(p) => Rational(p.reciprocal()),
            Root { p, q, r } => {
                // 1/(p + q√r) = (p - q√r) / (p² - q²r). The norm is zero only if √r is rational and
                // p = q√r; then the number is 2p.
                let norm = p.mul(p).add(&q.mul(q).mul(r).negated());
                if norm.is_zero() {
                    return Rational(p.add(p).reciprocal());
                }
                let inverse = norm.reciprocal();
                Exact::combine(p.mul(&inverse), q.negated().mul(&inverse), r)
            }
        }
    }

    fn quotient(&self, other: &Exact) -> Exact {
        match (self, other) {
            (Infinite(_), Infinite(_)) => Nan,
            // IEEE 754 divides zero by zero to NaN; infinity by zero stays infinite.
            (Infinite(negative), _) if other.sign() == Some(Ordering::Equal) => Infinite(*negative),
            _ => self.product(&other.reciprocal()),
        }
    }
}

/// `digits · 2^exponent`, rounded to a float.
fn float((digits, exponent): (f64, i64)) -> f64 {
    scale_by_power_of_two(digits, exponent.clamp(-4000, 4000) as i32)
}

/// `p + q√r` of parts that do not differ in sign, as a float and a power of two.
fn sum_of_parts(p: &Fraction, q: &Fraction, r: &Fraction) -> (f64, i64) {
    let ((factor, i), (root, j)) = (q.significand(), r.root_significand());
    let (digits, exponent) = (factor * root, i + j);
    if p.is_zero() {
        return (digits, exponent);
    }
    let (other_digits, other_exponent) = p.significand();
    let top = exponent.max(other_exponent);
    (
        float((digits, exponent - top)) + float((other_digits, other_exponent - top)),
        top,
    )
}

fn same_root(a: &Arc<Fraction>, b: &Arc<Fraction>) -> bool {
    Arc::ptr_eq(a, b) || a.add(&b.negated()).is_zero()
}

operators!([] Exact, std::convert::identity);

impl Real for Exact {
    fn zero() -> Self {
        Rational(Fraction::zero())
    }
    fn one() -> Self {
        Exact::from_f64(1.0)
    }
    fn number(value: f64) -> Self {
        Exact::from_f64(value)
    }
    fn abs(&self) -> Self {
        if self.sign() == Some(Ordering::Less) {
            self.negation()
        } else {
            self.clone()
        }
    }
    fn sqrt(&self) -> Self {
        match (self, self.sign()) {
            (_, None | Some(Ordering::Less)) => Nan,
            (_, Some(Ordering::Equal)) => Exact::zero(),
            (Rational(r), _) => Root {
                p: Fraction::zero(),
                q: Fraction::from_f64(1.0),
                r: Arc::new(r.clone()),
            },
            (Infinite(_), _) => Infinite(false),
            // A root of a root: no kernel takes one.
            _ => Nan,
        }
    }
    fn is_sign_negative(&self) -> bool {
        self.sign() == Some(Ordering::Less)
    }
    fn is_less(&self, other: &Self) -> bool {
        compare(self, other) == Some(Ordering::Less)
    }
    fn is_at_most(&self, other: &Self) -> bool {
        matches!(compare(self, other), Some(Ordering::Less | Ordering::Equal))
    }
    fn is_zero(&self) -> bool {
        self.sign() == Some(Ordering::Equal)
    }
    fn is_nan(&self) -> bool {
        matches!(self, Nan)
    }
    fn is_finite(&self) -> bool {
        !matches!(self, Nan | Infinite(_))
    }
    fn infinity() -> Self {
        Infinite(false)
    }
}

fn compare(a: &Exact, b: &Exact) -> Option<Ordering> {
    match (a, b) {
        (Nan, _) | (_, Nan) => None,
        (Infinite(x), Infinite(y)) => Some(y.cmp(x)),
        _ => a.difference(b).sign(),
    }
}

#[cfg(test)]
mod tests;
