//! The faces of a mesh: whether a triangle has an area, and whether a polygon's fan folds over.
//!
//! Both are decided without error: in `f64` with a bound on the rounding where that suffices, and
//! in exact numbers where it does not.

use crate::arith::Exact;
use std::cmp::Ordering;

/// Whether the corners of a triangle lie on one line, or on one point. Coordinates are finite.
pub(crate) fn is_without_area(corners: [[f64; 3]; 3]) -> bool {
    decide(normal_is_zero::<Rounded>(&corners), || normal_is_zero::<Exact>(&corners))
}

/// Whether the fan of triangles from a polygon's first corner folds over; at least three corners,
/// with finite coordinates.
///
/// A sound fan bends by less than a right angle from each triangle to the next. And seen along the
/// polygon's vector area (the sum of the fan's normals), its arms, from the first corner to each of
/// the others, turn one way only and by less than a full turn, so that no two triangles overlap.
/// Every flat convex polygon has a sound fan, and so have the concave ones whose first corner sees
/// all others. Triangles without area do not count as folds unless an arm turns back on itself; a
/// polygon wholly without area does not fold.
pub(super) fn folds(corners: &[[f64; 3]]) -> bool {
    decide(fan_folds::<Rounded>(corners), || fan_folds::<Exact>(corners))
}

/// Whether a closed fan goes once around its centre, as seen along a direction from which all its
/// triangles face alike. `ring` holds the points around the centre in their order; all finite.
pub(crate) fn winds_once(direction: [f64; 3], centre: [f64; 3], ring: &[[f64; 3]]) -> bool {
    decide(turns::<Rounded>(&direction, &centre, ring), || {
        turns::<Exact>(&direction, &centre, ring)
    })
}

/// Each step turns the same way, by less than half a turn, so that on which half the points lie,
/// counted from the first, tells how often they go around.
fn turns<N: Number>(direction: &[f64; 3], centre: &[f64; 3], ring: &[[f64; 3]]) -> Option<bool> {
    let zero = [0.0; 3];
    let direction: [N; 3] = arm(&zero, direction);
    let arms: Vec<[N; 3]> = ring.iter().map(|point| arm(centre, point)).collect();
    let side = |from: &[N; 3], to: &[N; 3]| dot(&cross(from, to), &direction).sign();
    let turn = side(&arms[0], &arms[1])?;
    let (mut rounds, mut beyond_half) = (1, false);
    for arm in &arms[1..] {
        let side = side(&arms[0], arm)?;
        // On the line of the first point: opposite to it after the first half, at it after the second.
        let first_half = if side == Ordering::Equal { beyond_half } else { side == turn };
        if first_half && beyond_half {
            rounds += 1;
        }
        beyond_half = !first_half;
    }
    Some(rounds == 1)
}

/// The rounded answer, or else the exact one, which is never missing for finite coordinates.
fn decide(rounded: Option<bool>, exact: impl FnOnce() -> Option<bool>) -> bool {
    rounded.or_else(exact).unwrap_or(true)
}

fn normal_is_zero<N: Number>([a, b, c]: &[[f64; 3]; 3]) -> Option<bool> {
    is_zero(&cross(&arm::<N>(a, b), &arm(a, c)))
}

fn fan_folds<N: Number>(corners: &[[f64; 3]]) -> Option<bool> {
    let arms: Vec<[N; 3]> = corners[1..].iter().map(|corner| arm(&corners[0], corner)).collect();
    let mut area: [N; 3] = arm(&corners[0], &corners[0]);
    let mut last_normal: Option<[N; 3]> = None;
    for pair in arms.windows(2) {
        let normal = cross(&pair[0], &pair[1]);
        area = std::array::from_fn(|axis| area[axis].plus(&normal[axis]));
        if is_zero(&normal)? {
            continue;
        }
        if let Some(last) = &last_normal
            && dot(last, &normal).sign()? != Ordering::Greater
        {
            return Some(true);
        }
        last_normal = Some(normal);
    }
    if last_normal.is_none() {
        return Some(false);
    }
    let mut turned: Option<(&[N; 3], &[N; 3])> = None;
    let mut beyond_half = false;
    for arm in &arms {
        if is_zero(arm)? {
            continue;
        }
        let Some((first, previous)) = turned else {
            turned = Some((arm, arm));
            continue;
        };
        turned = Some((first, arm));
        let step = cross(previous, arm);
        match dot(&step, &area).sign()? {
            Ordering::Greater => {}
            Ordering::Less => return Some(true),
            Ordering::Equal => {
                let goes_on = is_zero(&step)? && dot(previous, arm).sign()? == Ordering::Greater;
                if !goes_on {
                    return Some(true);
                }
            }
        }
        // Each step is below half a turn, so a fan that comes back to the first half has gone round.
        let second_half = dot(&cross(first, arm), &area).sign()? == Ordering::Less;
        if beyond_half && !second_half {
            return Some(true);
        }
        beyond_half = second_half;
    }
    Some(false)
}

