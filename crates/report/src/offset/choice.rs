//! Which scheme to use: a simple one that never fails and is about as low as any.

use crate::arith::two_digits;
use crate::case::ShortNumber;
use hairline_advice::offset::{Lengths, OfScheme, OffsetSums, Scheme, parse};

/// Offsets that are made for a scene are 2, 4, … times the largest that was needed in the pilot.
const DOUBLINGS: u32 = 10;

/// Distances along the normal, and others that follow the coordinates. Of the first the derived one, if there is one;
/// of others each is the double of the one before, from twice the largest smallest safe offset that a pilot saw on any
/// kind of plane.
pub fn made_for(pilots: &[OffsetSums], derived: Option<f64>) -> [Vec<Scheme>; 2] {
    let largest = |of: fn(&OffsetSums) -> &Lengths| {
        pilots
            .iter()
            .map(|pilot| of(pilot).largest())
            .fold(0.0, f64::max)
    };
    let made = |name: &str, needed: f64| -> Vec<Scheme> {
        let times = (1..=DOUBLINGS)
            .filter(|_| 0.0 < needed)
            .map(|k| f64::from(1u32 << k));
        let scheme = |times| parse(&format!("{name}={}", rounded_up(times * needed)));
        times.filter_map(|times| scheme(times).ok()).collect()
    };
    let along_normal = match derived {
        Some(derived) => parse(&derived_name(derived)).into_iter().collect(),
        None => made("normal", largest(|pilot| &pilot.least)),
    };
    [
        along_normal,
        made("ulps", largest(|pilot| &pilot.least_in_ulps)),
    ]
}

/// The scheme of a derived distance along the normal.
pub fn derived_name(derived: f64) -> String {
    format!("normal={}", ShortNumber(derived))
}

/// Two digits at or above a positive number.
fn rounded_up(x: f64) -> String {
    ShortNumber(two_digits(x, true)).to_string()
}

/// An offset at most this many times as high as the lowest is as good: another seed may turn them round.
const AS_LOW: f64 = 4.0;

/// The scheme to use of those that never failed on any kind of plane: in the pilots, which those that are made for a
/// scene were made on, and in the runs: one that is `derived`; else the first of some preferred ones that is about as low
/// as any; else the lowest. Heights are those on the first kind of plane.
pub fn best(
    [pilots, runs]: [&[OffsetSums]; 2],
    preferred: &[usize],
    derived: Option<usize>,
) -> Option<usize> {
    let sums = runs.first()?;
    let median = |place: &usize| {
        sums.schemes[*place]
            .in_edges
            .quantile(0.5)
            .unwrap_or(f64::INFINITY)
    };
    let never = |place: &usize| {
        let in_runs = pilots
            .iter()
            .chain(runs)
            .filter_map(|sums| sums.schemes.get(*place));
        0 < sums.schemes[*place].rays && in_runs.into_iter().all(|of| of.failed == 0)
    };
    let all = (0..sums.schemes.len()).filter(never);
    let lowest = all.min_by(|a, b| median(a).total_cmp(&median(b)))?;
    let is_as_good = |place: &&usize| {
        let is_low = derived == Some(**place) || median(place) <= AS_LOW * median(&lowest);
        never(place) && is_low && !is_too_high(&sums.schemes[**place])
    };
    Some(
        derived
            .iter()
            .chain(preferred)
            .find(is_as_good)
            .copied()
            .unwrap_or(lowest),
    )
}

/// True if half of a scheme's starts are more than a tenth of their triangle's longest edge above it, or one in a
/// hundred more than the whole.
pub fn is_too_high(scheme: &OfScheme) -> bool {
    let is_above = |share, most| {
        scheme
            .in_edges
            .quantile(share)
            .is_some_and(|edges| most < edges)
    };
    is_above(0.5, 0.1) || is_above(0.99, 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_digits_are_never_below() {
        for (x, text) in [
            (0.0123, "0.013"),
            (0.012, "0.012"),
            (3.0, "3"),
            (2.941, "3"),
            (99.1, "100"),
            (1.01e-7, "1.1e-7"),
            (9.99e-9, "1e-8"),
            (123456.0, "130000"),
            (0.00251, "0.0026"),
        ] {
            assert_eq!(rounded_up(x), text);
        }
        for i in 1..20_000 {
            let x = f64::from(i) * 1.37e-6;
            let y: f64 = rounded_up(x).parse().unwrap();
            assert!(x <= y && y <= 1.1 * x, "{x} {y}");
        }
    }
}
