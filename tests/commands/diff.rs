//! `hairline diff` of real records: better and worse on the same cases, and by intervals on others.

use crate::program;

use hairline::internals::record::Record;
use program::{ends, flat, resealed, scratch, with_value};
use serde_json::json;
use std::fs;
use std::path::Path;

fn audit(folder: &Path, file: &str, more: &[&str]) {
    let plan = [
        "audit",
        "-q",
        "--kernel",
        "cramer",
        "--epsilon-preset",
        "bvh",
        "--scalar",
        "f32",
    ];
    let rest = [
        "-n",
        "2000",
        "--attribute",
        "0",
        "--format",
        "json",
        "-o",
        file,
    ];
    ends(folder, &[&plan[..], &rest, more].concat(), 0);
}

#[test]
fn the_same_cases_differ_by_count_and_other_cases_by_intervals() {
    let folder = scratch("diff");
    audit(&folder, "one.json", &["--family", "edge-near,tiny"]);
    audit(
        &folder,
        "seed.json",
        &["--family", "edge-near,tiny", "--seed", "2"],
    );
    let (same, _) = ends(&folder, &["diff", "one.json", "one.json"], 0);
    assert!(same.contains("the same cases"), "{same}");
    assert!(same.starts_with("0 worse, 0 better\n"), "{same}");
    let (seed, _) = ends(&folder, &["diff", "one.json", "seed.json"], 0);
    assert!(
        seed.contains("intervals") && seed.starts_with("0 worse, 0 better, 6 too little to tell\n"),
        "{seed}"
    );
    assert!(!seed.contains(" 0 too little"), "{seed}");

    // One kernel row with other cases: every triangle of `tiny` is smaller still, and missed.
    audit(
        &folder,
        "scaled.json",
        &["--family", "edge-near", "--scale", "2^-30"],
    );
    let (worse, _) = ends(&folder, &["diff", "one.json", "scaled.json"], 0);
    let line = "Worse\ncramer (bvh: parallel+t) f32 edge-near: false-miss of ";
    assert!(worse.contains(line), "{worse}");
    assert!(
        flat(&worse).contains(" now hairline explain 'edge-near@2/f32/scale=2^-30/1/"),
        "{worse}"
    );
    assert!(worse.contains("that only the old record has"), "{worse}");
    ends(
        &folder,
        &["diff", "--exit-code", "one.json", "scaled.json"],
        1,
    );
    ends(
        &folder,
        &["diff", "--exit-code", "one.json", "seed.json"],
        0,
    );
    let (better, _) = ends(&folder, &["diff", "scaled.json", "one.json"], 0);
    assert!(
        better.contains("Better\ncramer") && better.contains("only the new record has"),
        "{better}"
    );
}

