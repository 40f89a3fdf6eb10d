//! `hairline config` and `hairline schema`: what the files that check reads and writes look like.

use super::exit::{Failure, Status};
use super::output::write_result;
use super::settings;
use crate::report::SCHEMA;
use clap::Args;

/// What to print.
#[derive(Args)]
pub struct ConfigArguments {
    /// Print a commented hairline.toml with every setting at its default
    #[arg(long, required = true)]
    print_default: bool,
}

/// Runs `config`.
pub fn run(_: &ConfigArguments) -> Result<Status, Failure> {
    write_result("-", |out| out.write_all(settings::default_file().as_bytes()))?;
    Ok(Status::Success)
}

/// Runs `schema`.
pub fn schema() -> Result<Status, Failure> {
    write_result("-", |out| out.write_all(SCHEMA.as_bytes()))?;
    Ok(Status::Success)
}
