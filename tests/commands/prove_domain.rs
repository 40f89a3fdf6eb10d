//! The domains of `hairline prove`: the rays that it shows lie in them, and a CI may demand how large they are.

use crate::program::scratch;
use crate::prove::{case_of, everything, explained, hairline, refused, result, text, words};
use num_rational::BigRational;
use num_traits::{Signed, ToPrimitive, Zero};
use serde_json::Value;
use std::fs;

type Point = [BigRational; 3];

/// A ray and a triangle in rationals: origin, direction, a, b, c, and t_max.
struct Ray {
    vectors: [Point; 5],
    end: BigRational,
}

impl Ray {
    fn of(command: &str) -> Ray {
        let case = case_of(explained(command).0);
        let exact = |number: &Value| {
            let text = number.to_string();
            let value: f64 = match case["scalar"] == "f32" {
                true => text.parse::<f32>().unwrap().into(),
                false => text.parse().unwrap(),
            };
            BigRational::from_float(value).unwrap()
        };
        let vector = |name: &str| [0, 1, 2].map(|axis| exact(&case[name][axis]));
        let vectors = ["origin", "direction", "a", "b", "c"].map(vector);
        Ray {
            vectors,
            end: exact(&case["t_max"]),
        }
    }

    /// From each of some points to another one.
    fn between(&self, pairs: [(usize, usize); 3]) -> [Point; 3] {
        pairs.map(|(p, q)| [0, 1, 2].map(|axis| &self.vectors[q][axis] - &self.vectors[p][axis]))
    }

    fn edges(&self) -> [Point; 3] {
        self.between([(2, 3), (2, 4), (3, 4)])
    }

    fn reach(&self) -> [Point; 3] {
        self.between([(0, 2), (0, 3), (0, 4)])
    }

    fn normal(&self) -> Point {
        let [u, v, _] = self.edges();
        [(1, 2), (2, 0), (0, 1)].map(|(i, j)| &u[i] * &v[j] - &u[j] * &v[i])
    }

    fn volume(&self) -> BigRational {
        dot(&self.normal(), &self.vectors[1])
    }

    fn time(&self) -> BigRational {
        dot(&self.normal(), &self.reach()[0]) / self.volume()
    }
}

fn dot(u: &Point, v: &Point) -> BigRational {
    &u[0] * &v[0] + &u[1] * &v[1] + &u[2] * &v[2]
}

fn length(v: &Point) -> f64 {
    dot(v, v).to_f64().unwrap().sqrt()
}

fn largest<'a>(vectors: impl IntoIterator<Item = &'a Point>) -> BigRational {
    vectors
        .into_iter()
        .flatten()
        .map(Signed::abs)
        .max()
        .unwrap()
}

/// The commands of the known rays of a record, with what they are of.
fn known(record: &Value) -> Vec<(String, String)> {
    let mut all = Vec::new();
    for kernel in record["kernels"].as_array().unwrap() {
        for side in ["misses", "hits"] {
            let of = format!("{} {} {side}", kernel["kernel"], kernel["scalar"]);
            let command = kernel["verdicts"][side]["known"]["command"].as_str();
            all.extend(command.map(|command| (of, command.to_owned())));
        }
    }
    all
}

#[test]
fn every_known_ray_lies_in_the_unit_domain_that_is_printed() {
    let record = everything();
    let bound =
        |name: &str| BigRational::from_float(record["domain"][name].as_f64().unwrap()).unwrap();
    let all = known(record);
    // Fifteen kernels with two sides in two scalars.
    assert_eq!(all.len(), 60);
    for (of, command) in all {
        let ray = Ray::of(&command);
        let [origin, direction, a, b, c] = &ray.vectors;
        assert!(largest(&ray.edges()) <= bound("edge"), "{of}: {command}");
        assert!(largest(&ray.reach()) <= bound("reach"), "{of}: {command}");
        assert!(
            largest([origin, a, b, c]) <= bound("world"),
            "{of}: {command}"
        );
        assert!(
            largest([direction]) <= bound("direction"),
            "{of}: {command}"
        );
        assert!(
            bound("divisor_at_least") <= ray.volume().abs(),
            "{of}: {command}"
        );
        assert!(
            ray.end <= bound("extent") && ray.time() <= ray.end,
            "{of}: {command}"
        );
        assert!(BigRational::zero() <= ray.time(), "{of}: {command}");
    }
}

