//! One quantity has one number: the table, the screen of a single kernel, `--details`, `check` and the record of one run are
//! read and held equal.

use crate::plugin::library;
use crate::program;

use program::{ends, flat, scratch};
use serde_json::Value;
use std::fs;
use std::path::{Path, PathBuf};

/// The families of the columns that count as visible.
const FAMILIES: &str = "interior,edge-near,shared-edge,fan,tiny,sliver,interval-ends,range-ends";

/// One run of a kernel, as the commands print it.
struct Run {
    label: String,
    record: Value,
    table: String,
    single: String,
    details: String,
}

/// Integers from a text, commas left out, in order.
fn integers(text: &str) -> Vec<u64> {
    let words = text.split(|c: char| !c.is_ascii_digit() && c != ',');
    words
        .filter_map(|word| word.replace(',', "").parse().ok())
        .collect()
}

/// The text between two others.
fn between<'a>(text: &'a str, start: &str, end: &str) -> &'a str {
    let (_, rest) = text
        .split_once(start)
        .unwrap_or_else(|| panic!("{start} in {text}"));
    rest.split_once(end)
        .unwrap_or_else(|| panic!("{end} in {rest}"))
        .0
}

fn all<'a>(record: &'a Value, list: &str) -> Vec<&'a Value> {
    record["result"][list].as_array().unwrap().iter().collect()
}

fn sum(values: &[&Value], path: &str) -> u64 {
    values
        .iter()
        .filter_map(|value| value.pointer(path)?.as_u64())
        .sum()
}

fn is_extreme(value: &Value) -> bool {
    value["family"] == "range-ends"
}

/// The answers off by 2^-10 edges or more in a result: verdicts and values.
fn visible(result: &Value) -> u64 {
    let of_kind = |kind: &str| -> u64 {
        let octaves = result["severity"][kind]["edges"]["octaves"].as_object();
        let is_far = |octave: &str| {
            let exponent = octave
                .strip_prefix("2^")
                .and_then(|text| text.parse::<i32>().ok());
            octave == "inf" || exponent.is_some_and(|exponent| -10 <= exponent)
        };
        let counts = octaves
            .into_iter()
            .flatten()
            .filter(|(octave, _)| is_far(octave));
        counts.map(|(_, count)| count.as_u64().unwrap()).sum()
    };
    ["false-miss", "false-hit", "wrong-value"]
        .into_iter()
        .map(of_kind)
        .sum()
}

/// The runs of a kernel alone, and beside others.
fn run(folder: &Path, kernel: &[&str], label: &str, name: &str) -> Run {
    let plan = ["-n", "300", "--scalar", "f64", "--family", FAMILIES];
    let audit = |more: &[&str]| ends(folder, &[&["audit", "-q"], more, &plan[..]].concat(), 0).0;
    let others = format!("{name},cramer,half-space");
    let in_table = [kernel, &["--kernel", &others]].concat();
    let file = format!("{name}.json");
    let single = audit(&[kernel, &["--format", "text,json", "-o", "-", "-o", &file]].concat());
    let record = serde_json::from_slice(&fs::read(folder.join(&file)).unwrap()).unwrap();
    let details = audit(&[kernel, &["--details"]].concat());
    let label = label.to_owned();
    Run {
        label,
        record,
        table: audit(&in_table),
        single: flat(&single),
        details,
    }
}

