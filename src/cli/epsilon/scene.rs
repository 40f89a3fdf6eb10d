//! `hairline epsilon` for a scene: which epsilons, all together, for a scene.

use super::{EpsilonArguments, fault, found_margins, tells_margins};
use crate::audit::Row;
use crate::cli::before::{refuse_wrong_values, scalars_in_use, set_threads};
use crate::cli::exit::{Failure, Status};
use crate::cli::output::paired_outputs;
use crate::cli::progress::Progress;
use crate::epsilon::scene::{
    COUNT, Costs, Knob, LEAST_T, MOST_KNOBS, MaxError, Setting, StudiedScene, contract_with,
    counts, own_epsilons,
};
use crate::family::Stratum;
use crate::report::scene::{SCENE_FORMATS, SceneKernelPart, kernel_part, scene_record};
use crate::studied::Studied;

/// The most values of --at.
const MOST_AT: usize = 5;

/// Passes over every stratum, usually: the grid, the limits, numbers that move between them and their limits, the fresh
/// rays, and the same for scale-free forms; and the curves. A coarse grid takes more.
const PASSES: u64 = 11;

/// The note on the parts of a contract that a scene leaves out.
const OF_CONTRACT: &str = "of --contract a scene uses only the sides and where rays begin and end; at shared edges \
                           and vertices it counts cracks, whatever the contract says of them";

/// Runs the command; the flags may leave the count to it.
pub fn run(arguments: &EpsilonArguments, is_count_given: bool) -> Result<Status, Failure> {
    arguments.refuse_what_scenes_do_not_take()?;
    let snippet = arguments.snippet.as_ref().map(std::slice::from_ref);
    let formats = snippet.unwrap_or(&arguments.output.format);
    let outputs = paired_outputs(SCENE_FORMATS, formats, &arguments.output.output)?;
    set_threads(arguments.threads)?;
    let costs = arguments.cost.as_deref().map_or(Ok(Costs::default()), Costs::parse);
    let costs = costs.map_err(|error| Failure::usage(format!("--cost: {error}")))?;
    let max_error = arguments.max_error.as_deref().map(MaxError::parse).transpose();
    let max_error = max_error.map_err(|error| Failure::usage(format!("--max-error: {error}")))?;
    let max_error = max_error.as_ref();
    let (rows, least_t) = arguments.kernels.rows_and_least_t()?;
    let scalars = scalars_in_use(&rows, arguments.sources.scalars()?)?;
    refuse_wrong_values(&rows, scalars)?;
    let (mut tuned, mut reasons): (Vec<Tuned<'_>>, Vec<String>) = Default::default();
    for row in &rows {
        let name = row.entry.info.name;
        if let Some(known) = tuned.iter_mut().find(|known| known.row.entry.info.name == name) {
            known.sets.push(row);
            continue;
        }
        match arguments.knobs(row) {
            Ok(knobs) => tuned.push(Tuned { row, sets: vec![row], knobs }),
            Err(reason) => reasons.push(reason),
        }
    }
    if least_t.is_some() && !tuned.iter().any(|tuned| tuned.knobs.contains(&Knob::LeastT)) {
        return Err(Failure::usage(
            "--epsilon: no kernel here has a t_min to choose, or --gate does not name it",
        ));
    }
    let studied = arguments.sources.studied_scene(arguments.output.quiet)?;
    match reasons.first() {
        Some(reason) if tuned.is_empty() => return Err(Failure::usage(reason)),
        _ if arguments.output.quiet => {}
        _ => reasons.iter().for_each(|reason| eprintln!("left out: {reason}")),
    }
    if !arguments.output.quiet && !arguments.sources.names_scene_or_mesh() {
        let words = "no --scene: in the preset `unit` (others: room, city, cad-mm, your own numbers, --mesh)";
        eprintln!("{words}; --gate varies one gate over families of cases");
    }
    if !arguments.output.quiet && arguments.kernels.names_contract() {
        eprintln!("{OF_CONTRACT}");
    }
    arguments.warn_of_subnormals(&rows, scalars);
    let (seed, count) = arguments.sources.seed_and_count();
    let count = if is_count_given { count } else { COUNT };
    let studies = scalars.iter().filter(|scalar| **scalar).count() * tuned.len();
    let passes = PASSES + studied.others.len() as u64;
    let total = passes * Stratum::ALL.len() as u64 * count * studies as u64;
    let progress = Progress::new(total, "indices", arguments.output.quiet);
    let run = Run {
        studied: &studied,
        costs: &costs,
        max_error,
        least_t: least_t.as_deref(),
        at: &arguments.at,
        fine_curves: arguments.curves,
        seed,
        count,
        progress: &progress,
    };
    let mut parts = Vec::new();
    for tuned in &tuned {
        let in_scalar = tuned.row.entry.scalars();
        if scalars[0] && in_scalar[0] {
            parts.push(run.study::<f32>(tuned)?);
        }
        if scalars[1] && in_scalar[1] {
            parts.push(run.study::<f64>(tuned)?);
        }
    }
    progress.finish();
    let record = scene_record(&studied, &costs, max_error, seed, count, parts);
    arguments.output.write(outputs, &record)?;
    Ok(Status::Success)
}

/// A kernel, the rows of its epsilon sets, and what is chosen of it.
struct Tuned<'a> {
    row: &'a Row,
    sets: Vec<&'a Row>,
    knobs: Vec<Knob>,
}

