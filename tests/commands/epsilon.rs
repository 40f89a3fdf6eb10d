//! `hairline epsilon` on families and stored cases: the screen, the record, pictures, what is wrong usage.

use crate::json_schema;
use crate::program::{ends, hairline, scratch};
use hairline::internals::report::epsilon::{SceneKernelPart, SceneResult};
use std::fs;
use std::path::Path;

fn record(folder: &Path, more: &[&str]) -> SceneResult {
    let all = [
        "epsilon", "--scalar", "f32", "-n", "4000", "-q", "--format", "json",
    ];
    let (text, _) = ends(folder, &[&all[..], more].concat(), 0);
    assert!(
        text.contains("\"kernel_nanoseconds\": {\n      \"f32\": {"),
        "{text}"
    );
    json_schema::result(&text)
}

/// How often something is wrong with tried epsilons, on rays of a family.
fn wrong(part: &SceneKernelPart, name: &str, family: &str, kind: &str) -> (u64, u64) {
    let is_it = |tried: &&hairline::internals::report::epsilon::TriedPart| tried.name == name;
    let tried = part
        .tried
        .iter()
        .find(is_it)
        .unwrap_or_else(|| panic!("{name}"));
    let place = part
        .counts
        .iter()
        .position(|count| (count.rays.name(), count.kind.name()) == (family, kind));
    let rate = &tried.wrong[place.unwrap_or_else(|| panic!("{family} {kind}"))];
    (rate.count, rate.of)
}

#[test]
fn a_gate_on_parallel_rays_trades_hits_for_false_hits() {
    let folder = scratch("epsilon-families");
    let families = ["--family", "interior,sliver,parallel-off,coplanar"];
    let kernel = [
        "-k",
        "moller-trumbore",
        "--gate",
        "parallel",
        "--at",
        "1.1920929e-7,0",
    ];
    let record = record(&folder, &[&kernel[..], &families].concat());
    assert_eq!((record.scene.as_str(), record.sources.len()), ("", 4));
    assert_eq!(
        record.flags,
        "--family interior,sliver,parallel-off,coplanar"
    );
    let part = &record.kernels[0];
    // Zero refuses no parallel ray; a published epsilon loses hits; the recommended one does neither.
    let zero = if part.tried.iter().any(|tried| tried.name == "zero") {
        "zero"
    } else {
        "recommended"
    };
    assert!(0 < wrong(part, zero, "parallel-off", "hit").0);
    assert_eq!(wrong(part, "1.1920929e-7", "parallel-off", "hit").0, 0);
    assert!(0 < wrong(part, "1.1920929e-7", "sliver", "miss").0);
    for (family, kind) in [("interior", "miss"), ("parallel-off", "hit")] {
        let (count, of) = wrong(part, "recommended", family, kind);
        assert!(count == 0 && 3000 < of, "{family} {kind}: {count} of {of}");
    }
    let slivers = |name: &str| wrong(part, name, "sliver", "miss").0;
    assert!(slivers("recommended") < slivers("1.1920929e-7"));
    // The limits of the gate are between what it must refuse and what it must not.
    let value = |is_lower: bool| -> Vec<f64> {
        let limits = part
            .limits
            .iter()
            .filter(|limit| limit.is_lower == is_lower);
        limits
            .filter_map(|limit| limit.value.as_ref()?.parse().ok())
            .collect()
    };
    let (lower, upper) = (value(true), value(false));
    assert!(!lower.is_empty() && !upper.is_empty());
    assert!(
        lower.iter().all(|low| upper.iter().all(|high| low <= high)),
        "{lower:?} {upper:?}"
    );
}

#[test]
fn a_gate_on_t_answers_for_rays_that_start_on_their_triangle() {
    let folder = scratch("epsilon-starts");
    let families = ["--family", "secondary-ray,origin-near"];
    let more = [&["-k", "plane-unit-normal", "--gate", "t"][..], &families].concat();
    let record = record(&folder, &more);
    let part = &record.kernels[0];
    let (count, of) = wrong(part, "zero", "secondary-ray", "self-hit");
    assert!(
        0.3 * (of as f64) < count as f64,
        "self-hits at 0: {count} of {of}"
    );
    let is_of_starts = |kind: &str| {
        let mut counts = part
            .counts
            .iter()
            .filter(|count| count.rays.name() == "secondary-ray");
        counts.any(|count| count.kind.name() == kind)
    };
    assert!(!is_of_starts("miss") && !is_of_starts("hit"));
    let near = |name: &str| wrong(part, name, "origin-near", "miss").0;
    assert!(
        near("recommended") >= near("zero"),
        "near contacts are the price"
    );
}

