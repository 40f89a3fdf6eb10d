//! A frozen edition is as it was: its files have the hashes of its manifest. And every edition's tables are
//! those of its entrants' files.

use hairline_league::edition::{self, CAPTION, EntrantResult, Manifest};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

fn editions() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("editions");
    let mut folders: Vec<PathBuf> = fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .collect();
    folders.sort();
    folders
}

#[test]
fn the_files_of_a_frozen_edition_have_the_hashes_of_its_manifest() {
    let mut frozen = 0;
    for folder in editions() {
        if let Some(stored) = Manifest::stored(&folder).unwrap() {
            assert_eq!(
                stored,
                Manifest::of(&folder).unwrap(),
                "{} was edited",
                folder.display()
            );
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
    assert_eq!(
        read("table.md"),
        format!("# {name}\n\n{CAPTION}\n\n{table}")
    );
    assert_eq!(read("table.html"), edition::html(name, &results));
    assert_eq!(read("table.tex"), edition::latex(name, &results));
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap();
    let page = fs::read_to_string(root.join("docs/league.md")).unwrap();
    assert!(page.contains(&table), "docs/league.md has another table");
    let changes = edition::changes(folder.parent().unwrap(), name).unwrap();
    assert_eq!(read("changes.md"), changes);
    assert!(page.contains(&changes), "docs/league.md has other changes");
    assert!(
        page.len() < 16_000,
        "docs/league.md has {} bytes",
        page.len()
    );
    assert!(
        fs::read_to_string(root.join("CITATION.cff"))
            .unwrap()
            .contains(name)
    );
}

#[test]
fn rows_stand_by_what_became_of_the_promises_and_by_no_rate() {
    let results = edition::results(&editions().pop().unwrap()).unwrap();
    let table = edition::markdown(&results);
    let cells = |line: &str| -> Vec<String> { line.split(" | ").map(str::to_owned).collect() };
    let rows: Vec<Vec<String>> = table.lines().skip(2).map(cells).collect();
    let claims: Vec<&str> = rows.iter().map(|row| row[3].as_str()).collect();
    let mut met = claims.clone();
    met.dedup();
    assert_eq!(met, ["held", "rounding", "size", "refuted", "-"]);
    let deepest = |row: &Vec<String>| -> f64 {
        row[8]
            .split(" / ")
            .map(|depth| depth.parse::<f64>().unwrap())
            .fold(0.0, f64::max)
    };
    for pair in rows
        .windows(2)
        .filter(|pair| pair[0][3] == pair[1][3] && pair[0][3] != "-")
    {
        assert!(deepest(&pair[0]) <= deepest(&pair[1]), "{pair:?}");
    }
}

#[test]
fn the_deepest_false_verdicts_are_wrong_in_fractions_too() {
    let confirm = Path::new(env!("CARGO_MANIFEST_DIR")).join("python/confirm.py");
    let output = Command::new("python3").arg(confirm).output().unwrap();
    let text = String::from_utf8_lossy(&output.stdout);
    assert!(
        output.status.success(),
        "{text}{}",
        String::from_utf8_lossy(&output.stderr)
    );
    let results = edition::results(&editions().pop().unwrap()).unwrap();
    let scalars = results.iter().flat_map(|entrant| entrant.scalars.values());
    let depths = scalars
        .flat_map(|result| [&result.deepest_miss, &result.deepest_hit])
        .flatten();
    assert!(
        text.contains(&format!(": {} cases, ", depths.count())),
        "{text}"
    );
}

#[test]
fn a_documented_tolerance_is_in_the_contract_and_is_quoted() {
    let results = edition::results(&editions().pop().unwrap()).unwrap();
    let has = |result: &EntrantResult| {
        ["free within", "no hit owed"]
            .iter()
            .any(|words| result.contract.contains(words))
    };
    let tolerant: Vec<&EntrantResult> = results.iter().filter(|result| has(result)).collect();
    for (name, words, quoted) in [
        (
            "oxideav-mesh3d",
            "no hit owed at |det| < 1e-8",
            "an absolute `1e-8` determinant epsilon",
        ),
        (
            "babylon",
            "free within 2e-3 longest edges",
            "Epsilon = 0.001",
        ),
        (
            "trimesh",
            "free within 2e-13 longest edges",
            "which works out to 1e-13",
        ),
        ("compas", "no hit owed at |det| < 1e-9", "ABSOLUTE = 1e-9"),
    ] {
        let result = tolerant
            .iter()
            .find(|result| result.kernel == name)
            .expect(name);
        assert!(
            result.contract.contains(words),
            "{name}: {}",
            result.contract
        );
        assert!(
            result.claim.iter().any(|claim| claim.contains(quoted)),
            "{name}: no {quoted}"
        );
    }
    assert_eq!(tolerant.len(), 4);
}

#[test]
fn what_changed_names_entrants_versions_contracts_and_claims() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("changes");
    let write = |edition: &str, results: &[EntrantResult]| {
        let entrants = folder.join(edition).join("entrants");
        fs::create_dir_all(&entrants).unwrap();
        for result in results {
            let text = serde_json::to_string(result).unwrap();
            fs::write(entrants.join(format!("{}.json", result.kernel)), text).unwrap();
        }
    };
    let [mut one, two, three] = ["bvh", "vek", "warp"].map(|name| {
        let last = edition::results(&editions().pop().unwrap()).unwrap();
        last.into_iter()
            .find(|result| result.kernel == name)
            .unwrap()
    });
    write("a-1", &[one.clone(), two.clone()]);
    one.version = "9.9".to_owned();
    one.contract = one.contract.replace("ends free", "ends open");
    one.scalars.get_mut("f32").unwrap().verdict = "held".to_owned();
    write("a-2", &[one, three]);
    let text = edition::changes(&folder, "a-2").unwrap();
    for line in [
        "Since a-1; ",
        "\n- bvh: version 0.13.0 became 9.9.\n",
        "\n- bvh is judged by \"ends open\" in place of \"ends free\", as its documentation says.\n",
        "\n- bvh in f32: refuted became held.\n",
        "\n- warp 1.19.0 is new.\n",
        "\n- vek 0.17.2 is no longer there.\n",
    ] {
        assert!(text.contains(line), "no {line:?} in {text}");
    }
    assert!(
        text.contains("\n- bvh in f64, at edges, at vertices, parallel: "),
        "{text}"
    );
    assert_eq!(text.lines().count(), 9, "{text}");
    assert_eq!(edition::changes(&folder, "a-1").unwrap(), "");
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
