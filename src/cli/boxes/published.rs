//! Boxes and rays of other people's reports, by name: `@libigl-2270`.

use super::written::WrittenCase;
use crate::cli::exit::Failure;
use crate::cli::flags::unknown;
use serde::{Deserialize, Serialize};

/// One report a line. `tests/commands/boxes_published.rs` has the truth of each, worked out by hand.
const REPORTS: &str = include_str!("published.jsonl");

/// A report with its case.
#[derive(Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Published {
    /// Its name, without the `@`.
    pub name: String,
    /// The thread, and its year.
    pub source: String,
    /// Where the numbers are from: the thread, or the smallest case of the kind that it describes.
    pub numbers: String,
    /// The complaint, in a line.
    pub about: String,
    /// The box and the ray.
    #[serde(skip_serializing)]
    pub case: WrittenCase,
}

/// All reports.
pub fn published() -> Vec<Published> {
    let lines = REPORTS.lines();
    let read = lines.map(serde_json::from_str);
    read.collect::<Result<_, _>>()
        .expect("a test reads these lines")
}

/// The report of a name.
pub fn find(name: &str) -> Result<Published, Failure> {
    let mut all = published();
    if let Some(place) = all.iter().position(|report| report.name == name) {
        return Ok(all.swap_remove(place));
    }
    let names = all.iter().map(|report| report.name.as_str());
    let list = "hairline boxes list published";
    Err(unknown("published case", name, names, list))
}
