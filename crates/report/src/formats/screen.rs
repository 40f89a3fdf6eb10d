//! The screen of `hairline audit`: the answer, one table with the best row first, the worst finding, and what to do next.
//! Everything else is behind `--details`.

use super::capitalised;
use super::columns::{Column, ColumnCell, ColumnSizes, kinds, shared_in_scenes, short_percent};
use super::lines::{RowLine, notes};
use super::row_view::{ALL_INVALID, RowView, cases_in, failures, is_all_invalid, rays_in};
use super::standing::{Standing, standings};
use super::{close_up, extremes, ranking, relations};
use crate::arith::ScalarName;
use crate::case::SceneKind;
use crate::elsewhere::{self, ComparedRates};
use crate::kernel;
use crate::page::{Block, Command};
use hairline_record::family_of;
use hairline_record::percent;
use hairline_record::*;
use hairline_record::{group_digits, number_of};

use std::collections::BTreeSet;

/// The most rows that the screen shows each by itself.
const MOST_CLOSE_UPS: usize = 2;

/// The answer, and everything below it on the screen.
pub(super) fn blocks(
    record: &Record,
    columns: &[Column],
    lines: &[RowLine],
) -> (String, Vec<Block>) {
    let standings = standings(record, columns, lines);
    let answer = answer(record, columns, &standings);
    // Mistakes explain the answer, so they come first.
    let mistakes: Vec<String> = relations::sentences(record)
        .iter()
        .map(|mistake| format!("{mistake}."))
        .collect();
    let (title, rest) = if mistakes.is_empty() {
        (answer[0].clone(), answer[1..].join(" "))
    } else {
        (mistakes.join(" "), answer.join(" "))
    };
    let mut blocks = vec![Block::Text(rest), Block::Text(head(record))];
    blocks.extend(notes(record));
    blocks.extend(shared_in_scenes(record).map(Block::text));
    for scalar in record.result.plan.scalars.iter().copied() {
        let cases = cases_in(record, scalar);
        if 0 < cases && is_all_invalid(&RowView::all(record, scalar), cases) {
            blocks.push(Block::Text(format!("{scalar}: {ALL_INVALID}")));
        }
    }
    blocks.extend(match is_close_up(record) {
        true => close_up::blocks(record, columns, lines),
        false => ranking::blocks(record, columns, &standings),
    });
    blocks.extend(of_elsewhere(record, columns, lines));
    let rows: Vec<&RowView> = lines.iter().map(|line| &line.row).collect();
    blocks.extend(failures(&rows).into_iter().map(Block::Text));
    let worst = if is_close_up(record) { 2 } else { 1 };
    blocks.extend(extremes::blocks(columns, lines, worst));
    let commands = next(record, ranking::best(&standings), lines);
    if !commands.is_empty() {
        blocks.push(Block::Commands("next", commands));
    }
    (title, blocks)
}

/// Which kernels ran, and on how many cases.
fn head(record: &Record) -> String {
    let (result, provenance) = (&record.result, &record.provenance);
    let counted = |scalar: ScalarName| [cases_in(record, scalar), rays_in(record, scalar)];
    // Usually as many in each scalar.
    let mut counts: Vec<([u64; 2], Vec<&str>)> = Vec::new();
    for scalar in result.plan.scalars.iter().copied() {
        match counts.last_mut() {
            Some((count, names)) if *count == counted(scalar) => names.push(scalar.name()),
            _ => counts.push((counted(scalar), vec![scalar.name()])),
        }
    }
    let counts = counts.iter().map(|([cases, rays], names)| {
        let rays = match cases == rays {
            true => String::new(),
            false => format!(" of {}", number_of(*rays, "ray", "rays")),
        };
        format!(
            "{}{rays} in {}",
            number_of(*cases, "case", "cases"),
            names.join(" and in ")
        )
    });
    let sources = &result.plan.sources;
    let families: BTreeSet<Option<&str>> = sources
        .iter()
        .map(|source| Some(family_of(&source.family)?.name))
        .collect();
    let sources = match families.contains(&None) {
        false => number_of(families.len() as u64, "family", "families"),
        true => number_of(sources.len() as u64, "source of cases", "sources of cases"),
    };
    let kinds = match kinds(record).len() {
        1 => String::new(),
        several => format!(" in {several} kinds of planes and rays"),
    };
    let placed = if result.is_placed() {
        " in an instance"
    } else {
        ""
    };
    let kernels: BTreeSet<&str> = result.plan.rows.iter().map(|row| &*row.kernel).collect();
    format!(
        "{}: {} ({}) on {sources}{kinds}{placed}, {}, {:.1} s, plan {}",
        provenance.tool,
        number_of(result.plan.rows.len() as u64, "row", "rows"),
        number_of(kernels.len() as u64, "kernel", "kernels"),
        counts.collect::<Vec<_>>().join(", "),
        provenance.seconds,
        result.plan.hash,
    )
}

