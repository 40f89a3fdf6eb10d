//! `vectors` and `verify`: the committed test vectors, their formats, and results that are judged.

use crate::json_schema;
use crate::program::{ends, scratch};
use crate::tools::has;
use hmac_sha256::Hash;
use serde_json::{Value, json};
use std::collections::{BTreeMap, HashSet};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

fn repository() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// The files of the core set's topics.
fn topic_files() -> Vec<PathBuf> {
    let entries = fs::read_dir(repository().join("vectors"))
        .unwrap()
        .map(|entry| entry.unwrap().path());
    let mut files: Vec<PathBuf> = entries
        .filter(|path| path.extension().is_some_and(|e| e == "json"))
        .collect();
    files.sort();
    files
}

fn parse(file: &Path) -> Value {
    serde_json::from_str(&fs::read_to_string(file).unwrap()).unwrap()
}

/// The tests of all topics.
fn tests() -> Vec<Value> {
    topic_files()
        .iter()
        .flat_map(|file| parse(file)["tests"].as_array().unwrap().clone())
        .collect()
}

#[test]
fn the_committed_vectors_are_what_the_command_writes_small_and_with_ids_of_their_own() {
    let folder = scratch("vectors-core");
    let (_, error) = ends(&folder, &["vectors", "."], 0);
    let mut names: Vec<String> = Vec::new();
    for entry in fs::read_dir(&folder).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_name().unwrap().to_str().unwrap().to_owned();
        let committed = fs::read(repository().join("vectors").join(&name)).unwrap_or_default();
        let same = fs::read(&path).unwrap() == committed;
        assert!(same, "vectors/{name} is not what `hairline vectors` writes");
        names.push(name);
    }
    assert_eq!(names.len(), topic_files().len() + 2, "{names:?}");
    let size: u64 = topic_files()
        .iter()
        .map(|file| fs::metadata(file).unwrap().len())
        .sum();
    let tests = tests();
    assert!(
        (1000..=2000).contains(&tests.len()) && size <= 1_020_000,
        "{} {size}",
        tests.len()
    );
    assert!(
        error.contains(&format!("{} tests in {}", tests.len(), topic_files().len())),
        "{error}"
    );
    for test in &tests {
        let [id, scalar, bits] = ["id", "scalar", "bits"].map(|key| test[key].as_str().unwrap());
        let digest = Hash::hash(format!("{scalar} {bits}").as_bytes());
        let digits: String = digest[..8]
            .iter()
            .map(|byte| format!("{byte:02x}"))
            .collect();
        assert!(
            id.ends_with(&format!("-{digits}")),
            "{id} has other numbers than its digest says"
        );
    }
    let ids: HashSet<&str> = tests
        .iter()
        .map(|test| test["id"].as_str().unwrap())
        .collect();
    assert_eq!(ids.len(), tests.len(), "each test has an id of its own");
    let published = parse(&repository().join("vectors/published.json"));
    let reports = published["tests"].as_array().unwrap().iter();
    let reports: HashSet<&str> = reports
        .map(|test| test["source"].as_str().unwrap())
        .collect();
    assert!(40 <= reports.len(), "{} reports", reports.len());
}

#[test]
fn every_file_is_as_its_schema_says_and_explains_its_flags() {
    let schema = parse(&repository().join("docs/schema/vectors.json"));
    for file in topic_files() {
        let document = parse(&file);
        let errors = json_schema::errors(&schema, &document);
        assert_eq!(errors, Vec::<String>::new(), "{}", file.display());
        assert_eq!(
            file.file_stem().unwrap().to_str(),
            document["topic"].as_str()
        );
        for test in document["tests"].as_array().unwrap() {
            for flag in test["flags"].as_array().unwrap() {
                assert!(
                    document["flags"][flag.as_str().unwrap()].is_string(),
                    "{flag}"
                );
            }
        }
    }
}

