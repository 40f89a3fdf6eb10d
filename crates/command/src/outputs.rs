//! Which format goes to which file: by `--format`, or else by how the file's name ends.

#![forbid(unsafe_code)]

use crate::exit::Failure;
use crate::places::place_of;
use crate::record::number_of;
use crate::report::Format;
use crate::suggest::nearest_name;
use std::path::{Path, PathBuf};

/// Formats with where they go: each named format to its output, one alone to standard output.
pub fn paired_outputs<'a, R>(
    table: &'static [Format<R>],
    formats: &[String],
    outputs: &'a [String],
) -> Result<Vec<(&'static Format<R>, &'a str)>, Failure> {
    let find = |name: &String| {
        let found = table.iter().find(|format| format.name == name);
        found.ok_or_else(|| {
            let names: Vec<&str> = table.iter().map(|format| format.name).collect();
            let advice = match nearest_name(name, names.iter().copied()) {
                Some(near) => format!("; did you mean '{near}'?"),
                None => format!(": there are {}", names.join(", ")),
            };
            Failure::usage(format!("unknown format '{name}'{advice}"))
        })
    };
    let of_endings: Vec<String>;
    let formats = match formats {
        [] => {
            of_endings = match outputs {
                [] => vec![table[0].name.to_owned()],
                outputs => outputs
                    .iter()
                    .map(|path| format_by_ending(table, path))
                    .collect::<Result<_, _>>()?,
            };
            &of_endings
        }
        named => named,
    };
    let formats = formats.iter().map(find).collect::<Result<Vec<_>, _>>()?;
    let places: Vec<PathBuf> = outputs.iter().map(|path| place_of(path)).collect();
    if let Some(i) = (1..places.len()).find(|&i| places[..i].contains(&places[i])) {
        return Err(Failure::usage(format!(
            "-o: '{}' is given twice",
            outputs[i]
        )));
    }
    match (formats.len(), outputs.len()) {
        (1, 0) => Ok(vec![(formats[0], "-")]),
        (n, m) if n == m => Ok(formats
            .into_iter()
            .zip(outputs.iter().map(String::as_str))
            .collect()),
        (n, m) => Err(Failure::usage(format!(
            "{} but {}: give -o once for each format, in the same order",
            number_of(n as u64, "format", "formats"),
            number_of(m as u64, "output", "outputs"),
        ))),
    }
}

/// The format of a file by its name: the first of a table, unless the name ends as that of another format that there is not.
fn format_by_ending<R>(table: &'static [Format<R>], path: &str) -> Result<String, Failure> {
    if let Some(name) = format_of(table, path) {
        return Ok(name.to_owned());
    }
    let first = table[0].name;
    match format_named_by(path) {
        Some(other) if ELSEWHERE.contains(&other.as_str()) => {
            let names: Vec<&str> = table.iter().map(|format| format.name).collect();
            Err(Failure::usage(format!(
                "-o: '{path}' is named as {other}, which is not written here: there are {}; --format {first} writes {first} there",
                names.join(", ")
            )))
        }
        _ => Ok(first.to_owned()),
    }
}

/// Formats that some commands write and others do not.
const ELSEWHERE: [&str; 6] = ["json", "csv", "html", "markdown", "junit", "sarif"];

/// The ends of files' names, with the formats that they stand for; the others are the formats' own names.
const ENDINGS: [(&str, &str); 4] = [
    ("md", "markdown"),
    ("htm", "html"),
    ("xml", "junit"),
    ("txt", "text"),
];

/// The format in which a file of a name is expected; none if its end names none of a table.
pub fn format_of<R>(table: &[Format<R>], path: &str) -> Option<&'static str> {
    let name = format_named_by(path)?;
    let mut formats = table.iter().map(|format| format.name);
    formats.find(|format| *format == name)
}

/// The format for which the end of a file's name stands.
pub fn format_named_by(path: &str) -> Option<String> {
    let ending = Path::new(path).extension()?.to_str()?.to_ascii_lowercase();
    let named = ENDINGS.iter().find(|(short, _)| *short == ending);
    Some(named.map_or(ending.clone(), |(_, name)| (*name).to_owned()))
}
