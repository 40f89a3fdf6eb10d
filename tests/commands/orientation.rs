//! Orientation predicates: what is known about robust, laws of the exact sign, promises, the command.

use hairline::internals::audit::Observer;
use hairline::internals::orientation::{
    Answer, Counts, Dimension, FAMILIES, Finding, KNOWN, Plan, Points, Row, Scalar, ScaledPoints,
    SetSummary, default_rows, defined_determinant, find_known, judge, run,
};
use serde_json::Value;
use std::cmp::Ordering;
use std::path::Path;
use std::process::{Command, Output};

/// Without a clock.
struct Silent;

impl Observer for Silent {
    fn advance(&self, _: u64) {}
    fn now(&self) -> u64 {
        0
    }
}

fn rows() -> Vec<Row> {
    default_rows(&["0".to_owned(), "1e-6".to_owned()])
}

fn robust(points: &Points<f64>) -> Answer {
    let row = rows().into_iter().find(|row| {
        row.predicate.name.starts_with("robust") && row.predicate.dimension == points.dimension()
    });
    row.unwrap().answer(points).unwrap().1
}

fn sign<F: Scalar>(points: &Points<F>) -> Ordering {
    ScaledPoints::new(points).unwrap().determinant().sign()
}

/// Some points of every family, in every dimension.
fn each_case<F: Scalar>(count: u64, mut check: impl FnMut(&str, &Points<F>)) {
    for dimension in Dimension::ALL {
        for family in FAMILIES {
            for index in 0..count {
                let id = family.id::<F>(dimension, 1, index).to_string();
                check(&id, &family.make(dimension, 1, index));
            }
        }
    }
}

/// h times the unit corners and the origin, with h = 2^exponent.
fn corner(exponent: i32) -> Points<f64> {
    Points::three([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [0.0; 3]]).scaled(exponent)
}

#[test]
fn robust_loses_a_corner_of_2_to_the_minus_359() {
    assert_eq!(sign(&corner(-359)), Ordering::Greater);
    assert_eq!(robust(&corner(-359)), Answer::Zero);
    assert_eq!(robust(&corner(-358)), Answer::Plus, "2^-1074 is a float");
}

#[test]
fn robust_makes_a_nan_of_a_corner_of_2_to_the_342() {
    assert_eq!(sign(&corner(342)), Ordering::Greater);
    assert_eq!(robust(&corner(342)), Answer::NaN);
    assert_eq!(judge(Answer::NaN, Ordering::Greater), Some(Finding::WrongSign));
    assert_eq!(robust(&corner(341)), Answer::Plus, "2^1023 is a float");
}

#[test]
fn robust_takes_exactly_coplanar_points_of_2_to_the_minus_359_for_others() {
    let points = Points::three([[2.0, 0.0, -2.0], [0.0, 2.0, 2.0], [-2.0, -1.0, 1.0], [0.0; 3]]);
    assert_eq!(sign(&points), Ordering::Equal);
    assert_eq!(robust(&points), Answer::Zero);
    assert_eq!(sign(&points.scaled(-359)), Ordering::Equal);
    let finding = judge(robust(&points.scaled(-359)), Ordering::Equal);
    assert_eq!(finding, Some(Finding::MissedZero));
}

#[test]
fn robust_is_wrong_on_every_known_case_and_its_stored_sign_is_the_exact_one() {
    for known in KNOWN {
        assert_eq!(sign(&known.points()), known.sign, "{}", known.name);
        assert!(judge(robust(&known.points()), known.sign).is_some(), "{}", known.name);
    }
    assert_eq!(find_known("corner-underflow-3d").unwrap().points(), corner(-359));
}

/// The exponent of the largest difference of coordinates from the last point, which is all that a
/// determinant sees.
fn extent_exponent(points: &Points<f64>) -> i32 {
    let rows: Vec<&[f64]> = points.iter().collect();
    let last = rows[rows.len() - 1];
    let differences = rows.iter().flat_map(|row| row.iter().zip(last).map(|(x, y)| (x - y).abs()));
    let largest = differences.fold(0.0, f64::max);
    if largest == 0.0 { 0 } else { (largest.to_bits() >> 52) as i32 - 1023 }
}

#[test]
fn robust_is_right_where_the_extent_is_within_2_to_the_300() {
    each_case::<f64>(1000, |id, points| {
        if id.contains(":range-") {
            return;
        }
        let exponent = extent_exponent(points);
        for k in [-300, -200, -100, 0, 100, 200, 300] {
            let points = points.scaled(k - exponent);
            let exact = sign(&points);
            assert_eq!(judge(robust(&points), exact), None, "{id} at 2^{k}");
        }
    });
}

