//! Curves against counts by their definition.

use super::*;
use crate::case::Draw;

fn margin(draw: &mut Draw) -> f32 {
    match draw.below(8) {
        0 => f32::INFINITY,
        1 => -f32::INFINITY,
        2 => draw.pick(&[0.0, -0.0, 1e-6, -1e-6]),
        _ => draw.symmetric::<f32>() * 2f32.powi(draw.integer(-30, 3) as i32),
    }
}

/// The count by its definition.
fn direct(question: Question, margins: &[f32], epsilon: f32) -> u64 {
    let wrong = |margin: &&f32| {
        let refused = **margin < epsilon;
        refused == question.is_wrong_if_refused()
    };
    margins.iter().filter(wrong).count() as u64
}

#[test]
fn questions_stand_in_the_order_of_reports() {
    let names = Question::ALL.map(Question::name);
    let expected =
        ["false misses", "false hits", "cracks", "doubles", "self-hits", "own false hits"];
    assert_eq!(names, expected);
    assert_eq!(Question::ALL.map(|question| question as usize), [0, 1, 2, 3, 4, 5]);
    assert_eq!(
        Question::ALL.map(Question::is_wrong_if_refused),
        [true, false, true, false, false, false]
    );
}

#[test]
fn rays_add_the_squares_of_their_margins_and_the_first_place_decides_among_equals() {
    let axis = Axis::new(&[]);
    let place = |index, triangle| Place { index, triangle };
    let lane = |question, rays: &[(u64, u64)]| {
        let mut lane = Lane::<f32>::new(question, 0.0, false);
        for (index, count) in rays {
            // The last triangle first.
            let triangles = (0..*count).rev();
            triangles.for_each(|t| lane.add(&axis, 1.5, place(*index, t as u32)));
        }
        lane
    };
    for question in Question::ALL {
        let mut sum = lane(question, &[(7, 3), (9, 1), (4, 2)]);
        sum.merge(lane(question, &[(11, 4), (3, 5)]));
        let curve = sum.curve(&axis);
        assert_eq!((curve.total, curve.squared), (15, 9 + 1 + 4 + 16 + 25));
        assert_eq!(curve.decisive, Some((1.5, place(3, 0))));
        assert_eq!(curve.steps().collect::<Vec<_>>(), [1.5, 1.515625]);
        assert_eq!(Curve::<f32>::new(question, 0.0).wrong(1.0).exact(), Some(0));
        // Of nothing and of something it is the latter.
        let mut sum = Curve::new(question, 0.0);
        sum.merge(&curve);
        assert_eq!(sum, curve);
        // Of two sources the first one's place is kept.
        let mut first = lane(question, &[(7, 1)]).curve(&axis);
        first.merge(&lane(question, &[(1, 1)]).curve(&axis));
        assert_eq!(first.decisive, Some((1.5, place(7, 0))));
    }
}

#[test]
fn a_curve_counts_what_its_margins_say_and_any_split_adds_up() {
    let axis = Axis::new(&[1e-6, -1e-6]);
    let mut draw = Draw::new("curve", 1, 0);
    let margins: Vec<f32> = (0..2000).map(|_| margin(&mut draw)).collect();
    for (question, floor) in
        Question::ALL.into_iter().flat_map(|question| [(question, -f32::MAX), (question, 0.0)])
    {
        let lane = |keep: bool, margins: &[f32], from: u64| {
            let mut lane = Lane::new(question, floor, keep);
            for (margin, index) in margins.iter().zip(from..) {
                lane.add(&axis, *margin, Place { index, triangle: 0 });
            }
            lane
        };
        let (left, right) = margins.split_at(1234);
        let mut split = lane(false, right, 1234);
        split.merge(lane(false, left, 0));
        let whole = lane(false, &margins, 0).curve(&axis);
        assert_eq!(split.curve(&axis), whole);
        let mut sum = lane(false, left, 0).curve(&axis);
        sum.merge(&lane(false, right, 1234).curve(&axis));
        assert_eq!(sum, whole);

        let exact = lane(true, &margins, 0).curve(&axis);
        let anywhere = (0..2000).map(|_| margin(&mut draw)).filter(|e| e.is_finite());
        for epsilon in anywhere.chain(whole.decisive.map(|(m, _)| m)) {
            let count = direct(question, &margins, epsilon);
            assert_eq!(exact.wrong(epsilon).exact(), Some(count), "{question:?} {epsilon:e}");
            let Bracket { low, high } = whole.wrong(epsilon);
            assert!(low <= count && count <= high, "{question:?} {epsilon:e}");
        }
        for epsilon in axis.edges().iter().step_by(7).filter(|edge| edge.is_finite()) {
            let count = direct(question, &margins, *epsilon);
            assert_eq!(whole.wrong(*epsilon).exact(), Some(count), "{question:?} {epsilon:e}");
        }
        // On both sides of the decisive margin, wherever in its cell it falls.
        let (decisive, _) = whole.decisive.unwrap();
        for epsilon in [decisive, decisive.next_up()] {
            let count = direct(question, &margins, epsilon);
            let first = if question.is_wrong_if_refused() { decisive } else { decisive.next_up() };
            if epsilon == first {
                assert_eq!(whole.wrong(epsilon).exact(), Some(count), "{question:?}");
            }
        }
    }
}

#[test]
fn the_largest_numbers_have_cells_of_their_own_and_nothing_is_lost_in_an_empty_lane() {
    let axis = Axis::new(&[]);
    let lane = |margins: &[f32]| {
        let mut lane = Lane::new(Question::FalseMiss, f32::MIN, false);
        for (margin, index) in margins.iter().zip(0..) {
            lane.add(&axis, *margin, Place { index, triangle: 0 });
        }
        lane
    };
    let mut sum = lane(&[]);
    sum.merge(lane(&[f32::MAX, f32::MIN]));
    sum.merge(lane(&[]));
    let curve = sum.curve(&axis);
    assert_eq!((curve.total, curve.cells.len(), curve.never, curve.always), (2, 2, 0, 0));
    assert_eq!(curve.cells[1], Cell { low: f32::MAX, end: f32::INFINITY, count: 1 });
    assert_eq!(curve, lane(&[f32::MAX, f32::MIN]).curve(&axis));
}
