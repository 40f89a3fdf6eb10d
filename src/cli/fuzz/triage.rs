//! `hairline fuzz triage`: one small find of each kind, out of whatever found it.

mod inputs;

use super::directory::NO_BAND;
use super::summary::explain_command;
use crate::audit::Attribution;
use crate::cli::before::set_threads;
use crate::cli::exit::{Failure, Status};
use crate::cli::input::corpus_files;
use crate::cli::output::{write_lines, write_result};
use crate::cli::select::KernelArguments;
use crate::corpus::lines::{self, write_case};
use crate::engine;
use crate::explore::campaign::Find;
use crate::explore::shrink_finding;
use crate::judge::{Class, Finding};
use clap::{Args, ValueEnum};
use std::collections::BTreeMap;
use std::fs;
use std::io::{self, Write};
use std::path::Path;

/// The arguments of `triage`: the paths to read, and where the finds go.
#[derive(Args)]
#[command(mut_arg("band", |band| band.hide(true)))]
pub struct TriageArguments {
    /// Campaign directories, corpora (JSON lines), cargo-fuzz artifacts, or folders of them
    #[arg(value_name = "PATH", required = true)]
    paths: Vec<String>,

    #[command(flatten)]
    kernels: KernelArguments,

    /// The folder to write to, one file a kernel; findings that are already there stay unless a simpler
    /// case shows the same
    #[arg(long, short, value_name = "DIR", default_value = "corpora/found")]
    output: String,

    /// How findings are told apart
    #[arg(long, value_enum, default_value_t = OneEach::Kind)]
    one_each: OneEach,

    /// Threads [default: all cores]; the result does not depend on it
    #[arg(long, value_name = "N")]
    threads: Option<usize>,

    /// Print nothing but errors
    #[arg(long, short)]
    quiet: bool,
}

/// How far finds are told apart.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum OneEach {
    /// Kernel, scalar, finding, class, gates and attribution: the whole signature
    Kind,
    /// Kernel, finding, class and attribution
    Cause,
}

/// The key of a find: one find is kept for each.
#[derive(PartialEq, Eq, PartialOrd, Ord)]
enum FindKey {
    Kind(String),
    Cause(&'static str, Finding, Class, Option<Attribution>),
}

impl OneEach {
    fn key(self, find: &Find) -> FindKey {
        let signature = &find.signature;
        match self {
            OneEach::Kind => FindKey::Kind(find.name()),
            OneEach::Cause => {
                let (class, why) = (signature.class, signature.attribution);
                FindKey::Cause(signature.kernel, signature.finding, class, why)
            }
        }
    }
}

/// Runs the command.
pub fn run(arguments: &TriageArguments) -> Result<Status, Failure> {
    set_threads(arguments.threads)?;
    let rows = arguments.kernels.rows_without_band(NO_BAND)?;
    let mut read = Vec::new();
    for path in &arguments.paths {
        inputs::read_path(Path::new(path), &rows, &mut read)?;
    }
    if read.is_empty() {
        let paths = arguments.paths.join(", ");
        let message = format!("{paths}: nothing in it on which a chosen kernel is wrong");
        return Err(Failure::nothing(message));
    }
    let (count, one_each) = (read.len(), arguments.one_each);
    let known = read_known(&arguments.output)?;
    let stored: Vec<String> = known.iter().map(line_of).collect();
    let read = simplest(read, one_each).into_values().collect::<Vec<_>>();
    // What is there was minimised when it came; a new one may be simpler only afterwards.
    let minimised: Vec<Find> = engine::map(&read, |find| minimised(find.clone()));
    let kept = simplest(known.into_iter().chain(minimised), one_each);
    for find in kept.values() {
        replay(find)?;
    }
    let new: Vec<&Find> = kept
        .values()
        .filter(|find| !stored.contains(&line_of(find)))
        .collect();
    write_finds(&arguments.output, kept.values())?;
    if !arguments.quiet {
        write_lines(|out| write_report(out, &arguments.output, count, kept.len(), &new))?;
    }
    Ok(Status::Success)
}

/// The simplest find of each key; of equals the first.
fn simplest(finds: impl IntoIterator<Item = Find>, one_each: OneEach) -> BTreeMap<FindKey, Find> {
    let mut kept: BTreeMap<FindKey, Find> = BTreeMap::new();
    for find in finds {
        let key = one_each.key(&find);
        if kept
            .get(&key)
            .is_none_or(|known| find.size() < known.size())
        {
            kept.insert(key, find);
        }
    }
    kept
}

/// The same find on a case that no single step makes simpler.
fn minimised(find: Find) -> Find {
    let case = either_scalar!(&find.case, case => {
        shrink_finding(&find.row, case).map(|(_, shrunk)| shrunk.case.into())
    });
    Find {
        case: case.unwrap_or(find.case),
        ..find
    }
}

fn line_of(find: &Find) -> String {
    write_case(&find.stored())
}

/// Reads a find back from its line and runs it again.
fn replay(find: &Find) -> Result<(), Failure> {
    let line = line_of(find);
    let stored = lines::read(line.as_bytes(), "find").next();
    let again = stored
        .and_then(Result::ok)
        .map(|stored| Find::of_stored(&stored));
    match again {
        Some(Ok(again)) if again.signature == find.signature => Ok(()),
        _ => Err(Failure::self_check(format!(
            "this find does not replay: {line}"
        ))),
    }
}

/// The finds that are in a folder already.
fn read_known(folder: &str) -> Result<Vec<Find>, Failure> {
    match fs::read_dir(folder).map(|mut entries| entries.next().is_none()) {
        Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(Vec::new()),
        Err(error) => return Err(Failure::of_file(folder, &error)),
        Ok(true) => return Ok(Vec::new()),
        Ok(false) => {}
    }
    let mut known = Vec::new();
    for file in corpus_files(folder)? {
        inputs::read_finds_file(Path::new(&file), &mut known)?;
    }
    Ok(known)
}

/// One file a kernel, in the order of the finds' names.
fn write_finds<'a>(folder: &str, finds: impl Iterator<Item = &'a Find>) -> Result<(), Failure> {
    let mut kernels: BTreeMap<&str, Vec<&Find>> = BTreeMap::new();
    for find in finds {
        kernels.entry(find.signature.kernel).or_default().push(find);
    }
    fs::create_dir_all(folder).map_err(|error| Failure::of_file(folder, &error))?;
    for (kernel, mut finds) in kernels {
        finds.sort_by_cached_key(|find| (find.name(), line_of(find)));
        let path = format!("{folder}/{kernel}.jsonl");
        write_result(path, |out| {
            finds
                .iter()
                .try_for_each(|find| writeln!(out, "{}", line_of(find)))
        })?;
    }
    Ok(())
}

fn write_report(
    out: &mut dyn Write,
    folder: &str,
    read: usize,
    kept: usize,
    new: &[&Find],
) -> io::Result<()> {
    writeln!(
        out,
        "{read} findings read; {folder} has {kept}, {} of them new or simpler",
        new.len()
    )?;
    for find in new {
        let file = format!("{folder}/{}.jsonl", find.signature.kernel);
        writeln!(out, "{}", find.signature)?;
        writeln!(out, "    {}", explain_command(find, &file))?;
    }
    Ok(())
}
