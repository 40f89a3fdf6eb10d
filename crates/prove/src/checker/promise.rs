//! The promise of a guarded kernel, the signs that can occur together, and whether an answer there keeps the promise.

use super::points::{COUNT, FAR, NEAR, SUM, T, U, UV, V, VW, W, WU};

/// The part of the line and the side that count.
pub struct Promise {
    pub extent: String,
    pub is_front: bool,
}

impl Promise {
    /// True if the triangle with its edges may be hit between the ends, these included.
    pub fn is_closed_hit(&self, signs: &[i8; COUNT]) -> bool {
        let weights = &signs[U..=W];
        let is_front = weights.iter().all(|sign| *sign >= 0);
        let is_back = weights.iter().all(|sign| *sign <= 0);
        if signs[SUM] == 0 || !(is_front || is_back) {
            return false;
        }
        if self.is_front && signs[SUM] < 0 {
            return false;
        }
        match self.extent.as_str() {
            "ray" => after(signs, T) >= 0,
            "interval" => after(signs, NEAR) >= 0 && after(signs, FAR) >= 0,
            _ => true,
        }
    }

    /// The reason why a hit of rays with these signs is wrong; none if it is inside the triangle, between the ends and on
    /// a side that counts.
    pub fn wrong_hit(&self, signs: &[i8; COUNT]) -> Option<&'static str> {
        let is_inside = signs[U] != 0 && signs[U] == signs[V] && signs[V] == signs[W];
        if !is_inside {
            return Some("do not pass through the inside of the triangle");
        }
        if self.is_front && signs[SUM] < 0 {
            return Some("hit the back, and it promises the front only");
        }
        match self.extent.as_str() {
            "ray" if after(signs, T) <= 0 => Some("meet the triangle at t <= 0"),
            "interval" if after(signs, NEAR) <= 0 => Some("meet the triangle at t <= t_min"),
            "interval" if after(signs, FAR) <= 0 => Some("meet the triangle at t >= t_max"),
            _ => None,
        }
    }
}

/// The sign of a number over D: of t, or of the distance along the ray to an end. SUM is -D.
fn after(signs: &[i8; COUNT], number: usize) -> i8 {
    signs[number] * -signs[SUM]
}

/// Two numbers and their sum.
const SUMS: [[usize; 3]; 6] = [
    [U, V, UV],
    [V, W, VW],
    [W, U, WU],
    [UV, W, SUM],
    [VW, U, SUM],
    [WU, V, SUM],
];

/// True if numbers can have these signs together.
///
/// The two numbers of an interval that is not empty add up to its length times D, and SUM is -D.
pub fn can_be(signs: &[i8; COUNT], is_interval: bool) -> bool {
    let both = signs[NEAR] + signs[FAR];
    let is_possible = !is_interval || both == 0 || both.signum() == -signs[SUM];
    is_possible && SUMS.iter().all(|sum| is_sum(signs, *sum))
}

/// True if a sum can have its sign: sums of two numbers of one sign have it too, and 0 changes nothing.
fn is_sum(signs: &[i8; COUNT], numbers: [usize; 3]) -> bool {
    let [left, right, sum] = numbers.map(|number| signs[number]);
    match left {
        0 => sum == right,
        _ => left * right < 0 || sum == left,
    }
}
