//! A kernel, its epsilons and a case: from bytes, to bytes, and moved.

use super::bytes::{Bytes, push_number};
use super::construction::construct;
use crate::arith::Float;
use crate::audit::{EpsilonText, Row};
use crate::case::{AnyScalar, Case, Draw};
use crate::kernel::{Entry, Gated, KERNELS, KernelIn, Scalar, Tunable};
use crate::moves::mutate;

/// The most gates whose epsilons an input can hold.
pub const MAX_GATES: usize = 8;

/// Bits of the first byte.
const IS_F64: u8 = 1;
const HAS_NUMBERS: u8 = 2;

/// The byte of an epsilon that is given by its bits, at the end of the input.
const GIVEN: u8 = 255;

/// A question to a kernel in one scalar.
#[derive(Clone)]
pub struct Input<F: Float> {
    /// The kernel, a built-in one.
    pub entry: &'static Entry,
    /// One epsilon a gate, each of which the command line takes.
    pub epsilons: Vec<F>,
    /// The ray and the triangle.
    pub case: Case<F>,
}

/// A question in the scalar that its bytes name.
pub type AnyInput = AnyScalar<Input<f32>, Input<f64>>;

/// The input that some bytes are read as. Any bytes are one.
pub fn from_bytes(data: &[u8]) -> AnyInput {
    let mut bytes = Bytes(data);
    let flags = bytes.byte();
    if flags & IS_F64 == 0 {
        AnyInput::F32(Input::read(flags, &mut bytes))
    } else {
        AnyInput::F64(Input::read(flags, &mut bytes))
    }
}

/// Bytes that [`from_bytes`] reads as this input.
pub fn to_bytes(input: &AnyInput) -> Vec<u8> {
    match input {
        AnyInput::F32(input) => input.write(HAS_NUMBERS),
        AnyInput::F64(input) => input.write(HAS_NUMBERS | IS_F64),
    }
}

/// An input one move away; equal draws give equal inputs.
pub fn mutated(input: &AnyInput, draw: &mut Draw) -> AnyInput {
    match input {
        AnyInput::F32(input) => AnyInput::F32(input.mutated(draw)),
        AnyInput::F64(input) => AnyInput::F64(input.mutated(draw)),
    }
}

impl<F: Scalar> Input<F> {
    /// A kernel with the epsilons of its source, on a case.
    pub fn of_source(entry: &'static Entry, case: Case<F>) -> Input<F> {
        let gates = 0..entry.info.gates.len();
        Input {
            entry,
            epsilons: gates.map(|gate| source(entry, gate)).collect(),
            case,
        }
    }

    fn read(flags: u8, bytes: &mut Bytes) -> Input<F> {
        let entry = &KERNELS[usize::from(bytes.below(KERNELS.len() as u8))];
        let choices = [(); MAX_GATES].map(|()| bytes.byte());
        let case = if flags & HAS_NUMBERS == 0 {
            construct(bytes)
        } else {
            read_case(bytes)
        };
        let mut epsilons = Vec::new();
        let margins = margins(entry, &case);
        for (gate, (margin, choice)) in margins.into_iter().zip(choices).enumerate() {
            epsilons.push(if choice == GIVEN {
                allowed(entry, gate, bytes.number())
            } else {
                chosen(entry, gate, margin, choice)
            });
        }
        Input {
            entry,
            epsilons,
            case,
        }
    }

    fn write(&self, flags: u8) -> Vec<u8> {
        let is_kernel = |entry: &Entry| entry.info.name == self.entry.info.name;
        let kernel = KERNELS.iter().position(is_kernel);
        let mut bytes = vec![flags, kernel.expect("a built-in kernel") as u8];
        bytes.extend([GIVEN; MAX_GATES]);
        for number in self.case.numbers().iter().chain(&self.epsilons) {
            push_number(&mut bytes, *number);
        }
        bytes
    }

    /// An input with another case mostly; else with another kernel, or with an epsilon at a margin of this case.
    fn mutated(&self, draw: &mut Draw) -> Input<F> {
        let mut input = self.clone();
        match draw.below(8) {
            0 => input = Input::of_source(&KERNELS[draw.below(KERNELS.len())], self.case),
            1 | 2 => {
                let margins = margins(self.entry, &self.case);
                let gate = draw.below(margins.len());
                let choice = draw.integer(0, i64::from(GIVEN) - 1) as u8;
                input.epsilons[gate] = chosen(self.entry, gate, margins[gate], choice);
            }
            _ => input.case = mutate(&self.case, draw),
        }
        input
    }

    /// The kernel with these epsilons, judged by its own contract.
    pub fn row(&self) -> Row {
        let text = |epsilon: &F| EpsilonText::Decimal(format!("{epsilon:e}"));
        Row {
            entry: self.entry,
            set: "fuzzed".to_owned(),
            epsilons: self.epsilons.iter().map(text).collect(),
            contract: self.entry.info.contract,
        }
    }
}

/// A built-in kernel, and the same with its gates. Every built-in kernel has both scalars, and shows its gates.
pub fn of_kernel<F: Scalar>(entry: &Entry) -> (&'static dyn KernelIn<F>, &'static dyn Gated<F>) {
    let subject = F::subject(entry).expect("a built-in kernel has both scalars");
    let gated = subject.gated().expect("a built-in kernel shows its gates");
    (subject, gated)
}

/// The margins of a built-in kernel's gates.
fn margins<F: Scalar>(entry: &Entry, case: &Case<F>) -> Vec<F> {
    let (_, gated) = of_kernel::<F>(entry);
    gated.measure(case).margins
}

