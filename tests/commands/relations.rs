//! Mistakes that a simple relation between a kernel's answers and the exact values explains, as commands name them.

use crate::plugin::{library, record};
use crate::program;

use program::{ends, flat, scratch};
use std::fmt::Write;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// A kernel of `related.c` with a mistake, and the sentence about it; none for one that no relation explains.
const MISTAKES: [(&str, Option<&str>); 24] = [
    ("NONE", None),
    ("AFFINE", None),
    ("SOMETIMES_TWICE", None),
    ("TWICE", Some("t is twice the exact t on all ")),
    ("HALF", Some("t is half the exact t on all ")),
    ("OPPOSITE", Some("t has the opposite sign on all ")),
    ("LENGTH", Some("t is t*|d| on all ")),
    ("SQUARED_LENGTH", Some("t is t*|d|^2 on all ")),
    ("OVER_LENGTH", Some("t is t/|d| on all ")),
    ("FROM_START", Some("t is t - t_min on all ")),
    ("SHARE", Some("t is (t - t_min)/(t_max - t_min) on all ")),
    ("CLAMPED", Some("t is clamped to t_max on all ")),
    ("EXCHANGED", Some("u and v are exchanged on all ")),
    ("W_FOR_U", Some("u is the weight of a (1 - u - v) on all ")),
    ("W_FOR_V", Some("v is the weight of a (1 - u - v) on all ")),
    ("OF_AB", Some("u and v are the weights of a and b on all ")),
    ("OF_CA", Some("u and v are the weights of c and a on all ")),
    ("IN_F32", Some("t, u and v are computed in f32 on all ")),
    (
        "PREVIOUS",
        Some("t, u and v are those of the previous answer on all "),
    ),
    ("ABSOLUTE", Some("it takes |t| for t on all ")),
    ("NO_T_MIN", Some("it ignores t_min on all ")),
    ("ZERO_T_MIN", Some("it takes 0 for t_min on all ")),
    (
        "CLAMPED_T_MIN",
        Some("it takes 0 for a t_min below 0 on all "),
    ),
    ("NO_T_MAX", Some("it ignores t_max on all ")),
];

fn related(mistake: &str) -> Option<String> {
    let source = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/kernels/related.c");
    library(
        &source,
        &format!("related-{mistake}"),
        &[&format!("-DMISTAKE={mistake}")],
    )
}

/// Numbers from -1 to 1 in a row without a pattern.
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> f64 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }

    fn vector(&mut self, size: f64) -> [f64; 3] {
        [(); 3].map(|()| size * self.next())
    }
}

/// Rays at points inside triangles, with intervals before, around and beyond the hit.
fn corpus(file: &Path) {
    let mut numbers = Numbers(7);
    let mut text = String::new();
    for number in 0..240 {
        let [a, b, c] = [(); 3].map(|()| numbers.vector(4.0));
        let weights = [(); 3].map(|()| 1.2 + numbers.next());
        let sum: f64 = weights.iter().sum();
        let point =
            [0, 1, 2].map(|i| (weights[0] * a[i] + weights[1] * b[i] + weights[2] * c[i]) / sum);
        let d = numbers.vector(2.0);
        let t = (2.0 + 1.5 * numbers.next()) * if number % 4 == 0 { -1.0 } else { 1.0 };
        let o = [0, 1, 2].map(|i| point[i] - t * d[i]);
        let [low, high] = match number % 6 {
            0 => [t + 0.1, t + 1.0],
            1 => [t - 1.0, t - 0.1],
            2 => [t - 0.25, t + 0.25],
            3 => [0.0, 10.0],
            4 => [-10.0, 10.0],
            _ => [t.abs() - 0.3, t.abs() + 0.3],
        };
        writeln!(
            text,
            "{{\"scalar\":\"f64\",\"name\":\"c{number}\",\"origin\":{o:?},\"direction\":{d:?},\"a\":{a:?},\"b\":{b:?},\
             \"c\":{c:?},\"t_min\":{low},\"t_max\":{high}}}"
        )
        .unwrap();
    }
    fs::write(file, text).unwrap();
}

