use super::*;
use crate::contract::{Boundary, Extent, Sides};

/// Down onto (1, 1) of a right triangle with legs of 4 and 8: t = 3, u = 1/4, v = 1/8, |d| = 4.
fn case<F: Float>() -> Case<F> {
    let number = |x: f64| F::from_f64(x);
    let point = |p: [f64; 3]| p.map(number);
    let triangle = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 8.0, 0.0]].map(point);
    Case::new(point([1.0, 1.0, 12.0]), point([0.0, 0.0, -4.0]), triangle)
        .on(number(1.0), number(11.0))
}

const GIVES: Gives = Gives {
    t: true,
    uv: true,
    facing: false,
};

fn hit<F: Float>([t, u, v]: [f64; 3]) -> Verdict<F> {
    let [t, u, v] = [t, u, v].map(F::from_f64);
    Verdict {
        hit: true,
        t,
        u,
        v,
        ..Verdict::miss(None)
    }
}

#[test]
fn each_relation_of_values_is_that_worked_out_by_hand() {
    for (values, expected) in [
        ([6.0, 0.25, 0.125], vec![Relation::TwiceT]),
        ([1.5, 0.25, 0.125], vec![Relation::HalfT]),
        ([-3.0, 0.25, 0.125], vec![Relation::OppositeT]),
        ([12.0, 0.25, 0.125], vec![Relation::LengthT]),
        ([48.0, 0.25, 0.125], vec![Relation::SquaredLengthT]),
        ([0.75, 0.25, 0.125], vec![Relation::OverLengthT]),
        ([2.0, 0.25, 0.125], vec![Relation::FromStartT]),
        ([0.2, 0.25, 0.125], vec![Relation::ShareT]),
        ([11.0, 0.25, 0.125], vec![Relation::ClampedT]),
        ([3.0, 0.125, 0.25], vec![Relation::Exchanged]),
        ([3.0, 0.625, 0.125], vec![Relation::WeightAForU]),
        ([3.0, 0.25, 0.625], vec![Relation::WeightAForV]),
        ([3.0, 0.625, 0.25], vec![Relation::WeightsOfAb]),
        ([3.0, 0.125, 0.625], vec![Relation::WeightsOfCa]),
        (
            [6.0, 0.125, 0.25],
            vec![Relation::TwiceT, Relation::Exchanged],
        ),
        ([7.0, 0.25, 0.125], vec![]),
        ([3.0, 0.3, 0.125], vec![]),
    ] {
        let of_f32 = RelatedValues::of(&case::<f32>(), GIVES, &hit(values), 0.0);
        assert_eq!(of_f32.holding, expected, "{values:?}");
        let of_f64 = RelatedValues::of(&case::<f64>(), GIVES, &hit(values), 0.0);
        assert_eq!(of_f64.holding, expected, "{values:?}");
        assert_eq!(of_f64.wrong.last(), Some(&Part::Values));
    }
}

#[test]
fn right_values_have_no_relation_and_those_of_f32_are_known_in_f64() {
    let right = RelatedValues::of(&case::<f64>(), GIVES, &hit([3.0, 0.25, 0.125]), 0.0);
    assert_eq!(
        right,
        RelatedValues {
            wrong: vec![],
            holding: vec![]
        }
    );
    let rounded = [
        f64::from(3.0f32.next_up()),
        0.25,
        f64::from(0.125f32.next_up()),
    ];
    let in_f32 = RelatedValues::of(&case::<f64>(), GIVES, &hit(rounded), 0.0);
    assert_eq!(in_f32.wrong, [Part::T, Part::Weights, Part::Values]);
    assert_eq!(in_f32.holding, [Relation::InF32]);
    // In f32 they are right.
    let right = RelatedValues::of(&case::<f32>(), GIVES, &hit(rounded), 0.0);
    assert_eq!(right.wrong, []);
}

#[test]
fn relations_about_the_interval_change_the_demand_where_they_should() {
    use Relation::*;
    let contract = Contract::of_kernel(Extent::Interval, Sides::Both, Boundary::Closed);
    let demands = |origin: f64, [low, high]: [f64; 2]| {
        let [.., a, b, c] = case::<f64>().vectors();
        // The plane is met at t = origin / 4.
        let case = Case::new([1.0, 1.0, origin], [0.0, 0.0, -4.0], [a, b, c]).on(low, high);
        other_demands(&case, &oracle::truth(&case), &contract)
    };
    let (hit, miss) = (Obligation::MustHit, Obligation::MustMiss);
    assert_eq!(
        demands(12.0, [4.0, 9.0]),
        [(IgnoresTMin, hit), (ZeroTMin, hit)]
    );
    assert_eq!(demands(12.0, [1.0, 2.0]), [(IgnoresTMax, hit)]);
    assert_eq!(demands(12.0, [1.0, 9.0]), []);
    assert_eq!(
        demands(-12.0, [0.0, 9.0]),
        [(AbsoluteT, hit), (IgnoresTMin, hit)]
    );
    assert_eq!(demands(-12.0, [0.0, 2.0]), [(IgnoresTMin, hit)]);
    assert_eq!(
        demands(-12.0, [-5.0, 2.0]),
        [(AbsoluteT, miss), (ZeroTMin, miss), (ClampedTMin, miss)]
    );
    // So near to the end that rounding decides.
    assert_eq!(demands(12.0, [3.0 + 1e-9, 9.0]), []);
}

#[test]
fn a_t_of_infinity_is_right_where_the_exact_one_rounds_to_it() {
    use crate::judge::rounds_to_infinity;
    let largest = f32::MAX;
    let [.., a, b, c] = case::<f32>().vectors();
    let at = |height: f32, step: f32| Case::new([1.0, 1.0, height], [0.0, 0.0, -step], [a, b, c]);
    let rounds = |case: &Case<f32>, t: f32| rounds_to_infinity(case, &oracle::truth(case), t);
    // t is the quotient of both: 2^128 · (1 - 2^-24) is the largest number, and 2^128 · (1 - 2^-25) the first that rounds up.
    assert!(rounds(&at(largest, 0.5), f32::INFINITY));
    assert!(!rounds(&at(largest, 0.5), f32::NEG_INFINITY));
    assert!(rounds(&at(-largest, 0.5), f32::NEG_INFINITY));
    assert!(!rounds(&at(largest, 1.0), f32::INFINITY));
    assert!(!rounds(&at(largest, 0.5), f32::NAN) && !rounds(&at(largest, 0.5), largest));
    // One above the largest number's significand, below half an ulp: 2^127 · (2 - 2^-23) / (1 - 2^-24 · k).
    assert!(rounds(&at(largest, 1.0f32.next_down()), f32::INFINITY));
}
