//! A polygon cut into triangles, without error: the fan from its first corner where that does not fold over, and
//! otherwise ear after ear.

use super::fan::{decide, folds, sign};
use crate::arith::{Bounded, Exact, Real, bounded};
use std::cmp::Ordering;

/// The most corners of a polygon whose ears are cut off; the time for it grows with their square, and faster for the worst.
const MOST: usize = 4096;

/// The numbers of a triangle's corners in its polygon.
type Three = [usize; 3];

/// A point as seen along an axis.
type Point = [f64; 2];

/// The triangles of a polygon with at least three corners, finite; none if it crosses itself as seen along an axis, or has
/// no area so, or a fan that folds over and more than 4,096 corners.
pub(super) fn triangles(corners: &[[f64; 3]]) -> Option<Vec<Three>> {
    if corners.len() == 3 || !folds(corners) {
        return Some(fan(corners.len()));
    }
    if corners.len() > MOST {
        return None;
    }
    let points = seen_along(widest_axis(corners), corners);
    let mut left: Vec<usize> = (0..corners.len()).collect();
    left.dedup_by_key(|corner| corners[*corner]);
    left.pop_if(|last| corners[*last] == corners[0]);
    ears(&points, left)
}

/// The triangles from the first corner to each edge that it is not an end of.
fn fan(corners: usize) -> Vec<Three> {
    let mut triangles = Vec::with_capacity(corners - 2);
    for corner in 2..corners {
        triangles.push([0, corner - 1, corner]);
    }
    triangles
}

/// The axis nearest to the polygon's normal; any axis would be right that is not in its plane.
fn widest_axis(corners: &[[f64; 3]]) -> usize {
    let mut widest = 0;
    let mut largest = 0.0;
    for axis in 0..3 {
        let area = area_in_floats(&seen_along(axis, corners)).abs();
        if area.total_cmp(&largest) != Ordering::Less {
            widest = axis;
            largest = area;
        }
    }
    widest
}

fn seen_along(axis: usize, corners: &[[f64; 3]]) -> Vec<Point> {
    let right = (axis + 1) % 3;
    let up = (axis + 2) % 3;
    corners
        .iter()
        .map(|corner| [corner[right], corner[up]])
        .collect()
}

/// Twice the area of a polygon as floats compute it.
fn area_in_floats(points: &[Point]) -> f64 {
    let [x, y] = points[0];
    let mut sum = 0.0;
    for pair in points[1..].windows(2) {
        let from = [pair[0][0] - x, pair[0][1] - y];
        let to = [pair[1][0] - x, pair[1][1] - y];
        sum += from[0] * to[1] - from[1] * to[0];
    }
    sum
}

/// Cuts off a corner whose triangle holds no other, and again from the rest. The result is checked: all triangles turn the
/// polygon's way, and no two overlap.
fn ears(points: &[Point], mut left: Vec<usize>) -> Option<Vec<Three>> {
    let turn = decide!(turn_of(points));
    if turn == Ordering::Equal {
        return None;
    }
    let points = Points { points, turn };
    let mut ears = Vec::new();
    let mut at = 0;
    let mut tried = 0;
    while left.len() > 3 {
        let last = left.len() - 1;
        let before = if at == 0 { last } else { at - 1 };
        let after = if at == last { 0 } else { at + 1 };
        let ear = [left[before], left[at], left[after]];
        if points.is_ear(ear, &left) {
            ears.push(ear);
            left.remove(at);
            // Back to the corner before, which has changed. Where the first is cut off, that is the last of those left.
            at = if at == 0 { last - 1 } else { before };
            tried = 0;
        } else if tried == last {
            return None;
        } else {
            at = after;
            tried += 1;
        }
    }
    ears.push([left[0], left[1], left[2]]);
    points.are_apart(&ears).then_some(ears)
}

/// The way in which a polygon turns: the sign of its area.
fn turn_of<R: Real>(number: fn(f64) -> R, points: &[Point]) -> Ordering {
    let mut area = R::zero();
    for pair in points[1..].windows(2) {
        area = area + twice_area(number, &[points[0], pair[0], pair[1]]);
    }
    sign(&area)
}

fn side_of<R: Real>(number: fn(f64) -> R, points: &[Point; 3]) -> Ordering {
    sign(&twice_area(number, points))
}

fn twice_area<R: Real>(number: fn(f64) -> R, points: &[Point; 3]) -> R {
    let [[ax, ay], b, c] = points.map(|point| point.map(number));
    let [[ux, uy], [vx, vy]] = [b, c].map(|[x, y]| [x - &ax, y - &ay]);
    ux * vy - uy * vx
}

