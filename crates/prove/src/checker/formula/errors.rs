//! The sum of the effects of the rounding errors of a formula's steps.

use super::super::corners::{Row, search, signs_to_try};
use super::super::number::{
    Bound, ERROR_DIGITS, F32, F64, Format, Number, SIZE_DIGITS, root_up, round_up, shifted, split,
};
use super::super::reader::{Outcome, Reader, ensure};
use super::super::variables::Variable;
use super::{Formula, Step};
use num_bigint::BigInt;
use num_traits::{One, Zero};

/// Work is counted in corners times steps.
const MOST_WORK: u64 = 1 << 31;

/// The sizes and errors that the corners of a formula show.
pub struct Shown {
    /// The size of the last step.
    pub size: Number,
    pub computed: Number,
    /// The error of the last step, not rounded up; and before it is rounded, if it is rounded once.
    pub error: Number,
    pub before: Number,
}

impl Formula<'_> {
    /// The result of the corners. Reads the corner and both parts of the error's bound.
    pub fn maximum(&self, format: &Format, reader: &mut Reader) -> Outcome<Shown> {
        const LONG: &str = "found numbers that are too long";
        // Every value is an integer times a power of two that does not depend on the corner.
        let ends = |v: &Variable| {
            let size = &v.bound.size;
            [size.clone(), -v.down_to.as_ref().unwrap_or(size).clone()]
        };
        let exponent = |v: &Variable| ends(v).iter().map(|end| split(end).1).min().expect("two");
        let exponents: Vec<i64> = self.variables.iter().map(exponent).collect();
        let whole = |(v, exponent): (&Variable, &i64)| {
            ends(v).map(|end| shifted(&end, -exponent).to_integer())
        };
        let boxes: Vec<_> = self.variables.iter().zip(&exponents).map(whole).collect();
        let fixed = self
            .variables
            .iter()
            .enumerate()
            .filter(|(_, v)| v.down_to.is_some());
        let fixed = fixed.fold(0, |bits, (v, _)| bits | 1 << v);
        let mut scales: Vec<i64> = Vec::new();
        let mut rows = Vec::new();
        for step in &self.steps {
            let of_term = |b: &Option<usize>| b.map_or(0, |b| scales[b]);
            let of_variables = step.variables.iter().map(|(_, v)| exponents[*v]);
            let of_terms = step.terms.iter().map(|(_, a, b)| scales[*a] + of_term(b));
            let scale = of_variables
                .clone()
                .chain(of_terms.clone())
                .min()
                .unwrap_or(0);
            let factor =
                |minus: &bool, of: i64| BigInt::from(if *minus { -1 } else { 1 }) << (of - scale);
            let variables = step.variables.iter().zip(of_variables);
            let variables = variables
                .map(|((minus, v), of)| (factor(minus, of), *v))
                .collect();
            let terms = step.terms.iter().zip(of_terms);
            let terms = terms
                .map(|((minus, a, b), of)| (factor(minus, of), *a, *b))
                .collect();
            let (constant, support) = (step.constant.into(), step.support);
            rows.push(Row {
                constant,
                variables,
                terms,
                support,
            });
            scales.push(scale);
        }
        let tried = signs_to_try(&rows, &self.unit, fixed);
        reader.work += (self.steps.len() as u64) << tried.count_ones();
        ensure(
            reader.work <= MOST_WORK,
            "found too many corners of too many steps in this file",
        )?;
        let found = search(&rows, &[], &boxes, &self.unit, tried).ok_or(LONG)?;
        let size = |(k, size): (usize, BigInt)| {
            if self.is_linear(k) {
                root_up(&shifted(&Number::from(size), 2 * scales[k]), SIZE_DIGITS)
            } else {
                shifted(&Number::from(size), scales[k])
            }
        };
        let sizes: Vec<Number> = found.sizes.into_iter().enumerate().map(size).collect();
        let none = vec![None; self.steps.len()];
        let (mut bounds, mut rest) = self.run(format, &sizes, &none, false);
        for bound in &bounds {
            format.finite(&bound.computed)?;
        }
        let weight = |k: usize| {
            if self.steps[k].relative {
                format.unit.clone()
            } else if self.steps[k].terms.is_empty() && self.is_linear(k) {
                Number::zero()
            } else {
                shifted(&bounds[k].error, -scales[k])
            }
        };
        let weights: Vec<Number> = (0..self.steps.len()).map(weight).collect();
        let finest = weights
            .iter()
            .filter(|w| !w.is_zero())
            .map(|w| split(w).1)
            .min()
            .unwrap_or(0);
        let whole = |(w, step): (&Number, &Step)| (shifted(w, -finest).to_integer(), step.relative);
        let weights: Vec<_> = weights.iter().zip(&self.steps).map(whole).collect();
        let found = search(&rows, &weights, &boxes, &self.unit, tried).ok_or(LONG)?;
        let (last, scale) = (bounds.len() - 1, scales[scales.len() - 1] + finest);
        let mut first = shifted(&Number::from(found.sum), scale);
        if let Some(v) = self.unit.first() {
            // The vector's own error takes its place.
            first += &self.variables[*v].bound.error * &bounds[last].size;
            first += root_up(
                &shifted(&Number::from(found.squares), 2 * scale),
                ERROR_DIGITS,
            );
        }
        let sign = |v: usize| if found.corner >> v & 1 == 1 { '-' } else { '+' };
        let signs: String = (0..self.variables.len()).map(sign).collect();
        reader.read(&format!("corner {signs}"), |words| {
            (words.concat() == signs).then_some(())
        })?;
        reader.demand("first", &first)?;
        if self.steps.iter().any(|step| step.relative) {
            let known: Vec<_> = bounds.iter().cloned().map(Some).collect();
            rest = self.run(format, &sizes, &known, true).1;
        }
        let rest = round_up(&rest, ERROR_DIGITS);
        reader.demand("rest", &rest)?;
        let Bound {
            size,
            computed,
            error: own,
        } = bounds.pop().expect("a step");
        let error = first + rest;
        let is_known = self.steps[last].rounds && !self.steps[last].relative;
        let before = if is_known {
            &error - own
        } else {
            error.clone()
        };
        Ok(Shown {
            size,
            computed,
            error,
            before,
        })
    }

    /// The bounds of the steps where they are not known, and the terms of second and higher order of the
    /// last step, with every number at its largest size and nothing cancelled.
    pub(super) fn run(
        &self,
        format: &Format,
        sizes: &[Number],
        known: &[Option<Bound>],
        relative: bool,
    ) -> (Vec<Bound>, Number) {
        // Of each step: its terms of first order, and the others.
        let (mut bounds, mut orders): (Vec<Bound>, Vec<[Number; 2]>) = (Vec::new(), Vec::new());
        for (k, step) in self.steps.iter().enumerate() {
            let (mut first, mut rest) = (Number::zero(), Number::zero());
            for (_, a, b) in &step.terms {
                let (size, [f, r]) = (&bounds[*a].size, &orders[*a]);
                if let Some(b) = b {
                    let (other, [g, s]) = (&bounds[*b].size, &orders[*b]);
                    first += size * g + f * other;
                    rest += f * g + r * (other + g + s) + (size + f) * s;
                } else {
                    first += f;
                    rest += r;
                }
            }
            let given = step.given.clone().or(known[k].clone());
            let bound =
                given.unwrap_or_else(|| step.bound(format, &bounds, &sizes[k], &first + &rest));
            if relative && step.relative {
                rest += &format.unit * (&first + &rest) + &format.tiny;
                first += &format.unit * &bound.size;
            } else {
                first += &bound.error;
            }
            bounds.push(bound);
            orders.push([first, rest]);
        }
        (
            bounds,
            orders.pop().map_or(Number::zero(), |[_, rest]| rest),
        )
    }
}

