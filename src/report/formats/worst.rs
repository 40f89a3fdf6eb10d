//! The worst examples in words: by how much a verdict is wrong, and the command that shows it.

use super::disagreement::{across, cracks, polygons};
use super::group_digits;
use super::pool::Pool;
use super::rate::interval_of;
use super::record::{FindingKind, FindingPart, Rate};
use super::row_view::RowView;
use super::why::{causes_text, severity_text};
use crate::report::page::Item;
use std::collections::{BTreeMap, BTreeSet};

/// The findings of a row in a scalar, of each kind and of each class: how many, how far off, why, and the worst with so
/// many of the first; then cracks and whole polygons.
pub(super) fn findings(row: &RowView, examples: usize) -> Vec<Item> {
    // The empty class stands for all.
    let mut parts: BTreeMap<(FindingKind, &str), Vec<&FindingPart>> = BTreeMap::new();
    for finding in row.results.iter().flat_map(|result| &result.findings) {
        for class in ["", &finding.class] {
            parts.entry((finding.finding, class)).or_default().push(finding);
        }
    }
    let scalar = row.scalar;
    let mut items = Vec::new();
    for ((kind, class), parts) in &parts {
        let first = parts[0];
        let finding = parts
            .iter()
            .fold(first, |worst, part| if severity(worst) < severity(part) { part } else { worst });
        let pool = row.found(*kind, class);
        let rate = pool.rate();
        let share = interval_of(rate);
        let (count, of) = (group_digits(rate.count), group_digits(rate.of));
        let apart = pool.apart().map_or(String::new(), |apart| format!(", stored cases {apart}"));
        let distance = describe_severity(finding);
        let (named, worst) = match *class {
            "" => (String::new(), format!("{}, ", finding.class)),
            class => (format!(" {class}"), String::new()),
        };
        let text = format!(
            "{scalar} {kind}{named}: {count} of {of}{share}{apart}; worst {worst}{distance}"
        );
        let mut notes = Vec::new();
        let severity = row.total.and_then(|total| total.severity.get(kind));
        notes.extend(severity.filter(|_| class.is_empty()).map(severity_text));
        let causes = causes_text(parts.iter().copied());
        notes.extend(causes.map(|causes| format!("why: {causes}")));
        let mut lines = vec![finding.worst.command.clone(), finding.worst.bits.clone()];
        if !class.is_empty() {
            let first =
                parts.iter().flat_map(|part| part.first.iter().take(examples).chain([&part.worst]));
            for example in first.filter(|_| 0 < examples) {
                lines.extend([example.command.clone(), example.bits.clone()]);
            }
        }
        let mut seen = BTreeSet::new();
        lines.retain(|line| !line.is_empty() && seen.insert(line.clone()));
        items.push(Item { text, notes, lines, ..Item::default() });
    }
    for result in &row.results {
        let mut groups = across(result);
        // Those that leak are shown, whether they promise not to or not.
        if groups.iter().all(|(kind, ..)| *kind != FindingKind::Crack) {
            groups.extend(cracks(result));
        }
        groups.extend(polygons(result));
        for (kind, rate, _, first) in groups.into_iter().filter(|(_, rate, ..)| 0 < rate.count) {
            let (count, of) = (group_digits(rate.count), group_digits(rate.of));
            let promised = result.across.as_ref().map_or(String::new(), |across| {
                format!("; promised across triangles: {}", across.promised)
            });
            let text = format!("{scalar} {kind} in {}: {count} of {of}{promised}", result.family);
            let ids = first.iter().take(examples.max(1));
            let lines = ids.map(|id| row.part.explain_group(result, id)).collect();
            items.push(Item { text, lines, ..Item::default() });
        }
    }
    items
}

impl RowView<'_> {
    /// The findings of a kind, of a class or of all.
    fn found(&self, kind: FindingKind, class: &str) -> Pool {
        let counts = self.results.iter().filter_map(|result| match class {
            "" => Some(&result.total),
            class => result.classes.get(class),
        });
        let rates: Vec<Rate> = counts.filter_map(|counts| counts.rate(kind)).collect();
        Pool::of(rates.iter())
    }
}

/// By how far the verdict is wrong, and whether that is a distance along the ray: for a false hit
/// before or beyond the extent it is.
pub(super) fn severity_of(finding: &FindingPart) -> (f64, bool) {
    let Some(severity) = &finding.worst.severity else { return (0.0, false) };
    if let Some(off) = severity.value_off {
        return (off, false);
    }
    match severity.along {
        Some(along) if finding.finding == FindingKind::FalseHit && severity.off_end.is_some() => {
            let outside = finding.class.starts_with("outside");
            let in_space = if outside { severity.in_space } else { 0.0 };
            if along > in_space { (along, true) } else { (in_space, false) }
        }
        // A hit at an end that does not count.
        Some(along)
            if finding.finding == FindingKind::FalseHit
                && along == 0.0
                && !finding.class.starts_with("outside") =>
        {
            (along, true)
        }
        Some(along) if finding.finding == FindingKind::FalseMiss && along < severity.in_space => {
            (along, true)
        }
        _ => (severity.in_space, false),
    }
}

pub(super) fn severity(finding: &FindingPart) -> f64 {
    severity_of(finding).0
}

pub(super) fn describe_severity(finding: &FindingPart) -> String {
    if finding.finding.is_failure() {
        return "on the case below".to_owned();
    }
    let Some(severity) = &finding.worst.severity else { return "on invalid input".to_owned() };
    let (distance, along) = severity_of(finding);
    if distance == 0.0 && severity.value_off.is_none() {
        return if along {
            "exactly at an end".to_owned()
        } else {
            "exactly on the boundary".to_owned()
        };
    }
    let ulps = distance * severity.edge_in_ulps;
    if severity.value_off.is_some() {
        return format!(
            "by {distance:.2e} of the longest edge from the exact point ({ulps:.2e} ulps of the largest coordinate)"
        );
    }
    let what = if along {
        "of the longest edge from an end of the extent"
    } else {
        "of the longest edge from the boundary"
    };
    format!("by {distance:.2e} {what} ({ulps:.2e} ulps of the largest coordinate)")
}
