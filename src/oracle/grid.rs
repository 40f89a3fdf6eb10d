//! The second layer: small integers. Where all positions are multiples of one power of two below
//! 2^30 times it, and so are the direction's coordinates of another, every predicate is computed
//! exactly in machine integers, and zero is zero.
//!
//! Widths: coordinates below 2^30, differences below 2^31, minors and the normal below 2^63 (64 bits hold
//! them), the determinants below 2^96 (128 bits).

use super::contact;
use super::integer::Interval;
use super::signs::Signs;
use crate::case::Case;
use crate::truth::{Contact, ContactKind, Feature, Truth};

/// Bits of a coordinate.
const BITS: i32 = 30;
/// Adding and subtracting it rounds a number below 2^51 to an integer; the sum's low bits are it.
const TO_INTEGER: f64 = 1.5 * (1u64 << 52) as f64;

/// The truth, if the coordinates lie on such a grid and the case is valid: a NaN, an infinity and a
/// direction of zero are on no grid.
#[inline(always)]
pub(super) fn decide(case: &Case<f64>) -> Option<Truth> {
    let ordered = case.ray.t_min <= case.ray.t_max;
    if !ordered {
        return None;
    }
    let [o, d, a, b, c] = case.vectors();
    let mut flat_positions = [0.0; 12];
    flat_positions.copy_from_slice([o, a, b, c].as_flattened());
    let (positions, p) = on_grid(flat_positions)?;
    let (d, q) = on_grid(d)?;
    let at = |k: usize| [positions[3 * k], positions[3 * k + 1], positions[3 * k + 2]];
    let [a, b, c] = [minus(at(1), at(0)), minus(at(2), at(0)), minus(at(3), at(0))];
    let (bc, ca, ab) = (cross(b, c), cross(c, a), cross(a, b));
    // (b-a)×(c-a), which is the sum of all three; that of two is (B-A)×C, below 2^63 as well.
    let normal = [0, 1, 2].map(|i| bc[i] + ca[i] + ab[i]);
    let capital_d = wide_dot(d, normal);
    let capital_t = wide_dot(a, bc);
    let interval = Interval::new(case, p - q);
    if capital_d == 0 {
        return Some(flat(&interval, d, [a, b, c], normal, capital_t));
    }
    // The negated weights, whose sum is D.
    let (u, v) = (wide_dot(d, bc), wide_dot(d, ca));
    let weights = [u, v, capital_d - u - v];
    let sign = |x: i128| x.cmp(&0);
    let signs = Signs {
        d: sign(capital_d),
        weights: weights.map(|x| 0.cmp(&x)),
        t: sign(capital_t),
        from_min: interval.compare_start(&capital_t, &capital_d),
        from_max: interval.compare_end(&capital_t, &capital_d),
    };
    Some(signs.truth())
}

/// Lines parallel to the plane, and triangles without area.
#[inline(never)]
fn flat(
    interval: &Interval,
    d: [i64; 3],
    vertices: [[i64; 3]; 3],
    n: [i64; 3],
    capital_t: i128,
) -> Truth {
    let [a, b, c] = vertices;
    let degenerate = n == [0; 3];
    if !degenerate && capital_t != 0 {
        return Truth::Parallel;
    }
    if !degenerate && interval.is_default() {
        return Truth::Coplanar(coplanar_contact(d, vertices, n));
    }
    let wide = |v: [i64; 3]| v.map(i128::from);
    let contact = contact::decide(interval, &wide(d), [&wide(a), &wide(b), &wide(c)], &wide(n));
    if degenerate { Truth::Degenerate(contact) } else { Truth::Coplanar(contact) }
}

