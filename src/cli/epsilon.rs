//! `hairline epsilon`: which epsilons, all of a kernel together, for a scene or on families and stored cases.

mod rounds;
mod studies;

use super::before::{
    note_secondary_rays, refuse_wrong_values, scalars_in_use, scalars_with_cases, set_threads,
};
use super::exit::{Failure, Status};
use super::flags::{refuse_twice, scalars_of};
use super::output::OutputArguments;
use super::outputs::paired_outputs;
use super::progress::Progress;
use super::select::KernelArguments;
use super::sources::SourceArguments;
use crate::advised::Advised;
use crate::arith::{ScalarName, smallest_normal};
use crate::audit::Row;
use crate::case::Target;
use crate::epsilon::{
    COUNT, Costs, Knob, MOST_KNOBS, MaxError, Pass, RayCount, Setting, SharedCases, StudiedRays,
    contract_with, counts, counts_of,
};
use crate::family::STRATA;
use crate::kernel::{Entry, EpsilonText, Scalar};
use crate::record::Context;
use crate::report::epsilon::{SCENE_FORMATS, has_a_table, rows_on_screen, scene_record};
use crate::suggest::nearest_name;
use clap::parser::ValueSource;
use clap::{ArgMatches, Args};
use rounds::PlannedStudy;

/// The most values of --at.
const MOST_AT: usize = 5;

/// Passes over every stratum, usually: the grid, the limits, numbers that move between them and their limits, the fresh
/// rays, and the same for scale-free forms; and the curves. A coarse grid takes more.
const PASSES: u64 = 11;

/// The note on the parts of a contract that a scene leaves out.
const OF_CONTRACT: &str = "of --contract a scene uses only the sides and where rays begin and end; at shared edges \
                           and vertices it counts cracks, whatever the contract says of them";

/// Which kernel, gate and cases, and how to report.
#[derive(Args)]
#[command(mut_arg("format", |format| {
    format.help("text, json, svg, markdown or html, or several separated by commas; c, rust or glsl as --snippet")
}))]
pub struct EpsilonArguments {
    #[command(flatten)]
    kernels: KernelArguments,

    /// Choose these numbers only; a gate's epsilon, or t_min
    #[arg(long, value_delimiter = ',', value_name = "GATE")]
    gate: Vec<String>,

    /// More values of the one number that --gate names, separated by commas
    #[arg(
        long,
        value_delimiter = ',',
        value_name = "E",
        allow_hyphen_values = true
    )]
    at: Vec<String>,

    /// Count curves at every number of two digits
    #[arg(long)]
    curves: bool,

    /// The costs of wrong answers; costs that are not named keep crack=10,miss=1,hit=1,self-hit=1
    #[arg(long, value_name = "KIND=COST,...", allow_hyphen_values = true)]
    cost: Option<String>,

    /// How large errors of the hits that remain may be, for 99 % of each kind of ray:
    /// of t relative to itself, of the point in the unit of length, as t=1e-3,point=0.01
    #[arg(long, value_name = "VALUE=ERROR,...", allow_hyphen_values = true)]
    max_error: Option<String>,

    #[command(flatten)]
    sources: SourceArguments,

    /// Print the numbers as code, in c, rust or glsl
    #[arg(long, value_name = "LANGUAGE", value_parser = ["c", "rust", "glsl"], conflicts_with = "format")]
    snippet: Option<String>,

    /// Threads [default: all cores]
    #[arg(long, value_name = "N")]
    threads: Option<usize>,

    #[command(flatten)]
    output: OutputArguments,
}

