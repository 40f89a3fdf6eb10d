//! Results that WGSL permits: examples/c/permitted.hpp, and what kernels answer with them.

use crate::plugin::library;
use crate::program::{ends, hairline_with, scratch};
use crate::tools::has;
use hairline::internals::case::Draw;
use num_rational::BigRational;

use serde_json::Value;
use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

const HERE: &str = env!("CARGO_MANIFEST_DIR");

fn source() -> PathBuf {
    Path::new(HERE).join("examples/c/permitted.cpp")
}

/// examples/c/permitted.cpp as a library; none if there is no compiler for C++.
fn permitted(name: &str, flags: &[&str]) -> Option<String> {
    let cpp = ["-xc++", "-std=c++17", "-Wall", "-Wextra", "-Werror"];
    library(&source(), name, &[&cpp[..], flags].concat())
}

/// The result of an audit with a seed.
fn audited(kernel: &[&str], more: &[&str], seed: &str) -> Value {
    let folder = scratch(&format!("permitted-audit-{seed}"));
    let words = ["audit", "--scalar", "f32", "-q", "--format", "json"];
    let all = [&words[..], kernel, more].concat();
    let output = hairline_with(&folder, &all, &[("PERMITTED_SEED", seed)]);
    assert_eq!(output.status.code(), Some(0), "{output:?}");
    let record: Value = serde_json::from_slice(&output.stdout).unwrap();
    record["result"].clone()
}

/// The false misses and the false hits of all sources.
fn wrong(result: &Value) -> [u64; 2] {
    let totals = result["results"].as_array().unwrap();
    ["false_misses", "false_hits"].map(|finding| {
        let counts = totals.iter().map(|it| &it["total"][finding]["count"]);
        counts.map(|count| count.as_u64().unwrap()).sum()
    })
}

/// The rays at shared edges that hit nothing, of how many.
fn leaks(result: &Value) -> [u64; 2] {
    let cracks = &result["results"][0]["across"]["cracks"];
    ["count", "of"].map(|part| cracks[part].as_u64().expect("cracks"))
}

fn rational(x: f32) -> BigRational {
    BigRational::from_float(x).expect("a finite number")
}

/// True if WGSL permits a result where the exact one is known: for sums and products one of the two floats around
/// it, perhaps after zeros in place of subnormal operands; for quotients what is within 2.5 units in the last place.
fn is_permitted(operation: char, [a, b, c]: [f32; 3], result: f32) -> bool {
    let flushed = |x: f32| if x.is_subnormal() { 0.0 } else { x };
    let around = |exact: &BigRational, result: f32| {
        let [below, above] = [result.next_down(), result.next_up()].map(rational);
        let is_beside = below < *exact && *exact < above;
        let smallest = rational(f32::MIN_POSITIVE);
        let is_flushed = result == 0.0 && -&smallest < *exact && *exact < smallest;
        is_beside || is_flushed
    };
    let choices = |x: f32| [x, flushed(x)];
    for (a, b) in choices(a)
        .into_iter()
        .flat_map(|a| choices(b).map(|b| (a, b)))
    {
        let [p, q] = [a, b].map(rational);
        let is_right = match operation {
            '+' => around(&(p + q), result),
            '*' => around(&(p * q), result),
            '/' => {
                let exact = p / q;
                // The distance of floats at the result.
                let unit = rational(result.abs().next_up()) - rational(result.abs());
                let two_and_a_half = BigRational::new(5.into(), 2.into());
                let off = rational(result) - &exact;
                let is_flushed = result == 0.0 && !around(&exact, f32::MIN_POSITIVE);
                let limit = unit * two_and_a_half;
                (-&limit <= off && off <= limit) || is_flushed
            }
            // Fused, or a product that is permitted and then its sum.
            _ => choices(c).into_iter().any(|c| {
                let exact = &p * &q;
                let nearest = a * b;
                let products = [nearest.next_down(), nearest, nearest.next_up(), 0.0];
                around(&(exact.clone() + rational(c)), result)
                    || products.into_iter().any(|product| {
                        around(&exact, product)
                            && around(&(rational(product) + rational(c)), result)
                    })
            }),
        };
        if is_right {
            return true;
        }
    }
    false
}

/// A number that is subnormal, small, or of a size at which sums round.
fn number(draw: &mut Draw) -> f32 {
    let exponent = draw.pick(&[0, 1, 100, 120, 127, 130]) + draw.bits() % 8;
    let sign_and_fraction = draw.bits() & 0x807f_ffff;
    f32::from_bits((sign_and_fraction | exponent << 23) as u32)
}

