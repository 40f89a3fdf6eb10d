//! `include/hairline_exact.h`: the one file that answers every ray right, held to the oracle through the plug-in.

use crate::plugin::{library, record};
use crate::program::{ends, scratch};
use crate::tools::{has, not_tested};
use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::Command;

const HERE: &str = env!("CARGO_MANIFEST_DIR");

/// No mercy for what a stranger's compiler may say; undefined behaviour ends the process, which is a finding.
const STRICT: [&str; 5] = [
    "-Wall",
    "-Wextra",
    "-Werror",
    "-fsanitize=undefined",
    "-fsanitize-undefined-trap-on-error",
];

/// C99, and C++17 contracted.
const C: &[&str] = &["-std=c99", "-pedantic", "-O2"];
/// Triangles as those of leaves, which are tested at a time.
const LEAF: &[&str] = &["-std=c99", "-pedantic", "-O3", "-march=native", "-DLEAF"];
const CPP: &[&str] = &[
    "-xc++",
    "-std=c++17",
    "-O3",
    "-march=native",
    "-ffp-contract=fast",
];

fn exact(name: &str, edges: &str, flags: &[&str]) -> Option<String> {
    built("exact", name, edges, flags)
}

/// An example as a library: `exact`, or `prepared`, which makes triangles and rays ready first.
fn built(example: &str, name: &str, edges: &str, flags: &[&str]) -> Option<String> {
    let edges = format!("-DHAIRLINE_EDGES=HAIRLINE_{edges}");
    let source = PathBuf::from(HERE).join(format!("examples/c/{example}.c"));
    library(
        &source,
        name,
        &[&STRICT[..], &[edges.as_str()], flags].concat(),
    )
}

/// The kinds of findings of a record, but for t beyond the largest number, and values in double, which are those of a
/// plain formula.
fn wrong(record: &Value) -> Vec<String> {
    wrong_beyond(record, 2f64.powi(-31))
}

/// Likewise, with another limit for values in double, in longest edges.
fn wrong_beyond(record: &Value, limit: f64) -> Vec<String> {
    let results = record["result"]["results"].as_array().unwrap();
    let found = results.iter().flat_map(|part| {
        let findings = part["findings"].as_array().unwrap();
        findings
            .iter()
            .map(move |found| (part["scalar"].as_str().unwrap(), found))
    });
    let is_of_value = |(scalar, found): &(&str, &Value)| {
        let command = found["worst"]["command"].as_str().unwrap();
        let is_known = ["range-ends", "mixed-scale"]
            .iter()
            .any(|name| command.contains(name));
        // The point is right to 2^-32 of the longest edge all the same, unless t is beyond all numbers.
        let off = found["worst"]["severity"]["value_off"]
            .as_f64()
            .unwrap_or(0.0);
        let is_near = off < limit || command.contains("range-ends");
        found["finding"] == "wrong-value" && is_near && (*scalar == "f64" || is_known)
    };
    found
        .filter(|it| !is_of_value(it))
        .map(|(_, found)| found["worst"]["command"].to_string())
        .collect()
}

#[test]
fn it_is_right_on_every_family_in_c_and_in_cpp_contracted_or_not() {
    for (name, edges, flags) in [
        ("exact-closed", "CLOSED", C),
        ("exact-fast", "CLOSED", CPP),
        ("exact-open", "OPEN", C),
    ] {
        let Some(library) = exact(name, edges, flags) else {
            return;
        };
        let (record, _) = record(&["-n", "1000", "--kernel-lib", &library]);
        assert_eq!(wrong(&record), [""; 0], "{name}");
    }
    // It is not that nothing was asked: a plain kernel is wrong there, by the same contract.
    let plain = [
        "-n",
        "1000",
        "--kernel",
        "moller-trumbore",
        "--contract",
        "closed-interval",
    ];
    assert!(10 < wrong(&record(&plain).0).len());
}

