//! Recorded programs, run on numbers.

use crate::arith::Real;
use crate::arith::recorded::{Operation, Place};

/// Runs a program up to a place.
pub fn run<R: Real>(operations: &[Operation], last: Place, inputs: &[R; 17], values: &mut Vec<R>) {
    values.clear();
    for operation in &operations[..=last as usize] {
        let of = |place: Place| values[place as usize].clone();
        let value = match *operation {
            Operation::Input(i) => inputs[usize::from(i)].clone(),
            Operation::Number(value) => R::number(f64::from(value)),
            Operation::Add(a, b) => of(a) + &of(b),
            Operation::Sub(a, b) => of(a) - &of(b),
            Operation::Mul(a, b) => of(a) * &of(b),
            Operation::Div(a, b) => of(a) / &of(b),
            Operation::Neg(a) => -of(a),
            Operation::Abs(a) => of(a).abs(),
            Operation::Sqrt(a) => of(a).sqrt(),
            Operation::Fma(a, b, c) => R::fused(&of(a), &of(b), &of(c)),
            Operation::Minor(a, b, c, d) => {
                R::difference_of_products(&of(a), &of(b), &of(c), &of(d))
            }
        };
        values.push(value);
    }
}

/// The program of one number alone: the operations that it needs, each after its operands in their order, and where
/// each went. So two paths on which a number is computed in the same way have the same program of it.
pub fn cone(operations: &[Operation], last: Place) -> (Vec<Operation>, Vec<Option<Place>>) {
    let mut renamed = vec![None; operations.len()];
    let mut kept = Vec::new();
    let mut open = vec![last];
    while let Some(place) = open.last().copied() {
        let operation = operations[place as usize];
        let is_open = |operand: &Place| renamed[*operand as usize].is_none();
        if let Some(operand) = operation.operands().into_iter().find(is_open) {
            open.push(operand);
            continue;
        }
        open.pop();
        let of = |place: Place| -> Place { renamed[place as usize].expect("operands come first") };
        kept.push(operation.with(of));
        renamed[place as usize] = Some(kept.len() as Place - 1);
    }
    (kept, renamed)
}

/// The numbers that a number is made of, and itself.
pub fn parts(operations: &[Operation], place: Place) -> impl Iterator<Item = Place> + use<> {
    let (_, places) = cone(operations, place);
    (0..)
        .zip(places)
        .filter_map(|(place, needed)| needed.map(|_| place))
}
