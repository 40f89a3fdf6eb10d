//! A multi-affine formula with its rounding errors, and the largest sum of their effects.
//!
//! Let x be computed by sums and products in which no variable meets itself, each variable v_i in
//! [-m_i, m_i], each operation k with an absolute error δ_k in [-h_k, h_k]. Then the computed x is affine
//! in each v_i and in each δ_k, so
//!
//! ```text
//! computed x - exact x = Σ_k c_k(v) δ_k + terms of higher order in δ
//! ```
//!
//! and every c_k is affine in each v_i. So Σ_k |c_k(v)| h_k is convex in each v_i: its maximum over the
//! box lies at a corner, and there are finitely many. For each operation h_k may be replaced by u |r_k(v)|,
//! where r_k is its exact result: no variable is in both c_k and r_k, so c_k r_k is affine in each v_i too.
//! The terms of higher order are bounded by running the formula on sizes.

use super::dyadic::{Big, round_up};
use super::forms::Leaf;
use super::{Bound, Dyadic, Format};
use crate::arith::recorded::{Operation, Place, Term};
use num_traits::Zero;

/// One step of a formula; operands come earlier.
#[derive(Clone, Debug)]
pub enum Step {
    /// A sum of variables, each with a sign.
    Variables(Vec<(usize, i8)>),
    /// An operation on earlier steps: a small whole number, a sum, a difference, a product.
    Of(Operation<usize>),
}

/// Steps with the bounds of their rounding errors.
#[derive(Clone, Debug, Default)]
pub struct Formula {
    /// The steps in order; the last one is the result.
    pub steps: Vec<Step>,
    /// Where each step stands in the program; none of those that only a proof needs.
    pub places: Vec<Option<Place>>,
    /// The bounds that are known of a step from elsewhere: of inputs, numbers and variables with a lemma of their own.
    pub given: Vec<Option<Bound>>,
    /// Which steps round. Their errors may be bounded by u times their exact results.
    pub rounds: Vec<bool>,
    /// For each step, true if its error is bounded by u times its exact result.
    pub relative: Vec<bool>,
    /// The bound of each variable: m.
    pub variables: Vec<Dyadic>,
    /// The origin of each variable.
    pub origins: Vec<VariableOrigin>,
    /// The variables that are coordinates of one unit vector in which the formula is linear, if it has one.
    pub unit: Vec<usize>,
    /// The variable that is no quotient of either sign: it is at least minus this.
    pub below: Option<(usize, Dyadic)>,
    /// The bounds of each step: its exact size, its computed size, and h, its largest error of its own.
    pub bounds: Vec<Bound>,
}

/// The origin of a variable of a formula.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum VariableOrigin {
    /// An input, or a difference of inputs.
    Leaf(Leaf),
    /// A coordinate of a point in a box that holds all points. Only differences are computed from it, so it may be moved.
    Boxed(usize, usize),
    /// A number of the program that has a lemma of its own.
    Cut(Place),
    /// The same of a coordinate of a unit vector in which the formula is linear.
    Part(Place),
    /// The quotient that a lemma is about.
    Quotient,
}

/// The largest effect of all errors, and the corner that has it.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Maximum {
    /// The largest Σ|c_k| h_k.
    pub first: Dyadic,
    /// A bound of all terms of higher order.
    pub rest: Dyadic,
    /// The corner of the maximum: whether each variable is at its negative end.
    pub corner: Vec<bool>,
}

impl Maximum {
    /// The bound of the error.
    pub fn error(&self) -> Big {
        Big::from(self.first) + Big::from(self.rest)
    }
}

impl Step {
    /// The terms that it adds up; none of a sum of variables and of a number.
    pub fn terms(&self) -> impl Iterator<Item = Term<usize>> + use<> {
        let operation = match self {
            Step::Variables(_) => None,
            Step::Of(operation) => Some(*operation),
        };
        operation
            .into_iter()
            .flat_map(|operation| operation.terms())
    }

    /// The earlier steps in it.
    pub fn operands(&self) -> impl Iterator<Item = usize> + use<> {
        self.terms().flat_map(|(_, a, b)| [Some(a), b]).flatten()
    }

    /// The variables in it as bits, from those in earlier steps. Beyond 64 variables, which are too many, two may
    /// share a bit.
    pub fn support(&self, earlier: &[u64]) -> u64 {
        match self {
            Step::Variables(sum) => sum.iter().fold(0, |bits, (v, _)| bits | 1 << (v % 64)),
            _ => self.operands().fold(0, |bits, i| bits | earlier[i]),
        }
    }
}

/// Binary digits that the numbers of a lemma keep.
pub const DIGITS: u32 = 24;

