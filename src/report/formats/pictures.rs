//! Pictures of what goes wrong: maps float by float, and drawings of the worst witnesses.

use super::row_view::RowView;
use super::worst::severity;
use super::{MapPart, Record, group_digits};
use crate::audit;
use crate::case::Case;
use crate::kernel::Scalar;
use crate::map;
use crate::report::page::{Block, Drawing, Picture};
use crate::report::record::*;
use std::panic::{AssertUnwindSafe, catch_unwind};

/// Families whose sizes span the scalar's range.
const SPANNING: [&str; 6] =
    ["tiny", "huge", "direction-length", "mixed-scale", "range-ends", "invalid"];

/// The pictures of a row: maps about three rays, and the worst false miss and false hit of each scalar, drawn.
pub(super) fn blocks(record: &Record, part: &RowPart, views: &[RowView]) -> Vec<Block> {
    let Some(illustrations) = &record.illustrations else { return Vec::new() };
    let is_of = |map: &&MapPart| map.kernel == part.kernel && map.set == part.set;
    let maps: Vec<Block> =
        illustrations.maps.iter().filter(is_of).filter_map(map_picture).collect();
    let mut blocks = Vec::new();
    if !maps.is_empty() {
        blocks.push(Block::text(
            "Float by float: one pixel is one ray, its origin moved by floats in two coordinates, about a ray that meets \
             the triangle exactly on an edge, exactly at a vertex, and on an edge at a small angle to the plane. Left what \
             the kernel says, right what is exactly true. Dark is wrong.",
        ));
    }
    blocks.extend(maps);
    blocks.extend(drawings(part, views).into_iter().map(Block::Picture));
    blocks
}

fn map_picture(map: &MapPart) -> Option<Block> {
    let pixels = map.size[0].saturating_mul(map.size[1]);
    let list = |counts: &[(String, u64)]| {
        let parts: Vec<String> =
            counts.iter().map(|(words, n)| format!("{} {words}", group_digits(*n))).collect();
        parts.join(", ")
    };
    // What is right needs no words beside the picture.
    let right = |words: &str| ["hit", "miss"].contains(&words);
    let wrong: Vec<_> = map.computed.iter().filter(|(words, _)| !right(words)).cloned().collect();
    let wrong = if wrong.is_empty() { String::new() } else { format!(": {}", list(&wrong)) };
    let about = format!(
        "Two panels of {} by {} pixels. Left, computed: {}. Right, exact: {}.",
        map.size[0],
        map.size[1],
        list(&map.computed),
        list(&map.exact)
    );
    let caption = format!(
        "{} {}: {} of {} wrong{wrong}. To the right {}, upwards {}.",
        map.scalar,
        map.spot,
        group_digits(map.wrong),
        group_digits(pixels),
        map.axes[0],
        map.axes[1]
    );
    let is_base64 = |c: char| c.is_ascii_alphanumeric() || "+/=".contains(c);
    let drawing = Drawing::Png(map.png.clone(), [408, 192]);
    map.png.chars().all(is_base64).then_some(Block::Picture(Picture { about, caption, drawing }))
}

/// In each scalar the worst of each kind that can be drawn, if the kernel is known here.
fn drawings(part: &RowPart, views: &[RowView]) -> Vec<Picture> {
    let Ok(run) = part.spec().row() else { return Vec::new() };
    let mut all = Vec::new();
    for view in views {
        for kind in [FindingKind::FalseMiss, FindingKind::FalseHit] {
            let Some((family, part)) = worst(view, kind) else { continue };
            // A drawing does not know that its ray starts at the kernel's own hit.
            let is_secondary = family == "secondary-ray" || family.starts_with("corpus-secondary:");
            if run.contract.no_self_hit && is_secondary {
                continue;
            }
            let svg = in_named_scalar!(view.scalar, F => drawn::<F>(&run, &part.worst.bits));
            all.extend(svg.map(|svg| Picture {
                about: format!("Drawing of the worst {}", part.finding),
                caption: format!(
                    "{} {} of {} in {family}: {}",
                    view.scalar, part.finding, part.class, part.worst.command
                ),
                drawing: Drawing::Svg(svg),
            }));
        }
    }
    all
}

/// The worst finding of a kind that has a place to show: of a ray that crosses the plane, in a family of
/// moderate sizes if there is one.
fn worst<'a>(scalar: &RowView<'a>, kind: FindingKind) -> Option<(&'a str, &'a FindingPart)> {
    let crossing = |class: &str| class.contains('/');
    let all = scalar
        .results
        .iter()
        .flat_map(|result| result.findings.iter().map(move |part| (result.family.as_str(), part)));
    let all = all.filter(|(_, part)| part.finding == kind && crossing(&part.class));
    let moderate = |family: &str| !SPANNING.contains(&family);
    all.filter(|(_, part)| severity(part).is_finite()).max_by(|(f, a), (g, b)| {
        moderate(f).cmp(&moderate(g)).then(severity(a).total_cmp(&severity(b)))
    })
}

fn drawn<F: Scalar>(row: &audit::Row, bits: &str) -> Option<String> {
    let case = Case::<F>::from_hex(bits)?;
    catch_unwind(AssertUnwindSafe(|| map::drawing(&case, row).ok())).ok().flatten()
}
