//! One kernel in one scalar: what to use, what argues for it, and everything else folded.

use super::answer::{KernelAnswer, LimitRow, PICTURE};
use super::plot::{footer, panels};
use super::record::{SceneKernelPart, SceneResult};
use super::standing::{coarse, of_given, standing, telling};
use super::words::{label, share};
use crate::case::{Scene, SceneKind};
use crate::epsilon::Rays;
use crate::family::Stratum;
use crate::report::elsewhere::{self, ComparedRates};
use crate::report::page::{Block, Command, Head, Row, Table};

/// So many rows argue for what to use.
const MOST_ROWS: usize = 3;

/// One kernel in one scalar: the answer, what argues for it, and everything else folded.
pub(super) fn of_kernel(
    record: &SceneResult,
    part: &SceneKernelPart,
    answer: &KernelAnswer,
) -> Vec<Block> {
    let mut blocks = vec![Block::text(standing(record, part).1)];
    blocks.extend(coarse(record, part).map(Block::Text));
    blocks.extend(answer.used.iter().cloned().map(Block::Use));
    blocks.extend(of_given(record, part).map(Block::Text));
    let title = match record.has_scene() {
        true => format!("wrong on fresh rays (seed {})", record.fresh_seed),
        false => format!("wrong (seed {})", record.fresh_seed),
    };
    let heads = |title: &str| -> Vec<Head> {
        [title].into_iter().chain(answer.columns.iter().map(String::as_str)).map(Head::of).collect()
    };
    let table = |title: &str, rows: &[(String, Vec<String>)]| {
        let rows =
            rows.iter().map(|(label, cells)| Row::new(label, cells.iter().cloned())).collect();
        Block::Table(Table::new(heads(title), rows))
    };
    let is_edges = |place: &usize| part.counts[*place].rays == Rays::Stratum(Stratum::Edges);
    let mut places = telling(record, part, MOST_ROWS);
    if places.iter().any(is_edges) {
        places = telling(record, part, MOST_ROWS - 1);
    }
    let mut told: Vec<String> = places.iter().map(|place| label(&part.counts[*place])).collect();
    told.extend(places.iter().any(is_edges).then(|| PICTURE.to_owned()));
    let is_telling = |row: &&(String, Vec<String>)| told.contains(&row.0);
    let rows: Vec<_> = answer.rows.iter().filter(is_telling).cloned().collect();
    blocks.push(table(&title, &rows));
    blocks.extend(panels(record, part, answer).into_iter().map(Block::Picture));
    let mut all = vec![table(&title, &answer.rows)];
    if !answer.errors.is_empty() {
        all.push(table("errors: half below, 99 % below, worst", &answer.errors));
    }
    all.extend(of_elsewhere(record, answer.name, part));
    all.extend(limits(answer));
    blocks.push(Block::Details(format!("Everything about {} {}", part.kernel, part.scalar), {
        all.push(Block::Notes(footer(record, part).into()));
        all
    }));
    let command = |line: &String| {
        let is_spawn = line.starts_with("hairline spawn");
        let what = if is_spawn { "an offset in place of t_min" } else { "" };
        Command { line: line.clone(), what }
    };
    blocks.push(Block::Commands("next", answer.next.iter().map(command).collect()));
    blocks
}

/// Where the recommended epsilons are more often wrong on planes, or with rays, of other kinds.
fn of_elsewhere(record: &SceneResult, name: &str, part: &SceneKernelPart) -> Vec<Block> {
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
    elsewhere::blocks(&format!("{name}: more often wrong"), &kinds, &rows, share)
}

fn limits(answer: &KernelAnswer) -> Vec<Block> {
    if answer.limits.is_empty() {
        return Vec::new();
    }
    let heads = vec![
        Head::of("limits"),
        Head::text("the other numbers fixed"),
        Head::text("95 %: 1 in 20 fails"),
        Head::of("at most"),
        Head::of("fresh rays").optional(),
    ];
    let row = |row: &LimitRow| {
        let star = if row.is_of_scene { " *" } else { "" };
        let what = format!("{}{star}", row.what);
        let cells = [row.bound.clone(), what, row.most.clone(), row.fresh.clone()];
        Row { below: row.price.iter().cloned().collect(), ..Row::new(&row.knob, cells) }
    };
    let mut blocks = vec![Block::Table(Table::new(heads, answer.limits.iter().map(row).collect()))];
    blocks.extend(answer.conflicts.iter().cloned().map(Block::Text));
    blocks
}
