//! The strata of a scene: rays at the inside, edges and vertices of its triangles and beside them, nearly
//! and exactly parallel to them, and from a kernel's own hit points on them.
//!
//! Triangles lie on generic planes: their positions and orientations are uniform. Points are computed in
//! `f64` and rounded, so the oracle, not the construction, says what is a hit.

mod aimed;
mod draw;
mod flat;
mod shadow;

use super::{Family, Grouping, Question};
use crate::truth::Truth;
use aimed::{edges, interior, outside, vertices};
use flat::{grazing, parallel};
use shadow::shadow;

pub(super) use draw::{Frame, any_direction, rounded, wide};
pub(super) use flat::{grazing_case, grazing_sine};
pub(super) use shadow::hit_point;

/// A part of a scene whose rates are reported by themselves.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Stratum {
    /// Rays at a point inside a triangle.
    Interior,
    /// Rays at a point of an edge that two triangles share.
    Edges,
    /// Rays at the vertex that six triangles share.
    Vertices,
    /// Rays almost parallel to a triangle on a generic plane.
    Grazing,
    /// Rays exactly parallel to the plane of a triangle.
    Parallel,
    /// Rays from a kernel's own hit point on a triangle, in every direction.
    Shadow,
    /// Rays at a point of the plane beside a triangle.
    Outside,
}

impl Stratum {
    /// All of them, in the order of reports.
    pub const ALL: [Stratum; 7] = [
        Stratum::Interior,
        Stratum::Edges,
        Stratum::Vertices,
        Stratum::Grazing,
        Stratum::Parallel,
        Stratum::Shadow,
        Stratum::Outside,
    ];

    /// The family of its cases.
    pub fn family(self) -> &'static Family {
        &STRATA[self as usize]
    }
}

macro_rules! stratum {
    ($name:literal, $question:ident, $grouping:ident, $make:ident, $keeps:expr, $promise:literal) => {
        Family {
            name: $name,
            version: 1,
            promise: $promise,
            question: Question::$question,
            grouping: Grouping::$grouping,
            size: None,
            keeps: $keeps,
            make_f32: $make::<f32>,
            make_f64: $make::<f64>,
        }
    };
}

/// The family of each stratum, in the order of [`Stratum::ALL`].
pub static STRATA: &[Family] = &[
    stratum!(
        "scene-interior",
        Inside,
        Single,
        interior,
        with_area,
        "at a point inside a triangle, from any direction"
    ),
    stratum!(
        "scene-edges",
        Edges,
        SharedEdge,
        edges,
        with_area,
        "at a point of an edge that two triangles share, from any direction"
    ),
    stratum!(
        "scene-vertices",
        Vertices,
        Fan,
        vertices,
        with_area,
        "at the vertex that six triangles share, from any direction"
    ),
    stratum!(
        "scene-grazing",
        Flat,
        Single,
        grazing,
        with_area,
        "almost parallel to a generic plane: sines from 1/8 down to below the rounding of the direction"
    ),
    stratum!(
        "scene-parallel",
        Flat,
        Single,
        parallel,
        parallel_or_in_the_plane,
        "exactly parallel to the plane, off it or in it"
    ),
    stratum!(
        "scene-shadow",
        Ends,
        SecondaryRay,
        shadow,
        with_area,
        "from a kernel's own rounded hit point on the triangle, in every direction"
    ),
    stratum!(
        "scene-outside",
        Inside,
        Single,
        outside,
        with_area,
        "at a point of the plane beside the triangle, from any direction"
    ),
];

fn with_area(truths: &[Truth]) -> bool {
    truths.iter().all(|truth| !matches!(truth, Truth::Degenerate(_) | Truth::Invalid))
}

fn parallel_or_in_the_plane(truths: &[Truth]) -> bool {
    truths.iter().all(|truth| matches!(truth, Truth::Parallel | Truth::Coplanar(_)))
}
