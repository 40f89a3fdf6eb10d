//! A study of a scene: the cheapest epsilons together, how far each may move, and what both do on fresh
//! rays.

use super::candidates::{around, grid};
use super::joint::{Costs, Joint};
use super::knob::Knob;
use super::limits::{Limit, limits};
use super::trials::{Count, Setting, Trial};
use crate::arith::Float;
use crate::audit::{Row, Trials};
use crate::engine::{Merge, Observer};
use crate::kernel::{Scalar, Verdict};

/// A study's results.
pub struct SceneStudy<F> {
    /// By knob: the cheapest epsilons together.
    pub best: Vec<F>,
    /// What epsilons do on fresh rays: the cheapest, and the named ones, without those that are equal to
    /// one before.
    pub tried: Vec<Tried<F>>,
    /// How far each knob may move, and how often that was wrong on fresh rays.
    pub limits: Vec<(Limit<F>, Trials)>,
    /// The same with epsilons that follow each case's size, if that is cheaper by a fifth.
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
    named: &[(String, Vec<F>)],
    seed: u64,
    count: u64,
    observer: &dyn Observer,
) -> Result<SceneStudy<F>, String> {
    let (counts, fresh) = (setting.counts, fresh_seed(seed));
    let given: Vec<Vec<F>> = named.iter().map(|(_, epsilons)| epsilons.clone()).collect();
    let best = cheapest(setting, &given, costs, seed, count, observer);
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
    let mut wrong = run_at(setting, &attempts, fresh, count, observer)?;
    let mut of_limits = wrong.split_off(plain).into_iter();
    let with_trials = |limit: Limit<F>| {
        let wrong = limit.value.and_then(|_| of_limits.next());
        let trials = wrong.map_or(Trials::default(), |wrong| wrong[limit.count]);
        (limit, trials)
    };
    let found = found.into_iter().map(with_trials).collect();
    let tried = |((name, epsilons), wrong): ((String, Vec<F>), Vec<Trials>)| {
        let cost = costs.total(counts, wrong.iter().map(|trials| trials.share().unwrap_or(0.0)));
        Tried { name, epsilons, wrong, cost }
    };
    let all: Vec<Tried<F>> = vectors.into_iter().zip(wrong).map(tried).collect();
    let relative = Setting { relative: true, ..*setting };
    let followed = cheapest(&relative, &[], costs, seed, count, observer);
    let relative_limits = limits(&relative, &followed, seed, count, observer);
    let attempt = [Attempt::new(followed.clone())];
    let wrong = count_at(&relative, &attempt, fresh, count, observer);
    let relative =
        wrong.into_iter().next().map(|wrong| tried((("scale-free".to_owned(), followed), wrong)));
    let relative = relative.filter(|relative| relative.cost < WORTH_SAYING * all[0].cost);
    Ok(SceneStudy { best, tried: all, limits: found, relative, relative_limits })
}

/// The epsilons of a row by knob; the least t is 0.
pub fn own_epsilons<F: Scalar>(row: &Row, knobs: &[Knob]) -> Vec<F> {
    let epsilons = row.epsilons::<F>();
    let own = |knob: &Knob| match knob {
        Knob::Gate(gate) => epsilons[*gate],
        Knob::LeastT => F::zero(),
    };
    knobs.iter().map(own).collect()
}

/// The cheapest epsilons together, of the given ones and of round ones.
pub fn cheapest<F: Scalar>(
    setting: &Setting<'_, F>,
    given: &[Vec<F>],
    costs: &Costs,
    seed: u64,
    count: u64,
    observer: &dyn Observer,
) -> Vec<F> {
    let (grid, is_thin) = grid(setting, given, seed, count, observer);
    let best = Joint::count(setting, grid, seed, count, observer).best(setting.counts, costs);
    if !is_thin {
        return best;
    }
    Joint::count(setting, around(&best), seed, count, observer).best(setting.counts, costs)
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
        let with = |value: F| {
            let mut epsilons = others.to_vec();
            epsilons[limit.knob] = value;
            epsilons
        };
        let among = (!limit.is_lower).then(|| with(F::infinity().offset_ulps(-1) * -F::one()));
        Some(Attempt { epsilons: with(limit.value?), among })
    }
}

struct Wrong(Vec<Vec<Trials>>, Option<String>);

impl Merge for Wrong {
    fn merge(&mut self, other: Wrong) {
        let counts = self.0.iter_mut().flatten().zip(other.0.iter().flatten());
        counts.for_each(|(sum, more)| sum.merge(more));
        self.1 = self.1.take().or(other.1);
    }
}

impl Wrong {
    fn new(vectors: usize, counts: &[Count]) -> Wrong {
        Wrong(vec![vec![Trials::default(); counts.len()]; vectors], None)
    }

    fn add<F: Scalar>(&mut self, counts: &[Count], attempts: &[Attempt<F>], trial: &Trial<'_, F>) {
        let if_refused = counts[trial.count].kind.is_wrong_if_refused();
        for (trials, Attempt { epsilons, among }) in self.0.iter_mut().zip(attempts) {
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
    let empty = || Wrong::new(attempts.len(), setting.counts);
    let add = |sums: &mut Wrong, trial: Trial<'_, F>| sums.add(setting.counts, attempts, &trial);
    setting.sum(seed, count, observer, empty, add).0
}

/// The same; the kernel also runs at the first epsilons, and must do as its margins say.
fn run_at<F: Scalar>(
    setting: &Setting<'_, F>,
    attempts: &[Attempt<F>],
    seed: u64,
    count: u64,
    observer: &dyn Observer,
) -> Result<Vec<Vec<Trials>>, String> {
    let kernel = F::subject(setting.row.entry).ok_or("the kernel does not run in this scalar")?;
    let mut epsilons = setting.row.epsilons::<F>();
    let mut least_t = None;
    for (knob, epsilon) in setting.knobs.iter().zip(&attempts[0].epsilons) {
        match knob {
            Knob::Gate(gate) => epsilons[*gate] = *epsilon,
            Knob::LeastT => least_t = Some(*epsilon),
        }
    }
    let is_hit = |trial: &Trial<'_, F>| {
        let mut verdicts = vec![Verdict::miss(None); trial.cases.len()];
        kernel.run(trial.cases, &epsilons, &mut verdicts);
        verdicts.iter().any(|verdict| verdict.hit && least_t.is_none_or(|t| t <= verdict.t))
    };
    let empty = || Wrong::new(attempts.len(), setting.counts);
    let add = |sums: &mut Wrong, trial: Trial<'_, F>| {
        if is_hit(&trial) != trial.is_hit(&attempts[0].epsilons) {
            sums.1 = Some(format!(
                "the margins and the run differ at {:?} on {}",
                attempts[0].epsilons,
                trial.cases[0].hex()
            ));
        }
        sums.add(setting.counts, attempts, &trial);
    };
    let Wrong(wrong, fault) = setting.sum(seed, count, observer, empty, add);
    fault.map_or(Ok(wrong), Err)
}
