//! hairline as WebAssembly, for the lab and the package of JavaScript: requests and answers are JSON, many cases are
//! columns of numbers. Nothing here decides: cases, truths, the judge and the record are those of the program.
//!
//! ```text
//! JSON ──► abi ──► request ──► answers ──► JSON        (an audit, a curve, a case, a map, a mesh)
//!                     └──► kernel ──► JavaScript       (verdicts on a chunk of cases)
//! ```

#![deny(unsafe_code)]

mod abi;
mod answers;
mod kernel;
mod request;
mod truths;
