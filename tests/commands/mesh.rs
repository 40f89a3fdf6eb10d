//! `hairline mesh` as a user runs it: output, files for viewers, exit codes, bad input.

use crate::json_schema;
use crate::program;

use program::{at_mesh, ends, flat, hairline, result_bytes, scratch};
use serde_json::Value;
use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

fn model(name: &str) -> String {
    format!("{}/corpora/meshes/{name}.obj", env!("CARGO_MANIFEST_DIR"))
}

fn record(folder: &Path, arguments: &[&str]) -> Value {
    let mut all = vec!["mesh", "--format", "json", "--quiet"];
    all.extend(arguments);
    serde_json::from_str(&ends(folder, &all, 0).0).unwrap()
}

/// A folder with an OBJ file.
fn with_obj(name: &str, text: &str) -> PathBuf {
    let folder = scratch(name);
    fs::write(folder.join("a.obj"), text).unwrap();
    folder
}

#[test]
fn the_table_says_what_the_mesh_is_and_where_rays_slip_through() {
    let folder = scratch("mesh-table");
    let file = model("torus");
    let arguments = ["mesh", &file, "--kernel", "moller-trumbore,woop-watertight"];
    let (out, error) = ends(&folder, &arguments, 0);
    for line in [
        "faces     2,304 sound",
        "edges     3,456 between two faces",
        "vertices  1,152 inside a closed fan",
        "          a closed surface, wound consistently",
        "aimed     27,648 rays at edges, 9,216 at vertices, in f32 (1,152 points)",
    ] {
        assert!(out.lines().any(|other| other == line), "{line}\n{out}");
    }
    let is_text = |line: &&str| !line.contains("hairline ");
    assert!(
        out.lines()
            .filter(is_text)
            .all(|line| line.chars().count() <= 80),
        "{out}"
    );
    assert!(out.lines().count() <= 40, "{out}");
    let (all, _) = ends(&folder, &[&arguments[..], &["--details"]].concat(), 0);
    assert!(
        all.contains("\nwoop-watertight (source): nowhere\n"),
        "{all}"
    );
    assert!(
        error.contains("2 kernel rows on 2 sources of cases in f32: 36,864 rays"),
        "{error}"
    );
    // The first crack is shown again by its command.
    let command = out
        .lines()
        .find_map(|line| line.strip_prefix("shown by: hairline "));
    let words: Vec<&str> = command.unwrap().split_whitespace().collect();
    let words: Vec<&str> = words.iter().map(|word| word.trim_matches('\'')).collect();
    let shown = ends(&folder, &words, 0).0;
    let first = "moller-trumbore (edge=0,parallel=1e-6) f32, all triangles together: 0 of 2 triangles hit; one hit is right: \
                 CRACK; right here: ";
    assert!(flat(&shown).starts_with(first), "{shown}");
}

#[test]
fn a_hit_that_a_neighbour_reports_is_shown_apart() {
    let folder = scratch("mesh-elsewhere");
    let file = model("heightfield");
    let arguments = ["mesh", &file, "--kernel", "woop-watertight", "--details"];
    let (out, _) = ends(&folder, &arguments, 0);
    assert!(
        out.lines().any(|line| line.ends_with(" elsewhere")),
        "{out}"
    );
    let first = out
        .lines()
        .position(|line| line.trim_start().starts_with("elsewhere, "));
    let command = out.lines().nth(first.unwrap() + 1).unwrap();
    let words: Vec<&str> = command.split_whitespace().skip(1).collect();
    let words: Vec<&str> = words.iter().map(|word| word.trim_matches('\'')).collect();
    let shown = ends(&folder, &words, 0).0;
    let first = "woop-watertight (edge=0,parallel=0,t=0) f32, all triangles together: 0 of 2 triangles hit; one hit is right, \
                 and rounding may";
    assert!(flat(&shown).starts_with(first), "{shown}");
    let record = record(&folder, &[&file, "--kernel", "woop-watertight"]);
    let sum = |what: &str| -> u64 {
        let count = |part: &str| {
            let across = at_mesh(&record, "f32", "woop-watertight", part);
            across[what]["count"].as_u64().unwrap()
        };
        count("edges") + count("vertices")
    };
    assert_eq!([sum("cracks"), sum("elsewhere")], [0, 1]);
}

