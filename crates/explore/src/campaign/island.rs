//! One kernel in one scalar: its population, the kinds that it knows, and how both grow.

use super::find::Find;
use super::population::{Glance, Individual, Niche, Parents, Population};
use super::state::SavedIndividual;
use crate::arith::Float;
use crate::audit::{EpsilonChoice, EpsilonText, Row, RowSpec};
use crate::case::{Case, Draw, Parameters};
use crate::corpus::lines::AnyCase;
use crate::kernel::{PRESETS, Scalar, Tunable};
use crate::moves::mutate;
use crate::shrink::shrink_within;
use crate::signature::Signature;
use crate::worst::family_case;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

/// The cases that are tried to make a new find simpler.
const EFFORT: usize = 400;

/// One in so many of the findings that look like known ones is checked in exact arithmetic.
const LOOK_CLOSER: usize = 12;

/// The exponents of the powers of two that families are scaled by.
const SCALES: [i64; 6] = [0, 0, 2, 8, 30, 60];

/// A case that shows a kind of finding that its island did not know.
pub struct Newcomer<F: Float> {
    individual: Individual<F>,
    kind: Signature,
}

/// The proposals of a lane: the best of each niche.
pub type Proposals<F> = BTreeMap<Niche, (f64, Individual<F>)>;

/// A kernel in a scalar.
pub struct Island<F: Float> {
    name: String,
    epsilons: CampaignRows,
    population: Population<F>,
    known: BTreeSet<Signature>,
}

impl<F: Scalar> Island<F> {
    /// The island of a kernel's rows.
    pub fn new(rows: &[&Row], varies: bool) -> Island<F> {
        Island {
            name: format!("fuzz:{}/{}", rows[0].entry.info.name, F::NAME),
            epsilons: CampaignRows::new(rows, varies),
            population: Population {
                niches: BTreeMap::new(),
            },
            known: BTreeSet::new(),
        }
    }

    /// Some evaluations from this population; a function of it, the seed, the round and the lane.
    pub fn propose(&self, seed: u64, round: u64, lane: u64, evaluations: u64) -> Proposals<F> {
        let mut draw = Draw::new(&self.name, seed, round << 16 | lane);
        let mut best = self.population.best_at_a_glance();
        let parents = self.population.parents();
        let mut proposals: Proposals<F> = BTreeMap::new();
        for _ in 0..evaluations {
            let individual = self.make(&parents, &mut draw);
            let (glance, score) = individual.look();
            let Some(niche) = self.niche(&individual, glance, score, &mut best, &mut draw) else {
                continue;
            };
            let known = proposals.get(&niche).map(|(known, _)| *known);
            if known.is_none_or(|known| known < score) {
                proposals.insert(niche, (score, individual));
            }
        }
        proposals
    }

    /// The niche of an individual. Exact arithmetic runs only for a finding that looks new, that is the
    /// worst of those that look alike, or that is drawn; the result is none for the rest.
    fn niche(
        &self,
        individual: &Individual<F>,
        glance: Glance,
        score: f64,
        best: &mut BTreeMap<Glance, f64>,
        draw: &mut Draw,
    ) -> Option<Niche> {
        if glance.finding.is_none() {
            return Some(Niche::Near(glance));
        }
        let improves = best.get(&glance).is_none_or(|best| *best < score);
        if improves {
            best.insert(glance, score);
        }
        (improves || draw.below(LOOK_CLOSER) == 0)
            .then(|| Signature::of(&individual.row, &individual.case))
            .flatten()
            .map(|signature| Niche::Kind(signature.kind()))
    }

    /// A new individual: of a family at some scale, or some moves from one or two that are kept.
    fn make(&self, parents: &Parents<F>, draw: &mut Draw) -> Individual<F> {
        let parent = if draw.below(4) == 0 {
            None
        } else {
            parents.pick(draw)
        };
        let Some(parent) = parent else {
            let case = family_case(&parameters(draw), draw);
            return Individual {
                case,
                row: self.epsilons.draw(draw),
            };
        };
        let mut child = parent.clone();
        if draw.below(8) == 0 {
            child.row = self.epsilons.draw(draw);
        }
        if let Some(other) = parents.pick(draw).filter(|_| draw.below(16) == 0) {
            child.case.triangle = other.case.triangle;
        }
        child.case = mutate(&child.case, draw);
        child
    }

    /// Takes in what lanes propose, in their order; the newcomers are of kinds unknown until now.
    pub fn take_in(&mut self, lanes: Vec<Proposals<F>>) -> Vec<Newcomer<F>> {
        let mut newcomers = Vec::new();
        for (niche, (score, individual)) in lanes.into_iter().flatten() {
            if let Niche::Kind(kind) = &niche
                && self.known.insert(kind.clone())
            {
                newcomers.push(Newcomer {
                    individual: individual.clone(),
                    kind: kind.clone(),
                });
            }
            self.population.offer(niche, score, individual);
        }
        newcomers
    }

    /// Makes a kind known.
    pub fn learn(&mut self, kind: Signature) {
        self.known.insert(kind);
    }

    /// True if this is the island of a kernel.
    pub fn is_of(&self, kernel: &str) -> bool {
        self.name == format!("fuzz:{kernel}/{}", F::NAME)
    }

