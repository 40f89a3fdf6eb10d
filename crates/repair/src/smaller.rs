//! Small changes to a kernel: which of them mend what is wrong with it, and what they cost.

use crate::audit::{
    self, Audit, CasePlace, Observer, Octave, Plan, Row, Shard, Source, SourceCell,
};
use crate::candidates::{Candidate, ProvedDepths, candidates, patch, proved};
use crate::judge::{Class, Finding};
use crate::kernel::{Change, Scalar, Verdict, verdicts_of};
use crate::prove::{Searched, above};
use hairline_record::group_digits;
use hairline_report::page::{Block, Cell, Command, Head, Item, Items, Row as TableRow, Table};
use std::marker::PhantomData;

/// How far off, how, and where: the source and the place in it.
type Worst = (f64, Finding, usize, CasePlace);

/// The counts of a row in all sources.
#[derive(Default)]
struct ChangeCounts {
    misses: u64,
    hits: u64,
    /// Right hits with a t, u or v that is no finite number, or on the wrong side.
    bad: u64,
    /// Rays at shared edges and vertices that hit nothing, of so many.
    cracks: u64,
    crossings: u64,
    /// Farther off than 2^-10 of an edge.
    visible: u64,
    /// Nanoseconds in each source.
    times: Vec<f64>,
    /// The worst false miss or false hit.
    worst: Option<Worst>,
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

    fn wrong(&self) -> u64 {
        self.misses + self.hits
    }
}

/// One of the counts.
type Count = fn(&ChangeCounts) -> u64;

/// A kernel and its changes, counted.
struct TriedChanges<F> {
    plan: Plan,
    candidates: Vec<Candidate>,
    /// As published; a row for each candidate; as published once more, judged as a ray if some candidate is.
    counts: Vec<ChangeCounts>,
    /// The kernel's, and each candidate's; none in a scene, where other numbers would hold.
    proved: Vec<ProvedDepths>,
    scalar: PhantomData<F>,
}

impl<F: Searched + Scalar> TriedChanges<F> {
    fn new(row: &Row, rays: &RepairRays, observer: &dyn Observer) -> Self {
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

    fn command(&self, row: &Row, (_, _, source, place): Worst) -> String {
        let source = &self.plan.sources[source];
        let made = source.make::<F>(place.index);
        let triangle = (1 < made.cases().len()).then_some(place.triangle as usize);
        row.explain_command(&source.explain_arguments::<F>(place.index, triangle))
    }

    fn mends(&self, i: usize) -> bool {
        let is_right = |worst| self.is_right(&self.plan.rows[i], worst);
        self.counts[0].worst.is_some_and(is_right)
    }

    /// The kernel as it is, in a row of the table.
    fn unchanged(&self) -> &'static str {
        if self.plan.rows[0].set.contains('=') {
            "as given"
        } else {
            "as published"
        }
    }

    /// The candidates that are judged as the kernel was.
    fn comparable(&self) -> impl Iterator<Item = usize> {
        (1..=self.candidates.len()).filter(|i| self.is_comparable(*i))
    }

    /// True if a candidate is judged as the kernel was.
    fn is_comparable(&self, i: usize) -> bool {
        self.plan.rows[i].contract.extent == self.plan.rows[0].contract.extent
    }

