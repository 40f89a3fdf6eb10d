//! Witnesses: inputs of a proof's domain on which a number is as wrong as a search can make it.

use super::gates::Quantity;
use super::run::{Number, cone, run};
use super::{Domain, Leaf, Proof, Rule, Source};
use crate::arith::recorded::{Comparison, Operation, Place};
use crate::arith::{Bounded, Exact, Float};
use crate::case::Draw;
use std::cmp::Ordering;

/// A scalar, with the arithmetic in which a search takes the exact numbers: right to far less than an ulp of
/// the scalar. What a search finds is measured again in [`Exact`] numbers.
pub trait Searched: Float + Number {
    /// That arithmetic.
    type Near: Number;
    /// The number in it.
    fn near(self) -> Self::Near;
    /// Near enough, as a float; none if that is not known.
    fn approximate(x: &Self::Near) -> Option<f64>;
}

impl Searched for f32 {
    type Near = f64;
    fn near(self) -> f64 {
        self.into()
    }
    fn approximate(x: &f64) -> Option<f64> {
        Some(*x)
    }
}

impl Searched for f64 {
    type Near = Bounded;
    fn near(self) -> Bounded {
        Bounded::new(self)
    }
    fn approximate(x: &Bounded) -> Option<f64> {
        x.within(1e-25)
    }
}

/// What a search maximises.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Goal {
    /// The error of the computed number.
    Error,
    /// The size of the computed number where the exact one is zero.
    Zero,
    /// How far below zero the computed number is where the exact one is not.
    Lost,
}

impl Goal {
    /// The name in a table of witnesses.
    pub fn name(self) -> &'static str {
        match self {
            Goal::Error => "error",
            Goal::Zero => "parallel",
            Goal::Lost => "lost",
        }
    }
}

/// The seventeen numbers of a case, in the order of `Case::hex`.
pub type Inputs<F> = [F; 17];

/// One condition of a domain on the exact numbers of a program.
#[derive(Clone, Copy, Debug)]
enum Condition {
    /// The size of a number is at most this.
    AtMost(Place, f64),
    /// It is at least this.
    AtLeast(Place, f64),
}

/// A search for the worst inputs of one quantity.
#[derive(Debug)]
pub struct Search<'a, F> {
    operations: Vec<Operation>,
    decisions: Vec<(Comparison, bool)>,
    place: Place,
    conditions: Vec<Condition>,
    quantity: &'a Quantity,
    domain: Domain,
    computed: Vec<F>,
}

