//! The definition: in rationals, over all faces, without a tree.

use crate::instance::{Instance, PlacedFace};
use crate::mesh::{Triangle, widened};
use crate::ray::{InvalidRay, Ray};
use hairline_core::Float;
use hairline_core::case::Matrix;
use hairline_core::oracle::{Definition, define as define_case, define_points};
use num_rational::BigRational as Rational;

/// Points of a ray that it shares with the same faces: one point, or a segment inside faces.
#[derive(Clone, Debug, PartialEq)]
pub struct DefinedHit<N = u32> {
    /// The first t.
    pub from: Rational,
    /// The last t, at most t_max; that of a point is `from`.
    pub to: Rational,
    /// The faces, in the order of the mesh, or of instances and their meshes.
    pub faces: Vec<N>,
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
        ranges.extend(range(defined).map(|[from, to]| (from, to, face as u32)));
    }
    Ok(hits_of(ranges))
}

/// All hits of a ray and instances of some meshes, by definition: those of the exactly transformed triangles. An instance of a mesh
/// that does not exist, or with a NaN or an infinity, has no faces. An error if the ray means nothing.
pub fn define_instances<F: Float>(
    meshes: &[Vec<Triangle<F>>],
    instances: &[Instance<F>],
    ray: &Ray<F>,
) -> Result<Vec<DefinedHit<PlacedFace>>, InvalidRay> {
    let ray = ray.checked()?;
    let mut ranges = Vec::new();
    for (instance, Instance { mesh, matrix }) in (0..).zip(instances) {
        let mesh = meshes.get(*mesh as usize);
        for (face, triangle) in (0..).zip(mesh.into_iter().flatten()) {
            let number = PlacedFace { instance, face };
            let defined = define_placed(matrix, triangle, &ray).and_then(range);
            ranges.extend(defined.map(|[from, to]| (from, to, number)));
        }
    }
    Ok(hits_of(ranges))
}

/// None of a NaN or an infinity.
fn define_placed<F: Float>(
    matrix: &Matrix<F>,
    triangle: &Triangle<F>,
    ray: &Ray<f64>,
) -> Option<Definition> {
    let number = |x: F| Rational::from_float(x.to_f64());
    let moved = |vertex: [F; 3]| {
        let coordinate = |row: [F; 4]| {
            let mut sum = number(row[3])?;
            for axis in 0..3 {
                sum += number(row[axis])? * number(vertex[axis])?;
            }
            Some(sum)
        };
        let [x, y, z] = matrix.map(coordinate);
        Some([x?, y?, z?])
    };
    let [a, b, c] = triangle.map(moved);
    let [o, d] = [ray.origin, ray.direction]
        .map(|of_ray| of_ray.map(|x| Rational::from_float(x).expect("a valid ray is finite")));
    Some(define_points([o, d, a?, b?, c?], [ray.t_min, ray.t_max]))
}

/// The first and the last t of common points.
fn range(defined: Definition) -> Option<[Rational; 2]> {
    if defined.truth.hits_closed() != Some(true) {
        return None;
    }
    match defined.exact.t {
        Some(t) => Some([t.clone(), t]),
        None => defined.exact.contact_t,
    }
}

/// Equal ranges are one hit.
fn hits_of<N: Ord>(mut ranges: Vec<(Rational, Rational, N)>) -> Vec<DefinedHit<N>> {
    ranges.sort();
    let mut hits: Vec<DefinedHit<N>> = Vec::new();
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
    hits
}

/// The least t of some hits, and all faces that the ray meets there, in the order of the mesh.
pub fn nearest_of<N: Copy + Ord>(hits: &[DefinedHit<N>]) -> Option<(Rational, Vec<N>)> {
    let least = hits.first()?.from.clone();
    let first = hits.iter().take_while(|hit| hit.from == least);
    let mut faces: Vec<N> = first.flat_map(|hit| hit.faces.clone()).collect();
    faces.sort();
    Some((least, faces))
}
