//! The answers of a product, judged: as counts and a list, and as the record that every other format is made
//! from.

use super::values::WrongHit as WrongValues;
use crate::judge::{GroupTruth, Obligation};
use crate::report::page::{Block, Head, Item, Page, Paged, Row, Table, Tone};
use crate::report::{
    AnsweredTest, Asked, FORMATS as OF_RECORD, Format, Product, Promised, Record, Style, answered,
    number_of, write_json,
};
use crate::vectors::VectorTest;
use crate::vectors::profile::{Answered, Groups, Profile, Saying, demanded, is_right};
use serde::Serialize;
use std::io::{self, Write};

/// How many wrong answers the text shows.
const SHOWN: usize = 5;

/// One row per format: what people read and `json` are of the answers, the others of their record.
pub const FORMATS: &[Format<Judgement>] = &[
    Format::TEXT,
    Format { name: "json", write: |judgement, _, out| write_json(&judgement.report, out) },
    Format { name: "record", write: |judgement, _, out| write_json(&judgement.record, out) },
    Format { name: "junit", write: |judgement, style, out| judgement.write("junit", style, out) },
    Format { name: "sarif", write: |judgement, style, out| judgement.write("sarif", style, out) },
    Format::MARKDOWN,
    Format::HTML,
];

/// All answers of a product, judged: for people and as a record.
pub struct Judgement {
    pub report: VerifyReport,
    pub record: Record,
}

impl Judgement {
    fn write(&self, name: &str, style: Style, out: &mut dyn Write) -> io::Result<()> {
        let format = OF_RECORD.iter().find(|format| format.name == name);
        (format.expect("an audit's format").write)(&self.record, style, out)
    }
}

/// An answer that was judged.
pub struct JudgedAnswer<'a> {
    pub test: &'a VectorTest,
    pub demanded: &'static str,
    pub answer: Answered,
    pub right: bool,
    /// The wrong values of an answer that is otherwise right.
    pub wrong_values: Option<WrongValues>,
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

