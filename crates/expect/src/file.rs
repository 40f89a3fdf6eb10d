//! Reads a file of expectations, strictly: an unknown name, a duplicate or a typing error is an error
//! that names its line.

use super::{Amount, Expectations, ExpectedEntry, SCHEMA};
use crate::audit::is_of_mesh;
use crate::case::SceneKind;
use crate::family::{FAMILIES, STRATA};
use crate::kernel;
use crate::suggest::nearest_name;
use hairline_core::ScalarName;
use hairline_files::InputError;
use hairline_record::{FindingClass, FindingKind, Key};
use serde::Deserialize;
use serde::de::DeserializeOwned;
use std::collections::BTreeMap;
use std::ops::Range;
use toml::Spanned;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct FileText {
    #[serde(rename = "schema")]
    _schema: String,
    #[serde(default)]
    cases: String,
    sources: Option<String>,
    scene: Option<String>,
    #[serde(default)]
    known: Vec<RowText>,
}

/// The part of any version.
#[derive(Deserialize)]
struct Version {
    schema: Spanned<String>,
}

/// A kernel row, with its known disagreements.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RowText {
    kernel: Spanned<String>,
    set: String,
    findings: Vec<Spanned<FindingText>>,
}

/// A finding in a scalar on some families, each with its count or with a bound of its rate.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct FindingText {
    scalar: Spanned<String>,
    finding: Spanned<String>,
    #[serde(default)]
    counts: BTreeMap<String, u64>,
    #[serde(default)]
    rates: BTreeMap<String, f64>,
    why: Option<String>,
    url: Option<String>,
}

/// Reads expectations, without their lock file; `file` is their name in errors. Kernels may also be those of a
/// record, which this process does not have.
pub fn read(text: &str, file: &str, of_record: &[&str]) -> Result<Expectations, InputError> {
    let reader = ExpectationsReader::new(text, file, of_record);
    let version: Version = reader.parse()?;
    if version.schema.get_ref() != SCHEMA {
        let found = version.schema.get_ref();
        let message = format!(
            "schema '{found}', expected '{SCHEMA}': move the file away, and `hairline check --bless`, or \
             HAIRLINE_BLESS=1 in a test, writes one of today"
        );
        return Err(reader.error(&version.schema.span(), message));
    }
    let parsed: FileText = reader.parse()?;
    let mut entries: BTreeMap<Key, ExpectedEntry> = BTreeMap::new();
    for row in &parsed.known {
        reader.check_kernel(&row.kernel)?;
        for finding in &row.findings {
            for (key, entry) in reader.entries(row, finding)? {
                if let Some(first) = entries.get(&key) {
                    let message =
                        format!("{} a second time, first in line {}", key.family, first.line);
                    return Err(reader.error(&finding.span(), message));
                }
                entries.insert(key, entry);
            }
        }
    }
    let FileText {
        cases,
        sources,
        scene,
        ..
    } = parsed;
    Ok(Expectations {
        cases,
        sources,
        scene,
        entries,
        lock: None,
    })
}

/// The advice for a kernel that was renamed.
const RENAMED: &str = " (of a renamed kernel, replace the name here and in the lock file)";

struct ExpectationsReader<'a> {
    text: &'a str,
    /// Where each line ends.
    newlines: Vec<usize>,
    file: &'a str,
    of_record: &'a [&'a str],
    /// The names of all families and strata.
    families: Vec<&'static str>,
}

