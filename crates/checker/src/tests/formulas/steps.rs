//! The steps of a lemma's formula: operations of the program, sums of variables, and roundings that count relatively or
//! not at all.

use crate::tests::{
    ADDED, INVERSE, NEGATED, QUOTIENT, RECIPROCAL, REST, SHARED, SUM, TURNED, UNIT,
};
use crate::tests::{assert_each_is_refused, refusal};

#[test]
fn steps() {
    const UNKNOWN: &str = "expected an operation of the program";
    const VARIABLES: &str = "expected variables that are, or add up to, this operation";
    const SIGNS: &str = "expected variables, each with its sign";
    const SAME: &str = "expected the operation of the program with its operands";
    const NUMBER: &str = "expected the program's number";
    const UNUSED: &str = "found steps that the last one does not use, or none";
    let all = "step 2 variables +0\nstep 3 variables +1\nstep 4 mul 0 1\nrelative 0\n";
    let third = "step 4 mul 0 1";
    let across = [
        ("op 1 input 0", "op 1 input 1"),
        (
            "variable difference 1 0 0",
            "variable point 1 0\nvariable point 0 1",
        ),
        (
            "step 2 variables +0\nstep 3 variables +1",
            "step 2 variables +0 -1\nstep 3 variables +2",
        ),
    ];
    let of_direction = [
        ("op 1 input 0", "op 1 input 3"),
        ("variable difference 1 0 0", "variable point 1 0"),
        ("step 2 variables +0", "step 2 variables +0 -1"),
    ];
    let of_itself = [
        ("op 1 input 0", "op 1 input 6"),
        ("step 2 variables +0", "step 2 variables"),
    ];
    assert_each_is_refused(
        SUM,
        &[
            (
                "a step has an operation",
                &[(third, "step 4")],
                "expected more words",
            ),
            (
                "it is one of the program",
                &[(third, "step 5 mul 0 1")],
                UNKNOWN,
            ),
            (
                "also in a sum",
                &[("step 3 variables +1", "step - variables +1")],
                UNKNOWN,
            ),
            (
                "a variable has a sign",
                &[("variables +0", "variables 0")],
                SIGNS,
            ),
            ("plus or minus", &[("variables +0", "variables *0")], SIGNS),
            (
                "it is one of the formula",
                &[("variables +0", "variables +2")],
                SIGNS,
            ),
            (
                "variables are the input",
                &[("variables +1", "variables +0")],
                VARIABLES,
            ),
            (
                "with its sign",
                &[("variables +1", "variables -1")],
                VARIABLES,
            ),
            ("once", &[("variables +0", "variables +0 +0")], VARIABLES),
            (
                "an operation is no sum",
                &[(third, "step 4 variables +0")],
                VARIABLES,
            ),
            ("a difference is along one axis", &across, VARIABLES),
            ("a difference is of points", &of_direction, VARIABLES),
            ("of different points", &of_itself, VARIABLES),
            (
                "operands are earlier steps",
                &[(third, "step 4 mul 0 2")],
                "expected earlier steps",
            ),
            (
                "a step adds or multiplies",
                &[(third, "step 4 div 0 1")],
                "adds or multiplies",
            ),
            ("it is the operation", &[(third, "step 4 add 0 1")], SAME),
            ("its operands are those", &[(third, "step 4 mul 1 0")], SAME),
            (
                "factors have no variable in common",
                &[("op 4 mul 2 3", "op 4 mul 2 2"), (third, "step 4 mul 0 0")],
                "expected factors without a variable in common",
            ),
            (
                "nor one that both terms of a sum have",
                &[
                    ("op 4 mul 2 3", "op 4 mul 2 3\nop 5 add 4 2\nop 6 mul 5 2"),
                    (third, "step 4 mul 0 1\nstep 5 add 2 0\nstep 6 mul 3 0"),
                ],
                "found `step 6 mul 3 0`, expected factors without a variable in common",
            ),
            (
                "a minor is of f32 or f64",
                &[
                    (
                        "kernel mine f32\nformat 24 -149 127",
                        "kernel mine float\nformat 24 -149 126",
                    ),
                    ("op 4 mul 2 3", "op 4 minor 2 3 2 3"),
                    (third, "step 4 minor 0 1 0 1"),
                ],
                "expected no minor in this format",
            ),
            // An input has the number of its place, and what has operands has 0.
            (
                "an input is no number",
                &[("step 3 variables +1", "step 3 number 3")],
                NUMBER,
            ),
            (
                "nor is a difference",
                &[("step 2 variables +0", "step 2 number 0")],
                NUMBER,
            ),
            (
                "every step is used",
                &[(third, "step 3 variables +1\nstep 4 mul 0 1")],
                UNUSED,
            ),
            ("there is a step", &[(all, "")], UNUSED),
            (
                "there are not too many",
                &[(third, &"step 3 variables +1\n".repeat(4096))],
                "found more than 4096 steps",
            ),
        ],
    );
    let quotient = "step - variables +2";
    assert_each_is_refused(
        REST,
        &[
            (
                "a number is the program's",
                &[("step 5 number 1", "step 5 number 3")],
                NUMBER,
            ),
            (
                "and no other operation",
                &[("step 5 number 1", "step 0 number 1")],
                NUMBER,
            ),
            (
                "it is one number",
                &[("step 5 number 1", "step 5 number 1 1")],
                NUMBER,
            ),
            (
                "a number with a lemma",
                &[("step 2 variables +0", "step 4 variables +0")],
                VARIABLES,
            ),
            (
                "has its sign",
                &[("step 2 variables +0", "step 2 variables -0")],
                VARIABLES,
            ),
            // A coordinate in place of the quotient: n - x·d says nothing of n / d.
            (
                "a quotient is no input",
                &[(quotient, "step - variables +0")],
                VARIABLES,
            ),
            (
                "it has its sign",
                &[(quotient, "step - variables -2")],
                VARIABLES,
            ),
        ],
    );
    assert_each_is_refused(
        INVERSE,
        &[(
            "a numerator of none is 1",
            &[("step - number 1", "step - number 3")],
            NUMBER,
        )],
    );
    assert_each_is_refused(
        QUOTIENT,
        &[(
            "a proof needs no negation",
            &[("step - mul 4 3", "step - neg 4")],
            UNKNOWN,
        )],
    );
}

