//! What `hairline epsilon` says of a scene beside its numbers: how flat rays are, when no line is good, what a kernel
//! lacks, and its curves and pictures.

use crate::json_schema;
use crate::program::{ends, flat, scratch};
use hairline::internals::report::epsilon::{CurvePart, SceneResult};
use std::fs;
use std::path::Path;

fn output(folder: &Path, kernel: &str, scene: &str, more: &[&str]) -> String {
    let all = [
        "epsilon", "--kernel", kernel, "--scene", scene, "--scalar", "f32", "-q",
    ];
    let count: &[&str] = if more.contains(&"-n") {
        &[]
    } else {
        &["-n", "4000"]
    };
    ends(folder, &[&all[..], count, more].concat(), 0).0
}

/// Everything that is said, in one line.
fn study(folder: &Path, kernel: &str, scene: &str, more: &[&str]) -> String {
    flat(&output(
        folder,
        kernel,
        scene,
        &[&["--details"], more].concat(),
    ))
}

/// The command of a screen that runs a study's numbers again, without the program's name.
fn next(screen: &str, command: &str) -> String {
    let mut lines = screen
        .lines()
        .map(|line| line.trim_start_matches("next:").trim());
    let line = lines.find_map(|line| line.strip_prefix(&format!("hairline {command} ")));
    let line = line.unwrap_or_else(|| panic!("{screen}"));
    format!("{command} {}", line.split("  # ").next().unwrap())
}

fn record(folder: &Path, kernel: &str, scene: &str, more: &[&str]) -> SceneResult {
    let text = output(
        folder,
        kernel,
        scene,
        &[&["--format", "json"], more].concat(),
    );
    json_schema::result(&text)
}

#[test]
fn a_scene_says_how_flat_its_rays_are() {
    let folder = scratch("advice-sine");
    let lost = |sine: &str| {
        let record = record(
            &folder,
            "moller-trumbore",
            &format!("edge=1,sine={sine}"),
            &[],
        );
        let part = &record.kernels[0];
        let is_lost = |i: &usize| {
            let count = &part.counts[*i];
            count.rays.name() == "scene-grazing" && count.kind.name() == "miss"
        };
        let place = (0..part.counts.len()).find(is_lost).unwrap();
        let published = part
            .tried
            .iter()
            .find(|tried| tried.name == "source")
            .unwrap();
        published.wrong[place].rate.unwrap()
    };
    // The published 1e-6 refuses all rays of a smaller sine, and few of a larger one.
    assert!(lost("1e-8..1e-7") == 1.0 && lost("1e-4..1e-2") < 0.02);
    let screen = study(&folder, "moller-trumbore", "edge=1,sine=1e-8..1e-7", &[]);
    assert!(
        screen.contains("almost parallel: angles whose sines go from 1e-8 to 1e-7"),
        "{screen}"
    );
    let id = "scene-grazing@2/f32/extent=1,edge=1,distance=0..4,direction=unit,sine=1e-8..1e-7/1/7";
    ends(&folder, &["explain", id, "--kernel", "cramer"], 0);
}

#[test]
fn rays_aimed_inside_show_the_false_hits_of_rounding_alone() {
    let folder = scratch("advice-aim");
    // Those of 1e-8 to 1 that miss were turned aside by rounding, so the kernel is often wrong about them.
    let scene = "edge=1,distance=0..6,sine=1e-8..1,aim=inside";
    let more = [
        "--gate",
        "parallel",
        "--at",
        "1e-12,1.1920929e-7",
        "-n",
        "20000",
    ];
    let record = record(&folder, "moller-trumbore", scene, &more);
    let part = &record.kernels[0];
    let is_false_hit = |i: &usize| {
        part.counts[*i].rays.name() == "scene-grazing" && part.counts[*i].kind.name() == "hit"
    };
    let place = (0..part.counts.len()).find(is_false_hit).unwrap();
    let share = |name: &str| {
        let tried = part.tried.iter().find(|tried| tried.name == name).unwrap();
        tried.wrong[place].rate.unwrap()
    };
    // The published value is 1e-6.
    let shares = ["zero", "1e-12", "1.1920929e-7", "source"].map(share);
    for (share, near) in shares.into_iter().zip([0.21, 0.19, 0.05, 0.01]) {
        assert!((0.6 * near..1.5 * near).contains(&share), "{shares:?}");
    }
    assert!(shares.is_sorted_by(|a, b| a > b));
}

