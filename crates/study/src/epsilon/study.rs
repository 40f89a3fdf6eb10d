//! A study of a kernel's epsilons: the responses, what follows from them, and what the most interesting
//! epsilons cost when the kernel is run with them.

use super::advice::{Trade, candidates, decades, total};
use super::axis::Axis;
use super::curve::Question;
use super::duty::Duty;
use super::run::{Request, Response, SourceResponse, run};
use crate::arith::Float;
use crate::audit::{Audit, EpsilonText, Observer, Plan, Row, Source, Tally, run_scalar};
use crate::judge::{Class, Finding};
use crate::kernel::{Gate, PRESETS, Preset, Scalar, Subject};

/// The plan of a study.
pub struct StudyPlan<'a, F: 'static> {
    /// The kernel, its contract, and the epsilons of the gates that are not varied.
    pub row: &'a Row,
    /// The same kernel in the scalar.
    pub subject: &'static dyn Subject<F>,
    /// The gates, each varied alone.
    pub gates: Vec<usize>,
    /// Further epsilons to weigh.
    pub at: Vec<F>,
    /// Keep every margin.
    pub exact: bool,
}

/// A study's results.
pub struct Study<F> {
    /// By source.
    pub responses: Vec<SourceResponse<F>>,
    /// By gate of the plan.
    pub gates: Vec<GateStudy<F>>,
}

/// A study's results for one gate.
pub struct GateStudy<F> {
    /// The gate's place in the kernel's chain.
    pub gate: usize,
    /// All sources together.
    pub total: Response<F>,
    /// The false misses and the false hits between which an epsilon trades.
    pub trade: Trade<F>,
    /// Epsilons with names: the row's own, presets.
    pub marks: Vec<(String, F)>,
    /// The prices of epsilons, in order.
    pub prices: Vec<Price<F>>,
}

/// The audit's findings with one epsilon.
pub struct Price<F> {
    /// The epsilon.
    pub epsilon: F,
    /// The kernel's row with it.
    pub row: Row,
    /// By source.
    pub tallies: Vec<Tally>,
}

/// The name of the epsilon with the least sum of both shares.
pub const LEAST_SUM: &str = "least sum of both";

/// Powers of ten to weigh, beside the limits, presets and given epsilons.
const DECADES_WEIGHED: usize = 12;

/// Runs a study. The error is a disagreement between a response and the audit: a fault of this tool.
pub fn study<F: Scalar>(
    plan: &StudyPlan<'_, F>,
    sources: &[Source],
    observer: &dyn Observer,
) -> Result<Study<F>, String> {
    let gates = plan.row.entry.info.gates;
    let own: Vec<F> = plan.row.epsilons();
    let marks_of = |gate: usize| marks(&gates[gate], plan.row, own[gate]);
    let mut edges: Vec<F> = decades().chain(plan.at.iter().copied()).collect();
    edges.extend(plan.gates.iter().flat_map(|gate| marks_of(*gate)).map(|(_, epsilon)| epsilon));
    let axis = Axis::new(&edges);
    let request = Request {
        row: plan.row,
        subject: plan.subject,
        gates: &plan.gates,
        axis: &axis,
        exact: plan.exact,
    };
    let responses = run(&request, sources, observer);
    let mut studies = Vec::new();
    for (n, &gate) in plan.gates.iter().enumerate() {
        let duty = Duty::of(gates, gate, &plan.row.contract);
        let trade = Trade::new(&gates[gate], &duty, n, sources, &responses);
        let mut marks = marks_of(gate);
        let mut weighed = candidates(&trade, DECADES_WEIGHED);
        weighed.extend(marks.iter().map(|(_, epsilon)| *epsilon).chain(plan.at.iter().copied()));
        weighed.retain(|epsilon| trade.floor <= *epsilon);
        if let (None, Some(knee)) = (trade.settled(), trade.knee(axis.edges())) {
            weighed.push(knee);
            marks.push((LEAST_SUM.to_owned(), knee));
            marks.sort_by_key(|(_, epsilon)| epsilon.place());
        }
        weighed.sort_by_key(|epsilon| epsilon.place());
        weighed.dedup_by(|a, b| a == b);
        let total = total(n, &responses).ok_or("no source")?;
        let prices = prices(plan.row, gate, &weighed, sources, observer);
        check(&prices, &duty, n, &responses)?;
        studies.push(GateStudy { gate, total, trade, marks, prices });
    }
    Ok(Study { responses, gates: studies })
}

