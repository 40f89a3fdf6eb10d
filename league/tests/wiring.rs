//! Adapters that are wired wrongly are noticed: on easy cases every entrant agrees with the exact truth,
//! and its values are those of the hit.

use hairline::internals::audit::EpsilonChoice;
use hairline::internals::case::{Case, Parameters};
use hairline::internals::contract::{Direction, Sides};
use hairline::internals::judge::{Obligation, asked};
use hairline::internals::kernel::{Entry, Scalar, Verdict};
use hairline::internals::oracle;
use hairline_league::{Run, entrants, kernels};
use num_rational::BigRational;
use num_traits::ToPrimitive;

/// Triangles whose corners are easy to mix up: of different sides, and off the origin.
const TRIANGLES: [[[f32; 3]; 3]; 3] = [
    [[1.0, 2.0, 3.0], [9.0, 2.5, 3.5], [2.0, 7.0, 4.0]],
    [[-3.0, 1.0, 2.0], [-2.0, -6.0, 1.0], [-4.0, 0.5, 9.0]],
    [[5.0, -5.0, 0.0], [5.5, 6.0, 1.0], [4.0, 0.0, -8.0]],
];

/// Weights of b and c: eight points well inside, eight well outside.
const WEIGHTS: [(f32, f32); 16] = [
    (0.25, 0.25),
    (0.5, 0.25),
    (0.25, 0.5),
    (0.125, 0.75),
    (0.75, 0.125),
    (0.125, 0.125),
    (0.3125, 0.4375),
    (0.4375, 0.125),
    (-0.25, 0.5),
    (0.5, -0.25),
    (0.75, 0.5),
    (1.25, 0.25),
    (0.25, 1.25),
    (-0.5, -0.5),
    (2.0, -0.5),
    (-0.5, 2.0),
];

/// A ray through the point of the triangle at these weights, from 4 units off it; of unit direction up to
/// rounding, or of length 2. Seen from the front or the back; towards the triangle or away.
fn case(
    triangle: [[f32; 3]; 3],
    (u, v): (f32, f32),
    front: bool,
    away: bool,
    unit: bool,
) -> Case<f32> {
    let [a, b, c] = triangle.map(|p| p.map(f64::from));
    let edge = |p: [f64; 3]| [0, 1, 2].map(|i| p[i] - a[i]);
    let [p, q] = [edge(b), edge(c)];
    let n = [
        p[1] * q[2] - p[2] * q[1],
        p[2] * q[0] - p[0] * q[2],
        p[0] * q[1] - p[1] * q[0],
    ];
    let (u, v, side) = (f64::from(u), f64::from(v), if front { -1.0 } else { 1.0 });
    // Not along the normal: a direction that leans.
    let lean = [0, 1, 2].map(|i| side * n[i] + 0.25 * (p[i] - q[i]));
    let length = lean.iter().map(|x| x * x).sum::<f64>().sqrt();
    let unit_direction = lean.map(|x| x / length);
    let point = [0, 1, 2].map(|i| a[i] + u * p[i] + v * q[i]);
    let distance = if away { -4.0 } else { 4.0 };
    let origin = [0, 1, 2].map(|i| (point[i] - distance * unit_direction[i]) as f32);
    let scale = if unit { 1.0 } else { 2.0 };
    Case::new(origin, unit_direction.map(|x| (scale * x) as f32), triangle)
}

fn cases(unit: bool) -> impl Iterator<Item = Case<f32>> {
    let sides = [(true, false), (false, false), (true, true), (false, true)];
    TRIANGLES.into_iter().flat_map(move |triangle| {
        WEIGHTS.into_iter().flat_map(move |weights| {
            sides.map(|(front, away)| case(triangle, weights, front, away, unit))
        })
    })
}

fn verdict<F: Scalar>(entry: &Entry, case: &Case<F>) -> Option<Verdict<F>> {
    let leaked: &'static Entry = Box::leak(Box::new(*entry));
    let rows = EpsilonChoice::Source.rows(&[leaked], None).unwrap();
    let mut verdict = [Verdict::miss(None)];
    F::subject(entry)?.run(
        std::slice::from_ref(case),
        &rows[0].epsilons::<F>(),
        &mut verdict,
    );
    Some(verdict[0])
}

