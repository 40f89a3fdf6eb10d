//! The worst examples in words: by how much a verdict is wrong, and the command that shows it.

use super::disagreement::polygons;
use super::pool::Pool;
use super::rate::interval_of;
use super::record::{FindingPart, KernelResult, Rate, RowPart};
use super::row_view::RowView;
use super::why::{causes_text, severity_text};
use super::{Style, group_digits};
use crate::audit::{RowSpec, flags};
use std::collections::BTreeMap;
use std::io::{self, Write};

impl RowPart {
    /// The row as text that this program can run again, if it has the kernel.
    pub(super) fn spec(&self) -> RowSpec {
        RowSpec {
            kernel: self.kernel.clone(),
            set: Some(self.set.clone()),
            epsilons: self.epsilon_argument(),
            contract: self.contract_words.clone(),
        }
    }

    fn epsilon_argument(&self) -> Option<String> {
        let pairs = self.epsilons.iter().map(|(gate, value)| format!("{gate}={value}"));
        Some(pairs.collect::<Vec<_>>().join(",")).filter(|words| !words.is_empty())
    }

    /// The flags that make this row again.
    pub(crate) fn flags(&self) -> String {
        flags(&self.selector, self.epsilon_argument().as_deref(), &self.contract_words)
    }

    /// The command that shows a group of a result again by its id.
    pub(super) fn explain_group(&self, result: &KernelResult, id: &str) -> String {
        let file = result.across.as_ref().and_then(|across| across.file.as_deref());
        let command = self.explain_command(id);
        file.map_or(command.clone(), |flag| format!("{command} {flag}"))
    }

    /// The command that shows a case again by its id.
    pub(super) fn explain_command(&self, id: &str) -> String {
        format!("hairline explain '{id}' {}", self.flags()).trim_end().to_owned()
    }
}

/// For each row and kind of finding the worst example, then that of each class.
pub(super) fn write_worst(rows: &[RowView], style: Style, out: &mut dyn Write) -> io::Result<()> {
    let (bold, plain) = if style.color { ("\x1b[1m", "\x1b[0m") } else { ("", "") };
    writeln!(out, "\n{bold}Worst findings of each kind and of each class{plain}")?;
    for row in rows {
        // The empty class stands for all.
        let mut worst: BTreeMap<(&str, &str), &FindingPart> = BTreeMap::new();
        for finding in row.results.iter().flat_map(|result| &result.findings) {
            for class in ["", &finding.class] {
                let entry = worst.entry((&finding.finding, class)).or_insert(finding);
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
            let pool = row.found(kind, class);
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
            let severity = row.total.and_then(|total| total.severity.get(*kind));
            match severity {
                Some(severity) if class.is_empty() => {
                    writeln!(out, "        {}", severity_text(severity))?;
                }
                _ => {}
            }
            if let Some(causes) = causes_text(&row.results, kind, class) {
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
    fn found(&self, kind: &str, class: &str) -> Pool {
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
    let off_end = finding.class.ends_with("/before") || finding.class.ends_with("/beyond");
    match severity.along {
        Some(along) if finding.finding == "false-hit" && off_end => {
            let outside = finding.class.starts_with("outside");
            let in_space = if outside { severity.in_space } else { 0.0 };
            if along > in_space { (along, true) } else { (in_space, false) }
        }
        // A hit at an end that does not count.
        Some(along)
            if finding.finding == "false-hit"
                && along == 0.0
                && !finding.class.starts_with("outside") =>
        {
            (along, true)
        }
        Some(along) if finding.finding == "false-miss" && along < severity.in_space => {
            (along, true)
        }
        _ => (severity.in_space, false),
    }
}

pub(super) fn severity(finding: &FindingPart) -> f64 {
    severity_of(finding).0
}

pub(super) fn describe_severity(finding: &FindingPart) -> String {
    if matches!(finding.finding.as_str(), "panic" | "crash" | "timeout") {
        return "on the case below".to_owned();
    }
    let Some(severity) = &finding.worst.severity else { return "on invalid input".to_owned() };
    let (distance, along) = severity_of(finding);
    if distance == 0.0 {
        return if along {
            "exactly at an end".to_owned()
        } else {
            "exactly on the boundary".to_owned()
        };
    }
    let ulps = distance * severity.edge_in_ulps;
    let what = if along {
        "of the longest edge from an end of the extent"
    } else {
        "of the longest edge from the boundary"
    };
    format!("by {distance:.2e} {what} ({ulps:.2e} ulps of the largest coordinate)")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_kernel_of_ones_own_is_chosen_by_its_own_flag() {
        let mut row = RowPart {
            kernel: "mine".to_owned(),
            selector: "--kernel-lib './libmine.so'".to_owned(),
            set: "source".to_owned(),
            epsilons: [("t".to_owned(), "1e-6".to_owned())].into(),
            contract: String::new(),
            contract_words: "own".to_owned(),
        };
        let command = "hairline explain 'x' --kernel-lib './libmine.so'";
        assert_eq!(row.explain_command("x"), format!("{command} --epsilon 't=1e-6'"));
        row.epsilons.clear();
        assert_eq!(row.explain_command("x"), command);
        row.contract_words = "closed-ray,band=1e-3".to_owned();
        assert_eq!(
            row.explain_command("x"),
            format!("{command} --contract closed-ray --band 1e-3")
        );
    }
}
