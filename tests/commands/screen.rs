//! What `hairline audit` prints on a terminal: short, in columns that are questions, its numbers those of
//! the record.

use crate::program;

use program::{ends, flat, scratch};
use serde_json::Value;
use std::fs;
use std::path::Path;

/// The columns, each with its families. A family that is missing here has no column.
const COLUMNS: [(&str, &[&str]); 8] = [
    ("inside", &["interior", "outside", "mixed-batch"]),
    (
        "edges",
        &["edge-exact", "edge-near", "shared-edge", "polygon"],
    ),
    (
        "vertex",
        &["vertex-exact", "vertex-near", "fan", "vertex-fan"],
    ),
    (
        "flat",
        &["parallel-off", "coplanar", "grazing", "degenerate"],
    ),
    (
        "ends",
        &[
            "origin-on",
            "origin-near",
            "secondary-ray",
            "behind",
            "interval-ends",
        ],
    ),
    ("grid", &["axis-aligned", "lattice"]),
    (
        "sizes",
        &["sliver", "tiny", "huge", "far", "direction-length"],
    ),
    ("range", &["mixed-scale", "range-ends", "noise"]),
];

/// The families of ordinary sizes: those of all columns but the last.
fn ordinary() -> Vec<&'static str> {
    COLUMNS[..7]
        .iter()
        .flat_map(|(_, families)| *families)
        .copied()
        .collect()
}

/// Runs an audit, and returns what it prints and its record.
fn audit(folder: &Path, arguments: &[&str]) -> (String, Value) {
    let outputs = [
        "--quiet",
        "--format",
        "text,json",
        "-o",
        "screen.txt",
        "-o",
        "record.json",
    ];
    ends(folder, &[&["audit"], arguments, &outputs].concat(), 0);
    let record = serde_json::from_slice(&fs::read(folder.join("record.json")).unwrap()).unwrap();
    (
        fs::read_to_string(folder.join("screen.txt")).unwrap(),
        record,
    )
}

/// A row's results of some families in a scalar.
fn results<'a>(record: &'a Value, row: &Value, scalar: &str, families: &[&str]) -> Vec<&'a Value> {
    let all = record["result"]["results"].as_array().unwrap().iter();
    let is_asked = |result: &&Value| {
        let family = result["family"].as_str().unwrap();
        result["kernel"] == row["kernel"]
            && result["set"] == row["set"]
            && result["scalar"] == scalar
            && (families.is_empty() || families.contains(&family))
    };
    all.filter(is_asked).collect()
}

fn sum(results: &[&Value], paths: &[&str]) -> u64 {
    let of = |result: &&Value| {
        paths
            .iter()
            .filter_map(|path| result.pointer(path)?.as_u64())
            .sum::<u64>()
    };
    results.iter().map(of).sum()
}

/// Percent as the screen writes it, in integers: rounded to tenths, 0 and 100 only where they are exact.
fn percent(count: u64, of: u64) -> String {
    if of == 0 {
        return "-".to_owned();
    }
    if count == 0 || count == of {
        return if count == 0 { "0" } else { "100" }.to_owned();
    }
    match (count * 2000 + of) / (2 * of) {
        0 => "<0.1".to_owned(),
        tenths => format!("{}.{}", tenths.min(999) / 10, tenths.min(999) % 10),
    }
}

/// The larger of the shares of both scalars, as the screen writes it.
fn worse(shares: impl Iterator<Item = (u64, u64)>) -> String {
    let share = |(count, of): &(u64, u64)| *count as f64 / (*of).max(1) as f64;
    let (count, of) = shares.max_by(|a, b| share(a).total_cmp(&share(b))).unwrap();
    percent(count, of)
}

/// A row's name on the screen.
fn short_label(row: &Value) -> String {
    match (
        row["kernel"].as_str().unwrap(),
        row["set"].as_str().unwrap(),
    ) {
        (kernel, "source" | "own") => kernel.to_owned(),
        (kernel, "zero") => format!("{kernel} e=0"),
        (kernel, set) => format!("{kernel} e={set}"),
    }
}