#[test]
fn stored_cases_are_studied_as_they_are() {
    let folder = scratch("epsilon-stored");
    ends(
        &folder,
        &[
            "corpus",
            "generate",
            "--family",
            "secondary-ray",
            "-n",
            "300",
            "-o",
            "s.jsonl",
        ],
        0,
    );
    let of = [
        "-k",
        "plane-unit-normal",
        "--gate",
        "t",
        "--corpus",
        "s.jsonl",
    ];
    let record = record(&folder, &of);
    let part = &record.kernels[0];
    assert!(
        part.counts
            .iter()
            .all(|count| count.rays.name() == "stored")
    );
    let (count, of) = wrong(part, "zero", "stored", "self-hit");
    assert!(0 < count && 100 < of, "{count} of {of}");
}

#[test]
fn strata_are_those_of_the_scene() {
    let folder = scratch("epsilon-strata");
    let grazing = [
        "-k",
        "moller-trumbore",
        "--gate",
        "parallel",
        "--family",
        "scene-grazing",
    ];
    let record = record(&folder, &grazing);
    assert!(record.scene.starts_with("extent=1,"), "{}", record.scene);
    let part = &record.kernels[0];
    assert!(
        part.counts
            .iter()
            .all(|count| count.rays.name() == "scene-grazing")
    );
}

#[test]
fn the_screen_names_the_families_and_its_commands_work() {
    let folder = scratch("epsilon-screen");
    let all = [
        "epsilon",
        "-k",
        "cramer",
        "--family",
        "grazing,shared-edge",
        "--scalar",
        "f32",
    ];
    let (screen, _) = ends(&folder, &[&all[..], &["-q", "-n", "3000"]].concat(), 0);
    assert!(
        screen.starts_with("cramer f32 on grazing, shared-edge\n"),
        "{screen}"
    );
    let command = screen
        .lines()
        .find_map(|line| line.strip_prefix("next: hairline "));
    let command = command.unwrap_or_else(|| panic!("{screen}"));
    let again: Vec<&str> = command.split(' ').chain(["-q"]).collect();
    assert!(again.contains(&"grazing,shared-edge"), "{command}");
    ends(&folder, &again, 0);
}

#[test]
fn the_result_does_not_depend_on_the_number_of_threads() {
    let folder = scratch("epsilon-threads");
    let run = |threads| {
        let families = ["--family", "grazing,edge-near,fan", "--threads", threads];
        let record = record(&folder, &[&["-k", "cramer"][..], &families].concat());
        serde_json::to_string(&record).unwrap()
    };
    assert_eq!(run("1"), run("3"));
}

#[test]
fn kernels_that_are_one_test_have_the_results_that_each_has_alone() {
    let folder = scratch("epsilon-one-test");
    // The second does not share a test with the others, and stands between them.
    let names = ["convex-polygon", "cramer", "plane-inside-out-precomputed"];
    let run = |kernels: &str| {
        let scene = ["--scene", "room", "-n", "500"];
        let all = [
            &["epsilon", "-q", "--format", "json", "-k", kernels],
            &scene[..],
        ]
        .concat();
        let (text, _) = ends(&folder, &all, 0);
        json_schema::result::<SceneResult>(&text).kernels
    };
    let table = run(&names.join(","));
    let of_table: Vec<&str> = table.iter().map(|part| part.kernel.as_str()).collect();
    assert_eq!(of_table, names.map(|name| [name; 2]).concat());
    for (name, of_table) in names.iter().zip(table.chunks(2)) {
        for (part, alone) in of_table.iter().zip(run(name)) {
            // A page of one kernel also has segments.
            let alone = SceneKernelPart {
                segments: None,
                ..alone
            };
            let [part, alone] = [part, &alone].map(|part| serde_json::to_string(part).unwrap());
            assert_eq!(part, alone);
        }
    }
}

