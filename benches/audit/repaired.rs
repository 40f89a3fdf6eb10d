//! moller-trumbore in f32 with three answers: hit, miss, ask. Made by
//!     hairline repair --kernel moller-trumbore --scalar f32 --emit rust
//! from: T. Möller and B. Trumbore, Fast, Minimum Storage Ray/Triangle Intersection, 1997, appendix, without culling, doi:10.1080/10867651.1997.10487468
//!
//! promise: line, both sides
//! A hit is right: the ray passes through the inside of the triangle. A miss is right: it does not meet
//! the triangle, its edges included, at any t (t_min and t_max are not looked at). Where rounding may decide, and on an edge: ask.
//! This holds for all finite inputs at every scale. The kernel's epsilons are gone. t, u and v are those that
//! the kernel computes; nothing is claimed of them, and near the ends of the range they may be infinite or NaN.
//!
//! Why: a sum of products, each of which passes at most K roundings before the last sum, is off by at most
//! ((1+u)^K - 1) times the sum of their sizes, u = 2^-24. Its sign is right beyond factor * sizes; the factor
//! covers the rounding of the sizes too. It supposes rounding to nearest, and differences of points that are computed
//! as they stand here. K is that of the worst order of a sum, so sums of products may be fused and reordered;
//! SLACK and the margin's least size cover underflow, subnormal numbers flushed or not. Where gates in a row
//! want numbers to be positive, or to have the sign of another, the least of them decides: by one margin, large enough for each. What
//! overflows on the way to a decision is no finite number, and asks.
//! An input may be a product of the caller's: Rust fuses no product into a sum.
//!     det: K = 6, factor 3.632e-7
//!     weight_of_b: K = 6, factor 3.632e-7
//!     n16: K = 9, factor 5.420e-7
//!     weight_of_c: K = 6, factor 3.632e-7
//!     weight_of_a: K = 12, factor 7.208e-7
//! Proof: hairline repair --kernel moller-trumbore --scalar f32 --certificate FILE; hairline prove --check FILE
//! Where it asks, `hairline_core::truth` has the exact answer.

/// The answer to a ray and a triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Answer {
    /// The ray passes through the inside of the triangle.
    Hit { t: f32, u: f32, v: f32 },
    /// The ray does not meet the triangle.
    Miss,
    /// Rounding may decide.
    Ask,
}

/// Added to sizes whose numbers may have underflowed.
const SLACK: f32 = 5.04871e-29;

/// How far from zero a number must be for its sign to be right.
fn margin_of(size: f32, factor: f32) -> f32 {
    factor * size + 1.2037062e-35
}

/// The sign of x, -1 or 1, if rounding cannot have changed it; otherwise 0. No branch: signs are hard to predict.
#[allow(dead_code)]
fn sure_sign(x: f32, size: f32, factor: f32) -> i8 {
    let margin = margin_of(size, factor);
    i8::from((x > margin) & x.is_finite()) - i8::from((x < -margin) & x.is_finite())
}

/// The sign of an input, or of a difference of two.
#[allow(dead_code)]
fn exact_sign(x: f32) -> i8 {
    i8::from((x > 0.0) & x.is_finite()) - i8::from((x < 0.0) & x.is_finite())
}

#[allow(dead_code)]
fn lesser(x: f32, y: f32) -> f32 {
    if x < y { x } else { y }
}

#[allow(dead_code)]
fn greater(x: f32, y: f32) -> f32 {
    if x > y { x } else { y }
}

/// The ray o + t * d and the triangle abc.
#[allow(clippy::too_many_arguments, clippy::nonminimal_bool, clippy::neg_cmp_op_on_partial_ord, clippy::neg_multiply)]
#[inline]
pub fn moller_trumbore_f32(o: [f32; 3], d: [f32; 3], a: [f32; 3], b: [f32; 3], c: [f32; 3]) -> Answer {
    let mut open = false;
    // gate parallel
    let ab_x = b[0] - a[0]; let ab_y = b[1] - a[1]; let ab_z = b[2] - a[2];
    let ac_x = c[0] - a[0]; let ac_y = c[1] - a[1]; let ac_z = c[2] - a[2];
    let d_ac_x = d[1] * ac_z - ac_y * d[2]; let d_ac_y = d[2] * ac_x - ac_z * d[0]; let d_ac_z = d[0] * ac_y - ac_x * d[1];
    let det = ab_x * d_ac_x + ab_y * d_ac_y + ab_z * d_ac_z;
    let size_ab_x = (ab_x).abs() + SLACK; let size_ab_y = (ab_y).abs() + SLACK; let size_ab_z = (ab_z).abs() + SLACK;
    let size_ac_x = (ac_x).abs() + SLACK; let size_ac_y = (ac_y).abs() + SLACK; let size_ac_z = (ac_z).abs() + SLACK;
    let size_d_0 = (d[0]).abs() + SLACK; let size_d_1 = (d[1]).abs() + SLACK; let size_d_2 = (d[2]).abs() + SLACK;
    let size_d_ac_x = size_d_1 * size_ac_z + size_ac_y * size_d_2 + SLACK;
    let size_d_ac_y = size_d_2 * size_ac_x + size_ac_z * size_d_0 + SLACK;
    let size_d_ac_z = size_d_0 * size_ac_y + size_ac_x * size_d_1 + SLACK;
    let size_det = size_ab_x * size_d_ac_x + size_ab_y * size_d_ac_y + size_ab_z * size_d_ac_z;
    let sign_det = sure_sign(det, size_det, 3.6321617e-7);
    open |= !(sign_det != 0);
    // gate edge
    let ao_x = o[0] - a[0]; let ao_y = o[1] - a[1]; let ao_z = o[2] - a[2];
    let weight_of_b = ao_x * d_ac_x + ao_y * d_ac_y + ao_z * d_ac_z;
    let n16 = det - weight_of_b;
    let ao_ab_x = ao_y * ab_z - ab_y * ao_z; let ao_ab_y = ao_z * ab_x - ab_z * ao_x;
    let ao_ab_z = ao_x * ab_y - ab_x * ao_y;
    let weight_of_c = d[0] * ao_ab_x + d[1] * ao_ab_y + d[2] * ao_ab_z; let weight_of_a = det - (weight_of_b + weight_of_c);
    let size_ao_x = (ao_x).abs() + SLACK; let size_ao_y = (ao_y).abs() + SLACK; let size_ao_z = (ao_z).abs() + SLACK;
    let size_weight_of_b = size_ao_x * size_d_ac_x + size_ao_y * size_d_ac_y + size_ao_z * size_d_ac_z;
    let size_weight_of_c = size_d_0 * (size_ao_y * size_ab_z + size_ab_y * size_ao_z + SLACK) + size_d_1 * (size_ao_z * size_ab_x + size_ab_z * size_ao_x + SLACK) + size_d_2 * (size_ao_x * size_ab_y + size_ab_x * size_ao_y + SLACK);
    let side = f32::from(sign_det);
    let margin = margin_of(size_det + (size_weight_of_b + size_weight_of_c), 7.208448e-7);
    let least = lesser(lesser(lesser(side * weight_of_b, side * n16), side * weight_of_c), side * weight_of_a);
    if !(weight_of_a).is_finite() { return Answer::Ask; }
    if least < -margin { return Answer::Miss; }
    open |= !(least > margin);
    if open { return Answer::Ask; }
    let inv_det = 1.0 / det;
    Answer::Hit { t: (ac_x * ao_ab_x + ac_y * ao_ab_y + ac_z * ao_ab_z) * inv_det, u: weight_of_b * inv_det, v: weight_of_c * inv_det }
}
