//! The program `league`, which is built beside this one.

use serde::de::DeserializeOwned;
use std::process::{Command, Stdio};

/// The JSON that it prints.
pub fn json<T: DeserializeOwned>(arguments: &[&str]) -> Result<T, String> {
    let beside = std::env::current_exe().map_err(|error| error.to_string())?;
    let mut command = Command::new(beside.with_file_name("league"));
    command
        .args(arguments)
        .args(["--quiet", "--format", "json"])
        .stderr(Stdio::piped());
    let wrong = |message: &str| format!("league {}: {message}", arguments.join(" "));
    let output = command
        .output()
        .map_err(|error| wrong(&error.to_string()))?;
    if !output.status.success() {
        return Err(wrong(String::from_utf8_lossy(&output.stderr).trim()));
    }
    serde_json::from_slice(&output.stdout).map_err(|error| wrong(&error.to_string()))
}
