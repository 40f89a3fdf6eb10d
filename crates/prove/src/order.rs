//! The facts about a path's numbers that follow from its decisions.

use crate::arith::recorded::{Comparison, Operation, Place};
use crate::kernel::Path;

/// Without signs around it.
pub fn unsigned(path: &Path, place: Place) -> Place {
    match path.operations[place as usize] {
        Operation::Neg(inner) | Operation::Abs(inner) => unsigned(path, inner),
        _ => place,
    }
}

/// A fact about the sizes of two numbers: the first is at most the second, or less.
#[derive(Clone, Copy)]
struct Fact<T> {
    smaller: T,
    larger: T,
    is_strict: bool,
}

impl Fact<Place> {
    /// The fact that a decision states.
    fn of(comparison: Comparison, answer: bool) -> Option<Fact<Place>> {
        let (a, b, is_less) = match comparison {
            Comparison::Less(a, b) => (a, b, true),
            Comparison::AtMost(a, b) => (a, b, false),
            _ => return None,
        };
        let [smaller, larger] = if answer { [a, b] } else { [b, a] };
        Some(Fact {
            smaller,
            larger,
            is_strict: is_less == answer,
        })
    }

    /// The fact by the names of the numbers whose sizes it is about.
    fn named<T>(&self, path: &Path, name: impl Fn(Place) -> Option<T>) -> Option<Fact<T>> {
        let of_size = |place: Place| match path.operations[place as usize] {
            Operation::Abs(inner) => name(inner),
            _ => None,
        };
        Some(Fact {
            smaller: of_size(self.smaller)?,
            larger: of_size(self.larger)?,
            is_strict: self.is_strict,
        })
    }
}

/// The facts of a path about the sizes of some numbers, by their names.
fn facts<T>(path: &Path, name: impl Fn(Place) -> Option<T>) -> Vec<Fact<T>> {
    let mut facts = Vec::new();
    for (comparison, answer) in &path.decisions {
        let fact = Fact::of(*comparison, *answer);
        facts.extend(fact.and_then(|fact| fact.named(path, &name)));
    }
    facts
}

/// The facts about inputs. Nothing follows about computed numbers: one of them may be NaN, and the path compares them,
/// not the exact ones.
fn facts_of_inputs(path: &Path) -> Vec<Fact<u8>> {
    facts(path, |place| match path.operations[place as usize] {
        Operation::Input(i) => Some(i),
        _ => None,
    })
}

/// True if the size of an input is at most that of another, by the decisions of a path.
pub fn is_at_most(path: &Path, a: u8, b: u8) -> bool {
    follows(&facts_of_inputs(path), a, b)
}

/// The axes along which a computed vector has its largest coordinate, by the decisions of a path: one, none if they do
/// not say it, and all if no vector takes the path. Given which numbers are coordinates of that vector.
pub fn largest_axes(path: &Path, axis: impl Fn(Place) -> Option<usize>) -> Vec<usize> {
    let facts = facts(path, axis);
    let mut axes = vec![0, 1, 2];
    axes.retain(|axis| (0..3).all(|other| follows(&facts, other, *axis)));
    axes
}

/// True if a <= b follows from facts.
fn follows<T: Copy + PartialEq>(facts: &[Fact<T>], a: T, b: T) -> bool {
    let mut above = vec![a];
    loop {
        let is_new =
            |fact: &&Fact<T>| above.contains(&fact.smaller) && !above.contains(&fact.larger);
        match facts.iter().find(is_new) {
            Some(fact) => above.push(fact.larger),
            None => return above.contains(&b),
        }
    }
}

/// True if the decisions of a path contradict each other, so that no input takes it.
pub fn is_impossible(path: &Path) -> bool {
    let facts = facts_of_inputs(path);
    let is_contradicted =
        |fact: &Fact<u8>| fact.is_strict && follows(&facts, fact.larger, fact.smaller);
    facts.iter().any(is_contradicted)
}
