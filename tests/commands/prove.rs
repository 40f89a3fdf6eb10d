//! `hairline prove` at the command line.

use crate::json_schema;
use crate::program::{self, scratch};
use num_rational::BigRational;
use num_traits::ToPrimitive;
use std::fs;
use std::path::Path;
use std::process::Output;
use std::sync::OnceLock;

pub fn hairline(arguments: &[&str]) -> Output {
    program::hairline(Path::new(env!("CARGO_MANIFEST_DIR")), arguments)
}

fn json(output: &Output) -> serde_json::Value {
    serde_json::from_slice(&output.stdout).unwrap()
}

/// The findings of a record.
pub fn result(output: &Output) -> serde_json::Value {
    json_schema::result(std::str::from_utf8(&output.stdout).unwrap())
}

/// The findings about all kernels, which several tests look at.
pub fn everything() -> &'static serde_json::Value {
    static RECORD: OnceLock<serde_json::Value> = OnceLock::new();
    RECORD.get_or_init(|| result(&hairline(&["prove", "--format", "json", "--quiet"])))
}

/// Everything that is said.
pub fn text(arguments: &[&str]) -> String {
    let output = hairline(&[arguments, &["--details"]].concat());
    assert!(
        output.status.success(),
        "{arguments:?}: {}",
        String::from_utf8_lossy(&output.stderr)
    );
    String::from_utf8(output.stdout).unwrap()
}

/// Without the breaks of its lines.
pub fn words(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

pub fn refused(arguments: &[&str], code: i32, message: &str) {
    let output = hairline(arguments);
    let error = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(code), "{arguments:?}: {error}");
    assert!(error.contains(message), "{arguments:?}: {error}");
    assert_eq!(error.lines().count(), 1, "{error}");
    assert!(output.stdout.is_empty());
}

#[test]
fn the_sentences_of_moller_trumbore_say_what_its_epsilon_is_good_for() {
    let all = text(&["prove", "--kernel", "moller-trumbore", "--scalar", "f32"]);
    let out = words(&all);
    // 17 u to first order by hand: see tests/library/prove.rs.
    assert!(
        out.contains("never wrong by more than 1.02e-6 (17.00 u)"),
        "{out}"
    );
    assert!(
        out.contains("An epsilon above 1.02e-6 refuses every ray that is exactly parallel."),
        "{out}"
    );
    assert!(
        out.contains("e = 1e-6 (source, truck) is proved to refuse every parallel ray"),
        "{out}"
    );
    assert!(
        out.contains("edges: Not watertight: at an edge epsilon of 0"),
        "{out}"
    );
    // What underflow adds is of the domain: see crates/prove/src/tests/permanent.rs.
    let relative = "Where nothing overflows and no product or quotient underflows, it is wrong by at most 7.01 u times its permanent";
    assert!(
        out.contains(relative) && out.contains("In the unit domain it is, underflow or not,"),
        "{out}"
    );
    // Commands are not broken.
    let mut lines = all
        .lines()
        .filter(|line| !line.contains("hairline explain "));
    assert!(lines.all(|line| line.chars().count() <= 160), "{all}");
    // The three sentences that people ask for stand on the first screen.
    let first = hairline(&["prove", "--kernel", "moller-trumbore", "--scalar", "f32"]);
    let shown = String::from_utf8(first.stdout).unwrap();
    let first = words(&shown);
    for part in [
        "an answer can be wrong only where the ray passes within 7.04e-6 of the triangle's longest edge of its boundary",
        "The ray of the deepest known false miss in f32: hairline explain '{scalar:f32",
        "hairline repair --kernel moller-trumbore --scalar f32",
        "No false miss is farther inside an edge than 3.94e-6 of the triangle's longest edge",
        "No false hit is farther outside an edge than 3.94e-6 of the triangle's longest edge",
        "Not watertight: at",
    ] {
        assert!(first.contains(part), "{part}: {first}");
    }
    let sentences = shown
        .lines()
        .filter(|line| !line.contains("hairline explain"));
    let length: usize = sentences.map(str::len).sum();
    assert!(
        !first.contains("at any exponents") && length < out.len() / 2,
        "{first}"
    );
}

#[test]
fn the_readme_says_what_is_proved_and_known() {
    let out = words(&text(&[
        "prove",
        "--kernel",
        "moller-trumbore",
        "--scalar",
        "f32",
    ]));
    let (_, bound) = out.split_once("never wrong by more than ").unwrap();
    let number = |text: &str| text.split(' ').next().unwrap().to_owned();
    let (_, known) = bound.split_once("; ").unwrap();
    let readme = words(include_str!("../../README.md"));
    let sentence = format!(
        "never wrong by more than {}, and a ray is known on which it is wrong by {}.",
        number(bound),
        number(known)
    );
    assert!(readme.contains(&sentence), "{sentence}");
    let record = result(&hairline(&[
        "prove",
        "-k",
        "moller-trumbore",
        "--scalar",
        "f32",
        "--format",
        "json",
    ]));
    let number = |side: &str, known: bool| {
        let part = &record["kernels"][0]["verdicts"][side];
        let number = if known {
            &part["known"]["share"]
        } else {
            &part["share"]
        };
        three_digits(number.as_f64().unwrap(), !known)
    };
    let verdicts = format!(
        "no false miss is farther inside an edge than {} of the triangle's longest edge, and no false hit farther outside an \
         edge than {}. The worst rays that a search has found are a miss {} inside, and a hit {} outside.",
        number("misses", false),
        number("hits", false),
        number("misses", true),
        number("hits", true)
    );
    assert!(readme.contains(&verdicts), "{verdicts}");
    // A bound of more than is there to be wrong says nothing of hits.
    let far = [
        "--coordinates",
        "1000",
        "--edge",
        "0.01..10",
        "--distance",
        "2000",
    ];
    let out = words(&text(
        &[
            &[
                "prove",
                "--kernel",
                "moller-trumbore",
                "--scalar",
                "f32",
                "-n",
                "0",
            ],
            &far[..],
        ]
        .concat(),
    ));
    assert!(
        out.contains("Nothing useful follows for false misses"),
        "{out}"
    );
    let next = "next: hairline epsilon --kernel moller-trumbore --scene \
                extent=1000,edge=0.01..10,distance=0..2000 ";
    assert!(out.contains(next), "{out}");
}

