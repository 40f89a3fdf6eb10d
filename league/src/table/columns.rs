//! The table of all entrants: rates by groups of families.

use super::rows::TableRow;
use hairline::internals::report::{Example, Rate};
use std::fmt::Write;

/// Families that ask alike.
struct Group {
    name: &'static str,
    families: &'static [&'static str],
}

const GROUPS: &[Group] = &[
    Group {
        name: "plain",
        families: &["interior", "outside", "behind", "axis-aligned", "lattice"],
    },
    Group {
        name: "edges",
        families: &[
            "edge-exact",
            "edge-near",
            "vertex-exact",
            "vertex-near",
            "shared-edge",
            "fan",
            "polygon",
        ],
    },
    Group { name: "slanted", families: &["grazing", "sliver", "parallel-off"] },
    Group {
        name: "start",
        families: &["origin-on", "origin-near", "secondary-ray", "interval-ends"],
    },
    Group { name: "size", families: &["tiny", "huge", "far", "direction-length"] },
    Group { name: "range", families: &["mixed-scale", "range-ends"] },
];

/// The groups whose coordinates and directions are of ordinary size.
const ORDINARY: &[&str] = &["plain", "edges", "slanted"];

/// The tables of all entrants.
pub fn tables(rows: &[TableRow], off_the_boundary: &[TableRow]) -> String {
    let mut text = String::new();
    text.push_str("False misses / false hits, in % of the cases that must be hit / missed, of the cases \
        that are farther than 4 ulps of their largest coordinate from where another verdict would be \
        right: what is false here is not a matter of the last digits of the input.\n\n");
    group_table(&mut text, off_the_boundary);
    text.push_str("\nThe same of all cases, those within some ulps of an edge included:\n\n");
    group_table(&mut text, rows);
    writeln!(text, "\nWhere triangles meet, errors of t, and time:\n").unwrap();
    let head = "cracks | doubles | across triangles it promises | t of `interior` off by ulps: half of the hits, 99 % | ns/ray";
    writeln!(text, "| kernel | scalar | {head} |\n|---|---|---|---|---|---|---|").unwrap();
    for row in rows {
        let [cracks, doubles, promised] = across(row);
        let errors = row.t_errors.map_or("gives no t".to_owned(), |[half, most]| {
            format!("{}, {}", number(half), number(most))
        });
        let time = row.nanoseconds.map_or(String::new(), |time| format!("{time:.0}"));
        let (name, scalar) = (row.entrant.name, row.scalar);
        writeln!(
            text,
            "| {name} | {scalar} | {cracks} | {doubles} | {promised} | {errors} | {time} |"
        )
        .unwrap();
    }
    writeln!(text, "\nThe worst of the groups {}: how far the line passes from the triangle's boundary, inside it for a false miss and outside for a false hit, in longest edges (along the ray for a hit behind its start):\n", ORDINARY.join(", ")).unwrap();
    writeln!(text, "| kernel | scalar | | by | shown by |\n|---|---|---|---|---|").unwrap();
    for row in rows {
        for finding in ["false-miss", "false-hit"] {
            if let Some((severity, example)) = worst(row, finding) {
                let (name, scalar) = (row.entrant.name, row.scalar);
                let command = command(row, example);
                let size = number(severity);
                writeln!(text, "| {name} | {scalar} | {finding} | {size} | `{command}` |").unwrap();
            }
        }
    }
    text.push('\n');
    text
}

/// One row an entrant and scalar, one column a group.
fn group_table(text: &mut String, rows: &[TableRow]) {
    let names: Vec<&str> = GROUPS.iter().map(|group| group.name).collect();
    writeln!(text, "| kernel | scalar | {} |", names.join(" | ")).unwrap();
    writeln!(text, "|---|---{}|", "|---".repeat(names.len())).unwrap();
    for row in rows {
        let cells: Vec<String> = GROUPS.iter().map(|group| cell(row, group)).collect();
        let name = row.entrant.name;
        writeln!(text, "| {name} | {} | {} |", row.scalar, cells.join(" | ")).unwrap();
    }
}

