//! Floor 6: one file a command. It prints, opens files and reads a clock, as `crates/command` below it does.

#![forbid(unsafe_code)]

mod again;
mod audit;
mod before;
mod boxes;
mod case;
pub(crate) mod check;
mod corpus;
mod diff;
mod epsilon;
mod explain;
mod fuzz;
mod generate;
mod github;
mod help;
mod known;
mod list;
mod map;
mod merge;
mod mesh;
mod misuse;
mod offset;
mod prove;
mod rays;
mod repair;
mod reporting;
mod select;
mod selfcheck;
mod settings;
mod sources;
mod truth;
mod vectors;
mod verify;

pub use plugins::started_by;

use exit::{Failure, Status};
use help::EXAMPLES;

use crate::arith::FloatEnvironment;
use crate::case::Triangles;
// The parts that all commands share are in a crate; commands name them as if they stood here.
use crate::command::{exit, flags, input, output, outputs, plugins, progress};
use crate::kernel::{self, Entry};
use crate::plugin::{self, Asked};
use crate::printable::is_obeyed;
use clap::builder::Styles;
use clap::{Arg, ArgMatches, CommandFactory, FromArgMatches, Parser, Subcommand};
use hairline_boxes::Boxes;
use hairline_core::exact;
use std::ffi::OsString;
use std::path::PathBuf;
use std::process::ExitCode;
use std::sync::Once;
use std::time::Duration;

/// Audits ray-triangle kernels and their epsilons against exact predicates.
#[derive(Parser)]
#[command(name = "hairline", version, disable_help_subcommand = true)]
struct Arguments {
    #[command(subcommand)]
    command: Chosen,
}

#[derive(Subcommand)]
enum Chosen {
    /// Run kernels on hard cases, and report where they are wrong
    Audit(Box<audit::AuditArguments>),
    /// Recommend epsilons for a scene, a mesh or families of cases
    Epsilon(Box<epsilon::EpsilonArguments>),
    /// Show which offset shadow rays need to leave their own surface
    #[command(alias = "spawn")]
    Offset(Box<offset::OffsetArguments>),
    /// Report where rays slip through the edges and vertices of a mesh
    Mesh(Box<mesh::MeshArguments>),
    /// Prove what a kernel can never do wrong, whatever the floats
    Prove(Box<prove::ProveArguments>),
    /// Mend a kernel by small changes, or write one that may ask
    Repair(Box<repair::RepairArguments>),
    /// Show one case: its exact truth, and why a kernel was wrong
    Explain(explain::ExplainArguments),
    /// Judge ray-box tests
    Boxes(boxes::BoxesArguments),
    /// Tell what rays meet in a mesh, exactly
    Rays(Box<rays::RaysArguments>),
    /// Draw where a kernel is wrong around a case, a pixel a float
    Map(Box<map::MapArguments>),
    /// List kernels, families, contracts, epsilon presets or arithmetics
    List(list::ListArguments),
    /// Search for findings until stopped
    Fuzz(Box<fuzz::FuzzArguments>),
    /// Compare a run with the known disagreements
    Check(Box<check::CheckArguments>),
    /// Merge the records of all shards of a run into one
    Merge(merge::MergeArguments),
    /// Show what got better and what got worse between two records
    Diff(diff::DiffArguments),
    /// Write cases as lines, for a kernel that runs elsewhere
    Generate(Box<generate::GenerateArguments>),
    /// Print the exact truth of cases, one JSON line each
    Truth(truth::TruthArguments),
    /// Compare the oracle with its definition and integer arithmetic
    Selfcheck(selfcheck::SelfcheckArguments),
    /// Verify the stored cases, or write them again
    Corpus(corpus::CorpusArguments),
    /// Write test vectors: cases with their exact answers
    Vectors(vectors::VectorsArguments),
    /// Judge what a product answered to the test vectors
    Verify(verify::VerifyArguments),
    /// Describe a command, or say what a word on a screen means
    Help(help::HelpArguments),
    /// Print a script that completes commands and flags in a shell
    Completions(help::CompletionsArguments),
    /// Print a page of the manual
    Man(help::ManArguments),
    /// Load a library and answer cases from standard input: what --kernel-lib starts
    #[command(name = plugin::HOST_COMMAND, hide = true)]
    KernelHost {
        /// The target of its kernel
        #[arg(value_parser = [Triangles::FORM.judges, Boxes::FORM.judges])]
        judges: String,
        /// The library
        file: PathBuf,
        /// Ask the first whole batch again and again before its answer counts, for so many milliseconds at most
        #[arg(long, default_value_t = 0)]
        long_run: u64,
    },
}

