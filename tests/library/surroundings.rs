//! Groups that generators make, with the ring around them: it closes the surface, is where its planes go on, and takes the
//! hits that rounding moves, and no others.

use hairline::internals::audit::{EpsilonChoice, GroupCount, Plan, Row, Source, Unobserved, run};
use hairline::internals::case::{Case, Parameters, Scene};
use hairline::internals::contract::Contract;
use hairline::internals::family::{Family, Grouping, Stratum, find};
use hairline::internals::judge::{GroupTruth, group_obligation};
use hairline::internals::kernel;
use hairline::internals::oracle;
use hairline::internals::truth::{Crossing, Feature, Truth};
use std::collections::BTreeMap;

fn source(family: &'static Family, scene: Option<&str>, count: u64) -> Source {
    let scene = scene.map(|text| Scene::parse(text).unwrap().0);
    Source::of(
        family,
        Parameters {
            scene,
            ..Parameters::default()
        },
        1,
        count,
    )
}

/// The groups of a source, each with its ring.
fn surrounded(source: &Source) -> Vec<[Vec<Case<f32>>; 2]> {
    let made = |index: u64| {
        let (group, mut ring) = (source.make::<f32>(index).cases().to_vec(), Vec::new());
        assert!(source.add_neighbours(index, &group, &mut ring));
        [group, ring]
    };
    (0..source.count).map(made).collect()
}

fn corners(case: &Case<f32>) -> [[u32; 3]; 3] {
    // -0 and 0 are one number.
    case.triangle
        .vertices()
        .map(|vertex| <[f32; 3]>::from(vertex).map(|x| (x + 0.0).to_bits()))
}

/// How often triangles run through each edge in its direction.
fn edges<'a>(cases: impl Iterator<Item = &'a Case<f32>>) -> BTreeMap<[[u32; 3]; 2], u32> {
    let mut edges = BTreeMap::new();
    for [a, b, c] in cases.map(corners) {
        for edge in [[a, b], [b, c], [c, a]] {
            *edges.entry(edge).or_default() += 1;
        }
    }
    edges
}

/// The families whose groups have a ring.
const FAMILIES: [(&str, Option<&str>); 6] = [
    ("shared-edge", None),
    ("fan", None),
    ("vertex-fan", None),
    ("noise", None),
    ("scene-edges", Some("city")),
    ("scene-vertices", Some("room,plane=box")),
];

#[test]
fn no_edge_of_a_group_is_open_within_its_ring() {
    for (name, scene) in FAMILIES {
        for [group, ring] in surrounded(&source(find(name).unwrap(), scene, 300)) {
            let all = edges(group.iter().chain(&ring));
            assert!(
                all.values().all(|count| *count == 1),
                "{name}: {}",
                group[0].hex()
            );
            let open = |edge: &[[u32; 3]; 2]| !all.contains_key(&[edge[1], edge[0]]);
            let outer: Vec<[u32; 3]> = all
                .keys()
                .filter(|edge| open(edge))
                .flatten()
                .copied()
                .collect();
            assert!(!outer.is_empty());
            let inner = group.iter().flat_map(corners);
            assert!(
                inner.into_iter().all(|corner| !outer.contains(&corner)),
                "{name}"
            );
        }
    }
}

/// On lattice points nothing of the ring is rounded: by the definition in rationals it faces the line as the group does, and
/// the line, which meets the group, does not meet it.
#[test]
fn a_line_that_crosses_a_group_passes_within_its_ring() {
    let mut crossings = 0;
    for name in ["shared-edge", "fan"] {
        for [group, ring] in surrounded(&source(find(name).unwrap(), None, 1500)) {
            let is_integer = |x: &f32| x.fract() == 0.0;
            let vectors = group.iter().flat_map(|case| case.vectors().concat());
            if !vectors.into_iter().all(|x| is_integer(&x)) {
                continue;
            }
            let truths: Vec<Truth> = group
                .iter()
                .map(|case| oracle::define(case).truth)
                .collect();
            let grouping = find(name).unwrap().grouping;
            if group_obligation(&group, &truths, &Contract::CLOSED_RAY, grouping)
                != GroupTruth::Crossing
            {
                continue;
            }
            crossings += 1;
            let facing = truths[0].crossing().unwrap().facing;
            for case in &ring {
                let truth = oracle::define(case).truth;
                let is_passed =
                    |it: &Crossing| it.feature == Feature::Outside && it.facing == facing;
                assert!(
                    truth.crossing().is_some_and(is_passed),
                    "{name}: {truth:?} {}",
                    case.hex()
                );
            }
        }
    }
    assert!(500 < crossings, "{crossings}");
}

/// The counts of a kernel on a source in `f32`.
fn counts(name: &str, epsilons: Option<&str>, source: Source) -> GroupCount {
    let choice = epsilons.map_or(EpsilonChoice::Source, |text| {
        EpsilonChoice::parse(text).unwrap()
    });
    let rows: Vec<Row> = choice.rows(&[kernel::find(name).unwrap()], None).unwrap();
    let plan = Plan::new(rows[..1].to_vec(), vec![source], [true, false], 0);
    run(&plan, &Unobserved).cells[0].tally.groups.clone()
}

#[test]
fn a_watertight_kernel_leaks_nowhere_in_a_city() {
    let of = |stratum: Stratum| source(stratum.family(), Some("city"), 100_000);
    let found = Stratum::ALL.map(|stratum| match stratum.family().grouping {
        Grouping::SharedEdge | Grouping::Fan => counts("woop-watertight", None, of(stratum)),
        _ => GroupCount::default(),
    });
    assert_eq!(found.iter().map(|count| count.cracks).sum::<u64>(), 0);
    // Rounding moves some hits over the rim of their group: they are the ring's.
    assert!(0 < found.iter().map(|count| count.elsewhere).sum::<u64>());
}

#[test]
fn a_kernel_that_refuses_everything_leaks_everywhere() {
    for (name, scene) in FAMILIES {
        let found = counts(
            "moller-trumbore",
            Some("parallel=1e30"),
            source(find(name).unwrap(), scene, 500),
        );
        // Next to noise the ring is folded as the group is: what is lost from both sides may be a silhouette.
        let least = if name == "noise" {
            found.crossings / 2
        } else {
            found.crossings
        };
        assert!(
            0 < found.crossings && least <= found.cracks,
            "{name}: {found:?}"
        );
    }
}

#[test]
fn plucker_leaks_at_vertices_of_any_coordinates_and_woop_next_to_noise() {
    let cracks = |kernel: &str, family: &str| {
        counts(kernel, None, source(find(family).unwrap(), None, 5000)).cracks
    };
    assert_eq!(
        ["fan", "vertex-fan"].map(|family| 0 < cracks("plucker", family)),
        [false, true]
    );
    assert_eq!(
        ["vertex-fan", "noise"].map(|family| 0 < cracks("woop-watertight", family)),
        [false, true]
    );
}
