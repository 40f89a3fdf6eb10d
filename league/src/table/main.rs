//! `league-table DOCUMENT FOLDER RECORD.json …`: writes the tables of docs/league.md from records of
//! audits, and the worst known cases to a folder. What stands between the document's markers is replaced.

mod columns;
mod details;
mod precision;
mod rows;
mod witnesses;

use hairline::internals::report::Record;
use std::fs;
use std::process::ExitCode;

const START: &str = "<!-- made by league/table -->";
const END: &str = "<!-- end -->";

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [document, folder, records @ ..] = &arguments[..] else {
        return fail("usage: league-table DOCUMENT FOLDER RECORD.json …");
    };
    match run(document, folder, records) {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => fail(&message),
    }
}

fn fail(message: &str) -> ExitCode {
    eprintln!("league-table: {message}");
    ExitCode::from(2)
}

fn run(document: &str, folder: &str, paths: &[String]) -> Result<(), String> {
    let text = fs::read_to_string(document).map_err(|error| format!("{document}: {error}"))?;
    let (before, rest) = text.split_once(START).ok_or(format!("{document}: no '{START}'"))?;
    let (_, after) = rest.split_once(END).ok_or(format!("{document}: no '{END}'"))?;
    let records: Vec<Record> = paths.iter().map(|path| read(path)).collect::<Result<_, _>>()?;
    let [all, off_the_boundary] = [rows::rows(&records, false)?, rows::rows(&records, true)?];
    let mut made = rows::date(paths)?;
    made.push_str(&columns::tables(&all, &off_the_boundary));
    made.push_str(&columns::causes(&all));
    made.push_str(&precision::table());
    made.push_str(&details::sections(&all));
    witnesses::write(folder, &all)?;
    let new = format!("{before}{START}\n\n{made}\n{END}{after}");
    let beside = format!("{document}.new");
    fs::write(&beside, new).map_err(|error| format!("{beside}: {error}"))?;
    fs::rename(&beside, document).map_err(|error| format!("{document}: {error}"))
}

fn read(path: &str) -> Result<Record, String> {
    let text = fs::read_to_string(path).map_err(|error| format!("{path}: {error}"))?;
    serde_json::from_str(&text).map_err(|error| format!("{path}: {error}"))
}
