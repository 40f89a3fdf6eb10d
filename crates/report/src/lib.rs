//! For people who read a run: its record as a page, the page as text, Markdown and HTML, one exporter a format, and a
//! case explained.
//!
//! It is a part of the program `hairline`, whose interface is stable; this one changes with it.

#![forbid(unsafe_code)]
#![cfg_attr(not(feature = "pages"), allow(dead_code, unused_imports))]

#[macro_use(in_named_scalar)]
extern crate hairline_core;
#[macro_use(part)]
extern crate hairline_record;
#[macro_use]
extern crate macro_rules_attribute;
use hairline_advice::advised;
use hairline_cases::{corpus, family};
use hairline_core::{arith, case, contract, engine, kernel, oracle, printable, truth};
use hairline_explore as explore;
use hairline_prove as prove;
use hairline_study::{audit, judge, map, plot};

// The floors, from the ground up: each module uses only those above it in this list.
mod chart;
mod format;
mod lists;
mod scene;

pub mod page;

pub mod elsewhere;

mod segments;

pub mod epsilon;
pub mod explain;

pub mod mesh;
pub mod offset;
pub mod proofs;

pub mod formats;

pub use format::{Format, Style, write_json, write_json_line};
pub use formats::{FORMATS, HTML, JunitCase, ON_FAILURE, severity, write_junit};
pub use lists::{alike, listed};
pub use segments::{SegmentEndPart, SegmentKindPart, SegmentsPart, short_length};
