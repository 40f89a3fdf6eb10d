//! Every format of `audit` and `check` beside its public schema or a reader of its own.

mod json_schema;
mod program;

use program::{ends, scratch};
use serde_json::Value;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn read_json(file: impl AsRef<Path>) -> Value {
    serde_json::from_slice(&fs::read(file).unwrap()).unwrap()
}

/// A folder with each format of one audit, of a check with unexpected, stale and known disagreements.
fn written(name: &str) -> PathBuf {
    let folder = scratch(name);
    let formats = "text,json,jsonl,junit,sarif,markdown";
    let plan = [
        "--kernel",
        "moller-trumbore,plucker",
        "--family",
        "tiny,edge-near,fan,invalid",
        "-n",
        "500",
    ];
    let outputs = |prefix: &str| -> Vec<String> {
        let names = formats.split(',').map(|format| format!("{prefix}.{format}"));
        names.flat_map(|name| ["-o".to_owned(), name]).collect()
    };
    let run = |command: &[&str], prefix: &str, code: i32| {
        let outputs = outputs(prefix);
        let outputs: Vec<&str> = outputs.iter().map(String::as_str).collect();
        let all = [command, &["-q", "--format", formats], &plan, &outputs].concat();
        ends(&folder, &all, code);
    };
    run(&["audit"], "audit", 0);
    run(&["check", "--expectations", "a <&> \"b\".toml", "--bless"], "blessed", 0);
    let file = folder.join("a <&> \"b\".toml");
    let text = fs::read_to_string(&file).unwrap();
    let first = text.lines().find(|line| line.contains("count = ")).unwrap();
    let stale = "{ family = \"tiny\", class = \"parallel\", finding = \"panic\", count = 2 },";
    fs::write(&file, text.replacen(first, stale, 1)).unwrap();
    run(&["check", "--expectations", "a <&> \"b\".toml"], "check", 1);
    folder
}

#[test]
fn the_committed_schema_is_that_of_the_program_and_records_obey_it() {
    let (printed, _) = ends(root(), &["schema"], 0);
    let file = root().join("docs/schema/record.json");
    let committed = fs::read_to_string(&file).unwrap();
    assert_eq!(committed, printed, "write it again: hairline schema > docs/schema/record.json");
    let schema = read_json(file);
    let folder = written("formats-json");
    for name in ["audit.json", "check.json"] {
        let record = read_json(folder.join(name));
        assert_eq!(json_schema::errors(&schema, &record), [""; 0], "{name}");
        let mut wrong = record;
        wrong["result"]["results"][0]["total"]["cases"] = Value::from(-1);
        assert_ne!(json_schema::errors(&schema, &wrong), [""; 0]);
    }
}

#[test]
fn sarif_obeys_its_public_schema_and_its_results_their_rules() {
    let schema = read_json(root().join("tests/schemas/sarif-2.1.0.json"));
    let folder = written("formats-sarif");
    for name in ["audit.sarif", "check.sarif"] {
        let log = read_json(folder.join(name));
        assert_eq!(json_schema::errors(&schema, &log), [""; 0], "{name}");
        let run = &log["runs"][0];
        let rules: Vec<&Value> =
            run["tool"]["driver"]["rules"].as_array().unwrap().iter().map(|r| &r["id"]).collect();
        let results = run["results"].as_array().unwrap();
        assert!(!results.is_empty() && results.iter().all(|r| rules.contains(&&r["ruleId"])));
        let mut prints: Vec<String> = results
            .iter()
            .map(|r| r["partialFingerprints"]["disagreement/v1"].to_string())
            .collect();
        prints.sort();
        prints.dedup();
        assert_eq!(prints.len(), results.len(), "one result a class of disagreement");
        let mut wrong = log.clone();
        wrong["runs"][0]["results"][0]["level"] = Value::from("fatal");
        assert_ne!(json_schema::errors(&schema, &wrong), [""; 0]);
    }
    let check = read_json(folder.join("check.sarif"));
    let results = check["runs"][0]["results"].as_array().unwrap();
    assert_eq!(results[0]["level"], "error");
    let stale = results.iter().find(|r| r["ruleId"] == "stale-expectation").unwrap();
    let place = &stale["locations"][0]["physicalLocation"];
    assert_eq!(place["artifactLocation"]["uri"], "a%20%3C%26%3E%20%22b%22.toml");
    assert!(1 < place["region"]["startLine"].as_u64().unwrap());
    let known = results.iter().filter(|r| r["suppressions"].is_array()).count();
    assert_eq!(known, results.len() - 2);
}

