//! A kernel and small changes to it, run on the same rays and counted.

use crate::audit::{
    self, Audit, CasePlace, Observer, Octave, Plan, Row, Shard, Source, SourceCell,
};
use crate::candidates::{Candidate, ProvedDepths, candidates, proved};
use crate::judge::{Class, Finding};
use crate::kernel::{Change, Scalar, Verdict, verdicts_of};
use crate::prove::Searched;
use std::marker::PhantomData;

/// The rays on which changes are tried.
pub struct RepairRays {
    /// Where they come from.
    pub sources: Vec<Source>,
    /// True if they are a scene's.
    pub is_scene: bool,
    /// The flags of `audit` that run the same, each after a space.
    pub flags: String,
}

/// How far off, how, and where: the source and the place in it.
pub(crate) type Worst = (f64, Finding, usize, CasePlace);

/// The counts of a row in all sources.
#[derive(Default)]
pub(crate) struct ChangeCounts {
    pub misses: u64,
    pub hits: u64,
    /// Right hits with a t, u or v that is no finite number, or on the wrong side.
    pub bad: u64,
    /// Rays at shared edges and vertices that hit nothing, of so many.
    pub cracks: u64,
    pub crossings: u64,
    /// Farther off than 2^-10 of an edge.
    pub visible: u64,
    /// Nanoseconds in each source.
    pub times: Vec<f64>,
    /// The worst false miss or false hit.
    pub worst: Option<Worst>,
}

impl ChangeCounts {
    fn of(audit: &Audit, row: usize) -> ChangeCounts {
        let mut counts = ChangeCounts::default();
        audit
            .cells
            .iter()
            .filter(|cell| cell.row == row)
            .for_each(|cell| counts.add(cell));
        counts
    }

    fn add(&mut self, cell: &SourceCell) {
        let (tally, total) = (&cell.tally, cell.tally.total());
        self.misses += total.of(Finding::FalseMiss);
        self.hits += total.of(Finding::FalseHit);
        self.bad += total.of(Finding::BadValue);
        self.cracks += tally.groups.cracks;
        self.crossings += tally.groups.crossings;
        self.times.push(cell.nanoseconds as f64);
        for finding in [Finding::FalseMiss, Finding::FalseHit] {
            let octaves = tally.severities.get(&finding).map(|it| it.edges.octaves());
            let far = octaves
                .into_iter()
                .flatten()
                .filter(|(octave, _)| Octave::From(-10) <= *octave);
            self.visible += far.map(|(_, count)| count).sum::<u64>();
            for class in Class::all() {
                let Some(examples) = tally.examples.get(class, finding) else {
                    continue;
                };
                let Some((severity, place)) = examples.worst else {
                    continue;
                };
                if self.worst.is_none_or(|(worst, ..)| worst < severity) {
                    self.worst = Some((severity, finding, cell.source, place));
                }
            }
        }
    }

    pub fn wrong(&self) -> u64 {
        self.misses + self.hits
    }
}

/// One of the counts.
pub(crate) type Count = fn(&ChangeCounts) -> u64;

/// A kernel and its changes, counted.
pub(crate) struct TriedChanges<F> {
    pub plan: Plan,
    pub candidates: Vec<Candidate>,
    /// As published; a row for each candidate; as published once more, judged as a ray if some candidate is.
    pub counts: Vec<ChangeCounts>,
    /// The kernel's, and each candidate's; none in a scene, where other numbers would hold.
    pub proved: Vec<ProvedDepths>,
    scalar: PhantomData<F>,
}

