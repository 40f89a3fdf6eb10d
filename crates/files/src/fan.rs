//! The faces of a mesh: whether a triangle has an area, and whether a polygon's fan folds over.
//!
//! Both are decided without error: in double-doubles with a bound where that suffices, and in exact numbers
//! where it does not.

use crate::arith::{Bounded, Exact, Real, Triple, Vector, bounded};
use glam::{DVec3, Vec3Swizzles};
use std::cmp::Ordering;

/// Decides a question in either arithmetic, given how to make a number from a float.
macro_rules! decide {
    ($question:ident($($argument:expr),*)) => {
        bounded(|| $question(Bounded::new, $($argument),*))
            .unwrap_or_else(|| $question(Exact::from_f64, $($argument),*))
    };
}
pub(super) use decide;

/// True if the corners of a triangle lie on one line, or on one point. Coordinates are finite.
pub fn is_without_area(corners: [[f64; 3]; 3]) -> bool {
    decide!(normal_is_zero(&corners))
}

/// True if the fan of triangles from a polygon's first corner folds over; at least three corners,
/// with finite coordinates.
///
/// A sound fan bends by less than a right angle from each triangle to the next. And seen along the
/// polygon's vector area (the sum of the fan's normals), its arms, from the first corner to each of
/// the others, turn one way only and by less than a full turn, so that no two triangles overlap.
/// Every flat convex polygon has a sound fan, and so have the concave ones whose first corner sees
/// all others. Triangles without area do not count as folds unless an arm turns back on itself; a
/// polygon wholly without area does not fold.
pub(super) fn folds(corners: &[[f64; 3]]) -> bool {
    decide!(fan_folds(corners))
}

/// True if a closed fan goes once around its centre, as seen along a direction from which all its
/// triangles face alike. `ring` holds the points around the centre in their order; all finite.
pub fn winds_once(direction: [f64; 3], centre: [f64; 3], ring: &[[f64; 3]]) -> bool {
    let in_floats = turns_once(ring.len(), |i| {
        side_in_floats(direction, centre, ring[0], ring[i])
    });
    in_floats.unwrap_or_else(|| decide!(fan_turns_once(&direction, &centre, ring)))
}

fn fan_turns_once<R: Real>(
    number: fn(f64) -> R,
    direction: &[f64; 3],
    centre: &[f64; 3],
    ring: &[[f64; 3]],
) -> bool {
    let direction = Triple::from(direction.map(number));
    let arms: Vec<_> = ring
        .iter()
        .map(|point| arm(number, centre, point))
        .collect();
    let side = |i: usize| Some(sign(&arms[0].cross(&arms[i]).dot(&direction)));
    turns_once(arms.len(), side).expect("every side is known")
}

/// True if points turn once around a centre. `side` gives for each point but the first on which side of the first it
/// lies; the result is none where a side is not known.
///
/// Each step turns the same way, by less than half a turn, so that on which half the points lie,
/// counted from the first, tells how often they go around.
fn turns_once(points: usize, side: impl Fn(usize) -> Option<Ordering>) -> Option<bool> {
    let turn = side(1)?;
    let (mut rounds, mut beyond_half) = (1, false);
    for i in 1..points {
        let side = side(i)?;
        // On the line of the first point: opposite to it after the first half, at it after the second.
        let first_half = if side == Ordering::Equal {
            beyond_half
        } else {
            side == turn
        };
        if first_half && beyond_half {
            rounds += 1;
        }
        beyond_half = !first_half;
    }
    Some(rounds == 1)
}

/// The sign of (p - centre) × (q - centre) · direction in floats; none where rounding might change it.
fn side_in_floats(
    direction: [f64; 3],
    centre: [f64; 3],
    p: [f64; 3],
    q: [f64; 3],
) -> Option<Ordering> {
    let arm = |to: [f64; 3]| DVec3::from(to) - DVec3::from(centre);
    let (e, f, d) = (arm(p), arm(q), DVec3::from(direction));
    let side = e.cross(f).dot(d);
    let [e, f, d] = [e, f, d].map(DVec3::abs);
    // The sum of the sizes of the six terms. Each has two differences and two products, and is added three times: its
    // error is below 8 units of 2^-53 of its size. Within these sizes underflow adds less than the rest of 16.
    let sizes = (e.yzx() * f.zxy() + e.zxy() * f.yzx()).dot(d);
    let is_moderate = (1e-150..1e150).contains(&sizes) && d.max_element() < 1e100;
    let is_certain = is_moderate && side.abs() > 8.0 * f64::EPSILON * sizes;
    is_certain.then_some(if side < 0.0 {
        Ordering::Less
    } else {
        Ordering::Greater
    })
}

fn normal_is_zero<R: Real>(number: fn(f64) -> R, [a, b, c]: &[[f64; 3]; 3]) -> bool {
    is_zero(&arm(number, a, b).cross(&arm(number, a, c)))
}

