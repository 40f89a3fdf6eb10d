//! `--format html` as a user meets it: what is in the file, whatever the threads and the shards, and what
//! happens where it cannot be written. tests/browser looks at it in a browser.

use crate::json_schema;
use crate::program;

use program::{ends, resealed, scratch};
use serde_json::Value;
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

const PLAN: &[&str] = &[
    "-q",
    "--kernel",
    "moller-trumbore,havel-herout",
    "--family",
    "edge-near,tiny,fan",
    "-n",
    "100",
    "--attribute",
    "5",
];

fn read_json(file: &Path) -> Value {
    serde_json::from_slice(&fs::read(file).unwrap()).unwrap()
}

#[test]
fn the_pictures_are_the_same_whatever_the_threads_and_the_shards() {
    let folder = scratch("html-same");
    let audit = |more: &[&str]| {
        ends(&folder, &[&["audit"], PLAN, more].concat(), 0);
    };
    let both = ["--format", "html,json"];
    audit(
        &[
            &both[..],
            &["-o", "1.html", "-o", "1.json", "--threads", "1"],
        ]
        .concat(),
    );
    audit(
        &[
            &both[..],
            &["-o", "2.html", "-o", "2.json", "--threads", "2"],
        ]
        .concat(),
    );
    audit(&["--format", "json", "-o", "plain.json"]);
    audit(&[
        "--format",
        "json",
        "-o",
        "always.json",
        "--illustrate",
        "always",
    ]);
    audit(&[
        "--format",
        "html",
        "-o",
        "never.html",
        "--illustrate",
        "never",
    ]);
    for shard in ["0/2", "1/2"] {
        let file = format!("shard-{}.json", &shard[..1]);
        let more = [
            "--format",
            "html,json",
            "-o",
            "part.html",
            "-o",
            &file,
            "--shard",
            shard,
        ];
        audit(&more);
        assert!(
            read_json(&folder.join(&file))
                .get("illustrations")
                .is_none()
        );
    }
    let merge = [
        "merge",
        "-q",
        "shard-0.json",
        "shard-1.json",
        "--format",
        "html,json",
    ];
    ends(
        &folder,
        &[&merge[..], &["-o", "merged.html", "-o", "merged.json"]].concat(),
        0,
    );

    let first = read_json(&folder.join("1.json"));
    let pictures = &first["illustrations"];
    // Two kernels in two scalars.
    assert_eq!(pictures["proofs"].as_array().unwrap().len(), 2 * 2);
    for other in ["2.json", "always.json", "merged.json"] {
        let other = read_json(&folder.join(other));
        assert_eq!(&other["illustrations"], pictures);
        assert_eq!(other["result"], first["result"]);
    }
    let plain = read_json(&folder.join("plain.json"));
    assert!(plain.get("illustrations").is_none());
    assert_eq!(
        plain["result"], first["result"],
        "the result does not depend on the pictures"
    );

    let page = |name: &str| fs::read_to_string(folder.join(name)).unwrap();
    // All but times and threads.
    let kept = |name: &str| -> String {
        let text = page(name);
        let end = text.find("<h2>About this run").unwrap();
        let start = text.find("<h2>Every question").unwrap();
        let times = text[start..end].split("ns a ray</th>");
        let kept: String = times
            .map(|part| part.split_once("</tr>").map_or(part, |pair| pair.1))
            .collect();
        // The last cell of a row of the table of every row.
        let (every, rest) = kept.split_once("<h2>moller-trumbore").unwrap();
        let rows = every.split("</tr>");
        let rows = rows.map(|row| row.rsplit_once("<td").map_or(row, |(before, _)| before));
        rows.collect::<String>() + rest
    };
    assert_eq!(kept("1.html"), kept("2.html"));
    assert_eq!(kept("1.html"), kept("merged.html"));
    assert!(page("1.html").contains("Drawing of the worst false-"));
    assert!(
        page("part.html")
            .contains("A part of a run: shard 1 of 2 only; all numbers are of this part.")
    );
    assert!(!page("never.html").contains("Drawing of the worst false-"));
}

