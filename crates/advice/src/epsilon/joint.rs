//! All knobs together: the counts at every combination of some values, and the cheapest of them.

use super::errors::MaxError;
use super::knob::{KnobMargins, MOST_KNOBS};
use super::rays::{RayCount, WrongKind};
use super::trials::{Pass, Setting, Trial};
use crate::arith::Float;
use crate::audit::Trials;
use crate::engine::{self, Merge};
use crate::kernel::Scalar;
use crate::suggest::nearest_name;

/// The costs of wrong answers, by kind.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Costs {
    of: [f64; WrongKind::ALL.len()],
}

impl Default for Costs {
    /// A crack shows as a hole in a surface: it costs ten times as much as another wrong answer.
    fn default() -> Costs {
        Costs {
            of: [10.0, 1.0, 1.0, 1.0],
        }
    }
}

impl Costs {
    /// From words such as `crack=10,miss=1`; what is not named keeps its default.
    pub fn parse(text: &str) -> Result<Costs, String> {
        let (mut costs, mut named) = (Costs::default(), Vec::new());
        for word in text.split(',').map(str::trim) {
            let expected = "write crack=10,miss=1,hit=1,self-hit=1";
            let (key, value) = word
                .split_once('=')
                .ok_or_else(|| format!("'{word}' is no cost: {expected}"))?;
            let kind = WrongKind::named(key.trim());
            let kind = kind.ok_or_else(|| {
                let near = nearest_name(key.trim(), WrongKind::ALL.map(WrongKind::name));
                let near = near.map_or(String::new(), |near| format!("did you mean '{near}'? "));
                format!("unknown kind '{key}': {near}{expected}")
            })?;
            if named.contains(&kind) {
                return Err(format!("'{key}' is given twice"));
            }
            named.push(kind);
            let value = value.trim();
            let cost = value
                .parse()
                .ok()
                .filter(|cost: &f64| (0.0..=1e9).contains(cost));
            costs.of[kind as usize] =
                cost.ok_or_else(|| format!("{key}={value}: not a number from 0 to 1e9"))?;
        }
        match costs.of.iter().all(|cost| *cost == 0.0) {
            true => Err("every cost is 0, so every epsilon is as good".to_owned()),
            false => Ok(costs),
        }
    }

    /// From the cost of one wrong answer of each kind.
    pub fn by_kind(cost: impl Fn(WrongKind) -> f64) -> Costs {
        Costs {
            of: WrongKind::ALL.map(cost),
        }
    }

    /// The cost of one wrong answer.
    pub fn of(&self, kind: WrongKind) -> f64 {
        self.of[kind as usize]
    }

    /// The total of what was wrong; where there was no trial, nothing.
    pub fn of_trials(&self, counts: &[RayCount], wrong: &[Trials]) -> f64 {
        self.total(
            counts,
            wrong.iter().map(|trials| trials.share().unwrap_or(0.0)),
        )
    }

    /// The sum of the shares of wrong answers, each times its cost.
    pub fn total(&self, counts: &[RayCount], shares: impl IntoIterator<Item = f64>) -> f64 {
        counts
            .iter()
            .zip(shares)
            .map(|(count, share)| self.of(count.kind) * share)
            .sum()
    }
}

/// So many steps of equal cost are a plateau, and no accident of the sample.
const PLATEAU: usize = 3;

/// A point that costs at most this share more is as good: another seed may make it the cheapest.
pub(super) const NEGLIGIBLE: f64 = 0.01;

/// How many values of each knob accept margins; 0 of a knob that is not there.
type Accepted = [usize; MOST_KNOBS];

/// The values that are weighed for each knob, in order.
pub struct KnobGrid<F> {
    values: Vec<Vec<F>>,
}

/// The counts at every point of a grid.
pub struct Joint<F> {
    grid: KnobGrid<F>,
    /// By count: how many trials.
    of: Vec<u64>,
    /// By count, then by point: how many trials report a hit.
    hits: Vec<Vec<i64>>,
    /// If errors are limited, of the counts of lost hits: how many of those hits have a larger error.
    exceeded: Option<Vec<Vec<i64>>>,
}

