//! hairline as a module of Python: truths of arrays, audits of functions, and the program itself. Nothing here decides:
//! cases, truths, the judge and the record are those of the program. The package around it is in `hairline/`.
//!
//! ```text
//! arrays ──► truths ──────────────► array          hairline.truth
//! arrays ──► scene ───────────────► arrays         hairline.Scene
//! function ──► kernel ──► audit ──► record         hairline.audit, .assert_conforms
//! words ──► hairline::cli ────────► exit code      the command
//! ```

#![deny(unsafe_code)]

mod audit;
mod judged;
mod kernel;
mod scene;
mod truths;

use hairline::internals::arith::FloatEnvironment;
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use std::ffi::OsString;
use std::io::Write;

#[pymodule]
#[pyo3(gil_used = true)]
mod _hairline {
    #[pymodule_export]
    use super::audit::{Audited, audit};
    #[pymodule_export]
    use super::judged::judgements;
    #[pymodule_export]
    use super::kernel::case;
    #[pymodule_export]
    use super::run;
    #[pymodule_export]
    use super::scene::ExactScene;
    #[pymodule_export]
    use super::truths::{names, truth};
}

/// Runs the program on a command line, its name first, and returns its exit code. `again` are the words that start it
/// from a shell.
#[pyfunction]
fn run(py: Python<'_>, words: Vec<OsString>, again: Vec<String>) -> u8 {
    py.detach(|| {
        hairline::cli::started_by(again);
        let code = hairline::cli::run(words);
        // No runtime of Rust's ends this process.
        let _ = std::io::stdout().flush();
        code
    })
}

/// An error if this thread does not compute as IEEE 754 says: a library that was built with `-ffast-math` may have
/// changed it when it was loaded.
fn check_floats() -> PyResult<()> {
    let floats = FloatEnvironment::now();
    if floats.is_default() {
        return Ok(());
    }
    Err(PyRuntimeError::new_err(format!(
        "this thread computes with {floats}, so no truth would be right: some module was built with -ffast-math"
    )))
}
