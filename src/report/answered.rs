//! The record of what a product answered to test vectors, from the answers that were judged one by one.

use super::build::{Context, across_part, counts, finding_part, provenance_of, severity_part};
use super::{
    Example, KernelResult, PlanPart, PlannedSource, Rate, Record, ResultPart, RowPart, RowTotal,
    SCHEMA, SourcePart, distribution,
};
use crate::arith::Float;
use crate::audit::{Digest, Judged, Place, Severities, Tally};
use crate::contract::{Across, Extent};
use crate::judge::{Class, Distances, Finding, GroupTruth, Obligation};
use crate::vectors::{CLOSED, DIGITS, PREFIX, Test};
use std::collections::BTreeMap;

/// How many examples of each finding a record keeps.
const EXAMPLES: usize = 3;

/// A test with an answer to it.
pub struct AnsweredTest<'a> {
    /// The topic of the test.
    pub topic: &'a str,
    /// What was asked.
    pub test: &'a Test,
    /// What is right.
    pub asked: Asked,
    /// How many of its triangles are hit, by the answer.
    pub hits: usize,
}

/// What is demanded of a test.
#[derive(Clone, Copy)]
pub enum Asked {
    /// Of a single triangle.
    Single(Obligation),
    /// Of triangles together.
    Group(GroupTruth),
}

/// What a product is, and what it was asked.
pub struct Product<'a> {
    /// Its name.
    pub name: &'a str,
    /// By what it is judged, in one word.
    pub judged_by: &'a str,
    /// The same in a sentence.
    pub contract: String,
    /// The SHA-256 of the vectors.
    pub vectors: &'a str,
    /// What should be known beside the answers.
    pub note: Option<String>,
}

/// Makes the record; the tests of a topic stand together.
pub fn answered(product: &Product, tests: &[AnsweredTest]) -> Record {
    let mut sets: Vec<Set> = Vec::new();
    for scalar in [f32::NAME, f64::NAME] {
        for tests in tests.chunk_by(|one, other| one.topic == other.topic) {
            let tests: Vec<&AnsweredTest> =
                tests.iter().filter(|answered| answered.test.scalar == scalar).collect();
            if !tests.is_empty() {
                sets.push(Set::new(scalar, tests));
            }
        }
    }
    let mut provenance = provenance_of(&Context { seconds: 0.0, threads: 1 });
    let notes = product.note.clone().map(|note| (product.name.to_owned(), vec![note]));
    provenance.kernel_notes = notes.into_iter().collect();
    Record {
        schema: SCHEMA.to_owned(),
        result: ResultPart {
            plan: product.plan(&sets),
            partial: None,
            sources: sets.iter().map(Set::source).collect(),
            results: sets.iter().map(|set| set.result(product)).collect(),
            totals: product.totals(&sets),
        },
        shard: None,
        conformance: None,
        illustrations: None,
        provenance,
    }
}

impl Product<'_> {
    fn plan(&self, sets: &[Set]) -> PlanPart {
        let row = RowPart {
            kernel: self.name.to_owned(),
            selector: String::new(),
            set: self.judged_by.to_owned(),
            epsilons: BTreeMap::new(),
            contract: self.contract.clone(),
            contract_words: "own".to_owned(),
        };
        let mut counts: BTreeMap<String, u64> = BTreeMap::new();
        sets.iter().for_each(|set| *counts.entry(set.name()).or_default() += set.count());
        let source = |(name, count): (String, u64)| PlannedSource {
            set: format!("{name}@{}", &self.vectors[..DIGITS]),
            family: name,
            count,
        };
        let mut scalars: Vec<String> = sets.iter().map(|set| set.scalar.to_owned()).collect();
        scalars.dedup();
        let sources = counts.into_iter().map(source).collect();
        PlanPart { hash: String::new(), rows: vec![row], sources, scalars }.hashed()
    }

    fn totals(&self, sets: &[Set]) -> Vec<RowTotal> {
        let of_scalar = |sets: &[Set]| {
            let mut all: BTreeMap<Finding, Severities> = BTreeMap::new();
            for (finding, more) in sets.iter().flat_map(|set| &set.tally.severities) {
                all.entry(*finding).or_default().merge(more);
            }
            RowTotal {
                scalar: sets[0].scalar.to_owned(),
                kernel: self.name.to_owned(),
                set: self.judged_by.to_owned(),
                severity: distribution::severities(&all),
                accuracy: BTreeMap::new(),
            }
        };
        sets.chunk_by(|one, other| one.scalar == other.scalar).map(of_scalar).collect()
    }
}