impl<F: Searched + Scalar> TriedChanges<F> {
    pub fn new(row: &Row, rays: &RepairRays, observer: &dyn Observer) -> Self {
        let (before, bound) = proved(row, &row.epsilons::<F>());
        let candidates = candidates::<F>(row, bound);
        let in_double = || {
            let epsilons = row.epsilons::<F>().into_iter().map(F::to_f64);
            proved::<f64>(row, &epsilons.collect::<Vec<_>>()).0
        };
        let of = |it: &Candidate| match it.change() {
            // Rounding knows no names of vertices.
            Some(Change::Sorted) => before,
            // A rounded t may refuse what is far inside.
            Some(Change::Ahead) => ProvedDepths::default(),
            Some(Change::BySize) => ProvedDepths {
                depths: None,
                ..before
            },
            // Every float is a double, and the domain's; its epsilons are those floats.
            Some(Change::Double) => in_double(),
            // Either the kernel's answer, or that in double.
            Some(Change::Fallback) => ProvedDepths {
                depths: before
                    .depths
                    .zip(in_double().depths)
                    .map(|([a, b], [c, d])| [a.max(c), b.max(d)]),
                is_tight: false,
            },
            None => proved(&it.row, &it.row.epsilons::<F>()).0,
        };
        let mut proved: Vec<ProvedDepths> = std::iter::once(before)
            .chain(candidates.iter().map(of))
            .collect();
        if rays.is_scene {
            proved.iter_mut().for_each(|it| it.depths = None);
        }
        let mut rows = vec![row.clone()];
        rows.extend(candidates.iter().map(|candidate| candidate.row.clone()));
        // The first row waits for the cases, so the kernel is timed as the last.
        let as_ray = rows
            .iter()
            .find(|it| it.contract.extent != row.contract.extent);
        rows.push(Row {
            contract: as_ray.unwrap_or(row).contract,
            ..row.clone()
        });
        let scalars = [F::DIGITS == 24, F::DIGITS != 24];
        let plan = Plan::new(rows, rays.sources.clone(), scalars, 1);
        let audit = audit::sum(&plan, Shard::WHOLE, observer);
        let counts = (0..plan.rows.len())
            .map(|row| ChangeCounts::of(&audit, row))
            .collect();
        TriedChanges {
            plan,
            candidates,
            counts,
            proved,
            scalar: PhantomData,
        }
    }

    /// True if a row is right where another is wrong.
    fn is_right(&self, row: &Row, (_, finding, source, place): Worst) -> bool {
        let made = self.plan.sources[source].make::<F>(place.index);
        let case = &made.cases()[place.triangle as usize];
        let mut verdict = [Verdict::miss(None)];
        let Some(subject) = F::subject(row.entry) else {
            return false;
        };
        verdicts_of(
            subject,
            std::slice::from_ref(case),
            &row.epsilons::<F>(),
            &mut verdict,
        );
        verdict[0].hit == (finding == Finding::FalseMiss)
    }

    pub fn command(&self, row: &Row, (_, _, source, place): Worst) -> String {
        let source = &self.plan.sources[source];
        let made = source.make::<F>(place.index);
        let triangle = (1 < made.cases().len()).then_some(place.triangle as usize);
        row.explain_command(&source.explain_arguments::<F>(place.index, triangle))
    }

    pub fn mends(&self, i: usize) -> bool {
        let is_right = |worst| self.is_right(&self.plan.rows[i], worst);
        self.counts[0].worst.is_some_and(is_right)
    }

    /// The kernel as it is, in a row of the table.
    pub fn unchanged(&self) -> &'static str {
        if self.plan.rows[0].set.contains('=') {
            "as given"
        } else {
            "as published"
        }
    }

    /// The candidates that are judged as the kernel was.
    pub fn comparable(&self) -> impl Iterator<Item = usize> {
        (1..=self.candidates.len()).filter(|i| self.is_comparable(*i))
    }

    /// True if a candidate is judged as the kernel was.
    pub fn is_comparable(&self, i: usize) -> bool {
        self.plan.rows[i].contract.extent == self.plan.rows[0].contract.extent
    }

    /// The smallest change that mends the worst, halves what is visible, and is wrong no more often with no more leaks and
    /// bad values: to be right on one ray may be chance.
    pub fn smallest(&self) -> Option<usize> {
        let before = &self.counts[0];
        let is_better = |i: &usize| {
            let after = &self.counts[*i];
            self.mends(*i)
                && after.visible * 2 <= before.visible
                && after.wrong() <= before.wrong()
                && after.bad <= before.bad
                && after.cracks <= before.cracks
        };
        self.comparable().find(is_better)
    }

    /// The change that takes away the most wrong answers, if one takes away some.
    pub fn most(&self) -> Option<usize> {
        let wrong = |i: &usize| self.counts[*i].wrong();
        self.comparable()
            .min_by_key(wrong)
            .filter(|i| wrong(i) < wrong(&0))
    }
}
