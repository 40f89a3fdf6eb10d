//! Recorded programs, run on numbers.

use crate::arith::Real;
use crate::arith::recorded::{Operation, Place};

/// Runs a program; `values` becomes the values of its operations.
pub fn run<R: Real>(operations: &[Operation], inputs: &[R; 17], values: &mut Vec<R>) {
    values.clear();
    for operation in operations {
        let on_values = operation.with(|place| values[place as usize].clone());
        values.push(result(on_values, inputs));
    }
}

/// The values of all operations of a program.
pub fn values<R: Real>(operations: &[Operation], inputs: &[R; 17]) -> Vec<R> {
    let mut values = Vec::new();
    run(operations, inputs, &mut values);
    values
}

fn result<R: Real>(operation: Operation<R>, inputs: &[R; 17]) -> R {
    use Operation::*;
    match operation {
        Input(i) => inputs[i as usize].clone(),
        Number(value) => R::number(value.into()),
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
    /// The operations that it needs, each after its operands in their order. So a number that two paths compute in the same
    /// way has the same program on both.
    pub operations: Vec<Operation>,
    /// For each operation of the path, its place here; none if it is not needed.
    pub places: Vec<Option<Place>>,
}

impl Cone {
    /// Adds an operation after its operands, unless it is there.
    fn add(&mut self, place: Place, all: &[Operation]) {
        if self.places[place as usize].is_some() {
            return;
        }
        let operation = all[place as usize];
        for operand in operation.operands() {
            self.add(operand, all);
        }
        let renamed = operation.with(|operand| self.at(operand));
        let next = self.operations.len() as Place;
        self.places[place as usize] = Some(next);
        self.operations.push(renamed);
    }

    /// The place here of an operation that is needed.
    pub fn at(&self, place: Place) -> Place {
        self.places[place as usize].expect("a number needs what it is made of")
    }
}

/// The program of the number at a place.
pub fn cone(operations: &[Operation], last: Place) -> Cone {
    let mut cone = Cone {
        operations: Vec::new(),
        places: vec![None; operations.len()],
    };
    cone.add(last, operations);
    cone
}

/// The numbers that a number is made of, and itself.
pub fn parts(operations: &[Operation], place: Place) -> Vec<Place> {
    let places = cone(operations, place).places;
    let is_part = |part: &Place| places[*part as usize].is_some();
    (0..=place).filter(is_part).collect()
}