#[test]
fn the_default_plan_fits_on_a_screen_and_its_numbers_are_those_of_the_record() {
    let folder = scratch("screen-default");
    let (screen, record) = audit(&folder, &["-n", "150"]);
    let lines: Vec<&str> = screen.lines().collect();
    assert!(lines.len() <= 42, "{} lines:\n{screen}", lines.len());
    let words = lines.iter().filter(|line| !line.contains("hairline "));
    let longest = words.max_by_key(|line| line.chars().count()).unwrap();
    assert!(longest.chars().count() <= 80, "{longest}");
    let head = lines
        .iter()
        .position(|line| line.starts_with("kernel  "))
        .unwrap();
    assert!(
        lines[head].contains("leaks  visible  values  sizes  flat"),
        "{screen}"
    );
    let rows = record["result"]["plan"]["rows"].as_array().unwrap();
    assert_eq!(rows.len(), 22);
    let (mut shown, mut order) = (0, Vec::new());
    for row in rows {
        let label = short_label(row);
        let line = lines[head..]
            .iter()
            .find(|line| line.starts_with(&format!("{label}  ")));
        let Some(line) = line else {
            // Like a row above it, or one of those for which there is no room.
            if flat(&screen).contains(" more rows: --details") {
                continue;
            }
            let alike = |line: &&&str| {
                let names = line.strip_prefix("  same answers: ");
                names.is_some_and(|names| names.split(", ").any(|name| name == label))
            };
            assert!(lines.iter().any(|line| alike(&line)), "{label}: {screen}");
            continue;
        };
        shown += 1;
        let cells: Vec<&str> = line[label.len()..].split_whitespace().collect();
        let of = |scalar: &'static str, families: &[&str], path: &str| {
            let all = results(&record, row, scalar, families);
            let [count, of] = ["count", "of"].map(|n| sum(&all, &[&format!("{path}/{n}")]));
            (count, of)
        };
        let scalars = ["f32", "f64"];
        let ordinary = ordinary();
        let leaks = scalars.map(|scalar| of(scalar, &ordinary, "/across/cracks"));
        // A `!` says that the kernel's documentation rules leaks out.
        assert_eq!(
            cells[0].trim_end_matches('!'),
            worse(leaks.into_iter()),
            "{label}"
        );
        let values = scalars.map(|scalar| of(scalar, &ordinary, "/total/wrong_values"));
        assert_eq!(cells[2], worse(values.into_iter()), "{label}");
        for (cell, name) in cells[3..5].iter().zip(["sizes", "flat"]) {
            let (_, families) = COLUMNS.iter().find(|(column, _)| *column == name).unwrap();
            let wrong = scalars.map(|scalar| {
                let [a, b] = ["/total/false_misses", "/total/false_hits"]
                    .map(|path| of(scalar, families, path));
                (a.0 + b.0, a.1 + b.1)
            });
            assert_eq!(*cell, worse(wrong.into_iter()), "{label} {name}");
        }
        let visible: u64 = cells[1].replace(',', "").parse().unwrap();
        let place = lines.iter().position(|other| other == line).unwrap();
        order.push((place, cells[0] != "0", visible));
    }
    assert!(12 < shown, "{screen}");
    order.sort();
    assert!(
        order
            .iter()
            .map(|(_, leaks, visible)| (leaks, visible))
            .is_sorted(),
        "{screen}"
    );
    // Each question has a column behind the flag.
    let details = ["audit", "-q", "-n", "150", "--details"];
    let everything = ends(&folder, &details, 0).0;
    let lines: Vec<&str> = everything.lines().collect();
    for scalar in ["f32", "f64"] {
        let is_head = |line: &&str| line.starts_with(&format!("{scalar} kernel  "));
        let head = lines.iter().position(is_head).unwrap();
        let heads: Vec<&str> = lines[head].split_whitespace().skip(2).collect();
        assert!(
            COLUMNS.iter().all(|(name, _)| heads.contains(name)),
            "{heads:?}"
        );
        for row in rows {
            let label = format!("{}  ", short_label(row));
            let is_own = |line: &&&str| line.starts_with(&label);
            let table = lines[head + 1..].iter().take_while(|line| !line.is_empty());
            let Some(line) = table.clone().find(is_own) else {
                let alike = format!(" {}", label.trim());
                let mut names = table.flat_map(|line| line.split(','));
                assert!(
                    names.any(|name| name.ends_with(&alike)),
                    "{label} {everything}"
                );
                continue;
            };
            let cells: Vec<&str> = line[label.len()..].split_whitespace().collect();
            let shown = |name: &str| cells[heads.iter().position(|head| *head == name).unwrap()];
            for (name, families) in COLUMNS {
                let all = results(&record, row, scalar, families);
                let [count, of] = ["count", "of"].map(|n| {
                    let paths = ["false_misses", "false_hits"].map(|it| format!("/total/{it}/{n}"));
                    sum(&all, &paths.each_ref().map(String::as_str))
                });
                assert_eq!(shown(name), percent(count, of), "{label} {scalar} {name}");
            }
            let all = results(&record, row, scalar, &ordinary());
            let [cracks, of] =
                ["count", "of"].map(|n| sum(&all, &[&format!("/across/cracks/{n}")]));
            let leaks = shown("leaks");
            assert_eq!(
                leaks.trim_end_matches('!'),
                percent(cracks, of),
                "{label} {scalar}"
            );
        }
    }
    for expected in [
        "ns a ray",
        "errors of right hits, in ulps",
        "hits on NaN",
        "bad-value",
        "half within",
        "; cause: rounding\n    hairline explain ",
    ] {
        assert!(everything.contains(expected), "{expected}");
    }
    assert!(500 < everything.lines().count());
}

