//! The largest sum of the effects of a formula's rounding errors, as its corners show it: "First order" and "Corners" in
//! the guide.

use super::super::{
    corners::{Weight, search},
    format::Bound,
    number::{ERROR_DIGITS, Number, SIZE_DIGITS, root_up, round_up, shifted, split},
    reader::{Outcome, Reader, ensure},
};
use super::{
    Formula,
    integers::{Scaled, mantissa},
};
use num_traits::Zero;

/// Work is counted in corners times steps.
const MOST_WORK: u64 = 1 << 31;

const LONG: &str = "found numbers that are too long";

/// The bounds that the corners of a formula show.
pub struct Shown {
    /// The bound of the last step. The error is not rounded up.
    pub bound: Bound,
    /// Its error before it is rounded, if it is rounded once.
    pub before: Number,
}

/// The largest sum of effects, and the corner where it is.
struct First {
    sum: Number,
    corner: usize,
}

impl Formula<'_> {
    /// The result of the corners. Reads the corner and both parts of the error's bound.
    ///
    /// The error is at most first + rest: "Formulas without divisions" in the guide. First is a maximum over all
    /// corners, of a sum that is convex in each variable, so it holds in the whole box.
    pub fn maximum(&self, reader: &mut Reader) -> Outcome<Shown> {
        let mut scaled = self.in_integers();
        self.count_work(&scaled, reader)?;
        let sizes = self.sizes(&scaled)?;
        let mut bounds = self.bounds(&sizes);
        for bound in &bounds {
            self.program.format.finite(&bound.computed)?;
        }
        let first = self.first(&mut scaled, &bounds)?;
        self.read_corner(first.corner, reader)?;
        reader.demand("first", &first.sum)?;
        let rest = round_up(&self.rest(&bounds), ERROR_DIGITS);
        reader.demand("rest", &rest)?;
        let error = first.sum + rest;
        let mut bound = bounds.pop().expect("a step");
        let before = self.before_rounding(&error, &bound);
        bound.error = error;
        Ok(Shown { bound, before })
    }

    fn count_work(&self, scaled: &Scaled, reader: &mut Reader) -> Outcome<()> {
        let tried = scaled.problem.tried.count_ones();
        let steps = self.steps.len() as u64;
        reader.work += steps << tried;
        ensure(
            reader.work <= MOST_WORK,
            "found too many corners of too many steps in this file",
        )
    }

    /// The largest exact size of each step at a corner. A step that is linear in the unit vector is at most the root of
    /// the sum of its squares at the axes, by Cauchy and Schwarz.
    fn sizes(&self, scaled: &Scaled) -> Outcome<Vec<Number>> {
        let found = search(&scaled.problem).ok_or(LONG)?;
        let mut sizes = Vec::new();
        for (k, integer) in found.sizes.into_iter().enumerate() {
            let integer = Number::from(integer);
            let scale = scaled.scales[k];
            let size = if self.is_linear(k) {
                let squares = shifted(&integer, 2 * scale);
                root_up(&squares, SIZE_DIGITS)
            } else {
                shifted(&integer, scale)
            };
            sizes.push(size);
        }
        Ok(sizes)
    }

    /// The first order. With parts it is that of "Formulas that are linear in a unit vector": the largest sum of the
    /// effects that are free of it, the root of all others, and the error of the vector itself.
    fn first(&self, scaled: &mut Scaled, bounds: &[Bound]) -> Outcome<First> {
        let finest = self.add_weights(scaled, bounds);
        let found = search(&scaled.problem).ok_or(LONG)?;
        let last = bounds.len() - 1;
        let scale = scaled.scales[last] + finest;
        let mut sum = shifted(&Number::from(found.sum), scale);
        if let Some(part) = self.unit.first() {
            let squares = shifted(&Number::from(found.squares), 2 * scale);
            let error_of_vector = &self.variables[*part].bound.error;
            sum += root_up(&squares, ERROR_DIGITS);
            sum += error_of_vector * &bounds[last].size;
        }
        Ok(First {
            sum,
            corner: found.corner,
        })
    }

    /// Gives the search the weights of the steps' errors, as integers times 2 to the power that is returned.
    fn add_weights(&self, scaled: &mut Scaled, bounds: &[Bound]) -> i64 {
        let mut sizes = Vec::new();
        let mut exponents = Vec::new();
        for (k, bound) in bounds.iter().enumerate() {
            let size = if self.steps[k].relative {
                self.program.format.unit.clone()
            } else if self.is_part(k) {
                // The vector's own error takes its place.
                Number::zero()
            } else {
                shifted(&bound.error, -scaled.scales[k])
            };
            if !size.is_zero() {
                exponents.push(split(&size).exponent);
            }
            sizes.push(size);
        }
        let finest = exponents.into_iter().min().unwrap_or(0);
        for (step, size) in self.steps.iter().zip(&sizes) {
            scaled.problem.weights.push(Weight {
                size: mantissa(size, finest),
                is_relative: step.relative,
            });
        }
        finest
    }

    /// True if a step is a coordinate of the unit vector itself.
    fn is_part(&self, step: usize) -> bool {
        self.steps[step].terms.is_empty() && self.is_linear(step)
    }

    /// Reads the corner, with a sign for each variable.
    fn read_corner(&self, corner: usize, reader: &mut Reader) -> Outcome<()> {
        let mut signs = String::new();
        for variable in 0..self.variables.len() {
            let is_lower = corner >> variable & 1 == 1;
            signs.push(if is_lower { '-' } else { '+' });
        }
        reader.read(&format!("corner {signs}"), |words| {
            (words.concat() == signs).then_some(())
        })
    }

    /// The error of the last step before it is rounded, if it rounds once and its share of the error is known; else
    /// its error.
    fn before_rounding(&self, error: &Number, last: &Bound) -> Number {
        match self.steps.last() {
            Some(step) if step.rounds && !step.relative => error - &last.error,
            _ => error.clone(),
        }
    }
}
