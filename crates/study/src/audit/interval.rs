//! Confidence intervals of rates.

use libm::{exp, expm1, fabs, lgamma, log, log1p};

/// A two-sided interval of a rate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    /// The lower end.
    pub low: f64,
    /// The upper end.
    pub high: f64,
}

/// The interval of Clopper and Pearson (1934) for k successes of n trials, with this share left out at
/// each end: it covers the true rate at least that often. Without a trial it is [0, 1].
///
/// Its ends are the quantiles of Beta(k, n-k+1) at `tail` and of Beta(k+1, n-k) at 1 - `tail`, which k
/// and n need not be whole for.
pub fn clopper_pearson(k: f64, n: f64, tail: f64) -> Interval {
    // With no success (or no failure) the beta distribution has a closed form.
    let all_of_one_kind = -expm1(log(tail) / n);
    let low = if k <= 0.0 {
        0.0
    } else if n <= k {
        1.0 - all_of_one_kind
    } else {
        beta_quantile(k, n - k + 1.0, tail)
    };
    let high = if n <= k {
        1.0
    } else if k <= 0.0 {
        all_of_one_kind
    } else {
        beta_quantile(k + 1.0, n - k, 1.0 - tail)
    };
    Interval { low, high }
}

/// The x at which the regularised incomplete beta function of (a, b) is p: Newton's method, held in
/// a shrinking bracket.
fn beta_quantile(a: f64, b: f64, p: f64) -> f64 {
    let log_beta = lgamma(a) + lgamma(b) - lgamma(a + b);
    let (mut low, mut high) = (0.0, 1.0);
    let mut x = a / (a + b);
    for _ in 0..200 {
        let excess = incomplete_beta(a, b, x, log_beta) - p;
        if excess > 0.0 {
            high = x
        } else {
            low = x
        }
        let density = exp((a - 1.0) * log(x) + (b - 1.0) * log1p(-x) - log_beta);
        let newton = x - excess / density;
        let next = if newton > low && newton < high {
            newton
        } else {
            0.5 * (low + high)
        };
        if fabs(next - x) <= 1e-14 * x {
            return next;
        }
        x = next;
    }
    x
}

/// The regularised incomplete beta function, by its continued fraction (Abramowitz and Stegun
/// 26.5.8) evaluated from the front by Lentz's method.
fn incomplete_beta(a: f64, b: f64, x: f64, log_beta: f64) -> f64 {
    let front = exp(a * log(x) + b * log1p(-x) - log_beta);
    if x < (a + 1.0) / (a + b + 2.0) {
        front * continued_fraction(a, b, x) / a
    } else {
        1.0 - front * continued_fraction(b, a, 1.0 - x) / b
    }
}

fn continued_fraction(a: f64, b: f64, x: f64) -> f64 {
    const TINY: f64 = 1e-300;
    let away_from_zero = |v: f64| if fabs(v) < TINY { TINY } else { v };
    let mut c = 1.0;
    let mut d = 1.0 / away_from_zero(1.0 - (a + b) * x / (a + 1.0));
    let mut value = d;
    // It converges in about the square root of max(a, b) steps.
    for m in 1..1_000_000 {
        let m = f64::from(m);
        let even = m * (b - m) * x / ((a + 2.0 * m - 1.0) * (a + 2.0 * m));
        let odd = -(a + m) * (a + b + m) * x / ((a + 2.0 * m) * (a + 2.0 * m + 1.0));
        let mut change = 1.0;
        for term in [even, odd] {
            d = 1.0 / away_from_zero(1.0 + term * d);
            c = away_from_zero(1.0 + term / c);
            change = c * d;
            value *= change;
        }
        if fabs(change - 1.0) < 1e-15 {
            break;
        }
    }
    value
}

#[cfg(test)]
mod tests {
    use super::*;

    fn assert_near(interval: Interval, low: f64, high: f64) {
        assert!((interval.low - low).abs() < 5e-5, "{interval:?}");
        assert!((interval.high - high).abs() < 5e-5, "{interval:?}");
    }

    fn at_95(k: u64, n: u64) -> Interval {
        clopper_pearson(k as f64, n as f64, 0.025)
    }

    #[test]
    fn published_intervals_come_out() {
        // Closed forms: 0 of n ends at 1 - (α/2)^(1/n); n of n starts at (α/2)^(1/n).
        let tail = 0.025f64.powf(1.0 / 2175.0);
        assert_near(at_95(0, 2175), 0.0, 1.0 - tail);
        assert!(at_95(0, 2175).high < 1.7e-3);
        assert_near(at_95(2175, 2175), tail, 1.0);
        // Clopper and Pearson's table: 5 of 10 and 1 of 20.
        assert_near(at_95(5, 10), 0.18709, 0.81291);
        assert_near(at_95(1, 20), 0.00127, 0.24873);
        assert_near(at_95(0, 0), 0.0, 1.0);
        // Less left out is wider: 1 - (10^-5)^(1/100).
        assert_near(
            clopper_pearson(0.0, 100.0, 1e-5),
            0.0,
            1.0 - 1e-5f64.powf(0.01),
        );
        // Where n is large the normal approximation agrees to its own accuracy.
        for (k, n) in [(3_000_000u64, 10_000_000u64), (40_000_000, 100_000_000_000)] {
            let Interval { low, high } = at_95(k, n);
            let p = k as f64 / n as f64;
            let half = 1.959964 * (p * (1.0 - p) / n as f64).sqrt();
            assert!(
                ((p - low) / half - 1.0).abs() < 2e-3 && ((high - p) / half - 1.0).abs() < 2e-3
            );
        }
    }

    #[test]
    fn the_tails_of_the_binomial_agree_at_the_ends() {
        // P(X >= k | low) = P(X <= k | high) = 0.025, summed directly.
        let (k, n) = (3u64, 40u64);
        let Interval { low, high } = at_95(k, n);
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
