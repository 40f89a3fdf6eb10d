//! A formula in integers, for the search through the corners ("Corners" in the guide): every value is an integer times a
//! power of two that does not depend on the corner.

use super::super::{
    corners::{Multiple, Problem, Product, Row},
    mirrors::signs_to_try,
    number::{Number, shifted, split},
    operations::Term,
    variables::Variable,
};
use super::{Formula, Step};
use num_bigint::BigInt;

/// A formula in integers.
pub struct Scaled {
    pub problem: Problem<BigInt>,
    /// Each step is the value of its row times 2 to this power.
    pub scales: Vec<i64>,
}

/// The powers of two by which variables and steps are scaled.
#[derive(Default)]
struct Scales {
    variables: Vec<i64>,
    steps: Vec<i64>,
}

impl Scales {
    fn of_term(&self, term: &Term) -> i64 {
        term.factors().map(|step| self.steps[step]).sum()
    }

    /// The least power in a step's summands: each summand is a multiple of it.
    fn least(&self, step: &Step) -> i64 {
        let mut all = Vec::new();
        for signed in &step.variables {
            all.push(self.variables[signed.variable]);
        }
        for term in &step.terms {
            all.push(self.of_term(term));
        }
        all.into_iter().min().unwrap_or(0)
    }
}

impl Formula<'_> {
    /// The search for the sizes at the corners.
    pub fn in_integers(&self) -> Scaled {
        let mut scales = Scales::default();
        let mut ends = Vec::new();
        let mut fixed = 0;
        for (v, variable) in self.variables.iter().enumerate() {
            let [upper, lower] = variable.ends();
            let of_upper = split(&upper).exponent;
            let of_lower = split(&lower).exponent;
            let exponent = of_upper.min(of_lower);
            ends.push([mantissa(&upper, exponent), mantissa(&lower, exponent)]);
            scales.variables.push(exponent);
            if variable.down_to.is_some() {
                fixed |= 1 << v;
            }
        }
        let mut rows = Vec::new();
        for step in &self.steps {
            let scale = scales.least(step);
            rows.push(row(step, scale, &scales));
            scales.steps.push(scale);
        }
        let tried = signs_to_try(&rows, &self.unit, fixed);
        let problem = Problem {
            rows,
            weights: vec![],
            ends,
            unit: self.unit.clone(),
            tried,
        };
        Scaled {
            problem,
            scales: scales.steps,
        }
    }
}

impl Variable {
    /// The ends of its box.
    fn ends(&self) -> [Number; 2] {
        let size = &self.bound.size;
        let below = self.down_to.as_ref().unwrap_or(size);
        [size.clone(), -below.clone()]
    }
}

/// A step in integers, each the number over 2^scale.
fn row(step: &Step, scale: i64, scales: &Scales) -> Row<BigInt> {
    let mut variables = Vec::new();
    for signed in &step.variables {
        let exponent = scales.variables[signed.variable] - scale;
        variables.push(Multiple {
            factor: signed_power(signed.is_negative, exponent),
            variable: signed.variable,
        });
    }
    let mut products = Vec::new();
    for term in &step.terms {
        let exponent = scales.of_term(term) - scale;
        products.push(Product {
            factor: signed_power(term.is_negative, exponent),
            left: term.left,
            right: term.right,
        });
    }
    Row {
        constant: step.constant.into(),
        variables,
        products,
        support: step.support,
    }
}

/// A power of two, or its negative.
fn signed_power(is_negative: bool, exponent: i64) -> BigInt {
    let sign = if is_negative { -1 } else { 1 };
    BigInt::from(sign) << exponent
}

/// A number over 2^exponent, where that is an integer.
pub fn mantissa(x: &Number, exponent: i64) -> BigInt {
    shifted(x, -exponent).to_integer()
}
