//! A study of a scene: the cheapest epsilons together, how far each may move, and what both do on fresh
//! rays, and in the same scene on planes and with rays of other kinds.

use super::candidates::{MOST_POINTS, around, grid, of_values};
use super::curves::{Curve, axes, curves};
use super::errors::{ErrorSums, MaxError};
use super::joint::{Costs, Joint, KnobGrid};
use super::knob::{Knob, KnobMargins};
use super::limits::{KnobLimit, all_limits, between, limits, printed};
use super::measure::{Attempt, OfHits, Ran, WrongAnswers, count_at, differs, measure};
use super::picture::{HoleShare, holes};
use super::prepared::Store;
use super::proved::{ProvedValue, proved};
use super::rays::{RayCount, Rays, WrongKind};
use super::trials::{Pass, Setting};
use crate::arith::Float;
use crate::audit::{Row, Trials};
use crate::case::{Case, Scene, SceneKind};
use crate::family::Stratum;
use crate::kernel::{Role, Scalar};
use std::slice;

/// A study's results.
pub struct SceneStudy<F> {
    /// By knob: the cheapest epsilons together.
    pub best: Vec<F>,
    /// True if the errors of the hits that remain are as small as was wanted.
    pub is_accurate: bool,
    /// The epsilons that were tried on fresh rays: the cheapest, and the named ones, without those that are equal to
    /// one before.
    pub tried: Vec<Tried<F>>,
    /// How far each knob may move.
    pub limits: Vec<OnFresh<KnobLimit<F>>>,
    /// Values that are proved: never wrong on fresh rays, or a proof is.
    pub proved: Vec<OnFresh<ProvedValue<F>>>,
    /// By knob: what each value does on fresh rays while the others stay.
    pub curves: Vec<Curve<F>>,
    /// The cheapest epsilons that follow each case's size, if they are cheaper by a fifth, or if only they
    /// keep the errors as small as was wanted.
    pub relative: Option<Tried<F>>,
    /// How far such epsilons may move.
    pub relative_limits: Vec<KnobLimit<F>>,
    /// The results of the cheapest epsilons on planes of other kinds, once they are tried.
    pub elsewhere: Vec<Elsewhere>,
    /// The kernel's nanoseconds a ray, with the cheapest epsilons.
    pub nanoseconds: f64,
}

/// The results of the recommended epsilons on planes and rays of one kind, fresh ones.
pub struct Elsewhere {
    /// The kind.
    pub kind: SceneKind,
    /// By count: the wrong answers.
    pub wrong: Vec<Trials>,
}

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

/// The name of epsilons that follow each case's size.
pub const SCALE_FREE: &str = "scale-free";

/// A scale-free form is worth saying if it leaves less than this share of the cost.
const WORTH_SAYING: f64 = 0.8;

