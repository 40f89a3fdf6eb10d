//! All corners of a box, in integers: the largest size of each step, and the largest sum of the effects of all errors.
//!
//! This is "Corners" in the guide's "Formulas without divisions". Where some variables are the coordinates of a unit
//! vector, every axis is tried in place of their signs: "Formulas that are linear in a unit vector".

mod visits;

use num_bigint::BigInt;
use num_traits::{NumAssignRef, One, Signed};
use visits::Search;

/// Longer numbers are refused.
const MOST_BITS: u64 = 1 << 12;

/// A kind of integers to search with.
trait Integer: Signed + NumAssignRef + Clone + PartialOrd + TryFrom<BigInt> + Into<BigInt> {}

impl Integer for i64 {}
impl Integer for i128 {}
impl Integer for BigInt {}

/// One step: the sum of a constant, of multiples of variables, and of products of earlier steps.
#[derive(Clone)]
pub struct Row<T> {
    pub constant: T,
    pub variables: Vec<Multiple<T>>,
    pub products: Vec<Product<T>>,
    /// The variables on which the step depends, as bits.
    pub support: usize,
}

/// A factor times a variable.
#[derive(Clone)]
pub struct Multiple<T> {
    pub factor: T,
    pub variable: usize,
}

/// A factor times one earlier step, or times two.
#[derive(Clone)]
pub struct Product<T> {
    pub factor: T,
    pub left: usize,
    pub right: Option<usize>,
}

/// A bound of a step's error.
#[derive(Clone)]
pub struct Weight<T> {
    pub size: T,
    /// True if the error is at most this share of the step's exact value.
    pub is_relative: bool,
}

/// Everything that a search needs to know.
pub struct Problem<T> {
    pub rows: Vec<Row<T>>,
    /// A weight for each row, or none at all: then only sizes are searched for.
    pub weights: Vec<Weight<T>>,
    /// The upper and the lower end of each variable.
    pub ends: Vec<[T; 2]>,
    /// The variables that are coordinates of a unit vector in which the last step is linear.
    pub unit: Vec<usize>,
    /// The variables whose lower ends are tried too, as bits.
    pub tried: usize,
}

/// The largest sum of effects, and the first corner that has it.
pub struct Found {
    /// The sum of the effects that do not depend on a unit vector; all of them if there is none.
    pub sum: BigInt,
    /// The sum of the squares, axis by axis, of the sums of all others.
    pub squares: BigInt,
    /// The bit of a variable is set where it is at its lower end.
    pub corner: usize,
    /// The size of each step; of steps that depend on the unit vector, the sum of the squares.
    pub sizes: Vec<BigInt>,
}

/// A set of variables as bits.
pub fn set_of(variables: &[usize]) -> usize {
    variables
        .iter()
        .fold(0, |set, variable| set | 1 << variable)
}

/// The result of every corner of the box that differs in the tried variables; none if numbers are too long.
///
/// All integers that a search meets are at most as long as its longest sum, so it may compute in machine integers that
/// have room for that.
pub fn search(problem: &Problem<BigInt>) -> Option<Found> {
    let longest = search_in::<BigInt>(&problem.without_signs())?.sum;
    match longest.bits() {
        0..=62 => search_in::<i64>(problem),
        63..=126 => search_in::<i128>(problem),
        127..=MOST_BITS => search_in::<BigInt>(problem),
        _ => None,
    }
}

fn search_in<T: Integer>(problem: &Problem<BigInt>) -> Option<Found> {
    let converted = problem.converted::<T>()?;
    let mut search = Search::new(&converted);
    let tried = problem.tried;
    let mut corner = 0;
    loop {
        search.visit(corner);
        // The next larger set of tried variables; the empty one follows the last.
        corner = corner.wrapping_sub(tried) & tried;
        if corner == 0 {
            return Some(search.found());
        }
    }
}

impl Problem<BigInt> {
    /// This problem with every sign plus and ones for zeros. Its one corner has a longer sum than any number that the
    /// search meets, because the last step depends on every step.
    fn without_signs(&self) -> Problem<BigInt> {
        let mut rows = Vec::new();
        let mut weights = Vec::new();
        for (k, row) in self.rows.iter().enumerate() {
            rows.push(row.without_signs());
            let size = match self.weights.get(k) {
                Some(weight) => not_zero(&weight.size),
                None => BigInt::one(),
            };
            weights.push(Weight {
                size,
                is_relative: true,
            });
        }
        let mut ends = Vec::new();
        for [upper, lower] in &self.ends {
            let largest = not_zero(upper).max(not_zero(lower));
            ends.push([largest.clone(), largest]);
        }
        Problem {
            rows,
            weights,
            ends,
            unit: vec![],
            tried: 0,
        }
    }

    /// This problem in another kind of integers; none if one of its numbers does not fit.
    fn converted<T: Integer>(&self) -> Option<Problem<T>> {
        let mut rows = Vec::new();
        for row in &self.rows {
            rows.push(row.mapped(converted)?);
        }
        let mut weights = Vec::new();
        for weight in &self.weights {
            weights.push(Weight {
                size: converted(&weight.size)?,
                is_relative: weight.is_relative,
            });
        }
        let mut ends = Vec::new();
        for [upper, lower] in &self.ends {
            ends.push([converted(upper)?, converted(lower)?]);
        }
        Some(Problem {
            rows,
            weights,
            ends,
            unit: self.unit.clone(),
            tried: self.tried,
        })
    }
}

impl Row<BigInt> {
    fn without_signs(&self) -> Row<BigInt> {
        let mut row = self.mapped(|factor| Some(factor.abs())).expect("a size");
        if self.support == 0 {
            row.constant = not_zero(&row.constant);
        }
        row
    }

    /// The row with other numbers in place of its own; none if one has none.
    fn mapped<T>(&self, number: impl Fn(&BigInt) -> Option<T>) -> Option<Row<T>> {
        let mut variables = Vec::new();
        for multiple in &self.variables {
            variables.push(Multiple {
                factor: number(&multiple.factor)?,
                variable: multiple.variable,
            });
        }
        let mut products = Vec::new();
        for product in &self.products {
            products.push(Product {
                factor: number(&product.factor)?,
                left: product.left,
                right: product.right,
            });
        }
        Some(Row {
            constant: number(&self.constant)?,
            variables,
            products,
            support: self.support,
        })
    }
}

fn not_zero(x: &BigInt) -> BigInt {
    x.abs().max(BigInt::one())
}

fn converted<T: Integer>(x: &BigInt) -> Option<T> {
    T::try_from(x.clone()).ok()
}

#[cfg(test)]
mod tests;
