//! `--scene`: scenes as sources of cases, and `hairline epsilon --scene`.

use crate::json_schema;
use crate::program::{ends, flat, scratch};
use hairline::internals::report::epsilon::SceneResult;

#[test]
fn a_scene_is_answered_on_one_screen_with_flags_that_work() {
    let folder = scratch("scene-screen");
    let study = [
        "epsilon",
        "--kernel",
        "moller-trumbore",
        "--scene",
        "room",
        "-n",
        "4000",
    ];
    let (screen, error) = ends(&folder, &study, 0);
    assert_eq!(error, "");
    let lines: Vec<&str> = screen.lines().collect();
    // Of two scalars, and few rays, which each notes.
    assert!(lines.len() <= 50, "{} lines", lines.len());
    let few = "from 4,000 rays of each kind only: another seed may name quite others";
    assert!(flat(&screen).contains(few), "{screen}");
    let is_text = |line: &&&str| !line.contains(" hairline ") && !line.starts_with("  use ");
    let long = lines
        .iter()
        .filter(is_text)
        .find(|line| line.chars().count() > 80);
    assert!(long.is_none(), "{long:?}");
    let used: Vec<&str> = lines
        .iter()
        .filter_map(|line| line.strip_prefix("  use  "))
        .collect();
    assert_eq!(used.len(), 2, "{screen}");
    for line in used {
        let (flags, t) = line.split_once("  and  count a hit only if t >= ").unwrap();
        assert!(t.ends_with(" m"), "{line}");
        let mut audit = vec!["audit", "--kernel", "moller-trumbore", "-n", "100", "-q"];
        audit.extend(flags.split(' '));
        ends(&folder, &audit, 0);
    }
    // The commands run, and what is recommended is less often wrong than what was published.
    let share = |command: &str| {
        let words: Vec<&str> = command.split_whitespace().skip(1).collect();
        let (out, _) = ends(&folder, &[&words[..], &["-q"]].concat(), 0);
        let out = flat(&out);
        let (_, rest) = out
            .split_once(" Wrong on ")
            .unwrap_or_else(|| panic!("{out}"));
        rest.split(' ')
            .next()
            .unwrap()
            .trim_start_matches('<')
            .parse::<f64>()
            .unwrap()
    };
    let audits: Vec<&&str> = lines
        .iter()
        .filter(|line| line.starts_with("next: "))
        .collect();
    assert_eq!(audits.len(), 2, "{screen}");
    let audit = audits[0].strip_prefix("next: ").unwrap();
    assert!(
        audit.ends_with(" --scene room --scalar f32 --seed 2 -n 4000"),
        "{audit}"
    );
    let published = "hairline audit --kernel moller-trumbore --scene room --scalar f32 -n 4000";
    assert!(5.0 * share(audit) < share(published), "{screen}");
    let mut offsets = lines
        .iter()
        .filter(|line| line.starts_with("      hairline offset "));
    let words: Vec<&str> = offsets
        .next_back()
        .unwrap()
        .split_whitespace()
        .skip(1)
        .collect();
    ends(&folder, &[&words[..], &["-n", "2000", "-q"]].concat(), 0);
    let both = "both or several hit: costs nothing, the nearest hit is the same";
    let whole = flat(&ends(&folder, &[&study[..], &["--details"]].concat(), 0).0);
    for part in [
        "almost parallel: false hits",
        "shadow rays: self-hits",
        "fresh rays",
        both,
    ] {
        assert!(whole.contains(part), "{part}: {whole}");
    }
}

