//! A row (kernel, epsilons, contract, band, arithmetic) is the same in every command that is printed.

use super::program::{ends, scratch};
use std::fs;
use std::path::Path;
use std::process::Command;

/// Runs a printed command in a shell, as a user pastes it.
fn paste(folder: &Path, command: &str) -> String {
    let words = command.strip_prefix("hairline ").unwrap();
    let line = format!("'{}' {words}", env!("CARGO_BIN_EXE_hairline"));
    let output = Command::new("sh")
        .args(["-c", &line])
        .current_dir(folder)
        .output()
        .unwrap();
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(output.status.success(), "{command}\n{text}");
    text
}

/// The commands in a text, with what stands on the line before.
fn commands(text: &str) -> Vec<&str> {
    let trimmed = text.lines().map(str::trim);
    trimmed
        .filter(|line| line.starts_with("hairline explain "))
        .collect()
}

#[test]
fn commands_carry_the_contract_and_the_band_of_the_run() {
    let folder = scratch("rows-contract");
    let run = "audit --kernel moller-trumbore-culling --contract closed-ray --family shared-edge \
               --scalar f32 -n 3000 --quiet --details --band 1e-9";
    let (out, _) = ends(&folder, &run.split_whitespace().collect::<Vec<_>>(), 0);
    let commands = commands(&out);
    let mut lines = out
        .lines()
        .skip_while(|line| !line.contains("f32 crack in shared-edge: "));
    let crack = lines.find(|line| line.trim().starts_with("hairline explain "));
    let crack = crack.expect("a crack").trim();
    assert!(commands.contains(&crack), "{out}");
    for command in &commands {
        assert!(
            command.ends_with(" --contract closed-ray --band 1e-9"),
            "{command}"
        );
    }
    // Under the kernel's own contract, which counts the front only, nothing would be asked here.
    let shown = paste(&folder, crack);
    assert!(shown.contains("CRACK"), "{shown}");
    let bare = crack.replace(" --contract closed-ray --band 1e-9", "");
    assert_ne!(paste(&folder, &bare), shown);
}

#[test]
fn the_command_of_a_report_runs_the_same_plan_again() {
    let folder = scratch("rows-plan");
    let first = [
        "audit",
        "--kernel",
        "moller-trumbore,cramer",
        "--arithmetic",
        "ieee,fma",
        "--epsilon",
        "parallel=1e-9,edge=-1e-7",
        "--contract",
        "own,coplanar=free",
        "--band",
        "4ulps",
        "--family",
        "edge-near,lattice",
        "--scalar",
        "f32",
        "-n",
        "300",
        "--seed",
        "7",
        "--scale",
        "2^-3",
        "--offset",
        "1:0:-2",
        "--direction",
        "unit",
        "--quiet",
        "--format",
        "json,html",
        "-o",
        "first.json",
        "-o",
        "first.html",
    ];
    ends(&folder, &first, 0);
    let record = |file: &str| -> serde_json::Value {
        serde_json::from_slice(&fs::read(folder.join(file)).unwrap()).unwrap()
    };
    let old = record("first.json");
    let flags = &old["provenance"]["plan_flags"];
    let words = |part: &str| flags[part].as_str().unwrap().to_owned();
    let command = format!("hairline audit {} {}", words("kernels"), words("sources"));
    let html = fs::read_to_string(folder.join("first.html")).unwrap();
    assert!(html.contains(&command), "{command}");
    paste(
        &folder,
        &format!("{command} --quiet --format json -o again.json"),
    );
    let again = record("again.json");
    assert_eq!(
        old["result"]["plan"]["hash"],
        again["result"]["plan"]["hash"]
    );
    assert_eq!(old["result"]["results"], again["result"]["results"]);
    // A kernel's own command is its row of the plan.
    let row = "hairline audit --kernel cramer+fma --epsilon &#39;";
    let row = row.replace("&#39;", "'");
    assert!(html.contains(&row) && html.contains("--contract own,coplanar=free --band 4ulps"));
}

#[test]
fn a_contract_that_is_none_is_refused_with_what_there_is() {
    let folder = scratch("rows-bad");
    for (contract, expected) in [
        (
            "closed-rai",
            "'closed-rai' is no contract; did you mean 'closed-ray'?",
        ),
        ("strict", "'strict' is no contract: write closed-line, "),
        (
            "own,coplanar=perhaps",
            "'coplanar=perhaps': there are miss, hit, free",
        ),
        ("extent=ray", "'extent=ray' does not say sides=…"),
    ] {
        let (_, error) = ends(&folder, &["audit", "--contract", contract, "-n", "1"], 2);
        assert!(error.contains(expected), "{error}");
    }
}
