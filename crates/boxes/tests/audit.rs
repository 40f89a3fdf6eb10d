//! Obligations, tallies, and what margins say of growth and padding.

use hairline_boxes::{
    BoxCase, Boxes, FAMILIES, Finding, KERNELS, Obligation, Question, Row, Scene, Search, Setup,
    Source, TABLE, Tally, audit, epsilon, find_family, padding, search, severity, truth,
};
use hairline_core::arith::Float;
use hairline_core::contract::{Boundary, Contract, Demand, Extent};
use hairline_core::engine::{Merge, Unobserved};
use hairline_core::kernel::{Entry, EpsilonText, Scalar};
use hairline_core::{Failure, KernelInfo, Verdict};

const CUBE: [[f64; 3]; 2] = [[0.0; 3], [1.0; 3]];

fn setup(name: &str) -> Setup {
    Setup::published(TABLE.find(name).unwrap()).swap_remove(0)
}

fn source(name: &str) -> Source {
    Source::Family(find_family(name).unwrap())
}

/// The closed box, as slab tests promise it.
fn closed(extent: Extent) -> Contract {
    Contract {
        extent,
        ends: Boundary::Closed,
        ..setup("divided").contract
    }
}

#[test]
fn obligations_follow_the_contract() {
    let owed = |case: &BoxCase<f64>, contract: &Contract| Obligation::new(&truth(case), contract);
    let through = BoxCase::new([2.0, 0.5, 0.5], [1.0, 0.0, 0.0], CUBE);
    let extents = [Extent::Line, Extent::Ray, Extent::Interval].map(closed);
    let [line, ray, interval] = extents;
    assert_eq!(
        [line, ray].map(|contract| owed(&through, &contract)),
        [Obligation::Hit, Obligation::Miss]
    );
    let before = through.on(-9.0, 0.0);
    assert_eq!(
        [ray, interval].map(|it| owed(&before, &it)),
        [Obligation::Miss, Obligation::Hit]
    );

    let corner = BoxCase::new([2.0, 0.0, 1.0], [-1.0, 1.0, 0.0], CUBE);
    let boundary = |boundary| Contract { boundary, ..ray };
    let boundaries = [Boundary::Closed, Boundary::Open, Boundary::Free].map(boundary);
    let all = [Obligation::Hit, Obligation::Miss, Obligation::Free];
    assert_eq!(boundaries.map(|contract| owed(&corner, &contract)), all);

    let leaving = BoxCase::new([1.0, 0.5, 0.5], [1.0, 0.0, 0.0], CUBE);
    let ends =
        [Boundary::Closed, Boundary::Open, Boundary::Free].map(|ends| Contract { ends, ..ray });
    assert_eq!(ends.map(|contract| owed(&leaving, &contract)), all);

    let in_face = BoxCase::new([2.0, 1.0, 0.5], [-1.0, 0.0, 0.0], CUBE);
    let flat = BoxCase::new(
        [0.5, 0.5, 2.0],
        [0.0, 0.0, -1.0],
        [[0.0; 3], [1.0, 1.0, 0.0]],
    );
    let demands = [Demand::Hit, Demand::Miss, Demand::Free];
    let coplanar = demands.map(|coplanar| ray.with_flat(coplanar, Demand::Hit));
    assert_eq!(coplanar.map(|contract| owed(&in_face, &contract)), all);
    let degenerate = demands.map(|degenerate| ray.with_flat(Demand::Hit, degenerate));
    assert_eq!(degenerate.map(|contract| owed(&flat, &contract)), all);

    let empty = BoxCase::new([0.5; 3], [1.0; 3], [[1.0; 3], [0.0; 3]]);
    let invalid = [Demand::Free, Demand::Miss].map(|invalid| Contract { invalid, ..ray });
    assert_eq!(
        invalid.map(|it| owed(&empty, &it)),
        [Obligation::Free, Obligation::Miss]
    );
    let outside = BoxCase::new([2.0, 2.0, 0.0], [1.0, 0.0, 0.0], CUBE);
    assert_eq!(owed(&outside, &line), Obligation::Miss);
}