#[test]
fn a_study_is_the_same_on_any_number_of_threads_and_for_each_scalar_alone() {
    let folder = scratch("scene-threads");
    let run = |more: &[&str]| -> SceneResult {
        let mut all = vec!["epsilon", "--kernel", "woop-watertight", "--format", "json"];
        all.extend([
            "--scene",
            "extent=10, edge=0.1..1, distance=0..5",
            "-n",
            "1000",
            "-q",
        ]);
        all.extend(more);
        json_schema::result(&ends(&folder, &all, 0).0)
    };
    let text = |record: &SceneResult| serde_json::to_string(&record.kernels).unwrap();
    let both = run(&["--threads", "1"]);
    assert_eq!(text(&both), text(&run(&["--threads", "3"])));
    let alone = run(&["--scalar", "f64"]);
    assert_eq!(both.kernels.len(), 2);
    let [one] = &alone.kernels[..] else {
        panic!("one scalar")
    };
    assert_eq!(
        serde_json::to_string(one).unwrap(),
        serde_json::to_string(&both.kernels[1]).unwrap()
    );
    assert_eq!(
        both.scene,
        "extent=10,edge=0.1..1,distance=0..5,direction=unit"
    );
    // Another seed shows other rays.
    assert_ne!(
        text(&alone),
        text(&run(&["--scalar", "f64", "--seed", "9"]))
    );
}

#[test]
fn costs_decide_what_is_recommended() {
    let folder = scratch("scene-costs");
    let edge = |costs: &str| -> f64 {
        let mut all = vec![
            "epsilon",
            "--kernel",
            "moller-trumbore",
            "--format",
            "json",
            "-q",
        ];
        all.extend([
            "--scene", "room", "-n", "4000", "--scalar", "f32", "--cost", costs,
        ]);
        let record: SceneResult = json_schema::result(&ends(&folder, &all, 0).0);
        record.kernels[0].tried[0].epsilons[1].parse().unwrap()
    };
    assert!(edge("crack=1000") < edge("crack=0.001,hit=1000"));
}

#[test]
fn scenes_are_sources_whose_cases_explain_themselves() {
    let folder = scratch("scene-source");
    let audit = [
        "audit", "--scene", "city", "-n", "500", "--kernel", "cramer", "--format", "json",
    ];
    let (record, _) = ends(&folder, &audit, 0);
    let id = record
        .split('"')
        .find(|word| word.starts_with("scene-"))
        .unwrap();
    assert!(
        record.contains("scene-shadow") && record.contains("scene-grazing"),
        "{id}"
    );
    let id = "scene-edges@2/f32/extent=1000,edge=0.01..10,distance=0..2000,direction=unit/1/17";
    let (shown, _) = ends(&folder, &["explain", id, "--kernel", "cramer"], 0);
    assert!(shown.contains("cramer"), "{shown}");
    let id = "scene-shadow@1/f32/extent=1,edge=0.1..1,distance=0..4,direction=unit,kernel=X/1/17";
    let (_, error) = ends(&folder, &["explain", id], 2);
    assert!(error.contains("unknown kernel 'X'"), "{error}");
    let id = "scene-interior@1/f32/extent=1e9,edge=0.1/1/17";
    let (_, error) = ends(&folder, &["explain", id], 2);
    assert!(error.contains("collapse"), "{error}");
}

#[test]
fn a_scalar_that_cannot_hold_the_scene_is_left_out_with_a_word() {
    let folder = scratch("scene-left-out");
    let far = [
        "--scene",
        "extent=5,center=2e6,edge=0.01..3,distance=0..10",
        "-n",
        "1000",
    ];
    for command in [
        &["epsilon", "--kernel", "cramer"][..],
        &["offset", "--scalar", "f32,f64"],
    ] {
        let (out, error) = ends(&folder, &[command, &far].concat(), 0);
        let why = "left out: triangles of edge 0.01 nearly collapse at coordinates of 2000005, where the numbers of f32";
        assert_eq!(error.matches(why).count(), 1, "{error}");
        let said = out.replace("the numbers of f32", "");
        assert!(out.contains("f64") && !said.contains("f32"), "{out}");
        assert_eq!(
            out.contains("Left out: triangles"),
            command[0] == "epsilon",
            "{out}"
        );
        let (out, error) = ends(&folder, &[command, &far, &["-q"]].concat(), 0);
        assert!(out.contains("f64") && error.is_empty(), "{error}");
    }
}