#[test]
fn the_record_does_not_depend_on_threads_and_holds_every_crack_that_is_wanted() {
    let folder = scratch("mesh-threads");
    let file = model("icosphere");
    let run = |threads: &str| {
        let mut arguments = vec![
            "mesh",
            &file,
            "--kernel",
            "moller-trumbore",
            "--threads",
            threads,
            "--quiet",
        ];
        arguments.extend([
            "--scalar",
            "f32,f64",
            "--format",
            "json",
            "--examples",
            "100000",
        ]);
        let name = format!("{threads}.json");
        ends(&folder, &[&arguments[..], &["-o", &name]].concat(), 0);
        folder.join(name)
    };
    let json = run("1");
    assert_eq!(result_bytes(&json), result_bytes(&run("3")));

    let text = fs::read_to_string(&json).unwrap();
    let result: Value = json_schema::result(&text);
    let record: Value = serde_json::from_str(&text).unwrap();
    let places = &result["mesh"]["places"];
    for (name, ends, least) in [("edges", 2, 100), ("vertices", 1, 10)] {
        let mut cracked = 0;
        for scalar in ["f32", "f64"] {
            let part = at_mesh(&record, scalar, "moller-trumbore", name);
            let classes = part["classes"].as_object().unwrap().values();
            let cracks: Vec<&Value> = classes
                .flat_map(|class| class["first_cracks"].as_array().unwrap())
                .collect();
            assert_eq!(part["cracks"]["count"], cracks.len());
            let points = |crack: &&Value| &places[crack.as_str().unwrap()]["points"];
            assert!(
                cracks
                    .iter()
                    .all(|crack| points(crack).as_array().unwrap().len() == ends)
            );
            let cracked_places: BTreeSet<String> = cracks
                .iter()
                .map(|crack| points(crack).to_string())
                .collect();
            assert_eq!(part["leaking"]["count"], cracked_places.len());
            cracked += cracked_places.len();
        }
        assert!(cracked > least, "{cracked} {name}");
    }
}

#[test]
fn what_cannot_be_asked_is_reported_with_its_line() {
    // A cube's side and what meshes have: three faces on an edge, a copy, a needle without area.
    let text = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 0 0 -1\nv 2 0 0\n\
                f 1 2 3\nf 1 3 4\nf 1 3 5\nf 1 2 6\nf 2 1 6\nf 1 2 7\n";
    let folder = with_obj("mesh-odd", text);
    let (out, error) = ends(&folder, &["mesh", "a.obj", "--kernel", "cramer"], 4);
    let out = flat(&out);
    assert!(out.starts_with("Nothing to ask of a.obj "), "{out}");
    assert!(out.contains("1 without area (first at line 13)"), "{out}");
    assert!(out.contains("2 duplicated (first at line 11)"), "{out}");
    assert!(out.contains("1 non-manifold (first at line 8)"), "{out}");
    assert!(error.contains("nothing to ask"), "{error}");
}

#[test]
fn one_triangle_and_faces_without_area_ask_nothing() {
    for (name, text, word) in [
        ("mesh-one", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "3 open"),
        (
            "mesh-flat",
            "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\nf 2 1 3\n",
            "2 without area",
        ),
        (
            "mesh-far",
            "v 0 0 0\nv 1e39 0 0\nv 0 1 0\nf 1 2 3\n",
            "1 out of range",
        ),
    ] {
        let folder = with_obj(name, text);
        let (out, error) = ends(&folder, &["mesh", "a.obj"], 4);
        assert!(out.contains(word), "{out}");
        assert!(error.contains("hairline: a.obj: nothing to ask"), "{error}");
        assert!(!error.contains("panicked"));
        // A CI reads one document, which says that there is nothing.
        let (out, _) = ends(&folder, &["mesh", "a.obj", "-q", "--format", "junit"], 4);
        assert_eq!(out.matches("<?xml").count(), 1, "{out}");
    }
}

