//! Bounds of a program's rounding errors in a domain: formulas where nothing is divided, and quotients,
//! roots and whatever meets itself as variables of their own.

use super::dyadic::{Big, root_up, round_up};
use super::forms::{Forms, Leaf};
use super::formula::{DIGITS, Formula, Maximum, Source, Step};
use super::order::{follows, unsigned};
use super::{Domain, Dyadic, Format};
use crate::arith::recorded::{Operation, Place};
use crate::kernel::Path;
use num_traits::Signed;
use std::collections::HashMap;

/// Binary digits that the size of a lemma's number keeps: products of sizes stay short.
const SIZE_DIGITS: u32 = 12;

/// What holds for a number of a program, whatever the inputs in the domain.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Bound {
    /// Of the exact number.
    pub size: Dyadic,
    /// Of the computed number.
    pub computed: Dyadic,
    /// Of the difference of both.
    pub error: Dyadic,
}

/// One step of a proof: a number, its formula, and what follows.
#[derive(Clone, Debug)]
pub struct Lemma {
    /// The number.
    pub place: Place,
    /// What its bound is made from.
    pub rule: Rule,
    /// The formula whose errors were added up, with its variables.
    pub formula: Formula,
    /// What its corners say.
    pub maximum: Maximum,
    /// What follows for the number.
    pub bound: Bound,
}

/// How a lemma's bound follows from its formula.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rule {
    /// The formula is the number.
    Sum,
    /// The formula is numerator - quotient * divisor, and one division follows; or a reciprocal and a
    /// product, if `twice`.
    Quotient {
        /// By a reciprocal and a product.
        twice: bool,
        /// What it is divided by.
        divisor: Place,
        /// The least size of the exact divisor.
        floor: Dyadic,
    },
    /// The number is the length of a vector: of these three coordinates. There is no formula.
    Length([Place; 3]),
}

/// The proofs of one program in one domain.
#[derive(Debug)]
pub struct Prover<'a> {
    path: &'a Path,
    pub(super) domain: Domain,
    pub(super) format: Format,
    bounds: HashMap<Place, Result<Bound, String>>,
    /// The lemmas so far, each after those that it uses.
    pub lemmas: Vec<Lemma>,
}

