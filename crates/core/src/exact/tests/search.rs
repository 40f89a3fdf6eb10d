//! Searches for rays that are answered wrongly: with the whole margin none is found, with an eighth of it some are.

use super::*;

/// Moves one coordinate of a ray between where a margin still decides and where it does not, until both are neighbours or
/// nearly so. Returns the decided ones.
fn at_the_margin<F: Number + From<F>>(
    draw: &mut Draw,
    vectors: Vectors<F>,
    share: F,
) -> Vec<(Vectors<F>, Answer<F>)> {
    let (vector, axis) = (draw.below(2), draw.below(3));
    let step = 2f64.powi(draw.integer(-18, 0) as i32) * (1.0 + draw.unit());
    let with = |x: F| {
        let mut moved = vectors;
        moved[vector][axis] = x;
        moved
    };
    let answer = |x: F| {
        let (ray, triangle) = prepared::<F, F>(with(x));
        let triangle = triangle.with_margins_times(share);
        triangle.decide(&ray, -F::infinity(), F::infinity())
    };
    let kind = |answer: &Answer<F>| std::mem::discriminant(answer);
    let x = vectors[vector][axis].to_f64();
    let ends = [x - step, x + step].map(F::from_f64);
    let mut found = Vec::new();
    for [mut good, mut bad] in [ends, [ends[1], ends[0]]] {
        let first = answer(good);
        if first == Answer::Ask {
            continue;
        }
        for _ in 0..30 {
            let middle = F::from_f64((good.to_f64() + bad.to_f64()) / 2.0);
            if kind(&answer(middle)) == kind(&first) {
                good = middle;
            } else {
                bad = middle;
            }
        }
        found.push((with(good), answer(good)));
    }
    found
}

/// The number of wrong answers that a search finds with a share of each margin.
fn searched<F: Number + From<F>>(count: u64, share: F) -> usize {
    let mut wrong = 0;
    for index in 0..count {
        let mut draw = Draw::new("margin search", 1, index);
        let vectors = aimed::<F>(&mut draw);
        for (vectors, answer) in at_the_margin(&mut draw, vectors, share) {
            let [o, d, a, b, c] = vectors;
            let infinity = F::infinity();
            let case = Case::new(o, d, [a, b, c]).on(-infinity, infinity);
            wrong += usize::from(is_wrong(&answer, &truth(&case)));
        }
    }
    wrong
}

#[test]
fn a_search_finds_no_wrong_answer() {
    assert_eq!(searched::<f32>(20_000, 1.0), 0);
    assert_eq!(searched::<f64>(20_000, 1.0), 0);
}

/// A ray by an edge or a vertex whose margin is tight: the origin of the coordinates lies between ray and triangle, and the
/// vectors have coordinates of different sizes.
fn tight(draw: &mut Draw) -> Vectors<f32> {
    let near = |draw: &mut Draw, size: f32| {
        [(); 3].map(|()| size * draw.symmetric::<f32>() / (1 << draw.below(5)) as f32)
    };
    let [e, f, toward] = [1.0, 1.0, 1.0].map(|size| near(draw, size));
    let share = draw.unit() as f32;
    let far = draw.pick(&[1.0, 4.0, 64.0]);
    let a = toward.map(|x| far * share * x);
    let [b, c] = [e, f].map(|edge| [0, 1, 2].map(|i| a[i] + edge[i]));
    let u = draw.pick(&[0.0, 0.5, 1.0]);
    let v = if draw.coin() { 1.0 - u } else { 0.0 };
    let target = [0, 1, 2].map(|i| a[i] + u * e[i] + v * f[i]);
    let o = [0, 1, 2].map(|i| target[i] - far * toward[i]);
    [o, toward, a, b, c]
}

/// How far an answer is wrong, in margins. Below 0 where it is right; then it rises towards the boundary.
fn wrongness(vectors: Vectors<f32>) -> f32 {
    let (ray, triangle) = prepared::<f32, f32>(vectors);
    let (fine_ray, fine) = prepared::<f32, f64>(vectors);
    let x = triangle.numbers(&ray).x;
    let exact = fine.numbers(&fine_ray).x as f32;
    let margin = triangle.margin(&ray);
    // The larger of false hit and false miss.
    let [hit, miss] =
        [[x, exact], [-x, -exact]].map(|[x, exact]| (x - 2.0 * exact.max(0.0)) / margin);
    hit.max(miss)
}

/// Climbs from a ray to one that is answered more wrongly, by changes of last digits.
fn climb(draw: &mut Draw, mut best: Vectors<f32>) -> Vectors<f32> {
    let mut score = wrongness(best);
    for _ in 0..15_000 {
        let mut next = best;
        for _ in 0..draw.integer(1, 3) {
            let most = 1 << draw.below(18);
            let x = &mut next[draw.below(5)][draw.below(3)];
            *x = x.offset_ulps(draw.integer(-most, most));
        }
        let new = wrongness(next);
        if score <= new {
            (best, score) = (next, new);
        }
    }
    best
}

#[test]
fn an_eighth_of_the_margin_is_too_little() {
    let (mut worst, mut wrong) = (0f32, 0);
    for index in 0..250 {
        let mut draw = Draw::new("margin climb", 1, index);
        let start = tight(&mut draw);
        let vectors = climb(&mut draw, start);
        let [o, d, a, b, c] = vectors;
        let case = Case::new(o, d, [a, b, c]).on(f32::NEG_INFINITY, f32::INFINITY);
        check::<f32, f32>(&case);
        worst = worst.max(wrongness(vectors));
        let (ray, triangle) = prepared::<f32, f32>(vectors);
        let narrow = triangle.with_margins_times(0.125);
        let answer = narrow.decide(&ray, f32::NEG_INFINITY, f32::INFINITY);
        wrong += usize::from(is_wrong(&answer, &truth(&case)));
    }
    assert!(
        0 < wrong && worst < 1.0,
        "{wrong} wrong, {worst} of a margin"
    );
}
