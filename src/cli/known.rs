//! Known wrong answers, count by count, in a file: what `--known` and `--bless` do for every study that can be compared.

use super::exit::{Failure, Status};
use super::input::read_text;
use super::output::{OutputArguments, check_place, write_result};
use crate::audit::Trials;
use crate::command::named_file::SizeLimit;
use crate::expect::{RecordComparison, difference_of};
use crate::files::InputError;
use crate::record::{Comparable, NamedRate, NamedValue, Rate, Study, number_of};
use crate::report::Format;
use clap::Args;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::path::Path;

/// The flags that write the file.
#[derive(Args)]
pub struct Blessing {
    /// Write the file of known wrong answers: this run's are known from now on
    #[arg(long)]
    bless: bool,

    /// Also if something got worse
    #[arg(long, requires = "bless")]
    accept_worse: bool,
}

impl Blessing {
    /// An error if a file is to be written and none is named.
    pub fn needs(&self, known: Option<&str>) -> Result<(), Failure> {
        match self.bless && known.is_none() {
            true => Err(Failure::usage("--bless: which file? Give --known FILE too")),
            false => Ok(()),
        }
    }
}

/// The kind of a file of known wrong answers.
pub struct KnownSubject {
    /// Its schema.
    pub schema: &'static str,
    /// Its first line, for who opens it.
    pub about: &'static str,
    /// The things that a count in it may be of and a run has not.
    pub parts: &'static str,
    /// True of a name that some run may have a count of.
    pub is_name: fn(&str) -> bool,
    /// The flags that choose the cases.
    pub choice: &'static str,
}

/// The file: a count for each wrong answer.
#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields)]
struct KnownFile {
    schema: String,
    cases: String,
    #[serde(default)]
    known: BTreeMap<String, u64>,
}

/// The counts of a file, to which a run is held.
pub struct KnownCounts<'a> {
    subject: &'static KnownSubject,
    path: &'a str,
    blessing: &'a Blessing,
    /// None if the file is yet to be written.
    file: Option<KnownFile>,
}

impl<'a> KnownCounts<'a> {
    /// Opens a file, before anything runs. It need not be there if it is to be written.
    pub fn open(
        subject: &'static KnownSubject,
        path: &'a str,
        blessing: &'a Blessing,
    ) -> Result<KnownCounts<'a>, Failure> {
        let is_new = blessing.bless && !Path::new(path).exists();
        let file = match is_new {
            true => None,
            false => Some(KnownFile::open(path, subject)?),
        };
        if blessing.bless {
            check_place(path)?;
        }
        Ok(KnownCounts {
            subject,
            path,
            blessing,
            file,
        })
    }

    /// Compares a run with the file, writes how in each format, and the file if it is to be written.
    pub fn compare<R: Comparable + Clone>(
        self,
        result: R,
        output: &OutputArguments,
        outputs: Vec<(&Format<RecordComparison>, &str)>,
    ) -> Result<Status, Failure> {
        let KnownCounts { path, blessing, .. } = self;
        let cases = result.cases();
        if let Some(file) = self.file.as_ref().filter(|_| !blessing.bless)
            && file.cases != cases
        {
            let message = format!(
                "its counts are of other cases ({}) than this run's ({cases}): {}",
                file.cases, self.subject.choice
            );
            return Err(InputError::of(path, message).into());
        }
        let now = HeldResult {
            result,
            known: None,
        };
        let is_new = self.file.is_none();
        let before = HeldResult {
            result: now.result.clone(),
            known: self.file.map(|file| file.known),
        };
        let compared = difference_of(&before, &now);
        let is_worse = compared.is_worse();
        output.write(outputs, &compared)?;
        if blessing.bless {
            let outside = before.outside();
            if 0 < outside {
                let counts = number_of(outside, "count", "counts");
                let message = format!(
                    "--bless: {path} has {counts} of {} outside this run, which would be lost",
                    self.subject.parts
                );
                return Err(Failure::usage(message));
            }
            if is_new || !is_worse || blessing.accept_worse {
                let wrong = now.wrong();
                let text = now.text(self.subject, &wrong);
                write_result(path, |out| out.write_all(text.as_bytes()))?;
                if !output.quiet {
                    let kinds = number_of(wrong.len() as u64, "kind", "kinds");
                    let answers: u64 = wrong.iter().map(|it| it.rate.count).sum();
                    let answers = number_of(answers, "wrong answer is", "wrong answers are");
                    eprintln!("{path}: written; {answers} known, of {kinds}");
                }
                return Ok(Status::Success);
            }
            eprintln!("hairline: {path} stays as it is: --accept-worse writes it all the same");
        }
        Ok(match (is_worse, compared.differences.is_empty()) {
            (true, _) => Status::Disagreements,
            (false, true) => Status::Success,
            (false, false) => Status::Stale,
        })
    }
}