/// Runs the command; the flags may leave the count of a scene's rays to it.
pub fn run(arguments: &EpsilonArguments, matches: Option<&ArgMatches>) -> Result<Status, Failure> {
    let source = matches.and_then(|matches| matches.value_source("count"));
    let is_count_given = source == Some(ValueSource::CommandLine);
    arguments.check_at()?;
    let snippet = arguments.snippet.as_ref().map(std::slice::from_ref);
    let formats = snippet.unwrap_or(&arguments.output.format);
    let outputs = paired_outputs(SCENE_FORMATS, formats, &arguments.output.output)?;
    let threads = set_threads(arguments.threads)?;
    let costs = arguments
        .cost
        .as_deref()
        .map_or(Ok(Costs::default()), Costs::parse);
    let costs = costs.map_err(|error| Failure::usage(format!("--cost: {error}")))?;
    let max_error = arguments
        .max_error
        .as_deref()
        .map(MaxError::parse)
        .transpose();
    let max_error = max_error.map_err(|error| Failure::usage(format!("--max-error: {error}")))?;
    let max_error = max_error.as_ref();
    let (rows, least_t) = arguments.kernels.rows_and_least_t()?;
    let scalars = scalars_in_use(&rows, arguments.sources.scalars()?)?;
    refuse_wrong_values(&rows, scalars)?;
    let (mut tuned, mut reasons): (Vec<Tuned<'_>>, Vec<String>) = Default::default();
    for row in &rows {
        let name = row.entry.info.name;
        if let Some(known) = tuned
            .iter_mut()
            .find(|known| known.row.entry.info.name == name)
        {
            known.sets.push(row);
            continue;
        }
        match arguments.knobs(row) {
            Ok(knobs) => tuned.push(Tuned {
                row,
                sets: vec![row],
                knobs,
            }),
            Err(reason) => reasons.push(reason),
        }
    }
    if least_t.is_some()
        && !tuned
            .iter()
            .any(|tuned| tuned.knobs.contains(&Knob::LeastT))
    {
        return Err(Failure::usage(
            "--epsilon: no kernel here has a t_min to choose, or --gate does not name it",
        ));
    }
    let studied = arguments.sources.studied_rays(arguments.output.quiet)?;
    let exact = arguments.kernels.exact_row()?;
    if let Some(row) = exact.as_ref().filter(|_| studied.scene.is_some()) {
        // Where gates are chosen by name it has none of them.
        tuned.extend(arguments.knobs(row).ok().map(|knobs| Tuned {
            row,
            sets: vec![row],
            knobs,
        }));
    }
    match reasons.first() {
        Some(reason) if tuned.is_empty() => return Err(Failure::usage(reason)),
        _ if arguments.output.quiet => {}
        _ => reasons
            .iter()
            .for_each(|reason| eprintln!("left out: {reason}")),
    }
    let scalars = match studied.scene {
        Some(_) => scalars,
        None => scalars_with_cases(&studied.sources, scalars),
    };
    if !arguments.output.quiet {
        note_secondary_rays(&rows, &studied.sources);
    }
    if !arguments.output.quiet && studied.scene.is_some() {
        if !arguments.sources.names_scene_or_mesh() {
            eprintln!(
                "no --scene: in the preset `unit` (others: room, city, cad-mm, your own numbers, --mesh)"
            );
        }
        if arguments.kernels.names_contract() {
            eprintln!("{OF_CONTRACT}");
        }
    }
    arguments.warn_of_subnormals(&rows, scalars);
    let (seed, count) = arguments.sources.seed_and_count();
    let count = if is_count_given || studied.scene.is_none() {
        count
    } else {
        COUNT
    };
    let kinds = if studied.scene.is_some() {
        STRATA.len()
    } else {
        studied.sources.len()
    };
    let progress = Progress::new(0, "indices", arguments.output.quiet);
    // A count that somebody names is the count of each kernel.
    let has_rounds = studied.scene.is_some()
        && !is_count_given
        && max_error.is_none()
        && has_a_table(tuned.len());
    let run = EpsilonRun {
        studied: &studied,
        costs: &costs,
        max_error,
        least_t: least_t.as_deref(),
        arguments,
        pass: Pass::new(seed, count, &progress),
        is_alone: tuned.len() == 1,
        has_rounds,
        places: rows_on_screen(scalars.iter().filter(|scalar| **scalar).count()),
        kinds: kinds as u64,
        progress: &progress,
    };
    let mut planned: Vec<PlannedStudy<'_>> = Vec::new();
    let mut place = 0;
    for tuned in &tuned {
        for scalar in scalars_of(tuned.row.entry, scalars) {
            PlannedStudy::plan(&mut planned, (place, tuned), scalar, count);
            place += 1;
        }
    }
    run.expect_rounds(&planned);
    let mut parts = Vec::new();
    for scalar in ScalarName::among(scalars) {
        let of_scalar = planned.extract_if(.., |study| study.scalar == scalar);
        let of_scalar: Vec<PlannedStudy<'_>> = of_scalar.collect();
        parts.extend(in_named_scalar!(scalar, F => run.study_all::<F>(of_scalar))?);
    }
    parts.sort_by_key(|(place, _)| *place);
    let parts = parts.into_iter().map(|(_, part)| part).collect();
    progress.finish();
    let context = Context {
        seconds: progress.seconds(),
        threads,
    };
    let mut record = scene_record(&studied, &costs, max_error, seed, count, &context, parts);
    record.result.left_out = arguments.sources.left_out()?;
    arguments.output.write(outputs, &record)?;
    Ok(Status::Success)
}

/// A kernel, the rows of its epsilon sets, and what is chosen of it.
struct Tuned<'a> {
    row: &'a Row,
    sets: Vec<&'a Row>,
    knobs: Vec<Knob>,
}

