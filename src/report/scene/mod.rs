//! Studies of scenes as text and JSON.

mod build;
mod record;
mod text;
mod words;

pub use build::{kernel_part, scene_record};
pub use record::*;

use super::Style;
use std::io::{self, Write};

/// A format that a study of a scene can be written in.
pub struct SceneFormat {
    /// The name on the command line.
    pub name: &'static str,
    /// Writes a record.
    pub write: fn(&SceneRecord, Style, &mut dyn Write) -> io::Result<()>,
}

/// One row per format.
pub const SCENE_FORMATS: &[SceneFormat] =
    &[SceneFormat { name: "text", write: text::write }, SceneFormat { name: "json", write: json }];

fn json(record: &SceneRecord, _: Style, out: &mut dyn Write) -> io::Result<()> {
    serde_json::to_writer_pretty(&mut *out, record)?;
    writeln!(out)
}
