//! Studies of epsilons as pages, JSON, SVG and code to paste.

mod answer;
mod build;
mod commands;
mod compared;
mod evidence;
pub(super) mod fitness;
mod legend;
mod meaning;
mod notes;
mod numbers;
mod page;
mod plot;
mod ranking;
mod record;
mod snippet;
mod standing;
mod words;

pub use build::{kernel_part, scene_record};
pub use numbers::shortest;
pub use ranking::{has_a_table, rows_on_screen};
pub use record::*;

use crate::format::Format;
use snippet::SnippetLanguage;

/// One row per format.
pub const SCENE_FORMATS: &[Format<SceneRecord>] = &[
    Format::TEXT,
    Format::JSON,
    Format::MARKDOWN,
    Format {
        name: "svg",
        write: |record, _, out| plot::write(&record.result, out),
    },
    Format {
        name: "c",
        write: |record, _, out| snippet::write(&record.result, SnippetLanguage::C, out),
    },
    Format {
        name: "rust",
        write: |record, _, out| snippet::write(&record.result, SnippetLanguage::Rust, out),
    },
    Format {
        name: "glsl",
        write: |record, _, out| snippet::write(&record.result, SnippetLanguage::Glsl, out),
    },
    #[cfg(feature = "pages")]
    Format::HTML,
];
