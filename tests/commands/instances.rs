//! Runs on instances: what the rounded inverse of a matrix costs, and that every printed command shows it again.

use crate::json_schema;
use crate::program;

use program::{ends, flat, result_bytes, scratch};
use serde_json::Value;
use std::fs;
use std::path::Path;

const IDENTITY: &str = "1 0 0 0  0 1 0 0  0 0 1 0";
/// A rotation about two axes; its numbers are rounded.
const TURNED: &str = "0.36 0.48 -0.8 0  -0.8 0.6 0 0  0.48 0.64 0.6 0";
/// The same, and far off.
const FAR: &str = "0.36 0.48 -0.8 1e6  -0.8 0.6 0 0  0.48 0.64 0.6 0";

fn audited(folder: &Path, more: &[&str]) -> Value {
    let common = [
        "audit",
        "-q",
        "-n",
        "1000",
        "--attribute",
        "20",
        "--format",
        "json",
    ];
    serde_json::from_str(&ends(folder, &[&common, more].concat(), 0).0).unwrap()
}

/// The sum of a count over results.
fn sum(record: &Value, kernel: &str, pointer: &str) -> u64 {
    let results = record["result"]["results"].as_array().unwrap();
    let of_kernel = results.iter().filter(|result| result["kernel"] == kernel);
    of_kernel
        .filter_map(|result| result.pointer(pointer)?.as_u64())
        .sum()
}

#[test]
fn the_identity_changes_no_verdict_and_no_truth() {
    let folder = scratch("instances-identity");
    // NaN and infinity do not survive a matrix: `invalid` is left out.
    let families = "interior,edge-exact,edge-near,vertex-near,coplanar,parallel-off,grazing,origin-on,secondary-ray,\
                    interval-ends,mixed-scale,range-ends,degenerate,shared-edge,fan,polygon";
    let flags = [
        "-k",
        "moller-trumbore,woop-watertight,convex-polygon",
        "-f",
        families,
    ];
    let plain = audited(&folder, &flags);
    let placed = audited(&folder, &[&flags[..], &["--instance", IDENTITY]].concat());
    let counts = |record: &Value| -> Vec<Value> {
        let results = record["result"]["results"].as_array().unwrap().iter();
        let of_classes = |result: &Value| -> Vec<Value> {
            let classes = result["classes"].as_object().unwrap().values();
            let names = ["cases", "free", "hits", "false_misses", "false_hits"];
            classes
                .flat_map(|class| names.map(|name| class[name].clone()))
                .collect()
        };
        let of_groups = |result: &Value| -> Vec<Value> {
            let names = [
                "cracks",
                "doubles",
                "odd_folds",
                "crack_digest",
                "double_digest",
            ];
            let polygons = [
                &result["polygons"]["false_misses"],
                &result["polygons"]["false_hits"],
            ];
            let groups = names.map(|name| result["across"][name].clone());
            groups
                .into_iter()
                .chain(polygons.map(Value::clone))
                .collect()
        };
        results
            .flat_map(|result| [of_classes(result), of_groups(result)].concat())
            .collect()
    };
    assert_eq!(counts(&plain), counts(&placed));
    // Values are not judged there, and so none is right.
    let values = [&plain, &placed].map(|it| sum(it, "moller-trumbore", "/total/wrong_values/of"));
    assert!(0 < values[0] && values[1] == 0, "{values:?}");
    assert!(0 < sum(&plain, "moller-trumbore", "/across/cracks/count"));
    assert!(0 < sum(&plain, "convex-polygon", "/polygons/false_misses/of"));
    assert_ne!(
        plain["result"]["plan"]["hash"],
        placed["result"]["plan"]["hash"]
    );
}

#[test]
fn a_turned_instance_costs_hits_and_a_far_one_cracks() {
    let folder = scratch("instances-cost");
    let at = |matrix: &str| {
        let kernels = [
            "-k",
            "moller-trumbore,woop-watertight",
            "-f",
            "edge-near,shared-edge",
        ];
        audited(
            &folder,
            &[&kernels[..], &["--scalar", "f32", "--instance", matrix]].concat(),
        )
    };
    let [plain, turned, far] = [IDENTITY, TURNED, FAR].map(at);
    for kernel in ["moller-trumbore", "woop-watertight"] {
        let [a, b, c] =
            [&plain, &turned, &far].map(|record| sum(record, kernel, "/total/false_misses/count"));
        assert!(3 * a < 2 * b && b < c, "{kernel}: {a} {b} {c}");
    }
    let cracks = [&plain, &turned, &far]
        .map(|record| sum(record, "woop-watertight", "/across/cracks/count"));
    assert!(cracks[..2] == [0, 0] && 0 < cracks[2], "{cracks:?}");
    // Of what the watertight kernel gets wrong far off the inverse is the cause.
    let findings = far["result"]["results"][1]["findings"].as_array().unwrap();
    let by = &findings[0]["causes"]["by"]["transform"];
    assert!(0.9 < by["rate"].as_f64().unwrap(), "{by}");
}

