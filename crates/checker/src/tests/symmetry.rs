//! Claims that an edge's value is the exact negative of the neighbour's, and that it has the sign of a determinant.
//!
//! Programs alone: these claims depend on no lemma. No lemma is of a root, so the condition on its operand's sign can be
//! broken by no whole certificate.

use super::super::format::{F32, Format};
use super::super::opposite;
use super::super::program::Program;
use super::super::reader::Reader;

/// Why a claim about the last of some operations is refused. The first operations are the coordinates along x and y of a
/// and b, and d_x.
fn refusal(claim: &str, operations: &[&str]) -> Option<String> {
    let inputs = ["input 6", "input 9", "input 7", "input 10", "input 3"];
    let all = inputs.iter().chain(operations).enumerate();
    let text: String = all
        .map(|(place, operation)| format!("op {place} {operation}\n"))
        .collect();
    let mut reader = Reader {
        lines: text.lines().peekable(),
        line: 0,
        work: 0,
    };
    let program = Program::of_operations(Format::of(F32), &mut reader).unwrap();
    assert_eq!(
        program.operations.len(),
        inputs.len() + operations.len(),
        "{text}"
    );
    opposite::check(&program, program.operations.len() - 1, claim).err()
}

#[test]
fn a_value_is_the_negative_of_the_value_with_the_vertices_exchanged() {
    for (accepted, operations) in [
        ("a difference", &["sub 0 1"][..]),
        ("a sum with a negation", &["neg 1", "add 0 5"]),
        ("a product with a size", &["sub 0 1", "abs 5", "mul 5 6"]),
        (
            "a product with a root",
            &["mul 0 1", "sqrt 5", "sub 0 1", "mul 7 6"],
        ),
        ("a quotient by a sum", &["sub 0 1", "add 1 0", "div 5 6"]),
        ("a minor", &["minor 0 3 1 2"]),
        ("a fused product", &["sub 0 1", "mul 5 4", "fma 5 4 6"]),
    ] {
        assert_eq!(refusal("opposite", operations), None, "{accepted}");
    }
    const TWO: &str = "expected one that is made of two vertices";
    const NEGATIVE: &str = "expected its negative where the vertices are exchanged";
    for (condition, operations, words) in [
        ("of two vertices, not one", &["sub 0 4"][..], TWO),
        ("nor three", &["sub 0 1", "input 12", "mul 5 6"], TWO),
        ("another sign", &["add 0 1"], NEGATIVE),
        ("the other sign twice", &["sub 0 1", "mul 5 5"], NEGATIVE),
        ("the same form", &["mul 0 4", "sub 5 1"], NEGATIVE),
        ("another axis", &["sub 0 3"], NEGATIVE),
        // Its operand is the negative, whose root is another number.
        (
            "a root of the negative",
            &["sub 0 1", "sqrt 5", "mul 5 6"],
            NEGATIVE,
        ),
        (
            "a quotient turned over",
            &["div 0 1", "sub 0 1", "mul 5 6"],
            NEGATIVE,
        ),
        (
            "a fused product of another one",
            &["mul 1 4", "neg 5", "fma 0 4 6"],
            NEGATIVE,
        ),
        ("a size", &["abs 0", "sub 5 1"], NEGATIVE),
        (
            "a number with its sign",
            &["number 1", "sub 0 1", "add 5 6"],
            NEGATIVE,
        ),
        (
            "numbers of one size",
            &["number 2", "number 3", "mul 0 5", "mul 1 6", "sub 7 8"],
            NEGATIVE,
        ),
    ] {
        let refused = refusal("opposite", operations);
        assert!(
            refused.as_ref().is_some_and(|found| found.ends_with(words)),
            "{condition}: {refused:?}"
        );
    }
}

#[test]
fn signs_are_those_of_a_determinant_of_two_images() {
    let products = ["mul 0 3", "mul 1 2", "sub 5 6"];
    assert_eq!(refusal("signs", &products), None);
    assert_eq!(refusal("signs", &["minor 0 3 1 2"]), None);
    // Images that are sheared: x(p) is a_x - a_y·d_x.
    let sheared = [
        "mul 2 4", "sub 0 5", "mul 3 4", "sub 1 7", "mul 6 3", "mul 8 2", "sub 9 10",
    ];
    assert_eq!(refusal("signs", &sheared), None);
    const PICTURE: &str = "expected x(p)*y(q) - x(q)*y(p) of two vertices";
    for (condition, operations) in [
        ("a difference of products", &["sub 0 1"][..]),
        ("no product", &["sub 0 1", "mul 5 4"]),
        (
            "of two products",
            &["mul 0 3", "mul 1 2", "neg 6", "neg 7", "sub 5 8"],
        ),
        (
            "each factor is of a vertex",
            &["mul 0 4", "mul 1 4", "sub 5 6"],
        ),
        (
            "of one alone",
            &[
                "add 0 1", "sub 2 3", "mul 5 6", "sub 3 2", "mul 5 8", "sub 7 9",
            ],
        ),
        ("of different ones", &["mul 0 2", "mul 1 3", "sub 5 6"]),
        ("of different ones in a minor", &["minor 0 2 1 3"]),
        (
            "both are one picture",
            &["mul 0 3", "neg 1", "neg 2", "mul 6 7", "sub 5 8"],
        ),
    ] {
        let refused = refusal("signs", operations);
        assert!(
            refused
                .as_ref()
                .is_some_and(|found| found.ends_with(PICTURE)),
            "{condition}: {refused:?}"
        );
    }
}