impl Tuned<'_> {
    /// True if a study of another kernel finds the same: it is the same test, judged alike, with the same numbers to choose.
    fn is_studied_with(&self, other: &Tuned<'_>) -> bool {
        let (row, of_other) = (self.row, other.row);
        let sets = |tuned: &Tuned<'_>| -> Vec<(String, Vec<EpsilonText>)> {
            let sets = tuned.sets.iter();
            sets.map(|row| (row.set.clone(), row.epsilons.clone()))
                .collect()
        };
        row.entry.is_one_test_with(of_other.entry)
            && row.contract == of_other.contract
            && self.knobs == other.knobs
            && sets(self) == sets(other)
    }
}

/// A kernel as it is judged here, and what is counted of it.
struct Judged {
    row: Row,
    counts: Vec<RayCount>,
}

struct EpsilonRun<'a> {
    studied: &'a StudiedRays,
    costs: &'a Costs,
    max_error: Option<&'a MaxError>,
    /// The least t that `--epsilon` names.
    least_t: Option<&'a str>,
    arguments: &'a EpsilonArguments,
    pass: Pass<'a>,
    /// True if one kernel is studied.
    is_alone: bool,
    /// True if kernels that are surely dearer than those on the screen get no more rays.
    has_rounds: bool,
    /// How many kernels of a scalar are on the screen.
    places: usize,
    /// How many kinds of rays there are.
    kinds: u64,
    progress: &'a Progress,
}

impl EpsilonRun<'_> {
    /// The counts of a kernel: in a scene only of the strata that are named, if some are.
    fn counts(&self, knobs: &[Knob], row: &Row) -> Vec<RayCount> {
        let StudiedRays {
            scene,
            sources,
            strata,
            ..
        } = self.studied;
        if scene.is_none() {
            return counts_of(sources, knobs, row);
        }
        let mut all = counts(knobs, &row.contract);
        all.retain(|count| {
            strata.is_empty() || strata.iter().any(|name| name == count.rays.name())
        });
        all
    }

    /// The kernel as it is judged, with what is counted.
    fn judged(&self, tuned: &Tuned<'_>) -> Result<Judged, Failure> {
        let row = Row {
            contract: contract_with(&tuned.knobs, &tuned.row.contract),
            ..tuned.row.clone()
        };
        let counts = self.counts(&tuned.knobs, &row);
        if counts.is_empty() {
            let name = row.entry.info.name;
            return Err(Failure::nothing(format!(
                "{name}: nothing to count on such rays"
            )));
        }
        Ok(Judged { row, counts })
    }

    /// The setting of a kernel in a scalar.
    fn setting<'b, F: Advised>(
        &'b self,
        tuned: &'b Tuned<'_>,
        judged: &'b Judged,
        shared: Option<&'b SharedCases<F>>,
    ) -> Result<Setting<'b, F>, Failure> {
        let entry = judged.row.entry;
        let name = entry.info.name;
        let missing = || Failure::usage(format!("{name} does not run in {}", F::NAME));
        Ok(Setting {
            row: &judged.row,
            subject: F::subject(entry).ok_or_else(missing)?,
            knobs: &tuned.knobs,
            counts: &judged.counts,
            scene: self.studied.scene.as_ref(),
            sources: &self.studied.sources,
            mesh: self.studied.mesh.as_ref(),
            relative: false,
            fine_curves: self.arguments.curves,
            store: None,
            shared,
        })
    }
}

