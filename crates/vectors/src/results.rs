//! A results file: what a product answered to the tests, read and judged.

use super::answer::GivenAnswer;
use super::profile::{Answered, Profile, demanded, is_right};
use super::set::VectorTopic;
use super::test::VectorTest;
use super::verified::{JudgedAnswer, JudgedTest, TestAnswer, VerifyResult};
use crate::files::json;
use serde::de::IgnoredAny;
use std::collections::HashMap;

/// The answer in results to a test that the product was not asked.
const NOT_ASKED: &str = "\"not asked\"";

/// Why a results file cannot be judged.
#[derive(Debug)]
pub struct BadResults {
    /// Its line, counted from 1; none if it is about the whole file.
    pub line: Option<usize>,
    /// The fault, and what was expected.
    pub message: String,
}

/// Judges the text of a results file, by a specification or by what every reading of the vectors demands. `digest` is that of
/// the core set.
pub fn verify(
    text: &str,
    core: &[(VectorTopic, Vec<VectorTest>)],
    digest: &str,
    profile: Option<&Profile>,
) -> Result<VerifyResult, BadResults> {
    let results = Results::parse(text, digest)?;
    let mut answers = results.by_id()?;
    let mut judged = Vec::new();
    for (topic, tests) in core {
        for test in tests {
            let demanded = demanded(test, profile);
            let answer = match answers.remove(test.id.as_str()) {
                None => TestAnswer::Missing,
                Some(ReadAnswer { answer: None, .. }) => TestAnswer::NotAsked,
                Some(ReadAnswer {
                    answer: Some(answer),
                    text: value,
                }) => {
                    let judged = judge(test, demanded, &answer)
                        .map_err(|message| at(text, value, format!("{}: {message}", test.id)))?;
                    TestAnswer::Given(judged)
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
    if let Some((id, left)) = answers.iter().min_by_key(|(_, it)| it.text.as_ptr()) {
        let message = format!("no test of these vectors has the id {}", json::quoted(id));
        return Err(at(text, left.text, message));
    }
    Ok(VerifyResult::new(
        &results.product,
        &results.vectors,
        profile,
        &judged,
    ))
}

/// Judges one answer; an error if it is no answer to this test.
fn judge(
    test: &VectorTest,
    demanded: &str,
    answer: &GivenAnswer<'_>,
) -> Result<JudgedAnswer, String> {
    let answered = answer.answered;
    let fits = match answered {
        Answered::Single(_) => test.group.is_none(),
        Answered::Hits(hits) => test.group.is_some() && hits as usize <= test.triangles.len(),
    };
    let is_decision_right = is_right(demanded, answered)
        .filter(|_| fits)
        .ok_or_else(|| expected(test).to_owned())?;
    // The values of a wrong answer say nothing more.
    let wrong_values = answer.wrong_values(test)?.filter(|_| is_decision_right);
    Ok(JudgedAnswer {
        answered,
        right: is_decision_right && wrong_values.is_none(),
        wrong_values,
    })
}

/// The expected form of the answer to a test.
fn expected(test: &VectorTest) -> &'static str {
    match test.group {
        None => "expected \"hit\" or \"miss\", because the test has one triangle",
        Some(_) => "expected the number of its triangles that are hit, because the test is a group",
    }
}

/// An error about a part of the file's text.
fn at(text: &str, part: &str, message: String) -> BadResults {
    BadResults {
        line: Some(line_of(text, part)),
        message,
    }
}

/// The line of a part of a text, counted from 1.
fn line_of(text: &str, part: &str) -> usize {
    let offset = part.as_ptr() as usize - text.as_ptr() as usize;
    let before = &text.as_bytes()[..offset];
    before.iter().filter(|byte| **byte == b'\n').count() + 1
}

/// A results file.
struct Results<'a> {
    text: &'a str,
    vectors: String,
    product: String,
    answers: Vec<json::Field<'a>>,
}

/// The answer to a test as it was read.
struct ReadAnswer<'a> {
    /// None if the product was not asked.
    answer: Option<GivenAnswer<'a>>,
    /// Its part of the file.
    text: &'a str,
}

impl<'a> Results<'a> {
    fn parse(text: &'a str, digest: &str) -> Result<Results<'a>, BadResults> {
        // What is no JSON at all.
        serde_json::from_str::<IgnoredAny>(text).map_err(|error| BadResults {
            line: Some(error.line()),
            message: error.to_string(),
        })?;
        let whole = |message| BadResults {
            line: None,
            message,
        };
        let object =
            json::Object::parse(text, &["vectors", "product", "results"]).map_err(whole)?;
        let in_field = |field: &str, message: String| BadResults {
            line: object.get(field).map(|value| line_of(text, value)),
            message: format!("{field}: {message}"),
        };
        let string = |field: &str| {
            let value = object.required(field).map_err(whole)?;
            json::string(value).map_err(|message| in_field(field, message))
        };
        let (vectors, product) = (string("vectors")?, string("product")?);
        if vectors != digest {
            let found = json::quoted(&vectors);
            let message =
                format!("the results are of {found}, but this hairline has the vectors {digest}");
            return Err(in_field("vectors", message));
        }
        let answers = json::pairs(object.required("results").map_err(whole)?)
            .map_err(|message| in_field("results", message))?;
        Ok(Results {
            text,
            vectors,
            product,
            answers,
        })
    }

    /// The answers by the ids of their tests.
    fn by_id(&self) -> Result<HashMap<&str, ReadAnswer<'a>>, BadResults> {
        let mut answers = HashMap::new();
        for (id, value) in &self.answers {
            let answer = match *value {
                NOT_ASKED => None,
                value => Some(
                    GivenAnswer::parse(value)
                        .map_err(|message| at(self.text, value, format!("{id}: {message}")))?,
                ),
            };
            let read = ReadAnswer {
                answer,
                text: value,
            };
            if answers.insert(&**id, read).is_some() {
                return Err(at(self.text, value, format!("a second result of '{id}'")));
            }
        }
        Ok(answers)
    }
}
