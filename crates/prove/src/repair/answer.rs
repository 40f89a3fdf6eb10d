//! The answers of a guarded kernel: its program run on floats.

use super::super::{Searched, run::run};
use super::ready::{Ready, ReadyStep, Size};
use super::{Axes, Chain, Literal, Pattern};
use crate::arith::recorded::{Comparison, Place};
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

/// A run on one case.
struct Run<'a, F> {
    ready: &'a Ready<'a, F>,
    inputs: [F; 17],
    /// True for t_min and t_max if they are farther than what stands for them.
    clamped: [bool; 2],
    values: Vec<F>,
    /// The sum of the sizes of each number's products.
    sizes: Vec<F>,
}

/// A scalar in which guarded kernels answer. Both have their own code here, because this crate is optimised and those that ask are
/// not.
pub trait Answered: Searched {
    /// The answer to a case.
    fn answer(ready: &Ready<Self>, case: &Case<Self>) -> Answer<Self>;
}

impl Answered for f32 {
    fn answer(ready: &Ready<f32>, case: &Case<f32>) -> Answer<f32> {
        ready.decide(case)
    }
}

impl Answered for f64 {
    fn answer(ready: &Ready<f64>, case: &Case<f64>) -> Answer<f64> {
        ready.decide(case)
    }
}

impl<F: Searched> Ready<'_, F> {
    fn decide(&self, case: &Case<F>) -> Answer<F> {
        let far = self.far;
        let near = case.ray.t_min;
        let end = case.ray.t_max;
        let is_interval = self.guarded.info.contract.extent == Extent::Interval;
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
        let mut run = Run {
            ready: self,
            inputs,
            clamped,
            values: Vec::new(),
            sizes: Vec::new(),
        };
        run.compute();
        run.answer()
    }
}

/// The decision of a chain of gates.
enum Decision {
    /// All gates accept.
    Accept,
    /// One refuses.
    Miss,
    /// A number is not finite.
    Ask,
    /// Rounding leaves it open: a gate behind may still refuse.
    Open,
}

