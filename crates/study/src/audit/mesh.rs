//! `hairline mesh`: the groups at a mesh's edges and vertices by class of ray, and how many edges and
//! vertices have a crack.

use super::chunk::{Chunk, SourceSummary};
use super::group_count::{GroupCount, GroupOutcome};
use super::places::Places;
pub use super::places::{PlaceFault, Seen};
use super::row::Row;
use super::rows::Rows;
use super::source::{Source, Stock};
use crate::case::{Matrix, Parameters};
use crate::contract::Across;
use crate::engine::{self, Merge, Observer};
use crate::kernel::{Scalar, Verdict};
use crate::mesh::{Aim, AimedPart, Surface};
use crate::oracle::Layers;
use crate::truth::Truth;
use std::ops::Range;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

/// The plan of a run on a mesh.
pub struct MeshPlan {
    /// The kernels with their epsilons and contracts.
    pub rows: Vec<Row>,
    /// Rays at each edge and vertex.
    pub directions: u64,
    /// Which random rays.
    pub seed: u64,
    /// True if directions are replaced by their rounded unit vectors.
    pub unit_direction: bool,
    /// Where the mesh is put, if not where it is.
    pub instance: Option<Matrix<f64>>,
    /// How many examples of each class and kind to keep, by index.
    pub examples: usize,
    /// How many places of each row, part and scalar to keep for a drawing.
    pub places: usize,
}

impl MeshPlan {
    /// The parameters of the cases.
    pub fn parameters(&self) -> Parameters {
        let MeshPlan { unit_direction, instance, .. } = *self;
        Parameters { unit_direction, instance, ..Parameters::default() }
    }

    /// The groups at a part of a mesh.
    fn source(&self, surface: &Arc<Surface>, part: AimedPart) -> Source {
        Source {
            stock: Stock::MeshPart(surface.clone(), part),
            parameters: self.parameters(),
            seed: self.seed,
            count: self.directions,
        }
    }
}

/// The results of a run in one scalar.
pub struct MeshFound {
    /// `f32` or `f64`.
    pub scalar: &'static str,
    /// The rows whose kernels run in this scalar.
    pub rows: Vec<RowFound>,
    /// Cases that went through the oracle: a ray and a triangle each.
    pub cases: u64,
    /// Which layer of the oracle decided.
    pub layers: Layers,
}

/// The results of one row.
pub struct RowFound {
    /// The row's place in the plan.
    pub row: usize,
    /// By [`AimedPart::ALL`].
    pub tallies: [MeshTally; 2],
    /// How many edges, and how many vertices, have a crack.
    pub cracked: [u64; 2],
    /// Time spent in the kernel, over all threads.
    pub nanoseconds: u64,
}

/// The classes of rays, by how they meet their target: whether exactly, as the oracle says, and
/// whether they were made to graze a triangle.
pub const CLASSES: [&str; 4] = ["exact", "exact-grazing", "near", "near-grazing"];

/// Everything that is added up for one row at one part of a mesh in one scalar.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MeshTally {
    /// By [`CLASSES`].
    pub classes: [GroupCount; 4],
    /// Rays on which the kernel gave no verdict on some triangle: they are not judged.
    pub failures: u64,
    /// The first of them, by index.
    pub first_failures: Vec<u64>,
    /// Where it went wrong, up to [`MeshPlan::places`].
    pub places: Places,
}

/// Runs a plan on a mesh in one scalar, which the surface has. The sums do not depend on the number of
/// threads.
pub fn run<F: Scalar>(
    surface: &Arc<Surface>,
    plan: &MeshPlan,
    observer: &dyn Observer,
) -> MeshFound {
    let rows = Rows::<F>::new(&plan.rows);
    let parts = AimedPart::ALL.map(|part| {
        let source = plan.source(surface, part);
        let targets = source.count::<F>() / plan.directions;
        let run = MeshRun { plan, part, source, rows: &rows, observer };
        run.sums(Cracked::new(targets, rows.each.len()))
    });
    let found = rows.each.iter().enumerate().map(|(i, row)| RowFound {
        row: row.number,
        tallies: parts.each_ref().map(|(_, sums)| sums.rows[i].0.clone()),
        cracked: parts.each_ref().map(|(cracked, _)| cracked.count(i)),
        nanoseconds: parts.iter().map(|(_, sums)| sums.rows[i].1).sum(),
    });
    let mut layers = Layers::default();
    parts.iter().for_each(|(_, sums)| layers.merge(&sums.summary.layers));
    MeshFound {
        scalar: F::NAME,
        rows: found.collect(),
        cases: parts.iter().map(|(_, sums)| sums.summary.cases).sum(),
        layers,
    }
}

/// One part of a mesh.
struct MeshRun<'a, F: 'static> {
    plan: &'a MeshPlan,
    part: AimedPart,
    source: Source,
    rows: &'a Rows<F>,
    observer: &'a dyn Observer,
}

