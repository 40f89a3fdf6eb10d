//! The derived bound of `normal=`: no start at it is wrong, whatever weights the gates let through.

use hairline::internals::arith::three_digits;
use hairline::internals::audit::{EpsilonChoice, Row};
use hairline::internals::case::{Case, Draw, Scene};
use hairline::internals::kernel::find;
use hairline::internals::offset::{OffsetTrials, PointKind, derived_normal, least_weight, parse};
use hairline::internals::oracle;
use hairline::internals::truth::Place;

fn row(kernel: &str, epsilon: &str) -> Row {
    let choice = EpsilonChoice::parse(epsilon).unwrap();
    choice
        .rows(&[find(kernel).unwrap()], None)
        .unwrap()
        .remove(0)
}

/// A ray at a point of a triangle's plane whose weights reach from -reach to 1 + 2 reach.
fn far_beside(index: u64, reach: f64) -> Case<f32> {
    let draw = &mut Draw::new("derived", 1, index);
    let mut vertex = || [0; 3].map(|_| 2.0 * draw.unit() - 1.0);
    let [a, b, c, origin] = [(); 4].map(|()| vertex());
    let [u, v] = [0; 2].map(|_| (1.0 + 2.0 * reach) * draw.unit() - reach);
    let target: [f64; 3] = std::array::from_fn(|i| a[i] * (1.0 - u - v) + b[i] * u + c[i] * v);
    let direction = std::array::from_fn(|i| (target[i] - origin[i]) as f32);
    let [origin, a, b, c] = [origin, a, b, c].map(|p| p.map(|x| x as f32));
    Case::new(origin, direction, [a, b, c])
}

/// The wrong starts among those of `normal=` at a distance.
fn wrong(trials: &OffsetTrials<f32>, distance: f64) -> usize {
    let scheme = parse(&format!("normal={distance:e}")).unwrap();
    let offset = scheme.offset::<f32>().unwrap();
    let is_wrong = |trial: &&hairline::internals::offset::OffsetTrial<f32>| {
        let start = offset.start(&trial.hit);
        let truth = oracle::truth(&trial.case(start.origin, start.t_min));
        truth
            .crossing()
            .is_none_or(|crossing| crossing.place != Place::Before)
    };
    trials.trials.iter().filter(is_wrong).count()
}

#[test]
fn a_derived_bound_follows_the_weights_that_an_edge_gate_lets_through() {
    let (unit, _) = Scene::parse("extent=1,edge=0.1..1").unwrap();
    for edge in [-50.0f64, -1.0] {
        let row = row("moller-trumbore", &format!("edge={edge}"));
        let least = least_weight(&row).unwrap();
        assert_eq!(least, edge.min(1.0 + 2.0 * edge));
        let rays: Vec<_> = (0..20_000).map(|i| (i, far_beside(i, -edge))).collect();
        let trials = OffsetTrials::of(
            (row.entry, &row.epsilons::<f32>()),
            PointKind::Weights,
            1,
            &rays,
            None,
        );
        assert!(1000 < trials.trials.len(), "{}", trials.trials.len());
        let [inside, all] = [0.0, least]
            .map(|least| three_digits(derived_normal::<f32>(&unit, least).unwrap(), true));
        // The bound for weights from 0 to 1 is wrong here.
        assert!(edge != -50.0 || trials.trials.len() / 10 < wrong(&trials, inside));
        assert_eq!(wrong(&trials, all), 0);
    }
}

#[test]
fn weights_are_known_from_gates_that_compare_them_alone() {
    for (kernel, epsilon, least) in [
        ("moller-trumbore", "edge=0", Some(0.0)),
        ("moller-trumbore", "edge=0.01", Some(0.0)),
        ("cramer", "edge=-0.5", Some(-0.5)),
        ("baldwin-weber", "edge=-2", Some(-3.0)),
        // Relative to U + V + W; above 1/3 also with all of the other sign.
        ("plucker", "edge=-1e-30", Some(-1e-30)),
        ("plucker", "edge=-50", Some(-99.0)),
        ("baldwin-weber", "t=-2", Some(0.0)),
        ("havel-herout", "parallel=0", Some(0.0)),
        ("woop-watertight", "edge=0", Some(0.0)),
        // Twice an area times a length: no bound of a weight.
        ("woop-watertight", "edge=-1e-30", None),
        ("moller-trumbore-culling", "edge=-1e-30", None),
        ("scalar-triple", "edge=-1e-30", None),
    ] {
        if let Ok(rows) = EpsilonChoice::parse(epsilon)
            .unwrap()
            .rows(&[find(kernel).unwrap()], None)
        {
            assert_eq!(least_weight(&rows[0]), least, "{kernel} {epsilon}");
        } else {
            assert_eq!((kernel, epsilon), ("havel-herout", "parallel=0"));
        }
    }
}

#[test]
fn the_bound_is_that_of_the_guide() {
    // 10.6 u M for weights from 0 to 1, and 35.3 e u M more for weights from -e on.
    let (unit, _) = Scene::parse("extent=1,edge=0.1..1").unwrap();
    let u = f64::from(f32::EPSILON) / 2.0;
    let units = |least: f64| derived_normal::<f32>(&unit, least).unwrap() / u;
    assert_eq!((units(0.0) * 10.0).round(), 106.0);
    assert_eq!(((units(-1.0) - units(0.0)) * 10.0).round(), 353.0);
    let guide = include_str!("../../docs/guide/offset.md");
    assert!(guide.contains("10.6 u M") && !guide.contains("10.7 u"));
}
