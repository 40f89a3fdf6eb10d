//! The outcome of an audit from a test, and the text of its panic.

use crate::audit::quoted;
use crate::case::{AnyScalar, Case, rust_case};
#[cfg(feature = "studies")]
use crate::corpus::lines::bare_case;
use crate::kernel::KERNELS;
use crate::record::{
    ComparisonVerdict, Conformance, Example, FindingClass, FindingKind, FindingPart, Key, Promised,
    Rate, Record, counts_alone, disagreements, interval_of, percent, rate_of,
};
use std::collections::BTreeMap;
use std::fmt::{self, Write};

/// The kinds of finding that may be allowed.
pub(super) const ALLOWED: [&str; 7] = [
    "false-miss",
    "false-hit",
    "bad-value",
    "wrong-value",
    "crack",
    "double",
    "odd-fold",
];

/// The outcome of an audit.
#[derive(Clone, Debug)]
pub struct Outcome {
    /// The record, as `hairline audit --format json` writes it; its times are zero.
    pub record: Record,
    pub(super) allowed: BTreeMap<String, f64>,
}

impl Outcome {
    /// Each class of finding that occurred, by scalar, family and epsilons.
    pub fn findings(&self) -> impl Iterator<Item = &FindingPart> {
        self.record
            .result
            .results
            .iter()
            .flat_map(|result| &result.findings)
    }

    /// True if the kernel kept its contract on every case, and what it promises across triangles, but for
    /// the shares that [`Request::allow`](super::Request::allow) lets pass. With a file of expectations: true if
    /// the findings are what it says.
    pub fn conforms(&self) -> bool {
        if let Some(conformance) = &self.record.conformance {
            return conformance.verdict == ComparisonVerdict::Conforms;
        }
        disagreements(&self.record.result)
            .iter()
            .all(|found| self.is_allowed(&found.key))
    }

    /// True if a kind of finding is rare enough in its family and scalar.
    fn is_allowed(&self, key: &Key) -> bool {
        let part = self
            .record
            .result
            .results
            .iter()
            .find(|part| part.place() == key.place());
        // A kernel that promises nothing across triangles breaks no promise; expectations count its cracks.
        let promised = part
            .and_then(|part| part.across.as_ref())
            .map(|across| across.promised);
        if key.finding == FindingKind::Crack && promised == Some(Promised::Nothing) {
            return true;
        }
        let Some(most) = self.allowed.get(key.finding.name()) else {
            return false;
        };
        let rate = part.map(|part| rate_of(part, FindingClass::Any, key.finding));
        rate.is_some_and(|rate| rate.count as f64 <= most * rate.of as f64)
    }

    /// Panics unless [`Outcome::conforms`].
    #[track_caller]
    pub fn assert_conforms(&self) {
        if !self.conforms() {
            panic!("{self}");
        }
    }
}

/// How many findings a message shows in full.
const SHOWN: usize = 8;

impl fmt::Display for Outcome {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(conformance) = &self.record.conformance {
            return beside_expectations(conformance, f);
        }
        let mut parts = Vec::new();
        for result in &self.record.result.results {
            let at = format!("{} {} ({})", result.scalar, result.family, result.set);
            for part in &result.findings {
                let key = Key::of(result, part.class, part.finding);
                if counts_alone(result, part.finding) && !self.is_allowed(&key) {
                    parts.push(describe(&at, &result.kernel, part)?);
                }
            }
        }
        // What single cases do not show: polygons, and what is promised across triangles.
        let across = disagreements(&self.record.result);
        for found in across
            .iter()
            .filter(|found| !found.is_of_cases() && !self.is_allowed(&found.key))
        {
            let Key {
                kernel,
                set,
                scalar,
                family,
                class,
                finding,
            } = &found.key;
            let Rate { count, of, .. } = found.rate;
            let share = interval_of(found.rate);
            let mut text = format!(
                "{scalar} {family} ({set}): {finding} of {class}: {count} of {of}{share}\n"
            );
            if let Some(example) = &found.example {
                writeln!(text, "    {}", shown_by(kernel, example))?;
            }
            parts.push(text);
        }
        for row in &self.record.result.plan.rows {
            let breaks = if parts.is_empty() { "keeps" } else { "breaks" };
            writeln!(
                f,
                "{} ({}) {breaks} its contract: {}",
                row.kernel, row.set, row.contract
            )?;
        }
        for (finding, share) in &self.allowed {
            writeln!(
                f,
                "allowed: {finding} in up to {} of each family",
                percent(*share)
            )?;
        }
        parts
            .iter()
            .take(SHOWN)
            .try_for_each(|part| f.write_str(part))?;
        match parts.len().saturating_sub(SHOWN) {
            0 => Ok(()),
            more => writeln!(f, "and {more} more classes of findings"),
        }
    }
}

