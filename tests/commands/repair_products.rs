//! Guarded kernels whose inputs are products of their caller: compilers that inline fuse such a product into a sum where they may.

use crate::program::{ends, scratch};
use crate::repair::{INTERVAL, LINE, compile_by, emitted, emitted_in};
use crate::tools::{has, not_tested};
use std::fs;
use std::path::Path;
use std::process::Command;

const HERE: &str = env!("CARGO_MANIFEST_DIR");

/// The barrier left out.
const OPEN: &str = "-DHAIRLINE_BARRIER(type,x)=(void)0";

/// The wrong hits and the wrong misses among 200,000 rays of tests/repair/products.c.
fn wrong(compiler: &str, file: &Path, promise: [&str; 2], flags: &[&str]) -> [u64; 2] {
    run(&built(compiler, file, promise, flags)).unwrap()
}

/// The program of a kernel.
fn built(compiler: &str, file: &Path, promise: [&str; 2], flags: &[&str]) -> std::path::PathBuf {
    let kernel = file.file_stem().unwrap().to_str().unwrap();
    let double = usize::from(kernel.ends_with("f64"));
    let defines = [format!("-DKERNEL={kernel}"), format!("-DDOUBLE={double}")];
    let defines: Vec<&str> = defines.iter().map(String::as_str).chain(promise).collect();
    let include = ["-include", file.to_str().unwrap()];
    let program = file.with_extension("products");
    let source = Path::new(HERE).join("tests/repair/products.c");
    compile_by(
        compiler,
        &source,
        &program,
        &[flags, &include, &defines].concat(),
    );
    program
}

/// What the program counts; nothing without the device that it needs.
fn run(program: &Path) -> Option<[u64; 2]> {
    let output = Command::new(program)
        .args(["200000", "3"])
        .output()
        .unwrap();
    if output.status.code() == Some(77) {
        return None;
    }
    let text = String::from_utf8(output.stdout).unwrap();
    let numbers: Vec<u64> = text
        .split_whitespace()
        .filter_map(|word| word.parse().ok())
        .collect();
    let [hits, misses, asks, wrong_hits, wrong_misses] = numbers[..] else {
        panic!("{text}{}", String::from_utf8_lossy(&output.stderr))
    };
    assert_eq!(hits + misses + asks, 200_000, "{text}");
    assert!(150_000 < hits && 500 < misses, "{text}");
    Some([wrong_hits, wrong_misses])
}

/// True if this machine fuses products.
fn fuses() -> bool {
    #[cfg(target_arch = "x86_64")]
    return std::arch::is_x86_feature_detected!("fma");
    #[cfg(not(target_arch = "x86_64"))]
    false
}

#[test]
fn no_product_of_a_caller_is_fused_into_a_kernel_in_c_and_cpp() {
    if !fuses() {
        not_tested("this processor fuses no products");
        return;
    }
    let folder = scratch("repair-products");
    let single = emitted(&folder, "moller-trumbore", "f32");
    let double = emitted(&folder, "moller-trumbore", "f64");
    let plucker = emitted(&folder, "plucker", "f32");
    let files = [(&single, LINE), (&double, LINE), (&plucker, INTERVAL)];
    // Clang fuses within an expression only, unless it is told to.
    let gcc = [&["-O2", "-mfma"][..], &["-O3", "-march=native"]];
    let clang = [
        &["-O2", "-mfma"][..],
        &["-O3", "-march=native", "-ffp-contract=fast"],
    ];
    for (compiler, all) in [("gcc", gcc), ("clang", clang)] {
        if !has(compiler) {
            continue;
        }
        for flags in all {
            for (file, promise) in files {
                assert_eq!(
                    wrong(compiler, file, promise, flags),
                    [0; 2],
                    "{file:?} {flags:?}"
                );
            }
            let cpp = [flags, &["-xc++", "-std=c++17"]].concat();
            assert_eq!(
                wrong(compiler, &single, LINE, &cpp),
                [0; 2],
                "{compiler} {cpp:?}"
            );
        }
        // Without the barrier such a product is fused, and hundreds of answers are wrong.
        for (file, promise) in files {
            let flags = [all[1], &[OPEN]].concat();
            let [hits, misses] = wrong(compiler, file, promise, &flags);
            assert!(
                100 < hits && 100 < misses,
                "{compiler} {file:?}: {hits} {misses}"
            );
        }
    }
    if has("gcc") {
        let [hits, misses] = wrong("gcc", &single, LINE, &["-O2", "-mfma", OPEN]);
        assert!(1_000 < hits && 300 < misses, "{hits} {misses}");
        // Compilers without such assembly copy through memory.
        let other = ["-O2", "-mfma", "-U__SSE2__"];
        assert_eq!(wrong("gcc", &single, LINE, &other), [0; 2]);
    }
}

