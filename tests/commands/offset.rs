//! `hairline offset`: the screen, the record, and what is wrong usage.

use crate::json_schema;
use crate::program::{ends, flat, scratch};
use crate::tools::has;
use hairline::internals::case::SceneKind;
use serde_json::Value;
use std::fs;
use std::path::Path;
use std::process::Command;

fn json(folder: &std::path::Path, more: &[&str]) -> Value {
    let mut all = vec!["offset", "--format", "json", "-q"];
    all.extend(more);
    json_schema::result(&ends(folder, &all, 0).0)
}

#[test]
fn the_screen_says_what_to_use_and_its_command_works() {
    let folder = scratch("offset-screen");
    let (screen, error) = ends(&folder, &["offset", "--scene", "room", "-n", "4000"], 0);
    assert_eq!(error, "");
    let lines: Vec<&str> = screen.lines().collect();
    assert!(lines.len() <= 60, "{} lines", lines.len());
    let is_text = |line: &&&str| !line.contains("hairline ");
    let long = lines
        .iter()
        .filter(is_text)
        .find(|line| 80 < line.chars().count());
    assert!(long.is_none(), "{long:?}");
    assert_eq!(screen.matches("\n  use  ").count(), 3, "{screen}");
    for part in [
        "Which hit point is yours?",
        "p = (1-u-v)*a + u*b + v*c",
        "p = o + t*d",
        "\nnone ",
    ] {
        assert!(screen.contains(part), "{part}: {screen}");
    }
    let whole = ends(
        &folder,
        &["offset", "--scene", "room", "-n", "2000", "--details"],
        0,
    )
    .0;
    assert!(
        whole.contains("\nwaechter-binder ") && whole.contains("\nmitsuba "),
        "{whole}"
    );
    let commands: Vec<&str> = lines
        .iter()
        .filter_map(|line| line.strip_prefix("next: hairline "))
        .collect();
    assert_eq!(commands.len(), 1);
    for command in commands {
        let mut again: Vec<&str> = command.split("  # ").next().unwrap().split(' ').collect();
        again.extend(["-n", "2000", "-q"]);
        let (screen, _) = ends(&folder, &again, 0);
        assert!(
            screen.contains("room") || screen.contains("extent=5"),
            "{screen}"
        );
    }
}

/// A kernel that hits nothing shows nothing of the end of a segment, and no end is advised for it.
#[test]
fn no_end_of_a_segment_is_advised_where_the_kernel_hits_no_surface() {
    let folder = scratch("offset-no-end");
    let tiny = "extent=1e-4,edge=1e-5,distance=0..1e-4";
    let (screen, _) = ends(&folder, &["offset", "--scene", tiny, "-n", "2000", "-q"], 0);
    assert!(screen.contains("No end is advised: "), "{screen}");
    assert!(!screen.contains("use  t_max"), "{screen}");
}

#[test]
fn an_offset_that_jumps_over_the_scene_is_not_recommended() {
    let folder = scratch("offset-high");
    let far = [
        "offset",
        "--scene",
        "room",
        "--scheme",
        "t-min=300",
        "-n",
        "5000",
        "-q",
    ];
    let (screen, _) = ends(&folder, &far, 0);
    assert!(!screen.contains("\n  use  "), "{screen}");
    let all = flat(&screen);
    let none = "None of these: the lowest that never fails, t-min=300,";
    assert_eq!(all.matches(none).count(), 2, "{screen}");
    assert!(all.contains("Leave out --scheme"), "{screen}");
    // Of few rays the lowest never fails, but the derived bound comes first.
    let (few, _) = ends(
        &folder,
        &[
            "offset", "--scene", "room", "-n", "20", "--point", "uv", "-q",
        ],
        0,
    );
    assert!(few.contains("use  normal=3.16e-6"), "{few}");
}

