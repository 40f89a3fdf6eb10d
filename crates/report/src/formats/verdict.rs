//! The conformance part of a record as text for people, with the changes between expectations and a run, in cases: by row
//! and finding, so that a trade is seen as one.

use crate::judge::Class;
use crate::page::{Block, Item, Items};
use hairline_record::number_of;
use hairline_record::{
    Conformance, Deviation, FindingKind, Method, Record, RowChange, group_digits,
};
use std::collections::BTreeMap;

/// The most deviations of a kind that the text lists without `--details`.
const MOST_LISTED: usize = 3;

/// The meaning of the words of a class.
const CLASSES: &str = "of interior/back/within: where the line meets the triangle, which side it comes from, where on the \
                       ray (within, before its start, beyond its end)";

/// The blocks below the verdict of a `check`.
pub(super) fn blocks(record: &Record, conformance: &Conformance) -> Vec<Block> {
    let how = match (conformance.method, &conformance.expectations) {
        (_, None) => "nothing is expected: there is no file of expectations".to_owned(),
        (Method::CaseByCase, Some(file)) if conformance.is_by_family => {
            format!("compared family by family with {file}")
        }
        (Method::CaseByCase, Some(file)) => format!("compared case by case with {file}"),
        (Method::Intervals, Some(file)) => format!(
            "compared by intervals with {file}, which is of other cases (it has {} entries)",
            group_digits(conformance.expected())
        ),
    };
    let plan = &record.result.plan.hash;
    let mut texts = vec![format!("{}, plan {plan}: {how}", record.provenance.tool)];
    texts.extend(conformance.note.clone());
    texts.extend(conformance.rows.iter().map(RowChange::to_string));
    if 0 < conformance.too_rare_to_tell {
        texts.push(format!(
            "without an entry, and too rare to tell from none: {}",
            number_of(
                conformance.too_rare_to_tell,
                "class of disagreement",
                "classes of disagreement"
            )
        ));
    }
    if 0 < conformance.outside_the_plan {
        texts.push(format!(
            "{} expectations are of kernels, scalars or families that this plan leaves out",
            group_digits(conformance.outside_the_plan)
        ));
    }
    let mut blocks: Vec<Block> = texts.into_iter().map(Block::Text).collect();
    let unproved = conformance.unproved.iter();
    let unproved = unproved.map(|it| Item::shown_by(it.to_string(), it.command.clone()));
    let title = "Proofs that [proved] demands and that are missing";
    blocks.extend(Block::items(title, MOST_LISTED, unproved.collect()));
    let net = net_lines(conformance);
    let net = net
        .into_iter()
        .map(|text| Item {
            text,
            ..Item::default()
        })
        .collect();
    blocks.extend(Block::items("What changed, in cases", MOST_LISTED, net));
    let errors = conformance.errors.iter();
    let errors = errors
        .map(|it| Item {
            text: it.to_string(),
            ..Item::default()
        })
        .collect();
    blocks.extend(Block::items(
        "Errors of right hits, of a sample",
        MOST_LISTED,
        errors,
    ));
    let stale =
        "Stale expectations (what was wrong is less so, or gone; --bless writes what was found)";
    let unsteady = "Answers differ from run to run, so these kernels are not compared";
    for (title, list) in [
        (unsteady, &conformance.unsteady),
        ("Unexpected disagreements", &conformance.unexpected),
        (stale, &conformance.stale),
    ] {
        let items = list
            .iter()
            .map(|found| deviation(conformance, found))
            .collect();
        blocks.extend(Block::items(title, MOST_LISTED, items));
    }
    let mut all = conformance.unexpected.iter().chain(&conformance.stale);
    if all.any(|found| found.class.truth().is_some_and(Class::crosses)) {
        blocks.push(Block::text(CLASSES));
    }
    let told = conformance
        .known
        .iter()
        .filter(|known| known.why.is_some() || known.url.is_some());
    let told: Vec<Item> = told.map(|found| deviation(conformance, found)).collect();
    if !told.is_empty() {
        let items = vec![Block::Items(Items {
            items: told,
            most: usize::MAX,
        })];
        blocks.push(Block::Details("Known, with a reason".to_owned(), items));
    }
    blocks
}

fn deviation(conformance: &Conformance, found: &Deviation) -> Item {
    let place = conformance.expectations.as_ref().zip(found.line);
    let place = place.map_or(String::new(), |(file, line)| format!("{file}:{line}: "));
    Item {
        text: format!("{place}{}", found.describe()),
        notes: found.why.iter().cloned().collect(),
        url: found.url.clone(),
        lines: found.command.iter().cloned().collect(),
        more: found
            .bits
            .iter()
            .filter(|bits| !bits.is_empty())
            .cloned()
            .collect(),
    }
}

/// The most families that a finding names.
const MOST_FAMILIES: usize = 3;

/// By finding and family, how many cases more than expected.
type NetFindings<'a> = BTreeMap<FindingKind, BTreeMap<&'a str, i64>>;

