//! Slab tests of the user's own: `boxes --kernel-lib` and `boxes --kernel-cmd`.

#![cfg(unix)]

use crate::plugin::library;
use crate::program::{ends, ends_flat, scratch};
use crate::tools::has;
use serde_json::Value;
use std::fs;
use std::path::Path;

const HERE: &str = env!("CARGO_MANIFEST_DIR");

fn json(text: &str) -> Value {
    serde_json::from_str(text).unwrap()
}

/// The example in a language that the guide shows.
fn of_the_guide(language: &str) -> String {
    let guide = fs::read_to_string(format!("{HERE}/docs/guide/boxes.md")).unwrap();
    let (_, example) = guide.split_once(&format!("```{language}\n")).unwrap();
    example.split_once("```\n").unwrap().0.to_owned()
}

/// The first row of an audit.
fn row(folder: &Path, flags: &[&str]) -> Value {
    let run = ["boxes", "audit", "-q", "--format", "json"];
    let (out, _) = ends(folder, &[&run[..], flags].concat(), 0);
    json(&out)["result"]["rows"][0].clone()
}

/// A command that says hello with some lines and answers each case by a word of Python.
fn command(folder: &Path, hello: &str, verdict: &str) -> String {
    let program = format!(
        "import os, sys\nprint('hairline-kernel 1\\nname mine\\n{hello}ready', flush=True)\n\
         for line in sys.stdin:\n    word, *rest = line.split()\n    if word == 'end': print(line, end='', flush=True)\n    \
         elif word == 'case': print(rest[0], {verdict})\n"
    );
    fs::write(folder.join("own.py"), program).unwrap();
    "python3 own.py".to_owned()
}

const BOXES: &str =
    "judges boxes\\nscalars f64\\ncontract extent=interval,sides=both,boundary=closed\\n";

#[test]
fn the_guide_s_examples_are_slab_tests_in_c_and_in_python() {
    let folder = scratch("boxes-own-examples");
    let source = folder.join("mine.c");
    fs::write(&source, of_the_guide("c")).unwrap();
    if let Some(path) = library(&source, "slab_test", &[]) {
        // The growth that Ize's analysis allows: nothing is lost, and its verdicts are those of `ize` at gamma3.
        let flags = ["--kernel-lib", &path, "-n", "3000", "-f", "corner-near"];
        let own = row(&folder, &flags);
        let ize = [
            "-k",
            "ize",
            "--epsilon",
            "growth=-3*EPSILON",
            "--scalar",
            "f32",
        ];
        let built_in = row(&folder, &[&ize[..], &flags[2..]].concat());
        assert_eq!(own["test"], "mine");
        assert_eq!(own["lost"]["count"], 0);
        assert!(0 < own["false_hits"]["count"].as_u64().unwrap());
        assert_eq!(own["false_hits"], built_in["false_hits"]);
        // The command that a screen prints runs as it stands.
        let audit = ["boxes", "audit", "-q"];
        let (screen, _) = ends_flat(&folder, &[&audit[..], &flags].concat(), 0);
        assert!(
            screen.contains(format!("--kernel-lib '{path}'")),
            "{screen}"
        );
        let farthest = own["farthest"]["case"].as_str().unwrap();
        let explain = ["boxes", "explain", farthest, "--format", "json"];
        let (out, _) = ends(&folder, &[&explain[..], &flags[..2]].concat(), 0);
        let answer = &json(&out)["answers"][0];
        assert_eq!(answer["judged"], "wrong: the box is not met");
    }
    if has("python3") {
        fs::write(folder.join("mine.py"), of_the_guide("python")).unwrap();
        let flags = ["--kernel-cmd", "python3 mine.py", "-n", "500"];
        let own = row(&folder, &[&flags[..], &["-f", "in-face"]].concat());
        assert_eq!(own["lost"]["count"], 0);
        assert_eq!(own["lost"]["of"], 500);
        let own = row(&folder, &[&flags[..], &["-f", "corner-near"]].concat());
        let division = [
            "-k",
            "divided",
            "--scalar",
            "f64",
            "-n",
            "500",
            "-f",
            "corner-near",
        ];
        assert_eq!(own["lost"], row(&folder, &division)["lost"]);
        // It runs in doubles alone, and the case is in floats.
        let other = ["boxes", "explain", "@libigl-2270"];
        let (_, error) = ends(&folder, &[&other[..], &flags[..2]].concat(), 4);
        assert!(
            error.contains("none of the chosen tests runs in f32"),
            "{error}"
        );
    }
}

