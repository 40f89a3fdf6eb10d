//! The inputs at which a search for witnesses begins.

use super::witness::{Goal, Inputs, Search, Searched};
use super::{Dyadic, Leaf, Measures, Source};
use crate::arith::Float;
use crate::case::Draw;
use glam::DVec3;

impl<F: Searched> Search<'_, F> {
    /// A ray that meets a triangle of a scene, from far away. Often the triangle is as small and flat, and the ray at as
    /// small an angle, as the scene has them: there numbers are divided by the least determinants.
    fn aimed(&self, measures: Measures, draw: &mut Draw) -> Inputs<F> {
        let scene = measures.scene;
        let [longest, sine] = [measures.longest, measures.sine].map(Dyadic::to_f64);
        let longest = longest.min(scene.edge[1]);
        let any = |draw: &mut Draw| DVec3::from([0; 3].map(|_| draw.symmetric::<f64>()));
        let power = |draw: &mut Draw, most: usize| 2f64.powi(-(draw.below(most) as i32));
        let near_end = |draw: &mut Draw, most: f64| {
            let x = most * (1.0 - draw.unit() * power(draw, 12));
            if draw.coin() { x } else { -x }
        };
        let a = DVec3::from([0; 3].map(|_| near_end(draw, scene.coordinates))) * power(draw, 4);
        let (along, across) = (any(draw).normalize_or_zero(), any(draw));
        let normal = along.cross(across).normalize_or_zero();
        let across = normal.cross(along);
        // Slightly more than the least.
        let more = |draw: &mut Draw, least: f64| least * (1.0 + power(draw, 8));
        let size = longest * (1.0 - draw.unit() * power(draw, 8));
        // The angles at both ends of the first edge.
        let least = scene.min_angle.to_radians();
        let angle = |draw: &mut Draw| match draw.below(4) {
            0 => least + draw.unit() * (1.05 - least).max(0.0),
            _ => more(draw, least),
        };
        let [at_a, at_b] = [angle(draw), angle(draw)].map(|x| 1.0 / libm::tan(x));
        let height = size / (at_a + at_b);
        let (e1, e2) = (size * along, height * at_a * along + height * across);
        let sine = if draw.below(4) == 0 {
            draw.unit()
        } else {
            more(draw, sine).min(1.0)
        };
        let in_plane = (along * draw.symmetric::<f64>() + across * draw.symmetric::<f64>())
            .normalize_or_zero();
        let direction = in_plane * (1.0 - sine * sine).sqrt() + normal * sine;
        let (u, v) = (draw.unit(), draw.unit());
        let target = a + e1 * (u * (1.0 - v)) + e2 * v;
        let farthest = (scene.distance - size).max(scene.distance / 2.0);
        let origin = target - direction * near_end(draw, farthest).abs();
        self.inputs_of([origin, direction, a, a + e1, a + e2])
    }

    /// A ray that meets an edge of a triangle, both in one box as large as all sizes of the domain allow, and often near its
    /// sides: there |N·d| is large.
    fn aimed_in_a_box(&self, draw: &mut Draw) -> Inputs<F> {
        let side = self
            .domain
            .edge
            .min(self.domain.reach)
            .min(self.domain.world)
            .to_f64();
        let near_a_side = |draw: &mut Draw| {
            let inside = 0.5 * draw.unit() * 2f64.powi(-(draw.below(12) as i32));
            if draw.coin() { inside } else { 1.0 - inside }
        };
        let low = DVec3::from([0; 3].map(|_| -side * draw.unit()));
        let [a, b, c] = [0; 3].map(|_| low + side * DVec3::from([0; 3].map(|_| near_a_side(draw))));
        let most = self.domain.direction.to_f64();
        let direction = most * DVec3::from([0; 3].map(|_| 2.0 * near_a_side(draw) - 1.0));
        let target = a.lerp(b, draw.unit());
        // Where the ray enters the box, or a little later.
        let enters = DVec3::select(direction.cmplt(DVec3::ZERO), low + side, low);
        let longest = ((target - enters) / direction).min_element();
        let [start, end] = self.domain.interval::<f64>();
        let time =
            longest.clamp(start, end) * (1.0 - draw.unit() * 2f64.powi(-(draw.below(8) as i32)));
        let origin = target - direction * time;
        let mut vertices = [a, b, c];
        vertices.rotate_left(draw.below(3));
        if draw.coin() {
            vertices.swap(0, 1);
        }
        let [a, b, c] = vertices;
        self.inputs_of([origin, direction, a, b, c])
    }

    fn inputs_of(&self, vectors: [DVec3; 5]) -> Inputs<F> {
        let mut inputs = [F::zero(); 17];
        for (input, x) in inputs
            .iter_mut()
            .zip(vectors.map(|v| v.to_array()).as_flattened())
        {
            *input = F::from_f64(*x);
        }
        inputs[15..].copy_from_slice(&self.domain.interval());
        inputs
    }

    /// Inputs in the boxes, often near the corner of the bound.
    pub(super) fn start(&self, goal: Goal, draw: &mut Draw) -> Inputs<F> {
        if let Some(measures) = self
            .domain
            .measures
            .filter(|_| goal != Goal::Zero && draw.coin())
        {
            return self.aimed(measures, draw);
        }
        if self.judge.is_some() && self.domain.measures.is_none() {
            return self.aimed_in_a_box(draw);
        }
        let mut inputs = [F::zero(); 17];
        let world = self.domain.world.to_f64();
        let shift = draw.below(30) as i32;
        let offset = |draw: &mut Draw| world * draw.symmetric::<f64>() * 2f64.powi(-shift);
        let [edge, reach] = [self.domain.edge, self.domain.reach].map(|x| x.to_f64());
        let at_corner = draw.coin();
        let size = |draw: &mut Draw, bound: f64| {
            let size = match draw.below(3) {
                0 => bound * draw.unit(),
                1 => bound * (1.0 - draw.unit() * 0.01),
                _ => bound * (1.0 - draw.unit() * 2f64.powi(-12)),
            };
            if draw.coin() { size } else { -size }
        };
        let lemma = self.quantity.lemmas.last();
        let sign = |wanted: Leaf| {
            let lemma = lemma.filter(|_| at_corner)?;
            let at = lemma
                .formula
                .sources
                .iter()
                .position(|s| *s == Source::Leaf(wanted))?;
            Some(*lemma.maximum.corner.get(at)?)
        };
        let signed = |x: f64, minus: Option<bool>| match minus {
            Some(true) => -x.abs(),
            Some(false) => x.abs(),
            None => x,
        };
        for axis in 0..3 {
            let a = offset(draw);
            inputs[6 + axis] = F::from_f64(a);
            for (point, bound) in [(2, edge), (3, edge), (0, reach)] {
                let x = size(draw, bound);
                let minus = sign(Leaf::Difference(point, 1, axis))
                    .or(sign(Leaf::Difference(1, point, axis)).map(|minus| !minus));
                let at = if point == 0 {
                    axis
                } else {
                    3 + 3 * point + axis
                };
                inputs[at] = F::from_f64(a + signed(x, minus));
            }
            // Where only vectors from the origin count, they are drawn around it.
            if sign(Leaf::Difference(1, 0, axis)).is_some() || !self.quantity.uses().edge {
                let o = offset(draw);
                inputs[axis] = F::from_f64(o);
                for point in 1..=3 {
                    let x = size(draw, reach);
                    let minus = sign(Leaf::Difference(point, 0, axis));
                    inputs[3 + 3 * point + axis] = F::from_f64(o + signed(x, minus));
                }
            }
            let direction = size(draw, self.domain.direction.to_f64());
            inputs[3 + axis] = F::from_f64(signed(direction, sign(Leaf::Direction(axis))));
        }
        let extent = self.domain.extent.to_f64();
        inputs[15] = F::from_f64(size(draw, extent));
        inputs[16] = F::from_f64(size(draw, extent));
        if goal == Goal::Zero {
            make_parallel(&mut inputs, draw);
        }
        inputs
    }
}

/// Makes the direction one of the edges, so that it lies in the plane if the difference is exact.
pub(super) fn make_parallel<F: Float>(inputs: &mut Inputs<F>, draw: &mut Draw) {
    let (from, to) = draw.pick(&[(6, 9), (6, 12), (9, 12)]);
    for axis in 0..3 {
        inputs[3 + axis] = inputs[to + axis] - inputs[from + axis];
    }
}
