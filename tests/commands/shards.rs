//! Parts of a run and their merging: byte for byte the run without parts, and nothing else.

use crate::program;

use program::{ends, resealed, result_bytes, scratch, with_value};
use std::fs;
use std::path::{Path, PathBuf};

/// Groups, values beyond the range, an own hit point, a mesh and stored cases of one scalar.
const PLAN: &[&str] = &[
    "--kernel",
    "moller-trumbore,plane-unit-normal,convex-polygon",
    "--family",
    "edge-near,fan,polygon,secondary-ray,range-ends,mixed-scale,invalid",
    "--mesh",
    "m.obj",
    "--corpus",
    "c.jsonl",
    "-n",
    "200",
    "--attribute",
    "20",
    "-q",
    "--format",
    "json",
];

fn folder(name: &str) -> PathBuf {
    let folder = scratch(name);
    fs::write(
        folder.join("m.obj"),
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0.5\nf 1 2 3\nf 2 4 3\n",
    )
    .unwrap();
    let line = |x: f64| {
        format!(
            "{{\"scalar\":\"f32\",\"origin\":[{x},0,1],\"direction\":[0,0,-1],\"a\":[0,0,0],\"b\":[2,0,0],\"c\":[0,2,0]}}\n"
        )
    };
    fs::write(folder.join("c.jsonl"), line(1.0) + &line(3.0)).unwrap();
    folder
}

fn audit(folder: &Path, more: &[&str]) {
    ends(folder, &[&["audit"], PLAN, more].concat(), 0);
}

/// Writes the records of all shards; returns their names.
fn shards(folder: &Path, of: u64) -> Vec<String> {
    let shard = |k: u64| {
        let file = format!("{k}-of-{of}.json");
        audit(folder, &["--shard", &format!("{k}/{of}"), "-o", &file]);
        file
    };
    (0..of).map(shard).collect()
}

fn merge(folder: &Path, files: &[&str], more: &[&str], code: i32) -> String {
    ends(
        folder,
        &[&["merge", "--format", "json"], more, files].concat(),
        code,
    )
    .1
}

#[test]
fn the_merged_result_is_byte_for_byte_that_of_one_run() {
    let folder = folder("shards-merge");
    audit(&folder, &["-o", "whole.json"]);
    let whole = result_bytes(&folder.join("whole.json"));
    assert!(whole.contains("\"causes\": {") && whole.contains("\"crack_digest\""));
    for of in [2, 3, 7] {
        let files = shards(&folder, of);
        assert_ne!(result_bytes(&folder.join(&files[0])), whole);
        // In any order.
        let mut files: Vec<&str> = files.iter().map(String::as_str).collect();
        files.rotate_left(1);
        merge(&folder, &files, &["-o", "merged.json"], 0);
        assert_eq!(
            result_bytes(&folder.join("merged.json")),
            whole,
            "{of} shards"
        );
        let merged = fs::read_to_string(folder.join("merged.json")).unwrap();
        let merged: serde_json::Value = serde_json::from_str(&merged).unwrap();
        let parts = merged["provenance"]["parts"].as_array().unwrap();
        assert_eq!(parts.len() as u64, of);
        assert!(merged.get("shard").is_none());
    }
}

#[test]
fn gaps_are_refused_or_said_and_can_be_filled_later() {
    let folder = folder("shards-gaps");
    let files = shards(&folder, 3);
    let files: Vec<&str> = files.iter().map(String::as_str).collect();
    let error = merge(&folder, &[files[0], files[2]], &[], 65);
    assert_eq!(
        error,
        "hairline: merge: shards 1 of 3 are missing (--allow-partial goes without)\n"
    );
    merge(
        &folder,
        &[files[0], files[2]],
        &["--allow-partial", "-o", "partial.json"],
        0,
    );
    let partial = result_bytes(&folder.join("partial.json"));
    let value: serde_json::Value = serde_json::from_str(&partial).unwrap();
    assert_eq!(
        value["partial"],
        serde_json::json!({ "of": 3, "present": [0, 2] })
    );
    let both = [
        "merge",
        files[0],
        files[2],
        "--allow-partial",
        "--format",
        "text,markdown",
    ];
    ends(
        &folder,
        &[&both[..], &["-o", "p.txt", "-o", "p.md"]].concat(),
        0,
    );
    for file in ["p.txt", "p.md"] {
        let text = fs::read_to_string(folder.join(file)).unwrap();
        assert!(text.contains("shards 0, 2 of 3 only"), "{text}");
    }
    merge(
        &folder,
        &["partial.json", files[1]],
        &["-o", "merged.json"],
        0,
    );
    audit(&folder, &["-o", "whole.json"]);
    assert_eq!(
        result_bytes(&folder.join("merged.json")),
        result_bytes(&folder.join("whole.json"))
    );
    let (whole, _) = ends(
        &folder,
        &[&["merge", "partial.json"], &[files[1]][..]].concat(),
        0,
    );
    assert!(!whole.contains("a part of a run"), "{whole}");
}

