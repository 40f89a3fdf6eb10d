//! The contact of a ray with a triangle in whose plane it lies, from the sides of the vertices.

use super::integer::ExactInteger;
use super::width::Width;
use crate::truth::{Contact, ContactKind, Feature};
use std::cmp::Ordering;

/// The contact on [0, inf) of a line in the plane of a triangle with area. The line meets the boundary
/// nowhere, at one vertex, or at two points of different t, so the signs of their t tell all. Tables for
/// branches: the sides of the vertices are as random as the cases.
pub(super) fn coplanar_contact<W: Width>(
    d: [i64; 3],
    vertices: [[i64; 3]; 3],
    n: [W::Minor; 3],
) -> Contact {
    let k = (0..3)
        .find(|&k| !n[k].is_zero())
        .expect("a triangle with area");
    let m = (0..3)
        .find(|&m| d[m] != 0)
        .expect("a direction that is not zero");
    // The side of the line that each vertex is on: component k of d × vertex.
    let (i, j) = ((k + 1) % 3, (k + 2) % 3);
    let side = vertices.map(|v| W::product(d[i], v[j]) - W::product(d[j], v[i]));
    let digit = |sign: Ordering| (sign as i8 + 1) as usize;
    let [first, second, third] = side.map(|side| digit(side.sign()));
    let met = &MET[9 * first + 3 * second + third];
    // t of the point between v and w, from the sides x and y: (y·v - x·w) / (y - x), over d.
    let t_sign = |(v, w): (usize, usize)| {
        let (x, y) = (side[v], side[w]);
        let numerator = W::wide_product(vertices[v][m], y) - W::wide_product(vertices[w][m], x);
        let sign = [numerator.sign(), (y - x).sign(), d[m].cmp(&0)];
        sign.iter().map(|sign| *sign as i8).product::<i8>().cmp(&0)
    };
    let [first, second] = met.between.map(t_sign);
    met.contacts[3 * digit(first) + digit(second)]
}

/// Where a line in the plane meets the boundary of a triangle, and what that makes of the contact.
#[derive(Clone, Copy)]
struct MetBoundary {
    /// The points, up to two: each lies between two vertices that are not on one side, at the first if
    /// that is on the line.
    between: [(usize, usize); 2],
    /// By 3 and 1 times 0, 1 or 2 for a point's t below, at and above zero.
    contacts: [Contact; 9],
}

/// By the sides of the vertices: 9, 3 and 1 times 0, 1 or 2 for the negative side, the line and the
/// positive side.
const MET: [MetBoundary; 27] = {
    const VERTICES: [Feature; 3] = [Feature::VertexA, Feature::VertexB, Feature::VertexC];
    const EDGES: [Feature; 3] = [Feature::EdgeAb, Feature::EdgeBc, Feature::EdgeCa];
    let none = Contact {
        kind: ContactKind::None,
        meets_ray: false,
        meets_line: false,
    };
    let mut all = [MetBoundary {
        between: [(0, 0); 2],
        contacts: [none; 9],
    }; 27];
    let mut sides = 0;
    while sides < 27 {
        let side = [sides / 9, sides / 3 % 3, sides % 3];
        let met = &mut all[sides];
        let (mut count, mut features) = (0, [Feature::Outside; 2]);
        let mut v = 0;
        while v < 3 {
            let (w, u) = ((v + 1) % 3, (v + 2) % 3);
            // With area, no three vertices are on the line: that entry is never read.
            if side[v] == 1 && count < 2 {
                met.between[count] = (v, if side[w] == 1 { u } else { w });
                features[count] = VERTICES[v];
                count += 1;
            } else if side[v] != 1 && side[w] == 2 - side[v] {
                met.between[count] = (v, w);
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

/// The points that the ray has in common with the triangle (0: nothing, 1: the first point met, 2: the second, 3: a
/// segment), by the number of points and by the signs of their t as [`MetBoundary::contacts`] are.
const COMMON: [[usize; 9]; 3] = [
    [0; 9],
    [0, 0, 0, 1, 1, 1, 1, 1, 1],
    // Both behind; one behind and one at the origin; else something of the segment between them.
    [0, 2, 3, 1, 3, 3, 3, 3, 3],
];
