//! `hairline repair`: kernels that say hit, miss or ask, held to integers of any length and to hairline's own run of them.

use crate::program::{ends, scratch};
use crate::tools::has;
use hairline::internals::case::{Case, Parameters};
use hairline::internals::family::FAMILIES;
use hairline::internals::kernel::{Scalar, find};
use hairline::internals::prove::repair::{Answer, Answered, Guarded};
use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

const HERE: &str = env!("CARGO_MANIFEST_DIR");

const STRICT: [&str; 6] = [
    "-Wall",
    "-Wextra",
    "-Werror",
    "-Wconversion",
    "-fsanitize=address,undefined",
    "-fno-sanitize-recover=all",
];

/// Writes a kernel in C; its file.
pub fn emitted(folder: &Path, kernel: &str, scalar: &str) -> PathBuf {
    emitted_in("c", folder, kernel, scalar)
}

/// The same in another language that C compilers read.
pub fn emitted_in(language: &str, folder: &Path, kernel: &str, scalar: &str) -> PathBuf {
    let file = folder.join(format!("{}_{scalar}.h", kernel.replace('-', "_")));
    let all = [
        "repair",
        "--kernel",
        kernel,
        "--scalar",
        scalar,
        "--emit",
        language,
        "-o",
        file.to_str().unwrap(),
    ];
    ends(folder, &all, 0);
    file
}

/// Compiles a program; the compiler's words are the test's if it refuses.
fn compile(source: &Path, output: &Path, flags: &[&str]) {
    compile_by("cc", source, output, flags);
}

/// The same by another compiler.
pub fn compile_by(compiler: &str, source: &Path, output: &Path, flags: &[&str]) {
    let built = Command::new(compiler)
        .arg("-o")
        .arg(output)
        .args(flags)
        .arg(source)
        .arg("-lm")
        .output()
        .unwrap();
    assert!(
        built.status.success(),
        "{flags:?}: {}",
        String::from_utf8_lossy(&built.stderr)
    );
}

/// The adversarial rays against what a file has: hits, misses, asks and wrong answers.
pub fn tried(folder: &Path, file: &Path, promise: [&str; 2], flags: &[&str]) -> [u64; 4] {
    let kernel = file.file_stem().unwrap().to_str().unwrap();
    let double = usize::from(kernel.ends_with("f64"));
    let defines = [format!("-DKERNEL={kernel}"), format!("-DDOUBLE={double}")];
    let defines: Vec<&str> = defines.iter().map(String::as_str).chain(promise).collect();
    let include = ["-include", file.to_str().unwrap(), "-pthread"];
    let program = folder.join("check");
    compile(
        &Path::new(HERE).join("tests/repair/check.c"),
        &program,
        &[&include, &defines[..], flags].concat(),
    );
    let run = Command::new(&program)
        .args(["2", "100000", "7"])
        .output()
        .unwrap();
    let text = String::from_utf8(run.stdout).unwrap();
    let all = text.lines().last().unwrap().strip_prefix("all").unwrap();
    let counts: Vec<u64> = all
        .split_whitespace()
        .map(|word| word.parse().unwrap())
        .collect();
    assert_eq!(run.status.success(), counts[3] == 0, "{text}");
    counts.try_into().unwrap()
}

pub const LINE: [&str; 2] = ["-DEXTENT=0", "-DFRONT=0"];
pub const INTERVAL: [&str; 2] = ["-DEXTENT=2", "-DFRONT=0"];

#[test]
fn no_answer_is_wrong_however_it_is_compiled_and_without_margins_many_are() {
    if !has("cc") {
        return;
    }
    let folder = scratch("repair-check");
    let fast = ["-O3", "-march=native", "-ffp-contract=fast"];
    for (kernel, promise) in [
        ("moller-trumbore", LINE),
        ("woop-watertight", INTERVAL),
        ("havel-herout", INTERVAL),
    ] {
        for scalar in ["f32", "f64"] {
            let file = emitted(&folder, kernel, scalar);
            for flags in [&["-O1"][..], &fast] {
                let [hits, misses, asks, wrong] = tried(&folder, &file, promise, flags);
                assert_eq!(wrong, 0, "{kernel} {scalar} {flags:?}");
                assert!(
                    5_000 < hits && 30_000 < misses && 10_000 < asks,
                    "{hits} {misses} {asks}"
                );
            }
        }
    }
    for (kernel, promise) in [("moller-trumbore", LINE), ("woop-watertight", INTERVAL)] {
        let file = emitted(&folder, kernel, "f32");
        let text = fs::read_to_string(&file).unwrap();
        // A fiftieth of each margin is not enough.
        let weaker = text.replace("return factor * size", "return 0.02f * factor * size");
        assert_ne!(text, weaker);
        fs::write(&file, weaker).unwrap();
        let [.., wrong] = tried(&folder, &file, promise, &["-O1"]);
        assert!(10 < wrong, "{wrong}");
    }
}