/// The sums and differences of which an input is a term.
fn inputs_in_sums(text: &str) -> Vec<String> {
    let words: Vec<&str> = text.split_whitespace().collect();
    let is_sum = |i: &usize| ["+", "-"].contains(&words[*i]);
    let sums = (2..words.len() - 2).filter(is_sum);
    let has_input = |i: &usize| {
        let [left, right] = [words[i - 1], words[i + 1]];
        // A factor is no term, unless its bracket begins or ends with it; and no input is a whole bracket.
        let is_left = match brackets(left) {
            0 => words[i - 2] != "*",
            closed => closed < 0,
        };
        let is_right = match brackets(right) {
            0 => words[i + 2] != "*",
            closed => 0 < closed,
        };
        (is_left && is_input(left)) || (is_right && is_input(right))
    };
    sums.filter(has_input)
        .map(|i| words[i - 1..i + 2].join(" "))
        .collect()
}

/// How many brackets more close than open.
fn brackets(word: &str) -> i32 {
    let count = |bracket| word.matches(bracket).count() as i32;
    count(')') - count('(')
}

fn is_input(word: &str) -> bool {
    let word = word
        .trim_start_matches(['(', '-'])
        .trim_end_matches([')', ',', ';']);
    let word = word.strip_prefix("fabsf(").unwrap_or(word);
    let is_coordinate = word.len() == 4 && word.ends_with(']') && word[1..].starts_with('[');
    is_coordinate || ["t_from", "t_to", "t_min", "t_max"].contains(&word)
}

#[test]
fn every_sum_of_an_input_is_a_function() {
    let folder = scratch("repair-sums");
    for kernel in [
        "moller-trumbore",
        "woop-watertight",
        "baldwin-weber",
        "plane-unit-normal",
    ] {
        let text = fs::read_to_string(emitted(&folder, kernel, "f32")).unwrap();
        let (_, code) = text.split_once("*answer) {").unwrap();
        assert!(code.contains("hairline_difference_f32("), "{code}");
        assert_eq!(inputs_in_sums(code), Vec::<String>::new(), "{kernel}");
    }
    // The exact test has the same functions, and the same rule.
    let text = fs::read_to_string(emitted(&folder, "moller-trumbore", "f64")).unwrap();
    let (_, functions) = text.split_once("/* CUDA compiles").unwrap();
    let (functions, _) = functions.split_once("#ifndef HAIRLINE_SURE_F64").unwrap();
    let exact = fs::read_to_string(Path::new(HERE).join("include/hairline_exact.h")).unwrap();
    assert!(exact.contains(functions.trim_end()), "{functions}");
    let differences = exact.matches("hairline_difference_f64(points[").count();
    assert!(
        differences == 4 && !exact.contains("] - points["),
        "{differences}"
    );
    let plain =
        "x = b[0] - a[0]; y = fabsf(d[2]) + SLACK, z = (n - t_from) * q; w = p - -(a[0] * q) + r;";
    let found = ["b[0] - a[0];", "fabsf(d[2]) + SLACK,", "(n - t_from)"];
    assert_eq!(inputs_in_sums(plain), found);
}

