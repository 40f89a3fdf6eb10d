//! From the sums of a run to a record.

use crate::arith::ScalarName;
use crate::audit::{
    Audit, CLASSES, CasePlace, CorpusSet, EpsilonText, Examples, GroupCount, Plan, PolygonCount,
    Row, Severity, Source, SourceCell, SourceSummary, Stock, Tally, Trials, exact_severity,
    severity_of_instance, words,
};
use crate::case::{Case, Matrix};
use crate::class::FindingClass;
use crate::contract::{Boundary, Extent};
use crate::distribution;
use crate::engine;
use crate::family::Grouping;
use crate::files::hex;
use crate::finding::*;
use crate::judge::{Class, Finding};
use crate::kernel::{Gate, Role, Scalar};
use crate::kind::Promised;
use crate::plan::*;
use crate::rate::Rate;
use crate::record::Record;
use crate::result::*;
#[cfg(feature = "studies")]
use crate::surface;
use hmac_sha256::Hash;
use std::collections::BTreeMap;

/// This program and its version, as records have it.
pub const TOOL: &str = concat!("hairline ", env!("CARGO_PKG_VERSION"));

/// The data of a run besides its sums.
pub struct Context {
    /// Wall-clock seconds of the run.
    pub seconds: f64,
    /// Threads used.
    pub threads: usize,
}

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

/// A row as a plan names it.
pub fn row_part(row: &Row) -> RowPart {
    RowPart {
        contract_words: row.spec().contract,
        kernel: row.entry.info.name.to_owned(),
        selector: row.entry.selector(),
        set: row.set.clone(),
        epsilons: row
            .tuned()
            .map(|(gate, text)| (gate.name.to_owned(), text.to_string()))
            .collect(),
        contract: row.contract.describe(),
    }
}

pub fn plan_part(plan: &Plan) -> PlanPart {
    let part = PlanPart {
        hash: String::new(),
        rows: plan.rows.iter().map(row_part).collect(),
        sources: plan.sources.iter().map(planned_source).collect(),
        scalars: ScalarName::among(plan.scalars).collect(),
    };
    #[cfg(feature = "studies")]
    let part = part.hashed();
    part
}

#[cfg(feature = "studies")]
impl PlanPart {
    /// With the hash of the other fields.
    pub fn hashed(mut self) -> PlanPart {
        self.hash.clear();
        let text = serde_json::to_string(&self).unwrap_or_default();
        self.hash = hex(&Hash::hash(text.as_bytes())[..8]);
        self
    }

    /// The hash of what chooses the cases, which are the same for any kernels, epsilons and contracts.
    pub fn hash_of_cases(&self) -> String {
        let text = serde_json::to_string(&self.sources).unwrap_or_default();
        hex(&Hash::hash(text.as_bytes())[..8])
    }
}

/// A source as the plan names it.
pub fn planned_source(source: &Source) -> PlannedSource {
    PlannedSource {
        family: source.name(),
        set: match &source.stock {
            Stock::Corpus(set) => {
                let instance = source.parameters.instance.as_ref();
                let place = instance.map(|it| format!("/instance={}", words(it).replace(' ', ":")));
                let digest = corpus_digest(set, instance);
                format!("{}@{digest}{}", set.file, place.unwrap_or_default())
            }
            _ => set_of_id(&source.id::<f64>(0, None)),
        },
        count: source.count::<f32>().max(source.count::<f64>()),
    }
}

/// The digest of the stored cases and their names: another file of the same name is another plan.
fn corpus_digest(set: &CorpusSet, instance: Option<&Matrix<f64>>) -> String {
    let mut digest = Hash::new();
    let mut add = |name: &str, bits: &[u64]| {
        digest.update(name.as_bytes());
        bits.iter()
            .for_each(|bits| digest.update(bits.to_le_bytes()));
    };
    set.f32
        .iter()
        .for_each(|(name, case)| add(name, &case.bits()));
    set.f64
        .iter()
        .for_each(|(name, case)| add(name, &case.bits()));
    if let Some(matrix) = instance {
        add(
            "instance",
            &[0, 1, 2].map(|row| matrix[row].map(f64::to_bits)).concat(),
        );
    }
    hex(&digest.finalize()[..8])
}