#[test]
fn every_known_ray_of_a_scene_has_the_sizes_that_the_scene_says() {
    let far = [
        "--coordinates",
        "1000",
        "--edge",
        "0.01..10",
        "--distance",
        "2000",
    ];
    let kernel = "moller-trumbore";
    let flags = ["prove", "--kernel", kernel, "-q", "--format", "json"];
    // In a room the longest edges of triangles are from 0.01 to 3.
    let [edges, longest] = [
        (&far[..], 1000.0, 10.0, 2000.0),
        (&["--scene", "room"], 15.0, 3.0, 13.0),
    ];
    for ((scene, coordinates, most, distance), is_of_longest) in [(edges, false), (longest, true)] {
        let all = known(&result(&hairline(&[&flags[..], scene].concat())));
        assert!(3 <= all.len(), "{all:?}");
        for (of, command) in all {
            let ray = Ray::of(&command);
            let [origin, direction, a, b, c] = &ray.vectors;
            // A float of 24 digits is no nearer to the end of a range.
            let slack = 1.0 + 1e-6;
            let text = format!("{of}: {command}");
            assert!(
                largest([origin, a, b, c]).to_f64().unwrap() <= coordinates,
                "{text}"
            );
            let lengths = ray.edges().map(|edge| length(&edge));
            let long = lengths.into_iter().fold(0.0, f64::max);
            let short = lengths.into_iter().fold(long, f64::min);
            let least = if is_of_longest { long } else { short };
            assert!(
                0.01 <= least * slack && long <= most * slack,
                "{text}: {lengths:?}"
            );
            let reach = ray.reach().map(|it| length(&it));
            assert!(
                reach.into_iter().all(|it| it <= distance * slack),
                "{text}: {reach:?}"
            );
            assert!((length(direction) - 1.0).abs() < 1e-6, "{text}");
            assert!(
                ray.time() <= ray.end && ray.end.to_f64().unwrap() <= distance,
                "{text}"
            );
            let area = length(&ray.normal());
            let sine = ray.volume().abs().to_f64().unwrap() / area;
            assert!(1f64.to_radians().sin() <= sine * slack, "{text}: {sine}");
            // The smallest angle is between the two longest edges.
            let sine = area * short / lengths.into_iter().product::<f64>();
            assert!(1f64.to_radians().sin() <= sine * slack, "{text}: {sine}");
        }
    }
}

#[test]
fn what_is_known_is_known_at_the_epsilons_that_were_asked_about() {
    let at = |epsilon: &str| {
        let flags = [
            "prove",
            "-k",
            "moller-trumbore",
            "--scalar",
            "f32",
            "--format",
            "json",
            "-q",
        ];
        let record = result(&hairline(&[&flags[..], &["--epsilon", epsilon]].concat()));
        record["kernels"][0]["verdicts"]["hits"].clone()
    };
    let hits = at("edge=-1e-5");
    let share = hits["known"]["share"].as_f64().unwrap();
    // A triangle's height may be as long as its longest edge, so a plain search finds a hit 9.8e-6 outside.
    assert!(
        9.8e-6 < share && share <= hits["share"].as_f64().unwrap(),
        "{hits}"
    );
    let command = hits["known"]["command"].as_str().unwrap();
    assert!(
        command.ends_with(" --epsilon 'parallel=1e-6,edge=-1e-5'"),
        "{command}"
    );
    let (case, rest) = explained(command);
    let flags = rest.replace('\'', "");
    let shown = hairline(
        &[
            &["explain", case],
            &flags.split(' ').collect::<Vec<_>>()[..],
        ]
        .concat(),
    );
    let shown = String::from_utf8(shown.stdout).unwrap();
    assert!(shown.to_lowercase().contains("false-hit"), "{shown}");
    // Far more is known where more is let through.
    assert!(9e-4 < at("edge=-1e-3")["known"]["share"].as_f64().unwrap());
}

