//! One kernel in one scalar: what is proved of it, as parts of the record.

use super::witnesses::StoredWitness;
use crate::arith::{Float, ScalarName};
use crate::audit::{EpsilonChoice, EpsilonText, Observer, Row};
use crate::cli::progress::Progress;
use crate::kernel::{Entry, PRESETS, Scalar};
use crate::prove::{
    Domain, Effort, GOALS, GateSummary, Judged, Published, Scene, Searched, Shape, Summary,
    Symmetry, Triangles, USELESS, VERDICTS, about_edges, statements, useful_scenes,
};
use crate::record::{ProofPart, ProvedGate};
use crate::report::proofs::{GatePart, KernelPart, LimitPart, VerdictPart, WitnessPart};
use rayon::prelude::*;

/// The settings that are the same for all kernels.
pub struct Job<'a> {
    pub scene: Option<Scene>,
    /// The sizes and areas of its triangles.
    pub shapes: Vec<Shape>,
    pub domain: Domain,
    /// Its parts, if it has some.
    pub parts: Vec<Domain>,
    pub effort: Effort,
    /// The epsilons of which to say how far they carry.
    pub epsilons: Epsilons,
    pub stored: &'a [StoredWitness],
    /// True if the stored witnesses of other kernels are tried too.
    pub shared: bool,
}

/// The epsilons of which to say how far they carry.
pub enum Epsilons {
    /// No epsilons.
    None,
    /// Those of the kernel's sets and of the presets.
    Published,
    /// These, by gate.
    Given(Vec<(String, String)>),
}

impl Epsilons {
    /// The row of a kernel whose verdicts are proved: with the epsilons of its source, where nothing else is given.
    fn row(&self, entry: &'static Entry) -> Option<Row> {
        let choice = match self {
            Epsilons::Given(all) => EpsilonChoice::Given(all.clone()),
            _ => EpsilonChoice::Source,
        };
        choice.rows(&[entry], None).ok()?.into_iter().next()
    }

    /// Those of a gate, with their names.
    fn of<F: Float>(&self, entry: &Entry, gate: &GateSummary<F>) -> Vec<Published> {
        match self {
            Epsilons::None => Vec::new(),
            Epsilons::Published => published::<F>(entry, gate),
            Epsilons::Given(all) => {
                let of_gate = all.iter().filter(|(name, _)| name == gate.gate.name);
                let value = |text: &str| EpsilonText::of(text)?.value::<F>().map(F::to_f64);
                of_gate
                    .filter_map(|(_, text)| Some((text.clone(), value(text)?)))
                    .collect()
            }
        }
    }
}

/// The results for a kernel in a scalar.
#[derive(Default)]
pub struct Parts {
    pub gates: Vec<GatePart>,
    pub kernel: Option<KernelPart>,
    pub witnesses: Vec<StoredWitness>,
    pub note: Option<String>,
    /// A witness above its bound.
    pub contradiction: Option<String>,
}

impl Parts {
    /// As a report shows it beside the gates; none without a program.
    pub fn in_short(self) -> Option<ProofPart> {
        let KernelPart {
            kernel,
            scalar,
            edges,
            ..
        } = self.kernel?;
        let gates = self.gates.into_iter().map(|gate| {
            let known = gate.witness.map(|witness| witness.units);
            (
                gate.gate,
                ProvedGate {
                    bound: gate.bound_units,
                    known,
                },
            )
        });
        Some(ProofPart {
            kernel,
            scalar,
            edges,
            gates: gates.collect(),
        })
    }
}

