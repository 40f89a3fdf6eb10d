//! The record of `spawn` for people at a terminal: what to use, then what each scheme does. The layout is not
//! stable.

use super::choice::derived_name;
use super::record::{DerivedPart, HeightsPart, PointsPart, SchemePart, SpawnRecord};
use crate::case::{Number, SceneKind};
use crate::kernel::{self, Role};
use crate::report::elsewhere::{self, Compared};
use crate::report::{Rate, Style, group_digits, interval_of, percent};
use crate::spawn::describe;
use std::io::{self, Write};

/// Writes a block for each kernel, kind of hit point and scalar, and a legend.
pub fn write(record: &SpawnRecord, _: Style, out: &mut dyn Write) -> io::Result<()> {
    for (i, part) in record.points.iter().enumerate() {
        if i > 0 {
            writeln!(out)?;
        }
        heading(record, part, out)?;
        advice(record, part, out)?;
        if 0 < part.hits {
            table(record, part, out)?;
            elsewhere(record, part, out)?;
        }
        least(record, part, out)?;
    }
    legend(record, out)
}

fn of_unit(unit: &str) -> String {
    if unit.is_empty() { String::new() } else { format!(" ({unit})") }
}

fn heading(record: &SpawnRecord, part: &PointsPart, out: &mut dyn Write) -> io::Result<()> {
    let point = match part.point.as_str() {
        "uv" => "hit points from u and v",
        _ => "hit points o + t*d",
    };
    let (kernel, scalar, scene) = (&part.kernel, &part.scalar, &record.scene);
    let set = if part.set == "source" { String::new() } else { format!(" ({})", part.set) };
    writeln!(out, "{kernel}{set} {scalar}, {point}, in {scene}{}", of_unit(&record.unit))
}

fn advice(record: &SpawnRecord, part: &PointsPart, out: &mut dyn Write) -> io::Result<()> {
    let hits = group_digits(part.hits);
    let find = |name: &String| part.schemes.iter().find(|scheme| scheme.name == *name);
    match &part.best {
        None if part.hits == 0 => writeln!(
            out,
            "  the kernel hits no triangle of this scene: give it other epsilons (`hairline epsilon --scene`)"
        )?,
        None => writeln!(
            out,
            "  every offset below fails for some of the {hits} new rays: use a larger one, or f64"
        )?,
        Some(best) => {
            let median = find(&best.scheme).and_then(|scheme| scheme.height_in_edges.median);
            let median = size(median.unwrap_or(0.0));
            if best.is_too_high {
                writeln!(
                    out,
                    "  none of these: the lowest that never fails, {}, is too high. Half of its new rays start {median} of\n  \
                     their triangle's longest edge above it or more, and pass walls",
                    best.scheme
                )?;
                return writeln!(
                    out,
                    "  leave out --scheme, and offsets are made for the scene; if these are too high as well, use f64"
                );
            }
            writeln!(out, "  use  {}{}", best.scheme, describe(&best.scheme))?;
            if let Some(derived) = part.derived.as_ref().filter(|_| best.is_derived) {
                writeln!(
                    out,
                    "       derived bound: no wrong side on any ray of such a scene with {}",
                    weights(derived)
                )?;
                if !shows_edges(part) {
                    writeln!(
                        out,
                        "       if the kernel lets no other weights through: it shows no test of them"
                    )?;
                }
            }
            writeln!(
                out,
                "       no wrong side or self-hit on two seeds: 0 of {hits}, at most 1 in {} (95 % sure)",
                group_digits(best.one_in)
            )?;
            if 1 < record.planes.len() {
                writeln!(
                    out,
                    "       nor on planes or with rays of any other kind (listed below)"
                )?;
            }
            writeln!(
                out,
                "       half of the new rays start at most {median} of their triangle's longest edge above it"
            )?;
            writeln!(out, "       {}", best.command)?;
        }
    }
    Ok(())
}

/// The hypothesis of a derived bound.
fn weights(derived: &DerivedPart) -> String {
    let DerivedPart { least_weight, largest_weight, .. } = derived;
    format!("u, v and 1-u-v from {} to {}", Number(*least_weight), Number(*largest_weight))
}

/// True if the kernel shows a test that keeps the weights in a range; without one only the rays that were tried say so.
fn shows_edges(part: &PointsPart) -> bool {
    let entry = kernel::find(&part.kernel);
    entry.is_some_and(|entry| entry.info.gates.iter().any(|gate| gate.role == Role::Edge))
}

/// Three digits at most: `0.0123`, `2.05`, `1.2e-7`.
fn size(x: f64) -> String {
    match x.abs() {
        0.0 => "0".to_owned(),
        x if !x.is_finite() => "inf".to_owned(),
        1e5.. => format!("{x:.0e}"),
        100.0.. => format!("{x:.0}"),
        10.0.. => format!("{x:.1}"),
        1.0.. => format!("{x:.2}"),
        0.01.. => format!("{x:.3}"),
        _ => format!("{x:.1e}"),
    }
}

fn table(record: &SpawnRecord, part: &PointsPart, out: &mut dyn Write) -> io::Result<()> {
    let wall = format!("past {}", record.wall);
    let fold = format!("of {}\u{b0}", record.fold);
    writeln!(
        out,
        "{:<16}{:<21}{:>7}  {:^26}{:>8}{:>10}{:>9}{:>8}",
        "", "wrong side", "self-", "height in triangles", "in ulps", "a wall", "a fold", "times"
    )?;
    writeln!(
        out,
        "{:<16}{:<21}{:>7}{:>9}{:>9}{:>9}{:>9}{:>10}{:>9}{:>8}",
        "offset",
        "[95 % interval]",
        "hits",
        "median",
        "99 %",
        "top seen",
        "median",
        wall,
        fold,
        "least"
    )?;
    part.schemes.iter().try_for_each(|scheme| row(scheme, out))
}

