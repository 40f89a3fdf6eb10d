//! The conformance part of a record as text for people.

use super::net::{NET_TITLE, net_lines};
use super::{Conformance, Deviation, Method, Record, Style, group_digits};
use crate::report::number_of;
use std::io::{self, Write};

/// The most deviations of a kind that the text lists without `--details`.
const MOST_LISTED: usize = 10;

/// The meaning of the words of a class.
const CLASSES: &str = "of interior/back/within: where the line meets the triangle, which side it comes from, where on the \
                       ray (within, before its start, beyond its end)";

/// Writes what `check` has to say; the tables are for `--details`.
pub(super) fn write(
    record: &Record,
    conformance: &Conformance,
    style: Style,
    out: &mut dyn Write,
) -> io::Result<()> {
    let (bold, plain) = if style.color { ("\x1b[1m", "\x1b[0m") } else { ("", "") };
    let how = match (conformance.method, &conformance.expectations) {
        (_, None) => "nothing is expected: there is no file of expectations".to_owned(),
        (Method::CaseByCase, Some(file)) if conformance.is_by_family => {
            format!("compared family by family with {file}")
        }
        (Method::CaseByCase, Some(file)) => format!("compared case by case with {file}"),
        (Method::Intervals, Some(file)) => format!(
            "compared by intervals with {file}, which is of other cases (it has {} entries)",
            group_digits(conformance.expected())
        ),
    };
    writeln!(out, "{}, plan {}: {how}", record.provenance.tool, record.result.plan.hash)?;
    if let Some(note) = &conformance.note {
        writeln!(out, "{note}")?;
    }
    for change in &conformance.rows {
        writeln!(out, "{change}")?;
    }
    if 0 < conformance.too_rare_to_tell {
        writeln!(
            out,
            "without an entry, and too rare to tell from none: {}",
            number_of(
                conformance.too_rare_to_tell,
                "class of disagreement",
                "classes of disagreement"
            )
        )?;
    }
    if 0 < conformance.outside_the_plan {
        writeln!(
            out,
            "{} expectations are of kernels, scalars or families that this plan leaves out",
            group_digits(conformance.outside_the_plan)
        )?;
    }
    if !conformance.unproved.is_empty() {
        writeln!(out, "\n{bold}Proofs that [proved] demands and that are missing{plain}")?;
    }
    for unproved in &conformance.unproved {
        writeln!(out, "{unproved}\n    {}", unproved.command)?;
    }
    let net = net_lines(conformance, if style.details { usize::MAX } else { MOST_LISTED });
    if !net.is_empty() {
        writeln!(out, "\n{bold}{NET_TITLE}{plain}")?;
    }
    net.iter().try_for_each(|line| writeln!(out, "{line}"))?;
    for (title, list) in [
        ("Unexpected disagreements", &conformance.unexpected),
        (
            "Stale expectations (what was wrong is less so, or gone; --bless writes what was found)",
            &conformance.stale,
        ),
    ] {
        if list.is_empty() {
            continue;
        }
        writeln!(out, "\n{bold}{title}{plain}")?;
        let most = if style.details { list.len() } else { MOST_LISTED };
        for found in list.iter().take(most) {
            write_deviation(conformance, found, style, out)?;
        }
        if most < list.len() {
            let more = group_digits((list.len() - most) as u64);
            writeln!(out, "and {more} more (--details lists all)")?;
        }
    }
    let mut all = conformance.unexpected.iter().chain(&conformance.stale);
    if all.any(|found| found.class.contains('/')) {
        writeln!(out, "\n{CLASSES}")?;
    }
    writeln!(out, "{bold}{}{plain}", conformance.summary())
}

fn write_deviation(
    conformance: &Conformance,
    found: &Deviation,
    style: Style,
    out: &mut dyn Write,
) -> io::Result<()> {
    if let (Some(file), Some(line)) = (&conformance.expectations, found.line) {
        write!(out, "{file}:{line}: ")?;
    }
    writeln!(out, "{}", found.describe())?;
    let bits = found.bits.as_ref().filter(|_| style.details);
    for line in [found.why.as_ref(), found.command.as_ref(), bits].into_iter().flatten() {
        writeln!(out, "    {line}")?;
    }
    Ok(())
}
