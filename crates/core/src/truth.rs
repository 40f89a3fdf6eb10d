//! Floor 1: what the words of a truth mean. Pure data; the oracle fills it, `judge` reads it.

#![forbid(unsafe_code)]

use num_rational::BigRational;
use std::cmp::Ordering;
use std::fmt;

/// The truth of a case, exactly. With N = (b-a)×(c-a), D = d·N, T = N·(a-o) and t = T/D.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Truth {
    /// D ≠ 0: the line crosses the plane at one point.
    Transversal(Crossing),
    /// D = 0, N ≠ 0, the line off the plane.
    Parallel,
    /// D = 0, N ≠ 0, the line in the plane.
    Coplanar(Contact),
    /// N = 0: the triangle is a segment or a point.
    Degenerate(Contact),
    /// A NaN or an infinity among the coordinates, d = 0, an interval end NaN, or t_min > t_max.
    Invalid,
}

/// A line crossing the plane of a triangle at one point.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Crossing {
    /// Which side the ray comes from.
    pub facing: Facing,
    /// Where t lies against the interval.
    pub place: Place,
    /// The sign of t, for contracts that demand t ≥ 0.
    pub t_sign: Ordering,
    /// Where the point lies in the triangle.
    pub feature: Feature,
}

named! {
    pub names
    /// The side of a triangle.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
    pub enum Facing {
        /// D < 0: the ray comes from the side from which a, b, c run counter-clockwise.
        Front = "front",
        /// D > 0.
        Back = "back",
    }
}

named! {
    pub names
    /// Where t lies against `[t_min, t_max]`; with t_min = t_max = t it is at t_min.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
    pub enum Place {
        /// t < t_min.
        Before = "before",
        /// t = t_min.
        AtMin = "at_min",
        /// Between the ends.
        Within = "within",
        /// t = t_max.
        AtMax = "at_max",
        /// t > t_max.
        Beyond = "beyond",
    }
}

named! {
    pub names
    /// Part of a closed triangle, or its outside.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
    pub enum Feature {
        /// Inside, off the boundary.
        Interior = "interior",
        /// The open edge from a to b.
        EdgeAb = "edge_ab",
        /// The open edge from b to c.
        EdgeBc = "edge_bc",
        /// The open edge from c to a.
        EdgeCa = "edge_ca",
        /// Vertex a.
        VertexA = "vertex_a",
        /// Vertex b.
        VertexB = "vertex_b",
        /// Vertex c.
        VertexC = "vertex_c",
        /// Not in the closed triangle.
        Outside = "outside",
    }
}

/// How a line in the plane of a triangle, or any line and a triangle without area, meet.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Contact {
    /// The points that the ray on its interval has in common with the closed triangle.
    pub kind: ContactKind,
    /// True if the ray on `[0, inf)` meets the closed triangle.
    pub meets_ray: bool,
    /// True if the whole line meets the closed triangle.
    pub meets_line: bool,
}

/// The common points of a ray on its interval and a closed triangle that holds part of its line.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ContactKind {
    /// No point.
    None,
    /// One point, on this feature.
    Point(Feature),
    /// A segment.
    Segment,
}

impl Truth {
    /// True if the ray on `[t_min, t_max]` meets the closed triangle; none for invalid input.
    pub fn hits_closed(&self) -> Option<bool> {
        match self {
            Truth::Transversal(crossing) => Some(
                crossing.feature != Feature::Outside
                    && !matches!(crossing.place, Place::Before | Place::Beyond),
            ),
            Truth::Parallel => Some(false),
            Truth::Coplanar(contact) | Truth::Degenerate(contact) => {
                Some(contact.kind != ContactKind::None)
            }
            Truth::Invalid => None,
        }
    }

    /// The crossing of a transversal case.
    pub fn crossing(&self) -> Option<&Crossing> {
        match self {
            Truth::Transversal(crossing) => Some(crossing),
            _ => None,
        }
    }

    /// The class's name.
    pub fn class_name(&self) -> &'static str {
        match self {
            Truth::Transversal(_) => "transversal",
            Truth::Parallel => "parallel",
            Truth::Coplanar(_) => "coplanar",
            Truth::Degenerate(_) => "degenerate",
            Truth::Invalid => "invalid",
        }
    }
}

impl Feature {
    /// From the signs of the weights of a, b and c, divided by the sign of their sum.
    #[inline]
    pub fn from_weight_signs(signs: [Ordering; 3]) -> Feature {
        use Feature::{EdgeAb, EdgeBc, EdgeCa, Interior, Outside, VertexA, VertexB, VertexC};
        const NONE: [Feature; 3] = [Outside; 3];
        // A table, since these signs are as random as the cases. By the signs of a, of b, of c: below, at and
        // above zero. All three weights cannot be zero: their sum is not.
        const FEATURES: [[[Feature; 3]; 3]; 3] = [
            [NONE, NONE, NONE],
            [
                NONE,
                [Outside, Outside, VertexC],
                [Outside, VertexB, EdgeBc],
            ],
            [
                NONE,
                [Outside, VertexA, EdgeCa],
                [Outside, EdgeAb, Interior],
            ],
        ];
        let [a, b, c] = signs.map(|sign| (sign as i8 + 1) as usize);
        FEATURES[a][b][c]
    }

    /// True if this is one of the open edges.
    pub fn is_edge(self) -> bool {
        matches!(self, Feature::EdgeAb | Feature::EdgeBc | Feature::EdgeCa)
    }

    /// True if this is one of the vertices.
    pub fn is_vertex(self) -> bool {
        matches!(self, Feature::VertexA | Feature::VertexB | Feature::VertexC)
    }
}

impl fmt::Display for Truth {
    /// One line for people: `transversal, front, t within, edge_ab`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.class_name())?;
        match self {
            Truth::Transversal(Crossing {
                facing,
                place,
                feature,
                ..
            }) => {
                write!(
                    f,
                    ", {}, t {}, {}",
                    facing.name(),
                    place.name(),
                    feature.name()
                )
            }
            Truth::Coplanar(contact) | Truth::Degenerate(contact) => match contact.kind {
                ContactKind::None => f.write_str(", no contact"),
                ContactKind::Point(feature) => write!(f, ", touches {}", feature.name()),
                ContactKind::Segment => f.write_str(", contact along a segment"),
            },
            Truth::Parallel | Truth::Invalid => Ok(()),
        }
    }
}

/// The exact values behind a truth, made on demand. Fields that do not apply are `None`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ExactValues {
    /// The ray's parameter of a transversal case.
    pub t: Option<BigRational>,
    /// The weight of b of a transversal case.
    pub u: Option<BigRational>,
    /// The weight of c of a transversal case.
    pub v: Option<BigRational>,
    /// First and last t of a contact, cut to the interval; equal for a point.
    pub contact_t: Option<[BigRational; 2]>,
}
