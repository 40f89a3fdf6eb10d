//! The worst examples in words: by how much a verdict is wrong and why, and the command that shows it.

use super::pool::{Pool, counted};
use super::row_view::RowView;
use crate::audit::Attribution;
use crate::judge::Class;
use crate::page::Item;
use hairline_record::{FindingClass, FindingKind, FindingPart, Rate};
use hairline_record::{across, counts_alone, cracks, polygons};
use std::collections::BTreeMap;

/// The findings of a row in a scalar, of each kind and of each class: how many, and the worst; then cracks and whole polygons.
pub(super) fn findings(row: &RowView) -> Vec<Item> {
    let mut parts: BTreeMap<(FindingKind, FindingClass), Vec<&FindingPart>> = BTreeMap::new();
    for result in &row.results {
        let alone = result
            .findings
            .iter()
            .filter(|part| counts_alone(result, part.finding));
        for finding in alone {
            parts
                .entry((finding.finding, finding.class))
                .or_default()
                .push(finding);
        }
    }
    let item = |text, command| Item::shown_by(format!("{} {text}", row.scalar), command);
    let of_class = |((kind, class), parts): (&(FindingKind, FindingClass), &Vec<&FindingPart>)| {
        let worse = |worst, part| {
            if severity(worst) < severity(part) {
                part
            } else {
                worst
            }
        };
        let worst: &FindingPart = parts.iter().copied().reduce(worse)?;
        let (count, how) = (row.found(*kind, *class), describe(worst));
        Some(item(
            format!("{kind} of {class}: {count}; worst: {how}"),
            worst.worst.command.clone(),
        ))
    };
    let mut items: Vec<Item> = parts.iter().filter_map(of_class).collect();
    for result in &row.results {
        let mut groups = across(result);
        // Those that leak are shown, whether they promise not to or not.
        if groups.iter().all(|found| found.kind != FindingKind::Crack) {
            groups.extend(cracks(result));
        }
        groups.extend(polygons(result));
        for found in groups {
            let Some(first) = found.first.first() else {
                continue;
            };
            let text = format!(
                "{} in {}: {}",
                found.kind,
                result.family,
                counted(found.rate)
            );
            items.push(item(text, result.explain_group(row.part, first)));
        }
    }
    items
}

impl RowView<'_> {
    /// The findings of a kind and a class.
    fn found(&self, kind: FindingKind, class: FindingClass) -> Pool {
        let alone = self
            .results
            .iter()
            .filter(|result| counts_alone(result, kind));
        let counts = alone.filter_map(|result| result.classes.get(&class));
        let rates: Vec<Rate> = counts.filter_map(|counts| counts.rate(kind)).collect();
        Pool::of(rates.iter())
    }
}

/// By how far the verdict is wrong, and whether that is a distance along the ray: for a false hit
/// before or beyond the extent it is.
fn severity_of(finding: &FindingPart) -> (f64, bool) {
    let Some(severity) = &finding.worst.severity else {
        return (0.0, false);
    };
    if let Some(off) = severity.value_off {
        return (off, false);
    }
    let is_outside = finding.class.truth().is_some_and(Class::is_outside);
    match severity.along {
        Some(along) if finding.finding == FindingKind::FalseHit && severity.off_end.is_some() => {
            let in_space = if is_outside { severity.in_space } else { 0.0 };
            if along > in_space {
                (along, true)
            } else {
                (in_space, false)
            }
        }
        // A hit at an end that does not count.
        Some(along) if finding.finding == FindingKind::FalseHit && along == 0.0 && !is_outside => {
            (along, true)
        }
        Some(along) if finding.finding == FindingKind::FalseMiss && along < severity.in_space => {
            (along, true)
        }
        _ => (severity.in_space, false),
    }
}

/// By how far the worst of a class is wrong, in longest edges of the triangle.
pub fn severity(finding: &FindingPart) -> f64 {
    severity_of(finding).0
}

/// The cause of the worst of a class.
pub(super) fn cause(finding: &FindingPart) -> Option<Attribution> {
    finding.causes.as_ref().and_then(|causes| causes.worst)
}

/// Describes the fault of the worst of a class, its size in longest edges and its cause.
pub(super) fn describe(part: &FindingPart) -> String {
    let (distance, along) = severity_of(part);
    let at_rim = distance == 0.0;
    let distance = match distance {
        d if (0.01..1000.0).contains(&d) => format!("{d:.2}"),
        d => format!("{d:.1e}"),
    };
    let off_end = part
        .worst
        .severity
        .as_ref()
        .and_then(|severity| severity.off_end.as_deref());
    let touches = part
        .class
        .truth()
        .is_some_and(|class| class.crosses() && !class.is_outside());
    let is_hit = part.finding == FindingKind::FalseHit;
    let hit = if is_hit { "a hit" } else { "a miss" };
    let what = match (part.finding, is_hit, along) {
        (FindingKind::WrongValue, ..) => {
            format!("a right hit with a wrong value: its point is {distance} edges off")
        }
        (FindingKind::BadValue, ..) => {
            "a value that is not finite, or of the wrong side".to_owned()
        }
        (kind, ..) if kind.is_failure() => "no verdict".to_owned(),
        _ if part.worst.severity.is_none() => format!("{hit}, on invalid input"),
        _ if at_rim && along => format!("{hit} exactly at an end of the ray"),
        _ if at_rim => format!("{hit} exactly on the boundary"),
        (_, true, true) if off_end == Some("beyond") => {
            format!("a hit {distance} edges beyond the end of the ray")
        }
        (_, true, true) => format!("a hit {distance} edges before the start of the ray"),
        (_, true, false) if touches => "a hit of the triangle that must be missed".to_owned(),
        (_, true, false) => format!("a hit, but the ray passes {distance} edges away"),
        (_, false, true) => format!("a miss, but the hit is {distance} edges within the ray"),
        (_, false, false) => format!("a miss, but the ray hits {distance} edges inside"),
    };
    let cause = match cause(part) {
        None => "",
        Some(Attribution::Convention) => "; cause: the formula",
        Some(Attribution::Epsilon) => "; cause: the epsilon",
        Some(Attribution::Rounding) => "; cause: rounding",
        Some(Attribution::Range) => "; cause: overflow or underflow",
        Some(Attribution::Transform) => "; cause: the instance's rounded inverse",
        Some(Attribution::NotEpsilon) => "; cause: not its epsilons",
    };
    format!("{what}{cause}")
}
