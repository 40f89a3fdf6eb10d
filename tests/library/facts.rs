//! Known facts about the kernels come out of a run.

use hairline::ScalarName;
use hairline::internals::arith::Float;
use hairline::internals::audit::{
    Audit, EpsilonChoice, Observer, Plan, Row, Source, Stock, Tally, run,
};
use hairline::internals::case::{Case, Parameters};
use hairline::internals::family;
use hairline::internals::judge::{Class, Finding};
use hairline::internals::kernel::{self, KERNELS, Scalar, Verdict};
use std::sync::LazyLock;

struct Quiet;

impl Observer for Quiet {
    fn advance(&self, _: u64) {}
    fn now(&self) -> u64 {
        0
    }
}

fn rows(kernels: &[&str], contract: Option<&str>) -> Vec<Row> {
    let entries: Vec<_> = kernels
        .iter()
        .map(|name| kernel::find(name).unwrap())
        .collect();
    EpsilonChoice::Source.rows(&entries, contract).unwrap()
}

/// Runs kernels, with the epsilons of their sources, on a family.
fn audit(kernels: &[&str], name: &str, count: u64) -> (Plan, Audit) {
    let family = family::find(name).unwrap();
    audit_of(
        rows(kernels, None),
        Source::of(family, Parameters::default(), 1, count),
    )
}

fn audit_of(rows: Vec<Row>, source: Source) -> (Plan, Audit) {
    let plan = Plan::new(rows, vec![source], [true, true], 1);
    let audit = run(&plan, &Quiet);
    (plan, audit)
}

/// The whole lattice, once for all tests that look at it.
static LATTICE: LazyLock<(Plan, Audit)> = LazyLock::new(|| {
    let kernels = [
        "plane-inside-out",
        "cramer",
        "moller-trumbore",
        "scalar-triple",
        "woop-watertight",
        "plucker",
        "havel-herout",
    ];
    let two_sided = rows(&["scalar-triple-two-sided"], Some("closed-line"));
    let stock = Stock::Whole(family::find("lattice").unwrap());
    let source = Source {
        stock,
        parameters: Parameters::default(),
        seed: 1,
        count: 0,
    };
    audit_of([rows(&kernels, None), two_sided].concat(), source)
});

fn tally<'a>((plan, audit): &'a (Plan, Audit), scalar: ScalarName, label: &str) -> &'a Tally {
    let found = audit
        .cells
        .iter()
        .find(|cell| cell.scalar == scalar && plan.rows[cell.row].label() == label);
    &found.unwrap().tally
}

fn of_class(tally: &Tally, name: &str) -> hairline::internals::audit::ClassCount {
    tally.classes[Class::all()
        .find(|class| class.name() == name)
        .unwrap()
        .number()]
}

fn false_misses(tally: &Tally) -> u64 {
    tally.total().of(Finding::FalseMiss)
}

#[test]
fn false_misses_over_the_whole_lattice_are_those_known() {
    let run = &*LATTICE;
    for (label, in_f32, in_f64) in [
        ("plane-inside-out (zero)", 33_552, 29_520),
        ("plane-inside-out (1e-6)", 33_552, 29_520),
        ("cramer (source)", 25_632, 0),
        ("moller-trumbore (source)", 0, 0),
        ("scalar-triple (source)", 0, 0),
        ("woop-watertight (source)", 0, 0),
        ("plucker (source)", 0, 0),
    ] {
        assert_eq!(
            false_misses(tally(run, ScalarName::F32, label)),
            in_f32,
            "{label} in f32"
        );
        assert_eq!(
            false_misses(tally(run, ScalarName::F64, label)),
            in_f64,
            "{label} in f64"
        );
    }
    // All three products are zero on a coplanar line, so scalar-triple hits with NaN coordinates.
    for scalar in ScalarName::ALL {
        let coplanar = of_class(tally(run, scalar, "scalar-triple (source)"), "coplanar");
        assert_eq!(coplanar.hits, coplanar.cases);
        assert_eq!(coplanar.of(Finding::BadValue), coplanar.cases);
    }
}

#[test]
fn scalar_triple_two_sided_misses_every_exact_edge_of_the_lattice() {
    for scalar in ScalarName::ALL {
        let found = tally(&LATTICE, scalar, "scalar-triple-two-sided (source)");
        for class in ["edge/front/within", "edge/back/within", "edge/front/before"] {
            let edges = of_class(found, class);
            assert!(edges.must_hit > 100_000);
            assert_eq!(
                edges.of(Finding::FalseMiss),
                edges.must_hit,
                "{scalar} {class}"
            );
        }
    }
}

#[test]
fn havel_herout_treats_lattice_edges_differently_by_side() {
    let found = tally(&LATTICE, ScalarName::F32, "havel-herout (source)");
    let share = |class: &str| {
        let count = of_class(found, class);
        count.hits as f64 / count.cases as f64
    };
    // An independent run saw 93 % with D > 0 and 6.5 % with D < 0.
    assert!(
        (0.92..0.95).contains(&share("edge/back/within")),
        "{}",
        share("edge/back/within")
    );
    assert!(
        (0.06..0.07).contains(&share("edge/front/within")),
        "{}",
        share("edge/front/within")
    );
}

#[test]
fn a_positive_edge_epsilon_loses_exact_edges() {
    let kernels = ["plane-unit-normal"];
    let run = audit(&kernels, "edge-exact", 5000);
    for scalar in ScalarName::ALL {
        let zero = tally(&run, scalar, "plane-unit-normal (zero)").total();
        let positive = tally(&run, scalar, "plane-unit-normal (1e-6)").total();
        assert!(
            positive.of(Finding::FalseMiss) > 2 * zero.of(Finding::FalseMiss),
            "{scalar}"
        );
        assert!(
            positive.of(Finding::FalseMiss) * 2 > positive.must_hit,
            "{scalar}"
        );
    }
}

