//! The `hairline` program: everything is in [`hairline::cli`].

use std::process::ExitCode;

fn main() -> ExitCode {
    hairline::cli::main()
}
