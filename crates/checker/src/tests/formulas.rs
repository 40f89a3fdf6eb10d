//! The formula of a lemma: its variables, and its corners, where numbers overflow or are too many.

mod steps;

use super::{BOXED, SUM, assert_each_is_refused, refusal};

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
