//! The program run as a user runs it, for the tests of several commands.

use serde_json::Value;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// A folder of its own for each test.
pub fn scratch(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).unwrap();
    folder
}

/// Runs the program in a folder with variables, away from those of the machine that count.
pub fn hairline_with(folder: &Path, arguments: &[&str], variables: &[(&str, &str)]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_hairline"))
        .args(arguments)
        .current_dir(folder)
        .env_remove("GITHUB_ACTIONS")
        .env_remove("GITHUB_STEP_SUMMARY")
        .env_remove("NO_COLOR")
        .envs(variables.iter().copied())
        .output()
        .unwrap()
}

/// Runs the program in a folder.
pub fn hairline(folder: &Path, arguments: &[&str]) -> Output {
    hairline_with(folder, arguments, &[])
}

/// Runs the program, expects an exit code, and returns both streams, standard output first.
pub fn ends(folder: &Path, arguments: &[&str], code: i32) -> (String, String) {
    let output = hairline(folder, arguments);
    let text = |bytes: &[u8]| String::from_utf8(bytes.to_vec()).unwrap();
    let (out, error) = (text(&output.stdout), text(&output.stderr));
    assert_eq!(
        output.status.code(),
        Some(code),
        "{arguments:?}\n{out}\n{error}"
    );
    (out, error)
}

/// The same; of text the words, whatever the lines were.
pub fn ends_flat(folder: &Path, arguments: &[&str], code: i32) -> (Flat, String) {
    let (out, error) = ends(folder, arguments, code);
    let is_text = !arguments.contains(&"--format") && !arguments.contains(&"-o");
    (Flat(if is_text { flat(&out) } else { out }), error)
}

/// What was printed, each word after one space.
#[derive(Debug)]
pub struct Flat(String);

impl Flat {
    /// True if these words stand in it, in other lines perhaps.
    pub fn contains(&self, part: impl AsRef<str>) -> bool {
        self.0.contains(part.as_ref()) || self.0.contains(&flat(part.as_ref()))
    }
}

impl Flat {
    /// The words.
    pub fn as_str(&self) -> &str {
        &self.0
    }
}

impl std::ops::Deref for Flat {
    type Target = str;

    fn deref(&self) -> &str {
        &self.0
    }
}

impl std::fmt::Display for Flat {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.0)
    }
}

/// A text's words, each after one space, whatever the lines were.
pub fn flat(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// A record that was changed, with the checksum of what it says now.
pub fn resealed(record: &str) -> String {
    let (head, rest) = record.split_once("\"result\": ").unwrap();
    let (result, rest) = rest.split_once(",\n  \"checksum\": \"").unwrap();
    let (_, tail) = rest.split_once('"').unwrap();
    let mut is_in_string = false;
    let mut is_escaped = false;
    let mut compact = String::with_capacity(result.len());
    for c in result.chars() {
        if is_in_string || !c.is_whitespace() {
            compact.push(c);
        }
        is_in_string ^= c == '"' && !is_escaped;
        is_escaped = c == '\\' && !is_escaped;
    }
    let digest = hmac_sha256::Hash::hash(compact.as_bytes());
    let checksum: String = digest.iter().map(|byte| format!("{byte:02x}")).collect();
    format!("{head}\"result\": {result},\n  \"checksum\": \"{checksum}\"{tail}")
}

/// A record with another value behind keys, each of which stands somewhere after the one before.
pub fn with_value(record: &str, keys: &[&str], value: &str) -> String {
    let mut start = 0;
    for key in keys {
        let quoted = format!("\"{key}\": ");
        start += record[start..].find(&quoted).unwrap() + quoted.len();
    }
    let line = record[start..].lines().next().unwrap();
    let end = start + line.trim_end_matches(',').len();
    format!("{}{value}{}", &record[..start], &record[end..])
}

/// A record's `result`, byte for byte.
pub fn result_bytes(file: &Path) -> String {
    #[derive(serde::Deserialize)]
    struct Parts {
        result: Box<serde_json::value::RawValue>,
    }
    let parts: Parts = serde_json::from_slice(&fs::read(file).unwrap()).unwrap();
    parts.result.get().to_owned()
}

/// The outcomes of a kernel at the `edges` or at the `vertices` of a mesh, from the record of `mesh` or of `audit --mesh`.
pub fn at_mesh<'a>(record: &'a Value, scalar: &str, kernel: &str, part: &str) -> &'a Value {
    let is_part = |result: &&Value| {
        let family = result["family"].as_str().unwrap();
        result["scalar"] == scalar
            && result["kernel"] == kernel
            && family.starts_with(&format!("mesh-{part}:"))
    };
    let results = record["result"]["results"].as_array().unwrap();
    &results
        .iter()
        .find(is_part)
        .unwrap_or_else(|| panic!("{kernel} at {part}"))["across"]
}
