//! If a scalar's numbers are fine enough for a scene.

use super::record::{SceneKernelPart, SceneRecord};
use super::words::{human, spaced};

/// The smallest triangle is so many of a scalar's steps long, or longer, where its numbers are fine enough: then
/// rounding moves a vertex by less than can be seen.
const FINE: f64 = 1000.0;

/// The length of the smallest triangle's longest edge in steps of the scalar's numbers at the far end.
fn steps(record: &SceneRecord, part: &SceneKernelPart) -> f64 {
    record.edge[0] / part.spacing
}

/// True if the scalar's numbers are fine enough for the scene's smallest triangles.
pub(super) fn is_fine(record: &SceneRecord, part: &SceneKernelPart) -> bool {
    !record.has_scene() || FINE <= steps(record, part).round()
}

/// A sentence that says so, or that they are not.
pub(super) fn fitness(record: &SceneRecord, part: &SceneKernelPart) -> String {
    let SceneKernelPart { scalar, spacing, .. } = part;
    let apart = format!("{}{}", human(&format!("{spacing:.1e}")), spaced(&record.unit));
    let numbers = format!("its numbers are {apart} apart at the far end");
    if is_fine(record, part) {
        let smallest = "below a thousandth of the smallest triangle's longest edge";
        return format!("{scalar} is fit for this scene: {numbers}, {smallest}.");
    }
    let parts = steps(record, part).round().max(1.0);
    let wider = if scalar == "f32" { "use f64, or " } else { "" };
    format!(
        "{scalar} is coarse for this scene: {numbers}, 1/{parts} of the smallest triangle's longest edge: {wider}move \
         the origin to the camera."
    )
}
