//! The layers of machine integers. Where all positions are integers below 2^[`Width::BITS`] times one power of two,
//! and the direction's coordinates are such integers times another, every predicate is computed exactly, and zero
//! is zero. `Narrow` is for small lattices; `Wide` holds full mantissas of `f64` whose exponents lie near each
//! other.

use super::contact;
use super::coplanar::coplanar_contact;
use super::integer::{ExactInteger, RayInterval};
use super::signs::DecidingSigns;
use super::width::Width;
use crate::case::Case;
use crate::truth::Truth;

/// The truth, if the coordinates lie on such a grid and the case is valid: a NaN, an infinity and a
/// direction of zero are on no grid.
#[inline(always)]
pub(super) fn decide<W: Width>(case: &Case<f64>) -> Option<Truth> {
    let is_ordered = case.ray.t_min <= case.ray.t_max;
    if !is_ordered {
        return None;
    }
    let [o, d, a, b, c] = case.vectors();
    let mut coordinates = [0.0; 12];
    coordinates.copy_from_slice([o, a, b, c].as_flattened());
    let (positions, p) = on_grid::<W, 12>(coordinates)?;
    let (direction, q) = on_grid::<W, 3>(d)?;
    let origin = point(&positions, 0);
    let a = minus(point(&positions, 1), origin);
    let b = minus(point(&positions, 2), origin);
    let c = minus(point(&positions, 3), origin);
    let bc = cross::<W>(b, c);
    let ca = cross::<W>(c, a);
    let ab = cross::<W>(a, b);
    // (b-a)×(c-a) is the sum of all three. The sum of the first two, (B-A)×C, is no larger, so nothing overflows.
    let normal = [
        bc[0] + ca[0] + ab[0],
        bc[1] + ca[1] + ab[1],
        bc[2] + ca[2] + ab[2],
    ];
    let capital_d = wide_dot::<W>(direction, normal);
    let capital_t = wide_dot::<W>(a, bc);
    let interval = RayInterval::new(case, p - q);
    if capital_d.is_zero() {
        let is_off_plane = !capital_t.is_zero();
        return Some(flat::<W>(
            &interval,
            direction,
            [a, b, c],
            normal,
            is_off_plane,
        ));
    }
    // -U, -V and -W. Their sum is D.
    let minus_u = wide_dot::<W>(direction, bc);
    let minus_v = wide_dot::<W>(direction, ca);
    let minus_w = capital_d - minus_u - minus_v;
    let signs = DecidingSigns {
        d: capital_d.sign(),
        weights: [
            minus_u.sign().reverse(),
            minus_v.sign().reverse(),
            minus_w.sign().reverse(),
        ],
        t: capital_t.sign(),
        from_min: interval.compare_start(&capital_t, &capital_d),
        from_max: interval.compare_end(&capital_t, &capital_d),
    };
    Some(signs.truth())
}

/// The truth of a line parallel to the plane, or of a triangle without area.
#[inline(never)]
fn flat<W: Width>(
    interval: &RayInterval,
    direction: [i64; 3],
    vertices: [[i64; 3]; 3],
    normal: [W::Minor; 3],
    is_off_plane: bool,
) -> Truth {
    let degenerate = normal.iter().all(ExactInteger::is_zero);
    if !degenerate && is_off_plane {
        return Truth::Parallel;
    }
    if !degenerate && interval.is_default() {
        return Truth::Coplanar(coplanar_contact::<W>(direction, vertices, normal));
    }
    let vertices = vertices.map(|vertex| vertex.map(W::Contact::from));
    let contact = contact::decide(
        interval,
        &direction.map(W::Contact::from),
        vertices.each_ref(),
        &normal.map(W::Contact::from),
    );
    if degenerate {
        Truth::Degenerate(contact)
    } else {
        Truth::Coplanar(contact)
    }
}

