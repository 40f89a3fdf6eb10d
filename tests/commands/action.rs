//! The action of action.yml as GitHub runs it: its script, its report, and a year of a project with it.

use crate::program;
use crate::tools::not_tested;

use program::{ends_flat as ends, hairline, hairline_with, scratch};
use serde_json::Value;
use std::fs;
use std::path::Path;
use std::process::Command;

/// The script of the action's step that checks.
fn script_of_the_action() -> String {
    let action = fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/action.yml")).unwrap();
    let step = action.split("      id: check\n").nth(1).unwrap();
    let script = step.split("      run: |\n").nth(1).unwrap();
    let lines = script
        .lines()
        .take_while(|line| line.starts_with("        "));
    lines.map(|line| format!("{}\n", &line[8..])).collect()
}

/// What the action came to.
struct Ran {
    code: i32,
    /// What the log shows.
    text: String,
    error: String,
    /// The record in the report that is kept; null if there is none.
    record: Value,
}

impl Ran {
    /// The kernels of the record.
    fn kernels(&self) -> Vec<&str> {
        let rows = self.record["result"]["plan"]["rows"].as_array();
        rows.map_or(Vec::new(), |rows| {
            rows.iter()
                .map(|row| row["kernel"].as_str().unwrap())
                .collect()
        })
    }

    /// The unexpected disagreements.
    fn unexpected(&self) -> &[Value] {
        self.record["conformance"]["unexpected"].as_array().unwrap()
    }
}

/// Runs the script as GitHub does; none if there is no bash.
fn run_action(folder: &Path, arguments: &str) -> Option<Ran> {
    let temporary = folder.join("runner");
    let _ = fs::remove_dir_all(&temporary);
    fs::create_dir_all(temporary.join("hairline/bin")).unwrap();
    let program = temporary.join("hairline/bin/hairline");
    std::os::unix::fs::symlink(env!("CARGO_BIN_EXE_hairline"), program).unwrap();
    let output = Command::new("bash")
        .args([
            "--noprofile",
            "--norc",
            "-eo",
            "pipefail",
            "-c",
            &script_of_the_action(),
        ])
        .current_dir(folder)
        .env("ARGUMENTS", arguments)
        .env("RUNNER_TEMP", &temporary)
        .env("GITHUB_OUTPUT", temporary.join("output"))
        .env_remove("GITHUB_ACTIONS")
        .env_remove("GITHUB_STEP_SUMMARY")
        .output();
    let Ok(output) = output else {
        not_tested("there is no 'bash' on this machine");
        return None;
    };
    let code = output.status.code().unwrap();
    let record = match fs::read(temporary.join("hairline-report/check.json")) {
        Ok(bytes) => serde_json::from_slice(&bytes).unwrap(),
        Err(_) => Value::Null,
    };
    if !record.is_null() {
        let said = fs::read_to_string(temporary.join("output")).unwrap();
        assert_eq!(said, format!("exit-code={code}\n"));
    }
    let [text, error] =
        [output.stdout, output.stderr].map(|bytes| String::from_utf8(bytes).unwrap());
    Some(Ran {
        code,
        text,
        error,
        record,
    })
}

#[test]
fn the_action_takes_a_command_with_spaces_or_all_from_the_file() {
    let folder = scratch("check-action");
    let misses = "printf 'hairline-kernel 1\\nname never\\nscalars f64\\ncontract closed-ray\\nready\\n'\n\
                  while read -r word id rest; do\n\
                  case $word in case) echo $id miss;; end) echo end $id;; esac\ndone\n";
    fs::write(folder.join("never.sh"), misses).unwrap();
    let settings = "family = \"interior\"\nscalar = \"f64\"\ncount = 50\n";
    fs::write(folder.join("hairline.toml"), settings).unwrap();
    let ends_with = |arguments: &str, code: i32, kernels: &[&str]| {
        let Some(ran) = run_action(&folder, arguments) else {
            return;
        };
        assert_eq!((ran.code, ran.kernels()), (code, kernels.to_vec()));
    };
    ends_with("--kernel-cmd 'sh never.sh' --seed 7", 1, &["never"]);
    // Words that are none are wrong usage, and no disagreement.
    ends_with("--kernel-cmd \"sh never.sh", 2, &[]);
    // All from the file, before and after what is known is written down.
    let all = format!("{settings}kernel-cmd = \"sh never.sh\"\n");
    fs::write(folder.join("hairline.toml"), all).unwrap();
    ends_with("", 1, &["never"]);
    ends(&folder, &["check", "--bless", "--quiet"], 0);
    ends_with("", 0, &["never"]);
    let output = hairline_with(&folder, &["check"], &[("HAIRLINE_CUONT", "9")]);
    let error = String::from_utf8(output.stderr).unwrap();
    assert!(error.starts_with("note: HAIRLINE_CUONT is no setting, and is not used; did you mean"));
}

