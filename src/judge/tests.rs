//! Obligations and findings worked out by hand.

use super::*;
use crate::family::Grouping;
use crate::oracle::truth;

fn down_at(x: f64, y: f64, z: f64) -> Truth {
    let triangle = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0]];
    truth(&Case::<f64>::new([x, y, z], [0.0, 0.0, -1.0], triangle))
}

#[test]
fn contracts_differ_on_edges_sides_and_extents() {
    use Obligation::{Free, MustHit, MustMiss};
    let closed = Contract::CLOSED_RAY;
    let ask = |truth: &Truth, contract: Contract| obligation(truth, &contract, false);
    let edge = down_at(1.0, 0.0, 1.0);
    assert_eq!(ask(&edge, closed), MustHit);
    assert_eq!(ask(&edge, Contract { boundary: Boundary::Open, ..closed }), MustMiss);
    assert_eq!(ask(&edge, Contract { boundary: Boundary::Free, ..closed }), Free);
    let behind = down_at(1.0, 1.0, -1.0);
    assert_eq!(ask(&behind, closed), MustMiss);
    assert_eq!(ask(&behind, Contract { extent: Extent::Line, ..closed }), MustHit);
    let start = down_at(1.0, 1.0, 0.0);
    assert_eq!(ask(&start, closed), MustHit);
    assert_eq!(ask(&start, Contract { ends: Boundary::Open, ..closed }), MustMiss);
    let free_ends = Contract { ends: Boundary::Free, ..closed };
    assert_eq!(
        [&start, &edge, &behind].map(|truth| ask(truth, free_ends)),
        [Free, MustHit, MustMiss]
    );
    let free_line = Contract { extent: Extent::Line, ..free_ends };
    assert_eq!(ask(&start, free_line), MustHit);
    let start_outside = down_at(3.0, 3.0, 0.0);
    assert_eq!(ask(&start_outside, free_ends), MustMiss);
    let at_both = down_at(1.0, 0.0, 0.0);
    assert_eq!(ask(&at_both, Contract { boundary: Boundary::Open, ..free_ends }), MustMiss);
    assert_eq!(obligation(&start, &Contract { no_self_hit: true, ..closed }, true), MustMiss);
    assert_eq!(ask(&down_at(3.0, 3.0, 1.0), closed), MustMiss);
    let back = Case::<f64>::new(
        [1.0, 1.0, -1.0],
        [0.0, 0.0, 1.0],
        [[0.0; 3], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0]],
    );
    assert_eq!(ask(&truth(&back), Contract { sides: Sides::Front, ..closed }), MustMiss);
    assert_eq!(ask(&Truth::Invalid, closed), MustMiss);
    assert_eq!(ask(&Truth::Invalid, Contract { invalid: Demand::Free, ..closed }), Free);
}

#[test]
fn unit_directions_are_measured_exactly() {
    let unit = Direction::Unit { ulps: 1 };
    assert!(promises_direction(unit, [0.0f32, -1.0, 0.0]));
    assert!(promises_direction(unit, [1.0f32 + f32::EPSILON, 0.0, 0.0]));
    assert!(!promises_direction(unit, [1.0f32 + 2.0 * f32::EPSILON, 0.0, 0.0]));
    assert!(!promises_direction(unit, [f32::NAN, 0.0, 0.0]));
    assert!(promises_direction(Direction::Any, [7.0f64, 0.0, 0.0]));
}

#[test]
fn class_names_are_unique_and_numbered() {
    let names: std::collections::HashSet<String> = Class::all().map(Class::name).collect();
    assert_eq!(names.len(), Class::COUNT);
    assert_eq!(Class::of(&down_at(1.0, 0.0, 1.0)).name(), "edge/front/within");
    assert_eq!(Class::of(&down_at(1.0, 1.0, -1.0)).name(), "interior/front/before");
    assert_eq!(Class::of(&Truth::Invalid).name(), "invalid");
}