#[test]
fn bad_input_ends_with_its_exit_code() {
    for (name, text, message) in [
        ("mesh-empty", "", "a.obj: "),
        (
            "mesh-nan",
            "v 0 0 nan\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
            "a.obj:1: ",
        ),
        (
            "mesh-index",
            "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n",
            "a.obj:4: ",
        ),
    ] {
        let (_, error) = ends(&with_obj(name, text), &["mesh", "a.obj"], 65);
        assert!(error.contains(message), "{error}");
    }
    let folder = with_obj(
        "mesh-usage",
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 1\nf 1 2 3\nf 2 1 4\n",
    );
    let refused = |arguments: &[&str], code: i32, message: &str| {
        let mut all = vec!["mesh"];
        all.extend(arguments);
        let (out, error) = ends(&folder, &all, code);
        assert!(
            error.contains(message) && out.is_empty(),
            "{arguments:?}: {error}"
        );
    };
    refused(&["missing.obj"], 74, "missing.obj");
    refused(&["."], 74, "directory");
    refused(
        &["a.obj", "--directions", "0"],
        2,
        "'0' for '--directions <N>': 0 is not in 1..=65536",
    );
    refused(
        &["a.obj", "--directions", "-1"],
        2,
        "'-1' for '--directions <N>'",
    );
    refused(
        &["a.obj", "--direction", "up"],
        2,
        "[possible values: unit]",
    );
    refused(
        &["a.obj", "--band", "4ulps"],
        2,
        "--band: every ray goes to an edge or a vertex",
    );
    refused(
        &["a.obj", "--kernel", "moler-trumbore"],
        2,
        "did you mean 'moller-trumbore'?",
    );
    refused(&["a.obj", "--format", "stl"], 2, "unknown format 'stl'");
    refused(
        &["a.obj", "--format", "json,text"],
        2,
        "2 formats but 0 outputs",
    );
    refused(&["a.obj", "--threads", "0"], 2, "--threads");
    refused(
        &["a.obj", "-o", "no/such/folder.txt"],
        74,
        "no/such/folder.txt",
    );
    refused(&[], 2, "FILE");
    // Nothing is left of an output that could not be written.
    assert_eq!(fs::read_dir(&folder).unwrap().count(), 1);
}

#[test]
fn huge_and_tiny_meshes_are_asked_without_a_panic() {
    for (name, scale) in [
        ("mesh-huge", "e38"),
        ("mesh-tiny", "e-44"),
        ("mesh-large", "e300"),
    ] {
        let solid = "v 0 0 0\nv 3S 0 0\nv 0 3S 0\nv 0 0 3S\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
        let folder = with_obj(name, &solid.replace('S', scale));
        let scalar = if name == "mesh-large" { "f64" } else { "f32" };
        let arguments = [
            "mesh",
            "a.obj",
            "--scalar",
            scalar,
            "--directions",
            "40",
            "--format",
            "json",
        ];
        let output = hairline(&folder, &arguments);
        assert_eq!(output.status.code(), Some(0), "{name}");
        let record: Value = serde_json::from_slice(&output.stdout).unwrap();
        assert_eq!(
            record["result"]["mesh"]["scalars"][0]["topology"]["closed_manifold"],
            true
        );
        let across = at_mesh(&record, scalar, "moller-trumbore", "edges");
        assert!(across["cracks"]["of"].as_u64().unwrap() > 0);
    }
}

#[test]
fn contracts_epsilons_and_directions_reach_the_run() {
    let folder = scratch("mesh-flags");
    let file = model("far");
    let crossings = |more: &[&str]| {
        let mut arguments = vec![file.as_str(), "--kernel", "moller-trumbore"];
        arguments.extend(more);
        at_mesh(
            &record(&folder, &arguments),
            "f32",
            "moller-trumbore",
            "edges",
        )
        .clone()
    };
    let of = |rates: &Value| rates["cracks"]["of"].as_u64().unwrap();
    let cracks = |rates: &Value| rates["cracks"]["count"].as_u64().unwrap();
    let both = crossings(&[]);
    let front = crossings(&["--contract", "front-closed-ray"]);
    assert!(of(&front) * 3 < of(&both) * 2 && of(&front) > 0);
    // An epsilon that no determinant passes leaves nothing but cracks.
    let none = crossings(&["--epsilon", "parallel=1e30"]);
    // But for those that may have passed beside a silhouette.
    let elsewhere = none["elsewhere"]["count"].as_u64().unwrap();
    assert_eq!(cracks(&none) + elsewhere, of(&none));
    assert!(elsewhere * 20 < of(&none));
    assert!(of(&crossings(&["--directions", "16"])) > of(&both) * 3 / 2);
    assert_ne!(crossings(&["--seed", "2"]), both);
    assert_ne!(crossings(&["--direction", "unit"]), both);
}