#[test]
fn the_screens_of_one_run_print_the_same_numbers() {
    let folder = scratch("numbers");
    let source = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/kernels/related.c");
    let mut runs = vec![
        run(&folder, &["--kernel", "plucker"], "plucker", "plucker"),
        run(
            &folder,
            &["--kernel", "moller-trumbore"],
            "moller-trumbore",
            "moller-trumbore",
        ),
    ];
    if let Some(library) = library(&source, "related-numbers", &["-DMISTAKE=TWICE"]) {
        runs.push(run(
            &folder,
            &["--kernel-lib", &library],
            "related",
            "related",
        ));
    }
    for run in &runs {
        let results = all(&run.record, "results");
        let sources = all(&run.record, "sources");
        let ordinary: Vec<&Value> = results
            .iter()
            .copied()
            .filter(|result| !is_extreme(result))
            .collect();
        let of_sizes = |families: &[&str]| -> u64 {
            let chosen = results
                .iter()
                .filter(|it| families.contains(&it["family"].as_str().unwrap()));
            chosen.map(|result| visible(result)).sum()
        };
        let (unusual, extreme) = (of_sizes(&["tiny", "sliver"]), of_sizes(&["range-ends"]));
        let seen: u64 = ordinary.iter().map(|result| visible(result)).sum();
        let judged = sources.iter().copied().filter(|source| !is_extreme(source));
        let answers = sum(&judged.collect::<Vec<_>>(), "/cases");
        let cracks = ["count", "of"].map(|key| sum(&results, &format!("/across/cracks/{key}")));

        // The first three sentences of the screen of one kernel.
        let (start, _) = run
            .single
            .split_once(" at shared edges and vertices")
            .unwrap();
        let leaks = start.rsplit(&run.label).next().unwrap();
        let expected = if cracks[0] == 0 {
            vec![cracks[1]]
        } else {
            cracks.to_vec()
        };
        assert_eq!(integers(leaks), expected, "{}", run.single);
        let errors = between(&run.single, "values included", " answers");
        let errors = errors.trim_start_matches([')', ':']);
        let expected = if seen == 0 {
            vec![answers]
        } else {
            vec![seen, answers]
        };
        assert_eq!(integers(errors), expected, "{}", run.single);
        let sizes = between(&run.single, "By size: ", " at extreme exponents").replace("none", "0");
        assert_eq!(
            integers(&sizes),
            [seen - unusual, unusual, extreme],
            "{}",
            run.single
        );

        // Its rows add up to the same.
        let visible_cells = |text: &str| -> u64 {
            let rows = text.lines().filter(|line| {
                let columns = ["inside ", "edges ", "vertex ", "ends ", "sizes "];
                columns.iter().any(|column| line.starts_with(column))
            });
            let cell = |line: &str| integers(line.split_whitespace().last().unwrap())[0];
            rows.map(cell).sum()
        };
        let close_up = run.details.split("Every question").next().unwrap();
        assert_eq!(visible_cells(close_up), seen, "{}", run.details);

        // The row of the table.
        let row = run
            .table
            .lines()
            .find(|line| line.starts_with(&format!("{}  ", run.label)));
        let row = row.unwrap_or_else(|| panic!("{}: {}", run.label, run.table));
        let cells: Vec<&str> = row.split_whitespace().skip(1).collect();
        let percent = cracks[0] as f64 / cracks[1] as f64 * 100.0;
        let shown: f64 = cells[0]
            .trim_end_matches('!')
            .replace('<', "")
            .parse()
            .unwrap();
        assert!(
            (shown - percent).abs() <= 0.05 || cells[0] == "<0.1",
            "{row}"
        );
        assert_eq!(integers(cells[1]), [seen], "{row}");
        let named = flat(&run.table);
        if named.contains("least often: ") {
            let least = between(&named, "least often: ", " answers");
            assert_eq!(integers(least).last(), Some(&answers), "{named}");
        }

        // The head: cases and rays.
        let head = between(&run.single, "families, ", " in f64");
        assert_eq!(
            integers(head),
            [sum(&sources, "/cases"), sum(&sources, "/indices")]
        );
        // The details: the same sums, with cracks in place of false misses at shared edges of scenes alone.
        for (name, path) in [
            ("false misses", "/total/false_misses"),
            ("false hits", "/total/false_hits"),
            ("wrong values", "/total/wrong_values"),
            ("cracks", "/across/cracks"),
        ] {
            let line = run
                .details
                .lines()
                .find(|line| line.starts_with(&format!("{name}  ")));
            let line = line.unwrap_or_else(|| panic!("{name}: {}", run.details));
            let counts = ["count", "of"].map(|key| sum(&results, &format!("{path}/{key}")));
            assert_eq!(integers(line)[..2], counts, "{line}");
        }
    }
}

