//! The record as Markdown, for a summary on a forge: the verdict, what deviates, and the rates.

use super::text::{RowView, percent};
use super::{Conformance, Deviation, Rate, Record, Style, group_digits};
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
    let (rows, sources) = (plan.rows.len(), plan.sources.len());
    let tool = &record.provenance.tool;
    text.push_str(&format!(
        "\n{tool}, plan `{}`: {rows} kernel rows on {sources} sources of cases. \
         Shares of cases, with 95 % intervals (Clopper-Pearson).\n",
        plan.hash
    ));
    if let Some(partial) = &record.result.partial {
        let words = partial.in_words();
        text.push_str(&format!(
            "\n**A part of a run**: {words}; every count and share is of it alone.\n"
        ));
    }
    for scalar in &plan.scalars {
        scalar_part(record, scalar, &mut text);
    }
    text
}

fn conformance_part(conformance: &Conformance, text: &mut String) {
    text.push_str(&format!("## hairline {}\n", conformance.summary()));
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

fn scalar_part(record: &Record, scalar: &str, text: &mut String) {
    text.push_str(&format!(
        "\n### {scalar}\n\n| kernel (epsilons) | false misses | false hits | bad values | cracks |\n\
         |---|---:|---:|---:|---:|\n"
    ));
    for row in RowView::all(record, scalar) {
        let misses = row.total(|result| Some(&result.total.false_misses));
        let hits = row.total(|result| Some(&result.total.false_hits));
        let bad = row.total(|result| Some(&result.total.bad_values));
        let cracks = row.total(|result| result.across.as_ref().map(|across| &across.cracks));
        text.push_str(&format!(
            "| {} ({}) | {} | {} | {} | {} |\n",
            row.part.kernel,
            cell(&row.part.set),
            share(&misses),
            share(&hits),
            group_digits(bad.count),
            if cracks.of == 0 { "-".to_owned() } else { group_digits(cracks.count) }
        ));
    }
}

fn share(rate: &Rate) -> String {
    match (rate.rate, rate.interval) {
        (None, _) => "-".to_owned(),
        (Some(share), None) => percent(share),
        (Some(share), Some([low, high])) => {
            format!("{} [{}, {}]", percent(share), percent(low), percent(high))
        }
    }
}

/// Text inside a table's cell.
fn cell(text: &str) -> String {
    text.replace('|', "\\|").replace('\n', " ")
}

fn code(text: &str) -> String {
    // A command holds no backtick unless a file's name does.
    let fence = if text.contains('`') { "``" } else { "`" };
    format!("{fence}{}{fence}", cell(text))
}
