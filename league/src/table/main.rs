//! `league-table EDITION [KERNEL …]`: audits every entrant, or those named, and writes the files of
//! league/editions/EDITION, the table in docs/league.md and the worst known cases in league/witnesses.
//! `league-table --tables EDITION` makes the tables again from the entrants' files; `--freeze EDITION`
//! writes the hashes, after which the edition is not written any more. Run it from the project's root.

mod run;
mod witnesses;

use hairline_league::edition::{self, CAPTION, MANIFEST, Manifest};
use std::fs;
use std::path::Path;
use std::process::ExitCode;

const DOCUMENT: &str = "docs/league.md";
const START: &str = "<!-- made by league/table -->";
const END: &str = "<!-- end -->";

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let done = match &words[..] {
        ["--tables", name] => open(name).and_then(|()| write_tables(name)),
        ["--freeze", name] => open(name).and_then(|()| freeze(name)),
        [name, kernels @ ..] if !name.starts_with('-') => audit(name, kernels),
        _ => Err("usage: league-table [--tables | --freeze] EDITION [KERNEL …]".to_owned()),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("league-table: {message}");
            ExitCode::from(2)
        }
    }
}

fn folder(name: &str) -> String {
    format!("league/editions/{name}")
}

/// An error if the edition is frozen.
fn open(name: &str) -> Result<(), String> {
    match Manifest::stored(Path::new(&folder(name)))? {
        Some(_) => Err(format!("{name} is frozen: a new run is a new edition")),
        None => Ok(()),
    }
}

fn audit(name: &str, kernels: &[&str]) -> Result<(), String> {
    open(name)?;
    let entrants = hairline_league::entrants();
    if let Some(unknown) = kernels
        .iter()
        .find(|k| entrants.iter().all(|e| e.name != **k))
    {
        return Err(format!("'{unknown}' is no entrant"));
    }
    let folder = folder(name);
    fs::create_dir_all(format!("{folder}/entrants"))
        .map_err(|error| format!("{folder}: {error}"))?;
    for entrant in entrants
        .iter()
        .filter(|e| kernels.is_empty() || kernels.contains(&e.name))
    {
        match run::audit(entrant) {
            Ok(Some(result)) => {
                let text = serde_json::to_string_pretty(&result).expect("numbers and strings");
                write(
                    &format!("{folder}/entrants/{}.json", entrant.name),
                    &format!("{text}\n"),
                )?;
            }
            Ok(None) => eprintln!("left out: {}: it is not installed", entrant.name),
            Err(message) => eprintln!("left out: {}: {message}", entrant.name),
        }
    }
    witnesses::write("league/witnesses", &edition::results(Path::new(&folder))?)?;
    write_tables(name)
}

fn write_tables(name: &str) -> Result<(), String> {
    let folder = folder(name);
    let results = edition::results(Path::new(&folder))?;
    let table = edition::markdown(&results);
    write(
        &format!("{folder}/table.md"),
        &format!("# {name}\n\n{CAPTION}\n\n{table}"),
    )?;
    let changes = edition::changes(Path::new("league/editions"), name)?;
    write(&format!("{folder}/changes.md"), &changes)?;
    write(
        &format!("{folder}/table.html"),
        &edition::html(name, &results),
    )?;
    write(
        &format!("{folder}/table.tex"),
        &edition::latex(name, &results),
    )?;
    let text = fs::read_to_string(DOCUMENT).map_err(|error| format!("{DOCUMENT}: {error}"))?;
    let (before, rest) = text
        .split_once(START)
        .ok_or(format!("{DOCUMENT}: no '{START}'"))?;
    let (_, after) = rest
        .split_once(END)
        .ok_or(format!("{DOCUMENT}: no '{END}'"))?;
    write(
        DOCUMENT,
        &format!(
            "{before}{START}\n\n{CAPTION}\n\n{table}\n## What changed\n\n{changes}\n{END}{after}"
        ),
    )
}

fn freeze(name: &str) -> Result<(), String> {
    let folder = folder(name);
    let manifest = Manifest::of(Path::new(&folder))?;
    let text = serde_json::to_string_pretty(&manifest).expect("strings");
    write(&format!("{folder}/{MANIFEST}"), &format!("{text}\n"))
}

/// Writes a file beside its place and renames it.
fn write(path: &str, text: &str) -> Result<(), String> {
    let beside = format!("{path}.new");
    fs::write(&beside, text).map_err(|error| format!("{beside}: {error}"))?;
    fs::rename(&beside, path).map_err(|error| format!("{path}: {error}"))
}
