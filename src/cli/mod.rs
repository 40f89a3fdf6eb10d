//! Floor 6: one file a command. The only place that prints, opens files and reads a clock.

#![forbid(unsafe_code)]

/// Prints to standard error. Unlike the standard library's it does not panic if nobody can read it.
macro_rules! eprintln {
    ($($words:tt)*) => {{
        use std::io::Write as _;
        let _ = writeln!(std::io::stderr(), $($words)*);
    }};
}

mod audit;
mod case;
pub(crate) mod check;
mod config;
mod corpus;
mod diff;
mod epsilon;
pub(crate) mod exit;
mod explain;
mod fuzz;
mod generate;
mod github;
mod input;
mod judge;
mod list;
mod map;
mod merge;
mod mesh;
mod orient;
mod output;
mod plugins;
mod progress;
mod reporting;
mod select;
mod selfcheck;
mod settings;
mod shrink;
mod sources;
mod triage;
mod truth;
mod worst;

use exit::{Failure, Status};

use crate::kernel::{self, Entry};
use crate::plugin;
use clap::{Parser, Subcommand};
use std::path::PathBuf;
use std::process::ExitCode;

/// Audits ray-triangle kernels and their epsilons against exact predicates.
#[derive(Parser)]
#[command(name = "hairline", version, about, max_term_width = 100)]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// Run kernels on families of cases, a mesh or a corpus, and say where they are wrong
    Audit(Box<audit::AuditArguments>),
    /// Send rays at every edge and vertex of a mesh, and say where they slip through
    Mesh(Box<mesh::MeshArguments>),
    /// Run the project's plan and compare with its known disagreements: the gate for CI
    Check(Box<check::CheckArguments>),
    /// Make one record of those of all shards
    Merge(merge::MergeArguments),
    /// Say what got better and what got worse between two records
    Diff(diff::DiffArguments),
    /// Print the settings of `check` with their defaults
    Config(config::ConfigArguments),
    /// Print the JSON Schema of the record that `--format json` writes
    Schema,
    /// Say what every epsilon of a kernel would do, and which to use
    Epsilon(Box<epsilon::EpsilonArguments>),
    /// Print the exact truth of cases, one JSON line each
    Truth(truth::TruthArguments),
    /// Show one case: its exact truth, and what each gate of each kernel made of it
    Explain(explain::ExplainArguments),
    /// Search for the worst case of each kernel and gate; keep the worst known
    Worst(Box<worst::WorstArguments>),
    /// Search on and on for kinds of findings, and keep one small example of each in a directory
    Fuzz(Box<fuzz::FuzzArguments>),
    /// Keep one small find of each kind, out of campaigns, corpora and cargo-fuzz artifacts
    Triage(triage::TriageArguments),
    /// Make a case with a finding as simple as it can be, as JSON, Rust and C to paste into a test
    Shrink(shrink::ShrinkArguments),
    /// Draw where a kernel is wrong, one pixel one float, beside what is exactly true
    Map(Box<map::MapArguments>),
    /// List kernels, families, contracts or epsilon presets
    List(list::ListArguments),
    /// Hold the oracle to its definition and to integer arithmetic
    Selfcheck(selfcheck::SelfcheckArguments),
    /// Run orientation predicates on families of points, and say where their sign is wrong
    Orient(Box<orient::OrientArguments>),
    /// Verify or make the stored cases
    Corpus(corpus::CorpusArguments),
    /// Write cases as lines for a kernel that is a filter: `generate … | kernel | judge`
    Generate(Box<generate::GenerateArguments>),
    /// Read a filter's verdicts, and say where they are wrong
    Judge(judge::JudgeArguments),
    /// Load a library and answer cases from standard input: what --kernel-lib starts
    #[command(name = plugin::HOST_COMMAND, hide = true)]
    KernelHost {
        /// The library
        file: PathBuf,
    },
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
            return Status::Usage.into();
        }
    }
    let arguments = match Arguments::try_parse() {
        Ok(arguments) => arguments,
        Err(error) => {
            if error.use_stderr() {
                let _ = error.print();
                return Status::Usage.into();
            }
            // Help and version are no errors.
            let printed = output::standard_output().map(drop).and_then(|()| Ok(error.print()?));
            return printed.map_or_else(ended, |()| Status::Success.into());
        }
    };
    let outcome = match arguments.command {
        Command::Audit(arguments) => audit::run(&arguments),
        Command::Mesh(arguments) => mesh::run(&arguments),
        // Read again, under the environment and hairline.toml.
        Command::Check(_) => check::run(&std::env::args_os().skip(2).collect::<Vec<_>>()),
        Command::Merge(arguments) => merge::run(&arguments),
        Command::Diff(arguments) => diff::run(&arguments),
        Command::Config(arguments) => config::run(&arguments),
        Command::Schema => config::schema(),
        Command::Epsilon(arguments) => epsilon::run(&arguments),
        Command::Truth(arguments) => truth::run(&arguments),
        Command::Explain(arguments) => explain::run(&arguments),
        Command::Worst(arguments) => worst::run(&arguments),
        Command::Fuzz(arguments) => fuzz::run(&arguments),
        Command::Triage(arguments) => triage::run(&arguments),
        Command::Shrink(arguments) => shrink::run(&arguments),
        Command::Map(arguments) => map::run(&arguments),
        Command::List(arguments) => list::run(&arguments),
        Command::Selfcheck(arguments) => selfcheck::run(&arguments),
        Command::Orient(arguments) => orient::run(&arguments),
        Command::Corpus(arguments) => corpus::run(&arguments),
        Command::Generate(arguments) => generate::run(&arguments),
        Command::Judge(arguments) => judge::run(&arguments),
        Command::KernelHost { file } => return plugin::serve(&file).into(),
    };
    plugins::print_notes();
    // What went wrong in a kernel of the user's own goes before what was made of its verdicts.
    match plugins::check().and(outcome) {
        Ok(status) => status.into(),
        Err(failure) => ended(failure),
    }
}

/// Says why a command stops.
fn ended(failure: Failure) -> ExitCode {
    if let Some(message) = failure.message() {
        eprintln!("hairline: {message}");
    }
    failure.status().into()
}
