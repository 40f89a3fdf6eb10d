//! How wrong a verdict is: how far from the triangle's boundary the line meets its plane.

use super::Domain;
use super::meaning::Scale;
use super::measures::{Angle, Sample};
use crate::arith::{Float, Real, Triple, Vector};
use crate::case::{Case, Draw};
use crate::contract::Sides;
use crate::kernel::gate::refused_by;
use crate::kernel::{Gated, Role};
use std::slice;

/// A case by its numbers.
pub fn case_of<F: Float>(inputs: &[F; 17]) -> Case<F> {
    Case::from_bits(&inputs.map(|x| x.to_bits()))
}

/// A number below this times its scale decides at an edge.
const NEAR: f64 = 1.0 / 1024.0;

/// A kernel at some epsilons, whose verdicts are looked at in a domain.
pub struct Judge<'a, F> {
    pub gated: &'a dyn Gated<F>,
    pub epsilons: &'a [F],
    /// The numbers that the edge gates multiply barycentric coordinates by.
    pub scales: Vec<Scale>,
}

impl<F: Float> Judge<'_, F> {
    /// On a case of the domain whose t is between its ends, how wrong the verdict is, and true if it is of the wanted kind. Where it is
    /// not, the score counts what the verdict lacks of it twice, so that a search finds large errors first.
    pub fn score<R: Real>(
        &self,
        inputs: &[F; 17],
        is_hit: bool,
        domain: &Domain,
        sample: &Sample<R>,
        float: impl Fn(&R) -> Option<f64>,
    ) -> Option<(f64, bool)> {
        let floats = Sample::of(&inputs.map(F::to_f64));
        let is_front = float(&sample.volume())? < 0.0;
        let counts_side = is_front || self.gated.info().contract.sides == Sides::Both;
        let time = float(&sample.time())?;
        let [start, end] = floats.ends;
        let is_between = start < time && time < end;
        if !counts_side || !is_between || !is_of_scene::<F>(domain, &floats) {
            return None;
        }
        if !self.holds(domain, sample, &float)? {
            return None;
        }
        let case = case_of(inputs);
        let refused = refused_by(&self.gated.measure(&case).margins, self.epsilons);
        if refused.is_some_and(|gate| !self.is_edge(gate)) {
            return None;
        }
        let depth = depth(sample, float)?;
        let score = if is_hit { -depth } else { depth };
        let is_wanted = refused.is_none() == is_hit;
        if is_wanted {
            return Some((score, true));
        }
        let lack = 2.0 * self.slack(&case).abs() / self.scale(&floats);
        Some((score - lack, false))
    }

    fn is_edge(&self, gate: usize) -> bool {
        self.gated.info().gates[gate].role == Role::Edge
    }

    /// How far above its epsilon the first edge gate that would refuse is.
    fn slack(&self, case: &Case<F>) -> f64 {
        let margins = self.gated.thresholds(case);
        let mut least = f64::INFINITY;
        for (gate, epsilon) in self.epsilons.iter().enumerate() {
            if self.is_edge(gate) {
                let slack = margins[gate].to_f64() - epsilon.to_f64();
                least = least.min(slack);
            }
        }
        least
    }

    /// The least size of the numbers that the edge gates multiply barycentric coordinates by.
    pub fn scale(&self, sample: &Sample<f64>) -> f64 {
        let mut least = f64::INFINITY;
        for scale in &self.scales {
            least = least.min(scale.of(sample).abs());
        }
        least
    }

    /// How far from the nearest edge, as a share of the longest one, a number's error moves what it decides there; 0 if it
    /// decides something else.
    pub fn weight(&self, value: f64, sample: &Sample<f64>) -> f64 {
        let scale = self.scale(sample);
        let is_near = value.abs() < NEAR * scale;
        if !is_near {
            return 0.0;
        }
        let heights = heights(sample, |x| Some(*x)).unwrap_or_default();
        heights[nearest(sample)] / scale
    }

    /// The barycentric coordinate at which the gates at edges begin to refuse.
    fn threshold(&self, sample: &Sample<f64>) -> f64 {
        let mut gates = 0..self.epsilons.len();
        match gates.find(|gate| self.is_edge(*gate)) {
            Some(gate) => self.epsilons[gate].to_f64() / self.scale(sample),
            None => 0.0,
        }
    }

    /// Moves a ray so that it passes near where an edge's gate decides, or near a vertex.
    pub fn move_to_boundary(&self, inputs: &mut [F; 17], draw: &mut Draw) {
        let sample = Sample::of(&inputs.map(F::to_f64));
        // Often the nearest edge, so that the ray's origin stays near where it is.
        let is_nearest = draw.coin();
        let any = draw.below(3);
        let edge = if is_nearest { nearest(&sample) } else { any };
        let mut others = [(edge + 1) % 3, (edge + 2) % 3];
        if !draw.coin() {
            others.swap(0, 1);
        }
        let [to, other] = others;
        let is_vertex = draw.below(4) == 0;
        let moved = if is_vertex {
            vec![edge, other]
        } else {
            vec![edge]
        };
        let threshold = self.threshold(&sample);
        for vertex in moved {
            let by = sample.vertices[to].minus(&sample.vertices[vertex]);
            let share = sample.weight(vertex) - threshold;
            for (axis, input) in inputs.iter_mut().take(3).enumerate() {
                *input = F::from_f64(input.to_f64() + share * by.at(axis));
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
            origin, vertices, ..
        } = sample;
        let reach = vertices.each_ref().map(|vertex| vertex.minus(origin));
        let boxes = [
            (sample.edges.as_slice(), domain.edge),
            (&reach, domain.reach),
            (vertices, domain.world),
            (slice::from_ref(origin), domain.world),
            (slice::from_ref(&sample.direction), domain.direction),
        ];
        for (vectors, most) in boxes {
            if most.to_f64() < largest_coordinate(vectors, float)? {
                return Some(false);
            }
        }
        let mut scales = self.scales.clone();
        if domain.measures.is_none() {
            scales.push(Scale::Volume);
        }
        for scale in scales {
            if float(&scale.of(sample))?.abs() < scale.least(domain) {
                return Some(false);
            }
        }
        Some(true)
    }
}