/// Runs a study, which also tries epsilons with names. The error is a disagreement between
/// margins and the kernel's own run: a fault of this tool.
pub fn study_scene<F: Scalar>(
    setting: &Setting<'_, F>,
    costs: &Costs,
    max_error: Option<&MaxError>,
    named: &[(String, Vec<F>)],
    pass: Pass<'_>,
) -> Result<SceneStudy<F>, String> {
    let store = Store::default();
    let setting = &Setting {
        store: Some(&store),
        ..*setting
    };
    let (counts, fresh) = (setting.counts, pass.fresh());
    let accurate = cheapest(setting, costs, max_error, pass);
    let is_accurate = accurate.is_some();
    let best = accurate.or_else(|| cheapest(setting, costs, None, pass));
    let best = best.expect("without a limit of errors some point is the cheapest");
    let (best, found) = within_limits(setting, best, costs, max_error, pass);
    let following = Setting {
        relative: true,
        ..*setting
    };
    let followed = cheapest(&following, costs, max_error, pass);
    let followed =
        followed.map(|followed| within_limits(&following, followed, costs, max_error, pass));
    // The rays of this seed were passed over for the last time.
    let mut vectors = vec![("recommended".to_owned(), best.clone())];
    for (name, epsilons) in named {
        if !vectors.iter().any(|(_, known)| known == epsilons) {
            vectors.push((name.clone(), epsilons.clone()));
        }
    }
    let plain = vectors.len();
    let mut attempts: Vec<Attempt<F>> = vectors
        .iter()
        .map(|(_, epsilons)| Attempt::new(epsilons.clone()))
        .collect();
    attempts.extend(
        found
            .iter()
            .filter_map(|limit| Attempt::at_limit(limit, &best)),
    );
    let proofs = proved(setting);
    let at_proved =
        |proved: &ProvedValue<F>| Attempt::alone(proved.knob, proved.value, proved.is_lower, &best);
    attempts.extend(proofs.iter().map(at_proved));
    let plain_ones: Vec<Vec<F>> = attempts[..plain]
        .iter()
        .map(|attempt| attempt.epsilons.clone())
        .collect();
    let differs = differs(setting, &plain_ones, pass.observer);
    let run = measure(setting, &attempts, plain, max_error, fresh, differs);
    let WrongAnswers {
        trials: mut wrong,
        of_hits,
        ran,
    } = run;
    ran.fault.map_or(Ok(()), Err)?;
    let of_proofs = wrong.split_off(attempts.len() - proofs.len());
    let mut of_limits = wrong.split_off(plain).into_iter();
    let rays: Vec<u64> = wrong[0].iter().map(|trials| trials.of).collect();
    // All rays count for a price, those that other knobs refuse too.
    let price = |knob: usize, is_lower: bool, wrong: &[Trials]| {
        let place = price(setting, knob, is_lower)?;
        Some((place, Trials::independent(wrong[place].count, rays[place])))
    };
    let of_proof = |(bound, wrong): (ProvedValue<F>, Vec<Trials>)| OnFresh {
        wrong: wrong[bound.count],
        price: price(bound.knob, bound.is_lower, &wrong),
        bound,
    };
    let axes = axes(&vectors, &found, &proofs, setting.fine_curves);
    let proofs: Vec<_> = proofs.into_iter().zip(of_proofs).map(of_proof).collect();
    refuted(&proofs).map_or(Ok(()), Err)?;
    let of_limit = |bound: KnobLimit<F>| match bound.value.and_then(|_| of_limits.next()) {
        Some(wrong) => OnFresh {
            wrong: wrong[bound.count],
            price: price(bound.knob, bound.is_lower, &wrong),
            bound,
        },
        None => OnFresh {
            bound,
            wrong: Trials::default(),
            price: None,
        },
    };
    let curves = curves(setting, &best, &axes, fresh);
    let found = found.into_iter().map(of_limit).collect();
    let has_edges = counts
        .iter()
        .any(|count| count.rays == Rays::Stratum(Stratum::Edges));
    let pictures = |setting: &Setting<'_, F>, all: &[Vec<F>]| match has_edges {
        true => holes(setting, all, fresh),
        false => vec![None; all.len()],
    };
    let tried = |(name, epsilons): (String, Vec<F>), wrong: Vec<Trials>, of_hits: OfHits, holes| {
        let cost = costs.of_trials(counts, &wrong);
        let OfHits {
            errors,
            exceeded,
            doubles,
        } = of_hits;
        Tried {
            name,
            epsilons,
            wrong,
            cost,
            errors,
            exceeded,
            doubles,
            holes,
        }
    };
    let of_vectors = vectors.into_iter().zip(wrong).zip(of_hits);
    let all: Vec<Tried<F>> = (of_vectors.zip(pictures(setting, &plain_ones)))
        .map(|(((vector, wrong), of_hits), holes)| tried(vector, wrong, of_hits, holes))
        .collect();
    let (relative, relative_limits) = match followed {
        Some((followed, found)) => {
            let attempt = [Attempt::new(followed.clone())];
            let no_run = |_: &[Case<F>], _: &[KnobMargins<F>]| Ran::default();
            let mut sums = measure(&following, &attempt, 1, max_error, fresh, no_run);
            let holes = pictures(&following, slice::from_ref(&followed)).remove(0);
            let vector = (SCALE_FREE.to_owned(), followed);
            let relative = tried(vector, sums.trials.remove(0), sums.of_hits.remove(0), holes);
            // Where no fixed values are accurate enough, a form that is needs no lower cost.
            let is_worth =
                |form: &Tried<F>| !is_accurate || is_worth_saying(counts, costs, form, &all[0]);
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
        elsewhere: Vec::new(),
        nanoseconds: ran.nanoseconds as f64 / ran.rays.max(1) as f64,
    })
}

