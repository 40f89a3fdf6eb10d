//! Floor 4: the oracle held to its definition, and to integer arithmetic that shares nothing with it.

#![forbid(unsafe_code)]

use crate::arith::{Float, scale_by_power_of_two};
use crate::case::{Case, Draw, Parameters};
use crate::family::{Family, LATTICE_SIZE, apply, find};
use crate::kernel::Scalar;
use crate::oracle::{Definition, Layers, define, truth_counted};
use crate::truth::{Crossing, Facing, Feature, Place, Truth};
use num_traits::ToPrimitive;
use rayon::prelude::*;
use std::cmp::Ordering;

/// What one check found.
#[derive(Clone, Debug, Default)]
pub struct Check {
    /// Cases compared.
    pub cases: u64,
    /// Cases on which the oracle differs.
    pub differences: u64,
    /// The first of them by index: what it is, and both truths.
    pub first: Option<(u64, String)>,
    /// Which layer of the oracle decided.
    pub layers: Layers,
}

impl Check {
    fn compare<F: Float>(&mut self, index: u64, case: &Case<F>, expected: Truth) {
        let found = truth_counted(case, &mut self.layers);
        self.cases += 1;
        if found != expected {
            self.differences += 1;
            let message =
                format!("the oracle says '{found}', should say '{expected}': {}", case.hex());
            self.propose(index, message);
        }
    }

    fn propose(&mut self, index: u64, message: String) {
        if self.first.as_ref().is_none_or(|(first, _)| index < *first) {
            self.first = Some((index, message));
        }
    }

    fn merged(mut self, other: Check) -> Check {
        self.cases += other.cases;
        self.differences += other.differences;
        self.layers.merge(&other.layers);
        if let Some((index, message)) = other.first {
            self.propose(index, message);
        }
        self
    }
}

/// Runs a check over indices, on all cores; `advance` hears of each chunk's size.
fn over(
    indices: u64,
    advance: &(dyn Fn(u64) + Sync),
    check: impl Fn(u64, &mut Check) + Sync,
) -> Check {
    const CHUNK: u64 = 64;
    let chunk = |number: u64| {
        let range = number * CHUNK..indices.min((number + 1) * CHUNK);
        let mut sum = Check::default();
        advance(range.end - range.start);
        range.for_each(|index| check(index, &mut sum));
        sum
    };
    (0..indices.div_ceil(CHUNK)).into_par_iter().map(chunk).reduce(Check::default, Check::merged)
}

/// A family's set against the definition. Every fourth index also with the interval's ends at the
/// crossing, exact where a float is, and some ulps beside it; every fourth also scaled to where
/// products of two or three coordinates overflow or underflow in part.
pub fn family<F: Scalar>(
    family: &Family,
    seed: u64,
    indices: u64,
    advance: &(dyn Fn(u64) + Sync),
) -> Check {
    over(indices, advance, |index, check| {
        let made = family.make::<F>(&Parameters::default(), seed, index);
        for case in made.cases() {
            against_definition(index, case, check);
            if index % 4 == 1 {
                let mut draw = Draw::new("scaled", seed, index);
                let third = F::MAX_EXPONENT.div_euclid(3);
                let spread = i64::from(F::DIGITS) * 2;
                let towards = if draw.coin() { third } else { -third };
                let scale = towards + draw.integer(-spread, spread) as i32;
                let scale_direction = draw.coin();
                let mut scaled = *case;
                let parameters = Parameters { scale, scale_direction, ..Parameters::default() };
                apply(&parameters, &mut scaled);
                check.compare(index, &scaled, define(&scaled).truth);
            }
        }
    })
}

/// Cases of any finite bit patterns, and of numbers that coincide and lie at the ends of the range.
pub fn whole_range<F: Float>(seed: u64, indices: u64, advance: &(dyn Fn(u64) + Sync)) -> Check {
    let smallest = F::from_bits(1);
    let numbers = [
        F::zero(),
        -F::zero(),
        F::one(),
        -F::one(),
        F::from_f64(0.1),
        smallest,
        -smallest,
        F::infinity().offset_ulps(-1),
        -F::infinity().offset_ulps(-1),
        F::one() + F::EPSILON,
        F::from_f64(3.0),
        smallest.offset_ulps(1 << 20),
        F::from_f64(scale_by_power_of_two(1.0, F::MAX_EXPONENT)),
    ];
    over(indices, advance, |index, check| {
        let mut draw = Draw::new("whole-range", seed, index);
        let coincide = draw.coin();
        // Few numbers a case: more coincidences.
        let palette = [0; 4].map(|_| draw.pick(&numbers));
        let number = |draw: &mut Draw| {
            if coincide {
                return draw.pick(&palette);
            }
            loop {
                let x = F::from_bits(draw.bits() & (F::infinity().to_bits() << 1 | 1));
                if x.is_finite() {
                    return x;
                }
            }
        };
        let [o, d, a, b, c] = std::array::from_fn(|_| std::array::from_fn(|_| number(&mut draw)));
        against_definition(index, &Case::new(o, d, [a, b, c]), check);
    })
}

