//! The faces of a mesh: does a triangle have an area, does a polygon's fan fold over, and does a closed fan go once around?
//!
//! All are decided without error: in numbers with a bound where that suffices, and in exact numbers where it does not.

use crate::arith::{Bounded, Exact, Real, Triple, Vector, bounded};
use glam::{DVec3, Vec3Swizzles};
use std::cmp::Ordering;

/// The answer to a question, in numbers with bounds if they decide it, else in exact ones.
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
    let side = |i: usize| sign(&arms[0].cross(&arms[i]).dot(&direction));
    turns_once(arms.len(), |i| Some(side(i))).expect("every side is known")
}

/// True if points turn once around a centre. `side` gives for each point but the first on which side of the first it
/// lies; the result is none where a side is not known.
///
/// Each step turns the same way, by less than half a turn. So the points go around once more wherever they come from the
/// second half, counted from the first point, to the first half.
fn turns_once(points: usize, side: impl Fn(usize) -> Option<Ordering>) -> Option<bool> {
    let first_step = side(1)?;
    let mut rounds = 1;
    let mut was_beyond_half = false;
    for i in 1..points {
        let is_beyond_half = match side(i)? {
            // On the line of the first point: opposite to it after the first half, at it after the second.
            Ordering::Equal => !was_beyond_half,
            side => side != first_step,
        };
        if was_beyond_half && !is_beyond_half {
            rounds += 1;
        }
        was_beyond_half = is_beyond_half;
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
    let centre = DVec3::from(centre);
    let to_p = DVec3::from(p) - centre;
    let to_q = DVec3::from(q) - centre;
    let direction = DVec3::from(direction);
    let side = to_p.cross(to_q).dot(direction);
    let [p_size, q_size, size] = [to_p, to_q, direction].map(DVec3::abs);
    // The sum of the sizes of the six terms. Each has two differences and two products, and is added three times: its
    // error is below 8 units of 2^-53 of its size. Within these sizes underflow adds less than the rest of 16.
    let sizes = (p_size.yzx() * q_size.zxy() + p_size.zxy() * q_size.yzx()).dot(size);
    let is_moderate = (1e-150..1e150).contains(&sizes) && size.max_element() < 1e100;
    let is_certain = is_moderate && side.abs() > 8.0 * f64::EPSILON * sizes;
    is_certain.then(|| side.total_cmp(&0.0))
}

fn normal_is_zero<R: Real>(number: fn(f64) -> R, [a, b, c]: &[[f64; 3]; 3]) -> bool {
    is_zero(&arm(number, a, b).cross(&arm(number, a, c)))
}

fn fan_folds<R: Real>(number: fn(f64) -> R, corners: &[[f64; 3]]) -> bool {
    let first = &corners[0];
    let others = corners[1..].iter();
    let mut arms: Vec<_> = others.map(|corner| arm(number, first, corner)).collect();
    let mut area = arm(number, first, first);
    let mut normals = Vec::new();
    for pair in arms.windows(2) {
        let normal = pair[0].cross(&pair[1]);
        area = area.plus(&normal);
        if !is_zero(&normal) {
            normals.push(normal);
        }
    }
    if normals.is_empty() {
        return false;
    }
    let mut bends = normals.windows(2);
    if !bends.all(|pair| is_positive(&pair[0].dot(&pair[1]))) {
        return true;
    }
    arms.retain(|arm| !is_zero(arm));
    let mut was_beyond_half = false;
    for pair in arms.windows(2) {
        if !turns_on(&pair[0], &pair[1], &area) {
            return true;
        }
        // Each step is below half a turn, so a fan that comes back to the first half has gone round.
        let is_beyond_half = sign(&arms[0].cross(&pair[1]).dot(&area)) == Ordering::Less;
        if was_beyond_half && !is_beyond_half {
            return true;
        }
        was_beyond_half = is_beyond_half;
    }
    false
}

/// True if the step from an arm to the next turns the way of the area, or does not turn at all.
fn turns_on<R: Real>(from: &Triple<R>, to: &Triple<R>, area: &Triple<R>) -> bool {
    let step = from.cross(to);
    match sign(&step.dot(area)) {
        Ordering::Greater => true,
        // Arms along one line: the next must not turn back.
        Ordering::Equal => is_zero(&step) && is_positive(&from.dot(to)),
        Ordering::Less => false,
    }
}

fn arm<R: Real>(number: fn(f64) -> R, from: &[f64; 3], to: &[f64; 3]) -> Triple<R> {
    Triple::from(to.map(number)).minus(&Triple::from(from.map(number)))
}

fn is_zero<R: Real>(vector: &Triple<R>) -> bool {
    (0..3).all(|axis| vector.at(axis).is_zero())
}

fn is_positive<R: Real>(number: &R) -> bool {
    sign(number) == Ordering::Greater
}

/// The sign of a number that is not NaN.
pub(super) fn sign<R: Real>(number: &R) -> Ordering {
    if number.is_sign_negative() {
        Ordering::Less
    } else if number.is_zero() {
        Ordering::Equal
    } else {
        Ordering::Greater
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
