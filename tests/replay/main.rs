//! Each fuzz target over its stored seeds and, where it reads files of the project, over these.

use std::env;
use std::path::{Path, PathBuf};
use std::process::Command;

/// A target's program. Cargo builds examples beside the folder of tests, and tells their paths to nobody.
fn program(target: &str) -> PathBuf {
    let test = env::current_exe().expect("a path");
    let built = test
        .parent()
        .and_then(Path::parent)
        .expect("target/PROFILE/deps");
    let program = built.join("examples").join(target);
    program.with_extension(env::consts::EXE_EXTENSION)
}

/// Replays files and folders of the project. A target that finds something, or no input, panics. Only `pinned` reads the
/// kernel's name.
fn replay(target: &str, files: &[&str]) {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let program = program(target);
    assert!(
        program.exists(),
        "{}: `cargo test -p hairline-replay` builds it",
        program.display()
    );
    let mut command = Command::new(program);
    command
        .args(files)
        .current_dir(root)
        .env("HAIRLINE_KERNEL", "woop-watertight");
    let output = command.output().expect("it runs");
    let [out, error] = [output.stdout, output.stderr].map(|text| String::from_utf8(text).unwrap());
    assert!(output.status.success(), "{target} {files:?}: {out}{error}");
}

macro_rules! targets {
    ($($name:ident: $($files:literal)+;)+) => {
        $(#[test]
        fn $name() {
            replay(stringify!($name), &[$($files),+]);
        })+

        const TARGETS: &[&str] = &[$(stringify!($name)),+];
    };
}

targets! {
    case_lines: "fuzz/seeds/case_lines" "corpora/curated.jsonl";
    kernels: "fuzz/seeds/cases";
    mesh: "fuzz/seeds/mesh" "corpora/meshes";
    oracle: "fuzz/seeds/cases";
    pinned: "fuzz/seeds/cases";
    response: "fuzz/seeds/cases";
    settings: "fuzz/seeds/settings" "hairline.toml" "tests/expectations.toml" "tests/expectations.toml.lock";
}

#[test]
fn cargo_fuzz_knows_the_same_targets() {
    let manifest = concat!(env!("CARGO_MANIFEST_DIR"), "/../../fuzz/Cargo.toml");
    let text = std::fs::read_to_string(manifest).unwrap();
    let paths = text
        .lines()
        .filter_map(|line| line.strip_prefix("path = \"fuzz_targets/"));
    let mut known: Vec<&str> = paths
        .filter_map(|path| path.strip_suffix(".rs\""))
        .collect();
    known.sort_unstable();
    assert_eq!(known, TARGETS);
}
