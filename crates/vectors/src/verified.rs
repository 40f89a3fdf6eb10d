//! The answers of a product, judged: counts by topic, and a list of what is wrong.

use super::profile::{Answered, Profile, Saying, demanded, is_right};
use super::test::VectorTest;
use crate::audit::Trials;
use crate::record::{Comparable, NamedRate, Rate, Study, number_of};
use crate::report::page::{Block, Cell, Head, Item, Page, Paged, Row, Table, Tone};
use crate::report::{JunitCase, write_junit};
use std::collections::BTreeMap;
use std::io::{self, Write};

/// How many wrong answers the text shows.
const SHOWN: usize = 5;

/// A test of the vectors, and the product's answer to it.
pub struct JudgedTest<'a> {
    /// The name of the test's topic.
    pub topic: &'static str,
    pub test: &'a VectorTest,
    pub demanded: &'static str,
    pub answer: TestAnswer,
}

/// The answer of a product to a test, if there is one.
pub enum TestAnswer {
    /// Its results do not name the test.
    Missing,
    /// It was not asked: it has no doubles, or wants what the test does not have.
    NotAsked,
    /// An answer.
    Given(JudgedAnswer),
}

/// An answer that was judged.
pub struct JudgedAnswer {
    pub answered: Answered,
    pub right: bool,
    /// The fault in the values of an answer that is otherwise right, and the exact values.
    pub wrong_values: Option<String>,
}

/// The findings about a product.
#[apply(part!)]
#[derive(Default)]
pub struct VerifyResult {
    /// The product's name.
    product: String,
    /// SHA-256 of the vectors.
    vectors: String,
    /// The specification by whose answers it is judged; none if only what every reading demands counts.
    profile: Option<String>,
    /// All topics together.
    pub total: VerifyCounts,
    /// By topic, in the order of the vectors.
    topics: Vec<(String, VerifyCounts)>,
    /// The wrong answers.
    wrong: Vec<WrongTest>,
    /// The ids of tests without an answer.
    missing: Vec<String>,
    /// The ids of tests that the product was not asked.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    not_asked: Vec<String>,
    /// The ids of answers against what the profile's specification only advises: they are not wrong.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    unadvised: Vec<String>,
    /// The sentences of the profile's specification that make an answer wrong.
    sayings: Vec<Saying>,
}

/// How many tests.
#[apply(part!)]
#[derive(Copy, Default)]
pub struct VerifyCounts {
    /// In all.
    pub tests: u64,
    /// Answered as demanded.
    right: u64,
    /// Answered otherwise.
    pub wrong: u64,
    /// Answered, and free to be either.
    free: u64,
    /// Without an answer.
    pub missing: u64,
    /// Not asked, as the results say.
    #[serde(default)]
    pub not_asked: u64,
}

impl VerifyCounts {
    /// How many were answered.
    pub fn answered(&self) -> u64 {
        self.tests - self.missing - self.not_asked
    }
}

/// A wrong answer.
#[apply(part!)]
struct WrongTest {
    /// The test's id.
    id: String,
    /// Its topic.
    topic: String,
    /// The demand.
    demanded: String,
    /// The answer.
    answered: String,
    /// The test in words.
    comment: String,
    /// The words of the profile that demand it; none if every reading does.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    demanded_by: Vec<String>,
}

impl Comparable for VerifyResult {
    const STUDY: Study = Study::Verify;

    fn question(&self) -> String {
        let profile = self
            .profile
            .as_ref()
            .map_or(String::new(), |name| format!(" by {name}"));
        format!("vectors {}{profile}", self.vectors)
    }

    fn cases(&self) -> String {
        [&self.missing[..], &self.not_asked].concat().join(" ")
    }

