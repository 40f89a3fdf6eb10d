//! Audits, and what an epsilon does to them.

use super::scalars_of;
use crate::request::{Audit, Cases, Curve};
use hairline::internals::audit::{self, Plan, Row, Source, Unobserved};
use hairline::internals::case::{Parameters, Scene};
use hairline::internals::family::{FAMILIES, Family, STRATA};
use hairline::internals::record::{Context, PlanFlags, Record, build};
use hairline::internals::report::page::{Paged, elements};
use serde::Serialize;

/// The most cases of a family in one request: some minutes on a slow machine.
const MOST: u64 = 1_000_000;
/// As `hairline audit` by default: the cases of a class that are shown, those whose cause is looked for, and the indices of
/// a source on which the errors of right hits are measured.
const EXAMPLES: usize = 3;
const ATTRIBUTED: usize = 30;
const MEASURED: usize = 100;

#[derive(Serialize)]
pub struct AuditAnswer {
    /// The verdict in a sentence.
    title: String,
    /// As `hairline audit --format json` writes it.
    record: Record,
    /// The page below its title.
    html: String,
}

/// The rates of all cases together at one point of a curve.
#[derive(Serialize, Default)]
pub struct Point {
    /// The `--epsilon` argument.
    epsilons: String,
    /// Among so many that must be hit, so many are missed.
    false_misses: [u64; 2],
    /// Among so many that must be missed, so many are hit.
    false_hits: [u64; 2],
    /// Without a verdict, or with a wrong value.
    others: u64,
}

pub fn audit(asked: &Audit) -> Result<AuditAnswer, String> {
    let row = asked.kernel.row()?;
    // The commands that lead on name the kernel and the cases. No command runs a kernel in WGSL.
    let is_known = !row.entry.selector().is_empty();
    let flags = PlanFlags {
        kernels: row.flags(),
        sources: asked.cases.flags(),
        epsilon: Some(asked.cases.epsilon_flags()),
    };
    let mut record = record(vec![row], &asked.cases, [EXAMPLES, ATTRIBUTED, MEASURED])?;
    record.provenance.plan_flags = Some(flags).filter(|_| is_known);
    let title = record.page().title;
    Ok(AuditAnswer {
        title,
        html: elements(&record),
        record,
    })
}

pub fn curve(asked: &Curve) -> Result<Vec<Point>, String> {
    let mut rows = Vec::new();
    for epsilons in &asked.epsilons {
        rows.extend(asked.kernel.rows(Some(epsilons))?.into_iter().take(1));
    }
    let record = record(rows, &asked.cases, [0; 3])?;
    let mut points: Vec<Point> = asked
        .epsilons
        .iter()
        .map(|text| Point {
            epsilons: text.clone(),
            ..Point::default()
        })
        .collect();
    for source in record.result.results.chunks(points.len().max(1)) {
        for (result, point) in source.iter().zip(&mut points) {
            let total = &result.total;
            point.false_misses[0] += total.false_misses.count;
            point.false_misses[1] += total.false_misses.of;
            point.false_hits[0] += total.false_hits.count;
            point.false_hits[1] += total.false_hits.of;
            point.others += total.bad_values.count + total.wrong_values.count + total.panics;
        }
    }
    Ok(points)
}

/// The record of examples, attributed findings and measured indices, so many of each.
fn record(
    rows: Vec<Row>,
    cases: &Cases,
    [examples, attribute, measured]: [usize; 3],
) -> Result<Record, String> {
    let scalars = scalars_of(&cases.scalar)?;
    rows.iter().try_for_each(|row| row.check_in(scalars))?;
    if rows
        .iter()
        .any(|row| !(0..2).any(|i| scalars[i] && row.entry.scalars()[i]))
    {
        return Err(format!("the kernel does not run in {}", cases.scalar));
    }
    let sources = sources(cases, scalars)?;
    let plan = Plan {
        attribute,
        measured,
        ..Plan::new(rows, sources, scalars, examples)
    };
    let sums = audit::run(&plan, &Unobserved);
    Ok(build(
        &plan,
        &sums,
        &Context {
            seconds: 0.0,
            threads: 1,
        },
    ))
}

fn sources(cases: &Cases, scalars: [bool; 2]) -> Result<Vec<Source>, String> {
    if !(1..=MOST).contains(&cases.count) {
        return Err(format!("count: {} is not 1 to {MOST}", cases.count));
    }
    let mut parameters = Parameters::default();
    if let Some(words) = &cases.scene {
        let about = |error| format!("scene: {error}");
        let (scene, _) = Scene::parse(words).map_err(about)?;
        if let (_, Some(why)) = scene.held_in(scalars).map_err(about)? {
            return Err(about(why));
        }
        parameters.scene = Some(scene.to_try_kernels(words));
    }
    let all = if cases.scene.is_some() {
        STRATA
    } else {
        FAMILIES
    };
    let family = |name: &String| -> Result<&'static Family, String> {
        let known = all.iter().find(|family| family.name == name);
        known.ok_or_else(|| format!("there is no family '{name}' here"))
    };
    let chosen = match cases.families.is_empty() {
        true => all.iter().collect(),
        false => cases
            .families
            .iter()
            .map(family)
            .collect::<Result<Vec<_>, _>>()?,
    };
    let source = |family| Source::of(family, parameters.clone(), cases.seed, cases.count);
    let sources: Vec<Source> = chosen.into_iter().map(source).collect();
    let named = cases.scene.as_deref().is_some_and(Scene::names_kind);
    let others: Vec<Source> = if named {
        Vec::new()
    } else {
        sources.iter().flat_map(Source::in_other_kinds).collect()
    };
    Ok(sources.into_iter().chain(others).collect())
}
