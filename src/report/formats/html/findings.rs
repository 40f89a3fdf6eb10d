//! Every class of findings with its cases: id, bits, and the command that shows each again.

use super::room::Room;
use super::view::{Row, View};
use super::words::{code, counts, share};
use crate::report::disagreement::polygons;
use crate::report::formats::why::causes_text;
use crate::report::formats::worst::describe_severity;
use crate::report::record::*;
use crate::report::{group_digits, number_of};
use maud::{Markup, PreEscaped, html};

/// How many of a class's first examples are shown.
#[derive(Clone, Copy)]
pub(super) struct Depth {
    /// None for all.
    pub most: Option<usize>,
}

impl Depth {
    fn of<'a>(&self, part: &'a FindingPart) -> &'a [Example] {
        &part.first[..part.first.len().min(self.most.unwrap_or(usize::MAX))]
    }
}

/// Bytes that an example takes beside its own text.
const AROUND_EXAMPLE: usize = 64;

/// As many examples a class as fit into some bytes, the same for all classes.
pub(super) fn depth(view: &View, room: usize) -> Depth {
    let size = |example: &Example| example.command.len() + example.bits.len() + AROUND_EXAMPLE;
    let all = view.rows.iter().flat_map(|row| &row.scalars).flat_map(|scalar| &scalar.results);
    // By number of examples shown: what showing one more takes.
    let mut further: Vec<usize> = Vec::new();
    let mut always = 0;
    for part in all.flat_map(|result| &result.findings) {
        always += size(&part.worst) + 200;
        further.resize(further.len().max(part.first.len()), 0);
        for (sum, example) in further.iter_mut().zip(&part.first) {
            *sum += size(example);
        }
    }
    let mut left = room.saturating_sub(always);
    for (most, sum) in further.iter().enumerate() {
        match left.checked_sub(*sum) {
            Some(rest) => left = rest,
            None => return Depth { most: Some(most) },
        }
    }
    Depth { most: None }
}

pub(super) fn list(row: &Row, depth: Depth, room: &mut Room) -> Markup {
    let results: Vec<&KernelResult> = row
        .scalars
        .iter()
        .flat_map(|scalar| scalar.results.iter().copied())
        .filter(|result| !result.findings.is_empty() || grouped(result).next().is_some())
        .collect();
    let classes: usize = results.iter().map(|result| result.findings.len()).sum();
    let count = results.len() as u64;
    // One source may hold more classes than fit.
    let mut left_out = 0;
    let mut text = String::new();
    for (i, result) in results.iter().enumerate() {
        let mut part = room.part(room.left() / (results.len() - i));
        let (piece, missing) = source(row.part, result, depth, &mut part);
        text.push_str(&piece);
        left_out += missing;
        room.take_back(part);
    }
    html! {
        @if 0 < count {
            h4 { "Findings" }
            p { (number_of(classes as u64, "class", "classes")) " of findings, by scalar and source of cases. A click selects a whole command." }
            (PreEscaped(text))
            @if 0 < left_out {
                p.note { (number_of(left_out, "class is", "classes are")) " left out here; the JSON record has all." }
            }
        } @else {
            p { "No findings." }
        }
    }
}

/// One source in one scalar, and how many of its classes do not fit.
fn source(row: &RowPart, result: &KernelResult, depth: Depth, room: &mut Room) -> (String, u64) {
    let mut by_kind: Vec<(FindingKind, u64)> = Vec::new();
    for part in &result.findings {
        match by_kind.iter_mut().find(|(kind, _)| *kind == part.finding) {
            Some((_, count)) => *count += part.rate.count,
            None => by_kind.push((part.finding, part.rate.count)),
        }
    }
    let groups: Vec<_> = grouped(result).collect();
    by_kind.extend(groups.iter().map(|(kind, rate, _)| (*kind, rate.count)));
    let head = html! {
        b { (result.scalar) " " (result.family) }
        @for (kind, count) in by_kind { " " span class={ "key " (kind) } { (group_digits(count)) " " (kind) } }
    }
    .into_string();
    let around = head.len() + 80;
    if room.left() < around {
        return (String::new(), (result.findings.len() + groups.len()) as u64);
    }
    let mut inner = Room::new(room.left() - around);
    let mut body =
        inner.fill(result.findings.iter(), |part| class(result, part, depth).into_string());
    for (kind, rate, ids) in groups {
        inner.add(&mut body, &group(row, result, kind, rate, ids).into_string());
    }
    let left_out = inner.left_out;
    let text = format!("<details class=\"source\"><summary>{head}</summary>{body}</details>");
    room.add(&mut String::new(), &text);
    (text, left_out)
}

fn class(result: &KernelResult, part: &FindingPart, depth: Depth) -> Markup {
    let causes = causes_text(&[result], part.finding, &part.class);
    html! {
        div.class {
            h5 { (part.finding) " of " (part.class) }
            p {
                (share(&part.rate)) ", " (counts(&part.rate))
                @if let Some(causes) = causes { "; why: " (causes) }
                "; worst " (describe_severity(part))
            }
            (example("worst", &part.worst))
            @for first in depth.of(part) { (example("", first)) }
        }
    }
}

fn example(name: &str, example: &Example) -> Markup {
    html! {
        p.example {
            @if !name.is_empty() { (name) " " }
            (code(&example.command))
            @if !example.bits.is_empty() { " " (code(&example.bits)) }
        }
    }
}

/// Cracks, doubles, folds and findings on whole polygons that occurred, with the ids of the first.
fn grouped(result: &KernelResult) -> impl Iterator<Item = (FindingKind, &Rate, &[String])> {
    let across = result.across.iter().flat_map(|across| {
        [
            (FindingKind::Crack, &across.cracks, across.first_cracks.as_slice()),
            (FindingKind::Double, &across.doubles, across.first_doubles.as_slice()),
            (FindingKind::OddFold, &across.odd_folds, across.first_odd_folds.as_slice()),
        ]
    });
    let polygons = polygons(result).into_iter().map(|(kind, rate, _, first)| (kind, rate, first));
    across.chain(polygons).filter(|(_, rate, _)| 0 < rate.count)
}

fn group(
    row: &RowPart,
    result: &KernelResult,
    kind: FindingKind,
    rate: &Rate,
    ids: &[String],
) -> Markup {
    let promised = result.across.as_ref().map_or(Promised::Nothing, |across| across.promised);
    html! {
        div.class {
            h5 { (kind) }
            p {
                (share(rate)) ", " (counts(rate))
                @match kind {
                    FindingKind::Crack | FindingKind::Double => { " crossings; across triangles the contract promises " (promised) }
                    FindingKind::OddFold => { " folds; across triangles the contract promises " (promised) }
                    _ => " polygons"
                }
            }
            @for id in ids {
                p.example { (code(&row.explain_group(result, id))) }
            }
        }
    }
}
