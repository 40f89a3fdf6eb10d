//! Stored rays that start on their triangle, such as shadow rays: judged as the family `secondary-ray` is.

use crate::json_schema;
use crate::program::{ends, scratch};
use serde_json::Value;
use std::fs;

/// The study of a gate on t, of cases that flags name.
fn gate(folder: &std::path::Path, cases: &[&str]) -> Value {
    let study = [
        "epsilon",
        "--kernel",
        "plane-unit-normal",
        "--gate",
        "t",
        "--scalar",
        "f32",
    ];
    let rest = ["--contract", "no-self-hit", "--format", "json", "-q"];
    let (out, _) = ends(folder, &[&study[..], cases, &rest[..]].concat(), 0);
    json_schema::result::<Value>(&out)["kernels"][0].clone()
}

fn generate(folder: &std::path::Path, count: &str) {
    let family = [
        "corpus",
        "generate",
        "--family",
        "secondary-ray",
        "--seed",
        "1",
    ];
    ends(
        folder,
        &[&family[..], &["-n", count, "-o", "shadow.jsonl"]].concat(),
        0,
    );
}

#[test]
fn stored_shadow_rays_give_the_advice_of_the_family() {
    let folder = scratch("secondary-advice");
    generate(&folder, "3000");
    let text = fs::read_to_string(folder.join("shadow.jsonl")).unwrap();
    assert!(
        text.lines()
            .all(|line| line.contains(r#""starts":"on-triangle""#))
    );
    ends(&folder, &["corpus", "verify", "shadow.jsonl"], 0);
    let stored = gate(&folder, &["--corpus", "shadow.jsonl"]);
    // The rays that are reported of a family are those of the next seed.
    let family = ["--family", "secondary-ray", "-n", "3000", "--seed", "0"];
    let at = ["--at", "1e-5"];
    let stored_at = gate(&folder, &[&["--corpus", "shadow.jsonl"][..], &at].concat());
    let family_at = gate(&folder, &[&family[..], &at].concat());
    let wrong = |part: &Value| part["tried"].as_array().unwrap().last().unwrap()["wrong"].clone();
    assert_eq!(wrong(&stored_at), wrong(&family_at));
    // An epsilon on t can only help here: all that is asked of it is to refuse.
    let kinds = |part: &Value| -> Vec<String> {
        let counts = part["counts"].as_array().unwrap();
        counts
            .iter()
            .map(|count| count["kind"].as_str().unwrap().to_owned())
            .collect()
    };
    assert_eq!(kinds(&stored), ["self-hit"]);
    assert_eq!(stored["tried"][0]["wrong"][0]["of"], 3000);

    // Without the mark half of them have to be hit, which is the wrong direction; a note says so.
    let plain = text.replace(r#""starts":"on-triangle","#, "");
    fs::write(folder.join("plain.jsonl"), &plain).unwrap();
    let plain = gate(&folder, &["--corpus", "plain.jsonl"]);
    assert_eq!(kinds(&plain), ["miss", "hit"]);
    assert!(
        1000 < plain["tried"][0]["wrong"][0]["of"].as_u64().unwrap(),
        "{plain}"
    );
    let audit = ["audit", "--kernel", "plane-unit-normal", "--scalar", "f32"];
    let told = |file: &str| {
        let rest = ["--corpus", file, "--contract", "no-self-hit"];
        ends(&folder, &[&audit[..], &rest[..]].concat(), 0).1
    };
    // Only f32 has cases, so nothing is said of f64; and the gate's own columns are told apart from `all`.
    let study = [
        "epsilon",
        "--kernel",
        "plane-unit-normal",
        "--corpus",
        "shadow.jsonl",
    ];
    let (out, _) = ends(&folder, &study, 0);
    assert!(
        out.contains("plane-unit-normal f32 on ") && !out.contains("f64"),
        "{out}"
    );
    // A least t is a number to choose on such rays too.
    let study = [
        "epsilon",
        "--kernel",
        "moller-trumbore",
        "--gate",
        "t_min",
        "--corpus",
    ];
    let (out, _) = ends(&folder, &[&study[..], &["shadow.jsonl"]].concat(), 0);
    assert!(out.contains("count a hit only if t >= "), "{out}");
    let note = "no case of plain.jsonl says \"starts\":\"on-triangle\"";
    assert!(told("plain.jsonl").contains(note) && !told("shadow.jsonl").contains("note:"));
}

#[test]
fn a_contract_that_allows_self_hits_is_noted_for_marked_rays() {
    let folder = scratch("secondary-note");
    generate(&folder, "20");
    let audit = [
        "audit",
        "--kernel",
        "moller-trumbore",
        "--scalar",
        "f32",
        "--corpus",
        "shadow.jsonl",
    ];
    let (_, error) = ends(&folder, &audit, 0);
    assert!(
        error.contains("note: rays of shadow.jsonl start on their triangle"),
        "{error}"
    );
    let asked = [&audit[..], &["--contract", "own,no-self-hit"]].concat();
    assert!(!ends(&folder, &asked, 0).1.contains("note:"));
}

#[test]
fn a_first_ray_that_is_marked_as_a_shadow_ray_is_warned_of() {
    let folder = scratch("secondary-far");
    generate(&folder, "20");
    let audit = [
        "audit",
        "--kernel",
        "cramer",
        "--scalar",
        "f32",
        "--corpus",
        "shadow.jsonl",
    ];
    assert!(!ends(&folder, &audit, 0).1.contains("warning"));
    let ray = r#"{"name":"first","scalar":"f32","origin":[0.25,0.25,8],"direction":[0,0,-1],"#;
    let rest = r#""a":[0,0,0],"b":[1,0,0],"c":[0,1,0],"starts":"on-triangle"}"#;
    let shadow = fs::read_to_string(folder.join("shadow.jsonl")).unwrap();
    fs::write(
        folder.join("shadow.jsonl"),
        format!("{shadow}{ray}{rest}\n"),
    )
    .unwrap();
    let (_, error) = ends(&folder, &audit, 0);
    assert!(
        error.contains("warning: 1 case of shadow.jsonl: ") && error.contains(": first first.")
    );
}

#[test]
fn a_file_may_hold_both_and_a_case_is_explained_as_it_is_judged() {
    let folder = scratch("secondary-both");
    generate(&folder, "40");
    let shadow = fs::read_to_string(folder.join("shadow.jsonl")).unwrap();
    let plain = shadow
        .replace(r#""starts":"on-triangle","#, "")
        .replace("secondary-ray@2", "ray");
    fs::write(folder.join("both.jsonl"), format!("{plain}{shadow}")).unwrap();
    let flags = [
        "--kernel",
        "plane-unit-normal",
        "--contract",
        "no-self-hit",
        "--corpus",
    ];
    let audit = ["audit", "--scalar", "f32", "--format", "json", "-q"];
    let (out, _) = ends(
        &folder,
        &[&audit[..], &flags[..], &["both.jsonl"]].concat(),
        0,
    );
    for part in ["corpus:both.jsonl", "corpus-secondary:both.jsonl"] {
        assert!(out.contains(part), "{part}");
    }
    // The parts of a run in pieces add up to the whole.
    for shard in ["0/2", "1/2"] {
        let file = format!("{}.json", &shard[..1]);
        let part = ["--shard", shard, "-o", &file, "both.jsonl"];
        let before = [&audit[..], &["--epsilon-preset", "zero"], &flags[..]].concat();
        let (corpus, rest) = (part[4], &part[..4]);
        ends(&folder, &[&before[..], &[corpus], rest].concat(), 0);
    }
    ends(&folder, &["merge", "0.json", "1.json", "-q"], 0);
    let told = [
        &["explain", "secondary-ray@2/f32/-/1/0", "--details"],
        &flags[..2],
    ]
    .concat();
    assert!(
        ends(&folder, &told, 0)
            .0
            .contains(r#""starts":"on-triangle""#)
    );
    // Where the exact ray crosses its triangle, the mark decides what is owed.
    let owed = |name: &str| {
        let all = [&["explain", name], &flags[..], &["both.jsonl"]].concat();
        ends(&folder, &all, 0).0.contains("its contract asks a hit")
    };
    let names: Vec<String> = (0..40)
        .map(|i| format!("secondary-ray@2/f32/-/1/{i}"))
        .collect();
    assert!(names.iter().all(|name| !owed(name)));
    assert!(
        names
            .iter()
            .any(|name| owed(&name.replace("secondary-ray@2", "ray")))
    );
}
