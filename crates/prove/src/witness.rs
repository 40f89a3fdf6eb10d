//! Witnesses: inputs of a proof's domain on which a number is as wrong as a search (`climb`) can make it.

use super::depth::Judge;
use super::gates::Quantity;
use super::measures::Sample;
use super::run::{Number, cone, run};
use super::{Domain, Leaf, Proof, Rule, Source};
use crate::arith::recorded::{Comparison, Operation, Place};
use crate::arith::{Bounded, Exact, Float};
use std::cmp::Ordering;

/// A scalar, with the arithmetic in which a search takes the exact numbers: right to far less than an ulp of
/// the scalar. The result of a search is measured again in [`Exact`] numbers.
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

/// The number that a search maximises.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Goal {
    /// The error of the computed number.
    Error,
    /// The size of the computed number where the exact one is zero.
    Zero,
    /// How far inside the line passes of a hit that an edge gate refuses, as a share of the longest edge.
    Missed,
    /// How far outside it passes of a miss that all gates let through.
    Hit,
}

impl Goal {
    /// The name in a table of witnesses.
    pub fn name(self) -> &'static str {
        match self {
            Goal::Error => "error",
            Goal::Zero => "parallel",
            Goal::Missed => "missed",
            Goal::Hit => "hit",
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
    /// The number itself, a quotient, is at least minus the first and at most the second. Verdicts are not held to it.
    Between(Place, f64, f64),
}

/// A search for the worst inputs of one quantity.
#[derive(Debug)]
pub struct Search<'a, F> {
    pub(super) operations: Vec<Operation>,
    decisions: Vec<(Comparison, bool)>,
    pub(super) place: Place,
    conditions: Vec<Condition>,
    pub(super) quantity: &'a Quantity,
    divides: bool,
    pub(super) domain: Domain,
    pub(super) computed: Vec<F>,
    /// The judge of verdicts, for the goals that are about them.
    pub(super) judge: Option<&'a Judge<'a, F>>,
    /// False if the last score is of a verdict that is not yet wrong.
    pub(super) counts: bool,
}

