//! The meaning of the signs of a guarded kernel's numbers for the ray and the triangle.
//!
//! Each number is known by its value modulo a prime at inputs that depend on the whole program: polynomials of small degree and
//! small coefficients that agree there are equal, but for a chance below 2^-200. The known ones are, with N = (b-a)×(c-a),
//! the scalar triple products U, V, W of d with two vertices, their sums, D = d·N = -(U+V+W), T = N·(a-o), T - t_min·D
//! and t_max·D - T, each times powers of D, of N·N, and of one coordinate of N and of d. Then every combination of
//! signs that can occur is tried.

use super::points::{COUNT, FAR, Factors, NEAR, POINTS, PRIME, Point, SUM, T, U, UV, V, VW, W, WU};
use super::points::{inverse, is_small, product, products, seed, times, value};
use super::program::{Operation, Program};
use super::reader::{Outcome, ensure};
use std::cell::RefCell;
use std::collections::{BTreeSet, HashMap};

/// More signs inside absolute values are not tried.
const MOST_SIZED: usize = 8;

/// A condition: the signs of `signs` have a product that is negative, or not, and no number is zero.
#[derive(Clone, Debug)]
pub struct Literal {
    pub is_negative: bool,
    pub signs: Vec<usize>,
    pub nonzero: Vec<usize>,
}

impl Literal {
    pub fn negated(&self) -> Literal {
        Literal {
            is_negative: !self.is_negative,
            ..self.clone()
        }
    }

    fn places(&self) -> impl Iterator<Item = usize> {
        self.signs.iter().chain(&self.nonzero).copied()
    }
}

/// The part of the line and the side that count.
pub struct Promise {
    pub extent: String,
    pub is_front: bool,
}

impl Promise {
    /// True if the triangle with its edges may be hit between the ends, these included.
    fn is_closed_hit(&self, signs: &[i8; COUNT]) -> bool {
        let weights = &signs[U..=W];
        let is_one_sided = weights.iter().all(|x| *x >= 0) || weights.iter().all(|x| *x <= 0);
        let after = |number: usize| signs[number] * -signs[SUM] >= 0;
        let is_between = match self.extent.as_str() {
            "ray" => after(T),
            "interval" => after(NEAR) && after(FAR),
            _ => true,
        };
        let is_of_side = !self.is_front || signs[SUM] > 0;
        signs[SUM] != 0 && is_one_sided && is_between && is_of_side
    }

    /// The reason why a hit of rays with these signs is wrong; none if it is inside the triangle, between the ends and on
    /// a side that counts.
    fn wrong_hit(&self, signs: &[i8; COUNT]) -> Option<&'static str> {
        let is_inside = signs[U] != 0 && signs[U] == signs[V] && signs[V] == signs[W];
        if !is_inside {
            return Some("do not pass through the inside of the triangle");
        }
        if self.is_front && signs[SUM] < 0 {
            return Some("hit the back, and it promises the front only");
        }
        let after = |number: usize| signs[number] * -signs[SUM];
        match self.extent.as_str() {
            "ray" if after(T) <= 0 => Some("meet the triangle at t <= 0"),
            "interval" if after(NEAR) <= 0 => Some("meet the triangle at t <= t_min"),
            "interval" if after(FAR) <= 0 => Some("meet the triangle at t >= t_max"),
            _ => None,
        }
    }
}

/// A number's sign: that of the product of some known ones, or its opposite.
#[derive(Clone, Debug)]
struct Monomial {
    is_negative: bool,
    odd: Vec<usize>,
    /// Those of which an even power is in it.
    even: Vec<usize>,
}

impl Monomial {
    fn sign(&self, signs: &[i8; COUNT]) -> i8 {
        let odd: i8 = self.odd.iter().map(|known| signs[*known]).product();
        let even: i8 = self.even.iter().map(|known| signs[*known].abs()).product();
        if self.is_negative {
            -odd * even
        } else {
            odd * even
        }
    }
}

/// The signs that can occur together.
pub struct Signs {
    promise: Promise,
    points: Vec<Point>,
    products: HashMap<u64, Vec<Factors>>,
    /// The names of the axes under which all of it is to hold.
    pub axes: Vec<[usize; 3]>,
    /// The numbers that are known so far.
    known: RefCell<HashMap<Asked, Option<Monomial>>>,
}