/// Asserts that a kernel does as its contract asks, and reports the exact t, u and v to a thousandth.
fn check<F: Scalar>(entry: &Entry, case: &Case<F>, hits: &mut usize) {
    let Some(verdict) = verdict(entry, case) else {
        return;
    };
    let (name, contract) = (entry.info.name, &entry.info.contract);
    let truth = oracle::truth(case);
    let asked = asked(case, &truth, contract, false);
    assert_ne!(asked, Obligation::Free, "{name}: {}", case.hex());
    assert_eq!(
        verdict.hit,
        asked == Obligation::MustHit,
        "{name}: {truth}: {}",
        case.hex()
    );
    if !verdict.hit {
        return;
    }
    *hits += 1;
    let exact = oracle::define(case).exact;
    let near = |what: &str, value: F, exact: Option<BigRational>| {
        let exact = exact.and_then(|x| x.to_f64()).expect("a crossing");
        let error = (value.to_f64() - exact).abs();
        assert!(
            error < 1e-3,
            "{name}: {what} = {value:?}, exactly {exact}: {}",
            case.hex()
        );
    };
    let gives = entry.info.gives;
    if gives.t && !gives_scaled_t(name) {
        near("t", verdict.t, exact.t);
    }
    if gives.uv {
        near("u", verdict.u, exact.u);
        near("v", verdict.v, exact.v);
    }
}

/// obvhs' intersect_embree gives t times the determinant: a finding of tests/witnesses.rs.
fn gives_scaled_t(name: &str) -> bool {
    name == "obvhs-embree"
}

#[test]
fn every_entrant_is_right_on_easy_rays_in_both_directions_and_its_values_are_those_of_the_hit() {
    for entry in kernels() {
        let unit = entry.info.contract.direction != Direction::Any;
        let mut hits = 0;
        for case in cases(unit) {
            check(&entry, &case, &mut hits);
            if !unit {
                check(&entry, &case.widen(), &mut hits);
            }
        }
        let sides = if entry.info.contract.sides == Sides::Front {
            1
        } else {
            2
        };
        let scalars = entry.scalars().iter().filter(|runs| **runs).count();
        let scalars = if unit { 1 } else { scalars };
        assert_eq!(hits, 3 * 8 * sides * scalars, "{}", entry.info.name);
    }
}

#[test]
fn every_entrant_sees_nearly_all_of_the_plain_families_right() {
    for entry in kernels() {
        let unit_direction = entry.info.contract.direction != Direction::Any;
        let parameters = Parameters {
            unit_direction,
            ..Parameters::default()
        };
        for family in ["interior", "outside", "behind"] {
            let outcome = hairline::audit(&entry)
                .families([family])
                .parameters(parameters.clone())
                .run();
            for result in outcome.unwrap().record.result.results {
                let (wrong, of) = (
                    result.total.false_misses.count + result.total.false_hits.count,
                    result.total.cases,
                );
                let name = entry.info.name;
                assert!(
                    wrong * 50 <= of,
                    "{name} {family} {}: {wrong} of {of}",
                    result.scalar
                );
                assert!(result.total.free * 2 <= of, "{name} {family}: mostly free");
            }
        }
    }
}

#[test]
fn entrants_have_names_of_their_own_and_say_where_their_contract_comes_from() {
    let entrants = entrants();
    for (i, entrant) in entrants.iter().enumerate() {
        assert!(entrants[..i].iter().all(|other| other.name != entrant.name));
        let name = entrant.name;
        assert!(
            entrant.page.starts_with("https://") && !entrant.function.is_empty(),
            "{name}"
        );
        assert!(
            !entrant.claim.is_empty() || !entrant.note.is_empty(),
            "{name}"
        );
        let starts_with_digit = |part: &str| part.starts_with(|c: char| c.is_ascii_digit());
        assert!(
            starts_with_digit(entrant.version),
            "{name}: {}",
            entrant.version
        );
        if let Run::Here(kernel) = entrant.run {
            assert_eq!(kernel().info.name, name);
        }
    }
}