#[test]
fn junit_obeys_its_public_schema_and_counts_its_failures() {
    let folder = written("formats-junit");
    for name in ["audit.junit", "check.junit"] {
        let text = fs::read_to_string(folder.join(name)).unwrap();
        let elements = elements(&text);
        let count = |wanted: &str| elements.iter().filter(|(name, _)| *name == wanted).count();
        let (_, top) = &elements[0];
        assert_eq!(attribute(top, "tests"), count("testcase").to_string());
        assert_eq!(attribute(top, "failures"), count("failure").to_string());
        let suites = elements.iter().filter(|(name, _)| *name == "testsuite");
        let names: Vec<&str> =
            suites.map(|(_, attributes)| attribute(attributes, "name")).collect();
        assert_eq!(names, ["moller-trumbore (source)", "plucker (source)"]);
        let cases: Vec<String> = elements
            .iter()
            .filter(|(name, _)| *name == "testcase")
            .map(|(_, a)| format!("{} {}", attribute(a, "classname"), attribute(a, "name")))
            .collect();
        assert!(cases.contains(&"moller-trumbore (source).f32.tiny false-miss".to_owned()));
        assert!(cases.contains(&"plucker (source).f64.fan crack".to_owned()));
        assert!((1..cases.len()).all(|i| !cases[..i].contains(&cases[i])), "each case once");
        validate_with_xmllint(&folder.join(name));
    }
    let check = fs::read_to_string(folder.join("check.junit")).unwrap();
    assert_eq!(check.matches("<failure ").count(), 2, "one unexpected, one stale: {check}");
}

/// By libxml2's tool, where it is installed; CI's machine must have it.
fn validate_with_xmllint(file: &Path) {
    let schema = root().join("tests/schemas/junit-10.xsd");
    let outcome =
        Command::new("xmllint").arg("--noout").arg("--schema").args([&schema, file]).output();
    match outcome {
        Ok(output) => {
            let text = String::from_utf8_lossy(&output.stderr).into_owned();
            assert!(output.status.success(), "{text}");
        }
        Err(_) => assert!(std::env::var_os("CI").is_none(), "CI needs xmllint (libxml2-utils)"),
    }
}

/// The start tags of a document with their attributes, after a check that tags are nested and text
/// has no bare special character.
fn elements(text: &str) -> Vec<(&str, &str)> {
    let body = text.strip_prefix("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n").unwrap();
    let (mut open, mut all) = (Vec::new(), Vec::new());
    for piece in body.split('<').skip(1) {
        let (tag, text) = piece.split_once('>').unwrap();
        for entity in text.split('&').chain(tag.split('&')).skip(1) {
            let known = ["amp;", "lt;", "gt;", "quot;"];
            assert!(known.iter().any(|k| entity.starts_with(k)) || !piece.contains('&'), "{piece}");
        }
        if let Some(name) = tag.strip_prefix('/') {
            assert_eq!(open.pop(), Some(name));
            continue;
        }
        let inner = tag.strip_suffix('/').unwrap_or(tag);
        let (name, attributes) = inner.split_once(' ').unwrap_or((inner, ""));
        if !tag.ends_with('/') {
            open.push(name);
        }
        all.push((name, attributes));
    }
    assert!(open.is_empty(), "{open:?}");
    all
}

fn attribute<'a>(attributes: &'a str, name: &str) -> &'a str {
    let spaced = attributes.strip_prefix(&format!("{name}=\""));
    let start = spaced.or_else(|| attributes.split_once(&format!(" {name}=\"")).map(|pair| pair.1));
    start.unwrap().split_once('"').unwrap().0
}

#[test]
fn json_lines_hold_what_the_record_holds() {
    let folder = written("formats-jsonl");
    let text = fs::read_to_string(folder.join("check.jsonl")).unwrap();
    let lines: Vec<Value> = text.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    let record = read_json(folder.join("check.json"));
    let of = |kind: &str| -> Vec<Value> {
        let lines = lines.iter().filter(|line| line["type"] == kind).cloned();
        lines
            .map(|mut line| {
                line.as_object_mut().unwrap().remove("type");
                line
            })
            .collect()
    };
    assert_eq!(lines[0]["schema"], record["schema"]);
    assert_eq!(lines[0]["plan"], record["result"]["plan"]);
    assert_eq!(Value::from(of("source")), record["result"]["sources"]);
    assert_eq!(Value::from(of("result")), record["result"]["results"]);
    assert_eq!(Value::from(of("unexpected")), record["conformance"]["unexpected"]);
    assert_eq!(Value::from(of("stale")), record["conformance"]["stale"]);
    assert_eq!(Value::from(of("known")), record["conformance"]["known"]);
    assert_eq!(of("conformance")[0]["verdict"], "disagreements");
}

#[test]
fn markdown_says_the_verdict_the_deviations_and_the_rates() {
    let folder = written("formats-markdown");
    let text = fs::read_to_string(folder.join("check.markdown")).unwrap();
    assert!(text.starts_with("## hairline does not conform: 1 unexpected disagreement, 1 stale"));
    for expected in [
        "\n### Unexpected disagreements\n\n| kernel",
        "\n### Stale expectations\n\n| kernel",
        "| moller-trumbore (source) | f32 | tiny | panic of parallel | 0 of ",
        "`hairline explain '",
        "\n### f64\n",
    ] {
        assert!(text.contains(expected), "{expected}: {text}");
    }
    // Every row of a table has as many cells as its head.
    for table in text.split("\n\n").filter(|part| part.starts_with('|')) {
        let cells = |line: &str| line.replace("\\|", "").matches('|').count();
        let head = cells(table.lines().next().unwrap());
        assert!(table.lines().all(|line| cells(line) == head), "{table}");
    }
}
