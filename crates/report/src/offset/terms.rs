//! The words on the page of `offset`, and their meaning.

use super::record::OffsetResult;
use crate::case::SceneKind;
use crate::page::Block;

/// The words of the first screen.
pub(super) fn words(record: &OffsetResult) -> [(&'static str, String); 4] {
    [
        ("n", "the unit normal on the side that the first ray came from; u: half an ulp of 1".to_owned()),
        (
            "wrong side",
            "the new ray starts on the exact plane of its triangle or behind it; self-hits: the kernel says that it hits \
             that triangle"
                .to_owned(),
        ),
        (
            "height",
            format!(
                "over the plane, in longest edges of the triangle; a wall stands {} of one in front of it",
                record.wall
            ),
        ),
        (
            "blocked",
            "a shadow ray from another point to p hits the surface at p itself, with a direction that goes to p;              shorter: by how much it ends before p"
                .to_owned(),
        ),
    ]
}

/// The rest.
pub(super) fn how_to_read(record: &OffsetResult) -> Vec<Block> {
    let fold = record.fold;
    let terms = [
        ("behind", "half of the starts (or 99 %) are not above the plane".to_owned()),
        ("in ulps", "the height in ulps of the triangle's largest coordinate: the median".to_owned()),
        (
            "a fold",
            format!("starts behind a neighbour on the edge nearest to p, folded up to {fold} degrees with the triangle"),
        ),
        (
            "times least",
            "the way along the normal over the shortest that is right, where p itself is wrong (median)".to_owned(),
        ),
        ("new rays", "leave to the side that the first ray came from, in every direction alike".to_owned()),
        (
            "made",
            format!(
                "offsets are made for the scene on seed {}, and counted on seed {}; `hairline list schemes` has the \
                 sources, --format json a wrong start of each",
                record.pilot_seed, record.seed
            ),
        ),
    ];
    vec![Block::terms(terms.into_iter().chain(kinds(record)))]
}

/// The kinds of planes and rays in words, where there are several.
fn kinds(record: &OffsetResult) -> Option<(&'static str, String)> {
    let kinds = record
        .planes
        .iter()
        .filter_map(|name| SceneKind::named(name));
    let words: Vec<_> = kinds
        .map(|kind| format!("{kind}: {}", kind.in_words()))
        .collect();
    (1 < words.len()).then(|| ("kinds", words.join("; ")))
}