#[test]
fn each_simple_mistake_is_named_in_the_first_line_and_others_are_not() {
    let folder = scratch("relations");
    corpus(&folder.join("intervals.jsonl"));
    for (mistake, sentence) in MISTAKES {
        let Some(library) = related(mistake) else {
            return;
        };
        let plan = ["--kernel-lib", &library, "--corpus", "intervals.jsonl"];
        let run = |command: &str, code: i32| {
            flat(&ends(&folder, &[&[command, "-q"], &plan[..]].concat(), code).0)
        };
        let screen = run("audit", 0);
        let check = run("check", i32::from(mistake != "NONE"));
        match sentence {
            Some(sentence) => {
                let start = format!("related (own): {sentence}");
                assert!(screen.starts_with(&start), "{mistake}: {screen}");
                // In few words first, then with its counts.
                let counted = sentence.split(" on ").next().unwrap();
                let first = format!("Wrong: related: {counted}");
                assert!(check.starts_with(&first), "{mistake}: {check}");
                assert!(check.contains(&start), "{mistake}: {check}");
            }
            None => {
                let names = |text: &str| {
                    MISTAKES
                        .iter()
                        .any(|(_, it)| it.is_some_and(|it| text.contains(it)))
                };
                assert!(
                    !names(&screen) && !names(&check),
                    "{mistake}: {screen} {check}"
                );
            }
        }
    }
}

/// A kernel that misses everything misses behind its t_min too: that is not its mistake.
#[test]
fn a_mistake_that_explains_little_of_what_is_wrong_is_not_named() {
    let folder = scratch("relations-little");
    let source = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/kernels/wrong_kernels.cpp");
    let flags = ["-xc++", "-std=c++17", "-O2"];
    let Some(library) = library(&source, "wrong-kernels-little", &flags) else {
        return;
    };
    for (fault, named) in [
        ("always a miss", false),
        ("always a hit", false),
        ("t_min ignored", true),
    ] {
        let output = Command::new(env!("CARGO_BIN_EXE_hairline"))
            .args(["audit", "-q", "--scalar", "f32", "-n", "400"])
            .args(["--kernel-lib", &library])
            .env("WRONG_KERNEL", fault)
            .current_dir(&folder)
            .output()
            .unwrap();
        let screen = flat(&String::from_utf8(output.stdout).unwrap());
        let start = screen.split(". ").next().unwrap();
        assert_eq!(start.contains("t_min"), named, "{fault}: {screen}");
    }
}

/// At vertices rounding loses hits too: these must not hide how the interval is read.
#[test]
fn an_interval_that_is_not_read_is_named_in_families_and_scenes() {
    let folder = scratch("relations-families");
    let families = &["--family", "behind,interior,vertex-fan,interval-ends"][..];
    // Rays of a room meet nothing behind their start but by rounding, so |t| shows in families alone.
    for (mistake, sentence, plans) in [
        (
            "NO_T_MIN",
            "related (own): it ignores t_min on ",
            &[families, &["--scene", "room"]][..],
        ),
        (
            "NO_T_MAX",
            "related (own): it ignores t_max on ",
            &[families, &["--scene", "room"]],
        ),
        (
            "ABSOLUTE",
            "related (own): it takes |t| for t on ",
            &[families],
        ),
    ] {
        let Some(library) = related(mistake) else {
            return;
        };
        for plan in plans {
            assert_check_says(&folder, &library, plan, sentence);
        }
    }
}