#[test]
fn what_is_no_part_of_the_same_run_is_refused_by_name() {
    let folder = folder("shards-refused");
    let files = shards(&folder, 2);
    let files: Vec<&str> = files.iter().map(String::as_str).collect();
    audit(&folder, &["-o", "whole.json"]);
    audit(
        &folder,
        &["--shard", "1/2", "--seed", "9", "-o", "seed.json"],
    );
    audit(&folder, &["--shard", "1/3", "-o", "third.json"]);
    audit(
        &folder,
        &["--shard", "1/2", "--examples", "1", "-o", "examples.json"],
    );
    let text = fs::read_to_string(folder.join(files[1])).unwrap();
    let count = text.find("must_hit").unwrap() + 13;
    let spoiled = text.replacen(&text[count - 13..count + 1], "must_hit\\\":77", 1);
    assert_ne!(spoiled, text);
    fs::write(folder.join("damaged.json"), spoiled).unwrap();
    fs::write(folder.join("truncated.json"), &text[..text.len() / 3]).unwrap();
    for (second, expected) in [
        ("whole.json", "whole.json: not a part of a run"),
        ("seed.json", "seed.json: of another plan: "),
        ("examples.json", "examples.json: of another plan: "),
        ("third.json", "third.json: cut in 3, expected 2"),
        (files[0], "0-of-2.json: shard 0/2 is given twice"),
        ("damaged.json", "damaged.json: damaged: "),
        ("truncated.json", "truncated.json:"),
    ] {
        let error = merge(&folder, &[files[0], second], &["-o", "no.json"], 65);
        assert!(
            error.starts_with(&format!("hairline: {expected}")),
            "{expected}: {error}"
        );
        assert!(!folder.join("no.json").exists());
    }
    // The mesh is another by now.
    fs::write(folder.join("m.obj"), "v 0 0 0\nv 1 0 0\nv 0 2 0\nf 1 2 3\n").unwrap();
    let error = merge(&folder, &files, &["-q"], 65);
    assert!(error.contains("a mesh or a corpus has changed"), "{error}");
    merge(&folder, &["missing.json"], &[], 74);
    for bad in ["2/2", "x", "1/0"] {
        let error = ends(&folder, &["audit", "--shard", bad], 2).1;
        assert!(error.contains("write k/n with k from 0 below n"), "{error}");
    }
}

#[test]
fn parts_of_one_kind_of_machine_become_a_record_of_it() {
    let folder = folder("shards-targets");
    let files = shards(&folder, 2);
    let moved = |file: &str, target: &str| {
        let text = fs::read_to_string(folder.join(file)).unwrap();
        let mut record: serde_json::Value = serde_json::from_str(&text).unwrap();
        record["provenance"]["target"] = target.into();
        let name = format!("on-{target}-{file}");
        fs::write(folder.join(&name), record.to_string()).unwrap();
        name
    };
    let there = [
        moved(&files[0], "pdp11-unix"),
        moved(&files[1], "pdp11-unix"),
    ];
    let error = merge(&folder, &[&files[0], &there[1]], &[], 65);
    assert!(
        error.contains("made on pdp11-unix, the first on "),
        "{error}"
    );
    merge(&folder, &[&there[0], &there[1]], &["-o", "there.json"], 0);
    let text = fs::read_to_string(folder.join("there.json")).unwrap();
    let record: serde_json::Value = serde_json::from_str(&text).unwrap();
    assert_eq!(record["provenance"]["target"], "pdp11-unix");
    let bad = moved(&files[0], "a]\nb");
    let error = ends(&folder, &["check", "-q", "--record", &bad], 65).1;
    assert!(
        error.contains("provenance.target: \"a]\\nb\" is none"),
        "{error}"
    );
}

