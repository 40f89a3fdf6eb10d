//! The core set finds the classic mistakes: each mutant of a plain test is wrong on it where the plain test is
//! right.

use std::fs;

/// A mistake that programs have had.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Mistake {
    None,
    StrictU,
    ToleranceOfTheWrongSign,
    NoMinimumOfT,
    ExchangedUAndV,
    NoSum,
    CullsTheFront,
    NormalisedDirection,
    WrongEdge,
    EpsilonOnDet,
    AcceptsNan,
    AcceptsParallel,
    NoMaximumOfT,
}

const MISTAKES: [Mistake; 12] = [
    Mistake::StrictU,
    Mistake::ToleranceOfTheWrongSign,
    Mistake::NoMinimumOfT,
    Mistake::ExchangedUAndV,
    Mistake::NoSum,
    Mistake::CullsTheFront,
    Mistake::NormalisedDirection,
    Mistake::WrongEdge,
    Mistake::EpsilonOnDet,
    Mistake::AcceptsNan,
    Mistake::AcceptsParallel,
    Mistake::NoMaximumOfT,
];

type Vector = [f64; 3];

fn minus(p: Vector, q: Vector) -> Vector {
    std::array::from_fn(|i| p[i] - q[i])
}

fn dot(p: Vector, q: Vector) -> f64 {
    p[0] * q[0] + p[1] * q[1] + p[2] * q[2]
}

fn cross(p: Vector, q: Vector) -> Vector {
    std::array::from_fn(|i| {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        p[j] * q[k] - p[k] * q[j]
    })
}

/// Möller and Trumbore's test in doubles, with a mistake: t, u and v of a hit.
fn hit(n: &[f64], mistake: Mistake) -> Option<[f64; 3]> {
    let vector = |i: usize| [n[i], n[i + 1], n[i + 2]];
    let is = |other: Mistake| mistake == other;
    let (o, mut d, a, b, c) = (vector(0), vector(3), vector(8), vector(11), vector(14));
    if is(Mistake::NormalisedDirection) {
        let length = dot(d, d).sqrt();
        d = d.map(|x| x / length);
    }
    let f = if is(Mistake::WrongEdge) {
        minus(c, b)
    } else {
        minus(c, a)
    };
    let (e, s) = (minus(b, a), minus(o, a));
    let (p, q) = (cross(d, f), cross(s, e));
    let det = dot(e, p);
    let least = if is(Mistake::EpsilonOnDet) { 1e-6 } else { 0.0 };
    if det.abs() <= least && !is(Mistake::AcceptsParallel)
        || is(Mistake::CullsTheFront) && det > 0.0
    {
        return None;
    }
    let (mut u, mut v, t) = (dot(s, p) / det, dot(d, q) / det, dot(f, q) / det);
    if is(Mistake::ExchangedUAndV) {
        (u, v) = (v, u);
    }
    let rim = if is(Mistake::ToleranceOfTheWrongSign) {
        1e-3
    } else {
        0.0
    };
    let outside = u < rim || v < rim || u + v > 1.0 - rim && !is(Mistake::NoSum);
    let before = t < n[6] && !is(Mistake::NoMinimumOfT);
    let beyond = t > n[7] && !is(Mistake::NoMaximumOfT);
    let nan = u.is_nan() || v.is_nan() || t.is_nan();
    let accepted = is(Mistake::AcceptsNan) || is(Mistake::AcceptsParallel);
    if outside || before || beyond || nan && !accepted || is(Mistake::StrictU) && u <= 0.0 {
        return None;
    }
    Some([t, u, v])
}

/// The ids of the tests that a function fails: the answer, by the closed reading if it is free, or t, u or v by
/// more than a thousandth.
fn failed(mistake: Mistake) -> Vec<String> {
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/../../vectors/core.csv");
    let text = fs::read_to_string(file).unwrap();
    let is_wrong = |row: &[&str]| {
        let bits = row[18..]
            .iter()
            .map(|word| u64::from_str_radix(word, 16).unwrap());
        let narrow = row[3] == "f32";
        let number = |bits| {
            if narrow {
                f32::from_bits(bits as u32).into()
            } else {
                f64::from_bits(bits)
            }
        };
        let numbers: Vec<f64> = bits.map(number).collect();
        let right = if row[10] == "coplanar" || row[10] == "degenerate" {
            "miss"
        } else {
            row[7]
        };
        match hit(&numbers, mistake) {
            None => right == "hit",
            // Whatever the input, a hit has a place.
            Some(values) if right == "free" => values.iter().any(|x| !x.is_finite()),
            Some(_) if right == "miss" => true,
            Some(values) => (0..3).any(|i| {
                let exact: f64 = row[13 + i].parse().unwrap();
                (values[i] - exact).abs() > 1e-3 * exact.abs().max(1.0)
            }),
        }
    };
    let rows = text
        .lines()
        .skip(1)
        .map(|line| line.split(',').collect::<Vec<_>>());
    rows.filter(|row| is_wrong(row))
        .map(|row| format!("{}.{}", row[0], row[1]))
        .collect()
}