#[test]
fn each_result_is_one_that_is_permitted_and_all_kinds_occur() {
    let folder = scratch("permitted-results");
    if !has("c++") {
        return;
    }
    let program = folder.join("check");
    let built = Command::new("c++")
        .args(["-std=c++17", "-O1", "-ffp-contract=off", "-DCHECK"])
        .arg(format!("-I{HERE}/include"))
        .arg("-o")
        .args([&program, &source()])
        .status();
    assert!(built.unwrap().success());
    let mut questions = Vec::new();
    let mut lines = String::new();
    for index in 0..20_000 {
        let mut draw = Draw::new("permitted", 1, index);
        let operation = ['+', '*', '/', 'f'][index as usize % 4];
        let numbers = [(); 3].map(|()| number(&mut draw));
        let [a, b, c] = numbers.map(f32::to_bits);
        lines.push_str(&format!("{operation} {a:x} {b:x} {c:x}\n"));
        questions.push((operation, numbers));
    }
    let mut child = Command::new(&program)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    let mut input = child.stdin.take().unwrap();
    let writer = std::thread::spawn(move || input.write_all(lines.as_bytes()).unwrap());
    let output = child.wait_with_output().unwrap();
    writer.join().unwrap();
    let answers = String::from_utf8(output.stdout).unwrap();
    let answers: Vec<f32> = answers
        .lines()
        .map(|line| f32::from_bits(u32::from_str_radix(line, 16).unwrap()))
        .collect();
    assert_eq!(answers.len(), questions.len());
    let (mut nearest, mut other) = ([0; 4], [0; 4]);
    for (index, ((operation, numbers), result)) in questions.into_iter().zip(answers).enumerate() {
        let [a, b, c] = numbers;
        let rounded = match operation {
            '+' => a + b,
            '*' => a * b,
            '/' => a / b,
            _ => a.mul_add(b, c),
        };
        let is_nearest = rounded.to_bits() == result.to_bits();
        let counts = if is_nearest { &mut nearest } else { &mut other };
        counts[index % 4] += 1;
        // An infinite result has no neighbours; nothing else is said of it here but that it is near.
        if !rounded.is_finite() || !result.is_finite() || (operation == '/' && !b.is_normal()) {
            continue;
        }
        let told = format!("{a:e} {operation} {b:e} ({c:e}) = {result:e}");
        assert!(is_permitted(operation, numbers, result), "{told}");
    }
    let least = nearest.into_iter().chain(other).min();
    assert!(Some(500) < least, "{nearest:?} {other:?}");
}

#[test]
fn a_watertight_test_leaks_where_wgsl_permits_it() {
    let Some(woop) = permitted("permitted-woop", &["-DWOOP"]) else {
        return;
    };
    let kernel = ["--kernel-lib", &woop];
    let rays = ["--family", "shared-edge", "-n", "10000"];
    let of = |seed: &str| leaks(&audited(&kernel, &rays, seed));
    let [as_written, of_how_many] = of("0");
    assert!(as_written == 0 && 4_000 < of_how_many);
    for seed in ["1", "2"] {
        assert!(10 < of(seed)[0], "{seed}: {:?}", of(seed));
    }
}

#[test]
fn rounded_as_ieee_754_it_is_the_kernel_of_hairline() {
    let Some(plain) = permitted("permitted-plain", &[]) else {
        return;
    };
    let few = ["-n", "300"];
    let built_in = ["--kernel", "moller-trumbore"];
    let kernel = ["--kernel-lib", &plain];
    let expected = wrong(&audited(&built_in, &few, "0"));
    assert_eq!(wrong(&audited(&kernel, &few, "0")), expected);
    assert!(expected[0] < wrong(&audited(&kernel, &few, "1"))[0]);
}

#[test]
fn a_guarded_kernel_has_no_wrong_answer_seen_and_with_a_fourth_of_its_margins_many() {
    let folder = scratch("permitted-guarded");
    let words = [
        "repair",
        "--kernel",
        "moller-trumbore",
        "--scalar",
        "f32",
        "--emit",
        "c",
        "-q",
    ];
    let (text, _) = ends(&folder, &words, 0);
    let margin = "const float margin = factor * size";
    assert!(text.contains(margin));
    let narrow = text.replace(margin, "const float margin = 0.25f * factor * size");
    for (name, text) in [("whole", &text), ("narrow", &narrow)] {
        let header = folder.join(format!("{name}.h"));
        fs::write(&header, text).unwrap();
        let guarded = format!("-DGUARDED=\"{}\"", header.display());
        // Where it asks, the answer is taken to be the one that is not looked at.
        for (ask, looked_at) in [("1", 0), ("0", 1)] {
            let as_ask = format!("-DASK={ask}");
            let flags = [&guarded, "-DTEST=moller_trumbore_f32", &as_ask];
            let Some(library) = permitted(&format!("permitted-{name}-{ask}"), &flags) else {
                return;
            };
            let found = audited(&["--kernel-lib", &library], &["-n", "1000"], "1");
            let count = wrong(&found)[looked_at];
            assert_eq!(count == 0, name == "whole", "{name} {ask}: {count}");
        }
    }
}
