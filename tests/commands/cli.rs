//! The program as a user runs it: output, exit codes, bad input.

use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

/// A folder of its own for each test.
fn scratch(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).unwrap();
    folder
}

fn hairline_in(folder: &Path, arguments: &[&str], input: &str) -> Output {
    let mut child = Command::new(env!("CARGO_BIN_EXE_hairline"))
        .args(arguments)
        .current_dir(folder)
        .env_remove("NO_COLOR")
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    // A program that stops at bad arguments does not read.
    let _ = child.stdin.take().unwrap().write_all(input.as_bytes());
    child.wait_with_output().unwrap()
}

fn hairline(arguments: &[&str]) -> Output {
    hairline_in(Path::new(env!("CARGO_MANIFEST_DIR")), arguments, "")
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).unwrap()
}

fn code(output: &Output) -> i32 {
    output.status.code().expect("ended by itself")
}

/// Runs, expects an exit code and nothing on standard output, and returns the one line of error.
fn refused(folder: &Path, arguments: &[&str], expected: i32) -> String {
    let output = hairline_in(folder, arguments, "");
    let error = text(&output.stderr);
    assert_eq!(code(&output), expected, "{arguments:?}: {error}");
    assert_eq!(text(&output.stdout), "", "{arguments:?}");
    let lines: Vec<&str> = error
        .lines()
        .filter(|line| line.starts_with("hairline: "))
        .collect();
    assert_eq!(lines.len(), 1, "{arguments:?}: {error}");
    lines[0].to_owned()
}

fn json(output: &Output) -> serde_json::Value {
    assert_eq!(code(output), 0, "{}", text(&output.stderr));
    serde_json::from_slice(&output.stdout).unwrap()
}

#[test]
fn the_audit_lists_every_kernel_scalar_and_family() {
    let record = json(&hairline(&[
        "audit", "--count", "50", "--format", "json", "--quiet",
    ]));
    assert_eq!(record["schema"], "hairline-record/2");
    let results = record["result"]["results"].as_array().unwrap();
    let distinct = |key: &str| {
        results
            .iter()
            .map(|r| r[key].as_str().unwrap())
            .collect::<std::collections::BTreeSet<_>>()
            .len()
    };
    assert_eq!(
        (distinct("kernel"), distinct("scalar"), distinct("family")),
        (18, 2, 31)
    );
    let exact: Vec<_> = results
        .iter()
        .filter(|r| r["kernel"] == "hairline-exact")
        .collect();
    assert_eq!(exact.len(), 2 * 31);
    for result in exact {
        for kind in ["false_misses", "false_hits", "bad_values"] {
            assert_eq!(result["total"][kind]["count"], 0, "{kind}: {result}");
        }
    }
    for source in record["result"]["sources"].as_array().unwrap() {
        assert_eq!(source["promise_broken"], 0, "{source}");
    }
}

#[test]
fn the_result_does_not_depend_on_the_number_of_threads() {
    let result = |threads: &str| {
        let arguments = [
            "audit",
            "-n",
            "1000",
            "--family",
            "edge-near,fan,secondary-ray,range-ends",
            "--format",
            "json",
            "--threads",
            threads,
        ];
        serde_json::to_string(&json(&hairline(&arguments))["result"]).unwrap()
    };
    let one = result("1");
    assert_eq!(one, result("2"));
    assert_eq!(one, result("7"));
}

#[test]
fn the_text_table_names_the_kernel_the_place_the_cost_and_the_command() {
    let output = hairline(&[
        "audit",
        "-n",
        "2000",
        "--kernel",
        "moller-trumbore",
        "--family",
        "tiny,edge-near",
        "--details",
    ]);
    let table = text(&output.stdout);
    assert_eq!(code(&output), 0);
    for expected in [
        "moller-trumbore (source)",
        "ns a ray",
        "tiny",
        "contract: line",
        "false-miss",
        "hairline explain '",
    ] {
        assert!(table.contains(expected), "{expected}: {table}");
    }
    // The command that it prints shows the same disagreement again.
    let command = table
        .lines()
        .find(|line| line.contains("hairline explain"))
        .unwrap();
    let words: Vec<&str> = command
        .split_whitespace()
        .skip(1)
        .map(|word| word.trim_matches('\''))
        .collect();
    let explained = hairline(&words);
    assert_eq!(code(&explained), 0, "{}", text(&explained.stderr));
    let explained = text(&explained.stdout);
    assert!(explained.contains("FALSE-"), "{explained}");
    assert!(explained.contains("exactly"), "{explained}");
    assert!(
        explained.contains("<- decides") || explained.contains(": hit;"),
        "{explained}"
    );
}

