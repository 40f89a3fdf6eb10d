//! Where a picture is looked at from, and places in the drawing.

use super::space::normal;
use glam::{DVec2, DVec3};

/// The drawing's width and height.
pub(super) const SIZE: [f64; 2] = [460.0, 320.0];

/// The margins around the points that are shown, across and down.
const MARGINS: [f64; 2] = [36.0, 44.0];

/// The directions that are tried around the ray.
const AROUND: u32 = 36;

/// By how much the viewer stands towards the ray's start, in radians: less, and a face that the ray meets head-on is a line.
const TILTS: [f64; 3] = [0.3, 0.5, 0.7];

/// A face is seen well enough at this cosine: seen head-on, it would not tell where the ray comes from.
const OBLIQUE: f64 = 0.6;

/// A view from far away.
pub(super) struct View {
    right: DVec3,
    up: DVec3,
    /// The direction to the viewer.
    pub towards: DVec3,
    /// The side of the ray on which the viewer is.
    pub before: DVec3,
    middle: DVec2,
    scale: f64,
}

/// The wishes to a view.
pub(super) struct Wished {
    /// The ray's direction, of length 1.
    pub along: DVec3,
    /// A point of the ray.
    pub anchor: DVec3,
    /// The points that have to be seen, the exact one first.
    pub points: Vec<DVec3>,
    /// The faces that should not be seen from their edge, the exact one first.
    pub faces: Vec<[DVec3; 3]>,
    /// The margin around each point.
    pub margin: f64,
}

impl View {
    /// The view that shows best what is wished.
    pub fn best(wished: &Wished) -> View {
        let (one, other) = wished.along.any_orthonormal_pair();
        let mut best = View::new(wished, one, TILTS[0]);
        let mut most = f64::NEG_INFINITY;
        for step in 0..AROUND {
            let angle = f64::from(step) * std::f64::consts::TAU / f64::from(AROUND);
            let side = angle.cos() * one + angle.sin() * other;
            for tilt in TILTS {
                let view = View::new(wished, side, tilt);
                let shown = view.shown_of(wished);
                if most < shown {
                    most = shown;
                    best = view;
                }
            }
        }
        best
    }

    /// From one side of the ray, and somewhat from its start. The ray runs to the right.
    fn new(wished: &Wished, side: DVec3, tilt: f64) -> View {
        let towards = tilt.cos() * side - tilt.sin() * wished.along;
        let right = (wished.along - wished.along.dot(towards) * towards).normalize();
        let mut view = View {
            right,
            up: towards.cross(right),
            towards,
            before: side,
            middle: DVec2::ZERO,
            scale: 1.0,
        };
        view.fit(wished);
        view
    }

    /// Chooses the scale, so that all points are in the drawing.
    fn fit(&mut self, wished: &Wished) {
        let mut min = DVec2::INFINITY;
        let mut max = DVec2::NEG_INFINITY;
        for point in &wished.points {
            let place = self.flat(*point);
            min = min.min(place);
            max = max.max(place);
        }
        let extent = max - min + 2.0 * DVec2::splat(wished.margin);
        let room = DVec2::from(SIZE) - 2.0 * DVec2::from(MARGINS);
        self.middle = min.midpoint(max);
        self.scale = (room / extent).min_element();
    }

    /// How much of the points' distances and of the faces is seen.
    fn shown_of(&self, wished: &Wished) -> f64 {
        let [first, others @ ..] = &wished.points[..] else {
            return 0.0;
        };
        let last = others.iter().map(|point| *point - *first);
        let apart = last.max_by(|a, b| a.length().total_cmp(&b.length()));
        let apart = apart.unwrap_or(DVec3::ZERO).normalize_or_zero();
        let seen_apart = 1.0 - apart.dot(self.towards).powi(2);
        let mut faces = wished.faces.iter().map(|face| normal(*face));
        // The exact face from the side on which the ray comes, the answered one from any.
        let exact = faces.next().unwrap_or_default();
        let side = -exact.dot(wished.along).signum() * exact;
        let answered = faces.next().unwrap_or_default();
        let seen_exact = side.dot(self.towards).min(OBLIQUE);
        let seen_answered = answered.dot(self.towards).abs().min(OBLIQUE);
        2.0 * seen_apart + seen_exact + seen_answered
    }

    fn flat(&self, point: DVec3) -> DVec2 {
        DVec2::new(point.dot(self.right), -point.dot(self.up))
    }

    /// A point's place in the drawing.
    pub fn place(&self, point: DVec3) -> DVec2 {
        (self.flat(point) - self.middle) * self.scale + DVec2::from(SIZE) / 2.0
    }
}

/// The part of a polygon that is inside the drawing (Sutherland and Hodgman). Empty if nothing is.
pub(super) fn clipped(polygon: &[DVec2]) -> Vec<DVec2> {
    let [width, height] = SIZE;
    let mut inside = polygon.to_vec();
    for (axis, edge) in [
        (DVec2::X, 0.0),
        (DVec2::NEG_X, -width),
        (DVec2::Y, 0.0),
        (DVec2::NEG_Y, -height),
    ] {
        inside = half_of(&inside, |point| point.dot(axis) - edge);
    }
    inside
}

/// The part of a polygon where a linear function is not negative.
fn half_of(polygon: &[DVec2], height: impl Fn(DVec2) -> f64) -> Vec<DVec2> {
    let mut half = Vec::with_capacity(polygon.len() + 1);
    for (i, point) in polygon.iter().enumerate() {
        let before = polygon[(i + polygon.len() - 1) % polygon.len()];
        let heights = [height(before), height(*point)];
        if (heights[0] < 0.0) != (heights[1] < 0.0) {
            let share = heights[0] / (heights[0] - heights[1]);
            half.push(before.lerp(*point, share));
        }
        if 0.0 <= heights[1] {
            half.push(*point);
        }
    }
    half
}
