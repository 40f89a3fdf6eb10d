//! A study of a scene: the cheapest epsilons together, how far each may move, and what both do on fresh
//! rays.

use super::super::axis::largest;
use super::candidates::{around, grid};
use super::curves::{Curve, axes, curves};
use super::errors::{ErrorSums, MaxError, errors_of};
use super::joint::{Costs, Grid, Joint};
use super::knob::Knob;
use super::limits::{Limit, limits};
use super::proved::{Proved, proved};
use super::trials::{Count, Kind, Margins, Setting, Trial, accepts, is_unknown};
use crate::arith::Float;
use crate::audit::{Row, Trials};
use crate::case::Case;
use crate::engine::{Merge, Observer};
use crate::family::Stratum;
use crate::kernel::{Scalar, Verdict, verdicts_of};

/// A study's results.
pub struct SceneStudy<F> {
    /// By knob: the cheapest epsilons together.
    pub best: Vec<F>,
    /// Whether the errors of the hits that remain are as small as was wanted.
    pub is_accurate: bool,
    /// What epsilons do on fresh rays: the cheapest, and the named ones, without those that are equal to
    /// one before.
    pub tried: Vec<Tried<F>>,
    /// How far each knob may move, and how often that was wrong on fresh rays.
    pub limits: Vec<(Limit<F>, Trials)>,
    /// Values that are proved, and how often they were wrong on fresh rays: never, or a proof is.
    pub proved: Vec<(Proved<F>, Trials)>,
    /// By knob: what each value does on fresh rays while the others stay.
    pub curves: Vec<Curve<F>>,
    /// The cheapest epsilons that follow each case's size, if they are cheaper by a fifth, or if only they
    /// keep the errors as small as was wanted.
    pub relative: Option<Tried<F>>,
    /// How far such epsilons may move.
    pub relative_limits: Vec<Limit<F>>,
}

/// What epsilons do on fresh rays.
pub struct Tried<F> {
    /// What they are called.
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
    /// At a shared edge: the rays that hit both triangles, which cost nothing.
    pub doubles: Trials,
}

/// The seed of the fresh rays: the next one.
pub fn fresh_seed(seed: u64) -> u64 {
    seed.wrapping_add(1)
}

/// A scale-free form is worth saying if it leaves less than this share of the cost.
const WORTH_SAYING: f64 = 0.8;

