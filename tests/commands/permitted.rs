//! Results that WGSL permits: examples/c/permitted.hpp, and what kernels answer with them.

use crate::plugin::library;
use crate::program::{ends, hairline_with, scratch};
use crate::tools::has;
use hairline::internals::case::Draw;
use num_rational::BigRational;
use num_traits::{Signed, ToPrimitive};
use serde_json::Value;
use std::cmp::Ordering;
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
fn audited(folder: &Path, kernel: &[&str], more: &[&str], seed: &str) -> Value {
    let words = ["audit", "--scalar", "f32", "-q", "--format", "json"];
    let all = [&words[..], kernel, more].concat();
    let output = hairline_with(folder, &all, &[("PERMITTED_SEED", seed)]);
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

/// Of each class that has wrong cases, which these are.
fn wrong_cases(result: &Value) -> Vec<String> {
    let mut found = Vec::new();
    for source in result["results"].as_array().unwrap() {
        for finding in source["findings"].as_array().unwrap() {
            let parts = [&source["family"], &finding["finding"], &finding["class"]];
            found.push(format!("{parts:?} {}", finding["digest"]));
        }
    }
    found
}

/// The rays at shared edges that hit nothing, of how many.
fn leaks(result: &Value) -> [u64; 2] {
    let cracks = &result["results"][0]["across"]["cracks"];
    ["count", "of"].map(|part| cracks[part].as_u64().expect("cracks"))
}

fn rational(x: f32) -> BigRational {
    BigRational::from_float(x).expect("a finite number")
}

/// The least distance of two floats around a number: a unit in the last place.
fn unit_of(exact: &BigRational) -> BigRational {
    let size = exact.abs();
    let near = size.to_f32().unwrap();
    match rational(near).cmp(&size) {
        Ordering::Less => rational(near.next_up()) - rational(near),
        _ => rational(near) - rational(near.next_down()),
    }
}

/// True if a float is the product, rounded as is permitted, and then the sum.
fn is_of_two_steps([a, b, c]: [f32; 3], result: f32) -> bool {
    let nearest = a * b;
    let products = [nearest.next_down(), nearest, nearest.next_up(), 0.0];
    let exact = rational(a) * rational(b);
    products.into_iter().any(|product| {
        is_around(&exact, product) && is_around(&(rational(product) + rational(c)), result)
    })
}

/// True of one of the two floats around an exact number, and of zero where it is subnormal.
fn is_around(exact: &BigRational, result: f32) -> bool {
    let [below, above] = [result.next_down(), result.next_up()].map(rational);
    let is_flushed = result == 0.0 && exact.abs() < rational(f32::MIN_POSITIVE);
    (below < *exact && *exact < above) || is_flushed
}

/// True if WGSL permits a result where the exact one is known: for sums and products one of the two floats around
/// it, perhaps after zeros in place of subnormal operands; for quotients what is within 2.5 units in the last place.
fn is_permitted(operation: char, [a, b, c]: [f32; 3], result: f32) -> bool {
    let flushed = |x: f32| if x.is_subnormal() { 0.0 } else { x };
    let choices = |x: f32| [x, flushed(x)];
    for (a, b) in choices(a)
        .into_iter()
        .flat_map(|a| choices(b).map(|b| (a, b)))
    {
        let [p, q] = [a, b].map(rational);
        let is_right = match operation {
            '+' => is_around(&(p + q), result),
            '*' => is_around(&(p * q), result),
            '/' => {
                let exact = p / q;
                let is_tiny = exact.abs() < rational(f32::MIN_POSITIVE);
                let off = (rational(result) - &exact).abs();
                let two_and_a_half = BigRational::new(5.into(), 2.into());
                off <= unit_of(&exact) * two_and_a_half || (is_tiny && result == 0.0)
            }
            // Fused, or a product that is permitted and then its sum.
            _ => choices(c).into_iter().any(|c| {
                is_around(&(&p * &q + rational(c)), result) || is_of_two_steps([a, b, c], result)
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
    let exponent = draw.pick(&[0, 0, 1, 100, 120, 127, 130, 244]) + draw.bits() % 8;
    let sign_and_fraction = draw.bits() & 0x807f_ffff;
    f32::from_bits((sign_and_fraction | exponent << 23) as u32)
}

/// The results of the program's own arithmetic.
fn computed(program: &Path, questions: &str, seed: &str) -> Vec<f32> {
    let mut child = Command::new(program)
        .env("PERMITTED_SEED", seed)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    let mut input = child.stdin.take().unwrap();
    let lines = questions.to_owned();
    let writer = std::thread::spawn(move || input.write_all(lines.as_bytes()).unwrap());
    let output = child.wait_with_output().unwrap();
    writer.join().unwrap();
    let answers = String::from_utf8(output.stdout).unwrap();
    let bits = |line: &str| u32::from_str_radix(line, 16).unwrap();
    answers
        .lines()
        .map(|line| f32::from_bits(bits(line)))
        .collect()
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
        let mut numbers = [(); 3].map(|()| number(&mut draw));
        if index % 8 == 2 {
            // A quotient at a power of two, where units are of two sizes.
            numbers[0] = numbers[1];
        }
        if index % 8 == 3 {
            // A sum that cancels shows whether its product was rounded.
            numbers[2] = -(numbers[0] * numbers[1]).clamp(f32::MIN, f32::MAX);
        }
        let [a, b, c] = numbers.map(f32::to_bits);
        lines.push_str(&format!("{operation} {a:x} {b:x} {c:x}\n"));
        questions.push((operation, numbers));
    }
    let answers = computed(&program, &lines, "1");
    assert_eq!(answers.len(), questions.len());
    let (mut nearest, mut other) = ([0; 4], [0; 4]);
    let (mut fused, mut flushed) = (0, 0);
    for (index, ((operation, numbers), result)) in questions.iter().zip(&answers).enumerate() {
        let ([a, b, c], result) = (*numbers, *result);
        let rounded = match operation {
            '+' => a + b,
            '*' => a * b,
            '/' => a / b,
            _ => a.mul_add(b, c),
        };
        let is_nearest = rounded.to_bits() == result.to_bits();
        let counts = if is_nearest { &mut nearest } else { &mut other };
        counts[index % 4] += 1;
        let told = format!("{a:e} {operation} {b:e} ({c:e}) = {result:e}");
        let bounded = f32::MIN_POSITIVE..=2f32.powi(126);
        if *operation == '/' && !bounded.contains(&b.abs()) {
            continue;
        }
        if !result.is_finite() {
            // Beyond the largest float, or past it by the product alone.
            let product = a * b;
            let is_beyond = rounded.abs() >= f32::MAX || product.abs() >= f32::MAX;
            assert!(
                is_beyond && *operation != '+' || rounded.is_infinite(),
                "{told}"
            );
            continue;
        }
        assert!(rounded.is_finite(), "{told}");
        assert!(is_permitted(*operation, *numbers, result), "{told}");
        // Only a fused operation gives these: nothing is flushed on the way.
        let are_normal = [a, b, c, a * b].into_iter().all(f32::is_normal);
        fused += usize::from(*operation == 'f' && are_normal && !is_of_two_steps(*numbers, result));
        flushed += usize::from(result == 0.0 && rounded != 0.0);
    }
    let least = nearest.into_iter().chain(other).min();
    assert!(Some(300) < least, "{nearest:?} {other:?}");
    assert!(100 < fused && 100 < flushed, "{fused} {flushed}");
    let with_another_seed = computed(&program, &lines, "2");
    let differ = answers.iter().zip(&with_another_seed);
    let differ = differ.filter(|(a, b)| a.to_bits() != b.to_bits()).count();
    assert!(5_000 < differ, "{differ}");
}

#[test]
fn a_watertight_test_leaks_where_wgsl_permits_it() {
    let folder = scratch("permitted-woop-audits");
    let Some(woop) = permitted("permitted-woop", &["-DWOOP"]) else {
        return;
    };
    let kernel = ["--kernel-lib", &woop];
    let rays = ["--family", "shared-edge", "-n", "10000"];
    let of = |seed: &str| leaks(&audited(&folder, &kernel, &rays, seed));
    let [as_written, of_how_many] = of("0");
    assert!(as_written == 0 && 4_000 < of_how_many);
    let [one, other] = [of("1"), of("2")].map(|[leaks, _]| leaks);
    assert!(15 < one && 15 < other, "{one} {other}");
}

#[test]
fn rounded_as_ieee_754_it_is_the_kernel_of_hairline() {
    let folder = scratch("permitted-plain-audits");
    let Some(plain) = permitted("permitted-plain", &[]) else {
        return;
    };
    let few = ["-n", "300"];
    let built_in = ["--kernel", "moller-trumbore"];
    let kernel = ["--kernel-lib", &plain];
    let expected = audited(&folder, &built_in, &few, "0");
    let found = audited(&folder, &kernel, &few, "0");
    // The library gives no values that could be wrong.
    let is_verdict = |case: &String| !case.contains("value");
    let [expected_cases, found_cases] = [&expected, &found].map(|result| {
        let cases = wrong_cases(result).into_iter().filter(is_verdict);
        cases.collect::<Vec<_>>()
    });
    assert!(20 < found_cases.len() && found_cases == expected_cases);
    assert!(wrong(&found)[0] < wrong(&audited(&folder, &kernel, &few, "1"))[0]);
}

#[test]
fn a_guarded_kernel_has_no_wrong_answer_seen_and_with_an_eighth_of_its_margins_some() {
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
    let margin = "return factor * size";
    assert!(text.contains(margin));
    let narrow = text.replace(margin, "return 0.125f * factor * size");
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
            let found = audited(&folder, &["--kernel-lib", &library], &["-n", "2000"], "1");
            let count = wrong(&found)[looked_at];
            assert_eq!(count == 0, name == "whole", "{name} {ask}: {count}");
        }
    }
}
