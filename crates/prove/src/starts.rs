//! The inputs at which a search for witnesses begins.

use super::bound::Lemma;
use super::witness::{Goal, Inputs, Search, Searched};
use super::{Leaf, Measures, VariableOrigin};
use crate::arith::Float;
use crate::case::Draw;
use glam::DVec3;

impl<F: Searched> Search<'_, F> {
    /// Inputs in the boxes, often near the corner of the bound.
    pub(super) fn start(&self, goal: Goal, draw: &mut Draw) -> Inputs<F> {
        let measures = self.domain.measures;
        if let Some(measures) = measures
            && goal != Goal::Zero
            && draw.coin()
        {
            return self.aimed(measures, draw);
        }
        if self.judge.is_some() && measures.is_none() {
            return self.aimed_in_a_box(draw);
        }
        let mut inputs = self.in_the_boxes(draw);
        if goal == Goal::Zero {
            make_parallel(&mut inputs, draw);
        }
        inputs
    }

    /// A ray that meets a triangle of a scene, from far away. Often the triangle is as small and flat, and the ray at as
    /// small an angle, as the scene has them: there numbers are divided by the least determinants.
    fn aimed(&self, measures: Measures, draw: &mut Draw) -> Inputs<F> {
        let scene = measures.scene;
        let near = vector(draw, |draw| near_either_end(scene.coordinates, draw));
        let a = near * power_of_half(4, draw);
        // Unit vectors along the first edge, across it in the triangle's plane, and along the normal.
        let along = anywhere(draw).normalize_or_zero();
        let other = anywhere(draw);
        let normal = along.cross(other).normalize_or_zero();
        let across = normal.cross(along);
        let longest = measures.longest.to_f64();
        let size = slightly_less(longest.min(scene.edge[1]), 8, draw);
        let least_angle = scene.min_angle.to_radians();
        let at_a = cotangent_of_angle(least_angle, draw);
        let at_b = cotangent_of_angle(least_angle, draw);
        // The second edge ends above the foot of the height.
        let height = size / (at_a + at_b);
        let e1 = size * along;
        let foot = height * at_a * along;
        let e2 = foot + height * across;
        let sine = if draw.below(4) == 0 {
            draw.unit()
        } else {
            slightly_more(measures.sine.to_f64(), draw).min(1.0)
        };
        let ahead = along * symmetric(draw);
        let aside = across * symmetric(draw);
        let in_plane = (ahead + aside).normalize_or_zero();
        let cosine = (1.0 - sine * sine).sqrt();
        let direction = in_plane * cosine + normal * sine;
        let u = draw.unit();
        let v = draw.unit();
        let target = a + e1 * (u * (1.0 - v)) + e2 * v;
        let farthest = (scene.distance / 2.0).max(scene.distance - size);
        let distance = near_either_end(farthest, draw).abs();
        let origin = target - direction * distance;
        self.inputs_of([origin, direction, a, a + e1, a + e2])
    }

    /// A ray that meets an edge of a triangle, both in one box as large as all sizes of the domain allow, and often near its
    /// sides: there |N·d| is large.
    fn aimed_in_a_box(&self, draw: &mut Draw) -> Inputs<F> {
        let domain = &self.domain;
        let least = domain.edge.min(domain.reach).min(domain.world);
        let side = least.to_f64();
        let low = vector(draw, |draw| -side * draw.unit());
        let mut vertices = [DVec3::ZERO; 3];
        for vertex in &mut vertices {
            *vertex = low + side * vector(draw, near_a_side);
        }
        let most = domain.direction.to_f64();
        let direction = most * vector(draw, |draw| 2.0 * near_a_side(draw) - 1.0);
        let share = draw.unit();
        let target = vertices[0].lerp(vertices[1], share);
        // Where the ray enters the box, or a little later.
        let is_backwards = direction.cmplt(DVec3::ZERO);
        let enters = DVec3::select(is_backwards, low + side, low);
        let times = (target - enters) / direction;
        let longest = times.min_element();
        let [start, end] = domain.interval::<f64>();
        let time = slightly_less(longest.clamp(start, end), 8, draw);
        let origin = target - direction * time;
        vertices.rotate_left(draw.below(3));
        if draw.coin() {
            vertices.swap(0, 1);
        }
        let [a, b, c] = vertices;
        self.inputs_of([origin, direction, a, b, c])
    }

    fn inputs_of(&self, vectors: [DVec3; 5]) -> Inputs<F> {
        let mut inputs = [F::zero(); 17];
        let coordinates = vectors.map(|vector| vector.to_array());
        for (i, x) in coordinates.as_flattened().iter().enumerate() {
            inputs[i] = F::from_f64(*x);
        }
        inputs[15..].copy_from_slice(&self.domain.interval());
        inputs
    }

    /// Inputs anywhere in the boxes, or with the signs of the corner of the bound.
    fn in_the_boxes(&self, draw: &mut Draw) -> Inputs<F> {
        let domain = &self.domain;
        let edge = domain.edge.to_f64();
        let reach = domain.reach.to_f64();
        let world = domain.world.to_f64();
        let scale = power_of_half(30, draw);
        let is_at_corner = draw.coin();
        let lemma = self.quantity.lemmas.last();
        let corner = Corner {
            lemma: lemma.filter(|_| is_at_corner),
        };
        let mut inputs = [0.0; 17];
        for axis in 0..3 {
            let a = world * symmetric(draw) * scale;
            inputs[input(1, axis)] = a;
            for (point, bound) in [(2, edge), (3, edge), (0, reach)] {
                let x = size_within(bound, draw);
                let from_a = corner.difference(x, point, 1, axis);
                inputs[input(point, axis)] = a + from_a;
            }
            // Where only vectors from the origin count, they are drawn around it.
            let of_a = Leaf::Difference(1, 0, axis);
            let is_from_origin = corner.is_negative(of_a).is_some();
            if is_from_origin || !self.quantity.uses().edge {
                let origin = world * symmetric(draw) * scale;
                inputs[axis] = origin;
                for point in 1..=3 {
                    let x = size_within(reach, draw);
                    let difference = Leaf::Difference(point, 0, axis);
                    let from_origin = corner.signed(x, difference);
                    inputs[input(point, axis)] = origin + from_origin;
                }
            }
            let most = domain.direction.to_f64();
            let x = size_within(most, draw);
            inputs[3 + axis] = corner.signed(x, Leaf::Direction(axis));
        }
        let extent = domain.extent.to_f64();
        inputs[15] = size_within(extent, draw);
        inputs[16] = size_within(extent, draw);
        inputs.map(F::from_f64)
    }
}

