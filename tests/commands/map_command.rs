//! `hairline map` as a user runs it.

use crate::program;

use program::{ends, hairline, scratch};
use std::fs;

const CASE: &str = r#"{"scalar":"f32","origin":[0.625,0.75,0.875],"direction":[-0.125,-0.25,-1],"a":[-12,-12,3],"b":[24,24,-6],"c":[-12,24,1]}"#;

#[test]
fn the_picture_goes_where_it_is_sent_and_the_counts_beside_it() {
    let folder = scratch("map-outputs");
    let (out, error) = ends(
        &folder,
        &["map", "--kernel", "cramer", "-o", "a.svg", "-o", "a.png"],
        0,
    );
    assert_eq!(out, "");
    assert!(
        error.contains("cramer (source) in f32: 128 x 128 pixels, 848 wrong\n"),
        "{error}"
    );
    assert!(error.contains("     499  false hit\n") && error.contains("     349  false miss\n"));
    let svg = fs::read_to_string(folder.join("a.svg")).unwrap();
    assert!(
        svg.starts_with("<svg ") && svg.ends_with("</svg>\n") && svg.contains("false hit: 499")
    );
    assert!(
        fs::read(folder.join("a.png"))
            .unwrap()
            .starts_with(b"\x89PNG\r\n")
    );
    // Text alone is the result.
    let (out, error) = ends(&folder, &["map", "--kernel", "cramer"], 0);
    assert!(
        out.contains("848 wrong") && error.is_empty(),
        "{out}{error}"
    );
    let to_stdout = [
        "map", "--kernel", "cramer", "--format", "svg", "-o", "-", "--quiet",
    ];
    let (out, error) = ends(&folder, &to_stdout, 0);
    assert!(out == svg && error.is_empty(), "{error}");
    // A case given as JSON is the standard one.
    let (out, _) = ends(
        &folder,
        &["map", CASE, "--kernel", "cramer", "--format", "svg"],
        0,
    );
    assert!(out == svg);
}

#[test]
fn the_command_beside_a_finding_shows_it_again() {
    let folder = scratch("map-again");
    let arguments = [
        "map",
        "--at",
        "vertex",
        "--kernel",
        "baldwin-weber",
        "--size",
        "65x33",
    ];
    let (out, _) = ends(&folder, &arguments, 0);
    let line = out
        .lines()
        .find(|line| line.contains("hairline explain"))
        .unwrap();
    let (_, command) = line.split_once("hairline explain '").unwrap();
    let (case, rest) = command.split_once("' ").unwrap();
    let mut arguments = vec!["explain", case];
    arguments.extend(rest.split(' ').map(|word| word.trim_matches('\'')));
    let (out, _) = ends(&folder, &arguments, 0);
    assert!(
        out.contains("FALSE-HIT") || out.contains("FALSE-MISS"),
        "{out}"
    );
}

#[test]
fn options_choose_what_is_varied() {
    let folder = scratch("map-options");
    let text = |more: &[&str]| {
        let arguments = [&["map", CASE, "--size", "9x5"], more].concat();
        ends(&folder, &arguments, 0).0
    };
    let out = text(&[
        "--kernel",
        "woop-watertight",
        "--vary",
        "direction",
        "--axes",
        "z,x",
        "--step",
        "2^-20",
        "--contract",
        "open-ray",
    ]);
    assert!(out.contains("to the right: direction.z in steps of 2^-20 about -1 (bits bf800000)"));
    assert!(
        out.contains("upwards: direction.x in steps of 2^-20"),
        "{out}"
    );
    assert!(
        out.contains("what is right: ray, both sides, open"),
        "{out}"
    );
    let out = text(&[
        "--kernel",
        "moller-trumbore",
        "--epsilon-preset",
        "source",
        "--step",
        "7",
    ]);
    assert!(
        out.contains("origin.x in steps of 7 ulps about 0.625"),
        "{out}"
    );
    // Every case is too parallel for an epsilon of 1e6.
    let out = text(&["--kernel", "moller-trumbore", "--epsilon", "parallel=1e6"]);
    assert!(
        out.contains("--epsilon 'parallel=1e6,edge=0'") && !out.contains("  hit\n"),
        "{out}"
    );
}

#[test]
fn a_drawing_is_an_svg_with_the_exact_words() {
    let folder = scratch("map-drawing");
    let id = "tiny@3/f32/-/1/2314";
    let kernel = [
        "--kernel",
        "moller-trumbore",
        "--epsilon",
        "parallel=1e-6,edge=0",
    ];
    let (out, error) = ends(
        &folder,
        &[&["map", id, "--drawing", "-o", "w.svg"], &kernel[..]].concat(),
        0,
    );
    assert!(
        out.is_empty() && error.contains("2.148e-1 of the longest edge"),
        "{error}"
    );
    let svg = fs::read_to_string(folder.join("w.svg")).unwrap();
    assert!(svg.contains("in f32: false-miss</title>"), "{svg}");
    assert!(
        svg.contains("Computed: a miss, refused by gate parallel."),
        "{svg}"
    );
}

/// A triangle met from behind, which only some kernels promise to hit.
const BACK: &str = "{\"scalar\":\"f32\",\"origin\":[0.2,0.2,-1],\"direction\":[0,0,1],\"a\":[0,0,0],\"b\":[1,0,0],\"c\":[0,1,0]}";

