//! The record of a mesh audit as a page of text: a sentence, a table a scalar, the first places; everything else folded.

use super::examples::{MeshExample, examples, place};
use super::rows::{MeshRow, rows};
use super::topology::{not_asked, topology_terms};
use crate::epsilon::fitness::Grain;
use crate::lists::alike;
use crate::page::{Block, Cell, Command, Head, Page, Row, Table, Tone};
use hairline_record::*;
use hairline_record::{Rate, Record, group_digits, interval_of, number_of, percent};

/// So many rows stand on the screen.
const MOST_ROWS: usize = 8;

/// So many places stand there with a command.
const MOST_PLACES: usize = 3;

/// The page of a record of an audit of a mesh.
pub fn page(record: &Record, mesh: &MeshPart) -> Page {
    let result = &record.result;
    let rows = rows(result);
    let (tone, title) = verdict(result, mesh, &rows);
    let unit = result
        .plan
        .parameters()
        .any(|parameters| parameters.unit_direction);
    let mut blocks = vec![Block::text(format!(
        "{}, {}, {}{}{}, seed {}, {:.1} s",
        number_of(mesh.triangles, "triangle", "triangles"),
        number_of(mesh.vertices, "vertex", "vertices"),
        number_of(mesh.directions, "ray", "rays"),
        match unit {
            true => " with unit directions at each edge and vertex",
            false => " at each edge and vertex",
        },
        if result.is_placed() {
            " of an instance"
        } else {
            ""
        },
        mesh.seed,
        record.provenance.seconds
    ))];
    let of_scalar = |part: &MeshScalar| -> Vec<&MeshRow<'_>> {
        rows.iter()
            .filter(|row| row.scalar == part.scalar)
            .collect()
    };
    for part in &mesh.scalars {
        let grain = grain(part);
        let is_coarse = part.spacing.is_finite() && !grain.is_fine();
        blocks.extend(is_coarse.then(|| Block::Text(grain.sentence("mesh"))));
        blocks.extend(blocks_of(record, part, of_scalar(part)));
    }
    #[cfg(feature = "pages")]
    blocks.extend(super::stage::block(record, mesh, &rows));
    blocks.extend(
        result
            .partial
            .as_ref()
            .map(|part| Block::Text(part.sentence())),
    );
    let places = first_places(&rows);
    if !places.is_empty() {
        blocks.push(Block::Commands("shown by", places));
    }
    if 0 < all_rays(result) {
        blocks.push(Block::text(SHARES));
    }
    for part in &mesh.scalars {
        let title = format!("Everything in {}", part.scalar);
        blocks.push(Block::Details(
            title,
            everything(record, mesh, &of_scalar(part)),
        ));
    }
    Page {
        command: "mesh",
        title,
        tone,
        blocks,
    }
}

fn grain(of: &MeshScalar) -> Grain<'_> {
    Grain {
        scalar: of.scalar,
        spacing: of.spacing,
        smallest: of.smallest,
        unit: "",
    }
}

/// How many rays were aimed.
fn all_rays(result: &ResultPart) -> u64 {
    result.sources.iter().map(|source| source.indices).sum()
}

