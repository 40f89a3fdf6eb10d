//! Tables of text on a terminal: a label on the left, cells on the right.

use super::Style;
use std::io::{self, Write};

/// A label that is longer stands on a line of its own.
const LONGEST_LABEL: usize = 36;

/// The space before a cell.
const GAP: usize = 2;

/// The content of one column of a row.
#[derive(Clone, Debug, Default)]
pub(crate) struct Cell {
    /// The text.
    pub text: String,
    /// True if it breaks a promise: red on a terminal with colours.
    pub is_broken: bool,
}

impl From<String> for Cell {
    fn from(text: String) -> Cell {
        Cell { text, is_broken: false }
    }
}

/// A row, and lines below it.
#[derive(Clone, Debug, Default)]
pub(crate) struct Row {
    /// The label.
    pub label: String,
    /// One cell for each head but the first.
    pub cells: Vec<Cell>,
    /// Lines that belong to it, indented below.
    pub below: Vec<String>,
}

/// A table; the first head is that of the labels.
#[derive(Clone, Debug, Default)]
pub(crate) struct Table {
    /// The heads of the labels and of the cells.
    pub heads: Vec<String>,
    /// The rows.
    pub rows: Vec<Row>,
}

impl Table {
    /// Its width in characters.
    pub fn width(&self) -> usize {
        self.label_width() + self.widths().iter().sum::<usize>()
    }

    /// Takes a column of cells out.
    pub fn remove(&mut self, column: usize) {
        self.heads.remove(column + 1);
        self.rows.iter_mut().for_each(|row| drop(row.cells.remove(column)));
    }

    /// Writes the heads, then the rows.
    pub fn write(&self, style: Style, out: &mut dyn Write) -> io::Result<()> {
        let (first, widths) = (self.label_width(), self.widths());
        let (bold, plain) = if style.color { ("\x1b[1m", "\x1b[0m") } else { ("", "") };
        let mut line = format!("{:<first$}", self.heads[0]);
        for (head, width) in self.heads[1..].iter().zip(&widths) {
            line += &format!("{head:>width$}");
        }
        writeln!(out, "{bold}{}{plain}", line.trim_end())?;
        for row in &self.rows {
            let mut line = format!("{:<first$}", row.label);
            if first < row.label.chars().count() {
                writeln!(out, "{}", row.label)?;
                line = " ".repeat(first);
            }
            for (cell, width) in row.cells.iter().zip(&widths) {
                let text = format!("{:>width$}", cell.text);
                match style.color && cell.is_broken {
                    true => line += &format!("\x1b[31m{text}\x1b[0m"),
                    false => line += &text,
                }
            }
            writeln!(out, "{}", line.trim_end())?;
            for below in &row.below {
                writeln!(out, "  {below}")?;
            }
        }
        Ok(())
    }

    fn label_width(&self) -> usize {
        let labels = self.rows.iter().map(|row| row.label.chars().count());
        let longest = labels.filter(|width| *width <= LONGEST_LABEL).max().unwrap_or(0);
        longest.max(self.heads[0].chars().count())
    }

    fn widths(&self) -> Vec<usize> {
        let width = |column: usize| {
            let cells = self.rows.iter().map(|row| row.cells[column].text.chars().count());
            cells.chain([self.heads[column + 1].chars().count()]).max().unwrap_or(0) + GAP
        };
        (0..self.heads.len() - 1).map(width).collect()
    }
}

/// Writes words in lines of at most this width.
pub(crate) fn write_wrapped(text: &str, width: usize, out: &mut dyn Write) -> io::Result<()> {
    let mut line = String::new();
    for word in text.split_whitespace() {
        if width < line.chars().count() + 1 + word.chars().count() && !line.is_empty() {
            writeln!(out, "{line}")?;
            line.clear();
        }
        if !line.is_empty() {
            line.push(' ');
        }
        line.push_str(word);
    }
    if line.is_empty() { Ok(()) } else { writeln!(out, "{line}") }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn text(table: &Table, style: Style) -> String {
        let mut out = Vec::new();
        table.write(style, &mut out).unwrap();
        String::from_utf8(out).unwrap()
    }

    #[test]
    fn columns_are_as_wide_as_what_stands_in_them() {
        let row = |label: &str, cells: [&str; 2]| Row {
            label: label.to_owned(),
            cells: cells.map(|cell| cell.to_owned().into()).into(),
            below: Vec::new(),
        };
        let mut table = Table {
            heads: ["kernel", "leaks", "ns"].map(str::to_owned).into(),
            rows: vec![row("a", ["0", "1234"]), row(&"b".repeat(40), ["12.5", "7"])],
        };
        table.rows[0].below.push("as often: c".to_owned());
        table.rows[1].cells[0].is_broken = true;
        let long = "b".repeat(40);
        let expected = format!(
            "kernel  leaks    ns\na           0  1234\n  as often: c\n{long}\n         12.5     7\n"
        );
        assert_eq!(text(&table, Style::default()), expected);
        assert_eq!(table.width(), 19);
        let style = Style { color: true, ..Style::default() };
        assert!(text(&table, style).contains("\x1b[31m   12.5\x1b[0m     7"));
        table.remove(0);
        assert_eq!(table.width(), 12);
        assert!(text(&table, Style::default()).starts_with("kernel    ns\na       1234\n"));
    }

    #[test]
    fn words_are_wrapped_and_never_broken() {
        let mut out = Vec::new();
        write_wrapped("one two  three fourteen", 8, &mut out).unwrap();
        write_wrapped("  ", 8, &mut out).unwrap();
        assert_eq!(String::from_utf8(out).unwrap(), "one two\nthree\nfourteen\n");
    }
}
