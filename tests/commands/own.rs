//! Kernels of one's own: in the registry, in every command's tables, and from a test.

use crate::tools::not_tested;
use hairline::ErrorKind;
use hairline::internals::arith::{Real, Vector};
use hairline::internals::audit::{self, EpsilonChoice};
use hairline::internals::case::{Case, Parameters, Ray, Triangle};
use hairline::internals::contract::{Across, Boundary, Contract, Demand, Extent, Sides};
use hairline::internals::kernel::{
    Entry, EpsilonSet, Gate, Gives, Hit, Kernel, KernelInfo, Refuse, Role, Scalar, Sink, all, find,
    register,
};
use hairline::{Error, ScalarName};
use std::panic::{AssertUnwindSafe, catch_unwind};

/// Signed volumes, in every arithmetic, with an epsilon on the determinant.
struct Volumes;

impl Kernel for Volumes {
    const INFO: KernelInfo = KernelInfo {
        gates: &[
            Gate::non_negative(Role::Parallel, "abs(det) < e", 2, 1),
            Gate::signed(Role::Edge, "min(u, v, w) < e, all of det's sign", 2, 1),
        ],
        epsilon_sets: &[EpsilonSet {
            name: "own",
            values: &["1e-3", "0"],
        }],
        gives: Gives {
            t: true,
            uv: true,
            facing: false,
        },
        ..KernelInfo::own(
            "volumes",
            Contract::of_kernel(Extent::Line, Sides::Both, Boundary::Closed)
                .with_flat(Demand::Free, Demand::Free),
        )
    };

    type Prepared<V: Vector> = Triangle<V>;

    fn prepare<V: Vector>(triangle: &Triangle<V>) -> Triangle<V> {
        triangle.clone()
    }

    fn test<V: Vector, S: Sink<V::Real>>(
        Triangle { a, b, c }: &Triangle<V>,
        Ray {
            origin, direction, ..
        }: &Ray<V>,
        sink: &mut S,
    ) -> Option<Hit<V::Real>> {
        let [a, b, c] = [a, b, c].map(|vertex| vertex.minus(origin));
        let volume = |p: &V, q: &V| direction.dot(&p.cross(q));
        let (u, v, w) = (volume(&b, &c), volume(&c, &a), volume(&a, &b));
        let det = u.clone() + &v + &w;
        sink.one(0, Refuse::Below, &det.abs())?;
        let sign = if det.is_sign_negative() {
            -V::Real::one()
        } else {
            V::Real::one()
        };
        for volume in [&u, &v, &w] {
            sink.one(1, Refuse::Below, &(volume.clone() * &sign))?;
        }
        let normal = b.minus(&a).cross(&c.minus(&a));
        let t = normal.dot(&a) / normal.dot(direction);
        Some(Hit {
            t: Some(t),
            uv: Some((v / &det, w / &det)),
            facing: None,
        })
    }
}

/// Hits whatever the ray does.
/// The t of the plane, whether the hit is in the triangle or not.
fn always<F: Scalar>(case: &Case<F>, _: &[F]) -> Option<Hit<F>> {
    let Triangle { a, b, c } = case.triangle;
    let normal = b.minus(&a).cross(&c.minus(&a));
    let t = normal.dot(&a.minus(&case.ray.origin)) / normal.dot(&case.ray.direction);
    Some(Hit::at(if t.is_finite() { t } else { F::zero() }))
}

const ALWAYS: KernelInfo = KernelInfo::own("always", Contract::CLOSED_RAY);

#[test]
fn a_kernel_for_every_arithmetic_has_margins_and_exact_runs() {
    let kernel = Entry::of::<Volumes>();
    assert_eq!(kernel.scalars(), [true, true]);
    // On integers its float run is its exact run.
    hairline::audit(&kernel)
        .families(["lattice"])
        .count(20_000)
        .assert_conforms();
    let case = Case::<f32>::new(
        [1., 1., 3.],
        [0., 0., -2.],
        [[0.; 3], [4., 0., 0.], [0., 4., 0.]],
    );
    let gated = f32::subject(&kernel)
        .unwrap()
        .gated()
        .expect("shows its gates");
    // det = d·((b-a)×(c-a)) up to sign: 2·16; the smallest volume belongs to a = b = c's weight 1/4.
    assert_eq!(gated.measure(&case).margins, [32.0, 8.0]);
    assert_eq!(gated.run_exact(&case, &[33.0, 8.0]).passed, [false, true]);
}

