//! Which kernel for a scene: all kernels in one table, the one that costs least first.

use super::answer::{USE, answer, is_scale_free_better};
use super::commands::of_kernel;
use super::notes::few_rays;
use super::record::{Kind, SceneKernelPart, SceneRecord, Stratum, TriedPart};
use super::words::{human, of_unit, share, spaced};
use crate::report::record::Rate;
use std::io::{self, Write};

/// The smallest triangle is so many of a scalar's steps long, or longer, where its numbers are fine enough: then
/// rounding moves a vertex by less than can be seen.
const FINE: f64 = 1000.0;

/// One row: kernels that answer alike.
struct Row<'a> {
    part: &'a SceneKernelPart,
    /// The results of what its `use` line says.
    best: &'a TriedPart,
    /// The others that do the same with the same numbers.
    alike: Vec<&'a str>,
}

/// True if a record has too many kernels for a screen of each.
pub(super) fn is_needed(record: &SceneRecord) -> bool {
    let mut names: Vec<&str> = record.kernels.iter().map(|part| part.kernel.as_str()).collect();
    names.dedup();
    2 < names.len()
}

/// Writes a table for each scalar, and what to run next.
pub(super) fn write(record: &SceneRecord, out: &mut dyn Write) -> io::Result<()> {
    let scene = match &record.mesh {
        Some(mesh) => mesh.path.as_str(),
        None => record.scene.as_str(),
    };
    writeln!(out, "kernels with their best epsilons in {scene}{}", of_unit(&record.unit))?;
    few_rays(record).map_or(Ok(()), |note| writeln!(out, "{note}"))?;
    let all = ["f32", "f64"].map(|scalar| (scalar, rows(record, scalar)));
    let scalars = all.iter().filter(|(_, rows)| !rows.is_empty()).count();
    // About as many lines as a screen has.
    let most = if scalars == 1 { 7 } else { 3 };
    for (scalar, rows) in &all {
        let Some(best) = rows.first() else { continue };
        writeln!(out, "\n{}", fitness(record, best.part))?;
        let [cost, leaks, lost, self_hits] = ["cost", "leaks", "lost inside", "self-hits"];
        writeln!(out, "{scalar:<28}{cost:>6}{leaks:>13}{lost:>13}{self_hits:>13}")?;
        for row in rows.iter().take(most) {
            write_row(record, row, out)?;
        }
        let more: usize = rows.iter().skip(most).map(|row| 1 + row.alike.len()).sum();
        if 0 < more {
            writeln!(out, "and {more} more kernels, none cheaper (--format csv lists all)")?;
        }
    }
    writeln!(
        out,
        "\nleaks: at shared edges or vertices; lost inside: hits inside a triangle; self-hits: of shadow rays (-: the\n\
         kernel has no t). Shares are of rays aimed there, not of your pixels. cost: each share times its weight; false\n\
         hits and rays almost parallel to their triangle also count"
    )?;
    let shown = || all.iter().flat_map(|(_, rows)| rows.iter().take(most));
    if shown().any(|row| is_scale_free_better(record, row.part)) {
        writeln!(out, "L: the triangle's longest edge; M: the largest coordinate")?;
    }
    let is_fit = |row: &&Row| FINE <= steps(record, row.part);
    match shown().find(is_fit).or(shown().next()) {
        Some(best) => {
            let command = of_kernel(record, best.part);
            writeln!(out, "next: {command}  # what each number does")
        }
        None => Ok(()),
    }
}

/// The rows of a scalar, the cheapest first.
fn rows<'a>(record: &'a SceneRecord, scalar: &str) -> Vec<Row<'a>> {
    let best = |part: &'a SceneKernelPart| match &part.relative {
        Some(relative) if is_scale_free_better(record, part) => relative,
        _ => &part.tried[0],
    };
    let parts = record.kernels.iter().filter(|part| part.scalar == scalar);
    let mut parts: Vec<_> = parts.map(|part| (part, best(part))).collect();
    parts.sort_by(|(_, a), (_, b)| a.cost.total_cmp(&b.cost));
    let mut rows: Vec<Row> = Vec::new();
    for (part, best) in parts {
        match rows.iter_mut().find(|row| row.is_like(part, best)) {
            Some(row) => row.alike.push(&part.kernel),
            None => rows.push(Row { part, best, alike: Vec::new() }),
        }
    }
    rows
}

impl Row<'_> {
    /// True if another kernel was wrong as often with the same numbers.
    fn is_like(&self, part: &SceneKernelPart, best: &TriedPart) -> bool {
        let wrong = |tried: &TriedPart| -> Vec<[u64; 2]> {
            tried.wrong.iter().map(|rate| [rate.count, rate.of]).collect()
        };
        self.part.counts == part.counts
            && self.best.epsilons == best.epsilons
            && wrong(self.best) == wrong(best)
    }
}

fn write_row(record: &SceneRecord, row: &Row, out: &mut dyn Write) -> io::Result<()> {
    let Row { part, best, .. } = row;
    let cell = |is_of: fn(Stratum, Kind) -> bool| {
        let counts = part.counts.iter().zip(&best.wrong);
        let rates = counts.filter(|(count, _)| is_of(count.stratum, count.kind));
        let worst = |a: &&Rate, b: &&Rate| a.rate.unwrap_or(0.0).total_cmp(&b.rate.unwrap_or(0.0));
        rates.map(|(_, rate)| rate).max_by(worst).map_or("-".to_owned(), share)
    };
    let leaks = cell(|_, kind| kind == Kind::Crack);
    let lost = cell(|stratum, kind| (stratum, kind) == (Stratum::Interior, Kind::Miss));
    let self_hits = cell(|_, kind| kind == Kind::SelfHit);
    let (kernel, cost) = (&part.kernel, best.cost);
    writeln!(out, "{kernel:<28}{cost:>6.3}{leaks:>13}{lost:>13}{self_hits:>13}")?;
    let answer = answer(record, part);
    if let Some(used) = answer.used.first() {
        let lead = if used.lead == USE { "use" } else { "no numbers are good; least bad:" };
        writeln!(out, "  {lead} {}", used.text)?;
    }
    match row.alike.is_empty() {
        true => Ok(()),
        false => writeln!(out, "  as often wrong with the same numbers: {}", row.alike.join(", ")),
    }
}

/// The length of the smallest triangle's longest edge in steps of the scalar's numbers at the far end.
fn steps(record: &SceneRecord, part: &SceneKernelPart) -> f64 {
    record.edge[0] / part.spacing
}

/// A sentence that says if the scalar's numbers are fine enough for the scene's smallest triangles.
fn fitness(record: &SceneRecord, part: &SceneKernelPart) -> String {
    let SceneKernelPart { scalar, spacing, .. } = part;
    let apart = format!("{}{}", human(&format!("{spacing:.1e}")), spaced(&record.unit));
    let numbers = format!("its numbers are {apart} apart at the far end");
    let parts = steps(record, part).round().max(1.0);
    if FINE <= parts {
        let smallest = "below a thousandth of the smallest triangle's longest edge";
        return format!("{scalar} is fit for this scene: {numbers},\n  {smallest}");
    }
    let wider = if scalar == "f32" { "use f64, or " } else { "" };
    format!(
        "{scalar} is coarse for this scene: {numbers},\n  1/{parts} of the smallest triangle's longest edge: {wider}move the origin to the camera"
    )
}
