//! A test of one's own that is held to a file of expectations, run as `cargo test` runs it: in a process with
//! its variables.

use hairline::{Case, Contract, Entry, Hit, KernelInfo, audit, find};
use std::env;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

fn moller_trumbore(case: &Case<f32>, epsilon: f32) -> Option<Hit<f32>> {
    let (ray, [a, b, c]) = (&case.ray, case.triangle.vertices());
    let (ab, ac, from) = (b - a, c - a, ray.origin - a);
    let p = ray.direction.cross(ac);
    let det = ab.dot(p);
    let (u, q) = (from.dot(p) / det, from.cross(ab));
    let (v, t) = (ray.direction.dot(q) / det, ac.dot(q) / det);
    let inside = det.abs() >= epsilon && u >= 0.0 && v >= 0.0 && u + v <= 1.0;
    (inside && t >= 0.0).then(|| Hit::at(t))
}

/// The test as a user writes it; what it runs is said by variables. Without them it is nobody's.
#[test]
fn users_own() {
    const MINE: KernelInfo = KernelInfo::own("mine", Contract::CLOSED_RAY);
    let Ok(file) = env::var("USERS_FILE") else {
        return;
    };
    let epsilon: f32 = env::var("USERS_EPSILON").unwrap().parse().unwrap();
    let test = move |case: &Case<f32>, _: &[f32]| moller_trumbore(case, epsilon);
    let kernel = Entry::new(&MINE).f32(test);
    audit(&kernel)
        .families(["interior"])
        .expectations(file)
        .assert_conforms();
}

/// Runs it; none if it passes, else what it panics with.
fn panic_of(file: &Path, epsilon: &str, bless: &str) -> Option<String> {
    let output = Command::new(env::current_exe().unwrap())
        .args(["expectations::users_own", "--exact", "--nocapture"])
        .env("USERS_FILE", file)
        .env("USERS_EPSILON", epsilon)
        .env("HAIRLINE_BLESS", bless)
        .output()
        .unwrap();
    let out = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(out.contains("running 1 test"), "{out}");
    let error = String::from_utf8_lossy(&output.stderr).into_owned();
    (!output.status.success()).then_some(error)
}

fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).unwrap();
    folder
}

fn files(folder: &Path) -> Vec<(PathBuf, String)> {
    let mut paths: Vec<PathBuf> = fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .collect();
    paths.sort();
    let text = |path: PathBuf| (path.clone(), fs::read_to_string(path).unwrap());
    paths.into_iter().map(text).collect()
}

#[test]
fn a_test_passes_as_long_as_what_is_found_is_what_its_file_says() {
    let folder = folder("expectations-of-a-test");
    let file = folder.join("mine.toml");
    let fails = |epsilon: &str, bless: &str, parts: &[&str]| {
        let said = panic_of(&file, epsilon, bless).expect("a failure");
        for part in parts {
            assert!(said.contains(part), "{part}\n{said}");
        }
        said
    };
    // Nothing is written unless it is asked for.
    fails(
        "0.05",
        "",
        &["there is no such file. `HAIRLINE_BLESS=1 cargo test` writes it and "],
    );
    fails(
        "0.05",
        "yes",
        &["HAIRLINE_BLESS: expected 1 or worse, not 'yes'"],
    );
    assert!(files(&folder).is_empty());
    assert_eq!(panic_of(&file, "0.05", "1"), None);
    let blessed = files(&folder);
    let names: Vec<&Path> = blessed.iter().map(|(path, _)| path.as_path()).collect();
    assert_eq!(names, [&file, &folder.join("mine.toml.lock")]);
    assert!(
        blessed[0].1.contains("finding = \"false-miss\""),
        "{}",
        blessed[0].1
    );
    assert_eq!(panic_of(&file, "0.05", ""), None);
    assert_eq!(panic_of(&file, "0.05", "1"), None);
    assert_eq!(files(&folder), blessed);

    // Worse: a case that was right before, as a command, in Rust and in bits.
    let worse = [
        "does not conform: ",
        " worse",
        "the case shown is new",
        "::new([",
        "HAIRLINE_CASE='",
    ];
    let said = fails("0.1", "", &worse);
    assert!(
        said.contains("mine.toml:") && !said.contains("HAIRLINE_BLESS"),
        "{said}"
    );
    fails(
        "0.1",
        "1",
        &[
            "stays as it is: ",
            "HAIRLINE_BLESS=worse writes it all the same",
        ],
    );
    assert_eq!(files(&folder), blessed);
    assert_eq!(panic_of(&file, "0.1", "worse"), None);
    assert_ne!(files(&folder), blessed);

    // Better: stale.
    fails(
        "0.05",
        "",
        &[
            "better than expected",
            "stale: ",
            "HAIRLINE_BLESS=1 cargo test writes",
        ],
    );
    assert_eq!(panic_of(&file, "0.05", "1"), None);
    assert_eq!(files(&folder), blessed);

    // A lock file alone, and one that says something else.
    fs::remove_file(&file).unwrap();
    for bless in ["", "1"] {
        fails(
            "0.05",
            bless,
            &[
                "mine.toml.lock: ",
                "whose cases these are, is missing: restore it",
            ],
        );
    }
    fs::write(
        &file,
        blessed[0].1.replacen("\nschema = ", "\nschema = = ", 1),
    )
    .unwrap();
    fails("0.05", "", &["mine.toml:"]);
    let count = blessed[0].1.rfind("counts = { ").unwrap() + "counts = { ".len();
    let at = count + blessed[0].1[count..].find("= ").unwrap() + 2;
    fs::write(
        &file,
        format!("{}9{}", &blessed[0].1[..at], &blessed[0].1[at..]),
    )
    .unwrap();
    fails(
        "0.05",
        "",
        &["mine.toml:", "mine.toml.lock: put back what was there"],
    );
}

#[test]
fn a_file_says_alone_what_may_be_wrong() {
    let request = audit(find("cramer").unwrap()).count(10).allow("crack", 0.1);
    let error = request
        .expectations("any.toml")
        .run()
        .unwrap_err()
        .to_string();
    assert!(
        error.starts_with("allow: the file of expectations says"),
        "{error}"
    );
}