#[test]
fn a_kernel_in_one_scalar_runs_in_that_one_alone() {
    let kernel = Entry::new(&ALWAYS).f64(always::<f64>);
    let outcome = hairline::audit(&kernel)
        .families(["interior", "outside"])
        .run()
        .unwrap();
    let results = &outcome.record.result.results;
    assert!(
        results
            .iter()
            .all(|result| result.scalar == ScalarName::F64)
    );
    let count = |family: &str| {
        let result = results
            .iter()
            .find(|result| result.family == family)
            .unwrap();
        (
            result.total.false_misses.count,
            result.total.false_hits.count,
            result.total.hits,
        )
    };
    assert_eq!(count("interior"), (0, 0, 2000));
    assert_eq!(count("outside"), (0, 2000, 2000));
}

/// Watches nothing.
struct Silent;

impl audit::Observer for Silent {
    fn advance(&self, _: u64) {}
    fn now(&self) -> u64 {
        0
    }
}

#[test]
fn rows_of_different_scalars_keep_their_places() {
    const NEVER: KernelInfo = KernelInfo::own("never", Contract::CLOSED_RAY);
    let leak = |entry: Entry| -> &'static Entry { Box::leak(Box::new(entry)) };
    let entries = [
        leak(Entry::new(&ALWAYS).f64(always::<f64>)),
        leak(Entry::new(&NEVER).f32(|_: &Case<f32>, _: &[f32]| None)),
        leak(Entry::new(&ALWAYS).f32(always::<f32>)),
    ];
    let plan = audit::Plan::new(
        EpsilonChoice::Source.rows(&entries, None).unwrap(),
        vec![audit::Source::of(
            hairline::internals::family::find("interior").unwrap(),
            Parameters::default(),
            1,
            10,
        )],
        [true, true],
        1,
    );
    let cells = audit::run(&plan, &Silent).cells;
    let hits: Vec<_> = cells
        .iter()
        .map(|cell| (cell.row, cell.scalar, cell.tally.total().hits))
        .collect();
    assert_eq!(
        hits,
        [
            (1, ScalarName::F32, 0),
            (2, ScalarName::F32, 10),
            (0, ScalarName::F64, 10)
        ]
    );
}

#[test]
fn a_registered_kernel_is_in_every_table_and_its_name_is_taken() {
    const INFO: KernelInfo = KernelInfo::own("registered-mine", Contract::CLOSED_RAY);
    let kernel = Entry::new(&INFO).f32(always::<f32>);
    let entry = register(kernel).unwrap();
    assert!(find("registered-mine").is_some() && all().len() > 16);
    assert_eq!(entry.selector(), "--kernel registered-mine");
    assert!(
        register(kernel)
            .err()
            .unwrap()
            .contains("two kernels of the name")
    );
    const TAKEN: KernelInfo = KernelInfo::own("cramer", Contract::CLOSED_RAY);
    assert!(
        register(Entry::new(&TAKEN))
            .err()
            .unwrap()
            .contains("'cramer'")
    );
    const TWO_WORDS: KernelInfo = KernelInfo::own("two words", Contract::CLOSED_RAY);
    assert!(
        register(Entry::new(&TWO_WORDS))
            .err()
            .unwrap()
            .contains("is no name")
    );
}

