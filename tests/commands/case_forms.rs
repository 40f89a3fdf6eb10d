//! The forms in which a case is given: all are the same case, or are refused with what is wrong.

use crate::program;

use program::{ends, hairline, scratch};
use serde_json::{Value, json};
use std::fs;
use std::path::Path;

const CASE: &str = r#"{"scalar":"f32","origin":[0.1,0.2,2],"direction":[0,0.25,-1.5],"a":[0,0,0],"b":[4,0,0],"c":[0,4,0]}"#;

/// The truth that the program prints of a file, without the names.
fn truths(folder: &Path, text: &str) -> Vec<String> {
    fs::write(folder.join("a.jsonl"), text).unwrap();
    let (truths, _) = ends(folder, &["truth", "--exact", "a.jsonl"], 0);
    // The same file as a corpus, and each case by its name.
    ends(
        folder,
        &["audit", "--corpus", "a.jsonl", "--kernel", "plucker"],
        0,
    );
    truths.lines().map(str::to_owned).collect()
}

#[test]
fn a_case_is_the_same_in_every_form_in_which_people_have_it() {
    let folder = scratch("case-forms");
    let truths = |text: &str| truths(&folder, text);
    let with = |from: &str, to: &str| {
        assert!(CASE.contains(from), "{from}");
        CASE.replace(from, to)
    };
    let [origin, bits] = ["[0.1,0.2,2]", r#"["3dcccccd","3e4ccccd","40000000"]"#];
    let expected = truths(CASE);
    assert!(expected[0].contains("transversal"), "{expected:?}");
    for form in [
        // Vectors as programs print them and sources write them.
        with(origin, "Vec3(0.1, 0.2, 2.0)"),
        with(origin, "Vec3::new(0.1_f32, 0.2f32, 2.)"),
        with(origin, "glam::f32::vec3(0.1, 0.2, 2.0)"),
        with(origin, "vec3<f32>(0.1, 0.2, 2)"),
        with(origin, "float3(0.1f, .2f, 2.f)"),
        with(origin, "(0.1, 0.2, 2.0)"),
        with(origin, r#""Vec3(0.1, 0.2, 2.0)""#),
        with(origin, "Vec3 { x: 0.1, y: 0.2, z: 2.0 }"),
        with(origin, r#"{"x":0.1,"y":0.2,"z":2}"#),
        with(origin, "[0x3dcccccd, 0x3e4ccccd, 0x1p1]"),
        // Names without quotes.
        CASE.replace('"', ""),
        // Bit patterns beside the numbers, or alone.
        with("}", &format!(r#","bits":{{"origin":{bits}}}}}"#)),
        with(
            &format!(r#""origin":{origin}"#),
            &format!(r#""bits":{{"origin":{bits}}}"#),
        ),
        with(
            &format!(r#""origin":{origin}"#),
            r#""bits":{"origin":["0x3dcccccd","0x3E4CCCCD","0x40000000"],"t_max":"7f800000"}"#,
        ),
        // Several lines, an array, a byte-order mark.
        CASE.replace(',', ",\n  ").replace('{', "{\n"),
        CASE.replace(',', ",\r\n\t"),
        format!("[{CASE}]"),
        format!("\u{feff}[\n  {}\n]\n", CASE.replace(',', ",\n")),
        format!("\u{feff}{CASE}\n"),
        // Notes.
        with(
            "}",
            r#","note":"x","comment":1,"id":[],"source":null,"tags":["y"],"_mine":{"a":2}}"#,
        ),
    ] {
        assert_eq!(truths(&form), expected, "{form}");
        let explained = hairline(&folder, &["explain", &form, "-k", "plucker", "--details"]);
        let plain = hairline(&folder, &["explain", CASE, "-k", "plucker", "--details"]);
        let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
        assert_eq!(text(&explained.stdout), text(&plain.stdout), "{form}");
        assert_eq!(explained.status.code(), Some(0));
    }
    let many = format!(
        "[{CASE}, {CASE},\n {}, {CASE}\n,{CASE}]\n",
        CASE.replace(',', ",\n")
    );
    assert_eq!(truths(&many), vec![expected[0].clone(); 5]);
}

#[test]
fn a_segment_by_its_ends_is_the_ray_that_a_kernel_makes_of_them() {
    let folder = scratch("case-segments");
    let truths = |text: &str| truths(&folder, text);
    let [from, to] = [[0.1f32, 0.2, 2.0], [0.7, 0.3, -1.1]];
    let direction: [f32; 3] = std::array::from_fn(|axis| to[axis] - from[axis]);
    let ends = r#""from":[0.1,0.2,2],"to":[0.7,0.3,-1.1]"#;
    let ray = format!(r#""origin":[0.1,0.2,2],"direction":{direction:?},"t_max":1"#);
    let case = |ray: &str| CASE.replace(r#""origin":[0.1,0.2,2],"direction":[0,0.25,-1.5]"#, ray);
    let expected = truths(&case(&ray));
    assert!(expected[0].contains(r#""t":"within""#), "{expected:?}");
    assert_eq!(truths(&case(ends)), expected);
    // The exact direction of these floats gives another t.
    assert_ne!(truths(&case(ends).replace("f32", "f64")), expected);
    let beyond = ends.replace("-1.1", "1.5");
    assert!(truths(&case(&beyond))[0].contains(r#""t":"beyond""#));
    let longer = format!(r#"{beyond},"t_max":100"#);
    assert!(truths(&case(&longer))[0].contains(r#""t":"within""#));
}

#[test]
fn what_is_no_case_is_refused_with_its_line_and_field() {
    let folder = scratch("case-refusals");
    let with = |from: &str, to: &str| CASE.replace(from, to);
    let bits = |patterns: &str| with("}", &format!(r#","bits":{{"origin":{patterns}}}}}"#));
    for (text, message) in [
        (
            with("}", r#","tmax":1}"#),
            "1: unknown field 'tmax': did you mean 't_max'?",
        ),
        (
            with("}", r#","material":1}"#),
            "1: unknown field 'material', expected one of name, scalar,",
        ),
        (
            with("0.2", "None"),
            "1: origin[1]: 'None' is not a number: write a decimal",
        ),
        (
            with("0.2", "0.2f64"),
            "1: origin[1]: '0.2f64' is not a number",
        ),
        (
            with("[0.1,0.2,2]", "vec3(0.5)"),
            "1: origin: expected 3 numbers, found 1",
        ),
        (
            with("[0.1,0.2,2]", r#""0.1 0.2 2""#),
            "1: origin: expected an array of 3 numbers",
        ),
        (with("\"a\":[0,0,0],", ""), "1: missing field 'a'"),
        (
            bits(r#"["3dcccccd","3e4ccccd","40000001"]"#),
            "1: bits.origin[2] is 2.000000238418579",
        ),
        (bits(r#"[0,1,2]"#), "1: bits.origin[0]: expected a string"),
        (
            with("}", r#","from":[0,0,0]}"#),
            "1: origin: leave it out, or 'from' and 'to'",
        ),
        (
            with("origin", "from"),
            "1: direction: leave it out, or 'from' and 'to'",
        ),
        (format!("{CASE}{CASE}"), "1: trailing characters at column"),
        (
            format!("{CASE}\n[{CASE}]"),
            "2: expected an object, found [",
        ),
        (
            format!("{}\n{CASE}", &CASE[..60]),
            "1: expected ',' or ']' at column 64",
        ),
        (format!("{}\n{CASE}", &CASE[..30]), "1: "),
        (
            format!("\n[{CASE},\n{CASE},"),
            "4: expected an object, found the end of an array without its ]",
        ),
        (
            format!("[{CASE},\n{}]", with("0.2", "x")),
            "2: origin[1]: 'x' is not a number",
        ),
        ("[1,2]".to_owned(), "1: expected an object, found [1,2]"),
    ] {
        fs::write(folder.join("a.jsonl"), &text).unwrap();
        for arguments in [&["truth", "a.jsonl"][..], &["audit", "--corpus", "a.jsonl"]] {
            let (_, error) = ends(&folder, arguments, 65);
            assert!(
                error.starts_with(&format!("hairline: a.jsonl:{message}")),
                "{text}\n{error}"
            );
            assert_eq!(error.lines().count(), 1, "{error}");
        }
    }
    let two = format!("[{CASE},{CASE}]");
    for (text, found) in [(two.as_str(), "more"), ("[]", "none")] {
        let (_, error) = ends(&folder, &["explain", text], 2);
        assert_eq!(
            error,
            format!("hairline: the argument should hold one case, found {found}\n")
        );
    }
}

#[test]
fn an_instance_is_held_against_the_exact_triangle_in_the_world() {
    let folder = scratch("case-instances");
    let explained = |case: &str, more: &[&str]| {
        let flags = [
            "explain",
            case,
            "-k",
            "plucker,moller-trumbore",
            "--format",
            "json",
        ];
        let text = ends(&folder, &[&flags[..], more].concat(), 0).0;
        let explanation: Value = serde_json::from_str(&text).unwrap();
        explanation["triangles"][0].clone()
    };
    let case = |ray: &str, corners: [[f64; 3]; 3]| {
        let [a, b, c] = corners;
        format!(r#"{{"scalar":"f32",{ray},"a":{a:?},"b":{b:?},"c":{c:?}}}"#)
    };
    let exact = |truth: &Value, name: &str| {
        let (p, q) = truth[name].as_str().unwrap().split_once('/').unwrap();
        p.parse::<f64>().unwrap() / q.parse::<f64>().unwrap()
    };
    // Three times as large, turned and far off: every corner in the world is a float, and no third is.
    let matrix = "0,0,-3,1000, 3,0,0,0.5, 0,-3,0,-64";
    let corners = [[0.25, 0.5, 0.0], [2.0, 0.75, 0.0], [1.0, 3.0, 0.125]];
    let in_world = corners.map(|[x, y, z]| [1000.0 - 3.0 * z, 0.5 + 3.0 * x, -64.0 - 3.0 * y]);
    let (mut wrong, mut moved_most) = (0, 0.0f64);
    for ray in 0..12 {
        // Some at the middle, some through a corner exactly.
        let to = match ray % 2 {
            0 => in_world[ray % 3],
            _ => [999.88, 3.75, -68.2],
        };
        let d = [0.7 + ray as f64 / 64.0, 0.25, -0.5];
        let o = [0, 1, 2].map(|axis| (to[axis] - d[axis]) as f32);
        let d = [0, 1, 2].map(|axis| (to[axis] as f32) - o[axis]);
        let ray = format!(r#""origin":{o:?},"direction":{d:?}"#);
        let seen = explained(&case(&ray, corners), &["--instance", matrix]);
        let world = explained(&case(&ray, in_world), &[]);
        let words = ends(
            &folder,
            &["explain", &case(&ray, in_world), "-k", "plucker"],
            0,
        )
        .0;
        let truth = seen["instance"]["truth"].as_str().unwrap();
        assert!(
            program::flat(&words).contains(&format!("truth {truth}")),
            "{truth}\n{words}"
        );
        for (i, name) in ["t_exact", "u_exact", "v_exact"].into_iter().enumerate() {
            let moved = seen["instance"]["moved"][i].as_f64().unwrap();
            let apart = (exact(&seen["truth"], name) - exact(&world["truth"], name)).abs();
            assert!((moved - apart).abs() < 1e-12, "{name} {moved} {apart}");
            moved_most = moved_most.max(moved);
        }
        wrong += usize::from(seen["instance"]["wrong"] != json!([]));
    }
    assert!(1e-8 < moved_most && moved_most < 1e-2, "{moved_most}");
    assert!(wrong > 0, "rounding the inverse loses some hit at a corner");
    let case = case(r#""origin":[1,1,1],"direction":[0,0,-1]"#, corners);
    let screen = |matrix: &str, code| {
        ends(
            &folder,
            &["explain", &case, "-k", "plucker", "--instance", matrix],
            code,
        )
    };
    assert!(screen("1 0 0 0  0 1 0 0  0 0 1 0", 0).0.contains("world"));
    for (matrix, message) in [
        (
            "1,0,0,0,0,1,0,0,0,0,1",
            "expected 12 numbers, row by row, found 11",
        ),
        ("1,0,0,0,0,1,0,0,0,0,1,x", "'x' is not a number"),
        (
            "1,0,0,0,0,1,0,0,0,0,0,0",
            "the matrix is singular in f32: it has no inverse",
        ),
        (
            "1e30,0,0,0,0,1e30,0,0,0,0,1e30,0",
            "its inverse is not finite in f32",
        ),
    ] {
        let error = screen(matrix, 2).1;
        assert!(
            error.starts_with(&format!("hairline: --instance: {message}")),
            "{error}"
        );
    }
}
