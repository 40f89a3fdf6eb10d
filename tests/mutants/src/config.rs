//! `mutants.toml`: what is mutated, what else than tests may notice it, and what is equivalent.

use crate::find::Mutant;
use serde::Deserialize;
use std::path::Path;

/// The whole file.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Config {
    /// The arguments of `cargo test` that choose the tests.
    pub tests: Vec<String>,
    /// Tests that take longer are left out, in seconds.
    pub slow: f64,
    #[serde(rename = "module")]
    pub modules: Vec<Module>,
    #[serde(default, rename = "program")]
    pub programs: Vec<Program>,
    #[serde(default, rename = "equivalent")]
    pub equivalents: Vec<Equivalent>,
}

/// Files that stand in the table as one line.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Module {
    pub name: String,
    /// The group that `--group` chooses.
    pub group: String,
    /// Files, or folders with a slash at the end.
    pub files: Vec<String>,
    /// The share of its mutants that may live.
    #[serde(default)]
    pub may_live: f64,
    /// True if its conditions are left out too, one by one: those of a checker decide what it accepts.
    #[serde(default)]
    pub conditions: bool,
}

impl Module {
    /// Whether a file belongs to it.
    pub fn has(&self, file: &str) -> bool {
        self.files
            .iter()
            .any(|f| f == file || f.ends_with('/') && file.starts_with(f.as_str()))
    }
}

/// A program that notices a mutant by failing.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Program {
    pub name: String,
    /// Cargo's arguments that build it, if the tests' build does not.
    #[serde(default)]
    pub build: Vec<String>,
    /// What is run in the root of the tree; `{target}` is the folder of what is built.
    pub run: Vec<String>,
}

/// A mutant, or several with one text, that no test can notice.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Equivalent {
    pub file: String,
    pub function: String,
    pub change: String,
    #[serde(default)]
    pub source: String,
    /// Which of those with one text; all, if it is left out.
    pub nth: Option<usize>,
    pub reason: String,
}

impl Equivalent {
    /// Whether it speaks of a mutant.
    pub fn matches(&self, mutant: &Mutant) -> bool {
        self.file == mutant.file
            && self.function == mutant.function
            && self.change == mutant.change
            && self.source == mutant.source
            && self.nth.is_none_or(|nth| nth == mutant.nth)
    }
}

impl Config {
    /// Reads the file.
    pub fn read(path: &Path) -> Result<Config, String> {
        let text = std::fs::read_to_string(path).map_err(|e| format!("{}: {e}", path.display()))?;
        let config: Config =
            toml::from_str(&text).map_err(|e| format!("{}: {e}", path.display()))?;
        match config
            .equivalents
            .iter()
            .find(|e| e.reason.trim().is_empty())
        {
            Some(entry) => Err(format!(
                "{}: {}: a reason is needed",
                path.display(),
                entry.change
            )),
            None => Ok(config),
        }
    }

    /// Whether an entry says that no test can notice a mutant.
    pub fn is_equivalent(&self, mutant: &Mutant) -> bool {
        self.equivalents.iter().any(|entry| entry.matches(mutant))
    }

    /// An error for entries that speak of no mutant of a file that was searched.
    pub fn check_equivalents(&self, mutants: &[Mutant], files: &[String]) -> Result<(), String> {
        let unknown: Vec<String> = self
            .equivalents
            .iter()
            .filter(|entry| {
                files.contains(&entry.file) || !self.modules.iter().any(|m| m.has(&entry.file))
            })
            .filter(|entry| !mutants.iter().any(|mutant| entry.matches(mutant)))
            .map(
                |Equivalent {
                     file,
                     function,
                     change,
                     source,
                     ..
                 }| {
                    format!("\n    {file}: {change} in {{{source}}} of {function}")
                },
            )
            .collect();
        match unknown.is_empty() {
            true => Ok(()),
            false => Err(format!(
                "equivalents that match no mutant:{}",
                unknown.concat()
            )),
        }
    }
}