#[test]
fn a_failed_assertion_reads_like_this() {
    let kernel = Entry::new(&ALWAYS).f32(always::<f32>);
    let request = hairline::audit(&kernel)
        .families(["behind"])
        .count(3)
        .seed(7);
    let panic = catch_unwind(AssertUnwindSafe(|| request.assert_conforms())).unwrap_err();
    let message = panic.downcast_ref::<String>().unwrap();
    let lines: Vec<&str> = message.lines().collect();
    assert_eq!(
        lines[0],
        "always (own) breaks its contract: ray, both sides, closed, coplanar miss, degenerate miss, invalid miss"
    );
    // 0.025: the closed form of the interval of 1 of 1.
    let edges = "f32 behind (own): false-hit edge/back/before: 1 of 1 (100.0% [2.5%, 100.0%])";
    assert!(
        lines.contains(&edges) && message.contains("\n        o=42000000,"),
        "{message}"
    );
    // A kernel of one's own is known to its own tests only; the case is also there as Rust.
    let command = "\n    HAIRLINE_CASE='behind@2/f32/-/7/";
    assert!(message.contains(command), "{message}");
    let test = " cargo test own::a_failed_assertion_reads_like_this\n        Case::<f32>::new([32.0, 0.0, -14.0], ";
    assert!(message.contains(test), "{message}");
    let passes = hairline::audit(&kernel).families(["interior"]).count(50);
    passes.assert_conforms();
    assert!(
        passes
            .run()
            .unwrap()
            .to_string()
            .contains("always (own) keeps its contract")
    );
}

#[test]
fn the_command_of_a_failed_test_explains_the_case_with_the_kernel_of_that_test() {
    let explained = |case: &str| {
        let mut command = std::process::Command::new(std::env::current_exe().unwrap());
        let test = "own::a_kernel_that_always_hits_is_held_to_its_contract";
        let output = command
            .args(["--exact", test])
            .env("HAIRLINE_CASE", case)
            .output()
            .unwrap();
        String::from_utf8_lossy(&output.stdout).into_owned()
    };
    let text = explained("behind@2/f32/-/7/1");
    let expected = "\nalways (own): hit; its contract asks a miss: FALSE-HIT\n";
    assert!(text.contains(expected) && text.contains("before"), "{text}");
    let unknown = explained("nowhere@1/f32/-/7/1");
    let expected = "HAIRLINE_CASE: this program makes no cases of 'nowhere@1'";
    assert!(unknown.contains(expected), "{unknown}");
}

/// The test that the one before runs with a case in the environment.
#[test]
fn a_kernel_that_always_hits_is_held_to_its_contract() {
    let kernel = Entry::new(&ALWAYS).f32(always::<f32>);
    hairline::audit(&kernel)
        .families(["interior"])
        .count(50)
        .assert_conforms();
}

#[test]
fn a_panic_is_a_finding_and_the_run_goes_on() {
    let sometimes = |case: &Case<f32>, _: &[f32]| {
        let [origin, ..] = case.vectors();
        assert!(origin[0] >= 0.0, "not this one");
        Some(Hit::at(1.0))
    };
    let kernel = Entry::new(&ALWAYS).f32(sometimes);
    let outcome = hairline::audit(&kernel)
        .families(["interior"])
        .count(400)
        .run()
        .unwrap();
    let total = &outcome.record.result.results[0].total;
    assert!((100..300).contains(&total.panics), "{}", total.panics);
    assert_eq!(total.panics + total.hits, 400);
    // Where there is no verdict it is not wrong, nor right.
    assert_eq!(
        (total.false_misses.of, total.false_misses.count),
        (total.hits, 0)
    );
}

#[test]
fn a_promise_across_triangles_is_part_of_the_contract() {
    const NEVER: KernelInfo = KernelInfo::own(
        "never",
        Contract {
            boundary: Boundary::Free,
            ..Contract::CLOSED_RAY
        }
        .with_across(Across::AtLeastOne),
    );
    let kernel = Entry::new(&NEVER).f32(|_: &Case<f32>, _: &[f32]| None);
    let outcome = hairline::audit(&kernel)
        .families(["fan"])
        .count(200)
        .run()
        .unwrap();
    assert!(!outcome.conforms());
    assert!(
        outcome.to_string().contains("fan (own): crack of group: "),
        "{outcome}"
    );
}

