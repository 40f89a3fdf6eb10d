//! Where a record was made, how long that took, and notes on the kernels of its rows.

use crate::arith::ScalarName;
use crate::audit::{Audit, EpsilonText, Plan, Row};
use crate::contract::{Boundary, Extent};
use crate::kernel::{Gate, Role};
use crate::plan::*;
use std::collections::BTreeMap;

/// This program and its version, as records have it.
pub const TOOL: &str = concat!("hairline ", env!("CARGO_PKG_VERSION"));

/// The data of a run besides its sums.
pub struct Context {
    /// Wall-clock seconds of the run.
    pub seconds: f64,
    /// Threads used.
    pub threads: usize,
}

/// Where a record was made, and how long it took.
pub fn provenance_of(context: &Context) -> Provenance {
    Provenance {
        tool: TOOL.to_owned(),
        target: format!("{}-{}", std::env::consts::ARCH, std::env::consts::OS),
        threads: context.threads,
        seconds: context.seconds,
        ..Provenance::default()
    }
}

/// Notes on the rows' kernels besides their verdicts.
fn kernel_notes(rows: &[Row]) -> BTreeMap<String, Vec<String>> {
    let mut all: BTreeMap<String, Vec<String>> = BTreeMap::new();
    for row in rows {
        let notes = row.entry.notes().into_iter().chain(ends_note(row));
        let known = all.entry(row.entry.info.name.to_owned()).or_default();
        notes.for_each(|note| {
            if !known.contains(&note) {
                known.push(note);
            }
        });
    }
    all.retain(|_, notes| !notes.is_empty());
    all
}

/// A contract that promises hits at the ends of a ray, and an epsilon that excludes them.
fn ends_note(row: &Row) -> Option<String> {
    // What a built-in kernel promises is what its source says.
    let promises = !row.entry.is_built_in()
        && row.contract.extent != Extent::Line
        // Such a contract is about the near hits, as the epsilon is.
        && !row.contract.no_self_hit
        && row.contract.ends == Boundary::Closed;
    let excludes = |(gate, text): &(&Gate, &EpsilonText)| {
        gate.role == Role::T && text.value::<f64>().is_some_and(|value| 0.0 < value)
    };
    let (gate, text) = row.tuned().filter(|_| promises).find(excludes)?;
    let name = gate.name;
    Some(format!(
        "its contract promises hits at the ends of the ray, and its epsilon {name} = {text} excludes those near the \
         start; if that is meant, promise less: --contract own,ends=free"
    ))
}

pub(super) fn provenance(plan: &Plan, audit: &Audit, context: &Context) -> Provenance {
    let mut provenance = provenance_of(context);
    provenance.kernel_notes = kernel_notes(&plan.rows);
    let mut cases: BTreeMap<ScalarName, (u64, u64)> = BTreeMap::new();
    for summary in &audit.sources {
        let sum = cases.entry(summary.scalar).or_default();
        sum.0 += summary.oracle_nanoseconds;
        sum.1 += summary.cases;
        let layers = provenance.oracle_layers.entry(summary.scalar).or_default();
        for (name, count) in summary.layers.named() {
            *layers.entry(name.to_owned()).or_default() += count;
        }
    }
    let per = |time: u64, count: u64| time as f64 / count.max(1) as f64;
    for (scalar, (time, count)) in &cases {
        provenance
            .oracle_nanoseconds
            .insert(*scalar, per(*time, *count));
    }
    let mut times: BTreeMap<(ScalarName, usize), u64> = BTreeMap::new();
    for cell in &audit.cells {
        *times.entry((cell.scalar, cell.row)).or_default() += cell.nanoseconds;
    }
    for ((scalar, row), time) in times {
        let by_row = provenance.kernel_nanoseconds.entry(scalar).or_default();
        by_row.insert(plan.rows[row].label(), per(time, cases[&scalar].1));
    }
    provenance
}
