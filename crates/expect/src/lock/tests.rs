//! Tests of the lock file.

use super::*;

const ROW: &str = "cramer\tsource\tparallel=1e-7\tray, closed";
const JUDGED: &str = "cramer\tsource\tf32\tfan\t90\t3";
const LINE: &str = "cramer\tsource\tf32\ttiny\tparallel\tfalse-hit\t3\t9\t0a:";

fn file(lines: &str) -> String {
    format!("# comment\n{SCHEMA} cases 0\n[pdp11-unix]\n{lines}\n")
}

#[test]
fn what_is_written_is_read_and_the_target_with_the_most_counts() {
    let more = LINE.replace("parallel", "coplanar");
    let text = file(&format!("{ROW}\n{JUDGED}\n{LINE}\n{more}"))
        + "[vax-vms]\n"
        + &LINE.replace("\t3\t", "\t5\t")
        + "\n";
    let lock = Lock::read(&text, "e.lock").unwrap();
    let most: Vec<(String, u64)> = lock
        .most()
        .into_iter()
        .map(|(key, n)| (key.to_string(), n))
        .collect();
    assert_eq!(
        most,
        [(
            "cramer (source) f32 tiny: false-hit of any class".to_owned(),
            6
        )]
    );
    assert_eq!(
        Lock::read(&lock.to_string(), "e.lock").unwrap().targets,
        lock.targets
    );
    let target = &lock.targets["pdp11-unix"];
    assert_eq!(
        target.rows.values().next().unwrap().epsilons,
        "parallel=1e-7"
    );
}

#[test]
fn what_is_wrong_is_named_with_its_line() {
    for (from, to, expected) in [
        (
            "-lock/1",
            "-lock/9",
            "e.lock:2: expected 'hairline-expectations-lock/1 cases HASH'; ",
        ),
        (
            "[pdp11-unix]",
            "pdp11-unix",
            "e.lock:3: expected a target, as [x86_64-linux]; ",
        ),
        (
            "\tf32\t",
            " f32 ",
            "e.lock:4: expected 9 words between tabs: kernel, ",
        ),
        (
            "\t3\t",
            "\tthree\t",
            "e.lock:4: expected a number, not 'three'; ",
        ),
        (
            "\t3\t",
            "\t0\t",
            "e.lock:4: expected a count from 1 to 9, not 0; ",
        ),
        (
            "\t3\t",
            "\t10\t",
            "e.lock:4: expected a count from 1 to 9, not 10; ",
        ),
        (
            "0a:",
            "0a",
            "e.lock:4: expected the digest of a set of cases; ",
        ),
        (
            LINE,
            &ROW.replace("\tray", " ray"),
            "e.lock:4: expected 9 words between tabs: ",
        ),
        (
            LINE,
            &format!("{ROW}\n{ROW}"),
            "e.lock:5: expected each row, and each class of a ",
        ),
        (
            LINE,
            &format!("{LINE}\n{LINE}"),
            "e.lock:5: expected each row, and each class of a finding, once; ",
        ),
    ] {
        let error = Lock::read(&file(LINE).replace(from, to), "e.lock")
            .unwrap_err()
            .to_string();
        assert!(error.starts_with(expected), "{expected}: {error}");
        assert!(error.ends_with(WRITER), "{error}");
    }
}
