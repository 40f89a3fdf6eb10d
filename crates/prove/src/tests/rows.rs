//! Coordinates of edges over twice an area: what is said of them in proof.md, in whole numbers and in formats of
//! a few digits.

use super::super::{
    Domain, Dyadic, Format, Formula, Leaf, Proof, Prover, Rule, Source, Step, paths_of,
};
use super::tiny::round;
use super::unit::largest_share;
use super::{difference, recorded};
use crate::arith::recorded::{Operation, Recorded};
use crate::case::Draw;
use crate::kernel;

/// The edges from the vertex a to b and c, in the plane of x and y.
fn edges() -> [[Recorded; 2]; 2] {
    [2, 3].map(|p| [0, 1].map(|axis| difference(p, 1, axis)))
}

fn area() -> Recorded {
    let [[u, v], [w, x]] = edges();
    u * &x - v * &w
}

/// The coordinates of a point in the triangle's plane, times rows that are edges by twice the area; both together, as
/// a kernel adds u and v.
fn both_rows() -> Recorded {
    let [u, v] = edges();
    let row = |[i, j]: [Recorded; 2]| {
        let (along_i, along_j) = (j / &area(), -i / &area());
        along_i * &Recorded::input(0) + along_j * &Recorded::input(1)
    };
    row(v) + (-row(u))
}

/// The same with one coordinate only.
fn one_axis() -> Recorded {
    let [[_, u], [_, v]] = edges();
    let (first, second) = (v / &area(), -u / &area());
    first * &Recorded::input(0) + second * &Recorded::input(0)
}

/// A quotient of the area and an edge beside it.
fn beside_an_edge() -> Recorded {
    let [[u, _], [_, x]] = edges();
    let quotient = difference(3, 1, 2) * &u.clone() / &area();
    quotient + u / &area() + x / &area()
}

const EDGE: Dyadic = Dyadic::BELOW_ONE;

const DOMAIN: Domain = Domain { edge: EDGE, floor: Dyadic::HALF, ..Domain::UNIT };

/// The largest error beside its bound, where both edges are short and every quotient is at most 1.
fn share_of_short_edges(run: fn() -> Recorded, digits: u32) -> f64 {
    let mut draw = Draw::new("rows", 1, u64::from(digits));
    let is_short = |inputs: &[f64; 17]| {
        let mut edges = (0..3).flat_map(|k| [9, 12].map(|p| inputs[p + k] - inputs[6 + k]));
        edges.all(|x| x.abs() <= EDGE.to_f64())
    };
    let all = (0..600_000).map(|_| {
        let mut inputs: [f64; 17] = std::array::from_fn(|_| round(draw.symmetric(), digits));
        (6..9).for_each(|i| inputs[i] *= 0.0625);
        inputs
    });
    let (worst, tried) = largest_share(recorded(run), DOMAIN, digits, all.filter(is_short));
    assert!(tried > 300, "{tried}");
    worst
}

#[test]
fn no_sum_of_rows_in_a_tiny_format_passes_its_bound() {
    type Run = fn() -> Recorded;
    let cases: [(&str, Run); 3] =
        [("both rows", both_rows), ("one axis", one_axis), ("beside an edge", beside_an_edge)];
    for digits in [4, 5, 8] {
        for (name, run) in cases {
            let worst = share_of_short_edges(run, digits);
            println!("{name}, p={digits}: {worst:.3} of the bound");
            assert!(0.05 < worst && worst <= 1.0, "{name}, p={digits}: {worst}");
        }
    }
}

