//! Sums that are rearranged, on the tape.

use super::{Operation, Place, Recorded, on_tape, push};
use crate::arith::rearranged::{self, MadeOf, Operand, Rest};

/// A number on the tape, or the negative of one.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) struct Signed {
    is_minus: bool,
    place: Place,
}

impl Operand for Signed {
    fn is_the_same_as(self, other: Self) -> bool {
        self == other
    }

    fn negation(self) -> Self {
        Signed {
            is_minus: !self.is_minus,
            ..self
        }
    }
}

impl Signed {
    /// The number of a place; one that is a negative there is told as such.
    pub(super) fn of(place: Place) -> Signed {
        let inner = on_tape(|tape| match tape.operations[place as usize] {
            Operation::Neg(inner) => Some(inner),
            _ => None,
        });
        Signed {
            is_minus: inner.is_some(),
            place: inner.unwrap_or(place),
        }
    }

    /// The sum or product that it is.
    fn made_of(self) -> MadeOf<Signed> {
        if self.is_minus {
            return MadeOf::Other;
        }
        match on_tape(|tape| tape.operations[self.place as usize]) {
            Operation::Add(a, b) => MadeOf::Sum(Signed::of(a), Signed::of(b)),
            Operation::Sub(a, b) => MadeOf::Sum(Signed::of(a), Signed::of(b).negation()),
            Operation::Mul(a, b) => MadeOf::Product(Signed::of(a), Signed::of(b)),
            _ => MadeOf::Other,
        }
    }

    fn recorded(self) -> Recorded {
        match self.is_minus {
            true => Recorded::at(Operation::Neg(self.place)),
            false => Recorded::of_place(self.place),
        }
    }
}

/// The replacement of a sum, if the tape's arithmetic rearranges it.
pub(super) fn rearranged(terms: [Signed; 2]) -> Option<Recorded> {
    if !on_tape(|tape| tape.arithmetic.rearranged) {
        return None;
    }
    let rest = rearranged::rearranged(terms.map(|term| (term, term.made_of())))?;
    Some(match rest {
        Rest::Term(term) => term.recorded(),
        Rest::Product { terms, factor } => {
            let [a, b, factor] = [terms[0], terms[1], factor].map(|it| it.recorded().place);
            let sum = push(Operation::Add(a, b));
            Recorded::at(Operation::Mul(sum, factor))
        }
    })
}
