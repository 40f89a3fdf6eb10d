//! All corners of a formula's box: the largest size of each step, and the largest sum of the effects of all
//! rounding errors.
//!
//! The coordinates of a unit vector n are in no box. A formula that is linear in n is taken, at each corner of
//! the other variables, where n is the first, the second and the third axis. By Cauchy and Schwarz a step that
//! is linear in n is at most the root of the sum of the squares there. So are the effects of errors, each sum
//! of them being at most Σ|n_i| times that sum at axis i.

use super::bound::SIZE_DIGITS;
use super::dyadic::{Big, root_up};
use super::formula::{DIGITS, Formula, Maximum, Step};
use super::walk::Walk;
use super::{Dyadic, Format};
use num_traits::Zero;
use std::ops::Add;

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
        let largest = self.largest(format, tried <= MOST_TO_CHOOSE);
        largest.ok_or_else(|| "its bound needs more digits than there are".to_owned())
    }

    /// The maximum; none if a number is too long.
    fn largest(&mut self, format: Format, may_choose: bool) -> Option<Maximum> {
        let sizes = self.corner_sizes();
        if !sizes.iter().all(|size| size.is_number()) {
            return None;
        }
        self.bounds = self.higher_order(format, Some(&sizes)).1;
        let first = if self.unit.is_empty() {
            self.first_in_box(format, may_choose && self.below.is_none())
        } else {
            self.first_of_unit(format)?
        };
        let rest = self.higher_order(format, None).0;
        if !first.sum.is_number() || !rest.is_number() {
            return None;
        }
        let mut corner = Vec::new();
        for v in 0..self.variables.len() {
            corner.push(first.corner >> v & 1 == 1);
        }
        Some(Maximum {
            first: first.sum,
            rest,
            corner,
        })
    }

    /// The largest first order, and the first corner that has it.
    fn first_in_box(&mut self, format: Format, may_choose: bool) -> First {
        let mut choices: Vec<usize> = (0..self.steps.len()).collect();
        choices.retain(|i| self.rounds[*i]);
        if !may_choose || choices.len() < 2 {
            choices.clear();
        }
        let all = self.effects(&choices, format);
        let mut chosen = vec![0; choices.len()];
        let mut first = largest(&all, &chosen);
        for (k, step) in choices.iter().enumerate().rev() {
            let least = first.sum(&chosen);
            chosen[k] = 1;
            // Where that is no less at the corner that counts, it is no less.
            if first.sum(&chosen) < least {
                let tried = largest(&all, &chosen);
                if tried.sum(&chosen) < least {
                    first = tried;
                    self.relative[*step] = true;
                    continue;
                }
            }
            chosen[k] = 0;
        }
        First {
            sum: first.sum(&chosen),
            corner: first.corner,
        }
    }

    /// The effects of the steps at every corner, of some of them by either bound of their errors.
    fn effects(&self, choices: &[usize], format: Format) -> Vec<Effects> {
        let mut walk = Walk::new(self);
        let mut all = Vec::new();
        for corner in self.corners() {
            walk.evaluate(corner, 0);
            walk.differentiate();
            let mut here = Effects {
                corner,
                either: vec![],
                others: Dyadic::ZERO,
            };
            for (i, bound) in self.bounds.iter().enumerate() {
                let slope = walk.slopes[i].abs();
                let by_size = slope * bound.error;
                if choices.contains(&i) {
                    let in_proportion = slope * walk.values[i].abs() * format.unit();
                    here.either.push([by_size, in_proportion]);
                } else {
                    here.others = here.others.plus_up(by_size);
                }
            }
            all.push(here);
        }
        all
    }

    /// The largest first order of a formula that is linear in a unit vector; none if a number is too long.
    fn first_of_unit(&mut self, format: Format) -> Option<First> {
        let linear = self.linear_steps()?;
        self.choose_by_squares(&linear, format);
        let mut alone = Dyadic::ZERO;
        let mut squares = Big::zero();
        let mut near = 0.0;
        let mut first = 0;
        let mut is_short = true;
        self.each_corner(|corner, axes| {
            let here = self.effects_at(axes, &linear, format);
            alone = alone.max(here.alone);
            is_short &= here.alone.is_number();
            is_short &= here.axes.iter().all(|sum| sum.is_number());
            let found: f64 = here.axes.iter().copied().map(square).sum();
            if is_short && near * (1.0 - 1e-9) <= found {
                let mut exact = Big::zero();
                for sum in here.axes {
                    exact += Big::from(sum) * Big::from(sum);
                }
                if squares < exact {
                    squares = exact;
                    near = found;
                    first = corner;
                }
            }
        });
        // The vector's own error, in the place of the vector.
        let part = (0..self.steps.len()).find(|i| self.is_part(*i))?;
        let own = self.bounds[part].error * self.bounds.last()?.size;
        is_short.then(|| First {
            sum: alone + root_up(&squares, DIGITS) + own,
            corner: first,
        })
    }

    /// Chooses, for each step that rounds, the bound of its error that makes the largest squares of its effects smaller.
    fn choose_by_squares(&mut self, linear: &[bool], format: Format) {
        let mut by_size = vec![0f64; linear.len()];
        let mut in_proportion = by_size.clone();
        self.each_corner(|_, axes| {
            for (i, bound) in self.bounds.iter().enumerate() {
                let mut fixed = 0.0;
                let mut relative = 0.0;
                for (axis, walk) in axes.iter().enumerate() {
                    let slope = walk.slopes[i];
                    // Of what is linear, the bound of its error is one of the whole vector.
                    if !linear[i] || axis == 0 {
                        fixed += square(slope * bound.error);
                    }
                    relative += square(slope * walk.values[i] * format.unit());
                }
                by_size[i] = by_size[i].max(fixed);
                in_proportion[i] = in_proportion[i].max(relative);
            }
        });
        for i in 0..linear.len() {
            self.relative[i] = self.rounds[i] && in_proportion[i] < by_size[i];
        }
    }

    /// The sums of effects at a corner.
    fn effects_at(&self, axes: &[Walk], linear: &[bool], format: Format) -> OfUnit {
        let mut effects = OfUnit {
            alone: Dyadic::ZERO,
            axes: vec![Dyadic::ZERO; axes.len()],
        };
        for (i, bound) in self.bounds.iter().enumerate() {
            if self.is_part(i) {
                continue;
            }
            if linear[i] && !self.relative[i] {
                let slope = axes[0].slopes[i].abs();
                effects.alone = effects.alone + slope * bound.error;
                continue;
            }
            for (walk, sum) in axes.iter().zip(&mut effects.axes) {
                let slope = walk.slopes[i].abs();
                let error = if self.relative[i] {
                    walk.values[i].abs() * format.unit()
                } else {
                    bound.error
                };
                *sum = *sum + slope * error;
            }
        }
        effects
    }

    /// Visits the corners, with all steps where the unit vector is each of the axes.
    fn each_corner(&self, mut visit: impl FnMut(u64, &[Walk])) {
        let mut axes = vec![Walk::new(self); self.unit.len()];
        for corner in self.corners() {
            for (axis, walk) in axes.iter_mut().enumerate() {
                walk.evaluate(corner, axis);
                walk.differentiate();
            }
            visit(corner, &axes);
        }
    }

    /// The corners that are enough, as bits, set where a variable is at its negative end; in the order of counting.
    fn corners(&self) -> impl Iterator<Item = u64> + use<> {
        let tried = self.signs_to_try();
        let next =
            move |corner: &u64| Some(corner.wrapping_sub(tried) & tried).filter(|next| *next != 0);
        std::iter::successors(Some(0), next)
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
            let mut degrees = Vec::new();
            for (_, a, b) in step.terms() {
                let of_second = b.is_some_and(|b| linear[b]);
                degrees.push(u8::from(linear[a]) + u8::from(of_second));
            }
            let own = u8::from(self.is_part(i));
            let first = *degrees.first().unwrap_or(&own);
            if 1 < first || degrees.iter().any(|degree| *degree != first) {
                return None;
            }
            linear.push(first == 1);
        }
        let is_last_linear = *linear.last()?;
        is_last_linear.then_some(linear)
    }

    /// The largest size of each step at the corners, which is its largest size in the box.
    fn corner_sizes(&self) -> Vec<Dyadic> {
        let linear = self.linear_steps().filter(|_| !self.unit.is_empty());
        let linear = linear.unwrap_or(vec![false; self.steps.len()]);
        let mut sizes = vec![Dyadic::ZERO; self.steps.len()];
        let mut axes = vec![Walk::new(self); self.unit.len().max(1)];
        for corner in self.corners() {
            for (axis, walk) in axes.iter_mut().enumerate() {
                walk.evaluate(corner, axis);
            }
            for (i, size) in sizes.iter_mut().enumerate() {
                let mut here = axes[0].values[i].abs();
                if linear[i] {
                    let squares = axes.iter().map(|walk| walk.values[i] * walk.values[i]);
                    here = squares.fold(Dyadic::ZERO, Dyadic::add);
                }
                *size = (*size).max(here);
            }
        }
        for (size, is_linear) in sizes.iter_mut().zip(linear) {
            if is_linear && size.is_number() {
                *size = root_up(&Big::from(*size), SIZE_DIGITS);
            }
        }
        sizes
    }
}