#[test]
fn bad_scenes_get_one_clear_line() {
    let folder = scratch("scene-bad");
    let scenes = [
        (
            "extent=1,edge=2",
            "the longest edge is at most the extent, 1",
        ),
        ("edge=1..0.5", "the range is empty"),
        ("extent=nan", "'nan' is not a finite number"),
        (
            "edge=1e-3-1",
            "'1e-3-1' is not a finite number: a range is written LOW..HIGH",
        ),
        (
            "extent=1e-17,edge=1e-18,distance=0..1e-17",
            "underflow in f32",
        ),
        (
            "extent=1e6,edge=0.01,distance=0..1",
            "apart: use f64, or move the origin",
        ),
        ("extent=1e30,edge=1e29,distance=0..1e30", "overflow in f32"),
        ("castle", "begin with one of unit, room, city, cad-mm"),
    ];
    for (scene, part) in scenes {
        for command in ["epsilon", "audit"] {
            let kernel = ["--kernel", "moller-trumbore", "--scalar", "f32"];
            let arguments = [&[command, "--scene", scene], &kernel[..]].concat();
            let (out, error) = ends(&folder, &arguments, 2);
            assert!(
                out.is_empty() && error.lines().count() == 1,
                "{scene}: {error}"
            );
            assert!(
                error.contains("--scene: ") && error.contains(part),
                "{scene}: {error}"
            );
        }
    }
    let flags: [(&[&str], &str); 7] = [
        (&["--scale", "2^3"], "leave out --scene"),
        (&["--direction", "unit"], "leave out --scene"),
        (&["--at", "1e-3"], "--at: name one --gate"),
        (&["--family", "interior"], "leave out --scene"),
        (&["--cost", "crack=-1"], "--cost: crack=-1"),
        (&["--gate", "paralel"], "there are parallel, edge, t_min"),
        (
            &["--format", "sarif"],
            "there are text, json, markdown, svg, c, rust, glsl, html",
        ),
    ];
    for (flags, part) in flags {
        let mut arguments = vec!["epsilon", "--kernel", "moller-trumbore", "--scene", "room"];
        arguments.extend(flags);
        let (_, error) = ends(&folder, &arguments, 2);
        assert!(
            error.contains(part) && error.lines().count() == 1,
            "{flags:?}: {error}"
        );
    }
    for (epsilon, part) in [
        ("t_min=-1", "t_min is at least 0"),
        ("t_min=x", "'x' is not a finite number"),
        ("t_min", "write t_min once"),
        ("t_min=1,t_min=2", "write t_min once"),
    ] {
        let all = [
            "epsilon",
            "--kernel",
            "moller-trumbore",
            "--epsilon",
            epsilon,
        ];
        let (_, error) = ends(&folder, &all, 2);
        assert!(error.contains(part), "{epsilon}: {error}");
    }
    let all = [
        "epsilon",
        "--kernel",
        "plane-inside-out",
        "--epsilon",
        "t_min=1",
    ];
    let (_, error) = ends(&folder, &all, 2);
    assert!(
        error.contains("no kernel here has a t_min to choose"),
        "{error}"
    );
}

#[test]
fn published_sets_and_values_of_one_gate_are_columns_of_one_study() {
    let folder = scratch("scene-columns");
    let screen = |kernel: &str, more: &[&str]| {
        let mut all = vec![
            "epsilon", "--kernel", kernel, "--scene", "unit", "-n", "500",
        ];
        all.extend(["--scalar", "f32"]);
        all.extend(more);
        ends(&folder, &all, 0).0
    };
    let head = |screen: &str| -> Vec<String> {
        let line = screen
            .lines()
            .find(|line| line.starts_with("wrong on fresh rays"))
            .unwrap();
        line.split_once(')')
            .unwrap()
            .1
            .split_whitespace()
            .map(str::to_owned)
            .collect()
    };
    let both = screen("plane-unit-normal", &[]);
    assert_eq!(head(&both), ["recommended", "zero", "1e-6"]);
    assert_eq!(both.matches("  use  ").count(), 1, "{both}");
    let at = screen("moller-trumbore", &["--gate", "t_min", "--at", "1e-7,3e-3"]);
    assert_eq!(
        head(&at),
        ["recommended", "as", "published", "1e-7", "3e-3"]
    );
    let given = screen(
        "moller-trumbore",
        &["--epsilon", "parallel=1e-9,edge=-1e-5"],
    );
    assert!(
        head(&given)
            .join(" ")
            .starts_with("recommended as given zero"),
        "{given}"
    );
}

