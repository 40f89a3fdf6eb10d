//! Opening what the user names: meshes, corpus files and folders, standard input.

use super::exit::{Failure, Status};
use super::progress::Progress;
use crate::audit::CorpusSet;
use crate::corpus::InputError;
use crate::corpus::lines::{self, AnyCase, StoredCase};
use crate::corpus::mesh::{Mesh, read_obj};
use crate::corpus::truth_json::TruthLine;
use crate::oracle;
use crate::report::{Record, SCHEMA, number_of};
use serde::Deserialize;
use std::fs::{self, File};
use std::io::{self, BufReader, Read};
use std::path::{Path, PathBuf};

/// Opens a file; `-` is standard input.
pub fn open(path: &str) -> Result<Box<dyn Read>, Failure> {
    if path == "-" {
        return Ok(Box::new(io::stdin()));
    }
    let failed = |error: io::Error| Failure::of_file(path, &error);
    let file = File::open(path).map_err(failed)?;
    if file.metadata().map_err(failed)?.is_dir() {
        return Err(Failure::of_file(path, &io::Error::from(io::ErrorKind::IsADirectory)));
    }
    Ok(Box::new(file))
}

/// Reads a text file whole.
pub fn read_text(path: &str) -> Result<String, Failure> {
    let mut bytes = Vec::new();
    open(path)?.read_to_end(&mut bytes).map_err(|error| Failure::of_file(path, &error))?;
    String::from_utf8(bytes).map_err(|error| {
        let before = &error.as_bytes()[..error.utf8_error().valid_up_to()];
        let line = before.iter().filter(|byte| **byte == b'\n').count() + 1;
        InputError::at(path, line, "not UTF-8").into()
    })
}

/// Reads a record. One of another version is refused as such.
pub fn read_record(path: &str) -> Result<Record, Failure> {
    #[derive(Deserialize)]
    struct Version {
        schema: String,
    }
    let text = read_text(path)?;
    let bad = |error: serde_json::Error| InputError::at(path, error.line(), error.to_string());
    let version: Version = serde_json::from_str(&text).map_err(bad)?;
    if version.schema != SCHEMA {
        let message = format!("a record of schema '{}', expected '{SCHEMA}'", version.schema);
        return Err(InputError::of(path, message).into());
    }
    Ok(serde_json::from_str(&text).map_err(bad)?)
}

/// Reads a mesh, with a progress bar for a large one, and prints its notes.
pub fn read_mesh(path: &str, quiet: bool) -> Result<Mesh, Failure> {
    let size = fs::metadata(path).map_or(0, |metadata| metadata.len());
    let progress = Progress::new(size, "bytes", quiet || size < 1 << 24);
    let mesh = read_obj(BufReader::new(open(path)?), path, &mut |bytes| progress.set(bytes));
    progress.finish();
    let mesh = mesh?;
    if !quiet {
        let triangles = number_of(mesh.triangles.len() as u64, "triangle", "triangles");
        let vertices = number_of(mesh.positions_f64.len() as u64, "vertex", "vertices");
        let groups = number_of(mesh.groups as u64, "group", "groups");
        eprintln!("{path}: {triangles}, {vertices}, {groups}");
        mesh.notes.iter().for_each(|note| eprintln!("{path}: {note}"));
    }
    Ok(mesh)
}

/// The corpus files of a path: itself, or the `.jsonl` files of a folder and its subfolders, in the
/// order of their names. Manifests are no cases.
pub fn corpus_files(path: &str) -> Result<Vec<String>, Failure> {
    let failed =
        |path: &Path, error: io::Error| Failure::of_file(&path.display().to_string(), &error);
    let root = PathBuf::from(path);
    if path == "-" || !fs::metadata(&root).map_err(|error| failed(&root, error))?.is_dir() {
        return Ok(vec![path.to_owned()]);
    }
    let (mut files, mut folders) = (Vec::new(), vec![root]);
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(&folder).map_err(|error| failed(&folder, error))? {
            let entry = entry.map_err(|error| failed(&folder, error))?.path();
            let is_manifest = entry.file_name().is_some_and(|name| name == super::corpus::MANIFEST);
            if entry.is_dir() {
                folders.push(entry);
            } else if entry.extension().is_some_and(|extension| extension == "jsonl")
                && !is_manifest
            {
                files.push(entry.display().to_string());
            }
        }
    }
    files.sort();
    if files.is_empty() {
        return Err(Failure::Message(
            Status::NothingSelected,
            format!("{path}: no .jsonl files in it"),
        ));
    }
    Ok(files)
}

/// The cases of a corpus file. Stored truths are checked: a wrong one is an error with its line.
pub fn read_corpus(file: &str) -> Result<Vec<StoredCase>, Failure> {
    lines::read(BufReader::new(open(file)?), file)
        .map(|stored| {
            let stored = stored?;
            if let Some(truth) = &stored.truth {
                let line = truth_line(&stored);
                truth.check(&line).map_err(|message| InputError::at(file, stored.line, message))?;
            }
            Ok(stored)
        })
        .collect::<Result<_, InputError>>()
        .map_err(Failure::from)
}

/// The truth of a stored case as the `truth` command prints it.
pub fn truth_line(stored: &StoredCase) -> TruthLine {
    let definition = match &stored.case {
        AnyCase::F32(case) => oracle::define(case),
        AnyCase::F64(case) => oracle::define(case),
    };
    TruthLine::new(stored.name.as_deref(), &definition.truth, &definition.exact)
}

/// The cases of a corpus file for a run; unnamed ones are called by file and line.
pub fn corpus_set(file: &str) -> Result<CorpusSet, Failure> {
    let mut set = CorpusSet { file: file.to_owned(), ..CorpusSet::default() };
    for stored in read_corpus(file)? {
        let name = name_of(&stored);
        match stored.case {
            AnyCase::F32(case) => set.f32.push((name, case)),
            AnyCase::F64(case) => set.f64.push((name, case)),
        }
    }
    Ok(set)
}

/// A stored case's name, or `line-N`.
pub fn name_of(stored: &StoredCase) -> String {
    stored.name.clone().unwrap_or_else(|| format!("line-{}", stored.line))
}
