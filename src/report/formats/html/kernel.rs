//! Kernel by kernel: what it promises, its gates, how wrong it is, why and how far.

use super::findings::{self, Depth};
use super::pictures;
use super::questions;
use super::room::Room;
use super::view::{Kind, Row, View};
use super::words::{apart, code, counts, percent, share, shortened};
use crate::kernel::{self, Gate, Tunable};
use crate::prove::units;
use crate::report::formats::row_view::RowView;
use crate::report::formats::why::{CauseShare, cause_shares, short};
use crate::report::record::*;
use crate::report::{ProofPart, ProvedGate};
use crate::report::{group_digits, number_of};
use maud::{Markup, PreEscaped, html};
use std::collections::HashMap;

pub(super) fn section(view: &View, room: &mut Room) -> Markup {
    // A row has its share of what is left, and what earlier rows left of theirs.
    let depth = findings::depth(view, room.left() / 5 * 4);
    let (mut text, mut shown) = (String::new(), 0);
    for (i, row) in view.rows.iter().enumerate() {
        let mut part = room.part(room.left() / (view.rows.len() - i));
        let piece = kernel_row(view, row, depth, &mut part).into_string();
        room.take_back(part);
        if !room.add(&mut text, &piece) {
            break;
        }
        shown += 1;
    }
    let left_out = (view.rows.len() - shown) as u64;
    html! {
        section #kernels aria-labelledby="kernels-title" {
            h2 #kernels-title { "Kernel by kernel" }
            @if let Some(most) = depth.most {
                p.note {
                    "Of each class of findings the worst case and the first " (most) " are shown here; the JSON record has all."
                }
            }
            (PreEscaped(text))
            @if 0 < left_out {
                p.note { (number_of(left_out, "kernel row is", "kernel rows are")) " left out here; the JSON record has all." }
            }
        }
    }
}

/// A row. What it takes of `room` is what its lists may take; the caller counts the whole.
fn kernel_row(view: &View, row: &Row, depth: Depth, room: &mut Room) -> Markup {
    let promise = facts(view, row);
    let tables = html! {
        (causes(row))
        div.tables { (rates(view, row)) (severities(row)) (accuracies(row)) }
    };
    // Counted here, so that the lists below do not take their room.
    let essential = promise.into_string() + &tables.into_string();
    let mut lists = Room::new(room.left().saturating_sub(essential.len() + 2000));
    let pictures = pictures::section(view.record, row, &mut lists);
    let mut quarter = lists.part(lists.left() / 4);
    let families = by_family(view, row, &mut quarter);
    lists.take_back(quarter);
    let findings = findings::list(row, depth, &mut lists);
    html! {
        details.kernel id=(row.anchor) {
            summary {
                h3 { (row.part.kernel) " " span.set { "(" (row.part.set) ")" } }
                @for scalar in &row.scalars {
                    span.sum {
                        (scalar.scalar) " "
                        @for kind in Kind::ALL {
                            span class={ "key " (kind.finding()) } {
                                (kind.pool(scalar).rate().rate.map_or("–".to_owned(), percent)) " " (kind.words())
                            } " "
                        }
                        @if let Some(across) = view.across(row, scalar.scalar) { (questions::in_short(across)) }
                    }
                }
            }
            div.body {
                (PreEscaped(essential))
                (pictures)
                @if !row.part.epsilons.is_empty() && !row.part.selector.is_empty() {
                    h4 { "Every epsilon" }
                    p {
                        "How often the kernel is wrong as one epsilon varies and the others stay: "
                        (code(&format!("hairline epsilon {} --format html -o epsilon.html", row.part.selector)))
                    }
                }
                (families)
                (findings)
            }
        }
    }
}

