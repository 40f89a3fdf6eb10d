//! The lines around the lemmas: heading, domain, operations, suppositions, claims.

use super::{INVERSE, ORDERED, QUOTIENT, SUM, assert_each_is_refused, changed, refusal};

#[test]
fn the_first_lines() {
    const VERSION: &str = "expected `hairline proof 3`";
    const KERNEL: &str = "expected `kernel NAME SCALAR`";
    const FORMAT: &str = "expected `format DIGITS SMALLEST LARGEST, as of the scalar`";
    const DOMAIN: &str = "expected `domain edge X reach X world X";
    let format = "kernel mine f32\nformat 24 -149 127\n";
    let other = |scalar: &str, format: &str| format!("kernel mine {scalar}\nformat {format}\n");
    for [scalar, numbers] in [
        ["f32", "53 -1074 1023"],
        ["f64", "24 -149 127"],
        ["f16", "24 -149 127"],
        ["float", "2 -149 127"],
        ["float", "61 -149 127"],
        ["float", "24 -2049 127"],
        ["float", "24 1 127"],
        ["float", "24 -149 -1"],
        ["float", "24 -149 2049"],
        ["float", "24 -149"],
        ["float", "24 -149 127 0"],
    ] {
        let other = other(scalar, numbers);
        assert_each_is_refused(
            SUM,
            &[("a format of the scalar", &[(format, &other)], FORMAT)],
        );
    }
    // The numbers are the same in any format of as many digits.
    assert_eq!(
        refusal(&changed(SUM, &[(format, &other("float", "24 -149 127"))])),
        None
    );
    assert_each_is_refused(
        SUM,
        &[
            ("the version", &[("proof 3", "proof 2")], VERSION),
            (
                "a kernel with a name",
                &[("kernel mine f32", "kernel f32")],
                KERNEL,
            ),
            (
                "one name",
                &[("kernel mine f32", "kernel mine own f32")],
                KERNEL,
            ),
            ("eight bounds", &[(" quotient 1*2^1", "")], DOMAIN),
            (
                "no more bounds",
                &[(" quotient 1*2^1", " quotient 1*2^1 height 1")],
                DOMAIN,
            ),
            (
                "bounds in their order",
                &[("edge 1 reach 1", "reach 1 edge 1")],
                DOMAIN,
            ),
            ("bounds are numbers", &[("edge 1", "edge one")], DOMAIN),
            ("bounds are sizes", &[("edge 1", "edge -1")], DOMAIN),
            ("a mantissa is odd", &[("edge 1", "edge 2*2^-1")], DOMAIN),
            (
                "an exponent says something",
                &[("edge 1", "edge 1*2^0")],
                DOMAIN,
            ),
            (
                "an exponent is not too large",
                &[("edge 1", "edge 1*2^4097")],
                DOMAIN,
            ),
            (
                "an exponent is not too small",
                &[("edge 1", "edge 1*2^-4097")],
                DOMAIN,
            ),
            (
                "a domain of a later program",
                &[("\nend", "\nend\ndomain edge 1")],
                DOMAIN,
            ),
        ],
    );
}

#[test]
fn a_text_of_more_than_four_mebibytes_is_refused() {
    let with_name = |length: usize| changed(SUM, &[("mine", &"m".repeat(length))]);
    let longest = 4 + (1 << 22) - SUM.len();
    assert_eq!(refusal(&with_name(longest)), None);
    let found = refusal(&with_name(longest + 1)).unwrap();
    assert!(found.ends_with("found more than 4194304 bytes"), "{found}");
}

