//! A campaign: islands that grow round by round, on all threads.

use super::find::Find;
use super::island::{Island, Newcomer};
use super::state::{CampaignState, SavedIndividual};
use crate::arith::ScalarName;
use crate::audit::Row;
use crate::case::Case;
use crate::corpus::lines::AnyCase;
use crate::engine;
use crate::kernel::Scalar;

/// The lanes of an island, which know nothing of each other within a round.
const LANES: u64 = 4;

/// The evaluations of a lane in a round, and in the first, which finds the most: from there they double.
const STEPS: u64 = 256;
const FIRST_STEPS: u64 = 8;

/// The plan of a campaign.
#[derive(Clone)]
pub struct CampaignPlan {
    /// Kernels with epsilons and contracts.
    pub rows: Vec<Row>,
    /// True if other epsilons are tried too: published ones, zero, and numbers between.
    pub varies: bool,
    /// True for each scalar that is searched: `f32`, `f64`.
    pub scalars: [bool; 2],
    /// Which random cases.
    pub seed: u64,
}

/// Islands, one a kernel and scalar, and the counters.
pub struct Campaign {
    f32: Vec<Island<f32>>,
    f64: Vec<Island<f64>>,
    seed: u64,
    /// Rounds until now.
    pub rounds: u64,
    /// Evaluations until now: cases given to a kernel and judged, those of simplifying not counted.
    pub evaluations: u64,
}

impl Campaign {
    /// At the beginning.
    pub fn new(plan: &CampaignPlan) -> Campaign {
        let mut kernels: Vec<Vec<&Row>> = Vec::new();
        for row in &plan.rows {
            match kernels
                .iter_mut()
                .find(|rows| rows[0].entry.info.name == row.entry.info.name)
            {
                Some(rows) => rows.push(row),
                None => kernels.push(vec![row]),
            }
        }
        // A kernel may run in one scalar alone.
        let running = |scalar: usize| {
            let runs = move |rows: &&Vec<&Row>| rows[0].entry.scalars()[scalar];
            kernels
                .iter()
                .filter(move |_| plan.scalars[scalar])
                .filter(runs)
        };
        Campaign {
            f32: running(0)
                .map(|rows| Island::new(rows, plan.varies))
                .collect(),
            f64: running(1)
                .map(|rows| Island::new(rows, plan.varies))
                .collect(),
            seed: plan.seed,
            rounds: 0,
            evaluations: 0,
        }
    }

    /// One round of at most this many evaluations; the finds of kinds that were unknown, in an order
    /// that does not depend on the threads.
    pub fn round(&mut self, most: u64) -> Vec<Find> {
        let tasks = (self.f32.len() + self.f64.len()) as u64 * LANES;
        let steps = STEPS.min(FIRST_STEPS << self.rounds.min(16));
        let evaluations = most.min(tasks * steps);
        let share = |task: u64| evaluations / tasks + u64::from(task < evaluations % tasks);
        let (seed, round) = (self.seed, self.rounds);
        let first_wide = self.f32.len() as u64 * LANES;
        let narrow = grow(&mut self.f32, seed, round, share);
        let wide = grow(&mut self.f64, seed, round, |task| share(first_wide + task));
        self.rounds = self.rounds.saturating_add(1);
        self.evaluations = self.evaluations.saturating_add(evaluations);
        let evaluations = self.evaluations;
        let mut finds = engine::map(&narrow, |newcomer| newcomer.find(seed, evaluations));
        finds.extend(engine::map(&wide, |newcomer| {
            newcomer.find(seed, evaluations)
        }));
        finds
    }

    /// Makes the kind of a find known, so that it is not found again.
    pub fn learn(&mut self, find: &Find) {
        let (kernel, kind) = (find.signature.kernel, find.signature.kind());
        match find.case {
            AnyCase::F32(_) => learn(&mut self.f32, kernel, kind),
            AnyCase::F64(_) => learn(&mut self.f64, kernel, kind),
        }
    }

    /// Counters and population, to be saved.
    pub fn state(&self, seconds: f64, sessions: u64) -> CampaignState {
        let narrow = self.f32.iter().flat_map(Island::saved);
        let population = narrow
            .chain(self.f64.iter().flat_map(Island::saved))
            .collect();
        CampaignState {
            rounds: self.rounds,
            evaluations: self.evaluations,
            seconds,
            sessions,
            population,
        }
    }

    /// Goes on from what was saved.
    pub fn restore(&mut self, state: &CampaignState) -> Result<(), String> {
        (self.rounds, self.evaluations) = (state.rounds, state.evaluations);
        state
            .population
            .iter()
            .enumerate()
            .try_for_each(|(i, individual)| {
                let restored = match individual.scalar {
                    ScalarName::F32 => restore(&mut self.f32, individual),
                    ScalarName::F64 => restore(&mut self.f64, individual),
                };
                restored.map_err(|message| format!("population[{i}]: {message}"))
            })
    }
}

/// All lanes of some islands at once; the newcomers, island by island.
fn grow<F: Scalar>(
    islands: &mut [Island<F>],
    seed: u64,
    round: u64,
    share: impl Fn(u64) -> u64 + Sync,
) -> Vec<Newcomer<F>> {
    let shared = &*islands;
    let tasks: Vec<u64> = (0..shared.len() as u64 * LANES).collect();
    let mut proposals = engine::map(&tasks, |&task| {
        shared[(task / LANES) as usize].propose(seed, round, task % LANES, share(task))
    });
    let lanes = LANES as usize;
    islands
        .iter_mut()
        .flat_map(|island| {
            let own = proposals.drain(..lanes).collect();
            island.take_in(own)
        })
        .collect()
}

fn learn<F: Scalar>(islands: &mut [Island<F>], kernel: &str, kind: crate::Signature) {
    if let Some(island) = islands.iter_mut().find(|island| island.is_of(kernel)) {
        island.learn(kind);
    }
}

fn restore<F: Scalar>(islands: &mut [Island<F>], saved: &SavedIndividual) -> Result<(), String> {
    let row = Row::named(&saved.kernel, saved.epsilons.as_deref(), &saved.contract)?;
    row.check::<F>()?;
    let island = islands
        .iter_mut()
        .find(|island| island.is_of(&saved.kernel));
    let island = island.ok_or_else(|| format!("no {} in {}", saved.kernel, F::NAME))?;
    let bits: &[u64; 17] = saved
        .bits
        .as_slice()
        .try_into()
        .map_err(|_| "bits: expected 17 numbers".to_owned())?;
    island.restore(Case::from_bits(bits), row);
    Ok(())
}
