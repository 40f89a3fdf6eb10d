//! The families of points, each with a promise that the exact determinant checks on every case.

use super::{BigDyadic, Dimension, Points, PointsId, ScaledPoints, predicate::Scalar};
use crate::arith::Float;
use crate::case::Draw;
use std::any::Any;
use std::cmp::Ordering;
use std::ops::RangeInclusive;

/// How a family makes its points.
trait Recipe {
    const NAME: &'static str;
    /// Raised whenever the cases change.
    const VERSION: u32 = 1;
    /// One case; `draw` is its own stream.
    fn make<F: Float>(draw: &mut Draw, dimension: Dimension) -> Points<F>;
    /// True if a case keeps the promise.
    fn keeps<F: Float>(
        dimension: Dimension,
        points: &ScaledPoints,
        determinant: &BigDyadic,
    ) -> bool;
}

/// Uniform on the grid 2^-digits in (-1, 1); in its units the determinant is odd, so not 0.
struct Generic;
/// Integers on one line (or plane), up to 2^7 or up to 2^digits: the determinant is 0.
struct Degenerate;
/// One point is a rounded combination of the others, give or take 2 ulps: abs(det) <= 2^(12-digits) m^n.
struct Near;
/// Generic or near, moved away from 0: on some axis the extent is at most 2^-6 of the distance.
struct Far;
/// Generic, degenerate or near, scaled to where products of n coordinates underflow.
struct RangeLow;
/// Generic, degenerate or near, scaled to where products of n coordinates overflow.
struct RangeHigh;

type Keeps = fn(Dimension, &ScaledPoints, &BigDyadic) -> bool;

/// A family in one scalar.
#[derive(Clone, Copy)]
struct InScalar<F> {
    make: fn(&mut Draw, Dimension) -> Points<F>,
    keeps: Keeps,
}

/// A row of the table of families.
pub struct Family {
    /// The name in tables and in case ids.
    pub name: &'static str,
    /// Part of the case ids.
    pub version: u32,
    in_f32: InScalar<f32>,
    in_f64: InScalar<f64>,
}

const fn row<R: Recipe>() -> Family {
    Family {
        name: R::NAME,
        version: R::VERSION,
        in_f32: InScalar { make: R::make::<f32>, keeps: R::keeps::<f32> },
        in_f64: InScalar { make: R::make::<f64>, keeps: R::keeps::<f64> },
    }
}

/// Every family, in the order of reports.
pub static FAMILIES: &[Family] = &[
    row::<Generic>(),
    row::<Degenerate>(),
    row::<Near>(),
    row::<Far>(),
    row::<RangeLow>(),
    row::<RangeHigh>(),
];

/// The family of a name.
pub fn find_family(name: &str) -> Option<&'static Family> {
    FAMILIES.iter().find(|family| family.name == name)
}

impl Family {
    /// Case `index` of the set of a seed: it depends on nothing else.
    pub fn make<F: Scalar>(&self, dimension: Dimension, seed: u64, index: u64) -> Points<F> {
        let stream = format!("{}:{}", dimension.name(), self.name);
        (self.recipe::<F>().make)(&mut Draw::new(&stream, seed, index), dimension)
    }

    /// True if a case keeps the promise.
    pub fn keeps<F: Scalar>(
        &self,
        dimension: Dimension,
        points: &ScaledPoints,
        determinant: &BigDyadic,
    ) -> bool {
        (self.recipe::<F>().keeps)(dimension, points, determinant)
    }

    /// How it makes and checks points of a scalar, which is one of the two.
    fn recipe<F: Scalar>(&self) -> InScalar<F> {
        let both: [&dyn Any; 2] = [&self.in_f32, &self.in_f64];
        let found = both.into_iter().find_map(|recipe| recipe.downcast_ref::<InScalar<F>>());
        *found.expect("a scalar is f32 or f64")
    }

    /// The id of a case.
    pub fn id<F: Float>(&self, dimension: Dimension, seed: u64, index: u64) -> PointsId {
        PointsId {
            dimension,
            family: self.name.to_owned(),
            version: self.version,
            scalar: F::NAME.to_owned(),
            seed,
            index,
        }
    }
}

/// An integer that every scalar up to `F` holds.
fn float<F: Float>(integer: i64) -> F {
    F::from_f64(integer as f64)
}

impl Recipe for Generic {
    const NAME: &'static str = "generic";

