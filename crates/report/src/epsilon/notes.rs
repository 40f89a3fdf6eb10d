//! The notes on recommended numbers: what they mean in the scene, and what no number can do.

use super::meaning::meaning;
use super::numbers::{cost_text, human, least_normal, share};
use super::record::*;
use super::words::spaced;
use crate::arith::ScalarName;
use crate::case::ShortNumber;
use hairline_advice::epsilon::{Costs, SCALE_FREE, WrongKind};
use hairline_record::Rate;
use hairline_record::number_of;

/// From fewer rays of each kind the numbers depend on the seed: what is rare decides them.
const FEW: u64 = 10_000;

/// From fewer they say nothing.
const TOO_FEW: u64 = 1_000;

/// The notes on the best fixed numbers, a sentence each.
pub(super) fn notes(record: &SceneResult, part: &SceneKernelPart) -> Vec<String> {
    let pairs = part.knobs.iter().zip(&part.tried[0].epsilons);
    let meanings = pairs.filter_map(|(knob, epsilon)| meaning(record, part, knob, epsilon));
    let mut notes: Vec<String> = meanings.collect();
    notes.extend(proofs(part));
    notes.extend(cracks_of_its_own(record, part));
    if part.knobs.iter().all(|knob| !knob.is_gate) && part.others.is_empty() {
        notes.push(
            "the kernel declares no epsilons, so the least t is all that there is to choose"
                .to_owned(),
        );
    }
    notes.extend(few_rays(record, record.rays_of(part)));
    for (gate, e) in &part.others {
        let instead = if gate == "t" {
            ": the least t is chosen in its place"
        } else {
            ""
        };
        notes.push(format!("{gate}={e} is kept{instead}"));
    }
    notes.extend(overweighed(record, part));
    match part.is_accurate {
        Some(false) => {
            let most = most_errors(record);
            notes.push(format!(
                "these rays show no fixed values at which 99 % of the hits are off by at most {most}: it takes more rays \
                 (-n), wider numbers, another kernel or other rays"
            ));
        }
        _ => notes.extend(accuracy(record)),
    }
    notes
}

/// How much more of the plain hits a limit loses than the recommended numbers do, or makes false hits of more rays beside
/// triangles; none if it has no such price.
pub(super) fn price(
    part: &SceneKernelPart,
    price: Option<&PricePart>,
) -> Option<(f64, &'static str)> {
    let PricePart { count, wrong } = price?;
    let what = match part.counts[*count].kind {
        WrongKind::Miss => "more of the hits at a triangle lost",
        _ => "more of the rays beside a triangle hit it",
    };
    Some((wrong.rate? - part.tried[0].wrong[*count].rate?, what))
}

/// The numbers beyond the recommended ones that are proved to refuse every parallel ray, with their price.
fn proofs(part: &SceneKernelPart) -> impl Iterator<Item = String> {
    part.proved
        .iter()
        .filter(|proved| proved.is_lower)
        .filter_map(|proved| {
            let (name, value) = (&part.knobs[proved.knob].name, &proved.value);
            let is_beyond =
                part.tried[0].epsilons[proved.knob].parse::<f64>().ok()? < value.parse().ok()?;
            let (more, _) = price(part, proved.price.as_ref().filter(|_| is_beyond))?;
            let price = match more {
                ..0.0005 => "no hits lost".to_owned(),
                _ => format!("{:.1}% of hits lost", 100.0 * more),
            };
            Some(format!(
                "proved for all parallel rays: {name} >= {value}, {price}"
            ))
        })
}

/// A note if so many rays of each kind are too few to choose epsilons by.
pub(super) fn few_rays(record: &SceneResult, rays: u64) -> Option<String> {
    if !record.has_scene() {
        return None;
    }
    let advice = match rays {
        ..TOO_FEW => "too few to choose by; leave out -n",
        TOO_FEW..FEW => "another seed may name quite others",
        _ => return None,
    };
    let rays = number_of(rays, "ray", "rays");
    Some(format!("from {rays} of each kind only: {advice}"))
}