#[test]
fn the_recommended_line_with_its_least_t_can_be_pasted_and_tried() {
    let folder = scratch("scene-paste");
    let run = |epsilon: &[&str]| -> SceneResult {
        let mut all = vec![
            "epsilon",
            "--kernel",
            "moller-trumbore",
            "--format",
            "json",
            "-q",
        ];
        all.extend(["--scalar", "f32", "-n", "2000"]);
        all.extend(epsilon);
        json_schema::result(&ends(&folder, &all, 0).0)
    };
    // Without a scene it is the preset `unit`.
    let found = run(&[]);
    assert_eq!(
        found.scene,
        "extent=1,edge=0.1..1,distance=0..4,direction=unit"
    );
    let best = &found.kernels[0].tried[0];
    let [parallel, edge, t_min] = &best.epsilons[..] else {
        panic!("{best:?}")
    };
    assert!(0.0 < t_min.parse::<f64>().unwrap());
    // Of what costs as much nothing is better than what is given; so it is recommended again.
    let pasted = format!("parallel={parallel},edge={edge},t_min={t_min}");
    let again = &run(&["--epsilon", &pasted]).kernels[0];
    assert_eq!(again.tried[0].epsilons, best.epsilons);
    assert_eq!(
        format!("{:?}", again.tried[0].wrong),
        format!("{:?}", best.wrong)
    );
    let other = &run(&["--epsilon", "t_min=0.25"]).kernels[0].tried[1];
    assert_eq!(other.epsilons[2], "2.5e-1");
    assert_eq!(other.name, "source,t_min=0.25");
}

#[test]
fn a_form_without_a_unit_is_the_answer_where_fixed_numbers_cost_twice_as_much() {
    let folder = scratch("scene-form");
    let screen = |scene: &str| {
        let all = [
            "epsilon",
            "--kernel",
            "plane-inside-out",
            "--scene",
            scene,
            "-n",
            "4000",
        ];
        ends(&folder, &[&all[..], &["--scalar", "f32", "-q"]].concat(), 0).0
    };
    let wide = screen("cad-mm");
    let used = wide
        .lines()
        .find(|line| line.starts_with("  use  "))
        .unwrap();
    assert!(
        used.contains("edge = -") && used.ends_with(" * L^4"),
        "{wide}"
    );
    assert!(wide.contains("\n  not  --epsilon parallel="), "{wide}");
    assert!(wide.contains("No fixed numbers are good here"), "{wide}");
    assert!(flat(&wide).contains(" fixed scale-free "), "{wide}");
    // Triangles of one size need none.
    assert!(!screen("extent=1,edge=0.5..0.5,distance=0..4").contains("scale-free"));
}