    fn make<F: Float>(draw: &mut Draw, dimension: Dimension) -> Points<F> {
        let bound = (1 << F::DIGITS) - 2;
        let mut integers = [[0i64; 3]; 4];
        integers.as_flattened_mut().iter_mut().for_each(|n| *n = draw.integer(-bound, bound));
        let last = integers[dimension.number()];
        // Modulo 2 the differences from the last point are the unit matrix.
        let points = Points::each(dimension, |i, axis| {
            let n = integers[i][axis];
            let parity = (last[axis] & 1) ^ i64::from(i == axis);
            float(if i == dimension.number() { n } else { (n & !1) | parity })
        });
        points.scaled(-(F::DIGITS as i32))
    }

    fn keeps<F: Float>(_: Dimension, points: &ScaledPoints, determinant: &BigDyadic) -> bool {
        determinant.sign() != Ordering::Equal && points.largest_exponent().is_some_and(|k| k < 0)
    }
}

impl Recipe for Degenerate {
    const NAME: &'static str = "degenerate";

    fn make<F: Float>(draw: &mut Draw, dimension: Dimension) -> Points<F> {
        let digits = i64::from(F::DIGITS);
        let reach = draw.pick(&[7, 12, digits / 2, digits]);
        let base = draw.lattice_point(1 << (reach - 1));
        // A line has one direction, a plane two.
        let n = dimension.number();
        let directions: [[i64; 3]; 2] =
            std::array::from_fn(|_| draw.lattice_point(1 << (reach - 6)));
        // 2^(reach-1) + 2 * 7 * 2^(reach-6) is below 2^reach.
        let steps: [[i64; 2]; 4] =
            std::array::from_fn(|_| std::array::from_fn(|_| draw.integer(-7, 7)));
        Points::each(dimension, |i, axis| {
            float(base[axis] + (0..n - 1).map(|k| steps[i][k] * directions[k][axis]).sum::<i64>())
        })
    }

    fn keeps<F: Float>(_: Dimension, _: &ScaledPoints, determinant: &BigDyadic) -> bool {
        determinant.sign() == Ordering::Equal
    }
}

/// `abs(determinant) <= 2^12 * u * m^n`, u = 2^-digits, m the largest `abs(coordinate)`.
///
/// With weights in [-1, 2] the rounded combination lies within 64 u m of the exact one in each
/// coordinate (its terms are at most 4 m, its sums at most 9 m, its operations five a term), the
/// nudge adds at most 36 u m: together less than 2^7 u m. The other factor is an edge (2 m on each
/// of 2 axes) or the cross product of two (8 m² on each of 3): 2^9 and 3 * 2^10 are below 2^12.
const NEARNESS: i64 = 12;

impl Recipe for Near {
    const NAME: &'static str = "near";

    fn make<F: Float>(draw: &mut Draw, dimension: Dimension) -> Points<F> {
        let n = dimension.number();
        // Corners of few bits with dyadic weights combine exactly: unless nudged, the truth is 0.
        let dyadic = draw.coin();
        let bits = F::DIGITS as i32 - 8;
        let corners: [[F; 3]; 3] = std::array::from_fn(|_| {
            if dyadic { draw.lattice_point(1 << bits).map(float) } else { draw.point() }
        });
        let weights: [F; 2] = std::array::from_fn(|_| {
            F::from_f64(if dyadic {
                draw.pick(&[-1.0, 0.25, 0.5, 0.75, 1.0, 2.0])
            } else {
                draw.unit() * 3.0 - 1.0
            })
        });
        let reach = draw.integer(0, 2);
        let last: [F; 3] = std::array::from_fn(|axis| {
            let a = corners[0][axis];
            let sum = (1..n).fold(a, |sum, k| sum + weights[k - 1] * (corners[k][axis] - a));
            let nudge = draw.integer(-reach, reach);
            // Beside 0 an ulp is a subnormal: that is another family's matter.
            if sum.is_zero() { sum } else { sum.offset_ulps(nudge) }
        });
        // The combination is any of the points.
        let place = draw.below(n + 1);
        let points = Points::each(dimension, |i, axis| match i.cmp(&place) {
            Ordering::Less => corners[i][axis],
            Ordering::Equal => last[axis],
            Ordering::Greater => corners[i - 1][axis],
        });
        if dyadic { points.scaled(-bits) } else { points }
    }

    fn keeps<F: Float>(_: Dimension, points: &ScaledPoints, determinant: &BigDyadic) -> bool {
        points.is_within(determinant, NEARNESS - i64::from(F::DIGITS))
    }
}

impl Recipe for Far {
    const NAME: &'static str = "far";

