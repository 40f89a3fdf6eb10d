//! A study of a scene: the cheapest epsilons together, how far each may move, and what both do on fresh
//! rays, and in the same scene on planes and with rays of other kinds.

use super::candidates::{MOST_POINTS, around, grid, of_values};
use super::curves::{Curve, axes, curves};
use super::errors::MaxError;
use super::fresh::{OnFresh, Prices, Tried, is_worth_saying, refuted};
use super::joint::{Costs, Joint, KnobGrid};
use super::knob::{Knob, KnobMargins};
use super::limits::{KnobLimit, all_limits, between, limits, printed};
use super::measure::{Attempt, OfHits, Ran, count_at, differs, measure};
use super::picture::{HoleShare, holes};
use super::prepared::{Prepared, Store};
use super::proved::{ProvedValue, proved};
use super::rays::Rays;
use super::trials::{Pass, Setting};
use crate::arith::Float;
use crate::audit::{Row, Trials};
use crate::case::{Scene, SceneKind};
use crate::family::Stratum;
use crate::kernel::Scalar;

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

/// The name of epsilons that follow each case's size.
pub const SCALE_FREE: &str = "scale-free";

/// The epsilons that the rays of a seed choose.
pub struct Chosen<F> {
    /// By knob: the cheapest together.
    best: Vec<F>,
    /// True if the errors of the hits that remain are as small as was wanted.
    is_accurate: bool,
    limits: Vec<KnobLimit<F>>,
    /// The cheapest that follow each case's size, with their limits.
    scale_free: Option<(Vec<F>, Vec<KnobLimit<F>>)>,
    /// So many rays of each kind choose and try these.
    form_rays: u64,
}

/// Runs a study: [`choose`], and [`try_on_fresh`].
pub fn study_scene<F: Scalar>(
    setting: &Setting<'_, F>,
    costs: &Costs,
    max_error: Option<&MaxError>,
    named: &[(String, Vec<F>)],
    pass: Pass<'_>,
) -> Result<SceneStudy<F>, String> {
    let chosen = choose(setting, costs, max_error, pass, pass.count);
    try_on_fresh(setting, chosen, costs, max_error, named, pass)
}

/// Chooses epsilons on the rays of a seed, and those that follow each case's size on so many of each kind.
pub fn choose<F: Scalar>(
    setting: &Setting<'_, F>,
    costs: &Costs,
    max_error: Option<&MaxError>,
    pass: Pass<'_>,
    form_rays: u64,
) -> Chosen<F> {
    let store = Store::default();
    let setting = &Setting {
        store: Some(&store),
        ..*setting
    };
    let accurate = cheapest(setting, costs, max_error, pass);
    let is_accurate = accurate.is_some();
    let on_grid = accurate
        .or_else(|| cheapest(setting, costs, None, pass))
        .expect("without a limit of errors some point is the cheapest");
    let (best, limits) = within_limits(setting, on_grid, costs, max_error, pass);
    let following = &Setting {
        relative: true,
        ..*setting
    };
    let of_form = pass.of(form_rays);
    let scale_free = cheapest(following, costs, max_error, of_form)
        .map(|on_grid| within_limits(following, on_grid, costs, max_error, of_form));
    Chosen {
        best,
        is_accurate,
        limits,
        scale_free,
        form_rays,
    }
}