#[test]
fn verdicts_are_judged_by_what_is_owed() {
    let miss = Verdict::<f32>::miss(None);
    let hit = Verdict { hit: true, ..miss };
    let judged = |obligation: Obligation| [hit, miss].map(|verdict| obligation.judge(&verdict));
    assert_eq!(
        judged(Obligation::Hit),
        [Finding::Right, Finding::FalseMiss]
    );
    assert_eq!(
        judged(Obligation::Miss),
        [Finding::FalseHit, Finding::Right]
    );
    assert_eq!(judged(Obligation::Free), [Finding::Right, Finding::Right]);
    let failed = Verdict::failed(Failure::Panic);
    assert_eq!(Obligation::Free.judge::<f32>(&failed), Finding::Failed);
}

#[test]
fn padding_is_the_distance_and_severity_is_its_share() {
    let beside = BoxCase::new([3.0, 0.5, 4.0], [0.0, 0.0, -1.0], CUBE);
    assert_eq!(padding(&beside).unwrap().length.to_string(), "2");
    assert_eq!(severity(&beside, Extent::Ray), Some(0.5));
    // Through the middle: the box may shrink by half.
    let middle = BoxCase::new([0.5, 0.5, 4.0], [0.0, 0.0, -1.0], CUBE);
    assert_eq!(padding(&middle).unwrap().length.to_string(), "-1/2");
    // Both slabs at a corner give way.
    let diagonal = BoxCase::new([2.0, 0.0, 0.5], [-1.0, 1.0, 0.0], [[0.0; 3], [0.75; 3]]);
    assert_eq!(padding(&diagonal).unwrap().length.to_string(), "1/4");
    let ends_before = BoxCase::new([3.0, 0.5, 0.5], [-1.0, 0.0, 0.0], CUBE).on(0.0, 1.5);
    assert_eq!(padding(&ends_before).unwrap().length.to_string(), "1/2");
    assert_eq!(severity(&ends_before, Extent::Line), Some(0.5 / 3.0));
    // Grown by its padding a box is met, and by less it is missed.
    let all = FAMILIES
        .iter()
        .flat_map(|family| (0..40).map(|i| family.case::<f32>(5, i).widen()));
    for case in all {
        let length = padding(&case).unwrap().length;
        let meets = truth(&case).hits_closed() == Some(true);
        assert_eq!(meets, length <= num_traits::Zero::zero(), "{}", case.hex());
    }
}

#[test]
fn rows_add_up_however_they_are_split() {
    let setups: Vec<Setup> = KERNELS.iter().flat_map(Setup::published).collect();
    let sources = ["corner-near", "in-face", "huge"].map(source);
    let rows = audit::<f32>(&setups, &sources, 3000, 9, &Unobserved);
    assert_eq!(rows.len(), setups.len() * sources.len());
    for Row { tally, .. } in &rows {
        assert_eq!(tally.cases, 3000);
        assert!(tally.must_hit + tally.must_miss <= tally.cases);
        let Tally {
            false_hits,
            false_misses,
            ..
        } = tally;
        assert!(false_hits.count <= tally.must_miss && false_misses.count <= tally.must_hit);
        assert_eq!(false_misses.count > 0, false_misses.first.is_some());
        assert_eq!(false_misses.count > 0, false_misses.worst.is_some());
    }
    let one = audit::<f32>(&setups, &sources, 1, 9, &Unobserved);
    for (one, row) in one.iter().zip(&rows) {
        let [mut ahead, mut behind] = [one.tally.clone(), row.tally.clone()];
        ahead.merge(row.tally.clone());
        behind.merge(one.tally.clone());
        assert_eq!(ahead, behind);
        assert_eq!(ahead.cases, 3001);
        assert_eq!(ahead.false_hits.worst, row.tally.false_hits.worst);
    }
}

