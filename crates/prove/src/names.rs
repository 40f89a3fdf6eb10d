//! Other names of the axes and of the vertices a, b and c. A domain has one bound for all of them, so what is proved of
//! a program holds under other names too.

use crate::arith::recorded::Operation;
use std::fmt::{self, Display};

/// Other names: the axis for each axis, and the vertex for each vertex.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Names {
    axes: [u8; 3],
    vertices: [u8; 3],
}

impl Names {
    /// The names under which a program needs the axes, and the vertices, in their order. So two programs are the same
    /// but for names if they are equal under these.
    pub fn of(program: &[Operation]) -> Names {
        let mut axes = Vec::new();
        let mut vertices = Vec::new();
        for operation in program {
            if let Operation::Input(i @ ..15) = *operation {
                axes.push(i % 3);
                vertices.extend((i / 3).checked_sub(2));
            }
        }
        Names {
            axes: in_order(&axes),
            vertices: in_order(&vertices),
        }
    }

    /// The input under these names.
    pub fn input(self, input: u8) -> u8 {
        let axis = self.axes[usize::from(input % 3)];
        match input / 3 {
            point @ 0..2 => 3 * point + axis,
            point @ 2..5 => 6 + 3 * self.vertices[usize::from(point - 2)] + axis,
            _ => input,
        }
    }

    /// The operation, if an input, under these names.
    pub fn operation(self, operation: Operation) -> Operation {
        match operation {
            Operation::Input(i) => Operation::Input(self.input(i)),
            _ => operation,
        }
    }

    /// From these names to others.
    pub fn to(self, other: Names) -> Names {
        let from = |one: [u8; 3], other: [u8; 3]| one.map(|name| place_of(name, &other));
        Names {
            axes: from(self.axes, other.axes),
            vertices: from(self.vertices, other.vertices),
        }
    }
}

impl Display for Names {
    /// `yzx abc`: y in place of x.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let axes = letters(b'x', self.axes);
        let vertices = letters(b'a', self.vertices);
        write!(f, "{axes} {vertices}")
    }
}

fn letters(first: u8, names: [u8; 3]) -> String {
    String::from_iter(names.map(|name| char::from(first + name)))
}

fn place_of(name: u8, names: &[u8]) -> u8 {
    let place = names.iter().position(|known| *known == name);
    place.expect("all names") as u8
}

/// The place of 0, 1 and 2 in the order in which they come first; those that do not come are last.
fn in_order(seen: &[u8]) -> [u8; 3] {
    let mut order = Vec::new();
    for name in seen.iter().copied().chain(0..3) {
        if !order.contains(&name) {
            order.push(name);
        }
    }
    [0, 1, 2].map(|name| place_of(name, &order))
}
