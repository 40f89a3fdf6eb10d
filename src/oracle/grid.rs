//! The layers of machine integers. Where all positions are multiples of one power of two below 2^[`Width::BITS`]
//! times it, and so are the direction's coordinates of another, every predicate is computed exactly, and zero
//! is zero. [`Narrow`] is for small lattices; [`Wide`] holds full mantissas of `f64` whose exponents lie near each
//! other.
//!
//! With n bits a coordinate is below 2^n, a difference below 2^(n+1), a minor of differences and the normal
//! below 2^(2n+3), and a determinant of differences below 2^(3n+6).

use super::contact;
use super::integer::{Interval, Number};
use super::signs::Signs;
use super::wide::I192;
use crate::case::Case;
use crate::truth::{Contact, ContactKind, Feature, Truth};
use num_bigint::BigInt;
use std::cmp::Ordering;
use std::ops::{Add, Sub};

/// Integers for coordinates of some bits. Coordinates and differences are `i64`.
pub(super) trait Width {
    /// Bits of a coordinate.
    const BITS: i32;
    /// How many numbers are rounded before it is asked whether they are on the grid.
    const AT_ONCE: usize;
    /// Holds a minor, and a sum of three.
    type Minor: Number + Copy + Add<Output = Self::Minor> + Sub<Output = Self::Minor>;
    /// Holds a determinant.
    type Determinant: Number
        + Copy
        + Add<Output = Self::Determinant>
        + Sub<Output = Self::Determinant>;

    /// A float below 2^[`Width::BITS`] as an integer, and that again as a float: the same if it was one.
    fn rounded(x: f64) -> (i64, f64);
    /// The product of two differences.
    fn product(a: i64, b: i64) -> Self::Minor;
    /// The product of a difference and a minor.
    fn wide_product(a: i64, b: Self::Minor) -> Self::Determinant;
    /// The contact of a line that holds part of the triangle, in whatever integers.
    fn contact(
        interval: &Interval,
        d: [i64; 3],
        vertices: [[i64; 3]; 3],
        n: [Self::Minor; 3],
    ) -> Contact;
}

/// 30 bits: minors in 64, determinants in 128. What n bits are said to need above is a little more than they do:
/// products of two differences below 2^31 are below 2^62, the difference of two and the normal, which is one,
/// below 2^63.
pub(super) struct Narrow;

impl Width for Narrow {
    const BITS: i32 = 30;
    // Vectors.
    const AT_ONCE: usize = 12;
    type Minor = i64;
    type Determinant = i128;

    #[inline(always)]
    fn rounded(x: f64) -> (i64, f64) {
        /// Adding and subtracting it rounds a number below 2^51 to an integer; the sum's low bits are it.
        const TO_INTEGER: f64 = 1.5 * (1u64 << 52) as f64;
        let shifted = x + TO_INTEGER;
        let integer = shifted.to_bits().wrapping_sub(TO_INTEGER.to_bits()) as i64;
        (integer, shifted - TO_INTEGER)
    }
    #[inline(always)]
    fn product(a: i64, b: i64) -> i64 {
        a * b
    }
    #[inline(always)]
    fn wide_product(a: i64, b: i64) -> i128 {
        i128::from(a) * i128::from(b)
    }
    fn contact(interval: &Interval, d: [i64; 3], vertices: [[i64; 3]; 3], n: [i64; 3]) -> Contact {
        let wide = |v: [i64; 3]| v.map(i128::from);
        let [a, b, c] = vertices.map(wide);
        contact::decide(interval, &wide(d), [&a, &b, &c], &wide(n))
    }
}

/// 61 bits: minors in 128, determinants in 192.
pub(super) struct Wide;

impl Width for Wide {
    const BITS: i32 = 61;
    // Most of what is on no grid shows it at its first points.
    const AT_ONCE: usize = 3;
    type Minor = i128;
    type Determinant = I192;

