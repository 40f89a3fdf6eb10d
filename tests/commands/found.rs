//! Stored finds: each still shows exactly its signature; triage makes them.

use hairline::internals::corpus::lines::{self, StoredCase};
use hairline::internals::explore::campaign::Find;
use hairline::internals::kernel::KERNELS;
use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

fn stored(folder: &Path) -> Vec<StoredCase> {
    let mut files: Vec<PathBuf> = fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .collect();
    files.sort();
    let read = |path: &PathBuf| {
        let text = fs::read(path).unwrap();
        lines::read(&text[..], &path.display().to_string())
            .map(Result::unwrap)
            .collect::<Vec<_>>()
    };
    files.iter().flat_map(read).collect()
}

fn hairline(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_hairline"))
        .args(arguments)
        .output()
        .unwrap()
}

fn fresh(name: &str) -> PathBuf {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("found-{name}"));
    let _ = fs::remove_dir_all(&path);
    fs::create_dir_all(&path).unwrap();
    path
}

fn expect(output: &Output, code: i32, reason: &str) -> String {
    let error = str::from_utf8(&output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(code), "{error}");
    assert!(error.contains(reason), "{error}");
    String::from_utf8(output.stdout.clone()).unwrap()
}

#[test]
fn every_stored_find_shows_its_signature() {
    let found = stored(Path::new("corpora/found"));
    let mut kernels = BTreeSet::new();
    let mut unseen: Vec<String> = Vec::new();
    for case in &found {
        let name = case.name.as_deref().unwrap();
        let find = match Find::of_stored(case) {
            Ok(find) => find,
            Err(error) => {
                unseen.push(format!("{name}: {error}"));
                continue;
            }
        };
        assert_eq!(find.name(), name);
        assert_eq!(find.stored().truth, case.truth, "{name}");
        kernels.insert(find.signature.kernel);
    }
    assert_eq!(unseen, [""; 0]);
    assert_eq!(kernels.len(), KERNELS.len(), "a kernel has no find");
}

#[test]
fn a_stored_find_that_is_changed_does_not_replay() {
    let text = fs::read_to_string("corpora/found/moller-trumbore.jsonl").unwrap();
    let line = text
        .lines()
        .find(|line| line.contains("false-miss/interior"))
        .unwrap();
    let read = |line: &str| lines::read(line.as_bytes(), "x").next().unwrap().unwrap();
    assert!(Find::of_stored(&read(line)).is_ok());
    for (old, new) in [
        ("refused by", "let through by"),
        ("\"finding\":\"false-miss\"", "\"finding\":\"false-hit\""),
        (
            "\"kernel\":\"moller-trumbore\"",
            "\"kernel\":\"half-space\"",
        ),
        ("\"contract\":\"own\"", "\"contract\":\"sworn\""),
    ] {
        let changed = line.replacen(old, new, 1);
        assert_ne!(changed, line);
        assert!(Find::of_stored(&read(&changed)).is_err(), "{old}");
    }
}

