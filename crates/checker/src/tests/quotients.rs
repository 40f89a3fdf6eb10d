//! The rules of quotients: n / d, n · (1 / d), the sum of two quotients by one divisor, and 1 less both.

use super::{BOTH, INVERSE, LARGE, ORDERED, QUOTIENT, RECIPROCAL, RELATIVE, REST, SHEAR, WIDE};
use super::{assert_each_is_refused, changed};

const UNFIT: &str = "found a rule that does not fit its operation";

/// The text of an operation's lemma.
fn lemma(certificate: &str, place: usize) -> &str {
    let start = certificate.find(&format!("lemma {place} ")).unwrap();
    let end = certificate[start..].find("\nerror").unwrap();
    let end = start + end + 1;
    &certificate[start..end + certificate[end..].find('\n').unwrap() + 1]
}

#[test]
fn a_rule_fits_its_operation() {
    let divisor_of_one = "found operation 2, expected one with a lemma above";
    assert_each_is_refused(
        QUOTIENT,
        &[
            (
                "no reciprocal",
                &[("8 quotient", "8 quotient-by-reciprocal")],
                UNFIT,
            ),
            (
                "a quotient is no sum",
                &[("8 quotient", "8 sum-of-quotients")],
                UNFIT,
            ),
            (
                "a product is no quotient",
                &[("lemma 4 sum", "lemma 4 quotient")],
                UNFIT,
            ),
            (
                "nor one by a reciprocal",
                &[("4 sum", "4 quotient-by-reciprocal")],
                UNFIT,
            ),
            (
                "a divisor has a lemma",
                &[(lemma(QUOTIENT, 7), "")],
                "found operation 7, expected one",
            ),
            (
                "a numerator has one",
                &[(lemma(QUOTIENT, 4), "")],
                "found operation 4, expected one with a lemma above",
            ),
        ],
    );
    assert_each_is_refused(
        RECIPROCAL,
        &[
            (
                "a product by a reciprocal",
                &[("4 quotient-by-reciprocal", "4 quotient")],
                UNFIT,
            ),
            (
                "a reciprocal is of 1",
                &[("op 1 number 1", "op 1 number 2")],
                UNFIT,
            ),
            (
                "the divisor has a lemma",
                &[(lemma(RECIPROCAL, 2), "")],
                divisor_of_one,
            ),
        ],
    );
}

#[test]
fn the_formula_is_of_the_numerator_and_of_the_divisor() {
    const LAST: &str = "found other last steps, expected numerator - quotient * divisor";
    // The quotient times d_x, which is a factor of the numerator.
    let divisor = [
        (
            "step 7 variables +2\nstep - variables +3\n",
            "step - variables +3\n",
        ),
        (
            "step - mul 4 3\nstep - sub 2 5\ncorner",
            "step - mul 3 1\nstep - sub 2 4\ncorner",
        ),
    ];
    // A factor of the numerator less the quotient times the divisor.
    let numerator = [
        (
            "step 3 variables +1\nstep 4 mul 0 1\nstep 7 variables +2\nstep - variables +3\n",
            "step 7 variables +2\nstep - variables +3\n",
        ),
        (
            "step - mul 4 3\nstep - sub 2 5\ncorner",
            "step - mul 2 1\nstep - sub 0 3\ncorner",
        ),
    ];
    assert_each_is_refused(
        QUOTIENT,
        &[
            ("another divisor", &divisor, LAST),
            ("another numerator", &numerator, LAST),
            ("a sum", &[("step - sub 2 5", "step - add 2 5")], LAST),
            (
                "the opposite",
                &[("step - sub 2 5", "step - sub 5 2")],
                LAST,
            ),
            (
                "a numerator of the proof alone",
                &[("step - sub 2 5", "step - sub 5 5")],
                "steps",
            ),
            (
                "no last steps",
                &[("step - mul 4 3\nstep - sub 2 5\n", "step - add 2 4\n")],
                "last",
            ),
        ],
    );
    assert_each_is_refused(
        INVERSE,
        &[
            (
                "a 1 that is not in it",
                &[("step - number 1", "step 0 number 1")],
                LAST,
            ),
            (
                "a numerator that is no 1",
                &[("step - sub 1 3", "step - sub 0 3")],
                "steps",
            ),
        ],
    );
    const BOTH_LAST: &str = "expected numerator + numerator - quotient * divisor";
    let last = lemma(BOTH, 5);
    let with = |changes: &[(&str, &str)]| changed(last, changes);
    let factor = with(&[
        ("step 0 variables +2\nstep - add 0 1", "step - add 0 1"),
        (
            "step - mul 4 2\nstep - sub 3 5",
            "step - mul 3 0\nstep - sub 2 4",
        ),
    ]);
    for (condition, changed) in [
        (
            "numerators in another order",
            with(&[("step - add 0 1", "step - add 1 0")]),
        ),
        (
            "a difference of numerators",
            with(&[("step - add 0 1", "step - sub 0 1")]),
        ),
        (
            "their product",
            with(&[("step - add 0 1", "step - mul 0 1")]),
        ),
        (
            "one of them twice",
            with(&[("step 3 variables +1", "step 1 variables +0")]),
        ),
        ("a numerator as the divisor", factor),
    ] {
        assert_each_is_refused(BOTH, &[(condition, &[(last, &changed)], BOTH_LAST)]);
    }
}

