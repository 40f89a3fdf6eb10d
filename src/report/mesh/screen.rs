//! The record of a mesh audit as a page of text: a sentence, a table a scalar, the first places; everything else folded.

use super::record::*;
use crate::report::epsilon::fitness::Grain;
use crate::report::page::{Block, Cell, Command, Head, Page, Paged, Row, Table, Tone};
use crate::report::{Promised, Rate, alike, group_digits, interval_of, number_of, percent};

/// So many rows stand on the screen.
const MOST_ROWS: usize = 8;

/// So many places stand there with a command.
const MOST_PLACES: usize = 3;

impl Paged for MeshReport {
    fn page(&self) -> Page {
        let record = &self.record;
        let result = &record.result;
        let (tone, title) = verdict(result);
        let mesh = &result.mesh;
        let mut blocks = vec![Block::text(format!(
            "{}, {}, {}{}{}, seed {}, {:.1} s",
            number_of(mesh.triangles, "triangle", "triangles"),
            number_of(mesh.vertices, "vertex", "vertices"),
            number_of(result.directions, "ray", "rays"),
            match result.unit_directions {
                true => " with unit directions at each edge and vertex",
                false => " at each edge and vertex",
            },
            if result.instance.is_some() { " of an instance" } else { "" },
            result.seed,
            record.provenance.seconds
        ))];
        for part in &result.scalars {
            let grain = part.grain();
            blocks.extend((!grain.is_fine()).then(|| Block::Text(grain.sentence("mesh"))));
            blocks.extend(of_scalar(record, part));
        }
        #[cfg(feature = "pages")]
        blocks.extend(super::stage::block(self));
        let places = first_places(result);
        if !places.is_empty() {
            blocks.push(Block::Commands("shown by", places));
        }
        let asked = result.scalars.iter().any(|part| part.rays != [0, 0]);
        if asked {
            blocks.push(Block::text(SHARES));
        }
        for part in &result.scalars {
            let title = format!("Everything in {}", part.scalar);
            blocks.push(Block::Details(title, everything(record, part)));
        }
        Page { command: "mesh", title, tone, blocks }
    }
}

impl ScalarPart {
    fn grain(&self) -> Grain<'_> {
        let ScalarPart { scalar, spacing, smallest, .. } = self;
        Grain { scalar, spacing: *spacing, smallest: *smallest, unit: "" }
    }
}

/// How it went, in one line.
pub(super) fn verdict(result: &MeshResult) -> (Tone, String) {
    let rows: Vec<&MeshRowResult> = result.scalars.iter().flat_map(|part| &part.results).collect();
    let name = result.mesh.file.rsplit(['/', '\\']).next().unwrap_or(&result.mesh.file);
    let file: String = name.chars().take(120).collect();
    let leaking = rows.iter().filter(|row| 0 < row.leaks()).count();
    let is_broken = rows.iter().any(|row| row.promise().is_some_and(|(_, kept)| !kept));
    let failed = rows.iter().any(|row| 0 < row.edges.failures + row.vertices.failures);
    let is_asked = result.scalars.iter().any(|part| part.rays != [0, 0]);
    let tone = match (is_broken, leaking) {
        (true, _) => Tone::Bad,
        (false, 0) if !failed && is_asked => Tone::Good,
        _ => Tone::Plain,
    };
    let rays: u64 = result.scalars.iter().flat_map(|part| part.rays).sum();
    let of = format!("of {} aimed at its edges and vertices", group_digits(rays));
    let title = match (leaking, rows.len()) {
        _ if !is_asked => format!("Nothing to ask of {file}"),
        (0, 1) => format!("No ray slips through {file}, {of}"),
        (0, n) => format!("No ray slips through {file} with {n} kernel rows, {of}"),
        (1, 1) => format!("Rays slip through {file}"),
        (k, n) => format!("Rays slip through {file} with {k} of {n} kernel rows"),
    };
    (tone, title)
}