/// A program that reads cases and writes answers.
const ANSWERS: &str = r"
#include <stdio.h>
#include <string.h>
int main(void) {
    REAL x[17], values[3];
    while (fread(x, sizeof x, 1, stdin) == 1) {
        HIT hit;
        memset(&hit, 0, sizeof hit);
        int answer = KERNEL(x, x + 3, x + 6, x + 9, x + 12, x[15], x[16], &hit);
        values[0] = (REAL)answer, values[1] = hit.u, values[2] = hit.v;
        fwrite(values, sizeof values, 1, stdout);
    }
    return 0;
}
";

/// The answers of hairline's own run, as the program writes them.
fn own<F: Scalar + Answered>(guarded: &Guarded, cases: &[Case<F>]) -> Vec<[f64; 3]> {
    let ready = guarded.ready::<F>();
    let answer = |case| match F::answer(&ready, case) {
        Answer::Miss => [0.0; 3],
        Answer::Ask => [2.0, 0.0, 0.0],
        Answer::Hit([_, u, v]) => [1.0, u.unwrap().to_f64(), v.unwrap().to_f64()],
    };
    cases.iter().map(answer).collect()
}

fn is_alike<F: Scalar + Answered>(
    kernel: &str,
    bytes: impl Fn(F) -> Vec<u8>,
    numbers: impl Fn(&[u8]) -> Vec<f64>,
) {
    let folder = scratch(&format!("repair-bits-{kernel}-{}", F::NAME));
    let file = emitted(&folder, kernel, F::NAME.name());
    let name = file.file_stem().unwrap().to_str().unwrap();
    let (real, source, program) = (
        if F::DIGITS == 24 { "float" } else { "double" },
        folder.join("answers.c"),
        folder.join("answers"),
    );
    fs::write(&source, ANSWERS).unwrap();
    let defines = [
        format!("-DKERNEL={name}"),
        format!("-DHIT={name}_hit"),
        format!("-DREAL={real}"),
    ];
    // The exact test that decides where it asks is compiled too.
    let include = format!("-I{HERE}/include");
    let exact = ["-DHAIRLINE_ASK_EXACT", include.as_str()];
    let defines: Vec<&str> = defines.iter().map(String::as_str).chain(exact).collect();
    let c = [
        "-std=c99",
        "-pedantic",
        "-O2",
        "-ffp-contract=off",
        "-include",
        file.to_str().unwrap(),
    ];
    compile(&source, &program, &[&STRICT[..], &c, &defines].concat());
    // C++17 as well.
    let cpp = [
        "-xc++",
        "-std=c++17",
        "-O2",
        "-include",
        file.to_str().unwrap(),
    ];
    compile(
        &source,
        &folder.join("answers-cpp"),
        &[&STRICT[..5], &cpp, &defines].concat(),
    );
    let each: u64 =
        std::env::var("HAIRLINE_REPAIR_CASES").map_or(300, |count| count.parse().unwrap());
    let cases: Vec<Case<F>> = FAMILIES
        .iter()
        .flat_map(|family| {
            (0..each).flat_map(|i| {
                family
                    .make::<F>(&Parameters::default(), 5, i)
                    .cases()
                    .to_vec()
            })
        })
        .collect();
    let mut input = Vec::new();
    for case in &cases {
        let ends = [case.ray.t_min, case.ray.t_max];
        case.vectors()
            .iter()
            .flatten()
            .chain(&ends)
            .for_each(|x| input.extend(bytes(*x)));
    }
    let mut child = Command::new(&program)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    let mut pipe = child.stdin.take().unwrap();
    let writer = std::thread::spawn(move || pipe.write_all(&input).unwrap());
    let output = child.wait_with_output().unwrap();
    writer.join().unwrap();
    assert!(output.status.success());
    let found: Vec<f64> = numbers(&output.stdout);
    let guarded = Guarded::new::<F>(find(kernel).unwrap()).unwrap();
    let (mut hits, mut asks) = (0, 0);
    for ((case, right), found) in cases.iter().zip(own(&guarded, &cases)).zip(found.chunks(3)) {
        let bits = |x: &f64| if x.is_nan() { u64::MAX } else { x.to_bits() };
        assert!(
            right.iter().map(bits).eq(found.iter().map(bits)),
            "{right:?} {found:?} {}",
            case.hex()
        );
        hits += usize::from(right[0] == 1.0);
        asks += usize::from(right[0] == 2.0);
    }
    assert!(
        found.len() == 3 * cases.len() && cases.len() / 20 < hits && cases.len() / 20 < asks,
        "{hits} {asks}"
    );
}