impl<'a> Prover<'a> {
    /// Nothing is proved yet.
    pub fn new(path: &'a Path, domain: Domain, format: Format) -> Prover<'a> {
        Prover { path, domain, format, bounds: HashMap::new(), lemmas: Vec::new() }
    }

    pub(super) fn operation(&self, place: Place) -> Operation {
        self.path.operations[place as usize]
    }

    /// The bound of a number, or why there is none.
    pub fn bound(&mut self, place: Place) -> Result<Bound, String> {
        if let Operation::Neg(inner) | Operation::Abs(inner) = self.operation(place) {
            return self.bound(inner);
        }
        if let Some(known) = self.bounds.get(&place) {
            return known.clone();
        }
        let found = self.prove(place);
        self.bounds.insert(place, found.clone());
        found
    }

    fn prove(&mut self, place: Place) -> Result<Bound, String> {
        let (rule, formula, maximum, bound);
        if let Some((numerator, divisor, twice)) = self.quotient(place) {
            rule = Rule::Quotient { twice, divisor, floor: self.floor(divisor) };
            (formula, maximum, bound) = self.divide(numerator, divisor, twice)?;
        } else if let Operation::Sqrt(inner) = self.operation(place) {
            let vector = self.squares(inner).ok_or("its root is not the length of a vector")?;
            rule = Rule::Length(vector);
            (formula, maximum, bound) =
                (Formula::default(), Maximum::default(), self.length(vector)?);
        } else {
            rule = Rule::Sum;
            let mut builder = Builder::new(self);
            builder.expand(place)?;
            (formula, maximum) = builder.finish()?;
            let Bound { size, computed, .. } = formula.bounds[formula.bounds.len() - 1];
            let size = size.round_up(SIZE_DIGITS);
            let error = round_up(&(Big::from(maximum.first) + Big::from(maximum.rest)), DIGITS);
            bound = Bound { size, computed: computed.min(size.plus_up(error)), error };
        }
        if [bound.error, bound.size, bound.computed].iter().any(|x| !x.is_number()) {
            return Err("its bound needs more digits than there are".to_owned());
        }
        self.lemmas.push(Lemma { place, rule, formula, maximum, bound: bound.clone() });
        Ok(bound)
    }

    /// Numerator (none is one), divisor, and whether a reciprocal is multiplied, if the number is a quotient.
    pub(super) fn quotient(&self, place: Place) -> Option<(Option<Place>, Place, bool)> {
        let reciprocal = |place: Place| match self.operation(place) {
            Operation::Div(one, divisor) if self.operation(one) == Operation::Number(1) => {
                Some(divisor)
            }
            _ => None,
        };
        match self.operation(place) {
            Operation::Div(_, divisor) if reciprocal(place).is_some() => {
                Some((None, divisor, false))
            }
            Operation::Div(numerator, divisor) => Some((Some(numerator), divisor, false)),
            Operation::Mul(a, b) => reciprocal(b)
                .map(|divisor| (Some(a), divisor, true))
                .or_else(|| reciprocal(a).map(|divisor| (Some(b), divisor, true))),
            _ => None,
        }
    }

    fn divide(
        &mut self,
        numerator: Option<Place>,
        divisor: Place,
        twice: bool,
    ) -> Result<(Formula, Maximum, Bound), String> {
        let below = self.bound(divisor)?;
        let floor = self.floor(divisor);
        if floor <= below.error {
            return Err(
                "a divisor may be rounded to zero: the floor of divisors is too low".to_owned()
            );
        }
        let above = match numerator {
            Some(numerator) => self.bound(numerator)?,
            None => Bound { size: Dyadic::ONE, computed: Dyadic::ONE, error: Dyadic::ZERO },
        };
        let limit = Big::from(above.size) / Big::from(floor);
        // The path compares computed numbers, which says nothing of the exact ones unless they are equal.
        let at_most_one = above.error.is_zero()
            && below.error.is_zero()
            && numerator.is_some_and(|n| self.is_at_most_in_size(n, divisor));
        let size = match numerator {
            Some(_) if at_most_one => Big::from(Dyadic::ONE),
            Some(_) => limit.min(Big::from(self.domain.quotient)),
            None => limit,
        };
        let size = round_up(&size, SIZE_DIGITS);
        let mut builder = Builder::new(self);
        let n = match numerator {
            Some(numerator) => builder.expand(numerator)?,
            None => builder.number(1),
        };
        let d = builder.expand(divisor)?;
        let q = builder.variable(Source::Quotient, exactly(size));
        let product = builder.push(Step::Mul(q, d), None);
        builder.push(Step::Sub(n, product), None);
        let (formula, maximum) = builder.finish()?;
        // The quotient of the computed numbers against the exact one, then the roundings of the division.
        let sum = Big::from(maximum.first) + Big::from(maximum.rest);
        let before = sum / (Big::from(floor) - Big::from(below.error));
        let quotient = Big::from(size) + &before;
        let mut error = before;
        let mut rounded = quotient.clone();
        if twice {
            let tiny = Big::from(self.format.tiny()) * Big::from(above.computed);
            let reciprocal = Big::from(self.format.unit()) * quotient + tiny;
            error += &reciprocal;
            rounded += reciprocal;
        }
        if twice
            && Big::from(Dyadic::power(self.format.largest))
                * (Big::from(floor) - Big::from(below.error))
                <= Big::from(Dyadic::ONE)
        {
            return Err("a reciprocal may overflow: the floor of divisors is too low".to_owned());
        }
        if at_most_one && !twice {
            // The quotient of two floats that is at most one is rounded to at most one.
            rounded = Big::from(Dyadic::ONE);
        }
        self.bound_of_rounded(size, error, &rounded).map(|bound| (formula, maximum, bound))
    }

    /// The length of a vector. The sum of the squares is right to 4u, for no term is negative, and to as
    /// much again where squares underflow; so the root is right to 3u before it is rounded.
    fn length(&mut self, vector: [Place; 3]) -> Result<Bound, String> {
        let (mut errors, mut sizes) = (Big::from(Dyadic::ZERO), Big::from(Dyadic::ZERO));
        for place in vector {
            let Bound { size, error, .. } = self.bound(place)?;
            errors += Big::from(error) * Big::from(error);
            sizes += Big::from(size) * Big::from(size);
        }
        let shift = Big::from(root_up(&errors, DIGITS));
        let size = root_up(&sizes, SIZE_DIGITS);
        let (unit, three) = (Big::from(self.format.unit()), Big::from(Dyadic::new(3, 0)));
        let least = Big::from(self.domain.floor) - &shift;
        let tiny = Big::from(self.format.tiny()) * &three;
        if !least.is_positive() || tiny > &unit * &least * &least {
            return Err(
                "a length may be rounded to zero: the floor of divisors is too low".to_owned()
            );
        }
        let largest = Big::from(size) + &shift;
        let relative = three * unit * &largest;
        let rounded = largest + &relative;
        if &rounded * &rounded >= Big::from(Dyadic::power(self.format.largest)) {
            return Err("the square of a length may overflow".to_owned());
        }
        self.bound_of_rounded(size, shift + relative, &rounded)
    }

    /// Squares that are added up to a number, if that is what it is.
    fn squares(&self, place: Place) -> Option<[Place; 3]> {
        let mut squares = Vec::new();
        let mut open = vec![place];
        while let Some(place) = open.pop() {
            match self.operation(place) {
                Operation::Mul(a, b) if a == b => squares.push(a),
                Operation::Fma(a, b, c) if a == b => {
                    squares.push(a);
                    open.push(c);
                }
                Operation::Add(a, b) => open.extend([a, b]),
                _ => return None,
            }
        }
        squares.sort_unstable();
        squares.try_into().ok()
    }

    /// One more rounding of a number of the given size before it.
    fn bound_of_rounded(&self, size: Dyadic, error: Big, rounded: &Big) -> Result<Bound, String> {
        let error = round_up(&(error + Big::from(self.format.half_ulp_of(rounded))), DIGITS);
        let computed = round_up(rounded, self.format.digits);
        self.check_range(computed)?;
        Ok(Bound { size, computed, error })
    }

    fn check_range(&self, size: Dyadic) -> Result<(), String> {
        if size < Dyadic::power(self.format.largest) {
            Ok(())
        } else {
            Err("it may overflow".to_owned())
        }
    }

    /// The least size of a divisor in the domain.
    pub(super) fn floor(&self, divisor: Place) -> Dyadic {
        if self.is_largest_of_direction(divisor) {
            self.domain.direction_floor
        } else {
            self.domain.floor
        }
    }

    /// Whether a number is the coordinate of the direction that is largest in size.
    pub(super) fn is_largest_of_direction(&self, place: Place) -> bool {
        let Operation::Input(i @ 3..=5) = self.operation(place) else { return false };
        let others = (3..=5).filter(|axis| *axis != i).map(Operation::Input);
        let mut places = others.map(|axis| self.path.operations.iter().position(|op| *op == axis));
        places
            .all(|other| other.is_some_and(|other| self.is_at_most_in_size(other as Place, place)))
    }

    /// The lemmas that a number's bound uses, its own last.
    pub fn lemmas_of(&self, place: Place) -> Vec<Lemma> {
        let mut wanted = vec![place];
        let mut found = Vec::new();
        for lemma in self.lemmas.iter().rev() {
            if wanted.contains(&lemma.place) {
                wanted.extend(self.needs(lemma));
                found.push(lemma.clone());
            }
        }
        found.reverse();
        found
    }

    /// The numbers whose lemmas a lemma uses.
    fn needs(&self, lemma: &Lemma) -> Vec<Place> {
        let cut = |source: &Source| match source {
            Source::Cut(place) => Some(*place),
            _ => None,
        };
        let mut needs: Vec<Place> = lemma.formula.sources.iter().filter_map(cut).collect();
        match lemma.rule {
            Rule::Sum => {}
            Rule::Length(vector) => needs.extend(vector),
            Rule::Quotient { .. } => {
                let (numerator, divisor, _) = self.quotient(lemma.place).expect("a quotient");
                needs.extend(numerator);
                needs.push(divisor);
            }
        }
        needs.into_iter().map(|place| unsigned(self.path, place)).collect()
    }

    /// Whether |a| <= |b| follows from the decisions of the path.
    pub(super) fn is_at_most_in_size(&self, a: Place, b: Place) -> bool {
        let size = |place: Place| {
            let wanted = Operation::Abs(place);
            self.path.operations.iter().position(|op| *op == wanted).map(|at| at as Place)
        };
        match (size(a), size(b)) {
            (Some(a), Some(b)) => follows(self.path, a, b),
            _ => false,
        }
    }
}

/// Expands a number into a formula.
struct Builder<'p, 'a> {
    prover: &'p mut Prover<'a>,
    formula: Formula,
    supports: Vec<u64>,
    steps: HashMap<Place, usize>,
    forms: Forms,
}

impl<'p, 'a> Builder<'p, 'a> {
    fn new(prover: &'p mut Prover<'a>) -> Self {
        Builder {
            prover,
            formula: Formula::default(),
            supports: Vec::new(),
            steps: HashMap::new(),
            forms: Forms::default(),
        }
    }