/// The effects of a formula's errors at a point, where each is as large as its bound.
fn effects(formula: &Formula, variables: &[f64], values: &mut Vec<f64>) -> f64 {
    values.clear();
    for step in &formula.steps {
        let of = |i: usize| values[i];
        let sum = |sum: &[(usize, i8)]| {
            sum.iter().map(|(v, sign)| f64::from(*sign) * variables[*v]).sum()
        };
        values.push(match *step {
            Step::Variables(ref all) => sum(all),
            Step::Of(Operation::Number(value)) => value.into(),
            Step::Of(Operation::Neg(a)) => -of(a),
            Step::Of(Operation::Add(a, b)) => of(a) + of(b),
            Step::Of(Operation::Sub(a, b)) => of(a) - of(b),
            Step::Of(Operation::Mul(a, b)) => of(a) * of(b),
            Step::Of(Operation::Fma(a, b, c)) => of(a) * of(b) + of(c),
            Step::Of(Operation::Minor(a, b, c, d)) => of(a) * of(b) - of(c) * of(d),
            Step::Of(_) => unreachable!("no such step"),
        });
    }
    let mut slopes = vec![0.0; values.len()];
    *slopes.last_mut().unwrap() = 1.0;
    for (i, step) in formula.steps.iter().enumerate().rev() {
        let (own, of) = (slopes[i], |i: usize| values[i]);
        let parts: &[(usize, f64)] = match *step {
            Step::Variables(_) | Step::Of(Operation::Number(_)) => &[],
            Step::Of(Operation::Neg(a)) => &[(a, -1.0)],
            Step::Of(Operation::Add(a, b)) => &[(a, 1.0), (b, 1.0)],
            Step::Of(Operation::Sub(a, b)) => &[(a, 1.0), (b, -1.0)],
            Step::Of(Operation::Mul(a, b)) => &[(a, of(b)), (b, of(a))],
            Step::Of(Operation::Fma(a, b, c)) => &[(a, of(b)), (b, of(a)), (c, 1.0)],
            Step::Of(Operation::Minor(a, b, c, d)) => {
                &[(a, of(b)), (b, of(a)), (c, -of(d)), (d, -of(c))]
            }
            Step::Of(_) => unreachable!("no such step"),
        };
        parts.iter().for_each(|(to, by)| slopes[*to] += own * by);
    }
    slopes
        .iter()
        .zip(&formula.bounds)
        .map(|(slope, bound)| slope.abs() * bound.error.to_f64())
        .sum()
}

/// No effects of an edge over the area are a larger share of the divisor than those at the corners of the narrow
/// box, and some are nearly that.
#[test]
fn effects_as_a_share_of_the_divisor_are_largest_in_the_narrow_box() {
    let run = || {
        let [[u, v], [w, x]] = edges();
        let [u, v, w, x] = [u, v, w, x].map(|edge| edge / &area());
        u + v + w + x
    };
    let (path, place) = recorded(run);
    let mut prover = Prover::new(&path, DOMAIN, Format::F32);
    prover.bound(place).expect("a bound");
    let lemma = prover.lemmas.iter().find(|lemma| !lemma.formula.narrow.is_empty()).expect("one");
    let (formula, floor) = (&lemma.formula, DOMAIN.floor.to_f64());
    assert!(formula.narrow.len() == 4 && formula.relative.iter().all(|yes| !yes));
    let Some(Step::Of(Operation::Mul(_, divisor))) = formula.steps.iter().nth_back(1) else {
        panic!("q * d")
    };
    let most = lemma.maximum.first.to_f64() / floor;
    let mut draw = Draw::new("effects", 1, 1);
    let (mut best, mut values) = (0.0f64, Vec::new());
    for k in 0..400_000 {
        // Close to corners; twice the area is the floor where all edges are a half.
        let scale = if k % 2 == 0 { 1.0 } else { 0.5 + f64::from(k) / 4e6 };
        let point = formula.variables.iter().zip(&formula.sources).map(|(size, source)| {
            let x: f64 = draw.symmetric();
            let x = x.signum() * (1.0 - x * x * x * x);
            let is_edge = matches!(source, Source::Leaf(Leaf::Difference(..)));
            size.to_f64() * x * if is_edge { scale } else { 1.0 }
        });
        let point: Vec<f64> = point.collect();
        let found = effects(formula, &point, &mut values);
        let size = values[*divisor].abs();
        // The path divides these edges too, and no quotient is above 1.
        let is_inside = formula.narrow.iter().all(|(v, ..)| point[*v].abs() <= size);
        if is_inside && floor <= size {
            best = best.max(found / size);
            assert!(found / size <= most, "{found} of {size} at {point:?}, beside {most}");
        }
    }
    println!("{best:e} of {most:e}");
    assert!(0.9 * most < best, "{best:e} of {most:e}");
}

/// Which variables of third edges a number's proof has, and how many narrow ones.
fn thirds(run: fn() -> Recorded, domain: Domain) -> ([usize; 2], usize) {
    let (path, place) = recorded(run);
    let mut prover = Prover::new(&path, domain, Format::F32);
    prover.bound(place).expect("a bound");
    let narrow = prover.lemmas.iter().map(|lemma| lemma.formula.narrow.len()).sum();
    let lemma = prover.lemmas.last().expect("a lemma");
    let count =
        |sources: &[Source]| sources.iter().filter(|s| matches!(s, Source::Third(..))).count();
    let or = lemma.or.as_ref().map_or(0, |(formula, _)| count(&formula.sources));
    ([count(&lemma.formula.sources), or], narrow)
}