/// A line for each row in a scalar, those that changed most first; none where rates were compared.
fn net_lines(conformance: &Conformance) -> Vec<String> {
    if conformance.method != Method::CaseByCase {
        return Vec::new();
    }
    let mut rows: BTreeMap<String, NetFindings<'_>> = BTreeMap::new();
    for found in conformance.unexpected.iter().chain(&conformance.stale) {
        let Some(more) = more_than_expected(found) else {
            continue;
        };
        let row = format!("{} {}", found.key().row(), found.scalar);
        let findings = rows.entry(row).or_default();
        *findings
            .entry(found.finding)
            .or_default()
            .entry(&found.family)
            .or_default() += more;
    }
    let mut rows: Vec<(String, NetFindings<'_>)> = rows.into_iter().collect();
    for (_, findings) in &mut rows {
        findings
            .values_mut()
            .for_each(|families| families.retain(|_, more| *more != 0));
        findings.retain(|_, families| !families.is_empty());
    }
    rows.retain(|(_, findings)| !findings.is_empty());
    let size = |findings: &NetFindings<'_>| {
        findings
            .values()
            .flat_map(BTreeMap::values)
            .map(|more| more.unsigned_abs())
            .sum::<u64>()
    };
    rows.sort_by_cached_key(|(row, findings)| (u64::MAX - size(findings), row.clone()));
    let line = |(row, findings): &(String, NetFindings<'_>)| {
        let findings: Vec<String> = findings.iter().map(finding_words).collect();
        format!("{row}: {}", findings.join("; "))
    };
    rows.iter().map(line).collect()
}

/// How many cases more than expected, or fewer; none where no number of cases was expected, or none is judged now.
fn more_than_expected(found: &Deviation) -> Option<i64> {
    let count = |count: u64| i64::try_from(count).ok();
    let expected = found.expected_count.filter(|_| 0 < found.found.of)?;
    Some(count(found.found.count)? - count(expected)?)
}

/// `false-miss +2,250 (sliver +794, grazing +771, direction-length +371, 2 more)`.
fn finding_words((finding, families): (&FindingKind, &BTreeMap<&str, i64>)) -> String {
    let sum: i64 = families.values().sum();
    let mut families: Vec<(&&str, &i64)> = families.iter().collect();
    families.sort_by_key(|(name, more)| (-more.abs(), **name));
    let named = families.iter().take(MOST_FAMILIES);
    let mut words: Vec<String> = named
        .map(|(name, more)| format!("{name} {}", signed(**more)))
        .collect();
    if MOST_FAMILIES < families.len() {
        words.push(format!("{} more", families.len() - MOST_FAMILIES));
    }
    format!("{finding} {} ({})", signed(sum), words.join(", "))
}

/// `+1,234`, `-5`, `0`.
fn signed(number: i64) -> String {
    let sign = match number {
        0 => "",
        1.. => "+",
        _ => "-",
    };
    format!("{sign}{}", group_digits(number.unsigned_abs()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arith::ScalarName;
    use crate::page::html::tests::{conformance, deviation};

    #[test]
    fn a_trade_is_a_line() {
        let of = |family: &str, finding: FindingKind, expected: Option<u64>, found: u64| {
            let mut one = deviation("k", "");
            (one.family, one.finding) = (family.to_owned(), finding);
            (one.expected_count, one.found.count) = (expected, found);
            one
        };
        let mut all = conformance(vec![
            of("tiny", FindingKind::FalseMiss, Some(10), 1_234),
            of("tiny", FindingKind::FalseMiss, Some(5), 4),
            of("fan", FindingKind::FalseMiss, Some(0), 3),
            of("far", FindingKind::FalseMiss, Some(7), 2),
            of("sliver", FindingKind::FalseMiss, Some(0), 1),
            of("axis-aligned", FindingKind::BadValue, Some(1), 4),
            of("fan", FindingKind::BadValue, Some(3), 0),
            // As many on other cases, and a share: no number of cases.
            of("huge", FindingKind::Crack, Some(4), 4),
            of("huge", FindingKind::Double, None, 4),
        ]);
        all.stale = vec![
            of("far", FindingKind::FalseHit, Some(20), 0),
            of("fan", FindingKind::Panic, Some(8), 0),
        ];
        // Nothing of it is in the run.
        all.stale[1].found.of = 0;
        let mut other = of("tiny", FindingKind::Crack, Some(0), 1);
        other.scalar = ScalarName::F64;
        all.stale.push(other);
        let expected = "k (k) f32: bad-value 0 (axis-aligned +3, fan -3); false-hit -20 (far -20); false-miss +1,222 (tiny +1,223, far -5, fan +3, 1 more)";
        assert_eq!(net_lines(&all), [expected, "k (k) f64: crack +1 (tiny +1)"]);
        all.method = Method::Intervals;
        assert_eq!(net_lines(&all), [""; 0]);
    }
}