#[test]
fn a_snippet_has_every_number_with_its_comparison() {
    let folder = scratch("epsilon-snippet");
    let all = [
        "epsilon",
        "-k",
        "moller-trumbore",
        "--scene",
        "room",
        "--scalar",
        "f32",
        "-q",
    ];
    for (language, start) in [
        ("c", "static const float "),
        ("rust", "const "),
        ("glsl", "const float "),
    ] {
        let more = ["-n", "2000", "--snippet", language];
        let (text, _) = ends(&folder, &[&all[..], &more].concat(), 0);
        let constants: Vec<&str> = text
            .lines()
            .filter(|line| line.starts_with(start))
            .collect();
        assert_eq!(constants.len(), 3, "{text}");
        assert!(
            constants[0].contains("PARALLEL_EPSILON") && constants[0].contains("refuse where"),
            "{text}"
        );
        assert!(
            constants[2].contains("count a hit only where t >= T_MIN"),
            "{text}"
        );
    }
    let (text, _) = ends(
        &folder,
        &[&all[..], &["-n", "2000", "--snippet", "c"]].concat(),
        0,
    );
    fs::write(folder.join("a.c"), format!("{text}int main(void) {{ return PARALLEL_EPSILON < 0 || T_MIN < 0 || EDGE_EPSILON > 1; }}\n")).unwrap();
    let built = std::process::Command::new("cc")
        .args(["a.c", "-o", "a"])
        .current_dir(&folder)
        .status();
    assert!(built.is_ok_and(|status| status.success()), "{text}");
}

#[test]
fn the_pictures_of_readme_and_guide_are_what_the_program_draws() {
    let drawn = |words: &[&str]| String::from_utf8(hairline(Path::new("."), words).stdout).unwrap();
    let kept = |name: &str| {
        fs::read_to_string(format!("{}/docs/{name}", env!("CARGO_MANIFEST_DIR"))).unwrap()
    };
    let curves = [
        "epsilon",
        "--kernel",
        "plane-unit-normal",
        "--scene",
        "room",
        "--scalar",
        "f32",
    ];
    let curves = drawn(&[&curves[..], &["-n", "4000", "-q", "--format", "svg"]].concat());
    assert!(curves == kept("plane-unit-normal-f32.svg"));
    let map = [
        "map",
        "--at",
        "vertex",
        "--kernel",
        "moller-trumbore,woop-watertight",
        "--size",
        "64",
        "-q",
        "--format",
        "svg",
    ];
    assert!(drawn(&map) == kept("vertex-f32.svg"));
    let edge = "epsilon --kernel moller-trumbore --gate edge --scene room --scalar f32 -n 4000 -q --format svg";
    let words: Vec<&str> = edge.split(' ').collect();
    assert!(drawn(&words) == kept("edge-epsilon-f32.svg"));
}

#[test]
fn a_crack_of_a_gate_that_is_not_studied_refutes_no_proof_of_an_edge() {
    // The parallel gate keeps its 1e-6 here, and loses a ray at a shared edge.
    let of = |more: &[&str]| {
        let all = [
            "epsilon",
            "--kernel",
            "moller-trumbore-culling",
            "--scene",
            "room",
            "--scalar",
            "f64",
            "-n",
            "4000",
            "-q",
            "--format",
            "json",
        ];
        let output = hairline(Path::new("."), &[&all[..], more].concat());
        assert_eq!(output.status.code(), Some(0), "{output:?}");
        let record: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
        record.to_string()
    };
    let alone = of(&["--gate", "edge"]);
    let both = of(&["--gate", "edge,parallel"]);
    assert!(!alone.contains("-3.84e-13") && both.contains("-3.84e-13"));
}

#[test]
fn bad_arguments_are_refused_with_a_reason() {
    let refused = |arguments: &[&str], words: &str| {
        let output = hairline(Path::new("."), &[&["epsilon"], arguments].concat());
        let error = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {error}");
        assert!(
            error.contains(words) && output.stdout.is_empty(),
            "{arguments:?}: {error}"
        );
    };
    let kernel = ["--kernel", "moller-trumbore"];
    let with = |more: &[&'static str]| [&kernel[..], more].concat();
    refused(&with(&["--gate", "paralel"]), "did you mean 'parallel'?");
    refused(&with(&["--gate", "edge,edge"]), "given twice");
    refused(&["--gate", "paralel"], "did you mean 'parallel'?");
    refused(
        &with(&["--gate", "edge", "--at", "nan"]),
        "not a finite number",
    );
    refused(
        &with(&["--gate", "parallel", "--at", "-1"]),
        "means nothing",
    );
    refused(&with(&["--at", "1"]), "name one --gate");
    refused(&with(&["--family", "interior,interior"]), "given twice");
    refused(&with(&["--format", "pdf"]), "unknown format 'pdf'");
    refused(&with(&["--snippet", "cobol"]), "possible values");
    refused(&with(&["-n", "0"]), "number of cases");
}

#[test]
fn subnormal_epsilons_warn_about_flush_to_zero() {
    let run = |flags: &[&str]| {
        let all = [
            "epsilon",
            "--kernel",
            "moller-trumbore",
            "-n",
            "100",
            "--scalar",
            "f32",
        ];
        let output = hairline(Path::new("."), &[&all[..], flags].concat());
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
