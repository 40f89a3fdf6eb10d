//! Columns, slices and single cases: the same truths by the same layers, and what goes through the filter together.

use super::*;
use crate::case::hard_cases;
use crate::truth::{Crossing, Facing, Feature, Place};
use std::cell::RefCell;
use std::cmp::Ordering;

#[test]
fn columns_and_slices_and_single_cases_have_the_same_truths() {
    let (mut batch, cases) = (Batch::<Vec<f32>>::new(), hard_cases(3, 235));
    // Lengths that leave a rest behind the last whole group.
    for count in [cases.len(), cases.len() - 1, 3, 1, 0] {
        batch.clear();
        cases[..count].iter().for_each(|case| batch.push(case));
        assert_eq!((batch.len(), batch.is_empty()), (count, count == 0));
        let (mut of_columns, mut of_slice) = (Vec::new(), vec![Truth::Parallel]);
        let [mut layers, mut slice_layers] = [Layers::default(); 2];
        batch.truths(&mut of_columns, &mut layers);
        crate::oracle::truths(&cases[..count], &mut of_slice, &mut slice_layers);
        let single: Vec<Truth> = cases[..count].iter().map(crate::oracle::truth).collect();
        assert_eq!(of_columns, single);
        assert_eq!(of_slice, single);
        let rows = [0, 1, 2, 3, 4]
            .map(|k| Vec::from_iter(cases[..count].iter().map(|case| case.vectors()[k])));
        let ends: Vec<[f32; 2]> = cases[..count]
            .iter()
            .map(|case| [case.ray.t_min, case.ray.t_max])
            .collect();
        let ends = [0, 1].map(|k| Vec::from_iter(ends.iter().map(|ends| ends[k])));
        let (mut of_rows, mut row_layers) = (vec![Truth::Parallel], Layers::default());
        let of = |ends: [&[f32]; 2], truths: &mut Vec<Truth>, layers: &mut Layers| {
            crate::oracle::truths_of_rows(rows.each_ref().map(Vec::as_slice), ends, truths, layers)
        };
        of([&ends[0], &ends[1]], &mut of_rows, &mut row_layers).unwrap();
        assert_eq!((of_rows, row_layers), (single.clone(), layers));
        let longer = vec![1.0; count + 1];
        let error = of([&ends[0], &longer], &mut Vec::new(), &mut row_layers).unwrap_err();
        assert_eq!(
            error,
            UnequalColumns {
                column: "t_max",
                length: count + 1,
                expected: count
            }
        );
        let mut without_wide_vectors = Vec::new();
        decide_groups(
            &cases[..count],
            &mut without_wide_vectors,
            &mut Layers::default(),
        );
        assert_eq!(without_wide_vectors, single);
        let mut single_layers = Layers::default();
        for case in &cases[..count] {
            crate::oracle::truth_counted(case, &mut single_layers);
        }
        assert_eq!([layers, slice_layers], [single_layers; 2]);
        for (index, case) in cases[..count].iter().enumerate() {
            assert_eq!(batch.case(index).bits(), case.bits());
        }
    }
}

/// Cases that note which groups and which single cases are taken.
struct Noted<'a> {
    cases: &'a [Case<f64>],
    groups: RefCell<Vec<usize>>,
    singles: RefCell<Vec<usize>>,
}

impl StoredCases<f64> for Noted<'_> {
    fn count(&self) -> usize {
        self.cases.len()
    }
    fn get(&self, index: usize) -> Case<f64> {
        self.singles.borrow_mut().push(index);
        self.cases[index]
    }
    fn codes(&self, group: usize) -> [SignCode; GROUP] {
        self.groups.borrow_mut().push(group);
        self.cases.codes(group)
    }
    fn behind_the_filter(&self, index: usize, layers: &mut Layers) -> Truth {
        self.cases.behind_the_filter(index, layers)
    }
}

#[test]
fn whole_groups_go_through_the_filter_together_and_only_the_rest_one_by_one() {
    let triangle = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0]];
    let cases = [Case::new([1.0, 1.0, 3.0], [0.25, 0.25, -1.0], triangle); 70];
    for (count, groups) in [(0, 0), (31, 0), (32, 1), (33, 1), (63, 1), (64, 2), (70, 2)] {
        let noted = Noted {
            cases: &cases[..count],
            groups: RefCell::default(),
            singles: RefCell::default(),
        };
        let (mut truths, mut layers) = (Vec::new(), Layers::default());
        decide_all(&noted, &mut truths, &mut layers);
        assert_eq!(
            noted.groups.into_inner(),
            Vec::from_iter(0..groups),
            "{count}"
        );
        assert_eq!(
            noted.singles.into_inner(),
            Vec::from_iter(GROUP * groups..count),
            "{count}"
        );
        assert_eq!(layers.of(Layer::Filter), count as u64);
        assert_eq!(truths, vec![crate::oracle::truth(&cases[0]); count]);
    }
}

#[test]
fn intervals_are_those_of_the_cases_in_whole_groups_too() {
    let triangle = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0]];
    // It meets the triangle at t = 3.
    let ray = Case::<f64>::new([1.0, 1.0, 3.0], [0.25, 0.25, -1.0], triangle);
    let transversal = |place| {
        let (facing, feature) = (Facing::Front, Feature::Interior);
        Truth::Transversal(Crossing {
            facing,
            place,
            t_sign: Ordering::Greater,
            feature,
        })
    };
    let [inf, nan] = [f64::INFINITY, f64::NAN];
    let intervals = [
        ([0.0, inf], transversal(Place::Within)),
        ([2.0, 4.0], transversal(Place::Within)),
        ([2.0, 2.0], transversal(Place::Beyond)),
        ([4.0, inf], transversal(Place::Before)),
        ([-inf, 2.0], transversal(Place::Beyond)),
        // Out of order, and no numbers.
        ([4.0, 2.0], Truth::Invalid),
        ([0.0, -inf], Truth::Invalid),
        ([inf, 0.0], Truth::Invalid),
        ([nan, inf], Truth::Invalid),
        ([0.0, nan], Truth::Invalid),
    ];
    for ([t_min, t_max], truth) in intervals {
        let mut batch = Batch::new();
        (0..GROUP).for_each(|_| batch.push(&ray.on(t_min, t_max)));
        let (mut truths, mut layers) = (Vec::new(), Layers::default());
        batch.truths(&mut truths, &mut layers);
        assert_eq!(truths, [truth; GROUP], "{t_min} {t_max}");
        let layer = if truth == Truth::Invalid {
            Layer::Invalid
        } else {
            Layer::Filter
        };
        assert_eq!(layers.of(layer), GROUP as u64, "{t_min} {t_max}");
    }
}

#[test]
fn columns_of_different_lengths_are_refused_by_name() {
    let (three, four): (&[f64], &[f64]) = (&[1.0; 3], &[1.0; 4]);
    let good = [three; 3];
    let batch = Batch::from_columns(good, [three, four, four], [good; 3], [three; 2]).unwrap_err();
    assert_eq!(
        batch,
        UnequalColumns {
            column: "d.y",
            length: 4,
            expected: 3
        }
    );
    assert_eq!(batch.to_string(), "column d.y has 4 cases, the first one 3");
    let end = Batch::from_columns(good, good, [good; 3], [three, four]).unwrap_err();
    assert_eq!(end.column, "t_max");
    let first = Batch::from_columns([four, three, three], good, [good; 3], [three; 2]).unwrap_err();
    assert_eq!((first.column, first.length, first.expected), ("o.y", 3, 4));
}