#[test]
fn the_core_set_catches_twelve_classic_mistakes() {
    let plain = failed(Mistake::None);
    for mistake in MISTAKES {
        let caught: Vec<String> = failed(mistake)
            .into_iter()
            .filter(|id| !plain.contains(id))
            .collect();
        println!("{mistake:?}: caught by {} tests", caught.len());
        assert!(!caught.is_empty(), "{mistake:?}");
    }
}

/// Möller and Trumbore's test in floats, by quotients or by products with an inverse.
fn hit_in_f32(n: &[f32], inverse: bool) -> bool {
    let minus = |i: usize, j: usize| -> [f32; 3] { std::array::from_fn(|k| n[i + k] - n[j + k]) };
    let dot = |p: [f32; 3], q: [f32; 3]| p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
    let cross = |p: [f32; 3], q: [f32; 3]| {
        [
            p[1] * q[2] - p[2] * q[1],
            p[2] * q[0] - p[0] * q[2],
            p[0] * q[1] - p[1] * q[0],
        ]
    };
    let (d, e, f, s) = ([n[3], n[4], n[5]], minus(11, 8), minus(14, 8), minus(0, 8));
    let (p, q) = (cross(d, f), cross(s, e));
    let det = dot(e, p);
    let over = |x: f32| if inverse { x * (1.0 / det) } else { x / det };
    let (u, v, t) = (over(dot(s, p)), over(dot(d, q)), over(dot(f, q)));
    det != 0.0 && u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t >= n[6] && t <= n[7]
}

#[test]
fn the_guide_has_the_number_of_tests_that_a_plain_test_in_floats_fails() {
    fn is_in_code(row: &[&str]) -> bool {
        let margin = row[16].parse().unwrap_or(1f64);
        row[4].is_empty() && row[6] != "free" && 1e-6 <= margin.abs()
    }
    let read = |file: &str| {
        fs::read_to_string(format!("{}/../../{file}", env!("CARGO_MANIFEST_DIR"))).unwrap()
    };
    let (csv, guide) = (read("vectors/core.csv"), read("docs/guide/vectors.md"));
    let rows: Vec<Vec<&str>> = csv.lines().map(|line| line.split(',').collect()).collect();
    let of_test = rows.chunk_by(|one, other| one[0] == other[0]);
    let of_f32: Vec<_> = of_test.filter(|rows| rows[0][3] == "f32").collect();
    // How many are asked, and how many of them are answered wrongly in each way.
    let counts = |is_asked: fn(&[&str]) -> bool| {
        let asked: Vec<_> = of_f32.iter().filter(|rows| is_asked(&rows[0])).collect();
        let failed = [false, true].map(|inverse| {
            let is_hit = |row: &&Vec<&str>| {
                let bits = row[18..35]
                    .iter()
                    .map(|word| u32::from_str_radix(word, 16).unwrap());
                hit_in_f32(&bits.map(f32::from_bits).collect::<Vec<_>>(), inverse)
            };
            let is_wrong = |rows: &&&&[Vec<&str>]| {
                let hits = rows.iter().filter(is_hit).count();
                match (rows[0][4], rows[0][6]) {
                    ("at-least-one", _) => hits == 0,
                    ("exactly-one", _) | ("", "hit") => hits != 1,
                    _ => hits != 0,
                }
            };
            asked.iter().filter(is_wrong).count()
        });
        (asked.len(), failed)
    };
    let is_bound = |row: &[&str]| row[4] != "free" && (!row[4].is_empty() || row[6] != "free");
    let (all, [divided, multiplied]) = counts(is_bound);
    let expected = format!(
        "The core set has {all} tests in `f32` that are not free. A plain Möller–Trumbore test in `float` fails {divided} of them if it divides"
    );
    assert!(guide.contains(&expected), "{expected}");
    assert!(
        guide.contains(&format!("determinant, and {multiplied} if it multiplies")),
        "{multiplied}"
    );
    let (asked, [divided, multiplied]) = counts(is_in_code);
    let expected =
        format!("of the {asked} that the code above asks, {divided} and {multiplied}, and");
    assert!(guide.contains(&expected), "{expected}");
    let (_, ordinary) = counts(|row| is_in_code(row) && !row[17].contains("range-ends"));
    let expected = format!("`range-ends` {} either way", ordinary[0]);
    assert!(
        guide.contains(&expected) && ordinary[0] == ordinary[1],
        "{ordinary:?}"
    );
}