/// Signed volumes that panic on every polygon of five corners.
struct NoPentagons;

impl Kernel for NoPentagons {
    const INFO: KernelInfo = KernelInfo {
        name: "no-pentagons",
        polygons: true,
        ..<Volumes as Kernel>::INFO
    };

    type Prepared<V: Vector> = Triangle<V>;

    fn prepare<V: Vector>(triangle: &Triangle<V>) -> Triangle<V> {
        triangle.clone()
    }

    fn test<V: Vector, S: Sink<V::Real>>(
        triangle: &Triangle<V>,
        ray: &Ray<V>,
        sink: &mut S,
    ) -> Option<Hit<V::Real>> {
        Volumes::test(triangle, ray, sink)
    }

    fn test_polygon<V: Vector, S: Sink<V::Real>>(
        vertices: &[V],
        _: &Ray<V>,
        _: &mut S,
    ) -> Option<Hit<V::Real>> {
        assert_ne!(vertices.len(), 5);
        None
    }
}

#[test]
fn a_panic_on_a_polygon_is_a_finding_with_its_place_and_command() {
    let kernel = Entry::of::<NoPentagons>();
    let outcome = hairline::audit(&kernel)
        .families(["polygon"])
        .count(300)
        .run()
        .unwrap();
    let family = hairline::internals::family::find("polygon").unwrap();
    // A pentagon is a fan of three triangles.
    let made = (0..300).map(|i| {
        family
            .make::<f32>(&Parameters::default(), 1, i)
            .cases()
            .len()
    });
    let pentagons: Vec<usize> = (0..)
        .zip(made)
        .filter(|(_, n)| *n == 3)
        .map(|(i, _)| i)
        .collect();
    assert!(pentagons.len() > 10);
    let found = hairline::internals::record::disagreements(&outcome.record.result);
    let panics = found.iter().find(|found| {
        let key = &found.key;
        (key.scalar.name(), key.class.name(), key.finding.name()) == ("f32", "polygon", "panic")
    });
    let panics = panics.expect("panics on polygons");
    assert_eq!(
        (panics.rate.count, panics.rate.of),
        (pentagons.len() as u64, 300)
    );
    let example = panics.example.as_ref().expect("a place");
    assert_eq!(example.case, format!("polygon@2/f32/-/1/{}", pentagons[0]));
    assert!(
        example
            .command
            .starts_with(&format!("hairline explain '{}'", example.case))
    );
    assert!(outcome.to_string().contains("panic"), "{outcome}");
}

#[test]
fn names_and_epsilons_that_there_are_none_of_are_errors() {
    let kernel = Entry::of::<Volumes>();
    let error = |error: Result<_, Error>| error.map(|_: hairline::Outcome| ()).unwrap_err();
    let family = error(hairline::audit(&kernel).families(["edge-nera"]).run());
    let line = "unknown family 'edge-nera'; did you mean 'edge-near'?";
    assert_eq!(
        (family.kind(), family.to_string()),
        (ErrorKind::UnknownName, line.to_owned())
    );
    let gate = error(hairline::audit(&kernel).epsilons(&[("paralel", "0")]).run());
    assert_eq!(gate.kind(), ErrorKind::UnknownName);
    let gate = gate.to_string();
    assert!(gate.contains("did you mean 'parallel'?"), "{gate}");
    let kinds = [
        (&[("parallel", "1e-400")][..], ErrorKind::OutOfRange),
        (&[("parallel", "much")], ErrorKind::Syntax),
        (&[("edge", "0"), ("edge", "0")], ErrorKind::Repeated),
    ];
    for (epsilons, kind) in kinds {
        let error = error(hairline::audit(&kernel).epsilons(epsilons).run());
        assert_eq!(error.kind(), kind, "{error}");
    }
    let unwritable = Error::of_file("x", std::io::ErrorKind::PermissionDenied.into());
    assert_eq!(unwritable.kind(), ErrorKind::File);
    assert!(std::error::Error::source(&unwritable).is_some());
    let given = EpsilonChoice::Given(vec![("parallel".to_owned(), "1e-2".to_owned())]);
    let leaked: &'static Entry = Box::leak(Box::new(kernel));
    assert_eq!(
        given.rows(&[leaked], None).unwrap()[0].epsilons::<f32>(),
        [1e-2, 0.0]
    );
}