#[test]
fn a_hit_with_a_value_that_is_no_number_is_bad_and_a_false_one_is_false() {
    let gives = Gives { t: true, uv: true, facing: true };
    let truth = down_at(1.0, 1.0, 1.0);
    let good = Verdict {
        hit: true,
        refused_by: None,
        facing: Some(Facing::Front),
        t: 1.0,
        u: 0.25,
        v: 0.25,
        failure: None,
    };
    let judged = |obligation, verdict: Verdict<f64>| judge(obligation, &truth, gives, &verdict);
    assert_eq!(judged(Obligation::MustHit, good), None);
    let failed = |failure| judged(Obligation::Free, Verdict::failed(failure));
    assert_eq!(failed(Failure::Signal(11)), Some(Finding::Crash));
    assert_eq!(failed(Failure::Exit(0)), Some(Finding::Crash));
    assert_eq!(failed(Failure::Timeout), Some(Finding::Timeout));
    assert_eq!(judged(Obligation::MustHit, Verdict::miss(None)), Some(Finding::FalseMiss));
    assert_eq!(
        judged(Obligation::MustMiss, Verdict { t: f64::NAN, ..good }),
        Some(Finding::FalseHit)
    );
    assert_eq!(judged(Obligation::Free, Verdict { u: f64::NAN, ..good }), Some(Finding::BadValue));
    assert_eq!(
        judged(Obligation::MustHit, Verdict { facing: Some(Facing::Back), ..good }),
        Some(Finding::BadValue)
    );
    assert_eq!(
        judged(Obligation::MustHit, Verdict { facing: None, ..good }),
        Some(Finding::BadValue)
    );
}

#[test]
fn a_point_on_a_polygons_diagonal_is_inside_and_one_on_its_rim_is_not() {
    let corners = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [4.0, 4.0, 0.0], [0.0, 4.0, 0.0]];
    let fan = [[0, 1, 2], [0, 2, 3]];
    let polygon = |x: f64, y: f64| -> Vec<Truth> {
        let case =
            |k: [usize; 3]| Case::<f64>::new([x, y, 1.0], [0.0, 0.0, -1.0], k.map(|i| corners[i]));
        fan.map(|k| truth(&case(k))).to_vec()
    };
    let feature = |x, y| polygon_truth(&polygon(x, y)).crossing().map(|crossing| crossing.feature);
    assert_eq!(feature(2.0, 2.0), Some(Feature::Interior));
    assert!(feature(2.0, 0.0).is_some_and(Feature::is_edge));
    assert_eq!(feature(5.0, 2.0), Some(Feature::Outside));
    let asked = |x, y| group_truth(&polygon(x, y), &Contract::CLOSED_RAY, Grouping::Polygon);
    assert_eq!(asked(2.0, 2.0), GroupTruth::Crossing);
    assert_eq!(asked(2.0, 0.0), GroupTruth::Free, "the rim is nobody's");
}

#[test]
fn a_fold_asks_for_the_parity_of_the_exact_line() {
    let pair = |x: f64, y: f64| -> Vec<Truth> {
        let [a, b, c, d] = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0], [0.0, 2.0, 4.0]];
        let case = |t| truth(&Case::<f64>::new([x, y, 8.0], [0.0, 0.0, -1.0], t));
        vec![case([a, b, c]), case([b, a, d])]
    };
    let asked = |x, y| group_truth(&pair(x, y), &Contract::CLOSED_RAY, Grouping::SharedEdge);
    assert_eq!(asked(1.0, 0.0), GroupTruth::Fold { odd: false }, "on the shared edge");
    assert_eq!(asked(1.0, 0.5), GroupTruth::Fold { odd: false }, "inside both");
    assert_eq!(asked(0.5, 3.0), GroupTruth::Fold { odd: true }, "inside the first alone");
    assert_eq!(asked(1.0, 1.5), GroupTruth::Free, "on a rim of the second");
    assert_eq!(asked(-1.0, 1.0), GroupTruth::Free, "outside");
}

