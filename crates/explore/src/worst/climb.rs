//! Hill climbing with restarts, in independent lanes.
//!
//! Each goal is climbed by a fixed number of lanes, each with its own stream of random numbers, its
//! share of the evaluations and its own restarts; the best of the lanes is the result. So it depends
//! on the goal, the seed and the number of evaluations only, not on the number of threads nor on the
//! other goals.

use crate::audit::Row;
use crate::case::{Case, Draw, Parameters};
use crate::decimal::Decimal;
use crate::domain::SearchDomain;
use crate::engine;
use crate::family::FAMILIES;
use crate::kernel::Scalar;
use crate::moves::mutate;
use crate::objective::{Scorer, SearchTarget};

/// The lanes of a goal.
pub const LANES: u64 = 8;

/// Cases of the families from which each climb takes the best for its start.
const STARTS: u64 = 64;

/// Moves in a row that bring nothing, after which a climb starts anew.
const PATIENCE: u64 = 400;

/// One thing to make as bad as it can be.
#[derive(Clone)]
pub struct WorstGoal {
    /// The kernel with its epsilons and its contract.
    pub row: Row,
    /// The objective and the gate.
    pub target: SearchTarget,
    /// The cases that count.
    pub domain: SearchDomain,
}

impl WorstGoal {
    /// `kernel/scalar/epsilons/target/domain`: what its entry in the table is called.
    pub fn name<F: Scalar>(&self) -> String {
        let epsilons = self
            .row
            .epsilon_argument()
            .unwrap_or_else(|| "-".to_owned());
        let (info, domain) = (self.row.entry.info, self.domain.name());
        format!(
            "{}/{}/{epsilons}/{}/{domain}",
            info.name,
            F::NAME,
            self.target.name(info)
        )
    }

    /// Every goal of a row in a domain.
    pub fn of_row(row: &Row, domain: SearchDomain) -> impl Iterator<Item = WorstGoal> + use<'_> {
        let targets = SearchTarget::of_kernel(row.entry.info).into_iter();
        targets.map(move |target| WorstGoal {
            row: row.clone(),
            target,
            domain,
        })
    }

    /// The goal's scorer.
    pub fn scorer<F: Scalar>(&self) -> Scorer<'_, F> {
        Scorer::new(&self.row, self.target, self.domain)
    }
}

/// The worst case that a search found.
#[derive(Clone, Copy, Debug)]
pub struct FoundWorst<F: Scalar> {
    /// The case.
    pub case: Case<F>,
    /// Its exact score, rounded.
    pub score: Decimal,
}

/// Searches for the worst case of each goal, with this many evaluations each; none where nothing has
/// a score. Scores are confirmed exactly.
pub fn search<F: Scalar>(
    goals: &[WorstGoal],
    evaluations: u64,
    seed: u64,
) -> Vec<Option<FoundWorst<F>>> {
    let lanes: Vec<u64> = (0..goals.len() as u64 * LANES).collect();
    let climbed = engine::map(&lanes, |k| {
        let (goal, lane) = (&goals[(k / LANES) as usize], k % LANES);
        let scorer = goal.scorer::<F>();
        let mut draw = Draw::new(&goal.name::<F>(), seed, lane);
        let share = evaluations / LANES + u64::from(lane < evaluations % LANES);
        let best = Climb {
            scorer: &scorer,
            evaluated: 0,
            best: None,
        }
        .run(&mut draw, share)?;
        let score = Decimal::of(&scorer.exact(&best)?)?;
        Some(FoundWorst { case: best, score })
    });
    climbed
        .chunks(LANES as usize)
        .map(|lanes| lanes.iter().flatten().copied().reduce(worse))
        .collect()
}

/// The one with the higher score; of equals, the one with the smaller bits.
fn worse<F: Scalar>(a: FoundWorst<F>, b: FoundWorst<F>) -> FoundWorst<F> {
    let order = |found: &FoundWorst<F>| (found.score, std::cmp::Reverse(found.case.bits()));
    if order(&a) < order(&b) { b } else { a }
}

/// One lane's work.
struct Climb<'a, F: Scalar> {
    scorer: &'a Scorer<'a, F>,
    evaluated: u64,
    best: Option<(f64, Case<F>)>,
}

impl<F: Scalar> Climb<'_, F> {
    /// Climbs again and again until the evaluations are used up.
    fn run(mut self, draw: &mut Draw, evaluations: u64) -> Option<Case<F>> {
        while self.evaluated < evaluations {
            // Every other climb begins near the best so far.
            let from_best = self.best.filter(|_| draw.coin());
            let (mut score, mut case) = match from_best {
                Some(best) => best,
                None => self.start(draw, evaluations),
            };
            let mut idle = 0;
            while idle < PATIENCE && self.evaluated < evaluations {
                let candidate = mutate(&case, draw);
                let reached = self.score(&candidate);
                idle = if reached > score { 0 } else { idle + 1 };
                if reached >= score {
                    (score, case) = (reached, candidate);
                }
            }
        }
        self.best
            .filter(|(score, _)| *score >= 0.0)
            .map(|(_, case)| case)
    }

    /// The best of some cases of the families.
    fn start(&mut self, draw: &mut Draw, evaluations: u64) -> (f64, Case<F>) {
        let mut best: Option<(f64, Case<F>)> = None;
        for _ in 0..STARTS {
            let case = family_case(&Parameters::default(), draw);
            let score = self.score(&case);
            if best.is_none_or(|(most, _)| most < score) {
                best = Some((score, case));
            }
            if self.evaluated >= evaluations {
                break;
            }
        }
        best.unwrap_or_else(|| (f64::NEG_INFINITY, family_case(&Parameters::default(), draw)))
    }

    fn score(&mut self, case: &Case<F>) -> f64 {
        self.evaluated += 1;
        let score = self.scorer.quick(case);
        if self.best.is_none_or(|(most, _)| most < score) {
            self.best = Some((score, *case));
        }
        score
    }
}

/// Any case of any family, put through the parameters.
pub fn family_case<F: Scalar>(parameters: &Parameters, draw: &mut Draw) -> Case<F> {
    let family = &FAMILIES[draw.below(FAMILIES.len())];
    let made = family.make::<F>(parameters, draw.bits(), draw.bits() >> 1);
    let cases = made.cases();
    cases[draw.below(cases.len())]
}

/// The exact score of a case for a goal, rounded.
pub fn exact_score<F: Scalar>(goal: &WorstGoal, case: &Case<F>) -> Option<Decimal> {
    Decimal::of(&goal.scorer::<F>().exact(case)?)
}
