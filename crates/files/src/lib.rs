//! Contents of other people's files: meshes, lines, JSON and numbers in text. Takes readers; opens no file itself. An error
//! names the file, the line, what was found and what was expected.
//!
//! It is a part of the program `hairline`, whose interface is stable; this one changes with it.

#![forbid(unsafe_code)]
#![cfg_attr(not(feature = "formats"), allow(dead_code, unused_imports))]

#[cfg(test)]
use hairline_core::case;
use hairline_core::{arith, printable, suggest};

mod fan;
mod input_error;
#[cfg(feature = "text")]
pub mod json;
#[cfg(feature = "text")]
pub mod json_lines;
#[cfg(feature = "text")]
pub mod number;
#[cfg(feature = "text")]
pub mod text_lines;

mod polygon;

pub mod mesh;

pub use fan::{is_without_area, winds_once};
pub use input_error::InputError;

/// Bytes as lower-case hexadecimal digits.
pub fn hex(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02x}")).collect()
}