#[test]
fn epsilons_and_presets_change_the_verdict() {
    let misses = |extra: &[&str]| {
        let mut arguments = vec![
            "audit",
            "-n",
            "500",
            "--kernel",
            "moller-trumbore",
            "--scalar",
            "f32",
            "--family",
            "tiny",
            "--format",
            "json",
        ];
        arguments.extend(extra);
        json(&hairline(&arguments))["result"]["results"][0]["total"]["false_misses"]["count"]
            .as_u64()
            .unwrap()
    };
    assert!(misses(&[]) > 200);
    assert!(misses(&["--epsilon", "parallel=0"]) < 50);
    assert!(misses(&["--epsilon-preset", "zero"]) < 50);
    assert!(misses(&["--epsilon-preset", "three-mesh-bvh"]) > 200);
    // A scalar that has no such number cannot be asked; one that has it can.
    let tiny = [
        "audit",
        "-n",
        "20",
        "--family",
        "tiny",
        "--epsilon",
        "parallel=1e-60",
    ];
    let in_f64 = ["--scalar", "f64", "--kernel", "moller-trumbore"];
    let error = refused(Path::new("."), &tiny, 2);
    assert!(
        error.contains("1e-60 is 0 in f32 (see --scalar)"),
        "{error}"
    );
    assert_eq!(code(&hairline(&[&tiny[..], &in_f64].concat())), 0);
    // A tolerance on the edges takes more hits than none.
    assert!(
        misses(&["--epsilon", "parallel=0,edge=-1e-3"])
            < misses(&["--epsilon", "parallel=0,edge=1e-3"])
    );
}

#[test]
fn a_table_of_nothing_says_why() {
    let plan = ["audit", "-n", "20", "--kernel", "cramer", "--threads", "1"];
    let far = [&plan[..], &["--family", "tiny,far", "--offset", "1e60:0:0"]].concat();
    let screen = text(&hairline(&far).stdout);
    assert!(
        screen.contains("\nf32: All are invalid: ") && !screen.contains("f64: All"),
        "{screen}"
    );
    let folder = scratch("one-scalar");
    fs::write(folder.join("one.jsonl"), format!("{CASE}\n")).unwrap();
    let one = [
        "audit",
        "--corpus",
        "one.jsonl",
        "--kernel",
        "cramer",
        "--details",
    ];
    let table = hairline_in(&folder, &one, "");
    assert!(!text(&table.stdout).contains("\nf64 kernel"), "{table:?}");
}

#[test]
fn one_contract_for_all_changes_what_is_asked() {
    let of = |contract: &str| {
        let arguments = [
            "audit",
            "-n",
            "300",
            "--kernel",
            "moller-trumbore",
            "--family",
            "behind",
            "--scalar",
            "f64",
            "--format",
            "json",
            "--contract",
            contract,
        ];
        json(&hairline(&arguments))["result"]["results"][0]["total"]["false_hits"]["of"]
            .as_u64()
            .unwrap()
    };
    assert_eq!(of("closed-line"), 0);
    assert_eq!(of("closed-ray"), 300);
}

#[test]
fn formats_go_to_their_outputs_whole() {
    let folder = scratch("formats");
    let arguments = [
        "audit",
        "-n",
        "20",
        "--family",
        "tiny",
        "--details",
        "--format",
        "text,json",
        "-o",
        "table.txt",
        "-o",
        "record.json",
    ];
    let output = hairline_in(&folder, &arguments, "");
    assert_eq!((code(&output), text(&output.stdout)), (0, String::new()));
    assert!(
        fs::read_to_string(folder.join("table.txt"))
            .unwrap()
            .contains("The worst of each class")
    );
    let record: serde_json::Value =
        serde_json::from_slice(&fs::read(folder.join("record.json")).unwrap()).unwrap();
    assert_eq!(record["result"]["plan"]["sources"][0]["family"], "tiny");
    let left: Vec<_> = fs::read_dir(&folder).unwrap().collect();
    assert_eq!(left.len(), 2, "nothing left beside them");
}

