//! The screen of `hairline audit`: the answer, a table with a column for each question, the worst
//! findings, and what to do next. Everything else is behind `--details`.

use super::columns::{Across, Cell, Column, kinds, shared_in_scenes, short_percent};
use super::disagreement::{Key, disagreements, family_of, is_shared_in_scene};
use super::lines::{Line, column_legend, lines, write_notes, write_wrapped};
use super::record::*;
use super::row_view::{ALL_INVALID, RowView, is_all_invalid, write_failures};
use super::{Style, close_up, extremes, group_digits, next, number_of};
use crate::case::SceneKind;
use crate::report::elsewhere::is_worse;
use crate::report::percent;
use std::cmp::Ordering;
use std::collections::{BTreeMap, BTreeSet};
use std::io::{self, Write};

/// The most rows that the screen shows each by itself.
const MOST_CLOSE_UPS: usize = 2;

/// Writes the screen.
pub(super) fn write(record: &Record, style: Style, out: &mut dyn Write) -> io::Result<()> {
    let columns = Column::all(record);
    let lines = lines(record, &columns);
    write_head(record, out)?;
    write_notes(record, out)?;
    write_answer(record, &columns, &lines, out)?;
    if let Some(note) = shared_in_scenes(record) {
        write_wrapped(note, out)?;
    }
    for scalar in &record.result.plan.scalars {
        let cases = record.result.sources.iter().filter(|source| source.scalar == *scalar);
        let cases = cases.map(|source| source.cases).sum();
        if 0 < cases && is_all_invalid(&RowView::all(record, scalar), cases) {
            writeln!(out, "{scalar}: {ALL_INVALID}")?;
        }
    }
    if is_close_up(record) {
        close_up::write(record, &columns, &lines, style, out)?;
    } else {
        write_cell_legend(&columns, &lines, out)?;
        writeln!(out)?;
        write_table(&columns, &lines, style, out)?;
        write_wrapped(&column_legend(&columns, &lines), out)?;
    }
    write_elsewhere(record, &columns, &lines, out)?;
    for scalar in &record.result.plan.scalars {
        let rows = lines.iter().filter(|line| line.row.scalar == scalar).map(|line| &line.row);
        write_failures(&rows.collect::<Vec<_>>(), out)?;
    }
    extremes::write(&columns, &lines, style, out)?;
    next::write(record, &lines, style, out)
}

