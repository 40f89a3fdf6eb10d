//! `hairline rays --answers`: the answers of programs, judged, and held to known ones.

use crate::program::{ends, flat};
use crate::rays::folder;
use std::fs;

#[test]
fn answers_are_judged_by_kind() {
    let folder = folder("rays-answers");
    let judged = |answers: &str, code: i32| {
        fs::write(folder.join("a.csv"), answers).unwrap();
        let words = ["rays", "t.obj", "r.csv", "-q", "--answers", "a.csv"];
        flat(&ends(&folder, &words, code).0)
    };
    // Any face of a tie; heads, comments and each word for a miss.
    for right in [
        "face,t\n3,4.25\n2,4\n-1,\n",
        "# mine\n3\n1\n4294967295\n",
        "{\"face\":3,\"t\":4.25}\n{\"face\":3,\"t\":4}\n{\"face\":null,\"t\":null}\n",
    ] {
        let said = judged(right, 0);
        assert!(
            said.starts_with("None of 3 answers is wrong No hit is lost. "),
            "{said}"
        );
    }
    let lost = judged("none\n1\n-1\n", 1);
    assert!(lost.contains(" lost 1 "), "{lost}");
    assert!(
        lost.contains(" Rays of the wrong answers: 1 meet the inside of a face. "),
        "{lost}"
    );
    assert!(
        lost.contains(" 1 answer misses the exact hit: it names nothing, or another face. "),
        "{lost}"
    );
    // Who misses the second one sees the same: the ray runs along an edge, and comes back.
    let wrong = judged("0,5\nnone\n2,1\n", 1);
    assert!(wrong.starts_with("2 of 3 answers are wrong "), "{wrong}");
    for kind in [
        " neighbour 1 - - ",
        " farther face 1 0.530 0.530 ",
        " ghost 1 - - ",
    ] {
        assert!(wrong.contains(kind), "{kind}: {wrong}");
    }
    assert!(
        wrong.contains(
            "ray 0: farther face: the nearest is face 3 at t = 4.25; answered face 0 at t = 5.0, 0.530 longest edges behind it"
        ),
        "{wrong}"
    );
    let late = judged("3,4.5\n1,4\n-1\n", 1);
    assert!(late.contains(" wrong t 1 0.177 0.177 "), "{late}");
    let early = judged("3,4\n1,4\n-1\n", 1);
    assert!(
        early.contains("answered face 3 at t = 4.0, 0.177 longest edges in front of it"),
        "{early}"
    );
    for endless in ["3,inf\n1,4\n-1\n", "3,nan\n1,4\n-1\n"] {
        assert!(judged(endless, 1).contains(" wrong t 1 "));
    }
}

#[test]
fn the_scalar_and_the_numbering_of_a_program_are_found_out() {
    let folder = folder("rays-guessed");
    // Ten rays onto the first face of a square, near its diagonal, and the face on the other side.
    let square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\n";
    fs::write(folder.join("t.obj"), square).unwrap();
    let rays: String = (1..=10)
        .map(|i| format!("0.{i:02}5,0.{i:02},1,0,0,-1\n"))
        .collect();
    fs::write(folder.join("r.csv"), rays).unwrap();
    let judged = |answers: &str, more: &[&str], code: i32| {
        fs::write(folder.join("a.csv"), answers).unwrap();
        let words = ["rays", "t.obj", "r.csv", "-q", "--answers", "a.csv"];
        flat(&ends(&folder, &[&words, more].concat(), code).0)
    };
    let from_one = judged(&"1\n".repeat(10), &[], 1);
    assert!(
        from_one.contains("The faces are numbered otherwise: with -1 most wrong ones are right."),
        "{from_one}"
    );
    // Numbers that only f32 rounds: the ray starts an ulp of f64 beside the square.
    fs::write(folder.join("r.csv"), "1.0000000000000002,0.5,1,0,0,-1\n").unwrap();
    let in_f32 = judged("0,1\n", &[], 0);
    assert!(in_f32.starts_with("None of 1 answer is wrong "), "{in_f32}");
    // An edge away: only one of the scalars can be meant.
    fs::write(folder.join("r.csv"), "16777217,0.5,1,-16777215,0,-1\n").unwrap();
    let guessed = judged("0,1\n", &[], 0);
    assert!(
        guessed.contains("Judged by mesh and rays rounded to f32"),
        "{guessed}"
    );
    assert!(
        guessed.contains(
            ": 1 answer is right that way, and 0 by the numbers as written (--scalar f64)."
        ),
        "{guessed}"
    );
    judged("0,1\n", &["--scalar", "f64"], 1);
    judged("0,1\n", &["--scalar", "f32"], 0);
    // A ray that passes a rim by a hair inside in f64, and outside in f32: a miss is right in f32, and not wrong in f64.
    fs::write(folder.join("t.obj"), square.replace("v 1 ", "v 0.7 ")).unwrap();
    fs::write(folder.join("r.csv"), "0.299999999,0.5,1,0.4,0,-1\n").unwrap();
    let in_f64 = judged("-1\n", &[], 0);
    assert!(in_f64.contains(" neighbour 1 "), "{in_f64}");
    assert!(!in_f64.contains("rounded to f32"), "{in_f64}");
    // Numbers beyond f32 are of a program in f64.
    fs::write(folder.join("t.obj"), square).unwrap();
    fs::write(folder.join("r.csv"), "0.5,0.25,1e300,0,0,-1e300\n").unwrap();
    let far = judged("1,1\n", &[], 1);
    assert!(far.starts_with("1 of 1 answer is wrong "), "{far}");
}

