//! The lines below a study of a scene: what the words of its tables mean.

use super::notes::tolerates;
use super::record::*;
use super::words::{FLUSHED, RAYS, flatness, is_subnormal};

/// The meaning of the numbers of a limit, where there is one.
fn of_limits(record: &SceneRecord) -> Vec<String> {
    let limits = || record.kernels.iter().flat_map(|part| &part.limits);
    let mut lines = Vec::new();
    if limits().any(|limit| limit.far.is_some() && !limit.is_unsure) {
        lines.push("limits: at the first number at most that share is wrong, past the one in brackets more");
    }
    if limits().any(|limit| limit.is_unsure) {
        lines.push(
            "unsure: these rays do not show the limit within a factor of 30; more of them (-n) do",
        );
    }
    lines.into_iter().map(str::to_owned).collect()
}

fn has_proved_parallel(part: &SceneKernelPart) -> bool {
    part.proved.iter().any(|proved| part.knobs[proved.knob].role == "parallel")
}

fn has_parallel_gate(part: &SceneKernelPart) -> bool {
    part.knobs.iter().any(|knob| knob.role == "parallel")
}

/// The meaning of the words in the tables, a line each.
pub(super) fn legend(record: &SceneRecord) -> Vec<String> {
    let costs = record.costs.iter().map(|cost| format!("{} {}", cost.name, cost.number));
    let costs = costs.collect::<Vec<_>>().join(", ");
    let aim = if record.aims_inside { "; all aimed inside" } else { "" };
    let mut lines = vec![
        RAYS.to_owned(),
        format!("cost: each share, of its own row, times its weight ({costs})"),
        format!("almost parallel: angles {}, each halving equally often{aim}", flatness(record)),
    ];
    let of_chance = [
        "errors: half of the hits that remain are off by less, 99 % by less, and the worst seen",
        "another seed may name other numbers at nearly the same cost",
    ];
    lines.extend(of_chance.map(str::to_owned));
    lines.extend(of_limits(record));
    if record.unit_directions && record.kernels.iter().any(has_parallel_gate) {
        let which = [
            "exactly parallel: unit vectors that are so lie along axes or in level planes; other rays may",
            match record.kernels.iter().any(has_proved_parallel) {
                true => {
                    "be parallel to any plane, and pass an epsilon below the proved one (`hairline prove`)"
                }
                false => "be parallel to any plane, and pass an epsilon that refuses all of these",
            },
        ];
        lines.extend(which.map(str::to_owned));
    }
    if record.kernels.iter().any(|part| part.relative.is_some()) {
        let forms = [
            "scale-free: L is the triangle's longest edge, M the largest coordinate; counted by the",
            "kernel's own values before the comparison, not run",
        ];
        lines.extend(forms.map(str::to_owned));
    }
    let has_picture =
        |part: &SceneKernelPart| part.tried.iter().any(|tried| tried.holes_per_million.is_some());
    if record.kernels.iter().any(has_picture) {
        let picture = "holes: at shared edges, where the scene's triangles cover a picture once, side by side";
        lines.push(picture.to_owned());
    }
    if record.kernels.iter().any(tolerates) {
        let both = "both or several hit: costs nothing, the nearest hit is the same; wrong for counting crossings";
        lines.push(both.to_owned());
    }
    for part in &record.kernels {
        for knob in &part.knobs {
            let line =
                |refuses| format!("{} of {} refuses where {refuses}", knob.name, part.kernel);
            // The same in both scalars.
            let line = knob.refuses.as_ref().map(line).filter(|line| !lines.contains(line));
            lines.extend(line);
        }
    }
    if record.kernels.iter().any(|part| !part.limits.is_empty()) {
        let most = "at most: what this number alone makes wrong; what is recommended may be beyond it if cheaper";
        lines.push(most.to_owned());
    }
    let subnormal = record.kernels.iter().flat_map(|part| {
        let values = part.limits.iter().filter_map(|limit| limit.value.as_ref());
        values.filter(|value| is_subnormal(&part.scalar, value))
    });
    lines.extend(subnormal.map(|value| format!("{value} is {FLUSHED}")));
    let is_set = |limit: &LimitPart| limit.set_by.is_some();
    if record.kernels.iter().any(|part| part.limits.iter().any(is_set)) {
        let star = "* set by the scene's own sizes, distances and angles as much as by rounding";
        lines.push(star.to_owned());
    }
    let of_edge =
        |part: &SceneKernelPart| part.limits.iter().any(|it| part.knobs[it.knob].role == "edge");
    let beside = match record.kernels.iter().any(of_edge) {
        true => "beside: within about one triangle's size; a more negative edge hits more of them",
        false => "beside: within about one triangle's size",
    };
    lines.push(beside.to_owned());
    lines
}