#[test]
fn the_record_has_every_scheme_with_its_source_and_is_the_same_on_any_number_of_threads() {
    let folder = scratch("offset-record");
    let far = [
        "--scene",
        "extent=10,center=1e5,edge=1",
        "-n",
        "2000",
        "--scalar",
        "f32,f64",
    ];
    let record = json(&folder, &[&far[..], &["--threads", "1"]].concat());
    assert_eq!(
        record,
        json(&folder, &[&far[..], &["--threads", "3"]].concat())
    );
    assert_eq!(
        record["scene"],
        "extent=10,center=100000,edge=1,distance=0..40,direction=unit"
    );
    let points = record["points"].as_array().unwrap();
    assert_eq!(points.len(), 4);
    for part in points {
        let schemes = part["schemes"].as_array().unwrap();
        assert_eq!(
            schemes.len(),
            if part["scalar"] == "f32" { 12 } else { 10 },
            "{part}"
        );
        assert!(schemes.iter().all(|scheme| scheme["source"].is_string()));
        assert!(
            schemes
                .iter()
                .all(|scheme| scheme["wrong"]["of"] == part["hits"])
        );
        // What is recommended never fails, and nothing of which that is true is much lower. Where there is
        // a derived bound, it is that.
        let median = |scheme: &Value| scheme["height_in_edges"]["median"].as_f64().unwrap();
        let never =
            |scheme: &&Value| scheme["wrong"]["count"] == 0 && scheme["self_hits"]["count"] == 0;
        let lowest = schemes
            .iter()
            .filter(never)
            .map(median)
            .reduce(f64::min)
            .unwrap();
        let best = schemes
            .iter()
            .find(|scheme| scheme["name"] == part["best"]["scheme"])
            .unwrap();
        assert!(never(&best), "{best}");
        assert!(median(best) <= 4.0 * lowest, "{best}: {lowest}");
        assert_eq!(
            part["best"]["is_derived"],
            part["derived"].is_object(),
            "{part}"
        );
    }
    let of = |part: &Value, name: &str| {
        let schemes = part["schemes"].as_array().unwrap();
        schemes
            .iter()
            .find(|scheme| scheme["name"] == name)
            .unwrap()
            .clone()
    };
    let lifted = of(&points[0], "waechter-binder");
    let median = lifted["height_in_edges"]["median"].as_f64().unwrap();
    assert!(
        (1.9..2.1).contains(&median) && lifted["beyond_wall"]["rate"] == 1.0,
        "{lifted}"
    );
    // A wrong start shows again, and on the wrong side.
    let none = of(&points[0], "none");
    let explain = none["first_wrong"]["explain"].as_str().unwrap();
    let case = explain.split('\'').nth(1).unwrap();
    let (told, _) = ends(
        &folder,
        &["explain", case, "--kernel", "moller-trumbore"],
        0,
    );
    assert!(told.contains("moller-trumbore"), "{told}");
    let first_ray = none["first_wrong"]["first_ray"].as_str().unwrap();
    ends(&folder, &["explain", first_ray, "--kernel", "cramer"], 0);
}

