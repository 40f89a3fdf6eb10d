//! Sums of findings: a commutative monoid, so that any split of a run adds up to the same.

use super::accuracy::Accuracy;
use super::aimed::{Aimed, AimedRay};
use super::by_finding::ByFinding;
use super::digest::{CasePlace, Digest};
use super::group_count::{GroupCount, JudgedGroup};
use super::histogram::Histogram;
use super::relations::Relations;
use super::trials::{RayProducts, Trials};
use crate::contract::Across;
use crate::judge::{Class, Finding, Obligation};
use serde::{Deserialize, Serialize};
use std::cmp::Ordering;
use std::collections::BTreeMap;

/// The counts of one class of truths.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct ClassCount {
    /// Cases of the class.
    pub cases: u64,
    /// Cases that must be hit.
    pub must_hit: u64,
    /// Cases that must be missed.
    pub must_miss: u64,
    /// Cases without a verdict, as the kernel failed: those that must be hit, and those that must be
    /// missed.
    pub without_verdict: [u64; 2],
    /// Hits that the kernel reported.
    pub hits: u64,
    /// Hits whose values are judged: all but those on invalid input.
    pub valued_hits: u64,
    /// False hits whose values are judged.
    pub false_valued_hits: u64,
    /// By [`Finding::ALL`].
    pub findings: [u64; Finding::ALL.len()],
}

impl ClassCount {
    /// The count of a finding.
    pub fn of(&self, finding: Finding) -> u64 {
        self.findings[finding as usize]
    }

    /// How many cases could have shown a finding: the denominator of its rate.
    pub fn trials(&self, finding: Finding) -> u64 {
        match finding {
            Finding::FalseMiss => self.must_hit - self.without_verdict[0],
            Finding::FalseHit => self.must_miss - self.without_verdict[1],
            Finding::BadValue | Finding::WrongValue => self.valued_hits - self.false_valued_hits,
            Finding::Panic | Finding::Crash | Finding::Timeout => self.cases,
        }
    }

    /// Counts cases and what was asked of them.
    pub fn ask(&mut self, obligation: Obligation, cases: u64) {
        self.cases += cases;
        match obligation {
            Obligation::MustHit => self.must_hit += cases,
            Obligation::MustMiss => self.must_miss += cases,
            Obligation::Free => {}
        }
    }

    /// Counts a finding; `valued` says whether the values of a hit are judged on the case.
    pub fn find(&mut self, finding: Finding, valued: bool) {
        self.findings[finding as usize] += 1;
        self.false_valued_hits += u64::from(valued && finding == Finding::FalseHit);
    }

    /// Counts a case on which the kernel failed.
    pub fn fail(&mut self, obligation: Obligation) {
        match obligation {
            Obligation::MustHit => self.without_verdict[0] += 1,
            Obligation::MustMiss => self.without_verdict[1] += 1,
            Obligation::Free => {}
        }
    }

    /// Adds another count.
    pub fn merge(&mut self, other: &ClassCount) {
        self.without_verdict[0] += other.without_verdict[0];
        self.without_verdict[1] += other.without_verdict[1];
        self.cases += other.cases;
        self.must_hit += other.must_hit;
        self.must_miss += other.must_miss;
        self.hits += other.hits;
        self.valued_hits += other.valued_hits;
        self.false_valued_hits += other.false_valued_hits;
        for (count, more) in self.findings.iter_mut().zip(other.findings) {
            *count += more;
        }
    }
}

/// Examples of one finding in one class: the first by index, and the worst.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Examples {
    /// In order of their place.
    pub first: Vec<CasePlace>,
    /// The one with the largest approximate severity, the first of equals.
    #[serde(with = "super::forms::scored")]
    pub worst: Option<(f64, CasePlace)>,
    /// The digest of all places with the finding.
    pub digest: Digest,
}

impl Examples {
    fn add(&mut self, (place, hash): (CasePlace, u128), severity: f64, limit: usize) {
        if self.first.len() < limit {
            self.first.push(place);
        }
        self.digest.add(place, hash);
        self.propose((severity, place));
    }

