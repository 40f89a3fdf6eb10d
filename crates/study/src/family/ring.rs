//! The triangles around a pair or a fan that a generator made: a ring that continues its planes, as the rest of a surface
//! would. Rounding may carry a ray over the rim of the group, and there the ring has the hit.
//!
//! Seen from its centre (the vertex of a fan, the middle of a pair's edge) the rim of a group is star-shaped. So the rim
//! at many times its distance from the centre encloses it, and the quadrilateral beyond an edge of the rim lies in the plane of
//! the triangle on this side of it. No numbers are drawn: the ring follows from the corners of the group.

use super::Grouping;
use crate::arith::Float;
use crate::case::{Case, Ray, Triangle};

/// Adds the ring around the triangles of a pair or a fan, with a ray; false if there is none, as where its corners
/// overflow. Ring and group have the corners on the rim exactly in common, and run through its edges in opposite
/// directions.
pub(crate) fn add_ring<F: Float>(
    group: &[Case<F>],
    ray: &Ray<F::Vector>,
    cases: &mut Vec<Case<F>>,
) -> bool {
    let triangles: Vec<[[F; 3]; 3]> = group.iter().map(corners).collect();
    let Some(centre) = centre(&triangles) else {
        return false;
    };
    let rim = rim(&triangles);
    let is_finite = |[from, to]: &[[F; 3]; 2]| {
        [from, to]
            .into_iter()
            .all(|p| beyond(*p, centre).iter().all(|x| x.is_finite()))
    };
    if rim.is_empty() || !rim.iter().all(is_finite) {
        return false;
    }
    for [from, to] in rim {
        let [far_from, far_to] = [from, to].map(|point| beyond(point, centre));
        for corners in [[to, from, far_from], [to, far_from, far_to]] {
            let [a, b, c] = corners.map(F::Vector::from);
            cases.push(Case {
                ray: *ray,
                triangle: Triangle::new(a, b, c),
            });
        }
    }
    true
}

/// The ring around the cases of an index that belong together so; none if there should be one, and is not.
pub fn around<F: Float>(group: &[Case<F>], grouping: Grouping) -> Option<Vec<Case<F>>> {
    let is_whole = 1 < group.len();
    let mut ring = Vec::new();
    match grouping {
        Grouping::SharedEdge | Grouping::Fan if is_whole => {
            add_ring(group, &group[0].ray, &mut ring).then_some(ring)
        }
        _ => Some(ring),
    }
}

fn corners<F: Float>(case: &Case<F>) -> [[F; 3]; 3] {
    case.triangle.vertices().map(Into::into)
}

/// The middle of the corners that all triangles have in common, of which there are one or two.
fn centre<F: Float>(triangles: &[[[F; 3]; 3]]) -> Option<[F; 3]> {
    let (first, others) = triangles.split_first()?;
    let is_common = |corner: &&[F; 3]| others.iter().all(|corners| corners.contains(corner));
    let common: Vec<[F; 3]> = first.iter().filter(is_common).copied().collect();
    let half = F::from_f64(0.5);
    match common[..] {
        [vertex] => Some(vertex),
        [p, q] => Some(std::array::from_fn(|i| p[i] * half + q[i] * half)),
        _ => None,
    }
}

/// The edges through which one triangle runs, and none in the other direction.
fn rim<F: Float>(triangles: &[[[F; 3]; 3]]) -> Vec<[[F; 3]; 2]> {
    let edges = triangles
        .iter()
        .flat_map(|[a, b, c]| [[*a, *b], [*b, *c], [*c, *a]]);
    let is_open = |[from, to]: &[[F; 3]; 2]| !edges.clone().any(|edge| edge == [*to, *from]);
    edges.clone().filter(is_open).collect()
}

/// How much farther from the centre the ring ends than it begins, in distances of the rim. A triangle that a ray grazes is
/// narrow as the ray sees it, and so is the ring beyond it. At 1 a watertight kernel's hit went over
/// the ring of one group in a city.
const WIDTH: f64 = 15.0;

/// The point of the ring's outer edge beyond a point of its inner one.
fn beyond<F: Float>(point: [F; 3], centre: [F; 3]) -> [F; 3] {
    let width = F::from_f64(WIDTH);
    std::array::from_fn(|i| point[i] + (point[i] - centre[i]) * width)
}
