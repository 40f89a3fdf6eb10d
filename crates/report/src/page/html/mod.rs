//! A page as one HTML file that needs nothing else: light and dark, wide and narrow, on paper, by keyboard, without
//! scripts (which sort tables, no more) and without a network.
//!
//! Whatever a page says is escaped by the templates; the file's own policy lets only its own style and script run.

pub(crate) mod words;

use super::{
    Block, Cell, CellValue, Drawing, Head, Item, Items, Page, Paged, Picture, Row, Table, Tone, Use,
};
use crate::chart;
use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use hairline_record::group_digits;
use hmac_sha256::Hash;
use maud::{DOCTYPE, Markup, PreEscaped, html};
use std::collections::{BTreeMap, BTreeSet};
use std::io::{self, Write};
use words::{code, link, shortened};

/// A file has fewer bytes.
const LIMIT: usize = 1_950_000;

/// The most characters of a title, and of a sentence.
const LONGEST: usize = 2_000;

const STYLE: &str = include_str!("style.css");
/// Makes tables sortable, and opens what a link leads to.
const SCRIPT: &str = include_str!("script.js");

/// Writes a page; what only some read is folded.
pub(super) fn write(page: &Page, out: &mut dyn Write) -> io::Result<()> {
    out.write_all(within(page, LIMIT).as_bytes())
}

/// The content below the title, as elements to be put into a page with the style of this folder.
pub fn elements(record: &impl Paged) -> String {
    of_blocks(&record.page().blocks, LIMIT)
}

/// Blocks, as many as a number of bytes has room for.
fn of_blocks(blocks: &[Block], left: usize) -> String {
    let mut anchors = BTreeSet::new();
    add_anchors(blocks, &mut anchors);
    HtmlWriter {
        anchors: &anchors,
        used: BTreeMap::new(),
        left,
    }
    .blocks(blocks, 0)
}

/// The page in fewer bytes than a limit.
fn within(page: &Page, mut limit: usize) -> String {
    let stages = page.blocks.iter().filter_map(|block| match block {
        Block::Stage(stage) => Some(stage),
        _ => None,
    });
    let mut style = format!("{STYLE}{}", chart::STYLE);
    let mut script = SCRIPT.to_owned();
    let mut around = 4 * LONGEST + 4_000;
    for stage in stages {
        style += stage.style;
        script += stage.script;
        // It has a limit of its own.
        limit += stage.markup.len();
    }
    around += style.len() + script.len();
    let (class, mark) = match page.tone {
        Tone::Plain => ("plain", ""),
        Tone::Good => ("good", "✓ "),
        Tone::Bad => ("bad", "✕ "),
        Tone::Stale => ("stale", "△ "),
    };
    let title = shortened(&page.title, LONGEST);
    let blocks = of_blocks(&page.blocks, limit.saturating_sub(around));
    let page = html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                meta name="color-scheme" content="light dark";
                meta http-equiv="Content-Security-Policy" content=(policy(&style, &script));
                title { "hairline: " (title) }
                style { (PreEscaped(style)) }
            }
            body {
                a.skip href="#main" { "Skip to the report" }
                header class={ "top " (class) } {
                    p.mark { "hairline" span { " " (page.command) } }
                    h1 { (mark) (title) }
                }
                main #main { section { (PreEscaped(blocks)) } }
                script { (PreEscaped(script)) }
            }
        }
    };
    page.into_string()
}

/// Nothing from elsewhere, no script and no style but the page's own, pictures from the page itself.
fn policy(style: &str, script: &str) -> String {
    let digest = |text: &str| BASE64_STANDARD.encode(Hash::hash(text.as_bytes()));
    format!(
        "default-src 'none'; img-src data:; style-src 'sha256-{}'; script-src 'sha256-{}'; base-uri 'none'; form-action 'none'",
        digest(style),
        digest(script)
    )
}

/// From 0 for nothing to 5.
fn shade(share: f64) -> usize {
    const SHADES: [f64; 4] = [0.001, 0.01, 0.1, 0.5];
    if share == 0.0 {
        0
    } else {
        1 + SHADES.iter().filter(|start| **start <= share).count()
    }
}

/// The fragments that lead to parts which are folded.
fn add_anchors(blocks: &[Block], anchors: &mut BTreeSet<String>) {
    for block in blocks {
        if let Block::Details(title, blocks) = block {
            anchors.insert(anchor(title));
            add_anchors(blocks, anchors);
        }
    }
}