/// Runs a study, which also weighs and tries epsilons with names. The error is a disagreement between
/// margins and the kernel's own run: a fault of this tool.
pub fn study_scene<F: Scalar>(
    setting: &Setting<'_, F>,
    costs: &Costs,
    max_error: Option<&MaxError>,
    named: &[(String, Vec<F>)],
    seed: u64,
    count: u64,
    observer: &dyn Observer,
) -> Result<SceneStudy<F>, String> {
    let (counts, fresh) = (setting.counts, fresh_seed(seed));
    let given: Vec<Vec<F>> = named.iter().map(|(_, epsilons)| epsilons.clone()).collect();
    let accurate = cheapest(setting, &given, costs, max_error, seed, count, observer);
    let is_accurate = accurate.is_some();
    let best = accurate.or_else(|| cheapest(setting, &given, costs, None, seed, count, observer));
    let best = best.expect("without a limit of errors some point is the cheapest");
    let found = limits(setting, &best, seed, count, observer);
    let mut vectors = vec![("recommended".to_owned(), best.clone())];
    for (name, epsilons) in named {
        if !vectors.iter().any(|(_, known)| known == epsilons) {
            vectors.push((name.clone(), epsilons.clone()));
        }
    }
    let plain = vectors.len();
    let mut attempts: Vec<Attempt<F>> =
        vectors.iter().map(|(_, epsilons)| Attempt::new(epsilons.clone())).collect();
    attempts.extend(found.iter().filter_map(|limit| Attempt::at_limit(limit, &best)));
    let proofs = proved(setting);
    let at_proved =
        |proved: &Proved<F>| Attempt::alone(proved.knob, proved.value, proved.is_lower, &best);
    attempts.extend(proofs.iter().map(at_proved));
    let plain_ones: Vec<Vec<F>> =
        attempts[..plain].iter().map(|attempt| attempt.epsilons.clone()).collect();
    let differs = differs(setting, &plain_ones);
    let run = measure(setting, &attempts, plain, max_error, fresh, count, observer, differs);
    let Wrong { trials: mut wrong, of_hits, fault } = run;
    fault.map_or(Ok(()), Err)?;
    let of_proofs = wrong.split_off(attempts.len() - proofs.len());
    let of_proof = |(proved, wrong): (Proved<F>, Vec<Trials>)| {
        let trials = wrong[proved.count];
        (proved, trials)
    };
    let proofs: Vec<_> = proofs.into_iter().zip(of_proofs).map(of_proof).collect();
    if let Some((proved, trials)) = proofs.iter().find(|(_, trials)| 0 < trials.count) {
        let value = proved.value.to_f64();
        return Err(format!(
            "{value:e} is proved to be never wrong, and was {} times",
            trials.count
        ));
    }
    let mut of_limits = wrong.split_off(plain).into_iter();
    let with_trials = |limit: Limit<F>| {
        let wrong = limit.value.and_then(|_| of_limits.next());
        let trials = wrong.map_or(Trials::default(), |wrong| wrong[limit.count]);
        (limit, trials)
    };
    let axes = axes(&vectors, &found, &proofs, setting.fine_curves);
    let curves = curves(setting, &best, &axes, fresh, count, observer);
    let found = found.into_iter().map(with_trials).collect();
    let tried = |(name, epsilons): (String, Vec<F>), wrong: Vec<Trials>, of_hits: OfHits| {
        let cost = costs.total(counts, wrong.iter().map(|trials| trials.share().unwrap_or(0.0)));
        let OfHits { errors, exceeded, doubles } = of_hits;
        Tried { name, epsilons, wrong, cost, errors, exceeded, doubles }
    };
    let of_vectors = vectors.into_iter().zip(wrong).zip(of_hits);
    let all: Vec<Tried<F>> =
        of_vectors.map(|((vector, wrong), of_hits)| tried(vector, wrong, of_hits)).collect();
    let relative = Setting { relative: true, ..*setting };
    let followed = cheapest(&relative, &[], costs, max_error, seed, count, observer);
    let (relative, relative_limits) = match followed {
        Some(followed) => {
            let found = limits(&relative, &followed, seed, count, observer);
            let attempt = [Attempt::new(followed.clone())];
            let no_run = |_: &[Case<F>], _: &[Margins<F>]| None;
            let mut sums =
                measure(&relative, &attempt, 1, max_error, fresh, count, observer, no_run);
            let vector = ("scale-free".to_owned(), followed);
            let relative = tried(vector, sums.trials.remove(0), sums.of_hits.remove(0));
            // Where no fixed values are accurate enough, a form that is needs no lower cost.
            let is_worth = |form: &Tried<F>| !is_accurate || form.cost < WORTH_SAYING * all[0].cost;
            (Some(relative).filter(is_worth), found)
        }
        None => (None, Vec::new()),
    };
    Ok(SceneStudy {
        best,
        is_accurate,
        tried: all,
        limits: found,
        proved: proofs,
        curves,
        relative,
        relative_limits,
    })
}

/// The epsilons of a row by knob, and the least t.
pub fn own_epsilons<F: Scalar>(row: &Row, knobs: &[Knob], least_t: F) -> Vec<F> {
    let epsilons = row.epsilons::<F>();
    let own = |knob: &Knob| match knob {
        Knob::Gate(gate) => epsilons[*gate],
        Knob::LeastT => least_t,
    };
    knobs.iter().map(own).collect()
}

