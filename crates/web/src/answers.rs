//! The answers, each from what the program does for the same question.

mod about;
mod audit;
mod case;
mod mesh;

pub use about::about;
pub use audit::{audit, curve};
pub use case::{explain, map, truth};
pub use mesh::mesh;

use hairline::Float;

/// True for each of `f32` and `f64` that a name is.
fn scalars_of(name: &str) -> Result<[bool; 2], String> {
    match [f32::NAME, f64::NAME].map(|known| known == name) {
        [false, false] => Err(format!("unknown scalar '{name}': there are f32 and f64")),
        scalars => Ok(scalars),
    }
}