#[test]
fn an_audit_finds_what_is_known_of_slab_tests() {
    let names = ["barnes-2015", "ize", "multiplied", "kay-kajiya"];
    let setups = names.map(setup);
    let sources = ["flat", "corner-near", "interior", "outside"].map(source);
    let rows = audit::<f32>(&setups, &sources, 2000, 1, &Unobserved);
    let of = |name: &str, family: &str| -> &Tally {
        let is = |row: &&Row| row.setup.entry.info.name == name && row.source == family;
        &rows.iter().find(is).unwrap().tally
    };
    assert_eq!(
        of("barnes-2015", "flat").false_misses.count,
        2000,
        "far is never above near"
    );
    assert_eq!(of("ize", "corner-near").false_misses.count, 0);
    assert!(of("multiplied", "corner-near").false_misses.count > 20);
    assert!(
        of("ize", "corner-near").false_hits.count
            > of("multiplied", "corner-near").false_hits.count
    );
    for name in names {
        for family in ["interior", "outside"] {
            assert_eq!(of(name, family).rate(), Some(0.0), "{name} {family}");
        }
    }
}

#[test]
fn the_largest_epsilon_loses_nothing_and_the_next_one_loses_its_case() {
    let multiplied = setup("multiplied");
    let question = Question {
        setup: &multiplied,
        gate: "growth",
        source: source("corner-near"),
        count: 4000,
        seed: 1,
    };
    let answer = epsilon::<f32>(&question, &Unobserved).unwrap();
    let largest = answer.largest.unwrap();
    assert!(largest.epsilon < 0.0 && answer.lost_at_zero > 100 && answer.lost_anyway == 0);
    let lost_at = |epsilon: f32| {
        let value = EpsilonText::Decimal(format!("{epsilon:e}"));
        let setup = multiplied.clone().with("growth", value).unwrap();
        let rows = audit::<f32>(&[setup], &[question.source], 4000, 1, &Unobserved);
        rows[0].tally.clone()
    };
    let [kept, lost] = [largest.epsilon, largest.epsilon.next_up()].map(lost_at);
    assert_eq!(kept.false_misses.count, 0);
    assert_eq!(lost.false_misses.first, Some(largest.index));
    assert_eq!(kept.false_hits.count, answer.false_hits_at_largest);
    let plain = lost_at(0.0);
    assert_eq!(plain.false_misses.count, answer.lost_at_zero);
    assert_eq!(plain.false_hits.count, answer.false_hits_at_zero);
    assert_eq!(answer.must_hit + answer.must_miss, 4000);
}

#[test]
fn a_margin_of_zero_loses_nothing_at_zero() {
    let slopes = setup("eisemann-slopes");
    let question = Question {
        setup: &slopes,
        gate: "edge",
        source: source("corner"),
        count: 2000,
        seed: 1,
    };
    let answer = epsilon::<f64>(&question, &Unobserved).unwrap();
    let rows = audit::<f64>(
        std::slice::from_ref(&slopes),
        &[question.source],
        2000,
        1,
        &Unobserved,
    );
    assert_eq!(answer.lost_at_zero, rows[0].tally.false_misses.count);
    assert_eq!(answer.lost_at_own, answer.lost_at_zero);
}

#[test]
fn a_panic_is_a_case_without_a_verdict() {
    const OWN: KernelInfo = KernelInfo::own("panics", Contract::CLOSED_RAY);
    let test = |case: &BoxCase<f64>, _: &[f64]| {
        assert!(case.ray.origin.x < 0.0, "not here");
        None
    };
    let entry: &'static Entry<Boxes> = Box::leak(Box::new(Entry::described(&OWN).f64(test)));
    let setups = Setup::published(entry);
    assert!(audit::<f32>(&setups, &[source("interior")], 10, 1, &Unobserved).is_empty());
    let rows = audit::<f64>(&setups, &[source("interior")], 3000, 1, &Unobserved);
    let Tally { cases, failed, .. } = &rows[0].tally;
    assert_eq!(*cases, 3000);
    assert!(1200 < failed.count && failed.count < 1800 && failed.worst.is_none());
}

#[test]
fn a_scene_needs_a_padding_of_its_size() {
    let padded = setup("padded-box");
    let needed = |extent: f64| {
        let scene = Source::Scene(Scene::new(extent, extent / 64.0).unwrap());
        let question = Question {
            setup: &padded,
            gate: "padding",
            source: scene,
            count: 4000,
            seed: 1,
        };
        epsilon::<f32>(&question, &Unobserved)
            .unwrap()
            .largest
            .unwrap()
            .epsilon
    };
    let [small, large] = [needed(1.0), needed(1024.0)];
    assert!(small < 0.0, "{small:e}");
    assert_eq!(large, small * 1024.0, "it scales");
    assert!(Scene::new(1.0, 2.0).is_err() && Scene::new(f64::NAN, 1.0).is_err());
}

