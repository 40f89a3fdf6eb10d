//! Recorded programs, run again on numbers: they compute the margins of their kernel.

use crate::arith::Float;
use crate::arith::recorded::{Comparison, Operation, Place};
use crate::case::{Case, Draw};
use crate::kernel::{Compared, Entry, Gated, KERNELS, Path, Scalar, find};

/// Every number of a path's program, by the operations of its floats.
pub(super) fn run<F: Float>(path: &Path, inputs: &[F; 17]) -> Vec<F> {
    let mut values: Vec<F> = Vec::with_capacity(path.operations.len());
    for operation in &path.operations {
        let of = |place: Place| values[place as usize];
        values.push(match *operation {
            Operation::Input(i) => inputs[usize::from(i)],
            Operation::Number(value) => F::from_f64(value.into()),
            Operation::Add(a, b) => of(a) + of(b),
            Operation::Sub(a, b) => of(a) - of(b),
            Operation::Mul(a, b) => of(a) * of(b),
            Operation::Div(a, b) => of(a) / of(b),
            Operation::Neg(a) => -of(a),
            Operation::Abs(a) => of(a).abs(),
            Operation::Sqrt(a) => of(a).sqrt(),
            Operation::Fma(a, b, c) => of(a).mul_add(of(b), of(c)),
            Operation::Minor(a, b, c, d) => {
                F::difference_of_products(&of(a), &of(b), &of(c), &of(d))
            }
        });
    }
    values
}

/// True if inputs of these numbers take a path.
pub(super) fn is_taken<F: Float>(path: &Path, values: &[F]) -> bool {
    let of = |place: Place| values[place as usize];
    path.decisions.iter().all(|(comparison, answer)| {
        let holds = match *comparison {
            Comparison::Less(a, b) => of(a) < of(b),
            Comparison::AtMost(a, b) => of(a) <= of(b),
            Comparison::Zero(a) => of(a).is_zero(),
            Comparison::Negative(a) => of(a).is_sign_negative(),
        };
        holds == *answer
    })
}

fn margins_that_a_program_computes<F: Scalar>(entry: &Entry) -> usize {
    let gated: &dyn Gated<F> = F::subject(entry)
        .expect("both scalars")
        .gated()
        .expect("gates");
    let paths = gated.paths().expect("recorded");
    let mut draw = Draw::new("program", 1, 1);
    let mut compared = 0;
    for round in 0..16 {
        // Every other case on a lattice, where determinants vanish.
        let mut number = || match round % 2 {
            0 => draw.symmetric::<F>(),
            _ => F::from_f64(draw.integer(-2, 2) as f64 / 2.0),
        };
        let mut vector = || [(); 3].map(|()| number());
        let [o, d, a, b, c] = [(); 5].map(|()| vector());
        let case = Case::new(o, d, [a, b, c]).on(F::zero(), F::one());
        let ends = [F::zero(), F::one()];
        let inputs: Vec<F> = [o, d, a, b, c].concat().into_iter().chain(ends).collect();
        let inputs: [F; 17] = inputs.try_into().expect("seventeen");
        let runs = paths.iter().map(|path| (path, run(path, &inputs)));
        let Some((path, values)) = runs
            .into_iter()
            .find(|(path, values)| is_taken(path, values))
        else {
            continue;
        };
        let thresholds = gated.thresholds(&case);
        for (gate, expected) in thresholds.into_iter().enumerate() {
            let mine: Vec<&Compared> = path.compared.iter().filter(|c| c.gate == gate).collect();
            let places = mine.iter().flat_map(|c| &c.quantities);
            let found: Vec<f64> = places.map(|at| values[*at as usize].to_f64()).collect();
            compared += found.len();
            // What gates that round with their epsilon compare are not their margins.
            if mine.iter().any(|c| !c.is_margin()) || found.iter().any(|x| x.is_nan()) {
                continue;
            }
            // The least of all; where a gate takes either of two signs, one of its quantities.
            let is_one = mine.iter().all(|c| c.quantities.len() == 1);
            let least = found.iter().copied().fold(f64::INFINITY, f64::min);
            let expected = expected.to_f64();
            let agrees = if is_one {
                least == expected
            } else {
                found.contains(&expected)
            };
            let name = entry.info.name;
            assert!(
                agrees,
                "{name} gate {gate}: {found:?}, {expected}, {}",
                case.hex()
            );
        }
    }
    compared
}

#[test]
fn every_recorded_program_computes_the_margins_of_its_kernel() {
    for entry in KERNELS {
        for form in ["", "+fma", "+rearranged"] {
            let name = format!("{}{form}", entry.info.name);
            let entry = find(&name).expect("a kernel");
            let counts = [
                margins_that_a_program_computes::<f32>(entry),
                margins_that_a_program_computes::<f64>(entry),
            ];
            assert!(
                counts.iter().all(|count| *count >= 20),
                "{name}: {counts:?}"
            );
        }
    }
}
