//! The report of a campaign when it stops.

use super::directory::FINDS;
use crate::audit::quoted;
use crate::explore::campaign::{CampaignState, Find};
use crate::judge::Finding;
use std::collections::BTreeMap;
use std::io::{self, Write};

/// The moments of the table, in seconds.
const MOMENTS: [f64; 14] = [
    1.0, 2.0, 5.0, 10.0, 20.0, 30.0, 60.0, 120.0, 180.0, 300.0, 600.0, 1800.0, 3600.0, 36000.0,
];

/// Writes the summary of a campaign, to which this session added so many finds.
pub fn write_summary(
    out: &mut dyn Write,
    path: &str,
    finds: &[Find],
    new: usize,
    state: &CampaignState,
) -> io::Result<()> {
    let CampaignState {
        seconds,
        evaluations,
        sessions,
        ..
    } = state;
    let rate = *evaluations as f64 / seconds.max(1e-9);
    writeln!(
        out,
        "{path}: {} distinct signatures, {new} of them new; {evaluations} evaluations in {seconds:.1} s \
         ({rate:.0}/s, simplifying included), session {sessions}",
        finds.len()
    )?;
    write_growth(out, finds, *seconds)?;
    write_kernels(out, finds)?;
    if let Some(find) = finds.last() {
        let command = explain_command(find, &format!("{path}/{FINDS}"));
        writeln!(out, "The last one\n    {}\n    {command}", find.signature)?;
    }
    Ok(())
}

/// The command that shows a find.
pub fn explain_command(find: &Find, file: &str) -> String {
    find.row.explain_command(&format!(
        "{} --corpus {}",
        quoted(&find.name()),
        quoted(file)
    ))
}

/// How many signatures were known after how many seconds.
fn write_growth(out: &mut dyn Write, finds: &[Find], seconds: f64) -> io::Result<()> {
    let moments = MOMENTS
        .into_iter()
        .filter(|moment| *moment < seconds)
        .chain([seconds]);
    let known = |moment: f64| {
        let before = |find: &&Find| find.found.seconds.is_some_and(|seconds| seconds <= moment);
        finds.iter().filter(before).count()
    };
    writeln!(out, "Signatures known after so many seconds")?;
    moments
        .into_iter()
        .try_for_each(|moment| writeln!(out, "    {moment:>8.0}  {:>6}", known(moment)))
}

/// Signatures by kernel and finding.
fn write_kernels(out: &mut dyn Write, finds: &[Find]) -> io::Result<()> {
    let mut kernels: BTreeMap<&str, [usize; Finding::ALL.len()]> = BTreeMap::new();
    for find in finds {
        kernels.entry(find.signature.kernel).or_default()[find.signature.finding as usize] += 1;
    }
    let shown = [
        Finding::FalseMiss,
        Finding::FalseHit,
        Finding::BadValue,
        Finding::WrongValue,
    ];
    let head = shown
        .map(|finding| format!("{:>12}", finding.name()))
        .concat();
    writeln!(out, "Signatures by kernel {:>15}{head}", "all")?;
    for (kernel, counts) in kernels {
        let cells = shown
            .map(|finding| format!("{:>12}", counts[finding as usize]))
            .concat();
        writeln!(
            out,
            "    {kernel:<26}{:>6}{cells}",
            counts.iter().sum::<usize>()
        )?;
    }
    Ok(())
}