/// The inputs of the C program, scaled and asked about in Rust.
const CALLER: &str = r#"
#[path = "kernel.rs"]
mod kernel;
#[no_mangle]
pub unsafe extern "C" fn scaled_in_rust(all: *const [f32; 19]) -> i32 {
    let x = &*all;
    let [of_ray, of_triangle] = [x[17], x[18]];
    let point = |i: usize, factor: f32| [x[i] * factor, x[i + 1] * factor, x[i + 2] * factor];
    let [o, d] = [0, 3].map(|i| point(i, of_ray));
    let [a, b, c] = [6, 9, 12].map(|i| point(i, of_triangle));
    match kernel::moller_trumbore_f32(o, d, a, b, c) {
        kernel::Answer::Miss => 0,
        kernel::Answer::Hit { .. } => 1,
        kernel::Answer::Ask => 2,
    }
}
"#;

#[test]
fn rust_fuses_no_product_unless_its_back_end_is_told_to() {
    if !has("cc") || !fuses() {
        return;
    }
    let folder = scratch("repair-products-rust");
    let header = emitted(&folder, "moller-trumbore", "f32");
    let all = [
        "repair",
        "--kernel",
        "moller-trumbore",
        "--emit",
        "rust",
        "-o",
        "kernel.rs",
    ];
    ends(&folder, &all, 0);
    let (source, object) = (folder.join("caller.rs"), folder.join("libcaller.so"));
    fs::write(&source, CALLER).unwrap();
    let answers = |flags: &[&str]| {
        let crate_type = ["--edition", "2021", "--crate-type", "cdylib", "-O"];
        let mut rustc = Command::new("rustc");
        rustc
            .args(crate_type)
            .args(["-C", "target-cpu=native"])
            .args(flags);
        let built = rustc.arg("-o").args([&object, &source]).output().unwrap();
        assert!(
            built.status.success(),
            "{}",
            String::from_utf8_lossy(&built.stderr)
        );
        let path = format!("-Wl,-rpath,{}", folder.display());
        let flags = [
            "-O1",
            "-DSCALED_KERNEL=scaled_in_rust",
            "-Wl,--no-as-needed",
            &path,
        ];
        wrong(
            "cc",
            &header,
            LINE,
            &[&flags[..], &[object.to_str().unwrap()]].concat(),
        )
    };
    assert_eq!(answers(&[]), [0; 2]);
    let [hits, misses] = answers(&["-C", "llvm-args=-fp-contract=fast"]);
    assert!(1_000 < hits && 100 < misses, "{hits} {misses}");
}

/// A caller of a kernel on both sides, and CUDA's words where there is no CUDA.
const CUDA: &str = r"
#ifdef __CUDA_ARCH__
static inline float __fadd_rn(float x, float y) { return x + y; }
static inline float __fsub_rn(float x, float y) { return x - y; }
static inline double __dadd_rn(double x, double y) { return x + y; }
static inline double __dsub_rn(double x, double y) { return x - y; }
static inline double __dmul_rn(double x, double y) { return x * y; }
#endif
#define HAIRLINE_ASK_EXACT
#include HEADER
int main() {
    const float o[3] = {0.25f, 0.25f, 1}, d[3] = {0, 0, -1}, a[3] = {0, 0, 0}, b[3] = {1, 0, 0}, c[3] = {0, 1, 0};
    moller_trumbore_f32_hit hit;
    const int found = moller_trumbore_f32(o, d, a, b, c, 0, HUGE_VALF, &hit);
    return found == HAIRLINE_HIT && hit.t == 1 && moller_trumbore_f32_exact(o, d, a, b, c, 0, 2, &hit) == 1 ? 0 : 1;
}
";

