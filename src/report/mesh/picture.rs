//! The drawing as a picture that stands still, for readers without scripts.

use super::drawing::{Drawing, Mark, UNIT};
use maud::{Markup, html};
use std::collections::HashSet;
use std::fmt::Write;

/// Half of the picture's side. Coordinates are whole numbers.
const HALF: f64 = 1000.0;

/// The mesh's edges with a row's marks, seen as the script first shows them.
pub(super) fn still(drawing: &Drawing, marks: &[Mark]) -> Markup {
    let radius = drawing
        .points
        .iter()
        .map(|(_, at)| at.map(f64::from))
        .fold(1.0, |m: f64, at| m.max(at.iter().map(|x| x * x).sum::<f64>().sqrt()));
    let seen: Vec<[i32; 2]> = drawing
        .points
        .iter()
        .map(|(_, at)| turned(at.map(|x| f64::from(x) / radius.max(UNIT / 2.0))))
        .collect();
    let mut drawn = HashSet::new();
    let mut wire = String::new();
    for [a, b, c] in &drawing.triangles {
        for (from, to) in [(a, b), (b, c), (c, a)] {
            if drawn.insert([from.min(to), from.max(to)]) {
                add_line(&mut wire, seen[*from as usize], seen[*to as usize]);
            }
        }
    }
    let mut paths = [const { String::new() }; 3];
    for mark in marks {
        let [from, to] = mark.ends.map(|end| seen[end as usize]);
        add_line(&mut paths[mark.wrong as usize], from, to);
    }
    let side = 2.0 * HALF;
    html! {
        svg #still viewBox=(format!("-{HALF} -{HALF} {side} {side}")) role="img" aria-label="The mesh's edges, with the marked places of one kernel row" {
            path.wire vector-effect="non-scaling-stroke" d=(wire) {}
            @for (kind, path) in paths.iter().enumerate().filter(|(_, path)| !path.is_empty()) {
                path class={ "mark w" (kind) } vector-effect="non-scaling-stroke" d=(path) {}
            }
        }
    }
}

/// A round cap makes a point of a line to its own start.
fn add_line(path: &mut String, [x, y]: [i32; 2], [to_x, to_y]: [i32; 2]) {
    write!(path, "M{x} {y}l{} {}", to_x - x, to_y - y).expect("a string");
}

/// As view.js turns it: about y, then about x; y is up.
fn turned([x, y, z]: [f64; 3]) -> [i32; 2] {
    let (yaw, pitch) = (-0.6f64, 0.45f64);
    let forth = z * yaw.cos() - x * yaw.sin();
    let right = x * yaw.cos() + z * yaw.sin();
    let up = y * pitch.cos() - forth * pitch.sin();
    [right, -up].map(|part| (part * HALF * 0.94).round() as i32)
}
