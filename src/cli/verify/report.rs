//! The answers of a product, judged: counts by topic, and a list of what is wrong.

use crate::audit::Trials;
use crate::report::page::{Block, Head, Item, Page, Paged, Row, Table, Tone};
use crate::report::{
    Comparable, Findings, Format, JunitCase, NamedRate, Rate, Record, Study, number_of, write_junit,
};
use crate::vectors::VectorTest;
use crate::vectors::profile::{Answered, Profile, Saying, demanded, is_right};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// How many wrong answers the text shows.
const SHOWN: usize = 5;

/// One row per format.
pub const FORMATS: &[Format<Record<VerifyResult>>] = &[
    Format::TEXT,
    Format::JSON,
    Format { name: "junit", write: |record, _, out| write_junit(&record.result.suites(), out) },
    Format::MARKDOWN,
    Format::HTML,
];

/// An answer that was judged.
pub struct JudgedAnswer<'a> {
    pub test: &'a VectorTest,
    pub demanded: &'static str,
    pub answer: Answered,
    pub right: bool,
    /// The fault in the values of an answer that is otherwise right, and the exact values.
    pub wrong_values: Option<String>,
}

/// All answers of a product, by topic.
pub struct Sheet<'a> {
    product: &'a str,
    vectors: &'a str,
    profile: Option<&'a Profile>,
    topics: Vec<TopicAnswers<'a>>,
}

/// The answers to a file of the vectors.
struct TopicAnswers<'a> {
    name: &'static str,
    judged: Vec<JudgedAnswer<'a>>,
    missing: Vec<&'a str>,
}

/// The findings about a product.
#[derive(Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct VerifyResult {
    /// The product's name.
    product: String,
    /// SHA-256 of the vectors.
    vectors: String,
    /// The specification by whose answers it is judged; none if only what every reading demands counts.
    profile: Option<String>,
    /// All topics together.
    total: VerifyCounts,
    /// By topic, in the order of the vectors.
    topics: Vec<(String, VerifyCounts)>,
    /// The wrong answers.
    wrong: Vec<WrongTest>,
    /// The ids of tests without an answer.
    missing: Vec<String>,
    /// The ids of answers against what the profile's specification only advises: they are not wrong.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    unadvised: Vec<String>,
    /// The sentences of the profile's specification that make an answer wrong.
    sayings: Vec<Saying>,
}

/// How many tests.
#[derive(Clone, Copy, Default, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
struct VerifyCounts {
    /// In all.
    tests: u64,
    /// Answered as demanded.
    right: u64,
    /// Answered otherwise.
    wrong: u64,
    /// Answered, and free to be either.
    free: u64,
    /// Without an answer.
    missing: u64,
}

/// A wrong answer.
#[derive(Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
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

impl Findings for VerifyResult {
    const STUDY: Study = Study::Verify;
}

impl Comparable for VerifyResult {
    fn question(&self) -> String {
        let profile = self.profile.as_ref().map_or(String::new(), |name| format!(" by {name}"));
        format!("vectors {}{profile}", self.vectors)
    }

    fn cases(&self) -> String {
        self.missing.join(" ")
    }

    fn counted(&self) -> Vec<NamedRate> {
        let counted = |(topic, counts): &(String, VerifyCounts)| NamedRate {
            what: format!("{topic}: wrong answers"),
            rate: Rate::new(
                Trials::independent(counts.wrong, counts.tests - counts.missing),
                false,
            ),
            command: self.wrong.iter().find(|wrong| wrong.topic == *topic).map(WrongTest::command),
        };
        self.topics.iter().map(counted).collect()
    }
}

impl<'a> Sheet<'a> {
    /// Without answers yet.
    pub fn new(product: &'a str, vectors: &'a str, profile: Option<&'a Profile>) -> Sheet<'a> {
        Sheet { product, vectors, profile, topics: Vec::new() }
    }

    /// Begins a topic.
    pub fn begin(&mut self, name: &'static str) {
        self.topics.push(TopicAnswers { name, judged: Vec::new(), missing: Vec::new() });
    }

    /// The demand of a test.
    pub fn demanded(&self, test: &VectorTest) -> &'static str {
        demanded(test, self.profile)
    }

    /// Adds an answer to the topic.
    pub fn add(&mut self, judged: JudgedAnswer<'a>) {
        self.topics.last_mut().expect("a topic was begun").judged.push(judged);
    }

    /// Adds a test without an answer to the topic.
    pub fn missing(&mut self, test: &'a VectorTest) {
        self.topics.last_mut().expect("a topic was begun").missing.push(&test.id);
    }

    /// True if there are no answers.
    pub fn is_empty(&self) -> bool {
        self.judged().next().is_none()
    }

    /// True if an answer is wrong.
    pub fn has_wrong(&self) -> bool {
        self.judged().any(|judged| !judged.right)
    }

