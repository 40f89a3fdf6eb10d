//! A square window onto a plane: what of a stretch, a triangle or a point is seen in it.

use super::frame::Stretch;
use std::fmt::Write;

/// A point of the plane, or of the drawing.
type Point = [f64; 2];

/// A window: where it lies in the drawing, and what it looks at.
pub(super) struct Panel {
    /// In the drawing.
    pub left: f64,
    pub top: f64,
    pub side: f64,
    /// The point in its middle; `half` is half of what fits into it, in units.
    pub centre: Point,
    pub half: f64,
}

impl Panel {
    /// A point of the plane against the window, whose inside is from -1 to 1.
    fn relative(&self, point: Point) -> Point {
        [0, 1].map(|i| (point[i] - self.centre[i]) / self.half)
    }

    /// Where a point within the window is drawn.
    fn drawn(&self, [x, y]: Point) -> Point {
        let middle = self.side / 2.0;
        [
            self.left + middle * (1.0 + x),
            self.top + middle * (1.0 - y),
        ]
    }

    /// Where a point is drawn; none outside of the window.
    pub fn place(&self, point: Point) -> Option<Point> {
        let [x, y] = self.relative(point);
        let is_seen = x.abs() <= 1.0 && y.abs() <= 1.0;
        is_seen.then(|| self.drawn([x, y]))
    }

    /// The ends of what is seen of a stretch; none if nothing is.
    pub fn ends(&self, stretch: &Stretch) -> Option<[Point; 2]> {
        let foot = self.relative(stretch.foot);
        let mut from = stretch.from / self.half;
        let mut to = stretch.to / self.half;
        for (x, way) in foot.into_iter().zip(stretch.way) {
            if !x.is_finite() {
                return None;
            }
            if way == 0.0 {
                if x.abs() > 1.0 {
                    return None;
                }
                continue;
            }
            let at_low_side = (-1.0 - x) / way;
            let at_high_side = (1.0 - x) / way;
            from = from.max(at_low_side.min(at_high_side));
            to = to.min(at_low_side.max(at_high_side));
        }
        if !from.is_finite() || !to.is_finite() || to < from {
            return None;
        }
        let at = |share: f64| {
            let point = [0, 1].map(|i| foot[i] + share * stretch.way[i]);
            self.drawn(point.map(|x| x.clamp(-1.0, 1.0)))
        };
        Some([at(from), at(to)])
    }

    /// The visible part of the points to the left of some stretches (all of them), as the data of a path;
    /// empty if nothing is.
    pub fn left_of(&self, stretches: &[Stretch]) -> String {
        let mut corners = vec![[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
        for stretch in stretches {
            let foot = self.relative(stretch.foot);
            corners = cut_off(&corners, foot, stretch.way);
        }
        let mut path = String::new();
        if corners.iter().flatten().any(|x| !x.is_finite()) {
            return path;
        }
        for corner in corners {
            let [x, y] = self.drawn(corner);
            let command = if path.is_empty() { "M" } else { "L" };
            let _ = write!(path, "{command}{x:.2} {y:.2}");
        }
        if !path.is_empty() {
            path.push('z');
        }
        path
    }

    /// A point outside of the window: where on its rim it is nearest, as seen from the middle, and which
    /// way it lies. None for a point within, or one that is nowhere.
    pub fn pointer(&self, point: Point) -> Option<(Point, Point)> {
        let [x, y] = self.relative(point);
        let size = x.abs().max(y.abs());
        if !size.is_finite() || size <= 1.0 {
            return None;
        }
        let way = [x / size, y / size];
        let length = way[0].hypot(way[1]);
        let drawn_way = [way[0] / length, -way[1] / length];
        Some((self.drawn(way), drawn_way))
    }
}

/// The part of a convex polygon to the left of a line through a foot.
fn cut_off(corners: &[Point], foot: Point, way: Point) -> Vec<Point> {
    let height = |point: Point| {
        let [x, y] = [0, 1].map(|i| point[i] - foot[i]);
        y * way[0] - x * way[1]
    };
    let mut kept = Vec::new();
    for (i, from) in corners.iter().enumerate() {
        let to = &corners[(i + 1) % corners.len()];
        let from_height = height(*from);
        let to_height = height(*to);
        if from_height >= 0.0 {
            kept.push(*from);
        }
        if (from_height >= 0.0) != (to_height >= 0.0) {
            let share = from_height / (from_height - to_height);
            kept.push([0, 1].map(|i| from[i] + share * (to[i] - from[i])));
        }
    }
    kept
}
