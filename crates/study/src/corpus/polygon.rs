//! A polygon cut into triangles, without error: the fan from its first corner where that does not fold over, and
//! otherwise ear after ear.

use super::fan::{decide, folds, sign};
use crate::arith::{Bounded, Exact, Real, bounded};
use std::cmp::Ordering;

/// The most corners of a polygon whose ears are cut off; the time for it grows with their square, and faster for the worst.
const MOST: usize = 4096;

/// The numbers of a triangle's corners in its polygon.
type Three = [usize; 3];

/// The triangles of a polygon with at least three corners, finite; none if it crosses itself as seen along an axis, or has
/// no area so, or a fan that folds over and more than 4,096 corners.
pub(super) fn triangles(corners: &[[f64; 3]]) -> Option<Vec<Three>> {
    if corners.len() == 3 || !folds(corners) {
        return Some(
            (2..corners.len())
                .map(|corner| [0, corner - 1, corner])
                .collect(),
        );
    }
    if corners.len() > MOST {
        return None;
    }
    // Seen along the axis that is nearest to its normal; any axis would be right that is not in its plane.
    let sizes = [0, 1, 2].map(|axis| area_in_floats(&seen_along(axis, corners)).abs());
    let axis = (0..3).max_by(|i, j| sizes[*i].total_cmp(&sizes[*j]))?;
    let points = seen_along(axis, corners);
    let mut left: Vec<usize> = (0..corners.len()).collect();
    left.dedup_by_key(|corner| corners[*corner]);
    left.pop_if(|last| corners[*last] == corners[0]);
    ears(&points, left)
}

fn seen_along(axis: usize, corners: &[[f64; 3]]) -> Vec<[f64; 2]> {
    corners
        .iter()
        .map(|corner| [corner[(axis + 1) % 3], corner[(axis + 2) % 3]])
        .collect()
}

fn area_in_floats(points: &[[f64; 2]]) -> f64 {
    let [x, y] = points[0];
    let arm = |i: usize| [points[i][0] - x, points[i][1] - y];
    let twice = |i| arm(i)[0] * arm(i + 1)[1] - arm(i)[1] * arm(i + 1)[0];
    (1..points.len() - 1).map(twice).sum()
}

/// Cuts off a corner whose triangle holds no other, and again from the rest. The result is checked: all triangles turn the
/// polygon's way, and no two overlap.
fn ears(points: &[[f64; 2]], mut left: Vec<usize>) -> Option<Vec<Three>> {
    let points = Points {
        points,
        turn: decide!(turn_of(points)),
    };
    if points.turn == Ordering::Equal {
        return None;
    }
    let (mut ears, mut at, mut tried) = (Vec::new(), 0, 0);
    while left.len() > 3 {
        let last = left.len() - 1;
        let ear = [
            left[(at + last) % left.len()],
            left[at],
            left[(at + 1) % left.len()],
        ];
        if points.is_ear(ear, &left) {
            ears.push(ear);
            left.remove(at);
            // Back to the corner before, which has changed.
            (at, tried) = (if at == 0 { left.len() - 1 } else { at - 1 }, 0);
        } else if tried == last {
            return None;
        } else {
            (at, tried) = ((at + 1) % left.len(), tried + 1);
        }
    }
    ears.push([left[0], left[1], left[2]]);
    points.are_apart(&ears).then_some(ears)
}

fn turn_of<R: Real>(number: fn(f64) -> R, points: &[[f64; 2]]) -> Ordering {
    let pairs = points[1..].windows(2);
    let areas = pairs.map(|pair| twice_area(number, &[points[0], pair[0], pair[1]]));
    sign(&areas.fold(R::zero(), |sum, area| sum + area))
}

fn side_of<R: Real>(number: fn(f64) -> R, points: &[[f64; 2]; 3]) -> Ordering {
    sign(&twice_area(number, points))
}

