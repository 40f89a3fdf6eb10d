//! The triangles around a pair or a fan that a generator made: a ring that continues its planes, as the rest of a surface
//! would. Rounding may carry a ray over the rim of the group, and there the ring has the hit.
//!
//! Seen from its centre (the vertex of a fan, the middle of a pair's edge) the rim of a group is star-shaped. So the rim
//! at many times its distance from the centre encloses it, and the quadrilateral beyond an edge of the rim lies in the plane of
//! the triangle on this side of it. No numbers are drawn: the ring follows from the corners of the group.

use super::boundary::middle;
use super::{Corners, Grouping};
use crate::arith::Float;
use crate::case::{Case, Ray, Triangle};

/// Adds the ring around the triangles of a pair or a fan, with a ray; false if there is none, as where its corners
/// overflow. Ring and group have the corners on the rim exactly in common, and run through its edges in opposite
/// directions.
pub fn add_ring<F: Float>(
    group: &[Case<F>],
    ray: &Ray<F::Vector>,
    cases: &mut Vec<Case<F>>,
) -> bool {
    let triangles: Vec<Corners<F>> = group.iter().map(corners).collect();
    let Some(centre) = centre(&triangles) else {
        return false;
    };
    let edges = rim(&triangles);
    if edges.is_empty() {
        return false;
    }
    let mut ring = Vec::with_capacity(2 * edges.len());
    for Edge { from, to } in edges {
        let far_from = beyond(from, centre);
        let far_to = beyond(to, centre);
        if !is_finite(far_from) || !is_finite(far_to) {
            return false;
        }
        ring.push([to, from, far_from]);
        ring.push([to, far_from, far_to]);
    }
    for corners in ring {
        let [a, b, c] = corners.map(F::Vector::from);
        let triangle = Triangle::new(a, b, c);
        cases.push(Case {
            ray: *ray,
            triangle,
        });
    }
    true
}

/// The ring around the cases of an index that belong together so; none if there should be one, and is not.
pub fn around<F: Float>(group: &[Case<F>], grouping: Grouping) -> Option<Vec<Case<F>>> {
    let should_have_one = matches!(grouping, Grouping::SharedEdge | Grouping::Fan);
    let is_whole = 1 < group.len();
    let mut ring = Vec::new();
    if should_have_one && is_whole && !add_ring(group, &group[0].ray, &mut ring) {
        return None;
    }
    Some(ring)
}

/// The corners of a case's triangle.
pub(super) fn corners<F: Float>(case: &Case<F>) -> Corners<F> {
    case.triangle.vertices().map(Into::into)
}

/// The middle of the corners that all triangles have in common, of which there are one or two.
fn centre<F: Float>(triangles: &[Corners<F>]) -> Option<[F; 3]> {
    let (first, others) = triangles.split_first()?;
    let mut common = first.to_vec();
    for corners in others {
        common.retain(|corner| corners.contains(corner));
    }
    match common[..] {
        [vertex] => Some(vertex),
        [p, q] => Some(middle(p, q)),
        _ => None,
    }
}

/// An edge in the direction in which a triangle runs through it.
#[derive(Clone, Copy, PartialEq)]
struct Edge<F> {
    from: [F; 3],
    to: [F; 3],
}

impl<F: Float> Edge<F> {
    fn reversed(self) -> Edge<F> {
        Edge {
            from: self.to,
            to: self.from,
        }
    }
}

/// The edges through which one triangle runs, and none in the other direction.
fn rim<F: Float>(triangles: &[Corners<F>]) -> Vec<Edge<F>> {
    let mut edges = Vec::with_capacity(3 * triangles.len());
    for [a, b, c] in triangles {
        for (from, to) in [(a, b), (b, c), (c, a)] {
            edges.push(Edge {
                from: *from,
                to: *to,
            });
        }
    }
    let is_open = |edge: &&Edge<F>| !edges.contains(&edge.reversed());
    edges.iter().filter(is_open).copied().collect()
}

/// How much farther from the centre the ring ends than it begins, in distances of the rim. A triangle that a ray grazes is
/// narrow as the ray sees it, and so is the ring beyond it. At 1 a watertight kernel's hit went over
/// the ring of one group in a city.
const WIDTH: f64 = 15.0;

/// The point of the ring's outer edge beyond a point of its inner one.
fn beyond<F: Float>(point: [F; 3], centre: [F; 3]) -> [F; 3] {
    let width = F::from_f64(WIDTH);
    let mut beyond = point;
    for (axis, coordinate) in beyond.iter_mut().enumerate() {
        let from_centre = point[axis] - centre[axis];
        *coordinate = point[axis] + from_centre * width;
    }
    beyond
}

fn is_finite<F: Float>(point: [F; 3]) -> bool {
    point.iter().all(|x| x.is_finite())
}
