//! The flags of tests: what may go wrong on them, once a file in words.

use crate::truth::{Crossing, Facing, Feature, Place, Truth};
use std::sync::LazyLock;

/// Each flag with its effect.
pub(super) static FLAGS: LazyLock<Vec<(&str, &str)>> =
    LazyLock::new(|| serde_json::from_str(include_str!("flags.json")).expect("tests read it"));

/// The flags that follow from a truth.
pub(super) fn of_truth(truth: &Truth) -> Vec<&'static str> {
    let Truth::Transversal(Crossing {
        facing,
        place,
        feature,
        ..
    }) = truth
    else {
        return vec![truth.class_name()];
    };
    let met = *feature != Feature::Outside;
    let flags = [
        ("edge", feature.is_edge()),
        ("vertex", feature.is_vertex()),
        ("back", *facing == Facing::Back),
        ("interval-end", matches!(place, Place::AtMin | Place::AtMax)),
        (
            "out-of-interval",
            met && matches!(place, Place::Before | Place::Beyond),
        ),
    ];
    flags
        .into_iter()
        .filter(|(_, holds)| *holds)
        .map(|(name, _)| name)
        .collect()
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
    FLAGS
        .iter()
        .map(|(name, _)| *name)
        .find(|name| *name == flag)
}
