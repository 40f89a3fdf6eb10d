//! Boxes around faces, in `f32`, and the scale in which they lie.

use crate::mesh::Triangle;
use hairline_core::arith::scale_by_power_of_two;

/// A closed box whose corners are rounded outwards.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Aabb {
    pub min: [f32; 3],
    pub max: [f32; 3],
}

impl Aabb {
    /// No points.
    pub const EMPTY: Aabb = Aabb {
        min: [f32::INFINITY; 3],
        max: [f32::NEG_INFINITY; 3],
    };

    /// The least box that holds a triangle whose coordinates are multiplied by `2^exponent`.
    pub fn around(triangle: &Triangle<f64>, exponent: i32) -> Aabb {
        let mut bounds = Aabb::EMPTY;
        for vertex in triangle {
            for (axis, x) in vertex.iter().copied().enumerate() {
                let scaled = scale_by_power_of_two(x, exponent);
                bounds.min[axis] = bounds.min[axis].min(below(x, scaled));
                bounds.max[axis] = bounds.max[axis].max(-below(-x, -scaled));
            }
        }
        bounds
    }

    /// The box with another one in it.
    #[inline(always)]
    pub fn join(&mut self, other: &Aabb) {
        for axis in 0..3 {
            self.min[axis] = self.min[axis].min(other.min[axis]);
            self.max[axis] = self.max[axis].max(other.max[axis]);
        }
    }
}

/// So many boxes are tested at a time.
pub const LANES: usize = 4;

/// Boxes side by side: each number of all of them together, as vectors of a processor hold them.
#[derive(Clone, Copy, Debug)]
pub struct Boxes {
    /// The least and the greatest corners, by axis and then by box.
    pub planes: [[[f32; LANES]; 3]; 2],
}

impl Boxes {
    /// No points in any.
    pub const EMPTY: Boxes = Boxes {
        planes: [[[f32::INFINITY; LANES]; 3], [[f32::NEG_INFINITY; LANES]; 3]],
    };

    /// Puts a box in place of one.
    pub fn set(&mut self, k: usize, bounds: &Aabb) {
        for axis in 0..3 {
            self.planes[0][axis][k] = bounds.min[axis];
            self.planes[1][axis][k] = bounds.max[axis];
        }
    }

    /// One of them.
    pub fn get(&self, k: usize) -> Aabb {
        let [min, max] = self.planes.map(|planes| planes.map(|lanes| lanes[k]));
        Aabb { min, max }
    }
}

/// The largest `f32` that is at most x in its scale. `scaled` is x there, rounded only where it is below 2^-1022, and then
/// the nearest `f32` is 0: so a negative x needs the next one, whatever `scaled` says.
fn below(x: f64, scaled: f64) -> f32 {
    let nearest = scaled as f32;
    let is_above = f64::from(nearest) > scaled || (nearest == 0.0 && x < 0.0);
    if is_above {
        nearest.next_down()
    } else {
        nearest
    }
}

/// The exponent of the leading bit: `2^e <= |x| < 2^(e+1)`. None of zero.
pub fn exponent_of(x: f64) -> Option<i32> {
    if x == 0.0 {
        return None;
    }
    let bits = x.to_bits();
    let field = (bits >> 52 & 0x7ff) as i32;
    if field != 0 {
        return Some(field - 1023);
    }
    let fraction = bits & ((1 << 52) - 1);
    Some(63 - fraction.leading_zeros() as i32 - 1074)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn boxes_hold_their_triangle_in_every_scale() {
        for size in [
            1.0,
            1.0f64.next_up(),
            1.1,
            f64::MAX,
            f64::from_bits(1),
            1e-300,
        ] {
            let exponent = -exponent_of(size).unwrap();
            // Coordinates that are far below the largest one underflow in the scale.
            for any in [0.0, f64::from_bits(1), 1e-310, 1e-40, size] {
                let small = size.min(any);
                let triangle = [[size, small, -small], [-size, small, small], [small; 3]];
                let bounds = Aabb::around(&triangle, exponent);
                for axis in 0..3 {
                    for vertex in triangle {
                        let x = vertex[axis];
                        let unscaled = |bound: f32| scale_by_power_of_two(bound.into(), -exponent);
                        assert!(unscaled(bounds.min[axis]) <= x, "{size:e} {small:e}");
                        assert!(x <= unscaled(bounds.max[axis]), "{size:e} {small:e}");
                    }
                }
                assert!(bounds.max.iter().all(|x| *x <= 2.0));
            }
        }
    }

    #[test]
    fn exponents_are_those_of_the_leading_bit() {
        for exponent in -1074..1024 {
            let power = scale_by_power_of_two(1.0, exponent);
            assert_eq!(exponent_of(-power), Some(exponent));
        }
        assert_eq!(exponent_of(f64::MAX), Some(1023));
        assert_eq!(exponent_of(f64::from_bits(7)), Some(-1072));
        assert_eq!(exponent_of(-0.0), None);
    }
}
