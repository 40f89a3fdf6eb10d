//! The studies of the kernels of one scalar, which have their cases in common: all kernels choose on the rays of the seed, then
//! all are tried on fresh ones, and then in each other kind of scene. So only the cases of one of these are kept at a time.

use super::rounds::PlannedStudy;
use super::{EpsilonRun, Judged, Tuned};
use crate::advised::Advised;
use crate::audit::Row;
use crate::case::Scene;
use crate::cli::exit::Failure;
use crate::cli::plugins;
use crate::engine::Unobserved;
use crate::epsilon::{
    Chosen, LEAST_T, Pass, SceneStudy, Setting, SharedCases, StudiedRays, fresh_seed, own_epsilons,
};
use crate::kernel::{Entry, KernelIn, Scalar};
use crate::offset::SegmentPlan;
use crate::report::SegmentsPart;
use crate::report::epsilon::{SceneKernelPart, kernel_part};

/// The part of the record, and the kernel's nanoseconds a ray.
pub(super) type StudiedKernel = (SceneKernelPart, f64);

/// A study that begins: what is judged, and the epsilons with names.
struct BegunStudy<'a, F> {
    planned: PlannedStudy<'a>,
    judged: Judged,
    named: Vec<(String, Vec<F>)>,
}

impl EpsilonRun<'_> {
    /// The rounds of the kernels of one scalar and then their studies; with the places in the record.
    pub(super) fn study_all<F: Advised>(
        &self,
        mut planned: Vec<PlannedStudy<'_>>,
    ) -> Result<Vec<(usize, StudiedKernel)>, Failure> {
        let cases = SharedCases::<F>::default();
        let shared = (1 < planned.len()).then_some(&cases);
        if self.has_rounds {
            self.hold_rounds(&mut planned, shared)?;
        }
        self.expect_studies(&planned);
        let mut begun = Vec::with_capacity(planned.len());
        for planned in planned {
            begun.push(self.begun::<F>(planned)?);
        }
        let mut chosen = Vec::with_capacity(begun.len());
        for study in &begun {
            chosen.push(self.choose(study, shared)?);
        }
        cases.forget();
        let mut studies = Vec::with_capacity(begun.len());
        for (study, chosen) in begun.iter().zip(chosen) {
            studies.push(self.try_on_fresh(study, chosen, shared)?);
        }
        let costs: Vec<f64> = studies.iter().map(|study| study.tried[0].cost).collect();
        let on_screen = self.on_screen(&costs);
        for scene in &self.studied.others {
            cases.forget();
            for ((begun, study), on_screen) in begun.iter().zip(&mut studies).zip(&on_screen) {
                // A proof is tried as hard on every row.
                let is_wanted = *on_screen || !study.proved.is_empty();
                let rays = self.rays_elsewhere(&begun.planned, is_wanted);
                let setting = self.setting_of(begun, shared)?;
                F::try_elsewhere(&setting, study, scene, self.pass.of(rays));
            }
        }
        let mut parts = Vec::new();
        for (begun, study) in begun.iter().zip(&studies) {
            for (place, tuned) in &begun.planned.kernels {
                parts.push((*place, self.part(begun, tuned, study)?));
            }
        }
        Ok(parts)
    }

    /// Begins a study.
    fn begun<'a, F: Advised>(
        &self,
        planned: PlannedStudy<'a>,
    ) -> Result<BegunStudy<'a, F>, Failure> {
        let Tuned { row, sets, knobs } = planned.tuned;
        let judged = self.judged(planned.tuned)?;
        let number = |flag: &str, text: &str| {
            let value = F::parse(text).filter(|value| value.is_finite());
            let wrong = || format!("{flag}: '{text}' is not a finite number of {}", F::NAME);
            value.ok_or_else(|| Failure::usage(wrong()))
        };
        let least_t = self
            .least_t
            .map(|text| number("--epsilon", text))
            .transpose()?;
        if least_t.is_some_and(|t| t < F::zero()) {
            return Err(Failure::usage(format!(
                "--epsilon: {LEAST_T} is at least 0"
            )));
        }
        let own = |set: &&Row| {
            let name = self
                .least_t
                .map(|text| format!("{},{LEAST_T}={text}", set.set));
            let epsilons = own_epsilons::<F>(set, knobs, least_t.unwrap_or(F::zero()));
            (name.unwrap_or_else(|| set.set.clone()), epsilons)
        };
        let mut named: Vec<(String, Vec<F>)> = sets.iter().map(own).collect();
        named.push(("zero".to_owned(), vec![F::zero(); knobs.len()]));
        for text in &self.arguments.at {
            let value = number("--at", text)?;
            let gates = row.entry.info.gates;
            if value < F::zero() && !knobs[0].takes_negative(gates) {
                let knob = knobs[0].gate(gates).name;
                let message = format!(
                    "--at: below 0 {knob} refuses what it does at 0, so {text} means nothing"
                );
                return Err(Failure::usage(message));
            }
            named.push((text.clone(), vec![value]));
        }
        Ok(BegunStudy {
            planned,
            judged,
            named,
        })
    }

    /// The rays of a study.
    fn pass_of<F>(&self, study: &BegunStudy<'_, F>) -> Pass<'_> {
        self.pass.of(study.planned.rays)
    }

    fn setting_of<'b, F: Advised>(
        &'b self,
        study: &'b BegunStudy<'_, F>,
        shared: Option<&'b SharedCases<F>>,
    ) -> Result<Setting<'b, F>, Failure> {
        self.setting(study.planned.tuned, &study.judged, shared)
    }

    fn choose<F: Advised>(
        &self,
        study: &BegunStudy<'_, F>,
        shared: Option<&SharedCases<F>>,
    ) -> Result<Chosen<F>, Failure> {
        let setting = self.setting_of(study, shared)?;
        let (pass, form_rays) = (self.pass_of(study), self.rays_of_form(&study.planned));
        let chosen = F::choose(&setting, self.costs, self.max_error, pass, form_rays);
        found_margins(study.judged.row.entry.info.name, setting.subject)?;
        Ok(chosen)
    }

    fn try_on_fresh<F: Advised>(
        &self,
        study: &BegunStudy<'_, F>,
        chosen: Chosen<F>,
        shared: Option<&SharedCases<F>>,
    ) -> Result<SceneStudy<F>, Failure> {
        let setting = self.setting_of(study, shared)?;
        let (pass, named) = (self.pass_of(study), &study.named);
        let found = F::try_on_fresh(&setting, chosen, self.costs, self.max_error, named, pass);
        let entry = study.judged.row.entry;
        found_margins(entry.info.name, setting.subject)?;
        found.map_err(|error| fault(entry, error))
    }

    /// The part of the record of a kernel that was studied, under this name or another, and its nanoseconds a ray.
    fn part<F: Advised>(
        &self,
        begun: &BegunStudy<'_, F>,
        tuned: &Tuned<'_>,
        study: &SceneStudy<F>,
    ) -> Result<StudiedKernel, Failure> {
        let rays = begun.planned.rays;
        let judged = self.judged(tuned)?;
        let setting = self.setting(tuned, &judged, None)?;
        let mut part = kernel_part(&setting, &tuned.row.contract, study, self.max_error);
        part.segments = self.segments::<F>(tuned.row);
        part.rays = (rays < self.pass.count).then_some(rays);
        Ok((part, study.nanoseconds))
    }

    /// Where segments end in the scene, for a kernel that has a page of its own.
    fn segments<F: Advised>(&self, row: &Row) -> Option<SegmentsPart> {
        let StudiedRays {
            scene,
            mesh,
            others,
            strata,
            ..
        } = self.studied;
        let scene = scene
            .as_ref()
            .filter(|_| strata.is_empty() && self.is_alone)?;
        let scenes: Vec<Scene> = [scene.clone()]
            .into_iter()
            .chain(others.iter().cloned())
            .collect();
        let Pass { seed, count, .. } = self.pass;
        let plan = SegmentPlan {
            row,
            scene: &scenes[0],
            mesh: mesh.as_ref(),
            ends: &[],
            seed,
            count: count.min(MOST_SEGMENTS),
        };
        Some(SegmentsPart::study::<F>(
            &plan,
            &scenes,
            [fresh_seed(seed), seed],
            &Unobserved,
        ))
    }
}

/// Segments of each kind of plane, at most: they are a line beside the epsilons.
const MOST_SEGMENTS: u64 = 10_000;

/// An error if a kernel failed on too many cases while its margins were looked for, or for good.
fn found_margins<F: Scalar>(name: &str, subject: &dyn KernelIn<F>) -> Result<(), Failure> {
    plugins::check()?;
    match subject.margins_gave_up() {
        None => Ok(()),
        Some(message) => Err(Failure::bad_input(format!("kernel '{name}': {message}"))),
    }
}

/// A disagreement between margins and runs: a fault of this tool, or of a kernel whose gates nobody sees.
fn fault(entry: &Entry, error: String) -> Failure {
    if entry.shows_gates() {
        return Failure::self_check(format!("self-check: {error}"));
    }
    let name = entry.info.name;
    Failure::bad_input(format!(
        "kernel '{name}': its epsilons do not each act alone, or its answers are not a function of the case and \
         the epsilons: {error}. Raising an epsilon must only refuse more, whatever the others are: a tolerance at edges is declared as a negative one"
    ))
}
