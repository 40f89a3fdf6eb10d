//! The meaning of the signs of a guarded kernel's numbers for the ray and the triangle.
//!
//! Each number is known by its value modulo a prime at inputs that depend on the whole program: polynomials of small degree and
//! small coefficients that agree there are equal, but for a chance below 2^-200. The known ones are, with N = (b-a)×(c-a),
//! the scalar triple products U, V, W of d with two vertices, their sums, D = d·N = -(U+V+W), T = N·(a-o), T - t_min·D
//! and t_max·D - T, each times powers of D, of N·N, and of one coordinate of N and of d. Then every combination of
//! signs that can occur is tried.

use super::modular::{inverse, negative, times};
use super::points::{
    Assumed, COUNT, Case, Factors, KnownSigns, POINTS, Point, Power, SQUARE, SUM, U, is_small,
    product, products, seed,
};
use super::program::Program;
use super::promise::Promise;
use super::reader::{Outcome, ensure};
use std::cell::RefCell;
use std::collections::{BTreeSet, HashMap};

/// More signs inside absolute values are not tried.
const MOST_SIZED: usize = 8;

/// A condition: the signs of `signs` have a product that is negative, or not, and no number is zero.
#[derive(Clone)]
pub struct Literal {
    pub is_negative: bool,
    pub signs: Vec<usize>,
    pub nonzero: Vec<usize>,
}

/// Conditions that hold together.
pub type Pattern = Vec<Literal>;

/// The patterns with which a gate accepts.
pub type Gate = Vec<Pattern>;

impl Literal {
    pub fn negated(&self) -> Literal {
        Literal {
            is_negative: !self.is_negative,
            ..self.clone()
        }
    }
}

/// A number's sign: that of the product of some known ones, or its opposite.
#[derive(Clone)]
struct Monomial {
    is_negative: bool,
    odd: Vec<usize>,
    /// The numbers of which an even power is in it.
    even: Vec<usize>,
}

impl Monomial {
    /// The monomial of a product of known numbers. N·N is positive, so it counts for nothing.
    fn of(factors: &[Power], is_negative: bool) -> Monomial {
        let mut monomial = Monomial {
            is_negative,
            odd: vec![],
            even: vec![],
        };
        for factor in factors {
            let is_odd = factor.exponent % 2 == 1;
            if factor.known == SQUARE {
                continue;
            } else if is_odd {
                monomial.odd.push(factor.known);
            } else {
                monomial.even.push(factor.known);
            }
        }
        monomial
    }

    fn sign(&self, signs: &KnownSigns) -> i8 {
        let mut sign = if self.is_negative { -1 } else { 1 };
        for known in &self.odd {
            sign *= signs[*known];
        }
        for known in &self.even {
            sign *= signs[*known].abs();
        }
        sign
    }
}

/// The signs of operations that are made of known numbers.
type Monomials = HashMap<usize, Monomial>;

/// The conditions of an answer: all literals hold, and a pattern of each gate.
struct Conditions<'c> {
    known: &'c [Literal],
    gates: &'c [Gate],
}

impl Conditions<'_> {
    /// The numbers whose signs they use.
    fn places(&self) -> BTreeSet<usize> {
        let of_gates = self.gates.iter().flatten().flatten();
        let mut places = BTreeSet::new();
        for literal in self.known.iter().chain(of_gates) {
            places.extend(&literal.signs);
            places.extend(&literal.nonzero);
        }
        places
    }
}

/// The signs that can occur together.
pub struct Signs<'p> {
    program: &'p Program,
    promise: Promise,
    points: Vec<Point>,
    products: HashMap<u64, Vec<Factors>>,
    /// The names of the axes under which all of it is to hold.
    pub axes: Vec<[usize; 3]>,
    /// The numbers that are known so far.
    known: RefCell<HashMap<Asked, Option<Monomial>>>,
}

/// A number in a case.
#[derive(PartialEq, Eq, Hash)]
struct Asked {
    place: usize,
    case: Case,
}

