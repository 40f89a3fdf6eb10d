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

#[cfg(test)]
mod tests {
    use super::super::axis::Axis;
    use super::*;
    use crate::audit::{EpsilonChoice, EpsilonText, Unobserved};
    use crate::case::Parameters;
    use crate::judge::asked;
    use crate::kernel::{Verdict, verdicts_of};
    use crate::oracle::truth;

    #[test]
    fn a_map_counts_what_runs_with_each_pair_of_epsilons_find() {
        // Gates beside the first two keep their epsilons.
        for (kernel, gates) in [
            ("moller-trumbore", [0, 1]),
            ("plane-unit-normal", [2, 0]),
            ("plane-unit-normal", [1, 2]),
        ] {
            let entry = crate::kernel::find(kernel).unwrap();
            let mut row = EpsilonChoice::Source.rows(&[entry], None).unwrap().remove(0);
            row.epsilons.fill(EpsilonText::Decimal("1e-3".to_owned()));
            let source = |name| Source::Family {
                family: crate::family::find(name).unwrap(),
                parameters: Parameters::default(),
                seed: 1,
                count: 60,
                exhaustive: false,
            };
            let sources = ["edge-near", "grazing", "origin-near"].map(source);
            let axes = [vec![-1.0f32, 0.0, 1e-6, 1e-2, 3.0], vec![-1e-2, 1e-5, 0.5]];
            let (axis, subject) = (Axis::new(&[]), f32::subject(entry).unwrap());
            let request = Request { row: &row, subject, gates: &gates, axis: &axis, exact: false };
            let found = map(&request, axes.clone(), &sources, &Unobserved);
            let cases: Vec<_> = sources
                .iter()
                .flat_map(|source| (0..60).flat_map(|i| source.make::<f32>(i).cases().to_vec()))
                .collect();
            let owed: Vec<Obligation> =
                cases.iter().map(|case| asked(case, &truth(case), &row.contract, false)).collect();
            let count = |wanted| owed.iter().filter(|owed| **owed == wanted).count() as u64;
            assert_eq!(found.must_hit, count(Obligation::MustHit));
            assert_eq!(found.must_miss, count(Obligation::MustMiss));
            assert_eq!((found.gates, &found.epsilons), (gates, &axes));
            for (i, one) in axes[0].iter().enumerate() {
                for (j, other) in axes[1].iter().enumerate() {
                    let mut epsilons = row.epsilons::<f32>();
                    (epsilons[gates[0]], epsilons[gates[1]]) = (*one, *other);
                    let mut verdicts = vec![Verdict::miss(None); cases.len()];
                    verdicts_of(subject, &cases, &epsilons, &mut verdicts);
                    let wrong = |wanted, hit| {
                        let pairs = owed.iter().zip(&verdicts);
                        pairs.filter(|(owed, v)| **owed == wanted && v.hit == hit).count() as u64
                    };
                    let told = format!("{kernel} {one} {other}");
                    let misses = wrong(Obligation::MustHit, false);
                    assert_eq!(found.false_misses[i][j], misses, "{told}");
                    assert_eq!(found.false_hits[i][j], wrong(Obligation::MustMiss, true), "{told}");
                }
            }
        }
    }
}
