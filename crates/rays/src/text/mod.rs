//! Rays, points and answers in files of other people, line by line.

mod answers;
mod line;
mod questions;

pub use answers::answers;
pub use questions::{points, ray_of_words, rays};

use crate::files::InputError;
use crate::files::text_lines::TextLines;
use std::io::{BufReader, Read};

/// The most bytes of a line.
const LONGEST_LINE: usize = 1 << 16;

/// The text of somebody else.
pub struct Text<'a> {
    /// Its file's name, for messages.
    pub name: &'a str,
    /// Its bytes. Of one type, so that what reads them is compiled in this crate.
    pub bytes: Box<dyn Read>,
}

impl Text<'_> {
    /// Calls `take` with each line that says something. A first line that is a head, blank lines, and those that begin with # are
    /// skipped. An error that `take` gives is one in that line.
    fn for_each_line(
        self,
        is_head: impl Fn(&str) -> bool,
        mut take: impl FnMut(&str) -> Result<(), String>,
    ) -> Result<(), InputError> {
        let Text { name, bytes } = self;
        for line in TextLines::new(BufReader::new(bytes), name, LONGEST_LINE) {
            let (number, text) = line?;
            let text = line::without_mark(&text);
            if text.starts_with('#') || number == 1 && is_head(text) {
                continue;
            }
            take(text).map_err(|message| InputError::at(name, number, message))?;
        }
        Ok(())
    }

    /// Reads one thing a line.
    fn one_a_line<T>(
        self,
        what: &str,
        is_head: impl Fn(&str) -> bool,
        read: impl Fn(&str) -> Result<T, String>,
    ) -> Result<Vec<T>, InputError> {
        let name = self.name;
        let mut all = Vec::new();
        self.for_each_line(is_head, |line| {
            all.push(read(line)?);
            Ok(())
        })?;
        match all.is_empty() {
            true => Err(InputError::of(name, format!("there are no {what} in it"))),
            false => Ok(all),
        }
    }
}
