//! A square window onto a plane: what of a stretch, a triangle or a point is seen in it.

use super::frame::Stretch;
use std::fmt::Write;

/// A window: where it lies in the drawing, and what it looks at.
pub(super) struct Panel {
    /// In the drawing.
    pub left: f64,
    pub top: f64,
    pub side: f64,
    /// The point in its middle; `half` is half of what fits into it, in units.
    pub centre: [f64; 2],
    pub half: f64,
}

impl Panel {
    /// A point of the plane against the window, whose inside is from -1 to 1.
    fn relative(&self, point: [f64; 2]) -> [f64; 2] {
        [0, 1].map(|i| (point[i] - self.centre[i]) / self.half)
    }

    /// Where a point within the window is drawn.
    fn drawn(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let middle = self.side / 2.0;
        [
            self.left + middle * (1.0 + x),
            self.top + middle * (1.0 - y),
        ]
    }

    /// Where a point is drawn; none outside of the window.
    pub fn place(&self, point: [f64; 2]) -> Option<[f64; 2]> {
        let point = self.relative(point);
        point
            .iter()
            .all(|x| x.abs() <= 1.0)
            .then(|| self.drawn(point))
    }

    /// The ends of what is seen of a stretch; none if nothing is.
    pub fn ends(&self, stretch: &Stretch) -> Option<[[f64; 2]; 2]> {
        let foot = self.relative(stretch.foot);
        let (mut from, mut to) = (stretch.from / self.half, stretch.to / self.half);
        for (x, way) in foot.into_iter().zip(stretch.way) {
            if !x.is_finite() || (way == 0.0 && x.abs() > 1.0) {
                return None;
            }
            if way != 0.0 {
                let (a, b) = ((-1.0 - x) / way, (1.0 - x) / way);
                (from, to) = (from.max(a.min(b)), to.min(a.max(b)));
            }
        }
        let at =
            |s: f64| self.drawn([0, 1].map(|i| (foot[i] + s * stretch.way[i]).clamp(-1.0, 1.0)));
        (from <= to && from.is_finite() && to.is_finite()).then(|| [at(from), at(to)])
    }

    /// The visible part of the points to the left of some stretches (all of them), as the data of a path;
    /// empty if nothing is.
    pub fn left_of(&self, stretches: &[Stretch]) -> String {
        let mut corners = vec![[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
        for stretch in stretches {
            let (foot, [x, y]) = (self.relative(stretch.foot), stretch.way);
            let height = |p: [f64; 2]| (p[1] - foot[1]) * x - (p[0] - foot[0]) * y;
            let mut kept = Vec::new();
            for (i, &p) in corners.iter().enumerate() {
                let q = corners[(i + 1) % corners.len()];
                let (hp, hq) = (height(p), height(q));
                if hp >= 0.0 {
                    kept.push(p);
                }
                if (hp >= 0.0) != (hq >= 0.0) {
                    let s = hp / (hp - hq);
                    kept.push([0, 1].map(|i| p[i] + s * (q[i] - p[i])));
                }
            }
            corners = kept;
        }
        let mut path = String::new();
        if corners.iter().flatten().any(|x| !x.is_finite()) {
            return path;
        }
        for (i, corner) in corners.into_iter().enumerate() {
            let [x, y] = self.drawn(corner);
            let _ = write!(path, "{}{x:.2} {y:.2}", if i == 0 { "M" } else { "L" });
        }
        if !path.is_empty() {
            path.push('z');
        }
        path
    }

    /// A point outside of the window: where on its rim it is nearest, as seen from the middle, and which
    /// way it lies. None for a point within, or one that is nowhere.
    pub fn pointer(&self, point: [f64; 2]) -> Option<([f64; 2], [f64; 2])> {
        let [x, y] = self.relative(point);
        let size = x.abs().max(y.abs());
        if !size.is_finite() || size <= 1.0 {
            return None;
        }
        let way = [x / size, y / size];
        let length = way[0].hypot(way[1]);
        Some((self.drawn(way), [way[0] / length, -way[1] / length]))
    }
}
