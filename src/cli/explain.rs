//! `hairline explain`: one case, its exact truth, and what each gate of each kernel made of it.

mod margin;

use super::case::{CaseArguments, Group};
use super::exit::{Failure, Status};
use super::output::write_result;
use super::select::KernelArguments;
use crate::arith::{Exact, Float};
use crate::audit::{
    Attribution, Errors, Row, attribute, attribute_by_running, exact_severity, polygon_verdict,
};
use crate::case::Case;
use crate::contract::Extent;
use crate::corpus::lines::{self, StoredCase};
use crate::family::Grouping;
use crate::judge::{
    ALLOWANCE, Finding, GroupTruth, Obligation, ValueErrors, asked, group_obligation, judge,
    may_be_elsewhere, polygon_obligation, polygon_truth,
};
use crate::kernel::{Gated, Gives, Scalar, Subject, Tunable, Verdict, verdicts_of};
use crate::oracle;
use crate::report::epsilon::shortest;
use crate::truth::{Feature, Truth};
use clap::Args;
use margin::margin_text;
use std::io::{self, Write};
use std::slice;

/// Which case, and which kernels.
#[derive(Args)]
pub struct ExplainArguments {
    #[command(flatten)]
    case: CaseArguments,

    #[command(flatten)]
    kernels: KernelArguments,
}

/// Runs the command.
pub fn run(arguments: &ExplainArguments) -> Result<Status, Failure> {
    let rows = arguments.kernels.rows()?;
    let cases = arguments.case.cases()?;
    let name = &arguments.case.case;
    rows.iter().try_for_each(|row| row.check_in(cases.scalars()))?;
    write_result("-", |out| either_scalar!(&cases, group => write_cases(out, name, group, &rows)))?;
    Ok(Status::Success)
}

fn write_cases<F: Scalar>(
    out: &mut dyn Write,
    name: &str,
    group: &Group<F>,
    rows: &[Row],
) -> io::Result<()> {
    let cases = &group.cases;
    let secondary = group.grouping == Grouping::SecondaryRay;
    for (i, case) in cases.iter().enumerate() {
        if cases.len() > 1 {
            writeln!(out, "triangle {i} of {}", cases.len())?;
        }
        write_case(out, name, case, secondary)?;
        let truth = oracle::define(case).truth;
        for row in rows {
            write_row(out, case, &truth, secondary, row)?;
        }
    }
    if cases.len() > 1 {
        writeln!(out, "together")?;
        for row in rows {
            write_group(out, group, row)?;
            if group.grouping == Grouping::Polygon && row.entry.info.polygons {
                write_polygon(out, cases, row)?;
            }
        }
    }
    Ok(())
}

/// Writes the contract's demand on the triangles together, and the kernel's answer.
fn write_group<F: Scalar>(out: &mut dyn Write, group: &Group<F>, row: &Row) -> io::Result<()> {
    let cases = &group.cases;
    let truths: Vec<Truth> = cases.iter().map(oracle::truth).collect();
    let mut verdicts = vec![Verdict::miss(None); cases.len()];
    let Some(subject) = F::subject(row.entry) else { return Ok(()) };
    verdicts_of(subject, cases, &row.epsilons::<F>(), &mut verdicts);
    if let Some(failure) = verdicts.iter().find_map(|verdict| verdict.failure) {
        return writeln!(out, "{}: {failure}; the group is not judged", row.label());
    }
    let hits = verdicts.iter().filter(|verdict| verdict.hit).count();
    let asked = group_obligation(cases, &truths, &row.contract, group.grouping);
    let judged = match (asked, hits) {
        (GroupTruth::Free, _) => "nothing is asked of the group",
        (GroupTruth::Crossing, 0) if is_elsewhere(&truths[0], group, row) => {
            "one hit is right, and rounding may have moved it to a neighbour: elsewhere"
        }
        (GroupTruth::Crossing, 0) => "one hit is right: CRACK",
        (GroupTruth::Crossing, 1) => "one hit is right",
        (GroupTruth::Crossing, _) => "one hit is right: DOUBLE",
        (GroupTruth::Fold { odd }, hits) if (hits % 2 == 1) == odd => {
            "at a fold: the parity is right"
        }
        (GroupTruth::Fold { .. }, _) => "at a fold: the parity is WRONG",
    };
    writeln!(out, "{}: {hits} of {} triangles hit; {judged}", row.label(), cases.len())
}

