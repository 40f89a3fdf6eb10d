//! Coordinates of edges divided by one number: what the domain says of such quotients together.

use super::Dyadic;
use super::bound::Prover;
use super::forms::Leaf;
use super::order::unsigned;
use crate::arith::recorded::{Operation, Place};

/// An edge as a sum of the vertices a, b and c.
type Edge = [i8; 3];

/// Two edges of a triangle whose coordinates along one axis have the same sign, one of them perhaps turned
/// round: then the third edge is no longer along that axis than the longer one of them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SameSign {
    divisor: Place,
    /// The vertex that both edges have.
    corner: usize,
    axis: usize,
    /// The other axis of the plane in which the divisor is twice the triangle's area.
    other: usize,
}

impl SameSign {
    /// The same of the other axis. One of both holds.
    pub fn or(self) -> SameSign {
        SameSign { axis: self.other, other: self.axis, ..self }
    }
}

impl Prover<'_> {
    /// A quotient of a coordinate of an edge and a divisor, up to its sign.
    pub(super) fn ratio(&self, leaf: Leaf, divisor: Place) -> Option<Place> {
        let Leaf::Difference(p @ 1.., q @ 1.., axis) = leaf else { return None };
        let operations = &self.path.operations;
        let is_ratio = |operation: &Operation| {
            let Operation::Div(n, d) = *operation else { return false };
            let numerator = operations[unsigned(self.path, n) as usize];
            let found = Leaf::of(numerator, operations);
            let is_leaf = [Leaf::Difference(p, q, axis), Leaf::Difference(q, p, axis)];
            d == divisor && found.is_some_and(|found| is_leaf.contains(&found))
        };
        let mut found = (0..operations.len()).filter(|place| self.counts(*place));
        found.find(|place| is_ratio(&operations[*place])).map(|place| place as Place)
    }

    /// True if the path divides a coordinate of an edge.
    pub(super) fn has_ratios(&self) -> bool {
        let is_ratio = |operation: &Operation| matches!(*operation, Operation::Div(n, _) if self.edge(n).is_some());
        self.path.operations.iter().any(is_ratio)
    }

    /// Quotients p and q of two edges' coordinates along one axis, and twice the triangle's area in a plane with
    /// that axis: where they are of the same sign, and the sign s for which q - s*p is such a quotient of the
    /// third edge.
    pub(super) fn third(&self, p: Place, q: Place) -> Option<(SameSign, i8)> {
        let (Operation::Div(n, divisor), Operation::Div(m, other)) =
            (self.operation(p), self.operation(q))
        else {
            return None;
        };
        let ((u, axis), (v, along)) = (self.edge(n)?, self.edge(m)?);
        let most = self.most(p)?.size().max(self.most(q)?.size());
        if divisor != other || axis != along || self.domain.edge * most >= Dyadic::ONE {
            return None;
        }
        let third = |sign: i8| [0, 1, 2].map(|i| v[i] - sign * u[i]);
        let is_edge = |edge: Edge| edge.map(i8::abs).iter().sum::<i8>() == 2;
        let sign = [1, -1].into_iter().find(|sign| is_edge(third(*sign)))?;
        let corner = third(sign).iter().position(|x| *x == 0)?;
        // Twice the triangle's area in a plane is the coordinate of N along the third axis.
        let is_other = |other: &usize| {
            *other != axis && self.samples().is_of_normal(divisor, 3 - axis - other)
        };
        let other = (0..3).find(is_other)?;
        Some((SameSign { divisor, corner, axis, other }, sign))
    }

    /// The edge whose coordinate a number is, and the axis.
    fn edge(&self, place: Place) -> Option<(Edge, usize)> {
        if let Operation::Neg(inner) = self.operation(place) {
            let (edge, axis) = self.edge(inner)?;
            return Some((edge.map(|x| -x), axis));
        }
        match Leaf::of(self.operation(place), &self.path.operations)? {
            Leaf::Difference(p @ 1.., q @ 1.., axis) => {
                let of = |i: usize| i8::from(i + 1 == p) - i8::from(i + 1 == q);
                Some(([0, 1, 2].map(of), axis))
            }
            _ => None,
        }
    }
}