#[test]
fn a_divisor_is_away_from_zero_and_nothing_overflows() {
    const TINY: &str = "found a divisor that may be rounded to zero, expected a larger floor";
    let floor = (
        "direction-floor 1*2^-1 floor 1*2^-2",
        "direction-floor 1*2^-1 floor 1*2^-25",
    );
    let tiny = ("direction-floor 1*2^-1", "direction-floor 1*2^-149");
    // Half the smallest number more is enough; then other numbers are expected.
    let enough = ("direction-floor 1*2^-1", "direction-floor 3*2^-150");
    assert_each_is_refused(QUOTIENT, &[("a floor above the error", &[floor], TINY)]);
    assert_each_is_refused(
        ORDERED,
        &[("a floor above the smallest number", &[tiny], TINY)],
    );
    assert_eq!(super::refusal(&changed(ORDERED, &[enough])), None);
    let least = ("floor 1*2^-2", "floor 1*2^-127");
    assert_each_is_refused(
        RECIPROCAL,
        // The product is at most 2 all the same.
        &[(
            "a reciprocal is finite",
            &[least],
            "found 1*2^127, which may overflow",
        )],
    );
    assert_each_is_refused(
        LARGE,
        // Every number of the formula is below 2, the exact quotient too.
        &[(
            "a quotient is finite",
            &[("-149 2", "-149 1")],
            "4197377*2^-21, which may overflow",
        )],
    );
}

/// A product with a rounded reciprocal is off by u|q| more, 2^-23 for |q| up to 2, than a quotient, which is off by 2^-23
/// where it is rounded above 2.
#[test]
fn the_error_of_a_reciprocal_counts() {
    let error = "error 8388609*2^-45";
    assert_each_is_refused(
        RECIPROCAL,
        &[(
            "the reciprocal's error",
            &[(error, "error 1*2^-23")],
            &format!("expected `{error}`"),
        )],
    );
}

/// A lemma's bound before the last rounding leaves out one rounding, of a fixed size. That of a relative step is a share of
/// the exact value, and a difference in wider arithmetic has several in f64: nothing is left out of their bounds.
#[test]
fn only_one_rounding_of_a_fixed_size_is_left_out_of_a_divisor() {
    let quotient = ("error 4194305*2^-43", "error 8388609*2^-44");
    assert_each_is_refused(
        RELATIVE,
        &[(
            "a relative rounding counts",
            &[quotient],
            "expected `error 4194305*2^-43`",
        )],
    );
    let coordinate = [
        (
            "computed 4503599627370501*2^-52",
            "computed 4503599627370499*2^-52",
        ),
        ("error 5687927*2^-72", "error 10743933*2^-74"),
    ];
    assert_each_is_refused(
        WIDE,
        &[(
            "more than one counts",
            &coordinate,
            "expected `computed 4503599627370501*2^-52`",
        )],
    );
}

