//! `hairline fuzz shrink`: a case made simpler, printed to be pasted. What is simpler is tested in tests/library.

use std::path::Path;
use std::process::{Command, Output};

fn hairline(arguments: &[&str]) -> Output {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut command = Command::new(env!("CARGO_BIN_EXE_hairline"));
    command
        .args(arguments)
        .current_dir(folder)
        .output()
        .unwrap()
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).unwrap()
}

#[test]
fn the_command_prints_the_case_in_three_languages_and_shrinks_its_own_output_no_further() {
    let kernel = ["--kernel", "moller-trumbore"];
    let first = hairline(&[&["fuzz", "shrink", "tiny@3/f32/-/1/9"][..], &kernel].concat());
    assert_eq!(first.status.code(), Some(0), "{}", text(&first.stderr));
    let printed = text(&first.stdout);
    for expected in [
        "kept     moller-trumbore (parallel=1e-6,edge=0), f32: false-miss of interior/front/within, refused by 'parallel', without rounding too",
        " bits in ",
        "no single simplification keeps the finding",
        "#[test]",
        "static const float origin[3]",
    ] {
        assert!(printed.contains(expected), "{expected}: {printed}");
    }
    let line = printed.lines().find(|line| line.starts_with('{')).unwrap();
    let explained = hairline(&[&["explain", line][..], &kernel].concat());
    assert!(text(&explained.stdout).contains("FALSE-MISS"));
    let again = hairline(&[&["fuzz", "shrink", line][..], &kernel].concat());
    assert_eq!(again.status.code(), Some(0));
    let again = text(&again.stdout);
    assert!(
        again.contains("as simple as it was") && again.contains(line),
        "{again}"
    );
    let stored = [
        "fuzz",
        "shrink",
        "front-edge_ab-within",
        "--corpus",
        "corpora/curated.jsonl",
    ];
    let two_sided = [
        "--kernel",
        "scalar-triple-two-sided",
        "--contract",
        "closed-line",
    ];
    let named = hairline(&[&stored[..], &two_sided].concat());
    assert!(
        text(&named.stdout).contains("false-miss of edge/front/within"),
        "{named:?}"
    );
}

#[test]
fn what_cannot_be_shrunk_is_refused_with_the_reason() {
    for (arguments, code, reason) in [
        (
            &[
                "fuzz",
                "shrink",
                "interior@2/f32/-/1/0",
                "--kernel",
                "cramer",
            ][..],
            4,
            "cramer (source) does as",
        ),
        (
            &["fuzz", "shrink", "interior@2/f32/-/1/0"],
            4,
            "every chosen kernel does as",
        ),
        (
            &["fuzz", "shrink", "fan@3/f32/-/1/0", "--kernel", "cramer"],
            2,
            "fan@3/f32/-/1/0.0",
        ),
        (
            &["fuzz", "shrink", "tiny@3/f32/-/1/2314"],
            2,
            "choose one by --kernel and --epsilon",
        ),
        (
            &[
                "fuzz",
                "shrink",
                "tiny@3/f32/-/1/2314",
                "--kernel",
                "crammer",
            ],
            2,
            "did you mean 'cramer'?",
        ),
        (
            &["fuzz", "shrink", "nonsense", "--kernel", "cramer"],
            2,
            "is not a case id",
        ),
        (
            &[
                "fuzz",
                "shrink",
                "tiny@3/f32/-/1/2314",
                "--kernel",
                "cramer",
                "--epsilon",
                "t=1e-60",
            ],
            2,
            "1e-60 is 0 in f32",
        ),
        (
            &[
                "fuzz",
                "shrink",
                "{\"scalar\":\"f32\"}",
                "--kernel",
                "cramer",
            ],
            65,
            "missing field 'origin'",
        ),
        (
            &["fuzz", "shrink", "tiny@9/f32/-/1/1", "--kernel", "cramer"],
            65,
            "version 9",
        ),
        (
            &[
                "fuzz", "shrink", "x", "--corpus", "no.jsonl", "--kernel", "cramer",
            ],
            74,
            "no.jsonl",
        ),
    ] {
        let output = hairline(arguments);
        let error = text(&output.stderr);
        assert_eq!(output.status.code(), Some(code), "{arguments:?}: {error}");
        assert!(
            error.contains(reason) && output.stdout.is_empty(),
            "{arguments:?}: {error}"
        );
    }
}
