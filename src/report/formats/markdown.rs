//! The record as Markdown, for a summary on a forge: the verdict, what deviates, and the rates.

use super::columns::{Column, short_percent};
use super::lines::{Line, column_legend, lines};
use super::net::{NET_TITLE, net_lines};
use super::rate::percent;
use super::{Conformance, Deviation, Rate, Record, Style, group_digits, number_of};
use crate::report::page::{markdown_cell as cell, markdown_code as code};
use std::io::{self, Write};

/// A forge's summary holds less than a mebibyte.
pub const LIMIT: usize = (1 << 20) - 1024;

const REST: &str = "\nThe rest is left out here: `hairline check --format json` has everything.\n";

/// Writes the record.
pub(super) fn write(record: &Record, _: Style, out: &mut dyn Write) -> io::Result<()> {
    out.write_all(within(record, LIMIT).as_bytes())
}

/// The record in at most so many bytes, cut after a line, with a note of it.
pub fn within(record: &Record, limit: usize) -> String {
    let text = whole(record);
    if text.len() <= limit {
        return text;
    }
    let Some(room) = limit.checked_sub(REST.len()) else { return String::new() };
    let end = text.as_bytes()[..room].iter().rposition(|byte| *byte == b'\n').map_or(0, |i| i + 1);
    format!("{}{REST}", &text[..end])
}

fn whole(record: &Record) -> String {
    let mut text = String::new();
    let plan = &record.result.plan;
    match &record.conformance {
        Some(conformance) => conformance_part(conformance, &mut text),
        None => text.push_str("## hairline\n"),
    }
    let rows = number_of(plan.rows.len() as u64, "kernel row", "kernel rows");
    let sources = number_of(plan.sources.len() as u64, "source of cases", "sources of cases");
    let tool = &record.provenance.tool;
    text.push_str(&format!(
        "\n{tool}, plan `{}`: {rows} on {sources}. \
         Shares of wrong verdicts (false misses and false hits), with 95 % intervals (Clopper-Pearson).\n",
        plan.hash
    ));
    if let Some(partial) = &record.result.partial {
        let words = partial.in_words();
        text.push_str(&format!(
            "\n**A part of a run**: {words}; every count and share is of it alone.\n"
        ));
    }
    let columns = Column::all(record);
    let lines = lines(record, &columns);
    for scalar in &plan.scalars {
        scalar_part(&columns, &lines, scalar, &mut text);
    }
    text.push_str(&format!("\n{}\n", column_legend(&columns, &lines)));
    text
}

fn conformance_part(conformance: &Conformance, text: &mut String) {
    text.push_str(&format!("## hairline {}\n", conformance.summary()));
    if let Some(note) = &conformance.note {
        text.push_str(&format!("\n{}\n", cell(note)));
    }
    for change in &conformance.rows {
        text.push_str(&format!("\n{}\n", cell(&change.to_string())));
    }
    if !conformance.unproved.is_empty() {
        text.push_str("\n### Proofs missing\n\n");
    }
    for unproved in &conformance.unproved {
        text.push_str(&format!("- {}: {}\n", cell(&unproved.to_string()), code(&unproved.command)));
    }
    let net = net_lines(conformance, usize::MAX);
    if !net.is_empty() {
        text.push_str(&format!("\n### {NET_TITLE}\n\n"));
    }
    net.iter().for_each(|line| text.push_str(&format!("- {}\n", cell(line))));
    deviations("Unexpected disagreements", &conformance.unexpected, text);
    deviations("Stale expectations", &conformance.stale, text);
}

fn deviations(title: &str, list: &[Deviation], text: &mut String) {
    if list.is_empty() {
        return;
    }
    text.push_str(&format!("\n### {title}\n\n"));
    text.push_str(
        "| kernel (epsilons) | scalar | family | finding | found | expected | shown again by |\n",
    );
    text.push_str("|---|---|---|---|---|---|---|\n");
    for found in list {
        let (key, Rate { count, of, .. }) = (found.key(), &found.found);
        let command = found.command.as_ref().map_or(String::new(), |command| code(command));
        text.push_str(&format!(
            "| {} | {} | {} | {} of {} | {} of {} | {} | {command} |\n",
            cell(&key.row()),
            key.scalar,
            cell(&key.family),
            key.finding,
            key.class,
            group_digits(*count),
            group_digits(*of),
            found.expected
        ));
    }
}

/// One scalar: a row of the table a kernel row, a column a question.
fn scalar_part(columns: &[Column], lines: &[Line], scalar: &str, text: &mut String) {
    let heads: String = columns.iter().map(|column| format!("{} | ", column.label())).collect();
    let rule = "---:|".repeat(columns.len());
    text.push_str(&format!(
        "\n### {scalar}\n\n| kernel (epsilons) | {heads}values | cracks | doubles | promised |\n|---|{rule}---:|---:|---:|---|\n"
    ));
    for line in lines.iter().filter(|line| line.row.scalar == scalar) {
        let cells = columns.iter().zip(&line.cells).map(|(column, cell)| {
            let rate = Rate::new(cell.wrong, !column.complete);
            format!("{} | ", share(&rate))
        });
        let cells: String = cells.collect();
        let values = share(&Rate::new(line.values.wrong, true));
        let groups = line.across.as_ref().map_or("- | - | -".to_owned(), |across| {
            let [cracks, doubles] = [across.cracks, across.doubles].map(short_percent);
            format!("{cracks}% | {doubles}% | {}", across.words())
        });
        text.push_str(&format!("| {} | {cells}{values} | {groups} |\n", cell(&line.label())));
    }
}

/// A sample's share with its interval; counts of stored cases.
fn share(rate: &Rate) -> String {
    match (rate.rate, rate.interval) {
        (None, _) => "-".to_owned(),
        (Some(_), None) => format!("{} of {}", group_digits(rate.count), group_digits(rate.of)),
        (Some(share), Some([low, high])) => {
            format!("{} [{}, {}]", percent(share), percent(low), percent(high))
        }
    }
}