/// The cheapest epsilons together, of the given ones and of round ones; none if at all of them too many of
/// the hits that remain have too large errors.
pub fn cheapest<F: Scalar>(
    setting: &Setting<'_, F>,
    given: &[Vec<F>],
    costs: &Costs,
    max_error: Option<&MaxError>,
    seed: u64,
    count: u64,
    observer: &dyn Observer,
) -> Option<Vec<F>> {
    let best = |grid: Grid<F>| {
        let joint = Joint::count(setting, grid, max_error, seed, count, observer);
        joint.best(setting.counts, costs)
    };
    let (grid, is_thin) = grid(setting, given, max_error, seed, count, observer);
    let found = best(grid)?;
    if is_thin { best(around(&found)) } else { Some(found) }
}

/// Epsilons to try, and on which trials: all, or those that are hits at other epsilons.
pub struct Attempt<F> {
    /// By knob.
    pub epsilons: Vec<F>,
    /// Only trials that are hits here count.
    pub among: Option<Vec<F>>,
}

impl<F: Float> Attempt<F> {
    /// On all trials.
    pub fn new(epsilons: Vec<F>) -> Attempt<F> {
        Attempt { epsilons, among: None }
    }

    /// A limit, where the other knobs stay; none if it has no value. What the others refuse is no loss
    /// of this one's.
    pub fn at_limit(limit: &Limit<F>, others: &[F]) -> Option<Attempt<F>> {
        Some(Attempt::alone(limit.knob, limit.value?, limit.is_lower, others))
    }

    fn alone(knob: usize, value: F, is_lower: bool, others: &[F]) -> Attempt<F> {
        let with = |value: F| {
            let mut epsilons = others.to_vec();
            epsilons[knob] = value;
            epsilons
        };
        let among = (!is_lower).then(|| with(-largest::<F>()));
        Attempt { epsilons: with(value), among }
    }
}

struct Wrong {
    /// By attempt, by count.
    trials: Vec<Vec<Trials>>,
    /// Of the first attempts.
    of_hits: Vec<OfHits>,
    /// A disagreement between margins and the kernel's run.
    fault: Option<String>,
}

/// The errors of the hits that remain, by count.
#[derive(Clone)]
struct OfHits {
    errors: Vec<ErrorSums>,
    /// Those with larger errors than is wanted.
    exceeded: Vec<Trials>,
    /// At a shared edge: the rays that hit both triangles.
    doubles: Trials,
}

impl Merge for OfHits {
    fn merge(&mut self, other: OfHits) {
        let errors = self.errors.iter_mut().flatten().zip(other.errors.iter().flatten());
        errors.for_each(|(sum, more)| sum.merge(more));
        let exceeded = self.exceeded.iter_mut().zip(&other.exceeded);
        exceeded.for_each(|(sum, more)| sum.merge(more));
        self.doubles.merge(&other.doubles);
    }
}

impl Merge for Wrong {
    fn merge(&mut self, other: Wrong) {
        let counts = self.trials.iter_mut().flatten().zip(other.trials.iter().flatten());
        counts.for_each(|(sum, more)| sum.merge(more));
        self.of_hits.iter_mut().zip(other.of_hits).for_each(|(sum, more)| sum.merge(more));
        self.fault = self.fault.take().or(other.fault);
    }
}

impl Wrong {
    /// Errors are kept of so many attempts.
    fn new(attempts: usize, with_errors: usize, counts: &[Count]) -> Wrong {
        let none = vec![Trials::default(); counts.len()];
        let errors = vec![ErrorSums::default(); counts.len()];
        let exceeded = none.clone();
        let of_hits = vec![OfHits { errors, exceeded, doubles: Trials::default() }; with_errors];
        Wrong { trials: vec![none; attempts], of_hits, fault: None }
    }

