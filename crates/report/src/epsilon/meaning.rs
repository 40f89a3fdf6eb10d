//! The meaning of an epsilon for the triangles of a scene: which rays are missed or hit because of it.

use super::numbers::human;
use super::record::*;
use super::words::{spaced, unit_of_t};
use crate::case::ShortNumber;
use crate::kernel::{Dimension, Role};

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
                     twice); so both triangles of an edge are hit"
                ),
                (true, false) => format!(
                    "rays up to {size} of a triangle's size beside it hit it (corners: twice); so both triangles of an edge are hit"
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
