//! One section an entrant: its contract, and its rates family by family with their intervals.

use super::columns::{command, digits, percent};
use super::rows::TableRow;
use hairline::internals::report::Rate;
use std::fmt::Write;

/// All sections.
pub fn sections(rows: &[TableRow]) -> String {
    let mut text = "## Kernel by kernel\n".to_owned();
    let mut last = "";
    for row in rows {
        let entrant = row.entrant;
        if entrant.name != last {
            last = entrant.name;
            writeln!(text, "\n### {last}\n").unwrap();
            writeln!(text, "{}, `{}`\n", entrant.package, entrant.function).unwrap();
            writeln!(text, "- Contract: {}.", row.plan.contract).unwrap();
            writeln!(text, "- Where it comes from: {}", entrant.promise).unwrap();
        }
        family_table(&mut text, row);
    }
    text
}

fn family_table(text: &mut String, row: &TableRow) {
    writeln!(text, "\n<details><summary>{} by family</summary>\n", row.scalar).unwrap();
    writeln!(text, "| family | false misses | false hits | the worst class, first case |").unwrap();
    writeln!(text, "|---|---|---|---|").unwrap();
    for result in &row.results {
        let [misses, hits] = [&result.total.false_misses, &result.total.false_hits].map(rate);
        let most = result.findings.iter().max_by_key(|part| part.rate.count);
        let most = most.and_then(|part| Some((part, part.first.first()?)));
        let first = most.map_or(String::new(), |(part, example)| {
            let count = digits(part.rate.count);
            format!("{count} {} of {}: `{}`", part.finding, part.class, command(row, example))
        });
        writeln!(text, "| {} | {misses} | {hits} | {first} |", result.family).unwrap();
    }
    writeln!(text, "\n</details>").unwrap();
}

/// `12 of 3,000: 0.4 % [0.2, 0.7]`, Clopper–Pearson at 95 %; a set that is no sample has no interval.
fn rate(rate: &Rate) -> String {
    if rate.of == 0 {
        return "–".to_owned();
    }
    let counts = format!("{} of {}", digits(rate.count), digits(rate.of));
    let share = percent(rate.count, rate.of);
    let interval = rate.interval.map_or(String::new(), |ends| {
        let [low, high] = ends.map(|end| 100.0 * end);
        format!(" [{}, {}]", short(low), short(high))
    });
    format!("{counts}: {share} %{interval}")
}

fn short(percent: f64) -> String {
    match percent {
        x if x == 0.0 => "0".to_owned(),
        x if x >= 0.1 => format!("{x:.1}"),
        x => format!("{x:.0e}"),
    }
}
