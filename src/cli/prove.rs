//! `hairline prove`: bounds that hold for every float of a domain, witnesses, certificates.

pub mod demand;
mod text;

use super::exit::{Failure, Status};
use super::flags::{chosen_scalars, unknown};
use super::input::{read_mesh, read_text};
use super::output::write_result;
use crate::arith::Float;
use crate::audit::EpsilonText;
use crate::corpus::InputError;
use crate::kernel::{self, Entry, PRESETS, Path, Role, Scalar};
use crate::prove::certificate::{Claim, Heading, heading, program};
use crate::prove::{
    BySize, Domain, Effort, Format, GOALS, GateSummary, Published, Quantity, Scene, Searched,
    Summary, Symmetry, about_edges, checker, fpcore, gappa, statements,
};
use crate::report::number_of;
use clap::{Args, ValueEnum};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// What to prove, and how to report it.
#[derive(Args)]
pub struct ProveArguments {
    /// A kernel, or several separated by commas; NAME+fma is NAME with fused products [default: all]
    #[arg(long, short, value_delimiter = ',', value_name = "NAME")]
    kernel: Vec<String>,

    /// f32, f64, or both separated by a comma
    #[arg(long, value_delimiter = ',', default_value = "f32,f64", value_name = "SCALAR")]
    scalar: Vec<String>,

    /// Only this gate
    #[arg(long, value_name = "NAME", conflicts_with_all = ["certificate", "update"])]
    gate: Option<String>,

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

    /// Search for witnesses: evaluations for each quantity and goal [default: the stored ones, and in a scene
    /// 20000 more]
    #[arg(long, short = 'n', value_name = "N")]
    evaluations: Option<u64>,

    /// Seed of the search
    #[arg(long, default_value_t = 1)]
    seed: u64,

    /// Keep the witnesses that are worse than those of this file (the unit domain only)
    #[arg(long, value_name = "FILE", conflicts_with_all = ["coordinates", "mesh", "certificate"])]
    update: Option<String>,

    /// Write the proofs of one kernel in one scalar to this file
    #[arg(long, value_name = "FILE")]
    certificate: Option<String>,

    /// Check certificates instead, by code that shares nothing with the prover
    #[arg(long, value_name = "FILE", num_args = 1.., conflicts_with_all = ["kernel", "certificate", "update", "coordinates", "mesh"])]
    check: Vec<String>,

    /// The format of the output
    #[arg(long, value_enum, default_value_t)]
    format: OutputFormat,

    /// Where to write; - is standard output
    #[arg(short, long, value_name = "FILE", default_value = "-")]
    output: String,

    /// Print no notes
    #[arg(long, short)]
    quiet: bool,
}

const SCENE: &str = "Scene (without one: everything at most 1)";

#[derive(Clone, Copy, Default, PartialEq, Eq, ValueEnum)]
enum OutputFormat {
    /// For people; not stable
    #[default]
    Text,
    /// One object, its schema versioned
    Json,
    /// Every compared quantity as an FPCore program (fpbench.org)
    Fpcore,
    /// A script for Gappa: the quantity of one --gate of one --kernel in one --scalar, its bound the goal
    Gappa,
}

fn range(text: &str) -> Result<[f64; 2], String> {
    let (low, high) = text.split_once("..").unwrap_or((text, text));
    let number = |text: &str| text.trim().parse().map_err(|_| format!("'{text}' is no number"));
    Ok([number(low)?, number(high)?])
}

fn degrees(text: &str) -> Result<f64, String> {
    let number = text.trim_end_matches("deg").trim();
    number.parse().map_err(|_| format!("'{text}' is no angle in degrees"))
}

/// The witnesses that the program was built with.
const KNOWN: &str = include_str!("../../corpora/proofs/witnesses.ndjson");

/// A stored witness.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct StoredWitness {
    kernel: String,
    scalar: String,
    gate: String,
    /// What it is a witness of: see `GOALS`.
    goal: String,
    /// The seventeen numbers, as bits in hexadecimal.
    inputs: Vec<String>,
    /// Its score in units of 2^-p. It is computed again whenever it is used.
    units: f64,
}

