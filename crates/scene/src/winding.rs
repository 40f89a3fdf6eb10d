//! Windings, and the edges that leave them undefined.

/// How often a closed surface winds around a point, or by how much that changes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Winding {
    /// The winding number: 1 inside of a surface whose faces all show their front to the outside, 0 outside.
    Number(i64),
    /// True if the number of layers is odd. All that is defined where faces show front and back to one side.
    IsOdd(bool),
}

impl Winding {
    /// True if the number is 0, or even.
    pub fn is_zero(self) -> bool {
        matches!(self, Winding::Number(0) | Winding::IsOdd(false))
    }

    /// The sum. Of a number and a parity only the parity is defined.
    pub(crate) fn plus(self, other: Winding) -> Winding {
        match (self, other) {
            (Winding::Number(a), Winding::Number(b)) => Winding::Number(a + b),
            (a, b) => Winding::IsOdd(a.is_odd() != b.is_odd()),
        }
    }

    /// The winding with the opposite sign.
    pub(crate) fn negated(self) -> Winding {
        match self {
            Winding::Number(number) => Winding::Number(-number),
            parity => parity,
        }
    }

    /// The winding without its sign and size.
    pub(crate) fn parity(self) -> Winding {
        Winding::IsOdd(self.is_odd())
    }

    fn is_odd(self) -> bool {
        match self {
            Winding::Number(number) => number % 2 != 0,
            Winding::IsOdd(is_odd) => is_odd,
        }
    }
}

/// An edge along which a surface is open: the faces that meet there, faces with parts of the edge included, do not cancel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OpenEdge {
    /// A face with this edge.
    pub face: u32,
    /// Its ends.
    pub ends: [[f64; 3]; 2],
}
