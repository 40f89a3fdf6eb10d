//! The record of what a product answered to test vectors, from the answers that were judged one by one.

use super::build::{Context, across_part, counts, finding_part, provenance_of, severity_part};
use super::{
    AcrossPart, Example, KernelResult, PlanPart, PlannedSource, Promised, Rate, Record, ResultPart,
    RowPart, RowTotal, SourcePart, distribution,
};
use crate::arith::Float;
use crate::audit::{CasePlace, Digest, JudgedGroup, Severities, Tally, exact_severity};
use crate::contract::Extent;
use crate::corpus::hex;
use crate::judge::{Class, Distances, Finding, GroupTruth, Obligation};
use crate::vectors::{CLOSED, PREFIX, VectorTest};
use hmac_sha256::Hash;
use std::collections::BTreeMap;

/// How many examples of each finding a record keeps.
const EXAMPLES: usize = 3;

/// A test with an answer to it.
pub struct AnsweredTest<'a> {
    /// The topic of the test.
    pub topic: &'a str,
    /// The test.
    pub test: &'a VectorTest,
    /// The demand of the test.
    pub asked: Asked,
    /// How many of its triangles are hit, by the answer.
    pub hits: usize,
    /// The fault in a hit whose values are wrong, and how far the point is off in longest edges.
    pub values: Option<(Finding, f64)>,
}

impl AnsweredTest<'_> {
    /// A triangle that every reading misses, of a group of which every reading hits one.
    fn surely_missed(&self) -> Option<u32> {
        let one = self.test.group.is_some_and(|group| group.counts == [1, 1]);
        let mut triangles = (0..).zip(&self.test.triangles).filter(|_| one);
        triangles.find(|(_, triangle)| triangle.closed() == Obligation::MustMiss).map(|(i, _)| i)
    }
}

/// The demand of a test.
#[derive(Clone, Copy)]
pub enum Asked {
    /// The demand on a single triangle.
    Single(Obligation),
    /// The demand on triangles together.
    Group(GroupTruth),
}

/// A product, and the demand that it was asked to meet.
pub struct Product<'a> {
    /// Its name.
    pub name: &'a str,
    /// By what it is judged, in one word.
    pub judged_by: &'a str,
    /// The same in a sentence.
    pub contract: String,
    /// The demand on every group.
    pub promised: Promised,
    /// A note besides the answers.
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
                sets.push(Set::new(scalar, tests, product.promised));
            }
        }
    }
    let mut provenance = provenance_of(&Context { seconds: 0.0, threads: 1 });
    let notes = product.note.clone().map(|note| (product.name.to_owned(), vec![note]));
    provenance.kernel_notes = notes.into_iter().collect();
    let result = ResultPart {
        plan: product.plan(&sets),
        partial: None,
        sources: sets.iter().map(Set::source).collect(),
        results: sets.iter().map(|set| set.result(product)).collect(),
        totals: product.totals(&sets),
    };
    Record::new(result, provenance).sealed()
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
        let mut answered: BTreeMap<String, Vec<&str>> = BTreeMap::new();
        for set in sets {
            let ids = set.tests.iter().map(|answered| answered.test.id.as_str());
            answered.entry(set.name()).or_default().extend(ids);
        }
        // Without an answer a test is no case of the source: two records are of the same cases if the ids are.
        let source = |(name, ids): (String, Vec<&str>)| PlannedSource {
            set: format!("{name}@{}", hex(&Hash::hash(ids.join(" ").as_bytes())[..8])),
            family: name,
            count: ids.len() as u64,
        };
        let mut scalars: Vec<String> = sets.iter().map(|set| set.scalar.to_owned()).collect();
        scalars.dedup();
        let sources = answered.into_iter().map(source).collect();
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
    fn new(scalar: &'static str, tests: Vec<&'a AnsweredTest<'a>>, promised: Promised) -> Set<'a> {
        let mut tally = Tally::new(EXAMPLES, 0);
        for (index, answered) in (0..).zip(&tests) {
            let hit = 0 < answered.hits;
            match answered.asked {
                Asked::Single(obligation) => {
                    add(&mut tally, CasePlace { index, triangle: 0 }, answered, (obligation, hit));
                }
                Asked::Group(truth) => {
                    // Where one hit is right by every reading, a second is on a triangle that must be missed.
                    let must_miss =
                        answered.surely_missed().filter(|_| promised == Promised::AtLeastOne);
                    if let Some(triangle) = must_miss {
                        let asked = (Obligation::MustMiss, 1 < answered.hits);
                        add(&mut tally, CasePlace { index, triangle }, answered, asked);
                    }
                    let hits = answered.hits;
                    tally.group(&JudgedGroup { index, truth, hits, elsewhere: false });
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
            left_out: None,
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
                example(self.tests[place.index as usize].test, place.triangle as usize, severe)
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
            across: has_groups.then(|| {
                let part = across_part(product.promised, &tally.groups, false, id);
                AcrossPart { missed_folds: Rate::default(), ..part }
            }),
            polygons: None,
            self_hits: None,
        }
    }
}

/// Counts an answer on one triangle: what was asked, and whether it is hit.
fn add(
    tally: &mut Tally,
    place: CasePlace,
    answered: &AnsweredTest,
    (obligation, hit): (Obligation, bool),
) {
    let triangle = place.triangle as usize;
    let truth = &answered.test.triangles[triangle].truth;
    let class = Class::of(truth);
    let count = &mut tally.classes[class.number()];
    count.ask(obligation, 1);
    count.hits += u64::from(hit);
    count.valued_hits += u64::from(hit && !class.is_invalid());
    let finding = match (obligation, hit) {
        (Obligation::MustHit, false) => Finding::FalseMiss,
        (Obligation::MustMiss, true) => Finding::FalseHit,
        _ => match answered.values {
            Some((finding, _)) => finding,
            None => return,
        },
    };
    let distances = (!class.is_invalid()).then(
        || either_scalar!(&answered.test.cases[triangle], case => Distances::of(case, truth)),
    );
    let severity = distances.map(|found| {
        let off = answered.values.map(|(_, edges)| edges);
        (off.unwrap_or_else(|| found.nearest_change(truth, &CLOSED)), found.edge_in_ulps)
    });
    tally.find(class, finding, (place, Digest::hash(place)), severity);
}

/// A triangle of a test that was answered wrongly.
fn example(test: &VectorTest, triangle: usize, severe: bool) -> Example {
    let (bits, severity) = either_scalar!(&test.cases[triangle], case => (
        case.hex(),
        severe.then(|| exact_severity(case, Extent::Interval)).flatten().map(severity_part),
    ));
    Example {
        case: test.id.clone(),
        bits,
        severity,
        command: format!("hairline explain '{}'", test.id),
    }
}
