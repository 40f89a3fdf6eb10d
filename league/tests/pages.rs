//! The pages of findings: each has its parts, stands in docs/league.md, and its code is run. That in Rust by
//! `cargo test --doc`; that in Python and JavaScript here, if league/setup has installed the packages.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

const PARTS: [&str; 6] = [
    "\n## Reproduce\n",
    "\n## Documented\n",
    "\n## What came out\n",
    "\n## Cause\n",
    "\n## Smallest repair\n",
    "\n## What can be disputed\n",
];

fn league() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// Names and texts.
fn pages() -> Vec<(String, String)> {
    let folder = fs::read_dir(league().join("findings")).unwrap();
    let mut paths: Vec<PathBuf> = folder.map(|entry| entry.unwrap().path()).collect();
    paths.sort();
    let name = |path: &PathBuf| path.file_name().unwrap().to_string_lossy().into_owned();
    paths
        .iter()
        .map(|path| (name(path), fs::read_to_string(path).unwrap()))
        .collect()
}

/// The lines of a page's block of code, if it has one in a language.
fn code(page: &str, language: &str) -> Option<String> {
    let (_, rest) = page.split_once(&format!("\n```{language}\n"))?;
    Some(rest.split_once("\n```\n")?.0.to_owned())
}

#[test]
fn every_page_has_its_parts_is_linked_and_its_code_is_run_somewhere() {
    let read = |path: &str| fs::read_to_string(league().join(path)).unwrap();
    let [index, here, heavy] =
        ["../docs/league.md", "src/findings.rs", "heavy/src/lib.rs"].map(read);
    for (name, text) in pages() {
        let places = PARTS.map(|part| {
            text.find(part)
                .unwrap_or_else(|| panic!("{name}: no{part}"))
        });
        assert!(places.is_sorted(), "{name}: its parts are in another order");
        assert!(
            index.contains(&format!("league/findings/{name}")),
            "{name} is not in docs/league.md"
        );
        if let Some((_, threads)) = text.split_once("\n## Public threads\n") {
            let (threads, _) = threads
                .split_once(PARTS[5])
                .expect("before what can be disputed");
            let is_thread = |link: &str| {
                let [_, _, kind, number] = link.split('/').collect::<Vec<_>>()[..] else {
                    return false;
                };
                ["issues", "pull"].contains(&kind) && number.parse::<u32>().is_ok()
            };
            let links: Vec<&str> = threads.split("(https://github.com/").skip(1).collect();
            let links: Vec<&str> = links
                .iter()
                .filter_map(|link| link.split(')').next())
                .collect();
            assert!(
                !links.is_empty() && links.iter().all(|link| is_thread(link)),
                "{name}: {links:?}"
            );
        }
        // Small triangles are lost everywhere for the same reason.
        let title = text.lines().next().unwrap();
        assert!(
            !title.contains(" legs below ") || text.contains("/tinybvh/pull/283"),
            "{name}"
        );
        let languages = ["rust", "python", "javascript"];
        let [rust, others @ ..] = languages.map(|language| code(&text, language));
        let lines = [&rust]
            .into_iter()
            .chain(&others)
            .flatten()
            .next()
            .expect("code")
            .lines()
            .count();
        assert!(lines <= 20, "{name}: {lines} lines of code");
        if rust.is_some() {
            let is_run = [&here, &heavy]
                .iter()
                .any(|file| file.contains(&format!("\"{name}\"")))
                || heavy.contains(&format!("findings/{name}\""));
            assert!(is_run, "{name}: no program runs its code");
        }
    }
}

/// Runs a page's code in the folder of its language.
fn run(program: &Path, language: &str, folder: &str, file: &str) {
    if !program.exists() && program.components().count() > 1 || !league().join(folder).exists() {
        eprintln!(
            "not run: {} is not there: league/setup installs it",
            program.display()
        );
        return;
    }
    for (name, text) in pages() {
        let Some(code) = code(&text, language) else {
            continue;
        };
        let path = league().join(folder).join(file);
        fs::write(&path, code).unwrap();
        let output = Command::new(program).arg(&path).output().unwrap();
        fs::remove_file(&path).unwrap();
        assert!(
            output.status.success(),
            "{name}: {}",
            String::from_utf8_lossy(&output.stderr)
        );
        println!("{name} ran");
    }
}

#[test]
fn the_pages_in_python_run() {
    run(
        &league().join("python/venv/bin/python"),
        "python",
        "python/venv",
        "page.py",
    );
}

#[test]
fn the_pages_in_javascript_run() {
    run(
        Path::new("node"),
        "javascript",
        "javascript/node_modules",
        "page.mjs",
    );
}

/// The names and versions of a page's line of installation: `cargo add a@=1.0.0 b@=2.0.0`.
fn installed(page: &str) -> Vec<(String, String)> {
    let line = page
        .lines()
        .find(|line| line.contains(", after `") || line.starts_with("After `"));
    let words = line.unwrap_or_default().split([' ', '`', ':']);
    let pinned = words.filter_map(|word| {
        let (name, version) = word.split_once("==").or_else(|| word.rsplit_once('@'))?;
        Some((name.to_owned(), version.trim_start_matches('=').to_owned()))
    });
    pinned.collect()
}

#[test]
fn every_page_installs_what_its_code_uses_in_the_versions_that_were_tried() {
    let read = |path: &str| fs::read_to_string(league().join(path)).unwrap();
    let rust = read("Cargo.lock") + &read("heavy/Cargo.lock");
    let (npm, pip) = (
        read("javascript/package.json"),
        read("python/requirements.txt"),
    );
    for (page, text) in pages() {
        let installed = installed(&text);
        assert!(!installed.is_empty(), "{page}: nothing is installed");
        for (name, version) in &installed {
            let places = [
                format!("name = \"{name}\"\nversion = \"{version}\"\n"),
                format!("\"{name}\": \"{version}\""),
                format!("{name}=={version}\n"),
            ];
            let tried = [&rust, &npm, &pip]
                .iter()
                .zip(&places)
                .any(|(all, it)| all.contains(it));
            assert!(tried, "{page}: {name} {version} is not what was tried");
        }
        let code = code(&text, "rust").unwrap_or_default();
        for used in code.lines().filter_map(|line| line.strip_prefix("use ")) {
            let used = used.split("::").next().unwrap().replace('_', "-");
            let is_there = installed
                .iter()
                .any(|(name, _)| name.replace('_', "-") == used);
            assert!(is_there, "{page}: {used} is used and not installed");
        }
    }
}
