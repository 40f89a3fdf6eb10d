//! The records' results by entrant and scalar.

use hairline::internals::report::{KernelResult, Record, RowPart};
use hairline_league::{Entrant, entrants};
use std::collections::BTreeMap;
use std::process::Command;

/// An entrant in one scalar, with what was found.
pub struct TableRow<'a> {
    pub entrant: Entrant,
    pub plan: &'a RowPart,
    pub scalar: &'a str,
    pub results: Vec<&'a KernelResult>,
    /// In the kernel, its way there included.
    pub nanoseconds: Option<f64>,
    /// Errors of t of the hits of `interior`: half of them and 99 % of them are at most this, in ulps.
    pub t_errors: Option<[f64; 2]>,
}

/// Of the audits that ask nothing about cases near a boundary, or of the others. In the entrants' order;
/// an error if a record has a kernel that is none of them.
pub fn rows(records: &[Record], with_band: bool) -> Result<Vec<TableRow<'_>>, String> {
    let entrants = entrants();
    let mut found = BTreeMap::new();
    for record in records {
        let wanted = |plan: &&RowPart| plan.contract.contains(", free within ") == with_band;
        for plan in record.result.plan.rows.iter().filter(wanted) {
            let place = entrants.iter().position(|entrant| entrant.name == plan.kernel);
            let place = place.ok_or(format!("'{}' is no entrant", plan.kernel))?;
            for scalar in ["f32", "f64"] {
                let is_of = |result: &&KernelResult| {
                    result.kernel == plan.kernel && result.scalar == scalar
                };
                let results: Vec<_> = record.result.results.iter().filter(is_of).collect();
                if !results.is_empty() {
                    let row = row(record, plan, scalar, results, entrants[place]);
                    found.insert((place, scalar), row);
                }
            }
        }
    }
    Ok(found.into_values().collect())
}

fn row<'a>(
    record: &'a Record,
    plan: &'a RowPart,
    scalar: &'a str,
    results: Vec<&'a KernelResult>,
    entrant: Entrant,
) -> TableRow<'a> {
    let label = format!("{} ({})", plan.kernel, plan.set);
    let times = record.provenance.kernel_nanoseconds.get(scalar);
    let interior = results.iter().find(|result| result.family == "interior");
    let t = interior.and_then(|result| result.accuracy.get("t"));
    let infinite = |quantile: Option<f64>| quantile.unwrap_or(f64::INFINITY);
    TableRow {
        entrant,
        plan,
        scalar,
        results,
        nanoseconds: times.and_then(|times| times.get(&label)).copied(),
        t_errors: t.map(|t| [infinite(t.median), infinite(t.percent_99)]),
    }
}

/// The day and the machine of the audits.
pub fn date(paths: &[String]) -> Result<String, String> {
    let first = paths.first().ok_or("no records")?;
    let run = |program: &str, arguments: &[&str]| {
        let output = Command::new(program).args(arguments).output();
        let output = output.map_err(|error| format!("{program}: {error}"))?;
        Ok::<String, String>(String::from_utf8_lossy(&output.stdout).trim().to_owned())
    };
    let day = run("date", &["-u", "-r", first, "+%Y-%m-%d"])?;
    let compiler = run("rustc", &["--version"])?;
    let target = format!("{}-{}", std::env::consts::ARCH, std::env::consts::OS);
    Ok(format!("Audited on {day}, {target}, {compiler}.\n\n"))
}
