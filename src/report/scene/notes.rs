//! What is said of recommended numbers: what they mean in the scene, and what no number can do.

use super::record::*;
use super::words::{human, meaning, share, spaced};
use crate::epsilon::scene::{Costs, Kind};
use crate::report::group_digits;
use crate::report::record::Rate;

/// From fewer rays of each kind the numbers depend on the seed: what is rare decides them.
const FEW: u64 = 10_000;

/// What is said of the best fixed numbers, a sentence each.
pub(super) fn notes(record: &SceneRecord, part: &SceneKernelPart) -> Vec<String> {
    let pairs = part.knobs.iter().zip(&part.tried[0].epsilons);
    let meanings = pairs.filter_map(|(knob, epsilon)| meaning(record, part, knob, epsilon));
    let mut notes: Vec<String> = no_good(record, part);
    notes.extend(meanings);
    notes.extend(cracks_of_its_own(record, part));
    if part.knobs.iter().all(|knob| !knob.is_gate) && part.others.is_empty() {
        notes.push(
            "the kernel has no epsilons, so the least t is all that there is to choose".to_owned(),
        );
    }
    if record.count < FEW {
        notes.push(format!(
            "from {} rays of each kind only: another seed may name others, up to tenfold",
            group_digits(record.count)
        ));
    }
    if !part.others.is_empty() {
        let others = part.others.iter().map(|(gate, e)| format!("{gate}={e}"));
        notes.push(format!("not chosen here: {}", others.collect::<Vec<_>>().join(", ")));
    }
    match part.is_accurate {
        Some(false) => {
            let most = most_errors(record);
            notes.push(format!(
                "these rays show no fixed values at which 99 % of the hits are off by at most {most}:"
            ));
            let advice = "it takes more rays (-n), wider numbers, another kernel or other rays";
            notes.push(advice.to_owned());
        }
        _ => notes.extend(accuracy(record)),
    }
    notes
}

/// A line is no good if more than this share of plain hits is lost, or of rays slips through.
const TOO_MANY: f64 = 0.01;

/// Whether a count is one of the wrong answers that no scene can live with: hits lost that are aimed at a triangle,
/// and cracks.
fn is_plain(count: &CountPart) -> bool {
    count.stratum == "scene-interior" && count.kind == "miss" || count.kind == "crack"
}

/// Where even the best numbers are no good: that they are not, why, and what helps.
fn no_good(record: &SceneRecord, part: &SceneKernelPart) -> Vec<String> {
    // Numbers that were not to be chosen may be what is wrong.
    if part.others.keys().any(|gate| gate != "t") {
        return Vec::new();
    }
    let plain = part.counts.iter().zip(&part.tried[0].wrong).filter(|(count, _)| is_plain(count));
    // Without an epsilon at the edges, cracks are the kernel's, whatever the numbers are.
    let theirs = plain.filter(|(count, _)| count.kind == "miss" || part.has_edge_epsilon);
    // Of few rays a single loss is a large share.
    let surely = |rate: &Rate| rate.interval.map_or(0.0, |[low, _]| low);
    let worst = theirs.max_by(|(_, a), (_, b)| surely(a).total_cmp(&surely(b)));
    let Some((count, rate)) = worst.filter(|(_, rate)| TOO_MANY < surely(rate)) else {
        return Vec::new();
    };
    let what = match (count.kind.as_str(), share(rate)) {
        ("miss", share) => format!("lose {share} of the hits at a triangle"),
        (_, share) => format!("let {share} of the rays at shared edges or vertices through"),
    };
    let unit = spaced(&record.unit);
    let instead = match part.scalar.as_str() {
        "f32" => "use f64, or start rays nearer",
        _ => "move the scene to the origin, or start rays nearer",
    };
    let why = match record.edge[0] < 32.0 * part.spacing {
        true => format!(
            "rays start up to {:.0e}{unit} away, where the numbers of {} are {}{unit} apart: {instead}",
            record.reach,
            part.scalar,
            human(&format!("{:.0e}", part.spacing))
        ),
        false if part.scalar == "f32" => "use f64 or another kernel".to_owned(),
        false => "use another kernel".to_owned(),
    };
    // With other weights the user may have asked for it.
    let default = Costs::default();
    let is_default = |cost: &NamedNumber| {
        Kind::ALL
            .into_iter()
            .any(|kind| kind.name() == cost.name && default.of(kind) == cost.number)
    };
    match record.costs.iter().all(is_default) {
        true => vec![format!("no numbers are good here: even these {what}"), why],
        false => vec![
            format!("with these costs even the best numbers {what}"),
            "other weights (--cost) may help".to_owned(),
        ],
    }
}

/// Of a kernel whose cracks no number closes: that they are most of its cost, and what helps.
fn cracks_of_its_own(record: &SceneRecord, part: &SceneKernelPart) -> Vec<String> {
    let best = &part.tried[0];
    let cracks = part.counts.iter().zip(&best.wrong).filter(|(count, _)| count.kind == "crack");
    let weight = record.costs.iter().find(|cost| cost.name == "crack").map_or(0.0, |c| c.number);
    let cost: f64 = cracks.map(|(_, rate)| weight * rate.rate.unwrap_or(0.0)).sum();
    if !part.has_edge_epsilon && 0.5 * best.cost < cost {
        return vec![
            format!(
                "{cost:.2} of its cost of {:.2} are cracks, which no number here closes: give its edge test",
                best.cost
            ),
            "an epsilon, or use a watertight kernel (plucker, woop-watertight)".to_owned(),
        ];
    }
    Vec::new()
}

/// Whether what is recommended tolerates a little beside the edges.
pub(super) fn tolerates(part: &SceneKernelPart) -> bool {
    let mut pairs = part.knobs.iter().zip(&part.tried[0].epsilons);
    pairs.any(|(knob, epsilon)| knob.role == "edge" && epsilon.starts_with('-'))
}

/// What was wanted of the errors of epsilons that keep it; none if nothing was.
pub(super) fn accuracy(record: &SceneRecord) -> Option<String> {
    let wanted = || {
        let most = most_errors(record);
        format!("chosen so that 99 % of the hits that remain are off by at most {most}")
    };
    (!record.max_error.is_empty()).then(wanted)
}

/// The largest errors that were wanted, in words.
fn most_errors(record: &SceneRecord) -> String {
    let words = record.max_error.iter().map(|NamedNumber { name, number }| {
        let most = human(&format!("{number:e}"));
        match name.as_str() {
            "t" => format!("{most} of t"),
            _ => format!("{most}{} of the point", spaced(&record.unit)),
        }
    });
    words.collect::<Vec<_>>().join(", ")
}