/// The record of a run.
#[derive(Serialize)]
struct Record {
    schema: &'static str,
    version: &'static str,
    domain: DomainPart,
    gates: Vec<GatePart>,
    kernels: Vec<KernelPart>,
}

#[derive(Serialize)]
struct DomainPart {
    edge: f64,
    reach: f64,
    world: f64,
    direction: f64,
    extent: f64,
    divisor_at_least: f64,
    quotient_at_most: f64,
}

/// One gate of one kernel in one scalar.
#[derive(Serialize)]
struct GatePart {
    kernel: String,
    scalar: &'static str,
    gate: &'static str,
    compares: &'static str,
    /// No computed number is farther from the exact one.
    bound: Option<f64>,
    /// The same in units of 2^-p.
    bound_units: Option<f64>,
    /// Why there is no bound.
    why: Option<String>,
    witness: Option<WitnessPart>,
    /// bound / witness
    factor: Option<f64>,
    /// What the bound supposes beside |d| <= 1.
    supposes: Vec<&'static str>,
    /// The largest computed number of a ray that is exactly parallel, of those known.
    parallel_passes: Option<WitnessPart>,
    /// A hit that is lost: how far below zero its computed number is, of those known.
    hit_lost: Option<WitnessPart>,
    statements: Vec<String>,
}

#[derive(Serialize)]
struct WitnessPart {
    value: f64,
    units: f64,
    inputs: Vec<String>,
}

/// What is said of a kernel as a whole.
#[derive(Serialize)]
struct KernelPart {
    kernel: String,
    scalar: &'static str,
    paths: usize,
    edges: &'static str,
    watertight: bool,
}

/// Runs the command.
pub fn run(arguments: &ProveArguments) -> Result<Status, Failure> {
    if !arguments.check.is_empty() {
        return check(arguments);
    }
    let entries = arguments.entries()?;
    let scalars = chosen_scalars(&arguments.scalar)?;
    let (scene, triangles) = arguments.scene()?;
    let domain = match &scene {
        Some(scene) => scene.domain().map_err(Failure::usage)?,
        None => Domain::UNIT,
    };
    let mut stored = match &arguments.update {
        Some(path) if std::fs::exists(path).map_err(|e| Failure::of_file(path, &e))? => {
            read_witnesses(&read_text(path)?, path)?
        }
        Some(_) => Vec::new(),
        None => read_witnesses(KNOWN, "corpora/proofs/witnesses.ndjson")?,
    };
    let default = if scene.is_some() { 20_000 } else { 0 };
    let effort =
        Effort { evaluations: arguments.evaluations.unwrap_or(default), seed: arguments.seed };
    if entries.len() == 1 {
        arguments.gate_of(entries[0])?;
    }
    if matches!(arguments.format, OutputFormat::Fpcore | OutputFormat::Gappa) {
        return export(arguments, &entries, scalars, domain);
    }
    if let Some(path) = &arguments.certificate {
        return certify(&entries, scalars, domain, path);
    }
    let published = arguments.kernel.len() == 1;
    let job = Job { scene, triangles, domain, effort, published, stored: &stored };
    let tasks: Vec<(&Entry, bool)> = entries
        .iter()
        .flat_map(|entry| [(*entry, false), (*entry, true)])
        .filter(|(_, is_f64)| scalars[usize::from(*is_f64)])
        .collect();
    let parts: Vec<Parts> = tasks
        .par_iter()
        .map(|(entry, is_f64)| if *is_f64 { job.run::<f64>(entry) } else { job.run::<f32>(entry) })
        .collect();
    let mut record = Record {
        schema: "hairline/proof-1",
        version: env!("CARGO_PKG_VERSION"),
        domain: DomainPart::new(&domain),
        gates: Vec::new(),
        kernels: Vec::new(),
    };
    let mut found = Vec::new();
    for part in parts {
        if let Some(message) = part.contradiction {
            return Err(Failure::Message(Status::SelfCheck, message));
        }
        let wanted =
            |part: &GatePart| arguments.gate.as_deref().is_none_or(|name| name == part.gate);
        record.gates.extend(part.gates.into_iter().filter(wanted));
        record.kernels.extend(part.kernel);
        found.extend(part.witnesses);
        if let Some(note) = part.note.filter(|_| !arguments.quiet) {
            eprintln!("{note}");
        }
    }
    if record.gates.is_empty() {
        let message = "no chosen kernel has a program that can be recorded".to_owned();
        return Err(Failure::Message(Status::NothingSelected, message));
    }
    if let Some(path) = &arguments.update {
        let raised = merge(&mut stored, found);
        write_result(path, |out| {
            stored.iter().try_for_each(|witness| {
                serde_json::to_writer(&mut *out, witness)?;
                writeln!(out)
            })
        })?;
        eprintln!("{path}: {raised} of {} witnesses are new or worse", stored.len());
    }
    write_result(&arguments.output, |out| match arguments.format {
        OutputFormat::Json => {
            serde_json::to_writer_pretty(&mut *out, &record)?;
            writeln!(out)
        }
        OutputFormat::Fpcore | OutputFormat::Gappa => unreachable!("handled above"),
        OutputFormat::Text if entries.len() == 1 => text::kernel(&record, scene.as_ref(), out),
        OutputFormat::Text => text::table(&record, scene.as_ref(), out),
    })?;
    Ok(Status::Success)
}