impl<F: Float> Run<'_, F> {
    fn answer(mut self) -> Answer<F> {
        let ready = self.ready;
        let mut number = ready.steps.len() - 1;
        let mut is_open = false;
        loop {
            number = match &ready.steps[number] {
                ReadyStep::Choice(comparison, [yes, no]) => {
                    if self.compare(comparison) {
                        *yes
                    } else {
                        *no
                    }
                }
                ReadyStep::Sign(literal, opposite, [yes, no]) => {
                    if self.holds(literal) {
                        *yes
                    } else if self.holds(opposite) {
                        *no
                    } else {
                        return Answer::Ask;
                    }
                }
                ReadyStep::Chain(chain, next) => {
                    match self.decision(chain) {
                        Decision::Accept => {}
                        Decision::Open => is_open = true,
                        Decision::Miss => return Answer::Miss,
                        Decision::Ask => return Answer::Ask,
                    }
                    *next
                }
                ReadyStep::Gate([hits, misses], next) => {
                    if misses.iter().any(|pattern| self.rejects(pattern)) {
                        return Answer::Miss;
                    }
                    let accepts = |pattern: &Pattern| pattern.iter().all(|it| self.holds(it));
                    is_open |= !hits.iter().any(accepts);
                    *next
                }
                ReadyStep::Axes(axes, next) => {
                    self.rename(axes);
                    *next
                }
                ReadyStep::Hit(_) if is_open => return Answer::Ask,
                ReadyStep::Hit(values) => {
                    return Answer::Hit(values.map(|place| place.map(|place| self.value(place))));
                }
                ReadyStep::Ask => return Answer::Ask,
            }
        }
    }

    fn decision(&self, chain: &Chain) -> Decision {
        let sum = |sum: F, place: &Place| sum + self.value(*place);
        let total = chain.widest.iter().fold(-F::zero(), sum);
        if !total.is_finite() {
            return Decision::Ask;
        }
        let signs = chain.sides.iter().map(|place| self.sign(*place));
        let side = F::from_f64(signs.product::<i8>().into());
        let turned = |(is_negative, place): &(bool, Place)| {
            let value = self.value(*place);
            side * if *is_negative { -value } else { value }
        };
        let numbers = chain.numbers.iter().map(turned);
        let least = numbers.reduce(|x, y| if x < y { x } else { y });
        let sizes = chain.widest.iter().map(|place| self.sizes[*place as usize]);
        let size = sizes.reduce(|x, y| if x > y { x } else { y });
        let (Some(least), Some(size)) = (least, size) else {
            return Decision::Open;
        };
        let margin = F::from_f64(chain.factor) * size + self.ready.tiny;
        if least > margin {
            Decision::Accept
        } else if least < -margin && !self.is_clamped(chain.places().into_iter()) {
            Decision::Miss
        } else {
            Decision::Open
        }
    }

    fn rename(&mut self, mut axes: &Axes) {
        while let Axes::If(comparison, yes, no) = axes {
            axes = if self.compare(comparison) { yes } else { no };
        }
        let Axes::Are(axes) = axes else {
            unreachable!("a comparison has two sides")
        };
        let inputs = self.inputs;
        for i in 0..15 {
            self.inputs[i] = inputs[i / 3 * 3 + usize::from(axes[i % 3])];
        }
        self.compute();
    }

    fn compare(&self, comparison: &Comparison) -> bool {
        match *comparison {
            Comparison::Less(a, b) => self.value(a) < self.value(b),
            Comparison::AtMost(a, b) => self.value(a) <= self.value(b),
            Comparison::Zero(a) => self.value(a) == F::zero(),
            Comparison::Negative(a) => self.value(a) < F::zero(),
        }
    }

    fn rejects(&self, pattern: &Pattern) -> bool {
        if !pattern.iter().all(|literal| self.holds(literal)) {
            return false;
        }
        !self.is_clamped(pattern.iter().flat_map(Literal::places))
    }

    /// True if some numbers are made from an end that another number stands for: it proves no miss.
    fn is_clamped(&self, mut places: impl Iterator<Item = Place>) -> bool {
        places.any(|place| {
            let used = self.ready.ends[place as usize];
            (0..2).any(|end| self.clamped[end] && used[end])
        })
    }

    fn holds(&self, literal: &Literal) -> bool {
        let mut product = if literal.is_negative { -1 } else { 1 };
        for place in &literal.signs {
            product *= self.sign(*place);
        }
        let mut nonzero = literal.nonzero.iter();
        product == 1 && nonzero.all(|place| self.sign(*place) != 0)
    }

    /// -1 or 1 if the sign is right, else 0.
    fn sign(&self, place: Place) -> i8 {
        let factor = self.ready.factors[place as usize];
        let factor = factor.expect("a sign that decides has a margin");
        let x = self.value(place);
        let mut least = F::zero();
        if factor != F::zero() {
            least = factor * self.sizes[place as usize] + self.ready.tiny;
        }
        i8::from(x > least && x.is_finite()) - i8::from(x < -least && x.is_finite())
    }

    fn value(&self, place: Place) -> F {
        self.values[place as usize]
    }

    /// Computes all numbers and their sizes.
    fn compute(&mut self) {
        let Ready { guarded, slack, .. } = self.ready;
        run(&guarded.operations, &self.inputs, &mut self.values);
        self.sizes.clear();
        for (size, value) in self.ready.sizes.iter().zip(&self.values) {
            let of = |place: Place| self.sizes[place as usize];
            let size = match *size {
                Size::OfLeaf => Real::abs(value),
                Size::Same(a) => of(a),
                Size::Sum(a, b) => of(a) + of(b),
                Size::Product(factors) => {
                    let [a, b] = factors.map(|(place, has_slack)| {
                        if has_slack {
                            of(place) + *slack
                        } else {
                            of(place)
                        }
                    });
                    a * b
                }
                Size::None => F::zero(),
            };
            self.sizes.push(size);
        }
    }
}
