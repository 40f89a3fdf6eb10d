//! The lines of a text, none longer than a limit: memory stays bounded whatever is read.

use crate::InputError;
use std::io::{self, BufRead, Read};

/// Reads the lines of a text with their numbers, counted from 1; blank ones are skipped.
///
/// A line that is too long or not UTF-8 is an error, and reading continues with the next line. A line
/// that is too long is an error before its end is read. If reading itself fails, that error is the last
/// item.
pub struct TextLines<R> {
    reader: R,
    file: String,
    longest: usize,
    number: usize,
    /// True if the rest of a line that is too long is still to be skipped.
    inside: bool,
    ended: bool,
}

impl<R: BufRead> TextLines<R> {
    /// The lines of a reader; `file` is the name in errors, `longest` the most bytes of a line.
    pub fn new(reader: R, file: &str, longest: usize) -> TextLines<R> {
        TextLines {
            reader,
            file: file.to_owned(),
            longest,
            number: 0,
            inside: false,
            ended: false,
        }
    }

    /// How many lines were read.
    pub fn lines_read(&self) -> usize {
        self.number
    }

    /// An error in the line that was read last.
    pub fn error(&self, message: impl Into<String>) -> InputError {
        InputError::at(&self.file, self.number, message)
    }

    /// The next line without its end; none at the end of the text.
    fn line(&mut self) -> io::Result<Option<Vec<u8>>> {
        if std::mem::take(&mut self.inside) {
            self.reader.skip_until(b'\n')?;
        }
        let mut bytes = Vec::new();
        let mut limited = self.reader.by_ref().take(self.longest as u64 + 1);
        if limited.read_until(b'\n', &mut bytes)? == 0 {
            return Ok(None);
        }
        self.number += 1;
        if bytes.last() == Some(&b'\n') {
            bytes.pop();
        }
        self.inside = bytes.len() > self.longest;
        Ok(Some(bytes))
    }
}

impl<R: BufRead> Iterator for TextLines<R> {
    type Item = Result<(usize, String), InputError>;

    fn next(&mut self) -> Option<Self::Item> {
        while !self.ended {
            let bytes = match self.line() {
                Ok(Some(bytes)) => bytes,
                Ok(None) => break,
                Err(error) => {
                    self.ended = true;
                    return Some(Err(InputError::reading(
                        &self.file,
                        Some(self.number + 1),
                        &error,
                    )));
                }
            };
            if self.inside {
                let longest = self.longest;
                return Some(Err(
                    self.error(format!("a line of more than {longest} bytes"))
                ));
            }
            match String::from_utf8(bytes) {
                Ok(text) if text.trim_ascii().is_empty() => {}
                Ok(text) => return Some(Ok((self.number, text))),
                Err(error) => {
                    let byte = error.utf8_error().valid_up_to() + 1;
                    return Some(Err(self.error(format!("not UTF-8 at byte {byte}"))));
                }
            }
        }
        self.ended = true;
        None
    }
}
