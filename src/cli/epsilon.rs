//! `hairline epsilon`: every epsilon of a kernel at once, and which to use.

mod scene;

use super::before::{
    note_secondary_rays, refuse_wrong_values, scalars_in_use, scalars_with_cases, set_threads,
    total_indices,
};
use super::exit::{Failure, Status};
use super::flags::refuse_twice;
use super::output::OutputArguments;
use super::plugins;
use super::progress::Progress;
use super::select::KernelArguments;
use super::sources::SourceArguments;
use crate::arith::{Float, smallest_normal};
use crate::audit::{Row, Source};
use crate::epsilon::scene::LEAST_T;
use crate::epsilon::{SPANNING, StudyPlan, floor, tunable_gates};
use crate::family::{FAMILIES, Family};
use crate::kernel::{Entry, Gate, Scalar, Subject};
use crate::report::epsilon::{EPSILON_FORMATS, GatePart, parts, record};
use crate::studied::Studied;
use crate::suggest::nearest_name;
use clap::parser::ValueSource;
use clap::{ArgMatches, Args};

/// Which kernel, gate and cases, and how to report.
#[derive(Args)]
#[command(mut_arg("format", |format| {
    format.help("text, json, csv, svg, or (with --scene or --mesh) markdown, html, c, rust or glsl, or several separated by commas")
}))]
pub struct EpsilonArguments {
    #[command(flatten)]
    kernels: KernelArguments,

    /// Vary each of these gates alone, over families of cases; with --scene or --mesh choose these only
    #[arg(long, value_delimiter = ',', value_name = "GATE")]
    gate: Vec<String>,

    /// More epsilons to compare, separated by commas
    #[arg(long, value_delimiter = ',', value_name = "E", allow_hyphen_values = true)]
    at: Vec<String>,

    /// Keep every margin: exact at every epsilon, but memory grows with the number of cases
    #[arg(long)]
    exact: bool,

    /// Write every point of each source's curve into the JSON; all kernels together take hundreds of megabytes.
    /// In a scene: curves at every number of two digits
    #[arg(long)]
    curves: bool,

    /// The costs of wrong answers in a scene; costs that are not named keep crack=10,miss=1,hit=1,self-hit=1
    #[arg(long, value_name = "KIND=COST,...", allow_hyphen_values = true)]
    cost: Option<String>,

    /// In a scene: how large errors of the hits that remain may be, for 99 % of each kind of ray:
    /// of t relative to itself, of the point in the scene's unit, as t=1e-3,point=0.01
    #[arg(long, value_name = "VALUE=ERROR,...", allow_hyphen_values = true)]
    max_error: Option<String>,

    #[command(flatten)]
    sources: SourceArguments,

    /// In a scene: print the numbers as code, in c, rust or glsl
    #[arg(long, value_name = "LANGUAGE", value_parser = ["c", "rust", "glsl"], conflicts_with = "format")]
    snippet: Option<String>,

    /// Threads [default: all cores]
    #[arg(long, value_name = "N")]
    threads: Option<usize>,

    #[command(flatten)]
    output: OutputArguments,
}