    #[inline(always)]
    fn rounded(x: f64) -> (i64, f64) {
        let integer = x as i64;
        (integer, integer as f64)
    }
    #[inline(always)]
    fn product(a: i64, b: i64) -> i128 {
        i128::from(a) * i128::from(b)
    }
    #[inline(always)]
    fn wide_product(a: i64, b: i128) -> I192 {
        I192::product(a, b)
    }
    fn contact(interval: &Interval, d: [i64; 3], vertices: [[i64; 3]; 3], n: [i128; 3]) -> Contact {
        let [a, b, c] = vertices.map(|v| v.map(BigInt::from));
        contact::decide(interval, &d.map(BigInt::from), [&a, &b, &c], &n.map(BigInt::from))
    }
}

/// The truth, if the coordinates lie on such a grid and the case is valid: a NaN, an infinity and a
/// direction of zero are on no grid.
#[inline(always)]
pub(super) fn decide<W: Width>(case: &Case<f64>) -> Option<Truth> {
    let ordered = case.ray.t_min <= case.ray.t_max;
    if !ordered {
        return None;
    }
    let [o, d, a, b, c] = case.vectors();
    let mut flat_positions = [0.0; 12];
    flat_positions.copy_from_slice([o, a, b, c].as_flattened());
    let (positions, p) = on_grid::<W, 12>(flat_positions)?;
    let (d, q) = on_grid::<W, 3>(d)?;
    let at = |k: usize| [positions[3 * k], positions[3 * k + 1], positions[3 * k + 2]];
    let [a, b, c] = [minus(at(1), at(0)), minus(at(2), at(0)), minus(at(3), at(0))];
    let (bc, ca, ab) = (cross::<W>(b, c), cross::<W>(c, a), cross::<W>(a, b));
    // (b-a)×(c-a), which is the sum of all three; that of two is (B-A)×C, no larger.
    let normal = [0, 1, 2].map(|i| bc[i] + ca[i] + ab[i]);
    let capital_d = wide_dot::<W>(d, normal);
    let capital_t = wide_dot::<W>(a, bc);
    let interval = Interval::new(case, p - q);
    if capital_d.is_zero() {
        return Some(flat::<W>(&interval, d, [a, b, c], normal, capital_t));
    }
    // The negated weights, whose sum is D.
    let (u, v) = (wide_dot::<W>(d, bc), wide_dot::<W>(d, ca));
    let weights = [u, v, capital_d - u - v];
    let signs = Signs {
        d: capital_d.sign(),
        weights: weights.map(|x| x.sign().reverse()),
        t: capital_t.sign(),
        from_min: interval.compare_start(&capital_t, &capital_d),
        from_max: interval.compare_end(&capital_t, &capital_d),
    };
    Some(signs.truth())
}

/// Lines parallel to the plane, and triangles without area.
#[inline(never)]
fn flat<W: Width>(
    interval: &Interval,
    d: [i64; 3],
    vertices: [[i64; 3]; 3],
    n: [W::Minor; 3],
    capital_t: W::Determinant,
) -> Truth {
    let degenerate = n.iter().all(Number::is_zero);
    if !degenerate && !capital_t.is_zero() {
        return Truth::Parallel;
    }
    if !degenerate && interval.is_default() {
        return Truth::Coplanar(coplanar_contact::<W>(d, vertices, n));
    }
    let contact = W::contact(interval, d, vertices, n);
    if degenerate { Truth::Degenerate(contact) } else { Truth::Coplanar(contact) }
}

