//! What entrants are said to promise is what their sources say, word for word.

use hairline_league::entrants;
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

/// The sources of all packages that cargo has unpacked, by name and version.
fn sources() -> BTreeMap<String, PathBuf> {
    let home = std::env::var("CARGO_HOME").map(PathBuf::from);
    let home =
        home.unwrap_or_else(|_| PathBuf::from(std::env::var("HOME").unwrap()).join(".cargo"));
    let folders =
        |path: PathBuf| fs::read_dir(path).into_iter().flatten().map(|entry| entry.unwrap().path());
    let packages = folders(home.join("registry/src")).flat_map(folders);
    packages.map(|path| (path.file_name().unwrap().to_string_lossy().into_owned(), path)).collect()
}

/// The words of all Rust files below a folder, without the marks of comments.
fn words(folder: &Path, text: &mut String) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            words(&path, text);
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            let file = fs::read_to_string(&path).unwrap();
            let words = file.split_whitespace().filter(|word| !["///", "//!", "//"].contains(word));
            words.for_each(|word| text.extend([word, " "]));
        }
    }
}

#[test]
fn the_quoted_sentences_stand_in_the_sources_of_the_crates() {
    let sources = sources();
    let mut checked = 0;
    for entrant in entrants() {
        let package = entrant.package.split(',').next().unwrap();
        // Those of other languages, and what this crate does not depend on, are not there.
        let Some(source) = sources.get(&format!("{package}-{}", entrant.version)) else { continue };
        let mut text = String::new();
        words(source, &mut text);
        for sentence in entrant.claim {
            assert!(text.contains(sentence), "{}: not in its source: {sentence}", entrant.name);
            checked += 1;
        }
    }
    assert!(checked > 20, "only {checked} sentences were found");
}
