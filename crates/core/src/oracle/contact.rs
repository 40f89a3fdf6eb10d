//! Contacts of a line with a triangle that holds part of it, in integers.
//!
//! With r = vertex - o, the vector d×r is zero where the vertex is on the line, and along the
//! triangle's edges it is affine. In a plane that holds the line all these vectors are parallel, so
//! one component s that does not vanish identically tells the side of each vertex. An edge whose
//! ends have opposite s crosses the line at a point whose t is a fraction of the ends' values.

use super::integer::{ExactInteger, Integer, IntegerVector, RayInterval, cross};
use crate::truth::{Contact, ContactKind, Feature};
use std::cmp::Ordering;

const VERTICES: [Feature; 3] = [Feature::VertexA, Feature::VertexB, Feature::VertexC];
const EDGES: [(Feature, usize, usize); 3] = [
    (Feature::EdgeAb, 0, 1),
    (Feature::EdgeBc, 1, 2),
    (Feature::EdgeCa, 2, 0),
];

/// A point of the line: its t (up to the common power of two) as a fraction with a positive
/// denominator, and the feature it lies on.
struct Touch<I> {
    numerator: I,
    denominator: I,
    feature: Feature,
}

impl<I: Integer> Touch<I> {
    fn new(numerator: I, denominator: I, feature: Feature) -> Touch<I> {
        if denominator.sign() == Ordering::Less {
            return Touch {
                numerator: -numerator,
                denominator: -denominator,
                feature,
            };
        }
        Touch {
            numerator,
            denominator,
            feature,
        }
    }

    fn compare(&self, other: &Touch<I>) -> Ordering {
        I::compare_products(
            &self.numerator,
            &other.denominator,
            &other.numerator,
            &self.denominator,
        )
    }
}

/// The contact of the line with the triangle whose vertices, relative to the origin, are `r`. Either
/// `n` is zero (no area) or the line lies in the triangle's plane, whose normal is `n`.
pub(super) fn decide<I: Integer>(
    interval: &RayInterval,
    d: &IntegerVector<I>,
    r: [&IntegerVector<I>; 3],
    n: &IntegerVector<I>,
) -> Contact {
    let offsets = r.map(|r| cross(d, r));
    let touches = touches(d, r, &offsets, n);
    let Some(mut first) = touches.iter().flatten().next() else {
        return Contact {
            kind: ContactKind::None,
            meets_ray: false,
            meets_line: false,
        };
    };
    let mut last = first;
    for touch in touches.iter().flatten().skip(1) {
        if touch.compare(first) == Ordering::Less {
            first = touch;
        }
        if touch.compare(last) == Ordering::Greater {
            last = touch;
        }
    }
    let start = |touch: &Touch<I>| interval.compare_start(&touch.numerator, &touch.denominator);
    let end = |touch: &Touch<I>| interval.compare_end(&touch.numerator, &touch.denominator);
    // Both moved only to what lies strictly beyond them.
    let one_point = std::ptr::eq(first, last);
    // first ≤ last, and t_min ≤ t_max.
    let kind = match (end(first), start(last), one_point) {
        (Ordering::Greater, ..) | (_, Ordering::Less, _) => ContactKind::None,
        (Ordering::Equal, ..) | (.., true) => {
            ContactKind::Point(feature_at(&touches, |touch| touch.compare(first)))
        }
        (_, Ordering::Equal, _) => {
            ContactKind::Point(feature_at(&touches, |touch| touch.compare(last)))
        }
        // Strictly between the touches.
        _ if interval.is_point() => ContactKind::Point(feature_at(&touches, start)),
        _ => ContactKind::Segment,
    };
    let meets_ray = last.numerator.sign() != Ordering::Less;
    Contact {
        kind,
        meets_ray,
        meets_line: true,
    }
}

