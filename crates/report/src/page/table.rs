//! Tables: a label on the left, cells on the right.

use super::text::{indented, wrapped};
use crate::format::Style;
use hairline_record::{Rate, group_digits, number_of};
use std::io::{self, Write};

/// A label that is longer stands on a line of its own.
const LONGEST_LABEL: usize = 36;

/// The most lines of a head.
const MOST_LINES: usize = 4;

/// The space before a cell.
const GAP: usize = 2;

/// The content of one column of a row: a value, and the text that tells it.
#[derive(Clone, Debug, Default)]
pub struct Cell {
    /// The text.
    pub text: String,
    /// The value, by which a table is sorted where it can be.
    pub value: CellValue,
    /// True if it breaks a promise: red on a terminal with colours.
    pub is_broken: bool,
}

/// The value that a cell's text tells.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum CellValue {
    /// None: the text is all.
    #[default]
    Words,
    /// A number.
    Number(f64),
    /// A share of wrong answers, by which a table is shaded too.
    Share(f64),
}

impl Cell {
    /// Words, which have no order.
    pub fn words(text: impl Into<String>) -> Cell {
        Cell {
            text: text.into(),
            ..Cell::default()
        }
    }

    /// Where there is nothing to tell.
    pub fn none() -> Cell {
        Cell::words("-")
    }

    /// A number, as a text tells it.
    pub fn number(number: f64, text: impl Into<String>) -> Cell {
        Cell {
            value: CellValue::Number(number),
            ..Cell::words(text)
        }
    }

    /// A number as `text` tells it, if there is one.
    pub fn optional(number: Option<f64>, text: impl FnOnce(f64) -> String) -> Cell {
        number.map_or(Cell::none(), |number| Cell::number(number, text(number)))
    }

    /// A count.
    pub fn count(count: u64) -> Cell {
        Cell::number(count as f64, group_digits(count))
    }

    /// A share of wrong answers, as a text tells it.
    pub fn share(share: f64, text: impl Into<String>) -> Cell {
        Cell {
            value: CellValue::Share(share),
            ..Cell::words(text)
        }
    }

    /// A rate of wrong answers, as a text tells it; nothing to sort by if nothing was counted.
    pub fn rate(rate: &Rate, text: impl Into<String>) -> Cell {
        match rate.rate {
            Some(share) => Cell::share(share, text),
            None => Cell::words(text),
        }
    }

    /// This cell, in red if it breaks a promise.
    pub fn broken_if(self, is_broken: bool) -> Cell {
        Cell { is_broken, ..self }
    }
}

/// A column; the first is that of the labels.
#[derive(Clone, Debug, Default)]
pub struct Head {
    /// Its head.
    pub head: String,
    /// True if it holds words, which begin on the left.
    pub is_text: bool,
    /// True if a narrow terminal does without it.
    pub is_optional: bool,
    /// Its meaning, told below the table where the column is shown; may be empty.
    pub about: String,
}

impl Head {
    /// A column of numbers, or of labels.
    pub fn of(head: impl Into<String>) -> Head {
        Head {
            head: head.into(),
            ..Head::default()
        }
    }

    /// A column of words.
    pub fn text(head: impl Into<String>) -> Head {
        Head {
            is_text: true,
            ..Head::of(head)
        }
    }

    /// The same, explained below the table.
    pub fn about(self, about: impl Into<String>) -> Head {
        Head {
            about: about.into(),
            ..self
        }
    }

    /// The same, which a narrow terminal does without.
    pub fn optional(self) -> Head {
        Head {
            is_optional: true,
            ..self
        }
    }
}

/// A row, and lines below it.
#[derive(Clone, Debug, Default)]
pub struct Row {
    /// The label.
    pub label: String,
    /// One cell for each column but the first.
    pub cells: Vec<Cell>,
    /// Lines that belong to it, indented below.
    pub below: Vec<String>,
    /// The title of the folded part that has all about it, if that is not the label.
    pub about: Option<String>,
}

