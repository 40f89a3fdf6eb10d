//! The answer to "do the faces form a closed surface?", by coordinates and never by the numbers of vertices.
//!
//! The edges of all faces, each with its direction, are a chain. If they cancel everywhere, the surface is closed and
//! winding numbers are defined. If every part of an edge belongs to an even number of faces, the parity of layers is
//! defined. Most edges cancel with one between the same two points. Those that are left over may still cancel with parts
//! of others, at a T-junction whose points are exactly collinear: they are compared line by line, in rationals.

use crate::mesh::Triangle;
use crate::winding::OpenEdge;
use hairline_core::case::mix;
use num_rational::BigRational as Rational;
use num_traits::Zero;
use std::cmp::Ordering;
use std::collections::BTreeMap;

/// How far a surface is closed, with an edge where it is not.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Closed {
    /// Edges cancel with their directions: winding numbers are defined.
    pub oriented: Result<(), OpenEdge>,
    /// Edges cancel in pairs: the parity of layers is defined. So it is wherever winding numbers are.
    pub even: Result<(), OpenEdge>,
}

type Point = [f64; 3];

/// An edge between two points, the lesser point first.
#[derive(Clone, Copy)]
struct Edge {
    ends: [Point; 2],
    /// How many run from the first to the second point, less those that run back; or how many there are, modulo 2.
    count: i64,
    /// A face with this edge.
    face: u32,
}

/// The answer for triangles of these faces.
pub fn closed(triangle: impl Fn(usize) -> Triangle<f64>, faces: &[u32]) -> Closed {
    let edge = |place: u32, corner: usize| {
        let triangle = triangle(place as usize);
        Edge::new(
            triangle[corner],
            triangle[(corner + 1) % 3],
            faces[place as usize],
        )
    };
    // Edges between the same two points have the same digest. In this form 10^7 faces need little memory.
    let mut sides: Vec<(u64, u32, u8)> = Vec::with_capacity(3 * faces.len());
    for place in 0..faces.len() as u32 {
        for corner in 0..3 {
            let digest = edge(place, corner).digest();
            sides.push((digest, place, corner as u8));
        }
    }
    sides.sort_unstable();
    let mut signed = Vec::new();
    let mut unpaired = Vec::new();
    for alike in sides.chunk_by(|a, b| a.0 == b.0) {
        let edges = alike
            .iter()
            .map(|(_, place, corner)| edge(*place, (*corner).into()));
        let mut edges: Vec<Edge> = edges.collect();
        edges.sort_by(compare_ends);
        for same in edges.chunk_by(|a, b| compare_ends(a, b).is_eq()) {
            if compare_points(&same[0].ends[0], &same[0].ends[1]).is_eq() {
                continue;
            }
            let count: i64 = same.iter().map(|edge| edge.count).sum();
            if count != 0 {
                signed.push(Edge { count, ..same[0] });
            }
            if same.len() % 2 == 1 {
                unpaired.push(Edge {
                    count: 1,
                    ..same[0]
                });
            }
        }
    }
    Closed {
        oriented: cancel(&signed, |sum| sum == 0),
        even: cancel(&unpaired, |sum| sum % 2 == 0),
    }
}

impl Edge {
    fn new(from: Point, to: Point, face: u32) -> Edge {
        let is_forward = compare_points(&from, &to) == Ordering::Less;
        Edge {
            ends: if is_forward { [from, to] } else { [to, from] },
            count: if is_forward { 1 } else { -1 },
            face,
        }
    }

    /// Depends on the ends only. The two zeros are one number.
    fn digest(&self) -> u64 {
        let coordinates = self.ends.as_flattened().iter();
        coordinates.fold(0, |digest, x| mix(digest ^ (x + 0.0).to_bits()))
    }
}

/// An error if the counts of edges do not cancel on some part of a line: an edge that begins or ends there.
fn cancel(edges: &[Edge], is_nothing: impl Fn(i64) -> bool) -> Result<(), OpenEdge> {
    let mut lines: BTreeMap<Line, Vec<&Edge>> = BTreeMap::new();
    for edge in edges {
        lines.entry(Line::through(edge)).or_default().push(edge);
    }
    let open = lines
        .values()
        .find_map(|edges| open_part(edges, &is_nothing));
    open.map_or(Ok(()), |edge| Err(open_edge(edge)))
}

/// An edge of a line at which the sum of counts begins to be more than nothing.
fn open_part<'a>(edges: &[&'a Edge], is_nothing: impl Fn(i64) -> bool) -> Option<&'a Edge> {
    // Along a line points are in the order of their coordinates, or in the opposite one.
    let mut changes: Vec<(Point, i64, &Edge)> = Vec::new();
    for edge in edges {
        changes.push((edge.ends[0], edge.count, edge));
        changes.push((edge.ends[1], -edge.count, edge));
    }
    changes.sort_by(|a, b| compare_points(&a.0, &b.0));
    let mut sum = 0;
    for same in changes.chunk_by(|a, b| compare_points(&a.0, &b.0).is_eq()) {
        sum += same.iter().map(|(_, change, _)| change).sum::<i64>();
        if !is_nothing(sum) {
            return Some(same[0].2);
        }
    }
    None
}

/// A line, by a vector along it and a point of it, each in the one form that all its edges share.
#[derive(PartialEq, Eq, PartialOrd, Ord)]
struct Line {
    /// 1 on the first axis on which the line has extent.
    direction: [Rational; 3],
    /// 0 on that axis.
    point: [Rational; 3],
}

impl Line {
    fn through(edge: &Edge) -> Line {
        let [from, to] = edge.ends.map(|end| end.map(exact));
        let along: [Rational; 3] = std::array::from_fn(|i| &to[i] - &from[i]);
        let axis = (0..3).find(|i| !along[*i].is_zero());
        let axis = axis.expect("an edge between two points");
        let direction: [Rational; 3] = std::array::from_fn(|i| &along[i] / &along[axis]);
        let point = std::array::from_fn(|i| &from[i] - &from[axis] * &direction[i]);
        Line { direction, point }
    }
}

fn exact(x: f64) -> Rational {
    Rational::from_float(x).expect("a finite coordinate")
}

/// With the two zeros as one number.
fn compare_points(a: &Point, b: &Point) -> Ordering {
    let order = a.partial_cmp(b);
    order.expect("finite coordinates")
}

fn compare_ends(a: &Edge, b: &Edge) -> Ordering {
    let first = compare_points(&a.ends[0], &b.ends[0]);
    first.then_with(|| compare_points(&a.ends[1], &b.ends[1]))
}

fn open_edge(edge: &Edge) -> OpenEdge {
    OpenEdge {
        face: edge.face,
        ends: edge.ends,
    }
}
