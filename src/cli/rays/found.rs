//! The exact answers to a file of rays.

use super::RaysArguments;
use crate::cli::exit::{Failure, Status};
use crate::files::InputError;
use crate::kernel::Scalar;
use crate::record::{group_digits, number_of};
use crate::report::Format;
use crate::report::page::{Block, Cell, Head, Page, Paged, Row, Table};
use hairline_scene::{InvalidRay, Ray, Scene};
use rayon::prelude::*;
use serde::Serialize;

/// How many rays a screen shows.
const SHOWN: usize = 8;

/// The hits of all rays.
#[derive(Serialize)]
struct FoundHits {
    scalar: &'static str,
    rays: Vec<FoundHit>,
}

/// The hits of a ray.
#[derive(Serialize)]
struct FoundHit {
    /// The nearest faces: several where it meets them at the same t.
    faces: Vec<u32>,
    /// Their t, as the nearest double.
    t: Option<f64>,
    /// How often the ray meets the surface: points, and segments in which it runs in it.
    meetings: usize,
    /// Faces that it meets in all.
    met: usize,
}

/// The formats: those of a page, and a line a ray.
const FORMATS: &[Format<FoundHits>] = &[
    Format::TEXT,
    Format::JSON,
    Format::MARKDOWN,
    Format::HTML,
    Format {
        name: "csv",
        write: |found, _, out| {
            writeln!(out, "faces,t,meetings,met")?;
            for ray in &found.rays {
                let t = ray.t.map_or(String::new(), |t| format!("{t:?}"));
                let FoundHit { meetings, met, .. } = ray;
                writeln!(out, "{},{t},{meetings},{met}", joined(&ray.faces))?;
            }
            Ok(())
        },
    },
];

/// Numbers of faces in one cell of a CSV.
pub(super) fn joined(faces: &[u32]) -> String {
    let words: Vec<String> = faces.iter().map(u32::to_string).collect();
    words.join(" ")
}

/// Answers all rays.
pub(super) fn run<F: Scalar>(
    arguments: &RaysArguments,
    scene: &Scene<F>,
    rays: &[Ray<F>],
) -> Result<Status, Failure> {
    let outputs = arguments.output.pairs(FORMATS)?;
    let rays = of_all(arguments, rays.len(), |index| found(scene, &rays[index]))?;
    let found = FoundHits {
        scalar: F::NAME.name(),
        rays,
    };
    arguments.output.write(outputs, &found)?;
    Ok(Status::Success)
}

/// An answer about each ray, found on all threads; an error names the first ray that means nothing.
pub(super) fn of_all<T: Send>(
    arguments: &RaysArguments,
    rays: usize,
    of_ray: impl Fn(usize) -> Result<T, InvalidRay> + Sync,
) -> Result<Vec<T>, Failure> {
    let indices = (0..rays).into_par_iter();
    let all: Result<Vec<T>, (usize, InvalidRay)> = indices
        .map(|index| of_ray(index).map_err(|error| (index, error)))
        .collect();
    all.map_err(|(index, error)| {
        let file = arguments.rays.as_deref().unwrap_or_default();
        InputError::of(file, format!("ray {index}, counted from 0: {error}")).into()
    })
}

fn found<F: Scalar>(scene: &Scene<F>, ray: &Ray<F>) -> Result<FoundHit, InvalidRay> {
    let Some(nearest) = scene.nearest(ray)? else {
        return Ok(FoundHit {
            faces: Vec::new(),
            t: None,
            meetings: 0,
            met: 0,
        });
    };
    let values = scene.values(ray, nearest.faces[0])?;
    let passages = scene.passages(ray)?;
    Ok(FoundHit {
        t: values.map(|values| values.t[0]),
        faces: nearest.faces,
        meetings: passages.len(),
        met: passages.iter().map(|passage| passage.faces.len()).sum(),
    })
}

impl Paged for FoundHits {
    fn page(&self) -> Page {
        let hits = self.rays.iter().filter(|ray| !ray.faces.is_empty()).count();
        let ties = self.rays.iter().filter(|ray| 1 < ray.faces.len()).count();
        let rays = number_of(self.rays.len() as u64, "ray", "rays");
        let row = |(index, ray): (usize, &FoundHit)| {
            let cells = [
                Cell::words(joined(&ray.faces)),
                Cell::optional(ray.t, |t| format!("{t:?}")),
                Cell::count(ray.meetings as u64),
            ];
            Row::new(index.to_string(), cells)
        };
        let heads = vec![
            Head::of("ray"),
            Head::text("nearest faces"),
            Head::of("t"),
            Head::of("meetings")
                .about("points, or segments in the surface, that a ray shares with it"),
        ];
        let rows = self.rays.iter().enumerate().take(SHOWN).map(row).collect();
        let mut blocks = vec![
            Block::text(format!(
                "{} several faces at the same t, where each is a right answer.",
                number_of(ties as u64, "ray meets", "rays meet")
            )),
            Block::Table(Table::new(heads, rows)),
        ];
        if SHOWN < self.rays.len() {
            blocks.push(Block::text(
                "--format csv has every ray; --answers FILE judges what a program answered.",
            ));
        }
        Page {
            command: "rays",
            title: format!("{} of {rays} hit the mesh", group_digits(hits as u64)),
            blocks,
            ..Page::default()
        }
    }
}
