//! `hairline rays --given`: answers judged by the scene that a program makes of mesh and rays first.

use crate::program::ends;
use crate::rays::folder;
use crate::rays_judged::judged;
use std::fs;

#[test]
fn answers_are_judged_by_the_scene_that_a_program_makes_first() {
    let folder = folder("rays-given");
    let judged =
        |answers: &str, steps: &str, code: i32| judged(&folder, answers, &["--given", steps], code);
    // In a scene of half the size t is half as long.
    let halved = judged("3,2.125\n1,2\n-1\n", "scale=0.5", 0);
    assert!(
        halved.contains(
            "Judged by mesh and rays after scale=0.5: 3 answers are right that way, and 1 by the numbers as written."
        ),
        "{halved}"
    );
    // By numbers as written nothing is wrong, so the other scene is no matter.
    let right = judged("3,4.25\n1,4\n-1\n", "scale=0.5", 0);
    assert!(!right.contains("scale"), "{right}");
    let worse = judged("-1\n1,4\n-1\n", "scale=0.5", 1);
    assert!(
        worse.contains(
            "By the scene of --given no more hits are right, or more answers are wrong (2 answers are right). Judged by mesh and rays as written."
        ),
        "{worse}"
    );
    // Far away: f32 holds the square after it is moved, and a ray that is rounded then, to another place.
    let square =
        "v 100000000 0 0\nv 100000001 0 0\nv 100000001 1 0\nv 100000000 1 0\nf 1 2 3\nf 1 3 4\n";
    fs::write(folder.join("t.obj"), square).unwrap();
    fs::write(folder.join("r.csv"), "116777217,0.5,1,-16777215,0,-1\n").unwrap();
    for (steps, reading) in [
        ("move=-1e8,0,0", "move=-1e8,0,0, then rounded to f32"),
        (
            "move=-1e8,0,0 scale=0.5",
            "move=-1e8,0,0 scale=0.5, then rounded to f32, with t as in the written scene",
        ),
    ] {
        let said = judged("0,1\n", steps, 0);
        let words = format!(
            "Judged by mesh and rays after {reading}: 1 answer is right that way, and 0 by the numbers as written."
        );
        assert!(said.contains(&words), "{words}: {said}");
    }
    // A program that rounds the ray first, and then moves and scales it in f32, meets the other face.
    let square =
        "v 16777216 0 0\nv 16777218 0 0\nv 16777218 2 0\nv 16777216 2 0\nf 1 2 3\nf 1 3 4\n";
    fs::write(folder.join("t.obj"), square).unwrap();
    fs::write(folder.join("r.csv"), "16777217,0.5,1,0,0,-1\n").unwrap();
    let in_f32 = judged("1,0.5\n", "move=-16777216,0,0 scale=0.5", 0);
    assert!(
        in_f32.contains("after move=-16777216,0,0 scale=0.5 in f32: 1 answer is right that way"),
        "{in_f32}"
    );
    // Expected wrong answers of that scene are no other cases in the next run.
    let known = [
        "--given",
        "move=-16777216,0,0 scale=0.5",
        "--known",
        "k.toml",
    ];
    let words = ["rays", "t.obj", "r.csv", "-q", "--answers", "a.csv"];
    ends(&folder, &[&words[..], &known, &["--bless"]].concat(), 0);
    let text = fs::read_to_string(folder.join("k.toml")).unwrap();
    assert!(
        text.contains("after move=-16777216,0,0 scale=0.5"),
        "{text}"
    );
    ends(&folder, &[&words[..], &known].concat(), 0);
    let beyond = ["--given", "scale=1e300", "--scalar", "f32"];
    let (_, error) = ends(&folder, &[&words[..], &beyond].concat(), 65);
    assert!(
        error.contains("t.obj: face 0, counted from 0, has a coordinate beyond f32"),
        "{error}"
    );
    let refused = |more: &[&str], message: &str| {
        let words = ["rays", "t.obj", "r.csv", "-q", "--answers", "a.csv"];
        let (_, error) = ends(&folder, &[&words[..], more].concat(), 2);
        assert!(error.contains(message), "{more:?}: {error}");
    };
    refused(
        &["--given", "turn=1"],
        "--given: turn=1: expected steps as \"move=-5,0,2 scale=0.001\"",
    );
    let piped = [
        "rays",
        "t.obj",
        "-",
        "-q",
        "--answers",
        "a.csv",
        "--given",
        "scale=2",
    ];
    let (_, error) = ends(&folder, &piped, 2);
    assert!(
        error.contains("--given: rays and answers are read several times"),
        "{error}"
    );
}