/// Runs the command.
pub fn run(arguments: &EpsilonArguments, matches: Option<&ArgMatches>) -> Result<Status, Failure> {
    if !arguments.is_of_gates() {
        let source = matches.and_then(|matches| matches.value_source("count"));
        return scene::run(arguments, source == Some(ValueSource::CommandLine));
    }
    for (flag, is_given) in
        [("--cost", arguments.cost.is_some()), ("--max-error", arguments.max_error.is_some())]
    {
        if is_given {
            let why = "is for scenes: leave out --gate, or name a --scene";
            return Err(Failure::usage(format!("{flag}: {why}")));
        }
    }
    let outputs = arguments.output.pairs(EPSILON_FORMATS)?;
    let threads = set_threads(arguments.threads)?;
    let rows = arguments.rows()?;
    let scalars = scalars_in_use(&rows, arguments.sources.scalars()?)?;
    refuse_wrong_values(&rows, scalars)?;
    arguments.warn_of_subnormals(&rows, scalars);
    let usual = |family: &Family| !SPANNING.contains(&family.name);
    let sources = arguments.sources.sources(arguments.output.quiet, usual)?;
    let families = sources.iter().filter(|source| matches!(source, Source::Family { .. })).count();
    if !arguments.output.quiet && families == FAMILIES.len() - SPANNING.len() {
        let left_out = SPANNING.join(", ");
        eprintln!("left out: {left_out}, whose sizes span the whole range (--family runs them)");
    }
    if !arguments.output.quiet {
        note_secondary_rays(&rows, &sources);
    }
    let total = total_indices(&sources, scalars)? * rows.len() as u64;
    let scalars = scalars_with_cases(&sources, scalars);
    // What is wrong with the flags shows before the first study runs.
    let sources = &sources;
    let mut studies: Vec<Planned<'_>> = Vec::new();
    for row in &rows {
        let in_scalar = row.entry.scalars();
        if scalars[0] && in_scalar[0] {
            let plan = arguments.plan::<f32>(row)?;
            studies.push(Box::new(move |progress| run_study(&plan, sources, progress)));
        }
        if scalars[1] && in_scalar[1] {
            let plan = arguments.plan::<f64>(row)?;
            studies.push(Box::new(move |progress| run_study(&plan, sources, progress)));
        }
    }
    let progress = Progress::new(total, "indices", arguments.output.quiet);
    let all = studies.iter().map(|study| study(&progress)).collect::<Result<Vec<_>, _>>()?;
    progress.finish();
    let record = record(sources, all, threads, progress.seconds());
    arguments.output.write_all(outputs, &record, arguments.curves)?;
    Ok(Status::Success)
}

/// The parts that a study of one row in one scalar adds to the record.
type StudyParts = Result<Vec<GatePart>, Failure>;

/// A study that is still to be run.
type Planned<'a> = Box<dyn Fn(&Progress) -> StudyParts + 'a>;

fn run_study<F: Studied>(
    plan: &StudyPlan<'_, F>,
    sources: &[Source],
    progress: &Progress,
) -> StudyParts {
    let study = F::study(plan, sources, progress);
    found_margins(plan.row.entry.info.name, plan.subject)?;
    let study = study.map_err(|error| fault(plan.row.entry, error))?;
    Ok(parts(plan, sources, &study))
}

impl EpsilonArguments {
    /// True if single gates are studied, over families or stored cases, instead of a scene.
    fn is_of_gates(&self) -> bool {
        let names_gates = !self.gate.is_empty() || !self.at.is_empty();
        let of_gates = self.exact || self.curves || names_gates;
        let is_of_scene = self.sources.names_scene_or_mesh();
        !is_of_scene && (of_gates || self.sources.names_other_cases())
    }

    /// One row a kernel: its first epsilon set, with the given epsilons. Of several kernels those that
    /// cannot be studied are left out, with a note.
    fn rows(&self) -> Result<Vec<Row>, Failure> {
        let mut rows = self.kernels.rows()?;
        rows.dedup_by(|second, first| second.entry.info.name == first.entry.info.name);
        refuse_twice("--gate", &self.gate)?;
        let mut reasons = Vec::new();
        rows.retain(|row| self.gates(row).map_err(|reason| reasons.push(reason)).is_ok());
        match reasons.first() {
            Some(reason) if rows.is_empty() => return Err(Failure::usage(reason)),
            _ if self.output.quiet => {}
            _ => reasons.iter().for_each(|reason| eprintln!("left out: {reason}")),
        }
        Ok(rows)
    }

    /// The gates to study, or why the kernel cannot be studied.
    fn gates(&self, row: &Row) -> Result<Vec<usize>, String> {
        let gates = row.entry.info.gates;
        let tunable = tunable_gates(gates);
        let name = row.entry.info.name;
        if tunable.is_empty() {
            return Err(format!("{name} has no gate that takes an epsilon"));
        }
        tells_margins(row.entry)?;
        if self.gate.is_empty() {
            return Ok(tunable);
        }
        let find = |wanted: &String| {
            let named = |gate: &&usize| gates[**gate].name == wanted;
            tunable.iter().find(named).copied().ok_or_else(|| self.no_gate(row, gates, wanted))
        };
        self.gate.iter().map(find).collect()
    }