/// Numbers, not all zero, as integers below 2^[`Width::BITS`] times a power of two, and its exponent.
#[inline(always)]
fn on_grid<W: Width, const N: usize>(values: [f64; N]) -> Option<([i64; N], i64)> {
    let exponent = (largest(values).to_bits() >> 52) as i32 - 1023;
    let shift = W::BITS - 1 - exponent;
    // The scale must be a normal number. Zeros and subnormal numbers alone are left to the next layers.
    if !(-1000..=1000).contains(&shift) {
        return None;
    }
    let scale = power_of_two(shift);
    let unscale = power_of_two(-shift);
    let mut integers = [0; N];
    // A number is on the grid if its integer, scaled back, differs from it by zero. A number that underflowed to zero
    // differs by itself, and a NaN or an infinity by a NaN. The bits of all differences are joined: one branch asks.
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

/// The largest absolute value; a NaN counts as nothing.
#[inline(always)]
fn largest<const N: usize>(values: [f64; N]) -> f64 {
    // Four maxima side by side, so that none waits for the one before.
    let mut maxima = [0.0; 4];
    for (i, x) in values.into_iter().enumerate() {
        maxima[i % 4] = larger(maxima[i % 4], x.abs());
    }
    let first = larger(maxima[0], maxima[1]);
    let second = larger(maxima[2], maxima[3]);
    larger(first, second)
}

#[inline(always)]
fn larger(m: f64, x: f64) -> f64 {
    if x > m { x } else { m }
}

/// 2 to a power, which is a normal number.
#[inline(always)]
fn power_of_two(exponent: i32) -> f64 {
    f64::from_bits(((1023 + exponent) as u64) << 52)
}

/// Point `k`; the coordinates of all points stand one after the other.
#[inline(always)]
fn point(coordinates: &[i64; 12], k: usize) -> [i64; 3] {
    let first = 3 * k;
    [
        coordinates[first],
        coordinates[first + 1],
        coordinates[first + 2],
    ]
}

#[inline(always)]
fn minus(a: [i64; 3], b: [i64; 3]) -> [i64; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

#[inline(always)]
fn cross<W: Width>(a: [i64; 3], b: [i64; 3]) -> [W::Minor; 3] {
    [
        minor::<W>(a, b, 1, 2),
        minor::<W>(a, b, 2, 0),
        minor::<W>(a, b, 0, 1),
    ]
}

#[inline(always)]
fn minor<W: Width>(a: [i64; 3], b: [i64; 3], i: usize, j: usize) -> W::Minor {
    W::product(a[i], b[j]) - W::product(a[j], b[i])
}

#[inline(always)]
fn wide_dot<W: Width>(a: [i64; 3], b: [W::Minor; 3]) -> W::Determinant {
    let x = W::wide_product(a[0], b[0]);
    let y = W::wide_product(a[1], b[1]);
    let z = W::wide_product(a[2], b[2]);
    x + y + z
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::case::Draw;
    use crate::oracle::define;
    use crate::oracle::width::{Narrow, Wide};
    use crate::truth::Feature;

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
        assert_eq!(
            on_wide([0.0, 0.1]).unwrap().0,
            [0, (0.1f64 * 2f64.powi(64)) as i64]
        );
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

    /// The origin and two vertices on a line, whose direction has the last bit beside the first.
    fn reads_the_last_bit_of_a_direction<W: Width>() {
        let half = 2f64.powi(W::BITS - 1);
        let on_line = |steps: f64| [steps, (steps - 1.5) * half, 0.0];
        for [o, a, b] in [[0.0, 1.0, 2.0], [3.0, 1.0, 2.0], [1.0, 0.0, 2.0]] {
            for sign in [1.0, -1.0] {
                let triangle = [on_line(a), on_line(b), [0.0, 0.0, half]];
                let case = Case::<f64>::new(on_line(o), [sign, sign * half, 0.0], triangle);
                assert_eq!(decide::<W>(&case), Some(define(&case).truth), "{case:?}");
            }
        }
    }

    #[test]
    fn a_component_of_one_unit_points_forwards_or_backwards() {
        reads_the_last_bit_of_a_direction::<Narrow>();
        reads_the_last_bit_of_a_direction::<Wide>();
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
            let o = if draw.coin() {
                [0, 1, 2].map(|k| from[k] + step[k])
            } else {
                any
            };
            let direction = if draw.coin() {
                direction
            } else {
                [0, 1, 2].map(|k| (a[k] + b[k]) / 2 - o[k])
            };
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
        assert!(
            flat > 1000 && edges > 100 && others > 500,
            "{flat} {edges} {others}"
        );
    }
}