    fn propose(&mut self, (severity, place): (f64, CasePlace)) {
        let better = self
            .worst
            .is_none_or(|(worst, at)| match severity.total_cmp(&worst) {
                Ordering::Greater => true,
                Ordering::Equal => place < at,
                Ordering::Less => false,
            });
        if better {
            self.worst = Some((severity, place));
        }
    }

    fn merge(&mut self, other: Examples, limit: usize) {
        self.digest.merge(&other.digest);
        self.first.extend(other.first);
        self.first.sort_unstable();
        self.first.truncate(limit);
        if let Some(worst) = other.worst {
            self.propose(worst);
        }
    }
}

/// The results on whole polygons of a kernel that takes them.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct PolygonCount {
    /// The polygons, what the contract asks of them, and what was found.
    pub count: ClassCount,
    /// The polygons that show a finding.
    #[serde(with = "super::forms::pairs")]
    pub examples: BTreeMap<Finding, Examples>,
}

impl PolygonCount {
    /// Counts a polygon, whether it was hit, and what that shows.
    fn add(&mut self, index: u64, answer: (Obligation, bool, Option<Finding>), limit: usize) {
        let (obligation, hit, finding) = answer;
        self.count.ask(obligation, 1);
        self.count.hits += u64::from(hit);
        self.count.valued_hits += u64::from(hit);
        let Some(finding) = finding else { return };
        self.count.find(finding, true);
        if finding.is_failure() {
            self.count.fail(obligation);
        }
        let place = CasePlace { index, triangle: 0 };
        self.examples
            .entry(finding)
            .or_default()
            .add((place, Digest::hash(place)), 0.0, limit);
    }

    fn merge(&mut self, other: PolygonCount, limit: usize) {
        self.count.merge(&other.count);
        for (finding, more) in other.examples {
            self.examples.entry(finding).or_default().merge(more, limit);
        }
    }
}

/// Second hits on the triangle that a ray starts on.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct SelfHits {
    /// Rays that start at a kernel's own hit point.
    pub rays: u64,
    /// Those rays that hit that triangle again.
    pub hits: u64,
}

/// How far findings are from where the verdict would be right.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Severities {
    /// In longest edges of the triangle.
    pub edges: Histogram,
    /// In ulps of the largest coordinate.
    pub ulps: Histogram,
}

impl Severities {
    /// Adds more.
    pub fn merge(&mut self, other: &Severities) {
        self.edges.merge(&other.edges);
        self.ulps.merge(&other.ulps);
    }
}

/// Everything that is added up for one kernel row on one source in one scalar.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Tally {
    /// One a class, by [`Class::number`].
    pub classes: Vec<ClassCount>,
    /// By class, or of all classes together, and finding: sums over the rays; empty where each ray has one
    /// triangle.
    #[serde(with = "super::forms::pairs")]
    pub products: BTreeMap<(Option<Class>, Finding), RayProducts>,
    /// Examples by class and finding.
    pub examples: ByFinding<Examples>,
    /// How far false misses and false hits are from where the verdict would be right, and how far off the
    /// points of wrong values are.
    #[serde(with = "super::forms::pairs")]
    pub severities: BTreeMap<Finding, Severities>,
    /// How accurate the values of right hits are, of a sample.
    pub accuracy: Accuracy,
    /// Relations between wrong answers and the exact values, of a kernel of one's own.
    pub relations: Relations,
    /// The outcomes of groups.
    pub groups: GroupCount,
    /// The same at the edges, or at the vertices, of a mesh.
    pub aimed: Aimed,
    /// Whole polygons.
    pub polygons: PolygonCount,
    /// Second hits on the triangle that a ray starts on.
    pub self_hits: SelfHits,
    /// How many places of each class and finding, and of groups.
    limit: usize,
    group_limit: usize,
    place_limit: usize,
}

impl Tally {
    /// Empty; keeps this many examples by index of each class and finding, and as many places as are
    /// to be attributed if that is more; and so many places of a mesh.
    pub fn new([examples, attributed, places]: [usize; 3]) -> Tally {
        Tally {
            classes: vec![ClassCount::default(); Class::COUNT],
            products: BTreeMap::new(),
            examples: ByFinding::default(),
            severities: BTreeMap::new(),
            accuracy: Accuracy::default(),
            relations: Relations::default(),
            groups: GroupCount::default(),
            aimed: Aimed::default(),
            polygons: PolygonCount::default(),
            self_hits: SelfHits::default(),
            limit: examples.max(attributed),
            group_limit: examples,
            place_limit: places,
        }
    }