/// What is the same for all kernels.
struct Job<'a> {
    scene: Option<Scene>,
    /// Of a mesh: the largest coordinate of each triangle's edges.
    triangles: Vec<f64>,
    domain: Domain,
    effort: Effort,
    /// Whether to say of every published epsilon how far it carries.
    published: bool,
    stored: &'a [StoredWitness],
}

/// What comes out for a kernel in a scalar.
#[derive(Default)]
struct Parts {
    gates: Vec<GatePart>,
    kernel: Option<KernelPart>,
    witnesses: Vec<StoredWitness>,
    note: Option<String>,
    /// A witness above its bound.
    contradiction: Option<String>,
}

impl Job<'_> {
    fn run<F: Searched + Scalar>(&self, entry: &Entry) -> Parts {
        let name = entry.info.name;
        let is_of = |w: &&StoredWitness| w.kernel == name && w.scalar == F::NAME;
        let known: Vec<[F; 17]> =
            self.stored.iter().filter(is_of).filter_map(StoredWitness::numbers).collect();
        let summary = match Summary::<F>::new(entry, self.domain, &known, self.effort) {
            Ok(summary) => summary,
            Err(why) => {
                let note = Some(format!("{name}, {}: no proof: {why}", F::NAME));
                return Parts { note, ..Parts::default() };
            }
        };
        if let Some(contradiction) = summary.contradiction() {
            let contradiction = Some(format!("self-check: {name}, {}: {contradiction}", F::NAME));
            return Parts { contradiction, ..Parts::default() };
        }
        let unit = summary.format.unit().to_f64();
        let part = |gate: &GateSummary<F>| {
            let witness = |i: usize| {
                gate.witnesses[i].filter(|w| w.score > 0.0).map(|w| WitnessPart {
                    value: w.score,
                    units: w.score / unit,
                    inputs: w.inputs.iter().map(|x| x.hex()).collect(),
                })
            };
            let published = if self.published { published::<F>(entry, gate) } else { Vec::new() };
            GatePart {
                kernel: name.to_owned(),
                scalar: F::NAME,
                gate: gate.gate.name,
                compares: gate.gate.refuses,
                bound: gate.bound.as_ref().ok().map(|bound| bound.to_f64()),
                bound_units: gate.bound.as_ref().ok().map(|bound| bound.to_f64() / unit),
                why: gate.bound.as_ref().err().cloned(),
                witness: witness(0),
                factor: gate.factor(),
                supposes: supposes(gate),
                parallel_passes: witness(1),
                hit_lost: witness(2),
                statements: statements(entry, &summary, gate, self.scene.as_ref(), &published)
                    .into_iter()
                    .chain(self.by_triangle::<F>(entry, gate, &published))
                    .collect(),
            }
        };
        let witnesses = summary.gates.iter().flat_map(|gate| {
            gate.witnesses.iter().zip(GOALS).filter_map(move |(witness, goal)| {
                let witness = witness.filter(|witness| witness.score > 0.0)?;
                Some(StoredWitness {
                    kernel: name.to_owned(),
                    scalar: F::NAME.to_owned(),
                    gate: gate.gate.name.to_owned(),
                    goal: goal.name().to_owned(),
                    inputs: witness.inputs.iter().map(|x| x.hex()).collect(),
                    units: witness.score / unit,
                })
            })
        });
        Parts {
            witnesses: witnesses.collect(),
            kernel: Some(KernelPart {
                kernel: name.to_owned(),
                scalar: F::NAME,
                paths: summary.proof.paths.len(),
                edges: about_edges(summary.symmetry),
                watertight: summary.symmetry == Symmetry::ExactSigns,
            }),
            gates: summary.gates.iter().map(part).collect(),
            ..Parts::default()
        }
    }
}

