//! The record of a mesh audit, and its formats: text, JSON, and a page that draws the mesh.

mod build;
mod drawing;
mod record;
mod screen;
#[cfg(feature = "pages")]
mod stage;

pub use build::build;
pub use drawing::places;
pub use record::*;

use super::{Format, write_json};

/// One row per format.
pub const MESH_FORMATS: &[Format<MeshReport>] = &[
    Format::TEXT,
    Format::MARKDOWN,
    Format { name: "json", write: |report, _, out| write_json(&report.record, out) },
    #[cfg(feature = "pages")]
    Format::HTML,
];