struct Run<'a> {
    studied: &'a StudiedScene,
    costs: &'a Costs,
    max_error: Option<&'a MaxError>,
    /// The least t that `--epsilon` names.
    least_t: Option<&'a str>,
    at: &'a [String],
    fine_curves: bool,
    seed: u64,
    count: u64,
    progress: &'a Progress,
}

impl Run<'_> {
    fn study<F: Studied>(&self, tuned: &Tuned<'_>) -> Result<SceneKernelPart, Failure> {
        let Tuned { row, sets, knobs } = tuned;
        let name = row.entry.info.name;
        let missing = || Failure::usage(format!("{name} does not run in {}", F::NAME));
        let row = Row { contract: contract_with(knobs, &row.contract), ..(*row).clone() };
        let counts = counts(knobs, &row.contract);
        let setting = Setting {
            row: &row,
            subject: F::subject(row.entry).ok_or_else(missing)?,
            knobs,
            counts: &counts,
            scene: &self.studied.scene,
            mesh: self.studied.mesh.as_ref(),
            relative: false,
            fine_curves: self.fine_curves,
            store: None,
        };
        let number = |flag: &str, text: &str| {
            let value = F::parse(text).filter(|value| value.is_finite());
            let wrong = || format!("{flag}: '{text}' is not a finite number of {}", F::NAME);
            value.ok_or_else(|| Failure::usage(wrong()))
        };
        let least_t = self.least_t.map(|text| number("--epsilon", text)).transpose()?;
        if least_t.is_some_and(|t| t < F::zero()) {
            return Err(Failure::usage(format!("--epsilon: {LEAST_T} is at least 0")));
        }
        let own = |set: &&Row| {
            let name = self.least_t.map(|text| format!("{},{LEAST_T}={text}", set.set));
            let epsilons = own_epsilons::<F>(set, knobs, least_t.unwrap_or(F::zero()));
            (name.unwrap_or_else(|| set.set.clone()), epsilons)
        };
        let mut named: Vec<(String, Vec<F>)> = sets.iter().map(own).collect();
        named.push(("zero".to_owned(), vec![F::zero(); knobs.len()]));
        for text in self.at {
            let value = number("--at", text)?;
            if value < F::zero() && knobs[..] == [Knob::LeastT] {
                return Err(Failure::usage(format!("--at: {LEAST_T} is at least 0")));
            }
            named.push((text.clone(), vec![value]));
        }
        let Run { costs, max_error, seed, count, progress, .. } = *self;
        let study = F::study_scene(&setting, costs, max_error, &named, seed, count, progress);
        found_margins(name, setting.subject)?;
        let mut study = study.map_err(|error| fault(row.entry, error))?;
        F::try_elsewhere(&setting, &mut study, &self.studied.others, seed, count, progress);
        Ok(kernel_part(&setting, &tuned.row.contract, &study, max_error))
    }
}

impl EpsilonArguments {
    fn refuse_what_scenes_do_not_take(&self) -> Result<(), Failure> {
        if !self.at.is_empty() && self.gate.len() != 1 {
            return Err(Failure::usage("--at: name one --gate, whose values they are"));
        }
        if MOST_AT < self.at.len() {
            return Err(Failure::usage(format!("--at: at most {MOST_AT} values fit the screen")));
        }
        let given = [
            ("--exact", self.exact),
            ("--family", self.sources.names_families()),
            ("--exhaustive", self.sources.is_exhaustive()),
        ];
        match given.iter().find(|(_, given)| *given) {
            Some((flag, _)) => {
                Err(Failure::usage(format!("{flag} is not for --scene, nor for --mesh")))
            }
            None => Ok(()),
        }
    }

    /// The knobs of a kernel that are chosen, or why it cannot be studied.
    fn knobs(&self, row: &Row) -> Result<Vec<Knob>, String> {
        let info = row.entry.info;
        let name = info.name;
        tells_margins(row.entry)?;
        let all = Knob::all(row);
        let names: Vec<&str> = all.iter().map(|knob| knob.name(info.gates)).collect();
        if let Some(unknown) = self.gate.iter().find(|gate| !names.contains(&gate.as_str())) {
            return Err(format!(
                "{name} has no '{unknown}' to choose: there are {}",
                names.join(", ")
            ));
        }
        let is_chosen = |knob: &Knob| {
            self.gate.is_empty() || self.gate.iter().any(|gate| gate == knob.name(info.gates))
        };
        let chosen: Vec<Knob> = all.into_iter().filter(is_chosen).collect();
        match chosen.len() {
            0 => Err(format!("{name} has no number that can be chosen")),
            n if n > MOST_KNOBS => Err(format!(
                "{name} has {n} numbers to choose ({}): name at most {MOST_KNOBS} with --gate",
                names.join(", ")
            )),
            _ => Ok(chosen),
        }
    }
}
