//! All corners of a formula's box: the largest size of each step, and the largest sum of the effects of all
//! rounding errors.
//!
//! The coordinates of a unit vector n are in no box. A formula that is linear in n is taken, at each corner of
//! the other variables, where n is the first, the second and the third axis. By Cauchy and Schwarz a step that
//! is linear in n is at most the root of the sum of the squares there. So are the effects of errors, each sum
//! of them being at most Σ|n_i| times that sum at axis i.
//!
//! A *mirror* is a set of variables whose change of sign keeps each step or changes its sign. Then each slope keeps its
//! size too, and so do all effects of errors: of corners that a mirror joins, one is enough. In d·(e1×e2), for instance,
//! the signs of d, of e1, of e2 and of all x and all y are free: 16 corners of 512 are left.
//!
//! A step's sign depends on a set of variables: it changes with an odd number of them. A product's set is the symmetric
//! difference of its factors' sets. Terms that are added up must have one set: for mirrors, the difference of two of them
//! is an equation modulo 2. A zero has no sign, is computed as 0 and demands nothing.

use super::bound::SIZE_DIGITS;
use super::dyadic::{Big, root_up};
use super::formula::{DIGITS, Formula, Maximum, Step};
use super::{Dyadic, Format};
use crate::arith::recorded::{Operation, Term};
use num_traits::Zero;

/// A formula of more variables has no bound.
const MOST_VARIABLES: usize = 32;
/// More signs than this are too many corners.
const MOST_SIGNS: u32 = 20;
/// More signs than this are too many corners to try both bounds of each step's error.
const MOST_TO_CHOOSE: u32 = 12;

impl Formula {
    /// The maximum over all corners, or in one sentence why there is none. Chooses, step by step, the bound
    /// of its error that makes the maximum smaller.
    pub fn maximum(&mut self, format: Format) -> Result<Maximum, String> {
        let count = self.variables.len();
        if count > MOST_VARIABLES {
            return Err(format!(
                "its formula has more than {MOST_VARIABLES} variables"
            ));
        }
        let tried = self.signs_to_try().count_ones();
        if tried > MOST_SIGNS {
            return Err(format!(
                "its formula has variables of {tried} signs, and {MOST_SIGNS} can be tried"
            ));
        }
        let too_long = || "its bound needs more digits than there are".to_owned();
        let sizes = self.corner_sizes();
        if sizes.iter().any(|size| !size.is_number()) {
            return Err(too_long());
        }
        self.bounds = self.higher_order(format, Some(&sizes)).1;
        let (first, at) = if self.unit.is_empty() {
            self.first_in_box(format, tried <= MOST_TO_CHOOSE && self.below.is_none())
        } else {
            self.first_of_unit(format).ok_or_else(too_long)?
        };
        let corner = (0..count).map(|v| at >> v & 1 == 1).collect();
        let rest = self.higher_order(format, None).0;
        if first.is_number() && rest.is_number() {
            Ok(Maximum {
                first,
                rest,
                corner,
            })
        } else {
            Err(too_long())
        }
    }

    /// The largest first order, and the first corner that has it.
    fn first_in_box(&mut self, format: Format, may_choose: bool) -> (Dyadic, u64) {
        let mut walk = Walk::new(self);
        let rounds: Vec<usize> = (0..self.steps.len()).filter(|i| self.rounds[*i]).collect();
        let choices = if may_choose && 1 < rounds.len() {
            rounds
        } else {
            vec![]
        };
        // By corner, what the steps that round contribute either way; and what the others contribute.
        let mut effects: Vec<Vec<[Dyadic; 2]>> = Vec::new();
        let mut others = Vec::new();
        let corners: Vec<u64> = self.corners().collect();
        for corner in corners.iter().copied() {
            walk.evaluate(corner, 0);
            walk.differentiate();
            let effect = |i: usize| {
                let slope = walk.slopes[i].abs();
                [
                    slope * self.bounds[i].error,
                    slope * walk.values[i].abs() * format.unit(),
                ]
            };
            effects.push(choices.iter().map(|i| effect(*i)).collect());
            let is_other = |i: &usize| choices.is_empty() || !self.rounds[*i];
            let rest = (0..self.steps.len()).filter(is_other).map(|i| effect(i)[0]);
            others.push(rest.fold(Dyadic::ZERO, Dyadic::plus_up));
        }
        let mut chosen = vec![0; choices.len()];
        let sum = |at: usize, chosen: &[usize]| {
            let parts = effects[at].iter().zip(chosen).map(|(both, i)| both[*i]);
            parts.fold(others[at], Dyadic::plus_up)
        };
        let largest = |chosen: &[usize]| {
            let sums = (0..corners.len()).map(|at| (sum(at, chosen), at));
            // The first corner of the largest sum.
            sums.reduce(|a, b| if a.0 < b.0 { b } else { a })
                .expect("one corner")
        };
        let (mut first, mut at) = largest(&chosen);
        for k in (0..choices.len()).rev() {
            chosen[k] = 1;
            // Where that is no less at the corner that counts, it is no less.
            let tried = Some(&chosen).filter(|chosen| sum(at, chosen) < first);
            match tried
                .map(|chosen| largest(chosen))
                .filter(|tried| tried.0 < first)
            {
                Some(less) => {
                    (first, at) = less;
                    self.relative[choices[k]] = true;
                }
                None => chosen[k] = 0,
            }
        }
        (first, corners[at])
    }