#[test]
fn a_group_that_covers_itself_at_the_ray_is_free() {
    let truths = |rings: &[[f64; 2]]| -> Vec<Truth> {
        let triangle = |i: usize| {
            let at = |[x, y]: [f64; 2]| [x, y, 0.0];
            [[0.0; 3], at(rings[i]), at(rings[(i + 1) % rings.len()])]
        };
        let case = |i| Case::<f64>::new([0.5, 0.25, 1.0], [0.0, 0.0, -1.0], triangle(i));
        (0..rings.len()).map(|i| truth(&case(i))).collect()
    };
    let once = [[4.0, 0.0], [0.0, 4.0], [-4.0, 0.0], [0.0, -4.0]];
    let twice: Vec<[f64; 2]> = once.iter().chain(&once).copied().collect();
    let ask = |truths: &[Truth]| group_truth(truths, &Contract::CLOSED_RAY, Grouping::Fan);
    assert_eq!(ask(&truths(&once)), GroupTruth::Crossing);
    assert_eq!(ask(&truths(&twice)), GroupTruth::Free);
}

/// Cases that are not suspects met their obligation, whatever the verdict; without values, every suspect
/// shows a finding.
fn no_suspect_is_overlooked(truths: &[Truth], all: &Expectations) {
    let (nan, facings) = (f64::NAN, [None, Some(Facing::Front), Some(Facing::Back)]);
    let mut found = Vec::new();
    for number in 0..96 {
        let bit = |k: usize| number >> k & 1 == 1;
        let gives = Gives { t: bit(0), uv: bit(1), facing: bit(2) };
        let failure = (number >= 80).then_some(Failure::Panic);
        let value = |k: usize| if bit(k) { 0.5 } else { nan };
        let (hit, facing) = (failure.is_none() && bit(3), facings[number / 16 % 3]);
        let verdict =
            Verdict { hit, facing, t: value(4), u: value(5), failure, ..Verdict::miss(None) };
        let verdict = Verdict { v: value(6), ..verdict };
        suspects(&all.of, gives, &vec![verdict; truths.len()], &mut found);
        let findings = truths.iter().zip(&all.of).enumerate().filter(|(_, (truth, expected))| {
            judge(expected.obligation(), truth, gives, &verdict).is_some()
        });
        let findings: Vec<usize> = findings.map(|(i, _)| i).collect();
        assert!(findings.iter().all(|i| found.binary_search(i).is_ok()), "{gives:?} {verdict:?}");
        if !(gives.t || gives.uv || gives.facing) {
            assert_eq!(found, findings, "{verdict:?}");
        }
    }
}

#[test]
fn many_cases_are_asked_what_each_is_asked() {
    use crate::contract::NAMED;
    use crate::family::FAMILIES;
    let own = crate::kernel::KERNELS.iter().map(|entry| entry.info.contract);
    let unit = Contract { direction: Direction::Unit { ulps: 4 }, ..Contract::CLOSED_RAY };
    let contracts = NAMED.iter().map(|named| named.contract).chain(own).chain([unit]);
    for contract in contracts {
        let ends = [Boundary::Closed, Boundary::Open, Boundary::Free];
        for contract in ends.map(|ends| Contract { ends, ..contract }) {
            // All families together, so that ends and insides stand side by side.
            let made = FAMILIES.iter().flat_map(|family| {
                (0..40).map(|i| family.make::<f64>(&crate::case::Parameters::default(), 1, i))
            });
            let cases: Vec<Case<f64>> = made.flat_map(|made| made.cases().to_vec()).collect();
            let truths: Vec<Truth> = cases.iter().map(truth).collect();
            let kinds = Kinds::new(&truths);
            for secondary in [false, true] {
                let each: Vec<Obligation> = cases
                    .iter()
                    .zip(&truths)
                    .map(|(case, truth)| asked(case, truth, &contract, secondary))
                    .collect();
                let all = ask_all(&cases, &truths, &kinds, &contract, secondary);
                let of: Vec<_> = all.of.iter().map(|expected| expected.obligation()).collect();
                assert_eq!(of, each, "{contract:?}");
                let is_free = |i: &usize| each[*i] == Obligation::Free;
                assert_eq!(all.free, (0..each.len()).filter(is_free).collect::<Vec<_>>());
                let mut counts = vec![[0u64; 3]; Class::COUNT];
                for (class, asked, count) in &all.counts {
                    counts[class.number()][*asked as usize] += count;
                }
                for (truth, asked) in truths.iter().zip(&each) {
                    counts[Class::of(truth).number()][*asked as usize] -= 1;
                }
                assert!(counts.iter().flatten().all(|count| *count == 0), "{contract:?}");
                no_suspect_is_overlooked(&truths, &all);
            }
        }
    }
}

