//! `hairline check`: a run held to its expectations.

use super::exit::{Failure, Status};
use super::github;
use super::input::{read_record, read_text};
use super::output::write_result;
use super::reporting::{RunArguments, self_check};
use super::settings::{self, Given};
use crate::audit::Plan;
use crate::corpus::InputError;
use crate::expect::{self, Expectations};
use crate::report::{Conformance, PartialPart, Record, Verdict};
use clap::parser::ValueSource;
use clap::{Args, CommandFactory, FromArgMatches, Parser};
use std::ffi::OsString;
use std::path::Path;

/// Where expectations are looked for if nothing else is said.
const DEFAULT_FILE: &str = "hairline.expectations.toml";

/// What to run, what to expect, and how to report.
#[derive(Args)]
pub struct CheckArguments {
    /// The settings [default: hairline.toml, if there is one]
    #[arg(long, value_name = "FILE")]
    config: Option<String>,

    /// The known disagreements; without the file nothing is expected
    #[arg(long, value_name = "FILE", default_value = DEFAULT_FILE)]
    expectations: String,

    /// Write what was found as what is expected from now on
    #[arg(long)]
    bless: bool,

    /// Judge a stored record (of `audit`, `check` or `merge`) instead of running
    #[arg(long, value_name = "FILE")]
    record: Option<String>,

    #[command(flatten)]
    run: RunArguments,

    /// How many findings of each class to attribute to a cause (see `audit`); 0 for none
    #[arg(long, default_value_t = 0, value_name = "N")]
    attribute: usize,
}

/// The arguments alone, to be read again under the settings.
#[derive(Parser)]
#[command(name = "hairline check")]
struct Alone {
    #[command(flatten)]
    arguments: CheckArguments,
}

/// The words of the command line that the text of a `hairline.toml` stands for; `file` is its name in
/// errors, from whose folder its paths are. Their values are parsed as the command line's, and files and
/// names in them not looked for.
///
/// Errors: file and line of what is no setting, or what is wrong with a value.
pub fn read_settings(text: &str, file: &str) -> Result<Vec<String>, String> {
    let given = settings::from_file(text, file)
        .map_err(|failure| failure.message().unwrap_or_default().to_owned())?;
    let words: Vec<String> = given.into_iter().flat_map(|given| given.words).collect();
    let program = std::iter::once("check");
    match Alone::try_parse_from(program.chain(words.iter().map(String::as_str))) {
        Ok(_) => Ok(words),
        Err(error) => Err(format!("{file}: {error}")),
    }
}

/// Runs the command on the words after `check`.
pub fn run(words: &[OsString]) -> Result<Status, Failure> {
    let (arguments, given) = with_settings(words)?;
    let outputs = arguments.run.report.outputs()?;
    let mut record = match &arguments.record {
        Some(file) => read_record(file)?,
        None => {
            let plan = arguments.plan().map_err(|failure| blame(failure, &given))?;
            arguments.run.execute(&plan, outputs.illustrate())?
        }
    };
    self_check(&record)?;
    if let Some(partial) = &record.result.partial {
        return part_only(&arguments, partial, || outputs.write(&record));
    }
    let file = &arguments.expectations;
    let expected = read_expectations(file, &given, arguments.bless)?;
    let known_file = expected.is_some().then_some(file.as_str());
    let mut expected = expected.unwrap_or_default();
    let mut conformance = expect::compare(&record.result, &expected, known_file);
    if arguments.bless {
        expected = blessed(&record, &expected, &conformance, file)?;
        conformance = expect::compare(&record.result, &expected, Some(file));
        if !arguments.run.report.quiet {
            eprintln!("{file}: {} known disagreements", expected.entries.len());
        }
    }
    record.conformance = Some(conformance);
    outputs.write(&record)?;
    github::announce(&record)?;
    Ok(match record.conformance.map(|conformance| conformance.verdict) {
        Some(Verdict::Disagreements) => Status::Disagreements,
        Some(Verdict::Stale) => Status::Stale,
        _ => Status::Success,
    })
}