/// The share of wrong answers from which on no scene can live with them, by what is counted; none where a scene may
/// have to.
fn too_many(part: &SceneKernelPart, count: &RayCount) -> Option<f64> {
    let Rays::Stratum(stratum) = count.rays else {
        return None;
    };
    match (stratum, count.kind) {
        (Stratum::Interior, WrongKind::Miss) | (_, WrongKind::SelfHit) => Some(0.01),
        // Without an epsilon at the edges, cracks are the kernel's, whatever the numbers are.
        (_, WrongKind::Crack) => part.has_edge_epsilon.then_some(0.01),
        // About as many as the triangles are made larger.
        (Stratum::Outside, _) => Some(0.1),
        _ => None,
    }
}

/// Where even the best epsilons are no good: that they are not, why, and what helps.
pub(super) fn no_good(
    record: &SceneResult,
    part: &SceneKernelPart,
    tried: &TriedPart,
) -> Vec<String> {
    // Numbers that were not to be chosen may be what is wrong.
    if record.rays_of(part) < TOO_FEW {
        return Vec::new();
    }
    if part.others.keys().any(|gate| gate != "t") {
        return Vec::new();
    }
    // Of few rays a single loss is a large share.
    let surely = |rate: &Rate| rate.interval.map_or(0.0, |[low, _]| low);
    let all = part.counts.iter().zip(&tried.wrong);
    let excess = |(count, rate)| Some((surely(rate) / too_many(part, count)?, count, rate));
    let found = all.filter_map(excess).filter(|(excess, ..)| 1.0 < *excess);
    // Self-hits have a remedy of their own, so they are named where nothing else is wrong.
    let is_own = |count: &RayCount| count.kind != WrongKind::SelfHit;
    let worst = found
        .max_by(|(a, one, _), (b, other, _)| is_own(one).cmp(&is_own(other)).then(a.total_cmp(b)));
    let Some((_, count, rate)) = worst else {
        return Vec::new();
    };
    let share = share(rate);
    let what = match count.kind {
        WrongKind::Miss => format!("lose {share} of the hits at a triangle"),
        WrongKind::Crack => format!("let {share} of the rays at shared edges or vertices through"),
        WrongKind::SelfHit => {
            format!("let {share} of the shadow rays hit the triangle that they leave")
        }
        _ => format!("make false hits of {share} of the rays beside a triangle"),
    };
    if !record.max_error.is_empty() {
        return vec![
            format!("with errors as small as wanted even the best epsilons {what}"),
            "a larger --max-error may help".to_owned(),
        ];
    }
    if !has_default_costs(record) {
        return vec![
            format!("with these costs even the best epsilons {what}"),
            "other weights (--cost) may help".to_owned(),
        ];
    }
    let is_fixed = tried.name != SCALE_FREE;
    let followed = part.relative.as_ref().filter(|_| is_fixed);
    if followed.is_some_and(|followed| no_good(record, part, followed).is_empty()) {
        return vec![format!("no fixed numbers are good here: even these {what}")];
    }
    vec![
        format!("no numbers are good here: even these {what}"),
        instead(record, part, count.kind),
    ]
}

pub(super) fn has_default_costs(record: &SceneResult) -> bool {
    let default = Costs::default();
    WrongKind::ALL
        .into_iter()
        .all(|kind| default.of(kind) == record.cost(kind))
}

/// True if nobody should use these epsilons. With other weights, or a limit of errors, the user may have asked for what
/// they do.
pub(super) fn is_no_good(record: &SceneResult, part: &SceneKernelPart, tried: &TriedPart) -> bool {
    let is_asked_for = !record.max_error.is_empty() || !has_default_costs(record);
    !is_asked_for && !no_good(record, part, tried).is_empty()
}

/// From this cost of a single wrong answer on, chance decides what is chosen.
const HEAVY: f64 = 0.01;

