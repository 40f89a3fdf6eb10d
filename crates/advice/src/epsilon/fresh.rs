//! Epsilons and bounds on fresh rays: the wrong answers, what they cost, and which differences chance explains.

use super::errors::ErrorSums;
use super::joint::Costs;
use super::limits::KnobLimit;
use super::measure::OfHits;
use super::picture::HoleShare;
use super::proved::ProvedValue;
use super::rays::{RayCount, Rays, WrongKind};
use super::trials::Setting;
use crate::arith::Float;
use crate::audit::Trials;
use crate::family::Stratum;
use crate::kernel::{Role, Scalar};

/// A bound of one knob, and what its value does on fresh rays while the other knobs stay.
pub struct OnFresh<B> {
    /// The bound.
    pub bound: B,
    /// The wrong answers that it is about.
    pub wrong: Trials,
    /// The price of the value: the place of the count that the other side of the knob is for, and its wrong answers.
    pub price: Option<(usize, Trials)>,
}

/// The results of epsilons on fresh rays.
pub struct Tried<F> {
    /// The name of the epsilons.
    pub name: String,
    /// By knob.
    pub epsilons: Vec<F>,
    /// By count: the wrong answers.
    pub wrong: Vec<Trials>,
    /// The sum of their shares, each times its cost.
    pub cost: f64,
    /// By count: the errors of the hits that remain, where hits can be lost.
    pub errors: Vec<ErrorSums>,
    /// By count: of those hits the ones whose errors are larger than is wanted.
    pub exceeded: Vec<Trials>,
    /// By count: the rays at a shared edge or vertex that hit more than one triangle, which cost nothing.
    pub doubles: Vec<Trials>,
    /// The share of a picture's pixels that are holes at shared edges, where they are counted.
    pub holes: Option<HoleShare>,
}

impl<F> Tried<F> {
    /// The results of epsilons with a name; no picture yet.
    pub(super) fn new(
        (name, epsilons): (String, Vec<F>),
        wrong: Vec<Trials>,
        cost: f64,
        of_hits: OfHits,
    ) -> Tried<F> {
        Tried {
            name,
            epsilons,
            wrong,
            cost,
            errors: of_hits.errors,
            exceeded: of_hits.exceeded,
            doubles: of_hits.doubles,
            holes: None,
        }
    }

    /// The variance of the cost, as the rays are a sample.
    fn cost_variance(&self, counts: &[RayCount], costs: &Costs) -> f64 {
        let mut sum = 0.0;
        for (count, wrong) in counts.iter().zip(&self.wrong) {
            let Some(share) = wrong.share() else { continue };
            let variance = share * (1.0 - share) / wrong.of as f64;
            sum += costs.of(count.kind).powi(2) * variance;
        }
        sum
    }
}

/// Finds what bounds of knobs cost.
pub(super) struct Prices<'a, F: Scalar> {
    setting: &'a Setting<'a, F>,
    /// By count: all rays, those that other knobs refuse too.
    rays: Vec<u64>,
}

impl<F: Scalar> Prices<'_, F> {
    /// From trials of which no ray is left out.
    pub(super) fn new<'a>(setting: &'a Setting<'a, F>, all: &[Trials]) -> Prices<'a, F> {
        let rays = all.iter().map(|trials| trials.of).collect();
        Prices { setting, rays }
    }

    /// Proved values with their wrong answers, which are given by count.
    pub(super) fn of_proofs(
        &self,
        proofs: Vec<ProvedValue<F>>,
        wrong_answers: Vec<Vec<Trials>>,
    ) -> Vec<OnFresh<ProvedValue<F>>> {
        let mut found = Vec::with_capacity(proofs.len());
        for (bound, wrong) in proofs.into_iter().zip(wrong_answers) {
            found.push(OnFresh {
                wrong: wrong[bound.count],
                price: self.price(bound.knob, bound.is_lower, &wrong),
                bound,
            });
        }
        found
    }

    /// Limits with their wrong answers, which are given by count for each limit that has a value.
    pub(super) fn of_limits(
        &self,
        limits: Vec<KnobLimit<F>>,
        wrong_answers: Vec<Vec<Trials>>,
    ) -> Vec<OnFresh<KnobLimit<F>>> {
        let mut tried = wrong_answers.into_iter();
        let mut found = Vec::with_capacity(limits.len());
        for bound in limits {
            let wrong = bound.value.and_then(|_| tried.next());
            found.push(match wrong {
                Some(wrong) => OnFresh {
                    wrong: wrong[bound.count],
                    price: self.price(bound.knob, bound.is_lower, &wrong),
                    bound,
                },
                None => OnFresh {
                    bound,
                    wrong: Trials::default(),
                    price: None,
                },
            });
        }
        found
    }

    fn price(&self, knob: usize, is_lower: bool, wrong: &[Trials]) -> Option<(usize, Trials)> {
        let place = self.place(knob, is_lower)?;
        let trials = Trials::independent(wrong[place].count, self.rays[place]);
        Some((place, trials))
    }

    /// The place of the count that shows what a bound of a knob costs: hits lost where it must be large, hits beside
    /// triangles where an edge's must be negative.
    fn place(&self, knob: usize, is_lower: bool) -> Option<usize> {
        let gates = self.setting.row.entry.info.gates;
        let role = self.setting.knobs[knob].gate(gates).role;
        let (stratum, kind) = match (role, is_lower) {
            (Role::Parallel | Role::T, true) => (Stratum::Interior, WrongKind::Miss),
            (Role::Edge | Role::Other, false) => (Stratum::Outside, WrongKind::Hit),
            _ => return None,
        };
        let rays = Rays::Stratum(stratum);
        let shown = RayCount { rays, kind };
        let mut counts = self.setting.counts.iter();
        counts.position(|count| *count == shown)
    }
}

