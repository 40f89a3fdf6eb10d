//! The search for the worst: witnesses replay, scores are what they say, nothing depends on threads.

use hairline::internals::arith::{Exact, Float};
use hairline::internals::audit::{EpsilonChoice, Row, exact_severity};
use hairline::internals::case::{Case, Parameters};
use hairline::internals::corpus::lines::{self, AnyCase};
use hairline::internals::explore::{
    Decimal, Objective, SearchDomain, Update, WorstEntry, WorstGoal, WorstTable, exact_score,
    find_worst, replay, search,
};
use hairline::internals::family::FAMILIES;
use hairline::internals::kernel::{KERNELS, Role, Scalar, Verdict, find};
use hairline::internals::oracle::define;
use num_rational::BigRational;
use num_traits::{Signed, ToPrimitive, Zero};
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::process::{Command, Output};

const TABLE: &str = include_str!("../../corpora/worst.jsonl");

fn row(kernel: &str) -> Row {
    EpsilonChoice::Source
        .rows(&[find(kernel).unwrap()], None)
        .unwrap()
        .swap_remove(0)
}

fn goal(kernel: &str, target: &str, domain: SearchDomain) -> WorstGoal {
    let row = row(kernel);
    let goal =
        WorstGoal::of_row(&row, domain).find(|goal| goal.target.name(row.entry.info) == target);
    goal.unwrap()
}

fn table() -> WorstTable {
    WorstTable::read(TABLE.as_bytes(), "corpora/worst.jsonl").unwrap()
}

#[test]
fn every_witness_replays_and_no_kernel_is_missing() {
    let mut rows: BTreeMap<(String, &str), u32> = BTreeMap::new();
    for stored in lines::read(TABLE.as_bytes(), "worst.jsonl") {
        let stored = stored.unwrap();
        assert_eq!(replay(&stored), Ok(true), "{:?}", stored.name);
        let name = stored.name.unwrap();
        let kernel = name
            .trim_start_matches("worst:")
            .split('/')
            .next()
            .unwrap()
            .to_owned();
        let scalar = if matches!(stored.case, AnyCase::F32(_)) {
            "f32"
        } else {
            "f64"
        };
        *rows.entry((kernel, scalar)).or_default() += 1;
    }
    for entry in KERNELS {
        for scalar in ["f32", "f64"] {
            let count = rows
                .get(&(entry.info.name.to_owned(), scalar))
                .copied()
                .unwrap_or(0);
            assert!(count >= 5, "{} {scalar}: {count} rows", entry.info.name);
        }
    }
}

#[test]
fn a_witness_changed_by_one_bit_or_one_digit_does_not_replay() {
    let line = TABLE
        .lines()
        .find(|line| line.contains("moller-trumbore/f32"))
        .unwrap();
    let read = |line: &str| lines::read(line.as_bytes(), "x").next().unwrap().unwrap();
    assert_eq!(replay(&read(line)), Ok(true));
    let score = line
        .split_once("score=")
        .unwrap()
        .1
        .split_once(' ')
        .unwrap()
        .0;
    let wrong = line.replacen(&format!("score={score}"), "score=1.5e-3", 1);
    assert!(replay(&read(&wrong)).unwrap_err().contains(score));
    let mut moved = read(line);
    let AnyCase::F32(case) = &mut moved.case else {
        panic!()
    };
    case.triangle.a.x = case.triangle.a.x.offset_ulps(1);
    assert!(replay(&moved).is_err());
    let mut other = read(line);
    other.name = Some("front-edge_ab-within".to_owned());
    assert_eq!(replay(&other), Ok(false), "a case of another corpus");
}