/// The sums over chunks.
struct MeshSums {
    summary: SourceSummary,
    rows: Vec<(MeshTally, u64)>,
    /// The most examples, and the most places.
    limits: [usize; 2],
}

impl Merge for MeshSums {
    fn merge(&mut self, other: MeshSums) {
        self.summary.merge(&other.summary);
        let [examples, places] = self.limits;
        for ((tally, time), (more, more_time)) in self.rows.iter_mut().zip(other.rows) {
            for (groups, more) in tally.classes.iter_mut().zip(more.classes) {
                groups.merge(more, examples);
            }
            tally.failures += more.failures;
            tally.first_failures.extend(more.first_failures);
            tally.first_failures.sort_unstable();
            tally.first_failures.truncate(examples);
            tally.places.merge(more.places, places);
            *time += more_time;
        }
    }
}

impl<F: Scalar> MeshRun<'_, F> {
    fn sums(&self, cracked: Cracked) -> (Cracked, MeshSums) {
        let empty = || MeshSums {
            summary: SourceSummary::new(0, F::NAME),
            rows: vec![Default::default(); self.rows.each.len()],
            limits: [self.plan.examples, self.plan.places],
        };
        let add = |sums: &mut MeshSums, indices| self.add_chunk(indices, &cracked, sums);
        let indices = 0..self.source.count::<F>();
        let sums = engine::sum(indices, self.source.chunk(), self.observer, empty, add);
        (cracked, sums)
    }

    fn add_chunk(&self, indices: Range<u64>, cracked: &Cracked, sums: &mut MeshSums) {
        let (limit, first) = (self.plan.examples, indices.start);
        let chunk = Chunk::<F>::make(&self.source, indices, self.observer, &mut sums.summary);
        let contracts = &self.rows.contracts;
        let truths = chunk.group_truths_of_all(contracts);
        let part = self.part;
        let near: Vec<bool> =
            chunk.groups().map(|(_, cases)| !is_on_target(part, &chunk.truths[cases])).collect();
        let mut verdicts = vec![Verdict::miss(None); chunk.cases.len()];
        for (number, (row, (tally, time))) in self.rows.each.iter().zip(&mut sums.rows).enumerate()
        {
            *time += row.run(&chunk.cases, &mut verdicts, self.observer);
            let asked = (&contracts[row.contract], &truths[row.contract][..]);
            for judged in row.judge_groups(&self.source, &chunk, asked, &verdicts) {
                let group = match judged {
                    Ok(group) => group,
                    Err(index) => {
                        tally.failures += 1;
                        if tally.first_failures.len() < limit {
                            tally.first_failures.push(index);
                        }
                        continue;
                    }
                };
                let target = group.index % cracked.targets;
                let aim = Aim::of(group.index / cracked.targets);
                let near = near[(group.index - first) as usize];
                let class = &mut tally.classes[2 * usize::from(near) + usize::from(aim.grazing)];
                let outcome = class.add(&group, limit);
                if let Some(wrong) = wrong_by(outcome, asked.0.across) {
                    if wrong == PlaceFault::Crack {
                        cracked.note(number, target as usize);
                    }
                    tally.places.add(wrong, target as u32, group.index, self.plan.places);
                }
            }
        }
    }
}

/// True if the exact line meets the edge that the triangles share, or the centre of the fan.
fn is_on_target(part: AimedPart, truths: &[Truth]) -> bool {
    truths.iter().all(|truth| {
        truth.crossing().is_some_and(|crossing| match part {
            AimedPart::Edges => crossing.feature.is_edge(),
            AimedPart::Vertices => crossing.feature.is_vertex(),
        })
    })
}

/// The fault in an outcome: a crack whatever the contract, the others where it promises exactly one hit.
fn wrong_by(outcome: GroupOutcome, across: Across) -> Option<PlaceFault> {
    match outcome {
        GroupOutcome::Right | GroupOutcome::Elsewhere => None,
        GroupOutcome::Crack => Some(PlaceFault::Crack),
        // Who does not promise it is not blamed for it.
        _ if across != Across::ExactlyOne => None,
        GroupOutcome::Double => Some(PlaceFault::Double),
        GroupOutcome::OddFold => Some(PlaceFault::OddFold),
    }
}

/// Which targets have a crack: shared by all threads, as unions commute.
struct Cracked {
    targets: u64,
    /// For each row a bit a target.
    rows: Vec<Vec<AtomicU64>>,
}

impl Cracked {
    fn new(targets: u64, rows: usize) -> Cracked {
        let words = || (0..targets.div_ceil(64)).map(|_| AtomicU64::new(0)).collect();
        Cracked { targets, rows: (0..rows).map(|_| words()).collect() }
    }

    fn note(&self, row: usize, target: usize) {
        self.rows[row][target / 64].fetch_or(1 << (target % 64), Ordering::Relaxed);
    }

    fn count(&self, row: usize) -> u64 {
        let ones = |word: &AtomicU64| u64::from(word.load(Ordering::Relaxed).count_ones());
        self.rows[row].iter().map(ones).sum()
    }
}
