//! Kernels in other machines' arithmetic, as a user meets them: next to each other in one table, held
//! to what a compiler makes of the same source, and what they do at shared edges.

use crate::program;
use crate::tools::{has, not_tested};

use program::{ends, flat, scratch};
use serde_json::Value;
use std::path::Path;
use std::process::Command;

const HERE: &str = env!("CARGO_MANIFEST_DIR");

/// An audit's result in JSON.
fn audit(arguments: &[&str]) -> Value {
    let mut all = vec!["audit", "--quiet", "--format", "json"];
    all.extend(arguments);
    let (out, _) = ends(Path::new(HERE), &all, 0);
    serde_json::from_str::<Value>(&out).unwrap()["result"].take()
}

/// The results of a kernel: everything by family and scalar but its name.
fn of<'a>(result: &'a Value, kernel: &str) -> Vec<&'a Value> {
    let all = result["results"].as_array().unwrap().iter();
    let found: Vec<&Value> = all.filter(|part| part["kernel"] == kernel).collect();
    assert!(!found.is_empty(), "{kernel}");
    found
}

#[test]
fn one_row_an_arithmetic_side_by_side_each_with_its_own_name() {
    let result = audit(&[
        "--kernel=moller-trumbore,cramer",
        "--arithmetic=ieee,fma,ftz,fma-ftz,rearranged,fma-ftz-rearranged",
        "--scalar=f32",
        "--family=edge-near",
        "-n500",
    ]);
    let names = |kernel: &str| {
        [
            "",
            "+fma",
            "+ftz",
            "+fma-ftz",
            "+rearranged",
            "+fma-ftz-rearranged",
        ]
        .map(|suffix| format!("{kernel}{suffix}"))
        .to_vec()
    };
    let rows: Vec<&str> = result["plan"]["rows"]
        .as_array()
        .unwrap()
        .iter()
        .map(|r| r["kernel"].as_str().unwrap())
        .collect();
    assert_eq!(rows, [names("moller-trumbore"), names("cramer")].concat());
    // The built-in arithmetic is what it was, and what a name says alone.
    let alone = |name: &str| {
        audit(&[
            "--kernel",
            name,
            "--scalar=f32",
            "--family=edge-near",
            "-n500",
        ])
    };
    for name in [
        "moller-trumbore",
        "moller-trumbore+fma",
        "cramer+fma-ftz",
        "moller-trumbore+rearranged",
    ] {
        assert_eq!(of(&alone(name), name), of(&result, name));
    }
    let plain = of(&result, "moller-trumbore")[0];
    for other in ["fma", "rearranged"] {
        let other = of(&result, &format!("moller-trumbore+{other}"))[0];
        assert_ne!(plain["total"], other["total"]);
    }
    // No sum of Cramer's rule has a factor in both terms.
    assert_eq!(
        of(&result, "cramer")[0]["total"],
        of(&result, "cramer+rearranged")[0]["total"]
    );
    // Nothing near the boundary of moderate triangles is subnormal.
    assert_eq!(
        plain["total"],
        of(&result, "moller-trumbore+ftz")[0]["total"]
    );
}

#[test]
fn watertight_kernels_crack_where_products_are_fused_unless_they_stay_antisymmetric() {
    let result = audit(&[
        "--kernel=woop-watertight,plucker",
        "--arithmetic=ieee,fma",
        "--family=shared-edge",
        "-n2000",
    ]);
    for (place, scalar) in ["f32", "f64"].iter().enumerate() {
        let cracks = |kernel: &str| {
            let part = of(&result, kernel)[place];
            assert_eq!(part["scalar"], *scalar);
            part["across"]["cracks"]["count"].as_u64().unwrap()
        };
        assert_eq!(cracks("woop-watertight"), 0);
        // a.x*b.y - a.y*b.x is no longer the negative of b.x*a.y - b.y*a.x.
        assert!((20..40).contains(&cracks("woop-watertight+fma")));
        // The neighbour's edge is the same with its sign turned: so is each product.
        assert_eq!(cracks("plucker") + cracks("plucker+fma"), 0);
    }
}

