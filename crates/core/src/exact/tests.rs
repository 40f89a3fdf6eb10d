//! The test held to the oracle: on adversarial rays, on rays that a search moves towards the margin, and on closed meshes.

mod closed;
mod search;

use super::number::Number;
use super::*;
use crate::arith::Float;
use crate::case::{Case, Draw, hard_cases};
use crate::oracle::{define, truth};
use crate::truth::{Feature, Place, Truth};

type Vectors<F> = [[F; 3]; 5];

fn prepared<F: Float, N: Number + From<F>>(
    [o, d, a, b, c]: Vectors<F>,
) -> (PreparedRay<F, N>, PreparedTriangle<F, N>) {
    (PreparedRay::new(o, d), PreparedTriangle::new(a, b, c))
}

/// True if an answer without exact arithmetic is wrong.
fn is_wrong<N>(answer: &Answer<N>, truth: &Truth) -> bool {
    let crossing = truth.crossing();
    match answer {
        Answer::Ask => false,
        Answer::Hit(_) => {
            !crossing.is_some_and(|it| it.feature == Feature::Interior && it.place == Place::Within)
        }
        Answer::Miss => crossing.is_some() && truth.hits_closed() == Some(true),
    }
}

/// Holds all answers to one case to its truth. Returns whether it was decided without exact arithmetic.
fn check<F: Float, N: Number + From<F>>(case: &Case<F>) -> bool {
    let (ray, triangle) = prepared::<F, N>(case.vectors());
    let truth = truth(case);
    let (t_min, t_max) = (case.ray.t_min, case.ray.t_max);
    let answer = triangle.decide(&ray, t_min, t_max);
    assert!(
        !is_wrong(&answer, &truth),
        "{answer:?} {truth} {}",
        case.hex()
    );
    let hit = |edges| triangle.hit_with(&ray, t_min, t_max, edges);
    let met = truth
        .crossing()
        .filter(|_| truth.hits_closed() == Some(true));
    let is_inside = met.is_some_and(|it| it.feature == Feature::Interior);
    assert_eq!(
        hit(Edges::Closed).is_some(),
        met.is_some(),
        "{}",
        case.hex()
    );
    assert_eq!(hit(Edges::Open).is_some(), is_inside, "{}", case.hex());
    let once = hit(Edges::Once).is_some();
    assert!(once || !is_inside, "{}", case.hex());
    assert!(!once || met.is_some(), "{}", case.hex());
    if let Some(hit) = hit(Edges::Closed) {
        assert!(t_min <= hit.t && hit.t <= t_max, "{hit:?} {}", case.hex());
        assert!(
            F::zero() <= hit.u && F::zero() <= hit.v,
            "{hit:?} {}",
            case.hex()
        );
        assert!(hit.v <= F::one() - hit.u, "{hit:?} {}", case.hex());
        assert_eq!(
            hit.is_front,
            met.unwrap().facing == crate::truth::Facing::Front,
            "{}",
            case.hex()
        );
    }
    answer != Answer::Ask
}