/// The scores of the table once more, from num-rational and the record's severity, without the code
/// of the search.
#[test]
fn scores_are_what_the_documentation_says() {
    fn rational<F: Float>(x: F) -> BigRational {
        BigRational::from_float(x.to_f64()).unwrap()
    }
    fn independent<F: Scalar>(entry: &WorstEntry, case: &Case<F>) -> Option<f64> {
        let WorstGoal { row, target, .. } = &entry.goal;
        let (subject, epsilons) = (F::subject(row.entry).unwrap(), row.epsilons::<F>());
        let mut verdict = [Verdict::miss(None)];
        subject.run(&[*case], &epsilons, &mut verdict);
        let [verdict] = verdict;
        let exact = define(case);
        let ulp = rational(F::EPSILON);
        match target.objective {
            Objective::T => {
                let t = exact.exact.t?;
                let unit = rational(F::from_f64(t.to_f64()?).ulp());
                ((rational(verdict.t) - t).abs() / unit).to_f64()
            }
            Objective::Uv => {
                let u = (rational(verdict.u) - exact.exact.u?).abs();
                let v = (rational(verdict.v) - exact.exact.v?).abs();
                (u.max(v) / ulp).to_f64()
            }
            Objective::WrongValue => {
                let [o, d, a, b, c] = case.vectors().map(|v| v.map(rational));
                let minus =
                    |p: &[BigRational; 3], q: &[BigRational; 3]| [0, 1, 2].map(|i| &p[i] - &q[i]);
                let cross = |p: &[BigRational; 3], q: &[BigRational; 3]| {
                    [(1, 2), (2, 0), (0, 1)].map(|(i, j)| &p[i] * &q[j] - &p[j] * &q[i])
                };
                let (ab, ac) = (minus(&b, &a), minus(&c, &a));
                let rows = [cross(&ab, &ac), cross(&d, &ac), cross(&ab, &d)];
                let determinant: BigRational = (0..3).map(|i| &d[i] * &rows[0][i]).sum();
                let values = [exact.exact.t?, exact.exact.u?, exact.exact.v?];
                let [t, u, v] = &values;
                let w = BigRational::from_integer(1.into()) - u - v;
                let sum = |i: usize| {
                    let terms = [&w * &a[i], u * &b[i], v * &c[i], o[i].clone(), t * &d[i]];
                    terms.iter().map(Signed::abs).sum::<BigRational>()
                };
                let size = (0..3).map(sum).max()?;
                let roundoff = ulp / BigRational::from_integer(2.into());
                let gives = row.entry.info.gives;
                let given = [gives.t, gives.uv, gives.uv];
                let reported = [verdict.t, verdict.u, verdict.v].map(rational);
                let times = (0..3).filter(|i| given[*i]).map(|i| {
                    let length: BigRational = rows[i].iter().map(Signed::abs).sum();
                    let unit = &roundoff * &size * length / determinant.abs();
                    let unit = if i == 0 {
                        unit
                    } else {
                        unit.max(roundoff.clone())
                    };
                    (&reported[i] - &values[i]).abs() / unit
                });
                times.max()?.to_f64()
            }
            Objective::Margin => {
                let gate = target.gate?;
                // The float that the gate compares: of a gate `x <= e` the margin is the one below.
                let threshold = subject.gated().unwrap().thresholds(case)[gate];
                let exact =
                    subject.gated().unwrap().measure_exact(case).margins[gate].to_rational()?;
                let [o, d, a, b, c] = case.vectors().map(|v| v.map(rational));
                let points = [o, a, b, c];
                let mut extent = BigRational::zero();
                for (p, q) in points
                    .iter()
                    .flat_map(|p| points.iter().map(move |q| (p, q)))
                {
                    extent = (0..3)
                        .map(|i| (&p[i] - &q[i]).abs())
                        .fold(extent, BigRational::max);
                }
                let length = d.iter().map(|x| x.abs()).max()?;
                let dimension = row.entry.info.gates[gate].dimension;
                let scale = num_traits::Pow::pow(extent, i32::from(dimension.length))
                    * num_traits::Pow::pow(length, i32::from(dimension.direction));
                let unit = scale.max(exact.abs()) * ulp;
                ((rational(threshold) - exact).abs() / unit).to_f64()
            }
            Objective::FalseMiss => {
                let feature = exact.truth.crossing()?.feature;
                assert!(!verdict.hit && feature != hairline::internals::truth::Feature::Outside);
                let severity = exact_severity(case, row.contract.extent)?;
                Some(
                    severity
                        .along
                        .map_or(severity.in_space, |t| t.min(severity.in_space)),
                )
            }
            Objective::FalseHit => {
                assert!(verdict.hit);
                let gates = row.entry.info.gates;
                let at_t = target.gate.is_some_and(|gate| gates[gate].role == Role::T);
                // Off the end as well as outside, the larger distance counts.
                (!at_t).then_some(exact_severity(case, row.contract.extent)?.in_space)
            }
        }
    }
    let mut compared = 0;
    for entry in table().entries() {
        let score = match &entry.case {
            AnyCase::F32(case) => independent(entry, case),
            AnyCase::F64(case) => independent(entry, case),
        };
        let Some(score) = score.filter(|score| score.is_finite()) else {
            continue;
        };
        let stored = entry.score.to_f64();
        assert!(
            (score - stored).abs() <= 1e-14 * stored,
            "{}: {score} {stored}",
            entry.name()
        );
        compared += 1;
    }
    assert!(compared > 400, "{compared}");
}