#[test]
fn rules_of_rows_are_used_where_their_conditions_hold() {
    let (found, narrow) = thirds(both_rows, DOMAIN);
    assert_eq!(found, [1, 1]);
    assert!(narrow > 3, "{narrow}");
    assert_eq!(thirds(one_axis, DOMAIN).0, [1, 0]);
    // Edges and quotients whose product is 1 and more prove nothing of the third edge.
    assert_eq!(thirds(both_rows, Domain { edge: Dyadic::ONE, ..DOMAIN }).0, [0, 0]);
    // The sum of the edges' lengths along different axes is no area.
    let no_area = || {
        let [[u, v], [w, x]] = edges();
        let divisor = u * &v - &(w.clone() * &x);
        w / &divisor - difference(2, 1, 0) / &divisor
    };
    assert_eq!(thirds(no_area, DOMAIN).0, [0, 0]);
}

/// Tries all triangles on a grid whose edges' coordinates are below n, and at most |D|·n/(n+1): in units of 1/(n+1).
#[test]
fn two_edges_are_of_one_sign_along_one_axis_at_least() {
    const N: i64 = 9;
    let mut found = [0; 3];
    let all = |f: &mut dyn FnMut([i64; 4])| {
        let range = || -N..=N;
        for u in range() {
            for v in range() {
                for w in range() {
                    for x in range() {
                        f([u, v, w, x]);
                    }
                }
            }
        }
    };
    all(&mut |[u, v, w, x]| {
        // Every coordinate is at most N of N + 1, so at most the area if it is at most area of (N + 1)².
        let area = (u * x - v * w).abs();
        let is_inside = [u, v, w, x].iter().all(|e| e.abs() * (N + 1) <= area);
        if area == 0 || !is_inside {
            return;
        }
        let same = [u * w >= 0, v * x >= 0];
        assert!(same[0] || same[1], "{u} {v} {w} {x}");
        for (is_same, third) in [(same[0], u - w), (same[1], v - x)] {
            assert!(!is_same || third.abs() * (N + 1) <= area, "{u} {v} {w} {x}");
        }
        found[usize::from(same[0]) + usize::from(same[1])] += 1;
    });
    assert!(found[1] > 10, "{found:?}");
}

/// No effects on a barycentric coordinate, wherever the points of a box lie, are larger than those at the corners that
/// are tried, and some are nearly that: of u, of v and of both, which have one error of their divisor.
#[test]
fn effects_on_barycentric_quotients_are_largest_at_corners_of_a_box_of_points() {
    let paths = paths_of::<f32>(kernel::find("moller-trumbore").expect("it is there"));
    let proof = Proof::new(paths.expect("paths"), None, Domain::UNIT, Format::F32);
    let lemmas = proof.quantities.iter().flat_map(|quantity| &quantity.lemmas);
    let ratios = lemmas.filter(|lemma| matches!(lemma.rule, Rule::Quotient { .. }));
    let mut ratios: Vec<_> = ratios.map(|lemma| (lemma.place, lemma)).collect();
    ratios.dedup_by_key(|(place, _)| *place);
    let (mut draw, mut values) = (Draw::new("boxes", 1, 1), Vec::new());
    let mut wholes = 0;
    for (_, lemma) in ratios {
        let formula = &lemma.formula;
        let is_boxed = |source: &&Source| matches!(source, Source::Boxed(..));
        assert_eq!(formula.sources.iter().filter(is_boxed).count(), 12);
        let (most, mut best) = (lemma.maximum.first.to_f64(), 0.0f64);
        for _ in 0..200_000 {
            let point = formula.variables.iter().zip(&formula.sources).map(|(size, source)| {
                let x: f64 = draw.symmetric();
                let x = if draw.below(3) > 0 { x.signum() * (1.0 - x.powi(8)) } else { x };
                // A quotient lies between 0 and 1.
                size.to_f64() * if *source == Source::Quotient { x.abs() } else { x }
            });
            let found = effects(formula, &point.collect::<Vec<_>>(), &mut values);
            assert!(found <= most, "{found} {most}");
            best = best.max(found);
        }
        assert!(0.9 * most < best, "{best} of {most}");
        wholes += usize::from(most > 27.9 * 2f64.powi(-24));
    }
    // u + v, whose maximum a program that shares nothing with this one found too: 27.989 u.
    assert_eq!(wholes, 1);
}
