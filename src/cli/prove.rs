//! `hairline prove`: bounds that hold for every float of a domain, witnesses, certificates.

mod certify;
pub mod check;
pub mod demand;
mod job;
mod leaks;
mod scenes;
mod sizes;
mod witnesses;

use super::exit::{Failure, Status};
use super::flags::{chosen_scalars, find_kernel, unknown};
use super::input::read_text;
use super::output::{OutputArguments, write_json_lines};
use crate::audit::{EpsilonChoice, Row};
use crate::command::named_file::SizeLimit;
use crate::engine;
use crate::kernel::{self, Entry};
use crate::prove::{Domain, Effort};
use crate::record::{Context, ProofPart, Record, provenance_of};
use crate::report::proofs::{DomainPart, GatePart, ProofResult, Report};
use crate::report::{Format, write_json};
use certify::certify;
use clap::Args;
use job::{Epsilons, Job, Parts};
use leaks::leak;
use scenes::{degrees, range, scene_text};
use sizes::DemandedSize;
use std::time::Instant;
use witnesses::{KNOWN, merge, read_witnesses};

/// The flags of `prove`: the kernels, and how to report.
#[derive(Args)]
pub struct ProveArguments {
    /// A kernel, or several separated by commas; NAME+fma is NAME with fused products [default: all]
    #[arg(long, short, value_delimiter = ',', value_name = "NAME")]
    kernel: Vec<String>,

    /// Only to say why not
    #[arg(long, hide = true)]
    kernel_lib: Vec<String>,

    /// Only to say why not
    #[arg(long, hide = true)]
    kernel_cmd: Vec<String>,

    /// f32, f64, or both separated by a comma
    #[arg(
        long,
        value_delimiter = ',',
        default_value = "f32,f64",
        value_name = "SCALAR"
    )]
    scalar: Vec<String>,

    /// Only this gate
    #[arg(long, value_name = "NAME", conflicts_with_all = ["certificate", "update"])]
    gate: Option<String>,

    /// Epsilons to prove something about, as parallel=1e-7,edge=0, instead of the published ones
    #[arg(long, value_name = "GATE=VALUE,...", allow_hyphen_values = true)]
    epsilon: Option<String>,

    /// A scene as `epsilon` takes it: a preset such as room, or a few numbers
    #[arg(long, value_name = "SCENE", conflicts_with_all = ["coordinates", "edge", "distance", "mesh"], help_heading = SCENE)]
    scene: Option<String>,

    /// A scene: every coordinate of origins and vertices is at most this
    #[arg(long, value_name = "LENGTH", requires = "edge", help_heading = SCENE)]
    coordinates: Option<f64>,

    /// A scene: the shortest and the longest edge, as 0.01..10
    #[arg(long, value_name = "MIN..MAX", value_parser = range, help_heading = SCENE)]
    edge: Option<[f64; 2]>,

    /// A scene: from a ray's origin to a vertex at most [default: twice the coordinates]
    #[arg(long, value_name = "LENGTH", help_heading = SCENE)]
    distance: Option<f64>,

    /// A scene: no angle of a triangle is smaller
    #[arg(long, value_name = "DEGREES", default_value = "1", value_parser = degrees, help_heading = SCENE)]
    min_angle: f64,

    /// A scene: no ray of interest meets a plane at a smaller angle
    #[arg(long, value_name = "DEGREES", default_value = "1", value_parser = degrees, help_heading = SCENE)]
    grazing: f64,

    /// A scene: coordinates, edges and angles of this mesh, with rays from --distance at most
    #[arg(long, value_name = "FILE", conflicts_with_all = ["coordinates", "edge", "min_angle"], requires = "distance", help_heading = SCENE)]
    mesh: Option<String>,

    /// Search for witnesses: evaluations for each quantity and goal [default: the stored ones; in a scene and with
    /// --epsilon 20000 more]
    #[arg(long, short = 'n', value_name = "N")]
    evaluations: Option<u64>,

    /// Seed of the search
    #[arg(long, default_value_t = 1)]
    seed: u64,

    /// Write the worst witnesses to this file: those found, or those that it has (the unit domain only)
    #[arg(long, value_name = "FILE", conflicts_with_all = ["coordinates", "scene", "mesh", "certificate", "epsilon"])]
    update: Option<String>,

    /// Write the proofs of one kernel in one scalar to this file
    #[arg(long, value_name = "FILE")]
    certificate: Option<String>,

    /// Check certificates instead, by code that shares nothing with the prover
    #[arg(long, value_name = "FILE", num_args = 1.., conflicts_with_all = ["kernel", "certificate", "update", "coordinates", "scene", "mesh"])]
    check: Vec<String>,

    /// With --check: fail unless the domain of each certificate covers these sizes, named as in its line `domain`
    #[arg(long, value_name = "NAME=SIZE,...", value_delimiter = ',', value_parser = DemandedSize::parse, requires = "check")]
    demand_domain: Vec<DemandedSize>,

    #[command(flatten)]
    output: OutputArguments,
}

