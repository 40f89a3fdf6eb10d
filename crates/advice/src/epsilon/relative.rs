//! Epsilons that follow the size of each case.

use crate::arith::Float;
use crate::case::Case;
use crate::family::wide;
use crate::kernel::Dimension;

/// The largest e for which `e * unit <= margin`, in the scalar's arithmetic.
pub(super) fn relative<F: Float>(margin: F, unit: F) -> F {
    if !margin.is_finite() {
        return margin;
    }
    let quotient = margin / unit;
    for ulps in [0, -1, 1] {
        let epsilon = quotient.offset_ulps(ulps);
        if is_last_accepted(epsilon, unit, margin) {
            return epsilon;
        }
    }
    F::largest_accepted(|e| *e * unit <= margin, || quotient)
}

/// True if `e * unit <= margin` for an epsilon that is no zero, and for none above it: as for a quotient or a number beside
/// it, so that no search is needed.
fn is_last_accepted<F: Float>(epsilon: F, unit: F, margin: F) -> bool {
    if epsilon.is_zero() || !epsilon.is_finite() {
        return false;
    }
    let next = epsilon.offset_ulps(1);
    // Whatever accepts the largest number accepts infinity.
    next.is_finite() && epsilon * unit <= margin && margin < next * unit
}

/// The sizes of a case, from which the units of its margins follow.
#[derive(Clone, Copy)]
pub(super) struct CaseSizes {
    longest_edge: f64,
    /// The largest coordinate of the origin and the vertices.
    farthest: f64,
    /// The length of the direction.
    speed: f64,
}

impl CaseSizes {
    pub(super) fn of<F: Float>(case: &Case<F>) -> CaseSizes {
        let [o, d, a, b, c] = case.vectors().map(wide);
        let squares = [(a, b), (b, c), (c, a)].map(|(p, q)| p.distance_squared(q));
        CaseSizes {
            longest_edge: squares.into_iter().fold(0.0f64, f64::max).sqrt(),
            farthest: [o, a, b, c]
                .iter()
                .fold(0.0f64, |most, v| most.max(v.abs().max_element())),
            speed: d.length(),
        }
    }

    /// The unit of a gate's margin: L^p·|d|^q for a dimension (p, q). L is the triangle's longest edge; for t, whose error
    /// follows the distance from zero, it is the largest coordinate.
    ///
    /// Computed in `f64` and rounded to the scalar; 1 where that is zero or infinite.
    pub(super) fn unit<F: Float>(self, dimension: Dimension) -> F {
        let length = if dimension == Dimension::T {
            self.farthest
        } else {
            self.longest_edge
        };
        let speed = if dimension.direction == 0 {
            1.0
        } else {
            self.speed
        };
        let unit = length.powi(dimension.length.into()) * speed.powi(dimension.direction.into());
        let unit = F::from_f64(unit);
        if unit.is_finite() && F::zero() < unit {
            unit
        } else {
            F::from_f64(1.0)
        }
    }
}

