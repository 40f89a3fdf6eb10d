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
    // Four tests with their epsilons, twenty families, two scalars.
    assert_eq!(rows.len(), 4 * 20 * 2);
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
