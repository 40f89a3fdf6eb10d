//! Lines of a text, with their numbers, and the coordinates in them.

use super::InputError;
use crate::json::quoted;
use std::io::{BufRead, Read};

/// A coordinate of a vertex, finite in `f64`, and the nearest `f32`.
pub(super) fn coordinate(word: &str) -> Result<(f64, f32), String> {
    let number = |_| format!("vertex has {}, which is not a number", quoted(word));
    let value: f64 = word.parse().map_err(number)?;
    if !value.is_finite() {
        let overflow = word.bytes().any(|byte| byte.is_ascii_digit());
        let what = if overflow {
            "overflows f64"
        } else {
            "is not finite"
        };
        return Err(format!("vertex has {}, which {what}", quoted(word)));
    }
    // From the text: a cast of the f64 would round twice.
    Ok((value, word.parse().map_err(number)?))
}

/// Goes through a text statement by statement: a line, or lines joined by backslashes at their
/// ends, without comment.
pub(super) struct Statements<'a, R> {
    reader: R,
    name: &'a str,
    limit: usize,
    /// Lines read so far.
    number: usize,
    raw: Vec<u8>,
    pub statement: String,
}

impl<'a, R: BufRead> Statements<'a, R> {
    pub fn new(reader: R, name: &'a str, limit: usize) -> Self {
        Statements {
            reader,
            name,
            limit,
            number: 0,
            raw: Vec::new(),
            statement: String::new(),
        }
    }

    /// Reads the next statement, perhaps an empty one, and gives the number of its first line.
    pub fn next_statement(&mut self) -> Result<Option<usize>, InputError> {
        self.statement.clear();
        let first = self.number + 1;
        while self.read_line(first)? {
            let text = checked_line(&self.raw, self.number)
                .map_err(|message| InputError::at(self.name, self.number, message))?;
            let text = without_comment(&text).trim_end();
            let joined = text.strip_suffix('\\');
            self.statement.push_str(joined.unwrap_or(text));
            if joined.is_none() {
                return Ok(Some(first));
            }
            self.statement.push(' ');
        }
        // The end of the file ends a line, and a backslash before it joins nothing.
        Ok((self.number >= first).then_some(first))
    }

    /// Reads one line into `raw`, no further than the limit; false at the end of the file.
    fn read_line(&mut self, first: usize) -> Result<bool, InputError> {
        self.raw.clear();
        let room = (self.limit + 1).saturating_sub(self.statement.len());
        let read = (&mut self.reader)
            .take(room as u64)
            .read_until(b'\n', &mut self.raw)
            .map_err(|error| InputError::reading(self.name, Some(self.number + 1), &error))?;
        if read == 0 {
            return Ok(false);
        }
        self.number += 1;
        if read >= room {
            let message = format!("a line of more than {} bytes", self.limit);
            return Err(InputError::at(self.name, first, message));
        }
        if self.number > u32::MAX as usize {
            return Err(InputError::at(
                self.name,
                self.number,
                "more lines than 32 bits count",
            ));
        }
        Ok(true)
    }
}

/// A line as text, without its end and without the byte order mark of a file's first line. Bytes that are no UTF-8 stand in names
/// and comments of other encodings: they do not matter, and in a number they are no digits.
fn checked_line(raw: &[u8], number: usize) -> Result<String, &'static str> {
    let text = raw
        .strip_prefix("\u{feff}".as_bytes())
        .filter(|_| number == 1)
        .unwrap_or(raw);
    let text = String::from_utf8_lossy(text);
    let text = text.trim_end_matches(['\n', '\r']);
    if text.contains('\0') {
        return Err("a zero byte: not a text file");
    }
    if text.contains('\r') {
        return Err("a carriage return within a line: lines end in LF or CR LF");
    }
    Ok(text.to_owned())
}

/// Up to a `#` that starts the line or follows a blank: `1.#INF` is not a one.
fn without_comment(text: &str) -> &str {
    let starts = |at: usize| at == 0 || text.as_bytes()[at - 1].is_ascii_whitespace();
    text.match_indices('#')
        .find(|(at, _)| starts(*at))
        .map_or(text, |(at, _)| &text[..at])
}
