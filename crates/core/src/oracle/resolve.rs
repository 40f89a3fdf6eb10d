//! Sign by sign, where the filter could not decide all at once.

use super::Layer;
use super::determinant;
use super::filter;
use super::monomials;
use super::scaled::Scaled;
use super::signs::{DecidingSigns, Determinant};
use crate::arith::scale_by_power_of_two;
use crate::case::Case;
use crate::truth::Truth;
use std::cell::LazyCell;
use std::cmp::Ordering;

/// The truth of a valid case, and the last layer that it needed.
pub(super) fn decide(case: &Case<f64>) -> (Truth, Layer) {
    // Where nothing over- or underflows, scaling changes no relative error.
    let near_one = if is_moderate(case) {
        *case
    } else {
        scaled_axes(case)
    };
    let computed = filter::compute(near_one.vectors());
    let mut deepest = Layer::ScaledFilter;
    let mut sign = |wanted: Determinant| {
        computed.sign(wanted).unwrap_or_else(|| {
            let (sign, layer) = determinant::sign(wanted, case, &near_one);
            deepest = deepest.max(layer);
            sign
        })
    };
    let weights = [
        sign(Determinant::Weight(0)),
        sign(Determinant::Weight(1)),
        sign(Determinant::Weight(2)),
    ];
    // U+V+W = -D: weights that agree need no D, and zero weights with them.
    let (any_less, any_greater) = (
        weights.contains(&Ordering::Less),
        weights.contains(&Ordering::Greater),
    );
    let d = match (any_less, any_greater) {
        (true, false) => Ordering::Greater,
        (false, true) => Ordering::Less,
        (false, false) => Ordering::Equal,
        (true, true) => sign(Determinant::D),
    };
    let t = sign(Determinant::T);
    if d == Ordering::Equal {
        return match t {
            Ordering::Equal => (Scaled::new(case).touching(case), Layer::BigInteger),
            // T is not zero, so the triangle has area. The line is parallel to its plane and not in it.
            _ => (Truth::Parallel, deepest),
        };
    }
    let relative = |sign: Ordering| {
        if d == Ordering::Less {
            sign.reverse()
        } else {
            sign
        }
    };
    let unscaled = LazyCell::new(|| filter::compute(case.vectors()));
    let mut from = |end: f64| {
        if end == 0.0 {
            return relative(t);
        }
        if end.is_infinite() {
            return if end > 0.0 {
                Ordering::Less
            } else {
                Ordering::Greater
            };
        }
        match unscaled.is_past(end) {
            Some(true) => Ordering::Greater,
            Some(false) => Ordering::Less,
            None => {
                deepest = deepest.max(Layer::Monomials);
                relative(monomials::compare_with_end(end, case))
            }
        }
    };
    let (from_min, from_max) = (from(case.ray.t_min), from(case.ray.t_max));
    (
        DecidingSigns {
            d,
            weights,
            t,
            from_min,
            from_max,
        }
        .truth(),
        deepest,
    )
}

/// True if scaling can be left out. Coordinates are zero or within 2^±150, so all differences are multiples of 2^-202,
/// and products of three are multiples of 2^-606: nothing underflows or overflows. All layers are right
/// for other cases too, scaled or not; unscaled they would only hand on more.
fn is_moderate(case: &Case<f64>) -> bool {
    const LOW: f64 = f64::from_bits((1023 - 150) << 52);
    const HIGH: f64 = f64::from_bits((1023 + 150) << 52);
    let vectors = case.vectors();
    let mut all = true;
    for x in vectors.as_flattened() {
        all &= (*x == 0.0) | ((x.abs() >= LOW) & (x.abs() <= HIGH));
    }
    all
}

