//! Which scheme to use: the lowest one that never fails.

use crate::case::Number;
use crate::spawn::{OfScheme, Scheme, Sums, parse};

/// Offsets that are made for a scene are 2, 4, … times the largest that was needed in the pilot.
const DOUBLINGS: u32 = 10;

/// Fixed distances along the normal, and others that follow the coordinates, each the double of the one
/// before: from twice the largest smallest safe offset that a pilot saw.
pub fn made_for(pilot: &Sums) -> [Vec<Scheme>; 2] {
    [("normal", &pilot.least), ("ulps", &pilot.least_in_ulps)].map(|(name, least)| {
        let needed = least.largest();
        let times = (1..=DOUBLINGS).filter(|_| 0.0 < needed).map(|k| f64::from(1u32 << k));
        let scheme = |times| parse(&format!("{name}={}", rounded_up(times * needed)));
        times.filter_map(|times| scheme(times).ok()).collect()
    })
}

/// Of such schemes the first of each list without a failure; the last if there is none.
pub fn least_without_failure(made: [Vec<Scheme>; 2], tried: &Sums) -> Vec<Scheme> {
    let mut sums = tried.schemes.iter();
    let mut chosen = Vec::new();
    for schemes in made {
        let failed: Vec<bool> =
            schemes.iter().zip(&mut sums).map(|(_, of)| 0 < of.failed).collect();
        let first = failed.iter().position(|failed| !failed);
        chosen.extend(schemes.into_iter().nth(first.unwrap_or(failed.len().saturating_sub(1))));
    }
    chosen
}

/// Two digits at or above a positive number.
fn rounded_up(x: f64) -> String {
    let text = format!("{x:.1e}");
    let (digits, exponent) = text.split_once('e').unwrap_or((&text, "0"));
    let digits = (digits.parse::<f64>().unwrap_or(0.0) * 10.0).round() as i64;
    let exponent = exponent.parse().unwrap_or(0) - 1;
    let tries = [digits, digits + 1].map(|digits| format!("{digits}e{exponent}"));
    let all: Vec<f64> = tries.iter().filter_map(|text| text.parse().ok()).collect();
    Number(all.into_iter().find(|y| x <= *y).unwrap_or(x)).to_string()
}

/// The scheme with the lowest median height of those that never failed by some count: in the pilot, which
/// those that are made for a scene were made on, and in the run.
pub fn lowest(pilot: &Sums, sums: &Sums, failures: impl Fn(&OfScheme) -> u64) -> Option<usize> {
    let median =
        |place: &usize| sums.schemes[*place].in_edges.quantile(0.5).unwrap_or(f64::INFINITY);
    let never = |place: &usize| {
        let in_run = [pilot.schemes.get(*place), sums.schemes.get(*place)];
        0 < sums.schemes[*place].rays && in_run.into_iter().flatten().all(|of| failures(of) == 0)
    };
    let all = (0..sums.schemes.len()).filter(never);
    all.min_by(|a, b| median(a).total_cmp(&median(b)))
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
