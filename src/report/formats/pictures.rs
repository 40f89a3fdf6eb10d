//! Pictures of what goes wrong: drawings of the worst witnesses.

use super::Record;
use super::row_view::RowView;
use super::worst::severity;
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

/// The worst false miss and false hit of each scalar, drawn.
pub(super) fn blocks(record: &Record, part: &RowPart, views: &[&RowView]) -> Vec<Block> {
    let is_asked = record.illustrations.is_some();
    let drawings = if is_asked { drawings(part, views) } else { Vec::new() };
    drawings.into_iter().map(Block::Picture).collect()
}

/// In each scalar the worst of each kind that can be drawn, if the kernel is known here.
fn drawings(part: &RowPart, views: &[&RowView]) -> Vec<Picture> {
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
