//! The cracks of a mesh.

use super::scalars_of;
use crate::request::Mesh;
use hairline::internals::audit::{Plan, Source, Unobserved, run};
use hairline::internals::case::Parameters;
use hairline::internals::family::MeshFamily;
use hairline::internals::files::mesh::read;
use hairline::internals::mesh::Surface;
use hairline::internals::record::{Context, Record, build, drawing, places};
use hairline::internals::report::page::{Paged, elements};
use serde::Serialize;
use std::io;
use std::sync::Arc;

/// The most triangles: some seconds.
const MOST: usize = 500_000;

#[derive(Serialize)]
pub struct MeshAnswer {
    title: String,
    /// As `hairline mesh --format json` writes it.
    record: Record,
    html: String,
}

pub fn mesh(asked: &Mesh, file: &[u8]) -> Result<MeshAnswer, String> {
    let scalars = scalars_of(&asked.scalar)?;
    let row = asked.kernel.row()?;
    row.check_in(scalars)?;
    if !(1..=64).contains(&asked.directions) {
        return Err(format!("directions: {} is not 1 to 64", asked.directions));
    }
    let mut beside = |name: &str, _: u64| {
        Err(io::Error::other(format!(
            "'{name}' is a file of its own: convert it to a .glb"
        )))
    };
    let mesh =
        read(file, &asked.file, &mut beside, &mut |_| {}).map_err(|error| error.to_string())?;
    if MOST < mesh.triangles.len() {
        let count = mesh.triangles.len();
        return Err(format!(
            "{count} triangles are more than {MOST}: use `hairline mesh`"
        ));
    }
    let family = MeshFamily::new(mesh, &asked.file);
    let places = places(family.mesh());
    let surface = Arc::new(Surface::new(Arc::new(family), scalars));
    let sources = Source::parts_of(&surface, &Parameters::default(), 1, asked.directions).into();
    let plan = Plan {
        places,
        ..Plan::new(vec![row], sources, scalars, 3)
    };
    let sums = run(&plan, &Unobserved);
    if sums.sources.iter().all(|source| source.cases == 0) {
        let nothing =
            "nothing to ask: no edge lies between two sound faces that are wound consistently";
        return Err(format!("{}: {nothing}", asked.file));
    }
    let mut record = build(
        &plan,
        &sums,
        &Context {
            seconds: 0.0,
            threads: 1,
        },
    );
    record.drawing = drawing(&plan, &sums);
    let (title, html) = (record.page().title, elements(&record));
    Ok(MeshAnswer {
        title,
        html,
        record,
    })
}
