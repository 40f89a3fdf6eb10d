//! The record as JUnit XML, as CI servers read it: one suite a kernel row, one case per scalar, family
//! and kind of finding.
//!
//! In an audit every disagreement fails its case; in a check only what is unexpected or stale does.

use hairline_record::{
    Deviation, FindingClass, FindingKind, Key, Record, Unproved, disagreements, group_digits,
    kinds_of,
};

use crate::format::Style;
use crate::plot::escaped;
use std::collections::BTreeMap;
use std::io::{self, Write};

/// One test.
#[derive(Default)]
pub struct JunitCase {
    /// Heading and text of what failed.
    pub failures: Vec<(String, String)>,
    /// The faults that are known.
    pub notes: Vec<String>,
}

/// Tests by place (scalar with family), and kind of finding.
type Suite = BTreeMap<(String, String), JunitCase>;

/// Writes the record.
pub(super) fn write(record: &Record, _: Style, out: &mut dyn Write) -> io::Result<()> {
    write_junit(&suites(record), out)
}

/// Writes tests by the names of their suites.
pub fn write_junit(suites: &BTreeMap<String, Suite>, out: &mut dyn Write) -> io::Result<()> {
    let all = || suites.values().flat_map(|suite| suite.values());
    writeln!(out, "<?xml version=\"1.0\" encoding=\"UTF-8\"?>")?;
    writeln!(
        out,
        "<testsuites name=\"hairline\" tests=\"{}\" failures=\"{}\" errors=\"0\">",
        all().count(),
        failures(all())
    )?;
    for (name, suite) in suites {
        writeln!(
            out,
            "  <testsuite name=\"{}\" tests=\"{}\" failures=\"{}\" errors=\"0\" skipped=\"0\">",
            escaped(name),
            suite.len(),
            failures(suite.values())
        )?;
        for ((place, kind), case) in suite {
            write_case(name, place, kind, case, out)?;
        }
        writeln!(out, "  </testsuite>")?;
    }
    writeln!(out, "</testsuites>")
}

/// Writes that a run ended without a record: one test with an error.
pub(super) fn write_failure(code: u8, message: &str, out: &mut dyn Write) -> io::Result<()> {
    let message = escaped(message);
    writeln!(
        out,
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>
<testsuites name=\"hairline\" tests=\"1\" failures=\"0\" errors=\"1\">
  <testsuite name=\"hairline\" tests=\"1\" failures=\"0\" errors=\"1\" skipped=\"0\">
    <testcase classname=\"hairline\" name=\"run\">
      <error type=\"exit {code}\" message=\"{message}\"/>
    </testcase>
  </testsuite>
</testsuites>"
    )
}

fn failures<'a>(cases: impl Iterator<Item = &'a JunitCase>) -> usize {
    cases.filter(|case| !case.failures.is_empty()).count()
}

fn suites(record: &Record) -> BTreeMap<String, Suite> {
    let mut suites: BTreeMap<String, Suite> = BTreeMap::new();
    for part in &record.result.results {
        for kind in kinds_of(part) {
            case_of(&mut suites, &Key::of(part, FindingClass::Any, kind));
        }
    }
    match &record.conformance {
        None => {
            for found in disagreements(&record.result) {
                let (count, of) = (group_digits(found.rate.count), group_digits(found.rate.of));
                let text = found
                    .example
                    .as_ref()
                    .map(|e| format!("{}\n{}", e.command, e.bits));
                let failure = (
                    format!("{}: {count} of {of}", found.key),
                    text.unwrap_or_default(),
                );
                case_of(&mut suites, &found.key).failures.push(failure);
            }
        }
        Some(conformance) => {
            for unproved in &conformance.unproved {
                let failure = (unproved.to_string(), unproved.command.clone());
                let place = format!("{}.{}", unproved.scalar, Unproved::FAMILY);
                let suite = suites.entry(unproved.row()).or_default();
                let case = suite
                    .entry((place, FindingKind::Unproved.to_string()))
                    .or_default();
                case.failures.push(failure);
            }
            for (list, title) in [
                (&conformance.unsteady, "unsteady"),
                (&conformance.unexpected, "unexpected"),
                (&conformance.stale, "stale"),
            ] {
                for found in list {
                    let failure = (format!("{title}: {}", found.describe()), lines(found));
                    case_of(&mut suites, &found.key()).failures.push(failure);
                }
            }
            for found in &conformance.known {
                let notes = &mut case_of(&mut suites, &found.key()).notes;
                notes.push(format!("known: {}", found.describe()));
            }
        }
    }
    suites
}

fn case_of<'a>(suites: &'a mut BTreeMap<String, Suite>, key: &Key) -> &'a mut JunitCase {
    let suite = suites.entry(key.row()).or_default();
    suite
        .entry((
            format!("{}.{}", key.scalar, key.family),
            key.finding.to_string(),
        ))
        .or_default()
}

fn lines(found: &Deviation) -> String {
    let lines = [&found.why, &found.command, &found.bits];
    lines
        .into_iter()
        .flatten()
        .cloned()
        .collect::<Vec<_>>()
        .join("\n")
}

fn write_case(
    suite: &str,
    place: &str,
    kind: &str,
    case: &JunitCase,
    out: &mut dyn Write,
) -> io::Result<()> {
    let (class_name, name) = (escaped(&format!("{suite}.{place}")), escaped(kind));
    write!(
        out,
        "    <testcase classname=\"{class_name}\" name=\"{name}\""
    )?;
    if case.failures.is_empty() && case.notes.is_empty() {
        return writeln!(out, "/>");
    }
    writeln!(out, ">")?;
    // Readers of the format expect one failure a case.
    if let Some((message, _)) = case.failures.first() {
        let texts: Vec<String> = case
            .failures
            .iter()
            .map(|(message, text)| format!("{message}\n{text}"))
            .collect();
        let message = escaped(message);
        write!(out, "      <failure type=\"{name}\" message=\"{message}\">")?;
        writeln!(out, "{}</failure>", escaped(&texts.join("\n")))?;
    }
    if !case.notes.is_empty() {
        writeln!(
            out,
            "      <system-out>{}</system-out>",
            escaped(&case.notes.join("\n"))
        )?;
    }
    writeln!(out, "    </testcase>")
}
