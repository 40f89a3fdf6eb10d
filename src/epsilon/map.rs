//! Two epsilons of a kernel at once.

use super::run::Request;
use crate::audit::{Chunk, Source, SourceSummary};
use crate::engine::{self, Merge, Observer};
use crate::judge::Obligation;
use crate::kernel::Scalar;

/// False misses and false hits for every pair of some epsilons of two gates.
#[derive(Clone, Debug, PartialEq)]
pub struct Map<F> {
    /// The gates' places in the kernel's chain.
    pub gates: [usize; 2],
    /// The epsilons of each gate, in order.
    pub epsilons: [Vec<F>; 2],
    /// Cases that must be hit.
    pub must_hit: u64,
    /// Cases that must be missed.
    pub must_miss: u64,
    /// By epsilon of the first gate, then of the second.
    pub false_misses: Vec<Vec<u64>>,
    /// By epsilon of the first gate, then of the second.
    pub false_hits: Vec<Vec<u64>>,
}

/// Counts of cases by how many epsilons of each gate accept them.
#[derive(Clone)]
struct Counts {
    width: usize,
    must_hit: Vec<u64>,
    must_miss: Vec<u64>,
}

impl Merge for Counts {
    fn merge(&mut self, other: Counts) {
        let sums = self.must_hit.iter_mut().chain(&mut self.must_miss);
        sums.zip(other.must_hit.into_iter().chain(other.must_miss)).for_each(|(a, b)| *a += b);
    }
}

/// Runs the first two gates of a request against each other; `epsilons` are in order.
pub fn map<F: Scalar>(
    request: &Request<'_, F>,
    epsilons: [Vec<F>; 2],
    sources: &[Source],
    observer: &dyn Observer,
) -> Map<F> {
    let gates = [request.gates[0], request.gates[1]];
    let width = epsilons[1].len() + 1;
    let cells = (epsilons[0].len() + 1) * width;
    let empty = || Counts { width, must_hit: vec![0; cells], must_miss: vec![0; cells] };
    let mut counts = empty();
    for (number, source) in sources.iter().enumerate() {
        let add = |counts: &mut Counts, indices| {
            let mut summary = SourceSummary::new(number, F::NAME);
            let chunk = Chunk::<F>::make(source, indices, observer, &mut summary);
            add(request, gates, &epsilons, &chunk, counts);
        };
        counts.merge(engine::sum(0..source.count::<F>(), source.chunk(), observer, empty, add));
    }
    finished(gates, epsilons, &counts)
}

fn add<F: Scalar>(
    request: &Request<'_, F>,
    gates: [usize; 2],
    epsilons: &[Vec<F>; 2],
    chunk: &Chunk<F>,
    counts: &mut Counts,
) {
    let info = request.row.entry.info;
    let given = request.row.epsilons::<F>();
    let mut margins = vec![F::zero(); chunk.cases.len() * info.gates.len()];
    request.subject.margins(info, &chunk.cases, &mut margins, &mut []);
    let obligations = chunk.obligations(&request.row.contract);
    for (margins, obligation) in margins.chunks_exact(info.gates.len()).zip(obligations) {
        let counts_of = match obligation {
            Obligation::MustHit => &mut counts.must_hit,
            Obligation::MustMiss => &mut counts.must_miss,
            Obligation::Free => continue,
        };
        if margins.iter().any(|margin| margin.is_nan()) {
            continue;
        }
        let mut others = (0..margins.len()).filter(|gate| !gates.contains(gate));
        let refused = others.any(|gate| margins[gate] < given[gate]);
        // The epsilons up to the margin accept.
        let accepting = |k: usize| {
            if refused { 0 } else { epsilons[k].partition_point(|e| *e <= margins[gates[k]]) }
        };
        counts_of[accepting(0) * counts.width + accepting(1)] += 1;
    }
}

/// A case is accepted under a pair of epsilons if both gates accept.
fn finished<F: Scalar>(gates: [usize; 2], epsilons: [Vec<F>; 2], counts: &Counts) -> Map<F> {
    let accepted = |counts_of: &[u64]| -> Vec<Vec<u64>> {
        let at = |i: usize, j: usize| -> u64 {
            let rows = (i + 1)..=epsilons[0].len();
            rows.map(|row| {
                counts_of[row * counts.width..(row + 1) * counts.width][j + 1..].iter().sum::<u64>()
            })
            .sum()
        };
        let row = |i| (0..epsilons[1].len()).map(|j| at(i, j)).collect();
        (0..epsilons[0].len()).map(row).collect()
    };
    let must_hit: u64 = counts.must_hit.iter().sum();
    let hit = accepted(&counts.must_hit);
    let false_hits = accepted(&counts.must_miss);
    let missed = |row: Vec<u64>| row.into_iter().map(|hits| must_hit - hits).collect();
    Map {
        gates,
        must_hit,
        must_miss: counts.must_miss.iter().sum(),
        false_misses: hit.into_iter().map(missed).collect(),
        false_hits,
        epsilons,
    }
}
