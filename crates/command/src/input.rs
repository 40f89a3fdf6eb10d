//! Opening what the user names: meshes, corpus files and folders, standard input.

#![forbid(unsafe_code)]

use crate::audit::CorpusSet;
use crate::corpus::lines::{self, AnyCase, StoredCase};
use crate::descriptors;
use crate::exit::Failure;
use crate::files::InputError;
use crate::files::mesh::{self, Mesh};
use crate::named_file::{self, SizeLimit};
use crate::progress::Progress;
use crate::record::{Findings, Record, SCHEMA, Study, number_of};
use serde::Deserialize;
use std::collections::{HashMap, HashSet};
use std::fs;
use std::io::{self, BufReader, Read};
use std::path::{Path, PathBuf};

/// The manifest's name in a corpora folder.
pub const MANIFEST: &str = "manifest.jsonl";

/// Opens a file; `-` is standard input.
pub fn open(path: &str) -> Result<Box<dyn Read>, Failure> {
    let failed = |error: io::Error| Failure::of_file(path, &error);
    if path == "-" {
        descriptors::standard_input().map_err(failed)?;
        return Ok(Box::new(io::stdin()));
    }
    Ok(Box::new(named_file::open(Path::new(path)).map_err(failed)?))
}

/// Reads a text file whole.
pub fn read_text(path: &str, limit: SizeLimit) -> Result<String, Failure> {
    let bytes = named_file::read_within(open(path)?, limit);
    let bytes = bytes.map_err(|error| Failure::of_file(path, &error))?;
    String::from_utf8(bytes).map_err(|error| {
        let before = &error.as_bytes()[..error.utf8_error().valid_up_to()];
        let line = before.iter().filter(|byte| **byte == b'\n').count() + 1;
        InputError::at(path, line, "not UTF-8").into()
    })
}

/// The text of a record, whose study is known.
pub struct RecordText<'a> {
    path: &'a str,
    text: String,
    /// The study that it is of.
    pub study: Study,
}