#[test]
fn where_no_line_is_good_the_screen_says_so() {
    let folder = scratch("advice-no-good");
    let far = study(&folder, "moller-trumbore", "room,distance=1e7", &[]);
    assert!(
        far.contains("No numbers are good here: even these lose "),
        "{far}"
    );
    let only_t = study(&folder, "moller-trumbore", "city", &["--gate", "t_min"]);
    assert!(!only_t.contains("o numbers are good"), "{only_t}");
    let why = "oordinates reach 1e7 m, where the numbers of f32 are 1 m apart: use f64, or bring scene and rays nearer to 0";
    assert!(far.contains(why), "{far}");
    assert!(!study(&folder, "moller-trumbore", "room", &[]).contains("o numbers are good"));
    let wide = [
        "epsilon",
        "--kernel",
        "moller-trumbore",
        "--scene",
        "room,distance=1e7",
        "-q",
    ];
    let wide = ends(
        &folder,
        &[&wide[..], &["--scalar", "f64", "-n", "4000"]].concat(),
        0,
    )
    .0;
    assert!(!wide.contains("o numbers are good"), "{wide}");
}

#[test]
fn what_no_scene_can_live_with_is_named_whatever_asked_for_it() {
    let folder = scratch("advice-flaws");
    let room = |more: &[&str]| study(&folder, "moller-trumbore", "room", more);
    let costs = room(&["--cost", "miss=1000"]);
    let flaw = "With these costs even the best epsilons make false hits of ";
    assert!(costs.contains(flaw), "{costs}");
    let errors = room(&["--max-error", "t=1e-3"]);
    let flaw = "With errors as small as wanted even the best epsilons lose ";
    assert!(errors.contains(flaw), "{errors}");
    // Shadow rays have a remedy of their own.
    let far = format!("{}/corpora/meshes/far.obj", env!("CARGO_MANIFEST_DIR"));
    let study_far = [
        "epsilon",
        "--kernel",
        "moller-trumbore",
        "--mesh",
        &far,
        "-q",
        "-n",
        "4000",
    ];
    let (screen, _) = ends(&folder, &study_far, 0);
    let screen = flat(&screen);
    let (_, flaw) = screen
        .split_once("No numbers are good here: even these let ")
        .unwrap();
    let shadow = "% of the shadow rays hit the triangle that they leave.";
    assert!(
        flaw.split_once(' ').unwrap().1.starts_with(&shadow[2..]),
        "{flaw}"
    );
    // An absolute number at the edges is too large for small triangles or too small for large ones.
    let plane = study(&folder, "plane-unit-normal", "cad-mm", &[]);
    assert!(plane.contains(" use parallel = "), "{plane}");
    assert!(
        plane.contains("No fixed numbers are good here: even these make false hits of "),
        "{plane}"
    );
    assert!(
        plane.contains("(edge 0.05 mm) are hit far beside them"),
        "{plane}"
    );
    // No command runs a form, and the fixed numbers are not to be used.
    assert!(!plane.contains("hairline audit"), "{plane}");
    // In f64 some values are within all limits of `parallel`, but lose more hits than they keep out.
    let woop = [
        "epsilon",
        "--kernel",
        "woop-watertight",
        "--scene",
        "cad-mm",
        "-q",
        "-n",
        "4000",
    ];
    let (screen, _) = ends(&folder, &[&woop[..], &["--scalar", "f64"]].concat(), 0);
    assert!(
        flat(&screen).contains(
            " is recommended although it is outside its limits: values within them cost more"
        ),
        "{screen}"
    );
}

