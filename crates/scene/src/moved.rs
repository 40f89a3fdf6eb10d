//! A ray that is moved aside by less than any number, so that it meets no edge: which of the faces around a point, or
//! around a segment, it still meets, and whether that depends on where it was moved.
//!
//! The edge from p to q has S = d·((p-o)×(q-o)); a line meets the inside of a face if all three have the sign of D. If o
//! moves by εa + ε²b, an S that is 0 gets the sign of a·((p-q)×d), and if that is 0 too the sign of b·((p-q)×d). With unit
//! vectors on the two axes other than one on which d is not 0, both are 0 only if the edge is parallel to d, and then the
//! face has D = 0.
//!
//! Seen along d, the edges through the point begin there: one that ends in the point once, one that passes through it
//! twice. When the moved ray crosses such a beginning, the number of faces that it meets, front ones less back ones, changes
//! by the sum of what begins in that direction. So that number does not depend on where the ray was moved if and only if
//! the sum is 0 in each direction. Faces with D = 0 are segments seen along d; their edges cancel, and they are left out.

use crate::mesh::Triangle;
use crate::winding::{OpenEdge, Winding};
use hairline_core::oracle::integer::{ExactInteger, Integer, align, cross, minus};
use hairline_core::{Facing, Feature};
use num_bigint::BigInt;
use std::cmp::Ordering;

/// A face that a line crosses.
pub struct Crossed {
    pub face: u32,
    pub triangle: Triangle<f64>,
    pub facing: Facing,
    pub feature: Feature,
}

/// An axis on which the ray is moved by ε, and one on which it is moved by ε².
#[derive(Clone, Copy)]
pub struct Shift {
    axes: [usize; 2],
}

/// The beginning of an edge, seen along the direction.
struct Beginning {
    /// Its direction on the axes of the shift.
    toward: [BigInt; 2],
    /// 1 if the edge leaves the point that way, -1 if it comes from there.
    sign: i64,
    edge: OpenEdge,
}

/// How the winding changes where a line crosses faces that all share a point, or hold on to one segment; an edge if that
/// depends on where the line is moved.
pub fn change(direction: [f64; 3], crossed: &[Crossed]) -> Result<Winding, OpenEdge> {
    let shift = Shift::of(direction);
    let mut sum = Winding::Number(0);
    for face in crossed {
        if shift.still_meets(direction, face, [Way::Up; 2]) {
            sum = sum.plus(Winding::Number(match face.facing {
                Facing::Front => 1,
                Facing::Back => -1,
            }));
        }
    }
    let mut beginnings = Vec::new();
    for face in crossed {
        beginnings.extend(shift.beginnings(direction, face));
    }
    beginnings.sort_by(|a, b| compare_angles(&a.toward, &b.toward));
    let mut is_oriented = true;
    for same in beginnings.chunk_by(|a, b| compare_angles(&a.toward, &b.toward).is_eq()) {
        if same.len() % 2 == 1 {
            return Err(same[0].edge);
        }
        is_oriented &= same.iter().map(|beginning| beginning.sign).sum::<i64>() == 0;
    }
    Ok(if is_oriented { sum } else { sum.parity() })
}

/// True if the line, moved aside in one of four ways, meets none of these faces: whoever misses them is off by less than any
/// number.
pub fn are_missed_aside(direction: [f64; 3], crossed: &[Crossed]) -> bool {
    let shift = Shift::of(direction);
    let is_missed = |ways: [Way; 2]| {
        let mut faces = crossed.iter();
        !faces.any(|face| shift.still_meets(direction, face, ways))
    };
    let both = [Way::Up, Way::Down];
    both.into_iter()
        .any(|first| both.into_iter().any(|second| is_missed([first, second])))
}

/// The way in which the line is moved along an axis.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Way {
    Up,
    Down,
}

impl Way {
    fn of(self, sign: Ordering) -> Ordering {
        match self {
            Way::Up => sign,
            Way::Down => sign.reverse(),
        }
    }
}

impl Shift {
    fn of(direction: [f64; 3]) -> Shift {
        let k = direction.iter().position(|x| *x != 0.0).unwrap_or(0);
        Shift {
            axes: [(k + 1) % 3, (k + 2) % 3],
        }
    }

    /// (q-p)×d on the two axes, up to a positive factor.
    fn seen(self, direction: [f64; 3], [p, q]: [[f64; 3]; 2]) -> [BigInt; 2] {
        let ([p, q], _) = align([p, q]);
        let ([direction], _) = align([direction]);
        let all = cross(&minus(&q, &p), &direction);
        self.axes.map(|axis| all[axis].clone())
    }

    /// True if the line, moved along the two axes in these ways, meets the inside of a face.
    fn still_meets(self, direction: [f64; 3], face: &Crossed, ways: [Way; 2]) -> bool {
        let needed = match face.facing {
            Facing::Front => Ordering::Less,
            Facing::Back => Ordering::Greater,
        };
        edges_through(face).into_iter().all(|[p, q]| {
            let ends = [p, q].map(|i| face.triangle[i]);
            let [first, second] = self.seen(direction, ends);
            let first = ways[0].of(ExactInteger::sign(&first));
            let second = ways[1].of(ExactInteger::sign(&second));
            // (p-q)×d has the opposite signs.
            first.then(second).reverse() == needed
        })
    }

    /// The beginnings of a face's edges through the point.
    fn beginnings(self, direction: [f64; 3], face: &Crossed) -> Vec<Beginning> {
        let meets_vertex = face.feature.is_vertex();
        let vertex = vertex_of(face.feature);
        let mut all = Vec::new();
        for [p, q] in edges_through(face) {
            let ends = [p, q].map(|i| face.triangle[i]);
            let edge = OpenEdge {
                face: face.face,
                ends,
            };
            let [x, y] = self.seen(direction, ends);
            if !meets_vertex || vertex == p {
                all.push(Beginning {
                    toward: [x.clone(), y.clone()],
                    sign: 1,
                    edge,
                });
            }
            if !meets_vertex || vertex == q {
                all.push(Beginning {
                    toward: [-x, -y],
                    sign: -1,
                    edge,
                });
            }
        }
        all
    }
}

/// The edges of a face that the line meets, by the places of their corners.
fn edges_through(face: &Crossed) -> Vec<[usize; 2]> {
    let [ab, bc, ca] = [[0, 1], [1, 2], [2, 0]];
    match face.feature {
        Feature::EdgeAb => vec![ab],
        Feature::EdgeBc => vec![bc],
        Feature::EdgeCa => vec![ca],
        Feature::VertexA => vec![ca, ab],
        Feature::VertexB => vec![ab, bc],
        Feature::VertexC => vec![bc, ca],
        Feature::Interior | Feature::Outside => Vec::new(),
    }
}

/// The place of the corner that is a feature; 0 of others.
fn vertex_of(feature: Feature) -> usize {
    match feature {
        Feature::VertexB => 1,
        Feature::VertexC => 2,
        _ => 0,
    }
}

/// The order of two directions of a plane by their angle, the same for all lengths.
fn compare_angles(a: &[BigInt; 2], b: &[BigInt; 2]) -> Ordering {
    let is_lower = |[x, y]: &[BigInt; 2]| {
        let below = ExactInteger::sign(y).then(ExactInteger::sign(x));
        below == Ordering::Less
    };
    let half = is_lower(a).cmp(&is_lower(b));
    half.then_with(|| {
        let turn = BigInt::minor(&a[0], &b[1], &a[1], &b[0]);
        ExactInteger::sign(&turn).reverse()
    })
}
