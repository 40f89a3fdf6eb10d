//! More than eighty kernels that are wrong in one thing, of which none passes the default plan, nor the plan that
//! docs/guide/own-kernel.md recommends for CI; and the same kernel without a fault, which passes both.

#![cfg(unix)]

use crate::plugin::library;
use std::path::PathBuf;
use std::process::Command;

const HERE: &str = env!("CARGO_MANIFEST_DIR");

/// Cases of each family and stratum: few, so that a hundred runs take a minute. Whatever is found with them is found with
/// the 20,000 that are usual.
const FEW: &str = "300";

/// The fault that takes more cases than the plan of a test has: it shows in the usual plan.
const LATE: &str = "wrong after 2^24 calls";

/// The faults of tests/kernels/wrong_kernels.cpp, by name.
fn faults() -> Vec<String> {
    let source =
        std::fs::read_to_string(format!("{HERE}/tests/kernels/wrong_kernels.cpp")).unwrap();
    let (_, table) = source.split_once("const Fault FAULTS[] = {").unwrap();
    let (table, _) = table.split_once("\n};").unwrap();
    let names = table.split("{\"").skip(1).map(|row| row.split('"').next().unwrap().to_owned());
    names.collect()
}

/// The exit code and the screen of an audit of the kernel with a fault.
fn audit(library: &str, fault: &str, plan: &[&str]) -> (Option<i32>, String) {
    let flags = ["audit", "-q", "-n", FEW, "--kernel-lib", library];
    let output = Command::new(env!("CARGO_BIN_EXE_hairline"))
        .args(flags)
        .args(plan)
        .env("WRONG_KERNEL", fault)
        .output()
        .unwrap();
    let screen = String::from_utf8_lossy(&output.stdout).into_owned();
    (output.status.code(), screen + &String::from_utf8_lossy(&output.stderr))
}

/// The plan that own-kernel.md recommends: the families and a scene.
const RECOMMENDED: [&str; 4] = ["--scene", "room", "--family", "all"];

#[test]
fn every_wrong_kernel_fails_the_default_plan_and_the_recommended_one() {
    let source = PathBuf::from(HERE).join("tests/kernels/wrong_kernels.cpp");
    let flags = ["-xc++", "-std=c++17", "-O2", "-Wall", "-Wextra", "-Werror"];
    let Some(library) = library(&source, "wrong-kernels", &flags) else { return };
    let faults = faults();
    assert!(80 < faults.len(), "{}", faults.len());
    for plan in [&[][..], &RECOMMENDED] {
        let (code, screen) = audit(&library, "", plan);
        assert_eq!(code, Some(0), "{plan:?}: {screen}");
        let passes =
            |fault: &&String| fault.as_str() != LATE && audit(&library, fault, plan).0 != Some(1);
        let passed: Vec<&String> = faults.iter().filter(passes).collect();
        assert_eq!(passed, [""; 0], "{plan:?}");
    }
}
