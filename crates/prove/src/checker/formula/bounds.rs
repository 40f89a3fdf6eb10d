//! The bounds of a formula's steps, from those of their operands: "Sizes and h" and "Higher order" in the guide.

use super::super::format::{Bound, F32, F64, Format};
use super::super::number::{ERROR_DIGITS, Number, round_up};
use super::{Formula, Step};
use num_traits::Zero;

/// The bounds of all steps, and the higher orders of the last one.
pub struct Run {
    pub bounds: Vec<Bound>,
    pub rest: Number,
}

/// A bound of a step's error, in two summands.
struct Orders {
    /// The terms of first order.
    first: Number,
    /// All others.
    rest: Number,
}

impl Formula<'_> {
    /// The bounds of the steps, with sizes from the corners, or as they are known from an earlier run; and the higher
    /// orders of the last step, with every number at its largest size and nothing cancelled.
    ///
    /// A relative step's own error is bounded by u times its exact size only where bounds are known.
    pub fn run(&self, format: &Format, sizes: &[Number], known: Option<&[Bound]>) -> Run {
        let mut bounds: Vec<Bound> = Vec::new();
        let mut all: Vec<Orders> = Vec::new();
        for (k, step) in self.steps.iter().enumerate() {
            let Orders { first, rest } = step.brought(&bounds, &all);
            let before = &first + &rest;
            let bound = match (known, &step.given) {
                (Some(known), _) => known[k].clone(),
                (None, Some(given)) => given.clone(),
                (None, None) => step.bound(format, &bounds, &sizes[k], &before),
            };
            let own = if known.is_some() && step.relative {
                // fl(z) is off by at most u|z| and a tiny number, and z by at most `before` from the exact value.
                Orders {
                    first: &format.unit * &bound.size,
                    rest: &format.unit * before + &format.tiny,
                }
            } else {
                Orders {
                    first: bound.error.clone(),
                    rest: Number::zero(),
                }
            };
            bounds.push(bound);
            all.push(Orders {
                first: first + own.first,
                rest: rest + own.rest,
            });
        }
        let last = all.pop();
        let rest = last.map_or(Number::zero(), |orders| orders.rest);
        Run { bounds, rest }
    }
}

impl Step<'_> {
    /// The error that the operands bring. A sum adds theirs. The error of a product is
    /// (|a| + f_a + r_a)(|b| + f_b + r_b) less the exact product, in which the terms with one f are the first order.
    fn brought(&self, bounds: &[Bound], above: &[Orders]) -> Orders {
        let mut first = Number::zero();
        let mut rest = Number::zero();
        for term in &self.terms {
            let a = &above[term.left];
            let Some(right) = term.right else {
                first += &a.first;
                rest += &a.rest;
                continue;
            };
            let b = &above[right];
            let size_a = &bounds[term.left].size;
            let size_b = &bounds[right].size;
            first += size_a * &b.first;
            first += &a.first * size_b;
            rest += &a.first * &b.first;
            rest += &a.rest * (size_b + &b.first + &b.rest);
            rest += (size_a + &a.first) * &b.rest;
        }
        Orders { first, rest }
    }

    /// The bound that follows from the operands' bounds, the size at the corners, and the error that operands bring.
    ///
    /// The exact size has two bounds, one of each kind, and so has the computed number before it is rounded. The smaller
    /// one holds.
    fn bound(&self, format: &Format, above: &[Bound], corner: &Number, brought: &Number) -> Bound {
        let of_sizes: Number = self.products(|operand| &above[operand].size).iter().sum();
        let size = of_sizes.min(corner.clone());
        let products = self.products(|operand| &above[operand].computed);
        let of_computed: Number = products.iter().sum();
        let before = of_computed.min(&size + brought);
        if self.place.is_none() || self.name == "neg" || self.left_out {
            return Bound {
                size,
                computed: format.float_up(&before),
                error: Number::zero(),
            };
        }
        let mut bound = format.rounded(size, &before);
        if self.name == "minor" {
            if format.parameters == F32 {
                // It is rounded to f64 before it is rounded to f32.
                bound.error += Format::of(F64).half_ulp(&before);
            } else {
                widen(&mut bound, &products, format);
            }
        }
        bound
    }

    /// The products of its terms, of numbers that bound the operands.
    fn products<'n>(&self, number: impl Fn(usize) -> &'n Number) -> Vec<Number> {
        let mut products = Vec::new();
        for term in &self.terms {
            let mut product = number(term.left).clone();
            if let Some(right) = term.right {
                product *= number(right);
            }
            products.push(product);
        }
        products
    }
}

/// The bound of a `minor` in f64, a difference of two products in wider arithmetic as the guide has it.
///
/// It is (p - q) + (e - g), with the rounded products p and q and the remainders e and g. Both remainders are off by half
/// the smallest number, and each of the three sums is rounded. p - q is a float, so the last sum is off by |e - g| at most.
fn widen(bound: &mut Bound, products: &[Number], format: &Format) {
    let twice_tiny = &format.tiny + &format.tiny;
    let mut rounded = Number::zero();
    let mut remainders = twice_tiny.clone();
    for product in products {
        rounded += format.float_up(product);
        remainders += format.half_ulp(product);
    }
    let remainder = format.float_up(&remainders);
    let mut error = format.half_ulp(&rounded);
    error += &remainder;
    error += format.half_ulp(&remainders);
    error += twice_tiny;
    bound.error = round_up(&error, ERROR_DIGITS);
    bound.computed = format.float_up(&(format.float_up(&rounded) + remainder));
}