#[test]
fn parts_of_another_version_are_refused() {
    let folder = folder("shards-versions");
    let files = shards(&folder, 2);
    let older = |file: &str| {
        let text = fs::read_to_string(folder.join(file)).unwrap();
        let mut record: serde_json::Value = serde_json::from_str(&text).unwrap();
        record["provenance"]["tool"] = "hairline 0.0.9".into();
        fs::write(folder.join("older.json"), record.to_string()).unwrap();
    };
    let this = format!("hairline {}", env!("CARGO_PKG_VERSION"));
    let expected = format!(
        "hairline: older.json: made by hairline 0.0.9, and this is {this}: merge parts with the version that made them\n"
    );
    older(&files[1]);
    assert_eq!(
        merge(&folder, &[&files[0], "older.json"], &[], 65),
        expected
    );
    // The first one too, and all of them.
    older(&files[0]);
    assert_eq!(
        merge(&folder, &["older.json", &files[1]], &[], 65),
        expected
    );
    assert_eq!(
        merge(&folder, &["older.json"], &["--allow-partial"], 65),
        expected
    );
}

#[test]
fn lost_parts_run_again_alone_on_slurm() {
    let folder = scratch("shards-slurm");
    let script = concat!(env!("CARGO_MANIFEST_DIR"), "/deploy/slurm.sh");
    // In place of the program: says what it was asked, and writes a record.
    let bin = folder.join("bin");
    fs::create_dir_all(&bin).unwrap();
    let fake = "#!/bin/sh\nwhile [ $# -gt 1 ]; do\n[ \"$1\" = --shard ] && echo \"$2\"\n[ \"$1\" = -o ] && : > \"$2\"\nshift\ndone\n";
    fs::write(bin.join("hairline"), fake).unwrap();
    let task = |task: &str, count: &str, [min, max]: [&str; 2]| {
        let path = format!("{}:{}", bin.display(), std::env::var("PATH").unwrap());
        let output = std::process::Command::new("bash")
            .args([script, folder.join("out").to_str().unwrap()])
            .env("PATH", path)
            .envs([
                ("SLURM_ARRAY_TASK_ID", task),
                ("SLURM_ARRAY_TASK_COUNT", count),
            ])
            .envs([("SLURM_ARRAY_TASK_MIN", min), ("SLURM_ARRAY_TASK_MAX", max)])
            .output()
            .unwrap();
        (
            output.status.code(),
            String::from_utf8_lossy(&output.stdout).trim().to_owned(),
        )
    };
    std::process::Command::new("chmod")
        .arg("+x")
        .arg(bin.join("hairline"))
        .status()
        .unwrap();
    assert_eq!(task("17", "1", ["17", "17"]).0, Some(2));
    assert_eq!(task("0", "64", ["0", "63"]), (Some(0), "0/64".to_owned()));
    assert_eq!(task("17", "1", ["17", "17"]), (Some(0), "17/64".to_owned()));
    // The first alone is a part of the run, a whole array of others is not.
    assert_eq!(task("0", "1", ["0", "0"]), (Some(0), "0/64".to_owned()));
    assert_eq!(task("3", "4", ["0", "3"]).0, Some(2));
    assert_eq!(task("5", "2", ["5", "9"]), (Some(0), "5/64".to_owned()));
    assert_eq!(task("64", "1", ["64", "64"]).0, Some(2));
}