    /// Drops the places beyond the examples.
    pub fn keep_examples(&mut self, examples: usize) {
        for found in self.examples.values_mut() {
            found.first.truncate(examples);
            found.first.shrink_to_fit();
        }
    }

    /// Adds what was asked, by class.
    pub fn ask(&mut self, classes: &[ClassCount]) {
        for (count, more) in self.classes.iter_mut().zip(classes) {
            count.merge(more);
        }
    }

    /// Adds hits, by class. The values of hits on invalid input are not judged.
    pub fn hits(&mut self, hits: &[u64; Class::COUNT]) {
        for (class, hits) in Class::all().zip(hits) {
            let count = &mut self.classes[class.number()];
            count.hits += hits;
            count.valued_hits += if class.is_invalid() { 0 } else { *hits };
        }
    }

    /// Counts a finding at a place, whose hash is known, with its severity: how far the case is from
    /// where the verdict would be right, in longest edges, and the longest edge in ulps; none of invalid
    /// input.
    pub fn find(
        &mut self,
        class: Class,
        finding: Finding,
        place: (CasePlace, u128),
        severity: Option<(f64, f64)>,
    ) {
        self.classes[class.number()].find(finding, !class.is_invalid());
        let edges = severity.map_or(0.0, |(edges, _)| edges);
        self.examples
            .slot(class, finding)
            .add(place, edges, self.limit);
        let has_severity = matches!(
            finding,
            Finding::FalseMiss | Finding::FalseHit | Finding::WrongValue
        );
        if let (true, Some((edges, edge_in_ulps))) = (has_severity, severity) {
            let severities = self.severities.entry(finding).or_default();
            severities.edges.add(edges);
            severities.ulps.add(edges * edge_in_ulps);
        }
    }

    /// Counts a group; of a mesh with its ray's target, and what a contract promises there.
    pub fn group(&mut self, group: &JudgedGroup, aimed: Option<AimedRay>, across: Across) {
        self.groups.add(group, self.group_limit);
        if let Some(ray) = aimed {
            self.aimed
                .add((ray, group), across, [self.group_limit, self.place_limit]);
        }
    }

    /// Counts a whole polygon: what the contract asks of it, whether it was hit, and what that shows.
    pub fn polygon(&mut self, index: u64, answer: (Obligation, bool, Option<Finding>)) {
        self.polygons.add(index, answer, self.group_limit);
    }

    /// Adds another tally.
    pub fn merge(&mut self, other: Tally) {
        for (count, more) in self.classes.iter_mut().zip(&other.classes) {
            count.merge(more);
        }
        for (key, more) in &other.products {
            self.products.entry(*key).or_default().merge(more);
        }
        let limit = self.limit;
        self.examples
            .merge(other.examples, |examples, more| examples.merge(more, limit));
        for (finding, more) in &other.severities {
            self.severities.entry(*finding).or_default().merge(more);
        }
        self.accuracy.merge(&other.accuracy);
        self.relations.merge(&other.relations);
        self.groups.merge(other.groups, self.group_limit);
        self.aimed
            .merge(other.aimed, [self.group_limit, self.place_limit]);
        self.polygons.merge(other.polygons, self.group_limit);
        self.self_hits.rays += other.self_hits.rays;
        self.self_hits.hits += other.self_hits.hits;
    }

    /// How often a finding occurred in a class, or in all together.
    pub fn trials(&self, class: Option<Class>, finding: Finding) -> Trials {
        let counts = class.map_or_else(|| self.total(), |class| self.classes[class.number()]);
        let (count, of) = (counts.of(finding), counts.trials(finding));
        match self.products.get(&(class, finding)) {
            Some(products) => Trials {
                count,
                of,
                products: *products,
            },
            None => Trials::independent(count, of),
        }
    }

    /// All classes together.
    pub fn total(&self) -> ClassCount {
        self.classes
            .iter()
            .fold(ClassCount::default(), |mut total, count| {
                total.merge(count);
                total
            })
    }
}

#[cfg(test)]
mod tests;