impl Job<'_> {
    /// What each triangle's own bound says of a gate that knows nothing but its edges.
    fn by_triangle<F: Searched + Scalar>(
        &self,
        entry: &Entry,
        gate: &GateSummary<F>,
        published: &[Published],
    ) -> Option<String> {
        let is_of_edges = gate.gate.role == Role::Parallel && gate.uses.is_of_edges_alone();
        if self.triangles.is_empty() || !is_of_edges {
            return None;
        }
        let mut sizes = BySize::<F>::new(entry, gate.index)?;
        let own = self.triangles.iter().filter_map(|size| sizes.bound(*size));
        let mut bounds: Vec<f64> = own.map(|bound| bound.to_f64()).collect();
        bounds.sort_by(f64::total_cmp);
        let (least, most) = (bounds.first()?, bounds.last()?);
        let mut text = format!(
            "Triangle by triangle the bound goes from {least:.2e} to {most:.2e}; half of them are below {:.2e}.",
            bounds[bounds.len() / 2]
        );
        for (name, value) in published.iter().filter(|(_, value)| *value > 0.0) {
            let count = bounds.iter().filter(|bound| *bound < value).count();
            let of = self.triangles.len();
            text +=
                &format!(" e = {name} refuses every parallel ray at {count} of {of} triangles.");
        }
        Some(text)
    }
}

impl DomainPart {
    fn new(domain: &Domain) -> DomainPart {
        DomainPart {
            edge: domain.edge.to_f64(),
            reach: domain.reach.to_f64(),
            world: domain.world.to_f64(),
            direction: domain.direction.to_f64(),
            extent: domain.extent.to_f64(),
            divisor_at_least: domain.floor.to_f64(),
            quotient_at_most: domain.quotient.to_f64(),
        }
    }
}

fn supposes<F>(gate: &GateSummary<F>) -> Vec<&'static str> {
    let uses = gate.uses;
    let all = [
        (uses.edge, "edges"),
        (uses.reach, "origin to vertices"),
        (uses.world, "coordinates"),
        (uses.extent, "t_min and t_max"),
        (uses.floor, "divisors"),
    ];
    all.into_iter().filter(|(is_used, _)| *is_used).map(|(_, name)| name).collect()
}

/// The epsilons of the kernel's own sets and of the presets that fit a gate.
fn published<F: Float>(entry: &Entry, gate: &GateSummary<F>) -> Vec<Published> {
    let own = entry.info.epsilon_sets.iter().map(|set| (set.name, set.values[gate.index]));
    let own = own.filter_map(|(name, text)| Some((name, EpsilonText::of(text)?)));
    let presets = PRESETS.iter().flat_map(|preset| {
        let fitting = preset.entries.iter().filter(|entry| entry.fits(&gate.gate));
        fitting.map(|entry| (preset.name, EpsilonText::from(entry.value)))
    });
    let mut found: Vec<Published> = Vec::new();
    for (name, text) in own.chain(presets) {
        let Some(value) = text.value::<F>().map(F::to_f64) else { continue };
        match found.iter_mut().find(|(_, known)| *known == value) {
            Some((names, _)) => names.insert_str(names.len() - 1, &format!(", {name}")),
            None => found.push((format!("{text} ({name})"), value)),
        }
    }
    found
}

