//! Why, in the text: shares of causes.

use crate::audit::Attribution;
use hairline_record::counts_alone;
use hairline_record::percent;
use hairline_record::*;

/// The findings of a kind that counts for single triangles, of any class.
pub(super) fn of_kind<'a>(
    results: &[&'a KernelResult],
    kind: FindingKind,
) -> impl Iterator<Item = &'a FindingPart> {
    let alone = results
        .iter()
        .filter(move |result| counts_alone(result, kind));
    let findings = alone.flat_map(|result| &result.findings);
    findings.filter(move |part| part.finding == kind)
}

/// The shares of causes among findings: `rounding 61% [58, 64], epsilon 39% [36, 42]`; none without a finding that was
/// attributed.
///
/// Each class of each family is a sample of its own; their shares and the ends of their intervals are
/// weighted by how many findings they have, which is wider than an interval of the sum would be.
pub(super) fn causes_text<'a>(findings: impl Iterator<Item = &'a FindingPart>) -> Option<String> {
    let shares = cause_shares(findings)?;
    let text = |(attribution, share, interval): &CauseShare| {
        let interval =
            interval.map(|[low, high]| format!(" [{}, {}]", percent(low), percent(high)));
        format!(
            "{} {}{}",
            attribution.name(),
            percent(*share),
            interval.unwrap_or_default()
        )
    };
    Some(shares.iter().map(text).collect::<Vec<_>>().join(", "))
}

/// A cause with its share, and the interval of that if not all findings were examined.
pub(super) type CauseShare = (Attribution, f64, Option<[f64; 2]>);

/// The causes that occur, as [`causes_text`] lists them.
pub(super) fn cause_shares<'a>(
    findings: impl Iterator<Item = &'a FindingPart>,
) -> Option<Vec<CauseShare>> {
    let chosen = findings
        .filter_map(|part| Some((part.rate.count as f64, part.causes.as_ref()?)))
        .filter(|(_, causes)| causes.by.values().any(|rate| rate.of > 0));
    let chosen: Vec<_> = chosen.collect();
    let found: f64 = chosen.iter().map(|(count, _)| count).sum();
    if found == 0.0 {
        return None;
    }
    let share = |attribution: Attribution| {
        let mut sums = [0.0; 3];
        let mut sampled = false;
        for (count, causes) in &chosen {
            let Some(rate) = causes.by.get(&attribution) else {
                continue;
            };
            let share = rate.rate.unwrap_or(0.0);
            let [low, high] = rate.interval.unwrap_or([share; 2]);
            sampled |= rate.interval.is_some();
            for (sum, x) in sums.iter_mut().zip([share, low, high]) {
                *sum += x * count / found;
            }
        }
        let [share, low, high] = sums;
        (share > 0.0).then_some((attribution, share, sampled.then_some([low, high])))
    };
    Some(Attribution::ALL.into_iter().filter_map(share).collect())
}

/// A number that is not negative, in few characters; none is infinite.
pub(super) fn short(value: Option<f64>) -> String {
    match value {
        None => "inf".to_owned(),
        Some(x) if x == 0.0 || (0.1..1000.0).contains(&x) => {
            let text = format!("{x:.1}");
            text.strip_suffix(".0").unwrap_or(&text).to_owned()
        }
        Some(x) => format!("{x:.1e}"),
    }
}
