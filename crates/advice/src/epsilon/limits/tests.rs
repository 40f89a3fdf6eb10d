//! Tests of limits of epsilons.

use super::*;
use crate::case::Draw;

fn empty_tail<F>(is_lower: bool, of: u64, kept: usize) -> Tail<F> {
    Tail {
        knob: 1,
        count: 2,
        is_lower,
        of,
        kept,
        margins: Vec::new(),
    }
}

#[test]
fn a_tail_keeps_the_most_decisive_margins_in_order() {
    let mut draw = Draw::new("tail", 1, 0);
    for lowest_first in [true, false] {
        let margins: Vec<f32> = (0..300).map(|_| draw.below(90) as f32 - 40.0).collect();
        let tail = |margins: &[f32]| {
            let mut tail = empty_tail(!lowest_first, margins.len() as u64, 64);
            margins.iter().for_each(|margin| tail.add(*margin));
            tail
        };
        let (one, other) = margins.split_at(100);
        let mut sum = Tails(vec![tail(one)]);
        sum.merge(Tails(vec![tail(other)]));
        let mut sorted = margins.clone();
        sorted.sort_by(f32::total_cmp);
        if !lowest_first {
            sorted.reverse();
        }
        for found in [sum.0.remove(0), tail(&margins)] {
            assert_eq!((found.of, &found.margins[..]), (300, &sorted[..64]));
        }
    }
}

#[test]
fn a_crack_that_is_a_hit_too_near_is_not_the_edges_own() {
    // Of an edge and a least t: the triangle that is met, and its neighbour far beside it.
    let (inf, no) = (f64::INFINITY, f64::NEG_INFINITY);
    let margins = [[0.5, 1.0, inf], [-0.3, 9.0, inf], [no; 3]];
    let trial = Trial {
        count: 0,
        guards: [true; 3],
        margins: &margins,
        around: 0,
        first: None,
    };
    let own = |least_t: f64| {
        let largest = alone(&trial, 0, &[0.0, least_t, 0.0]);
        (largest, is_own(&trial, 0, largest))
    };
    assert_eq!([own(0.0), own(1.0)], [(0.5, true); 2]);
    assert_eq!([own(2.0), own(10.0)], [(-0.3, false), (no, false)]);
    // What another gate refuses is no knob's.
    let refused = Trial {
        margins: &[[no; 3]; 2],
        ..trial
    };
    assert!(!is_own(&refused, 0, no));
}

#[test]
fn above_a_number_is_the_next_that_is_not_flushed() {
    let normal = f32::MIN_POSITIVE;
    for x in [
        1.0f32,
        -1.0,
        normal,
        normal.next_down(),
        -normal,
        -normal.next_down(),
    ] {
        assert_eq!(above(x), x.next_up(), "{x:e}");
    }
    for x in [
        0.0,
        f32::from_bits(1),
        normal / 2.0,
        normal.next_down().next_down(),
    ] {
        assert_eq!(above(x), normal, "{x:e}");
    }
    assert_eq!(above(-f32::from_bits(1)), 0.0);
}

#[test]
fn a_limit_keeps_what_its_margin_says_in_two_digits() {
    let inf = f64::INFINITY;
    assert_eq!(
        [true, false].map(|is_lower| value(0.123, is_lower)),
        [Some(0.13), Some(0.12)].map(Some)
    );
    assert_eq!(
        [inf, -inf].map(|margin| value(margin, true)),
        [Some(None), None]
    );
    assert_eq!([inf, -inf].map(|margin| value(margin, false)), [None; 2]);
}