/// The contact on [0, inf) of a line in the plane of a triangle with area. The line meets the boundary
/// nowhere, at one vertex, or at two points of different t, so the signs of their t tell all. Tables for
/// branches: the sides of the vertices are as random as the cases.
fn coplanar_contact<W: Width>(d: [i64; 3], vertices: [[i64; 3]; 3], n: [W::Minor; 3]) -> Contact {
    let k = (0..3).find(|&k| !n[k].is_zero()).expect("a triangle with area");
    let m = (0..3).find(|&m| d[m] != 0).expect("a direction that is not zero");
    // The side of the line that each vertex is on: component k of d × vertex.
    let (i, j) = ((k + 1) % 3, (k + 2) % 3);
    let side = vertices.map(|v| W::product(d[i], v[j]) - W::product(d[j], v[i]));
    let digit = |sign: Ordering| (sign as i8 + 1) as usize;
    let [first, second, third] = side.map(|side| digit(side.sign()));
    let met = &MET[9 * first + 3 * second + third];
    // t of the point between v and w, from the sides x and y: (y·v - x·w) / (y - x), over d.
    let t_sign = |(v, w): (usize, usize)| {
        let (x, y) = (side[v], side[w]);
        let numerator = W::wide_product(vertices[v][m], y) - W::wide_product(vertices[w][m], x);
        let sign = [numerator.sign(), (y - x).sign(), d[m].cmp(&0)];
        sign.iter().map(|sign| *sign as i8).product::<i8>().cmp(&0)
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

/// Numbers, not all zero, as integers below 2^[`Width::BITS`] times a power of two, and its exponent.
#[inline(always)]
fn on_grid<W: Width, const N: usize>(values: [f64; N]) -> Option<([i64; N], i64)> {
    // Four maxima side by side, so that none waits for the one before.
    let larger = |m: f64, x: f64| if x > m { x } else { m };
    let mut maxima = [0.0; 4];
    for (i, x) in values.into_iter().enumerate() {
        maxima[i % 4] = larger(maxima[i % 4], x.abs());
    }
    let largest = larger(larger(maxima[0], maxima[1]), larger(maxima[2], maxima[3]));
    let exponent = (largest.to_bits() >> 52) as i32 - 1023;
    let shift = W::BITS - 1 - exponent;
    // The scale must be a normal number; zeros and subnormal numbers alone are for the layers behind.
    if !(-1000..=1000).contains(&shift) {
        return None;
    }
    let scale = f64::from_bits(((1023 + shift) as u64) << 52);
    let unscale = f64::from_bits(((1023 - shift) as u64) << 52);
    let mut integers = [0; N];
    // The bits of all differences between a number and its integer scaled back, which is zero for a
    // multiple alone: one that underflowed to zero is none, and a NaN or an infinity gives a NaN.
    for start in (0..N).step_by(W::AT_ONCE) {
        let mut differences = 0;
        for i in start..N.min(start + W::AT_ONCE) {
            let (integer, float) = W::rounded(values[i] * scale);
            differences |= (float * unscale - values[i]).to_bits();
            integers[i] = integer;
        }
        if differences != 0 {
            return None;
        }
    }
    Some((integers, -i64::from(shift)))
}

#[inline(always)]
fn minus(a: [i64; 3], b: [i64; 3]) -> [i64; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

#[inline(always)]
fn cross<W: Width>(a: [i64; 3], b: [i64; 3]) -> [W::Minor; 3] {
    let minor = |i: usize, j: usize| W::product(a[i], b[j]) - W::product(a[j], b[i]);
    [minor(1, 2), minor(2, 0), minor(0, 1)]
}

#[inline(always)]
fn wide_dot<W: Width>(a: [i64; 3], b: [W::Minor; 3]) -> W::Determinant {
    let product = |i: usize| W::wide_product(a[i], b[i]);
    product(0) + product(1) + product(2)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::case::Draw;
    use crate::oracle::define;

    #[test]
    fn a_grid_holds_its_bits_and_no_more() {
        let on_narrow = on_grid::<Narrow, 2>;
        let most = ((1u64 << 30) - 1) as f64;
        assert!(on_narrow([most, 1.0]).is_some());
        assert!(on_narrow([most + 1.0, 1.0]).is_none(), "31 bits");
        assert!(on_narrow([most, 0.5]).is_none());
        assert_eq!(on_narrow([0.75, -0.5]), Some(([3 << 28, -2 << 28], -30)));
        assert!(on_narrow([1e300, 5e-324]).is_none(), "underflow is noticed");
        assert_eq!(on_narrow([1.0, -0.0]), Some(([1 << 29, 0], -29)));
        let on_wide = on_grid::<Wide, 2>;
        let most = 2f64.powi(60);
        assert_eq!(on_wide([most, -1.0]), Some(([1 << 60, -1], 0)));
        assert_eq!(on_wide([2.0 * most, 1.0]), None, "62 bits");
        assert_eq!(on_wide([most.next_up(), 0.5]), None);
        assert_eq!(
            on_wide([-(2.0 * most).next_down(), 1.0]),
            Some(([-(((1 << 53) - 1) << 8), 1], 0))
        );
        assert!(on_wide([1e300, 5e-324]).is_none(), "underflow is noticed");
        assert_eq!(on_wide([0.0, 0.1]).unwrap().0, [0, (0.1f64 * 2f64.powi(64)) as i64]);
    }

    fn refuses_what_is_no_number<W: Width>() {
        for zeros in [[0.0, -0.0], [0.0; 2], [-0.0; 2]] {
            assert!(on_grid::<W, 2>(zeros).is_none(), "zeros have no exponent");
        }
        for wrong in [f64::NAN, -f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            for i in 0..12 {
                for others in [1.0, 0.0] {
                    let mut values = [others; 12];
                    values[i] = wrong;
                    assert!(on_grid::<W, 12>(values).is_none(), "{wrong} at {i}");
                }
            }
            assert!(on_grid::<W, 3>([wrong; 3]).is_none(), "{wrong} alone");
        }
    }

    #[test]
    fn what_is_no_number_is_on_no_grid() {
        refuses_what_is_no_number::<Narrow>();
        refuses_what_is_no_number::<Wide>();
    }

    /// All coordinates at plus or minus `most`: signs that make every sum as large as it gets are among them.
    fn holds_its_largest_coordinates<W: Width>(most: f64) {
        for signs in (0u32..1 << 15).filter(|signs| signs % 37 == 0) {
            let at = |k: usize| if signs >> k & 1 == 0 { most } else { -most };
            let vector = |k: usize| [at(3 * k), at(3 * k + 1), at(3 * k + 2)];
            let case = Case::<f64>::new(vector(0), vector(1), [vector(2), vector(3), vector(4)]);
            let found = decide::<W>(&case).expect("on the grid");
            assert_eq!(found, define(&case).truth, "{signs:b}");
        }
    }

    #[test]
    fn the_largest_coordinates_do_not_overflow() {
        holds_its_largest_coordinates::<Narrow>(((1u64 << 30) - 1) as f64);
        holds_its_largest_coordinates::<Wide>(2f64.powi(61).next_down());
    }

    #[test]
    fn wide_integers_agree_with_the_definition_where_determinants_vanish() {
        let (mut flat, mut edges, mut others) = (0, 0, 0);
        for index in 0..3000 {
            let mut draw = Draw::new("wide grid", 1, index);
            // Points of 50 bits, so that sums of a few differences are floats.
            let [a, b, c, any] = [0; 4].map(|_| draw.lattice_point(1 << 49));
            let mut small = || draw.integer(-2, 2);
            // Often two of one vertex: no area, or the origin at a vertex.
            let c = if small() == 2 { b } else { c };
            let mut of_edges = || {
                let (i, j) = (small(), small());
                [0, 1, 2].map(|k| i * (b[k] - a[k]) + j * (c[k] - a[k]))
            };
            let (direction, step) = (of_edges(), of_edges());
            let from = draw.pick(&[a, c]);
            let o = if draw.coin() { [0, 1, 2].map(|k| from[k] + step[k]) } else { any };
            let direction =
                if draw.coin() { direction } else { [0, 1, 2].map(|k| (a[k] + b[k]) / 2 - o[k]) };
            let [o, d, a, b, c] = [o, direction, a, b, c].map(|v| v.map(|x| x as f64));
            let ends = [0.0, f64::INFINITY, 1.0, 0.5, -1.0, f64::NEG_INFINITY, 2.0];
            let case = Case::<f64>::new(o, d, [a, b, c]);
            for case in [case, case.on(draw.pick(&ends), draw.pick(&ends))] {
                let expected = define(&case).truth;
                let found = decide::<Wide>(&case);
                if expected == Truth::Invalid {
                    assert_eq!(found, None, "{case:?}");
                    continue;
                }
                assert_eq!(found, Some(expected), "{case:?}");
                match expected {
                    Truth::Transversal(crossing) => match crossing.feature {
                        Feature::Interior | Feature::Outside => others += 1,
                        _ => edges += 1,
                    },
                    _ => flat += 1,
                }
            }
        }
        assert!(flat > 1000 && edges > 100 && others > 500, "{flat} {edges} {others}");
    }
}