/// The feature of the line's point that touches are compared with: that of the first touch there
/// (vertices come before edges, in the order of their letters), else the first edge that lies on the
/// line and whose ends are on both sides of the point, else the interior.
fn feature_at<I>(touches: &Touches<I>, compare: impl Fn(&Touch<I>) -> Ordering) -> Feature {
    let mut all = touches.iter().flatten();
    if let Some(touch) = all.find(|touch| compare(touch) == Ordering::Equal) {
        return touch.feature;
    }
    let side = |vertex: usize| touches[vertex].as_ref().map(&compare);
    let holds = |(_, i, j): &&(Feature, usize, usize)| matches!((side(*i), side(*j)), (Some(x), Some(y)) if x != y);
    EDGES
        .iter()
        .find(holds)
        .map_or(Feature::Interior, |(edge, ..)| *edge)
}

/// The vertices on the line, then the crossings of the line with open edges.
type Touches<I> = [Option<Touch<I>>; 6];

fn touches<I: Integer>(
    d: &IntegerVector<I>,
    r: [&IntegerVector<I>; 3],
    offsets: &[IntegerVector<I>; 3],
    n: &IntegerVector<I>,
) -> Touches<I> {
    // t of a point of the line is r_m / d_m for any m with d_m ≠ 0.
    let m = (0..3)
        .find(|&m| !d[m].is_zero())
        .expect("a direction that is not zero");
    let has_area = !n.iter().all(ExactInteger::is_zero);
    // In a plane one component of the offsets tells all; without one that differs, all vertices are
    // equally far from the line.
    let component = if has_area {
        (0..3).find(|&k| !n[k].is_zero())
    } else {
        (0..3).find(|&k| offsets[0][k] != offsets[1][k] || offsets[1][k] != offsets[2][k])
    };
    let on_line = |offset: &IntegerVector<I>| match (has_area, component) {
        (true, Some(k)) => offset[k].is_zero(),
        _ => offset.iter().all(ExactInteger::is_zero),
    };
    let vertex = |i: usize| {
        on_line(&offsets[i]).then(|| Touch::new(r[i][m].clone(), d[m].clone(), VERTICES[i]))
    };
    let edge = |(edge, i, j): (Feature, usize, usize)| {
        let k = component?;
        let (x, y) = (&offsets[i][k], &offsets[j][k]);
        if x.is_zero() || x.sign() != y.sign().reverse() {
            return None;
        }
        // Without area the other components need not vanish along with this one.
        let meets =
            has_area || (0..3).all(|l| I::minor(y, &offsets[i][l], x, &offsets[j][l]).is_zero());
        meets.then(|| {
            let numerator = I::minor(y, &r[i][m], x, &r[j][m]);
            Touch::new(numerator, (y.clone() - x) * &d[m], edge)
        })
    };
    [
        vertex(0),
        vertex(1),
        vertex(2),
        edge(EDGES[0]),
        edge(EDGES[1]),
        edge(EDGES[2]),
    ]
}

#[cfg(test)]
mod tests {
    use crate::case::Case;
    use crate::oracle::{define, truth};

    /// The number's last three digits to base three, less one.
    fn numbers(digits: u32) -> [f64; 3] {
        [1, 3, 9].map(|power| f64::from(digits / power % 3) - 1.0)
    }

    #[test]
    fn in_planes_across_every_axis_contacts_are_those_of_the_definition() {
        let triangle = [[0.0, -1.0, 0.0], [0.0, 1.0, -1.0], [0.0, 0.0, 1.0]];
        for digits in 0..81 {
            let [o_y, o_z, d_y] = numbers(digits % 27);
            let [d_z, ..] = numbers(digits / 27);
            for axis in 0..3 {
                let turned = |mut v: [f64; 3]| {
                    v.rotate_right(axis);
                    v
                };
                let (o, d) = (turned([0.0, o_y, o_z]), turned([0.0, d_y, d_z]));
                let case = Case::<f64>::new(o, d, triangle.map(turned)).on(0.5, 2.0);
                assert_eq!(truth(&case), define(&case).truth, "{case:?}");
            }
        }
    }
}