#[test]
fn a_miss_that_is_told_as_a_t_is_named() {
    let folder = scratch("relations-miss");
    for (mistake, value) in [
        ("MINUS_ONE", "t = -1"),
        ("NOT_A_NUMBER", "t = NaN"),
        ("INFINITE", "an infinite t"),
        ("HUGE_T", "a huge t"),
    ] {
        let Some(library) = related(mistake) else {
            return;
        };
        let sentence = format!("it reports a miss as a hit with {value} on all ");
        for plan in [
            &["--family", "outside"][..],
            &["--family", "outside,interior,edge-near"],
            &["--scene", "room"],
        ] {
            let run = [
                &["audit", "-q", "-n", "200", "--kernel-lib", &library],
                plan,
            ]
            .concat();
            let screen = flat(&ends(&folder, &run, 0).0);
            let start = format!("related (own): {sentence}");
            assert!(screen.starts_with(&start), "{mistake} {plan:?}: {screen}");
        }
        let plan = ["--family", "outside"];
        assert_check_says(&folder, &library, &plan, &sentence);
    }
}

/// A mistake whose findings stand in the file of expectations is no reason for others.
#[test]
fn a_mistake_that_is_known_is_not_named_beside_a_new_one() {
    let folder = scratch("relations-known");
    let source = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/kernels/related.c");
    let text = fs::read_to_string(source).unwrap();
    let twice = text.replace("verdict->t = t;", "verdict->t = 2 * t;");
    assert_ne!(text, twice);
    let [known, new] = [("known", text), ("new", twice)].map(|(name, text)| {
        let source = folder.join(format!("{name}.c"));
        fs::write(&source, text).unwrap();
        let name = format!("related-known-{name}");
        library(&source, &name, &["-DMISTAKE=NOT_A_NUMBER"])
    });
    let (Some(known), Some(new)) = (known, new) else {
        return;
    };
    let families = "outside,interior";
    let check = [
        "check",
        "-q",
        "-n",
        "500",
        "--family",
        families,
        "--kernel-lib",
    ];
    ends(&folder, &[&check[..], &[&known, "--bless"]].concat(), 0);
    let said = flat(&ends(&folder, &[&check[..], &[&new]].concat(), 1).0);
    assert!(said.starts_with("Worse: related, "), "{said}");
    assert!(!said.contains("NaN"), "{said}");
    // Without that file all is new.
    let known = "it reports a miss as a hit with t = NaN";
    fs::remove_file(folder.join("hairline.expectations.toml")).unwrap();
    fs::remove_file(folder.join("hairline.expectations.toml.lock")).unwrap();
    let said = flat(&ends(&folder, &[&check[..], &[&new]].concat(), 1).0);
    assert!(
        said.starts_with(&format!("Wrong: related: {known}")),
        "{said}"
    );
}

#[test]
fn the_count_of_a_relation_is_that_of_the_record_also_from_shards() {
    let folder = scratch("relations-record");
    corpus(&folder.join("intervals.jsonl"));
    let Some(library) = related("TWICE") else {
        return;
    };
    let file = folder.join("intervals.jsonl");
    let flags = ["--kernel-lib", &library, "--corpus", file.to_str().unwrap()];
    let (whole, _) = record(&flags);
    let wrong = &whole["result"]["results"][0]["total"]["wrong_values"]["count"];
    let relation = &whole["result"]["totals"][0]["relations"][0];
    assert_eq!(relation["relation"], "t-twice");
    assert_eq!((&relation["count"], &relation["of"]), (wrong, wrong));
    for shard in ["0/2", "1/2"] {
        let part = format!("{}.json", &shard[..1]);
        let flags = [
            &[
                "audit", "-q", "--shard", shard, "--format", "json", "-o", &part,
            ],
            &flags[..],
        ];
        ends(&folder, &flags.concat(), 0);
    }
    let merge = [
        "merge",
        "0.json",
        "1.json",
        "--kernel-lib",
        &library,
        "--format",
        "json",
    ];
    let merged: serde_json::Value = serde_json::from_str(&ends(&folder, &merge, 0).0).unwrap();
    assert_eq!(
        merged["result"]["totals"][0]["relations"],
        whole["result"]["totals"][0]["relations"]
    );
}

