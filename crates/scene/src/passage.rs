//! Passages: where a ray crosses the surface, touches it or runs in it, and the windings on both sides.

use crate::bounds::Bounds;
use crate::found::{Common, End, Found};
use crate::moved::{Crossed, are_missed_aside, change};
use crate::query::Query;
use crate::ray::{InvalidRay, Ray};
use crate::scene::Scene;
use crate::winding::{OpenEdge, Winding};
use hairline_core::Float;
use std::cmp::Ordering;

/// A part of a line that lies in the union of all faces, as long as possible: one point, or a segment.
#[derive(Clone, Debug, PartialEq)]
pub struct Passage {
    /// Bounds of the first t, which may lie before the ray's interval.
    pub from: Bounds,
    /// Bounds of the last t, which may lie behind the interval.
    pub to: Bounds,
    /// True if the line runs in the surface from the first t to a later one.
    pub is_segment: bool,
    /// True if a line that is moved aside by less than any number meets none of the faces: a silhouette, or a wall that the line
    /// runs along.
    pub is_silhouette: bool,
    /// All faces of the passage, by number.
    pub faces: Vec<u32>,
    /// The winding after the passage less that before it; an edge if it is not defined because the surface is open here.
    pub change: Result<Winding, OpenEdge>,
    /// The windings before and after the passage; an edge if they are not defined because the surface is open somewhere.
    pub around: Result<[Winding; 2], OpenEdge>,
}

impl Passage {
    /// True if the line crosses the surface here, false if it touches it only; an edge if that is not defined.
    pub fn crosses(&self) -> Result<bool, OpenEdge> {
        self.change.map(|change| !change.is_zero())
    }
}

/// A point, seen from a surface.
#[derive(Clone, Debug, PartialEq)]
pub enum Location {
    /// On these faces, by number.
    On(Vec<u32>),
    /// Off the surface, with the winding around the point.
    Off(Winding),
    /// Off the surface, which is open: this is one of the edges where it is.
    NotDefined(OpenEdge),
}

impl Location {
    /// True if the surface winds around the point, or if the point is on it. None if that is not defined.
    pub fn is_inside_or_on(&self) -> Option<bool> {
        match self {
            Location::On(_) => Some(true),
            Location::Off(winding) => Some(!winding.is_zero()),
            Location::NotDefined(_) => None,
        }
    }
}

/// Faces that follow each other without a gap along a line.
struct Component {
    found: Vec<Found>,
    /// The place of the face with the last t.
    last: usize,
}

impl<F: Float> Scene<F> {
    /// The passages of a ray through the surface, in order: those of its line that have a point in its interval. An error
    /// if the ray means nothing.
    pub fn passages(&self, ray: &Ray<F>) -> Result<Vec<Passage>, InvalidRay> {
        let ray = ray.checked()?;
        let line = ray.on(f64::NEG_INFINITY, f64::INFINITY);
        let query = self.query(line);
        let mut passages = Vec::new();
        let mut before = self.nothing();
        for component in self.components(&line, &query) {
            let crossed = self.crossed(&component);
            let change = change(line.direction, &crossed);
            let after = sum(before, change);
            if self.is_in_interval(&query, &component, &ray) {
                let is_silhouette = are_missed_aside(line.direction, &crossed);
                passages.push(self.passage(&component, is_silhouette, change, [before, after]));
            }
            before = after;
        }
        Ok(passages)
    }

