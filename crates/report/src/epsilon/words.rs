//! The names that people use for the strata and kinds of a scene, its units, and the flags of its epsilons.

use super::record::*;
use crate::kernel::Role;

/// The words for a kind of wrong answers: in a table, in a sentence, of what they are a share, and what these do.
pub(super) fn of_kind(kind: WrongKind) -> [&'static str; 4] {
    match kind {
        WrongKind::Miss => ["hits lost", "lost hits", "hits", "are lost"],
        WrongKind::Hit => ["false hits", "false hits", "misses", "are false hits"],
        WrongKind::Crack => ["cracks", "leaks", "crossings", "leak"],
        WrongKind::SelfHit => ["self-hits", "self-hits", "rays", "hit their own start"],
    }
}

/// The words for a count of a stratum: its place in a table and in a sentence, of what it is a share, and what these do.
pub(super) fn of_stratum(stratum: Stratum, kind: WrongKind) -> [&'static str; 4] {
    match (stratum, kind) {
        (Stratum::Interior, WrongKind::Miss) => [
            "at a triangle",
            "inside triangles",
            "hits inside a triangle",
            "are lost",
        ],
        (Stratum::Interior, _) => ["at its back", "at the back", "rays at its back", "hit"],
        (Stratum::Edges, _) => [
            "at a shared edge",
            "at shared edges",
            "rays at a shared edge",
            "leak",
        ],
        (Stratum::Vertices, _) => [
            "at a shared vertex",
            "at shared vertices",
            "rays at a shared vertex",
            "leak",
        ],
        (Stratum::Grazing, WrongKind::Miss) => [
            "almost parallel",
            "of almost parallel rays",
            "almost parallel hits",
            "are lost",
        ],
        (Stratum::Grazing, _) => [
            "almost parallel",
            "of almost parallel rays",
            "almost parallel rays",
            "hit falsely",
        ],
        (Stratum::Parallel, _) => [
            "exactly parallel",
            "of parallel rays",
            "parallel rays",
            "hit falsely",
        ],
        (Stratum::Shadow, _) => [
            "shadow rays",
            "of shadow rays",
            "shadow rays",
            "hit their own start",
        ],
        (Stratum::Outside, _) => [
            "beside a triangle",
            "beside triangles",
            "rays beside a triangle",
            "hit it",
        ],
        (Stratum::Segment, _) => [
            "segments",
            "of segments",
            "segments",
            "hit the surface at their end",
        ],
    }
}

/// The name of a count.
pub(super) fn label(count: &RayCount) -> String {
    let place = match count.rays {
        Rays::Stratum(stratum) => of_stratum(stratum, count.kind)[0],
        rays => rays.name(),
    };
    format!("{place}: {}", of_kind(count.kind)[0])
}

/// Where rays go of which hits can be lost.
pub(super) fn where_of(rays: Rays) -> &'static str {
    match rays {
        Rays::Stratum(Stratum::Grazing) => "almost parallel",
        Rays::Stratum(_) => "at a triangle",
        rays => rays.name(),
    }
}

/// The property of the scene, not of the kernel, that sets a limit.
pub(super) fn set_by(role: Role, count: RayCount) -> Option<&'static str> {
    let Rays::Stratum(stratum) = count.rays else {
        return None;
    };
    match (role, stratum, count.kind) {
        (Role::T, Stratum::Interior, WrongKind::Miss) => Some("the scene's distances"),
        (Role::Parallel, Stratum::Interior, WrongKind::Miss) => {
            Some("the scene's smallest triangles")
        }
        (Role::Parallel, Stratum::Grazing, _) => Some("how flat the almost parallel rays are"),
        _ => None,
    }
}

/// ` m`; nothing without a unit.
pub(super) fn spaced(unit: &str) -> String {
    if unit.is_empty() {
        String::new()
    } else {
        format!(" {unit}")
    }
}

/// The unit of t.
pub(super) fn unit_of_t(record: &SceneResult) -> String {
    match record.unit_directions {
        true => spaced(&record.unit),
        false => " of the way to the target".to_owned(),
    }
}

/// The `--epsilon` flag of some epsilons; none if no gate takes one.
pub(super) fn flag(part: &SceneKernelPart, epsilons: &[String]) -> Option<String> {
    let gates = part
        .knobs
        .iter()
        .zip(epsilons)
        .filter(|(knob, _)| knob.is_gate);
    let words: Vec<String> = gates
        .map(|(knob, e)| format!("{}={e}", knob.name))
        .collect();
    (!words.is_empty()).then(|| format!("--epsilon {}", words.join(",")))
}

/// The least t among some epsilons, if the kernel has no gate for it.
pub(super) fn least_t<'a>(part: &SceneKernelPart, epsilons: &'a [String]) -> Option<&'a String> {
    let knobs = part.knobs.iter().zip(epsilons);
    knobs
        .filter(|(knob, _)| !knob.is_gate)
        .map(|(_, epsilon)| epsilon)
        .next()
}

/// ` (m)`; nothing without a unit.
pub(super) fn of_unit(unit: &str) -> String {
    if unit.is_empty() {
        String::new()
    } else {
        format!(" ({unit})")
    }
}

/// The unit of costs, in words.
pub(super) fn unit_of_cost(record: &SceneResult) -> String {
    let weights: Vec<String> = WrongKind::ALL
        .into_iter()
        .map(|kind| (kind, record.cost(kind)))
        .filter(|(_, weight)| *weight != 1.0)
        .map(|(kind, weight)| format!("a {kind} counts {weight} times"))
        .collect();
    let weights = match weights.is_empty() {
        true => String::new(),
        false => format!("; {}", weights.join(", ")),
    };
    format!("wrong answers in 100 rays of each kind, added up{weights} (--cost)")
}

/// The unit of a knob.
pub(super) fn unit_of(record: &SceneResult, knob: &KnobPart) -> String {
    if knob.role == Role::T && record.unit_directions {
        spaced(&record.unit)
    } else {
        String::new()
    }
}