    /// The formula and its corners; the last step is the result.
    fn finish(mut self) -> Result<(Formula, Maximum), String> {
        let maximum = self.formula.maximum(self.prover.format);
        let maximum = maximum.ok_or("its formula has too many variables or digits")?;
        if !maximum.first.is_number() || !maximum.rest.is_number() {
            return Err("its bound needs more digits than there are".to_owned());
        }
        for bound in &self.formula.bounds {
            self.prover.check_range(bound.computed)?;
        }
        Ok((self.formula, maximum))
    }

    /// A step that does not round; it is given if something is known of it.
    fn push(&mut self, step: Step, given: Option<Bound>) -> usize {
        let of = |i: usize| self.supports[i];
        let support = match step {
            Step::Variables(ref sum) => sum.iter().fold(0, |bits, (v, _)| bits | 1 << (v % 64)),
            Step::Number(_) => 0,
            Step::Neg(a) => of(a),
            Step::Add(a, b) | Step::Sub(a, b) | Step::Mul(a, b) => of(a) | of(b),
            Step::Fma(a, b, c) => of(a) | of(b) | of(c),
            Step::Minor(a, b, c, d) => of(a) | of(b) | of(c) | of(d),
        };
        self.supports.push(support);
        let Formula { steps, places, given: all_given, relative, rounds, .. } = &mut self.formula;
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
        self.push(Step::Number(value), Some(exactly(size)))
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
        let step = self.variable(Source::Cut(place), bound);
        self.formula.places[step] = Some(place);
        Ok(step)
    }