impl EpsilonArguments {
    fn check_at(&self) -> Result<(), Failure> {
        refuse_twice("--gate", &self.gate)?;
        if !self.at.is_empty() && self.gate.len() != 1 {
            return Err(Failure::usage(
                "--at: name one --gate, whose values they are",
            ));
        }
        if MOST_AT < self.at.len() {
            return Err(Failure::usage(format!(
                "--at: at most {MOST_AT} values fit the screen"
            )));
        }
        Ok(())
    }

    /// The knobs of a kernel that are chosen, or why it cannot be studied.
    fn knobs(&self, row: &Row) -> Result<Vec<Knob>, String> {
        let info = row.entry.info;
        let name = info.name;
        tells_margins(row.entry, "hairline audit")?;
        let all = Knob::all(row);
        let names: Vec<&str> = all.iter().map(|knob| knob.gate(info.gates).name).collect();
        if let Some(unknown) = self
            .gate
            .iter()
            .find(|gate| !names.contains(&gate.as_str()))
        {
            let near = nearest_name(unknown, names.iter().copied());
            let near = near.map_or(String::new(), |near| format!(", did you mean '{near}'?"));
            let names = names.join(", ");
            return Err(format!(
                "{name} has no '{unknown}' to choose{near}: there are {names}"
            ));
        }
        let is_chosen = |knob: &Knob| {
            self.gate.is_empty()
                || self
                    .gate
                    .iter()
                    .any(|gate| gate == knob.gate(info.gates).name)
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

    /// Notes given epsilons that a machine may flush to zero.
    fn warn_of_subnormals(&self, rows: &[Row], scalars: [bool; 2]) {
        fn subnormal<F: Scalar>(rows: &[Row], at: &[String]) -> Vec<String> {
            let of_rows = rows.iter().flat_map(|row| row.epsilons::<F>());
            let given = at.iter().filter_map(|text| F::parse(text)).chain(of_rows);
            let is_small = |x: &F| !x.is_zero() && x.to_f64().abs() < smallest_normal::<F>();
            let mut found: Vec<String> = given.filter(is_small).map(|x| format!("{x:e}")).collect();
            found.dedup();
            found
        }
        for name in ScalarName::among(scalars) {
            let found = in_named_scalar!(name, F => subnormal::<F>(rows, &self.at));
            if !found.is_empty() && !self.output.quiet {
                eprintln!(
                    "warning: {} is subnormal in {name}: machines that flush to zero take it for 0",
                    found.join(", ")
                );
            }
        }
    }
}

/// An error if a kernel takes too long to be asked for its margins; `audit` is the command that runs it at one epsilon.
pub fn tells_margins<T: Target>(entry: &Entry<T>, audit: &str) -> Result<(), String> {
    if entry.tells_margins() {
        return Ok(());
    }
    Err(format!(
        "{}: a command is too slow to be asked at many epsilons a case (a --kernel-lib is not, nor is a command \
         that answers for margins: docs/protocol.md); `{audit} --epsilon GATE=VALUE` runs it at one",
        entry.info.name
    ))
}