/// A ray at a hard place of a triangle: edges and vertices to the last digit, grazing, slivers, lattices, far origins.
fn aimed<F: Float>(draw: &mut Draw) -> Vectors<F> {
    let kind = draw.below(9);
    let float = F::from_f64;
    let between = |draw: &mut Draw, low: i64, high: i64| {
        2f64.powi(draw.integer(low, high) as i32) * (1.0 + draw.unit())
    };
    let signed = |draw: &mut Draw| 2.0 * draw.unit() - 1.0;
    let size = between(draw, -6, 6);
    let from_zero = if kind == 7 {
        between(draw, 0, 14)
    } else {
        between(draw, -3, 3)
    };
    let base = [(); 3].map(|()| from_zero * signed(draw));
    let [a, mut b, mut c] = [(); 3].map(|()| base.map(|x| float(x + size * signed(draw)).to_f64()));
    if kind == 5 {
        // A sliver.
        let (along, width) = (draw.unit(), between(draw, -30, -2));
        c = [0, 1, 2]
            .map(|i| float(a[i] + along * (b[i] - a[i]) + width * size * signed(draw)).to_f64());
    }
    if draw.below(8) == 0 {
        let axis = draw.below(3);
        (b[axis], c[axis]) = (a[axis], if draw.coin() { a[axis] } else { c[axis] });
    }
    let mut weights = match kind {
        0 => [draw.unit() / 2.0, draw.unit() / 2.0],
        1 => [6.0 * signed(draw), 6.0 * signed(draw)],
        2 => [draw.unit(), between(draw, -30, 0) * draw.pick(&[1.0, -1.0])],
        3 => [0.0, 0.0],
        _ => [draw.unit(), 0.0],
    }
    .to_vec();
    weights.push(1.0 - weights[0] - weights[1]);
    weights.rotate_left(draw.below(3));
    let target = [0, 1, 2].map(|i| weights[0] * a[i] + weights[1] * b[i] + weights[2] * c[i]);
    let mut toward = [(); 3].map(|()| signed(draw));
    if kind == 4 || draw.below(8) == 0 {
        let (x, y, off) = (signed(draw), signed(draw), between(draw, -26, -1));
        toward =
            [0, 1, 2].map(|i| (x * (b[i] - a[i]) + y * (c[i] - a[i])) / size + off * toward[i]);
    }
    if draw.below(8) == 0 {
        toward[draw.below(3)] = 0.0;
    }
    let steps = between(draw, -4, if kind == 7 { 20 } else { 8 });
    let unit = draw.pick(&[0, 1, 2]);
    let mut o = [0, 1, 2].map(|i| float(target[i] - steps * toward[i]));
    let mut d = [0, 1, 2].map(|i| match unit {
        0 => float(toward[i]),
        _ => float(target[i] - o[i].to_f64()),
    });
    let length = d.iter().map(|x| x.to_f64().powi(2)).sum::<f64>().sqrt();
    if unit == 2 && length > 0.0 {
        d = d.map(|x| float(x.to_f64() / length));
    }
    if (3..=7).contains(&kind) {
        for x in o.iter_mut().chain(&mut d) {
            let most = 1 << draw.below(6);
            *x = x.offset_ulps(draw.integer(-most, most));
        }
    }
    let mut all = [o, d, a.map(float), b.map(float), c.map(float)];
    if kind == 8 {
        // The whole case at another scale, up to where products underflow or overflow.
        let most = F::MAX_EXPONENT as i64;
        let (points, direction) = (draw.integer(-most, most), draw.integer(-most, most));
        let scaled = |x: F, exponent: i64| {
            float(crate::arith::scale_by_power_of_two(
                x.to_f64(),
                exponent as i32,
            ))
        };
        for (place, vector) in all.iter_mut().enumerate() {
            let exponent = if place == 1 { direction } else { points };
            *vector = vector.map(|x| scaled(x, exponent));
        }
    }
    all
}

/// Intervals whose ends lie at t, next to it, and far from it.
fn interval<F: Number + From<F>>(draw: &mut Draw, case: Case<F>) -> Case<F> {
    let infinity = F::infinity();
    let (ray, triangle) = prepared::<F, F>(case.vectors());
    let hit = triangle_hit(&triangle, &ray);
    let near = match hit {
        Some(t) => t.offset_ulps(draw.integer(-3, 3)),
        None => draw.symmetric(),
    };
    let zero = F::zero();
    let ends = [
        [zero, infinity],
        [-infinity, infinity],
        [near, infinity],
        [-infinity, near],
        [near, near],
        [zero, near],
        [near, near.offset_ulps(2)],
    ];
    let [t_min, t_max] = draw.pick(&ends);
    case.on(t_min, t_max)
}

/// The t of a hit in the scalar itself.
fn triangle_hit<F: Float, N: Number + From<F>>(
    triangle: &PreparedTriangle<F, N>,
    ray: &PreparedRay<F, N>,
) -> Option<F> {
    Some(
        triangle
            .hit_with(ray, -F::infinity(), F::infinity(), Edges::Closed)?
            .t,
    )
}