#[test]
fn first_rays_at_a_mesh_leave_its_own_triangles() {
    let folder = scratch("offset-mesh");
    let mesh = concat!(env!("CARGO_MANIFEST_DIR"), "/corpora/meshes/icosphere.obj");
    let mine = folder.join("a.obj");
    fs::copy(mesh, &mine).unwrap();
    let flags = ["--mesh", "a.obj", "-n", "4000"];
    let record = json(&folder, &[&flags[..], &["--threads", "1"]].concat());
    assert_eq!(
        record,
        json(&folder, &[&flags[..], &["--threads", "3"]].concat())
    );
    assert!(record["mesh"] == "a.obj" && record["planes"].as_array().unwrap().len() == 1);
    // The new ray's triangle is one of the file's, in every coordinate.
    let text = fs::read_to_string(&mine).unwrap();
    let vertices: Vec<[f32; 3]> = text
        .lines()
        .filter_map(|line| line.strip_prefix("v "))
        .map(|line| {
            let numbers: Vec<f32> = line.split(' ').map(|x| x.parse().unwrap()).collect();
            numbers.try_into().unwrap()
        })
        .collect();
    for part in record["points"].as_array().unwrap() {
        let schemes = part["schemes"].as_array().unwrap();
        let none = schemes
            .iter()
            .find(|scheme| scheme["name"] == "none")
            .unwrap();
        let explain = none["first_wrong"]["explain"].as_str().unwrap();
        let case: Value = serde_json::from_str(explain.split('\'').nth(1).unwrap()).unwrap();
        for corner in ["a", "b", "c"] {
            let at: Vec<f32> = case[corner]
                .as_array()
                .unwrap()
                .iter()
                .map(|x| x.as_f64().unwrap() as f32)
                .collect();
            assert!(vertices.iter().any(|vertex| vertex[..] == at[..]), "{case}");
        }
        // A first ray of the mesh is explained with the mesh.
        let first = none["first_wrong"]["first_ray"].as_str().unwrap();
        ends(
            &folder,
            &["explain", first, "--mesh", "a.obj", "--kernel", "cramer"],
            0,
        );
        // No bound is claimed: triangles of a mesh may be thin.
        assert!(part["derived"].is_null(), "{part}");
        let command = part["best"]["command"].as_str().unwrap();
        assert!(command.contains(" --mesh a.obj --scene mesh "), "{command}");
        let words: Vec<&str> = command
            .split(' ')
            .skip(1)
            .chain(["-n", "500", "-q"])
            .collect();
        ends(&folder, &words, 0);
    }
    let (screen, _) = ends(&folder, &[&["offset"], &flags[..], &["-q"]].concat(), 0);
    assert!(
        flat(&screen).starts_with(
            "Start new rays with normal=2.5e-7: start at p + n * 2.5e-7 in a.obj (extent="
        ),
        "{screen}"
    );
    let (_, error) = ends(
        &folder,
        &["offset", "--mesh", "a.obj", "--scene", "room", "-q"],
        2,
    );
    assert!(
        error.contains("'room' is no word for the scene of a mesh"),
        "{error}"
    );
    let (_, error) = ends(&folder, &["offset", "--mesh", "b.obj", "-q"], 74);
    assert!(error.contains("b.obj"), "{error}");
}

#[test]
fn the_recommended_offset_holds_on_every_kind_of_plane() {
    let folder = scratch("offset-planes");
    let place = [
        "--scene",
        "extent=1000,edge=100..1000,distance=0..1000",
        "-n",
        "5000",
    ];
    let record = json(&folder, &place);
    let kinds: Vec<String> = SceneKind::ALL.map(|kind| kind.to_string()).into();
    assert_eq!(record["planes"], serde_json::json!(kinds));
    for part in record["points"].as_array().unwrap() {
        let schemes = part["schemes"].as_array().unwrap();
        let of = |name: &str| {
            schemes
                .iter()
                .find(|scheme| scheme["name"] == name)
                .unwrap()
        };
        let best = of(part["best"]["scheme"].as_str().unwrap());
        let elsewhere = best["elsewhere"].as_array().unwrap();
        assert_eq!(elsewhere.len(), kinds.len() - 1);
        for plane in elsewhere {
            assert_eq!(
                (&plane["wrong"]["count"], &plane["self_hits"]["count"]),
                (&0.into(), &0.into())
            );
        }
        // What looks right on generic planes is not on a floor.
        let moved = of("waechter-binder");
        assert!(moved["wrong"]["rate"].as_f64().unwrap() < 0.001);
        let at_zero = &moved["elsewhere"][2];
        assert_eq!(at_zero["plane"], "axis-0");
        let rate = at_zero["wrong"]["rate"].as_f64().unwrap();
        assert!(
            part["point"] == "uv" || (0.12..0.22).contains(&rate),
            "{at_zero}"
        );
    }
    let (screen, _) = ends(
        &folder,
        &[&["offset", "-q", "--details"], &place[..]].concat(),
        0,
    );
    assert!(screen.contains("\nmore wrong sides elsewhere "), "{screen}");
    // A scene that names a kind is about it alone.
    let floor = ["--scene", "room,plane=axis-0", "-n", "500", "--point", "uv"];
    let record = json(&folder, &floor);
    assert_eq!(record["planes"], serde_json::json!(["axis-0"]));
    assert_eq!(
        record["points"][0]["schemes"][0]["elsewhere"],
        serde_json::json!([])
    );
}

