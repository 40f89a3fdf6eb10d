//! The bounds of a formula's steps, from those of their operands: "Sizes and h" and "Higher order" in the guide.

use super::super::{
    format::{Bound, F32, F64, Format},
    number::{ERROR_DIGITS, Number, round_up},
};
use super::{Formula, Step};
use num_traits::Zero;

/// A step's size and a bound of its error, in two summands: s, f and r in "Higher order".
#[derive(Default)]
struct Orders {
    size: Number,
    /// The terms of first order.
    first: Number,
    /// All others, with every number at its largest size and nothing cancelled.
    rest: Number,
}

impl Formula<'_> {
    /// The bounds of the steps, with sizes from the corners: "Sizes and h".
    pub fn bounds(&self, sizes: &[Number]) -> Vec<Bound> {
        let format = &self.program.format;
        let mut bounds = Vec::new();
        let mut all = Vec::new();
        for (step, corner) in self.steps.iter().zip(sizes) {
            let mut orders = step.brought(&all);
            let bound = match &step.given {
                Some(given) => given.clone(),
                None => step.bound(format, &bounds, corner, &orders),
            };
            orders.size = bound.size.clone();
            orders.first += &bound.error;
            all.push(orders);
            bounds.push(bound);
        }
        bounds
    }

    /// The higher orders of the last step: "Higher order".
    pub fn rest(&self, bounds: &[Bound]) -> Number {
        let mut all = Vec::new();
        for (step, bound) in self.steps.iter().zip(bounds) {
            let mut orders = step.brought(&all);
            orders.size = bound.size.clone();
            if step.relative {
                orders.add_relative(&self.program.format);
            } else {
                orders.first += &bound.error;
            }
            all.push(orders);
        }
        let last = all.pop().unwrap_or_default();
        last.rest
    }
}

impl Orders {
    fn error(&self) -> Number {
        &self.first + &self.rest
    }

    /// Adds the error of a rounding as a share: fl(z) is off by at most u|z| and a tiny number, and z from the exact value
    /// by at most the error so far.
    fn add_relative(&mut self, format: &Format) {
        let error = self.error();
        self.first += &format.unit * &self.size;
        self.rest += &format.unit * error;
        self.rest += &format.tiny;
    }

    /// Adds the error of a product, (|a| + f_a + r_a)(|b| + f_b + r_b) less the exact product. The terms with one f and no r
    /// are the first order.
    fn add_product(&mut self, a: &Orders, b: &Orders) {
        let largest_b = &b.size + b.error();
        self.first += &a.size * &b.first;
        self.first += &a.first * &b.size;
        self.rest += &a.first * &b.first;
        self.rest += &a.rest * largest_b;
        self.rest += (&a.size + &a.first) * &b.rest;
    }
}

impl Step {
    /// The error that the operands bring.
    fn brought(&self, above: &[Orders]) -> Orders {
        let mut brought = Orders::default();
        for term in &self.terms {
            let left = &above[term.left];
            if let Some(right) = term.right {
                brought.add_product(left, &above[right]);
            } else {
                brought.first += &left.first;
                brought.rest += &left.rest;
            }
        }
        brought
    }

    /// The bound that follows from the operands' bounds, the size at the corners, and the error that operands bring.
    ///
    /// The exact size has two bounds, one of each kind, and so has the computed number before it is rounded. The smaller
    /// one holds.
    fn bound(&self, format: &Format, above: &[Bound], corner: &Number, brought: &Orders) -> Bound {
        let exact = self.products(|operand| &above[operand].size);
        let computed = self.products(|operand| &above[operand].computed);
        let by_operands: Number = exact.iter().sum();
        let size = by_operands.min(corner.clone());
        let by_operands: Number = computed.iter().sum();
        let before = by_operands.min(&size + brought.error());
        let mut bound = format.rounded(size, &before);
        if self.is_exact() {
            bound.error.set_zero();
        } else if self.name != "minor" {
            return bound;
        } else if format.parameters == F32 {
            // It is rounded to f64 before it is rounded to f32.
            bound.error += Format::of(F64).half_ulp(&before);
        } else {
            widen(&mut bound, &computed, format);
        }
        bound
    }

    /// True if nothing is rounded, or the rounding is left out.
    fn is_exact(&self) -> bool {
        self.place.is_none() || self.name == "neg" || self.left_out
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

/// The bound of a `minor` in f64: "A difference of two products in wider arithmetic" in the guide.
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
    let computed = format.float_up(&rounded) + remainder;
    bound.error = round_up(&error, ERROR_DIGITS);
    bound.computed = format.float_up(&computed);
}
