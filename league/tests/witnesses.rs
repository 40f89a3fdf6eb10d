//! The worst known cases: each entrant still shows, at its pinned version, the very finding that its
//! line in witnesses/ says.

use hairline::internals::corpus::lines::{self, StoredCase};
use hairline::internals::explore::campaign::Find;
use hairline_league::{kernels, register};
use std::collections::BTreeSet;
use std::fs;
use std::path::PathBuf;

fn witnesses() -> Vec<StoredCase> {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/witnesses");
    let mut files: Vec<PathBuf> = fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .collect();
    files.sort();
    let read = |path: &PathBuf| {
        let bytes = fs::read(path).unwrap();
        lines::read(&bytes[..], &path.display().to_string())
            .map(Result::unwrap)
            .collect::<Vec<_>>()
    };
    files.iter().flat_map(read).collect()
}

#[test]
fn every_witness_is_shown_by_the_published_function_and_every_kernel_has_one() {
    register().unwrap();
    let witnesses = witnesses();
    let mut replayed = BTreeSet::new();
    for case in &witnesses {
        let name = case.name.as_deref().unwrap();
        let find = Find::of_stored(case).unwrap_or_else(|error| panic!("{name}: {error}"));
        assert_eq!(find.stored().truth, case.truth, "{name}");
        replayed.insert(find.signature.kernel);
    }
    for kernel in kernels() {
        assert!(
            replayed.contains(kernel.info.name),
            "{} has no witness",
            kernel.info.name
        );
    }
}

#[test]
fn a_witness_of_another_finding_is_refused() {
    register().unwrap();
    for case in witnesses().iter().take(3) {
        let mut changed = case.clone();
        let found = changed.found.as_mut().unwrap();
        found.signature = found.signature.replace("false-", "true-");
        assert!(Find::of_stored(&changed).is_err());
    }
}