    /// The population, to be saved.
    pub fn saved(&self) -> impl Iterator<Item = SavedIndividual> {
        self.population.all().map(|individual| {
            let RowSpec {
                kernel,
                epsilons,
                contract,
                ..
            } = individual.row.spec();
            let bits = individual.case.bits().to_vec();
            SavedIndividual {
                kernel,
                scalar: F::NAME,
                epsilons,
                contract,
                bits,
            }
        })
    }

    /// Takes a saved individual back.
    pub fn restore(&mut self, case: Case<F>, row: Row) {
        let individual = Individual {
            case,
            row: Arc::new(row),
        };
        let (glance, score) = individual.look();
        let kind = Signature::of(&individual.row, &case).map(|signature| signature.kind());
        let niche = kind.map_or(Niche::Near(glance), Niche::Kind);
        self.population.offer(niche, score, individual);
    }
}

impl<F: Scalar> Newcomer<F> {
    /// The find: the same kind on a simpler case, as simple as some hundred tries make it.
    pub fn find(&self, seed: u64, evaluations: u64) -> Find {
        let Newcomer {
            individual: Individual { case, row },
            kind,
        } = self;
        let signature = Signature {
            epsilons: row.epsilon_argument(),
            ..kind.clone()
        };
        let case = shrink_within(case, EFFORT, |case| signature.is_shown(row, case)).case;
        let mut find = Find::new(AnyCase::from(case), row, signature);
        (find.found.seed, find.found.evaluations) = (Some(seed), Some(evaluations));
        find
    }
}

/// A scale, half of the time none, and now and then an offset or a unit direction.
fn parameters(draw: &mut Draw) -> Parameters {
    let most = draw.pick(&SCALES);
    let offset = if draw.below(8) == 0 {
        std::array::from_fn(|_| draw.pick(&[0.0, 1.0, -64.0, 1e4]))
    } else {
        [0.0; 3]
    };
    Parameters {
        scale: draw.integer(-most, most) as i32,
        scale_direction: draw.coin(),
        offset,
        unit_direction: draw.below(8) == 0,
        ..Parameters::default()
    }
}

/// The rows of one kernel that a campaign draws from.
struct CampaignRows {
    rows: Vec<Arc<Row>>,
    varies: bool,
}

impl CampaignRows {
    /// The epsilons of a kernel's rows, of which there is at least one. If they may vary, then also the published
    /// epsilons that fit, zero, and numbers between.
    fn new(rows: &[&Row], varies: bool) -> CampaignRows {
        let mut all: Vec<Row> = rows.iter().map(|row| (*row).clone()).collect();
        let first = rows[0];
        let published = PRESETS.iter().filter(|_| varies).filter_map(|preset| {
            EpsilonChoice::Preset(preset.name.to_owned())
                .rows(&[first.entry], None)
                .ok()
        });
        for row in published.flatten() {
            if all.iter().all(|known| known.epsilons != row.epsilons) {
                all.push(Row {
                    contract: first.contract,
                    ..row
                });
            }
        }
        let varies = varies && first.tuned().next().is_some();
        CampaignRows {
            rows: all.into_iter().map(Arc::new).collect(),
            varies,
        }
    }

    /// One of the rows, or one with numbers between theirs.
    fn draw(&self, draw: &mut Draw) -> Arc<Row> {
        let row = &self.rows[draw.below(self.rows.len())];
        if self.varies && draw.below(3) == 0 {
            self.between(row, draw)
        } else {
            row.clone()
        }
    }

    /// A row some of whose epsilons lie between zero and one that another row has there.
    fn between(&self, row: &Row, draw: &mut Draw) -> Arc<Row> {
        let mut row = row.clone();
        for (i, gate) in row.entry.info.gates.iter().enumerate() {
            if gate.epsilon == Tunable::Fixed || draw.coin() {
                continue;
            }
            let other = &self.rows[draw.below(self.rows.len())].epsilons[i];
            let value = other
                .value::<f64>()
                .filter(|value| *value != 0.0)
                .unwrap_or(1e-6);
            // Two digits: whoever reads them should be able to remember them.
            let share = draw.unit() * draw.pick(&[1.0, 1e-2, 1e-4, 1e-8]);
            row.epsilons[i] = EpsilonText::Decimal(format!("{:.1e}", value * share));
        }
        row.set = row.epsilon_argument().unwrap_or(row.set);
        Arc::new(row)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kernel::KERNELS;
    use std::collections::BTreeSet;

    #[test]
    fn every_row_that_is_drawn_can_be_named_again() {
        let mut draw = Draw::new("epsilons", 1, 0);
        for entry in KERNELS {
            let rows = EpsilonChoice::Source.rows(&[entry], None).unwrap();
            let epsilons = CampaignRows::new(&rows.iter().collect::<Vec<_>>(), true);
            let mut seen = BTreeSet::new();
            for _ in 0..200 {
                let row = epsilons.draw(&mut draw);
                let argument = row.epsilon_argument();
                let again = Row::named(entry.info.name, argument.as_deref(), "own").unwrap();
                assert_eq!(
                    again.epsilons::<f32>(),
                    row.epsilons::<f32>(),
                    "{argument:?}"
                );
                assert_eq!(
                    again.epsilons::<f64>(),
                    row.epsilons::<f64>(),
                    "{argument:?}"
                );
                seen.insert(argument);
            }
            assert!(
                rows[0].tuned().next().is_none() || seen.len() > 30,
                "{}",
                entry.info.name
            );
            let fixed = CampaignRows::new(&[&rows[0]], false);
            assert!((0..20).all(|_| fixed.draw(&mut draw).epsilons == rows[0].epsilons));
        }
    }
}
