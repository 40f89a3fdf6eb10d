//! The marks of a picture: the ray, the exact points and faces, and those that were answered.

use super::surface::outline;
use super::view::{SIZE, View, clipped};
use crate::report::page::text_at;
use glam::{DVec2, DVec3};
use std::fmt::Write as _;

/// Half of an answered point's cross.
const CROSS: f64 = 5.0;

/// The radius of an exact point.
const DOT: f64 = 4.5;

/// The width of a letter, about.
const LETTER: f64 = 7.2;

/// The length of an arrow's head.
const HEAD: f64 = 9.0;

/// The colour of a mark: exact, or answered.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    Exact,
    Answered,
}

impl Kind {
    fn class(self) -> &'static str {
        match self {
            Kind::Exact => "exact",
            Kind::Answered => "answered",
        }
    }
}

/// A face, filled with its colour.
pub(super) fn face(view: &View, kind: Kind, corners: &[DVec3; 3]) -> String {
    let path = outline(&corners.map(|corner| view.place(corner)));
    let class = kind.class();
    match path.is_empty() {
        true => String::new(),
        false => format!(
            "<path class=\"face {class}\" transform=\"scale(.1)\" vector-effect=\"non-scaling-stroke\" d=\"{path}\"/>\n"
        ),
    }
}

/// A point, if it is in the drawing.
pub(super) fn point(view: &View, kind: Kind, point: DVec3) -> String {
    let DVec2 { x, y } = view.place(point);
    if clipped(&[DVec2 { x, y }]).is_empty() {
        return String::new();
    }
    match kind {
        Kind::Exact => {
            format!("<circle class=\"spot exact\" cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{DOT}\"/>\n")
        }
        Kind::Answered => {
            let [left, top] = [x - CROSS, y - CROSS];
            let side = 2.0 * CROSS;
            format!(
                "<path class=\"cross answered\" d=\"M{left:.1} {top:.1}l{side} {side}m0 -{side}l-{side} {side}\"/>\n"
            )
        }
    }
}

/// A label at a place, above it or below, within the drawing.
pub(super) fn label(view: &View, kind: Kind, at: DVec3, words: &str) -> String {
    let [width, height] = SIZE;
    let DVec2 { x, y } = view.place(at);
    let half = LETTER * words.chars().count() as f64 / 2.0;
    let left = (x - half).clamp(4.0, (width - 2.0 * half).max(4.0));
    let lower = match kind {
        Kind::Exact => y - 14.0,
        Kind::Answered => y + 24.0,
    };
    let class = format!("label {}", kind.class());
    text_at(left, lower.clamp(16.0, height - 8.0), &class, words)
}

/// The ray, from one point to another, with an arrow's head if it has a direction.
pub(super) fn ray(view: &View, ends: [DVec3; 2], has_head: bool) -> String {
    let line = clipped(&ends.map(|end| view.place(end)));
    let forwards = (view.place(ends[1]) - view.place(ends[0])).normalize_or_zero();
    let by_way = |a: &&DVec2, b: &&DVec2| a.dot(forwards).total_cmp(&b.dot(forwards));
    let (Some(from), Some(to)) = (line.iter().min_by(by_way), line.iter().max_by(by_way)) else {
        return String::new();
    };
    let mut elements = format!(
        "<path class=\"ray\" d=\"M{:.1} {:.1}L{:.1} {:.1}\"/>\n",
        from.x, from.y, to.x, to.y
    );
    if has_head && HEAD < from.distance(*to) {
        let back = *to - HEAD * forwards;
        let aside = 0.4 * HEAD * forwards.perp();
        let [one, other] = [back + aside, back - aside];
        let _ = writeln!(
            elements,
            "<path class=\"head\" d=\"M{:.1} {:.1}L{:.1} {:.1}L{:.1} {:.1}z\"/>",
            to.x, to.y, one.x, one.y, other.x, other.y
        );
    }
    elements
}

/// The start of the ray, or the point that is asked about, if it is in the drawing.
pub(super) fn start(view: &View, at: DVec3) -> String {
    let DVec2 { x, y } = view.place(at);
    match clipped(&[DVec2 { x, y }]).is_empty() {
        true => String::new(),
        false => format!("<circle class=\"head\" cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"3.5\"/>\n"),
    }
}
