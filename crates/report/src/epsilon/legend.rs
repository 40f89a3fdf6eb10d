//! The words in the tables of a study of epsilons, explained a line each.

use super::numbers::least_normal;
use super::record::*;
use super::words::unit_of_cost;
use crate::arith::ScalarName;
use crate::case::ShortNumber;
use crate::page::Block;

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

/// True if an epsilon is below the normal numbers of its scalar.
fn is_subnormal(scalar: ScalarName, epsilon: &str) -> bool {
    epsilon
        .parse()
        .is_ok_and(|e: f64| e != 0.0 && e.abs() < least_normal(scalar))
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