#[test]
fn an_absolute_determinant_epsilon_loses_tiny_triangles() {
    let run = audit(&["plane-inside-out"], "tiny", 5000);
    for scalar in ScalarName::ALL {
        let zero = tally(&run, scalar, "plane-inside-out (zero)").total();
        let positive = tally(&run, scalar, "plane-inside-out (1e-6)").total();
        assert_eq!(
            positive.of(Finding::FalseMiss),
            positive.must_hit,
            "{scalar}"
        );
        assert!(zero.of(Finding::FalseMiss) * 4 < zero.must_hit, "{scalar}");
    }
}

#[test]
fn woop_leaves_no_crack_but_misses_triangle_by_triangle() {
    let label = "woop-watertight (source)";
    for name in ["shared-edge", "fan"] {
        let run = audit(&["woop-watertight"], name, 50_000);
        let groups = &tally(&run, ScalarName::F32, label).groups;
        assert!(groups.crossings > 10_000);
        assert_eq!(groups.cracks, 0, "{name}");
        if name == "shared-edge" {
            assert!(groups.missed_folds > 0, "at a fold it may miss both");
        }
    }
    let run = audit(&["woop-watertight"], "edge-near", 20_000);
    assert!(false_misses(tally(&run, ScalarName::F32, label)) > 0);
}

#[test]
fn nan_input_hits_or_misses_as_each_source_is_coded() {
    fn hits<F: Scalar>(entry: &kernel::Entry) -> Vec<bool> {
        let nan = F::from_f64(f64::NAN);
        let case = Case::new([nan; 3], [nan; 3], [[nan; 3]; 3]);
        let all = EpsilonChoice::Source
            .rows(&[kernel::find(entry.info.name).unwrap()], None)
            .unwrap();
        let run = |epsilons: Vec<F>| {
            let mut verdict = [Verdict::miss(None)];
            F::subject(entry)
                .unwrap()
                .run(&[case], &epsilons, &mut verdict);
            verdict[0].hit
        };
        all.iter().map(|row| run(row.epsilons())).collect()
    }
    for entry in KERNELS {
        for hit in [hits::<f32>(entry), hits::<f64>(entry)].concat() {
            assert_eq!(hit, hits_nan(entry.info.name), "{}", entry.info.name);
        }
    }
}

/// True if a kernel, in whatever arithmetic, hits when every coordinate is NaN, as its source writes its comparisons.
pub fn hits_nan(name: &str) -> bool {
    let (kernel, _) = name.split_once('+').unwrap_or((name, ""));
    match kernel {
        "plane-unit-normal"
        | "scalar-triple"
        | "scalar-triple-shared"
        | "cramer"
        | "plane-inside-out"
        | "plane-inside-out-precomputed"
        | "convex-polygon"
        | "moller-trumbore"
        | "moller-trumbore-culling"
        | "woop-watertight"
        | "havel-herout" => true,
        "half-space"
        | "scalar-triple-two-sided"
        | "plane-inside-out-strict"
        | "moller-trumbore-t"
        | "plucker"
        | "baldwin-weber" => false,
        other => panic!("{other} is not known here"),
    }
}

#[test]
fn convex_polygon_is_plane_inside_out_on_triangles_and_right_on_lattice_polygons() {
    fn verdicts<F: Scalar>(name: &str, cases: &[Case<F>]) -> Vec<Verdict<F>> {
        let mut verdicts = vec![Verdict::miss(None); cases.len()];
        let zero = vec![F::zero(); 3];
        F::subject(kernel::find(name).unwrap())
            .unwrap()
            .run(cases, &zero, &mut verdicts);
        verdicts
    }
    for family in family::FAMILIES {
        let cases: Vec<Case<f32>> = (0..300)
            .flat_map(|i| family.make(&Parameters::default(), 1, i).cases().to_vec())
            .collect();
        let bits = |name: &str| -> Vec<_> {
            verdicts(name, &cases)
                .iter()
                .map(|v| (v.hit, v.refused_by, Float::to_bits(v.t)))
                .collect()
        };
        assert_eq!(
            bits("convex-polygon"),
            bits("plane-inside-out"),
            "{}",
            family.name
        );
    }
    let run = audit(&["convex-polygon"], "polygon", 5000);
    let polygons = &tally(&run, ScalarName::F64, "convex-polygon (zero)").polygons;
    assert!(polygons.count.must_hit > 1000 && polygons.count.must_miss > 500);
    assert_eq!(polygons.count.findings.iter().sum::<u64>(), 0);
}

#[test]
fn plucker_multiplies_an_end_of_zero_as_its_source_does() {
    // |den| overflows, and 0·inf is NaN. Woop's source compares with 0 itself.
    let case = Case::<f32>::new(
        [1e19, 1e19, 1.0],
        [0.0, 0.0, -1.0],
        [[0.0; 3], [1e20, 0.0, 0.0], [0.0, 1e20, 0.0]],
    );
    let gate = |name: &str| {
        let entry = kernel::find(name).unwrap();
        let mut verdict = [Verdict::miss(None)];
        let epsilons = vec![0.0; entry.info.gates.len()];
        f32::subject(entry)
            .unwrap()
            .run(&[case], &epsilons, &mut verdict);
        verdict[0]
            .refused_by
            .map(|gate| entry.info.gates[usize::from(gate)].name)
    };
    assert_eq!(gate("plucker"), Some("t"));
    assert_ne!(gate("woop-watertight"), Some("t"));
}
