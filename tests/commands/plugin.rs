//! Kernels in processes of their own: libraries that misbehave, and commands that speak the protocol
//! well or badly.

#![cfg(unix)]

use crate::program::flat;
use crate::tools::has;
use hairline::internals::case::Parameters;
use hairline::internals::family;
use serde_json::Value;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::time::{Duration, Instant};

const HERE: &str = env!("CARGO_MANIFEST_DIR");

fn hairline(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_hairline"))
        .args(arguments)
        .output()
        .unwrap()
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

/// A library built by `cc`, or by `c++` if the flags say that it is C++; none if there is no such compiler.
pub fn library(source: &Path, name: &str, flags: &[&str]) -> Option<String> {
    let compiler = if flags.contains(&"-xc++") {
        "c++"
    } else {
        "cc"
    };
    if !has(compiler) {
        return None;
    }
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("libraries");
    fs::create_dir_all(&folder).unwrap();
    let path = folder.join(format!("lib{name}.so"));
    // Beside its place first: another test may be building, or loading, the same.
    let own = folder.join(format!("{name}-{:?}.tmp", std::thread::current().id()));
    let include = format!("-I{HERE}/include");
    let built = Command::new(compiler)
        .args(["-O1", "-ffp-contract=off", "-shared", "-fPIC", &include])
        .args(flags)
        .arg("-o")
        .args([&own, source])
        .arg("-lm")
        .output()
        .unwrap();
    assert!(built.status.success(), "{}", text(&built.stderr));
    fs::rename(&own, &path).unwrap();
    Some(path.to_str().unwrap().to_owned())
}

fn misbehaving(fault: &str) -> Option<String> {
    let source = PathBuf::from(HERE).join("tests/kernels/misbehave.c");
    let fault_flag = format!("-DFAULT={fault}");
    let flags = [&fault_flag, "-xc++", "-std=c++20"];
    let flags = if fault == "THROW" {
        &flags[..]
    } else {
        &flags[..1]
    };
    library(&source, &fault.to_lowercase(), flags)
}

/// An audit's record, and what it wrote to standard error.
pub fn record(arguments: &[&str]) -> (Value, String) {
    let mut all = vec!["audit", "--format", "json", "--quiet"];
    all.extend(arguments);
    let output = hairline(&all);
    let error = text(&output.stderr);
    assert_eq!(output.status.code(), Some(0), "{arguments:?}: {error}");
    (serde_json::from_slice(&output.stdout).unwrap(), error)
}

/// Runs, expects bad input or failed output, and returns the line that says why.
fn refused(arguments: &[&str], code: i32) -> String {
    let output = hairline(arguments);
    let error = text(&output.stderr);
    assert_eq!(output.status.code(), Some(code), "{arguments:?}: {error}");
    assert_eq!(text(&output.stdout), "", "{arguments:?}");
    let line = error.lines().find(|line| line.starts_with("hairline: "));
    line.unwrap_or_else(|| panic!("no message: {error}"))
        .to_owned()
}

const COUNT: u64 = 1500;
const FLAGS: [&str; 6] = ["--family", "interior", "-n", "1500", "--scalar", "f64"];

/// On how many cases of the run below tests/kernels/misbehave.c misbehaves.
fn faulty_cases() -> u64 {
    let interior = family::find("interior").unwrap();
    let is_faulty = |index: &u64| {
        let made = interior.make::<f64>(&Parameters::default(), 1, *index);
        let [origin, ..] = made.cases()[0].vectors();
        (origin[0].to_bits() >> 20).is_multiple_of(64)
    };
    (0..COUNT).filter(is_faulty).count() as u64
}

fn count(record: &Value, pointer: &str) -> u64 {
    let pointer = format!("/result/results/0/total/{pointer}");
    record
        .pointer(&pointer)
        .and_then(Value::as_u64)
        .unwrap_or_else(|| panic!("{pointer}"))
}

#[test]
fn a_library_that_crashes_exits_or_writes_where_it_must_not_is_a_finding_case_by_case() {
    let faulty = faulty_cases();
    assert!((5..60).contains(&faulty), "{faulty}");
    for (fault, word) in [
        ("SEGFAULT", "died of signal 11 (SIGSEGV)"),
        ("ABORT", "died of signal 6 (SIGABRT)"),
        ("EXIT", "ended its process with exit code 0"),
        ("WRITE_PAST", "touched memory outside its buffers"),
        ("WRITE_BEFORE", "touched memory outside its buffers"),
        ("WRITE_INPUT", "touched memory outside its buffers"),
        ("READ_PAST", "touched memory outside its buffers"),
        ("THROW", "threw a C++ exception"),
    ] {
        let Some(library) = misbehaving(fault) else {
            return;
        };
        let flags = [&["--kernel-lib", &library][..], &FLAGS].concat();
        let (record, _) = record(&flags);
        assert_eq!(count(&record, "crashes"), faulty, "{fault}");
        assert_eq!(count(&record, "timeouts"), 0, "{fault}");
        // Everywhere else it misses what it must hit: the run went on.
        assert_eq!(
            count(&record, "false_misses/count"),
            COUNT - faulty,
            "{fault}"
        );
        assert_eq!(
            count(&record, "false_misses/of"),
            COUNT - faulty,
            "{fault}: no verdict, no trial"
        );
        let table = text(&hairline(&[&["audit"][..], &flags].concat()).stdout);
        assert!(
            table.contains(&format!("misbehave (own): {faulty} crashes")),
            "{table}"
        );
        // The command in the table shows it again, with what it died of.
        let findings = record
            .pointer("/result/results/0/findings")
            .unwrap()
            .as_array()
            .unwrap();
        let crash = findings
            .iter()
            .find(|finding| finding["finding"] == "crash")
            .unwrap();
        let command = crash["worst"]["command"].as_str().unwrap();
        assert!(command.contains("--kernel-lib '"), "{command}");
        let words: Vec<&str> = command
            .split_whitespace()
            .skip(1)
            .map(|word| word.trim_matches('\''))
            .collect();
        let shown = text(&hairline(&words).stdout);
        assert!(
            flat(&shown).contains(&format!("misbehave (own): {word}; ")),
            "{fault}: {shown}"
        );
        assert!(flat(&shown).contains(": CRASH"), "{fault}: {shown}");
    }
}

#[test]
fn a_library_that_hangs_is_a_finding_and_the_run_ends() {
    let Some(library) = misbehaving("HANG") else {
        return;
    };
    let start = Instant::now();
    let flags = ["--kernel-timeout", "1", "--kernel-lib", &library];
    let (record, _) = record(&[&flags[..], &FLAGS].concat());
    assert_eq!(count(&record, "timeouts"), faulty_cases());
    assert_eq!(count(&record, "false_misses/count"), COUNT - faulty_cases());
    assert!(start.elapsed() < Duration::from_secs(60));
    // One that also shuts its pipes and lives on.
    let Some(library) = misbehaving("CLOSE_PIPES") else {
        return;
    };
    let flags = [
        "audit",
        "--kernel-timeout",
        "0.1",
        "--kernel-failures",
        "0",
        "--kernel-lib",
    ];
    let error = refused(&[&flags[..], &[&library], &FLAGS].concat(), 65);
    assert!(
        error.contains("gave no answer in time on '{\"scalar\":"),
        "{error}"
    );
}

/// A library of tests/kernels/start.c, and the file to which each of its processes appends a line.
fn starting(name: &str, flags: &[&str]) -> Option<(String, PathBuf)> {
    let source = PathBuf::from(HERE).join("tests/kernels/start.c");
    let started = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("{name}.started"));
    let _ = fs::remove_file(&started);
    let to = format!("-DSTARTED=\"{}\"", started.display());
    Some((library(&source, name, &[flags, &[&to]].concat())?, started))
}

fn lines_of(file: &Path) -> usize {
    fs::read_to_string(file).unwrap().lines().count()
}