fn facts(view: &View, row: &Row) -> Markup {
    let plan_flags = view.record.provenance.plan_flags.clone().unwrap_or_default();
    // Answers from elsewhere have no selector, whatever their product is called.
    let is_run = !row.part.selector.is_empty();
    let info = kernel::find(&row.part.kernel).filter(|_| is_run).map(|entry| entry.info);
    let gates: &[Gate] = info.map_or(&[], |info| info.gates);
    let unknown = row
        .part
        .epsilons
        .iter()
        .filter(|(name, _)| gates.iter().all(|gate| gate.name != name.as_str()));
    let all = view.record.illustrations.iter().flat_map(|all| &all.proofs);
    let proofs: Vec<&ProofPart> = all.filter(|proof| proof.kernel == row.part.kernel).collect();
    html! {
        dl.facts {
            dt { "Contract" } dd { (row.part.contract) }
            @if let Some(info) = info { dt { "Source" } dd { (info.source) } }
            @for note in view.record.provenance.kernel_notes.get(&row.part.kernel).into_iter().flatten() {
                dt { "Note" } dd { (shortened(note, 400)) }
            }
            @for alike in proofs.chunk_by(|one, other| one.edges == other.edges) {
                dt { "Edges" @if alike.len() < proofs.len() { ", " (alike[0].scalar) } }
                dd { (shortened(&alike[0].edges, 600)) }
            }
            @if is_run { dt { "Run again" } dd { (code(&plan_flags.command(&row.part.flags()))) } }
        }
        @if !row.part.epsilons.is_empty() || !gates.is_empty() {
            div.scroll tabindex="0" role="group" aria-label="Gates" {
                table {
                    caption { "Gates, in the order of the test" }
                    thead { tr { th scope="col" { "gate" } th.text scope="col" { "refuses where" } th scope="col" { "epsilon e" } th scope="col" { "dimension" }
                        @for proof in &proofs { th scope="col" { "proved, " (proof.scalar) " (known)" } }
                    } }
                    tbody {
                        @for gate in gates {
                            tr {
                                th scope="row" { (gate.name) }
                                td.text { (gate.refuses) }
                                td { @match (gate.epsilon, row.part.epsilons.get(gate.name)) {
                                    (Tunable::Fixed, _) => "takes none",
                                    (_, Some(value)) => (value),
                                    (_, None) => "–",
                                } }
                                td { "length" sup { (gate.dimension.length) } " · |d|" sup { (gate.dimension.direction) } }
                                @for proof in &proofs { td { (proved(proof, gate.name)) } }
                            }
                        }
                        @for (name, value) in unknown {
                            tr { th scope="row" { (name) } td { "–" } td { (value) } td { "–" } }
                        }
                    }
                }
            }
            @if !proofs.is_empty() {
                p.note {
                    "Proved: in the unit domain what the gate compares is never wrong by more. The domain: coordinates of points and of their "
                    "differences, and of d, at most 1; where a kernel divides, divisors of 1/2 and more and quotients of at most 1. A bound supposes "
                    "only what the gate's numbers use. u is 2" sup { "−24" } " in f32 and 2" sup { "−53" } " in f64. Known: the worst case found. "
                    "What each bound supposes: " (code("hairline prove")) ". For other sizes: "
                    (code(&format!("hairline prove --kernel {} --scene city", row.part.kernel)))
                }
            }
        }
    }
}

/// How wrong at most what a gate compares is, and the worst that is known.
fn proved(proof: &ProofPart, gate: &str) -> String {
    let units = |error: f64, up: bool| format!("{} u", units(error, up));
    match proof.gates.get(gate) {
        None => "–".to_owned(),
        Some(ProvedGate { bound: None, .. }) => "no bound".to_owned(),
        Some(ProvedGate { bound: Some(bound), known: None }) => units(*bound, true),
        Some(ProvedGate { bound: Some(bound), known: Some(known) }) => {
            format!("{} ({})", units(*bound, true), units(*known, false))
        }
    }
}