/// Builds the kernel as the project's library, and as one that stays; says whether there is a compiler.
fn build(folder: &Path, name: &str, flags: &[&str]) -> bool {
    let here = env!("CARGO_MANIFEST_DIR");
    let library = folder.join(format!("lib{name}.so"));
    let built = Command::new("cc")
        .args([
            "-O2",
            "-shared",
            "-fPIC",
            &format!("-I{here}/include"),
            "-o",
        ])
        .args([
            library.as_os_str(),
            format!("{here}/tests/kernels/year.c").as_ref(),
        ])
        .args(flags)
        .arg("-lm")
        .output();
    let Ok(built) = built else {
        not_tested("there is no 'cc' on this machine");
        return false;
    };
    assert!(
        built.status.success(),
        "{}",
        String::from_utf8_lossy(&built.stderr)
    );
    fs::copy(library, folder.join("libmine.so")).unwrap();
    true
}

/// Whether a kernel shows a finding on a case.
fn shows(folder: &Path, library: &str, case: &str, finding: &str) -> bool {
    let library = folder.join(format!("lib{library}.so"));
    let output = hairline(
        folder,
        &["explain", case, "--kernel-lib", library.to_str().unwrap()],
    );
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(
        output.status.success() && text.contains("mine (own)"),
        "{text}"
    );
    text.contains(&format!(": {}\n", finding.to_uppercase()))
}

/// The cases that are shown as new: each passes under the old kernel and fails under the new one.
fn witnesses(folder: &Path, ran: &Ran, old: &str, new: &str) -> usize {
    let shown = ran.unexpected().iter().filter(|found| {
        let expected = found["expected"].as_str().unwrap();
        expected == "none" || expected.ends_with("; the case shown is new")
    });
    let check = |found: &Value| {
        let [case, finding] = ["case", "finding"].map(|name| found[name].as_str().unwrap());
        assert!(found["command"].as_str().unwrap().contains(case), "{found}");
        assert!(shows(folder, new, case, finding), "{found}");
        assert!(!shows(folder, old, case, finding), "{found}");
    };
    shown.map(check).count()
}

