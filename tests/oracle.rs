//! The oracle against things that know nothing of it: integer arithmetic written here, the stored
//! truths, the definition, and laws that any truth obeys.

use hairline::arith::scale_by_power_of_two;
use hairline::case::{Case, Draw, Parameters};
use hairline::family::{FAMILIES, find};
use hairline::oracle::{define, truth};
use hairline::truth::{Crossing, Facing, Feature, Place, Truth};
use proptest::prelude::*;
use std::cmp::Ordering;

type Point = [i64; 3];

fn minus(a: Point, b: Point) -> Point {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn determinant(a: Point, b: Point, c: Point) -> i64 {
    a[0] * b[1] * c[2] + a[1] * b[2] * c[0] + a[2] * b[0] * c[1]
        - a[2] * b[1] * c[0]
        - a[1] * b[0] * c[2]
        - a[0] * b[2] * c[1]
}

/// The crossing of a line with a lattice triangle, from determinants of 64-bit integers; none if the
/// case is not transversal.
fn crossing(o: Point, d: Point, [a, b, c]: [Point; 3]) -> Option<Crossing> {
    let (e1, e2) = (minus(b, a), minus(c, a));
    // Cramer's rule for o + t d = a + u e1 + v e2, with columns (-d, e1, e2).
    let negative_d = minus([0; 3], d);
    let whole = determinant(negative_d, e1, e2);
    if whole == 0 {
        return None;
    }
    let s = minus(o, a);
    let [t, u, v] =
        [determinant(s, e1, e2), determinant(negative_d, s, e2), determinant(negative_d, e1, s)];
    let positive = |x: i64| x * whole.signum();
    let [t, u, v] = [positive(t), positive(u), positive(v)];
    let w = whole.abs() - u - v;
    let feature = match (w.signum(), u.signum(), v.signum()) {
        (-1, ..) | (_, -1, _) | (.., -1) => Feature::Outside,
        (1, 1, 1) => Feature::Interior,
        (0, 1, 1) => Feature::EdgeBc,
        (1, 0, 1) => Feature::EdgeCa,
        (1, 1, 0) => Feature::EdgeAb,
        (1, 0, 0) => Feature::VertexA,
        (0, 1, 0) => Feature::VertexB,
        _ => Feature::VertexC,
    };
    Some(Crossing {
        // whole = -d·(e1×e2) = -D.
        facing: if whole > 0 { Facing::Front } else { Facing::Back },
        place: match t.cmp(&0) {
            Ordering::Less => Place::Before,
            Ordering::Equal => Place::AtMin,
            Ordering::Greater => Place::Within,
        },
        t_sign: t.cmp(&0),
        feature,
    })
}

#[test]
fn every_lattice_case_agrees_with_integer_arithmetic() {
    let lattice = find("lattice").unwrap();
    let mut transversal = 0u64;
    for index in 0..lattice.size.unwrap() {
        let made = lattice.make_in_order::<f32>(&Parameters::default(), index);
        let case = made.cases()[0];
        let [o, d, a, b, c] = case.vectors().map(|v| v.map(|x| x as i64));
        let expected = if d == [0; 3] {
            Truth::Invalid
        } else if let Some(crossing) = crossing(o, d, [a, b, c]) {
            transversal += 1;
            Truth::Transversal(crossing)
        } else {
            let n = minus(b, a);
            let flat = (0..3).all(|i| {
                let (j, k) = ((i + 1) % 3, (i + 2) % 3);
                let e = minus(c, a);
                n[j] * e[k] == n[k] * e[j]
            });
            let off_plane = determinant(minus(a, o), minus(b, o), minus(c, o)) != 0;
            match (flat, off_plane) {
                (false, true) => Truth::Parallel,
                // Contacts are held to the definition, below.
                (flat, _) => {
                    let found = truth(&case);
                    let class = if flat { "degenerate" } else { "coplanar" };
                    assert_eq!(found.class_name(), class, "index {index}");
                    found
                }
            }
        };
        assert_eq!(truth(&case), expected, "index {index}: {case:?}");
    }
    assert!(transversal > 5_000_000, "{transversal}");
}

#[test]
fn lattice_contacts_agree_with_the_definition() {
    let lattice = find("lattice").unwrap();
    let mut contacts = 0;
    for index in 0..200_000 {
        let made = lattice.make::<f64>(&Parameters::default(), 3, index);
        let case = made.cases()[0];
        let found = truth(&case);
        if matches!(found, Truth::Coplanar(_) | Truth::Degenerate(_)) {
            contacts += 1;
            let ends = [
                (0.0, f64::INFINITY),
                (f64::NEG_INFINITY, f64::INFINITY),
                (-1.0, 0.5),
                (0.5, 0.5),
                (1.0, 1.0),
            ];
            let (t_min, t_max) = ends[index as usize % ends.len()];
            let cut = case.on(t_min, t_max);
            assert_eq!(truth(&cut), define(&cut).truth, "{cut:?}");
        }
    }
    assert!(contacts > 10_000, "{contacts}");
}

#[test]
fn wild_cases_agree_with_the_definition() {
    // Coordinates from a small set of troublesome numbers, so that coincidences are common.
    let numbers = [
        0.0,
        -0.0,
        1.0,
        -1.0,
        0.1,
        1e-310,
        -5e-324,
        1e308,
        f64::MAX,
        3.0,
        2f64.powi(-500),
        1.0 + f64::EPSILON,
    ];
    for index in 0..1000 {
        let mut draw = Draw::new("wild", 1, index);
        let mut vector = || -> [f64; 3] { std::array::from_fn(|_| draw.pick(&numbers)) };
        let [o, d, a, b, c] = std::array::from_fn(|_| vector());
        let (x, y) = (draw.pick(&numbers), draw.pick(&numbers));
        let case = Case::<f64>::new(o, d, [a, b, c]).on(x.min(y), x.max(y));
        assert_eq!(truth(&case), define(&case).truth, "{case:?}");
    }
}

fn family_case() -> impl Strategy<Value = Case<f64>> {
    (0..FAMILIES.len(), 0..10_000u64).prop_map(|(family, index)| {
        let made = FAMILIES[family].make::<f64>(&Parameters::default(), 5, index);
        made.cases()[0]
    })
}

/// A crossing with its features renamed by a permutation of the vertices.
fn renamed(truth: Truth, order: [usize; 3]) -> Truth {
    let Truth::Transversal(crossing) = truth else { return truth };
    let vertices = [Feature::VertexA, Feature::VertexB, Feature::VertexC];
    // The edge opposite to each vertex.
    let edges = [Feature::EdgeBc, Feature::EdgeCa, Feature::EdgeAb];
    let rename = |feature: Feature| {
        for names in [vertices, edges] {
            if let Some(new) = (0..3).find(|&new| names[order[new]] == feature) {
                return names[new];
            }
        }
        feature
    };
    let odd = matches!(order, [0, 2, 1] | [2, 1, 0] | [1, 0, 2]);
    let facing = match (crossing.facing, odd) {
        (Facing::Front, true) => Facing::Back,
        (Facing::Back, true) => Facing::Front,
        (facing, false) => facing,
    };
    Truth::Transversal(Crossing { facing, feature: rename(crossing.feature), ..crossing })
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(2000) })]

    #[test]
    fn permuting_the_vertices_permutes_the_features(case in family_case(), order in 0..6usize) {
        let order = [[0, 1, 2], [1, 2, 0], [2, 0, 1], [0, 2, 1], [2, 1, 0], [1, 0, 2]][order];
        let [o, d, vertices @ ..] = case.vectors();
        let permuted = Case::new(o, d, order.map(|i| vertices[i])).on(case.ray.t_min, case.ray.t_max);
        let (before, after) = (truth(&case), truth(&permuted));
        prop_assume!(before.crossing().is_some());
        prop_assert_eq!(after, renamed(before, order));
    }

    #[test]
    fn scaling_everything_by_a_power_of_two_changes_nothing(case in family_case(), k in -60..60i32) {
        let by = |x: f64| scale_by_power_of_two(x, k);
        let vectors = case.vectors().map(|v| v.map(by));
        // Where no coordinate leaves the range.
        prop_assume!(vectors.iter().zip(case.vectors()).all(|(v, w)| v.map(|x| scale_by_power_of_two(x, -k)) == w));
        let [o, d, a, b, c] = vectors;
        let scaled = Case::new(o, d, [a, b, c]).on(case.ray.t_min, case.ray.t_max);
        prop_assert_eq!(truth(&scaled), truth(&case));
    }

    #[test]
    fn reversing_the_direction_swaps_the_facing_and_negates_t(case in family_case()) {
        let [o, d, a, b, c] = case.vectors();
        let mirrored = Case::new(o, d.map(|x| -x), [a, b, c]).on(-case.ray.t_max, -case.ray.t_min);
        let Truth::Transversal(before) = truth(&case) else { return Ok(()) };
        let Truth::Transversal(after) = truth(&mirrored) else { panic!("not transversal any more") };
        prop_assert_ne!(after.facing, before.facing);
        prop_assert_eq!(after.t_sign, before.t_sign.reverse());
        prop_assert_eq!(after.feature, before.feature);
        let swapped = match before.place {
            Place::Before => Place::Beyond,
            Place::Within => Place::Within,
            Place::Beyond => Place::Before,
            // t_min comes first where both ends are met.
            end => if case.ray.t_min == case.ray.t_max { Place::AtMin } else if end == Place::AtMin { Place::AtMax } else { Place::AtMin },
        };
        prop_assert_eq!(after.place, swapped);
    }

    #[test]
    fn a_longer_direction_shortens_t_and_changes_nothing_else(case in family_case(), k in -40..40i32) {
        let by = |x: f64, k: i32| scale_by_power_of_two(x, k);
        let [o, d, a, b, c] = case.vectors();
        let scaled = d.map(|x| by(x, k));
        prop_assume!(scaled.map(|x| by(x, -k)) == d);
        let ends = [case.ray.t_min, case.ray.t_max].map(|t| by(t, -k));
        let longer = Case::new(o, scaled, [a, b, c]).on(ends[0], ends[1]);
        prop_assert_eq!(truth(&longer), truth(&case));
    }
}
