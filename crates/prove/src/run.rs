//! Recorded programs, run on numbers.

use crate::arith::Real;
use crate::arith::recorded::{Operation, Place};

/// Runs a program up to a place.
pub fn run<R: Real>(operations: &[Operation], last: Place, inputs: &[R; 17], values: &mut Vec<R>) {
    values.clear();
    for operation in &operations[..=last as usize] {
        let on_values = operation.with(|place| values[place as usize].clone());
        values.push(result(on_values, inputs));
    }
}

/// The values of all operations of a program.
pub fn values<R: Real>(operations: &[Operation], inputs: &[R; 17]) -> Vec<R> {
    let mut values = Vec::new();
    let last = operations.len() as Place - 1;
    run(operations, last, inputs, &mut values);
    values
}

fn result<R: Real>(operation: Operation<R>, inputs: &[R; 17]) -> R {
    use Operation::*;
    match operation {
        Input(i) => inputs[usize::from(i)].clone(),
        Number(value) => R::number(f64::from(value)),
        Add(a, b) => a + &b,
        Sub(a, b) => a - &b,
        Mul(a, b) => a * &b,
        Div(a, b) => a / &b,
        Neg(a) => -a,
        Abs(a) => a.abs(),
        Sqrt(a) => a.sqrt(),
        Fma(a, b, c) => R::fused(&a, &b, &c),
        Minor(a, b, c, d) => R::difference_of_products(&a, &b, &c, &d),
    }
}

/// The program of one number alone.
pub struct Cone {
    /// The operations that it needs, each after its operands in their order. So two paths on which a number is computed in
    /// the same way have the same program of it.
    pub operations: Vec<Operation>,
    /// For each operation of the path, its place here.
    pub places: Vec<Option<Place>>,
}

pub fn cone(operations: &[Operation], last: Place) -> Cone {
    let mut places = vec![None; operations.len()];
    let mut needed = Vec::new();
    let mut open = vec![last];
    while let Some(place) = open.last().copied() {
        let operation = operations[place as usize];
        let mut operands = operation.operands().into_iter();
        if let Some(operand) = operands.find(|operand| places[*operand as usize].is_none()) {
            open.push(operand);
            continue;
        }
        open.pop();
        places[place as usize] = Some(needed.len() as Place);
        needed.push(operation.with(|place| places[place as usize].expect("operands come first")));
    }
    Cone {
        operations: needed,
        places,
    }
}

/// The numbers that a number is made of, and itself.
pub fn parts(operations: &[Operation], place: Place) -> Vec<Place> {
    let cone = cone(operations, place);
    let mut parts = Vec::new();
    for (part, needed) in (0..).zip(cone.places) {
        if needed.is_some() {
            parts.push(part);
        }
    }
    parts
}