/// A note if one wrong answer among so many rays decides under the given weights: they need more rays.
fn overweighed(record: &SceneResult, part: &SceneKernelPart) -> Option<String> {
    let of_count = |(count, rate): (&RayCount, &Rate)| {
        (0 < rate.of).then(|| (record.cost(count.kind) / rate.of as f64, count.kind))
    };
    let all = part
        .counts
        .iter()
        .zip(&part.tried[0].wrong)
        .filter_map(of_count);
    let (cost, kind) = all.max_by(|a, b| a.0.total_cmp(&b.0))?;
    let is_heavy = HEAVY < cost && TOO_FEW <= record.rays_of(part);
    is_heavy.then(|| {
        format!(
            "a single {kind} among these rays costs {}: such weights need more rays (-n)",
            cost_text(cost)
        )
    })
}

/// True if the scalar's numbers are too far apart for the smallest triangles.
pub(super) fn is_coarse(record: &SceneResult, part: &SceneKernelPart) -> bool {
    record.has_scene() && record.edge[0] < 32.0 * part.spacing
}

/// True if products of three of the smallest triangle's lengths lose digits, because the scalar has none so small.
fn is_tiny(record: &SceneResult, part: &SceneKernelPart) -> bool {
    let epsilon = if part.scalar == ScalarName::F32 {
        f32::EPSILON.into()
    } else {
        f64::EPSILON
    };
    record.edge[0].powi(3) * epsilon < least_normal(part.scalar)
}

/// The advice where no numbers are good.
fn instead(record: &SceneResult, part: &SceneKernelPart, kind: WrongKind) -> String {
    let unit = spaced(&record.unit);
    let is_narrow = part.scalar == ScalarName::F32;
    if is_coarse(record, part) {
        return format!(
            "coordinates reach {:.0e}{unit}, where the numbers of {} are {}{unit} apart: {}bring scene and rays nearer to 0",
            record.reach,
            part.scalar,
            human(&format!("{:.0e}", part.spacing)),
            if is_narrow { "use f64, or " } else { "" }
        );
    }
    if is_tiny(record, part) {
        return format!(
            "products of three lengths such as {}{unit} lose digits at the lower end of {}: use {}a smaller unit of length",
            ShortNumber(record.edge[0]),
            part.scalar,
            if is_narrow { "f64 or " } else { "" }
        );
    }
    if kind == WrongKind::SelfHit {
        return "start shadow rays off the surface (`hairline offset` finds how far)".to_owned();
    }
    (if is_narrow {
        "use f64 or another kernel"
    } else {
        "use another kernel"
    })
    .to_owned()
}

/// A note if cracks that no number closes are most of a kernel's cost, with advice.
fn cracks_of_its_own(record: &SceneResult, part: &SceneKernelPart) -> Option<String> {
    let best = &part.tried[0];
    let cracks = part
        .counts
        .iter()
        .zip(&best.wrong)
        .filter(|(count, _)| count.kind == WrongKind::Crack);
    let weight = record.cost(WrongKind::Crack);
    let cost: f64 = cracks
        .map(|(_, rate)| weight * rate.rate.unwrap_or(0.0))
        .sum();
    (!part.has_edge_epsilon && 0.5 * best.cost < cost).then(|| {
        format!(
            "{} of its cost of {} are cracks, which no number here closes: give its edge test an epsilon, or use a \
             kernel that hardly leaks (plucker, woop-watertight)",
            cost_text(cost),
            cost_text(best.cost)
        )
    })
}

/// The limit of errors for which the epsilons were chosen, in words; none if there is none.
pub(super) fn accuracy(record: &SceneResult) -> Option<String> {
    let wanted = || {
        let most = most_errors(record);
        format!("chosen so that 99 % of the hits that remain are off by at most {most}")
    };
    (!record.max_error.is_empty()).then(wanted)
}

/// The largest errors that were wanted, in words.
fn most_errors(record: &SceneResult) -> String {
    let words = record.max_error.iter().map(|NamedNumber { name, number }| {
        let most = human(&format!("{number:e}"));
        match name.as_str() {
            "t" => format!("{most} times t"),
            _ => format!("{most}{} in the point's place", spaced(&record.unit)),
        }
    });
    words.collect::<Vec<_>>().join(", ")
}