impl ProveArguments {
    fn entries(&self) -> Result<Vec<&'static Entry>, Failure> {
        if self.kernel.is_empty() {
            return Ok(kernel::all().into_iter().filter(|entry| entry.shows_gates()).collect());
        }
        let find = |name: &String| {
            let names = || kernel::all().into_iter().map(|entry| entry.info.name);
            kernel::find(name)
                .ok_or_else(|| unknown("kernel", name, names(), "hairline list kernels"))
        };
        self.kernel.iter().map(find).collect()
    }

    /// The place of the chosen gate.
    fn gate_of(&self, entry: &Entry) -> Result<Option<usize>, Failure> {
        let Some(name) = &self.gate else { return Ok(None) };
        let gates = || entry.info.gates.iter().map(|gate| gate.name);
        let found = gates().position(|gate| gate == name);
        let list = format!("hairline prove --kernel {}", entry.info.name);
        found.map(Some).ok_or_else(|| unknown("gate", name, gates(), &list))
    }

    /// The scene, and of a mesh the largest coordinate of each triangle's edges.
    fn scene(&self) -> Result<(Option<Scene>, Vec<f64>), Failure> {
        if let Some(path) = &self.mesh {
            let distance = self.distance.expect("required by --mesh");
            let (scene, sizes) = mesh_scene(path, distance, self.grazing, self.quiet)?;
            return Ok((Some(scene), sizes));
        }
        let Some(edge) = self.edge else {
            return match self.distance {
                Some(_) => {
                    Err(Failure::usage("--distance needs --coordinates and --edge, or --mesh"))
                }
                None => Ok((None, Vec::new())),
            };
        };
        let Some(coordinates) = self.coordinates else {
            return Err(Failure::usage(
                "--edge needs --coordinates: how far from 0 the scene reaches",
            ));
        };
        let distance = self.distance.unwrap_or(2.0 * coordinates);
        let (min_angle, grazing) = (self.min_angle, self.grazing);
        Ok((Some(Scene { coordinates, edge, distance, min_angle, grazing }), Vec::new()))
    }
}

/// The scene that a mesh is.
fn mesh_scene(
    path: &str,
    distance: f64,
    grazing: f64,
    quiet: bool,
) -> Result<(Scene, Vec<f64>), Failure> {
    let mut triangles = Vec::new();
    let mesh = read_mesh(path, quiet)?;
    let mut edge = [f64::INFINITY, 0.0f64];
    let (mut min_angle, mut coordinates) = (180.0f64, 0.0f64);
    for triangle in 0..mesh.triangles.len() {
        let vertices = mesh.vertices::<f64>(triangle);
        let length = |p: [f64; 3], q: [f64; 3]| {
            (0..3).map(|i| (p[i] - q[i]) * (p[i] - q[i])).sum::<f64>().sqrt()
        };
        let sides = [0, 1, 2].map(|i| length(vertices[i], vertices[(i + 1) % 3]));
        let angle = (0..3).map(|i| {
            let [a, b, c] = [0, 1, 2].map(|k| sides[(i + k) % 3]);
            ((b * b + c * c - a * a) / (2.0 * b * c)).clamp(-1.0, 1.0).acos().to_degrees()
        });
        let angle = angle.fold(180.0, f64::min);
        if angle.is_nan() || angle <= 0.0 {
            continue;
        }
        let size = |(p, q): (usize, usize)| {
            (0..3).map(move |i| (vertices[p][i] - vertices[q][i]).abs()).fold(0.0, f64::max)
        };
        triangles.push([(0, 1), (1, 2), (2, 0)].map(size).into_iter().fold(0.0, f64::max));
        for side in sides {
            edge = [edge[0].min(side), edge[1].max(side)];
        }
        min_angle = min_angle.min(angle);
        let sizes = vertices.iter().flatten().map(|x| x.abs());
        coordinates = sizes.fold(coordinates, f64::max);
    }
    if edge[1] == 0.0 {
        return Err(InputError::of(path, "no triangle with an area").into());
    }
    // Origins are up to the distance away from the vertices.
    let coordinates = coordinates + distance;
    Ok((Scene { coordinates, edge, distance, min_angle, grazing }, triangles))
}

