//! What the program calls proved, never wrong or bounded must survive the command's own flags. A table of commands and
//! what each may say.

use crate::program::{ends, flat, hairline, scratch};
use std::collections::BTreeMap;
use std::fs;

/// What a screen claims: a part of it, and whether it may be there.
struct Claim {
    flags: &'static [&'static str],
    part: &'static str,
    is_there: bool,
}

const fn says(flags: &'static [&'static str], part: &'static str) -> Claim {
    Claim {
        flags,
        part,
        is_there: true,
    }
}

const fn withholds(flags: &'static [&'static str], part: &'static str) -> Claim {
    Claim {
        flags,
        part,
        is_there: false,
    }
}

fn hold(folder: &str, command: &[&str], claims: &[Claim]) {
    let folder = scratch(folder);
    let mut screens: BTreeMap<&[&str], String> = BTreeMap::new();
    for Claim {
        flags,
        part,
        is_there,
    } in claims
    {
        let screen = screens.entry(flags).or_insert_with(|| {
            let (screen, _) = ends(&folder, &[command, flags, &["--details"]].concat(), 0);
            flat(&screen)
        });
        assert_eq!(
            screen.contains(part),
            *is_there,
            "{flags:?}: {part}\n{screen}"
        );
        assert!(
            command[0] != "offset" || !screen.contains("prove"),
            "{flags:?}\n{screen}"
        );
    }
}

const INSIDE: &str =
    "no wrong side on any ray of such a scene with u, v and 1-u-v from 0 to 1 no wrong side";
const BOUND: &str = "derived bound";

#[test]
fn an_offset_has_a_bound_only_where_the_flags_leave_the_weights_in_its_range() {
    hold(
        "claims-offset",
        &["offset", "-n", "300", "-q"],
        &[
            says(&[], INSIDE),
            withholds(&["--point", "ray"], BOUND),
            // Epsilons: of the edges and of others, with and without a dimension.
            says(&["--epsilon", "edge=0.01"], INSIDE),
            says(&["--epsilon", "edge=-50"], "u, v and 1-u-v from -99 to 199"),
            says(
                &["--epsilon", "edge=-50"],
                "the edge test lets no weight below -99 through",
            ),
            withholds(&["--epsilon", "edge=-50"], INSIDE),
            withholds(&[], "lets no other weights through"),
            says(&[], "axis-0: floors and walls at coordinate 0;"),
            withholds(&["--scene", "unit,plane=axis"], "floors and walls"),
            says(&["--epsilon", "parallel=0"], INSIDE),
            says(
                &["--kernel", "cramer", "--epsilon", "t=-1,edge=-0.5"],
                "from -0.5 to 2",
            ),
            says(&["--kernel", "woop-watertight"], INSIDE),
            withholds(
                &["--kernel", "woop-watertight", "--epsilon", "edge=-1e-9"],
                BOUND,
            ),
            says(
                &["--kernel", "plucker", "--epsilon", "edge=-0.25"],
                "from -0.25 to 1.5",
            ),
            withholds(
                &["--kernel", "scalar-triple", "--epsilon", "edge=-1e-9"],
                BOUND,
            ),
            withholds(
                &[
                    "--kernel",
                    "moller-trumbore-culling",
                    "--epsilon",
                    "edge=-1",
                ],
                BOUND,
            ),
            says(&["--kernel", "cramer", "--epsilon-preset", "godot"], INSIDE),
            // Arithmetics and contracts change neither the weights' range nor how points are formed.
            says(&["--kernel", "moller-trumbore+fma"], INSIDE),
            says(&["--kernel", "moller-trumbore+fma-ftz"], INSIDE),
            says(&["--contract", "open-ray"], INSIDE),
            says(&["--scalar", "f64"], INSIDE),
            // Scenes in which normals overflow or underflow.
            withholds(
                &["--scene", "extent=1e11,edge=5e10,distance=0..1e11"],
                BOUND,
            ),
            withholds(
                &[
                    "--scene",
                    "extent=3e-9,edge=1e-9..3e-9",
                    "--epsilon",
                    "parallel=0",
                ],
                BOUND,
            ),
            // A scheme of one's own is none of `normal=`, and another distance is not at the bound.
            withholds(&["--scheme", "normal=1e-3"], INSIDE),
        ],
    );
}