#[test]
fn a_slab_test_that_dies_is_a_finding_and_one_that_answers_nonsense_ends_the_run() {
    if !has("python3") {
        return;
    }
    let folder = scratch("boxes-own-faults");
    let dies = command(
        &folder,
        BOXES,
        "'hit' if float(rest[2]) < 0 else os._exit(3)",
    );
    let flags = ["--kernel-cmd", &dies, "-n", "16", "-f", "interior"];
    let own = row(&folder, &flags);
    let failed = own["failed"].as_u64().unwrap();
    assert!(0 < failed && failed < 16, "{own}");
    let audit = ["boxes", "audit", "-q", "--exit-code"];
    let (screen, _) = ends_flat(&folder, &[&audit[..], &flags].concat(), 1);
    assert!(screen.contains(format!("mine gives no verdict on {failed} cases")));
    let garbled = command(&folder, BOXES, "'perhaps'");
    let flags = ["--kernel-cmd", &garbled, "-n", "16", "-f", "interior"];
    let (_, error) = ends(&folder, &[&audit[..], &flags].concat(), 65);
    assert!(error.contains("expected 'ID miss'"), "{error}");
    // What fails too often is given up, with a case that `boxes explain` takes.
    let always = command(&folder, BOXES, "os._exit(3)");
    let flags = [
        "--kernel-cmd",
        &always,
        "--kernel-failures",
        "5",
        "-f",
        "interior",
    ];
    let (_, error) = ends(&folder, &[&audit[..], &flags].concat(), 65);
    assert!(
        error.contains("as `hairline boxes explain` takes it"),
        "{error}"
    );
    let case = &error[error.find("'{").unwrap() + 1..error.find("}'").unwrap() + 1];
    ends(&folder, &["boxes", "explain", case, "-k", "ize"], 0);
}

#[test]
fn a_hello_says_what_is_judged_and_what_is_owed() {
    if !has("python3") {
        return;
    }
    let folder = scratch("boxes-own-hello");
    let audit = |hello: &str| {
        let own = command(&folder, hello, "'miss'");
        ["boxes", "audit", "--kernel-cmd", &own].map(str::to_owned)
    };
    let refused = |arguments: &[String], message: &str| {
        let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
        let (_, error) = ends(&folder, &arguments, 65);
        assert!(error.contains(message), "{error}");
    };
    let of_triangles = BOXES.replace("judges boxes\\n", "");
    let message = "it judges triangles, and this command asks about boxes";
    refused(&audit(&of_triangles), message);
    let of_spheres = BOXES.replace("boxes", "spheres");
    let message = "judges: 'spheres' is none of triangles, boxes";
    refused(&audit(&of_spheres), message);
    audit(BOXES);
    let triangles = ["audit", "--kernel-cmd", "python3 own.py"].map(str::to_owned);
    refused(
        &triangles,
        "it judges boxes, and this command asks about triangles",
    );
    // Flat boxes and rays in a face must be hit, unless the hello says otherwise.
    let lost = |hello: &str, family: &str| {
        let own = command(&folder, hello, "'miss'");
        let own = row(&folder, &["--kernel-cmd", &own, "-n", "50", "-f", family]);
        own["lost"]["count"].as_u64().unwrap()
    };
    let open = BOXES.replace("boundary=closed", "boundary=closed,coplanar=miss");
    let found = [
        (BOXES, "flat"),
        (BOXES, "in-face"),
        (&open, "flat"),
        (&open, "in-face"),
    ];
    let found = found.map(|(hello, family)| lost(hello, family));
    assert_eq!([found[0], found[2], found[3]], [50, 50, 0]);
    assert_eq!(found[1], 50);
}

#[test]
fn epsilons_of_a_library_are_looked_for_and_those_of_a_command_are_not() {
    let folder = scratch("boxes-own-epsilon");
    let text = of_the_guide("c")
        .replace(
            ".name = ",
            ".epsilons = &(const hairline_epsilon){.name = \"growth\", .value = \"0\"}, .epsilon_count = 1, .name = ",
        )
        .replace("far * 1.0000004f", "far * (1 - epsilons[0])");
    let source = folder.join("growing.c");
    fs::write(&source, text).unwrap();
    if let Some(path) = library(&source, "growing", &[]) {
        let flags = [
            "-n",
            "2000",
            "-f",
            "corner-near",
            "--scalar",
            "f32",
            "--format",
            "json",
        ];
        let epsilon = |test: &[&str]| {
            let run = [&["boxes", "epsilon", "-q"], test, &flags].concat();
            json(&ends(&folder, &run, 0).0)["rows"][0].clone()
        };
        let own = epsilon(&["--kernel-lib", &path]);
        let multiplied = epsilon(&["-k", "multiplied"]);
        for found in ["largest", "lost_at_zero", "decided_by", "must_hit"] {
            assert_eq!(own[found], multiplied[found], "{found}");
        }
    }
    if has("python3") {
        let hello = format!("{BOXES}epsilon growth 0 0 0 signed\\n");
        let own = command(&folder, &hello, "'miss'");
        let (_, error) = ends(&folder, &["boxes", "epsilon", "--kernel-cmd", &own], 2);
        assert!(
            error.contains("too slow to be asked at many epsilons"),
            "{error}"
        );
        // It has no margin to show, and its verdict is shown all the same.
        let explain = [
            "boxes",
            "explain",
            "@bvh-107",
            "--kernel-cmd",
            &own,
            "--format",
            "json",
        ];
        let answer = json(&ends(&folder, &explain, 0).0)["answers"][0].clone();
        assert_eq!(answer["judged"], "wrong: the ray is lost");
        assert_eq!(answer["margins"], json("[]"));
        let own = command(&folder, BOXES, "'miss'");
        let (_, error) = ends(&folder, &["boxes", "epsilon", "--kernel-cmd", &own], 2);
        assert!(
            error.contains("no chosen slab test takes an epsilon"),
            "{error}"
        );
    }
}
