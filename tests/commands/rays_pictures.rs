//! The pictures of wrong answers on the page of `hairline rays`: what they mark, and that nothing makes them useless.

use crate::program::{ends, hairline, scratch};
use std::fmt::Write as _;
use std::fs;
use std::path::Path;

/// A tetrahedron with corners at the origin and at 1 on each axis, wound to the outside.
const TETRAHEDRON: &str =
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

/// Through the long face 3 and face 0 below; past all.
const RAYS: &str = "0.125,0.125,5,0,0,-1\n5 5 5 1 0 0\n";

/// The drawings' width and height.
const SIZE: [f64; 2] = [460.0, 320.0];

/// The page of wrong answers to rays.
fn page(folder: &Path, mesh: &str, rays: &str, answers: &str, more: &[&str]) -> String {
    fs::write(folder.join("m.obj"), mesh).unwrap();
    fs::write(folder.join("r.csv"), rays).unwrap();
    page_of(folder, &["r.csv"], answers, more)
}

fn page_of(folder: &Path, questions: &[&str], answers: &str, more: &[&str]) -> String {
    fs::write(folder.join("a.csv"), answers).unwrap();
    let words = [
        "rays",
        "m.obj",
        "-q",
        "--format",
        "html",
        "--answers",
        "a.csv",
    ];
    let words = [&words[..], questions, more].concat();
    let output = hairline(folder, &words);
    let error = String::from_utf8_lossy(&output.stderr).into_owned();
    // By chance an answer may be right.
    assert!(
        matches!(output.status.code(), Some(0 | 1)),
        "{words:?}: {error}"
    );
    String::from_utf8(output.stdout).unwrap()
}

/// The figures of a page: drawing and caption.
fn figures(page: &str) -> Vec<String> {
    let figures = page.split("<figure>").skip(1);
    figures
        .map(|it| it.split("</figure>").next().unwrap().to_owned())
        .collect()
}

/// The value of an attribute of the first element with a class.
fn attribute<'a>(figure: &'a str, class: &str, name: &str) -> &'a str {
    let element = figure.split(&format!("class=\"{class}\"")).nth(1).unwrap();
    let value = element.split(&format!(" {name}=\"")).nth(1).unwrap();
    value.split('"').next().unwrap()
}

/// The corners of a closed path of absolute and relative steps, in dots.
fn corners(path: &str) -> Vec<[f64; 2]> {
    let mut at = [0.0; 2];
    let steps = path.trim_matches(['M', 'z']).split('l');
    let corner = |step: &str| {
        let (x, y) = step.split_once(' ').unwrap();
        at[0] += x.parse::<f64>().unwrap() / 10.0;
        at[1] += y.parse::<f64>().unwrap() / 10.0;
        at
    };
    steps.map(corner).collect()
}

/// Holds the numbers of a figure's drawing to the drawing.
fn assert_within(figure: &str) {
    // Captions have words, and the numbers of answers.
    let drawing = figure.split_once("<g ").unwrap().1;
    let drawing = drawing.split("<figcaption>").next().unwrap();
    assert!(
        !drawing.contains("NaN") && !drawing.contains("inf"),
        "{drawing}"
    );
    let paths = figure.split(" d=\"M").skip(1);
    for path in paths.map(|it| it.split('"').next().unwrap()) {
        for outline in path.split('M').filter(|it| it.ends_with('z')) {
            if outline.contains('L') {
                continue;
            }
            for outline in outline.split("zM") {
                for corner in corners(outline) {
                    let is_within =
                        (0..2).all(|axis| (-0.1..=SIZE[axis] + 0.1).contains(&corner[axis]));
                    assert!(is_within, "{corner:?}: {outline}");
                }
            }
        }
    }
}

