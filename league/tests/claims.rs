//! What entrants are said to promise is what their sources say, word for word: those of crates, and of the packages of
//! npm and PyPI that league/setup has installed.

use hairline_league::{Entrant, Run, entrants};
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

/// Entrants whose documentation is on a page alone.
const ON_A_PAGE: &[&str] = &["cgal", "embree-robust", "meshlib"];

/// The sources of all crates that cargo has unpacked, by name and version.
fn crates() -> BTreeMap<String, PathBuf> {
    let home = std::env::var("CARGO_HOME").map(PathBuf::from);
    let home =
        home.unwrap_or_else(|_| PathBuf::from(std::env::var("HOME").unwrap()).join(".cargo"));
    let folders = |path: PathBuf| {
        fs::read_dir(path)
            .into_iter()
            .flatten()
            .map(|entry| entry.unwrap().path())
    };
    let packages = folders(home.join("registry/src")).flat_map(folders);
    packages
        .map(|path| {
            (
                path.file_name().unwrap().to_string_lossy().into_owned(),
                path,
            )
        })
        .collect()
}

/// All files below a folder.
fn files(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().path());
    entries
        .flat_map(|path| {
            if path.is_dir() {
                files(&path)
            } else {
                vec![path]
            }
        })
        .collect()
}

/// The files of a package of PyPI, if it is installed.
fn python_files(entrant: &Entrant) -> Option<Vec<PathBuf>> {
    let lib = fs::read_dir(league().join("python/venv/lib"))
        .ok()?
        .next()?
        .unwrap()
        .path();
    let packages = lib.join("site-packages");
    let name = format!("{}-{}", entrant.package.replace('-', "_"), entrant.version);
    let mut entries = fs::read_dir(&packages)
        .ok()?
        .map(|entry| entry.unwrap().path());
    let info = entries.find(|path| {
        let stem = path.file_name().unwrap().to_string_lossy();
        stem.starts_with(&name) && stem.ends_with(".dist-info")
    })?;
    let record = fs::read_to_string(info.join("RECORD")).unwrap();
    Some(
        record
            .lines()
            .map(|line| packages.join(line.split(',').next().unwrap()))
            .collect(),
    )
}

fn league() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// An entrant's files, if they are there.
fn sources(entrant: &Entrant, crates: &BTreeMap<String, PathBuf>) -> Option<Vec<PathBuf>> {
    let package = entrant.package.split(',').next().unwrap();
    match entrant.run {
        Run::Process { needs, .. } if needs.contains("node_modules") => {
            let folder = league().parent().unwrap().join(needs);
            folder.exists().then(|| files(&folder))
        }
        Run::Process { .. } => python_files(entrant),
        _ => crates
            .get(&format!("{package}-{}", entrant.version))
            .map(|folder| files(folder)),
    }
}

/// The words of all sources among some files, without the marks of comments. Documentation of a compiled module stands
/// in it as text.
fn words(files: &[PathBuf]) -> String {
    let ends = ["rs", "js", "mjs", "ts", "json", "py", "pyi", "so"];
    let has_end = |file: &&PathBuf| {
        file.extension()
            .is_some_and(|end| ends.contains(&end.to_string_lossy().as_ref()))
            && fs::metadata(file).is_ok_and(|file| file.len() < 30_000_000)
    };
    let mut text = String::new();
    for file in files.iter().filter(has_end) {
        let bytes = fs::read(file).unwrap_or_default();
        let is_rust = file.extension().is_some_and(|end| end == "rs");
        let file = String::from_utf8_lossy(&bytes);
        let marks = if is_rust {
            ["///", "//!", "//"]
        } else {
            ["*", "/**", "//"]
        };
        let words = file.split_whitespace().filter(|word| !marks.contains(word));
        words.for_each(|word| text.extend([word, " "]));
    }
    text
}

#[test]
fn the_quoted_sentences_stand_in_the_sources_of_the_packages() {
    let crates = crates();
    let mut checked = 0;
    for entrant in entrants() {
        if entrant.claim.is_empty() || ON_A_PAGE.contains(&entrant.name) {
            continue;
        }
        // What this crate does not depend on, and what is not installed.
        let Some(files) = sources(&entrant, &crates) else {
            eprintln!("not read: {} is not installed", entrant.name);
            continue;
        };
        let text = words(&files);
        for sentence in entrant.claim {
            assert!(
                text.contains(sentence),
                "{}: not in its source: {sentence}",
                entrant.name
            );
            checked += 1;
        }
    }
    assert!(checked > 20, "only {checked} sentences were found");
}
