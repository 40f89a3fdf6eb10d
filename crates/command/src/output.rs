//! Where results go: standard output, or files that appear whole or not at all.

#![forbid(unsafe_code)]

use crate::descriptors;
use crate::exit::Failure;
use crate::flags::OUTPUT;
use crate::named_file;
use crate::outputs::{format_named_by, paired_outputs};
use crate::places::{is_descriptor, is_standard_output, linked, place_of};
use crate::plugins;
use crate::printable::printable_lines;
use crate::report::page::Page;
use crate::report::{Format, Style, write_json_line};
use clap::{Args, ValueEnum};
use serde::Serialize;
use std::fs::{self, File};
use std::io::{self, BufWriter, IsTerminal, StdoutLock, Write};
use std::path::{Path, PathBuf};
use std::process;
use terminal_size::terminal_size;

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
    /// True if standard output (or a file, which is no terminal) gets colours.
    pub fn enabled(self, to_stdout: bool) -> bool {
        let allowed = std::env::var_os("NO_COLOR").is_none_or(|value| value.is_empty());
        match self {
            ColorChoice::Always => true,
            ColorChoice::Never => false,
            ColorChoice::Auto => allowed && to_stdout && io::stdout().is_terminal(),
        }
    }
}

/// The flags that say how to report, and where.
#[derive(Args)]
pub struct OutputArguments {
    /// text, json, markdown or html, in some commands csv or junit too; several separated by commas [default: as the file of -o
    /// ends, else text]
    #[arg(long, value_delimiter = ',', value_name = "FORMAT", help_heading = OUTPUT)]
    pub format: Vec<String>,

    /// Where to write, once for each format; - is standard output
    #[arg(short, long, value_name = "FILE", help_heading = OUTPUT)]
    pub output: Vec<String>,

    /// Print everything, not the answer alone
    #[arg(long, help_heading = OUTPUT)]
    pub details: bool,

    /// When to colour the text
    #[arg(long, value_enum, default_value_t, help_heading = OUTPUT)]
    pub color: ColorChoice,

    /// Print no progress and no notes
    #[arg(long, short, help_heading = OUTPUT)]
    pub quiet: bool,
}

impl OutputArguments {
    /// Checks the flags, before anything runs: each format with where it goes.
    pub fn pairs<R>(
        &self,
        table: &'static [Format<R>],
    ) -> Result<Vec<(&'static Format<R>, &str)>, Failure> {
        paired_outputs(table, &self.format, &self.output)
    }

    /// True if a format is written, by its name or by the end of a file's name.
    pub fn writes(&self, format: &str) -> bool {
        if !self.format.is_empty() {
            return self.format.iter().any(|name| name == format);
        }
        let mut files = self.output.iter();
        files.any(|path| format_named_by(path).is_some_and(|name| name == format))
    }

    /// An error if an output is one of some files that are read.
    pub fn keeps<'a>(&self, read: impl Iterator<Item = &'a String>) -> Result<(), Failure> {
        let outputs: Vec<PathBuf> = self.output.iter().map(|path| place_of(path)).collect();
        for file in read.filter(|file| *file != "-") {
            if outputs.contains(&place_of(file)) {
                return Err(Failure::usage(format!(
                    "-o: '{file}' is read by this command, and would be overwritten"
                )));
            }
        }
        Ok(())
    }

    /// Writes a record in each format.
    pub fn write<R>(&self, pairs: Vec<(&Format<R>, &str)>, record: &R) -> Result<(), Failure> {
        let OutputArguments { color, details, .. } = *self;
        write_results(pairs, |format, path, out| {
            let style = Style {
                color: color.enabled(path == "-"),
                details,
                width: width(path, details),
            };
            (format.write)(record, style, out)
        })
    }
}

/// Writes a page to standard output, where there are no flags for how.
pub fn write_page(page: Page) -> Result<(), Failure> {
    let style = Style {
        width: screen_width(),
        ..Style::default()
    };
    write_result("-", |out| (Format::TEXT.write)(&page, style, out))
}

/// The width of what goes to standard output.
pub fn screen_width() -> usize {
    width("-", false)
}

/// The width of an output: of a terminal its own, within what can be read; of anything else 80,
/// or where everything is asked for, as much as a table needs.
fn width(path: &str, details: bool) -> usize {
    let terminal = (path == "-" && io::stdout().is_terminal())
        .then(terminal_size)
        .flatten();
    let otherwise = if details { Style::WIDEST } else { Style::WIDTH };
    terminal.map_or(otherwise, |(width, _)| {
        usize::from(width.0).clamp(60, Style::WIDEST)
    })
}

