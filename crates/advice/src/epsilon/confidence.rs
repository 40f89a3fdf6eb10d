//! Binomial probabilities: what a number of trials shows, with a confidence.

use libm::{exp, lgamma, log, log1p};

/// How sure a limit is.
pub const CONFIDENCE: f64 = 0.95;

/// The share of wrong answers at a limit, as one in how many, where the trials can show it.
pub const ONE_IN: u64 = 10_000;

/// The most margins that are kept of each count of wrong answers (one kind on one kind of rays). They are enough for `ONE_IN` of nine million trials; of more the
/// share is smaller.
pub const KEPT: usize = 1024;

/// The ranks of two margins among n trials, between which the quantile of a share lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Ranks {
    /// The share, as one in how many.
    pub one_in: u64,
    /// The last rank before which lies at most the share of all margins, with confidence.
    pub safe: u64,
    /// The first rank before which lies at least the share of all margins, with confidence.
    pub far: u64,
}

/// The ranks for n trials. The share is one in `ONE_IN`, whatever n is, so that the ranks rise with n; of fewer trials
/// than show it the smallest round share that they can show; of so many that ranks pass `KEPT` the largest round share
/// below. None of fewer than 29 trials, which cannot even show one in ten.
pub fn ranks(n: u64) -> Option<Ranks> {
    let rounds = || (1..=18).flat_map(|k| [1u64, 2, 5].map(|d| d * 10u64.pow(k)));
    let rarer = || {
        rounds()
            .skip_while(|round| *round <= ONE_IN)
            .find_map(|it| ranks_at(n, it))
    };
    let shown = || rounds().take_while(|round| *round < ONE_IN);
    ranks_at(n, ONE_IN)
        .or_else(|| {
            if n < KEPT as u64 * ONE_IN / 4 {
                None
            } else {
                rarer()
            }
        })
        .or_else(|| shown().filter_map(|round| ranks_at(n, round)).last())
}

/// The ranks for one share, if n trials show it and `KEPT` margins are enough.
fn ranks_at(n: u64, one_in: u64) -> Option<Ranks> {
    let mut fewer = 0.0;
    let mut safe = None;
    for k in 1..=KEPT as u64 {
        fewer += exactly(k - 1, n, one_in);
        let at_least = 1.0 - fewer;
        if CONFIDENCE <= at_least {
            safe = Some(k);
        }
        if at_least <= 1.0 - CONFIDENCE {
            return safe.map(|safe| Ranks {
                one_in,
                safe,
                far: k,
            });
        }
    }
    None
}

/// How many margins of each count may decide among at most n trials.
pub fn kept(n: u64) -> usize {
    // Of fewer trials than show the share, and a larger share, the ranks are at most 16.
    ranks(n)
        .map_or(0, |ranks| ranks.far as usize)
        .clamp(64, KEPT)
}

/// True if `found` among n trials show that the share of all trials is at most one in `one_in`.
pub fn is_shown(found: u64, n: u64, one_in: u64) -> bool {
    // Above the share itself nothing is shown; the sum is long.
    found * one_in <= n && CONFIDENCE <= at_least(found + 1, n, one_in)
}

/// The probability that at least k of n trials succeed if one in so many does.
fn at_least(k: u64, n: u64, one_in: u64) -> f64 {
    1.0 - (0..k).map(|i| exactly(i, n, one_in)).sum::<f64>()
}

/// The probability that i of n trials succeed if one in so many does.
fn exactly(i: u64, n: u64, one_in: u64) -> f64 {
    let (i, n, p) = (i as f64, n as f64, 1.0 / one_in as f64);
    let ways = lgamma(n + 1.0) - lgamma(i + 1.0) - lgamma(n - i + 1.0);
    // No way where i is above n: lgamma is infinite at 0 and below.
    exp(ways + i * log(p) + (n - i) * log1p(-p))
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
                    assert!(
                        (found - exact).abs() < 1e-12,
                        "{k} of {n}, {one_in}: {found} {exact}"
                    );
                }
            }
        }
        for n in [29, 58, 59, 100, 149, 150] {
            for found in 0..4 {
                for one_in in [10, 20, 50] {
                    let exact = exactly_at_least(found + 1, n, one_in);
                    let shown = is_shown(found, n, one_in);
                    assert_eq!(
                        shown,
                        CONFIDENCE <= exact,
                        "{found} of {n}, {one_in}: {exact}"
                    );
                }
            }
        }
    }

    #[test]
    fn ranks_are_the_last_and_the_first_that_show_the_smallest_round_share() {
        for n in [29, 58, 59, 100, 149, 299, 473, 1000, 2995] {
            let Ranks { one_in, safe, far } = ranks(n).unwrap();
            assert!(CONFIDENCE <= at_least(safe, n, one_in), "{n}");
            assert!(at_least(safe + 1, n, one_in) < CONFIDENCE, "{n}");
            assert!(at_least(far, n, one_in) <= 1.0 - CONFIDENCE, "{n}");
            assert!(1.0 - CONFIDENCE < at_least(far - 1, n, one_in), "{n}");
            assert!(far < 16, "{n}: {far}");
            let rounds = [10, 20, 50, 100, 200, 500, 1000, 2000];
            let next = rounds.into_iter().find(|round| one_in < *round).unwrap();
            assert!(
                rounds.contains(&one_in) && at_least(1, n, next) < CONFIDENCE,
                "{n}"
            );
        }
    }

    #[test]
    fn more_trials_keep_the_share_and_raise_the_ranks() {
        let of = |n: u64| ranks(n).map(|Ranks { one_in, safe, far }| [one_in, safe, far]);
        assert_eq!(of(40_000), Some([10_000, 1, 9]));
        assert_eq!(of(200_000), Some([10_000, 13, 29]));
        assert_eq!(of(1_500_000), Some([10_000, 130, 171]));
        let mut before = 0;
        for n in (30_000..9_000_000).step_by(123_456) {
            let Ranks { one_in, safe, far } = ranks(n).unwrap();
            assert!(
                one_in == ONE_IN && before <= safe && far as usize <= kept(n),
                "{n}"
            );
            before = safe;
        }
        // Where more are not kept, the share falls, and the limit is still no extreme.
        for n in [20_000_000, 10_u64.pow(9), 10_u64.pow(12)] {
            let Ranks { one_in, safe, far } = ranks(n).unwrap();
            assert!(
                ONE_IN < one_in && 100 < safe && far as usize <= KEPT,
                "{n}: {one_in} {safe}"
            );
        }
    }

    #[test]
    fn ranks_are_those_of_the_tables() {
        // 1 - 0.99^299 = 0.9505 and 1 - 0.99^298 = 0.9500 (Wilks: 299 for one in a hundred).
        let safe = |n: u64| ranks(n).map(|ranks| (ranks.safe, ranks.one_in));
        assert_eq!(safe(28), None);
        assert_eq!(safe(29), Some((1, 10)));
        assert_eq!(safe(298).unwrap().1, 50);
        assert_eq!(safe(299).unwrap(), (1, 100));
        assert_eq!(safe(29_956).unwrap(), (1, 10_000));
        assert_eq!(safe(29_955).unwrap().1, 5_000);
        // Nonparametric tolerance limits: the second smallest needs 473 for one in a hundred.
        assert!(CONFIDENCE <= at_least(2, 473, 100) && at_least(2, 472, 100) < CONFIDENCE);
        assert!(is_shown(0, 299, 100) && !is_shown(0, 298, 100) && !is_shown(0, 0, 100));
        assert!(is_shown(1, 473, 100) && !is_shown(1, 472, 100) && !is_shown(5, 400, 100));
    }
}