#[test]
fn ids_of_other_meshes_versions_and_triangles_are_refused() {
    let folder = scratch("mesh-ids");
    let file = model("far");
    let digest = "5050ce53d9c1ee33";
    let explain = |id: &str, code| {
        let arguments = ["explain", id, "--mesh", &file, "--kernel", "cramer"];
        ends(&folder, &arguments, code)
    };
    let id = |rest: &str| format!("mesh-vertices@2/f32/mesh={digest}/1/{rest}");
    assert!(explain(&id("7"), 0).0.contains("together"));
    assert!(!explain(&id("7.2"), 0).0.contains("together"));
    assert!(explain(&id("7.99"), 2).1.contains("counted from 0"));
    assert!(
        explain(&id("7").replace("@2", "@1"), 65)
            .1
            .contains("another version")
    );
    assert!(
        explain(&id("7").replace(digest, "0123456789abcdef"), 65)
            .1
            .contains("digest")
    );
}

#[test]
fn an_audit_with_a_mesh_counts_what_the_mesh_audit_counts() {
    let folder = scratch("mesh-audit");
    let kernels = ["moller-trumbore", "woop-watertight", "plucker"];
    for name in [
        "torus",
        "icosphere",
        "far",
        "heightfield",
        "needles",
        "polygons",
    ] {
        let file = model(name);
        let chosen = kernels.join(",");
        let flags = ["--kernel", &chosen, "--directions", "4", "--scalar", "f32"];
        let of_mesh = record(&folder, &[&[file.as_str()], &flags[..]].concat());
        let run = [
            "audit", "--quiet", "-n", "10", "--format", "json", "--mesh", &file,
        ];
        let (out, _) = ends(&folder, &[&run[..], &flags[..]].concat(), 0);
        let of_audit: Value = serde_json::from_str(&out).unwrap();
        assert!(
            of_audit["result"]["mesh"].is_null(),
            "it asks about more than edges and vertices"
        );
        for part in ["edges", "vertices"] {
            let mut cracks = 0;
            for kernel in kernels {
                let [one, other] =
                    [&of_mesh, &of_audit].map(|record| at_mesh(record, "f32", kernel, part));
                assert_eq!(one, other, "{name} {part} {kernel}");
                cracks += one["cracks"]["count"].as_u64().unwrap();
            }
            let is_smooth = ["torus", "icosphere", "heightfield"].contains(&name);
            assert!(!is_smooth || 0 < cracks, "{name} {part}");
        }
    }
}

#[test]
fn parts_of_a_mesh_merge_to_the_record_and_the_page_of_the_whole() {
    let folder = scratch("mesh-parts");
    let run = |more: &[&str]| {
        let mesh = model("icosphere");
        let run = [
            "mesh",
            &mesh,
            "-q",
            "--directions",
            "3",
            "-k",
            "moller-trumbore,plucker",
        ];
        ends(&folder, &[&run[..], more].concat(), 0);
    };
    let both = [
        "--format",
        "json,html",
        "-o",
        "whole.json",
        "-o",
        "whole.html",
    ];
    run(&both);
    for shard in ["0/3", "1/3", "2/3"] {
        let file = format!("{}.json", &shard[..1]);
        run(&["--shard", shard, "--format", "json", "-o", &file]);
    }
    // A part may be of no ray.
    run(&[
        "--shard",
        "0/100000",
        "--format",
        "json",
        "-o",
        "empty.json",
    ]);
    let merge = [
        "merge",
        "-q",
        "0.json",
        "2.json",
        "1.json",
        "--format",
        "json,html",
    ];
    ends(
        &folder,
        &[&merge[..], &["-o", "merged.json", "-o", "merged.html"]].concat(),
        0,
    );
    let result = |file: &str| result_bytes(&folder.join(file));
    assert_eq!(result("merged.json"), result("whole.json"));
    let marks = |file: &str| {
        let page = fs::read_to_string(folder.join(file)).unwrap();
        let marks: Vec<String> = page
            .split("data-marks=")
            .skip(1)
            .map(str::to_owned)
            .collect();
        marks
            .iter()
            .map(|text| text[..text.find("><").unwrap()].to_owned())
            .collect::<Vec<_>>()
    };
    assert_eq!(marks("merged.html"), marks("whole.html"));
    assert!(100 < marks("whole.html")[0].len());
}

