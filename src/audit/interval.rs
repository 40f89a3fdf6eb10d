//! Confidence intervals of rates.

use statrs::distribution::{Beta, ContinuousCDF};

/// A two-sided interval of a rate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    /// The lower end.
    pub low: f64,
    /// The upper end.
    pub high: f64,
}

/// The 95 % interval of Clopper and Pearson (1934) for `successes` of `trials`: exact in the sense
/// that it covers the true rate at least that often. Without a trial it is [0, 1].
pub fn clopper_pearson(successes: u64, trials: u64) -> Interval {
    const TAIL: f64 = 0.025;
    let (k, n) = (successes as f64, trials as f64);
    let quantile =
        |a: f64, b: f64, p: f64| Beta::new(a, b).map_or(f64::NAN, |beta| beta.inverse_cdf(p));
    Interval {
        low: if successes == 0 { 0.0 } else { quantile(k, n - k + 1.0, TAIL) },
        high: if successes >= trials { 1.0 } else { quantile(k + 1.0, n - k, 1.0 - TAIL) },
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn assert_near(interval: Interval, low: f64, high: f64) {
        assert!((interval.low - low).abs() < 5e-5, "{interval:?}");
        assert!((interval.high - high).abs() < 5e-5, "{interval:?}");
    }

    #[test]
    fn published_intervals_come_out() {
        // Closed forms: 0 of n ends at 1 - (α/2)^(1/n); n of n starts at (α/2)^(1/n).
        let tail = 0.025f64.powf(1.0 / 2175.0);
        assert_near(clopper_pearson(0, 2175), 0.0, 1.0 - tail);
        assert!(clopper_pearson(0, 2175).high < 1.7e-3);
        assert_near(clopper_pearson(2175, 2175), tail, 1.0);
        // Clopper and Pearson's table: 5 of 10 and 1 of 20.
        assert_near(clopper_pearson(5, 10), 0.18709, 0.81291);
        assert_near(clopper_pearson(1, 20), 0.00127, 0.24873);
        assert_near(clopper_pearson(0, 0), 0.0, 1.0);
    }

    #[test]
    fn the_tails_of_the_binomial_agree_at_the_ends() {
        // P(X >= k | low) = P(X <= k | high) = 0.025, summed directly.
        let (k, n) = (3u64, 40u64);
        let Interval { low, high } = clopper_pearson(k, n);
        let term = |p: f64, j: u64| {
            let choose = (0..j).fold(1.0, |c, i| c * (n - i) as f64 / (i + 1) as f64);
            choose * p.powi(j as i32) * (1.0 - p).powi((n - j) as i32)
        };
        let at_most = |p: f64| (0..=k).map(|j| term(p, j)).sum::<f64>();
        let at_least = |p: f64| (k..=n).map(|j| term(p, j)).sum::<f64>();
        assert!((at_least(low) - 0.025).abs() < 1e-6);
        assert!((at_most(high) - 0.025).abs() < 1e-6);
    }
}
