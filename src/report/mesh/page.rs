//! A mesh audit as one HTML file that needs nothing else, with the mesh drawn and its leaks marked. A script
//! turns the mesh; without it a picture stands still, and tables hold the first places of each row.

use super::record::*;
use super::screen::{topology_lines, verdict};
use super::shown::{Shown, shown};
use super::stage;
use crate::report::page::Tone;
use crate::report::page::html::words::{counts, interval, percent, shortened};
use crate::report::page::html::{SHARED, STYLE, head_of, policy, shade};
use crate::report::{Promised, Rate, Style, group_digits, number_of};
use maud::{DOCTYPE, Markup, PreEscaped, html};
use std::io::{self, Write};

/// The style and the script that only this page has.
const OWN_STYLE: &str = include_str!("view.css");
const OWN_SCRIPT: &str = include_str!("view.js");

/// Writes a report that has a drawing.
pub(super) fn write(report: &MeshReport, _: Style, out: &mut dyn Write) -> io::Result<()> {
    let Some(drawing) = &report.drawing else { return Ok(()) };
    let (style, script) = (format!("{STYLE}{OWN_STYLE}"), format!("{SHARED}{OWN_SCRIPT}"));
    let result = &report.record.result;
    let rows = shown(&report.record, drawing);
    let (tone, title) = verdict(result);
    let (class, mark) = match tone {
        Tone::Good => ("good", "✓ "),
        Tone::Bad => ("bad", "✕ "),
        Tone::Plain | Tone::Stale => ("plain", ""),
    };
    let page = html! {
        (DOCTYPE)
        html lang="en" {
            (head_of(&title, &policy(&style, &script), &style))
            body {
                a.skip href="#main" { "Skip to the report" }
                header class={ "top " (class) } {
                    p.mark { "hairline" span { " mesh" } }
                    h1 { (mark) (title) }
                    p.lede {
                        (number_of(result.mesh.triangles, "triangle", "triangles")) ", "
                        (number_of(result.mesh.vertices, "vertex", "vertices")) ", digest " (result.mesh.digest) "; "
                        (number_of(result.directions, "ray", "rays")) " aimed at each edge of two faces and at each vertex inside a closed fan"
                        @if result.unit_directions { ", with unit directions" } ", seed " (result.seed) "."
                    }
                    @for note in &result.mesh.notes { p.lede { (shortened(note, 400)) } }
                    nav aria-label="Report" {
                        a href="#rates" { "How often" } a href="#where" { "Where" } a href="#rows" { "Row by row" }
                        a href="#guide" { "How to read" } a href="#about" { "About this run" }
                    }
                }
                main #main {
                    (rates(&rows))
                    (stage::drawing(result, drawing, &rows))
                    section #rows aria-labelledby="rows-title" {
                        h2 #rows-title { "Row by row" }
                        p {
                            "The first places of each row, with the first ray that shows each. Vertices have their numbers in the "
                            "file (those with equal coordinates the number of the first), faces "
                            @if drawing.has_lines { "the lines of the file." } @else { "are counted from 1." }
                        }
                        @for (i, row) in rows.iter().enumerate() { (stage::places(i, drawing, row)) }
                    }
                    (guide())
                }
                (foot(&report.record))
                script { (PreEscaped(script)) }
            }
        }
    };
    out.write_all(page.into_string().as_bytes())
}

fn rates(rows: &[Shown]) -> Markup {
    html! {
        section #rates aria-labelledby="rates-title" {
            h2 #rates-title { "How often" }
            p {
                "Shares of rays aimed at edges, and of rays aimed at vertices, that cross the surface there. Half of them meet "
                "their edge or vertex exactly, where floats allow it; rays at the whole mesh rarely come so near. Orange: what "
                "the contract rules out; blue: cracks where it promises nothing."
            }
            div.scroll role="group" aria-label="The table" tabindex="0" {
                table.heat.few #rates-table {
                    thead { tr {
                        th scope="col" { "kernel (epsilons)" }
                        th.text scope="col" data-sort="" { "promised" }
                        th scope="col" data-sort="" { "cracks, of rays aimed at edges" }
                        th scope="col" data-sort="" { "cracks, of rays aimed at vertices" }
                        th scope="col" data-sort="" { "doubles, of both" }
                        th scope="col" data-sort="" { "wrong at folds, of both" }
                        th scope="col" data-sort="" { "perhaps elsewhere" }
                        th scope="col" data-sort="" { "edges that leak" }
                        th scope="col" data-sort="" { "vertices that leak" }
                        th scope="col" data-sort="" { "no verdict" }
                        th scope="col" data-sort="" { "ns a ray" }
                    } }
                    tbody { @for (i, row) in rows.iter().enumerate() { (rate_row(i, row)) } }
                }
            }
        }
    }
}

