//! One ray: everything that it meets, in order.

use crate::case::Case;
use crate::corpus::lines::AnyCase;
use crate::files::mesh::Mesh;
use crate::kernel::Scalar;
use crate::report::page::{Block, Cell, Command, Head, Page, Paged, Row, Table};
use crate::single::{explain_command, joined};
use hairline_scene::{InvalidRay, OpenEdge, Passage, Ray, Scene, Winding};
use serde::Serialize;

/// A ray's meetings with a mesh.
#[derive(Serialize)]
pub struct RayTold {
    scalar: &'static str,
    nearest: Option<NearestTold>,
    meetings: Vec<Meeting>,
}

/// The nearest hit.
#[derive(Serialize)]
struct NearestTold {
    faces: Vec<u32>,
    /// The nearest double to t.
    t: f64,
    point: [f64; 3],
    /// u and v of the first face, if the ray does not run in its plane.
    uv: Option<[f64; 2]>,
    /// Shows what kernels answer on the first face.
    command: String,
}

/// A point, or a segment in the surface, that a ray shares with it.
#[derive(Serialize)]
struct Meeting {
    /// The nearest doubles to its first and last t; of a point they are the same.
    t: [f64; 2],
    faces: Vec<u32>,
    is_segment: bool,
    /// `crosses`, `touches`, or `not defined`.
    kind: &'static str,
    /// The windings before and after, in words; none where the surface is open somewhere.
    winding: Option<[String; 2]>,
    /// A face with an edge where the surface is open, if that leaves the kind or the winding undefined.
    open_at: Option<u32>,
}

/// Tells one ray.
pub fn told<F: Scalar>(mesh: &Mesh, scene: &Scene<F>, ray: &Ray<F>) -> Result<RayTold, InvalidRay>
where
    Case<F>: Into<AnyCase>,
{
    let nearest = match scene.nearest(ray)? {
        None => None,
        Some(nearest) => {
            let face = nearest.faces[0];
            let values = scene.values(ray, face)?;
            values.map(|values| NearestTold {
                faces: nearest.faces,
                t: values.t[0],
                point: values.points[0],
                uv: values.uv,
                command: explain_command(mesh, ray, face),
            })
        }
    };
    let passages = scene.passages(ray)?;
    let meetings: Result<Vec<Meeting>, InvalidRay> = passages
        .into_iter()
        .map(|passage| meeting(scene, ray, passage))
        .collect();
    Ok(RayTold {
        scalar: F::NAME.name(),
        nearest,
        meetings: meetings?,
    })
}

fn meeting<F: Scalar>(
    scene: &Scene<F>,
    ray: &Ray<F>,
    passage: Passage,
) -> Result<Meeting, InvalidRay> {
    let t = scene.ends(ray, &passage)?;
    let (kind, open) = match passage.crosses() {
        Ok(true) => ("crosses", None),
        Ok(false) => ("touches", None),
        Err(edge) => ("not defined", Some(edge)),
    };
    let open = open.or(passage.around.err());
    let winding = passage.around.ok().map(|around| around.map(in_words));
    Ok(Meeting {
        t,
        faces: passage.faces,
        is_segment: passage.is_segment,
        kind,
        winding,
        open_at: open.map(|OpenEdge { face, .. }| face),
    })
}

fn in_words(winding: Winding) -> String {
    match winding {
        Winding::Number(number) => number.to_string(),
        Winding::IsOdd(true) => "odd".to_owned(),
        Winding::IsOdd(false) => "even".to_owned(),
    }
}

impl Paged for RayTold {
    fn page(&self) -> Page {
        let mut blocks = Vec::new();
        let mut commands = Vec::new();
        let title = match &self.nearest {
            None => "The ray meets no face".to_owned(),
            Some(nearest) => {
                blocks.push(Block::terms(numbers(nearest)));
                commands.push(Command {
                    line: nearest.command.clone(),
                    what: "what kernels answer on this face",
                });
                match &nearest.faces[..] {
                    [face] => format!("The nearest hit is face {face}, at t = {:?}", nearest.t),
                    several => format!(
                        "The nearest hit is at t = {:?}, on faces {}: each is a right answer",
                        nearest.t,
                        joined(several).replace(' ', ", ")
                    ),
                }
            }
        };
        if !self.meetings.is_empty() {
            blocks.push(Block::Heading("In order".to_owned()));
            blocks.push(Block::Table(self.table()));
        }
        if let Some(face) = self.meetings.iter().find_map(|meeting| meeting.open_at) {
            blocks.push(Block::text(format!(
                "The surface is open, at an edge of face {face} among others, so it has no inside."
            )));
        }
        blocks.push(Block::text(format!(
            "Exactly decided for the numbers in {}; t, point, u and v are the nearest doubles.",
            self.scalar
        )));
        if !commands.is_empty() {
            blocks.push(Block::Commands("next", commands));
        }
        Page {
            command: "rays",
            title,
            blocks,
            ..Page::default()
        }
    }
}

fn numbers(nearest: &NearestTold) -> Vec<(&'static str, String)> {
    let [x, y, z] = nearest.point;
    let mut terms = vec![("point", format!("{x:?}, {y:?}, {z:?}"))];
    if let Some([u, v]) = nearest.uv {
        terms.push((
            "u, v",
            format!("{u:?}, {v:?}, of face {}", nearest.faces[0]),
        ));
    }
    terms
}

impl RayTold {
    fn table(&self) -> Table {
        let heads = vec![
            Head::of("t"),
            Head::text("faces"),
            Head::text("the ray"),
            Head::text("winding"),
        ];
        let row = |meeting: &Meeting| {
            let [from, to] = meeting.t;
            let label = match meeting.is_segment {
                true => format!("{from:?} to {to:?}"),
                false => format!("{from:?}"),
            };
            let kind = match (meeting.is_segment, meeting.kind) {
                (false, kind) => kind.to_owned(),
                (true, "crosses") => "runs in the surface, and crosses it".to_owned(),
                (true, "touches") => "runs in the surface, and comes back".to_owned(),
                (true, _) => "runs in the surface".to_owned(),
            };
            let winding = match &meeting.winding {
                Some([before, after]) => format!("{before} to {after}"),
                None => "-".to_owned(),
            };
            let cells = [joined(&meeting.faces), kind, winding];
            Row::new(label, cells.map(Cell::words))
        };
        Table::new(heads, self.meetings.iter().map(row).collect())
    }
}