#[test]
fn explain_names_the_relation_on_cases_like_the_one_asked() {
    let folder = scratch("relations-explain");
    for (mistake, expected) in [
        (
            "TWICE",
            "why the wrong-value: t is twice the exact t on all ",
        ),
        (
            "EXCHANGED",
            "why the wrong-value: u and v are exchanged on all ",
        ),
        (
            "IN_F32",
            "why the wrong-value: t, u and v are computed in f32 on all ",
        ),
        ("AFFINE", "why the wrong-value: cannot be told"),
    ] {
        let Some(library) = related(mistake) else {
            return;
        };
        let case = "{\"scalar\":\"f64\",\"origin\":[0.2,0.3,2],\"direction\":[0.1,0.2,-0.7],\"a\":[-1,-2,0],\"b\":[3,-1,0.5],\
                    \"c\":[0,4,0.25]}";
        let said = flat(&ends(&folder, &["explain", case, "--kernel-lib", &library], 0).0);
        assert!(said.contains(expected), "{mistake}: {said}");
    }
}

/// The example in C is Möller and Trumbore's test bit for bit; here compiled to fuse products, and with another epsilon than it says.
#[test]
fn fused_products_and_another_epsilon_are_found_by_value() {
    let root = PathBuf::from(env!("CARGO_MANIFEST_DIR"));
    let text = fs::read_to_string(root.join("examples/c/moller_trumbore.c")).unwrap();
    let folder = scratch("relations-epsilon");
    let source = folder.join("other.c");
    let other = text.replace("ABS(det) < epsilon", "(void)epsilon, ABS(det) < (REAL)3e-3");
    assert_ne!(other, text);
    fs::write(&source, other).unwrap();
    let Some(library) = library(&source, "other-epsilon", &[]) else {
        return;
    };
    let case = "{\"scalar\":\"f32\",\"origin\":[0.01,0.01,1],\"direction\":[0,0,-1],\"a\":[0,0,0],\"b\":[0.05,0,0],\
                \"c\":[0,0.05,0]}";
    let said = flat(&ends(&folder, &["explain", case, "--kernel-lib", &library], 0).0);
    assert!(said.contains("FALSE-MISS"), "{said}");
    assert!(
        said.contains("it answers as moller-trumbore does"),
        "{said}"
    );
    assert_range_holds(&said, "it would on all with parallel between ", 3e-3);
    for plan in [&["--family", "edge-near,tiny"][..], &["--scene", "room"]] {
        let start = "c-moller-trumbore (own): it computes moller-trumbore with parallel between ";
        assert_range_holds(
            &assert_check_says(&folder, &library, plan, start),
            start,
            3e-3,
        );
    }
    // A published epsilon that it does not declare, and an interval that it reads, are no mistakes.
    let hit = "verdict->hit = 1;";
    let on_interval = "REAL t = dot_##SUFFIX(edge2, q) * inverse; if (t < c->t_min || t > c->t_max) return; verdict->hit = 1;";
    let interval = text
        .replace(hit, on_interval)
        .replace("extent=line", "extent=interval")
        .replace(".epsilon_count = 1", ".epsilon_count = 0")
        .replace("epsilons[0]", "(epsilons ? (REAL)1e-6 : (REAL)1e-6)");
    let source_of_interval = folder.join("interval.c");
    fs::write(&source_of_interval, interval).unwrap();
    if let Some(interval) = self::library(&source_of_interval, "on-interval", &[]) {
        let plan = ["--family", "edge-near,tiny,interval-ends"];
        assert_check_says(&folder, &interval, &plan, UNEXPLAINED);
    }
    // Declared, by whatever name, it is no mistake.
    let declared = fs::read_to_string(&source)
        .unwrap()
        .replace("\"parallel\"", "\"det\"")
        .replace("1e-6", "3e-3");
    let source_of_declared = folder.join("declared.c");
    fs::write(&source_of_declared, declared).unwrap();
    if let Some(declared) = self::library(&source_of_declared, "declared-epsilon", &[]) {
        assert_check_says(
            &folder,
            &declared,
            &["--family", "edge-near,tiny"],
            UNEXPLAINED,
        );
    }
    #[cfg(target_arch = "x86_64")]
    if std::arch::is_x86_feature_detected!("fma") {
        fused_products_are_found(&folder, &source);
    }
}

