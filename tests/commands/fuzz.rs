//! Campaigns: known facts from scratch, the same finds on any number of threads, nothing lost.

use hairline::internals::audit::{Attribution, EpsilonChoice};
use hairline::internals::explore::campaign::{Campaign, CampaignPlan, Find};
use hairline::internals::judge::Finding;
use hairline::internals::kernel::find;
use std::collections::BTreeSet;
use std::fs;
use std::io::{BufRead, BufReader, Write};
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

/// A directory of its own for each test.
fn fresh(name: &str) -> PathBuf {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("fuzz-{name}"));
    let _ = fs::remove_dir_all(&path);
    path
}

fn fuzz(directory: &Path, arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_hairline"));
    command
        .arg("fuzz")
        .arg(directory)
        .args(arguments)
        .output()
        .unwrap()
}

fn text(bytes: &[u8]) -> &str {
    str::from_utf8(bytes).unwrap()
}

/// The lines of the finds, without the seconds, which are the clock's.
fn finds(directory: &Path) -> Vec<String> {
    let file = fs::read_to_string(directory.join("finds.jsonl")).unwrap();
    assert!(file.is_empty() || file.ends_with('\n'));
    let without_seconds = |line: &str| match line.split_once(",\"seconds\":") {
        Some((head, tail)) => format!("{head}{}", tail.trim_start_matches(|c| c != '}')),
        None => line.to_owned(),
    };
    file.lines().map(without_seconds).collect()
}

fn names(directory: &Path) -> Vec<String> {
    let name = |line: &String| line.split('"').nth(3).unwrap().to_owned();
    finds(directory).iter().map(name).collect()
}

fn expect(output: &Output, code: i32, reason: &str) {
    let error = text(&output.stderr);
    assert_eq!(output.status.code(), Some(code), "{error}");
    assert!(error.contains(reason), "{error}");
}

#[test]
fn known_facts_come_out_from_scratch() {
    let kernels = [
        "half-space",
        "scalar-triple",
        "moller-trumbore",
        "plane-inside-out",
        "woop-watertight",
    ];
    let entries: Vec<_> = kernels.iter().map(|name| find(name).unwrap()).collect();
    let rows = EpsilonChoice::Source.rows(&entries, None).unwrap();
    let mut campaign = Campaign::new(&CampaignPlan {
        rows,
        varies: false,
        scalars: [true, true],
        seed: 7,
    });
    let mut finds: Vec<Find> = Vec::new();
    while campaign.evaluations < 60_000 {
        finds.extend(campaign.round(u64::MAX));
    }
    let shows = |kernel: &str, finding, class: &str, gate: Option<&str>, why| {
        let shown = finds.iter().any(|find| {
            let signature = &find.signature;
            (signature.kernel, signature.finding, signature.gate) == (kernel, finding, gate)
                && signature.class.name().starts_with(class)
                && signature.attribution == Some(why)
        });
        assert!(shown, "{kernel}: {} of {class}", finding.name());
    };
    shows(
        "half-space",
        Finding::FalseHit,
        "interior/front/before",
        None,
        Attribution::Convention,
    );
    shows(
        "scalar-triple",
        Finding::BadValue,
        "coplanar",
        None,
        Attribution::Convention,
    );
    let (miss, inside) = (Finding::FalseMiss, "interior/front/within");
    shows(
        "moller-trumbore",
        miss,
        inside,
        Some("parallel"),
        Attribution::Epsilon,
    );
    shows(
        "plane-inside-out",
        miss,
        inside,
        Some("parallel"),
        Attribution::Epsilon,
    );
    shows(
        "woop-watertight",
        miss,
        inside,
        Some("edge"),
        Attribution::Rounding,
    );
    let kinds: BTreeSet<_> = finds.iter().map(|find| find.signature.kind()).collect();
    assert_eq!(kinds.len(), finds.len(), "each kind once");
}

#[test]
fn the_finds_of_a_seed_do_not_depend_on_the_number_of_threads() {
    let runs = ["1", "3"].map(|threads| {
        let directory = fresh(&format!("threads-{threads}"));
        let kernels = "moller-trumbore,plucker,cramer";
        let arguments = [
            "--kernel",
            kernels,
            "-n",
            "20000",
            "--threads",
            threads,
            "--seed",
            "3",
        ];
        expect(&fuzz(&directory, &arguments), 0, "");
        finds(&directory)
    });
    assert!(runs[0].len() > 40, "{}", runs[0].len());
    assert_eq!(runs[0], runs[1]);
    let other = fresh("another-seed");
    expect(
        &fuzz(&other, &["--kernel", "cramer", "-n", "5000", "--seed", "4"]),
        0,
        "",
    );
    assert!(
        finds(&other)
            .iter()
            .all(|line| line.contains("\"seed\":4,"))
    );
}

