//! A row of an explained case: what it answers, what its gates computed, and why it is wrong.

use super::advice::{advice, of_invalid, of_line};
use super::margin::margin_text;
use super::near::{Nearby, add_relations};
use super::nearest::nearest;
use super::verdict::{number, plain, short, verdict_of};
use super::{ExplainedGate, ExplainedRow};
use crate::arith::{Exact, Float, ScalarName};
use crate::audit::{Attribution, Errors, Row, attribute, attribute_by_running};
use crate::case::Case;
use crate::epsilon::shortest;
use crate::judge::{ALLOWANCE, Finding, Obligation, ValueErrors, asked, judge};
use crate::kernel::{Gated, Gives, KernelIn, Scalar, Tunable, Verdict};
use crate::oracle;
use crate::truth::{Feature, Truth};
use std::slice;

/// A verdict beside what is asked.
pub(super) fn answered<F>(
    owed: Obligation,
    verdict: &Verdict<F>,
    finding: Option<Finding>,
) -> ExplainedRow {
    let said = match verdict.failure {
        Some(failure) => failure.to_string(),
        None => if verdict.hit { "hit" } else { "miss" }.to_owned(),
    };
    let asked = match owed {
        Obligation::MustHit => "a hit",
        Obligation::MustMiss => "a miss",
        Obligation::Free => "nothing",
    };
    ExplainedRow {
        said,
        asked,
        finding: finding.map(Finding::name),
        runs: true,
        ..ExplainedRow::default()
    }
}

/// The answer of a row, and all that explains it.
pub(super) fn row_part<F: Scalar>(case: &Case<F>, is_secondary: bool, row: &Row) -> ExplainedRow {
    let (kernel, set) = (row.entry.info.name.to_owned(), row.set.clone());
    let contract = row.contract.describe();
    let Some(subject) = F::subject(row.entry) else {
        let others: Vec<&str> = ScalarName::among(row.entry.scalars())
            .map(ScalarName::name)
            .collect();
        let said = format!(
            "does not run in {} (it does in {})",
            F::NAME,
            others.join(", ")
        );
        return ExplainedRow {
            kernel,
            set,
            contract,
            said,
            ..ExplainedRow::default()
        };
    };
    let truth = oracle::define(case).truth;
    let epsilons: Vec<F> = row.epsilons();
    let verdict = verdict_of(subject, case, &epsilons);
    let owed = asked(case, &truth, &row.contract, is_secondary);
    let gives = row.entry.info.gives;
    let finding = judge((&row.contract, owed), (case, &truth), gives, &verdict);
    let mut part = ExplainedRow {
        kernel,
        set,
        contract,
        ..answered(owed, &verdict, finding)
    };
    if verdict.failure.is_some() {
        return part;
    }
    match subject.gated() {
        Some(gated) => add_gates(&mut part, case, gated, &verdict, row),
        None => add_epsilons(&mut part, case, subject, &verdict, row),
    }
    if let Some(finding) = finding {
        let info = row.entry.info;
        let asked = (&row.contract, owed);
        let cause = match subject.gated() {
            Some(_) => attribute(subject, case, &epsilons, &truth, asked),
            None => attribute_by_running(subject, info, case, &epsilons, &truth, asked),
        };
        part.why = Some(in_words(cause, subject.gated().is_some()));
        part.cause = cause
            .map_or("cannot be told", Attribution::in_short)
            .to_owned();
        part.advice = advice(case, is_secondary, row, (finding, cause), &verdict);
        if subject.gated().is_none()
            && let Some(nearby) = Nearby::of(case, row)
        {
            add_relations(&mut part, nearby.relations(row), cause);
            part.notes
                .extend(nearest(case, is_secondary, row, &verdict, &nearby));
        }
    }
    part.notes.extend(of_line(case, row, &verdict));
    part.notes.extend(of_invalid(&truth, subject, &verdict));
    if verdict.hit {
        part.values.push(values(gives, &verdict));
        let tolerance = row.contract.value_tolerance;
        part.values
            .extend(errors(case, &truth, finding, (gives, tolerance), &verdict));
    }
    part
}

fn in_words(cause: Option<Attribution>, shows_gates: bool) -> String {
    let why_not = match (cause, shows_gates) {
        (Some(Attribution::Epsilon), false) => {
            return "epsilon (with every epsilon 0 it is right, and wrong with these)".to_owned();
        }
        (Some(cause), _) => return cause.describe(),
        (None, true) => "it does not run in exact arithmetic",
        (None, false) => {
            "it does not show its formula, and declares no epsilons at which it could be run otherwise (docs/guide/own-kernel.md)"
        }
    };
    format!("cannot be told: {why_not}")
}