#[test]
fn one_case_more_on_the_same_cases_is_worse() {
    let folder = scratch("diff-one");
    audit(&folder, "one.json", &["--family", "edge-near"]);
    let text = std::fs::read_to_string(folder.join("one.json")).unwrap();
    let mut record: serde_json::Value = serde_json::from_str(&text).unwrap();
    // The class as a whole, and its finding: both say how often.
    let result = &mut record["result"]["results"][0];
    let class = result["findings"][0]["class"].as_str().unwrap().to_owned();
    let kind = result["findings"][0]["finding"]
        .as_str()
        .unwrap()
        .replace('-', "_");
    let field = format!("{kind}{}", if kind == "false_miss" { "es" } else { "s" });
    let count = result["findings"][0]["rate"]["count"].as_u64().unwrap() + 1;
    let change = |rate: &mut serde_json::Value| {
        rate["rate"] = (count as f64 / rate["of"].as_f64().unwrap()).into();
        rate["count"] = count.into();
    };
    change(&mut result["findings"][0]["rate"]);
    change(&mut result["classes"][&class][&field]);
    let changed = record.to_string();
    std::fs::write(folder.join("more.json"), &changed).unwrap();
    let (_, error) = ends(&folder, &["diff", "one.json", "more.json"], 65);
    assert!(
        error.contains("more.json: its result is not the one that hairline wrote"),
        "{error}"
    );
    // The total too, as the classes add up to it.
    let total = &mut record["result"]["results"][0]["total"][&field];
    let all = total["count"].as_u64().unwrap() + 1;
    total["rate"] = (all as f64 / total["of"].as_f64().unwrap()).into();
    total["count"] = all.into();
    let more: Record = serde_json::from_value(record.clone()).unwrap();
    std::fs::write(
        folder.join("more.json"),
        serde_json::to_string(&more).unwrap(),
    )
    .unwrap();
    // A rate that its counts do not give is refused whatever the checksum says.
    let wrong = changed.replacen(&format!("\"count\":{count},"), "\"count\":987654321,", 1);
    std::fs::write(folder.join("wrong.json"), wrong).unwrap();
    let (_, error) = ends(&folder, &["diff", "one.json", "wrong.json"], 65);
    assert!(error.contains("wrong.json:1: found a rate of "), "{error}");
    let rate = format!("\"count\":{},", count - 1);
    let wrong = changed.replacen(&format!("\"count\":{count},"), &rate, 1);
    std::fs::write(folder.join("wrong.json"), wrong).unwrap();
    let (_, error) = ends(&folder, &["diff", "one.json", "wrong.json"], 65);
    assert!(
        error.contains("wrong.json:1: found a rate of 0.")
            && error.contains(&format!(" for {} of ", count - 1)),
        "{error}"
    );
    let counted = |old: &str, new: &str| {
        let (json, _) = ends(&folder, &["diff", old, new, "--format", "json"], 0);
        let comparison: serde_json::Value = serde_json::from_str(&json).unwrap();
        let changes = comparison["differences"].as_array().unwrap();
        changes
            .iter()
            .map(|d| d["change"].as_str().unwrap().to_owned())
            .collect::<Vec<_>>()
    };
    assert_eq!(counted("one.json", "more.json"), ["worse"]);
    assert_eq!(counted("more.json", "one.json"), ["better"]);
    // A family more does not make the cases of the others other ones.
    audit(&folder, "two.json", &["--family", "edge-near,behind"]);
    let (json, _) = ends(
        &folder,
        &["diff", "more.json", "two.json", "--format", "json"],
        0,
    );
    let comparison: serde_json::Value = serde_json::from_str(&json).unwrap();
    assert_eq!(comparison["same_cases"], true, "{json}");
    assert_eq!(comparison["differences"][0]["change"], "better", "{json}");
    // The same kernel under another contract answers another question.
    audit(
        &folder,
        "open.json",
        &["--family", "edge-near", "--contract", "open-ray"],
    );
    let (open, _) = ends(&folder, &["diff", "one.json", "open.json"], 0);
    assert!(
        open.contains("\ncramer (bvh: parallel+t)\n    before: ")
            && open.contains("by another contract"),
        "{open}"
    );
    let (same, _) = ends(&folder, &["diff", "one.json", "one.json"], 0);
    assert!(!same.contains("another contract"), "{same}");
    // Nothing in common is no agreement.
    audit(&folder, "other.json", &["--family", "behind"]);
    let (_, error) = ends(&folder, &["diff", "one.json", "other.json"], 4);
    assert!(error.contains("nothing to compare"), "{error}");
    // Another version, or no record at all.
    std::fs::write(folder.join("bad.json"), "{}").unwrap();
    ends(&folder, &["diff", "one.json", "bad.json"], 65);
    ends(&folder, &["diff", "one.json", "none.json"], 74);
}

#[test]
fn triangles_of_one_ray_that_are_wrong_together_are_no_difference() {
    let folder = scratch("diff-rays");
    let plan = [
        "audit",
        "-q",
        "--kernel",
        "plane-unit-normal",
        "--epsilon",
        "edge=1e-6",
    ];
    let family = [
        "--family",
        "polygon",
        "-n",
        "400",
        "--scalar",
        "f32",
        "--attribute",
        "0",
    ];
    for seed in ["27", "77"] {
        let file = format!("{seed}.json");
        let rest = ["--seed", seed, "--format", "json", "-o", &file];
        ends(&folder, &[&plan[..], &family, &rest].concat(), 0);
    }
    // As independent trials, false misses at a vertex would differ: a ray has up to six triangles there.
    let (out, _) = ends(&folder, &["diff", "27.json", "77.json"], 0);
    assert!(
        out.starts_with("0 worse, 0 better, 12 too little to tell\n"),
        "{out}"
    );
    // Trials with a ray of their own have nothing to say about it.
    let record = fs::read_to_string(folder.join("27.json")).unwrap();
    let record: serde_json::Value = serde_json::from_str(&record).unwrap();
    let result = &record["result"]["results"][0];
    let rays = &result["classes"]["vertex/back/within"]["false_misses"]["rays"];
    let products = json!({ "count_squared": 323, "count_times_of": 328, "of_squared": 336 });
    assert_eq!(rays, &products);
    assert_eq!(result["across"]["cracks"].get("rays"), None);
}