/// The cheapest epsilons with each knob that is not 0 and whose limits meet in the middle between them, where that
/// costs no more than chance explains; and the limits.
pub fn within_limits<F: Scalar>(
    setting: &Setting<'_, F>,
    best: Vec<F>,
    costs: &Costs,
    max_error: Option<&MaxError>,
    pass: Pass<'_>,
) -> (Vec<F>, Vec<KnobLimit<F>>) {
    let all = all_limits(setting, &best, pass);
    let pairs = between(&all, best.len()).into_iter().zip(&best);
    let found = printed(setting, all);
    let middles: Vec<Option<F>> = pairs
        .map(|(middle, own)| {
            let is_other =
                |middle: &F| middle != own && (*middle < F::zero()) == (*own < F::zero());
            middle.filter(|middle| !own.is_zero() && is_other(middle))
        })
        .collect();
    if middles.iter().all(Option::is_none) {
        return (best, found);
    }
    let both = best.iter().zip(&middles);
    let both = both.map(|(own, middle)| [Some(*own), *middle].into_iter().flatten().collect());
    let joint = Joint::count(setting, of_values(both), max_error, pass);
    match joint
        .moved(setting.counts, costs, &best, &middles)
        .filter(|moved| *moved != best)
    {
        Some(moved) => {
            let found = limits(setting, &moved, pass);
            (moved, found)
        }
        None => (best, found),
    }
}

/// A fault of this tool: a value that is proved to be never wrong, and was.
fn refuted<F: Float>(proofs: &[OnFresh<ProvedValue<F>>]) -> Option<String> {
    let OnFresh { bound, wrong, .. } = proofs.iter().find(|found| 0 < found.wrong.count)?;
    let value = bound.value.to_f64();
    Some(format!(
        "{value:e} is proved to be never wrong, and was {} times",
        wrong.count
    ))
}

/// True if a form is cheaper than fixed epsilons by enough, and by more than chance explains.
fn is_worth_saying<F>(
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
    let variance = |wrong: &Trials| {
        wrong
            .share()
            .map_or(0.0, |share| share * (1.0 - share) / wrong.of as f64)
    };
    let of_count =
        |(count, wrong): (&RayCount, &Trials)| costs.of(count.kind).powi(2) * variance(wrong);
    let variances = tried.map(|tried| counts.iter().zip(&tried.wrong).map(of_count).sum::<f64>());
    let [one, other] = tried.map(|tried| tried.cost);
    3.0 * (variances[0] + variances[1]).sqrt() < (one - other).abs()
}

/// The count that shows what a bound of a knob costs: hits lost where it must be large, hits beside triangles
/// where an edge's must be negative.
fn price<F: Scalar>(setting: &Setting<'_, F>, knob: usize, is_lower: bool) -> Option<usize> {
    let role = setting.knobs[knob].gate(setting.row.entry.info.gates).role;
    let wanted = match (role, is_lower) {
        (Role::Parallel | Role::T, true) => (Stratum::Interior, WrongKind::Miss),
        (Role::Edge | Role::Other, false) => (Stratum::Outside, WrongKind::Hit),
        _ => return None,
    };
    let (rays, kind) = (Rays::Stratum(wanted.0), wanted.1);
    setting
        .counts
        .iter()
        .position(|count| *count == RayCount { rays, kind })
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

/// The cheapest round epsilons together; none if at all of them too many of the hits that remain have too large
/// errors.
pub fn cheapest<F: Scalar>(
    setting: &Setting<'_, F>,
    costs: &Costs,
    max_error: Option<&MaxError>,
    pass: Pass<'_>,
) -> Option<Vec<F>> {
    let best = |grid: KnobGrid<F>| {
        let joint = Joint::count(setting, grid, max_error, pass);
        joint.best(setting.counts, costs)
    };
    let (grid, step) = grid(setting, MOST_POINTS, max_error, pass);
    // What a coarse grid leaves out may be cheaper.
    (0..step)
        .rev()
        .try_fold(best(grid)?, |found, step| best(around(&found, step)))
}

/// Tries the recommended epsilons and the proved values in other scenes. A value that is wrong there is taken out of what
/// is proved: its proof is about the scene's own kind of plane.
pub fn try_elsewhere<F: Scalar>(
    setting: &Setting<'_, F>,
    study: &mut SceneStudy<F>,
    scenes: &[Scene],
    pass: Pass<'_>,
) {
    for scene in scenes {
        let mut attempts = vec![Attempt::new(study.best.clone())];
        attempts.extend(study.proved.iter().map(|found| {
            let bound = &found.bound;
            Attempt::alone(bound.knob, bound.value, bound.is_lower, &study.best)
        }));
        let setting = Setting {
            scene: Some(scene),
            store: None,
            ..*setting
        };
        let mut wrong = count_at(&setting, &attempts, pass.fresh()).into_iter();
        let of_best = wrong.next().expect("one attempt at least");
        study.elsewhere.push(Elsewhere {
            kind: scene.kind(),
            wrong: of_best,
        });
        study.proved.retain(|found| {
            let wrong = wrong.next().expect("an attempt for each proof");
            wrong[found.bound.count].count == 0
        });
    }
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