fn against_definition<F: Float>(index: u64, case: &Case<F>, check: &mut Check) {
    let definition = define(case);
    check.compare(index, case, definition.truth);
    if index.is_multiple_of(4) {
        let mut draw = Draw::new("interval", 0, index);
        if let Some(cut) = cut_at_crossing(&mut draw, case, &definition) {
            check.compare(index, &cut, define(&cut).truth);
        }
    }
}

/// The case with an interval that starts or ends at, or some ulps beside, its t.
fn cut_at_crossing<F: Float>(
    draw: &mut Draw,
    case: &Case<F>,
    definition: &Definition,
) -> Option<Case<F>> {
    let t =
        definition.exact.t.as_ref().or(definition.exact.contact_t.as_ref().map(|ends| &ends[1]));
    let near = F::from_f64(t?.to_f64()?);
    let end = near.offset_ulps(draw.integer(-2, 2));
    Some(match draw.below(3) {
        0 => case.on(end, F::infinity()),
        1 => case.on(-F::infinity(), end),
        _ => case.on(end, end),
    })
}

/// All 3^15 lattice cases against 64-bit integers. Contacts are compared with the definition at every
/// 64th index.
pub fn lattice(advance: &(dyn Fn(u64) + Sync)) -> Check {
    let family = find("lattice").expect("a family of that name");
    over(LATTICE_SIZE, advance, |index, check| {
        let made = family.make_in_order::<f32>(&Parameters::default(), index);
        let case = made.cases()[0];
        let [o, d, a, b, c] = case.vectors().map(|v| v.map(|x| x as i64));
        let expected = match lattice_truth(o, d, [a, b, c]) {
            LatticeTruth::Known(truth) => truth,
            LatticeTruth::Contact(class) => {
                let found = crate::oracle::truth(&case);
                if index.is_multiple_of(64) || found.class_name() != class {
                    define(&case).truth
                } else {
                    found
                }
            }
        };
        check.compare(index, &case, expected);
    })
}

/// What integer arithmetic knows of a lattice case.
enum LatticeTruth {
    Known(Truth),
    /// Coplanar or degenerate: the class alone.
    Contact(&'static str),
}

/// Cramer's rule for o + t d = a + u (b-a) + v (c-a), in 64-bit integers: other formulas than the
/// oracle's, and no shared code.
fn lattice_truth(o: [i64; 3], d: [i64; 3], [a, b, c]: [[i64; 3]; 3]) -> LatticeTruth {
    let minus = |p: [i64; 3], q: [i64; 3]| [p[0] - q[0], p[1] - q[1], p[2] - q[2]];
    let determinant = |p: [i64; 3], q: [i64; 3], r: [i64; 3]| {
        p[0] * q[1] * r[2] + p[1] * q[2] * r[0] + p[2] * q[0] * r[1]
            - p[2] * q[1] * r[0]
            - p[1] * q[0] * r[2]
            - p[0] * q[2] * r[1]
    };
    if d == [0; 3] {
        return LatticeTruth::Known(Truth::Invalid);
    }
    let (e, f, s, back) = (minus(b, a), minus(c, a), minus(o, a), minus([0; 3], d));
    let whole = determinant(back, e, f);
    if whole == 0 {
        let parallel_edges = (0..3).all(|i| e[i] * f[(i + 1) % 3] == e[(i + 1) % 3] * f[i]);
        return if parallel_edges {
            LatticeTruth::Contact("degenerate")
        } else if determinant(s, e, f) == 0 {
            LatticeTruth::Contact("coplanar")
        } else {
            LatticeTruth::Known(Truth::Parallel)
        };
    }
    let positive = |x: i64| x * whole.signum();
    let t = positive(determinant(s, e, f));
    let u = positive(determinant(back, s, f));
    let v = positive(determinant(back, e, s));
    let feature = match ((whole.abs() - u - v).signum(), u.signum(), v.signum()) {
        (-1, ..) | (_, -1, _) | (.., -1) => Feature::Outside,
        (1, 1, 1) => Feature::Interior,
        (0, 1, 1) => Feature::EdgeBc,
        (1, 0, 1) => Feature::EdgeCa,
        (1, 1, 0) => Feature::EdgeAb,
        (1, 0, 0) => Feature::VertexA,
        (0, 1, 0) => Feature::VertexB,
        _ => Feature::VertexC,
    };
    LatticeTruth::Known(Truth::Transversal(Crossing {
        // whole = -D.
        facing: if whole > 0 { Facing::Front } else { Facing::Back },
        place: match t.cmp(&0) {
            Ordering::Less => Place::Before,
            Ordering::Equal => Place::AtMin,
            Ordering::Greater => Place::Within,
        },
        t_sign: t.cmp(&0),
        feature,
    }))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_wrong_truth_is_counted_and_the_first_is_kept() {
        let case = Case::<f32>::new([0.0; 3], [1.0, 0.0, 0.0], [[0.0; 3]; 3]);
        let (mut left, mut right) = (Check::default(), Check::default());
        right.compare(9, &case, Truth::Parallel);
        right.compare(4, &case, Truth::Parallel);
        left.compare(5, &case, crate::oracle::truth(&case));
        let sum = left.merged(right);
        assert_eq!((sum.cases, sum.differences), (3, 2));
        assert_eq!(sum.first.as_ref().map(|(index, _)| *index), Some(4));
        assert!(sum.first.unwrap().1.contains("should say 'parallel'"));
    }
}
