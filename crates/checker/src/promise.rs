//! The promise of a guarded kernel, the signs that can occur together, and whether an answer there keeps the promise.
//!
//! docs/guide/repair.md has the argument in "Why it is right".

use super::points::{FAR, KnownSigns, NEAR, SUM, T, U, UV, V, VW, W, WU};

/// The part of the line and the side that count.
pub struct Promise {
    pub ends: &'static [End],
    pub is_front: bool,
}

/// An end of the part of the line that counts.
pub struct End {
    /// The known number that is, over D, the distance of the triangle from this end, inwards.
    pub number: usize,
    /// The rays that meet the triangle there or beyond.
    pub beyond: &'static str,
}

const RAY: [End; 1] = [End {
    number: T,
    beyond: "meet the triangle at t <= 0",
}];

const INTERVAL: [End; 2] = [
    End {
        number: NEAR,
        beyond: "meet the triangle at t <= t_min",
    },
    End {
        number: FAR,
        beyond: "meet the triangle at t >= t_max",
    },
];

impl Promise {
    pub fn parse(words: &[&str]) -> Option<Promise> {
        let &[extent, sides] = words else { return None };
        let ends: &[End] = match extent {
            "line" => &[],
            "ray" => &RAY,
            "interval" => &INTERVAL,
            _ => return None,
        };
        let is_front = match sides {
            "front" => true,
            "both" => false,
            _ => return None,
        };
        Some(Promise { ends, is_front })
    }

    /// True if the triangle with its edges may be hit between the ends, these included.
    pub fn is_closed_hit(&self, signs: &KnownSigns) -> bool {
        let is_parallel = signs[SUM] == 0;
        if is_parallel || !self.counts_side(signs) || !is_in_closed_triangle(signs) {
            return false;
        }
        self.ends.iter().all(|end| end.distance(signs) >= 0)
    }

    /// The reason why a hit of rays with these signs is wrong; none if it is inside the triangle, between the ends and on
    /// a side that counts.
    pub fn wrong_hit(&self, signs: &KnownSigns) -> Option<&'static str> {
        let is_on_an_edge = signs[U..=W].contains(&0);
        if is_on_an_edge || !is_in_closed_triangle(signs) {
            return Some("do not pass through the inside of the triangle");
        }
        if !self.counts_side(signs) {
            return Some("hit the back, and it promises the front only");
        }
        for end in self.ends {
            if end.distance(signs) <= 0 {
                return Some(end.beyond);
            }
        }
        None
    }

    /// True if the side that the ray meets counts.
    fn counts_side(&self, signs: &KnownSigns) -> bool {
        !self.is_front || signs[SUM] >= 0
    }

    /// True if numbers can have these signs together.
    pub fn can_be(&self, signs: &KnownSigns) -> bool {
        let is_interval = self.ends.len() == INTERVAL.len();
        if is_interval && !has_inside(signs) {
            return false;
        }
        SUMS.iter().all(|numbers| is_sum(signs, numbers))
    }
}

impl End {
    /// The sign of the distance. SUM is -D.
    fn distance(&self, signs: &KnownSigns) -> i8 {
        signs[self.number] * -signs[SUM]
    }
}

/// True if no two weights have opposite signs.
fn is_in_closed_triangle(signs: &KnownSigns) -> bool {
    let weights = &signs[U..=W];
    !(weights.contains(&1) && weights.contains(&-1))
}

/// True if t_min < t_max is possible: the distances from both ends add up to the length between them.
fn has_inside(signs: &KnownSigns) -> bool {
    let length_times_d = signs[NEAR] + signs[FAR];
    length_times_d == 0 || length_times_d.signum() == -signs[SUM]
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

/// True if a sum can have its sign: sums of two numbers of one sign have it too, and 0 changes nothing.
fn is_sum(signs: &KnownSigns, numbers: &[usize; 3]) -> bool {
    let [left, right, sum] = numbers.map(|number| signs[number]);
    match left {
        0 => sum == right,
        _ => left * right < 0 || sum == left,
    }
}