    /// The same of a formula that is linear in a unit vector; none if a number is too long.
    fn first_of_unit(&mut self, format: Format) -> Option<(Dyadic, u64)> {
        let linear = self.linear_steps()?;
        // Of each step that rounds, the largest squares of its effects by either bound.
        let mut either = vec![[0.0f64; 2]; self.steps.len()];
        self.each_corner(|_, at_axes| {
            for (i, either) in either.iter_mut().enumerate() {
                // Of what is linear, the bound of its error is one of the whole vector.
                let effect = |(axis, pairs): (usize, &Vec<(Dyadic, Dyadic)>)| {
                    let (value, slope) = pairs[i];
                    let is_counted = !linear[i] || axis == 0;
                    let by_size = if is_counted {
                        slope * self.bounds[i].error
                    } else {
                        Dyadic::ZERO
                    };
                    [by_size, slope * value * format.unit()].map(|x| x.to_f64().powi(2))
                };
                let squares = at_axes.iter().enumerate().map(effect);
                let sum = squares.fold([0.0; 2], |[a, b], [c, d]| [a + c, b + d]);
                *either = [either[0].max(sum[0]), either[1].max(sum[1])];
            }
        });
        for (i, [by_size, in_proportion]) in either.into_iter().enumerate() {
            self.relative[i] = self.rounds[i] && in_proportion < by_size;
        }
        // What does not depend on the vector, and the squares of what does, axis by axis.
        let (mut alone, mut squares, mut near, mut at) = (Dyadic::ZERO, Big::zero(), 0.0, 0);
        let mut is_short = true;
        self.each_corner(|corner, at_axes| {
            let mut here = Dyadic::ZERO;
            let mut sums = vec![Dyadic::ZERO; at_axes.len()];
            for i in (0..self.steps.len()).filter(|i| !self.is_part(*i)) {
                for (axis, sum) in at_axes.iter().zip(&mut sums) {
                    let (value, slope) = axis[i];
                    match (self.relative[i], linear[i]) {
                        (true, _) => *sum = *sum + (slope * value).abs() * format.unit(),
                        (_, false) => *sum = *sum + slope.abs() * self.bounds[i].error,
                        _ => {}
                    }
                }
                if linear[i] && !self.relative[i] {
                    here = here + at_axes[0][i].1.abs() * self.bounds[i].error;
                }
            }
            alone = alone.max(here);
            is_short &= here.is_number() && sums.iter().all(|sum| sum.is_number());
            let found: f64 = sums.iter().map(|sum| sum.to_f64().powi(2)).sum();
            if is_short && near * (1.0 - 1e-9) <= found {
                let exact = |sum: &Dyadic| Big::from(*sum) * Big::from(*sum);
                let exact: Big = sums.iter().map(exact).sum();
                if squares < exact {
                    (squares, near, at) = (exact, found, corner);
                }
            }
        });
        // The vector's own error, in the place of the vector.
        let part = (0..self.steps.len()).find(|i| self.is_part(*i))?;
        let own = self.bounds[part].error * self.bounds.last()?.size;
        is_short.then(|| (alone + root_up(&squares, DIGITS) + own, at))
    }

