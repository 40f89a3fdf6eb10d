//! Gappa proves what the scripts state. Where it is not installed, these tests say so and pass.

use super::super::{Domain, Dyadic, Format, Prover, gappa, is_impossible};
use crate::arith::recorded::{Operation, Place};
use crate::kernel::{Path, Scalar, find};
use std::io::{ErrorKind, Write};
use std::process::{Command, Stdio};

/// Everything at most 1.
const BOX: Domain =
    Domain { edge: Dyadic::ONE, reach: Dyadic::ONE, world: Dyadic::ONE, ..Domain::UNIT };

/// Gappa's answer to a script: true if it proved it, and the text that it wrote. None if there is no Gappa.
fn answer(script: &str) -> Option<(bool, String)> {
    let spawned = Command::new("gappa")
        .stdin(Stdio::piped())
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn();
    let mut gappa = match spawned {
        Err(error) if error.kind() == ErrorKind::NotFound => {
            println!("skipped: there is no gappa here (apt-get install gappa)");
            return None;
        }
        spawned => spawned.expect("gappa starts"),
    };
    let mut input = gappa.stdin.take().expect("a pipe");
    input.write_all(script.as_bytes()).expect("gappa reads");
    drop(input);
    let output = gappa.wait_with_output().expect("gappa ends");
    Some((output.status.success(), String::from_utf8_lossy(&output.stderr).into_owned()))
}

/// The bound that Gappa found: `in [0, 21b-24 {…}]`.
fn found(answer: &str) -> Option<Dyadic> {
    let (_, rest) = answer.split_once("in [0, ")?;
    let number = rest.split([' ', ']']).next()?;
    let (mantissa, exponent) = number.split_once('b').unwrap_or((number, "0"));
    Some(Dyadic::new(mantissa.parse().ok()?, exponent.parse().ok()?))
}

/// The first quantity of a gate on the first path that `wanted` takes.
fn quantity<F: Scalar>(kernel: &str, gate: &str, wanted: fn(&Path) -> bool) -> (Path, Place) {
    let entry = find(kernel).expect("a kernel");
    let gate = entry.info.gates.iter().position(|g| g.name == gate).expect("a gate");
    let gated = F::subject(entry).and_then(|subject| subject.gated()).expect("gates");
    let paths = gated.paths().expect("recorded");
    let path = paths.into_iter().find(|path| !is_impossible(path) && wanted(path));
    let path = path.expect("a path");
    let quantities = path.compared.iter().filter(|c| c.gate == gate).flat_map(|c| &c.quantities);
    let is_new = |at: &&Place| !matches!(path.operations[**at as usize], Operation::Neg(_));
    let place = *quantities.into_iter().find(is_new).expect("a quantity");
    (path, place)
}

/// The bounds that Gappa and the prover prove of a gate on the unit domain, in units of u. Gappa accepts
/// its bound as a goal.
fn both<F: Scalar>(kernel: &str, gate: &str, wanted: fn(&Path) -> bool) -> Option<[f64; 2]> {
    let format = if F::DIGITS == 24 { Format::F32 } else { Format::F64 };
    let (path, place) = quantity::<F>(kernel, gate, wanted);
    let name = format!("{kernel} {gate}");
    let script = |goal| gappa(&path, place, BOX, format, &name, goal).expect("a script");
    let (proved, text) = answer(&script(None))?;
    assert!(proved, "{name}: {text}\n{}", script(None));
    let theirs = found(&text).unwrap_or_else(|| panic!("{name}: {text}"));
    let (proved, text) = answer(&script(Some(theirs)))?;
    assert!(proved, "{name}: {text}");
    let ours = Prover::new(&path, BOX, format).bound(place).expect("a bound").error;
    Some([theirs, ours].map(|bound| bound.to_f64() / format.unit().to_f64()))
}

#[test]
fn gappa_proves_bounds_that_are_at_most_twice_as_large() {
    for (kernel, gate) in [
        ("moller-trumbore", "parallel"),
        ("moller-trumbore", "edge"),
        ("moller-trumbore+fma", "parallel"),
        ("scalar-triple", "edge"),
        ("half-space", "edge"),
        ("cramer", "edge"),
        ("woop-watertight", "edge"),
        ("woop-watertight+fma", "edge"),
        ("plucker", "edge"),
    ] {
        let Some([theirs, ours]) = both::<f32>(kernel, gate, |_| true) else { return };
        println!("{kernel} {gate}: gappa {theirs:.3} u, hairline {ours:.3} u");
        // Ours know which roundings belong together, and are never looser.
        assert!(
            ours <= 1.001 * theirs && theirs <= 2.1 * ours,
            "{kernel} {gate}: {theirs}, {ours}"
        );
    }
}

#[test]
fn gappa_refuses_a_goal_that_is_too_small() {
    let (path, place) = quantity::<f64>("moller-trumbore", "parallel", |_| true);
    let goal = |units: i128| Dyadic::new(units, -53);
    for (units, expected) in [(21, true), (1, false)] {
        let script =
            gappa(&path, place, BOX, Format::F64, "det", Some(goal(units))).expect("a script");
        let Some((proved, text)) = answer(&script) else { return };
        assert_eq!(proved, expected, "{units} u: {text}");
    }
}

/// Woop's fallback.
#[test]
fn gappa_bounds_differences_of_products_in_wider_arithmetic() {
    let falls_back =
        |path: &Path| path.operations.iter().any(|op| matches!(op, Operation::Minor(..)));
    let both = [
        both::<f32>("woop-watertight", "edge", falls_back),
        both::<f64>("woop-watertight", "edge", falls_back),
    ];
    for [theirs, ours] in both.into_iter().flatten() {
        println!("fallback: gappa {theirs:.3} u, hairline {ours:.3} u");
        assert!(theirs < 2.0 * ours);
    }
}
