//! From the sums of a run to a record.

mod planned;
mod provenance;

pub use planned::plan_part;
pub use provenance::{Context, TOOL, provenance_of};

use crate::audit::{
    Audit, CLASSES, CasePlace, Examples, GroupCount, Plan, PolygonCount, Row, Severity, Source,
    SourceCell, SourceSummary, Stock, Tally, Trials, exact_severity, severity_of_instance,
};
use crate::case::Case;
use crate::class::FindingClass;
use crate::distribution;
use crate::engine;
use crate::family::Grouping;
use crate::finding::*;
use crate::judge::{Class, Finding};
use crate::kernel::Scalar;
use crate::kind::Promised;
use crate::rate::Rate;
use crate::record::Record;
use crate::result::*;
#[cfg(feature = "studies")]
use crate::surface;
use provenance::provenance;
use std::collections::BTreeMap;

/// Makes the record of a run.
pub fn build(plan: &Plan, audit: &Audit, context: &Context) -> Record {
    let results = engine::map(
        &audit.cells,
        |cell| in_named_scalar!(cell.scalar, F => kernel_result::<F>(plan, cell)),
    );
    let result = ResultPart {
        plan: plan_part(plan),
        partial: None,
        #[cfg(feature = "studies")]
        mesh: surface::mesh_part(plan, audit),
        #[cfg(not(feature = "studies"))]
        mesh: None,
        sources: audit
            .sources
            .iter()
            .map(|summary| source_part(plan, summary))
            .collect(),
        results,
        totals: distribution::totals(plan, audit),
    };
    Record::new(result, provenance(plan, audit, context))
}

fn source_part(plan: &Plan, summary: &SourceSummary) -> SourcePart {
    let source = &plan.sources[summary.source];
    let id = |index| in_named_scalar!(summary.scalar, F => source.id::<F>(index, None));
    SourcePart {
        scalar: summary.scalar,
        family: source.name(),
        sample: source.is_sample(),
        promises: source.promises(),
        indices: summary.indices,
        cases: summary.cases,
        promise_broken: summary.promise_broken,
        first_broken: summary.first_broken.map(id),
        left_out: Some(source.left_out() as u64).filter(|count| 0 < *count),
    }
}

/// A rate of which each ray is one trial.
fn rate(count: u64, of: u64, sample: bool) -> Rate {
    Rate::new(Trials::independent(count, of), sample)
}

pub fn counts(tally: &Tally, class: Option<Class>, sample: bool) -> Counts {
    let count = class.map_or_else(|| tally.total(), |class| tally.classes[class.number()]);
    let of = |finding| Rate::new(tally.trials(class, finding), sample);
    Counts {
        cases: count.cases,
        free: count.cases - count.must_hit - count.must_miss,
        hits: count.hits,
        false_misses: of(Finding::FalseMiss),
        false_hits: of(Finding::FalseHit),
        bad_values: of(Finding::BadValue),
        wrong_values: of(Finding::WrongValue),
        panics: count.of(Finding::Panic),
        crashes: count.of(Finding::Crash),
        timeouts: count.of(Finding::Timeout),
    }
}

fn kernel_result<F: Scalar>(plan: &Plan, cell: &SourceCell) -> KernelResult {
    let (source, row, tally) = (
        &plan.sources[cell.source],
        &plan.rows[cell.row],
        &cell.tally,
    );
    let sample = source.is_sample();
    // In an instance values belong to another ray than the truth.
    let judged = |counts: Counts| match source.instance::<F>() {
        Some(_) => {
            let (bad_values, wrong_values) = Default::default();
            Counts {
                bad_values,
                wrong_values,
                ..counts
            }
        }
        None => counts,
    };
    let classes = Class::all()
        .filter(|class| tally.classes[class.number()].cases > 0)
        .map(|class| {
            let counts = counts(tally, Some(class), sample);
            (FindingClass::Truth(class), judged(counts))
        });
    let findings = tally.examples.iter().map(|((class, finding), examples)| {
        let trials = tally.trials(Some(class), finding);
        let causes = cell.causes.get(&(class, finding));
        let causes = causes.map(|causes| distribution::causes(causes, trials.count));
        let example = |place, severe| example::<F>(source, row, place, severe);
        finding_part(
            (class, finding),
            Rate::new(trials, sample),
            examples,
            causes,
            example,
        )
    });
    let grouping = source.grouping();
    KernelResult {
        scalar: cell.scalar,
        kernel: row.entry.info.name.to_owned(),
        set: row.set.clone(),
        family: source.name(),
        total: judged(counts(tally, None, sample)),
        classes: classes.collect(),
        findings: findings.collect(),
        severity: distribution::severities(&tally.severities),
        accuracy: distribution::accuracy(&tally.accuracy),
        across: grouping
            .shares_a_ray()
            .then(|| across_in_source::<F>(source, row, tally)),
        polygons: (grouping == Grouping::Polygon && row.entry.info.polygons)
            .then(|| polygon_part::<F>(source, &tally.polygons)),
        self_hits: (grouping == Grouping::SecondaryRay)
            .then(|| rate(tally.self_hits.hits, tally.self_hits.rays, sample)),
    }
}