#[test]
fn a_campaign_goes_on_where_it_stopped() {
    let directory = fresh("resume here");
    let begun = fuzz(
        &directory,
        &["--kernel", "cramer", "--scalar", "f32", "-n", "3000"],
    );
    expect(&begun, 0, "");
    let first = finds(&directory);
    assert!(
        text(&begun.stdout).contains("3000 evaluations"),
        "{begun:?}"
    );
    assert_eq!(
        fs::read_to_string(directory.join("lock")).unwrap(),
        "",
        "nobody holds the lock"
    );
    // The command that it prints takes a folder with a space in its name.
    let file = format!("--corpus '{}/finds.jsonl' ", directory.display());
    assert!(text(&begun.stdout).contains(&file), "{begun:?}");
    let resumed = fuzz(&directory, &["-n", "30000"]);
    let summary = text(&resumed.stdout);
    assert!(
        summary.contains("30000 evaluations") && summary.contains("session 2"),
        "{summary}"
    );
    let all = finds(&directory);
    assert!(all.len() > first.len() && all.starts_with(&first));
    let unique: BTreeSet<String> = names(&directory).into_iter().collect();
    assert_eq!(unique.len(), all.len(), "no signature is reported again");
    assert!(all.iter().all(|line| line.contains("found:cramer/f32/")));
    let other = fuzz(&directory, &["--kernel", "plucker", "-n", "40000"]);
    expect(&other, 2, "begun with other kernels, epsilons or contract");
    expect(
        &fuzz(&directory, &["--seed", "5"]),
        2,
        "begun with other seed",
    );
    for band in [["--band", "4ulps"], ["--contract", "own,band=4ulps"]] {
        expect(
            &fuzz(&directory, &band),
            2,
            "--band: findings are kept and run again without one",
        );
    }
    assert_eq!(finds(&directory), all);
}

#[test]
fn kills_lose_nothing_that_was_reported() {
    let directory = fresh("kill");
    let mut reported = BTreeSet::new();
    for kill in 0..4 {
        let mut child = Command::new(env!("CARGO_BIN_EXE_hairline"))
            .arg("fuzz")
            .arg(&directory)
            .arg("--print")
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        let out = BufReader::new(child.stdout.take().unwrap());
        let mut lines = out.lines();
        // Killed in the middle of a flood of finds, at another place each time.
        reported.extend(lines.by_ref().take(5 + 60 * kill).map(Result::unwrap));
        child.kill().unwrap();
        reported.extend(
            lines
                .map_while(Result::ok)
                .filter(|line| line.starts_with("found:")),
        );
        child.wait().unwrap();
        let holder = fs::read_to_string(directory.join("lock")).unwrap();
        assert!(
            holder.starts_with(&format!("process {} on ", child.id())),
            "{holder}"
        );
    }
    // A pipe may be cut within a name.
    let resumed = fuzz(&directory, &["--time", "0"]);
    expect(
        &resumed,
        0,
        "its process is gone; the campaign goes on here",
    );
    let kept = names(&directory);
    let unique: BTreeSet<String> = kept.iter().cloned().collect();
    assert_eq!(unique.len(), kept.len(), "no signature twice");
    assert!(reported.len() > 200, "{}", reported.len());
    let lost: Vec<&String> = reported
        .iter()
        .filter(|name| !kept.iter().any(|kept| kept.starts_with(*name)))
        .collect();
    assert!(lost.is_empty(), "{lost:?}");
}

#[test]
fn a_line_that_a_kill_cut_short_is_removed_and_said() {
    let directory = fresh("tail");
    expect(
        &fuzz(&directory, &["--kernel", "half-space", "-n", "3000"]),
        0,
        "",
    );
    let path = directory.join("finds.jsonl");
    let whole = fs::read(&path).unwrap();
    let half = &whole[..whole.iter().position(|byte| *byte == b'\n').unwrap() / 2];
    fs::OpenOptions::new()
        .append(true)
        .open(&path)
        .unwrap()
        .write_all(half)
        .unwrap();
    let resumed = fuzz(&directory, &["--time", "0"]);
    expect(
        &resumed,
        0,
        &format!("its {} bytes are removed", half.len()),
    );
    assert_eq!(fs::read(&path).unwrap(), whole);
}