#[test]
fn operations() {
    const FIRST: &str = "expected `op 0 OPERATION OPERANDS, each an earlier one`";
    const THIRD: &str = "expected `op 2 OPERATION OPERANDS, each an earlier one`";
    assert_each_is_refused(
        SUM,
        &[
            (
                "the line program is one word",
                &[("program\n", "program mine\n")],
                "`program`",
            ),
            ("operations are counted", &[("op 2 sub", "op 3 sub")], THIRD),
            (
                "a case has 17 inputs",
                &[("op 0 input 6", "op 0 input 17")],
                FIRST,
            ),
            (
                "an input is counted from 0",
                &[("op 0 input 6", "op 0 input -1")],
                FIRST,
            ),
            (
                "an input is one number",
                &[("op 0 input 6", "op 0 input 6 7")],
                FIRST,
            ),
            (
                "an input has a number",
                &[("op 0 input 6", "op 0 input")],
                FIRST,
            ),
            (
                "a number is a float",
                &[("op 0 input 6", "op 0 number 16777217")],
                FIRST,
            ),
            (
                "below zero too",
                &[("op 0 input 6", "op 0 number -16777217")],
                FIRST,
            ),
            (
                "operands are earlier ones",
                &[("op 2 sub 0 1", "op 2 sub 0 2")],
                THIRD,
            ),
            (
                "operations are known",
                &[("op 2 sub 0 1", "op 2 max 0 1")],
                THIRD,
            ),
            (
                "a difference is of two",
                &[("op 2 sub 0 1", "op 2 sub 0")],
                THIRD,
            ),
            (
                "no more than two",
                &[("op 2 sub 0 1", "op 2 sub 0 1 1")],
                THIRD,
            ),
            (
                "a size is of one",
                &[("op 2 sub 0 1", "op 2 abs 0 1")],
                THIRD,
            ),
            (
                "a root is of one",
                &[("op 2 sub 0 1", "op 2 sqrt 0 1")],
                THIRD,
            ),
            (
                "a quotient is of two",
                &[("op 2 sub 0 1", "op 2 div 0")],
                THIRD,
            ),
            (
                "one addend is no sum",
                &[("op 2 sub 0 1", "op 2 fma 0 1")],
                THIRD,
            ),
        ],
    );
    let largest = changed(INVERSE, &[("op 0 number 1", "op 0 number 16777216")]);
    assert!(
        !refusal(&largest).unwrap().contains("op 0"),
        "2^24 is a float"
    );
    // No more than 4,096 operations are read.
    let many: String = (5..4097)
        .map(|place| format!("op {place} neg {}\n", place - 1))
        .collect();
    let many = changed(SUM, &[("lemma 4", &format!("{many}lemma 4"))]);
    assert!(
        refusal(&many)
            .unwrap()
            .starts_with("line 4102: found `op 4096 neg 4095`")
    );
}

#[test]
fn every_operation_serves_the_last_one_which_has_a_lemma() {
    const UNUSED: &str = "found operations that the last one does not use, or none";
    let unused = [
        ("op 4 mul 2 3\n", "op 4 input 7\nop 5 mul 2 3\n"),
        ("lemma 4", "lemma 5"),
        ("step 4", "step 5"),
    ];
    let proof = &SUM[SUM.find("lemma 4").unwrap()..SUM.find("claim").unwrap()];
    let operations = &SUM[SUM.find("op 0").unwrap()..SUM.find("lemma 4").unwrap()];
    let missing = "found operation 4, expected one with a lemma above";
    assert_each_is_refused(
        SUM,
        &[
            ("an operation is used", &unused, UNUSED),
            (
                "there is an operation",
                &[(operations, ""), (proof, "")],
                UNUSED,
            ),
            ("the last one has a lemma", &[(proof, "")], missing),
        ],
    );
}

#[test]
fn what_is_supposed() {
    const ORDER: &str = "expected `order INPUT INPUT, each pair once`";
    let order = "order 5 3\n";
    assert_each_is_refused(
        ORDERED,
        &[
            (
                "an order is of two",
                &[(order, "order 5 3\norder 3 3\n")],
                ORDER,
            ),
            (
                "it stands once",
                &[(order, "order 5 3\norder 5 3\n")],
                ORDER,
            ),
            (
                "it is of inputs",
                &[(order, "order 5 3\norder 17 3\n")],
                ORDER,
            ),
            ("not of three", &[(order, "order 5 3 4\n")], ORDER),
            // Each has a numerator or is of the direction, and has a divisor.
            (
                "of the divisor",
                &[(order, "order 5 3\norder 4 5\n")],
                "found `order 4 5`, which no",
            ),
            (
                "of the numerator",
                &[(order, "order 5 3\norder 6 3\n")],
                "found `order 6 3`, which",
            ),
        ],
    );
    // Without d_y <= d_x the other order says neither which is largest nor that |n| <= |d|.
    let point = [("variable direction 1", "variable point 1 0"); 2];
    let one_order = [
        ("op 0 input 4", "op 0 input 6"),
        ("order 4 3\norder 5 3", "order 6 3"),
    ];
    let one_order = changed(ORDERED, &[&one_order[..], &point].concat());
    assert_each_is_refused(
        &one_order,
        &[(
            "of the largest",
            &[("order 6 3\n", "order 6 3\norder 5 3\n")],
            "found `order 5 3`",
        )],
    );
    for word in ["at-least", "at-most", "down-to"] {
        let form = format!("expected `{word} OPERATION X, once for an operation`");
        let insert = |lines: &str| format!("{}\nlemma 4", lines.replace("limit", word));
        let rows = [
            ("a limit stands once", insert("limit 8 1\nlimit 8 1")),
            ("it is of an operation", insert("limit 9 1")),
            ("it is a size", insert("limit 8 -1")),
            ("it is one number", insert("limit 8 1 1")),
        ];
        for (condition, lines) in rows {
            assert_each_is_refused(QUOTIENT, &[(condition, &[("lemma 4", &lines)], &form)]);
        }
    }
    const ALSO: &str = "expected `also AXES VERTICES, as yzx abc, for another program`";
    let also = |names: &str| format!("also {names}\nlemma 4");
    for (condition, names) in [
        ("it is another program", "xyz abc"),
        ("also where other names change nothing", "xzy acb"),
        ("it is not above", "yzx abc\nalso yzx abc"),
        ("axes have three names", "yz abc"),
        ("axes have different names", "yyz abc"),
        ("axes are x, y and z", "yzw abc"),
        ("vertices have three names", "yzx ab"),
        ("vertices have different names", "yzx aab"),
        ("vertices are a, b and c", "yzx abd"),
        ("both have names", "yzx"),
        ("nothing else has", "yzx abc tu"),
    ] {
        assert_each_is_refused(SUM, &[(condition, &[("lemma 4", &also(names))], ALSO)]);
    }
}

