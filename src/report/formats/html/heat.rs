//! Kernels × families: how often each is wrong, in numbers and in shades.

use super::room::Room;
use super::view::{Kind, Row, View};
use super::words::{apart, counts, interval, percent};
use crate::report::formats::pool::Pool;
use crate::report::formats::row_view::RowView;
use crate::report::number_of;
use crate::report::record::Rate;
use maud::{Markup, PreEscaped, html};
use std::collections::HashMap;

/// Bytes for the table.
const MOST: usize = 2_500_000;

/// Bytes for the heads of columns: some 300 families.
const MOST_COLUMNS: usize = 16_000;

/// Where shades begin, as shares; below the first there is one for what is not nought.
const SHADES: [f64; 4] = [0.001, 0.01, 0.1, 0.5];

pub(super) const SHADE_NAMES: [&str; 6] =
    ["none found", "below 0.1 %", "0.1 to 1 %", "1 to 10 %", "10 to 50 %", "50 % and more"];

pub(super) fn section(view: &View, room: &mut Room) -> Markup {
    let mut part = room.part(MOST);
    let head = columns(view, &mut part);
    let families = &view.families[..view.families.len() - part.left_out as usize];
    let missing = std::mem::take(&mut part.left_out);
    let lines: Vec<(&Row, &RowView, Kind)> = view
        .rows
        .iter()
        .flat_map(|row| row.scalars.iter().map(move |scalar| (row, scalar)))
        .flat_map(|(row, scalar)| Kind::ALL.map(|kind| (row, scalar, kind)))
        .collect();
    let body = part
        .fill(lines.iter(), |(row, scalar, kind)| line(families, row, scalar, *kind).into_string());
    let left_out = part.left_out;
    room.take_back(part);
    html! {
        section #heat aria-labelledby="heat-title" {
            h2 #heat-title { "Kernels × families" }
            p {
                "The share of the cases that must be hit and were missed, and of those that must be missed and "
                "were hit, with the 95 % interval. A dash: the family has no such case."
            }
            (legend())
            form.filters #filters hidden aria-label="Filter the table" {
                label { "Kernel " input #filter-kernel type="search" autocomplete="off" spellcheck="false" placeholder="part of a name"; }
                label { "Scalar "
                    select #filter-scalar {
                        option value="" { "all" }
                        @for scalar in view.record.result.plan.scalars.iter().take(8).filter(|name| name.len() < 80) { option value=(scalar) { (scalar) } }
                    }
                }
                label { "Finding "
                    select #filter-finding {
                        option value="" { "both" }
                        @for kind in Kind::ALL { option value=(kind.finding()) { (kind.words()) } }
                    }
                }
                button #filter-reset type="reset" { "Reset" }
                output #filter-count for="filter-kernel filter-scalar filter-finding" aria-live="polite" {}
            }
            div.scroll.tall role="group" aria-label="The table" tabindex="0" {
                table.heat.few[families.len() < 16] #heat-table {
                    caption.hidden { "Shares of wrong answers by kernel row, scalar and finding, and by source of cases." }
                    thead { tr {
                        th scope="col" { "kernel (epsilons)" }
                        th scope="col" data-sort="" { "all" }
                        (PreEscaped(head))
                    } }
                    tbody { (PreEscaped(body)) }
                }
            }
            @if 0 < left_out {
                p.note { (number_of(left_out, "row is", "rows are")) " left out here; the JSON record has all." }
            }
            @if 0 < missing {
                p.note { (number_of(missing, "source of cases is", "sources of cases are")) " left out here; the JSON record has all." }
            }
        }
    }
}

/// The heads of the families' columns; those that do not fit are counted.
fn columns(view: &View, room: &mut Room) -> String {
    let mut columns = room.part(MOST_COLUMNS);
    let text = columns.fill(view.families.iter(), |family| {
        html! { th scope="col" data-sort="" { (family) } }.into_string()
    });
    room.left_out = columns.left_out;
    text
}

fn line(families: &[&str], row: &Row, scalar: &RowView, kind: Kind) -> Markup {
    let by_family: HashMap<&str, &Rate> = scalar
        .results
        .iter()
        .map(|result| (result.family.as_str(), kind.rate(&result.total)))
        .collect();
    let all = kind.pool(scalar);
    html! {
        tr data-kernel={ (row.part.kernel) " (" (row.part.set) ")" } data-scalar=(scalar.scalar) data-finding=(kind.finding()) {
            th scope="row" {
                a href={ "#" (row.anchor) } { (row.part.kernel) } " "
                span.set { "(" (row.part.set) ")" } " "
                span.what { (scalar.scalar) " " span class={ "key " (kind.finding()) } { (kind.words()) } }
            }
            (cell(kind, Some(all.rate()), Some(&all)))
            @for family in families {
                (cell(kind, by_family.get(family).copied(), None))
            }
        }
    }
}

/// A share with its interval, or its count where there is no interval; and what a sum holds beside.
fn cell(kind: Kind, rate: Option<&Rate>, sum: Option<&Pool>) -> Markup {
    let Some((rate, share)) = rate.and_then(|rate| Some((rate, rate.rate?))) else {
        return html! { td { "–" } };
    };
    let letter = if kind == Kind::Miss { "m" } else { "h" };
    html! {
        td class={ (letter) (shade(share)) } data-v=(format!("{share:.3e}")) {
            (percent(share))
            small { @match rate.interval {
                Some(ends) => (interval(ends)),
                None => (counts(rate)),
            } @if let Some(sum) = sum { (apart(sum)) } }
        }
    }
}

/// From 0 for nothing to 5.
pub(in crate::report) fn shade(share: f64) -> usize {
    if share == 0.0 { 0 } else { 1 + SHADES.iter().filter(|start| **start <= share).count() }
}

fn legend() -> Markup {
    html! {
        div.legend role="group" aria-label="Shades" {
            @for (kind, letter) in Kind::ALL.into_iter().zip(["m", "h"]) {
                p {
                    b { (kind.words()) }
                    @for (i, name) in SHADE_NAMES.iter().enumerate() {
                        span class={ (letter) (i) } { (name) }
                    }
                }
            }
        }
    }
}