fn integers_are_the_definition<F: Scalar>() {
    each_case::<F>(60, |id, points| {
        let integers = ScaledPoints::new(points).unwrap().determinant().to_rational();
        assert_eq!(integers, defined_determinant(points).unwrap(), "{id}");
    });
}

#[test]
fn the_integer_determinant_is_the_rational_one() {
    integers_are_the_definition::<f32>();
    integers_are_the_definition::<f64>();
}

fn swapping_flips<F: Scalar>() {
    each_case::<F>(100, |id, points| {
        let exact = sign(points);
        let n = points.dimension().number();
        for (i, j) in (0..=n).flat_map(|i| (0..i).map(move |j| (i, j))) {
            assert_eq!(sign(&points.swapped(i, j)), exact.reverse(), "{id}: {i} and {j}");
        }
    });
}

#[test]
fn swapping_two_points_flips_the_exact_sign() {
    swapping_flips::<f32>();
    swapping_flips::<f64>();
}

#[test]
fn scaling_by_powers_of_two_keeps_the_exact_sign() {
    each_case::<f64>(100, |id, points| {
        for k in [-900, -37, 1, 400] {
            let scaled = points.scaled(k);
            // Only what comes back was not rounded.
            if scaled.is_finite() && scaled.scaled(-k) == *points {
                assert_eq!(sign(&scaled), sign(points), "{id} times 2^{k}");
            }
        }
    });
}

fn families_keep_their_promises<F: Scalar>() {
    for dimension in Dimension::ALL {
        for family in FAMILIES {
            let mut signs = [0; 3];
            for index in 0..3000 {
                let points: Points<F> = family.make(dimension, 7, index);
                let scaled = ScaledPoints::new(&points).unwrap();
                let exact = scaled.determinant();
                let id = family.id::<F>(dimension, 7, index);
                assert!(family.keeps::<F>(dimension, &scaled, &exact), "{id}");
                signs[(exact.sign() as i8 + 1) as usize] += 1;
            }
            let name = family.name;
            match name {
                "generic" => assert_eq!(signs[1], 0, "{name}"),
                "degenerate" => assert_eq!(signs, [0, 3000, 0], "{name}"),
                _ => assert!(signs.iter().all(|&n| n > 0), "{name}, {dimension:?}: {signs:?}"),
            }
        }
    }
}

#[test]
fn every_family_keeps_its_promise_in_every_scalar_and_dimension() {
    families_keep_their_promises::<f32>();
    families_keep_their_promises::<f64>();
}

#[test]
fn promises_can_be_broken() {
    let points = corner(0);
    let scaled = ScaledPoints::new(&points).unwrap();
    let exact = scaled.determinant();
    for family in FAMILIES {
        assert!(!family.keeps::<f64>(Dimension::Three, &scaled, &exact), "{}", family.name);
    }
}

fn plan(count: u64) -> Plan {
    Plan { rows: rows(), dimensions: Dimension::ALL.to_vec(), scalars: [true; 2], count, seed: 1 }
}

/// What does not depend on a clock.
fn results(threads: usize, count: u64) -> (Vec<SetSummary>, Vec<(usize, usize, Counts)>) {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
    let sums = pool.install(|| run(&plan(count), &Silent));
    let cells = sums.cells.iter().map(|cell| (cell.row, cell.set, cell.counts)).collect();
    (sums.sets, cells)
}

#[test]
fn sums_do_not_depend_on_the_number_of_threads() {
    assert_eq!(results(1, 5000), results(4, 5000));
}

#[test]
fn the_audit_counts_what_a_plain_loop_counts() {
    let (sets, cells) = results(2, 1500);
    let rows = rows();
    assert_eq!((sets.len(), cells.len()), (2 * 2 * 6, 2 * (2 + 3) * 6));
    for (row, set, counts) in cells {
        let set = &sets[set];
        if set.scalar != "f64" {
            continue;
        }
        let mut expected = Counts::default();
        for index in 0..1500 {
            let points: Points<f64> = FAMILIES[set.family].make(set.dimension, 1, index);
            let (_, answer) = rows[row].answer(&points).unwrap();
            if let Some(finding) = judge(answer, sign(&points)) {
                let k = finding as usize;
                expected.findings[k] += 1;
                expected.first[k].get_or_insert(index);
            }
        }
        let family = FAMILIES[set.family].name;
        assert_eq!(counts, expected, "{} on {family}", rows[row].label());
    }
}

fn hairline(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_hairline")).arg("orient").args(arguments).output().unwrap()
}

fn text(output: &Output) -> String {
    assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout.clone()).unwrap()
}

fn json(arguments: &[&str]) -> Value {
    serde_json::from_str(&text(&hairline(arguments))).unwrap()
}