#[test]
fn errors_of_the_hits_that_remain_are_shown_and_limited() {
    let folder = scratch("scene-errors");
    let run = |more: &[&str]| -> SceneResult {
        let mut all = vec![
            "epsilon",
            "--kernel",
            "moller-trumbore",
            "--format",
            "json",
            "-q",
        ];
        all.extend([
            "--scene", "room", "-n", "6000", "--scalar", "f32", "--gate", "parallel",
        ]);
        all.extend(more);
        json_schema::result(&ends(&folder, &all, 0).0)
    };
    let error = |record: &SceneResult, value: &str| {
        let part = &record.kernels[0];
        let is_grazing = |count: usize| part.counts[count].rays.name() == "scene-grazing";
        let errors = part.tried[0]
            .errors
            .iter()
            .find(|e| is_grazing(e.count) && e.value == value);
        errors.unwrap().clone()
    };
    let free = run(&[]);
    let [of_t, of_point] = ["t", "point"].map(|value| error(&free, value));
    for error in [&of_t, &of_point] {
        let [median, most, worst] = [error.median, error.most, error.worst].map(Option::unwrap);
        assert!(0.0 < median && median < most && most <= worst, "{error:?}");
    }
    assert!(
        free.kernels[0].is_accurate.is_none() && 0.01 < of_t.most.unwrap(),
        "{of_t:?}"
    );
    let limited = run(&["--max-error", "t=1e-3"]);
    assert_eq!(limited.kernels[0].is_accurate, Some(true));
    // On fresh rays, and rounded up by an eighth.
    assert!(
        error(&limited, "t").most.unwrap() < 1.3e-3,
        "{:?}",
        error(&limited, "t")
    );
    let epsilon =
        |record: &SceneResult| -> f64 { record.kernels[0].tried[0].epsilons[0].parse().unwrap() };
    assert!(epsilon(&free) < epsilon(&limited));
    let of_point = run(&["--max-error", "point=0.02"]);
    assert!(
        error(&of_point, "point").most.unwrap() < 0.026,
        "{:?}",
        error(&of_point, "point")
    );
    let screen = |most: &str| {
        let all = [
            "epsilon",
            "--kernel",
            "moller-trumbore",
            "--scene",
            "room",
            "-n",
            "4000",
            "-q",
        ];
        let more = ["--scalar", "f32", "--max-error", most, "--details"];
        ends(&folder, &[&all[..], &more].concat(), 0).0
    };
    let shown = screen("t=1e-3,point=0.01");
    let most = "remain are off by at most 0.001 times t, 0.01 m in the point's place";
    assert!(flat(&shown).contains(most), "{shown}");
    assert!(
        shown.contains("\nof t, almost parallel ") && shown.contains("\nof point (m), at a"),
        "{shown}"
    );
    assert!(
        flat(&screen("t=1e-12")).contains(
            "no fixed values at which 99 % of the hits are off by at most 1e-12 times t:"
        )
    );
    let (_, error) = ends(
        &folder,
        &["epsilon", "--scene", "room", "--max-error", "t=0"],
        2,
    );
    assert!(
        error.contains("--max-error: t=0: not a number above 0"),
        "{error}"
    );
    // How many are off by more on fresh rays is shown for all epsilons.
    let [exceeded, free] = [&limited, &free].map(|record| &record.kernels[0].tried[0].exceeded);
    assert!(
        free.is_empty() && exceeded.iter().any(|rate| 0 < rate.of),
        "{exceeded:?}"
    );
    assert!(
        exceeded
            .iter()
            .all(|rate| rate.rate.is_none_or(|share| share < 0.015))
    );
    assert!(shown.contains("\ntoo far off, almost parallel "), "{shown}");
}

#[test]
fn what_is_proved_stands_beside_the_limits() {
    let folder = scratch("scene-proved");
    let study = [
        "epsilon",
        "--kernel",
        "moller-trumbore",
        "--scene",
        "room",
        "-n",
        "1000",
        "-q",
    ];
    let (screen, _) = ends(&folder, &[&study[..], &["--details"]].concat(), 0);
    let proved: Vec<&str> = screen
        .lines()
        .filter(|line| line.contains("0: proved"))
        .collect();
    assert_eq!(proved.len(), 2, "{screen}");
    for line in proved {
        let line = flat(line);
        assert!(line.starts_with("parallel >= "), "{line}");
        assert!(
            line.ends_with(" exactly parallel: false hits 0: proved 0"),
            "{line}"
        );
    }
}

