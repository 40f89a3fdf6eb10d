//! The parts that all commands share, whatever they do: how a command ends, the flags that several have, kernels of the
//! user's own, files that are opened, and where results go.
//!
//! It is a part of the program `hairline`, whose interface is stable; this one changes with it.

#![deny(unsafe_code)]

#[macro_use(in_named_scalar)]
extern crate hairline_core;
use hairline_cases::{corpus, family};
use hairline_core::{arith, case, kernel, suggest};
use hairline_files as files;
use hairline_plugin as plugin;
use hairline_record as record;
use hairline_report as report;
use hairline_study::audit;

#[doc(hidden)]
pub use hairline_core::printable;

/// Prints a line to standard error. Unlike the standard library's it does not panic if nobody can read it; and what other
/// people wrote, as a name or a reason, is shown by a terminal and not obeyed.
#[macro_export]
macro_rules! eprintln {
    ($($words:tt)*) => {{
        use std::io::Write as _;
        let line = $crate::printable::printable(&format!($($words)*));
        let _ = writeln!(std::io::stderr(), "{line}");
    }};
}

// The floors, from the ground up: each module uses only those above it in this list.
mod descriptors;
pub mod exit;
pub mod named_file;
mod pace;
mod places;

pub mod flags;
pub mod outputs;
pub mod progress;

pub mod input;
pub mod plugins;

pub mod output;