/// Writes the kernel's answer on a polygon as a whole.
fn write_polygon<F: Scalar>(out: &mut dyn Write, cases: &[Case<F>], row: &Row) -> io::Result<()> {
    let truths: Vec<Truth> = cases.iter().map(oracle::truth).collect();
    let Some(subject) = F::subject(row.entry) else { return Ok(()) };
    let owed = polygon_obligation(cases, &truths, &row.contract);
    let verdict = polygon_verdict(subject, cases, &row.epsilons());
    let (asked, union) = ((&row.contract, owed), (&cases[0], &polygon_truth(&truths)));
    let finding = judge(asked, union, row.entry.info.gives, &verdict);
    let corners = cases.len() + 2;
    let judged = judged(owed, &verdict, finding);
    writeln!(out, "{}: the polygon of {corners} corners as a whole: {judged}", row.label())
}

/// A verdict beside what the contract asks, in words.
fn judged<F>(owed: Obligation, verdict: &Verdict<F>, finding: Option<Finding>) -> String {
    let demand = match owed {
        Obligation::MustHit => "a hit",
        Obligation::MustMiss => "a miss",
        Obligation::Free => "nothing",
    };
    let said = match verdict.failure {
        Some(failure) => failure.to_string(),
        None => if verdict.hit { "hit" } else { "miss" }.to_owned(),
    };
    let judged = finding.map_or("as it should".to_owned(), |finding| finding.name().to_uppercase());
    format!("{said}; its contract asks {demand}: {judged}")
}

/// True if a hit that a group lacks may be among the triangles around it, or these are too many.
fn is_elsewhere<F: Scalar>(truth: &Truth, group: &Group<F>, row: &Row) -> bool {
    let Some(crossing) = truth.crossing() else { return false };
    let Some(neighbours) = &group.neighbours else { return true };
    let Some(subject) = F::subject(row.entry) else { return false };
    let truths: Vec<Truth> = neighbours.iter().map(oracle::truth).collect();
    let mut verdicts = vec![Verdict::miss(None); neighbours.len()];
    verdicts_of(subject, neighbours, &row.epsilons::<F>(), &mut verdicts);
    may_be_elsewhere(crossing.facing, neighbours, &truths, &verdicts, &row.contract)
}

fn write_case<F: Scalar>(
    out: &mut dyn Write,
    name: &str,
    case: &Case<F>,
    is_secondary: bool,
) -> io::Result<()> {
    writeln!(out, "case {}", if name.trim_start().starts_with('{') { "as given" } else { name })?;
    let labels = ["origin", "direction", "a", "b", "c"];
    for (label, vector) in labels.into_iter().zip(case.vectors()) {
        let [x, y, z] = vector.map(|x| format!("{:e}", x.to_f64()));
        let bits = vector.map(F::hex).join(" ");
        writeln!(out, "    {label:<10} {x:>24} {y:>24} {z:>24}   {bits}")?;
    }
    let (t_min, t_max) = (case.ray.t_min, case.ray.t_max);
    writeln!(out, "    interval   [{}, {}]   {} {}", t_min, t_max, t_min.hex(), t_max.hex())?;
    let definition = oracle::define(case);
    writeln!(out, "truth {}", definition.truth)?;
    let stored = StoredCase { is_secondary, ..StoredCase::of(*case) };
    let line = serde_json::to_string(&stored.truth_line(true)).unwrap_or_default();
    writeln!(out, "    {line}")?;
    if let Some(severity) = exact_severity(case, Extent::Interval) {
        let (space, ulps) = (severity.in_space, severity.in_space * severity.edge_in_ulps);
        writeln!(
            out,
            "    the line passes {space:.3e} of the longest edge ({ulps:.3e} ulps) from the boundary"
        )?;
    }
    writeln!(out, "    as JSON: {}", lines::write_case(&stored))
}