    fn add_errors<F: Scalar>(
        &mut self,
        setting: &Setting<'_, F>,
        attempts: &[Attempt<F>],
        max_error: Option<&MaxError>,
        trial: &Trial<'_, F>,
    ) {
        let Count { stratum, kind } = setting.counts[trial.count];
        if stratum == Stratum::Edges {
            for (attempt, sums) in attempts.iter().zip(&mut self.of_hits) {
                let hits = trial.margins.iter().filter(|m| accepts(m, &attempt.epsilons));
                sums.doubles.add_ray(u64::from(1 < hits.count()), 1);
            }
        }
        if kind != Kind::Miss {
            return;
        }
        let errors = errors_of(trial);
        let attempts = attempts.iter().zip(&mut self.of_hits);
        for (_, sums) in attempts.filter(|(attempt, _)| trial.is_hit(&attempt.epsilons)) {
            let pairs = sums.errors[trial.count].iter_mut().zip(errors);
            pairs.for_each(|(sum, error)| error.into_iter().for_each(|error| sum.add(error)));
            if let Some(max) = max_error {
                sums.exceeded[trial.count].add_ray(u64::from(max.is_exceeded(&errors)), 1);
            }
        }
    }

    fn add<F: Scalar>(&mut self, counts: &[Count], attempts: &[Attempt<F>], trial: &Trial<'_, F>) {
        let if_refused = counts[trial.count].kind.is_wrong_if_refused();
        for (trials, Attempt { epsilons, among }) in self.trials.iter_mut().zip(attempts) {
            if among.as_ref().is_some_and(|among| !trial.is_hit(among)) {
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
    seed: u64,
    count: u64,
    observer: &dyn Observer,
) -> Vec<Vec<Trials>> {
    measure(setting, attempts, 0, None, seed, count, observer, |_, _| None).trials
}

/// The same, and the errors of the hits of the first attempts; a check may find a fault in a chunk.
#[expect(clippy::too_many_arguments)]
fn measure<F: Scalar>(
    setting: &Setting<'_, F>,
    attempts: &[Attempt<F>],
    with_errors: usize,
    max_error: Option<&MaxError>,
    seed: u64,
    count: u64,
    observer: &dyn Observer,
    check: impl Fn(&[Case<F>], &[Margins<F>]) -> Option<String> + Sync,
) -> Wrong {
    let empty = || Wrong::new(attempts.len(), with_errors, setting.counts);
    let add = |sums: &mut Wrong, trial: Trial<'_, F>| {
        sums.add(setting.counts, attempts, &trial);
        if 0 < with_errors {
            sums.add_errors(setting, attempts, max_error, &trial);
        }
    };
    let look = |sums: &mut Wrong, cases: &[Case<F>], margins: &[Margins<F>]| {
        sums.fault = sums.fault.take().or_else(|| check(cases, margins));
    };
    setting.sum_with(seed, count, observer, empty, add, look)
}

/// Runs the kernel at some epsilons on a chunk's cases; a fault if it does not do as their margins say.
fn differs<F: Scalar>(
    setting: &Setting<'_, F>,
    at: &[Vec<F>],
) -> impl Fn(&[Case<F>], &[Margins<F>]) -> Option<String> + Sync {
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
        all.iter().find_map(|(at, epsilons, least_t)| {
            let mut verdicts = vec![Verdict::miss(None); cases.len()];
            verdicts_of(subject, cases, epsilons, &mut verdicts);
            let is_hit =
                |verdict: &Verdict<F>| verdict.hit && (!has_least_t || *least_t <= verdict.t);
            let known = cases.iter().zip(margins).zip(&verdicts);
            let pairs = known.filter(|((_, margins), _)| !is_unknown(margins));
            let mut faults =
                pairs.filter(|((_, margins), verdict)| is_hit(verdict) != accepts(margins, at));
            let ((case, _), verdict) = faults.next()?;
            let gates = setting.row.entry.info.gates;
            let at = setting.knobs.iter().zip(at);
            let at = at.map(|(knob, value)| format!("{}={value:e}", knob.name(gates)));
            let (together, alone) =
                if verdict.hit { ("hits", "misses") } else { ("misses", "hits") };
            Some(format!(
                "at {} it {together}, but with each of these alone it {alone}, on {}",
                at.collect::<Vec<_>>().join(","),
                case.hex()
            ))
        })
    }
}
