//! Certificates of guarded kernels: their margins, their steps, and what their signs decide.

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

const GATE_B: &str = "gate b\nhit -39*62\nmiss +39*62\n";
const GATE_C: &str = "gate c\nhit +39*67\nmiss -39*67\n";
const GATE_A: &str = "gate a\nhit +39*69\nmiss -39*69\n";
const NEAR: &str = "gate near\nhit +39*46\nmiss -39*46\n";
const FAR: &str = "gate far\nhit +39*48\nmiss -39*48\n";

#[test]
fn rays_that_pass_all_gates_hit_surely() {
    const INSIDE: &str = "do not pass through the inside of the triangle";
    assert_each_is_refused(
        GUARDED,
        &[
            ("the weight of a is looked at", &[(GATE_A, "")], INSIDE),
            ("that of b", &[(GATE_B, "")], INSIDE),
            ("that of c", &[(GATE_C, "")], INSIDE),
            (
                "t_min is looked at",
                &[(NEAR, "")],
                "meet the triangle at t <= t_min",
            ),
            (
                "t_max is looked at",
                &[(FAR, "")],
                "meet the triangle at t >= t_max",
            ),
            (
                "every pattern of a gate",
                &[("hit +39*69", "hit +39*69\nhit -39*69")],
                INSIDE,
            ),
            (
                "every condition of a pattern",
                &[("hit +39*69", "hit +!39")],
                INSIDE,
            ),
            (
                "both ways of a choice",
                &[("gate near", "choice zero 0\nask\nfound\ngate near")],
                INSIDE,
            ),
            (
                "the first way too",
                &[("gate near", "choice zero 0\nfound\ngate near")],
                INSIDE,
            ),
            (
                "both ways of a sign",
                &[("gate near", "sign +39*69\nask\nfound\ngate near")],
                INSIDE,
            ),
            (
                "the sign of each way",
                &[(NEAR, "sign +39*46\nask\n")],
                "t <= t_min",
            ),
        ],
    );
    // Where the sign is sure, no gate needs it.
    let sure = changed(
        GUARDED,
        &[("found\nend", "found\nask\nend"), (NEAR, "sign +39*46\n")],
    );
    assert_eq!(refusal(&sure), None);
    assert_eq!(
        refusal(&changed(
            GUARDED,
            &[("gate near", "choice zero 0\nask\ngate near")]
        )),
        None
    );
    let ray = [
        ("guarded interval both", "guarded ray both"),
        (NEAR, "gate t\nhit +39*44\nmiss -39*44\n"),
        (FAR, ""),
    ];
    let ray = changed(GUARDED, &ray);
    let line = changed(
        GUARDED,
        &[("guarded interval", "guarded line"), (NEAR, ""), (FAR, "")],
    );
    let of_t = "gate t\nhit +39*44\nmiss -39*44\n";
    assert_each_is_refused(&ray, &[("t is looked at", &[(of_t, "")], "at t <= 0")]);
    // Where the front alone counts, the determinant has one sign, and both signs of t must be tried.
    let front = |certificate: &str, extent: &str| {
        let sides = [
            format!("guarded {extent} both"),
            format!("guarded {extent} front"),
        ];
        changed(
            certificate,
            &[(&sides[0], &sides[1]), ("hit +!39", "hit -39\nmiss +39")],
        )
    };
    assert_each_is_refused(
        &front(GUARDED, "interval"),
        &[
            (
                "t_min of a front",
                &[(NEAR, "")],
                "meet the triangle at t <= t_min",
            ),
            (
                "t_max of a front",
                &[(FAR, "")],
                "meet the triangle at t >= t_max",
            ),
        ],
    );
    assert_each_is_refused(
        &front(&ray, "ray"),
        &[("t of a front", &[(of_t, "")], "meet the triangle at t <= 0")],
    );
    assert_each_is_refused(
        &line,
        &[(
            "a front is one side",
            &[("line both", "line front")],
            "hit the back, and it promises the front only",
        )],
    );
    assert_each_is_refused(
        FRONT,
        &[(
            "it is the front",
            &[
                ("hit -39\nmiss +39", "hit +39\nmiss +39"),
                ("hit +62\nmiss -62", "hit -62"),
                ("hit -67\nmiss +67", "hit +67"),
                ("hit -69\nmiss +69", "hit +69"),
            ],
            "hit the back, and it promises the front only",
        )],
    );
}