#[test]
fn the_exact_and_the_answered_hit_are_marked_where_they_lie() {
    let folder = scratch("rays-pictures-marks");
    // Slipped through to the face below; a face where nothing is met.
    let page = page(&folder, TETRAHEDRON, RAYS, "0,5\n2,1\n", &[]);
    let figures = figures(&page);
    assert_eq!(figures.len(), 2, "{page}");
    let farther = &figures[0];
    assert!(
        farther.contains(
            "<figcaption>Ray 0: farther face: the nearest is face 3 at t = 4.25; answered face 0 at t = 5.0, which it meets 0.530 longest edges behind. "
        ),
        "{farther}"
    );
    for part in [
        ">exact: face 3</text>",
        ">answer: face 0</text>",
        "class=\"face exact\"",
        "class=\"face answered\"",
        "class=\"ray\"",
    ] {
        assert!(farther.contains(part), "{part}: {farther}");
    }
    let number =
        |class: &str, name: &str| -> f64 { attribute(farther, class, name).parse().unwrap() };
    let exact = [number("spot exact", "cx"), number("spot exact", "cy")];
    let cross = attribute(farther, "cross answered", "d");
    let start: Vec<f64> = cross[1..cross.find('l').unwrap()]
        .split(' ')
        .map(|x| x.parse().unwrap())
        .collect();
    let answered = [start[0] + 5.0, start[1] + 5.0];
    // The ray runs to the right, along one line, and slipped through.
    assert!(
        exact[0] + 40.0 < answered[0] && answered[0] < SIZE[0],
        "{farther}"
    );
    assert!((exact[1] - answered[1]).abs() < 0.2, "{farther}");
    for (point, class) in [(exact, "face exact"), (answered, "face answered")] {
        let face = corners(attribute(farther, class, "d"));
        assert_eq!(face.len(), 3);
        for axis in 0..2 {
            let numbers = || face.iter().map(|corner| corner[axis]);
            let least = numbers().fold(f64::INFINITY, f64::min);
            let most = numbers().fold(f64::NEG_INFINITY, f64::max);
            assert!(
                (least - 0.2..=most + 0.2).contains(&point[axis]),
                "{class}: {farther}"
            );
        }
    }
    let ghost = &figures[1];
    assert!(
        ghost.contains("<figcaption>Ray 1: ghost: no face is hit; answered face 2 at t = 1.0. "),
        "{ghost}"
    );
    assert!(
        !ghost.contains("exact") && ghost.contains(">answer: face 2</text>"),
        "{ghost}"
    );
    for figure in &figures {
        assert_within(figure);
    }
}

#[test]
fn every_kind_of_answers_has_pictures() {
    let folder = scratch("rays-pictures-kinds");
    let farther = "0,0,5\n";
    for (kind, answers, words) in [
        ("nearest", "none\nnone\n", "exact: face 3"),
        ("any", "0\n0\n", "exact: face 3"),
        ("any", "1\n1\n", "class=\"ray\""),
        ("all", farther, "exact: face 3"),
        ("all", farther, "answer: face 0"),
        ("count", "5\n0\n", "exact: face 3"),
    ] {
        let page = page(&folder, TETRAHEDRON, RAYS, answers, &["--answered", kind]);
        let figures = figures(&page);
        assert_eq!(figures.len(), 1, "{kind}: {page}");
        assert!(figures[0].contains(words), "{kind}: {}", figures[0]);
        // All hits are marked where all were asked for.
        let spots = figures[0].matches("class=\"spot exact\"").count();
        let is_of_all = matches!(kind, "all" | "count");
        assert!(spots == 2 || !is_of_all, "{kind}: {}", figures[0]);
        assert_within(&figures[0]);
    }
    let point = "0.125 0.125 0.25\n";
    fs::write(folder.join("p.csv"), point).unwrap();
    let questions = ["--points", "p.csv", "--answered", "inside"];
    let page = page_of(&folder, &questions, "outside\n", &[]);
    let figures = figures(&page);
    assert!(
        figures[0].contains(
            "<figcaption>Point 0 (0.125, 0.125, 0.25): wrong side: it is inside; answered outside, "
        ),
        "{}",
        figures[0]
    );
    assert!(figures[0].contains(">nearest: face "), "{}", figures[0]);
    assert_within(&figures[0]);
}

#[test]
fn extreme_meshes_have_drawings_without_nan() {
    let folder = scratch("rays-pictures-extremes");
    let scaled = |size: &str| {
        let faces = "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
        format!("v 0 0 0\nv {size} 0 0\nv 0 {size} 0\nv 0 0 {size}\n{faces}")
    };
    for (size, scalar) in [
        ("1e300", "f64"),
        ("1e308", "f64"),
        ("1e-300", "f64"),
        ("5e-324", "f64"),
        ("1e38", "f32"),
        ("1e-45", "f32"),
    ] {
        // From a corner of the box around it, and from far away, on the axis and past it.
        let ray = format!("{size} {size} {size} -1 -1 -1\n");
        let rays = format!("{ray}1e38 1e38 1e38 -1e-38 -1e-38 -1e-38\n0 0 1e38 0 0 1e-38\n");
        let mut drawn = 0;
        for answers in [
            "none\nnone\n0\n",
            "0,1e300\n1,1\n1,-1\n",
            "3,-1e300\n3,nan\n2,1e300\n",
        ] {
            let page = page(
                &folder,
                &scaled(size),
                &rays,
                answers,
                &["--scalar", scalar],
            );
            let figures = figures(&page);
            drawn += figures
                .iter()
                .filter(|it| it.contains("class=\"face "))
                .count();
            figures.iter().for_each(|figure| assert_within(figure));
        }
        assert!(3 <= drawn, "{size}: {drawn}");
    }
}

