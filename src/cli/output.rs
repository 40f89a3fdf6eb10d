//! Where results go: standard output, or files that appear whole or not at all.

use super::exit::Failure;
use crate::suggest::nearest_name;
use clap::ValueEnum;
use std::fs::{self, File};
use std::io::{self, BufWriter, IsTerminal, Write};
use std::path::{Path, PathBuf};

/// When to colour.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum ColorChoice {
    /// On a terminal, unless NO_COLOR is set.
    #[default]
    Auto,
    /// Always.
    Always,
    /// Never.
    Never,
}

impl ColorChoice {
    /// Whether to colour what goes to standard output (or to a file, which is no terminal).
    pub fn enabled(self, to_stdout: bool) -> bool {
        let allowed = std::env::var_os("NO_COLOR").is_none_or(|value| value.is_empty());
        match self {
            ColorChoice::Always => true,
            ColorChoice::Never => false,
            ColorChoice::Auto => allowed && to_stdout && io::stdout().is_terminal(),
        }
    }
}

/// Formats with where they go: each named format to its output, one alone to standard output.
pub fn paired_outputs<'a, T>(
    table: &'static [T],
    name_of: fn(&T) -> &'static str,
    formats: &[String],
    outputs: &'a [String],
) -> Result<Vec<(&'static T, &'a str)>, Failure> {
    let find = |name: &String| {
        let found = table.iter().find(|format| name_of(format) == name);
        found.ok_or_else(|| {
            let names: Vec<&str> = table.iter().map(name_of).collect();
            let advice = match nearest_name(name, names.iter().copied()) {
                Some(near) => format!("; did you mean '{near}'?"),
                None => format!(": there are {}", names.join(", ")),
            };
            Failure::usage(format!("unknown format '{name}'{advice}"))
        })
    };
    let formats = formats.iter().map(find).collect::<Result<Vec<_>, _>>()?;
    if let Some(i) = (1..outputs.len()).find(|&i| outputs[..i].contains(&outputs[i])) {
        return Err(Failure::usage(format!("-o {} is given twice", outputs[i])));
    }
    match (formats.len(), outputs.len()) {
        (1, 0) => Ok(vec![(formats[0], "-")]),
        (n, m) if n == m => {
            Ok(formats.into_iter().zip(outputs.iter().map(String::as_str)).collect())
        }
        (n, m) => Err(Failure::usage(format!(
            "{n} formats but {m} outputs: give -o once for each format, in the same order"
        ))),
    }
}

/// Writes one result to standard output (`-`) or to a file, which is written beside and renamed.
pub fn write_result(
    path: &str,
    write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> Result<(), Failure> {
    if path == "-" {
        let mut out = BufWriter::new(io::stdout().lock());
        write(&mut out)?;
        out.flush()?;
        return Ok(());
    }
    write_file(Path::new(path), write).map_err(|error| Failure::of_file(path, &error))
}

/// Writes a file beside its place and renames it; leaves nothing half-written.
pub fn write_file(
    path: &Path,
    write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> io::Result<()> {
    // A device, a pipe or a socket has no place beside it.
    if fs::metadata(path).is_ok_and(|metadata| !metadata.is_file() && !metadata.is_dir()) {
        let mut out = BufWriter::new(File::options().write(true).open(path)?);
        write(&mut out)?;
        return out.flush();
    }
    if path.is_dir() {
        return Err(io::Error::new(io::ErrorKind::IsADirectory, "is a directory"));
    }
    let name = path.file_name().ok_or_else(|| io::Error::other("names no file"))?;
    let mut beside_name = std::ffi::OsString::from(".");
    beside_name.push(name);
    beside_name.push(format!(".{}.tmp", std::process::id()));
    let beside: PathBuf = path.with_file_name(beside_name);
    let attempt = || -> io::Result<()> {
        let mut out = BufWriter::new(File::create(&beside)?);
        write(&mut out)?;
        out.flush()?;
        out.get_ref().sync_all()?;
        fs::rename(&beside, path)
    };
    attempt().inspect_err(|_| {
        let _ = fs::remove_file(&beside);
    })
}