/// `family@version/parameters/seed` of an id: without the scalar and the index.
fn set_of_id(id: &str) -> String {
    let words: Vec<&str> = id.split('/').collect();
    match words[..] {
        [family, _, parameters, seed, _] => format!("{family}/{parameters}/{seed}"),
        _ => id.to_owned(),
    }
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

/// Where a record was made, and how long it took.
pub fn provenance_of(context: &Context) -> Provenance {
    Provenance {
        tool: TOOL.to_owned(),
        target: format!("{}-{}", std::env::consts::ARCH, std::env::consts::OS),
        threads: context.threads,
        seconds: context.seconds,
        ..Provenance::default()
    }
}

/// Notes on the rows' kernels besides their verdicts.
pub fn kernel_notes(rows: &[Row]) -> BTreeMap<String, Vec<String>> {
    let mut all: BTreeMap<String, Vec<String>> = BTreeMap::new();
    for row in rows {
        let notes = row.entry.notes().into_iter().chain(ends_note(row));
        let known = all.entry(row.entry.info.name.to_owned()).or_default();
        notes.for_each(|note| {
            if !known.contains(&note) {
                known.push(note);
            }
        });
    }
    all.retain(|_, notes| !notes.is_empty());
    all
}

/// A contract that promises hits at the ends of a ray, and an epsilon that excludes them.
fn ends_note(row: &Row) -> Option<String> {
    // What a built-in kernel promises is what its source says.
    let promises = !row.entry.is_built_in()
        && row.contract.extent != Extent::Line
        // Such a contract is about the near hits, as the epsilon is.
        && !row.contract.no_self_hit
        && row.contract.ends == Boundary::Closed;
    let excludes = |(gate, text): &(&Gate, &EpsilonText)| {
        gate.role == Role::T && text.value::<f64>().is_some_and(|value| 0.0 < value)
    };
    let (gate, text) = row.tuned().filter(|_| promises).find(excludes)?;
    let name = gate.name;
    Some(format!(
        "its contract promises hits at the ends of the ray, and its epsilon {name} = {text} excludes those near the \
         start; if that is meant, promise less: --contract own,ends=free"
    ))
}

fn provenance(plan: &Plan, audit: &Audit, context: &Context) -> Provenance {
    let mut provenance = provenance_of(context);
    provenance.kernel_notes = kernel_notes(&plan.rows);
    let mut cases: BTreeMap<ScalarName, (u64, u64)> = BTreeMap::new();
    for summary in &audit.sources {
        let sum = cases.entry(summary.scalar).or_default();
        sum.0 += summary.oracle_nanoseconds;
        sum.1 += summary.cases;
        let layers = provenance.oracle_layers.entry(summary.scalar).or_default();
        for (name, count) in summary.layers.named() {
            *layers.entry(name.to_owned()).or_default() += count;
        }
    }
    let per = |time: u64, count: u64| time as f64 / count.max(1) as f64;
    for (scalar, (time, count)) in &cases {
        provenance
            .oracle_nanoseconds
            .insert(*scalar, per(*time, *count));
    }
    let mut times: BTreeMap<(ScalarName, usize), u64> = BTreeMap::new();
    for cell in &audit.cells {
        *times.entry((cell.scalar, cell.row)).or_default() += cell.nanoseconds;
    }
    for ((scalar, row), time) in times {
        let by_row = provenance.kernel_nanoseconds.entry(scalar).or_default();
        by_row.insert(plan.rows[row].label(), per(time, cases[&scalar].1));
    }
    provenance
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
