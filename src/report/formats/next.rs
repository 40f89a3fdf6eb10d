//! The end of what `hairline audit` prints: the commands that lead on.

use super::Style;
use super::lines::Line;
use super::record::{Record, RowPart};
use crate::kernel;
use std::io::{self, Write};

/// Writes them.
pub(super) fn write(
    record: &Record,
    best: Option<&RowPart>,
    lines: &[Line],
    style: Style,
    out: &mut dyn Write,
) -> io::Result<()> {
    let (bold, plain) = if style.color { ("\x1b[1m", "\x1b[0m") } else { ("", "") };
    // The product of `verify` cannot be chosen by a flag.
    let all = best.into_iter().chain(lines.iter().map(|line| line.row.part));
    let rows: Vec<&RowPart> = all.filter(|row| !row.selector.is_empty()).collect();
    let Some(first) = rows.first() else {
        return writeln!(out, "{bold}next:{plain} --details  # everything");
    };
    let tells_margins = |row: &&&RowPart| {
        let entry = kernel::find(&row.kernel);
        !row.epsilons.is_empty() && entry.is_some_and(|entry| entry.tells_margins())
    };
    let tuned = rows.iter().find(tells_margins);
    let sources = record.provenance.plan_flags.as_ref().map_or("", |flags| flags.sources.as_str());
    let sources = if sources.is_empty() { String::new() } else { format!(" {sources}") };
    let is_alone = rows.iter().all(|row| row.selector == first.selector);
    let mut commands: Vec<(String, &str)> = Vec::new();
    if !is_alone {
        let one = tuned.unwrap_or(first);
        commands.push((format!("hairline audit {}{sources}", one.selector), "one kernel"));
    }
    let all_sources = sources.clone();
    if let Some(tuned) = tuned {
        // `epsilon` knows no rays at a mesh's edges, and takes a scene whole.
        let sources = sources.split(" --directions").next().unwrap_or_default();
        let sources = if sources.contains(" --scene ") {
            without_families(sources)
        } else {
            sources.to_owned()
        };
        let command = format!("hairline epsilon {}{sources}", tuned.selector);
        commands.push((command, "choose an epsilon"));
    }
    let kernels = record.provenance.plan_flags.as_ref().map_or("", |flags| flags.kernels.as_str());
    let kernels = if kernels.is_empty() { String::new() } else { format!(" {kernels}") };
    commands.push((format!("hairline check{kernels}{all_sources} --bless"), "gate a CI"));
    commands.push(("--details, or --format html -o report.html".to_owned(), "everything"));
    for (i, (command, what)) in commands.iter().enumerate() {
        let lead = if i == 0 { format!("{bold}next:{plain}") } else { "     ".to_owned() };
        match "next:   # ".len() + command.chars().count() + what.len() <= style.width {
            true => writeln!(out, "{lead} {command}  # {what}")?,
            false => writeln!(out, "{lead} {command}")?,
        }
    }
    Ok(())
}

/// Flags without the families among them.
fn without_families(flags: &str) -> String {
    let words: Vec<&str> = flags.split(' ').collect();
    let is_of_family = |i: &usize| words[*i] == "--family" || 0 < *i && words[i - 1] == "--family";
    let kept = (0..words.len()).filter(|i| !is_of_family(i)).map(|i| words[i]);
    kept.collect::<Vec<_>>().join(" ")
}