#[test]
fn a_determinant_that_is_zero_exactly_has_no_error_where_zero_is_refused() {
    // Seen along its plane, at a size at which one float below zero is many ulps of the scale.
    let (o, x, y) = ([0.0; 3], [1e-30f32, 0.0, 0.0], [0.0, 1e-30, 0.0]);
    let case = Case::<f32>::new([0.0, 0.0, 1e-30], [1e-30, 0.0, 0.0], [o, x, y]);
    for kernel in ["cramer", "plane-inside-out-strict"] {
        let goal = goal(kernel, "margin:parallel", SearchDomain::Any);
        assert_eq!(exact_score(&goal, &case), Some(Decimal::ZERO), "{kernel}");
        assert_eq!(goal.scorer::<f32>().quick(&case), 0.0, "{kernel}");
    }
}

#[test]
fn the_result_does_not_depend_on_threads_nor_on_the_other_goals() {
    fn check<F: Scalar>(names: &[(&str, &str)]) {
        let goals: Vec<WorstGoal> = names
            .iter()
            .map(|(k, target)| goal(k, target, SearchDomain::Moderate))
            .collect();
        let run = |threads: usize, goals: &[WorstGoal]| -> Vec<_> {
            let pool = rayon::ThreadPoolBuilder::new()
                .num_threads(threads)
                .build()
                .unwrap();
            let found = pool.install(|| search::<F>(goals, 900, 7));
            found
                .into_iter()
                .map(|found| found.map(|f| (f.case.bits(), f.score)))
                .collect()
        };
        let one = run(1, &goals);
        assert!(one.iter().all(Option::is_some));
        assert_eq!(one, run(5, &goals));
        for (goal, found) in goals.iter().zip(&one) {
            assert_eq!(run(2, std::slice::from_ref(goal))[0], *found, "alone");
        }
    }
    let names = [
        ("moller-trumbore", "margin:edge"),
        ("woop-watertight", "t"),
        ("cramer", "uv"),
    ];
    check::<f32>(&names);
    check::<f64>(&names);
}

#[test]
fn the_quick_score_of_f32_is_near_the_exact_one() {
    let mut compared = 0;
    for entry in KERNELS {
        let row = row(entry.info.name);
        for goal in WorstGoal::of_row(&row, SearchDomain::Moderate) {
            let scorer = goal.scorer::<f32>();
            for family in FAMILIES {
                for index in 0..40 {
                    let made = family.make::<f32>(&Parameters::default(), 3, index);
                    let case = &made.cases()[0];
                    let quick = scorer.quick(case);
                    let Some(exact) = scorer.exact(case) else {
                        continue;
                    };
                    if quick == f64::NEG_INFINITY {
                        // The quick domain is a little smaller.
                        continue;
                    }
                    let exact = Decimal::of(&exact).unwrap().to_f64();
                    let name = goal.name::<f32>();
                    assert!(
                        (quick - exact).abs() <= 1e-6 * (1.0 + exact),
                        "{name}: {quick} {exact}"
                    );
                    compared += 1;
                }
            }
        }
    }
    assert!(compared > 2000, "{compared}");
}

