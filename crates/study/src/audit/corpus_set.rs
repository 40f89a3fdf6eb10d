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
    pub fn far_starts(&self) -> impl Iterator<Item = &str> {
        fn is_far(case: &Case<f64>) -> bool {
            let [origin, _, a, b, c] = case.vectors();
            let distance = |p: [f64; 3], q: [f64; 3]| {
                p.iter()
                    .zip(q)
                    .fold(0.0, |sum: f64, (p, q)| sum.hypot(p - q))
            };
            let longest = distance(a, b).max(distance(b, c)).max(distance(c, a));
            [a, b, c]
                .into_iter()
                .all(|vertex| 2.0 * longest < distance(origin, vertex))
        }
        let in_f32 = self.f32.iter().filter(|(_, case)| is_far(&case.widen()));
        let in_f64 = self.f64.iter().filter(|(_, case)| is_far(case));
        in_f32
            .map(|(name, _)| name.as_str())
            .chain(in_f64.map(|(name, _)| name.as_str()))
    }

    /// The name and the case of an index.
    pub(super) fn get<F: Float>(&self, index: u64) -> (&str, Case<F>) {
        // The scalar of the run is F; its cases are stored in full, so the way through f64 is exact.
        let narrow = |case: Case<f64>| {
            let [o, d, a, b, c] = case.vectors().map(|v| v.map(F::from_f64));
            Case::new(o, d, [a, b, c]).on(F::from_f64(case.ray.t_min), F::from_f64(case.ray.t_max))
        };
        if F::NAME == f32::NAME {
            let (name, case) = &self.f32[index as usize];
            (name, narrow(case.widen()))
        } else {
            let (name, case) = &self.f64[index as usize];
            (name, narrow(*case))
        }
    }
}
