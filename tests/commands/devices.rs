//! Kernels on a graphics device of this machine, or in software (Mesa's lavapipe), through examples/gpu.
//! `bash examples/gpu/test` has them run where a device is.

use crate::program::{ends, hairline, scratch};
use crate::tools::{has, not_tested};
use serde_json::Value;
use std::fs;
use std::path::Path;
use std::process::Command;

const HERE: &str = env!("CARGO_MANIFEST_DIR");

/// The program of examples/gpu with these words, as a kernel's command; none if it is not built.
fn on_a_device(words: &str) -> Option<String> {
    let home = Path::new(HERE).join("examples/gpu");
    let program = home.join("target/debug/hairline-gpu-example");
    let written = |path: &Path| fs::metadata(path).and_then(|it| it.modified()).ok();
    let mut sources = ["src", "src/wrapped"]
        .iter()
        .flat_map(|folder| fs::read_dir(home.join(folder)).unwrap());
    if sources.any(|source| written(&program) < written(&source.unwrap().path())) {
        not_tested("shaders on a device: cargo build --manifest-path examples/gpu/Cargo.toml");
        return None;
    }
    Some(format!("{} {words}", program.display()))
}

/// The result of an audit in f32, without attribution; none without a driver.
fn audited(folder: &Path, arguments: &[&str]) -> Option<Value> {
    let all = "audit --scalar f32 --attribute 0 --format json -q";
    let all: Vec<&str> = all.split(' ').chain(arguments.iter().copied()).collect();
    let output = hairline(folder, &all);
    let error = String::from_utf8_lossy(&output.stderr);
    if error.contains("no GPU adapter") || error.contains("glslangValidator: No such file") {
        not_tested(
            "shaders on a device: no driver or no compiler (Debian: mesa-vulkan-drivers, glslang-tools)",
        );
        return None;
    }
    assert_eq!(output.status.code(), Some(0), "{error}");
    let record: Value = serde_json::from_slice(&output.stdout).unwrap();
    Some(record["result"].clone())
}

/// A sum over all families.
fn sum(result: &Value, of: impl Fn(&Value) -> Option<u64>) -> u64 {
    let results = result["results"].as_array().unwrap();
    results
        .iter()
        .map(|result| of(&result["total"]).unwrap())
        .sum()
}

/// Wrong hits where an ask is a miss, and wrong misses where it is a hit, of a shader; none without a driver.
fn wrong_on_a_device(folder: &Path, file: &Path, inputs: &str) -> Option<[u64; 2]> {
    let mut wrong = [0; 2];
    for (count, [ask, finding]) in wrong
        .iter_mut()
        .zip([["miss", "false_hits"], ["hit", "false_misses"]])
    {
        let command = on_a_device(&format!("{} {ask} {inputs}", file.display()))?;
        let result = audited(folder, &["--kernel-cmd", &command, "-n", "1000"])?;
        // It does hit, and it does miss.
        let hits = sum(&result, |it| it["hits"].as_u64());
        let cases = sum(&result, |it| it["cases"].as_u64());
        assert!(
            cases / 20 < hits && hits < cases * 9 / 10,
            "{hits} of {cases}"
        );
        *count = sum(&result, |it| it[finding]["count"].as_u64());
    }
    Some(wrong)
}

/// A kernel in a shading language, in a file of the folder.
fn emitted(folder: &Path, kernel: &str, language: &str) -> std::path::PathBuf {
    let name = format!("{kernel}.{language}");
    let words = ["repair", "--kernel", kernel, "--emit", language, "-o"];
    ends(folder, &[&words[..], &[&name]].concat(), 0);
    folder.join(&name)
}

/// Writes a file again with some words replaced, which it has to have.
fn replace(file: &Path, words: &str, others: &str) {
    let text = fs::read_to_string(file).unwrap();
    assert!(text.contains(words), "{text}");
    fs::write(file, text.replace(words, others)).unwrap();
}

const LANGUAGES: [&str; 3] = ["wgsl", "glsl", "hlsl"];

#[test]
fn shaders_are_right_and_without_margins_they_are_not() {
    let folder = scratch("devices-margins");
    for kernel in ["moller-trumbore", "woop-watertight"] {
        for language in LANGUAGES {
            let file = emitted(&folder, kernel, language);
            let Some(wrong) = wrong_on_a_device(&folder, &file, "") else {
                return;
            };
            assert_eq!(wrong, [0, 0], "{kernel} {language}");
            let margin = "return factor * size + ";
            replace(&file, margin, "return 0.0 * factor * size + ");
            let [hits, misses] = wrong_on_a_device(&folder, &file, "").unwrap();
            assert!(
                0 < hits && 0 < misses,
                "{kernel} {language}: {hits} {misses}"
            );
        }
    }
}