#[test]
fn the_checker_in_python_agrees_with_every_test_and_notices_what_is_wrong() {
    if !has("python3") {
        return;
    }
    let check = repository().join("vectors/check.py");
    let run = |check: &Path| Command::new("python3").arg(check).output().unwrap();
    let output = run(&check);
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(
        output.status.success() && text.ends_with("tests, 0 disagreements\n"),
        "{text}"
    );
    // The full set as well, its first numbers.
    let folder = scratch("vectors-python");
    ends(
        &folder,
        &[
            "vectors",
            "--format",
            "json",
            "-n",
            "2000",
            "-o",
            "full.jsonl",
        ],
        0,
    );
    let lines = fs::File::open(folder.join("full.jsonl")).unwrap();
    let output = Command::new("python3")
        .arg(&check)
        .arg("-")
        .stdin(lines)
        .output()
        .unwrap();
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(
        output.status.success() && text.ends_with("tests, 0 disagreements\n"),
        "{text}"
    );
    // One change at a time to one file.
    for (old, new) in [
        ("\"result\":\"hit\"", "\"result\":\"miss\""),
        ("\"closed\":\"hit\"", "\"closed\":\"miss\""),
        ("\"where\":\"interior\"", "\"where\":\"edge_ab\""),
        ("\"t_exact\":\"1/1\"", "\"t_exact\":\"1/2\""),
        ("\"facing\":\"front\"", "\"facing\":\"back\""),
        ("\"0x1p0\"", "\"0x1.8p0\""),
    ] {
        let folder = scratch("vectors-wrong");
        for entry in fs::read_dir(repository().join("vectors")).unwrap() {
            let path = entry.unwrap().path();
            if path.is_file() {
                fs::copy(&path, folder.join(path.file_name().unwrap())).unwrap();
            }
        }
        let file = folder.join("basics.json");
        let text = fs::read_to_string(&file).unwrap();
        assert!(text.contains(old), "{old}");
        fs::write(&file, text.replacen(old, new, 1)).unwrap();
        let output = run(&folder.join("check.py"));
        assert_eq!(output.status.code(), Some(1), "{old}");
    }
}

#[test]
fn the_formats_hold_the_same_tests() {
    let folder = scratch("vectors-formats");
    for format in ["csv", "json"] {
        ends(
            &folder,
            &["vectors", "--format", format, "-n", "108", "-o", format],
            0,
        );
    }
    let csv = fs::read_to_string(folder.join("csv")).unwrap();
    let rows: Vec<Vec<&str>> = csv
        .lines()
        .skip(1)
        .map(|line| line.split(',').collect())
        .collect();
    assert!(rows.iter().all(|row| row.len() == 35));
    let json = fs::read_to_string(folder.join("json")).unwrap();
    let tests: Vec<Value> = json
        .lines()
        .map(|line| serde_json::from_str(line).unwrap())
        .collect();
    assert!(100 < tests.len() && tests.len() < rows.len());
    let mut firsts = rows.iter().filter(|row| row[1] == "0");
    for test in &tests {
        let row = firsts.next().unwrap();
        assert_eq!(test["id"], row[0]);
        assert!(
            test["bits"]
                .as_str()
                .unwrap()
                .starts_with(&row[18..35].join(" ")),
            "{}",
            row[0]
        );
    }
    assert!(firsts.next().is_none());
    // The same bytes, however many threads there are.
    let threads = [("RAYON_NUM_THREADS", "1")];
    let again = ["vectors", "--format", "csv", "-n", "108"];
    let output = crate::program::hairline_with(&folder, &again, &threads);
    assert_eq!(output.stdout, csv.as_bytes());
}

#[test]
fn no_test_of_the_full_set_stands_twice_in_a_file() {
    let folder = scratch("vectors-once");
    let (csv, _) = ends(&folder, &["vectors", "--format", "csv", "-n", "3000"], 0);
    let rows = csv.lines().skip(1);
    let ids: Vec<&str> = rows
        .filter_map(|row| row.split_once(",0,").map(|(id, _)| id))
        .filter(|id| !id.contains(','))
        .collect();
    let distinct: std::collections::HashSet<&&str> = ids.iter().collect();
    assert!(2_900 < ids.len() && distinct.len() == ids.len());
}

