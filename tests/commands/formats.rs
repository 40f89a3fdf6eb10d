//! Every format of `audit` and `check` beside its public schema or a reader of its own.

use crate::json_schema;
use crate::program;

use program::{ends, scratch};
use serde_json::Value;
use std::fs;
use std::path::{Path, PathBuf};
use uppsala::{Document, XsdValidator};

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn read_json(file: impl AsRef<Path>) -> Value {
    serde_json::from_slice(&fs::read(file).unwrap()).unwrap()
}

/// A folder with each format of one audit, of a check with unexpected, stale and known disagreements.
fn written(name: &str) -> PathBuf {
    let folder = scratch(name);
    let formats = "text,json,junit,sarif,markdown";
    let plan = [
        "--kernel",
        "moller-trumbore,plucker",
        "--family",
        "tiny,edge-near,fan,invalid",
        "-n",
        "500",
    ];
    let outputs = |prefix: &str| -> Vec<String> {
        let names = formats
            .split(',')
            .map(|format| format!("{prefix}.{format}"));
        names.flat_map(|name| ["-o".to_owned(), name]).collect()
    };
    let run = |command: &[&str], prefix: &str, code: i32| {
        let outputs = outputs(prefix);
        let outputs: Vec<&str> = outputs.iter().map(String::as_str).collect();
        let all = [command, &["-q", "--format", formats], &plan, &outputs].concat();
        ends(&folder, &all, code);
    };
    run(&["audit"], "audit", 0);
    run(
        &["check", "--expectations", "a <&> \"b\".toml", "--bless"],
        "blessed",
        0,
    );
    let file = folder.join("a <&> \"b\".toml");
    let text = fs::read_to_string(&file).unwrap();
    let first = text
        .lines()
        .find(|line| line.contains("scalar = "))
        .unwrap();
    let (head, families) = first.split_once("counts = { ").unwrap();
    let (family, rest) = families.split_once(" = ").unwrap();
    let digits = rest.find(|c: char| !c.is_ascii_digit()).unwrap();
    let fewer = rest[..digits].parse::<u64>().unwrap() - 1;
    let fewer = format!("{head}counts = {{ {family} = {fewer}{}", &rest[digits..]);
    let stale = "  { scalar = \"f32\", finding = \"panic\", counts = { tiny = 2 } },";
    fs::write(&file, text.replacen(first, &format!("{fewer}\n{stale}"), 1)).unwrap();
    fs::remove_file(folder.join("a <&> \"b\".toml.lock")).unwrap();
    run(&["check", "--expectations", "a <&> \"b\".toml"], "check", 1);
    folder
}

#[test]
fn records_obey_the_schema_that_the_program_prints() {
    let (printed, _) = ends(root(), &["check", "schema"], 0);
    let schema = serde_json::from_str(&printed).unwrap();
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
        let rules: Vec<&Value> = run["tool"]["driver"]["rules"]
            .as_array()
            .unwrap()
            .iter()
            .map(|r| &r["id"])
            .collect();
        let results = run["results"].as_array().unwrap();
        assert!(!results.is_empty() && results.iter().all(|r| rules.contains(&&r["ruleId"])));
        let mut prints: Vec<String> = results
            .iter()
            .map(|r| r["partialFingerprints"]["disagreement/v1"].to_string())
            .collect();
        prints.sort();
        prints.dedup();
        assert_eq!(
            prints.len(),
            results.len(),
            "one result a class of disagreement"
        );
        let mut wrong = log.clone();
        wrong["runs"][0]["results"][0]["level"] = Value::from("fatal");
        assert_ne!(json_schema::errors(&schema, &wrong), [""; 0]);
    }
    let check = read_json(folder.join("check.sarif"));
    let results = check["runs"][0]["results"].as_array().unwrap();
    assert_eq!(results[0]["level"], "error");
    let stale = results
        .iter()
        .find(|r| r["ruleId"] == "stale-expectation")
        .unwrap();
    let place = &stale["locations"][0]["physicalLocation"];
    assert_eq!(
        place["artifactLocation"]["uri"],
        "a%20%3C%26%3E%20%22b%22.toml"
    );
    assert!(1 < place["region"]["startLine"].as_u64().unwrap());
    // The known disagreements are the cases that were blessed.
    assert!(!check.to_string().contains("other cases"), "{check}");
    let known = results
        .iter()
        .filter(|r| r["suppressions"].is_array())
        .count();
    assert_eq!(known, results.len() - 2);
}