/// The commands by what they are for, in the order of the help.
const GROUPS: [(&str, &[&str]); 8] = [
    (
        "Choose an epsilon",
        &[
            "audit", "epsilon", "offset", "prove", "repair", "mesh", "explain", "map", "list",
        ],
    ),
    ("Test boxes", &["boxes"]),
    ("Test whole scenes", &["rays"]),
    ("Hunt with a fuzzer", &["fuzz"]),
    ("Gate a CI", &["check", "merge", "diff"]),
    (
        "Bring your own",
        &["generate", "truth", "vectors", "verify"],
    ),
    ("Trust it", &["selfcheck", "corpus"]),
    ("Find your way", &["help", "completions", "man"]),
];

/// The command line, its help grouped.
fn command() -> clap::Command {
    let mut command = Arguments::command().term_width(output::screen_width());
    for (name, example) in EXAMPLES {
        command = command.mut_subcommand(name, |command| {
            command.before_help(format!("Example: {example}"))
        });
    }
    let styles = Styles::default();
    let (header, name_style) = (styles.get_header(), styles.get_literal());
    let mut help = "{about-with-newline}\n{usage-heading} {usage}\n".to_owned();
    for (title, names) in GROUPS {
        help.push_str(&format!("\n{header}{title}:{header:#}\n"));
        for name in names {
            let about = command
                .find_subcommand(name)
                .and_then(clap::Command::get_about);
            let about = about.map(ToString::to_string).unwrap_or_default();
            let own = commands_of(&command, name).join(", ");
            let own = if own.is_empty() {
                own
            } else {
                format!(" [{own}]")
            };
            help.push_str(&format!(
                "  {name_style}{name:<11}{name_style:#}  {about}{own}\n"
            ));
        }
    }
    help.push_str(&format!("\n{header}Options:{header:#}\n{{options}}\n"));
    help.push_str("\n`hairline COMMAND --help` describes a command.");
    command.help_template(help)
}

/// The names of a command's own commands.
fn commands_of(command: &clap::Command, parent: &str) -> Vec<String> {
    let all = command
        .find_subcommand(parent)
        .into_iter()
        .flat_map(|c| c.get_subcommands());
    all.map(|child| child.get_name().to_owned()).collect()
}

/// Runs the program on the process's arguments.
pub fn main() -> ExitCode {
    main_with([])
}

/// Runs the program with kernels of your own beside the built-in ones; the one place where errors
/// become exit codes.
///
/// ```no_run
/// use hairline::{Case, Contract, Entry, Hit, KernelInfo};
///
/// const INFO: KernelInfo = KernelInfo::own("mine", Contract::CLOSED_RAY);
///
/// fn main() -> std::process::ExitCode {
///     hairline::cli::main_with([Entry::new(&INFO).f32(|case: &Case<f32>, _: &[f32]| {
///         (case.ray.direction.z < 0.0).then(|| Hit::at(1.0))
///     })])
/// }
/// ```
pub fn main_with(kernels: impl IntoIterator<Item = Entry>) -> ExitCode {
    for kernel in kernels {
        if let Err(message) = kernel::register(kernel) {
            eprintln!("hairline: {message}");
            return (Status::Usage as u8).into();
        }
    }
    run(std::env::args_os()).into()
}