/// A kernel that hits everything at u = v = 2, whatever the ray.
#[cfg(unix)]
#[test]
fn a_kernel_of_ones_own_has_no_bound_if_its_weights_are_wrong() {
    let folder = scratch("claims-own");
    for weights in ["u=0.25 v=0.25", "u=2 v=2"] {
        let script = format!(
            "printf 'hairline-kernel 1\\nname mine\\nscalars f32\\ncontract closed-line\\ngives t uv\\nready\\n'
while read -r first id rest; do
    case \"$first\" in
        end) echo \"end $id\" ;;
        epsilons) ;;
        *) echo \"$id hit {weights}\" ;;
    esac
done
"
        );
        fs::write(folder.join("mine.sh"), script).unwrap();
        let flags = [
            "offset",
            "-n",
            "200",
            "-q",
            "--point",
            "uv",
            "--kernel-cmd",
            "sh mine.sh",
        ];
        // A kernel whose plain hits have other values than the exact ones is told nothing at all.
        let (screen, error) = ends(&folder, &flags, 1);
        assert!(
            screen.is_empty() && error.contains("of 1024 plain hits"),
            "{weights}\n{error}"
        );
    }
}

const PROVED: &str = "0: proved";
const BELOW: &str = "below the proved one";

#[test]
fn a_scene_has_proved_numbers_only_where_the_flags_keep_what_the_proof_supposes() {
    hold(
        "claims-scene",
        &["epsilon", "--scalar", "f32", "-n", "1000", "-q"],
        &[
            says(&["--kernel", "moller-trumbore"], PROVED),
            says(&["--kernel", "moller-trumbore-t"], PROVED),
            says(
                &["--kernel", "moller-trumbore", "--epsilon", "edge=-50"],
                PROVED,
            ),
            says(
                &[
                    "--kernel",
                    "moller-trumbore",
                    "--epsilon",
                    "parallel=0,t_min=3",
                ],
                PROVED,
            ),
            says(&["--kernel", "moller-trumbore+fma"], PROVED),
            says(
                &["--kernel", "moller-trumbore", "--contract", "open-ray"],
                PROVED,
            ),
            says(
                &[
                    "--kernel",
                    "moller-trumbore",
                    "--scene",
                    "room,sine=1e-6..1e-5",
                ],
                PROVED,
            ),
            // Flushed numbers have errors of their own; with another length of d the bound is another.
            withholds(&["--kernel", "moller-trumbore+ftz"], PROVED),
            withholds(&["--kernel", "moller-trumbore+ftz"], BELOW),
            withholds(
                &[
                    "--kernel",
                    "moller-trumbore",
                    "--scene",
                    "room,direction=target",
                ],
                PROVED,
            ),
            // The proof supposes more than a scene's sizes: a smallest divisor.
            withholds(&["--kernel", "woop-watertight"], PROVED),
            withholds(&["--kernel", "woop-watertight"], BELOW),
            withholds(&["--kernel", "plane-unit-normal"], PROVED),
        ],
    );
    let folder = scratch("claims-mesh");
    let mesh = concat!(env!("CARGO_MANIFEST_DIR"), "/corpora/meshes/icosphere.obj");
    let flags = [
        "epsilon",
        "--kernel",
        "moller-trumbore",
        "--scalar",
        "f32",
        "-n",
        "1000",
        "-q",
    ];
    for (scene, code) in [
        ("mesh", 0),
        ("mesh,edge=0.01..0.02", 2),
        ("mesh,extent=0.1", 2),
    ] {
        let all = [&flags[..], &["--mesh", mesh, "--scene", scene]].concat();
        let (screen, _) = ends(&folder, &[&all[..], &["--details"]].concat(), code);
        assert_eq!(screen.contains(PROVED), code == 0, "{scene}\n{screen}");
    }
}

#[test]
fn what_prove_says_names_its_domain() {
    hold(
        "claims-prove",
        &["prove", "-n", "0", "--scalar", "f32"],
        &[
            says(
                &["--kernel", "woop-watertight"],
                "Watertight at its edges at an epsilon of 0 or less",
            ),
            withholds(
                &["--kernel", "woop-watertight+fma"],
                "Watertight at its edges at",
            ),
            withholds(
                &["--kernel", "moller-trumbore"],
                "Watertight at its edges at",
            ),
        ],
    );
    let folder = scratch("claims-ftz");
    assert_eq!(
        hairline(&folder, &["prove", "--kernel", "plucker+ftz"])
            .status
            .code(),
        Some(4)
    );
}