/// The comparison that means the same at every scale, for a gate of this dimension.
pub fn scale_free_form(dimension: Dimension) -> Option<String> {
    let power = |base: &str, exponent: i8| match exponent {
        0 => None,
        1 => Some(format!(" * {base}")),
        n => Some(format!(" * {base}^{n}")),
    };
    if !dimension.has_unit() {
        return None;
    }
    let Dimension { length, direction } = dimension;
    let base = if dimension == Dimension::T { "M" } else { "L" };
    let mut text = "e".to_owned();
    text.extend(power(base, length));
    match direction {
        -1 => text.push_str(" / |d|"),
        n => text.extend(power("|d|", n)),
    }
    Some(text)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arith::scale_by_power_of_two;
    use crate::case::{Case, Draw};
    use crate::kernel::{KERNELS, Scalar, Tunable};

    fn scale<F: Float>(case: &Case<F>, dimension: Dimension) -> F {
        CaseSizes::of(case).unit(dimension)
    }

    /// A generic case near 1 whose coordinates are all multiplied by 2^`power`, and the direction too.
    fn scaled(index: u64, power: i32) -> Case<f64> {
        let mut draw = Draw::new("dimension", 1, index);
        let mut vector = || [(); 3].map(|()| scale_by_power_of_two(draw.symmetric::<f64>(), power));
        Case::new(vector(), vector(), [vector(), vector(), vector()])
    }

    #[test]
    fn margins_follow_the_size_by_the_power_of_the_gates_dimension() {
        for entry in KERNELS {
            let Some(gated) = f64::subject(entry).and_then(|subject| subject.gated()) else {
                continue;
            };
            let mut compared = 0;
            for index in 0..200 {
                // Scales that quotients, square roots and fourth powers of powers of two keep exact.
                let [plain, large] =
                    [0, 8].map(|power| gated.measure(&scaled(index, power)).margins);
                for ((gate, plain), large) in entry.info.gates.iter().zip(plain).zip(large) {
                    let Dimension { length, direction } = gate.dimension;
                    let unit = 2f64.powi(8 * i32::from(length + direction));
                    if plain.is_finite() && plain.abs() < f64::MAX {
                        assert_eq!(
                            large,
                            plain * unit,
                            "{} {} {index}",
                            entry.info.name,
                            gate.name
                        );
                        compared += 1;
                    }
                }
            }
            let has_epsilons = entry
                .info
                .gates
                .iter()
                .any(|gate| gate.epsilon != Tunable::Fixed);
            assert!(!has_epsilons || 100 < compared, "{}", entry.info.name);
        }
    }

    #[test]
    fn units_are_lengths_and_directions_to_their_powers() {
        // Edges of 3, 4 and 5, |d| = 7, and a largest coordinate of 17, of the origin or of a vertex.
        let corners = |x: f32| [[x, 0.0, 0.0], [x + 3.0, 0.0, 0.0], [x, 4.0, 0.0]];
        let at = |origin: f32, x: f32, size: f32| {
            let vectors = corners(x).map(|corner| corner.map(|x| x * size));
            let d = [2.0, -3.0, 6.0].map(|x| x * size);
            Case::<f32>::new([origin, 1.0, -2.0].map(|x| x * size), d, vectors)
        };
        for (origin, x) in [(-17.0, 0.0), (5.0, -17.0), (5.0, 14.0)] {
            let case = at(origin, x, 1.0);
            let unit = |length, direction| scale(&case, Dimension::new(length, direction));
            assert_eq!(
                [unit(0, 0), unit(1, 0), unit(3, 1), unit(0, 2)],
                [1.0, 5.0, 875.0, 49.0]
            );
            assert_eq!(unit(1, -1), 17.0 / 7.0);
            let scales = [at(0.0, 0.0, 2.0), case].map(|case| scale(&case, Dimension::new(2, 0)));
            assert_eq!(scales, [100.0, 25.0]);
            // e·100 <= 6.5 and e·25 <= 6.25, in floats.
            let [one, other] = [relative(6.5, scales[0]), relative(6.25, scales[1])];
            assert!((one - 0.065).abs() < 1e-8, "{one}");
            assert!((0.25..0.25 + 1e-7).contains(&other), "{other}");
            assert_eq!(relative(f32::INFINITY, scales[1]), f32::INFINITY);
            assert_eq!(relative(-f32::INFINITY, scales[1]), -f32::INFINITY);
            let small = at(origin, x, 1.0 / 1024.0);
            let unit = |length, direction| scale(&small, Dimension::new(length, direction));
            assert_eq!([unit(1, 0), unit(1, -1)], [5.0 / 1024.0, 17.0 / 7.0]);
        }
        for axis in 0..3 {
            let mut corners = corners(0.0);
            corners
                .iter_mut()
                .for_each(|corner| corner.rotate_right(axis));
            corners.rotate_left(axis);
            let case = Case::<f32>::new([0.0; 3], [1.0, 0.0, 0.0], corners);
            assert_eq!(scale(&case, Dimension::new(1, 0)), 5.0);
        }
        // Where nothing can be said of the size it is 1.
        let point = Case::<f32>::new([0.0; 3], [1.0; 3], [[2.0; 3]; 3]);
        assert_eq!(scale(&point, Dimension::new(1, 0)), 1.0);
        let (huge, tiny) = (at(0.0, 0.0, 1e30), at(0.0, 0.0, 1e-30));
        assert_eq!(
            [&huge, &tiny].map(|case| scale(case, Dimension::new(2, 0))),
            [1.0; 2]
        );
    }

    #[test]
    fn a_form_names_the_powers_of_its_unit() {
        let form = |length, direction| scale_free_form(Dimension::new(length, direction));
        assert_eq!(form(0, 0), None);
        let forms = [(1, 0), (2, 0), (0, 1), (0, -1), (1, -1), (2, 1), (4, 2)];
        let expected = [
            "e * L",
            "e * L^2",
            "e * |d|",
            "e / |d|",
            "e * M / |d|",
            "e * L^2 * |d|",
            "e * L^4 * |d|^2",
        ];
        assert_eq!(
            forms.map(|(length, direction)| form(length, direction).unwrap()),
            expected
        );
    }

    #[test]
    fn the_relative_margin_is_the_last_epsilon_whose_product_is_accepted() {
        let mut draw = Draw::new("relative", 1, 0);
        for _ in 0..20_000 {
            let unit: f32 =
                draw.symmetric::<f32>().abs() * 2f32.powi(draw.integer(-100, 100) as i32);
            let margin: f32 = draw.symmetric::<f32>() * 2f32.powi(draw.integer(-120, 100) as i32);
            let unit = if unit > 0.0 { unit } else { 1.0 };
            let e = relative(margin, unit);
            if e.is_finite() {
                assert!(e * unit <= margin, "{e:e} {unit:e} {margin:e}");
                assert!(e.next_up() * unit > margin, "{e:e} {unit:e} {margin:e}");
            } else if e > 0.0 {
                assert!(f32::MAX * unit <= margin, "{unit:e} {margin:e}");
            } else {
                assert!(f32::MIN * unit > margin, "{unit:e} {margin:e}");
            }
        }
    }
}