impl Job<'_> {
    /// Proves and searches for each kernel in each chosen scalar.
    pub fn run_all(
        &self,
        entries: &[&'static Entry],
        scalars: [bool; 2],
        quiet: bool,
    ) -> Vec<Parts> {
        let of = |entry: &&'static Entry| {
            let entry = *entry;
            ScalarName::among(scalars).map(move |name| (entry, name))
        };
        let tasks: Vec<(&'static Entry, ScalarName)> = entries.iter().flat_map(of).collect();
        let progress = Progress::new(tasks.len() as u64, "proofs", quiet);
        let run = |(entry, name): &(&'static Entry, ScalarName)| {
            let parts = in_named_scalar!(*name, F => self.run::<F>(entry));
            progress.advance(1);
            parts
        };
        let all = tasks.par_iter().map(run).collect();
        progress.finish();
        all
    }

    /// Proves and searches.
    pub fn run<F: Searched + Scalar>(&self, entry: &'static Entry) -> Parts {
        let name = entry.info.name;
        // A search begins at the witnesses of the other scalar too.
        let is_scalar = |w: &StoredWitness| w.scalar == F::NAME || 0 < self.effort.evaluations;
        let is_of = |w: &&StoredWitness| is_scalar(w) && (self.shared || w.kernel == name);
        let known: Vec<[F; 17]> = self
            .stored
            .iter()
            .filter(is_of)
            .filter_map(StoredWitness::nearest)
            .collect();
        let summary = match Summary::<F>::new(entry, self.domain, &self.parts, &known, self.effort)
        {
            Ok(summary) => summary,
            Err(why) => {
                let note = Some(format!("{name}, {}: no proof: {why}", F::NAME));
                return Parts {
                    note,
                    ..Parts::default()
                };
            }
        };
        let row = self.epsilons.row(entry);
        let judged = row.as_ref().and_then(|row| {
            let whole = [self.domain];
            let parts = if self.parts.is_empty() {
                &whole[..]
            } else {
                &self.parts
            };
            let effort = (&known[..], self.effort);
            Judged::<F>::new(entry, &summary, &row.epsilons::<F>(), parts, effort)
        });
        let of_verdicts = judged
            .as_ref()
            .and_then(|judged| judged.contradiction.as_ref());
        if let Some(contradiction) = summary.contradiction.as_ref().or(of_verdicts) {
            let contradiction = Some(format!("self-check: {name}, {}: {contradiction}", F::NAME));
            return Parts {
                contradiction,
                ..Parts::default()
            };
        }
        let verdicts = judged.as_ref().zip(row.as_ref()).map(|(judged, row)| {
            let useful = || useful_scenes::<F>(entry, self.scene.as_ref()?, &row.epsilons::<F>());
            let misses = judged.verdicts.misses.as_ref();
            let useful = misses
                .ok()
                .filter(|it| USELESS <= it.share)
                .and_then(|_| useful());
            VerdictPart::new(judged, row, useful.unwrap_or_default())
        });
        let unit = summary.format.unit().to_f64();
        let shapes = &self.shapes;
        let triangles = self.scene.as_ref().map(|scene| Triangles { scene, shapes });
        let part = |gate: &GateSummary<F>| {
            let witness = |i: usize| {
                gate.witnesses[i]
                    .filter(|w| w.score > 0.0)
                    .map(|w| WitnessPart {
                        value: w.score,
                        units: w.score / unit,
                        inputs: w.inputs.iter().map(|x| x.hex()).collect(),
                    })
            };
            let published = self.epsilons.of::<F>(entry, gate);
            GatePart {
                kernel: name.to_owned(),
                scalar: F::NAME,
                gate: gate.gate.name.to_owned(),
                compares: gate.gate.refuses.to_owned(),
                bound: gate.bound.as_ref().ok().map(|bound| bound.to_f64()),
                bound_units: gate.bound.as_ref().ok().map(|bound| bound.to_f64() / unit),
                why: gate.bound.as_ref().err().cloned(),
                witness: witness(0),
                factor: gate.factor(),
                supposes: supposes(gate),
                limits: gate.limits.iter().map(LimitPart::new).collect(),
                parallel_passes: witness(1),
                statements: statements(entry, &summary, gate, triangles, &published),
            }
        };
        let of_gates = summary.gates.iter().flat_map(|gate| {
            let witnesses = gate.witnesses.iter().zip(GOALS);
            witnesses.map(move |(witness, goal)| (gate.gate.name, witness, goal))
        });
        let of_verdicts = judged
            .iter()
            .flat_map(|judged| judged.known.iter().zip(VERDICTS));
        let of_verdicts = of_verdicts.map(|(witness, goal)| ("edge", witness, goal));
        let witnesses = of_gates
            .chain(of_verdicts)
            .filter_map(|(gate, witness, goal)| {
                let witness = witness.filter(|witness| witness.score > 0.0)?;
                Some(StoredWitness {
                    kernel: name.to_owned(),
                    scalar: F::NAME,
                    gate: gate.to_owned(),
                    goal: goal.name().to_owned(),
                    inputs: witness.inputs.iter().map(|x| x.hex()).collect(),
                    units: witness.score / unit,
                })
            });
        Parts {
            witnesses: witnesses.collect(),
            kernel: Some(KernelPart {
                verdicts,
                kernel: name.to_owned(),
                scalar: F::NAME,
                paths: summary.proof.paths.len(),
                edges: about_edges(summary.symmetry).to_owned(),
                watertight: summary.symmetry == Symmetry::ExactSigns,
                leak: None,
                may_leak: summary.symmetry == Symmetry::None,
            }),
            gates: summary.gates.iter().map(part).collect(),
            ..Parts::default()
        }
    }
}

fn supposes<F>(gate: &GateSummary<F>) -> Vec<String> {
    let uses = gate.uses;
    let all = [
        (uses.edge, "edges"),
        (uses.reach, "origin to vertices"),
        (uses.world, "coordinates"),
        (uses.extent, "t_min and t_max"),
        (uses.floor, "divisors"),
        (uses.inside, "u and v"),
    ];
    all.into_iter()
        .filter(|(is_used, _)| *is_used)
        .map(|(_, name)| name.to_owned())
        .collect()
}

/// The epsilons of the kernel's own sets and of the presets that fit a gate.
fn published<F: Float>(entry: &Entry, gate: &GateSummary<F>) -> Vec<Published> {
    let own = entry
        .info
        .epsilon_sets
        .iter()
        .map(|set| (set.name, set.values[gate.index]));
    let presets = PRESETS.iter().flat_map(|preset| {
        let fitting = preset.entries.iter().filter(|entry| entry.fits(&gate.gate));
        fitting.map(|entry| (preset.name, entry.value))
    });
    let mut found: Vec<Published> = Vec::new();
    for (name, text) in own.chain(presets) {
        let Some(text) = EpsilonText::of(text) else {
            continue;
        };
        let Some(value) = text.value::<F>().map(F::to_f64) else {
            continue;
        };
        match found.iter_mut().find(|(_, known)| *known == value) {
            Some((names, _)) => names.insert_str(names.len() - 1, &format!(", {name}")),
            None => found.push((format!("{text} ({name})"), value)),
        }
    }
    found
}