#[test]
fn what_is_made_ready_first_is_as_right() {
    for (name, edges, flags) in [
        ("prepared-closed", "CLOSED", CPP),
        ("prepared-open", "OPEN", C),
        ("prepared-once", "ONCE", C),
        ("prepared-leaf", "CLOSED", LEAF),
    ] {
        let Some(library) = built("prepared", name, edges, flags) else {
            return;
        };
        let (record, _) = record(&["-n", "1000", "--kernel-lib", &library]);
        assert_eq!(wrong_beyond(&record, 2f64.powi(-22)), [""; 0], "{name}");
    }
}

#[test]
fn exactly_one_triangle_is_hit_at_shared_edges_and_vertices() {
    for example in ["exact", "prepared"] {
        if let Some(library) = built(example, &format!("{example}-once"), "ONCE", &["-std=c99"]) {
            hits_exactly_one(&library);
        }
    }
}

/// A library has no crack and no double where triangles meet, on families, in a scene and on meshes.
fn hits_exactly_one(library: &str) {
    let mut crossings = 0;
    for cases in [&["-n", "3000"][..], &["-n", "2000", "--scene", "unit"]] {
        let (of_families, _) = record(&[cases, &["--kernel-lib", library]].concat());
        assert_eq!(wrong_beyond(&of_families, 2f64.powi(-22)), [""; 0]);
        let results = of_families["result"]["results"].as_array().unwrap();
        for across in results
            .iter()
            .map(|part| &part["across"])
            .filter(|it| !it.is_null())
        {
            for kind in ["cracks", "doubles", "odd_folds"] {
                assert_eq!(across[kind]["count"], 0, "{kind}: {across}");
            }
            crossings += across["cracks"]["of"].as_u64().unwrap();
        }
    }
    assert!(30_000 < crossings, "{crossings}");
    let folder = scratch("exact-once");
    let mut crossings = 0;
    for mesh in ["far.obj", "icosphere.obj", "torus.obj"] {
        let path = Path::new(HERE).join("corpora/meshes").join(mesh);
        let all = [
            "mesh",
            path.to_str().unwrap(),
            "--kernel-lib",
            library,
            "--format",
            "json",
            "-q",
        ];
        let told: Value = serde_json::from_str(&ends(&folder, &all, 0).0).unwrap();
        for result in told["result"]["results"].as_array().unwrap() {
            let across = &result["across"];
            for kind in ["cracks", "elsewhere", "doubles", "odd_folds"] {
                assert_eq!(across[kind]["count"], 0, "{mesh} {kind}: {result}");
            }
            crossings += across["cracks"]["of"].as_u64().unwrap();
        }
    }
    assert!(1000 < crossings, "{crossings}");
}

/// The largest part of the stack that a function of the header takes, in bytes.
fn stack(flags: &[&str]) -> Option<u64> {
    let folder = scratch(&format!("exact-stack{}", flags.len()));
    let source = PathBuf::from(HERE).join("examples/c/exact.c");
    let include = format!("-I{HERE}/include");
    let usage = ["-O2", "-fstack-usage", "-c", "-o", "exact.o", &include];
    let mut compiler = Command::new("gcc");
    let built = compiler
        .args(usage)
        .args(flags)
        .arg(&source)
        .current_dir(&folder)
        .output();
    let Ok(built) = built else {
        not_tested("there is no 'gcc' on this machine");
        return None;
    };
    assert!(
        built.status.success(),
        "{}",
        String::from_utf8_lossy(&built.stderr)
    );
    let lines = std::fs::read_to_string(folder.join("exact.su")).unwrap();
    let sizes = lines
        .lines()
        .filter_map(|line| line.split('\t').nth(1)?.parse().ok());
    sizes.max()
}