#[test]
fn a_search_finds_what_two_roundings_more_need() {
    let found = |name: &str| {
        let setup = setup(name);
        let search_from = Search {
            setup: &setup,
            source: source("corner-near"),
            starts: 24,
            steps: 1500,
            seed: 1,
        };
        let found = search::<f32>(&search_from, &Unobserved).unwrap().unwrap();
        // The number that the far end is multiplied by, in units above 1.
        ((1.0 - found.margin) - 1.0) / f32::EPSILON
    };
    let [divided, multiplied, fused] = ["divided", "multiplied", "fused"].map(found);
    assert!((1.0..=2.0).contains(&divided), "{divided}");
    assert!((2.0..=3.0).contains(&multiplied), "{multiplied}");
    assert!(fused > 1e6, "{fused}");
}

/// A case from the bits of its numbers, up to max.
fn case_of_bits(bits: [u32; 12]) -> BoxCase<f32> {
    let numbers = bits.map(f32::from_bits);
    let vector = |first: usize| [0, 1, 2].map(|i| numbers[first + i]);
    BoxCase::new(vector(0), vector(3), [vector(6), vector(9)])
}

/// A longer search found it: the far end needs three units in the last place, where Ize's listing has two.
#[test]
fn the_constant_of_a_listing_loses_a_box_that_its_analysis_keeps() {
    let case = case_of_bits([
        0xc5fd_25a4,
        0x3a94_1d8a,
        0x404c_ec44,
        0x3b16_f630,
        0x3be4_2032,
        0xc07a_e3e9,
        0xc68a_dd32,
        0xbd1e_4b99,
        0xc126_b733,
        0xc5fd_25a1,
        0x3baf_8a1f,
        0x3f52_5c82,
    ]);
    assert_eq!(truth(&case).hits_closed(), Some(true));
    let ize = Setup::published(TABLE.find("ize").unwrap());
    let hits = ize.iter().map(|setup| {
        let mut verdict = [Verdict::miss(None)];
        let subject = f32::subject(setup.entry).unwrap();
        subject.run(&[case], &setup.epsilons::<f32>().unwrap(), &mut verdict);
        (setup.set, verdict[0].hit)
    });
    assert_eq!(
        hits.collect::<Vec<_>>(),
        [("source", false), ("gamma3", true)]
    );
}

#[test]
fn a_scene_beyond_the_floats_has_no_obligations() {
    let owed = |extent: f64| {
        let scene = Source::Scene(Scene::new(extent, extent / 2.0).unwrap());
        let rows = audit::<f32>(&[setup("divided")], &[scene], 100, 1, &Unobserved);
        rows[0].tally.must_hit + rows[0].tally.must_miss
    };
    assert_eq!([1e-60, 1.0, 1e60].map(owed), [0, 100, 0]);
}

#[test]
fn bad_questions_are_errors() {
    let divided = setup("divided");
    let question = Question {
        setup: &divided,
        gate: "edge",
        source: source("edge"),
        count: 1,
        seed: 1,
    };
    let error = epsilon::<f64>(&question, &Unobserved).unwrap_err();
    assert_eq!(error, "divided has no gate 'edge'");
    let value = |text: &str| EpsilonText::of(text).unwrap();
    assert!(divided.clone().with("padding", value("1")).is_err());
    assert!(divided.clone().with("growth", value("nan")).is_err());
    assert!(setup("smits").with("t", value("1")).is_err());
    let mut without_values = divided.clone();
    without_values.values.clear();
    assert_eq!(without_values.epsilons::<f32>(), None);
    let own = divided.with("growth", value("-2*EPSILON")).unwrap();
    assert_eq!(own.epsilons::<f64>().unwrap(), [-2.0 * f64::EPSILON]);
    assert_eq!(
        own.epsilons::<f32>().unwrap(),
        [<f32 as Float>::EPSILON * -2.0]
    );
}
