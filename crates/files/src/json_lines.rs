//! JSON lines, made of what people have: objects over several lines, an array of objects, a byte-order mark.

use std::io::{self, BufRead, Read};
use std::iter::repeat_n;
use std::mem::take;

const MARK: &[u8] = b"\xef\xbb\xbf";

/// Hands on a text with each object on one line, the line on which it begins. What is no object is handed on as it
/// stands, so that who reads the lines finds it. Keeps a chunk in memory, however long an object is.
pub struct JsonLines<R> {
    reader: R,
    lines: LinesRead,
    /// How much of the lines was handed on.
    read: usize,
}

impl<R: BufRead> JsonLines<R> {
    /// A reader's text as JSON lines.
    pub fn new(reader: R) -> JsonLines<R> {
        JsonLines {
            reader,
            lines: LinesRead::default(),
            read: 0,
        }
    }
}

impl<R: BufRead> BufRead for JsonLines<R> {
    fn fill_buf(&mut self) -> io::Result<&[u8]> {
        while self.read == self.lines.out.len() {
            self.lines.out.clear();
            self.read = 0;
            let chunk = self.reader.fill_buf()?;
            if chunk.is_empty() {
                self.lines.end();
                break;
            }
            self.lines.add_all(chunk);
            let count = chunk.len();
            self.reader.consume(count);
        }
        Ok(&self.lines.out[self.read..])
    }

    fn consume(&mut self, count: usize) {
        self.read += count;
    }
}

impl<R: BufRead> Read for JsonLines<R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let count = self.fill_buf()?.read(buffer)?;
        self.consume(count);
        Ok(count)
    }
}

/// Where a byte stands.
#[derive(Clone, Copy, Default, PartialEq)]
enum BytePlace {
    /// Before everything but a mark and blanks.
    #[default]
    Start,
    /// After the bracket that begins the text, and blanks.
    Bracket,
    /// Before everything but blanks in a line.
    LineStart,
    /// After an object of an array, in its line.
    Behind,
    Object,
    /// In the rest of a line.
    Rest,
}

#[derive(Default)]
struct LinesRead {
    /// The lines made of the last chunk.
    out: Vec<u8>,
    place: BytePlace,
    /// How many bytes of the mark were met.
    mark: usize,
    /// True between the objects of an array, and in them.
    in_array: bool,
    /// Line ends inside an object, which follow after it.
    held: usize,
    /// Inside an object: the brackets that are open.
    depth: usize,
    in_string: bool,
    is_escaped: bool,
    /// The last byte but blanks, and true if a line ended since.
    last: u8,
    begins_line: bool,
}

impl LinesRead {
    fn add_all(&mut self, mut text: &[u8]) {
        while let Some((first, rest)) = text.split_first() {
            let begins =
                matches!(self.place, BytePlace::Start | BytePlace::LineStart) && !self.in_array;
            if begins && *first == b'{' {
                // As most lines are: copied whole, which is several times as fast.
                let (start, mut behind) = (self.out.len(), text);
                if behind.read_until(b'\n', &mut self.out).is_ok() && is_plain(&self.out[start..]) {
                    (self.place, text) = (BytePlace::LineStart, behind);
                    continue;
                }
                self.out.truncate(start);
            }
            self.add(*first);
            text = rest;
        }
    }

    fn add(&mut self, byte: u8) {
        if self.place == BytePlace::Object {
            return self.add_inside(byte);
        }
        let is_blank = byte == b' ' || byte == b'\t' || byte == b'\r';
        match (self.place, byte) {
            (BytePlace::Start, _) if MARK.get(self.mark) == Some(&byte) => self.mark += 1,
            (BytePlace::Start, b'\n') => self.out.push(byte),
            (BytePlace::Start, b'[') => self.place = BytePlace::Bracket,
            (BytePlace::Bracket, b'{') => {
                self.in_array = true;
                self.begin();
            }
            (BytePlace::Bracket, b'\n') => self.held += 1,
            (BytePlace::Bracket, _) if is_blank => {}
            (BytePlace::Bracket, b']') => self.place = BytePlace::Rest,
            (BytePlace::Bracket, _) => {
                self.out.extend([b'[', byte]);
                self.place = BytePlace::Rest;
            }
            (_, b'\n') => self.end_line(),
            (BytePlace::Start | BytePlace::LineStart, b'{') => self.begin(),
            (BytePlace::Behind | BytePlace::LineStart, b',') if self.in_array => {}
            (BytePlace::Behind | BytePlace::LineStart, b']') if self.in_array => {
                (self.place, self.in_array) = (BytePlace::Rest, false);
            }
            (BytePlace::Behind, _) if !is_blank => {
                // Another object in the line, which begins one of its own.
                self.held = self.held.saturating_sub(1);
                self.end_line();
                self.add(byte);
            }
            _ => {
                self.out.push(byte);
                self.place = if is_blank {
                    self.place
                } else {
                    BytePlace::Rest
                };
            }
        }
    }