#[test]
fn watertight_is_proved_of_woop_and_not_when_its_products_are_fused() {
    let kernel = |name: &str| {
        let out = hairline(&[
            "prove", "--kernel", name, "--scalar", "f32", "--format", "json",
        ]);
        let record = result(&out);
        record["kernels"][0]["watertight"].as_bool().unwrap()
    };
    assert!(kernel("woop-watertight"));
    assert!(!kernel("woop-watertight+fma"));
    assert!(!kernel("moller-trumbore"));
    // Its edge values are exact negatives, fused or not, but their signs need not be exact.
    for name in ["plucker", "plucker+fma"] {
        assert!(!kernel(name));
        let out = text(&["prove", "--kernel", name, "--scalar", "f64"]);
        assert!(
            words(&out).contains("their values are opposite, or 0"),
            "{out}"
        );
    }
}

/// True if the line of a case meets the closed triangle, in rationals.
fn is_met(case: &serde_json::Value) -> bool {
    let point = |name: &str| {
        let bits = &case["bits"][name];
        [0, 1, 2].map(|axis| {
            let word = bits[axis].as_str().unwrap();
            let bits = u64::from_str_radix(word, 16).unwrap();
            let value = if word.len() == 8 {
                f32::from_bits(bits as u32).into()
            } else {
                f64::from_bits(bits)
            };
            BigRational::from_float(value).unwrap()
        })
    };
    let (o, d) = (point("origin"), point("direction"));
    let [a, b, c] = ["a", "b", "c"].map(|name| {
        let vertex = point(name);
        [0, 1, 2].map(|axis| &vertex[axis] - &o[axis])
    });
    let volume = |p: &[BigRational; 3], q: &[BigRational; 3]| {
        let minor = |i: usize, j: usize| &p[i] * &q[j] - &p[j] * &q[i];
        &d[0] * minor(1, 2) + &d[1] * minor(2, 0) + &d[2] * minor(0, 1)
    };
    let values = [volume(&b, &c), volume(&c, &a), volume(&a, &b)];
    let zero = BigRational::default();
    values.iter().all(|value| *value >= zero) || values.iter().all(|value| *value <= zero)
}

#[test]
fn beside_a_kernel_that_leaks_stands_a_ray_that_does() {
    for (kernel, scalar) in [
        ("moller-trumbore", "f32"),
        ("moller-trumbore", "f64"),
        ("woop-watertight+fma", "f32"),
    ] {
        let prove = ["prove", "-k", kernel, "--scalar", scalar];
        let record = result(&hairline(&[&prove[..], &["--format", "json"]].concat()));
        let [case, command] =
            ["case", "command"].map(|key| record["kernels"][0]["leak"][key].as_str().unwrap());
        let out = text(&prove);
        let said = format!(
            "Not watertight: at an edge epsilon of 0 both triangles of an edge refuse the ray of {case}, which crosses it."
        );
        assert!(
            words(&out).contains(&said) && out.contains(command),
            "{out}"
        );
        let (start, epsilons) = command.split_once(" --epsilon ").unwrap();
        assert_eq!(
            start,
            format!("hairline explain '{case}' --kernel {kernel}")
        );
        let epsilons = epsilons.trim_matches('\'');
        let explain = [
            "explain",
            case,
            "-k",
            kernel,
            "--epsilon",
            epsilons,
            "--format",
            "json",
        ];
        let explained = json(&hairline(&explain));
        let triangles = explained["triangles"].as_array().unwrap();
        assert_eq!(triangles.len(), 2);
        assert!(
            triangles
                .iter()
                .all(|triangle| triangle["rows"][0]["said"] == "miss")
        );
        // By rationals the line meets one of them, or both at their edge.
        assert!(
            triangles.iter().any(|triangle| is_met(&triangle["case"])),
            "{explained}"
        );
    }
    // Where a kernel is watertight, or its values are opposite, there is nothing to show.
    for kernel in ["woop-watertight", "plucker"] {
        let record = result(&hairline(&["prove", "-k", kernel, "--format", "json"]));
        let mut kernels = record["kernels"].as_array().unwrap().iter();
        assert!(kernels.all(|kernel| kernel.get("leak").is_none()));
    }
}

/// How far inside the nearest edge the line of a case meets the plane, over the longest edge, from rationals.
fn depth(case: &serde_json::Value) -> f64 {
    let point = |name: &str| {
        let numbers = case[name].as_array().unwrap().iter();
        let exact = |x: &serde_json::Value| {
            let text = x.to_string();
            let value = match case["scalar"] == "f32" {
                true => text.parse::<f32>().unwrap().into(),
                false => text.parse::<f64>().unwrap(),
            };
            BigRational::from_float(value).unwrap()
        };
        <[BigRational; 3]>::try_from(numbers.map(exact).collect::<Vec<_>>()).unwrap()
    };
    let minus = |p: &[BigRational; 3], q: &[BigRational; 3]| [0, 1, 2].map(|i| &p[i] - &q[i]);
    let cross = |p: &[BigRational; 3], q: &[BigRational; 3]| {
        [(1, 2), (2, 0), (0, 1)].map(|(i, j)| &p[i] * &q[j] - &p[j] * &q[i])
    };
    let dot =
        |p: &[BigRational; 3], q: &[BigRational; 3]| &p[0] * &q[0] + &p[1] * &q[1] + &p[2] * &q[2];
    let (o, d) = (point("origin"), point("direction"));
    let [a, b, c] = ["a", "b", "c"].map(point);
    let normal = cross(&minus(&b, &a), &minus(&c, &a));
    let t = dot(&normal, &minus(&a, &o)) / dot(&normal, &d);
    let at = [0, 1, 2].map(|i| &o[i] + &t * &d[i]);
    let length = |v: &[BigRational; 3]| dot(v, v).to_f64().unwrap().sqrt();
    let edges = [(&a, &b), (&b, &c), (&c, &a)].map(|(p, q)| (minus(q, p), p));
    let longest = edges
        .iter()
        .map(|(edge, _)| length(edge))
        .fold(0.0, f64::max);
    let inside = edges.iter().map(|(edge, from)| {
        let side = dot(&cross(edge, &minus(&at, from)), &normal)
            .to_f64()
            .unwrap();
        side / (length(&normal) * length(edge))
    });
    inside.fold(f64::INFINITY, f64::min) / longest
}