#[test]
fn a_limit_that_costs_plain_hits_says_how_many() {
    let folder = scratch("advice-price");
    let screen = output(
        &folder,
        "moller-trumbore",
        "cad-mm",
        &["-n", "10000", "--details"],
    );
    // The value that is proved to refuse every parallel ray, and what it costs below it.
    let mut lines = screen
        .lines()
        .skip_while(|line| !line.contains("0: proved"));
    let line = lines.next().unwrap_or_else(|| panic!("{screen}"));
    let price = lines.next().and_then(|line| line.strip_prefix("  costs: "));
    let price = price.unwrap_or_else(|| panic!("{screen}"));
    // The kernel run at that value loses as many. What the least t refuses is lost at both, and no part of the price.
    let value = line.split_whitespace().nth(2).unwrap();
    let told = price.split('%').next().unwrap();
    let used = screen
        .lines()
        .find_map(|line| line.strip_prefix("  use  --epsilon "))
        .unwrap();
    let edge = used
        .split([',', ' '])
        .find(|word| word.starts_with("edge="))
        .unwrap();
    let epsilon = format!("parallel={value},{edge}");
    let family = "extent=500,edge=0.05..200,distance=0..1000,direction=unit";
    let audit = [
        "audit",
        "--kernel",
        "moller-trumbore",
        "--scene",
        family,
        "--scalar",
        "f32",
        "-n",
    ];
    let rest = ["10000", "--epsilon", &epsilon, "-q", "--seed", "2"];
    let (out, _) = ends(&folder, &[&audit[..], &rest[..]].concat(), 0);
    let inside = out.lines().find(|line| line.starts_with("inside")).unwrap();
    let found: f64 = inside.split_whitespace().nth(1).unwrap().parse().unwrap();
    assert!(
        (found - told.parse::<f64>().unwrap()).abs() < 0.06,
        "{line}\n{out}"
    );
    // Of three rays one loss is a large share, but shows nothing.
    let few = study(
        &folder,
        "moller-trumbore",
        "room",
        &["-n", "3", "--seed", "5"],
    );
    assert!(
        few.contains("from 3 rays") && !few.contains("o numbers are good"),
        "{few}"
    );
}

#[test]
fn holes_in_a_picture_are_told_of_a_scene_and_not_of_families_that_are_none() {
    let folder = scratch("advice-holes");
    let row = |flags: &[&str]| {
        let run = [
            "epsilon",
            "-k",
            "moller-trumbore",
            "--scalar",
            "f32",
            "-n",
            "1000",
            "-q",
        ];
        let (screen, _) = ends(&folder, &[&run[..], flags].concat(), 0);
        assert!(screen.contains("at a shared edge: cracks"), "{screen}");
        screen
            .lines()
            .find(|line| line.starts_with("of a million pixels: holes"))
            .map(str::to_owned)
    };
    for flags in [["--scene", "room"], ["--family", "scene-edges"]] {
        let holes = row(&flags).unwrap();
        // The recommended numbers close what the published ones leave open.
        let cells: Vec<&str> = holes.split_whitespace().skip(5).collect();
        assert!(
            cells[0] == "0" && cells[1].parse::<f64>().unwrap() > 0.01,
            "{holes}"
        );
    }
    assert_eq!(row(&["--family", "scene-edges,tiny"]), None);
}

#[test]
fn the_commands_that_are_named_run_and_know_what_a_gate_on_t_is_for() {
    let folder = scratch("advice-more");
    let more = next(&output(&folder, "plane-unit-normal", "room", &[]), "audit");
    assert!(
        more.ends_with(" --seed 2 -n 4000 --contract own,no-self-hit"),
        "{more}"
    );
    let words: Vec<&str> = more.split(' ').collect();
    let (out, _) = ends(&folder, &[&words[..], &["-q"]].concat(), 0);
    // The hits on the triangle that a ray starts on are what t is there to refuse.
    let starts = out.lines().find(|line| line.starts_with("ends ")).unwrap();
    let share: f64 = starts
        .split_whitespace()
        .nth(1)
        .unwrap()
        .parse()
        .unwrap_or(0.0);
    assert!(share < 1.0, "{starts}");
    // A scene is taken whole by `epsilon`.
    let audit = [
        "audit",
        "--kernel",
        "moller-trumbore",
        "--scene",
        "room",
        "--family",
    ];
    let rest = ["scene-edges", "--scalar", "f32", "-n", "400", "-q"];
    let (out, _) = ends(&folder, &[&audit[..], &rest[..]].concat(), 0);
    let mut lines = out
        .lines()
        .map(|line| line.trim_start_matches("next:").trim());
    let command = lines
        .find(|line| line.starts_with("hairline epsilon "))
        .unwrap();
    let words: Vec<&str> = command
        .split("  # ")
        .next()
        .unwrap()
        .split(' ')
        .skip(1)
        .collect();
    assert!(!words.contains(&"--family"), "{words:?}");
    ends(&folder, &[&words[..], &["-q"]].concat(), 0);
}