#[test]
fn colour_obeys_the_flag_and_no_color() {
    let table = |color: &str| {
        text(&hairline(&["audit", "-n", "20", "--family", "tiny", "--color", color]).stdout)
    };
    assert!(table("always").contains('\x1b'));
    assert!(!table("never").contains('\x1b'));
    assert!(!table("auto").contains('\x1b'), "a pipe is no terminal");
}

const CASE: &str = r#"{"name":"mid","scalar":"f32","origin":[1,0,1],"direction":[0,0,-1],"a":[0,0,0],"b":["2","0x0p0",0],"c":[0,2,0]}"#;

#[test]
fn truth_prints_one_json_line_a_case() {
    let folder = scratch("truth");
    let coplanar = r#"{"scalar":"f64","origin":[-1,1,0],"direction":[1,0,0],"a":[0,0,0],"b":[4,0,0],"c":[0,4,0],"t_max":2}"#;
    let run = |arguments: &[&str]| -> Vec<serde_json::Value> {
        let output = hairline_in(&folder, arguments, &format!("{CASE}\n\n{coplanar}\n"));
        assert_eq!(code(&output), 0);
        text(&output.stdout)
            .lines()
            .map(|line| serde_json::from_str(line).unwrap())
            .collect()
    };
    let (lines, brief) = (run(&["truth", "--exact", "-"]), run(&["truth", "-"]));
    // Without --exact the same but for the fractions, which are left out.
    for (line, brief) in lines.iter().zip(&brief) {
        let mut line = line.as_object().unwrap().clone();
        line.retain(|field, _| !field.ends_with("_exact"));
        if let Some(contact) = line["contact"].as_object_mut() {
            contact.remove("t");
        }
        assert_eq!(&serde_json::Value::Object(line), brief);
    }
    let expected = serde_json::json!({
        "name": "mid", "class": "transversal", "facing": "front", "t": "within", "feature": "edge_ab",
        "contact": null, "hits_closed": true, "t_exact": "1/1", "u_exact": "1/2", "v_exact": "0/1"
    });
    assert_eq!(lines[0], expected);
    let contact = serde_json::json!({"kind": "segment", "feature": null, "t": ["1/1", "2/1"]});
    assert_eq!(
        (&lines[1]["class"], &lines[1]["contact"]),
        (&"coplanar".into(), &contact)
    );
    assert_eq!(
        (&lines[1]["name"], &lines[1]["t"]),
        (&serde_json::Value::Null, &serde_json::Value::Null)
    );
}

