//! The faces around the ray as elements of SVG: solid, but for those that hide what the picture is about, which are lines.

use super::space::{Region, normal};
use super::view::{SIZE, View, Wished, clipped};
use crate::arith::Float;
use glam::{DVec2, DVec3};
use hairline_scene::Scene;
use std::fmt::Write as _;

/// At most so many faces are drawn.
const MOST: usize = 2_000;

/// Faces that are drawn together, from far to near: in a part those of one shade are one element.
const PART: usize = 64;

/// Shades from dark to light.
const SHADES: usize = 4;

/// A face hides a point that is farther behind it, in radii of the region.
const THICKNESS: f64 = 1e-3;

/// Parts of a dot in which coordinates are written.
const TENTHS: f64 = 10.0;

/// The faces that are drawn.
pub(super) struct Surface {
    /// The elements.
    pub elements: String,
    /// How many are drawn.
    pub drawn: usize,
    /// How many could be seen.
    pub seen: usize,
    /// True if some are lines only.
    pub has_lines: bool,
}

/// A face in the drawing.
struct Seen {
    corners: [DVec3; 3],
    /// The distance from what the picture is about.
    distance: f64,
}

impl Seen {
    fn depth(&self, view: &View) -> f64 {
        middle(&self.corners).dot(view.towards)
    }

    fn shade(&self, view: &View) -> usize {
        let lit = normal(self.corners).dot(view.towards).abs();
        ((lit * SHADES as f64) as usize).min(SHADES - 1)
    }

    fn outline(&self, view: &View) -> String {
        outline(&self.corners.map(|corner| view.place(corner)))
    }

    /// True if it lies on the viewer's side of the ray.
    fn is_before(&self, view: &View, wished: &Wished) -> bool {
        0.0 < (middle(&self.corners) - wished.anchor).dot(view.before)
    }

    /// True if its box in the drawing meets the line on which the ray is drawn, from left to right.
    fn meets_line(&self, view: &View, wished: &Wished) -> bool {
        let [a, b, c] = self.corners.map(|corner| view.place(corner).y);
        let line = view.place(wished.anchor).y;
        a.min(b).min(c) <= line && line <= a.max(b).max(c)
    }

    /// True if a point is seen through it.
    fn hides(&self, view: &View, point: DVec3) -> bool {
        let at = view.place(point);
        let [a, b, c] = self.corners.map(|corner| view.place(corner) - at);
        let weights = [b.perp_dot(c), c.perp_dot(a), a.perp_dot(b)];
        let is_inside = weights.iter().all(|it| 0.0 < *it) || weights.iter().all(|it| *it < 0.0);
        let sum: f64 = weights.iter().sum();
        let heights = self
            .corners
            .map(|corner| (corner - point).dot(view.towards));
        let height: f64 = weights.iter().zip(heights).map(|(w, h)| w / sum * h).sum();
        is_inside && THICKNESS < height
    }
}

fn middle([a, b, c]: &[DVec3; 3]) -> DVec3 {
    (*a + *b + *c) / 3.0
}

impl Surface {
    /// The faces of a mesh in the drawing, those nearest to the points if they are too many.
    pub fn of<F: Float>(
        scene: &Scene<F>,
        region: &Region,
        view: &View,
        wished: &Wished,
    ) -> Surface {
        let mut faces = Vec::new();
        for face in scene.finite() {
            let triangle = scene.triangle(*face);
            let placed = triangle.and_then(|triangle| region.place_triangle(&triangle));
            if let Some(corners) = placed.filter(|corners| is_in_drawing(view, corners)) {
                let distance = distance(&corners, &wished.points);
                faces.push(Seen { corners, distance });
            }
        }
        let seen = faces.len();
        if MOST < seen {
            faces.select_nth_unstable_by(MOST, |a, b| a.distance.total_cmp(&b.distance));
            faces.truncate(MOST);
        }
        let is_hidden = |point: &DVec3| faces.iter().any(|face| face.hides(view, *point));
        let is_cut = wished.points.iter().any(is_hidden);
        let is_line =
            |face: &Seen| face.is_before(view, wished) && (is_cut || face.meets_line(view, wished));
        let (lines, mut solid): (Vec<Seen>, Vec<Seen>) = faces.into_iter().partition(is_line);
        solid.sort_by(|a, b| a.depth(view).total_cmp(&b.depth(view)));
        // Of a face beside the drawing nothing is left.
        let drawn = lines.len() + solid.len();
        let lines: String = lines.iter().map(|face| face.outline(view)).collect();
        Surface {
            elements: elements(view, &lines, &solid),
            drawn,
            seen,
            has_lines: !lines.is_empty(),
        }
    }
}

fn elements(view: &View, lines: &str, solid: &[Seen]) -> String {
    let mut elements = String::from("<g class=\"faces\" transform=\"scale(.1)\">");
    for part in solid.chunks(PART) {
        let mut shades = [const { String::new() }; SHADES];
        for face in part {
            shades[face.shade(view)] += &face.outline(view);
        }
        for (shade, path) in shades.iter().enumerate() {
            if !path.is_empty() {
                let _ = write!(elements, "<path class=\"s{shade}\" d=\"{path}\"/>");
            }
        }
    }
    if !lines.is_empty() {
        let _ = write!(elements, "<path class=\"lines\" d=\"{lines}\"/>");
    }
    elements + "</g>\n"
}

/// True if some of the box around a face is in the drawing.
fn is_in_drawing(view: &View, corners: &[DVec3; 3]) -> bool {
    let [a, b, c] = corners.map(|corner| view.place(corner));
    let min = a.min(b).min(c);
    let max = a.max(b).max(c);
    let [width, height] = SIZE;
    0.0 <= max.x && 0.0 <= max.y && min.x <= width && min.y <= height
}

/// The least distance of the ball around a face from some points.
fn distance(corners: &[DVec3; 3], points: &[DVec3]) -> f64 {
    let centre = middle(corners);
    let radii = corners.map(|corner| corner.distance(centre));
    let radius = radii.into_iter().fold(0.0, f64::max);
    let to_points = points.iter().map(|point| point.distance(centre) - radius);
    to_points.fold(f64::INFINITY, f64::min).max(0.0)
}

/// A polygon as a path in tenths, clipped; empty if it is outside.
pub(super) fn outline(polygon: &[DVec2]) -> String {
    let mut path = String::new();
    let mut at = [0; 2];
    for (i, point) in clipped(polygon).into_iter().enumerate() {
        let to = (point * TENTHS).to_array().map(|x| x.round() as i32);
        let step = [to[0] - at[0], to[1] - at[1]];
        let _ = match i {
            0 => write!(path, "M{} {}", to[0], to[1]),
            _ => write!(path, "l{} {}", step[0], step[1]),
        };
        at = to;
    }
    if !path.is_empty() {
        path.push('z');
    }
    path
}
