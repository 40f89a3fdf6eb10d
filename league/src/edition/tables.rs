//! The table of an edition, for a page, for the web and for a paper: the same cells.

use super::audit::{Depth, EntrantResult, ScalarResult, Share};
use std::cmp::Ordering;
use std::fmt::Write;

/// The heads of the columns.
pub const HEAD: [&str; 10] = [
    "kernel",
    "version",
    "scalar",
    "claim",
    "edges",
    "vertices",
    "parallel",
    "cracks, doubles",
    "deepest",
    "ns",
];

/// What the columns say.
pub const CAPTION: &str = "False misses / false hits in % of the cases that must be hit / missed, at edges, \
    at vertices, and with rays nearly parallel to the triangle; rays through shared edges and vertices that \
    hit nothing (cracks) or more than one triangle (doubles), in %; the deepest false miss / false hit, in \
    longest edges from where it would be right; the time of a ray, which includes the pipe or the scene \
    where there is one (*). Claim, of what the documentation says: held (every false verdict is within \
    4 ulps of the input), rounding (within half of the digits), refuted, size (refuted for triangles or \
    directions that are small, large or far only, or by cracks where coordinates of about 1 stand beside some of \
    about 2^-53, which the column of cracks leaves out), and - where nothing is claimed.";

/// One row an entrant and scalar, with its cells. They stand by what became of the documentation's promises: held,
/// rounding, size, refuted; then those that promise nothing. Within each by the deepest false verdict. No rate counts,
/// because a rate depends on our mix of cases.
pub fn rows(results: &[EntrantResult]) -> Vec<(&EntrantResult, &str, [String; 10])> {
    let mut all: Vec<(&EntrantResult, &str, &ScalarResult)> = Vec::new();
    for entrant in results {
        let scalars = entrant.scalars.iter();
        all.extend(scalars.map(|(scalar, result)| (entrant, scalar.as_str(), result)));
    }
    all.sort_by(|(_, _, a), (_, _, b)| by_promises(a, b));
    let row = |(entrant, scalar, result)| (entrant, scalar, row(entrant, scalar, result));
    all.into_iter().map(row).collect()
}

/// Who keeps what its documentation promises comes first. Equal ones stay in their order.
fn by_promises(a: &ScalarResult, b: &ScalarResult) -> Ordering {
    const VERDICTS: [&str; 5] = ["held", "rounding", "refuted by size", "refuted", "none"];
    let rank = |result: &ScalarResult| VERDICTS.iter().position(|word| *word == result.verdict);
    let deepest = |result: &ScalarResult| match result.verdict.as_str() {
        // A false verdict breaks no promise here.
        "none" => 0.0,
        _ => [&result.deepest_miss, &result.deepest_hit]
            .map(edges)
            .into_iter()
            .fold(0.0, f64::max),
    };
    rank(a)
        .cmp(&rank(b))
        .then(deepest(a).total_cmp(&deepest(b)))
}

/// 0 without a false verdict.
fn edges(depth: &Option<Depth>) -> f64 {
    depth.as_ref().map_or(0.0, |depth| depth.edges)
}

/// The cells of a row.
pub fn row(entrant: &EntrantResult, scalar: &str, result: &ScalarResult) -> [String; 10] {
    let group = |name: &str| match result.groups.get(name) {
        Some(shares) => shares.map(percent).join(" / "),
        None => String::new(),
    };
    let deepest = [&result.deepest_miss, &result.deepest_hit].map(|depth| short(edges(depth)));
    [
        entrant.kernel.clone(),
        entrant.version.clone(),
        scalar.to_owned(),
        claim(result).to_owned(),
        group("edges"),
        group("vertices"),
        group("parallel"),
        format!("{}, {}", percent(result.cracks), percent(result.doubles)),
        deepest.join(" / "),
        time(entrant, result),
    ]
}

/// The claim's column.
pub fn claim(result: &ScalarResult) -> &str {
    match result.verdict.as_str() {
        "none" => "-",
        "refuted by size" => "size",
        verdict => verdict,
    }
}

