//! `baldwin-weber`: an affine map per triangle, from space to barycentric coordinates.
//!
//! Source: D. Baldwin and M. Weber, "Fast Ray-Triangle Intersections by Coordinate Transformation",
//! Journal of Computer Graphics Techniques 5(3), 2016, <https://jcgt.org/published/0005/03/03/>: nine
//! coefficients and the fixed column, which is the axis of the normal's largest component. The
//! comparisons are as printed: t ≤ near and t ≥ far are misses; x + y < 1 is strict while those of x
//! and y are not, so edge bc is lost.

use super::{EpsilonSet, Gate, Gives, Hit, Kernel, KernelInfo, Refuse, Role, Sink, gap};
use crate::arith::{Real, Vector};
use crate::case::{Ray, Triangle};
use crate::contract::{Boundary, Contract, Extent, Sides};

pub(super) struct BaldwinWeber;

const COLUMN: usize = 0;
const T: usize = 1;
const EDGE: usize = 2;

/// The nine coefficients, by rows, and the axis of the fixed column.
pub(super) struct Transformation<R> {
    x: [R; 3],
    y: [R; 3],
    z: [R; 3],
    /// None of a triangle without area.
    fixed: Option<usize>,
}

impl Kernel for BaldwinWeber {
    const INFO: KernelInfo = KernelInfo {
        name: "baldwin-weber",
        source: "D. Baldwin and M. Weber, Fast Ray-Triangle Intersections by Coordinate Transformation, 2016, \
                 nine coefficients, https://jcgt.org/published/0005/03/03/",
        contract: Contract::of_kernel(Extent::Interval, Sides::Both, Boundary::Closed),
        gates: &[
            Gate::fixed(
                Role::Other,
                "no component of the normal is the largest: no fixed column",
            )
            .named("column"),
            Gate::signed(Role::T, "t - t_min <= e, t_max - t <= e", 1, -1),
            Gate::signed(Role::Edge, "!(x >= e), !(y >= e), !(1-(y+x) > e)", 0, 0),
        ],
        epsilon_sets: &[EpsilonSet {
            name: "source",
            values: &["0", "0", "0"],
        }],
        gives: Gives {
            t: true,
            uv: true,
            facing: false,
        },
        polygons: false,
    };

    type Prepared<V: Vector> = Transformation<V::Real>;

    #[inline(always)]
    fn prepare<V: Vector>(Triangle { a, b, c }: &Triangle<V>) -> Transformation<V::Real> {
        let (edge1, edge2) = (b.minus(a), c.minus(a));
        let normal = edge1.cross(&edge2);
        let num = a.dot(&normal);
        let fixed = fixed_column(&normal);
        // The two other axes, in cyclic order after the fixed one: the three printed cases are one
        // case up to the order of a difference, which only decides signs of zero.
        let k = fixed.unwrap_or(2);
        let (i, j) = match k {
            0 => (1, 2),
            1 => (2, 0),
            _ => (0, 1),
        };
        let n = normal.at(k);
        let minor = |p: &V| p.at(i) * a.at(j) - p.at(j) * a.at(i);
        let row = |along_i: V::Real, along_j: V::Real, last: V::Real| {
            let (along_i, along_j, last) = (along_i / &n, along_j / &n, last / &n);
            // Stored in the order of the axes, as the test reads them.
            if i < j {
                [along_i, along_j, last]
            } else {
                [along_j, along_i, last]
            }
        };
        Transformation {
            x: row(edge2.at(j), -edge2.at(i), minor(c)),
            y: row(-edge1.at(j), edge1.at(i), -minor(b)),
            z: row(normal.at(i), normal.at(j), -num),
            fixed,
        }
    }

    #[inline(always)]
    fn test<V: Vector, S: Sink<V::Real>>(
        map: &Transformation<V::Real>,
        Ray {
            origin,
            direction,
            t_min,
            t_max,
        }: &Ray<V>,
        sink: &mut S,
    ) -> Option<Hit<V::Real>> {
        sink.fixed(COLUMN, map.fixed.is_some())?;
        let k = map.fixed.unwrap_or(2);
        let (first, second) = match k {
            0 => (1, 2),
            1 => (0, 2),
            _ => (0, 1),
        };
        // The printed sums run over x, y, z in turn, with coefficient 1 at the fixed column.
        let z = |p: &V| {
            let [m, n, _] = &map.z;
            let (one, two, fixed) = (m.clone() * p.at(first), n.clone() * p.at(second), p.at(k));
            match k {
                0 => fixed + one + two,
                1 => one + fixed + two,
                _ => one + two + fixed,
            }
        };
        let t = -(z(origin) + &map.z[2]) / z(direction);
        sink.one(T, Refuse::AtMost, &gap(&t, t_min))?;
        sink.one(T, Refuse::AtMost, &gap(t_max, &t))?;
        let at = |axis: usize| origin.at(axis) + t.clone() * direction.at(axis);
        let (p, q) = (at(first), at(second));
        let row = |[m, n, last]: &[V::Real; 3]| m.clone() * &p + n.clone() * &q + last;
        let (x, y) = (row(&map.x), row(&map.y));
        sink.one(EDGE, Refuse::UnlessAtLeast, &x)?;
        sink.one(EDGE, Refuse::UnlessAtLeast, &y)?;
        sink.one(
            EDGE,
            Refuse::UnlessAbove,
            &(V::Real::one() - (y.clone() + &x)),
        )?;
        Some(Hit {
            t: Some(t),
            uv: Some((x, y)),
            facing: None,
        })
    }
}

/// The printed choice: strictly largest x, else y above z, else z if it is not zero.
fn fixed_column<V: Vector>(normal: &V) -> Option<usize> {
    let [x, y, z] = [0, 1, 2].map(|axis| normal.at(axis).abs());
    if y.is_less(&x) && z.is_less(&x) {
        Some(0)
    } else if z.is_less(&y) {
        Some(1)
    } else if V::Real::zero().is_less(&z) {
        Some(2)
    } else {
        None
    }
}
