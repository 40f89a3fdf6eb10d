//! `hairline vectors`: test vectors for programs that do not run hairline.

use super::exit::{Failure, Status};
use super::output::{write_result, write_results};
use super::progress::Progress;
use crate::engine;
use crate::vectors::{self, StoredCases, VectorTest, VectorTopic, csv, digest, json, numbered};
use clap::{Args, ValueEnum};
use std::collections::HashSet;
use std::fs;
use std::io::{self, Write};
use std::path::Path;

/// Which tests, and in what form.
#[derive(Args)]
pub struct VectorsArguments {
    /// The folder to write the core set to: JSON by topic, all in one CSV, and their digest
    #[arg(
        default_value = "vectors",
        value_name = "DIR",
        conflicts_with = "format"
    )]
    path: String,

    /// Write one file of this format instead
    #[arg(long, value_enum)]
    format: Option<VectorFormat>,

    /// The first N tests of the full set instead of the core set
    #[arg(short = 'n', long, value_name = "N", requires = "format", value_parser = clap::value_parser!(u64).range(1..=1 << 32))]
    count: Option<u64>,

    /// Where that file goes; - is standard output
    #[arg(
        short,
        long,
        default_value = "-",
        value_name = "FILE",
        requires = "format"
    )]
    output: String,
}

#[derive(Clone, Copy, ValueEnum)]
enum VectorFormat {
    /// A JSON object a line
    Json,
    /// A row a triangle
    Csv,
}

/// How many tests are made at a time: of those before, memory holds one number each.
const CHUNK: u64 = 1 << 13;

/// Runs the command.
pub fn run(arguments: &VectorsArguments) -> Result<Status, Failure> {
    match arguments.format {
        None => write_core(Path::new(&arguments.path))?,
        Some(format) => write_result(&arguments.output, |out| {
            if let VectorFormat::Csv = format {
                writeln!(out, "{}", csv::HEADER)?;
            }
            let Some(count) = arguments.count else {
                let mut tests = core_set().into_iter().flat_map(|(_, tests)| tests);
                return tests.try_for_each(|test| out.write_all(written(format, &test).as_bytes()));
            };
            write_numbered(
                out,
                format,
                count,
                &Progress::of_output(count, "tests", &arguments.output),
            )
        })?,
    }
    Ok(Status::Success)
}

/// The core set, with the stored cases of this repository.
pub fn core_set() -> Vec<(VectorTopic, Vec<VectorTest>)> {
    vectors::core(&StoredCases {
        curated: include_str!("../../corpora/curated.jsonl"),
        published: include_str!("../../corpora/published.jsonl"),
    })
}

fn write_core(folder: &Path) -> Result<(), Failure> {
    fs::create_dir_all(folder).map_err(|error| Failure::of_path(folder, &error))?;
    let topics = core_set();
    let mut files: Vec<(String, String)> = topics
        .iter()
        .map(|(topic, tests)| json::topic_file(topic, tests))
        .collect();
    let digest = digest(&files);
    let rows: String = topics
        .iter()
        .flat_map(|(_, tests)| tests)
        .map(csv::rows)
        .collect();
    files.push(("core.csv".to_owned(), format!("{}\n{rows}", csv::HEADER)));
    files.push(("sha256.txt".to_owned(), format!("{digest}\n")));
    let paths: Vec<String> = files
        .iter()
        .map(|(name, _)| folder.join(name).display().to_string())
        .collect();
    let outputs = files
        .iter()
        .map(|(_, text)| text)
        .zip(paths.iter().map(String::as_str));
    write_results(outputs.collect(), |text, _, out| {
        out.write_all(text.as_bytes())
    })?;
    let count: usize = topics.iter().map(|(_, tests)| tests.len()).sum();
    eprintln!(
        "{}: {count} tests in {} topics, SHA-256 {digest}",
        folder.display(),
        topics.len()
    );
    Ok(())
}

fn write_numbered(
    out: &mut dyn Write,
    format: VectorFormat,
    count: u64,
    progress: &Progress,
) -> io::Result<()> {
    // Some families make few cases, and make them again: a test of invalid input is NaN in all places.
    let mut seen: HashSet<u64> = HashSet::new();
    for start in (0..count).step_by(CHUNK as usize) {
        let numbers: Vec<u64> = (start..count.min(start + CHUNK)).collect();
        let tests = engine::map(&numbers, |n| {
            numbered(*n).map(|test| (test.number(), written(format, &test)))
        });
        for (number, text) in tests.into_iter().flatten() {
            if seen.insert(number) {
                out.write_all(text.as_bytes())?;
            }
        }
        progress.set(start);
    }
    Ok(())
}

fn written(format: VectorFormat, test: &VectorTest) -> String {
    match format {
        VectorFormat::Json => format!("{}\n", json::line(test)),
        VectorFormat::Csv => csv::rows(test),
    }
}