    /// Where a point is: on the surface, inside or outside. An error if a coordinate is not finite.
    ///
    /// The winding around the point is the sum of all changes on a ray from it, with the opposite sign; there is none at
    /// the ray's far end. The ray's direction has small integers and no zero, so that it seldom runs in a face.
    pub fn locate(&self, point: [F; 3]) -> Result<Location, InvalidRay> {
        const DIRECTION: [f64; 3] = [0.375, 0.625, 0.875];
        let ray = Ray::new(point, DIRECTION.map(F::from_f64)).checked()?;
        let query = self.query(ray);
        let order = self.order(&query);
        let mut sum_of_changes = self.nothing();
        for component in self.components(&ray, &query) {
            let starts_here = |found: &&Found| order.compare_float(found, End::From, 0.0).is_eq();
            let on: Vec<&Found> = component.found.iter().filter(starts_here).collect();
            if !on.is_empty() {
                let mut faces: Vec<u32> =
                    on.iter().map(|found| self.face_at(found.place)).collect();
                faces.sort();
                return Ok(Location::On(faces));
            }
            let change = change(ray.direction, &self.crossed(&component));
            sum_of_changes = sum(sum_of_changes, change);
        }
        Ok(match sum_of_changes {
            Ok(winding) => Location::Off(winding.negated()),
            Err(edge) => Location::NotDefined(edge),
        })
    }

    /// The winding far away from a surface, if it is closed.
    fn nothing(&self) -> Result<Winding, OpenEdge> {
        let closed = self.closed();
        match closed.oriented {
            Ok(()) => Ok(Winding::Number(0)),
            Err(_) => closed.even.map(|()| Winding::IsOdd(false)),
        }
    }

    /// The faces that a ray meets, cut where it leaves the surface.
    fn components(&self, ray: &Ray<f64>, query: &Query) -> Vec<Component> {
        let order = self.order(query);
        let mut all = self.all(ray, query);
        all.sort_by(|a, b| order.by_ends(a, b));
        let mut components: Vec<Component> = Vec::new();
        for found in all {
            let reaches = |component: &&mut Component| {
                let last = &component.found[component.last];
                order.compare(&found, End::From, last, End::To) != Ordering::Greater
            };
            let Some(component) = components.last_mut().filter(reaches) else {
                components.push(Component {
                    found: vec![found],
                    last: 0,
                });
                continue;
            };
            let last = &component.found[component.last];
            if order.compare(&found, End::To, last, End::To) == Ordering::Greater {
                component.last = component.found.len();
            }
            component.found.push(found);
        }
        components
    }

    /// The faces of a component that are not parallel to the line.
    fn crossed(&self, component: &Component) -> Vec<Crossed> {
        let mut crossed = Vec::new();
        for found in &component.found {
            if let Common::Crossing(facing, feature) = found.common {
                crossed.push(Crossed {
                    face: self.face_at(found.place),
                    triangle: self.triangle_at(found.place),
                    facing,
                    feature,
                });
            }
        }
        crossed
    }

    /// True if a component of the line has a point in the ray's interval.
    fn is_in_interval(&self, query: &Query, component: &Component, ray: &Ray<f64>) -> bool {
        let order = self.order(query);
        let last = &component.found[component.last];
        let starts = order.compare_float(&component.found[0], End::From, ray.t_max);
        let ends = order.compare_float(last, End::To, ray.t_min);
        starts != Ordering::Greater && ends != Ordering::Less
    }

    fn passage(
        &self,
        component: &Component,
        is_silhouette: bool,
        change: Result<Winding, OpenEdge>,
        [before, after]: [Result<Winding, OpenEdge>; 2],
    ) -> Passage {
        let places = component.found.iter().map(|found| found.place);
        let mut faces: Vec<u32> = places.map(|place| self.face_at(place)).collect();
        faces.sort();
        let around = match (before, after) {
            (Ok(before), Ok(after)) => Ok([before, after]),
            (Err(edge), _) | (_, Err(edge)) => Err(edge),
        };
        Passage {
            from: component.found[0].from,
            to: component.found[component.last].to,
            is_segment: component.found.iter().any(Found::is_segment),
            is_silhouette,
            faces,
            change,
            around,
        }
    }
}

fn sum(a: Result<Winding, OpenEdge>, b: Result<Winding, OpenEdge>) -> Result<Winding, OpenEdge> {
    Ok(a?.plus(b?))
}
