//! How often something was found, with its interval: the ray is the unit of trial.

use super::interval::{Interval, clopper_pearson};
use serde::{Deserialize, Serialize};

/// Products of the findings k and the trials n of one ray, summed over the rays.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct RayProducts {
    /// Sum of k².
    pub count_squared: u64,
    /// Sum of k·n.
    pub count_times_of: u64,
    /// Sum of n².
    pub of_squared: u64,
}

impl RayProducts {
    /// The sums for rays with one trial each.
    pub fn of_single(count: u64, of: u64) -> RayProducts {
        RayProducts {
            count_squared: count,
            count_times_of: count,
            of_squared: of,
        }
    }

    /// Adds a ray with so many findings among so many trials.
    pub fn add_ray(&mut self, count: u64, of: u64) {
        self.merge(&RayProducts {
            count_squared: count * count,
            count_times_of: count * of,
            of_squared: of * of,
        });
    }

    /// Adds those of other rays.
    pub fn merge(&mut self, other: &RayProducts) {
        self.count_squared += other.count_squared;
        self.count_times_of += other.count_times_of;
        self.of_squared += other.of_squared;
    }
}

/// Findings among trials. The triangles of one ray tend to be wrong together, so that they are fewer
/// independent trials than they are triangles; the sums over the rays say how many fewer. A commutative
/// monoid.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Trials {
    /// How many findings.
    pub count: u64,
    /// Among how many trials.
    pub of: u64,
    /// The sums over the rays.
    pub products: RayProducts,
}

impl Trials {
    /// Each trial on a ray of its own.
    pub fn independent(count: u64, of: u64) -> Trials {
        Trials {
            count,
            of,
            products: RayProducts::of_single(count, of),
        }
    }

    /// Adds a ray with so many findings among so many trials.
    pub fn add_ray(&mut self, count: u64, of: u64) {
        self.count += count;
        self.of += of;
        self.products.add_ray(count, of);
    }

    /// Adds those of other rays.
    pub fn merge(&mut self, other: &Trials) {
        self.count += other.count;
        self.of += other.of;
        self.products.merge(&other.products);
    }

    /// Other counts on rays like these: as many findings on a ray that has any, as many trials on a ray.
    /// Where these trials have no finding, all trials of a ray count as ending alike.
    pub fn scaled(&self, count: u64, of: u64) -> Trials {
        let RayProducts {
            count_squared,
            count_times_of,
            of_squared,
        } = self.products;
        if self.of == 0 {
            return Trials::independent(count, of);
        }
        let by = |sum: u64, to: u64, from: u64| {
            let scaled = (u128::from(sum) * u128::from(to)).div_ceil(u128::from(from.max(1)));
            u64::try_from(scaled).unwrap_or(u64::MAX)
        };
        let of_findings = |sum: u64| match self.count {
            0 => by(of_squared, count, self.of),
            found => by(sum, count, found),
        };
        let products = RayProducts {
            count_squared: of_findings(count_squared),
            count_times_of: of_findings(count_times_of),
            of_squared: by(of_squared, of, self.of),
        };
        Trials {
            count,
            of,
            products,
        }
    }

    /// The share that findings have; none without a trial.
    pub fn share(&self) -> Option<f64> {
        (0 < self.of).then(|| self.count as f64 / self.of as f64)
    }

    /// The 95 % interval: 2.5 % is left out at each end.
    pub fn interval(&self) -> Interval {
        self.interval_at(0.025)
    }

    /// The interval with this share left out at each end: of Clopper and Pearson, with the findings and
    /// the trials divided by the design effect (Korn and Graubard 1998).
    pub fn interval_at(&self, tail: f64) -> Interval {
        self.interval_of_others(self.count, self.of, tail)
    }

    /// The same of other counts, with the design effect of these.
    pub fn interval_of_others(&self, count: u64, of: u64, tail: f64) -> Interval {
        let effect = self.design_effect();
        clopper_pearson(count.min(of) as f64 / effect, of as f64 / effect, tail)
    }

