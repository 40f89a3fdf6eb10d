//! A number's program as a formula: inputs and numbers with lemmas of their own are its variables.

use super::bound::{Bound, Proven, Prover};
use super::forms::{Forms, Leaf};
use super::formula::{Formula, Maximum, Step, VariableOrigin};
use super::{Domain, Dyadic, Format};
use crate::arith::recorded::{Operation, Place};
use std::collections::{HashMap, HashSet};

impl Prover<'_> {
    /// The formula of a number, and what its corners say.
    pub(super) fn formula(&mut self, place: Place) -> Proven<(Formula, Maximum)> {
        let mut builder = Builder::new(self);
        builder.expand(place)?;
        builder.finish()
    }

    /// numerator - quotient * divisor. No numerator is one; two are added up.
    pub(super) fn formula_of_quotient(
        &mut self,
        numerators: &[Place],
        divisor: Place,
        ends: Ends,
    ) -> Proven<OfQuotient> {
        // Where quotients have a sign, the corners of a box of points are some of those of a box of differences.
        let Domain { edge, reach, .. } = self.domain;
        let is_boxed = ends.below.is_some() && edge == reach;
        if is_boxed && let Ok(boxed) = self.formula_of_fraction(true, numerators, divisor, ends) {
            return Ok(boxed);
        }
        self.formula_of_fraction(false, numerators, divisor, ends)
    }

    fn formula_of_fraction(
        &mut self,
        is_boxed: bool,
        numerators: &[Place],
        divisor: Place,
        ends: Ends,
    ) -> Proven<OfQuotient> {
        let mut builder = Builder::new(self);
        builder.is_boxed = is_boxed;
        let mut all = Vec::new();
        for numerator in numerators {
            all.push(builder.expand(*numerator)?);
        }
        let d = builder.expand(divisor)?;
        let n = match all[..] {
            [] => builder.number(1),
            [n] => n,
            _ => builder.push(Step::Of(Operation::Add(all[0], all[1])), None),
        };
        let q = builder.variable(VariableOrigin::Quotient, Bound::exactly(ends.size));
        let v = builder.formula.variables.len() - 1;
        builder.formula.below = ends.below.map(|below| (v, below));
        let product = builder.push(Step::Of(Operation::Mul(q, d)), None);
        builder.push(Step::Of(Operation::Sub(n, product)), None);
        let mut leaves_out_numerators = Vec::new();
        for numerator in all {
            leaves_out_numerators.push(builder.leave_out(numerator));
        }
        let leaves_out_divisor = builder.leave_out(d);
        let (formula, maximum) = builder.finish()?;
        Ok(OfQuotient {
            formula,
            maximum,
            leaves_out_numerators,
            leaves_out_divisor,
        })
    }
}

/// The largest size of a quotient, and how far below zero it may be, if that is supposed.
#[derive(Clone, Copy)]
pub struct Ends {
    pub size: Dyadic,
    pub below: Option<Dyadic>,
}

/// A quotient's formula.
pub struct OfQuotient {
    pub formula: Formula,
    pub maximum: Maximum,
    /// For each numerator, true if its last rounding is left out.
    pub leaves_out_numerators: Vec<bool>,
    pub leaves_out_divisor: bool,
}

/// Expands a number into a formula.
struct Builder<'p, 'a> {
    prover: &'p mut Prover<'a>,
    formula: Formula,
    supports: Vec<u64>,
    steps: HashMap<Place, usize>,
    forms: Forms,
    /// True if points are variables, in one box, in place of their differences.
    is_boxed: bool,
}

impl<'p, 'a> Builder<'p, 'a> {
    fn new(prover: &'p mut Prover<'a>) -> Self {
        Builder {
            prover,
            formula: Formula::default(),
            supports: Vec::new(),
            steps: HashMap::new(),
            forms: Forms::new(),
            is_boxed: false,
        }
    }

    /// The formula and its corners; the last step is the result.
    fn finish(mut self) -> Proven<(Formula, Maximum)> {
        self.find_unit_vector();
        let maximum = self.formula.maximum(self.prover.format)?;
        for bound in &self.formula.bounds {
            self.prover.check_range(bound.computed)?;
        }
        Ok((self.formula, maximum))
    }

    /// Leaves out the rounding of a step, or of the step that it is the negative of, if they are used once; whether it did.
    fn leave_out(&mut self, step: usize) -> bool {
        let Formula {
            steps,
            given,
            rounds,
            ..
        } = &mut self.formula;
        let operands = steps.iter().flat_map(Step::operands);
        let uses = operands.filter(|operand| *operand == step).count();
        if uses != 1 {
            return false;
        }
        if let Step::Of(Operation::Neg(inner)) = steps[step] {
            return self.leave_out(inner);
        }
        if let Some(bound) = &mut given[step]
            && rounds[step]
        {
            bound.error = Dyadic::ZERO;
        }
        std::mem::replace(&mut rounds[step], false)
    }

    /// Coordinates of a unit vector are variables like others, unless the formula is linear in one such vector.
    fn find_unit_vector(&mut self) {
        let mut unit = Vec::new();
        let mut coordinates = HashSet::new();
        // One arithmetic for all coordinates: a product by a reciprocal has an error of the length in common.
        let mut lengths = HashSet::new();
        for (v, source) in self.formula.origins.iter().enumerate() {
            let VariableOrigin::Part(place) = *source else {
                continue;
            };
            let fraction = self.prover.quotient(place).expect("a part");
            unit.push(v);
            coordinates.insert(fraction.numerator);
            lengths.insert((fraction.divisor, fraction.twice));
        }
        let is_one = lengths.len() == 1 && coordinates.len() == unit.len();
        self.formula.unit = unit;
        if is_one && self.formula.linear_steps().is_some() {
            return;
        }
        for v in std::mem::take(&mut self.formula.unit) {
            if let VariableOrigin::Part(place) = self.formula.origins[v] {
                self.formula.origins[v] = VariableOrigin::Cut(place);
            }
        }
    }

