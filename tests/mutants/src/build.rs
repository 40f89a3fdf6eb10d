//! A copy of the tree with the mutants in it, and what Cargo makes of it.

use crate::find::{Finder, constants};
use crate::rewrite::{Blame, Rewritten, rewrite, runtime};
use serde_json::Value;
use std::collections::{HashMap, HashSet};
use std::fs;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// The copy of a package with mutants in it.
pub struct Tree {
    /// The package itself.
    pub root: PathBuf,
    /// Its copy.
    pub copy: PathBuf,
    /// What is built from the copy.
    pub target: PathBuf,
}

/// An executable of tests.
#[derive(Clone, Debug)]
pub struct TestBinary {
    pub name: String,
    pub path: PathBuf,
}

impl Tree {
    /// The copy of a package lies in a folder for work.
    pub fn new(root: &Path, work: &Path) -> Tree {
        Tree {
            root: root.into(),
            copy: work.join("tree"),
            target: work.join("build"),
        }
    }

    /// What git tracks or would track of the package.
    fn files(&self, root: &Path) -> Result<Vec<String>, String> {
        let arguments = [
            "ls-files",
            "-z",
            "--cached",
            "--others",
            "--exclude-standard",
        ];
        let listed = Command::new("git")
            .args(arguments)
            .current_dir(root)
            .output();
        let listed = listed.map_err(|e| format!("git: {e}"))?.stdout;
        let names = String::from_utf8_lossy(&listed);
        let files = names
            .split('\0')
            .filter(|file| !file.is_empty() && root.join(file).is_file());
        // Without the tool itself, whose changes change no result.
        let files = files.filter(|file| !file.starts_with("tests/mutants/"));
        // In an order that does not depend on what git tracks already.
        let mut files: Vec<String> = files.map(str::to_owned).collect();
        files.sort();
        Ok(files)
    }

    /// The package's sources that are chosen.
    pub fn sources(&self, choose: impl Fn(&str) -> bool) -> Result<Vec<String>, String> {
        let mut files = self.files(&self.root)?;
        // What a `mod tests;` reads is no code to mutate.
        let is_test = |file: &str| file.ends_with("/tests.rs") || file.contains("/tests/");
        files.retain(|file| file.ends_with(".rs") && !is_test(file) && choose(file));
        Ok(files)
    }

    /// Changes with the package's code and data, but not with its documents.
    pub fn digest(&self) -> Result<u64, String> {
        self.digest_of(&self.root)
    }

    /// Changes with the copy's, mutants included.
    pub fn digest_of_copy(&self) -> Result<u64, String> {
        self.digest_of(&self.copy)
    }

    fn digest_of(&self, root: &Path) -> Result<u64, String> {
        let mut files = self.files(&self.root)?;
        files.retain(|file| {
            [".rs", ".toml", ".lock", ".jsonl", ".proof"]
                .iter()
                .any(|e| file.ends_with(e))
        });
        files.retain(|file| root.join(file).is_file());
        Ok(digest(&contents(root, files)?))
    }

    /// All mutants of some files; `with_conditions` says in which of them conditions are left out.
    pub fn find(
        &self,
        files: &[String],
        with_conditions: impl Fn(&str) -> bool,
    ) -> Result<Finder, String> {
        let mut finder = Finder::default();
        let mut parsed = Vec::new();
        for file in files {
            let text =
                fs::read_to_string(self.root.join(file)).map_err(|e| format!("{file}: {e}"))?;
            let syntax = syn::parse_file(&text).map_err(|e| format!("{file}: {e}"))?;
            parsed.push((file, text, syntax));
        }
        for (file, text, syntax) in &parsed {
            finder.constants = constants(syntax);
            finder.conditions = with_conditions(file);
            finder.add_file(file, text, syntax);
        }
        Ok(finder)
    }

    /// Writes the copy with the mutants in it. A file that is equal already stays, so that Cargo builds little again.
    fn rewrite(
        &self,
        finder: &Finder,
        refused: &HashSet<u32>,
    ) -> Result<HashMap<String, Rewritten>, String> {
        let mut all = HashMap::new();
        for (file, mut bytes) in contents(&self.root, self.files(&self.root)?)? {
            if let Some(sites) = finder.sites.get(&file) {
                let text = String::from_utf8_lossy(&bytes).into_owned();
                let rewritten = rewrite(&text, sites, finder.of_file(&file), refused);
                bytes = rewritten.text.clone().into_bytes();
                all.insert(file.clone(), rewritten);
            }
            // Each crate has one of its own.
            if file.ends_with("src/lib.rs") {
                let sites = finder.sites.values().map(Vec::len).sum();
                bytes.extend_from_slice(runtime(sites).as_bytes());
            }
            write(&self.copy.join(&file), &bytes)?;
        }
        Ok(all)
    }

