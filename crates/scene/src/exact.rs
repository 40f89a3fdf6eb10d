//! A face seen from a ray in integers: whether a line meets it, the exact t of a crossing, and the part of a line that lies
//! in a face.

use crate::fraction::{Fraction, Parameter};
use crate::grid::Grid;
use crate::mesh::Triangle;
use crate::ray::Ray;
use hairline_core::oracle::integer::{
    ExactInteger, Integer, IntegerVector, align, cross, dot, minus,
};
use hairline_core::{Facing, Feature};
use num_bigint::BigInt;
use std::cell::OnceCell;
use std::cmp::Ordering;

/// With 38 bits a coordinate T is below 2^120 and D below 2^119; the fractions of contacts are below 2^118 over 2^117.
const MOST_BITS: i64 = 38;

/// The exact t of a ray and some faces, in 128 bits if their grid allows.
pub struct Exact {
    ray: Ray<f64>,
    scene: Grid,
    /// The grids of all positions and of the direction, if 128 bits hold what is made of them.
    small: OnceCell<Option<[Grid; 2]>>,
}

impl Exact {
    /// A ray against faces whose coordinates are on a grid.
    pub fn new(ray: Ray<f64>, scene: Grid) -> Exact {
        Exact {
            ray,
            scene,
            small: OnceCell::new(),
        }
    }

    fn small_grids(&self) -> Option<[Grid; 2]> {
        *self.small.get_or_init(|| {
            let positions = self.ray.origin.into_iter().fold(self.scene, Grid::with);
            let direction = self.ray.direction.into_iter().fold(Grid::NONE, Grid::with);
            let is_small = positions.has_bits(MOST_BITS) && direction.has_bits(MOST_BITS);
            is_small.then_some([positions, direction])
        })
    }

    /// The t at which the line crosses a face's plane, to which it is not parallel.
    pub fn crossing(&self, triangle: &Triangle<f64>) -> Parameter {
        match self.small_grids() {
            Some(grids) => Parameter::Small(self.on_grids(grids, triangle).crossing()),
            None => Parameter::Large(self.on_any_grid(triangle).crossing()),
        }
    }

    /// The first and the last t of the line and a face that it meets, and that it lies in or that has no area.
    pub fn contact(&self, triangle: &Triangle<f64>) -> Option<[Parameter; 2]> {
        match self.small_grids() {
            Some(grids) => {
                let range = self.on_grids(grids, triangle).contact()?;
                Some(range.map(Parameter::Small))
            }
            None => {
                let range = self.on_any_grid(triangle).contact()?;
                Some(range.map(Parameter::Large))
            }
        }
    }

    /// The common points of the line and a triangle whose vertices are integers times 2 to a power.
    pub fn meet(&self, (vertices, unit): ([IntegerVector<BigInt>; 3], i64)) -> Option<Meeting> {
        let ([origin], of_origin) = align([self.ray.origin]);
        let ([direction], of_direction) = align([self.ray.direction]);
        let grid = unit.min(of_origin);
        let origin = origin.map(|x| x << (of_origin - grid));
        let on_grid = |vertex: IntegerVector<BigInt>| vertex.map(|x| x << (unit - grid));
        let seen = Seen {
            direction,
            vertices: vertices.map(|vertex| minus(&on_grid(vertex), &origin)),
            exponent: grid - of_direction,
        };
        seen.meet()
    }

    fn on_grids(&self, [positions, direction]: [Grid; 2], triangle: &Triangle<f64>) -> Seen<i128> {
        let position = |point: [f64; 3]| point.map(|x| positions.integer(x));
        let origin = position(self.ray.origin);
        Seen {
            direction: self.ray.direction.map(|x| direction.integer(x)),
            vertices: triangle.map(|vertex| minus(&position(vertex), &origin)),
            exponent: positions.unit() - direction.unit(),
        }
    }

    fn on_any_grid(&self, [a, b, c]: &Triangle<f64>) -> Seen<BigInt> {
        let ([origin, vertices @ ..], unit) = align([self.ray.origin, *a, *b, *c]);
        let ([direction], direction_unit) = align([self.ray.direction]);
        Seen {
            direction,
            vertices: vertices.map(|vertex| minus(&vertex, &origin)),
            exponent: unit - direction_unit,
        }
    }
}