/// How it went, in one line.
fn verdict(result: &ResultPart, mesh: &MeshPart, rows: &[MeshRow<'_>]) -> (Tone, String) {
    let name = mesh.file.rsplit(['/', '\\']).next().unwrap_or(&mesh.file);
    let file: String = name.chars().take(120).collect();
    let leaking = rows.iter().filter(|row| 0 < row.leaks()).count();
    let is_broken = rows
        .iter()
        .any(|row| row.promise().is_some_and(|(_, kept)| !kept));
    let failed = rows.iter().any(|row| 0 < row.failures());
    let rays = all_rays(result);
    let tone = match (is_broken, leaking) {
        (true, _) => Tone::Bad,
        (false, 0) if !failed && 0 < rays => Tone::Good,
        _ => Tone::Plain,
    };
    let aimed = group_digits(rays);
    let of = format!(
        "of {aimed} aimed at its edges and vertices{}",
        not_asked(mesh)
    );
    let doubles = rows.iter().map(|row| row.both(|across| &across.doubles));
    let most = doubles.filter_map(|rate| rate.rate).fold(0.0, f64::max);
    let twice = if 0.0 < most {
        let share = percent(most);
        let up_to = if rows.len() == 1 { "" } else { "up to " };
        format!(
            "; but {up_to}{share} of them hit it twice or more: counted crossings are wrong there"
        )
    } else {
        String::new()
    };
    let title = match (leaking, rows.len()) {
        _ if rays == 0 => format!("Nothing to ask of {file}"),
        (0, 1) => format!("No ray slips through {file}, {of}{twice}"),
        (0, n) => format!("No ray slips through {file} with {n} kernel rows, {of}{twice}"),
        (1, 1) => format!("Rays slip through {file}"),
        (k, n) => format!("Rays slip through {file} with {k} of {n} kernel rows"),
    };
    (tone, title)
}

/// The mesh in one scalar, and the rows, those that leak least first; rows that answer alike stand together.
fn blocks_of(record: &Record, part: &MeshScalar, mut rows: Vec<&MeshRow<'_>>) -> Vec<Block> {
    let of_scalar = record
        .result
        .sources
        .iter()
        .filter(|source| source.scalar == part.scalar);
    let rays: Vec<u64> = of_scalar.map(|source| source.indices).collect();
    let mut blocks = vec![Block::terms(topology_terms(part, &rays))];
    if rays.iter().all(|rays| *rays == 0) {
        return blocks;
    }
    rows.sort_by(|one, other| {
        let share = |row: &MeshRow<'_>, rate| row.both(rate).rate.unwrap_or(0.0);
        let of = |rate| share(one, rate).total_cmp(&share(other, rate));
        of(|across| &across.cracks).then(of(|across| &across.doubles))
    });
    let counts = |row: &MeshRow<'_>| {
        let rates: [fn(&AcrossPart) -> &Rate; 3] = [
            |across| &across.cracks,
            |across| &across.doubles,
            |across| &across.odd_folds,
        ];
        (
            row.at.map(|at| at.leaking),
            rates.map(|rate| row.both(rate).count),
        )
    };
    let shown = alike(rows, |one, other| counts(one) == counts(other));
    let heads = vec![
        Head::of(format!("{} kernel", part.scalar)),
        Head::of("cracks at edges"),
        Head::of("at vertices"),
        Head::of("doubles"),
        Head::of("wrong at folds").optional(),
        Head::of("edges leak"),
        Head::of("vertices leak"),
        Head::of("ns a ray").optional(),
    ];
    let times = record.provenance.kernel_nanoseconds.get(&part.scalar);
    let row = |(row, alike): &(&MeshRow<'_>, Vec<&MeshRow<'_>>)| {
        let time = times.and_then(|times| times.get(&row.part.label()));
        let promised = row.promised() != Promised::Nothing;
        let exactly = row.promised() == Promised::ExactlyOne;
        let share = |rate: &Rate, is_promised: bool| {
            let text = rate.rate.map_or("-".to_owned(), percent);
            Cell::rate(rate, text).broken_if(is_promised && 0 < rate.count)
        };
        let [edges, vertices] = row.at;
        let cells = [
            share(&edges.across.cracks, promised),
            share(&vertices.across.cracks, promised),
            share(&row.both(|across| &across.doubles), exactly),
            share(&row.both(|across| &across.odd_folds), exactly),
            Cell::count(edges.leaking),
            Cell::count(vertices.leaking),
            Cell::optional(time.copied(), |time| format!("{time:.1}")),
        ];
        let mut below = Vec::new();
        if !alike.is_empty() {
            let alike: Vec<String> = alike.iter().map(|other| other.short_label()).collect();
            below.push(format!("same counts: {}", alike.join(", ")));
        }
        if let Some((hits, is_kept)) = row.promise() {
            let kept = if is_kept { "kept" } else { "BROKEN" };
            below.push(format!("promises hits {hits} where a ray crosses: {kept}"));
        }
        if 0 < row.failures() {
            let count = number_of(row.failures(), "case", "cases");
            below.push(format!(
                "no verdict on {count}, which are in no share (--details)"
            ));
        }
        Row {
            below,
            ..Row::new(row.short_label(), cells)
        }
    };
    let rows = shown.iter().map(row).collect();
    blocks.push(Block::Table(Table::new(heads, rows).at_most(MOST_ROWS)));
    blocks
}