/// A fault of this tool: a value that is proved to be never wrong, and was.
pub(super) fn refuted<F: Float>(proofs: &[OnFresh<ProvedValue<F>>]) -> Option<String> {
    let OnFresh { bound, wrong, .. } = proofs.iter().find(|found| 0 < found.wrong.count)?;
    let value = bound.value.to_f64();
    let count = wrong.count;
    Some(format!(
        "{value:e} is proved to be never wrong, and was {count} times"
    ))
}

/// A scale-free form is worth saying if it leaves less than this share of the cost.
const WORTH_SAYING: f64 = 0.8;

/// True if a form is cheaper than fixed epsilons by enough, and by more than chance explains.
pub(super) fn is_worth_saying<F>(
    counts: &[RayCount],
    costs: &Costs,
    form: &Tried<F>,
    fixed: &Tried<F>,
) -> bool {
    form.cost < WORTH_SAYING * fixed.cost && is_beyond_chance(counts, costs, [form, fixed])
}

/// True if the costs of two epsilons differ by more than three standard deviations, as if they were of different rays:
/// they are of the same, so chance explains even less.
fn is_beyond_chance<F>(counts: &[RayCount], costs: &Costs, tried: [&Tried<F>; 2]) -> bool {
    let [one, other] = tried;
    let variance = one.cost_variance(counts, costs) + other.cost_variance(counts, costs);
    3.0 * variance.sqrt() < (one.cost - other.cost).abs()
}

#[cfg(test)]
mod tests {
    use super::*;

    const COUNTS: [RayCount; 3] = [
        RayCount {
            rays: Rays::Stratum(Stratum::Edges),
            kind: WrongKind::Crack,
        },
        RayCount {
            rays: Rays::Stratum(Stratum::Interior),
            kind: WrongKind::Miss,
        },
        RayCount {
            rays: Rays::Stratum(Stratum::Shadow),
            kind: WrongKind::SelfHit,
        },
    ];

    /// So many cracks of 10,000 rays and misses of 500; of self-hits there was no ray.
    fn tried(cracks: u64, misses: u64) -> Tried<f32> {
        let some = [
            Trials::independent(cracks, 10_000),
            Trials::independent(misses, 500),
        ];
        let wrong = [&some[..], &[Trials::default()]].concat();
        let cost = Costs::default().of_trials(&COUNTS, &wrong);
        assert_eq!(cost, 10.0 * (cracks as f64 / 1e4) + misses as f64 / 500.0);
        let (name, epsilons, errors) = (String::new(), vec![0.0f32], Vec::new());
        let (exceeded, doubles) = (Vec::new(), Vec::new());
        Tried {
            name,
            epsilons,
            wrong,
            cost,
            errors,
            exceeded,
            doubles,
            holes: None,
        }
    }

    #[test]
    fn a_few_wrong_answers_are_no_difference() {
        let is_beyond = |one: [u64; 2], other: [u64; 2]| {
            let [one, other] = [one, other].map(|[cracks, misses]| tried(cracks, misses));
            is_beyond_chance(&COUNTS, &Costs::default(), [&one, &other])
        };
        // Of nothing and of n: n is three standard deviations from nothing at 9.
        let from_nothing = [0, 1, 8, 10, 100].map(|cracks| is_beyond([0, 7], [cracks, 7]));
        assert_eq!(from_nothing, [false, false, false, false, true]);
        let alone = [0, 1, 8, 10, 100].map(|cracks| is_beyond([0, 0], [cracks, 0]));
        assert_eq!(alone, [false, false, false, true, true]);
        // Where half are wrong, the deviation of both is 71 of 10,000.
        let half = [5200, 5230].map(|cracks| is_beyond([5000, 0], [cracks, 0]));
        assert_eq!(half, [false, true]);
        // By their cost one makes up for the other.
        assert!(!is_beyond([100, 0], [0, 50]) && is_beyond([100, 0], [0, 0]));
    }

    #[test]
    fn a_form_is_worth_saying_if_it_saves_a_fifth_and_not_by_chance() {
        let is_worth = |form: u64, fixed: u64| {
            let [form, fixed] = [form, fixed].map(|cracks| tried(cracks, 0));
            is_worth_saying(&COUNTS, &Costs::default(), &form, &fixed)
        };
        assert_eq!(
            [790, 800, 850].map(|form| is_worth(form, 1000)),
            [true, false, false]
        );
        assert_eq!([1500, 1700].map(|form| is_worth(form, 2000)), [true, false]);
        assert_eq!([is_worth(0, 8), is_worth(0, 10)], [false, true]);
    }

    #[test]
    fn one_wrong_answer_refutes_a_proof() {
        let proof = |value: f64, wrong: u64| OnFresh {
            bound: ProvedValue {
                knob: 0,
                count: 0,
                is_lower: true,
                value,
            },
            wrong: Trials::independent(wrong, 9),
            price: None,
        };
        assert_eq!(refuted(&[proof(0.5, 0), proof(0.25, 0)]), None);
        let told = refuted(&[proof(0.5, 0), proof(0.25, 1)]).unwrap();
        assert_eq!(told, "2.5e-1 is proved to be never wrong, and was 1 times");
    }
}