/// A finding in a class, with what shows an example: of a place, and whether its severity is wanted.
pub fn finding_part(
    (class, finding): (Class, Finding),
    rate: Rate,
    examples: &Examples,
    causes: Option<CausesPart>,
    example: impl Fn(CasePlace, bool) -> Example,
) -> FindingPart {
    let (edges, worst) = examples.worst.expect("a finding has a worst example");
    let mut worst = example(worst, true);
    if let (Finding::WrongValue, Some(severity)) = (finding, &mut worst.severity) {
        severity.value_off = Some(edges);
    }
    FindingPart {
        finding: finding.into(),
        class: FindingClass::Truth(class),
        rate,
        causes,
        digest: examples.digest.to_string(),
        worst,
        first: examples
            .first
            .iter()
            .map(|place| example(*place, false))
            .collect(),
    }
}

fn example<F: Scalar>(
    source: &Source,
    row: &Row,
    place: CasePlace,
    with_severity: bool,
) -> Example {
    let made = source.make::<F>(place.index);
    let case: &Case<F> = &made.cases()[place.triangle as usize];
    let extent = row.contract.extent;
    let severity = || match source.instance() {
        Some(instance) => severity_of_instance(case, &instance, extent),
        None => exact_severity(case, extent),
    };
    let triangle = (made.cases().len() > 1).then_some(place.triangle as usize);
    Example {
        case: source.id::<F>(place.index, triangle),
        bits: source.seen(case).hex(),
        severity: with_severity.then(severity).flatten().map(severity_part),
        command: explain_command::<F>(source, row, place.index, triangle),
    }
}

/// How far a case is from where the verdict would be right.
pub fn severity_part(severity: Severity) -> SeverityPart {
    SeverityPart {
        in_plane: severity.in_plane,
        in_space: severity.in_space,
        edge_in_ulps: severity.edge_in_ulps,
        along: severity.along,
        value_off: None,
        off_end: severity.off_end.map(|place| place.name().to_owned()),
    }
}

/// The outcomes of groups for which the contract promises something, with the id of each.
pub fn across_part(
    promised: Promised,
    groups: &GroupCount,
    sample: bool,
    id: impl Fn(u64) -> String,
) -> AcrossPart {
    let ids = |indices: &[u64]| indices.iter().map(|i| id(*i)).collect();
    AcrossPart {
        promised,
        cracks: rate(groups.cracks, groups.crossings, sample),
        doubles: rate(groups.doubles, groups.crossings, sample),
        odd_folds: rate(groups.odd_folds, groups.folds, sample),
        missed_folds: rate(groups.missed_folds, groups.folds, sample),
        first_cracks: ids(&groups.first_cracks),
        first_doubles: ids(&groups.first_doubles),
        first_odd_folds: ids(&groups.first_odd_folds),
        crack_digest: groups.crack_digest.to_string(),
        double_digest: groups.double_digest.to_string(),
        odd_fold_digest: groups.odd_fold_digest.to_string(),
        file: None,
        elsewhere: None,
        first_elsewhere: ids(&groups.first_elsewhere),
        leaking: None,
        classes: BTreeMap::new(),
    }
}

fn across_in_source<F: Scalar>(source: &Source, row: &Row, tally: &Tally) -> AcrossPart {
    let sample = source.is_sample();
    let part = |groups: &GroupCount| AcrossPart {
        elsewhere: source
            .has_neighbours()
            .then(|| rate(groups.elsewhere, groups.crossings, sample)),
        ..across_part(row.contract.across.into(), groups, sample, |i| {
            source.id::<F>(i, None)
        })
    };
    let mut across = part(&tally.groups);
    across.file = source.file_flag();
    if let (Stock::MeshPart(_, aimed), Some(targets)) = (&source.stock, source.targets::<F>()) {
        let (count, of) = (tally.aimed.leaking(), targets.count(*aimed));
        across.leaking = Some(LeakingPart { count, of });
        let classes = CLASSES.map(str::to_owned).into_iter();
        across.classes = classes.zip(tally.aimed.classes.iter().map(part)).collect();
    }
    across
}

fn polygon_part<F: Scalar>(source: &Source, polygons: &PolygonCount) -> PolygonPart {
    let sample = source.is_sample();
    let part = |finding: Finding| {
        let examples = polygons.examples.get(&finding);
        let places = examples.iter().flat_map(|examples| &examples.first);
        PolygonFinding {
            finding: finding.into(),
            rate: rate(
                polygons.count.of(finding),
                polygons.count.trials(finding),
                sample,
            ),
            digest: examples
                .map(|examples| examples.digest.clone())
                .unwrap_or_default()
                .to_string(),
            first: places
                .map(|place| source.id::<F>(place.index, None))
                .collect(),
        }
    };
    let (misses, hits) = (part(Finding::FalseMiss), part(Finding::FalseHit));
    let others = Finding::ALL[2..].iter().map(|finding| part(*finding));
    PolygonPart {
        false_misses: misses.rate,
        false_hits: hits.rate,
        false_miss_digest: misses.digest,
        false_hit_digest: hits.digest,
        first_false_misses: misses.first,
        first_false_hits: hits.first,
        others: others.filter(|part| 0 < part.rate.count).collect(),
    }
}

/// The command that shows a case with a row again.
pub fn explain_command<F: Scalar>(
    source: &Source,
    row: &Row,
    index: u64,
    triangle: Option<usize>,
) -> String {
    row.explain_command(&source.explain_arguments::<F>(index, triangle))
}
