//! `boxes explain @NAME`: what slab tests say of the boxes in other people's reports. The truth of each is worked out here by
//! hand, and the program finds it by its own.

use crate::program::{ends, ends_flat, scratch};
use serde_json::Value;

/// The truth and the wrong answers of a report.
struct Expected {
    name: &'static str,
    /// Words of the truth.
    truth: &'static str,
    /// Where the line enters and leaves the box.
    line: Option<[&'static str; 2]>,
    /// The tests that are wrong, in the order of the table.
    wrong: &'static [&'static str],
}

/// They compute 0 times infinity, or a finite number in its place, and lose a ray in the plane of a face.
const NAN: &[&str] = &[
    "smits",
    "williams",
    "majercik",
    "pbrt-precomputed",
    "barnes-2011",
    "barnes-2015",
    "bvh",
];

const EXPECTED: &[Expected] = &[
    // x = 1 is a face, y = 1/2 is between two, and z = t - 1 is in [0, 1] for t in [1, 2]. Embree's least direction 1e-18 puts
    // the far end of x at (1 - 1)·1e18 = 0, before the near end of z.
    Expected {
        name: "embree-589",
        truth: "runs in the plane of a face",
        line: Some(["1", "2"]),
        wrong: &[
            "smits",
            "williams",
            "majercik",
            "pbrt-precomputed",
            "embree-fast",
            "embree-robust",
            "aila-laine",
            "barnes-2015",
            "tinybvh",
            "tinybvh-1e30",
            "bvh",
        ],
    },
    // The z axis meets the square z = 1 in its middle, at t = 1. The remedy, <= in place of <, is in today's crate.
    Expected {
        name: "bvh-107",
        truth: "one point of the flat box, inside a face",
        line: Some(["1", "1"]),
        wrong: &["barnes-2015"],
    },
    // z = -50 is below -25.5 at every t. fma(b, infinity, infinity) is a NaN, and `fused` drops it.
    Expected {
        name: "bvh-119",
        truth: "the line passes outside the box",
        line: None,
        wrong: &["fused"],
    },
    // The start is inside: -5000.33349609375 <= -5000. As floats of 24 bits min is -5000 - 683/2048 and max is
    // 11184811/2^25, which with the 5000 from the start is 167783344811/2^25.
    Expected {
        name: "bvh-134",
        truth: "passes through the interior; the ray starts inside",
        line: Some(["-683/2048", "167783344811/33554432"]),
        wrong: &[],
    },
    // The point has y = -5000, where the ray is at t = 0 only, and x > 0, where it is later.
    Expected {
        name: "bvh-140",
        truth: "the line passes outside the box",
        line: None,
        wrong: &[],
    },
    // x = y = 1/2, and z = t - 1. Smits asks for the sign of d, and -0 >= 0.
    Expected {
        name: "tinybvh-282",
        truth: "passes through the interior",
        line: Some(["1", "2"]),
        wrong: &["smits"],
    },
    // x is the plane at min, y = 1/2, and z = t - 1.
    Expected {
        name: "tinybvh-286",
        truth: "runs in the plane of a face",
        line: Some(["1", "2"]),
        wrong: &[
            "smits",
            "williams",
            "majercik",
            "pbrt-precomputed",
            "embree-fast",
            "barnes-2011",
            "barnes-2015",
            "bvh",
        ],
    },
    // (0, 1/2, 0) at t = 1 is in the middle of the edge x = 0 of the square z = 0; elsewhere z is not 0.
    Expected {
        name: "warp-1530",
        truth: "touches an edge and nothing else",
        line: Some(["1", "1"]),
        wrong: NAN,
    },
    // The vertex (0, 0, 0) at t = 1 is a corner of the square [-1, 0] by [0, 1]; elsewhere z is not 0.
    Expected {
        name: "libigl-2232",
        truth: "touches a corner and nothing else",
        line: Some(["1", "1"]),
        wrong: &[
            "smits",
            "williams",
            "majercik",
            "pbrt-precomputed",
            "embree-fast",
            "embree-robust",
            "aila-laine",
            "barnes-2011",
            "barnes-2015",
            "tinybvh",
            "tinybvh-1e30",
            "bvh",
        ],
    },
    // The floats as fractions: x is in the box from t = 2.65990 to 2.68198, y from 2.50955 to 412267117/154924352 =
    // 2.661086599, z from 24570208/9233149 = 2.661086483 to 2.87048. So it is met, for a 2^-23 of its t.
    Expected {
        name: "libigl-2270",
        truth: "passes through the interior",
        line: Some(["24570208/9233149", "412267117/154924352"]),
        wrong: &[
            "williams",
            "majercik",
            "embree-fast",
            "aila-laine",
            "barnes-2011",
            "barnes-2015",
            "barnes-2022",
            "plane-first",
            "plane-last",
            "tinybvh",
            "tinybvh-1e30",
            "bvh",
            "multiplied",
            "fused",
        ],
    },
    // The z axis is an edge of the unit cube, and z = t - 1.
    Expected {
        name: "raytracing-927",
        truth: "runs in the plane of a face",
        line: Some(["1", "2"]),
        wrong: NAN,
    },
    // z = -t is in [0, 1] for t in [-1, 0]: the ray has the end t = 0 alone. Who leaves out the ends does so on purpose.
    Expected {
        name: "monogame-7581",
        truth: "one point, the end, has t >= 0",
        line: Some(["-1", "0"]),
        wrong: &[],
    },
    // There is no line, and nothing is owed. A caller has to look at the direction.
    Expected {
        name: "reone-341",
        truth: "no question: NaN",
        line: None,
        wrong: &[],
    },
];