#[test]
fn a_ci_reads_the_cracks_of_a_mesh_as_failures() {
    let folder = scratch("mesh-junit");
    let formats = ["--format", "junit,sarif", "-o", "m.xml", "-o", "m.sarif"];
    let run = [
        "mesh",
        &model("icosphere"),
        "-q",
        "-k",
        "plucker,woop-watertight",
    ];
    ends(&folder, &[&run[..], &formats].concat(), 0);
    for file in ["m.xml", "m.sarif"] {
        let text = fs::read_to_string(folder.join(file)).unwrap();
        assert!(
            text.contains("crack") && text.contains("mesh-vertices:icosphere.obj"),
            "{text}"
        );
    }
}

#[test]
fn a_crack_fails_a_ci_whatever_is_promised_and_a_watertight_kernel_passes() {
    let folder = scratch("mesh-ci");
    let run = [
        "mesh",
        &model("torus"),
        "-q",
        "-k",
        "moller-trumbore,woop-watertight",
    ];
    let (xml, _) = ends(&folder, &[&run[..], &["--format", "junit"]].concat(), 0);
    let crack = "<failure type=\"crack\" message=\"moller-trumbore (source) f32 mesh-edges:torus.obj: crack of group: ";
    assert_eq!(xml.matches("<failure").count(), 2, "{xml}");
    assert!(
        xml.contains(crack) && !xml.contains("message=\"woop"),
        "{xml}"
    );
}

#[test]
fn a_mesh_with_holes_is_not_said_to_have_none() {
    let folder = scratch("mesh-holes");
    let text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 2 4 3\nf 1 2 3\n";
    fs::write(folder.join("two.obj"), text).unwrap();
    let run = ["mesh", "two.obj", "-q", "-k", "woop-watertight"];
    let (out, _) = ends(&folder, &run, 0);
    let of = "of 8 aimed at its edges and vertices; 4 edges are not asked about, 4 of them open";
    // The edges 1-2 and 1-3 of the second face come first, and the first face has open edges too.
    assert!(
        flat(&out).contains(of) && out.contains("4 open (first at line 5)"),
        "{out}"
    );
    let (part, _) = ends(&folder, &[&run[..], &["--shard", "0/2"]].concat(), 0);
    assert!(
        flat(&part).contains("all numbers are of this part"),
        "{part}"
    );
}

#[test]
fn the_screen_has_a_meshs_edges_in_its_column_and_a_command_for_a_crack() {
    let folder = scratch("mesh-screen");
    let file = model("icosphere");
    let audit = [
        "audit", "--quiet", "--mesh", &file, "-n", "10", "--scalar", "f32",
    ];
    let (out, _) = ends(&folder, &[&audit[..], &["--kernel", "plucker"]].concat(), 0);
    assert!(
        out.lines().any(|line| line.starts_with("mesh ")) && !out.contains("stored"),
        "{out}"
    );
    assert!(
        flat(&out).contains("broken promise, no triangle reports "),
        "{out}"
    );
    let command = out
        .lines()
        .find(|line| line.starts_with("    hairline explain "))
        .expect(&out);
    let words: Vec<&str> = command.split_whitespace().skip(1).collect();
    let words: Vec<&str> = words.iter().map(|word| word.trim_matches('\'')).collect();
    let (shown, _) = ends(&folder, &words, 0);
    assert!(
        flat(&shown).contains("one hit is right: CRACK; right here: "),
        "{shown}"
    );
}

