//! `hairline-rt`: asks a GPU's own ray tracing, through ray queries of wgpu, and writes what hairline judges.

#![deny(unsafe_code)]

mod device;
mod failure;
mod input;
mod output;
mod structure;
mod trace;
mod world;

mod answers;
mod cases;
mod leaks;
mod offsets;
mod signature;

use clap::{Parser, Subcommand};
use device::Device;
use failure::Failure;
use std::process::ExitCode;

/// Asks a GPU's own ray tracing (Vulkan, Direct3D 12 or Metal), and writes what hairline judges.
///
/// WGPU_ADAPTER_NAME=llvmpipe picks an adapter by a part of its name, WGPU_BACKEND=vulkan a backend.
///
/// Exit codes: 0, 1 if rays leak, 2 for a wrong command line, 65 for wrong input, 66 for a missing file, 69 without such a device, 74 for a
/// file that cannot be read or written.
#[derive(Parser)]
#[command(name = "hairline-rt", version, arg_required_else_help = true)]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// The device that the other commands ask, and its driver.
    Device,
    Answers(answers::Arguments),
    Cases(cases::Arguments),
    Leaks(leaks::Arguments),
    Offsets(offsets::Arguments),
    Signature(signature::Arguments),
}

fn main() -> ExitCode {
    match run(Arguments::parse().command) {
        Ok(code) => code,
        Err(Failure { code, message }) => {
            output::progress("");
            eprintln!("hairline-rt: {message}");
            ExitCode::from(code)
        }
    }
}

fn run(command: Command) -> Result<ExitCode, Failure> {
    match command {
        Command::Device => output::print(&format!("{}\n", Device::open()?.name()))?,
        Command::Answers(arguments) => answers::run(&arguments)?,
        Command::Cases(arguments) => cases::run(&arguments)?,
        Command::Leaks(arguments) => return leaks::run(&arguments),
        Command::Offsets(arguments) => offsets::run(&arguments)?,
        Command::Signature(arguments) => signature::run(&arguments)?,
    }
    Ok(ExitCode::SUCCESS)
}
