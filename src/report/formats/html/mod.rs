//! The record as one HTML file that needs nothing else: light and dark, wide and narrow, on paper, by
//! keyboard, without scripts (which sort and filter, no more) and without a network.
//!
//! Whatever stands in the record is escaped by the templates; the page's own policy lets only its own
//! style and script run.

mod deviations;
mod findings;
mod heat;
mod kernel;
mod pictures;
mod questions;
pub(in crate::report) mod room;
mod view;
pub(in crate::report) mod words;

use super::record::Provenance;
use super::{Record, Style, number_of};
use base64::Engine;
use base64::prelude::BASE64_STANDARD;
pub(in crate::report) use heat::shade;
use hmac_sha256::Hash;
use maud::{DOCTYPE, Markup, PreEscaped, html};
use room::Room;
use std::io::{self, Write};
use view::View;
use words::{code, shortened};

/// A report has fewer bytes.
const LIMIT: usize = 9_800_000;

pub(in crate::report) const STYLE: &str = include_str!("style.css");
/// Makes tables sortable, and opens what a link leads to.
pub(in crate::report) const SHARED: &str = include_str!("shared.js");
const SCRIPT: &str = concat!(include_str!("shared.js"), include_str!("script.js"));

/// Writes the record.
pub(super) fn write(record: &Record, _: Style, out: &mut dyn Write) -> io::Result<()> {
    out.write_all(within(record, LIMIT).as_bytes())
}

/// The record in fewer bytes than a limit.
fn within(record: &Record, limit: usize) -> String {
    let view = View::new(record);
    // For what stands around the lists.
    let around = STYLE.len() + SCRIPT.len() + 40_000;
    let mut room = Room::new(limit.saturating_sub(around));
    let deviations = deviations::section(record, &mut room);
    let questions = questions::section(&view, &mut room);
    let heat = heat::section(&view, &mut room);
    let kernels = kernel::section(&view, &mut room);
    let title = shortened(&verdict(&view), 300);
    let page = html! {
        (DOCTYPE)
        html lang="en" {
            (head_of(&title, &policy(STYLE, SCRIPT), STYLE))
            body {
                a.skip href="#main" { "Skip to the report" }
                (head(&view, &title))
                main #main {
                    (deviations)
                    (questions)
                    (heat)
                    (kernels)
                    (guide())
                }
                (foot(record))
                script { (PreEscaped(SCRIPT)) }
            }
        }
    };
    page.into_string()
}

/// The head of a page that needs nothing else, by a policy that holds it to that.
pub(in crate::report) fn head_of(title: &str, policy: &str, style: &str) -> Markup {
    html! {
        head {
            meta charset="utf-8";
            meta name="viewport" content="width=device-width, initial-scale=1";
            meta name="color-scheme" content="light dark";
            meta http-equiv="Content-Security-Policy" content=(policy);
            title { "hairline: " (title) }
            style { (PreEscaped(style)) }
        }
    }
}

/// Nothing from elsewhere, no script and no style but the page's own, pictures from the page itself.
pub(in crate::report) fn policy(style: &str, script: &str) -> String {
    let digest = |text: &str| BASE64_STANDARD.encode(Hash::hash(text.as_bytes()));
    format!(
        "default-src 'none'; img-src data:; style-src 'sha256-{}'; script-src 'sha256-{}'; base-uri 'none'; form-action 'none'",
        digest(style),
        digest(script)
    )
}

/// Nothing but a style.
pub(in crate::report) fn style_policy(style: &str) -> String {
    let digest = BASE64_STANDARD.encode(Hash::hash(style.as_bytes()));
    format!("default-src 'none'; style-src 'sha256-{digest}'; base-uri 'none'; form-action 'none'")
}

/// In one line.
fn verdict(view: &View) -> String {
    if let Some(conformance) = &view.record.conformance {
        let summary = conformance.summary();
        let (first, rest) = summary.split_at(summary.chars().next().map_or(0, char::len_utf8));
        return format!("{}{rest}", first.to_uppercase());
    }
    let rows = view.rows.len() as u64;
    let wrong = view.rows.iter().filter(|row| 0 < row.findings()).count() as u64;
    let rows_text = number_of(rows, "kernel row", "kernel rows");
    match (rows, wrong) {
        (0, _) => "No kernel ran".to_owned(),
        (1, 0) => "No findings: the kernel row is right on every case".to_owned(),
        (_, 0) => format!("No findings: {rows_text} are right on every case"),
        (1, _) => "The kernel row disagrees with exact arithmetic somewhere".to_owned(),
        (n, w) if n == w => format!("All {rows_text} disagree with exact arithmetic somewhere"),
        (_, w) => {
            let verb = if w == 1 { "disagrees" } else { "disagree" };
            format!("{w} of {rows_text} {verb} with exact arithmetic somewhere")
        }
    }
}

