//! The audit of one entrant, in a process of the program that knows it.

use hairline::internals::record::Record;
use hairline_league::edition::{self, EntrantResult};
use hairline_league::{Entrant, Run};
use std::path::Path;
use std::process::{Command, Stdio};

/// All families but those about which the entrants promise nothing: invalid, coplanar and degenerate.
const FAMILIES: &[&str] = &[
    "interior",
    "outside",
    "edge-exact",
    "edge-near",
    "vertex-exact",
    "vertex-near",
    "parallel-off",
    "grazing",
    "origin-on",
    "origin-near",
    "secondary-ray",
    "behind",
    "interval-ends",
    "sliver",
    "tiny",
    "huge",
    "far",
    "direction-length",
    "axis-aligned",
    "mixed-scale",
    "range-ends",
    "shared-edge",
    "fan",
    "vertex-fan",
    "noise",
    "polygon",
    "lattice",
];

/// None if the entrant is not installed.
pub fn audit(entrant: &Entrant) -> Result<Option<EntrantResult>, String> {
    let beside = std::env::current_exe().map_err(|error| error.to_string())?;
    let league = beside.with_file_name("league");
    let heavy = std::env::var("LEAGUE_HEAVY").unwrap_or_default();
    let program = match entrant.run {
        Run::Heavy if heavy.is_empty() => return Ok(None),
        Run::Process { needs, .. } if !Path::new(needs).exists() => return Ok(None),
        Run::Heavy => heavy.into(),
        Run::Here(_) | Run::Process { .. } => league,
    };
    // Rays through a pipe, or with a scene each, take a thousand times as long.
    let count = if matches!(entrant.run, Run::Process { .. }) {
        "4000"
    } else {
        "20000"
    };
    let count = std::env::var("COUNT").unwrap_or(count.to_owned());
    let families: Vec<&str> = FAMILIES
        .iter()
        .copied()
        .filter(|family| !entrant.skip.contains(family))
        .collect();
    let file = std::env::temp_dir().join(format!("league-{}.json", std::process::id()));
    let mut command = Command::new(program);
    command
        .arg("audit")
        .args(entrant.selector())
        .args(["--quiet", "--format", "json", "-n", &count]);
    command
        .arg("--family")
        .arg(families.join(","))
        .arg("-o")
        .arg(&file);
    if entrant.takes_unit_directions() {
        command.args(["--direction", "unit"]);
    }
    eprintln!("{}", entrant.name);
    let output = command
        .stderr(Stdio::piped())
        .output()
        .map_err(|error| error.to_string())?;
    if !output.status.success() {
        let text = String::from_utf8_lossy(&output.stderr);
        return Err(text.trim().lines().last().unwrap_or("it failed").to_owned());
    }
    let record: Record = edition::read(&file)?;
    let _ = std::fs::remove_file(&file);
    let day = Command::new("date").args(["-u", "+%Y-%m-%d"]).output();
    let day = day.map_err(|error| format!("date: {error}"))?.stdout;
    EntrantResult::of(entrant, &record, String::from_utf8_lossy(&day).trim()).map(Some)
}
