//! `hairline rays --answers`: the answers of programs, judged, and held to known ones.

use crate::program::{ends, flat};
use crate::rays::folder;
use std::fs;
use std::path::Path;

/// What is said of a program's answers to the rays of `r.csv`, in one line.
pub fn judged(folder: &Path, answers: &str, more: &[&str], code: i32) -> String {
    fs::write(folder.join("a.csv"), answers).unwrap();
    let words = ["rays", "t.obj", "r.csv", "-q", "--answers", "a.csv"];
    flat(&ends(folder, &[&words, more].concat(), code).0)
}

#[test]
fn answers_are_judged_by_kind() {
    let folder = folder("rays-answers");
    let judged = |answers: &str, code: i32| judged(&folder, answers, &[], code);
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
            "ray 0: farther face: the nearest is face 3 at t = 4.25; answered face 0 at t = 5.0, which it meets 0.530 longest edges behind"
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
    let judged = |answers: &str, more: &[&str], code: i32| judged(&folder, answers, more, code);
    let from_one = judged(&"1\n".repeat(10), &[], 1);
    assert!(
        from_one.contains("The faces are numbered otherwise: with -1 most wrong ones are right."),
        "{from_one}"
    );
    // All hits are numbered alike.
    let all: String = (0..10).map(|ray| format!("{ray},1,1\n")).collect();
    let all_from_one = judged(&all, &["--answered", "all"], 1);
    assert!(
        all_from_one
            .contains("The faces are numbered otherwise: with -1 most wrong ones are right."),
        "{all_from_one}"
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
fn a_face_that_does_not_exist_is_said_to_be_none() {
    let folder = folder("rays-no-face");
    let said = judged(&folder, "3,4.25\n1,4\n4,1\n", &[], 1);
    for words in [
        "1 answer names a face that the mesh does not have: faces are counted from 0 here",
        "ray 2: ghost: no face is hit; answered face 4 at t = 1.0; the mesh has no face 4",
    ] {
        assert!(said.contains(words), "{words}: {said}");
    }
    let all = judged(&folder, "0,3\n0,0\n1,4\n2,4\n", &["--answered", "all"], 1);
    assert!(
        all.contains("2 answers name a face that the mesh does not have"),
        "{all}"
    );
}

#[test]
fn a_file_without_any_hit_is_an_error_where_rays_hit() {
    let folder = folder("rays-no-hits");
    let refused = |answers: &str, message: &str| {
        fs::write(folder.join("a.csv"), answers).unwrap();
        let words = ["rays", "t.obj", "r.csv", "-q", "--answers", "a.csv"];
        let (_, error) = ends(&folder, &[&words[..], &["--answered", "all"]].concat(), 65);
        assert!(error.contains(message), "{answers:?}: {error}");
    };
    let nothing = "a.csv: there are no answers in it: expected ray,face,t, a line for each hit";
    refused("", nothing);
    refused("# mine\n", nothing);
    // The second ray only touches an edge.
    let no_hits =
        "a.csv: there are no hits in it, and 1 of 3 rays hit the mesh: expected ray,face,t";
    refused("ray,face,t\n", no_hits);
    // Where all rays miss, names alone are right; and a file of nothing is none.
    fs::write(folder.join("r.csv"), "5,5,5,1,0,0\n").unwrap();
    judged(&folder, "ray,face,t\n", &["--answered", "all"], 0);
    refused("", nothing);
}

#[test]
fn a_distance_is_said_in_words_that_are_true_of_points_in_front_too() {
    let folder = folder("rays-in-front");
    fs::write(folder.join("a.csv"), "3,4\n1,5\n-1\n").unwrap();
    let words = ["rays", "t.obj", "r.csv", "-q", "--answers", "a.csv"];
    let html = ends(&folder, &[&words[..], &["--format", "html"]].concat(), 1).0;
    assert!(
        html.contains("distance from the exact point, before or behind it, in longest edges"),
        "{html}"
    );
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
    assert!(junit.contains("tests=\"10\" failures=\"1\""), "{junit}");
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
        "number,judgement,exact,exact_t,answered,answered_t,off_in_edges"
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

/// A square of two faces, and another behind it.
const TWO_WALLS: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 -1\nv 1 0 -1\nv 1 1 -1\nv 0 1 -1\nf 1 2 3\nf 1 3 4\nf 5 6 7\nf 5 7 8\n";

#[test]
fn points_that_are_nearer_than_anybody_sees_have_no_order() {
    let folder = folder("rays-order");
    // Another face a hair behind the first wall.
    let near = "v 0 0 -1e-9\nv 1 0 -1e-9\nv 1 1 -1e-9\nf 9 10 11\n";
    fs::write(folder.join("t.obj"), [TWO_WALLS, near].concat()).unwrap();
    fs::write(folder.join("r.csv"), "0.75,0.25,1,0,0,-1\n").unwrap();
    let judged = |answers: &str, code: i32| judged(&folder, answers, &["--answered", "all"], code);
    assert!(judged("0,0\n0,4\n0,2\n", 0).contains(" right 1 "));
    assert!(judged("0,4\n0,0\n0,2\n", 0).contains(" neighbour 1 "));
    assert!(judged("0,2\n0,0\n0,4\n", 1).contains(" wrong order 1 "));
}

#[test]
fn the_face_that_a_ray_starts_at_is_a_self_hit_where_it_is_missed() {
    let folder = folder("rays-self-hit");
    fs::write(folder.join("t.obj"), TWO_WALLS).unwrap();
    // From a hair behind the first wall to the second one.
    fs::write(folder.join("r.csv"), "0.75,0.25,-1e-9,0,0,-1\n").unwrap();
    let judged = |answers: &str, more: &[&str], code: i32| judged(&folder, answers, more, code);
    judged("2,0.999999999\n", &[], 0);
    for answer in ["0,1e-12\n", "0\n"] {
        let wrong = judged(answer, &[], 1);
        assert!(wrong.contains(" self-hit 1 "), "{wrong}");
    }
    let all = judged("0,0,1e-12\n0,2,1\n", &["--answered", "all"], 1);
    assert!(all.contains(" self-hit 1 "), "{all}");
    // A face that is met later too: its point at the start is not named twice.
    fs::write(folder.join("r.csv"), "0.1,0.05,1e-4,0.9,0,-1e-3\n").unwrap();
    let later = judged("0,0,0\n0,0,0.1\n", &["--answered", "all"], 1);
    assert!(later.contains(" self-hit 1 "), "{later}");
    // Where nothing else is, too; and from a hair in front of it the wall is right.
    fs::write(folder.join("r.csv"), "0.75,0.25,1e-9,0,0,1\n").unwrap();
    assert!(judged("0,1e-12\n", &[], 1).contains(" self-hit 1 "));
    fs::write(folder.join("r.csv"), "0.75,0.25,1e-9,0,0,-1\n").unwrap();
    judged("0,1e-9\n", &[], 0);
}

#[test]
fn a_face_that_is_missed_by_a_hair_is_a_neighbour_with_and_without_t() {
    let folder = folder("rays-hair");
    fs::write(folder.join("t.obj"), TWO_WALLS).unwrap();
    // Along the first wall, a hair above it and a hair below its slope: the plane is met far beyond its rim.
    fs::write(folder.join("r.csv"), "-1,0.25,1e-7,1,0,-1e-9\n").unwrap();
    for answer in ["0,1.5\n", "0\n"] {
        let said = judged(&folder, answer, &[], 0);
        assert!(said.contains(" neighbour 1 "), "{answer}: {said}");
    }
}

#[test]
fn it_is_said_where_wrong_answers_lie() {
    let folder = folder("rays-where");
    fs::write(folder.join("t.obj"), TWO_WALLS).unwrap();
    let judged = |rays: &str, answers: &str, more: &[&str]| {
        fs::write(folder.join("r.csv"), rays).unwrap();
        judged(&folder, answers, more, 1)
    };
    let rays = "0.5,0.49999999,1,0,0,-1\n-1,0.25,1.35e-3,1,0,-9e-4\n0.75,0.25,1,0,0,-1\n";
    let said = judged(rays, "-1\n-1\n-1\n", &[]);
    assert!(
        said.contains(
            "Rays of the wrong answers: 1 meet a face within a millionth of it from an edge, 1 graze a face, at a slope below 1/1000, 1 meet the inside of a face."
        ),
        "{said}"
    );
    let beyond = judged("0.75,0.25,1,0,0,-1,0,0.5\n", "0,1\n", &[]);
    assert!(
        beyond.contains("1 wrong answer has a t before its ray's t_min or behind t_max"),
        "{beyond}"
    );
    let any = judged("0.75,0.25,1,0,0,-1\n", "0\n", &["--answered", "any"]);
    assert!(
        any.contains("1 of the answers say that nothing is hit, where something is."),
        "{any}"
    );
    let all = judged("0.75,0.25,1,0,0,-1\n", "0,0\n", &["--answered", "all"]);
    assert!(all.contains("1 of the answers leave a hit out."), "{all}");
}

#[test]
fn the_way_in_which_a_program_takes_points_for_inside_is_found_out() {
    let folder = folder("rays-parity");
    // A cube in a cube, wound alike: twice around the middle.
    let cube = |size: f64| -> String {
        let corner = |i: usize| {
            let [x, y, z] = [i & 1, i >> 1 & 1, i >> 2].map(|bit| size * (2.0 * bit as f64 - 1.0));
            format!("v {x} {y} {z}\n")
        };
        (0..8).map(corner).collect()
    };
    let faces = |first: usize| -> String {
        let quads = [
            [0, 2, 3, 1],
            [4, 5, 7, 6],
            [0, 1, 5, 4],
            [2, 6, 7, 3],
            [0, 4, 6, 2],
            [1, 3, 7, 5],
        ];
        let line = |quad: [usize; 4]| {
            let [a, b, c, d] = quad.map(|corner| corner + first);
            format!("f {a} {b} {c} {d}\n")
        };
        quads.into_iter().map(line).collect()
    };
    let mesh = [cube(1.0), cube(2.0), faces(1), faces(9)].concat();
    fs::write(folder.join("t.obj"), mesh).unwrap();
    fs::write(folder.join("p.csv"), "0,0,0\n0.1,0.2,0.3\n1.5,0,0\n3,0,0\n").unwrap();
    let judged = |answers: &str| {
        fs::write(folder.join("a.csv"), answers).unwrap();
        let words = [
            "rays",
            "t.obj",
            "--points",
            "p.csv",
            "-q",
            "--answers",
            "a.csv",
        ];
        flat(&ends(&folder, &words, 1).0)
    };
    let by_parity = judged("0\n0\n1\n0\n");
    assert!(
        by_parity.contains("does your program count crossings, and take odd numbers for inside?"),
        "{by_parity}"
    );
    let exchanged = judged("0\n0\n0\n1\n");
    assert!(
        exchanged.contains("inside and outside seem to be exchanged"),
        "{exchanged}"
    );
}

#[test]
fn all_exact_hits_are_written_as_answers_that_are_right() {
    let folder = folder("rays-all");
    fs::write(folder.join("t.obj"), TWO_WALLS).unwrap();
    fs::write(
        folder.join("r.csv"),
        "0.75,0.25,1,0,0,-1\n0.5,0.5,1,0,0,-2\n5,5,5,1,0,0\n",
    )
    .unwrap();
    let words = [
        "rays",
        "t.obj",
        "r.csv",
        "-q",
        "--answered",
        "all",
        "-o",
        "all.csv",
    ];
    ends(&folder, &words, 0);
    let all = fs::read_to_string(folder.join("all.csv")).unwrap();
    assert_eq!(
        all,
        "ray,face,t\n0,0,1.0\n0,2,2.0\n1,0,0.5\n1,1,0.5\n1,2,1.0\n1,3,1.0\n"
    );
    let words = ["rays", "t.obj", "r.csv", "-q", "--answers", "all.csv"];
    let said = ends(&folder, &[&words[..], &["--answered", "all"]].concat(), 0).0;
    assert!(flat(&said).contains(" right 3 "), "{said}");
    let screen = ends(
        &folder,
        &["rays", "t.obj", "r.csv", "-q", "--answered", "all"],
        0,
    )
    .0;
    assert!(
        screen.starts_with("6 hits of 3 rays with faces\n"),
        "{screen}"
    );
}

#[test]
fn a_count_of_what_no_run_has_is_refused() {
    let folder = folder("rays-known-names");
    fs::write(folder.join("a.csv"), "0,5\n1\n-1\n").unwrap();
    let words = [
        "rays",
        "t.obj",
        "r.csv",
        "-q",
        "--answers",
        "a.csv",
        "--known",
        "k.toml",
    ];
    ends(&folder, &[&words[..], &["--bless"]].concat(), 0);
    ends(&folder, &words, 0);
    let known = fs::read_to_string(folder.join("k.toml")).unwrap();
    fs::write(folder.join("k.toml"), format!("{known}gost = 102\n")).unwrap();
    let (_, error) = ends(&folder, &words, 65);
    assert!(
        error.contains("k.toml: a count of 'gost': there are no such judgements"),
        "{error}"
    );
}
