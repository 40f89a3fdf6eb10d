//! The formula of a lemma: variables, steps, and what their rounding errors add up to.

use super::corners::{Row, search};
use super::number::{
    Bound, ERROR_DIGITS, F32, F64, Format, Number, SIZE_DIGITS, power, root_up, round_up, split,
};
use super::program::{Leaf, MOST_ROWS, Program, Term, indices, terms};
use super::reader::{Outcome, Reader, ensure};
use super::variables::{self, Variable};
use num_bigint::BigInt;
use num_traits::{One, Zero};
use std::collections::HashSet;

/// Work is counted in corners times steps.
const MOST_WORK: u64 = 1 << 31;

/// A step, and what it adds up: variables, a constant, and earlier steps.
pub struct Step<'a> {
    /// The operation that it stands for; none of steps that only a proof needs.
    pub place: Option<usize>,
    name: &'a str,
    variables: Vec<(bool, usize)>,
    constant: i64,
    terms: Vec<Term>,
    /// The variables in it, as bits.
    support: usize,
    /// What is known before the corners.
    given: Option<Bound>,
    /// Whether its error is also at most u times its size before it is rounded, and a tiny number.
    rounds: bool,
    relative: bool,
    /// Whether its rounding is left out: its quotient's lemma takes it as a share of the quotient.
    left_out: bool,
}

/// What the corners of a formula show.
pub struct Shown {
    /// Of the last step.
    pub size: Number,
    pub computed: Number,
    /// Of the last step's error, not rounded up; and before it is rounded, if it is rounded once.
    pub error: Number,
    pub before: Number,
}

/// The variables and the steps of a lemma.
pub struct Formula<'a> {
    variables: Vec<Variable>,
    /// The variables that are coordinates of one unit vector in which the last step is linear.
    unit: Vec<usize>,
    pub steps: Vec<Step<'a>>,
}

impl<'a> Formula<'a> {
    /// The quotient is at most `quotient`, in the lemmas that have one.
    pub fn read(
        program: &Program,
        quotient: Option<&Number>,
        reader: &mut Reader<'a>,
    ) -> Outcome<Self> {
        let variables = variables::read(program, quotient, reader)?;
        let unit = (0..variables.len()).filter(|v| variables[*v].part.is_some()).collect();
        let mut formula = Formula { variables, unit, steps: vec![] };
        while reader.is_next("step") {
            let words =
                reader.read("step OPERATION KIND OPERANDS", |words| Some(words.to_vec()))?;
            let step = formula.step(&words, program, quotient.is_some());
            let found = |expected| format!("found `step {}`, expected {expected}", words.join(" "));
            formula.steps.push(step.map_err(found)?);
            ensure(formula.steps.len() <= MOST_ROWS, format!("found more than {MOST_ROWS} steps"))?;
        }
        let operands = formula.steps.iter().flat_map(|step| &step.terms);
        let operands: HashSet<usize> =
            operands.flat_map(|(_, a, b)| [*a, b.unwrap_or(*a)]).collect();
        let is_whole = operands.len() + 1 == formula.steps.len();
        ensure(is_whole, "found steps that the last one does not use, or none")?;
        let is_linear = formula.unit.is_empty() || formula.is_linear(formula.steps.len() - 1);
        ensure(is_linear, "found a last step without a part, expected one with parts")?;
        if quotient.is_some() {
            formula.leave_out();
        }
        if reader.is_next("relative") {
            let steps = &mut formula.steps;
            reader.read("relative STEPS, each an earlier one that rounds once", |words| {
                for i in indices(words, steps.len())? {
                    steps[i].relative = (steps[i].rounds && !steps[i].relative).then_some(true)?;
                }
                Some(())
            })?;
        }
        Ok(formula)
    }