#[test]
fn a_mesh_is_audited_as_it_was_studied_and_its_edges_are_well_within_their_limits() {
    let folder = scratch("advice-mesh");
    let text = include_str!("../../corpora/meshes/far.obj");
    fs::write(folder.join("far away.obj"), text).unwrap();
    let words = [
        "epsilon",
        "--kernel",
        "moller-trumbore",
        "--mesh",
        "far away.obj",
        "-q",
    ];
    for seed in ["1", "2"] {
        let rest = [
            "--scalar", "f64", "-n", "4000", "--seed", seed, "--format", "json",
        ];
        let (json, _) = ends(&folder, &[&words[..], &rest[..]].concat(), 0);
        let record: SceneResult = json_schema::result(&json);
        let part = &record.kernels[0];
        let edge = part
            .knobs
            .iter()
            .position(|knob| knob.name == "edge")
            .unwrap();
        let chosen: f64 = part.tried[0].epsilons[edge].parse().unwrap();
        let limits = part.limits.iter().filter(|limit| limit.knob == edge);
        let limits: Vec<f64> = limits
            .map(|limit| limit.value.as_ref().unwrap().parse().unwrap())
            .collect();
        // Rarer rays than the pilot's, which sets the range, need more.
        assert!(
            limits.len() == 2 && limits.iter().all(|most| chosen < 3.0 * most),
            "{limits:?}"
        );
    }
    let (screen, _) = ends(
        &folder,
        &[&words[..], &["--scalar", "f64", "-n", "4000"]].concat(),
        0,
    );
    let more = next(&screen, "audit");
    let (from, to) = ("--mesh 'far away.obj' ", "--mesh far_away.obj ");
    assert!(
        more.contains(from) && more.contains(" --scene mesh,distance=0.."),
        "{more}"
    );
    fs::rename(folder.join("far away.obj"), folder.join("far_away.obj")).unwrap();
    let more = more.replace(from, to);
    let words: Vec<&str> = more.split(' ').collect();
    let (out, _) = ends(&folder, &[&words[..], &["-q"]].concat(), 0);
    assert!(
        out.contains("on 8 families,") && out.contains("no leak seen in "),
        "{out}"
    );
    // Triangles may be larger than the coordinates are.
    fs::write(
        folder.join("quad.obj"),
        "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\n",
    )
    .unwrap();
    let words = [
        "epsilon",
        "--kernel",
        "moller-trumbore",
        "--mesh",
        "quad.obj",
        "--scalar",
        "f32",
    ];
    let (screen, _) = ends(&folder, &[&words[..], &["-n", "1000", "-q"]].concat(), 0);
    let offset = next(&screen, "offset");
    assert!(offset.contains(" --mesh "), "{offset}");
    let words: Vec<&str> = offset.split(' ').collect();
    ends(&folder, &[&words[..], &["-n", "1000", "-q"]].concat(), 0);
}

#[test]
fn a_kernel_without_an_epsilon_at_its_edges_hears_what_its_cracks_cost() {
    let folder = scratch("advice-cracks");
    let screen = study(&folder, "havel-herout", "room", &[]);
    for part in [
        "of its cost of",
        "are cracks, which no number here closes: give its edge test",
        "or use a kernel that hardly leaks (plucker, woop-watertight)",
        "the kernel declares no epsilons, so the least t is all that there is to choose",
    ] {
        assert!(screen.contains(part), "{part}: {screen}");
    }
    for kernel in ["moller-trumbore", "woop-watertight"] {
        let screen = study(&folder, kernel, "room", &[]);
        assert!(!screen.contains("no number here closes") && !screen.contains("has no epsilons"));
    }
    // Where a self-hit costs nothing no least t is the best, in words.
    let free = study(&folder, "havel-herout", "room", &["--cost", "self-hit=0"]);
    assert!(
        free.contains("use no least t: t_min = 0 costs least"),
        "{free}"
    );
}