/// The corner of a bound, if inputs are to have its signs.
struct Corner<'a> {
    lemma: Option<&'a Lemma>,
}

impl Corner<'_> {
    /// True if a variable is negative there; none if the bound does not have this variable.
    fn is_negative(&self, leaf: Leaf) -> Option<bool> {
        let lemma = self.lemma?;
        let wanted = VariableOrigin::Leaf(leaf);
        let mut origins = lemma.formula.origins.iter();
        let variable = origins.position(|source| *source == wanted)?;
        lemma.maximum.corner.get(variable).copied()
    }

    /// A number with the sign that a variable has there.
    fn signed(&self, x: f64, leaf: Leaf) -> f64 {
        match self.is_negative(leaf) {
            Some(true) => -x.abs(),
            Some(false) => x.abs(),
            None => x,
        }
    }

    /// A difference of two points, either of which may be subtracted in the bound.
    fn difference(&self, x: f64, point: usize, other: usize, axis: usize) -> f64 {
        let forth = Leaf::Difference(point, other, axis);
        let back = Leaf::Difference(other, point, axis);
        if self.is_negative(forth).is_some() {
            self.signed(x, forth)
        } else {
            -self.signed(-x, back)
        }
    }
}

/// The place of a coordinate of point 0, 1, 2 or 3 among the inputs: of the origin, a, b or c.
fn input(point: usize, axis: usize) -> usize {
    match point {
        0 => axis,
        _ => 3 + 3 * point + axis,
    }
}

fn vector(draw: &mut Draw, coordinate: impl Fn(&mut Draw) -> f64) -> DVec3 {
    DVec3::from([(); 3].map(|()| coordinate(draw)))
}

fn anywhere(draw: &mut Draw) -> DVec3 {
    vector(draw, symmetric)
}

/// A number between -1 and 1.
fn symmetric(draw: &mut Draw) -> f64 {
    draw.symmetric()
}

/// 2 to minus a whole number below `end`.
pub fn power_of_half(end: usize, draw: &mut Draw) -> f64 {
    let halvings = draw.below(end) as i32;
    2f64.powi(-halvings)
}

/// A number between 0 and `most`; the more often its distance to `most` is halved, the nearer.
fn slightly_less(most: f64, halvings: usize, draw: &mut Draw) -> f64 {
    let share = draw.unit() * power_of_half(halvings, draw);
    most * (1.0 - share)
}

/// A number between `least` and twice that, often near it.
fn slightly_more(least: f64, draw: &mut Draw) -> f64 {
    least * (1.0 + power_of_half(8, draw))
}

fn of_either_sign(x: f64, draw: &mut Draw) -> f64 {
    if draw.coin() { x } else { -x }
}

/// A number between -`most` and `most`, often near an end.
fn near_either_end(most: f64, draw: &mut Draw) -> f64 {
    let x = slightly_less(most, 12, draw);
    of_either_sign(x, draw)
}

/// A number between 0 and 1, often near one of the two.
fn near_a_side(draw: &mut Draw) -> f64 {
    let inside = 0.5 * draw.unit() * power_of_half(12, draw);
    if draw.coin() { inside } else { 1.0 - inside }
}

/// The cotangent of an angle of a triangle, which is often slightly more than the least.
fn cotangent_of_angle(least: f64, draw: &mut Draw) -> f64 {
    let more = (1.05 - least).max(0.0);
    let angle = if draw.below(4) == 0 {
        least + draw.unit() * more
    } else {
        slightly_more(least, draw)
    };
    1.0 / libm::tan(angle)
}

/// A number between -`bound` and `bound`, mostly near an end.
fn size_within(bound: f64, draw: &mut Draw) -> f64 {
    let share = match draw.below(3) {
        0 => draw.unit(),
        1 => 1.0 - draw.unit() * 0.01,
        _ => 1.0 - draw.unit() * 2f64.powi(-12),
    };
    of_either_sign(bound * share, draw)
}

/// Makes the direction one of the edges, so that it lies in the plane if the difference is exact.
pub fn make_parallel<F: Float>(inputs: &mut Inputs<F>, draw: &mut Draw) {
    let (from, to) = draw.pick(&[(1, 2), (1, 3), (2, 3)]);
    for axis in 0..3 {
        inputs[3 + axis] = inputs[input(to, axis)] - inputs[input(from, axis)];
    }
}