#[test]
fn the_form_for_floats_alone_is_right_and_takes_little_stack() {
    for (name, edges) in [("exact-floats", "CLOSED"), ("exact-floats-once", "ONCE")] {
        let flags = [
            "-std=c99",
            "-pedantic",
            "-fsanitize=bounds",
            "-DHAIRLINE_ONLY_F32",
        ];
        let Some(library) = exact(name, edges, &flags) else {
            return;
        };
        let all = ["-n", "1000", "--scalar", "f32", "--kernel-lib", &library];
        let (record, _) = record(&all);
        assert_eq!(wrong(&record), [""; 0], "{name}");
        let results = record["result"]["results"].as_array().unwrap();
        let across = results
            .iter()
            .map(|part| &part["across"])
            .filter(|it| !it.is_null());
        let cracks = across.map(|across| across["cracks"]["count"].as_u64().unwrap());
        assert_eq!(cracks.sum::<u64>(), 0, "{name}");
    }
    let [Some(both), Some(floats)] = [stack(&[]), stack(&["-DHAIRLINE_ONLY_F32"])] else {
        return;
    };
    assert!(floats < 4096 && 4 * floats < both, "{floats} of {both}");
}

/// The number for t underflows in double: integers have it.
#[test]
fn a_t_below_the_range_of_its_products_is_right() {
    let Some(library) = exact("exact-tiny", "CLOSED", &["-std=c99"]) else {
        return;
    };
    let [s, quarter, most] = [2f64.powi(-400), 2f64.powi(-402), 2f64.powi(290)];
    let case = format!(
        "{{\"scalar\":\"f64\",\"origin\":[{quarter:e},{quarter:e},{:e}],\"direction\":[0,0,{most:e}],\"a\":[0,0,0],\
         \"b\":[{s:e},0,0],\"c\":[0,{s:e},0],\"t_min\":-1,\"t_max\":1.7976931348623157e308}}",
        -s
    );
    let all = [
        "explain",
        &case,
        "--kernel-lib",
        &library,
        "--format",
        "json",
        "-q",
    ];
    let told: Value = serde_json::from_str(&ends(&scratch("exact-tiny"), &all, 0).0).unwrap();
    let row = &told["triangles"][0]["rows"][0];
    assert_eq!(
        (&row["said"], &row["finding"]),
        (&Value::from("hit"), &Value::Null),
        "{row}"
    );
    let t = format!("{:e}", 2f64.powi(-690));
    assert!(
        row["values"].to_string().contains(&format!("t = {t}")),
        "{row}"
    );
}

#[test]
fn a_compiler_that_changes_results_is_refused() {
    let include = format!("-I{HERE}/include");
    let source = PathBuf::from(HERE).join("examples/c/exact.c");
    let build = |flag: &str| {
        Command::new("cc")
            .args(["-c", "-o", "/dev/null", flag, &include])
            .arg(&source)
            .output()
    };
    if !has("cc") {
        return;
    }
    let refused = build("-ffast-math").unwrap();
    let told = String::from_utf8_lossy(&refused.stderr).into_owned();
    assert!(
        !refused.status.success() && told.contains("-ffast-math changes results"),
        "{told}"
    );
    assert!(build("-O2").unwrap().status.success());
}

/// The header supposes at most eight roundings of its numbers at the edges; the prover counts those of the same formula.
#[test]
fn its_margin_is_wider_than_what_is_proved_of_its_formula() {
    let all = [
        "prove",
        "--kernel",
        "scalar-triple",
        "--scalar",
        "f64",
        "--details",
        "-q",
    ];
    let (text, _) = ends(&scratch("exact-proof"), &all, 0);
    let text = text.split_whitespace().collect::<Vec<_>>().join(" ");
    let (before, _) = text.split_once(" u times its permanent").unwrap();
    let factor: f64 = before.rsplit(' ').next().unwrap().parse().unwrap();
    assert!((6.0..8.0).contains(&factor), "{factor}");
}