/// The case with each axis scaled by a power of two so that its largest position is about 1, and the
/// direction with them and then so that its largest coordinate is. Scaling an axis multiplies every
/// determinant by a positive number, so all signs stay. What underflows is off by less than 2^-1074,
/// which the layers' bounds allow for; t changes, so the interval means nothing here.
fn scaled_axes(case: &Case<f64>) -> Case<f64> {
    let [mut o, mut d, mut a, mut b, mut c] = case.vectors();
    let mut longest = None;
    let mut shifts = [0; 3];
    for i in 0..3 {
        let of_axis = [o[i], a[i], b[i], c[i]];
        shifts[i] = -largest_exponent(of_axis).unwrap_or(0);
        let of_direction = largest_exponent([d[i]]).map(|exponent| exponent + shifts[i]);
        longest = longest.max(of_direction);
    }
    let longest = longest.unwrap_or(0);
    for i in 0..3 {
        for position in [&mut o, &mut a, &mut b, &mut c] {
            position[i] = scale_by_power_of_two(position[i], shifts[i]);
        }
        d[i] = scale_by_power_of_two(d[i], shifts[i] - longest);
    }
    Case::new(o, d, [a, b, c])
}

/// The largest binary exponent of numbers; none of zeros.
#[inline(always)]
fn largest_exponent<const N: usize>(numbers: [f64; N]) -> Option<i32> {
    let mut largest = None;
    for x in numbers {
        if x != 0.0 {
            largest = largest.max(Some(monomials::exponent_of(x)));
        }
    }
    largest
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arith::decompose;
    use crate::case::Draw;

    /// The exponent of the largest number; none of zeros.
    fn largest_of(numbers: &[f64]) -> Option<i64> {
        let exponent = |x: &f64| {
            let (digits, exponent) = decompose(*x);
            (digits != 0).then(|| exponent + i64::from(63 - digits.unsigned_abs().leading_zeros()))
        };
        numbers.iter().filter_map(exponent).max()
    }

    #[test]
    fn axes_are_scaled_to_where_their_largest_position_and_the_direction_are_near_one() {
        for index in 0..500 {
            let mut draw = Draw::new("axes", 1, index);
            // Down to subnormal numbers; zeros, and powers of two, one among them.
            let sizes = [0; 4].map(|_| {
                let [any, subnormal] =
                    [(-1074, 900), (-1074, -1060)].map(|(low, high)| draw.integer(low, high));
                draw.pick(&[0, any, subnormal]) as i32
            });
            let number = |draw: &mut Draw, size: i32| match draw.below(4) {
                0 => 0.0,
                1 => scale_by_power_of_two(1.0, size),
                _ => {
                    let exponent = size + draw.integer(0, 40) as i32;
                    draw.with_exponent::<f64>(exponent)
                }
            };
            let mut vector = |i: usize| match i {
                1 => [0; 3].map(|_| number(&mut draw, sizes[3])),
                _ => [0, 1, 2].map(|axis| number(&mut draw, sizes[axis])),
            };
            let [o, d, a, b, c] = std::array::from_fn(&mut vector);
            let case = Case::new(o, d, [a, b, c]);
            let near_one = scaled_axes(&case);
            let mut of_axis = [0; 3];
            for axis in 0..3 {
                let column = |case: &Case<f64>| case.vectors().map(|v| v[axis]);
                let positions = |[o, _, a, b, c]: [f64; 5]| [o, a, b, c];
                let (was, is) = (positions(column(&case)), positions(column(&near_one)));
                let Some(exponent) = largest_of(&was) else {
                    assert_eq!(is, was);
                    continue;
                };
                of_axis[axis] = exponent;
                assert_eq!(largest_of(&is), Some(0), "axis {axis} of {}", case.hex());
                let expected = was.map(|x| scale_by_power_of_two(x, -exponent as i32));
                assert_eq!(is, expected, "axis {axis} of {}", case.hex());
            }
            // The direction's exponents move with the axes, and then together.
            let moved = |i: usize| largest_of(&[d[i]]).map(|e| e - of_axis[i]);
            if let Some(longest) = (0..3).filter_map(moved).max() {
                let [_, direction, ..] = near_one.vectors();
                let power = |i: usize| (-of_axis[i] - longest) as i32;
                let expected = [0, 1, 2].map(|i| scale_by_power_of_two(d[i], power(i)));
                assert_eq!(direction, expected, "{}", case.hex());
            }
        }
    }
}
