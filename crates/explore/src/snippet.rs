//! A finding as source code to paste into a test.

use super::objective::verdict_and_finding;
use super::signature::Signature;
use super::simplify::odd_and_exponent;
use crate::arith::{Float, ScalarName};
use crate::audit::Row;
use crate::case::{Case, rust_case, rust_list};
use crate::judge::Finding;
use crate::kernel::Scalar;

/// A test in Rust on this library: it passes as long as the kernel shows the finding.
pub fn rust_snippet<F: Scalar>(row: &Row, case: &Case<F>, signature: &Signature) -> String {
    let epsilons: Vec<F> = row.epsilons();
    let (truth, verdict, _) = verdict_and_finding(row, &epsilons, case);
    let scalar = F::NAME;
    let (kernel, finding) = (signature.kernel, signature.finding.name());
    let name =
        format!("{kernel}_{scalar}_{finding}").replace(|c: char| !c.is_ascii_alphanumeric(), "_");
    format!(
        "/// {signature}.
/// Contract: {contract}.
#[test]
fn {name}() {{
    use hairline::{{Case, Scalar, Verdict, find, truth}};
    let case = {literal};
    let kernel = {scalar}::subject(find(\"{kernel}\").unwrap()).unwrap();
    let mut verdict = [Verdict::miss(None)];
    kernel.run(&[case], &{epsilons}, &mut verdict);
    assert_eq!(truth(&case).to_string(), \"{truth}\");
    // {asked}
    assert!({not}verdict[0].hit);
}}
",
        literal = rust_case(case),
        contract = row.contract.describe(),
        epsilons = rust_list(&epsilons),
        asked = asked(signature.finding),
        not = if verdict.hit { "" } else { "!" },
    )
}

/// The numbers in C, as hexadecimal floats, for a test of whatever kernel.
pub fn c_snippet<F: Scalar>(row: &Row, case: &Case<F>, signature: &Signature) -> String {
    let epsilons: Vec<F> = row.epsilons();
    let (truth, ..) = verdict_and_finding(row, &epsilons, case);
    let scalar = match F::NAME {
        ScalarName::F32 => "float",
        ScalarName::F64 => "double",
    };
    let mut text = format!(
        "/* {signature}.\n   Contract: {}.\n   Truth: {truth}. */\n",
        row.contract.describe()
    );
    if !(case.ray.t_min.is_finite() && case.ray.t_max.is_finite()) {
        text.push_str("#include <math.h>\n");
    }
    for (name, vector) in ["origin", "direction", "a", "b", "c"]
        .into_iter()
        .zip(case.vectors())
    {
        let numbers = vector.map(c_number).join(", ");
        text.push_str(&format!(
            "static const {scalar} {name}[3] = {{{numbers}}};\n"
        ));
    }
    let (t_min, t_max) = (c_number(case.ray.t_min), c_number(case.ray.t_max));
    text.push_str(&format!(
        "static const {scalar} t_min = {t_min}, t_max = {t_max};\n"
    ));
    let hit = i32::from(signature.finding != Finding::FalseHit);
    text.push_str(&format!(
        "static const int hit = {hit}; /* {} */\n",
        asked(signature.finding)
    ));
    text
}

fn asked(finding: Finding) -> &'static str {
    match finding {
        Finding::FalseMiss => "The contract asks a hit; the kernel misses.",
        Finding::FalseHit => "The contract asks a miss; the kernel hits.",
        _ => "A hit is right; a value that the kernel reports with it is not.",
    }
}

/// An exact hexadecimal literal: `-0x3p-1f`.
fn c_number<F: Float>(x: F) -> String {
    let sign = if x.is_sign_negative() { "-" } else { "" };
    let suffix = match F::NAME {
        ScalarName::F32 => "f",
        ScalarName::F64 => "",
    };
    match odd_and_exponent(x) {
        Some((digits, exponent)) => format!("{sign}0x{digits:x}p{exponent}{suffix}"),
        None if x.is_zero() => format!("{sign}0x0p0{suffix}"),
        None if x.is_nan() => "NAN".to_owned(),
        None => format!("{sign}INFINITY"),
    }
}
