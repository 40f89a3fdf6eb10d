//! The record of a mesh audit, and its formats: text, JSON, and a page that draws the mesh.

mod build;
mod drawing;
#[cfg(feature = "cli")]
mod page;
#[cfg(feature = "cli")]
mod picture;
mod record;
#[cfg(feature = "cli")]
mod shown;
#[cfg(feature = "cli")]
mod stage;
mod text;

pub use build::build;
pub use drawing::places;
pub use record::*;

#[cfg(feature = "cli")]
use super::HTML;
use super::{Style, write_json};
use std::io::{self, Write};

/// A format of a mesh audit.
pub struct MeshFormat {
    /// The name on the command line.
    pub name: &'static str,
    /// Writes a report.
    pub write: fn(&MeshReport, Style, &mut dyn Write) -> io::Result<()>,
}

/// One row per format.
pub const MESH_FORMATS: &[MeshFormat] = &[
    MeshFormat { name: "text", write: text::write },
    MeshFormat { name: "json", write: |report, _, out| write_json(&report.record, out) },
    #[cfg(feature = "cli")]
    MeshFormat { name: HTML, write: page::write },
];
