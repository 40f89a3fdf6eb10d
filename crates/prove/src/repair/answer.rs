//! The answers of a guarded kernel: its program run on floats.

use super::super::run::{Number, result};
use super::super::{Dyadic, Searched};
use super::{Axes, Guarded, Literal, Pattern, Step};
use crate::arith::recorded::{Comparison, Operation, Place};
use crate::arith::{Float, Real};
use crate::case::Case;
use crate::contract::Extent;

/// An answer of a guarded kernel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Answer<F> {
    /// A hit, with t, u and v where the kernel reports them.
    Hit([Option<F>; 3]),
    /// A miss.
    Miss,
    /// Rounding may decide.
    Ask,
}

/// A run on one case; numbers are computed when they are needed.
struct Run<'a, F> {
    guarded: &'a Guarded,
    inputs: [F; 17],
    /// True for t_min and t_max if they are farther than what stands for them.
    clamped: [bool; 2],
    values: Vec<Option<F>>,
    sizes: Vec<Option<F>>,
}

fn float<F: Float>(x: Dyadic) -> F {
    F::from_f64(x.to_f64())
}

impl Guarded {
    /// The answer to a case in its scalar.
    pub fn answer<F: Searched>(&self, case: &Case<F>) -> Answer<F> {
        let far = float::<F>(self.scale.far);
        let (near, end) = (case.ray.t_min, case.ray.t_max);
        let is_interval = self.info.contract.extent == Extent::Interval;
        if is_interval && !(near <= end && near <= far && end >= -far) {
            return Answer::Ask;
        }
        let clamped = [near < -far, end > far];
        let vectors = case.vectors();
        let mut inputs = [F::zero(); 17];
        for (i, input) in inputs[..15].iter_mut().enumerate() {
            *input = vectors[i / 3][i % 3];
        }
        inputs[15] = if clamped[0] { -far } else { near };
        inputs[16] = if clamped[1] { far } else { end };
        let count = self.operations.len();
        let run = Run {
            guarded: self,
            inputs,
            clamped,
            values: vec![None; count],
            sizes: vec![None; count],
        };
        run.answer(&self.steps)
    }

    /// True if a number is made from t_min, or from t_max.
    pub fn uses_end(&self, place: Place, end: u8) -> bool {
        match self.operations[place as usize] {
            Operation::Input(i) => i == 15 + end,
            operation => operation.operands().iter().any(|operand| self.uses_end(*operand, end)),
        }
    }
}

impl<F: Float + Number> Run<'_, F> {
    fn answer(mut self, steps: &Step) -> Answer<F> {
        let (mut step, mut is_open) = (steps, false);
        loop {
            step = match step {
                Step::Choice(comparison, yes, no) => {
                    if self.compare(comparison) {
                        yes
                    } else {
                        no
                    }
                }
                Step::Sign(literal, yes, no) => {
                    if self.holds(literal) {
                        yes
                    } else if self.holds(&literal.negated()) {
                        no
                    } else {
                        return Answer::Ask;
                    }
                }
                Step::Gate(_, [hits, misses], next) => {
                    if misses.iter().any(|pattern| self.rejects(pattern)) {
                        return Answer::Miss;
                    }
                    is_open |= !hits.iter().any(|pattern| pattern.iter().all(|it| self.holds(it)));
                    next
                }
                Step::Axes(axes, next) => {
                    self.rename(axes);
                    next
                }
                Step::Hit(_) if is_open => return Answer::Ask,
                Step::Hit(values) => {
                    return Answer::Hit(values.map(|place| place.map(|place| self.value(place))));
                }
                Step::Ask => return Answer::Ask,
            }
        }
    }

    fn rename(&mut self, mut axes: &Axes) {
        while let Axes::If(comparison, yes, no) = axes {
            axes = if self.compare(comparison) { yes } else { no };
        }
        let Axes::Are(axes) = axes else { unreachable!("a comparison has two sides") };
        let inputs = self.inputs;
        for i in 0..15 {
            self.inputs[i] = inputs[i / 3 * 3 + usize::from(axes[i % 3])];
        }
        self.values.fill(None);
        self.sizes.fill(None);
    }

    fn compare(&mut self, comparison: &Comparison) -> bool {
        match *comparison {
            Comparison::Less(a, b) => self.value(a) < self.value(b),
            Comparison::AtMost(a, b) => self.value(a) <= self.value(b),
            Comparison::Zero(a) => self.value(a) == F::zero(),
            Comparison::Negative(a) => self.value(a) < F::zero(),
        }
    }

    fn rejects(&mut self, pattern: &Pattern) -> bool {
        let guarded = self.guarded;
        // An end that another number stands for proves no miss.
        let is_far = |end: u8| {
            pattern.iter().flat_map(Literal::places).any(|place| guarded.uses_end(place, end))
        };
        let is_unknown = (0..2).any(|end| self.clamped[usize::from(end)] && is_far(end));
        !is_unknown && pattern.iter().all(|literal| self.holds(literal))
    }

    fn holds(&mut self, literal: &Literal) -> bool {
        let is_negative =
            literal.signs.iter().fold(0, |sum, place| sum ^ i8::from(self.sign(*place) < 0)) == 1;
        literal.places().all(|place| self.sign(place) != 0) && is_negative == literal.is_negative
    }

    /// -1 or 1 if the sign is right, else 0.
    fn sign(&mut self, place: Place) -> i8 {
        let margin = self.guarded.margins[&place];
        let x = self.value(place);
        let least = match margin.factor.is_zero() {
            true => F::zero(),
            false => {
                float::<F>(margin.factor) * self.size(place) + float::<F>(self.guarded.scale.tiny)
            }
        };
        i8::from(x > least && x.is_finite()) - i8::from(x < -least && x.is_finite())
    }

    fn value(&mut self, place: Place) -> F {
        if let Some(known) = self.values[place as usize] {
            return known;
        }
        let (operation, inputs) = (self.guarded.operations[place as usize], self.inputs);
        let found = result(operation, &inputs, |place| self.value(place));
        self.values[place as usize] = Some(found);
        found
    }

    /// The sum of the sizes of the products.
    fn size(&mut self, place: Place) -> F {
        if let Some(known) = self.sizes[place as usize] {
            return known;
        }
        let found = match self.guarded.operations[place as usize] {
            _ if self.guarded.is_leaf(place) => Real::abs(&self.value(place)),
            Operation::Add(a, b) | Operation::Sub(a, b) => self.size(a) + self.size(b),
            Operation::Mul(a, b) => self.factor(a) * self.factor(b),
            Operation::Neg(a) | Operation::Abs(a) => self.size(a),
            _ => unreachable!("it has a margin"),
        };
        self.sizes[place as usize] = Some(found);
        found
    }

    fn factor(&mut self, place: Place) -> F {
        let slack = self.guarded.sizes().needs_slack(place);
        if slack {
            self.size(place) + float::<F>(self.guarded.scale.slack)
        } else {
            self.size(place)
        }
    }
}
