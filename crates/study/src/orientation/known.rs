//! The smallest points on which robust's predicates are known to be wrong: each is a power of two
//! times small integers, so that the truth can be checked by hand.

use super::{Dimension, Points};
use std::cmp::Ordering;

/// A curated case in `f64`.
pub struct Known {
    /// The name that `--case` takes.
    pub name: &'static str,
    /// The points' coordinates before scaling; the plane uses the first three points and two axes.
    integers: [[i8; 3]; 4],
    dimension: Dimension,
    /// The points are multiplied by 2 to this power.
    pub exponent: i32,
    /// The exact sign, worked out by hand.
    pub sign: Ordering,
    /// An explanation of what goes wrong.
    pub why: &'static str,
}

impl Known {
    /// The points.
    pub fn points(&self) -> Points<f64> {
        Points::each(self.dimension, |i, axis| f64::from(self.integers[i][axis]))
            .scaled(self.exponent)
    }
}

const CORNER: [[i8; 3]; 4] = [[1, 0, 0], [0, 1, 0], [0, 0, 1], [0, 0, 0]];

/// Every curated case, in the order of reports.
pub static KNOWN: &[Known] = &[
    Known {
        name: "corner-underflow-2d",
        integers: CORNER_2D,
        dimension: Dimension::Two,
        exponent: -538,
        sign: Ordering::Greater,
        why: "det = 2^-1076 is below half the smallest float: the product is 0",
    },
    Known {
        name: "square-overflow-2d",
        integers: [[1, 1, 0], [-1, 1, 0], [0, 0, 0], [0, 0, 0]],
        dimension: Dimension::Two,
        exponent: 512,
        sign: Ordering::Greater,
        why: "det = 2^1025; inf + -inf of the two products leaves no error bound",
    },
    Known {
        name: "corner-underflow-3d",
        integers: CORNER,
        dimension: Dimension::Three,
        exponent: -359,
        sign: Ordering::Greater,
        why: "det = 2^-1077 is below half the smallest float: the product is 0",
    },
    Known {
        name: "corner-overflow-3d",
        integers: CORNER,
        dimension: Dimension::Three,
        exponent: 342,
        sign: Ordering::Greater,
        why: "det = 2^1026; the infinite permanent makes the filter hand on, the stages make a NaN",
    },
    Known {
        name: "coplanar-underflow-3d",
        integers: [[2, 0, -2], [0, 2, 2], [-2, -1, 1], [0, 0, 0]],
        dimension: Dimension::Three,
        exponent: -359,
        sign: Ordering::Equal,
        why: "exactly coplanar; products of three coordinates round among the subnormals",
    },
];

const CORNER_2D: [[i8; 3]; 4] = [[1, 0, 0], [0, 1, 0], [0, 0, 0], [0, 0, 0]];

/// The curated case of a name.
pub fn find_known(name: &str) -> Option<&'static Known> {
    KNOWN.iter().find(|known| known.name == name)
}