#[test]
fn a_scene_tells_shared_edges_by_their_cracks_alone() {
    let folder = scratch("numbers-scene");
    let plan = [
        "audit",
        "-q",
        "-n",
        "200",
        "--scene",
        "room",
        "--scalar",
        "f32",
        "-k",
        "moller-trumbore",
    ];
    let print = |more: &[&str]| ends(&folder, &[&plan[..], more].concat(), 0).0;
    let record: Value = serde_json::from_str(&print(&["--format", "json"])).unwrap();
    let results = all(&record, "results");
    let family = |it: &Value| it["family"].as_str().unwrap().to_owned();
    let is_shared = |it: &Value| {
        let name = family(it);
        name.starts_with("scene-edges") || name.starts_with("scene-vertices")
    };
    let alone: Vec<&Value> = results
        .iter()
        .copied()
        .filter(|it| !is_shared(it))
        .collect();
    let details = print(&["--details"]);
    let line = details
        .lines()
        .find(|line| line.starts_with("false misses  "))
        .unwrap();
    let counts = ["count", "of"].map(|key| sum(&alone, &format!("/total/false_misses/{key}")));
    assert_eq!(integers(line)[..2], counts, "{line}");
    // Of the kind of planes that the scene's words name, the screen and its notes have the same cracks.
    let own: Vec<&Value> = results
        .iter()
        .copied()
        .filter(|it| is_shared(it) && !family(it).contains(':'))
        .collect();
    let cracks = ["count", "of"].map(|key| sum(&own, &format!("/across/cracks/{key}")));
    let screen = flat(&print(&[]));
    let leaks = between(
        &screen,
        "moller-trumbore (source) leaks: ",
        " rays at shared",
    );
    assert_eq!(integers(leaks), cracks, "{screen}");
    assert_eq!(
        integers(between(&screen, " cracks: ", " ("))[..2],
        cracks,
        "{screen}"
    );
}

#[test]
fn check_counts_the_findings_of_the_record() {
    let folder = scratch("numbers-check");
    let plan = [
        "-k",
        "cramer",
        "-n",
        "200",
        "--scalar",
        "f32",
        "--family",
        "tiny,edge-near",
    ];
    let (_, error) = ends(&folder, &[&["check", "--bless"], &plan[..]].concat(), 0);
    let blessed = between(&error, "known disagreements of ", " known findings").to_owned();
    let check = flat(&ends(&folder, &[&["check", "-q"], &plan[..]].concat(), 0).0);
    let said = between(&check, "Conforms: ", " wrong answers, all known").to_owned();
    let record = ends(
        &folder,
        &[&["audit", "-q", "--format", "json"], &plan[..]].concat(),
        0,
    )
    .0;
    let record: Value = serde_json::from_str(&record).unwrap();
    let findings: Vec<&Value> = all(&record, "results")
        .into_iter()
        .flat_map(|result| result["findings"].as_array().unwrap())
        .collect();
    let count = sum(&findings, "/rate/count");
    assert!(0 < count);
    assert_eq!([integers(&blessed), integers(&said)], [[count], [count]]);
}

/// t and u moved by a few ulps change no verdict, and are no wrong values: the quantiles of errors tell.
#[test]
fn larger_errors_of_right_hits_are_noticed_by_check_and_diff() {
    let folder = scratch("numbers-errors");
    let source = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/kernels/related.c");
    let builds = ["NONE", "OFF_BY_ULPS"].map(|mistake| {
        let built = library(
            &source,
            &format!("errors-{mistake}"),
            &[&format!("-DMISTAKE={mistake}")],
        );
        built.map(|path| {
            fs::copy(path, folder.join("libkernel.so")).unwrap();
            let plan = [
                "--kernel-lib",
                "./libkernel.so",
                "--family",
                "interior",
                "-n",
                "2000",
            ];
            let json = format!("{mistake}.json");
            let audit = ["audit", "-q", "--format", "json", "-o", &json];
            ends(&folder, &[&audit[..], &plan].concat(), 0);
            let check = if mistake == "NONE" {
                ["check", "--bless"]
            } else {
                ["check", "-q"]
            };
            let code = i32::from(mistake != "NONE");
            flat(&ends(&folder, &[&check[..], &plan].concat(), code).0)
        })
    });
    let [Some(_), Some(check)] = builds else {
        return;
    };
    let first = "Worse: values of right hits are less accurate than known ";
    assert!(check.starts_with(first), "{check}");
    assert!(check.contains("What to do "), "{check}");
    assert!(
        check.contains("half of the right hits have a t within "),
        "{check}"
    );
    let (diff, _) = ends(
        &folder,
        &["diff", "--exit-code", "NONE.json", "OFF_BY_ULPS.json"],
        1,
    );
    let diff = flat(&diff);
    assert!(diff.contains("errors of hits differ, "), "{diff}");
    assert!(
        diff.contains("related (own) f64: half of the right hits have a t within (worse)"),
        "{diff}"
    );
    ends(
        &folder,
        &["diff", "--exit-code", "NONE.json", "NONE.json"],
        0,
    );
    ends(
        &folder,
        &["diff", "--exit-code", "OFF_BY_ULPS.json", "NONE.json"],
        0,
    );
}