#[test]
fn the_search_finds_what_is_known_and_nothing_where_there_is_nothing() {
    let found = |kernel, target, domain, evaluations| {
        search::<f32>(&[goal(kernel, target, domain)], evaluations, 1)[0].map(|f| f.score.to_f64())
    };
    // 1e-6 refuses small triangles through the middle: at most 0.2887 of an edge inside.
    let middle = found(
        "moller-trumbore",
        "false-miss:parallel",
        SearchDomain::Moderate,
        8000,
    )
    .unwrap();
    assert!((0.15..0.2887).contains(&middle), "{middle}");
    // A healthy crossing has no determinant of zero.
    assert_eq!(
        found(
            "plane-inside-out",
            "false-miss:parallel",
            SearchDomain::Moderate,
            4000
        ),
        None
    );
    // Differences first and nothing divided: a few ulps. Absolute coordinates: thousands.
    let woop = found(
        "woop-watertight",
        "margin:edge",
        SearchDomain::Moderate,
        8000,
    )
    .unwrap();
    let plane = found("plane-inside-out", "margin:t", SearchDomain::Moderate, 8000).unwrap();
    assert!(woop < 20.0 && plane > 1000.0, "{woop} {plane}");
}

#[test]
fn climbing_finds_worse_than_the_same_number_of_cases_of_the_families() {
    let goal = goal("scalar-triple", "uv", SearchDomain::Moderate);
    let climbed = search::<f32>(std::slice::from_ref(&goal), 8000, 1)[0]
        .unwrap()
        .score
        .to_f64();
    let scorer = goal.scorer::<f32>();
    let sampled = (0..8000)
        .map(|i| {
            let family = &FAMILIES[i as usize % FAMILIES.len()];
            scorer.quick(&family.make::<f32>(&Parameters::default(), 1, i).cases()[0])
        })
        .fold(0.0, f64::max);
    assert!(climbed > 3.0 * sampled, "{climbed} {sampled}");
}

#[test]
fn the_table_only_grows() {
    let goal = goal("cramer", "margin:parallel", SearchDomain::Moderate);
    let entry = |seed, evaluations| {
        find_worst::<f32>(std::slice::from_ref(&goal), evaluations, seed)
            .remove(0)
            .unwrap()
    };
    let (little, much) = (entry(1, 100), entry(2, 5000));
    assert!(little.score < much.score);
    for entry in [&little, &much] {
        // The simplified witness keeps nine tenths of what was found.
        assert!(entry.score.to_f64() >= 0.9 * entry.found.to_f64() * (1.0 - 1e-15));
        let AnyCase::F32(case) = &entry.case else {
            panic!()
        };
        assert_eq!(exact_score(&goal, case), Some(entry.score));
    }
    let mut table = WorstTable::default();
    assert_eq!(table.merge(little.clone()), Update::Added);
    assert_eq!(
        table.merge(little.clone()),
        Update::Kept,
        "as bad and no simpler"
    );
    assert_eq!(table.merge(much.clone()), Update::Raised);
    assert_eq!(table.merge(little), Update::Kept);
    assert_eq!(table.entries().next().unwrap().score, much.score);
    let mut text = Vec::new();
    table.write(&mut text).unwrap();
    let again = WorstTable::read(&text[..], "x").unwrap();
    assert_eq!(again.entries().next().unwrap().name(), much.name());
    let twice = [&text[..], &text[..]].concat();
    assert!(
        WorstTable::read(&twice[..], "x")
            .err()
            .unwrap()
            .to_string()
            .contains("x:2: a second")
    );
}