/// The shares of wrong sides on other kinds of planes, of the schemes that are worse there.
fn elsewhere(record: &SpawnRecord, part: &PointsPart, out: &mut dyn Write) -> io::Result<()> {
    let share = |rate: &Rate| rate.rate.map_or("-".to_owned(), percent);
    let rows = part.schemes.iter().map(|scheme| Compared {
        label: scheme.name.clone(),
        own: &scheme.wrong,
        others: scheme.elsewhere.iter().map(|other| &other.wrong).collect(),
    });
    elsewhere::write("more wrong sides", &record.planes, &rows.collect::<Vec<_>>(), share, out)
}

fn row(scheme: &SchemePart, out: &mut dyn Write) -> io::Result<()> {
    let wrong = interval_of(&scheme.wrong);
    let share = |rate: Option<f64>| rate.map_or("-".to_owned(), percent);
    let height = |height: Option<f64>| height.map_or("behind".to_owned(), size);
    let HeightsPart { median, p99, highest, .. } = &scheme.height_in_edges;
    writeln!(
        out,
        "{:<16}{:<21}{:>7}{:>9}{:>9}{:>9}{:>9}{:>10}{:>9}{:>8}",
        scheme.name,
        wrong.trim_matches([' ', '(', ')']),
        share(scheme.self_hits.rate),
        height(*median),
        height(*p99),
        size(*highest),
        height(scheme.height_in_ulps.median),
        share(scheme.beyond_wall.rate),
        share(scheme.past_neighbour.rate),
        scheme.over_least.map_or("-".to_owned(), size),
    )
}

fn least(record: &SpawnRecord, part: &PointsPart, out: &mut dyn Write) -> io::Result<()> {
    let least = &part.least;
    let unit = if record.unit.is_empty() { String::new() } else { format!(" {}", record.unit) };
    if 0 < least.needed.count {
        let (lengths, ulps) = (&least.lengths, &least.ulps);
        writeln!(
            out,
            "{} of the hit points are themselves wrong. The smallest safe offset along the normal there:\n  \
             median {}{unit}, 99 % {}{unit}, largest seen {}{unit}; in ulps of the point {}, {}, {}",
            percent(least.needed.rate.unwrap_or(0.0)),
            size(lengths.median),
            size(lengths.p99),
            size(lengths.largest),
            size(ulps.median),
            size(ulps.p99),
            size(ulps.largest),
        )?;
    }
    if let Some(derived) = &part.derived {
        writeln!(
            out,
            "derived bound: {}{unit} or more, for {} (by hand: docs/guide/spawn.md)",
            derived_name(derived.normal),
            weights(derived)
        )?;
        if derived.least_weight < 0.0 {
            writeln!(
                out,
                "  that range: at this epsilon the edge test lets no weight below {} through, and the three add up to 1",
                Number(derived.least_weight)
            )?;
        }
    }
    let left_out = [
        (part.missed, "first rays that the kernel missed"),
        (part.without_side, "hits of triangles without area or along their plane"),
        (part.not_finite, "hit points that are not finite"),
        (least.none, "hit points that no offset along the normal helps"),
    ];
    let left_out = left_out.into_iter().filter(|(count, _)| 0 < *count);
    let words: Vec<String> =
        left_out.map(|(count, what)| format!("{} {what}", group_digits(count))).collect();
    if words.is_empty() { Ok(()) } else { writeln!(out, "left out: {}", words.join(", ")) }
}

fn legend(record: &SpawnRecord, out: &mut dyn Write) -> io::Result<()> {
    writeln!(
        out,
        "
p is the hit point, as your code forms it: from u and v, or as o + t*d (--point uv or ray shows one); n the
unit normal on the side that the first ray came from, u half an ulp of 1; new rays leave to that side, in
every direction alike
wrong side   the new ray starts on the exact plane of its triangle or behind it
self-hits    the kernel says that the new ray hits the triangle which it leaves
height       of the start over the plane: in longest edges of the triangle, and in ulps of its coordinates;
             behind: half of the starts (or 99 %) are not above the plane
a wall       starts beyond a wall parallel to the triangle, {} of its longest edge in front of it
a fold       starts behind a neighbour on the edge nearest to p, folded up to {} degrees with the triangle
times least  the way along the normal over the shortest that is right, where p itself is wrong (median)
{}Made for the scene: on seed {}; counted: on seed {}. `hairline list schemes` has the sources;
--format json has a wrong start of each.",
        record.wall,
        record.fold,
        kinds(record),
        record.pilot_seed,
        record.seed
    )
}

/// The kinds of planes and rays in words, where there are several.
fn kinds(record: &SpawnRecord) -> String {
    let kinds = record.planes.iter().filter_map(|name| SceneKind::named(name));
    let words: Vec<_> = kinds.map(|kind| format!("{kind}: {}", kind.in_words())).collect();
    if words.len() < 2 {
        return String::new();
    }
    let lines = words.chunks(2).map(|chunk| chunk.join("; "));
    format!("kinds        {}\n", lines.collect::<Vec<_>>().join(";\n             "))
}