#[test]
fn what_the_orders_say() {
    // Without an order |n| <= |d| a quotient is as large as the domain lets it be.
    let coordinate = [
        ("op 0 input 4", "op 0 input 6"),
        ("order 4 3\norder 5 3", "order 6 3"),
        ("variable direction 1", "variable point 1 0"),
        ("variable direction 1", "variable point 1 0"),
    ];
    let ordered = changed(ORDERED, &coordinate);
    let larger = "found `size 1`, expected `size 1*2^1`";
    assert_each_is_refused(&ordered, &[("|n| <= |d|", &[("order 6 3\n", "")], larger)]);
    // The largest coordinate of the direction is one that is as large as both others; any other has the lower floor.
    let lower = "found `computed 8388609*2^-22`, expected `computed 4194305*2^-21`";
    assert_each_is_refused(
        SHEAR,
        &[
            ("it is as large as d_z", &[("order 5 3\n", "")], lower),
            ("it is as large as d_y", &[("order 4 3\n", "")], lower),
        ],
    );
}

#[test]
fn two_quotients_by_one_divisor() {
    let other_divisor = [
        ("op 4 div 3 0", "op 4 div 3 1"),
        (
            "variable point 1 1\nvariable direction 0\nvariable quotient\nstep 3 variables +0\nstep 0 ",
            "variable point 1 1\nvariable point 1 0\nvariable quotient\nstep 3 variables +0\nstep 1 ",
        ),
    ];
    assert_each_is_refused(
        BOTH,
        &[
            (
                "a sum, not 1 less both",
                &[("sum-of-quotients", "rest-of-quotients")],
                UNFIT,
            ),
            (
                "no reciprocal",
                &[("sum-of-quotients", "sum-of-quotients-by-reciprocal")],
                UNFIT,
            ),
            ("a sum of both", &[("op 5 add 2 4", "op 5 sub 2 4")], UNFIT),
            ("of two", &[("op 5 add 2 4", "op 5 add 2 2")], UNFIT),
            ("of quotients", &[("op 5 add 2 4", "op 5 add 2 3")], UNFIT),
            ("by one divisor", &other_divisor, UNFIT),
            (
                "the first has a lemma",
                &[(lemma(BOTH, 2), "")],
                "found operation 2, expected one",
            ),
            (
                "the second has one",
                &[(lemma(BOTH, 4), "")],
                "found operation 4, expected one",
            ),
        ],
    );
    // 3 - u has this bound.
    let three = "lemma 6 sum\nvariable cut 2\nstep 5 number 3\nstep 2 variables +0\nstep 6 sub 0 1\ncorner +\n\
                 first 5*2^-24\nrest 0\nsize 5\ncomputed 5\nerror 5*2^-24\n";
    let from_three = [("op 5 number 1", "op 5 number 3"), (lemma(REST, 6), three)];
    let sum = [
        ("op 6 sub 5 2", "op 6 add 5 2"),
        ("step 6 sub 0 1", "step 6 add 0 1"),
    ];
    assert_each_is_refused(
        REST,
        &[
            (
                "1 less both, not a sum",
                &[("rest-of-quotients", "sum-of-quotients")],
                UNFIT,
            ),
            (
                "less the second",
                &[("op 7 sub 6 4", "op 7 add 6 4")],
                UNFIT,
            ),
            ("less the first", &sum, UNFIT),
            ("from 1", &from_three, UNFIT),
            (
                "1 less the first has a lemma",
                &[(lemma(REST, 6), "")],
                "found operation 6, expected one with a lemma above",
            ),
        ],
    );
}
