//! The steps of a formula, and how a line of one is checked against the program.

use super::super::domain::{INPUTS, Leaf};
use super::super::format::{Bound, F32};
use super::super::number::{Number, whole};
use super::super::operations::{Operation, Term, index, indices, terms};
use super::super::program::Program;
use super::super::variables::Variable;
use super::Formula;
use num_bigint::BigInt;

/// A variable with its sign.
pub struct SignedVariable {
    pub is_negative: bool,
    pub variable: usize,
}

/// A step, and its summands: variables, a constant, and earlier steps.
#[derive(Default)]
pub struct Step<'a> {
    /// The operation that it stands for; none of steps that only a proof needs.
    pub place: Option<usize>,
    pub name: &'a str,
    pub variables: Vec<SignedVariable>,
    pub constant: i64,
    pub terms: Vec<Term>,
    /// The variables in it, as bits.
    pub support: usize,
    /// The bound that is known before the corners.
    pub given: Option<Bound>,
    /// True if its error is also at most u times its size before it is rounded, and a tiny number.
    pub rounds: bool,
    pub relative: bool,
    /// True if its rounding is left out, because its quotient's lemma takes it as a share of the quotient.
    pub left_out: bool,
}

impl Step<'_> {
    /// The earlier steps that it uses.
    pub fn operands(&self) -> impl Iterator<Item = usize> {
        self.terms.iter().flat_map(Term::factors)
    }
}

/// A step, or the words that say what was expected in its place.
type Checked<'a> = Result<Step<'a>, &'static str>;

const UNKNOWN: &str = "an operation of the program";

/// The steps that a quotient's formula has for its proof alone.
const PROOF_ONLY: [&str; 5] = ["variables", "number", "add", "mul", "sub"];