    fn table(&self) -> Table {
        let heads = [
            Head::of("change"),
            Head::of("false misses"),
            Head::of("false hits"),
            Head::of("leaks").about("% of rays at shared edges and vertices that hit nothing; none: proved of edges"),
            Head::of("visible").about("wrong by over 2^-10 of an edge"),
            Head::of("worst").about("whether it is right where the kernel is most wrong"),
            Head::of("proved inside").about("no false miss of the unit domain is farther inside an edge, by the edges' gates (`prove` says what others add); then the same of hits outside; `prove --scene` has those of a scene"),
            Head::of("outside"),
            Head::of("cost").about("time in this run as a multiple of the kernel's, with a wrapper's call for each ray: at most"),
        ];
        let row = |i: usize, name: &str| {
            let counts = &self.counts[i];
            let proved = self.proved.get(i).copied().unwrap_or_default();
            let [inside, outside] = match proved.depths {
                Some(depths) => depths.map(|depth| Cell::number(depth, above(depth))),
                None => [Cell::none(), Cell::none()],
            };
            // The median over the sources: a machine's moods fall on few of them.
            let plain = &self.counts[self.counts.len() - 1].times;
            let mut costs: Vec<f64> = counts.times.iter().zip(plain).map(|(x, y)| x / y).collect();
            costs.sort_by(f64::total_cmp);
            let candidate = i.checked_sub(1).and_then(|i| self.candidates.get(i));
            let cost = match candidate {
                // In software here.
                Some(it) if it.is_fused() => Cell::none(),
                None => Cell::number(1.0, "1"),
                _ => {
                    let cost = costs[costs.len() / 2];
                    Cell::number(cost, format!("{cost:.1}"))
                }
            };
            let worst = match (i == 0, self.is_comparable(i)) {
                (true, _) => "wrong",
                (_, false) => "-",
                _ if self.mends(i) => "right",
                _ => "wrong",
            };
            let leaks = match counts.crossings {
                _ if proved.is_tight => Cell::number(0.0, "none"),
                0 => Cell::none(),
                of => {
                    let percent = 100.0 * counts.cracks as f64 / of as f64;
                    Cell::number(percent, format!("{percent:.2}"))
                }
            };
            let cells = [
                Cell::count(counts.misses),
                Cell::count(counts.hits),
                leaks,
                Cell::count(counts.visible),
                Cell::words(worst),
                inside,
                outside,
                cost,
            ];
            TableRow::new(name, cells)
        };
        let mut rows = vec![row(0, self.unchanged())];
        for (i, candidate) in self.candidates.iter().enumerate() {
            if !self.is_comparable(i + 1) {
                rows.push(row(self.counts.len() - 1, "judged as a ray"));
            }
            rows.push(row(i + 1, &candidate.name));
        }
        Table::new(heads.to_vec(), rows)
    }

    /// Which change mends each kind of finding.
    fn sentences(&self) -> Vec<String> {
        let kinds: [(&str, Count); 3] = [
            ("False misses", |it| it.misses),
            ("False hits", |it| it.hits),
            ("Leaks", |it| it.cracks),
        ];
        let before = &self.counts[0];
        let sentence = |(name, count): (&str, Count)| {
            let was = count(before);
            let is_no_worse =
                |i: usize, of: Count| of(&self.counts[i]) <= of(before).max(1) * 11 / 10;
            let mends = |i: &usize| {
                count(&self.counts[*i]) * 10 <= was
                    && kinds.iter().all(|(_, of)| is_no_worse(*i, *of))
            };
            let least = self.comparable().min_by_key(|i| count(&self.counts[*i]))?;
            let of = |i: usize| {
                let name = &self.candidates[i - 1].name;
                format!(
                    "{name} leaves {} of {}",
                    group_digits(count(&self.counts[i])),
                    group_digits(was)
                )
            };
            (0 < was).then(|| match self.comparable().find(mends) {
                Some(i) => format!("{name}: {}.", of(i)),
                None => format!(
                    "{name}: no small change mends nine in ten without other harm; {}.",
                    of(least)
                ),
            })
        };
        kinds.into_iter().filter_map(sentence).collect()
    }

