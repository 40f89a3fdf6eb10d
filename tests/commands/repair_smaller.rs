//! Small changes to kernels, and the screen of `hairline repair` that says which of them mend what.

use crate::program::{ends, hairline, scratch};
use hairline::internals::case::{Case, Parameters, Triangle};
use hairline::internals::family::FAMILIES;
use hairline::internals::kernel::{Change, Scalar, Verdict, find};
use std::fs;
use std::path::Path;

const PUBLISHED: [f32; 2] = [1e-6, 0.0];

fn verdict<F: Scalar>(kernel: &str, case: &Case<F>, epsilons: &[F]) -> Verdict<F> {
    let mut verdict = [Verdict::miss(None)];
    F::subject(find(kernel).unwrap())
        .unwrap()
        .run(&[*case], epsilons, &mut verdict);
    verdict[0]
}

fn cases(parameters: &Parameters) -> Vec<Case<f32>> {
    let of = |family: &'static hairline::internals::family::Family| {
        (0..40).flat_map(move |i| family.make::<f32>(parameters, 3, i).cases().to_vec())
    };
    FAMILIES
        .iter()
        .filter(|it| it.question.is_ordinary())
        .flat_map(of)
        .collect()
}

#[test]
fn an_epsilon_by_size_decides_alike_at_every_scale() {
    let small = Parameters {
        scale: -13,
        ..Parameters::default()
    };
    let (mut changed, mut published) = (0, 0);
    for (case, small) in cases(&Parameters::default()).iter().zip(cases(&small)) {
        // Where the epsilon itself does not underflow.
        let [_, direction, a, b, c] = case.vectors();
        let size = |x: &[f32; 3]| x.iter().fold(0.0_f32, |most, x| most.max(x.abs()));
        if [direction, a, b, c].iter().any(|x| size(x) < 1e-3) {
            continue;
        }
        let differ = |kernel| {
            verdict(kernel, case, &PUBLISHED).hit != verdict(kernel, &small, &PUBLISHED).hit
        };
        changed += usize::from(differ("moller-trumbore+by-size"));
        published += usize::from(differ("moller-trumbore"));
    }
    assert!(changed == 0 && 100 < published, "{changed} {published}");
}

/// What the epsilon is multiplied by is 0, and so is the determinant: nothing is divided by it.
#[test]
fn a_triangle_that_is_a_point_or_too_small_for_its_size_is_missed() {
    for size in [0.0_f32, 1e-30, 1e-45] {
        let triangle = [[0.0; 3], [size, 0.0, 0.0], [size, 0.0, 0.0]];
        let case = Case::new([0.1, 0.2, 1.0], [0.0, 0.0, -1.0], triangle);
        let all = [PUBLISHED, [1e-6, -1e-3]]
            .map(|epsilons| verdict("moller-trumbore+by-size", &case, &epsilons).hit);
        assert_eq!(all, [false; 2], "{size}");
    }
}

#[test]
fn a_kernel_in_double_answers_for_floats_as_it_does_for_doubles() {
    let mut others = 0;
    for case in cases(&Parameters::default()) {
        let wide = verdict("cramer", &case.widen(), &[0.0; 3]);
        let found = verdict("cramer+double", &case, &[0.0; 3]);
        assert_eq!(
            (found.hit, found.t.to_bits()),
            (wide.hit, (wide.t as f32).to_bits())
        );
        others += usize::from(verdict("cramer", &case, &[0.0; 3]).hit != found.hit);
    }
    assert!(20 < others, "{others}");
}

/// Möller and Trumbore's test by hand at [`PUBLISHED`]: true if it hits, and the least of its edge numbers.
fn by_hand<F: Scalar>(case: &Case<F>) -> (bool, F) {
    let minus = |p: [F; 3], q: [F; 3]| [0, 1, 2].map(|i| p[i] - q[i]);
    let dot = |p: [F; 3], q: [F; 3]| p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
    let cross = |p: [F; 3], q: [F; 3]| {
        [
            p[1] * q[2] - q[1] * p[2],
            p[2] * q[0] - q[2] * p[0],
            p[0] * q[1] - q[0] * p[1],
        ]
    };
    let [o, d, a, b, c] = case.vectors();
    let (ab, ac, ao) = (minus(b, a), minus(c, a), minus(o, a));
    let p = cross(d, ac);
    let det = dot(ab, p);
    let q = cross(ao, ab);
    let [u, v] = [dot(ao, p), dot(d, q)].map(|x| x * (F::one() / det));
    let edges = [u, F::one() - u, v, F::one() - (u + v)];
    let least = edges
        .into_iter()
        .reduce(|x, y| if y < x { y } else { x })
        .unwrap();
    let epsilon = F::from_f64(f64::from(PUBLISHED[0]));
    let is_parallel = det < epsilon && -epsilon < det;
    (!is_parallel && !edges.iter().any(|x| *x < F::zero()), least)
}