/// True if there are so few kernels that each has a table of its own.
fn is_close_up(record: &Record) -> bool {
    record.result.plan.rows.len() <= MOST_CLOSE_UPS
}

/// The answer, a sentence each: at least one.
fn answer(record: &Record, columns: &[Column], standings: &[Standing]) -> Vec<String> {
    let place = but_for(record, columns);
    let mut sentences = match standings {
        _ if columns.is_empty() => {
            vec!["No case has both a verdict and a contract that demands one.".to_owned()]
        }
        all if all.iter().all(|row| row.share.is_none()) => {
            vec!["Every case has extreme exponents.".to_owned()]
        }
        [only] => {
            let mut sentences = of_one(only, columns, judged(record, columns));
            sentences.push(share_of_one(only, columns, &place));
            sentences
        }
        all => ranking::answer(all, judged(record, columns), &place),
    };
    // Of several the table tells.
    if let [only] = standings {
        let (across, others): (Vec<_>, Vec<_>) = only
            .others
            .iter()
            .map(|(kind, count)| (*kind, *count))
            .partition(|(kind, _)| is_across(*kind));
        let broken = "Breaks its promise across triangles (in all sizes)";
        sentences.extend(counted(broken, &across));
        sentences.extend(counted("Besides", &others));
    }
    sentences.extend(record.result.partial.as_ref().map(|part| part.sentence()));
    sentences
}

/// The sizes that the answer leaves out, in words after a sentence; none if it is about all.
fn but_for(record: &Record, columns: &[Column]) -> String {
    let special: Vec<&str> = columns
        .iter()
        .filter(|column| !column.is_ordinary())
        .map(|column| column.label())
        .collect();
    if special.is_empty() {
        String::new()
    } else if is_close_up(record) {
        // Each is a row of a close-up.
        format!(" ({} left out)", special.join(" and "))
    } else if special.contains(&"invalid") {
        " but for extreme exponents and invalid input".to_owned()
    } else {
        " but for extreme exponents".to_owned()
    }
}

/// How often one row is wrong, in a sentence.
fn share_of_one(row: &Standing, columns: &[Column], place: &str) -> String {
    if row.wrong == 0 {
        return match row.others.is_empty() {
            true => format!("Every verdict is right{place}."),
            false => format!("No false miss and no false hit{place}."),
        };
    }
    let samples = columns
        .iter()
        .filter(|column| column.is_ordinary() && !column.complete)
        .count();
    let mean = if 1 < samples {
        ", the mean of the rows"
    } else {
        ""
    };
    let share = row.share.unwrap_or_default();
    let percent = short_percent([(share * 1e9) as u64, 1_000_000_000]);
    format!("Wrong on {percent} % of the cases{mean}{place}.")
}

/// True if a finding is about several triangles together.
fn is_across(kind: FindingKind) -> bool {
    matches!(
        kind,
        FindingKind::Crack | FindingKind::Double | FindingKind::OddFold
    )
}

/// Some kinds of findings with their counts, in a sentence; none without one.
fn counted(lead: &str, counts: &[(FindingKind, u64)]) -> Option<String> {
    let counts: Vec<String> = counts
        .iter()
        .map(|(kind, count)| {
            let ending = if kind.name().ends_with(['s', 'h']) {
                "es"
            } else {
                "s"
            };
            number_of(*count, kind.name(), &format!("{kind}{ending}"))
        })
        .collect();
    (!counts.is_empty()).then(|| format!("{lead}: {}.", counts.join(", ")))
}

/// The answer about one row, a sentence each: does it leak, how many errors can be seen, and in which sizes?
fn of_one(row: &Standing, columns: &[Column], cases: u64) -> Vec<String> {
    let label = row.part.label();
    let mut sentences = Vec::new();
    if let Some([leaks, rays]) = row.leaks() {
        let rays = group_digits(rays);
        sentences.push(match leaks {
            0 => format!(
                "{label}: no leak seen in {rays} rays at shared edges and vertices{}.",
                at_extremes(row)
            ),
            _ => format!(
                "{label} leaks: {} of {rays} rays at shared edges and vertices hit nothing.",
                group_digits(leaks)
            ),
        });
    }
    let seen = "by over 1/1000 of an edge, values included";
    let cases = group_digits(cases);
    let visible = match row.all_far() {
        0 => format!("no visible error ({seen}) in {cases} answers"),
        count => format!(
            "visible errors ({seen}): {} of {cases} answers",
            group_digits(count)
        ),
    };
    sentences.push(if sentences.is_empty() {
        format!("{label}: {visible}.")
    } else {
        format!("{}.", capitalised(&visible))
    });
    let sizes = [
        (ColumnSizes::Ordinary, "in ordinary sizes"),
        (ColumnSizes::Unusual, "at tiny, huge, far or thin triangles"),
        (ColumnSizes::Extreme, "at extreme exponents"),
    ];
    let by_size: Vec<String> = sizes
        .into_iter()
        .filter(|(sizes, _)| columns.iter().any(|column| column.sizes() == *sizes))
        .map(|(sizes, words)| match row.visible_in(sizes) {
            0 => format!("none {words}"),
            count => format!("{} {words}", group_digits(count)),
        })
        .collect();
    sentences.push(format!("By size: {}.", by_size.join(", ")));
    sentences
}

