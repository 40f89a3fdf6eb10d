//! A page as Markdown.

use super::{Block, Head, Item, Items, Page, Table, Use};
use crate::format::Style;
use hairline_record::group_digits;
use std::io::{self, Write};

/// A forge's summary holds less than a mebibyte.
pub const LIMIT: usize = (1 << 20) - 1024;

const REST: &str = "\nThe rest is left out here: `--format json` has everything.\n";

/// Writes a page, within what a forge takes; what only some read is folded, and there only where everything is asked
/// for.
pub(super) fn write(page: &Page, style: Style, out: &mut dyn Write) -> io::Result<()> {
    out.write_all(within(page, style, LIMIT).as_bytes())
}

/// The page in at most so many bytes, cut after a line, with a note of it.
pub fn within(page: &Page, style: Style, limit: usize) -> String {
    let mut writer = MarkdownWriter {
        text: String::new(),
        style,
    };
    writer.page(&page.clone().readable());
    let text = writer.text;
    if text.len() <= limit {
        return text;
    }
    let Some(room) = limit.checked_sub(REST.len()) else {
        return String::new();
    };
    let end = text.as_bytes()[..room]
        .iter()
        .rposition(|byte| *byte == b'\n')
        .map_or(0, |i| i + 1);
    format!("{}{REST}", &text[..end])
}

struct MarkdownWriter {
    text: String,
    style: Style,
}

impl MarkdownWriter {
    fn page(&mut self, page: &Page) {
        if !page.title.is_empty() {
            self.text += &format!("## {}\n", words(&page.title));
        }
        self.blocks(&page.blocks);
    }

    fn blocks(&mut self, blocks: &[Block]) {
        blocks.iter().for_each(|block| self.block(block));
    }

    fn block(&mut self, block: &Block) {
        let text = match block {
            Block::Heading(text) => format!("\n### {}\n", words(text)),
            Block::Text(text) if text.is_empty() => String::new(),
            Block::Text(text) => format!("\n{}\n", words(text)),
            Block::Notes(notes) => list(notes),
            Block::Use(Use { lead, parts, notes }) => {
                let parts: Vec<String> = parts.iter().map(|part| code(part)).collect();
                format!(
                    "\n**{}** {}\n{}",
                    words(lead),
                    parts.join(" and "),
                    list(notes)
                )
            }
            Block::Table(all) => table(all),
            Block::Commands(lead, commands) => {
                let lines: Vec<&str> = commands
                    .iter()
                    .map(|command| command.line.as_str())
                    .collect();
                format!("\n{lead}:\n{}", listing(&lines.join("\n")))
            }
            Block::Terms(terms) => {
                let terms = terms.iter().map(|(term, meaning)| match term.is_empty() {
                    true => meaning.clone(),
                    false => format!("{term}: {meaning}"),
                });
                list(&terms.collect::<Vec<_>>())
            }
            Block::Listing(text) => listing(text),
            Block::Items(Items { items, most }) => {
                let item = |item: &Item| {
                    let notes = item.notes.iter().chain(&item.url).map(|note| words(note));
                    let all = notes.chain(item.lines.iter().map(|line| code(line)));
                    let more: String = all.map(|line| format!("<br>{line}")).collect();
                    format!("- {}{more}\n", words(&item.text))
                };
                let (shown, folded) = items.split_at(items.len().min(*most));
                let shown: String = shown.iter().map(item).collect();
                let folded: String = folded.iter().map(item).collect();
                match folded.is_empty() {
                    true => format!("\n{shown}"),
                    false => format!(
                        "\n{shown}\n<details><summary>and {} more</summary>\n\n{folded}\n</details>\n",
                        group_digits((items.len() - most) as u64)
                    ),
                }
            }
            Block::Picture(_) | Block::Stage(_) => String::new(),
            Block::Details(title, all) if self.style.details => {
                self.text += &format!("\n<details><summary>{}</summary>\n", words(title));
                self.blocks(all);
                "\n</details>\n".to_owned()
            }
            Block::Details(..) => String::new(),
        };
        self.text += &text;
    }
}

fn list(lines: &[String]) -> String {
    let lines: String = lines
        .iter()
        .map(|line| format!("- {}\n", words(line)))
        .collect();
    if lines.is_empty() {
        lines
    } else {
        format!("\n{lines}")
    }
}

fn table(table: &Table) -> String {
    let line = |cells: &mut dyn Iterator<Item = String>| {
        format!("| {} |\n", cells.collect::<Vec<_>>().join(" | "))
    };
    let rule = |(i, head): (usize, &Head)| {
        if i == 0 || head.is_text {
            "---"
        } else {
            "---:"
        }
    };
    let rules = table.heads.iter().enumerate().map(rule);
    let mut text = format!(
        "\n{}",
        line(&mut table.heads.iter().map(|head| words(&head.head)))
    );
    text += &line(&mut rules.map(str::to_owned));
    for row in &table.rows {
        let below = row
            .below
            .iter()
            .map(|below| format!("<br>{}", words(below)));
        let first = [words(&row.label) + &below.collect::<String>()];
        let cells = row.cells.iter().map(|cell| words(&cell.text));
        text += &line(&mut first.into_iter().chain(cells));
    }
    match Table::legend(table.heads.iter()) {
        legend if legend.is_empty() => text,
        legend => format!("{text}\n{}\n", words(&legend)),
    }
}

/// Text outside of code: neither a picture nor an element nor a link, whoever wrote it; an address alone is a link on GitHub.
fn words(text: &str) -> String {
    let text = text.replace('\\', "\\\\").replace('[', "\\[");
    let text = text.replace("://", ":\\//").replace("www.", "www\\.");
    cell(&text).replace('<', "&lt;")
}

/// Text inside a table's cell.
fn cell(text: &str) -> String {
    text.replace('|', "\\|").replace('\n', " ")
}

/// Code; a command holds no backtick unless a file's name does.
fn code(text: &str) -> String {
    let fence = "`".repeat(longest_run(text) + 1);
    let space = if text.contains('`') { " " } else { "" };
    format!("{fence}{space}{}{space}{fence}", cell(text))
}

/// Lines of code.
fn listing(text: &str) -> String {
    let fence = "`".repeat(longest_run(text).max(2) + 1);
    format!("\n{fence}\n{}\n{fence}\n", text.trim_end())
}

/// The most backticks that stand one after the other.
fn longest_run(text: &str) -> usize {
    let others = text.split(|c| c != '`');
    others.map(str::len).max().unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::super::{Cell, Head, Row};
    use super::*;

    #[test]
    fn nothing_in_a_text_is_markup() {
        let row = Row {
            below: vec!["as often: b|c".to_owned()],
            ..Row::new("a<b>", ["1 < 2", "x"].map(Cell::words))
        };
        let heads = vec![Head::of("kernel"), Head::of("n"), Head::text("what")];
        let page = Page {
            title: "t".to_owned(),
            blocks: vec![
                Block::Table(Table::new(heads, vec![row])),
                Block::Details("all".to_owned(), vec![Block::text("x")]),
            ],
            ..Page::default()
        };
        let text = within(
            &page,
            Style {
                details: true,
                ..Style::default()
            },
            LIMIT,
        );
        let expected = "## t\n\n| kernel | n | what |\n| --- | ---: | --- |\n| a&lt;b><br>as often: b\\|c | 1 &lt; 2 | x |\n\n\
                        <details><summary>all</summary>\n\nx\n\n</details>\n";
        assert_eq!(text, expected);
        let folded = within(&page, Style::default(), LIMIT);
        assert!(!folded.contains("details"), "{folded}");
    }
}