    fn no_gate(&self, row: &Row, gates: &[Gate], wanted: &str) -> String {
        let kernel = row.entry.info.name;
        if wanted == LEAST_T {
            return format!(
                "{LEAST_T} is no gate of {kernel}: a least t is chosen for a scene (--scene or --mesh, without \
                 --family and --corpus), and `hairline spawn --scheme t-min=VALUE` tries one"
            );
        }
        if gates.iter().any(|gate| gate.name == wanted) {
            return format!("gate '{wanted}' of {kernel} takes no epsilon");
        }
        let advice = nearest_name(wanted, gates.iter().map(|gate| gate.name));
        let advice = advice.map_or(String::new(), |near| format!("; did you mean '{near}'?"));
        let names: Vec<&str> =
            tunable_gates(gates).into_iter().map(|gate| gates[gate].name).collect();
        format!(
            "{kernel} has no gate '{wanted}'{advice} (those that take an epsilon: {})",
            names.join(", ")
        )
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
        let in_f32 = if scalars[0] { subnormal::<f32>(rows, &self.at) } else { Vec::new() };
        let in_f64 = if scalars[1] { subnormal::<f64>(rows, &self.at) } else { Vec::new() };
        for (found, name) in [(in_f32, f32::NAME), (in_f64, f64::NAME)] {
            if !found.is_empty() && !self.output.quiet {
                eprintln!(
                    "warning: {} is subnormal in {name}: machines that flush to zero take it for 0",
                    found.join(", ")
                );
            }
        }
    }

    fn plan<'a, F: Scalar>(&self, row: &'a Row) -> Result<StudyPlan<'a, F>, Failure> {
        let chosen = self.gates(row).map_err(Failure::usage)?;
        let at = self.at.iter().map(|text| {
            let e = F::parse(text).filter(|e| e.is_finite()).ok_or_else(|| {
                let message = format!("--at: '{text}' is not a finite number of {}", F::NAME);
                Failure::usage(message)
            })?;
            let gates = row.entry.info.gates;
            match chosen.iter().find(|gate| e < floor::<F>(&gates[**gate])) {
                Some(gate) => Err(Failure::usage(format!(
                    "--at: gate '{}' refuses where {}: below 0 that is the same as 0, so {text} means nothing",
                    gates[*gate].name, gates[*gate].refuses
                ))),
                None => Ok(e),
            }
        });
        let at = at.collect::<Result<_, _>>()?;
        let name = row.entry.info.name;
        let subject = F::subject(row.entry)
            .ok_or_else(|| Failure::usage(format!("{name} does not run in {}", F::NAME)))?;
        Ok(StudyPlan { row, subject, at, gates: chosen, exact: self.exact })
    }
}

/// An error if a kernel takes too long to be asked for its margins.
fn tells_margins(entry: &Entry) -> Result<(), String> {
    if entry.tells_margins() {
        return Ok(());
    }
    Err(format!(
        "{}: a command is too slow to be asked at many epsilons a case (a --kernel-lib is not, nor is a command \
         that answers for margins: docs/protocol.md); `hairline audit --epsilon GATE=VALUE` runs it at one",
        entry.info.name
    ))
}

/// An error if a kernel failed on too many cases while its margins were looked for, or for good.
fn found_margins<F: Scalar>(name: &str, subject: &dyn Subject<F>) -> Result<(), Failure> {
    plugins::check()?;
    match subject.margins_gave_up() {
        None => Ok(()),
        Some(message) => {
            Err(Failure::Message(Status::BadInput, format!("kernel '{name}': {message}")))
        }
    }
}

/// A disagreement between margins and runs: a fault of this tool, or of a kernel whose gates nobody sees.
fn fault(entry: &Entry, error: String) -> Failure {
    if entry.shows_gates() {
        return Failure::Message(Status::SelfCheck, format!("self-check: {error}"));
    }
    let name = entry.info.name;
    Failure::Message(
        Status::BadInput,
        format!(
            "kernel '{name}': its epsilons do not each act alone, or its answers are not a function of the case and \
             the epsilons: {error}. Raising an epsilon must only refuse more, whatever the others are"
        ),
    )
}
