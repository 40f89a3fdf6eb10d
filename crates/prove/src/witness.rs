//! Witnesses: inputs of a proof's domain on which a number is as wrong as a search (`climb`) can make it.

use super::depth::Judge;
use super::gates::Quantity;
use super::measures::{Angle, Sample};
use super::run::{Cone, cone, run};
use super::samples::Samples;
use super::{Domain, Dyadic, Leaf, Proof, Rule, VariableOrigin};
use crate::arith::recorded::{Comparison, Operation, Place};
use crate::arith::{Bounded, Exact, Float, Real};
use crate::kernel::Path;
use std::cmp::Ordering;

/// A scalar, with the arithmetic in which a search takes the exact numbers: right to far less than an ulp of
/// the scalar. The result of a search is measured again in [`Exact`] numbers.
pub trait Searched: Float {
    /// That arithmetic.
    type Near: Real;
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
enum Condition {
    /// The size of a number is at most this.
    AtMost(Place, f64),
    /// It is at least this.
    AtLeast(Place, f64),
    /// The number itself, a quotient, is at least minus the first and at most the second. Verdicts are not held to it.
    Between(Place, f64, f64),
}

/// A search for the worst inputs of one quantity.
pub struct Search<'a, F> {
    pub(super) operations: Vec<Operation>,
    decisions: Vec<(Comparison, bool)>,
    pub(super) place: Place,
    conditions: Vec<Condition>,
    pub(super) quantity: &'a Quantity,
    pub(super) domain: Domain,
    pub(super) computed: Vec<F>,
    /// The judge of verdicts, for the goals that are about them.
    pub(super) judge: Option<&'a Judge<'a, F>>,
    /// False if the last score is of a verdict that is not yet wrong.
    pub(super) counts: bool,
}

impl<'a, F: Searched> Search<'a, F> {
    /// For a quantity of a proof, in the domain of its bound. A judge is for the goals that are about verdicts.
    pub fn new(
        proof: &Proof,
        quantity: &'a Quantity,
        judge: Option<&'a Judge<'a, F>>,
    ) -> Search<'a, F> {
        let domain = quantity.domain;
        let path = &proof.paths[quantity.path];
        // A verdict in the unit domain is held to what is printed of all that the kernel divides.
        let is_whole = judge.is_some() && domain.measures.is_none();
        let cone = if is_whole {
            whole(path)
        } else {
            cone(&path.operations, quantity.place)
        };
        let renamed = cone.places;
        let mut cone = cone.operations;
        let mut conditions = if is_whole {
            divisions(path, &domain)
        } else {
            Vec::new()
        };
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
                Rule::Quotient {
                    divisor,
                    floor,
                    below,
                    ..
                } => {
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
        for (p, q, axis) in boxed(quantity) {
            let bound = Leaf::Difference(p, q, axis).bound(&domain).to_f64();
            let is_point =
                |it: &Operation, point| Leaf::of(*it, &cone) == Some(Leaf::Point(point, axis));
            let at = |point: usize| cone.iter().position(|it| is_point(it, point));
            let (Some(p), Some(q)) = (at(p), at(q)) else {
                continue;
            };
            conditions.push(Condition::AtMost(cone.len() as Place, bound));
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
            domain,
            computed: Vec::new(),
            judge,
            counts: true,
        }
    }

    /// The score of inputs; none outside the domain or the path.
    pub(super) fn score(
        &mut self,
        inputs: &Inputs<F>,
        goal: Goal,
        near: &mut Vec<F::Near>,
    ) -> Option<f64> {
        run(&self.operations, inputs, &mut self.computed);
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
        let angle = if goal == Goal::Zero {
            Angle::Zero
        } else {
            Angle::OfScene
        };
        if let Some(measures) = self.domain.measures {
            let sample = Sample::of(&inputs.map(F::to_f64));
            if !measures.hold(&sample, angle, F::EPSILON.to_f64()) {
                return None;
            }
        }
        let compare = |x: &F::Near, bound: f64| F::approximate(x)?.partial_cmp(&bound);
        let rules = (F::near, compare, F::approximate);
        let (score, counts) = self.measure(inputs, goal, near, rules)?;
        self.counts = counts;
        Some(score)
    }

    /// The exact score of inputs, in the domain by exact arithmetic; none if they are outside.
    pub fn exact(&mut self, inputs: &Inputs<F>, goal: Goal) -> Option<f64> {
        self.score(inputs, goal, &mut Vec::new())?;
        let mut operations = self.operations.iter();
        let has_root = operations.any(|it| matches!(it, Operation::Sqrt(_)));
        let (score, counts) = if has_root {
            // Exact numbers with roots grow too long; these know their own errors.
            let number = |x: F| Bounded::new(x.to_f64());
            let compare = |x: &Bounded, bound: f64| {
                (*x - Bounded::new(bound)).approximate()?.partial_cmp(&0.0)
            };
            let rules = (number, compare, |x: &Bounded| x.approximate());
            self.measure(inputs, goal, &mut Vec::new(), rules)?
        } else {
            let number = |x: F| Exact::from_f64(x.to_f64());
            let compare = |x: &Exact, bound: f64| (x.clone() - Exact::from_f64(bound)).sign();
            let rules = (number, compare, |x: &Exact| Some(x.approximate()));
            self.measure(inputs, goal, &mut Vec::new(), rules)?
        };
        counts.then_some(score)
    }