#[test]
fn a_start_has_a_limit_of_its_own_and_is_no_cases_fault() {
    let Some((slow, started)) = starting("start-slow", &["-DFIRST=3", "-DCALL=0.1"]) else {
        return;
    };
    // Longer than a busy machine delays an answer, and shorter than the start.
    let flags = ["--kernel-timeout", "2.5", "--threads", "2", "--kernel-lib"];
    let (answered, error) = record(&[&flags[..], &[&slow], &FLAGS].concat());
    assert_eq!((count(&answered, "timeouts"), &error[..]), (0, ""));
    // No other process is worth another three seconds.
    assert_eq!(lines_of(&started), 1);
    let (hangs, _) = starting("start-hangs", &["-DFIRST=100"]).unwrap();
    let flags = [
        "audit",
        "--kernel-start",
        "0.4",
        "--kernel-timeout",
        "0.2",
        "--kernel-lib",
    ];
    let error = refused(&[&flags[..], &[&hangs], &FLAGS].concat(), 65);
    let message = "in its first call, on a plain case, it was silent for 0.4 s after its start (--kernel-start";
    assert!(error.contains(message), "{error}");
    // Its first call, at its start, is answered, and no other.
    let (mute, _) = starting("start-mute", &["-DCALL=100"]).unwrap();
    let flags = ["audit", "--kernel-timeout", "0.2", "--kernel-lib"];
    let error = refused(&[&flags[..], &[&mute], &FLAGS].concat(), 65);
    assert!(error.contains("its function does not return"), "{error}");
    // The first process dies of its first batch, and no other gets as far.
    let file = started.with_extension("again");
    let _ = fs::remove_file(&file);
    let dies = shell("read line; exit 3");
    let once = format!(
        "test -e \"{0}\" && sleep 100; touch \"{0}\"; printf",
        file.display()
    );
    let dies = dies.replacen("printf", &once, 1);
    let flags = [
        "audit",
        "--kernel-start",
        "2",
        "--kernel-timeout",
        "2",
        "--kernel-cmd",
    ];
    let error = refused(&[&flags[..], &[&dies], &FLAGS].concat(), 65);
    let message =
        "kernel 'sh': started again, before its hello was over it was silent for 2 s after";
    assert!(error.contains(message), "{error}");
    let error = refused(&["audit", "--kernel-start", "0", "--kernel-lib", &slow], 2);
    assert!(
        error.contains("--kernel-start: 0 is not from 0.001"),
        "{error}"
    );
}

#[test]
fn a_kernel_may_want_one_process_and_answers_as_in_many() {
    let slow_calls = "-DCALL=0.05";
    let Some((one, of_one)) = starting("start-one", &["-DPROCESSES=1", slow_calls]) else {
        return;
    };
    let (many, of_many) = starting("start-many", &[slow_calls]).unwrap();
    let flags = [
        "--family",
        "edge-near",
        "-n",
        "40000",
        "--scalar",
        "f64",
        "--threads",
        "4",
    ];
    let [in_one, in_many] = [&one, &many].map(|library| {
        let (record, _) = record(&[&flags[..], &["--kernel-lib", library]].concat());
        record["result"]["results"][0]["total"].clone()
    });
    assert!(in_one.is_object());
    assert_eq!(in_one, in_many);
    assert_eq!(lines_of(&of_one), 1);
    assert!(1 < lines_of(&of_many), "{}", lines_of(&of_many));
    // Over a pipe it is a line of the hello.
    let file = of_one.with_extension("piped");
    let _ = fs::remove_file(&file);
    let piped = shell(&format!("echo $$ >>\"{}\"; {MISSES}", file.display()));
    let piped = piped.replace("ready", "processes 1\\nready");
    let flags = [
        "--family",
        "interior",
        "-n",
        "4096",
        "--scalar",
        "f64",
        "--threads",
        "4",
    ];
    let (record, _) = record(&[&flags[..], &["--kernel-cmd", &piped]].concat());
    assert_eq!(
        (count(&record, "false_misses/count"), lines_of(&file)),
        (4096, 1)
    );
    let (none, _) = starting("start-none", &["-DPROCESSES=0"]).unwrap();
    let error = refused(&["audit", "--kernel-lib", &none], 65);
    assert!(error.contains("processes: '0' is not 1 or more"), "{error}");
}

#[test]
fn what_a_kernel_prints_does_not_flood_standard_error() {
    let left_out = "note: kernel 'misbehave': it writes more than 50 different lines to standard error; the rest is left out";
    let Some(library) = misbehaving("PRINT") else {
        return;
    };
    let (_, error) = record(&[&["--threads", "2", "--kernel-lib", &library][..], &FLAGS].concat());
    assert_eq!(
        error.lines().filter(|line| line.contains("case ")).count(),
        50,
        "{error}"
    );
    assert_eq!(error.matches(left_out).count(), 1, "{error}");
    // What one case prints is there, also what came last.
    let explain = ["explain", "interior@2/f64/-/1/3", "--kernel-lib", &library];
    let error = text(&hairline(&explain).stderr);
    assert!(
        error.starts_with("case 0 of 1\n") && error.ends_with("HLA1"),
        "{error}"
    );
    assert!(!error.contains(left_out), "{error}");
    let Some(library) = misbehaving("THROW") else {
        return;
    };
    let (record, error) =
        record(&[&["--threads", "2", "--kernel-lib", &library][..], &FLAGS].concat());
    assert!(12 < count(&record, "crashes"));
    let lines = error
        .lines()
        .filter(|line| line.contains("terminate called"))
        .count();
    assert_eq!(lines, 1, "each line once: {error}");
}

#[test]
fn a_kernel_that_is_silent_again_and_again_is_given_up_and_each_time_is_said() {
    let Some(library) = misbehaving("HANG") else {
        return;
    };
    let flags = [
        "audit",
        "--kernel-timeout",
        "0.1",
        "--kernel-failures",
        "2",
        "--threads",
        "1",
    ];
    let output = hairline(&[&flags[..], &["--kernel-lib", &library], &FLAGS].concat());
    let error = text(&output.stderr);
    assert_eq!(output.status.code(), Some(65), "{error}");
    for number in 1..=3 {
        let said =
            format!("kernel 'misbehave': no answer within 0.1 s, {number} of 3: {{\"scalar\":");
        assert_eq!(error.matches(&said).count(), 1, "{error}");
    }
    let quiet = hairline(&[&flags[..], &["--quiet", "--kernel-lib", &library], &FLAGS].concat());
    assert!(
        !text(&quiet.stderr).contains("no answer within 0.1 s,"),
        "{quiet:?}"
    );
    assert!(
        !text(&quiet.stderr).contains(" cases together;"),
        "{quiet:?}"
    );
    assert!(
        error.contains(" cases together; they are asked one by one\n"),
        "{error}"
    );
    assert!(
        error.contains("it gave no answer within 0.1 s on 3 cases (--kernel-timeout"),
        "{error}"
    );
}

#[test]
fn what_a_library_says_of_itself_is_checked_and_what_it_leaves_out_is_said() {
    let Some(library) = misbehaving("BAD_GIVES") else {
        return;
    };
    let error = refused(&["audit", "--kernel-lib", &library], 65);
    assert!(
        error.contains("its gives is 255, expected HAIRLINE_GIVES_T (1), "),
        "{error}"
    );
    let Some(library) = misbehaving("EPSILONS") else {
        return;
    };
    let output = hairline(&[&["audit", "--kernel-lib", &library][..], &FLAGS].concat());
    let screen = text(&output.stdout).replace('\n', " ");
    let ends =
        "excludes those near the start; if that is meant, promise less: --contract own,ends=free.";
    assert_eq!(screen.matches(ends).count(), 1, "{screen}");
    let role = "misbehave: what its epsilon 'slack' is there to refuse is not known";
    assert_eq!(screen.matches(role).count(), 1, "{screen}");
    let less = [
        "audit",
        "--contract",
        "own,ends=free",
        "--kernel-lib",
        &library,
    ];
    let screen = text(&hairline(&[&less[..], &FLAGS].concat()).stdout);
    assert!(!screen.contains("excludes those"), "{screen}");
    // Where it touches what is not its own the sizes of its structs are named.
    let Some(library) = misbehaving("WRITE_PAST") else {
        return;
    };
    let (_, error) = record(&[&["--kernel-lib", &library][..], &FLAGS].concat());
    assert!(
        error.contains("hairline.h (in f64 136 bytes a case, 32 a verdict)?"),
        "{error}"
    );
    let error = refused(&["prove", "--kernel-lib", &library], 2);
    assert!(
        error.contains("name the built-in kernel of the same formula"),
        "{error}"
    );
}

