//! The decisions of edge gates: which weights are large enough, by each way to be accepted.

use super::Proof;
use super::meaning::{Meaning, Meanings, Scale, What};
use super::watertight::{Unsigned, signed};
use crate::arith::recorded::{Comparison, Operation, Place};
use crate::kernel::{Acceptance, Compared, Path, Refuse};

/// A number on one side of what a gate compares it with.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Fact {
    pub program: usize,
    pub what: What,
    pub scale: Scale,
    /// True if it says that what times scale is large enough; false if that its negative is.
    pub is_plus: bool,
    pub is_strict: bool,
}

/// An edge gate: each way to be accepted, and for either sign of the scale the numbers of which one is too small where it
/// refuses; none if it may refuse although all are large.
#[derive(Clone, PartialEq, Eq, Hash)]
pub struct Form {
    pub gate: usize,
    pub ways: Vec<Vec<Fact>>,
    pub refuses: [Option<Vec<Fact>>; 2],
}

/// Reads what the gates of one path compare.
pub struct Reader<'a, 'b> {
    pub proof: &'a Proof,
    pub index: usize,
    pub path: &'a Path,
    pub meanings: &'b mut Meanings<'a>,
}

impl Reader<'_, '_> {
    /// An edge gate, if all that it compares is known.
    pub fn form(&mut self, compared: &Compared) -> Option<Form> {
        let gate = compared.gate;
        let (ways, refuses) = match &compared.accepts {
            Acceptance::Fixed(..) => return None,
            Acceptance::Clauses(refuse, clauses) => {
                let is_strict = matches!(refuse, Refuse::AtMost | Refuse::UnlessAbove);
                let mut ways = Vec::new();
                for places in clauses {
                    let facts = places.iter();
                    let facts = facts.map(|place| self.fact(gate, *place, is_strict));
                    ways.push(facts.collect::<Option<Vec<Fact>>>()?);
                }
                let refuses = [true, false].map(|side| {
                    let is_side = |way: &&Vec<Fact>| way.iter().all(|fact| fact.is_side(side));
                    ways.iter().find(is_side).cloned()
                });
                (ways, refuses)
            }
            Acceptance::Rounded(outcomes) => {
                let mut ways = Vec::new();
                let mut refusals = Vec::new();
                for outcome in outcomes {
                    let answers = outcome.answers.iter();
                    let facts = answers.map(|answer| self.facts(gate, *answer));
                    let facts = facts.collect::<Option<Vec<_>>>()?.concat();
                    let kind = if outcome.accepts {
                        &mut ways
                    } else {
                        &mut refusals
                    };
                    kind.push(facts);
                }
                let refuses = [true, false].map(|side| {
                    // Each refusal takes a number that is not on this side.
                    let against = |way: &Vec<Fact>| {
                        let fact = way.iter().find(|fact| !fact.is_side(side));
                        fact.map(|fact| fact.negative())
                    };
                    refusals.iter().map(against).collect()
                });
                (ways, refuses)
            }
        };
        Some(Form {
            gate,
            ways,
            refuses,
        })
    }

    /// A number that is large enough.
    fn fact(&mut self, gate: usize, place: Place, is_strict: bool) -> Option<Fact> {
        let Unsigned { is_negative, place } = signed(self.path, place);
        let program = *self.proof.programs.get(&(gate, self.index, place))?;
        let Meaning {
            what,
            scale,
            is_minus,
        } = self.meanings.of(self.index, place)?;
        let is_weight = matches!(what, What::Weight(_) | What::Rest(_));
        is_weight.then_some(Fact {
            program,
            what,
            scale,
            is_plus: is_negative == is_minus,
            is_strict,
        })
    }

    /// The facts that an answer to a comparison with 0 is.
    fn facts(
        &mut self,
        gate: usize,
        (comparison, answer): (Comparison, bool),
    ) -> Option<Vec<Fact>> {
        let is_zero = |place: Place| {
            let unsigned = signed(self.path, place).place;
            self.path.operations[unsigned as usize] == Operation::Number(0)
        };
        // x >= 0 or x > 0 where it is large.
        let (place, is_large, is_strict) = match (comparison, answer) {
            (Comparison::Less(a, b), _) if is_zero(a) => (b, answer, answer),
            (Comparison::Less(a, b), _) if is_zero(b) => (a, !answer, answer),
            (Comparison::AtMost(a, b), _) if is_zero(a) => (b, answer, !answer),
            (Comparison::AtMost(a, b), _) if is_zero(b) => (a, !answer, !answer),
            (Comparison::Negative(a), _) => (a, !answer, false),
            _ => return None,
        };
        if is_zero(place) {
            return Some(Vec::new());
        }
        let fact = self.fact(gate, place, is_strict)?;
        Some(vec![if is_large { fact } else { fact.negative() }])
    }
}

impl Fact {
    fn negative(self) -> Fact {
        Fact {
            is_plus: !self.is_plus,
            ..self
        }
    }

    /// True if it says that λ is large, where the scale is positive, or negative.
    pub fn is_side(&self, is_positive: bool) -> bool {
        self.is_plus == is_positive
    }
}
