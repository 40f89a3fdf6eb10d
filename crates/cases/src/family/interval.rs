//! `behind`, `interval-ends`: hits that the interval decides.

use super::integer::{IntegerCase, doubled_triangle, normal, shuffle, transversal};
use super::{CaseGroup, Promise, Recipe};
use crate::case::Draw;
use crate::kernel::Scalar;
use crate::truth::{Feature, Place};
use std::cmp::Ordering;

pub(super) struct Behind;
pub(super) struct IntervalEnds;

/// A lattice ray through a point of a triangle at integer t.
fn at(draw: &mut Draw, t: i64) -> IntegerCase {
    let reach = draw.pick(&[64, 2048]);
    let ([a, b, c], edge_point) = doubled_triangle(draw, reach);
    let middle = (c + edge_point) / 2;
    let triangle = shuffle(draw, [a, b, c]);
    let target = draw.pick(&[middle, middle, middle, edge_point, c]);
    let direction = transversal(draw, normal(triangle), reach / 8);
    IntegerCase {
        origin: target - direction * t,
        direction,
        triangle,
    }
}

impl Recipe for Behind {
    const NAME: &'static str = "behind";
    const VERSION: u32 = 2;
    const PROMISE: &'static str = "transversal, in the closed triangle, at negative t";
    const KEEPS: Promise = Promise::Crossings(|crossing| {
        crossing.t_sign == Ordering::Less && crossing.feature != Feature::Outside
    });

    fn make<F: Scalar>(draw: &mut Draw, _: u64) -> CaseGroup<F> {
        let t = -draw.integer(1, 4);
        at(draw, t).made()
    }
}

impl Recipe for IntervalEnds {
    const NAME: &'static str = "interval-ends";
    const VERSION: u32 = 3;
    const PROMISE: &'static str = "transversal, in the closed triangle: before, at, between and beyond the ends of intervals of every kind";
    const HAS_OWN_INTERVAL: bool = true;
    const KEEPS: Promise = Promise::Crossings(|crossing| crossing.feature != Feature::Outside);

    fn make<F: Scalar>(draw: &mut Draw, _: u64) -> CaseGroup<F> {
        let steps = draw.integer(-4, 4);
        let case = at(draw, steps).case::<F>();
        let t = steps as f64;
        let place = draw.pick(&PLACES);
        let gap = draw.pick(&[0.25, 1.0, 2.0, 4.0]);
        let length = draw.pick(&[0.25, 1.0, 4.0, f64::INFINITY]);
        let [t_min, t_max] = match place {
            Place::Before => [t + gap, t + gap + length],
            Place::AtMin => [t, t + length],
            Place::Within => [t - gap, t + length],
            Place::AtMax => [t - gap, t],
            Place::Beyond => [t - 2.0 * gap, t - gap],
        }
        .map(F::from_f64);
        CaseGroup::One(case.on(t_min, t_max))
    }
}

/// Where t lies: two in three are at an end, because no other family puts so many there.
const PLACES: [Place; 9] = [
    Place::Before,
    Place::AtMin,
    Place::AtMin,
    Place::AtMin,
    Place::Within,
    Place::AtMax,
    Place::AtMax,
    Place::AtMax,
    Place::Beyond,
];
