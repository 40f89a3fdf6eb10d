//! `hairline epsilon` as a user runs it.

use crate::json_schema;
use hairline::internals::report::epsilon::{CurvePart, EpsilonRecord, GatePart};
use std::process::{Command, Output};

fn hairline(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_hairline"))
        .args(arguments)
        .env_remove("NO_COLOR")
        .output()
        .expect("the program starts")
}

fn told(output: &Output) -> String {
    assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout.clone()).expect("UTF-8")
}

fn record(arguments: &[&str]) -> EpsilonRecord {
    let mut all = vec!["epsilon", "--format", "json", "--curves", "-q", "-n", "2000"];
    all.extend(arguments);
    serde_json::from_str(&told(&hairline(&all))).expect("a record")
}

fn only(record: EpsilonRecord) -> GatePart {
    let [part] = record.result.gates.try_into().expect("one gate");
    part
}

fn number(epsilon: &str) -> f64 {
    epsilon.parse().expect("a number")
}

/// Raising an epsilon can only refuse more.
fn assert_monotone(curve: &CurvePart) {
    for pair in curve.points.windows(2) {
        let ((from, before), (to, after)) = (&pair[0], &pair[1]);
        assert!(number(from) < number(to), "{}: {from} {to}", curve.family);
        let [misses, hits, cracks, doubles, self_hits, own] =
            std::array::from_fn(|k| (before[k], after[k]));
        assert!(misses.0 <= misses.1 && cracks.0 <= cracks.1, "{}: {from} {to}", curve.family);
        let falling = [hits, doubles, self_hits, own];
        assert!(falling.iter().all(|(a, b)| a >= b), "{}: {from} {to}", curve.family);
    }
}

#[test]
fn curves_are_monotone_and_families_add_up() {
    let part =
        only(record(&["--kernel", "plane-unit-normal", "--gate", "edge", "--scalar", "f32"]));
    part.curves.iter().for_each(assert_monotone);
    let (all, families) = part.curves.split_first().expect("a curve of all");
    for k in 0..6 {
        let sum: u64 = families.iter().map(|curve| curve.asked[k]).sum();
        assert_eq!(all.asked[k], sum);
    }
    assert!(all.points.len() > 300, "{} points", all.points.len());
}

#[test]
fn the_limits_of_a_settled_gate_are_where_the_counts_change() {
    let part = only(record(&[
        "--kernel",
        "moller-trumbore",
        "--gate",
        "parallel",
        "--scalar",
        "f32",
        "--exact",
        "--family",
        "interior,sliver,parallel-off,coplanar",
    ]));
    assert!(part.exact);
    let [from, to] = part.trade.settled.clone().expect("any tiny epsilon will do");
    let at =
        |epsilon: &str| part.prices.iter().find(|price| price.epsilon == epsilon).expect("weighed");
    for epsilon in [&from, &to] {
        assert_eq!((at(epsilon).lost.count, at(epsilon).let_through.count), (0, 0), "{epsilon}");
        assert!(at(epsilon).on_front);
    }
    // Zero refuses no parallel ray; a published epsilon loses hits.
    assert!(at("0").let_through.count > 0 && !at("0").on_front);
    let bvh =
        part.prices.iter().find(|price| price.names.iter().any(|name| name == "bvh")).unwrap();
    assert!(bvh.lost.count > 0 && bvh.let_through.count == 0 && !bvh.on_front);
    // One ulp above the limit a hit is lost.
    let all = &part.curves[0];
    let (misses_at_limit, above): (Vec<_>, Vec<_>) = all
        .points
        .iter()
        .filter(|(epsilon, _)| number(epsilon) >= number(&to))
        .map(|(_, counts)| counts[0])
        .partition(|misses| *misses == part.trade.misses.unavoidable);
    assert_eq!(misses_at_limit.len(), 1, "exact: the next point is one ulp above");
    assert!(!above.is_empty());
}

#[test]
fn a_gate_on_t_answers_for_rays_that_start_on_their_triangle() {
    let part = only(record(&["--kernel", "plane-unit-normal", "--gate", "t", "--scalar", "f32"]));
    let zero = part.prices.iter().find(|price| price.epsilon == "0").unwrap();
    let secondary = zero.families.iter().find(|family| family.family == "secondary-ray").unwrap();
    assert!(secondary.let_through.rate.unwrap() > 0.3, "self-hits at 0: {secondary:?}");
    assert_eq!(secondary.lost.of, 0);
    let near = |epsilon: &str| {
        let price = part.prices.iter().find(|price| price.epsilon == epsilon).unwrap();
        price.families.iter().find(|family| family.family == "origin-near").unwrap().lost.count
    };
    assert!(near(&part.trade.hits.limit) > near("0"), "near contacts are the price");
}

