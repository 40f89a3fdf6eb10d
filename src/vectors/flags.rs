//! The flags of tests: what may go wrong on them, once a file in words.

use super::number::EitherFloat;
use crate::truth::{Crossing, Facing, Feature, Place, Truth};

/// Each flag with its effect.
pub(super) const FLAGS: &[(&str, &str)] = &[
    (
        "edge",
        "The line meets an edge exactly. Of one triangle both answers are right; of the triangles that share the edge one must report the hit, or light leaks between them. Woop, Benthin and Wald 2013: https://jcgt.org/published/0002/01/05/",
    ),
    (
        "vertex",
        "The line meets a vertex exactly. Of one triangle both answers are right; of the triangles around the vertex one must report the hit.",
    ),
    (
        "back",
        "The ray comes from the back, from which a, b, c run clockwise: leave these out for a function that culls back faces.",
    ),
    ("interval-end", "t is exactly t_min or t_max. Specifications differ on whether that is a hit"),
    (
        "out-of-interval",
        "The line meets the triangle before t_min or beyond t_max. A function that forgets a comparison of t reports a hit.",
    ),
    (
        "parallel",
        "The ray is exactly parallel to the plane and beside it. A determinant that should be 0 may be computed as a small number, and t, u, v are then anything.",
    ),
    (
        "coplanar",
        "The ray lies in the plane of the triangle. Graphics interfaces demand a miss; in set theory a ray that touches the triangle hits it.",
    ),
    (
        "degenerate",
        "The triangle has no area: its vertices lie on a line. Graphics interfaces demand a miss.",
    ),
    (
        "invalid",
        "A NaN, an infinity, a direction of zeros or an interval with t_min > t_max. The function should end, and not report values that are not finite.",
    ),
    ("near-edge", "Aimed at an edge and moved by a few units in the last place: rounding decides."),
    (
        "near-vertex",
        "Aimed at a vertex and moved by a few units in the last place: rounding decides.",
    ),
    (
        "grazing",
        "The ray is nearly parallel to the plane: the determinant is far smaller than its terms, and a fixed epsilon on it rejects true hits.",
    ),
    (
        "start-on-plane",
        "The ray starts on the triangle or very near it, as a shadow ray does. A minimum of t may reject a true hit, and rounding may invent one. Pharr, Jakob and Humphreys, section 6.8: https://pbr-book.org/4ed/Shapes/Managing_Rounding_Error",
    ),
    (
        "sliver",
        "A needle or a cap, 16 to 2^40 times longer than high: a fixed epsilon on the determinant rejects it.",
    ),
    (
        "tiny",
        "The triangle is tiny: a fixed epsilon on a length, an area or a determinant rejects true hits.",
    ),
    ("huge", "The triangle is huge: a fixed epsilon is far below the rounding errors."),
    ("far", "A small triangle far from the origin of the coordinates: differences cancel."),
    (
        "direction-length",
        "The direction is very short or very long. A function must not compare it with a fixed epsilon, and t is in units of its length.",
    ),
    (
        "zeros",
        "Zeros and negative zeros in the direction and the coordinates: divisions by zero and lost signs.",
    ),
    ("mixed-scale", "The exponents of the coordinates differ widely."),
    (
        "range-ends",
        "A number whose square underflows or overflows. Some processors flush the smallest to zero.",
    ),
    (
        "shared-edge",
        "Two triangles share an edge. Where both face the ray alike, at least one must report a hit on the edge (no crack), and watertight rules demand exactly one (no double).",
    ),
    (
        "fan",
        "Triangles around a vertex, all facing the ray alike: at least one must report a hit on the vertex or on a spoke.",
    ),
    (
        "published",
        "Taken from a public report; the source is named. The truth stands here as it is exactly, whoever was right in the report.",
    ),
];

/// The flags that follow from a truth.
pub(super) fn of_truth(truth: &Truth) -> Vec<&'static str> {
    let Truth::Transversal(Crossing { facing, place, feature, .. }) = truth else {
        return vec![truth.class_name()];
    };
    let met = *feature != Feature::Outside;
    let flags = [
        ("edge", feature.is_edge()),
        ("vertex", feature.is_vertex()),
        ("back", *facing == Facing::Back),
        ("interval-end", matches!(place, Place::AtMin | Place::AtMax)),
        ("out-of-interval", met && matches!(place, Place::Before | Place::Beyond)),
    ];
    flags.into_iter().filter(|(_, holds)| *holds).map(|(name, _)| name).collect()
}

/// The flag that follows from the numbers.
pub(super) fn of_numbers<'a>(
    mut numbers: impl Iterator<Item = &'a EitherFloat>,
) -> Option<&'static str> {
    numbers.any(|number| number.is_extreme).then_some("range-ends")
}

/// The flag of a family's cases.
pub(super) fn of_family(family: &str) -> Option<&'static str> {
    let flag = match family {
        "edge-near" => "near-edge",
        "vertex-near" => "near-vertex",
        "origin-on" | "origin-near" => "start-on-plane",
        "axis-aligned" => "zeros",
        other => other,
    };
    FLAGS.iter().map(|(name, _)| *name).find(|name| *name == flag)
}
