//! A study of a scene for people at a terminal: what to use, what it does, and the limits of each
//! number.

use super::answer::{Answer, answer};
use super::legend::legend;
use super::ranking;
use super::record::{SceneKernelPart, SceneRecord};
use super::words::{label, share};
use crate::case::{Scene, SceneKind};
use crate::report::Style;
use crate::report::elsewhere::{self, Compared};
use std::io::{self, Write};

/// The least width of a column of the tables.
const WIDTH: usize = 15;

/// Writes the recommendation first, then the evidence; of many kernels one table.
pub fn write(record: &SceneRecord, _: Style, out: &mut dyn Write) -> io::Result<()> {
    if ranking::is_needed(record) {
        return ranking::write(record, out);
    }
    for (i, part) in record.kernels.iter().enumerate() {
        if i > 0 {
            writeln!(out)?;
        }
        let answer = answer(record, part);
        match record.mesh {
            Some(_) => writeln!(out, "{}\n  {}", answer.title, answer.scene)?,
            None => writeln!(out, "{} in {}", answer.title, answer.scene)?,
        }
        for used in &answer.used {
            writeln!(out, "  {:<3}  {}", used.lead, used.text)?;
            used.notes.iter().try_for_each(|note| writeln!(out, "       {note}"))?;
        }
        effects(record, &answer, out)?;
        elsewhere(record, answer.name, part, out)?;
        limits(&answer, out)?;
        let (of, commands) = &answer.next;
        for (i, command) in commands.iter().enumerate() {
            let of = if i == 0 { format!("{of}:") } else { " ".repeat(of.len() + 1) };
            writeln!(out, "{of} {command}")?;
        }
    }
    writeln!(out)?;
    legend(record).iter().try_for_each(|line| writeln!(out, "{line}"))
}

fn effects(record: &SceneRecord, answer: &Answer, out: &mut dyn Write) -> io::Result<()> {
    let title = format!("wrong on fresh rays (seed {}):", record.fresh_seed);
    let labels = answer.rows.iter().map(|(label, _)| label.chars().count());
    let first = labels.max().unwrap_or(0).max(30);
    write!(out, "{title:<0$}", first + 2)?;
    let all = answer.columns.iter().chain(answer.rows.iter().flat_map(|(_, row)| row));
    let width = all.map(|cell| cell.chars().count() + 1).max().unwrap_or(0).max(WIDTH);
    let cells = |cells: &[String], out: &mut dyn Write| {
        cells.iter().try_for_each(|cell| write!(out, "{cell:>width$}"))?;
        writeln!(out)
    };
    cells(&answer.columns, out)?;
    for (label, row) in &answer.rows {
        write!(out, "  {label:<first$}")?;
        cells(row, out)?;
    }
    Ok(())
}

/// Where the recommended epsilons are more often wrong on planes, or with rays, of other kinds.
fn elsewhere(
    record: &SceneRecord,
    name: &str,
    part: &SceneKernelPart,
    out: &mut dyn Write,
) -> io::Result<()> {
    let own = Scene::parse(&record.scene).map_or(SceneKind::ALL[0], |(scene, _)| scene.kind());
    let kinds: Vec<String> = [own.to_string()]
        .into_iter()
        .chain(part.elsewhere.iter().map(|other| other.plane.clone()))
        .collect();
    let rows: Vec<Compared> = (part.counts.iter().zip(&part.tried[0].wrong).enumerate())
        .map(|(place, (count, own))| Compared {
            label: format!("  {}", label(count)),
            own,
            others: part.elsewhere.iter().map(|other| &other.wrong[place]).collect(),
        })
        .collect();
    elsewhere::write(&format!("{name}: more often wrong"), &kinds, &rows, share, out)
}

fn limits(answer: &Answer, out: &mut dyn Write) -> io::Result<()> {
    if answer.limits.is_empty() {
        return Ok(());
    }
    let title = "limits, the other numbers fixed (95 %: 1 in 20 fails):";
    writeln!(out, "{title:<69}{:>12}{:>12}", "at most", "fresh rays")?;
    for row in &answer.limits {
        let star = if row.is_of_scene { " *" } else { "" };
        writeln!(
            out,
            "  {:<8} {:<29} {:<28}{:>12}{:>12}{star}",
            row.knob, row.bound, row.what, row.most, row.fresh
        )?;
    }
    for [conflict, instead] in &answer.conflicts {
        writeln!(out, "{conflict}\n  {instead}")?;
    }
    answer.prices.iter().try_for_each(|price| writeln!(out, "{price}"))
}