fn head(view: &View, title: &str) -> Markup {
    let record = view.record;
    let result = &record.result;
    let class = record.conformance.as_ref().map_or("plain", |conformance| {
        use super::Verdict::*;
        match conformance.verdict {
            Conforms => "good",
            Disagreements => "bad",
            Stale => "stale",
        }
    });
    let mark = match class {
        "good" => "✓ ",
        "bad" => "✕ ",
        "stale" => "△ ",
        _ => "",
    };
    let findings: u64 = view.rows.iter().map(|row| row.findings()).sum();
    let clean = view.rows.iter().filter(|row| row.findings() == 0);
    let clean: Vec<String> = clean
        .map(|row| shortened(&format!("{} ({})", row.part.kernel, row.part.set), 80))
        .take(20)
        .collect();
    let cases: u64 = result.sources.iter().map(|source| source.cases).sum();
    html! {
        header class={ "top " (class) } {
            p.mark { "hairline" span { " report" } }
            h1 { (mark) (title) }
            p.lede {
                (number_of(view.rows.len() as u64, "kernel row", "kernel rows")) " on "
                (number_of(view.families.len() as u64, "source of cases", "sources of cases")) " in "
                (shortened(&result.plan.scalars.join(" and "), 80)) ": " (number_of(cases, "case", "cases"))
                ", each decided by exact predicates and judged by what the kernel's own contract promises; "
                (number_of(findings, "finding", "findings")) "."
                @if !clean.is_empty() { " Without any: " (clean.join(", ")) "." }
            }
            @if let Some(partial) = &result.partial {
                p.warn {
                    "This is a part of a run: " (partial.present.len()) " of " (partial.of) " shards. "
                    "What it says is of those alone."
                }
            }
            @let broken: u64 = result.sources.iter().map(|source| source.promise_broken).sum();
            @if 0 < broken {
                p.warn { (number_of(broken, "index is", "indices are")) " not what its family promises." }
            }
            nav aria-label="Report" {
                @if record.conformance.is_some() { a href="#deviations" { "Deviations" } }
                a href="#questions" { "Kernels by question" }
                a href="#heat" { "Kernels × families" }
                a href="#kernels" { "Kernel by kernel" }
                a href="#guide" { "How to read" }
                a href="#about" { "About this run" }
            }
        }
    }
}

fn guide() -> Markup {
    html! {
        section #guide aria-labelledby="guide-title" {
            h2 #guide-title { "How to read" }
            dl.guide {
                dt { "Kernel row" }
                dd { "A kernel with a set of epsilons: " em { "source" } " as its source prints them; where it gives no value there are two rows, " em { "zero" } " and " em { "1e-6" } "." }
                dt { "False miss, false hit" }
                dd { "The contract asks for a hit and the kernel reports a miss; it asks for a miss and the kernel reports a hit. What is true is decided exactly on the floats that the kernel was given." }
                dt { "95 % interval" }
                dd { "Clopper–Pearson, of a random sample; the triangles of one ray count as the fewer independent trials that they are. 0 of 2,175 is a rate below 0.17 %, not a rate of 0. Stored and exhaustive sets have counts and no interval." }
                dt { "Cause" }
                dd { em { "Convention" } ": the formula means something else than the contract. " em { "Epsilon" } ": the tolerance itself is to blame. " em { "Rounding" } ": the formula is right, the floats are not. " em { "Range" } ": as rounding, by overflow or underflow." }
                dt { "Severity" }
                dd { "How far the case is from where the verdict would be right, exactly: in the triangle's longest edges, and in ulps of the largest coordinate." }
                dt { "Crack, double" }
                dd { "A ray through the inside of a fan, a polygon or a shared edge that no triangle reports, or two do." }
                dt { "Promised" }
                dd { "How many triangles of a surface report a ray that crosses it. " em { "≥ 1" } ": no ray slips through, no crack. " em { "= 1" } ": no double either. A contract that promises nothing has its cracks and doubles counted, and no finding." }
                dt { "Odd fold, missed fold" }
                dd { "Where a surface folds back along an edge, a line through the edge meets both triangles. " em { "Odd" } ": one of them reported it, which swaps inside and outside where hits are counted. " em { "Missed" } ": none did." }
                dt { "Self-hit" }
                dd { "A ray that starts at a rounded hit point on a triangle hits that triangle again." }
                dt { "Replay" }
                dd { "Each case has a command. It makes the case again from its id and shows the exact truth and each gate's margin." }
            }
        }
    }
}

/// Where and how long a run was made, and what should be known of its kernels.
pub(in crate::report) fn made(provenance: &Provenance) -> Markup {
    html! {
        dt { "Target" } dd { (shortened(&provenance.target, 200)) }
        dt { "Time" } dd { (format!("{:.1} s", provenance.seconds)) " on " (number_of(provenance.threads as u64, "thread", "threads")) }
        @for (kernel, notes) in &provenance.kernel_notes {
            @for note in notes { dt { "Note" } dd { (shortened(kernel, 200)) ": " (shortened(note, 400)) } }
        }
    }
}

fn foot(record: &Record) -> Markup {
    let (plan, provenance) = (&record.result.plan, &record.provenance);
    html! {
        footer #about {
            h2 { "About this run" }
            dl.about {
                dt { "Tool" } dd { (shortened(&provenance.tool, 200)) }
                dt { "Plan" } dd { code { (shortened(&plan.hash, 200)) } }
                @if let Some(flags) = &provenance.plan_flags {
                    dt { "Run again" } dd { (code(&flags.command(&flags.kernels))) }
                }
                (made(provenance))
                @if !provenance.parts.is_empty() {
                    dt { "Merged from" } dd { (number_of(provenance.parts.len() as u64, "shard", "shards")) }
                }
            }
            p {
                "Everything in this page, and what it leaves out, is in the JSON record: add "
                code { "--format html,json -o report.html -o report.json" } " to the command."
            }
        }
    }
}

#[cfg(test)]
pub(super) mod tests;
