//! The tool on a package of a few lines, whose mutants are known to live or to die.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

const LIBRARY: &str = r#"//! A toy.

const BOUND: f64 = 1e-9;

pub fn larger(a: i32, b: i32) -> i32 {
    if a > b { a } else { b }
}

pub fn is_small(x: f64) -> bool {
    x.abs() < BOUND
}

pub fn count_down(mut n: u32) -> u32 {
    let mut steps = 0;
    while n > 0 {
        n -= 1;
        steps += 1;
    }
    steps
}

pub fn first(text: &str) -> Option<char> {
    let others: &'static [u32] = &[120, 0];
    if let Some(first) = text.chars().next()
        && u32::from(first) != others[0]
    {
        return Some(first);
    }
    None
}

pub fn forgotten() -> bool {
    true
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn larger_of_two() {
        assert_eq!([larger(1, 2), larger(2, 1), larger(3, 3)], [2, 2, 3]);
    }

    #[test]
    fn small_numbers() {
        assert!(is_small(0.0) && is_small(5e-10) && !is_small(-2e-9));
    }

    #[test]
    fn steps() {
        let mut child = std::process::Command::new("sleep").arg("86399").spawn().unwrap();
        assert_eq!(count_down(3), 3);
        child.kill().unwrap();
        child.wait().unwrap();
    }

    #[test]
    fn first_letters() {
        assert_eq!((first("ab"), first("xy"), first("")), (Some('a'), None, None));
    }

    #[test]
    fn that_fails() {
        panic!();
    }
}
"#;

const CONFIG: &str = r#"
tests = ["test", "--no-run", "--lib"]
slow = 20.0
[[module]]
name = "toy"
group = "toy"
files = ["src/"]
"#;

const EQUIVALENT: &str = r#"
[[equivalent]]
file = "src/lib.rs"
function = "larger"
change = "replace > with >="
source = "a > b"
reason = "Equal numbers are equally large."
"#;

/// A folder of its own with the toy in it.
fn toy(name: &str) -> PathBuf {
    let root = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = fs::remove_dir_all(&root);
    fs::create_dir_all(root.join("src")).unwrap();
    let manifest = "[package]\nname = \"toy\"\nedition = \"2024\"\n[workspace]\n";
    fs::write(root.join("Cargo.toml"), manifest).unwrap();
    fs::write(root.join("src/lib.rs"), LIBRARY).unwrap();
    fs::write(root.join(".gitignore"), "/target\n").unwrap();
    fs::write(root.join("mutants.toml"), CONFIG).unwrap();
    assert!(
        Command::new("git")
            .arg("init")
            .arg("-q")
            .arg(&root)
            .status()
            .unwrap()
            .success()
    );
    root
}

/// The exit code, and what was written to standard output and standard error.
fn run(root: &Path, arguments: &[&str]) -> (i32, String, String) {
    let output = Command::new(env!("CARGO_BIN_EXE_hairline-mutants"))
        .args(["--config", "mutants.toml", "--root"])
        .arg(root)
        .args(arguments)
        .output()
        .unwrap();
    let [out, err] = [output.stdout, output.stderr].map(|text| String::from_utf8(text).unwrap());
    (output.status.code().unwrap(), out, err)
}