#[test]
fn every_format_holds_the_same_answer() {
    let folder = scratch("scene-formats");
    let mut all = vec![
        "epsilon",
        "--kernel",
        "moller-trumbore",
        "--scene",
        "room",
        "-n",
        "3000",
        "-q",
    ];
    all.extend([
        "--format",
        "text,json,svg,html",
        "--scalar",
        "f32",
        "--at",
        "1e-5,2e-5,5e-5",
        "--gate",
        "t_min",
    ]);
    let files = ["a.txt", "a.json", "a.svg", "a.html"];
    all.extend(files.iter().flat_map(|file| ["-o", *file]));
    ends(&folder, &all, 0);
    let [text, json, svg, html] =
        files.map(|file| std::fs::read_to_string(folder.join(file)).unwrap());
    // The published schema, and a record that breaks it.
    let schema = concat!(env!("CARGO_MANIFEST_DIR"), "/docs/schema/record.json");
    let schema = serde_json::from_str(&std::fs::read_to_string(schema).unwrap()).unwrap();
    let mut document: serde_json::Value = serde_json::from_str(&json).unwrap();
    assert_eq!(json_schema::errors(&schema, &document), [""; 0]);
    document["result"]["kernels"][0]["limits"][0]["one_in"] = "many".into();
    assert_ne!(json_schema::errors(&schema, &document), [""; 0]);
    // Every curve holds what was tried.
    let record: SceneResult = json_schema::result(&json);
    let part = &record.kernels[0];
    for (knob, curve) in part.curves.iter().enumerate() {
        for tried in part
            .tried
            .iter()
            .take(if part.knobs.len() == 1 { 9 } else { 1 })
        {
            let place = curve
                .values
                .iter()
                .position(|value| *value == tried.epsilons[knob])
                .unwrap();
            for (count, points) in curve.counts.iter().enumerate() {
                let is_lost = ["crack", "miss"].contains(&part.counts[count].kind.name());
                let hits = points.hits[place];
                let wrong = if is_lost { points.of - hits } else { hits };
                assert_eq!(
                    (wrong, points.of),
                    (tried.wrong[count].count, tried.wrong[count].of)
                );
                assert!(points.hits.is_sorted_by(|a, b| a >= b), "{points:?}");
            }
        }
    }
    let used = text
        .lines()
        .find_map(|line| line.strip_prefix("  use  "))
        .unwrap();
    uppsala::parse(&svg).unwrap();
    assert!(
        svg.contains(&used.replace(">=", "&gt;=")) && svg.contains("contract: "),
        "{svg}"
    );
    assert!(
        html.contains(&used.replace(">=", "&gt;=")) && html.matches("<script").count() == 1,
        "{html}"
    );
    for part in [
        "Content-Security-Policy",
        "name=\"viewport\"",
        "color-scheme",
    ] {
        assert!(html.contains(part), "{part}");
    }
    // Names above a plot stand apart: those of one height, by about the width of their characters.
    let mut labels: Vec<(f64, f64, f64)> = Vec::new();
    for element in svg.split("<path class=\"tried").skip(1) {
        let attribute = |name: &str| -> f64 {
            let text = element.split_once("<text").unwrap().1;
            let rest = text.split_once(&format!(" {name}=\"")).unwrap().1;
            rest.split_once('"').unwrap().0.parse().unwrap()
        };
        let name = element.split_once("text-anchor=\"middle\">").unwrap().1;
        let half = 3.2 * name.split_once('<').unwrap().0.len() as f64;
        labels.push((attribute("y"), attribute("x") - half, attribute("x") + half));
    }
    labels.sort_by(|a, b| a.partial_cmp(b).unwrap());
    assert!(4 <= labels.len(), "{labels:?}");
    assert!(svg.contains(": 0</text>") && !svg.contains("0e0"), "{svg}");
    for pair in labels.windows(2) {
        assert!(pair[0].0 < pair[1].0 || pair[0].2 <= pair[1].1, "{pair:?}");
        assert!(0.0 <= pair[0].1 && pair[0].2 <= 460.0, "{pair:?}");
    }
}

