//! Measures epsilons on some rays: wrong answers by their margins, the errors of the hits that remain, and
//! whether the kernel's own runs agree.

use super::errors::{ErrorSums, MaxError};
use super::knob::{Knob, KnobMargins};
use super::limits::{KnobLimit, alone, is_own};
use super::prepared::Prepared;
use super::proved::ProvedValue;
use super::rays::{RayCount, WrongKind};
use super::trials::{Pass, Setting, Trial, accepts, is_unknown};
use crate::arith::Float;
use crate::audit::Trials;
use crate::case::Case;
use crate::engine::{Merge, Observer};
use crate::kernel::{Scalar, Verdict, verdicts_of};

/// Epsilons to try, and on which trials.
pub struct Attempt<F> {
    /// By knob.
    pub epsilons: Vec<F>,
    /// If there is a knob, only those trials count whose loss is its own.
    pub of_knob: Option<usize>,
}

impl<F: Float> Attempt<F> {
    /// On all trials.
    pub fn new(epsilons: Vec<F>) -> Attempt<F> {
        Attempt {
            epsilons,
            of_knob: None,
        }
    }

    /// A limit, where the other knobs stay; none if it has no value.
    pub fn at_limit(limit: &KnobLimit<F>, others: &[F]) -> Option<Attempt<F>> {
        Some(Attempt::alone(
            limit.knob,
            limit.value?,
            limit.is_lower,
            others,
        ))
    }

    /// A proved value, where the other knobs stay.
    pub(super) fn at_proof(proof: &ProvedValue<F>, others: &[F]) -> Attempt<F> {
        Attempt::alone(proof.knob, proof.value, proof.is_lower, others)
    }

    fn alone(knob: usize, value: F, is_lower: bool, others: &[F]) -> Attempt<F> {
        let mut epsilons = others.to_vec();
        epsilons[knob] = value;
        Attempt {
            epsilons,
            of_knob: (!is_lower).then_some(knob),
        }
    }
}

/// The wrong answers at some attempts.
pub(super) struct WrongAnswers {
    /// By attempt, by count.
    pub trials: Vec<Vec<Trials>>,
    /// The errors of the hits that remain, for the first attempts.
    pub of_hits: Vec<OfHits>,
    /// The kernel's own runs.
    pub ran: Ran,
}

/// Runs of a kernel itself, beside its margins.
#[derive(Default)]
pub(super) struct Ran {
    /// A disagreement between margins and runs.
    pub fault: Option<String>,
    /// The nanoseconds that runs at the first epsilons took, by the kernel's own clock if it has one.
    pub nanoseconds: u64,
    /// How many rays they were.
    pub rays: u64,
}

impl Merge for Ran {
    fn merge(&mut self, other: Ran) {
        self.fault = self.fault.take().or(other.fault);
        self.nanoseconds += other.nanoseconds;
        self.rays += other.rays;
    }
}

/// The errors of the hits that remain, by count.
#[derive(Clone)]
pub(super) struct OfHits {
    pub errors: Vec<ErrorSums>,
    /// Those with larger errors than is wanted.
    pub exceeded: Vec<Trials>,
    /// Where cracks are counted: the rays that hit more than one triangle.
    pub doubles: Vec<Trials>,
}

impl Merge for OfHits {
    fn merge(&mut self, other: OfHits) {
        let errors = self
            .errors
            .iter_mut()
            .flatten()
            .zip(other.errors.iter().flatten());
        errors.for_each(|(sum, more)| sum.merge(more));
        let exceeded = self.exceeded.iter_mut().zip(&other.exceeded);
        exceeded.for_each(|(sum, more)| sum.merge(more));
        let doubles = self.doubles.iter_mut().zip(&other.doubles);
        doubles.for_each(|(sum, more)| sum.merge(more));
    }
}

impl Merge for WrongAnswers {
    fn merge(&mut self, other: WrongAnswers) {
        let counts = self
            .trials
            .iter_mut()
            .flatten()
            .zip(other.trials.iter().flatten());
        counts.for_each(|(sum, more)| sum.merge(more));
        self.of_hits
            .iter_mut()
            .zip(other.of_hits)
            .for_each(|(sum, more)| sum.merge(more));
        self.ran.merge(other.ran);
    }
}