impl StoredWitness {
    fn numbers<F: Float>(&self) -> Option<[F; 17]> {
        let bits = |text: &String| u64::from_str_radix(text, 16).ok().map(F::from_bits);
        let numbers: Vec<F> = self.inputs.iter().map(bits).collect::<Option<_>>()?;
        numbers.try_into().ok()
    }
}

fn read_witnesses(text: &str, path: &str) -> Result<Vec<StoredWitness>, Failure> {
    let lines = text.lines().enumerate().filter(|(_, line)| !line.trim().is_empty());
    lines
        .map(|(i, line)| {
            let witness: StoredWitness = serde_json::from_str(line)
                .map_err(|error| InputError::at(path, i + 1, error.to_string()))?;
            if witness.numbers::<f64>().is_none() {
                return Err(InputError::at(path, i + 1, "not seventeen numbers as bits").into());
            }
            Ok(witness)
        })
        .collect()
}

/// Puts found witnesses into the table; how many are new or worse than those there.
fn merge(stored: &mut Vec<StoredWitness>, found: Vec<StoredWitness>) -> usize {
    let key =
        |w: &StoredWitness| (w.kernel.clone(), w.scalar.clone(), w.gate.clone(), w.goal.clone());
    let mut table: BTreeMap<_, StoredWitness> = stored.drain(..).map(|w| (key(&w), w)).collect();
    let mut raised = 0;
    for witness in found {
        let known = table.get(&key(&witness));
        if known.is_none_or(|known| known.units < witness.units) {
            raised += 1;
            table.insert(key(&witness), witness);
        }
    }
    stored.extend(table.into_values());
    raised
}