/// A box of 12 triangles.
const BOX: &str = "v -2 -1 0\nv 2 -1 0\nv 2 1 0\nv -2 1 0\nv -2 -1 3\nv 2 -1 3\nv 2 1 3\nv -2 1 3\n\
    f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

#[test]
fn a_mesh_is_a_scene() {
    let folder = scratch("scene-mesh");
    std::fs::write(folder.join("box.obj"), BOX).unwrap();
    let study = [
        "epsilon",
        "--kernel",
        "moller-trumbore",
        "--mesh",
        "box.obj",
        "-n",
        "3000",
        "-q",
    ];
    let (screen, error) = ends(&folder, &study, 0);
    assert_eq!(error, "");
    for part in [
        // Edges are rounded outwards to three digits: a box's diagonals are 4.472, 3.606 and 5.
        "moller-trumbore f32 in box.obj (12 triangles) in extent=3, edge=3.6..5, distance=0..5.39, direction=unit ",
        " use --epsilon parallel=",
        "the smallest triangle is missed at angles below",
    ] {
        assert!(flat(&screen).contains(part), "{part}: {screen}");
    }
    // Every kind of ray was found: edges, vertices and planes that hold an axis.
    assert!(!screen.lines().any(|line| line.ends_with(" -")), "{screen}");
    let further = [
        "--scene",
        "mesh, distance=0..20, direction=target",
        "--cost",
        "miss=3",
    ];
    let (screen, _) = ends(&folder, &[&study[..], &further[..]].concat(), 0);
    assert!(
        screen.contains("distance=0..20,direction=target"),
        "{screen}"
    );
}

#[test]
fn cases_of_a_mesh_explain_themselves() {
    let folder = scratch("scene-mesh-cases");
    std::fs::write(folder.join("box.obj"), BOX).unwrap();
    let audit = [
        "audit",
        "--scene",
        "mesh",
        "--mesh",
        "box.obj",
        "--kernel",
        "moller-trumbore",
    ];
    let further = ["-n", "300", "-q", "--format", "json", "--scalar", "f32"];
    let (record, _) = ends(&folder, &[&audit[..], &further[..]].concat(), 0);
    // The screen has a column for each kind of ray.
    let (screen, _) = ends(&folder, &[&audit[..], &further[..3]].concat(), 0);
    for column in ["\ninside ", "\nedges ", "\nvertex ", "\nflat "] {
        assert!(screen.contains(column), "{screen}");
    }
    // Nothing is promised, so no crack breaks a promise.
    assert!(
        screen.contains("cracks: ") && !screen.contains("promises: crack"),
        "{screen}"
    );
    let is_id = |word: &&str| word.starts_with("scene-") && word.contains("/f32/");
    let mut ids: Vec<&str> = record.split(['"', '\'', ' ']).filter(is_id).collect();
    ids.sort();
    ids.dedup();
    for family in ["scene-edges", "scene-vertices"] {
        let of = |id: &&&str| id.starts_with(&format!("{family}@2/f32/mesh="));
        let id = ids
            .iter()
            .find(of)
            .unwrap_or_else(|| panic!("{family}: {ids:?}"));
        let explain = [
            "explain",
            *id,
            "--mesh",
            "box.obj",
            "--kernel",
            "moller-trumbore",
        ];
        let (shown, _) = ends(&folder, &explain, 0);
        assert!(shown.contains("moller-trumbore"), "{shown}");
        let (_, error) = ends(&folder, &["explain", id], 2);
        assert!(error.contains("add --mesh FILE"), "{error}");
    }
    // A part of a run has the same cases as the whole.
    let parts = ["0/2", "1/2"].map(|shard| {
        let file = format!("{}.json", &shard[..1]);
        let flags = ["--shard", shard, "-o", file.as_str()];
        ends(&folder, &[&audit[..], &further[..], &flags].concat(), 0);
        file
    });
    let merge = ["merge", &parts[0], &parts[1], "--format", "json", "-q"];
    let (merged, _) = ends(&folder, &merge, 0);
    let result = |text: &str| {
        let record: serde_json::Value = serde_json::from_str(text).unwrap();
        record["result"]["results"].clone()
    };
    assert_eq!(result(&record), result(&merged));
}