    /// A step that does not round; it is given if something is known of it.
    fn push(&mut self, step: Step, given: Option<Bound>) -> usize {
        self.supports.push(step.support(&self.supports));
        let Formula {
            steps,
            places,
            given: all_given,
            relative,
            rounds,
            ..
        } = &mut self.formula;
        steps.push(step);
        places.push(None);
        all_given.push(given);
        relative.push(false);
        rounds.push(false);
        self.supports.len() - 1
    }

    fn rounded(&mut self, step: Step) -> usize {
        let step = self.push(step, None);
        self.formula.rounds[step] = true;
        step
    }

    fn number(&mut self, value: i32) -> usize {
        let size = Dyadic::new(i128::from(value).abs(), 0);
        self.push(
            Step::Of(Operation::Number(value)),
            Some(Bound::exactly(size)),
        )
    }

    /// A new variable with an error of its own.
    fn variable(&mut self, source: VariableOrigin, bound: Bound) -> usize {
        self.formula.variables.push(bound.size);
        self.formula.origins.push(source);
        let sum = vec![(self.formula.variables.len() - 1, 1)];
        self.push(Step::Variables(sum), Some(bound))
    }

    /// A number that is a variable here; its lemma says the rest.
    fn cut(&mut self, place: Place) -> Proven<usize> {
        let bound = self.prover.bound(place)?;
        let source = match self.prover.unit(place) {
            Some(_) => VariableOrigin::Part(place),
            None => VariableOrigin::Cut(place),
        };
        let step = self.variable(source, bound);
        self.formula.places[step] = Some(place);
        Ok(step)
    }

    /// The sum of variables that a leaf is.
    fn sum(&mut self, leaf: Leaf) -> Vec<(usize, i8)> {
        let next = self.formula.variables.len();
        let form = self.forms.sum(leaf, next);
        if form.is_new {
            let (source, size) = match leaf {
                Leaf::Point(point, axis) if self.is_boxed => (
                    VariableOrigin::Boxed(point, axis),
                    self.prover.domain.half_box(),
                ),
                _ => (VariableOrigin::Leaf(leaf), leaf.bound(&self.prover.domain)),
            };
            self.formula.variables.push(size);
            self.formula.origins.push(source);
        }
        form.sum
    }

    fn leaf(&mut self, leaf: Leaf) -> Proven<usize> {
        let size = leaf.bound(&self.prover.domain);
        let sum = match leaf {
            Leaf::Difference(p, q, axis) if self.is_boxed => {
                let [mut p, q] = [p, q].map(|point| self.sum(Leaf::Point(point, axis)));
                p.extend(q.into_iter().map(|(v, sign)| (v, -sign)));
                p
            }
            Leaf::Point(..) if self.is_boxed => {
                return Err("a coordinate is used as it is, not in differences alone".to_owned());
            }
            _ => self.sum(leaf),
        };
        let format = self.prover.format;
        let given = if leaf.is_difference() {
            let computed = size.round_up(format.digits);
            Bound {
                size,
                computed,
                error: format.half_ulp_of(&size.into()),
            }
        } else {
            Bound::exactly(size)
        };
        let step = self.push(Step::Variables(sum), Some(given));
        self.formula.rounds[step] = leaf.is_difference();
        Ok(step)
    }

    fn expand(&mut self, place: Place) -> Proven<usize> {
        if let Some(step) = self.steps.get(&place) {
            return Ok(*step);
        }
        let operation = self.prover.operation(place);
        let is_quotient =
            self.prover.quotient(place).is_some() || self.prover.quotients(place).is_some();
        let step = if is_quotient {
            self.cut(place)?
        } else if let Some(leaf) = Leaf::of(operation, &self.prover.path.operations) {
            self.leaf(leaf)?
        } else {
            self.operation(place, operation)?
        };
        self.formula.places[step] = Some(place);
        self.steps.insert(place, step);
        Ok(step)
    }

    fn operation(&mut self, place: Place, operation: Operation) -> Proven<usize> {
        match operation {
            Operation::Input(_) => unreachable!("inputs are leaves"),
            Operation::Number(value) => {
                self.prover.format.check_whole(value)?;
                return Ok(self.number(value));
            }
            Operation::Div(..) | Operation::Sqrt(_) | Operation::Abs(_) => return self.cut(place),
            _ => {}
        }
        let mut operands = Vec::new();
        for (_, a, b) in operation.terms() {
            match b {
                Some(b) => operands.extend(self.factors(a, b)?),
                None => operands.push(self.expand(a)?),
            }
        }
        let mut operands = operands.into_iter();
        let step = Step::Of(operation.with(|_| operands.next().expect("one for each")));
        Ok(match operation {
            Operation::Neg(_) => self.push(step, None),
            // It rounds more than once, so that its error is no share of its result.
            Operation::Minor(..) if self.prover.format == Format::F64 => self.push(step, None),
            _ => self.rounded(step),
        })
    }

    /// Two factors without a variable in common: if there is one, the second factor becomes a variable of
    /// its own.
    fn factors(&mut self, a: Place, b: Place) -> Proven<[usize; 2]> {
        let first = self.expand(a)?;
        let before = (self.formula.clone(), self.steps.clone(), self.forms.clone());
        let second = self.expand(b)?;
        if self.supports[first] & self.supports[second] == 0 {
            return Ok([first, second]);
        }
        (self.formula, self.steps, self.forms) = before;
        self.supports.truncate(self.formula.steps.len());
        Ok([first, self.cut(b)?])
    }
}