/// A program that includes a header, built and run; its output.
fn output_of(name: &str, program: &str) -> Option<String> {
    if !has("gcc") {
        not_tested("there is no 'gcc' on this machine");
        return None;
    }
    let folder = scratch(name);
    std::fs::write(folder.join("program.c"), program).unwrap();
    let include = format!("-I{HERE}/include");
    let words = [
        "-std=c99",
        "-O2",
        &include,
        "-o",
        "program",
        "program.c",
        "-lm",
    ];
    let built = Command::new("gcc")
        .args(words)
        .current_dir(&folder)
        .output()
        .unwrap();
    assert!(
        built.status.success(),
        "{}",
        String::from_utf8_lossy(&built.stderr)
    );
    let ran = Command::new(folder.join("program")).output().unwrap();
    Some(String::from_utf8_lossy(&ran.stdout).into_owned())
}

#[test]
fn t_beyond_the_largest_float_is_told_as_that() {
    let program = r#"
#include "hairline_prepared.h"
#include <stdio.h>
int main(void) {
    const float o[3] = {2.5e29f, 2.5e29f, 0x1p70f}, d[3] = {0, 0, -0x1p-28f};
    const float a[3] = {0, 0, -0x1p100f}, b[3] = {1e30f, 0, -0x1p100f}, c[3] = {0, 1e30f, -0x1p100f};
    hairline_answer answer;
    hairline_triangle_f32 triangle;
    hairline_ray_f32 ray;
    hairline_prepare_triangle_f32(&triangle, a, b, c);
    hairline_prepare_ray_f32(&ray, o, d);
    if (hairline_hit_f32(&triangle, &ray, 0, HUGE_VALF, &answer)) printf("%d ", answer.t == FLT_MAX);
    if (hairline_exact_f32(o, d, a, b, c, 0, HUGE_VALF, &answer)) printf("%d", answer.t == FLT_MAX);
    return 0;
}
"#;
    if let Some(said) = output_of("exact-far", program) {
        assert_eq!(said, "1 1");
    }
}

#[test]
fn flags_and_names_that_would_change_answers_are_refused() {
    let source = PathBuf::from(HERE).join("examples/c/exact.c");
    let include = format!("-I{HERE}/include");
    let associative = [
        "-fassociative-math",
        "-fno-signed-zeros",
        "-fno-trapping-math",
    ];
    for (flags, message) in [
        (&["-ffast-math"][..], "changes results"),
        (&associative, "changes results"),
        (&["-freciprocal-math"], "changes results"),
        (&["-DHAIRLINE_EDGES=closed"], "HAIRLINE_EDGES is"),
    ] {
        let mut compiler = Command::new("gcc");
        let built = compiler
            .args(["-c", "-o", "/dev/null", &include])
            .args(flags)
            .arg(&source)
            .output();
        let Ok(built) = built else {
            not_tested("there is no 'gcc' on this machine");
            return;
        };
        let said = String::from_utf8_lossy(&built.stderr);
        assert!(
            !built.status.success() && said.contains(message),
            "{flags:?}: {said}"
        );
    }
}

#[test]
fn parts_of_fast_math_that_clang_does_not_tell_of_change_nothing() {
    let folder = scratch("exact-clang");
    let include = format!("-I{HERE}/include");
    for example in ["exact", "prepared"] {
        let source = PathBuf::from(HERE).join(format!("examples/c/{example}.c"));
        let library = folder.join(format!("lib{example}.so"));
        let built = Command::new("clang")
            .args(["-O2", "-shared", "-fPIC", "-fassociative-math"])
            .args(["-fno-signed-zeros", "-fno-trapping-math"])
            .args([&include, "-o"])
            .args([&library, &source])
            .arg("-lm")
            .output();
        let Ok(built) = built else {
            not_tested("there is no 'clang' on this machine");
            return;
        };
        let said = String::from_utf8_lossy(&built.stderr);
        assert!(built.status.success(), "{said}");
        hits_exactly_one(library.to_str().unwrap());
    }
}