#[test]
fn too_many_failures_end_the_run_with_the_first_of_them() {
    let Some(library) = misbehaving("ABORT") else {
        return;
    };
    let flags = ["audit", "--kernel-failures", "3", "--kernel-lib", &library];
    let error = refused(&[&flags[..], &FLAGS].concat(), 65);
    assert!(
        error.contains("kernel 'misbehave': it failed on more than 3 cases"),
        "{error}"
    );
    assert!(
        error.contains("first: died of signal 6 (SIGABRT) on '{\"scalar\":"),
        "{error}"
    );
    // That case can be looked at.
    let case = error
        .split('\'')
        .find(|part| part.starts_with('{'))
        .unwrap();
    let explained = hairline(&["explain", case, "--kernel", "woop-watertight"]);
    assert_eq!(explained.status.code(), Some(0), "{case}");
}

#[test]
fn prints_and_bad_values_of_a_library_do_no_harm() {
    let Some(library) = misbehaving("PRINT") else {
        return;
    };
    let (printing, error) = record(&[&["--kernel-lib", &library][..], &FLAGS].concat());
    assert_eq!(count(&printing, "false_misses/count"), COUNT);
    assert!(
        error.contains("case 0 of "),
        "its prints are on standard error"
    );
    let Some(library) = misbehaving("RETURN_NAN") else {
        return;
    };
    let (nan, _) = record(&[&["--kernel-lib", &library][..], &FLAGS].concat());
    assert_eq!(count(&nan, "bad_values/count"), faulty_cases());
    // It is told before the table, as no hit of its is of use.
    let screen =
        text(&hairline(&[&["audit", "-q", "--kernel-lib", &library][..], &FLAGS].concat()).stdout);
    let told = format!(
        "misbehave (own), f64: of {0} hits that are not false {0} come with a t, ",
        faulty_cases()
    );
    let words = screen.split_whitespace().collect::<Vec<_>>().join(" ");
    let (before, _) = words.split_once(told.trim_end()).expect(&screen);
    assert!(!before.contains("cause of most"), "{screen}");
}

/// A library may change how the process computes that loads it, or do so while it runs.
#[test]
fn another_arithmetic_in_a_kernels_process_is_said_everywhere_and_can_be_refused() {
    let at_load = "flush-to-zero and denormals-are-zero from the start";
    let faults = [
        (cfg!(target_arch = "x86_64"), "FLUSH_AT_LOAD", at_load),
        (
            true,
            "ROUND_UP",
            "rounding up, set by the kernel while it ran",
        ),
    ];
    for (_, fault, words) in faults.into_iter().filter(|(is_here, ..)| *is_here) {
        let Some(library) = misbehaving(fault) else {
            return;
        };
        let said = format!("its process computes with {words}");
        let plan = [
            "--kernel-lib",
            &library,
            "--family",
            "interior",
            "-n",
            "100",
        ];
        let (record, error) = record(&plan);
        let note = &record["provenance"]["kernel_notes"]["misbehave"][0];
        assert!(note.as_str().unwrap().starts_with(&said), "{note}");
        assert_eq!(
            error
                .matches(&format!("note: kernel 'misbehave': {said}"))
                .count(),
            1,
            "{error}"
        );
        for (format, more) in [("text", &[][..]), ("text", &["--details"]), ("html", &[])] {
            let all = [&["audit", "--format", format, "--quiet"], more, &plan].concat();
            let out = text(&hairline(&all).stdout)
                .split_whitespace()
                .collect::<Vec<_>>()
                .join(" ");
            assert!(out.contains(&said), "{format} {more:?}: {out}");
        }
        let error = refused(&[&["audit", "--require-ieee"], &plan[..]].concat(), 65);
        assert!(
            error.contains(&said) && error.ends_with("--require-ieee refuses"),
            "{error}"
        );
    }
    let Some(library) = misbehaving("NOTHING") else {
        return;
    };
    let (record, error) = record(&[
        "--require-ieee",
        "--kernel-lib",
        &library,
        "--family",
        "interior",
        "-n",
        "100",
    ]);
    assert!(
        record["provenance"]["kernel_notes"].is_null() && error.is_empty(),
        "{error}"
    );
}

#[test]
fn crashes_are_expected_once_they_are_blessed() {
    let Some(library) = misbehaving("SEGFAULT") else {
        return;
    };
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("plugin-blessed");
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).unwrap();
    let file = folder.join("e.toml");
    let file = file.to_str().unwrap();
    let check = |more: &[&str]| {
        let plan = [
            "check",
            "-q",
            "--expectations",
            file,
            "--family",
            "interior",
            "-n",
            "300",
        ];
        hairline(&[&plan[..], &["--scalar", "f64"], more].concat())
    };
    let own = ["--kernel-lib", &library];
    assert_eq!(
        check(&[&own[..], &["--bless"]].concat()).status.code(),
        Some(0)
    );
    assert!(fs::read_to_string(file).unwrap().contains("\"crash\""));
    let output = check(&own);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    // Without its library the kernel is not known, and what would make it so is said.
    let output = check(&["--kernel", "plucker"]);
    assert_eq!(output.status.code(), Some(65));
    assert!(
        text(&output.stderr).contains("--kernel-lib or --kernel-cmd"),
        "{output:?}"
    );
}

#[test]
fn a_kernel_whose_second_answer_is_another_is_named_and_is_no_regression() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("plugin-unsteady");
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).unwrap();
    let file = folder.join("e.toml");
    let check = |fault: &str, more: &[&str], code: i32| {
        let library = misbehaving(fault)?;
        let plan = [
            "check", "-q", "--family", "outside", "-n", "300", "--scalar", "f64",
        ];
        let plan = [
            &plan[..],
            &["--expectations", file.to_str()?, "--threads", "1"],
        ]
        .concat();
        let output = hairline(&[&plan[..], &["--kernel-lib", &library], more].concat());
        assert_eq!(output.status.code(), Some(code), "{output:?}");
        Some([&output.stdout, &output.stderr].map(|bytes| flat(&text(bytes))))
    };
    let bless = &["--bless", "--accept-worse"];
    let Some([_, error]) = check("UNSTEADY", bless, 65) else {
        return;
    };
    assert!(
        error.contains("e.toml is not written: answers that differ from run to run can be no "),
        "{error}"
    );
    assert!(!file.exists());
    check("SEGFAULT", bless, 0);
    let [out, _] = check("UNSTEADY", &["--format", "text"], 65).unwrap();
    let expected = [
        "Cannot be compared: answers of ",
        " differ from run to run ",
        "expected the same answer each time, but answers differ from run to run: asked again, the case shown is none",
        "hairline explain 'outside@3/f64/-/1/",
    ];
    for expected in expected {
        assert!(out.contains(expected), "{expected}: {out}");
    }
    for (format, expected) in [
        ("junit", "failure type="),
        ("sarif", "\"ruleId\":\"unsteady\""),
    ] {
        let [out, _] = check("UNSTEADY", &["--format", format], 65).unwrap();
        assert!(out.replace(": ", ":").contains(expected), "{out}");
    }
    // The same together twice, and otherwise alone: it did get worse.
    let [out, _] = check("BY_PLACE", &[], 1).unwrap();
    let expected =
        "; asked alone, the case shown is none: the answer depends on the cases asked before it";
    assert!(out.contains(expected), "{out}");
    // The names of stored cases are ids of other sources: they tell no place.
    let whole = [
        "corpus", "generate", "--family", "outside", "-n", "300", "--scalar", "f64",
    ];
    let whole = text(&hairline(&whole).stdout);
    let mut lines: Vec<&str> = whole.lines().collect();
    lines.reverse();
    for (name, lines) in [("reversed", &lines[..]), ("few", &lines[..40])] {
        let stored = folder.join(format!("{name}.jsonl"));
        fs::write(&stored, lines.join("\n")).unwrap();
        let known = folder.join(format!("{name}.toml"));
        let plan = [
            "check",
            "-q",
            "--corpus",
            stored.to_str().unwrap(),
            "--expectations",
        ];
        let run = |fault: &str, more: &[&str]| {
            let library = misbehaving(fault).unwrap();
            let flags = [known.to_str().unwrap(), "--kernel-lib", &library];
            hairline(&[&plan[..], &flags, more].concat())
        };
        assert_eq!(run("NOTHING", bless).status.code(), Some(0));
        let output = run("RETURN_NAN", &[]);
        assert_eq!(output.status.code(), Some(1), "{output:?}");
        assert!(!text(&output.stdout).contains("asked a"), "{output:?}");
    }
    // What is the same each time is a regression as before.
    check("NOTHING", bless, 0);
    let [out, _] = check("RETURN_NAN", &[], 1).unwrap();
    assert!(!out.contains("asked a"), "{out}");
}

