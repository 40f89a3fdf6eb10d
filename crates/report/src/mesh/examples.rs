//! Places of a mesh where a kernel is wrong: a group of each kind and class of finding, and where it lies.

use super::rows::{AtPart, MeshRow};
use hairline_record::*;

/// A group that shows something.
pub(super) struct MeshExample<'a> {
    pub what: String,
    pub id: &'a str,
    pub command: String,
}

/// So many findings of each kind and class: cracks, and what else the row's contract speaks of; what
/// may be elsewhere, which is no finding, on demand.
pub(super) fn examples<'a>(
    row: &MeshRow<'a>,
    limit: usize,
    elsewhere: bool,
) -> Vec<MeshExample<'a>> {
    let mut all = Vec::new();
    for (name, AtPart { result, across, .. }) in ["edge", "vertex"].into_iter().zip(row.at) {
        for (class, found) in &across.classes {
            let mut lists = vec![("crack", &found.first_cracks)];
            if row.promised() == Promised::ExactlyOne {
                lists.push(("double", &found.first_doubles));
                lists.push(("wrong at a fold", &found.first_odd_folds));
            }
            if elsewhere {
                lists.push(("elsewhere", &found.first_elsewhere));
            }
            for (what, list) in lists {
                all.extend(list.iter().take(limit).map(|id| MeshExample {
                    what: format!("{what}, {name}, {class}"),
                    id,
                    command: result.explain_group(row.part, id),
                }));
            }
        }
    }
    all
}

/// The points, and the lines of the faces, or their numbers.
pub(super) fn place(example: &PlacePart) -> String {
    let points: Vec<String> = example
        .points
        .iter()
        .map(|[x, y, z]| format!("({x}, {y}, {z})"))
        .collect();
    let (at, places) = match example.lines.as_slice() {
        [] => ("", &example.faces),
        _ => ("at lines ", &example.lines),
    };
    let mut places: Vec<String> = places.iter().map(u32::to_string).collect();
    places.dedup();
    let more = if places.len() > 8 { ", …" } else { "" };
    places.truncate(8);
    format!(
        "{}, faces {at}{}{more}",
        points.join(" to "),
        places.join(", ")
    )
}
