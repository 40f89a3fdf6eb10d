//! The definition: in rationals, over all faces, without a tree.

use crate::mesh::{Triangle, widened};
use crate::ray::{InvalidRay, Ray};
use hairline_core::Float;
use hairline_core::oracle::define as define_case;
use num_rational::BigRational as Rational;

/// Points of a ray that it shares with the same faces: one point, or a segment inside faces.
#[derive(Clone, Debug, PartialEq)]
pub struct DefinedHit {
    /// The first t.
    pub from: Rational,
    /// The last t, at most t_max; that of a point is `from`.
    pub to: Rational,
    /// The faces, in the order of the mesh.
    pub faces: Vec<u32>,
}

/// All hits of a ray on its interval, by definition, ordered by `from` and then by `to`. An error if the ray means
/// nothing.
///
/// A triangle is a closed set: its edges and vertices belong to it, and a triangle without area is a segment or a point.
/// So the common points of a face and the ray on its closed interval are none, one point or one segment, as
/// [`hairline_core::oracle::define`] gives them. Equal ones are one hit with several faces. A face with a NaN or an
/// infinity has none.
pub fn define<F: Float>(
    triangles: &[Triangle<F>],
    ray: &Ray<F>,
) -> Result<Vec<DefinedHit>, InvalidRay> {
    let ray = ray.checked()?;
    let mut ranges = Vec::new();
    for (face, triangle) in triangles.iter().enumerate() {
        let defined = define_case(&ray.against(&widened(triangle)));
        if defined.truth.hits_closed() != Some(true) {
            continue;
        }
        let exact = defined.exact;
        let range = match exact.t {
            Some(t) => Some([t.clone(), t]),
            None => exact.contact_t,
        };
        ranges.extend(range.map(|[from, to]| (from, to, face as u32)));
    }
    ranges.sort();
    let mut hits: Vec<DefinedHit> = Vec::new();
    for (from, to, face) in ranges {
        match hits.last_mut() {
            Some(hit) if hit.from == from && hit.to == to => hit.faces.push(face),
            _ => hits.push(DefinedHit {
                from,
                to,
                faces: vec![face],
            }),
        }
    }
    Ok(hits)
}

/// The least t of some hits, and all faces that the ray meets there, in the order of the mesh.
pub fn nearest_of(hits: &[DefinedHit]) -> Option<(Rational, Vec<u32>)> {
    let least = hits.first()?.from.clone();
    let first = hits.iter().take_while(|hit| hit.from == least);
    let mut faces: Vec<u32> = first.flat_map(|hit| hit.faces.clone()).collect();
    faces.sort();
    Some((least, faces))
}
