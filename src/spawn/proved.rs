//! The distance along the normal that is proved to be enough, for hit points from u and v.
//!
//! Let the vertices' coordinates be at most M, u = 2^-p half an ulp of 1, and w0 = fl(fl(1 - u) - v), u and v the weights,
//! from 0 to 1. Their exact sum is 1 + d with |d| <= 2u, so the exact point q that they name is off the plane by
//! |d n.a| <= 2u sqrt(3) M. The computed point differs from q by at most 3u M in each coordinate, which is 3u sqrt(3) M
//! along the normal; adding the offset rounds once more, u sqrt(3) M. Together 6 sqrt(3) u M. The computed normal is
//! within 56 u of the exact one where a triangle is at least an eighth of its longest edge high before its vertices are
//! rounded, so an offset of s lifts by s (1 - 12 u) at least. What is of second order in u, and what rounding adds to M
//! and to weights at the ends of their range, are less than 2 %. The squared length of a normal must neither overflow nor
//! underflow: it is from edge^4 / 64 to edge^4.

use crate::arith::{Float, scale_by_power_of_two, smallest_normal};
use crate::case::Scene;

/// The least s for which `normal=s` is proved to have no wrong start in a scene, for points from u and v. None for
/// edges so short or so long that normals underflow or overflow.
pub fn proved_normal<F: Float>(scene: &Scene) -> Option<f64> {
    let [least, most] = [scene.edge[0].powi(4) / 64.0, scene.edge[1].powi(4)];
    let holds_normals = least * F::EPSILON.to_f64() >= 4.0 * smallest_normal::<F>()
        && 4.0 * most <= scale_by_power_of_two(1.0, F::MAX_EXPONENT);
    let unit_roundoff = F::EPSILON.to_f64() / 2.0;
    holds_normals.then(|| 1.02 * 6.0 * 3f64.sqrt() * unit_roundoff * scene.largest())
}