    fn begin(&mut self) {
        self.out.extend(repeat_n(b'\n', take(&mut self.held)));
        self.out.push(b'{');
        (self.place, self.depth, self.last, self.begins_line) = (BytePlace::Object, 1, b'{', false);
    }

    fn end_line(&mut self) {
        self.out.extend(repeat_n(b'\n', 1 + take(&mut self.held)));
        (self.place, self.in_string) = (BytePlace::LineStart, false);
    }

    fn add_inside(&mut self, byte: u8) {
        if self.in_string {
            if byte == b'\n' {
                // No JSON: the next line begins anew.
                return self.end_line();
            }
            self.in_string = self.is_escaped || byte != b'"';
            self.is_escaped = !self.is_escaped && byte == b'\\';
        } else if byte == b'\n' {
            (self.held, self.begins_line) = (self.held + 1, true);
            return self.out.push(b' ');
        } else if !byte.is_ascii_whitespace() {
            match byte {
                // A value has a colon before it: the object was cut off, and this is the next one.
                b'{' if self.begins_line && self.depth == 1 && self.last != b':' => {
                    self.held -= 1;
                    self.end_line();
                    return self.begin();
                }
                b'"' => self.in_string = true,
                b'{' | b'[' => self.depth += 1,
                b'}' | b']' => self.depth -= 1,
                _ => {}
            }
            (self.last, self.begins_line) = (byte, false);
            if self.depth == 0 {
                self.place = if self.in_array {
                    BytePlace::Behind
                } else {
                    BytePlace::Rest
                };
            }
        }
        self.out.push(byte);
    }

    /// Says what is missing at the end.
    fn end(&mut self) {
        if self.place == BytePlace::Bracket {
            self.out.push(b'[');
        } else if take(&mut self.in_array) && self.place != BytePlace::Object {
            self.out.extend(b"\nthe end of an array without its ]");
        }
        self.place = BytePlace::Rest;
    }
}

/// True if a line with its end holds one object, with no other inside and no brace in a string.
fn is_plain(line: &[u8]) -> bool {
    let object = line.strip_suffix(b"\n").map(<[u8]>::trim_ascii_end);
    let inside = object.and_then(|object| object.strip_prefix(b"{")?.strip_suffix(b"}"));
    inside.is_some_and(|inside| !inside.contains(&b'{') && !inside.contains(&b'}'))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lines_of(text: &str) -> String {
        let mut lines = [String::new(), String::new()];
        for (capacity, lines) in [1, 4096].into_iter().zip(&mut lines) {
            let reader = io::BufReader::with_capacity(capacity, text.as_bytes());
            JsonLines::new(reader).read_to_string(lines).unwrap();
        }
        let [slowly, lines] = lines;
        assert_eq!(slowly, lines);
        lines
    }

    #[test]
    fn an_object_stands_on_the_line_on_which_it_begins() {
        let lines = r#"{"a":"{\"}","b":[1,{"x":2}]}
# no object {

 {"a":"\\"} x
["#;
        assert_eq!(lines_of(lines), lines, "JSON lines stay as they are");
        let two = "\u{feff}{\r\n\"a\":{\n\"x\":1}\n}\n{}\n";
        assert_eq!(lines_of(two), "{\r \"a\":{ \"x\":1} }\n\n\n\n{}\n");
        let array = "\n [ \n{\"a\":1},\n{\n\"a\":[2]\n}, {}\n,\t{}, {}\n]\n";
        let expected = "\n \n{\"a\":1}\n{ \"a\":[2] } \n\n{}\n\t{} \n{}\n\n";
        assert_eq!(lines_of(array), expected);
        assert_eq!(lines_of("[[1]]\n{"), "[[1]]\n{");
    }

    #[test]
    fn what_is_cut_off_is_found_and_does_not_swallow_what_follows() {
        let good = "{\"a\":1}\n";
        for cut in ["{\"a", "{\"a\":1,", "{", "{\"a\":1"] {
            assert_eq!(
                lines_of(&format!("{cut}\n{good}")).lines().nth(1),
                good.lines().next()
            );
        }
        assert_eq!(
            lines_of("[{},\n").lines().last(),
            Some("the end of an array without its ]")
        );
        assert_eq!(lines_of(" ["), " [");
        assert_eq!(lines_of("[{}] x"), "{} x");
        assert_eq!(
            lines_of("[{} x]"),
            "{} \nx]\nthe end of an array without its ]"
        );
    }
}
