//! Floor 6: one file a command. The only place that prints, opens files and reads a clock.

#![forbid(unsafe_code)]

mod audit;
mod case;
mod corpus;
mod epsilon;
mod exit;
mod explain;
mod input;
mod list;
mod orient;
mod output;
mod progress;
mod select;
mod selfcheck;
mod shrink;
mod sources;
mod truth;
mod worst;

pub use exit::{Failure, Status};

use clap::{Parser, Subcommand};
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
    /// Say what every epsilon of a kernel would do, and which to use
    Epsilon(Box<epsilon::EpsilonArguments>),
    /// Print the exact truth of cases, one JSON line each
    Truth(truth::TruthArguments),
    /// Show one case: its exact truth, and what each gate of each kernel made of it
    Explain(explain::ExplainArguments),
    /// Search for the worst case of each kernel and gate; keep the worst known
    Worst(Box<worst::WorstArguments>),
    /// Make a case with a finding as simple as it can be, as JSON, Rust and C to paste into a test
    Shrink(shrink::ShrinkArguments),
    /// List kernels, families, contracts or epsilon presets
    List(list::ListArguments),
    /// Hold the oracle to its definition and to integer arithmetic
    Selfcheck(selfcheck::SelfcheckArguments),
    /// Run orientation predicates on families of points, and say where their sign is wrong
    Orient(Box<orient::OrientArguments>),
    /// Verify or make the stored cases
    Corpus(corpus::CorpusArguments),
}

/// Runs the program on the process's arguments; the one place where errors become exit codes.
pub fn main() -> ExitCode {
    let arguments = match Arguments::try_parse() {
        Ok(arguments) => arguments,
        Err(error) => {
            // Help and version are no errors.
            let code = if error.use_stderr() { Status::Usage } else { Status::Success };
            let _ = error.print();
            return code.into();
        }
    };
    let outcome = match arguments.command {
        Command::Audit(arguments) => audit::run(&arguments),
        Command::Epsilon(arguments) => epsilon::run(&arguments),
        Command::Truth(arguments) => truth::run(&arguments),
        Command::Explain(arguments) => explain::run(&arguments),
        Command::Worst(arguments) => worst::run(&arguments),
        Command::Shrink(arguments) => shrink::run(&arguments),
        Command::List(arguments) => list::run(&arguments),
        Command::Selfcheck(arguments) => selfcheck::run(&arguments),
        Command::Orient(arguments) => orient::run(&arguments),
        Command::Corpus(arguments) => corpus::run(&arguments),
    };
    match outcome {
        Ok(status) => status.into(),
        Err(failure) => {
            if let Some(message) = failure.message() {
                eprintln!("hairline: {message}");
            }
            failure.status().into()
        }
    }
}
