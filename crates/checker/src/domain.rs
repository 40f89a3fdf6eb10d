//! The domain of a proof: the bounds that it supposes of the inputs. "What is proved" in the guide has their table.

use super::number::{Number, number};

/// The names of the bounds, in their order.
const NAMES: [&str; 8] = [
    "edge",
    "reach",
    "world",
    "direction",
    "extent",
    "direction-floor",
    "floor",
    "quotient",
];

/// Bounds of the inputs, in the order of their names.
#[derive(Clone, Default)]
pub struct Domain(pub [Number; 8]);

const EDGE: usize = 0;
const REACH: usize = 1;
const WORLD: usize = 2;
const DIRECTION: usize = 3;
const EXTENT: usize = 4;
const DIRECTION_FLOOR: usize = 5;
const FLOOR: usize = 6;
const QUOTIENT: usize = 7;

/// How many inputs a program has: three coordinates of the origin, the direction, a, b and c, and both ends.
pub const INPUTS: usize = 17;

/// A leaf of a formula: an input, or the difference of two points' inputs along one axis.
#[derive(Clone, Copy)]
pub struct Leaf {
    pub input: usize,
    /// The input that is subtracted.
    pub less: Option<usize>,
}

impl Leaf {
    pub fn of(input: usize) -> Leaf {
        Leaf { input, less: None }
    }

    /// Adds a multiple of it to a sum of inputs.
    pub fn add_to(self, sum: &mut [i64; INPUTS], factor: i64) {
        sum[self.input] += factor;
        if let Some(less) = self.less {
            sum[less] -= factor;
        }
    }
}

/// True if an input is a coordinate of a point: of the origin, a, b or c.
pub fn is_of_point(input: usize) -> bool {
    matches!(input, 0..3 | 6..15)
}

/// True if an input is a coordinate of the direction.
pub fn is_of_direction(input: usize) -> bool {
    matches!(input, 3..6)
}

impl Domain {
    pub fn parse(words: &[&str]) -> Option<Domain> {
        if words.len() != 2 * NAMES.len() {
            return None;
        }
        let mut domain = Domain::default();
        for (i, name) in NAMES.iter().enumerate() {
            if words[2 * i] != *name {
                return None;
            }
            domain.0[i] = number(words[2 * i + 1])?;
        }
        Some(domain)
    }

    /// The largest difference of two points' coordinates.
    pub fn largest_difference(&self) -> &Number {
        (&self.0[EDGE]).max(&self.0[REACH])
    }

    /// The bound of a leaf's size.
    pub fn bound(&self, leaf: Leaf) -> &Number {
        let name = match (leaf.input, leaf.less) {
            (0..3, Some(_)) => REACH,
            (_, Some(0..3)) => REACH,
            (_, Some(_)) => EDGE,
            (3..6, None) => DIRECTION,
            (0..15, None) => WORLD,
            _ => EXTENT,
        };
        &self.0[name]
    }

    /// The least size of the direction's largest coordinate.
    pub fn direction_floor(&self) -> &Number {
        &self.0[DIRECTION_FLOOR]
    }

    /// The least size of every other divisor.
    pub fn floor(&self) -> &Number {
        &self.0[FLOOR]
    }

    /// The largest size of a quotient.
    pub fn quotient(&self) -> &Number {
        &self.0[QUOTIENT]
    }
}
