//! Corpus files: one case a JSON object, with its truth and its bit patterns; one a line as they are written.

use super::case_json;
pub use super::stored_case::StoredCase;
pub use super::stored_truth::StoredTruth;
pub use crate::case::AnyCase;
use crate::files::InputError;
use crate::files::json_lines::JsonLines;
use crate::files::text_lines::TextLines;
use std::io::BufRead;

/// The most bytes of a line.
pub const LONGEST_LINE: usize = 1 << 20;

/// The cases of a corpus file, one after the other; blank lines are skipped. `file` is the name in
/// errors. A case may have several lines, and the file may be an array of cases.
///
/// A line that is not a case, is longer than 1 MiB or is not UTF-8 is an error, and reading continues with
/// the next line. If reading itself fails, that error is the last item.
pub fn read<R: BufRead>(
    reader: R,
    file: &str,
) -> impl Iterator<Item = Result<StoredCase, InputError>> + use<R> {
    let name = file.to_owned();
    TextLines::new(JsonLines::new(reader), file, LONGEST_LINE)
        .map(move |line| line.and_then(|(number, text)| case_of(&text, number, &name)))
}

/// The case that stands in a line.
pub fn case_of(text: &str, line: usize, file: &str) -> Result<StoredCase, InputError> {
    case_json::parse(text, line).map_err(|message| InputError::at(file, line, message))
}

/// A case as one line without its end, with its bit patterns. [`read`] gives the same case back,
/// every bit of it; `line` is not written, nor an interval that is the default one.
pub fn write_case(stored: &StoredCase) -> String {
    either_scalar!(&stored.case, case => case_json::write(stored, case))
}