#[test]
fn steps_that_are_linear_in_a_unit_vector() {
    const LINEAR: &str = "expected terms that are all linear in parts, or all without one";
    const PARTS: &str = "expected different coordinates of one unit vector";
    let without = "lemma 11 sum\nvariable point 1 0\nvariable part 9\nstep 11 variables +0\n";
    // The second coordinate by a reciprocal of the length.
    let by_reciprocal = [
        (
            "op 10 div 2 8\n",
            "op 10 number 1\nop 11 div 10 8\nop 12 mul 2 11\n",
        ),
        (
            "op 11 input 6\nop 12 mul 9 11\n",
            "op 13 input 6\nop 14 mul 9 13\n",
        ),
        (
            "op 13 input 7\nop 14 mul 10 13\n",
            "op 15 input 7\nop 16 mul 12 15\n",
        ),
        ("op 15 add 12 14\n", "op 17 add 14 16\n"),
        ("lemma 10 unit", "lemma 12 unit"),
        ("lemma 15 sum", "lemma 17 sum"),
        ("variable part 10", "variable part 12"),
    ];
    assert_each_is_refused(
        UNIT,
        &[
            (
                "a part is of a unit vector",
                &[("variable part 9", "variable part 0")],
                PARTS,
            ),
            (
                "parts are different",
                &[("variable part 10", "variable part 9")],
                PARTS,
            ),
            ("parts are of one vector", &by_reciprocal, PARTS),
            (
                "a product has one part",
                &[
                    ("op 12 mul 9 11", "op 12 mul 9 10"),
                    ("step 12 mul 0 2", "step 12 mul 0 1"),
                ],
                LINEAR,
            ),
            (
                "each term has a part",
                &[
                    ("op 15 add 12 14", "op 15 add 12 13"),
                    ("step 15 add 4 5", "step 15 add 4 3"),
                ],
                LINEAR,
            ),
            (
                "the last step has one",
                &[("lemma 15 sum", &format!("{without}lemma 15 sum"))],
                "found a last step without a part",
            ),
        ],
    );
}

#[test]
fn relative_steps() {
    const RELATIVE: &str = "expected `relative STEPS, each an earlier one that rounds once`";
    let wide = [
        (
            "kernel mine f32\nformat 24 -149 127",
            "kernel mine f64\nformat 53 -1074 1023",
        ),
        ("op 4 mul 2 3", "op 4 minor 2 3 2 3"),
        ("step 4 mul 0 1", "step 4 minor 0 1 0 1"),
        ("relative 0", "relative 2"),
    ];
    let negation = [
        ("op 4 mul 2 3", "op 4 neg 2\nop 5 mul 4 3"),
        ("lemma 4", "lemma 5"),
        ("step 4 mul 0 1", "step 4 neg 0\nstep 5 mul 2 1"),
        ("relative 0", "relative 2"),
    ];
    assert_each_is_refused(
        SUM,
        &[
            ("it is a step", &[("relative 0", "relative 3")], RELATIVE),
            ("that rounds", &[("relative 0", "relative 1")], RELATIVE),
            ("once", &[("relative 0", "relative 0 0")], RELATIVE),
            ("a negation does not", &negation, RELATIVE),
            ("a minor rounds more than once in f64", &wide, RELATIVE),
        ],
    );
    let last = "step - sub 2 5\n";
    assert_each_is_refused(
        QUOTIENT,
        &[
            (
                "not of the numerator",
                &[(last, "step - sub 2 5\nrelative 2\n")],
                RELATIVE,
            ),
            (
                "not of the divisor",
                &[(last, "step - sub 2 5\nrelative 3\n")],
                RELATIVE,
            ),
            (
                "not of a product for the proof",
                &[(last, "step - sub 2 5\nrelative 5\n")],
                RELATIVE,
            ),
            (
                "nor of its last step",
                &[(last, "step - sub 2 5\nrelative 6\n")],
                RELATIVE,
            ),
        ],
    );
}

/// The last rounding of a numerator or a divisor is left out of the formula if one step alone has it, whatever its sign.
/// Then only what is made of a_x - o_x before counts, 2^-25 for each use.
#[test]
fn a_rounding_is_left_out_if_its_step_is_used_once() {
    for (roundings_that_count, certificate, first) in [
        ("the difference in a product", QUOTIENT, "first 1*2^-25"),
        ("the same under a negation", NEGATED, "first 1*2^-25"),
        ("both differences in a sum", ADDED, "first 1*2^-24"),
        (
            "a numerator that the divisor has too",
            SHARED,
            "first 3*2^-25",
        ),
        (
            "the same under a negation that both have",
            TURNED,
            "first 3*2^-25",
        ),
        ("none, of an input", RECIPROCAL, "first 0"),
    ] {
        assert_eq!(refusal(certificate), None, "{roundings_that_count}");
        let (_, lemma) = certificate.rsplit_once("corner ").unwrap();
        assert_eq!(lemma.lines().nth(1), Some(first), "{roundings_that_count}");
    }
}
