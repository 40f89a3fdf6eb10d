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
        let (a, b) = match operation {
            Operation::Input(i) => return Some(Leaf::input(i.into())),
            Operation::Sub(a, b) => (operations[a as usize], operations[b as usize]),
            _ => return None,
        };
        let (Operation::Input(a), Operation::Input(b)) = (a, b) else {
            return None;
        };
        match (Leaf::input(a.into()), Leaf::input(b.into())) {
            (Leaf::Point(p, axis), Leaf::Point(q, other)) if axis == other && p != q => {
                Some(Leaf::Difference(p, q, axis))
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

/// The sum of variables that a leaf is.
pub struct Form {
    pub sum: Sum,
    /// True if it is a new variable.
    pub is_new: bool,
}

/// Which sum of variables each input is. Along each axis, differences connect the points; as long as they
/// close no circle, each of them is a variable of its own, and a difference that closes one is a sum of the
/// others.
#[derive(Clone)]
pub struct Forms {
    /// By axis and point. Component 0 holds the points whose coordinates are used as they are, which are differences to
    /// the ground.
    positions: [[Option<Position>; 5]; 3],
    components: usize,
    /// The variables of directions and ends.
    others: Vec<(Leaf, usize)>,
}

/// The component that a point belongs to, and where it lies in it.
#[derive(Clone)]
struct Position {
    component: usize,
    sum: Sum,
}

impl Position {
    /// The position of a point that is farther by a sum, or nearer if the factor is -1.
    fn moved(&self, by: &Sum, factor: i8) -> Position {
        Position {
            component: self.component,
            sum: plus(&self.sum, by, factor),
        }
    }
}

/// The point from which coordinates are counted.
const GROUND: usize = 4;

impl Forms {
    /// Without any input yet.
    pub fn new() -> Forms {
        let ground = Position {
            component: 0,
            sum: vec![],
        };
        let positions = [None, None, None, None, Some(ground)];
        Forms {
            positions: [(); 3].map(|()| positions.clone()),
            components: 0,
            others: Vec::new(),
        }
    }

    /// The sum that a leaf is, where a new variable has the number `next`.
    pub fn sum(&mut self, leaf: Leaf, next: usize) -> Form {
        match leaf {
            Leaf::Difference(p, q, axis) => return self.difference(p, q, axis, next),
            Leaf::Point(p, axis) => return self.difference(p, GROUND, axis, next),
            Leaf::Direction(_) | Leaf::End(_) => {}
        }
        let mut others = self.others.iter();
        let known = others.find(|(known, _)| *known == leaf).copied();
        if known.is_none() {
            self.others.push((leaf, next));
        }
        let variable = known.map_or(next, |(_, variable)| variable);
        Form {
            sum: vec![(variable, 1)],
            is_new: known.is_none(),
        }
    }

    fn difference(&mut self, p: usize, q: usize, axis: usize, next: usize) -> Form {
        let variable = vec![(next, 1)];
        let positions = &mut self.positions[axis];
        match (positions[p].clone(), positions[q].clone()) {
            (Some(p), Some(q)) if p.component == q.component => {
                return Form {
                    sum: plus(&p.sum, &q.sum, -1),
                    is_new: false,
                };
            }
            (Some(p), Some(q)) if p.component == 0 => {
                self.join(axis, &q, &p.moved(&variable, -1));
            }
            (Some(p), Some(q)) => self.join(axis, &p, &q.moved(&variable, 1)),
            (Some(p), None) => positions[q] = Some(p.moved(&variable, -1)),
            (None, Some(q)) => positions[p] = Some(q.moved(&variable, 1)),
            (None, None) => {
                self.components += 1;
                let origin = Position {
                    component: self.components,
                    sum: vec![],
                };
                positions[p] = Some(origin.moved(&variable, 1));
                positions[q] = Some(origin);
            }
        }
        Form {
            sum: variable,
            is_new: true,
        }
    }

    /// Moves a component so that one of its points, which is at `from`, comes to another component, at `to`.
    fn join(&mut self, axis: usize, from: &Position, to: &Position) {
        let by = plus(&to.sum, &from.sum, -1);
        for position in self.positions[axis].iter_mut().flatten() {
            if position.component == from.component {
                position.component = to.component;
                position.sum = plus(&position.sum, &by, 1);
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
