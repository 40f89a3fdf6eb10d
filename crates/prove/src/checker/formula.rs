//! The formula of a lemma: its variables and steps.

mod errors;

use super::number::{Bound, F32, F64, Number, whole};
use super::program::{Leaf, MOST_ROWS, Program, Term, indices, terms};
use super::reader::{Outcome, Reader, ensure};
use super::variables::{self, Quotient, Variable};
use num_bigint::BigInt;
use num_traits::Zero;
use std::collections::HashSet;

/// A step, and what it adds up: variables, a constant, and earlier steps.
#[derive(Default)]
pub struct Step<'a> {
    /// The operation that it stands for; none of steps that only a proof needs.
    pub place: Option<usize>,
    name: &'a str,
    variables: Vec<(bool, usize)>,
    constant: i64,
    terms: Vec<Term>,
    /// The variables in it, as bits.
    support: usize,
    /// The bound that is known before the corners.
    given: Option<Bound>,
    /// True if its error is also at most u times its size before it is rounded, and a tiny number.
    rounds: bool,
    relative: bool,
    /// True if its rounding is left out, because its quotient's lemma takes it as a share of the quotient.
    left_out: bool,
}

/// The variables and the steps of a lemma.
pub struct Formula<'a> {
    variables: Vec<Variable>,
    /// The variables that are coordinates of one unit vector in which the last step is linear.
    unit: Vec<usize>,
    pub steps: Vec<Step<'a>>,
}

