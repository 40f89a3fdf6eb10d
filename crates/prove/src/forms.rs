//! The inputs of a formula as independent variables: differences of points, and points themselves.

use super::{Domain, Dyadic};
use crate::arith::recorded::Operation;

/// An input of a formula along one axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Leaf {
    /// A coordinate of a point: the origin, a, b or c as 0 to 3.
    Point(usize, usize),
    /// The difference of two points along an axis.
    Difference(usize, usize, usize),
    /// A coordinate of the direction.
    Direction(usize),
    /// t_min or t_max.
    End(usize),
}

impl Leaf {
    /// The leaf that an operation is.
    pub fn of(operation: Operation, operations: &[Operation]) -> Option<Leaf> {
        match operation {
            Operation::Input(i) => Some(Leaf::input(i.into())),
            Operation::Sub(a, b) => {
                let point = |place: u32| match operations[place as usize] {
                    Operation::Input(i) => match Leaf::input(i.into()) {
                        Leaf::Point(point, axis) => Some((point, axis)),
                        _ => None,
                    },
                    _ => None,
                };
                let ((p, axis), (q, other)) = (point(a)?, point(b)?);
                (axis == other && p != q).then_some(Leaf::Difference(p, q, axis))
            }
            _ => None,
        }
    }

    /// One of the seventeen numbers of a case.
    pub fn input(i: usize) -> Leaf {
        match i {
            0..3 => Leaf::Point(0, i),
            3..6 => Leaf::Direction(i - 3),
            6..15 => Leaf::Point((i - 3) / 3, i % 3),
            _ => Leaf::End(i - 15),
        }
    }

    /// True if it is rounded.
    pub fn is_difference(self) -> bool {
        matches!(self, Leaf::Difference(..))
    }

    /// Its bound in a domain.
    pub fn bound(self, domain: &Domain) -> Dyadic {
        match self {
            Leaf::Point(..) => domain.world,
            Leaf::Difference(p, q, _) if p == 0 || q == 0 => domain.reach,
            Leaf::Difference(..) => domain.edge,
            Leaf::Direction(_) => domain.direction,
            Leaf::End(_) => domain.extent,
        }
    }
}

/// A sum of variables with signs.
type Sum = Vec<(usize, i8)>;

/// Which sum of variables each input is. Along each axis, differences connect the points; as long as they
/// close no circle, each of them is a variable of its own, and a difference that closes one is a sum of the
/// others.
#[derive(Clone, Debug)]
pub struct Forms {
    /// By axis and point: the component that it belongs to, and where it lies in it. Component 0 holds the
    /// points whose coordinates are used as they are, which are differences to the ground.
    positions: [[Option<(usize, Sum)>; 5]; 3],
    components: usize,
    /// The variables of directions and ends.
    others: Vec<(Leaf, usize)>,
}

/// The point from which coordinates are counted.
const GROUND: usize = 4;

impl Forms {
    /// Without any input yet.
    pub fn new() -> Forms {
        let positions = [(); 3].map(|()| [None, None, None, None, Some((0, Vec::new()))]);
        Forms {
            positions,
            components: 0,
            others: Vec::new(),
        }
    }

    /// The sum that a leaf is, and whether it is a new variable, numbered `next`.
    pub fn sum(&mut self, leaf: Leaf, next: usize) -> (Sum, bool) {
        match leaf {
            Leaf::Difference(p, q, axis) => self.difference(p, q, axis, next),
            Leaf::Point(p, axis) => self.difference(p, GROUND, axis, next),
            _ => match self.others.iter().find(|(known, _)| *known == leaf) {
                Some((_, variable)) => (vec![(*variable, 1)], false),
                None => {
                    self.others.push((leaf, next));
                    (vec![(next, 1)], true)
                }
            },
        }
    }

    fn difference(&mut self, p: usize, q: usize, axis: usize, next: usize) -> (Sum, bool) {
        let variable = vec![(next, 1)];
        let positions = &mut self.positions[axis];
        match (positions[p].clone(), positions[q].clone()) {
            (Some((i, a)), Some((j, b))) if i == j => return (plus(&a, &b, -1), false),
            (Some((0, a)), Some((j, b))) => {
                // q moves to p - v.
                let by = plus(&plus(&a, &variable, -1), &b, -1);
                self.shift(axis, j, 0, &by);
            }
            (Some((i, a)), Some((j, b))) => {
                let by = plus(&plus(&b, &variable, 1), &a, -1);
                self.shift(axis, i, j, &by);
            }
            (Some((i, a)), None) => positions[q] = Some((i, plus(&a, &variable, -1))),
            (None, Some((j, b))) => positions[p] = Some((j, plus(&b, &variable, 1))),
            (None, None) => {
                self.components += 1;
                positions[q] = Some((self.components, Vec::new()));
                positions[p] = Some((self.components, variable.clone()));
            }
        }
        (variable, true)
    }

    fn shift(&mut self, axis: usize, from: usize, to: usize, by: &Sum) {
        for position in self.positions[axis].iter_mut().flatten() {
            if position.0 == from {
                *position = (to, plus(&position.1, by, 1));
            }
        }
    }
}

/// a + factor * b; every variable with a factor of 1 or -1 stays so, because differences along a tree
/// pass each edge once.
fn plus(a: &Sum, b: &Sum, factor: i8) -> Sum {
    let mut sum = a.clone();
    for (variable, sign) in b {
        match sum.iter_mut().find(|(known, _)| known == variable) {
            Some((_, known)) => *known += factor * sign,
            None => sum.push((*variable, factor * sign)),
        }
    }
    sum.retain(|(_, sign)| *sign != 0);
    sum
}
