//! Epsilon studies as text, JSON, CSV and SVG.

mod build;
mod csv;
mod plot;
mod record;
mod text;

pub(crate) use build::shortest;
pub use build::{parts, record};
pub(crate) use csv::quoted;
pub use record::*;
pub(in crate::report) use text::{FLUSHED, is_subnormal, least_normal};

use super::{Format, Style};
use std::io::{self, Write};

/// One row per format.
pub const EPSILON_FORMATS: &[Format<EpsilonRecord>] = &[
    Format { name: "text", write: text::write },
    Format { name: "json", write: json },
    Format { name: "csv", write: csv::write },
    Format { name: "svg", write: plot::write },
];

/// On one line, because a line a number is ten times as long. Without details only the curve of all sources
/// together, of so many points.
fn json(record: &EpsilonRecord, style: Style, out: &mut dyn Write) -> io::Result<()> {
    if style.details {
        serde_json::to_writer(&mut *out, record)?;
    } else {
        serde_json::to_writer(&mut *out, &brief(record, MOST_POINTS))?;
    }
    writeln!(out)
}

/// The most points of a curve in a record without details.
const MOST_POINTS: usize = 256;

fn brief(record: &EpsilonRecord, most: usize) -> EpsilonRecord {
    let gate = |part: &GatePart| {
        let mut part = part.clone();
        part.curves.truncate(1);
        let kept: Vec<&String> = part
            .marks
            .iter()
            .map(|mark| &mark.epsilon)
            .chain(part.prices.iter().map(|price| &price.epsilon))
            .chain([&part.trade.misses.limit, &part.trade.hits.limit])
            .collect();
        for curve in &mut part.curves {
            let last = curve.points.len().saturating_sub(1);
            let step = curve.points.len().div_ceil(most).max(1);
            let mut place = 0..;
            curve.points.retain(|(epsilon, _)| {
                let place = place.next().unwrap_or(0);
                place % step == 0 || place == last || kept.contains(&epsilon)
            });
        }
        part
    };
    EpsilonRecord {
        schema: record.schema.clone(),
        result: EpsilonResult {
            sources: record.result.sources.clone(),
            gates: record.result.gates.iter().map(gate).collect(),
        },
        provenance: record.provenance.clone(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_committed_schema_is_that_of_the_types() {
        crate::report::tests::schema::assert_committed::<EpsilonRecord>("epsilon");
    }
}