#[test]
fn cuda_calls_the_functions_on_both_sides() {
    if !has("cc") {
        return;
    }
    let folder = scratch("repair-cuda");
    let file = emitted_in("cuda", &folder, "moller-trumbore", "f32");
    let text = fs::read_to_string(&file).unwrap();
    let c = fs::read_to_string(emitted(&folder, "moller-trumbore", "f32")).unwrap();
    assert_eq!(text, c.replace("--emit c\n", "--emit cuda\n"));
    let exact = fs::read_to_string(Path::new(HERE).join("include/hairline_exact.h")).unwrap();
    for code in [&text, &exact] {
        let is_function = |line: &&str| line.contains("inline ") || line.ends_with("inline");
        let functions = code.lines().filter(is_function);
        let functions: Vec<&str> = functions.map(str::trim).collect();
        let words = ["__host__ __device__ inline", "inline"];
        assert_eq!(
            functions,
            words.map(|words| format!("#define HAIRLINE_FUNCTION static {words}"))
        );
    }
    // A folder takes it under the name that CUDA's includes have.
    ends(
        &folder,
        &[
            "repair",
            "--kernel",
            "moller-trumbore",
            "--emit",
            "cuda",
            "-o",
            "all/",
        ],
        0,
    );
    let source = folder.join("caller.cpp");
    fs::write(&source, CUDA).unwrap();
    let header = format!(
        "-DHEADER=\"{}\"",
        folder.join("all/moller_trumbore_f32.cuh").display()
    );
    let include = format!("-I{HERE}/include");
    let words = [
        "-D__CUDACC__",
        "-D__host__=",
        "-D__device__=",
        "-Wall",
        "-Wextra",
        "-Werror",
    ];
    let flags = [&words[..], &["-xc++", "-std=c++17", &header, &include]].concat();
    for more in [&[][..], &["-D__CUDA_ARCH__=900"]] {
        let program = folder.join("caller");
        compile_by("cc", &source, &program, &[&flags[..], more].concat());
        assert!(
            Command::new(&program).status().unwrap().success(),
            "{more:?}"
        );
    }
}

#[test]
fn no_product_of_a_caller_is_fused_on_a_device() {
    if !has("nvcc") {
        return;
    }
    let folder = scratch("repair-nvcc");
    let flags = ["-O3", "-x", "cu", "-Xcompiler", "-w"];
    for (kernel, scalar, promise) in [
        ("moller-trumbore", "f32", LINE),
        ("moller-trumbore", "f64", LINE),
        ("plucker", "f32", INTERVAL),
    ] {
        let file = emitted_in("cuda", &folder, kernel, scalar);
        let Some(found) = run(&built("nvcc", &file, promise, &flags)) else {
            not_tested("there is no device that CUDA sees");
            return;
        };
        assert_eq!(found, [0; 2], "{kernel} {scalar}");
    }
    let file = emitted_in("cuda", &folder, "moller-trumbore", "f32");
    let text = fs::read_to_string(&file).unwrap();
    let fused = text.replace("__fsub_rn(x, y)", "x - y");
    assert_ne!(text, fused);
    fs::write(&file, fused).unwrap();
    let [hits, misses] = wrong("nvcc", &file, LINE, &flags);
    assert!(1_000 < hits && 100 < misses, "{hits} {misses}");
}

#[test]
fn a_shader_in_wgsl_combines_its_inputs_with_a_zero_of_the_run() {
    let folder = scratch("repair-zero");
    for (kernel, inputs) in [
        ("moller-trumbore", &["o", "d", "a", "b", "c"][..]),
        ("plucker", &["t_min", "t_max"]),
    ] {
        let (text, _) = ends(
            &folder,
            &["repair", "--kernel", kernel, "--emit", "wgsl"],
            0,
        );
        let (head, body) = text.split_once("let SLACK").unwrap();
        assert!(
            head.contains("zero: u32, answer: ptr<function, vec3f>"),
            "{head}"
        );
        for input in inputs {
            let bits = format!("let {input} = bitcast<");
            assert_eq!(body.matches(&bits).count(), 1, "{input}: {body}");
            assert_eq!(
                text.matches(&format!("{input}_in")).count(),
                2,
                "{input}: {body}"
            );
        }
    }
}