/// The epsilons of a gate that have names, by value.
fn marks<F: Scalar>(gate: &Gate, row: &Row, own: F) -> Vec<(String, F)> {
    let preset = |preset: &Preset| {
        let entry = preset.entries.iter().find(|entry| entry.fits(gate))?;
        let value = EpsilonText::from(entry.value).value::<F>()?;
        Some((preset.name.to_owned(), value))
    };
    let mut marks = vec![(format!("this row: {}", row.set), own)];
    marks.extend(PRESETS.iter().filter_map(preset));
    marks.sort_by_key(|(_, epsilon)| epsilon.place());
    marks
}

fn prices<F: Scalar>(
    row: &Row,
    gate: usize,
    epsilons: &[F],
    sources: &[Source],
    observer: &dyn Observer,
) -> Vec<Price<F>> {
    let rows: Vec<Row> = epsilons
        .iter()
        .map(|epsilon| {
            let mut row = row.clone();
            row.epsilons[gate] = EpsilonText::Decimal(format!("{epsilon:e}"));
            row
        })
        .collect();
    let mut prices: Vec<Price<F>> = epsilons
        .iter()
        .zip(&rows)
        .map(|(epsilon, row)| Price { epsilon: *epsilon, row: row.clone(), tallies: Vec::new() })
        .collect();
    let mut audit = Audit::default();
    let scalars = [F::NAME == f32::NAME, F::NAME == f64::NAME];
    let plan = Plan { rows, sources: sources.to_vec(), scalars, examples: 0, attribute: 0 };
    run_scalar::<F>(&plan, observer, &mut audit);
    for cell in audit.cells {
        prices[cell.row].tallies.push(cell.tally);
    }
    prices
}

/// The false hits that a gate is there to refuse, and of how many.
pub fn own_false_hits(duty: &Duty, tally: &Tally) -> (u64, u64) {
    if duty.guards_start() && tally.self_hits.rays > 0 {
        return (tally.self_hits.hits, tally.self_hits.rays);
    }
    let guarded = Class::all().filter(|class| duty.guards(*class));
    let counts = guarded.map(|class| &tally.classes[class.number()]);
    counts.fold((0, 0), |(count, of), class| {
        (count + class.of(Finding::FalseHit), of + class.trials(Finding::FalseHit))
    })
}