#[test]
fn records_of_a_library_are_merged_when_it_is_named_again() {
    let source = PathBuf::from(HERE).join("examples/c/moller_trumbore.c");
    let Some(library) = library(&source, "merged", &[]) else {
        return;
    };
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("plugin-merged");
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).unwrap();
    let at = |name: &str| folder.join(name).to_str().unwrap().to_owned();
    let run = |words: &[&str], file: &str| {
        let to = ["-q", "--format", "json", "-o", file];
        let output = hairline(&[words, &to].concat());
        assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
        let record: Value = serde_json::from_slice(&fs::read(file).unwrap()).unwrap();
        record["result"].clone()
    };
    let plan = [
        "audit",
        "--kernel-lib",
        &library,
        "--family",
        "tiny",
        "-n",
        "500",
    ];
    let whole = run(&plan, &at("whole"));
    let parts = [at("0"), at("1")];
    for (file, shard) in parts.iter().zip(["0/2", "1/2"]) {
        run(&[&plan[..], &["--shard", shard]].concat(), file);
    }
    let merge = ["merge", &parts[0], &parts[1]];
    let error = refused(&merge, 65);
    let flag = format!("by running it: add --kernel-lib '{library}'");
    assert!(error.contains(&flag), "{error}");
    // In other words, because the parts may have been run elsewhere.
    let copy = at("libelsewhere.so");
    fs::copy(&library, &copy).unwrap();
    for library in [&library, &copy] {
        let merged = run(
            &[&merge[..], &["--kernel-lib", library]].concat(),
            &at("merged"),
        );
        assert_eq!(merged, whole);
    }
    // Another build may answer otherwise, and the causes of findings would be its own.
    let Some(other) = self::library(&source, "merged-other", &["-O0", "-g"]) else {
        return;
    };
    assert_ne!(fs::read(&other).unwrap(), fs::read(&library).unwrap());
    let error = refused(&[&merge[..], &["--kernel-lib", &other]].concat(), 65);
    assert!(
        error.contains("no file that is named here is that one: name the file"),
        "{error}"
    );
    let folder = folder.join("other");
    fs::create_dir_all(&folder).unwrap();
    let namesake = folder.join(Path::new(&library).file_name().unwrap());
    fs::copy(&other, &namesake).unwrap();
    let namesake = namesake.to_str().unwrap();
    let error = refused(&[&merge[..], &["--kernel-lib", namesake]].concat(), 65);
    assert!(error.contains(" is another build here ("), "{error}");
}

#[test]
fn a_difference_of_two_records_shows_a_case_that_one_of_the_kernels_gets_right() {
    let source = PathBuf::from(HERE).join("tests/kernels/year.c");
    let of = |name: &str, epsilon: &str| {
        let library = library(&source, name, &[&format!("-DEPSILON=\"{epsilon}\"")])?;
        let file = format!("{library}.json");
        let plan = [
            "audit",
            "-q",
            "--kernel-lib",
            &library,
            "--family",
            "grazing,fan",
        ];
        let output =
            hairline(&[&plan[..], &["-n", "500", "--format", "json", "-o", &file]].concat());
        assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
        Some((library, file))
    };
    let (Some(strict), Some(loose)) = (of("strict", "1e-3"), of("loose", "1e-9")) else {
        return;
    };
    let is_right = |case: &str, library: &str| {
        let shown = text(&hairline(&["explain", case, "--kernel-lib", library]).stdout);
        assert!(shown.contains("mine (own): "), "{shown}");
        shown.contains("as it should")
    };
    for (old, new, note) in [
        (&loose, &strict, "is new"),
        (&strict, &loose, "no longer shows it"),
    ] {
        let output = hairline(&["diff", &old.1, &new.1]);
        let shown = text(&output.stdout);
        let lines: Vec<&str> = shown.lines().collect();
        let noted = format!("; the case shown {note}");
        let places = (0..lines.len()).filter(|&i| lines[i].ends_with(&noted));
        let cases = places.map(|i| lines[i + 1].split('\'').nth(1).unwrap());
        let mut seen = 0;
        for case in cases {
            let [before, now] = [old, new].map(|side| is_right(case, &side.0));
            assert_eq!(
                [before, now],
                [note == "is new", note != "is new"],
                "{case}: {shown}"
            );
            seen += 1;
        }
        assert!(0 < seen, "{shown}");
    }
}

#[test]
fn a_crash_that_no_single_case_repeats_is_said() {
    let Some(library) = misbehaving("ONLY_IN_BATCHES") else {
        return;
    };
    let (record, error) = record(&[&["--kernel-lib", &library][..], &FLAGS].concat());
    assert_eq!(count(&record, "crashes"), 0);
    assert!(
        error.contains("note: kernel 'misbehave': asked "),
        "{error}"
    );
    assert!(
        error.contains("cases at once it died of signal 6 (SIGABRT); asked one by one"),
        "{error}"
    );
}

#[test]
fn a_library_that_is_no_kernel_or_answers_nonsense_is_refused() {
    for (fault, message) in [
        ("NO_ANSWER", "kernel 'misbehave': verdict "),
        ("WRONG_ANSWER", "hit is 7, expected 0 or 1"),
        (
            "OTHER_ABI",
            "it was built with version 2 of hairline.h, this program has version 1",
        ),
        ("NULL_DESCRIPTION", "hairline_describe returned NULL"),
        (
            "CRASH_IN_DESCRIBE",
            "before its hello was over it died of signal 6 (SIGABRT)",
        ),
        ("BAD_CONTRACT", "contract: 'closed ray' is no contract"),
    ] {
        let Some(library) = misbehaving(fault) else {
            return;
        };
        let error = refused(
            &[&["audit", "--kernel-lib", &library][..], &FLAGS].concat(),
            65,
        );
        assert!(error.contains(message), "{fault}: {error}");
    }
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("no-kernels");
    fs::create_dir_all(&folder).unwrap();
    fs::write(folder.join("empty.c"), "int unused;\n").unwrap();
    let Some(empty) = library(&folder.join("empty.c"), "empty", &[]) else {
        return;
    };
    let error = refused(&["list", "kernels", "--kernel-lib", &empty], 65);
    assert!(
        error.contains("libempty.so: it has no function hairline_abi"),
        "{error}"
    );
    let abi = "#include \"hairline.h\"\nuint32_t hairline_abi(void) { return HAIRLINE_ABI; }\n";
    fs::write(folder.join("bare.c"), abi).unwrap();
    let Some(bare) = library(&folder.join("bare.c"), "bare", &[]) else {
        return;
    };
    let error = refused(&["list", "kernels", "--kernel-lib", &bare], 65);
    assert!(
        error.contains("it has neither hairline_test_f32 nor hairline_test_f64"),
        "{error}"
    );
    let this = format!("{HERE}/Cargo.toml");
    assert!(refused(&["audit", "--kernel-lib", &this], 65).contains("Cargo.toml: "));
    assert!(refused(&["audit", "--kernel-lib", "no.so"], 74).contains("no.so: No such file"));
}