#[test]
fn numbers_that_are_no_good_are_not_to_be_used() {
    const FAR: &str = "extent=1000,center=500000,edge=1..50,distance=0..2000";
    hold(
        "claims-good",
        &["epsilon", "--scalar", "f32", "-n", "1000", "-q", "--scene"],
        &[
            says(&[FAR, "--kernel", "baldwin-weber"], " least bad: --epsilon"),
            says(
                &[FAR, "--kernel", "baldwin-weber"],
                "No numbers are good here",
            ),
            withholds(&[FAR, "--kernel", "baldwin-weber"], " use --"),
            withholds(&[FAR, "--kernel", "baldwin-weber"], "recommended,"),
            says(&["room", "--kernel", "moller-trumbore"], " use --epsilon"),
        ],
    );
}

#[test]
fn an_audit_of_a_scene_draws_every_kind_of_planes_and_rays_unless_one_is_named() {
    const AT_ZERO: &str = "axis-0: floors and walls at coordinate 0";
    const BOXES: &str = "box: boxes along the axes";
    let squeezed = |text: String| text.split_whitespace().collect::<Vec<_>>().join(" ");
    let folder = scratch("claims-planes");
    for (flags, parts) in [
        (&["--scene", "room"][..], [true, true]),
        (&["--scene", "room,center=100"], [false, true]),
        (&["--scene", "room,plane=generic"], [false, false]),
        (&["--scene", "room,plane=axis-0"], [false, false]),
        (&["--scene", "room,toward=axis"], [false, false]),
        (&["--scene", "room,plane=box,toward=axis"], [false, false]),
        (&["--family", "interior"], [false, false]),
    ] {
        let all = [
            &["audit", "-n", "20", "-q", "--kernel", "cramer"][..],
            flags,
        ]
        .concat();
        let screen = squeezed(ends(&folder, &all, 0).0);
        assert_eq!(
            [AT_ZERO, BOXES].map(|part| screen.contains(part)),
            parts,
            "{flags:?}\n{screen}"
        );
        // A kind that is not tried by itself is none of a mesh's.
        assert!(!screen.contains("mesh"), "{flags:?}\n{screen}");
    }
}

#[test]
fn an_audit_of_a_scene_says_on_which_planes_a_kernel_is_more_often_wrong() {
    let folder = scratch("claims-elsewhere");
    let flags = [
        "audit",
        "-n",
        "2000",
        "-q",
        "--kernel",
        "woop-watertight",
        "--scalar",
        "f32",
    ];
    let (screen, _) = ends(&folder, &[&flags[..], &["--scene", "room"]].concat(), 0);
    let line = screen
        .lines()
        .find(|line| line.contains("f32: ends"))
        .expect(&screen);
    let words: Vec<&str> = line.split_whitespace().rev().take(3).collect();
    let [kind, most, own] = words[..] else {
        panic!("{line}")
    };
    let percent = |word: &str| word.trim_end_matches('%').parse::<f64>().unwrap();
    // Shadow rays from floors at coordinate 0 start there exactly, so their t is 0: 0 <= t accepts half of them. Segments
    // that end at their target are half of the rest, on any plane.
    assert!(
        kind.starts_with("axis") && percent(own) + 8.0 < percent(most),
        "{line}"
    );
    let json = ["--scene", "room", "--format", "json"];
    let record: serde_json::Value =
        serde_json::from_str(&ends(&folder, &[&flags[..], &json].concat(), 0).0).unwrap();
    let sources = record["result"]["plan"]["sources"].as_array().unwrap();
    let names: Vec<&str> = sources
        .iter()
        .map(|it| it["family"].as_str().unwrap())
        .collect();
    // Eight strata; rays along axes are in six, which are not about the angle to the plane.
    assert_eq!(names.len(), 8 * 6 + 6 * 3, "{names:?}");
    for name in [
        "scene-shadow",
        "scene-shadow:axis-0",
        "scene-edges:axis+axis-rays",
    ] {
        assert!(names.contains(&name), "{name}");
    }
}