impl<'a, F: Searched> Search<'a, F> {
    /// For a quantity of a proof in a domain.
    pub fn new(proof: &Proof, quantity: &'a Quantity, domain: Domain) -> Search<'a, F> {
        let path = &proof.paths[quantity.path];
        let (cone, renamed) = cone(&path.operations, quantity.place);
        let mut conditions = Vec::new();
        for (old, new) in renamed.iter().enumerate() {
            let (Some(new), Some(leaf)) = (new, Leaf::of(path.operations[old], &path.operations))
            else {
                continue;
            };
            let is_inner = matches!(leaf, Leaf::Point(..)) && !is_used_alone(path, &renamed, old);
            if !is_inner {
                conditions.push(Condition::AtMost(*new, leaf.bound(&domain).to_f64()));
            }
        }
        for lemma in &quantity.lemmas {
            let at = |place: Place| renamed[place as usize];
            match lemma.rule {
                Rule::Sum => {}
                Rule::Length(_) => {
                    let floor = domain.floor.to_f64();
                    conditions.extend(at(lemma.place).map(|p| Condition::AtLeast(p, floor)));
                }
                Rule::Quotient { divisor, floor, .. } => {
                    let size = lemma.bound.size.to_f64();
                    conditions.extend(at(lemma.place).map(|p| Condition::AtMost(p, size)));
                    conditions.extend(at(divisor).map(|p| Condition::AtLeast(p, floor.to_f64())));
                }
            }
        }
        let known = |places: &[Place]| places.iter().all(|p| renamed[*p as usize].is_some());
        let decisions = path.decisions[..quantity.decisions].iter();
        let decisions = decisions.filter(|(comparison, _)| known(&comparison.places()));
        let rename = |place: Place| renamed[place as usize].expect("known");
        let decisions = decisions.map(|(comparison, answer)| {
            let comparison = match *comparison {
                Comparison::Less(a, b) => Comparison::Less(rename(a), rename(b)),
                Comparison::AtMost(a, b) => Comparison::AtMost(rename(a), rename(b)),
                Comparison::Zero(a) => Comparison::Zero(rename(a)),
                Comparison::Negative(a) => Comparison::Negative(rename(a)),
            };
            (comparison, *answer)
        });
        Search {
            decisions: decisions.collect(),
            place: renamed[quantity.place as usize].expect("in its own cone"),
            operations: cone,
            conditions,
            quantity,
            domain,
            computed: Vec::new(),
        }
    }

    /// The score of inputs; none outside the domain or the path.
    fn score(&mut self, inputs: &Inputs<F>, goal: Goal, near: &mut Vec<F::Near>) -> Option<f64> {
        run(&self.operations, self.place, inputs, &mut self.computed);
        let computed = &self.computed;
        let holds = |(comparison, answer): &(Comparison, bool)| {
            let of = |place: Place| &computed[place as usize];
            let found = match *comparison {
                Comparison::Less(a, b) => of(a).is_less(of(b)),
                Comparison::AtMost(a, b) => of(a).is_at_most(of(b)),
                Comparison::Zero(a) => of(a).is_zero(),
                Comparison::Negative(a) => of(a).is_sign_negative(),
            };
            found == *answer
        };
        if !self.decisions.iter().all(holds) {
            return None;
        }
        run(&self.operations, self.place, &inputs.map(F::near), near);
        for condition in &self.conditions {
            let size = |place: Place| F::approximate(&near[place as usize]).map(f64::abs);
            let holds = match *condition {
                Condition::AtMost(place, bound) => size(place)? <= bound,
                Condition::AtLeast(place, bound) => size(place)? >= bound,
            };
            if !holds {
                return None;
            }
        }
        let (exact, computed) = (&near[self.place as usize], computed[self.place as usize]);
        let error = F::approximate(&(exact.clone() - &computed.near()))?;
        match goal {
            Goal::Error => Some(error.abs()),
            Goal::Zero => (F::approximate(exact)? == 0.0).then(|| computed.to_f64().abs()),
            Goal::Lost => (F::approximate(exact)? >= 0.0).then(|| -computed.to_f64()),
        }
    }

    /// The exact score of inputs, in the domain by exact arithmetic; none if they are outside.
    pub fn exact(&self, inputs: &Inputs<F>, goal: Goal) -> Option<f64> {
        let mut checked = Search {
            computed: Vec::new(),
            conditions: self.conditions.clone(),
            decisions: self.decisions.clone(),
            operations: self.operations.clone(),
            ..*self
        };
        checked.score(inputs, goal, &mut Vec::new())?;
        let computed = checked.computed[self.place as usize].to_f64();
        if self.operations.iter().any(|operation| matches!(operation, Operation::Sqrt(_))) {
            // Exact numbers with roots grow too long; these know their own errors.
            return self.measure(
                inputs,
                goal,
                computed,
                Bounded::new,
                |x, y| {
                    let difference = *x - y;
                    difference.approximate().and_then(|d| d.partial_cmp(&0.0))
                },
                |x| x.approximate(),
            );
        }
        let compare = |x: &Exact, y: &Exact| (x.clone() - y).sign();
        self.measure(inputs, goal, computed, Exact::from_f64, compare, |x| Some(x.approximate()))
    }

    fn measure<R: Number>(
        &self,
        inputs: &Inputs<F>,
        goal: Goal,
        computed: f64,
        number: impl Fn(f64) -> R,
        compare: impl Fn(&R, &R) -> Option<Ordering>,
        approximate: impl Fn(&R) -> Option<f64>,
    ) -> Option<f64> {
        let mut values = Vec::new();
        run(&self.operations, self.place, &inputs.map(|x| number(x.to_f64())), &mut values);
        for condition in &self.conditions {
            let (Condition::AtMost(place, bound) | Condition::AtLeast(place, bound)) = *condition;
            let refused = match condition {
                Condition::AtMost(..) => Ordering::Greater,
                Condition::AtLeast(..) => Ordering::Less,
            };
            if compare(&values[place as usize].abs(), &number(bound))? == refused {
                return None;
            }
        }
        let exact = &values[self.place as usize];
        let zero = number(0.0);
        match goal {
            Goal::Error => approximate(&(exact.clone() - &number(computed)).abs()),
            Goal::Zero => (compare(exact, &zero)? == Ordering::Equal).then(|| computed.abs()),
            Goal::Lost => (compare(exact, &zero)? != Ordering::Less).then_some(-computed),
        }
    }

    /// Climbs for so many evaluations; the best inputs and their exact score.
    pub fn climb(
        &mut self,
        goal: Goal,
        evaluations: u64,
        draw: &mut Draw,
        known: &[Inputs<F>],
    ) -> Option<(Inputs<F>, f64)> {
        let mut near = Vec::new();
        let mut best: Option<(Inputs<F>, f64)> = None;
        let mut current: Option<(Inputs<F>, f64)> = None;
        let mut stale = 0;
        for _ in 0..evaluations {
            // Starts again where nothing better came for long; sometimes from a known case.
            if current.is_none() || stale > 20_000 {
                let inputs = match known {
                    [_, ..] if draw.below(4) == 0 => draw.pick(known),
                    _ => self.start(goal, draw),
                };
                current = self.score(&inputs, goal, &mut near).map(|score| (inputs, score));
                stale = 0;
                continue;
            }
            let Some((inputs, score)) = current else { continue };
            let mut tried = inputs;
            for _ in 0..1 + draw.below(3) {
                self.change(&mut tried, draw);
            }
            if goal == Goal::Zero {
                make_parallel(&mut tried, draw);
            }
            stale += 1;
            let Some(found) = self.score(&tried, goal, &mut near) else { continue };
            // A little worse is allowed now and then.
            let slack = if draw.below(64) == 0 { 0.02 * score.abs() } else { 0.0 };
            if found >= score - slack {
                if found > score {
                    stale = stale.min(10_000);
                }
                current = Some((tried, found));
            }
            if best.is_none_or(|(_, best)| found > best) {
                (best, stale) = (Some((tried, found)), 0);
            }
        }
        let (inputs, _) = best?;
        self.exact(&inputs, goal).map(|score| (inputs, score))
    }

    /// Inputs in the boxes, often near the corner of the bound.
    fn start(&self, goal: Goal, draw: &mut Draw) -> Inputs<F> {
        let mut inputs = [F::zero(); 17];
        let world = self.domain.world.to_f64();
        let shift = draw.below(30) as i32;
        let offset = |draw: &mut Draw| world * draw.symmetric::<f64>() * 2f64.powi(-shift);
        let [edge, reach] = [self.domain.edge, self.domain.reach].map(|x| x.to_f64());
        let at_corner = draw.coin();
        let size = |draw: &mut Draw, bound: f64| {
            let size = match draw.below(3) {
                0 => bound * draw.unit(),
                1 => bound * (1.0 - draw.unit() * 0.01),
                _ => bound * (1.0 - draw.unit() * 2f64.powi(-12)),
            };
            if draw.coin() { size } else { -size }
        };
        let lemma = self.quantity.lemmas.last();
        let sign = |wanted: Leaf| {
            let lemma = lemma.filter(|_| at_corner)?;
            let at = lemma.formula.sources.iter().position(|s| *s == Source::Leaf(wanted))?;
            Some(*lemma.maximum.corner.get(at)?)
        };
        let signed = |x: f64, minus: Option<bool>| match minus {
            Some(true) => -x.abs(),
            Some(false) => x.abs(),
            None => x,
        };
        for axis in 0..3 {
            let a = offset(draw);
            inputs[6 + axis] = F::from_f64(a);
            for (point, bound) in [(2, edge), (3, edge), (0, reach)] {
                let x = size(draw, bound);
                let minus = sign(Leaf::Difference(point, 1, axis))
                    .or(sign(Leaf::Difference(1, point, axis)).map(|minus| !minus));
                let at = if point == 0 { axis } else { 3 + 3 * point + axis };
                inputs[at] = F::from_f64(a + signed(x, minus));
            }
            // Where only vectors from the origin count, they are drawn around it.
            if sign(Leaf::Difference(1, 0, axis)).is_some() || !self.quantity.uses().edge {
                let o = offset(draw);
                inputs[axis] = F::from_f64(o);
                for point in 1..=3 {
                    let x = size(draw, reach);
                    let minus = sign(Leaf::Difference(point, 0, axis));
                    inputs[3 + 3 * point + axis] = F::from_f64(o + signed(x, minus));
                }
            }
            let direction = size(draw, self.domain.direction.to_f64());
            inputs[3 + axis] = F::from_f64(signed(direction, sign(Leaf::Direction(axis))));
        }
        let extent = self.domain.extent.to_f64();
        inputs[15] = F::from_f64(size(draw, extent));
        inputs[16] = F::from_f64(size(draw, extent));
        if goal == Goal::Zero {
            make_parallel(&mut inputs, draw);
        }
        inputs
    }

    fn change(&self, inputs: &mut Inputs<F>, draw: &mut Draw) {
        let i = draw.below(if self.quantity.uses().extent { 17 } else { 15 });
        let x = inputs[i];
        inputs[i] = match draw.below(8) {
            0..3 => x.offset_ulps(draw.integer(-3, 3)),
            3 => x.offset_ulps(draw.integer(-300, 300)),
            4 => {
                let exponent = -draw.integer(0, i64::from(F::DIGITS) + 6);
                let scale = self.domain.reach.max(self.domain.edge).to_f64();
                x + F::from_f64(scale * draw.symmetric::<f64>() * 2f64.powi(exponent as i32))
            }
            5 => -x,
            6 => {
                // Fewer digits.
                let keep = 1 + draw.below(F::DIGITS as usize) as u32;
                let drop = F::DIGITS - keep.min(F::DIGITS);
                F::from_bits(x.to_bits() >> drop << drop)
            }
            _ => {
                // The other points along the same axis move along.
                let by = F::from_f64(draw.symmetric::<f64>() * 2f64.powi(-(draw.below(40) as i32)));
                if !(3..6).contains(&i) && i < 15 {
                    for j in [0, 6, 9, 12].map(|j| j + i % 3) {
                        if j != i {
                            inputs[j] = inputs[j] + by;
                        }
                    }
                }
                x + by
            }
        };
    }
}

/// Makes the direction one of the edges, so that it lies in the plane if the difference is exact.
fn make_parallel<F: Float>(inputs: &mut Inputs<F>, draw: &mut Draw) {
    let (from, to) = draw.pick(&[(6, 9), (6, 12), (9, 12)]);
    for axis in 0..3 {
        inputs[3 + axis] = inputs[to + axis] - inputs[from + axis];
    }
}

/// Whether a coordinate is used otherwise than in a difference of points.
fn is_used_alone(path: &crate::kernel::Path, renamed: &[Option<Place>], place: usize) -> bool {
    path.operations.iter().enumerate().any(|(user, operation)| {
        renamed[user].is_some()
            && operation.operands().contains(&(place as Place))
            && !matches!(Leaf::of(*operation, &path.operations), Some(Leaf::Difference(..)))
    })
}
