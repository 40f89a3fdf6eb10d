//! If a scalar's numbers are fine enough for a scene.

use super::numbers::human;
use super::record::{SceneKernelPart, SceneResult};
use super::words::spaced;
use crate::arith::ScalarName;

/// The smallest triangle is so many of a scalar's steps long, or longer, where its numbers are fine enough: then
/// rounding moves a vertex by less than can be seen.
const FINE: f64 = 1000.0;

/// The numbers of a scalar where triangles are.
pub(crate) struct Grain<'a> {
    /// `f32` or `f64`.
    pub scalar: ScalarName,
    /// The distance of two neighbouring numbers at the largest coordinate.
    pub spacing: f64,
    /// The smallest triangle's longest edge.
    pub smallest: f64,
    /// The unit of length; may be empty.
    pub unit: &'a str,
}

impl Grain<'_> {
    /// True if the numbers are fine enough for the smallest triangle.
    pub fn is_fine(&self) -> bool {
        FINE <= (self.smallest / self.spacing).round()
    }

    /// A sentence that says so, or that they are not; `place` is `scene` or `mesh`.
    pub fn sentence(&self, place: &str) -> String {
        let Grain {
            scalar,
            spacing,
            smallest,
            unit,
        } = *self;
        let apart = format!("{}{}", human(&format!("{spacing:.1e}")), spaced(unit));
        let numbers = format!("its numbers are {apart} apart at the far end");
        if self.is_fine() {
            let smallest = "below a thousandth of the smallest triangle's longest edge";
            return format!("{scalar} is fit for this {place}: {numbers}, {smallest}.");
        }
        let parts = (smallest / spacing).round().max(1.0);
        let wider = if scalar == ScalarName::F32 {
            "use f64, or "
        } else {
            ""
        };
        format!(
            "{scalar} is coarse for this {place}: {numbers}, 1/{parts} of the smallest triangle's longest edge: \
             {wider}move the origin to the camera."
        )
    }
}

fn grain<'a>(record: &'a SceneResult, part: &'a SceneKernelPart) -> Grain<'a> {
    Grain {
        scalar: part.scalar,
        spacing: part.spacing,
        smallest: record.edge[0],
        unit: &record.unit,
    }
}

/// True if the scalar's numbers are fine enough for the scene's smallest triangles.
pub(super) fn is_fine(record: &SceneResult, part: &SceneKernelPart) -> bool {
    !record.has_scene() || grain(record, part).is_fine()
}

/// A sentence that says so, or that they are not.
pub(super) fn fitness(record: &SceneResult, part: &SceneKernelPart) -> String {
    grain(record, part).sentence("scene")
}