impl<'a> Formula<'a> {
    /// With the quotient, in the lemmas that have one.
    pub fn read(
        program: &Program,
        quotient: Option<Quotient>,
        reader: &mut Reader<'a>,
    ) -> Outcome<Self> {
        let variables = variables::read(program, quotient, reader)?;
        let unit = (0..variables.len())
            .filter(|v| variables[*v].part.is_some())
            .collect();
        let mut formula = Formula {
            variables,
            unit,
            steps: vec![],
        };
        while reader.is_next("step") {
            let words =
                reader.read("step OPERATION KIND OPERANDS", |words| Some(words.to_vec()))?;
            let step = formula.step(&words, program, quotient.is_some());
            let found = |expected| format!("found `step {}`, expected {expected}", words.join(" "));
            formula.steps.push(step.map_err(found)?);
            ensure(
                formula.steps.len() <= MOST_ROWS,
                format!("found more than {MOST_ROWS} steps"),
            )?;
        }
        let operands = formula.steps.iter().flat_map(|step| &step.terms);
        let operands: HashSet<usize> = operands
            .flat_map(|(_, a, b)| [*a, b.unwrap_or(*a)])
            .collect();
        let is_whole = operands.len() + 1 == formula.steps.len();
        ensure(
            is_whole,
            "found steps that the last one does not use, or none",
        )?;
        let is_linear = formula.unit.is_empty() || formula.is_linear(formula.steps.len() - 1);
        ensure(
            is_linear,
            "found a last step without a part, expected one with parts",
        )?;
        if quotient.is_some() {
            formula.leave_out();
        }
        if reader.is_next("relative") {
            let steps = &mut formula.steps;
            reader.read(
                "relative STEPS, each an earlier one that rounds once",
                |words| {
                    for i in indices(words, steps.len())? {
                        steps[i].relative =
                            (steps[i].rounds && !steps[i].relative).then_some(true)?;
                    }
                    Some(())
                },
            )?;
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
        const UNKNOWN: &str = "an operation of the program";
        let place = match place {
            "-" => None,
            _ => Some(indices(&[place], program.operations.len()).ok_or(UNKNOWN)?[0]),
        };
        let operation = place.map(|place| &program.operations[place]);
        let is_known = operation.is_some()
            || in_quotient && ["variables", "number", "add", "mul", "sub"].contains(&name);
        is_known.then_some(()).ok_or(UNKNOWN)?;
        let mut step = Step {
            place,
            name,
            ..Step::default()
        };
        if name == "variables" {
            let variable = |word: &&str| {
                let (sign, v) = word
                    .split_at_checked(1)
                    .filter(|(sign, _)| ["+", "-"].contains(sign))?;
                Some((sign == "-", indices(&[v], self.variables.len())?[0]))
            };
            let variables: Option<_> = words.iter().map(variable).collect();
            step.variables = variables.ok_or("variables, each with its sign")?;
            step.support = step.variables.iter().fold(0, |bits, (_, v)| bits | 1 << v);
            let single = match step.variables[..] {
                [(false, v)] if self.variables[v].leaf.is_none() => Some(&self.variables[v]),
                _ => None,
            };
            let is_leaf = |leaf: &Leaf| self.is_sum(*leaf, &step.variables);
            let leaf = place.and_then(|place| program.leaf(place)).filter(is_leaf);
            let is_boxed = |(_, v): &(bool, usize)| self.variables[*v].is_boxed;
            let is_moved = leaf.is_some_and(|(_, other)| other.is_none());
            (!is_moved || !step.variables.iter().any(is_boxed))
                .then_some(())
                .ok_or("a difference of points in a box")?;
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
            let value = words
                .first()
                .and_then(|word| whole(word))
                .filter(|_| words.len() == 1);
            let right = operation.map_or(Some(1), |o| (o.name == name).then_some(o.value));
            step.constant = value
                .filter(|value| right == Some(*value))
                .ok_or("the program's number")?;
            step.given = Some(Bound::exactly(&Number::from(BigInt::from(
                step.constant.abs(),
            ))));
        } else {
            let operands = indices(words, self.steps.len()).ok_or("earlier steps")?;
            step.terms = terms(name, &operands).ok_or("a step that adds or multiplies")?;
            let mut places = operands.iter().map(|i| self.steps[*i].place);
            let is_same = operation.is_none_or(|o| {
                o.name == name && places.by_ref().eq(o.operands.iter().map(|o| Some(*o)))
            });
            is_same
                .then_some(())
                .ok_or("the operation of the program with its operands")?;
            for (_, a, b) in &step.terms {
                let (a, b) = (
                    self.steps[*a].support,
                    b.map_or(0, |b| self.steps[b].support),
                );
                (a & b == 0)
                    .then_some(())
                    .ok_or("factors without a variable in common")?;
                step.support |= a | b;
            }
            let factors = |(_, a, b): &Term| [Some(*a), *b].into_iter().flatten();
            let parts = |term| factors(term).filter(|i| self.is_linear(*i)).count();
            let first = parts(&step.terms[0]);
            let is_fit = first < 2 && step.terms.iter().all(|term| parts(term) == first);
            is_fit
                .then_some(())
                .ok_or("terms that are all linear in parts, or all without one")?;
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

    /// Leaves out the last rounding of numerator and of divisor in a quotient's formula, each if no other step uses it.
    /// It may be under negations.
    fn leave_out(&mut self) {
        let operands = |(_, a, b): &Term| [Some(*a), *b].into_iter().flatten();
        let all = self
            .steps
            .iter()
            .flat_map(|step| &step.terms)
            .flat_map(operands);
        let all: Vec<usize> = all.collect();
        let is_used_once = |step: usize| all.iter().filter(|other| **other == step).count() == 1;
        let last = self.steps.iter().rev().take(2).flat_map(|step| &step.terms);
        let last: Vec<usize> = last.flat_map(operands).collect();
        // Two numerators are added up by a step that only the proof needs.
        let sums = last.iter().map(|step| &self.steps[*step]);
        let sums = sums.filter(|step| step.place.is_none() && step.name == "add");
        let numerators = sums.flat_map(|step| &step.terms).flat_map(operands);
        let last: Vec<usize> = numerators.chain(last.iter().copied()).collect();
        for mut step in last {
            while self.steps[step].name == "neg" && is_used_once(step) {
                step = self.steps[step].terms[0].1;
            }
            let is_used_once = is_used_once(step);
            let step = &mut self.steps[step];
            if step.rounds && is_used_once {
                (step.rounds, step.left_out) = (false, true);
                step.given
                    .iter_mut()
                    .for_each(|bound| bound.error = Number::zero());
            }
        }
    }

    /// True if the last rounding of an operation, which may be under negations, is left out.
    pub fn leaves_out(&self, program: &Program, mut place: usize) -> bool {
        while program.name(place) == "neg" {
            place = program.operands(place)[0];
        }
        self.steps
            .iter()
            .any(|step| step.left_out && step.place == Some(place))
    }

    /// True if a part is in a step.
    fn is_linear(&self, step: usize) -> bool {
        self.unit
            .iter()
            .any(|v| self.steps[step].support >> v & 1 == 1)
    }

    /// True if the variables add up to a leaf, input by input.
    fn is_sum(&self, (i, j): Leaf, sum: &[(bool, usize)]) -> bool {
        let mut left = [0i64; 17];
        let mut add = |(i, j): Leaf, sign: i64| {
            left[i] += sign;
            j.into_iter().for_each(|j| left[j] -= sign);
        };
        add((i, j), -1);
        for (minus, v) in sum {
            let Some(leaf) = self.variables[*v].leaf else {
                return false;
            };
            add(leaf, if *minus { -1 } else { 1 });
        }
        left == [0; 17]
    }

    /// True if the last step is n - quotient*d, where n is a numerator, the sum of two or, of none, the number 1, and no other
    /// step is without an operation.
    pub fn is_quotient_of(&self, numerators: &[usize], d: usize) -> bool {
        let Some((before, [q, product, last])) = self.steps.split_last_chunk() else {
            return false;
        };
        let (&[_], &[(_, q_at, Some(divisor))], &[(_, above, None), (true, below, None)]) =
            (&q.variables[..], &product.terms[..], &last.terms[..])
        else {
            return false;
        };
        let proof_only: Vec<usize> = (0..self.steps.len())
            .filter(|i| self.steps[*i].place.is_none())
            .collect();
        let mut expected = vec![before.len(), before.len() + 1, before.len() + 2];
        if numerators.len() != 1 {
            expected.insert(0, above);
        }
        let Step {
            name, place, terms, ..
        } = &self.steps[above];
        let of = |(_, a, _): &Term| self.steps[*a].place;
        let is_numerator = match numerators {
            [] => *name == "number",
            [n] => *place == Some(*n),
            _ => *name == "add" && terms.iter().map(of).eq(numerators.iter().map(|n| Some(*n))),
        };
        proof_only == expected
            && is_numerator
            && self.steps[divisor].place == Some(d)
            && (q_at, below) == (before.len(), before.len() + 1)
    }
}

#[cfg(test)]
mod tests;