/// A class of findings with its rate and its first cases.
fn describe(at: &str, kernel: &str, part: &FindingPart) -> Result<String, fmt::Error> {
    let Rate { count, of, .. } = part.rate;
    let share = interval_of(&part.rate);
    let mut text = format!(
        "{at}: {} {}: {count} of {of}{share}\n",
        part.finding, part.class
    );
    for example in &part.first {
        write_case(kernel, example, &mut text)?;
    }
    Ok(text)
}

/// Writes the changes against a file of expectations, the worse first.
fn beside_expectations(conformance: &Conformance, f: &mut fmt::Formatter<'_>) -> fmt::Result {
    let file = conformance.expectations.as_deref().unwrap_or_default();
    writeln!(f, "{file}: {}", conformance.summary())?;
    if let Some(note) = &conformance.note {
        writeln!(f, "{note}")?;
    }
    for change in &conformance.rows {
        writeln!(f, "{change}")?;
    }
    let unexpected = conformance.unexpected.iter().map(|found| ("", found));
    let stale = conformance.stale.iter().map(|found| ("stale: ", found));
    for (what, found) in unexpected.chain(stale).take(SHOWN) {
        let line = found
            .line
            .map_or(String::new(), |line| format!("{file}:{line}: "));
        writeln!(f, "{line}{what}{}", found.describe())?;
        if let Some(why) = &found.why {
            writeln!(f, "    {why}")?;
        }
        if let (Some(case), Some(command)) = (found.case.clone(), found.command.clone()) {
            let bits = found.bits.clone().unwrap_or_default();
            write_case(
                &found.kernel,
                &Example {
                    case,
                    bits,
                    severity: None,
                    command,
                },
                f,
            )?;
        }
    }
    let more = (conformance.unexpected.len() + conformance.stale.len()).saturating_sub(SHOWN);
    if 0 < more {
        writeln!(f, "and {more} more")?;
    }
    if conformance.verdict == ComparisonVerdict::Stale {
        writeln!(f, "HAIRLINE_BLESS=1 cargo test writes what was found")?;
    }
    Ok(())
}

/// A case: the command that shows it; for a kernel in another language the case as JSON, otherwise in Rust, with its bits.
fn write_case(kernel: &str, example: &Example, text: &mut impl Write) -> fmt::Result {
    writeln!(text, "    {}", shown_by(kernel, example))?;
    let bits = example.bits.as_str();
    let is_elsewhere = runs_elsewhere(kernel, example);
    let case = literal(bits, is_elsewhere);
    let bits =
        Some(bits.to_owned()).filter(|bits| !(bits.is_empty() || is_elsewhere && case.is_some()));
    case.into_iter()
        .chain(bits)
        .try_for_each(|line| writeln!(text, "        {line}"))
}

/// The command that shows an example; a kernel of one's own is known to its own tests only.
fn shown_by(kernel: &str, example: &Example) -> String {
    if KERNELS.iter().any(|entry| entry.info.name == kernel) || runs_elsewhere(kernel, example) {
        return example.command.clone();
    }
    let case = quoted(&example.case);
    #[cfg(feature = "studies")]
    {
        let thread = std::thread::current();
        // Each test runs on a thread of its name.
        let test = thread.name().filter(|name| *name != "main");
        let test = test.map_or(String::new(), |name| format!(" {name}"));
        format!("{}={case} cargo test{test}", super::explained::VARIABLE)
    }
    #[cfg(not(feature = "studies"))]
    format!("case {case}")
}

/// True if a flag of its own chooses the kernel on the program's command line, as it does for one in another language.
fn runs_elsewhere(kernel: &str, example: &Example) -> bool {
    !example.command.contains(&format!(" --kernel {kernel}"))
}

/// A case as JSON, or as a literal in Rust, from its bits; none of a group.
#[cfg_attr(
    not(feature = "studies"),
    expect(unused_variables, reason = "no kernel is in another language")
)]
fn literal(bits: &str, as_json: bool) -> Option<String> {
    let in_f32 = Case::<f32>::from_hex(bits).map(AnyScalar::F32);
    let case = in_f32.or_else(|| Case::<f64>::from_hex(bits).map(AnyScalar::F64))?;
    #[cfg(feature = "studies")]
    if as_json {
        return Some(bare_case(case));
    }
    Some(either_scalar!(&case, case => rust_case(case)))
}
