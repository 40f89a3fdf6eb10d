//! The worst examples in words: by how much a verdict is wrong, and the command that shows it.

use super::disagreement::polygons;
use super::pool::Pool;
use super::rate::interval_of;
use super::record::{FindingKind, FindingPart, Rate};
use super::row_view::RowView;
use super::why::{causes_text, severity_text};
use super::{Style, group_digits};
use std::collections::BTreeMap;
use std::io::{self, Write};

/// For each row and kind of finding the worst example, then that of each class.
pub(super) fn write_worst(rows: &[RowView], style: Style, out: &mut dyn Write) -> io::Result<()> {
    let (bold, plain) = if style.color { ("\x1b[1m", "\x1b[0m") } else { ("", "") };
    writeln!(out, "\n{bold}Worst findings of each kind and of each class{plain}")?;
    for row in rows {
        // The empty class stands for all.
        let mut worst: BTreeMap<(FindingKind, &str), &FindingPart> = BTreeMap::new();
        for finding in row.results.iter().flat_map(|result| &result.findings) {
            for class in ["", &finding.class] {
                let entry = worst.entry((finding.finding, class)).or_insert(finding);
                if severity(entry) < severity(finding) {
                    *entry = finding;
                }
            }
        }
        let label = format!("{} ({})", row.part.kernel, row.part.set);
        let cracks = row.first_cracks();
        let polygons = row.results.iter().flat_map(|result| polygons(result));
        let polygons: Vec<_> = polygons.filter(|(_, rate, ..)| 0 < rate.count).collect();
        if worst.is_empty() && cracks.is_empty() && polygons.is_empty() {
            writeln!(out, "{label}: none\n    contract: {}", row.part.contract)?;
            continue;
        }
        writeln!(out, "{label}\n    contract: {}", row.part.contract)?;
        for ((kind, class), finding) in &worst {
            let pool = row.found(*kind, class);
            let rate = pool.rate();
            let share = interval_of(rate);
            let (count, of) = (group_digits(rate.count), group_digits(rate.of));
            let apart =
                pool.apart().map_or(String::new(), |apart| format!(", stored cases {apart}"));
            let distance = describe_severity(finding);
            let (named, worst) = match *class {
                "" => (String::new(), format!("{}, ", finding.class)),
                class => (format!(" {class}"), String::new()),
            };
            writeln!(
                out,
                "    {kind}{named}: {count} of {of}{share}{apart}; worst {worst}{distance}"
            )?;
            let severity = row.total.and_then(|total| total.severity.get(kind));
            match severity {
                Some(severity) if class.is_empty() => {
                    writeln!(out, "        {}", severity_text(severity))?;
                }
                _ => {}
            }
            if let Some(causes) = causes_text(&row.results, *kind, class) {
                writeln!(out, "        why: {causes}")?;
            }
            writeln!(out, "        {}", finding.worst.command)?;
            writeln!(out, "        {}", finding.worst.bits)?;
        }
        for (result, id) in cracks {
            let family = &result.family;
            writeln!(
                out,
                "    crack, first of {family}: no triangle of the group reports the hit"
            )?;
            writeln!(out, "        {}", row.part.explain_group(result, id))?;
        }
        for (kind, rate, _, first) in polygons {
            let (count, of) = (group_digits(rate.count), group_digits(rate.of));
            writeln!(out, "    {kind}: {count} of {of} whole polygons")?;
            for id in first.iter().take(1) {
                writeln!(out, "        {}", row.part.explain_command(id))?;
            }
        }
    }
    Ok(())
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
