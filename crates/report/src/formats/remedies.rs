//! The advice after a check that fails, for each reason that is seen: mend, change a compiler's flag, or take it as known.

use super::relations;
use crate::page::Item;
use hairline_record::{
    ComparisonVerdict, ComputedFormula, Conformance, Deviation, Method, Record, RowChange,
    group_digits, number_of,
};
use std::collections::BTreeMap;

/// The words of the command that takes what was found as known.
const ACCEPT: &str = "the same command with --bless --accept-worse takes it as known";

/// The advice, a sentence or two for each reason; nothing where nothing got worse.
pub(super) fn remedies(record: &Record, conformance: &Conformance) -> Vec<Item> {
    let is_worse = conformance.verdict == ComparisonVerdict::Disagreements;
    if !is_worse || conformance.expectations.is_none() {
        return Vec::new();
    }
    let mut texts = Vec::new();
    let has_larger_errors = conformance.errors.iter().any(|change| change.is_worse);
    if conformance.unexpected.is_empty() && has_larger_errors {
        texts.push(format!(
            "No verdict changed, but t, u, v or the point of some hits is farther from the exact one. Another order of \
             operations, or a reciprocal in place of a quotient, does this. If it is meant, {ACCEPT}."
        ));
    }
    let failed = conformance
        .unexpected
        .iter()
        .find(|it| it.finding.is_failure());
    if let Some(failed) = failed {
        texts.push(format!(
            "{}: mend the {} first. A case without an answer cannot be judged, so other findings may follow when it is mended.",
            failed.key().row(),
            failed.finding
        ));
    }
    if !relations::new_mistakes(record, conformance).is_empty() {
        texts.push(
            "Mend the mistake that is named above first: what else changed may go with it."
                .to_owned(),
        );
    }
    texts.extend(conformance.computes.iter().map(computed));
    texts.extend(conformance.rows.iter().map(set_otherwise));
    let has_reason = |found: &&Deviation| {
        let is_computed =
            |it: &ComputedFormula| (&it.kernel, &it.set) == (&found.kernel, &found.set);
        let is_set = |it: &RowChange| (&it.kernel, &it.set) == (&found.kernel, &found.set);
        found.finding.is_failure()
            || conformance.computes.iter().any(is_computed)
            || conformance.rows.iter().any(is_set)
    };
    let unexplained = conformance
        .unexpected
        .iter()
        .filter(|found| !has_reason(found));
    texts.extend(trades(conformance, unexplained));
    texts.into_iter().map(Item::of).collect()
}

/// The advice about a formula that is computed otherwise than it says.
fn computed(computed: &ComputedFormula) -> String {
    let ComputedFormula { kernel, set, .. } = computed;
    let advice = match (&computed.epsilon, computed.is_fused) {
        (Some(_), _) => format!(
            "put the epsilon back, or, if it is meant, {ACCEPT}. If you changed no epsilon, look for flags of the compiler that \
             change sums or flush subnormal numbers to zero (-ffast-math, /fp:fast)."
        ),
        (None, _) => format!(
            "compile it with -ffp-contract=off (GCC, Clang), /fp:precise (MSVC) or -fmad=false (nvcc). If your product \
             is compiled with fused products, {ACCEPT}."
        ),
    };
    format!("{kernel} ({set}): {advice}")
}

/// The advice about a row that runs with other settings.
fn set_otherwise(change: &RowChange) -> String {
    let RowChange {
        kernel, set, what, ..
    } = change;
    format!("{kernel} ({set}): put its {what} back, or, if it is meant, {ACCEPT}.")
}

/// The changes of a row, of which no reason is known.
#[derive(Default)]
struct RowTrade {
    more: u64,
    fewer: u64,
    classes: u64,
}

/// The advice about rows of which no reason is known: a trade, other cases, or a kernel that got worse.
fn trades<'a>(
    conformance: &'a Conformance,
    unexplained: impl Iterator<Item = &'a Deviation>,
) -> Vec<String> {
    let mut rows: BTreeMap<String, RowTrade> = BTreeMap::new();
    for found in unexplained {
        let trade = rows.entry(found.key().row()).or_default();
        trade.classes += 1;
        let known = found.expected_count.unwrap_or(found.found.count);
        trade.more += found.found.count.saturating_sub(known);
    }
    for found in &conformance.stale {
        if let (Some(trade), Some(known)) = (rows.get_mut(&found.key().row()), found.expected_count)
        {
            trade.fewer += known.saturating_sub(found.found.count);
        }
    }
    let is_counted = conformance.method == Method::CaseByCase;
    let sentence = |(row, trade): (String, RowTrade)| {
        let classes = number_of(trade.classes, "class", "classes");
        let [more, fewer] = [trade.more, trade.fewer].map(group_digits);
        if !is_counted {
            return format!(
                "{row}: wrong more often in {classes}. Look at a case, then mend the kernel; or {ACCEPT}."
            );
        }
        if trade.more == 0 {
            return format!(
                "{row}: as many wrong answers, on other cases ({classes}). Another compiler, or other flags, round in \
                 another order. If you changed them, {ACCEPT}."
            );
        }
        if trade.more < trade.fewer {
            return format!(
                "{row}: a trade, {fewer} wrong answers fewer and {more} more. If you want it, {ACCEPT}."
            );
        }
        format!(
            "{row}: {more} wrong answers more in {classes}, of no known reason. Look at a case with the command above \
             (why it is wrong, which other kernels are right), then mend the kernel. If it is meant, {ACCEPT}."
        )
    };
    rows.into_iter().map(sentence).collect()
}