#[test]
fn a_subnormal_limit_says_that_machines_may_flush_it() {
    let folder = scratch("advice-subnormal");
    let tiny = "extent=1e-9,edge=1e-10..1e-9,distance=0..1e-9";
    let screen = study(&folder, "half-space", tiny, &[]);
    let said = "is a subnormal number, which machines that flush to zero take for 0";
    assert!(screen.contains(said), "{screen}");
    assert!(!study(&folder, "half-space", "room", &[]).contains(said));
}

/// Whether every point of the first curve is one of the second.
fn is_within(few: &CurvePart, many: &CurvePart) -> bool {
    few.values.iter().enumerate().all(|(i, value)| {
        let place = many.values.iter().position(|other| other == value);
        place.is_some_and(|place| {
            few.counts
                .iter()
                .zip(&many.counts)
                .all(|(a, b)| a.hits[i] == b.hits[place])
        })
    })
}

#[test]
fn curves_are_as_full_as_is_asked() {
    let folder = scratch("advice-curves");
    let few = record(&folder, "moller-trumbore", "room", &[]);
    let many = record(&folder, "moller-trumbore", "room", &["--curves"]);
    for (few, many) in few.kernels[0].curves.iter().zip(&many.kernels[0].curves) {
        assert!(10 * few.values.len() < many.values.len() && is_within(few, many));
    }
}

#[test]
fn a_picture_says_what_its_band_and_its_shading_are() {
    let folder = scratch("advice-picture");
    for format in ["svg", "html"] {
        let file = format!("room.{format}");
        output(
            &folder,
            "moller-trumbore",
            "room",
            &["--format", format, "-o", &file],
        );
        let text = fs::read_to_string(folder.join(file)).unwrap();
        let panels = text
            .matches("around a line: its 95 % interval (Clopper and Pearson)")
            .count();
        assert!(3 <= panels, "{format}: {panels}");
        assert!(
            text.contains("below its limits, 95 % sure of each; none from below"),
            "{format}"
        );
        assert!(text.contains("class=\"within open\""), "{format}");
    }
}

#[test]
fn where_its_limits_meet_a_number_is_well_inside_them_under_every_seed() {
    let folder = scratch("advice-middle");
    let kernels = [("moller-trumbore", "room"), ("woop-watertight", "cad-mm")];
    for (kernel, scene) in kernels {
        for seed in ["1", "4", "6"] {
            let more = [
                "--scalar", "f64", "-n", "2500", "--seed", seed, "--format", "json", "-q",
            ];
            let study = ["epsilon", "--kernel", kernel, "--scene", scene];
            let (out, _) = ends(&folder, &[&study[..], &more[..]].concat(), 0);
            let record: SceneResult = json_schema::result(&out);
            let part = &record.kernels[0];
            let t = part
                .knobs
                .iter()
                .position(|knob| knob.name == "t_min")
                .unwrap();
            let number = |text: &String| text.parse::<f64>().unwrap();
            let used = number(&part.tried[0].epsilons[t]);
            let of_t = part.limits.iter().filter(|limit| limit.knob == t);
            let limits: Vec<_> = of_t
                .map(|it| (it.is_lower, it.value.as_ref().unwrap()))
                .collect();
            assert_eq!(limits.len(), 2);
            for (is_lower, limit) in limits {
                let ratio = used / number(limit);
                let is_inside = if is_lower {
                    100.0 < ratio
                } else {
                    ratio < 0.01
                };
                assert!(is_inside, "{kernel} {seed}: {used} {limit}");
            }
        }
    }
}

