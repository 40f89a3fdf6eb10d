//! The numbers of a guarded kernel are known by their polynomials, up to limits of degree and coefficients.

use super::with_operations;
use crate::tests::{changed, refusal};

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