/// The contact on [0, inf) of a line in the plane of a triangle with area. The line meets the boundary
/// nowhere, at one vertex, or at two points of different t, so the signs of their t tell all. Tables for
/// branches: the sides of the vertices are as random as the cases.
fn coplanar_contact(d: [i64; 3], vertices: [[i64; 3]; 3], n: [i64; 3]) -> Contact {
    let k = (0..3).find(|&k| n[k] != 0).expect("a triangle with area");
    let m = (0..3).find(|&m| d[m] != 0).expect("a direction that is not zero");
    // The side of the line that each vertex is on: component k of d × vertex.
    let (i, j) = ((k + 1) % 3, (k + 2) % 3);
    let side = vertices.map(|v| d[i] * v[j] - d[j] * v[i]);
    let digit = |x: i64| (x.signum() + 1) as usize;
    let met = &MET[9 * digit(side[0]) + 3 * digit(side[1]) + digit(side[2])];
    // t of the point between v and w, from the sides x and y: (y·v - x·w) / (y - x), over d.
    let t_sign = |(v, w): (usize, usize)| {
        let (x, y) = (i128::from(side[v]), i128::from(side[w]));
        let numerator = y * i128::from(vertices[v][m]) - x * i128::from(vertices[w][m]);
        numerator.signum() as i64 * (side[w] - side[v]).signum() * d[m].signum()
    };
    let [first, second] = met.between.map(t_sign);
    met.contacts[3 * digit(first) + digit(second)]
}

/// Where a line in the plane meets the boundary of a triangle, and what that makes of the contact.
#[derive(Clone, Copy)]
struct Met {
    /// The points, up to two: each lies between two vertices that are not on one side, at the first if
    /// that is on the line.
    between: [(usize, usize); 2],
    /// By 3 and 1 times 0, 1 or 2 for a point's t below, at and above zero.
    contacts: [Contact; 9],
}

/// By the sides of the vertices: 9, 3 and 1 times 0, 1 or 2 for the negative side, the line and the
/// positive side.
const MET: [Met; 27] = {
    const VERTICES: [Feature; 3] = [Feature::VertexA, Feature::VertexB, Feature::VertexC];
    const EDGES: [Feature; 3] = [Feature::EdgeAb, Feature::EdgeBc, Feature::EdgeCa];
    let none = Contact { kind: ContactKind::None, meets_ray: false, meets_line: false };
    let mut all = [Met { between: [(0, 0); 2], contacts: [none; 9] }; 27];
    let mut sides = 0;
    while sides < 27 {
        let side = [sides / 9, sides / 3 % 3, sides % 3];
        let met = &mut all[sides];
        let (mut count, mut features) = (0, [Feature::Outside; 2]);
        let mut v = 0;
        while v < 3 {
            // With area, no three vertices are on the line: that entry is never read.
            let (w, u) = ((v + 1) % 3, (v + 2) % 3);
            if side[v] == 1 && count < 2 {
                met.between[count] = (v, if side[w] == 1 { u } else { w });
                features[count] = VERTICES[v];
                count += 1;
            }
            v += 1;
        }
        v = 0;
        while v < 3 {
            let w = (v + 1) % 3;
            if side[v] != 1 && side[w] == 2 - side[v] {
                met.between[count] = (v, w);
                features[count] = EDGES[v];
                count += 1;
            }
            v += 1;
        }
        let mut t = 0;
        while t < 9 {
            let kind = match COMMON[count][t] {
                0 => ContactKind::None,
                3 => ContactKind::Segment,
                point => ContactKind::Point(features[point - 1]),
            };
            let meets_ray = !matches!(kind, ContactKind::None);
            met.contacts[t] = Contact { kind, meets_ray, meets_line: count > 0 };
            t += 1;
        }
        sides += 1;
    }
    all
};

/// What the ray has in common with the triangle (0: nothing, 1: the first point met, 2: the second, 3: a
/// segment), by the number of points and by the signs of their t as [`Met::contacts`] are.
const COMMON: [[usize; 9]; 3] = [
    [0; 9],
    [0, 0, 0, 1, 1, 1, 1, 1, 1],
    // Both behind; one behind and one at the origin; else something of the segment between them.
    [0, 2, 3, 1, 3, 3, 3, 3, 3],
];

