//! Small changes to a kernel: which of them mend what is wrong with it, and what they cost.

use crate::audit::{Observer, Row};
use crate::candidates::patch;
use crate::judge::Finding;
use crate::kernel::Scalar;
use crate::prove::{Searched, above};
pub use crate::tried::RepairRays;
use crate::tried::{ChangeCounts, Count, TriedChanges};
use hairline_record::group_digits;
use hairline_report::page::{Block, Cell, Command, Head, Item, Items, Row as TableRow, Table};

impl<F: Searched + Scalar> TriedChanges<F> {
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
}

/// A kernel that says hit, miss or ask, as a page tells of it.
pub struct Guard {
    /// One sentence: what it does on the same rays, or why there is none.
    pub about: String,
    /// The words that choose the kernel that it is made of; none if there is none.
    pub selector: Option<String>,
}

/// Small changes to a row's kernel, and the smallest that mends the worst.
pub fn blocks<F: Searched + Scalar>(
    row: &Row,
    rays: &RepairRays,
    guard: Guard,
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
        tried.sentences().into_iter().chain([guard.about]).collect(),
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
    if let Some(selector) = guard.selector {
        next(
            format!("hairline repair {selector} --emit c"),
            "the kernel that asks where it cannot know",
        );
    }
    blocks.push(Block::Commands("next", commands));
    blocks
}
