//! One kernel in one scalar: what to use, what argues for it, and everything else folded.

use super::answer::{
    LimitRow, PICTURE, column_names, conflict, error_rows, is_scale_free_better, limit_rows, name,
    rows, used,
};
use super::commands::commands;
use super::numbers::share;
use super::plot::{footer, panels};
use super::record::{SceneKernelPart, SceneResult};
use super::standing::{coarse, of_given, standing, telling};
use super::words::label;
use crate::case::{Scene, SceneKind};
use crate::elsewhere::{self, ComparedRates};
use crate::family::Stratum;
use crate::page::{Block, Cell, Head, Row, Table};
use crate::segments::SegmentsPart;
use hairline_advice::epsilon::Rays;

/// So many rows argue for what to use.
const MOST_ROWS: usize = 3;

/// One kernel in one scalar: the answer, what argues for it, and everything else folded.
pub(super) fn of_kernel(record: &SceneResult, part: &SceneKernelPart) -> Vec<Block> {
    let mut blocks = vec![Block::text(standing(record, part).1)];
    blocks.extend(coarse(record, part).map(Block::Text));
    blocks.extend(used(record, part).into_iter().map(Block::Use));
    blocks.extend(
        part.segments
            .as_ref()
            .and_then(SegmentsPart::sentence)
            .map(Block::Text),
    );
    blocks.extend(of_given(record, part).map(Block::Text));
    let title = match record.has_scene() {
        true => format!("wrong on fresh rays (seed {})", record.fresh_seed),
        false => format!("wrong (seed {})", record.fresh_seed),
    };
    let columns = column_names(record, part);
    let table = |title: &str, rows: Vec<Row>| {
        let heads = [title]
            .into_iter()
            .chain(columns.iter().map(String::as_str));
        Block::Table(Table::new(heads.map(Head::of).collect(), rows))
    };
    let is_edges = |place: &usize| part.counts[*place].rays == Rays::Stratum(Stratum::Edges);
    let mut places = telling(record, part, MOST_ROWS);
    if places.iter().any(is_edges) {
        places = telling(record, part, MOST_ROWS - 1);
    }
    let mut told: Vec<String> = places
        .iter()
        .map(|place| label(&part.counts[*place]))
        .collect();
    told.extend(places.iter().any(is_edges).then(|| PICTURE.to_owned()));
    let all_rows = rows(part);
    let telling = all_rows
        .iter()
        .filter(|row| told.contains(&row.label))
        .cloned();
    blocks.push(table(&title, telling.collect()));
    blocks.extend(panels(record, part).into_iter().map(Block::Picture));
    let mut all = vec![table(&title, all_rows)];
    let errors = error_rows(record, part);
    if !errors.is_empty() {
        all.push(table("errors: half below, 99 % below, worst", errors));
    }
    all.extend(of_elsewhere(record, part));
    all.extend(limits(record, part));
    all.push(Block::Notes(footer(record, part).into()));
    blocks.push(Block::Details(
        format!("Everything about {} {}", part.kernel, part.scalar),
        all,
    ));
    // No command runs a form that is no number.
    let next = match is_scale_free_better(record, part) {
        true => Vec::new(),
        false => commands(record, part),
    };
    blocks.push(Block::Commands("next", next));
    blocks
}

/// Where the recommended epsilons are more often wrong on planes, or with rays, of other kinds.
fn of_elsewhere(record: &SceneResult, part: &SceneKernelPart) -> Vec<Block> {
    let own = Scene::parse(&record.scene).map_or(SceneKind::ALL[0], |(scene, _)| scene.kind());
    let planes = part.elsewhere.iter().map(|other| other.plane.clone());
    let kinds: Vec<String> = [own.to_string()].into_iter().chain(planes).collect();
    let others = |place: usize| part.elsewhere.iter().map(move |other| &other.wrong[place]);
    let rows: Vec<ComparedRates> = (part.counts.iter().zip(&part.tried[0].wrong).enumerate())
        .map(|(place, (count, own))| ComparedRates {
            label: label(count),
            rates: [own].into_iter().chain(others(place)).cloned().collect(),
        })
        .collect();
    elsewhere::blocks(
        &format!("{}: more often wrong", name(record, part)),
        &kinds,
        &rows,
        share,
    )
}

fn limits(record: &SceneResult, part: &SceneKernelPart) -> Vec<Block> {
    let row = |row: LimitRow| {
        let star = if row.is_of_scene { " *" } else { "" };
        let cells = [
            row.bound,
            format!("{}{star}", label(row.count)),
            row.most,
            row.fresh,
        ]
        .map(Cell::words);
        Row {
            below: row.price.into_iter().collect(),
            ..Row::new(&row.knob.name, cells)
        }
    };
    let rows: Vec<Row> = limit_rows(record, part).map(row).collect();
    if rows.is_empty() {
        return Vec::new();
    }
    let heads = vec![
        Head::of("limits"),
        Head::text("the other numbers fixed"),
        Head::text("95 %: 1 in 20 fails"),
        Head::of("at most"),
        Head::of("fresh rays").optional(),
    ];
    let conflicts = part
        .conflicts
        .iter()
        .map(|it| Block::Text(conflict(record, part, it)));
    [Block::Table(Table::new(heads, rows))]
        .into_iter()
        .chain(conflicts)
        .collect()
}