fn time(entrant: &EntrantResult, result: &ScalarResult) -> String {
    let by_itself = crate::entrants().iter().any(|other| {
        other.name == entrant.kernel && !matches!(other.run, crate::Run::Process { .. })
    });
    let mark = if by_itself { "" } else { "*" };
    result
        .nanoseconds
        .map_or(String::new(), |time| format!("{time:.0}{mark}"))
}

/// With as many digits as it takes to tell it from 0.
fn percent(Share { count, of }: Share) -> String {
    match (count, of) {
        (_, 0) => "-".to_owned(),
        (0, _) => "0".to_owned(),
        _ => match 100.0 * count as f64 / of as f64 {
            share if share >= 10.0 => format!("{share:.0}"),
            share if share >= 0.1 => format!("{share:.1}"),
            share => format!("{share:.0e}"),
        },
    }
}

fn short(x: f64) -> String {
    match x {
        0.0 => "0".to_owned(),
        x if (0.01..1000.0).contains(&x) => format!("{x:.2}"),
        x => format!("{x:.0e}"),
    }
}

/// The table for a page, without its caption.
pub fn markdown(results: &[EntrantResult]) -> String {
    let mut text = format!("| {} |\n|{}\n", HEAD.join(" | "), "---|".repeat(HEAD.len()));
    for (_, _, row) in rows(results) {
        writeln!(
            text,
            "| {} |",
            row.map(|cell| cell.replace('*', "\\*")).join(" | ")
        )
        .unwrap();
    }
    text
}

/// A page by itself.
pub fn html(edition: &str, results: &[EntrantResult]) -> String {
    let escape = |cell: &str| {
        cell.replace('&', "&amp;")
            .replace('<', "&lt;")
            .replace('>', "&gt;")
    };
    let line = |tag: &str, cells: &[String]| {
        let cells = cells
            .iter()
            .map(|cell| format!("<{tag}>{}</{tag}>", escape(cell)));
        format!("<tr>{}</tr>\n", cells.collect::<String>())
    };
    let body: String = rows(results)
        .iter()
        .map(|(_, _, row)| line("td", row))
        .collect();
    format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<meta charset=\"utf-8\">\n<title>{edition}</title>\n<style>\n\
        body {{ font: 14px/1.4 system-ui, sans-serif; margin: 2em auto; max-width: 80em; padding: 0 1em }}\n\
        table {{ border-collapse: collapse }}\nth, td {{ border-bottom: 1px solid #ddd; padding: .2em .7em; \
        text-align: right; white-space: nowrap }}\nth:first-child, td:first-child {{ text-align: left }}\n\
        </style>\n<h1>{edition}</h1>\n<p>{}</p>\n<table>\n<thead>\n{}</thead>\n<tbody>\n{body}</tbody>\n\
        </table>\n</html>\n",
        escape(CAPTION),
        line("th", &HEAD.map(str::to_owned)),
    )
}

/// A table for a paper: needs the packages booktabs and longtable.
pub fn latex(edition: &str, results: &[EntrantResult]) -> String {
    let escape = |cell: &str| {
        cell.replace('%', "\\%")
            .replace('_', "\\_")
            .replace('&', "\\&")
    };
    let line = |cells: &[String]| {
        let cells: Vec<String> = cells.iter().map(|cell| escape(cell)).collect();
        format!("{} \\\\\n", cells.join(" & "))
    };
    let body: String = rows(results).iter().map(|(_, _, row)| line(row)).collect();
    format!(
        "% {edition}: \\usepackage{{booktabs,longtable}}\n\\begin{{longtable}}{{lll l{}}}\n\
        \\caption{{{}}} \\\\\n\\toprule\n{}\\midrule\n\\endhead\n{body}\\bottomrule\n\\end{{longtable}}\n",
        "r".repeat(HEAD.len() - 4),
        escape(CAPTION),
        line(&HEAD.map(str::to_owned)),
    )
}