/// A case as `hairline explain` takes it: without its bit patterns, because its numbers say the same.
pub fn bare_case(case: impl Into<AnyCase>) -> String {
    either_scalar!(&case.into(), case => case_json::write_bare(case))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::HashSet;
    use std::io::{self, Read};

    const CASE: &str =
        r#""origin":[0,0,1],"direction":[0,0,-1],"a":[0,0,0],"b":[4,0,0],"c":[0,4,0]"#;

    fn read_text(text: impl AsRef<[u8]>) -> Vec<Result<StoredCase, String>> {
        let reader = io::BufReader::with_capacity(7, text.as_ref());
        read(reader, "cases.jsonl")
            .map(|item| item.map_err(|error| error.to_string()))
            .collect()
    }

    #[test]
    fn each_error_names_its_line_and_goes_on() {
        let good = format!(r#"{{"scalar":"f64",{CASE}}}"#);
        let long = format!("{good}{}", " ".repeat(LONGEST_LINE));
        let full = format!("{good}{}", " ".repeat(LONGEST_LINE - good.len()));
        let lines: [&[u8]; 9] = [
            b"",
            good.as_bytes(),
            b"# no",
            b" \t\r",
            long.as_bytes(),
            b"\xff",
            b"",
            b"{",
            full.as_bytes(),
        ];
        let items = read_text(lines.join(&b'\n'));
        let lines: Vec<_> = items.iter().flatten().map(|case| case.line).collect();
        assert_eq!(lines, [2, 9]);
        let errors: Vec<_> = items.into_iter().filter_map(Result::err).collect();
        assert_eq!(
            errors,
            [
                "cases.jsonl:3: expected an object, found # no",
                "cases.jsonl:5: a line of more than 1048576 bytes",
                "cases.jsonl:6: not UTF-8 at byte 1",
                "cases.jsonl:8: EOF while parsing an object at column 2",
            ]
        );
        assert_eq!(read_text("").len() + read_text("\n\n").len(), 0);
    }

    #[test]
    fn a_file_that_cannot_be_read_ends() {
        struct Broken;
        impl Read for Broken {
            fn read(&mut self, _: &mut [u8]) -> io::Result<usize> {
                Err(io::Error::other("the disk is gone"))
            }
        }
        let items: Vec<_> = read(io::BufReader::new(Broken), "x").take(3).collect();
        let [Err(error)] = &items[..] else { panic!() };
        assert_eq!(error.to_string(), "x:1: cannot read: the disk is gone");
    }

    #[test]
    fn wrong_lines_are_refused_in_one_line() {
        let [old, new] = [CASE, "CASE"];
        for (line, message) in [
            (
                r#"{"unit":1}"#,
                "unknown field 'unit', expected one of name, scalar, origin, direction, from, to, a, b, c, t_min, t_max, starts, truth, bits, why, url, found, note, ",
            ),
            (
                r#"{"orign":1}"#,
                "unknown field 'orign': did you mean 'origin'?",
            ),
            (
                r#"{"scalar":"f32",CASE,"tmax":1}"#,
                "unknown field 'tmax': did you mean 't_max'?",
            ),
            (
                r#"{"scalar":"f32",CASE,"to":[0,0,0]}"#,
                "origin: leave it out, or 'from' and 'to'",
            ),
            (r#"{"scalar":"f32","from":[0,0,0]}"#, "missing field 'to'"),
            (
                r#"{"a\nb":1}"#,
                "unknown field 'a\\nb', expected one of name, ",
            ),
            (r#"{CASE,"a":[0,0,0]}"#, "duplicate field 'a'"),
            ("{CASE}", "missing field 'scalar'"),
            (r#"{"scalar":"f32"}"#, "missing field 'origin'"),
            (
                r#"{"scalar":"f64","origin":[0,0,0],"direction":[0,0,0],"a":[0,0,0],"b":[0,0,0]}"#,
                "missing field 'c'",
            ),
            (
                r#"{"scalar":"f16",CASE}"#,
                "scalar: 'f16' is none of f32, f64",
            ),
            (
                r#"{"scalar":32,CASE}"#,
                "scalar: expected a string, found 32",
            ),
            (
                r#"{"scalar":"f32","origin":[0,1e999,0]}"#,
                "origin[1]: '1e999' overflows f32",
            ),
            (
                r#"{"scalar":"f32","origin":[0,0,"1_0"]}"#,
                "origin[2]: '1_0' is not a number: ",
            ),
            (
                r#"{"scalar":"f32","origin":[true,0,0]}"#,
                "origin[0]: expected a number or a string, found true",
            ),
            (
                r#"{"scalar":"f32","origin":[null,0,0]}"#,
                "origin[0]: expected a number or a string, found null",
            ),
            (
                r#"{"scalar":"f32","origin":[0,0]}"#,
                "origin: expected 3 numbers, found 2",
            ),
            (
                r#"{"scalar":"f32","origin":7}"#,
                "origin: expected an array of 3 numbers, found 7",
            ),
            (
                r#"{"scalar":"f32","origin":null}"#,
                "origin: expected an array of 3 numbers, found null",
            ),
            (
                r#"{"scalar":"f32",CASE,"t_max":null}"#,
                "t_max: expected a number or a string, found null",
            ),
            (
                r#"{"scalar":"f32",CASE,"t_min":"-1e39"}"#,
                "t_min: '-1e39' overflows f32",
            ),
            (
                r#"{"scalar":"f32",CASE,"starts":"on-edge"}"#,
                "starts: expected 'on-triangle', found 'on-edge'",
            ),
            (
                r#"{"scalar":"f32",CASE,"name":null}"#,
                "name: expected a string, found null",
            ),
            (
                r#"{"scalar":"f32",CASE,"why":1}"#,
                "why: expected a string, found 1",
            ),
            (
                r#"{"scalar":"f32",CASE,"url":[]}"#,
                "url: expected a string, found []",
            ),
            (
                r#"{"scalar":"f32",CASE,"truth":null}"#,
                "truth: expected an object, found null",
            ),
            (
                r#"{"scalar":"f32",CASE,"truth":{"t":"in"}}"#,
                "truth: t: 'in' is none of before, ",
            ),
            (
                r#"{"scalar":"f32",CASE,"bits":{"d":[]}}"#,
                "bits: unknown field 'd', expected one of origin, direction, from, to, a, b, c, t_min, t_max",
            ),
            (
                r#"{"scalar":"f32",CASE,"t_max":None}"#,
                "t_max: 'None' is not a number: write a decimal (-1.5e-3), a hexadecimal float (0x1.8p-3), a bit pattern (0x3e4ccccd), inf or nan",
            ),
            ("\u{feff}{}", "missing field 'scalar'"),
            (r#"["f32"]"#, "expected an object, found [\"f32\"]"),
            (
                r#"{"scalar":"f32",CASE} x"#,
                "trailing characters at column 92",
            ),
        ] {
            let line = line.replace(new, old);
            let error = read_text(&line).remove(0).unwrap_err();
            let (place, error) = error.split_once(": ").unwrap();
            assert!(
                place.starts_with("cases.jsonl:") && error.starts_with(message),
                "{line}: {error}"
            );
            assert!(!error.contains('\n'));
        }
    }

    #[test]
    fn the_curated_cases_are_all_read_and_written_as_they_stand() {
        let corpora = concat!(env!("CARGO_MANIFEST_DIR"), "/../../corpora/curated.jsonl");
        let file = std::fs::read_to_string(corpora).unwrap();
        let cases: Vec<_> = read_text(&file[..])
            .into_iter()
            .map(Result::unwrap)
            .collect();
        assert!(cases.len() >= 170, "{}", cases.len());
        assert_eq!(cases.len(), file.lines().count());
        let names: HashSet<_> = cases.iter().flat_map(|case| &case.name).collect();
        assert_eq!(names.len(), cases.len(), "each case has a name of its own");
        for (case, line) in cases.iter().zip(file.lines()) {
            assert!(case.truth.is_some() && case.why.is_some(), "{line}");
            let written = write_case(case);
            let (head, bits) = written.split_once(",\"bits\":{").unwrap();
            let (_, tail) = bits.split_once('}').unwrap();
            assert!(
                line == written || line == format!("{head}{tail}"),
                "{line}\n{written}"
            );
        }
    }
}
