//! The end of what `hairline audit` prints: the commands that lead on.

use super::lines::RowLine;
use super::record::{Record, RowPart};
use crate::kernel;
use crate::report::page::Command;

/// The commands.
pub(super) fn commands(record: &Record, best: Option<&RowPart>, lines: &[RowLine]) -> Vec<Command> {
    // The product of `verify` cannot be chosen by a flag.
    let all = best.into_iter().chain(lines.iter().map(|line| line.row.part));
    let mut rows: Vec<&RowPart> = all.filter(|row| !row.selector.is_empty()).collect();
    // Those of one's own among others first.
    rows.sort_by_key(|row| kernel::find(&row.kernel).is_some_and(|entry| entry.is_built_in()));
    let Some(first) = rows.first() else {
        return Vec::new();
    };
    let tells_margins = |row: &&&RowPart| {
        let entry = kernel::find(&row.kernel);
        !row.epsilons.is_empty() && entry.is_some_and(|entry| entry.tells_margins())
    };
    let tuned = rows.iter().find(tells_margins);
    let sources = record.provenance.plan_flags.as_ref().map_or("", |flags| flags.sources.as_str());
    let sources = if sources.is_empty() { String::new() } else { format!(" {sources}") };
    let is_alone = rows.iter().all(|row| row.selector == first.selector);
    let mut commands: Vec<Command> = Vec::new();
    if !is_alone {
        let is_own = kernel::find(&first.kernel).is_some_and(|entry| !entry.is_built_in());
        let one = if is_own { first } else { tuned.unwrap_or(first) };
        let line = format!("hairline audit {}{sources}", one.selector);
        commands.push(Command { line, what: "one kernel" });
    }
    let all_sources = sources.clone();
    // No epsilon is chosen in instances.
    if let Some(tuned) = tuned.filter(|_| !sources.contains(" --instance ")) {
        // `epsilon` knows no rays at a mesh's edges, and takes a scene whole.
        let sources = sources.split(" --directions").next().unwrap_or_default();
        let sources = if sources.contains(" --scene ") {
            without_families(sources)
        } else {
            sources.to_owned()
        };
        let line = format!("hairline epsilon {}{sources}", tuned.selector);
        commands.push(Command { line, what: "choose an epsilon" });
    }
    let kernels = record.provenance.plan_flags.as_ref().map_or("", |flags| flags.kernels.as_str());
    let kernels = if kernels.is_empty() { String::new() } else { format!(" {kernels}") };
    let line = format!("hairline check{kernels}{all_sources} --bless");
    commands.push(Command { line, what: "gate a CI; writes files" });
    commands
}

/// Flags without the families among them.
fn without_families(flags: &str) -> String {
    let words: Vec<&str> = flags.split(' ').collect();
    let is_of_family = |i: &usize| words[*i] == "--family" || 0 < *i && words[i - 1] == "--family";
    let kept = (0..words.len()).filter(|i| !is_of_family(i)).map(|i| words[i]);
    kept.collect::<Vec<_>>().join(" ")
}
