//! The test that never asks: exact arithmetic where the margin leaves the answer open.

use super::number::Number;
use super::prepared::{Answer, PreparedRay, PreparedTriangle};
use crate::arith::Float;
use crate::case::Case;
use crate::oracle::{exact_values, is_met_once, truth};
use crate::truth::{Facing, Feature, Place, Truth};
use num_traits::ToPrimitive;

/// The rule for a ray that meets an edge or a vertex exactly.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Edges {
    /// Exactly one of the triangles that meet there is hit, where the ray crosses the surface: no leak and no double. At a
    /// fold of the surface, as seen along the ray, both triangles are hit or neither. The ray counts as moved by less than
    /// any number.
    #[default]
    Once,
    /// All of them are hit.
    Closed,
    /// None of them is hit.
    Open,
}

/// A hit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit<F> {
    /// The parameter of the point, in units of the direction and within the ray's ends. With f64 numbers `t * direction` is
    /// off by at most 2^-24 times the shorter edge at the first corner, and 2^-24 of itself, besides its last rounding.
    pub t: F,
    /// The weight of b, within 0 and 1: off by at most 2^-24 with f64 numbers, besides its last rounding.
    pub u: F,
    /// The weight of c, within 0 and 1 - u: likewise.
    pub v: F,
    /// True if the ray meets the side from which a, b, c run counter-clockwise.
    pub is_front: bool,
}

impl<F: Float, N: Number + From<F>> PreparedTriangle<F, N> {
    /// Does the ray hit this triangle with `t_min <= t <= t_max`? Right for all finite inputs. Both ends count, in units of
    /// the direction, and either may be infinite. At shared edges exactly one triangle is hit: [`Edges::Once`].
    ///
    /// A NaN, an infinite coordinate, a direction of 0 or `t_min > t_max` is a miss.
    #[inline]
    pub fn hit(&self, ray: &PreparedRay<F, N>, t_min: F, t_max: F) -> Option<Hit<F>> {
        self.hit_with(ray, t_min, t_max, Edges::Once)
    }

    /// The same with another rule for rays that meet an edge or a vertex exactly.
    #[inline]
    pub fn hit_with(
        &self,
        ray: &PreparedRay<F, N>,
        t_min: F,
        t_max: F,
        edges: Edges,
    ) -> Option<Hit<F>> {
        match self.decide(ray, t_min, t_max) {
            Answer::Hit(values) => {
                let rounded = [values.t, values.u, values.v].map(|x| F::from_f64(x.to_f64()));
                Some(Hit::within([t_min, t_max], rounded, values.is_front))
            }
            Answer::Miss => None,
            Answer::Ask => self.ask(ray, t_min, t_max, edges),
        }
    }

    /// The answer by exact arithmetic.
    #[cold]
    #[inline(never)]
    fn ask(&self, ray: &PreparedRay<F, N>, t_min: F, t_max: F, edges: Edges) -> Option<Hit<F>> {
        let [o, d, a] = {
            let [o, d] = ray.vectors();
            [o, d, self.first()].map(|vector| vector.map(Float::to_f64))
        };
        let [b, c] = self.others.map(|point| point.map(F::to_f64));
        let case = Case::new(o, d, [a, b, c]).on(t_min.to_f64(), t_max.to_f64());
        let truth = truth(&case);
        let Truth::Transversal(crossing) = truth else {
            return None;
        };
        let is_between = !matches!(crossing.place, Place::Before | Place::Beyond);
        let is_hit = match (crossing.feature, edges) {
            (Feature::Interior, _) => true,
            (Feature::Outside, _) => false,
            (_, Edges::Once) => is_between && is_met_once(&case, &crossing),
            (_, Edges::Closed) => true,
            (_, Edges::Open) => false,
        };
        if !(is_between && is_hit) {
            return None;
        }
        let rounded = match self.values_near(ray) {
            Some(values) => values.map(Float::to_f64),
            None => {
                let values = exact_values(&case, &truth);
                [values.t, values.u, values.v]
                    .map(|x| x.and_then(|x| x.to_f64()).expect("of a crossing"))
            }
        };
        let is_front = crossing.facing == Facing::Front;
        Some(Hit::within(
            [t_min, t_max],
            rounded.map(F::from_f64),
            is_front,
        ))
    }
}

impl<F: Float> Hit<F> {
    /// From values that were rounded: t stays between the ends and finite, and the point in the triangle.
    #[inline(always)]
    fn within([t_min, t_max]: [F; 2], [t, u, v]: [F; 3], is_front: bool) -> Self {
        let u = clamped(u, F::zero(), F::one());
        let largest = F::infinity().offset_ulps(-1);
        Hit {
            t: clamped(clamped(t, -largest, largest), t_min, t_max),
            u,
            v: clamped(v, F::zero(), F::one() - u),
            is_front,
        }
    }
}

#[inline(always)]
fn clamped<F: Float>(x: F, low: F, high: F) -> F {
    let x = if x < low { low } else { x };
    if x > high { high } else { x }
}
