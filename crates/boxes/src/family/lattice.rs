//! Families on small integers times powers of two: what their names say is exactly so.

use crate::case::{BoxCase, each_axis};
use hairline_core::Float;
use hairline_core::arith::scale_by_power_of_two;
use hairline_core::case::Draw;
use std::mem;

type Integers = [i64; 3];

/// A ray and a box in integers.
pub struct Lattice {
    origin: Integers,
    direction: Integers,
    block: Block,
    interval: Interval,
}

/// The interval of the ray.
enum Interval {
    Whole,
    Until(i64),
    From(i64),
}

/// The powers of two that integers are multiplied by.
struct Powers {
    positions: i32,
    directions: i32,
}

impl Lattice {
    /// Through a point of the box, which it meets at a whole t.
    fn through(point: Integers, direction: Integers, block: Block, t: i64) -> Lattice {
        let origin = each_axis(|i| point[i] - t * direction[i]);
        Lattice {
            origin,
            direction,
            block,
            interval: Interval::Whole,
        }
    }

    /// In a scalar, positions times one power of two and the direction times another.
    pub fn placed<F: Float>(&self, draw: &mut Draw) -> BoxCase<F> {
        let positions = draw.integer(-20, 20) as i32;
        let directions = draw.integer(-20, 20) as i32;
        let powers = Powers {
            positions,
            directions,
        };
        self.scaled(draw, &powers)
    }

    /// In a scalar, so small that positions are subnormal numbers, and often the direction too.
    pub fn denormal<F: Float>(&self, draw: &mut Draw) -> BoxCase<F> {
        let least = F::MIN_EXPONENT;
        let positions = least + draw.integer(0, 12) as i32;
        let directions = draw.pick(&[least, least + 12, 0]);
        let powers = Powers {
            positions,
            directions,
        };
        self.scaled(draw, &powers)
    }

    /// Zeros of the direction get either sign.
    fn scaled<F: Float>(&self, draw: &mut Draw, powers: &Powers) -> BoxCase<F> {
        let position = |x: i64| scaled(x, powers.positions);
        let mut direction = self.direction.map(|x| scaled::<F>(x, powers.directions));
        for x in &mut direction {
            let is_turned = x.is_zero() && draw.coin();
            *x = if is_turned { -F::zero() } else { *x };
        }
        let origin = self.origin.map(position);
        let min = self.block.min.map(position);
        let max = self.block.max.map(position);
        let case = BoxCase::new(origin, direction, [min, max]);
        let time = |t: i64| scaled(t, powers.positions - powers.directions);
        match self.interval {
            Interval::Whole => case,
            Interval::Until(t) => case.on(F::zero(), time(t)),
            Interval::From(t) => case.on(time(t), F::infinity()),
        }
    }
}

fn scaled<F: Float>(x: i64, power: i32) -> F {
    F::from_f64(scale_by_power_of_two(x as f64, power))
}

/// A box in integers.
#[derive(Clone, Copy)]
struct Block {
    min: Integers,
    max: Integers,
}

impl Block {
    /// At least two units long on each axis.
    fn drawn(draw: &mut Draw) -> Block {
        let min = draw.lattice_point(100);
        let max = min.map(|x| x + draw.integer(2, 64));
        Block { min, max }
    }

    /// A point in the interior.
    fn inside(&self, draw: &mut Draw) -> Integers {
        each_axis(|i| draw.integer(self.min[i] + 1, self.max[i] - 1))
    }

    /// One of the two planes of an axis, and the direction from there into the box.
    fn plane(&self, draw: &mut Draw, axis: usize) -> Plane {
        if draw.coin() {
            return Plane {
                at: self.min[axis],
                inward: 1,
            };
        }
        Plane {
            at: self.max[axis],
            inward: -1,
        }
    }
}

struct Plane {
    at: i64,
    inward: i64,
}

impl Plane {
    /// Makes a component of a direction point into the box.
    fn turn_inward(&self, component: &mut i64) {
        *component = self.inward * component.abs();
    }

