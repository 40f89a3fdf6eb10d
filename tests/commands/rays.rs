//! `hairline rays`: rays, points and answers of other programs at a whole mesh.

use crate::program::{ends, flat, scratch};
use std::fs;
use std::path::PathBuf;

/// A tetrahedron with corners at the origin and at 1 on each axis, wound to the outside.
pub const TETRAHEDRON: &str =
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

/// Through the long face and the one below; down the axis z, along an edge; past it.
const RAYS: &str =
    "0.125,0.125,5,0,0,-1\n0 0 5 0 0 -1\n{\"origin\":[5,5,5],\"direction\":[1,0,0]}\n";

pub fn folder(name: &str) -> PathBuf {
    let folder = scratch(name);
    fs::write(folder.join("t.obj"), TETRAHEDRON).unwrap();
    fs::write(folder.join("r.csv"), RAYS).unwrap();
    folder
}

#[test]
fn one_ray_is_told_in_order() {
    let folder = folder("rays-one");
    let told = |ray: &str| ends(&folder, &["rays", "t.obj", "-q", "--ray", ray], 0).0;
    let through = told("0.125,0.125,5 0,0,-1");
    assert!(
        through.starts_with("The nearest hit is face 3, at t = 4.25\n"),
        "{through}"
    );
    let words = flat(&through);
    assert!(words.contains("point 0.125, 0.125, 0.75 "), "{through}");
    assert!(
        words.contains(" 4.25 3 crosses 0 to 1 5.0 0 crosses 1 to 0 "),
        "{through}"
    );
    let along = flat(&told("0,0,5 0,0,-1"));
    assert!(
        along.starts_with(
            "The nearest hit is at t = 4.0, on faces 1, 2, 3: each is a right answer "
        ),
        "{along}"
    );
    assert!(
        along.contains(" 4.0 to 5.0 0 1 2 3 runs in the surface, and comes back 0 to 0 "),
        "{along}"
    );
    assert!(told("5,5,5 1,0,0").starts_with("The ray meets no face\n"));
    // On an interval that ends before it.
    assert!(told("0.125,0.125,5 0,0,-1 0,4").starts_with("The ray meets no face\n"));
    // The command is of the face, and runs.
    let command = through.split('\'').nth(1).unwrap();
    let (shown, _) = ends(&folder, &["explain", command, "-k", "moller-trumbore"], 0);
    assert!(
        shown.starts_with("moller-trumbore (source): hit; "),
        "{shown}"
    );
}

#[test]
fn a_file_of_rays_has_a_line_each() {
    let folder = folder("rays-file");
    let (csv, _) = ends(
        &folder,
        &["rays", "t.obj", "r.csv", "-q", "--format", "csv"],
        0,
    );
    assert_eq!(
        csv,
        "faces,t,meetings,met\n3,4.25,2,2\n1 2 3,4.0,1,4\n,,0,0\n"
    );
    let (screen, _) = ends(&folder, &["rays", "t.obj", "r.csv", "-q"], 0);
    assert!(screen.starts_with("2 of 3 rays hit the mesh\n"), "{screen}");
    let written = ["rays", "t.obj", "r.csv", "-q", "-o", "r.json"];
    ends(&folder, &written, 0);
    let json: serde_json::Value =
        serde_json::from_str(&fs::read_to_string(folder.join("r.json")).unwrap()).unwrap();
    assert_eq!(json["rays"][1]["faces"], serde_json::json!([1, 2, 3]));
}

#[test]
fn points_are_inside_outside_or_on_it() {
    let folder = folder("rays-points");
    fs::write(folder.join("p.csv"), "0.125 0.125 0.125\n1,1,1\n0,0,0.5\n").unwrap();
    let points = ["rays", "t.obj", "-q", "--points", "p.csv"];
    let (screen, _) = ends(&folder, &points, 0);
    assert!(
        screen.starts_with("Of 3 points: 1 inside, 1 outside, 1 on the surface\n"),
        "{screen}"
    );
    let (csv, _) = ends(&folder, &[&points[..], &["--format", "csv"]].concat(), 0);
    assert_eq!(csv, "place,winding,faces\ninside,1,\noutside,0,\non,,1 2\n");
    // Without a face the surface is open.
    let open = TETRAHEDRON.trim_end().rsplit_once('\n').unwrap().0;
    fs::write(folder.join("t.obj"), open).unwrap();
    let (screen, _) = ends(&folder, &points, 0);
    assert!(
        flat(&screen).contains("the surface is open, at an edge of face "),
        "{screen}"
    );
    // Nothing was held to anything, so it is no success.
    fs::write(folder.join("a.csv"), "1\n0\n1\n").unwrap();
    let (screen, _) = ends(
        &folder,
        &[&points[..], &["--answers", "a.csv"]].concat(),
        65,
    );
    let screen = flat(&screen);
    assert!(
        screen.starts_with("2 of 3 answers cannot be judged The surface is open, so only points on it can be judged"),
        "{screen}"
    );
}