impl<F: Float> KnobGrid<F> {
    /// From each knob's values, in order.
    pub fn new(values: Vec<Vec<F>>) -> KnobGrid<F> {
        KnobGrid { values }
    }

    /// By knob.
    #[cfg(test)]
    pub fn values(&self) -> &[Vec<F>] {
        &self.values
    }

    /// How many points there are, with one more in each direction.
    fn cells(&self) -> usize {
        self.values.iter().map(|values| values.len() + 1).product()
    }

    /// How many values of each knob accept margins; none if no value of some knob does, as then no point is a hit.
    fn accepted(&self, margins: &KnobMargins<F>) -> Option<Accepted> {
        let axes = || self.values.iter().zip(margins);
        let is_refused =
            |(values, margin): (&Vec<F>, &F)| values.first().is_none_or(|least| margin < least);
        if axes().any(is_refused) {
            return None;
        }
        let mut accepted = [0; MOST_KNOBS];
        for (accepted, (values, margin)) in accepted.iter_mut().zip(axes()) {
            *accepted = values.partition_point(|value| value <= margin);
        }
        Some(accepted)
    }

    fn cell(&self, places: impl IntoIterator<Item = usize>) -> usize {
        let axes = self.values.iter().zip(places);
        axes.fold(0, |cell, (values, place)| cell * (values.len() + 1) + place)
    }

    fn point(&self, places: &[usize]) -> Vec<F> {
        self.values
            .iter()
            .zip(places)
            .map(|(values, place)| values[*place])
            .collect()
    }
}

struct JointSums {
    of: Vec<u64>,
    cells: Vec<Vec<i64>>,
    exceeded: Vec<Vec<i64>>,
}

impl Merge for JointSums {
    fn merge(&mut self, other: JointSums) {
        self.of
            .iter_mut()
            .zip(other.of)
            .for_each(|(sum, more)| *sum += more);
        let cells = self.cells.iter_mut().zip(other.cells);
        for (cells, more) in cells.chain(self.exceeded.iter_mut().zip(other.exceeded)) {
            if cells.is_empty() {
                *cells = more;
            } else {
                cells
                    .iter_mut()
                    .zip(more)
                    .for_each(|(sum, more)| *sum += more);
            }
        }
    }
}