    fn counted(&self) -> Vec<NamedRate> {
        let counted = |(topic, counts): &(String, VerifyCounts)| NamedRate {
            what: format!("{topic}: wrong answers"),
            rate: Rate::new(Trials::independent(counts.wrong, counts.answered()), false),
            command: self
                .wrong
                .iter()
                .find(|it| it.topic == *topic)
                .map(|it| explain(&it.id)),
        };
        self.topics.iter().map(counted).collect()
    }
}

/// The sentences that make an answer wrong that is not wrong by every reading.
fn sayings_of(profile: Option<&Profile>, test: &VectorTest, answered: Answered) -> Vec<Saying> {
    let profile = profile.filter(|_| is_right(demanded(test, None), answered) == Some(true));
    profile.map_or(Vec::new(), |profile| profile.sayings(test))
}

impl VerifyResult {
    /// Counts, wrong answers and missing ids of tests that lie by topic.
    pub fn new(
        product: &str,
        vectors: &str,
        profile: Option<&Profile>,
        tests: &[JudgedTest],
    ) -> VerifyResult {
        let mut report = VerifyResult {
            product: product.to_owned(),
            vectors: vectors.to_owned(),
            profile: profile.map(|profile| profile.name.clone()),
            ..VerifyResult::default()
        };
        let mut wrong = Vec::new();
        for JudgedTest {
            topic,
            test,
            demanded,
            answer,
        } in tests
        {
            report.count(topic, |counts| match answer {
                TestAnswer::Missing => &mut counts.missing,
                TestAnswer::NotAsked => &mut counts.not_asked,
                TestAnswer::Given(JudgedAnswer { right: false, .. }) => &mut counts.wrong,
                TestAnswer::Given(_) if *demanded == "free" => &mut counts.free,
                TestAnswer::Given(_) => &mut counts.right,
            });
            let JudgedAnswer {
                answered,
                right,
                wrong_values,
            } = match answer {
                TestAnswer::Given(answer) => answer,
                TestAnswer::Missing => {
                    report.missing.push(test.id.clone());
                    continue;
                }
                TestAnswer::NotAsked => {
                    report.not_asked.push(test.id.clone());
                    continue;
                }
            };
            if let Some(saying) = profile.and_then(|it| it.advice_against(test, *answered)) {
                report.unadvised.push(test.id.clone());
                report.say(vec![saying]);
            }
            if *right {
                continue;
            }
            let sayings = sayings_of(profile, test, *answered);
            let is_by_every_reading = sayings.is_empty();
            let (sayings, answered) = match wrong_values {
                None => (sayings, answered.to_string()),
                Some(wrong) => (Vec::new(), format!("{answered} with {wrong}")),
            };
            let test = WrongTest {
                id: test.id.clone(),
                topic: (*topic).to_owned(),
                demanded: (*demanded).to_owned(),
                answered,
                comment: test.comment.clone(),
                demanded_by: sayings.iter().map(|saying| saying.word.clone()).collect(),
            };
            wrong.push((is_by_every_reading, test, sayings));
        }
        // What only the profile demands comes first.
        wrong.sort_by_key(|(is_by_every_reading, ..)| *is_by_every_reading);
        for (_, test, sayings) in wrong {
            report.wrong.push(test);
            report.say(sayings);
        }
        report
    }

    /// Counts a test of a topic, and of all.
    fn count(&mut self, topic: &str, of: impl Fn(&mut VerifyCounts) -> &mut u64) {
        if self.topics.last().is_none_or(|(name, _)| name != topic) {
            self.topics
                .push((topic.to_owned(), VerifyCounts::default()));
        }
        let topic = self.topics.last_mut().map(|(_, counts)| counts);
        for counts in [&mut self.total].into_iter().chain(topic) {
            counts.tests += 1;
            *of(counts) += 1;
        }
    }

    /// Adds sentences, each once.
    fn say(&mut self, sayings: Vec<Saying>) {
        for saying in sayings {
            if !self.sayings.contains(&saying) {
                self.sayings.push(saying);
            }
        }
    }

