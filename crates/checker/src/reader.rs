//! The lines of a certificate, one after the other.

use super::number::{Number, number, show};
use std::iter::Peekable;
use std::str::Lines;

/// The value that was read, or one sentence on what was found at the last line that was read, and what was expected.
pub type Outcome<T> = Result<T, String>;

/// How much of a line a refusal shows.
const MOST_SHOWN: usize = 80;

/// The lines that are left, the number of the last one that was read, and the work that those above took.
pub struct Reader<'a> {
    pub lines: Peekable<Lines<'a>>,
    pub line: usize,
    pub work: u64,
}

impl<'a> Reader<'a> {
    /// Reads a line of this form: its first word, and the value that `parse` makes of the others.
    pub fn read<T>(
        &mut self,
        form: &str,
        parse: impl FnOnce(&[&'a str]) -> Option<T>,
    ) -> Outcome<T> {
        let line = self.lines.next();
        self.line += 1;
        let words: Vec<&str> = line.unwrap_or_default().split(' ').collect();
        let is_named = form.split(' ').next() == Some(words[0]);
        if is_named && let Some(value) = parse(&words[1..]) {
            return Ok(value);
        }
        let found = match line {
            Some(line) => format!("`{line:.MOST_SHOWN$}`"),
            None => "the end of the file".to_owned(),
        };
        Err(format!("found {found}, expected `{form}`"))
    }

    /// Reads a line of one word.
    pub fn read_word(&mut self, word: &str) -> Outcome<()> {
        self.read(word, |words| words.is_empty().then_some(()))
    }

    /// True if the next line begins with this word.
    pub fn is_next(&mut self, word: &str) -> bool {
        let line = self.lines.peek().unwrap_or(&"");
        line.split(' ').next() == Some(word)
    }

    /// Reads a line that states this number.
    pub fn demand(&mut self, name: &str, right: &Number) -> Outcome<()> {
        let form = format!("{name} {}", show(right));
        self.read(&form, |words| {
            let &[word] = words else { return None };
            (number(word)? == *right).then_some(())
        })
    }
}

/// An error if it does not hold.
pub fn ensure(holds: bool, message: impl Into<String>) -> Outcome<()> {
    if holds {
        return Ok(());
    }
    Err(message.into())
}
