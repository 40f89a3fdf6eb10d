//! The formula of a quotient: its last steps, and the roundings that are left out. See "Quotients" in the guide.

use super::super::operations::Term;
use super::{Formula, Step};
use num_traits::Zero;

impl Step {
    fn leave_out(&mut self) {
        self.rounds = false;
        self.left_out = true;
        if let Some(bound) = &mut self.given {
            bound.error.set_zero();
        }
    }
}

impl Formula<'_> {
    /// Leaves out the last rounding of numerator and of divisor, each if no other step uses it. It may be under negations,
    /// because a change of sign is exact.
    ///
    /// Such a rounding changes the quotient in proportion to it. The quotient's lemma adds that share by itself.
    pub fn leave_out_roundings(&mut self) {
        let mut uses = vec![0; self.steps.len()];
        for step in &self.steps {
            for operand in step.operands() {
                uses[operand] += 1;
            }
        }
        for operand in self.operands_of_quotient() {
            let inner = self.without_signs(operand, &uses);
            let step = &mut self.steps[inner];
            if step.rounds && uses[inner] == 1 {
                step.leave_out();
            }
        }
    }

    /// The step under negations that are used once.
    fn without_signs(&self, step: usize, uses: &[usize]) -> usize {
        let mut inner = step;
        while self.steps[inner].name == "neg" && uses[inner] == 1 {
            inner = self.steps[inner].terms[0].left;
        }
        inner
    }

    /// The steps that the last two use, n - q*d and q*d: numerator and divisor are among them. Two numerators are added up
    /// by a step that only the proof needs.
    fn operands_of_quotient(&self) -> Vec<usize> {
        let mut operands = Vec::new();
        for step in self.steps.iter().rev().take(2) {
            operands.extend(step.operands());
        }
        for operand in operands.clone() {
            let step = &self.steps[operand];
            if step.place.is_none() && step.name == "add" {
                operands.extend(step.operands());
            }
        }
        operands
    }

    /// True if the last rounding of an operation, which may be under negations, is left out.
    pub fn leaves_out(&self, place: usize) -> bool {
        let mut inner = place;
        while self.program.name(inner) == "neg" {
            inner = self.program.operands(inner)[0];
        }
        let is_it = |step: &Step| step.left_out && step.place == Some(inner);
        self.steps.iter().any(is_it)
    }

    /// True if the last step is n - quotient*d, where n is a numerator, the sum of two or, of none, the number 1, and no
    /// other step is without an operation.
    ///
    /// In exact arithmetic this step is 0, so its bound is one of the error of n* - quotient*d*.
    pub fn is_quotient_of(&self, numerators: &[usize], divisor: usize) -> bool {
        let Some((before, [quotient, product, last])) = self.steps.split_last_chunk() else {
            return false;
        };
        let [factors] = &product.terms[..] else {
            return false;
        };
        let [above, below] = &last.terms[..] else {
            return false;
        };
        let count = before.len();
        if (factors.left, below.left) != (count, count + 1) {
            return false;
        }
        let mut expected = vec![count, count + 1, count + 2];
        if numerators.len() != 1 {
            expected.insert(0, above.left);
        }
        let has_signs = !above.is_negative && below.is_negative;
        let right = factors.right.map(|right| self.steps[right].place);
        quotient.variables.len() == 1
            && is_alone(above)
            && is_alone(below)
            && has_signs
            && right == Some(Some(divisor))
            && self.is_numerator(above.left, numerators)
            && self.proof_only() == expected
    }

    /// True if a step is the numerator, the sum of both or, of none, the number 1.
    fn is_numerator(&self, step: usize, numerators: &[usize]) -> bool {
        let step = &self.steps[step];
        match numerators {
            [] => step.name == "number",
            [numerator] => step.place == Some(*numerator),
            _ => step.name == "add" && self.places(step) == numerators,
        }
    }

    /// The operations for which the operands of a step stand.
    pub fn places(&self, step: &Step) -> Vec<usize> {
        let mut places = Vec::new();
        for operand in step.operands() {
            places.extend(self.steps[operand].place);
        }
        places
    }

    /// The steps that stand for no operation.
    fn proof_only(&self) -> Vec<usize> {
        let mut found = Vec::new();
        for (k, step) in self.steps.iter().enumerate() {
            if step.place.is_none() {
                found.push(k);
            }
        }
        found
    }
}

/// True if a term is one number, not a product.
fn is_alone(term: &Term) -> bool {
    term.right.is_none()
}
