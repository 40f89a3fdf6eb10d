//! The decisions of gates: which numbers are large enough, by each way to be accepted.

use super::Proof;
use super::meaning::{Meaning, Meanings, Scale, What};
use super::order::unsigned;
use super::watertight::{Unsigned, signed};
use crate::arith::recorded::{Comparison, Operation, Place};
use crate::contract::Sides;
use crate::kernel::{Acceptance, Compared, Path, Refuse};
use std::ops::Range;

/// A number on one side of what a gate compares it with.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Fact {
    pub program: usize,
    /// The number itself, without signs: two with one exact value may have programs that round in other ways.
    pub number: usize,
    pub what: What,
    pub scale: Scale,
    /// True if it says that what times scale is large enough; false if its negative is.
    pub is_plus: bool,
    pub is_strict: bool,
}

/// A gate, with each way to be accepted. If it refuses where N·d is positive, then one of the first numbers of `refuses` is below
/// the epsilon; where N·d is negative, one of the second. Without numbers it may refuse whatever they are.
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
    /// A gate, if all that it compares is known.
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
        let mut form = Form {
            gate,
            ways,
            refuses,
        };
        if !are_of_one_sign(form.facts()) {
            form.refuses = [None, None];
        }
        Some(form)
    }

    /// A number that is large enough.
    fn fact(&mut self, gate: usize, place: Place, is_strict: bool) -> Option<Fact> {
        let Unsigned { is_negative, place } = signed(self.path, place);
        // The error of |x| is no larger than that of x.
        let bare = unsigned(self.path, place);
        let program = *self.proof.programs.get(&(gate, self.index, bare))?;
        let Meaning {
            number,
            what,
            scale,
            is_minus,
        } = self.meanings.of(self.index, place)?;
        Some(Fact {
            program,
            number,
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

impl Form {
    /// True if it compares nothing but barycentric coordinates.
    pub fn is_of_weights(&self) -> bool {
        self.facts()
            .all(|fact| matches!(fact.what, What::Weight(_) | What::Rest(_)))
    }

    /// All that is known of numbers where it accepts or refuses.
    pub fn facts(&self) -> impl Iterator<Item = &Fact> {
        let refused = self.refuses.iter().flatten().flatten();
        self.ways.iter().flatten().chain(refused)
    }
}

impl Fact {
    fn negative(self) -> Fact {
        Fact {
            is_plus: !self.is_plus,
            ..self
        }
    }

    /// True if the sign of the number depends on which side of the triangle the ray meets.
    pub fn has_sign(&self) -> bool {
        self.what != What::Size && self.scale.has_sign()
    }

    /// True if, where the scale is positive, or negative, it says that `what` itself is large, and not its negative. A scale
    /// without a sign is positive in both.
    pub fn is_side(&self, is_positive: bool) -> bool {
        self.is_plus == (is_positive || !self.has_sign())
    }
}

/// True if the signs of all scales follow from one of them: that of N·d/d_k depends on d_k too.
pub fn are_of_one_sign<'a>(facts: impl Iterator<Item = &'a Fact>) -> bool {
    let axis = |fact: &Fact| match fact.scale {
        Scale::Over(axis) => Some(axis),
        _ => None,
    };
    let mut axes = facts.filter(|fact| fact.has_sign()).map(axis);
    let first = axes.next();
    axes.all(|axis| Some(axis) == first)
}

/// The sides on which hits are owed, as indices of what a gate [refuses](Form::refuses).
pub fn wanted_sides(facts: impl Iterator<Item = Fact>, sides: Sides) -> Range<usize> {
    let signed: Vec<Fact> = facts.filter(Fact::has_sign).collect();
    let is_turned = signed
        .iter()
        .any(|fact| matches!(fact.scale, Scale::Over(_)));
    match sides {
        _ if signed.is_empty() => 0..1,
        // Met from the front, N·d is negative.
        Sides::Front if !is_turned => 1..2,
        _ => 0..2,
    }
}
