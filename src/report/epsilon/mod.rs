//! Epsilon studies as text, JSON, CSV and SVG.

mod build;
mod csv;
mod plot;
mod record;
mod text;

pub(crate) use build::shortest;
pub use build::{parts, record};
pub use record::*;

use super::Style;
use std::io::{self, Write};

/// A format that a study can be written in.
pub struct EpsilonFormat {
    /// The name on the command line.
    pub name: &'static str,
    /// Writes a record.
    pub write: fn(&EpsilonRecord, Style, &mut dyn Write) -> io::Result<()>,
}

/// One row per format.
pub const EPSILON_FORMATS: &[EpsilonFormat] = &[
    EpsilonFormat { name: "text", write: text::write },
    EpsilonFormat { name: "json", write: json },
    EpsilonFormat { name: "csv", write: csv::write },
    EpsilonFormat { name: "svg", write: plot::write },
];

fn json(record: &EpsilonRecord, _: Style, out: &mut dyn Write) -> io::Result<()> {
    serde_json::to_writer_pretty(&mut *out, record)?;
    writeln!(out)
}