#[test]
fn angles_that_no_ray_has_are_counted_and_said() {
    const FAR: &str = "extent=1000,center=500000,edge=10..50,distance=15..20,sine=1e-6..1e-5";
    const NOTE: &str = "almost parallel rays in f32: none of 4096 tries has it";
    let folder = scratch("claims-angles");
    let flags = [
        "audit", "-n", "20", "--kernel", "cramer", "--scalar", "f32", "--scene",
    ];
    for (scene, more, is_said) in [
        (FAR, &[][..], true),
        (FAR, &["-q"], false),
        (FAR, &["--family", "scene-edges"], false),
        ("room,sine=1e-5..1e-4", &[], false),
        ("room", &[], false),
    ] {
        let (_, notes) = ends(&folder, &[&flags[..], &[scene], more].concat(), 0);
        assert_eq!(notes.contains(NOTE), is_said, "{scene} {more:?}\n{notes}");
    }
}

/// `check` must not call a kernel proved that the plan runs in another way.
#[test]
fn a_demand_is_not_met_by_a_proof_of_something_else_than_what_runs() {
    let folder = scratch("claims-check");
    let plan =
        "family = \"interior\"\nscalar = \"f32\"\ncount = 10\nkernel = \"woop-watertight\"\n";
    let demand = "[proved]\nwoop-watertight.f32.watertight = true\n";
    for (settings, why) in [
        ("", None),
        ("epsilon = \"edge=-1e-9\"\n", None),
        (
            "epsilon = \"edge=1e-9\"\n",
            Some("the plan runs it at edge=1e-9, above 0"),
        ),
        (
            "arithmetic = \"fma\"\n",
            Some("the plan runs woop-watertight+fma in its place"),
        ),
        ("arithmetic = \"ieee,fma\"\n", None),
    ] {
        fs::write(
            folder.join("hairline.toml"),
            format!("{plan}{settings}{demand}"),
        )
        .unwrap();
        let output = hairline(&folder, &["check", "-q"]);
        let text = flat(&String::from_utf8_lossy(&output.stdout));
        let is_missing = text.contains("must be proved watertight");
        assert_eq!(is_missing, why.is_some(), "{settings}: {text}");
        assert!(
            why.is_none_or(|why| text.contains(why)),
            "{settings}: {text}"
        );
    }
}

#[test]
fn values_are_free_where_the_contract_leaves_the_direction_out() {
    let folder = scratch("claims-direction");
    let case = ["explain", "sliver@3/f32/-/1/593", "--kernel", "half-space"];
    let unit = ["--contract", "own,direction=unit:4"];
    let screen = ends(&folder, &case, 0).0;
    assert!(
        screen.contains("wrong-value") && screen.contains("wrong t: reported"),
        "{screen}"
    );
    let screen = ends(&folder, &[&case[..], &unit].concat(), 0).0;
    assert!(!screen.contains("wrong"), "{screen}");
}

#[test]
fn a_contract_that_tolerates_more_of_the_values_has_fewer_findings() {
    let folder = scratch("claims-values");
    let count = |words: &str| {
        let flags = [
            "audit",
            "--kernel",
            "baldwin-weber",
            "--scalar",
            "f32",
            "-n",
            "3000",
            "-q",
        ];
        let more = [
            "--family",
            "sliver",
            "--format",
            "json",
            "--contract",
            words,
        ];
        let json = ends(&folder, &[&flags[..], &more].concat(), 0).0;
        let record: serde_json::Value = serde_json::from_str(&json).unwrap();
        record["result"]["results"][0]["total"]["wrong_values"]["count"]
            .as_u64()
            .unwrap()
    };
    let [own, tiny, small, free] = [
        "own",
        "own,values=1e-6",
        "own,values=1e-3",
        "own,values=free",
    ]
    .map(count);
    assert!(
        0 == free && free < small && small < own && tiny <= own,
        "{own} {tiny} {small}"
    );
    let case = [
        "explain",
        "sliver@3/f32/-/1/593",
        "--kernel",
        "half-space",
        "--contract",
    ];
    let far = ends(&folder, &[&case[..], &["own,values=1e-9"]].concat(), 0).0;
    let free = ends(&folder, &[&case[..], &["own,values=free"]].concat(), 0).0;
    assert!(
        far.contains("wrong t: reported") && !free.contains("wrong"),
        "{far}\n{free}"
    );
}