    /// Visits the corners, with value and slope of each step, or each triple of them where the unit vector
    /// is an axis.
    fn each_corner(&self, mut visit: impl FnMut(u64, &[Vec<(Dyadic, Dyadic)>])) {
        let mut walk = Walk::new(self);
        let mut at_axes = vec![Vec::new(); self.unit.len().max(1)];
        for corner in self.corners() {
            for (axis, pairs) in at_axes.iter_mut().enumerate() {
                walk.evaluate(corner, axis);
                walk.differentiate();
                pairs.clear();
                pairs.extend(walk.values.iter().copied().zip(walk.slopes.iter().copied()));
            }
            visit(corner, &at_axes);
        }
    }

    /// The corners that are enough, as bits, set where a variable is at its negative end; in the order of counting.
    fn corners(&self) -> impl Iterator<Item = u64> + use<> {
        let tried = self.signs_to_try();
        let next =
            move |corner: &u64| Some(corner.wrapping_sub(tried) & tried).filter(|next| *next != 0);
        std::iter::successors(Some(0), next)
    }

    /// The variables whose signs have to be tried, as bits: the lowest one of each independent equation. Every corner
    /// is joined to one of them by a mirror, which is the first in the order of counting. Signs of unit vectors are
    /// not tried.
    pub(super) fn signs_to_try(&self) -> u64 {
        let unit = self.unit.iter().fold(0u64, |bits, v| bits | 1 << v);
        let mut signs: Vec<Option<u64>> = Vec::with_capacity(self.steps.len());
        let mut equations = Equations {
            unit,
            by_lowest: [0; 64],
        };
        // Its two ends are no mirror images.
        let fixed = self.below.map_or(0, |(v, _)| 1 << v);
        for step in &self.steps {
            let of = |i: usize| signs[i];
            let term = |(_, a, b): Term<usize>| Some(of(a)? ^ b.map_or(Some(0), of)?);
            signs.push(match *step {
                Step::Variables(ref sum) => {
                    equations.alike(sum.iter().map(|(v, _)| Some(1 << v & !fixed)))
                }
                Step::Of(Operation::Number(value)) => (value != 0).then_some(0),
                _ => equations.alike(step.terms().map(term)),
            });
        }
        let lowest = (0..64).filter(|v| equations.by_lowest[*v] != 0);
        lowest.fold(fixed, |bits, v| bits | 1 << v) & !unit
    }

    /// True if a step is a coordinate of the unit vector.
    fn is_part(&self, i: usize) -> bool {
        matches!(self.steps[i], Step::Variables(ref sum) if sum.iter().any(|(v, _)| self.unit.contains(v)))
    }

    /// Which steps are linear in the unit vector, all others being free of it; none if that is not so, or the
    /// last step is not linear.
    pub fn linear_steps(&self) -> Option<Vec<bool>> {
        let mut linear: Vec<bool> = Vec::with_capacity(self.steps.len());
        for (i, step) in self.steps.iter().enumerate() {
            let of = |i: usize| linear[i];
            if step.terms().any(|(_, a, b)| of(a) && b.is_some_and(of)) {
                return None;
            }
            let mut terms = step.terms().map(|(_, a, b)| of(a) || b.is_some_and(of));
            let first = terms.next().unwrap_or_else(|| self.is_part(i));
            linear.push(terms.all(|term| term == first).then_some(first)?);
        }
        linear.last().is_some_and(|last| *last).then_some(linear)
    }

    /// The largest size of each step at the corners, which is its largest size in the box.
    fn corner_sizes(&self) -> Vec<Dyadic> {
        let linear = self.linear_steps().filter(|_| !self.unit.is_empty());
        let linear = linear.unwrap_or(vec![false; self.steps.len()]);
        let mut sizes = vec![Dyadic::ZERO; self.steps.len()];
        let mut walk = Walk::new(self);
        for corner in self.corners() {
            let mut squares = vec![Dyadic::ZERO; self.unit.len().min(1) * sizes.len()];
            for axis in 0..self.unit.len().max(1) {
                walk.evaluate(corner, axis);
                for (square, value) in squares.iter_mut().zip(&walk.values) {
                    *square = *square + *value * *value;
                }
            }
            for (i, size) in sizes.iter_mut().enumerate() {
                *size = (*size).max(if linear[i] {
                    squares[i]
                } else {
                    walk.values[i].abs()
                });
            }
        }
        let root = |(size, linear): (Dyadic, bool)| {
            if linear && size.is_number() {
                root_up(&Big::from(size), SIZE_DIGITS)
            } else {
                size
            }
        };
        sizes.into_iter().zip(linear).map(root).collect()
    }
}