fn write_row<F: Scalar>(
    out: &mut dyn Write,
    case: &Case<F>,
    truth: &Truth,
    secondary: bool,
    row: &Row,
) -> io::Result<()> {
    let Some(subject) = F::subject(row.entry) else {
        return writeln!(out, "{}: does not run in {}", row.label(), F::NAME);
    };
    let epsilons: Vec<F> = row.epsilons();
    let mut verdict = [Verdict::miss(None)];
    verdicts_of(subject, slice::from_ref(case), &epsilons, &mut verdict);
    let [verdict] = verdict;

    let asked = asked(case, truth, &row.contract, secondary);
    let finding = judge((&row.contract, asked), (case, truth), row.entry.info.gives, &verdict);
    writeln!(out, "{}: {}", row.label(), judged(asked, &verdict, finding))?;
    writeln!(out, "    contract: {}", row.contract.describe())?;
    if verdict.failure.is_some() {
        return Ok(());
    }
    match subject.gated() {
        Some(gated) => write_gates(out, case, gated, &verdict, row)?,
        None => write_epsilons(out, case, subject, &verdict, row)?,
    }
    if let Some(finding) = finding.filter(|finding| !finding.is_failure()) {
        let why = match subject.gated() {
            Some(_) => attribute(subject, case, &epsilons, truth, (&row.contract, asked)),
            None => {
                let info = row.entry.info;
                let asked = (&row.contract, asked);
                attribute_by_running(subject, info, case, &epsilons, truth, asked)
            }
        };
        let why = match (why, subject.gated()) {
            (Some(Attribution::Epsilon), None) => {
                "epsilon (with every epsilon 0 it is right, and wrong with these)"
            }
            (Some(attribution), _) => attribution.describe(),
            (None, Some(_)) => "cannot be told: it does not run in exact arithmetic",
            (None, None) => {
                "cannot be told: it does not show its formula, and has no epsilons at which it could be run \
                 otherwise"
            }
        };
        writeln!(out, "    why the {}: {why}", finding.name())?;
    }
    if !verdict.hit {
        return Ok(());
    }
    let gives = row.entry.info.gives;
    write_values(out, gives, &verdict)?;
    write_errors(out, case, truth, finding, (gives, row.contract.value_tolerance), &verdict)
}

/// The epsilons that the kernel was given, where it does not show its gates, and the margins that runs at other
/// epsilons find.
fn write_epsilons<F: Scalar>(
    out: &mut dyn Write,
    case: &Case<F>,
    subject: &dyn Subject<F>,
    verdict: &Verdict<F>,
    row: &Row,
) -> io::Result<()> {
    let info = row.entry.info;
    let epsilons: Vec<F> = row.epsilons();
    let mut margins = vec![F::zero(); info.gates.len()];
    let tells = subject.tells_margins();
    if tells {
        subject.margins(info, slice::from_ref(case), &mut margins, &mut []);
    }
    if tells && margins.iter().any(|margin| *margin == -F::infinity()) {
        writeln!(out, "    a miss whatever its epsilons are: none of its gates explains it")?;
    }
    for (i, gate) in info.gates.iter().enumerate().filter(|(_, g)| g.epsilon != Tunable::Fixed) {
        let (name, e) = (gate.name, epsilons[i]);
        let margin = margin_text(&Exact::from_f64(margins[i].to_f64()), e, false);
        let found = match tells && !margins[i].is_nan() {
            true if margins[i] == -F::infinity() => String::new(),
            true if margins[i] == F::infinity() => "accepted at every e; ".to_owned(),
            true => format!("accepted up to e = {margin}; "),
            false => String::new(),
        };
        let refuses = if !verdict.hit && found.contains("up to") && margins[i] < e {
            ": refuses <- decides"
        } else {
            ""
        };
        writeln!(
            out,
            "    {name:<10} {found}run at e = {}{refuses}   [{}]",
            shortest(e),
            gate.refuses
        )?;
    }
    writeln!(out, "    it does not show its formula: no exact margins, no run without rounding")
}