/// Writes which kernels ran, and on how many cases.
fn write_head(record: &Record, out: &mut dyn Write) -> io::Result<()> {
    let (result, provenance) = (&record.result, &record.provenance);
    let cases = |scalar: &String| {
        let sources = result.sources.iter().filter(|source| source.scalar == *scalar);
        sources.map(|source| source.cases).sum::<u64>()
    };
    // Usually as many in each scalar.
    let mut counts: Vec<(u64, Vec<&str>)> = Vec::new();
    for scalar in &result.plan.scalars {
        match counts.last_mut() {
            Some((count, names)) if *count == cases(scalar) => names.push(scalar),
            _ => counts.push((cases(scalar), vec![scalar])),
        }
    }
    let counts = counts.iter().map(|(count, names)| {
        format!("{} in {}", number_of(*count, "case", "cases"), names.join(" and in "))
    });
    let sources = &result.plan.sources;
    let families: BTreeSet<Option<&str>> =
        sources.iter().map(|source| Some(family_of(&source.family)?.name)).collect();
    let sources = match families.contains(&None) {
        false => number_of(families.len() as u64, "family", "families"),
        true => number_of(sources.len() as u64, "source of cases", "sources of cases"),
    };
    let kinds = match kinds(record).len() {
        1 => String::new(),
        several => format!(" in {several} kinds of planes and rays"),
    };
    let kernels: BTreeSet<&str> = result.plan.rows.iter().map(|row| &*row.kernel).collect();
    writeln!(
        out,
        "{}: {} ({}) on {sources}{kinds}, {}, {:.1} s, plan {}",
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

/// How one row did in all scalars, in the columns of ordinary sizes.
struct Standing {
    label: String,
    /// The mean of the cells' shares.
    share: f64,
    wrong: u64,
    /// Wrong verdicts that can be seen, and wrong values.
    far: u64,
    far_values: u64,
    /// The other breaches of the contract, on any case: `crash`, `bad-value`, `crack`, ….
    others: BTreeMap<FindingKind, u64>,
}

impl Standing {
    /// How many answers are off so far that it can be seen.
    fn all_far(&self) -> u64 {
        self.far + self.far_values
    }
}

/// How often a row broke its contract in other ways than by false misses and false hits of single cases.
fn other_findings(record: &Record, part: &RowPart) -> BTreeMap<FindingKind, u64> {
    let mut others = BTreeMap::new();
    for found in disagreements(&record.result) {
        let Key { kernel, set, family, finding, .. } = found.key;
        // Cracks at the shared edges and vertices of a scene are in the shares, promised or not.
        let is_in_shares = finding.is_wrong_verdict()
            || finding == FindingKind::Crack && is_shared_in_scene(&family);
        if (&kernel, &set) == (&part.kernel, &part.set) && !is_in_shares {
            *others.entry(finding).or_default() += found.rate.count;
        }
    }
    others
}

fn standings(record: &Record, columns: &[Column], lines: &[Line]) -> Vec<Standing> {
    let everywhere = Column::in_all_kinds(record);
    let wrong_in = |columns: &[Column], line: &Line| -> u64 {
        let columns = columns.iter().filter(|column| column.is_ordinary());
        columns.map(|column| Cell::sum(&column.results(&line.row)).wrong.count).sum()
    };
    // Stored cases stay out of the mean of samples.
    let all_complete = columns.iter().all(|column| column.complete);
    let of_row = |part: &RowPart| {
        let lines = lines.iter().filter(|line| std::ptr::eq(line.row.part, part));
        let cells: Vec<(&Column, &Cell)> = lines
            .clone()
            .flat_map(|line| columns.iter().zip(&line.cells))
            .filter(|(column, cell)| column.is_ordinary() && 0 < cell.wrong.of)
            .collect();
        let meant = cells.iter().filter(|(column, _)| column.complete == all_complete);
        let shares: Vec<f64> = meant.filter_map(|(_, cell)| cell.wrong.share()).collect();
        (!shares.is_empty()).then(|| Standing {
            label: format!("{} ({})", part.kernel, part.set),
            share: shares.iter().sum::<f64>() / shares.len() as f64,
            wrong: lines.clone().map(|line| wrong_in(&everywhere, line)).sum(),
            far: cells.iter().map(|(_, cell)| cell.far).sum(),
            far_values: lines.clone().map(|line| line.values.far).sum(),
            others: other_findings(record, part),
        })
    };
    record.result.plan.rows.iter().filter_map(of_row).collect()
}

/// The answer in words.
fn write_answer(
    record: &Record,
    columns: &[Column],
    lines: &[Line],
    out: &mut dyn Write,
) -> io::Result<()> {
    let standings = standings(record, columns, lines);
    let special: Vec<&str> = columns
        .iter()
        .filter(|column| !column.is_ordinary())
        .map(|column| column.label())
        .collect();
    // Each is a row of a close-up.
    let parts = if is_close_up(record) { "rows" } else { "columns" };
    let place = match &special[..] {
        [] => String::new(),
        special => format!(" in ordinary sizes (all {parts} but {})", special.join(" and ")),
    };
    let meant = columns.iter().filter(|column| column.is_ordinary() && !column.complete).count();
    let mean = match &special[..] {
        _ if meant <= 1 => place.clone(),
        [] => format!(" (the mean of the {parts})"),
        special => {
            format!(" in ordinary sizes (the mean of all {parts} but {})", special.join(" and "))
        }
    };
    let percent = |share: f64| short_percent([(share * 1e9) as u64, 1_000_000_000]);
    let text = match &standings[..] {
        [] if columns.is_empty() => {
            "No case has both a verdict and a contract that demands one.".to_owned()
        }
        [] => "No case is of ordinary size.".to_owned(),
        [only] if only.wrong == 0 && only.others.is_empty() => {
            format!("{}: every verdict is right{place}.", only.label)
        }
        [only] if only.wrong == 0 => {
            format!("{}: no false miss and no false hit{place}.", only.label)
        }
        [only] => format!(
            "{} is wrong on {} % of the cases{mean}, {} times by over 1/1000 of the triangle's longest edge.",
            only.label,
            percent(only.share),
            group_digits(only.far),
        ),
        all => {
            // Of equals the first.
            let first = |order: fn(&Standing, &Standing) -> Ordering| {
                all.iter().min_by(|a, b| order(a, b)).expect("several rows")
            };
            let least = first(|a, b| a.share.total_cmp(&b.share));
            let most = first(|a, b| b.share.total_cmp(&a.share));
            // A kernel that promises less has fewer ways to be wrong.
            let contracts = lines.iter().map(|line| &*line.row.part.contract);
            let compared = match contracts.collect::<BTreeSet<&str>>().len() {
                1 => format!(
                    "Smallest share of wrong answers{mean}: {}, {} %; largest: {}, {} %. ",
                    least.label,
                    percent(least.share),
                    most.label,
                    percent(most.share),
                ),
                _ => "The rows promise different things; --contract closed-ray judges all by the same. "
                    .to_owned(),
            };
            let [near, far] = [
                first(|a, b| a.all_far().cmp(&b.all_far())),
                first(|a, b| b.all_far().cmp(&a.all_far())),
            ];
            let far = match far.all_far() {
                0 => "None was wrong by over 1/1000 of the triangle's longest edge.".to_owned(),
                most if most == near.all_far() => format!(
                    "Each was wrong {} times by over 1/1000 of the longest edge.",
                    group_digits(most),
                ),
                most => format!(
                    "Fewest answers off by over 1/1000 of the longest edge: {}, {}; most: {}, {}.",
                    near.label,
                    group_digits(near.all_far()),
                    far.label,
                    group_digits(most),
                ),
            };
            format!(
                "{} of {} rows were right on every case{place}. {compared}{far}",
                all.iter().filter(|row| row.wrong == 0 && row.others.is_empty()).count(),
                all.len(),
            )
        }
    };
    let broken: BTreeMap<FindingKind, u64> =
        record.result.plan.rows.iter().flat_map(|part| other_findings(record, part)).fold(
            BTreeMap::new(),
            |mut sums, (finding, count)| {
                *sums.entry(finding).or_default() += count;
                sums
            },
        );
    let others = match (standings.len(), broken.is_empty()) {
        (2.., _) | (_, true) => String::new(),
        _ => {
            let counts =
                broken.iter().map(|(finding, count)| format!("{finding} {}", group_digits(*count)));
            format!(" Other broken promises: {}.", counts.collect::<Vec<_>>().join(", "))
        }
    };
    write_wrapped(&(text + &others), out)?;
    if let Some(partial) = &record.result.partial {
        writeln!(out, "A part of a run: {}; all numbers are of this part.", partial.in_words())?;
    }
    Ok(())
}

/// Writes the legend of a cell.
fn write_cell_legend(columns: &[Column], lines: &[Line], out: &mut dyn Write) -> io::Result<()> {
    let sampled = lines.iter().flat_map(|line| columns.iter().zip(&line.cells));
    let wide = sampled
        .filter(|(column, cell)| !column.complete && 0 < cell.wrong.of)
        .map(|(_, cell)| cell.wrong.interval())
        .map(|interval| (interval.high - interval.low) / 2.0)
        .fold(0.0, f64::max);
    let contracts: BTreeSet<&str> = lines.iter().map(|line| &*line.row.part.contract).collect();
    let contract = match contracts.len() {
        1 => "the contract given",
        _ => "what the row's source promises",
    };
    let within = match wide {
        0.0 => String::new(),
        wide => format!(" (95 % intervals: ±{:.1} at most)", wide * 100.0 + 0.05),
    };
    let free = lines.iter().flat_map(|line| &line.cells).any(|cell| cell.wrong.of == 0);
    let free = if free { "; - nothing demanded" } else { "" };
    let stored = columns.iter().any(|column| column.complete);
    let stored = if stored { "; of whole sets: wrong/all" } else { "" };
    let text = format!(
        "Cells: % of wrong verdicts, false misses and false hits, by {contract}, on cases chosen to be \
         hard{within}; * over 0.1 % are wrong by over 1/1000 of the longest edge{stored}{free}."
    );
    write_wrapped(&text, out)
}

fn write_table(
    columns: &[Column],
    lines: &[Line],
    style: Style,
    out: &mut dyn Write,
) -> io::Result<()> {
    let (bold, plain) = if style.color { ("\x1b[1m", "\x1b[0m") } else { ("", "") };
    let text = |column: &Column, cell: &Cell| {
        let share = match column.complete {
            true if cell.wrong.of == 0 => "-".to_owned(),
            true => format!("{}/{}", group_digits(cell.wrong.count), group_digits(cell.wrong.of)),
            false => short_percent([cell.wrong.count, cell.wrong.of]),
        };
        format!("{share}{}", if cell.is_far() { '*' } else { ' ' })
    };
    let cells = |line: &Line| -> Vec<String> {
        columns.iter().zip(&line.cells).map(|(column, cell)| text(column, cell)).collect()
    };
    let width = |i: usize| {
        let longest = lines.iter().map(|line| cells(line)[i].len()).max();
        longest.unwrap_or(0).max(columns[i].label().len() + 1).max(5)
    };
    let widths: Vec<usize> = (0..columns.len()).map(width).collect();
    let first = lines.iter().map(|line| line.label().chars().count()).max().unwrap_or(0).max(22);
    let has_groups = lines.iter().any(|line| line.across.is_some());
    let mut scalar = "";
    for line in lines {
        if scalar != line.row.scalar {
            scalar = line.row.scalar;
            write!(out, "{bold}{:<first$}", format!("{scalar} kernel (epsilons)"))?;
            for (column, width) in columns.iter().zip(&widths) {
                write!(out, " {:>width$}", format!("{} ", column.label()))?;
            }
            let groups = if has_groups { " cracks doubles  promised" } else { "" };
            writeln!(out, " values{groups}{plain}")?;
        }
        let mut text = format!("{:<first$}", line.label());
        for ((cell, share), width) in line.cells.iter().zip(cells(line)).zip(&widths) {
            let share = format!("{share:>width$}");
            let color = if cell.wrong.of == 0 { "" } else { colour(style, cell.wrong.count) };
            text.push(' ');
            text.push_str(&painted(&share, color));
        }
        let values = &line.values;
        let color = if values.wrong.of == 0 { "" } else { colour(style, values.wrong.count) };
        let far = if values.is_far() { '*' } else { ' ' };
        let share = short_percent([values.wrong.count, values.wrong.of]);
        text.push_str(&painted(&format!(" {share:>5}{far}"), color));
        if has_groups {
            text.push_str(&across_text(line.across.as_ref(), style));
        }
        writeln!(out, "{}", text.trim_end())?;
    }
    Ok(())
}

/// The most rows of what is more often wrong on planes, or with rays, of other kinds.
const MOST_ELSEWHERE: usize = 10;

/// Writes which rows are more often wrong on planes, or with rays, of other kinds than the table's, and where most.
fn write_elsewhere(
    record: &Record,
    columns: &[Column],
    lines: &[Line],
    out: &mut dyn Write,
) -> io::Result<()> {
    let kinds = kinds(record);
    let [own_kind, others @ ..] = &kinds[..] else { return Ok(()) };
    if others.is_empty() {
        return Ok(());
    }
    let rate = |cell: &Cell| Rate::new(cell.wrong, true);
    let mut rows: Vec<(String, Rate, Rate, SceneKind)> = Vec::new();
    for line in lines {
        for (column, cell) in columns.iter().zip(&line.cells) {
            let own = rate(cell);
            let of = |kind: &SceneKind| {
                (rate(&Cell::sum(&column.of_kind(*kind).results(&line.row))), *kind)
            };
            let worse = others.iter().map(of).filter(|(other, _)| is_worse(&own, other));
            let most = worse
                .max_by(|(a, _), (b, _)| a.rate.unwrap_or(0.0).total_cmp(&b.rate.unwrap_or(0.0)));
            if let Some((other, kind)) = most {
                let label = format!("{}, {}: {}", line.label(), line.row.scalar, column.label());
                rows.push((label, own, other, kind));
            }
        }
    }
    let names: Vec<String> =
        others.iter().map(|kind| format!("{kind} ({})", kind.in_words())).collect();
    writeln!(out)?;
    if rows.is_empty() {
        let text = format!(
            "On no other planes or rays is a row clearly more often wrong: {}",
            names.join(", ")
        );
        return write_wrapped(&text, out);
    }
    let excess = |(_, own, other, _): &(String, Rate, Rate, SceneKind)| {
        other.rate.unwrap_or(0.0) - own.rate.unwrap_or(0.0)
    };
    rows.sort_by(|a, b| excess(b).total_cmp(&excess(a)));
    let more = rows.len().saturating_sub(MOST_ELSEWHERE);
    rows.truncate(MOST_ELSEWHERE);
    let first = rows.iter().map(|(label, ..)| label.chars().count()).max().unwrap_or(0);
    let title = "Clearly more often wrong on other planes or rays";
    let first = first.max(title.len());
    writeln!(out, "{title:<first$}{:>10}{:>10}", own_kind.to_string(), "most")?;
    for (label, own, other, kind) in &rows {
        let [own, other] = [own, other].map(|rate| rate.rate.map_or("-".to_owned(), percent));
        writeln!(out, "{label:<first$}{own:>10}{other:>10} on {kind}")?;
    }
    if 0 < more {
        writeln!(out, "and {more} more (--details)")?;
    }
    write_wrapped(&names.join(", "), out)
}

/// Cracks and doubles, and what is promised of them.
fn across_text(across: Option<&Across>, style: Style) -> String {
    let Some(across) = across else { return format!(" {:>6} {:>7}  -", "-", "-") };
    let rate = |rate: [u64; 2], ruled_out: bool, width: usize| {
        let color = if ruled_out { colour(style, rate[0]) } else { "" };
        painted(&format!("{:>width$}", short_percent(rate)), color)
    };
    let [no_crack, no_double] = across.rules_out();
    let color = if no_crack { colour(style, u64::from(across.is_broken())) } else { "" };
    format!(
        " {} {}  {}",
        rate(across.cracks, no_crack, 6),
        rate(across.doubles, no_double, 7),
        painted(&across.words(), color)
    )
}

/// Green for nothing wrong, red for something.
fn colour(style: Style, wrong: u64) -> &'static str {
    match (style.color, wrong) {
        (false, _) => "",
        (true, 0) => "\x1b[32m",
        (true, _) => "\x1b[31m",
    }
}

fn painted(text: &str, color: &str) -> String {
    if color.is_empty() { text.to_owned() } else { format!("{color}{text}\x1b[0m") }
}
