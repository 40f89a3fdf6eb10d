//! The visits of corners: the values of all steps there, the derivatives by each step, and the sums of effects.

use super::{Found, Integer, Problem, Row, set_of};
use num_bigint::BigInt;

/// A search on its way from corner to corner.
pub struct Search<'p, T> {
    problem: &'p Problem<T>,
    /// The coordinates of the unit vector, as bits; 0 if there is none.
    of_unit: usize,
    /// The corner of the latest visit; none before the first.
    visited: Option<usize>,
    /// The values of the steps there, at the axis tried last.
    values: Vec<T>,
    /// The derivatives of the last step by each step, there.
    slopes: Vec<T>,
    /// The largest size so far of each step that does not depend on the unit vector.
    sizes: Vec<T>,
    /// For each step that depends on it, the sum of the squares over the axes at this corner.
    lengths: Vec<BigInt>,
    /// The largest of these sums so far.
    longest: Vec<BigInt>,
    /// The largest sum so far of the effects that do not depend on the unit vector.
    best: T,
    /// The largest sum so far of the squares of the others, axis by axis.
    squares: BigInt,
    /// The first corner with these squares; without a unit vector, with the best sum.
    corner: usize,
}

/// Sums of effects at one corner and axis.
struct Effects<T> {
    /// The effects that do not depend on the unit vector; all effects if there is none.
    alone: T,
    /// All others, which are linear in the unit vector.
    of_axis: T,
}

impl<'p, T: Integer> Search<'p, T> {
    pub fn new(problem: &'p Problem<T>) -> Search<'p, T> {
        let steps = problem.rows.len();
        Search {
            problem,
            of_unit: set_of(&problem.unit),
            visited: None,
            values: vec![T::zero(); steps],
            slopes: vec![T::zero(); steps],
            sizes: vec![T::zero(); steps],
            lengths: vec![BigInt::ZERO; steps],
            longest: vec![BigInt::ZERO; steps],
            best: T::zero(),
            squares: BigInt::ZERO,
            corner: 0,
        }
    }

    /// Finds the sizes and the effects at a corner. Of corners with the largest effects, the first is kept.
    pub fn visit(&mut self, corner: usize) {
        let has_unit = self.of_unit != 0;
        let axes = self.problem.unit.len().max(1);
        let mut alone = T::zero();
        let mut squares = BigInt::ZERO;
        if has_unit {
            self.lengths.fill(BigInt::ZERO);
        }
        for axis in 0..axes {
            self.evaluate(corner, axis);
            if self.problem.weights.is_empty() {
                continue;
            }
            self.differentiate();
            let effects = self.effects();
            if has_unit {
                squares += square(&effects.of_axis);
            }
            // The same at every axis.
            alone = effects.alone;
        }
        if has_unit {
            self.keep_longest();
        }
        if self.best < alone {
            self.best = alone;
            if !has_unit {
                self.corner = corner;
            }
        }
        if self.squares < squares {
            self.squares = squares;
            self.corner = corner;
        }
    }

    /// True if a step depends on the unit vector, in which it is linear then.
    fn is_linear(&self, row: &Row<T>) -> bool {
        row.support & self.of_unit != 0
    }

    fn keep_longest(&mut self) {
        for (longest, length) in self.longest.iter_mut().zip(&self.lengths) {
            if *longest < *length {
                *longest = length.clone();
            }
        }
    }

    /// Computes the steps at a corner, where the unit vector is the axis. A step stays as it was if it depends on
    /// nothing that changed.
    fn evaluate(&mut self, corner: usize, axis: usize) {
        for (k, row) in self.problem.rows.iter().enumerate() {
            if let Some(visited) = self.visited {
                let changed = (corner ^ visited) | self.of_unit;
                if row.support & changed == 0 {
                    continue;
                }
            }
            let value = self.value(row, corner, axis);
            if self.is_linear(row) {
                self.lengths[k] += square(&value);
            } else if self.sizes[k] < value.abs() {
                self.sizes[k] = value.abs();
            }
            self.values[k] = value;
        }
        self.visited = Some(corner);
    }

    /// The value of a step, from those of earlier steps. Of the unit vector's coordinates that of the axis is at its upper
    /// end, as no corner has its bit, and the others are 0.
    fn value(&self, row: &Row<T>, corner: usize, axis: usize) -> T {
        let mut sum = row.constant.clone();
        for multiple in &row.variables {
            let variable = multiple.variable;
            let is_of_unit = self.of_unit >> variable & 1 == 1;
            if is_of_unit && self.problem.unit[axis] != variable {
                continue;
            }
            let end = corner >> variable & 1;
            let mut summand = multiple.factor.clone();
            summand *= &self.problem.ends[variable][end];
            sum += summand;
        }
        for product in &row.products {
            let mut summand = product.factor.clone();
            summand *= &self.values[product.left];
            if let Some(right) = product.right {
                summand *= &self.values[right];
            }
            sum += summand;
        }
        sum
    }

    /// Computes the slopes from the last step back to the first, by the chain rule.
    fn differentiate(&mut self) {
        let last = self.slopes.len() - 1;
        self.slopes.fill(T::zero());
        self.slopes[last] = T::one();
        for (k, row) in self.problem.rows.iter().enumerate().rev() {
            for product in &row.products {
                let mut by_left = self.slopes[k].clone();
                by_left *= &product.factor;
                if let Some(right) = product.right {
                    let mut by_right = by_left.clone();
                    by_right *= &self.values[product.left];
                    by_left *= &self.values[right];
                    self.slopes[right] += by_right;
                }
                self.slopes[product.left] += by_left;
            }
        }
    }

    /// Adds up |slope|·weight, or |slope·value|·weight for relative steps.
    ///
    /// The slope by a step that is linear in the unit vector is free of it, and so is the effect of a fixed error. Every
    /// other effect is linear in the unit vector, and counts for the axis.
    fn effects(&self) -> Effects<T> {
        let mut alone = T::zero();
        let mut of_axis = T::zero();
        for (k, weight) in self.problem.weights.iter().enumerate() {
            let mut effect = self.slopes[k].abs();
            effect *= &weight.size;
            if weight.is_relative {
                effect *= &self.values[k].abs();
            }
            let is_linear = self.is_linear(&self.problem.rows[k]);
            if self.of_unit != 0 && (weight.is_relative || !is_linear) {
                of_axis += effect;
            } else {
                alone += effect;
            }
        }
        Effects { alone, of_axis }
    }

    pub fn found(self) -> Found {
        let mut sizes = Vec::new();
        for (size, longest) in self.sizes.into_iter().zip(self.longest) {
            let size: BigInt = size.into();
            // One of the two is 0.
            sizes.push(size.max(longest));
        }
        Found {
            sum: self.best.into(),
            squares: self.squares,
            corner: self.corner,
            sizes,
        }
    }
}

fn square<T: Integer>(x: &T) -> BigInt {
    let x: BigInt = x.clone().into();
    x.pow(2)
}
