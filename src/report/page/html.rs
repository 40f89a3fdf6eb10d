//! A page as one HTML file.

use super::{Block, Page, Picture, Table, Tone, Use};
use crate::report::chart;
use crate::report::formats::html::{STYLE, head_of, style_policy};
use maud::{DOCTYPE, Markup, PreEscaped, html};
use std::io::{self, Write};

/// The style that the report of an audit does not have.
const OWN_STYLE: &str = "
svg.chart { width: 100%; max-width: 34rem; height: auto; }
.use { font-size: 1.05rem; } .use::first-letter { text-transform: uppercase; } .use code { font-size: .9rem; }
pre { white-space: pre-wrap; overflow-wrap: anywhere; } .scroll { width: fit-content; } td { white-space: nowrap; } th[scope=row] { min-width: 8.5rem; }
summary { cursor: pointer; margin: 1rem 0; } td.wrong { color: var(--bad); } th small { display: block; font-weight: 400; }
";

/// Writes a page; what only some read is folded.
pub(super) fn write(page: &Page, out: &mut dyn Write) -> io::Result<()> {
    let style = format!("{STYLE}{}{OWN_STYLE}", chart::STYLE);
    let class = match page.tone {
        Tone::Plain => "plain",
        Tone::Good => "good",
        Tone::Bad => "bad",
    };
    let page = html! {
        (DOCTYPE)
        html lang="en" {
            (head_of(&page.title, &style_policy(&style), &style))
            body {
                header class={ "top " (class) } {
                    p.mark { "hairline" span { " " (page.command) } }
                    h1 { (page.title) }
                }
                main { section { (blocks(&page.blocks)) } }
            }
        }
    };
    out.write_all(page.into_string().as_bytes())
}

fn blocks(all: &[Block]) -> Markup {
    html! { @for block in all { (self::block(block)) } }
}

fn block(block: &Block) -> Markup {
    match block {
        Block::Heading(text) => html! { h2 { (text) } },
        Block::Text(text) => html! { p { (text) } },
        Block::Notes(notes) => list(notes),
        Block::Use(Use { lead, text, notes }) => html! {
            p.use {
                b { (lead) } " "
                @for (i, part) in text.split("  and  ").enumerate() { @if 0 < i { " and " } code { (part) } }
            }
            (list(notes))
        },
        Block::Table(all) => table(all),
        Block::Commands(lead, commands) => html! {
            p { (lead) ":" }
            @for command in commands {
                pre { (command.line) @if !command.what.is_empty() { "  # " (command.what) } }
            }
        },
        Block::Terms(terms) => html! {
            dl.guide { @for (term, meaning) in terms { dt { (term) } dd { (meaning) } } }
        },
        Block::Listing(text) => html! { pre { (text) } },
        Block::Picture(Picture { about, drawing, size: [width, height] }) => html! {
            figure {
                svg.chart viewBox=(format!("0 0 {width} {height}")) role="img" aria-label=(about) { (PreEscaped(drawing)) }
            }
        },
        Block::Details(title, all) => html! { details { summary { (title) } (blocks(all)) } },
    }
}

fn list(lines: &[String]) -> Markup {
    html! { @if !lines.is_empty() { ul { @for line in lines { li { (line) } } } } }
}

fn table(table: &Table) -> Markup {
    let is_text = |column: usize| table.heads[column + 1].is_text;
    html! {
        div.scroll tabindex="0" role="group" aria-label=(table.heads[0].head) {
            table {
                thead { tr { @for column in &table.heads { th.text[column.is_text] scope="col" { (column.head) } } } }
                tbody {
                    @for row in &table.rows {
                        tr {
                            th scope="row" { (row.label) @for below in &row.below { small { (below) } } }
                            @for (i, cell) in row.cells.iter().enumerate() {
                                td.text[is_text(i)].wrong[cell.is_broken] { (cell.text) }
                            }
                        }
                    }
                }
            }
        }
    }
}
