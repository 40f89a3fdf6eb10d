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

/// The facts x <= y (or x < y, if true) of a path about the sizes of some numbers, by their names.
fn facts<T: Copy>(path: &Path, name: impl Fn(Place) -> Option<T>) -> Vec<(T, T, bool)> {
    let of_size = |place: Place| match path.operations[place as usize] {
        Operation::Abs(inner) => name(inner),
        _ => None,
    };
    let fact = |(comparison, answer): &(Comparison, bool)| match (*comparison, *answer) {
        (Comparison::Less(a, b), true) => Some((a, b, true)),
        (Comparison::Less(a, b), false) => Some((b, a, false)),
        (Comparison::AtMost(a, b), true) => Some((a, b, false)),
        (Comparison::AtMost(a, b), false) => Some((b, a, true)),
        _ => None,
    };
    let named = |(a, b, strict): (Place, Place, bool)| Some((of_size(a)?, of_size(b)?, strict));
    path.decisions
        .iter()
        .filter_map(fact)
        .filter_map(named)
        .collect()
}

/// The facts about inputs. Nothing follows about computed numbers: one of them may be NaN, and the path compares them,
/// not the exact ones.
fn facts_of_inputs(path: &Path) -> Vec<(u8, u8, bool)> {
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
    (0..3)
        .filter(|k| (0..3).all(|other| follows(&facts, other, *k)))
        .collect()
}

/// True if a <= b follows from facts.
fn follows<T: Copy + PartialEq>(facts: &[(T, T, bool)], a: T, b: T) -> bool {
    let mut seen = vec![a];
    let is_new = |seen: &[T], (x, y, _): &(T, T, bool)| seen.contains(x) && !seen.contains(y);
    while let Some((_, next, _)) = facts.iter().find(|fact| is_new(&seen, fact)) {
        seen.push(*next);
    }
    seen.contains(&b)
}

/// True if the decisions of a path contradict each other, so that no input takes it.
pub fn is_impossible(path: &Path) -> bool {
    let facts = facts_of_inputs(path);
    facts
        .iter()
        .any(|(a, b, strict)| *strict && follows(&facts, *b, *a))
}