#[test]
fn rays_that_a_gate_rejects_miss_surely() {
    let rejects = |gate: &str| format!("gate '{gate}' rejects rays that may hit");
    assert_each_is_refused(
        GUARDED,
        &[
            (
                "the weight of a",
                &[("miss -39*69", "miss +39*69")],
                &rejects("a"),
            ),
            ("of b", &[("miss +39*62", "miss -39*62")], &rejects("b")),
            ("of c", &[("miss -39*67", "miss +39*67")], &rejects("c")),
            (
                "t above t_min",
                &[("miss -39*46", "miss +39*46")],
                &rejects("near"),
            ),
            (
                "t below t_max",
                &[("miss -39*48", "miss +39*48")],
                &rejects("far"),
            ),
            (
                "both sides",
                &[("hit +!39", "hit +!39\nmiss -39")],
                &rejects("parallel"),
            ),
            (
                "every miss",
                &[("miss -39*69", "miss -39*69\nmiss +!39")],
                &rejects("a"),
            ),
            (
                "an edge",
                &[("miss -39*69", "miss +!39!62!67")],
                &rejects("a"),
            ),
        ],
    );
    let line = changed(
        GUARDED,
        &[("guarded interval", "guarded line"), (NEAR, ""), (FAR, "")],
    );
    let before = "gate t\nmiss -39*44\ngate a";
    assert_each_is_refused(
        &line,
        &[("all of a line", &[("gate a", before)], &rejects("t"))],
    );
    let ray = [
        ("guarded interval", "guarded ray"),
        (FAR, ""),
        (NEAR, "gate t\nhit +39*44\nmiss -39*44\n"),
    ];
    let ray = changed(GUARDED, &ray);
    let after = [("miss -39*44", "miss +39*44")];
    let far = "gate far\nmiss -39*48\ngate a";
    assert_each_is_refused(
        &ray,
        &[
            ("t above 0", &after, &rejects("t")),
            ("all of a ray", &[("gate a", far)], &rejects("far")),
        ],
    );
    assert_each_is_refused(
        FRONT,
        &[
            (
                "the front",
                &[("hit -39\nmiss +39", "hit -39\nmiss -39")],
                &rejects("parallel"),
            ),
            // Two axes exchanged turn every sign.
            (
                "under all names of axes",
                &[("axes yzx", "axes yxz")],
                &rejects("parallel"),
            ),
            (
                "under the first names too",
                &[("axes xyz", "axes yxz")],
                &rejects("parallel"),
            ),
        ],
    );
}

#[test]
fn a_number_is_known_by_its_polynomial() {
    const INSIDE: &str = "do not pass through the inside of the triangle";
    // The weight of a plus a number less itself.
    let weight = |operations: &[&str]| {
        let lines = operations.iter().enumerate();
        let lines: String = lines
            .map(|(i, it)| format!("op {} {it}\n", 70 + i))
            .collect();
        let last = 69 + operations.len();
        let unknown = changed(
            &with_operations(&lines),
            &[("hit +39*69", &format!("hit +39*{last}"))],
        );
        let margin = refusal(&changed(
            &unknown,
            &[(
                "gate parallel",
                &format!("margin {last} 0 0\ngate parallel"),
            )],
        ));
        let expected = margin
            .unwrap()
            .split_once("expected `")
            .unwrap()
            .1
            .replace('`', "");
        let margin = format!("margin {last} {expected}\ngate parallel");
        refusal(&changed(&unknown, &[("gate parallel", &margin)]))
    };
    assert_eq!(weight(&["sub 0 0", "add 70 69"]), None);
    assert_eq!(weight(&["number 64", "mul 70 69"]), None);
    // x^2, x^4 … x^64, and x^65 less itself.
    let powers = |most: usize| {
        let mut all = vec!["mul 0 0".to_owned()];
        all.extend((1..most).map(|i| format!("mul {} {}", 69 + i, 69 + i)));
        all
    };
    let degree = |odd: bool| {
        let mut all = powers(6);
        if odd {
            all.push("mul 75 0".to_owned());
        }
        let last = 69 + all.len();
        all.push(format!("sub {last} {last}"));
        all.push(format!("add {} 69", last + 1));
        weight(&all.iter().map(String::as_str).collect::<Vec<_>>())
    };
    assert_eq!(degree(false), None, "degree 64");
    assert!(degree(true).unwrap().contains(INSIDE), "degree 65");
    // 2^48 · x less itself has coefficients of 2^49 in all; 2^49 · x less itself 2^50, and one more from the weight.
    let coefficients = |factor: &str| {
        weight(&[
            "number 16777216",
            factor,
            "mul 70 70",
            "mul 71 72",
            "mul 73 0",
            "sub 74 74",
            "add 75 69",
        ])
    };
    assert_eq!(coefficients("number 1"), None);
    assert!(coefficients("number 2").unwrap().contains(INSIDE));
    // Another polynomial, a multiple that is too large, and zero.
    for unknown in [
        &["add 69 62"][..],
        &["number 65", "mul 70 69"],
        &["sub 69 69"],
    ] {
        assert!(weight(unknown).unwrap().contains(INSIDE), "{unknown:?}");
    }
    // The size of a number has two signs inside.
    assert!(weight(&["abs 69"]).unwrap().contains(INSIDE));
    assert_eq!(
        weight(&["abs 39", "abs 39", "mul 70 71", "mul 72 69"]),
        None
    );
    let sizes: Vec<String> = (0..9).map(|i| format!("abs {i}")).collect();
    let sums = (0..9).map(|i| format!("mul {} {}", if i == 0 { 69 } else { 78 + i }, 70 + i));
    let all: Vec<String> = sizes.iter().cloned().chain(sums).collect();
    let all: Vec<&str> = all.iter().map(String::as_str).collect();
    let many = "needs the signs of more than 8 numbers inside absolute values";
    assert!(weight(&all).unwrap().contains(many));
}