/// Writes a result to standard output (`-`) or to a file, which appears whole or stays as it was.
pub fn write_result(
    path: impl AsRef<Path>,
    write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> Result<(), Failure> {
    let file = written(path.as_ref(), write)?;
    // What a kernel wrote that is given up is no result.
    plugins::check()?;
    file.map_or(Ok(()), FileBeside::put_in_place)
}

/// Writes lines for people to standard output, without what a terminal would obey.
pub fn write_lines(write: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> Result<(), Failure> {
    let mut lines = Vec::new();
    write(&mut lines)?;
    let text = String::from_utf8_lossy(&lines);
    write_result("-", |out| out.write_all(printable_lines(&text).as_bytes()))
}

/// Writes values as JSON, a line each.
pub fn write_json_lines(path: impl AsRef<Path>, all: &[impl Serialize]) -> Result<(), Failure> {
    write_result(path, |out| {
        all.iter().try_for_each(|one| write_json_line(one, out))
    })
}

/// Writes several results. Files take their places after all are written, so a full disk changes none of them.
pub fn write_results<T>(
    outputs: Vec<(T, &str)>,
    write: impl Fn(T, &str, &mut dyn Write) -> io::Result<()>,
) -> Result<(), Failure> {
    let files = all_written(outputs, write)?;
    plugins::check()?;
    files.into_iter().try_for_each(FileBeside::put_in_place)
}

/// Writes that there are no results; why may be a kernel that is given up.
pub fn write_failure<T>(
    outputs: Vec<(T, &str)>,
    write: impl Fn(T, &str, &mut dyn Write) -> io::Result<()>,
) -> Result<(), Failure> {
    all_written(outputs, write)?
        .into_iter()
        .try_for_each(FileBeside::put_in_place)
}

fn all_written<T>(
    outputs: Vec<(T, &str)>,
    write: impl Fn(T, &str, &mut dyn Write) -> io::Result<()>,
) -> Result<Vec<FileBeside>, Failure> {
    let written = outputs
        .into_iter()
        .map(|(what, path)| written(Path::new(path), |out| write(what, path, out)));
    written.filter_map(Result::transpose).collect()
}

/// Refuses a file that could not be written, before the work whose result it would hold.
pub fn check_place(name: &str) -> Result<(), Failure> {
    let path = linked(Path::new(name));
    // A pipe may have but one writer.
    let is_stream = fs::metadata(&path).is_ok_and(|old| !old.is_file() && !old.is_dir());
    if name == "-" || is_stream || is_descriptor(&path) {
        return Ok(());
    }
    Destination::of(Path::new(name))
        .map(drop)
        .map_err(|error| Failure::of_path(Path::new(name), &error))
}

/// Writes a result; a file still has to be put in its place.
fn written(
    name: &Path,
    write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> Result<Option<FileBeside>, Failure> {
    let failed = |error: io::Error| Failure::of_path(name, &error);
    let through = |to: &mut dyn Write| {
        let mut out = BufWriter::new(to);
        write(&mut out).and_then(|()| out.flush())
    };
    let (outcome, file) = match Destination::of(name).map_err(failed)? {
        Destination::StandardOutput => (
            through(&mut standard_output()?).map_err(Failure::from),
            None,
        ),
        Destination::Stream(mut file) => (through(&mut file).map_err(failed), None),
        Destination::Beside(mut beside) => {
            (through(&mut beside.file).map_err(failed), Some(beside))
        }
    };
    match outcome {
        Err(Failure::ClosedPipe) => Ok(None),
        outcome => outcome.map(|()| file),
    }
}

/// Standard output, unless it is closed.
pub fn standard_output() -> Result<StdoutLock<'static>, Failure> {
    descriptors::standard_output()?;
    Ok(io::stdout().lock())
}

/// Where a result is written.
enum Destination {
    StandardOutput,
    /// A device, a pipe, or a file that a descriptor names.
    Stream(File),
    Beside(FileBeside),
}

impl Destination {
    fn of(name: &Path) -> io::Result<Destination> {
        let path = linked(name);
        if is_standard_output(&path) {
            return Ok(Destination::StandardOutput);
        }
        match fs::metadata(&path) {
            Ok(metadata) if metadata.is_dir() => Err(io::ErrorKind::IsADirectory.into()),
            // What a shell has opened goes on at its end.
            Ok(metadata) if !metadata.is_file() || is_descriptor(&path) => File::options()
                .append(true)
                .open(&path)
                .map(Destination::Stream),
            _ => FileBeside::new(path).map(Destination::Beside),
        }
    }
}

/// How the name of a file begins that is written beside its place.
const BESIDE: &str = ".hairline-";

/// A file that is written beside its place; it is removed unless it is put there.
struct FileBeside {
    file: File,
    path: PathBuf,
    place: PathBuf,
}

impl FileBeside {
    fn new(place: PathBuf) -> io::Result<FileBeside> {
        // A file that may not be written may not be replaced either.
        let permissions = match File::options().write(true).open(&place) {
            Ok(old) => Some(old.metadata()?.permissions()),
            Err(error) if error.kind() == io::ErrorKind::NotFound => None,
            Err(error) => return Err(error),
        };
        remove_abandoned(&place);
        let mut number = 0;
        let (path, file) = loop {
            let path = place.with_file_name(format!("{BESIDE}{}-{number}.tmp", process::id()));
            match File::create_new(&path) {
                Err(error) if error.kind() == io::ErrorKind::AlreadyExists => number += 1,
                file => {
                    let file = file?;
                    let _ = file.lock();
                    // Until it is locked another run may take it for abandoned.
                    if path.exists() {
                        break (path, file);
                    }
                }
            }
        };
        let beside = FileBeside { file, path, place };
        permissions.map_or(Ok(()), |old| beside.file.set_permissions(old))?;
        Ok(beside)
    }

    fn put_in_place(self) -> Result<(), Failure> {
        let renamed = self
            .file
            .sync_all()
            .and_then(|()| fs::rename(&self.path, &self.place));
        renamed.map_err(|error| Failure::of_path(&self.place, &error))
    }
}

/// Removes what killed runs left beside a file: nobody holds its lock.
fn remove_abandoned(place: &Path) {
    let folder = place.parent().filter(|folder| *folder != Path::new(""));
    let Ok(entries) = fs::read_dir(folder.unwrap_or(Path::new("."))) else {
        return;
    };
    for path in entries.filter_map(|entry| Some(entry.ok()?.path())) {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        let is_beside = name.starts_with(BESIDE) && name.ends_with(".tmp");
        let file = is_beside.then(|| named_file::open(&path).ok()).flatten();
        if file.is_some_and(|file| file.try_lock().is_ok()) {
            let _ = fs::remove_file(&path);
        }
    }
}

impl Drop for FileBeside {
    fn drop(&mut self) {
        // It is gone already if it was put in its place.
        let _ = fs::remove_file(&self.path);
    }
}