#[test]
fn a_fallback_answers_in_double_where_an_edge_number_is_zero() {
    let (mut zeros, mut others) = (0, 0);
    for case in cases(&Parameters::default()) {
        let ((plain, least), (wide, _)) = (by_hand(&case), by_hand(&case.widen()));
        if least.is_nan() {
            continue;
        }
        let found = verdict("moller-trumbore+fallback", &case, &PUBLISHED);
        assert_eq!(
            found.hit,
            if least == 0.0 { wide } else { plain },
            "{}",
            case.hex()
        );
        zeros += usize::from(least == 0.0);
        others += usize::from(least == 0.0 && wide != plain);
    }
    assert!(50 < zeros && 5 < others, "{zeros} {others}");
    assert!(f64::subject(find("moller-trumbore+fallback").unwrap()).is_none());
}

#[test]
fn sorted_vertices_keep_their_weights_and_the_side() {
    for case in cases(&Parameters::default()) {
        let found = verdict("moller-trumbore+sorted", &case, &PUBLISHED);
        // All six orders are one triangle, of which half are seen from behind.
        let [a, b, c] = case.triangle.vertices();
        let places = [
            [a, b, c],
            [b, c, a],
            [c, a, b],
            [b, a, c],
            [a, c, b],
            [c, b, a],
        ];
        for (i, [x, y, z]) in places.into_iter().enumerate() {
            let triangle = Triangle { a: x, b: y, c: z };
            let again = verdict(
                "moller-trumbore+sorted",
                &Case { triangle, ..case },
                &PUBLISHED,
            );
            assert_eq!(again.hit, found.hit);
            let is_behind = again.facing != found.facing;
            assert!(
                !found.hit || found.facing.is_none() || is_behind == (2 < i),
                "{}",
                case.hex()
            );
        }
    }
    let mut hits = 0;
    let plain_hits = hairline::internals::family::find("interior").unwrap();
    for i in 0..500 {
        let case = plain_hits.make::<f32>(&Parameters::default(), 3, i).cases()[0];
        let found = verdict("moller-trumbore+sorted", &case, &PUBLISHED);
        let plain = verdict("moller-trumbore", &case, &PUBLISHED);
        if found.hit && plain.hit {
            hits += 1;
            assert_eq!(found.facing, plain.facing);
            assert!(
                (found.u - plain.u).abs() + (found.v - plain.v).abs() < 1e-3,
                "{}",
                case.hex()
            );
        }
    }
    assert!(100 < hits, "{hits}");
}

#[test]
fn what_is_behind_is_no_hit_ahead() {
    let mut behind = 0;
    for case in cases(&Parameters::default()) {
        let plain = verdict("moller-trumbore", &case, &PUBLISHED);
        let found = verdict("moller-trumbore+ahead", &case, &PUBLISHED);
        let is_behind = plain.t < 0.0;
        assert_eq!(found.hit, plain.hit && !is_behind);
        behind += usize::from(plain.hit && !found.hit);
    }
    assert!(10 < behind, "{behind}");
    // It tests t already.
    assert!(find("woop-watertight+ahead").is_none());
    // One change at a time.
    for name in [
        "moller-trumbore+ahead+ahead",
        "moller-trumbore+by-size+double",
        "cramer+fma+sorted",
    ] {
        assert!(find(name).is_none(), "{name}");
    }
}

/// Runs a command line that the program printed.
fn again(folder: &std::path::Path, line: &str) -> (String, i32) {
    let words: Vec<String> = line
        .split('\'')
        .enumerate()
        .fold(Vec::new(), |mut all, (i, part)| {
            match i % 2 {
                0 => all.extend(part.split_whitespace().map(str::to_owned)),
                _ => all.push(part.to_owned()),
            }
            all
        });
    let words: Vec<&str> = words[1..].iter().map(String::as_str).collect();
    let output = hairline(folder, &words);
    (
        String::from_utf8(output.stdout).unwrap(),
        output.status.code().unwrap(),
    )
}