/// The fragment of a title.
fn anchor(title: &str) -> String {
    title
        .chars()
        .take(80)
        .map(|c| if c.is_ascii_alphanumeric() { c } else { '-' })
        .collect()
}

/// Before the head of a table.
const TABLE: &str = "<div class=\"scroll\" tabindex=\"0\" role=\"group\" aria-label=\"A table\"><table class=\"heat\">";

struct HtmlWriter<'a> {
    anchors: &'a BTreeSet<String>,
    /// How many parts have begun at each anchor.
    used: BTreeMap<String, usize>,
    /// How many bytes more the page may have.
    left: usize,
}

impl HtmlWriter<'_> {
    /// Some blocks, as many as there is room for. Each folded part has its share of the room.
    fn blocks(&mut self, all: &[Block], depth: usize) -> String {
        let mut text = String::new();
        if !self.takes(note(u64::MAX).len()) {
            return text;
        }
        let mut folded = all
            .iter()
            .filter(|block| matches!(block, Block::Details(..)))
            .count();
        let mut left_out = 0;
        for block in all {
            left_out += match block {
                Block::Details(title, inner) => {
                    let for_others = self.left - self.left / folded;
                    folded -= 1;
                    self.left -= for_others;
                    let head = html! { summary { (heading(title, depth)) } }.into_string();
                    let id = self.id(title);
                    let start =
                        format!("<details class=\"kernel\" id=\"{id}\">{head}<div class=\"body\">");
                    let end = "</div></details>";
                    let fits = self.takes(start.len() + end.len());
                    if fits {
                        text += &format!("{start}{}{end}", self.blocks(inner, depth + 1));
                    }
                    self.left += for_others;
                    u64::from(!fits)
                }
                Block::Items(items) => self.items(&mut text, items),
                Block::Table(table) => {
                    let start = format!("{TABLE}{}<tbody>", heads(table).into_string());
                    let legend = Table::legend(table.heads.iter());
                    let legend = html! { @if !legend.is_empty() { p.note { (legend) } } };
                    let end = format!("</tbody></table></div>{}", legend.into_string());
                    let anchors = self.anchors;
                    let rows = table
                        .rows
                        .iter()
                        .map(|one| row(anchors, table, one).into_string());
                    self.add(&mut text, [&start, &end], rows)
                }
                Block::Heading(title) => self.add_one(&mut text, heading(title, depth)),
                block => self.add_one(&mut text, self::block(block)),
            };
        }
        if 0 < left_out {
            text += &note(left_out);
        }
        text
    }

    /// Adds items: those of a screen, and the others folded.
    fn items(&mut self, text: &mut String, Items { items, most }: &Items) -> u64 {
        let (shown, folded) = items.split_at(items.len().min(*most));
        let start = "<ul class=\"cards\">";
        let end = "</ul>";
        let written = |items: &[Item]| -> Vec<String> {
            items.iter().map(|one| item(one).into_string()).collect()
        };
        let mut left_out = self.add(text, [start, end], written(shown).into_iter());
        if !folded.is_empty() {
            let more = group_digits(folded.len() as u64);
            let start =
                format!("<details class=\"more\"><summary>and {more} more</summary>{start}");
            let end = format!("{end}</details>");
            left_out += self.add(text, [&start, &end], written(folded).into_iter());
        }
        left_out
    }

    fn add_one(&mut self, text: &mut String, markup: Markup) -> u64 {
        self.add(text, ["", ""], std::iter::once(markup.into_string()))
    }

    /// Adds a start, as many pieces as there is room for, and an end. Returns how many pieces are left out.
    fn add(
        &mut self,
        text: &mut String,
        [start, end]: [&str; 2],
        pieces: impl ExactSizeIterator<Item = String>,
    ) -> u64 {
        let mut left_out = pieces.len() as u64;
        if self.takes(start.len() + end.len()) {
            *text += start;
            for piece in pieces.take_while(|piece| self.takes(piece.len())) {
                *text += &piece;
                left_out -= 1;
            }
            *text += end;
        }
        left_out
    }

    /// Takes so many bytes of the room, if there are as many.
    fn takes(&mut self, bytes: usize) -> bool {
        let left = self.left.checked_sub(bytes);
        self.left = left.unwrap_or(self.left);
        left.is_some()
    }

    /// The anchor of a title, and a number after it where it is not the first.
    fn id(&mut self, title: &str) -> String {
        let anchor = anchor(title);
        let number = self.used.entry(anchor.clone()).or_insert(0);
        *number += 1;
        if *number == 1 {
            anchor
        } else {
            format!("{anchor}.{number}")
        }
    }
}

