//! `hairline rays`: who loses hits, in plain programs whose tests are known, and in a stranger's.

use crate::program::{ends, flat};
use crate::rays::folder;
use std::fs;
use std::path::Path;

/// A square of so many fields, each of two faces, with heights of 0, 0.1 and 0.2.
fn hills(fields: usize) -> String {
    let side = fields + 1;
    let mut text = String::new();
    for (i, j) in (0..side).flat_map(|i| (0..side).map(move |j| (i, j))) {
        text += &format!("v {i}e-1 {j}e-1 {}e-1\n", i * j % 3);
    }
    for (i, j) in (0..fields).flat_map(|i| (0..fields).map(move |j| (i, j))) {
        let a = i * side + j + 1;
        let c = a + side;
        text += &format!("f {a} {c} {}\nf {a} {} {}\n", c + 1, c + 1, a + 1);
    }
    text
}

#[test]
fn a_plain_program_loses_what_its_tests_lose() {
    let folder = folder("rays-program");
    let made = [
        "rays",
        "t.obj",
        "-q",
        "--make",
        "2000",
        "--kinds",
        "vertex,edge",
    ];
    let judged =
        |more: &[&str], code: i32| flat(&ends(&folder, &[&made[..], more].concat(), code).0);
    let watertight = judged(&["-k", "woop-watertight"], 0);
    assert!(
        watertight.starts_with(
            "None of 2,000 answers is wrong: woop-watertight (source), every face asked "
        ),
        "{watertight}"
    );
    let strict = judged(&["-k", "plane-inside-out-strict"], 1);
    let reason = "Every face was asked about, so the triangle test loses them.";
    assert!(strict.contains(reason), "{strict}");
    // Hills of tenths, whose boxes no float is exact for.
    fs::write(folder.join("t.obj"), hills(12)).unwrap();
    let boxes = |test| {
        [
            "-k",
            "woop-watertight",
            "--scalar",
            "f32",
            "--box-test",
            test,
        ]
    };
    let lost = judged(&boxes("bvh"), 1);
    assert!(
        lost.contains("Where every face is asked, none of ")
            && lost.contains("the box test loses them"),
        "{lost}"
    );
    // A tree with boxes does not help a triangle test.
    let strict = judged(&["-k", "plane-inside-out-strict", "--box-test", "ize"], 1);
    assert!(strict.contains("the triangle test loses them"), "{strict}");
    assert!(strict.contains(" lost all the same"), "{strict}");
    judged(&boxes("ize"), 0);
    let refused = |more: &[&str], message: &str| {
        let (_, error) = ends(&folder, &[&made[..], more].concat(), 2);
        assert!(error.contains(message), "{error}");
    };
    refused(&["-k", "wop"], "unknown kernel 'wop'");
    refused(
        &["-k", "woop-watertight", "--box-test", "izee"],
        "did you mean 'ize'?",
    );
    refused(
        &[
            "-k",
            "woop-watertight",
            "--box-test",
            "ize",
            "--box-epsilon",
            "x",
        ],
        "is no GATE=VALUE",
    );
    refused(
        &["-k", "woop-watertight", "--answers", "a.csv"],
        "cannot be used with",
    );
}

#[test]
fn the_epsilon_of_a_triangle_test_that_loses_hits_is_found() {
    let folder = folder("rays-epsilon");
    let mesh = Path::new(env!("CARGO_MANIFEST_DIR")).join("corpora/meshes/torus.obj");
    let mesh = mesh.to_str().unwrap();
    let rays = ["rays", mesh, "-q", "--make", "3000", "--scalar", "f64"];
    let program = ["-k", "moller-trumbore", "--epsilon", "parallel=1e-5"];
    ends(&folder, &[&rays[..], &["-o", "r.csv"]].concat(), 0);
    ends(
        &folder,
        &[&rays[..], &program, &["-o", "own.csv"]].concat(),
        1,
    );
    // The same answers as those of a stranger.
    let own = fs::read_to_string(folder.join("own.csv")).unwrap();
    let answers: String = own
        .lines()
        .skip(1)
        .map(|line| {
            let cells: Vec<&str> = line.split(',').collect();
            format!("{},{}\n", cells[4], cells[5])
        })
        .collect();
    fs::write(folder.join("a.csv"), answers).unwrap();
    let judged = ["rays", mesh, "r.csv", "-q", "--answers", "a.csv"];
    let said = flat(&ends(&folder, &judged, 1).0);
    assert!(said.contains("The triangle test loses them"), "{said}");
    assert!(said.contains("moller-trumbore (parallel=1e-5) "), "{said}");
}