/// The first order at its largest, and the first corner where it is.
struct First {
    sum: Dyadic,
    corner: u64,
}

/// The effects of all errors at a corner.
struct Effects {
    corner: u64,
    /// The effects of the steps that have a choice, by each bound of their errors.
    either: Vec<[Dyadic; 2]>,
    /// The sum of all others.
    others: Dyadic,
}

impl Effects {
    fn sum(&self, chosen: &[usize]) -> Dyadic {
        let mut sum = self.others;
        for (both, choice) in self.either.iter().zip(chosen) {
            sum = sum.plus_up(both[*choice]);
        }
        sum
    }
}

/// The first corner with the largest sum.
fn largest<'e>(all: &'e [Effects], chosen: &[usize]) -> &'e Effects {
    // Of equal ones the last is taken.
    let backwards = all.iter().rev();
    let largest = backwards.max_by_key(|effects| effects.sum(chosen));
    largest.expect("a corner")
}

/// The square of an effect, roughly.
fn square(x: Dyadic) -> f64 {
    x.to_f64().powi(2)
}

/// The effects of all errors at a corner of a formula with a unit vector.
struct OfUnit {
    /// The sum of those that do not depend on the vector.
    alone: Dyadic,
    /// The sum of those that do, axis by axis.
    axes: Vec<Dyadic>,
}