#[test]
fn parts_of_an_audit_with_a_mesh_merge_to_the_bytes_of_the_whole() {
    let folder = scratch("mesh-shards");
    let run = |file: &str, more: &[&str]| {
        let mesh = model("icosphere");
        let run = [
            "audit",
            "--quiet",
            "--mesh",
            &mesh,
            "-n",
            "50",
            "--directions",
            "3",
        ];
        let how = [
            "--kernel",
            "moller-trumbore,plucker",
            "--format",
            "json",
            "-o",
            file,
        ];
        ends(&folder, &[&run[..], &how[..], more].concat(), 0);
    };
    run("whole.json", &["--threads", "2"]);
    for shard in ["0/3", "1/3", "2/3"] {
        run(&format!("{}.json", &shard[..1]), &["--shard", shard]);
    }
    let merge = [
        "merge", "--quiet", "0.json", "2.json", "1.json", "--format", "json", "-o",
    ];
    ends(&folder, &[&merge[..], &["merged.json"]].concat(), 0);
    let result = |file: &str| result_bytes(&folder.join(file));
    assert_eq!(result("merged.json"), result("whole.json"));
    assert!(result("whole.json").contains("mesh-vertices:icosphere.obj"));
}

#[test]
fn a_check_with_a_mesh_is_red_when_an_epsilon_makes_cracks() {
    let folder = scratch("mesh-check");
    fs::copy(model("torus"), folder.join("torus.obj")).unwrap();
    let settings = "kernel = [\"woop-watertight\"]\nscalar = \"f32\"\nfamily = [\"interior\"]\n\
                    count = 100\nmesh = [\"torus.obj\"]\ndirections = 2\n";
    fs::write(folder.join("hairline.toml"), settings).unwrap();
    ends(&folder, &["check", "--quiet", "--bless"], 0);
    ends(&folder, &["check", "--quiet"], 0);
    let formats = ["--format", "text,junit,sarif,markdown,html,json"];
    let files = ["text", "junit", "sarif", "markdown", "html", "json"];
    let outputs: Vec<&str> = files.iter().flat_map(|file| ["-o", *file]).collect();
    let check = ["check", "--quiet", "--epsilon", "edge=1e-3"];
    ends(
        &folder,
        &[&check[..], &formats[..], &outputs[..]].concat(),
        1,
    );
    for file in files {
        let text = fs::read_to_string(folder.join(file)).unwrap();
        assert!(
            text.contains("crack") && text.contains("mesh-edges:torus.obj"),
            "{file}"
        );
    }
    // The command of a crack shows it.
    let text = fs::read_to_string(folder.join("text")).unwrap();
    let mut lines = text
        .lines()
        .skip_while(|line| !line.contains("mesh-edges:torus.obj: crack of"));
    assert!(lines.next().is_some(), "{text}");
    let command = lines
        .find(|line| line.contains("hairline explain"))
        .unwrap();
    let words: Vec<&str> = command.split_whitespace().skip(1).collect();
    let words: Vec<&str> = words.iter().map(|word| word.trim_matches('\'')).collect();
    let (shown, _) = ends(&folder, &words, 0);
    assert!(
        flat(&shown).contains("one hit is right: CRACK; right here: "),
        "{shown}"
    );
}

#[test]
fn a_scalar_that_is_too_coarse_for_the_mesh_is_said_to_be() {
    let folder = scratch("mesh-coarse");
    // Two triangles of 1 m, as far from the origin as a map's coordinates are.
    let at = |x: f64| {
        format!(
            "v {} {x} 0\nv {} {x} 0\nv {x} {} 0\nv {} {} 0.5\nf 1 2 3\nf 2 4 3\n",
            x,
            x + 1.0,
            x + 1.0,
            x + 1.0,
            x + 1.0
        )
    };
    let screen = |x: f64, scalar: &str| {
        fs::write(folder.join("m.obj"), at(x)).unwrap();
        let flags = [
            "mesh",
            "m.obj",
            "--kernel",
            "moller-trumbore",
            "-q",
            "--scalar",
            scalar,
        ];
        program::flat(&ends(&folder, &flags, 0).0)
    };
    let far = screen(2.7e6, "f32");
    let expected = "f32 is coarse for this mesh: its numbers are 0.25 apart at the far end, 1/6 of the smallest \
                    triangle's longest edge: use f64, or move the origin to the camera.";
    assert!(far.contains(expected), "{far}");
    for fine in [screen(2.7e6, "f64"), screen(0.0, "f32")] {
        assert!(!fine.contains("coarse"), "{fine}");
    }
}