#[test]
fn the_worst_findings_are_of_ordinary_sizes_and_their_commands_show_them() {
    let folder = scratch("screen-worst");
    let (screen, record) = audit(&folder, &["-n", "300"]);
    let commands: Vec<&str> = screen
        .lines()
        .filter_map(|line| line.strip_prefix("    hairline explain "))
        .collect();
    assert_eq!(commands.len(), 1, "{screen}");
    for command in commands {
        for family in ["range-ends", "mixed-scale", "invalid", "degenerate"] {
            assert!(!command.contains(&format!("'{family}@")), "{command}");
        }
        let words: Vec<&str> = command
            .split_whitespace()
            .map(|word| word.trim_matches('\''))
            .collect();
        let (shown, _) = ends(&folder, &[&["explain"], &words[..]].concat(), 0);
        assert!(
            shown.contains("FALSE-") || shown.contains("CRACK"),
            "{command}: {shown}"
        );
    }
    // No false verdict in an ordinary family is farther off than the first, of those that can be measured.
    let ordinary: Vec<&str> = COLUMNS[..7]
        .iter()
        .flat_map(|(_, families)| *families)
        .copied()
        .collect();
    let mut farthest = 0.0_f64;
    for result in record["result"]["results"].as_array().unwrap() {
        let is_ordinary = ordinary.contains(&result["family"].as_str().unwrap());
        for finding in result["findings"]
            .as_array()
            .unwrap()
            .iter()
            .filter(|_| is_ordinary)
        {
            let [kind, class] = ["finding", "class"].map(|key| finding[key].as_str().unwrap());
            let severity = &finding["worst"]["severity"];
            let Some(in_space) = severity["in_space"].as_f64() else {
                continue;
            };
            let along = severity["along"].as_f64();
            let off_end = class.ends_with("/before") || class.ends_with("/beyond");
            let distance = match (kind, along) {
                (_, _) if class == "degenerate" => continue,
                // Either would make the verdict right.
                ("false-miss", along) => in_space.min(along.unwrap_or(in_space)),
                // Both must change.
                ("false-hit", Some(along)) if off_end && class.starts_with("outside") => {
                    in_space.max(along)
                }
                ("false-hit", Some(along)) if off_end => along,
                ("false-hit", _) => in_space,
                _ => continue,
            };
            farthest = farthest.max(distance);
        }
    }
    let first = screen.lines().find(|line| line.starts_with("1. ")).unwrap();
    // A broken promise comes before all of them.
    let is_first = first.contains(&format!(" {farthest:.2} edges "));
    assert!(
        is_first || first.contains("broken promise"),
        "{farthest}: {screen}"
    );
}