    /// The smallest change that mends the worst, halves what is visible, and is wrong no more often with no more leaks and
    /// bad values: to be right on one ray may be chance.
    fn smallest(&self) -> Option<usize> {
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
    fn most(&self) -> Option<usize> {
        let wrong = |i: &usize| self.counts[*i].wrong();
        self.comparable()
            .min_by_key(wrong)
            .filter(|i| wrong(i) < wrong(&0))
    }
}

/// The rays on which changes are tried.
pub struct RepairRays {
    /// Where they come from.
    pub sources: Vec<Source>,
    /// True if they are a scene's.
    pub is_scene: bool,
    /// The flags of `audit` that run the same, each after a space.
    pub flags: String,
}

/// Small changes to a row's kernel, and the smallest that mends the worst.
pub fn blocks<F: Searched + Scalar>(
    row: &Row,
    rays: &RepairRays,
    guarded: String,
    observer: &dyn Observer,
) -> Vec<Block> {
    let tried = TriedChanges::<F>::new(row, rays, observer);
    let before = &tried.counts[0];
    let mut commands = Vec::new();
    let mut next = |line: String, what: &'static str| commands.push(Command { line, what });
    let mut blocks = Vec::new();
    let smallest = tried.smallest();
    let chosen = smallest.or_else(|| tried.most());
    if before.worst.is_none() {
        let text = "No false miss and no false hit here: nothing is to be mended.";
        blocks.push(Block::Text(text.to_owned()));
    }
    if let (Some(worst), None) = (before.worst, chosen) {
        blocks.push(Block::Text(
            "No change here takes away wrong answers.".to_owned(),
        ));
        next(tried.command(row, worst), "the worst");
    }
    if let (Some(worst), Some(i)) = (before.worst, chosen) {
        let candidate = &tried.candidates[i - 1];
        let name = &candidate.name;
        let what = if worst.1 == Finding::FalseMiss {
            "miss"
        } else {
            "hit"
        };
        let worst_ray = format!("a false {what} {} of an edge off", above(worst.0));
        let counts: [Count; 6] = [
            |it| it.visible,
            ChangeCounts::wrong,
            |it| it.misses,
            |it| it.hits,
            |it| it.bad,
            |it| it.cracks,
        ];
        let [visible, wrong, misses, hits, bad, leaks] = counts.map(|of| {
            format!(
                "{} to {}",
                group_digits(of(before)),
                group_digits(of(&tried.counts[i]))
            )
        });
        let bad = match before.bad + tried.counts[i].bad {
            0 => String::new(),
            _ => format!(", bad values from {bad}"),
        };
        let sums = format!(
            "false misses go from {misses}, false hits from {hits}{bad}, leaks from {leaks}"
        );
        let fate = if tried.mends(i) {
            "becomes right"
        } else {
            "stays wrong"
        };
        blocks.push(Block::Text(match smallest {
            Some(_) => format!(
                "{name} is the smallest change here that mends the worst, {worst_ray}, halves the visible errors \
                 ({visible}), and is wrong on no more rays in all ({wrong}): {sums}."
            ),
            None => format!(
                "{name} takes away the most wrong answers ({wrong}): {sums}, visible errors from {visible}. The worst \
                 ray, {worst_ray}, {fate}. No change here does all of this: mends that ray, halves the visible errors, \
                 and is wrong no more often with no more leaks."
            ),
        }));
        blocks.push(Block::Listing(patch(row, candidate)));
        next(
            tried.command(row, worst),
            "the worst of the kernel as it is",
        );
        let audit = format!(
            "hairline audit {} --scalar {}{}",
            candidate.row.flags(),
            F::NAME,
            rays.flags
        );
        next(audit, "everything about the changed kernel");
    }
    if rays.is_scene {
        let line = format!(
            "hairline epsilon {} --scalar {}{}",
            row.entry.selector(),
            F::NAME,
            rays.flags
        );
        next(line, "which epsilons cost least here");
    }
    blocks.push(Block::Table(tried.table()));
    blocks.push(Block::Notes(
        tried.sentences().into_iter().chain([guarded]).collect(),
    ));
    let terms = tried
        .candidates
        .iter()
        .map(|it| (it.name.clone(), it.what.clone()));
    blocks.push(Block::Terms(terms.collect()));
    let refuted = tried.comparable().filter(|i| !tried.mends(*i));
    let item = |i: usize| {
        let text = format!(
            "{} is refuted for the worst ray, which stays wrong:",
            tried.candidates[i - 1].name
        );
        Some(Item::shown_by(
            text,
            tried.command(&tried.plan.rows[i], before.worst?),
        ))
    };
    let items: Vec<Item> = refuted.filter_map(item).collect();
    blocks.push(Block::Items(Items {
        most: items.len(),
        items,
    }));
    next(
        format!("hairline repair {} --emit c", row.entry.selector()),
        "the kernel that asks where it cannot know",
    );
    blocks.push(Block::Commands("next", commands));
    blocks
}
