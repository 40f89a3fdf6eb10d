//! The variables of a formula.

use super::edges::{Third, third};
use super::number::{Bound, Number, shifted};
use super::program::{Leaf, MOST_ROWS, Operation, Program, Unit, indices};
use super::reader::{Outcome, Reader, ensure};

/// Each variable has a bit.
const MOST_VARIABLES: usize = 32;

/// A variable: a leaf, a number with a lemma, a quotient of a third edge, or else the quotient that the lemma is
/// about.
pub struct Variable {
    pub leaf: Option<Leaf>,
    pub cut: Option<usize>,
    pub bound: Bound,
    /// The coordinate and the length, if it is a coordinate of the unit vector in which the formula is linear.
    pub part: Option<Unit>,
    pub third: Option<Third>,
    /// How far below zero it may be, if that is less than its size.
    pub down_to: Option<Number>,
    /// True if it is a coordinate of a point in a box of all points.
    pub is_boxed: bool,
    /// The box that is enough for the effects of errors, if the program divides it by the lemma's divisor too.
    pub narrow: Option<Number>,
}

/// The quotient that a lemma is about: its size, how far below zero it may be, its divisor, and the least size of that.
#[derive(Clone, Copy)]
pub struct Quotient<'n> {
    pub size: &'n Number,
    pub down_to: Option<&'n Number>,
    pub divisor: usize,
    pub floor: &'n Number,
}

enum Kind {
    Leaf(Leaf, Option<usize>),
    Boxed(usize),
    Cut(usize),
    Part(usize),
    Third(usize, usize),
    Quotient,
}

/// The variable that a line describes after its first word.
fn kind(words: &[&str], in_quotient: bool) -> Option<Kind> {
    let (words, over) = match words {
        [words @ .., "over", ratio] if in_quotient => {
            (words, Some(indices(&[ratio], MOST_ROWS)?[0]))
        }
        _ => (words, None),
    };
    let (kind, words) = words.split_first()?;
    let point = |p: usize, axis: usize| if p == 0 { axis } else { 3 + 3 * p + axis };
    let kind = match (*kind, &indices(words, MOST_ROWS)?[..]) {
        ("point", &[p @ 0..4, axis @ 0..3]) => Kind::Leaf((point(p, axis), None), over),
        ("difference", &[p @ 0..4, q @ 0..4, axis @ 0..3]) => {
            Kind::Leaf((point(p, axis), Some(point(q, axis))), over)
        }
        ("boxed", &[p @ 0..4, axis @ 0..3]) => Kind::Boxed(point(p, axis)),
        ("direction", &[axis @ 0..3]) => Kind::Leaf((3 + axis, None), over),
        ("end", &[end @ 0..2]) => Kind::Leaf((15 + end, None), over),
        ("cut", &[place]) => Kind::Cut(place),
        ("part", &[place]) => Kind::Part(place),
        ("third", &[first, second]) if !in_quotient => Kind::Third(first, second),
        ("quotient", &[]) if in_quotient => Kind::Quotient,
        _ => return None,
    };
    (over.is_none() || matches!(kind, Kind::Leaf(..))).then_some(kind)
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
        let form = "variable point P AXIS, difference P Q AXIS, direction AXIS, end N, boxed P AXIS, cut OPERATION, \
                    part OPERATION, in the rule of sums third OPERATION OPERATION, or, in the rules of \
                    quotients, quotient, or one of the first four and over OPERATION";
        let kind = reader.read(form, |words| kind(words, quotient.is_some()))?;
        let mut variable = Variable {
            leaf: None,
            cut: None,
            bound: Bound::exactly(&Number::default()),
            part: None,
            third: None,
            down_to: None,
            is_boxed: false,
            narrow: None,
        };
        // What is known of the input's component, or of both.
        let mut join = |(i, j): Leaf| {
            let (from, to) = (components[i], components[j.unwrap_or(17)]);
            components.iter_mut().filter(|c| **c == from).for_each(|c| *c = to);
            let expected =
                "found a variable that follows from those above, expected an independent one";
            ensure(from != to, expected)
        };
        match kind {
            Kind::Leaf(leaf, over) => {
                join(leaf)?;
                let size = program.domain.bound(leaf);
                variable.leaf = Some(leaf);
                variable.bound = Bound::exactly(size);
                if let (Some(ratio), Some(quotient)) = (over, quotient) {
                    let is_fit = is_ratio(program, ratio, leaf, quotient.divisor);
                    ensure(
                        is_fit,
                        "found another operation, expected the variable over the divisor",
                    )?;
                    let narrow = quotient.floor * program.most(ratio);
                    variable.narrow = Some(narrow.min(size.clone()));
                }
            }
            Kind::Boxed(input) => {
                join((input, None))?;
                variable.leaf = Some((input, None));
                variable.is_boxed = true;
                variable.bound = Bound::exactly(&shifted(program.domain.largest_difference(), -1));
            }
            Kind::Cut(place) => {
                variable.cut = Some(place);
                variable.bound = program.bound(place)?.clone();
            }
            Kind::Part(place) => {
                variable.cut = Some(place);
                variable.bound = program.bound(place)?.clone();
                variable.part = program.lemma(place)?.unit;
                let mut others = variables.iter().filter_map(|v| v.part);
                let is_fit = |(of, length)| others.all(|(o, l)| o != of && l == length);
                ensure(
                    variable.part.is_some_and(is_fit),
                    "found another number, expected different coordinates of one unit vector",
                )?;
            }
            Kind::Third(first, second) => {
                let known = [first, second].iter().all(|place| *place < program.operations.len());
                let found = if known { third(program, first, second)? } else { None };
                let found = found
                    .ok_or("found other numbers, expected quotients of two edges by one area")?;
                variable.bound = Bound::exactly(&found.size);
                variable.third = Some(found);
            }
            Kind::Quotient => {
                let quotient = quotient.ok_or("found a quotient, expected none")?;
                variable.bound = Bound::exactly(quotient.size);
                variable.down_to = quotient.down_to.cloned();
            }
        }
        variables.push(variable);
        let is_fair = variables.len() <= MOST_VARIABLES;
        ensure(is_fair, format!("found more than {MOST_VARIABLES} variables"))?;
    }
    // A point in the box is where the box was moved to, not where it is.
    let is_point = |v: &Variable| matches!(v.leaf, Some((0..3 | 6..15, None)));
    let is_mixed = variables.iter().any(|v| v.is_boxed)
        && variables.iter().any(|v| is_point(v) && !v.is_boxed);
    ensure(!is_mixed, "found points in a box and points as they are, expected one of both")?;
    Ok(variables)
}

/// True if an operation is the quotient of a leaf, or of its negative, and a divisor.
fn is_ratio(program: &Program, place: usize, (i, j): Leaf, divisor: usize) -> bool {
    let Some(Operation { name: "div", operands, .. }) = program.operations.get(place) else {
        return false;
    };
    let mut numerator = operands[0];
    while program.operations[numerator].name == "neg" {
        numerator = program.operations[numerator].operands[0];
    }
    let reversed = j.map(|j| (j, Some(i)));
    let leaf = program.leaf(numerator);
    operands[1] == divisor && leaf.is_some() && (leaf == Some((i, j)) || leaf == reversed)
}
