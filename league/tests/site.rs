//! The site of an edition, as a reader meets it: every link leads somewhere, nothing is fetched, and what the pages say
//! of a case is what the edition's files say.

use hairline_league::edition::{self, EntrantResult};
use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap()
}

fn newest() -> String {
    edition::names(&root().join("league/editions"))
        .unwrap()
        .pop()
        .unwrap()
}

/// Made once for all tests, with few rays.
fn site() -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("site");
    let _ = fs::remove_dir_all(&folder);
    let output = Command::new(env!("CARGO_BIN_EXE_league-site"))
        .arg(&folder)
        .args([&newest(), "https://example.org/league/"])
        .env("COUNT", "100")
        .current_dir(root())
        .output()
        .unwrap();
    assert!(
        output.status.success(),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
    folder
}

/// Its files below a folder, by their paths in it.
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

/// The values of an attribute.
fn values<'a>(page: &'a str, attribute: &str) -> Vec<&'a str> {
    let start = format!(" {attribute}=\"");
    let parts: Vec<&str> = page.split(start.as_str()).skip(1).collect();
    parts
        .into_iter()
        .map(|part| part.split('"').next().unwrap())
        .collect()
}

#[test]
fn the_site_works_from_a_folder_and_says_what_the_edition_says() {
    let folder = site();
    let all = files(&folder);
    let bytes: u64 = all
        .iter()
        .map(|file| fs::metadata(file).unwrap().len())
        .sum();
    assert!(bytes < 20_000_000, "{bytes}");
    let mut reached = BTreeSet::from([folder.join("index.html")]);
    let pages = all
        .iter()
        .filter(|file| file.extension().is_some_and(|end| end == "html"));
    for file in pages.clone() {
        let page = fs::read_to_string(file).unwrap();
        for link in values(&page, "href")
            .into_iter()
            .filter(|link| !link.starts_with("https://"))
        {
            let place = file.parent().unwrap().join(link);
            let place = place
                .canonicalize()
                .unwrap_or_else(|_| panic!("{}: {link}", file.display()));
            reached.insert(place);
        }
        assert!(
            values(&page, "src").is_empty(),
            "{} fetches something",
            file.display()
        );
        for tag in ["<script", "<link", "@import", "url("] {
            assert!(!page.contains(tag), "{}: {tag}", file.display());
        }
    }
    for page in pages {
        assert!(
            reached.contains(page),
            "no link leads to {}",
            page.display()
        );
    }
    let results = edition::results(&root().join("league/editions").join(newest())).unwrap();
    results
        .iter()
        .for_each(|entrant| check_entrant(&folder, entrant));
    let epsilon = fs::read_to_string(folder.join("epsilon/1e-minus-6.html")).unwrap();
    // The published bound of the determinant in f32, and the epsilon that Moller and Trumbore printed.
    for words in [
        "moller-trumbore",
        "An epsilon above 1.02e-6 refuses every ray",
        "1e2 times as large",
    ] {
        assert!(epsilon.contains(words), "{words}");
    }
}

fn check_entrant(folder: &Path, entrant: &EntrantResult) {
    let page = fs::read_to_string(folder.join(format!("kernel/{}.html", entrant.kernel))).unwrap();
    let registered = hairline_league::kernels();
    for (scalar, result) in &entrant.scalars {
        let badge = format!("badge/{}-{scalar}.json", entrant.kernel);
        let text = fs::read_to_string(folder.join(&badge)).unwrap();
        let json: serde_json::Value = serde_json::from_str(&text).unwrap();
        assert_eq!(json["schemaVersion"], 1);
        assert_eq!(
            json["message"] == "claims held",
            result.verdict == "held",
            "{badge}"
        );
        assert!(page.contains(&format!("?url=https://example.org/league/{badge})")));
        for (finding, depth) in [
            ("false-miss", &result.deepest_miss),
            ("false-hit", &result.deepest_hit),
        ] {
            let Some(depth) = depth else { continue };
            let (before, _) = page.split_once(&format!("\">{}<", depth.case)).unwrap();
            let (_, link) = before.rsplit_once("href=\"../").unwrap();
            let case = fs::read_to_string(folder.join(link)).unwrap();
            assert!(case.contains(&depth.case));
            for words in depth.bits.split(' ') {
                assert!(
                    case.contains(&words[2..].replace(',', " ")),
                    "{}: {words}",
                    depth.case
                );
            }
            // What runs here answers as it did for the edition.
            if registered
                .iter()
                .any(|kernel| kernel.info.name == entrant.kernel)
            {
                let row = case
                    .split("<tr>")
                    .find(|row| row.starts_with(&format!("<td>{}</td>", entrant.kernel)));
                assert!(
                    row.unwrap().contains(finding),
                    "{} {scalar}: {}",
                    entrant.kernel,
                    depth.case
                );
            }
        }
    }
}
