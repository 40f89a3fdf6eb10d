//! The best point of a grid against its definition, and how a point moves where that costs no more.

use super::trials::{COSTS, COUNTS, Trials, all_places, at, axes, counted};
use super::*;

/// The point that [`Joint::best`] promises, found step by step at points that are counted one by one.
fn expected(
    values: &[Vec<f32>],
    cost: &dyn Fn(&[usize]) -> f64,
    is_accurate: &dyn Fn(&[usize]) -> bool,
) -> Option<Vec<usize>> {
    let accurate = all_places(values)
        .into_iter()
        .filter(|places| is_accurate(places));
    let mut places = accurate.reduce(|a, b| if cost(&b) < cost(&a) { b } else { a })?;
    let is_kept = |places: &[usize], most: f64| is_accurate(places) && cost(places) <= most;
    let most = cost(&places) * 1.01;
    let mut free = Vec::new();
    for (k, values) in values.iter().enumerate() {
        let mut zeroed = places.clone();
        match values.iter().position(|value| *value == 0.0) {
            Some(zero) => zeroed[k] = zero,
            None => zeroed[k] = usize::MAX,
        }
        if zeroed[k] < usize::MAX && is_kept(&zeroed, most) {
            places = zeroed;
        } else {
            free.push(k);
        }
    }
    for k in free {
        let ends = |most: f64| {
            let is_good = |place: usize| {
                let mut moved = places.clone();
                moved[k] = place;
                is_kept(&moved, most)
            };
            let (mut low, mut high) = (places[k], places[k]);
            while 0 < low && is_good(low - 1) {
                low -= 1;
            }
            while high + 1 < values[k].len() && is_good(high + 1) {
                high += 1;
            }
            (low, high)
        };
        // Four values of the least cost or more are taken by themselves.
        let (low, high) = ends(cost(&places));
        let (low, high) = if low + 3 <= high {
            (low, high)
        } else {
            ends(most)
        };
        places[k] = (low + high) / 2;
    }
    Some(places)
}

#[test]
fn the_best_point_is_the_cheapest_and_rather_zero_or_in_the_middle() {
    let mut draw = Draw::new("best", 1, 0);
    let (mut none, mut limited_count, mut zeros, mut moved) = (0, 0, 0, 0);
    for round in 0..1500 {
        let mut values = axes(&mut draw);
        if draw.coin() {
            values[0].iter_mut().for_each(|x| *x += 0.5);
        }
        let trials = Trials::random(&mut draw, &values);
        let costs = Costs {
            of: draw.pick(&COSTS),
        };
        let limited = draw.below(3) == 0;
        let joint = counted(&values, &trials, limited);
        let by_count = COUNTS.map(|count| costs.of(count.kind));
        let cost = |places: &[usize]| trials.cost(&by_count, &at(&values, places));
        let is_accurate = |places: &[usize]| !limited || trials.is_accurate(&at(&values, places));
        let expected = expected(&values, &cost, &is_accurate);
        let found = joint.best(&COUNTS, &costs);
        let expected = expected.map(|places| at(&values, &places));
        assert_eq!(found, expected, "{round} {values:?} {:?}", trials.all);
        none += u32::from(found.is_none());
        limited_count += u32::from(limited && found.is_some());
        let point = found.unwrap_or_default();
        zeros += u32::from(point.contains(&0.0));
        moved += u32::from(point.iter().any(|x| *x != 0.0));
    }
    let limited = limited_count;
    assert!(
        20 < none && 100 < limited && 200 < zeros && 200 < moved,
        "{none} {limited} {zeros} {moved}"
    );
}

#[test]
fn a_point_moves_one_knob_after_the_other_where_that_costs_no_more_than_chance_explains() {
    let mut draw = Draw::new("moved", 1, 0);
    let (mut all_moved, mut some_stay, mut inaccurate, mut by_chance) = (0, 0, 0, 0);
    'rounds: for round in 0..1500 {
        let values = axes(&mut draw);
        let trials = Trials::random(&mut draw, &values);
        let costs = Costs {
            of: draw.pick(&COSTS),
        };
        let limited = draw.coin();
        let by_count = COUNTS.map(|count| costs.of(count.kind));
        let cost = |point: &[f32]| trials.cost(&by_count, point);
        // Each ray that ends otherwise adds its weight to the difference, and its square to the variance.
        let by_chance_at_most = |from: &[f32], to: &[f32]| {
            let [before, after] = [from, to].map(|point| trials.hits(point));
            let weight = |c: usize| {
                let of: i64 = trials
                    .all
                    .iter()
                    .filter(|it| it.0 == c)
                    .map(|it| it.2)
                    .sum();
                by_count[c] / of.max(1) as f64
            };
            let changed = |c: usize| (after[c][0] - before[c][0]).abs() as f64;
            let variance: f64 = (0..4).map(|c| weight(c).powi(2) * changed(c)).sum();
            2.0 * variance.sqrt()
        };
        let is_accurate = |point: &[f32]| !limited || trials.is_accurate(point);
        let from: Vec<f32> = values.iter().map(|values| draw.pick(values)).collect();
        // 99 is none of the values: nothing is known of it.
        let to = |values: &Vec<f32>| {
            let other = draw.pick(values);
            draw.pick(&[None, Some(other), Some(other), Some(99.0)])
        };
        let to: Vec<Option<f32>> = values.iter().map(to).collect();
        let (mut expected, mut stayed) = (from.clone(), 0);
        for (k, to) in to.iter().enumerate() {
            let Some(value) = to.filter(|value| *value != 99.0) else {
                continue;
            };
            let mut next = expected.clone();
            next[k] = value;
            let is_kept = is_accurate(&next) || !is_accurate(&from);
            let more = cost(&next) - cost(&from);
            let most = by_chance_at_most(&from, &next);
            // Of what is as much as chance explains rounding decides.
            if (more - most).abs() < 1e-12 && 0.0 < more {
                continue 'rounds;
            }
            let is_as_good = more <= most;
            by_chance += u32::from(1e-9 < more && is_as_good && is_kept);
            inaccurate += u32::from(is_as_good && !is_kept);
            if is_as_good && is_kept {
                expected = next;
            } else {
                stayed += 1;
            }
        }
        let joint = counted(&values, &trials, limited);
        let found = joint.moved(&COUNTS, &costs, &from, &to);
        all_moved += u32::from(expected != from && stayed == 0);
        some_stay += u32::from(0 < stayed);
        assert_eq!(
            found,
            Some(expected),
            "{round} {values:?} {from:?} {to:?} {:?}",
            trials.all
        );
        assert_eq!(
            joint.moved(&COUNTS, &costs, &vec![99.0; from.len()], &to),
            None
        );
    }
    assert!(
        100 < all_moved && 100 < some_stay && 2 < inaccurate && 20 < by_chance,
        "{all_moved} {some_stay} {inaccurate} {by_chance}"
    );
}