const SCENE: &str = "Scene (without one: everything at most 1)";

/// One row per format.
const FORMATS: &[Format<Report>] = &[
    Format::TEXT,
    Format {
        name: "json",
        write: |report, _, out| write_json(&report.record, out),
    },
    Format::MARKDOWN,
    Format::HTML,
];

/// The proofs about the kernels of some rows, each once, with the witnesses that the program was built with.
pub fn proofs(rows: &[Row], scalars: [bool; 2]) -> Vec<ProofPart> {
    let stored =
        read_witnesses(KNOWN, "corpora/proofs/witnesses.ndjson").expect("tests read these");
    let mut entries: Vec<&Entry> = rows.iter().map(|row| row.entry).collect();
    entries.dedup_by_key(|entry| entry.info.name);
    let job = Job {
        scene: None,
        shapes: Vec::new(),
        domain: Domain::UNIT,
        parts: Vec::new(),
        effort: Effort::NONE,
        epsilons: Epsilons::None,
        stored: &stored,
        shared: false,
    };
    let parts = job.run_all(&entries, scalars, true);
    parts.into_iter().filter_map(Parts::in_short).collect()
}

/// Runs the command.
pub fn run(arguments: &ProveArguments) -> Result<Status, Failure> {
    if !arguments.kernel_lib.is_empty() || !arguments.kernel_cmd.is_empty() {
        return Err(Failure::usage(
            "prove needs a kernel's formula, and a library or a command shows only its answers: name the built-in \
             kernel of the same formula (--kernel moller-trumbore; `hairline list kernels` has all), or write yours \
             in Rust against hairline::Kernel",
        ));
    }
    if !arguments.check.is_empty() {
        return check::check(arguments);
    }
    let entries = arguments.entries()?;
    let scalars = chosen_scalars(&arguments.scalar)?;
    let (scene, shapes) = arguments.scene()?;
    let domain = match &scene {
        Some(scene) => scene.domain().map_err(Failure::usage)?,
        None => Domain::UNIT,
    };
    let parts = scene
        .as_ref()
        .map_or(Vec::new(), |scene| scene.parts(&shapes));
    let mut stored = match &arguments.update {
        Some(path) if std::fs::exists(path).map_err(|e| Failure::of_file(path, &e))? => {
            read_witnesses(&read_text(path, SizeLimit::CASES)?, path)?
        }
        Some(_) => Vec::new(),
        None => read_witnesses(KNOWN, "corpora/proofs/witnesses.ndjson")?,
    };
    // Stored witnesses are of the unit domain, at the epsilons of the sources.
    let is_stored = scene.is_none() && arguments.epsilon.is_none();
    let default = if is_stored { 0 } else { 20_000 };
    let effort = Effort {
        evaluations: arguments.evaluations.unwrap_or(default),
        seed: arguments.seed,
    };
    if let ([entry], Some(gate)) = (&entries[..], &arguments.gate) {
        ensure_gate(entry, gate)?;
    }
    let outputs = arguments.output.pairs(FORMATS)?;
    if let Some(path) = &arguments.certificate {
        let status = certify(
            &entries,
            scalars,
            (domain, &parts),
            (path, arguments.output.quiet),
        )?;
        let OutputArguments { format, output, .. } = &arguments.output;
        if format.is_empty() && output.is_empty() {
            return Ok(status);
        }
    }
    if arguments.epsilon.is_some() && entries.len() != 1 {
        return Err(Failure::usage("--epsilon is of one --kernel"));
    }
    let epsilons = arguments.epsilons(&entries)?;
    let shared = arguments.update.is_some();
    let job = Job {
        scene,
        shapes,
        domain,
        parts,
        effort,
        epsilons,
        stored: &stored,
        shared,
    };
    let started = Instant::now();
    let results = job.run_all(&entries, scalars, arguments.output.quiet);
    let mut result = ProofResult {
        domain: DomainPart::new(&domain),
        gates: Vec::new(),
        kernels: Vec::new(),
    };
    let mut found = Vec::new();
    for part in results {
        if let Some(message) = part.contradiction {
            return Err(Failure::self_check(message));
        }
        let wanted = |part: &GatePart| {
            arguments
                .gate
                .as_deref()
                .is_none_or(|name| name == part.gate)
        };
        result.gates.extend(part.gates.into_iter().filter(wanted));
        result.kernels.extend(part.kernel);
        found.extend(part.witnesses);
        if let Some(note) = part.note.filter(|_| !arguments.output.quiet) {
            eprintln!("{note}");
        }
    }
    if result.gates.is_empty() {
        return Err(Failure::nothing(
            "no chosen kernel has a program that can be recorded",
        ));
    }
    if let Some(path) = &arguments.update {
        let changed = merge(&mut stored, found);
        write_json_lines(path, &stored)?;
        eprintln!(
            "{path}: {changed} of {} witnesses have changed",
            stored.len()
        );
    }
    if let [entry] = entries[..] {
        for kernel in result.kernels.iter_mut().filter(|kernel| kernel.may_leak) {
            kernel.leak = in_named_scalar!(kernel.scalar, F => leak::<F>(entry));
        }
    }
    let seconds = started.elapsed().as_secs_f64();
    let context = Context {
        seconds,
        threads: engine::threads(),
    };
    let report = Report {
        record: Record::new(result, provenance_of(&context)),
        scene: scene.as_ref().map(scene_text),
        rays: arguments.rays(),
        is_of_one: entries.len() == 1,
    };
    arguments.output.write(outputs, &report)?;
    Ok(Status::Success)
}