/// The known numbers of a case, with one combination of their signs.
struct Combination<'m> {
    monomials: &'m Monomials,
    signs: KnownSigns,
}

impl Combination<'_> {
    /// The sign of an operation; none if it is none of the known numbers, so that nothing is known of it.
    fn sign(&self, place: usize) -> Option<i8> {
        let monomial = self.monomials.get(&place)?;
        Some(monomial.sign(&self.signs))
    }

    fn may_meet(&self, conditions: &Conditions) -> bool {
        let may_hold = self.may_hold_all(conditions.known);
        may_hold && conditions.gates.iter().all(|gate| self.may_pass(gate))
    }

    fn may_pass(&self, gate: &[Pattern]) -> bool {
        gate.iter().any(|pattern| self.may_hold_all(pattern))
    }

    fn may_hold_all(&self, pattern: &[Literal]) -> bool {
        pattern.iter().all(|literal| self.may_hold(literal))
    }

    fn may_hold(&self, literal: &Literal) -> bool {
        for place in &literal.nonzero {
            if self.sign(*place) == Some(0) {
                return false;
            }
        }
        let mut product = 1;
        for place in &literal.signs {
            match self.sign(*place) {
                Some(sign) => product *= sign,
                None => return true,
            }
        }
        let expected = if literal.is_negative { -1 } else { 1 };
        product == expected
    }

    fn may_be_all(&self, assumptions: &[Assumed]) -> bool {
        assumptions.iter().all(|assumed| self.may_be(assumed))
    }

    fn may_be(&self, assumed: &Assumed) -> bool {
        match self.sign(assumed.place) {
            Some(sign) if assumed.is_negative => sign <= 0,
            Some(sign) => sign >= 0,
            None => true,
        }
    }

    /// Goes on to the next combination of these numbers' signs; false after the last one.
    fn next(&mut self, used: &BTreeSet<usize>) -> bool {
        for number in used {
            let sign = &mut self.signs[*number];
            if *sign < 1 {
                *sign += 1;
                return true;
            }
            *sign = -1;
        }
        false
    }
}