/// The sums over all sources, scalar by scalar.
fn rates(view: &View, row: &Row) -> Markup {
    type Get = fn(&KernelResult) -> Option<&Rate>;
    type Count = fn(&Counts) -> u64;
    let columns: [(&str, Get); 11] = [
        ("false misses", |r| Some(&r.total.false_misses)),
        ("false hits", |r| Some(&r.total.false_hits)),
        ("bad values", |r| Some(&r.total.bad_values)),
        ("wrong values", |r| Some(&r.total.wrong_values)),
        ("cracks", |r| Some(&r.across.as_ref()?.cracks)),
        ("doubles", |r| Some(&r.across.as_ref()?.doubles)),
        ("odd folds", |r| Some(&r.across.as_ref()?.odd_folds)),
        ("missed folds", |r| Some(&r.across.as_ref()?.missed_folds)),
        ("self-hits", |r| r.self_hits.as_ref()),
        ("polygon false misses", |r| Some(&r.polygons.as_ref()?.false_misses)),
        ("polygon false hits", |r| Some(&r.polygons.as_ref()?.false_hits)),
    ];
    let asked = |get: Get| row.scalars.iter().any(|scalar| 0 < scalar.total(get).counts()[1]);
    let failures: [(&str, Count); 3] = [
        ("panics", |counts| counts.panics),
        ("crashes", |counts| counts.crashes),
        ("timeouts", |counts| counts.timeouts),
    ];
    let sum = |scalar: &RowView, count: Count| -> u64 {
        scalar.results.iter().map(|result| count(&result.total)).sum()
    };
    let failures = failures.into_iter();
    let failures: Vec<_> =
        failures.filter(|(_, n)| row.scalars.iter().any(|s| 0 < sum(s, *n))).collect();
    let label = format!("{} ({})", row.part.kernel, row.part.set);
    let time = |scalar: &RowView| {
        let times = view.record.provenance.kernel_nanoseconds.get(scalar.scalar)?;
        times.get(&label).map(|time| format!("{time:.1}"))
    };
    html! {
        div.scroll tabindex="0" role="group" aria-label="Rates" {
            table {
                caption { "All families together" }
                thead { tr {
                    th scope="col" { "rate" }
                    @for scalar in &row.scalars { th scope="col" { (scalar.scalar) } }
                } }
                tbody {
                    @for (name, get) in columns {
                        @if asked(get) {
                            tr { th scope="row" { (name) }
                                @for scalar in &row.scalars {
                                    @let sum = scalar.total(get);
                                    td { (share(sum.rate())) small { (counts(sum.rate())) (apart(&sum)) } }
                                }
                            }
                        }
                    }
                    @for (name, count) in failures {
                        tr { th scope="row" { (name) }
                            @for scalar in &row.scalars { td { (group_digits(sum(scalar, count))) } }
                        }
                    }
                    tr { th scope="row" { "ns a ray" }
                        @for scalar in &row.scalars { td { (time(scalar).unwrap_or("–".to_owned())) } }
                    }
                }
            }
        }
    }
}

/// Why, as bars and in words.
fn causes(row: &Row) -> Markup {
    let shares = |scalar: &RowView, kind: Kind| cause_shares(&scalar.results, kind.finding(), "");
    let all = row.scalars.iter().flat_map(|scalar| {
        Kind::ALL.map(|kind| Some((scalar.scalar, kind, shares(scalar, kind)?)))
    });
    let all: Vec<(&str, Kind, Vec<CauseShare>)> = all.flatten().collect();
    html! {
        @if !all.is_empty() {
            h4 { "Why" }
            dl.causes {
                @for (scalar, kind, shares) in &all {
                    dt { (scalar) " " (kind.words()) }
                    dd { (bar(shares)) p { (cause_words(shares)) } }
                }
            }
        }
    }
}

fn cause_words(shares: &[CauseShare]) -> Markup {
    html! {
        @for (i, (cause, share, interval)) in shares.iter().enumerate() {
            @if 0 < i { ", " }
            span class={ "cause " (cause.name()) } { (cause.name()) } " " (percent(*share))
            @if let Some(ends) = interval { " [" (super::words::interval(*ends)) "]" }
        }
    }
}

/// A bar of 100 units, with a gap between its parts.
fn bar(shares: &[CauseShare]) -> Markup {
    let starts = shares.iter().scan(0.0, |sum, (_, share, _)| {
        let start = *sum;
        *sum += share * 100.0;
        Some(start)
    });
    html! {
        svg.bar viewBox="0 0 100 4" preserveAspectRatio="none" aria-hidden="true" {
            @for ((cause, share, _), start) in shares.iter().zip(starts) {
                @let wide = (share * 100.0 - 0.3).max(0.15);
                rect class=(cause.name()) x=(format!("{start:.2}")) y="0" width=(format!("{wide:.2}")) height="4" {}
            }
        }
    }
}