#[test]
fn other_answers_than_the_nearest_hit_are_judged_too() {
    let folder = folder("rays-kinds");
    fs::write(folder.join("p.csv"), "0.125 0.125 0.125\n1,1,1\n0,0,0.5\n").unwrap();
    let judged = |questions: &[&str], kind: &str, answers: &str, code: i32| {
        fs::write(folder.join("a.csv"), answers).unwrap();
        let words = ["rays", "t.obj", "-q", "--answers", "a.csv", "--answered"];
        let words = [&words, &[kind][..], questions].concat();
        flat(&ends(&folder, &words, code).0)
    };
    let rays = ["r.csv"];
    let points = ["--points", "p.csv"];
    for (questions, kind, answers) in [
        (&rays[..], "any", "hit\n1\n0\n"),
        (
            &rays,
            "any",
            "{\"hit\":true}\n{\"hit\":true}\n{\"hit\":false}\n",
        ),
        (&rays, "count", "count\n2\n1\n0\n"),
        (&rays, "count", "2\n4\n0\n"),
        (&rays, "all", "ray,face,t\n0,3,4.25\n0,0,5\n1,2,4.5\n"),
        (&rays, "all", "0 3\n0 0\n"),
        (&points, "inside", "inside\noutside\non\n"),
        (&points, "inside", "1\n0\n0\n"),
    ] {
        let said = judged(questions, kind, answers, 0);
        assert!(said.starts_with("None of 3 answers is wrong "), "{said}");
    }
    for (questions, kind, answers, words) in [
        (&rays[..], "any", "0\n1\n1\n", " lost 1 ghost 1 "),
        (&rays, "count", "1\n1\n2\n", " too few 1 too many 1 "),
        (&rays, "all", "0,0,5\n0,3,4.25\n", " wrong order 1 "),
        (&rays, "all", "0,3\n0,0\n0,0\n2,1\n", " ghost 1 twice 1 "),
        (
            &rays,
            "all",
            "0,3\n",
            "ray 0: lost: it meets face 3 at t = 4.25, then face 0 at t = 5.0; answered face 3",
        ),
        (&points, "inside", "0\n0\n1\n", " wrong side 1 0.088 0.088 "),
        (
            &points,
            "inside",
            "0\n0\n1\n",
            "point 0 (0.125, 0.125, 0.125): wrong side: it is inside; answered outside, 0.088 longest edges from the surface",
        ),
    ] {
        let said = judged(questions, kind, answers, 1);
        assert!(said.contains(words), "{words}: {said}");
    }
    let refused = |words: &[&str], code: i32, message: &str| {
        let words = [&["rays", "t.obj", "-q"], words].concat();
        let (_, error) = ends(&folder, &words, code);
        assert!(error.contains(message), "{words:?}: {error}");
    };
    fs::write(folder.join("a.csv"), "3,3\n").unwrap();
    let answers = ["--answers", "a.csv", "--answered"];
    let asked = |kind| [&["r.csv"], &answers[..], &[kind]].concat();
    refused(
        &asked("all"),
        65,
        "a.csv:1: expected a ray's number, from 0 and below 3, first",
    );
    fs::write(folder.join("b.csv"), "0,-1\n").unwrap();
    let with_a_miss = ["r.csv", "--answers", "b.csv", "--answered", "all"];
    refused(&with_a_miss, 65, "b.csv:1: a miss has no line here");
    refused(&asked("count"), 65, "a.csv:1: expected one word, found 2");
    refused(&asked("nearst"), 2, "did you mean 'nearest'?");
    refused(&asked("inside"), 2, "Give --points FILE in place of rays");
    let of_points = [&["--points", "p.csv"], &answers[..], &["all"]].concat();
    refused(&of_points, 2, "points are inside or outside");
    fs::write(folder.join("a.csv"), "1\nmaybe\n").unwrap();
    refused(
        &asked("any"),
        65,
        "a.csv:2: expected 1 for a hit or 0 for none",
    );
    let of_points = [&["--points", "p.csv"], &answers[..], &["inside"]].concat();
    refused(&of_points, 65, "a.csv:2: expected inside, outside or on");
    refused(&["--answers", "a.csv"], 2, "which rays?");
    refused(&["r.csv", "--known", "k.toml"], 2, "whose answers?");
}