/// The case of a command that explains it, and the flags behind it.
pub fn explained(command: &str) -> (&str, &str) {
    command
        .strip_prefix("hairline explain '")
        .unwrap()
        .split_once("' ")
        .unwrap()
}

/// A case as `explain` takes it.
pub fn case_of(text: &str) -> serde_json::Value {
    let names = ["scalar", "origin", "direction", "a", "b", "c", "t_max"];
    let quote = |json: String, name: &&str| {
        let json = json.replace(&format!("{{{name}:"), &format!("{{\"{name}\":"));
        json.replace(&format!(",{name}:"), &format!(",\"{name}\":"))
    };
    let json = names.iter().fold(text.to_owned(), quote);
    let json = json.replace(":f32", ":\"f32\"").replace(":f64", ":\"f64\"");
    serde_json::from_str(&json).unwrap()
}

/// Of each kernel and scalar the known wrong verdict is below its bound, is as far off as is said, and `explain` says that it is
/// wrong.
#[test]
fn known_verdicts_are_as_wrong_as_is_said_and_no_worse_than_proved() {
    let record = everything();
    let (mut near, mut shown) = (0, 0);
    for kernel in record["kernels"].as_array().unwrap() {
        for (name, finding, side) in [("misses", "false-miss", 1.0), ("hits", "false-hit", -1.0)] {
            let part = &kernel["verdicts"][name];
            let text = format!("{} {} {name}: {part}", kernel["kernel"], kernel["scalar"]);
            if kernel["kernel"] == "havel-herout" {
                assert!(part["why"].is_string() && part["known"].is_null(), "{text}");
                continue;
            }
            // No triangle of the unit domain has all its quotients: see docs/guide/proof.md.
            if kernel["kernel"] == "baldwin-weber" {
                assert!(part["why"].is_null() && part["known"].is_null(), "{text}");
                continue;
            }
            let share = part["share"].as_f64().unwrap();
            let known = part["known"]["share"]
                .as_f64()
                .unwrap_or_else(|| panic!("{text}"));
            assert!(0.0 < known && known <= share, "{text}");
            near += usize::from(share <= 4.0 * known);
            let command = part["known"]["command"].as_str().unwrap();
            let (case, rest) = explained(command);
            let deep = side * depth(&case_of(case));
            assert!((deep / known - 1.0).abs() < 1e-6, "{text}: {deep}");
            if kernel["scalar"] == "f32" {
                let rest = rest.replace('\'', "");
                let words = [&["explain", case], &rest.split(' ').collect::<Vec<_>>()[..]].concat();
                let out = String::from_utf8(hairline(&words).stdout).unwrap();
                assert!(out.to_lowercase().contains(finding), "{command}: {out}");
                shown += 1;
            }
        }
    }
    assert!(shown == 30 && near >= 10, "{shown} {near}");
}

#[test]
fn every_witness_is_below_its_bound_and_near_it() {
    let record = everything();
    let gates = record["gates"].as_array().unwrap();
    assert!(gates.len() > 70, "{}", gates.len());
    for gate in gates {
        let name = format!("{} {} {}", gate["kernel"], gate["scalar"], gate["gate"]);
        let Some(bound) = gate["bound_units"].as_f64() else {
            assert!(gate["why"].is_string(), "{name}");
            continue;
        };
        let witness = gate["witness"]["units"]
            .as_f64()
            .unwrap_or_else(|| panic!("{name}"));
        assert!(witness <= bound, "{name}: {witness} {bound}");
        let divides = gate["supposes"]
            .as_array()
            .unwrap()
            .iter()
            .any(|s| s == "divisors");
        let is_role = |role: &str| gate["gate"] == role;
        if !divides && (is_role("parallel") || is_role("edge")) {
            assert!(bound / witness <= 2.0, "{name}: {bound} / {witness}");
        }
    }
}

#[test]
fn where_nothing_follows_for_edges_the_least_change_is_named_with_which_something_does() {
    let follows = |scene: &str, scalar: &str| {
        let flags = [
            "prove",
            "--kernel",
            "moller-trumbore",
            "-n",
            "0",
            "--scene",
            scene,
        ];
        let out = words(&text(&[&flags[..], &["--scalar", scalar]].concat()));
        let (_, nothing) = out
            .split_once("Nothing useful follows for false misses")
            .unzip();
        nothing.map(str::to_owned)
    };
    let nothing = follows("room", "f32").unwrap();
    let (_, scenes) = nothing
        .split_once("It is proved to be less in f64, or with edges from ")
        .unwrap();
    let edge: f64 = scenes
        .split(' ')
        .next()
        .unwrap()
        .trim_end_matches('.')
        .parse()
        .unwrap();
    // As the prover says of these; half of the change is not enough.
    let room = |edge: f64| format!("room,edge={edge}..3");
    assert_eq!(follows(&room(edge), "f32"), None);
    assert!(follows(&room(edge / 2.0), "f32").is_some());
    assert_eq!(follows("room", "f64"), None);
}