/// The commands that show the first places: of rows that break a promise, then of those that leak least.
fn first_places(rows: &[MeshRow<'_>]) -> Vec<Command> {
    let mut rows: Vec<&MeshRow<'_>> = rows.iter().collect();
    rows.sort_by_key(|row| (row.promise().is_none_or(|(_, kept)| kept), row.leaks()));
    let first = |row: &&MeshRow<'_>| {
        let first = examples(row, 1, false).into_iter().next()?;
        Some(Command {
            line: first.command,
            what: "",
        })
    };
    rows.iter().filter_map(first).take(MOST_PLACES).collect()
}

/// Each row with its intervals, and the places that were kept.
fn everything(record: &Record, mesh: &MeshPart, rows: &[&MeshRow<'_>]) -> Vec<Block> {
    let heads = [
        "kernel (epsilons)",
        "edges [95 %]",
        "vertices [95 %]",
        "elsewhere",
    ];
    let rate = |rate: &Rate| Cell::rate(rate, interval_of(rate).trim_matches([' ', '(', ')']));
    let row = |row: &&MeshRow<'_>| {
        let elsewhere = row.at.iter().filter_map(|at| at.across.elsewhere.as_ref());
        let elsewhere = elsewhere.map(|rate| rate.count).sum();
        let [edges, vertices] = row.at.map(|at| rate(&at.across.cracks));
        Row::new(row.part.label(), [edges, vertices, Cell::count(elsewhere)])
    };
    let table = Table::new(heads.map(Head::of).into(), rows.iter().map(row).collect());
    let mut blocks = vec![Block::Table(table)];
    blocks.push(Block::text(format!(
        "{}, digest {}",
        record.provenance.tool, mesh.digest
    )));
    for row in rows {
        let count = row.failures();
        if 0 < count {
            let count = number_of(count, "case", "cases");
            blocks.push(Block::Text(format!(
                "{}: no verdict on {count}",
                row.part.label()
            )));
        }
        let mut findings = row.at.iter().flat_map(|at| &at.result.findings);
        let failure = findings.find(|part| part.finding.is_failure());
        let failure = failure.map(|part| Block::Listing(format!("    {}", part.worst.command)));
        blocks.extend(failure);
        let examples = examples(row, usize::MAX, true);
        if examples.is_empty() {
            blocks.push(Block::Text(format!("{}: nowhere", row.part.label())));
            continue;
        }
        blocks.push(Block::Text(row.part.label()));
        let line = |MeshExample { what, id, command }: MeshExample<'_>| {
            let place = mesh.places.get(id).map(place).unwrap_or_default();
            format!("    {what}: {place}\n        {command}")
        };
        blocks.push(Block::Listing(
            examples
                .into_iter()
                .map(line)
                .collect::<Vec<_>>()
                .join("\n"),
        ));
    }
    blocks
}

/// The note on the shares in the table.
const SHARES: &str = "Cracks: % of the rays aimed at edges, and at vertices, that cross the surface there, on a side that counts; \
doubles: of both together; wrong at folds: of those that touch it. Rays at the whole mesh rarely come so near an edge. Sorted by the \
share of cracks; `hairline epsilon --mesh` finds better epsilons, and weighs lost and false hits too.";