#[test]
fn scores_beyond_f64_are_kept() {
    let huge = Exact::from_f64(1e300);
    let product = huge.clone() * &huge;
    assert_eq!(Decimal::of(&product).unwrap().brief(), "1.000e600");
    assert!(
        table()
            .entries()
            .any(|entry| entry.score.to_f64() == f64::INFINITY)
    );
}

fn scratch(name: &str) -> std::path::PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).unwrap();
    folder
}

fn hairline_in(folder: &Path, arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_hairline"));
    command
        .args(arguments)
        .current_dir(folder)
        .output()
        .unwrap()
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).unwrap()
}

#[test]
fn the_command_searches_updates_its_table_and_lists_it() {
    let folder = scratch("worst");
    let arguments = [
        "fuzz",
        "worst",
        "--kernel",
        "woop-watertight",
        "--gate",
        "edge",
        "-n",
        "400",
    ];
    let searched = hairline_in(&folder, &arguments);
    assert_eq!(
        searched.status.code(),
        Some(0),
        "{}",
        text(&searched.stderr)
    );
    assert!(text(&searched.stderr).contains("evaluations/s"));
    let printed = text(&searched.stdout);
    assert!(printed.contains("f32 moderate  margin:edge"), "{printed}");
    // The command that it prints works.
    let command = printed
        .lines()
        .find(|line| line.contains("hairline explain '"))
        .unwrap();
    let (case, rest) = command
        .split_once('\'')
        .unwrap()
        .1
        .split_once('\'')
        .unwrap();
    let words = rest.split_whitespace().map(|word| word.trim_matches('\''));
    let words: Vec<&str> = ["explain", case].into_iter().chain(words).collect();
    assert_eq!(
        hairline_in(&folder, &words).status.code(),
        Some(0),
        "{words:?}"
    );

    let update = [&arguments[..], &["--update", "known.jsonl"]].concat();
    let first = hairline_in(&folder, &update);
    assert_eq!(first.status.code(), Some(0), "{}", text(&first.stderr));
    let known = fs::read_to_string(folder.join("known.jsonl")).unwrap();
    assert!(known.lines().count() >= 8, "{known}");
    let second = hairline_in(&folder, &update);
    assert!(
        text(&second.stderr).contains("0 added, 0 raised"),
        "{}",
        text(&second.stderr)
    );
    assert_eq!(
        fs::read_to_string(folder.join("known.jsonl")).unwrap(),
        known
    );
    assert_eq!(
        fs::read_dir(&folder).unwrap().count(),
        1,
        "nothing left beside it"
    );

    let listed = hairline_in(
        &folder,
        &["fuzz", "worst", "--list", "--table", "known.jsonl"],
    );
    let listed = text(&listed.stdout);
    assert_eq!(
        listed.matches("hairline explain 'worst:").count(),
        known.lines().count()
    );
    let command = listed
        .lines()
        .find(|line| line.contains("hairline explain"))
        .unwrap();
    let words: Vec<&str> = command
        .split_whitespace()
        .skip(1)
        .map(|word| word.trim_matches('\''))
        .collect();
    assert_eq!(
        hairline_in(&folder, &words).status.code(),
        Some(0),
        "{words:?}"
    );
    // Without a table, what the program knows, by numbers that need no file.
    let known = hairline_in(&folder, &["fuzz", "worst", "--list", "--kernel", "cramer"]);
    let known = text(&known.stdout);
    let command = known
        .lines()
        .find(|line| line.contains("hairline explain '{"))
        .unwrap();
    let (case, rest) = command
        .split_once('\'')
        .unwrap()
        .1
        .split_once('\'')
        .unwrap();
    let words = rest.split_whitespace().map(|word| word.trim_matches('\''));
    let words: Vec<&str> = ["explain", case].into_iter().chain(words).collect();
    assert_eq!(
        hairline_in(&folder, &words).status.code(),
        Some(0),
        "{words:?}"
    );
    let verified = hairline_in(&folder, &["corpus", "verify", "known.jsonl"]);
    assert!(
        text(&verified.stdout).contains("stored scores right"),
        "{}",
        text(&verified.stderr)
    );
}

