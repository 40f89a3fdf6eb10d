//! `hairline verify`: what a product answered to the test vectors, judged.

mod report;
mod values;

use super::exit::{Failure, Status};
use super::flags::unknown;
use super::input::read_text;
use super::output::OutputArguments;
use crate::files::{InputError, json};
use crate::named_file::SizeLimit;
use crate::record::{Context, Record, provenance_of};
use crate::vectors::profile::{Answered, Profile, demanded, is_right};
use crate::vectors::{VectorTest, core, digest, json::topic_file};
use clap::Args;
pub use report::VerifyResult;
use report::{FORMATS, JudgedAnswer, JudgedTest, TestAnswer};
use serde::de::IgnoredAny;
use std::collections::HashMap;
use values::GivenAnswer;

/// The answer in results to a test that the product was not asked.
const NOT_ASKED: &str = "\"not asked\"";

/// Which results, and by what they are judged.
#[derive(Args)]
#[command(mut_arg("format", |format| {
    format.help(
        "text; json: every wrong answer and every missing id, which `hairline diff` compares; or junit, markdown or html; or \
         several separated by commas",
    )
}))]
pub struct VerifyArguments {
    /// The results file: {"vectors": SHA-256, "product": TEXT, "results": {ID: "hit", "miss" or, of a
    /// group, the number of hits}}; a hit may be {"hit": true, "t": 1.5, "u": 0.25, "v": 0.5}, whose values are
    /// compared with the exact ones; - is standard input
    #[arg(value_name = "RESULTS")]
    file: String,

    /// Demand what a specification demands where the vectors leave it free: dxr, parity, picking or
    /// vulkan
    #[arg(long, value_name = "NAME")]
    profile: Option<String>,

    #[command(flatten)]
    output: OutputArguments,
}

/// Runs the command.
pub fn run(arguments: &VerifyArguments) -> Result<Status, Failure> {
    let outputs = arguments.output.pairs(FORMATS)?;
    let found = |name: &String| {
        let wrong = || unknown("profile", name, Profile::names(), "hairline verify --help");
        Profile::find(name).ok_or_else(wrong)
    };
    let profile = arguments.profile.as_ref().map(found).transpose()?;
    let text = read_text(&arguments.file, SizeLimit::RECORD)?;
    let topics = core();
    let files: Vec<_> = topics
        .iter()
        .map(|(topic, tests)| topic_file(topic, tests))
        .collect();
    let read = Results::parse(&text, &digest(&files));
    let results = read.map_err(|(line, message)| InputError {
        line,
        ..InputError::of(&arguments.file, message)
    })?;
    let error = |value: &str, message: String| {
        InputError::at(&arguments.file, line_of(&text, value), message)
    };
    // None where the product was not asked.
    let mut answers: HashMap<&str, (Option<GivenAnswer>, &str)> = HashMap::new();
    for (id, value) in &results.answers {
        let answer = (*value != NOT_ASKED)
            .then(|| GivenAnswer::parse(value))
            .transpose();
        let answer = answer.map_err(|message| error(value, format!("{id}: {message}")))?;
        if answers.insert(id, (answer, value)).is_some() {
            return Err(error(value, format!("a second result of '{id}'")).into());
        }
    }
    let judge = |test: &VectorTest, demanded, (answer, value): (GivenAnswer, &str)| {
        let wrong = |message: &str| error(value, format!("{}: {message}", test.id));
        let answered = answer.answered;
        let fits = match answered {
            Answered::Single(_) => test.group.is_none(),
            Answered::Hits(hits) => test.group.is_some() && hits as usize <= test.triangles.len(),
        };
        let right = is_right(demanded, answered).filter(|_| fits);
        let right = right.ok_or_else(|| wrong(expected(test)))?;
        let wrong_values = answer
            .wrong_values(test)
            .map_err(|message| wrong(&message))?;
        let wrong_values = wrong_values.filter(|_| right);
        let right = right && wrong_values.is_none();
        Ok::<_, InputError>(JudgedAnswer {
            answered,
            right,
            wrong_values,
        })
    };
    let mut judged = Vec::new();
    for (topic, tests) in &topics {
        for test in tests {
            let demanded = demanded(test, profile.as_ref());
            let answer = match answers.remove(test.id.as_str()) {
                None => TestAnswer::Missing,
                Some((None, _)) => TestAnswer::NotAsked,
                Some((Some(answer), value)) => {
                    TestAnswer::Given(judge(test, demanded, (answer, value))?)
                }
            };
            judged.push(JudgedTest {
                topic: topic.name,
                test,
                demanded,
                answer,
            });
        }
    }
    if let Some((id, (_, value))) = answers.iter().min_by_key(|(_, (_, value))| value.as_ptr()) {
        let message = format!("no test of these vectors has the id {}", json::quoted(id));
        return Err(error(value, message).into());
    }
    let Results {
        product, vectors, ..
    } = &results;
    let result = VerifyResult::new([product, vectors], profile.as_ref(), &judged);
    let wrong = result.total.wrong;
    if result.total.answered() == 0 {
        let message = "it answers no test: all results are missing or \"not asked\"";
        return Err(Failure::nothing(format!("{}: {message}", arguments.file)));
    }
    let provenance = provenance_of(&Context {
        seconds: 0.0,
        threads: 1,
    });
    arguments
        .output
        .write(outputs, &Record::new(result, provenance).sealed())?;
    Ok(if 0 < wrong {
        Status::Disagreements
    } else {
        Status::Success
    })
}

/// The expected form of the answer to a test.
fn expected(test: &VectorTest) -> &'static str {
    match test.group {
        None => "expected \"hit\" or \"miss\", because the test has one triangle",
        Some(_) => "expected the number of its triangles that are hit, because the test is a group",
    }
}

/// The line of a part of a text, counted from 1.
fn line_of(text: &str, part: &str) -> usize {
    let offset = part.as_ptr() as usize - text.as_ptr() as usize;
    text.as_bytes()[..offset]
        .iter()
        .filter(|byte| **byte == b'\n')
        .count()
        + 1
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
        Ok(Results {
            vectors,
            product,
            answers,
        })
    }
}