/// Tries the chosen epsilons, and others with names, on the rays of the next seed. The error is a disagreement between
/// margins and the kernel's own run: a fault of this tool.
pub fn try_on_fresh<F: Scalar>(
    setting: &Setting<'_, F>,
    chosen: Chosen<F>,
    costs: &Costs,
    max_error: Option<&MaxError>,
    named: &[(String, Vec<F>)],
    pass: Pass<'_>,
) -> Result<SceneStudy<F>, String> {
    let Chosen {
        best,
        is_accurate,
        limits: found,
        scale_free,
        form_rays,
    } = chosen;
    let store = Store::default();
    let setting = &Setting {
        store: Some(&store),
        ..*setting
    };
    let following = &Setting {
        relative: true,
        ..*setting
    };
    let fresh = pass.fresh();
    let vectors = with_other_names(&best, named);
    let epsilons: Vec<Vec<F>> = vectors.iter().map(|(_, all)| all.clone()).collect();
    let proofs = proved(setting);
    let attempts = attempts(&epsilons, &found, &proofs);
    let check = differs(setting, &epsilons, pass.observer);
    let run = measure(setting, &attempts, epsilons.len(), max_error, fresh, check);
    if let Some(fault) = run.ran.fault {
        return Err(fault);
    }
    let mut wrong = run.trials;
    let at_proofs = wrong.split_off(attempts.len() - proofs.len());
    let at_limits = wrong.split_off(epsilons.len());
    let prices = Prices::new(setting, &wrong[0]);
    let axes = axes(&vectors, &found, &proofs, setting.fine_curves);
    let proved = prices.of_proofs(proofs, at_proofs);
    if let Some(fault) = refuted(&proved) {
        return Err(fault);
    }
    let curves = curves(setting, &best, &axes, fresh);
    let limits = prices.of_limits(found, at_limits);
    let pictures_of_all = pictures(setting, &epsilons, fresh);
    let mut tried = all_tried(setting, costs, vectors, wrong, run.of_hits);
    for (tried, holes) in tried.iter_mut().zip(pictures_of_all) {
        tried.holes = holes;
    }
    let mut relative = None;
    let mut relative_limits = Vec::new();
    if let Some((scale_free, limits)) = scale_free {
        let of_form = fresh.of(form_rays);
        let form = try_scale_free(following, scale_free, costs, max_error, of_form);
        // Where no fixed values are accurate enough, a form that is needs no lower cost.
        if !is_accurate || is_worth_saying(setting.counts, costs, &form, &tried[0]) {
            let epsilons = [form.epsilons.clone()];
            let holes = pictures(following, &epsilons, of_form).remove(0);
            relative = Some(Tried { holes, ..form });
        }
        relative_limits = limits;
    }
    Ok(SceneStudy {
        best,
        is_accurate,
        tried,
        limits,
        proved,
        curves,
        relative,
        relative_limits,
        elsewhere: Vec::new(),
        nanoseconds: run.ran.nanoseconds as f64 / run.ran.rays.max(1) as f64,
    })
}

/// The recommended epsilons and the named ones, without those that are equal to one before.
fn with_other_names<F: Float>(best: &[F], named: &[(String, Vec<F>)]) -> Vec<(String, Vec<F>)> {
    let mut vectors = vec![("recommended".to_owned(), best.to_vec())];
    for (name, epsilons) in named {
        let is_known = vectors.iter().any(|(_, known)| known == epsilons);
        if !is_known {
            vectors.push((name.clone(), epsilons.clone()));
        }
    }
    vectors
}

/// The attempts on fresh rays: at all the epsilons, then at the limits that have a value and at the proved values, each
/// beside the first epsilons.
fn attempts<F: Float>(
    epsilons: &[Vec<F>],
    limits: &[KnobLimit<F>],
    proofs: &[ProvedValue<F>],
) -> Vec<Attempt<F>> {
    let best = &epsilons[0];
    let mut attempts = Vec::new();
    for all in epsilons {
        attempts.push(Attempt::new(all.clone()));
    }
    for limit in limits {
        attempts.extend(Attempt::at_limit(limit, best));
    }
    for proof in proofs {
        attempts.push(Attempt::at_proof(proof, best));
    }
    attempts
}

