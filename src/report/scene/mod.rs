//! Studies of scenes as text, JSON, CSV, SVG and HTML.

mod answer;
mod build;
mod commands;
mod csv;
mod elsewhere;
mod legend;
mod notes;
#[cfg(feature = "cli")]
mod page;
mod plot;
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
pub const SCENE_FORMATS: &[SceneFormat] = &[
    SceneFormat { name: "text", write: text::write },
    SceneFormat { name: "json", write: json },
    SceneFormat { name: "csv", write: csv::write },
    SceneFormat { name: "svg", write: plot::write },
    #[cfg(feature = "cli")]
    SceneFormat { name: "html", write: page::write },
];

fn json(record: &SceneRecord, _: Style, out: &mut dyn Write) -> io::Result<()> {
    serde_json::to_writer_pretty(&mut *out, record)?;
    writeln!(out)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_committed_schema_is_that_of_the_types() {
        crate::report::tests::schema::assert_committed::<SceneRecord>("scene");
    }
}
