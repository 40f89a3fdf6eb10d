//! The lock file: for each target the rows that ran, and the cases behind the counts, one line a class, so that a
//! difference of two versions shows what changed.

use super::accuracy::{HitErrors, LockedErrors, errors_of};
use super::{Amount, Expectations};
use crate::audit::Digest;
use hairline_core::ScalarName;
use hairline_files::InputError;
use hairline_record::{FindingClass, FindingKind, Key, ResultPart, RowPart, disagreements};
use std::collections::BTreeMap;
use std::fmt;

/// The first word of the file, after its comment.
const SCHEMA: &str = "hairline-expectations-lock/1";

/// The first word of a line that has the errors of right hits: a value of a kernel in a scalar, the number of hits, and
/// within how many ulps half and 99 % of them are.
const ERRORS: &str = "errors";

/// How the file comes about.
const WRITER: &str = "`hairline check --bless`, or HAIRLINE_BLESS=1 in a test, writes this file";

/// The cases behind the counts of expectations.
#[derive(Clone, Debug, Default)]
pub struct Lock {
    /// The hash of what chooses the cases, which are the same on all targets.
    pub cases: String,
    /// By target, as a record's provenance names it.
    pub targets: BTreeMap<String, LockedTarget>,
}

/// The findings of a run on a target.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LockedTarget {
    /// How its rows were set, by kernel and by what their epsilons are called.
    pub rows: BTreeMap<[String; 2], RowSettings>,
    /// The cases, by class of finding.
    pub cases: BTreeMap<Key, LockedCases>,
    /// Quantiles of the errors of right hits, of a sample; files of before 0.2 have none.
    pub(super) errors: LockedErrors,
}

/// The settings of a row.
#[derive(Clone, Debug, PartialEq)]
pub struct RowSettings {
    /// As `--epsilon` takes them.
    pub epsilons: String,
    /// The contract in words, its band included.
    pub contract: String,
}

impl RowSettings {
    /// Those of a row.
    pub fn of(row: &RowPart) -> RowSettings {
        let words = row
            .epsilons
            .iter()
            .map(|(name, value)| format!("{name}={value}"));
        RowSettings {
            epsilons: words.collect::<Vec<_>>().join(","),
            contract: row.contract.clone(),
        }
    }
}

impl LockedTarget {
    /// The findings of a run.
    pub fn of(result: &ResultPart) -> LockedTarget {
        let rows = result.plan.rows.iter();
        let cases = disagreements(result).into_iter().map(|found| {
            let (count, of, digest) = (found.rate.count, found.rate.of, found.digest.to_owned());
            (found.key, LockedCases { count, of, digest })
        });
        LockedTarget {
            rows: rows
                .map(|row| ([row.kernel.clone(), row.set.clone()], RowSettings::of(row)))
                .collect(),
            cases: cases.collect(),
            errors: errors_of(result),
        }
    }

    /// Takes a line; whether there was one of the same. An error says what was expected.
    fn take(&mut self, line: &str) -> Result<bool, String> {
        let words: Vec<String> = line.split('\t').map(str::to_owned).collect();
        let number = |text: &str| {
            text.parse::<u64>()
                .map_err(|_| format!("a number, not '{text}'"))
        };
        let words = match <[String; 4]>::try_from(words) {
            Ok([kernel, set, epsilons, contract]) => {
                let settings = RowSettings { epsilons, contract };
                return Ok(self.rows.insert([kernel, set], settings).is_some());
            }
            Err(words) => words,
        };
        // Until 0.1.0 a line of six words had how many groups were judged.
        if words.len() == 6 && words[0] != ERRORS {
            return Ok(false);
        }
        let words = match <[String; 8]>::try_from(words) {
            Ok([word, kernel, set, scalar, value, hits, half, most]) if word == ERRORS => {
                let error = |text: &str| {
                    text.parse::<f64>()
                        .map_err(|_| format!("an error in ulps, not '{text}'"))
                };
                let quantiles = [error(&half)?, error(&most)?];
                let errors = HitErrors {
                    hits: number(&hits)?,
                    quantiles,
                };
                return Ok(self
                    .errors
                    .insert([kernel, set, scalar, value], errors)
                    .is_some());
            }
            Ok(words) => words.to_vec(),
            Err(words) => words,
        };
        let Ok(
            [
                kernel,
                set,
                scalar,
                family,
                class,
                finding,
                count,
                of,
                digest,
            ],
        ) = <[String; 9]>::try_from(words)
        else {
            let shape = "9 words between tabs: kernel, epsilons, scalar, family, class, finding, count, of, digest; or 4 \
                         of a row: kernel, name, epsilons, contract";
            return Err(shape.to_owned());
        };
        let (count, of) = (number(&count)?, number(&of)?);
        if count == 0 || of < count {
            return Err(format!("a count from 1 to {of}, not {count}"));
        }
        Digest::try_from(digest.clone()).map_err(|_| "the digest of a set of cases".to_owned())?;
        let finding = FindingKind::named(&finding)
            .ok_or_else(|| format!("a kind of finding, not '{finding}'"))?;
        let scalar = ScalarName::named(&scalar)
            .ok_or_else(|| format!("a scalar, f32 or f64, not '{scalar}'"))?;
        let class = class.parse::<FindingClass>()?;
        let key = Key {
            kernel,
            set,
            scalar,
            family,
            class,
            finding,
        };
        Ok(self
            .cases
            .insert(key, LockedCases { count, of, digest })
            .is_some())
    }
}

