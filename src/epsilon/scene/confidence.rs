//! What so many trials show, with a confidence: binomial probabilities.

use libm::{exp, lgamma, log, log1p};

/// How sure a limit is.
pub const CONFIDENCE: f64 = 0.95;

/// The most margins that are kept of each count: the k-th is the limit, and k is far smaller.
pub const KEPT: usize = 64;

/// For n trials, the smallest round share that they can show with confidence, as one in how many, and the
/// rank of the margin that shows it. None of fewer than 29 trials, which cannot even show one in ten.
pub fn rank(n: u64) -> Option<(u64, u64)> {
    let round = (1..=12).flat_map(|k| [1u64, 2, 5].map(|d| d * 10u64.pow(k)));
    let shown = |one_in: u64| {
        let most = (1..=KEPT as u64).take_while(|k| CONFIDENCE <= at_least(*k, n, one_in)).last();
        Some((most?, one_in))
    };
    round.map_while(shown).last()
}

/// Whether so many among n trials show that at most one in so many is.
pub fn is_shown(found: u64, n: u64, one_in: u64) -> bool {
    // Above the share itself nothing is shown; the sum is long.
    found * one_in <= n && CONFIDENCE <= at_least(found + 1, n, one_in)
}

/// The probability that at least k of n trials succeed if one in so many does.
fn at_least(k: u64, n: u64, one_in: u64) -> f64 {
    let (n, p) = (n as f64, 1.0 / one_in as f64);
    let fewer = |i: u64| {
        let i = i as f64;
        let ways = lgamma(n + 1.0) - lgamma(i + 1.0) - lgamma(n - i + 1.0);
        if n < i { 0.0 } else { exp(ways + i * log(p) + (n - i) * log1p(-p)) }
    };
    1.0 - (0..k).map(fewer).sum::<f64>()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranks_are_those_of_the_tables() {
        // 1 - 0.99^299 = 0.9505 and 1 - 0.99^298 = 0.9500 (Wilks: 299 for one in a hundred).
        assert_eq!(rank(28), None);
        assert_eq!(rank(29), Some((1, 10)));
        assert_eq!(rank(298).unwrap().1, 50);
        assert_eq!(rank(299).unwrap(), (1, 100));
        assert_eq!(rank(29_956).unwrap(), (1, 10_000));
        assert_eq!(rank(29_955).unwrap().1, 5_000);
        // Nonparametric tolerance limits: the second smallest needs 473 for one in a hundred.
        assert!(CONFIDENCE <= at_least(2, 473, 100) && at_least(2, 472, 100) < CONFIDENCE);
        assert!(is_shown(0, 299, 100) && !is_shown(0, 298, 100) && !is_shown(0, 0, 100));
        assert!(is_shown(1, 473, 100) && !is_shown(1, 472, 100) && !is_shown(5, 400, 100));
        assert!(rank(10_u64.pow(12)).unwrap().1 >= 10_u64.pow(11));
    }
}
