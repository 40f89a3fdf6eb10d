//! More than ninety kernels that are wrong in one thing: none passes the default plan, nor the plan that
//! docs/guide/own-kernel.md recommends for CI; the same kernel without a fault passes both.

#![cfg(unix)]

use crate::plugin::library;
use crate::program::scratch;
use rayon::prelude::*;
use std::path::{Path, PathBuf};
use std::process::Command;

const HERE: &str = env!("CARGO_MANIFEST_DIR");

/// Cases of each family and stratum: few, so that a hundred runs take half a minute. Whatever is found with them is found
/// with the 20,000 that are usual.
const FEW: &str = "100";

/// The fault that takes more calls than the plan of a test has.
const LATE: &str = "wrong after 2^24 calls";

/// The fault that is none in floats.
const NARROW: &str = "computed in float";

/// The faults of tests/kernels/wrong_kernels.cpp, by name.
fn faults() -> Vec<String> {
    let source =
        std::fs::read_to_string(format!("{HERE}/tests/kernels/wrong_kernels.cpp")).unwrap();
    let (_, table) = source.split_once("const Fault FAULTS[] = {").unwrap();
    let (table, _) = table.split_once("\n};").unwrap();
    let names = table
        .split("{\"")
        .skip(1)
        .map(|row| row.split('"').next().unwrap().to_owned());
    names.collect()
}

/// The exit code and the screen of a check of the kernel with a fault, where nothing is known yet. In floats: the values of
/// the right kernel are not correctly rounded in double (docs/guide/exact.md), so there its verdicts alone are right.
fn check(folder: &Path, library: &str, fault: &str, plan: &[&str]) -> (Option<i32>, String) {
    let scalar = if fault == NARROW { "f64" } else { "f32" };
    let flags = ["check", "-q", "--scalar", scalar, "--kernel-lib", library];
    let output = Command::new(env!("CARGO_BIN_EXE_hairline"))
        .args(flags)
        .args(plan)
        .env("WRONG_KERNEL", fault)
        .current_dir(folder)
        .output()
        .unwrap();
    let screen = String::from_utf8_lossy(&output.stdout).into_owned();
    (
        output.status.code(),
        screen + &String::from_utf8_lossy(&output.stderr),
    )
}

/// The plan that own-kernel.md recommends: all families, and a scene.
const RECOMMENDED: [&str; 6] = ["-n", FEW, "--scene", "room", "--family", "all"];

#[test]
fn every_wrong_kernel_fails_the_default_plan() {
    let source = PathBuf::from(HERE).join("tests/kernels/wrong_kernels.cpp");
    let flags = ["-xc++", "-std=c++17", "-O2", "-Wall", "-Wextra", "-Werror"];
    let Some(library) = library(&source, "wrong-kernels", &flags) else {
        return;
    };
    let folder = scratch("wrong-kernels");
    let faults = faults();
    assert!(80 < faults.len(), "{}", faults.len());
    let few = ["-n", FEW];
    let (code, screen) = check(&folder, &library, "", &few);
    assert_eq!(code, Some(0), "{screen}");
    let passes = |fault: &&String| {
        fault.as_str() != LATE && check(&folder, &library, fault, &few).0 != Some(1)
    };
    // This test is the last one, and would leave all cores but one without work.
    let passed: Vec<&String> = faults.par_iter().filter(passes).collect();
    assert_eq!(passed, [""; 0]);
    let (_, screen) = check(&folder, &library, NARROW, &few);
    assert!(screen.contains("false-miss"), "{screen}");
    // It takes a whole batch, as the usual plan has.
    let whole = ["-n", "1024", "--family", "interior"];
    assert_eq!(check(&folder, &library, "", &whole).0, Some(0));
    let (code, screen) = check(&folder, &library, LATE, &whole);
    assert_eq!(code, Some(1), "{screen}");
    // The recommended plan has the same families, with the same cases: some of the faults stand for all.
    let (code, screen) = check(&folder, &library, "", &RECOMMENDED);
    assert_eq!(code, Some(0), "{screen}");
    faults.par_iter().step_by(10).for_each(|fault| {
        let (code, screen) = check(&folder, &library, fault, &RECOMMENDED);
        assert_eq!(code, Some(1), "{fault}: {screen}");
    });
}