impl WrongAnswers {
    /// Errors are kept of so many attempts.
    fn new(attempts: usize, with_errors: usize, counts: &[RayCount]) -> WrongAnswers {
        let none = vec![Trials::default(); counts.len()];
        let errors = vec![ErrorSums::default(); counts.len()];
        let (exceeded, doubles) = (none.clone(), none.clone());
        let of_hits = vec![
            OfHits {
                errors,
                exceeded,
                doubles
            };
            with_errors
        ];
        WrongAnswers {
            trials: vec![none; attempts],
            of_hits,
            ran: Ran::default(),
        }
    }

    fn add_errors<F: Scalar>(
        &mut self,
        setting: &Setting<'_, F>,
        attempts: &[Attempt<F>],
        max_error: Option<&MaxError>,
        trial: &Trial<'_, F>,
    ) {
        let kind = setting.counts[trial.count].kind;
        if kind == WrongKind::Crack {
            for (attempt, sums) in attempts.iter().zip(&mut self.of_hits) {
                let hits = trial.hits(&attempt.epsilons);
                sums.doubles[trial.count].add_ray(u64::from(1 < hits), 1);
            }
        }
        if kind != WrongKind::Miss {
            return;
        }
        let errors = trial.errors();
        let attempts = attempts.iter().zip(&mut self.of_hits);
        for (_, sums) in attempts.filter(|(attempt, _)| trial.is_hit(&attempt.epsilons)) {
            let pairs = sums.errors[trial.count].iter_mut().zip(errors);
            pairs.for_each(|(sum, error)| error.into_iter().for_each(|error| sum.add(error)));
            if let Some(max) = max_error {
                sums.exceeded[trial.count].add_ray(u64::from(max.is_exceeded(&errors)), 1);
            }
        }
    }

    fn add<F: Scalar>(
        &mut self,
        counts: &[RayCount],
        attempts: &[Attempt<F>],
        trial: &Trial<'_, F>,
    ) {
        let if_refused = counts[trial.count].kind.is_wrong_if_refused();
        for (trials, Attempt { epsilons, of_knob }) in self.trials.iter_mut().zip(attempts) {
            let is_others = |knob: usize| !is_own(trial, knob, alone(trial, knob, epsilons));
            if of_knob.is_some_and(is_others) {
                continue;
            }
            let is_wrong = trial.is_hit(epsilons) != if_refused;
            trials[trial.count].add_ray(u64::from(is_wrong), 1);
        }
    }
}

/// The wrong answers at some epsilons, by their margins: of each attempt, of each count.
pub fn count_at<F: Scalar>(
    setting: &Setting<'_, F>,
    attempts: &[Attempt<F>],
    pass: Pass<'_>,
) -> Vec<Vec<Trials>> {
    measure(setting, attempts, 0, None, pass, |_, _| Ran::default()).trials
}

/// The same, and the errors of the hits of the first attempts; a check may find a fault in a chunk.
pub(super) fn measure<F: Scalar>(
    setting: &Setting<'_, F>,
    attempts: &[Attempt<F>],
    with_errors: usize,
    max_error: Option<&MaxError>,
    pass: Pass<'_>,
    check: impl Fn(&Prepared<F>, &[KnobMargins<F>]) -> Ran + Sync,
) -> WrongAnswers {
    let empty = || WrongAnswers::new(attempts.len(), with_errors, setting.counts);
    let add = |sums: &mut WrongAnswers, trial: Trial<'_, F>| {
        sums.add(setting.counts, attempts, &trial);
        if 0 < with_errors {
            sums.add_errors(setting, attempts, max_error, &trial);
        }
    };
    let look = |sums: &mut WrongAnswers, part: &Prepared<F>, margins: &[KnobMargins<F>]| {
        sums.ran.merge(check(part, margins));
    };
    setting.sum_with(pass, empty, add, look)
}

