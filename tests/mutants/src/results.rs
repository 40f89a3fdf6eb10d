//! The file of results: one line a mutant as it comes, so that an interrupted run goes on.

use crate::find::Mutant;
use crate::trial::Outcome;
use serde::{Deserialize, Serialize};
use std::collections::HashMap;
use std::fs::{File, OpenOptions};
use std::io::Write;
use std::path::Path;

/// One line.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Line {
    /// `tests`, or a program's name.
    pub by: String,
    /// Of the tree that was tried.
    pub digest: String,
    pub key: String,
    /// `killed`, `lived`, `not reached` or `does not compile`.
    pub outcome: String,
    /// What killed it.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub test: String,
}

/// The file, and what it holds: the last line of each mutant.
pub struct Results {
    file: File,
    by: String,
    digest: String,
    last: HashMap<(String, String), Line>,
}

impl Results {
    /// Opens the file for what `by` notices in a tree.
    pub fn open(path: &Path, by: &str, digest: &str) -> Result<Results, String> {
        let text = std::fs::read_to_string(path).unwrap_or_default();
        // A line that was cut off by the end of a run is left out.
        let lines = text
            .lines()
            .filter_map(|line| serde_json::from_str::<Line>(line).ok());
        let last = lines
            .map(|line| ((line.by.clone(), line.key.clone()), line))
            .collect();
        let file = OpenOptions::new().create(true).append(true).open(path);
        let file = file.map_err(|e| format!("{}: {e}", path.display()))?;
        Ok(Results {
            file,
            by: by.to_owned(),
            digest: digest.to_owned(),
            last,
        })
    }

    /// What became of a mutant, in this tree or, if `earlier`, in any.
    pub fn of(&self, by: &str, mutant: &Mutant, earlier: bool) -> Option<&Line> {
        let line = self.last.get(&(by.to_owned(), mutant.key()))?;
        (earlier || line.digest == self.digest).then_some(line)
    }

    /// Whether a mutant is known not to compile, in any tree.
    pub fn is_refused(&self, mutant: &Mutant) -> bool {
        self.of("compiler", mutant, true).is_some()
    }

    /// Adds that a mutant does not compile.
    pub fn refuse(&mut self, mutant: &Mutant) -> Result<(), String> {
        self.push("compiler".into(), mutant, "does not compile", String::new())
    }

    /// Adds what became of a mutant.
    pub fn add(&mut self, mutant: &Mutant, outcome: &Outcome) -> Result<(), String> {
        let (outcome, test) = match outcome {
            Outcome::Killed(test) => ("killed", test.clone()),
            Outcome::Lived => ("lived", String::new()),
            Outcome::NotReached => ("not reached", String::new()),
        };
        self.push(self.by.clone(), mutant, outcome, test)
    }

    fn push(
        &mut self,
        by: String,
        mutant: &Mutant,
        outcome: &str,
        test: String,
    ) -> Result<(), String> {
        let (digest, key, outcome) = (self.digest.clone(), mutant.key(), outcome.to_owned());
        let line = Line {
            by,
            digest,
            key,
            outcome,
            test,
        };
        let text = serde_json::to_string(&line).map_err(|e| e.to_string())? + "\n";
        self.file
            .write_all(text.as_bytes())
            .map_err(|e| e.to_string())?;
        self.last.insert((line.by.clone(), line.key.clone()), line);
        Ok(())
    }
}