/// From corner to corner: the exact value of each step there, and the derivative of the result by each.
struct Walk<'a> {
    formula: &'a Formula,
    /// The terms of each step.
    terms: Vec<Vec<Term<usize>>>,
    /// The variables in each step, as bits.
    supports: Vec<u64>,
    values: Vec<Dyadic>,
    slopes: Vec<Dyadic>,
    /// The corner of the values, if there is one.
    at: Option<u64>,
}

impl Walk<'_> {
    fn new(formula: &Formula) -> Walk<'_> {
        let terms = formula
            .steps
            .iter()
            .map(|step| step.terms().collect())
            .collect();
        let zeros = vec![Dyadic::ZERO; formula.steps.len()];
        let (supports, values) = (formula.supports(), zeros.clone());
        Walk {
            formula,
            terms,
            supports,
            values,
            slopes: zeros,
            at: None,
        }
    }

    /// The values at a corner, the unit vector being an axis.
    fn evaluate(&mut self, corner: u64, axis: usize) {
        let Walk {
            formula,
            terms,
            supports,
            values,
            at,
            ..
        } = self;
        let Formula {
            steps,
            unit,
            variables,
            below,
            ..
        } = formula;
        let variable = |v: usize| {
            if unit.contains(&v) && unit[axis] != v {
                return Dyadic::ZERO;
            }
            match (corner >> v & 1 == 1, *below) {
                (true, Some((of, below))) if of == v => -below,
                (is_minus, _) => negative_if(is_minus, variables[v]),
            }
        };
        // A step without a changed variable stays as it was.
        let changed = at.map(|at| at ^ corner);
        *at = Some(corner).filter(|_| unit.is_empty());
        for (i, step) in steps.iter().enumerate() {
            if changed.is_some_and(|changed| supports[i] & changed == 0) {
                continue;
            }
            let term = |&(is_minus, a, b): &Term<usize>| {
                negative_if(is_minus, b.map_or(values[a], |b| values[a] * values[b]))
            };
            values[i] = match step {
                Step::Variables(sum) => sum.iter().fold(Dyadic::ZERO, |total, (v, sign)| {
                    total + negative_if(*sign < 0, variable(*v))
                }),
                Step::Of(Operation::Number(value)) => Dyadic::new((*value).into(), 0),
                _ => terms[i]
                    .iter()
                    .map(term)
                    .reduce(|a, b| a + b)
                    .expect("a term"),
            };
        }
    }

    /// The derivatives at the corner of the values.
    fn differentiate(&mut self) {
        let Walk {
            terms,
            values,
            slopes,
            ..
        } = self;
        slopes.fill(Dyadic::ZERO);
        *slopes.last_mut().expect("a step") = Dyadic::ONE;
        for (i, terms) in terms.iter().enumerate().rev() {
            let slope = slopes[i];
            if slope.is_zero() {
                continue;
            }
            let mut add = |to: usize, amount: Dyadic| slopes[to] = slopes[to] + amount;
            for &(is_minus, a, b) in terms {
                let slope = negative_if(is_minus, slope);
                add(a, b.map_or(slope, |b| slope * values[b]));
                b.into_iter().for_each(|b| add(b, slope * values[a]));
            }
        }
    }
}

fn negative_if(negative: bool, x: Dyadic) -> Dyadic {
    if negative { -x } else { x }
}

/// Independent equations modulo 2, each at its lowest variable, those of the unit vector coming first.
struct Equations {
    unit: u64,
    by_lowest: [u64; 64],
}

impl Equations {
    /// Demands that terms change their signs alike. Returns with which variables they do, if not all are zero.
    fn alike(&mut self, terms: impl IntoIterator<Item = Option<u64>>) -> Option<u64> {
        let mut terms = terms.into_iter().flatten();
        let first = terms.next()?;
        for term in terms {
            self.insert(term ^ first);
        }
        Some(first)
    }

    fn insert(&mut self, mut equation: u64) {
        while equation != 0 {
            let first = if equation & self.unit == 0 {
                equation
            } else {
                equation & self.unit
            };
            let known = &mut self.by_lowest[first.trailing_zeros() as usize];
            if *known == 0 {
                *known = equation;
                return;
            }
            equation ^= *known;
        }
    }
}
