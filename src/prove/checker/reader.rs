//! The lines of a certificate, one after the other.

use super::number::{Number, number, show};
use std::fmt::{self, Display};

/// What is read, or why it is refused.
pub type Outcome<T> = Result<T, Refusal>;

/// Why a certificate is refused: the first line that is wrong, and what was expected there.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Refusal {
    /// Counted from 1.
    pub line: usize,
    /// One sentence.
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

/// The lines, and how many are read.
pub struct Reader<'a> {
    pub lines: Vec<&'a str>,
    pub at: usize,
}

impl<'a> Reader<'a> {
    /// The next line, if it has the form: its first word, and what `parse` makes of the others.
    pub fn read<T>(
        &mut self,
        form: &str,
        parse: impl FnOnce(&[&'a str]) -> Option<T>,
    ) -> Outcome<T> {
        let words: Vec<&str> =
            self.lines.get(self.at).map_or(vec![], |line| line.split(' ').collect());
        let is_known = words.first().copied() == form.split(' ').next();
        match is_known.then(|| parse(&words[1..])).flatten() {
            Some(parsed) => {
                self.at += 1;
                Ok(parsed)
            }
            None => self.unexpected(&format!("`{form}`")),
        }
    }

    pub fn unexpected<T>(&self, expected: &str) -> Outcome<T> {
        let found = self.lines.get(self.at).map_or("the end of the file".to_owned(), |line| {
            format!("`{}`", line.chars().take(80).collect::<String>())
        });
        refuse(self.at + 1, format!("found {found}, expected {expected}"))
    }

    pub fn is_next(&self, word: &str) -> bool {
        self.lines.get(self.at).is_some_and(|line| line.split(' ').next() == Some(word))
    }

    /// The next line is this number.
    pub fn demand(&mut self, name: &str, right: &Number) -> Outcome<()> {
        let form = format!("{name} {}", show(right));
        self.read(&form, |words| (words.len() == 1 && number(words[0])? == *right).then_some(()))
    }
}