    fn judged(&self) -> impl Iterator<Item = &JudgedAnswer<'a>> {
        self.topics.iter().flat_map(|topic| &topic.judged)
    }

    /// The sentences that make an answer wrong that is not wrong by every reading.
    fn sayings_of(&self, test: &VectorTest, answer: Answered) -> Vec<Saying> {
        let profile = self.profile.filter(|_| is_right(demanded(test, None), answer) == Some(true));
        profile.map_or(Vec::new(), |profile| profile.sayings(test))
    }

    /// Counts, wrong answers and missing ids.
    pub fn result(&self) -> VerifyResult {
        let mut report = VerifyResult {
            product: self.product.to_owned(),
            vectors: self.vectors.to_owned(),
            profile: self.profile.map(|profile| profile.name.clone()),
            total: VerifyCounts::default(),
            topics: self
                .topics
                .iter()
                .map(|topic| (topic.name.to_owned(), topic.counts()))
                .collect(),
            wrong: Vec::new(),
            missing: self
                .topics
                .iter()
                .flat_map(|topic| &topic.missing)
                .map(|id| id.to_string())
                .collect(),
            unadvised: Vec::new(),
            sayings: Vec::new(),
        };
        for JudgedAnswer { test, answer, .. } in self.judged() {
            let Some(profile) = self.profile else { break };
            let Some(saying) = profile.advice_against(test, *answer) else { continue };
            report.unadvised.push(test.id.clone());
            if !report.sayings.contains(&saying) {
                report.sayings.push(saying);
            }
        }
        report.topics.iter().for_each(|(_, counts)| report.total.add(counts));
        // What only the profile demands comes first.
        let judged = self
            .topics
            .iter()
            .flat_map(|topic| topic.judged.iter().map(move |judged| (topic.name, judged)));
        let mut wrong: Vec<_> = judged.filter(|(_, judged)| !judged.right).collect();
        wrong.sort_by_key(|(_, judged)| self.sayings_of(judged.test, judged.answer).is_empty());
        for (topic, JudgedAnswer { test, demanded, answer, wrong_values, .. }) in wrong {
            let sayings = match wrong_values {
                None => self.sayings_of(test, *answer),
                Some(_) => Vec::new(),
            };
            report.wrong.push(WrongTest {
                id: test.id.clone(),
                topic: topic.to_owned(),
                demanded: (*demanded).to_owned(),
                answered: match wrong_values {
                    None => answer.to_string(),
                    Some(wrong) => format!("{answer} with {wrong}"),
                },
                comment: test.comment.clone(),
                demanded_by: sayings.iter().map(|saying| saying.word.clone()).collect(),
            });
            let new = sayings.into_iter().filter(|saying| !report.sayings.contains(saying));
            report.sayings.extend(new.collect::<Vec<_>>());
        }
        report
    }
}

impl TopicAnswers<'_> {
    fn counts(&self) -> VerifyCounts {
        let missing = self.missing.len() as u64;
        let tests = self.judged.len() as u64 + missing;
        let mut counts = VerifyCounts { tests, missing, ..VerifyCounts::default() };
        for judged in &self.judged {
            match judged.right {
                false => counts.wrong += 1,
                true if judged.demanded == "free" => counts.free += 1,
                true => counts.right += 1,
            }
        }
        counts
    }
}

impl VerifyCounts {
    fn add(&mut self, other: &VerifyCounts) {
        self.tests += other.tests;
        self.right += other.right;
        self.wrong += other.wrong;
        self.free += other.free;
        self.missing += other.missing;
    }
}

impl VerifyResult {
    /// A test a topic.
    fn suites(&self) -> BTreeMap<String, BTreeMap<(String, String), JunitCase>> {
        let case = |(topic, _): &(String, VerifyCounts)| {
            let wrong = self.wrong.iter().filter(|wrong| wrong.topic == *topic);
            let failures = wrong.map(|wrong| (wrong.text(), wrong.command())).collect();
            let name = (topic.clone(), "wrong-answer".to_owned());
            (name, JunitCase { failures, notes: Vec::new() })
        };
        [(self.product.clone(), self.topics.iter().map(case).collect())].into()
    }
}

impl Paged for VerifyResult {
    fn page(&self) -> Page {
        let VerifyResult { product, profile, total, topics, wrong, unadvised, sayings, .. } = self;
        let VerifyCounts { tests, right, wrong: count, free, missing } = total;
        let answers = number_of(*count, "wrong answer", "wrong answers");
        let by = profile.as_ref().map_or(String::new(), |name| format!(" by profile {name}"));
        let title = format!(
            "{}: {answers}, {right} right{by}; {free} free to be either, {missing} of {tests} tests without a result",
            product.escape_debug()
        );
        let row = |(name, counts): &(String, VerifyCounts)| {
            let VerifyCounts { tests, right, wrong, free, missing } = *counts;
            let mut row =
                Row::new(name, [tests, wrong, right, free, missing].map(|n| n.to_string()));
            row.cells[1].is_broken = 0 < wrong;
            row
        };
        let heads = ["topic", "tests", "wrong", "right", "free", "missing"].map(Head::of);
        let mut blocks =
            vec![Block::Table(Table::new(heads.into(), topics.iter().map(row).collect()))];
        blocks.extend(Block::items(
            "Wrong answers",
            SHOWN,
            wrong.iter().map(WrongTest::item).collect(),
        ));
        let advised = unadvised.iter().map(|id| Item {
            text: id.clone(),
            lines: vec![format!("hairline explain {id}")],
            ..Item::default()
        });
        blocks.extend(Block::items(
            "Against what the specification advises (a \"should\"), and so not wrong",
            SHOWN,
            advised.collect(),
        ));
        let saying = |Saying { word, section, sentence }: &Saying| {
            let section = section.as_ref().map_or(String::new(), |section| format!(" ({section})"));
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
        Page { command: "verify", title, tone, blocks }
    }
}

impl WrongTest {
    fn text(&self) -> String {
        let WrongTest { id, demanded, answered, comment, demanded_by, .. } = self;
        let by = match demanded_by.is_empty() {
            true => String::new(),
            false => format!(" by '{}'", demanded_by.join("' and '")),
        };
        format!("{id}: {answered}, expected {demanded}{by} ({comment})")
    }

    fn command(&self) -> String {
        format!("hairline explain {}", self.id)
    }

    fn item(&self) -> Item {
        Item { text: self.text(), lines: vec![self.command()], ..Item::default() }
    }
}