#[test]
fn a_check_in_parts_is_judged_when_they_are_merged() {
    let folder = scratch("shards-check");
    let settings = "kernel = \"plucker\"\nfamily = [\"tiny\", \"edge-near\"]\ncount = 400\n";
    fs::write(folder.join("hairline.toml"), settings).unwrap();
    ends(&folder, &["check", "-q", "--bless"], 0);
    for shard in ["0/2", "1/2"] {
        let file = format!("{}.json", &shard[..1]);
        ends(
            &folder,
            &[
                "check", "-q", "--shard", shard, "--format", "json", "-o", &file,
            ],
            0,
        );
    }
    let error = ends(&folder, &["check", "-q", "--record", "0.json"], 65).1;
    assert!(error.contains("0.json: holds 1 of 2 shards"), "{error}");
    merge(&folder, &["0.json", "1.json"], &["-o", "merged.json"], 0);
    let (out, _) = ends(&folder, &["check", "-q", "--record", "merged.json"], 0);
    assert!(out.contains("compared case by case"), "{out}");
    ends(&folder, &["check", "-q", "--bless", "--shard", "0/2"], 2);
}

#[test]
fn a_run_is_cut_in_as_many_parts_as_may_be_and_at_least_in_one() {
    let folder = scratch("shards-count");
    let words = [
        "--kernel", "cramer", "--family", "tiny", "-n", "10", "-q", "--format", "json",
    ];
    ends(
        &folder,
        &[&["audit", "--shard", "0/2", "-o", "part.json"], &words[..]].concat(),
        0,
    );
    let text = fs::read_to_string(folder.join("part.json")).unwrap();
    let cut_in = |of: u64| {
        let cut = with_value(&text, &["partial", "of"], &of.to_string());
        fs::write(folder.join("other.json"), resealed(&cut)).unwrap();
        merge(&folder, &["other.json"], &["-q"], 65)
    };
    assert_eq!(
        cut_in(2),
        "hairline: merge: shards 1 of 2 are missing (--allow-partial goes without)\n"
    );
    for of in [0, 100_001, u64::MAX] {
        let expected = format!("hairline: other.json: cut in {of} parts, expected 1 to 100000\n");
        assert_eq!(cut_in(of), expected);
    }
    assert!(cut_in(100_000).contains("99999 of 100000 are missing"));
    // The first part is missed as well as the last.
    ends(
        &folder,
        &[&["audit", "--shard", "1/2", "-o", "last.json"], &words[..]].concat(),
        0,
    );
    let error = merge(&folder, &["last.json"], &["-q"], 65);
    assert!(error.contains(": shards 0 of 2 are missing "), "{error}");
    // One part of one is all of it.
    ends(
        &folder,
        &[&["audit", "--shard", "0/1", "-o", "part.json"], &words[..]].concat(),
        0,
    );
    merge(&folder, &["part.json"], &["-q"], 0);
}

#[test]
fn parts_of_different_builds_of_a_kernel_are_not_one_run() {
    let folder = scratch("shards-builds");
    // It misses whatever comes.
    let never = |comment: &str| {
        let script = format!(
            "# {comment}
echo 'hairline-kernel 1'; echo name never; echo scalars f32 f64; echo contract closed-ray; echo ready
while read -r word id rest; do case $word in case) echo $id miss;; end) echo end $id;; esac; done
"
        );
        fs::write(folder.join("never.sh"), script).unwrap();
    };
    let shard = |part: &str, file: &str| {
        let flags = [
            "--kernel-cmd",
            "sh never.sh",
            "--family",
            "interior",
            "-n",
            "60",
            "-q",
        ];
        let to = ["--shard", part, "--format", "json", "-o", file];
        ends(&folder, &[&["audit"], &flags[..], &to].concat(), 0);
    };
    never("one");
    shard("0/2", "0.json");
    shard("1/2", "1.json");
    let with = ["--kernel-cmd", "sh never.sh", "-q", "-o", "all.json"];
    merge(&folder, &["0.json", "1.json"], &with, 0);
    let all = fs::read_to_string(folder.join("all.json")).unwrap();
    assert!(all.contains("\"kernel_files\""), "{all}");
    never("two");
    let error = merge(&folder, &["0.json", "1.json"], &with, 65);
    assert!(
        error.contains("merge: the parts ran never.sh (")
            && error.contains("is another build here ("),
        "{error}"
    );
    shard("1/2", "1.json");
    let error = merge(&folder, &["0.json", "1.json"], &with, 65);
    assert!(
        error.contains("1.json: of another build of never.sh ("),
        "{error}"
    );
}
