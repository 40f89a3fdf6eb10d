//! The programs of gates, each once, and the last roundings of quotients.

use super::super::{Domain, Format, Proof, Prover};
use super::tiny::round;
use crate::arith::recorded::{Operation, Place};
use crate::kernel::{Acceptance, Compared, Path, Refuse};

fn path(operations: Vec<Operation>, quantities: &[Place]) -> Path {
    let clauses = quantities.iter().map(|place| vec![*place]).collect();
    let accepts = Acceptance::Clauses(Refuse::Below, clauses);
    let compared = Compared {
        gate: 0,
        accepts,
        quantities: quantities.to_vec(),
        decisions: 0,
    };
    Path {
        operations,
        decisions: vec![],
        compared: vec![compared],
        hits: true,
        values: [None; 3],
    }
}

/// -999 (x + y) and (-999 + x) y: one number more than the codes of operations.
#[test]
fn programs_with_negative_numbers_are_not_taken_for_others() {
    use Operation::{Add, Input, Mul, Number};
    let operations = vec![
        Input(3),
        Input(4),
        Number(-999),
        Add(0, 1),
        Mul(2, 3),
        Add(2, 0),
        Mul(5, 1),
    ];
    let proof = Proof::new(
        vec![path(operations, &[4, 6])],
        None,
        Domain::UNIT,
        Format::F32,
    );
    let places: Vec<Place> = proof
        .quantities
        .iter()
        .map(|quantity| quantity.place)
        .collect();
    assert_eq!(places, [4, 6]);
    let errors = proof
        .quantities
        .iter()
        .map(|q| q.bound.as_ref().expect("a bound").error);
    assert_ne!(errors.clone().min(), errors.max());
}

/// d_x (a_x - o_x), and the same along y with b: one program under other names. The third one has two axes.
#[test]
fn programs_under_other_names_are_proved_once_and_named() {
    use Operation::{Input, Mul, Sub};
    let mut operations: Vec<Operation> = [0, 1, 3, 4, 6, 10].map(Input).to_vec();
    operations.extend([Sub(4, 0), Mul(2, 6), Sub(5, 1), Mul(3, 8), Mul(3, 6)]);
    let proof = Proof::new(
        vec![path(operations, &[7, 9, 10])],
        None,
        Domain::UNIT,
        Format::F32,
    );
    let [one, two] = &proof.quantities[..] else {
        panic!("{:?}", proof.quantities)
    };
    assert_eq!((one.place, two.place), (7, 10));
    let names: Vec<String> = one.also.iter().map(ToString::to_string).collect();
    assert_eq!(
        (&names[..], &two.also[..]),
        (&["yxz bac".to_owned()][..], &[][..])
    );
}

/// A change of sign is exact: a quotient has the same bound with it, above or below.
#[test]
fn the_rounding_under_a_negation_is_left_out_too() {
    use Operation::{Add, Div, Input, Neg, Sub};
    let mut operations: Vec<Operation> = [3, 4, 5, 6, 9].map(Input).to_vec();
    // The numerator is larger than the quotient may be: its rounding as a share of the quotient is less.
    operations.extend([Add(0, 1), Add(5, 2), Neg(6), Sub(3, 4), Neg(8)]);
    operations.extend([Div(6, 8), Div(7, 8), Div(6, 9), Div(7, 9)]);
    let path = path(operations, &[]);
    let bound = |place: Place| Prover::new(&path, Domain::UNIT, Format::F32).bound(place);
    let plain = bound(10).expect("a bound");
    for place in [11, 12, 13] {
        assert_eq!(bound(place).as_ref(), Ok(&plain), "{place}");
    }
}

/// Every float of four digits from 1/8 up to 1 times another, with the other sign, over one from 1/2 up to 1.
#[test]
fn no_quotient_of_a_negated_product_passes_its_bound_in_a_tiny_format() {
    use Operation::{Div, Input, Mul, Neg};
    let format = Format {
        digits: 4,
        smallest: -200,
        largest: 200,
    };
    let path = path(
        vec![Input(3), Input(4), Input(16), Mul(0, 1), Neg(3), Div(4, 2)],
        &[],
    );
    let bound = Prover::new(&path, Domain::UNIT, format)
        .bound(5)
        .expect("a bound");
    let floats = |binades: i32| {
        (0..binades).flat_map(|e| (8..16).map(move |m| f64::from(m) * 2f64.powi(-4 - e)))
    };
    let mut worst: f64 = 0.0;
    for (x, y, z) in floats(3)
        .flat_map(|x| floats(3).flat_map(move |y| floats(1).chain([1.0]).map(move |z| (x, y, z))))
    {
        let exact = -(x * y) / z;
        if exact.abs() <= Domain::UNIT.quotient.to_f64() {
            worst = worst.max((round(-round(x * y, 4) / z, 4) - exact).abs());
        }
    }
    let share = worst / bound.error.to_f64();
    assert!((0.45..=1.0).contains(&share), "{share}");
}