    /// By how much the variance of the share is above that of as many independent trials: of the ratio
    /// estimator, the sum over the rays of (k - p·n)², over that of the binomial, n·p·(1 - p). Exactly 1
    /// where each ray has one trial, and never less.
    ///
    /// Few findings do not tell how they cluster, and none tells nothing. So one more ray of the usual
    /// size is put beside those that were seen, all of whose trials end as fewer of the others do. Without
    /// a finding this is all that is known, and the effect is that of rays whose trials all end alike.
    fn design_effect(&self) -> f64 {
        let RayProducts {
            count_squared,
            count_times_of,
            of_squared,
        } = self.products;
        if of_squared == self.of || self.of == 0 {
            return 1.0;
        }
        let [k, n] = [self.count, self.of].map(|x| x as f64);
        let [kk, kn, nn] = [count_squared, count_times_of, of_squared].map(|x| x as f64);
        // The effect is the same for findings and for the rest: whichever is less.
        let (k, kk, kn) = if 2.0 * k <= n {
            (k, kk, kn)
        } else {
            (n - k, nn - 2.0 * kn + kk, nn - kn)
        };
        let ray = nn / n;
        let (k, n) = (k + ray, n + ray);
        let [kk, kn, nn] = [kk, kn, nn].map(|sum| sum + ray * ray);
        let p = k / n;
        let of_rays = kk - 2.0 * p * kn + p * p * nn;
        (of_rays / (k * (1.0 - p))).min(self.of as f64).max(1.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn trials(rays: impl IntoIterator<Item = (u64, u64)>) -> Trials {
        let mut trials = Trials::default();
        rays.into_iter()
            .for_each(|(count, of)| trials.add_ray(count, of));
        trials
    }

    #[track_caller]
    fn assert_same(a: Interval, b: Interval) {
        assert!(
            (a.low - b.low).abs() < 1e-12 && (a.high - b.high).abs() < 1e-12,
            "{a:?} {b:?}"
        );
    }

    #[test]
    fn two_triangles_that_end_alike_are_one_trial() {
        for (count, of) in [(0, 50), (1, 50), (7, 50), (30, 50), (49, 50), (50, 50)] {
            let rays = (0..of).map(|ray| if ray < count { (2, 2) } else { (0, 2) });
            let (pairs, single) = (trials(rays), Trials::independent(count, of));
            assert_eq!((pairs.count, pairs.of), (2 * count, 2 * of));
            assert_same(pairs.interval(), single.interval());
            assert_same(pairs.interval_at(1e-5), single.interval_at(1e-5));
        }
    }

    #[test]
    fn one_trial_a_ray_is_binomial_bit_for_bit() {
        for (count, of) in [(0, 0), (0, 9), (3, 40), (40, 40), (123, 4567)] {
            let rays = (0..of).map(|ray| (u64::from(ray < count), 1));
            assert_eq!(trials(rays), Trials::independent(count, of));
            let binomial = clopper_pearson(count as f64, of as f64, 0.025);
            assert_eq!(Trials::independent(count, of).interval(), binomial);
        }
    }

    #[test]
    fn the_design_effect_is_worked_out_by_hand() {
        // Two rays of 3 with 2 findings, eight with none: k = 4 of n = 30, and the sums are 8, 12, 90.
        let rays = trials((0..10).map(|ray| (if ray < 2 { 2 } else { 0 }, 3)));
        let products = RayProducts {
            count_squared: 8,
            count_times_of: 12,
            of_squared: 90,
        };
        assert_eq!(
            rays,
            Trials {
                count: 4,
                of: 30,
                products
            }
        );
        // With one more ray of 90/30 = 3, all wrong: 7 of 33, p = 7/33, and
        // (17 - 2·21·7/33 + 99·(7/33)²) / (7·26/33) = (17 - 294/33 + 147/33) / (182/33) = 414/182.
        assert!(
            (rays.design_effect() - 414.0 / 182.0).abs() < 1e-14,
            "{}",
            rays.design_effect()
        );
        // The rest clusters as the findings do.
        let rest = trials((0..10).map(|ray| (if ray < 2 { 1 } else { 3 }, 3)));
        assert!(
            (rest.design_effect() - 414.0 / 182.0).abs() < 1e-14,
            "{}",
            rest.design_effect()
        );
        // One finding a ray, as regularly as can be, is no reason for more trials than there are.
        assert_eq!(trials((0..1000).map(|_| (1, 2))).design_effect(), 1.0);
    }

    #[test]
    fn the_first_findings_do_not_seem_to_say_more_than_none() {
        // Lone findings on rays of 6. Estimated from them alone, the first would bring the upper end from
        // 0.0092 to 0.0023.
        let of_lone = |k| trials((0..400).map(|ray| (u64::from(ray < k), 6))).interval();
        for k in 0..40 {
            let (fewer, more) = (of_lone(k), of_lone(k + 1));
            assert!(0.95 * fewer.high <= more.high, "{k}: {fewer:?} {more:?}");
        }
    }

    #[test]
    fn rays_add_up_in_any_order() {
        let all: Vec<(u64, u64)> = (0..97).map(|i| (i * 7 % 4, 3 + i % 5)).collect();
        let whole = trials(all.iter().copied());
        for cut in [0, 1, 40, 97] {
            let (left, right) = all.split_at(cut);
            let [left, right] = [left, right].map(|rays| trials(rays.iter().rev().copied()));
            let (mut one, mut other) = (left, right);
            one.merge(&right);
            other.merge(&left);
            assert_eq!((one, other), (whole, whole));
        }
    }

    #[test]
    fn other_counts_on_such_rays_have_the_same_design_effect() {
        let rays = trials((0..300).map(|ray| (if ray % 10 == 0 { 4 } else { 0 }, 6)));
        assert_eq!(rays.scaled(rays.count, rays.of), rays);
        let twice = rays.scaled(2 * rays.count, 2 * rays.of);
        assert!((twice.design_effect() / rays.design_effect() - 1.0).abs() < 0.02);
        // All that is known without a finding: rays of 6, as if each were one trial.
        let none = trials((0..300).map(|_| (0, 6)));
        assert_same(
            none.scaled(60, 1800).interval(),
            Trials::independent(10, 300).interval(),
        );
        // Rays with one trial stay so, and nothing is known of nothing.
        assert_eq!(
            Trials::independent(0, 90).scaled(5, 70),
            Trials::independent(5, 70)
        );
        assert_eq!(Trials::default().scaled(5, 70), Trials::independent(5, 70));
    }

    #[test]
    fn sums_that_no_rays_have_do_no_harm() {
        // A record may be edited by hand.
        for products in [0, 1, u64::MAX].map(|x| RayProducts {
            count_squared: x,
            count_times_of: 0,
            of_squared: u64::MAX - x,
        }) {
            for (count, of) in [(0, 0), (5, 3), (1, 9), (9, 9)] {
                let Interval { low, high } = Trials {
                    count,
                    of,
                    products,
                }
                .interval();
                assert!(
                    0.0 <= low && low <= high && high <= 1.0,
                    "{count} of {of} {products:?}"
                );
            }
        }
    }
}