    /// Builds the tests with all mutants; those that do not compile are added to `refused`.
    pub fn build(
        &self,
        finder: &Finder,
        refused: &mut HashSet<u32>,
        arguments: &[String],
    ) -> Result<Vec<TestBinary>, String> {
        loop {
            let rewritten = self.rewrite(finder, refused)?;
            let known = refused.len();
            let messages = self.cargo(arguments)?;
            let errors = messages.iter().filter(|m| m["message"]["level"] == "error");
            let mut unknown = String::new();
            let mut blamed = HashSet::new();
            for error in errors {
                match blame(&error["message"], &rewritten) {
                    Some(Blame::Mutant(id)) => {
                        blamed.insert(id);
                    }
                    Some(Blame::Sites(sites)) => {
                        let there = finder.mutants.iter().filter(|m| sites.contains(&m.site));
                        blamed.extend(there.map(|mutant| mutant.id));
                    }
                    None => unknown += error["message"]["rendered"].as_str().unwrap_or(""),
                }
            }
            refused.extend(blamed);
            if refused.len() > known {
                eprintln!("{} mutants do not compile; building again", refused.len());
                continue;
            }
            if !unknown.is_empty() || !messages.iter().any(|m| m["success"] == true) {
                return Err(format!("the tree does not build\n{unknown}"));
            }
            let tests = messages.iter().filter(|m| m["profile"]["test"] == true);
            return Ok(tests
                .filter_map(|m| {
                    let name = m["target"]["name"].as_str()?.to_owned();
                    Some(TestBinary {
                        name,
                        path: m["executable"].as_str()?.into(),
                    })
                })
                .collect());
        }
    }

    /// Cargo's messages.
    pub fn cargo(&self, arguments: &[String]) -> Result<Vec<Value>, String> {
        let output = Command::new(std::env::var_os("CARGO").unwrap_or("cargo".into()))
            .args(arguments)
            .args(["--message-format", "json", "--target-dir"])
            .arg(&self.target)
            .current_dir(&self.copy)
            .stderr(Stdio::inherit())
            .output()
            .map_err(|e| format!("cargo: {e}"))?;
        let lines = String::from_utf8_lossy(&output.stdout).into_owned();
        Ok(lines
            .lines()
            .filter_map(|line| serde_json::from_str(line).ok())
            .collect())
    }
}

/// What an error speaks of: its main place first, then a mutant that a label points to.
fn blame(error: &Value, rewritten: &HashMap<String, Rewritten>) -> Option<Blame> {
    let spans = error["spans"].as_array()?;
    // A variable without a value: labels show what sets it, which cannot be left out.
    if error["code"]["code"] == "E0381" {
        let labels = spans.iter().filter(|span| span["is_primary"] == false);
        let sites = labels
            .filter_map(|span| blame_at(span, rewritten))
            .flat_map(|found| match found {
                Blame::Mutant(_) => Vec::new(),
                Blame::Sites(sites) => sites,
            });
        return Some(Blame::Sites(sites.collect()))
            .filter(|found| *found != Blame::Sites(Vec::new()));
    }
    let blames = |primary: bool| {
        let spans = spans
            .iter()
            .filter(move |span| span["is_primary"] == primary);
        spans.filter_map(|span| blame_at(span, rewritten))
    };
    let all: Vec<Blame> = blames(true).chain(blames(false)).collect();
    let mutant = all
        .iter()
        .position(|found| matches!(found, Blame::Mutant(_)));
    let found = all.into_iter().nth(mutant.unwrap_or(0))?;
    (found != Blame::Sites(Vec::new())).then_some(found)
}

fn blame_at(span: &Value, rewritten: &HashMap<String, Rewritten>) -> Option<Blame> {
    let file = rewritten.get(span["file_name"].as_str()?)?;
    let [start, end] = ["byte_start", "byte_end"].map(|name| span[name].as_u64());
    Some(file.blame(&(start? as usize..end? as usize)))
}

/// Writes a file whose content is another.
fn write(path: &Path, bytes: &[u8]) -> Result<(), String> {
    if fs::read(path).is_ok_and(|old| old == bytes) {
        return Ok(());
    }
    let folder = path.parent().expect("a file in a folder");
    fs::create_dir_all(folder)
        .and_then(|()| fs::write(path, bytes))
        .map_err(|e| format!("{}: {e}", path.display()))
}

fn contents(root: &Path, files: Vec<String>) -> Result<Vec<(String, Vec<u8>)>, String> {
    let read = |file: String| match fs::read(root.join(&file)) {
        Ok(bytes) => Ok((file, bytes)),
        Err(error) => Err(format!("{file}: {error}")),
    };
    files.into_iter().map(read).collect()
}

/// A number that changes with what is hashed.
pub fn digest(what: &impl Hash) -> u64 {
    let mut hasher = DefaultHasher::new();
    what.hash(&mut hasher);
    hasher.finish()
}
