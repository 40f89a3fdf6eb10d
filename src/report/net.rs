//! What changed between expectations and a run, in cases: by row and finding, so that a trade is seen as one.

use super::{Conformance, Deviation, Method, group_digits};
use std::collections::BTreeMap;

/// The most families that a finding names.
const MOST_FAMILIES: usize = 3;

/// A line for each row in a scalar; none where rates were compared.
pub(super) fn net_lines(conformance: &Conformance) -> Vec<String> {
    if conformance.method != Method::CaseByCase {
        return Vec::new();
    }
    let mut rows: BTreeMap<String, BTreeMap<&str, BTreeMap<&str, i64>>> = BTreeMap::new();
    for found in conformance.unexpected.iter().chain(&conformance.stale) {
        let Some(more) = more_than_expected(found).filter(|more| *more != 0) else { continue };
        let row = format!("{} {}", found.key().row(), found.scalar);
        let findings = rows.entry(row).or_default();
        *findings.entry(&found.finding).or_default().entry(&found.family).or_default() += more;
    }
    let line = |(row, findings): (String, BTreeMap<&str, BTreeMap<&str, i64>>)| {
        let findings: Vec<String> = findings.into_iter().map(finding_words).collect();
        format!("{row}: {}", findings.join("; "))
    };
    rows.into_iter().map(line).collect()
}

/// How many cases more than expected, or fewer; none where a share was expected.
fn more_than_expected(found: &Deviation) -> Option<i64> {
    let count = |count: u64| i64::try_from(count).ok();
    Some(count(found.found.count)? - count(found.expected_count?)?)
}

/// `false-miss +2,250 (sliver +794, grazing +771, direction-length +371, 2 more)`.
fn finding_words((finding, families): (&str, BTreeMap<&str, i64>)) -> String {
    let sum: i64 = families.values().sum();
    let mut families: Vec<(&str, i64)> = families.into_iter().collect();
    families.sort_by_key(|(name, more)| (-more.abs(), *name));
    let named = families.iter().take(MOST_FAMILIES);
    let mut words: Vec<String> =
        named.map(|(name, more)| format!("{name} {}", signed(*more))).collect();
    if MOST_FAMILIES < families.len() {
        words.push(format!("{} more", families.len() - MOST_FAMILIES));
    }
    format!("{finding} {} ({})", signed(sum), words.join(", "))
}

fn signed(number: i64) -> String {
    let sign = if number < 0 { "-" } else { "+" };
    format!("{sign}{}", group_digits(number.unsigned_abs()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::html::tests::{conformance, deviation};

    #[test]
    fn a_trade_is_a_line() {
        let of = |family: &str, finding: &str, expected: Option<u64>, found: u64| {
            let mut one = deviation("k", "");
            (one.family, one.finding) = (family.to_owned(), finding.to_owned());
            (one.expected_count, one.found.count) = (expected, found);
            one
        };
        let mut all = conformance(vec![
            of("tiny", "false-miss", Some(10), 1_234),
            of("tiny", "false-miss", Some(5), 4),
            of("fan", "false-miss", Some(0), 3),
            of("far", "false-miss", Some(7), 2),
            of("sliver", "false-miss", Some(0), 1),
            // As many on other cases, and a share: no number of cases.
            of("huge", "crack", Some(4), 4),
            of("huge", "double", None, 4),
        ]);
        all.stale = vec![of("far", "false-hit", Some(20), 0)];
        let expected = "k (k) f32: false-hit -20 (far -20); false-miss +1,222 (tiny +1,223, far -5, fan +3, 1 more)";
        assert_eq!(net_lines(&all), [expected]);
        all.method = Method::Intervals;
        assert_eq!(net_lines(&all), [""; 0]);
    }
}
