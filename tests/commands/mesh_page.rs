//! `hairline mesh --format html` as a user meets it: its numbers are the record's, its commands show what they
//! stand for, and nothing on the page comes from elsewhere. tests/browser looks at it in a browser.

use crate::program;

use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use hmac_sha256::Hash;
use program::{at_mesh, ends, flat, scratch};
use serde_json::Value;
use std::fmt::Write;
use std::fs;
use std::path::Path;

fn model(name: &str) -> String {
    format!("{}/corpora/meshes/{name}.obj", env!("CARGO_MANIFEST_DIR"))
}

/// The page and the record of one run.
fn run(folder: &Path, file: &str, flags: &[&str]) -> (String, Value) {
    let outputs = ["--format", "html,json", "-o", "m.html", "-o", "m.json"];
    ends(
        folder,
        &[&["mesh", "-q", file], flags, &outputs[..]].concat(),
        0,
    );
    let page = fs::read_to_string(folder.join("m.html")).unwrap();
    (
        page,
        serde_json::from_slice(&fs::read(folder.join("m.json")).unwrap()).unwrap(),
    )
}

fn between<'a>(text: &'a str, start: &str, end: &str) -> &'a str {
    let from = text.find(start).unwrap_or_else(|| panic!("no {start}")) + start.len();
    &text[from..from + text[from..].find(end).unwrap()]
}

fn unescaped(text: &str) -> String {
    let [lt, gt, quote] = [("&lt;", "<"), ("&gt;", ">"), ("&quot;", "\"")];
    let text = [lt, gt, quote]
        .iter()
        .fold(text.to_owned(), |text, (a, b)| text.replace(a, b));
    text.replace("&amp;", "&")
}

/// What is wrong (0 for a crack), the place, and the numbers of a mark.
struct Mark {
    wrong: u8,
    ends: [usize; 2],
    rays: u64,
    index: u64,
    lines: String,
}

/// A row of the page, as the script reads it.
struct Row<'a> {
    html: &'a str,
    marks: Vec<Mark>,
}

impl Row<'_> {
    fn all(page: &str) -> Vec<Row<'_>> {
        let parts = page.split("<details class=\"row\"").skip(1);
        let row = |html| Row {
            html,
            marks: marks(between(html, "data-marks=\"", "\"")),
        };
        parts.map(row).collect()
    }

    fn command(&self, mark: &Mark) -> Vec<String> {
        let part = if mark.ends[0] == mark.ends[1] {
            "vertices"
        } else {
            "edges"
        };
        let data = |name: &str| unescaped(between(self.html, &format!("data-{name}=\""), "\""));
        words(&format!("{}{}{}", data(part), mark.index, data("after")))
    }

    /// Distinct places of a kind, at edges and at vertices, and how many rays show them.
    fn sums(&self, wrong: u8) -> [[u64; 2]; 2] {
        [false, true].map(|vertex| {
            let is_of =
                |mark: &&Mark| mark.wrong == wrong && (mark.ends[0] == mark.ends[1]) == vertex;
            let marks = || self.marks.iter().filter(is_of);
            [marks().count() as u64, marks().map(|mark| mark.rays).sum()]
        })
    }
}

fn marks(text: &str) -> Vec<Mark> {
    let mark = |text: &str| {
        let words: Vec<&str> = text.split(' ').collect();
        let number = |i: usize| words[i].parse::<u64>().unwrap();
        let ends = [number(1) as usize, number(2) as usize];
        let lines = words[5].to_owned();
        Mark {
            wrong: number(0) as u8,
            ends,
            rays: number(3),
            index: number(4),
            lines,
        }
    };
    text.split_terminator(';').map(mark).collect()
}

/// The arguments of a printed command.
fn words(command: &str) -> Vec<String> {
    let mut words = shlex::split(command).unwrap();
    assert_eq!(words.remove(0), "hairline");
    words
}

fn shown(folder: &Path, command: &[String]) -> String {
    let words: Vec<&str> = command.iter().map(String::as_str).collect();
    ends(folder, &words, 0).0
}