/// A number, the signs inside absolute values, and the names of the axes.
type Asked = (usize, Inner, [usize; 3]);

/// The signs of the numbers inside absolute values.
type Inner = Vec<(usize, bool)>;

impl Signs {
    pub fn new(promise: Promise, program: &Program) -> Signs {
        let seed = seed(program);
        let points: Vec<Point> = (1..=POINTS as u64)
            .map(|i| Point::new(seed.wrapping_add(i << 32)))
            .collect();
        let (products, known) = (products(&points), RefCell::default());
        Signs {
            promise,
            points,
            products,
            axes: vec![],
            known,
        }
    }

    /// An error if these conditions hold for some ray that should hit.
    pub fn ensure_miss(&self, program: &Program, known: &[Literal]) -> Outcome<()> {
        self.every(program, known, &[], |signs| {
            ensure(
                !self.promise.is_closed_hit(signs),
                "rejects rays that may hit",
            )
        })
    }

    /// An error if every gate accepts some ray that does not surely hit the inside of the triangle.
    pub fn ensure_hit(
        &self,
        program: &Program,
        sure: &[Literal],
        gates: &[Vec<Vec<Literal>>],
    ) -> Outcome<()> {
        self.every(program, sure, gates, |signs| {
            match self.promise.wrong_hit(signs) {
                Some(what) => Err(format!("its gates accept rays that {what}")),
                None => Ok(()),
            }
        })
    }

    /// Tries every combination of signs under which the conditions hold, and a pattern of each gate.
    fn every(
        &self,
        program: &Program,
        known: &[Literal],
        gates: &[Vec<Vec<Literal>>],
        test: impl Fn(&[i8; COUNT]) -> Outcome<()>,
    ) -> Outcome<()> {
        let of_gates = gates.iter().flatten().flatten();
        let places: BTreeSet<usize> = known
            .iter()
            .chain(of_gates)
            .flat_map(Literal::places)
            .collect();
        let mut sized = BTreeSet::new();
        places
            .iter()
            .for_each(|place| inner(program, *place, &mut sized));
        ensure(
            sized.len() <= MOST_SIZED,
            format!("needs the signs of more than {MOST_SIZED} numbers inside absolute values"),
        )?;
        for axes in &self.axes {
            for bits in 0..1_u32 << sized.len() {
                let inner: Inner = (0..)
                    .zip(&sized)
                    .map(|(i, place)| (*place, bits >> i & 1 == 1))
                    .collect();
                let all = places.iter().chain(&sized);
                let monomial = |place: &usize| {
                    let key = (*place, inner.clone(), *axes);
                    let mut known = self.known.borrow_mut();
                    let found = known
                        .entry(key)
                        .or_insert_with(|| self.monomial(program, *place, &inner, axes));
                    Some((*place, found.clone()?))
                };
                let monomials: Vec<(usize, Monomial)> = all.filter_map(monomial).collect();
                self.with_signs(&monomials, &inner, known, gates, &test)?;
            }
        }
        Ok(())
    }

    fn with_signs(
        &self,
        monomials: &[(usize, Monomial)],
        inner: &Inner,
        known: &[Literal],
        gates: &[Vec<Vec<Literal>>],
        test: &impl Fn(&[i8; COUNT]) -> Outcome<()>,
    ) -> Outcome<()> {
        let mut used: BTreeSet<usize> = monomials
            .iter()
            .flat_map(|(_, it)| it.odd.iter().chain(&it.even))
            .copied()
            .collect();
        used.extend(U..=SUM);
        match self.promise.extent.as_str() {
            "ray" => used.extend([T]),
            "interval" => used.extend([NEAR, FAR]),
            _ => {}
        }
        let used: Vec<usize> = used.into_iter().collect();
        let is_interval = self.promise.extent == "interval";
        let mut signs = [-1; COUNT];
        loop {
            // Of a number that is none of the known ones nothing is known.
            let sign = |place: usize| {
                let found = monomials.iter().find(|(other, _)| *other == place);
                found.map(|(_, monomial)| monomial.sign(&signs))
            };
            let may_hold = |literal: &Literal| {
                let of_signs: Option<Vec<i8>> = literal.signs.iter().map(|it| sign(*it)).collect();
                let right = if literal.is_negative { -1 } else { 1 };
                let is_nonzero = literal.nonzero.iter().all(|place| sign(*place) != Some(0));
                is_nonzero && of_signs.is_none_or(|signs| signs.iter().product::<i8>() == right)
            };
            let is_assumed = |(place, is_negative): &(usize, bool)| {
                sign(*place).is_none_or(|sign| if *is_negative { sign <= 0 } else { sign >= 0 })
            };
            let accepts = |patterns: &Vec<Vec<Literal>>| {
                patterns.iter().any(|pattern| pattern.iter().all(may_hold))
            };
            if can_be(&signs, is_interval)
                && inner.iter().all(is_assumed)
                && known.iter().all(may_hold)
                && gates.iter().all(accepts)
            {
                test(&signs)?;
            }
            // The next combination.
            let Some(next) = used.iter().find(|number| signs[**number] < 1) else {
                return Ok(());
            };
            used.iter()
                .take_while(|number| *number != next)
                .for_each(|number| signs[*number] = -1);
            signs[*next] += 1;
        }
    }

