//! A response on few cases: enough for a picture, in seconds for all kernels.

use super::advice::{Trade, total};
use super::axis::Axis;
use super::duty::Duty;
use super::run::{Request, Response, run, tunable_gates};
use crate::audit::{CorpusSet, Observer, Row, Source};
use crate::kernel::{Scalar, Subject};

/// Families whose sizes span the scalar's range. An epsilon that is right for one size is wrong for
/// another there.
pub const SPANNING: [&str; 6] =
    ["tiny", "huge", "direction-length", "mixed-scale", "range-ends", "invalid"];

/// What a kernel does as one of its epsilons varies, on few cases.
pub struct Sketch<F> {
    /// The gate's place in the kernel's chain.
    pub gate: usize,
    /// All sources together, exact at every epsilon.
    pub total: Response<F>,
    /// What an epsilon trades.
    pub trade: Trade<F>,
}

/// Sketches of all gates that take an epsilon, each varied alone; empty without a source.
pub fn sketch<F: Scalar>(
    row: &Row,
    subject: &'static dyn Subject<F>,
    sources: &[Source],
    axis: &Axis<F>,
    observer: &dyn Observer,
) -> Vec<Sketch<F>> {
    let gates = row.entry.info.gates;
    let tunable = tunable_gates(gates);
    if tunable.is_empty() {
        return Vec::new();
    }
    // Margins are kept one by one: there are few, and cells for each source would cost more.
    let request = Request { row, subject, gates: &tunable, axis, exact: true };
    let responses = run(&request, sources, observer);
    let sketch = |(n, &gate): (usize, &usize)| {
        let duty = Duty::of(gates, gate, &row.contract);
        let trade = Trade::new(&gates[gate], &duty, n, sources, &responses);
        Some(Sketch { gate, total: total(n, &responses)?, trade })
    };
    tunable.iter().enumerate().filter_map(sketch).collect()
}

/// The first indices of each source, without the families that span the scalar's range unless there is
/// nothing else.
pub fn few(sources: &[Source], most: u64) -> Vec<Source> {
    let spans = |source: &&Source| match source {
        Source::Family { family, .. } => SPANNING.contains(&family.name),
        _ => false,
    };
    let few = |source: &Source| {
        Some(match source {
            Source::Family { family, parameters, seed, count, exhaustive } => Source::Family {
                family,
                parameters: parameters.clone(),
                seed: *seed,
                // In its natural order the beginning of a whole set is no picture of it.
                count: if *exhaustive { most } else { (*count).min(most) },
                exhaustive: false,
            },
            Source::Mesh { family, parameters, seed, count } => Source::Mesh {
                family: family.clone(),
                parameters: parameters.clone(),
                seed: *seed,
                count: (*count).min(most),
            },
            Source::SceneMesh { mesh, stratum, parameters, seed, count } => Source::SceneMesh {
                mesh: mesh.clone(),
                stratum: *stratum,
                parameters: parameters.clone(),
                seed: *seed,
                count: (*count).min(most),
            },
            Source::Corpus(set) => Source::Corpus(CorpusSet {
                file: set.file.clone(),
                f32: set.f32.iter().take(most as usize).cloned().collect(),
                f64: set.f64.iter().take(most as usize).cloned().collect(),
            }),
            // A crack there is one only if no neighbour has the hit, which margins do not tell.
            Source::MeshPart { .. } => return None,
        })
    };
    let chosen: Vec<Source> =
        sources.iter().filter(|source| !spans(source)).filter_map(few).collect();
    if chosen.is_empty() { sources.iter().filter_map(few).collect() } else { chosen }
}