/// A kernel that loses every hit, and then only some: a triangle of a pair is right now, and the other one is not.
#[test]
fn another_triangle_of_a_group_that_is_wrong_still_is_no_other_answer() {
    let root = PathBuf::from(env!("CARGO_MANIFEST_DIR"));
    let text = fs::read_to_string(root.join("examples/c/moller_trumbore.c")).unwrap();
    let folder = scratch("relations-group");
    let hit = "verdict->hit = 1;";
    let [all, some] = ["0", "u < v"].map(|hits| {
        let name = format!("hits-{}", hits.len());
        let source = folder.join(format!("{name}.c"));
        fs::write(
            &source,
            text.replace(hit, &format!("verdict->hit = {hits};")),
        )
        .unwrap();
        library(&source, &name, &[])
    });
    let (Some(all), Some(some)) = (all, some) else {
        return;
    };
    let plan = [
        "check",
        "-q",
        "-n",
        "400",
        "--family",
        "shared-edge",
        "--kernel-lib",
    ];
    ends(&folder, &[&plan[..], &[&all, "--bless"]].concat(), 0);
    let said = flat(&ends(&folder, &[&plan[..], &[&some, "--details"]].concat(), 1).0);
    assert!(said.starts_with("Mixed: "), "{said}");
    assert!(!said.contains("depends on the cases"), "{said}");
}

/// The same source, whose products a compiler fuses into sums.
#[cfg(target_arch = "x86_64")]
fn fused_products_are_found(folder: &Path, source: &Path) {
    let flags = ["-O2", "-mfma", "-ffp-contract=fast"];
    let Some(library) = library(source, "fused-epsilon", &flags) else {
        return;
    };
    let case = "{\"scalar\":\"f32\",\"origin\":[0.011,0.013,1],\"direction\":[0.001,0.002,-1],\"a\":[0,0,0],\
                \"b\":[0.05,0.01,0.02],\"c\":[0,0.05,0.003]}";
    let said = flat(&ends(folder, &["explain", case, "--kernel-lib", &library], 0).0);
    assert!(
        said.contains("it answers as moller-trumbore with fused products does"),
        "{said}"
    );
    let start = "c-moller-trumbore (own): it computes moller-trumbore with fused products";
    assert_check_says(folder, &library, &["--family", "edge-near,tiny"], start);
}

/// The range of an epsilon that stands behind some words holds a number, and is no wider than a factor of two.
fn assert_range_holds(said: &str, before: &str, epsilon: f64) {
    let (_, range) = said.split_once(before).expect(said);
    let (range, _) = range.split_once(" in place of 1e-6").expect(said);
    let (low, high) = range.split_once(" and ").expect(said);
    let [low, high]: [f64; 2] = [low, high].map(|end| end.parse().unwrap());
    assert!(
        low < epsilon && epsilon <= high && high <= 2.0 * low,
        "{said}"
    );
}

/// The end of the first line where no mistake is known.
const UNEXPLAINED: &str = " wrong answers of c-moller-trumbore, and no file says which are known";

/// The screen of a check that fails, which has these words in its first lines, before what was compared.
fn assert_check_says(folder: &Path, library: &str, plan: &[&str], words: &str) -> String {
    let check = ["check", "-q", "-n", "1000", "--kernel-lib", library];
    let said = flat(&ends(folder, &[&check, plan].concat(), 1).0);
    let first = said
        .split(" the same command with --bless ")
        .next()
        .unwrap();
    assert!(first.contains(words), "{said}");
    said
}