impl KnownFile {
    fn open(file: &str, subject: &KnownSubject) -> Result<KnownFile, Failure> {
        let text = match read_text(file, SizeLimit::EXPECTATIONS) {
            Err(Failure::Message(status, message)) if !Path::new(file).exists() => {
                let message = format!("{message}; with --bless this command writes it");
                return Err(Failure::Message(status, message));
            }
            read => read?,
        };
        let known: KnownFile = toml::from_str(&text).map_err(|error| {
            let start = error.span().map_or(0, |span| span.start);
            let line = text[..start].matches('\n').count() + 1;
            InputError::at(file, line, error.message().replace('\n', "; "))
        })?;
        if known.schema != subject.schema {
            let message = format!("schema '{}', expected '{}'", known.schema, subject.schema);
            return Err(InputError::of(file, message).into());
        }
        if let Some(name) = known.known.keys().find(|name| !(subject.is_name)(name)) {
            let message = format!("a count of '{name}': there are no such {}", subject.parts);
            return Err(InputError::of(file, message).into());
        }
        Ok(known)
    }
}

/// A run as it is, or with the counts of a file in place of its own: what the file does not name is known not to occur.
#[derive(Serialize, Deserialize)]
#[serde(bound = "R: Comparable")]
struct HeldResult<R> {
    result: R,
    known: Option<BTreeMap<String, u64>>,
}

impl<R: Comparable> Comparable for HeldResult<R> {
    const STUDY: Study = R::STUDY;

    fn question(&self) -> String {
        self.result.question()
    }

    fn cases(&self) -> String {
        self.result.cases()
    }

    fn counted(&self) -> Vec<NamedRate> {
        let mut counted = self.result.counted();
        let Some(known) = &self.known else {
            return counted;
        };
        for named in &mut counted {
            let of = named.rate.of;
            let count = known.get(&named.what).copied().unwrap_or(0);
            // The interval of a rate takes time.
            if count != named.rate.count {
                named.rate = Rate::new(Trials::independent(count, of), count <= of);
            }
        }
        counted
    }

    fn chosen(&self) -> Vec<NamedValue> {
        self.result.chosen()
    }
}

impl<R: Comparable> HeldResult<R> {
    /// How many names of the file are not in the run.
    fn outside(&self) -> u64 {
        let counted = self.result.counted();
        let is_run = |name: &String| counted.iter().any(|named| named.what == *name);
        let known = self.known.iter().flat_map(BTreeMap::keys);
        known.filter(|name| !is_run(name)).count() as u64
    }

    /// The counts that are above 0.
    fn wrong(&self) -> Vec<NamedRate> {
        let mut counted = self.counted();
        counted.retain(|named| 0 < named.rate.count);
        counted
    }

    /// The file that holds these counts.
    fn text(&self, subject: &KnownSubject, wrong: &[NamedRate]) -> String {
        let mut text = format!(
            "# {}\nschema = \"{}\"\ncases = \"{}\"\n\n[known]\n",
            subject.about,
            subject.schema,
            self.cases()
        );
        for NamedRate { what, rate, .. } in wrong {
            // TOML reads a string of JSON.
            let name = serde_json::Value::from(what.as_str());
            text += &format!("{name} = {}\n", rate.count);
        }
        text
    }
}
