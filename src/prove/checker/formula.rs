//! The formula of a lemma: variables, steps, and what their rounding errors add up to.

use super::corners::{Row, search};
use super::number::{Bound, ERROR_DIGITS, F32, F64, Format, Number, power, round_up, split};
use super::program::{Leaf, MOST_ROWS, Program, Term, indices, terms};
use super::reader::{Outcome, Reader, ensure};
use num_bigint::BigInt;
use num_traits::{One, Zero};
use std::collections::HashSet;

/// A formula of n variables has 2^n corners. Work is counted in corners times steps.
const MOST_VARIABLES: usize = 18;
const MOST_WORK: u64 = 1 << 31;

/// A variable: a leaf, a number with a lemma, or else the quotient that the lemma is about.
struct Variable {
    leaf: Option<Leaf>,
    cut: Option<usize>,
    bound: Bound,
}

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
}

/// What the corners of a formula show.
pub struct Shown {
    /// Of the last step.
    pub size: Number,
    pub computed: Number,
    /// Of the last step's error, not rounded up.
    pub error: Number,
}

/// The variables and the steps of a lemma.
pub struct Formula<'a> {
    variables: Vec<Variable>,
    pub steps: Vec<Step<'a>>,
}

impl<'a> Formula<'a> {
    /// The quotient is at most `quotient`, in the lemmas that have one.
    pub fn read(
        program: &Program,
        quotient: Option<&Number>,
        reader: &mut Reader<'a>,
    ) -> Outcome<Self> {
        let mut formula = Formula { variables: Vec::new(), steps: Vec::new() };
        // The component of each input, and of the ground under them, in the graph of the leaves.
        let mut components: [usize; 18] = std::array::from_fn(|i| i);
        while reader.is_next("variable") {
            let form = "variable point P AXIS, difference P Q AXIS, direction AXIS, end N, \
                        cut OPERATION or, in the rules of quotients, quotient";
            let (leaf, cut) = reader.read(form, |words| {
                let (kind, words) = words.split_first()?;
                let point = |p: usize, axis: usize| if p == 0 { axis } else { 3 + 3 * p + axis };
                Some(match (*kind, &indices(words, MOST_ROWS)?[..]) {
                    ("point", &[p @ 0..4, axis @ 0..3]) => (Some((point(p, axis), None)), None),
                    ("difference", &[p @ 0..4, q @ 0..4, axis @ 0..3]) => {
                        (Some((point(p, axis), Some(point(q, axis)))), None)
                    }
                    ("direction", &[axis @ 0..3]) => (Some((3 + axis, None)), None),
                    ("end", &[end @ 0..2]) => (Some((15 + end, None)), None),
                    ("cut", &[place]) => (None, Some(place)),
                    ("quotient", &[]) => quotient.map(|_| (None, None))?,
                    _ => return None,
                })
            })?;
            let bound = match (leaf, cut) {
                (Some(leaf), _) => {
                    let (from, to) = (components[leaf.0], components[leaf.1.unwrap_or(17)]);
                    ensure(
                        from != to,
                        "found a variable that follows from those above, expected an independent one",
                    )?;
                    components.iter_mut().filter(|c| **c == from).for_each(|c| *c = to);
                    Bound::exactly(program.domain.bound(leaf))
                }
                (_, Some(place)) => program.bound(place)?.clone(),
                _ => quotient.map(Bound::exactly).ok_or("found a quotient, expected none")?,
            };
            formula.variables.push(Variable { leaf, cut, bound });
            let is_fair = formula.variables.len() <= MOST_VARIABLES;
            ensure(is_fair, format!("found more than {MOST_VARIABLES} variables"))?;
        }
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
        let found = search(&rows, &[], &boxes).ok_or(LONG)?;
        let sizes = found
            .sizes
            .iter()
            .zip(&scales)
            .map(|(size, scale)| Number::from(size.clone()) * power(*scale));
        let sizes: Vec<Number> = sizes.collect();
        let none = vec![None; self.steps.len()];
        let (bounds, _) = self.run(format, &sizes, &none, false);
        for bound in &bounds {
            format.finite(&bound.computed)?;
        }
        let weight = |k: usize| {
            if self.steps[k].relative {
                format.unit.clone()
            } else {
                &bounds[k].error * power(-scales[k])
            }
        };
        let weights: Vec<Number> = (0..self.steps.len()).map(weight).collect();
        let finest = weights.iter().filter(|w| !w.is_zero()).map(|w| split(w).1).min().unwrap_or(0);
        let whole =
            |(w, step): (&Number, &Step)| ((w * power(-finest)).to_integer(), step.relative);
        let weights: Vec<_> = weights.iter().zip(&self.steps).map(whole).collect();
        let found = search(&rows, &weights, &boxes).ok_or(LONG)?;
        let first = Number::from(found.sum) * power(scales[scales.len() - 1] + finest);
        let sign = |v: usize| if found.corner >> v & 1 == 1 { '-' } else { '+' };
        let signs: String = (0..self.variables.len()).map(sign).collect();
        reader.read(&format!("corner {signs}"), |words| (words.concat() == signs).then_some(()))?;
        reader.demand("first", &first)?;
        let known: Vec<_> = bounds.into_iter().map(Some).collect();
        let (mut bounds, rest) = self.run(format, &sizes, &known, true);
        let rest = round_up(&rest, ERROR_DIGITS);
        reader.demand("rest", &rest)?;
        let Bound { size, computed, .. } = bounds.pop().expect("a step");
        Ok(Shown { size, computed, error: first + rest })
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
        if self.place.is_none() || self.name == "neg" {
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