    /// As JUnit: a test a topic.
    pub fn write_junit(&self, out: &mut dyn Write) -> io::Result<()> {
        write_junit(&self.suites(), out)
    }

    fn suites(&self) -> BTreeMap<String, BTreeMap<(String, String), JunitCase>> {
        let case = |(topic, _): &(String, VerifyCounts)| {
            let wrong = self.wrong.iter().filter(|wrong| wrong.topic == *topic);
            let failures = wrong
                .map(|wrong| (wrong.text(), explain(&wrong.id)))
                .collect();
            let name = (topic.clone(), "wrong-answer".to_owned());
            (
                name,
                JunitCase {
                    failures,
                    notes: Vec::new(),
                },
            )
        };
        [(self.product.clone(), self.topics.iter().map(case).collect())].into()
    }
}

impl Paged for VerifyResult {
    fn page(&self) -> Page {
        let VerifyResult {
            product,
            profile,
            total,
            topics,
            wrong,
            unadvised,
            sayings,
            ..
        } = self;
        let VerifyCounts {
            tests,
            right,
            wrong: count,
            free,
            missing,
            not_asked,
        } = total;
        let answers = number_of(*count, "wrong answer", "wrong answers");
        let by = profile
            .as_ref()
            .map_or(String::new(), |name| format!(" by profile {name}"));
        let asked = match not_asked {
            0 => String::new(),
            count => format!(", {count} not asked"),
        };
        let title = format!(
            "{}: {answers}, {right} right{by}; {free} free to be either, {missing} of {tests} tests without a result{asked}",
            product.escape_debug()
        );
        let row = |(name, counts): &(String, VerifyCounts)| {
            let VerifyCounts {
                tests,
                right,
                wrong,
                free,
                missing,
                not_asked,
            } = *counts;
            let numbers = [tests, wrong, right, free, missing, not_asked];
            let mut row = Row::new(name, numbers.map(Cell::count));
            row.cells[1].is_broken = 0 < wrong;
            row
        };
        let heads = [
            "topic",
            "tests",
            "wrong",
            "right",
            "free",
            "missing",
            "not asked",
        ]
        .map(Head::of);
        let mut blocks = vec![Block::Table(Table::new(
            heads.into(),
            topics.iter().map(row).collect(),
        ))];
        let wrong = wrong
            .iter()
            .map(|it| Item::shown_by(it.text(), explain(&it.id)));
        blocks.extend(Block::items("Wrong answers", SHOWN, wrong.collect()));
        let advised = unadvised.iter();
        let advised = advised.map(|id| Item::shown_by(id.clone(), explain(id)));
        blocks.extend(Block::items(
            "Against what the specification advises (a \"should\"), and so not wrong",
            SHOWN,
            advised.collect(),
        ));
        let saying = |Saying {
                          word,
                          section,
                          sentence,
                      }: &Saying| {
            let section = section
                .as_ref()
                .map_or(String::new(), |section| format!(" ({section})"));
            format!("'{word}'{section}: {sentence}")
        };
        if !sayings.is_empty() {
            blocks.push(Block::Heading(format!(
                "What profile {} says",
                profile.as_deref().unwrap_or_default()
            )));
            blocks.push(Block::Notes(sayings.iter().map(saying).collect()));
        }
        let tone = if *count == 0 { Tone::Good } else { Tone::Bad };
        Page {
            command: "verify",
            title,
            tone,
            blocks,
        }
    }
}

impl WrongTest {
    fn text(&self) -> String {
        let WrongTest {
            id,
            demanded,
            answered,
            comment,
            demanded_by,
            ..
        } = self;
        let by = match demanded_by.is_empty() {
            true => String::new(),
            false => format!(" by '{}'", demanded_by.join("' and '")),
        };
        format!("{id}: {answered}, expected {demanded}{by} ({comment})")
    }
}

/// The command that explains a test.
fn explain(id: &str) -> String {
    format!("hairline explain {id}")
}