#[test]
fn a_scene_has_the_words_that_it_has_for_samples() {
    let kernel = [
        "prove",
        "--kernel",
        "moller-trumbore",
        "--scalar",
        "f32",
        "-n",
        "100",
    ];
    let with = |scene: &[&str]| text(&[&kernel[..], scene].concat());
    let numbers = [
        "--coordinates",
        "15",
        "--edge",
        "0.01..3",
        "--distance",
        "13",
    ];
    // A scene for samples says the longest edge of its triangles; of equilateral ones every edge is.
    let room = words(&with(&["--scene", "room", "--min-angle", "60deg"]));
    let all = words(&with(&[&numbers[..], &["--min-angle", "60deg"]].concat()));
    let without_next = |text: &str| text.rsplit_once(" next: ").unwrap().0.to_owned();
    let room = room.replacen("each triangle's longest edge", "every edge", 1);
    assert_eq!(without_next(&room), without_next(&all));
    // Flatter triangles have shorter edges than that, and smaller areas.
    let divisor = |scene: &[&str]| {
        let text = words(&with(scene));
        let (_, number) = text.split_once("|N·d| at least ").unwrap();
        number.split(',').next().unwrap().parse::<f64>().unwrap()
    };
    let mends = "hairline repair --kernel moller-trumbore --scene room --scalar f32";
    assert!(words(&with(&["--scene", "room"])).contains(mends));
    let [longest, all] = [divisor(&["--scene", "room"]), divisor(&numbers)];
    assert!((3.9..4.1).contains(&(all / longest)), "{longest} {all}");
    let far = with(&[
        "--scene",
        "extent=5,center=-1e3,edge=0.01..3,distance=0..10",
    ]);
    assert!(
        words(&far).contains("1015, each triangle's longest edge from 0.01 to 3"),
        "{far}"
    );
    let wrong = |scene: &str, message: &str| {
        refused(&[&kernel[..], &["--scene", scene]].concat(), 2, message);
    };
    wrong("rom", "--scene: 'rom' is no scene");
    wrong(
        "room,direction=target",
        "--scene: proofs suppose |d| <= 1: write direction=unit",
    );
}

#[test]
fn of_an_epsilon_of_ones_own_it_is_said_what_is_proved() {
    let kernel = [
        "prove",
        "--kernel",
        "moller-trumbore",
        "--scalar",
        "f32",
        "-n",
        "0",
    ];
    let words = |epsilon: &str| {
        let out = text(&[&kernel[..], &["--epsilon", epsilon]].concat());
        out.split_whitespace().collect::<Vec<_>>().join(" ")
    };
    // The bounds are 1.014e-6 of the determinant and 3.94e-6 of u and v.
    let out = words("parallel=1e-7,edge=-1e-5");
    assert!(
        out.contains("e = 1e-7 is proved to refuse every parallel ray where coordinates of edges")
    );
    assert!(!out.contains("(jolt)"), "{out}");
    let all = "No false miss at an edge. No false hit is farther outside an edge than 1.40e-5 of the triangle";
    assert!(out.contains(all), "{out}");
    let out = words("edge=1e-5");
    let none =
        "No false miss is farther inside an edge than 1.40e-5 of the triangle's longest edge";
    assert!(
        out.contains(none) && out.contains("No false hit at an edge."),
        "{out}"
    );
    let out = words("edge=2e-6");
    let both = [
        "inside an edge than 5.94e-6 of",
        "outside an edge than 1.94e-6 of",
    ];
    assert!(both.iter().all(|part| out.contains(part)), "{out}");
    let wrong = |epsilon: &str, message: &str| {
        refused(&[&kernel[..], &["--epsilon", epsilon]].concat(), 2, message);
    };
    wrong("paralel=1", "no selected kernel has a gate 'paralel'");
    wrong("parallel", "--epsilon: 'parallel' is not GATE=VALUE");
    wrong("parallel=x", "");
    // In f32 every number is below the one, and the other is 0.
    wrong(
        "edge=1e39",
        "gate 'edge' of moller-trumbore: 1e39 is beyond the range of f32 (see --scalar)",
    );
    wrong(
        "parallel=1e-50",
        "gate 'parallel' of moller-trumbore: 1e-50 is 0 in f32 (see --scalar)",
    );
    let two = ["prove", "--kernel", "cramer,plucker", "--epsilon", "edge=0"];
    refused(&two, 2, "--epsilon is of one --kernel");
    // What is proved whatever the size of triangles is said in any scene.
    let room = [
        "prove",
        "--kernel",
        "scalar-triple",
        "--scalar",
        "f32",
        "--scene",
        "room",
        "-n",
        "0",
    ];
    let out = text(&[&room[..], &["--epsilon", "edge=-1e-3"]].concat());
    assert!(
        crate::prove::words(&out).contains("No false miss at an edge."),
        "{out}"
    );
}

#[test]
fn certificates_are_checked_and_a_changed_number_is_refused() {
    let folder = scratch("prove");
    let file = folder.join("a.proof");
    let file = file.to_str().unwrap();
    let kernel = ["--kernel", "moller-trumbore-culling", "--scalar", "f32"];
    text(&[&["prove"], &kernel[..], &["--certificate", file]].concat());
    let proved = format!(
        "{file}: 5 bounds proved of moller-trumbore-culling f32: what it compares is wrong by at most edge 3.64e-6, \
         parallel 1.02e-6 (all that the kernel compares, on 3 paths recorded again: 5 programs)\n  \
         for every float with coordinates of edges up to 9.990e-1, of vertices from the origin of the ray up to \
         9.990e-1, of points up to 9.990e-1, of directions up to 1, t_min and t_max up to 1.000e0, divisors at least \
         5.000e-1 (the direction's largest coordinate 0.5), quotients at most 1.000e0\n"
    );
    assert_eq!(text(&["prove", "--check", file]), proved);
    let good = fs::read_to_string(file).unwrap();
    // The same proofs under another name, and one of them less.
    let renamed = |name: &str| {
        fs::write(file, good.replacen("moller-trumbore-culling", name, 1)).unwrap();
    };
    renamed("cramer");
    let message = ": the proof is right, but cramer has no such program here";
    refused(&["prove", "--check", file], 1, message);
    renamed("mine");
    assert!(
        text(&["prove", "--check", file])
            .contains("(no kernel of that name is here to compare)\n  for every float with")
    );
    let last = good.rfind("\nprogram\n").unwrap();
    fs::write(file, &good[..=last]).unwrap();
    assert!(text(&["prove", "--check", file]).contains("(without all of edge)\n  for every"));
    let line = good
        .lines()
        .position(|line| line.starts_with("first "))
        .unwrap();
    let first = good.lines().nth(line).unwrap();
    let mantissa: i64 = first["first ".len()..]
        .split('*')
        .next()
        .unwrap()
        .parse()
        .unwrap();
    let smaller = first.replacen(&mantissa.to_string(), &(mantissa - 2).to_string(), 1);
    fs::write(file, good.replacen(first, &smaller, 1)).unwrap();
    refused(
        &["prove", "--check", file],
        65,
        &format!("{file}:{}: ", line + 1),
    );
    refused(&["prove", "--check", "/dev/null"], 65, "/dev/null:");
    refused(&["prove", "--check", "no-such-file"], 74, "no-such-file");
    let two = ["prove", "--kernel", "cramer,plucker", "--certificate", file];
    refused(&two, 2, "--certificate is of one --kernel in one --scalar");
}