fn severities(row: &Row) -> Markup {
    let parts = row.scalars.iter().flat_map(|scalar| {
        let of = |kind: Kind| scalar.total?.severity.get(&kind.finding());
        Kind::ALL.map(|kind| Some((scalar.scalar, kind, of(kind)?)))
    });
    let parts: Vec<_> = parts.flatten().collect();
    html! {
        @if !parts.is_empty() {
            div.scroll tabindex="0" role="group" aria-label="Severity" {
                table {
                    caption { "Severity: how far inside or outside, in longest edges (in ulps of the largest coordinate)" }
                    thead { tr { th scope="col" { "findings" } th scope="col" { "half within" } th scope="col" { "90 %" } th scope="col" { "99 %" } th scope="col" { "all" } } }
                    tbody {
                        @for (scalar, kind, part) in parts {
                            tr {
                                th scope="row" { (scalar) " " (kind.words()) }
                                @for (edges, ulps) in quantiles(&part.edges).into_iter().zip(quantiles(&part.ulps)) {
                                    td { (edges) small { (ulps) " ulps" } }
                                }
                            }
                        }
                    }
                }
            }
        }
    }
}

fn quantiles(part: &Distribution) -> [String; 4] {
    [part.median, part.percent_90, part.percent_99, part.worst].map(short)
}

fn accuracies(row: &Row) -> Markup {
    let names = [("t", "t"), ("uv", "u and v"), ("point", "o + t·d")];
    let parts = row.scalars.iter().flat_map(|scalar| {
        let of = |name: &str| scalar.total?.accuracy.get(name);
        names.map(|(key, name)| Some((scalar.scalar, name, of(key)?)))
    });
    let parts: Vec<_> = parts.flatten().collect();
    html! {
        @if !parts.is_empty() {
            div.scroll tabindex="0" role="group" aria-label="Accuracy" {
                table {
                    caption { "Errors of the values of right hits, in ulps" }
                    thead { tr { th scope="col" { "value" } th scope="col" { "hits" } th scope="col" { "half within" } th scope="col" { "90 %" } th scope="col" { "99 %" } th scope="col" { "all" } } }
                    tbody {
                        @for (scalar, name, part) in parts {
                            tr {
                                th scope="row" { (scalar) " " (name) }
                                td { (group_digits(part.count)) }
                                @for number in quantiles(part) { td { (number) } }
                            }
                        }
                    }
                }
            }
        }
    }
}

/// Every source with its counts and intervals.
fn by_family(view: &View, row: &Row, room: &mut Room) -> Markup {
    let results: Vec<HashMap<&str, &KernelResult>> = row
        .scalars
        .iter()
        .map(|scalar| {
            scalar.results.iter().map(|result| (result.family.as_str(), *result)).collect()
        })
        .collect();
    let lines = room.fill(view.families.iter(), |family| {
        html! {
            tr {
                th scope="row" { (family) }
                @for results in &results {
                    @for kind in Kind::ALL {
                        @match results.get(family).map(|result| kind.rate(&result.total)).filter(|rate| 0 < rate.of) {
                            Some(rate) => td { (share(rate)) small { (counts(rate)) } },
                            None => td { "–" },
                        }
                    }
                }
            }
        }
        .into_string()
    });
    html! {
        details.more {
            summary { "Family by family" }
            div.scroll tabindex="0" role="group" aria-label="Family by family" {
                table {
                    thead { tr {
                        th scope="col" { "family" }
                        @for scalar in &row.scalars {
                            @for kind in Kind::ALL { th scope="col" { (scalar.scalar) " " (kind.words()) } }
                        }
                    } }
                    tbody { (PreEscaped(lines)) }
                }
            }
            @if 0 < room.left_out { p.note { (number_of(room.left_out, "family is", "families are")) " left out here; the JSON record has all." } }
        }
    }
}
