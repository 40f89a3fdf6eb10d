//! One ray against one face: first in floats, then exactly.

use crate::bounds::Bounds;
use crate::exact::{Exact, Meeting};
use crate::filter::{Sorted, are_moderate, plane_t, size, sort};
use crate::found::{Common, Found};
use crate::fraction::Parameter;
use crate::grid::Grid;
use crate::mesh::Triangle;
use crate::ray::Ray;
use hairline_core::{Contact, ContactKind, Feature, Place, Truth, truth};
use std::cmp::Ordering;

/// A ray that looks for faces.
pub struct Query {
    pub ray: Ray<f64>,
    /// True if the filter's bounds hold for all faces.
    is_moderate: bool,
    direction_size: f64,
    pub exact: Exact,
}

/// The numbers of a scene that a query needs.
#[derive(Clone, Copy)]
pub struct Numbers {
    pub grid: Grid,
    pub are_moderate: bool,
}

impl Query {
    /// A valid ray.
    pub fn new(ray: Ray<f64>, scene: Numbers) -> Query {
        let is_moderate =
            scene.are_moderate && are_moderate(&ray.origin) && are_moderate(&ray.direction);
        Query {
            ray,
            is_moderate,
            direction_size: size(&ray.direction),
            exact: Exact::new(ray, scene.grid),
        }
    }

    /// The common points of the ray and the face at a place. None also if they lie surely beyond a t.
    #[inline(always)]
    pub fn meet(&self, place: u32, triangle: &Triangle<f64>, beyond: f64) -> Option<Found> {
        self.meet_or(place, triangle, 0.0, beyond, || {
            self.meet_exactly(place, triangle, beyond)
        })
    }

    /// The same for a triangle that may be rounded, with the filter's E of it, and for one about which the filter is not
    /// sure.
    #[inline(always)]
    pub fn meet_or(
        &self,
        place: u32,
        triangle: &Triangle<f64>,
        more: f64,
        beyond: f64,
        unsure: impl FnOnce() -> Option<Found>,
    ) -> Option<Found> {
        let sorted = if self.is_moderate {
            sort(&self.ray, self.direction_size, triangle, more)
        } else {
            Sorted::Unsure
        };
        match sorted {
            Sorted::Misses => None,
            Sorted::Crosses => match self.cross(place, triangle, more, beyond) {
                Some(sure) => sure,
                None => unsure(),
            },
            Sorted::Unsure => unsure(),
        }
    }

    /// The same for a line that surely crosses the inside of the face; none if its t is not sure.
    #[inline(never)]
    fn cross(
        &self,
        place: u32,
        triangle: &Triangle<f64>,
        more: f64,
        beyond: f64,
    ) -> Option<Option<Found>> {
        let (t, facing) = plane_t(&self.ray, triangle, more)?;
        if self.is_outside(t) || beyond < t.lower {
            return Some(None);
        }
        let is_sure = self.is_inside(t);
        is_sure.then(|| Some(Found::crossing(place, facing, Feature::Interior, t)))
    }

    /// True if a t is surely outside the interval.
    #[inline(always)]
    fn is_outside(&self, t: Bounds) -> bool {
        t.upper < self.ray.t_min || self.ray.t_max < t.lower
    }

    /// True if a t is surely in the interval.
    #[inline(always)]
    fn is_inside(&self, t: Bounds) -> bool {
        self.ray.t_min <= t.lower && t.upper <= self.ray.t_max
    }

    #[cold]
    #[inline(never)]
    fn meet_exactly(&self, place: u32, triangle: &Triangle<f64>, beyond: f64) -> Option<Found> {
        let plane = if self.is_moderate {
            plane_t(&self.ray, triangle, 0.0)
        } else {
            None
        };
        if let Some((t, _)) = plane
            && (self.is_outside(t) || beyond < t.lower)
        {
            return None;
        }
        let found = match truth(&self.ray.against(triangle)) {
            Truth::Transversal(crossing) => {
                if crossing.feature == Feature::Outside {
                    return None;
                }
                let t = match crossing.place {
                    Place::Before | Place::Beyond => return None,
                    Place::AtMin => Bounds::at(self.ray.t_min),
                    Place::AtMax => Bounds::at(self.ray.t_max),
                    Place::Within => match plane {
                        Some((t, _)) => t,
                        None => self.exact.crossing(triangle).bounds(),
                    },
                };
                Found::crossing(place, crossing.facing, crossing.feature, t)
            }
            Truth::Coplanar(contact) | Truth::Degenerate(contact) => {
                self.touch(place, triangle, contact)?
            }
            Truth::Parallel | Truth::Invalid => return None,
        };
        (found.from.lower <= beyond).then_some(found)
    }

    /// A contact with its ends, which the interval cuts.
    fn touch(&self, place: u32, triangle: &Triangle<f64>, contact: Contact) -> Option<Found> {
        let common = match contact.kind {
            ContactKind::None => return None,
            ContactKind::Point(feature) => Common::Point(feature),
            ContactKind::Segment => Common::Segment,
        };
        let ends = self.exact.contact(triangle)?;
        Some(Found::between(place, common, self.cut(ends)))
    }

    /// The ends of a contact, which the interval cuts.
    pub fn cut(&self, [mut from, mut to]: [Parameter; 2]) -> [Parameter; 2] {
        if from.compare_float(self.ray.t_min) == Ordering::Less {
            from = Parameter::End(self.ray.t_min);
        }
        if to.compare_float(self.ray.t_max) == Ordering::Greater {
            to = Parameter::End(self.ray.t_max);
        }
        [from, to]
    }

    /// The common points of the line that lie on the interval.
    pub fn on_interval(&self, meeting: Meeting) -> Option<(Common, [Parameter; 2])> {
        let (crossing, ends) = match meeting {
            Meeting::Crossing(facing, feature, t) => (Some((facing, feature)), [t.clone(), t]),
            Meeting::Contact(ends) => (None, ends),
        };
        let is_beside = ends[1].compare_float(self.ray.t_min) == Ordering::Less
            || ends[0].compare_float(self.ray.t_max) == Ordering::Greater;
        if is_beside {
            return None;
        }
        let ends = self.cut(ends);
        let common = match crossing {
            Some((facing, feature)) => Common::Crossing(facing, feature),
            None if ends[0].compare(&ends[1]) == Ordering::Less => Common::Segment,
            // A point of the triangle; nothing depends on where it is.
            None => Common::Point(Feature::Interior),
        };
        Some((common, ends))
    }
}
