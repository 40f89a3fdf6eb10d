//! Round numbers against their definition.

use super::super::knob::Knob::{Gate as At, LeastT};
use super::*;
use crate::case::Draw;
use crate::kernel::Tunable;

#[test]
fn the_largest_value_is_that_of_the_largest_triangle_or_the_longest_way() {
    let gate = |role, length, direction| {
        let dimension = Dimension::new(length, direction);
        Gate {
            name: "",
            role,
            refuses: "",
            printed: None,
            dimension,
            epsilon: Tunable::Signed,
        }
    };
    let gates = [
        gate(Role::Parallel, 2, 1),
        gate(Role::Edge, 3, 0),
        gate(Role::Other, 0, 2),
        gate(Role::T, 1, -1),
    ];
    let caps = |text: &str| {
        let (scene, _) = Scene::parse(text).unwrap();
        [At(0), At(1), At(2), At(3), LeastT].map(|knob| cap(knob, &gates, Some(&scene)))
    };
    // L is at most 4, the longest way 16, |d| 1 or from 0.5 to 16.
    let unit = "extent=32,edge=0.5..4,distance=0..16";
    assert_eq!(caps(unit), [16.0, 64.0, 1.0, 16.0, 16.0]);
    let target = format!("{unit},direction=target");
    assert_eq!(caps(&target), [16.0 * 16.0, 64.0, 256.0, 32.0, 32.0]);
    assert_eq!(caps("extent=32,edge=0.5..4,distance=0..2")[4], 4.0);
}

#[test]
fn ranges_of_two_parts_are_one_that_holds_both() {
    let ranges = |k: usize, above: [f64; 2], below: [f64; 2]| {
        let mut ranges = Ranges {
            above: [None; MOST_KNOBS],
            below: [None; MOST_KNOBS],
        };
        above
            .into_iter()
            .for_each(|size| widen(&mut ranges.above[k], size));
        below
            .into_iter()
            .for_each(|size| widen(&mut ranges.below[k], size));
        ranges
    };
    let mut sum = ranges(1, [3.0, 2.0], [7.0, 8.0]);
    sum.merge(ranges(1, [2.5, 4.0], [1.0, 1.0]));
    sum.merge(ranges(0, [5.0, 5.0], [6.0, 6.0]));
    assert_eq!(sum.above, [Some([5.0, 5.0]), Some([2.0, 4.0]), None]);
    assert_eq!(sum.below, [Some([6.0, 6.0]), Some([1.0, 8.0]), None]);
}

/// All values of a step: 1, 2 and 5 times each power of ten, then each power, each second, each fourth.
fn all_rounds<F: Float>(step: usize) -> Vec<F> {
    let every = [1, 1, 2, 4, 8, 16, 32, 64, 128][step];
    let digits = if step == 0 {
        &["1", "2", "5"][..]
    } else {
        &["1"]
    };
    let powers = (-400..400).filter(|k| k % every == 0);
    let all = powers.flat_map(|k| digits.iter().map(move |d| format!("{d}e{k}")));
    let all = all.map(|text| F::parse(&text).unwrap());
    all.filter(|x| smallest_normal::<F>() <= x.to_f64() && x.is_finite())
        .collect()
}

/// Checks them by what the range is to be enclosed by, with as small a step as gives few enough.
fn check_rounds<F: Float>(low: f64, high: f64, first_step: usize) {
    let found = few_rounds::<F>([low, high], first_step);
    let enclosing = |step: usize| {
        let all = all_rounds::<F>(step);
        // Round numbers as decimals, of which the scalar's are rounded.
        let wide = |x: &F| format!("{x:e}").parse::<f64>().unwrap();
        let first = all.iter().rposition(|x| wide(x) <= low).unwrap_or(0);
        let last = all
            .iter()
            .position(|x| high <= wide(x))
            .unwrap_or(all.len() - 1);
        all[first..=last].to_vec()
    };
    let mut step = first_step;
    while step < 8 && enclosing(step).len() > 60 {
        step += 1;
    }
    assert_eq!(
        found,
        (enclosing(step), step),
        "{low:e} {high:e} {first_step}"
    );
}

#[test]
fn round_numbers_enclose_every_range_with_as_few_as_are_wanted() {
    let mut draw = Draw::new("rounds", 1, 0);
    for _ in 0..60 {
        let size = |draw: &mut Draw| 10f64.powf(draw.symmetric::<f64>() * 36.0);
        let (one, other) = (size(&mut draw), size(&mut draw));
        let near = one * 10f64.powf(draw.symmetric::<f64>().abs() * 24.0);
        for (low, high) in [(one.min(other), one.max(other)), (one, near), (one, one)] {
            let step = draw.below(4);
            check_rounds::<f32>(low, high, step);
            check_rounds::<f64>(low, high, step);
        }
    }
    for (low, high) in [
        (1.0, 1e20),
        (1e-3, 5e17),
        (2e-3, 5e17),
        (0.0, 1e-30),
        (1e-320, 1e308),
    ] {
        for step in [0, 1, 8] {
            check_rounds::<f32>(low, high, step);
            check_rounds::<f64>(low, high, step);
        }
    }
}