#[test]
fn findings_of_a_variant_are_shown_again_and_attributed_in_its_arithmetic() {
    let result = audit(&[
        "--kernel=plane-inside-out",
        "--arithmetic=ftz",
        "--epsilon=parallel=0",
        "--scalar=f32",
        "--family=tiny",
        "-n500",
    ]);
    let text = result.to_string();
    assert!(text.contains("--kernel plane-inside-out+ftz"), "{text}");
    let folder = scratch("variant-explain");
    let explain = |kernel: &str| {
        ends(
            &folder,
            &["explain", "shared-edge@3/f32/-/1/5", "--kernel", kernel],
            0,
        )
        .0
    };
    assert!(explain("woop-watertight").contains("1 of 2 triangles hit"));
    assert!(
        flat(&explain("woop-watertight+fma"))
            .contains("0 of 2 triangles hit; one hit is right: CRACK")
    );
    // A triangle whose normal is small, and not yet subnormal, is hit in both.
    let tiny = r#"{"scalar":"f32","origin":[1,1,4],"direction":[0,0,-1],"a":[0,0,0],"b":["0x1p-40",0,0],"c":[0,"0x1p-40",0]}"#;
    let tiny = tiny.replace("[1,1,4]", r#"["0x1p-42","0x1p-42",4]"#);
    let shown = |kernel: &str| {
        ends(
            &folder,
            &[
                "explain",
                &tiny,
                "--kernel",
                kernel,
                "--epsilon=parallel=1e-30",
            ],
            0,
        )
        .0
    };
    let (plain, flushed) = (shown("plane-inside-out"), shown("plane-inside-out+ftz"));
    assert!(
        plain.contains("plane-inside-out (parallel=1e-30): hit"),
        "{plain}"
    );
    assert!(
        flushed.contains("plane-inside-out+ftz (parallel=1e-30): hit"),
        "{flushed}"
    );
}

#[test]
fn the_other_commands_take_a_variant_by_its_name() {
    let folder = scratch("variant-commands");
    let (out, _) = ends(
        &folder,
        &[
            "epsilon",
            "--kernel=cramer+ftz",
            "--gate=parallel",
            "--scalar=f32",
            "-n200",
            "--quiet",
        ],
        0,
    );
    // Where subnormal numbers are zero, so is an epsilon below the normal ones.
    assert!(out.contains("cramer+ftz f32 in unit"), "{out}");
    let (out, _) = ends(
        &folder,
        &[
            "fuzz",
            "shrink",
            "shared-edge@3/f32/-/1/69.0",
            "--kernel=woop-watertight+fma",
            "--contract=closed-ray",
        ],
        0,
    );
    assert!(out.contains("fn woop_watertight_fma_f32_"), "{out}");
    assert!(out.contains("find(\"woop-watertight+fma\")"), "{out}");
    std::fs::write(folder.join("hairline.toml"), "kernel = \"cramer\"\narithmetic = [\"ieee\", \"fma\"]\ncount = 200\nfamily = \"edge-near\"\n").unwrap();
    ends(&folder, &["check", "--bless", "--quiet"], 0);
    let blessed = std::fs::read_to_string(folder.join("hairline.expectations.toml")).unwrap();
    assert!(blessed.contains("cramer+fma"), "{blessed}");
    ends(&folder, &["check", "--quiet"], 0);
    // A plan that leaves a row out is no news; a row that nothing is known about is.
    ends(&folder, &["check", "--quiet", "--arithmetic=ieee"], 0);
    let (out, _) = ends(&folder, &["check", "--quiet", "--arithmetic=ftz"], 1);
    assert!(
        out.contains("cramer+ftz (source) f32 edge-near: false-hit"),
        "{out}"
    );
    let (out, _) = ends(&folder, &["list", "arithmetics"], 0);
    let names = out.lines().filter(|line| !line.starts_with(' '));
    assert_eq!(names.count(), 6);
}

#[test]
fn unknown_and_impossible_arithmetics_are_refused_in_one_line() {
    let folder = scratch("variant-refused");
    let refused = |arguments: &[&str]| {
        let mut all = vec!["audit", "--family=interior", "-n10"];
        all.extend(arguments);
        let (out, error) = ends(&folder, &all, 2);
        assert_eq!(out, "");
        error
    };
    let error = refused(&["--kernel=cramer", "--arithmetic=fma,half"]);
    assert!(
        error.contains(
            "unknown arithmetic 'half': there are ieee, fma, ftz, fma-ftz, rearranged, fma-ftz-rearranged"
        ),
        "{error}"
    );
    let error = refused(&["--kernel=cramer", "--arithmetic=fma,fma"]);
    assert!(error.contains("'fma' is given twice"), "{error}");
    let error = refused(&["--kernel=cramer+fma", "--arithmetic=ftz"]);
    assert!(
        error.contains("cramer+fma has one arithmetic only"),
        "{error}"
    );
    let error = refused(&["--kernel=cramer+fma", "--arithmetic=ieee"]);
    assert!(
        error.contains("cramer+fma computes in fma by its name: write cramer for others"),
        "{error}"
    );
    let error = refused(&["--kernel=cramer+fma+ftz"]);
    assert!(error.contains("unknown kernel 'cramer+fma+ftz'"), "{error}");
    let error = refused(&["--kernel=cramer+ieee"]);
    assert!(
        error.contains("unknown kernel 'cramer+ieee': behind 'cramer' can stand +fma ("),
        "{error}"
    );
}

/// The example in C, built with these flags; none where its arithmetic cannot be had.
#[cfg(all(target_arch = "x86_64", unix))]
fn built(name: &str, flags: &[&str], flush: bool) -> Option<String> {
    if !is_x86_feature_detected!("fma") {
        not_tested("this processor fuses no products");
        return None;
    }
    if !has("cc") {
        return None;
    }
    let path = scratch(&format!("variant-{name}")).join("libmt.so");
    let mut command = Command::new("cc");
    command
        .args(["-O2", "-shared", "-fPIC"])
        .arg(format!("-I{HERE}/include"))
        .args(flags);
    command
        .arg("-o")
        .arg(&path)
        .arg(format!("{HERE}/examples/c/moller_trumbore.c"));
    if flush {
        command.arg(format!("{HERE}/tests/kernels/flush.c"));
    }
    let output = command.arg("-lm").output().unwrap();
    assert!(
        output.status.success(),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
    Some(path.to_str().unwrap().to_owned())
}

/// Which cases each verdict is wrong on, by digest, and the values of hits: the same from the compiled
/// source on this processor as from the emulation, and not the same from any other arithmetic.
#[cfg(all(target_arch = "x86_64", unix))]
#[test]
fn an_emulated_kernel_is_the_compiled_one() {
    let fast: [&str; 2] = ["-ffp-contract=fast", "-mfma"];
    let off: [&str; 2] = ["-ffp-contract=off", "-mno-fma"];
    for (arithmetic, flags, flush) in [
        ("ieee", off, false),
        ("fma", fast, false),
        ("ftz", off, true),
        ("fma-ftz", fast, true),
    ] {
        let Some(library) = built(arithmetic, &flags, flush) else {
            return;
        };
        let result = audit(&[
            "--kernel-lib",
            &library,
            "--kernel=moller-trumbore",
            "--arithmetic=ieee,fma,ftz,fma-ftz",
            "--epsilon=parallel=0",
            "--family=interior,edge-near,vertex-near,tiny,huge,sliver,mixed-scale,range-ends,grazing",
            "-n400",
        ]);
        let compiled = of(&result, "c-moller-trumbore");
        for other in ["ieee", "fma", "ftz", "fma-ftz"] {
            let name = match other {
                "ieee" => "moller-trumbore".to_owned(),
                _ => format!("moller-trumbore+{other}"),
            };
            let emulated = of(&result, &name);
            let same = compiled.iter().zip(&emulated).all(|(x, y)| {
                ["total", "classes", "across", "accuracy"]
                    .iter()
                    .all(|part| x[*part] == y[*part])
            });
            assert_eq!(
                same,
                other == arithmetic,
                "compiled {arithmetic}, emulated {other}"
            );
        }
    }
}
