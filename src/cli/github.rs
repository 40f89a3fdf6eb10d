//! GitHub Actions: annotations on the run, and its summary, when the program runs there.

use super::exit::Failure;
use crate::record::{ComparisonVerdict, Conformance, Deviation, Record, Unproved};
use crate::report::Style;
use crate::report::page::{MARKDOWN_LIMIT, Paged, markdown_within};
use std::fs::{self, File};
use std::io::{self, Write};

/// GitHub shows ten annotations of a kind a step.
const MOST_ANNOTATIONS: usize = 10;

/// Writes annotations to standard error, where they do not mix with results, and appends to the
/// summary; nothing elsewhere.
pub fn announce(record: &Record) -> Result<(), Failure> {
    let set = |name: &str| std::env::var(name).ok().filter(|value| !value.is_empty());
    if let (Some(_), Some(conformance)) = (set("GITHUB_ACTIONS"), &record.conformance) {
        if conformance.verdict != ComparisonVerdict::Conforms {
            // The first line of the screen, whatever else has no room.
            let title = record.page().title;
            eprintln!("::error title=hairline::{}", data(&title));
        }
        for line in annotations(conformance) {
            eprintln!("{line}");
        }
    }
    match set("GITHUB_STEP_SUMMARY") {
        Some(file) => append(&file, record).map_err(|error| Failure::of_file(&file, &error)),
        None => Ok(()),
    }
}

/// Appends the record as Markdown: the file as a whole may have a mebibyte.
fn append(file: &str, record: &Record) -> io::Result<()> {
    let used = fs::metadata(file).map_or(0, |metadata| metadata.len()) as usize;
    let text = markdown_within(
        &record.page(),
        Style::default(),
        MARKDOWN_LIMIT.saturating_sub(used),
    );
    File::options()
        .create(true)
        .append(true)
        .open(file)?
        .write_all(text.as_bytes())
}

fn annotations(conformance: &Conformance) -> Vec<String> {
    let missing = |unproved: &Unproved| {
        format!(
            "::error title=hairline%3A proof missing::{}",
            data(&unproved.to_string())
        )
    };
    let mut lines: Vec<String> = conformance.unproved.iter().map(missing).collect();
    for (list, title) in [
        (&conformance.unsteady, "answers differ from run to run"),
        (&conformance.unexpected, "unexpected disagreement"),
        (&conformance.stale, "stale expectation"),
    ] {
        let room = MOST_ANNOTATIONS - usize::from(list.len() > MOST_ANNOTATIONS);
        lines.extend(
            list.iter()
                .take(room)
                .map(|found| annotation(conformance, found, title)),
        );
        if let Some(more) = list.len().checked_sub(room).filter(|more| *more > 0) {
            lines.push(format!("::error title=hairline: {title}::and {more} more"));
        }
    }
    lines
}

fn annotation(conformance: &Conformance, found: &Deviation, title: &str) -> String {
    let place = match (&conformance.expectations, found.line) {
        (Some(file), Some(line)) => format!("file={},line={line},", property(file)),
        _ => String::new(),
    };
    let mut text = found.describe();
    if let Some(command) = &found.command {
        text.push_str(&format!("\n{command}"));
    }
    format!(
        "::error {place}title={}::{}",
        property(&format!("hairline: {title}")),
        data(&text)
    )
}

/// As the runner's toolkit escapes a message.
fn data(text: &str) -> String {
    text.replace('%', "%25")
        .replace('\r', "%0D")
        .replace('\n', "%0A")
}

/// And a property.
fn property(text: &str) -> String {
    data(text).replace(':', "%3A").replace(',', "%2C")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn messages_and_properties_are_escaped() {
        assert_eq!(data("5 %\nb: c, d"), "5 %25%0Ab: c, d");
        assert_eq!(property("a: b, c"), "a%3A b%2C c");
    }
}
