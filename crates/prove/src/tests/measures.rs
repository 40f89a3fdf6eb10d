//! The limits of a scene for numbers that kernels divide by and get: true of its triangles, and known in the kernels.

use super::super::measures::{Kind, Known, Sample};
use super::super::{Assumption, Domain, Format, Limit, Prover, Scene};
use super::{difference, recorded};
use crate::arith::recorded::{Place, Recorded};
use crate::arith::{Real, Vector};
use crate::case::Draw;
use crate::kernel;
use crate::{Effort, Summary};
use glam::DVec3;
use std::collections::BTreeMap;

const SCENE: Scene = Scene {
    coordinates: 3.0,
    edge: [0.25, 2.0],
    distance: 4.0,
    min_angle: 5.0,
    grazing: 2.0,
    shape: None,
    is_of_longest: false,
};

/// A triangle and a ray of the scene; none if what was drawn is not of it. Many are as flat as it allows.
fn drawn(draw: &mut Draw) -> Option<[f64; 17]> {
    let mut point = |size: f64| DVec3::from_array([0; 3].map(|_| size * draw.symmetric::<f64>()));
    let (a, along, across, turn) = (point(3.0), point(1.0), point(1.0), point(1.0));
    let fraction = |x: f64| (x + 1.0) / 2.0;
    let lengths = [turn.x, turn.y].map(|x| 0.25 * 8f64.powf(fraction(x)));
    let angle = (5.0 + 170.0 * fraction(turn.z).powi(3)).to_radians();
    let (e, f) = (along.normalize(), along.cross(across).normalize());
    let (b, c) = (
        a + lengths[0] * e,
        a + lengths[1] * (angle.cos() * e + angle.sin() * f),
    );
    let normal = (b - a).cross(c - a);
    let (weights, slope) = (point(1.0), point(1.0));
    let [v, w] = [weights.x, weights.y].map(fraction);
    let (v, w) = if v + w <= 1.0 {
        (v, w)
    } else {
        (1.0 - v, 1.0 - w)
    };
    let target = a + v * (b - a) + w * (c - a);
    let angle = (2.0 + 88.0 * fraction(weights.z).powi(4)).to_radians();
    let direction =
        angle.cos() * slope.cross(normal).normalize() + angle.sin() * normal.normalize();
    let origin = target - 4.0 * fraction(slope.x) * direction;
    let vertices = [a, b, c];
    let corner = |i: usize| {
        let [p, q, r] = [0, 1, 2].map(|k| vertices[(i + k) % 3]);
        (q - p).angle_between(r - p).to_degrees()
    };
    let is_of_scene = (0..3).all(|i| {
        let edge = vertices[i].distance(vertices[(i + 1) % 3]);
        (0.25..=2.0).contains(&edge)
            && corner(i) >= 5.0
            && vertices[i].abs().max_element() <= 3.0
            && vertices[i].distance(origin) <= 4.0
    });
    let mut inputs = [0.0; 17];
    for (i, x) in [origin, direction, a, b, c].into_iter().enumerate() {
        inputs[3 * i..3 * i + 3].copy_from_slice(&x.to_array());
    }
    (is_of_scene && origin.abs().max_element() <= 3.0).then_some(inputs)
}

#[test]
fn what_a_scene_says_of_divisors_and_quotients_is_true_of_its_triangles() {
    let measures = SCENE.domain().unwrap().measures.unwrap();
    let mut draw = Draw::new("scene", 1, 1);
    // Of each number, the closest to its limit: a share of it that is at most 1.
    let mut closest: BTreeMap<&str, f64> = BTreeMap::new();
    let mut tried = 0;
    for inputs in (0..400_000).filter_map(|_| drawn(&mut draw)) {
        tried += 1;
        let sample = Sample::of(&inputs);
        let k = sample.normal.largest_axis();
        let divisors = measures.known(Kind::Divisor, &sample, &[k]);
        let divisors = divisors.into_iter().map(|known| (known, true));
        let quotients = measures.known(Kind::Quotient, &sample, &[k]);
        let quotients = quotients.into_iter().map(|known| (known, false));
        for (Known { name, limit, value }, is_divisor) in divisors.chain(quotients) {
            let (value, limit) = (value.abs(), limit.to_f64());
            let share = if is_divisor {
                limit / value
            } else {
                value / limit
            };
            assert!(share <= 1.0, "{name}: {value} beside {limit} at {inputs:?}");
            let most = closest.entry(name).or_default();
            *most = most.max(share);
        }
    }
    println!("{tried} cases: {closest:?}");
    assert!(10_000 < tried, "{tried}");
    assert_eq!(closest.len(), 13, "{closest:?}");
    // No limit is far from what the scene has.
    assert!(closest.values().all(|share| 0.4 < *share), "{closest:?}");
}