/// A number whose sign may be hidden by rounding.
trait Number: Clone {
    fn difference(a: f64, b: f64) -> Self;
    fn plus(&self, other: &Self) -> Self;
    fn minus(&self, other: &Self) -> Self;
    fn times(&self, other: &Self) -> Self;
    /// None if rounding hides it.
    fn sign(&self) -> Option<Ordering>;
}

fn arm<N: Number>(from: &[f64; 3], to: &[f64; 3]) -> [N; 3] {
    std::array::from_fn(|axis| N::difference(to[axis], from[axis]))
}

fn cross<N: Number>(u: &[N; 3], v: &[N; 3]) -> [N; 3] {
    std::array::from_fn(|axis| {
        let (i, j) = ((axis + 1) % 3, (axis + 2) % 3);
        u[i].times(&v[j]).minus(&u[j].times(&v[i]))
    })
}

fn dot<N: Number>(u: &[N; 3], v: &[N; 3]) -> N {
    u[0].times(&v[0]).plus(&u[1].times(&v[1])).plus(&u[2].times(&v[2]))
}

fn is_zero<N: Number>(vector: &[N; 3]) -> Option<bool> {
    let signs = vector.each_ref().map(N::sign);
    if signs.iter().any(|sign| sign.is_some_and(Ordering::is_ne)) {
        return Some(false);
    }
    signs.iter().all(Option::is_some).then_some(true)
}

impl Number for Exact {
    fn difference(a: f64, b: f64) -> Self {
        Exact::from_f64(a) - Exact::from_f64(b)
    }
    fn plus(&self, other: &Self) -> Self {
        self.clone() + other
    }
    fn minus(&self, other: &Self) -> Self {
        self.clone() - other
    }
    fn times(&self, other: &Self) -> Self {
        self.clone() * other
    }
    fn sign(&self) -> Option<Ordering> {
        Exact::sign(self)
    }
}

/// A rounded number and a bound on its error. An overflow makes the error infinite or NaN, and
/// then the sign is hidden.
#[derive(Clone, Copy)]
struct Rounded {
    value: f64,
    error: f64,
}

impl Rounded {
    /// With a rounding of `value` added to what the operands bring along. Twice the unit roundoff
    /// and the factor cover the rounding of the bound itself.
    fn after(value: f64, carried: f64) -> Rounded {
        Rounded { value, error: carried * (1.0 + 8.0 * f64::EPSILON) + value.abs() * f64::EPSILON }
    }
}

