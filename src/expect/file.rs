//! Reads a file of expectations, strictly: an unknown name, a duplicate or a typing error is an error
//! that names its line.

use super::{Amount, Entry, Expectations, SCHEMA};
use crate::audit::is_of_mesh;
use crate::corpus::InputError;
use crate::family::FAMILIES;
use crate::judge::Class;
use crate::kernel;
use crate::report::{FINDING_KINDS, Key};
use crate::suggest::nearest_name;
use serde::Deserialize;
use std::collections::BTreeMap;
use std::collections::btree_map::Entry as Place;
use std::ops::Range;
use toml::Spanned;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct FileText {
    schema: Spanned<String>,
    #[serde(default)]
    plan: String,
    #[serde(default)]
    known: Vec<RowText>,
}

/// A kernel row in a scalar, with its known disagreements.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RowText {
    kernel: Spanned<String>,
    set: String,
    scalar: Spanned<String>,
    findings: Vec<Spanned<FindingText>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct FindingText {
    family: Spanned<String>,
    class: Spanned<String>,
    finding: Spanned<String>,
    count: Option<u64>,
    of: Option<u64>,
    digest: Option<String>,
    rate: Option<f64>,
    why: Option<String>,
    url: Option<String>,
}

/// Reads expectations; `file` is their name in errors.
pub fn read(text: &str, file: &str) -> Result<Expectations, InputError> {
    let reader = Reader { text, file };
    let parsed: FileText = toml::from_str(text).map_err(|error| {
        let message = error.message().replace('\n', "; ");
        match error.span() {
            Some(span) => reader.error(&span, message),
            None => InputError::of(file, message),
        }
    })?;
    if parsed.schema.get_ref() != SCHEMA {
        let found = parsed.schema.get_ref();
        let message = format!("schema '{found}', expected '{SCHEMA}'");
        return Err(reader.error(&parsed.schema.span(), message));
    }
    let mut entries = BTreeMap::new();
    for row in &parsed.known {
        reader.check_row(row)?;
        for finding in &row.findings {
            let (key, entry) = reader.entry(row, finding)?;
            match entries.entry(key) {
                Place::Vacant(place) => _ = place.insert(entry),
                Place::Occupied(first) => {
                    let first: &Entry = first.get();
                    let message = format!("expected a second time, first in line {}", first.line);
                    return Err(reader.error(&finding.span(), message));
                }
            }
        }
    }
    Ok(Expectations { plan: parsed.plan, entries })
}

struct Reader<'a> {
    text: &'a str,
    file: &'a str,
}

impl Reader<'_> {
    fn line(&self, span: &Range<usize>) -> usize {
        let before = &self.text.as_bytes()[..span.start.min(self.text.len())];
        before.iter().filter(|byte| **byte == b'\n').count() + 1
    }

    fn error(&self, span: &Range<usize>, message: impl Into<String>) -> InputError {
        InputError::at(self.file, self.line(span), message)
    }

    /// A name that must be in a table.
    fn check(&self, what: &str, name: &Spanned<String>, table: &[&str]) -> Result<(), InputError> {
        let text = name.get_ref();
        if table.contains(&text.as_str()) {
            return Ok(());
        }
        let advice = match nearest_name(text, table.iter().copied()) {
            Some(near) => format!("did you mean '{near}'?"),
            None => format!("expected one of {}", table.join(", ")),
        };
        Err(self.error(&name.span(), format!("unknown {what} '{text}': {advice}")))
    }

    fn check_row(&self, row: &RowText) -> Result<(), InputError> {
        if kernel::find(row.kernel.get_ref()).is_none() {
            let kernels: Vec<&str> = kernel::all().iter().map(|entry| entry.info.name).collect();
            if nearest_name(row.kernel.get_ref(), kernels.iter().copied()).is_none() {
                let message = format!(
                    "unknown kernel '{}': see `hairline list kernels`; one of your own is known by its --kernel-lib or --kernel-cmd",
                    row.kernel.get_ref()
                );
                return Err(self.error(&row.kernel.span(), message));
            }
            self.check("kernel", &row.kernel, &kernels)?;
        }
        self.check("scalar", &row.scalar, &["f32", "f64"])
    }

    fn entry(
        &self,
        row: &RowText,
        spanned: &Spanned<FindingText>,
    ) -> Result<(Key, Entry), InputError> {
        let finding = spanned.get_ref();
        let families: Vec<&str> = FAMILIES.iter().map(|family| family.name).collect();
        let family = finding.family.get_ref();
        if !is_of_mesh(family) && !family.starts_with("corpus:") {
            self.check("family", &finding.family, &families)?;
        }
        let mut classes: Vec<String> = Class::all().map(Class::name).collect();
        classes.extend(["group".to_owned(), "polygon".to_owned()]);
        let classes: Vec<&str> = classes.iter().map(String::as_str).collect();
        self.check("class", &finding.class, &classes)?;
        let kinds: Vec<&str> = FINDING_KINDS.iter().map(|(name, _)| *name).collect();
        self.check("finding", &finding.finding, &kinds)?;
        let key = Key {
            kernel: row.kernel.get_ref().clone(),
            set: row.set.clone(),
            scalar: row.scalar.get_ref().clone(),
            family: family.clone(),
            class: finding.class.get_ref().clone(),
            finding: finding.finding.get_ref().clone(),
        };
        let amount = amount(finding).map_err(|message| self.error(&spanned.span(), message))?;
        let (why, url) = (finding.why.clone(), finding.url.clone());
        Ok((key, Entry { line: self.line(&spanned.span()), amount, why, url }))
    }
}

