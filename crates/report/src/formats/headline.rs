//! The first line of a `check`: the verdict and the likeliest reason, short enough for one line of a log.

use super::relations;
use hairline_record::{
    ComparisonVerdict, Conformance, Deviation, FindingKind, Method, Record, RowChange,
    group_digits, number_of,
};

/// A setting that is longer is not told in the first line.
const LONGEST_VALUE: usize = 12;

/// The first line: `Worse: mine computes with fused products`.
pub(super) fn headline(record: &Record, conformance: &Conformance) -> String {
    match conformance.verdict {
        ComparisonVerdict::Conforms => conforming(conformance),
        ComparisonVerdict::Stale => better(conformance),
        ComparisonVerdict::Unsteady => {
            let kernels = kernels(conformance.unsteady.iter().map(|found| &*found.kernel));
            format!("Cannot be compared: answers of {kernels} differ from run to run")
        }
        ComparisonVerdict::Disagreements => worse(record, conformance),
    }
}

fn conforming(conformance: &Conformance) -> String {
    let known: u64 = conformance
        .known
        .iter()
        .map(|found| found.found.count)
        .sum();
    match (conformance.method, known) {
        (_, 0) if conformance.too_rare_to_tell == 0 => "Conforms: no wrong answer".to_owned(),
        (Method::Intervals, _) => {
            "Conforms: wrong answers are as frequent as known, within their intervals".to_owned()
        }
        (Method::CaseByCase, known) => {
            let answers = number_of(known, "wrong answer", "wrong answers");
            format!("Conforms: {answers}, all known, and none gone")
        }
    }
}

fn better(conformance: &Conformance) -> String {
    let [_, fewer] = conformance.more_and_fewer();
    if conformance.stale.is_empty() {
        return "Better: values of right hits are more accurate than known".to_owned();
    }
    let kernels = kernels(conformance.stale.iter().map(|found| &*found.kernel));
    match fewer {
        0 => format!("Better: {kernels}, wrong less often than known"),
        fewer => {
            let answers = number_of(fewer, "wrong answer", "wrong answers");
            format!("Better: {kernels}, {answers} fewer than known, none more")
        }
    }
}

fn worse(record: &Record, conformance: &Conformance) -> String {
    let unexpected = &conformance.unexpected;
    if unexpected.is_empty() {
        return match conformance.unproved.len() {
            0 => "Worse: values of right hits are less accurate than known".to_owned(),
            1 => "Worse: a proof is missing that must hold".to_owned(),
            missing => format!("Worse: {missing} proofs are missing that must hold"),
        };
    }
    let lead = match conformance.expectations {
        Some(_) => "Worse",
        None => "Wrong",
    };
    if let Some(failure) = unexpected.iter().find(|found| found.finding.is_failure()) {
        return format!("{lead}: {}", failing(unexpected, failure));
    }
    if let Some(mistake) = relations::new_mistakes(record, conformance)
        .into_iter()
        .next()
    {
        return format!("{lead}: {mistake}");
    }
    let [more, fewer] = conformance.more_and_fewer();
    let lead = match more < fewer {
        true => "Mixed",
        false => lead,
    };
    if let Some(computed) = conformance.computes.first() {
        let how = match computed.is_fused {
            true => "fused products".to_owned(),
            false => format!("another epsilon than {}", computed.formula),
        };
        return format!("{lead}: {} computes with {how}", computed.kernel);
    }
    if let Some(change) = conformance.rows.first() {
        return format!("{lead}: {}", set_otherwise(change));
    }
    changed(conformance, lead)
}

/// `mine has another epsilon parallel than known: 1e-5, not 1e-6`.
fn set_otherwise(change: &RowChange) -> String {
    let RowChange {
        kernel,
        what,
        before,
        now,
        ..
    } = change;
    let values = match before.len().max(now.len()) <= LONGEST_VALUE {
        true => format!(": {now}, not {before}"),
        false => String::new(),
    };
    format!("{kernel} has another {what} than known{values}")
}

/// `mine crashes on 3 cases more than known`.
fn failing(unexpected: &[Deviation], first: &Deviation) -> String {
    let of_kind = unexpected
        .iter()
        .filter(|found| found.finding == first.finding && found.kernel == first.kernel);
    let more: u64 = of_kind.map(Deviation::more_than_known).sum();
    let does = match first.finding {
        FindingKind::Crash => "crashes",
        FindingKind::Panic => "panics",
        _ => "gives no answer",
    };
    let cases = match more {
        0 => "other cases".to_owned(),
        more => format!("{} more", number_of(more, "case", "cases")),
    };
    format!("{} {does} on {cases} than known", first.kernel)
}

/// How much changed, where no reason is known.
fn changed(conformance: &Conformance, lead: &str) -> String {
    let unexpected = &conformance.unexpected;
    let kernels = kernels(unexpected.iter().map(|found| &*found.kernel));
    let classes = || number_of(unexpected.len() as u64, "class", "classes");
    if conformance.expectations.is_none() {
        let answers = unexpected.iter().map(|found| found.found.count).sum();
        let answers = number_of(answers, "wrong answer", "wrong answers");
        return format!("{answers} of {kernels}, and no file says which are known");
    }
    let [more, fewer] = conformance.more_and_fewer();
    match (more, fewer) {
        (0, 0) if conformance.method == Method::CaseByCase => {
            format!("Changed: {kernels}, wrong as often as known, on other cases")
        }
        (0, _) => format!("{lead}: {kernels}, wrong more often in {}", classes()),
        (more, 0) => {
            let answers = number_of(more, "wrong answer", "wrong answers");
            format!("{lead}: {kernels}, {answers} more than known")
        }
        (more, fewer) if more < fewer => {
            let answers = number_of(fewer, "wrong answer", "wrong answers");
            format!(
                "{lead}: {kernels}, {answers} fewer and {} more",
                group_digits(more)
            )
        }
        (more, fewer) => {
            let answers = number_of(more, "wrong answer", "wrong answers");
            format!(
                "{lead}: {kernels}, {answers} more and {} fewer",
                group_digits(fewer)
            )
        }
    }
}

/// The first of some kernels, and how many others there are.
fn kernels<'a>(names: impl Iterator<Item = &'a str>) -> String {
    let mut all: Vec<&str> = Vec::new();
    for name in names {
        if !all.contains(&name) {
            all.push(name);
        }
    }
    match all[..] {
        [] => String::new(),
        [only] => only.to_owned(),
        [first, _] => format!("{first} and 1 other"),
        [first, ..] => format!("{first} and {} others", all.len() - 1),
    }
}