impl<F: Scalar> Joint<F> {
    /// Counts at every point of a grid.
    pub fn count(
        setting: &Setting<'_, F>,
        grid: KnobGrid<F>,
        max_error: Option<&MaxError>,
        pass: Pass<'_>,
    ) -> Joint<F> {
        let number = setting.counts.len();
        let none = vec![Vec::new(); number];
        let empty = || JointSums {
            of: vec![0; number],
            cells: none.clone(),
            exceeded: none.clone(),
        };
        let add = |sums: &mut JointSums, trial: Trial<'_, F>| {
            sums.of[trial.count] += 1;
            let boxes = trial.margins.iter();
            let boxes = boxes.filter_map(|margins| grid.accepted(margins));
            let add_to = |cells: &mut Vec<i64>| {
                cells.resize(grid.cells(), 0);
                // Most rays have one triangle.
                if trial.margins.len() == 1 {
                    for places in boxes.clone() {
                        cells[grid.cell(places)] += 1;
                    }
                    return;
                }
                for (sign, places) in union(boxes.clone()) {
                    cells[grid.cell(places)] += sign;
                }
            };
            add_to(&mut sums.cells[trial.count]);
            let is_exceeded = |max: &MaxError| max.is_exceeded(&trial.errors());
            let is_hit = setting.counts[trial.count].kind == WrongKind::Miss;
            if is_hit && max_error.is_some_and(is_exceeded) {
                add_to(&mut sums.exceeded[trial.count]);
            }
        };
        let JointSums {
            of,
            cells,
            exceeded,
        } = setting.sum(pass, empty, add);
        let all = |cells: Vec<Vec<i64>>| engine::map(&cells, |cells| accumulated(&grid, cells));
        let (hits, exceeded) = (all(cells), max_error.map(|_| all(exceeded)));
        Joint {
            grid,
            of,
            hits,
            exceeded,
        }
    }

    /// The cell with the hits of a point: those that accept one value more than its place.
    fn cell_of(&self, places: &[usize]) -> usize {
        self.grid.cell(places.iter().map(|place| place + 1))
    }

    /// True if the hits that remain at a point have errors as small as is wanted, in each stratum.
    fn is_accurate(&self, counts: &[RayCount], places: &[usize]) -> bool {
        let Some(exceeded) = &self.exceeded else {
            return true;
        };
        let cell = self.cell_of(places);
        let at = |of: &[i64]| of.get(cell).copied().unwrap_or(0) as u64;
        let pairs = counts.iter().zip(self.hits.iter().zip(exceeded));
        let mut of_hits = pairs.filter(|(count, _)| count.kind == WrongKind::Miss);
        of_hits.all(|(_, (hits, exceeded))| MaxError::is_kept(at(exceeded), at(hits)))
    }

    /// The share of wrong answers of each count at a point; 0 of nothing.
    fn shares(&self, counts: &[RayCount], places: &[usize]) -> impl Iterator<Item = f64> {
        let cell = self.cell_of(places);
        let sums = self.of.iter().zip(&self.hits);
        counts.iter().zip(sums).map(move |(count, (of, hits))| {
            let hits = hits.get(cell).copied().unwrap_or(0) as u64;
            let wrong = if count.kind.is_wrong_if_refused() {
                of - hits
            } else {
                hits
            };
            wrong as f64 / (*of).max(1) as f64
        })
    }

    /// A point as good as the cheapest ([`NEGLIGIBLE`]); none if errors are larger everywhere. Of these points a
    /// knob is 0, which needs no explanation, or else in the middle along it, so that another seed finds much the
    /// same.
    pub fn best(&self, counts: &[RayCount], costs: &Costs) -> Option<Vec<F>> {
        let cost = |places: &[usize]| costs.total(counts, self.shares(counts, places));
        let mut best: Option<(f64, Vec<usize>)> = None;
        let mut places = vec![0; self.grid.values.len()];
        loop {
            let found = cost(&places);
            let is_cheaper = best.as_ref().is_none_or(|(least, _)| found < *least);
            if is_cheaper && self.is_accurate(counts, &places) {
                best = Some((found, places.clone()));
            }
            let Some(next) = (0..places.len())
                .rev()
                .find(|&k| places[k] + 1 < self.grid.values[k].len())
            else {
                break;
            };
            places[next] += 1;
            places[next + 1..].fill(0);
        }
        let (least, mut places) = best?;
        let is_kept =
            |places: &[usize], most: f64| cost(places) <= most && self.is_accurate(counts, places);
        let moved = |places: &[usize], k: usize, place: usize| {
            let mut moved = places.to_vec();
            moved[k] = place;
            moved
        };
        let most = least * (1.0 + NEGLIGIBLE);
        let mut at_zero = vec![false; places.len()];
        for (k, values) in self.grid.values.iter().enumerate() {
            let zero = values.iter().position(|value| value.is_zero());
            let zeroed = zero.map(|zero| moved(&places, k, zero));
            if let Some(zeroed) = zeroed.filter(|zeroed| is_kept(zeroed, most)) {
                (places, at_zero[k]) = (zeroed, true);
            }
        }
        for k in (0..places.len()).filter(|k| !at_zero[*k]) {
            let ends = |from: usize, most: f64| {
                let as_good = |place: &usize| is_kept(&moved(&places, k, *place), most);
                let first = (0..from).rev().take_while(as_good).last();
                let last = (from + 1..self.grid.values[k].len())
                    .take_while(as_good)
                    .last();
                [first.unwrap_or(from), last.unwrap_or(from)]
            };
            // Where several values cost the least, they alone: what costs nothing more may do no harm either.
            let [first, last] = match ends(places[k], cost(&places)) {
                [first, last] if PLATEAU <= last - first => [first, last],
                _ => ends(places[k], most),
            };
            places[k] = (first + last) / 2;
        }
        Some(self.grid.point(&places))
    }

    /// A point of the grid with one knob after the other at another of its values, where that costs no more than
    /// chance explains.
    pub fn moved(
        &self,
        counts: &[RayCount],
        costs: &Costs,
        from: &[F],
        to: &[Option<F>],
    ) -> Option<Vec<F>> {
        let place = |k: usize, wanted: F| self.grid.values[k].iter().position(|x| *x == wanted);
        let mut places: Vec<usize> = from
            .iter()
            .enumerate()
            .map(|(k, value)| place(k, *value))
            .collect::<Option<_>>()?;
        let shares: Vec<f64> = self.shares(counts, &places).collect();
        let must_be_accurate = self.is_accurate(counts, &places);
        for (k, value) in to.iter().enumerate() {
            let mut moved = places.clone();
            moved[k] = value.and_then(|value| place(k, value)).unwrap_or(places[k]);
            let is_accurate = !must_be_accurate || self.is_accurate(counts, &moved);
            if is_accurate && !self.is_surely_dearer(counts, costs, &moved, &shares) {
                places = moved;
            }
        }
        Some(self.grid.point(&places))
    }

    /// True if wrong answers cost more at a point than some shares of them do, by more than two standard deviations
    /// of their difference. The same rays are wrong at both points but for those that make the difference.
    fn is_surely_dearer(
        &self,
        counts: &[RayCount],
        costs: &Costs,
        places: &[usize],
        shares: &[f64],
    ) -> bool {
        let (mut dearer, mut variance) = (0.0, 0.0);
        let here = self.shares(counts, places);
        let all = counts.iter().zip(&self.of).zip(here.zip(shares));
        for ((count, of), (share, other)) in all {
            let (cost, more) = (costs.of(count.kind), share - other);
            dearer += cost * more;
            variance += cost * cost * more.abs() / (*of).max(1) as f64;
        }
        2.0 * variance.sqrt() < dearer
    }
}