#[test]
fn the_example_in_c_is_moller_trumbore_bit_for_bit() {
    let source = PathBuf::from(HERE).join("examples/c/moller_trumbore.c");
    let Some(library) = library(&source, "moller_trumbore", &["-Wall", "-Wextra", "-Werror"])
    else {
        return;
    };
    let families = "edge-near,tiny,range-ends,invalid,fan,direction-length";
    let flags = [
        "--kernel-lib",
        &library,
        "--kernel",
        "moller-trumbore",
        "--family",
        families,
    ];
    let (record, _) = record(&[&flags[..], &["-n", "2500"]].concat());
    let results = record["result"]["results"].as_array().unwrap();
    let of = |kernel: &str| -> Vec<(Value, Value)> {
        let of_kernel = results.iter().filter(|result| result["kernel"] == kernel);
        of_kernel
            .map(|result| (result["total"].clone(), result["across"].clone()))
            .collect()
    };
    let (mine, built_in) = (of("c-moller-trumbore"), of("moller-trumbore"));
    assert_eq!(mine.len(), 12);
    assert_eq!(mine, built_in);
    let listed = text(&hairline(&["list", "kernels", "--kernel-lib", &library]).stdout);
    assert!(
        listed.contains("c-moller-trumbore\n    source: Moller and Trumbore"),
        "{listed}"
    );
    // Its epsilon is a gate like any other, and what is not shown is said.
    let tight = [
        "explain",
        "tiny@3/f32/-/1/0",
        "--epsilon",
        "parallel=0",
        "--kernel-lib",
        &library,
    ];
    let shown = text(&hairline(&tight).stdout);
    assert!(
        shown.contains("c-moller-trumbore (parallel=0): hit;"),
        "{shown}"
    );
    assert!(shown.contains("it does not show its formula"), "{shown}");
    // At its own epsilon it is refused by that, and right with every epsilon 0: the cause.
    let tiny = ["explain", "tiny@3/f32/-/1/0", "--kernel-lib", &library];
    let shown = text(&hairline(&tiny).stdout);
    // The same formula is found, and what it does here; other epsilons part from it, and other answers are of none.
    let said = flat(&shown);
    let found = "compared, not proved: on 1,000 of 1,000 cases like this one it answers as moller-trumbore does";
    let here = "here that formula refuses by its gate parallel (abs(det) < e) too: epsilon";
    assert!(said.contains(found) && said.contains(here), "{said}");
    let plain = [
        "explain",
        "interior@2/f32/-/1/0",
        "--kernel-lib",
        &library,
        "--epsilon",
    ];
    let parted = flat(&text(
        &hairline(&[&plain[..], &["parallel=0.26"]].concat()).stdout,
    ));
    let apart = "here they part: that formula hits, so something else decides";
    assert!(parted.contains(apart), "{parted}");
    let shell = [
        "explain",
        "interior@2/f64/-/1/0",
        "--kernel-cmd",
        &shell(MISSES),
    ];
    let none = flat(&text(&hairline(&shell).stdout));
    assert!(
        none.contains("FALSE-MISS") && !none.contains("compared, not proved"),
        "{none}"
    );
    assert!(
        flat(&shown).contains(" 1e-6 refuses <- decides refuses where abs(det) < e"),
        "{shown}"
    );
    assert!(
        flat(&shown).contains("why the false-miss: epsilon (with every epsilon 0 it is right"),
        "{shown}"
    );
    let audit = [
        "audit",
        "-q",
        "--kernel-lib",
        &library,
        "--family",
        "tiny,edge-near",
        "-n",
        "500",
    ];
    let screen = text(&hairline(&[&audit[..], &["--attribute", "100"]].concat()).stdout);
    assert!(
        screen.contains("  epsilon 98.8%") && screen.contains("  not-epsilon 100.0%"),
        "{screen}"
    );
}

#[test]
fn the_epsilons_of_a_library_are_those_of_the_same_kernel_with_gates() {
    let source = PathBuf::from(HERE).join("examples/c/moller_trumbore.c");
    let Some(library) = library(&source, "tuned", &[]) else {
        return;
    };
    let answers = |kernel: &[&str], own: &str| -> Vec<Value> {
        let words = [
            "epsilon", "--scene", "room", "-n", "1500", "--quiet", "--format", "json",
        ];
        let output = hairline(&[&words[..], kernel].concat());
        assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
        let plain = text(&output.stdout).replace(&format!("\"{own}\""), "\"own\"");
        let record: Value = serde_json::from_str(&plain).unwrap();
        // What is proved, and exact errors, need the formula.
        let part = |list: &str, fields: &[&str]| -> Value {
            let list = record["result"]["kernels"][0][list]
                .as_array()
                .unwrap()
                .iter();
            let of = |item: &Value| fields.iter().map(|field| item[field].clone()).collect();
            list.map(of).collect::<Vec<Value>>().into()
        };
        let limits = [
            "knob", "count", "is_lower", "value", "far", "one_in", "fresh",
        ];
        vec![
            part("tried", &["name", "epsilons", "wrong"]),
            part("limits", &limits),
        ]
    };
    let in_c = answers(&["--kernel-lib", &library], "own");
    let built_in = answers(
        &["--kernel", "moller-trumbore", "--gate", "parallel,t_min"],
        "source",
    );
    assert_eq!(in_c, built_in);
    assert!(in_c[0][0][0] == "recommended" && !in_c[1].as_array().unwrap().is_empty());
    // Gate by gate, and case by case.
    let of_gate = [
        "epsilon",
        "--kernel-lib",
        &library,
        "--gate",
        "parallel",
        "--family",
        "grazing",
    ];
    let shown = text(&hairline(&[&of_gate[..], &["-n", "500"]].concat()).stdout);
    assert!(
        shown.contains("c-moller-trumbore f32 on grazing"),
        "{shown}"
    );
    let case = [
        "explain",
        "tiny@3/f32/-/1/0",
        "--kernel",
        "moller-trumbore",
        "--kernel-lib",
    ];
    let output = hairline(&[&case[..], &[&library, "--format", "json"]].concat());
    let shown: Value = serde_json::from_slice(&output.stdout).unwrap();
    let rows = shown["triangles"][0]["rows"].as_array().unwrap();
    let margin = |row: &Value| row["gates"][0]["margin"].as_str().unwrap().to_owned();
    assert_eq!(margin(&rows[0]), margin(&rows[1]), "{shown}");
}

#[test]
fn an_epsilon_that_does_not_refuse_more_as_it_grows_is_found_out() {
    let source = PathBuf::from(HERE).join("tests/kernels/year.c");
    let Some(library) = library(&source, "backwards", &["-DBACKWARDS"]) else {
        return;
    };
    let error = refused_after_output(&["epsilon", "--kernel-lib", &library, "-n", "1500"]);
    assert!(
        error.contains("kernel 'mine': its epsilons do not each act alone"),
        "{error}"
    );
    assert!(
        error.contains("Raising an epsilon must only refuse more"),
        "{error}"
    );
}

/// A neighbour may take a ray at a shared edge, so a scene's check counts what none of them takes.
#[test]
fn a_tolerance_that_closes_cracks_is_better_in_the_check_of_a_scene() {
    let source = PathBuf::from(HERE).join("tests/kernels/year.c");
    let Some(strict) = library(&source, "strict", &[]) else {
        return;
    };
    let tolerant = library(&source, "tolerant", &["-DEDGE=1e-3f"]).unwrap();
    let folder = crate::program::scratch("plugin-scene-check");
    let check = |library: &str, more: &[&str], code: i32| {
        let run = [
            "check",
            "--kernel-lib",
            library,
            "--scene",
            "room",
            "--scalar",
            "f32",
        ];
        crate::program::ends(
            &folder,
            &[&run[..], &["-n", "2000", "-q"], more].concat(),
            code,
        )
        .0
    };
    check(&strict, &["--bless"], 0);
    let file = fs::read_to_string(folder.join("hairline.expectations.toml.lock")).unwrap();
    let of_shared = |line: &&str| line.contains("scene-edges") || line.contains("scene-vertices");
    let shared: Vec<&str> = file.lines().filter(of_shared).collect();
    // On every kind of planes and rays on which there are any.
    assert!(
        10 < shared.len() && shared.iter().all(|line| line.contains("crack")),
        "{shared:?}"
    );
    let out = check(&tolerant, &["--details"], 1);
    let (out, _) = out.split_once("\nThe run\n").expect(&out);
    for family in ["scene-edges", "scene-vertices"] {
        assert!(!out.contains(&format!("{family}: false-")), "{out}");
        assert!(
            out.contains(&format!("{family}: crack of group: 0 of ")),
            "{out}"
        );
    }
}

