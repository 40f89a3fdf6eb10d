//! The truth: its layers, its definition and integers agree, and families keep their promises.

mod reference;

use hairline_boxes::{
    BoxCase, Class, FAMILIES, FamilyScalar, Layers, Origin, Overlap, Truth, case_of, check, define,
    truth, truth_counted,
};
use hairline_core::case::CaseId;
use reference::hard_case;

fn layers_are_the_definition_and_the_integers<F: FamilyScalar>(count: u64) {
    let mut layers = Layers::default();
    let mut kinds = [0; 8];
    for index in 0..count {
        let case = hard_case::<F>(1, index);
        let defined = check(&case).unwrap();
        assert_eq!(reference::truth(&case.widen()), defined, "{}", case.hex());
        truth_counted(&case, &mut layers);
        kinds[match defined {
            Truth::Invalid => 0,
            Truth::Empty => 1,
            Truth::Outside => 2,
            Truth::Meets(meeting) => 3 + meeting.class as usize,
        }] += 1;
    }
    assert!(kinds.iter().all(|kind| count / 1000 < *kind), "{kinds:?}");
    assert!(
        layers.filter > count / 4 && layers.integers > count / 10,
        "{layers:?}"
    );
}

#[test]
fn layers_are_the_definition_and_the_integers_in_either_scalar() {
    layers_are_the_definition_and_the_integers::<f32>(50_000);
    layers_are_the_definition_and_the_integers::<f64>(50_000);
}

#[test]
fn families_keep_their_promises_and_ids_make_their_cases_again() {
    for family in FAMILIES {
        for index in 0..500 {
            let narrow = family.case::<f32>(7, index);
            let found = check(&narrow).unwrap();
            assert!(
                family.keeps(&found),
                "{}: {found:?} {}",
                family.name,
                narrow.hex()
            );
            let wide = family.case::<f64>(7, index);
            let found = check(&wide).unwrap();
            assert!(
                family.keeps(&found),
                "{}: {found:?} {}",
                family.name,
                wide.hex()
            );
            let id: CaseId = family.id::<f64>(7, index).to_string().parse().unwrap();
            assert_eq!(case_of::<f64>(&id).unwrap().hex(), wide.hex());
            assert!(case_of::<f32>(&id).is_err());
        }
    }
}

/// A digest of many cases: it changes with any of them.
fn digest<F: FamilyScalar>(name: &str) -> u64 {
    let family = hairline_boxes::find_family(name).unwrap();
    let mut digest = 0u64;
    for index in 0..200 {
        for number in family.case::<F>(1, index).numbers() {
            digest = digest.rotate_left(7).wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ number.to_bits();
        }
    }
    digest
}

#[test]
fn cases_stay_as_they_are_until_a_version_is_raised() {
    let digests: Vec<String> = FAMILIES
        .iter()
        .map(|family| {
            let [single, double] = [digest::<f32>(family.name), digest::<f64>(family.name)];
            format!(
                "{}@{} {single:016x} {double:016x}",
                family.name, family.version
            )
        })
        .collect();
    let known: Vec<&str> = include_str!("digests.txt").lines().collect();
    assert_eq!(
        digests, known,
        "raise the version of a family whose cases changed"
    );
}

#[test]
fn the_boundary_of_the_definition() {
    let cube = [[0.0; 3], [1.0; 3]];
    let meeting = |case: BoxCase<f64>| match define(&case).truth {
        Truth::Meets(meeting) => meeting,
        truth => panic!("{truth:?}"),
    };
    let leaving = meeting(BoxCase::new([1.0, 0.5, 0.5], [1.0, 0.0, 0.0], cube));
    assert_eq!(
        (leaving.class, leaving.origin, leaving.ray),
        (Class::Interior, Origin::On, Overlap::AtAnEnd)
    );
    let along = meeting(BoxCase::new([2.0, 1.0, 1.0], [-1.0, 0.0, -0.0], cube));
    assert_eq!((along.class, along.origin), (Class::Along, Origin::Outside));
    let flat = [[0.0, 0.0, 1.0], [1.0; 3]];
    let through = meeting(BoxCase::new([0.5, 0.5, 0.0], [0.0, 0.0, 1.0], flat).on(0.0, 1.0));
    assert_eq!(
        (through.class, through.interval),
        (Class::Face, Overlap::AtAnEnd)
    );
    let inverted = BoxCase::new([0.5; 3], [1.0; 3], [[1.0; 3], [0.0; 3]]);
    assert_eq!(truth(&inverted), Truth::Empty);
    let nan = BoxCase::new([f64::NAN; 3], [1.0; 3], cube);
    assert_eq!(truth(&nan), Truth::Invalid);
    let range = define(&BoxCase::new([-1.0, 0.5, 0.5], [2.0, 0.0, 0.0], cube).on(0.75, 9.0));
    let [line, interval] = [range.line.unwrap(), range.interval.unwrap()];
    assert_eq!(
        (line.enter.to_string(), line.exit.to_string()),
        ("1/2".into(), "1".into())
    );
    assert_eq!(interval.enter.to_string(), "3/4");
}