/// Why the verdicts were false, of the entrants whose formula is modelled.
pub fn causes(rows: &[TableRow]) -> String {
    let mut text =
        "Why, of the entrants whose formula is modelled (`src/model.rs`; verdicts agree bit for \
        bit): run without rounding and with its epsilons, or with none. Over all groups.\n\n\
        | kernel | scalar | | count | epsilon | rounding | range | convention |\n\
        |---|---|---|---|---|---|---|---|\n"
            .to_owned();
    for row in rows {
        for finding in ["false-miss", "false-hit"] {
            let parts = row.results.iter().flat_map(|result| &result.findings);
            let parts: Vec<_> = parts.filter(|part| part.finding == finding).collect();
            let count: u64 = parts.iter().map(|part| part.rate.count).sum();
            let told = parts.iter().any(|part| part.causes.as_ref().is_some_and(|c| c.untold == 0));
            if count == 0 || !told {
                continue;
            }
            let share = |name: &str| {
                let cases = parts.iter().filter_map(|part| {
                    let rate = part.causes.as_ref()?.by.get(name)?.rate?;
                    Some(rate * part.rate.count as f64)
                });
                percent(cases.sum::<f64>().round() as u64, count)
            };
            let shares = ["epsilon", "rounding", "range", "convention"].map(share).join(" % | ");
            let (name, scalar) = (row.entrant.name, row.scalar);
            let count = digits(count);
            writeln!(text, "| {name} | {scalar} | {finding} | {count} | {shares} % |").unwrap();
        }
    }
    text.push('\n');
    text
}

/// The command that shows an example, with the program that knows the kernel.
pub fn command(row: &TableRow, example: &Example) -> String {
    let program = match row.entrant.kernel {
        Some(_) => "league",
        // Known by its name in a program, and not in this one.
        None if row.plan.selector.starts_with("--kernel ") => "league-heavy",
        None => "hairline",
    };
    example.command.replacen("hairline", program, 1)
}

fn cell(row: &TableRow, group: &Group) -> String {
    let mut sums = [[0; 2]; 2];
    for result in row.results.iter().filter(|r| group.families.contains(&r.family.as_str())) {
        for (sum, rate) in
            sums.iter_mut().zip([&result.total.false_misses, &result.total.false_hits])
        {
            *sum = [sum[0] + rate.count, sum[1] + rate.of];
        }
    }
    sums.map(|[count, of]| percent(count, of)).join(" / ")
}

/// A share in percent, with as many digits as it takes to tell it from 0.
pub fn percent(count: u64, of: u64) -> String {
    match (count, of) {
        (_, 0) => "–".to_owned(),
        (0, _) => "0".to_owned(),
        _ => {
            let share = 100.0 * count as f64 / of as f64;
            match share {
                share if share >= 0.1 => format!("{share:.1}"),
                share if share >= 0.001 => format!("{share:.3}"),
                share => format!("{share:.0e}"),
            }
        }
    }
}

/// Cracks and doubles over all groups of triangles, and what the contract promises.
fn across(row: &TableRow) -> [String; 3] {
    let parts: Vec<_> = row.results.iter().filter_map(|result| result.across.as_ref()).collect();
    let sum = |rate: fn(&hairline::internals::report::AcrossPart) -> &Rate| {
        let (count, of) = parts
            .iter()
            .map(|part| (rate(part).count, rate(part).of))
            .fold((0, 0), |sum: (u64, u64), part| (sum.0 + part.0, sum.1 + part.1));
        match of {
            0 => "–".to_owned(),
            _ => format!("{} of {} ({} %)", digits(count), digits(of), percent(count, of)),
        }
    };
    let promised = parts.first().map_or("", |part| part.promised.as_str()).to_owned();
    [sum(|part| &part.cracks), sum(|part| &part.doubles), promised]
}

/// The example with the largest distance from where the verdict would be right.
pub fn worst<'a>(row: &TableRow<'a>, finding: &str) -> Option<(f64, &'a Example)> {
    let ordinary = |family: &str| {
        let groups = GROUPS.iter().filter(|group| ORDINARY.contains(&group.name));
        groups.flat_map(|group| group.families).any(|name| *name == family)
    };
    let findings = row.results.iter().filter(|r| ordinary(&r.family)).flat_map(|r| &r.findings);
    let sized = findings.filter(|part| part.finding == finding).filter_map(|part| {
        let severity = part.worst.severity.as_ref()?;
        let is_behind = part.class.ends_with("/before") && !part.class.starts_with("outside");
        let size = if is_behind { severity.along? } else { severity.in_space };
        Some((size, &part.worst))
    });
    sized.max_by(|a, b| a.0.total_cmp(&b.0))
}

/// Digits in groups of three.
pub fn digits(number: u64) -> String {
    let text = number.to_string();
    let place = |i: usize| i > 0 && (text.len() - i).is_multiple_of(3);
    let grouped = text.char_indices().map(|(i, c)| match place(i) {
        true => format!(",{c}"),
        false => c.to_string(),
    });
    grouped.collect()
}

fn number(x: f64) -> String {
    match x {
        x if x == 0.0 => "0".to_owned(),
        x if (0.01..1000.0).contains(&x) => format!("{x:.2}"),
        x => format!("{x:.1e}"),
    }
}
