//! The distance along the normal that is proved to be enough, for hit points from u and v.
//!
//! Let the vertices' coordinates be at most M, u = 2^-p half an ulp of 1, and w0 = fl(fl(1 - u) - v), u and v the weights,
//! from 0 to 1. Their exact sum is 1 + d with |d| <= 2u, so the exact point q that they name is off the plane by
//! |d n.a| <= 2u sqrt(3) M. The computed point differs from q by at most 3u M in each coordinate, which is 3u sqrt(3) M
//! along the normal; adding the offset rounds once more, u sqrt(3) M. Together 6 sqrt(3) u M. The computed normal is
//! within 56 u of the exact one where a triangle is at least an eighth of its longest edge high, so an offset of s
//! lifts by s (1 - 12 u) at least. What is of second order in u, what rounding adds to M and to weights at the ends of
//! their range, and underflow are less than 2 %.

use crate::arith::Float;
use crate::case::Scene;

/// The least s for which `normal=s` is proved to have no wrong start in a scene, for points from u and v.
pub fn proved_normal<F: Float>(scene: &Scene) -> f64 {
    let unit_roundoff = F::EPSILON.to_f64() / 2.0;
    1.02 * 6.0 * 3f64.sqrt() * unit_roundoff * scene.largest()
}
