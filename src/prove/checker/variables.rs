//! The variables of a formula.

use super::number::{Bound, Number};
use super::program::{Leaf, MOST_ROWS, Program, indices};
use super::reader::{Outcome, Reader, ensure};

/// A formula of n variables has 2^n corners.
const MOST_VARIABLES: usize = 18;

/// A variable: a leaf, a number with a lemma, or else the quotient that the lemma is about.
pub struct Variable {
    pub leaf: Option<Leaf>,
    pub cut: Option<usize>,
    pub bound: Bound,
    /// The coordinate and the length, if it is a coordinate of the unit vector in which the formula is linear.
    pub part: Option<(usize, usize)>,
}

/// The quotient is at most `quotient`, in the lemmas that have one.
pub fn read(
    program: &Program,
    quotient: Option<&Number>,
    reader: &mut Reader,
) -> Outcome<Vec<Variable>> {
    let mut variables: Vec<Variable> = Vec::new();
    // The component of each input, and of the ground under them, in the graph of the leaves.
    let mut components: [usize; 18] = std::array::from_fn(|i| i);
    while reader.is_next("variable") {
        let form = "variable point P AXIS, difference P Q AXIS, direction AXIS, end N, cut OPERATION, \
                    part OPERATION or, in the rules of quotients, quotient";
        let (leaf, cut, is_part) = reader.read(form, |words| {
            let (kind, words) = words.split_first()?;
            let point = |p: usize, axis: usize| if p == 0 { axis } else { 3 + 3 * p + axis };
            let leaf = |i: usize, j: Option<usize>| (Some((i, j)), None, false);
            Some(match (*kind, &indices(words, MOST_ROWS)?[..]) {
                ("point", &[p @ 0..4, axis @ 0..3]) => leaf(point(p, axis), None),
                ("difference", &[p @ 0..4, q @ 0..4, axis @ 0..3]) => {
                    leaf(point(p, axis), Some(point(q, axis)))
                }
                ("direction", &[axis @ 0..3]) => leaf(3 + axis, None),
                ("end", &[end @ 0..2]) => leaf(15 + end, None),
                ("cut" | "part", &[place]) => (None, Some(place), *kind == "part"),
                ("quotient", &[]) => quotient.map(|_| (None, None, false))?,
                _ => return None,
            })
        })?;
        let bound = match (leaf, cut) {
            (Some(leaf), _) => {
                let (from, to) = (components[leaf.0], components[leaf.1.unwrap_or(17)]);
                ensure(
                    from != to,
                    "found a variable that follows from those above, expected an independent one",
                )?;
                components.iter_mut().filter(|c| **c == from).for_each(|c| *c = to);
                Bound::exactly(program.domain.bound(leaf))
            }
            (_, Some(place)) => program.bound(place)?.clone(),
            _ => quotient.map(Bound::exactly).ok_or("found a quotient, expected none")?,
        };
        let mut part = None;
        if let Some(place) = cut.filter(|_| is_part) {
            part = program.lemma(place)?.unit;
            let mut others = variables.iter().filter_map(|v| v.part);
            let is_fit = |(of, length)| others.all(|(o, l)| o != of && l == length);
            ensure(
                part.is_some_and(is_fit),
                "found another number, expected different coordinates of one unit vector",
            )?;
        }
        variables.push(Variable { leaf, cut, bound, part });
        let is_fair = variables.len() <= MOST_VARIABLES;
        ensure(is_fair, format!("found more than {MOST_VARIABLES} variables"))?;
    }
    Ok(variables)
}
