//! Hard cases of rays and triangles: generated families, real meshes, stored cases. The oracle of `hairline-core` checks
//! what each family promises of its cases.
//!
//! It is a part of the program `hairline`, whose interface is stable; this one changes with it.

#![cfg_attr(not(feature = "studies"), allow(dead_code, unused_imports))]

#[macro_use(either_scalar, in_named_scalar, named)]
extern crate hairline_core;
use hairline_core::{arith, case, engine, kernel, oracle, printable, truth};
use hairline_files as files;

#[cfg(feature = "studies")]
pub mod corpus;
pub mod family;
pub mod mesh;