/// The answered tests of a topic in a scalar, added up.
struct Set<'a> {
    scalar: &'static str,
    tests: Vec<&'a AnsweredTest<'a>>,
    tally: Tally,
}

impl<'a> Set<'a> {
    fn new(scalar: &'static str, tests: Vec<&'a AnsweredTest<'a>>) -> Set<'a> {
        let mut tally = Tally::new(EXAMPLES, 0);
        for (index, answered) in (0..).zip(&tests) {
            match answered.asked {
                Asked::Single(obligation) => {
                    add(&mut tally, index, answered, obligation);
                }
                Asked::Group(truth) => {
                    let (cases, hits) = (0..answered.test.cases.len(), answered.hits);
                    tally.group(&Judged { index, cases, truth, hits, elsewhere: false });
                }
            }
        }
        Set { scalar, tests, tally }
    }

    /// The source's name.
    fn name(&self) -> String {
        format!("{PREFIX}{}", self.tests[0].topic)
    }

    fn count(&self) -> u64 {
        self.tests.len() as u64
    }

    fn source(&self) -> SourcePart {
        SourcePart {
            scalar: self.scalar.to_owned(),
            family: self.name(),
            sample: false,
            promises: false,
            indices: self.count(),
            cases: self.tests.iter().map(|answered| answered.test.cases.len() as u64).sum(),
            promise_broken: 0,
            first_broken: None,
        }
    }

    fn result(&self, product: &Product) -> KernelResult {
        let tally = &self.tally;
        let classes = Class::all()
            .filter(|class| 0 < tally.classes[class.number()].cases)
            .map(|class| (class.name(), counts(tally, Some(class), false)));
        let findings = tally.examples.iter().map(|((class, finding), examples)| {
            let rate = Rate::new(tally.trials(Some(class), finding), false);
            finding_part((class, finding), rate, examples, None, |place, severe| {
                example(self.tests[place.index as usize].test, severe)
            })
        });
        let has_groups = self.tests.iter().any(|answered| answered.test.group.is_some());
        let id = |index: u64| self.tests[index as usize].test.id.clone();
        KernelResult {
            scalar: self.scalar.to_owned(),
            kernel: product.name.to_owned(),
            set: product.judged_by.to_owned(),
            family: self.name(),
            total: counts(tally, None, false),
            classes: classes.collect(),
            findings: findings.collect(),
            severity: distribution::severities(&tally.severities),
            accuracy: BTreeMap::new(),
            across: has_groups.then(|| across_part(Across::ExactlyOne, &tally.groups, false, id)),
            polygons: None,
            self_hits: None,
        }
    }
}

/// Counts the answer to a test of one triangle.
fn add(tally: &mut Tally, index: u64, answered: &AnsweredTest, obligation: Obligation) {
    let truth = &answered.test.triangles[0].truth;
    let class = Class::of(truth);
    let hit = 0 < answered.hits;
    let count = &mut tally.classes[class.number()];
    count.ask(obligation, 1);
    count.hits += u64::from(hit);
    count.valued_hits += u64::from(hit && !class.is_invalid());
    let finding = match (obligation, hit) {
        (Obligation::MustHit, false) => Finding::FalseMiss,
        (Obligation::MustMiss, true) => Finding::FalseHit,
        _ => return,
    };
    let distances = (!class.is_invalid())
        .then(|| either_scalar!(&answered.test.cases[0], case => Distances::of(case, truth)));
    let severity =
        distances.map(|found| (found.nearest_change(truth, &CLOSED), found.edge_in_ulps));
    let place = Place { index, triangle: 0 };
    tally.find(class, finding, (place, Digest::hash(place)), severity);
}

/// A test of one triangle that was answered wrongly.
fn example(test: &Test, severe: bool) -> Example {
    let (bits, severity) = either_scalar!(&test.cases[0], case => (
        case.hex(),
        severe.then(|| severity_part(case, Extent::Interval)).flatten(),
    ));
    Example {
        case: test.id.clone(),
        bits,
        severity,
        command: format!("hairline explain '{}'", test.id),
    }
}
