//! A gate's exact margin, in as many digits as show on which side of the epsilon it lies.

use crate::arith::{Exact, Float, Real};
use crate::epsilon::shortest;
use crate::explore::Decimal;
use std::cmp::Ordering;

/// A margin in seven digits, or in as many as show on which side of the epsilon it lies; where
/// seventeen do not, as the epsilon and the distance from it. Where it is the epsilon itself and the
/// gate refuses, the gate accepts only what is below.
pub(super) fn margin_text<F: Float>(margin: &Exact, epsilon: F, refuses: bool) -> String {
    let distance = margin.clone() - Exact::from_f64(epsilon.to_f64());
    let epsilon = shortest(epsilon);
    let (Some((sign, size)), Some((side, distance))) =
        (sign_and_size(margin), sign_and_size(&distance))
    else {
        return format!("{:e}", margin.approximate());
    };
    if side == Ordering::Equal {
        return if refuses {
            format!("below {epsilon}")
        } else {
            epsilon
        };
    }
    let epsilon_size = epsilon
        .trim_start_matches('-')
        .parse()
        .unwrap_or(Decimal::ZERO);
    let shown_side = |digits: u32| match (sign == Ordering::Less, epsilon.starts_with('-')) {
        (false, false) => size.rounded(digits).cmp(&epsilon_size),
        (true, true) => epsilon_size.cmp(&size.rounded(digits)),
        (true, false) => Ordering::Less,
        (false, true) => Ordering::Greater,
    };
    match [7, 9, 17]
        .into_iter()
        .find(|digits| shown_side(*digits) == side)
    {
        Some(digits) => {
            let minus = if sign == Ordering::Less { "-" } else { "" };
            format!("{minus}{}", size.with_digits(digits))
        }
        None => {
            let direction = if side == Ordering::Less { '-' } else { '+' };
            format!("{epsilon} {direction} {}", distance.brief())
        }
    }
}

/// The sign and the size of a finite number.
fn sign_and_size(number: &Exact) -> Option<(Ordering, Decimal)> {
    Some((number.sign()?, Decimal::of(&number.abs())?))
}