#[test]
fn a_small_mesh_is_drawn_whole_and_its_marks_are_the_records_counts() {
    let folder = scratch("mesh-page-whole");
    let kernels = "moller-trumbore,plucker,woop-watertight";
    let file = model("icosphere");
    let (page, record) = run(
        &folder,
        &file,
        &["--kernel", kernels, "--scalar", "f32,f64"],
    );
    let numbers = |name: &str| {
        between(&page, &format!("data-{name}=\""), "\"")
            .split(' ')
            .count()
    };
    assert_eq!(
        [numbers("points"), numbers("vertices"), numbers("triangles")],
        [1926, 642, 3840]
    );
    let of_row = ["f32", "f64"]
        .into_iter()
        .flat_map(|scalar| kernels.split(',').map(move |kernel| (scalar, kernel)));
    let rows = Row::all(&page);
    assert_eq!(rows.len(), 6);
    for ((scalar, kernel), row) in of_row.zip(&rows) {
        let counts = ["edges", "vertices"].map(|part| {
            let part = at_mesh(&record, scalar, kernel, part);
            [&part["leaking"]["count"], &part["cracks"]["count"]].map(|n| n.as_u64().unwrap())
        });
        assert_eq!(row.sums(0), counts);
        assert_eq!(
            [row.sums(1), row.sums(2)],
            [[[0; 2]; 2]; 2],
            "nobody promised one hit"
        );
    }
    assert!(100 < rows[0].marks.len());
    // Of what the shares are shares, wherever one stands.
    for head in [
        "cracks at edges",
        "% of the rays aimed at edges, and at vertices, that cross",
    ] {
        assert!(page.contains(head), "{head}");
    }
    assert!(page.contains("<h1>✕ Rays slip through icosphere.obj with "));
}

#[test]
fn each_mark_leads_to_its_faces_and_to_a_command_that_shows_it() {
    let folder = scratch("mesh-page-commands");
    let file = model("icosphere");
    let text = fs::read_to_string(&file).unwrap();
    let lines: Vec<&str> = text.lines().collect();
    let flags = [
        "--kernel",
        "moller-trumbore",
        "--contract",
        "closed-ray,across=exactly-one",
    ];
    let (page, record) = run(&folder, &file, &flags);
    let row = &Row::all(&page)[0];
    for (wrong, kind) in ["cracks", "doubles", "odd_folds"].iter().enumerate() {
        for (i, part) in ["edges", "vertices"].iter().enumerate() {
            let across = at_mesh(&record, "f32", "moller-trumbore", part);
            let count = across[*kind]["count"].as_u64().unwrap();
            assert_eq!(row.sums(wrong as u8)[i][1], count, "{kind} at {part}");
        }
    }
    let vertices: Vec<&str> = between(&page, "data-vertices=\"", "\"")
        .split(' ')
        .collect();
    let answer = |command: &[String]| flat(&shown(&folder, command));
    for wrong in 0..3 {
        let of_kind = || row.marks.iter().filter(|mark| mark.wrong == wrong);
        for mark in of_kind().take(3).chain(
            of_kind()
                .filter(|mark| mark.ends[0] == mark.ends[1])
                .take(2),
        ) {
            // The faces at those lines have the vertices of those numbers.
            for line in mark.lines.split(',') {
                let face: Vec<&str> = lines[line.parse::<usize>().unwrap() - 1]
                    .split(' ')
                    .collect();
                assert_eq!(face[0], "f");
                let has = |end: &usize| face.contains(&vertices[*end]);
                assert!(mark.ends.iter().all(has), "{face:?}");
            }
            let said = answer(&row.command(mark));
            let expected =
                [": CRACK", ": DOUBLE", "at a fold: the parity is WRONG"][wrong as usize];
            assert!(said.contains(expected), "{expected}: {said}");
        }
    }
    // The first stand in the table, for readers without scripts.
    let listed: Vec<Vec<String>> = row
        .html
        .split("<code>")
        .skip(1)
        .map(|part| words(&unescaped(&part[..part.find("</code>").unwrap()])))
        .take(20)
        .collect();
    let first: Vec<Vec<String>> = row
        .marks
        .iter()
        .take(20)
        .map(|mark| row.command(mark))
        .collect();
    assert_eq!(listed, first);
}

