//! A study of a scene as one HTML file that needs nothing else: light and dark, wide and narrow, without
//! scripts and without a network.

use super::answer::{Answer, answer};
use super::legend::legend;
use super::plot::{WIDTH, footer, panels};
use super::record::{SceneKernelPart, SceneRecord};
use crate::report::formats::html::{STYLE, head_of, style_policy};
use crate::report::{Style, chart};
use maud::{DOCTYPE, Markup, PreEscaped, html};
use std::io::{self, Write};

/// The style that only this page has.
const OWN_STYLE: &str = "
svg.chart { width: 100%; max-width: 34rem; height: auto; }
.use { font-size: 1.05rem; } .use::first-letter { text-transform: uppercase; } .use code { font-size: .9rem; }
pre { white-space: pre-wrap; overflow-wrap: anywhere; } .scroll { width: fit-content; } td { white-space: nowrap; } th[scope=row] { min-width: 8.5rem; }
";

/// Writes the record.
pub fn write(record: &SceneRecord, _: Style, out: &mut dyn Write) -> io::Result<()> {
    let style = format!("{STYLE}{}{OWN_STYLE}", chart::STYLE);
    let answers: Vec<Answer> = record.kernels.iter().map(|part| answer(record, part)).collect();
    let title = answers.first().map_or("no kernel", |answer| answer.title.as_str());
    let page = html! {
        (DOCTYPE)
        html lang="en" {
            (head_of(&format!("epsilons of {title}"), &style_policy(&style), &style))
            body {
                header.top {
                    p.mark { "hairline" span { " epsilon" } }
                    h1 { "Which epsilons for this scene" }
                    p.lede { @for answer in answers.iter().take(1) { (answer.scene) } }
                }
                main {
                    @for (part, answer) in record.kernels.iter().zip(&answers) {
                        (section(record, part, answer))
                    }
                    section {
                        h2 { "How to read" }
                        ul { @for line in legend(record) { li { (line) } } }
                    }
                }
            }
        }
    };
    out.write_all(page.into_string().as_bytes())
}

fn section(record: &SceneRecord, part: &SceneKernelPart, answer: &Answer) -> Markup {
    html! {
        section {
            h2 { (answer.title) }
            @for used in &answer.used {
                p.use {
                    b { (used.lead) } " "
                    @for (i, part) in used.text.split("  and  ").enumerate() {
                        @if 0 < i { " and " }
                        code { (part) }
                    }
                }
                ul { @for note in &used.notes { li { (note) } } }
            }
            div.plots {
                @for panel in panels(record, part, answer) {
                    figure {
                        svg.chart viewBox=(format!("0 0 {WIDTH} {}", panel.height)) role="img" aria-label=(panel.about) {
                            (PreEscaped(panel.drawing))
                        }
                    }
                }
            }
            div.scroll tabindex="0" role="group" aria-label="Wrong on fresh rays" {
                table {
                    caption { "Wrong on fresh rays (seed " (record.fresh_seed) ")" }
                    thead { tr { th scope="col" { "rays" } @for name in &answer.columns { th scope="col" { (name) } } } }
                    tbody {
                        @for (label, cells) in &answer.rows {
                            tr { th scope="row" { (label) } @for cell in cells { td { (cell) } } }
                        }
                    }
                }
            }
            @if !answer.limits.is_empty() {
                div.scroll tabindex="0" role="group" aria-label="Limits" {
                    table {
                        caption { "Each alone may move to (95 % sure, so 1 in 20 fails)" }
                        thead {
                            tr { th scope="col" { "number" } th { "limit" } th.text { "rays" } th { "at most" } th { "fresh rays" } }
                        }
                        tbody {
                            @for row in &answer.limits {
                                tr {
                                    th scope="row" { (row.knob) }
                                    td { (row.bound) @if row.is_of_scene { " *" } }
                                    td.text { (row.what) } td { (row.most) } td { (row.fresh) }
                                }
                            }
                        }
                    }
                }
            }
            @for conflict in &answer.conflicts { p { (conflict.join(" ")) } }
            @for price in &answer.prices { p { (price) } }
            @if !answer.next.1.is_empty() { p { (answer.next.0) ":" } }
            @for command in &answer.next.1 { pre { (command) } }
            @for line in footer(record, part) { p.note { (line) } }
        }
    }
}