/// What a certificate says of a program holds where its decisions are made. So it states no decision that a front hit
/// does not make, and the names under which it holds too.
#[test]
fn certificates_claim_what_the_paths_of_hits_compute_and_name_their_mirror_images() {
    let file = scratch("prove-names").join("a.proof");
    let file = file.to_str().unwrap();
    let certificate = |kernel: &str| {
        let output = hairline(&[
            "prove",
            "-k",
            kernel,
            "--scalar",
            "f32",
            "--certificate",
            file,
        ]);
        let said = String::from_utf8(output.stderr).unwrap();
        assert!(
            output.status.success() && output.stdout.is_empty(),
            "{said}"
        );
        (fs::read_to_string(file).unwrap(), said)
    };
    let (proof, said) = certificate("moller-trumbore");
    let check = format!("check it: hairline prove --check {file}\n");
    assert_eq!(
        said,
        format!("{file}: 5 bounds of what moller-trumbore compares; {check}")
    );
    let is_decision =
        |line: &&str| ["decision", "order"].contains(&line.split(' ').next().unwrap());
    assert_eq!(proof.lines().filter(is_decision).count(), 0);
    let quiet = [
        "prove",
        "-k",
        "plucker",
        "--scalar",
        "f32",
        "-q",
        "--certificate",
        file,
    ];
    assert!(hairline(&quiet).stderr.is_empty());
    // Woop's depends on the largest coordinate of the direction, and on nothing else.
    let (proof, _) = certificate("woop-watertight");
    let orders: std::collections::BTreeSet<&str> = proof.lines().filter(is_decision).collect();
    assert_eq!(Vec::from_iter(orders), ["order 4 3", "order 5 3"]);
    let checked = |proof: &str| {
        fs::write(file, proof).unwrap();
        text(&["prove", "--check", file])
    };
    let out = checked(&proof);
    let all = "signs of every edge (all that the kernel compares, on 1,728 paths recorded again: 16 programs, and \
               104 more under other names of axes and vertices)";
    assert!(out.contains(all), "{out}");
    // Without one of the names some paths are missing; a certificate of a mirror image alone is one of the kernel.
    let without = checked(&proof.replacen("also yzx abc\n", "", 1));
    assert!(without.contains("(without all of edge)"), "{without}");
    let program = proof.split_inclusive("end\n").next().unwrap();
    let also = program.lines().filter(|line| line.starts_with("also "));
    let one = also.clone().fold(program.to_owned(), |text, line| {
        text.replace(&format!("{line}\n"), "")
    });
    assert!(checked(&one).contains("1 bound proved of woop-watertight f32"));
    // y in place of x, z of y, x of z: every input, variable and order.
    let axis = |i: usize| (i + 1) % 3;
    let renamed = one.lines().map(|line| {
        let words: Vec<&str> = line.split(' ').collect();
        let number = |word: &str| word.parse::<usize>().unwrap();
        let input = |word: &str| 3 * (number(word) / 3) + axis(number(word) % 3);
        match words[..] {
            ["op", op, "input", i] if number(i) < 15 => format!("op {op} input {}\n", input(i)),
            ["order", a, b] => format!("order {} {}\n", input(a), input(b)),
            ["variable", "direction", i] => format!("variable direction {}\n", axis(number(i))),
            ["variable", "difference", p, q, i] => {
                format!("variable difference {p} {q} {}\n", axis(number(i)))
            }
            _ => format!("{line}\n"),
        }
    });
    let image: String = renamed.collect();
    assert_ne!(image, one);
    assert!(checked(&image).contains("1 bound proved of woop-watertight f32"));
    // Names of a program that no gate compares: scalar-triple's third edge under those of others.
    let (proof, _) = certificate("scalar-triple-two-sided");
    let more = proof.replacen("\nlemma ", "\nalso yxz abc\nlemma ", 1);
    fs::write(file, more).unwrap();
    let message =
        "a.proof:5: the proof is right, but scalar-triple-two-sided has no such program here";
    refused(&["prove", "--check", file], 1, message);
}

