//! The numbers of a hit, exactly or correctly rounded.

use crate::found::{Common, End, Found};
use crate::passage::Passage;
use crate::ray::{InvalidRay, Ray};
use crate::rounded::rounded;
use crate::scene::Scene;
use hairline_core::oracle::exact_values;
use hairline_core::{Facing, Float, truth};
use num_rational::BigRational;

/// The numbers of the points that a ray and a face share. `N` is [`BigRational`], or `f64` for the nearest doubles.
#[derive(Clone, Debug, PartialEq)]
pub struct Values<N> {
    /// The first and the last t; equal if there is only one point.
    pub t: [N; 2],
    /// The points there.
    pub points: [[N; 3]; 2],
    /// The side of the face that the ray comes from. None if the ray runs in the face's plane, or if the face has no area.
    pub facing: Option<Facing>,
    /// The weights of the second and the third vertex, where there is a side.
    pub uv: Option<[N; 2]>,
}

impl<F: Float> Scene<F> {
    /// The exact numbers of a face's hit. None if the ray does not meet the face; an error if the ray means nothing.
    pub fn fractions(
        &self,
        ray: &Ray<F>,
        face: u32,
    ) -> Result<Option<Values<BigRational>>, InvalidRay> {
        let ray = ray.checked()?;
        let query = self.query(ray);
        let Some(place) = self.place_of(face) else {
            return Ok(None);
        };
        let triangle = self.triangle_at(place);
        let Some(found) = query.meet(place, &triangle, f64::INFINITY) else {
            return Ok(None);
        };
        let (t, facing, uv) = match found.common {
            Common::Crossing(facing, _) => {
                let case = ray.against(&triangle);
                let exact = exact_values(&case, &truth(&case));
                let t = exact.t.expect("a crossing has a t");
                let uv = exact.u.zip(exact.v).map(|(u, v)| [u, v]);
                ([t.clone(), t], Some(facing), uv)
            }
            Common::Point(_) | Common::Segment => {
                let order = self.order(&query);
                let ends = [End::From, End::To].map(|end| order.parameter(&found, end).rational());
                (ends.map(|t| t.expect("a contact is finite")), None, None)
            }
        };
        let points = t.each_ref().map(|t| point_at(&ray, t));
        Ok(Some(Values {
            t,
            points,
            facing,
            uv,
        }))
    }

    /// The first and the last t of a face's hit as the nearest doubles; equal if there is only one point. None if the ray does not
    /// meet the face; an error if the ray means nothing.
    pub fn t(&self, ray: &Ray<F>, face: u32) -> Result<Option<[f64; 2]>, InvalidRay> {
        let ray = ray.checked()?;
        let query = self.query(ray);
        let Some(place) = self.place_of(face) else {
            return Ok(None);
        };
        let found = query.meet(place, &self.triangle_at(place), f64::INFINITY);
        let order = self.order(&query);
        let nearest = |found: &Found, end: End| match found.bounds(end) {
            bounds if bounds.is_exact() => bounds.lower,
            _ => order.parameter(found, end).nearest_double(),
        };
        Ok(found.map(|found| [End::From, End::To].map(|end| nearest(&found, end))))
    }

    /// The first and the last t of a passage as the nearest doubles. An error if the ray means nothing.
    pub fn ends(&self, ray: &Ray<F>, passage: &Passage) -> Result<[f64; 2], InvalidRay> {
        // A passage may begin before the interval, or end behind it.
        let line = ray.on(-F::infinity(), F::infinity());
        let mut ends = [f64::INFINITY, f64::NEG_INFINITY];
        for face in &passage.faces {
            if let Some([first, last]) = self.t(&line, *face)? {
                // Rounding keeps the order.
                ends = [ends[0].min(first), ends[1].max(last)];
            }
        }
        Ok(ends)
    }

    /// The numbers of a face's hit as the nearest doubles. None if the ray does not meet the face; an error if the ray
    /// means nothing.
    pub fn values(&self, ray: &Ray<F>, face: u32) -> Result<Option<Values<f64>>, InvalidRay> {
        let exact = self.fractions(ray, face)?;
        Ok(exact.map(|exact| Values {
            t: exact.t.each_ref().map(rounded),
            points: exact
                .points
                .each_ref()
                .map(|point| point.each_ref().map(rounded)),
            facing: exact.facing,
            uv: exact.uv.as_ref().map(|uv| uv.each_ref().map(rounded)),
        }))
    }
}

fn point_at(ray: &Ray<f64>, t: &BigRational) -> [BigRational; 3] {
    [0, 1, 2].map(|axis| {
        let [o, d] = [ray.origin[axis], ray.direction[axis]].map(BigRational::from_float);
        let (o, d) = o.zip(d).expect("a valid ray is finite");
        o + t * d
    })
}