/// The cases of one class that show a finding.
#[derive(Clone, Debug, PartialEq)]
pub struct LockedCases {
    /// How many.
    pub count: u64,
    /// The number of cases among which they were found.
    pub of: u64,
    /// The digest of the set of them.
    pub digest: String,
}

impl Lock {
    /// Reads a lock file; `file` is its name in errors.
    pub fn read(text: &str, file: &str) -> Result<Lock, InputError> {
        let mut lock = Lock::default();
        let mut section = None;
        if !text.is_empty() && !text.ends_with('\n') {
            let message = format!("the last line is cut off; {WRITER}");
            return Err(InputError::at(file, text.lines().count(), message));
        }
        for (number, line) in (1..).zip(text.lines()) {
            let wrong = |expected: String| {
                InputError::at(file, number, format!("expected {expected}; {WRITER}"))
            };
            if line.is_empty() || line.starts_with('#') {
                continue;
            }
            if lock.cases.is_empty() {
                let cases = line
                    .strip_prefix(SCHEMA)
                    .and_then(|rest| rest.strip_prefix(" cases "));
                cases
                    .ok_or_else(|| wrong(format!("'{SCHEMA} cases HASH'")))?
                    .clone_into(&mut lock.cases);
            } else if let Some(target) = line
                .strip_prefix('[')
                .and_then(|line| line.strip_suffix(']'))
            {
                section = Some(lock.targets.entry(target.to_owned()).or_default());
            } else {
                let section = section
                    .as_mut()
                    .ok_or_else(|| wrong("a target, as [x86_64-linux]".to_owned()))?;
                if section.take(line).map_err(wrong)? {
                    return Err(wrong(
                        "each row, and each class of a finding, once".to_owned(),
                    ));
                }
            }
        }
        Ok(lock)
    }

    /// By finding on a family: the count of the target that has the most.
    pub fn most(&self) -> BTreeMap<Key, u64> {
        let mut most: BTreeMap<Key, u64> = BTreeMap::new();
        for target in self.targets.values() {
            let mut sums: BTreeMap<Key, u64> = BTreeMap::new();
            for (key, cases) in &target.cases {
                let sum = sums.entry(key.of_all_classes()).or_default();
                *sum = sum.saturating_add(cases.count);
            }
            for (key, sum) in sums {
                let most = most.entry(key).or_default();
                *most = sum.max(*most);
            }
        }
        most
    }
}

impl fmt::Display for Lock {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(
            f,
            "# The rows that ran, and the cases behind the counts, one line a class. {WRITER}."
        )?;
        writeln!(f, "{SCHEMA} cases {}", self.cases)?;
        for (target, entries) in &self.targets {
            writeln!(f, "[{target}]")?;
            for ([kernel, set], RowSettings { epsilons, contract }) in &entries.rows {
                writeln!(f, "{kernel}\t{set}\t{epsilons}\t{contract}")?;
            }
            for ([kernel, set, scalar, value], errors) in &entries.errors {
                let HitErrors {
                    hits,
                    quantiles: [half, most],
                } = errors;
                writeln!(
                    f,
                    "{ERRORS}\t{kernel}\t{set}\t{scalar}\t{value}\t{hits}\t{half}\t{most}"
                )?;
            }
            for (
                Key {
                    kernel,
                    set,
                    scalar,
                    family,
                    class,
                    finding,
                },
                cases,
            ) in &entries.cases
            {
                let LockedCases { count, of, digest } = cases;
                writeln!(
                    f,
                    "{kernel}\t{set}\t{scalar}\t{family}\t{class}\t{finding}\t{count}\t{of}\t{digest}"
                )?;
            }
        }
        Ok(())
    }
}

impl Expectations {
    /// Checks that the reviewed counts are those of the lock file: that of the target with the most.
    ///
    /// Errors: file and line of a count that differs, and what to do.
    pub fn agree(&self, file: &str) -> Result<(), InputError> {
        let Some(lock) = &self.lock else {
            return Ok(());
        };
        let advice = "put back what was there, or let `hairline check --bless` (in a test HAIRLINE_BLESS=1) write \
                      both files";
        if lock.cases != self.cases {
            let found = match lock.cases.as_str() {
                "" => "names no cases".to_owned(),
                cases => format!("has cases {cases}"),
            };
            let message = format!("cases {}, but {file}.lock {found}: {advice}", self.cases);
            return Err(InputError::of(file, message));
        }
        let most = lock.most();
        let keys = most
            .keys()
            .chain(self.entries.keys().filter(|key| !most.contains_key(key)));
        for key in keys {
            let locked = most.get(key).copied().unwrap_or(0);
            let entry = self.entries.get(key);
            let count = match entry.map(|entry| &entry.amount) {
                Some(Amount::Rate(_)) => continue,
                Some(Amount::Count { count, .. }) => *count,
                None => 0,
            };
            if count != locked {
                let Key {
                    scalar,
                    family,
                    finding,
                    ..
                } = key;
                let message = format!(
                    "{} {scalar} {family} {finding}: {count} here, {locked} in {file}.lock: {advice}",
                    key.row()
                );
                let line = entry.map(|entry| entry.line);
                return Err(InputError {
                    line,
                    ..InputError::of(file, message)
                });
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests;
