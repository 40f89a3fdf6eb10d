//! Families in full floats: rays aimed at a point of a box, rounded.

use crate::case::{BoxCase, each_axis};
use hairline_core::Float;
use hairline_core::arith::scale_by_power_of_two;
use hairline_core::case::Draw;

type Point<F> = [F; 3];

/// A box whose sides are at least 1/16 long, in [-1, 1].
struct Room<F> {
    min: Point<F>,
    max: Point<F>,
}

impl<F: Float> Room<F> {
    fn drawn(draw: &mut Draw) -> Room<F> {
        loop {
            let a = draw.point::<F>();
            let b = draw.point::<F>();
            let room = Room {
                min: each_axis(|i| a[i].smaller(b[i])),
                max: each_axis(|i| a[i].larger(b[i])),
            };
            if is_away(room.min, room.max) {
                return room;
            }
        }
    }

    /// A point between the planes of an axis, away from both by this share of the side at least.
    fn between(&self, draw: &mut Draw, axis: usize, share: f64) -> F {
        let side = self.max[axis] - self.min[axis];
        let free = 1.0 - 2.0 * share;
        let weight = share + free * draw.unit();
        self.min[axis] + side * number::<F>(weight)
    }

    fn inside(&self, draw: &mut Draw, share: f64) -> Point<F> {
        each_axis(|axis| self.between(draw, axis, share))
    }

    fn corner(&self, draw: &mut Draw) -> Point<F> {
        each_axis(|axis| self.plane(draw, axis).at)
    }

    /// One of the two planes of an axis, and the direction from there into the box.
    fn plane(&self, draw: &mut Draw, axis: usize) -> Plane<F> {
        if draw.coin() {
            return Plane {
                at: self.min[axis],
                inward: F::one(),
            };
        }
        Plane {
            at: self.max[axis],
            inward: -F::one(),
        }
    }

    /// The ray from a point to another, with a direction of some length.
    fn seen(&self, draw: &mut Draw, ray: Sight<F>) -> BoxCase<F> {
        let Sight { origin, target } = ray;
        let length = number::<F>(0.25 + 3.75 * draw.unit());
        let direction = each_axis(|i| (target[i] - origin[i]) * length);
        self.with(origin, direction)
    }

    fn with(&self, origin: Point<F>, direction: Point<F>) -> BoxCase<F> {
        let bounds = [self.min, self.max];
        BoxCase::new(origin, direction, bounds)
    }
}

struct Plane<F> {
    at: F,
    inward: F,
}

/// The two points of a ray.
struct Sight<F> {
    origin: Point<F>,
    target: Point<F>,
}

impl<F: Float> Sight<F> {
    /// From a point in [-4, 4] that is at least 1/16 away from a target on every axis.
    fn at(draw: &mut Draw, target: Point<F>) -> Sight<F> {
        loop {
            let origin = times(draw.point(), 4.0);
            if is_away(origin, target) {
                return Sight { origin, target };
            }
        }
    }
}

fn number<F: Float>(x: f64) -> F {
    F::from_f64(x)
}

fn times<F: Float>(point: Point<F>, factor: f64) -> Point<F> {
    let factor = number::<F>(factor);
    point.map(|x| x * factor)
}

fn is_away<F: Float>(a: Point<F>, b: Point<F>) -> bool {
    let least = number::<F>(0.0625);
    let distances = each_axis(|i| (a[i] - b[i]).abs());
    distances.iter().all(|distance| least < *distance)
}

pub fn interior<F: Float>(draw: &mut Draw) -> BoxCase<F> {
    let room = Room::drawn(draw);
    let target = room.inside(draw, 0.125);
    let ray = Sight::at(draw, target);
    room.seen(draw, ray)
}

pub fn corner_near<F: Float>(draw: &mut Draw) -> BoxCase<F> {
    let room = Room::drawn(draw);
    let target = room.corner(draw);
    let ray = Sight::at(draw, target);
    room.seen(draw, ray)
}

pub fn edge_near<F: Float>(draw: &mut Draw) -> BoxCase<F> {
    let room = Room::drawn(draw);
    let mut target = room.corner(draw);
    let along = draw.below(3);
    target[along] = room.between(draw, along, 0.125);
    let ray = Sight::at(draw, target);
    room.seen(draw, ray)
}

/// Beside an edge: on one axis the line goes in where on another it goes out, and it passes outside.
pub fn outside<F: Float>(draw: &mut Draw) -> BoxCase<F> {
    let room = Room::<F>::drawn(draw);
    let mut target = room.inside(draw, 0.125);
    let mut direction = draw.point::<F>();
    let into = draw.below(3);
    let out = (into + 1 + draw.below(2)) % 3;
    for axis in [into, out] {
        let plane = room.plane(draw, axis);
        let beside = 0.0625 + draw.unit();
        target[axis] = plane.at - plane.inward * number::<F>(beside);
        let slope = 0.0625 + draw.unit();
        direction[axis] = plane.inward * number::<F>(slope);
    }
    direction[out] = -direction[out];
    let origin = each_axis(|i| target[i] - direction[i]);
    room.with(origin, direction)
}

/// Aimed at the middle from up to 2^11 away.
pub fn far<F: Float>(draw: &mut Draw) -> BoxCase<F> {
    let room = Room::drawn(draw);
    let target = room.inside(draw, 0.375);
    let mut ray = Sight::at(draw, target);
    let power = draw.integer(4, 9) as i32;
    ray.origin = times(ray.origin, scale_by_power_of_two(1.0, power));
    room.seen(draw, ray)
}

/// So large that differences of coordinates overflow.
pub fn huge<F: Float>(draw: &mut Draw) -> BoxCase<F> {
    let room = Room::<F>::drawn(draw);
    let target = room.inside(draw, 0.125);
    let mut ray = Sight::at(draw, target);
    ray.origin = times(ray.origin, 0.25);
    let case = room.seen(draw, ray);
    let power = F::MAX_EXPONENT - draw.integer(0, 2) as i32;
    let large = |x: F| number(scale_by_power_of_two(x.to_f64(), power));
    let [origin, direction, min, max] = case.vectors();
    let bounds = [min.map(large), max.map(large)];
    BoxCase::new(origin.map(large), direction, bounds)
}