impl<'a> Formula<'a> {
    /// The next step, from the words of its line.
    pub fn step(&self, words: &[&'a str], program: &Program, in_quotient: bool) -> Checked<'a> {
        let chunk = words.split_first_chunk();
        let (&[place, name], operands) = chunk.ok_or("more words")?;
        let place = match place {
            "-" if in_quotient && PROOF_ONLY.contains(&name) => None,
            word => Some(index(word, program.operations.len()).ok_or(UNKNOWN)?),
        };
        let step = Step {
            place,
            name,
            ..Step::default()
        };
        match name {
            "variables" => self.sum_of_variables(step, operands, program),
            "number" => constant(step, operands, program),
            _ => self.sum_of_terms(step, operands, program),
        }
    }

    /// A sum of variables is a variable alone, which has a bound of its own, or a leaf.
    ///
    /// A difference of two inputs is rounded once, and it has the bound of that difference from the domain: the sum of
    /// variables is only another way to write its exact value.
    fn sum_of_variables(
        &self,
        mut step: Step<'a>,
        words: &[&str],
        program: &Program,
    ) -> Checked<'a> {
        for word in words {
            let signed = self.signed_variable(word);
            let signed = signed.ok_or("variables, each with its sign")?;
            step.support |= 1 << signed.variable;
            step.variables.push(signed);
        }
        if let Some(variable) = self.variable_alone(&step) {
            step.given = Some(variable.bound.clone());
            return Ok(step);
        }
        let leaf = step.place.and_then(|place| program.leaf(place));
        let leaf = leaf.filter(|leaf| self.is_sum(*leaf, &step.variables));
        let leaf = leaf.ok_or("variables that are, or add up to, this operation")?;
        let size = program.domain.bound(leaf);
        if leaf.less.is_some() {
            step.rounds = true;
            step.given = Some(program.format.rounded(size.clone(), size));
            return Ok(step);
        }
        // The box of all points was moved, so a point itself is not where its variable is.
        for signed in &step.variables {
            if self.variables[signed.variable].is_boxed() {
                return Err("a difference of points in a box");
            }
        }
        step.given = Some(Bound::exactly(size));
        Ok(step)
    }

    fn signed_variable(&self, word: &str) -> Option<SignedVariable> {
        let (sign, variable) = word.split_at_checked(1)?;
        if !["+", "-"].contains(&sign) {
            return None;
        }
        Some(SignedVariable {
            is_negative: sign == "-",
            variable: index(variable, self.variables.len())?,
        })
    }

    /// The one variable of a step, if it stands for the step's operation, or if both stand for none: a quotient.
    fn variable_alone(&self, step: &Step) -> Option<&Variable> {
        let [signed] = &step.variables[..] else {
            return None;
        };
        let variable = &self.variables[signed.variable];
        if signed.is_negative || variable.leaf().is_some() {
            return None;
        }
        (variable.place() == step.place).then_some(variable)
    }

    /// True if the variables add up to a leaf, input by input.
    fn is_sum(&self, leaf: Leaf, sum: &[SignedVariable]) -> bool {
        let mut left = [0; INPUTS];
        add(&mut left, leaf, -1);
        for signed in sum {
            let Some(summand) = self.variables[signed.variable].leaf() else {
                return false;
            };
            let sign = if signed.is_negative { -1 } else { 1 };
            add(&mut left, summand, sign);
        }
        left == [0; INPUTS]
    }

    /// A sum of earlier steps or of their products, whose factors have no variable in common.
    ///
    /// So each step is affine in each variable. If it depends on the unit vector, it is linear in it, because all terms
    /// have exactly one factor that is.
    fn sum_of_terms(&self, mut step: Step<'a>, words: &[&str], program: &Program) -> Checked<'a> {
        let operands = indices(words, self.steps.len()).ok_or("earlier steps")?;
        step.terms = terms(step.name, &operands).ok_or("a step that adds or multiplies")?;
        if let Some(place) = step.place
            && !self.is_operation(step.name, &operands, &program.operations[place])
        {
            return Err("the operation of the program with its operands");
        }
        for term in &step.terms {
            let left = self.steps[term.left].support;
            let right = term.right.map_or(0, |right| self.steps[right].support);
            if left & right != 0 {
                return Err("factors without a variable in common");
            }
            step.support |= left | right;
        }
        let degree = self.degree(&step.terms[0]);
        for term in &step.terms {
            if 1 < degree || self.degree(term) != degree {
                return Err("terms that are all linear in parts, or all without one");
            }
        }
        let is_minor = step.name == "minor";
        if is_minor && !program.format.has_minor() {
            return Err("no minor in this format");
        }
        // In f64 a difference of products is rounded more than once.
        let rounds_often = is_minor && program.format.parameters != F32;
        step.rounds = step.place.is_some() && step.name != "neg" && !rounds_often;
        Ok(step)
    }

    /// True if steps stand for the operands of an operation with this name.
    fn is_operation(&self, name: &str, steps: &[usize], operation: &Operation) -> bool {
        let mut places = Vec::new();
        for step in steps {
            places.extend(self.steps[*step].place);
        }
        operation.name == name && operation.operands == places
    }

    /// How many factors of a term are linear in parts.
    fn degree(&self, term: &Term) -> usize {
        let linear = term.factors().filter(|step| self.is_linear(*step));
        linear.count()
    }
}

/// Adds a leaf to a sum of inputs.
fn add(sum: &mut [i64; INPUTS], leaf: Leaf, sign: i64) {
    sum[leaf.input] += sign;
    if let Some(less) = leaf.less {
        sum[less] -= sign;
    }
}

/// A number of the program, or the number 1 for the proof alone.
fn constant<'a>(mut step: Step<'a>, words: &[&str], program: &Program) -> Checked<'a> {
    const EXPECTED: &str = "the program's number";
    let &[word] = words else {
        return Err(EXPECTED);
    };
    step.constant = whole(word).ok_or(EXPECTED)?;
    let is_right = match step.place {
        Some(place) => {
            let operation = &program.operations[place];
            operation.name == "number" && operation.value == step.constant
        }
        None => step.constant == 1,
    };
    if !is_right {
        return Err(EXPECTED);
    }
    let size = Number::from(BigInt::from(step.constant.abs()));
    step.given = Some(Bound::exactly(&size));
    Ok(step)
}