/// The mesh in one scalar, and the rows, those that leak least first; rows that answer alike stand together.
fn of_scalar(record: &MeshRecord, part: &ScalarPart) -> Vec<Block> {
    let mut blocks = vec![Block::terms(topology_terms(part))];
    if part.rays == [0, 0] {
        return blocks;
    }
    let mut rows: Vec<&MeshRowResult> = part.results.iter().collect();
    rows.sort_by_key(|row| (row.leaks(), row.both(|rates| &rates.doubles).count));
    let counts = |row: &MeshRowResult| {
        let rates: [fn(&AcrossRates) -> &Rate; 3] =
            [|rates| &rates.cracks, |rates| &rates.doubles, |rates| &rates.odd_folds];
        (row.edges.cracked, row.vertices.cracked, rates.map(|rate| row.both(rate).count))
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
    let row = |(row, alike): &(&MeshRowResult, Vec<&MeshRowResult>)| {
        let time = times.and_then(|times| times.get(&row.label()));
        let promised = row.promised != Promised::Nothing;
        let exactly = row.promised == Promised::ExactlyOne;
        let share = |rate: &Rate, is_promised: bool| Cell {
            text: rate.rate.map_or("-".to_owned(), percent),
            is_broken: is_promised && 0 < rate.count,
            share: rate.rate,
        };
        let cells = [
            share(&row.edges.total.cracks, promised),
            share(&row.vertices.total.cracks, promised),
            share(&row.both(|rates| &rates.doubles), exactly),
            share(&row.both(|rates| &rates.odd_folds), exactly),
            group_digits(row.edges.cracked).into(),
            group_digits(row.vertices.cracked).into(),
            time.map_or("-".to_owned(), |time| format!("{time:.1}")).into(),
        ];
        let mut below = Vec::new();
        if !alike.is_empty() {
            let alike: Vec<String> = alike.iter().map(|other| short_label(other)).collect();
            below.push(format!("same counts: {}", alike.join(", ")));
        }
        if let Some((hits, is_kept)) = row.promise() {
            let kept = if is_kept { "kept" } else { "BROKEN" };
            below.push(format!("promises hits {hits} where a ray crosses: {kept}"));
        }
        Row { below, ..Row::new(short_label(row), cells) }
    };
    let rows = shown.iter().map(row).collect();
    blocks.push(Block::Table(Table::new(heads, rows).at_most(MOST_ROWS)));
    blocks
}

/// The topology, and how many rays were aimed.
fn topology_terms(part: &ScalarPart) -> Vec<(&'static str, String)> {
    let mut terms = topology_lines(&part.topology);
    let [edges, vertices] = part.rays.map(group_digits);
    terms.push((
        "aimed",
        format!(
            "{edges} rays at edges, {vertices} at vertices, in {} ({})",
            part.scalar,
            number_of(part.topology.points, "point", "points")
        ),
    ));
    terms
}

/// The commands that show the first places: of rows that break a promise, then of those that leak least.
fn first_places(result: &MeshResult) -> Vec<Command> {
    let mut rows: Vec<&MeshRowResult> =
        result.scalars.iter().flat_map(|part| &part.results).collect();
    rows.sort_by_key(|row| (row.promise().is_none_or(|(_, kept)| kept), row.leaks()));
    let examples = rows.iter().flat_map(|row| examples(row, 1, false).into_iter().take(1));
    let command =
        |(_, example): (String, &MeshExample)| Command { line: example.command.clone(), what: "" };
    examples.map(command).take(MOST_PLACES).collect()
}

/// Each row with its intervals, and the places that were kept.
fn everything(record: &MeshRecord, part: &ScalarPart) -> Vec<Block> {
    let heads = ["kernel (epsilons)", "edges [95 %]", "vertices [95 %]", "elsewhere"];
    let rate = |rate: &Rate| interval_of(rate).trim_matches([' ', '(', ')']).to_owned();
    let row = |row: &MeshRowResult| {
        let elsewhere = row.edges.total.elsewhere.count + row.vertices.total.elsewhere.count;
        let cells = [
            rate(&row.edges.total.cracks),
            rate(&row.vertices.total.cracks),
            group_digits(elsewhere),
        ];
        Row::new(row.label(), cells)
    };
    let rows = part.results.iter().map(row).collect();
    let mut blocks = vec![Block::Table(Table::new(heads.map(Head::of).into(), rows))];
    blocks.push(Block::text(format!(
        "{}, digest {}",
        record.provenance.tool, record.result.mesh.digest
    )));
    for row in &part.results {
        let count = row.edges.failures + row.vertices.failures;
        if 0 < count {
            let count = group_digits(count);
            let text = format!("{}: no verdict on some triangle of {count} rays", row.label());
            blocks.push(Block::Text(text));
        }
        let first = row.edges.first_failures.iter().chain(&row.vertices.first_failures).next();
        blocks.extend(first.map(|first| Block::Listing(format!("    {}", first.command))));
        let examples = examples(row, usize::MAX, true);
        if examples.is_empty() {
            blocks.push(Block::Text(format!("{}: nowhere", row.label())));
            continue;
        }
        blocks.push(Block::Text(row.label()));
        let line = |(what, example): (String, &MeshExample)| {
            format!("    {what}: {}\n        {}", place(example), example.command)
        };
        blocks.push(Block::Listing(examples.into_iter().map(line).collect::<Vec<_>>().join("\n")));
    }
    blocks
}

/// The topology of the mesh, and where it first is not what rays can be asked about: lines with their heads.
pub(super) fn topology_lines(topology: &TopologyPart) -> Vec<(&'static str, String)> {
    let kinds = [
        ("faces", &topology.faces, FACE_WORDS),
        ("edges", &topology.edges, EDGE_WORDS),
        ("vertices", &topology.vertices, VERTEX_WORDS),
    ];
    let mut lines = Vec::new();
    for (name, kinds, words) in kinds {
        let count = |key: &&(&str, &str)| kinds.get(key.0).is_some_and(|noted| noted.count > 0);
        let mut parts: Vec<String> = Vec::new();
        for (i, (key, word)) in words.iter().filter(count).enumerate() {
            let noted = &kinds[*key];
            let first = match (noted.first_line, noted.first_face) {
                // The first of the regular ones tells nothing.
                _ if i == 0 && *key == words[0].0 => String::new(),
                (Some(line), _) => format!(" (first at line {line})"),
                (_, Some(face)) => format!(" (first at face {face})"),
                _ => String::new(),
            };
            parts.push(format!("{} {word}{first}", group_digits(noted.count)));
        }
        lines.push((name, if parts.is_empty() { "none".to_owned() } else { parts.join(", ") }));
    }
    if topology.duplicated_places > 0 {
        let places = group_digits(topology.duplicated_places);
        lines.push(("", format!("the duplicated faces lie in {places} places")));
    }
    if topology.closed_manifold {
        lines.push(("", "a closed surface, wound consistently".to_owned()));
    }
    lines
}

/// The note on the shares in the table.
const SHARES: &str = "Cracks: % of rays aimed at edges, and of rays aimed at vertices, that cross the surface there; doubles, \
and wrong at folds: of both together. Rays at the whole mesh rarely come so near an edge. Sorted by leaks at these epsilons; \
`hairline epsilon --mesh` finds better ones, and weighs lost and false hits too.";

const FACE_WORDS: &[(&str, &str)] = &[
    ("sound", "sound"),
    ("collapsed", "with two equal vertices"),
    ("without_area", "without area"),
    ("duplicated", "duplicated"),
    ("out_of_range", "out of range"),
    ("left_out", "left out, polygons that cross themselves or fold over"),
];
const EDGE_WORDS: &[(&str, &str)] = &[
    ("shared", "between two faces"),
    ("open", "open"),
    ("inconsistent", "of two faces wound inconsistently"),
    ("non_manifold", "non-manifold"),
    ("unsound", "at faces that are not sound"),
];
const VERTEX_WORDS: &[(&str, &str)] = &[
    ("closed_fan", "inside a closed fan"),
    ("open_fan", "on the boundary"),
    ("several_fans", "of several fans"),
    ("irregular", "at edges or faces not asked about"),
];

/// The label without the set of published epsilons.
fn short_label(row: &MeshRowResult) -> String {
    if row.set == "source" { row.kernel.clone() } else { row.label() }
}

/// So many findings of each kind and class: cracks, and what else the row's contract speaks of; what
/// may be elsewhere, which is no finding, on demand.
fn examples(row: &MeshRowResult, limit: usize, elsewhere: bool) -> Vec<(String, &MeshExample)> {
    let mut all = Vec::new();
    for (name, result) in [("edge", &row.edges), ("vertex", &row.vertices)] {
        for (class, found) in &result.classes {
            let mut lists = vec![("crack", &found.first_cracks)];
            if row.promised == Promised::ExactlyOne {
                lists.push(("double", &found.first_doubles));
                lists.push(("wrong at a fold", &found.first_odd_folds));
            }
            if elsewhere {
                lists.push(("elsewhere", &found.first_elsewhere));
            }
            for (what, list) in lists {
                let named = |example| (format!("{what}, {name}, {class}"), example);
                all.extend(list.iter().take(limit).map(named));
            }
        }
    }
    all
}

/// The points, and the lines of the faces, or their numbers.
fn place(example: &MeshExample) -> String {
    let points: Vec<String> =
        example.points.iter().map(|[x, y, z]| format!("({x}, {y}, {z})")).collect();
    let (at, places) = match example.lines.as_slice() {
        [] => ("", &example.faces),
        _ => ("at lines ", &example.lines),
    };
    let mut places: Vec<String> = places.iter().map(u32::to_string).collect();
    places.dedup();
    let more = if places.len() > 8 { ", …" } else { "" };
    places.truncate(8);
    format!("{}, faces {at}{}{more}", points.join(" to "), places.join(", "))
}
