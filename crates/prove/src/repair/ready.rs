//! A guarded kernel made ready to answer many cases: what does not depend on a case is looked up once.

use super::super::{Dyadic, Searched};
use super::{Axes, Chain, Guarded, Literal, Pattern, Step};
use crate::arith::Float;
use crate::arith::recorded::{Comparison, Operation, Place};

/// A step by the number of what follows it.
pub(super) enum ReadyStep<'a> {
    /// [`Step::Choice`].
    Choice(&'a Comparison, [usize; 2]),
    /// [`Step::Sign`], with the opposite condition.
    Sign(&'a Literal, Literal, [usize; 2]),
    /// Gates in a row that one comparison decides.
    Chain(Chain<'a>, usize),
    /// [`Step::Gate`].
    Gate(&'a [Vec<Pattern>; 2], usize),
    /// [`Step::Axes`].
    Axes(&'a Axes, usize),
    /// [`Step::Hit`].
    Hit([Option<Place>; 3]),
    /// [`Step::Ask`].
    Ask,
}

/// How the size of a number, the sum of the sizes of its products, is computed.
#[derive(Clone, Copy)]
pub(super) enum Size {
    /// Its own absolute value.
    OfLeaf,
    /// That of another number.
    Same(Place),
    /// The sum of two.
    Sum(Place, Place),
    /// The product of two, each with slack if true stands beside it.
    Product([(Place, bool); 2]),
    /// None: it has no margin.
    None,
}

/// A guarded kernel in its scalar.
pub struct Ready<'a, F> {
    /// The kernel.
    pub(super) guarded: &'a Guarded,
    /// Its steps; what follows a step stands before it, the first one is the last.
    pub(super) steps: Vec<ReadyStep<'a>>,
    /// How the size of each number is computed.
    pub(super) sizes: Vec<Size>,
    /// The factor of each number's margin; none if its sign is not asked for.
    pub(super) factors: Vec<Option<F>>,
    /// True for t_min and t_max where a number is made from them.
    pub(super) ends: Vec<[bool; 2]>,
    /// [`Scale`](super::Scale) in floats.
    pub(super) slack: F,
    /// The least margin of any sign.
    pub(super) tiny: F,
    /// Ends of the ray beyond it count as it.
    pub(super) far: F,
}

fn float<F: Float>(x: Dyadic) -> F {
    F::from_f64(x.to_f64())
}

impl Guarded {
    /// The kernel made ready to answer cases in its scalar.
    pub fn ready<F: Searched>(&self) -> Ready<'_, F> {
        let places = 0..self.operations.len() as Place;
        let factor = |place| {
            let margin = self.margins.get(&place)?;
            Some(float(margin.factor))
        };
        let mut steps = Vec::new();
        self.lay_out(&self.steps, &mut steps);
        Ready {
            guarded: self,
            steps,
            sizes: places.clone().map(|place| self.size_of(place)).collect(),
            factors: places.clone().map(factor).collect(),
            ends: places
                .map(|place| [0, 1].map(|end| self.uses_end(place, end)))
                .collect(),
            slack: float(self.scale.slack),
            tiny: float(self.scale.tiny),
            far: float(self.scale.far),
        }
    }

    /// Adds a step behind all that may follow it; its number.
    fn lay_out<'a>(&'a self, step: &'a Step, steps: &mut Vec<ReadyStep<'a>>) -> usize {
        let mut number_of = |step| self.lay_out(step, steps);
        let ready = match step {
            Step::Choice(comparison, yes, no) => {
                ReadyStep::Choice(comparison, [number_of(yes), number_of(no)])
            }
            Step::Sign(literal, yes, no) => {
                ReadyStep::Sign(literal, literal.negated(), [number_of(yes), number_of(no)])
            }
            Step::Gate(_, patterns, next) => match self.chain(step) {
                Some(chain) => {
                    let next = number_of(chain.next);
                    ReadyStep::Chain(chain, next)
                }
                None => ReadyStep::Gate(patterns, number_of(next)),
            },
            Step::Axes(axes, next) => ReadyStep::Axes(axes, number_of(next)),
            Step::Hit(values) => ReadyStep::Hit(*values),
            Step::Ask => ReadyStep::Ask,
        };
        steps.push(ready);
        steps.len() - 1
    }

    fn size_of(&self, place: Place) -> Size {
        if self.is_leaf(place) {
            return Size::OfLeaf;
        }
        let margins = self.sizes();
        match self.operations[place as usize] {
            Operation::Add(a, b) | Operation::Sub(a, b) => Size::Sum(a, b),
            Operation::Mul(a, b) => {
                Size::Product([a, b].map(|factor| (factor, margins.needs_slack(factor))))
            }
            Operation::Neg(a) | Operation::Abs(a) => Size::Same(a),
            _ => Size::None,
        }
    }

    /// True if a number is made from t_min, or from t_max.
    pub fn uses_end(&self, place: Place, end: u8) -> bool {
        match self.operations[place as usize] {
            Operation::Input(i) => i == 15 + end,
            operation => {
                let mut operands = operation.operands().into_iter();
                operands.any(|operand| self.uses_end(operand, end))
            }
        }
    }
}
