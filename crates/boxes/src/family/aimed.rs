//! Families in full floats: rays aimed at a point of a box, rounded.

use crate::case::BoxCase;
use hairline_core::Float;
use hairline_core::arith::scale_by_power_of_two;
use hairline_core::case::Draw;

/// A box whose sides are at least 1/16 long, in [-1, 1].
struct Room<F> {
    min: [F; 3],
    max: [F; 3],
}

impl<F: Float> Room<F> {
    fn drawn(draw: &mut Draw) -> Room<F> {
        let least = F::from_f64(0.0625);
        loop {
            let [a, b] = [draw.point::<F>(), draw.point::<F>()];
            let min = [0, 1, 2].map(|i| if b[i] < a[i] { b[i] } else { a[i] });
            let max = [0, 1, 2].map(|i| if b[i] < a[i] { a[i] } else { b[i] });
            if (0..3).all(|i| least < max[i] - min[i]) {
                return Room { min, max };
            }
        }
    }

    /// A point between the planes of an axis, away from both by this share of the side at least.
    fn between(&self, draw: &mut Draw, axis: usize, share: f64) -> F {
        let weight = F::from_f64(share + (1.0 - 2.0 * share) * draw.unit());
        self.min[axis] + (self.max[axis] - self.min[axis]) * weight
    }

    fn inside(&self, draw: &mut Draw, share: f64) -> [F; 3] {
        [0, 1, 2].map(|axis| self.between(draw, axis, share))
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

    /// A ray from a point, aimed at another.
    fn seen(&self, draw: &mut Draw, origin: [F; 3], target: [F; 3]) -> BoxCase<F> {
        let length = F::from_f64(0.25 + 3.75 * draw.unit());
        let direction = [0, 1, 2].map(|i| (target[i] - origin[i]) * length);
        BoxCase::new(origin, direction, [self.min, self.max])
    }
}

struct Plane<F> {
    at: F,
    inward: F,
}

/// A point in [-4, 4] that is at least 1/16 away from a target on every axis.
fn away<F: Float>(draw: &mut Draw, target: [F; 3]) -> [F; 3] {
    let least = F::from_f64(0.0625);
    loop {
        let origin = draw.point::<F>().map(|x| x * F::from_f64(4.0));
        if (0..3).all(|i| least < (origin[i] - target[i]).abs()) {
            return origin;
        }
    }
}

pub(super) fn interior<F: Float>(draw: &mut Draw) -> BoxCase<F> {
    let room = Room::<F>::drawn(draw);
    let target = room.inside(draw, 0.125);
    let origin = away(draw, target);
    room.seen(draw, origin, target)
}

pub(super) fn corner_near<F: Float>(draw: &mut Draw) -> BoxCase<F> {
    let room = Room::<F>::drawn(draw);
    let target = [0, 1, 2].map(|axis| room.plane(draw, axis).at);
    let origin = away(draw, target);
    room.seen(draw, origin, target)
}

pub(super) fn edge_near<F: Float>(draw: &mut Draw) -> BoxCase<F> {
    let room = Room::<F>::drawn(draw);
    let mut target = [0, 1, 2].map(|axis| room.plane(draw, axis).at);
    let along = draw.below(3);
    target[along] = room.between(draw, along, 0.125);
    let origin = away(draw, target);
    room.seen(draw, origin, target)
}

/// Beside an edge: on one axis the line goes in where on another it goes out, and it passes outside.
pub(super) fn outside<F: Float>(draw: &mut Draw) -> BoxCase<F> {
    let room = Room::<F>::drawn(draw);
    let mut target = room.inside(draw, 0.125);
    let into = draw.below(3);
    let out = (into + 1 + draw.below(2)) % 3;
    let [first, second] = [into, out].map(|axis| room.plane(draw, axis));
    for (axis, plane) in [(into, &first), (out, &second)] {
        let beside = F::from_f64(0.0625 + draw.unit());
        target[axis] = plane.at - plane.inward * beside;
    }
    let mut direction = draw.point::<F>();
    let slope = |draw: &mut Draw| F::from_f64(0.0625 + draw.unit());
    direction[into] = first.inward * slope(draw);
    direction[out] = -second.inward * slope(draw);
    let origin = [0, 1, 2].map(|i| target[i] - direction[i]);
    BoxCase::new(origin, direction, [room.min, room.max])
}

/// Aimed at the middle from up to 2^16 times as far as the box is large.
pub(super) fn far<F: Float>(draw: &mut Draw) -> BoxCase<F> {
    let room = Room::<F>::drawn(draw);
    let target = room.inside(draw, 0.375);
    let distance = F::from_f64(scale_by_power_of_two(1.0, draw.integer(4, 9) as i32));
    let origin = away(draw, target).map(|x| x * distance);
    room.seen(draw, origin, target)
}

/// So large that differences of coordinates overflow.
pub(super) fn huge<F: Float>(draw: &mut Draw) -> BoxCase<F> {
    let room = Room::<F>::drawn(draw);
    let target = room.inside(draw, 0.125);
    let origin = away(draw, target).map(|x| x * F::from_f64(0.25));
    let case = room.seen(draw, origin, target);
    let power = F::MAX_EXPONENT - draw.integer(0, 2) as i32;
    let large = |x: F| F::from_f64(scale_by_power_of_two(x.to_f64(), power));
    let [origin, direction, min, max] = case.vectors();
    let [origin, min, max] = [origin, min, max].map(|point| point.map(large));
    BoxCase::new(origin, direction, [min, max])
}
