//! Other people's tools that some tests need, and what is said where one is missing.

use std::fs::OpenOptions;
use std::io::Write;
use std::process::Command;

/// Whether a program runs here; says what is left out if not.
pub fn has(program: &str) -> bool {
    let found = Command::new(program).arg("--version").output().is_ok();
    if !found {
        not_tested(&format!("there is no '{program}' on this machine"));
    }
    found
}

/// Says why a test ends before it has tried all, on its standard error, which `cargo test` shows of failed tests alone, and in
/// the file that `NOT_TESTED` names: `.ci/run` prints it at its end.
pub fn not_tested(why: &str) {
    eprintln!("NOT TESTED: {why}");
    let Some(name) = std::env::var_os("NOT_TESTED") else {
        return;
    };
    let file = OpenOptions::new().create(true).append(true).open(name);
    writeln!(file.unwrap(), "{why}").unwrap();
}
