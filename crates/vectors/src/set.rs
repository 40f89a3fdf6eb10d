//! Which tests there are: the core set by topic, and as many more as somebody wants, by number.

use super::flags;
use super::test::{Label, TestGroup, VectorTest, in_scalar, place, result, word};
use crate::case::{Case, Parameters};
use crate::corpus::lines::{self, StoredCase};
use crate::family::{FAMILIES, Family, Grouping, find};
use crate::judge::Obligation;
use crate::kernel::Scalar;
use crate::oracle::truth;
use crate::truth::{Place, Truth};
use serde::Deserialize;
use std::collections::{HashMap, HashSet};
use std::fmt::Write;

/// A file of the core set.
#[derive(Deserialize)]
pub struct VectorTopic {
    /// The file's name, and the first word of its ids.
    pub name: &'static str,
    /// The subject of its tests.
    pub about: &'static str,
    /// Families, and how many of their indices in f32.
    families: Vec<(&'static str, usize)>,
}

/// The files of the core set, in the order of their names.
const TOPICS: &str = include_str!("topics.json");

/// The texts of the corpus files whose cases are in the core set.
pub struct StoredCases<'a> {
    /// Cases whose truths were worked out by hand.
    pub curated: &'a str,
    /// Cases that people published.
    pub published: &'a str,
}

/// The seed of all generated tests.
const SEED: u64 = 1;
/// From how many indices of a family the core set picks.
const PICKED_FROM: u64 = 200;

/// The core set: the files, each with its tests. No test stands twice in it.
pub fn core(texts: &StoredCases<'_>) -> Vec<(VectorTopic, Vec<VectorTest>)> {
    let topics: Vec<VectorTopic> = serde_json::from_str(TOPICS).expect("tests read it");
    let [curated, published] = [texts.curated, texts.published].map(stored);
    let mut seen = HashSet::new();
    let tests_of = |topic: VectorTopic| {
        let mut tests: Vec<VectorTest> = Vec::new();
        if topic.name == "published" {
            let groups = published.chunk_by(|one, other| group_name(one) == group_name(other));
            tests.extend(groups.filter_map(|cases| named(cases, Some("published"))));
        }
        let curated = curated
            .iter()
            .filter_map(|case| named(std::slice::from_ref(case), None));
        tests.extend(curated.filter(|test| topic_of(&test.triangles[0].truth) == topic.name));
        for &(family, count) in &topic.families {
            let family = find(family).expect("a family of the table");
            tests.extend(picked::<f32>(topic.name, family, count));
            // Doubles are twice as long, and fewer programs use them.
            tests.extend(picked::<f64>(topic.name, family, count * 3 / 4));
        }
        tests.retain(|test| seen.insert(test.digest()));
        (topic, tests)
    };
    topics.into_iter().map(tests_of).collect()
}

/// The cases of a corpus file of this repository.
fn stored(text: &str) -> Vec<StoredCase> {
    let cases = lines::read(text.as_bytes(), "corpora").collect::<Result<_, _>>();
    cases.expect("tests read these files")
}

/// A case with a name of its own, or the cases of a pair on one edge: `name.0` and `name.1`.
fn named(stored: &[StoredCase], flag: Option<&'static str>) -> Option<VectorTest> {
    let label = Label {
        name: group_name(&stored[0])?.to_owned(),
        comment: stored[0].why.clone()?,
        source: stored[0].url.clone(),
        flag,
    };
    let cases = stored.iter().map(|stored| &stored.case);
    let grouping = if stored.len() > 1 {
        Grouping::SharedEdge
    } else {
        Grouping::Single
    };
    in_named_scalar!(stored[0].case.scalar(), F => VectorTest::new(label, &in_scalar::<F>(cases), grouping))
}

/// The name before `.0` or `.1`.
fn group_name(stored: &StoredCase) -> Option<&str> {
    stored
        .name
        .as_deref()
        .and_then(|name| name.split('.').next())
}

/// The file of a curated case.
fn topic_of(truth: &Truth) -> &'static str {
    match truth {
        Truth::Transversal(crossing) if crossing.feature.is_edge() => "edges",
        Truth::Transversal(crossing) if crossing.feature.is_vertex() => "vertices",
        Truth::Transversal(crossing) if crossing.place != Place::Within => "starts",
        Truth::Transversal(_) => "basics",
        other => other.class_name(),
    }
}

/// Tests of a family's first indices, each kind in turn, so that the rare ones are there.
fn picked<F: Scalar>(topic: &str, family: &'static Family, count: usize) -> Vec<VectorTest> {
    let mut of_kind: HashMap<String, usize> = HashMap::new();
    let mut ranked: Vec<(usize, u64)> = (0..PICKED_FROM)
        .map(|index| {
            let made = family.make::<F>(&Parameters::default(), SEED, index);
            let rank = of_kind
                .entry(kind(made.cases(), family.grouping))
                .or_default();
            *rank += 1;
            (*rank, index)
        })
        .collect();
    ranked.sort();
    let tests = ranked
        .iter()
        .filter_map(|(_, index)| generated::<F>(topic, family, *index));
    tests.take(count).collect()
}

/// A text that is equal for two tests if one of them could do.
fn kind<F: Scalar>(cases: &[Case<F>], grouping: Grouping) -> String {
    let truths: Vec<Truth> = cases.iter().map(truth).collect();
    if grouping.shares_a_ray() {
        let group = TestGroup::new(cases, &truths, grouping);
        return format!("{} {} {:?}", group.result(), group.parity(), group.counts);
    }
    match result(&truths[0]) {
        Obligation::Free => "free".to_owned(),
        demanded => format!("{} {}", word(demanded), place(&truths[0])),
    }
}

/// Test `number` of the full set: families in turn, then scalars, then indices. None where nothing is
/// demanded of a group.
pub fn numbered(number: u64) -> Option<VectorTest> {
    // Rays of `secondary-ray` start where a kernel's rounding puts them, and a polygon is no group.
    let is_in =
        |family: &&Family| !matches!(family.grouping, Grouping::SecondaryRay | Grouping::Polygon);
    let families: Vec<&'static Family> = FAMILIES.iter().filter(is_in).collect();
    let family = families[(number % families.len() as u64) as usize];
    let number = number / families.len() as u64;
    match number % 2 {
        0 => generated::<f32>(family.name, family, number / 2),
        _ => generated::<f64>(family.name, family, number / 2),
    }
}

fn generated<F: Scalar>(name: &str, family: &'static Family, index: u64) -> Option<VectorTest> {
    let parameters = Parameters::default();
    let made = family.make::<F>(&parameters, SEED, index);
    let label = Label {
        name: name.to_owned(),
        comment: family.id::<F>(&parameters, SEED, index).to_string(),
        source: None,
        flag: flags::of_family(family.name),
    };
    let mut test = VectorTest::new(label, made.cases(), family.grouping)?;
    let _ = match test.group {
        None => write!(test.comment, ": {}", test.triangles[0].truth),
        Some(group) => {
            let [closed, open] = group.counts;
            let count = test.triangles.len();
            write!(
                test.comment,
                ": {count} triangles; hits: {closed} closed, {open} open"
            )
        }
    };
    Some(test)
}