#[test]
fn a_year_of_a_kernel_in_c() {
    const OFF: &str = "-ffp-contract=off";
    let folder = scratch("year");
    let settings = "kernel-lib = \"libmine.so\"\nscalar = \"f32\"\ncount = 2_000\n\
                    family = [\"interior\", \"edge-near\", \"edge-exact\", \"tiny\", \"sliver\", \"fan\"]\n";
    fs::write(folder.join("hairline.toml"), settings).unwrap();
    if !build(&folder, "first", &[OFF]) {
        return;
    }
    let Some(ran) = run_action(&folder, "") else {
        return;
    };

    // It is adopted: red as long as nothing is written down, then green, and a person can read why.
    assert_eq!((ran.code, ran.kernels()), (1, vec!["mine"]));
    ends(&folder, &["check", "--bless", "--quiet"], 0);
    let of = |file: &str| fs::read_to_string(folder.join(file)).unwrap();
    let reviewed = of("hairline.expectations.toml");
    assert!(reviewed.lines().count() <= 20, "{reviewed}");
    assert!(of("hairline.expectations.toml.lock").len() < 30_000);
    let action = |code: i32| {
        let ran = run_action(&folder, "").unwrap();
        assert_eq!(ran.code, code, "{}\n{}", ran.text, ran.error);
        ran
    };
    assert!(action(0).text.starts_with("Conforms: "));

    // A harmless refactoring: the same arithmetic in other words.
    build(&folder, "refactored", &[OFF, "-DREFACTORED", "-O3"]);
    action(0);

    // Another compiler, which fuses multiplications and additions.
    let fused = if cfg!(target_arch = "x86_64") {
        &["-mfma"][..]
    } else {
        &[]
    };
    build(&folder, "fused", &[fused, &["-ffp-contract=fast"]].concat());
    if cfg!(not(target_arch = "x86_64")) || std::arch::is_x86_feature_detected!("fma") {
        let ran = action(1);
        let change = &ran.record["conformance"]["change"];
        let of = |name: &str| change[name].as_u64().unwrap();
        assert!(0 < of("better") && 0 < of("worse"), "{change}");
        let starts = ran.text.starts_with("Mixed: mine, ");
        assert!(
            starts && ran.text.contains("\nWhat to do\n"),
            "{}",
            ran.text
        );
        let shown = witnesses(&folder, &ran, "first", "fused");
        assert!(
            ran.unexpected().len() * 3 / 4 <= shown,
            "{shown} of {}",
            ran.unexpected().len()
        );
        let (_, error) = ends(&folder, &["check", "--bless", "--quiet"], 1);
        assert!(
            error.contains(" stays as it is: ") && error.contains(" better, "),
            "{error}"
        );
    }

    // A worse epsilon: every disagreement shows a case that passed until now, but for one of 14 cases instead of 13.
    build(&folder, "worse", &[OFF, "-DEPSILON=\"1e-5\""]);
    let ran = action(1);
    assert!(
        ran.text
            .contains("; the case shown is new\n    hairline explain '"),
        "{}",
        ran.text
    );
    let shown = witnesses(&folder, &ran, "first", "worse");
    assert!(ran.unexpected().len() <= shown + 1, "{shown}: {}", ran.text);
    let set = "\nmine (own): its epsilon parallel is now 1e-5; blessed with 1e-7\n";
    assert!(ran.text.contains(set), "{}", ran.text);

    // Its record, which CI keeps, is judged in the same way on a machine without the library.
    fs::rename(folder.join("hairline.toml"), folder.join("kept.toml")).unwrap();
    let (out, _) = program::ends(
        &folder,
        &[
            "check",
            "-q",
            "--record",
            "runner/hairline-report/check.json",
        ],
        1,
    );
    assert_eq!(out, ran.text);
    fs::rename(folder.join("kept.toml"), folder.join("hairline.toml")).unwrap();

    // A better kernel: what was expected is stale, until it is written down.
    build(&folder, "better", &[OFF, "-DWIDE"]);
    // One class has as many cases as before, but not the same ones, which is a part of it.
    let ran = action(3);
    assert!(ran.text.starts_with("Better: mine, "), "{}", ran.text);
    let change = &ran.record["conformance"]["change"];
    assert_eq!(change["other_cases"], 1, "{change}");
    assert!(ran.unexpected().is_empty());
    ends(&folder, &["check", "--bless", "--quiet"], 0);
    assert!(of("hairline.expectations.toml").len() < reviewed.len());
    action(0);

    // A crash.
    build(&folder, "crash", &[OFF, "-DWIDE", "-DCRASH"]);
    let ran = action(1);
    let crash = ran
        .unexpected()
        .iter()
        .find(|found| found["finding"] == "crash")
        .unwrap();
    assert_eq!(crash["expected"], "none");
    assert!(shows(
        &folder,
        "crash",
        crash["case"].as_str().unwrap(),
        "crash"
    ));
}