impl<'a> RecordText<'a> {
    /// Opens a record. One of another version is refused as such.
    pub fn open(path: &'a str) -> Result<RecordText<'a>, Failure> {
        #[derive(Deserialize)]
        struct Envelope {
            schema: String,
            study: Option<Study>,
        }
        let text = read_text(path, SizeLimit::RECORD)?;
        let Envelope { schema, study } = from_json(path, &text)?;
        match study {
            Some(study) if schema == SCHEMA => Ok(RecordText { path, text, study }),
            _ => {
                let message = format!("a record of schema '{schema}', expected '{SCHEMA}'");
                Err(InputError::of(path, message).into())
            }
        }
    }

    /// Reads it, if it is of a study.
    pub fn read<R: Findings>(self) -> Result<Record<R>, Failure> {
        let RecordText { path, text, study } = self;
        let wrong = |message: String| InputError::of(path, message);
        let expected = R::STUDY;
        if study != expected {
            let message =
                format!("a record of `hairline {study}`, expected one of `hairline {expected}`");
            return Err(wrong(message).into());
        }
        let record: Record<R> = from_json(path, &text)?;
        record.check().map_err(wrong)?;
        Ok(record)
    }
}

/// A value of a file's JSON. An error has its line.
fn from_json<'a, T: Deserialize<'a>>(path: &str, text: &'a str) -> Result<T, InputError> {
    serde_json::from_str(text)
        .map_err(|error| InputError::at(path, error.line(), error.to_string()))
}

/// Reads the record of an audit.
pub fn read_record(path: &str) -> Result<Record, Failure> {
    RecordText::open(path)?.read()
}

/// Reads a mesh, with a progress bar for a large one, and prints its notes.
pub fn read_mesh(path: &str, quiet: bool) -> Result<Mesh, Failure> {
    let size = fs::metadata(path).map_or(0, |metadata| metadata.len());
    let progress = Progress::new(size, "bytes", quiet || size < 1 << 24);
    let file = BufReader::new(open(path)?);
    let mut file_beside = |name: &str, most: u64| {
        let file = named_file::open(&Path::new(path).with_file_name(name))?;
        let mut bytes = Vec::new();
        file.take(most).read_to_end(&mut bytes)?;
        Ok(bytes)
    };
    let mut advance = |bytes| progress.set(bytes);
    let read = mesh::read(file, path, &mut file_beside, &mut advance);
    progress.finish();
    let mesh = read?;
    if !quiet {
        let triangles = number_of(mesh.triangles.len() as u64, "triangle", "triangles");
        let vertices = number_of(mesh.positions_f64.len() as u64, "vertex", "vertices");
        let groups = number_of(mesh.groups as u64, "group", "groups");
        eprintln!("{path}: {triangles}, {vertices}, {groups}");
        for note in &mesh.notes {
            eprintln!("{path}: {note}");
        }
    }
    Ok(mesh)
}

/// The corpus files of a path: itself, or the `.jsonl` files of a folder and its subfolders, in the
/// order of their names. Manifests are no cases.
pub fn corpus_files(path: &str) -> Result<Vec<String>, Failure> {
    // The commands that repeat the name must not take it for a flag.
    let path = match path {
        "-" => return Ok(vec![path.to_owned()]),
        flag if flag.starts_with('-') => format!("./{flag}"),
        path => path.to_owned(),
    };
    let metadata = fs::metadata(&path).map_err(|error| Failure::of_file(&path, &error))?;
    if !metadata.is_dir() {
        return Ok(vec![path]);
    }
    let mut names = Vec::new();
    for file in files_under(Path::new(&path), |_| false)? {
        let is_manifest = file.file_name().is_some_and(|name| name == MANIFEST);
        let has_cases = file.extension().is_some_and(|end| end == "jsonl");
        if is_manifest || !has_cases {
            continue;
        }
        let Some(name) = file.to_str() else {
            let shown = file.display().to_string();
            return Err(InputError::of(&shown, "its name is not UTF-8").into());
        };
        names.push(name.to_owned());
    }
    if names.is_empty() {
        return Err(Failure::nothing(format!("{path}: no .jsonl files in it")));
    }
    Ok(names)
}

/// The files in a folder and its subfolders, each file once whatever links lead to it, in the
/// order of their names. A folder that is `whole` is taken as a file.
pub fn files_under(root: &Path, whole: impl Fn(&Path) -> bool) -> Result<Vec<PathBuf>, Failure> {
    let mut files = Vec::new();
    let mut seen = HashSet::new();
    let mut waiting = vec![root.to_owned()];
    // Links are followed last, so that a file goes by its own name if it has one here.
    let mut links = Vec::new();
    while let Some(path) = waiting.pop().or_else(|| links.pop()) {
        // A link that leads nowhere is an error once it is read.
        let real = fs::canonicalize(&path).unwrap_or_else(|_| path.clone());
        if !seen.insert(real) {
            continue;
        }
        if !path.is_dir() || whole(&path) {
            files.push(path);
            continue;
        }
        let mut inside = paths_in(&path).map_err(|error| Failure::of_path(&path, &error))?;
        inside.sort();
        for path in inside.into_iter().rev() {
            if path.is_symlink() {
                links.push(path);
            } else {
                waiting.push(path);
            }
        }
    }
    files.sort();
    Ok(files)
}

fn paths_in(folder: &Path) -> io::Result<Vec<PathBuf>> {
    let entries = fs::read_dir(folder)?;
    entries.map(|entry| Ok(entry?.path())).collect()
}

/// The cases of a corpus file. A stored truth that is wrong is an error with its line, and so is a
/// second case of a name.
pub fn read_corpus(file: &str) -> Result<Vec<StoredCase>, Failure> {
    let mut lines_of_names = HashMap::new();
    let mut cases = Vec::new();
    for stored in lines::read(BufReader::new(open(file)?), file) {
        let stored = stored?;
        let wrong = |message: String| InputError::at(file, stored.line, message);
        let name = name_of(&stored);
        if let Some(first) = lines_of_names.insert(name.clone(), stored.line) {
            let why = match stored.name {
                Some(_) => "",
                None => " (a case without a name is called line-N)",
            };
            let message = format!(
                "a second case called '{name}', as that of line {first} is{why}: give each a name of its own"
            );
            return Err(wrong(message).into());
        }
        if let Some(truth) = &stored.truth {
            let line = stored.truth_line(truth.has_fractions());
            truth.check(&line).map_err(wrong)?;
        }
        cases.push(stored);
    }
    Ok(cases)
}

/// The cases of a corpus file for a run, as two sets: first the ordinary ones, then those whose rays start on their
/// triangle. Either may be empty.
pub fn corpus_sets(file: &str) -> Result<[CorpusSet; 2], Failure> {
    let set = |is_secondary| CorpusSet {
        file: file.to_owned(),
        is_secondary,
        ..CorpusSet::default()
    };
    let mut sets = [set(false), set(true)];
    for stored in read_corpus(file)? {
        let set = &mut sets[usize::from(stored.is_secondary)];
        let name = name_of(&stored);
        match stored.case {
            AnyCase::F32(case) => set.f32.push((name, case)),
            AnyCase::F64(case) => set.f64.push((name, case)),
        }
    }
    Ok(sets)
}

/// A stored case's name, or `line-N`.
pub fn name_of(stored: &StoredCase) -> String {
    match &stored.name {
        Some(name) => name.clone(),
        None => format!("line-{}", stored.line),
    }
}