#[test]
fn the_c_answers_bit_for_bit_what_the_recorded_program_does() {
    if !has("cc") {
        return;
    }
    // Chains of gates with one side and with several, of one margin and of the largest of some, and gates that are none.
    for kernel in [
        "moller-trumbore",
        "woop-watertight",
        "baldwin-weber",
        "scalar-triple-two-sided",
        "havel-herout",
    ] {
        is_alike::<f32>(
            kernel,
            |x| x.to_ne_bytes().to_vec(),
            |bytes| {
                bytes
                    .chunks(4)
                    .map(|x| f32::from_ne_bytes(x.try_into().unwrap()).into())
                    .collect()
            },
        );
        is_alike::<f64>(
            kernel,
            |x| x.to_ne_bytes().to_vec(),
            |bytes| {
                bytes
                    .chunks(8)
                    .map(|x| f64::from_ne_bytes(x.try_into().unwrap()))
                    .collect()
            },
        );
    }
}

#[test]
fn a_certificate_is_checked_and_a_changed_one_is_refused() {
    let folder = scratch("repair-proof");
    let all = [
        "repair",
        "--kernel",
        "plucker",
        "--certificate",
        "proof.txt",
    ];
    ends(&folder, &all, 0);
    let check = ["prove", "--check", "proof.txt"];
    let (said, _) = ends(&folder, &check, 0);
    let right = "proof.txt: every hit and every miss of the guarded plucker f32 is right: 8 margins were computed again, ";
    assert!(said.starts_with(right), "{said}");
    let path = folder.join("proof.txt");
    let text = fs::read_to_string(&path).unwrap();
    let refused = |from: &str, to: &str, words: &str| {
        assert!(text.contains(from), "{from}: {text}");
        fs::write(&path, text.replacen(from, to, 1)).unwrap();
        let (_, error) = ends(&folder, &check, 65);
        assert!(error.contains(words), "{words}: {error}");
    };
    // One rounding less, another sign, a gate that is left out, another promise.
    let margin = text
        .lines()
        .find(|line| line.starts_with("margin ") && !line.ends_with(" 0 0"))
        .unwrap();
    let fewer = format!("{}1", margin);
    refused(margin, &fewer, "expected `");
    let hit = text.lines().find(|line| line.starts_with("hit +")).unwrap();
    refused(
        hit,
        &hit.replacen('+', "-", 1),
        "its gates accept rays that",
    );
    let miss = text.lines().find(|line| line.starts_with("miss ")).unwrap();
    refused(
        miss,
        &miss[..miss.rfind(' ').unwrap()],
        "gate 'edge' rejects rays that may hit",
    );
    refused(
        "guarded interval both",
        "guarded interval front",
        "hit the back",
    );
    // The proof of another program is right, and not about this kernel.
    fs::write(&path, text.replacen("gate edge", "gate side", 1)).unwrap();
    let (_, error) = ends(&folder, &check, 1);
    assert!(
        error.contains("plucker is repaired in another way here"),
        "{error}"
    );
}

