//! `boxes check`: slab tests held to a file of their known wrong answers.

use crate::program::{ends, scratch};
use std::fs;
use std::path::Path;

const RUN: [&str; 8] = [
    "boxes",
    "check",
    "-n",
    "300",
    "-k",
    "ize,bvh,fused",
    "-f",
    "in-face,neighbour",
];

fn check(folder: &Path, more: &[&str], code: i32) -> (String, String) {
    ends(folder, &[&RUN[..], more].concat(), code)
}

#[test]
fn what_is_known_passes_more_fails_and_less_is_stale() {
    let folder = scratch("boxes-check");
    let (_, error) = check(&folder, &["-q"], 74);
    assert!(error.contains("hairline-boxes.toml: "), "{error}");
    assert!(
        error.contains("with --bless this command writes it"),
        "{error}"
    );
    let (screen, error) = check(&folder, &["--bless"], 0);
    assert!(screen.starts_with("0 worse, 0 better"), "{screen}");
    let file = folder.join("hairline-boxes.toml");
    let text = fs::read_to_string(&file).unwrap();
    let counts: Vec<&str> = text.lines().filter(|line| line.starts_with('"')).collect();
    let said = format!("wrong answers are known, of {} kinds", counts.len());
    assert!(error.contains(&said), "{error}");
    assert!(text.contains("cases = \"300 of seed 1\""), "{text}");
    assert!(
        counts
            .iter()
            .any(|line| line.starts_with("\"bvh, f32, neighbour: lost in both neighbours\" = "))
    );
    assert!(!text.contains("\"ize"), "{text}");
    check(&folder, &["-q"], 0);
    // One count less was known: worse. One more was: stale. None was: worse.
    let line = counts
        .iter()
        .find(|line| line.contains("bvh, f64, in-face: lost"))
        .unwrap();
    let (name, count) = line.split_once(" = ").unwrap();
    let count: u64 = count.parse().unwrap();
    let with = |replaced: String| fs::write(&file, text.replace(line, &replaced)).unwrap();
    for (replaced, code, words) in [
        (format!("{name} = {}", count - 1), 1, "1 worse, 0 better"),
        (format!("{name} = {}", count + 1), 3, "0 worse, 1 better"),
        (String::new(), 1, "1 worse, 0 better"),
    ] {
        with(replaced);
        let (screen, _) = check(&folder, &["-q"], code);
        assert!(screen.starts_with(words), "{screen}");
        assert!(screen.contains("bvh, f64, in-face: lost"), "{screen}");
    }
    // Blessing writes what is better, and what is worse only if it is told to.
    let held = fs::read_to_string(&file).unwrap();
    let (_, error) = check(&folder, &["-q", "--bless"], 1);
    assert!(
        error.contains("stays as it is: --accept-worse writes it"),
        "{error}"
    );
    assert_eq!(fs::read_to_string(&file).unwrap(), held);
    check(&folder, &["-q", "--bless", "--accept-worse"], 0);
    assert_eq!(fs::read_to_string(&file).unwrap(), text);
    with(format!("{name} = {}", count + 1));
    check(&folder, &["-q", "--bless"], 0);
    assert_eq!(fs::read_to_string(&file).unwrap(), text);
}

#[test]
fn files_of_other_cases_and_of_no_sense_are_refused_in_a_line() {
    let folder = scratch("boxes-check-files");
    check(&folder, &["-q", "--bless", "--known", "known.toml"], 0);
    let refused = |flags: &[&str], code: i32, message: &str| {
        let known = [
            "boxes",
            "check",
            "-q",
            "--known",
            "known.toml",
            "-f",
            "in-face",
        ];
        let (out, error) = ends(&folder, &[&known[..], flags].concat(), code);
        assert!(error.contains(message), "{error}");
        assert_eq!((out.as_str(), error.lines().count()), ("", 1), "{error}");
    };
    let other =
        "known.toml: its counts are of other cases (300 of seed 1) than this run's (200 of seed 1)";
    refused(&["-n", "200", "-k", "ize"], 65, other);
    // A part of what is known may be checked, and must not be blessed.
    let part = [
        "boxes",
        "check",
        "-q",
        "--known",
        "known.toml",
        "-n",
        "300",
        "-k",
        "bvh",
    ];
    let part = [&part[..], &["-f", "in-face"]].concat();
    ends(&folder, &part, 0);
    let (_, error) = ends(&folder, &[&part[..], &["--bless"]].concat(), 2);
    assert!(
        error.contains("outside this run, which would be lost"),
        "{error}"
    );
    let text = fs::read_to_string(folder.join("known.toml")).unwrap();
    for (old, new, message) in [
        (
            "boxes/1",
            "boxes/9",
            "schema 'hairline-boxes/9', expected 'hairline-boxes/1'",
        ),
        ("[known]", "[known]\nx = -1", "known.toml:6: "),
        ("[known]", "[unknown]", "known.toml:5: "),
        ("schema = ", "", "known.toml:2: "),
    ] {
        fs::write(folder.join("known.toml"), text.replace(old, new)).unwrap();
        refused(&["-n", "300", "-k", "ize"], 65, message);
    }
}

/// The built-in slab tests, as `.ci/run` holds them.
#[test]
fn built_in_slab_tests_are_as_the_stored_file_says() {
    let folder = scratch("boxes-check-stored");
    let known = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/boxes.toml");
    ends(&folder, &["boxes", "check", "-q", "--known", known], 0);
}
