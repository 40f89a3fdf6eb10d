//! The changes of a comparison in cases: how many wrong answers are more or fewer than known, by row and finding.

use super::{Conformance, Deviation, Method};
use crate::arith::ScalarName;
use crate::kind::FindingKind;
use std::cmp::Reverse;
use std::collections::BTreeMap;

/// The wrong answers of one kind of a row in a scalar, beside those that are known.
#[derive(Debug, PartialEq, Eq)]
pub struct NetFinding<'a> {
    /// `kernel (set)`.
    pub row: String,
    /// The scalar.
    pub scalar: ScalarName,
    /// The kind of finding.
    pub finding: FindingKind,
    /// How many are known, in all families.
    pub known: u64,
    /// How many there are.
    pub now: u64,
    /// The families in which there are more than known, or fewer, and by how much; what changed most first.
    pub families: Vec<(&'a str, i64)>,
}

impl NetFinding<'_> {
    /// How many more than known, or fewer, in families where there are more and in families where there are fewer.
    fn size(&self) -> u64 {
        let sizes = self.families.iter().map(|(_, more)| more.unsigned_abs());
        sizes.sum()
    }
}

/// The sums of a row, a scalar and a finding.
#[derive(Default)]
struct NetSums<'a> {
    known: u64,
    now: u64,
    families: BTreeMap<&'a str, i64>,
}

impl Conformance {
    /// By row, scalar and finding what changed, the row that changed most first; nothing where rates were compared.
    pub fn net(&self) -> Vec<NetFinding<'_>> {
        let mut sums: BTreeMap<(String, ScalarName, FindingKind), NetSums<'_>> = BTreeMap::new();
        for found in self.counted() {
            let (known, now, more) = change_of(found);
            let of_finding = sums
                .entry((found.key().row(), found.scalar, found.finding))
                .or_default();
            of_finding.known += known;
            of_finding.now += now;
            *of_finding.families.entry(&found.family).or_default() += more;
        }
        let mut all: Vec<NetFinding<'_>> = sums
            .into_iter()
            .map(|((row, scalar, finding), sums)| NetFinding {
                row,
                scalar,
                finding,
                known: sums.known,
                now: sums.now,
                families: most_changed(sums.families),
            })
            .filter(|net| !net.families.is_empty())
            .collect();
        let mut of_row: BTreeMap<(String, ScalarName), u64> = BTreeMap::new();
        for net in &all {
            *of_row.entry((net.row.clone(), net.scalar)).or_default() += net.size();
        }
        all.sort_by_cached_key(|net| {
            let place = (net.row.clone(), net.scalar);
            (Reverse(of_row[&place]), place, net.finding)
        });
        all
    }

    /// How many wrong answers there are more than known in the classes that have more, and how many fewer in those that have
    /// fewer; noughts where rates were compared.
    pub fn more_and_fewer(&self) -> [u64; 2] {
        let mut sums = [0; 2];
        for found in self.counted() {
            let (.., more) = change_of(found);
            sums[usize::from(more < 0)] += more.unsigned_abs();
        }
        sums
    }

    /// Every class whose cases were counted beside a number that is known.
    fn counted(&self) -> impl Iterator<Item = &Deviation> {
        let all = [&self.unexpected, &self.stale, &self.known];
        let is_counted = |found: &&Deviation| found.expected_count.is_some() && 0 < found.found.of;
        all.into_iter()
            .filter(|_| self.method == Method::CaseByCase)
            .flatten()
            .filter(is_counted)
    }
}

/// How many cases are known of a class, how many there are, and the difference.
fn change_of(found: &Deviation) -> (u64, u64, i64) {
    let known = found.expected_count.unwrap_or_default();
    let now = found.found.count;
    (known, now, now.wrapping_sub(known).cast_signed())
}

/// The families that changed, what changed most first.
fn most_changed(families: BTreeMap<&str, i64>) -> Vec<(&str, i64)> {
    let mut changed: Vec<(&str, i64)> = families
        .into_iter()
        .filter(|(_, more)| *more != 0)
        .collect();
    changed.sort_by_key(|(name, more)| (Reverse(more.unsigned_abs()), *name));
    changed
}
