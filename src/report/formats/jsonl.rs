//! The record as JSON lines: the plan, then one line a source, a result, a deviation.

use super::{Deviation, Record, Style};
use serde::Serialize;
use std::io::{self, Write};

#[derive(Serialize)]
struct Line<'a, T> {
    #[serde(rename = "type")]
    kind: &'a str,
    #[serde(flatten)]
    body: T,
}

#[derive(Serialize)]
struct Start<'a> {
    schema: &'a str,
    plan: &'a super::PlanPart,
}

#[derive(Serialize)]
struct End<'a> {
    verdict: super::Verdict,
    summary: &'a str,
}

/// Writes the record.
pub(super) fn write(record: &Record, _: Style, out: &mut dyn Write) -> io::Result<()> {
    let result = &record.result;
    line("plan", &Start { schema: &record.schema, plan: &result.plan }, out)?;
    result.sources.iter().try_for_each(|source| line("source", source, out))?;
    result.results.iter().try_for_each(|result| line("result", result, out))?;
    result.totals.iter().try_for_each(|total| line("total", total, out))?;
    if let Some(conformance) = &record.conformance {
        for unproved in &conformance.unproved {
            line("unproved", unproved, out)?;
        }
        let mut deviations =
            |kind, list: &[Deviation]| list.iter().try_for_each(|found| line(kind, found, out));
        deviations("unexpected", &conformance.unexpected)?;
        deviations("stale", &conformance.stale)?;
        deviations("known", &conformance.known)?;
        let summary = &conformance.summary();
        line("conformance", &End { verdict: conformance.verdict, summary }, out)?;
    }
    line("provenance", &record.provenance, out)
}

fn line(kind: &str, body: &impl Serialize, out: &mut dyn Write) -> io::Result<()> {
    serde_json::to_writer(&mut *out, &Line { kind, body })?;
    writeln!(out)
}