    fn leaf(&mut self, leaf: Leaf) -> usize {
        let size = leaf.bound(&self.prover.domain);
        let (sum, is_new) = self.forms.sum(leaf, self.formula.variables.len());
        if is_new {
            self.formula.variables.push(size);
            self.formula.sources.push(Source::Leaf(leaf));
        }
        let format = self.prover.format;
        let given = if leaf.is_difference() {
            let computed = size.round_up(format.digits);
            Bound { size, computed, error: format.half_ulp(size) }
        } else {
            exactly(size)
        };
        let step = self.push(Step::Variables(sum), Some(given));
        self.formula.rounds[step] = leaf.is_difference();
        step
    }

    fn expand(&mut self, place: Place) -> Result<usize, String> {
        if let Some(step) = self.steps.get(&place) {
            return Ok(*step);
        }
        let operation = self.prover.operation(place);
        let step = if self.prover.quotient(place).is_some() {
            self.cut(place)?
        } else if let Some(leaf) = Leaf::of(operation, &self.prover.path.operations) {
            self.leaf(leaf)
        } else {
            self.operation(place, operation)?
        };
        self.formula.places[step] = Some(place);
        self.steps.insert(place, step);
        Ok(step)
    }

    fn operation(&mut self, place: Place, operation: Operation) -> Result<usize, String> {
        let step = match operation {
            Operation::Input(_) => unreachable!("inputs are leaves"),
            Operation::Number(value) => return Ok(self.number(value)),
            Operation::Neg(a) => {
                let a = self.expand(a)?;
                return Ok(self.push(Step::Neg(a), None));
            }
            Operation::Div(..) | Operation::Sqrt(_) | Operation::Abs(_) => return self.cut(place),
            Operation::Add(a, b) => Step::Add(self.expand(a)?, self.expand(b)?),
            Operation::Sub(a, b) => Step::Sub(self.expand(a)?, self.expand(b)?),
            Operation::Mul(a, b) => {
                let [a, b] = self.factors(a, b)?;
                Step::Mul(a, b)
            }
            Operation::Fma(a, b, c) => {
                let [a, b] = self.factors(a, b)?;
                Step::Fma(a, b, self.expand(c)?)
            }
            Operation::Minor(a, b, c, d) => {
                let [a, b] = self.factors(a, b)?;
                let [c, d] = self.factors(c, d)?;
                let step = Step::Minor(a, b, c, d);
                if self.prover.format == Format::F64 {
                    // It rounds more than once, so that its error is no share of its result.
                    return Ok(self.push(step, None));
                }
                step
            }
        };
        Ok(self.rounded(step))
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
    Bound { size, computed: size, error: Dyadic::ZERO }
}
