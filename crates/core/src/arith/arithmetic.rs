//! How machines compute that do not follow IEEE 754 operation by operation: they fuse products into
//! sums, flush subnormal numbers to zero, or rearrange sums. All is done in software here, so the answer is the
//! same on every machine and in every mode.

use super::Float;
use std::fmt;
use std::str::FromStr;

/// How a machine rounds: IEEE 754's operations one by one, or with some of three liberties that compilers and
/// graphics processors take.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Arithmetic {
    /// A product that goes straight into a sum or a difference is not rounded: one fused multiply-add
    /// (IEEE 754, 5.4.1) instead of two operations. If both terms are such products, the left one is fused.
    pub fused: bool,
    /// Subnormal numbers are zeros of their sign, as operands and as results (on x86 DAZ and FTZ
    /// together). A result is flushed if it is subnormal after it was rounded to the format.
    pub flushed: bool,
    /// A common factor is taken out of a sum of two products, `a*h + b*h` is `(a + b)*h`, and a sum is undone
    /// without rounding, `(a + b) - a` is `b`. Factors and terms are the same if their expressions are. A minus before
    /// a product or a sum hides it: `a*h - b*h` and `a - (a + b)` stay.
    pub rearranged: bool,
}

impl Arithmetic {
    /// IEEE 754, operation by operation.
    pub const IEEE: Arithmetic = Arithmetic {
        fused: false,
        flushed: false,
        rearranged: false,
    };
    /// Products are fused into sums.
    pub const FMA: Arithmetic = Arithmetic {
        fused: true,
        ..Arithmetic::IEEE
    };
    /// Subnormal numbers are flushed to zero.
    pub const FTZ: Arithmetic = Arithmetic {
        flushed: true,
        ..Arithmetic::IEEE
    };
    /// Both.
    pub const FMA_FTZ: Arithmetic = Arithmetic {
        fused: true,
        ..Arithmetic::FTZ
    };
    /// Sums are rearranged.
    pub const REARRANGED: Arithmetic = Arithmetic {
        rearranged: true,
        ..Arithmetic::IEEE
    };
    /// All three.
    pub const FMA_FTZ_REARRANGED: Arithmetic = Arithmetic {
        rearranged: true,
        ..Arithmetic::FMA_FTZ
    };

    /// All of them, in the order of reports.
    pub const ALL: [Arithmetic; 6] = [
        Arithmetic::IEEE,
        Arithmetic::FMA,
        Arithmetic::FTZ,
        Arithmetic::FMA_FTZ,
        Arithmetic::REARRANGED,
        Arithmetic::FMA_FTZ_REARRANGED,
    ];

    /// The name on a command line and, after a `+`, in a kernel's name.
    pub const fn name(self) -> &'static str {
        self.told().0
    }

    /// A description in one line.
    pub const fn describe(self) -> &'static str {
        self.told().1
    }

    /// The name and the description.
    const fn told(self) -> (&'static str, &'static str) {
        match (self.fused, self.flushed, self.rearranged) {
            (false, false, false) => ("ieee", "IEEE 754, operation by operation (the default)"),
            (true, false, false) => (
                "fma",
                "products that go straight into a sum are fused, the left one of two",
            ),
            (false, true, false) => (
                "ftz",
                "subnormal numbers are zero, as operands and as results",
            ),
            (true, true, false) => ("fma-ftz", "fused products, and subnormal numbers are zero"),
            (false, false, true) => (
                "rearranged",
                "sums rearranged: a*h + b*h is (a+b)*h, (a+b)-a is b",
            ),
            // Of the arithmetics that rearrange there are two.
            (_, _, true) => ("fma-ftz-rearranged", "fma-ftz, and sums are rearranged"),
        }
    }

    /// The liberties of both.
    pub(super) fn and(self, other: Arithmetic) -> Arithmetic {
        Arithmetic {
            fused: self.fused | other.fused,
            flushed: self.flushed | other.flushed,
            rearranged: self.rearranged | other.rearranged,
        }
    }

    /// A number as this arithmetic's operations see and leave it.
    #[inline]
    pub fn flush<F: Float>(self, value: F) -> F {
        let is_flushed = self.flushed && value.abs() < smallest_normal::<F>();
        match (is_flushed, value.is_sign_negative()) {
            (false, _) => value,
            (true, false) => F::zero(),
            (true, true) => -F::zero(),
        }
    }

    /// The largest epsilon that is not above `margin` once it is flushed: where subnormal numbers are
    /// zero, the largest of them for a margin of zero or of a positive one, and none of them for a
    /// negative one.
    pub fn largest_epsilon<F: Float>(self, margin: F) -> F {
        let smallest = smallest_normal::<F>();
        if !self.flushed || margin.is_nan() || smallest <= margin.abs() {
            margin
        } else if margin < F::zero() {
            -smallest
        } else {
            smallest.just_below()
        }
    }

    /// The next number below that this arithmetic tells apart.
    pub(super) fn just_below<F: Float>(self, value: F) -> F {
        let smallest = smallest_normal::<F>();
        match self.flushed {
            true if value.is_zero() => -smallest,
            true if value == smallest => F::zero(),
            _ => value.just_below(),
        }
    }
}

/// The smallest positive number that is not subnormal.
pub(super) fn smallest_normal<F: Float>() -> F {
    F::from_place(1 << (F::DIGITS - 1))
}

/// One rounded operation on floats.
#[derive(Clone, Copy, Debug)]
pub enum RoundedOperation<F> {
    /// `a + b`.
    Sum(F, F),
    /// `a * b`.
    Product(F, F),
    /// `a*b + c`, rounded once.
    Fused(F, F, F),
    /// `a*b - c*d` in wider arithmetic, then rounded to the format.
    Minor(F, F, F, F),
    /// `a / b`.
    Quotient(F, F),
    /// The square root.
    Root(F),
}

impl<F: Float> RoundedOperation<F> {
    /// The result.
    #[inline]
    pub fn run(self, arithmetic: Arithmetic) -> F {
        arithmetic.flush(match self {
            RoundedOperation::Sum(a, b) => a + b,
            RoundedOperation::Product(a, b) => a * b,
            RoundedOperation::Fused(a, b, c) => a.mul_add(b, c),
            RoundedOperation::Minor(a, b, c, d) => F::difference_of_products(&a, &b, &c, &d),
            RoundedOperation::Quotient(a, b) => a / b,
            RoundedOperation::Root(a) => a.sqrt(),
        })
    }
}

impl fmt::Display for Arithmetic {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl FromStr for Arithmetic {
    type Err = String;

    fn from_str(text: &str) -> Result<Arithmetic, String> {
        Arithmetic::ALL
            .into_iter()
            .find(|arithmetic| arithmetic.name() == text)
            .ok_or_else(|| {
                let names = Arithmetic::ALL.map(Arithmetic::name).join(", ");
                format!("unknown arithmetic '{text}': there are {names}")
            })
    }
}