#[test]
fn a_format_is_needed_to_write_one_file() {
    let folder = scratch("vectors-usage");
    for arguments in [
        &["vectors", "-n", "5"][..],
        &["vectors", "-o", "x"],
        &["vectors", "--format", "xml"],
    ] {
        let (_, error) = ends(&folder, arguments, 2);
        assert!(error.contains("--format"), "{error}");
    }
    let (_, error) = ends(&folder, &["vectors", "--format", "csv", "-n", "0"], 2);
    assert!(error.contains("0 is not in 1"), "{error}");
    assert_eq!(fs::read_dir(&folder).unwrap().count(), 0);
}

/// A results file of these answers, in the order of the tests.
fn results(answers: &[(String, Value)]) -> String {
    let digest = fs::read_to_string(repository().join("vectors/sha256.txt")).unwrap();
    let answers: Vec<String> = answers
        .iter()
        .map(|(id, answer)| format!("\n\"{id}\":{answer}"))
        .collect();
    format!(
        "{{\"vectors\":\"{}\",\n\"product\":\"mine\",\n\"results\":{{{}}}}}\n",
        digest.trim(),
        answers.join(",")
    )
}

fn verify(results: &str, arguments: &[&str], code: i32) -> (String, String) {
    let folder = scratch(&format!(
        "verify-{:x}",
        results.len() + 7 * arguments.concat().len()
    ));
    fs::write(folder.join("results.json"), results).unwrap();
    ends(
        &folder,
        &[&["verify", "results.json"], arguments].concat(),
        code,
    )
}

/// What a profile's file demands of a test, worked out as the guide tells readers to.
fn demanded(test: &Value, profile: Option<&Value>) -> String {
    let result = test["result"].as_str().unwrap();
    let has_rule =
        profile.is_some_and(|profile| profile["preconditions"][0]["t_min"] == "at-least-0");
    // A pattern with its sign bit, and more than that.
    let t_min = test["bits"].as_str().unwrap().split(' ').nth(6).unwrap();
    let is_negative = t_min.as_bytes()[0] >= b'8' && t_min[1..].bytes().any(|digit| digit != b'0');
    if has_rule && (is_negative || t_min.starts_with(['9', 'a', 'b', 'c', 'd', 'e', 'f'])) {
        return "free".to_owned();
    }
    let answer =
        |of: &str| profile.map(|profile| profile["answers"][of]["result"].as_str().unwrap());
    if test["triangles"].is_array() {
        return match answer("groups") {
            Some("parity") => test["parity"].as_str().unwrap(),
            Some(groups) if result == "at-least-one" => groups,
            _ => result,
        }
        .to_owned();
    }
    let reasons = test["free_because"].as_array().into_iter().flatten();
    let answers: Vec<&str> = reasons
        .filter_map(|reason| answer(reason.as_str().unwrap()))
        .collect();
    match answers {
        answers if answers.is_empty() => result,
        answers if answers.contains(&"miss") => "miss",
        answers if answers.contains(&"free") => "free",
        _ => "hit",
    }
    .to_owned()
}

/// An answer that is right, or one that is wrong where one can be.
fn answer(test: &Value, demanded: &str, right: bool) -> Value {
    match (demanded, right) {
        ("hit" | "miss", _) => json!(if (demanded == "hit") == right {
            "hit"
        } else {
            "miss"
        }),
        ("exactly-one" | "odd", true) => json!(1),
        ("at-least-one" | "even", true) => json!(2),
        ("exactly-one" | "odd", false) => json!(2),
        ("at-least-one", false) => json!(0),
        ("even", false) => json!(1),
        _ if test["triangles"].is_array() => json!(0),
        _ => json!("hit"),
    }
}

