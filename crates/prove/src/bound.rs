//! Bounds of a program's rounding errors in a domain: formulas where nothing is divided, and quotients,
//! coordinates of unit vectors and whatever meets itself as variables of their own.

use super::dyadic::{Big, round_up};
use super::formula::{DIGITS, Formula, Maximum, VariableOrigin};
use super::measures::Limit;
use super::order::{is_at_most, unsigned};
use super::run::parts;
use super::samples::Samples;
use super::{Domain, Dyadic, Format};
use crate::arith::recorded::{Operation, Place};
use crate::kernel::Path;
use std::cell::OnceCell;
use std::collections::{BTreeSet, HashMap};

/// A value, or in one sentence why there is none.
pub type Proven<T> = Result<T, String>;

/// Binary digits that the size of a lemma's number keeps: products of sizes stay short.
pub const SIZE_DIGITS: u32 = 12;

/// Bounds of a number of a program that hold for all inputs in the domain.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Bound {
    /// The bound of the exact number.
    pub size: Dyadic,
    /// The bound of the computed number.
    pub computed: Dyadic,
    /// The bound of the difference of both.
    pub error: Dyadic,
}

impl Bound {
    /// The bound of a number within the error of the exact one.
    pub(super) fn largest(&self) -> Big {
        Big::from(self.size) + Big::from(self.error)
    }

    /// The bound of a number of this size without an error.
    pub(super) fn exactly(size: Dyadic) -> Bound {
        Bound {
            size,
            computed: size,
            error: Dyadic::ZERO,
        }
    }
}

/// One step of a proof: a number, its formula, and what follows.
#[derive(Clone, Debug)]
pub struct Lemma {
    /// The number.
    pub place: Place,
    /// The rule that its bound is made from.
    pub rule: Rule,
    /// The formula whose errors were added up, with its variables.
    pub formula: Formula,
    /// The maximum over its corners.
    pub maximum: Maximum,
    /// The bound of the number that follows.
    pub bound: Bound,
}

/// The bound of the last step of a formula.
fn bound_of_sum(formula: &Formula, maximum: &Maximum) -> Bound {
    let Bound { size, computed, .. } = formula.bounds[formula.bounds.len() - 1];
    let size = size.round_up(SIZE_DIGITS);
    let error = round_up(&maximum.error(), DIGITS);
    Bound {
        size,
        computed: computed.min(size.plus_up(error)),
        error,
    }
}

/// A number made of quotients by one divisor.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ratio {
    /// A quotient.
    One,
    /// The sum of two.
    Sum,
    /// 1 less one, less another one.
    Rest,
}

/// How a lemma's bound follows from its formula.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rule {
    /// The formula is the number.
    Sum,
    /// The formula is numerator - quotient * divisor, and one division follows; or a reciprocal and a
    /// product, if `twice`. Of two quotients by one divisor, it is numerator + numerator - sum * divisor.
    Quotient {
        /// How many quotients the number is made of.
        ratio: Ratio,
        /// By a reciprocal and a product.
        twice: bool,
        /// The number that it is divided by.
        divisor: Place,
        /// The least size of the exact divisor.
        floor: Limit,
        /// The largest size of the exact quotient.
        most: Limit,
        /// Minus its least value, if that is supposed: see [`Domain::below`].
        below: Option<Dyadic>,
    },
    /// The number is a coordinate of a vector divided by its length. There is no formula.
    Unit {
        /// The coordinates of the vector.
        vector: [Place; 3],
        /// The length.
        length: Place,
        /// The least length.
        floor: Limit,
    },
}

/// The proofs of one program in one domain.
#[derive(Debug)]
pub struct Prover<'a> {
    pub(super) path: &'a Path,
    pub(super) domain: Domain,
    pub(super) format: Format,
    bounds: HashMap<Place, Proven<Bound>>,
    /// The recogniser of known numbers, once it is asked.
    samples: OnceCell<Samples<'a>>,
    /// The lemmas so far, each after those that it uses.
    pub lemmas: Vec<Lemma>,
}

