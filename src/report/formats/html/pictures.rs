//! Pictures of what goes wrong: maps float by float, and drawings of the worst witnesses.

use super::room::Room;
use super::view::{Kind, Row};
use super::words::code;
use crate::audit;
use crate::case::Case;
use crate::kernel::Scalar;
use crate::map::{self, Ink};
use crate::report::formats::row_view::RowView;
use crate::report::formats::worst::severity;
use crate::report::record::*;
use crate::report::{MapPart, Record, group_digits};
use maud::{Markup, PreEscaped, html};
use std::panic::{AssertUnwindSafe, catch_unwind};

/// Families whose sizes span the scalar's range.
const SPANNING: [&str; 6] =
    ["tiny", "huge", "direction-length", "mixed-scale", "range-ends", "invalid"];

/// The pictures of a row.
pub(super) fn section(record: &Record, row: &Row, room: &mut Room) -> Markup {
    let maps = record.illustrations.iter().flat_map(|all| &all.maps);
    let maps = maps.filter(|map| map.kernel == row.part.kernel && map.set == row.part.set);
    let maps: Vec<&MapPart> = maps.collect();
    let drawings = if record.illustrations.is_some() { drawings(row) } else { Vec::new() };
    let left_out = room.left_out;
    let drawn = room.fill(drawings.iter(), |drawing| drawing.clone().into_string());
    let mapped = room.fill(maps.iter(), |map| figure(map).into_string());
    html! {
        @if !maps.is_empty() {
            h4 { "Float by float" }
            p {
                "One pixel is one ray, its origin moved by floats in two coordinates, about a ray that meets the "
                "triangle exactly on an edge, exactly at a vertex, and on an edge at a small angle to the plane. "
                "Left what the kernel says, right what is exactly true. Dark is wrong."
            }
            (legend())
            div.maps { (PreEscaped(mapped)) }
        }
        @if !drawings.is_empty() {
            h4 { "The worst, drawn" }
            p { "Of the moderate families the false miss and the false hit that are farthest from where they would be right." }
            div.drawings { (PreEscaped(drawn)) }
        }
        @if left_out < room.left_out {
            p.note { (group_digits(room.left_out - left_out)) " pictures are left out here." }
        }
    }
}

fn legend() -> Markup {
    let names = [
        (Ink::Yes, "hit"),
        (Ink::No, "miss"),
        (Ink::Boundary, "exactly on the boundary"),
        (Ink::Free, "nothing is asked"),
        (Ink::FalseYes, "false hit"),
        (Ink::FalseNo, "false miss"),
        (Ink::Bad, "bad value"),
        (Ink::Failed, "no verdict"),
    ];
    html! {
        ul.inks {
            @for (ink, name) in names {
                li {
                    svg viewBox="0 0 12 12" aria-hidden="true" { rect width="12" height="12" fill=(ink.hex()) {} }
                    " " (name)
                }
            }
        }
    }
}

fn figure(map: &MapPart) -> Markup {
    let pixels = map.size[0].saturating_mul(map.size[1]);
    let list = |counts: &[(String, u64)]| {
        let parts: Vec<String> =
            counts.iter().map(|(words, n)| format!("{} {words}", group_digits(*n))).collect();
        parts.join(", ")
    };
    let (computed, exact) = (list(&map.computed), list(&map.exact));
    // What is right needs no words beside the picture.
    let right = |words: &str| ["hit", "miss"].contains(&words);
    let wrong: Vec<_> = map.computed.iter().filter(|(words, _)| !right(words)).cloned().collect();
    let alt = format!(
        "Two panels of {} by {} pixels. Left, computed: {computed}. Right, exact: {exact}.",
        map.size[0], map.size[1]
    );
    let is_base64 = |c: char| c.is_ascii_alphanumeric() || "+/=".contains(c);
    html! {
        @if map.png.chars().all(is_base64) {
            figure {
                img src={ "data:image/png;base64," (map.png) } alt=(alt) width="408" height="192" loading="lazy";
                figcaption {
                    b { (map.scalar) " " (map.spot) } " "
                    (group_digits(map.wrong)) " of " (group_digits(pixels)) " wrong"
                    @if !wrong.is_empty() { ": " (list(&wrong)) }
                    ". To the right " (map.axes[0]) ", upwards " (map.axes[1]) "."
                }
            }
        }
    }
}

/// In each scalar the worst of each kind that can be drawn, if the kernel is known here.
fn drawings(row: &Row) -> Vec<Markup> {
    let Ok(run) = row.part.spec().row() else { return Vec::new() };
    let mut all = Vec::new();
    for scalar in &row.scalars {
        for kind in Kind::ALL {
            let Some((family, part)) = worst(scalar, kind) else { continue };
            // A drawing does not know that its ray starts at the kernel's own hit.
            let is_secondary = family == "secondary-ray" || family.starts_with("corpus-secondary:");
            if run.contract.no_self_hit && is_secondary {
                continue;
            }
            let svg = in_named_scalar!(scalar.scalar, F => drawn::<F>(&run, &part.worst.bits));
            all.extend(svg.map(|svg| {
                html! {
                    figure {
                        figcaption {
                            b { (scalar.scalar) " " (part.finding) " of " (part.class) } " in " (family) ". "
                            (code(&part.worst.command))
                        }
                        div.drawing role="group" aria-label={ "Drawing of the worst " (part.finding) } tabindex="0" { (PreEscaped(svg)) }
                    }
                }
            }));
        }
    }
    all
}

/// The worst finding of a kind that has a place to show: of a ray that crosses the plane, in a family of
/// moderate sizes if there is one.
fn worst<'a>(scalar: &RowView<'a>, kind: Kind) -> Option<(&'a str, &'a FindingPart)> {
    let crossing = |class: &str| class.contains('/');
    let all = scalar
        .results
        .iter()
        .flat_map(|result| result.findings.iter().map(move |part| (result.family.as_str(), part)));
    let all = all.filter(|(_, part)| part.finding == kind.finding() && crossing(&part.class));
    let moderate = |family: &str| !SPANNING.contains(&family);
    all.filter(|(_, part)| severity(part).is_finite()).max_by(|(f, a), (g, b)| {
        moderate(f).cmp(&moderate(g)).then(severity(a).total_cmp(&severity(b)))
    })
}

fn drawn<F: Scalar>(row: &audit::Row, bits: &str) -> Option<String> {
    let case = Case::<F>::from_hex(bits)?;
    catch_unwind(AssertUnwindSafe(|| map::drawing(&case, row).ok())).ok().flatten()
}
