//! A frozen edition is as it was: its files have the hashes of its manifest. And every edition's tables are
//! those of its entrants' files.

use hairline_league::edition::{self, CAPTION, Manifest, Order};
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
    let table = edition::markdown(&results, Order::of(name));
    assert_eq!(read("table.md"), format!("# {name}\n\n{CAPTION}\n\n{table}"));
    assert_eq!(read("table.html"), edition::html(name, &results));
    assert_eq!(read("table.tex"), edition::latex(name, &results));
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap();
    let page = fs::read_to_string(root.join("docs/league.md")).unwrap();
    let by_promises = edition::markdown(&results, Order::Promises);
    assert!(page.contains(&by_promises), "docs/league.md has another table");
    assert!(page.len() < 16_000, "docs/league.md has {} bytes", page.len());
    assert!(fs::read_to_string(root.join("CITATION.cff")).unwrap().contains(name));
}

#[test]
fn rows_stand_by_what_became_of_the_promises_and_by_no_rate() {
    let results = edition::results(&editions().pop().unwrap()).unwrap();
    let table = edition::markdown(&results, Order::Promises);
    let cells = |line: &str| -> Vec<String> { line.split(" | ").map(str::to_owned).collect() };
    let rows: Vec<Vec<String>> = table.lines().skip(2).map(cells).collect();
    let claims: Vec<&str> = rows.iter().map(|row| row[3].as_str()).collect();
    let mut met = claims.clone();
    met.dedup();
    assert_eq!(met, ["held", "rounding", "size", "refuted", "-"]);
    let deepest = |row: &Vec<String>| -> f64 {
        row[8].split(" / ").map(|depth| depth.parse::<f64>().unwrap()).fold(0.0, f64::max)
    };
    for pair in rows.windows(2).filter(|pair| pair[0][3] == pair[1][3] && pair[0][3] != "-") {
        assert!(deepest(&pair[0]) <= deepest(&pair[1]), "{pair:?}");
    }
    // The same rows as in the other order.
    let sorted = |table: String| {
        let mut lines: Vec<String> = table.lines().map(str::to_owned).collect();
        lines.sort();
        lines
    };
    assert_eq!(sorted(table), sorted(edition::markdown(&results, Order::Entrants)));
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