#[test]
fn crashes_while_margins_are_asked_for_end_nothing() {
    let source = PathBuf::from(HERE).join("tests/kernels/year.c");
    let Some(library) = library(&source, "crashing", &["-DCRASH"]) else {
        return;
    };
    let output = hairline(&[
        "epsilon",
        "--kernel-lib",
        &library,
        "--scene",
        "room",
        "-n",
        "700",
    ]);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    assert!(text(&output.stdout).contains("use  --epsilon parallel="));
    let note = "note: kernel 'mine': on ";
    assert!(
        text(&output.stderr).contains(note),
        "{}",
        text(&output.stderr)
    );
    assert!(text(&output.stderr).contains("they are left out; first: it died of signal 6"));
    let gates = ["epsilon", "--kernel-lib", &library, "--gate", "parallel"];
    let gates = [
        &gates[..],
        &["--family", "interior,scene-interior", "-n", "1000"],
    ]
    .concat();
    let output = hairline(&gates);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    // What fails at extreme epsilons alone has a report all the same, and no epsilon for a scene.
    let Some(strict) = crate::plugin::library(&source, "asserting", &["-DASSERTING"]) else {
        return;
    };
    let file = format!("{strict}.html");
    let report = [
        "audit",
        "-q",
        "--kernel-lib",
        &strict,
        "--family",
        "interior",
        "-n",
        "300",
    ];
    let output = hairline(&[&report[..], &["--format", "html", "-o", &file]].concat());
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    let error = refused(&["epsilon", "--kernel-lib", &strict, "-n", "300", "-q"], 65);
    assert!(
        error.contains("kernel 'mine': it fails at some epsilons, from the smallest"),
        "{error}"
    );
}

/// A kernel in `sh` with these lines after its hello; `$1` is `case`, `end` and so on.
fn shell(body: &str) -> String {
    let hello =
        "printf 'hairline-kernel 1\\nname sh\\nscalars f64\\ncontract closed-ray\\nready\\n'";
    // The quotes are the ones that Program::parse takes away.
    format!(
        "sh -c '{}'",
        format!("{hello}; {body}").replace('\'', "'\\''")
    )
}

pub const MISSES: &str = "while read -r word id rest; do case $word in case) echo $id miss;; end) echo end $id;; esac; done";

#[test]
fn a_kernel_in_a_shell_is_audited_over_its_pipe() {
    let misses = shell(MISSES);
    let (record, _) = record(&[&["--kernel-cmd", &misses][..], &FLAGS].concat());
    assert_eq!(count(&record, "false_misses/count"), COUNT);
    let selector = &record["result"]["plan"]["rows"][0]["selector"];
    let line = format!("--kernel-cmd '{}'", misses.replace('\'', "'\\''"));
    assert_eq!(selector, &Value::from(line));
}

#[test]
fn a_campaign_on_a_command_goes_on_and_its_finds_are_told_again() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("campaign-on-a-command");
    let _ = fs::remove_dir_all(&folder);
    let folder = folder.to_str().unwrap();
    let misses = shell(MISSES);
    let fuzz = |flags: &[&str]| {
        let output = hairline(&[&["fuzz", folder, "--evaluations", "3000", "-q"], flags].concat());
        assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
        fs::read_to_string(format!("{folder}/finds.jsonl")).unwrap()
    };
    let begun = fuzz(&["--kernel-cmd", &misses]);
    assert!(begun.contains("\"kernel\":\"sh\""), "{begun}");
    // The campaign knows its kernel, and does not start it because a directory says so.
    let unasked = refused(&["fuzz", folder, "--evaluations", "3000", "-q"], 2);
    assert!(
        unasked.contains("to run it, name it again: hairline fuzz "),
        "{unasked}"
    );
    let other = refused(&["fuzz", folder, "-q", "--kernel-cmd", "true"], 65);
    assert!(other.contains("true: before its hello"), "{other}");
    // Every find is of a kind of its own.
    let more = fuzz(&["--kernel-cmd", &misses]);
    assert!(more.starts_with(&begun), "{more}");
    let kind = |line: &str| {
        let find: Value = serde_json::from_str(line).unwrap();
        find["found"]["signature"].to_string()
    };
    let mut kinds: Vec<String> = more.lines().map(kind).collect();
    kinds.sort();
    kinds.dedup();
    assert_eq!(kinds.len(), more.lines().count());
    let first: Value = serde_json::from_str(begun.lines().next().unwrap()).unwrap();
    let name = first["name"].as_str().unwrap();
    let corpus = format!("{folder}/finds.jsonl");
    let shown = hairline(&[
        "explain",
        name,
        "--corpus",
        &corpus,
        "--kernel-cmd",
        &misses,
    ]);
    assert!(
        text(&shown.stdout).contains("sh (own): miss;"),
        "{}",
        text(&shown.stdout)
    );

    let twice = refused(
        &[
            "list",
            "kernels",
            "--kernel-cmd",
            &misses,
            "--kernel-cmd",
            &misses,
        ],
        2,
    );
    assert!(twice.contains("is given twice"), "{twice}");
}

#[test]
fn a_campaign_goes_on_however_often_a_kernel_crashes() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("campaign-of-crashes");
    let _ = fs::remove_dir_all(&folder);
    let flags = [
        "fuzz",
        folder.to_str().unwrap(),
        "-n",
        "200",
        "-q",
        "--kernel-cmd",
    ];
    let output = hairline(&[&flags[..], &[&shell("read line; exit 3")]].concat());
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    let finds = fs::read_to_string(folder.join("finds.jsonl")).unwrap();
    assert!(finds.contains("crash"), "{finds}");
}

#[test]
fn a_command_that_is_no_kernel_is_refused_with_what_was_found_and_expected() {
    let cases: &[(&str, i32, &str)] = &[
        (
            "no-such-program-anywhere",
            74,
            "no-such-program-anywhere: it cannot be started: ",
        ),
        (
            "sh -c 'x",
            2,
            "--kernel-cmd 'sh -c 'x': a quotation mark or a backslash in it is not closed",
        ),
        (
            "true",
            65,
            "true: before its hello was over it ended its process with exit code 0",
        ),
        ("false", 65, "exit code 1"),
        (
            "sh -c 'kill -9 $$'",
            65,
            "before its hello was over it died of signal 9 (SIGKILL)",
        ),
        (
            "echo hello",
            65,
            "its first line is 'hello', expected 'hairline-kernel 1'",
        ),
        (
            "echo hairline-kernel 2",
            65,
            "it speaks protocol '2', this program speaks 1",
        ),
        (
            "echo error no three here",
            65,
            "echo error no three here: no three here",
        ),
        (
            "sleep 100",
            65,
            "before its hello was over it was silent for 1.5 s after its start",
        ),
        (
            "sh -c 'head -c 100000 /dev/zero; sleep 100'",
            65,
            "more than 65536 bytes without a newline",
        ),
    ];
    let start = Instant::now();
    for (command, code, message) in cases {
        let limits = ["--kernel-start", "1.5", "--kernel-timeout", "1.5"];
        let flags = [&["audit"][..], &limits, &["--kernel-cmd", command]].concat();
        let error = refused(&[&flags[..], &FLAGS].concat(), *code);
        assert!(error.contains(message), "{command}: {error}");
    }
    assert!(start.elapsed() < Duration::from_secs(30));
    let taken = shell(MISSES).replace("name sh", "name cramer");
    let error = refused(&["list", "kernels", "--kernel-cmd", &taken], 65);
    assert!(
        error.contains("there are two kernels of the name 'cramer'"),
        "{error}"
    );
}

