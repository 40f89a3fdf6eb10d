//! The test with a margin: hit, miss or ask.

use super::number::Number;
use crate::arith::Float;
use std::marker::PhantomData;

/// A triangle, made ready once for all rays. `F` is the scalar of its points, `N` that of the test's numbers.
#[derive(Clone, Copy, Debug)]
pub struct PreparedTriangle<F, N> {
    a: [N; 3],
    /// a-c and b-a.
    ca: [N; 3],
    ab: [N; 3],
    /// (c-a)×(b-a).
    normal: [N; 3],
    /// The margin of the weights is `edges * ray.reach + area * ray.speed`, that of t `depth` times lengths.
    edges: N,
    area: N,
    depth: N,
    /// |a|, at least.
    far: N,
    /// b and c, for exact arithmetic.
    pub(super) others: [[F; 3]; 2],
}

/// A ray, made ready once for all triangles. `F` is the scalar of its coordinates, `N` that of the test's numbers.
#[derive(Clone, Copy, Debug)]
pub struct PreparedRay<F, N> {
    o: [N; 3],
    d: [N; 3],
    /// |d|, at least; |d|·|o|; and |o|.
    speed: N,
    reach: N,
    far: N,
    scalar: PhantomData<F>,
}

/// An answer that is right, or none.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Answer<N> {
    /// The ray passes through the inside of the triangle, strictly between its ends.
    Hit(Values<N>),
    /// The ray does not meet the triangle, its edges and the ends included.
    Miss,
    /// Rounding may decide, or the ray meets an edge or an end, or an input is not finite or too large.
    Ask,
}

/// The values of a hit, as Möller and Trumbore compute them: undivided numbers times 1/det.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Values<N> {
    /// The parameter of the hit, in units of the direction.
    pub t: N,
    /// The weight of b.
    pub u: N,
    /// The weight of c.
    pub v: N,
    /// True if a, b, c run counter-clockwise as the ray sees them.
    pub is_front: bool,
}

/// Undivided numbers of a ray and a triangle.
pub(super) struct Numbers<N> {
    /// a-o.
    s: [N; 3],
    /// The weights of b and c, times det.
    u: N,
    v: N,
    det: N,
    /// The least of the three weights if it is positive; the largest, negated, if that is; otherwise below 0.
    pub(super) x: N,
}

impl<F: Float, N: Number + From<F>> PreparedTriangle<F, N> {
    /// From its corners. Any unit of length; glam vectors or arrays.
    pub fn new(a: impl Into<[F; 3]>, b: impl Into<[F; 3]>, c: impl Into<[F; 3]>) -> Self {
        let others = [b.into(), c.into()];
        let a = a.into().map(N::from);
        let [b, c] = others.map(|point| point.map(N::from));
        let (ab, ca) = (minus(b, a), minus(a, c));
        let [e, f, far] = [ab, ca, a].map(length);
        let longest = larger(e, f);
        let (sum, product) = (e + f, e * f);
        let whole = N::one() + longest;
        let is_open = !(longest <= N::LARGEST && far <= N::LARGEST);
        let margin = |rounding: N, least: N| match is_open {
            true => N::infinity(),
            false => N::ROUNDING * rounding + N::LEAST * least,
        };
        PreparedTriangle {
            a,
            ca,
            ab,
            normal: cross(ab, ca),
            edges: margin(sum, whole),
            area: margin(product + sum * far, whole * (whole + far)),
            depth: margin(product, whole * whole),
            far,
            others,
        }
    }

    /// The first corner, exactly.
    pub(super) fn first(&self) -> [N; 3] {
        self.a
    }

