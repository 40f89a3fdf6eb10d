//! `hairline repair`: what it writes in other languages than C, and of kernels of one's own.

use crate::program::{ends, scratch};
use crate::repair::{INTERVAL, LINE, tried};
use crate::tools::{has, not_tested};
use hairline::internals::arith::Vector;
use hairline::internals::case::{Ray, Triangle};
use hairline::internals::contract::{Boundary, Contract, Demand, Extent, Sides};
use hairline::internals::kernel::{
    Entry, EpsilonSet, Gate, Gives, Hit, Kernel, KernelInfo, Refuse, Role, Sink, register,
};
use std::fs;
use std::path::Path;
use std::process::Command;

/// The names under which shading languages are tried here.
fn validates(language: &str, file: &Path) -> Option<bool> {
    let mut command = match language {
        "wgsl" => Command::new("naga"),
        _ => {
            let mut command = Command::new("glslangValidator");
            command.args(["-S", "comp"]);
            command.args(if language == "hlsl" {
                &["-D", "-e", "main", "-V", "-o", "/dev/null"][..]
            } else {
                &[]
            });
            command
        }
    };
    match command.arg(file).output() {
        Ok(output) => {
            let words = String::from_utf8_lossy(&output.stdout).into_owned();
            assert!(
                output.status.success(),
                "{}: {words}{}",
                file.display(),
                String::from_utf8_lossy(&output.stderr)
            );
            Some(true)
        }
        Err(_) => {
            not_tested(&format!("there is no validator of {language}"));
            None
        }
    }
}

#[test]
fn shading_languages_and_rust_take_what_is_written() {
    let folder = scratch("repair-languages");
    for kernel in [
        "moller-trumbore",
        "woop-watertight",
        "baldwin-weber",
        "plane-unit-normal",
    ] {
        for language in ["glsl", "wgsl", "hlsl", "rust"] {
            let (text, _) = ends(
                &folder,
                &["repair", "--kernel", kernel, "--emit", language],
                0,
            );
            let file = folder.join(format!("kernel.{language}"));
            let (head, tail) = match language {
                "glsl" => ("#version 450\n", "void main() {}\n"),
                "hlsl" => ("", "[numthreads(1, 1, 1)] void main() {}\n"),
                _ => ("", ""),
            };
            fs::write(&file, format!("{head}{text}{tail}")).unwrap();
            if language != "rust" {
                validates(language, &file);
                continue;
            }
            let strict = [
                "--edition",
                "2021",
                "--crate-type",
                "lib",
                "-D",
                "warnings",
                "-o",
                "kernel.rlib",
            ];
            let built = Command::new("rustc")
                .args(strict)
                .arg(&file)
                .current_dir(&folder)
                .output()
                .unwrap();
            assert!(
                built.status.success(),
                "{kernel}: {}",
                String::from_utf8_lossy(&built.stderr)
            );
        }
    }
}

/// A guarded kernel in Rust behind C's calls: an object for a C program, and a header for it.
fn rust_for_c(folder: &Path, kernel: &str, has_ends: bool) -> [std::path::PathBuf; 2] {
    let name = format!("{}_f32", kernel.replace('-', "_"));
    let file = folder.join("kernel.rs");
    ends(
        folder,
        &[
            "repair",
            "--kernel",
            kernel,
            "--emit",
            "rust",
            "-o",
            "kernel.rs",
        ],
        0,
    );
    assert!(file.exists());
    let ends = if has_ends { ", t_min, t_max" } else { "" };
    let shim = format!(
        r#"#![allow(unused_variables)]
#[path = "kernel.rs"]
mod kernel;
unsafe fn point(p: *const f32) -> [f32; 3] {{ *p.cast() }}
#[no_mangle]
pub unsafe extern "C" fn {name}(o: *const f32, d: *const f32, a: *const f32, b: *const f32, c: *const f32,
    t_min: f32, t_max: f32, hit: *mut [f32; 3]) -> i32 {{
    match kernel::{name}(point(o), point(d), point(a), point(b), point(c){ends}) {{
        kernel::Answer::Miss => 0,
        kernel::Answer::Hit {{ t, u, v }} => {{ *hit = [t, u, v]; 1 }}
        kernel::Answer::Ask => 2,
    }}
}}
"#
    );
    let source = folder.join("shim.rs");
    fs::write(&source, shim).unwrap();
    let object = folder.join(format!("lib{name}.so"));
    let flags = ["--edition", "2021", "--crate-type", "cdylib", "-O", "-o"];
    let built = Command::new("rustc")
        .args(flags)
        .arg(&object)
        .arg(&source)
        .output()
        .unwrap();
    assert!(
        built.status.success(),
        "{}",
        String::from_utf8_lossy(&built.stderr)
    );
    let header = folder.join(format!("{name}.h"));
    let text = format!(
        "enum {{ HAIRLINE_MISS, HAIRLINE_HIT, HAIRLINE_ASK }};\ntypedef struct {{ float t, u, v; }} {name}_hit;\n\
         int {name}(const float *, const float *, const float *, const float *, const float *, float, float, {name}_hit *);\n"
    );
    fs::write(&header, text).unwrap();
    [header, object]
}

