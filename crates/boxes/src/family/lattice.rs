//! Families on small integers times powers of two: what their names say is exactly so.

use crate::case::BoxCase;
use hairline_core::Float;
use hairline_core::arith::scale_by_power_of_two;
use hairline_core::case::Draw;

type Integers = [i64; 3];

/// A ray and a box in integers.
struct Lattice {
    origin: Integers,
    direction: Integers,
    min: Integers,
    max: Integers,
}

impl Lattice {
    /// Through a point of the box, which it meets at a whole t.
    fn through(point: Integers, direction: Integers, block: Block, t: i64) -> Lattice {
        Lattice {
            origin: [0, 1, 2].map(|i| point[i] - t * direction[i]),
            direction,
            min: block.min,
            max: block.max,
        }
    }

    /// In a scalar, positions times one power of two and the direction times another. Zeros of the direction get either
    /// sign.
    fn placed<F: Float>(&self, draw: &mut Draw) -> BoxCase<F> {
        let positions = draw.integer(-20, 20) as i32;
        let directions = draw.integer(-20, 20) as i32;
        self.scaled(draw, positions, directions)
    }

    fn scaled<F: Float>(&self, draw: &mut Draw, positions: i32, directions: i32) -> BoxCase<F> {
        let number = |x: i64, power: i32| F::from_f64(scale_by_power_of_two(x as f64, power));
        let point = |point: Integers| point.map(|x| number(x, positions));
        let direction = self.direction.map(|x| match x {
            0 if draw.coin() => -F::zero(),
            _ => number(x, directions),
        });
        BoxCase::new(
            point(self.origin),
            direction,
            [point(self.min), point(self.max)],
        )
    }
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
        [0, 1, 2].map(|i| draw.integer(self.min[i] + 1, self.max[i] - 1))
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

/// A direction without a zero.
fn any_direction(draw: &mut Draw) -> Integers {
    [(); 3].map(|()| sign(draw) * draw.integer(1, 9))
}

fn sign(draw: &mut Draw) -> i64 {
    if draw.coin() { 1 } else { -1 }
}

/// The t of a point ahead.
fn ahead(draw: &mut Draw) -> i64 {
    draw.integer(1, 40)
}

pub(super) fn corner<F: Float>(draw: &mut Draw) -> BoxCase<F> {
    touching_a_corner(draw).placed(draw)
}

fn touching_a_corner(draw: &mut Draw) -> Lattice {
    let block = Block::drawn(draw);
    let planes = [0, 1, 2].map(|axis| block.plane(draw, axis));
    let mut direction = any_direction(draw);
    // One axis goes in where another goes out, so no point but the corner is in the box.
    let out = draw.below(3);
    let into = (out + 1 + draw.below(2)) % 3;
    direction[into] = planes[into].inward * direction[into].abs();
    direction[out] = -planes[out].inward * direction[out].abs();
    let t = ahead(draw);
    Lattice::through(planes.map(|plane| plane.at), direction, block, t)
}

pub(super) fn edge<F: Float>(draw: &mut Draw) -> BoxCase<F> {
    touching_an_edge(draw).placed(draw)
}

fn touching_an_edge(draw: &mut Draw) -> Lattice {
    let block = Block::drawn(draw);
    let mut point = block.inside(draw);
    let mut direction = any_direction(draw);
    let along = draw.below(3);
    if draw.coin() {
        direction[along] = 0;
    }
    let [into, out] = [(along + 1) % 3, (along + 2) % 3];
    let [first, second] = [into, out].map(|axis| block.plane(draw, axis));
    point[into] = first.at;
    point[out] = second.at;
    direction[into] = first.inward * direction[into].abs();
    direction[out] = -second.inward * direction[out].abs();
    let t = ahead(draw);
    Lattice::through(point, direction, block, t)
}

pub(super) fn in_face<F: Float>(draw: &mut Draw) -> BoxCase<F> {
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
    Lattice::through(point, direction, block, t).placed(draw)
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

pub(super) fn axis_inside<F: Float>(draw: &mut Draw) -> BoxCase<F> {
    let block = Block::drawn(draw);
    let point = block.inside(draw);
    let direction = axis_direction(draw);
    let t = ahead(draw);
    Lattice::through(point, direction, block, t).placed(draw)
}

pub(super) fn axis_outside<F: Float>(draw: &mut Draw) -> BoxCase<F> {
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
    Lattice::through(point, direction, block, t).placed(draw)
}

pub(super) fn origin_inside<F: Float>(draw: &mut Draw) -> BoxCase<F> {
    let block = Block::drawn(draw);
    let point = block.inside(draw);
    let direction = if draw.coin() {
        any_direction(draw)
    } else {
        axis_direction(draw)
    };
    Lattice::through(point, direction, block, 0).placed(draw)
}

pub(super) fn origin_on<F: Float>(draw: &mut Draw) -> BoxCase<F> {
    let block = Block::drawn(draw);
    let mut point = block.inside(draw);
    for axis in 0..=draw.below(3) {
        point[axis] = block.plane(draw, axis).at;
    }
    let direction = if draw.coin() {
        any_direction(draw)
    } else {
        axis_direction(draw)
    };
    Lattice::through(point, direction, block, 0).placed(draw)
}

pub(super) fn touch_at_zero<F: Float>(draw: &mut Draw) -> BoxCase<F> {
    let block = Block::drawn(draw);
    let mut point = block.inside(draw);
    let mut direction = any_direction(draw);
    let axis = draw.below(3);
    let plane = block.plane(draw, axis);
    point[axis] = plane.at;
    direction[axis] = -plane.inward * direction[axis].abs();
    Lattice::through(point, direction, block, 0).placed(draw)
}

pub(super) fn interval_ends<F: Float>(draw: &mut Draw) -> BoxCase<F> {
    let block = Block::drawn(draw);
    let mut point = block.inside(draw);
    let mut direction = any_direction(draw);
    let axis = draw.below(3);
    let plane = block.plane(draw, axis);
    point[axis] = plane.at;
    let enters = draw.coin();
    let inward = if enters { plane.inward } else { -plane.inward };
    direction[axis] = inward * direction[axis].abs();
    let t = ahead(draw);
    let positions = draw.integer(-20, 20) as i32;
    let directions = draw.integer(-20, 20) as i32;
    let end = F::from_f64(scale_by_power_of_two(t as f64, positions - directions));
    let case = Lattice::through(point, direction, block, t);
    let case = case.scaled::<F>(draw, positions, directions);
    if enters {
        case.on(F::zero(), end)
    } else {
        case.on(end, F::infinity())
    }
}

pub(super) fn behind<F: Float>(draw: &mut Draw) -> BoxCase<F> {
    let block = Block::drawn(draw);
    let point = block.inside(draw);
    let direction = any_direction(draw);
    // No axis is longer than this, and the ray leaves it by at least a unit for each t.
    let beyond = -64 - draw.integer(1, 40);
    Lattice::through(point, direction, block, beyond).placed(draw)
}

pub(super) fn flat<F: Float>(draw: &mut Draw) -> BoxCase<F> {
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
    Lattice::through(point, direction, block, t).placed(draw)
}

pub(super) fn point<F: Float>(draw: &mut Draw) -> BoxCase<F> {
    let point = draw.lattice_point(100);
    let block = Block {
        min: point,
        max: point,
    };
    let direction = if draw.coin() {
        any_direction(draw)
    } else {
        axis_direction(draw)
    };
    let t = ahead(draw);
    Lattice::through(point, direction, block, t).placed(draw)
}

pub(super) fn empty<F: Float>(draw: &mut Draw) -> BoxCase<F> {
    let mut block = Block::drawn(draw);
    let point = block.inside(draw);
    for axis in 0..=draw.below(3) {
        let (min, max) = (block.min[axis], block.max[axis]);
        block.min[axis] = max;
        block.max[axis] = min;
    }
    let direction = any_direction(draw);
    let t = ahead(draw);
    Lattice::through(point, direction, block, t).placed(draw)
}

pub(super) fn denormal<F: Float>(draw: &mut Draw) -> BoxCase<F> {
    let lattice = match draw.below(3) {
        0 => touching_a_corner(draw),
        1 => touching_an_edge(draw),
        _ => {
            let block = Block::drawn(draw);
            let point = block.inside(draw);
            let direction = any_direction(draw);
            let t = ahead(draw);
            Lattice::through(point, direction, block, t)
        }
    };
    let positions = F::MIN_EXPONENT + draw.integer(0, 12) as i32;
    let directions = draw.pick(&[F::MIN_EXPONENT, F::MIN_EXPONENT + 12, 0]);
    lattice.scaled(draw, positions, directions)
}
