//! `hairline verify`: what a product answered to the test vectors, judged.

use super::exit::{Failure, Status};
use super::flags::unknown;
use super::input::read_text;
use super::output::write_result;
use crate::corpus::{InputError, json};
use crate::report::{number_of, write_json};
use crate::vectors::profile::{Answered, Profile, demanded, is_right};
use crate::vectors::{Test, core, digest, json::topic_file};
use clap::{Args, ValueEnum};
use serde::de::IgnoredAny;
use std::collections::HashMap;
use std::io::{self, Write};

/// Which results, and by what they are judged.
#[derive(Args)]
pub struct VerifyArguments {
    /// The results file: {"vectors": SHA-256, "product": TEXT, "results": {ID: "hit", "miss" or, of a
    /// group, the number of hits}}; - is standard input
    #[arg(value_name = "RESULTS")]
    file: String,

    /// Demand what a specification demands where the vectors leave it free: dxr, parity, picking or
    /// vulkan
    #[arg(long, value_name = "NAME")]
    profile: Option<String>,

    /// The report
    #[arg(long, value_enum, default_value = "text")]
    format: Format,

    /// Where to write; - is standard output
    #[arg(short, long, default_value = "-", value_name = "FILE")]
    output: String,
}

#[derive(Clone, Copy, PartialEq, ValueEnum)]
enum Format {
    /// For people: counts by topic, and the first wrong answers
    Text,
    /// Every wrong answer and every missing id
    Json,
}

/// How many wrong answers the text shows.
const SHOWN: usize = 20;

/// The answers of a product, compared.
#[derive(Default, serde::Serialize)]
struct Report<'a> {
    product: String,
    vectors: String,
    profile: Option<&'a str>,
    total: Counts,
    topics: Vec<(&'a str, Counts)>,
    wrong: Vec<Wrong<'a>>,
    missing: Vec<&'a str>,
}

#[derive(Clone, Copy, Default, serde::Serialize)]
struct Counts {
    tests: usize,
    right: usize,
    wrong: usize,
    /// Answered, and free to be either.
    free: usize,
    missing: usize,
}

#[derive(serde::Serialize)]
struct Wrong<'a> {
    id: &'a str,
    demanded: &'a str,
    answered: String,
    comment: &'a str,
}

/// Runs the command.
pub fn run(arguments: &VerifyArguments) -> Result<Status, Failure> {
    let profile =
        match arguments.profile.as_deref() {
            None => None,
            Some(name) => Some(Profile::find(name).ok_or_else(|| {
                unknown("profile", name, Profile::names(), "hairline verify --help")
            })?),
        };
    let text = read_text(&arguments.file)?;
    let topics = core();
    let files: Vec<_> = topics.iter().map(|(topic, tests)| topic_file(topic, tests)).collect();
    let read = Results::parse(&text, &digest(&files));
    let results = read.map_err(|(line, message)| InputError {
        line,
        ..InputError::of(&arguments.file, message)
    })?;
    let mut answers: HashMap<&str, (Answered, &str)> = HashMap::new();
    for (id, value) in &results.answers {
        let error = |message| InputError::at(&arguments.file, line_of(&text, value), message);
        let answer = answered(value).map_err(|message| error(format!("{id}: {message}")))?;
        if answers.insert(id, (answer, value)).is_some() {
            return Err(error(format!("a second result of '{id}'")).into());
        }
    }
    let mut report = Report {
        product: results.product,
        vectors: results.vectors,
        profile: profile.as_ref().map(|profile| profile.name.as_str()),
        ..Report::default()
    };
    for (topic, tests) in &topics {
        let mut counts = Counts { tests: tests.len(), ..Counts::default() };
        for test in tests {
            let Some((answer, value)) = answers.remove(test.id.as_str()) else {
                counts.missing += 1;
                report.missing.push(&test.id);
                continue;
            };
            let demanded = demanded(test, profile.as_ref());
            let fits = match answer {
                Answered::Single(_) => test.group.is_none(),
                Answered::Hits(hits) => {
                    test.group.is_some() && hits as usize <= test.triangles.len()
                }
            };
            match is_right(demanded, answer).filter(|_| fits) {
                Some(true) if demanded == "free" => counts.free += 1,
                Some(true) => counts.right += 1,
                Some(false) => {
                    counts.wrong += 1;
                    report.wrong.push(Wrong {
                        id: &test.id,
                        demanded,
                        answered: value.trim_matches('"').to_owned(),
                        comment: &test.comment,
                    });
                }
                None => {
                    let line = line_of(&text, value);
                    let message = format!("{}: {}", test.id, expected(test));
                    return Err(InputError::at(&arguments.file, line, message).into());
                }
            }
        }
        report.total.add(&counts);
        report.topics.push((topic.name, counts));
    }
    if let Some((id, (_, value))) = answers.iter().min_by_key(|(_, (_, value))| value.as_ptr()) {
        let message = format!("no test of these vectors has the id {}", json::quoted(id));
        return Err(InputError::at(&arguments.file, line_of(&text, value), message).into());
    }
    if report.total.missing == report.total.tests {
        let message = format!("{}: no results in it", arguments.file);
        return Err(Failure::Message(Status::NothingSelected, message));
    }
    write_result(&arguments.output, |out| match arguments.format {
        Format::Text => report.write_text(out),
        Format::Json => write_json(&report, out),
    })?;
    Ok(if report.wrong.is_empty() { Status::Success } else { Status::Disagreements })
}