#[test]
fn a_gate_is_on_t_by_its_role_whatever_its_dimension() {
    // Of dimension length / |d|, length³ / |d| and length³.
    for kernel in ["cramer", "woop-watertight", "plucker"] {
        let family = ["--family", "secondary-ray,interior", "--scalar", "f32"];
        let part = only(record(&[&["--kernel", kernel, "--gate", "t"][..], &family].concat()));
        let zero = part.prices.iter().find(|price| price.epsilon == "0").expect("weighed");
        let secondary =
            zero.families.iter().find(|family| family.family == "secondary-ray").unwrap();
        // Every ray that starts on its triangle is this gate's to keep off it.
        assert_eq!((secondary.lost.of, secondary.let_through.of), (0, 2000), "{kernel}");
        assert!(secondary.let_through.count > 0, "{kernel}");
        assert_eq!(zero.lost.of, 2000, "{kernel}: the hits of `interior`");
    }
}

#[test]
fn all_kernels_are_studied_but_those_that_cannot_be() {
    let cheap = ["--family", "interior", "--scalar", "f32", "-n", "20"];
    let run = |arguments: &[&str]| {
        let output = hairline(
            &[&["epsilon", "--format", "json", "--curves"], &cheap[..], arguments].concat(),
        );
        let error = String::from_utf8_lossy(&output.stderr).into_owned();
        let record: EpsilonRecord = serde_json::from_str(&told(&output)).expect("a record");
        let mut kernels: Vec<String> =
            record.result.gates.into_iter().map(|gate| gate.kernel).collect();
        kernels.dedup();
        (kernels, error)
    };
    let (all, notes) = run(&[]);
    let expected: Vec<&str> = hairline::internals::kernel::KERNELS
        .iter()
        .map(|entry| entry.info.name)
        .filter(|name| *name != "havel-herout")
        .collect();
    assert_eq!(all, expected);
    assert!(notes.contains("left out: havel-herout has no gate that takes an epsilon"), "{notes}");
    let (some, notes) = run(&["--kernel", "havel-herout,cramer,moller-trumbore", "--gate", "t"]);
    assert_eq!(some, ["cramer"]);
    assert!(notes.contains("left out: moller-trumbore has no gate 't'"), "{notes}");
    let (_, notes) = run(&["--kernel", "havel-herout,cramer", "-q"]);
    assert!(!notes.contains("left out"), "{notes}");
}

#[test]
fn one_is_singular() {
    let arguments = ["epsilon", "-k", "cramer", "--family", "interior", "--scalar", "f32", "-q"];
    let text = told(&hairline(&[&arguments[..], &["-n", "1"]].concat()));
    assert!(text.contains("  1 source: 1 case must hit, 0 must miss\n"), "{text}");
    let output = hairline(&["explain", "interior@1/f32/-/1/0.3"]);
    let error = String::from_utf8_lossy(&output.stderr);
    assert!(error.contains("has 1 triangle, counted from 0"), "{error}");
}

#[test]
fn the_result_does_not_depend_on_the_number_of_threads() {
    let run = |threads| {
        let part = ["--kernel", "cramer", "--gate", "t,edge", "--threads", threads];
        serde_json::to_string(&record(&part).result).unwrap()
    };
    assert_eq!(run("1"), run("3"));
}

#[test]
fn formats_hold_what_they_promise() {
    let arguments =
        ["epsilon", "-k", "moller-trumbore", "--gate", "parallel", "--scalar", "f32", "-q"];
    let with = |more: &[&str]| told(&hairline(&[&arguments[..], more].concat()));
    let settled = "both counts are at their least";
    // Of some grazing rays that hit, the determinant rounds to 0.
    for (family, limits) in [("grazing", "the two do not meet"), ("sliver", settled)] {
        let text = with(&["--family", &format!("{family},parallel-off")]);
        for words in ["seen on these cases", limits, "what an epsilon costs", "bvh, bevy, fcpw"] {
            assert!(text.contains(words), "{words}: {text}");
        }
    }
    let csv = with(&["--format", "csv"]);
    let mut lines = csv.lines();
    let columns = lines.next().unwrap().split(',').count();
    assert!(lines.all(|line| line.split(',').count() == columns));
    assert!(csv.contains("\nmoller-trumbore,f32,parallel,grazing,"));
    // The published schema, with every point of every curve or without, and a record that breaks it.
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/docs/schema/epsilon.json");
    let schema = serde_json::from_str(&std::fs::read_to_string(file).unwrap()).unwrap();
    for more in [&["-n", "100"][..], &["-n", "100", "--curves"]] {
        let json = with(&[&["--format", "json"], more].concat());
        let mut document: serde_json::Value = serde_json::from_str(&json).unwrap();
        assert_eq!(json_schema::errors(&schema, &document), [""; 0]);
        document["result"]["gates"][0]["exact"] = 1.into();
        assert_ne!(json_schema::errors(&schema, &document), [""; 0]);
    }
    let svg = with(&["--format", "svg"]);
    assert!(svg.starts_with("<svg ") && svg.ends_with("</svg>\n"));
    assert_eq!(svg.matches("<g").count(), svg.matches("</g>").count());
    assert!(svg.contains("godot, three-mesh-bvh") && svg.len() < 400_000, "{}", svg.len());
}

