//! A case in exact numbers as a drawing shows it, and the same in floats counted from a point.

use super::frame::{Flat, MapFrame, Stretch, View};
use crate::arith::{Exact, ExactVector, Float, Real, Vector};
use crate::case::{Case, Ray, Triangle};
use crate::kernel::{Gives, Verdict};
use crate::oracle::Definition;

/// A case in exact numbers, with all that is drawn of it.
pub(super) struct MapScene {
    frame: MapFrame,
    ray: Ray<ExactVector>,
    pub triangle: Triangle<ExactVector>,
    /// Where the line meets the plane.
    pub exact: Option<ExactVector>,
    /// Where the kernel's values say so.
    pub computed: Option<ExactVector>,
    /// The first and last t that a line has in common with a triangle that holds part of it.
    pub contact: Option<[Exact; 2]>,
}

/// A scene in floats, in units, counted from a point.
pub(super) struct FloatLayer {
    /// True if the triangle has an area, which then lies to the left of its edges.
    pub has_area: bool,
    pub vertices: [[f64; 2]; 3],
    pub edges: [Option<Stretch>; 3],
    pub line: Option<Stretch>,
    pub interval: Option<Stretch>,
    pub contact: Option<Stretch>,
    pub origin: [f64; 2],
    pub exact: Option<[f64; 2]>,
    pub computed: Option<[f64; 2]>,
}

/// Nearer to the boundary than this, in longest edges, an inset is drawn.
const NEAR: f64 = 0.04;

impl MapScene {
    pub fn new<F: Float>(
        case: &Case<F>,
        gives: Gives,
        verdict: &Verdict<F>,
        definition: &Definition,
    ) -> MapScene {
        let (ray, triangle) = case.exact();
        let frame = MapFrame::of(&ray, &triangle);
        let on_line = |t: &Exact| ray.origin.plus(&ray.direction.times(t));
        let exact = definition
            .exact
            .t
            .as_ref()
            .map(|t| on_line(&Exact::from_rational(t)));
        let contact = definition.exact.contact_t.as_ref();
        let contact = contact.map(|ends| ends.each_ref().map(Exact::from_rational));
        let finite = |x: F| x.is_finite().then(|| Exact::from_f64(x.to_f64()));
        let Triangle { a, b, c } = &triangle;
        let weighed =
            |(u, v): (Exact, Exact)| a.plus(&b.minus(a).times(&u)).plus(&c.minus(a).times(&v));
        let computed = match verdict.hit {
            true if gives.t => finite(verdict.t).map(|t| on_line(&t)),
            true if gives.uv => finite(verdict.u).zip(finite(verdict.v)).map(weighed),
            _ => None,
        };
        MapScene {
            frame,
            ray,
            triangle,
            exact,
            computed,
            contact,
        }
    }

    /// The point that an inset looks at: where the line meets the plane or first touches the triangle,
    /// else its point nearest to a vertex, as it is seen.
    pub fn focus(&self) -> ExactVector {
        let Ray {
            origin, direction, ..
        } = &self.ray;
        if let Some(exact) = &self.exact {
            return exact.clone();
        }
        if let Some([first, _]) = &self.contact {
            return origin.plus(&direction.times(first));
        }
        let way = self.frame.flat(direction);
        let length = self.frame.dot(&way, &way);
        if length.is_zero() {
            return origin.clone();
        }
        let Triangle { a, b, c } = &self.triangle;
        let nearest = [a, b, c].map(|vertex| {
            let to_vertex = self.frame.flat(&vertex.minus(origin));
            let t = self.frame.dot(&to_vertex, &way) / &length;
            let gap = to_vertex.plus(&way.times(&-t.clone()));
            (self.frame.dot(&gap, &gap), t)
        });
        let [first, others @ ..] = nearest;
        let nearer = |best: (Exact, Exact), other: (Exact, Exact)| {
            if other.0.is_less(&best.0) {
                other
            } else {
                best
            }
        };
        let (_, t) = others.into_iter().fold(first, nearer);
        origin.plus(&direction.times(&t))
    }

    /// The scene counted from a point.
    pub fn from(&self, point: &ExactVector) -> FloatLayer {
        let frame = &self.frame;
        let flat = |p: &ExactVector| frame.flat(&p.minus(point));
        let place = |p: &ExactVector| frame.coordinates(&flat(p));
        let Triangle { a, b, c } = &self.triangle;
        let edge = |from: &ExactVector, to: &ExactVector| {
            let way = frame.flat(&to.minus(from));
            frame.stretch(&flat(from), &way, [Some(Exact::zero()), Some(Exact::one())])
        };
        let Ray {
            origin,
            direction,
            t_min,
            t_max,
        } = &self.ray;
        let (base, way): (Flat, Flat) = (flat(origin), frame.flat(direction));
        let along = |ends| frame.stretch(&base, &way, ends);
        // NaN ends are no interval, nor are ends that are the wrong infinity.
        let is_interval = t_min.is_at_most(t_max)
            && t_min.is_less(&Exact::infinity())
            && (-Exact::infinity()).is_less(t_max);
        let end = |t: &Exact| t.is_finite().then(|| t.clone());
        FloatLayer {
            has_area: frame.view == View::Normal,
            vertices: [a, b, c].map(place),
            edges: [edge(a, b), edge(b, c), edge(c, a)],
            line: along([None, None]),
            interval: is_interval
                .then(|| along([end(t_min), end(t_max)]))
                .flatten(),
            contact: self.contact.clone().and_then(|ends| along(ends.map(Some))),
            origin: place(origin),
            exact: self.exact.as_ref().map(place),
            computed: self.computed.as_ref().map(place),
        }
    }

    /// From where it is looked at, in words.
    pub fn seen(&self) -> &'static str {
        match self.frame.view {
            View::Normal => "Seen along the triangle's normal, from its front.",
            View::Ray => "The triangle has no area; seen along the ray.",
            View::Across => "The triangle has no area, and the ray runs along it; seen from aside.",
        }
    }

    /// How far the computed point is from the exact one, in units of the frame.
    pub fn apart(&self) -> Option<f64> {
        Some(
            self.frame
                .length(&self.computed.as_ref()?.minus(self.exact.as_ref()?)),
        )
    }
}

impl FloatLayer {
    /// Half of what an inset shows, so that what is nearest to its middle is well seen; none where an
    /// overview shows it.
    pub fn inset_half(&self) -> Option<f64> {
        let is_near = |distance: &f64| (f64::MIN_POSITIVE..NEAR).contains(distance);
        let edges = self
            .edges
            .iter()
            .flatten()
            .map(Stretch::distance)
            .filter(is_near);
        let boundary = edges.reduce(f64::min);
        let computed = self.computed.map(|[x, y]| x.hypot(y)).filter(is_near);
        boundary.or(computed).map(|distance| distance * 2.5)
    }
}