#[test]
fn mutants_of_the_toy_live_and_die_as_they_should() {
    let root = toy("lives");
    let (code, out, err) = run(&root, &[]);
    assert_eq!(code, 1, "{out}{err}");
    let survivors: Vec<&str> = out
        .lines()
        .filter(|line| line.starts_with("src/"))
        .collect();
    let expected = [
        "src/lib.rs:6:10: replace > with >= in {a > b} of larger",
        "src/lib.rs:10:13: replace < with <= in {x.abs() < BOUND} of is_small",
        "src/lib.rs:32:8: fn forgotten -> false (not reached)",
        "src/lib.rs:33:5: literal true -> false in {true} of forgotten (not reached)",
    ];
    assert_eq!(survivors, expected, "{out}{err}");
    // A loop that never ends counts as killed; numbers of a constant slice do not compile.
    assert!(
        err.contains("delete statement in {n -= 1} of count_down: Killed"),
        "{err}"
    );
    assert!(
        err.contains("const BOUND * 1e-12 in {x.abs() < BOUND} of is_small: Killed"),
        "{err}"
    );
    assert!(err.contains("if -> false in {let Some(first)"), "{err}");
    assert!(
        err.contains("left out: toy: tests::that_fails: fails without a mutant"),
        "{err}"
    );
    assert!(out.contains("not counted: 3 that do not compile"), "{out}");

    // What a test started ends with it.
    let sleeping = Command::new("pgrep")
        .args(["-fx", "sleep 86399"])
        .output()
        .unwrap();
    assert_eq!(String::from_utf8_lossy(&sleeping.stdout), "");

    // A second run knows all; an equivalent is no survivor; a new test is tried on survivors only.
    let (_, again, err) = run(&root, &[]);
    assert!(again == out && !err.contains("Killed"), "{err}");
    fs::write(root.join("mutants.toml"), CONFIG.to_owned() + EQUIVALENT).unwrap();
    let tested = LIBRARY.replace(
        "fn steps() {",
        "fn steps() {\n        assert!(forgotten());",
    );
    fs::write(root.join("src/lib.rs"), tested).unwrap();
    let (code, out, err) = run(&root, &["--lived"]);
    assert_eq!(code, 1, "{out}{err}");
    assert_eq!(err.matches(": Killed").count(), 2, "{err}");
    assert_eq!(
        out.lines().filter(|line| line.starts_with("src/")).count(),
        1,
        "{out}"
    );
    assert_eq!(run(&root, &["--mutant", "src/lib.rs:6:10"]).0, 0);
    assert_eq!(run(&root, &["--mutant", "src/lib.rs:10:13"]).0, 1);

    // Tests without the word are not even run once.
    let (_, _, err) = run(&root, &["--test", "small", "--mutant", "src/lib.rs:10:13"]);
    assert!(
        err.contains("1 tests,") && !err.contains("that_fails"),
        "{err}"
    );

    // One of 35 is left: what a module says may live, or more.
    assert!(
        out.contains(&format!("{:>10.1} %{:>10.1} %\n", 2.9, 0.0)),
        "{out}"
    );
    for (may_live, met) in [("0.03", 0), ("0.02", 1)] {
        let config = CONFIG.to_owned() + &format!("may_live = {may_live}\n") + EQUIVALENT;
        fs::write(root.join("mutants.toml"), config).unwrap();
        let (code, out, err) = run(&root, &[]);
        assert_eq!(code, met, "{out}{err}");
    }
}

#[test]
fn what_gives_a_variable_its_value_is_not_left_out() {
    let root = toy("late");
    let library = "pub fn order(is_up: bool) -> (i32, i32) {
    let (first, last);
    if is_up {
        (first, last) = (1, 2);
    } else {
        (first, last) = (2, 1);
    }
    (first, last)
}

#[test]
fn both_orders() {
    assert_eq!([order(true), order(false)], [(1, 2), (2, 1)]);
}
";
    fs::write(root.join("src/lib.rs"), library).unwrap();
    let (code, out, err) = run(&root, &[]);
    assert_eq!(code, 0, "{out}{err}");
    assert!(
        out.contains("not counted: 2 that do not compile"),
        "{out}{err}"
    );
    assert!(!err.contains("delete statement"), "{err}");
}

#[test]
fn conditions_are_left_out_where_a_module_says_so() {
    let root = toy("conditions");
    let library = "fn ensure(holds: bool) -> Result<(), ()> {
    if holds { Ok(()) } else { Err(()) }
}

pub fn check(a: i32, b: i32, all: &[i32]) -> Result<usize, ()> {
    ensure(a == 1)?;
    ensure(b == 1 && a == b)?;
    Ok(all.iter().filter(|x| **x == 1).count())
}

#[test]
fn ones() {
    assert_eq!([check(1, 1, &[1]), check(2, 2, &[1])], [Ok(1), Err(())]);
}
";
    fs::write(root.join("src/lib.rs"), library).unwrap();
    // The changes that lived, without operators.
    let lived = || {
        let (_, out, err) = run(&root, &[]);
        let survivors = out.lines().filter(|line| line.starts_with("src/"));
        let changes = survivors.map(|line| {
            let (_, described) = line.split_once(": ").unwrap();
            described.split_once(" in ").unwrap().0.to_owned()
        });
        let changes: Vec<String> = changes
            .filter(|change| !change.contains("replace"))
            .collect();
        (changes, out + &err)
    };
    assert_eq!(lived().0, [""; 0]);
    fs::write(
        root.join("mutants.toml"),
        CONFIG.to_owned() + "conditions = true\n",
    )
    .unwrap();
    let (changes, screen) = lived();
    // Each of both conditions refuses (2, 2), and every number is a 1.
    let expected = [
        "delete statement",
        "ensure -> true",
        "delete statement",
        "ensure -> true",
        "drop the left of &&",
        "drop the right of &&",
        "filter -> true",
    ];
    assert_eq!(changes, expected, "{screen}");
}

#[test]
fn an_equivalent_that_matches_nothing_is_an_error() {
    let root = toy("unknown");
    let unknown = EQUIVALENT.replace("a > b", "a > c");
    fs::write(root.join("mutants.toml"), CONFIG.to_owned() + &unknown).unwrap();
    let (code, _, err) = run(&root, &["--list"]);
    assert_eq!(code, 2);
    assert!(
        err.contains("src/lib.rs: replace > with >= in {a > c} of larger"),
        "{err}"
    );
}
