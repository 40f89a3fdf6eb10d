//! Points inside, outside or on a mesh.

use crate::asked::{BadRay, of_all};
use crate::kernel::Scalar;
use crate::record::{group_digits, number_of};
use crate::report::Format;
use crate::report::page::{Block, Page, Paged};
use crate::single::{joined, place_name};
use hairline_scene::{Location, OpenEdge, Scene, Winding};
use serde::Serialize;

/// Where each point is.
#[derive(Serialize)]
pub struct LocatedPoints {
    scalar: &'static str,
    points: Vec<LocatedPoint>,
}

/// Where a point is.
#[derive(Serialize)]
struct LocatedPoint {
    /// `inside`, `outside`, `on`, or `not defined`.
    place: &'static str,
    /// The winding number, where it is defined.
    winding: Option<i64>,
    /// The faces that it is on.
    faces: Vec<u32>,
    /// A face with an edge where the surface is open.
    open_at: Option<u32>,
}

impl LocatedPoints {
    /// The formats: those of a page, and a line a point.
    pub const FORMATS: &'static [Format<LocatedPoints>] = &[
        Format::TEXT,
        Format::JSON,
        Format::MARKDOWN,
        Format::HTML,
        Format {
            name: "csv",
            write: |located, _, out| {
                writeln!(out, "place,winding,faces")?;
                for point in &located.points {
                    let winding = point.winding.map_or(String::new(), |it| it.to_string());
                    let faces = joined(&point.faces);
                    writeln!(out, "{},{winding},{faces}", point.place)?;
                }
                Ok(())
            },
        },
    ];
}

/// Locates all points.
pub fn located<F: Scalar>(scene: &Scene<F>, points: &[[F; 3]]) -> Result<LocatedPoints, BadRay> {
    let points = of_all(points.len(), |index| scene.locate(points[index]).map(told))?;
    Ok(LocatedPoints {
        scalar: F::NAME.name(),
        points,
    })
}

fn told(location: Location) -> LocatedPoint {
    let nowhere = LocatedPoint {
        place: place_name(&location),
        winding: None,
        faces: Vec::new(),
        open_at: None,
    };
    match location {
        Location::On(faces) => LocatedPoint { faces, ..nowhere },
        Location::Off(winding) => LocatedPoint {
            winding: match winding {
                Winding::Number(number) => Some(number),
                Winding::IsOdd(_) => None,
            },
            ..nowhere
        },
        Location::NotDefined(OpenEdge { face, .. }) => LocatedPoint {
            open_at: Some(face),
            ..nowhere
        },
    }
}

impl Paged for LocatedPoints {
    fn page(&self) -> Page {
        let count = |place: &str| {
            let there = self.points.iter().filter(|point| point.place == place);
            there.count() as u64
        };
        let total = number_of(self.points.len() as u64, "point", "points");
        let places = ["inside", "outside", "on"].map(|place| {
            let words = if place == "on" {
                "on the surface"
            } else {
                place
            };
            format!("{} {words}", group_digits(count(place)))
        });
        let mut blocks = Vec::new();
        let open = self.points.iter().find_map(|point| point.open_at);
        if let Some(face) = open {
            blocks.push(Block::text(format!(
                "{} have no inside or outside: the surface is open, at an edge of face {face} among others.",
                number_of(count("not defined"), "point", "points"),
            )));
        }
        blocks.push(Block::text(
            "Exactly decided, for the numbers as they are given. --format csv has every point.",
        ));
        Page {
            command: "rays",
            title: format!("Of {total}: {}", places.join(", ")),
            blocks,
            ..Page::default()
        }
    }
}