#[cfg(unix)]
#[test]
fn cracks_under_a_promise_are_marked_and_shown_first() {
    let folder = scratch("screen-promise");
    let misses = "printf 'hairline-kernel 1\\nname holes\\nscalars f64\\ncontract closed-ray,across=at-least-one\\nready\\n'; \
        while read -r word id rest; do case $word in case) echo $id miss;; end) echo end $id;; esac; done";
    fs::write(folder.join("holes.sh"), misses).unwrap();
    let family = [
        "--family",
        "shared-edge,interior",
        "-n",
        "60",
        "--scalar",
        "f64",
    ];
    let command = ["--kernel-cmd", "sh holes.sh"];
    // Alone, and among others.
    let (alone, record) = audit(&folder, &[&family[..], &command].concat());
    let cracks = sum(
        &[&record["result"]["results"][1]],
        &["/across/cracks/count"],
    ) + sum(
        &[&record["result"]["results"][0]],
        &["/across/cracks/count"],
    );
    assert!(0 < cracks);
    let counted = format!("cracks: {cracks} of {cracks} (100.0% [");
    assert!(flat(&alone).contains(&counted), "{alone}");
    assert!(
        flat(&alone).contains("promised across triangles: >= 1: BROKEN"),
        "{alone}"
    );
    let others = [
        "--kernel",
        "holes,cramer,half-space,woop-watertight,plucker",
    ];
    let (table, _) = audit(&folder, &[&family[..], &command, &others].concat());
    let row = |name: &str| table.lines().find(|line| line.starts_with(name)).unwrap();
    let leaks = |name: &str| row(name).split_whitespace().nth(1).unwrap().to_owned();
    assert_eq!(
        ["holes  ", "woop-watertight"].map(leaks),
        ["100!", "0"],
        "{table}"
    );
    let promise = "Breaks what its documentation promises there: holes.";
    assert!(flat(&table).contains(promise), "{table}");
    for screen in [alone, table] {
        let expected = format!(
            " 1. holes (own), f64: broken promise, no triangle reports {cracks} of {cracks} crossings "
        );
        assert!(flat(&screen).contains(&expected), "{screen}");
    }
}

#[test]
fn leaks_next_to_noise_are_counted_by_themselves() {
    let folder = scratch("screen-noise");
    let kernels = [
        "-n",
        "300",
        "--scalar",
        "f32",
        "--kernel",
        "woop-watertight,plucker",
    ];
    let (screen, record) = audit(
        &folder,
        &[&kernels[..], &["--family", "noise,vertex-fan"]].concat(),
    );
    let woop = serde_json::json!({"kernel": "woop-watertight", "set": "source"});
    let of = |family: &str| {
        let all = results(&record, &woop, "f32", &[family]);
        ["count", "of"].map(|n| sum(&all, &[&format!("/across/cracks/{n}")]))
    };
    let ([none, fans], [leaks, pairs]) = (of("vertex-fan"), of("noise"));
    assert!(none == 0 && 0 < leaks && leaks < pairs);
    let expected = format!(
        "No leak seen at shared edges and vertices (range left out): woop-watertight (0 of {fans} rays). Next to noise or at \
         extreme exponents: woop-watertight ({leaks} of {pairs} rays). Breaks what its documentation promises there: plucker."
    );
    assert!(flat(&screen).contains(&expected), "{screen}");
    // The promise that is shown broken is that of an ordinary size, if one is.
    assert!(screen.contains("hairline explain 'vertex-fan@"), "{screen}");
}