fn rate_row(number: usize, row: &Shown) -> Markup {
    let MeshRowResult { edges, vertices, promised, .. } = row.result;
    let hue = if *promised == Promised::Nothing { "h" } else { "m" };
    let exact = if *promised == Promised::ExactlyOne { "m" } else { "" };
    let count = |n: u64| html! { td data-v=(n) { (group_digits(n)) } };
    let of = |part: &MeshPartResult| {
        html! { td data-v=(part.cracked) { (group_digits(part.cracked)) small { "of " (group_digits(part.of)) } } }
    };
    html! {
        tr {
            th scope="row" {
                a href={ "#r" (number) } { (row.result.kernel) } " " span.set { "(" (row.result.set) ")" } " "
                span.what { (row.scalar) }
            }
            @match row.result.promise() {
                None => { td.text.set data-v="0" { "nothing" } },
                Some((hits, true)) => { td.text.kept data-v="1" { (hits) ": kept" } },
                Some((hits, false)) => { td.text.broken data-v="2" { (hits) ": BROKEN" } },
            }
            (share(&edges.total.cracks, hue))
            (share(&vertices.total.cracks, hue))
            (share(&row.result.both(|rates| &rates.doubles), exact))
            (share(&row.result.both(|rates| &rates.odd_folds), exact))
            (count(edges.total.elsewhere.count + vertices.total.elsewhere.count))
            (of(edges)) (of(vertices))
            (count(row.failures()))
            @match row.nanoseconds {
                Some(time) => { td data-v=(format!("{time:.3e}")) { (format!("{time:.1}")) } },
                None => { td { "–" } },
            }
        }
    }
}

fn share(rate: &Rate, hue: &str) -> Markup {
    let Some(share) = rate.rate else { return html! { td { "–" } } };
    let class = if hue.is_empty() { String::new() } else { format!("{hue}{}", shade(share)) };
    html! {
        td class=(class) data-v=(format!("{share:.3e}")) title=(counts(rate)) {
            (percent(share)) small { @if let Some(ends) = rate.interval { (interval(ends)) } }
        }
    }
}

fn guide() -> Markup {
    html! {
        section #guide aria-labelledby="guide-title" {
            h2 #guide-title { "How to read" }
            dl.guide {
                dt { "Crack" }
                dd { "All triangles around the edge or vertex face the ray alike, the exact line passes through their union, and none of them reports a hit, nor does a neighbour that may have received it." }
                dt { "Double" }
                dd { "Two triangles or more around the edge or vertex report such a ray." }
                dt { "Wrong at a fold" }
                dd { "Two triangles that do not face the ray alike: there the parity of the number of hits is judged." }
                dt { "Perhaps elsewhere" }
                dd { "A crossing that is not called a crack, because rounding may have moved its hit to a neighbour." }
                dt { "Promised" }
                dd { "How many triangles of a surface report a ray that crosses it. " em { ">= 1" } ": no ray slips through. " em { "= 1" } ": none is reported twice either. A contract that promises nothing has its cracks counted and marked, and breaks no promise." }
                dt { "95 % interval" }
                dd { "Clopper–Pearson, of a random sample. 0 of 2,175 is a rate below 0.17 %, not a rate of 0." }
            }
        }
    }
}

fn foot(record: &MeshRecord) -> Markup {
    let provenance = &record.provenance;
    html! {
        footer #about {
            h2 { "About this run" }
            dl.about {
                dt { "Tool" } dd { (shortened(&provenance.tool, 200)) }
                dt { "Mesh" } dd { code { (record.result.mesh.file) } }
                @for part in &record.result.scalars {
                    dt { (part.scalar) }
                    dd {
                        (group_digits(part.topology.points)) " points; "
                        (group_digits(part.rays[0])) " rays aimed at edges, " (group_digits(part.rays[1])) " at vertices"
                        @for (name, line) in topology_lines(&part.topology) { br; (name) " " (line) }
                    }
                }
                dt { "Target" } dd { (shortened(&provenance.target, 200)) }
                dt { "Time" } dd { (format!("{:.1} s", provenance.seconds)) " on " (number_of(provenance.threads as u64, "thread", "threads")) }
                @for (kernel, notes) in &provenance.kernel_notes {
                    @for note in notes { dt { "Note" } dd { (shortened(kernel, 200)) ": " (shortened(note, 400)) } }
                }
            }
            p {
                "Every number of this page is in the JSON record: add "
                code { "--format html,json -o mesh.html -o mesh.json" } " to the command. With "
                code { "--examples N" } " it has the first N places of each kind."
            }
        }
    }
}
