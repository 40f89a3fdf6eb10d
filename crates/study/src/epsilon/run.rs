//! One pass over the cases, for every epsilon.

use super::axis::{Axis, largest};
use super::curve::{Curve, Lane, Question};
use super::duty::Duty;
use crate::arith::Float;
use crate::audit::{Chunk, Place, Row, Source, SourceSummary};
use crate::engine::{self, Merge, Observer};
use crate::family::Grouping;
use crate::judge::{GroupTruth, Obligation};
use crate::kernel::{Gate, Scalar, Subject, Tunable};
use std::ops::Range;

/// A kernel, and the gates whose responses are computed.
#[derive(Clone, Copy)]
pub struct Request<'a, F: 'static> {
    /// The kernel, its contract, and the epsilons of the gates that are not varied.
    pub row: &'a Row,
    /// The same kernel in the scalar.
    pub subject: &'static dyn Subject<F>,
    /// The gates, each varied alone.
    pub gates: &'a [usize],
    /// Where the answer is exact.
    pub axis: &'a Axis<F>,
    /// Keep every margin, so that it is exact everywhere; memory grows with the cases.
    pub exact: bool,
}

/// The response of a kernel on one source as one of its epsilons varies.
#[derive(Clone, Debug, PartialEq)]
pub struct Response<F> {
    /// The gate's place in the kernel's chain.
    pub gate: usize,
    /// By [`Question::ALL`].
    pub curves: Vec<Curve<F>>,
    /// The number of cases that must be hit and that each other gate refuses, whatever this epsilon.
    pub refused_by_others: Vec<u64>,
}

impl<F: Scalar> Response<F> {
    /// The answer to one question.
    pub fn curve(&self, question: Question) -> &Curve<F> {
        &self.curves[question as usize]
    }

    /// Adds the response on another source.
    pub fn merge(&mut self, other: &Response<F>) {
        for (curve, more) in self.curves.iter_mut().zip(&other.curves) {
            curve.merge(more);
        }
        for (count, more) in self.refused_by_others.iter_mut().zip(&other.refused_by_others) {
            *count += more;
        }
    }
}

/// The responses on one source, gate by gate.
pub struct SourceResponse<F> {
    /// In the order of the request.
    pub gates: Vec<Response<F>>,
}

/// The gates of a kernel that take an epsilon.
pub fn tunable_gates(gates: &[Gate]) -> Vec<usize> {
    (0..gates.len()).filter(|&gate| gates[gate].epsilon != Tunable::Fixed).collect()
}

/// The lowest epsilon that a gate takes.
pub fn floor<F: Float>(gate: &Gate) -> F {
    match gate.epsilon {
        Tunable::Signed => -largest::<F>(),
        Tunable::NonNegative | Tunable::Fixed => F::zero(),
    }
}

/// Runs a request over sources, in their order.
pub fn run<F: Scalar>(
    request: &Request<'_, F>,
    sources: &[Source],
    observer: &dyn Observer,
) -> Vec<SourceResponse<F>> {
    let pass = Pass::new(request, observer);
    sources.iter().map(|source| pass.over(source)).collect()
}

/// A request with everything about its kernel looked up.
struct Pass<'a, F: Scalar> {
    request: &'a Request<'a, F>,
    gates: &'static [Gate],
    epsilons: Vec<F>,
    duties: Vec<Duty>,
    observer: &'a dyn Observer,
}

/// The counts of one thread.
struct Sums<F> {
    gates: Vec<GateSums<F>>,
    margins: Vec<F>,
}

struct GateSums<F> {
    lanes: [Lane<F>; Question::ALL.len()],
    refused_by_others: Vec<u64>,
    /// By case of the chunk: the margin, or -inf where another gate refuses.
    effective: Vec<F>,
}

impl<'a, F: Scalar> Pass<'a, F> {
    fn new(request: &'a Request<'a, F>, observer: &'a dyn Observer) -> Self {
        let Row { entry, .. } = request.row;
        let epsilons = request.row.epsilons();
        let gates = entry.info.gates;
        let duty = |gate| Duty::of(gates, gate, &request.row.contract);
        let duties = (0..gates.len()).map(duty).collect();
        Pass { request, gates, epsilons, duties, observer }
    }

    fn over(&self, source: &Source) -> SourceResponse<F> {
        // A few large sums: a lane in f64 has 268,000 cells.
        let sums = engine::sum(
            0..source.count::<F>(),
            source.chunk(),
            self.observer,
            || self.empty(),
            |sums: &mut Sums<F>, indices| self.add(source, indices, sums),
        );
        let gates = sums.gates.into_iter().zip(self.request.gates);
        let responses = gates.map(|(sums, gate)| Response {
            gate: *gate,
            curves: sums.lanes.map(|lane| lane.curve(self.request.axis)).into(),
            refused_by_others: sums.refused_by_others,
        });
        SourceResponse { gates: responses.collect() }
    }

    fn empty(&self) -> Sums<F> {
        let lane = |gate: usize, question| {
            Lane::new(question, floor(&self.gates[gate]), self.request.exact)
        };
        let gate = |gate: &usize| GateSums {
            lanes: Question::ALL.map(|question| lane(*gate, question)),
            refused_by_others: vec![0; self.gates.len()],
            effective: Vec::new(),
        };
        Sums { gates: self.request.gates.iter().map(gate).collect(), margins: Vec::new() }
    }

