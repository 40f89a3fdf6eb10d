//! Studies of scenes as text, JSON, CSV, SVG and HTML.

mod answer;
mod build;
mod commands;
mod csv;
mod legend;
mod notes;
#[cfg(feature = "cli")]
mod page;
mod plot;
mod ranking;
mod record;
mod text;
mod words;

pub use build::{kernel_part, scene_record};
pub use record::*;

use super::Format;

/// One row per format.
pub const SCENE_FORMATS: &[Format<SceneRecord>] = &[
    Format { name: "text", write: text::write },
    Format::JSON,
    Format { name: "csv", write: csv::write },
    Format { name: "svg", write: plot::write },
    #[cfg(feature = "cli")]
    Format { name: "html", write: page::write },
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_committed_schema_is_that_of_the_types() {
        crate::report::tests::schema::assert_committed::<SceneRecord>("scene");
    }
}
