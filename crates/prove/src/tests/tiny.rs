//! Formats of a few digits, where every input of a slice can be tried. Every number here is a small
//! multiple of a small power of two, so that f64 holds it, and exact sums and products, exactly.

use super::super::dyadic::Big;
use super::super::{Domain, Dyadic, Format, Prover, relative};
use super::{orient2d, orient3d, recorded};
use crate::arith::recorded::{Operation, Place};
use crate::kernel::Path;
use num_traits::ToPrimitive;
use std::collections::BTreeMap;

fn format(digits: u32) -> Format {
    Format {
        digits,
        smallest: -200,
        largest: 200,
    }
}

/// Rounded to so many digits, ties to even.
pub fn round(x: f64, digits: u32) -> f64 {
    if digits == 53 {
        return x;
    }
    let drop = 53 - digits;
    let bits = x.to_bits();
    let half = (1 << (drop - 1)) - 1 + (bits >> drop & 1);
    f64::from_bits((bits + half) >> drop << drop)
}

/// A polynomial's computed and exact value and its permanents, exact and computed.
struct Run {
    computed: Vec<f64>,
    exact: Vec<f64>,
    permanent: Vec<f64>,
    rounded: Vec<f64>,
}

impl Run {
    fn new(path: &Path) -> Run {
        let zeros = vec![0.0; path.operations.len()];
        let [computed, exact, permanent, rounded] = [(); 4].map(|()| zeros.clone());
        Run {
            computed,
            exact,
            permanent,
            rounded,
        }
    }

    fn set(&mut self, at: usize, x: f64) {
        (self.computed[at], self.exact[at]) = (x, x);
        (self.permanent[at], self.rounded[at]) = (x.abs(), x.abs());
    }

    fn step(&mut self, path: &Path, at: usize, digits: u32) {
        let Run {
            computed,
            exact,
            permanent,
            rounded,
        } = self;
        let is_input = |p: Place| matches!(path.operations[p as usize], Operation::Input(_));
        match path.operations[at] {
            Operation::Input(_) => {}
            Operation::Mul(a, b) => {
                let (a, b) = (a as usize, b as usize);
                computed[at] = round(computed[a] * computed[b], digits);
                exact[at] = exact[a] * exact[b];
                permanent[at] = permanent[a] * permanent[b];
                rounded[at] = round(rounded[a] * rounded[b], digits);
            }
            Operation::Sub(a, b) if is_input(a) && is_input(b) => {
                exact[at] = exact[a as usize] - exact[b as usize];
                computed[at] = round(exact[at], digits);
                (permanent[at], rounded[at]) = (exact[at].abs(), computed[at].abs());
            }
            Operation::Add(a, b) | Operation::Sub(a, b) => {
                let minus = matches!(path.operations[at], Operation::Sub(..));
                let sign = if minus { -1.0 } else { 1.0 };
                let (a, b) = (a as usize, b as usize);
                computed[at] = round(computed[a] + sign * computed[b], digits);
                exact[at] = exact[a] + sign * exact[b];
                permanent[at] = permanent[a] + permanent[b];
                rounded[at] = round(rounded[a] + rounded[b], digits);
            }
            other => panic!("{other:?}"),
        }
    }
}

/// The largest error beside its bounds: as a share of the bound where no difference is larger than the
/// largest one of the slice, and as one of the bound by the permanent.
#[derive(Default)]
struct Worst {
    of_bound: f64,
    of_permanent: f64,
    /// The largest share of the computed permanent that a value with the wrong sign has, in units of u.
    of_wrong_sign: f64,
}

impl Worst {
    /// Every choice of coordinates out of `values`.
    fn include(&mut self, path: &Path, place: Place, values: &[f64], digits: u32) {
        let format = format(digits);
        let inputs: Vec<usize> = (0..path.operations.len())
            .filter(|at| matches!(path.operations[*at], Operation::Input(_)))
            .collect();
        let (low, high) = values
            .iter()
            .fold((0.0f64, 0.0f64), |(l, h), x| (l.min(*x), h.max(*x)));
        let size = Dyadic::from_f64(high - low).expect("finite");
        let domain = Domain {
            edge: size,
            reach: size,
            ..Domain::UNIT
        };
        let mut prover = Prover::new(path, domain, format);
        let bound = prover.bound(place).expect("a polynomial").error.to_f64();
        let before_last = prover
            .bound_before_last(place)
            .expect("a polynomial")
            .to_f64();
        let form = relative(path, place, domain, format).expect("a polynomial");
        let factor = form.factor.to_f64();
        let mut run = Run::new(path);
        let last = place as usize;
        for choice in 0..values.len().pow(inputs.len() as u32) {
            let mut rest = choice;
            for at in &inputs {
                run.set(*at, values[rest % values.len()]);
                rest /= values.len();
            }
            for at in 0..=last {
                run.step(path, at, digits);
            }
            let (computed, exact) = (run.computed[last], run.exact[last]);
            // A wrong sign and a zero are only as wrong as what the last operation rounds.
            assert!(computed * exact >= 0.0 || exact.abs() <= before_last);
            assert!(exact != 0.0 || computed.abs() <= before_last);
            let error = (computed - exact).abs();
            self.of_bound = self.of_bound.max(error / bound);
            if run.permanent[last] > 0.0 {
                self.of_permanent = self
                    .of_permanent
                    .max(error / (run.permanent[last] * factor));
            }
            if computed != 0.0 && computed * exact <= 0.0 {
                let share = computed.abs() / run.rounded[last];
                self.of_wrong_sign = self.of_wrong_sign.max(share / format.unit().to_f64());
            }
        }
    }
}