/// A square of side 4 as its fan, a ray onto it from above, and the truths.
fn square_at(x: f64, y: f64) -> (Vec<Case<f64>>, Vec<Truth>) {
    let corners = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [4.0, 4.0, 0.0], [0.0, 4.0, 0.0]];
    let case = |k: [usize; 3]| Case::new([x, y, 8.0], [0.0, 0.0, -1.0], k.map(|i| corners[i]));
    let cases = [[0, 1, 2], [0, 2, 3]].map(case).to_vec();
    let truths = cases.iter().map(truth).collect();
    (cases, truths)
}

#[test]
fn a_band_frees_a_polygon_by_its_outline_and_a_group_by_its_triangles() {
    // The longest edge of the fan is its diagonal, of length √32; a band is a share of it.
    let band = |distance: f64| {
        let size = distance / 32f64.sqrt();
        Contract { band: format!("{size:e}").parse().ok(), ..Contract::CLOSED_RAY }
    };
    let polygon = |(x, y), distance| {
        let (cases, truths) = square_at(x, y);
        polygon_obligation(&cases, &truths, &band(distance))
    };
    // The middle is on the diagonal, and 2 from the outline.
    assert_eq!(polygon((2.0, 2.0), 1.99), Obligation::MustHit);
    assert_eq!(polygon((2.0, 2.0), 2.01), Obligation::Free);
    assert_eq!(polygon((2.0, 3.5), 0.49), Obligation::MustHit);
    assert_eq!(polygon((2.0, 3.5), 0.51), Obligation::Free);
    assert_eq!(polygon((2.0, 7.0), 2.99), Obligation::MustMiss);
    assert_eq!(polygon((2.0, 7.0), 3.01), Obligation::Free);
    // In ulps of the largest coordinate, 8: 2^-49.
    let ulps = |distance: f64, ulps: &str| {
        let (cases, truths) = square_at(2.0, 4.0 - distance);
        let contract = Contract { band: ulps.parse().ok(), ..Contract::CLOSED_RAY };
        polygon_obligation(&cases, &truths, &contract)
    };
    assert_eq!(ulps(2f64.powi(-48), "2ulps"), Obligation::MustHit);
    assert_eq!(ulps(2f64.powi(-48), "2.5ulps"), Obligation::Free);
    let group = |(x, y), distance| {
        let (cases, truths) = square_at(x, y);
        group_obligation(&cases, &truths, &band(distance), Grouping::Polygon)
    };
    // (3, 1) is √2 from the diagonal and 1 from the rim; the diagonal's own distance is 0.
    assert_eq!(group((3.0, 1.0), 0.99), GroupTruth::Crossing);
    assert_eq!(group((3.0, 1.0), 1.01), GroupTruth::Free);
    assert_eq!(group((2.0, 2.0), 1e-9), GroupTruth::Free);
}

#[test]
fn groups_and_polygons_are_free_where_no_direction_is_promised() {
    let (cases, truths) = square_at(2.0, 2.0);
    let ask = |length: f64| {
        let unit = Contract { direction: Direction::Unit { ulps: 1 }, ..Contract::CLOSED_RAY };
        let mut cases = cases.clone();
        cases.iter_mut().for_each(|case| case.ray.direction *= length);
        let group = group_obligation(&cases, &truths, &unit, Grouping::Polygon);
        (group, polygon_obligation(&cases, &truths, &unit))
    };
    assert_eq!(ask(1.0), (GroupTruth::Crossing, Obligation::MustHit));
    assert_eq!(ask(1.0 + 4.0 * f64::EPSILON), (GroupTruth::Free, Obligation::Free));
}
