//! The answers, each from what the program does for the same question.

mod about;
mod audit;
mod case;
mod mesh;

pub use about::about;
pub use audit::{audit, curve};
pub use case::{explain, map, truth};
pub use mesh::mesh;

use hairline::ScalarName;

/// True for each of `f32` and `f64` that a name is.
fn scalars_of(name: &str) -> Result<[bool; 2], String> {
    let unknown = || format!("unknown scalar '{name}': there are f32 and f64");
    ScalarName::named(name)
        .map(ScalarName::alone)
        .ok_or_else(unknown)
}