#[test]
fn a_mesh_that_is_too_small_for_the_scalar_hears_why() {
    let folder = scratch("advice-tiny");
    let text = "v 0 0 0\nv 1e-14 0 0\nv 0 1e-14 0\nv 1e-14 1e-14 2e-15\nf 1 2 3\nf 2 4 3\n";
    fs::write(folder.join("tiny.obj"), text).unwrap();
    let words = [
        "epsilon",
        "--kernel",
        "moller-trumbore",
        "--mesh",
        "tiny.obj",
        "-n",
        "2000",
    ];
    let (in_f32, _) = ends(
        &folder,
        &[&words[..], &["-q", "--scalar", "f32"]].concat(),
        0,
    );
    let why =
        "roducts of three lengths such as 1.41e-14 lose digits at the lower end of f32: use f64 or";
    let in_f32 = flat(&in_f32);
    assert!(
        in_f32.contains("No numbers are good here") && in_f32.contains(why),
        "{in_f32}"
    );
    let (in_f64, _) = ends(
        &folder,
        &[&words[..], &["-q", "--scalar", "f64"]].concat(),
        0,
    );
    assert!(!in_f64.contains("roducts of three lengths"), "{in_f64}");
}

#[test]
fn a_contract_for_a_scene_hears_what_is_taken_of_it() {
    let folder = scratch("advice-contract");
    let words = [
        "epsilon", "--kernel", "plucker", "--scalar", "f32", "-n", "100",
    ];
    let note = "of --contract a scene uses only the sides and where rays begin and end";
    let (_, with) = ends(
        &folder,
        &[&words[..], &["--contract", "open-ray"]].concat(),
        0,
    );
    let (_, without) = ends(&folder, &words, 0);
    assert!(
        with.contains(note) && !without.contains(note),
        "{with} {without}"
    );
    // The commands ask for the same; a band would free what a scene counts.
    let more = |kernel: &str| {
        next(
            &output(&folder, kernel, "room", &["--contract", "front-closed-ray"]),
            "audit",
        )
    };
    let of_line = more("moller-trumbore");
    assert!(
        of_line.ends_with(" -n 4000 --contract front-closed-ray"),
        "{of_line}"
    );
    let with_a_gate_on_t = more("plane-unit-normal");
    assert!(with_a_gate_on_t.ends_with(" --contract front-closed-ray,no-self-hit"));
    let (_, error) = ends(&folder, &[&words[..], &["--band", "1e-3"]].concat(), 2);
    assert!(
        error.contains("--band: a scene counts cracks, which a band does not change"),
        "{error}"
    );
}

#[test]
fn where_the_range_of_a_number_is_wide_the_recommended_one_is_as_cheap_as_a_given_one() {
    let folder = scratch("advice-wide");
    // A strict comparison accepts at any number below zero, so the range begins at the least.
    for (kernel, scene, given) in [
        ("baldwin-weber", "extent=1e5,edge=0.1..1000", "edge=-1e-3"),
        ("scalar-triple-two-sided", "room", "edge=-2e-15"),
        ("plane-inside-out-strict", "city", "edge=-1e-10"),
    ] {
        let words = [
            "epsilon",
            "--kernel",
            kernel,
            "--scene",
            scene,
            "--epsilon",
            given,
        ];
        let rest = ["--scalar", "f64", "-n", "4000", "-q", "--format", "json"];
        let (json, _) = ends(&folder, &[&words[..], &rest[..]].concat(), 0);
        let record: SceneResult = json_schema::result(&json);
        let tried = &record.kernels[0].tried;
        let told = format!("{kernel} {:?} {}", tried[0].epsilons, tried[0].cost);
        assert!(
            tried[0].cost <= 1.05 * tried[1].cost,
            "{told}, given {}",
            tried[1].cost
        );
    }
}