#[test]
fn a_form_that_is_not_there_is_answered_with_those_that_are() {
    let folder = scratch("repair-forms");
    let (_, said) = ends(
        &folder,
        &["repair", "--kernel", "moller-trumbore+nonsense"],
        2,
    );
    let (listed, _) = ends(&folder, &["list", "kernels"], 0);
    for change in Change::ALL {
        let (name, about) = (change.name(), change.about());
        assert!(said.contains(&format!("+{name} ({about})")), "{said}");
        assert!(listed.contains(&format!("+{name}  ")), "{listed}");
        let (meaning, _) = ends(&folder, &["help", name], 0);
        assert!(meaning.contains(&format!("+{name}")), "{meaning}");
    }
    // It tests t already, and so do its forms.
    let (_, said) = ends(&folder, &["audit", "--kernel", "woop-watertight+ahead"], 2);
    assert!(
        said.contains("+sorted (") && !said.contains("+ahead ("),
        "{said}"
    );
}

#[test]
fn a_gate_of_an_epsilon_by_size_says_so() {
    let folder = scratch("repair-by-size");
    let explain = [
        "explain",
        "tiny@3/f32/-/1/15467",
        "--kernel",
        "moller-trumbore+by-size",
    ];
    let (said, _) = ends(&folder, &explain, 0);
    assert!(said.contains("abs(det) < max(e*L*L*D, TINY)"), "{said}");
}

#[test]
fn where_nothing_mends_the_worst_the_sums_come_first() {
    let folder = scratch("repair-room");
    let room = [
        "repair",
        "--kernel",
        "moller-trumbore",
        "--scene",
        "room",
        "-n",
        "2000",
        "-q",
    ];
    let (text, _) = ends(&folder, &room, 0);
    // The first two numbers of a row of the table.
    let wrong = |name: &str| -> u64 {
        let rows = text.lines().filter_map(|line| line.strip_prefix(name));
        let numbers = rows.map(|row| {
            row.split_whitespace()
                .map(|it| it.replace(',', "").parse::<u64>())
        });
        let mut sums = numbers.filter_map(|it| it.take(2).sum::<Result<u64, _>>().ok());
        sums.find(|sum| 0 < *sum).unwrap()
    };
    let from_to = format!("({} to {})", wrong("as published "), wrong("+double "));
    let joined = text.replace('\n', " ").replace(',', "");
    let words = format!("+double takes away the most wrong answers {from_to}");
    assert!(joined.contains(&words), "{words}: {text}");
    // The next commands are about these rays, and what is proved of other sizes is not said.
    let rays = "--scalar f32 --scene room -n 2000";
    for command in [
        format!(
            "hairline audit --kernel moller-trumbore+double --epsilon 'parallel=1e-6,edge=0' {rays}"
        ),
        format!("hairline epsilon --kernel moller-trumbore {rays}"),
    ] {
        assert!(text.contains(&command), "{command}: {text}");
    }
    let row = text
        .lines()
        .find(|line| line.starts_with("as published "))
        .unwrap();
    assert!(row.ends_with("wrong       -        -     1"), "{row}");
}

#[test]
fn flags_that_would_do_nothing_are_refused() {
    let folder = scratch("repair-flags");
    let repair = ["repair", "--kernel", "moller-trumbore"];
    for (words, part) in [
        (
            &["--emit", "c", "--epsilon", "parallel=1e-9"][..],
            "--epsilon is of the kernel as it is",
        ),
        (
            &["--emit", "c", "--certificate", "-"],
            "cannot both go to standard output",
        ),
        (&["-o", "screen.txt"], "-o takes what --emit writes"),
        (&["-o", "folder/"], "-o takes what --emit writes"),
    ] {
        let (_, said) = ends(&folder, &[&repair[..], words].concat(), 2);
        assert!(said.contains(part), "{words:?}: {said}");
    }
}

