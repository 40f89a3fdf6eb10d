//! Sums over sources. A random sample has an interval; stored cases, and all cases of a finite family,
//! are the whole of what they are: they have counts, and are never added to a sample.

use hairline_record::Rate;
use hairline_record::interval_of;
use std::fmt;

/// A sum over the sources that are random samples, and one over the others.
#[derive(Clone, Debug)]
pub(super) struct Pool {
    sample: Rate,
    complete: Rate,
}

impl Pool {
    /// The sums of rates. A rate without an interval is of a complete set.
    pub(super) fn of<'a>(rates: impl Iterator<Item = &'a Rate>) -> Pool {
        let (sample, complete): (Vec<_>, Vec<_>) = rates.partition(|rate| rate.interval.is_some());
        Pool {
            sample: Rate::sum(sample),
            complete: Rate::sum(complete),
        }
    }

    /// The rate over the samples; where there is none, over the complete sets.
    pub(super) fn rate(&self) -> &Rate {
        if self.sample.of == 0 {
            &self.complete
        } else {
            &self.sample
        }
    }

    /// The counts over both, without an interval.
    pub(super) fn counts(&self) -> [u64; 2] {
        [
            self.sample.count + self.complete.count,
            self.sample.of + self.complete.of,
        ]
    }
}

/// `1,597 of 10,092 (15.8% [15.1, 16.6]); stored cases 3 of 57`.
impl fmt::Display for Pool {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", counted(self.rate()))?;
        match 0 < self.sample.of && 0 < self.complete.of {
            true => write!(f, "; stored cases {}", counted(&self.complete)),
            false => Ok(()),
        }
    }
}

/// A count of a number, with its interval if it has one.
pub(super) fn counted(rate: &Rate) -> String {
    format!("{}{}", rate.counts(), interval_of(rate))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::audit::Trials;

    fn rate(count: u64, of: u64, sample: bool) -> Rate {
        Rate::new(Trials::independent(count, of), sample)
    }

    #[test]
    fn stored_cases_stay_out_of_a_samples_interval() {
        let [sample, stored] = [rate(10, 500, true), rate(3, 57, false)];
        let pool = Pool::of([&sample, &stored].into_iter());
        assert_eq!((pool.rate().count, pool.rate().of), (10, 500));
        assert_eq!(pool.rate().interval, sample.interval);
        assert!(
            pool.to_string().ends_with("%]); stored cases 3 of 57"),
            "{pool}"
        );
        assert_eq!(pool.counts(), [13, 557]);
        let pool = Pool::of(std::iter::once(&stored));
        assert_eq!((pool.rate().count, pool.rate().of), (3, 57));
        assert!(pool.rate().interval.is_none());
        assert_eq!(pool.to_string(), "3 of 57");
        // A sample without a trial has no interval either, and counts for nothing.
        let none = rate(0, 0, true);
        assert_eq!(Pool::of(std::iter::once(&none)).counts(), [0, 0]);
    }

    #[test]
    fn triangles_of_one_ray_stay_together_in_a_sum() {
        let mut trials = Trials::default();
        (0..40).for_each(|ray| trials.add_ray(if ray < 4 { 3 } else { 0 }, 3));
        let rate = Rate::new(trials, true);
        let pool = Pool::of([&rate, &rate].into_iter());
        let mut twice = trials;
        twice.merge(&trials);
        assert_eq!(pool.rate().rays, Some(twice.products));
        // As wide as that of 8 of 80 rays, not that of 24 of 240 triangles.
        let width = |[low, high]: [f64; 2]| high - low;
        let of = |count, of| width(self::rate(count, of, true).interval.unwrap());
        assert!((width(pool.rate().interval.unwrap()) - of(8, 80)).abs() < 1e-12);
        assert!(1.5 * of(24, 240) < of(8, 80));
    }
}
