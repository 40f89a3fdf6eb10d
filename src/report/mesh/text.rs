//! The record of a mesh audit as text for people: the mesh, a table a scalar, the first cracks.

use super::record::*;
use crate::report::formats::text::share_column;
use crate::report::formats::text::short_count;
use crate::report::{Promised, Rate, Style, group_digits, number_of};
use std::io::{self, Write};

/// Writes the record. The layout is for people and not stable.
pub(super) fn write(report: &MeshReport, style: Style, out: &mut dyn Write) -> io::Result<()> {
    let record = &report.record;
    let (result, provenance) = (&record.result, &record.provenance);
    writeln!(
        out,
        "{}, {}: {}, {}, digest {}",
        provenance.tool,
        result.mesh.file,
        number_of(result.mesh.triangles, "triangle", "triangles"),
        number_of(result.mesh.vertices, "vertex", "vertices"),
        result.mesh.digest
    )?;
    writeln!(
        out,
        "{} at each edge and vertex{}, seed {}, {}, {:.1} s",
        number_of(result.directions, "ray", "rays"),
        if result.unit_directions { " with unit directions" } else { "" },
        result.seed,
        number_of(provenance.threads as u64, "thread", "threads"),
        provenance.seconds
    )?;
    result.scalars.iter().try_for_each(|part| write_scalar(record, part, style, out))
}

fn write_scalar(
    record: &MeshRecord,
    part: &ScalarPart,
    style: Style,
    out: &mut dyn Write,
) -> io::Result<()> {
    let (bold, plain) = if style.color { ("\x1b[1m", "\x1b[0m") } else { ("", "") };
    let topology = &part.topology;
    writeln!(out, "\n{bold}{}{plain}, {} points", part.scalar, group_digits(topology.points))?;
    for (name, line) in topology_lines(topology) {
        writeln!(out, "  {name:<10} {line}")?;
    }
    let [edges, vertices] = part.rays.map(group_digits);
    writeln!(out, "  aimed      {edges} rays at edges, {vertices} at vertices")?;
    if part.rays == [0, 0] {
        return Ok(());
    }
    writeln!(
        out,
        "\n{bold}{:<37} {:<12} {:>20} {:>20} {:>20} {:>20} {:>9} {:>9} {:>9} {:>6}{plain}",
        "kernel (epsilons)",
        "promises",
        "cracks at edges, %",
        "at vertices, %",
        "doubles, %",
        "wrong at folds, %",
        "elsewhere",
        "edges",
        "vertices",
        "ns/ray"
    )?;
    let times = record.provenance.kernel_nanoseconds.get(part.scalar);
    for row in &part.results {
        let label = label(row);
        let time = times.and_then(|times| times.get(&label)).copied().unwrap_or(f64::NAN);
        let both = |rate: fn(&AcrossRates) -> &Rate| {
            Rate::sum([&row.edges.total, &row.vertices.total].map(rate))
        };
        writeln!(
            out,
            "{label:<37} {:<12} {} {} {} {} {:>9} {:>9} {:>9} {time:>6.1}",
            row.promised,
            share_column(&row.edges.total.cracks, style),
            share_column(&row.vertices.total.cracks, style),
            // What nobody promised is no error.
            share_column(
                &both(|rates| &rates.doubles),
                Style { color: style.color && row.promised == Promised::ExactlyOne, ..style }
            ),
            share_column(&both(|rates| &rates.odd_folds), style),
            short_count(row.edges.total.elsewhere.count + row.vertices.total.elsewhere.count),
            short_count(row.edges.cracked),
            short_count(row.vertices.cracked),
        )?;
    }
    writeln!(out, "\n{SHARES}")?;
    write_failures(part, out)?;
    write_examples(part, style, out)
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
            let noted = &kinds[key];
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
const SHARES: &str = "\
cracks: % of rays aimed at edges, and of rays aimed at vertices, that cross the surface there; doubles, and wrong at
folds: of both together. Rays at the whole mesh rarely come so near an edge. edges, vertices: how many leak.";

const FACE_WORDS: &[(&str, &str)] = &[
    ("sound", "sound"),
    ("collapsed", "with two equal vertices"),
    ("without_area", "without area"),
    ("duplicated", "duplicated"),
    ("out_of_range", "out of range"),
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

pub(super) fn label(row: &MeshRowResult) -> String {
    format!("{} ({})", row.kernel, row.set)
}

/// The kernels that gave no verdict on some rays.
fn write_failures(part: &ScalarPart, out: &mut dyn Write) -> io::Result<()> {
    for row in &part.results {
        let count = row.edges.failures + row.vertices.failures;
        let first = row.edges.first_failures.iter().chain(&row.vertices.first_failures).next();
        if count > 0 {
            let count = group_digits(count);
            writeln!(out, "{}: no verdict on some triangle of {count} rays", label(row))?;
        }
        if let Some(first) = first {
            writeln!(out, "    {}", first.command)?;
        }
    }
    Ok(())
}

/// Where the first findings are: of each class of rays if there are few rows, or with details.
fn write_examples(part: &ScalarPart, style: Style, out: &mut dyn Write) -> io::Result<()> {
    let (bold, plain) = if style.color { ("\x1b[1m", "\x1b[0m") } else { ("", "") };
    let of_each_class = style.details || part.results.len() <= 2;
    let limit = if style.details { usize::MAX } else { 1 };
    writeln!(out, "\n{bold}Where{plain}")?;
    for row in &part.results {
        let mut examples = examples(row, limit, style.details);
        if examples.is_empty() {
            writeln!(out, "{}: nowhere", label(row))?;
            continue;
        }
        if !of_each_class {
            examples.truncate(1);
        }
        writeln!(out, "{}", label(row))?;
        for (what, example) in examples {
            writeln!(out, "    {what}: {}", place(example))?;
            writeln!(out, "        {}", example.command)?;
        }
    }
    Ok(())
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
