//! From corner to corner of a formula's box: the exact value of each step there, and the derivative of the result by
//! each.

use super::Dyadic;
use super::formula::{Formula, Step};
use crate::arith::recorded::{Operation, Term};

#[derive(Clone)]
pub struct Walk<'a> {
    formula: &'a Formula,
    /// The terms of each step.
    terms: Vec<Vec<Term<usize>>>,
    /// The variables in each step, as bits.
    supports: Vec<u64>,
    pub values: Vec<Dyadic>,
    pub slopes: Vec<Dyadic>,
    /// The corner of the values, if there is one.
    at: Option<u64>,
}

impl Walk<'_> {
    pub fn new(formula: &Formula) -> Walk<'_> {
        let zeros = vec![Dyadic::ZERO; formula.steps.len()];
        let mut terms = Vec::new();
        for step in &formula.steps {
            terms.push(step.terms().collect());
        }
        Walk {
            formula,
            terms,
            supports: formula.supports(),
            values: zeros.clone(),
            slopes: zeros,
            at: None,
        }
    }

    /// The values at a corner, the unit vector being an axis, always the same in one walk. A step without a changed variable
    /// stays as it was.
    pub fn evaluate(&mut self, corner: u64, axis: usize) {
        let before = self.at.replace(corner);
        for i in 0..self.values.len() {
            let changes = |at: u64| self.supports[i] & (at ^ corner) != 0;
            if before.is_none_or(changes) {
                self.values[i] = self.value(i, corner, axis);
            }
        }
    }

    fn value(&self, i: usize, corner: u64, axis: usize) -> Dyadic {
        let mut total = Dyadic::ZERO;
        match &self.formula.steps[i] {
            Step::Of(Operation::Number(value)) => return Dyadic::new((*value).into(), 0),
            Step::Variables(sum) => {
                for (variable, sign) in sum {
                    let value = self.variable(*variable, corner, axis);
                    total = total + negative_if(*sign < 0, value);
                }
            }
            Step::Of(_) => {
                for (is_minus, a, b) in &self.terms[i] {
                    let factor = b.map_or(Dyadic::ONE, |b| self.values[b]);
                    total = total + negative_if(*is_minus, self.values[*a] * factor);
                }
            }
        }
        total
    }

    fn variable(&self, v: usize, corner: u64, axis: usize) -> Dyadic {
        let Formula {
            unit,
            variables,
            below,
            ..
        } = self.formula;
        if unit.contains(&v) && unit[axis] != v {
            return Dyadic::ZERO;
        }
        let is_lower = corner >> v & 1 == 1;
        match below {
            Some((quotient, below)) if is_lower && *quotient == v => -*below,
            _ => negative_if(is_lower, variables[v]),
        }
    }

    /// The derivatives at the corner of the values.
    pub fn differentiate(&mut self) {
        self.slopes.fill(Dyadic::ZERO);
        *self.slopes.last_mut().expect("a step") = Dyadic::ONE;
        for (i, terms) in self.terms.iter().enumerate().rev() {
            if self.slopes[i].is_zero() {
                continue;
            }
            for (is_minus, a, b) in terms {
                let mut by_first = negative_if(*is_minus, self.slopes[i]);
                if let Some(b) = *b {
                    let by_second = by_first * self.values[*a];
                    by_first = by_first * self.values[b];
                    self.slopes[b] = self.slopes[b] + by_second;
                }
                self.slopes[*a] = self.slopes[*a] + by_first;
            }
        }
    }
}

fn negative_if(negative: bool, x: Dyadic) -> Dyadic {
    if negative { -x } else { x }
}
