//! The exact answers to a file of rays.

use crate::asked::{BadRay, of_all};
use crate::kernel::Scalar;
use crate::record::{group_digits, number_of};
use crate::report::Format;
use crate::report::page::{Block, Cell, Head, Page, Paged, Row, Table};
use crate::single::joined;
use hairline_scene::{InvalidRay, Ray, Scene};
use serde::Serialize;

/// How many rays a screen shows.
const SHOWN: usize = 8;

/// The hits of all rays.
#[derive(Serialize)]
pub struct FoundHits {
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

impl FoundHits {
    /// The formats: those of a page, and a line a ray.
    pub const FORMATS: &'static [Format<FoundHits>] = &[
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
}

/// Answers all rays.
pub fn found<F: Scalar>(scene: &Scene<F>, rays: &[Ray<F>]) -> Result<FoundHits, BadRay> {
    let rays = of_all(rays.len(), |index| found_by(scene, &rays[index]))?;
    Ok(FoundHits {
        scalar: F::NAME.name(),
        rays,
    })
}

fn found_by<F: Scalar>(scene: &Scene<F>, ray: &Ray<F>) -> Result<FoundHit, InvalidRay> {
    let Some(nearest) = scene.nearest(ray)? else {
        return Ok(FoundHit {
            faces: Vec::new(),
            t: None,
            meetings: 0,
            met: 0,
        });
    };
    let t = scene.t(ray, nearest.faces[0])?;
    let passages = scene.passages(ray)?;
    let hits = scene.hits(ray)?;
    Ok(FoundHit {
        t: t.map(|[first, _]| first),
        faces: nearest.faces,
        meetings: passages.len(),
        met: hits.iter().map(|hit| hit.faces.len()).sum(),
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