/// The side of a line on which a point lies, in floats; none where rounding might change it.
fn side_in_floats([a, b, c]: &[Point; 3]) -> Option<Ordering> {
    let [[ux, uy], [vx, vy]] = [b, c].map(|[x, y]| [x - a[0], y - a[1]]);
    let left = ux * vy;
    let right = uy * vx;
    let left_is_zero = ux == 0.0 || vy == 0.0;
    let right_is_zero = uy == 0.0 || vx == 0.0;
    if left_is_zero && right_is_zero {
        return Some(Ordering::Equal);
    }
    let size = left.abs() + right.abs();
    if !(1e-150..1e150).contains(&size) {
        return None;
    }
    // Two differences, two products and their difference: below 4 units of 2^-53 of the size, and what underflows is less than
    // the rest of 8.
    if (left - right).abs() > 4.0 * f64::EPSILON * size {
        left.partial_cmp(&right)
    } else {
        None
    }
}

/// The least and the greatest coordinates of a triangle, by axis.
struct Bounds {
    low: Point,
    high: Point,
}

impl Bounds {
    fn holds(&self, point: Point) -> bool {
        (0..2).all(|axis| self.low[axis] <= point[axis] && point[axis] <= self.high[axis])
    }

    /// True if the insides of both have no point in common.
    fn is_beside(&self, other: &Bounds) -> bool {
        (0..2).any(|axis| self.high[axis] <= other.low[axis] || other.high[axis] <= self.low[axis])
    }
}

/// The edges of a triangle, each as the corners from which and to which it runs.
fn edges([a, b, c]: Three) -> [[usize; 2]; 3] {
    [[a, b], [b, c], [c, a]]
}

struct Points<'a> {
    points: &'a [Point],
    /// How the polygon turns.
    turn: Ordering,
}

impl Points<'_> {
    /// On which side of an edge a point lies: `Greater` inside.
    fn side(&self, [from, to]: [usize; 2], point: usize) -> Ordering {
        let points = [from, to, point].map(|corner| self.points[corner]);
        let side = side_in_floats(&points).unwrap_or_else(|| decide!(side_of(&points)));
        if self.turn == Ordering::Less {
            side.reverse()
        } else {
            side
        }
    }

    fn bounds(&self, triangle: Three) -> Bounds {
        let [a, b, c] = triangle.map(|corner| self.points[corner]);
        Bounds {
            low: [0, 1].map(|axis| a[axis].min(b[axis]).min(c[axis])),
            high: [0, 1].map(|axis| a[axis].max(b[axis]).max(c[axis])),
        }
    }

    /// True if a triangle turns the polygon's way.
    fn turns_its_way(&self, [a, b, c]: Three) -> bool {
        self.side([a, b], c) == Ordering::Greater
    }

    /// True if a triangle turns the polygon's way, and holds no corner that is left but its own, nor on its boundary.
    fn is_ear(&self, triangle: Three, left: &[usize]) -> bool {
        if !self.turns_its_way(triangle) {
            return false;
        }
        let bounds = self.bounds(triangle);
        for point in left {
            if bounds.holds(self.points[*point]) && self.holds(triangle, *point) {
                return false;
            }
        }
        true
    }

    /// True if a triangle that turns the polygon's way holds a point that is none of its corners, if only on its boundary.
    fn holds(&self, triangle: Three, point: usize) -> bool {
        let place = self.points[point];
        if triangle.iter().any(|corner| self.points[*corner] == place) {
            return false;
        }
        edges(triangle)
            .into_iter()
            .all(|edge| self.side(edge, point) != Ordering::Less)
    }

    /// True if all triangles turn the polygon's way, and the insides of any two are apart.
    fn are_apart(&self, triangles: &[Three]) -> bool {
        for (i, one) in triangles.iter().enumerate() {
            let is_apart = |other: &Three| self.is_apart(*one, *other);
            if !self.turns_its_way(*one) || !triangles[..i].iter().all(is_apart) {
                return false;
            }
        }
        true
    }

    /// True if the insides of two triangles are apart: an edge of one has the other on its outer side.
    fn is_apart(&self, one: Three, other: Three) -> bool {
        self.bounds(one).is_beside(&self.bounds(other))
            || self.keeps_out(one, other)
            || self.keeps_out(other, one)
    }

    /// True if an edge of a triangle has another triangle on its outer side.
    fn keeps_out(&self, triangle: Three, other: Three) -> bool {
        let is_outside = |edge: [usize; 2]| {
            other
                .iter()
                .all(|corner| self.side(edge, *corner) != Ordering::Greater)
        };
        edges(triangle).into_iter().any(is_outside)
    }
}

#[cfg(test)]
mod tests;
