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
    /// A line of six numbers a ray, below their names; of eight where a ray has an interval of its own.
    pub const FORMATS: &'static [Format<MadeRays<F>>] = &[Format {
        name: "csv",
        write: |rays, _, out| rays.write(out),
    }];

    /// Writes them as CSV.
    pub fn write(&self, out: &mut dyn Write) -> io::Result<()> {
        let is_whole = |ray: &Ray<F>| ray.t_min.is_zero() && ray.t_max == F::infinity();
        let are_whole = self.0.iter().all(is_whole);
        let ends = if are_whole { "" } else { ",t_min,t_max" };
        writeln!(out, "ox,oy,oz,dx,dy,dz{ends}")?;
        for ray in &self.0 {
            let mut numbers = [ray.origin, ray.direction].concat();
            if !are_whole {
                numbers.extend([ray.t_min, ray.t_max]);
            }
            let words: Vec<String> = numbers.into_iter().map(word).collect();
            writeln!(out, "{}", words.join(","))?;
        }
        Ok(())
    }
}

/// A number as a line of rays has it: JSON's infinity has quotes, that of CSV has none.
fn word<F: Scalar>(x: F) -> String {
    match x.is_finite() {
        true => number::write_shortest(x),
        false => x.to_f64().to_string(),
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