#[test]
fn a_scene_knows_what_the_kernels_divide_by() {
    let domain = SCENE.domain().unwrap();
    let effort = Effort {
        evaluations: 0,
        seed: 1,
    };
    let mut all = Vec::new();
    for name in [
        "baldwin-weber",
        "moller-trumbore",
        "moller-trumbore+fma",
        "plane-unit-normal",
        "woop-watertight",
    ] {
        let entry = kernel::find(name).unwrap();
        let summary = Summary::<f64>::new(entry, domain, &[], &[], effort).unwrap();
        let limits = summary.gates.iter().flat_map(|gate| gate.limits.clone());
        let mut names: Vec<&str> = limits.map(|Assumption { name, .. }| name).collect();
        names.sort_unstable();
        names.dedup();
        all.push((name, names));
    }
    println!("{all:?}");
    let expected: [(&str, &[&str]); 5] = [
        (
            "baldwin-weber",
            &[
                "|(p×q)_k/N_k|",
                "|N_i/N_k|",
                "|N_k|",
                "|N·a/N_k|",
                "|N·d/N_k|",
                "|e_i/N_k|",
                "|t|",
            ],
        ),
        ("moller-trumbore", &["|N·d|", "|u|"]),
        ("moller-trumbore+fma", &["|N·d|", "|u|"]),
        ("plane-unit-normal", &["|N|", "|N·d|/|N|", "|t|"]),
        ("woop-watertight", &["|d_k|"]),
    ];
    assert_eq!(all, expected.map(|(name, names)| (name, names.to_vec())));
}

#[test]
fn parts_of_a_scene_have_the_largest_edges_and_the_least_areas() {
    let scene = Scene {
        edge: [0.01, 10.0],
        coordinates: 100.0,
        distance: 100.0,
        ..SCENE
    };
    let parts = scene.parts(&scene.shapes());
    let whole = scene.domain().unwrap();
    assert!(15 < parts.len() && parts.len() < 25, "{}", parts.len());
    let area = |domain: &Domain| domain.measures.unwrap().area;
    assert_eq!(parts.iter().map(|part| part.edge).max(), Some(whole.edge));
    assert_eq!(parts.iter().map(area).min(), Some(area(&whole)));
    for (part, next) in parts.iter().zip(&parts[1..]) {
        let (before, after) = (part.edge.to_f64(), next.edge.to_f64());
        assert!(before < after && after < 1.5 * before);
        assert!(area(part) <= area(next));
    }
    // A mesh without an area in one triangle.
    let mesh = Scene {
        shape: Some(0.5),
        ..scene
    };
    let parts = mesh.parts(&[(1.0, 0.5), (1.0, f64::INFINITY), (1.1, 0.75), (3.0, 4.0)]);
    let areas: Vec<f64> = parts.iter().map(|part| area(part).to_f64()).collect();
    assert_eq!(parts.len(), 3);
    assert!(
        areas
            .iter()
            .zip([0.5, 0.75, 4.0])
            .all(|(x, y)| 0.99 * y < *x && *x < y),
        "{areas:?}"
    );
}

/// N·d and a small number more is another number: so small that no float would show the difference.
#[test]
fn a_scene_does_not_know_what_is_nearly_a_number_that_it_knows() {
    let volume = || {
        let edge = |p: u8| [0, 1, 2].map(|axis| difference(p, 1, axis));
        let ([a, b, c], [d, e, f]) = (edge(2), edge(3));
        let minor =
            |a: &Recorded, b: &Recorded, c: &Recorded, d: &Recorded| a.clone() * b - c.clone() * d;
        let [x, y, z] = [3, 4, 5].map(Recorded::input);
        minor(&b, &f, &c, &e) * x + minor(&c, &d, &a, &f) * y + minor(&a, &e, &b, &d) * z
    };
    let power = |times: u32| (0..times).fold(Recorded::one(), |x, _| x.clone() + &x);
    let domain = SCENE.domain().unwrap();
    let floor = |run: &dyn Fn() -> Recorded| {
        let (path, place): (_, Place) = recorded(|| Recorded::one() / run());
        let prover = Prover::new(&path, domain, Format::F64);
        let divisor = prover.quotient(place).unwrap().divisor;
        prover.floor(divisor)
    };
    assert!(
        matches!(floor(&volume), Limit::Scene("|N·d|", _)),
        "{:?}",
        floor(&volume)
    );
    // 2^-60, and one part in 2^50.
    let more = || volume() + Recorded::one() / power(60);
    let larger = || volume() * (Recorded::one() + Recorded::one() / power(50));
    assert_eq!(floor(&more), Limit::Domain(domain.floor));
    assert_eq!(floor(&larger), Limit::Domain(domain.floor));
}