impl Step<'_> {
    /// The bound that follows from the operands' bounds, the size at the corners, and the error before this step.
    fn bound(&self, format: &Format, bounds: &[Bound], corner: &Number, before: Number) -> Bound {
        let products = |part: fn(&Bound) -> &Number| -> Vec<Number> {
            let of = |i: usize| part(&bounds[i]).clone();
            self.terms
                .iter()
                .map(|(_, a, b)| of(*a) * b.map_or(Number::one(), of))
                .collect()
        };
        let size = products(|bound| &bound.size)
            .iter()
            .sum::<Number>()
            .min(corner.clone());
        let products = products(|bound| &bound.computed);
        let z = products.iter().sum::<Number>().min(&size + before);
        if self.place.is_none() || self.name == "neg" || self.left_out {
            return Bound {
                size,
                computed: format.float_up(&z),
                error: Number::zero(),
            };
        }
        let mut bound = format.rounded(size, &z);
        if self.name == "minor" && format.parameters == F32 {
            // It is rounded to f64 before it is rounded to f32.
            bound.error += Format::of(F64).half_ulp(&z);
        } else if self.name == "minor" {
            // p and q are the rounded products: (p - q) + (remainder of p - remainder of q).
            let rounded: Number = products.iter().map(|x| format.float_up(x)).sum();
            let twice = &format.tiny + &format.tiny;
            let remainders = products.iter().map(|x| format.half_ulp(x)).sum::<Number>() + &twice;
            let both = format.float_up(&remainders);
            let error = format.half_ulp(&rounded) + &both + format.half_ulp(&remainders) + twice;
            bound.error = round_up(&error, ERROR_DIGITS);
            bound.computed = format.float_up(&(format.float_up(&rounded) + both));
        }
        bound
    }
}
