//! Names for the numbers of a guarded kernel, from what they are.

use crate::arith::Vector;
use crate::arith::recorded::{Operation, Place};
use crate::prove::repair::Guarded;
use crate::prove::{Leaf, Sample, run};
use std::collections::HashSet;

/// Inputs at which numbers show what they are.
const SAMPLE: [f64; 17] = [
    0.31, -0.72, 0.53, 0.94, 0.25, -0.46, 0.87, 0.18, -0.99, 0.21, 0.62, 0.13, -0.74, 0.35, 0.96,
    0.07, 1.68,
];

/// By place: the name of a number that is neither an input nor a whole number.
pub fn names(guarded: &Guarded) -> Vec<String> {
    let operations = &guarded.operations;
    let mut values = Vec::new();
    run(operations, operations.len() as Place - 1, &SAMPLE, &mut values);
    let known = known();
    let (mut taken, mut names) = (HashSet::new(), Vec::new());
    for (place, operation) in operations.iter().enumerate() {
        let is_known = |(_, value): &&(&str, f64)| {
            (values[place].abs() - value.abs()).abs() <= 1e-9 * value.abs()
        };
        let found = match Leaf::of(*operation, operations) {
            Some(Leaf::Difference(p, q, axis)) => {
                Some(format!("{}{}_{}", POINTS[q], POINTS[p], AXES[axis]))
            }
            Some(leaf) => Some(format!("{leaf:?}")),
            None => cross(operations, operation, &names)
                .or_else(|| known.iter().find(is_known).map(|(name, _)| (*name).to_owned())),
        };
        let stem = found.unwrap_or_else(|| "n".to_owned());
        let numbered = (1..).map(|i| format!("{stem}{i}"));
        let first = (stem != "n").then(|| stem.clone());
        let mut all = first.into_iter().chain(numbered);
        let name = all.find(|name| !taken.contains(name)).expect("names do not end");
        taken.insert(name.clone());
        names.push(name);
    }
    names
}

/// The origin and the vertices.
const POINTS: [&str; 4] = ["o", "a", "b", "c"];
/// The axes.
pub const AXES: [&str; 3] = ["x", "y", "z"];

/// The name of a coordinate of a cross product, of vectors with names.
fn cross(operations: &[Operation], operation: &Operation, names: &[String]) -> Option<String> {
    let Operation::Sub(p, q) = *operation else { return None };
    let factors = |place: Place| match operations[place as usize] {
        Operation::Mul(a, b) => Some([a, b].map(|place| vector(operations, place, names))),
        _ => None,
    };
    let ([Some((v, j)), Some((w, k))], [Some(x), Some(y)]) = (factors(p)?, factors(q)?) else {
        return None;
    };
    let is_turned = [&x, &y] == [&(v.clone(), k), &(w.clone(), j)]
        || [&y, &x] == [&(v.clone(), k), &(w.clone(), j)];
    (is_turned && (j + 1) % 3 == k).then(|| format!("{v}_{w}_{}", AXES[(k + 1) % 3]))
}

/// The vector's name and the axis, if a number is named as a coordinate.
fn vector(operations: &[Operation], place: Place, names: &[String]) -> Option<(String, usize)> {
    if let Some(Leaf::Direction(axis)) = Leaf::of(operations[place as usize], operations) {
        return Some(("d".to_owned(), axis));
    }
    let (stem, axis) = names.get(place as usize)?.rsplit_once('_')?;
    Some((stem.to_owned(), AXES.iter().position(|name| *name == axis)?))
}

/// The numbers that have names: weights of the vertices, the determinant, and t times it.
fn known() -> Vec<(&'static str, f64)> {
    let sample = Sample::of(&SAMPLE);
    let (det, t) = (sample.volume(), sample.time());
    let [u, v] = [1, 2].map(|vertex| sample.weight(vertex));
    vec![
        ("det", det),
        ("weight_of_a", sample.weight(0) * det),
        ("weight_of_b", u * det),
        ("weight_of_c", v * det),
        ("t_det", t * det),
        ("after_t_min", (t - SAMPLE[15]) * det),
        ("before_t_max", (SAMPLE[16] - t) * det),
        ("normal_square", sample.normal.dot(&sample.normal)),
        ("inv_det", 1.0 / det),
        ("t", t),
        ("u", u),
        ("v", v),
    ]
}