#[test]
fn every_printed_command_shows_what_was_found() {
    let folder = scratch("instances-replay");
    let case = r#"{"scalar":"f32","origin":[999500.06,0.3,70],"direction":[7,1,-3],"a":[0,0,0],"b":[600,0,0],"c":[0,900,0]}"#;
    let cases: String = (0..40)
        .map(|i| case.replace("0.3", &format!("{}.3", 9 * i)) + "\n")
        .collect();
    fs::write(folder.join("c.jsonl"), cases).unwrap();
    let flags = [
        "-k",
        "woop-watertight",
        "-f",
        "edge-near,shared-edge,secondary-ray",
        "--instance",
        FAR,
    ];
    let record = audited(&folder, &[&flags[..], &["--corpus", "c.jsonl"]].concat());
    let (mut shown, mut sources) = (0, Vec::new());
    for result in record["result"]["results"].as_array().unwrap() {
        for finding in result["findings"].as_array().unwrap() {
            for example in finding["first"].as_array().unwrap() {
                let command = example["command"].as_str().unwrap();
                let words = shell_words(command.strip_prefix("hairline ").unwrap());
                let words: Vec<&str> = words.iter().map(String::as_str).collect();
                let screen = flat(&ends(&folder, &words, 0).0);
                let name = finding["finding"].as_str().unwrap().to_uppercase();
                assert!(
                    screen.contains(&format!(
                        "wrong there: woop-watertight (edge=0,parallel=0,t=0) {name}"
                    )),
                    "{command}\n{screen}"
                );
                // The bits are those that the kernel got, which the screen has too if there is room.
                let bits = example["bits"].as_str().unwrap();
                let origin = bits
                    .split_whitespace()
                    .next()
                    .unwrap()
                    .trim_start_matches("o=");
                let is_shown = screen.contains(&origin.replace(',', " "));
                assert!(is_shown || result["scalar"] == "f64", "{bits}\n{screen}");
                shown += 1;
                sources.push(result["family"].as_str().unwrap().to_owned());
            }
        }
    }
    sources.dedup();
    assert!(20 < shown && sources.len() > 4, "{shown} {sources:?}");
    // A group is judged in the world too.
    let results = record["result"]["results"].as_array().unwrap().iter();
    let groups = results.filter_map(|result| result["across"]["first_cracks"].as_array());
    let ids: Vec<&str> = groups.flatten().filter_map(Value::as_str).collect();
    for id in &ids {
        let screen = ends(&folder, &["explain", id, "-k", "woop-watertight"], 0).0;
        assert!(
            flat(&screen).contains("one hit is right: CRACK"),
            "{screen}"
        );
    }
    assert!(!ids.is_empty());
}

/// The words of a command, quotes taken off.
fn shell_words(line: &str) -> Vec<String> {
    let (mut words, mut quoted) = (vec![String::new()], false);
    for c in line.chars() {
        match c {
            '\'' => quoted = !quoted,
            ' ' if !quoted => words.push(String::new()),
            c => words.last_mut().unwrap().push(c),
        }
    }
    words
}

