//! How far a case is from where its truth would change: from the line to the triangle's boundary, and
//! along the line from the ends of its extent.
//!
//! Three steps, each trusted only where it is certain to a thousandth: floats, double-doubles with
//! bounds, exact numbers. What the truth knows to be zero is zero.

use crate::arith::{
    Bounded, Exact, Float, Real, Triple, Vector, bounded, scale_by_power_of_two as scaled,
};
use crate::case::{Case, Ray, Triangle};
use crate::contract::{Band, BandUnit, Contract, Extent, Sides};
use crate::truth::{Contact, Facing, Feature, Place, Truth};
use glam::DVec3;
use std::cmp::Ordering;

/// Distances of a valid case, in units of the triangle's longest edge (of length, for a triangle that
/// is a point), to about a thousandth of themselves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Distances {
    /// From the line to the triangle's boundary, in space.
    pub in_space: f64,
    /// |t - end|·|d| for ends 0, t_min and t_max; infinite where the end is, NaN where the line does
    /// not cross the plane.
    pub along: [f64; 3],
    /// The longest edge in ulps of the largest coordinate of the case's points.
    pub edge_in_ulps: f64,
}

/// Squares of lengths of a case.
pub struct Squares<R> {
    /// Of the longest edge.
    pub longest: R,
    /// From the line to the boundary.
    pub in_space: R,
    /// |t - end|·|d| for ends 0, t_min and t_max; none where the line does not cross the plane or the
    /// end is infinite.
    pub along: [Option<R>; 3],
}

impl<R: Real> Squares<R> {
    /// Of a valid case, in an arithmetic that does not round.
    pub fn of(ray: &Ray<Triple<R>>, triangle: &Triangle<Triple<R>>) -> Squares<R> {
        let Ray { origin: o, direction: d, t_min, t_max } = ray;
        let Triangle { a, b, c } = triangle;
        let edges = [(a, b), (b, c), (c, a)];
        let longest = edges.map(|(p, q)| square(&q.minus(p))).into_iter().reduce(larger);
        let to_edges = edges.map(|(p, q)| line_to_segment(o, d, p, q));
        let n = b.minus(a).cross(&c.minus(a));
        let capital_d = n.dot(d);
        let t = (!capital_d.is_zero()).then(|| n.dot(&a.minus(o)) / capital_d);
        let along = [&R::zero(), t_min, t_max].map(|end| {
            let gap = t.clone().filter(|_| end.is_finite())? - end;
            Some(gap.clone() * gap * square(d))
        });
        Squares {
            longest: longest.expect("three edges"),
            in_space: to_edges.into_iter().reduce(smaller).expect("three edges"),
            along,
        }
    }
}

/// The smaller of two numbers.
pub fn smaller<R: Real>(a: R, b: R) -> R {
    if b.is_less(&a) { b } else { a }
}

fn larger<R: Real>(a: R, b: R) -> R {
    if a.is_less(&b) { b } else { a }
}

/// The square of a vector's length.
pub fn square<V: Vector>(v: &V) -> V::Real {
    v.dot(v)
}

/// The square of the distance between a line and a segment: |(p - o + s·(q - p)) × d|² / |d|² at the
/// s in [0, 1] that makes it least.
fn line_to_segment<V: Vector>(o: &V, d: &V, p: &V, q: &V) -> V::Real {
    let (offset, slope) = (p.minus(o).cross(d), q.minus(p).cross(d));
    let s = nearest_on_segment(-offset.dot(&slope), square(&slope));
    square(&offset.plus(&slope.times(&s))) / square(d)
}

/// `numerator / denominator` cut to [0, 1]; 0 if the denominator is zero.
pub fn nearest_on_segment<R: Real>(numerator: R, denominator: R) -> R {
    if denominator.is_zero() || numerator.is_sign_negative() {
        return R::zero();
    }
    smaller(numerator / denominator, R::one())
}

/// The unit in the last place of the largest coordinate of a case's points.
pub fn ulp_of_points<F: Float>(case: &Case<F>) -> F {
    let [o, _, a, b, c] = case.vectors();
    let coordinates = [o, a, b, c];
    let larger = |m: F, x: F| if m < x { x } else { m };
    coordinates.as_flattened().iter().map(F::abs).fold(F::zero(), larger).ulp()
}

impl Distances {
    /// Of a valid case with its truth.
    pub fn of<F: Float>(case: &Case<F>, truth: &Truth) -> Distances {
        let zeros = Zeros::of(truth);
        let ulp = ulp_of_points(case).to_f64();
        quick(&case.widen(), ulp, &zeros).unwrap_or_else(|| careful(case, ulp, &zeros))
    }