/// Numbers, not all zero, as integers below 2^30 times a power of two, and its exponent.
#[inline(always)]
fn on_grid<const N: usize>(values: [f64; N]) -> Option<([i64; N], i64)> {
    // Four maxima side by side, so that none waits for the one before.
    let larger = |m: f64, x: f64| if x > m { x } else { m };
    let mut maxima = [0.0; 4];
    for (i, x) in values.into_iter().enumerate() {
        maxima[i % 4] = larger(maxima[i % 4], x.abs());
    }
    let largest = larger(larger(maxima[0], maxima[1]), larger(maxima[2], maxima[3]));
    let exponent = (largest.to_bits() >> 52) as i32 - 1023;
    let shift = BITS - 1 - exponent;
    // The scale must be a normal number; zeros and subnormal numbers alone are for the layers behind.
    if !(-1000..=1000).contains(&shift) {
        return None;
    }
    let scale = f64::from_bits(((1023 + shift) as u64) << 52);
    let unscale = f64::from_bits(((1023 - shift) as u64) << 52);
    let mut integers = [0; N];
    // The bits of all differences between a number and its integer scaled back, which is zero for a
    // multiple alone: one that underflowed to zero is none, and a NaN or an infinity gives a NaN.
    let mut differences = 0;
    for i in 0..N {
        let shifted = values[i] * scale + TO_INTEGER;
        differences |= ((shifted - TO_INTEGER) * unscale - values[i]).to_bits();
        integers[i] = shifted.to_bits().wrapping_sub(TO_INTEGER.to_bits()) as i64;
    }
    (differences == 0).then_some((integers, -i64::from(shift)))
}

#[inline(always)]
fn minus(a: [i64; 3], b: [i64; 3]) -> [i64; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

#[inline(always)]
fn cross(a: [i64; 3], b: [i64; 3]) -> [i64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

#[inline(always)]
fn wide_dot(a: [i64; 3], b: [i64; 3]) -> i128 {
    let product = |i: usize| i128::from(a[i]) * i128::from(b[i]);
    product(0) + product(1) + product(2)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::oracle::define;

    #[test]
    fn the_grid_holds_thirty_bits_and_no_more() {
        let most = ((1u64 << 30) - 1) as f64;
        assert!(on_grid([most, 1.0]).is_some());
        assert!(on_grid([most + 1.0, 1.0]).is_none(), "31 bits");
        assert!(on_grid([most, 0.5]).is_none());
        assert_eq!(on_grid([0.75, -0.5]), Some(([3 << 28, -2 << 28], -30)));
        assert!(on_grid([1e300, 5e-324]).is_none(), "underflow is noticed");
        assert_eq!(on_grid([1.0, 0.0, -0.0]), Some(([1 << 29, 0, 0], -29)));
    }

    #[test]
    fn what_is_no_number_is_on_no_grid() {
        for zeros in [[0.0, -0.0], [0.0; 2], [-0.0; 2]] {
            assert!(on_grid(zeros).is_none(), "zeros have no exponent");
        }
        for wrong in [f64::NAN, -f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            for i in 0..12 {
                for others in [1.0, 0.0] {
                    let mut values = [others; 12];
                    values[i] = wrong;
                    assert!(on_grid(values).is_none(), "{wrong} at {i}");
                }
            }
            assert!(on_grid([wrong; 3]).is_none(), "{wrong} alone");
        }
    }

    #[test]
    fn the_largest_coordinates_do_not_overflow() {
        let m = ((1u64 << 30) - 1) as f64;
        for signs in 0u32..1 << 15 {
            if signs % 37 != 0 {
                continue;
            }
            let at = |k: usize| if signs >> k & 1 == 0 { m } else { -m };
            let vector = |k: usize| [at(3 * k), at(3 * k + 1), at(3 * k + 2)];
            let case = Case::<f64>::new(vector(0), vector(1), [vector(2), vector(3), vector(4)]);
            let found = decide(&case).expect("on the grid");
            assert_eq!(found, define(&case).truth, "{signs:b}");
        }
    }
}