#[test]
fn shards_of_an_instance_merge_to_the_whole_and_a_check_is_held_to_it() {
    let folder = scratch("instances-shards");
    fs::write(
        folder.join("m.obj"),
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0.5\nf 1 2 3\nf 2 4 3\n",
    )
    .unwrap();
    let case = r#"{"scalar":"f64","origin":[1,0,1],"direction":[0,0,-1],"a":[0,0,0],"b":[2,0,0],"c":[0,2,0]}"#;
    fs::write(folder.join("c.jsonl"), case).unwrap();
    let plan = [
        "-k",
        "moller-trumbore,woop-watertight",
        "-f",
        "edge-near,fan",
        "--mesh",
        "m.obj",
        "--corpus",
        "c.jsonl",
        "-n",
        "1500",
        "-q",
        "--instance",
        FAR,
    ];
    let audit = |more: &[&str]| {
        ends(
            &folder,
            &[&["audit", "--format", "json"], &plan[..], more].concat(),
            0,
        );
    };
    audit(&["-o", "whole.json"]);
    for k in ["0", "1"] {
        audit(&["--shard", &format!("{k}/2"), "-o", &format!("{k}.json")]);
    }
    ends(
        &folder,
        &[
            "merge",
            "0.json",
            "1.json",
            "--format",
            "json",
            "-o",
            "merged.json",
        ],
        0,
    );
    let whole = result_bytes(&folder.join("whole.json"));
    assert_eq!(whole, result_bytes(&folder.join("merged.json")));
    // A part of another instance is no part of it.
    let other = [
        &["audit", "--format", "json"],
        &plan[..12],
        &[TURNED, "--shard", "1/2", "-o", "1.json"],
    ]
    .concat();
    ends(&folder, &other, 0);
    ends(
        &folder,
        &["merge", "0.json", "1.json", "--format", "json"],
        65,
    );
    // The flags of the record make it again.
    let text = fs::read_to_string(folder.join("whole.json")).unwrap();
    let record: Value = serde_json::from_str(&text).unwrap();
    let sources = record["provenance"]["plan_flags"]["sources"]
        .as_str()
        .unwrap();
    assert!(
        sources.ends_with(&format!("--instance '{FAR}'")),
        "{sources}"
    );
    // A baseline is of its instance.
    let toml = format!(
        "kernel = [\"woop-watertight\"]\nfamily = [\"edge-near\"]\ncount = 300\ninstance = \"{FAR}\"\n"
    );
    fs::write(folder.join("hairline.toml"), toml).unwrap();
    ends(&folder, &["check", "-q", "--bless"], 0);
    ends(&folder, &["check", "-q"], 0);
    let (out, _) = ends(&folder, &["check", "-q", "--instance", IDENTITY], 3);
    assert!(flat(&out).contains("which is of other cases"), "{out}");
}

#[test]
fn an_audit_says_that_it_is_of_an_instance() {
    let folder = scratch("instances-said");
    let placed = [
        "audit",
        "-q",
        "-n",
        "50",
        "-k",
        "cramer,plucker",
        "--instance",
        FAR,
    ];
    let stored = Path::new(env!("CARGO_MANIFEST_DIR")).join("corpora/curated.jsonl");
    for cases in [
        ["-f", "interior,fan"],
        ["--corpus", stored.to_str().unwrap()],
    ] {
        let text = flat(&ends(&folder, &[&placed[..], &cases].concat(), 0).0);
        assert!(text.contains(" in an instance, "), "{text}");
        let text = flat(&ends(&folder, &[&placed[..6], &cases].concat(), 0).0);
        assert!(!text.contains(" in an instance, "), "{text}");
    }
}

#[test]
fn a_mesh_leaks_far_off_and_says_that_it_is_an_instance() {
    let folder = scratch("instances-mesh");
    let file = format!(
        "{}/corpora/meshes/icosphere.obj",
        env!("CARGO_MANIFEST_DIR")
    );
    let matrix = |more: &[&str]| {
        let flags = [
            "mesh",
            &file,
            "-q",
            "-k",
            "woop-watertight",
            "--format",
            "json",
        ];
        let out = ends(&folder, &[&flags[..], more].concat(), 0).0;
        let record: Value = serde_json::from_str(&out).unwrap();
        record["result"]["plan"]["sources"][0]["set"].to_string()
    };
    assert!(!matrix(&[]).contains("instance"));
    assert!(matrix(&["--instance", IDENTITY]).contains(",instance=1e0:0e0:0e0:0e0:"));
    let screen = |matrix| {
        let flags = [
            "mesh",
            &file,
            "-q",
            "-k",
            "woop-watertight",
            "--instance",
            matrix,
        ];
        flat(&ends(&folder, &flags, 0).0)
    };
    let (near, far) = (screen(TURNED), screen(FAR));
    assert!(
        near.contains("at each edge and vertex of an instance, seed 1"),
        "{near}"
    );
    assert!(near.contains("where a ray crosses: kept"), "{near}");
    assert!(far.contains("where a ray crosses: BROKEN"), "{far}");
}

