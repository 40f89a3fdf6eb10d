//! The oracle against integer arithmetic, its definition, and laws that any truth obeys.

use hairline::internals::arith::scale_by_power_of_two;
use hairline::internals::audit::Unobserved;
use hairline::internals::case::{Case, Parameters};
use hairline::internals::family::{FAMILIES, Family, find};
use hairline::internals::kernel::Scalar;
use hairline::internals::oracle::{Layer, define, exact_values, truth};
use hairline::internals::selfcheck::{
    self,
    Reference::{Definition, Integers},
};
use hairline::internals::truth::{Crossing, Facing, Feature, Place, Truth};
use proptest::prelude::*;

#[test]
fn every_lattice_case_agrees_with_integer_arithmetic() {
    let check = selfcheck::lattice(&Unobserved);
    assert!(check.cases == 14_348_907, "{}", check.cases);
    assert_eq!((check.differences, check.first), (0, None));
}

#[test]
fn cases_over_the_whole_range_agree_with_the_definition() {
    let narrow = selfcheck::whole_range::<f32>(Definition, 7, 1000, &Unobserved);
    let wide = selfcheck::whole_range::<f64>(Definition, 7, 1000, &Unobserved);
    assert_eq!((narrow.differences, narrow.first), (0, None));
    assert_eq!((wide.differences, wide.first), (0, None));
    // Every layer had its turn.
    for layer in [
        Layer::Filter,
        Layer::ScaledFilter,
        Layer::DoubleDouble,
        Layer::Monomials,
        Layer::BigInteger,
    ] {
        assert!(wide.layers.of(layer) > 0, "{layer:?}");
    }
}

#[test]
fn families_agree_with_the_definition_and_with_integers_at_the_intervals_ends_too() {
    for row in FAMILIES {
        for (reference, indices) in [(Definition, 200), (Integers, 2000)] {
            for check in [
                selfcheck::family::<f32>(row, reference, 3, indices, &Unobserved),
                selfcheck::family::<f64>(row, reference, 3, indices, &Unobserved),
            ] {
                assert_eq!((check.differences, check.first), (0, None), "{}", row.name);
            }
        }
    }
}

#[test]
fn exact_values_are_those_of_the_definition() {
    fn check<F: Scalar>(family: &Family) -> usize {
        let sets = (0..60).map(|index| family.make::<F>(&Parameters::default(), 5, index));
        let cases: Vec<_> = sets.flat_map(|made| made.cases().to_vec()).collect();
        let values = cases.iter().filter(|case| {
            let (found, defined) = (exact_values(case, &truth(case)), define(case).exact);
            assert_eq!(found, defined, "{}", case.hex());
            found.t.is_some()
        });
        values.count()
    }
    let crossings: usize = FAMILIES
        .iter()
        .map(|row| check::<f32>(row) + check::<f64>(row))
        .sum();
    assert!(crossings > 3000, "{crossings}");
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

fn family_case() -> impl Strategy<Value = Case<f64>> {
    (0..FAMILIES.len(), 0..10_000u64).prop_map(|(family, index)| {
        let made = FAMILIES[family].make::<f64>(&Parameters::default(), 5, index);
        made.cases()[0]
    })
}

/// A crossing with its features renamed by a permutation of the vertices.
fn renamed(truth: Truth, order: [usize; 3]) -> Truth {
    let Truth::Transversal(crossing) = truth else {
        return truth;
    };
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
    Truth::Transversal(Crossing {
        facing,
        feature: rename(crossing.feature),
        ..crossing
    })
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

    #[test]
    fn an_offset_changes_nothing_where_every_sum_is_exact(index in 0..10_000u64, offset in [-1000..1000i64, -1000..1000, -1000..1000]) {
        // Lattice coordinates and integer offsets: every sum is exact.
        let row = FAMILIES.iter().find(|row| row.name == "edge-exact").unwrap();
        let case = row.make::<f64>(&Parameters::default(), 5, index).cases()[0];
        let [o, d, a, b, c] = case.vectors();
        let moved = |p: [f64; 3]| -> [f64; 3] { std::array::from_fn(|i| p[i] + offset[i] as f64) };
        let moved = Case::new(moved(o), d, [a, b, c].map(moved)).on(case.ray.t_min, case.ray.t_max);
        prop_assert_eq!(truth(&moved), truth(&case));
    }
}
