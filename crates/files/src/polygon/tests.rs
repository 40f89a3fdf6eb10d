//! Polygons that are cut: concave ones, ones with holes on bridges, ones that cross themselves, and random ones.

use super::*;
use crate::case::Draw;

/// A polygon of integers, put into a tilted plane at a power of two.
fn lifted(points: &[[i64; 2]], scale: f64) -> Vec<[f64; 3]> {
    let at = |[x, y]: &[i64; 2]| [x + y, 2 * y - x, x - 7].map(|c| c as f64 * scale);
    points.iter().map(at).collect()
}

fn twice_area([a, b, c]: [[i64; 2]; 3]) -> i64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

/// How often a polygon goes around a point that is on none of its edges: by edges that cross a ray to the right.
fn rounds(points: &[[i64; 2]], at: [i64; 2]) -> i64 {
    let edges = points.iter().zip(points.iter().cycle().skip(1));
    edges
        .map(|(from, to)| match (from[1] > at[1], to[1] > at[1]) {
            (false, true) if 0 < twice_area([*from, *to, at]) => 1,
            (true, false) if twice_area([*from, *to, at]) < 0 => -1,
            _ => 0,
        })
        .sum()
}

/// The triangles, which cover each place that the polygon goes around, and no other, once. Places are the points of
/// a grid that meets no line through two corners, as coordinates are multiples of 64 and below 64 · 64.
fn check(points: &[[i64; 2]]) -> Option<Vec<Three>> {
    let points: Vec<[i64; 2]> = points
        .iter()
        .map(|point| point.map(|x| 64 * 64 * x))
        .collect();
    let found = triangles(&lifted(&points, 0.25));
    for scale in [f64::powi(2.0, -980), f64::powi(2.0, 900)] {
        assert_eq!(triangles(&lifted(&points, scale)), found, "{points:?}");
    }
    let [low, high] =
        [i64::min, i64::max].map(|pick| points.iter().flatten().copied().reduce(pick).unwrap());
    let step = (high - low) / 20 + 1;
    for (i, j) in (0..400).map(|place| (place / 20, place % 20)) {
        let at = [low + i * step + 1 + 2 * j, low + j * step + 3 + 5 * i];
        let of_triangle = |triangle: &Three| {
            let corners = triangle.map(|corner| points[corner]);
            let edges =
                [[0, 1], [1, 2], [2, 0]].map(|[i, j]| twice_area([corners[i], corners[j], at]));
            if edges.contains(&0) {
                None
            } else {
                Some(rounds(&corners, at))
            }
        };
        let each: Option<Vec<i64>> = found.iter().flatten().map(of_triangle).collect();
        if let (Some(each), true) = (each, found.is_some()) {
            let covered: i64 = each.iter().sum();
            assert_eq!(covered, rounds(&points, at), "{points:?} at {at:?}");
            assert!(
                each.iter().filter(|rounds| **rounds != 0).count() < 2,
                "{points:?}"
            );
        }
    }
    found
}

const COMB: [[i64; 2]; 12] = [
    [0, 0],
    [9, 0],
    [9, 5],
    [8, 5],
    [8, 1],
    [6, 1],
    [6, 5],
    [5, 5],
    [5, 1],
    [1, 1],
    [1, 5],
    [0, 5],
];

#[test]
fn a_concave_polygon_is_cut_from_whichever_corner_it_begins() {
    let ell = [[0, 0], [4, 0], [4, 1], [1, 1], [1, 4], [0, 4]];
    let dart = [[0, 3], [-2, -2], [0, 0], [2, -2]];
    let spiral = [
        [0, 0],
        [9, 0],
        [9, 9],
        [2, 9],
        [2, 4],
        [5, 4],
        [5, 6],
        [4, 6],
        [4, 5],
        [3, 5],
        [3, 8],
        [8, 8],
        [8, 1],
        [0, 1],
    ];
    // Corners on edges, which other faces share.
    let flat = [
        [0, 0],
        [2, 0],
        [4, 0],
        [4, 1],
        [2, 1],
        [1, 1],
        [1, 3],
        [1, 4],
        [0, 4],
        [0, 2],
    ];
    for shape in [&ell[..], &dart, &COMB, &spiral, &flat] {
        let mut shape = shape.to_vec();
        for _ in 0..shape.len() {
            shape.rotate_left(1);
            let turned: Vec<_> = shape.iter().rev().copied().collect();
            for shape in [&shape, &turned] {
                assert_eq!(check(shape).expect("cut").len(), shape.len() - 2);
            }
        }
    }
    // The fan stays where it does not fold.
    assert_eq!(check(&dart), Some(vec![[0, 1, 2], [0, 2, 3]]));
    let turned = [dart[1], dart[2], dart[3], dart[0]];
    assert_eq!(check(&turned), Some(vec![[3, 0, 1], [1, 2, 3]]));
}

