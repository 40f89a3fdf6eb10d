//! A page on a terminal: no line is longer than the terminal is wide, but for what is to be pasted.

use super::{Block, Command, Items, Page, Use};
use crate::format::Style;
use hairline_record::group_digits;
use std::io::{self, Write};

/// Writes a page; what only those read who want everything if the style says so.
pub(super) fn write(page: &Page, style: Style, out: &mut dyn Write) -> io::Result<()> {
    if !page.title.is_empty() {
        write_wrapped(&page.title, style.width, out)?;
    }
    let mut writer = TextWriter {
        style,
        is_first: page.title.is_empty(),
        out,
    };
    writer.blocks(&page.blocks)?;
    let has_more = page
        .blocks
        .iter()
        .any(|block| matches!(block, Block::Details(..)));
    if style.details || !has_more {
        return Ok(());
    }
    let last = page
        .blocks
        .iter()
        .rev()
        .find(|block| !matches!(block, Block::Details(..)));
    let lead = match last {
        Some(Block::Commands(lead, commands)) if !commands.is_empty() => " ".repeat(lead.len() + 1),
        _ => "\nnext:".to_owned(),
    };
    writeln!(
        out,
        "{lead} the same with --details, or --format html -o {}.html",
        page.command
    )
}

struct TextWriter<'a> {
    style: Style,
    /// True if nothing stands above.
    is_first: bool,
    out: &'a mut dyn Write,
}

impl TextWriter<'_> {
    fn blocks(&mut self, blocks: &[Block]) -> io::Result<()> {
        let mut after_heading = false;
        for block in blocks {
            let stands_apart = matches!(
                block,
                Block::Heading(_)
                    | Block::Table(_)
                    | Block::Commands(..)
                    | Block::Terms(_)
                    | Block::Listing(_)
            );
            if stands_apart && !after_heading && !self.is_first {
                writeln!(self.out)?;
            }
            after_heading = matches!(block, Block::Heading(_));
            self.block(block)?;
            self.is_first &= matches!(
                block,
                Block::Picture(_) | Block::Stage(_) | Block::Details(..)
            );
        }
        Ok(())
    }

    fn block(&mut self, block: &Block) -> io::Result<()> {
        let width = self.style.width;
        let out = &mut *self.out;
        let (bold, plain) = if self.style.color {
            ("\x1b[1m", "\x1b[0m")
        } else {
            ("", "")
        };
        match block {
            Block::Heading(text) => {
                write!(out, "{bold}")?;
                write_wrapped(text, width, out)?;
                write!(out, "{plain}")
            }
            Block::Text(text) => write_wrapped(text, width, out),
            Block::Notes(notes) => notes
                .iter()
                .try_for_each(|note| indented(note, ["  ", "    "], width, out)),
            Block::Use(Use { lead, parts, notes }) => {
                let text = parts.join("  and  ");
                writeln!(out, "  {bold}{lead:<3}{plain}  {text}")?;
                let indent = "       ";
                notes
                    .iter()
                    .try_for_each(|note| indented(note, [indent, "         "], width, out))
            }
            Block::Table(table) => table.write(self.style, out),
            Block::Commands(lead, commands) => {
                for (i, Command { line, what }) in commands.iter().enumerate() {
                    let space = " ".repeat(lead.len() + 1);
                    let lead = if i == 0 {
                        format!("{bold}{lead}:{plain}")
                    } else {
                        space.clone()
                    };
                    let is_short = space.len() + line.chars().count() + what.len() + 5 <= width;
                    match is_short && !what.is_empty() {
                        true => writeln!(out, "{lead} {line}  # {what}")?,
                        false => writeln!(out, "{lead} {line}")?,
                    }
                }
                Ok(())
            }
            Block::Terms(terms) => {
                let longest = terms
                    .iter()
                    .map(|(term, _)| term.chars().count())
                    .max()
                    .unwrap_or(0);
                let after = " ".repeat(longest + 2);
                terms.iter().try_for_each(|(term, meaning)| {
                    indented(
                        meaning,
                        [&format!("{term:<longest$}  "), &after],
                        width,
                        out,
                    )
                })
            }
            Block::Listing(text) => writeln!(out, "{}", text.trim_end()),
            Block::Items(Items { items, most }) => {
                let most = if self.style.details {
                    items.len()
                } else {
                    items.len().min(*most)
                };
                for item in &items[..most] {
                    write_wrapped(&item.text, width, out)?;
                    for note in item.notes.iter().chain(&item.url) {
                        indented(note, ["    ", "      "], width, out)?;
                    }
                    let more = item.more.iter().filter(|_| self.style.details);
                    let mut lines = item.lines.iter().chain(more);
                    lines.try_for_each(|line| writeln!(out, "    {line}"))?;
                }
                match (items.len() - most) as u64 {
                    0 => Ok(()),
                    more => writeln!(out, "and {} more (--details lists all)", group_digits(more)),
                }
            }
            Block::Picture(_) | Block::Stage(_) => Ok(()),
            Block::Details(title, blocks) if self.style.details => {
                self.blocks(&[Block::Heading(title.clone())])?;
                self.blocks(blocks)
            }
            Block::Details(..) => Ok(()),
        }
    }
}