    fn turn_outward(&self, component: &mut i64) {
        *component = -self.inward * component.abs();
    }
}

/// A direction without a zero.
fn any_direction(draw: &mut Draw) -> Integers {
    each_axis(|_| {
        let size = draw.integer(1, 9);
        if draw.coin() { size } else { -size }
    })
}

/// The t of a point ahead.
fn ahead(draw: &mut Draw) -> i64 {
    draw.integer(1, 40)
}

pub fn corner(draw: &mut Draw) -> Lattice {
    let block = Block::drawn(draw);
    let planes = each_axis(|axis| block.plane(draw, axis));
    let mut direction = any_direction(draw);
    // One axis goes in where another goes out, so no point but the corner is in the box.
    let out = draw.below(3);
    let into = (out + 1 + draw.below(2)) % 3;
    planes[into].turn_inward(&mut direction[into]);
    planes[out].turn_outward(&mut direction[out]);
    let t = ahead(draw);
    Lattice::through(planes.map(|plane| plane.at), direction, block, t)
}

pub fn edge(draw: &mut Draw) -> Lattice {
    let block = Block::drawn(draw);
    let mut point = block.inside(draw);
    let mut direction = any_direction(draw);
    let along = draw.below(3);
    if draw.coin() {
        direction[along] = 0;
    }
    let into = (along + 1) % 3;
    let out = (along + 2) % 3;
    let first = block.plane(draw, into);
    let second = block.plane(draw, out);
    point[into] = first.at;
    point[out] = second.at;
    first.turn_inward(&mut direction[into]);
    second.turn_outward(&mut direction[out]);
    let t = ahead(draw);
    Lattice::through(point, direction, block, t)
}

pub fn in_face(draw: &mut Draw) -> Lattice {
    let block = Block::drawn(draw);
    let mut point = block.inside(draw);
    let mut direction = any_direction(draw);
    let axis = draw.below(3);
    let planes = 1 + draw.below(2);
    for axis in [axis, (axis + 1) % 3].into_iter().take(planes) {
        point[axis] = block.plane(draw, axis).at;
        direction[axis] = 0;
    }
    let t = ahead(draw);
    Lattice::through(point, direction, block, t)
}

/// Two neighbours that share a wall, and a ray that meets both at one t: it runs in the wall, or goes through an edge of it
/// into one of them.
pub fn neighbour(draw: &mut Draw, is_second: bool) -> Lattice {
    let mut block = Block::drawn(draw);
    let mut point = block.inside(draw);
    let mut direction = any_direction(draw);
    let axis = draw.below(3);
    let wall = point[axis];
    if draw.coin() {
        direction[axis] = 0;
    } else {
        let side = (axis + 1) % 3;
        let plane = block.plane(draw, side);
        point[side] = plane.at;
        plane.turn_inward(&mut direction[side]);
    }
    let t = ahead(draw);
    if is_second {
        block.min[axis] = wall;
    } else {
        block.max[axis] = wall;
    }
    Lattice::through(point, direction, block, t)
}

/// A direction with one or two zeros.
fn axis_direction(draw: &mut Draw) -> Integers {
    let mut direction = any_direction(draw);
    let axis = draw.below(3);
    direction[axis] = 0;
    if draw.coin() {
        direction[(axis + 1) % 3] = 0;
    }
    direction
}

/// A direction with or without zeros.
fn some_direction(draw: &mut Draw) -> Integers {
    if draw.coin() {
        return any_direction(draw);
    }
    axis_direction(draw)
}

pub fn axis_inside(draw: &mut Draw) -> Lattice {
    let block = Block::drawn(draw);
    let point = block.inside(draw);
    let direction = axis_direction(draw);
    let t = ahead(draw);
    Lattice::through(point, direction, block, t)
}

