//! Which kernels of a table need no more rays: those that surely cost more than as many others as the table shows.
//!
//! A kernel's least cost is that of its best epsilons on the rays that chose them, which flatters it. The others' costs are
//! those on fresh rays, which flatter nobody. A kernel is out if enough others are cheaper by [`DEVIATIONS`] standard deviations of
//! the difference. So a kernel that belongs on the screen is taken out only if one of these comparisons is wrong: of
//! equal costs 1 in 30,000 is, as far as sums of many rays follow the normal distribution.

use super::joint::{Costs, NEGLIGIBLE};
use super::measure::{Attempt, count_at};
use super::prepared::Store;
use super::rays::RayCount;
use super::study::cheapest;
use super::trials::{Pass, Setting};
use crate::audit::Trials;
use crate::kernel::Scalar;

/// More than the three that say which of two forms is worth saying: a table compares hundreds of pairs.
const DEVIATIONS: f64 = 4.0;

/// A cost, and the variance that it has because rays are a sample.
#[derive(Clone, Copy, Debug)]
pub struct CostSeen {
    /// The sum of the shares of wrong answers, each times its cost.
    pub cost: f64,
    /// Its variance.
    pub variance: f64,
}

/// The costs of a kernel in a round.
#[derive(Clone, Copy, Debug)]
pub struct Contender {
    /// No epsilons cost less on the rays that chose them.
    pub least: CostSeen,
    /// The cost of the best epsilons on fresh rays.
    pub fresh: CostSeen,
}

impl CostSeen {
    /// From wrong answers by count. The variance has one more wrong answer of each kind: where none was seen, the next ray may
    /// show one.
    pub fn of(counts: &[RayCount], costs: &Costs, wrong: &[Trials]) -> CostSeen {
        let mut variance = 0.0;
        for (count, trials) in counts.iter().zip(wrong) {
            if trials.of == 0 {
                continue;
            }
            let of = trials.of as f64;
            let share = ((trials.count + 1) as f64 / of).min(0.5);
            variance += costs.of(count.kind).powi(2) * share * (1.0 - share) / of;
        }
        CostSeen {
            cost: costs.of_trials(counts, wrong),
            variance,
        }
    }

    /// True if it is below another one by more than chance explains.
    pub fn is_surely_below(&self, other: &CostSeen) -> bool {
        let deviation = (self.variance + other.variance).sqrt();
        self.cost + DEVIATIONS * deviation < other.cost
    }
}

impl Contender {
    /// The costs of a kernel on a pass.
    pub fn of<F: Scalar>(setting: &Setting<'_, F>, costs: &Costs, pass: Pass<'_>) -> Contender {
        let store = Store::default();
        let setting = Setting {
            store: Some(&store),
            ..*setting
        };
        let best = cheapest(&setting, costs, None, pass)
            .expect("without a limit of errors some point is the cheapest");
        let attempt = [Attempt::new(best)];
        let seen = |pass: Pass<'_>| {
            let wrong = count_at(&setting, &attempt, pass);
            CostSeen::of(setting.counts, costs, &wrong[0])
        };
        let chosen = seen(pass);
        // A point that is as good as the cheapest may cost so much more.
        let least = CostSeen {
            cost: chosen.cost / (1.0 + NEGLIGIBLE),
            ..chosen
        };
        Contender {
            least,
            fresh: seen(pass.fresh()),
        }
    }
}

/// For each contender, true if it surely costs more than so many others. Others of the same cost count once, since the
/// table puts them in one row.
pub fn surely_dearer(contenders: &[Contender], places: usize) -> Vec<bool> {
    let mut all = Vec::with_capacity(contenders.len());
    for one in contenders {
        let below = |other: &&Contender| other.fresh.is_surely_below(&one.least);
        let mut cheaper: Vec<f64> = contenders
            .iter()
            .filter(below)
            .map(|other| other.fresh.cost)
            .collect();
        cheaper.sort_by(f64::total_cmp);
        cheaper.dedup();
        all.push(places <= cheaper.len());
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::case::Draw;
    use crate::epsilon::{Rays, WrongKind};
    use crate::family::Stratum;

    const COUNTS: [RayCount; 2] = [
        RayCount {
            rays: Rays::Stratum(Stratum::Edges),
            kind: WrongKind::Crack,
        },
        RayCount {
            rays: Rays::Stratum(Stratum::Interior),
            kind: WrongKind::Miss,
        },
    ];

    fn seen(cracks: u64, misses: u64, of: u64) -> CostSeen {
        let wrong = [cracks, misses].map(|count| Trials::independent(count, of));
        CostSeen::of(&COUNTS, &Costs::default(), &wrong)
    }

    fn alike(cracks: u64, misses: u64, of: u64) -> Contender {
        let both = seen(cracks, misses, of);
        Contender {
            least: both,
            fresh: both,
        }
    }

    #[test]
    fn a_cost_is_surely_below_another_beyond_four_deviations() {
        // Misses cost 1 each: the variance of 101 of 10,000 is 1e-6, of the smoothed crack 100 times 1e-8.
        let one = seen(0, 100, 10_000);
        assert!((one.cost - 0.01).abs() < 1e-12);
        assert!((one.variance - 1.9998e-6).abs() < 1e-8, "{one:?}");
        let is_below = |misses| one.is_surely_below(&seen(0, misses, 10_000));
        let found = [100, 187, 189, 300].map(is_below);
        assert_eq!(found, [false, false, true, true]);
        // As few rays show nothing.
        assert!(!seen(0, 1, 100).is_surely_below(&seen(0, 9, 100)));
    }

    #[test]
    fn a_contender_is_out_if_as_many_rows_are_cheaper() {
        let rows = [
            alike(0, 100, 10_000),
            alike(0, 100, 10_000),
            alike(0, 101, 10_000),
            alike(0, 500, 10_000),
            alike(0, 510, 10_000),
            alike(9_000, 0, 10_000),
        ];
        // The first two are one row.
        let out = |places| surely_dearer(&rows, places);
        assert_eq!(out(1), [false, false, false, true, true, true]);
        assert_eq!(out(2), [false, false, false, true, true, true]);
        assert_eq!(out(3), [false, false, false, false, false, true]);
        assert_eq!(out(5), [false; 6]);
    }

    /// Draws costs of equal kernels, for which every comparison that comes out is wrong, by the binomial's definition.
    #[test]
    fn equal_costs_are_hardly_ever_told_apart() {
        let mut wrong = 0;
        for run in 0..3_000 {
            let mut draw = Draw::new("race", 1, run);
            let mut sample = || {
                let misses = (0..400).filter(|_| draw.below(10) == 0).count();
                seen(0, misses as u64, 400)
            };
            wrong += u32::from(sample().is_surely_below(&sample()));
        }
        assert!(wrong <= 2, "{wrong}");
    }
}