#[test]
fn the_guides_pictures_are_what_the_program_draws() {
    let drawn = |words: &[&str]| told(&hairline(words));
    let kept = |name: &str| {
        std::fs::read_to_string(format!("{}/docs/{name}", env!("CARGO_MANIFEST_DIR"))).unwrap()
    };
    let gates = ["epsilon", "--kernel", "plane-unit-normal", "--gate", "parallel,t,edge"];
    let gates = drawn(&[&gates[..], &["--scalar", "f32", "-q", "--format", "svg"]].concat());
    assert!(gates == kept("plane-unit-normal-f32.svg"));
    let map = ["map", "--at", "vertex", "--kernel", "moller-trumbore", "-q", "--format", "svg"];
    assert!(drawn(&map) == kept("map-moller-trumbore-f32.svg"));
}

#[test]
fn bad_arguments_are_refused_with_a_reason() {
    let refused = |arguments: &[&str], words: &str| {
        let output = hairline(&[&["epsilon"], arguments].concat());
        let error = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {error}");
        assert!(error.contains(words) && output.stdout.is_empty(), "{arguments:?}: {error}");
    };
    let kernel = ["--kernel", "moller-trumbore"];
    let with = |more: &[&'static str]| [&kernel[..], more].concat();
    refused(&with(&["--gate", "paralel"]), "did you mean 'parallel'?");
    refused(&with(&["--gate", "edge,edge"]), "given twice");
    refused(
        &["--kernel", "havel-herout", "--family", "interior"],
        "has no gate that takes an epsilon",
    );
    refused(&["--gate", "paralel"], "did you mean 'parallel'?");
    refused(&with(&["--at", "nan"]), "not a finite number");
    refused(&with(&["--gate", "parallel", "--at", "-1"]), "means nothing");
    refused(&with(&["--family", "interior,interior"]), "given twice");
    refused(&with(&["--format", "pdf"]), "unknown format 'pdf'");
    refused(&with(&["-n", "0"]), "number of cases");
}

#[test]
fn a_record_without_details_is_small_and_agrees_with_the_whole_one() {
    let run = |more: &[&str]| {
        let all =
            ["epsilon", "--format", "json", "-q", "-n", "1000", "--kernel", "moller-trumbore"];
        told(&hairline(&[&all[..], &["--gate", "parallel,edge", "--scalar", "f32"], more].concat()))
    };
    let (brief, whole) = (run(&[]), run(&["--curves"]));
    // Two gates of one kernel in one scalar; the built-in kernels have some 70.
    assert!(brief.len() < 2 * 5_000_000 / 70, "{}", brief.len());
    let [brief, whole] =
        [brief, whole].map(|text| serde_json::from_str::<EpsilonRecord>(&text).unwrap());
    for (brief, whole) in brief.result.gates.iter().zip(&whole.result.gates) {
        let [curve] = &brief.curves[..] else { panic!("{}", brief.curves.len()) };
        assert!(1 < whole.curves.len() && curve.points.len() < whole.curves[0].points.len());
        assert!(curve.points.iter().all(|point| whole.curves[0].points.contains(point)));
        assert_eq!(curve.points.last(), whole.curves[0].points.last());
        // What was run stays, where the whole curve has it.
        let has = |curve: &CurvePart, price: &str| curve.points.iter().any(|(e, _)| e == price);
        for price in &brief.prices {
            assert_eq!(has(curve, &price.epsilon), has(&whole.curves[0], &price.epsilon));
        }
        assert_eq!(format!("{:?}", brief.prices), format!("{:?}", whole.prices));
    }
}

#[test]
fn subnormal_epsilons_warn_about_flush_to_zero() {
    let run = |flags: &[&str]| {
        let all = ["epsilon", "--kernel", "moller-trumbore", "-n", "100", "--scalar", "f32"];
        let output = hairline(&[&all[..], flags].concat());
        assert!(output.status.success(), "{output:?}");
        String::from_utf8(output.stderr).unwrap()
    };
    let warning = "1e-40 is subnormal in f32: machines that flush to zero take it for 0";
    let on_families = ["--family", "interior", "--gate", "parallel"];
    assert!(run(&[&on_families[..], &["--at", "1e-40"]].concat()).contains(warning));
    assert!(!run(&[&on_families[..], &["--at", "1e-30"]].concat()).contains("subnormal"));
    assert!(run(&["--scene", "room", "--gate", "t_min", "--at", "1e-40"]).contains(warning));
    assert!(run(&["--scene", "room", "--epsilon", "parallel=1e-40"]).contains(warning));
}