/// Writes words in lines of at most this width.
pub fn write_wrapped(text: &str, width: usize, out: &mut dyn Write) -> io::Result<()> {
    indented(text, ["", ""], width, out)
}

/// The same after some space, and after other space in the lines below the first.
pub(super) fn indented(
    text: &str,
    [first, rest]: [&str; 2],
    width: usize,
    out: &mut dyn Write,
) -> io::Result<()> {
    let lines = wrapped(text, width.saturating_sub(rest.chars().count()));
    lines
        .iter()
        .enumerate()
        .try_for_each(|(i, line)| writeln!(out, "{}{line}", if i == 0 { first } else { rest }))
}

/// Words in lines of at most this width; no word is broken.
pub(super) fn wrapped(text: &str, width: usize) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split_whitespace() {
        match lines.last_mut() {
            Some(line) if line.chars().count() + 1 + word.chars().count() <= width => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.to_owned()),
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::super::{Cell, Head, Row, Table};
    use super::*;

    fn text(page: &Page, style: Style) -> String {
        let mut out = Vec::new();
        write(page, style, &mut out).unwrap();
        String::from_utf8(out).unwrap()
    }

    #[test]
    fn words_are_wrapped_and_never_broken() {
        let mut out = Vec::new();
        write_wrapped("one two  three fourteen", 8, &mut out).unwrap();
        write_wrapped("  ", 8, &mut out).unwrap();
        assert_eq!(
            String::from_utf8(out).unwrap(),
            "one two\nthree\nfourteen\n"
        );
    }

    #[test]
    fn blocks_stand_in_order_and_details_only_on_demand() {
        let rows = vec![Row::new("a", [Cell::count(0)])];
        let table = Table::new(["kernel", "leaks"].map(Head::of).into(), rows);
        let page = Page {
            command: "x",
            title: "a title of several words".to_owned(),
            blocks: vec![
                Block::Use(Use {
                    lead: "use".to_owned(),
                    parts: vec!["--epsilon parallel=1e-12345678".to_owned()],
                    notes: vec!["what it means to you".to_owned()],
                }),
                Block::Table(table),
                Block::Details(
                    "more".to_owned(),
                    vec![Block::Notes(vec!["small print".to_owned()])],
                ),
                Block::Commands(
                    "next",
                    vec![
                        Command {
                            line: "hairline x".to_owned(),
                            what: "y"
                        };
                        2
                    ],
                ),
            ],
            ..Page::default()
        };
        let style = Style {
            width: 24,
            ..Style::default()
        };
        let short = "a title of several words\n  use  --epsilon parallel=1e-12345678\n       what it means\n         to you\n\n\
                     kernel  leaks\na           0\n\nnext: hairline x  # y\n      hairline x  # y\n";
        let more = "      the same with --details, or --format html -o x.html\n";
        assert_eq!(text(&page, style), format!("{short}{more}"));
        let whole = text(
            &page,
            Style {
                details: true,
                ..style
            },
        );
        assert_eq!(
            whole,
            short.replacen("0\n\nnext", "0\n\nmore\n  small print\n\nnext", 1)
        );
    }
}