#[test]
fn a_hole_on_a_bridge_and_repeated_corners_are_cut() {
    let hole = [
        [0, 0],
        [8, 0],
        [8, 8],
        [0, 8],
        [0, 0],
        [2, 2],
        [2, 6],
        [6, 6],
        [6, 2],
        [2, 2],
    ];
    let found = check(&hole).expect("cut");
    assert_eq!(found.len(), hole.len() - 2);
    let mut twice: Vec<[i64; 2]> = COMB.iter().flat_map(|corner| [*corner; 2]).collect();
    twice.rotate_left(1);
    assert_eq!(check(&twice).expect("cut").len(), COMB.len() - 2);
}

#[test]
fn what_crosses_itself_or_is_too_long_is_not_cut() {
    let bow = [[0, 0], [2, 2], [2, 0], [0, 2]];
    let uneven_bow = [[0, 0], [5, 5], [5, 0], [0, 2]];
    let star = [[3, 0], [-2, 2], [1, -3], [1, 3], [-2, -2]];
    let twice = [
        [0, 0],
        [8, 0],
        [8, 8],
        [0, 8],
        [0, 1],
        [7, 1],
        [7, 7],
        [1, 7],
    ];
    let line = [[0, 0], [4, 0], [2, 0], [6, 0], [1, 0]];
    for shape in [&bow[..], &uneven_bow, &star, &twice] {
        assert_eq!(check(shape), None, "{shape:?}");
    }
    assert_eq!(
        check(&line).map(|fan| fan.len()),
        Some(3),
        "without area it does not fold"
    );
    let comb = |teeth: i64| -> Vec<[i64; 2]> {
        let tooth = |i: i64| [[2 * i, 5], [2 * i, 1], [2 * i - 1, 1], [2 * i - 1, 5]];
        let ends = [[0, 0], [2 * MOST as i64, 0]];
        ends.into_iter()
            .chain((1..=teeth).rev().flat_map(tooth))
            .collect()
    };
    let long = comb(1023);
    assert_eq!(
        triangles(&lifted(&long, 1.0)).map(|found| found.len()),
        Some(4092)
    );
    assert_eq!(triangles(&lifted(&comb(1024), 1.0)), None);
}

#[test]
fn any_simple_polygon_is_cut_and_nothing_that_overlaps() {
    let mut draw = Draw::new("polygons", 1, 0);
    let (mut cut, mut left_out) = (0, 0);
    for _ in 0..1500 {
        let corners = draw.integer(4, 9);
        let points: Vec<[i64; 2]> = (0..corners)
            .map(|_| [draw.integer(0, 6), draw.integer(0, 6)])
            .collect();
        let edge = |i: usize| [points[i], points[(i + 1) % points.len()]];
        let meet = |i: usize, j: usize| {
            let ([a, b], [c, d]) = (edge(i), edge(j));
            let side = |p, q, r| twice_area([p, q, r]).signum();
            let within = |p: [i64; 2]| {
                let between =
                    |axis: usize| (a[axis].min(b[axis])..=a[axis].max(b[axis])).contains(&p[axis]);
                side(a, b, p) == 0 && between(0) && between(1)
            };
            let cross = side(a, b, c) * side(a, b, d) < 0 && side(c, d, a) * side(c, d, b) < 0;
            let next_to = (i + 1) % points.len() == j;
            cross || within(d) || !next_to && within(c)
        };
        let is_simple = (0..points.len()).all(|i| {
            (0..points.len()).all(|j| i == j || (j + 1) % points.len() == i || !meet(i, j))
        });
        let found = check(&points);
        if is_simple {
            assert_eq!(
                found.map(|found| found.len()),
                Some(points.len() - 2),
                "{points:?}"
            );
            cut += 1;
        } else if found.is_none() {
            left_out += 1;
        }
    }
    assert!(cut > 100 && left_out > 100, "{cut} {left_out}");
}
