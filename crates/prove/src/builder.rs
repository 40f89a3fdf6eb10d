//! A number's program as a formula: inputs and numbers with lemmas of their own are its variables.

use super::bound::{Bound, Prover};
use super::forms::{Forms, Leaf};
use super::formula::{Formula, Maximum, Source, Step};
use super::{Domain, Dyadic, Format};
use crate::arith::recorded::{Operation, Place};
use std::collections::{HashMap, HashSet};

impl Prover<'_> {
    /// The formula of a number, and what its corners say.
    pub(super) fn formula(&mut self, place: Place) -> Result<(Formula, Maximum), String> {
        let mut builder = Builder::new(self);
        builder.expand(place)?;
        builder.finish()
    }

    /// numerator - quotient * divisor, the quotient of this size, and down to minus the other one if it is given. No
    /// numerator is one; two are added up. And of which of all, the divisor last, the last rounding is left out.
    pub(super) fn formula_of_quotient(
        &mut self,
        numerators: &[Place],
        divisor: Place,
        size: (Dyadic, Option<Dyadic>),
    ) -> Result<(Formula, Maximum, Vec<bool>), String> {
        // Where quotients have a sign, the corners of a box of points are some of those of a box of differences.
        let Domain { edge, reach, .. } = self.domain;
        let is_boxed = size.1.is_some() && edge == reach;
        let boxed = is_boxed.then(|| self.formula_of_fraction(true, numerators, divisor, size));
        let boxed = boxed.and_then(Result::ok);
        boxed.map_or_else(
            || self.formula_of_fraction(false, numerators, divisor, size),
            Ok,
        )
    }

    fn formula_of_fraction(
        &mut self,
        is_boxed: bool,
        numerators: &[Place],
        divisor: Place,
        (size, below): (Dyadic, Option<Dyadic>),
    ) -> Result<(Formula, Maximum, Vec<bool>), String> {
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
        let q = builder.variable(Source::Quotient, exactly(size));
        let v = builder.formula.variables.len() - 1;
        builder.formula.below = below.map(|below| (v, below));
        let product = builder.push(Step::Of(Operation::Mul(q, d)), None);
        builder.push(Step::Of(Operation::Sub(n, product)), None);
        let of = if all.is_empty() {
            vec![n, d]
        } else {
            all.into_iter().chain([d]).collect()
        };
        let left_out = of.into_iter().map(|step| builder.leave_out(step)).collect();
        builder
            .finish()
            .map(|(formula, maximum)| (formula, maximum, left_out))
    }
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
    fn finish(mut self) -> Result<(Formula, Maximum), String> {
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
        if steps
            .iter()
            .flat_map(Step::operands)
            .filter(|operand| *operand == step)
            .count()
            != 1
        {
            return false;
        }
        if let Step::Of(Operation::Neg(inner)) = steps[step] {
            return self.leave_out(inner);
        }
        given[step]
            .iter_mut()
            .filter(|_| rounds[step])
            .for_each(|bound| bound.error = Dyadic::ZERO);
        std::mem::replace(&mut rounds[step], false)
    }

    /// Coordinates of a unit vector are variables like others, unless the formula is linear in one such vector.
    fn find_unit_vector(&mut self) {
        let Formula { sources, .. } = &self.formula;
        let part = |source: &Source| match *source {
            Source::Part(place) => self.prover.quotient(place),
            _ => None,
        };
        // One arithmetic for all coordinates: a product by a reciprocal has an error of the length in common.
        let lengths = sources
            .iter()
            .filter_map(part)
            .map(|(_, length, twice)| (length, twice));
        let coordinates = sources
            .iter()
            .filter_map(part)
            .map(|(coordinate, ..)| coordinate);
        let is_one = lengths.collect::<HashSet<(Place, bool)>>().len() == 1
            && coordinates.clone().collect::<HashSet<_>>().len() == coordinates.count();
        self.formula.unit = (0..sources.len())
            .filter(|v| matches!(sources[*v], Source::Part(_)))
            .collect();
        if !is_one || self.formula.linear_steps().is_none() {
            for v in std::mem::take(&mut self.formula.unit) {
                if let Source::Part(place) = self.formula.sources[v] {
                    self.formula.sources[v] = Source::Cut(place);
                }
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
        self.push(Step::Of(Operation::Number(value)), Some(exactly(size)))
    }

    /// A new variable with an error of its own.
    fn variable(&mut self, source: Source, bound: Bound) -> usize {
        self.formula.variables.push(bound.size);
        self.formula.sources.push(source);
        let sum = vec![(self.formula.variables.len() - 1, 1)];
        self.push(Step::Variables(sum), Some(bound))
    }

    /// A number that is a variable here; its lemma says the rest.
    fn cut(&mut self, place: Place) -> Result<usize, String> {
        let bound = self.prover.bound(place)?;
        let is_part = self.prover.unit(place).is_some();
        let source = if is_part {
            Source::Part(place)
        } else {
            Source::Cut(place)
        };
        let step = self.variable(source, bound);
        self.formula.places[step] = Some(place);
        Ok(step)
    }

    /// The sum of variables that a leaf is.
    fn sum(&mut self, leaf: Leaf) -> Vec<(usize, i8)> {
        let (sum, is_new) = self.forms.sum(leaf, self.formula.variables.len());
        if is_new {
            let (source, size) = match leaf {
                Leaf::Point(point, axis) if self.is_boxed => {
                    (Source::Boxed(point, axis), self.prover.domain.half_box())
                }
                _ => (Source::Leaf(leaf), leaf.bound(&self.prover.domain)),
            };
            self.formula.variables.push(size);
            self.formula.sources.push(source);
        }
        sum
    }

    fn leaf(&mut self, leaf: Leaf) -> Result<usize, String> {
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
            exactly(size)
        };
        let step = self.push(Step::Variables(sum), Some(given));
        self.formula.rounds[step] = leaf.is_difference();
        Ok(step)
    }

    fn expand(&mut self, place: Place) -> Result<usize, String> {
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

    fn operation(&mut self, place: Place, operation: Operation) -> Result<usize, String> {
        match operation {
            Operation::Input(_) => unreachable!("inputs are leaves"),
            Operation::Number(value) => return Ok(self.number(value)),
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
    fn factors(&mut self, a: Place, b: Place) -> Result<[usize; 2], String> {
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

/// A number of this size without an error.
fn exactly(size: Dyadic) -> Bound {
    Bound {
        size,
        computed: size,
        error: Dyadic::ZERO,
    }
}