/// The union of boxes from the origin as a sum of boxes with signs, by inclusion and exclusion.
fn union(boxes: impl Iterator<Item = Accepted>) -> Vec<(i64, Accepted)> {
    // One that lies in another adds nothing.
    let inside = |a: &Accepted, b: &Accepted| a.iter().zip(b).all(|(a, b)| a <= b);
    let mut kept: Vec<Accepted> = Vec::new();
    for one in boxes {
        if !kept.iter().any(|other| inside(&one, other)) {
            kept.retain(|other| !inside(other, &one));
            kept.push(one);
        }
    }
    let mut terms: Vec<(i64, Accepted)> = Vec::with_capacity(kept.len());
    for one in kept {
        for i in 0..terms.len() {
            let (sign, mut met) = terms[i];
            for (met, own) in met.iter_mut().zip(one) {
                *met = own.min(*met);
            }
            terms.push((-sign, met));
        }
        terms.push((1, one));
    }
    terms
}

/// By cell, the sum over all cells at or above it in every direction.
fn accumulated<F: Float>(grid: &KnobGrid<F>, cells: &[i64]) -> Vec<i64> {
    let mut cells = cells.to_vec();
    let mut stride = 1;
    for values in grid.values.iter().rev() {
        let length = values.len() + 1;
        for cell in (0..cells.len()).rev() {
            if cell / stride % length + 1 < length {
                cells[cell] += cells[cell + stride];
            }
        }
        stride *= length;
    }
    cells
}

#[cfg(test)]
mod tests;