/// The checker knows a number by its values modulo 2^61 - 1. So what is added is a multiple of that: nothing there, and much
/// everywhere else.
#[test]
fn a_number_that_is_another_only_modulo_the_prime_is_refused() {
    let folder = scratch("repair-forged");
    ends(
        &folder,
        &[
            "repair",
            "--kernel",
            "moller-trumbore-t",
            "--certificate",
            "proof.txt",
        ],
        0,
    );
    let path = folder.join("proof.txt");
    let text = fs::read_to_string(&path).unwrap();
    let (head, margins) = text.split_once("margin ").unwrap();
    let last = head.lines().filter(|line| line.starts_with("op ")).count();
    let weight = text
        .split_once("hit +")
        .and_then(|(_, rest)| rest.split_once("hit +"))
        .unwrap()
        .1;
    let (determinant, weight) = weight.lines().next().unwrap().split_once('*').unwrap();
    let place = |i: usize| last + i;
    let operations = [
        "number 1048576".to_owned(),
        "number 2097152".to_owned(),
        format!("mul {} {}", place(0), place(0)),
        format!("mul {} {}", place(2), place(1)),
        "number 1".to_owned(),
        format!("sub {} {}", place(3), place(4)),
        format!("mul {} 0", place(5)),
        format!("add {weight} {}", place(6)),
    ];
    let operations = operations.iter().enumerate();
    let operations: String = operations
        .map(|(i, words)| format!("op {} {words}\n", place(i)))
        .collect();
    let (sum, old) = (place(7), format!("{determinant}*{weight}\n"));
    let forged = |margin: &str| {
        let margins = margins.replace(&old, &format!("{determinant}*{sum}\n"));
        let gates = margins.find("gate ").unwrap();
        let (margins, gates) = margins.split_at(gates);
        let all = format!("{head}{operations}margin {margins}margin {sum} {margin}\n{gates}");
        fs::write(&path, all).unwrap();
        ends(&folder, &["prove", "--check", "proof.txt"], 65).1
    };
    let error = forged("0 0");
    let right = error
        .split_once("expected `")
        .unwrap_or_else(|| panic!("{error}"))
        .1;
    let error = forged(right.split('`').next().unwrap());
    assert!(
        error.contains("gate 'edge' rejects rays that may hit"),
        "{error}"
    );
}

#[test]
fn what_cannot_be_repaired_is_refused_with_the_reason() {
    let folder = scratch("repair-refused");
    let refused = |all: &[&str], code: i32, words: &str| {
        let (out, error) = ends(&folder, &[&["repair"], all].concat(), code);
        assert!(out.is_empty() && error.contains(words), "{words}: {error}");
    };
    refused(
        &["--kernel", "half-space", "--emit", "c"],
        4,
        "its gates accept rays that meet the triangle at t <= 0",
    );
    refused(
        &["--kernel", "moller-trumbore+fma", "--emit", "c"],
        4,
        "name the kernel without what stands behind +",
    );
    refused(&["--emit", "c"], 2, "repair is of one --kernel");
    refused(
        &["--kernel", "plucker", "--scalar", "f32,f64", "--emit", "c"],
        2,
        "two scalars are two files",
    );
    refused(
        &["--kernel", "plucker", "--scalar", "f64", "--emit", "wgsl"],
        2,
        "WGSL has no f64",
    );
    refused(&["--kernel", "pluckre"], 2, "unknown kernel 'pluckre'");
    refused(&["--kernel", "plucker", "--emit", "java"], 2, "java");
}

#[test]
fn what_is_named_next_can_be_written() {
    let folder = scratch("repair-next");
    for (kernel, plain) in [
        ("moller-trumbore+fma", Some("moller-trumbore")),
        ("moller-trumbore", Some("moller-trumbore")),
        ("half-space", None),
    ] {
        let all = [
            "repair", "--kernel", kernel, "--scalar", "f32", "-n", "20", "-q",
        ];
        let (text, _) = ends(&folder, &all, 0);
        let command = text.lines().find(|line| line.contains("--emit c"));
        let expected = plain.map(|plain| format!("hairline repair --kernel {plain} --emit c"));
        let found = command.map(|line| line.trim_start_matches("next:").trim().to_owned());
        assert_eq!(found, expected, "{kernel}: {text}");
    }
}

#[test]
fn the_kernel_of_the_bench_is_the_one_that_is_written() {
    let folder = scratch("repair-bench");
    let (text, _) = ends(
        &folder,
        &["repair", "--kernel", "moller-trumbore", "--emit", "rust"],
        0,
    );
    assert_eq!(
        text,
        fs::read_to_string(Path::new(HERE).join("benches/audit/repaired.rs")).unwrap()
    );
}

#[test]
fn plain_rays_of_a_room_seldom_ask() {
    let folder = scratch("repair-asks");
    let all = [
        "repair",
        "--kernel",
        "moller-trumbore",
        "--scene",
        "room",
        "-n",
        "2000",
    ];
    let (text, _) = ends(&folder, &all, 0);
    let (_, text) = text.split_once("How often the guarded").unwrap();
    let share = |kind: &str| -> f64 {
        let line = text
            .lines()
            .find(|line| line.trim_start().starts_with(kind))
            .expect(kind);
        let mut numbers = line.split_whitespace().filter_map(|word| word.parse().ok());
        numbers.next_back().unwrap()
    };
    assert!(
        share("interior") <= 1.0 && share("outside") <= 1.0,
        "{text}"
    );
    assert!(20.0 < share("edges"), "{text}");
}
