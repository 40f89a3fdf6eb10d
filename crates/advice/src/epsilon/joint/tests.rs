//! The counts of a pass at every point of a grid, and the costs that points are compared by.

mod best;
mod trials;

use super::super::tests::{KERNELS, StoredStudy, Tuned};
use super::*;
use crate::audit::Unobserved;
use crate::case::Draw;
use crate::epsilon::Rays;
use trials::{all_places, at};

#[test]
fn a_union_counts_each_point_once() {
    let mut draw = Draw::new("union", 1, 0);
    for _ in 0..500 {
        let boxes: Vec<Accepted> = (0..draw.below(6) + 1)
            .map(|_| [(); MOST_KNOBS].map(|()| draw.below(4)))
            .collect();
        let terms = union(boxes.iter().copied());
        for point in 0..64usize {
            let point = [point / 16, point / 4 % 4, point % 4];
            let holds = |corner: &Accepted| point.iter().zip(corner).all(|(p, c)| p < c);
            let sum: i64 = terms
                .iter()
                .filter(|(_, c)| holds(c))
                .map(|(sign, _)| sign)
                .sum();
            assert_eq!(
                sum,
                i64::from(boxes.iter().any(holds)),
                "{boxes:?} {point:?}"
            );
        }
    }
}

#[test]
fn the_counts_of_a_pass_are_those_of_its_trials_one_by_one() {
    let max_error = MaxError::parse("t=1e-5").unwrap();
    for (kernel, epsilons) in KERNELS {
        let tuned = Tuned::new(kernel, "room");
        let all = tuned.all(6, 200);
        let of_knob = |size: f32| vec![-size, 0.0, size, 100.0 * size];
        let values: Vec<Vec<f32>> = epsilons[..tuned.knobs.len()]
            .iter()
            .map(|e| of_knob(e.abs().max(1e-6)))
            .collect();
        let count = |max_error: Option<&MaxError>| {
            let grid = KnobGrid::new(values.clone());
            Joint::count(
                &tuned.setting(),
                grid,
                max_error,
                Pass::new(6, 200, &Unobserved),
            )
        };
        let joint = count(Some(&max_error));
        assert!(count(None).exceeded.is_none());
        let exceeded = joint.exceeded.as_ref().unwrap();
        let mut off_in_all = 0;
        for places in all_places(&values) {
            let (point, cell) = (at(&values, &places), joint.cell_of(&places));
            let counted = |sums: &[i64]| sums.get(cell).copied().unwrap_or(0) as usize;
            for (c, count) in tuned.counts.iter().enumerate() {
                let of: Vec<&StoredStudy> = all.iter().filter(|kept| kept.count == c).collect();
                let hits: Vec<&&StoredStudy> =
                    of.iter().filter(|kept| kept.is_hit(&point)).collect();
                let off = hits
                    .iter()
                    .filter(|kept| max_error.is_exceeded(&kept.errors))
                    .count();
                // Only where a hit is right its errors count.
                let off = if count.kind == WrongKind::Miss {
                    off
                } else {
                    0
                };
                off_in_all += off;
                let found = [
                    joint.of[c] as usize,
                    counted(&joint.hits[c]),
                    counted(&exceeded[c]),
                ];
                assert_eq!(
                    found,
                    [of.len(), hits.len(), off],
                    "{kernel} {count:?} {point:?}"
                );
            }
        }
        assert!(0 < off_in_all, "{kernel}");
    }
}

#[test]
fn cells_are_summed_over_all_above_them() {
    let mut draw = Draw::new("accumulated", 1, 0);
    for lengths in [vec![1], vec![4], vec![2, 3], vec![3, 1, 2]] {
        let values: Vec<Vec<f32>> = lengths
            .iter()
            .map(|n| (0..*n).map(|x| x as f32).collect())
            .collect();
        let grid = KnobGrid::new(values.clone());
        // One more in each direction.
        let wide: Vec<Vec<f32>> = lengths
            .iter()
            .map(|n| (0..=*n).map(|x| x as f32).collect())
            .collect();
        let all = all_places(&wide);
        assert_eq!(grid.cells(), all.len());
        let cells: Vec<i64> = all.iter().map(|_| draw.integer(-9, 9)).collect();
        let sums = accumulated(&grid, &cells);
        for places in &all {
            let above = |other: &&Vec<usize>| places.iter().zip(*other).all(|(p, o)| p <= o);
            let sum: i64 = all
                .iter()
                .filter(above)
                .map(|o| cells[grid.cell(o.iter().copied())])
                .sum();
            assert_eq!(
                sums[grid.cell(places.iter().copied())],
                sum,
                "{lengths:?} {places:?}"
            );
        }
        assert!(accumulated(&grid, &[]).is_empty());
    }
}

#[test]
fn costs_are_words_between_commas() {
    let costs = Costs::parse("miss=0, crack=2.5").unwrap();
    assert_eq!(
        WrongKind::ALL.map(|kind| costs.of(kind)),
        [2.5, 0.0, 1.0, 1.0]
    );
    let of = |costs: Costs| WrongKind::ALL.map(|kind| costs.of(kind));
    assert_eq!(of(Costs::default()), [10.0, 1.0, 1.0, 1.0]);
    assert_eq!(
        of(Costs::parse("hit=1e9,self-hit=0").unwrap()),
        [10.0, 1.0, 1e9, 0.0]
    );
    for (text, part) in [
        ("", "is no cost"),
        ("crack", "is no cost"),
        ("cracks=1", "unknown kind"),
        (
            "mis=3",
            "unknown kind 'mis': did you mean 'miss'? write crack=10,",
        ),
        ("crack=nan", "not a number from 0"),
        ("crack=-1", "not a number from 0"),
        ("crack=1000000000.1", "not a number from 0"),
        ("miss=1,miss=2", "given twice"),
        ("crack=0,miss=0,hit=0,self-hit=0", "every cost is 0"),
    ] {
        assert!(Costs::parse(text).unwrap_err().contains(part), "{text}");
    }
}

#[test]
fn a_grid_accepts_a_value_up_to_its_margin() {
    let grid = KnobGrid::new(vec![vec![-1.0f32, 0.0, 2.0], vec![0.0], vec![1.0, 3.0]]);
    assert_eq!(grid.accepted(&[0.0, f32::INFINITY, 1.0]), Some([2, 1, 1]));
    assert_eq!(grid.accepted(&[2.0, 0.0, 2.9]), Some([3, 1, 1]));
    // Of which a value of one knob is accepted by none.
    assert_eq!(grid.accepted(&[0.0, f32::INFINITY, 0.5]), None);
    assert_eq!(grid.accepted(&[-f32::INFINITY, 0.0, 3.0]), None);
    assert_eq!(grid.accepted(&[2.0, -0.5, 3.0]), None);
}

#[test]
fn sums_of_two_threads_are_added_cell_by_cell() {
    let mut sums = JointSums {
        of: vec![1, 2],
        cells: vec![vec![1, 2], vec![]],
        exceeded: vec![vec![], vec![5]],
    };
    sums.merge(JointSums {
        of: vec![10, 20],
        cells: vec![vec![3, 4], vec![7, 9]],
        exceeded: vec![vec![6], vec![8]],
    });
    assert_eq!(sums.of, [11, 22]);
    assert_eq!(sums.cells, [[4, 6], [7, 9]]);
    assert_eq!(sums.exceeded, [[6], [13]]);
}
