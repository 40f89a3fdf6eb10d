//! Names for the numbers of a guarded kernel, from what they are: a coordinate, the determinant, a weight of a vertex.

use crate::arith::Vector;
use crate::arith::recorded::{Operation, Place};
use crate::prove::repair::Guarded;
use crate::prove::{Leaf, Sample, run};

/// Inputs at which numbers show what they are.
const SAMPLE: [f64; 17] = [
    0.31, -0.72, 0.53, 0.94, 0.25, -0.46, 0.87, 0.18, -0.99, 0.21, 0.62, 0.13, -0.74, 0.35, 0.96,
    0.07, 1.68,
];

/// By place: the name of a number that is neither an input nor a whole number.
pub fn names(guarded: &Guarded) -> Vec<String> {
    let operations = &guarded.operations;
    let mut values = Vec::new();
    run(operations, &SAMPLE, &mut values);
    let known = known();
    let mut names = Vec::new();
    for (operation, value) in operations.iter().zip(values) {
        let meaning = match Leaf::of(*operation, operations) {
            Some(Leaf::Difference(p, q, axis)) => {
                Some(format!("{}{}_{}", POINTS[q], POINTS[p], AXES[axis]))
            }
            Some(leaf) => Some(format!("{leaf:?}")),
            None => cross(operations, operation, &names).or_else(|| named_by_value(&known, value)),
        };
        names.push(free_name(meaning, &names));
    }
    names
}

/// The known number that is a value, but for its sign and for rounding.
fn named_by_value(known: &[(&str, f64)], value: f64) -> Option<String> {
    let is_equal = |known: f64| (value.abs() - known.abs()).abs() <= 1e-9 * known.abs();
    let (name, _) = known.iter().find(|(_, known)| is_equal(*known))?;
    Some((*name).to_owned())
}

/// A name that is not taken: the number's meaning, with a number behind it if need be.
fn free_name(meaning: Option<String>, taken: &[String]) -> String {
    let stem = match meaning {
        Some(name) if !taken.contains(&name) => return name,
        Some(name) => name,
        None => "n".to_owned(),
    };
    let mut numbered = (1..).map(|i| format!("{stem}{i}"));
    let free = numbered.find(|name| !taken.contains(name));
    free.expect("names do not end")
}

/// The origin and the vertices.
const POINTS: [&str; 4] = ["o", "a", "b", "c"];

/// The axes.
pub(super) const AXES: [&str; 3] = ["x", "y", "z"];

/// The name of a coordinate of a cross product: v_j·w_k - v_k·w_j, of vectors with names.
fn cross(operations: &[Operation], operation: &Operation, names: &[String]) -> Option<String> {
    let Operation::Sub(p, q) = *operation else {
        return None;
    };
    let products = [p, q].map(|place| operations[place as usize]);
    let [Operation::Mul(a, b), Operation::Mul(c, d)] = products else {
        return None;
    };
    let named = |place| coordinate(operations, place, names);
    let ((v, j), (w, k)) = (named(a)?, named(b)?);
    let (x, y) = (named(c)?, named(d)?);
    let exchanged = [(v.clone(), k), (w.clone(), j)];
    let is_minor = exchanged == [x.clone(), y.clone()] || exchanged == [y, x];
    (is_minor && (j + 1) % 3 == k).then(|| format!("{v}_{w}_{}", AXES[(k + 1) % 3]))
}

/// The vector's name and the axis, if a number is named as a coordinate.
fn coordinate(operations: &[Operation], place: Place, names: &[String]) -> Option<(String, usize)> {
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