#[test]
fn answers_that_are_none_end_the_run_and_never_hang_it() {
    for (body, message) in [
        (
            "read -r line; echo hello world",
            "expected 'ID miss', 'ID hit ",
        ),
        (
            "read -r line; echo 7 miss",
            "expected the verdict on case 0 of ",
        ),
        (
            "while read -r word id rest; do case $word in end) echo 0 miss; echo end $id;; esac; done",
            "expected the verdict on case 1 of ",
        ),
        (
            "while read -r word id rest; do case $word in case) echo $id miss;; end) echo end 3;; esac; done",
            "verdicts expected 'end ",
        ),
        (
            "while read -r word id rest; do case $word in case) echo $id miss;; end) echo end $id; echo more;; esac; done",
            "more",
        ),
        (
            "printf '\\377\\n'; cat >/dev/null",
            "it wrote a line that is not UTF-8",
        ),
        (
            "read -r line; echo HLA1",
            "it answers in the binary encoding",
        ),
        (
            "read -r line; echo 0 miss; echo end 1 took=soon",
            "expected 'ID miss', 'ID hit ",
        ),
    ] {
        let command = shell(body);
        let mut more = vec![
            "audit",
            "--kernel-timeout",
            "3",
            "--kernel-cmd",
            &command,
            "--threads",
            "1",
        ];
        more.extend(FLAGS);
        let output = hairline(&more);
        let error = text(&output.stderr);
        // What came too late to be seen after one batch is seen in the next.
        assert_eq!(output.status.code(), Some(65), "{body}: {error}");
        assert!(
            error.contains("hairline: kernel 'sh': ") && error.contains(message),
            "{body}: {error}"
        );
    }
}

#[test]
fn a_command_that_ends_after_each_batch_hears_that_it_should_read_on() {
    let once = shell(&MISSES.replace("echo end $id;;", "echo end $id; exit 0;;"));
    let plan = [
        "audit",
        "--family",
        "interior",
        "--scalar",
        "f64",
        "-n",
        "3000",
        "--kernel-cmd",
    ];
    let file = Path::new(env!("CARGO_TARGET_TMPDIR")).join("once.xml");
    let outputs = [
        &once,
        "--format",
        "text,junit",
        "-o",
        "-",
        "-o",
        file.to_str().unwrap(),
    ];
    fs::write(&file, "of an older run").unwrap();
    let error = refused(&[&plan[..], &outputs].concat(), 65);
    let told = fs::read_to_string(&file).unwrap();
    assert!(
        told.contains("<error type=\"exit 65\" message=\"kernel"),
        "{told}"
    );
    assert!(
        error.contains("it answers a batch and ends with exit code 0: a kernel reads on"),
        "{error}"
    );
    // Who ends on some case is no such command.
    let dies = shell(&MISSES.replace(
        "case) echo $id miss;;",
        "case) case $rest in *7777*) exit 0;; esac; echo $id miss;;",
    ));
    let (record, _) = record(&[&plan[1..], &[&dies]].concat());
    assert!(1 < count(&record, "crashes"), "{record}");
}

#[test]
fn a_command_that_dies_on_all_cases_is_given_up_and_says_why_once() {
    let dies = shell(&MISSES.replace(
        "case) echo $id miss;;",
        "case) echo no such thing >&2; exit 3;;",
    ));
    let plan = [
        "audit",
        "--family",
        "interior",
        "--scalar",
        "f64",
        "-n",
        "300",
        "--kernel-cmd",
    ];
    let output = hairline(&[&plan[..], &[&dies]].concat());
    let error = text(&output.stderr);
    assert_eq!(output.status.code(), Some(65), "{error}");
    assert_eq!(error.matches("no such thing\n").count(), 1, "{error}");
    assert!(
        error.contains("it failed on each of its first 100 cases"),
        "{error}"
    );
    // A limit that is set is meant.
    let limit = ["-n", "150", "--kernel-failures", "1000"];
    let plan = [&plan[1..5], &limit, &plan[7..], &[&dies]].concat();
    assert_eq!(count(&record(&plan).0, "crashes"), 150);
}

#[test]
fn a_command_that_dies_or_is_silent_on_a_case_is_a_finding() {
    // Every case whose origin's first number has a 77 in it; the same in Rust.
    let interior = family::find("interior").unwrap();
    const FEW: u64 = 200; // a shell reads byte by byte
    let unlucky = (0..FEW).filter(|index| {
        let made = interior.make::<f64>(&Parameters::default(), 1, *index);
        let line = hairline::internals::plugin::text::case_line(0, &made.cases()[0].numbers());
        line.split(' ').nth(3).unwrap().contains("77")
    });
    let unlucky = unlucky.count() as u64;
    assert!((2..50).contains(&unlucky), "{unlucky}");
    for (what, field) in [("exit 3", "crashes"), ("kill -9 $$", "crashes")] {
        let body = format!(
            "while read -r word id scalar x rest; do case $word in end) echo end $id;; case) case $x in *77*) {what};; esac; echo $id miss;; esac; done"
        );
        let command = shell(&body);
        let few = [
            "--family",
            "interior",
            "--scalar",
            "f64",
            "-n",
            "200",
            "--kernel-cmd",
            &command,
        ];
        let (record, _) = record(&few);
        assert_eq!(count(&record, field), unlucky, "{what}");
        assert_eq!(
            count(&record, "false_misses/count"),
            FEW - unlucky,
            "{what}"
        );
    }
    let silent =
        shell("while read -r word id rest; do case $word in end) echo end $id;; esac; done");
    let flags = [
        "explain",
        "interior@2/f64/-/1/3",
        "--kernel-timeout",
        "1",
        "--kernel-cmd",
    ];
    let error = refused_after_output(&[&flags[..], &[&silent]].concat());
    assert!(
        error.contains("expected the verdict on case 0 of 1, found 'end 1'"),
        "{error}"
    );
    // Killed with what it started: `sleep` would hold this test's pipes.
    let start = Instant::now();
    let deaf = shell("sleep 100; echo");
    let shown = text(&hairline(&[&flags[..], &[&deaf]].concat()).stdout);
    assert!(
        flat(&shown).contains("sh (own): gave no answer in time; its contract asks a hit: TIMEOUT"),
        "{shown}"
    );
    assert!(start.elapsed() < Duration::from_secs(50));
}

#[test]
fn a_kernel_that_says_how_long_it_took_is_believed() {
    // 7 ns a case, whatever it really is.
    let seven = MISSES.replace("echo end $id", "echo end $id took=$((7 * id))");
    let command = shell(&seven);
    let (record, _) = record(&[&["--kernel-cmd", &command][..], &FLAGS].concat());
    let times = record
        .pointer("/provenance/kernel_nanoseconds/f64")
        .unwrap();
    assert_eq!(times, &serde_json::json!({ "sh (own)": 7.0 }));
    assert_eq!(count(&record, "false_misses/count"), COUNT);
}

#[test]
fn an_encoding_that_was_not_announced_is_explained() {
    let text_in_binary = shell(MISSES).replace("ready", "encoding binary\\nready");
    let talks = text_in_binary.replace("while read", "echo 0 miss; echo 1 miss; while read");
    let error = refused(
        &[&["audit", "--kernel-cmd", &talks][..], &FLAGS].concat(),
        65,
    );
    assert!(
        error.contains("its hello says 'encoding binary', and it answers in text"),
        "{error}"
    );
    // Who never answers is not asked a thousand times.
    let start = Instant::now();
    let flags = ["audit", "--kernel-timeout", "0.3", "--kernel-cmd"];
    let deaf = shell("cat >/dev/null");
    let error = refused(&[&flags[..], &[&deaf], &FLAGS].concat(), 65);
    // The other thread may be waiting for a fourth.
    let told = |n: u64| {
        error.contains(&format!(
            "it has answered none of {n} cases, each within 0.3 s: "
        ))
    };
    assert!(told(3) || told(4), "{error}");
    assert!(start.elapsed() < Duration::from_secs(30));
}

/// What a command that prints before it fails says on standard error; exit code 65.
fn refused_after_output(arguments: &[&str]) -> String {
    let output = hairline(arguments);
    assert_eq!(output.status.code(), Some(65), "{}", text(&output.stderr));
    text(&output.stderr)
}

