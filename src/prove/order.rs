//! What the decisions of a path say about its numbers.

use crate::arith::recorded::{Comparison, Operation, Place};
use crate::kernel::Path;

/// Without signs around it.
pub fn unsigned(path: &Path, place: Place) -> Place {
    match path.operations[place as usize] {
        Operation::Neg(inner) | Operation::Abs(inner) => unsigned(path, inner),
        _ => place,
    }
}

/// The facts x <= y (or x < y, if true) of a path about sizes of inputs. Of computed numbers nothing
/// follows: one of them may be NaN, and the path compares them, not the exact ones.
fn facts(path: &Path) -> Vec<(Place, Place, bool)> {
    let operation = |place: Place| path.operations[place as usize];
    let is_size = |place: Place| match operation(place) {
        Operation::Abs(inner) => matches!(operation(inner), Operation::Input(_)),
        _ => false,
    };
    let fact = |(comparison, answer): &(Comparison, bool)| match (*comparison, *answer) {
        (Comparison::Less(a, b), true) => Some((a, b, true)),
        (Comparison::Less(a, b), false) => Some((b, a, false)),
        (Comparison::AtMost(a, b), true) => Some((a, b, false)),
        (Comparison::AtMost(a, b), false) => Some((b, a, true)),
        _ => None,
    };
    path.decisions.iter().filter_map(fact).filter(|(a, b, _)| is_size(*a) && is_size(*b)).collect()
}

/// Whether a <= b follows from the decisions.
pub fn follows(path: &Path, a: Place, b: Place) -> bool {
    let facts = facts(path);
    let mut seen = vec![a];
    let mut i = 0;
    while i < seen.len() {
        if seen[i] == b {
            return true;
        }
        let from = seen[i];
        for (_, y, _) in facts.iter().filter(|(x, _, _)| *x == from) {
            if !seen.contains(y) {
                seen.push(*y);
            }
        }
        i += 1;
    }
    false
}

/// Whether the decisions of a path contradict each other, so that no input takes it.
pub fn is_impossible(path: &Path) -> bool {
    facts(path).iter().any(|(a, b, strict)| *strict && follows(path, *b, *a))
}