#[test]
fn lemmas_and_claims() {
    const LEMMA: &str = "expected `lemma OPERATION sum, unit or quotient";
    const CLAIM: &str = "expected `claim GATE, and opposite or signs where it is so`";
    let lemma = &SUM[SUM.find("lemma 4").unwrap()..SUM.find("claim").unwrap()];
    let twice = lemma.repeat(2);
    let negation = [("lemma 4 sum", "op 5 neg 4\nlemma 5 sum")];
    let size = [("lemma 4 sum", "op 5 abs 4\nlemma 5 sum")];
    assert_each_is_refused(
        SUM,
        &[
            (
                "a rule is known",
                &[("lemma 4 sum", "lemma 4 product")],
                LEMMA,
            ),
            (
                "a sum has no reciprocal",
                &[("4 sum", "4 sum-by-reciprocal")],
                LEMMA,
            ),
            (
                "a lemma has one rule",
                &[("lemma 4 sum", "lemma 4 sum sum")],
                LEMMA,
            ),
            (
                "it is of an operation",
                &[("lemma 4 sum", "lemma 5 sum")],
                LEMMA,
            ),
            ("not of a negation", &negation, LEMMA),
            ("not of a size", &size, LEMMA),
            ("of each once", &[(lemma, &twice)], LEMMA),
            (
                "of the last step",
                &[("lemma 4 sum", "lemma 3 sum")],
                "another last step, expected op",
            ),
            (
                "its corner",
                &[("corner ++", "corner +-")],
                "expected `corner ++`",
            ),
            (
                "one sign a variable",
                &[("corner ++", "corner +++")],
                "expected `corner ++`",
            ),
            (
                "its first order",
                &[("first 3*2", "first 5*2")],
                "expected `first 3*2^-25`",
            ),
            (
                "its rest",
                &[("rest 1*2^-150", "rest 0")],
                "expected `rest 1*2^-150`",
            ),
            ("its size", &[("size 1", "size 3")], "expected `size 1`"),
            (
                "its computed size",
                &[("computed 1", "computed 3")],
                "expected `computed 1`",
            ),
            (
                "its error",
                &[("error 12582913", "error 12582911")],
                "expected `error 12582913*2^-47`",
            ),
            (
                "one number a line",
                &[("size 1", "size 1 1")],
                "expected `size 1`",
            ),
            ("a claim names a gate", &[("claim edge", "claim")], CLAIM),
            (
                "and one symmetry",
                &[("claim edge", "claim edge signs opposite")],
                CLAIM,
            ),
            ("that is known", &[("claim edge", "claim edge sign")], CLAIM),
            (
                "the symmetry holds",
                &[("claim edge", "claim edge opposite")],
                "found `opposite`",
            ),
            (
                "the line end is one word",
                &[("\nend", "\nend edge")],
                "expected `end`",
            ),
            (
                "nothing but programs follow",
                &[("\nend", "\nend\nend")],
                "expected `program`",
            ),
        ],
    );
    let none = &SUM[..SUM.find("program").unwrap()];
    assert!(
        refusal(none)
            .unwrap()
            .ends_with("expected a program with a claim")
    );
}
