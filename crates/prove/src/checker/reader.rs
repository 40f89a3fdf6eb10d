//! The lines of a certificate, one after the other.

use super::number::{Number, number, show};
use std::iter::Peekable;
use std::str::Lines;

/// The value that was read, or one sentence on what was found at the last line that was read, and what was expected.
pub type Outcome<T> = Result<T, String>;

/// The lines that are left, the number of the last one that was read, and the work that those above took.
pub struct Reader<'a> {
    pub lines: Peekable<Lines<'a>>,
    pub line: usize,
    pub work: u64,
}

impl<'a> Reader<'a> {
    /// Reads a line of this form: its first word, and what `parse` makes of the others.
    pub fn read<T>(
        &mut self,
        form: &str,
        parse: impl FnOnce(&[&'a str]) -> Option<T>,
    ) -> Outcome<T> {
        let line = self.lines.next();
        self.line += 1;
        let words = line.unwrap_or_default().split(' ').collect::<Vec<_>>();
        let parse = || (form.split(' ').next() == Some(words[0])).then(|| parse(&words[1..]))?;
        parse().ok_or_else(|| {
            let found = line.map(|line| format!("`{}`", line.chars().take(80).collect::<String>()));
            let found = found.unwrap_or("the end of the file".to_owned());
            format!("found {found}, expected `{form}`")
        })
    }

    /// True if the next line begins with this word.
    pub fn is_next(&mut self, word: &str) -> bool {
        self.lines
            .peek()
            .is_some_and(|line| line.split(' ').next() == Some(word))
    }

    /// Reads a line that states this number.
    pub fn demand(&mut self, name: &str, right: &Number) -> Outcome<()> {
        self.read(&format!("{name} {}", show(right)), |words| {
            (words.len() == 1 && number(words[0])? == *right).then_some(())
        })
    }
}

/// An error if it does not hold.
pub fn ensure(holds: bool, message: impl Into<String>) -> Outcome<()> {
    if holds { Ok(()) } else { Err(message.into()) }
}
