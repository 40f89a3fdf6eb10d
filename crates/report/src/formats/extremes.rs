//! The worst findings of a record, in words, each with the command that shows it.

use super::columns::{Column, is_of_ordinary_size};
use super::lines::RowLine;
use super::worst::{cause, describe, severity};
use crate::audit::Attribution;
use crate::judge::Class;
use crate::page::{Block, Item};
use hairline_record::group_digits;
use hairline_record::*;

/// A class of findings, by its worst case.
#[derive(Clone, Copy)]
struct Extreme<'a> {
    line: &'a RowLine<'a>,
    part: &'a FindingPart,
}

/// A promise across triangles that was broken, and the worst verdicts but for those at extreme exponents; at most so many.
pub(super) fn blocks(columns: &[Column], lines: &[RowLine], most: usize) -> Vec<Block> {
    let broken = |extremes: bool| {
        let is_so = |line: &&RowLine| {
            line.across
                .as_ref()
                .is_some_and(|it| it.is_broken_by_extremes() == extremes)
        };
        lines
            .iter()
            .filter(is_so)
            .find_map(|line| Some((line, broken_promise(line)?)))
    };
    let broken = broken(false).or_else(|| broken(true));
    let worst = chosen(all(columns, lines), most - usize::from(broken.is_some()));
    let is_all = columns.iter().all(|column| column.is_ordinary());
    let place = if is_all {
        ""
    } else {
        " but for extreme exponents"
    };
    let head = match most {
        1 => format!("Worst{place}, in longest edges of the triangle:"),
        _ => format!("Worst{place}, in longest edges, of different causes:"),
    };
    let commands = broken.into_iter().map(|(line, (text, command))| {
        (
            format!("{}, {}: {text}", line.label(), line.row.scalar),
            command,
        )
    });
    let worst = worst.iter().map(|Extreme { line, part }| {
        let text = format!("{}, {}: {}", line.label(), line.row.scalar, describe(part));
        (text, part.worst.command.clone())
    });
    let item = |(number, (text, command)): (usize, (String, String))| {
        Item::shown_by(format!("{}. {text}", number + 1), command)
    };
    Block::items(
        &head,
        most,
        commands.chain(worst).enumerate().map(item).collect(),
    )
}

/// The promise across triangles that a row broke, and the command that shows the first case.
fn broken_promise(line: &RowLine) -> Option<(String, String)> {
    let across = line.across.as_ref().filter(|across| across.is_broken())?;
    let by_extremes = across.is_broken_by_extremes();
    let results = line.row.results.iter().copied();
    let (shown, others): (Vec<_>, Vec<_>) =
        results.partition(|result| is_of_ordinary_size(&result.family) != by_extremes);
    let first = |ids: fn(&AcrossPart) -> &[String]| {
        let first = |result: &KernelResult| Some(ids(result.across.as_ref()?).first()?.clone());
        let mut results = shown.iter().chain(&others);
        results.find_map(|result| Some((*result, first(result)?)))
    };
    let [no_crack, _] = across.rules_out();
    let (what, [count, of], (result, id)) = if by_extremes {
        let what = "next to noise or at extreme exponents no triangle reports";
        (
            what,
            across.extreme_cracks,
            first(|part| &part.first_cracks)?,
        )
    } else if no_crack && 0 < across.cracks[0] {
        (
            "no triangle reports",
            across.cracks,
            first(|part| &part.first_cracks)?,
        )
    } else {
        (
            "two triangles report",
            across.doubles,
            first(|part| &part.first_doubles)?,
        )
    };
    let (count, of) = (group_digits(count), group_digits(of));
    let text = format!("broken promise, {what} {count} of {of} crossings");
    Some((text, result.explain_group(line.row.part, &id)))
}

/// The worst of each class of false misses, false hits and wrong values but for extreme exponents. A triangle without area may
/// be a point, which has no edge to measure by.
fn all<'a>(columns: &[Column], lines: &'a [RowLine<'a>]) -> Vec<Extreme<'a>> {
    let mut all = Vec::new();
    for line in lines {
        for column in columns.iter().filter(|column| column.is_ordinary()) {
            let results = column.results(&line.row).into_iter();
            let parts = results.flat_map(|result| &result.findings).filter(|part| {
                (part.finding.is_wrong_verdict() || part.finding == FindingKind::WrongValue)
                    && !part.class.truth().is_some_and(Class::is_degenerate)
            });
            let parts = parts.filter(|part| part.worst.severity.is_some());
            all.extend(parts.map(|part| Extreme { line, part }));
        }
    }
    all
}

/// The worst, and the worst of another cause, or else of another kind; at most so many.
fn chosen(mut all: Vec<Extreme>, most: usize) -> Vec<Extreme> {
    all.sort_by(|a, b| severity(b.part).total_cmp(&severity(a.part)));
    let other = |differs: &dyn Fn(&Extreme) -> bool| all.iter().position(differs);
    let second = all.first().and_then(|first| {
        let of_cause = other(&|it| group(it.part) != group(first.part));
        of_cause.or_else(|| other(&|it| it.part.finding != first.part.finding))
    });
    let places = (!all.is_empty()).then_some(0).into_iter().chain(second);
    places.take(most).map(|place| all[place]).collect()
}

/// Causes that are alike: rounding, overflow and underflow are all the arithmetic.
fn group(part: &FindingPart) -> Option<Attribution> {
    cause(part).map(|it| {
        if it == Attribution::Range {
            Attribution::Rounding
        } else {
            it
        }
    })
}