#[test]
fn records_of_every_study_are_compared_and_those_of_two_are_not() {
    let folder = scratch("diff-studies");
    let kernel = [
        "-k",
        "moller-trumbore",
        "--scalar",
        "f32",
        "-q",
        "--format",
        "json",
    ];
    let write = |file: &str, study: &[&str]| {
        ends(&folder, &[study, &kernel, &["-o", file]].concat(), 0);
    };
    let studies = [
        (
            "epsilon",
            vec!["epsilon", "--scene", "room", "-n", "500"],
            vec!["--seed", "2"],
        ),
        (
            "offset",
            vec!["offset", "--scene", "room", "-n", "2000"],
            vec!["--seed", "2"],
        ),
        ("prove", vec!["prove"], vec!["--seed", "2"]),
    ];
    let mut compared = Vec::new();
    for (name, study, other) in &studies {
        let [one, two] = [1, 2].map(|number| format!("{name}-{number}.json"));
        write(&one, study);
        write(&two, &[&study[..], other].concat());
        let (same, _) = ends(&folder, &["diff", "--exit-code", &one, &one], 0);
        assert!(same.starts_with("0 worse, 0 better"), "{name}: {same}");
        let (json, _) = ends(&folder, &["diff", &one, &two, "--format", "json"], 0);
        compared.push(serde_json::from_str::<serde_json::Value>(&json).unwrap());
    }
    let [epsilon, offset, prove] = &compared[..] else {
        panic!("three")
    };
    // Other rays of the same scene, with epsilons of its own.
    assert_eq!(epsilon["same_cases"], false);
    assert!(
        epsilon["chosen"]
            .as_array()
            .unwrap()
            .iter()
            .all(|it| it["change"].is_null())
    );
    assert!(10 < epsilon["compared"].as_u64().unwrap(), "{epsilon}");
    assert!(0 < offset["compared"].as_u64().unwrap(), "{offset}");
    assert_eq!(prove["chosen"].as_array().unwrap().len(), 0);
    // A bound and a rate that are higher.
    let read = |file: &str| fs::read_to_string(folder.join(file)).unwrap();
    let write_edited = |to: &str, text: &str| fs::write(folder.join(to), resealed(text)).unwrap();
    write_edited(
        "prove-3.json",
        &with_value(&read("prove-1.json"), &["gates", "bound"], "0.5"),
    );
    let (told, _) = ends(
        &folder,
        &["diff", "--exit-code", "prove-1.json", "prove-3.json"],
        1,
    );
    assert!(
        told.starts_with("1 value differs, 1 of them worse\n"),
        "{told}"
    );
    ends(
        &folder,
        &["diff", "--exit-code", "prove-3.json", "prove-1.json"],
        0,
    );
    let offset = read("offset-1.json");
    let parsed: serde_json::Value = serde_json::from_str(&offset).unwrap();
    let rate = &parsed["result"]["points"][0]["schemes"][0]["wrong"];
    assert_ne!(rate["count"], rate["of"]);
    let wrong = ["points", "schemes", "wrong"];
    let all = with_value(
        &offset,
        &[&wrong[..], &["count"]].concat(),
        &rate["of"].to_string(),
    );
    write_edited(
        "offset-3.json",
        &with_value(&all, &[&wrong[..], &["rate"]].concat(), "1.0"),
    );
    let (told, _) = ends(
        &folder,
        &["diff", "--exit-code", "offset-1.json", "offset-3.json"],
        1,
    );
    assert!(
        told.starts_with("1 worse, 0 better") && told.contains("wrong sides"),
        "{told}"
    );
    // Another scene, mesh or domain is another question.
    write("city.json", &["offset", "--scene", "city", "-n", "100"]);
    write("domain.json", &["prove", "--scene", "room", "-n", "0"]);
    for name in ["far", "needles"] {
        let mesh = format!("{}/corpora/meshes/{name}.obj", env!("CARGO_MANIFEST_DIR"));
        write(
            &format!("{name}.json"),
            &["mesh", &mesh, "--directions", "1"],
        );
    }
    ends(&folder, &["diff", "--exit-code", "far.json", "far.json"], 0);
    for (old, new) in [
        ("offset-1.json", "city.json"),
        ("prove-1.json", "domain.json"),
        ("far.json", "needles.json"),
    ] {
        let (_, error) = ends(&folder, &["diff", old, new], 4);
        assert!(
            error.contains("the records answer different questions: before "),
            "{error}"
        );
    }
    let (_, error) = ends(&folder, &["diff", "offset-1.json", "prove-1.json"], 65);
    let expected = "prove-1.json: a record of `hairline prove`, expected one of `hairline offset`";
    assert!(error.contains(expected), "{error}");
    let (_, error) = ends(&folder, &["check", "--record", "offset-1.json"], 65);
    assert!(
        error.contains("offset-1.json: a record of `hairline offset`"),
        "{error}"
    );
    let text = fs::read_to_string(folder.join("offset-1.json")).unwrap();
    // Records of the command's old name.
    let [now, once] = ["offset", "spawn"].map(|name| format!("\"study\": \"{name}\""));
    assert!(text.contains(&now), "{text}");
    fs::write(folder.join("spawn.json"), text.replace(&now, &once)).unwrap();
    ends(
        &folder,
        &["diff", "--exit-code", "spawn.json", "offset-1.json"],
        0,
    );
    fs::write(
        folder.join("old.json"),
        text.replacen("record/2", "record/1", 1),
    )
    .unwrap();
    let (_, error) = ends(&folder, &["diff", "old.json", "old.json"], 65);
    assert!(
        error.contains("schema 'hairline-record/1', expected 'hairline-record/2'"),
        "{error}"
    );
    fs::write(
        folder.join("changed.json"),
        text.replacen("\"hits\": ", "\"hits\": 1", 1),
    )
    .unwrap();
    let (_, error) = ends(&folder, &["diff", "changed.json", "offset-1.json"], 65);
    assert!(
        error.contains("changed.json: its result is not the one"),
        "{error}"
    );
}
