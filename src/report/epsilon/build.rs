//! From a study to its record.

use super::record::*;
use crate::arith::Float;
use crate::audit::{Place, Row, Source, Tally, Trials, exact_severity};
use crate::case::Case;
use crate::epsilon::{
    Curve, Duty, GateStudy, Price, Question, Response, Side, SourceResponse, Study, StudyPlan,
    own_false_hits,
};
use crate::family::Grouping;
use crate::judge::{Class, Finding};
use crate::kernel::Scalar;
use crate::prove::in_short;
use crate::report::Rate;
use crate::report::build::{explain_command, planned_source};

/// The parts of a record that are about one row in one scalar.
pub fn parts<F: Scalar>(
    plan: &StudyPlan<'_, F>,
    sources: &[Source],
    study: &Study<F>,
) -> Vec<GatePart> {
    let gates = study.gates.iter().enumerate();
    gates.map(|(n, gate)| gate_part(plan, sources, study, n, gate)).collect()
}

/// A record of parts.
pub fn record(
    sources: &[Source],
    parts: Vec<Vec<GatePart>>,
    threads: usize,
    seconds: f64,
) -> EpsilonRecord {
    EpsilonRecord {
        schema: EPSILON_SCHEMA.to_owned(),
        result: EpsilonResult {
            sources: sources.iter().map(planned_source).collect(),
            gates: parts.into_iter().flatten().collect(),
        },
        provenance: EpsilonProvenance {
            tool: concat!("hairline ", env!("CARGO_PKG_VERSION")).to_owned(),
            target: format!("{}-{}", std::env::consts::ARCH, std::env::consts::OS),
            threads,
            seconds,
        },
    }
}

/// The shortest decimal of an epsilon.
pub fn shortest<F: Float>(epsilon: F) -> String {
    if epsilon.is_zero() { "0".to_owned() } else { format!("{epsilon:e}") }
}

fn gate_part<F: Scalar>(
    plan: &StudyPlan<'_, F>,
    sources: &[Source],
    study: &Study<F>,
    n: usize,
    gate_study: &GateStudy<F>,
) -> GatePart {
    let info = plan.row.entry.info;
    let gate = &info.gates[gate_study.gate];
    let others = plan.row.tuned().filter(|(other, _)| other.name != gate.name);
    let each = sources.iter().zip(&study.responses).map(|(source, response)| {
        curve_part(source.name(), source.is_sample(), &response.gates[n], &[])
    });
    let marks: Vec<F> = gate_study.marks.iter().map(|(_, epsilon)| *epsilon).collect();
    let sampled = sources.iter().any(Source::is_sample);
    let all = curve_part("all".to_owned(), sampled, &gate_study.total, &marks);
    GatePart {
        kernel: info.name.to_owned(),
        scalar: F::NAME.to_owned(),
        gate: gate.name.to_owned(),
        refuses: gate.refuses.to_owned(),
        dimension: [gate.dimension.length, gate.dimension.direction],
        others: others.map(|(gate, text)| (gate.name.to_owned(), text.to_string())).collect(),
        contract: plan.row.contract.describe(),
        exact: plan.exact,
        marks: gate_study
            .marks
            .iter()
            .map(|(name, epsilon)| MarkPart { name: name.clone(), epsilon: shortest(*epsilon) })
            .collect(),
        curves: std::iter::once(all).chain(each).collect(),
        trade: trade_part(plan.row, sources, gate_study),
        prices: price_parts(plan.row, sources, study, n),
        proved: in_short::<F>(plan.row.entry, gate_study.gate),
    }
}

fn curve_part<F: Scalar>(
    family: String,
    sample: bool,
    response: &Response<F>,
    marks: &[F],
) -> CurvePart {
    let decisive = |curve: &Curve<F>| curve.decisive.map(|(m, _)| [m, m.offset_ulps(1)]);
    let mut epsilons: Vec<F> = response.curves.iter().flat_map(|curve| curve.steps()).collect();
    epsilons.extend(response.curves.iter().filter_map(decisive).flatten());
    epsilons.extend(marks);
    epsilons.retain(|epsilon| epsilon.is_finite());
    epsilons.sort_by_key(|epsilon| epsilon.place());
    epsilons.dedup_by(|a, b| a == b);
    let wrong = |epsilon: F| {
        let counts = Question::ALL.map(|question| response.curve(question).wrong(epsilon).exact());
        // A decisive margin of one question may fall inside a cell of another.
        let [a, b, c, d, e, f] = counts;
        Some((shortest(epsilon), [a?, b?, c?, d?, e?, f?]))
    };
    CurvePart {
        family,
        sample,
        asked: Question::ALL.map(|question| response.curve(question).total),
        asked_squared: Question::ALL.map(|question| response.curve(question).squared),
        points: epsilons.into_iter().filter_map(wrong).collect(),
    }
}

fn trade_part<F: Scalar>(row: &Row, sources: &[Source], study: &GateStudy<F>) -> TradePart {
    let gates = row.entry.info.gates;
    let limit = |side: &Side<F>| LimitPart {
        of: side.curve.total,
        unavoidable: side.unavoidable,
        limit: shortest(side.limit),
        command: side.decided_by.map(|(source, place)| command::<F>(&sources[source], row, place)),
    };
    let trade = &study.trade;
    let refused = study.total.refused_by_others.iter().enumerate().filter(|(_, count)| **count > 0);
    TradePart {
        floor: shortest(trade.floor),
        misses: limit(&trade.misses),
        hits: limit(&trade.hits),
        settled: trade.settled().map(|(from, to)| [shortest(from), shortest(to)]),
        refused_by_others: refused
            .map(|(gate, count)| (gates[gate].name.to_owned(), *count))
            .collect(),
    }
}