/// The results of epsilons with names on fresh rays, from their wrong answers and the errors of their hits; no pictures yet.
fn all_tried<F: Scalar>(
    setting: &Setting<'_, F>,
    costs: &Costs,
    vectors: Vec<(String, Vec<F>)>,
    wrong_answers: Vec<Vec<Trials>>,
    of_hits: Vec<OfHits>,
) -> Vec<Tried<F>> {
    let mut sums = wrong_answers.into_iter().zip(of_hits);
    let mut tried = Vec::with_capacity(vectors.len());
    for vector in vectors {
        let (wrong, of_hits) = sums.next().expect("sums of each attempt");
        let cost = costs.of_trials(setting.counts, &wrong);
        tried.push(Tried::new(vector, wrong, cost, of_hits));
    }
    tried
}

/// The results of epsilons that follow each case's size, on fresh rays.
fn try_scale_free<F: Scalar>(
    following: &Setting<'_, F>,
    epsilons: Vec<F>,
    costs: &Costs,
    max_error: Option<&MaxError>,
    fresh: Pass<'_>,
) -> Tried<F> {
    let attempt = [Attempt::new(epsilons.clone())];
    let no_run = |_: &Prepared<F>, _: &[KnobMargins<F>]| Ran::default();
    let sums = measure(following, &attempt, 1, max_error, fresh, no_run);
    let vector = vec![(SCALE_FREE.to_owned(), epsilons)];
    all_tried(following, costs, vector, sums.trials, sums.of_hits).remove(0)
}

/// For each of some epsilons the share of holes in a picture, where shared edges are counted.
fn pictures<F: Scalar>(
    setting: &Setting<'_, F>,
    epsilons: &[Vec<F>],
    fresh: Pass<'_>,
) -> Vec<Option<HoleShare>> {
    let edges = Rays::Stratum(Stratum::Edges);
    if setting.counts.iter().any(|count| count.rays == edges) {
        holes(setting, epsilons, fresh)
    } else {
        vec![None; epsilons.len()]
    }
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
    let mut middles = Vec::with_capacity(best.len());
    let mut weighed = Vec::with_capacity(best.len());
    for (between, own) in pairs {
        let is_other = |middle: &F| middle != own && (*middle < F::zero()) == (*own < F::zero());
        let middle = between.filter(|middle| !own.is_zero() && is_other(middle));
        let mut values = vec![*own];
        values.extend(middle);
        middles.push(middle);
        weighed.push(values);
    }
    if middles.iter().all(Option::is_none) {
        return (best, found);
    }
    let grid = of_values(weighed.into_iter());
    let joint = Joint::count(setting, grid, max_error, pass);
    match joint.moved(setting.counts, costs, &best, &middles) {
        Some(moved) if moved != best => {
            let limits = limits(setting, &moved, pass);
            (moved, limits)
        }
        _ => (best, found),
    }
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
    let (grid, coarsest) = grid(setting, MOST_POINTS, max_error, pass);
    let mut best = cheapest_of(setting, grid, costs, max_error, pass)?;
    // What a coarse grid leaves out may be cheaper.
    for step in (0..coarsest).rev() {
        best = cheapest_of(setting, around(&best, step), costs, max_error, pass)?;
    }
    Some(best)
}

/// The cheapest point of a grid.
fn cheapest_of<F: Scalar>(
    setting: &Setting<'_, F>,
    grid: KnobGrid<F>,
    costs: &Costs,
    max_error: Option<&MaxError>,
    pass: Pass<'_>,
) -> Option<Vec<F>> {
    let joint = Joint::count(setting, grid, max_error, pass);
    joint.best(setting.counts, costs)
}

/// Tries the recommended epsilons and the proved values in another scene. A value that is wrong there is taken out of what
/// is proved: its proof is about the scene's own kind of plane.
pub fn try_elsewhere<F: Scalar>(
    setting: &Setting<'_, F>,
    study: &mut SceneStudy<F>,
    scene: &Scene,
    pass: Pass<'_>,
) {
    let mut attempts = vec![Attempt::new(study.best.clone())];
    for found in &study.proved {
        attempts.push(Attempt::at_proof(&found.bound, &study.best));
    }
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