impl<'a> Prover<'a> {
    /// Nothing is proved yet.
    pub fn new(path: &'a Path, domain: Domain, format: Format) -> Prover<'a> {
        Prover {
            path,
            domain,
            format,
            bounds: HashMap::new(),
            samples: OnceCell::new(),
            lemmas: Vec::new(),
        }
    }

    pub(super) fn samples(&self) -> &Samples<'a> {
        self.samples.get_or_init(|| Samples::new(self.path))
    }

    pub(super) fn operation(&self, place: Place) -> Operation {
        self.path.operations[place as usize]
    }

    /// The bound of a number, or why there is none.
    pub fn bound(&mut self, place: Place) -> Proven<Bound> {
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

    fn prove(&mut self, place: Place) -> Proven<Bound> {
        let lemma = self.lemma(place)?;
        let bound = lemma.bound.clone();
        let numbers = [bound.error, bound.size, bound.computed];
        if !numbers.into_iter().all(Dyadic::is_number) {
            return Err("its bound needs more digits than there are".to_owned());
        }
        self.lemmas.push(lemma);
        Ok(bound)
    }

    fn lemma(&mut self, place: Place) -> Proven<Lemma> {
        if let Some(unit) = self.unit(place) {
            return self.lemma_of_unit(place, unit);
        }
        if let Some(fraction) = self.quotient(place) {
            return self.divide(place, fraction);
        }
        if let Some(both) = self.quotients(place) {
            return self.divide_both(place, both);
        }
        if let Operation::Sqrt(_) = self.operation(place) {
            return Err("its root is used otherwise than to divide a vector by its length".into());
        }
        let (formula, maximum) = self.formula(place)?;
        let bound = bound_of_sum(&formula, &maximum);
        Ok(Lemma {
            place,
            rule: Rule::Sum,
            formula,
            maximum,
            bound,
        })
    }

    /// An error if a computed number may be infinite.
    pub(super) fn check_range(&self, size: Dyadic) -> Proven<()> {
        if size < Dyadic::power(self.format.largest) {
            Ok(())
        } else {
            Err("it may overflow".to_owned())
        }
    }

    /// True if a number is the coordinate of the direction that is largest in size.
    pub(super) fn is_largest_of_direction(&self, place: Place) -> bool {
        let Operation::Input(i @ 3..=5) = self.operation(place) else {
            return false;
        };
        (3..=5).all(|other| is_at_most(self.path, other, i))
    }

    /// The lemmas that a number's bound uses, its own last.
    pub fn lemmas_of(&self, place: Place) -> Vec<Lemma> {
        let mut wanted = vec![unsigned(self.path, place)];
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
        let cut = |source: &VariableOrigin| match source {
            VariableOrigin::Cut(place) | VariableOrigin::Part(place) => Some(*place),
            _ => None,
        };
        let mut needs: Vec<Place> = lemma.formula.origins.iter().filter_map(cut).collect();
        match lemma.rule {
            Rule::Sum => {}
            Rule::Unit { vector, .. } => needs.extend(vector),
            Rule::Quotient { divisor, .. } => {
                let fraction = self.quotient(lemma.place);
                needs.extend(fraction.and_then(|fraction| fraction.numerator));
                if let Some(both) = self.quotients(lemma.place) {
                    needs.extend(both.parts.into_iter().chain(both.rest));
                }
                needs.push(divisor);
            }
        }
        needs
            .into_iter()
            .map(|place| unsigned(self.path, place))
            .collect()
    }

    /// The pairs of inputs that what a number is made of divides, or compares to find the direction's largest
    /// coordinate: by the decisions of the path the first is at most as large as the second. A proof of the number
    /// supposes these and no other decisions.
    pub fn orders(&self, place: Place) -> BTreeSet<(u8, u8)> {
        let places = parts(&self.path.operations, place);
        let mut orders = BTreeSet::new();
        for fraction in places.into_iter().filter_map(|place| self.quotient(place)) {
            let Operation::Input(d) = self.operation(fraction.divisor) else {
                continue;
            };
            if let Some(Operation::Input(n)) = fraction.numerator.map(|n| self.operation(n)) {
                orders.insert((n, d));
            }
            if self.is_largest_of_direction(fraction.divisor) {
                orders.extend((3..6).map(|axis| (axis, d)));
            }
        }
        orders.retain(|(a, b)| a != b && is_at_most(self.path, *a, *b));
        orders
    }
}
