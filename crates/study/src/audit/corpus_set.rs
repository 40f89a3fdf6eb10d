//! Stored cases as a source of cases.

use crate::arith::Float;
use crate::case::Case;

/// The stored cases of one file of which all are secondary rays, or none is.
#[derive(Clone, Default)]
pub struct CorpusSet {
    /// The file's name.
    pub file: String,
    /// True if each ray starts at a computed hit point on its triangle.
    pub is_secondary: bool,
    /// Names and cases in `f32`.
    pub f32: Vec<(String, Case<f32>)>,
    /// Names and cases in `f64`.
    pub f64: Vec<(String, Case<f64>)>,
}

impl CorpusSet {
    /// The names of cases whose rays start more than twice the triangle's longest edge from every vertex: no hit
    /// point on it, unless rounding moved it by that much.
    pub fn far_starts(&self) -> Vec<&str> {
        let mut names = Vec::new();
        for (name, case) in &self.f32 {
            if starts_far(&case.widen()) {
                names.push(name.as_str());
            }
        }
        for (name, case) in &self.f64 {
            if starts_far(case) {
                names.push(name.as_str());
            }
        }
        names
    }

    /// The name and the case of an index.
    pub(super) fn get<F: Float>(&self, index: u64) -> (&str, Case<F>) {
        if F::NAME == f32::NAME {
            let (name, case) = &self.f32[index as usize];
            (name, narrow(&case.widen()))
        } else {
            let (name, case) = &self.f64[index as usize];
            (name, narrow(case))
        }
    }
}

/// The case in the scalar of a run. Its cases are stored in full, so the way through `f64` is exact.
fn narrow<F: Float>(case: &Case<f64>) -> Case<F> {
    let [o, d, a, b, c] = case.vectors().map(|vector| vector.map(F::from_f64));
    let t_min = F::from_f64(case.ray.t_min);
    let t_max = F::from_f64(case.ray.t_max);
    Case::new(o, d, [a, b, c]).on(t_min, t_max)
}

/// True if a ray starts more than twice the triangle's longest edge from every vertex.
fn starts_far(case: &Case<f64>) -> bool {
    let [origin, _, a, b, c] = case.vectors();
    let longest = distance(a, b).max(distance(b, c)).max(distance(c, a));
    let is_far = |vertex: [f64; 3]| 2.0 * longest < distance(origin, vertex);
    is_far(a) && is_far(b) && is_far(c)
}

fn distance(p: [f64; 3], q: [f64; 3]) -> f64 {
    let mut distance: f64 = 0.0;
    for axis in 0..3 {
        distance = distance.hypot(p[axis] - q[axis]);
    }
    distance
}