    fn make<F: Float>(draw: &mut Draw, dimension: Dimension) -> Points<F> {
        let points: Points<F> =
            if draw.coin() { Generic::make(draw, dimension) } else { Near::make(draw, dimension) };
        let furthest = i64::from(F::DIGITS) - 2;
        let sure = draw.below(dimension.number());
        // Coordinates stay within 9: an extent of 18 < 2^5 is 2^-6 of 2^12 - 9 and more.
        let offset: [F; 3] = std::array::from_fn(|axis| {
            let exponent = draw.integer(if axis == sure { 12 } else { 0 }, furthest) as i32;
            let value = draw.with_exponent(exponent);
            if axis == sure || draw.coin() { value } else { F::zero() }
        });
        Points::each(dimension, |i, axis| points.coordinates[i][axis] + offset[axis])
    }

    fn keeps<F: Float>(_: Dimension, points: &ScaledPoints, _: &BigDyadic) -> bool {
        points.is_far(6)
    }
}

/// Points of another family whose largest coordinate is scaled to [2^k, 2^(k+1)).
fn in_range<F: Float>(
    draw: &mut Draw,
    dimension: Dimension,
    exponents: RangeInclusive<i64>,
) -> Points<F> {
    let k = draw.integer(*exponents.start(), *exponents.end()) as i32;
    let kind = draw.below(3);
    loop {
        let points: Points<F> = match kind {
            0 => Generic::make(draw, dimension),
            1 => Degenerate::make(draw, dimension),
            _ => Near::make(draw, dimension),
        };
        let coordinates = points.iter().flatten().map(|x| x.to_f64().abs());
        let largest = coordinates.fold(0.0, f64::max);
        // All points at 0 have no size.
        if largest > 0.0 {
            let exponent = (largest.to_bits() >> 52) as i32 - 1023;
            return points.scaled(k - exponent);
        }
    }
}

/// The exponents of coordinates at which a product of as many as there are dimensions underflows,
/// give or take a significand.
fn low_exponents<F: Float>(dimension: Dimension) -> RangeInclusive<i64> {
    let middle = i64::from(F::MIN_EXPONENT) / dimension.number() as i64;
    middle - i64::from(F::DIGITS)..=middle + i64::from(F::DIGITS)
}

/// Likewise where it overflows.
fn high_exponents<F: Float>(dimension: Dimension) -> RangeInclusive<i64> {
    let middle = i64::from(F::MAX_EXPONENT) / dimension.number() as i64;
    middle - i64::from(F::DIGITS)..=middle + i64::from(F::DIGITS)
}

impl Recipe for RangeLow {
    const NAME: &'static str = "range-low";

    fn make<F: Float>(draw: &mut Draw, dimension: Dimension) -> Points<F> {
        in_range(draw, dimension, low_exponents::<F>(dimension))
    }

    fn keeps<F: Float>(
        dimension: Dimension,
        points: &ScaledPoints,
        determinant: &BigDyadic,
    ) -> bool {
        // Hadamard: abs(det) <= (2 m sqrt(n))^n < (4 m)^n.
        points.largest_exponent().is_some_and(|k| low_exponents::<F>(dimension).contains(&k))
            && points.is_within(determinant, 2 * dimension.number() as i64)
    }
}

impl Recipe for RangeHigh {
    const NAME: &'static str = "range-high";

    fn make<F: Float>(draw: &mut Draw, dimension: Dimension) -> Points<F> {
        in_range(draw, dimension, high_exponents::<F>(dimension))
    }

    fn keeps<F: Float>(
        dimension: Dimension,
        points: &ScaledPoints,
        determinant: &BigDyadic,
    ) -> bool {
        points.largest_exponent().is_some_and(|k| high_exponents::<F>(dimension).contains(&k))
            && points.is_within(determinant, 2 * dimension.number() as i64)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_case_depends_on_family_dimension_seed_and_index_only() {
        let near = find_family("near").unwrap();
        let first: Points<f64> = near.make(Dimension::Three, 1, 2);
        assert_eq!(near.make::<f64>(Dimension::Three, 1, 2), first);
        assert_ne!(near.make::<f64>(Dimension::Three, 2, 2), first);
        assert_ne!(near.make::<f64>(Dimension::Three, 1, 3), first);
    }

    #[test]
    fn names_of_families_differ() {
        let names: std::collections::BTreeSet<_> = FAMILIES.iter().map(|f| f.name).collect();
        assert_eq!(names.len(), FAMILIES.len());
    }
}