#[test]
fn the_command_reports_every_row_and_its_examples_show_again() {
    let record = json(&["-n", "2000", "--format", "json", "--quiet"]);
    assert_eq!(record["schema"], "hairline-orientation/1");
    let results = record["result"]["results"].as_array().unwrap();
    assert_eq!(results.len(), 60);
    assert_eq!(record["provenance"]["timings"].as_array().unwrap().len(), 60);
    for set in record["result"]["sets"].as_array().unwrap() {
        assert_eq!(set["promise_broken"], 0, "{set}");
    }
    let of = |family: &str| {
        results.iter().find(|row| row["predicate"] == "robust::orient3d" && row["family"] == family)
    };
    assert_eq!(of("near").unwrap()["wrong_sign"]["count"], 0);
    assert!(of("range-high").unwrap()["wrong_sign"]["count"].as_u64().unwrap() > 0);
    for example in record["result"]["examples"].as_array().unwrap() {
        let case = &example["case"];
        let epsilon = example["epsilon"].as_str().unwrap_or("0");
        let id = case["id"].as_str().unwrap();
        let again = json(&["--case", id, "--epsilon", epsilon, "--format", "json"]);
        let again = &again["cases"][0];
        for key in ["points", "bits", "sign", "determinant"] {
            assert_eq!(again[key], case[key], "{id}");
        }
        let answers = again["answers"].as_array().unwrap();
        assert!(answers.contains(&case["answers"][0]), "{example}: {again}");
        assert_eq!(case["answers"][0]["finding"], example["finding"]);
    }
}

#[test]
fn the_text_has_tables_and_cases() {
    let table = text(&hairline(&["-n", "500", "--dimension", "3", "--scalar", "f64", "-q"]));
    for part in [
        "500 cases of each family",
        "orient3d, f64",
        "robust::orient3d",
        "range-low",
        "First findings",
    ] {
        assert!(table.contains(part), "{part}: {table}");
    }
    assert!(!table.contains("orient2d") && !table.contains("f32"), "{table}");
    let known = text(&hairline(&["--known"]));
    for part in
        ["corner-underflow-3d", "det = 1/2^1077", "det = 1*2^1026", "says NaN", "missed-zero"]
    {
        assert!(known.contains(part), "{part}: {known}");
    }
    let case = text(&hairline(&["--case", "orient3d:near@1/f32/1/17"]));
    assert!(case.contains("exact: ") && !case.contains("robust"), "{case}");
    let small = text(&hairline(&["--case", "orient3d:near@1/f64/1/17", "--epsilon", "1e-60"]));
    assert!(small.contains("orient3d (1e-60)"), "{small}");
    let points = "{\"scalar\":\"f64\",\"points\":[[0,0],[1,0],[0,1]]}";
    let given = text(&hairline(&["--case", points]));
    assert!(given.contains("the points given") && given.contains("exact: +"), "{given}");
}

#[test]
fn wrong_usage_and_output_that_fails_have_their_codes() {
    for (arguments, code) in [
        (&["--count", "0"][..], 2),
        (&["--count", "-1"], 2),
        (&["--dimension", "4"], 2),
        (&["--scalar", "f16"], 2),
        (&["--epsilon", "-1e-6"], 2),
        (&["--epsilon", "nan"], 2),
        (&["--epsilon", "1e39"], 2),
        (&["--epsilon", "1e-60"], 2),
        (&["--epsilon", "1e-60", "--case", "orient3d:near@1/f32/1/17"], 2),
        (&["--case", "{\"scalar\":\"f64\",\"points\":[[0,0],[1,1]]}"], 2),
        (&["--case", "{\"scalar\":\"f64\",\"points\":[[0,0],[1,1],[\"nan\",2]]}"], 2),
        (&["--case", "corner-underflow"], 2),
        (&["--case", "orient3d:near@2/f64/1/17"], 2),
        (&["--case", "orient3d:nearer@1/f64/1/17"], 2),
        (&["--case", "orient3d:near@1/f16/1/17"], 2),
        (&["--case", "near@1/f64/-/1/17"], 2),
        (&["--known", "--case", "corner-underflow-3d"], 2),
        (&["--format", "xml"], 2),
        (&["-n", "10", "-q", "-o", "/nowhere/at/all"], 74),
    ] {
        let output = hairline(arguments);
        let error = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(code), "{arguments:?}: {error}");
        assert!(output.stdout.is_empty() && !error.is_empty(), "{arguments:?}");
    }
}

#[test]
fn a_file_gets_what_standard_output_would() {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join("orientation-known.json");
    let arguments = ["--known", "--format", "json"];
    let name = path.to_str().unwrap();
    assert_eq!(text(&hairline(&[&arguments[..], &["-o", name]].concat())), "");
    assert_eq!(std::fs::read_to_string(&path).unwrap(), text(&hairline(&arguments)));
}