/// The report that `--format json` writes.
#[derive(Serialize)]
pub struct VerifyReport {
    product: String,
    vectors: String,
    profile: Option<String>,
    total: VerifyCounts,
    topics: Vec<(&'static str, VerifyCounts)>,
    wrong: Vec<WrongTest>,
    missing: Vec<String>,
    /// The ids of answers against what the profile's specification only advises: they are not wrong.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    unadvised: Vec<String>,
    /// The sentences of the profile's specification that make an answer wrong.
    sayings: Vec<Saying>,
}

#[derive(Clone, Copy, Default, Serialize)]
struct VerifyCounts {
    tests: usize,
    right: usize,
    wrong: usize,
    /// Answered, and free to be either.
    free: usize,
    missing: usize,
}

#[derive(Serialize)]
struct WrongTest {
    id: String,
    demanded: &'static str,
    answered: String,
    comment: String,
    /// The words of the profile that demand it; none if every reading does.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    demanded_by: Vec<&'static str>,
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
    pub fn report(&self) -> VerifyReport {
        let mut report = VerifyReport {
            product: self.product.to_owned(),
            vectors: self.vectors.to_owned(),
            profile: self.profile.map(|profile| profile.name.clone()),
            total: VerifyCounts::default(),
            topics: self.topics.iter().map(|topic| (topic.name, topic.counts())).collect(),
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
        let by_profile =
            |judged: &&JudgedAnswer| self.sayings_of(judged.test, judged.answer).is_empty();
        let mut wrong: Vec<&JudgedAnswer> = self.judged().filter(|judged| !judged.right).collect();
        wrong.sort_by_key(by_profile);
        for JudgedAnswer { test, demanded, answer, wrong_values, .. } in wrong {
            let sayings = match wrong_values {
                None => self.sayings_of(test, *answer),
                Some(_) => Vec::new(),
            };
            report.wrong.push(WrongTest {
                id: test.id.clone(),
                demanded,
                answered: match wrong_values {
                    None => answer.to_string(),
                    Some(wrong) => format!("{answer} with {}", wrong.text),
                },
                comment: test.comment.clone(),
                demanded_by: sayings.iter().map(|saying| saying.word).collect(),
            });
            let new = sayings.into_iter().filter(|saying| !report.sayings.contains(saying));
            report.sayings.extend(new.collect::<Vec<_>>());
        }
        report
    }

    /// The record, from which every other format is made.
    pub fn record(&self) -> Record {
        let tests: Vec<AnsweredTest> = self
            .topics
            .iter()
            .flat_map(|topic| topic.judged.iter().map(|judged| judged.answered(topic.name)))
            .collect();
        let count = self.topics.iter().map(|topic| topic.missing.len()).sum::<usize>() as u64;
        let missing = number_of(count, "test has", "tests have");
        let product = Product {
            name: self.product,
            judged_by: self.profile.map_or("vectors", |profile| &profile.name),
            contract: match self.profile {
                None => "the test vectors: hit or miss where every reading agrees".to_owned(),
                Some(profile) => format!("the test vectors by {}", profile.specification),
            },
            promised: match self.profile.map(Profile::of_groups) {
                Some(Groups::ExactlyOne) => Promised::ExactlyOne,
                Some(Groups::Parity) => Promised::Parity,
                None | Some(Groups::AtLeastOne | Groups::Free) => Promised::AtLeastOne,
            },
            note: (0 < count).then(|| format!("{missing} no result")),
        };
        answered(&product, &tests)
    }
}

impl JudgedAnswer<'_> {
    fn answered<'a>(&'a self, topic: &'a str) -> AnsweredTest<'a> {
        let asked = match (&self.test.group, self.demanded) {
            (None, "hit") => Asked::Single(Obligation::MustHit),
            (None, "miss") => Asked::Single(Obligation::MustMiss),
            (None, _) => Asked::Single(Obligation::Free),
            (Some(_), "exactly-one" | "at-least-one") => Asked::Group(GroupTruth::Crossing),
            (Some(_), word @ ("odd" | "even")) => {
                Asked::Group(GroupTruth::Fold { odd: word == "odd" })
            }
            (Some(_), _) => Asked::Group(GroupTruth::Free),
        };
        let hits = match self.answer {
            Answered::Single(hit) => usize::from(hit),
            Answered::Hits(hits) => hits as usize,
        };
        let values = self.wrong_values.as_ref().map(|wrong| (wrong.finding, wrong.edges));
        AnsweredTest { topic, test: self.test, asked, hits, values }
    }
}

impl TopicAnswers<'_> {
    fn counts(&self) -> VerifyCounts {
        let missing = self.missing.len();
        let mut counts =
            VerifyCounts { tests: self.judged.len() + missing, missing, ..VerifyCounts::default() };
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

impl Paged for Judgement {
    fn page(&self) -> Page {
        let VerifyReport { product, profile, total, topics, wrong, unadvised, sayings, .. } =
            &self.report;
        let VerifyCounts { tests, right, wrong: count, free, missing } = total;
        let answers = number_of(*count as u64, "wrong answer", "wrong answers");
        let by = profile.as_ref().map_or(String::new(), |name| format!(" by profile {name}"));
        let title = format!(
            "{}: {answers}, {right} right{by}; {free} free to be either, {missing} of {tests} tests without a result",
            product.escape_debug()
        );
        let row = |(name, counts): &(&'static str, VerifyCounts)| {
            let VerifyCounts { tests, right, wrong, free, missing } = *counts;
            let mut row =
                Row::new(*name, [tests, wrong, right, free, missing].map(|n| n.to_string()));
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
    fn item(&self) -> Item {
        let WrongTest { id, demanded, answered, comment, demanded_by } = self;
        let by = match demanded_by.is_empty() {
            true => String::new(),
            false => format!(" by '{}'", demanded_by.join("' and '")),
        };
        Item {
            text: format!("{id}: {answered}, expected {demanded}{by} ({comment})"),
            lines: vec![format!("hairline explain {id}")],
            ..Item::default()
        }
    }
}