#[test]
fn stored_cases_are_counted_apart_and_have_no_interval() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let folder = scratch("screen-stored");
    let corpus = root.join("corpora/curated.jsonl");
    let plan = [
        "--kernel",
        "cramer",
        "--scalar",
        "f32",
        "--corpus",
        corpus.to_str().unwrap(),
    ];
    let plan = [&plan[..], &["--family", "edge-near", "-n", "500"]].concat();
    let (screen, record) = audit(&folder, &plan);
    let results = record["result"]["results"].as_array().unwrap();
    let [sample, stored] = ["edge-near", "corpus:"].map(|name| {
        results
            .iter()
            .find(|result| result["family"].as_str().unwrap().starts_with(name))
            .unwrap()
    });
    let misses = |result: &Value| {
        let rate = &result["total"]["false_misses"];
        ["count", "of"].map(|key| rate[key].as_u64().unwrap())
    };
    let [count, of] = misses(stored);
    assert!(0 < count && count < of);
    // The interval of the sample alone, as the record has it.
    let ends_of = &sample["total"]["false_misses"]["interval"];
    let [low, high] = [0, 1].map(|i| format!("{:.1}", ends_of[i].as_f64().unwrap() * 100.0));
    let line = |text: &str, start: &str| {
        text.lines()
            .find(|line| line.starts_with(start))
            .unwrap_or_else(|| panic!("{text}"))
            .to_owned()
    };
    assert!(
        line(&screen, "edges ").contains(&format!("[{low}, {high}]")),
        "{screen}"
    );
    let stored_line = line(&screen, "stored ");
    assert!(
        stored_line.contains(&format!(" {count} of {of} ")),
        "{stored_line}"
    );
    assert!(!stored_line.contains('['), "{stored_line}");
    let all = [&["audit", "-q"], &plan[..]].concat();
    let print = |more: &[&str]| ends(&folder, &[&all[..], more].concat(), 0).0;
    let details = print(&["--details"]);
    let misses = line(&details, "false misses ");
    assert!(
        misses.contains(&format!("; stored cases {count} of {of}")),
        "{misses}"
    );
    assert!(misses.contains(&format!("[{low}%, {high}%]")), "{misses}");
    let html = print(&["--format", "html", "--illustrate", "never"]);
    assert!(html.contains(&format!("; stored cases {count} of {of}")));
    let markdown = print(&["--format", "markdown"]);
    assert!(
        markdown.contains(&format!("| {count} of {of} |")),
        "{markdown}"
    );
}

#[test]
fn bad_values_are_counted_of_hits_whose_values_are_judged_and_keep_a_kernel_from_being_right() {
    let folder = scratch("screen-bad-values");
    // Scaled out of the range: invalid cases, on which a hit is false but has no value to judge, among valid ones.
    let plan = [
        "-n",
        "300",
        "--scalar",
        "f32",
        "--family",
        "range-ends",
        "--scale",
        "2^10",
    ];
    let kernel = ["--kernel", "moller-trumbore", "--contract", "closed-ray"];
    let (screen, record) = audit(&folder, &[&plan[..], &kernel].concat());
    let result = &record["result"]["results"][0];
    let classes = result["classes"].as_object().unwrap().values();
    let of = classes
        .map(|class| class["bad_values"]["of"].as_u64().unwrap())
        .sum::<u64>();
    let total = &result["total"]["bad_values"];
    assert!(0 < total["count"].as_u64().unwrap());
    assert_eq!(total["of"].as_u64().unwrap(), of);
    assert!(screen.contains(" bad-values."), "{screen}");
    assert!(!screen.contains("every verdict is right"), "{screen}");
}