#[test]
fn a_certificate_of_a_scene_has_its_limits_of_divisors_and_quotients() {
    let folder = scratch("scene-certificate");
    let file = folder.join("scene.proof");
    let kernel = ["--kernel", "plane-unit-normal", "--scalar", "f64"];
    let scene = ["--coordinates", "4", "--edge", "0.5..4", "--distance", "8"];
    text(
        &[
            &["prove"],
            &kernel[..],
            &scene,
            &["--certificate", file.to_str().unwrap()],
        ]
        .concat(),
    );
    let proof = fs::read_to_string(&file).unwrap();
    // Each size of triangles has a domain of its own.
    let lines = |word: &str| proof.lines().filter(|line| line.starts_with(word)).count();
    assert!(
        lines("domain ") > 5 && lines("at-least ") > 10 && lines("at-most ") > 10,
        "{proof}"
    );
    let shown = text(&[&["prove", "-n", "0"], &kernel[..], &scene].concat());
    let out = text(&["prove", "--check", file.to_str().unwrap()]);
    // The largest bound of a gate is that of the scene.
    let (_, parallel) = out.split_once("parallel ").unwrap();
    let (digits, exponent) = parallel.split(',').next().unwrap().split_once('e').unwrap();
    let above = (digits.parse::<f64>().unwrap() * 100.0).ceil() / 100.0;
    let bound = format!("never wrong by more than {above:.2}e{exponent} (");
    assert!(words(&shown).contains(&bound), "{out} {shown}");
    // Each size of triangles has a line, and what divides supposes something there.
    let domains = proof.lines().filter(|line| line.starts_with("domain "));
    let sizes = domains.collect::<std::collections::BTreeSet<_>>().len();
    assert_eq!(out.lines().count(), 1 + sizes, "{out}");
    assert_eq!(out.matches(", divisors at least ").count(), sizes, "{out}");
    assert!(!out.contains("missing"), "{out}");
    let (start, last) = proof.rsplit_once("\ndomain ").unwrap();
    assert!(last.contains("\nat-least "), "{last}");
    fs::write(&file, format!("{start}\n")).unwrap();
    let out = text(&["prove", "--check", file.to_str().unwrap()]);
    assert_eq!(
        out.matches("; programs of other sizes are missing here\n")
            .count(),
        1,
        "{out}"
    );
    assert!(out.ends_with("missing here\n"), "{out}");
    // The same limits are in the record, of the size whose bound is largest.
    let record = result(&hairline(
        &[
            &["prove", "-n", "0", "--format", "json"],
            &kernel[..],
            &scene,
        ]
        .concat(),
    ));
    let gates = record["gates"].as_array().unwrap();
    let limits = |gate: &str| {
        let gate = gates.iter().find(|part| part["gate"] == gate).unwrap();
        gate["limits"].as_array().unwrap().clone()
    };
    let [divisor] = &limits("parallel")[..] else {
        panic!("{gates:?}")
    };
    assert!(
        divisor["number"] == "|N|" && divisor.get("at_most").is_none(),
        "{divisor}"
    );
    let least = divisor["at_least"].as_f64().unwrap();
    assert!(
        words(&shown).contains(&format!("|N| at least {least:.2e}")),
        "{least} {shown}"
    );
    assert!(
        limits("t")
            .iter()
            .any(|limit| limit["number"] == "|t|" && limit["at_most"] == 8.015625)
    );
    // Less is supposed of one divisor: then the numbers after it are wrong.
    let line = proof
        .lines()
        .find(|line| line.starts_with("at-least "))
        .unwrap();
    let (start, exponent) = line.split_once("*2^-").unwrap();
    let less = format!("{start}*2^-{}", exponent.parse::<i32>().unwrap() + 1);
    fs::write(&file, proof.replacen(line, &less, 1)).unwrap();
    refused(
        &["prove", "--check", file.to_str().unwrap()],
        65,
        "expected",
    );
    let twice = format!("{line}\n{line}");
    fs::write(&file, proof.replacen(line, &twice, 1)).unwrap();
    refused(
        &["prove", "--check", file.to_str().unwrap()],
        65,
        "at-least OPERATION X, once for an operation",
    );
    fs::write(&file, proof.replacen(line, "at-least 9999 1", 1)).unwrap();
    refused(
        &["prove", "--check", file.to_str().unwrap()],
        65,
        "at-least OPERATION X, once for an operation",
    );
}

#[test]
fn stored_certificates_are_those_of_the_kernels() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/corpora/proofs");
    let mut files: Vec<String> = fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().path().to_str().unwrap().to_owned())
        .filter(|path| path.ends_with(".proof"))
        .collect();
    files.sort();
    assert_eq!(
        files.len(),
        68,
        "17 kernels, two scalars, with and without fused products"
    );
    let names: Vec<&str> = files.iter().map(String::as_str).collect();
    let out = text(&[&["prove", "--check"], &names[..]].concat());
    assert_eq!(out.matches(" proved of ").count(), files.len());
    assert_eq!(
        out.matches("\n  for every float with ").count(),
        files.len()
    );
    // Some of every kind are written again.
    let again = scratch("prove-again").join("a.proof");
    let again = again.to_str().unwrap();
    for (kernel, scalar) in [
        ("woop-watertight", "f64"),
        ("woop-watertight+fma", "f32"),
        ("plane-unit-normal", "f32"),
        ("baldwin-weber", "f64"),
        ("cramer+fma", "f64"),
        ("moller-trumbore", "f32"),
        ("plucker", "f32"),
    ] {
        text(&[
            "prove",
            "--kernel",
            kernel,
            "--scalar",
            scalar,
            "--certificate",
            again,
        ]);
        let stored = fs::read_to_string(format!("{folder}/{kernel}-{scalar}.proof")).unwrap();
        assert!(
            fs::read_to_string(again).unwrap() == stored,
            "{kernel} {scalar}"
        );
    }
}

/// Subnormal numbers that are zero have errors of their own.
#[test]
fn what_flushes_subnormal_numbers_has_no_proof() {
    let output = hairline(&["prove", "--kernel", "plucker+ftz"]);
    let error = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(4), "{error}");
    assert!(
        error.contains("no proof: its arithmetic flushes subnormal numbers to zero"),
        "{error}"
    );
}

