//! The words and numbers of a line.

use crate::files::{json, number};
use crate::kernel::Scalar;

/// A line without spaces around it, and without the byte order mark that some editors begin a file with.
pub fn without_mark(line: &str) -> &str {
    line.trim_start_matches('\u{feff}').trim()
}

/// True of a line of names: nothing that stands for a number.
pub fn is_head(line: &str) -> bool {
    let is_name = |word: &str| {
        let is_number = number::parse::<f64>(word).is_ok();
        word.starts_with(|c: char| c.is_ascii_alphabetic()) && !is_number
    };
    words(line).first().is_some_and(|first| is_name(first))
}

/// The words between commas, semicolons and spaces; between two commas may be none.
pub fn words(line: &str) -> Vec<&str> {
    match line.contains([',', ';']) {
        true => {
            let parts = line.split([',', ';']);
            parts.flat_map(spaced).collect()
        }
        false => line.split_whitespace().collect(),
    }
}

fn spaced(part: &str) -> Vec<&str> {
    let words: Vec<&str> = part.split_whitespace().collect();
    match words.is_empty() {
        true => vec![""],
        false => words,
    }
}

/// The numbers of a line without a name among them.
pub fn numbers<F: Scalar>(line: &str) -> Result<Vec<F>, String> {
    words(line).into_iter().map(number::parse).collect()
}

/// A JSON number, or a string that is one: JSON has no infinity.
pub fn json_number<F: Scalar>(text: &str) -> Result<F, String> {
    match text.starts_with('"') {
        true => number::parse(&json::string(text)?),
        false => number::parse(text),
    }
}
