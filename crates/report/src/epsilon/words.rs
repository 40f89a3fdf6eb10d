//! The names that people use for the strata and kinds of a scene, its numbers and its units; and what they mean.

use super::record::*;
use crate::arith::{Float, ScalarName, smallest_normal};
use crate::case::ShortNumber;
use crate::kernel::{Dimension, Role};
use crate::page::{Block, Cell};
use hairline_record::Rate;
use hairline_record::group_digits;

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

/// The meaning of an epsilon for the scene's triangles.
pub(super) fn meaning(
    record: &SceneResult,
    part: &SceneKernelPart,
    knob: &KnobPart,
    epsilon: &str,
) -> Option<String> {
    let value: f64 = epsilon.parse().ok().filter(|value| *value != 0.0)?;
    let unit = spaced(&record.unit);
    if !record.has_scene() && knob.dimension.has_unit() {
        return None;
    }
    match (knob.role, knob.dimension) {
        (Role::T, Dimension::T) => {
            let least = format!("{}{}", human(epsilon), unit_of_t(record));
            let instead = if record.has_scene() {
                " (for shadow rays see `offset`)"
            } else {
                ""
            };
            Some(format!("nothing nearer than {least} is hit{instead}"))
        }
        (Role::Parallel, Dimension::DETERMINANT) if record.unit_directions && 0.0 < value => {
            if let Some(shape) = part.least_shape {
                return Some(match value / shape {
                    small if small < 1.0 => {
                        format!(
                            "the smallest triangle is missed at angles below {}",
                            degrees(small)
                        )
                    }
                    _ => "the smallest triangle is never hit".to_owned(),
                });
            }
            // Twice the area, times the sine, is the determinant. Equilateral triangles have the largest area, and
            // the flattest of a scene an eighth of their longest edge as height.
            let square = record.edge[0] * record.edge[0];
            let least = (value / 0.75f64.sqrt()).sqrt();
            let flattest = format!("(edge {}{unit}, height 1/8 of it)", record.edge[0]);
            Some(match 8.0 * value / square {
                _ if 0.75f64.sqrt() * square <= value => {
                    format!("no triangle below an edge of {least:.1e}{unit} is ever hit")
                }
                sine if sine < 1.0 => format!(
                    "the smallest triangles {flattest} are missed at angles below {}",
                    degrees(sine)
                ),
                _ => format!("the smallest triangles {flattest} are never hit"),
            })
        }
        (Role::Parallel, Dimension::DIRECTION)
            if record.unit_directions && 0.0 < value && value < 1.0 =>
        {
            Some(format!(
                "every triangle is missed at angles below {}",
                degrees(value)
            ))
        }
        (Role::Edge, Dimension::NONE) => {
            let size = human(&format!("{:e}", value.abs()));
            let most = human(&format!("{:.0e}", value.abs() * record.edge[1]));
            let largest = ShortNumber(record.edge[1]);
            Some(match (value < 0.0, record.has_scene()) {
                (true, true) => format!(
                    "rays up to {most}{unit} beside a triangle of {largest}{unit} hit it ({size} of any triangle's size; corners: \
                     twice); so both faces of an edge are hit"
                ),
                (true, false) => format!(
                    "rays up to {size} of a triangle's size beside it hit it (corners: twice); so both faces of an edge are hit"
                ),
                (false, true) => format!(
                    "rays up to {most}{unit} inside a triangle of {largest}{unit} miss it ({size} of any triangle's size)"
                ),
                (false, false) => {
                    format!("rays up to {size} of a triangle's size inside it miss it")
                }
            })
        }
        // An absolute number beside what the smallest triangles have.
        (Role::Edge, Dimension { length, .. }) if 0 < length => {
            let share = value.abs() / record.edge[0].powi(i32::from(length));
            let size = human(&format!("{share:.0e}"));
            let whose = format!(
                "the smallest triangles (edge {}{unit})",
                ShortNumber(record.edge[0])
            );
            Some(match (value < 0.0, 0.1 < share) {
                (true, false) => {
                    format!("rays up to about {size} of their size beside {whose} hit them")
                }
                (false, false) => {
                    format!("rays up to about {size} of their size inside {whose} miss them")
                }
                (true, true) => {
                    format!("{whose} are hit far beside them: by about {size} of their size")
                }
                (false, true) => format!("{whose} are never hit"),
            })
        }
        _ => None,
    }
}

fn degrees(sine: f64) -> String {
    let angle = libm::asin(sine.min(1.0)).to_degrees();
    if angle < 0.01 {
        format!("{angle:.0e}\u{b0}")
    } else {
        format!("{angle:.2}\u{b0}")
    }
}

/// A shortest decimal as people write it.
pub(super) fn human(epsilon: &str) -> String {
    match epsilon.parse::<f64>() {
        Ok(value) if (1e-4..1e7).contains(&value.abs()) => format!("{value}"),
        _ => epsilon.to_owned(),
    }
}

/// `3e-6`.
pub(super) fn short_error(error: Option<f64>) -> String {
    match error {
        None => "inf".to_owned(),
        Some(0.0) => "0".to_owned(),
        Some(error) => format!("{error:.0e}"),
    }
}