/// Slices in which a search found large errors: the dimension, the digits, and the coordinates as whole
/// numbers and a power of two.
const SLICES: &[(u8, u32, &[i32], i32)] = &[
    (3, 3, &[-8, 7, 6], -5),
    (3, 3, &[3, -7, 2], -4),
    (3, 3, &[-7, -32, 7], -7),
    (3, 4, &[13, 16, -26], -8),
    (3, 4, &[18, -20, 7], -7),
    (3, 4, &[-80, -14, -11], -8),
    (3, 5, &[-30, -38, 17], -8),
    (3, 5, &[19, 56, 62], -9),
    (3, 5, &[13, 58, 19], -8),
    (2, 3, &[-14, -7, 16, 2, 12, -3], -6),
    (2, 3, &[-5, -40, -20, 6, -56, 32], -7),
    (2, 3, &[8, -28, -7, 6, -5, -4], -7),
    (2, 4, &[5, 14, -28, 13, -24, 15], -6),
    (2, 4, &[-13, 120, -64, -88, -18, -8], -8),
    (2, 4, &[11, -13, 32, -52, 9, 13], -7),
    (2, 5, &[76, 84, -72, -76, 100, 31], -9),
    (2, 5, &[-52, -54, 15, -116, 104, -40], -8),
    (2, 5, &[62, 13, 11, -24, -28, -12], -8),
];

#[test]
fn no_input_of_a_slice_in_tiny_formats_passes_a_bound() {
    let (plane, space) = (recorded(orient2d), recorded(orient3d));
    for dimension in [2, 3] {
        let (path, place) = if dimension == 2 { &plane } else { &space };
        for digits in [3, 4, 5] {
            let form = relative(path, *place, Domain::UNIT, format(digits)).expect("a polynomial");
            let filter = form.filter(format(digits)) / Big::from(format(digits).unit());
            let filter = filter.to_f64().expect("small");
            let mut worst = Worst::default();
            for (_, _, values, scale) in SLICES
                .iter()
                .filter(|slice| (slice.0, slice.1) == (dimension, digits))
            {
                let values: Vec<f64> = values
                    .iter()
                    .map(|m| f64::from(*m) * 2f64.powi(*scale))
                    .collect();
                worst.include(path, *place, &values, digits);
            }
            let Worst {
                of_bound,
                of_permanent,
                of_wrong_sign,
            } = worst;
            println!(
                "orient{dimension}d p={digits}: {of_bound:.3} of the bound, {of_permanent:.3} of the one \
                 by the permanent; a wrong sign at {of_wrong_sign:.3} u, filter {filter:.3} u"
            );
            assert!(of_bound <= 1.0 && of_permanent <= 1.0 && of_wrong_sign < filter);
            assert!(of_bound > 0.18 && of_permanent > 0.27 && of_wrong_sign > 1.5);
        }
    }
}

/// The least and the largest exact difference of two floats that is rounded to m of p digits: a float
/// minus a small one. A tie goes to the even number.
fn ends(m: f64, digits: u32) -> [f64; 2] {
    let unit = 2f64.powi(-(digits as i32));
    let half = if m % 2.0 == 0.0 {
        0.5
    } else {
        0.5 * (1.0 - unit)
    };
    let below = if m == 2f64.powi(digits as i32 - 1) {
        0.25
    } else {
        half
    };
    [m - below, m + half]
}

/// The largest share of the computed permanent that orient2d computes with a wrong sign, in units of u,
/// over all inputs without underflow: products t1 and t2, each with the least and the largest exact
/// product behind it. It is at most this, for two differences may not reach their ends at once.
fn largest_wrong_sign(digits: u32) -> f64 {
    let first = 1u64 << (digits - 1);
    let mut products: BTreeMap<u64, [f64; 2]> = BTreeMap::new();
    for a in first..2 * first {
        for b in a..2 * first {
            let (a, b) = (a as f64, b as f64);
            let ([a0, a1], [b0, b1]) = (ends(a, digits), ends(b, digits));
            let known = products
                .entry(round(a * b, digits) as u64)
                .or_insert([f64::MAX, 0.0]);
            *known = [known[0].min(a0 * b0), known[1].max(a1 * b1)];
        }
    }
    let mut worst: f64 = 0.0;
    for (large, [least, _]) in &products {
        // Of numbers that differ by more than a binade the signs are right.
        for scale in [0.5, 1.0, 2.0] {
            for (small, [_, most]) in &products {
                let (t1, t2) = (*large as f64, *small as f64 * scale);
                if t2 < t1 && *least <= most * scale {
                    worst = worst.max(round(t1 - t2, digits) / round(t1 + t2, digits));
                }
            }
        }
    }
    worst * 2f64.powi(digits as i32)
}

/// Ozaki, Bünger, Ogita, Oishi and Rump 2016: θ = 3u - (φ - 22)u², φ = 2⌊(-1 + √(4/u + 45))/4⌋.
#[test]
fn ozakis_filter_holds_for_every_input_of_half_precision() {
    for digits in [5, 8, 11] {
        let unit = 2f64.powi(-(digits as i32));
        let phi = 2.0 * ((-1.0 + (4.0 / unit + 45.0).sqrt()) / 4.0).floor();
        let theta = 3.0 - (phi - 22.0) * unit;
        let worst = largest_wrong_sign(digits);
        println!("p={digits}: phi {phi}, theta {theta:.5} u, a wrong sign at most at {worst:.5} u");
        assert!(worst < theta * (1.0 - 2.0 * unit) && worst > 2.0);
    }
}