#[test]
fn damaged_directories_are_refused_and_left_as_they_are() {
    let directory = fresh("damaged");
    expect(
        &fuzz(&directory, &["--kernel", "half-space", "-n", "3000"]),
        0,
        "",
    );
    let damage = |file: &str, old: &str, new: &str, code: i32, reason: &str| {
        let path = directory.join(file);
        let good = fs::read_to_string(&path).unwrap();
        let bad = good.replacen(old, new, 1);
        assert_ne!(good, bad, "{file} {old}");
        fs::write(&path, &bad).unwrap();
        expect(&fuzz(&directory, &["--time", "0"]), code, reason);
        assert_eq!(
            fs::read_to_string(&path).unwrap(),
            bad,
            "{file} was touched"
        );
        fs::write(&path, good).unwrap();
    };
    damage("finds.jsonl", "{\"name\"", "{name\"", 65, "finds.jsonl:1: ");
    damage(
        "finds.jsonl",
        "\"kernel\":\"half-space\"",
        "\"kernel\":\"cramer\"",
        65,
        "finds.jsonl:1: found: ",
    );
    damage(
        "finds.jsonl",
        "\"version\"",
        "\"versions\"",
        65,
        "unknown field 'versions'",
    );
    damage(
        "campaign.json",
        "\"format\":1",
        "\"format\":9",
        65,
        "is of format 9; this program reads format 1",
    );
    damage("campaign.json", "{", "", 65, "campaign.json:1: ");
    damage(
        "state.json",
        "\"rounds\"",
        "\"round\"",
        65,
        "state.json:1: unknown field `round`",
    );
    damage(
        "state.json",
        "half-space",
        "half-moon",
        65,
        "population[0]: unknown kernel 'half-moon'",
    );
    fs::remove_file(directory.join("campaign.json")).unwrap();
    expect(
        &fuzz(&directory, &[]),
        65,
        "finds.jsonl is there, but campaign.json is not",
    );
    expect(&fuzz(Path::new("/dev/null/x"), &[]), 74, "/dev/null/x");
    expect(
        &fuzz(&directory, &["--kernel", "crammer"]),
        2,
        "did you mean 'cramer'?",
    );
    expect(&fuzz(&directory, &["--time", "-1"]), 2, "");
}

#[test]
fn two_campaigns_do_not_write_into_one_directory() {
    let directory = fresh("two");
    let mut command = Command::new(env!("CARGO_BIN_EXE_hairline"));
    command
        .arg("fuzz")
        .arg(&directory)
        .args(["--kernel", "plucker", "--print"]);
    let mut first = command.stdout(Stdio::piped()).spawn().unwrap();
    let mut line = String::new();
    BufReader::new(first.stdout.as_mut().unwrap())
        .read_line(&mut line)
        .unwrap();
    let second = fuzz(&directory, &["--time", "0"]);
    first.kill().unwrap();
    first.wait().unwrap();
    expect(
        &second,
        74,
        &format!("another campaign writes here: process {} on ", first.id()),
    );
    expect(
        &fuzz(&directory, &["--time", "0"]),
        0,
        "its process is gone",
    );
}

/// A limit on the size of files stands in for a full disk: a write stops short, or fails.
#[test]
fn a_full_disk_is_said_and_leaves_whole_lines() {
    let directory = fresh("full");
    let script = format!(
        "trap '' XFSZ; ulimit -f 16; exec {} fuzz {} --kernel cramer,plucker -n 40000",
        env!("CARGO_BIN_EXE_hairline"),
        directory.display()
    );
    let output = Command::new("bash").args(["-c", &script]).output().unwrap();
    expect(&output, 74, "the finds before are kept");
    let kept = finds(&directory);
    assert!(kept.len() > 3, "{}", kept.len());
    assert!(text(&output.stdout).contains("distinct signatures"));
    expect(&fuzz(&directory, &["-n", "40000"]), 0, "");
    assert!(finds(&directory).starts_with(&kept) && finds(&directory).len() > kept.len());
}
