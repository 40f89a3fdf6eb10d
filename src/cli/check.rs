//! `hairline check`: a run held to its expectations.

mod diagnosis;

use super::again;
use super::exit::{Failure, Status};
use super::flags::JUDGING;
use super::github;
use super::input::{read_record, read_text};
use super::output::{write_result, write_results};
use super::plugins;
use super::prove::demand;
use super::reporting::{MEASURED, Outputs, RunArguments, self_check};
use super::settings::{self, Given};
use crate::audit::Plan;
use crate::command::named_file::SizeLimit;
use crate::conformance::locked;
use crate::expect::{self, BlessError, Expectations};
use crate::files::InputError;
use crate::record::{ComparisonVerdict, Conformance, Method, PartialPart, Record, number_of};
use clap::parser::ValueSource;
use clap::{ArgMatches, Args, FromArgMatches, Subcommand};
use diagnosis::{computed_formulas, short_case, take_over};
use std::path::Path;

/// The JSON Schema of records. A test derives it from the types; the program only prints it.
const JSON_SCHEMA: &str = include_str!("../../docs/schema/record.json");

/// Where expectations are looked for by default.
const DEFAULT_FILE: &str = "hairline.expectations.toml";

/// The flags of `check`: the run, the expectations, and how it is reported.
#[derive(Args)]
#[command(args_conflicts_with_subcommands = true)]
pub struct CheckArguments {
    #[command(subcommand)]
    command: Option<CheckCommand>,

    #[command(flatten)]
    flags: CheckFlags,
}

/// The flags, each of which may be a setting.
#[derive(Args)]
struct CheckFlags {
    /// The settings [default: hairline.toml, if there is one]
    #[arg(long, value_name = "FILE")]
    config: Option<String>,

    /// The known disagreements, with their cases in FILE.lock; without this file none is known
    #[arg(long, value_name = "FILE", default_value = DEFAULT_FILE)]
    expectations: String,

    /// Write what this run finds as the known disagreements, unless something got worse
    #[arg(long)]
    bless: bool,

    /// Write it even if something got worse
    #[arg(long, requires = "bless")]
    accept_worse: bool,

    /// Judge a stored record (of `audit`, `check` or `merge`) instead of running
    #[arg(long, value_name = "FILE")]
    record: Option<String>,

    #[command(flatten)]
    run: RunArguments,

    /// Bounds that must stay proved, as KERNEL/SCALAR/GATE=UNITS or KERNEL/SCALAR/watertight=true (see
    /// `prove`)
    #[arg(long, value_delimiter = ',', value_name = "DEMAND,...", help_heading = JUDGING)]
    proved: Vec<String>,

    /// How many findings of each class to attribute to a cause (see `audit`); 0 for none
    #[arg(long, default_value_t = 0, value_name = "N", help_heading = JUDGING)]
    attribute: usize,
}

/// The commands that show the form of the files which `check` reads and writes.
#[derive(Subcommand)]
pub enum CheckCommand {
    /// Print a commented hairline.toml with every setting at its default
    Config,
    /// Print the JSON Schema of the record that `--format json` writes
    Schema,
}

/// The flags of `check` on their own, to read settings as words.
fn words_command() -> clap::Command {
    CheckFlags::augment_args_for_update(clap::Command::new("check").no_binary_name(true))
}

/// The flags that words of settings give, without the defaults of all other flags.
fn parsed(words: &[String]) -> Result<ArgMatches, String> {
    let mut matches = words_command()
        .try_get_matches_from(words)
        .map_err(|error| {
            let text = error.to_string();
            let line = text.lines().next().unwrap_or_default();
            line.strip_prefix("error: ").unwrap_or(line).to_owned()
        })?;
    let ids: Vec<String> = matches.ids().map(ToString::to_string).collect();
    for id in ids {
        if matches.value_source(&id) != Some(ValueSource::CommandLine) {
            let _ = matches.try_clear_id(&id);
        }
    }
    Ok(matches)
}

/// The words of the command line that the text of a `hairline.toml` stands for; `file` is its name in
/// errors, and its folder is where relative paths begin. Values are parsed as on the command line; files
/// and names in them are not looked up.
///
/// Errors: file and line of an unknown setting or of a wrong value.
pub fn read_settings(text: &str, file: &str) -> Result<Vec<String>, String> {
    let given = settings::from_file(text, file)
        .map_err(|failure| failure.message().unwrap_or_default().to_owned())?;
    let words = |given: Given| match parsed(&given.words) {
        Ok(_) => Ok(given.words),
        Err(message) => Err(format!("{}: {message}", given.place)),
    };
    Ok(given
        .into_iter()
        .map(words)
        .collect::<Result<Vec<_>, _>>()?
        .concat())
}