#[test]
fn what_takes_no_instance_says_so() {
    let folder = scratch("instances-refused");
    let singular = "1 2 3 0  4 5 6 0  7 8 9 0";
    for command in [
        &["audit", "-f", "interior"][..],
        &["check", "-f", "interior"],
        &["mesh", "m.obj"],
    ] {
        let error = ends(&folder, &[command, &["--instance", singular]].concat(), 2).1;
        let scalar = "f32";
        let expected = format!(
            "hairline: --instance: the matrix is singular in {scalar}: it has no inverse\n"
        );
        assert_eq!(error, expected, "{command:?}");
    }
    let error = ends(&folder, &["epsilon", "--instance", IDENTITY], 2).1;
    assert!(
        error.contains("unexpected argument '--instance' found"),
        "{error}"
    );
    let id = "edge-near@2/f32/instance=1e0:0e0:0e0:0e0:0e0:1e0:0e0:0e0:0e0:0e0:1e0:0e0/1/5";
    for command in [
        &["fuzz", "shrink", id][..],
        &["map", "--kernel", "plucker", id],
    ] {
        let error = ends(&folder, command, 2).1;
        assert!(
            error.ends_with("is a case of an instance: only `explain` takes it\n"),
            "{error}"
        );
    }
    let error = ends(&folder, &["explain", id, "--instance", IDENTITY], 2).1;
    assert!(
        error.contains("the case's id has an instance of its own"),
        "{error}"
    );
    let bad = id.replace("1e0:0e0/1/5", "1e0/1/5");
    let error = ends(&folder, &["explain", &bad], 2).1;
    assert!(
        error.contains("is no instance: write 12 numbers"),
        "{error}"
    );
    let bad = id.replace("1e0:0e0/1/5", "0e0:0e0/1/5");
    let error = ends(&folder, &["explain", &bad], 2).1;
    assert!(error.contains("the matrix is singular in f32"), "{error}");
}

#[test]
fn new_rays_leave_the_exact_plane_of_an_instance() {
    let folder = scratch("instances-offset");
    let schemes = [
        "--scene",
        "unit,plane=generic",
        "--scheme",
        "normal=1e-6,normal=1e-4,pbrt-v4",
    ];
    let new_rays = |more: &[&str]| -> Value {
        let flags = ["offset", "-q", "-n", "2000", "--format", "json"];
        json_schema::result(&ends(&folder, &[&flags[..], &schemes, more].concat(), 0).0)
    };
    let plain = new_rays(&[]);
    let counts = |record: &Value| {
        let of_scheme = |scheme: &Value| {
            let names = [
                "wrong",
                "self_hits",
                "height_in_edges",
                "height_in_ulps",
                "over_least",
            ];
            names.map(|name| scheme[name].clone())
        };
        let of_points = |points: &Value| -> Vec<Value> {
            let schemes = points["schemes"]
                .as_array()
                .unwrap()
                .iter()
                .flat_map(of_scheme);
            schemes
                .chain([points["least"].clone(), points["hits"].clone()])
                .collect()
        };
        record["points"]
            .as_array()
            .unwrap()
            .iter()
            .flat_map(of_points)
            .collect::<Vec<_>>()
    };
    assert_eq!(counts(&plain), counts(&new_rays(&["--instance", IDENTITY])));
    // Turned inside out without rounding, every start is as high over the front or the back as before.
    let mirrored = new_rays(&["--instance", "-1 0 0 0  0 1 0 0  0 0 1 0"]);
    for (i, scheme) in plain["points"][1]["schemes"]
        .as_array()
        .unwrap()
        .iter()
        .enumerate()
    {
        let other = &mirrored["points"][1]["schemes"][i];
        assert_eq!(scheme["wrong"], other["wrong"]);
        assert_eq!(scheme["height_in_edges"], other["height_in_edges"]);
    }
    // Far off most offsets of a millionth are too small, and some starts that are right are not so for the object.
    let turned = "0.36 0.48 -0.8 1000  -0.8 0.6 0 0  0.48 0.64 0.6 0";
    let far = new_rays(&["--instance", turned]);
    let of = |record: &Value, i: usize, name: &str| {
        record["points"][0]["schemes"][i][name]["count"]
            .as_u64()
            .unwrap()
    };
    assert!(of(&plain, 0, "wrong") < 10 && 400 < of(&far, 0, "wrong"));
    assert!(of(&far, 2, "wrong") == 0 && 10 < of(&far, 2, "self_hits"));
    // The first wrong start is shown in the world by its command, and so is the first ray by its id.
    let wrong = &far["points"][0]["schemes"][0]["first_wrong"];
    let command = wrong["explain"].as_str().unwrap();
    let words = shell_words(command.strip_prefix("hairline ").unwrap());
    let words: Vec<&str> = words.iter().map(String::as_str).collect();
    let screen = flat(&ends(&folder, &words, 0).0);
    let world = screen.split(" world ").nth(1).unwrap();
    assert!(!world.contains("t before"), "{world}");
    let id = wrong["first_ray"].as_str().unwrap();
    assert!(flat(&ends(&folder, &["explain", id, "-k", "plucker"], 0).0).contains(" world "));
    let error = ends(
        &folder,
        &["offset", "--instance", "0 0 0 0 0 0 0 0 0 0 0 0"],
        2,
    )
    .1;
    assert!(
        error.starts_with("hairline: --instance: the matrix is singular in f32"),
        "{error}"
    );
}
