//! Families in full floats: rays aimed at a point of a box, rounded.

use crate::case::{BoxCase, each_axis};
use hairline_core::Float;
use hairline_core::arith::scale_by_power_of_two;
use hairline_core::case::Draw;

type Point<F> = [F; 3];

/// A box in [-1, 1] whose sides are more than 1/16 long.
struct Room<F> {
    min: Point<F>,
    max: Point<F>,
}

impl<F: Float> Room<F> {
    fn drawn(draw: &mut Draw) -> Room<F> {
        loop {
            let a = draw.point::<F>();
            let b = draw.point::<F>();
            if is_away(a, b) {
                return Room {
                    min: each_axis(|axis| a[axis].smaller(b[axis])),
                    max: each_axis(|axis| a[axis].larger(b[axis])),
                };
            }
        }
    }

    /// A point between the planes of an axis, away from both by this share of the side at least.
    fn between(&self, draw: &mut Draw, axis: usize, share: f64) -> F {
        let side = self.max[axis] - self.min[axis];
        let free = 1.0 - 2.0 * share;
        let weight = share + free * draw.unit();
        self.min[axis] + side * F::from_f64(weight)
    }

    /// A point inside, away from all planes by this share of the sides at least.
    fn inside(&self, draw: &mut Draw, share: f64) -> Point<F> {
        each_axis(|axis| self.between(draw, axis, share))
    }

    fn corner(&self, draw: &mut Draw) -> Point<F> {
        each_axis(|axis| self.plane(draw, axis).at)
    }

    /// One of the two planes of an axis.
    fn plane(&self, draw: &mut Draw, axis: usize) -> Plane<F> {
        if draw.coin() {
            Plane {
                at: self.min[axis],
                inward: F::one(),
            }
        } else {
            Plane {
                at: self.max[axis],
                inward: -F::one(),
            }
        }
    }

    /// The ray along a sight, with a direction of some length.
    fn seen(&self, draw: &mut Draw, Sight { origin, target }: Sight<F>) -> BoxCase<F> {
        let length = F::from_f64(0.25 + 3.75 * draw.unit());
        let direction = each_axis(|axis| (target[axis] - origin[axis]) * length);
        self.with(origin, direction)
    }

    fn with(&self, origin: Point<F>, direction: Point<F>) -> BoxCase<F> {
        BoxCase::new(origin, direction, [self.min, self.max])
    }
}

struct Plane<F> {
    /// Its coordinate on its axis.
    at: F,
    /// The direction from there into the box: 1 or -1.
    inward: F,
}

/// The two points of a ray.
struct Sight<F> {
    origin: Point<F>,
    target: Point<F>,
}

impl<F: Float> Sight<F> {
    /// The sight of a target from a point in [-4, 4] that is more than 1/16 away on every axis.
    fn at(draw: &mut Draw, target: Point<F>) -> Sight<F> {
        loop {
            let origin = times(draw.point(), 4.0);
            if is_away(origin, target) {
                return Sight { origin, target };
            }
        }
    }
}

fn times<F: Float>(point: Point<F>, factor: f64) -> Point<F> {
    let factor = F::from_f64(factor);
    point.map(|x| x * factor)
}

/// True if two points are more than 1/16 apart on every axis.
fn is_away<F: Float>(a: Point<F>, b: Point<F>) -> bool {
    let least = F::from_f64(0.0625);
    (0..3).all(|axis| least < (a[axis] - b[axis]).abs())
}

/// A ray at a point well inside.
pub fn interior<F: Float>(draw: &mut Draw) -> BoxCase<F> {
    let room = Room::drawn(draw);
    let target = room.inside(draw, 0.125);
    let ray = Sight::at(draw, target);
    room.seen(draw, ray)
}

/// A ray at a corner, as near as rounding leaves it.
pub fn corner_near<F: Float>(draw: &mut Draw) -> BoxCase<F> {
    let room = Room::drawn(draw);
    let target = room.corner(draw);
    let ray = Sight::at(draw, target);
    room.seen(draw, ray)
}

/// A ray at a point of an edge, as near as rounding leaves it.
pub fn edge_near<F: Float>(draw: &mut Draw) -> BoxCase<F> {
    let room = Room::drawn(draw);
    let mut target = room.corner(draw);
    let along = draw.below(3);
    target[along] = room.between(draw, along, 0.125);
    let ray = Sight::at(draw, target);
    room.seen(draw, ray)
}

/// A line that passes outside an edge: on one axis it goes in where on another it goes out.
pub fn outside<F: Float>(draw: &mut Draw) -> BoxCase<F> {
    let room = Room::<F>::drawn(draw);
    let mut target = room.inside(draw, 0.125);
    let mut direction = draw.point::<F>();
    let into = draw.below(3);
    let out = (into + 1 + draw.below(2)) % 3;
    for axis in [into, out] {
        let plane = room.plane(draw, axis);
        let beside = 0.0625 + draw.unit();
        target[axis] = plane.at - plane.inward * F::from_f64(beside);
        let slope = 0.0625 + draw.unit();
        direction[axis] = plane.inward * F::from_f64(slope);
    }
    direction[out] = -direction[out];
    let origin = each_axis(|axis| target[axis] - direction[axis]);
    room.with(origin, direction)
}

/// A ray at the middle from up to 2^11 away.
pub fn far<F: Float>(draw: &mut Draw) -> BoxCase<F> {
    let room = Room::drawn(draw);
    let target = room.inside(draw, 0.375);
    let mut ray = Sight::at(draw, target);
    let power = draw.integer(4, 9) as i32;
    ray.origin = times(ray.origin, scale_by_power_of_two(1.0, power));
    room.seen(draw, ray)
}

/// A box and an origin so large that differences of coordinates overflow.
pub fn huge<F: Float>(draw: &mut Draw) -> BoxCase<F> {
    let room = Room::<F>::drawn(draw);
    let target = room.inside(draw, 0.125);
    let mut ray = Sight::at(draw, target);
    ray.origin = times(ray.origin, 0.25);
    let case = room.seen(draw, ray);
    let power = F::MAX_EXPONENT - draw.integer(0, 2) as i32;
    let enlarged = |x: F| F::from_f64(scale_by_power_of_two(x.to_f64(), power));
    let [origin, direction, min, max] = case.vectors();
    let bounds = [min.map(enlarged), max.map(enlarged)];
    BoxCase::new(origin.map(enlarged), direction, bounds)
}