    /// True hit, true miss, or neither: the part of [`PreparedTriangle::hit`] that takes no exact arithmetic. Both ends count,
    /// in units of the direction; either may be infinite.
    #[inline]
    pub fn decide(&self, ray: &PreparedRay<F, N>, t_min: F, t_max: F) -> Answer<N> {
        let Numbers {
            s, u, v, det, x, ..
        } = self.numbers(ray);
        let margin = self.margin(ray);
        if x > margin {
            let is_front = det > N::zero();
            let size = det.abs();
            let t = dot(s, self.normal);
            let along = if is_front { t } else { -t };
            let (from, to) = (N::from(t_min), N::from(t_max));
            let from_end = if from < -N::FAR { -N::FAR } else { from };
            let to_end = if N::FAR < to { N::FAR } else { to };
            // How far t is past an end, times |det|, and what rounding may have made of it.
            let past = along - from_end * size;
            let before = to_end * size - along;
            let lengths = self.far + ray.far;
            let past_margin = self.depth * (lengths + from_end.abs() * ray.speed);
            let before_margin = self.depth * (lengths + to_end.abs() * ray.speed);
            if past > past_margin && before > before_margin && size * N::SHARE > margin {
                let inverse = N::one() / det;
                return Answer::Hit(Values {
                    t: t * inverse,
                    u: u * inverse,
                    v: v * inverse,
                    is_front,
                });
            }
            let is_before = past < -past_margin && from_end == from;
            let is_beyond = before < -before_margin && to_end == to;
            return if is_before || is_beyond {
                Answer::Miss
            } else {
                Answer::Ask
            };
        }
        if x < -margin {
            Answer::Miss
        } else {
            Answer::Ask
        }
    }

    /// t, u and v as computed, if they are as near to the exact ones as those of a hit that needs no exact arithmetic.
    pub(super) fn values_near(&self, ray: &PreparedRay<F, N>) -> Option<[N; 3]> {
        let Numbers { s, u, v, det, .. } = self.numbers(ray);
        let inverse = N::one() / det;
        let is_near = det.abs() * N::SHARE > self.margin(ray);
        is_near.then(|| [dot(s, self.normal), u, v].map(|x| x * inverse))
    }

    /// The undivided numbers of a ray and this triangle.
    #[inline(always)]
    pub(super) fn numbers(&self, ray: &PreparedRay<F, N>) -> Numbers<N> {
        let s = minus(self.a, ray.o);
        let moment = cross(s, ray.d);
        let (u, v) = (dot(moment, self.ca), dot(moment, self.ab));
        let det = dot(ray.d, self.normal);
        let w = det - u - v;
        // The last number is NaN wherever one is, and it is what each of these comparisons then takes.
        let low = lesser(lesser(u, v), w);
        let high = -larger(larger(u, v), w);
        let x = larger(low, high);
        Numbers { s, u, v, det, x }
    }

    /// More than rounding can have changed one of the weights by.
    #[inline(always)]
    pub(super) fn margin(&self, ray: &PreparedRay<F, N>) -> N {
        self.edges * ray.reach + self.area * ray.speed
    }

    /// The same triangle with another margin, which proves nothing: for tests that have to fail.
    #[cfg(test)]
    pub(super) fn with_margins_times(mut self, share: N) -> Self {
        for margin in [&mut self.edges, &mut self.area, &mut self.depth] {
            *margin = *margin * share;
        }
        self
    }
}

impl<F: Float, N: Number + From<F>> PreparedRay<F, N> {
    /// The ray from `origin` along `direction`, which may have any length: t is in its units.
    pub fn new(origin: impl Into<[F; 3]>, direction: impl Into<[F; 3]>) -> Self {
        let [o, d] = [origin.into(), direction.into()].map(|vector| vector.map(N::from));
        let [far, length] = [o, d].map(length);
        let is_open = !(far <= N::LARGEST && length <= N::LARGEST);
        let speed = length + N::LEAST * (N::one() + length);
        let [speed, reach] = [speed, speed * far].map(|x| if is_open { N::infinity() } else { x });
        PreparedRay {
            o,
            d,
            far: far + N::LEAST * (N::one() + speed),
            speed,
            reach,
            scalar: PhantomData,
        }
    }

    /// Origin and direction, exactly.
    pub(super) fn vectors(&self) -> [[N; 3]; 2] {
        [self.o, self.d]
    }
}

/// The Euclidean length, at least, where no square overflows.
fn length<N: Number>(v: [N; 3]) -> N {
    dot(v, v).sqrt() + N::LEAST
}

#[inline(always)]
fn minus<N: Number>(a: [N; 3], b: [N; 3]) -> [N; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

#[inline(always)]
fn dot<N: Number>(a: [N; 3], b: [N; 3]) -> N {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[inline(always)]
fn cross<N: Number>(a: [N; 3], b: [N; 3]) -> [N; 3] {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

/// The lesser; the second if either is NaN, as the machine's instruction does.
#[inline(always)]
fn lesser<N: Number>(a: N, b: N) -> N {
    if a < b { a } else { b }
}

/// The larger; the second if either is NaN.
#[inline(always)]
fn larger<N: Number>(a: N, b: N) -> N {
    if a > b { a } else { b }
}
