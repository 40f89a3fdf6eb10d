//! An edition: one JSON file for each entrant, one table made of them in three formats, what changed since the edition
//! before, and, once it is frozen, a manifest with the hash of every file. A frozen edition is never edited, only superseded.

mod audit;
mod changes;
mod tables;

pub use audit::{Depth, EntrantResult, GROUPS, ScalarResult, Share, half_of_digits};
pub use changes::changes;
pub use tables::{CAPTION, HEAD, html, latex, markdown, rows};

use hmac_sha256::Hash;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

/// The hashes of a frozen edition, its file `manifest.json`.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Manifest {
    pub edition: String,
    /// SHA-256 in hexadecimal, by the path inside the edition's folder.
    pub sha256: BTreeMap<String, String>,
}

impl Manifest {
    /// Of the files that are there now.
    pub fn of(folder: &Path) -> Result<Manifest, String> {
        let edition = folder
            .file_name()
            .ok_or("an edition is a folder")?
            .to_string_lossy();
        let mut sha256 = BTreeMap::new();
        for path in files(folder)? {
            let name = path
                .strip_prefix(folder)
                .expect("below it")
                .to_string_lossy()
                .into_owned();
            if name != MANIFEST {
                let bytes =
                    fs::read(&path).map_err(|error| format!("{}: {error}", path.display()))?;
                let hash = Hash::hash(&bytes)
                    .iter()
                    .map(|byte| format!("{byte:02x}"))
                    .collect();
                sha256.insert(name, hash);
            }
        }
        Ok(Manifest {
            edition: edition.into_owned(),
            sha256,
        })
    }

    /// The one that was written when the edition was frozen; none if it is not.
    pub fn stored(folder: &Path) -> Result<Option<Manifest>, String> {
        let path = folder.join(MANIFEST);
        match path.exists() {
            true => read(&path).map(Some),
            false => Ok(None),
        }
    }
}

/// The name of the file with the hashes.
pub const MANIFEST: &str = "manifest.json";

/// The names of the editions in a folder, the newest last.
pub fn names(folder: &Path) -> Result<Vec<String>, String> {
    let wrong = |error: std::io::Error| format!("{}: {error}", folder.display());
    let mut names = Vec::new();
    for entry in fs::read_dir(folder).map_err(wrong)? {
        names.push(
            entry
                .map_err(wrong)?
                .file_name()
                .to_string_lossy()
                .into_owned(),
        );
    }
    names.sort_by_key(|name| (name.len(), name.clone()));
    Ok(names)
}

/// The results of an edition, in the order of the entrants.
pub fn results(folder: &Path) -> Result<Vec<EntrantResult>, String> {
    let mut results: Vec<EntrantResult> = files(&folder.join("entrants"))?
        .iter()
        .map(|path| read(path))
        .collect::<Result<_, _>>()?;
    let entrants = crate::entrants();
    results.sort_by_key(|result| entrants.iter().position(|e| e.name == result.kernel));
    Ok(results)
}

/// A JSON file.
pub fn read<T: serde::de::DeserializeOwned>(path: &Path) -> Result<T, String> {
    let wrong = |error: &dyn std::fmt::Display| format!("{}: {error}", path.display());
    let text = fs::read_to_string(path).map_err(|error| wrong(&error))?;
    serde_json::from_str(&text).map_err(|error| wrong(&error))
}

/// Every file below a folder, by path.
fn files(folder: &Path) -> Result<Vec<PathBuf>, String> {
    let wrong = |error: std::io::Error| format!("{}: {error}", folder.display());
    let mut found = Vec::new();
    for entry in fs::read_dir(folder).map_err(wrong)? {
        let path = entry.map_err(wrong)?.path();
        match path.is_dir() {
            true => found.extend(files(&path)?),
            false => found.push(path),
        }
    }
    found.sort();
    Ok(found)
}
