//! The contact of a ray with a triangle in whose plane it lies, from the sides of the vertices.

use super::integer::ExactInteger;
use super::width::Width;
use crate::truth::{Contact, ContactKind, Feature};
use std::cmp::Ordering;

/// The contact on [0, inf) of a line in the plane of a triangle with area. The line meets the boundary
/// nowhere, at one vertex, or at two points of different t, so the signs of their t decide the contact. Tables
/// replace branches: the sides of the vertices are as random as the cases.
pub(super) fn coplanar_contact<W: Width>(
    direction: [i64; 3],
    vertices: [[i64; 3]; 3],
    normal: [W::Minor; 3],
) -> Contact {
    let across = normal.iter().position(|x| !x.is_zero());
    let k = across.expect("a triangle with area");
    let along = direction.iter().position(|x| *x != 0);
    let m = along.expect("a direction that is not zero");
    // The side of the line that a vertex is on: component k of direction × vertex, a vector along the normal.
    let (i, j) = ((k + 1) % 3, (k + 2) % 3);
    let sides = vertices.map(|v| W::product(direction[i], v[j]) - W::product(direction[j], v[i]));
    let [a, b, c] = sides.map(|side| digit(side.sign()));
    let met = &MET[9 * a + 3 * b + c];
    // Between the vertices v and w, on the sides x and y, the line is at (y·v - x·w) / (y - x). Over the direction
    // that is t.
    let t_sign = |Between(v, w)| {
        let (x, y) = (sides[v], sides[w]);
        let numerator = W::wide_product(vertices[v][m], y) - W::wide_product(vertices[w][m], x);
        let numerator_sign = numerator.sign() as i8;
        let denominator_sign = (y - x).sign() as i8;
        let direction_sign = direction[m].cmp(&0) as i8;
        (numerator_sign * denominator_sign * direction_sign).cmp(&0)
    };
    let [first, second] = met.points.map(t_sign);
    met.contacts[3 * digit(first) + digit(second)]
}

/// A sign as a digit of a table's index: 0, 1 or 2 below, at and above zero.
fn digit(sign: Ordering) -> usize {
    (sign as i8 + 1) as usize
}

/// A point of the boundary: it lies between two vertices that are not on one side of the line, at the first vertex if
/// that is on the line.
#[derive(Clone, Copy)]
struct Between(usize, usize);

/// Where a line in the plane meets the boundary of a triangle, and the contacts that follow from that.
#[derive(Clone, Copy)]
struct MetBoundary {
    /// The points that are met, up to two.
    points: [Between; 2],
    /// By the signs of the points' t: 3 times the digit of the first, and that of the second.
    contacts: [Contact; 9],
}

/// By the sides of the vertices: 9 times the digit of a, 3 times that of b, and that of c.
const MET: [MetBoundary; 27] = {
    const VERTICES: [Feature; 3] = [Feature::VertexA, Feature::VertexB, Feature::VertexC];
    const EDGES: [Feature; 3] = [Feature::EdgeAb, Feature::EdgeBc, Feature::EdgeCa];
    let none = Contact {
        kind: ContactKind::None,
        meets_ray: false,
        meets_line: false,
    };
    let mut all = [MetBoundary {
        points: [Between(0, 0); 2],
        contacts: [none; 9],
    }; 27];
    let mut sides = 0;
    while sides < 27 {
        let side = [sides / 9, sides / 3 % 3, sides % 3];
        let met = &mut all[sides];
        let mut count = 0;
        let mut features = [Feature::Outside; 2];
        let mut v = 0;
        while v < 3 {
            let next = (v + 1) % 3;
            let last = (v + 2) % 3;
            let is_on_line = side[v] == 1;
            // With area, no three vertices are on the line: that entry is never read.
            if is_on_line && count < 2 {
                let off_line = if side[next] == 1 { last } else { next };
                met.points[count] = Between(v, off_line);
                features[count] = VERTICES[v];
                count += 1;
            } else if !is_on_line && side[next] == 2 - side[v] {
                met.points[count] = Between(v, next);
                features[count] = EDGES[v];
                count += 1;
            }
            v += 1;
        }
        let mut t = 0;
        while t < 9 {
            let kind = match COMMON[count][t] {
                0 => ContactKind::None,
                3 => ContactKind::Segment,
                point => ContactKind::Point(features[point - 1]),
            };
            let meets_ray = !matches!(kind, ContactKind::None);
            met.contacts[t] = Contact {
                kind,
                meets_ray,
                meets_line: count > 0,
            };
            t += 1;
        }
        sides += 1;
    }
    all
};

/// The part of the triangle that the ray meets (0: nothing, 1: the first point of the boundary, 2: the second, 3: a
/// segment), by the number of points on the line and by the signs of their t, as in [`MetBoundary::contacts`].
const COMMON: [[usize; 9]; 3] = [
    [0; 9],
    [0, 0, 0, 1, 1, 1, 1, 1, 1],
    // Both behind; one behind and one at the origin; else something of the segment between them.
    [0, 2, 3, 1, 3, 3, 3, 3, 3],
];
