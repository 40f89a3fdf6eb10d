//! `boxes prove`: the least growth of a far end, proved where nothing leaves the range.

use crate::io::shell;
use crate::program::{ends, ends_flat, scratch};
use serde_json::Value;

fn json(text: &str) -> Value {
    serde_json::from_str(text).unwrap()
}

#[test]
fn the_least_growth_is_proved_for_ordinary_sizes_and_less_loses_the_ray_that_is_shown() {
    let folder = scratch("boxes-prove");
    let (out, _) = ends(&folder, &["boxes", "prove", "--format", "json"], 0);
    let rows = json(&out)["rows"].as_array().unwrap().clone();
    let found: Vec<(&str, Option<u64>)> = rows
        .iter()
        .map(|row| (row["test"].as_str().unwrap(), row["in_epsilons"].as_u64()))
        .collect();
    let one = [
        ("divided", Some(2)),
        ("multiplied", Some(3)),
        ("fused", None),
    ];
    assert_eq!(found, [one, one].concat());
    for row in &rows {
        let (test, witness) = (
            row["test"].as_str().unwrap(),
            row["witness"].as_str().unwrap(),
        );
        let judged = |growth: String| {
            let explain = [
                "boxes",
                "explain",
                witness,
                "-k",
                test,
                "--epsilon",
                &growth,
            ];
            let (out, _) = ends(&folder, &[&explain[..], &["--format", "json"]].concat(), 0);
            json(&out)["answers"][0]["judged"]
                .as_str()
                .unwrap()
                .to_owned()
        };
        let lost = "wrong: the ray is lost";
        match row["in_epsilons"].as_u64() {
            Some(units) => {
                assert_eq!(judged(format!("growth=-{}*EPSILON", units - 1)), lost);
                assert_eq!(judged(format!("growth=-{units}*EPSILON")), "right");
            }
            None => assert_eq!(judged("growth=-1e12".to_owned()), lost),
        }
    }
    let (screen, _) = ends_flat(&folder, &["boxes", "prove"], 0);
    for words in [
        "divided f32 growth=-2*EPSILON 4 proved for these sizes",
        "multiplied f64 growth=-3*EPSILON 6 proved for these sizes",
        "fused f32 none is enough – a ray is lost with 2^32*EPSILON",
    ] {
        assert!(screen.contains(words), "{words}: {screen}");
    }
    // The commands on the screen run as they stand, and show a ray that is lost.
    let (screen, _) = ends(&folder, &["boxes", "prove"], 0);
    let mut shown = 0;
    for line in screen.lines() {
        if let Some((_, rest)) = line.split_once("hairline boxes explain ") {
            let command = format!("hairline boxes explain {rest}");
            let (code, out, error) = shell(&folder, &command);
            assert_eq!(code, 0, "{command}: {error}");
            let told = out.split_whitespace().collect::<Vec<_>>().join(" ");
            assert!(told.contains("1 of 1 tests are wrong"), "{command}: {told}");
            shown += 1;
        }
    }
    assert_eq!(shown, 6, "{screen}");
}

#[test]
fn nothing_is_called_proved_where_the_hypothesis_fails() {
    let folder = scratch("boxes-prove-fails");
    // f32 underflows at these sizes, and f64 does not.
    let tiny = ["boxes", "prove", "--least", "1e-35"];
    let (screen, _) = ends_flat(&folder, &tiny, 1);
    assert!(
        screen.contains("Not proved: the sizes leave the range"),
        "{screen}"
    );
    let fails =
        "multiplied f32 growth=-3*EPSILON 6 not proved, since this fails: no t but 0 underflows";
    assert!(screen.contains(fails), "{screen}");
    assert!(
        !screen.contains("f32 growth=-2*EPSILON 4 proved"),
        "{screen}"
    );
    assert!(
        screen.contains("divided f64 growth=-2*EPSILON 4 proved for these sizes"),
        "{screen}"
    );
    for (flags, message) in [
        (
            ["--least", "0"],
            "0e0 and 1e6 are not finite sizes above 0 in order",
        ),
        (["--extent", "nan"], "1e-6 and NaN are not finite sizes"),
        (["--fastest", "1e-9"], "1e-6 and 1e-9 are not finite sizes"),
        (["--slowest", "-1"], "unexpected argument"),
    ] {
        let (_, error) = ends(&folder, &[&["boxes", "prove"], &flags[..]].concat(), 2);
        assert!(error.contains(message), "{error}");
    }
}