/// Shows the case of a place.
fn command<F: Scalar>(source: &Source, row: &Row, place: Place) -> String {
    let triangles = source.make::<F>(place.index).cases().len();
    let triangle = (triangles > 1).then_some(place.triangle as usize);
    explain_command::<F>(source, row, place.index, triangle)
}

fn price_parts<F: Scalar>(
    row: &Row,
    sources: &[Source],
    study: &Study<F>,
    n: usize,
) -> Vec<PricePart> {
    let pricing = Pricing::new(row, sources, study, n);
    let mut parts: Vec<PricePart> =
        study.gates[n].prices.iter().map(|price| pricing.part(price)).collect();
    let costs: Vec<[u64; 2]> =
        parts.iter().map(|part| [part.lost.count, part.let_through.count]).collect();
    for (part, cost) in parts.iter_mut().zip(&costs) {
        let beats = |other: &[u64; 2]| other != cost && other[0] <= cost[0] && other[1] <= cost[1];
        part.on_front = !costs.iter().any(beats);
    }
    parts
}

/// The data from which the prices of one gate are computed.
struct Pricing<'a, F> {
    duty: Duty,
    sources: &'a [Source],
    marks: &'a [(String, F)],
    /// By source: cases that must be hit and that other gates refuse.
    refused_by_others: Vec<u64>,
    sampled: bool,
}

impl<'a, F: Scalar> Pricing<'a, F> {
    fn new(row: &'a Row, sources: &'a [Source], study: &'a Study<F>, n: usize) -> Self {
        let (info, gate) = (row.entry.info, study.gates[n].gate);
        let refused =
            |response: &SourceResponse<F>| response.gates[n].refused_by_others.iter().sum();
        Pricing {
            duty: Duty::of(info.gates, gate, &row.contract),
            sources,
            marks: &study.gates[n].marks,
            refused_by_others: study.responses.iter().map(refused).collect(),
            sampled: sources.iter().any(Source::is_sample),
        }
    }

    fn part(&self, price: &Price<F>) -> PricePart {
        let by_source: Vec<[Trials; 4]> =
            (0..self.sources.len()).map(|i| self.counts(i, &price.tallies[i])).collect();
        let sum = |kind: usize| {
            let mut sum = Trials::default();
            by_source.iter().for_each(|counts| sum.merge(&counts[kind]));
            Rate::new(sum, self.sampled)
        };
        let groups = |count: fn(&Tally) -> u64| {
            let of = price.tallies.iter().map(|tally| tally.groups.crossings).sum();
            let count = price.tallies.iter().map(count).sum();
            Rate::new(Trials::independent(count, of), self.sampled)
        };
        let family = |(source, counts): (&Source, &[Trials; 4])| FamilyPrice {
            family: source.name(),
            lost: Rate::new(counts[0], source.is_sample()),
            let_through: Rate::new(counts[1], source.is_sample()),
        };
        let named = self.marks.iter().filter(|(_, epsilon)| *epsilon == price.epsilon);
        PricePart {
            epsilon: shortest(price.epsilon),
            names: named.map(|(name, _)| name.clone()).collect(),
            on_front: false,
            lost: sum(0),
            let_through: sum(1),
            false_misses: sum(2),
            false_hits: sum(3),
            cracks: groups(|tally| tally.groups.cracks),
            doubles: groups(|tally| tally.groups.doubles),
            families: self
                .sources
                .iter()
                .zip(&by_source)
                .filter(|(_, counts)| counts[0].count > 0 || counts[1].count > 0)
                .map(family)
                .collect(),
            farthest: self.farthest(price),
        }
    }

    /// On one source: hits that this gate loses, false hits that it lets through, all false misses,
    /// all false hits. The parts of all cluster on rays as all do.
    fn counts(&self, source: usize, tally: &Tally) -> [Trials; 4] {
        let [misses, hits] =
            [Finding::FalseMiss, Finding::FalseHit].map(|kind| tally.trials(None, kind));
        let secondary = self.sources[source].grouping() == Grouping::SecondaryRay;
        let lost = if self.duty.guards_start() && secondary {
            Trials::default()
        } else {
            // The study held these counts against each other.
            misses.scaled(misses.count - self.refused_by_others[source], misses.of)
        };
        let (own, guarded) = own_false_hits(&self.duty, tally);
        [lost, hits.scaled(own, guarded), misses, hits]
    }

    /// The false hit farthest outside, by the tallies' approximation; its distance is exact.
    fn farthest(&self, price: &Price<F>) -> Option<FarthestPart> {
        let worst = self.sources.iter().zip(&price.tallies).flat_map(|(source, tally)| {
            let own = tally.examples.iter().filter(|((class, finding), _)| {
                *finding == Finding::FalseHit && self.duty.guards(*class)
            });
            own.filter_map(move |((class, _), examples)| {
                examples.worst.map(|worst| (source, class, worst))
            })
        });
        let (source, class, (_, place)) =
            worst.max_by(|(.., (a, _)), (.., (b, _))| a.total_cmp(b))?;
        let made = source.make::<F>(place.index);
        let case: &Case<F> = &made.cases()[place.triangle as usize];
        let severity = exact_severity(case, price.row.contract.extent)?;
        let edges = distance(class, severity.in_space, severity.along);
        Some(FarthestPart {
            edges,
            ulps: edges * severity.edge_in_ulps,
            command: command::<F>(source, &price.row, place),
        })
    }
}

/// How far outside a false hit is: off the ends, off the triangle, or both.
fn distance(class: Class, in_space: f64, along: Option<f64>) -> f64 {
    let outside = if class.part() == "outside" { in_space } else { 0.0 };
    match along {
        Some(along) if class.is_off_the_interval() => outside.max(along),
        _ => in_space,
    }
}