    /// How far from where the obligation would be another, lengths being infinite from an infinite end.
    pub fn to_change(&self, truth: &Truth, contract: &Contract) -> f64 {
        to_change(truth, contract, self.in_space, self.along)
    }
}

/// How far a case is from where its obligation would be another: into the triangle and the extent for
/// one that is to be missed, out of them for one that is to be hit. Where neither decides (a side that
/// does not count, a line along the plane) it is the distance to the boundary. Lengths or their
/// squares, infinite from an infinite end.
fn to_change<R: Real>(truth: &Truth, contract: &Contract, in_space: R, along: [R; 3]) -> R {
    let Some(crossing) = truth.crossing() else { return in_space };
    let [to_zero, to_min, to_max] = along;
    let (along, off_end) = match contract.extent {
        Extent::Line => (R::infinity(), false),
        Extent::Ray => (to_zero, crossing.t_sign == Ordering::Less),
        Extent::Interval => {
            (smaller(to_min, to_max), matches!(crossing.place, Place::Before | Place::Beyond))
        }
    };
    if contract.sides == Sides::Front && crossing.facing == Facing::Back {
        return in_space;
    }
    match (off_end, crossing.feature == Feature::Outside) {
        (true, true) => larger(along, in_space),
        (true, false) => along,
        (false, true) => in_space,
        (false, false) => smaller(in_space, along),
    }
}

/// [`Distances::to_change`] exactly; none for invalid input.
pub fn exact_to_change<F: Float>(
    case: &Case<F>,
    truth: &Truth,
    contract: &Contract,
) -> Option<Exact> {
    if *truth == Truth::Invalid {
        return None;
    }
    let (ray, triangle) = case.exact();
    let Squares { longest, in_space, along } = Squares::<Exact>::of(&ray, &triangle);
    let unit = if longest.is_zero() { Exact::one() } else { longest };
    let along = along.map(|square| square.unwrap_or_else(Exact::infinity));
    Some((to_change(truth, contract, in_space, along) / unit).sqrt())
}

/// Whether a valid case is nearer than a band to where its obligation would be another; exactly.
pub fn is_within<F: Float>(band: Band, case: &Case<F>, truth: &Truth, contract: &Contract) -> bool {
    let distances = Distances::of(case, truth);
    let unit = match band.unit {
        BandUnit::Edges => 1.0,
        BandUnit::Ulps => distances.edge_in_ulps,
    };
    // Distances are right to a thousandth.
    let relative = distances.to_change(truth, contract) * unit / band.size;
    if (relative - 1.0).abs() > 1.0 / 256.0 {
        return relative < 1.0;
    }
    let (ray, triangle) = case.exact();
    let Squares { longest, in_space, along } = Squares::<Exact>::of(&ray, &triangle);
    let unit = match band.unit {
        BandUnit::Edges if longest.is_zero() => Exact::one(),
        BandUnit::Edges => longest,
        BandUnit::Ulps => {
            let ulp = Exact::from_f64(ulp_of_points(case).to_f64());
            ulp.clone() * ulp
        }
    };
    let along = along.map(|square| square.unwrap_or_else(Exact::infinity));
    let size = Exact::from_f64(band.size);
    to_change(truth, contract, in_space, along).is_less(&(size.clone() * size * unit))
}

/// What a truth knows to be zero, or not to be.
struct Zeros {
    in_space: bool,
    /// Whether t is at 0, t_min, t_max; none where the line does not cross the plane.
    along: Option<[bool; 3]>,
}

impl Zeros {
    fn of(truth: &Truth) -> Zeros {
        match truth {
            Truth::Transversal(crossing) => Zeros {
                in_space: crossing.feature.is_edge() || crossing.feature.is_vertex(),
                along: Some([
                    crossing.t_sign == Ordering::Equal,
                    crossing.place == Place::AtMin,
                    crossing.place == Place::AtMax,
                ]),
            },
            Truth::Coplanar(Contact { meets_line, .. })
            | Truth::Degenerate(Contact { meets_line, .. }) => {
                Zeros { in_space: *meets_line, along: None }
            }
            Truth::Parallel | Truth::Invalid => Zeros { in_space: false, along: None },
        }
    }
}

