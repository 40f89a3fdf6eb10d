//! `behind`, `interval-ends`: hits that the interval decides.

use super::integer::{IntegerCase, normal, shuffle, transversal, triangle_with_edge_point};
use super::{Kept, Made, Recipe};
use crate::case::Draw;
use crate::kernel::Scalar;
use crate::truth::{Feature, Place};
use std::cmp::Ordering;

pub(super) struct Behind;
pub(super) struct IntervalEnds;

/// A lattice ray through a point of a triangle at integer t.
fn at(draw: &mut Draw, t: i64) -> IntegerCase {
    let reach = draw.pick(&[64, 2048]);
    let ([a, b, c], edge_point) = triangle_with_edge_point(draw, reach);
    let [a, b, c, edge_point] = [a, b, c, edge_point].map(|p| p * 2);
    let middle = (c + edge_point) / 2;
    let triangle = shuffle(draw, [a, b, c]);
    let target = draw.pick(&[middle, middle, middle, edge_point, c]);
    let direction = transversal(draw, normal(triangle), reach / 8);
    IntegerCase { origin: target - direction * t, direction, triangle }
}

impl Recipe for Behind {
    const NAME: &'static str = "behind";
    const PROMISE: &'static str = "transversal, in the closed triangle, at negative t";
    const KEEPS: Kept = Kept::Crossings(|crossing| {
        crossing.t_sign == Ordering::Less && crossing.feature != Feature::Outside
    });

    fn make<F: Scalar>(draw: &mut Draw, _: u64) -> Made<F> {
        let t = -draw.integer(1, 4);
        at(draw, t).made()
    }
}

impl Recipe for IntervalEnds {
    const NAME: &'static str = "interval-ends";
    const VERSION: u32 = 2;
    const PROMISE: &'static str =
        "transversal, in the closed triangle, exactly at t_min or t_max, or beyond t_max";
    const KEEPS: Kept = Kept::Crossings(|crossing| {
        matches!(crossing.place, Place::AtMin | Place::AtMax | Place::Beyond)
            && crossing.feature != Feature::Outside
    });

    fn make<F: Scalar>(draw: &mut Draw, _: u64) -> Made<F> {
        let t = draw.integer(0, 4);
        let case = at(draw, t).case::<F>();
        let end = F::from_f64(t as f64);
        let room = F::from_f64(draw.integer(0, 4) as f64);
        Made::One(match draw.below(4) {
            0 => case.on(end, F::infinity()),
            1 => case.on(end, end + room),
            2 => case.on(end - room, end),
            _ => case.on(end - room - F::one(), end - F::from_f64(draw.pick(&[0.25, 1.0]))),
        })
    }
}
