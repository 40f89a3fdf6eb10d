//! The three worst findings of a record, in words, each with the command that shows it.

use super::columns::Column;
use super::group_digits;
use super::lines::Line;
use super::record::*;
use super::worst::severity_of;
use crate::audit::Attribution;
use crate::report::page::{Block, Item};

/// The worst case of one class of findings.
struct Extreme<'a> {
    line: &'a Line<'a>,
    part: &'a FindingPart,
    /// In longest edges of the triangle, and whether that is along the ray.
    distance: (f64, bool),
    cause: Option<Attribution>,
}

/// A promise across triangles that was broken, and the worst verdicts in ordinary sizes; at most so many.
pub(super) fn blocks(columns: &[Column], lines: &[Line], most: usize) -> Vec<Block> {
    let broken = lines.iter().find_map(|line| Some((line, broken_promise(line)?)));
    let worst = chosen(all(columns, lines), most - usize::from(broken.is_some()));
    let is_all = columns.iter().all(|column| column.is_ordinary());
    let place = if is_all { "" } else { " in ordinary sizes" };
    let head = match most {
        1 => format!("Worst{place}, in longest edges of the triangle:"),
        _ => format!("Worst{place}, in longest edges, of different causes and kernels:"),
    };
    let commands = broken.into_iter().map(|(line, (text, command))| {
        (format!("{}, {}: {text}", line.label(), line.row.scalar), command)
    });
    let worst =
        worst.iter().map(|extreme| (extreme.describe(), extreme.part.worst.command.clone()));
    let item = |(number, (text, command)): (usize, (String, String))| Item {
        text: format!("{}. {text}", number + 1),
        lines: vec![command],
        ..Item::default()
    };
    Block::items(&head, most, commands.chain(worst).enumerate().map(item).collect())
}

/// The promise across triangles that a row broke, and the command that shows the first case.
fn broken_promise(line: &Line) -> Option<(String, String)> {
    let across = line.across.as_ref().filter(|across| across.is_broken())?;
    let first = |ids: fn(&AcrossPart) -> &[String]| {
        let first = |result: &KernelResult| Some(ids(result.across.as_ref()?).first()?.clone());
        line.row.results.iter().find_map(|result| Some((*result, first(result)?)))
    };
    let [no_crack, _] = across.rules_out();
    let (what, [count, of], (result, id)) = if no_crack && 0 < across.cracks[0] {
        ("no triangle reports", across.cracks, first(|part| &part.first_cracks)?)
    } else {
        ("two triangles report", across.doubles, first(|part| &part.first_doubles)?)
    };
    let (count, of) = (group_digits(count), group_digits(of));
    let text = format!("broken promise, {what} {count} of {of} crossings");
    Some((text, line.row.part.explain_group(result, &id)))
}

/// The worst of each class of false misses, false hits and wrong values in ordinary sizes. A triangle without area may
/// be a point, which has no edge to measure by.
fn all<'a>(columns: &[Column], lines: &'a [Line<'a>]) -> Vec<Extreme<'a>> {
    let mut all = Vec::new();
    for line in lines {
        for column in columns.iter().filter(|column| column.is_ordinary()) {
            let results = column.results(&line.row).into_iter();
            let parts = results.flat_map(|result| &result.findings).filter(|part| {
                (part.finding.is_wrong_verdict() || part.finding == FindingKind::WrongValue)
                    && part.class != "degenerate"
            });
            all.extend(parts.filter(|part| part.worst.severity.is_some()).map(|part| Extreme {
                line,
                part,
                distance: severity_of(part),
                cause: part.causes.as_ref().and_then(|causes| causes.worst),
            }));
        }
    }
    all
}

/// The worst first; then the worst of what differs from those before it.
fn chosen(mut all: Vec<Extreme>, most: usize) -> Vec<Extreme> {
    all.sort_by(|a, b| b.distance.0.total_cmp(&a.distance.0));
    let mut chosen: Vec<Extreme> = Vec::new();
    while chosen.len() < most {
        let is_new = |differs: &dyn Fn(&Extreme, &Extreme) -> bool| {
            all.iter().position(|one| chosen.iter().all(|other| differs(one, other)))
        };
        let cause = |a: &Extreme, b: &Extreme| group(a.cause) != group(b.cause);
        let kernel = |a: &Extreme, b: &Extreme| {
            let is_other = a.line.row.part.kernel != b.line.row.part.kernel;
            is_other && a.part.worst.case != b.part.worst.case
        };
        let kind = |a: &Extreme, b: &Extreme| a.part.finding != b.part.finding;
        let next = is_new(&|a, b| cause(a, b) && kernel(a, b))
            .or_else(|| is_new(&cause))
            .or_else(|| is_new(&kernel))
            .or_else(|| is_new(&kind));
        let Some(next) = next else { break };
        chosen.push(all.remove(next));
    }
    chosen
}

/// Causes that are alike: rounding, overflow and underflow are all the arithmetic.
fn group(cause: Option<Attribution>) -> Option<Attribution> {
    cause.map(|cause| if cause == Attribution::Range { Attribution::Rounding } else { cause })
}

impl Extreme<'_> {
    /// Describes the fault, its size and its cause.
    fn describe(&self) -> String {
        let is_hit = self.part.finding == FindingKind::FalseHit;
        let distance = match self.distance.0 {
            d if (0.01..1000.0).contains(&d) => format!("{d:.2}"),
            d => format!("{d:.1e}"),
        };
        let class = &self.part.class;
        let severity = self.part.worst.severity.as_ref();
        let off_end = severity.and_then(|severity| severity.off_end.as_deref());
        let (at_rim, along) = (self.distance.0 == 0.0, self.distance.1);
        let touches =
            ["interior/", "edge/", "vertex/"].iter().any(|start| class.starts_with(start));
        let hit = if is_hit { "a hit" } else { "a miss" };
        let what = match (is_hit, along) {
            _ if self.part.finding == FindingKind::WrongValue => {
                format!("a right hit with a wrong value: its point is {distance} edges off")
            }
            _ if at_rim && along => format!("{hit} exactly at an end of the ray"),
            _ if at_rim => format!("{hit} exactly on the boundary"),
            (true, true) if off_end == Some("beyond") => {
                format!("a hit {distance} edges beyond the end of the ray")
            }
            (true, true) => format!("a hit {distance} edges before the start of the ray"),
            (true, false) if touches => "a hit of the triangle that must be missed".to_owned(),
            (true, false) => format!("a hit, but the ray passes {distance} edges away"),
            (false, true) => format!("a miss, but the hit is {distance} edges within the ray"),
            (false, false) => format!("a miss, but the ray hits {distance} edges inside"),
        };
        let cause = match self.cause {
            None => "",
            Some(Attribution::Convention) => "; cause: the formula",
            Some(Attribution::Epsilon) => "; cause: the epsilon",
            Some(Attribution::Rounding) => "; cause: rounding",
            Some(Attribution::Range) => "; cause: overflow or underflow",
            Some(Attribution::Transform) => "; cause: the instance's rounded inverse",
            Some(Attribution::NotEpsilon) => "; cause: not its epsilons",
        };
        format!("{}, {}: {what}{cause}", self.line.label(), self.line.row.scalar)
    }
}
