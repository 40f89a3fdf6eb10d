//! What the fuzz targets hold of every input, held of random ones: no two parts of this crate
//! contradict each other.

#[path = "../../fuzz/src/checks.rs"]
mod checks;

use checks::{check_kernel, check_oracle, check_response, disagreement};
use hairline::internals::case::{Case, Draw};
use hairline::internals::explore::inputs::Input;
use hairline::internals::explore::inputs::{self, AnyInput};
use hairline::internals::kernel::Scalar;
use hairline::internals::kernel::find;
use std::collections::HashSet;

/// Constructions, numbers of any bits, and mutants of both.
fn for_all_inputs(count: u64, mut check: impl FnMut(&AnyInput)) {
    for i in 0..count {
        let mut draw = Draw::new("checks", 1, i);
        let data: Vec<u8> = (0..draw.below(200)).map(|_| draw.bits() as u8).collect();
        let input = inputs::from_bytes(&data);
        check(&input);
        check(&inputs::mutated(&input, &mut draw));
    }
}

#[test]
fn nothing_contradicts_itself_on_random_inputs() {
    for_all_inputs(1500, |input| match input {
        AnyInput::F32(input) => check_all(input),
        AnyInput::F64(input) => check_all(input),
    });
    fn check_all<F: Scalar>(input: &Input<F>) {
        check_oracle(&input.case).unwrap();
        check_kernel(input).unwrap();
    }
}

#[test]
fn responses_contradict_no_run_on_random_inputs() {
    for_all_inputs(40, |input| match input {
        AnyInput::F32(input) => check_response(input).unwrap(),
        AnyInput::F64(input) => check_response(input).unwrap(),
    });
}

#[test]
fn constructions_show_false_misses_and_false_hits_of_many_kernels() {
    let (mut kernels, mut findings) = (HashSet::new(), HashSet::new());
    for_all_inputs(3000, |input| {
        let signature = match input {
            AnyInput::F32(input) => disagreement(input),
            AnyInput::F64(input) => disagreement(input),
        };
        kernels.extend(signature.iter().map(|signature| signature.kernel));
        findings.extend(signature.iter().map(|signature| signature.finding));
    });
    assert!(
        kernels.len() >= 10 && findings.len() >= 2,
        "{kernels:?} {findings:?}"
    );
}

#[test]
fn a_disagreement_is_the_known_one() {
    let triangle = [[0.0, -1.0, 0.0], [0.0, 1.0, 9.536743e-7], [0.0; 3]];
    let case = Case::<f32>::new([0.0, 0.0, 2.3841858e-7], [1.0, 0.0, 0.0], triangle);
    let input = Input::of_source(find("moller-trumbore").unwrap(), case);
    let signature = disagreement(&input).expect("the printed epsilon misses it");
    assert_eq!(
        (signature.finding.name(), signature.gate),
        ("false-miss", Some("parallel"))
    );
}