impl<'a> ExpectationsReader<'a> {
    fn new(text: &'a str, file: &'a str, of_record: &'a [&'a str]) -> ExpectationsReader<'a> {
        let newlines = text.match_indices('\n').map(|(at, _)| at);
        let families = FAMILIES.iter().chain(STRATA);
        ExpectationsReader {
            text,
            newlines: newlines.collect(),
            file,
            of_record,
            families: families.map(|family| family.name).collect(),
        }
    }

    fn parse<T: DeserializeOwned>(&self) -> Result<T, InputError> {
        toml::from_str(self.text).map_err(|error| {
            let message = error.message().replace('\n', "; ");
            match error.span() {
                Some(span) => self.error(&span, message),
                None => InputError::of(self.file, message),
            }
        })
    }

    fn line(&self, span: &Range<usize>) -> usize {
        self.newlines.partition_point(|at| *at < span.start) + 1
    }

    fn error(&self, span: &Range<usize>, message: impl Into<String>) -> InputError {
        InputError::at(self.file, self.line(span), message)
    }

    /// A name that must be in a table; `span` is its place.
    fn check(
        &self,
        what: &str,
        (text, span): (&String, Range<usize>),
        table: &[&str],
    ) -> Result<(), InputError> {
        if table.contains(&text.as_str()) {
            return Ok(());
        }
        let advice = match nearest_name(text, table.iter().copied()) {
            Some(near) => format!("did you mean '{near}'?"),
            None => format!("expected one of {}", table.join(", ")),
        };
        let renamed = if what == "kernel" { RENAMED } else { "" };
        Err(self.error(&span, format!("unknown {what} '{text}': {advice}{renamed}")))
    }

    fn check_kernel(&self, name: &Spanned<String>) -> Result<(), InputError> {
        let kernel = name.get_ref();
        if kernel::find(kernel).is_some() || self.of_record.contains(&kernel.as_str()) {
            return Ok(());
        }
        let kernels: Vec<&str> = kernel::all().iter().map(|entry| entry.info.name).collect();
        if nearest_name(kernel, kernels.iter().copied()).is_none() {
            let message = format!(
                "unknown kernel '{kernel}': see `hairline list kernels`; one of your own is known by its --kernel-lib or --kernel-cmd{RENAMED}"
            );
            return Err(self.error(&name.span(), message));
        }
        self.check("kernel", (kernel, name.span()), &kernels)
    }

    fn entries(
        &self,
        row: &RowText,
        spanned: &Spanned<FindingText>,
    ) -> Result<Vec<(Key, ExpectedEntry)>, InputError> {
        let FindingText {
            scalar,
            finding,
            counts,
            rates,
            why,
            url,
        } = spanned.get_ref();
        let kinds: Vec<&str> = FindingKind::FOUND.iter().map(|kind| kind.name()).collect();
        self.check(
            "scalar",
            (scalar.get_ref(), scalar.span()),
            &ScalarName::ALL.map(ScalarName::name),
        )?;
        self.check("finding", (finding.get_ref(), finding.span()), &kinds)?;
        let wrong = |message: String| self.error(&spanned.span(), message);
        let count = |(family, count): (&String, &u64)| match *count {
            0 => Err(wrong(format!(
                "count 0 of {family} is what is expected anyway: remove it"
            ))),
            count => Ok((family.clone(), Amount::Count { count, cases: None })),
        };
        let rate = |(family, rate): (&String, &f64)| match *rate {
            rate if 0.0 < rate && rate <= 1.0 => Ok((family.clone(), Amount::Rate(rate))),
            rate => Err(wrong(format!(
                "rate {rate} of {family} is not above 0 and at most 1"
            ))),
        };
        let amounts = counts.iter().map(count).chain(rates.iter().map(rate));
        let entry = |amount: Result<(String, Amount), InputError>| {
            let (family, amount) = amount?;
            if !is_of_mesh(&family) && !family.starts_with("corpus:") {
                let of_kind = family
                    .split_once(':')
                    .filter(|(_, kind)| SceneKind::named(kind).is_some());
                let name = of_kind.map_or(family.clone(), |(stratum, _)| stratum.to_owned());
                self.check("family", (&name, spanned.span()), &self.families)?;
            }
            let key = Key {
                kernel: row.kernel.get_ref().clone(),
                set: row.set.clone(),
                scalar: ScalarName::named(scalar.get_ref()).expect("checked above"),
                family,
                class: FindingClass::Any,
                finding: FindingKind::named(finding.get_ref()).expect("checked above"),
            };
            let line = self.line(&spanned.span());
            Ok((
                key,
                ExpectedEntry {
                    line,
                    amount,
                    why: why.clone(),
                    url: url.clone(),
                },
            ))
        };
        let entries: Vec<(Key, ExpectedEntry)> = amounts.map(entry).collect::<Result<_, _>>()?;
        match entries.is_empty() {
            true => Err(wrong("expected counts or rates by family".to_owned())),
            false => Ok(entries),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn file(findings: &str) -> String {
        format!(
            "schema = \"{SCHEMA}\"\ncases = \"0\"\n\n[[known]]\nkernel = \"cramer\"\nset = \"zero\"\n\
             findings = [\n{findings}]\n"
        )
    }

    const ENTRY: &str = "  { scalar = \"f32\", finding = \"false-hit\", counts = { tiny = 3, coplanar = 9 }, \
                         rates = { interior = 0.5 } },\n";

    #[test]
    fn an_entry_is_read_with_its_line() {
        let expectations = read(&file(ENTRY), "e.toml", &[]).unwrap();
        let entries: Vec<(String, &Amount)> = expectations
            .entries
            .iter()
            .map(|(key, entry)| {
                assert_eq!(entry.line, 8);
                (key.to_string(), &entry.amount)
            })
            .collect();
        let name = |family: &str| format!("cramer (zero) f32 {family}: false-hit of any class");
        let count = |count| Amount::Count { count, cases: None };
        assert_eq!(
            entries,
            [
                (name("coplanar"), &count(9)),
                (name("interior"), &Amount::Rate(0.5)),
                (name("tiny"), &count(3))
            ]
        );
    }

    #[test]
    fn what_is_wrong_is_named_with_its_line() {
        let refused = |text: &str| read(text, "e.toml", &[]).unwrap_err().to_string();
        let entry = file(ENTRY);
        for (from, to, expected) in [
            (
                "cramer",
                "cramr",
                "e.toml:5: unknown kernel 'cramr': did you mean 'cramer'?",
            ),
            (
                "f32",
                "f16",
                "e.toml:8: unknown scalar 'f16': expected one of f32, f64",
            ),
            (
                "tiny",
                "tiyn",
                "e.toml:8: unknown family 'tiyn': did you mean 'tiny'?",
            ),
            (
                "false-hit",
                "falsehit",
                "e.toml:8: unknown finding 'falsehit'",
            ),
            (
                "counts =",
                "count =",
                "e.toml:8: unknown field `count`, expected one of",
            ),
            (
                "= 3",
                "= 0",
                "e.toml:8: count 0 of tiny is what is expected anyway",
            ),
            (
                "0.5",
                "2.0",
                "e.toml:8: rate 2 of interior is not above 0 and at most 1",
            ),
            (
                "0.5",
                "0.0",
                "e.toml:8: rate 0 of interior is not above 0 and at most 1",
            ),
            (
                "interior",
                "tiny",
                "e.toml:8: tiny a second time, first in line 8",
            ),
            (
                "expectations/2",
                "expectations/1",
                "e.toml:1: schema 'hairline-expectations/1'",
            ),
            ("set = \"zero\"", "set = zero", "e.toml:6: "),
        ] {
            let message = refused(&entry.replace(from, to));
            assert!(message.starts_with(expected), "{expected}: {message}");
            assert_eq!(message.lines().count(), 1, "{message}");
        }
        let twice = refused(&file(&ENTRY.repeat(2)));
        assert_eq!(twice, "e.toml:9: coplanar a second time, first in line 8");
        let none = refused(&file("  { scalar = \"f32\", finding = \"false-hit\" },\n"));
        assert_eq!(none, "e.toml:8: expected counts or rates by family");
    }
}
