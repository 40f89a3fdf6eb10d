//! How wrong a verdict is: how far from the triangle's boundary the line meets its plane.

use super::Domain;
use super::meaning::Scale;
use super::measures::{Angle, Sample};
use crate::arith::{Float, Real, Triple, Vector};
use crate::case::{Case, Draw};
use crate::contract::Sides;
use crate::kernel::gate::refused_by;
use crate::kernel::{Gated, Role};

/// A case by its numbers.
pub fn case_of<F: Float>(inputs: &[F; 17]) -> Case<F> {
    Case::from_bits(&inputs.map(|x| x.to_bits()))
}

/// A number below this times its scale decides at an edge.
const NEAR: f64 = 1.0 / 1024.0;

/// A kernel at some epsilons, whose verdicts are looked at in a domain.
pub struct Judge<'a, F> {
    pub(super) gated: &'a dyn Gated<F>,
    pub(super) epsilons: &'a [F],
    /// The numbers that the edge gates multiply barycentric coordinates by.
    pub(super) scales: Vec<Scale>,
}

impl<F: Float> Judge<'_, F> {
    /// On a case of the domain whose t is between its ends, how wrong the verdict is, and true if it is of the wanted kind. Where it is
    /// not, the score counts what the verdict lacks of it twice, so that a search finds large errors first.
    pub(super) fn score<R: Real>(
        &self,
        inputs: &[F; 17],
        is_hit: bool,
        domain: &Domain,
        sample: &Sample<R>,
        float: impl Fn(&R) -> Option<f64>,
    ) -> Option<(f64, bool)> {
        let gates = self.gated.info().gates;
        let is_front = float(&sample.volume())? < 0.0;
        let is_asked = is_front || self.gated.info().contract.sides == Sides::Both;
        let measures = domain.measures.as_ref();
        let floats = Sample::of(&inputs.map(F::to_f64));
        let is_of_scene =
            measures.is_none_or(|it| it.hold(&floats, Angle::OfScene, F::EPSILON.to_f64()));
        let time = float(&sample.time())?;
        let is_within = floats.ends[0] < time && time < floats.ends[1];
        if !(is_asked && is_within && is_of_scene && self.holds(domain, sample, &float)?) {
            return None;
        }
        let margins = self.gated.thresholds(&case_of(inputs));
        let refused = refused_by(&self.gated.measure(&case_of(inputs)).margins, self.epsilons);
        if refused.is_some_and(|gate| gates[gate].role != Role::Edge) {
            return None;
        }
        let is_edge = |gate: &usize| gates[*gate].role == Role::Edge;
        let slack = |gate: usize| margins[gate].to_f64() - self.epsilons[gate].to_f64();
        let slack = (0..gates.len())
            .filter(is_edge)
            .map(slack)
            .fold(f64::INFINITY, f64::min);
        let scale = self.scale(&floats);
        let depth = depth(sample, float)?;
        let score = if is_hit { -depth } else { depth };
        let is_wanted = refused.is_none() == is_hit;
        Some(if is_wanted {
            (score, true)
        } else {
            (score - 2.0 * slack.abs() / scale, false)
        })
    }

    /// The least size of the numbers that the edge gates multiply barycentric coordinates by.
    pub(super) fn scale(&self, sample: &Sample<f64>) -> f64 {
        self.scales
            .iter()
            .map(|scale| scale.of(sample).abs())
            .fold(f64::INFINITY, f64::min)
    }

    /// How far from the nearest edge, as a share of the longest one, a number's error moves what it decides there; 0 if it
    /// decides something else.
    pub(super) fn weight(&self, value: f64, sample: &Sample<f64>) -> f64 {
        let scale = self.scale(sample);
        let near = (0..3).min_by(|i, j| {
            let size = |vertex: usize| sample.weight(vertex).abs();
            size(*i).total_cmp(&size(*j))
        });
        let is_near = value.abs() < NEAR * scale;
        let heights = heights(sample, |x| Some(*x)).unwrap_or_default();
        near.filter(|_| is_near)
            .map_or(0.0, |vertex| heights[vertex] / scale)
    }

    /// The barycentric coordinate at which the gates at edges begin to refuse.
    fn threshold(&self, sample: &Sample<f64>) -> f64 {
        let gates = self.gated.info().gates.iter().zip(self.epsilons);
        let mut edges = gates.filter(|(gate, _)| gate.role == Role::Edge);
        edges
            .next()
            .map_or(0.0, |(_, epsilon)| epsilon.to_f64() / self.scale(sample))
    }

    /// Moves a ray so that it passes near where an edge's gate decides, or near a vertex.
    pub(super) fn move_to_boundary(&self, inputs: &mut [F; 17], draw: &mut Draw) {
        let sample = Sample::of(&inputs.map(F::to_f64));
        let distance = |vertex: &usize| sample.weight(*vertex).abs();
        let nearest = (0..3).min_by(|i, j| distance(i).total_cmp(&distance(j)));
        // Often the nearest edge, so that the ray's origin stays near where it is.
        let edge = nearest.filter(|_| draw.coin()).unwrap_or(draw.below(3));
        let others = [(edge + 1) % 3, (edge + 2) % 3];
        let [to, other] = if draw.coin() {
            others
        } else {
            [others[1], others[0]]
        };
        let is_vertex = draw.below(4) == 0;
        let threshold = self.threshold(&sample);
        for vertex in [edge, other] {
            let by = sample.vertices[to].minus(&sample.vertices[vertex]);
            for (axis, input) in inputs.iter_mut().take(3).enumerate() {
                let moved = sample.weight(vertex) - threshold;
                *input = F::from_f64(input.to_f64() + moved * by.at(axis));
            }
            if !is_vertex {
                break;
            }
        }
    }

    /// True of a case of the domain as it is printed, whatever of it the kernel's bounds suppose.
    fn holds<R: Real>(
        &self,
        domain: &Domain,
        sample: &Sample<R>,
        float: &impl Fn(&R) -> Option<f64>,
    ) -> Option<bool> {
        let Sample {
            origin,
            direction,
            vertices,
            edges,
            ..
        } = sample;
        let reach = vertices.each_ref().map(|vertex| vertex.minus(origin));
        let boxes: [(&[Triple<R>], _); 5] = [
            (edges, domain.edge),
            (&reach, domain.reach),
            (vertices, domain.world),
            (std::slice::from_ref(origin), domain.world),
            (std::slice::from_ref(direction), domain.direction),
        ];
        for (vectors, most) in boxes {
            for vector in vectors {
                for axis in 0..3 {
                    if most.to_f64() < float(&vector.at(axis))?.abs() {
                        return Some(false);
                    }
                }
            }
        }
        let has_floor = domain.measures.is_none();
        if has_floor && float(&sample.volume())?.abs() < Scale::Volume.least(domain) {
            return Some(false);
        }
        for scale in &self.scales {
            if float(&scale.of(sample))?.abs() < scale.least(domain) {
                return Some(false);
            }
        }
        Some(true)
    }
}

/// How far inside the nearest edge's line the ray's line meets the plane, over the longest edge; negative outside. None where a
/// number is not known well enough.
fn depth<R: Real>(sample: &Sample<R>, float: impl Fn(&R) -> Option<f64>) -> Option<f64> {
    let heights = heights(sample, &float)?;
    let of = |vertex: usize| Some(float(&sample.weight(vertex))? * heights[vertex]);
    let [a, b, c] = [of(0)?, of(1)?, of(2)?];
    Some(a.min(b).min(c))
}

/// The triangle's heights over its longest edge.
fn heights<R: Real>(sample: &Sample<R>, float: impl Fn(&R) -> Option<f64>) -> Option<[f64; 3]> {
    let length = |v: &Triple<R>| {
        Some(v.dot(v))
            .and_then(|square| float(&square))
            .map(f64::sqrt)
    };
    let [ab, ac, bc] = &sample.edges;
    let (edges, normal) = (
        [length(bc)?, length(ac)?, length(ab)?],
        length(&sample.normal)?,
    );
    let longest = edges.into_iter().fold(0.0, f64::max);
    Some(edges.map(|edge| normal / edge / longest))
}