/// An error if a kernel has no gate of this name.
fn ensure_gate(entry: &Entry, name: &str) -> Result<(), Failure> {
    let gates = || entry.info.gates.iter().map(|gate| gate.name);
    let list = format!("hairline prove --kernel {}", entry.info.name);
    let found = gates().find(|gate| *gate == name);
    found
        .map(|_| ())
        .ok_or_else(|| unknown("gate", name, gates(), &list))
}

impl ProveArguments {
    fn entries(&self) -> Result<Vec<&'static Entry>, Failure> {
        if self.kernel.is_empty() {
            let shown = [kernel::unnamed(), kernel::all()].map(|mut entries| {
                entries.retain(|entry| entry.shows_gates());
                entries
            });
            let [own, all] = shown;
            return Ok(if own.is_empty() { all } else { own });
        }
        self.kernel.iter().map(|name| find_kernel(name)).collect()
    }

    /// The epsilons that something is proved about.
    fn epsilons(&self, entries: &[&'static Entry]) -> Result<Epsilons, Failure> {
        let Some(text) = &self.epsilon else {
            let one = self.kernel.len() == 1;
            return Ok(if one {
                Epsilons::Published
            } else {
                Epsilons::None
            });
        };
        let choice = EpsilonChoice::parse(text)
            .map_err(|error| Failure::usage(format!("--epsilon: {error}")))?;
        // As an audit would refuse them.
        let scalars = chosen_scalars(&self.scalar)?;
        let rows = choice.rows(entries, None)?;
        rows.iter().try_for_each(|row| row.check_in(scalars))?;
        Ok(Epsilons::Given(choice.given().to_vec()))
    }
}