#[test]
fn bad_corpus_lines_are_refused_with_file_line_and_field() {
    let folder = scratch("bad-corpus");
    let wrong = CASE.replacen('{', r#"{"truth":{"feature":"vertex_a"},"#, 1);
    for (content, message) in [
        ("not json".to_owned(), "bad.jsonl:1: "),
        (
            format!("{CASE}\n{}", CASE.replace("origin", "orign")),
            "bad.jsonl:2: unknown field 'orign'",
        ),
        (
            CASE.replace(r#""a":[0,0,0],"#, ""),
            "bad.jsonl:1: missing field 'a'",
        ),
        (
            CASE.replace("[1,0,1]", "[1,0,1e39]"),
            "bad.jsonl:1: origin[2]: '1e39' overflows f32",
        ),
        (
            wrong,
            "bad.jsonl:1: stored truth is wrong: feature is 'vertex_a', the oracle says 'edge_ab'",
        ),
    ] {
        fs::write(folder.join("bad.jsonl"), content).unwrap();
        let output = hairline_in(&folder, &["truth", "bad.jsonl"], "");
        assert_eq!(code(&output), 65);
        assert!(
            text(&output.stderr).starts_with(&format!("hairline: {message}")),
            "{}",
            text(&output.stderr)
        );
        assert!(refused(&folder, &["audit", "--corpus", "bad.jsonl"], 65).contains(message));
        // To a file: nothing half-written.
        assert_eq!(
            code(&hairline_in(
                &folder,
                &["truth", "bad.jsonl", "-o", "out.jsonl"],
                ""
            )),
            65
        );
        assert_eq!(fs::read_dir(&folder).unwrap().count(), 1);
    }
}

#[test]
fn bad_meshes_are_refused_with_file_and_line() {
    let folder = scratch("bad-meshes");
    for (content, message) in [
        (
            &b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n"[..],
            "bad.obj:4: face names vertex 4",
        ),
        (b"v 0 0 0\nv 1 0 nan\n", "bad.obj:2: "),
        (b"v 0 0 0\nv 1 0\n", "bad.obj:2: "),
        (b"v 0 0 0\nv \xff\xfe 0 0\n", "bad.obj:2: "),
        (b"", "bad.obj: "),
        (b"v 0 0 0\nv 1 0 0\nv 0 1 0\n", "bad.obj: "),
        (b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2\n", "bad.obj:4: "),
    ] {
        fs::write(folder.join("bad.obj"), content).unwrap();
        assert!(
            refused(&folder, &["audit", "--mesh", "bad.obj"], 65).contains(message),
            "{message}"
        );
    }
    assert!(refused(&folder, &["audit", "--mesh", "none.obj"], 74).contains("none.obj: "));
}

#[test]
fn a_mesh_and_a_corpus_are_audited() {
    let arguments = [
        "audit",
        "-n",
        "400",
        "--mesh",
        "corpora/meshes/needles.obj",
        "--corpus",
        "corpora/curated.jsonl",
        "--kernel",
        "woop-watertight",
        "--details",
    ];
    let output = hairline(&arguments);
    let table = text(&output.stdout);
    assert_eq!(code(&output), 0, "{}", text(&output.stderr));
    // The curated set holds more than 150 cases, and each is run.
    let record = json(&hairline(&[
        "audit",
        "--corpus",
        "corpora/curated.jsonl",
        "--format",
        "json",
    ]));
    let cases: u64 = record["result"]["sources"]
        .as_array()
        .unwrap()
        .iter()
        .map(|s| s["cases"].as_u64().unwrap())
        .sum();
    assert!(cases >= 150);
    // A finding on a mesh can be shown again.
    let mut lines = table
        .lines()
        .skip_while(|line| !line.starts_with("f32 false-"));
    let command = lines.find(|line| line.contains("hairline explain") && line.contains("--mesh"));
    let command = command.expect("a finding on the mesh");
    let words: Vec<&str> = command
        .split_whitespace()
        .skip(1)
        .map(|word| word.trim_matches('\''))
        .collect();
    let shown = text(&hairline(&words).stdout);
    assert!(shown.contains("FALSE-"), "{shown}");
}

#[test]
fn wrong_names_suggest_the_nearest_and_wrong_numbers_say_the_range() {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    for (arguments, message) in [
        (
            &["audit", "--kernel", "moler-trumbore"][..],
            "did you mean 'moller-trumbore'?",
        ),
        (
            &["audit", "--family", "edge-exat"],
            "did you mean 'edge-exact'?",
        ),
        (
            &["audit", "--epsilon", "paralel=0"],
            "did you mean 'parallel'?",
        ),
        (&["audit", "--epsilon", "parallel"], "is not GATE=VALUE"),
        (
            &["audit", "--epsilon-preset", "gdot"],
            "did you mean 'godot'?",
        ),
        (
            &[
                "audit",
                "--epsilon-preset",
                "godot",
                "--kernel",
                "moller-trumbore,cramer",
            ],
            "preset 'godot' refuses where !(t > e), and no gate of moller-trumbore is a 't'",
        ),
        (
            &["audit", "--contract", "closed-rai"],
            "did you mean 'closed-ray'?",
        ),
        (&["audit", "--format", "jsn"], "did you mean 'json'?"),
        (&["audit", "--scalar", "f16"], "unknown scalar 'f16'"),
        (&["audit", "--scale", "3"], "write 2^k"),
        (&["audit", "--offset", "1:2"], "write x:y:z"),
        (&["audit", "--threads", "0"], "not from 1"),
        (&["explain", "nonsense"], "is not a case id"),
        (
            &["explain", "edge-near@2/f32/-/1/3", "--kernel", "x"],
            "unknown kernel 'x'",
        ),
    ] {
        assert!(
            refused(here, arguments, 2).contains(message),
            "{arguments:?}: {}",
            refused(here, arguments, 2)
        );
    }
    assert_eq!(code(&hairline(&["audit", "--no-such-flag"])), 2);
    assert_eq!(code(&hairline(&[])), 2);
    assert_eq!(code(&hairline(&["--help"])), 0);
    let help = |words: &[&str]| text(&hairline(&[words, &["--help"]].concat()).stdout);
    // A band is listed where it means something.
    for (words, listed) in [
        (&["audit"][..], true),
        (&["check"], true),
        (&["epsilon"], true),
        (&["mesh"], false),
        (&["fuzz"], false),
        (&["fuzz", "triage"], false),
        (&["fuzz", "worst"], false),
    ] {
        let help = help(words);
        assert!(help.contains("Usage: hairline"), "{help}");
        assert_eq!(help.contains("--band"), listed, "{words:?}: {help}");
    }
    for count in ["0", "-5", "99999999999999999999"] {
        let output = hairline(&["audit", "--count", count]);
        let error = text(&output.stderr);
        assert!(
            code(&output) == 2 && error.contains("not a number of cases from 1"),
            "{error}"
        );
    }
}

#[test]
fn nothing_selected_bad_data_and_failed_output_have_codes_of_their_own() {
    let folder = scratch("codes");
    fs::write(folder.join("empty.jsonl"), "\n").unwrap();
    assert!(refused(&folder, &["audit", "--corpus", "empty.jsonl"], 4).contains("no case"));
    assert!(refused(&folder, &["truth", "empty.jsonl"], 4).contains("no cases"));
    fs::create_dir(folder.join("bare")).unwrap();
    assert!(refused(&folder, &["audit", "--corpus", "bare"], 4).contains("no .jsonl files"));
    assert!(refused(&folder, &["explain", "edge-near@9/f32/-/1/3"], 65).contains("version 9"));
    let unwritable = [
        "audit",
        "-n",
        "5",
        "--family",
        "tiny",
        "-o",
        "no/such/folder/file.txt",
    ];
    assert!(refused(&folder, &unwritable, 74).contains("no/such/folder/file.txt: "));
    assert!(refused(&folder, &["truth", "missing.jsonl"], 74).contains("missing.jsonl: "));
    assert!(
        refused(
            &folder,
            &["audit", "-n", "5", "--family", "tiny", "-o", "."],
            74
        )
        .contains("directory")
    );
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_reported_and_a_closed_pipe_is_no_error() {
    let arguments = ["audit", "-n", "5", "--family", "tiny", "-o", "/dev/full"];
    assert!(refused(Path::new("/"), &arguments, 74).contains("/dev/full: "));
    let mut child = Command::new(env!("CARGO_BIN_EXE_hairline"))
        .args(["corpus", "generate", "--family", "edge-near", "-n", "20000"])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    drop(child.stdout.take());
    let output = child.wait_with_output().unwrap();
    assert_eq!((code(&output), text(&output.stderr)), (0, String::new()));
}

#[test]
fn every_kernel_family_contract_and_preset_is_listed() {
    let list = |what: &str| {
        text(&hairline(&["list", what]).stdout)
            .split_whitespace()
            .collect::<Vec<_>>()
            .join(" ")
    };
    for entry in hairline::internals::kernel::KERNELS {
        assert!(list("kernels").contains(entry.info.name));
    }
    for family in hairline::internals::family::FAMILIES {
        assert!(
            list("families").contains(family.name) && list("families").contains(family.promise)
        );
    }
    assert!(list("contracts").contains("front-closed-ray"));
    assert!(list("presets").contains("three-mesh-bvh"));
}

#[test]
fn the_corpora_verify_and_a_changed_digest_does_not() {
    let folder = scratch("corpora");
    let corpora = Path::new(env!("CARGO_MANIFEST_DIR")).join("corpora");
    fs::create_dir_all(folder.join("made/meshes")).unwrap();
    for mesh in fs::read_dir(corpora.join("meshes")).unwrap() {
        let mesh = mesh.unwrap();
        fs::copy(
            mesh.path(),
            folder.join("made/meshes").join(mesh.file_name()),
        )
        .unwrap();
    }
    let stored = fs::read_to_string(corpora.join("manifest.jsonl")).unwrap();
    // Lines of meshes stay, those of sets are made again.
    let old: String = stored.split_inclusive('\n').skip(1).collect();
    fs::write(folder.join("made/manifest.jsonl"), old).unwrap();
    assert_eq!(
        code(&hairline_in(&folder, &["corpus", "generate", "made"], "")),
        0
    );
    let manifest = fs::read_to_string(folder.join("made/manifest.jsonl")).unwrap();
    assert_eq!(
        manifest, stored,
        "the committed manifest is the program's own"
    );
    let output = hairline(&["corpus", "verify"]);
    assert_eq!(code(&output), 0, "{}", text(&output.stderr));
    assert!(text(&output.stdout).contains("stored truths right"));
    fs::copy(
        corpora.join("curated.jsonl"),
        folder.join("made/curated.jsonl"),
    )
    .unwrap();
    fs::write(folder.join("made/meshes/torus.obj"), "v 0 0 0\n").unwrap();
    assert!(refused(&folder, &["corpus", "verify", "made"], 65).contains("manifest.jsonl:"));
    // A family that is new has no line yet.
    let others = stored.lines().filter(|line| !line.contains("\"noise\""));
    let others: Vec<&str> = others.collect();
    fs::write(folder.join("made/manifest.jsonl"), others.join("\n")).unwrap();
    let error = refused(&folder, &["corpus", "verify", "made"], 65);
    assert!(error.contains("no line for the family noise"), "{error}");
    fs::write(folder.join("empty.jsonl"), "").unwrap();
    let error = refused(&folder, &["corpus", "verify", "empty.jsonl"], 4);
    assert!(error.contains("empty.jsonl: no case to verify"), "{error}");
}

#[test]
fn generated_cases_carry_truths_that_verify() {
    let folder = scratch("generated");
    let made = hairline(&[
        "corpus", "generate", "--family", "fan", "--scalar", "f64", "-n", "30",
    ]);
    fs::write(folder.join("fan.jsonl"), &made.stdout).unwrap();
    let output = hairline_in(&folder, &["truth", "fan.jsonl"], "");
    assert_eq!(code(&output), 0, "{}", text(&output.stderr));
    assert!(text(&output.stdout).lines().count() >= 30 * 4);
}

#[test]
fn truths_are_those_of_the_definition_in_the_order_of_the_lines() {
    let folder = scratch("truth-order");
    let mut all = String::new();
    for family in [
        "coplanar",
        "degenerate",
        "edge-near",
        "range-ends",
        "invalid",
    ] {
        for scalar in ["f32", "f64"] {
            let flags = ["--family", family, "--scalar", scalar, "-n", "700"];
            let made = hairline(&[&["corpus", "generate"][..], &flags].concat());
            all += &text(&made.stdout);
        }
    }
    fs::write(folder.join("all.jsonl"), &all).unwrap();
    // Several blocks of lines.
    let run = |arguments: &[&str]| text(&hairline_in(&folder, arguments, "").stdout);
    let (fast, exact) = (
        run(&["truth", "all.jsonl"]),
        run(&["truth", "--exact", "all.jsonl"]),
    );
    assert!(5000 < fast.lines().count());
    for (fast, exact) in fast.lines().zip(exact.lines()) {
        let [fast, exact]: [serde_json::Value; 2] =
            [fast, exact].map(|line| serde_json::from_str(line).unwrap());
        for field in ["name", "class", "facing", "t", "feature", "hits_closed"] {
            assert_eq!(fast[field], exact[field], "{exact}");
        }
        assert_eq!(fast["contact"]["kind"], exact["contact"]["kind"], "{exact}");
    }
    // A wrong line stops where it stands, and names itself.
    fs::write(
        folder.join("all.jsonl"),
        all.replacen("\"scalar\":\"f64\"", "\"scalar\":\"f6\"", 1),
    )
    .unwrap();
    let output = hairline_in(&folder, &["truth", "all.jsonl"], "");
    let line = all
        .lines()
        .position(|line| line.contains("\"scalar\":\"f64\""))
        .unwrap()
        + 1;
    let error = text(&output.stderr);
    assert!(
        code(&output) == 65 && error.contains(&format!("all.jsonl:{line}: scalar: ")),
        "{error}"
    );
}

#[test]
fn explain_says_why_a_case_is_invalid_and_which_rows_fail_on_a_group() {
    let case = |ray: &str| {
        let case =
            format!("{{\"scalar\":\"f32\",{ray},\"a\":[0,0,0],\"b\":[1,0,0],\"c\":[0,1,0]}}");
        let output = hairline(&["explain", &case, "--kernel", "moller-trumbore"]);
        assert_eq!(code(&output), 0, "{}", text(&output.stderr));
        text(&output.stdout)
    };
    let start = "\"origin\":[0.25,0.25,1]";
    for (ray, reason) in [
        (
            "\"origin\":[0.25,\"nan\",1],\"direction\":[0,0,-1]".to_owned(),
            "a coordinate is NaN",
        ),
        (
            format!("{start},\"direction\":[0,0,\"-inf\"]"),
            "a coordinate is infinite",
        ),
        (
            format!("{start},\"direction\":[0,0,-0.0]"),
            "the direction is 0",
        ),
        (
            format!("{start},\"direction\":[0,0,-1],\"t_max\":\"nan\""),
            "t_min or t_max is NaN",
        ),
        (
            format!("{start},\"direction\":[0,0,-1],\"t_min\":2,\"t_max\":1"),
            "t_min is greater than t_max",
        ),
    ] {
        let screen = case(&ray);
        assert!(
            screen.contains(&format!("\ntruth  invalid: {reason}\n")),
            "{screen}"
        );
    }
    assert!(case("\"origin\":[\"nan\",0,1],\"direction\":[0,0,-1]").contains("passes at every e"));
    let output = hairline(&["explain", "shared-edge@3/f32/-/1/5"]);
    let screen = text(&output.stdout);
    let (title, rest) = screen.split_once("\n\n").unwrap();
    let wrong = title.split(' ').next().unwrap().parse::<usize>().unwrap();
    assert!(title.ends_with("together.") && 2 < wrong, "{title}");
    let lines: Vec<&str> = rest.lines().skip(1).take(9).collect();
    let is_wrong = |line: &&str| line.ends_with(": CRACK") || line.ends_with(": DOUBLE");
    assert_eq!(
        lines.iter().filter(|line| is_wrong(line)).count(),
        wrong.min(8),
        "{screen}"
    );
    assert_eq!(lines[8], "13 more rows: --details");
}

#[test]
fn exact_margins_are_right_where_a_factor_leaves_the_range_of_f64() {
    let explain = |case: &str| {
        let arguments = [
            "explain",
            case,
            "--kernel",
            "plane-unit-normal",
            "--format",
            "json",
        ];
        let output = hairline(&arguments);
        assert_eq!(code(&output), 0, "{}", text(&output.stderr));
        json(&output)["triangles"][0]["rows"][0]["gates"].clone()
    };
    let exact = |gates: &serde_json::Value, name: &str| {
        let gate = gates
            .as_array()
            .unwrap()
            .iter()
            .find(|gate| gate["gate"] == name)
            .unwrap();
        gate["exact"].as_str().unwrap().to_owned()
    };
    // The normal has length 1e-320, a double with few digits, and n·d is still 1.
    let case = r#"{"scalar":"f64","origin":[0,0,1],"direction":[0,0,-1],"a":[0,0,0],"b":[1e-160,0,0],"c":[0,1e-160,0]}"#;
    assert_eq!(exact(&explain(case), "parallel"), "1.000000e0");
    // One of `range-ends`.
    let out = explain(
        r#"{"scalar":"f64","origin":[0,1.307417906300652e-147,9.357568648109375e-129],"direction":[-2.010587294856603e68,1.2786583404417773e-26,-9.357568648109375e-129],"a":[-2.010587294856603e68,1.2786583404417773e-26,4.278987726543438e-183],"b":[7.135326654204777e-221,-2.2667036188029826e212,6.997413646268349e274],"c":[-1.0055630559043359e-44,6.4704406234944485e-93,-2.696317217341118e-112]}"#,
    );
    let all: Vec<String> = ["parallel", "t", "edge"]
        .iter()
        .map(|gate| exact(&out, gate))
        .collect();
    assert!(all.iter().any(|exact| exact == "6.470441e-93"), "{all:?}");
    assert!(all.iter().all(|exact| exact != "NaN"), "{all:?}");
    // The product of two edges is beyond the doubles.
    let wide = case
        .replace("1e-160", "1e200")
        .replace("[0,0,1]", "[1e199,1e199,1]");
    let out = explain(&wide);
    assert!(exact(&out, "edge").ends_with("e399"), "{out}");
}

#[test]
fn explain_shows_on_which_side_of_the_epsilon_a_margin_lies() {
    // The determinant is 2.9955555e-19, whose first seven digits are below it.
    let case = r#"{"scalar":"f32","origin":[0,0,1],"direction":[0,0,-1],"a":[0,0,0],"b":[2.9955555e-19,0,0],"c":[0,1,0]}"#;
    let parallel = |kernel: &str, epsilon: &str| {
        let epsilon = format!("parallel={epsilon}");
        let out =
            text(&hairline(&["explain", case, "--kernel", kernel, "--epsilon", &epsilon]).stdout);
        out.lines()
            .find(|line| line.starts_with("parallel"))
            .expect("a gate")
            .to_owned()
    };
    for (kernel, epsilon, expected) in [
        (
            "moller-trumbore",
            "2.9955555e-19",
            "2.9955555e-19 2.9955555e-19 2.9955555e-19 passes",
        ),
        (
            "moller-trumbore",
            "2.9955552e-19",
            "2.99555549e-19 2.99555549e-19 2.9955552e-19 passes",
        ),
        // A gate that refuses x <= e accepts what is below x.
        (
            "cramer",
            "2.9955555e-19",
            "2.995555e-19 below 2.9955555e-19 2.9955555e-19 refuses",
        ),
        (
            "moller-trumbore",
            "1e-6",
            "2.995555e-19 2.995555e-19 1e-6 ref",
        ),
    ] {
        let line = parallel(kernel, epsilon);
        let words = line.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(words.contains(expected), "{expected}: {line}");
    }
}

#[test]
fn a_stored_case_is_explained_by_name_and_a_given_one_by_its_json() {
    let named = hairline(&[
        "explain",
        "front-edge_ab-within",
        "--corpus",
        "corpora",
        "--kernel",
        "scalar-triple-two-sided",
        "--contract",
        "closed-line",
    ]);
    assert!(
        text(&named.stdout).contains("FALSE-MISS"),
        "{}",
        text(&named.stdout)
    );
    let given = hairline(&["explain", CASE, "--kernel", "moller-trumbore"]);
    assert!(
        text(&given.stdout).contains("edge_ab"),
        "{}",
        text(&given.stderr)
    );
    let group =
        text(&hairline(&["explain", "shared-edge@3/f32/-/1/3", "--kernel", "plucker"]).stdout);
    assert!(group.contains("triangle 1 of 2"), "{group}");
}

#[test]
fn the_readme_lists_the_exit_codes_of_the_program() {
    let readme =
        fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("README.md")).unwrap();
    use hairline::internals::cli::Status;
    for status in [
        Status::Success,
        Status::Disagreements,
        Status::Usage,
        Status::Stale,
        Status::NothingSelected,
        Status::BadInput,
        Status::SelfCheck,
        Status::InputOutput,
    ] {
        let row = format!("| {} |", status as u8);
        assert!(readme.contains(&row), "{row}");
    }
}

#[test]
fn the_record_says_why_how_far_and_how_accurately_and_a_band_frees() {
    let audit = |more: &[&str]| {
        let arguments = [
            "audit",
            "-n",
            "2000",
            "--scalar",
            "f32",
            "--kernel",
            "woop-watertight",
        ];
        let rest = ["--family", "edge-near", "--format", "json", "--quiet"];
        json(&hairline(&[&arguments[..], &rest, more].concat()))
    };
    let record = audit(&[]);
    let result = &record["result"]["results"][0];
    let finding = &result["findings"][0];
    assert_eq!(
        finding["causes"]["by"]["rounding"]["rate"], 1.0,
        "{finding}"
    );
    let severity = &record["result"]["totals"][0]["severity"]["false-miss"];
    let [median, worst] = ["median", "worst"].map(|key| severity["ulps"][key].as_f64().unwrap());
    assert!(0.0 < median && median < worst && worst < 10.0, "{severity}");
    assert_eq!(
        severity["ulps"]["count"],
        result["total"]["false_misses"]["count"]
    );
    let t = &result["accuracy"]["t"];
    assert!(
        t["count"].as_u64().unwrap() > 20 && t["median"].as_f64().unwrap() < 4.0,
        "{t}"
    );
    assert!(
        audit(&["--attribute", "0"])["result"]["results"][0]["findings"][0]["causes"].is_null()
    );
    // A band as wide as the worst finding leaves none, and makes cases free.
    let banded = audit(&["--band", "10ulps"]);
    let total = &banded["result"]["results"][0]["total"];
    assert_eq!(total["false_misses"]["count"], 0, "{total}");
    assert!(total["free"].as_u64().unwrap() > result["total"]["free"].as_u64().unwrap());
    let error = refused(Path::new("."), &["audit", "--band", "wide"], 2);
    assert!(error.contains("'wide' is not a band"), "{error}");
}
