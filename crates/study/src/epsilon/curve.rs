//! How often a kernel is wrong, as a function of one epsilon.

use super::axis::Axis;
use crate::arith::Float;
use crate::audit::Place;

named! {
    pub names
    /// A kind of wrong answer that is counted against an epsilon. Raising it can only make a kernel refuse more.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum Question {
        /// Cases that must be hit: wrong where refused.
        FalseMiss = "false misses",
        /// Cases that must be missed: wrong where accepted.
        FalseHit = "false hits",
        /// Groups of which one triangle must report a hit: wrong where all refuse.
        Crack = "cracks",
        /// The same groups: wrong where two accept.
        Double = "doubles",
        /// Rays that start at a kernel's own hit point: a second hit on that triangle.
        SelfHit = "self-hits",
        /// The false hits that this gate is there to refuse; for a gate on t every second hit
        /// on the triangle that a ray starts on is one.
        OwnFalseHit = "own false hits",
    }
}

impl Question {
    /// True if it is the refusal that is wrong.
    pub fn is_wrong_if_refused(self) -> bool {
        matches!(self, Question::FalseMiss | Question::Crack)
    }
}

/// A count that lies between two numbers, both included.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Bracket {
    /// At least this many.
    pub low: u64,
    /// At most this many.
    pub high: u64,
}

impl Bracket {
    /// The count, if it is known.
    pub fn exact(self) -> Option<u64> {
        (self.low == self.high).then_some(self.low)
    }
}

/// Margins in [low, end), and how many there are.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cell<F> {
    /// The smallest number of the cell.
    pub low: F,
    /// The first number above it.
    pub end: F,
    /// How many margins lie in it.
    pub count: u64,
}

/// One question's answer at every epsilon.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve<F> {
    /// The kind of wrong answer that is counted.
    pub question: Question,
    /// How many cases or groups the question is about.
    pub total: u64,
    /// The sum over the rays of the square of how many were asked on each.
    pub squared: u64,
    /// Cases or groups refused at every epsilon.
    pub never: u64,
    /// Cases or groups accepted at every epsilon.
    pub always: u64,
    /// The others, by margin, in order; no empty cells.
    pub cells: Vec<Cell<F>>,
    /// By cell: the margins below it.
    below: Vec<u64>,
    /// The lowest epsilon that the gate takes.
    pub floor: F,
    /// The margin at which the count of wrong answers first changes, and where: of those from the
    /// floor up, the smallest of what is wrong if refused, the largest of what is wrong if accepted.
    pub decisive: Option<(F, Place)>,
}

impl<F: Float> Curve<F> {
    /// A curve without cases.
    pub fn new(question: Question, floor: F) -> Curve<F> {
        let (cells, below) = (Vec::new(), vec![0]);
        let (total, squared, never, always) = (0, 0, 0, 0);
        Curve { question, total, squared, never, always, cells, below, floor, decisive: None }
    }

    /// How many are refused under an epsilon.
    fn refused(&self, epsilon: F) -> Bracket {
        let whole = self.cells.partition_point(|cell| cell.end <= epsilon);
        let low = self.never + self.below[whole];
        // Of one cell some margins may be below the epsilon.
        let cut = self.cells.get(whole).filter(|cell| cell.low < epsilon);
        let mut count = Bracket { low, high: low + cut.map_or(0, |cell| cell.count) };
        // The decisive margin is known wherever it falls in its cell.
        if self.floor <= epsilon {
            if self.question.is_wrong_if_refused() {
                if self.decisive.is_none_or(|(m, _)| epsilon <= m) {
                    count.high = count.low;
                }
            } else if self.decisive.is_none_or(|(m, _)| m < epsilon) {
                count.low = count.high;
            }
        }
        count
    }

    /// How many answers are wrong under an epsilon: exact where an edge of the axis is.
    pub fn wrong(&self, epsilon: F) -> Bracket {
        let Bracket { low, high } = self.refused(epsilon);
        if self.question.is_wrong_if_refused() {
            Bracket { low, high }
        } else {
            Bracket { low: self.total - high, high: self.total - low }
        }
    }

    /// The epsilons at which the count can change, in order.
    pub fn steps(&self) -> impl Iterator<Item = F> {
        self.cells.iter().flat_map(|cell| [cell.low, cell.end])
    }

    /// Adds another curve of the same question on the same axis; the places of the first are kept
    /// where both are equally decisive.
    pub fn merge(&mut self, other: &Curve<F>) {
        self.total += other.total;
        self.squared += other.squared;
        self.never += other.never;
        self.always += other.always;
        let mut merged = Vec::new();
        let (mut left, mut right) = (self.cells.iter().peekable(), other.cells.iter().peekable());
        while let (Some(a), Some(b)) = (left.peek(), right.peek()) {
            merged.push(match a.low.place().cmp(&b.low.place()) {
                std::cmp::Ordering::Less => *left.next().expect("peeked"),
                std::cmp::Ordering::Greater => *right.next().expect("peeked"),
                std::cmp::Ordering::Equal => {
                    let count = left.next().expect("peeked").count;
                    let cell = right.next().expect("peeked");
                    Cell { count: count + cell.count, ..*cell }
                }
            });
        }
        merged.extend(left.chain(right));
        self.below = sums(&merged);
        self.cells = merged;
        if let Some(decisive) = other.decisive {
            propose(&mut self.decisive, self.question, decisive, false);
        }
    }
}