fn fan_folds<R: Real>(number: fn(f64) -> R, corners: &[[f64; 3]]) -> bool {
    let arms: Vec<_> = corners[1..]
        .iter()
        .map(|corner| arm(number, &corners[0], corner))
        .collect();
    let normals: Vec<_> = arms
        .windows(2)
        .map(|pair| pair[0].cross(&pair[1]))
        .collect();
    let zero = arm(number, &corners[0], &corners[0]);
    let area = normals.iter().fold(zero, |area, normal| area.plus(normal));
    let normals: Vec<_> = normals.iter().filter(|normal| !is_zero(normal)).collect();
    if normals.is_empty() {
        return false;
    }
    if normals
        .windows(2)
        .any(|pair| sign(&pair[0].dot(pair[1])) != Ordering::Greater)
    {
        return true;
    }
    let arms: Vec<_> = arms.iter().filter(|arm| !is_zero(arm)).collect();
    let mut beyond_half = false;
    for pair in arms.windows(2) {
        let step = pair[0].cross(pair[1]);
        match sign(&step.dot(&area)) {
            Ordering::Greater => {}
            Ordering::Equal
                if is_zero(&step) && sign(&pair[0].dot(pair[1])) == Ordering::Greater => {}
            _ => return true,
        }
        // Each step is below half a turn, so a fan that comes back to the first half has gone round.
        let second_half = sign(&arms[0].cross(pair[1]).dot(&area)) == Ordering::Less;
        if beyond_half && !second_half {
            return true;
        }
        beyond_half = second_half;
    }
    false
}

fn arm<R: Real>(number: fn(f64) -> R, from: &[f64; 3], to: &[f64; 3]) -> Triple<R> {
    Triple::from(to.map(number)).minus(&Triple::from(from.map(number)))
}

fn is_zero<R: Real>(vector: &Triple<R>) -> bool {
    (0..3).all(|axis| vector.at(axis).is_zero())
}