#[test]
fn what_a_crash_kept_from_being_judged_is_new_once_it_is_repaired_and_said_to_be() {
    let folder = scratch("repaired");
    let settings = "kernel-lib = \"libmine.so\"\nscalar = \"f32\"\ncount = 5_000\n\
                    family = [\"interior\", \"edge-near\", \"tiny\", \"fan\"]\n";
    fs::write(folder.join("hairline.toml"), settings).unwrap();
    if !build(&folder, "crash", &["-ffp-contract=off", "-DCRASH"]) {
        return;
    }
    ends(&folder, &["check", "--bless", "--quiet"], 0);
    build(&folder, "repaired", &["-ffp-contract=off"]);
    let (out, _) = ends(&folder, &["check", "--quiet"], 1);
    let said = out
        .split_once("; before, the kernel crashed on ")
        .unwrap()
        .1;
    assert!(
        said.split_once(' ')
            .unwrap()
            .1
            .starts_with("cases that it answers now"),
        "{out}"
    );
    let (_, error) = ends(&folder, &["check", "--bless"], 1);
    assert!(
        error.contains(" where the kernel failed before); --accept-worse writes it"),
        "{error}"
    );
    ends(
        &folder,
        &["check", "--bless", "--accept-worse", "--quiet"],
        0,
    );
    ends(&folder, &["check", "--quiet"], 0);
}

#[test]
fn the_worst_is_told_first() {
    let folder = scratch("worst-first");
    let settings = "kernel-lib = \"libmine.so\"\nscalar = \"f32\"\ncount = 2_000\n\
                    family = [\"edge-near\", \"interior\", \"tiny\"]\n";
    fs::write(folder.join("hairline.toml"), settings).unwrap();
    if !build(&folder, "first", &["-ffp-contract=off"]) {
        return;
    }
    let found = |code: i32| {
        let words = ["check", "-q", "--format", "json"];
        let record: Value = serde_json::from_str(&ends(&folder, &words, code).0).unwrap();
        let unexpected = record["conformance"]["unexpected"]
            .as_array()
            .unwrap()
            .clone();
        let list = unexpected.iter().map(|found| {
            let count = found["found"]["count"].as_u64().unwrap();
            let expected = found["expected"]
                .as_str()
                .unwrap()
                .split(' ')
                .next()
                .unwrap();
            let more = count - expected.replace(',', "").parse::<u64>().unwrap_or(0);
            (found["finding"].as_str().unwrap() == "crash", more)
        });
        list.collect::<Vec<_>>()
    };
    ends(&folder, &["check", "--bless", "--quiet"], 0);
    build(
        &folder,
        "worse",
        &["-ffp-contract=off", "-DCRASH", "-DEPSILON=\"0.5\""],
    );
    // A crash weighs more than any number of wrong verdicts.
    let mut list = found(1);
    list.reverse();
    assert!(list.is_sorted(), "{list:?}");
    let crashes = list.iter().filter(|(is_crash, _)| *is_crash).count();
    assert!(1 < crashes && crashes + 1 < list.len(), "{list:?}");
    assert!(
        list[crashes..].iter().any(|(_, more)| list[0].1 < *more),
        "{list:?}"
    );
}

#[test]
fn a_class_that_is_gone_is_shown_with_the_new_library() {
    let folder = scratch("gone");
    for (name, flags) in [
        ("first", &["-DEPSILON=\"0.5\""][..]),
        ("better", &["-DWIDE"]),
    ] {
        if !build(&folder, name, flags) {
            return;
        }
        let library = format!("./lib{name}.so");
        let run = "audit -q --scalar f32 --family interior,edge-near -n 5000 --format json";
        let record = format!("{name}.json");
        let words = [
            &run.split(' ').collect::<Vec<_>>()[..],
            &["--kernel-lib", &library, "-o", &record],
        ];
        ends(&folder, &words.concat(), 0);
    }
    let (out, _) = program::ends(
        &folder,
        &["diff", "first.json", "better.json", "--details"],
        0,
    );
    let gone: Vec<&str> = out
        .lines()
        .skip_while(|line| !line.contains("interior: false-miss") || !line.contains(", 0 of"))
        .take(2)
        .collect();
    assert!(
        gone[1].contains("--kernel-lib './libbetter.so' --epsilon 'parallel=1e-7'"),
        "{out}"
    );
}