/// The scores come from exact runs of kernels that a search found, the bounds from proofs for the extents of each case.
#[test]
fn no_known_error_of_a_margin_passes_what_is_proved_at_its_extents() {
    let listed = hairline_in(&scratch("worst-proved"), &["fuzz", "worst", "--list"]);
    let listed = text(&listed.stdout);
    let mut shown = 0;
    for line in listed.lines().filter(|line| line.contains("as proved")) {
        assert!(line.contains(" moderate  margin:"), "{line}");
        let words: Vec<&str> = line.split_whitespace().collect();
        let score: f64 = words[3].parse().unwrap();
        let (_, most) = line.split_once("(at most ").unwrap();
        let most: f64 = most.split(' ').next().unwrap().parse().unwrap();
        assert!(score <= most && most < 40.0 * score, "{line}");
        shown += 1;
    }
    assert!(20 < shown, "{listed}");
}

#[test]
fn wrong_tables_and_flags_are_refused_before_any_search() {
    let folder = scratch("worst-refused");
    let line = TABLE.lines().next().unwrap();
    let score = line
        .split_once("score=")
        .unwrap()
        .1
        .split_once(' ')
        .unwrap()
        .0;
    let name = line
        .split_once("worst:")
        .unwrap()
        .1
        .split_once('"')
        .unwrap()
        .0;
    let curated = include_str!("../../corpora/curated.jsonl")
        .lines()
        .next()
        .unwrap();
    let wrong_score = line.replace(&format!("score={score}"), "score=1.25e-9");
    for (table, message) in [
        (format!("{line}\n{curated}\n"), "t.jsonl:2: no entry"),
        (format!("\n{wrong_score}\n"), "t.jsonl:2: its score is"),
        (
            line.replace("score=", "sore="),
            "t.jsonl:1: why: expected score=",
        ),
        (
            line.replace(name, "woop/f32/-/t/any"),
            "t.jsonl:1: unknown kernel 'woop'",
        ),
        (
            line.replace(name, "cramer/f32/t/any"),
            "t.jsonl:1: 'cramer/f32/t/any' is not kernel/",
        ),
        (line[..line.len() / 2].to_owned(), "t.jsonl:1: "),
    ] {
        fs::write(folder.join("t.jsonl"), &table).unwrap();
        let output = hairline_in(&folder, &["fuzz", "worst", "--update", "t.jsonl"]);
        let error = text(&output.stderr);
        assert_eq!(output.status.code(), Some(65), "{error}");
        assert!(error.contains(message), "{message}: {error}");
        assert_eq!(
            fs::read_to_string(folder.join("t.jsonl")).unwrap(),
            table,
            "left as it was"
        );
    }
    for (arguments, code) in [
        (&["fuzz", "worst", "--gate", "edgy"][..], 2),
        (&["fuzz", "worst", "--objective", "margins"], 2),
        (&["fuzz", "worst", "--domain", "all"], 2),
        (&["fuzz", "worst", "--scalar", "f16"], 2),
        (&["fuzz", "worst", "-n", "0"], 2),
        (&["fuzz", "worst", "--list", "--update", "x"], 2),
        (
            &["fuzz", "worst", "--update", "x", "--contract", "closed-ray"],
            2,
        ),
        (&["fuzz", "worst", "--contract", "own,band=4ulps"], 2),
        // The old name of the command.
        (&["worst", "--band", "4ulps"], 2),
        (
            &[
                "fuzz",
                "worst",
                "--kernel",
                "havel-herout",
                "--objective",
                "margin",
            ],
            4,
        ),
        (&["fuzz", "worst", "--list", "--table", "missing.jsonl"], 74),
    ] {
        let output = hairline_in(&folder, arguments);
        assert_eq!(
            output.status.code(),
            Some(code),
            "{arguments:?}: {}",
            text(&output.stderr)
        );
        assert!(output.stdout.is_empty());
    }
}