/// Writes the certificate of one kernel in one scalar.
fn certify(
    entries: &[&'static Entry],
    scalars: [bool; 2],
    domain: Domain,
    path: &str,
) -> Result<Status, Failure> {
    let ([entry], [true, false] | [false, true]) = (entries, scalars) else {
        return Err(Failure::usage("--certificate is of one --kernel in one --scalar"));
    };
    let text = if scalars[0] {
        certificate::<f32>(entry, domain)
    } else {
        certificate::<f64>(entry, domain)
    };
    let text = text.map_err(|why| {
        let message = format!("{}: no certificate: {why}", entry.info.name);
        Failure::Message(Status::NothingSelected, message)
    })?;
    write_result(path, |out| out.write_all(text.as_bytes()))?;
    Ok(Status::Success)
}

fn certificate<F: Searched + Scalar>(entry: &Entry, domain: Domain) -> Result<String, String> {
    let effort = Effort { evaluations: 0, seed: 1 };
    let summary = Summary::<F>::new(entry, domain, &[], effort)?;
    let head = Heading {
        kernel: entry.info.name,
        scalar: F::NAME,
        format: summary.format,
        domain: summary.domain,
    };
    let mut text = heading(&head);
    let mut is_empty = true;
    for quantity in summary.proof.quantities.iter().filter(|q| q.bound.is_ok()) {
        let claim = Claim { gate: entry.info.gates[quantity.gate].name, place: quantity.place };
        text.push_str(&program(&summary.proof.paths[quantity.path], &quantity.lemmas, &[claim]));
        is_empty = false;
    }
    if is_empty { Err("no gate has a bound in this domain".to_owned()) } else { Ok(text) }
}

/// Checks certificates, and says what they prove.
fn check(arguments: &ProveArguments) -> Result<Status, Failure> {
    let mut lines = Vec::new();
    for file in &arguments.check {
        let proved = checker::check(&read_text(file)?)
            .map_err(|refusal| InputError::at(file, refusal.line, refusal.message))?;
        let bounds = number_of(proved.len() as u64, "bound", "bounds");
        lines.push(format!("{file}: {bounds} proved"));
    }
    write_result(&arguments.output, |out| {
        lines.iter().try_for_each(|line| writeln!(out, "{line}"))
    })?;
    Ok(Status::Success)
}

/// The programs of all quantities, or of those of one gate, or (if true) of its worst one.
fn programs<F: Searched + Scalar>(
    entry: &Entry,
    domain: Domain,
    only: Option<(usize, bool)>,
    text: &mut String,
    write: impl Fn(&Path, &Quantity, Domain, Format, &str) -> Option<String>,
) -> Result<(), String> {
    let effort = Effort { evaluations: 0, seed: 1 };
    let summary = Summary::<F>::new(entry, domain, &[], effort)?;
    let mut numbers = vec![0; entry.info.gates.len()];
    let one = only.filter(|(_, one)| *one).and_then(|(gate, _)| summary.proof.gate(gate)?.ok());
    for quantity in &summary.proof.quantities {
        numbers[quantity.gate] += 1;
        let is_other = one.is_some_and(|one| !std::ptr::eq(one, quantity));
        if is_other || only.is_some_and(|(gate, _)| gate != quantity.gate) {
            continue;
        }
        let (gate, number) = (entry.info.gates[quantity.gate].name, numbers[quantity.gate]);
        let name = format!("{} {} {gate} {number}", entry.info.name, F::NAME);
        let path = &summary.proof.paths[quantity.path];
        if let Some(program) = write(path, quantity, summary.domain, summary.format, &name) {
            text.push_str(&program);
            text.push('\n');
        }
    }
    Ok(())
}

/// Writes the programs of the chosen kernels in a language of other tools.
fn export(
    arguments: &ProveArguments,
    entries: &[&'static Entry],
    scalars: [bool; 2],
    domain: Domain,
) -> Result<Status, Failure> {
    let write = |path: &Path, quantity: &Quantity, domain: Domain, format: Format, name: &str| {
        match arguments.format {
            OutputFormat::Gappa => {
                let goal = quantity.bound.as_ref().ok().map(|bound| bound.error);
                gappa(path, quantity.place, domain, format, name, goal).ok()
            }
            _ => Some(fpcore(path, quantity.place, domain, format, name)),
        }
    };
    let is_one = entries.len() == 1 && scalars[0] != scalars[1] && arguments.gate.is_some();
    if arguments.format == OutputFormat::Gappa && !is_one {
        return Err(Failure::usage(
            "--format gappa is of one --kernel, one --scalar and one --gate",
        ));
    }
    let mut text = String::new();
    for entry in entries {
        let gate = arguments.gate_of(entry)?;
        let only = gate.map(|gate| (gate, arguments.format == OutputFormat::Gappa));
        let of_f32 = scalars[0].then(|| programs::<f32>(entry, domain, only, &mut text, write));
        let of_f64 = scalars[1].then(|| programs::<f64>(entry, domain, only, &mut text, write));
        let failed = [of_f32, of_f64].into_iter().flatten().find_map(Result::err);
        if let Some(why) = failed.filter(|_| !arguments.quiet) {
            eprintln!("{}: no program: {why}", entry.info.name);
        }
    }
    if text.is_empty() {
        let message = "no chosen kernel has such a program".to_owned();
        return Err(Failure::Message(Status::NothingSelected, message));
    }
    write_result(&arguments.output, |out| out.write_all(text.as_bytes()))?;
    Ok(Status::Success)
}

/// A scene's words.
fn scene_text(scene: &Scene) -> String {
    let short = |x: f64| format!("{x:.4}").trim_end_matches('0').trim_end_matches('.').to_owned();
    let digits = |x: f64| if x < 0.001 { format!("{x:.2e}") } else { short(x) };
    let Scene { coordinates, edge: [low, high], distance, min_angle, grazing } = *scene;
    let [coordinates, low, high, distance, min_angle, grazing] =
        [coordinates, low, high, distance, min_angle, grazing].map(digits);
    format!(
        "coordinates up to {coordinates}, edges from {low} to {high}, origins up to {distance} from the \
         vertices, angles of {min_angle} degrees and more, rays at {grazing} degrees to the plane and more, |d| <= 1"
    )
}
