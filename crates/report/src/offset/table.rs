//! Tables of offsets: how often each puts a new ray on the wrong side, how high rays start, and what they pass.

use super::record::{BestPart, OffsetResult, PointsPart, SchemePart};
use crate::elsewhere::{self, ComparedRates};
use crate::page::{Block, Cell, Head, Row, Table};
use crate::segments::short_length as size;
use hairline_advice::offset::describe;
use hairline_record::{Rate, interval_of, percent};

/// The rows that argue: what is recommended, the user's own, no offset at all, and the best that was published with a
/// name; of few all.
pub(super) fn arguing(part: &PointsPart) -> Vec<&SchemePart> {
    if part.schemes.len() <= 4 {
        return part.schemes.iter().collect();
    }
    let is_best = |scheme: &&SchemePart| {
        part.best
            .as_ref()
            .is_some_and(|BestPart { scheme: best, .. }| *best == scheme.name)
    };
    let is_published = |scheme: &&SchemePart| scheme.name != "none" && !scheme.name.contains('=');
    let failed = |scheme: &SchemePart| scheme.wrong.count.max(scheme.self_hits.count);
    let height = |scheme: &SchemePart| scheme.height_in_edges.median.unwrap_or(f64::INFINITY);
    let published = part.schemes.iter().filter(is_published).min_by(|a, b| {
        failed(a)
            .cmp(&failed(b))
            .then(height(a).total_cmp(&height(b)))
    });
    let none = part.schemes.iter().find(|scheme| scheme.name == "none");
    // A scheme that is not described is the user's own.
    let own = part
        .schemes
        .iter()
        .filter(|scheme| describe(&scheme.name).is_empty());
    let mut rows: Vec<&SchemePart> = part.schemes.iter().filter(is_best).collect();
    for scheme in own.chain(none).chain(published) {
        if !rows.iter().any(|row| row.name == scheme.name) {
            rows.push(scheme);
        }
    }
    rows
}

fn share(rate: &Rate) -> String {
    rate.rate.map_or("-".to_owned(), percent)
}

fn share_cell(rate: &Rate) -> Cell {
    Cell::rate(rate, share(rate))
}

fn height(height: Option<f64>) -> Cell {
    height.map_or(Cell::words("behind"), size_cell)
}

fn size_cell(x: f64) -> Cell {
    Cell::number(x, size(x))
}

/// Some offsets; with everything that is counted, or in short.
pub(super) fn table(record: &OffsetResult, schemes: Vec<&SchemePart>, is_whole: bool) -> Table {
    type Shown = Box<dyn Fn(&SchemePart) -> Cell>;
    let mut columns: Vec<(Head, Shown)> = vec![
        (
            Head::of("wrong side"),
            Box::new(|scheme| share_cell(&scheme.wrong)),
        ),
        (
            Head::of("self-hits"),
            Box::new(|scheme| share_cell(&scheme.self_hits)),
        ),
        (
            Head::of("height: median"),
            Box::new(|scheme| height(scheme.height_in_edges.median)),
        ),
    ];
    if is_whole {
        let interval = |scheme: &SchemePart| {
            let text = interval_of(&scheme.wrong);
            Cell::rate(&scheme.wrong, text.trim_matches([' ', '(', ')']))
        };
        columns[0] = (Head::of("wrong side [95 %]"), Box::new(interval));
        let mut more = |head: &str, shown: Shown| columns.push((Head::of(head).optional(), shown));
        more(
            "99 %",
            Box::new(|scheme| height(scheme.height_in_edges.p99)),
        );
        more(
            "top seen",
            Box::new(|scheme| size_cell(scheme.height_in_edges.highest)),
        );
        more(
            "in ulps",
            Box::new(|scheme| height(scheme.height_in_ulps.median)),
        );
        more(
            "times least",
            Box::new(|scheme| scheme.over_least.map_or(Cell::none(), size_cell)),
        );
    }
    if !is_whole && 1 < record.planes.len() {
        columns.insert(1, (Head::of("on its worst kind"), Box::new(on_worst_kind)));
    }
    columns.push((
        Head::of(format!("past a wall at {}", record.wall)),
        Box::new(|scheme| share_cell(&scheme.beyond_wall)),
    ));
    columns.push((
        Head::of(format!("past a fold of {}\u{b0}", record.fold)),
        Box::new(|scheme| share_cell(&scheme.past_neighbour)),
    ));
    let row = |scheme: &&SchemePart| {
        Row::new(&scheme.name, columns.iter().map(|(_, shown)| shown(scheme)))
    };
    let rows = schemes.iter().map(row).collect();
    let heads = [Head::of("offset")]
        .into_iter()
        .chain(columns.into_iter().map(|(head, _)| head));
    Table::new(heads.collect(), rows)
}

/// The largest share of wrong sides on any kind of planes, and that kind; nothing if it is the first.
fn on_worst_kind(scheme: &SchemePart) -> Cell {
    let of_rate = |rate: &Rate| rate.rate.unwrap_or(0.0);
    let worst = scheme
        .elsewhere
        .iter()
        .max_by(|a, b| of_rate(&a.wrong).total_cmp(&of_rate(&b.wrong)));
    match worst {
        Some(worst) if of_rate(&scheme.wrong) < of_rate(&worst.wrong) => {
            let text = format!("{} {}", share(&worst.wrong), worst.plane);
            Cell::rate(&worst.wrong, text)
        }
        _ => Cell::none(),
    }
}

/// The shares of wrong sides on other kinds of planes, of the schemes that are worse there.
pub(super) fn of_elsewhere(record: &OffsetResult, part: &PointsPart) -> Vec<Block> {
    let rows = part.schemes.iter().map(|scheme| ComparedRates {
        label: scheme.name.clone(),
        rates: [&scheme.wrong]
            .into_iter()
            .chain(scheme.elsewhere.iter().map(|other| &other.wrong))
            .cloned()
            .collect(),
    });
    elsewhere::blocks(
        "more wrong sides",
        &record.planes,
        &rows.collect::<Vec<_>>(),
        share,
    )
}
