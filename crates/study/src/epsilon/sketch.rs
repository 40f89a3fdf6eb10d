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

/// A kernel's response on few cases as one of its epsilons varies.
pub struct Sketch<F> {
    /// The gate's place in the kernel's chain.
    pub gate: usize,
    /// All sources together, exact at every epsilon.
    pub total: Response<F>,
    /// The false misses and the false hits between which an epsilon trades.
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
                is_secondary: set.is_secondary,
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::audit::{EpsilonChoice, Unobserved};
    use crate::case::{Case, Parameters};
    use crate::family::find;

    fn family(name: &str, count: u64, exhaustive: bool) -> Source {
        let (family, parameters) = (find(name).unwrap(), Parameters::default());
        Source::Family { family, parameters, seed: 1, count, exhaustive }
    }

    #[test]
    fn few_cases_are_the_first_of_each_source_of_one_size() {
        let shown = |sources: &[Source]| -> Vec<(String, u64, bool)> {
            let few = few(sources, 10);
            let is_whole =
                |source: &Source| matches!(source, Source::Family { exhaustive: true, .. });
            few.iter().map(|s| (s.name(), s.count::<f32>(), is_whole(s))).collect()
        };
        let plain = [family("grazing", 7, false), family("behind", 70, false)];
        let of = |name: &str, count| (name.to_owned(), count, false);
        assert_eq!(shown(&plain), [of("grazing", 7), of("behind", 10)]);
        // A whole set is drawn from, be it as small as can be.
        assert_eq!(shown(&[family("lattice", 3, true)]), [of("lattice", 10)]);
        let spanning = SPANNING.map(|name| family(name, 70, false));
        let mixed = [&spanning[..], &plain].concat();
        assert_eq!(shown(&mixed), shown(&plain));
        assert_eq!(shown(&spanning), SPANNING.map(|name| of(name, 10)));
        let cases = (0..30).map(|i| (i.to_string(), Case::new([0.0; 3], [1.0; 3], [[2.0; 3]; 3])));
        let f32: Vec<(String, Case<f32>)> = cases.collect();
        let set = CorpusSet { file: "corpus".to_owned(), f32: f32.clone(), ..CorpusSet::default() };
        let Source::Corpus(found) = few(&[Source::Corpus(set)], 10).remove(0) else {
            panic!("a corpus")
        };
        assert_eq!((found.f32.len(), &found.f32[9].0, found.f64.len()), (10, &f32[9].0, 0));
        assert!(few(&[], 10).is_empty());
    }

    #[test]
    fn a_sketch_of_each_gate_is_its_response() {
        let of = |kernel: &str, sources: &[Source]| {
            let entry = crate::kernel::find(kernel).unwrap();
            let row = EpsilonChoice::Source.rows(&[entry], None).unwrap().remove(0);
            let (subject, axis) = (f32::subject(entry).unwrap(), Axis::new(&[]));
            let gates = tunable_gates(entry.info.gates);
            let request = Request { row: &row, subject, gates: &gates, axis: &axis, exact: true };
            let run = run(&request, sources, &Unobserved);
            let found = sketch(&row, subject, sources, &axis, &Unobserved);
            let numbers: Vec<usize> = found.iter().map(|sketch| sketch.gate).collect();
            for (n, sketch) in found.iter().enumerate() {
                assert_eq!(Some(&sketch.total), total(n, &run).as_ref(), "{kernel} {n}");
                assert_eq!(sketch.trade.misses.curve.question as usize, 0);
            }
            numbers
        };
        let sources = [family("grazing", 40, false), family("edge-near", 40, false)];
        assert_eq!(of("moller-trumbore", &sources), [0, 1]);
        assert_eq!(of("plane-unit-normal", &sources[..1]), [0, 1, 2]);
        assert_eq!(of("havel-herout", &sources), [0; 0]);
        assert_eq!(of("moller-trumbore", &[]), [0; 0]);
    }
}