#[test]
fn what_is_recommended_is_tried_on_every_kind_of_plane() {
    let folder = scratch("scene-planes");
    let study = [
        "epsilon",
        "--kernel",
        "moller-trumbore",
        "--scalar",
        "f32",
        "-n",
        "3000",
        "-q",
    ];
    let record = |scene: &str| -> SceneResult {
        let all = [&study[..], &["--scene", scene, "--format", "json"]].concat();
        json_schema::result(&ends(&folder, &all, 0).0)
    };
    let part = record("room").kernels.remove(0);
    let planes: Vec<&str> = part
        .elsewhere
        .iter()
        .map(|plane| plane.plane.as_str())
        .collect();
    assert_eq!(
        planes,
        [
            "axis",
            "axis-near-0",
            "axis-0",
            "terrain",
            "box",
            "axis-plane-rays",
            "axis-rays",
            "axis+axis-rays"
        ]
    );
    for plane in &part.elsewhere {
        assert_eq!(plane.wrong.len(), part.counts.len());
        assert!(plane.wrong.iter().all(|rate| 500 < rate.of), "{plane:?}");
    }
    assert!(record("room,plane=axis-0").kernels[0].elsewhere.is_empty());
    let (screen, _) = ends(
        &folder,
        &[&study[..], &["--scene", "room", "--details"]].concat(),
        0,
    );
    assert!(
        screen.contains("\nrecommended: more often wrong "),
        "{screen}"
    );
    assert!(
        screen.contains("\n  rays: aimed from their rounded origin"),
        "{screen}"
    );
}

#[test]
fn without_a_kernel_all_stand_in_one_table_the_cheapest_first() {
    let folder = scratch("epsilon-ranking");
    let all = [
        "epsilon", "--scene", "room", "--scalar", "f32", "-n", "300", "-q",
    ];
    let files = ["--format", "text,json", "-o", "a.txt", "-o", "a.json"];
    ends(&folder, &[&all[..], &files].concat(), 0);
    let read = |name: &str| fs::read_to_string(folder.join(name)).unwrap();
    let text = read("a.txt");
    let record: SceneResult = json_schema::result(&read("a.json"));
    // With so few rays the title names those that are about as good, in a line of its own.
    assert!(text.lines().count() <= 31, "{text}");
    let rows: Vec<Vec<&str>> = text
        .lines()
        .filter(|line| {
            record
                .kernels
                .iter()
                .any(|part| line.starts_with(&format!("{} ", part.kernel)))
        })
        .map(|line| line.split_whitespace().collect())
        .collect();
    assert_eq!(rows.len(), 6, "{text}");
    // Costs rise from row to row, and no kernel costs less than the first.
    let costs: Vec<f64> = rows.iter().map(|row| row[1].parse().unwrap()).collect();
    assert!(costs.is_sorted(), "{text}");
    let fixed = record.kernels.iter().map(|part| part.tried[0].cost);
    // A cost is told as wrong answers in 100 rays.
    let least = 100.0 * fixed.fold(f64::INFINITY, f64::min);
    assert!((least - costs[0]).abs() <= 0.005 * least, "{text}");
    // Kernels that compute the same stand in one row.
    let alike = text
        .lines()
        .find(|line| line.starts_with("  as often wrong with the same numbers: "))
        .unwrap();
    assert!(
        alike.contains("moller-trumbore-t") || alike.contains("precomputed"),
        "{text}"
    );
    let is_text = |line: &&str| !line.contains("hairline ") && !line.contains(" use ");
    assert!(
        text.lines().filter(is_text).all(|line| line.len() <= 100),
        "{text}"
    );
    assert!(text.contains("f32 is fit for this scene"), "{text}");
    let next = text
        .lines()
        .find_map(|line| line.strip_prefix("next: hairline "))
        .unwrap();
    let words = next.split("  # ").next().unwrap().split(' ');
    let words: Vec<&str> = words.chain(["-q"]).collect();
    assert!(
        ends(&folder, &words, 0)
            .0
            .contains("\nwrong on fresh rays (seed 2)")
    );
    // Far from 0 the numbers of f32 are too far apart for triangles of a metre.
    let far = "extent=1000,center=500000,edge=1..50,distance=0..2000";
    let kernels = "moller-trumbore,woop-watertight,cramer";
    let far = study(&folder, kernels, far, &["-n", "100"]);
    let coarse =
        "f32 is coarse for this scene: its numbers are 0.031 apart at the far end, 1/32 of the";
    assert!(far.contains(coarse), "{far}");
}