fn read_case<F: Float>(bytes: &mut Bytes) -> Case<F> {
    let [origin, direction, a, b, c] = [(); 5].map(|()| [(); 3].map(|()| bytes.number()));
    Case::new(origin, direction, [a, b, c]).on(bytes.number(), bytes.number())
}

/// The epsilon of a gate in its source.
fn source<F: Float>(entry: &Entry, gate: usize) -> F {
    let values = entry.info.epsilon_sets[0].values;
    F::parse(values[gate]).expect("a number in the registry")
}

/// Epsilons that programs use.
const USUAL: [f64; 6] = [1e-3, 1e-5, 1e-6, 1e-8, 1e-12, 1e-20];

/// The epsilon that a byte below [`GIVEN`] stands for: the source's, a usual one, or one near the case's margin, where
/// verdicts change.
fn chosen<F: Float>(entry: &Entry, gate: usize, margin: F, choice: u8) -> F {
    let (kind, detail) = (choice % 8, choice / 8);
    let epsilon = match kind {
        0 | 1 => return source(entry, gate),
        2 => F::zero(),
        3 => F::EPSILON,
        4 => F::from_f64(USUAL[usize::from(detail) % USUAL.len()]),
        5 => F::zero().offset_ulps(detail.into()),
        _ => margin.offset_ulps(i64::from(detail % 5) - 2),
    };
    allowed(entry, gate, epsilon)
}

/// The epsilon if the gate takes it, else the nearest that it takes.
fn allowed<F: Float>(entry: &Entry, gate: usize, epsilon: F) -> F {
    match entry.info.gates[gate].epsilon {
        Tunable::Fixed => source(entry, gate),
        _ if !epsilon.is_finite() => F::zero(),
        Tunable::NonNegative => epsilon.abs(),
        Tunable::Signed => epsilon,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::oracle;
    use std::collections::HashSet;

    fn random_bytes(draw: &mut Draw) -> Vec<u8> {
        (0..draw.below(220)).map(|_| draw.bits() as u8).collect()
    }

    fn same(a: &AnyInput, b: &AnyInput) -> bool {
        match (a, b) {
            (AnyInput::F32(a), AnyInput::F32(b)) => parts(a) == parts(b),
            (AnyInput::F64(a), AnyInput::F64(b)) => parts(a) == parts(b),
            _ => false,
        }
    }

    fn parts<F: Float>(input: &Input<F>) -> (&str, Vec<u64>, [u64; 17]) {
        let epsilons = input.epsilons.iter().map(|e| e.to_bits()).collect();
        (input.entry.info.name, epsilons, input.case.bits())
    }

    #[test]
    fn inputs_and_their_mutants_survive_their_bytes() {
        for i in 0..5000 {
            let mut draw = Draw::new("bytes", 1, i);
            let input = from_bytes(&random_bytes(&mut draw));
            for input in [mutated(&input, &mut draw), input] {
                assert!(same(&from_bytes(&to_bytes(&input)), &input), "{i}");
            }
        }
    }

    #[test]
    fn every_kernel_fits_and_keeps_epsilons_that_the_command_line_takes() {
        assert!(
            KERNELS
                .iter()
                .all(|entry| entry.info.gates.len() <= MAX_GATES)
        );
        let (mut kernels, mut distinct) = (HashSet::new(), HashSet::new());
        for i in 0..5000 {
            let data = random_bytes(&mut Draw::new("epsilons", 1, i));
            let AnyInput::F64(input) = from_bytes(&data) else {
                continue;
            };
            kernels.insert(input.entry.info.name);
            for (gate, epsilon) in input.entry.info.gates.iter().zip(&input.epsilons) {
                distinct.insert(epsilon.to_bits());
                assert!(epsilon.is_finite(), "{i}");
                assert!(
                    gate.epsilon == Tunable::Signed || 0.0 <= *epsilon,
                    "{i}: {epsilon}"
                );
            }
            assert_eq!(input.row().epsilons::<f64>(), input.epsilons);
        }
        assert_eq!(kernels.len(), KERNELS.len());
        assert!(distinct.len() > 300, "{}", distinct.len());
    }

    #[test]
    fn short_bytes_reach_every_class_and_feature() {
        let mut seen = HashSet::new();
        for i in 0..20_000 {
            let mut draw = Draw::new("short", 1, i);
            let mut data: Vec<u8> = (0..40).map(|_| draw.bits() as u8).collect();
            data[0] &= !HAS_NUMBERS;
            if let AnyInput::F32(input) = from_bytes(&data) {
                let truth = oracle::truth(&input.case);
                seen.insert((
                    truth.class_name(),
                    truth.crossing().map(|c| c.feature.name()),
                ));
            }
        }
        // Eight features, and four classes beside the transversal one.
        assert_eq!(seen.len(), 12, "{seen:?}");
    }

    #[test]
    fn mutants_change_kernels_epsilons_and_cases() {
        let input = from_bytes(&[0, 10, 0, 0, 0, 0, 0, 0, 0, 0, 1, 9, 8, 7, 6, 5, 4, 3]);
        let AnyInput::F32(input) = input else {
            panic!("f32")
        };
        let mutants: Vec<_> = (0..500)
            .map(|i| input.mutated(&mut Draw::new("mutants", 1, i)))
            .collect();
        let (name, epsilons, case) = parts(&input);
        assert!(mutants.iter().any(|m| parts(m).0 != name));
        assert!(
            mutants
                .iter()
                .any(|m| parts(m).0 == name && parts(m).1 != epsilons)
        );
        assert!(mutants.iter().filter(|m| parts(m).2 != case).count() > 200);
    }
}