#[test]
fn junit_obeys_its_public_schema_and_counts_its_failures() {
    let schema = fs::read_to_string(root().join("tests/schemas/junit-10.xsd")).unwrap();
    let schema = XsdValidator::from_schema(&uppsala::parse(&schema).unwrap()).unwrap();
    let valid = |text: &str| schema.validate(&uppsala::parse(text).unwrap()).is_empty();
    let folder = written("formats-junit");
    for name in ["audit.junit", "check.junit"] {
        let text = fs::read_to_string(folder.join(name)).unwrap();
        let document = uppsala::parse(&text).unwrap();
        assert_eq!(schema.validate(&document), []);
        let top = document.document_element().unwrap();
        let count = |wanted: &str| document.get_elements_by_tag_name(wanted).len().to_string();
        assert_eq!(
            document.get_attribute(top, "tests"),
            Some(&*count("testcase"))
        );
        assert_eq!(
            document.get_attribute(top, "failures"),
            Some(&*count("failure"))
        );
        let names = attributes(&document, "testsuite", "name");
        assert_eq!(names, ["moller-trumbore (source)", "plucker (source)"]);
        let classes = attributes(&document, "testcase", "classname");
        let cases: Vec<String> = classes
            .iter()
            .zip(attributes(&document, "testcase", "name"))
            .map(|(class, name)| format!("{class} {name}"))
            .collect();
        assert!(cases.contains(&"moller-trumbore (source).f32.tiny false-miss".to_owned()));
        assert!(cases.contains(&"plucker (source).f64.fan crack".to_owned()));
        assert!(
            (1..cases.len()).all(|i| !cases[..i].contains(&cases[i])),
            "each case once"
        );
        for (right, wrong) in [
            ("<testsuite name=", "<testsuite title="),
            (" failures=", " failures=\"0\" failed="),
            ("</testcase>", "<note/></testcase>"),
            ("</testsuite>", "words</testsuite>"),
        ] {
            assert!(!valid(&text.replacen(right, wrong, 1)), "{wrong}");
        }
    }
    let check = fs::read_to_string(folder.join("check.junit")).unwrap();
    assert!(
        check.contains("known: ") && !check.contains("other cases"),
        "{check}"
    );
    assert_eq!(
        check.matches("<failure ").count(),
        2,
        "one unexpected, one stale: {check}"
    );
}

#[test]
fn a_run_that_fails_says_so_where_a_ci_would_read_an_older_one() {
    let folder = scratch("formats-failure");
    fs::write(folder.join("bad <&>.jsonl"), "{\n").unwrap();
    let flags = [
        "--kernel",
        "cramer",
        "--corpus",
        "bad <&>.jsonl",
        "--format",
        "junit,sarif,json",
    ];
    let outputs = ["-o", "a.xml", "-o", "a.sarif", "-o", "a.json"];
    let xsd = fs::read_to_string(root().join("tests/schemas/junit-10.xsd")).unwrap();
    let xsd = XsdValidator::from_schema(&uppsala::parse(&xsd).unwrap()).unwrap();
    let schema = read_json(root().join("tests/schemas/sarif-2.1.0.json"));
    for command in ["audit", "check"] {
        for file in ["a.xml", "a.sarif", "a.json"] {
            fs::write(folder.join(file), "of an older run").unwrap();
        }
        let (_, error) = ends(
            &folder,
            &[&[command, "-q"], &flags[..], &outputs].concat(),
            65,
        );
        let message = error.trim().strip_prefix("hairline: ").unwrap();
        assert!(message.starts_with("bad <&>.jsonl:1: "), "{message}");
        let text = fs::read_to_string(folder.join("a.xml")).unwrap();
        let document = uppsala::parse(&text).unwrap();
        assert_eq!(xsd.validate(&document), []);
        assert_eq!(attributes(&document, "error", "message"), [message]);
        assert_eq!(attributes(&document, "error", "type"), ["exit 65"]);
        let log = read_json(folder.join("a.sarif"));
        assert_eq!(json_schema::errors(&schema, &log), [""; 0]);
        let invocation = &log["runs"][0]["invocations"][0];
        assert_eq!(invocation["executionSuccessful"], false);
        assert_eq!(
            invocation["toolExecutionNotifications"][0]["message"]["text"],
            message
        );
        // There is no record.
        assert_eq!(
            fs::read_to_string(folder.join("a.json")).unwrap(),
            "of an older run"
        );
    }
}

/// An attribute of each element of a name, in their order.
fn attributes<'a>(document: &'a Document, element: &str, attribute: &str) -> Vec<&'a str> {
    let elements = document.get_elements_by_tag_name(element).into_iter();
    elements
        .map(|id| document.get_attribute(id, attribute).unwrap())
        .collect()
}

#[test]
fn markdown_says_the_verdict_the_deviations_and_the_rates() {
    let folder = written("formats-markdown");
    let text = fs::read_to_string(folder.join("check.markdown")).unwrap();
    assert!(
        text.starts_with("## Mixed: moller-trumbore, 2 wrong answers fewer and 1 more\n"),
        "{text}"
    );
    for expected in [
        "\n### Unexpected disagreements\n\n- ",
        "\n| f32 panic | 2 | 0 | -2 | tiny -2 |\n",
        "\n### What to do\n\n- moller-trumbore (source): a trade, ",
        "`hairline explain '",
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