#[test]
fn several_kernels_stand_side_by_side() {
    let folder = scratch("map-several");
    let words = [
        "map",
        "--at",
        "vertex",
        "--kernel",
        "moller-trumbore,woop-watertight",
        "--size",
        "16",
    ];
    let files = ["-o", "m.svg", "-o", "m.png", "-o", "m.txt"];
    ends(&folder, &[&words[..], &files].concat(), 0);
    let svg = fs::read_to_string(folder.join("m.svg")).unwrap();
    assert_eq!(svg.matches("shape-rendering=\"crispEdges\"").count(), 3);
    for name in [
        "moller-trumbore (source)",
        "woop-watertight (source)",
        "exact",
    ] {
        assert!(svg.contains(&format!(">{name}</text>")), "{name}: {svg}");
    }
    let text = fs::read_to_string(folder.join("m.txt")).unwrap();
    assert_eq!(text.matches("16 x 16 pixels").count(), 2, "{text}");
    // Three panels and two gaps of eight dots.
    let png = fs::read(folder.join("m.png")).unwrap();
    let wide = u32::from_be_bytes(png[16..20].try_into().unwrap());
    assert_eq!(wide, 3 * 16 * (1024 / 3 / 16) + 2 * 8);
}

#[test]
fn wrong_usage_and_bad_input_end_with_their_codes() {
    let folder = scratch("map-refused");
    fs::create_dir(folder.join("taken.svg")).unwrap();
    let kernel = ["--kernel", "cramer"];
    let cases: &[(&[&str], i32, &str)] = &[
        (&["map"], 2, "choose them by --kernel"),
        (&["map", "--kernel", "cramr"], 2, "did you mean 'cramer'?"),
        (
            &["map", "--kernel", "plane-inside-out", "--drawing"],
            2,
            "there are plane-inside-out (zero), plane-inside-out (1e-6)",
        ),
        (
            &[
                "map",
                "--kernel",
                "cramer,plucker,plane-inside-out,half-space",
            ],
            2,
            "a map has room for 4 kernels",
        ),
        (
            &[
                "map",
                BACK,
                "--kernel",
                "moller-trumbore,moller-trumbore-culling",
            ],
            2,
            "judge them by one contract",
        ),
        (
            &["map", "--at", "edges", "--kernel", "cramer"],
            2,
            "did you mean 'edge'?",
        ),
        (
            &[
                "map", "--at", "edge", "--scalar", "f16", "--kernel", "cramer",
            ],
            2,
            "unknown scalar",
        ),
        (
            &["map", "nonsense", "--kernel", "cramer"],
            2,
            "is not a case id",
        ),
        (
            &["map", "fan@3/f32/-/1/2", "--kernel", "cramer"],
            2,
            "say which",
        ),
        (
            &["map", "{\"scalar\":\"f32\"}", "--kernel", "cramer"],
            65,
            "missing field 'origin'",
        ),
    ];
    let with_kernel: &[(&[&str], i32, &str)] = &[
        (&["--size", "0"], 2, "sides from 1 to 2048"),
        (&["--size", "9x"], 2, "sides from 1 to 2048"),
        (&["--size", "-3"], 2, "sides from 1 to 2048"),
        (&["--size", "2049"], 2, "sides from 1 to 2048"),
        (
            &["--size", "600", "--format", "svg"],
            2,
            "too many for an SVG",
        ),
        (&["--step", "0"], 2, "--step: '0'"),
        (&["--step", "2^9999"], 2, "--step: '2^9999'"),
        (&["--axes", "x"], 2, "are not two of x, y, z"),
        (&["--axes", "x,x"], 2, "two different"),
        (
            &["--vary", "d"],
            2,
            "unknown point 'd': there are origin, direction, a, b, c",
        ),
        (&["--dots", "0", "-o", "a.png"], 2, "2^26"),
        (&["--format", "gif"], 2, "unknown format 'gif'"),
        (&["-o", "map.gif"], 2, "does not end in .svg, .png or .txt"),
        (
            &["--format", "svg,png", "-o", "one.svg"],
            2,
            "2 formats but 1 output",
        ),
        (&["--drawing", "--format", "png"], 2, "not as png"),
        (&["-o", "taken.svg"], 74, "taken.svg: is a directory"),
        (&["-o", "no/such/map.svg"], 74, "no/such/map.svg"),
    ];
    let check = |arguments: &[&str], code: i32, part: &str| {
        let output = hairline(&folder, arguments);
        let error = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(code), "{arguments:?}: {error}");
        assert!(
            error.contains(part) && output.stdout.is_empty(),
            "{arguments:?}: {error}"
        );
    };
    for (arguments, code, part) in cases {
        check(arguments, *code, part);
    }
    for (arguments, code, part) in with_kernel {
        check(&[&["map"], &kernel[..], arguments].concat(), *code, part);
    }
    // Nothing half-written stays.
    let left: Vec<_> = fs::read_dir(&folder)
        .unwrap()
        .map(|e| e.unwrap().file_name())
        .collect();
    assert_eq!(left, ["taken.svg"]);
}