/// Runs the kernel at some epsilons on a part's cases, also those around groups; a fault if it does not do as their margins
/// say.
pub(super) fn differs<F: Scalar>(
    setting: &Setting<'_, F>,
    at: &[Vec<F>],
    observer: &dyn Observer,
) -> impl Fn(&Prepared<F>, &[KnobMargins<F>]) -> Ran + Sync {
    let run = run_at(setting, at, observer);
    move |part, margins| {
        let cases = &part.made.chunk.cases;
        let (own, others) = margins.split_at(cases.len());
        let mut ran = run(cases, own);
        ran.merge(run(&part.other_cases(), others));
        ran
    }
}

/// Runs the kernel at some epsilons on cases.
fn run_at<F: Scalar>(
    setting: &Setting<'_, F>,
    at: &[Vec<F>],
    observer: &dyn Observer,
) -> impl Fn(&[Case<F>], &[KnobMargins<F>]) -> Ran + Sync {
    let with_least_t = |at: &Vec<F>| {
        let (mut epsilons, mut least_t) = (setting.row.epsilons::<F>(), -F::infinity());
        for (knob, epsilon) in setting.knobs.iter().zip(at) {
            match knob {
                Knob::Gate(gate) => epsilons[*gate] = *epsilon,
                Knob::LeastT => least_t = *epsilon,
            }
        }
        (at.clone(), epsilons, least_t)
    };
    let all: Vec<_> = at.iter().map(with_least_t).collect();
    let has_least_t = setting.knobs.contains(&Knob::LeastT);
    let subject = setting.subject;
    move |cases, margins| {
        let mut ran = Ran {
            rays: cases.len() as u64,
            ..Ran::default()
        };
        ran.fault = all
            .iter()
            .enumerate()
            .find_map(|(i, (at, epsilons, least_t))| {
                let mut verdicts = vec![Verdict::miss(None); cases.len()];
                let start = observer.now();
                let own = verdicts_of(subject, cases, epsilons, &mut verdicts);
                if i == 0 {
                    ran.nanoseconds = own.unwrap_or_else(|| observer.now() - start);
                }
                let is_hit =
                    |verdict: &Verdict<F>| verdict.hit && (!has_least_t || *least_t <= verdict.t);
                let known = cases.iter().zip(margins).zip(&verdicts);
                let pairs = known.filter(|((_, margins), _)| !is_unknown(margins));
                let mut faults =
                    pairs.filter(|((_, margins), verdict)| is_hit(verdict) != accepts(margins, at));
                let ((case, _), verdict) = faults.next()?;
                let gates = setting.row.entry.info.gates;
                let at = setting.knobs.iter().zip(at);
                let at = at.map(|(knob, value)| format!("{}={value:e}", knob.gate(gates).name));
                let (together, alone) = if is_hit(verdict) {
                    ("hits", "misses")
                } else {
                    ("misses", "hits")
                };
                Some(format!(
                    "at {} it {together}, but with each of these alone it {alone}, on {}",
                    at.collect::<Vec<_>>().join(","),
                    case.hex()
                ))
            });
        ran
    }
}

#[cfg(test)]
mod tests {
    use super::super::rays::Rays;
    use super::*;
    use crate::family::Stratum;

    #[test]
    fn what_other_knobs_refuse_does_not_count_for_a_limit() {
        // Of an edge and a least t: the triangle that is met, and its neighbour far beside it.
        let margins = [[0.5, 1.0, f64::INFINITY], [-0.3, 9.0, f64::INFINITY]];
        let trial = Trial {
            count: 0,
            guards: [true; 3],
            margins: &margins,
            around: 0,
            first: None,
        };
        let counts = [RayCount {
            rays: Rays::Stratum(Stratum::Edges),
            kind: WrongKind::Crack,
        }];
        let cracks = |least_t: f64, of_knob: Option<usize>| {
            let attempt = Attempt {
                epsilons: vec![0.6, least_t],
                of_knob,
            };
            let mut wrong = WrongAnswers::new(1, 0, &counts);
            wrong.add(&counts, &[attempt], &trial);
            (wrong.trials[0][0].count, wrong.trials[0][0].of)
        };
        assert_eq!(
            [None, Some(0), Some(1)].map(|of| cracks(0.0, of)),
            [(1, 1), (1, 1), (0, 0)]
        );
        assert_eq!([None, Some(0)].map(|of| cracks(2.0, of)), [(1, 1), (0, 0)]);
    }
}