/// A cost, as weighted wrong answers in a hundred rays of each kind: `0.52`, `14.1`, `315`.
pub(super) fn cost_text(cost: f64) -> String {
    let per_hundred = 100.0 * cost;
    match per_hundred {
        0.0 => "0".to_owned(),
        ..9.995 => format!("{per_hundred:.2}"),
        ..99.95 => format!("{per_hundred:.1}"),
        _ => format!("{per_hundred:.0}"),
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

/// A rate in a table, as [`share`] writes it.
pub(super) fn share_cell(rate: &Rate) -> Cell {
    Cell::rate(rate, share(rate))
}

/// `0 of 40,000`, `1 in 1,200`, `2.9%`.
pub(super) fn share(rate: &Rate) -> String {
    match rate.rate {
        None => "-".to_owned(),
        Some(0.0) => format!("0 of {}", group_digits(rate.of)),
        Some(share) if share < 0.01 => {
            let one_in = 1.0 / share;
            let unit = 10f64.powi((one_in.log10().floor() as i32 - 1).max(0));
            format!(
                "1 in {}",
                group_digits(((one_in / unit).round() * unit) as u64)
            )
        }
        Some(share) => format!("{:.1}%", share * 100.0),
    }
}

/// `>= 1.2e-6`, or that no value keeps the limit.
pub(super) fn bound(value: Option<&str>, is_lower: bool, unit: &str) -> String {
    match value {
        Some(value) => format!(
            "{} {}{unit}",
            if is_lower { ">=" } else { "<=" },
            human(value)
        ),
        None => "no value".to_owned(),
    }
}

/// A limit from its safe end to its far one, or that it is unsure.
pub(super) fn interval(limit: &KnobLimitPart, unit: &str) -> String {
    let safe = bound(limit.value.as_deref(), limit.is_lower, "");
    let Some(value) = &limit.value else {
        return safe;
    };
    match (&limit.far, limit.is_unsure) {
        (Some(far), false) if far == value => format!("{safe}{unit}"),
        (Some(far), false) => format!("{safe} ({}){unit}", human(far)),
        (Some(far), true) => {
            let mut ends = [value, far];
            ends.sort_by(|a, b| {
                number(Some(a))
                    .partial_cmp(&number(Some(b)))
                    .expect("numbers")
            });
            format!("unsure: {} to {}{unit}", human(ends[0]), human(ends[1]))
        }
        (None, _) => format!("unsure: from {}{unit} on", human(value)),
    }
}

/// The number of a text.
pub(super) fn number(text: Option<&String>) -> Option<f64> {
    text?.parse().ok()
}

/// The unit of a knob.
pub(super) fn unit_of(record: &SceneResult, knob: &KnobPart) -> String {
    if knob.role == Role::T && record.unit_directions {
        spaced(&record.unit)
    } else {
        String::new()
    }
}

/// Which angles almost parallel rays have.
fn flatness(record: &SceneResult) -> String {
    match record.sine {
        None => "from 7 degrees down to below rounding".to_owned(),
        Some([low, high]) => {
            format!(
                "whose sines go from {} to {}",
                ShortNumber(low),
                ShortNumber(high)
            )
        }
    }
}

/// The shortest decimal of an epsilon.
pub fn shortest<F: Float>(epsilon: F) -> String {
    if epsilon.is_zero() {
        "0".to_owned()
    } else {
        format!("{epsilon:e}")
    }
}

/// True if an epsilon is below the normal numbers of its scalar.
fn is_subnormal(scalar: ScalarName, epsilon: &str) -> bool {
    epsilon
        .parse()
        .is_ok_and(|e: f64| e != 0.0 && e.abs() < least_normal(scalar))
}

/// The smallest normal number of the scalar of a name.
pub(super) fn least_normal(scalar: ScalarName) -> f64 {
    if scalar == ScalarName::F32 {
        smallest_normal::<f32>()
    } else {
        smallest_normal::<f64>()
    }
}

/// From where rays are aimed.
const RAYS: &str = "rays: aimed from their rounded origin; ray=generated in --scene aims them before it is rounded";

/// The meaning of the words in the tables, a line each.
pub(super) fn how_to_read(record: &SceneResult) -> Vec<Block> {
    let aim = if record.aims_inside {
        "; all aimed inside"
    } else {
        ""
    };
    let mut lines = vec![
        RAYS.to_owned(),
        format!("cost: {}", unit_of_cost(record)),
        format!(
            "almost parallel: angles {}, each halving equally often{aim}",
            flatness(record)
        ),
    ];
    let always = [
        "errors: half of the hits that remain are off by less, 99 % by less, and the worst seen",
        "another seed may name other numbers at nearly the same cost",
        "limits: at the first number at most that share is wrong, past the one in brackets more; unsure: these rays do not show the \
         limit within a factor of 30, more of them (-n) do; * set by the scene's own sizes, distances and angles as much as by \
         rounding",
        "at most: what this number alone makes wrong; what is recommended may be beyond it if cheaper",
        "exactly parallel: unit vectors that are so lie along axes or in level planes; other rays may be parallel to any plane, \
         and pass an epsilon below a proved one (`hairline prove`)",
        "scale-free: L is the triangle's longest edge, M the largest coordinate; counted by the kernel's own values before the \
         comparison, not run",
        "holes: at shared edges, where the scene's triangles cover a picture once, side by side",
        "both or several hit: costs nothing, the nearest hit is the same; wrong for counting crossings",
        "beside: within about one triangle's size; a more negative edge hits more of them",
    ];
    lines.extend(always.map(str::to_owned));
    for part in &record.kernels {
        for knob in &part.knobs {
            let line =
                |refuses| format!("{} of {} refuses where {refuses}", knob.name, part.kernel);
            // The same in both scalars.
            let line = knob
                .refuses
                .as_ref()
                .map(line)
                .filter(|line| !lines.contains(line));
            lines.extend(line);
        }
        let values = part.limits.iter().filter_map(|limit| limit.value.as_ref());
        let subnormal = values
            .filter(|value| is_subnormal(part.scalar, value))
            .map(|value| {
                format!(
                    "{value} is a subnormal number, which machines that flush to zero take for 0"
                )
            });
        lines.extend(subnormal);
    }
    vec![Block::Notes(lines)]
}