/// What the answer to a test looks like.
fn expected(test: &Test) -> &'static str {
    match test.group {
        None => "expected \"hit\" or \"miss\", because the test has one triangle",
        Some(_) => "expected the number of its triangles that are hit, because the test is a group",
    }
}

fn answered(value: &str) -> Result<Answered, String> {
    match value {
        "\"hit\"" => Ok(Answered::Single(true)),
        "\"miss\"" => Ok(Answered::Single(false)),
        other => other.parse().map(Answered::Hits).map_err(|_| {
            format!(
                "expected \"hit\", \"miss\" or a number of hits, found {}",
                json::excerpt(other)
            )
        }),
    }
}

/// The line of a part of a text, counted from 1.
fn line_of(text: &str, part: &str) -> usize {
    let offset = part.as_ptr() as usize - text.as_ptr() as usize;
    text.as_bytes()[..offset].iter().filter(|byte| **byte == b'\n').count() + 1
}

/// A results file.
struct Results<'a> {
    vectors: String,
    product: String,
    answers: Vec<json::Field<'a>>,
}

impl<'a> Results<'a> {
    /// An error comes with its line, if it is about one.
    fn parse(text: &'a str, digest: &str) -> Result<Results<'a>, (Option<usize>, String)> {
        // What is no JSON at all.
        serde_json::from_str::<IgnoredAny>(text)
            .map_err(|error| (Some(error.line()), error.to_string()))?;
        let object = json::Object::parse(text, &["vectors", "product", "results"]);
        let object = object.map_err(|message| (None, message))?;
        let at = |field: &str, message: String| {
            let line = object.get(field).map(|value| line_of(text, value));
            (line, format!("{field}: {message}"))
        };
        let required = |field: &str| object.required(field).map_err(|message| (None, message));
        let string =
            |field: &str| json::string(required(field)?).map_err(|message| at(field, message));
        let (vectors, product) = (string("vectors")?, string("product")?);
        if vectors != digest {
            let found = json::quoted(&vectors);
            let message =
                format!("the results are of {found}, but this hairline has the vectors {digest}");
            return Err(at("vectors", message));
        }
        let answers = json::pairs(required("results")?);
        let answers = answers.map_err(|message| at("results", message))?;
        Ok(Results { vectors, product, answers })
    }
}

impl Counts {
    fn add(&mut self, other: &Counts) {
        self.tests += other.tests;
        self.right += other.right;
        self.wrong += other.wrong;
        self.free += other.free;
        self.missing += other.missing;
    }
}

impl Report<'_> {
    fn write_text(&self, out: &mut dyn Write) -> io::Result<()> {
        let Counts { tests, right, wrong, free, missing } = self.total;
        let answers = number_of(wrong as u64, "wrong answer", "wrong answers");
        write!(out, "{}: {answers}, {right} right", self.product.escape_debug())?;
        if let Some(profile) = self.profile {
            write!(out, " by profile {profile}")?;
        }
        writeln!(out, "; {free} free to be either, {missing} of {tests} tests without a result\n")?;
        let head = ["topic", "tests", "wrong", "right", "free", "missing"];
        let [topic, rest @ ..] = head;
        writeln!(out, "{topic:<14}{}", rest.map(|word| format!("{word:>8}")).concat())?;
        for (name, Counts { tests, right, wrong, free, missing }) in &self.topics {
            let numbers = [tests, wrong, right, free, missing].map(|n| format!("{n:>8}")).concat();
            writeln!(out, "{name:<14}{numbers}")?;
        }
        if !self.wrong.is_empty() {
            writeln!(out)?;
        }
        for Wrong { id, demanded, answered, comment } in self.wrong.iter().take(SHOWN) {
            writeln!(out, "{id}: {answered}, expected {demanded} ({comment})")?;
        }
        let more = self.wrong.len().saturating_sub(SHOWN);
        if 0 < more {
            writeln!(out, "... and {more} more: --format json has them all")?;
        }
        Ok(())
    }
}