/// A part of a run is written for `merge`, and says nothing about conformance.
fn part_only(
    arguments: &CheckArguments,
    partial: &PartialPart,
    write: impl FnOnce() -> Result<(), Failure>,
) -> Result<Status, Failure> {
    if arguments.bless {
        return Err(Failure::usage(
            "--bless: a part of a run is not what is expected of the whole",
        ));
    }
    if let Some(file) = &arguments.record {
        let (present, of) = (partial.present.len(), partial.of);
        let message = format!("holds {present} of {of} shards, which says nothing about the whole");
        return Err(InputError::of(file, message).into());
    }
    write().map(|()| Status::Success)
}

/// Reads the words, then again with the settings that they leave open.
fn with_settings(words: &[OsString]) -> Result<(CheckArguments, Vec<Given>), Failure> {
    let named = |words: &[OsString]| {
        std::iter::once(OsString::from("hairline check")).chain(words.to_vec()).collect::<Vec<_>>()
    };
    let matches = Alone::command().try_get_matches_from(named(words)).map_err(refused)?;
    let alone = Alone::from_arg_matches(&matches).map_err(refused)?.arguments;
    let file = match &alone.config {
        Some(file) => Some(file.as_str()),
        None => Path::new(settings::FILE).exists().then_some(settings::FILE),
    };
    let from_file = match file {
        Some(file) => settings::from_file(&read_text(file)?, file)?,
        None => Vec::new(),
    };
    let from_environment = settings::from_environment(|name| std::env::var(name).ok())?;
    let on_command_line = |key: &str| {
        let id = key.replace('-', "_");
        matches.value_source(&id) == Some(ValueSource::CommandLine)
    };
    let given = settings::layered([from_environment, from_file], on_command_line);
    let mut all = words.to_vec();
    for given in &given {
        // One by one, so that an error has its place.
        let words: Vec<OsString> = given.words.iter().map(OsString::from).collect();
        if let Err(error) = Alone::try_parse_from(named(&words)) {
            let text = error.to_string();
            let line = text.lines().next().unwrap_or_default();
            let line = line.strip_prefix("error: ").unwrap_or(line);
            return Err(Failure::usage(format!("{}: {line}", given.place)));
        }
        all.extend(words);
    }
    let arguments = Alone::try_parse_from(named(&all)).map_err(refused)?.arguments;
    Ok((arguments, given))
}

/// What the argument parser says.
fn refused(error: clap::Error) -> Failure {
    let text = error.to_string();
    Failure::usage(text.trim_end().strip_prefix("error: ").unwrap_or(&text).to_owned())
}

/// Says which setting a plan fails for: the one that fails alone in the same way.
fn blame(failure: Failure, given: &[Given]) -> Failure {
    let Failure::Message(status, message) = &failure else { return failure };
    let kernels = given.iter().find(|given| given.key == "kernel");
    for setting in given {
        let context = kernels.filter(|_| setting.key.starts_with("epsilon"));
        let words = context.into_iter().chain([setting]).flat_map(|given| &given.words);
        let words = std::iter::once("hairline check").chain(words.map(String::as_str));
        let Ok(alone) = Alone::try_parse_from(words) else { continue };
        let same = alone.arguments.plan().is_err_and(|error| error.message() == Some(message));
        if same {
            return Failure::Message(*status, format!("{}: {message}", setting.place));
        }
    }
    failure
}

/// The expectations; none if the file is not there, unless the command line names it to be read.
fn read_expectations(
    file: &str,
    given: &[Given],
    blessing: bool,
) -> Result<Option<Expectations>, Failure> {
    let from_command_line =
        file != DEFAULT_FILE && given.iter().all(|given| given.key != "expectations");
    if !Path::new(file).exists() && (blessing || !from_command_line) {
        return Ok(None);
    }
    Ok(Some(expect::read(&read_text(file)?, file)?))
}

/// Writes the expectations that the run meets, and reads them again.
fn blessed(
    record: &Record,
    old: &Expectations,
    conformance: &Conformance,
    file: &str,
) -> Result<Expectations, Failure> {
    let text = expect::bless(&record.result, old, conformance).map_err(|error| {
        Failure::usage(format!(
            "--bless: {file} has {} expectations of kernels, scalars or families outside this plan, \
             which would be lost: run the whole plan, or remove them first",
            error.outside_the_plan
        ))
    })?;
    let expectations = expect::read(&text, file)?;
    write_result(file, |out| out.write_all(text.as_bytes()))?;
    Ok(expectations)
}

impl CheckArguments {
    fn plan(&self) -> Result<Plan, Failure> {
        self.run.plan(self.attribute)
    }
}