/// Runs the program on a command line, which begins with the program's name; returns the exit code.
pub fn run(words: impl IntoIterator<Item = OsString>) -> u8 {
    let words: Vec<OsString> = words.into_iter().collect();
    let floats = FloatEnvironment::now();
    if !floats.is_default() {
        eprintln!(
            "hairline: this program computes with {floats} from the start, so no truth that it computes would be \
             right: link it without -ffast-math, or bring the kernel as a library with --kernel-lib"
        );
        return Status::SelfCheck as u8;
    }
    static EXACT: Once = Once::new();
    // Its name is free unless a program's own kernel has it.
    EXACT.call_once(|| drop(kernel::register(exact::entry())));
    let parsed = command()
        .try_get_matches_from(&words)
        .and_then(|matches| Ok((Arguments::from_arg_matches(&matches)?.command, matches)));
    let (command, matches) = match parsed {
        Ok(parsed) => parsed,
        Err(error) => {
            if error.kind() == clap::error::ErrorKind::InvalidUtf8 {
                return ended(not_utf8(&words));
            }
            if error.use_stderr() {
                print_misuse(&error, &words);
                return Status::Usage as u8;
            }
            // Help and version are no errors.
            let printed = output::standard_output()
                .map(drop)
                .and_then(|()| Ok(error.print()?));
            return printed.map_or_else(ended, |()| Status::Success as u8);
        }
    };
    if is_quiet(&matches) {
        plugins::be_quiet();
    }
    if let Err(failure) = check_outputs(&self::command(), &matches) {
        return ended(failure);
    }
    let own = matches.subcommand().map(|(_, own)| own);
    let outcome = match command {
        Chosen::Audit(arguments) => audit::run(&arguments),
        Chosen::Epsilon(arguments) => epsilon::run(&arguments, own),
        Chosen::Offset(arguments) => offset::run(&arguments),
        Chosen::Mesh(arguments) => mesh::run(&arguments),
        Chosen::Prove(arguments) => prove::run(&arguments),
        Chosen::Repair(arguments) => repair::run(&arguments),
        Chosen::Explain(arguments) => explain::run(&arguments),
        Chosen::Boxes(arguments) => boxes::run(&arguments),
        Chosen::Rays(arguments) => rays::run(&arguments),
        Chosen::Map(arguments) => map::run(&arguments),
        Chosen::List(arguments) => list::run(&arguments),
        Chosen::Fuzz(arguments) => fuzz::run(&arguments),
        Chosen::Check(arguments) => check::run(*arguments, own),
        Chosen::Merge(arguments) => merge::run(&arguments),
        Chosen::Diff(arguments) => diff::run(&arguments),
        Chosen::Generate(arguments) => generate::run(&arguments),
        Chosen::Truth(arguments) => truth::run(&arguments),
        Chosen::Selfcheck(arguments) => selfcheck::run(&arguments),
        Chosen::Corpus(arguments) => corpus::run(&arguments),
        Chosen::Vectors(arguments) => vectors::run(&arguments),
        Chosen::Verify(arguments) => verify::run(&arguments),
        Chosen::Help(arguments) => help::run(&arguments, self::command()),
        Chosen::Completions(arguments) => help::completions(&arguments, self::command()),
        Chosen::Man(arguments) => help::man(&arguments, self::command()),
        Chosen::KernelHost {
            judges,
            file,
            long_run,
        } => {
            let is_of_boxes = judges == Boxes::FORM.judges;
            let form = if is_of_boxes {
                Boxes::FORM
            } else {
                Triangles::FORM
            };
            return plugin::serve(&form, &file, Duration::from_millis(long_run));
        }
    };
    plugins::finish();
    // A broken kernel of the user's is reported before anything that its verdicts led to.
    match plugins::check().and(outcome) {
        Ok(status) => status as u8,
        Err(failure) => ended(failure),
    }
}