#[test]
fn the_example_in_python_is_the_same_over_the_pipe_and_from_a_file() {
    if !has("python3") {
        return;
    }
    let kernel = format!("python3 {HERE}/examples/python/moller_trumbore.py");
    let flags = [
        "--family",
        "edge-near,fan,invalid,lattice",
        "-n",
        "1100",
        "--scalar",
        "f64",
    ];
    let (piped, _) = record(&[&["--kernel-cmd", &kernel][..], &flags].concat());
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("replayed");
    std::fs::create_dir_all(&folder).unwrap();
    let [cases, verdicts] = ["cases.txt", "verdicts.txt"].map(|name| folder.join(name));
    let [cases, verdicts] = [cases.to_str().unwrap(), verdicts.to_str().unwrap()];
    let made = hairline(&[&["generate", "-o", cases][..], &flags].concat());
    assert_eq!(made.status.code(), Some(0), "{}", text(&made.stderr));
    let answered = format!("{kernel} < '{cases}' > '{verdicts}'");
    assert!(
        Command::new("bash")
            .args(["-c", &answered])
            .status()
            .unwrap()
            .success()
    );
    let replay = format!("python3 {HERE}/examples/python/replay.py '{cases}' '{verdicts}'");
    let (replayed, _) = record(&[&["--kernel-cmd", &replay][..], &flags].concat());
    let totals = |record: &Value| -> Vec<(Value, Value, Value)> {
        let results = record["result"]["results"].as_array().unwrap().iter();
        results
            .map(|r| {
                (
                    r["family"].clone(),
                    r["classes"].clone(),
                    r["across"].clone(),
                )
            })
            .collect()
    };
    assert_eq!(totals(&piped), totals(&replayed));
    assert_eq!(piped["result"]["sources"], replayed["result"]["sources"]);
    // A case without a verdict is an error, and so are verdicts in another order.
    let more = [
        "audit",
        "--family",
        "edge-near",
        "-n",
        "1101",
        "--scalar",
        "f64",
    ];
    let error = refused_after_output(&[&more[..], &["--kernel-cmd", &replay]].concat());
    assert!(error.contains("has no verdict"), "{error}");
    let mut lines: Vec<String> = std::fs::read_to_string(verdicts)
        .unwrap()
        .lines()
        .map(str::to_owned)
        .collect();
    let last = lines.len() - 2;
    lines.swap(last, last - 1);
    std::fs::write(verdicts, lines.join("\n")).unwrap();
    let error = refused_after_output(&[&more[..], &["--kernel-cmd", &replay]].concat());
    assert!(
        error.contains("replay.py: found the verdict on "),
        "{error}"
    );
    // An epsilon on the command line reaches a kernel over the pipe: no determinant is that large.
    let flags = [
        "--epsilon",
        "parallel=1e30",
        "--family",
        "interior",
        "-n",
        "50",
    ];
    let (tight, _) = record(&[&["--kernel-cmd", &kernel][..], &flags].concat());
    assert_eq!(count(&tight, "false_misses/count"), 50);
}

#[test]
fn a_kernel_may_speak_binary() {
    if !has("python3") {
        return;
    }
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("binary");
    fs::create_dir_all(&folder).unwrap();
    let script = folder.join("kernel.py");
    // Hits where t_max is infinite and the first coordinate is positive; t is the epsilon.
    fs::write(
        &script,
        r#"
import struct, sys
sys.stdout.write("hairline-kernel 1\nname binary\nscalars f32 f64\ncontract closed-ray\ngives t facing\n"
                 "epsilon t 0.5 1 -1 signed\nencoding binary\nready\n")
sys.stdout.flush()
read, write = sys.stdin.buffer, sys.stdout.buffer
while head := read.read(16):
    magic, bits, count, epsilons = struct.unpack("<4sIII", head)
    assert magic == b"HLB1"
    real = {32: "f", 64: "d"}[bits]
    size = bits // 8
    epsilon, = struct.unpack(f"<{real}", read.read(epsilons * size))
    write.write(struct.pack("<4sI", b"HLA1", count))
    for _ in range(count):
        case = struct.unpack(f"<17{real}", read.read(17 * size))
        hit = case[0] > 0 and case[16] == float("inf")
        write.write(struct.pack(f"<ii3{real}", hit, 1, epsilon, 0, 0))
    write.flush()
"#,
    )
    .unwrap();
    let kernel = format!("python3 '{}'", script.display());
    let flags = ["--family", "interior", "-n", "600", "--kernel-cmd", &kernel];
    let (record, _) = record(&flags);
    let interior = family::find("interior").unwrap();
    let positive = |index: &u64| {
        let case = interior
            .make::<f32>(&Parameters::default(), 1, *index)
            .cases()[0];
        case.vectors()[0][0] > 0.0 && case.ray.t_max == f32::INFINITY
    };
    assert_eq!(
        count(&record, "hits"),
        (0..600).filter(positive).count() as u64
    );
    let flags = [
        "explain",
        "interior@2/f32/-/1/0",
        "--epsilon",
        "t=0.25",
        "--kernel-cmd",
        &kernel,
    ];
    let mut shown = text(&hairline(&flags).stdout);
    if !positive(&0) {
        let index = (0..600).find(positive).unwrap();
        let id = format!("interior@2/f32/-/1/{index}");
        shown = text(&hairline(&[&["explain", &id][..], &flags[2..]].concat()).stdout);
    }
    assert!(shown.contains("binary (t=0.25): hit;"), "{shown}");
    assert!(shown.contains("reports t = 0.25, facing front"), "{shown}");
}

/// A kernel's own right answers, and what it is wrong in: t, u, v, the side, or which call it answers.
#[test]
fn ten_ways_to_be_wrong_are_noticed_by_check() {
    let wrong = |fault: u32| {
        let source = PathBuf::from(HERE).join("tests/kernels/wrong.c");
        library(
            &source,
            &format!("wrong-{fault}"),
            &[&format!("-DFAULT={fault}")],
        )
    };
    let Some(right) = wrong(0) else { return };
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("ten-wrong");
    fs::create_dir_all(&folder).unwrap();
    let known = folder.join("known.toml").to_str().unwrap().to_owned();
    let check = |library: &str, more: &[&str]| {
        let flags = [
            "check",
            "-n",
            "80",
            "--expectations",
            &known,
            "--kernel-lib",
            library,
        ];
        let output = hairline(&[&flags[..], more].concat());
        (
            output.status.code(),
            text(&output.stdout) + &text(&output.stderr),
        )
    };
    for left in [known.clone(), format!("{known}.lock")] {
        let _ = fs::remove_file(left);
    }
    let (code, report) = check(&right, &["--bless"]);
    assert_eq!(code, Some(0), "{report}");
    assert_eq!(check(&right, &[]).0, Some(0));
    for (fault, finding) in [
        (1, "wrong-value"),
        (2, "wrong-value"),
        (3, "wrong-value"),
        (4, "wrong-value"),
        (5, "bad-value"),
        (6, "wrong-value"),
        (7, "bad-value"),
        (8, "false-hit"),
        (9, "false-hit"),
        (10, "wrong-value"),
    ] {
        let library = wrong(fault).unwrap();
        let (code, report) = check(&library, &[]);
        assert_eq!(code, Some(1), "{fault}: {report}");
        assert!(report.contains(finding), "{fault}: {report}");
    }
    // No epsilon and no offset is advised where plain hits have wrong values.
    let library = wrong(1).unwrap();
    for command in [&["epsilon", "--scene", "room"][..], &["offset"]] {
        let flags = [
            command,
            &["-n", "100", "--scalar", "f64", "--kernel-lib", &library],
        ]
        .concat();
        let error = refused(&flags, 1);
        assert!(error.contains("1024 of 1024 plain hits in f64"), "{error}");
        assert!(
            error.contains("; `hairline audit --kernel-lib '"),
            "{error}"
        );
    }
    // A kernel that hits beside the triangle too: the scene's own rays do not show it.
    let library = wrong(8).unwrap();
    let flags = [
        "offset",
        "-n",
        "300",
        "--scalar",
        "f64",
        "--point",
        "uv",
        "--kernel-lib",
        &library,
    ];
    let screen = text(&hairline(&flags).stdout);
    assert!(
        screen.contains("if the kernel lets no other weights through"),
        "{screen}"
    );
}
