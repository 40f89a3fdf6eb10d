//! The formula of a lemma: its variables, its steps, and what the corners say.

use super::{
    ADDED, BOXED, INVERSE, NEGATED, QUOTIENT, RECIPROCAL, REST, SHARED, SUM, TURNED, UNIT,
};
use super::{assert_each_is_refused, refusal};

#[test]
fn variables() {
    const FORM: &str = "expected `variable point P AXIS, difference P Q AXIS";
    const FOLLOWS: &str = "found a variable that follows from those above";
    const LEMMA: &str = "expected one with a lemma above";
    let difference = "variable difference 1 0 0";
    let direction = "variable direction 0";
    assert_each_is_refused(
        SUM,
        &[
            (
                "a kind is known",
                &[(difference, "variable vertex 1 0")],
                FORM,
            ),
            (
                "there are four points",
                &[(difference, "variable point 4 0")],
                FORM,
            ),
            (
                "with three coordinates",
                &[(difference, "variable point 1 3")],
                FORM,
            ),
            ("four in a box", &[(difference, "variable boxed 4 0")], FORM),
            (
                "three coordinates there",
                &[(difference, "variable boxed 1 3")],
                FORM,
            ),
            (
                "a difference of points",
                &[(difference, "variable difference 4 0 0")],
                FORM,
            ),
            (
                "of two points",
                &[(difference, "variable difference 1 4 0")],
                FORM,
            ),
            (
                "along an axis",
                &[(difference, "variable difference 1 0 3")],
                FORM,
            ),
            (
                "a direction's coordinate",
                &[(direction, "variable direction 3")],
                FORM,
            ),
            ("two ends", &[(direction, "variable end 2")], FORM),
            (
                "a number has one place",
                &[(direction, "variable cut 3 3")],
                FORM,
            ),
            (
                "a quotient only in its lemma",
                &[(direction, "variable quotient")],
                FORM,
            ),
            (
                "a number with a lemma",
                &[(direction, "variable cut 3")],
                LEMMA,
            ),
            (
                "no variable twice",
                &[(direction, "variable difference 1 0 0")],
                FOLLOWS,
            ),
            (
                "not the opposite one",
                &[(direction, "variable difference 0 1 0")],
                FOLLOWS,
            ),
            (
                "not a point less itself",
                &[(difference, "variable difference 1 1 0")],
                FOLLOWS,
            ),
            (
                "no circle of differences",
                &[(
                    direction,
                    "variable difference 1 2 0\nvariable difference 0 2 0",
                )],
                FOLLOWS,
            ),
            (
                "no difference of points that are known",
                &[(direction, "variable point 0 0\nvariable point 1 0")],
                FOLLOWS,
            ),
        ],
    );
    let mixed = "found points in a box and points as they are, expected one of both";
    let moved = "lemma 0 sum\nvariable boxed 1 0\nstep 0 variables +0\nlemma 5 sum";
    assert_each_is_refused(
        BOXED,
        &[
            (
                "all points are moved",
                &[("variable boxed 2 0", "variable point 2 0")],
                mixed,
            ),
            (
                "no step is a point that was moved",
                &[("lemma 5 sum", moved)],
                "expected a difference of points in a box",
            ),
        ],
    );
}

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

#[test]
fn numbers_that_overflow_or_are_too_long() {
    let float = ("kernel mine f32", "kernel mine float");
    let long = [
        ("reach 1 ", "reach 1*2^-4000 "),
        (" direction 1 ", " direction 1*2^4000 "),
        ("op 4 mul 2 3", "op 4 add 2 3"),
        ("step 4 mul 0 1", "step 4 add 0 1"),
    ];
    assert_each_is_refused(
        SUM,
        &[
            (
                "every step is finite",
                &[float, ("-149 127", "-149 0")],
                "found 1, which may overflow",
            ),
            (
                "integers are not too long",
                &long,
                "found numbers that are too long",
            ),
        ],
    );
}

/// A sum of 32 independent variables has 2^31 corners that are no mirror images.
#[test]
fn too_many_corners_are_refused_before_they_are_tried() {
    let mut text = SUM[..SUM.find("op 0").unwrap()].to_owned();
    let input = |place: usize| format!("op {place} input {place}\n");
    // Fifteen differences to the next point's coordinate, then the sum of all 32 numbers.
    let pair = |i: usize| {
        if i < 9 {
            [6 + i % 3, 9 + i % 3]
        } else {
            [6 + i % 3, i % 3]
        }
    };
    let difference = |i: usize| format!("op {} sub {} {}\n", 17 + i, pair(i)[0], pair(i)[1]);
    let sum = |i: usize| match i {
        0 => "op 32 add 0 1\n".to_owned(),
        _ => format!("op {} add {} {}\n", 32 + i, 31 + i, i + 1),
    };
    text.extend((0..17).map(input));
    text.extend((0..15).map(difference));
    text.extend((0..31).map(sum));
    for place in 17..32 {
        let [p, q] = pair(place - 17);
        let point = |input: usize| if input < 3 { 0 } else { input / 3 - 1 };
        let variable = format!("variable difference {} {} {}\n", point(p), point(q), p % 3);
        let lines = "corner +\nfirst 1*2^-25\nrest 0\nsize 1\ncomputed 1\nerror 1*2^-25\n";
        text += &format!("lemma {place} sum\n{variable}step {place} variables +0\n{lines}");
    }
    text += "lemma 62 sum\n";
    for input in 0..17 {
        text += &match input {
            0..3 => format!("variable point 0 {input}\n"),
            3..6 => format!("variable direction {}\n", input - 3),
            6..15 => format!("variable point {} {}\n", input / 3 - 1, input % 3),
            _ => format!("variable end {}\n", input - 15),
        };
    }
    text.extend((17..32).map(|place| format!("variable cut {place}\n")));
    text.extend((0..32).map(|place| format!("step {place} variables +{place}\n")));
    text.extend((0..31).map(|i| sum(i).replacen("op", "step", 1)));
    let found = refusal(&text).unwrap();
    assert!(
        found.ends_with("found too many corners of too many steps in this file"),
        "{found}"
    );
}