/// Says what is wrong with a command line: in colours, unless a word of it would be an order to the terminal.
fn print_misuse(error: &clap::Error, words: &[OsString]) {
    let is_order = |word: &OsString| word.to_string_lossy().contains(is_obeyed);
    if words.iter().any(is_order) {
        let message = error.render().to_string();
        message.lines().for_each(|line| eprintln!("{line}"));
    } else {
        let _ = error.print();
    }
    if let Some(advice) = misuse::advice(error, &self::command(), words) {
        eprintln!("hairline: {advice}");
    }
}

/// True if the command line says --quiet.
fn is_quiet(matches: &ArgMatches) -> bool {
    let has_flag = matches
        .try_get_one("quiet")
        .is_ok_and(|quiet| quiet == Some(&true));
    has_flag || matches.subcommand().is_some_and(|(_, own)| is_quiet(own))
}

/// Refuses outputs that could not be written, before any work.
fn check_outputs(command: &clap::Command, matches: &ArgMatches) -> Result<(), Failure> {
    let is_file = |argument: &Arg| {
        argument.get_id() == "output" && argument.get_value_names() == Some(&["FILE".into()])
    };
    if command.get_arguments().any(is_file) {
        let files = matches.get_many::<String>("output");
        files
            .into_iter()
            .flatten()
            .try_for_each(|file| output::check_place(file))?;
    }
    let own = matches
        .subcommand()
        .and_then(|(name, own)| Some((command.find_subcommand(name)?, own)));
    own.map_or(Ok(()), |(command, matches)| check_outputs(command, matches))
}

/// The first argument that is not UTF-8, and what to do.
fn not_utf8(words: &[OsString]) -> Failure {
    let wrong = words.iter().find(|word| word.to_str().is_none());
    let wrong = wrong.map_or_else(Default::default, |word| word.to_string_lossy());
    Failure::usage(format!(
        "'{wrong}' is not UTF-8: rename the file, or hand it in as - < FILE"
    ))
}

/// Says why a command stops.
fn ended(failure: Failure) -> u8 {
    if let Some(message) = failure.message() {
        eprintln!("hairline: {message}");
    }
    failure.status() as u8
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_visible_command_is_in_one_group_with_a_line_that_fits() {
        let mut command = command();
        command.build();
        let visible = command
            .get_subcommands()
            .filter(|command| !command.is_hide_set());
        let mut visible: Vec<&str> = visible.map(clap::Command::get_name).collect();
        let mut grouped: Vec<&str> = GROUPS.iter().flat_map(|group| group.1).copied().collect();
        visible.sort();
        grouped.sort();
        assert_eq!(visible, grouped);
        let help = command.clone().render_long_help().to_string();
        let subcommands = command.get_subcommands().flat_map(|command| {
            [
                command.clone().render_help(),
                command.clone().render_long_help(),
            ]
        });
        for page in subcommands
            .map(|page| page.to_string())
            .chain([help.clone()])
        {
            // A command line is not broken.
            let wide = page.lines().find(|line| 80 < line.chars().count());
            assert_eq!(wide.filter(|line| !line.starts_with("Example: ")), None);
        }
        assert!(
            help.contains("\nGate a CI:\n  check        Compare a run"),
            "{help}"
        );
        command.clone().debug_assert();
        // Every command has an example that it takes.
        let mut examples: Vec<&str> = EXAMPLES.iter().map(|(name, _)| *name).collect();
        examples.sort();
        assert_eq!(visible, examples);
        for (name, example) in EXAMPLES {
            let words = shlex::split(example).unwrap();
            let words = words
                .split(|word| [">", "|"].contains(&word.as_str()))
                .next()
                .unwrap();
            let matches = super::command().try_get_matches_from(words).unwrap();
            assert_eq!(matches.subcommand_name(), Some(*name));
        }
    }
}
