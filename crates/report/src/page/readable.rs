//! Names of kernels and meshes, reasons in files of expectations, words of a record: other people wrote them.
//!
//! A page says them and never obeys them. Every format writes what this makes of a page.

use super::{Block, Command, Item, Page, Row, Table};
use crate::audit::is_one_command;
use crate::printable::{is_obeyed, printable, printable_lines};

/// Stands for a line that a shell would take for more than one command.
const NOT_SHOWN: &str = "(no line to paste: a name or a word in it would make a shell do more)";

impl Page {
    /// The same, with texts that a terminal shows and does not obey, and lines to paste that are one command each.
    pub(super) fn readable(mut self) -> Page {
        make_printable(&mut self.title);
        self.blocks.iter_mut().for_each(make_block_readable);
        self
    }
}

fn make_block_readable(block: &mut Block) {
    match block {
        Block::Heading(text) | Block::Text(text) => make_printable(text),
        Block::Notes(notes) => notes.iter_mut().for_each(make_printable),
        Block::Use(paste) => {
            make_printable(&mut paste.lead);
            paste.parts.iter_mut().for_each(make_pasteable);
            paste.notes.iter_mut().for_each(make_printable);
        }
        Block::Table(table) => make_table_readable(table),
        Block::Commands(_, commands) => {
            commands
                .iter_mut()
                .for_each(|Command { line, .. }| make_pasteable(line));
        }
        Block::Terms(terms) => {
            for (term, meaning) in terms {
                make_printable(term);
                make_printable(meaning);
            }
        }
        Block::Listing(text) => *text = printable_lines(text),
        Block::Items(items) => items.items.iter_mut().for_each(make_item_readable),
        Block::Picture(picture) => {
            make_printable(&mut picture.about);
            make_printable(&mut picture.caption);
        }
        // Its elements are ours; the names in them are escaped as markup, not as orders.
        Block::Stage(stage) => stage.markup = printable_lines(&stage.markup),
        Block::Details(title, blocks) => {
            make_printable(title);
            blocks.iter_mut().for_each(make_block_readable);
        }
    }
}

fn make_table_readable(table: &mut Table) {
    for head in &mut table.heads {
        make_printable(&mut head.head);
        make_printable(&mut head.about);
    }
    for Row {
        label,
        cells,
        below,
        about,
    } in &mut table.rows
    {
        make_printable(label);
        cells
            .iter_mut()
            .for_each(|cell| make_printable(&mut cell.text));
        below.iter_mut().chain(about).for_each(make_printable);
    }
}

fn make_item_readable(item: &mut Item) {
    let Item {
        text,
        notes,
        url,
        lines,
        more,
    } = item;
    make_printable(text);
    notes
        .iter_mut()
        .chain(url)
        .chain(more)
        .for_each(make_printable);
    lines.iter_mut().for_each(make_pasteable);
}

/// Sentences may stand in several lines, which a writer breaks anew.
fn make_printable(text: &mut String) {
    if text.chars().any(|c| c != '\n' && c != '\t' && is_obeyed(c)) {
        let words: Vec<String> = text.split(['\n', '\t']).map(printable).collect();
        *text = words.join(" ");
    }
}

/// A command stays if it is one; other lines to paste, as bits, are text.
fn make_pasteable(line: &mut String) {
    match line.starts_with("hairline ") && !is_one_command(line) {
        true => *line = NOT_SHOWN.to_owned(),
        false => make_printable(line),
    }
}
