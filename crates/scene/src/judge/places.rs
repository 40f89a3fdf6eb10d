//! Points inside or outside, as a program answered them.

use super::{Judged, Judgement};
use crate::passage::Location;
use crate::ray::InvalidRay;
use crate::scene::Scene;
use hairline_core::Float;

named! {
    pub names
    /// The place of a point, as a program named it.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum NamedPlace {
        /// Inside.
        Inside = "inside",
        /// Outside.
        Outside = "outside",
        /// On the surface.
        On = "on",
    }
}

impl<F: Float> Scene<F> {
    /// Judges the place of a point. On the surface every answer is right, and off an open one none is defined. An error if a
    /// coordinate is not finite.
    pub fn judge_place(&self, point: [F; 3], named: NamedPlace) -> Result<Judged, InvalidRay> {
        let judgement = match self.locate(point)? {
            Location::On(_) if named == NamedPlace::On => Judgement::Right,
            Location::On(_) => Judgement::Tie,
            Location::NotDefined(_) => Judgement::NotDefined,
            Location::Off(winding) => {
                let is_right = match named {
                    NamedPlace::Inside => !winding.is_zero(),
                    NamedPlace::Outside => winding.is_zero(),
                    NamedPlace::On => false,
                };
                match is_right {
                    true => Judgement::Right,
                    false => Judgement::WrongSide,
                }
            }
        };
        let off = match judgement {
            Judgement::WrongSide => self.distance_in_edges(point),
            _ => None,
        };
        Ok(Judged::new(
            judgement,
            None,
            off.filter(|it| it.is_finite()),
        ))
    }
}