#[test]
fn directions_of_length_1_are_found_out() {
    let folder = folder("rays-unit");
    fs::write(
        folder.join("r.csv"),
        "0.125,0.125,5,0,0,-4\n0.25,0.125,5,0,0,-4\n",
    )
    .unwrap();
    fs::write(folder.join("a.csv"), "3,4.25\n3,4.375\n").unwrap();
    let words = ["rays", "t.obj", "r.csv", "-q", "--answers", "a.csv"];
    let said = flat(&ends(&folder, &words, 0).0);
    assert!(
        said.contains(
            "Judged with directions made of length 1, so that t is a length, as the program seems to do: 2 answers are right that way, \
             and 0 by the numbers as written."
        ),
        "{said}"
    );
}

#[test]
fn known_wrong_answers_pass_more_fail_and_less_is_stale() {
    let folder = folder("rays-known");
    let held = |answers: &str, more: &[&str], code: i32| {
        fs::write(folder.join("a.csv"), answers).unwrap();
        let words = [
            "rays",
            "t.obj",
            "r.csv",
            "--answers",
            "a.csv",
            "--known",
            "k.toml",
        ];
        ends(&folder, &[&words, more].concat(), code)
    };
    let (_, error) = held("3\n1\n2\n", &["-q"], 74);
    assert!(
        error.contains("with --bless this command writes it"),
        "{error}"
    );
    held("3\n1\n2\n", &["--bless"], 0);
    let text = fs::read_to_string(folder.join("k.toml")).unwrap();
    assert!(text.contains("schema = \"hairline-rays/1\""), "{text}");
    assert!(text.contains("\"ghost\" = 1\n"), "{text}");
    held("3\n1\n2\n", &["-q"], 0);
    let (screen, _) = held("0\n1\n2\n", &["-q"], 1);
    assert!(screen.starts_with("1 worse, 0 better"), "{screen}");
    assert!(screen.contains("hairline explain"), "{screen}");
    let (junit, _) = held("0\n1\n2\n", &["-q", "--format", "junit"], 1);
    assert!(junit.contains("tests=\"1\" failures=\"1\""), "{junit}");
    let (junit, _) = held("3\n1\n2\n", &["-q", "--format", "junit"], 0);
    assert!(junit.contains("tests=\"1\" failures=\"0\""), "{junit}");
    held("3\n1\n-1\n", &["-q"], 3);
    held("0\n1\n2\n", &["-q", "--bless"], 1);
    held("0\n1\n2\n", &["-q", "--bless", "--accept-worse"], 0);
    held("0\n1\n2\n", &["-q"], 0);
    // Other rays are another question.
    fs::write(folder.join("r.csv"), "0,0,5,0,0,1\n").unwrap();
    let (_, error) = held("-1\n", &["-q"], 65);
    assert!(
        error.contains("k.toml: its counts are of other cases (nearest of 3 rays, "),
        "{error}"
    );
    let (_, error) = ends(
        &folder,
        &[
            "rays",
            "t.obj",
            "r.csv",
            "--bless",
            "-q",
            "--answers",
            "a.csv",
        ],
        2,
    );
    assert!(error.contains("--bless: which file?"), "{error}");
}

