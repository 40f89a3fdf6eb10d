//! Certificates of guarded kernels: how their margins and their steps are written.

mod decisions;
mod polynomials;

use super::{FRONT, GUARDED, assert_each_is_refused, changed, refusal};

/// The text before the margins, more operations, and the rest.
fn with_operations(operations: &str) -> String {
    changed(GUARDED, &[("margin 39", &format!("{operations}margin 39"))])
}

#[test]
fn promise_and_margins() {
    const PROMISE: &str = "expected `guarded line, ray or interval, and both or front`";
    const MARGIN: &str = "expected `margin OPERATION ROUNDINGS FACTOR, once for an operation`";
    let promise = "guarded interval both";
    let margin = "margin 39 6 12779533*2^-45\n";
    let last = "op 69 sub 68 67";
    let without = |name: &str| format!("found a margin of a number with `{name}`, which has none");
    assert_each_is_refused(
        GUARDED,
        &[
            (
                "an extent is known",
                &[(promise, "guarded segment both")],
                PROMISE,
            ),
            (
                "sides are known",
                &[(promise, "guarded interval back")],
                PROMISE,
            ),
            ("both are there", &[(promise, "guarded interval")], PROMISE),
            (
                "nothing else is",
                &[(promise, "guarded interval both front")],
                PROMISE,
            ),
            (
                "a margin is of an operation",
                &[("margin 39 ", "margin 70 ")],
                MARGIN,
            ),
            ("of each once", &[(margin, &margin.repeat(2))], MARGIN),
            ("it has a factor", &[(margin, "margin 39 6\n")], MARGIN),
            ("and nothing else", &[(margin, "margin 39 6 1 1\n")], MARGIN),
            (
                "its roundings",
                &[("39 6 127", "39 5 127")],
                "expected `6 12779533*2^-45`",
            ),
            (
                "its factor",
                &[("12779533", "12779531")],
                "expected `6 12779533*2^-45`",
            ),
            (
                "no quotient has one",
                &[(last, "op 69 div 68 67")],
                &without("div"),
            ),
            ("no root", &[(last, "op 69 sqrt 68")], &without("sqrt")),
            (
                "no fused product",
                &[(last, "op 69 fma 68 67 0")],
                &without("fma"),
            ),
        ],
    );
    // The signs of inputs and of differences are exact, of points and of others.
    let difference = "op 70 sub 0 4\n";
    for place in [0, 15, 17, 70] {
        let exact = format!("{difference}margin {place} 0 0\n");
        assert_eq!(refusal(&with_operations(&exact)), None);
        let inexact = format!("{difference}margin {place} 0 1*2^-24\n");
        let found = refusal(&with_operations(&inexact)).unwrap();
        assert!(
            found.ends_with("found `0 1*2^-24`, expected `0 0`"),
            "{found}"
        );
    }
    // A sum of a number with itself seven times has 128 terms, each of which may underflow twice.
    let double = |i: usize| format!("op {} add {} {}\n", 70 + i, 69 + i, 69 + i);
    let square = |i: usize| format!("op {} mul {} {}\n", 70 + i, 69 + i, 69 + i);
    let sums: String = (0..7).map(double).collect();
    let squares: String = (0..14).map(square).collect();
    for (operations, words) in [
        (
            format!("{sums}margin 76 0 0\n"),
            "found operation 76 with too many terms",
        ),
        (
            format!("{squares}margin 83 0 0\n"),
            "with too many roundings",
        ),
    ] {
        let found = refusal(&with_operations(&operations)).unwrap();
        assert!(found.contains(words), "{found}");
    }
}

#[test]
fn steps() {
    const FORM: &str = "expected `axes XYZ in some order, or a comparison`";
    const CHOICE: &str = "expected `choice COMPARISON`";
    const SIGN: &str = "expected `sign CONDITION`";
    const HIT: &str = "expected `hit CONDITIONS`";
    const MISS: &str = "expected `miss CONDITIONS`";
    let axes = "axes less 3 4";
    assert_each_is_refused(
        FRONT,
        &[
            ("a comparison is known", &[(axes, "axes more 3 4")], FORM),
            ("of two numbers", &[(axes, "axes less 3")], FORM),
            ("of operations", &[(axes, "axes less 3 70")], FORM),
            ("or of one", &[(axes, "axes zero 3 4")], FORM),
            ("axes are three", &[("axes yzx", "axes yz")], FORM),
            ("and different", &[("axes yzx", "axes yzz")], FORM),
            ("a comparison has two branches", &[("axes yzx\n", "")], FORM),
            (
                "and no more",
                &[("axes yzx\n", "axes yzx\naxes zxy\n")],
                "expected `ask`",
            ),
            (
                "an end of the axes",
                &[(axes, &"axes zero 3\n".repeat(512))],
                "too many names of axes",
            ),
        ],
    );
    let gate = "gate parallel\n";
    let choice = |word: &str| format!("choice {word}\nask\ngate parallel\n");
    assert_each_is_refused(
        GUARDED,
        &[
            ("a choice is known", &[(gate, &choice("more 0 1"))], CHOICE),
            ("of operations", &[(gate, &choice("less 0 70"))], CHOICE),
            (
                "a sign is one condition",
                &[(gate, "sign +39 +46\nask\ngate parallel\n")],
                SIGN,
            ),
            (
                "a gate has one name",
                &[(gate, "gate parallel det\n")],
                "expected `gate NAME`",
            ),
            (
                "found is one word",
                &[("\nfound", "\nfound it")],
                "expected `found`",
            ),
            (
                "ask is one word",
                &[("\nfound", "\nask it")],
                "expected `ask`",
            ),
            ("the steps end", &[("\nfound", "")], "expected `ask`"),
            (
                "end is one word",
                &[("\nend", "\nend it")],
                "expected `end`",
            ),
            (
                "nothing follows",
                &[("\nend", "\nend\nend")],
                "found more lines after the end",
            ),
            (
                "there is an end",
                &[(gate, &"choice zero 0\n".repeat(512))],
                "found too many steps",
            ),
            ("a condition has a sign", &[("hit +!39", "hit !39")], HIT),
            ("plus or minus", &[("hit +!39", "hit *39")], HIT),
            (
                "a number to be not zero has a margin",
                &[("hit +!39", "hit +!38")],
                HIT,
            ),
            (
                "a number with a sign has one",
                &[("hit +39*46", "hit +38*46")],
                HIT,
            ),
            ("and the other too", &[("hit +39*46", "hit +39*45")], HIT),
            (
                "also where it misses",
                &[("miss -39*46", "miss -38*46")],
                MISS,
            ),
            (
                "a number is written in one way",
                &[("hit +39*46", "hit +039*46")],
                HIT,
            ),
        ],
    );
}