/// In floats; none where rounding could matter.
fn quick(case: &Case<f64>, ulp: f64, zeros: &Zeros) -> Option<Distances> {
    let vectors = case.vectors();
    let points = [vectors[0], vectors[2], vectors[3], vectors[4]];
    let exponent_of = |v: &[f64]| {
        let largest = v.iter().fold(0.0f64, |m, x| m.max(x.abs()));
        (largest.to_bits() >> 52) as i32 - 1023
    };
    // Far from overflow and underflow: sizes about 1, by powers of two.
    let (size, length) = (exponent_of(points.as_flattened()), exponent_of(&vectors[1]));
    let near_one = |v: [f64; 3], exponent: i32| DVec3::from(v.map(|x| scaled(x, -exponent)));
    let [o, a, b, c] = points.map(|v| near_one(v, size));
    let d = near_one(vectors[1], length);
    let edges = [(a, b), (b, c), (c, a)];
    let longest = edges.iter().fold(0.0f64, |m, (p, q)| m.max(p.distance(*q)));
    let unit = if longest > 0.0 { longest } else { scaled(1.0, -size) };
    let in_space = edges.iter().fold(f64::INFINITY, |m, (p, q)| {
        let (offset, edge) = ((*p - o).cross(d), (*q - *p).cross(d));
        let s = (-offset.dot(edge) / edge.dot(edge)).clamp(0.0, 1.0);
        let s = if s.is_nan() { 0.0 } else { s };
        m.min((offset + edge * s).length() / d.length())
    });
    // Off by some 2^-50: cross products of numbers below 4, times an s that only moves the nearest
    // point along the edge.
    if !zeros.in_space && in_space < scaled(1.0, -38) {
        return None;
    }
    let along = match zeros.along {
        None => [f64::NAN; 3],
        Some(at) => {
            let n = (b - a).cross(c - a);
            let t = n.dot(a - o) / n.dot(d);
            // Off by the permanents' rounding over n·d.
            let size_of_n = (b - a).length() * (c - a).length();
            let terms = size_of_n * ((a - o).length() + t.abs() * d.length());
            let error = scaled(terms, -48) / n.dot(d).abs();
            let mut along = [0.0; 3];
            let ends = [0.0, case.ray.t_min, case.ray.t_max];
            for ((along, end), is_at) in along.iter_mut().zip(ends).zip(at) {
                let end = scaled(end, length - size);
                let gap = (t - end).abs();
                let certain = gap > 1024.0 * error + scaled(end.abs() + t.abs(), -40);
                if !is_at && end.is_finite() && !certain {
                    return None;
                }
                *along = if is_at { 0.0 } else { gap * d.length() / unit };
            }
            along
        }
    };
    let in_space = if zeros.in_space { 0.0 } else { in_space / unit };
    Some(Distances { in_space, along, edge_in_ulps: unit / scaled(ulp, -size) })
}

/// In double-doubles with bounds, or in exact numbers where those do not decide.
fn careful<F: Float>(case: &Case<F>, ulp: f64, zeros: &Zeros) -> Distances {
    by_bounds(case, ulp, zeros).unwrap_or_else(|| {
        let (ray, triangle) = case.exact();
        let squares = Squares::of(&ray, &triangle);
        let unit = if squares.longest.is_zero() { Exact::one() } else { squares.longest.clone() };
        let relative = |square: Exact| Some((square / &unit).approximate_root());
        let ulp = Exact::from_f64(ulp);
        let edge_in_ulps = (unit.clone() / (ulp.clone() * ulp)).approximate_root();
        collect(squares, edge_in_ulps, zeros, case, relative).expect("always a number")
    })
}

fn by_bounds<F: Float>(case: &Case<F>, ulp: f64, zeros: &Zeros) -> Option<Distances> {
    let (ray, triangle) = case.lift(|x| Bounded::new(x.to_f64()));
    let squares = bounded(|| Squares::of(&ray, &triangle))?;
    let longest = squares.longest.approximate()?.sqrt();
    let unit = if longest > 0.0 { longest } else { 1.0 };
    let relative = |square: Bounded| Some(square.approximate()?.sqrt() / unit);
    collect(squares, unit / ulp, zeros, case, relative)
}

fn collect<F: Float, R: Real>(
    squares: Squares<R>,
    edge_in_ulps: f64,
    zeros: &Zeros,
    case: &Case<F>,
    relative: impl Fn(R) -> Option<f64>,
) -> Option<Distances> {
    let in_space = if zeros.in_space { 0.0 } else { relative(squares.in_space)? };
    let mut along = [f64::NAN; 3];
    if let Some(at) = zeros.along {
        let ends = [0.0, case.ray.t_min.to_f64(), case.ray.t_max.to_f64()];
        for (i, square) in squares.along.into_iter().enumerate() {
            along[i] = match square {
                _ if at[i] => 0.0,
                _ if ends[i].is_infinite() => f64::INFINITY,
                square => relative(square?)?,
            };
        }
    }
    Some(Distances { in_space, along, edge_in_ulps })
}
