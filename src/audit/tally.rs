//! Sums of findings: a commutative monoid, so that any split of a run adds up to the same.

use super::accuracy::Accuracy;
use super::by_finding::ByFinding;
use super::digest::Digest;
use super::histogram::Histogram;
use super::trials::{RayProducts, Trials};
use crate::judge::{Class, Finding, GroupTruth, Obligation};
use serde::{Deserialize, Serialize};
use std::cmp::Ordering;
use std::collections::BTreeMap;

/// Where a case stands in its source: the index, and the triangle of a group.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub struct Place {
    /// The index.
    pub index: u64,
    /// The triangle of a group; 0 alone.
    pub triangle: u32,
}

/// The counts of one class of truths.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct ClassCount {
    /// Cases of the class.
    pub cases: u64,
    /// Of these, those that must be hit.
    pub must_hit: u64,
    /// Of these, those that must be missed.
    pub must_miss: u64,
    /// Of those that must be hit, and of those that must be missed, those without a verdict: the kernel
    /// failed.
    pub without_verdict: [u64; 2],
    /// Hits that the kernel reported.
    pub hits: u64,
    /// Of these, those whose values are judged: all but those on invalid input.
    pub valued_hits: u64,
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
            Finding::BadValue => self.valued_hits.saturating_sub(self.of(Finding::FalseHit)),
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
        for (count, more) in self.findings.iter_mut().zip(other.findings) {
            *count += more;
        }
    }
}

/// Examples of one finding in one class: the first by index, and the worst.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Examples {
    /// In order of their place.
    pub first: Vec<Place>,
    /// The one with the largest approximate severity, the first of equals.
    #[serde(with = "super::stored::scored")]
    pub worst: Option<(f64, Place)>,
    /// Of all places with the finding.
    pub digest: Digest,
}

impl Examples {
    fn add(&mut self, (place, digest): (Place, Digest), severity: f64, limit: usize) {
        if self.first.len() < limit {
            self.first.push(place);
        }
        self.digest.merge(digest);
        self.propose((severity, place));
    }

    fn propose(&mut self, (severity, place): (f64, Place)) {
        let better = self.worst.is_none_or(|(worst, at)| match severity.total_cmp(&worst) {
            Ordering::Greater => true,
            Ordering::Equal => place < at,
            Ordering::Less => false,
        });
        if better {
            self.worst = Some((severity, place));
        }
    }

    fn merge(&mut self, other: Examples, limit: usize) {
        self.digest.merge(other.digest);
        self.first.extend(other.first);
        self.first.sort_unstable();
        self.first.truncate(limit);
        if let Some(worst) = other.worst {
            self.propose(worst);
        }
    }
}

/// What the triangles of groups did together.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct GroupCount {
    /// Groups in which one hit is right.
    pub crossings: u64,
    /// Of these, those without a hit.
    pub cracks: u64,
    /// Of these, those with two hits or more.
    pub doubles: u64,
    /// Pairs that fold over their edge.
    pub folds: u64,
    /// Of these, those whose number of hits has the wrong parity.
    pub odd_folds: u64,
    /// Of these, those without a hit where the exact line has two.
    pub missed_folds: u64,
    /// The first cracks, by index.
    pub first_cracks: Vec<u64>,
    /// The first doubles, by index.
    pub first_doubles: Vec<u64>,
    /// Of all cracks.
    pub crack_digest: Digest,
    /// Of all doubles.
    pub double_digest: Digest,
}

impl GroupCount {
    /// Counts a group.
    pub(crate) fn add(&mut self, index: u64, truth: GroupTruth, hits: usize, limit: usize) {
        let note = |list: &mut Vec<u64>| {
            if list.len() < limit {
                list.push(index)
            }
        };
        match truth {
            GroupTruth::Free => {}
            GroupTruth::Crossing => {
                self.crossings += 1;
                if hits == 0 {
                    self.cracks += 1;
                    self.crack_digest.add(Place { index, triangle: 0 });
                    note(&mut self.first_cracks);
                } else if hits > 1 {
                    self.doubles += 1;
                    self.double_digest.add(Place { index, triangle: 0 });
                    note(&mut self.first_doubles);
                }
            }
            GroupTruth::Fold { odd } => {
                self.folds += 1;
                self.odd_folds += u64::from((hits % 2 == 1) != odd);
                self.missed_folds += u64::from(hits == 0 && !odd);
            }
        }
    }

    /// Adds another count.
    pub(crate) fn merge(&mut self, other: GroupCount, limit: usize) {
        self.crossings += other.crossings;
        self.cracks += other.cracks;
        self.doubles += other.doubles;
        self.folds += other.folds;
        self.odd_folds += other.odd_folds;
        self.missed_folds += other.missed_folds;
        self.crack_digest.merge(other.crack_digest);
        self.double_digest.merge(other.double_digest);
        for (list, more) in [
            (&mut self.first_cracks, other.first_cracks),
            (&mut self.first_doubles, other.first_doubles),
        ] {
            list.extend(more);
            list.sort_unstable();
            list.truncate(limit);
        }
    }
}

/// A polygon kernel's answers about whole polygons.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct PolygonCount {
    /// Polygons that must be hit.
    pub must_hit: u64,
    /// Of these, missed.
    pub false_miss: u64,
    /// Which.
    pub false_miss_digest: Digest,
    /// Polygons that must be missed.
    pub must_miss: u64,
    /// Of these, hit.
    pub false_hit: u64,
    /// Which.
    pub false_hit_digest: Digest,
}

