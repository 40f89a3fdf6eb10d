//! The steps of a formula, and how a line of one is checked against the program.

use super::super::{
    domain::{INPUTS, Leaf},
    format::{Bound, F32},
    number::{integer, whole},
    operations::{Term, index, indices, known_name, terms},
    variables::Variable,
};
use super::Formula;

/// A variable with its sign.
pub struct SignedVariable {
    pub is_negative: bool,
    pub variable: usize,
}

/// A step, and its summands: variables, a constant, and earlier steps.
#[derive(Default)]
pub struct Step {
    /// The operation that it stands for; none of steps that only a proof needs.
    pub place: Option<usize>,
    pub name: &'static str,
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

impl Step {
    /// The earlier steps that it uses.
    pub fn operands(&self) -> impl Iterator<Item = usize> {
        self.terms.iter().flat_map(Term::factors)
    }
}

/// A step, or the words that say what was expected in its place.
type Checked = Result<Step, &'static str>;

const UNKNOWN: &str = "an operation of the program";

/// The steps that a quotient's formula has for its proof alone.
const PROOF_ONLY: [&str; 5] = ["variables", "number", "add", "mul", "sub"];

impl Formula<'_> {
    /// The next step, from the words of its line.
    pub fn step(&self, words: &[&str]) -> Checked {
        let chunk = words.split_first_chunk();
        let (&[place, name], operands) = chunk.ok_or("more words")?;
        let is_for_proof = self.has_quotient && PROOF_ONLY.contains(&name);
        let mut step = Step {
            name: known_name(name).unwrap_or_default(),
            ..Step::default()
        };
        if place != "-" || !is_for_proof {
            let count = self.program.operations.len();
            let place = index(place, count).ok_or(UNKNOWN)?;
            step.place = Some(place);
        }
        match name {
            "variables" => self.sum_of_variables(step, operands),
            "number" => self.constant(step, operands),
            _ => self.sum_of_terms(step, operands),
        }
    }

    /// A sum of variables is a variable alone, which has a bound of its own, or a leaf.
    ///
    /// A difference of two inputs is rounded once, and it has the bound of that difference from the domain: the sum of
    /// variables is only another way to write its exact value.
    fn sum_of_variables(&self, mut step: Step, words: &[&str]) -> Checked {
        for word in words {
            let Some(signed) = self.signed_variable(word) else {
                return Err("variables, each with its sign");
            };
            step.support |= 1 << signed.variable;
            step.variables.push(signed);
        }
        if let Some(variable) = self.variable_alone(&step) {
            step.given = Some(variable.bound.clone());
            return Ok(step);
        }
        let Some(leaf) = self.leaf(&step) else {
            return Err("variables that are, or add up to, this operation");
        };
        let size = self.program.domain.bound(leaf);
        if leaf.less.is_some() {
            step.rounds = true;
            step.given = Some(self.program.format.rounded(size.clone(), size));
        } else if self.has_boxed(&step) {
            // The box of all points was moved, so a point itself is not where its variable is.
            return Err("a difference of points in a box");
        } else {
            step.given = Some(Bound::exactly(size));
        }
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

    fn has_boxed(&self, step: &Step) -> bool {
        let mut summands = step.variables.iter();
        summands.any(|signed| self.variables[signed.variable].is_boxed())
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

    /// The leaf that a step's operation is, if the variables add up to it, input by input.
    fn leaf(&self, step: &Step) -> Option<Leaf> {
        let leaf = self.program.leaf(step.place?)?;
        let mut left = [0; INPUTS];
        leaf.add_to(&mut left, -1);
        for signed in &step.variables {
            let summand = self.variables[signed.variable].leaf()?;
            let sign = if signed.is_negative { -1 } else { 1 };
            summand.add_to(&mut left, sign);
        }
        (left == [0; INPUTS]).then_some(leaf)
    }

    /// A sum of earlier steps or of their products.
    fn sum_of_terms(&self, mut step: Step, words: &[&str]) -> Checked {
        let operands = indices(words, self.steps.len()).ok_or("earlier steps")?;
        step.terms = terms(step.name, &operands).ok_or("a step that adds or multiplies")?;
        if !self.is_of_program(&step) {
            return Err("the operation of the program with its operands");
        }
        step.support = self.support(&step.terms)?;
        if !self.are_alike(&step.terms) {
            return Err("terms that are all linear in parts, or all without one");
        }
        let is_minor = step.name == "minor";
        if is_minor && !self.program.format.has_minor() {
            return Err("no minor in this format");
        }
        // In f64 a difference of products is rounded more than once.
        let rounds_often = is_minor && self.program.format.parameters != F32;
        let is_exact = step.place.is_none() || step.name == "neg";
        step.rounds = !is_exact && !rounds_often;
        Ok(step)
    }

    /// True if a step is for the proof alone, or its operands stand for those of its operation, in their order.
    fn is_of_program(&self, step: &Step) -> bool {
        let Some(place) = step.place else {
            return true;
        };
        let operation = &self.program.operations[place];
        operation.name == step.name && operation.operands == self.places(step)
    }

    /// The variables of all terms. The factors of a product have none in common, so each step is affine in each variable:
    /// "Formulas without divisions" in the guide.
    fn support(&self, terms: &[Term]) -> Result<usize, &'static str> {
        let mut all = 0;
        for term in terms {
            let mut of_term = 0;
            for factor in term.factors() {
                let support = self.steps[factor].support;
                if of_term & support != 0 {
                    return Err("factors without a variable in common");
                }
                of_term |= support;
            }
            all |= of_term;
        }
        Ok(all)
    }

    /// True if all terms have one factor that is linear in parts, or all have none. So a step that depends on the unit
    /// vector is linear in it: "Formulas that are linear in a unit vector" in the guide.
    fn are_alike(&self, terms: &[Term]) -> bool {
        let degree = self.degree(&terms[0]);
        let has_degree = |term: &Term| self.degree(term) == degree;
        degree <= 1 && terms.iter().all(has_degree)
    }

    /// How many factors of a term are linear in parts.
    fn degree(&self, term: &Term) -> usize {
        let linear = term.factors().filter(|step| self.is_linear(*step));
        linear.count()
    }

    /// A number of the program, or the number 1 for the proof alone.
    fn constant(&self, mut step: Step, words: &[&str]) -> Checked {
        const EXPECTED: &str = "the program's number";
        let &[word] = words else {
            return Err(EXPECTED);
        };
        let right = match step.place {
            Some(place) => self.program.number(place),
            None => Some(1),
        };
        step.constant = whole(word).ok_or(EXPECTED)?;
        if right != Some(step.constant) {
            return Err(EXPECTED);
        }
        let size = integer(step.constant.abs());
        step.given = Some(Bound::exactly(&size));
        Ok(step)
    }
}
