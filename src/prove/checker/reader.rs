//! The lines of a certificate, one after the other.

use super::number::{Number, number, show};
use std::fmt::{self, Display};
use std::iter::Peekable;
use std::str::Lines;

/// What is read, or why it is refused.
pub type Outcome<T> = Result<T, Refusal>;

/// Why a certificate is refused.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Refusal {
    /// The line, counted from 1.
    pub line: usize,
    /// What was found there, and what was expected.
    pub message: String,
}

impl Display for Refusal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "line {}: {}", self.line, self.message)
    }
}

pub fn refuse<T>(line: usize, message: impl Into<String>) -> Outcome<T> {
    Err(Refusal { line, message: message.into() })
}

/// The lines that are left, and the number of the last one that was read.
pub struct Reader<'a> {
    pub lines: Peekable<Lines<'a>>,
    pub line: usize,
}

impl<'a> Reader<'a> {
    /// The next line, if it has the form: its first word, and what `parse` makes of the others.
    pub fn read<T>(
        &mut self,
        form: &str,
        parse: impl FnOnce(&[&'a str]) -> Option<T>,
    ) -> Outcome<T> {
        let line = self.lines.peek().copied();
        let words = line.unwrap_or_default().split(' ').collect::<Vec<_>>();
        let parse = || (form.split(' ').next() == Some(words[0])).then(|| parse(&words[1..]))?;
        let Some(parsed) = parse() else {
            return self.unexpected(&format!("`{form}`"));
        };
        self.lines.next();
        self.line += 1;
        Ok(parsed)
    }

    /// Refuses the next line.
    pub fn unexpected<T>(&mut self, expected: &str) -> Outcome<T> {
        let found = self.lines.peek().map_or("the end of the file".to_owned(), |line| {
            format!("`{}`", line.chars().take(80).collect::<String>())
        });
        refuse(self.line + 1, format!("found {found}, expected {expected}"))
    }

    /// Whether the next line begins with this word.
    pub fn is_next(&mut self, word: &str) -> bool {
        self.lines.peek().is_some_and(|line| line.split(' ').next() == Some(word))
    }

    /// The next line states this number.
    pub fn demand(&mut self, name: &str, right: &Number) -> Outcome<()> {
        self.read(&format!("{name} {}", show(right)), |words| {
            (words.len() == 1 && number(words[0])? == *right).then_some(())
        })
    }
}