#[test]
fn the_smallest_change_mends_the_worst_and_the_refuted_ones_do_not() {
    let folder = scratch("repair-smaller");
    let (text, _) = ends(
        &folder,
        &["repair", "--kernel", "moller-trumbore", "-n", "4000", "-q"],
        0,
    );
    let commands: Vec<&str> = text
        .lines()
        .filter_map(|line| line.find("hairline ").map(|at| &line[at..]))
        .collect();
    let explain = commands
        .iter()
        .filter(|line| line.starts_with("hairline explain"));
    let explain: Vec<&&str> = explain.collect();
    assert!(2 < explain.len(), "{text}");
    let is_wrong = |text: &str| text.contains("FALSE-HIT") || text.contains("FALSE-MISS");
    for line in explain {
        let (said, _) = again(&folder, line);
        assert!(is_wrong(&said), "{line}: {said}");
    }
    // A rounded t may refuse what is far inside, so of a gate on t nothing is proved.
    let ahead = text
        .lines()
        .find(|line| line.starts_with("+ahead "))
        .unwrap();
    assert_eq!(
        ahead.split_whitespace().skip(5).take(3).collect::<Vec<_>>(),
        ["-"; 3],
        "{text}"
    );
    // The same case under the change of the patch.
    let name = text
        .lines()
        .find_map(|line| line.strip_prefix("+++ "))
        .unwrap();
    let audit = commands
        .iter()
        .find(|line| line.contains("hairline audit"))
        .unwrap();
    assert!(
        audit.ends_with(&format!("{name} --scalar f32 -n 4000")),
        "{audit}: {name}"
    );
    let case = commands
        .iter()
        .rfind(|line| line.starts_with("hairline explain"))
        .unwrap();
    let flags = audit
        .replacen("hairline audit ", "", 1)
        .replace(" --scalar f32 -n 4000", "");
    let (said, _) = again(
        &folder,
        &format!("{} {flags}", &case[..case.find(" --kernel").unwrap()]),
    );
    assert!(!is_wrong(&said), "{said}");
    // The counts are those of an audit.
    let number = |line: &str, i: usize| -> u64 {
        line.split_whitespace()
            .nth(i)
            .unwrap()
            .replace(',', "")
            .parse()
            .unwrap()
    };
    let row = text
        .lines()
        .find(|line| line.starts_with("as published"))
        .unwrap();
    let families = FAMILIES
        .iter()
        .filter(|it| it.question.is_ordinary())
        .map(|it| it.name);
    let families = families.collect::<Vec<_>>().join(",");
    let all = [
        "audit",
        "--kernel",
        "moller-trumbore",
        "--scalar",
        "f32",
        "-n",
        "4000",
        "--family",
    ];
    let (json, _) = ends(
        &folder,
        &[&all[..], &[&families, "--format", "json"]].concat(),
        0,
    );
    let record: serde_json::Value = serde_json::from_str(&json).unwrap();
    let results = record["result"]["results"].as_array().unwrap();
    for (column, finding) in [(2, "false_misses"), (3, "false_hits")] {
        let sum = results
            .iter()
            .map(|it| it["total"][finding]["count"].as_u64().unwrap());
        assert_eq!(number(row, column), sum.sum::<u64>(), "{finding}");
    }
}

#[test]
fn a_kernel_with_epsilons_of_its_own_is_not_called_published() {
    let folder = scratch("repair-given");
    let kernel = ["repair", "--kernel", "moller-trumbore", "-n", "200", "-q"];
    let given = ["--epsilon", "parallel=1e-9"];
    for (flags, name, other) in [
        (&[][..], "as published", "as given"),
        (&given, "as given", "as published"),
    ] {
        let (text, _) = ends(&folder, &[&kernel[..], flags].concat(), 0);
        let is_row = |name: &str| text.lines().any(|line| line.starts_with(name));
        assert!(is_row(name) && !text.contains(other), "{text}");
    }
}

/// The page of the guide shows what the program says, but for the times of the day.
#[test]
fn the_guides_sample_is_what_the_program_says() {
    let guide = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/guide/repair.md");
    let guide = fs::read_to_string(guide).unwrap();
    let begin = "```\nmoller-trumbore (source) in f32\n";
    let (_, sample) = guide.split_once(begin).unwrap();
    let (sample, _) = sample.split_once("```").unwrap();
    let folder = scratch("repair-guide");
    let all = [
        "repair",
        "--kernel",
        "moller-trumbore",
        "--scalar",
        "f32",
        "-q",
    ];
    let (text, _) = ends(&folder, &all, 0);
    let (_, said) = text
        .split_once("moller-trumbore (source) in f32\n")
        .unwrap();
    let without_cost = |line: &str| match line.rsplit_once("  ") {
        Some((row, cost)) if cost.trim().parse::<f64>().is_ok() => row.trim_end().to_owned(),
        _ => line.trim_end().to_owned(),
    };
    let sample: Vec<String> = sample.trim_end().lines().map(without_cost).collect();
    let said: Vec<String> = said.lines().take(sample.len()).map(without_cost).collect();
    assert_eq!(sample, said);
}
