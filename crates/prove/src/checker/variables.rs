//! The variables of a formula.

use super::number::{Bound, Number, shifted};
use super::program::{Leaf, MOST_ROWS, Program, Unit, indices};
use super::reader::{Outcome, Reader, ensure};

/// Each variable has a bit.
const MOST_VARIABLES: usize = 32;

/// A variable: a leaf, a number with a lemma, or else the quotient that the lemma is about.
#[derive(Default)]
pub struct Variable {
    pub leaf: Option<Leaf>,
    pub cut: Option<usize>,
    pub bound: Bound,
    /// The coordinate and the length, if it is a coordinate of the unit vector in which the formula is linear.
    pub part: Option<Unit>,
    /// How far below zero it may be, if that is less than its size.
    pub down_to: Option<Number>,
    /// True if it is a coordinate of a point in a box of all points.
    pub is_boxed: bool,
}

/// The quotient that a lemma is about: its size, and how far below zero it may be.
#[derive(Clone, Copy)]
pub struct Quotient<'n> {
    pub size: &'n Number,
    pub down_to: Option<&'n Number>,
}

/// The variable that a line describes after its first word, without its bound; and whether it is a part.
fn described(words: &[&str], in_quotient: bool) -> Option<(Variable, bool)> {
    let (kind, words) = words.split_first()?;
    let point = |p: usize, axis: usize| if p == 0 { axis } else { 3 + 3 * p + axis };
    let (leaf, cut) = match (*kind, &indices(words, MOST_ROWS)?[..]) {
        ("point" | "boxed", &[p @ 0..4, axis @ 0..3]) => (Some((point(p, axis), None)), None),
        ("difference", &[p @ 0..4, q @ 0..4, axis @ 0..3]) => {
            (Some((point(p, axis), Some(point(q, axis)))), None)
        }
        ("direction", &[axis @ 0..3]) => (Some((3 + axis, None)), None),
        ("end", &[end @ 0..2]) => (Some((15 + end, None)), None),
        ("cut" | "part", &[place]) => (None, Some(place)),
        ("quotient", &[]) if in_quotient => (None, None),
        _ => return None,
    };
    let is_boxed = *kind == "boxed";
    Some((
        Variable {
            leaf,
            cut,
            is_boxed,
            ..Variable::default()
        },
        *kind == "part",
    ))
}

/// With the quotient, in the lemmas that have one.
pub fn read(
    program: &Program,
    quotient: Option<Quotient>,
    reader: &mut Reader,
) -> Outcome<Vec<Variable>> {
    let mut variables: Vec<Variable> = Vec::new();
    // The component of each input, and of the ground under them, in the graph of the leaves.
    let mut components: [usize; 18] = std::array::from_fn(|i| i);
    while reader.is_next("variable") {
        let form = "variable point P AXIS, difference P Q AXIS, boxed P AXIS, direction AXIS, end N, cut OPERATION, \
                    part OPERATION or, in the rules of quotients, quotient";
        let described = reader.read(form, |words| described(words, quotient.is_some()))?;
        let (mut variable, is_part) = described;
        if let Some((i, j)) = variable.leaf {
            // What is known of the input's component, or of both.
            let (from, to) = (components[i], components[j.unwrap_or(17)]);
            components
                .iter_mut()
                .filter(|c| **c == from)
                .for_each(|c| *c = to);
            let expected =
                "found a variable that follows from those above, expected an independent one";
            ensure(from != to, expected)?;
            let size = program.domain.bound((i, j));
            variable.bound = match variable.is_boxed {
                true => Bound::exactly(&shifted(program.domain.largest_difference(), -1)),
                false => Bound::exactly(size),
            };
        } else if let Some(place) = variable.cut {
            variable.bound = program.bound(place)?.clone();
            if is_part {
                variable.part = program.lemma(place)?.unit;
                let mut others = variables.iter().filter_map(|v| v.part);
                let is_fit = |(of, length)| others.all(|(o, l)| o != of && l == length);
                ensure(
                    variable.part.is_some_and(is_fit),
                    "found another number, expected different coordinates of one unit vector",
                )?;
            }
        } else {
            let Quotient { size, down_to } = quotient.ok_or("found a quotient, expected none")?;
            variable.bound = Bound::exactly(size);
            variable.down_to = down_to.cloned();
        }
        variables.push(variable);
        let is_fair = variables.len() <= MOST_VARIABLES;
        ensure(
            is_fair,
            format!("found more than {MOST_VARIABLES} variables"),
        )?;
    }
    // A point in the box is where the box was moved to, not where it is.
    let is_point = |v: &Variable| matches!(v.leaf, Some((0..3 | 6..15, None)));
    let is_mixed = variables.iter().any(|v| v.is_boxed)
        && variables.iter().any(|v| is_point(v) && !v.is_boxed);
    ensure(
        !is_mixed,
        "found points in a box and points as they are, expected one of both",
    )?;
    Ok(variables)
}
