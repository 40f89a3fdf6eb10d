//! The formula of a lemma: its variables and steps.
//!
//! "Formulas without divisions" in the guide says why a formula bounds the error of a number.

mod bounds;
mod errors;
mod integers;
mod quotients;
mod steps;

use super::operations::{MOST_ROWS, index};
use super::program::Program;
use super::reader::{Outcome, Reader, ensure};
use super::variables::{self, Quotient, Variable};
use std::collections::HashSet;
use steps::Step;

/// The variables and the steps of a lemma.
pub struct Formula<'p> {
    program: &'p Program,
    variables: Vec<Variable>,
    /// The variables that are coordinates of one unit vector in which the last step is linear.
    unit: Vec<usize>,
    /// True if one of the variables is a quotient, whose rule has steps for the proof alone.
    has_quotient: bool,
    steps: Vec<Step>,
}

impl<'p> Formula<'p> {
    /// Reads a formula; with the quotient, in the lemmas that have one.
    pub fn read(
        program: &'p Program,
        quotient: Option<Quotient>,
        reader: &mut Reader,
    ) -> Outcome<Self> {
        let variables = variables::read(program, quotient, reader)?;
        let mut formula = Formula::of_variables(program, variables);
        formula.has_quotient = quotient.is_some();
        formula.read_steps(reader)?;
        ensure(
            formula.is_whole(),
            "found steps that the last one does not use, or none",
        )?;
        ensure(
            formula.unit.is_empty() || formula.is_linear(formula.steps.len() - 1),
            "found a last step without a part, expected one with parts",
        )?;
        if formula.has_quotient {
            formula.leave_out_roundings();
        }
        if reader.is_next("relative") {
            formula.read_relative(reader)?;
        }
        Ok(formula)
    }

    fn of_variables(program: &'p Program, variables: Vec<Variable>) -> Self {
        let mut unit = Vec::new();
        for (v, variable) in variables.iter().enumerate() {
            if variable.unit.is_some() {
                unit.push(v);
            }
        }
        Formula {
            program,
            variables,
            unit,
            has_quotient: false,
            steps: vec![],
        }
    }

    fn read_steps(&mut self, reader: &mut Reader) -> Outcome<()> {
        while reader.is_next("step") {
            let form = "step OPERATION KIND OPERANDS";
            let words = reader.read(form, |words| Some(words.to_vec()))?;
            let step = self.step(&words).map_err(|expected| {
                let line = words.join(" ");
                format!("found `step {line}`, expected {expected}")
            })?;
            self.steps.push(step);
            ensure(
                self.steps.len() <= MOST_ROWS,
                format!("found more than {MOST_ROWS} steps"),
            )?;
        }
        Ok(())
    }

    /// True if the last step uses all others: each of them is an operand of a later one.
    fn is_whole(&self) -> bool {
        let mut operands = HashSet::new();
        for step in &self.steps {
            operands.extend(step.operands());
        }
        operands.len() + 1 == self.steps.len()
    }

    /// Marks the steps whose errors are bounded by u times their exact value.
    fn read_relative(&mut self, reader: &mut Reader) -> Outcome<()> {
        let form = "relative STEPS, each an earlier one that rounds once";
        reader.read(form, |words| {
            for word in words {
                let place = index(word, self.steps.len())?;
                let step = &mut self.steps[place];
                if !step.rounds || step.relative {
                    return None;
                }
                step.relative = true;
            }
            Some(())
        })
    }

    /// The operation that the last step stands for.
    pub fn place(&self) -> Option<usize> {
        self.steps.last()?.place
    }

    /// True if a part is in a step.
    fn is_linear(&self, step: usize) -> bool {
        let support = self.steps[step].support;
        self.unit.iter().any(|v| support >> v & 1 == 1)
    }
}

#[cfg(test)]
mod tests;