#[test]
fn right_results_end_with_0_and_wrong_ones_with_1_under_every_profile() {
    let tests = tests();
    for name in ["", "dxr", "parity", "picking", "vulkan"] {
        let profile = repository().join(format!("vectors/profiles/{name}.json"));
        let profile = (!name.is_empty()).then(|| parse(&profile));
        let demands: Vec<String> = tests
            .iter()
            .map(|test| demanded(test, profile.as_ref()))
            .collect();
        let free = demands.iter().filter(|demand| *demand == "free").count();
        let of = |right: bool| {
            let pairs = tests.iter().zip(&demands);
            let answers = pairs.map(|(test, demand)| {
                (
                    test["id"].as_str().unwrap().to_owned(),
                    answer(test, demand, right),
                )
            });
            results(&answers.collect::<Vec<_>>())
        };
        let mut arguments = vec!["--format", "json"];
        if !name.is_empty() {
            arguments.extend(["--profile", name]);
        }
        for (right, code) in [(true, 0), (false, 1)] {
            let (report, _) = verify(&of(right), &arguments, code);
            let report: Value = json_schema::result(&report);
            let owed = tests.len() - free;
            let (right, wrong) = if right { (owed, 0) } else { (0, owed) };
            let total = json!({"tests": tests.len(), "right": right, "wrong": wrong, "free": free, "missing": 0, "not_asked": 0});
            assert_eq!(report["total"], total, "{name}");
            assert_eq!(report["wrong"].as_array().unwrap().len(), wrong);
            // The page counts the same.
            let page = arguments
                .iter()
                .map(|word| if *word == "json" { "html" } else { word });
            let (page, _) = verify(&of(wrong == 0), &page.collect::<Vec<_>>(), code);
            let title = page
                .split_once("<h1>")
                .unwrap()
                .1
                .split_once("</h1>")
                .unwrap()
                .0;
            let answers = format!("mine: {wrong} wrong answers, {right} right");
            assert!(title.contains(&answers), "{name}: {title}");
            assert_eq!(page.contains("Wrong answers"), wrong != 0, "{name}");
        }
    }
}

#[test]
fn what_a_specification_only_advises_is_said_and_not_wrong() {
    let tests = tests();
    // The profiles ask nothing of a ray that begins before 0.
    let begins_before_0 = |test: &Value| test["t_min"].as_str().is_some_and(|t| t.starts_with('-'));
    let is_crossing = |test: &&Value| test["result"] == "at-least-one" && !begins_before_0(test);
    let crossings: Vec<&Value> = tests.iter().filter(is_crossing).collect();
    let answers = |hits: u64| {
        let answer = |test: &&Value| (test["id"].as_str().unwrap().to_owned(), json!(hits));
        results(&crossings.iter().map(answer).collect::<Vec<_>>())
    };
    let by = |hits: u64, profile: &str, code: i32| -> Value {
        let (report, _) = verify(
            &answers(hits),
            &["--format", "json", "--profile", profile],
            code,
        );
        json_schema::result(&report)
    };
    // "Should" in the one, "must" in the other.
    for (hits, against) in [(0, crossings.len()), (1, 0), (2, crossings.len())] {
        let report = by(hits, "vulkan", 0);
        let told = report["unadvised"].as_array().map_or(0, Vec::len);
        assert_eq!(
            (told, report["total"]["wrong"].as_u64()),
            (against, Some(0))
        );
        assert_eq!(
            report["sayings"].as_array().unwrap().len(),
            usize::from(0 < against)
        );
    }
    let report = by(2, "dxr", 1);
    assert_eq!(
        report["total"]["wrong"].as_u64(),
        Some(crossings.len() as u64)
    );
    let (text, _) = verify(&answers(2), &["--profile", "vulkan"], 0);
    let text = unwrapped(&text);
    assert!(
        text.contains("Against what the specification advises (a \"should\")"),
        "{text}"
    );
    assert!(text.contains("should not double-hit or miss"), "{text}");
}

