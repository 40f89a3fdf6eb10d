//! Rays at a mesh as a file, to ask a program about.

use crate::files::mesh::Mesh;
use crate::files::number;
use crate::kernel::Scalar;
use crate::report::Format;
use hairline_scene::{NoTargets, Ray, RayKind, Targets};
use std::io::{self, Write};

/// Rays that were made.
pub struct MadeRays<F>(pub Vec<Ray<F>>);

impl<F: Scalar> MadeRays<F> {
    /// A line of six numbers a ray, below their names.
    pub const FORMATS: &'static [Format<MadeRays<F>>] = &[Format {
        name: "csv",
        write: |rays, _, out| rays.write(out),
    }];

    /// Writes them as CSV.
    pub fn write(&self, out: &mut dyn Write) -> io::Result<()> {
        writeln!(out, "ox,oy,oz,dx,dy,dz")?;
        for ray in &self.0 {
            let numbers = [ray.origin, ray.direction].concat();
            let words: Vec<String> = numbers.into_iter().map(number::write_shortest).collect();
            writeln!(out, "{}", words.join(","))?;
        }
        Ok(())
    }
}

/// Rays of some kinds at a mesh, so many in all. An error if its triangles have no size, or are too large for the scalar.
pub fn made<F: Scalar>(
    mesh: &Mesh,
    kinds: &[RayKind],
    count: u64,
    seed: u64,
) -> Result<Vec<Ray<F>>, NoTargets> {
    let faces = 0..mesh.triangles.len();
    let triangles = faces.map(|face| mesh.vertices(face)).collect();
    Ok(Targets::new(triangles)?.rays(kinds, count, seed))
}