#[test]
fn no_answer_of_the_rust_is_wrong_by_integers_of_any_length() {
    if !has("cc") {
        return;
    }
    for (kernel, promise) in [("moller-trumbore", LINE), ("woop-watertight", INTERVAL)] {
        let folder = scratch(&format!("repair-rust-{kernel}"));
        let [header, object] = rust_for_c(&folder, kernel, promise == INTERVAL);
        let path = format!("-Wl,-rpath,{}", folder.display());
        let flags = ["-O1", "-Wl,--no-as-needed", &path, object.to_str().unwrap()];
        let [hits, misses, asks, wrong] = tried(&folder, &header, promise, &flags);
        assert_eq!(wrong, 0, "{kernel}");
        assert!(
            5_000 < hits && 30_000 < misses && 10_000 < asks,
            "{hits} {misses} {asks}"
        );
    }
}

/// A kernel of one's own: signed volumes of the front alone.
struct Mine;

impl Kernel for Mine {
    const INFO: KernelInfo = KernelInfo {
        gates: &[Gate::signed(Role::Edge, "u < e, v < e, w < e", 2, 1)],
        epsilon_sets: &[EpsilonSet {
            name: "own",
            values: &["0"],
        }],
        gives: Gives {
            t: false,
            uv: true,
            facing: false,
        },
        ..KernelInfo::own(
            "repaired-mine",
            Contract::of_kernel(Extent::Line, Sides::Front, Boundary::Closed)
                .with_flat(Demand::Free, Demand::Free),
        )
    };

    type Prepared<V: Vector> = Triangle<V>;

    fn prepare<V: Vector>(triangle: &Triangle<V>) -> Triangle<V> {
        triangle.clone()
    }

    fn test<V: Vector, S: Sink<V::Real>>(
        Triangle { a, b, c }: &Triangle<V>,
        Ray {
            origin, direction, ..
        }: &Ray<V>,
        sink: &mut S,
    ) -> Option<Hit<V::Real>> {
        let [a, b, c] = [a, b, c].map(|vertex| vertex.minus(origin));
        let volume = |p: &V, q: &V| direction.dot(&p.cross(q));
        let (u, v, w) = (volume(&c, &b), volume(&a, &c), volume(&b, &a));
        for volume in [&u, &v, &w] {
            sink.one(0, Refuse::Below, volume)?;
        }
        let sum = u + &v + &w;
        Some(Hit {
            t: None,
            uv: Some((v / &sum, w / &sum)),
            facing: None,
        })
    }
}

#[test]
fn a_kernel_of_ones_own_is_guarded_in_the_same_way() {
    let folder = scratch("repair-own");
    register(Entry::of::<Mine>()).unwrap();
    let file = folder.join("repaired_mine_f32.h");
    let proof = folder.join("proof.txt");
    let words = [
        "hairline",
        "repair",
        "--kernel",
        "repaired-mine",
        "--emit",
        "c",
        "-o",
    ];
    let files = [
        file.to_str().unwrap(),
        "--certificate",
        proof.to_str().unwrap(),
    ];
    assert_eq!(
        hairline::cli::run(words.into_iter().chain(files).map(Into::into)),
        0
    );
    // The checker accepts the proof; the program, which does not know the kernel, says so too.
    let check = ["hairline", "prove", "--check", proof.to_str().unwrap()];
    assert_eq!(hairline::cli::run(check.map(Into::into)), 0);
    if !has("cc") {
        return;
    }
    let promise = ["-DEXTENT=0", "-DFRONT=1"];
    let [hits, misses, asks, wrong] = tried(&folder, &file, promise, &["-O1"]);
    assert_eq!(wrong, 0);
    assert!(
        1_000 < hits && 30_000 < misses && 10_000 < asks,
        "{hits} {misses} {asks}"
    );
}