pub fn axis_outside(draw: &mut Draw) -> Lattice {
    let block = Block::drawn(draw);
    let mut point = block.inside(draw);
    let mut direction = axis_direction(draw);
    let axis = draw.below(3);
    let plane = block.plane(draw, axis);
    direction[axis] = 0;
    if direction == [0; 3] {
        direction[(axis + 1) % 3] = 1;
    }
    point[axis] = plane.at - plane.inward * draw.integer(1, 9);
    let t = ahead(draw);
    Lattice::through(point, direction, block, t)
}

pub fn origin_inside(draw: &mut Draw) -> Lattice {
    let block = Block::drawn(draw);
    let point = block.inside(draw);
    let direction = some_direction(draw);
    Lattice::through(point, direction, block, 0)
}

pub fn origin_on(draw: &mut Draw) -> Lattice {
    let block = Block::drawn(draw);
    let mut point = block.inside(draw);
    let planes = 1 + draw.below(3);
    for (axis, x) in point.iter_mut().enumerate().take(planes) {
        *x = block.plane(draw, axis).at;
    }
    let direction = some_direction(draw);
    Lattice::through(point, direction, block, 0)
}

pub fn touch_at_zero(draw: &mut Draw) -> Lattice {
    let block = Block::drawn(draw);
    let mut point = block.inside(draw);
    let mut direction = any_direction(draw);
    let axis = draw.below(3);
    let plane = block.plane(draw, axis);
    point[axis] = plane.at;
    plane.turn_outward(&mut direction[axis]);
    Lattice::through(point, direction, block, 0)
}

pub fn interval_ends(draw: &mut Draw) -> Lattice {
    let block = Block::drawn(draw);
    let mut point = block.inside(draw);
    let mut direction = any_direction(draw);
    let axis = draw.below(3);
    let plane = block.plane(draw, axis);
    point[axis] = plane.at;
    let enters = draw.coin();
    let t = ahead(draw);
    let interval = if enters {
        plane.turn_inward(&mut direction[axis]);
        Interval::Until(t)
    } else {
        plane.turn_outward(&mut direction[axis]);
        Interval::From(t)
    };
    Lattice {
        interval,
        ..Lattice::through(point, direction, block, t)
    }
}

pub fn behind(draw: &mut Draw) -> Lattice {
    let block = Block::drawn(draw);
    let point = block.inside(draw);
    let direction = any_direction(draw);
    // No axis is longer than this, and the ray leaves it by at least a unit for each t.
    let beyond = -64 - draw.integer(1, 40);
    Lattice::through(point, direction, block, beyond)
}

pub fn flat(draw: &mut Draw) -> Lattice {
    let mut block = Block::drawn(draw);
    let point = block.inside(draw);
    let axis = draw.below(3);
    block.min[axis] = point[axis];
    block.max[axis] = point[axis];
    let mut direction = any_direction(draw);
    if draw.coin() {
        direction[(axis + 1) % 3] = 0;
    }
    let t = ahead(draw);
    Lattice::through(point, direction, block, t)
}

pub fn point(draw: &mut Draw) -> Lattice {
    let point = draw.lattice_point(100);
    let block = Block {
        min: point,
        max: point,
    };
    let direction = some_direction(draw);
    let t = ahead(draw);
    Lattice::through(point, direction, block, t)
}

pub fn empty(draw: &mut Draw) -> Lattice {
    let mut block = Block::drawn(draw);
    let point = block.inside(draw);
    let turned = 1 + draw.below(3);
    let axes = block.min.iter_mut().zip(&mut block.max);
    for (min, max) in axes.take(turned) {
        mem::swap(min, max);
    }
    let direction = any_direction(draw);
    let t = ahead(draw);
    Lattice::through(point, direction, block, t)
}

/// Through the interior, an edge or a corner.
pub fn meeting(draw: &mut Draw) -> Lattice {
    match draw.below(3) {
        0 => corner(draw),
        1 => edge(draw),
        _ => interior(draw),
    }
}

fn interior(draw: &mut Draw) -> Lattice {
    let block = Block::drawn(draw);
    let point = block.inside(draw);
    let direction = any_direction(draw);
    let t = ahead(draw);
    Lattice::through(point, direction, block, t)
}