#[test]
fn values_of_a_curve_reach_a_thousand_times_beyond_the_special_ones_of_each_sign() {
    let expected = |special: &[f64], above: Option<[f64; 2]>, below: Option<[f64; 2]>| {
        let mut values = [special, &[0.0]].concat();
        values.extend(
            above
                .into_iter()
                .flat_map(|ends| few_rounds::<f64>(ends, 0).0),
        );
        values.extend(
            below
                .into_iter()
                .flat_map(|ends| few_rounds::<f64>(ends, 0).0)
                .map(|x| -x),
        );
        values.sort_by(f64::total_cmp);
        values.dedup();
        values
    };
    let above = Some([3e-3 / 1e3, 7e4 * 1e3]);
    let below = Some([0.6 / 1e3, 12.0 * 1e3]);
    for (special, above, below) in [
        (&[3e-3, 7e4, 0.5][..], above, None),
        (&[-0.6, -12.0], None, below),
        (&[7e4, -0.6, 0.0, 3e-3, -12.0], above, below),
        (&[], None, None),
    ] {
        assert_eq!(
            round_values(special, false),
            expected(special, above, below),
            "{special:?}"
        );
    }
    let [coarse, fine] = [false, true].map(|is_fine| round_values(&[1.0f64, 0.3125], is_fine));
    assert!(coarse.contains(&1e-3) && coarse.contains(&1e3));
    // Every number of two digits from 0.0003125 to 1000, what was given, and the round number before.
    assert_eq!(
        (fine.len(), fine[1..3].to_vec()),
        (68 + 6 * 90 + 1 + 2 + 1, vec![2e-4, 3.2e-4])
    );
    assert!(coarse.iter().all(|value| fine.contains(value)));
    assert!(fine.contains(&0.3125) && fine.contains(&0.99) && fine.is_sorted());
}

#[test]
fn numbers_of_two_digits_come_once_each_with_both_ends_of_their_range() {
    let below = (12..100).map(|digits| format!("0.0{digits}"));
    let above = (10..=12).map(|digits| format!("0.{digits}"));
    let expected: Vec<f64> = below
        .chain(above)
        .map(|text| text.parse().unwrap())
        .collect();
    assert_eq!(two_digits::<f64>([0.012, 0.12]), expected);
}

#[test]
fn around_a_point_are_the_round_numbers_of_a_step_of_its_sign() {
    let grid = around(&[3.0f32, -0.07, 0.0], 0);
    let expected: [&[f32]; 3] = [
        &[0.0, 0.2, 0.5, 1.0, 2.0, 3.0, 5.0, 10.0, 20.0, 50.0],
        &[
            -1.0, -0.5, -0.2, -0.1, -0.07, -0.05, -0.02, -0.01, -0.005, 0.0,
        ],
        &[0.0],
    ];
    assert_eq!(grid.values(), expected);
    // A tenth of it lies below 0.2.
    let grid = around(&[1.9f32], 0);
    assert_eq!(
        grid.values(),
        [[0.0, 0.1, 0.2, 0.5, 1.0, 1.9, 2.0, 5.0, 10.0, 20.0]]
    );
    // Of a grid with a number every fourth decade: every second, as far as the next ones were.
    let grid = around(&[1e-8f64, 0.0], 2);
    let expected: [&[f64]; 2] = [&[0.0, 1e-12, 1e-10, 1e-8, 1e-6, 1e-4], &[0.0]];
    assert_eq!(grid.values(), expected);
}

#[test]
fn round_numbers_enclose_the_range() {
    assert_eq!(rounds::<f32>([0.3, 4.0], 0), [0.2, 0.5, 1.0, 2.0, 5.0]);
    assert_eq!(rounds::<f32>([0.5, 5.0], 1), [0.1, 1.0, 10.0]);
    assert_eq!(rounds::<f64>([1e-3, 1e-3], 0), [1e-3]);
    let all = rounds::<f32>([0.0, f64::MAX], 1);
    assert!(f32::MIN_POSITIVE <= all[0] && *all.last().unwrap() == 1e38);
    // 1-2-5 from 1e-12 to 1 are 37; from the smallest number only some decades are kept.
    assert_eq!(rounds::<f64>([1e-12, 1.0], 0).len(), 37);
    let (few, step) = few_rounds::<f64>([5e-324, 1.0], 0);
    assert!(
        step == 4 && few.len() <= MOST_VALUES && few.contains(&1.0) && few[0] < 1e-290,
        "{few:?}"
    );
    assert_eq!(rounds::<f32>([1e-50, 1e-45], 0), [2e-38]);
}

#[test]
fn a_range_ends_where_precision_does_three_times_over() {
    let power = |k: i32| 2f64.powi(k);
    // The precisions are 2^-23 and 2^-52.
    assert_eq!(that_matters::<f32>([1e-30, 4.0]), [power(-67), 4.0]);
    assert_eq!(that_matters::<f64>([1e-300, 4.0]), [power(-154), 4.0]);
    assert_eq!(that_matters::<f32>([power(-66), 4.0]), [power(-66), 4.0]);
}