#[test]
fn the_example_is_the_whole_program_with_two_kernels_in_it() {
    let program = std::path::Path::new(env!("CARGO_BIN_EXE_hairline"));
    let program = program.with_file_name("examples").join("own_kernel");
    if !program.exists() {
        // `cargo test` builds the examples, `cargo test --test commands` does not.
        not_tested(&format!("{} is not built", program.display()));
        return;
    }
    let run = |arguments: &[&str]| {
        let output = std::process::Command::new(&program)
            .args(arguments)
            .output()
            .unwrap();
        let text = |bytes: &[u8]| String::from_utf8(bytes.to_vec()).unwrap();
        (
            output.status.code(),
            text(&output.stdout),
            text(&output.stderr),
        )
    };
    let (_, listed, _) = run(&["list", "kernels"]);
    assert!(
        listed.starts_with("mine\n") && listed.contains("\nmoller-trumbore\n"),
        "{listed}"
    );
    // Who names no kernel means these.
    let (_, rows, error) = run(&[
        "audit", "-n", "20", "--family", "interior", "--format", "json",
    ]);
    let rows: serde_json::Value = serde_json::from_str(&rows).expect(&error);
    let names = rows["result"]["plan"]["rows"].as_array().unwrap().iter();
    let names: Vec<&str> = names.map(|row| row["kernel"].as_str().unwrap()).collect();
    assert_eq!(names, ["mine", "bounding-box"]);
    let (code, _, error) = run(&["audit", "--kernel", "bounding-bx"]);
    assert!(
        code == Some(2) && error.contains("did you mean 'bounding-box'?"),
        "{error}"
    );
    let kernels = "mine,bounding-box,cramer";
    let (code, table, _) = run(&[
        "audit",
        "--details",
        "--kernel",
        kernels,
        "-n",
        "300",
        "--family",
        "interior",
    ]);
    assert_eq!(code, Some(0));
    // Each in its own scalar: mine in f32, the box in f64, the built-in one in both.
    let count = |label: &str| table.lines().filter(|line| line.starts_with(label)).count();
    // The screen's table and that of its scalar, and a part of its own.
    assert_eq!([count("mine  "), count("mine (own)")], [2, 1], "{table}");
    // Its t is not that of the triangle, which a note says first.
    assert_eq!(
        [count("bounding-box  "), count("bounding-box (own)")],
        [2, 1 + 1],
        "{table}"
    );
    // It is judged by the interval, mine by the ray: with as few wrong answers they have a row each.
    assert_eq!(
        [count("cramer  "), count("cramer (source)")],
        [3, 1],
        "{table}"
    );
    let (code, _, error) = run(&["audit", "--kernel", "mine", "--scalar", "f64"]);
    assert!(
        code == Some(4) && error.contains("mine runs in f32 alone: write --scalar f32, or leave"),
        "{error}"
    );
    let (_, shown, _) = run(&[
        "explain",
        "interior@2/f64/-/1/1",
        "--kernel",
        "mine,bounding-box",
    ]);
    assert!(shown.contains("mine (own): does not run in f64"), "{shown}");
    assert!(shown.contains("bounding-box (own): hit;"), "{shown}");
    // Nobody sees its gates, so it runs at many epsilons.
    let (code, shown, error) = run(&[
        "epsilon", "--kernel", "mine", "--family", "interior", "-n", "50",
    ]);
    assert!(
        code == Some(0) && shown.contains("mine f32 on interior"),
        "{shown}{error}"
    );
    let (code, shown, error) = run(&["epsilon", "--kernel", "mine", "-n", "300"]);
    assert!(
        code == Some(0) && shown.contains("use  --epsilon t="),
        "{shown}{error}"
    );
}