impl Row {
    /// A row without lines below it.
    pub fn new(label: impl Into<String>, cells: impl IntoIterator<Item = Cell>) -> Row {
        Row {
            label: label.into(),
            cells: cells.into_iter().collect(),
            ..Row::default()
        }
    }
}

/// A table.
#[derive(Clone, Debug, Default)]
pub struct Table {
    /// The columns, that of the labels first.
    pub heads: Vec<Head>,
    /// The rows.
    pub rows: Vec<Row>,
    /// So many stand on a screen, where not everything is told; all if 0.
    pub most: usize,
}

impl Table {
    /// A table of which all stands on a screen.
    pub fn new(heads: Vec<Head>, rows: Vec<Row>) -> Table {
        Table {
            heads,
            rows,
            most: 0,
        }
    }

    /// The same, of which only so many rows stand there.
    pub fn at_most(self, most: usize) -> Table {
        Table { most, ..self }
    }

    /// The meanings of the columns, of those that are shown.
    pub fn legend<'a>(shown: impl Iterator<Item = &'a Head>) -> String {
        let told = shown.filter(|head| !head.about.is_empty());
        let told = told.map(|head| format!("{}: {}", head.head.trim(), head.about));
        told.collect::<Vec<_>>().join("; ")
    }

    /// Writes the heads, in several lines if the table is too wide otherwise, then the rows; without the last of the
    /// columns that may go if it is still too wide.
    pub fn write(&self, style: Style, out: &mut dyn Write) -> io::Result<()> {
        let first = self.label_width();
        let fits =
            |widths: &mut dyn Iterator<Item = usize>| first + widths.sum::<usize>() <= style.width;
        // As few lines of heads as leave room for every column.
        let (widths, heads) = (1..=MOST_LINES)
            .map(|lines| self.narrowed(lines))
            .find(|(widths, _)| fits(&mut widths.iter().copied()))
            .unwrap_or_else(|| self.narrowed(MOST_LINES));
        let mut shown: Vec<usize> = (0..widths.len()).collect();
        let mut hidden = Vec::new();
        while !fits(&mut shown.iter().map(|i| widths[*i]))
            && let Some(last) = shown.iter().rposition(|i| self.heads[i + 1].is_optional)
        {
            hidden.insert(0, self.heads[shown.remove(last) + 1].head.trim());
        }
        let padded = |column: usize, text: &str| {
            let width = widths[column];
            match self.heads[column + 1].is_text {
                true => format!("  {text:<0$}", width - GAP),
                false => format!("{text:>width$}"),
            }
        };
        let mut after = Vec::new();
        let (bold, plain) = if style.color {
            ("\x1b[1m", "\x1b[0m")
        } else {
            ("", "")
        };
        let lines = shown
            .iter()
            .map(|i| heads[*i].len())
            .chain([1])
            .max()
            .unwrap_or(1);
        for line in 0..lines {
            // The last lines of all heads stand beside each other.
            let of = |head: &[String]| {
                (line + head.len())
                    .checked_sub(lines)
                    .map_or(String::new(), |i| head[i].clone())
            };
            let mut text = format!("{:<first$}", of(&[self.heads[0].head.clone()]));
            shown
                .iter()
                .for_each(|i| text += &padded(*i, &of(&heads[*i])));
            writeln!(out, "{bold}{}{plain}", text.trim_end())?;
        }
        if !hidden.is_empty() {
            after.push(format!("no room here for: {}", hidden.join("; ")));
        }
        let most = if style.details || self.most == 0 {
            usize::MAX
        } else {
            self.most
        };
        if most < self.rows.len() {
            let more = number_of((self.rows.len() - most) as u64, "more row", "more rows");
            after.push(format!("{more}: --details"));
        }
        for row in self.rows.iter().take(most) {
            let mut line = format!("{:<first$}", row.label);
            if first < row.label.chars().count() {
                writeln!(out, "{}", row.label)?;
                line = " ".repeat(first);
            }
            for &i in &shown {
                let cell = &row.cells[i];
                let text = padded(i, &cell.text);
                match style.color && cell.is_broken {
                    true => line += &format!("\x1b[31m{text}\x1b[0m"),
                    false => line += &text,
                }
            }
            writeln!(out, "{}", line.trim_end())?;
            for below in &row.below {
                indented(below, ["  ", "    "], style.width, out)?;
            }
        }
        indented(&after.join("; "), ["", ""], style.width, out)?;
        let legend = Table::legend(shown.iter().map(|i| &self.heads[i + 1]));
        indented(&legend, ["", ""], style.width, out)
    }

    fn label_width(&self) -> usize {
        let labels = self.rows.iter().map(|row| row.label.chars().count());
        let longest = labels
            .filter(|width| *width <= LONGEST_LABEL)
            .max()
            .unwrap_or(0);
        longest.max(self.heads[0].head.chars().count())
    }

    fn cells_width(&self, column: usize) -> usize {
        self.rows
            .iter()
            .map(|row| row.cells[column].text.chars().count())
            .max()
            .unwrap_or(0)
    }

    /// By column but the first: the width that it needs if its head takes at most so many lines, and these.
    fn narrowed(&self, lines: usize) -> (Vec<usize>, Vec<Vec<String>>) {
        let column = |(i, head): (usize, &Head)| {
            let word = head
                .head
                .split_whitespace()
                .map(|word| word.chars().count())
                .max();
            let least = self.cells_width(i).max(word.unwrap_or(0));
            let wide = |width: usize| (width, wrapped(&head.head, width));
            let fits = |(_, head): &(usize, Vec<String>)| head.len() <= lines;
            let (width, head) = (least..).map(wide).find(fits).expect("a wide one fits");
            (width + GAP, head)
        };
        self.heads[1..].iter().enumerate().map(column).unzip()
    }
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
        let row = |label: &str, cells: [&str; 2]| Row::new(label, cells.map(Cell::words));
        let mut table = Table {
            heads: ["kernel", "leaks", "ns"].map(Head::of).into(),
            rows: vec![row("a", ["0", "1234"]), row(&"b".repeat(40), ["12.5", "7"])],
            most: 0,
        };
        table.rows[0].below.push("as often: c".to_owned());
        table.rows[1].cells[0].is_broken = true;
        let long = "b".repeat(40);
        let expected = format!(
            "kernel  leaks    ns\na           0  1234\n  as often: c\n{long}\n         12.5     7\n"
        );
        assert_eq!(text(&table, Style::default()), expected);
        let style = Style {
            color: true,
            ..Style::default()
        };
        assert!(text(&table, style).contains("\x1b[31m   12.5\x1b[0m     7"));
        let fewer = text(&table.at_most(1), Style::default());
        let expected =
            "kernel  leaks    ns\na           0  1234\n  as often: c\n1 more row: --details\n";
        assert_eq!(fewer, expected);
    }

    #[test]
    fn heads_are_broken_and_columns_dropped_where_there_is_no_room() {
        let heads = vec![
            Head::of("knob"),
            Head::text("rays"),
            Head::of("at most so many"),
            Head::of("seen").optional().about("the worst met"),
        ];
        let table = Table::new(
            heads,
            vec![Row::new("t", ["far", "1 in 10", "12"].map(Cell::words))],
        );
        let at = |width: usize| {
            text(
                &table,
                Style {
                    width,
                    ..Style::default()
                },
            )
        };
        assert_eq!(
            at(40),
            "knob  rays  at most so many  seen\nt     far           1 in 10    12\nseen: the worst met\n"
        );
        assert_eq!(
            at(30),
            "            at most\nknob  rays  so many  seen\nt     far   1 in 10    12\nseen: the worst met\n"
        );
        assert_eq!(
            at(20),
            "            at most\nknob  rays  so many\nt     far   1 in 10\nno room here for:\nseen\n"
        );
    }
}