#[test]
fn the_page_holds_the_numbers_and_the_commands_of_the_record() {
    let folder = scratch("html-numbers");
    let outputs = ["--format", "html,json", "-o", "r.html", "-o", "r.json"];
    ends(&folder, &[&["audit"], PLAN, &outputs[..]].concat(), 0);
    let page = fs::read_to_string(folder.join("r.html")).unwrap();
    let record = read_json(&folder.join("r.json"));
    let escaped = |text: &Value| {
        text.as_str()
            .unwrap()
            .replace('&', "&amp;")
            .replace('<', "&lt;")
    };
    let mut shown: BTreeMap<_, bool> = BTreeMap::new();
    for result in record["result"]["results"].as_array().unwrap() {
        for kind in ["false_misses", "false_hits"] {
            let rate = &result["total"][kind];
            if rate["of"] != 0 && rate["of"].as_u64().unwrap() < 1000 {
                let counts = format!("{} of {}", rate["count"], rate["of"]);
                assert!(page.contains(&counts), "{counts}");
            }
        }
        for finding in result["findings"].as_array().unwrap() {
            // The worst of all families.
            let command = format!("<code>{}</code>", escaped(&finding["worst"]["command"]));
            let class = ["finding", "class"].map(|key| finding[key].to_string());
            let row = ["kernel", "set", "scalar"].map(|key| result[key].to_string());
            *shown.entry((row, class)).or_default() |= page.contains(&command);
        }
    }
    assert!(
        10 < shown.len() && shown.values().all(|shown| *shown),
        "{shown:?}"
    );
    // What is proved of each gate, as `prove` has it: in the gate's row of the kernel's section, f32 before f64.
    let mut bounds = 0;
    for kernel in ["moller-trumbore", "havel-herout"] {
        let (proofs, _) = ends(
            &folder,
            &["prove", "--format", "json", "--kernel", kernel],
            0,
        );
        let proofs: Value = json_schema::result(&proofs);
        let section = page.split_once(&format!("<h2>{kernel} ")).unwrap().1;
        let mut cells: BTreeMap<&str, String> = BTreeMap::new();
        for gate in proofs["gates"].as_array().unwrap() {
            let hundredths = |x: &Value| x.as_f64().unwrap() * 100.0;
            *cells.entry(gate["gate"].as_str().unwrap()).or_default() +=
                &if gate["bound_units"].is_null() {
                    ">no bound</td>".to_owned()
                } else {
                    let bound = hundredths(&gate["bound_units"]).ceil() / 100.0;
                    let known = hundredths(&gate["witness"]["units"]).floor() / 100.0;
                    format!(">{bound:.2} u ({known:.2} u)</td>")
                };
            bounds += 1;
        }
        for (gate, cells) in cells {
            let row = section
                .split_once(&format!("<th scope=\"row\">{gate}</th>"))
                .unwrap()
                .1;
            let row = row.split_once("</tr>").unwrap().0;
            // Without the cells' attributes.
            let cut = row
                .split("<td")
                .map(|cell| cell.split_once('>').map_or(cell, |pair| pair.1));
            let row = cut.map(|cell| format!(">{cell}")).collect::<String>();
            assert!(row.ends_with(&cells), "{kernel} {gate}: {row}");
        }
    }
    assert_eq!(bounds, 10);
    // The verdict of a check.
    let (out, _) = ends(
        &folder,
        &["check", "--record", "r.json", "--format", "html", "-q"],
        1,
    );
    assert!(
        out.contains(
            " wrong answers of moller-trumbore and 1 other, and no file says which are known</h1>"
        ),
        "{}",
        &out[..6000]
    );
}

#[test]
fn records_from_before_and_from_anybody_are_shown() {
    let folder = scratch("html-records");
    ends(
        &folder,
        &[&["audit"], PLAN, &["--format", "json", "-o", "r.json"]].concat(),
        0,
    );
    let text = fs::read_to_string(folder.join("r.json")).unwrap();
    let show = |name: &str, text: &str, code: i32| {
        fs::write(folder.join(name), resealed(text)).unwrap();
        ends(
            &folder,
            &["check", "--record", name, "--format", "html", "-q"],
            code,
        )
    };
    let (old, _) = show("old.json", &text, 1);
    assert!(old.contains("moller-trumbore") && !old.contains("Float by float"));
    let hostile = text.replace("moller-trumbore", "<script>alert(1)</script>");
    let (_, error) = show("hostile.json", &hostile, 65);
    assert!(error.contains("is no name for a kernel"), "{error}");
    let family = "\"family\": \"";
    let hostile_family = text.replace(
        &format!("{family}edge-near"),
        &format!("{family}\\\"><img src=x>"),
    );
    let (page, _) = show("family.json", &hostile_family, 1);
    assert!(page.contains("&lt;img src=x&gt;") && !page.contains("<img"));
}

#[test]
fn a_page_that_cannot_be_written_is_an_error_and_leaves_nothing() {
    let folder = scratch("html-target");
    fs::create_dir(folder.join("taken")).unwrap();
    let mut targets = vec!["no/such/folder/r.html", "taken"];
    if Path::new("/dev/full").exists() {
        targets.push("/dev/full");
    }
    for target in targets {
        let more = ["--format", "html", "-o", target, "--illustrate", "never"];
        let (out, error) = ends(&folder, &[&["audit"], PLAN, &more[..]].concat(), 74);
        assert_eq!(out, "");
        assert!(error.contains(target), "{error}");
    }
    let left: Vec<_> = fs::read_dir(&folder)
        .unwrap()
        .map(|e| e.unwrap().file_name())
        .collect();
    assert_eq!(left, ["taken"]);
    let error = ends(&folder, &["audit", "--illustrate", "sometimes"], 2).1;
    assert!(error.contains("sometimes"), "{error}");
}

/// In space: what lies where is seen, also where the plane's drawing is a line.
#[test]
fn the_page_of_a_case_shows_its_triangles_and_ray_in_space() {
    let folder = scratch("html-explain");
    let of = |case: &str, format: &str| {
        let all = [
            "explain",
            case,
            "--kernel",
            "moller-trumbore",
            "--format",
            format,
        ];
        ends(&folder, &all, 0).0
    };
    let fan = of("vertex-fan@1/f32/-/1/2", "html");
    assert!(fan.contains("class=\"spot exact\"") && fan.contains("exact: faces 0, 1, 2 …"));
    assert_eq!(fan.matches("class=\"face exact\"").count(), 5);
    assert!(!of("vertex-fan@1/f32/-/1/2", "text").contains("exact: faces"));
    // A ray that meets nothing is drawn too; of numbers that mean nothing there is no picture.
    let missed = of("outside@3/f32/-/1/0", "html");
    assert!(missed.contains("class=\"ray\"") && missed.contains("No face is hit."));
    let nothing = "{scalar:f32,origin:[nan,0,0],direction:[0,0,1],a:[0,0,1],b:[1,0,1],c:[0,1,1]}";
    assert!(!of(nothing, "html").contains("class=\"ray\""));
}
