//! `boxes`: slab tests, from the command line.

use crate::program::{ends, ends_flat, scratch};
use serde_json::Value;

/// Straight at a corner of the unit cube, past the rest of it: the line x + y = 2, z = 1.
const CORNER: &str =
    r#"{"scalar":"f32","origin":[2,0,1],"direction":[-1,1,0],"min":[0,0,0],"max":[1,1,1]}"#;

/// As [`CORNER`], one float further out.
const PAST: &str = r#"{"scalar":"f32","origin":[2.0000002384185791015625,0,1],"direction":[-1,1,0],"min":[0,0,0],"max":[1,1,1]}"#;

fn json(text: &str) -> Value {
    serde_json::from_str(text).unwrap()
}

#[test]
fn a_ray_at_a_corner_is_met_and_one_float_further_out_it_is_not() {
    let folder = scratch("boxes-corner");
    let explain = ["boxes", "explain", "--format", "json"];
    let (out, _) = ends(&folder, &[&explain[..], &[CORNER]].concat(), 0);
    let met = json(&out);
    assert_eq!(met["line"], json(r#"["1","1"]"#));
    assert_eq!(met["padding"], 0.0);
    assert!(
        met["truth"]
            .as_str()
            .unwrap()
            .contains("touches a corner and nothing else")
    );
    let (out, _) = ends(&folder, &[&explain[..], &[PAST]].concat(), 0);
    let past = json(&out);
    assert_eq!(past["truth"], "the line passes outside the box");
    assert!(0.0 < past["padding"].as_f64().unwrap());
    let says = |explained: &Value, test: &str| {
        let answers = explained["answers"].as_array().unwrap();
        let answer = answers
            .iter()
            .find(|answer| answer["test"] == test)
            .unwrap();
        [answer["says"].clone(), answer["judged"].clone()]
    };
    assert_eq!(
        says(&met, "divided"),
        [Value::from("hit"), Value::from("right")]
    );
    // It misses a box whose entry and exit are one point.
    assert_eq!(
        says(&met, "barnes-2015"),
        [Value::from("miss"), Value::from("wrong: the ray is lost")]
    );
    assert_eq!(
        says(&past, "divided"),
        [Value::from("miss"), Value::from("right")]
    );
}

#[test]
fn an_audit_counts_what_each_test_loses_and_its_commands_show_it() {
    let folder = scratch("boxes-audit");
    let run = [
        "boxes",
        "audit",
        "-q",
        "-n",
        "300",
        "--kernel",
        "ize,fused,barnes-2015",
    ];
    let (screen, _) = ends_flat(&folder, &run, 0);
    assert!(
        screen.contains("Rays that have to be hit are lost by 2 of 3 slab tests"),
        "{screen}"
    );
    assert!(
        screen.contains("A lost box loses everything in it"),
        "{screen}"
    );
    let (out, _) = ends(&folder, &[&run[..], &["--format", "json"]].concat(), 0);
    let record = json(&out);
    assert_eq!(record["study"], "boxes");
    let rows = record["result"]["rows"].as_array().unwrap();
    // Four tests with their epsilons, twenty-one families, two scalars.
    assert_eq!(rows.len(), 4 * 21 * 2);
    for row in rows {
        let Some(case) = row["first_lost"].as_str() else {
            assert_eq!(row["lost"]["count"], 0);
            continue;
        };
        let test = row["test"].as_str().unwrap();
        let (out, _) = ends(
            &folder,
            &["boxes", "explain", case, "-k", test, "--format", "json"],
            0,
        );
        let judged = json(&out)["answers"][0]["judged"].clone();
        assert_eq!(judged, "wrong: the ray is lost", "{case} {test}");
    }
    // Another number of threads, the same bytes.
    let one = [&run[..], &["--format", "json", "--threads", "1"]].concat();
    let (again, _) = ends(&folder, &one, 0);
    assert_eq!(json(&again)["result"], record["result"]);
}

#[test]
fn an_exit_code_tells_a_build_that_a_test_is_wrong_and_diff_that_it_got_worse() {
    let folder = scratch("boxes-diff");
    let run = |epsilon: &'static str| {
        [
            "boxes",
            "audit",
            "-q",
            "-n",
            "2000",
            "-f",
            "corner-near",
            "-k",
            "ize",
            "--epsilon",
            epsilon,
            "--exit-code",
        ]
    };
    ends(
        &folder,
        &[&run("growth=-3*EPSILON")[..], &["-o", "old.json"]].concat(),
        0,
    );
    ends(
        &folder,
        &[&run("growth=0")[..], &["-o", "new.json"]].concat(),
        1,
    );
    let (out, _) = ends(&folder, &["diff", "old.json", "new.json", "--exit-code"], 1);
    assert!(out.contains("corner-near: lost"), "{out}");
    ends(&folder, &["diff", "old.json", "old.json", "--exit-code"], 0);
    // It hits what it passes by, and loses nothing.
    let old: Value = json(&std::fs::read_to_string(folder.join("old.json")).unwrap());
    let false_hits = &old["result"]["rows"][0]["false_hits"]["count"];
    assert!(0 < false_hits.as_u64().unwrap());
}

#[test]
fn the_growth_that_loses_nothing_is_that_of_the_formula() {
    let folder = scratch("boxes-epsilon");
    let run = [
        "boxes",
        "epsilon",
        "-q",
        "-n",
        "20000",
        "--extent",
        "100",
        "--size",
        "1",
        "-k",
        "divided,multiplied,fused",
        "--format",
        "json",
    ];
    let (out, _) = ends(&folder, &run, 0);
    let rows = json(&out)["rows"].as_array().unwrap().clone();
    assert_eq!(rows.len(), 6);
    for row in rows {
        let units = -row["in_epsilons"].as_f64().unwrap();
        // docs/design/boxes.md: two units are enough for a division, three for a reciprocal, no number for fused products.
        let is_right = match row["test"].as_str().unwrap() {
            "divided" => 0.0 < units && units <= 2.0,
            "multiplied" => 0.5 < units && units <= 3.0,
            _ => 100.0 < units,
        };
        assert!(is_right, "{row}");
        assert!(0 < row["lost_at_zero"].as_u64().unwrap());
    }
}

#[test]
fn what_is_no_box_and_no_test_is_refused_in_a_word() {
    let folder = scratch("boxes-refused");
    let refused = [
        (
            &["boxes", "explain", "corner"][..],
            "expected an id as corner@1/f32/-/1/17",
        ),
        (
            &["boxes", "explain", "corner@9/f32/-/1/1"],
            "is at version 1, not 9",
        ),
        (&["boxes", "explain", "corner@1/f16/-/1/1"], "f16"),
        (
            &["boxes", "explain", "edgy@1/f32/-/1/1"],
            "unknown family 'edgy'",
        ),
        (
            &["boxes", "explain", "{\"scalar\":\"f32\"}"],
            "missing field",
        ),
        (&["boxes", "audit", "-k", "iz"], "unknown slab test 'iz'"),
        (
            &["boxes", "audit", "-f", "corners"],
            "unknown family 'corners'",
        ),
        (
            &["boxes", "audit", "-k", "ize", "--epsilon", "growth"],
            "GATE=VALUE",
        ),
        (
            &["boxes", "audit", "-k", "ize", "--epsilon", "edge=1"],
            "has no gate 'edge'",
        ),
        (
            &["boxes", "audit", "--extent", "1", "--size", "2"],
            "no boxes of size",
        ),
        (
            &["boxes", "audit", "--extent", "nan", "--size", "2"],
            "no boxes of size",
        ),
        (&["boxes", "audit", "--scalar", "f16"], "f16"),
        (&["boxes", "audit", "-n", "0"], "0 is not in 1"),
    ];
    for (arguments, message) in refused {
        let (out, error) = ends(&folder, arguments, 2);
        assert!(error.contains(message), "{arguments:?}: {error}");
        assert_eq!(out, "", "{arguments:?}");
    }
    // Whatever the numbers are, there is an answer: no box, no direction, an infinite end.
    for numbers in [
        r#""origin":[0,0,0],"direction":[0,0,0],"min":[0,0,0],"max":[1,1,1]"#,
        r#""origin":[0,0,0],"direction":[1,0,0],"min":[1,0,0],"max":[0,1,1]"#,
        r#""origin":[1e300,0,0],"direction":[1,0,0],"min":[0,0,0],"max":[1,1,1]"#,
        r#""origin":[0,0,0],"direction":[1e-45,0,0],"min":[0,0,0],"max":[0,0,0],"t_min":5,"t_max":1"#,
    ] {
        let case = format!("{{\"scalar\":\"f32\",{numbers}}}");
        ends(&folder, &["boxes", "explain", &case], 0);
    }
}

#[test]
fn a_judgement_says_which_promise_it_is_by() {
    let folder = scratch("boxes-judged");
    let judged = |case: &str, test: &str| {
        let run = ["boxes", "explain", case, "-k", test, "--format", "json"];
        let answer = json(&ends(&folder, &run, 0).0)["answers"][0].clone();
        let [says, judged] = ["says", "judged"].map(|key| answer[key].as_str().unwrap().to_owned());
        format!("{says}: {judged}")
    };
    let cases = [
        (
            "interval-ends@1/f32/-/1/72",
            "smits",
            "miss: right: its source leaves out this end",
        ),
        (
            "interval-ends@1/f32/-/1/72",
            "williams",
            "hit: wrong: its source leaves out this end",
        ),
        (
            "behind@1/f32/-/1/3",
            "majercik",
            "hit: right: it asks about the whole line",
        ),
        (
            "empty@1/f32/-/1/3",
            "bvh",
            "hit: not judged: its promise leaves this open",
        ),
        ("interior@1/f64/-/1/3", "bvh", "hit: right"),
    ];
    for (case, test, expected) in cases {
        let found = judged(case, test);
        assert_eq!(found, expected, "{case}");
    }
    // Nothing is said where nothing is asked.
    let huge = [
        "boxes", "audit", "-q", "-n", "50", "--extent", "1e300", "--size", "1e299", "--scalar",
        "f32",
    ];
    let (screen, _) = ends_flat(&folder, &huge, 0);
    assert!(
        screen.contains("No ray has to be hit, so nothing is said of 23 slab tests"),
        "{screen}"
    );
    // A padding that rounds to 0 has a sign.
    let near = r#"{"scalar":"f64","origin":[0,3e-200,0],"direction":[1,0,0],"min":[1e200,0,-1],"max":[2e200,1e-200,1]}"#;
    let (screen, _) = ends_flat(&folder, &["boxes", "explain", near, "-k", "ize"], 0);
    assert!(
        screen.contains("box missed by 0.0e0 of the largest coordinate"),
        "{screen}"
    );
    let (_, error) = ends(&folder, &["boxes", "explain", "corner@1/f128/-/1/1"], 2);
    assert!(
        error.contains("its scalar is 'f128', expected f32 or f64"),
        "{error}"
    );
}

#[test]
fn a_ray_in_a_wall_is_lost_by_some_tests_in_one_neighbour_and_by_some_in_both() {
    let folder = scratch("boxes-neighbours");
    let run = [
        "boxes",
        "audit",
        "-q",
        "-n",
        "400",
        "-f",
        "neighbour",
        "-k",
        "bvh,embree-robust,kay-kajiya",
        "--scalar",
        "f32",
    ];
    let (out, _) = ends(&folder, &[&run[..], &["--format", "json"]].concat(), 0);
    let record = json(&out);
    let rows = record["result"]["rows"].as_array().unwrap();
    // An own count: the answers to both of each pair, as `explain` shows them.
    let mut lost = 0;
    for pair in 0..30 {
        let is_lost = |index: u64| {
            let case = format!("neighbour@1/f32/-/1/{index}");
            let explain = ["boxes", "explain", &case, "-k", "bvh", "--format", "json"];
            json(&ends(&folder, &explain, 0).0)["answers"][0]["says"] == "miss"
        };
        lost += u64::from(is_lost(2 * pair) && is_lost(2 * pair + 1));
    }
    let thirty = [&run[..3], &["-n", "60", "-f", "neighbour", "-k", "bvh"]].concat();
    let thirty = [&thirty[..], &["--scalar", "f32", "--format", "json"]].concat();
    let few = json(&ends(&folder, &thirty, 0).0)["result"]["rows"][0]["lost_in_both"].clone();
    assert_eq!([&few["count"], &few["of"]], [lost, 30]);
    let both = |row: &Value| row["lost_in_both"]["count"].as_u64().unwrap();
    let counts: Vec<u64> = rows.iter().map(both).collect();
    assert!(0 < counts[0] && counts[1..] == [0, 0], "{counts:?}");
    assert!(0 < rows[1]["lost"]["count"].as_u64().unwrap());
    let (screen, _) = ends_flat(&folder, &run, 0);
    let sentence = format!(
        "bvh loses {} of 200 rays at a wall in both neighbours",
        counts[0]
    );
    assert!(screen.contains(sentence), "{screen}");
}

#[test]
fn the_boxes_of_a_mesh_are_asked_about_in_each_format() {
    let folder = scratch("boxes-mesh");
    let obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 2\nf 1 2 3\nf 2 4 3\n";
    std::fs::write(folder.join("two.obj"), obj).unwrap();
    let stl = "solid two\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n\
               facet normal 0 0 1\nouter loop\nvertex 1 0 0\nvertex 1 1 2\nvertex 0 1 0\nendloop\nendfacet\nendsolid two\n";
    std::fs::write(folder.join("two.stl"), stl).unwrap();
    let audit = |file: &str| {
        let run = [
            "boxes",
            "audit",
            "-q",
            "-n",
            "1000",
            "-k",
            "ize,bvh,fused",
            "--mesh",
            file,
        ];
        let (out, _) = ends(&folder, &[&run[..], &["--format", "json"]].concat(), 0);
        let (screen, _) = ends_flat(&folder, &run, 0);
        assert!(screen.contains("(2 faces, "), "{screen}");
        json(&out)["result"]["rows"].clone()
    };
    let [obj, stl] = ["two.obj", "two.stl"].map(audit);
    let rows = obj.as_array().unwrap();
    for (row, other) in rows.iter().zip(stl.as_array().unwrap()) {
        assert_eq!(row["lost"], other["lost"]);
        assert_eq!(row["false_hits"], other["false_hits"]);
        let Some(case) = row["first_lost"].as_str() else {
            continue;
        };
        let test = row["test"].as_str().unwrap();
        let explain = ["boxes", "explain", case, "-k", test, "--format", "json"];
        let (out, _) = ends(&folder, &explain, 0);
        assert_eq!(json(&out)["answers"][0]["judged"], "wrong: the ray is lost");
    }
    let bvh = rows.iter().find(|row| row["test"] == "bvh").unwrap();
    assert!(bvh["first_lost"].is_string());
    // A growth for these boxes, and bad files in one line.
    let run = [
        "boxes", "epsilon", "-q", "-n", "1000", "-k", "divided", "--mesh", "two.obj",
    ];
    ends(&folder, &run, 0);
    std::fs::write(folder.join("none.obj"), "v 0 0 0\n").unwrap();
    std::fs::write(folder.join("bad.obj"), "v 0 0\n").unwrap();
    for (file, code, message) in [
        ("none.obj", 65, "none.obj"),
        ("bad.obj", 65, "bad.obj:1"),
        ("absent.obj", 74, "absent.obj"),
    ] {
        let (_, error) = ends(&folder, &["boxes", "audit", "-q", "--mesh", file], code);
        assert!(error.contains(message), "{error}");
        assert_eq!(error.lines().count(), 1, "{error}");
    }
    let both = ["boxes", "audit", "--mesh", "two.obj", "-f", "edge"];
    ends(&folder, &both, 2);
}