#[test]
fn schemes_points_and_walls_are_those_named() {
    let folder = scratch("offset-named");
    let flags = [
        "--scheme",
        "normal=1e-3,none,t-min=0.5",
        "--point",
        "ray",
        "--wall",
        "0.001",
    ];
    let record = json(
        &folder,
        &[&flags[..], &["-n", "3000", "--kernel", "woop-watertight"]].concat(),
    );
    let [part] = record["points"].as_array().unwrap().as_slice() else {
        panic!("{record}")
    };
    assert_eq!(
        (&part["kernel"], &part["point"]),
        (&"woop-watertight".into(), &"ray".into())
    );
    let schemes = part["schemes"].as_array().unwrap();
    let names: Vec<&str> = schemes
        .iter()
        .map(|scheme| scheme["name"].as_str().unwrap())
        .collect();
    assert_eq!(names, ["normal=1e-3", "none", "t-min=0.5"]);
    // Edges are at most 1, so 1e-3 is never below a thousandth of one, but for the point's own error.
    assert!(0.9 < schemes[0]["beyond_wall"]["rate"].as_f64().unwrap());
    assert_eq!(schemes[1]["beyond_wall"]["count"], 0);
    // A kernel of whole lines that reports no t cannot tell a self-hit.
    let lines = [
        "--kernel",
        "scalar-triple-two-sided",
        "--point",
        "uv",
        "-n",
        "500",
    ];
    let record = json(
        &folder,
        &[&lines[..], &["--scheme", "normal=1e-3"]].concat(),
    );
    let part = &record["points"][0];
    assert_eq!(part["schemes"][0]["self_hits"]["of"], 0);
    assert_eq!(part["best"]["scheme"], "normal=1e-3");
    // A scheme that has no constants for f64 leaves it out.
    let both = [
        "--scheme",
        "waechter-binder",
        "--scalar",
        "f32,f64",
        "--point",
        "uv",
        "-n",
        "500",
    ];
    assert_eq!(json(&folder, &both)["points"].as_array().unwrap().len(), 1);
    let (list, _) = ends(&folder, &["list", "schemes"], 0);
    for part in [
        "waechter-binder: move",
        "https://doi.org",
        "normal=VALUE: the distance [0.001]",
    ] {
        assert!(list.contains(part), "{part}: {list}");
    }
}

#[test]
fn bad_input_gets_one_clear_line() {
    let folder = scratch("offset-bad");
    let flags: [(&[&str], i32, &str); 26] = [
        (
            &["--scene", "extent=1,edge=2"],
            2,
            "the longest edge is at most the extent, 1",
        ),
        (
            &["--scene", "extent=nan"],
            2,
            "'nan' is not a finite number",
        ),
        (&["--scene", "center=inf"], 2, "not a finite number"),
        (
            &["--scene", "castle"],
            2,
            "begin with one of unit, room, city, cad-mm",
        ),
        (&["--scene", "center=1e9"], 2, "collapse at coordinates of"),
        (
            &["--scheme", "nromal=1e-3"],
            2,
            "unknown scheme 'nromal'; did you mean 'normal'?",
        ),
        (
            &["--scheme", "normal=nan"],
            2,
            "normal=nan: write the distance as a number from 0 up",
        ),
        (&["--scheme", "normal=-1"], 2, "from 0 up"),
        (
            &["--scheme", "pbrt-v4=x"],
            2,
            "write the n of gamma n as a number",
        ),
        (&["--scheme", "none,none"], 2, "'none' is given twice"),
        (&["--wall", "0"], 2, "--wall: '0' is not a distance above 0"),
        (&["--wall", "nan"], 2, "--wall: 'nan'"),
        (
            &["--fold", "0"],
            2,
            "--fold: '0' is not an angle between 0 and 180 degrees",
        ),
        (&["--fold", "180"], 2, "--fold: '180'"),
        (&["--fold", "nan"], 2, "--fold: 'nan'"),
        (
            &["--scheme-cmd", "./mine"],
            2,
            "write NAME=COMMAND, as mine=./mine",
        ),
        (
            &["--scheme-cmd", "a b=./mine"],
            2,
            "'a b' is no name for a scheme",
        ),
        (
            &["--scheme-cmd", "none=true"],
            2,
            "there are two schemes of the name 'none'",
        ),
        (
            &["--scheme-cmd", "x='"],
            2,
            "a quotation mark or a backslash in it is not closed",
        ),
        (
            &["--scheme-cmd", "x=/nowhere/at/all"],
            74,
            "it cannot be started",
        ),
        (
            &["--point", "st"],
            2,
            "unknown point 'st': there are uv and ray",
        ),
        (&["--scalar", "f16"], 2, "unknown scalar 'f16'"),
        (&["--kernel", "mine"], 2, "unknown kernel 'mine'"),
        (
            &["--band", "4ulps"],
            2,
            "--band: it means nothing for the start of a ray",
        ),
        (
            &["--scheme", "waechter-binder", "--scalar", "f64"],
            4,
            "no scheme runs in the chosen",
        ),
        (&["--format", "svg"], 2, "there are text, json"),
    ];
    for (flags, code, part) in flags {
        let (out, error) = ends(&folder, &[&["offset", "-n", "10"], flags].concat(), code);
        assert!(
            out.is_empty() && error.lines().count() == 1,
            "{flags:?}: {error}"
        );
        assert!(error.contains(part), "{flags:?}: {error}");
    }
    ends(&folder, &["offset", "-n", "0"], 2);
    ends(
        &folder,
        &["offset", "-n", "10", "-q", "-o", "/nowhere/at/all"],
        74,
    );
}