/// Runs the command; `matches` says which flags the command line has.
pub fn run(arguments: CheckArguments, matches: Option<&ArgMatches>) -> Result<Status, Failure> {
    let CheckArguments {
        command,
        flags: mut arguments,
    } = arguments;
    if let Some(command) = command {
        let text = match command {
            CheckCommand::Config => settings::default_file(&words_command()),
            CheckCommand::Schema => JSON_SCHEMA.to_owned(),
        };
        write_result("-", |out| out.write_all(text.as_bytes()))?;
        return Ok(Status::Success);
    }
    let given = arguments.settings(matches)?;
    for given in &given {
        arguments.set(given)?;
    }
    if arguments.run.report.output.quiet {
        plugins::be_quiet();
    }
    let is_default_file = arguments.expectations == DEFAULT_FILE;
    if let (true, Some(config)) = (is_default_file, &arguments.config) {
        let beside = Path::new(config).with_file_name(DEFAULT_FILE);
        arguments.expectations = beside.display().to_string();
    }
    let outputs = arguments.run.report.outputs()?;
    outputs.told(checked(&arguments, &given, is_default_file, &outputs))
}

fn checked(
    arguments: &CheckFlags,
    given: &[Given],
    is_default_file: bool,
    outputs: &Outputs<'_>,
) -> Result<Status, Failure> {
    let plan = match arguments.record {
        Some(_) => None,
        None => {
            let plan = arguments.run.plan(arguments.attribute);
            Some(Plan {
                measured: MEASURED,
                ..plan.map_err(|failure| blame(failure, given))?
            })
        }
    };
    let rows = plan.as_ref().map_or(&[][..], |plan| &plan.rows);
    let unproved = demand::unproved(&arguments.proved, rows)?;
    let mut record = match (&arguments.record, &plan) {
        (Some(file), _) => read_record(file)?,
        (None, Some(plan)) => arguments.run.execute(plan, outputs.illustrate())?,
        (None, None) => unreachable!("without a record there is a plan"),
    };
    self_check(&record)?;
    if let Some(partial) = &record.result.partial {
        part_only(arguments, partial)?;
        return outputs.write(&record).map(|()| Status::Success);
    }
    let file = &arguments.expectations;
    let is_demanded = !is_default_file && given.iter().all(|given| given.key != "expectations");
    let may_be_missing = arguments.bless || !is_demanded;
    let lock = arguments.bless.then(|| locked(file));
    let expected = expect::open(
        file,
        may_be_missing,
        &record,
        arguments.bless,
        read_expected,
    )?;
    let known_file = expected.is_some().then_some(file.as_str());
    let mut expected = expected.unwrap_or_default();
    let (result, target) = (&record.result, record.provenance.target.as_str());
    let mut conformance = again::compare(plan.as_ref(), result, target, &expected, known_file);
    if known_file.is_none() && !conformance.unexpected.is_empty() {
        let has_settings = arguments.config.is_some() || Path::new(settings::FILE).exists();
        conformance.note = Some(first_steps(
            file,
            conformance.unexpected.len(),
            has_settings,
        ));
    }
    if arguments.bless {
        let change = conformance.change;
        if !conformance.unsteady.is_empty() {
            eprintln!(
                "hairline: {file} is not written: answers that differ from run to run can be no known disagreements"
            );
        } else if known_file.is_some() && conformance.is_worse() && !arguments.accept_worse {
            let instead = match conformance.method {
                Method::CaseByCase => "",
                Method::Intervals => {
                    " (it is of another plan: --expectations NAME.toml keeps both)"
                }
            };
            eprintln!(
                "hairline: {file} stays as it is: {change}; --accept-worse writes it all the same{instead}"
            );
        } else {
            expected = blessed(&record, &expected, &conformance, file)?;
            conformance = expect::compare(result, target, &expected, Some(file));
            if !arguments.run.report.output.quiet {
                let was = known_file.map_or(String::new(), |_| format!(" ({change})"));
                let (known, findings) = (conformance.known.len(), conformance.findings());
                eprintln!("{file}: {known} known disagreements{was}{findings}");
            }
        }
    }
    drop(lock);
    match (&plan, record.conformance.take()) {
        (Some(plan), _) => {
            conformance.computes = computed_formulas(plan, &conformance);
            conformance.short_case = short_case(plan, &conformance);
        }
        (None, Some(before)) => take_over(before, &mut conformance),
        (None, None) => {}
    }
    conformance.demand(unproved);
    record.conformance = Some(conformance);
    outputs.write(&record)?;
    github::announce(&record)?;
    Ok(
        match record.conformance.map(|conformance| conformance.verdict) {
            Some(ComparisonVerdict::Disagreements) => Status::Disagreements,
            Some(ComparisonVerdict::Unsteady) => Status::BadInput,
            Some(ComparisonVerdict::Stale) => Status::Stale,
            _ => Status::Success,
        },
    )
}

/// The text of a file of expectations, or of its lock.
fn read_expected(name: &str) -> Result<String, Failure> {
    match read_text(name, SizeLimit::EXPECTATIONS) {
        Err(Failure::Message(status, message)) if !Path::new(name).exists() => {
            let message = format!("{message}; with --bless this command writes it");
            Err(Failure::Message(status, message))
        }
        read => read,
    }
}

