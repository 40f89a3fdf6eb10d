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
        // No way where i is above n: lgamma is infinite at 0 and below.
        exp(ways + i * log(p) + (n - i) * log1p(-p))
    };
    1.0 - (0..k).map(fewer).sum::<f64>()
}

#[cfg(test)]
mod tests {
    use super::*;
    use num_bigint::BigInt;
    use num_rational::BigRational;
    use num_traits::ToPrimitive;

    /// The probability by its definition, in rational numbers.
    fn exactly_at_least(k: u64, n: u64, one_in: u64) -> f64 {
        let p = BigRational::new(1.into(), one_in.into());
        let q = BigRational::from_integer(1.into()) - &p;
        let mut ways = BigRational::from_integer(1.into());
        let mut sum = BigRational::from_integer(0.into());
        for i in 0..=n {
            if k <= i {
                sum += &ways * p.pow(i as i32) * q.pow((n - i) as i32);
            }
            ways *= BigRational::new(BigInt::from(n - i), BigInt::from(i + 1));
        }
        sum.to_f64().unwrap()
    }

    #[test]
    fn probabilities_are_those_of_rational_numbers() {
        for n in [0, 1, 2, 5, 17, 40] {
            for one_in in [2, 3, 10, 50] {
                for k in 0..=n + 2 {
                    let (found, exact) = (at_least(k, n, one_in), exactly_at_least(k, n, one_in));
                    assert!((found - exact).abs() < 1e-12, "{k} of {n}, {one_in}: {found} {exact}");
                }
            }
        }
        for n in [29, 58, 59, 100, 149, 150] {
            for found in 0..4 {
                for one_in in [10, 20, 50] {
                    let exact = exactly_at_least(found + 1, n, one_in);
                    let shown = is_shown(found, n, one_in);
                    assert_eq!(shown, CONFIDENCE <= exact, "{found} of {n}, {one_in}: {exact}");
                }
            }
        }
    }

    #[test]
    fn a_rank_is_the_last_that_shows_the_smallest_round_share() {
        for n in [29, 58, 59, 100, 149, 299, 473, 1000, 2995] {
            let (k, one_in) = rank(n).unwrap();
            assert!(CONFIDENCE <= at_least(k, n, one_in), "{n}");
            assert!(at_least(k + 1, n, one_in) < CONFIDENCE, "{n}");
            let rounds = [10, 20, 50, 100, 200, 500, 1000, 2000];
            let next = rounds.into_iter().find(|round| one_in < *round).unwrap();
            assert!(rounds.contains(&one_in) && at_least(1, n, next) < CONFIDENCE, "{n}");
        }
        // As many as are kept, and no more.
        assert_eq!(rank(u64::MAX >> 11), Some((KEPT as u64, 5_000_000_000_000)));
    }

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
