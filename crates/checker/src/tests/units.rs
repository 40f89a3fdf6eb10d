//! The rule of a coordinate of a vector that is divided by its length.

use super::{UNIT, assert_each_is_refused};

#[test]
fn it_is_a_vector_of_three_by_its_length() {
    const OTHER: &str = "found another operation, expected a part of a vector by its length";
    // x² + (y² + z²) as two fused products.
    let fused = [
        ("op 4 add 1 3", "op 4 fma 2 2 1"),
        ("op 3 mul 2 2", "op 3 mul 2 2"),
    ];
    let product = [("op 4 add 1 3", "op 4 fma 2 0 1")];
    let accepted_but_unused = "found operations that the last one does not use";
    assert_each_is_refused(
        UNIT,
        &[
            ("a quotient", &[("lemma 9 unit", "lemma 12 unit")], OTHER),
            ("by a root", &[("op 8 sqrt 7", "op 8 abs 7")], OTHER),
            (
                "of a vector that has it",
                &[("op 9 div 0 8", "op 9 div 1 8")],
                OTHER,
            ),
            ("of squares", &[("op 3 mul 2 2", "op 3 mul 2 0")], OTHER),
            ("of fused squares", &product, OTHER),
            (
                "of a sum of squares",
                &[("op 4 add 1 3", "op 4 sub 1 3")],
                OTHER,
            ),
            ("not of two", &[("op 8 sqrt 7", "op 8 sqrt 4")], OTHER),
            ("not of four", &[("op 7 add 4 6", "op 7 add 4 4")], OTHER),
            (
                "of numbers with a lemma",
                &[("lemma 5 sum", "lemma 13 sum")],
                "found another last step",
            ),
            // The fused sum passes, and leaves its square unused.
            ("a fused square is one", &fused, accepted_but_unused),
        ],
    );
}

#[test]
fn its_length_is_away_from_zero_and_nothing_overflows() {
    const ZERO: &str = "found a length that may be rounded to zero, expected a larger floor";
    let floor = |floor: &'static str| [("floor 1*2^-2 quotient", floor)];
    // The squares of the coordinates are at most 3, the reciprocal of the length is about 4.
    let float = ("kernel mine f32", "kernel mine float");
    assert_each_is_refused(
        UNIT,
        &[
            (
                "no underflow in the root",
                &floor("floor 1*2^-50 quotient"),
                ZERO,
            ),
            (
                "squares are finite",
                &[float, ("-149 127", "-149 1"), ("floor 1*2^-2", "floor 1")],
                "which may overflow",
            ),
            (
                "the reciprocal is finite",
                &[float, ("-149 127", "-149 2")],
                "which may overflow",
            ),
        ],
    );
}