#[test]
fn triage_keeps_one_small_find_of_each_kind() {
    let folder = fresh("triage");
    let [campaign, output] = ["campaign", "output"].map(|name| folder.join(name));
    let [campaign, output] = [&campaign, &output].map(|path| path.to_str().unwrap());
    expect(
        &hairline(&["fuzz", campaign, "--kernel", "half-space", "-n", "3000"]),
        0,
        "",
    );
    // The campaign, one of its lines as an artifact of a fuzz target, and plain cases.
    let finds = fs::read_to_string(folder.join("campaign/finds.jsonl")).unwrap();
    let artifacts = folder.join("artifacts/case_lines");
    fs::create_dir_all(&artifacts).unwrap();
    let broken = format!("{}\n{{\"scalar\":\n", finds.lines().next().unwrap());
    fs::write(artifacts.join("crash-1"), broken).unwrap();
    let artifacts = artifacts.to_str().unwrap();
    let paths = [campaign, artifacts, "corpora/curated.jsonl"];
    let arguments = [
        &["fuzz", "triage", "-o", output, "--kernel", "half-space"][..],
        &paths,
    ]
    .concat();
    let report = expect(&hairline(&arguments), 0, "crash-1:2: ");
    let found = stored(Path::new(output));
    let names: BTreeSet<_> = found.iter().map(|case| case.name.clone()).collect();
    assert_eq!(names.len(), found.len());
    assert!(
        finds
            .lines()
            .all(|line| { names.contains(&Some(line.split('"').nth(3).unwrap().to_owned())) })
    );
    let sources: BTreeSet<_> = found
        .iter()
        .filter_map(|case| case.found.clone()?.from)
        .collect();
    assert!(
        sources
            .iter()
            .any(|from| from.contains("campaign/finds.jsonl")),
        "{sources:?}"
    );
    // Again: nothing new. Its own output is a corpus for the other commands.
    let before = fs::read(folder.join("output/half-space.jsonl")).unwrap();
    let again = expect(&hairline(&arguments), 0, "");
    assert!(again.contains(", 0 of them new or simpler"), "{again}");
    assert_eq!(
        fs::read(folder.join("output/half-space.jsonl")).unwrap(),
        before
    );
    let shown = report
        .lines()
        .find(|line| line.contains("hairline explain"))
        .unwrap();
    let name = shown.split('\'').nth(1).unwrap();
    let explained = hairline(&[
        "explain",
        name,
        "--corpus",
        output,
        "--kernel",
        "half-space",
    ]);
    let explained = expect(&explained, 0, "").to_lowercase();
    assert!(
        explained.contains("false-") || explained.contains("bad-value"),
        "{explained}"
    );
    expect(
        &hairline(&["audit", "--corpus", output, "--kernel", "half-space"]),
        0,
        "",
    );
    let coarse = folder.join("coarse");
    let coarse = coarse.to_str().unwrap();
    let arguments = [
        "fuzz",
        "triage",
        "-o",
        coarse,
        "--one-each",
        "cause",
        output,
    ];
    expect(&hairline(&arguments), 0, "");
    assert!(stored(Path::new(coarse)).len() < found.len());
}

#[test]
fn what_cannot_be_triaged_is_said() {
    let folder = fresh("bad");
    let path = |name: &str| folder.join(name).to_str().unwrap().to_owned();
    let output = path("output");
    let triage = |input: &str| hairline(&["fuzz", "triage", "-o", &output, input]);
    expect(&triage(&path("nowhere")), 74, "nowhere");
    fs::write(folder.join("notes.txt"), "hello").unwrap();
    expect(&triage(&path("notes.txt")), 65, "notes.txt: ");
    fs::write(folder.join("broken.jsonl"), "{\"scalar\":\"f32\"}\n").unwrap();
    expect(
        &triage(&path("broken.jsonl")),
        65,
        "broken.jsonl:1: missing field 'origin'",
    );
    let good = fs::read_to_string("corpora/found/cramer.jsonl").unwrap();
    let stale = good.replacen("\"kernel\":\"cramer\"", "\"kernel\":\"kramer\"", 1);
    fs::write(folder.join("stale.jsonl"), stale).unwrap();
    expect(
        &triage(&path("stale.jsonl")),
        65,
        "stale.jsonl:1: found: unknown kernel 'kramer'",
    );
    fs::create_dir(folder.join("old")).unwrap();
    fs::write(folder.join("old/campaign.json"), "{\"format\":0}").unwrap();
    fs::write(folder.join("old/finds.jsonl"), "").unwrap();
    expect(&triage(&path("old")), 65, "is of format 0");
    fs::write(folder.join("right.jsonl"), "{\"scalar\":\"f32\",\"origin\":[1,1,1],\"direction\":[0,0,-1],\"a\":[0,0,0],\"b\":[4,0,0],\"c\":[0,4,0]}\n").unwrap();
    expect(
        &triage(&path("right.jsonl")),
        4,
        "nothing in it on which a chosen kernel is wrong",
    );
    // An input of a target that reads no case is no error.
    fs::create_dir(folder.join("settings")).unwrap();
    fs::write(folder.join("settings/crash"), "kernel = 1").unwrap();
    expect(
        &triage(&path("settings/crash")),
        4,
        "the target settings holds no case; left out",
    );
    let with = |more: &[&str]| {
        let right = path("right.jsonl");
        hairline(
            &[
                &[
                    "fuzz", "triage", "-o", &output, "--kernel", "cramer", &right,
                ],
                more,
            ]
            .concat(),
        )
    };
    expect(
        &with(&["--epsilon", "t=1e39"]),
        2,
        "1e39 is beyond the range of f32",
    );
    expect(&with(&["--band", "1e-3"]), 2, "run again without one");
    assert!(!Path::new(&output).exists());
}