/// Compares the responses with what the audit counted.
fn check<F: Scalar>(
    prices: &[Price<F>],
    duty: &Duty,
    n: usize,
    responses: &[SourceResponse<F>],
) -> Result<(), String> {
    for price in prices {
        for (tally, response) in price.tallies.iter().zip(responses) {
            let total = tally.total();
            let counts = [
                (Question::FalseMiss, total.of(Finding::FalseMiss)),
                (Question::FalseHit, total.of(Finding::FalseHit)),
                (Question::Crack, tally.groups.cracks),
                (Question::Double, tally.groups.doubles),
                (Question::SelfHit, tally.self_hits.hits),
                (Question::OwnFalseHit, own_false_hits(duty, tally).0),
            ];
            for (question, count) in counts {
                let wrong = response.gates[n].curve(question).wrong(price.epsilon);
                if !(wrong.low..=wrong.high).contains(&count) {
                    let (epsilon, name) = (price.epsilon, question.name());
                    return Err(format!(
                        "the response says {} to {} {name} at e = {epsilon:e}, the run {count}",
                        wrong.low, wrong.high
                    ));
                }
            }
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::audit::{EpsilonChoice, Unobserved};
    use crate::case::Parameters;
    use crate::family::find;

    #[test]
    fn what_a_gate_is_there_to_refuse_are_false_hits_of_its_classes_or_second_hits() {
        let info = crate::kernel::find("plane-unit-normal").unwrap().info;
        for (gate, known) in info.gates.iter().enumerate() {
            let duty = Duty::of(info.gates, gate, &info.contract);
            let mut tally = Tally::new(0, 0);
            let mut expected = (0, 0);
            for class in Class::all() {
                let (count, of) = (class.number() as u64 + 1, 100 + class.number() as u64);
                let counts = &mut tally.classes[class.number()];
                counts.findings[Finding::FalseHit as usize] = count;
                counts.findings[Finding::FalseMiss as usize] = 1000;
                counts.must_miss = of;
                if duty.guards(class) {
                    expected = (expected.0 + count, expected.1 + of);
                }
            }
            assert_eq!(own_false_hits(&duty, &tally), expected, "{}", known.name);
            (tally.self_hits.hits, tally.self_hits.rays) = (3, 50);
            let expected = if duty.guards_start() { (3, 50) } else { expected };
            assert_eq!(own_false_hits(&duty, &tally), expected, "{}", known.name);
        }
    }

    #[test]
    fn a_study_weighs_what_has_a_name_and_what_is_asked_for() {
        let entry = crate::kernel::find("moller-trumbore").unwrap();
        let row = EpsilonChoice::Source.rows(&[entry], None).unwrap().remove(0);
        let source = |name| Source::Family {
            family: find(name).unwrap(),
            parameters: Parameters::default(),
            seed: 1,
            count: 80,
            exhaustive: false,
        };
        let sources = ["grazing", "edge-near", "secondary-ray"].map(source);
        let subject = f32::subject(entry).unwrap();
        let (gates, at) = (vec![0, 1], vec![0.125, -0.25]);
        let plan = StudyPlan { row: &row, subject, gates, at, exact: false };
        let found = study(&plan, &sources, &Unobserved).unwrap();
        let own = row.epsilons::<f32>();
        for (gate, of_gate) in found.gates.iter().enumerate() {
            assert_eq!(of_gate.gate, gate);
            let epsilons: Vec<f32> = of_gate.prices.iter().map(|price| price.epsilon).collect();
            assert!(epsilons.windows(2).all(|pair| pair[0] < pair[1]), "{epsilons:?}");
            let takes_negative = entry.info.gates[gate].epsilon == crate::kernel::Tunable::Signed;
            assert_eq!(epsilons.contains(&-0.25), takes_negative);
            assert!(epsilons.contains(&0.125) && epsilons.contains(&0.0));
            assert!(of_gate.marks.windows(2).all(|pair| pair[0].1 <= pair[1].1));
            let named = |name: &str| of_gate.marks.iter().find(|mark| mark.0 == name).map(|m| m.1);
            assert_eq!(named(&format!("this row: {}", row.set)), Some(own[gate]));
            for (name, epsilon) in &of_gate.marks {
                assert!(epsilons.contains(epsilon), "{name}");
                let preset = PRESETS.iter().find(|preset| preset.name == name.as_str());
                assert!(preset.is_some() || name.starts_with("this row") || name == LEAST_SUM);
            }
            assert_eq!(named(LEAST_SUM).is_none(), of_gate.trade.settled().is_some());
            let all =
                found.responses.iter().map(|r| r.gates[gate].curve(Question::FalseMiss).total);
            assert_eq!(of_gate.total.curve(Question::FalseMiss).total, all.sum::<u64>());
            for price in &of_gate.prices {
                assert_eq!(price.row.epsilons::<f32>()[gate], price.epsilon);
                assert_eq!(price.row.epsilons::<f32>()[1 - gate], own[1 - gate]);
                assert_eq!(price.tallies.len(), sources.len());
                let misses = price.tallies.iter().map(|t| t.total().of(Finding::FalseMiss));
                let wrong = of_gate.total.curve(Question::FalseMiss).wrong(price.epsilon);
                assert!((wrong.low..=wrong.high).contains(&misses.sum()), "{:e}", price.epsilon);
            }
        }
    }

    #[test]
    fn a_response_that_differs_from_the_run_is_a_fault() {
        let entry = crate::kernel::find("moller-trumbore").unwrap();
        let row = EpsilonChoice::Source.rows(&[entry], None).unwrap().remove(0);
        let family = find("edge-near").unwrap();
        let parameters = Parameters::default();
        let source = |seed| {
            [Source::Family {
                family,
                parameters: parameters.clone(),
                seed,
                count: 80,
                exhaustive: false,
            }]
        };
        let (subject, axis) = (f32::subject(entry).unwrap(), Axis::new(&[]));
        let request = Request { row: &row, subject, gates: &[1], axis: &axis, exact: true };
        let duty = Duty::of(entry.info.gates, 1, &row.contract);
        let responses = run(&request, &source(1), &Unobserved);
        let prices_of = |seed| prices(&row, 1, &[0.0f32, 0.01], &source(seed), &Unobserved);
        assert_eq!(check(&prices_of(1), &duty, 0, &responses), Ok(()));
        let fault = check(&prices_of(2), &duty, 0, &responses).unwrap_err();
        assert!(fault.contains("the response says") && fault.contains("the run"), "{fault}");
    }
}
