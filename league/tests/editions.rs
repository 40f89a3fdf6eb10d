//! A frozen edition is as it was: its files have the hashes of its manifest. And every edition's tables are
//! those of its entrants' files.

use hairline_league::edition::{self, CAPTION, Manifest};
use std::fs;
use std::path::{Path, PathBuf};

fn editions() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("editions");
    let mut folders: Vec<PathBuf> =
        fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    folders.sort();
    folders
}

#[test]
fn the_files_of_a_frozen_edition_have_the_hashes_of_its_manifest() {
    let mut frozen = 0;
    for folder in editions() {
        if let Some(stored) = Manifest::stored(&folder).unwrap() {
            assert_eq!(stored, Manifest::of(&folder).unwrap(), "{} was edited", folder.display());
            frozen += 1;
        }
    }
    assert!(frozen > 0);
}

#[test]
fn the_last_editions_tables_are_made_of_its_entrants_files_and_one_stands_in_docs() {
    let folder = editions().pop().unwrap();
    let name = folder.file_name().unwrap().to_str().unwrap();
    let results = edition::results(&folder).unwrap();
    let read = |name: &str| fs::read_to_string(folder.join(name)).unwrap();
    let table = edition::markdown(&results);
    assert_eq!(read("table.md"), format!("# {name}\n\n{CAPTION}\n\n{table}"));
    assert_eq!(read("table.html"), edition::html(name, &results));
    assert_eq!(read("table.tex"), edition::latex(name, &results));
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap();
    let page = fs::read_to_string(root.join("docs/league.md")).unwrap();
    assert!(page.contains(&table), "docs/league.md has another table");
    assert!(page.len() < 16_000, "docs/league.md has {} bytes", page.len());
    assert!(fs::read_to_string(root.join("CITATION.cff")).unwrap().contains(name));
}

#[test]
fn every_page_of_findings_that_an_entrant_names_is_there() {
    for entrant in hairline_league::entrants() {
        for page in entrant.findings {
            let path = format!("{}/findings/{page}", env!("CARGO_MANIFEST_DIR"));
            assert!(Path::new(&path).exists(), "{}: no {path}", entrant.name);
        }
    }
}