#[test]
fn meshes_that_are_no_scene_get_one_clear_line() {
    let folder = scratch("scene-mesh-bad");
    let files = [
        ("box.obj", BOX),
        ("empty.obj", ""),
        ("flat.obj", "v 0 0 0\nv 1 1 1\nv 2 2 2\nf 1 2 3\n"),
        ("tiny.obj", "v 0 0 0\nv 1e-60 0 0\nv 0 1e-60 0\nf 1 2 3\n"),
        ("huge.obj", "v 0 0 0\nv 1e30 0 0\nv 0 1e30 0\nf 1 2 3\n"),
    ];
    for (name, text) in files {
        std::fs::write(folder.join(name), text).unwrap();
    }
    let run = |flags: &[&str], code: i32, part: &str| {
        let mut arguments = vec![
            "epsilon",
            "--kernel",
            "moller-trumbore",
            "-q",
            "--scalar",
            "f32",
        ];
        arguments.extend(flags);
        let (_, error) = ends(&folder, &arguments, code);
        assert!(
            error.contains(part) && error.lines().count() == 1,
            "{flags:?}: {error}"
        );
    };
    run(
        &["--mesh", "empty.obj"],
        65,
        "empty.obj: the file has no vertices",
    );
    run(
        &["--mesh", "flat.obj"],
        65,
        "flat.obj: no triangle has an area in f32",
    );
    run(
        &["--mesh", "tiny.obj"],
        65,
        "tiny.obj: no triangle has an area in f32",
    );
    run(
        &["--mesh", "huge.obj"],
        65,
        "overflow in f32: use a larger unit of length",
    );
    run(&["--mesh", "none.obj"], 74, "none.obj");
    run(
        &["--mesh", "box.obj", "--mesh", "flat.obj"],
        2,
        "--mesh: a scene is of one mesh",
    );
    run(
        &["--mesh", "box.obj", "--scene", "room"],
        2,
        "'room' is no word for the scene of a mesh",
    );
    run(
        &["--mesh", "box.obj", "--scene", "extent=9"],
        2,
        "its own extent, edges and planes",
    );
    run(
        &["--mesh", "box.obj", "--scene", "distance=-1"],
        2,
        "must be from 0 up",
    );
    run(
        &["--mesh", "box.obj", "--family", "interior"],
        2,
        "leave out --mesh",
    );
    run(
        &["--mesh", "box.obj", "--scale", "2^3"],
        2,
        "leave out --mesh",
    );
    run(
        &["--mesh", "box.obj", "--corpus", "x"],
        2,
        "leave out --mesh",
    );
    run(&["--scene", "mesh"], 2, "'mesh' needs --mesh FILE");
    // One triangle has no edge with another: those rows are empty, and the rest is answered.
    std::fs::write(
        folder.join("one.obj"),
        "v 0 0 0\nv 1 0.5 0.25\nv 0.3 1 0.1\nf 1 2 3\n",
    )
    .unwrap();
    let one = [
        "epsilon",
        "--kernel",
        "moller-trumbore",
        "--mesh",
        "one.obj",
        "-n",
        "500",
        "-q",
    ];
    let (screen, _) = ends(&folder, &[&one[..], &["--details"]].concat(), 0);
    let row = |label: &str| screen.lines().find(|line| line.contains(label)).unwrap();
    for label in [
        "at a shared edge: cracks",
        "at a shared vertex: cracks",
        "exactly parallel",
    ] {
        assert!(row(label).ends_with(" -"), "{screen}");
    }
    assert!(!row("at a triangle: hits lost").ends_with(" -"), "{screen}");
    let id = "scene-edges@2/f32/mesh=0123456789abcdef,distance=0..1/1/17";
    let (_, error) = ends(&folder, &["explain", id, "--mesh", "one.obj"], 65);
    assert!(error.contains("its digest is"), "{error}");
}