#[test]
fn neighbours_are_passed_where_they_are_folded_up_steeply_enough() {
    let folder = scratch("offset-fold");
    let passed = |fold: &str| {
        let flags = [
            "--scheme",
            "normal=0.1,none",
            "--point",
            "uv",
            "--fold",
            fold,
            "-n",
            "3000",
        ];
        let part = json(&folder, &flags)["points"][0].clone();
        assert_eq!(
            part["schemes"][1]["past_neighbour"]["count"]
                .as_u64()
                .unwrap()
                / 100,
            0,
            "{part}"
        );
        part["schemes"][0]["past_neighbour"]["rate"]
            .as_f64()
            .unwrap()
    };
    // Starts 0.1 above edges of 0.1 to 1; along the normal nothing passes a right angle.
    let [flat, corner, right] = ["15", "45", "90"].map(passed);
    assert!(
        0.5 < corner && corner < flat && 0.9 < flat,
        "{flat} {corner}"
    );
    assert!(right < 0.01, "{right}");
}

#[test]
fn a_derived_bound_is_larger_than_any_that_was_needed() {
    let folder = scratch("offset-derived");
    let scenes = [
        ("unit", "f32", "5000"),
        ("city", "f64", "1000"),
        ("extent=1e3,edge=900", "f32", "5000"),
    ];
    for (scene, scalar, count) in scenes {
        let flags = [
            "--scene", scene, "--scalar", scalar, "-n", count, "--scheme", "none",
        ];
        let record = json(&folder, &flags);
        let [of_weights, of_ray] = [&record["points"][0], &record["points"][1]];
        assert!(of_ray["derived"].is_null());
        let derived = of_weights["derived"]["normal"].as_f64().unwrap();
        let needed = of_weights["least"]["lengths"]["largest"].as_f64().unwrap();
        assert!(
            (0.02..1.0).contains(&(needed / derived)),
            "{scene}: {needed} {derived}"
        );
        let scheme = format!("normal={derived:e}");
        let flags = [
            "--scene", scene, "--scalar", scalar, "-n", count, "--scheme", &scheme,
        ];
        assert_eq!(
            json(&folder, &flags)["points"][0]["schemes"][0]["wrong"]["count"],
            0
        );
    }
}

#[test]
fn no_bound_is_derived_where_the_squared_lengths_of_normals_leave_the_range() {
    let folder = scratch("offset-underived");
    // In f32 they overflow, and `normal=` at the bound is wrong for half of the starts.
    let scene = "extent=1e11,edge=5e10,distance=0..1e11";
    for (scalar, is_derived) in [("f32", false), ("f64", true)] {
        let flags = [
            "--scene", scene, "--scalar", scalar, "-n", "200", "--scheme", "none",
        ];
        let record = json(&folder, &flags);
        assert_eq!(
            record["points"][0]["derived"].is_object(),
            is_derived,
            "{scalar}"
        );
    }
}

/// The counts of the schemes of a run with hit points from u and v.
fn counts(folder: &Path, flags: &[&str]) -> Vec<Value> {
    let all = [&["--point", "uv", "-n", "2500", "--threads", "2"], flags].concat();
    let record = json(folder, &all);
    let schemes = record["points"][0]["schemes"].as_array().unwrap();
    let count = |scheme: &Value| serde_json::json!([scheme["wrong"], scheme["height_in_edges"]]);
    schemes.iter().map(count).collect()
}