/// Keeps the more decisive of two margins; of equals the first place, if places can be compared.
fn propose<F: Float>(
    kept: &mut Option<(F, Place)>,
    question: Question,
    (margin, place): (F, Place),
    by_place: bool,
) {
    let better = kept.is_none_or(|(m, p)| {
        let beyond = if question.is_wrong_if_refused() { margin < m } else { m < margin };
        beyond || (by_place && margin == m && place < p)
    });
    if better {
        *kept = Some((margin, place));
    }
}

/// Margins being counted: a commutative monoid.
#[derive(Clone, Debug)]
pub(super) struct Lane<F> {
    question: Question,
    never: u64,
    always: u64,
    squared: u64,
    /// The index of the last margin, and how many have come of it.
    ray: (u64, u64),
    floor: F,
    decisive: Option<(F, Place)>,
    margins: Margins<F>,
}

#[derive(Clone, Debug)]
enum Margins<F> {
    /// By cell of the axis; empty until the first.
    Counted(Vec<u64>),
    /// One by one.
    Kept(Vec<F>),
}

impl<F: Float> Lane<F> {
    pub fn new(question: Question, floor: F, keep: bool) -> Lane<F> {
        let margins = if keep { Margins::Kept(Vec::new()) } else { Margins::Counted(Vec::new()) };
        let (never, always, squared, ray) = (0, 0, 0, (u64::MAX, 0));
        Lane { question, never, always, squared, ray, floor, decisive: None, margins }
    }

    /// Adds a margin; those of one index come one after another.
    #[inline]
    pub fn add(&mut self, axis: &Axis<F>, margin: F, place: Place) {
        if self.ray.0 != place.index {
            self.ray = (place.index, 0);
        }
        // The step from one square to the next.
        self.squared += 2 * self.ray.1 + 1;
        self.ray.1 += 1;
        if !margin.is_finite() {
            let count = if margin < F::zero() { &mut self.never } else { &mut self.always };
            *count += 1;
            return;
        }
        match &mut self.margins {
            Margins::Counted(counts) => {
                counts.resize(axis.edges().len(), 0);
                counts[axis.cell(margin)] += 1;
            }
            Margins::Kept(margins) => margins.push(margin),
        }
        if self.floor <= margin {
            propose(&mut self.decisive, self.question, (margin, place), true);
        }
    }

    pub fn merge(&mut self, other: Lane<F>) {
        self.never += other.never;
        self.always += other.always;
        self.squared += other.squared;
        match (&mut self.margins, other.margins) {
            (Margins::Counted(counts), Margins::Counted(more)) if counts.is_empty() => {
                *counts = more;
            }
            (Margins::Counted(counts), Margins::Counted(more)) => {
                counts.iter_mut().zip(more).for_each(|(count, more)| *count += more);
            }
            (Margins::Kept(margins), Margins::Kept(more)) => margins.extend(more),
            _ => unreachable!("lanes of one run keep margins alike"),
        }
        if let Some(decisive) = other.decisive {
            propose(&mut self.decisive, self.question, decisive, true);
        }
    }

    pub fn curve(self, axis: &Axis<F>) -> Curve<F> {
        let cells = match self.margins {
            Margins::Counted(counts) => counted(axis, &counts),
            Margins::Kept(margins) => kept(margins),
        };
        let total = self.never + self.always + cells.iter().map(|cell| cell.count).sum::<u64>();
        Curve {
            question: self.question,
            total,
            squared: self.squared,
            never: self.never,
            always: self.always,
            below: sums(&cells),
            cells,
            floor: self.floor,
            decisive: self.decisive,
        }
    }
}

/// The margins below each cell, and all at the end.
fn sums<F>(cells: &[Cell<F>]) -> Vec<u64> {
    let mut sum = 0;
    let counts = cells.iter().map(|cell| {
        sum += cell.count;
        sum
    });
    std::iter::once(0).chain(counts).collect()
}

fn counted<F: Float>(axis: &Axis<F>, counts: &[u64]) -> Vec<Cell<F>> {
    // Every finite margin is at or above the first edge and below the last.
    let cells = axis.edges().windows(2).zip(counts.iter().skip(1));
    cells
        .filter(|(_, count)| **count > 0)
        .map(|(ends, count)| Cell { low: ends[0], end: ends[1], count: *count })
        .collect()
}

fn kept<F: Float>(mut margins: Vec<F>) -> Vec<Cell<F>> {
    margins.sort_unstable_by_key(|margin| margin.place());
    margins
        .chunk_by(|a, b| a == b)
        .map(|equal| {
            let end = equal[0].offset_ulps(1);
            Cell { low: equal[0], end, count: equal.len() as u64 }
        })
        .collect()
}

#[cfg(test)]
mod tests;