#[test]
fn records_of_answers_are_compared_and_are_tests_for_a_build() {
    let folder = folder("rays-records");
    let judged = |answers: &str, file: &str, code: i32| {
        fs::write(folder.join("a.csv"), answers).unwrap();
        let words = [
            "rays",
            "t.obj",
            "r.csv",
            "-q",
            "--answers",
            "a.csv",
            "-o",
            file,
        ];
        ends(&folder, &words, code);
        fs::read_to_string(folder.join(file)).unwrap()
    };
    let junit = judged("0\n1\n-1\n", "wrong.xml", 1);
    assert!(junit.contains("tests=\"9\" failures=\"1\""), "{junit}");
    assert!(
        junit.contains("message=\"farther face: 1 of 3\""),
        "{junit}"
    );
    assert!(junit.contains("hairline explain"), "{junit}");
    judged("0\n1\n-1\n", "old.json", 1);
    judged("3\n1\n-1\n", "new.json", 0);
    let (screen, _) = ends(&folder, &["diff", "old.json", "new.json"], 0);
    assert!(screen.starts_with("0 worse, 1 better"), "{screen}");
    ends(&folder, &["diff", "new.json", "old.json", "--exit-code"], 1);
}

#[test]
fn misses_do_not_make_a_program_one_in_f32() {
    let folder = folder("rays-misses");
    // A square whose sides are less than the step of f32 out there: nothing is hit in f32.
    let far = "v 1000000011 0 0\nv 1000000012 0 0\nv 1000000012 1 0\nf 1 2 3\n";
    fs::write(folder.join("t.obj"), far).unwrap();
    fs::write(folder.join("r.csv"), "1000000011.75,0.5,1,0,0,-1\n").unwrap();
    fs::write(folder.join("a.csv"), "-1\n").unwrap();
    let words = ["rays", "t.obj", "r.csv", "-q", "--answers", "a.csv"];
    let said = flat(&ends(&folder, &words, 1).0);
    assert!(said.starts_with("1 of 1 answer is wrong "), "{said}");
    assert!(!said.contains("rounded to f32"), "{said}");
    // One answer tells nobody who loses hits.
    assert!(
        said.contains("too few of these or of those to tell"),
        "{said}"
    );
    fs::write(
        folder.join("t.obj"),
        "v 0 0 0\nv 1e300 0 0\nv 0 1e300 0\nf 1 2 3\n",
    )
    .unwrap();
    fs::write(folder.join("r.csv"), "2.5e299,2.5e299,1e299,0,0,-1e299\n").unwrap();
    ends(&folder, &words, 1);
    let (_, error) = ends(&folder, &[&words[..], &["--scalar", "f32"]].concat(), 65);
    assert!(
        error.contains("t.obj: face 0, counted from 0, has a coordinate beyond f32"),
        "{error}"
    );
}

#[test]
fn every_answer_is_told_as_csv() {
    let folder = folder("rays-csv");
    fs::write(folder.join("a.csv"), "0,5\nnone\n-1\n").unwrap();
    let words = ["rays", "t.obj", "r.csv", "-q", "--answers", "a.csv", "-o"];
    ends(&folder, &[&words[..], &["all.csv"]].concat(), 1);
    let all = fs::read_to_string(folder.join("all.csv")).unwrap();
    let lines: Vec<&str> = all.lines().collect();
    assert_eq!(
        lines[0],
        "number,judgement,exact_faces,exact_t,answered,answered_t,off_in_edges"
    );
    assert!(
        lines[1].starts_with("0,farther face,3,4.25,0,5.0,0.53"),
        "{all}"
    );
    assert!(lines[2].starts_with("1,neighbour,"), "{all}");
    assert_eq!(lines[3], "2,right,,,,,");
    // A name that promises what is not written here is refused, and nothing is written.
    let (_, error) = ends(&folder, &[&words[..], &["all.sarif"]].concat(), 2);
    assert!(error.contains("'all.sarif' is named as sarif"), "{error}");
    assert!(!folder.join("all.sarif").exists());
}