/// The leaks that a row has at no ordinary sizes: `; 2,004 of 13,547 leak next to noise or at extreme exponents`.
fn at_extremes(row: &Standing) -> String {
    match row.extreme_leaks() {
        [0, _] => String::new(),
        [leaks, rays] => format!(
            "; {} of {} leak next to noise or at extreme exponents",
            group_digits(leaks),
            group_digits(rays)
        ),
    }
}

/// The cases of a record in some columns but for those of extreme exponents, in all scalars.
fn judged(record: &Record, columns: &[Column]) -> u64 {
    let is_judged = |source: &&SourcePart| {
        columns
            .iter()
            .any(|column| column.is_ordinary() && column.has(source))
    };
    record
        .result
        .sources
        .iter()
        .filter(is_judged)
        .map(|source| source.cases)
        .sum()
}

/// Which rows are more often wrong on planes, or with rays, of other kinds than the table's, and where most.
fn of_elsewhere(record: &Record, columns: &[Column], lines: &[RowLine]) -> Vec<Block> {
    let kinds = kinds(record);
    let compared = |line: &RowLine, column: &Column| ComparedRates {
        label: format!("{}, {}: {}", line.label(), line.row.scalar, column.label()),
        rates: (kinds.iter())
            .map(|kind| ColumnCell::sum(&column.of_kind(*kind).results(&line.row)))
            .map(|cell| Rate::new(cell.wrong, true))
            .collect(),
    };
    let rows = lines
        .iter()
        .flat_map(|line| columns.iter().map(|column| compared(line, column)));
    let names: Vec<String> = kinds.iter().map(SceneKind::to_string).collect();
    let share = |rate: &Rate| rate.rate.map_or("-".to_owned(), percent);
    let mut blocks = elsewhere::blocks(
        "Clearly more often wrong",
        &names,
        &rows.collect::<Vec<_>>(),
        share,
    );
    if !blocks.is_empty() {
        let words = kinds[1..]
            .iter()
            .map(|kind| format!("{kind}: {}", kind.in_words()));
        let of = "Shares are of all verdicts that are demanded, misses and hits together.";
        blocks.push(Block::Text(format!(
            "{}. {of}",
            words.collect::<Vec<_>>().join("; ")
        )));
    }
    blocks
}

/// The commands that lead on.
fn next(record: &Record, best: Option<&RowPart>, lines: &[RowLine]) -> Vec<Command> {
    // The product of `verify` cannot be chosen by a flag.
    let all = best
        .into_iter()
        .chain(lines.iter().map(|line| line.row.part));
    let mut rows: Vec<&RowPart> = all.filter(|row| !row.selector.is_empty()).collect();
    // Those of one's own among others first.
    rows.sort_by_key(|row| kernel::find(&row.kernel).is_some_and(|entry| entry.is_built_in()));
    let Some(first) = rows.first() else {
        return Vec::new();
    };
    let tuned = rows.iter().find(|row| row.is_tunable());
    let spaced = |words: &str| {
        if words.is_empty() {
            String::new()
        } else {
            format!(" {words}")
        }
    };
    let flags = record.provenance.plan_flags.clone().unwrap_or_default();
    let [kernels, all_sources] = [&flags.kernels, &flags.sources].map(|words| spaced(words));
    let is_alone = rows.iter().all(|row| row.selector == first.selector);
    let mut commands: Vec<Command> = Vec::new();
    if !is_alone {
        let is_own = kernel::find(&first.kernel).is_some_and(|entry| !entry.is_built_in());
        let one = if is_own {
            first
        } else {
            tuned.unwrap_or(first)
        };
        let line = format!("hairline audit {}{all_sources}", one.selector);
        commands.push(Command {
            line,
            what: "one kernel",
        });
    }
    if let (Some(tuned), Some(sources)) = (tuned, &flags.epsilon) {
        commands.push(Command {
            line: format!("hairline epsilon {}{}", tuned.selector, spaced(sources)),
            what: "choose an epsilon",
        });
    }
    let line = format!("hairline check{kernels}{all_sources} --bless");
    commands.push(Command {
        line,
        what: "gate a CI; writes files",
    });
    commands
}