#[test]
fn what_is_read_is_not_overwritten_and_flags_are_not_ignored() {
    let folder = folder("rays-flags");
    fs::write(folder.join("a.csv"), "3\n1\n-1\n").unwrap();
    let refused = |words: &[&str], message: &str| {
        let (_, error) = ends(&folder, &[&["rays", "t.obj", "-q"], words].concat(), 2);
        assert!(error.contains(message), "{words:?}: {error}");
    };
    let before = fs::read_to_string(folder.join("r.csv")).unwrap();
    refused(
        &["r.csv", "--format", "csv", "-o", "./r.csv"],
        "'r.csv' is read by this command",
    );
    refused(
        &["r.csv", "--format", "csv", "-o", "t.obj"],
        "'t.obj' is read by this command",
    );
    assert_eq!(fs::read_to_string(folder.join("r.csv")).unwrap(), before);
    refused(
        &["r.csv", "-k", "woop-watertight", "--answered", "any"],
        "a plain program answers nearest hits",
    );
    refused(
        &["r.csv", "--answered", "any"],
        "--answered any: whose answers?",
    );
    refused(&["--make", "0"], "--make 0: at least 1");
    refused(&["r.csv", "--seed", "2"], "give --make N too");
    refused(
        &["r.csv", "--answers", "a.csv", "--epsilon", "parallel=1"],
        "cannot be used with",
    );
    refused(&["--make", "18446744073709551615"], "at most 50,000,000");
    let (_, error) = ends(&folder, &["rays", "-", "-", "-q"], 2);
    assert!(error.contains("standard input is named twice"), "{error}");
    // A head that is an answer too, a byte order mark, and a miss as Python prints it.
    let judged = |answers: &str, kind: &str| {
        fs::write(folder.join("a.csv"), answers).unwrap();
        let words = [
            "rays",
            "t.obj",
            "r.csv",
            "-q",
            "--answers",
            "a.csv",
            "--answered",
            kind,
        ];
        ends(&folder, &words, 0);
    };
    judged("hit\n1\n1\n0\n", "any");
    judged("\u{feff}face,t\n3,4.25\n1,4\nNone\n", "nearest");
    judged("\u{feff}3\n1\n-1\n", "nearest");
}

#[test]
fn bad_input_is_named_by_file_and_line() {
    let folder = folder("rays-bad");
    for (name, text) in [
        ("short.csv", "ox,oy,oz,dx,dy,dz\n1,2,3\n"),
        ("word.csv", "0,0,5,0,0,one\n"),
        ("zero.csv", "0,0,5,0,0,0\n"),
        ("empty.csv", "# nothing\n"),
        ("field.csv", "{\"origin\":[0,0,5]}\n"),
        ("two.csv", "3\n1\n"),
        ("many.csv", "3,1,2\n1\n1\n"),
        ("far.csv", "9\n1\n-1\n"),
        ("array.csv", "[{\"origin\":[0,0,5]}]\n"),
    ] {
        fs::write(folder.join(name), text).unwrap();
    }
    // Numbers are no head.
    fs::write(folder.join("nan.csv"), "nan,0,5,0,0,-1\n0,0,5,0,0,-1\n").unwrap();
    let cases: [(&[&str], i32, &str); 14] = [
        (
            &["array.csv"],
            65,
            "array.csv:1: expected a ray a line, not an array",
        ),
        (
            &["nan.csv"],
            65,
            "nan.csv:1: the ray has a coordinate that is not finite",
        ),
        (
            &["short.csv"],
            65,
            "short.csv:2: expected origin and direction as six numbers",
        ),
        (&["word.csv"], 65, "word.csv:1: 'one' is not a number"),
        (&["zero.csv"], 65, "zero.csv:1: the ray's direction is zero"),
        (&["empty.csv"], 65, "empty.csv: there are no rays in it"),
        (&["field.csv"], 65, "field.csv:1: missing field 'direction'"),
        (&["none.csv"], 74, "none.csv: No such file"),
        (
            &["r.csv", "--answers", "two.csv"],
            65,
            "two.csv: 2 answers to 3 rays",
        ),
        (
            &["r.csv", "--answers", "many.csv"],
            65,
            "many.csv:1: expected a face and its t",
        ),
        (
            &["r.csv", "--answers", "far.csv"],
            65,
            "far.csv:1: face 9, and the mesh has 4",
        ),
        (&[], 2, "which rays?"),
        (&["--ray", "1,2"], 2, "--ray: expected origin and direction"),
        (
            &["--ray", "0,0,5 0,0,nan"],
            2,
            "--ray: the ray has a coordinate that is not finite",
        ),
    ];
    for (words, code, message) in cases {
        let (out, error) = ends(&folder, &[&["rays", "t.obj", "-q"], words].concat(), code);
        assert!(
            out.is_empty() && error.contains(message),
            "{words:?}: {error}"
        );
    }
}

