//! `hairline boxes`: slab tests, which say whether a ray meets an axis-aligned box, on boxes and rays that are hard.

mod audit;
mod case;
mod check;
mod epsilon;
mod explain;
mod list;
mod prove;
mod published;
mod record;
mod select;
mod written;

pub use record::BoxesResult;

use super::exit::{Failure, Status};
use clap::{Args, Subcommand};

/// The arguments of `boxes`.
#[derive(Args)]
pub struct BoxesArguments {
    #[command(subcommand)]
    command: BoxesCommand,
}

#[derive(Subcommand)]
enum BoxesCommand {
    /// Run slab tests on hard boxes, and report which lose rays
    Audit(audit::AuditArguments),
    /// Compare a run with the known wrong answers in a file, and fail if a test got worse
    Check(check::CheckArguments),
    /// Show which growth or padding loses no ray of a scene or of families
    Epsilon(epsilon::EpsilonArguments),
    /// Show one box and ray: the exact truth, and the answer of each test
    Explain(explain::ExplainArguments),
    /// Prove which growth loses no ray, for the three formulas of t
    Prove(prove::ProveArguments),
    /// List the slab tests with their sources, the families of boxes, or published cases
    List(list::ListArguments),
}

/// Runs the command.
pub fn run(arguments: &BoxesArguments) -> Result<Status, Failure> {
    match &arguments.command {
        BoxesCommand::Audit(arguments) => audit::run(arguments),
        BoxesCommand::Check(arguments) => check::run(arguments),
        BoxesCommand::Epsilon(arguments) => epsilon::run(arguments),
        BoxesCommand::Explain(arguments) => explain::run(arguments),
        BoxesCommand::Prove(arguments) => prove::run(arguments),
        BoxesCommand::List(arguments) => list::run(arguments),
    }
}