    /// A number's sign; none if it is none of the known numbers.
    fn monomial(
        &self,
        program: &Program,
        place: usize,
        inner: &Inner,
        axes: &[usize; 3],
    ) -> Option<Monomial> {
        if !is_small(program, place) {
            return None;
        }
        let values: Vec<u64> = self
            .points
            .iter()
            .map(|point| value(program, place, point, inner, axes))
            .collect();
        let alike = self.products.get(&times(values[1], inverse(values[0])));
        alike.into_iter().flatten().find_map(|factors| {
            let is_negative = self.ratio(&values, |point| product(factors, point))?;
            let of_parity = |parity: u64| {
                let all = factors
                    .iter()
                    .filter(|(_, power)| *power > 0 && power % 2 == parity);
                all.map(|(known, _)| *known)
                    .filter(|known| *known < COUNT)
                    .collect()
            };
            Some(Monomial {
                is_negative,
                odd: of_parity(1),
                even: of_parity(0),
            })
        })
    }

    /// True if the values are one negative number times the product, false if a positive one; none if neither.
    fn ratio(&self, values: &[u64], product: impl Fn(&Point) -> u64) -> Option<bool> {
        let first = product(&self.points[0]);
        let is_same = |(value, point): (&u64, &Point)| {
            times(*value, first) == times(values[0], product(point))
        };
        if !values.iter().zip(&self.points).skip(1).all(is_same) {
            return None;
        }
        let ratio = times(values[0], inverse(first));
        let is_whole = |x: u64| [x, inverse(x)].iter().any(|x| (1..=64).contains(x));
        match ratio {
            0 => None,
            x if is_whole(x) => Some(false),
            x if is_whole(PRIME - x) => Some(true),
            _ => None,
        }
    }
}

/// Adds the numbers inside absolute values in a number.
fn inner(program: &Program, place: usize, found: &mut BTreeSet<usize>) {
    let (mut open, mut seen) = (vec![place], BTreeSet::new());
    while let Some(place) = open.pop() {
        seen.insert(place);
        let Operation { name, operands, .. } = &program.operations[place];
        found.extend(operands.iter().filter(|_| *name == "abs"));
        open.extend(operands.iter().filter(|operand| !seen.contains(operand)));
    }
}

/// True if numbers can have these signs together: sums of two of one sign have it too, and the two numbers of an
/// interval that is not empty add up to its length times D.
fn can_be(signs: &[i8; COUNT], is_interval: bool) -> bool {
    let is_sum = |a: usize, b: usize, sum: usize| {
        let (a, b, sum) = (signs[a], signs[b], signs[sum]);
        a * b < 0 || sum == if a == 0 { b } else { a }
    };
    let both = signs[NEAR] + signs[FAR];
    let is_possible = !is_interval || both == 0 || both.signum() == -signs[SUM];
    let pairs = is_sum(U, V, UV) && is_sum(V, W, VW) && is_sum(W, U, WU);
    is_possible && pairs && is_sum(UV, W, SUM) && is_sum(VW, U, SUM) && is_sum(WU, V, SUM)
}

#[cfg(test)]
mod tests;