fn holds<F: Number + From<F>, N: Number + From<F>>(count: u64, least_decided: f64) {
    let mut decided = 0;
    for index in 0..count {
        let mut draw = Draw::new("margin", 1, index);
        let [o, d, a, b, c] = aimed::<F>(&mut draw);
        let case = Case::new(o, d, [a, b, c]);
        let case = interval(&mut draw, case);
        decided += u64::from(check::<F, N>(&case));
    }
    for case in hard_cases::<F>(2, count / 4) {
        check::<F, N>(&case);
    }
    let share = decided as f64 / count as f64;
    assert!(least_decided < share, "{share}");
}

#[test]
fn answers_are_right_in_every_format() {
    holds::<f32, f64>(40_000, 0.15);
    holds::<f64, f64>(40_000, 0.15);
    holds::<f32, f32>(40_000, 0.05);
}

#[test]
fn the_definition_says_the_same() {
    for index in 0..2_000 {
        let mut draw = Draw::new("margin", 2, index);
        let [o, d, a, b, c] = aimed::<f32>(&mut draw);
        let case = Case::new(o, d, [a, b, c]);
        let (ray, triangle) = prepared::<f32, f64>(case.vectors());
        let hit = triangle.hit_with(&ray, 0.0, f32::INFINITY, Edges::Closed);
        let definition = define(&case);
        let is_met =
            definition.truth.crossing().is_some() && definition.truth.hits_closed() == Some(true);
        assert_eq!(hit.is_some(), is_met, "{}", case.hex());
        let (Some(hit), Some(t)) = (hit, definition.exact.t) else {
            continue;
        };
        // Right to 2^-24 of itself and of an edge, and rounded once more.
        let exact = num_traits::ToPrimitive::to_f64(&t).unwrap();
        let size = |v: [f32; 3]| v.iter().map(|x| f64::from(*x).powi(2)).sum::<f64>().sqrt();
        let [e, f] = [b, c].map(|p| size([0, 1, 2].map(|i| p[i] - a[i])));
        // A t beyond all numbers is given as the largest.
        if f64::from(f32::MAX) < exact.abs() {
            continue;
        }
        let allowed = 2f64.powi(-24) * 1.01 * (2.0 * exact.abs() + e.min(f) / size(d)) + 1e-45;
        let off = (f64::from(hit.t) - exact).abs();
        assert!(off <= allowed, "{off} {allowed} {}", case.hex());
    }
}

#[test]
fn what_is_not_finite_is_a_miss() {
    let good = [
        [0.25, 0.25, 1.0],
        [0.0, 0.0, -1.0],
        [0.0; 3],
        [1.0, 0.0, 0.0],
        [0.0, 1.0, 0.0],
    ];
    assert!(check::<f64, f64>(&Case::new(
        good[0],
        good[1],
        [good[2], good[3], good[4]]
    )));
    for place in 0..15 {
        for x in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            let mut bad = good;
            bad.as_flattened_mut()[place] = x;
            let (ray, triangle) = prepared::<f64, f64>(bad);
            assert_eq!(triangle.decide(&ray, 0.0, 9.0), Answer::Ask, "{bad:?}");
            assert_eq!(triangle.hit(&ray, 0.0, 9.0), None, "{bad:?}");
        }
    }
    let (ray, triangle) = prepared::<f64, f64>(good);
    for [t_min, t_max] in [[f64::NAN, 9.0], [0.0, f64::NAN], [9.0, 0.0], [1.5, 0.5]] {
        assert_eq!(triangle.hit(&ray, t_min, t_max), None);
    }
    assert!(triangle.hit(&ray, 1.0, 1.0).is_some());
    assert!(triangle.hit(&ray, f64::NEG_INFINITY, f64::MAX).is_some());
}

#[test]
fn t_beyond_the_largest_float_is_told_as_that() {
    let [far, size, d] = [2f32.powi(100), 1e30, -(2f32.powi(-28))];
    let vectors = [
        [2.5e29, 2.5e29, 2f32.powi(70)],
        [0.0, 0.0, d],
        [0.0, 0.0, -far],
        [size, 0.0, -far],
        [0.0, size, -far],
    ];
    let (ray, triangle) = prepared::<f32, f64>(vectors);
    let hit = triangle
        .hit_with(&ray, 0.0, f32::INFINITY, Edges::Once)
        .unwrap();
    assert_eq!(hit.t, f32::MAX);
}