#[test]
fn degenerate_meshes_have_drawings_without_nan() {
    let folder = scratch("rays-pictures-degenerate");
    // A triangle, one from end to end of the range, a point, and segments, one of them as long.
    let mixed = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1e300 1e300 0\nv -1e300 0 1\nv 0 1e-300 1e300\n\
        f 1 2 3\nf 4 5 6\nf 1 1 1\nf 1 2 2\nf 4 4 1\n";
    let rays = "0.25 0.25 1 0 0 -1\n0.25 0.25 1 0 0 1\n0 0 1 0 0 -1\n";
    for answers in ["none\n1\n4\n", "2,1e300\n2\nnone\n", "1,1\n3,7\n1,1\n"] {
        let page = page(&folder, mixed, rays, answers, &["--scalar", "f64"]);
        let figures = figures(&page);
        assert!(!figures.is_empty(), "{answers}");
        figures.iter().for_each(|figure| assert_within(figure));
    }
    // All is one point.
    let point = "v 7 7 7\nf 1 1 1\n";
    let page_of_point = page(
        &folder,
        point,
        "7 7 8 0 0 -1\n8 7 8 0 0 -1\n",
        "none\n0\n",
        &[],
    );
    assert!(!figures(&page_of_point).is_empty(), "{page_of_point}");
    figures(&page_of_point)
        .iter()
        .for_each(|figure| assert_within(figure));
}

/// A square of fields with two faces each, somewhat hilly.
fn hills(fields: usize) -> String {
    let mut mesh = String::new();
    for y in 0..=fields {
        for x in 0..=fields {
            let z = (x * x + 3 * y) % 7;
            let _ = writeln!(mesh, "v {x} {y} 0.{z}");
        }
    }
    let vertex = |x: usize, y: usize| y * (fields + 1) + x + 1;
    for y in 0..fields {
        for x in 0..fields {
            let [a, b] = [vertex(x, y), vertex(x + 1, y)];
            let [c, d] = [vertex(x + 1, y + 1), vertex(x, y + 1)];
            let _ = writeln!(mesh, "f {a} {b} {c}\nf {a} {c} {d}");
        }
    }
    mesh
}

#[test]
fn of_a_large_mesh_the_faces_around_are_drawn_in_few_bytes() {
    let folder = scratch("rays-pictures-large");
    let rays = "10.3 20.4 9 0 0 -1\n100.3 20.4 9 0 0 -1\n5 5 9 0 0.001 -1\n";
    // From one end to the other, and a miss.
    let answers = "99000\nnone\n0\n";
    let page = page(&folder, &hills(224), rays, answers, &[]);
    let figures = figures(&page);
    assert_eq!(figures.len(), 3, "{page}");
    let bytes: usize = figures.iter().map(String::len).sum();
    assert!((20_000..200_000).contains(&bytes), "{bytes}");
    let limited = figures
        .iter()
        .filter(|figure| figure.contains("The 2,000 faces nearest to the marks are drawn, of "));
    assert!(1 <= limited.count(), "{page}");
    figures.iter().for_each(|figure| assert_within(figure));
}

#[test]
fn only_pages_have_pictures() {
    let folder = scratch("rays-pictures-formats");
    page(&folder, TETRAHEDRON, RAYS, "0,5\n2,1\n", &[]);
    for format in ["json", "text", "markdown", "junit"] {
        let words = [
            "rays",
            "m.obj",
            "r.csv",
            "-q",
            "--format",
            format,
            "--answers",
            "a.csv",
        ];
        let (text, _) = ends(&folder, &words, 1);
        assert!(
            !text.contains("picture") && !text.contains("<path"),
            "{format}: {text}"
        );
    }
}