#[test]
fn a_scene_gives_its_own_bounds_and_a_bad_one_a_sentence() {
    let scene = [
        "--coordinates",
        "1000",
        "--edge",
        "0.01..10",
        "--distance",
        "2000",
    ];
    let kernel = [
        "prove",
        "--kernel",
        "moller-trumbore",
        "--scalar",
        "f32",
        "-n",
        "1000",
    ];
    let out = text(&[&kernel[..], &scene[..]].concat());
    assert!(out.contains("Scene: coordinates up to 1000"), "{out}");
    assert!(
        words(&out).contains("for no angle is it proved that every hit is kept"),
        "{out}"
    );
    // In f64 the same gate costs little.
    let out = text(
        &[
            &[
                "prove",
                "--kernel",
                "moller-trumbore",
                "--scalar",
                "f64",
                "-n",
                "1000",
            ],
            &scene[..],
        ]
        .concat(),
    );
    assert!(
        words(&out).contains("that epsilon refuses every parallel ray; it keeps every hit at"),
        "{out}"
    );
    // What divides has a bound too, and what it supposes.
    let divides = [
        "prove",
        "--kernel",
        "baldwin-weber",
        "--scalar",
        "f64",
        "-n",
        "0",
    ];
    let out = text(&[&divides[..], &scene[..]].concat());
    assert!(!out.contains("No bound"), "{out}");
    let supposed = "It supposes of the exact numbers, and more of larger triangles: |N_k| at least 1.99e-6, \
                    |N·d/N_k| at least 0.0174,";
    assert!(words(&out).contains(supposed), "{out}");
    let bad = |coordinates: &str, edge: &str, message: &str| {
        let scene = ["prove", "--coordinates", coordinates, "--edge", edge];
        refused(&scene, 2, message);
    };
    bad(
        "1",
        "2..1",
        "the shortest edge, 2, is longer than the longest, 1",
    );
    bad(
        "1",
        "0..1",
        "shortest edge: expected a positive number, found 0",
    );
    bad(
        "nan",
        "0.1..1",
        "coordinates: expected a positive number, found NaN",
    );
    bad("1", "1..10", "does not fit into coordinates up to 1");
    refused(&["prove", "--distance", "5"], 2, "--distance needs");
    refused(
        &["prove", "--edge", "1..2"],
        2,
        "--edge needs --coordinates",
    );
    refused(
        &["prove", "--kernel", "moller"],
        2,
        "unknown kernel 'moller'",
    );
    let empty = scratch("prove-mesh").join("empty.obj");
    fs::write(&empty, "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n").unwrap();
    let empty = empty.to_str().unwrap();
    refused(
        &["prove", "--mesh", empty, "--distance", "1", "--quiet"],
        65,
        "no triangle with an area",
    );
}

#[test]
fn a_meshs_triangles_have_bounds_of_their_own() {
    let mesh = concat!(env!("CARGO_MANIFEST_DIR"), "/corpora/meshes/icosphere.obj");
    let out = text(&[
        "prove",
        "--kernel",
        "moller-trumbore",
        "--scalar",
        "f32",
        "--mesh",
        mesh,
        "--distance",
        "10",
        "-n",
        "100",
        "--quiet",
    ]);
    let all = words(&out);
    assert!(
        all.contains("e = 1e-6 (source, truck) refuses every parallel ray; it keeps every hit at"),
        "{out}"
    );
    assert!(
        all.contains("e = 1e-12 (jolt) is not proved to refuse parallel rays"),
        "{out}"
    );
    // A triangle without an area is not hit, and still lets parallel rays pass.
    let folder = scratch("prove-areas");
    let larger = folder.join("larger.obj");
    let triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    fs::write(
        &larger,
        format!("{triangle}v 50 60 70\nv 100 120 140\nf 1 4 5\n"),
    )
    .unwrap();
    let larger = larger.to_str().unwrap();
    let arguments = [
        "--mesh",
        larger,
        "--distance",
        "200",
        "-n",
        "100",
        "--quiet",
    ];
    let kernel = ["prove", "--kernel", "moller-trumbore", "--scalar", "f32"];
    let out = text(&[&kernel[..], &arguments[..]].concat());
    assert!(
        words(&out).contains(
            "e = 1e-5 (godot, three-mesh-bvh) is proved to refuse the parallel rays of 1 of 2 triangles only"
        ),
        "{out}"
    );
}

