//! All exact hits of a file of rays, as a program's answers are read.

use crate::asked::{BadRay, of_all};
use crate::kernel::Scalar;
use crate::record::number_of;
use crate::report::Format;
use crate::report::page::{Block, Cell, Head, Page, Paged, Row, Table};
use hairline_scene::{InvalidRay, Ray, Scene};
use serde::Serialize;

/// How many hits a screen shows.
const SHOWN: usize = 12;

/// All hits of all rays.
#[derive(Serialize)]
pub struct AllHits {
    scalar: &'static str,
    /// How many rays.
    rays: usize,
    /// A face that a ray meets; ray by ray, and those of a ray in order.
    hits: Vec<FaceHit>,
}

/// A face that a ray meets.
#[derive(Serialize)]
struct FaceHit {
    /// The ray's number, from 0.
    ray: usize,
    face: u32,
    /// The first t, as the nearest double.
    t: f64,
    /// The last one: a later one where the ray runs in the face.
    last_t: f64,
}

impl AllHits {
    /// The formats: those of a page, and a line a hit.
    pub const FORMATS: &'static [Format<AllHits>] = &[
        Format::TEXT,
        Format::JSON,
        Format::MARKDOWN,
        Format::HTML,
        Format {
            name: "csv",
            write: |all, _, out| {
                writeln!(out, "ray,face,t")?;
                for FaceHit { ray, face, t, .. } in &all.hits {
                    writeln!(out, "{ray},{face},{t:?}")?;
                }
                Ok(())
            },
        },
    ];
}

/// Finds all hits of all rays.
pub fn found_all<F: Scalar>(scene: &Scene<F>, rays: &[Ray<F>]) -> Result<AllHits, BadRay> {
    let hits = of_all(rays.len(), |index| hits_of(scene, index, &rays[index]))?;
    Ok(AllHits {
        scalar: F::NAME.name(),
        rays: rays.len(),
        hits: hits.into_iter().flatten().collect(),
    })
}

fn hits_of<F: Scalar>(
    scene: &Scene<F>,
    index: usize,
    ray: &Ray<F>,
) -> Result<Vec<FaceHit>, InvalidRay> {
    let mut all = Vec::new();
    for hit in scene.hits(ray)? {
        // All of these have the same t.
        let [t, last_t] = scene.t(ray, hit.faces[0])?.unwrap_or([f64::NAN; 2]);
        all.extend(hit.faces.into_iter().map(|face| FaceHit {
            ray: index,
            face,
            t,
            last_t,
        }));
    }
    Ok(all)
}

impl Paged for AllHits {
    fn page(&self) -> Page {
        let rays = number_of(self.rays as u64, "ray", "rays");
        let heads = vec![Head::of("ray"), Head::of("face"), Head::of("t")];
        let row = |hit: &FaceHit| {
            let cells = [
                Cell::words(hit.face.to_string()),
                Cell::words(format!("{:?}", hit.t)),
            ];
            Row::new(hit.ray.to_string(), cells)
        };
        let rows = self.hits.iter().take(SHOWN).map(row).collect();
        let mut blocks = vec![Block::Table(Table::new(heads, rows))];
        if SHOWN < self.hits.len() {
            blocks.push(Block::text("--format csv has every hit."));
        }
        let hits = self.hits.len() as u64;
        Page {
            command: "rays",
            title: format!("{} of {rays} with faces", number_of(hits, "hit", "hits")),
            blocks,
            ..Page::default()
        }
    }
}
