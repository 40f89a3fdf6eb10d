//! The data of a hit that an offset scheme may use, and the result that it returns.

use crate::arith::Float;

/// A hit of a kernel, as far as an offset scheme may know it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HitPoint<F: Float> {
    /// The rounded point from which the new ray is to leave.
    pub point: [F; 3],
    /// The triangle's unit normal as computed in the scalar, on the side from which the first ray came.
    pub normal: [F; 3],
    /// The triangle's vertices a, b, c.
    pub vertices: [[F; 3]; 3],
    /// The computed weights of a, b, c; none if the kernel does not give them.
    pub weights: Option<[F; 3]>,
    /// The computed t of the hit; NaN if the kernel does not give it.
    pub t: F,
    /// The direction of the new ray, of unit length but for rounding.
    pub direction: [F; 3],
}

/// Where a new ray starts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Start<F: Float> {
    /// Its origin.
    pub origin: [F; 3],
    /// The least t at which a hit counts.
    pub t_min: F,
}

impl<F: Float> Start<F> {
    /// At a point, where every t from 0 up counts.
    pub fn at(origin: [F; 3]) -> Start<F> {
        Start {
            origin,
            t_min: F::zero(),
        }
    }

    /// Where hits begin to count along a direction, in `f64`.
    pub(super) fn point(&self, direction: [F; 3]) -> [f64; 3] {
        let t_min = self.t_min.to_f64();
        std::array::from_fn(|i| self.origin[i].to_f64() + t_min * direction[i].to_f64())
    }
}

/// An offset scheme in one scalar. Any closure of the same signature is one.
///
/// It is a function of its argument: the same hit gives the same start, on any thread.
pub trait Offset<F: Float>: Send + Sync {
    /// Where the new ray starts.
    fn start(&self, hit: &HitPoint<F>) -> Start<F>;

    /// Where those of several hits start.
    fn starts(&self, hits: &[HitPoint<F>]) -> Vec<Start<F>> {
        hits.iter().map(|hit| self.start(hit)).collect()
    }
}

impl<F: Float, T: Fn(&HitPoint<F>) -> Start<F> + Send + Sync> Offset<F> for T {
    fn start(&self, hit: &HitPoint<F>) -> Start<F> {
        self(hit)
    }
}