    fn add(&self, source: &Source, indices: Range<u64>, sums: &mut Sums<F>) {
        let mut summary = SourceSummary::new(0, F::NAME);
        let chunk = Chunk::<F>::make(source, indices, self.observer, &mut summary);
        let contract = &self.request.row.contract;
        let obligations = chunk.obligations(contract);
        let groups = chunk.group_truths(contract);
        sums.margins.resize(chunk.cases.len() * self.gates.len(), F::zero());
        let info = self.request.row.entry.info;
        self.request.subject.margins(info, &chunk.cases, &mut sums.margins, &mut []);
        for (gate_sums, &gate) in sums.gates.iter_mut().zip(self.request.gates) {
            self.add_cases(&chunk, &obligations, &sums.margins, gate, gate_sums);
            add_groups(&chunk, &groups, self.request.axis, gate_sums);
        }
    }

    fn add_cases(
        &self,
        chunk: &Chunk<F>,
        obligations: &[Obligation],
        margins: &[F],
        gate: usize,
        sums: &mut GateSums<F>,
    ) {
        let axis = self.request.axis;
        let [misses, hits, _, _, self_hits, own] = &mut sums.lanes;
        let secondary = chunk.grouping == Grouping::SecondaryRay;
        let guards_start = self.duties[gate].guards_start();
        sums.effective.clear();
        let rows = margins.chunks_exact(self.gates.len());
        for (i, (margins, obligation)) in rows.zip(obligations).enumerate() {
            // The kernel failed where its margins were looked for.
            if margins.iter().any(|margin| margin.is_nan()) {
                sums.effective.push(F::from_f64(f64::NAN));
                continue;
            }
            let refusing = (0..margins.len())
                .find(|&other| other != gate && margins[other] < self.epsilons[other]);
            let margin = if refusing.is_some() { -F::infinity() } else { margins[gate] };
            sums.effective.push(margin);
            let place = chunk.places[i];
            match obligation {
                Obligation::MustHit => misses.add(axis, margin, place),
                Obligation::MustMiss => hits.add(axis, margin, place),
                Obligation::Free => {}
            }
            let own_to_refuse = if secondary && guards_start {
                true
            } else {
                *obligation == Obligation::MustMiss && self.duties[gate].guards(chunk.class(i))
            };
            if own_to_refuse {
                own.add(axis, margin, place);
            }
            if let (Obligation::MustHit, Some(other)) = (obligation, refusing) {
                sums.refused_by_others[other] += 1;
            }
            if secondary {
                self_hits.add(axis, margin, place);
            }
        }
    }
}

/// A group cracks where its largest margin refuses, and doubles where its second largest accepts.
fn add_groups<F: Scalar>(
    chunk: &Chunk<F>,
    groups: &[GroupTruth],
    axis: &Axis<F>,
    sums: &mut GateSums<F>,
) {
    let [_, _, cracks, doubles, _, _] = &mut sums.lanes;
    for ((index, range), truth) in chunk.groups().zip(groups) {
        let margins = &sums.effective[range];
        if *truth != GroupTruth::Crossing || margins.iter().any(|margin| margin.is_nan()) {
            continue;
        }
        let (mut first, mut second) = (-F::infinity(), -F::infinity());
        for margin in margins {
            if first < *margin {
                (first, second) = (*margin, first);
            } else if second < *margin {
                second = *margin;
            }
        }
        let place = Place { index, triangle: 0 };
        cracks.add(axis, first, place);
        doubles.add(axis, second, place);
    }
}

impl<F: Scalar> Merge for Sums<F> {
    fn merge(&mut self, other: Sums<F>) {
        for (sums, more) in self.gates.iter_mut().zip(other.gates) {
            for (lane, more) in sums.lanes.iter_mut().zip(more.lanes) {
                lane.merge(more);
            }
            for (count, more) in sums.refused_by_others.iter_mut().zip(more.refused_by_others) {
                *count += more;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::audit::{EpsilonChoice, Unobserved};
    use crate::case::Parameters;
    use crate::{family, kernel};
    use std::sync::Barrier;

    /// Each of two threads waits for the other after its chunk, so that both have one.
    struct InTurn(Barrier);

    impl Observer for InTurn {
        fn advance(&self, _: u64) {
            self.0.wait();
        }

        fn now(&self) -> u64 {
            0
        }
    }

    #[test]
    fn what_two_threads_count_adds_up() {
        let row = EpsilonChoice::Source.rows(&[kernel::find("moller-trumbore").unwrap()], None);
        let row = row.unwrap().remove(0);
        let (gates, axis) = (tunable_gates(row.entry.info.gates), Axis::new(&[]));
        let subject = f32::subject(row.entry).unwrap();
        let request = Request { row: &row, subject, gates: &gates, axis: &axis, exact: false };
        let source = |family: &str, count: u64| Source::Family {
            family: family::find(family).unwrap(),
            parameters: Parameters::default(),
            seed: 1,
            count,
            exhaustive: false,
        };
        let mut refused = 0;
        for family in ["edge-near", "fan"] {
            let sources = [source(family, 2 * source(family, 1 << 20).chunk())];
            let on = |threads: usize, observer: &dyn Observer| {
                let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
                pool.install(|| run(&request, &sources, observer)).remove(0).gates
            };
            let alone = on(1, &Unobserved);
            assert_eq!(on(2, &InTurn(Barrier::new(2))), alone);
            refused += alone.iter().flat_map(|gate| &gate.refused_by_others).sum::<u64>();
        }
        assert!(10 < refused, "{refused}");
    }
}