    /// True in the domain, given how a number times a sign compares with a bound; false where that is not known.
    fn holds(
        &self,
        is_verdict: bool,
        compare: impl Fn(Place, f64, f64) -> Option<Ordering>,
    ) -> bool {
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
        self.conditions.iter().all(|it| holds(it).unwrap_or(false))
    }

    /// The score of inputs that the last run was about, and true if it is of the wanted kind; none outside the domain. In an
    /// arithmetic that is given by how it makes a number, compares one with a bound, and makes a float of one.
    fn measure<R: Real>(
        &self,
        inputs: &Inputs<F>,
        goal: Goal,
        values: &mut Vec<R>,
        (number, compare, float): (
            impl Fn(F) -> R,
            impl Fn(&R, f64) -> Option<Ordering>,
            impl Fn(&R) -> Option<f64>,
        ),
    ) -> Option<(f64, bool)> {
        let is_verdict = matches!(goal, Goal::Missed | Goal::Hit);
        let numbers = inputs.map(&number);
        run(&self.operations, &numbers, values);
        let signed = |place: Place, sign: f64| {
            let value = values[place as usize].clone();
            if sign < 0.0 { -value } else { value }
        };
        if !self.holds(is_verdict, |place, sign, bound| {
            compare(&signed(place, sign), bound)
        }) {
            return None;
        }
        let exact = &values[self.place as usize];
        let computed = self.computed[self.place as usize];
        match goal {
            Goal::Error => Some((float(&(exact.clone() - &number(computed)).abs())?, true)),
            Goal::Zero => {
                (compare(exact, 0.0)? == Ordering::Equal).then(|| (computed.to_f64().abs(), true))
            }
            Goal::Missed | Goal::Hit => {
                let sample = Sample::of(&numbers);
                self.judge?
                    .score(inputs, goal == Goal::Hit, &self.domain, &sample, float)
            }
        }
    }
}

/// The program of a path, as a cone is given.
fn whole(path: &Path) -> Cone {
    let operations = path.operations.clone();
    let places = (0..operations.len() as Place).map(Some).collect();
    Cone { operations, places }
}

/// The conditions of a domain on all divisors, quotients and roots of a path.
fn divisions(path: &Path, domain: &Domain) -> Vec<Condition> {
    let samples = Samples::new(path);
    let [direction_floor, floor, quotient] =
        [domain.direction_floor, domain.floor, domain.quotient].map(Dyadic::to_f64);
    let mut conditions = Vec::new();
    for (place, operation) in (0..).zip(&path.operations) {
        match *operation {
            Operation::Sqrt(_) => conditions.push(Condition::AtLeast(place, floor)),
            Operation::Div(numerator, divisor) => {
                let leaf = Leaf::of(path.operations[divisor as usize], &path.operations);
                let is_of_direction = matches!(leaf, Some(Leaf::Direction(_)));
                let least = if is_of_direction {
                    direction_floor
                } else {
                    floor
                };
                conditions.push(Condition::AtLeast(divisor, least));
                let is_reciprocal = path.operations[numerator as usize] == Operation::Number(1);
                // A false hit is where a barycentric coordinate is not between 0 and 1.
                if !is_reciprocal && !samples.is_share(place) {
                    conditions.push(Condition::AtMost(place, quotient));
                }
            }
            _ => {}
        }
    }
    conditions
}

/// The pairs of all points, and the axes, that are in one box in a quantity's proof.
fn boxed(quantity: &Quantity) -> Vec<(usize, usize, usize)> {
    let is_boxed = |point: usize, axis: usize| {
        let lemmas = quantity.lemmas.iter();
        let mut origins = lemmas.flat_map(|lemma| &lemma.formula.origins);
        origins.any(|source| *source == VariableOrigin::Boxed(point, axis))
    };
    let mut all = Vec::new();
    for (p, q) in [(0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3)] {
        for axis in 0..3 {
            if is_boxed(p, axis) && is_boxed(q, axis) {
                all.push((p, q, axis));
            }
        }
    }
    all
}

/// True if a coordinate is used otherwise than in a difference of points.
fn is_used_alone(path: &Path, renamed: &[Option<Place>], place: usize) -> bool {
    path.operations.iter().enumerate().any(|(user, operation)| {
        let leaf = Leaf::of(*operation, &path.operations);
        let is_difference = leaf.is_some_and(Leaf::is_difference);
        let uses = operation.operands().contains(&(place as Place));
        renamed[user].is_some() && uses && !is_difference
    })
}