/// The epsilons that the kernel was given, where it does not show its gates, and the margins that runs at other
/// epsilons find.
fn add_epsilons<F: Scalar>(
    part: &mut ExplainedRow,
    case: &Case<F>,
    subject: &dyn KernelIn<F>,
    verdict: &Verdict<F>,
    row: &Row,
) {
    let info = row.entry.info;
    let epsilons: Vec<F> = row.epsilons();
    let mut margins = vec![F::from_f64(f64::NAN); info.gates.len()];
    if subject.tells_margins() {
        subject.margins(info, slice::from_ref(case), &mut margins, &mut []);
    }
    if margins.iter().any(|margin| *margin == -F::infinity()) {
        let note = "a miss whatever its epsilons are: none of its gates explains it";
        part.notes.push(note.to_owned());
    }
    for (i, gate) in info
        .gates
        .iter()
        .enumerate()
        .filter(|(_, g)| g.epsilon != Tunable::Fixed)
    {
        let (margin, e) = (margins[i], epsilons[i]);
        let accepted = if margin == F::infinity() {
            Some("at every e".to_owned())
        } else if margin.is_nan() || margin == -F::infinity() {
            None
        } else {
            Some(margin_text(&Exact::from_f64(margin.to_f64()), e, false))
        };
        let decides = !verdict.hit && margin.to_f64().is_finite() && margin < e;
        part.gates.push(ExplainedGate {
            gate: gate.name,
            refuses: gate.refuses,
            epsilon: Some(shortest(e)),
            margin: accepted,
            decision: decides.then_some("refuses"),
            decides,
            is_fixed: margin.to_f64().is_infinite(),
            ..ExplainedGate::default()
        });
    }
    let note = "it does not show its formula: no exact margins, no run without rounding";
    part.notes.push(note.to_owned());
}

/// Each gate's margin, computed and exact, and what it decided.
fn add_gates<F: Scalar>(
    part: &mut ExplainedRow,
    case: &Case<F>,
    gated: &dyn Gated<F>,
    verdict: &Verdict<F>,
    row: &Row,
) {
    let epsilons: Vec<F> = row.epsilons();
    let measured = gated.measure(case);
    let exact = gated.measure_exact(case);
    let exact_run = gated.run_exact(case, &epsilons);
    let word = |passes: bool| if passes { "passes" } else { "refuses" };
    for (i, gate) in row.entry.info.gates.iter().enumerate() {
        let (margin, e) = (measured.margins[i], epsilons[i]);
        let exactly = Some(word(exact_run.passed[i]));
        let numbers = (gate.epsilon != Tunable::Fixed).then(|| {
            let computed = margin_text(&Exact::from_f64(margin.to_f64()), e, false);
            let exact = margin_text(&exact.margins[i], e, exactly == Some(word(false)));
            [shortest(e), computed, exact]
        });
        let [epsilon, computed, exact] = numbers.map_or([None, None, None], |all| all.map(Some));
        part.gates.push(ExplainedGate {
            gate: gate.name,
            refuses: gate.refuses,
            epsilon,
            margin: computed,
            exact,
            decision: Some(word(margin >= e)),
            exactly,
            decides: verdict.refused_by == Some(i as u8),
            is_fixed: gate.epsilon != Tunable::Fixed && margin.to_f64().is_infinite(),
        });
    }
    part.without_rounding = Some(if exact_run.hit() { "hit" } else { "miss" });
}

/// The values that a hit reports.
fn values<F: Float>(gives: Gives, verdict: &Verdict<F>) -> String {
    let mut values = Vec::new();
    if gives.t {
        values.push(format!("t = {}", number(verdict.t)));
    }
    if gives.uv {
        let [u, v] = [verdict.u, verdict.v].map(number);
        values.push(format!("u = {u}, v = {v}"));
    }
    if gives.facing {
        values.push(format!(
            "facing {}",
            verdict.facing.map_or("unknown", |facing| facing.name())
        ));
    }
    if values.is_empty() {
        values.push("the hit alone".to_owned());
    }
    format!("reports {}", values.join(", "))
}

/// How far the values of a right hit are from the exact ones.
fn errors<F: Scalar>(
    case: &Case<F>,
    truth: &Truth,
    finding: Option<Finding>,
    (gives, tolerance): (Gives, f64),
    verdict: &Verdict<F>,
) -> Vec<String> {
    let Some(crossing) = truth.crossing() else {
        return Vec::new();
    };
    if crossing.feature == Feature::Outside || finding == Some(Finding::FalseHit) {
        return Vec::new();
    }
    let mut all = Vec::new();
    if finding == Some(Finding::WrongValue) {
        let errors = ValueErrors::of(case, truth, gives, verdict);
        all = wrong_values(&errors, verdict, tolerance);
    }
    let Errors { t, uv, point } = Errors::of(case, crossing, gives, verdict);
    let named = [("t", t), ("u, v", uv), ("o + t d", point)];
    let parts: Vec<String> = named
        .iter()
        .filter_map(|(name, error)| error.map(|error| format!("{name} by {}", short(error))))
        .collect();
    if !parts.is_empty() {
        all.push(format!("off by ulps: {}", parts.join(", ")));
    }
    all
}

/// Each value beside its exact one, and how many times the error of rounding it is off.
fn wrong_values<F: Scalar>(
    errors: &ValueErrors,
    verdict: &Verdict<F>,
    tolerance: f64,
) -> Vec<String> {
    let reported = [verdict.t, verdict.u, verdict.v];
    let wrong = (0..3).filter(|which| errors.is_wrong(*which, tolerance)).map(|which| {
        let (name, times) = (["t", "u", "v"][which], errors.times[which].unwrap_or_default());
        let (reported, exact) = (reported[which], errors.exact[which]);
        format!(
            "wrong {name}: reported {}, exactly {}; off by {} u·κ, the size of one rounding (up to {ALLOWANCE} is allowed)",
            number(reported),
            plain(&format!("{exact:.9e}")),
            short(times)
        )
    });
    let point = format!("the point is off by {} longest edges", short(errors.edges));
    wrong.chain([point]).collect()
}