#[test]
fn between_limits_that_meet_is_a_round_number() {
    let limit = |is_lower, value| KnobLimit {
        knob: 1,
        count: 0,
        is_lower,
        value,
        far: None,
        one_in: 9,
    };
    let (low, high) = (limit(true, Some(7.9e-12)), limit(false, Some(3.6e-4)));
    for (limits, middle) in [
        (vec![low.clone(), high.clone()], Some(5e-8)),
        // The strictest of each side: 1.4e-7 is in the middle.
        (
            vec![
                limit(true, Some(1e-12)),
                low.clone(),
                limit(false, Some(2.5e-3)),
                limit(false, Some(2.5e-3)),
            ],
            Some(1e-7),
        ),
        (
            vec![low.clone(), limit(false, Some(1.0)), high.clone()],
            Some(5e-8),
        ),
        (
            vec![
                high.clone(),
                limit(false, Some(1.0)),
                low.clone(),
                limit(true, Some(1e-12)),
            ],
            Some(5e-8),
        ),
        (
            vec![limit(true, Some(3.1e-6)), limit(false, Some(3.3e-6))],
            Some(3.1e-6),
        ),
        (
            vec![limit(true, Some(4e-6)), limit(false, Some(3.3e-6))],
            None,
        ),
        (vec![low.clone(), limit(false, None)], None),
        (vec![low.clone()], None),
        (vec![high.clone()], None),
        // Below zero too, where 2.1e-4 is in the middle.
        (
            vec![limit(true, Some(-6e-2)), limit(false, Some(-7.2e-7))],
            Some(-2e-4),
        ),
        (
            vec![limit(true, Some(-3.1e-6)), limit(false, Some(-3.1e-6))],
            Some(-3.1e-6),
        ),
        (
            vec![limit(true, Some(-1e-4)), limit(false, Some(-8e-4))],
            None,
        ),
        (
            vec![
                limit(true, Some(-1e-4)),
                limit(false, Some(-f64::MIN_POSITIVE)),
            ],
            None,
        ),
        (
            vec![limit(true, Some(-1e-4)), limit(false, Some(8e-4))],
            None,
        ),
        (
            vec![limit(true, Some(3e-9)), limit(false, Some(-7.2e-7))],
            None,
        ),
        (
            vec![limit(true, Some(3.1e-6)), limit(false, Some(3.1e-6))],
            Some(3.1e-6),
        ),
        // Both are round, or one: the first that is nearest to the middle.
        (
            vec![limit(true, Some(1e-6)), limit(false, Some(2e-6))],
            Some(1e-6),
        ),
        (
            vec![limit(true, Some(1.5e-6)), limit(false, Some(2e-6))],
            Some(2e-6),
        ),
        // Up to twice the least normal number is any above zero.
        (
            vec![limit(true, Some(2.0 * f64::MIN_POSITIVE)), high.clone()],
            None,
        ),
        (
            vec![limit(true, Some(3.0 * f64::MIN_POSITIVE)), high.clone()],
            Some(5e-156),
        ),
    ] {
        assert_eq!(between(&limits, 2), [None, middle], "{limits:?}");
    }
}

/// Tests a distribution whose quantiles are known: the uniform one.
#[test]
fn limits_are_violated_no_more_often_than_stated() {
    let (runs, n) = (4000, 700);
    let Ranks { one_in, safe, far } = ranks(n).unwrap();
    let mut beyond = [0u32; 2];
    for run in 0..runs {
        let mut draw = Draw::new("limits", 1, run);
        let mut tail = empty_tail(false, n, kept(n));
        (0..n).for_each(|_| tail.add(draw.unit()));
        // The share below a number is that number.
        let share = 1.0 / (one_in as f64);
        beyond[0] += u32::from(share < tail.margins[safe as usize - 1]);
        beyond[1] += u32::from(tail.margins[far as usize - 1] < share);
    }
    for violated in beyond.map(|count| f64::from(count) / runs as f64) {
        let chance = 3.0 * (0.05f64 * 0.95 / runs as f64).sqrt();
        assert!(violated <= 0.05 + chance, "{beyond:?}");
        // And the limit is not far from the share: no more confidence is given away than there is to be.
        assert!(0.01 < violated, "{beyond:?}");
    }
}

#[test]
fn a_limit_that_could_as_well_be_elsewhere_is_unsure() {
    let limit = |value: Option<f64>, far| {
        KnobLimit {
            knob: 0,
            count: 0,
            is_lower: false,
            value,
            far,
            one_in: 9,
        }
        .is_unsure()
    };
    for (value, far, is_unsure) in [
        (1e-6, Some(2.9e-5), false),
        (1e-6, Some(3.1e-5), true),
        (3e-5, Some(1.1e-6), false),
        (-3e-5, Some(-1.1e-6), false),
        (-3e-5, Some(-9e-7), true),
        (-3e-5, Some(3e-5), true),
        (0.0, Some(0.0), false),
        (0.0, Some(1e-30), true),
        (1e-30, Some(0.0), true),
        (1e-30, None, true),
    ] {
        assert_eq!(limit(Some(value), far), is_unsure, "{value} {far:?}");
    }
    assert!(!limit(None, None));
}