#[test]
fn check_holds_what_is_proved() {
    let folder = scratch("prove-check");
    let config = folder.join("hairline.toml");
    let config = config.to_str().unwrap();
    let check = |demands: &str| {
        let plan =
            "kernel = \"woop-watertight\"\nfamily = \"interior\"\nscalar = \"f32\"\ncount = 10\n";
        fs::write(config, format!("{plan}{demands}")).unwrap();
        hairline(&["check", "--config", config, "--quiet"])
    };
    let good = "[proved]\nwoop-watertight.f32 = { edge = 21.99, watertight = true }\n";
    let output = check(good);
    assert!(
        output.status.success(),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
    let output = check(
        "[proved]\n\"woop-watertight+fma\".f32.watertight = true\nwoop-watertight.f32.edge = 21.5\n",
    );
    let text = words(&String::from_utf8_lossy(&output.stdout));
    assert_eq!(output.status.code(), Some(1), "{text}");
    assert!(
        text.starts_with("Worse: 2 proofs are missing that must hold "),
        "{text}"
    );
    let not_watertight = "woop-watertight+fma f32 must be proved watertight: no longer proved";
    let bound = "woop-watertight f32 edge must be proved to at most 21.5 u: the bound is 21.97";
    // Every format says it.
    let formats = ["text", "json", "junit", "sarif", "markdown", "html"];
    let files: Vec<String> = formats
        .map(|format| folder.join(format).to_str().unwrap().to_owned())
        .into();
    let mut words = vec!["check", "--config", config, "-q", "--format"];
    let all = formats.join(",");
    words.push(&all);
    words.extend(files.iter().flat_map(|file| ["-o", file.as_str()]));
    assert_eq!(hairline(&words).status.code(), Some(1));
    for file in &files {
        let text = fs::read_to_string(file).unwrap();
        let is_data = file.ends_with("json");
        let [one, other] = match is_data {
            true => ["\"gate\":\"watertight\"", "\"demanded\":\"21.5\""],
            false => [not_watertight, bound],
        };
        let text = if is_data {
            text.replace(": \"", ":\"")
        } else {
            text
        };
        assert!(text.contains(one) && text.contains(other), "{file}: {text}");
    }
    for (demands, message) in [
        ("[proved]\nwoop.f32.edge = 1\n", "unknown kernel 'woop'"),
        (
            "[proved]\nwoop-watertight.f32.edges = 1\n",
            "unknown gate 'edges'",
        ),
        ("[proved]\nwoop-watertight.f16.edge = 1\n", "is no demand"),
        (
            "[proved]\nwoop-watertight = 1\n",
            "hairline.toml:5: proved: expected KERNEL.SCALAR.GATE = UNITS",
        ),
    ] {
        let output = check(demands);
        let error = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{error}");
        assert!(error.contains(message), "{error}");
    }
}

/// A number in three digits, not below it, or not above it.
fn three_digits(x: f64, up: bool) -> String {
    let scale = 10f64.powi(2 - x.log10().floor() as i32);
    let digits = if up {
        (x * scale - 1e-9).ceil()
    } else {
        (x * scale + 1e-9).floor()
    };
    format!("{:.2e}", digits / scale)
}

/// A number in two decimals, not below it, or not above it.
fn hundredths(x: f64, up: bool) -> String {
    let hundreds = if up {
        (x * 100.0 - 1e-9).ceil()
    } else {
        (x * 100.0 + 1e-9).floor()
    };
    format!("{:.2}", hundreds / 100.0)
}

#[test]
fn the_guides_table_is_what_is_proved_and_known() {
    let record = everything();
    let gates = record["gates"].as_array().unwrap();
    let cells = |gate: &serde_json::Value| match gate["bound_units"].as_f64() {
        None => "none | | |".to_owned(),
        Some(bound) => {
            let witness = gate["witness"]["units"].as_f64().unwrap();
            let factor = gate["factor"].as_f64().unwrap();
            format!(
                "{} | {} | {factor:.2} |",
                hundredths(bound, true),
                hundredths(witness, false)
            )
        }
    };
    let mut table = String::new();
    for single in gates.iter().filter(|gate| gate["scalar"] == "f32") {
        let is_double = |gate: &&serde_json::Value| {
            gate["scalar"] == "f64"
                && ["kernel", "gate"]
                    .iter()
                    .all(|key| gate[key] == single[key])
        };
        let double = gates.iter().find(is_double).unwrap();
        let supposes: Vec<&str> = single["supposes"]
            .as_array()
            .unwrap()
            .iter()
            .map(|x| x.as_str().unwrap())
            .collect();
        let [kernel, gate] = ["kernel", "gate"].map(|key| single[key].as_str().unwrap());
        let (single, double) = (cells(single), cells(double));
        let end = format!("{} |", supposes.join(", "));
        table += &format!(
            "| {kernel} | {gate} | {single} {double} {}\n",
            end.trim_start()
        );
    }
    let guide = concat!(env!("CARGO_MANIFEST_DIR"), "/docs/guide/proof.md");
    let guide = fs::read_to_string(guide).unwrap();
    assert!(
        guide.contains(&table),
        "the table of docs/guide/proof.md should be\n{table}"
    );
    // And the table of verdicts.
    let kernels = record["kernels"].as_array().unwrap();
    let mut table = String::new();
    for single in kernels.iter().filter(|kernel| kernel["scalar"] == "f32") {
        table += &format!("| {} |", single["kernel"].as_str().unwrap());
        for scalar in ["f32", "f64"] {
            let is_same = |it: &&serde_json::Value| {
                it["scalar"] == scalar && it["kernel"] == single["kernel"]
            };
            let kernel = kernels.iter().find(is_same).unwrap();
            for side in ["misses", "hits"] {
                let part = &kernel["verdicts"][side];
                let number = |part: &serde_json::Value, up: bool| {
                    part.as_f64()
                        .map_or("-".to_owned(), |x| three_digits(x, up))
                };
                let factor = part["factor"]
                    .as_f64()
                    .map_or("-".to_owned(), |x| format!("{x:.1}"));
                table += &format!(
                    " {} | {} | {factor} |",
                    number(&part["share"], true),
                    number(&part["known"]["share"], false)
                );
            }
        }
        table += "\n";
    }
    assert!(
        guide.contains(&table),
        "the table of verdicts of docs/guide/proof.md should be\n{table}"
    );
}

/// The table of the theorem: what an edge's number is a multiple of, and which other gates may be wrong.
#[test]
fn the_guides_theorem_supposes_what_the_prover_does() {
    let guide = concat!(env!("CARGO_MANIFEST_DIR"), "/docs/guide/proof.md");
    let guide = fs::read_to_string(guide).unwrap();
    for kernel in everything()["kernels"].as_array().unwrap() {
        let verdicts = &kernel["verdicts"];
        let Some(scale) = verdicts["scales"].get(0) else {
            assert_eq!(kernel["kernel"], "havel-herout");
            continue;
        };
        let number = scale["number"].as_str().unwrap().replace('|', "\\|");
        let least = scale["at_least"].as_f64().unwrap();
        let least = [("1/12", 1.0 / 12.0), ("1/2", 0.5), ("1", 1.0)]
            .into_iter()
            .find(|(_, value)| (value - least).abs() < 1e-6)
            .map(|(text, _)| text);
        let others = verdicts["others"].as_array().unwrap().iter();
        let others: Vec<&str> = others
            .filter(|other| !other["may"].as_str().unwrap().starts_with("never"))
            .map(|other| other["gate"].as_str().unwrap())
            .collect();
        let others = match others.is_empty() {
            true => "none".to_owned(),
            false => others.join(", "),
        };
        let name = kernel["kernel"].as_str().unwrap();
        let row = format!("| {name} | {number} | {} | {others} |\n", least.unwrap());
        assert!(guide.contains(&row), "{row}");
    }
}

#[test]
fn the_worst_known_in_a_scene_is_as_bad_as_a_sample_finds() {
    let flags = [
        "prove",
        "--kernel",
        "moller-trumbore",
        "--scalar",
        "f32",
        "--format",
        "json",
    ];
    let record = result(&hairline(&[&flags[..], &["--scene", "room"]].concat()));
    let gates = record["gates"].as_array().unwrap();
    let edge = gates.iter().find(|gate| gate["gate"] == "edge").unwrap();
    // Three seconds of drawing plain rays in such a room found a v that is wrong by 0.424.
    let known = edge["witness"]["units"].as_f64().unwrap() * 2f64.powi(-24);
    let bound = edge["bound_units"].as_f64().unwrap() * 2f64.powi(-24);
    assert!((0.424..bound).contains(&known), "{known} of {bound}");
}