fn amount(finding: &FindingText) -> Result<Amount, String> {
    match (finding.count, finding.rate) {
        (Some(0), None) => Err("count 0 is what is expected anyway: remove the entry".to_owned()),
        (Some(count), None) if finding.of.is_some_and(|of| of < count) => {
            Err(format!("count {count} is more than 'of' says"))
        }
        (Some(count), None) => {
            Ok(Amount::Count { count, of: finding.of, digest: finding.digest.clone() })
        }
        (None, Some(rate)) if finding.of.is_some() || finding.digest.is_some() => {
            Err(format!("rate {rate} stands alone: 'of' and 'digest' belong to a count"))
        }
        (None, Some(rate)) if 0.0 < rate && rate <= 1.0 => Ok(Amount::Rate(rate)),
        (None, Some(rate)) => Err(format!("rate {rate} is not above 0 and at most 1")),
        _ => Err("expected either a count or a rate".to_owned()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn file(findings: &str) -> String {
        format!(
            "schema = \"{SCHEMA}\"\nplan = \"0\"\n\n[[known]]\nkernel = \"cramer\"\nset = \"zero\"\n\
             scalar = \"f32\"\nfindings = [\n{findings}]\n"
        )
    }

    const ENTRY: &str = "  { family = \"tiny\", class = \"coplanar\", finding = \"false-hit\", count = 3, of = 9 },\n";

    #[test]
    fn an_entry_is_read_with_its_line() {
        let expectations = read(&file(ENTRY), "e.toml").unwrap();
        let (key, entry) = expectations.entries.first_key_value().unwrap();
        assert_eq!(key.to_string(), "cramer (zero) f32 tiny: false-hit of coplanar");
        assert_eq!(entry.line, 9);
        assert_eq!(entry.amount, Amount::Count { count: 3, of: Some(9), digest: None });
    }

    #[test]
    fn what_is_wrong_is_named_with_its_line() {
        let refused = |text: &str| read(text, "e.toml").unwrap_err().to_string();
        let entry = file(ENTRY);
        for (from, to, expected) in [
            ("cramer", "cramr", "e.toml:5: unknown kernel 'cramr': did you mean 'cramer'?"),
            ("f32", "f16", "e.toml:7: unknown scalar 'f16': did you mean 'f32'?"),
            ("tiny", "tyni", "e.toml:9: unknown family 'tyni': did you mean 'tiny'?"),
            ("coplanar", "coplaner", "e.toml:9: unknown class 'coplaner'"),
            ("false-hit", "falsehit", "e.toml:9: unknown finding 'falsehit'"),
            ("of = 9", "off = 9", "e.toml:9: unknown field `off`, expected one of"),
            ("count = 3", "count = 0", "e.toml:9: count 0 is what is expected anyway"),
            ("count = 3", "count = 10", "e.toml:9: count 10 is more than 'of' says"),
            ("count = 3, of = 9", "rate = 2.0", "e.toml:9: rate 2 is not above 0 and at most 1"),
            ("count = 3, ", "", "e.toml:9: expected either a count or a rate"),
            ("expectations/1", "expectations/9", "e.toml:1: schema 'hairline-expectations/9'"),
            ("set = \"zero\"", "set = zero", "e.toml:6: "),
        ] {
            let message = refused(&entry.replace(from, to));
            assert!(message.starts_with(expected), "{expected}: {message}");
            assert_eq!(message.lines().count(), 1, "{message}");
        }
        let twice = refused(&file(&ENTRY.repeat(2)));
        assert_eq!(twice, "e.toml:10: expected a second time, first in line 9");
    }
}
