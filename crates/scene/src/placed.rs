//! A matrix that puts a mesh into the world: its vertices there, rounded with a bound, and exactly.
//!
//! **The bound.** A coordinate is ((m₀v₀ + m₁v₁) + m₂v₂) + m₃. A product has one rounding and three sums behind it, so that the
//! result is off by at most ((1+u)⁴ - 1)·R, below 4.1u·R, and a product that underflows by 2^-1075, where R is the largest
//! sum |m₀v₀| + |m₁v₁| + |m₂v₂| + |m₃| of all vertices and axes. R itself is computed with as many roundings.

use crate::aabb::Aabb;
use crate::mesh::Triangle;
use hairline_core::arith::scale_by_power_of_two;
use hairline_core::case::Matrix;
use hairline_core::oracle::integer::{IntegerVector, align, dot};
use num_bigint::BigInt;

const U: f64 = f64::EPSILON / 2.0;

/// A matrix for some triangles.
pub struct Placed {
    matrix: Matrix<f64>,
    /// R, as computed.
    size: f64,
}

impl Placed {
    /// None if a coordinate may be too large.
    pub fn new(
        matrix: Matrix<f64>,
        triangles: impl Iterator<Item = Triangle<f64>>,
    ) -> Option<Placed> {
        let sizes = matrix.map(|row| row.map(f64::abs));
        let vertices = triangles.flatten();
        let of_axes = vertices.flat_map(|vertex| apply(&sizes, vertex.map(f64::abs)));
        let size = of_axes.fold(0.0, f64::max);
        // Moved by its bound, and twice as large, it is finite.
        (size < scale_by_power_of_two(1.0, 1000)).then_some(Placed { matrix, size })
    }

    /// A triangle in the world, rounded.
    #[inline(always)]
    pub fn rounded(&self, triangle: &Triangle<f64>) -> Triangle<f64> {
        triangle.map(|vertex| apply(&self.matrix, vertex))
    }

    /// The E of the filter: at least 1.5 times 4.1R, and the roundings of R. None if the filter's bounds do not hold.
    #[inline(always)]
    pub fn more(&self) -> Option<f64> {
        let more = 8.0 * self.size;
        (scale_by_power_of_two(1.0, -140)..scale_by_power_of_two(1.0, 140))
            .contains(&more)
            .then_some(more)
    }

    /// A bound on all coordinates, those of boxes too.
    pub fn largest(&self) -> f64 {
        self.size + self.margin()
    }

    /// More than a rounded coordinate is off, also once it is moved by that.
    fn margin(&self) -> f64 {
        8.0 * U * self.size + scale_by_power_of_two(1.0, -1070)
    }

    /// A box that holds a triangle in the world, in a scale.
    pub fn around(&self, triangle: &Triangle<f64>, exponent: i32) -> Aabb {
        let rounded = self.rounded(triangle);
        let moved = |by: f64| rounded.map(|vertex| vertex.map(|x| x + by));
        let mut all = Aabb::around(&moved(-self.margin()), exponent);
        all.join(&Aabb::around(&moved(self.margin()), exponent));
        all
    }

    /// The exact vertices, as integers times 2 to a power.
    pub fn exact(&self, triangle: &Triangle<f64>) -> ([IntegerVector<BigInt>; 3], i64) {
        let (rows, of_rows) = align(self.matrix.map(|[x, y, z, _]| [x, y, z]));
        let ([moved], of_moved) = align([self.matrix.map(|row| row[3])]);
        let (vertices, of_vertices) = align(*triangle);
        let of_products = of_rows + of_vertices;
        let grid = of_products.min(of_moved);
        let placed = vertices.map(|vertex| {
            std::array::from_fn(|axis| {
                let product = dot(&rows[axis], &vertex) << (of_products - grid);
                product + (&moved[axis] << (of_moved - grid))
            })
        });
        (placed, grid)
    }
}

#[inline(always)]
fn apply(matrix: &Matrix<f64>, vertex: [f64; 3]) -> [f64; 3] {
    let [x, y, z] = vertex;
    matrix.map(|[a, b, c, moved]| a * x + b * y + c * z + moved)
}

#[cfg(test)]
mod tests {
    use super::*;
    use hairline_core::case::Draw;
    use num_rational::BigRational;
    use num_traits::One;

    fn rational(x: f64) -> BigRational {
        BigRational::from_float(x).unwrap()
    }

    #[test]
    fn roundings_are_within_the_margin_and_vertices_in_their_box() {
        let mut largest_share = 0.0f64;
        for index in 0..1000 {
            let mut draw = Draw::new("placed", 1, index);
            let most = [0, 8, 480, 1074, 540][index as usize % 5];
            // The last ones have products that underflow, and nothing else.
            let is_tiny = most == 540;
            let mut number = || {
                let any = draw.integer(-most, most) as i32;
                let exponents = [0, 0, 0, any, -most as i32];
                let exponent = if is_tiny {
                    exponents[4]
                } else {
                    draw.pick(&exponents)
                };
                scale_by_power_of_two(draw.symmetric(), exponent)
            };
            let mut matrix = [(); 3].map(|()| [(); 4].map(|()| number()));
            if is_tiny {
                matrix.iter_mut().for_each(|row| row[3] = 0.0);
            }
            let triangle = [(); 3].map(|()| [(); 3].map(|()| number()));
            let Some(placed) = Placed::new(matrix, [triangle].into_iter()) else {
                continue;
            };
            let rounded = placed.rounded(&triangle);
            let (exact, unit) = placed.exact(&triangle);
            let exponent = -crate::aabb::exponent_of(placed.largest()).unwrap();
            let bounds = placed.around(&triangle, exponent);
            let of_scale = |bound: f32| {
                let power = BigRational::from(BigInt::one() << exponent.unsigned_abs());
                let bound = rational(bound.into());
                if exponent < 0 {
                    bound * power
                } else {
                    bound / power
                }
            };
            for corner in 0..3 {
                for axis in 0..3 {
                    let power = BigRational::from(BigInt::one() << unit.unsigned_abs());
                    let integer = BigRational::from(exact[corner][axis].clone());
                    let x = if unit < 0 {
                        integer / power
                    } else {
                        integer * power
                    };
                    // By the definition.
                    let mut sum = rational(matrix[axis][3]);
                    for k in 0..3 {
                        sum += rational(matrix[axis][k]) * rational(triangle[corner][k]);
                    }
                    assert_eq!(x, sum);
                    let off = x.clone() - rational(rounded[corner][axis]);
                    let off = if off < rational(0.0) { -off } else { off };
                    assert!(off <= rational(placed.margin()), "{matrix:?} {triangle:?}");
                    assert!(x <= of_scale(bounds.max[axis]), "{matrix:?} {triangle:?}");
                    assert!(of_scale(bounds.min[axis]) <= x, "{matrix:?} {triangle:?}");
                    if let Some(more) = placed.more() {
                        // The filter's E is 1.5 times this over u.
                        let share = crate::rounded::rounded(&(off / rational(more)));
                        largest_share = largest_share.max(share / U);
                    }
                }
            }
        }
        assert!(
            (0.05..2.0 / 3.0).contains(&largest_share),
            "{largest_share}"
        );
    }
}
