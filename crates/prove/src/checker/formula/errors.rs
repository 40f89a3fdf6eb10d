//! The largest sum of the effects of a formula's rounding errors, as its corners show it.

use super::super::corners::{Weight, search};
use super::super::format::{Bound, Format};
use super::super::number::{ERROR_DIGITS, Number, SIZE_DIGITS, root_up, round_up, shifted, split};
use super::super::reader::{Outcome, Reader, ensure};
use super::Formula;
use super::integers::{Scaled, integer};
use num_traits::Zero;

/// Work is counted in corners times steps.
const MOST_WORK: u64 = 1 << 31;

const LONG: &str = "found numbers that are too long";

/// The sizes and errors that the corners of a formula show.
pub struct Shown {
    /// The size of the last step.
    pub size: Number,
    pub computed: Number,
    /// The error of the last step, not rounded up.
    pub error: Number,
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
    pub fn maximum(&self, format: &Format, reader: &mut Reader) -> Outcome<Shown> {
        let mut scaled = self.in_integers();
        let tried = scaled.problem.tried.count_ones();
        reader.work += (self.steps.len() as u64) << tried;
        ensure(
            reader.work <= MOST_WORK,
            "found too many corners of too many steps in this file",
        )?;
        let sizes = self.sizes(&scaled)?;
        let mut run = self.run(format, &sizes, None);
        for bound in &run.bounds {
            format.finite(&bound.computed)?;
        }
        let first = self.first(&mut scaled, format, &run.bounds)?;
        self.read_corner(first.corner, reader)?;
        reader.demand("first", &first.sum)?;
        if self.steps.iter().any(|step| step.relative) {
            run = self.run(format, &sizes, Some(&run.bounds));
        }
        let rest = round_up(&run.rest, ERROR_DIGITS);
        reader.demand("rest", &rest)?;
        let last = run.bounds.pop().expect("a step");
        let error = first.sum + rest;
        Ok(Shown {
            before: self.before_rounding(&error, &last),
            size: last.size,
            computed: last.computed,
            error,
        })
    }

    /// The largest exact size of each step at a corner. A step that is linear in the unit vector is at most the root of
    /// the sum of its squares at the axes, by Cauchy and Schwarz.
    fn sizes(&self, scaled: &Scaled) -> Outcome<Vec<Number>> {
        let found = search(&scaled.problem).ok_or(LONG)?;
        let mut sizes = Vec::new();
        for (k, size) in found.sizes.into_iter().enumerate() {
            let size = Number::from(size);
            let scale = scaled.scales[k];
            sizes.push(if self.is_linear(k) {
                root_up(&shifted(&size, 2 * scale), SIZE_DIGITS)
            } else {
                shifted(&size, scale)
            });
        }
        Ok(sizes)
    }

    /// The first order. With parts it is that of "Formulas that are linear in a unit vector": the largest sum of the
    /// effects that are free of it, the root of all others, and the error of the vector itself.
    fn first(&self, scaled: &mut Scaled, format: &Format, bounds: &[Bound]) -> Outcome<First> {
        let finest = self.add_weights(scaled, format, bounds);
        let found = search(&scaled.problem).ok_or(LONG)?;
        let last = bounds.len() - 1;
        let scale = scaled.scales[last] + finest;
        let mut sum = shifted(&Number::from(found.sum), scale);
        if let Some(part) = self.unit.first() {
            let squares = shifted(&Number::from(found.squares), 2 * scale);
            sum += root_up(&squares, ERROR_DIGITS);
            sum += &self.variables[*part].bound.error * &bounds[last].size;
        }
        Ok(First {
            sum,
            corner: found.corner,
        })
    }

    /// Gives the search the weights of the steps' errors, as integers times 2 to the power that is returned.
    fn add_weights(&self, scaled: &mut Scaled, format: &Format, bounds: &[Bound]) -> i64 {
        let mut sizes = Vec::new();
        let mut finest = None;
        for (k, step) in self.steps.iter().enumerate() {
            let is_part = step.terms.is_empty() && self.is_linear(k);
            let size = if step.relative {
                format.unit.clone()
            } else if is_part {
                // The vector's own error takes its place.
                Number::zero()
            } else {
                shifted(&bounds[k].error, -scaled.scales[k])
            };
            if !size.is_zero() {
                let exponent = split(&size).exponent;
                finest = Some(finest.unwrap_or(exponent).min(exponent));
            }
            sizes.push(size);
        }
        let finest = finest.unwrap_or(0);
        let weights = &mut scaled.problem.weights;
        for (step, size) in self.steps.iter().zip(&sizes) {
            weights.push(Weight {
                size: integer(size, finest),
                is_relative: step.relative,
            });
        }
        finest
    }

    /// Reads the corner, with a sign for each variable.
    fn read_corner(&self, corner: usize, reader: &mut Reader) -> Outcome<()> {
        let mut signs = String::new();
        for v in 0..self.variables.len() {
            signs.push(if corner >> v & 1 == 1 { '-' } else { '+' });
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