#[test]
fn a_ci_may_demand_how_large_the_domain_of_a_certificate_is() {
    let stored = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/corpora/proofs/moller-trumbore-f32.proof"
    );
    let with =
        |file: &str, demand: &str| hairline(&["prove", "--check", file, "--demand-domain", demand]);
    for met in [
        "edge=0.999",
        "edge=0.5,reach=0.5,direction=1,floor=0.5,quotient=1",
        "floor=0.75",
    ] {
        assert_eq!(with(stored, met).status.code(), Some(0), "{met}");
    }
    for (demand, found) in [
        (
            "edge=1",
            "its domain has edge up to 0.9990234375, demanded edge=1",
        ),
        (
            "edge=0.1,world=1000",
            "its domain has world up to 0.9990234375, demanded world=1000",
        ),
        (
            "floor=0.1",
            "its domain has floor from 0.5, demanded floor=0.1",
        ),
        (
            "direction-floor=0.1",
            "its domain has direction-floor from 0.5, demanded direction-floor=0.1",
        ),
    ] {
        let demanded = format!("not all of gate 'edge' is proved for {demand}: {found}");
        refused(
            &["prove", "--check", stored, "--demand-domain", demand],
            1,
            &demanded,
        );
    }
    for (wrong, message) in [
        (
            "edges=1",
            "expected NAME=SIZE, where NAME is one of edge, reach, world,",
        ),
        ("edge", "expected NAME=SIZE"),
        ("edge=large", "'large' is no size"),
        ("edge=nan", "'nan' is no size"),
        ("edge=-1", "'-1' is no size"),
    ] {
        let output = with(stored, wrong);
        let error = String::from_utf8_lossy(&output.stderr);
        assert!(
            output.status.code() == Some(2) && error.contains(message),
            "{wrong}: {error}"
        );
    }
    let alone = hairline(&["prove", "--demand-domain", "edge=1"]);
    assert_eq!(alone.status.code(), Some(2));
    // Triangles of a scene have a domain for each size: the largest must be there, and its divisors are not smaller than demanded.
    let file = scratch("prove-demand").join("scene.proof");
    let file = file.to_str().unwrap();
    let scene = ["--coordinates", "4", "--edge", "0.5..4", "--distance", "8"];
    let kernel = ["prove", "--kernel", "plane-unit-normal", "--scalar", "f64"];
    text(&[&kernel[..], &scene, &["--certificate", file]].concat());
    assert_eq!(
        with(file, "edge=4,reach=8,world=4,extent=8").status.code(),
        Some(0)
    );
    refused(
        &["prove", "--check", file, "--demand-domain", "edge=5"],
        1,
        "demanded edge=5",
    );
    refused(
        &["prove", "--check", file, "--demand-domain", "floor=0"],
        1,
        "demanded floor=0",
    );
    // Nothing is proved of what a certificate leaves out.
    let whole = fs::read_to_string(stored).unwrap();
    let last = whole.rfind("\nprogram\n").unwrap();
    fs::write(file, &whole[..=last]).unwrap();
    assert_eq!(hairline(&["prove", "--check", file]).status.code(), Some(0));
    let missing = "is proved for edge=0.5: the certificate is without some of its numbers";
    refused(
        &["prove", "--check", file, "--demand-domain", "edge=0.5"],
        1,
        missing,
    );
}

#[test]
fn the_screen_says_where_known_rays_lie() {
    let out = words(&text(&["prove", "--kernel", "plucker", "--scalar", "f32"]));
    let domain = "Known rays lie in it, with |N·d| of 0.5 and more and t_max = 1;";
    assert!(out.contains(domain) && out.contains(",t_max:1"), "{out}");
}