/// The common points of a line and a triangle.
pub enum Meeting {
    /// The point at which the line crosses the triangle's plane.
    Crossing(Facing, Feature, Parameter),
    /// The first and the last t of a line in the triangle's plane, or of a triangle without area.
    Contact([Parameter; 2]),
}

/// A direction, and vertices seen from the origin, in integers of two grids. t carries 2 to the power of `exponent`.
struct Seen<I> {
    direction: IntegerVector<I>,
    vertices: [IntegerVector<I>; 3],
    exponent: i64,
}

impl<I: Integer> Seen<I> {
    /// T/D.
    fn crossing(&self) -> Fraction<I> {
        let [a, b, c] = &self.vertices;
        let normal = cross(&minus(b, a), &minus(c, a));
        let capital_t = dot(&self.vertices[0], &normal);
        let capital_d = dot(&self.direction, &normal);
        Fraction::new(capital_t, capital_d, self.exponent)
    }

    /// With r a vertex, d×r is zero where the vertex is on the line, and it is affine along edges. In a plane that holds
    /// the line, and along a triangle without area that has a point of the line, all d×r are multiples of one vector. So
    /// an edge whose ends have opposite d×r crosses the line. As `hairline_core`'s contacts; those have no t.
    fn contact(&self) -> Option<[Fraction<I>; 2]> {
        let r = &self.vertices;
        let d = &self.direction;
        let offsets = r.each_ref().map(|r| cross(d, r));
        // t of a point of the line is r_m / d_m for any m with d_m ≠ 0.
        let m = (0..3).find(|m| !d[*m].is_zero())?;
        let mut first: Option<Fraction<I>> = None;
        let mut last: Option<Fraction<I>> = None;
        let mut touches = |t: Fraction<I>| {
            let is_before = |first: &Fraction<I>| t.compare(first) == Ordering::Less;
            if first.as_ref().is_none_or(is_before) {
                first = Some(t.clone());
            }
            let is_behind = |last: &Fraction<I>| t.compare(last) == Ordering::Greater;
            if last.as_ref().is_none_or(is_behind) {
                last = Some(t);
            }
        };
        for i in 0..3 {
            let j = (i + 1) % 3;
            let (x, y) = (&offsets[i], &offsets[j]);
            let Some(k) = (0..3).find(|k| !x[*k].is_zero()) else {
                touches(Fraction::new(r[i][m].clone(), d[m].clone(), self.exponent));
                continue;
            };
            let is_opposite = x[k].sign() == y[k].sign().reverse();
            if is_opposite {
                let numerator = I::minor(&y[k], &r[i][m], &x[k], &r[j][m]);
                let denominator = (y[k].clone() - &x[k]) * &d[m];
                touches(Fraction::new(numerator, denominator, self.exponent));
            }
        }
        Some([first?, last?])
    }
}

impl Seen<BigInt> {
    /// With the vertices a, b and c seen from the origin the weights d·(c×b), d·(a×c) and d·(b×a) add up to -D. The line
    /// passes all edges on the same side, or through them, if no two weights have opposite signs.
    ///
    /// All three are 0 if and only if the line is coplanar with each edge. Else D is not 0 once their signs agree: with D = 0 their sum
    /// is 0. And a triangle without area has D = 0.
    fn meet(&self) -> Option<Meeting> {
        let [a, b, c] = &self.vertices;
        let weight = |p, q| ExactInteger::sign(&dot(&self.direction, &cross(p, q)));
        let weights = [weight(c, b), weight(a, c), weight(b, a)];
        let [is_less, is_greater] =
            [Ordering::Less, Ordering::Greater].map(|sign| weights.contains(&sign));
        let (facing, weights) = match (is_less, is_greater) {
            (true, true) => return None,
            (false, false) => return Some(Meeting::Contact(self.contact()?.map(Parameter::Large))),
            // The weights' sum is -D.
            (false, true) => (Facing::Front, weights),
            (true, false) => (Facing::Back, weights.map(Ordering::reverse)),
        };
        let feature = Feature::from_weight_signs(weights);
        Some(Meeting::Crossing(
            facing,
            feature,
            Parameter::Large(self.crossing()),
        ))
    }
}