fn twice_area<R: Real>(number: fn(f64) -> R, points: &[[f64; 2]; 3]) -> R {
    let [a, b, c] = points.map(|point| point.map(number));
    let [[ux, uy], [vx, vy]] = [b, c].map(|[x, y]| [x - &a[0], y - &a[1]]);
    ux * vy - uy * vx
}

/// The same in floats; none where rounding might change it.
fn side_in_floats([a, b, c]: &[[f64; 2]; 3]) -> Option<Ordering> {
    let [[ux, uy], [vx, vy]] = [b, c].map(|[x, y]| [x - a[0], y - a[1]]);
    let (left, right, size) = (ux * vy, uy * vx, (ux * vy).abs() + (uy * vx).abs());
    if (ux == 0.0 || vy == 0.0) && (uy == 0.0 || vx == 0.0) {
        return Some(Ordering::Equal);
    }
    // Two differences, two products and their difference: below 4 units of 2^-53 of the size, and what underflows is less than
    // the rest of 8.
    let is_certain = (left - right).abs() > 4.0 * f64::EPSILON * size;
    let is_moderate = (1e-150..1e150).contains(&size);
    left.partial_cmp(&right)
        .filter(|_| is_certain && is_moderate)
}

struct Points<'a> {
    points: &'a [[f64; 2]],
    /// How the polygon turns.
    turn: Ordering,
}

impl Points<'_> {
    /// On which side of an edge a point lies: `Greater` inside.
    fn side(&self, from: usize, to: usize, point: usize) -> Ordering {
        let points = [from, to, point].map(|corner| self.points[corner]);
        let side = side_in_floats(&points).unwrap_or_else(|| decide!(side_of(&points)));
        if self.turn == Ordering::Less {
            side.reverse()
        } else {
            side
        }
    }

    /// The least and the greatest coordinate of a triangle.
    fn span(&self, triangle: Three, axis: usize) -> [f64; 2] {
        let [a, b, c] = triangle.map(|corner| self.points[corner][axis]);
        [a.min(b).min(c), a.max(b).max(c)]
    }

    /// True if a triangle turns the polygon's way, and holds no corner that is left but its own, nor on its boundary.
    fn is_ear(&self, triangle: Three, left: &[usize]) -> bool {
        let [a, b, c] = triangle;
        let spans = [0, 1].map(|axis| self.span(triangle, axis));
        let holds = |point: &usize| {
            let place = self.points[*point];
            let is_near = (0..2).all(|k| spans[k][0] <= place[k] && place[k] <= spans[k][1]);
            is_near
                && triangle.iter().all(|corner| self.points[*corner] != place)
                && [(a, b), (b, c), (c, a)]
                    .iter()
                    .all(|(from, to)| self.side(*from, *to, *point) != Ordering::Less)
        };
        self.side(a, b, c) == Ordering::Greater && !left.iter().any(holds)
    }

    /// True if all triangles turn the polygon's way, and the insides of any two are apart: an edge of one has the other
    /// on its outer side.
    fn are_apart(&self, triangles: &[Three]) -> bool {
        let keeps_out = |[a, b, c]: Three, other: Three| {
            let is_out = |(from, to)| {
                other
                    .iter()
                    .all(|p| self.side(from, to, *p) != Ordering::Greater)
            };
            [(a, b), (b, c), (c, a)].into_iter().any(is_out)
        };
        let are_apart = |one: Three, other: Three| {
            let beside = (0..2).any(|axis| {
                let [[low, high], [other_low, other_high]] =
                    [one, other].map(|it| self.span(it, axis));
                high <= other_low || other_high <= low
            });
            beside || keeps_out(one, other) || keeps_out(other, one)
        };
        let turns = |[a, b, c]: &Three| self.side(*a, *b, *c) == Ordering::Greater;
        triangles.iter().all(turns)
            && triangles
                .iter()
                .enumerate()
                .all(|(i, one)| triangles[..i].iter().all(|other| are_apart(*one, *other)))
    }
}

#[cfg(test)]
mod tests {
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
                    let between = |axis: usize| {
                        (a[axis].min(b[axis])..=a[axis].max(b[axis])).contains(&p[axis])
                    };
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
}
