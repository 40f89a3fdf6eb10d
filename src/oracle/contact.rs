//! Contacts of a line with a triangle that holds part of it, in integers.
//!
//! With r = vertex - o, the vector d×r is zero where the vertex is on the line, and along the
//! triangle's edges it is affine. In a plane that holds the line all these vectors are parallel, so
//! one component s that does not vanish identically tells the side of each vertex. An edge whose
//! ends have opposite s crosses the line at a point whose t is a fraction of the ends' values.

use super::integer::{Integer, Scaled, Triple, cross};
use crate::truth::{Contact, ContactKind, Feature};
use num_traits::Zero;
use std::cmp::Ordering;

const VERTICES: [Feature; 3] = [Feature::VertexA, Feature::VertexB, Feature::VertexC];
const EDGES: [(Feature, usize, usize); 3] =
    [(Feature::EdgeAb, 0, 1), (Feature::EdgeBc, 1, 2), (Feature::EdgeCa, 2, 0)];

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
            return Touch { numerator: -numerator, denominator: -denominator, feature };
        }
        Touch { numerator, denominator, feature }
    }

    fn compare(&self, other: &Touch<I>) -> Ordering {
        let left = self.numerator.clone() * &other.denominator;
        left.cmp(&(other.numerator.clone() * &self.denominator))
    }
}

/// The contact of the line with the triangle whose vertices, relative to the origin, are `r`. Either
/// `n` is zero (no area) or the line lies in the plane of `n`.
pub(super) fn decide<I: Integer>(
    scaled: &Scaled,
    d: &Triple<I>,
    r: [&Triple<I>; 3],
    n: &Triple<I>,
) -> Contact {
    let offsets = r.map(|r| cross(d, r));
    let touches = touches(d, r, &offsets, n);
    let (Some(first), Some(last)) =
        (touches.iter().min_by(|a, b| a.compare(b)), touches.iter().max_by(|a, b| a.compare(b)))
    else {
        return Contact { kind: ContactKind::None, meets_ray: false, meets_line: false };
    };
    let (t_min, t_max) = scaled.interval();
    let against =
        |touch: &Touch<I>, end: f64| scaled.compare_t(&touch.numerator, &touch.denominator, end);
    let low_cut = against(first, t_min) == Ordering::Less;
    let high_cut = against(last, t_max) == Ordering::Greater;
    let kind = if against(first, t_max) == Ordering::Greater
        || against(last, t_min) == Ordering::Less
    {
        ContactKind::None
    } else if first.compare(last) == Ordering::Equal
        || against(first, t_max) == Ordering::Equal
        || against(last, t_min) == Ordering::Equal
        || (low_cut && high_cut && t_min == t_max)
    {
        // One point: at a touch if it has that t, else between touches at t_min = t_max.
        let at =
            if against(first, t_max) == Ordering::Equal || first.compare(last) == Ordering::Equal {
                first_feature(&touches, |touch| touch.compare(first))
            } else if against(last, t_min) == Ordering::Equal {
                first_feature(&touches, |touch| touch.compare(last))
            } else {
                None
            };
        let at = at.or_else(|| first_feature(&touches, |touch| against(touch, t_min)));
        ContactKind::Point(at.unwrap_or_else(|| {
            // Strictly between touches: on the first edge whose ends lie on both sides of t_min, if
            // all of that edge is on the line, else inside.
            let place = |vertex: usize| {
                let touch = touches.iter().find(|touch| touch.feature == VERTICES[vertex]);
                touch.map(|touch| against(touch, t_min))
            };
            let holds = |(_, i, j): &&(Feature, usize, usize)| {
                matches!((place(*i), place(*j)), (Some(x), Some(y)) if x != y)
            };
            EDGES.iter().find(holds).map_or(Feature::Interior, |(edge, ..)| *edge)
        }))
    } else {
        ContactKind::Segment
    };
    let meets_ray = last.numerator.sign() != Ordering::Less;
    Contact { kind, meets_ray, meets_line: true }
}

/// The feature of the first touch that compares equal: vertices come before edges, in the order of
/// their letters.
fn first_feature<I>(
    touches: &[Touch<I>],
    compare: impl Fn(&Touch<I>) -> Ordering,
) -> Option<Feature> {
    touches.iter().find(|touch| compare(touch) == Ordering::Equal).map(|touch| touch.feature)
}

/// The vertices on the line and the crossings of the line with open edges.
fn touches<I: Integer>(
    d: &Triple<I>,
    r: [&Triple<I>; 3],
    offsets: &[Triple<I>; 3],
    n: &Triple<I>,
) -> Vec<Touch<I>> {
    // t of a point of the line is r_m / d_m for any m with d_m ≠ 0.
    let m = (0..3).find(|&m| !d[m].is_zero()).expect("a direction that is not zero");
    let mut touches = Vec::with_capacity(6);
    for (i, offset) in offsets.iter().enumerate() {
        if offset.iter().all(Zero::is_zero) {
            touches.push(Touch::new(r[i][m].clone(), d[m].clone(), VERTICES[i]));
        }
    }
    let component = if n.iter().all(Zero::is_zero) {
        (0..3).find(|&k| offsets[0][k] != offsets[1][k] || offsets[1][k] != offsets[2][k])
    } else {
        (0..3).find(|&k| !n[k].is_zero())
    };
    // Without a component that differs, all vertices are equally far from the line.
    let Some(k) = component else { return touches };
    for (edge, i, j) in EDGES {
        let (x, y) = (&offsets[i][k], &offsets[j][k]);
        if x.sign() != y.sign().reverse() || x.is_zero() {
            continue;
        }
        let meets = (0..3).all(|l| I::minor(y, &offsets[i][l], x, &offsets[j][l]).is_zero());
        if meets {
            let numerator = I::minor(y, &r[i][m], x, &r[j][m]);
            touches.push(Touch::new(numerator, (y.clone() - x) * &d[m], edge));
        }
    }
    touches
}