impl Formula {
    /// The variables in each step, as bits.
    pub(super) fn supports(&self) -> Vec<u64> {
        let mut supports = Vec::with_capacity(self.steps.len());
        for step in &self.steps {
            supports.push(step.support(&supports));
        }
        supports
    }

    /// The terms of second and higher order, with every number at its largest size and nothing cancelled,
    /// rounded up. And the bounds of the steps: where the sizes at the corners are given they are made, and no error
    /// is relative yet; else they are those known.
    pub(super) fn higher_order(
        &self,
        format: Format,
        corners: Option<&[Dyadic]>,
    ) -> (Dyadic, Vec<Bound>) {
        // Of each step: its size, its terms of first order, and the rest.
        let mut terms: Vec<[Big; 3]> = Vec::with_capacity(self.steps.len());
        let mut bounds: Vec<Bound> = Vec::with_capacity(self.steps.len());
        let unit = Big::from(format.unit());
        let tiny = Big::from(format.tiny());
        for (i, step) in self.steps.iter().enumerate() {
            let [mut first, mut rest] = [Big::zero(), Big::zero()];
            for (_, a, b) in step.terms() {
                let [a0, a1, a2] = &terms[a];
                if let Some([b0, b1, b2]) = b.map(|b| &terms[b]) {
                    first += a0 * b1 + a1 * b0;
                    rest += a1 * b1 + a2 * &(b0 + b1 + b2) + (a0 + a1) * b2;
                } else {
                    first += a1;
                    rest += a2;
                }
            }
            let bound = match (&self.given[i], corners) {
                (Some(given), _) => given.clone(),
                (None, None) => self.bounds[i].clone(),
                (None, Some(corners)) => {
                    let before = &first + &rest;
                    self.bound_of_step(i, &bounds, corners[i], before, format)
                }
            };
            let size = Big::from(bound.size);
            if self.relative[i] && corners.is_none() {
                rest = &rest + &unit * &(&first + &rest) + &tiny;
                first += &unit * &size;
            } else {
                first += Big::from(bound.error);
            }
            terms.push([size, first, rest]);
            bounds.push(bound);
        }
        let rest = terms
            .last()
            .map_or(Dyadic::ZERO, |[_, _, rest]| round_up(rest, DIGITS));
        (rest, bounds)
    }

    /// The bound of a step from those of its operands, its size at the corners, and the error before it is
    /// rounded.
    fn bound_of_step(
        &self,
        i: usize,
        bounds: &[Bound],
        corner: Dyadic,
        before: Big,
        format: Format,
    ) -> Bound {
        let mut by_operands = Dyadic::ZERO;
        let mut all = Vec::new();
        for (_, a, b) in self.steps[i].terms() {
            let mut size = bounds[a].size;
            let mut computed = Big::from(bounds[a].computed);
            if let Some(b) = b {
                size = size * bounds[b].size;
                computed *= Big::from(bounds[b].computed);
            }
            by_operands = by_operands + size;
            all.push(computed);
        }
        // A number of the corners, even where the products and sums need more digits than there are.
        let size = by_operands.min(corner);
        let is_minor = matches!(self.steps[i], Step::Of(Operation::Minor(..)));
        if is_minor && format == Format::F64 {
            return minor_in_f64(size, &all);
        }
        let computed = all.into_iter().sum::<Big>().min(Big::from(size) + before);
        let mut error = Dyadic::ZERO;
        if self.rounds[i] {
            error = format.half_ulp_of(&computed);
            if is_minor {
                // The difference is rounded twice, first to f64.
                error = error.plus_up(Format::F64.half_ulp_of(&computed));
            }
        }
        Bound {
            size,
            computed: round_up(&computed, format.digits),
            error,
        }
    }
}

/// The bound of a difference of two products of these sizes in f64. Both are rounded, and so are their
/// difference, that of their remainders, and the sum of both.
fn minor_in_f64(size: Dyadic, products: &[Big]) -> Bound {
    let format = Format::F64;
    let up = |x: &Big| Big::from(round_up(x, format.digits));
    let half_ulp = |x: &Big| Big::from(format.half_ulp_of(x));
    let twice_tiny = Big::from(format.tiny()) + Big::from(format.tiny());
    let rounded: Big = products.iter().map(up).sum();
    let remainders = products.iter().map(half_ulp).sum::<Big>() + &twice_tiny;
    let error = half_ulp(&rounded) + up(&remainders) + half_ulp(&remainders) + twice_tiny;
    let computed = up(&rounded) + up(&remainders);
    Bound {
        size,
        computed: round_up(&computed, format.digits),
        error: round_up(&error, DIGITS),
    }
}
