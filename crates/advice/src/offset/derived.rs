//! The distance along the normal that is derived to be enough, for hit points from u and v. The derivation is by hand:
//! no certificate of `hairline prove` stands for it.
//!
//! Let the vertices' coordinates be at most M, u = 2^-p half an ulp of 1, and w0 = fl(fl(1 - u) - v), u and v the weights.
//! Let no weight be below -e, e >= 0. The others are then at most 1 + 2e, and the sizes of all three add up to at most
//! S = 1 + 4e. The exact sum of the weights is 1 + d with |d| <= u (|1 - u| + |w0|) <= (2 + 4e) u, so the exact point q
//! that they name is off the plane by |d n.a| <= (2 + 4e) u sqrt(3) M. The computed point differs from q by at most
//! 3 S u M in each coordinate, which is 3 S u sqrt(3) M along the normal; adding the offset rounds once more, S u sqrt(3) M.
//! Together (6 + 20 e) sqrt(3) u M, 10.4 u M for weights from 0 to 1. The computed normal is within 56 u of the exact one
//! where a triangle is at least an eighth of its longest edge high before its vertices are rounded, so an offset of s
//! lifts by s (1 - 12 u) at least. What is of second order in u, and what rounding adds to M and to weights at the ends
//! of their range (`ROOM`), are less than 2 %: 10.6 u M. The squared length of a normal must neither overflow nor
//! underflow: it is from edge^4 / 64 to edge^4.

use crate::arith::{Float, scale_by_power_of_two, smallest_normal};
use crate::audit::Row;
use crate::case::Scene;
use crate::kernel::Role;

/// By how much rounding may carry a weight beyond what a gate lets through. It raises the bound by 0.4 %.
pub const ROOM: f64 = 1.0 / 1024.0;

/// The least weight of a vertex that a row's gates let through, up to rounding: 0 for edge epsilons from 0 up, and the
/// epsilon itself where a gate compares u, v and 1-u-v with it. A gate that takes either sign, as Plücker's does, lets
/// weights up to the epsilon's size through as well if that is above 1/3; then the least is 1 less two such. None where a
/// tolerance of another dimension says nothing about the weights.
pub fn least_weight(row: &Row) -> Option<f64> {
    let gates = row.entry.info.gates.iter().zip(row.epsilons::<f64>());
    let edges = gates.filter(|(gate, _)| gate.role == Role::Edge);
    edges
        .map(|(gate, epsilon)| match gate.dimension.has_unit() {
            _ if 0.0 <= epsilon => Some(0.0),
            false => Some(epsilon.min(1.0 + 2.0 * epsilon)),
            true => None,
        })
        .try_fold(0.0, |least: f64, weight| Some(least.min(weight?)))
}

/// The least s for which `normal=s` has no wrong start in a scene by this derivation, for points from u and v whose
/// weights are at least `least_weight`. None for edges so short or so long that normals underflow or overflow.
pub fn derived_normal<F: Float>(scene: &Scene, least_weight: f64) -> Option<f64> {
    let [least, most] = [scene.edge[0].powi(4) / 64.0, scene.edge[1].powi(4)];
    let holds_normals = least * F::EPSILON.to_f64() >= 4.0 * smallest_normal::<F>()
        && 4.0 * most <= scale_by_power_of_two(1.0, F::MAX_EXPONENT);
    let unit_roundoff = F::EPSILON.to_f64() / 2.0;
    let of_weights = 6.0 - 20.0 * least_weight.min(0.0);
    holds_normals.then(|| 1.02 * of_weights * 3f64.sqrt() * unit_roundoff * scene.largest())
}