    /// One step, or what was expected.
    fn step(
        &self,
        words: &[&'a str],
        program: &Program,
        in_quotient: bool,
    ) -> Result<Step<'a>, &'static str> {
        let (&[place, name], words) = words.split_first_chunk().ok_or("more words")?;
        let place = (place != "-").then(|| indices(&[place], program.operations.len()));
        let place = place
            .map(|place| place.ok_or("an operation of the program"))
            .transpose()?
            .map(|place| place[0]);
        let operation = place.map(|place| &program.operations[place]);
        let is_known = operation.is_some()
            || in_quotient && ["variables", "number", "mul", "sub"].contains(&name);
        is_known.then_some(()).ok_or("an operation of the program")?;
        let mut step = Step {
            place,
            name,
            variables: vec![],
            constant: 0,
            terms: vec![],
            support: 0,
            given: None,
            rounds: false,
            relative: false,
            left_out: false,
        };
        if name == "variables" {
            let variable = |word: &&str| {
                let (sign, v) =
                    word.split_at_checked(1).filter(|(sign, _)| ["+", "-"].contains(sign))?;
                Some((sign == "-", indices(&[v], self.variables.len())?[0]))
            };
            step.variables = words
                .iter()
                .map(variable)
                .collect::<Option<_>>()
                .ok_or("variables, each with its sign")?;
            step.support = step.variables.iter().fold(0, |bits, (_, v)| bits | 1 << v);
            let single = match step.variables[..] {
                [(false, v)] if self.variables[v].leaf.is_none() => Some(&self.variables[v]),
                _ => None,
            };
            let is_leaf = |leaf: &Leaf| self.is_sum(*leaf, &step.variables);
            let leaf = place.and_then(|place| program.leaf(place)).filter(is_leaf);
            step.rounds = leaf.is_some_and(|(_, other)| other.is_some());
            step.given = match (single.filter(|v| v.cut == place), leaf) {
                (Some(variable), _) => Some(variable.bound.clone()),
                (_, Some(leaf)) => {
                    let size = program.domain.bound(leaf);
                    Some(if step.rounds {
                        program.format.rounded(size.clone(), size)
                    } else {
                        Bound::exactly(size)
                    })
                }
                _ => return Err("variables that are, or add up to, this operation"),
            };
        } else if name == "number" {
            let value =
                words.first().and_then(|word| word.parse().ok()).filter(|_| words.len() == 1);
            let right = operation.map_or(Some(1), |o| (o.name == name).then_some(o.value));
            step.constant =
                value.filter(|value| right == Some(*value)).ok_or("the program's number")?;
            step.given = Some(Bound::exactly(&Number::from(BigInt::from(step.constant.abs()))));
        } else {
            let operands = indices(words, self.steps.len()).ok_or("earlier steps")?;
            step.terms = terms(name, &operands).ok_or("a step that adds or multiplies")?;
            let mut places = operands.iter().map(|i| self.steps[*i].place);
            let is_same = operation.is_none_or(|o| {
                o.name == name && places.by_ref().eq(o.operands.iter().map(|o| Some(*o)))
            });
            is_same.then_some(()).ok_or("the operation of the program with its operands")?;
            for (_, a, b) in &step.terms {
                let (a, b) = (self.steps[*a].support, b.map_or(0, |b| self.steps[b].support));
                (a & b == 0).then_some(()).ok_or("factors without a variable in common")?;
                step.support |= a | b;
            }
            let factors = |(_, a, b): &Term| [Some(*a), *b].into_iter().flatten();
            let parts = |term| factors(term).filter(|i| self.is_linear(*i)).count();
            let first = parts(&step.terms[0]);
            let is_fit = first < 2 && step.terms.iter().all(|term| parts(term) == first);
            is_fit.then_some(()).ok_or("terms that are all linear in parts, or all without one")?;
            // In f64 a difference of products is rounded more than once.
            let is_minor = name == "minor";
            (!is_minor || [F32, F64].contains(&program.format.parameters))
                .then_some(())
                .ok_or("no minor in this format")?;
            step.rounds =
                place.is_some() && name != "neg" && (!is_minor || program.format.parameters == F32);
        }
        Ok(step)
    }

    /// Of numerator and divisor, in the last steps of a quotient's formula, each if no other step uses it.
    fn leave_out(&mut self) {
        let last = self.steps.iter().rev().take(2).flat_map(|step| step.terms.clone());
        let operands = |(_, a, b): Term| [Some(a), b].into_iter().flatten();
        let last: Vec<usize> = last.flat_map(operands).collect();
        let all = self.steps.iter().flat_map(|step| step.terms.clone()).flat_map(operands);
        let all: Vec<usize> = all.collect();
        for step in last {
            let is_used_once = all.iter().filter(|other| **other == step).count() == 1;
            let step = &mut self.steps[step];
            if step.rounds && is_used_once {
                (step.rounds, step.left_out) = (false, true);
                step.given.iter_mut().for_each(|bound| bound.error = Number::zero());
            }
        }
    }

    /// Whether the last rounding of an operation is left out.
    pub fn leaves_out(&self, place: usize) -> bool {
        self.steps.iter().any(|step| step.left_out && step.place == Some(place))
    }

    /// Whether a part is in a step.
    fn is_linear(&self, step: usize) -> bool {
        self.unit.iter().any(|v| self.steps[step].support >> v & 1 == 1)
    }

    /// Whether the variables add up to a leaf, input by input.
    fn is_sum(&self, (i, j): Leaf, sum: &[(bool, usize)]) -> bool {
        let mut left = [0i64; 17];
        let mut add = |(i, j): Leaf, sign: i64| {
            left[i] += sign;
            j.into_iter().for_each(|j| left[j] -= sign);
        };
        add((i, j), -1);
        for (minus, v) in sum {
            let Some(leaf) = self.variables[*v].leaf else { return false };
            add(leaf, if *minus { -1 } else { 1 });
        }
        left == [0; 17]
    }

    /// Whether the last step is n - quotient*d, n may be the number 1, and no other step is without an
    /// operation.
    pub fn is_quotient_of(&self, n: Option<usize>, d: usize) -> bool {
        let Some((before, [q, product, last])) = self.steps.split_last_chunk() else {
            return false;
        };
        let (&[_], &[(_, q_at, Some(divisor))], &[(_, above, None), (true, below, None)]) =
            (&q.variables[..], &product.terms[..], &last.terms[..])
        else {
            return false;
        };
        let proof_only: Vec<usize> =
            (0..self.steps.len()).filter(|i| self.steps[*i].place.is_none()).collect();
        let mut expected = vec![before.len(), before.len() + 1, before.len() + 2];
        if n.is_none() {
            expected.insert(0, above);
        }
        proof_only == expected
            && (n.is_some() || self.steps[above].name == "number")
            && self.steps[above].place == n
            && self.steps[divisor].place == Some(d)
            && (q_at, below) == (before.len(), before.len() + 1)
    }

    /// What the corners show. Reads the corner and both parts of the error's bound.
    pub fn maximum(&self, format: &Format, work: &mut u64, reader: &mut Reader) -> Outcome<Shown> {
        *work += (self.steps.len() as u64) << self.variables.len();
        ensure(*work <= MOST_WORK, "found too many corners of too many steps in this file")?;
        const LONG: &str = "found numbers that are too long";
        // Every value is an integer times a power of two that does not depend on the corner.
        let split_bounds = self.variables.iter().map(|v| split(&v.bound.size));
        let (boxes, exponents): (Vec<BigInt>, Vec<i64>) = split_bounds.unzip();
        let mut scales: Vec<i64> = Vec::new();
        let mut rows = Vec::new();
        for step in &self.steps {
            let of_term = |b: &Option<usize>| b.map_or(0, |b| scales[b]);
            let of_variables = step.variables.iter().map(|(_, v)| exponents[*v]);
            let of_terms = step.terms.iter().map(|(_, a, b)| scales[*a] + of_term(b));
            let scale = of_variables.clone().chain(of_terms.clone()).min().unwrap_or(0);
            let factor =
                |minus: bool, of: i64| BigInt::from(if minus { -1 } else { 1 }) << (of - scale);
            let variables = step
                .variables
                .iter()
                .zip(of_variables)
                .map(|((minus, v), of)| (factor(*minus, of), *v));
            let terms = step
                .terms
                .iter()
                .zip(of_terms)
                .map(|((minus, a, b), of)| (factor(*minus, of), *a, *b));
            rows.push(Row {
                constant: step.constant.into(),
                variables: variables.collect(),
                terms: terms.collect(),
                support: step.support,
            });
            scales.push(scale);
        }
        let found = search(&rows, &[], &boxes, &self.unit).ok_or(LONG)?;
        let size = |(k, size): (usize, BigInt)| {
            let scale = power(scales[k]);
            if self.is_linear(k) {
                root_up(&(Number::from(size) * &scale * scale), SIZE_DIGITS)
            } else {
                Number::from(size) * scale
            }
        };
        let sizes: Vec<Number> = found.sizes.into_iter().enumerate().map(size).collect();
        let none = vec![None; self.steps.len()];
        let (bounds, _) = self.run(format, &sizes, &none, false);
        for bound in &bounds {
            format.finite(&bound.computed)?;
        }
        let weight = |k: usize| {
            if self.steps[k].relative {
                format.unit.clone()
            } else if self.steps[k].terms.is_empty() && self.is_linear(k) {
                Number::zero()
            } else {
                &bounds[k].error * power(-scales[k])
            }
        };
        let weights: Vec<Number> = (0..self.steps.len()).map(weight).collect();
        let finest = weights.iter().filter(|w| !w.is_zero()).map(|w| split(w).1).min().unwrap_or(0);
        let whole =
            |(w, step): (&Number, &Step)| ((w * power(-finest)).to_integer(), step.relative);
        let weights: Vec<_> = weights.iter().zip(&self.steps).map(whole).collect();
        let found = search(&rows, &weights, &boxes, &self.unit).ok_or(LONG)?;
        let (last, scale) = (bounds.len() - 1, power(scales[scales.len() - 1] + finest));
        let mut first = Number::from(found.sum) * &scale;
        if let Some(v) = self.unit.first() {
            // The vector's own error takes its place.
            first += &self.variables[*v].bound.error * &bounds[last].size;
            first += root_up(&(Number::from(found.squares) * &scale * scale), ERROR_DIGITS);
        }
        let sign = |v: usize| if found.corner >> v & 1 == 1 { '-' } else { '+' };
        let signs: String = (0..self.variables.len()).map(sign).collect();
        reader.read(&format!("corner {signs}"), |words| (words.concat() == signs).then_some(()))?;
        reader.demand("first", &first)?;
        let known: Vec<_> = bounds.into_iter().map(Some).collect();
        let (mut bounds, rest) = self.run(format, &sizes, &known, true);
        let rest = round_up(&rest, ERROR_DIGITS);
        reader.demand("rest", &rest)?;
        let Bound { size, computed, error: own } = bounds.pop().expect("a step");
        let error = first + rest;
        let is_known = self.steps[last].rounds && !self.steps[last].relative;
        let before = if is_known { &error - own } else { error.clone() };
        Ok(Shown { size, computed, error, before })
    }

    /// The bounds of the steps where they are not known, and the terms of second and higher order of the
    /// last step, with every number at its largest size and nothing cancelled.
    fn run(
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
        (bounds, orders.pop().map_or(Number::zero(), |[_, rest]| rest))
    }
}

impl Step<'_> {
    /// What follows from the operands' bounds, the size at the corners, and the error before this step.
    fn bound(&self, format: &Format, bounds: &[Bound], corner: &Number, before: Number) -> Bound {
        let products = |part: fn(&Bound) -> &Number| -> Vec<Number> {
            let of = |i: usize| part(&bounds[i]).clone();
            self.terms.iter().map(|(_, a, b)| of(*a) * b.map_or(Number::one(), of)).collect()
        };
        let size = products(|bound| &bound.size).iter().sum::<Number>().min(corner.clone());
        let products = products(|bound| &bound.computed);
        let z = products.iter().sum::<Number>().min(&size + before);
        if self.place.is_none() || self.name == "neg" || self.left_out {
            return Bound { size, computed: format.float_up(&z), error: Number::zero() };
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

#[cfg(test)]
mod tests;