#[test]
fn of_a_large_mesh_the_page_holds_the_places_and_says_so() {
    let folder = scratch("mesh-page-large");
    let n = 56;
    let mut text = String::new();
    let place = |i: usize, j: usize| (i % n) * n + j % n + 1;
    for i in 0..n * n {
        let [a, b] = [i / n, i % n].map(|k| k as f64 / n as f64 * std::f64::consts::TAU);
        let r = 1.0 + 0.4 * b.cos();
        writeln!(text, "v {} {} {}", r * a.cos(), 0.4 * b.sin(), r * a.sin()).unwrap();
    }
    for (i, j) in (0..n * n).map(|k| (k / n, k % n)) {
        let [p, q, r, s] = [
            place(i, j),
            place(i, j + 1),
            place(i + 1, j),
            place(i + 1, j + 1),
        ];
        writeln!(text, "f {p} {q} {r}\nf {q} {s} {r}").unwrap();
    }
    fs::write(folder.join("large.obj"), text).unwrap();
    let flags = ["--kernel", "moller-trumbore,cramer", "--directions", "4"];
    let (page, record) = run(&folder, "large.obj", &flags);
    assert!(page.contains("Of 6,272 triangles only those around marked places, "));
    assert!(page.len() < 400_000, "{} bytes", page.len());
    let triangles: Vec<usize> = between(&page, "data-triangles=\"", "\"")
        .split(' ')
        .map(|n| n.parse().unwrap())
        .collect();
    assert!(triangles.len() < 3 * 6272);
    for (kernel, row) in ["moller-trumbore", "cramer"]
        .into_iter()
        .zip(&Row::all(&page))
    {
        assert_eq!(row.marks.len(), 300);
        let across = at_mesh(&record, "f32", kernel, "edges");
        assert!(300 < across["leaking"]["count"].as_u64().unwrap());
        // Each place stands in triangles that are drawn.
        for mark in &row.marks {
            let around = triangles
                .chunks(3)
                .filter(|face| mark.ends.iter().all(|end| face.contains(end)));
            assert!(2 <= around.count(), "{:?}", mark.ends);
        }
        assert!(shown(&folder, &row.command(&row.marks[299])).contains(": CRACK"));
    }
    // What is kept does not depend on threads.
    let marks = |threads: &str| {
        let (page, _) = run(
            &folder,
            "large.obj",
            &[&flags[..], &["--threads", threads]].concat(),
        );
        Row::all(&page)
            .iter()
            .map(|row| between(row.html, "data-marks=\"", "\"").to_owned())
            .collect::<Vec<_>>()
    };
    assert_eq!(marks("1"), marks("3"));
}

#[test]
fn nothing_comes_from_elsewhere_and_names_are_only_names() {
    let folder = scratch("mesh-page-hostile");
    let name = if cfg!(windows) {
        "a&b 'c.obj"
    } else {
        "x\"><script>alert(1)<!-- & 'c.obj"
    };
    fs::copy(model("far"), folder.join(name)).unwrap();
    let (page, _) = run(&folder, name, &["--kernel", "moller-trumbore"]);
    assert_eq!(page.matches("<script").count(), 1);
    assert_eq!(page.matches("<style").count(), 1);
    let hash = |text: &str| BASE64_STANDARD.encode(Hash::hash(text.as_bytes()));
    let style = hash(between(&page, "<style>", "</style>"));
    let script = hash(between(&page, "<script>", "</script>"));
    let policy = unescaped(between(&page, "Content-Security-Policy\" content=\"", "\""));
    assert_eq!(
        policy,
        format!(
            "default-src 'none'; img-src data:; style-src 'sha256-{style}'; script-src 'sha256-{script}'; \
             base-uri 'none'; form-action 'none'"
        )
    );
    for foreign in [
        "http:", "https:", "src=", "url(", "@import", " style=", " onclick", "<link",
    ] {
        assert!(!page.contains(foreign), "{foreign}");
    }
    // The command takes the name apart again.
    let row = &Row::all(&page)[0];
    let command = row.command(&row.marks[0]);
    assert!(command.iter().any(|word| word == name), "{command:?}");
    assert!(shown(&folder, &command).contains(": CRACK"));
}
