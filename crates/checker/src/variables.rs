//! The variables of a formula.

use super::domain::{Leaf, is_of_point};
use super::format::Bound;
use super::number::{Number, shifted};
use super::operations::{MOST_ROWS, indices};
use super::program::{Program, Unit};
use super::reader::{Outcome, Reader, ensure};
use std::array::from_fn;

/// Each variable has a bit.
const MOST_VARIABLES: usize = 32;

/// The ground under all inputs, in the graph of the leaves.
const GROUND: usize = 17;

/// The meaning of a variable.
#[derive(Clone, Copy)]
enum Kind {
    Leaf(Leaf),
    /// A coordinate of a point in the box of all points.
    Boxed(Leaf),
    /// An operation with a lemma.
    Cut(usize),
    /// An operation with a lemma that is a coordinate of a unit vector.
    Part(usize),
    /// The quotient that the lemma is about.
    Quotient,
}

/// A variable and its bound.
pub struct Variable {
    kind: Kind,
    pub bound: Bound,
    /// Set if it is a coordinate of the unit vector in which the formula is linear.
    pub unit: Option<Unit>,
    /// How far below zero it may be, if that is less than its size.
    pub down_to: Option<Number>,
}

impl Variable {
    pub fn leaf(&self) -> Option<Leaf> {
        match self.kind {
            Kind::Leaf(leaf) | Kind::Boxed(leaf) => Some(leaf),
            _ => None,
        }
    }

    /// The operation that it stands for.
    pub fn place(&self) -> Option<usize> {
        match self.kind {
            Kind::Cut(place) | Kind::Part(place) => Some(place),
            _ => None,
        }
    }

    pub fn is_boxed(&self) -> bool {
        matches!(self.kind, Kind::Boxed(_))
    }

    /// True if it is a coordinate of a point as it is.
    fn is_point(&self) -> bool {
        match self.kind {
            Kind::Leaf(leaf) => leaf.less.is_none() && is_of_point(leaf.input),
            _ => false,
        }
    }
}

/// The quotient that a lemma is about: its size, and how far below zero it may be.
#[derive(Clone, Copy)]
pub struct Quotient<'n> {
    pub size: &'n Number,
    pub down_to: Option<&'n Number>,
}

/// The inputs and the ground under them. A leaf joins two of them: its input and the one that is subtracted, or the ground.
struct Graph {
    /// A name of the component to which each belongs.
    components: [usize; 18],
}

impl Graph {
    /// Joins two components; false if they are one already, so that the leaf is a sum of earlier leaves.
    fn join(&mut self, leaf: Leaf) -> bool {
        let from = self.components[leaf.input];
        let to = self.components[leaf.less.unwrap_or(GROUND)];
        for component in &mut self.components {
            if *component == from {
                *component = to;
            }
        }
        from != to
    }
}

/// Reads the variables of a formula; with the quotient, in the lemmas that have one.
pub fn read(
    program: &Program,
    quotient: Option<Quotient>,
    reader: &mut Reader,
) -> Outcome<Vec<Variable>> {
    let form = "variable point P AXIS, difference P Q AXIS, boxed P AXIS, direction AXIS, end N, cut OPERATION, \
                part OPERATION or, in the rules of quotients, quotient";
    let mut variables: Vec<Variable> = Vec::new();
    let mut graph = Graph {
        components: from_fn(|input| input),
    };
    while reader.is_next("variable") {
        let kind = reader.read(form, |words| described(words, quotient.is_some()))?;
        let variable = with_bound(kind, program, quotient)?;
        if let Some(leaf) = variable.leaf() {
            ensure(
                graph.join(leaf),
                "found a variable that follows from those above, expected an independent one",
            )?;
        }
        if let Kind::Part(_) = kind {
            ensure(
                is_other_part(variable.unit, &variables),
                "found another number, expected different coordinates of one unit vector",
            )?;
        }
        variables.push(variable);
        ensure(
            variables.len() <= MOST_VARIABLES,
            format!("found more than {MOST_VARIABLES} variables"),
        )?;
    }
    // A point in the box is where the box was moved to, not where it is.
    let has_boxed = variables.iter().any(Variable::is_boxed);
    let has_point = variables.iter().any(Variable::is_point);
    ensure(
        !(has_boxed && has_point),
        "found points in a box and points as they are, expected one of both",
    )?;
    Ok(variables)
}

/// The variable that a line describes after its first word.
fn described(words: &[&str], in_quotient: bool) -> Option<Kind> {
    let (kind, numbers) = words.split_first()?;
    let numbers = indices(numbers, MOST_ROWS)?;
    let found = match (*kind, &numbers[..]) {
        ("point", &[point, axis]) => Kind::Leaf(coordinate(point, axis)?),
        ("boxed", &[point, axis]) => Kind::Boxed(coordinate(point, axis)?),
        ("difference", &[point, other, axis]) => Kind::Leaf(Leaf {
            input: coordinate(point, axis)?.input,
            less: Some(coordinate(other, axis)?.input),
        }),
        ("direction", &[axis @ 0..3]) => Kind::Leaf(Leaf::of(3 + axis)),
        ("end", &[end @ 0..2]) => Kind::Leaf(Leaf::of(15 + end)),
        ("cut", &[place]) => Kind::Cut(place),
        ("part", &[place]) => Kind::Part(place),
        ("quotient", &[]) if in_quotient => Kind::Quotient,
        _ => return None,
    };
    Some(found)
}

/// A coordinate of the origin, a, b or c.
fn coordinate(point: usize, axis: usize) -> Option<Leaf> {
    match (point, axis) {
        (0, 0..3) => Some(Leaf::of(axis)),
        (1..4, 0..3) => Some(Leaf::of(3 + 3 * point + axis)),
        _ => None,
    }
}

/// The variable with its bound: of inputs from the domain, of numbers with a lemma from there.
fn with_bound(kind: Kind, program: &Program, quotient: Option<Quotient>) -> Outcome<Variable> {
    let mut variable = Variable {
        kind,
        bound: Bound::default(),
        unit: None,
        down_to: None,
    };
    match kind {
        Kind::Leaf(leaf) => {
            let size = program.domain.bound(leaf);
            variable.bound = Bound::exactly(size);
        }
        // All points lie in an interval as long as the largest difference. "Quotients that are not below zero": its
        // middle may be moved to 0, which changes no difference.
        Kind::Boxed(_) => {
            let half = shifted(program.domain.largest_difference(), -1);
            variable.bound = Bound::exactly(&half);
        }
        Kind::Cut(place) => variable.bound = program.bound(place)?.clone(),
        Kind::Part(place) => {
            let lemma = program.lemma(place)?;
            variable.bound = lemma.bound.clone();
            variable.unit = lemma.unit;
        }
        Kind::Quotient => {
            let quotient = quotient.ok_or("found a quotient, expected none")?;
            variable.bound = Bound::exactly(quotient.size);
            variable.down_to = quotient.down_to.cloned();
        }
    }
    Ok(variable)
}

/// True if it is a coordinate of a unit vector, and another one of the same vector than those above.
fn is_other_part(unit: Option<Unit>, above: &[Variable]) -> bool {
    let Some(unit) = unit else {
        return false;
    };
    let mut others = above.iter().filter_map(|variable| variable.unit);
    others.all(|other| other.coordinate != unit.coordinate && other.length == unit.length)
}