/// A text without the ends of its lines.
fn unwrapped(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

#[test]
fn every_report_of_an_audit_is_one_of_results_and_each_case_in_it_is_explained() {
    let tests = tests();
    let find = |wanted: fn(&Value) -> bool| {
        tests.iter().find(|test| wanted(test)).unwrap()["id"]
            .as_str()
            .unwrap()
            .to_owned()
    };
    let single = find(|test| test["result"] == "hit");
    let group = find(|test| test["result"] == "at-least-one");
    let end = find(|test| test["free_because"] == json!(["ends"]) && test["where"] == "interior");
    let answers = [
        (single.clone(), json!("miss")),
        (group.clone(), json!(2)),
        (end.clone(), json!("hit")),
    ];
    let of = |arguments: &[&str]| verify(&results(&answers), arguments, 1).0;
    let sentence = "Ray-triangle intersection can only occur if the intersection t-value satisfies";
    let text = unwrapped(&of(&["--profile", "dxr"]));
    assert!(
        text.contains(&format!("{end}: hit, expected miss by 'ends'")),
        "{text}"
    );
    assert!(
        text.contains(&format!("{group}: 2, expected exactly-one by 'groups'")),
        "{text}"
    );
    assert!(
        text.contains("'ends' (Ray extents): ") && text.contains(sentence),
        "{text}"
    );
    for format in ["junit", "json", "markdown", "html"] {
        let report = of(&["--profile", "dxr", "--format", format]);
        for id in [&single, &group, &end] {
            assert!(report.contains(id), "{format}: {id}");
        }
    }
    // Only a group is wrong: every format counts it, unless more hits than one are allowed.
    let alone = results(&[(group.clone(), json!(2))]);
    for format in ["text", "markdown", "html"] {
        let (page, _) = verify(&alone, &["--profile", "dxr", "--format", format], 1);
        assert!(
            page.contains("1 wrong answer, 0 right by profile dxr"),
            "{page}"
        );
        let (page, _) = verify(&alone, &["--format", format], 0);
        assert!(page.contains("0 wrong answers, 1 right"), "{page}");
    }
    // No hit at all is wrong by every reading: no profile is to blame.
    let none = results(&[(group.clone(), json!(0))]);
    let text = unwrapped(&verify(&none, &["--profile", "dxr"], 1).0);
    assert!(
        text.contains(&format!("{group}: 0, expected exactly-one (")),
        "{text}"
    );
    let (_, error) = ends(
        &scratch("verify-unknown"),
        &["explain", "edges-0000000000000000"],
        2,
    );
    assert!(
        error.contains("no test of the core set of vectors"),
        "{error}"
    );
    for (id, line) in [
        (single, "truth  transversal"),
        (group, "together"),
        (end, ", t at_m"),
    ] {
        let (explained, _) = ends(
            &scratch("verify-explain"),
            &["explain", &id, "--details"],
            0,
        );
        assert!(explained.contains(line), "{explained}");
    }
    // One wrong answer less: better, and nothing worse.
    let folder = scratch("verify-diff");
    let before = of(&["--format", "json"]);
    let mended = [
        vec![(answers[0].0.clone(), json!("hit"))],
        answers[1..].to_vec(),
    ]
    .concat();
    let after = verify(&results(&mended), &["--format", "json"], 0).0;
    fs::write(folder.join("before.json"), before).unwrap();
    fs::write(folder.join("after.json"), after).unwrap();
    let (diff, _) = ends(&folder, &["diff", "before.json", "after.json"], 0);
    assert!(diff.contains("0 worse, 1 better"), "{diff}");
}

#[test]
fn the_text_counts_by_topic_and_shows_wrong_and_missing_answers() {
    let tests = tests();
    let hit = tests.iter().find(|test| test["result"] == "hit").unwrap();
    let id = hit["id"].as_str().unwrap().to_owned();
    let report = unwrapped(&verify(&results(&[(id.clone(), json!("miss"))]), &[], 1).0);
    assert!(
        report.starts_with("mine: 1 wrong answer, 0 right; 0 free to be either, "),
        "{report}"
    );
    assert!(report.contains(&format!(
        "{} of {} tests without a result",
        tests.len() - 1,
        tests.len()
    )));
    assert!(report.contains(&format!(
        "{id}: miss, expected hit ({}",
        hit["comment"].as_str().unwrap()
    )));
    let (report, _) = verify(&results(&[(id, json!("hit"))]), &[], 0);
    assert!(
        report.starts_with("mine: 0 wrong answers, 1 right; "),
        "{report}"
    );
}

#[test]
fn a_test_that_was_not_asked_is_not_missing() {
    let tests = tests();
    let id = |place: usize| tests[place]["id"].as_str().unwrap().to_owned();
    let hit = tests.iter().find(|test| test["result"] == "hit").unwrap();
    let hit = (hit["id"].as_str().unwrap().to_owned(), json!("hit"));
    let other = (0..).map(id).find(|id| *id != hit.0).unwrap();
    let asked = (other, json!("not asked"));
    let report = unwrapped(&verify(&results(&[hit.clone(), asked.clone()]), &[], 0).0);
    let (missing, all) = (tests.len() - 2, tests.len());
    let counts = format!("{missing} of {all} tests without a result, 1 not asked");
    assert!(report.contains(&counts), "{report}");
    let (_, error) = verify(&results(&[asked]), &[], 4);
    assert!(error.contains("it answers no test"), "{error}");
    let infinite = (hit.0, json!({"hit": true, "t": "inf"}));
    let (report, _) = verify(&results(&[infinite]), &["--format", "json"], 1);
    assert!(report.contains("a value that is not finite"), "{report}");
}

#[test]
fn values_are_judged_where_they_are_given() {
    let tests = tests();
    let hit = tests
        .iter()
        .find(|test| test["result"] == "hit" && test["t"] == 3)
        .unwrap();
    let id = hit["id"].as_str().unwrap().to_owned();
    let (t, u, v) = (&hit["t"], &hit["u"], &hit["v"]);
    for right in [
        json!({"hit": true}),
        json!({"hit": true, "t": t}),
        json!({"hit": true, "t": t, "u": u, "v": v}),
        json!({"hit": true, "t": null, "u": u, "v": v}),
    ] {
        let report = unwrapped(&verify(&results(&[(id.clone(), right)]), &[], 0).0);
        assert!(
            report.starts_with("mine: 0 wrong answers, 1 right; "),
            "{report}"
        );
    }
    let wrong = json!({"hit": true, "t": 7.0, "u": u, "v": v});
    let report = unwrapped(&verify(&results(&[(id.clone(), wrong)]), &[], 1).0);
    assert!(
        report.contains(&format!("{id}: hit with t = 7.0, exactly 3.0")),
        "{report}"
    );
    let (_, error) = verify(
        &results(&[(id.clone(), json!({"hit": true, "u": 1}))]),
        &[],
        65,
    );
    assert!(
        error.contains("u and v: expected both or neither"),
        "{error}"
    );
    let (_, error) = verify(&results(&[(id, json!({"hit": false, "t": 1}))]), &[], 65);
    assert!(
        error.contains("t, u and v: expected none with a miss"),
        "{error}"
    );
}

#[test]
fn bad_results_are_refused_in_one_line_with_file_and_line() {
    let tests = tests();
    let id = |group: bool| {
        let found = tests
            .iter()
            .find(|test| test["triangles"].is_array() == group);
        found.unwrap()["id"].as_str().unwrap().to_owned()
    };
    let (single, group) = (id(false), id(true));
    // What is free has answers of its kind all the same.
    let free = tests
        .iter()
        .find(|test| test["result"] == "free" && test["triangles"].is_array());
    let free = free.unwrap()["id"].as_str().unwrap();
    let (_, error) = verify(&results(&[(free.to_owned(), json!("hit"))]), &[], 65);
    assert!(error.contains("because the test is a group"), "{error}");
    let good = results(&[(single.clone(), json!("hit")), (group.clone(), json!(1))]);
    let replaced = |old: &str, new: &str| good.replacen(old, new, 1);
    let cases: BTreeMap<&str, (String, String)> = BTreeMap::from([
        (
            "cut",
            (
                good[..good.len() - 4].to_owned(),
                "results.json:5: EOF while parsing".to_owned(),
            ),
        ),
        (
            "empty",
            (
                String::new(),
                "results.json:1: EOF while parsing a value".to_owned(),
            ),
        ),
        (
            "array",
            (
                "[]".to_owned(),
                "results.json: expected an object, found []".to_owned(),
            ),
        ),
        (
            "twice",
            (
                replaced(&format!("\"{group}\":1"), &format!("\"{single}\":\"hit\"")),
                format!("results.json:5: a second result of '{single}'"),
            ),
        ),
        (
            "nan",
            (
                replaced("\"hit\"", "NaN"),
                "results.json:4: expected value".to_owned(),
            ),
        ),
        (
            "word",
            (
                replaced("\"hit\"", "\"NaN\""),
                format!(
                    "results.json:4: {single}: expected \"hit\", \"miss\" or a number of hits, found \"NaN\""
                ),
            ),
        ),
        (
            "hash",
            (
                replaced("\"vectors\":\"", "\"vectors\":\"0"),
                "results.json:1: vectors: the results are of '0".to_owned(),
            ),
        ),
        (
            "unknown id",
            (
                replaced(&single, "edges-00000000"),
                "results.json:4: no test of these vectors has the id 'edges-00000000'".to_owned(),
            ),
        ),
        (
            "count for a single",
            (
                replaced("\"hit\"", "1"),
                format!(
                    "results.json:4: {single}: expected \"hit\" or \"miss\", because the test has one triangle"
                ),
            ),
        ),
        (
            "word for a group",
            (
                replaced(&format!("{group}\":1"), &format!("{group}\":\"hit\"")),
                format!(
                    "results.json:5: {group}: expected the number of its triangles that are hit"
                ),
            ),
        ),
        (
            "more hits than triangles",
            (
                replaced(&format!("{group}\":1"), &format!("{group}\":99")),
                format!(
                    "results.json:5: {group}: expected the number of its triangles that are hit"
                ),
            ),
        ),
        (
            "field",
            (
                replaced("product", "produkt"),
                "results.json: unknown field 'produkt'".to_owned(),
            ),
        ),
        (
            "no product",
            (
                replaced("\"product\":\"mine\",", ""),
                "results.json: missing field 'product'".to_owned(),
            ),
        ),
        (
            "no object",
            (
                format!(
                    "{}[]}}",
                    &good[..good.find('{').unwrap() + good[1..].find('{').unwrap() + 1]
                ),
                "results.json:3: results: expected an object, found []".to_owned(),
            ),
        ),
    ]);
    for (what, (text, message)) in cases {
        let (out, error) = verify(&text, &[], 65);
        assert!(
            out.is_empty() && error.contains(&message),
            "{what}: {error}"
        );
        assert_eq!(error.lines().count(), 1, "{what}: {error}");
    }
    let (_, error) = verify(&results(&[]), &[], 4);
    assert!(
        error.contains("results.json: it answers no test"),
        "{error}"
    );
    let (_, error) = verify(&good, &["--profile", "vulcan"], 2);
    assert!(
        error.contains("unknown profile 'vulcan'; did you mean 'vulkan'?"),
        "{error}"
    );
    let (_, error) = ends(&scratch("verify-none"), &["verify", "none.json"], 74);
    assert!(error.contains("none.json"), "{error}");
}

#[test]
fn the_readers_have_at_most_fifty_lines() {
    let files = [
        "reader.c",
        "reader.py",
        "reader.mjs",
        "Reader.java",
        "reader.rs",
        "reader.go",
        "Reader.cs",
    ];
    for file in files {
        let text = fs::read_to_string(repository().join("examples/vectors").join(file)).unwrap();
        assert!(
            text.lines().count() <= 50,
            "{file}: {}",
            text.lines().count()
        );
    }
}