fn explained(name: &str) -> Value {
    let folder = scratch("boxes-published");
    let name = format!("@{name}");
    let run = ["boxes", "explain", &name, "--format", "json"];
    serde_json::from_str(&ends(&folder, &run, 0).0).unwrap()
}

#[test]
fn reports_have_the_truth_that_a_hand_finds_and_name_the_tests_that_are_wrong() {
    for Expected {
        name,
        truth,
        line,
        wrong,
    } in EXPECTED
    {
        let found = explained(name);
        assert!(found["truth"].as_str().unwrap().contains(truth), "{found}");
        let ends = line.map_or(Value::Null, Value::from);
        assert_eq!(found["line"], ends, "{name}");
        let answers = found["answers"].as_array().unwrap().iter();
        let is_wrong = |answer: &&Value| answer["judged"].as_str().unwrap().starts_with("wrong");
        let names: Vec<&str> = answers
            .filter(is_wrong)
            .map(|answer| answer["test"].as_str().unwrap())
            .collect();
        assert_eq!(names, *wrong, "{name}");
        // The test that the guide recommends is right wherever anything is owed.
        let advised = &found["recommended"];
        let judged = advised["judged"].as_str().unwrap();
        assert!(!judged.starts_with("wrong"), "{name}: {advised}");
        assert_eq!(advised["test"], "ize (gamma3)");
    }
}

/// The form that PR #286 describes: fma(b, 1e30, -(o·1e30)) where b = o. Its error alone is the near end.
#[test]
fn a_reciprocal_that_is_no_power_of_two_moves_a_plane_to_far_away() {
    let near = |plane: f32, reciprocal: f32| plane.mul_add(reciprocal, -(plane * reciprocal));
    assert!(near(0.1, 1e30) > 1e21);
    assert_eq!(near(0.1, 100f32.exp2()), 0.0);
}

#[test]
fn each_report_is_listed_with_its_source_and_shown_with_it() {
    let folder = scratch("boxes-published-list");
    let (list, _) = ends_flat(&folder, &["boxes", "list", "published"], 0);
    for Expected { name, .. } in EXPECTED {
        assert!(list.contains(format!("@{name} ")), "{list}");
    }
    let run = ["boxes", "explain", "@libigl-2270", "-k", "multiplied"];
    let (screen, _) = ends_flat(&folder, &run, 0);
    for words in [
        "@libigl-2270: 1 of 1 tests are wrong",
        "libigl/libigl #2270 (2023)",
        "numbers posted: the box of a triangle",
        "advised ize (gamma3) says hit: right",
    ] {
        assert!(screen.contains(words), "{words}: {screen}");
    }
    let (_, error) = ends(&folder, &["boxes", "explain", "@libigl-2271"], 2);
    assert!(
        error.contains("unknown published case 'libigl-2271'; did you mean 'libigl-2270'?"),
        "{error}"
    );
}