/// True if a case has the angles, lengths and directions of the scene, if there is one.
fn is_of_scene<F: Float>(domain: &Domain, sample: &Sample<f64>) -> bool {
    match &domain.measures {
        Some(measures) => measures.hold(sample, Angle::OfScene, F::EPSILON.to_f64()),
        None => true,
    }
}

fn largest_coordinate<R: Real>(
    vectors: &[Triple<R>],
    float: impl Fn(&R) -> Option<f64>,
) -> Option<f64> {
    let mut largest = 0f64;
    for vector in vectors {
        for axis in 0..3 {
            let size = float(&vector.at(axis))?.abs();
            largest = largest.max(size);
        }
    }
    Some(largest)
}

/// The vertex that is opposite the edge whose line is nearest in barycentric coordinates.
fn nearest(sample: &Sample<f64>) -> usize {
    let distances = [0, 1, 2].map(|vertex| sample.weight(vertex).abs());
    let nearest = (0..3).min_by(|i, j| distances[*i].total_cmp(&distances[*j]));
    nearest.expect("three")
}

/// How far inside the nearest edge's line the ray's line meets the plane, over the longest edge; negative outside. None where a
/// number is not known well enough.
fn depth<R: Real>(sample: &Sample<R>, float: impl Fn(&R) -> Option<f64>) -> Option<f64> {
    let heights = heights(sample, &float)?;
    let mut depth = f64::INFINITY;
    for (vertex, height) in heights.iter().enumerate() {
        let weight = float(&sample.weight(vertex))?;
        depth = depth.min(weight * height);
    }
    Some(depth)
}

/// The triangle's heights over its longest edge.
fn heights<R: Real>(sample: &Sample<R>, float: impl Fn(&R) -> Option<f64>) -> Option<[f64; 3]> {
    let length = |v: &Triple<R>| float(&v.dot(v)).map(f64::sqrt);
    let [ab, ac, bc] = &sample.edges;
    let edges = [length(bc)?, length(ac)?, length(ab)?];
    let normal = length(&sample.normal)?;
    let longest = edges.into_iter().fold(0.0, f64::max);
    Some(edges.map(|edge| normal / edge / longest))
}