fn row(anchors: &BTreeSet<String>, table: &Table, row: &Row) -> Markup {
    let anchor = anchor(row.about.as_ref().unwrap_or(&row.label));
    html! {
        tr {
            th scope="row" {
                @if anchors.contains(&anchor) { a href={ "#" (anchor) } { (row.label) } } @else { (row.label) }
                @for below in &row.below { span.what { (below) } }
            }
            @for (cell, head) in row.cells.iter().zip(&table.heads[1..]) {
                td class=[classes(cell, head)] data-v=[sort_key(cell)] { (cell.text) }
            }
        }
    }
}

fn note(left_out: u64) -> String {
    html! { p.note { (left_out) " left out here; the JSON record has all." } }.into_string()
}

fn heads(table: &Table) -> Markup {
    let [labels, columns @ ..] = &table.heads[..] else {
        return html! {};
    };
    html! {
        thead { tr {
            th scope="col" { (labels.head) }
            @for (place, head) in columns.iter().enumerate() {
                @let is_sortable = table.rows.iter().any(|row| sort_key(&row.cells[place]).is_some());
                th.text[head.is_text] scope="col" data-sort=[is_sortable.then_some("")] { (head.head) }
            }
        } }
    }
}

/// The classes of a cell, by which it is drawn.
fn classes(cell: &Cell, head: &Head) -> Option<String> {
    let mut classes = Vec::new();
    if let CellValue::Share(share) = cell.value {
        classes.push(format!("m{}", shade(share)));
    }
    if head.is_text {
        classes.push("text".to_owned());
    }
    if cell.is_broken {
        classes.push("broken".to_owned());
    }
    (!classes.is_empty()).then(|| classes.join(" "))
}

/// The number by which a cell is sorted.
fn sort_key(cell: &Cell) -> Option<String> {
    match cell.value {
        CellValue::Words => None,
        CellValue::Number(number) | CellValue::Share(number) => Some(format!("{number:.3e}")),
    }
}

/// A heading, the deeper the smaller.
fn heading(title: &str, depth: usize) -> Markup {
    let title = shortened(title, LONGEST);
    match depth {
        0 => html! { h2 { (title) } },
        1 => html! { h3 { (title) } },
        _ => html! { h4 { (title) } },
    }
}

fn block(block: &Block) -> Markup {
    match block {
        Block::Text(text) => html! { @if !text.is_empty() { p { (shortened(text, LONGEST)) } } },
        Block::Notes(notes) => list(notes),
        Block::Use(Use { lead, parts, notes }) => html! {
            p.use {
                b { (lead) } " "
                @for (i, part) in parts.iter().enumerate() { @if 0 < i { " and " } (code(part)) }
            }
            (list(notes))
        },
        Block::Commands(lead, commands) => html! {
            p { (lead) ":" }
            @for command in commands {
                pre { (command.line) @if !command.what.is_empty() { "  # " (command.what) } }
            }
        },
        Block::Terms(terms) => html! {
            dl.guide { @for (term, meaning) in terms { dt { (term) } dd { (shortened(meaning, LONGEST)) } } }
        },
        Block::Listing(text) => html! { pre { (text) } },
        Block::Picture(Picture {
            about,
            caption,
            drawing,
        }) => html! {
            figure {
                @match drawing {
                    Drawing::Chart(elements, [width, height]) => {
                        svg.chart viewBox=(format!("0 0 {width} {height}")) role="img" aria-label=(about) { (PreEscaped(elements)) }
                    },
                    Drawing::Svg(svg) => { div.drawing role="group" aria-label=(about) tabindex="0" { (PreEscaped(svg)) } },
                }
                @if !caption.is_empty() { figcaption { (caption) } }
            }
        },
        Block::Stage(stage) => PreEscaped(stage.markup.clone()),
        Block::Heading(_) | Block::Table(_) | Block::Items(_) | Block::Details(..) => html! {},
    }
}

fn item(
    Item {
        text,
        notes,
        url,
        lines,
        more,
    }: &Item,
) -> Markup {
    html! {
        li {
            p { (shortened(text, LONGEST)) }
            @for note in notes { p.why { (shortened(note, LONGEST)) } }
            @if let Some(url) = url { p.why { (link(url)) } }
            @for line in lines.iter().chain(more) { p.example { (code(line)) } }
        }
    }
}

fn list(lines: &[String]) -> Markup {
    html! { @if !lines.is_empty() { ul { @for line in lines { li { (shortened(line, LONGEST)) } } } } }
}

#[cfg(test)]
pub(crate) mod tests;