/// A compiler that sees through a caller's sum or product computes about other numbers than the rounded ones.
#[test]
fn shaders_are_right_about_numbers_that_are_computed_where_they_are_called() {
    let folder = scratch("devices-inputs");
    let command = |inputs| on_a_device(inputs);
    let Some(published) = ["", "products", "sums"]
        .map(|inputs| audited(&folder, &["--kernel-cmd", &command(inputs)?, "-n", "1000"]))
        .into_iter()
        .collect::<Option<Vec<Value>>>()
    else {
        return;
    };
    let wrong = |result: &Value| sum(result, |it| it["false_misses"]["count"].as_u64());
    let [stored, products, sums] = [0, 1, 2].map(|which| wrong(&published[which]));
    println!("published, false misses: {stored}, of products {products}, of sums {sums}");
    let sees_through = stored + stored / 10 < sums;
    for language in LANGUAGES {
        let file = emitted(&folder, "moller-trumbore", language);
        for inputs in ["products", "sums"] {
            let wrong = wrong_on_a_device(&folder, &file, inputs);
            assert_eq!(wrong, Some([0, 0]), "{language} of {inputs}");
        }
        let barrier = if language == "wgsl" {
            " ^ vec3u(zero)"
        } else {
            "precise "
        };
        replace(&file, barrier, "");
        let wrong = wrong_on_a_device(&folder, &file, "sums").unwrap();
        println!("{language} without its barrier, of sums: {wrong:?} wrong");
        assert!(
            !sees_through || wrong != [0, 0],
            "{language}: the barrier is not needed here"
        );
    }
}

/// The counts, errors and digests of a kernel, by family but for some.
fn answers<'a>(result: &'a Value, without: &[&str]) -> Vec<[&'a Value; 4]> {
    let results = result["results"].as_array().unwrap();
    results
        .iter()
        .filter(|it| !without.contains(&it["family"].as_str().unwrap()))
        .map(|it| ["total", "classes", "across", "accuracy"].map(|part| &it[part]))
        .collect()
}

/// The name of the device, as the kernel's hello has it.
fn is_lavapipe(command: &str) -> bool {
    let probe = Command::new("sh")
        .args(["-c", &format!("{command} < /dev/null")])
        .output()
        .unwrap();
    String::from_utf8_lossy(&probe.stdout).contains("llvmpipe")
}

#[test]
fn on_lavapipe_a_shader_is_the_kernel_in_rearranged_arithmetic() {
    let folder = scratch("devices-arithmetic");
    let Some(command) = on_a_device("") else {
        return;
    };
    let Some(on_device) = audited(&folder, &["--kernel-cmd", &command, "-n", "1000"]) else {
        return;
    };
    if !is_lavapipe(&command) {
        return not_tested("rearranged sums: the device is not lavapipe");
    }
    let emulated = |name| audited(&folder, &["--kernel", name, "-n", "1000"]).unwrap();
    let [same, other] = ["moller-trumbore+rearranged", "moller-trumbore"].map(emulated);
    assert_eq!(answers(&on_device, &[]), answers(&same, &[]));
    assert_ne!(answers(&on_device, &[]), answers(&other, &[]));
}

#[test]
fn on_lavapipe_guarded_shaders_answer_as_the_c_code_does_on_the_processor() {
    let folder = scratch("devices-processor");
    if !has("cc") {
        return;
    }
    let header = emitted(&folder, "moller-trumbore", "c");
    for (ask, counted) in [("miss", 0), ("hit", 1)] {
        let library = folder.join(format!("lib{ask}.so"));
        let status = Command::new("cc")
            .args(["-O2", "-shared", "-fPIC", "-DKERNEL=moller_trumbore_f32"])
            .arg(format!("-DCOUNTED={counted}"))
            .arg(format!("-I{HERE}/include"))
            .arg("-include")
            .arg(&header)
            .arg("-o")
            .arg(&library)
            .arg(format!("{HERE}/tests/repair/library.c"))
            .status()
            .unwrap();
        assert!(status.success());
        let library = library.to_str().unwrap();
        let on_processor = audited(&folder, &["--kernel-lib", library, "-n", "1000"]).unwrap();
        for language in LANGUAGES {
            let file = emitted(&folder, "moller-trumbore", language);
            let words = format!("{} {ask}", file.display());
            let Some(command) = on_a_device(&words) else {
                return;
            };
            let Some(on_device) = audited(&folder, &["--kernel-cmd", &command, "-n", "1000"])
            else {
                return;
            };
            if !is_lavapipe(&command) {
                return not_tested("answers of a processor: the device is not lavapipe");
            }
            // Shaders ask where coordinates are above 1.3e11, the C code where a number overflows.
            let large = ["huge", "direction-length", "range-ends"];
            let [on_device, on_processor] =
                [&on_device, &on_processor].map(|it| answers(it, &large));
            assert_eq!(on_device, on_processor, "{language}");
        }
    }
}
