//! Every row in a scalar: false misses and false hits with their intervals and where most are, and what else is counted.

use super::pool::Pool;
use super::rate::{interval_of, percent};
use super::record::*;
use super::row_view::{ALL_INVALID, RowView, cases_in, is_all_invalid};
use super::why::{accuracy_text, causes_text, of_kind};
use super::{group_digits, number_of};
use crate::audit::Trials;
use crate::report::page::{Block, Cell, Head, Row, Table};

/// The rows of a scalar, as a table with notes below each row.
pub(super) fn blocks(record: &Record, scalar: &str) -> Vec<Block> {
    let rows = RowView::all(record, scalar);
    let cases = cases_in(record, scalar);
    let of_cases = number_of(cases, "case", "cases");
    let mut blocks = vec![Block::Heading(format!("{scalar}, {of_cases} for each kernel"))];
    if cases == 0 {
        return blocks;
    }
    if is_all_invalid(&rows, cases) {
        blocks.push(Block::text(ALL_INVALID));
    }
    let heads = vec![
        Head::of("kernel (epsilons)"),
        Head::of("false misses, %"),
        Head::text("most in").optional(),
        Head::of("false hits, %"),
        Head::text("most in").optional(),
        Head::of("bad").optional(),
        Head::of("values").optional(),
        Head::of("on NaN").optional(),
        Head::of("cracks").optional(),
        Head::of("ns/ray").optional(),
    ];
    let times = record.provenance.kernel_nanoseconds.get(scalar);
    let row = |row: &RowView| {
        let misses = row.total(|result| Some(&result.total.false_misses));
        let hits = row.total(|result| Some(&result.total.false_hits));
        let bad = row.total(|result| Some(&result.total.bad_values));
        let wrong = row.total(|result| Some(&result.total.wrong_values));
        let cracks = row.total(|result| result.across.as_ref().map(|across| &across.cracks));
        let label = format!("{} ({})", row.part.kernel, row.part.set);
        let time = times.and_then(|times| times.get(&label));
        let cells: [Cell; 9] = [
            share_cell(misses.rate()),
            fitted(row.worst_family(|result| &result.total.false_misses), 16).into(),
            share_cell(hits.rate()),
            fitted(row.worst_family(|result| &result.total.false_hits), 16).into(),
            short_count(bad.counts()[0]).into(),
            short_count(wrong.counts()[0]).into(),
            short_count(row.hits_on_invalid()).into(),
            match cracks.counts() {
                [_, 0] => "-".to_owned(),
                [count, _] => short_count(count),
            }
            .into(),
            time.map_or("-".to_owned(), |time| format!("{time:.1}")).into(),
        ];
        Row { below: below(row, &misses, &hits), ..Row::new(label, cells) }
    };
    blocks.push(Block::Table(Table::new(heads, rows.iter().map(row).collect())));
    if rows.iter().any(|row| row.part.kernel.contains('+')) {
        blocks.push(Block::text(
            "ns/ray of a kernel in another arithmetic (NAME+fma) is the time of its emulation",
        ));
    }
    blocks.extend(exact_shares(record, scalar, &rows));
    blocks
}

/// The stored cases of a row, its causes and the errors of its values.
fn below(row: &RowView, misses: &Pool, hits: &Pool) -> Vec<String> {
    let mut below = Vec::new();
    for (pool, what) in [(misses, "misses"), (hits, "hits")] {
        let apart = pool.apart();
        below.extend(
            apart.map(|apart| format!("stored or exhaustive cases, apart: false {what} {apart}")),
        );
    }
    for (kind, what) in [(FindingKind::FalseMiss, "misses"), (FindingKind::FalseHit, "hits")] {
        let causes = causes_text(of_kind(&row.results, kind));
        below.extend(causes.map(|causes| format!("false {what}: {causes}")));
    }
    let errors = row.total.and_then(|total| accuracy_text(&total.accuracy));
    below.extend(errors.map(|errors| format!("values in ulps: {errors}")));
    below
}

/// For each mesh the share of its rays that meet an edge or a vertex exactly.
fn exact_shares(record: &Record, scalar: &str, rows: &[RowView]) -> Vec<Block> {
    let Some(row) = rows.first() else { return Vec::new() };
    let sources = record.result.sources.iter().filter(|source| source.scalar == scalar);
    let meshes = sources.filter(|source| source.family.starts_with("mesh:"));
    let share = |source: &SourcePart| {
        let result = row.results.iter().find(|result| result.family == source.family)?;
        let of_part = |part: &str| -> u64 {
            let named = result.classes.iter().filter(|(name, _)| name.starts_with(part));
            named.map(|(_, counts)| counts.cases).sum()
        };
        let (edges, vertices) = (of_part("edge/"), of_part("vertex/"));
        let met = Trials::independent(edges + vertices, source.cases);
        Some(Block::Text(format!(
            "{}: {} rays meet an edge and {} a vertex exactly{}",
            source.family,
            group_digits(edges),
            group_digits(vertices),
            interval_of(&Rate::new(met, true))
        )))
    };
    meshes.filter_map(share).collect()
}

/// A source's name in so many columns: of a long one the end, which is a file's name.
fn fitted(name: &str, columns: usize) -> String {
    match name.chars().count().saturating_sub(columns) {
        0 => name.to_owned(),
        more => std::iter::once('…').chain(name.chars().skip(more + 1)).collect(),
    }
}

/// A count in at most six columns: 1,234 or 1.2M.
fn short_count(count: u64) -> String {
    match count {
        0..100_000 => group_digits(count),
        100_000..1_000_000 => format!("{}k", count / 1000),
        _ => format!("{:.1}M", count as f64 / 1e6),
    }
}

/// A share and its interval in percent.
pub(super) fn share_cell(rate: &Rate) -> Cell {
    let number = |share: f64| percent(share).trim_end_matches('%').to_owned();
    let text = match (rate.rate, rate.interval) {
        (None, _) => "-".to_owned(),
        (Some(share), None) => number(share),
        (Some(share), Some([low, high])) => {
            format!("{} [{}, {}]", number(share), number(low), number(high))
        }
    };
    Cell { text, is_broken: 0 < rate.count, share: rate.rate }
}