impl<'p> Signs<'p> {
    pub fn new(promise: Promise, program: &'p Program) -> Signs<'p> {
        let seed = seed(program);
        let mut points = Vec::new();
        for i in 1..=POINTS as u64 {
            points.push(Point::new(seed.wrapping_add(i << 32)));
        }
        Signs {
            program,
            promise,
            products: products(&points),
            points,
            axes: vec![],
            known: RefCell::default(),
        }
    }

    /// An error if these conditions hold for some ray that should hit.
    pub fn ensure_miss(&self, known: &[Literal]) -> Outcome<()> {
        let conditions = Conditions { known, gates: &[] };
        self.every(&conditions, |signs| {
            ensure(
                !self.promise.is_closed_hit(signs),
                "rejects rays that may hit",
            )
        })
    }

    /// An error if every gate accepts some ray that does not surely hit the inside of the triangle.
    pub fn ensure_hit(&self, sure: &[Literal], gates: &[Gate]) -> Outcome<()> {
        let conditions = Conditions { known: sure, gates };
        self.every(&conditions, |signs| match self.promise.wrong_hit(signs) {
            Some(what) => Err(format!("its gates accept rays that {what}")),
            None => Ok(()),
        })
    }

    /// Tries every combination of signs under which the conditions hold, under all names of the axes and for all signs
    /// inside absolute values. So no ray that meets the conditions is left out.
    fn every(
        &self,
        conditions: &Conditions,
        test: impl Fn(&KnownSigns) -> Outcome<()>,
    ) -> Outcome<()> {
        let mut places = conditions.places();
        let sized = self.inner(&places);
        ensure(
            sized.len() <= MOST_SIZED,
            format!("needs the signs of more than {MOST_SIZED} numbers inside absolute values"),
        )?;
        places.extend(&sized);
        for axes in &self.axes {
            for bits in 0..1_u32 << sized.len() {
                let case = Case {
                    inner: assumed(&sized, bits),
                    axes: *axes,
                };
                let monomials = self.monomials(&places, &case);
                let used = self.used(&monomials);
                let mut combination = Combination {
                    monomials: &monomials,
                    signs: [-1; COUNT],
                };
                loop {
                    let occurs = self.promise.can_be(&combination.signs);
                    if occurs
                        && combination.may_be_all(&case.inner)
                        && combination.may_meet(conditions)
                    {
                        test(&combination.signs)?;
                    }
                    if !combination.next(&used) {
                        break;
                    }
                }
            }
        }
        Ok(())
    }

    /// The numbers inside absolute values of which some numbers are made.
    fn inner(&self, places: &BTreeSet<usize>) -> BTreeSet<usize> {
        let mut found = BTreeSet::new();
        let mut seen = BTreeSet::new();
        let mut open = Vec::from_iter(places.clone());
        while let Some(place) = open.pop() {
            if !seen.insert(place) {
                continue;
            }
            let operands = self.program.operands(place);
            if self.program.name(place) == "abs" {
                found.extend(operands);
            }
            open.extend(operands);
        }
        found
    }

    /// The known numbers among some operations.
    fn monomials(&self, places: &BTreeSet<usize>, case: &Case) -> Monomials {
        let mut monomials = Monomials::new();
        for place in places {
            if let Some(monomial) = self.known_monomial(*place, case) {
                monomials.insert(*place, monomial);
            }
        }
        monomials
    }

    /// The numbers whose signs are tried: those of the promise, and those of which operations are made.
    fn used(&self, monomials: &Monomials) -> BTreeSet<usize> {
        let mut used = BTreeSet::from_iter(U..=SUM);
        for end in self.promise.ends {
            used.insert(end.number);
        }
        for monomial in monomials.values() {
            used.extend(&monomial.odd);
            used.extend(&monomial.even);
        }
        used
    }

    /// A number's sign, which is found once.
    fn known_monomial(&self, place: usize, case: &Case) -> Option<Monomial> {
        let asked = Asked {
            place,
            case: case.clone(),
        };
        let mut known = self.known.borrow_mut();
        let entry = known.entry(asked);
        let found = entry.or_insert_with(|| self.monomial(place, case));
        found.clone()
    }

    /// A number's sign; none if it is none of the known numbers.
    ///
    /// Two polynomials of small degree and small coefficients that agree at all points are equal, but for a chance below
    /// 2^-200, because the points depend on the whole program.
    fn monomial(&self, place: usize, case: &Case) -> Option<Monomial> {
        if !is_small(self.program, place) {
            return None;
        }
        let mut values = Vec::new();
        for point in &self.points {
            values.push(case.value(self.program, place, point));
        }
        let ratio = times(values[1], inverse(values[0]));
        for factors in self.products.get(&ratio)? {
            if let Some(is_negative) = self.ratio(&values, factors) {
                return Some(Monomial::of(factors, is_negative));
            }
        }
        None
    }

    /// True if the values are one negative number times the product, false if a positive one; none if neither.
    fn ratio(&self, values: &[u64], factors: &[Power]) -> Option<bool> {
        let first = product(factors, &self.points[0]);
        for (value, point) in values.iter().zip(&self.points) {
            let here = product(factors, point);
            if times(*value, first) != times(values[0], here) {
                return None;
            }
        }
        let ratio = times(values[0], inverse(first));
        if is_small_ratio(ratio) {
            Some(false)
        } else if is_small_ratio(negative(ratio)) {
            Some(true)
        } else {
            None
        }
    }
}

/// True if it is a whole number up to 64, or the inverse of one.
fn is_small_ratio(x: u64) -> bool {
    let small = 1..=64;
    small.contains(&x) || small.contains(&inverse(x))
}

/// The signs that a combination's bits say of the numbers inside absolute values.
fn assumed(sized: &BTreeSet<usize>, bits: u32) -> Vec<Assumed> {
    let mut all = Vec::new();
    for (i, place) in sized.iter().enumerate() {
        all.push(Assumed {
            place: *place,
            is_negative: bits >> i & 1 == 1,
        });
    }
    all
}

#[cfg(test)]
mod tests;