/// Each gate's margin, computed and exact, and what it decided.
fn write_gates<F: Scalar>(
    out: &mut dyn Write,
    case: &Case<F>,
    gated: &dyn Gated<F>,
    verdict: &Verdict<F>,
    row: &Row,
) -> io::Result<()> {
    let epsilons: Vec<F> = row.epsilons();
    let measured = gated.measure(case);
    let exact = gated.measure_exact(case);
    let exact_run = gated.run_exact(case, &epsilons);
    for (i, gate) in row.entry.info.gates.iter().enumerate() {
        let (margin, exact_margin) = (measured.margins[i], &exact.margins[i]);
        let decided = verdict.refused_by == Some(i as u8);
        let word = |passes: bool| if passes { "passes" } else { "refuses" };
        let decision = word(margin >= epsilons[i]);
        let should = exact_run.as_ref().map_or("unknown", |run| word(run.passed[i]));
        let mark = if decided { " <- decides" } else { "" };
        let differs = exact_run.is_some() && decision != should;
        let wrong = if differs { ", WRONG" } else { "" };
        if gate.epsilon == Tunable::Fixed {
            let name = gate.name;
            writeln!(
                out,
                "    {name:<10} {decision} (exactly: {should}{wrong}){mark}   [refuses {}]",
                gate.refuses
            )?;
            continue;
        }
        let epsilon = epsilons[i];
        writeln!(
            out,
            "    {:<10} margin {:>13} (exactly {:>13}) at e = {}: {decision} (exactly: {should}{wrong}){mark}   [refuses {}]",
            gate.name,
            margin_text(&Exact::from_f64(margin.to_f64()), epsilon, false),
            margin_text(exact_margin, epsilon, should == word(false)),
            shortest(epsilon),
            gate.refuses
        )?;
    }
    if let Some(run) = &exact_run {
        let exactly = if run.hit() { "hit" } else { "miss" };
        writeln!(out, "    the same formula without rounding: {exactly}")?;
    }
    Ok(())
}

/// Writes the values that a hit reports.
fn write_values<F: Float>(
    out: &mut dyn Write,
    gives: Gives,
    verdict: &Verdict<F>,
) -> io::Result<()> {
    let mut values = Vec::new();
    if gives.t {
        values.push(format!("t = {:e}", verdict.t.to_f64()));
    }
    if gives.uv {
        values.push(format!("u = {:e}, v = {:e}", verdict.u.to_f64(), verdict.v.to_f64()));
    }
    if gives.facing {
        values.push(format!("facing {}", verdict.facing.map_or("unknown", |facing| facing.name())));
    }
    if values.is_empty() {
        values.push("the hit alone".to_owned());
    }
    writeln!(out, "    reports {}", values.join(", "))
}

/// How far the values of a right hit are from the exact ones.
fn write_errors<F: Scalar>(
    out: &mut dyn Write,
    case: &Case<F>,
    truth: &Truth,
    finding: Option<Finding>,
    (gives, tolerance): (Gives, f64),
    verdict: &Verdict<F>,
) -> io::Result<()> {
    let Some(crossing) = truth.crossing() else { return Ok(()) };
    if crossing.feature == Feature::Outside || finding == Some(Finding::FalseHit) {
        return Ok(());
    }
    if finding == Some(Finding::WrongValue) {
        let errors = ValueErrors::of(case, truth, gives, verdict);
        write_wrong_values(out, &errors, verdict, tolerance)?;
    }
    let Errors { t, uv, point } = Errors::of(case, crossing, gives, verdict);
    let named = [("t", t), ("u, v", uv), ("o + t d", point)];
    let parts: Vec<String> = named
        .iter()
        .filter_map(|(name, error)| error.map(|error| format!("{name} by {error:.3e}")))
        .collect();
    if parts.is_empty() { Ok(()) } else { writeln!(out, "    off by ulps: {}", parts.join(", ")) }
}

/// Each value beside its exact one, and how many times the error of rounding it is off.
fn write_wrong_values<F: Scalar>(
    out: &mut dyn Write,
    errors: &ValueErrors,
    verdict: &Verdict<F>,
    tolerance: f64,
) -> io::Result<()> {
    let reported = [verdict.t, verdict.u, verdict.v].map(F::to_f64);
    for which in (0..3).filter(|which| errors.is_wrong(*which, tolerance)) {
        let (name, times) = (["t", "u", "v"][which], errors.times[which].unwrap_or_default());
        let (reported, exact) = (reported[which], errors.exact[which]);
        writeln!(
            out,
            "    wrong {name}: reported {reported:e}, exactly {exact:.9e}; off by {times:.3e} u·κ, the size of one \
             rounding (up to {ALLOWANCE} is allowed)"
        )?;
    }
    writeln!(out, "    the point is off by {:.3e} longest edges", errors.edges)
}
