//! The case that is nearest to another and can be written in few decimal digits, for people to read and to paste.

use crate::arith::Float;
use crate::case::Case;

/// As many significant digits as tell any two `f64` apart.
const MOST_DIGITS: usize = 17;

/// The numbers of a case that are shortened: all coordinates, and the ends of the interval.
const NUMBERS: usize = 17;

/// A case near another one whose numbers have as few significant decimal digits as `keeps` allows: first the interval is 0 to
/// infinity, then all coordinates alike have fewer, then each by itself. It is the case itself if nothing shorter is kept.
///
/// [`shrink`](super::shrink) looks for the simplest case, which may be far away and of other sizes; this one stays in sight of
/// the case that was found.
pub fn shorten<F: Float>(case: &Case<F>, keeps: impl Fn(&Case<F>) -> bool) -> Case<F> {
    let unbounded = case.on(F::zero(), F::infinity());
    let start = match keeps(&unbounded) {
        true => unbounded,
        false => *case,
    };
    let all_alike = |digits: usize| {
        let numbers = start.numbers().map(|number| rounded(number, digits));
        of_numbers(numbers)
    };
    let mut short = (1..MOST_DIGITS)
        .map(all_alike)
        .find(|candidate| keeps(candidate))
        .unwrap_or(start);
    for place in 0..NUMBERS {
        let shorter = (0..MOST_DIGITS)
            .map(|digits| {
                let mut numbers = short.numbers();
                numbers[place] = rounded(numbers[place], digits);
                of_numbers(numbers)
            })
            .find(|candidate| keeps(candidate));
        short = shorter.unwrap_or(short);
    }
    short
}

/// A number rounded to so many significant decimal digits; zero for none. Infinities stay.
fn rounded<F: Float>(number: F, digits: usize) -> F {
    if !number.is_finite() {
        return number;
    }
    match digits.checked_sub(1) {
        None => F::zero(),
        Some(after_the_first) => {
            let rounded = F::parse(&format!("{number:.after_the_first$e}"));
            // The largest floats may round to more than there is.
            rounded.filter(|it| it.is_finite()).unwrap_or(number)
        }
    }
}

fn of_numbers<F: Float>(numbers: [F; NUMBERS]) -> Case<F> {
    Case::from_bits(&numbers.map(F::to_bits))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::oracle::truth;

    const TRIANGLE: [[f64; 3]; 3] = [
        [0.123456789, 0.2, 0.3],
        [4.71828, 0.1, 0.4],
        [0.31415, 5.9001, 0.2],
    ];

    #[test]
    fn a_hit_is_written_in_single_digits() {
        let case = Case::<f64>::new(
            [1.1234, 1.3579, 7.00001],
            [0.010203, 0.020406, -0.9],
            TRIANGLE,
        );
        let hit = truth(&case);
        let short = shorten(&case, |case| truth(case) == hit);
        assert_eq!(truth(&short), hit);
        for number in short.vectors().as_flattened() {
            assert_eq!(rounded(*number, 1), *number, "{short:?}");
        }
    }

    #[test]
    fn what_holds_of_one_case_alone_stays_as_it_is() {
        let case = Case::<f64>::new([1.1234, 1.3579, 7.00001], [0.010203, 0.0, -0.9], TRIANGLE)
            .on(0.125, 17.333);
        let short = shorten(&case, |other| other.bits() == case.bits());
        assert_eq!(short.bits(), case.bits());
        // Each number alone, the ends of the interval among them.
        let keeps_x = |other: &Case<f64>| other.vectors()[0][0] == case.vectors()[0][0];
        let short = shorten(&case, keeps_x);
        assert_eq!(short.vectors()[0], [1.1234, 0.0, 0.0]);
        assert_eq!((short.ray.t_min, short.ray.t_max), (0.0, f64::INFINITY));
    }

    #[test]
    fn numbers_without_digits_stay() {
        assert!(rounded(f32::NAN, 3).is_nan());
        assert_eq!(rounded(f32::NEG_INFINITY, 0), f32::NEG_INFINITY);
        assert_eq!(rounded(0.1_f32, 3), 0.1);
        assert_eq!(rounded(1e-45_f32, 1).to_bits(), 1);
        assert_eq!(rounded(f32::MAX, 1), 3e38);
        assert_eq!(rounded(f64::MAX, 1), f64::MAX);
    }
}
