//! The cases that an island keeps, by what they show.

use crate::arith::Float;
use crate::audit::Row;
use crate::case::{Case, Draw};
use crate::judge::{Class, Distances, Finding};
use crate::kernel::Scalar;
use crate::objective::{scale, verdict_and_finding};
use crate::signature::Signature;
use crate::truth::Truth;
use std::collections::BTreeMap;
use std::sync::Arc;

/// How many cases a niche keeps.
const NICHE: usize = 4;

/// A case with epsilons.
#[derive(Clone)]
pub struct Individual<F: Float> {
    /// The case.
    pub case: Case<F>,
    /// The kernel with its epsilons.
    pub row: Arc<Row>,
}

/// The features of a verdict that can be seen without exact arithmetic.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct Glance {
    /// The finding.
    pub finding: Option<Finding>,
    /// The class of the truth.
    pub class: Class,
    /// The gate that refused.
    pub gate: Option<&'static str>,
}

/// A niche in which individuals compete: a kind of finding, or a class and a gate without one.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord)]
pub enum Niche {
    /// No finding yet.
    Near(Glance),
    /// This kind of finding.
    Kind(Signature),
}

impl Niche {
    fn glance(&self) -> Glance {
        match self {
            Niche::Near(glance) => *glance,
            Niche::Kind(Signature {
                finding,
                class,
                gate,
                ..
            }) => Glance {
                finding: Some(*finding),
                class: *class,
                gate: *gate,
            },
        }
    }
}

impl<F: Scalar> Individual<F> {
    /// Its features at a glance, and its score: the severity of a finding, or else minus the distance
    /// from the nearest change of the verdict.
    pub fn look(&self) -> (Glance, f64) {
        let epsilons: Vec<F> = self.row.epsilons();
        let (truth, verdict, finding) = verdict_and_finding(&self.row, &epsilons, &self.case);
        let gates = self.row.entry.info.gates;
        let gate = verdict.refused_by.map(|gate| gates[usize::from(gate)].name);
        let glance = Glance {
            finding,
            class: Class::of(&truth),
            gate,
        };
        let score = match finding {
            _ if truth == Truth::Invalid => 0.0,
            Some(_) => Distances::at_a_glance(&self.case, &truth)
                .nearest_change(&truth, &self.row.contract),
            None => -self.distance_from_a_change(&epsilons, &truth, verdict.hit),
        };
        (
            glance,
            if score.is_nan() {
                f64::NEG_INFINITY
            } else {
                score
            },
        )
    }

    /// How far the margins are from where the verdict changes, in shares of the gates' scales: of a
    /// hit the nearest gate, of a miss the farthest of those that refuse. Where a gate without an
    /// epsilon refuses, how far the line is from the triangle's boundary.
    fn distance_from_a_change(&self, epsilons: &[F], truth: &Truth, hit: bool) -> f64 {
        let gates = self.row.entry.info.gates;
        let gated = F::subject(self.row.entry).and_then(|subject| subject.gated());
        let Some(gated) = gated else {
            return Distances::at_a_glance(&self.case, truth).in_space;
        };
        let margins = gated.measure(&self.case).margins;
        let wide = self.case.widen();
        let gap = |i: usize| {
            let (margin, epsilon) = (margins[i].to_f64(), epsilons[i].to_f64());
            let unit = scale(&wide.ray, &wide.triangle, gates[i].dimension).max(epsilon.abs());
            (margin - epsilon) / unit
        };
        let refused = |i: &usize| margins[*i] < epsilons[*i];
        let all = 0..gates.len();
        let distance = if hit {
            all.map(gap)
                .filter(|gap| gap.is_finite())
                .fold(f64::INFINITY, f64::min)
        } else {
            all.filter(refused).map(|i| -gap(i)).fold(0.0, f64::max)
        };
        if distance.is_finite() {
            distance.abs()
        } else {
            Distances::at_a_glance(&self.case, truth).in_space
        }
    }
}

/// A bounded population, which begins empty: a few individuals a niche, the best by score.
pub struct Population<F: Float> {
    pub(super) niches: BTreeMap<Niche, Vec<(f64, Individual<F>)>>,
}

impl<F: Scalar> Population<F> {
    /// Keeps an individual if its niche has room or a worse one.
    pub fn offer(&mut self, niche: Niche, score: f64, individual: Individual<F>) {
        let kept = self.niches.entry(niche).or_default();
        let place = kept
            .iter()
            .position(|(other, _)| *other < score)
            .unwrap_or(kept.len());
        let same = |(_, other): &(f64, Individual<F>)| other.case.bits() == individual.case.bits();
        if place < NICHE && !kept.iter().any(same) {
            kept.insert(place, (score, individual));
            kept.truncate(NICHE);
        }
    }

    /// The individuals by niche, to pick from.
    pub fn parents(&self) -> Parents<'_, F> {
        Parents(self.niches.values().map(Vec::as_slice).collect())
    }

    /// All individuals, niche by niche.
    pub fn all(&self) -> impl Iterator<Item = &Individual<F>> {
        self.niches
            .values()
            .flatten()
            .map(|(_, individual)| individual)
    }

    /// The best score of what looks alike at a glance.
    pub fn best_at_a_glance(&self) -> BTreeMap<Glance, f64> {
        let mut best = BTreeMap::new();
        for (niche, kept) in &self.niches {
            let most: &mut f64 = best.entry(niche.glance()).or_insert(f64::NEG_INFINITY);
            *most = kept.iter().fold(*most, |most, (score, _)| most.max(*score));
        }
        best
    }
}

/// A population while nothing is added to it.
pub struct Parents<'p, F: Float>(Vec<&'p [(f64, Individual<F>)]>);

impl<'p, F: Scalar> Parents<'p, F> {
    /// A random individual, each niche equally likely; none if the population is empty.
    pub fn pick(&self, draw: &mut Draw) -> Option<&'p Individual<F>> {
        let niche = self.0.get(draw.below(self.0.len().max(1)))?;
        niche
            .get(draw.below(niche.len()))
            .map(|(_, individual)| individual)
    }
}