#[test]
fn rays_are_made_at_the_places_that_their_kinds_say() {
    let folder = folder("rays-made");
    let made = |kind: &str, file: &str| {
        let words = [
            "rays", "t.obj", "-q", "--make", "60", "--kinds", kind, "-o", file,
        ];
        ends(&folder, &words, 0);
        let text = fs::read_to_string(folder.join(file)).unwrap();
        assert_eq!(text.lines().count(), 61);
        assert!(text.starts_with("ox,oy,oz,dx,dy,dz\n"), "{text}");
        text
    };
    let nearest = |file: &str| -> Vec<(usize, usize)> {
        let (csv, _) = ends(
            &folder,
            &["rays", "t.obj", file, "-q", "--format", "csv"],
            0,
        );
        let counts = csv.lines().skip(1).map(|line| {
            let faces = line.split(',').next().unwrap();
            let met = line.rsplit(',').next().unwrap();
            (faces.split_whitespace().count(), met.parse().unwrap())
        });
        counts.collect()
    };
    // Each meets the vertex, and with it three faces at one t.
    made("vertex", "v.csv");
    assert!(nearest("v.csv").iter().all(|(_, met)| 3 <= *met));
    made("edge", "e.csv");
    assert!(nearest("e.csv").iter().all(|(_, met)| 2 <= *met));
    made("surface", "s.csv");
    assert!(
        nearest("s.csv")
            .iter()
            .filter(|(faces, _)| 1 <= *faces)
            .count()
            > 30
    );
    for line in made("axis", "a.csv").lines().skip(1) {
        let zeros = line.split(',').skip(3).filter(|word| *word == "0").count();
        assert_eq!(zeros, 2, "{line}");
    }
    // Others by another seed, and as many of all kinds.
    let words = ["rays", "t.obj", "-q", "--make", "12", "--seed", "2"];
    let (other, _) = ends(&folder, &words, 0);
    assert_eq!(other.lines().count(), 13);
    let (first, _) = ends(&folder, &words[..5], 0);
    assert_ne!(first, other);
    let wrong = ["rays", "t.obj", "-q", "--make", "5", "--kinds", "vertx"];
    let (_, error) = ends(&folder, &wrong, 2);
    assert!(error.contains("did you mean 'vertex'?"), "{error}");
    // Sizes at both ends of the range: every kind is made, and of what cannot be there is an error.
    let sized = |size: &str| {
        let mesh = format!("v 0 0 0\nv {size} 0 0\nv 0 {size} 0\nv 0 0 {size}\nf 1 3 2\nf 2 3 4\n");
        fs::write(folder.join("t.obj"), mesh).unwrap();
    };
    for size in ["1e-322", "1e-310", "1e-40", "1e300"] {
        sized(size);
        let (csv, _) = ends(&folder, &words, 0);
        fs::write(folder.join("sized.csv"), csv).unwrap();
        ends(&folder, &["rays", "t.obj", "sized.csv", "-q"], 0);
    }
    let (_, error) = ends(&folder, &[&words[..], &["--scalar", "f32"]].concat(), 65);
    assert!(error.contains("t.obj: "), "{error}");
    sized("1e308");
    let (_, error) = ends(&folder, &words, 65);
    assert!(
        error.contains("the mesh is too large for rays around it in f64"),
        "{error}"
    );
    fs::write(folder.join("t.obj"), "v 1 1 1\nf 1 1 1\n").unwrap();
    let (_, error) = ends(&folder, &words, 65);
    assert!(error.contains("t.obj: "), "{error}");
}
