//! A page as Markdown.

use super::{Block, Page, Table, Use};
use std::io::{self, Write};

/// Writes a page; what only some read is folded.
pub(super) fn write(page: &Page, out: &mut dyn Write) -> io::Result<()> {
    if !page.title.is_empty() {
        writeln!(out, "## {}", words(&page.title))?;
    }
    blocks(&page.blocks, out)
}

fn blocks(all: &[Block], out: &mut dyn Write) -> io::Result<()> {
    all.iter().try_for_each(|block| self::block(block, out))
}

fn block(block: &Block, out: &mut dyn Write) -> io::Result<()> {
    match block {
        Block::Heading(text) => writeln!(out, "\n### {}", words(text)),
        Block::Text(text) => writeln!(out, "\n{}", words(text)),
        Block::Notes(notes) => list(notes, out),
        Block::Use(Use { lead, text, notes }) => {
            let parts: Vec<String> = text.split("  and  ").map(code).collect();
            writeln!(out, "\n**{}** {}", words(lead), parts.join(" and "))?;
            list(notes, out)
        }
        Block::Table(all) => table(all, out),
        Block::Commands(lead, commands) => {
            let lines: Vec<&str> = commands.iter().map(|command| command.line.as_str()).collect();
            writeln!(out, "\n{lead}:\n\n```\n{}\n```", lines.join("\n"))
        }
        Block::Terms(terms) => {
            let terms = terms.iter().map(|(term, meaning)| format!("{term}: {meaning}"));
            list(&terms.collect::<Vec<_>>(), out)
        }
        Block::Listing(text) => writeln!(out, "\n```\n{}\n```", text.trim_end()),
        Block::Picture(_) => Ok(()),
        Block::Details(title, all) => {
            writeln!(out, "\n<details><summary>{}</summary>", words(title))?;
            blocks(all, out)?;
            writeln!(out, "\n</details>")
        }
    }
}

fn list(lines: &[String], out: &mut dyn Write) -> io::Result<()> {
    if lines.is_empty() {
        return Ok(());
    }
    writeln!(out)?;
    lines.iter().try_for_each(|line| writeln!(out, "- {}", words(line)))
}

fn table(table: &Table, out: &mut dyn Write) -> io::Result<()> {
    let line = |cells: &mut dyn Iterator<Item = String>| {
        format!("| {} |", cells.collect::<Vec<_>>().join(" | "))
    };
    let rules = table
        .heads
        .iter()
        .enumerate()
        .map(|(i, column)| if i == 0 || column.is_text { "---" } else { "---:" });
    writeln!(out, "\n{}", line(&mut table.heads.iter().map(|column| words(&column.head))))?;
    writeln!(out, "{}", line(&mut rules.map(str::to_owned)))?;
    for row in &table.rows {
        let below: String = row.below.iter().map(|below| format!("<br>{}", words(below))).collect();
        let first = [words(&row.label) + &below];
        let cells = row.cells.iter().map(|cell| words(&cell.text));
        writeln!(out, "{}", line(&mut first.into_iter().chain(cells)))?;
    }
    Ok(())
}

/// Text outside of code.
fn words(text: &str) -> String {
    cell(text).replace('<', "&lt;")
}

/// Text inside a table's cell.
pub(crate) fn cell(text: &str) -> String {
    text.replace('|', "\\|").replace('\n', " ")
}

/// Code; a command holds no backtick unless a file's name does.
pub(crate) fn code(text: &str) -> String {
    let fence = if text.contains('`') { "``" } else { "`" };
    format!("{fence}{}{fence}", cell(text))
}

#[cfg(test)]
mod tests {
    use super::super::{Cell, Head, Row};
    use super::*;

    #[test]
    fn nothing_in_a_text_is_markup() {
        let row = Row {
            below: vec!["as often: b|c".to_owned()],
            ..Row::new("a<b>", vec![Cell::from("1 < 2".to_owned()), Cell::from("x".to_owned())])
        };
        let heads = vec![Head::of("kernel"), Head::of("n"), Head::text("what")];
        let page = Page {
            title: "t".to_owned(),
            blocks: vec![
                Block::Table(Table { heads, rows: vec![row] }),
                Block::Details("all".to_owned(), vec![Block::text("x")]),
            ],
            ..Page::default()
        };
        let mut out = Vec::new();
        write(&page, &mut out).unwrap();
        let expected = "## t\n\n| kernel | n | what |\n| --- | ---: | --- |\n| a&lt;b><br>as often: b\\|c | 1 &lt; 2 | x |\n\n\
                        <details><summary>all</summary>\n\nx\n\n</details>\n";
        assert_eq!(String::from_utf8(out).unwrap(), expected);
    }
}