#[cfg(unix)]
#[test]
fn an_offset_in_c_over_a_pipe_does_as_the_same_in_rust() {
    if !has("cc") {
        return;
    }
    let folder = scratch("offset-pipe");
    let source = "#include \"hairline_offset.h\"
static hairline_start hairline_start_of(const hairline_hit *hit) {
    hairline_start start = {{0, 0, 0}, 0};
    for (int i = 0; i < 3; i++) {
        float p = (float)hit->point[i], n = (float)hit->normal[i], offset = n * 1e-3f;
        start.origin[i] = hit->is_f64 ? hit->point[i] + hit->normal[i] * 1e-3 : p + offset;
    }
    return start;
}
";
    fs::write(folder.join("mine.c"), source).unwrap();
    let include = concat!("-I", env!("CARGO_MANIFEST_DIR"), "/include");
    let flags = [
        "-O1",
        "-ffp-contract=off",
        "-Wall",
        "-Werror",
        include,
        "-o",
        "mine",
        "mine.c",
    ];
    let built = Command::new("cc")
        .args(flags)
        .arg("-lm")
        .current_dir(&folder)
        .output()
        .unwrap();
    assert!(
        built.status.success(),
        "{}",
        String::from_utf8_lossy(&built.stderr)
    );
    // The header's old name is another way to it.
    let once = source.replace("hairline_offset.h", "hairline_spawn.h");
    fs::write(folder.join("once.c"), once).unwrap();
    let flags = ["-fsyntax-only", "-Wall", "-Werror", include, "once.c"];
    let checked = Command::new("cc").args(flags).current_dir(&folder).status();
    assert!(checked.unwrap().success());
    for scalar in ["f32", "f64"] {
        let flags = [
            "--scheme",
            "normal=1e-3",
            "--scheme-cmd",
            "mine=./mine",
            "--scalar",
            scalar,
        ];
        let found = counts(&folder, &flags);
        assert_eq!(found.len(), 2);
        assert_eq!(found[0], found[1]);
    }
    // The command on the screen runs it again, and it stands beside the published ones.
    let command = [
        "offset",
        "--scheme-cmd",
        "mine=./mine",
        "-n",
        "2000",
        "-q",
        "--point",
        "uv",
    ];
    let (screen, _) = ends(&folder, &command, 0);
    assert!(
        screen.contains("\nmine  ") && screen.contains("\nnone "),
        "{screen}"
    );
    let alone = [
        "--scheme-cmd",
        "mine=./mine",
        "-n",
        "2000",
        "--point",
        "uv",
        "--scheme",
        "mine",
    ];
    let record = json(&folder, &alone);
    let again = record["points"][0]["best"]["command"].as_str().unwrap();
    assert!(
        again.contains("--scheme-cmd mine=./mine --scheme mine --point uv"),
        "{again}"
    );
}

#[cfg(unix)]
#[test]
fn an_offset_over_a_pipe_that_answers_wrongly_ends_the_run() {
    let folder = scratch("offset-broken");
    for (command, part) in [
        (
            "x=sh -c 'while read x; do echo 1 2; done'",
            "expected finite numbers 'X Y Z' or 'X Y Z T_MIN'",
        ),
        (
            "x=sh -c 'while read x; do echo nan 2 3; done'",
            "for each hit, found 'nan 2 3'",
        ),
        (
            "x=sh -c 'while read x; do echo 1 2 3; done'",
            "expected 'end ",
        ),
        ("x=sh -c 'exit 3'", "scheme 'x': it"),
        ("x=true", "scheme 'x': it"),
    ] {
        let flags = [
            "offset",
            "--scheme",
            "x",
            "--scheme-cmd",
            command,
            "-n",
            "20",
            "-q",
        ];
        let (out, error) = ends(&folder, &[&flags[..], &["--point", "uv"]].concat(), 65);
        assert!(
            out.is_empty() && error.lines().count() == 1,
            "{command}: {error}"
        );
        assert!(error.contains(part), "{command}: {error}");
    }
}