/// Second hits on the triangle that a ray starts on.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct SelfHits {
    /// Rays that start at a kernel's own hit point.
    pub rays: u64,
    /// Of these, those that hit that triangle again.
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
    #[serde(with = "super::stored::pairs")]
    pub products: BTreeMap<(Option<Class>, Finding), RayProducts>,
    /// Examples by class and finding.
    pub examples: ByFinding<Examples>,
    /// How far false misses and false hits are from where the verdict would be right.
    #[serde(with = "super::stored::pairs")]
    pub severities: BTreeMap<Finding, Severities>,
    /// How accurate the values of right hits are, of a sample.
    pub accuracy: Accuracy,
    /// What groups did together.
    pub groups: GroupCount,
    /// Whole polygons.
    pub polygons: PolygonCount,
    /// Second hits on the triangle that a ray starts on.
    pub self_hits: SelfHits,
    /// How many places of each class and finding, and of groups.
    limit: usize,
    group_limit: usize,
}

impl Tally {
    /// Empty; keeps this many examples by index of each class and finding, and as many places as are
    /// to be attributed if that is more.
    pub fn new(examples: usize, attributed: usize) -> Tally {
        Tally {
            classes: vec![ClassCount::default(); Class::COUNT],
            products: BTreeMap::new(),
            examples: ByFinding::default(),
            severities: BTreeMap::new(),
            accuracy: Accuracy::default(),
            groups: GroupCount::default(),
            polygons: PolygonCount::default(),
            self_hits: SelfHits::default(),
            limit: examples.max(attributed),
            group_limit: examples,
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

    /// Counts a finding at a place, whose digest is known, with its severity: how far the case is from
    /// where the verdict would be right, in longest edges, and the longest edge in ulps; none of invalid
    /// input.
    pub fn find(
        &mut self,
        class: Class,
        finding: Finding,
        place: (Place, Digest),
        severity: Option<(f64, f64)>,
    ) {
        self.classes[class.number()].findings[finding as usize] += 1;
        let edges = severity.map_or(0.0, |(edges, _)| edges);
        self.examples.slot(class, finding).add(place, edges, self.limit);
        let by_verdict = matches!(finding, Finding::FalseMiss | Finding::FalseHit);
        if let (true, Some((edges, edge_in_ulps))) = (by_verdict, severity) {
            let severities = self.severities.entry(finding).or_default();
            severities.edges.add(edges);
            severities.ulps.add(edges * edge_in_ulps);
        }
    }

    /// Counts a group.
    pub fn group(&mut self, index: u64, truth: GroupTruth, hits: usize) {
        self.groups.add(index, truth, hits, self.group_limit);
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
        self.examples.merge(other.examples, |examples, more| examples.merge(more, limit));
        for (finding, more) in &other.severities {
            self.severities.entry(*finding).or_default().merge(more);
        }
        self.accuracy.merge(&other.accuracy);
        self.groups.merge(other.groups, self.group_limit);
        self.polygons.must_hit += other.polygons.must_hit;
        self.polygons.false_miss += other.polygons.false_miss;
        self.polygons.must_miss += other.polygons.must_miss;
        self.polygons.false_hit += other.polygons.false_hit;
        self.polygons.false_miss_digest.merge(other.polygons.false_miss_digest);
        self.polygons.false_hit_digest.merge(other.polygons.false_hit_digest);
        self.self_hits.rays += other.self_hits.rays;
        self.self_hits.hits += other.self_hits.hits;
    }

    /// How often a finding occurred in a class, or in all together.
    pub fn trials(&self, class: Option<Class>, finding: Finding) -> Trials {
        let counts = class.map_or_else(|| self.total(), |class| self.classes[class.number()]);
        let (count, of) = (counts.of(finding), counts.trials(finding));
        match self.products.get(&(class, finding)) {
            Some(products) => Trials { count, of, products: *products },
            None => Trials::independent(count, of),
        }
    }

    /// All classes together.
    pub fn total(&self) -> ClassCount {
        self.classes.iter().fold(ClassCount::default(), |mut total, count| {
            total.merge(count);
            total
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn any_split_adds_up_to_the_same() {
        let class = Class::all().next().unwrap();
        let event = |tally: &mut Tally, index: u64| {
            tally.classes[class.number()].ask(Obligation::MustHit, 1);
            if index.is_multiple_of(3) {
                let place = Place { index, triangle: 0 };
                let severity = Some(((index * 7 % 11) as f64, 2.0));
                tally.find(class, Finding::FalseMiss, (place, Digest::of(place)), severity);
            }
            let products = tally.products.entry((Some(class), Finding::FalseMiss)).or_default();
            products.add_ray(index % 4, 4);
            tally.group(index, GroupTruth::Crossing, (index % 4) as usize);
        };
        let mut whole = Tally::new(5, 0);
        (0..100).for_each(|index| event(&mut whole, index));
        for cut in [0, 1, 17, 50, 99] {
            let (mut left, mut right) = (Tally::new(5, 0), Tally::new(5, 0));
            (0..cut).for_each(|index| event(&mut left, index));
            (cut..100).for_each(|index| event(&mut right, index));
            let mut swapped = right.clone();
            swapped.merge(left.clone());
            left.merge(right);
            assert_eq!(left, whole);
            assert_eq!(swapped, whole);
        }
        let examples = &whole.examples.get(class, Finding::FalseMiss).unwrap();
        assert_eq!(examples.first.len(), 5);
        assert_eq!(examples.worst.unwrap().0, 10.0);
        assert_eq!(whole.severities[&Finding::FalseMiss].ulps.largest(), 20.0);
    }
}