impl<'a, F: Searched> Search<'a, F> {
    /// For a quantity of a proof in a domain.
    pub fn new(proof: &Proof, quantity: &'a Quantity, domain: Domain) -> Search<'a, F> {
        let path = &proof.paths[quantity.path];
        let (mut cone, renamed) = cone(&path.operations, quantity.place);
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
                Rule::Unit { length, floor, .. } => {
                    let floor = floor.size().to_f64();
                    conditions.extend(at(length).map(|p| Condition::AtLeast(p, floor)));
                }
                Rule::Quotient { divisor, floor, below, .. } => {
                    let floor = floor.size().to_f64();
                    let size = lemma.bound.size.to_f64();
                    let condition = |place: Place| match below {
                        Some(below) => Condition::Between(place, below.to_f64(), size),
                        None => Condition::AtMost(place, size),
                    };
                    conditions.extend(at(lemma.place).map(condition));
                    conditions.extend(at(divisor).map(|p| Condition::AtLeast(p, floor)));
                }
            }
        }
        for leaf in boxed(quantity) {
            let Leaf::Difference(p, q, axis) = leaf else { continue };
            let inputs = [p, q].map(|point| Leaf::Point(point, axis));
            let at = |leaf: &Leaf| cone.iter().position(|it| Leaf::of(*it, &cone) == Some(*leaf));
            let [Some(p), Some(q)] = inputs.each_ref().map(at) else { continue };
            conditions.push(Condition::AtMost(cone.len() as Place, leaf.bound(&domain).to_f64()));
            cone.push(Operation::Sub(p as Place, q as Place));
        }
        let known = |places: &[Place]| places.iter().all(|p| renamed[*p as usize].is_some());
        let decisions = path.decisions[..quantity.decisions].iter();
        let decisions = decisions.filter(|(comparison, _)| known(&comparison.places()));
        let rename = |place: Place| renamed[place as usize].expect("known");
        let decisions = decisions.map(|(comparison, answer)| (comparison.with(rename), *answer));
        Search {
            decisions: decisions.collect(),
            place: renamed[quantity.place as usize].expect("in its own cone"),
            operations: cone,
            conditions,
            quantity,
            divides: quantity.uses().floor,
            domain,
            computed: Vec::new(),
            judge: None,
            counts: true,
        }
    }

    /// The same for wrong verdicts.
    pub(super) fn judged(self, judge: Option<&'a Judge<'a, F>>) -> Search<'a, F> {
        Search { judge, ..self }
    }

    /// The score of inputs; none outside the domain or the path.
    pub(super) fn score(
        &mut self,
        inputs: &Inputs<F>,
        goal: Goal,
        near: &mut Vec<F::Near>,
    ) -> Option<f64> {
        let is_verdict = matches!(goal, Goal::Missed | Goal::Hit);
        run(&self.operations, self.last(), inputs, &mut self.computed);
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
        // What divides supposes something of the scene's triangles and rays.
        let measures = self.domain.measures.filter(|_| self.divides);
        if measures.is_some_and(|of| !of.hold(&Sample::of(&inputs.map(|x| x.to_f64())))) {
            return None;
        }
        run(&self.operations, self.last(), &inputs.map(F::near), near);
        let value = |place: Place| F::approximate(&near[place as usize]);
        let compare = |place, sign: f64, bound: f64| (sign * value(place)?).partial_cmp(&bound);
        self.holds(is_verdict, compare)?;
        if is_verdict {
            let sample = Sample::of(&inputs.map(F::near));
            let (judge, is_hit) = (self.judge?, goal == Goal::Hit);
            let found = judge.score(inputs, is_hit, &self.domain, &sample, F::approximate)?;
            self.counts = found.1;
            return Some(found.0);
        }
        let (exact, computed) = (&near[self.place as usize], computed[self.place as usize]);
        let error = F::approximate(&(exact.clone() - &computed.near()))?;
        match goal {
            Goal::Error => Some(error.abs()),
            Goal::Zero => (F::approximate(exact)? == 0.0).then(|| computed.to_f64().abs()),
            Goal::Missed | Goal::Hit => None,
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

    /// Its last operation.
    pub(super) fn last(&self) -> Place {
        self.operations.len() as Place - 1
    }

    /// None outside the domain, or where that is not known, given how a number times a sign compares with a bound.
    fn holds(
        &self,
        is_verdict: bool,
        compare: impl Fn(Place, f64, f64) -> Option<Ordering>,
    ) -> Option<()> {
        let is_at_most =
            |place, sign, bound| Some(compare(place, sign, bound)? != Ordering::Greater);
        let is_between = |place, least, most| {
            Some(is_at_most(place, 1.0, most)? && is_at_most(place, -1.0, least)?)
        };
        let holds = |condition: &Condition| match *condition {
            Condition::AtMost(place, bound) => is_between(place, bound, bound),
            Condition::AtLeast(place, bound) => {
                let is_above = |sign| Some(compare(place, sign, bound)? != Ordering::Less);
                Some(is_above(1.0)? || is_above(-1.0)?)
            }
            Condition::Between(..) if is_verdict => Some(true),
            Condition::Between(place, least, most) => is_between(place, least, most),
        };
        self.conditions.iter().all(|it| holds(it).unwrap_or(false)).then_some(())
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
        run(&self.operations, self.last(), &inputs.map(|x| number(x.to_f64())), &mut values);
        let is_verdict = matches!(goal, Goal::Missed | Goal::Hit);
        let signed = |place: Place, sign: f64| {
            let value = values[place as usize].clone();
            if sign < 0.0 { -value } else { value }
        };
        self.holds(is_verdict, |place, sign, bound| compare(&signed(place, sign), &number(bound)))?;
        let exact = &values[self.place as usize];
        let zero = number(0.0);
        match goal {
            Goal::Error => approximate(&(exact.clone() - &number(computed)).abs()),
            Goal::Zero => (compare(exact, &zero)? == Ordering::Equal).then(|| computed.abs()),
            Goal::Missed | Goal::Hit => {
                let sample = Sample::of(&inputs.map(|x| number(x.to_f64())));
                let is_hit = goal == Goal::Hit;
                let judge = self.judge?;
                let (score, counts) =
                    judge.score(inputs, is_hit, &self.domain, &sample, approximate)?;
                counts.then_some(score)
            }
        }
    }
}

/// The differences of all points that are in one box in a quantity's proof.
fn boxed(quantity: &Quantity) -> Vec<Leaf> {
    let is_boxed = |point: usize, axis: usize| {
        let mut sources = quantity.lemmas.iter().flat_map(|lemma| &lemma.formula.sources);
        sources.any(|source| *source == Source::Boxed(point, axis))
    };
    let pairs = (0..4).flat_map(|p| (p + 1..4).map(move |q| (p, q)));
    let all = pairs.flat_map(|(p, q)| (0..3).map(move |axis| Leaf::Difference(p, q, axis)));
    all.filter(|leaf| match *leaf {
        Leaf::Difference(p, q, axis) => is_boxed(p, axis) && is_boxed(q, axis),
        _ => false,
    })
    .collect()
}

/// True if a coordinate is used otherwise than in a difference of points.
fn is_used_alone(path: &crate::kernel::Path, renamed: &[Option<Place>], place: usize) -> bool {
    path.operations.iter().enumerate().any(|(user, operation)| {
        renamed[user].is_some()
            && operation.operands().contains(&(place as Place))
            && !matches!(Leaf::of(*operation, &path.operations), Some(Leaf::Difference(..)))
    })
}
