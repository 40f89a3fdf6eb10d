//! `hairline boxes check`: slab tests against their known wrong answers, which a file holds.

use super::audit::RunArguments;
use super::record::BoxesResult;
use crate::audit::Trials;
use crate::cli::exit::{Failure, Status};
use crate::cli::input::read_text;
use crate::cli::output::{check_place, write_result};
use crate::expect::difference_of;
use crate::files::InputError;
use crate::named_file::SizeLimit;
use crate::record::{Comparable, NamedRate, Rate, Study, number_of};
use crate::report::Format;
use clap::Args;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::path::Path;

/// Which slab tests, on which boxes, and which file holds what is known.
#[derive(Args)]
pub struct CheckArguments {
    #[command(flatten)]
    run: RunArguments,

    /// The file of the known wrong answers
    #[arg(long, value_name = "FILE", default_value = "hairline-boxes.toml")]
    known: String,

    /// Write that file: this run's wrong answers are known from now on
    #[arg(long)]
    bless: bool,

    /// Also if a test got worse
    #[arg(long, requires = "bless")]
    accept_worse: bool,
}

/// The schema of the file.
const SCHEMA: &str = "hairline-boxes/1";

/// The file: a count for each wrong answer of a test on a source in a scalar.
#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields)]
struct KnownFile {
    schema: String,
    cases: String,
    #[serde(default)]
    known: BTreeMap<String, u64>,
}

/// Runs the command.
pub fn run(arguments: &CheckArguments) -> Result<Status, Failure> {
    let file = arguments.known.as_str();
    let outputs = arguments.run.output.pairs(Format::OF_PAGE)?;
    let is_new = !Path::new(file).exists();
    let known = match is_new && arguments.bless {
        true => KnownFile::default(),
        false => KnownFile::open(file)?,
    };
    if arguments.bless {
        check_place(file)?;
    }
    let result = arguments.run.record()?.result;
    let cases = result.cases();
    if known.cases != cases && !arguments.bless {
        let message = format!(
            "its counts are of {} cases, and this run's of {cases}: -n and --seed say how many of which",
            known.cases
        );
        return Err(InputError::of(file, message).into());
    }
    let now = HeldResult {
        result,
        known: None,
    };
    let before = HeldResult {
        result: now.result.clone(),
        known: (!is_new).then_some(known.known),
    };
    let compared = difference_of(&before, &now);
    let is_worse = compared.is_worse();
    arguments.run.output.write(outputs, &compared)?;
    if arguments.bless {
        let outside = before.outside();
        if 0 < outside {
            let counts = number_of(outside, "count", "counts");
            let message = format!(
                "--bless: {file} has {counts} of tests, families or scalars outside this run, which would be lost"
            );
            return Err(Failure::usage(message));
        }
        if is_new || !is_worse || arguments.accept_worse {
            let wrong = now.wrong();
            let text = now.text(&wrong);
            write_result(file, |out| out.write_all(text.as_bytes()))?;
            if !arguments.run.output.quiet {
                let counts = wrong.len();
                eprintln!("{file}: {counts} counts of wrong answers are known");
            }
            return Ok(Status::Success);
        }
        eprintln!("hairline: {file} stays as it is: --accept-worse writes it all the same");
    }
    Ok(match (is_worse, compared.differences.is_empty()) {
        (true, _) => Status::Disagreements,
        (false, true) => Status::Success,
        (false, false) => Status::Stale,
    })
}

impl KnownFile {
    fn open(file: &str) -> Result<KnownFile, Failure> {
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
        if known.schema != SCHEMA {
            let message = format!("schema '{}', expected '{SCHEMA}'", known.schema);
            return Err(InputError::of(file, message).into());
        }
        Ok(known)
    }
}

/// A run as it is, or with the counts of a file in place of its own: what the file does not name is known not to occur.
#[derive(Serialize, Deserialize)]
struct HeldResult {
    result: BoxesResult,
    known: Option<BTreeMap<String, u64>>,
}

impl Comparable for HeldResult {
    const STUDY: Study = Study::Boxes;

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
}

impl HeldResult {
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
    fn text(&self, wrong: &[NamedRate]) -> String {
        let mut text = format!(
            "# Known wrong answers of slab tests: `hairline boxes check` fails if there are others. --bless writes them.\n\
             schema = \"{SCHEMA}\"\ncases = \"{}\"\n\n[known]\n",
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