/// The advice as long as there is no file of expectations.
fn first_steps(file: &str, disagreements: usize, has_settings: bool) -> String {
    let settings = match has_settings {
        true => String::new(),
        false => {
            format!(
                "there is no {} here, so flags alone say which kernels ran; ",
                settings::FILE
            )
        }
    };
    format!(
        "{settings}the same command with --bless takes the {} below as known: it writes how many are wrong in each family into {file}, \
         for people to review, and the cases into {}; commit both",
        number_of(disagreements as u64, "disagreement", "disagreements"),
        expect::lock_of(file)
    )
}

/// A part of a run is written for `merge`, and says nothing about conformance.
fn part_only(arguments: &CheckFlags, partial: &PartialPart) -> Result<(), Failure> {
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
    Ok(())
}

/// Names the setting that a plan fails for: the one that fails alone in the same way.
fn blame(failure: Failure, given: &[Given]) -> Failure {
    let Failure::Message(status, message) = &failure else {
        return failure;
    };
    let kernels = given.iter().find(|given| given.key == "kernel");
    for setting in given {
        let context = kernels.filter(|_| setting.key.starts_with("epsilon"));
        let all = context.into_iter().chain([setting]);
        let Ok(mut alone) = defaults() else { break };
        let same = |failure: Failure| failure.message() == Some(message);
        let is_set = all.into_iter().all(|given| alone.set(given).is_ok());
        if is_set && alone.run.plan(alone.attribute).is_err_and(same) {
            return Failure::Message(*status, format!("{}: {message}", setting.place));
        }
    }
    // It fails beside a flag only.
    let is_named = |given: &&Given| message.starts_with(&format!("--{}: ", given.key));
    if let Some(setting) = given.iter().find(is_named) {
        return Failure::Message(*status, format!("{}: {message}", setting.place));
    }
    failure
}

/// The arguments of `check` on an empty command line.
fn defaults() -> Result<CheckFlags, clap::Error> {
    CheckFlags::from_arg_matches(&words_command().try_get_matches_from([""; 0])?)
}

/// Writes the expectations that the run meets, and their cases.
fn blessed(
    record: &Record,
    old: &Expectations,
    conformance: &Conformance,
    file: &str,
) -> Result<Expectations, Failure> {
    let written =
        expect::blessed(record, old, conformance, file).map_err(|error| match error {
            BlessError::Unread(error) => error.into(),
            BlessError::Outside(count) => Failure::usage(format!(
                "--bless: {file} has {count} expectations of kernels, scalars or families outside this plan, \
                 which would be lost: run the whole plan, or remove them first"
            )),
        })?;
    let texts = written
        .texts
        .iter()
        .map(|(name, text)| (text, name.as_str()))
        .collect();
    write_results(texts, |text, _, out| out.write_all(text.as_bytes()))?;
    if !written.dropped.is_empty() {
        eprintln!(
            "{}: the counts of {} were of other cases, and are gone",
            expect::lock_of(file),
            written.dropped.join(", ")
        );
    }
    Ok(written.expectations)
}

impl CheckFlags {
    /// The settings in the environment and hairline.toml for the flags that the command line leaves out.
    fn settings(&self, matches: Option<&ArgMatches>) -> Result<Vec<Given>, Failure> {
        let default = || Path::new(settings::FILE).exists().then_some(settings::FILE);
        let from_file = match self.config.as_deref().or_else(default) {
            Some(file) => settings::from_file(&read_text(file, SizeLimit::SETTINGS)?, file)?,
            None => Vec::new(),
        };
        let from_environment = settings::from_environment(|name| std::env::var(name).ok())?;
        if !self.run.report.output.quiet {
            let names = std::env::vars_os().filter_map(|(name, _)| name.into_string().ok());
            settings::unknown_variables(names)
                .iter()
                .for_each(|note| eprintln!("{note}"));
        }
        settings::layered([from_environment, from_file], |key| {
            let source = matches.and_then(|matches| matches.value_source(&key.replace('-', "_")));
            source == Some(ValueSource::CommandLine)
        })
    }

    /// Takes over one setting.
    fn set(&mut self, given: &Given) -> Result<(), Failure> {
        let wrong = |message: String| Failure::usage(format!("{}: {message}", given.place));
        let matches = parsed(&given.words).map_err(wrong)?;
        self.update_from_arg_matches(&matches)
            .map_err(|error| wrong(error.to_string()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_default_file_is_read_and_gives_every_setting_its_default() {
        let text = settings::default_file(&words_command());
        assert!(text.contains("\nscalar = [\"f32\", \"f64\"]\n"), "{text}");
        assert!(text.contains("\ncount = 20000\n") && text.contains("\n# band = \"4ulps\"\n"));
        read_settings(&text, "h.toml").unwrap();
        let examples: Vec<&str> = text
            .lines()
            .map(|l| {
                l.strip_prefix("# ")
                    .filter(|l| l.contains(" = "))
                    .unwrap_or(l)
            })
            .collect();
        // Three flags are false, which takes no word.
        let words = read_settings(&examples.join("\n"), "h.toml").unwrap();
        assert_eq!(words.len(), 26, "{words:?}");
    }
}
