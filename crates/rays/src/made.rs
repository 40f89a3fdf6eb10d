//! Rays at a mesh as a file, to ask a program about.

use crate::files::number;
use crate::kernel::Scalar;
use crate::report::Format;
use hairline_scene::Ray;
use std::io::{self, Write};

/// Rays that were made.
pub struct MadeRays<F>(pub Vec<Ray<F>>);

impl<F: Scalar> MadeRays<F> {
    /// A line of six numbers a ray, below their names.
    pub const FORMATS: &'static [Format<MadeRays<F>>] = &[Format {
        name: "csv",
        write: |rays, _, out| rays.write(out),
    }];

    fn write(&self, out: &mut dyn Write) -> io::Result<()> {
        writeln!(out, "ox,oy,oz,dx,dy,dz")?;
        for ray in &self.0 {
            let numbers = [ray.origin, ray.direction].concat();
            let words: Vec<String> = numbers.into_iter().map(number::write_shortest).collect();
            writeln!(out, "{}", words.join(","))?;
        }
        Ok(())
    }
}