/// The sign of a number that is not NaN.
pub(super) fn sign<R: Real>(number: &R) -> Ordering {
    match number.is_sign_negative() {
        true => Ordering::Less,
        false if number.is_zero() => Ordering::Equal,
        false => Ordering::Greater,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The answers of both arithmetics; the bounded one may be missing but not wrong.
    fn fold_of(corners: &[[f64; 3]]) -> bool {
        let exact = fan_folds(Exact::from_f64, corners);
        assert_eq!(folds(corners), exact, "{corners:?}");
        exact
    }

    fn flat(points: &[[f64; 2]]) -> Vec<[f64; 3]> {
        points.iter().map(|[x, y]| [*x, *y, 7.0]).collect()
    }

    const DART: [[f64; 2]; 4] = [[0.0, 3.0], [-2.0, -2.0], [0.0, 0.0], [2.0, -2.0]];

    #[test]
    fn convex_polygons_do_not_fold_from_any_corner_and_either_way_round() {
        let mut points = vec![[0.0, 0.0], [2.0, 0.0], [3.0, 2.0], [1.0, 4.0], [-1.0, 2.0]];
        for _ in 0..5 {
            points.rotate_left(1);
            assert!(!fold_of(&flat(&points)));
            let reversed: Vec<_> = points.iter().rev().copied().collect();
            assert!(!fold_of(&flat(&reversed)));
        }
    }

    #[test]
    fn a_dart_folds_except_from_its_tip_and_from_its_notch() {
        let folds: Vec<bool> = (0..4)
            .map(|start| {
                let mut points = DART;
                points.rotate_left(start);
                fold_of(&flat(&points))
            })
            .collect();
        assert_eq!(folds, [false, true, false, true]);
    }

    #[test]
    fn bow_ties_pentagrams_and_spirals_fold() {
        assert!(fold_of(&flat(&[
            [0.0, 0.0],
            [1.0, 1.0],
            [1.0, 0.0],
            [0.0, 1.0]
        ])));
        let star = [
            [3.0, 0.0],
            [-2.0, 2.0],
            [1.0, -3.0],
            [1.0, 3.0],
            [-2.0, -2.0],
        ];
        assert!(fold_of(&flat(&star)));
        // Around the first corner once and a quarter: every triangle of the fan turns left.
        let mut spiral = vec![[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0]];
        assert!(!fold_of(&flat(&spiral)), "three quarters of a turn");
        spiral.extend([[2.0, -0.5], [0.0, 2.0]]);
        assert!(fold_of(&flat(&spiral)));
        spiral.truncate(6);
        assert!(!fold_of(&flat(&spiral)), "not yet a full turn");
        spiral[5] = [2.0, 0.0];
        assert!(fold_of(&flat(&spiral)), "exactly a full turn");
    }

    #[test]
    fn corners_on_an_edge_do_not_fold_but_an_arm_that_turns_back_does() {
        let third = 1.0 / 3.0;
        let on_edge = [[0.0, 0.0], [third, 1.0], [2.0 * third, 2.0], [-2.0, 1.0]];
        assert!(!fold_of(&flat(&on_edge)));
        // The edge from the third corner to the fourth runs through the first.
        let through = [
            [0.0, 0.0],
            [1.0, 0.0],
            [-1.0, 1.0],
            [1.0, -1.0],
            [2.0, -1.0],
        ];
        assert!(fold_of(&flat(&through)));
        let line = [[0.0, 0.0], [1.0, 1.0], [-3.0, -3.0], [2.0, 2.0]];
        assert!(!fold_of(&flat(&line)), "without area");
    }

    #[test]
    fn a_fan_that_goes_around_its_centre_twice_is_told_from_one_that_goes_once() {
        let ring = |points: &[[i32; 2]]| -> Vec<[f64; 3]> {
            let at =
                |(i, [x, y]): (usize, &[i32; 2])| [f64::from(*x), f64::from(*y), i as f64 / 8.0];
            points.iter().enumerate().map(at).collect()
        };
        let centre = [0.0, 0.0, -1.0 / 3.0];
        let once = [[1, 0], [1, 1], [0, 1], [-1, 0], [-1, -1], [0, -1]];
        let twice = [[2, 1], [-2, 3], [-1, -1], [2, -1], [1, 2], [-2, 0], [0, -1]];
        let mut back_at_the_start = once.to_vec();
        back_at_the_start.extend(once);
        for direction in [[0.0, 0.0, 1.0], [0.0, 0.0, -2.0], [0.0, 0.1, -1.0]] {
            for (points, expected) in [
                (&once[..], true),
                (&twice[..], false),
                (&back_at_the_start[..], false),
            ] {
                let mut ring = ring(points);
                for _ in 0..ring.len() {
                    ring.rotate_left(1);
                    assert_eq!(winds_once(direction, centre, &ring), expected, "{ring:?}");
                    let exact = fan_turns_once(Exact::from_f64, &direction, &centre, &ring);
                    assert_eq!(exact, expected);
                }
            }
        }
    }

    #[test]
    fn repeated_corners_do_not_fold() {
        for points in [
            [[0.0, 0.0], [0.0, 0.0], [1.0, 0.0], [0.0, 1.0]],
            [[0.0, 0.0], [1.0, 0.0], [1.0, 0.0], [0.0, 1.0]],
            [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [0.0, 0.0]],
        ] {
            assert!(!fold_of(&flat(&points)));
        }
    }

    #[test]
    fn a_polygon_folds_if_it_is_bent_by_a_right_angle_or_more() {
        let quad = |height: f64| {
            fold_of(&[
                [0.0, 0.0, 0.0],
                [1.0, 0.0, height],
                [1.0, 1.0, 0.0],
                [0.0, 1.0, height],
            ])
        };
        assert!(!quad(0.25));
        // The normals are (-h, h, 1) and (h, -h, 1).
        assert!(!quad(0.7));
        assert!(quad(0.75));
        let at_right_angles = [
            [0.0, 0.0, 0.0],
            [1.0, 0.0, 0.0],
            [1.0, 1.0, 0.0],
            [1.0, 1.0, 1.0],
        ];
        assert!(fold_of(&at_right_angles));
        // A steep roof around the first corner: each bend is small, but its ends face each other.
        let ring = [[4, 0], [3, 3], [0, 4], [-3, 3], [-4, 0], [-3, -3], [0, -4]];
        let mut roof = vec![[0.0, 0.0, 20.0]];
        roof.extend(ring.map(|[x, y]| [f64::from(x), f64::from(y), 0.0]));
        assert!(fold_of(&roof));
        roof[0][2] = 2.0;
        assert!(!fold_of(&roof));
        // Three gentle bends again, the last triangle small and seen from behind.
        let arms = [
            [200, -100, -4000],
            [200, 100, -4000],
            [0, 20, -400],
            [-2, 1, -40],
        ];
        let mut hook = vec![[0.0; 3]];
        hook.extend(arms.map(|arm| arm.map(f64::from)));
        assert!(fold_of(&hook));
        hook.pop();
        assert!(!fold_of(&hook));
        let closed_book = [
            [0.0, 0.0, 0.0],
            [1.0, 0.0, 0.0],
            [1.0, 1.0, 0.0],
            [1.0, 0.0, 0.1],
        ];
        assert!(fold_of(&closed_book));
    }

    #[test]
    fn areas_that_rounding_hides_are_decided_exactly() {
        let [a, b] = [[0.1, 0.2, 0.3], [0.7, 0.9, 1.1]];
        let middle: [f64; 3] = std::array::from_fn(|k| a[k] + (b[k] - a[k]) * 0.5);
        // Rounded to the line's neighbourhood, not onto it.
        assert!(!is_without_area([a, b, middle]));
        let double = |v: [f64; 3]| v.map(|x| 2.0 * x);
        assert!(is_without_area([[0.0; 3], a, double(a)]));
        assert!(is_without_area([a, a, b]));
        for scale in [1e-200, 1e200, 5e-324] {
            assert!(
                !is_without_area([[0.0; 3], [scale, 0.0, 0.0], [0.0, scale, 0.0]]),
                "{scale}"
            );
            assert!(
                is_without_area([[0.0; 3], [scale; 3], [2.0 * scale; 3]]),
                "{scale}"
            );
        }
        assert!(is_without_area([[f64::MIN; 3], [0.0; 3], [f64::MAX; 3]]));
    }
}