impl Number for Rounded {
    /// The error of a difference is relative to the difference; it is zero for equal numbers only,
    /// and below the normal numbers there is none.
    fn difference(a: f64, b: f64) -> Self {
        Rounded::after(a - b, 0.0)
    }
    fn plus(&self, other: &Self) -> Self {
        Rounded::after(self.value + other.value, self.error + other.error)
    }
    fn minus(&self, other: &Self) -> Self {
        Rounded::after(self.value - other.value, self.error + other.error)
    }
    fn times(&self, other: &Self) -> Self {
        let is_exact_zero = |n: &Self| n.value == 0.0 && n.error == 0.0;
        if is_exact_zero(self) || is_exact_zero(other) {
            return Rounded { value: 0.0, error: 0.0 };
        }
        let carried = self.value.abs() * other.error
            + other.value.abs() * self.error
            + self.error * other.error;
        let mut product = Rounded::after(self.value * other.value, carried);
        // Products may underflow, and so may the terms of their bound.
        product.error += f64::MIN_POSITIVE;
        product
    }
    fn sign(&self) -> Option<Ordering> {
        if self.value.abs() > self.error || (self.value == 0.0 && self.error == 0.0) {
            return self.value.partial_cmp(&0.0);
        }
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The answers of both arithmetics; the rounded one may be missing but not wrong.
    fn fold_of(corners: &[[f64; 3]]) -> bool {
        let exact = fan_folds::<Exact>(corners).expect("finite");
        if let Some(rounded) = fan_folds::<Rounded>(corners) {
            assert_eq!(rounded, exact, "{corners:?}");
        }
        assert_eq!(folds(corners), exact);
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
        assert!(fold_of(&flat(&[[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 1.0]])));
        let star = [[3.0, 0.0], [-2.0, 2.0], [1.0, -3.0], [1.0, 3.0], [-2.0, -2.0]];
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
        let through = [[0.0, 0.0], [1.0, 0.0], [-1.0, 1.0], [1.0, -1.0], [2.0, -1.0]];
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
            for (points, expected) in
                [(&once[..], true), (&twice[..], false), (&back_at_the_start[..], false)]
            {
                let mut ring = ring(points);
                for _ in 0..ring.len() {
                    ring.rotate_left(1);
                    assert_eq!(winds_once(direction, centre, &ring), expected, "{ring:?}");
                    let exact = turns::<Exact>(&direction, &centre, &ring);
                    assert_eq!(exact, Some(expected));
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
            fold_of(&[[0.0, 0.0, 0.0], [1.0, 0.0, height], [1.0, 1.0, 0.0], [0.0, 1.0, height]])
        };
        assert!(!quad(0.25));
        // The normals are (-h, h, 1) and (h, -h, 1).
        assert!(!quad(0.7));
        assert!(quad(0.75));
        let at_right_angles = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [1.0, 1.0, 1.0]];
        assert!(fold_of(&at_right_angles));
        // A steep roof around the first corner: each bend is small, but its ends face each other.
        let ring = [[4, 0], [3, 3], [0, 4], [-3, 3], [-4, 0], [-3, -3], [0, -4]];
        let mut roof = vec![[0.0, 0.0, 20.0]];
        roof.extend(ring.map(|[x, y]| [f64::from(x), f64::from(y), 0.0]));
        assert!(fold_of(&roof));
        roof[0][2] = 2.0;
        assert!(!fold_of(&roof));
        // Three gentle bends again, the last triangle small and seen from behind.
        let arms = [[200, -100, -4000], [200, 100, -4000], [0, 20, -400], [-2, 1, -40]];
        let mut hook = vec![[0.0; 3]];
        hook.extend(arms.map(|arm| arm.map(f64::from)));
        assert!(fold_of(&hook));
        hook.pop();
        assert!(!fold_of(&hook));
        let closed_book = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [1.0, 0.0, 0.1]];
        assert!(fold_of(&closed_book));
    }

    #[test]
    fn areas_that_rounding_hides_are_decided_exactly() {
        let [a, b] = [[0.1, 0.2, 0.3], [0.7, 0.9, 1.1]];
        let middle: [f64; 3] = std::array::from_fn(|k| a[k] + (b[k] - a[k]) * 0.5);
        // Rounded to the line's neighbourhood, not onto it.
        assert!(!is_without_area([a, b, middle]));
        assert_eq!(normal_is_zero::<Rounded>(&[a, b, middle]), None);
        let double = |v: [f64; 3]| v.map(|x| 2.0 * x);
        assert!(is_without_area([[0.0; 3], a, double(a)]));
        assert!(is_without_area([a, a, b]));
        for scale in [1e-200, 1e200, 5e-324] {
            assert!(!is_without_area([[0.0; 3], [scale, 0.0, 0.0], [0.0, scale, 0.0]]), "{scale}");
            assert!(is_without_area([[0.0; 3], [scale; 3], [2.0 * scale; 3]]), "{scale}");
        }
        assert!(is_without_area([[f64::MIN; 3], [0.0; 3], [f64::MAX; 3]]));
    }
}
