//! How far a knob may move while the others stay: limits by order statistics, with a confidence. From below
//! they are about all that must be refused; from above, about the hits that the other knobs leave.
//!
//! Let m be the k-th smallest margin of n trials. The share of all trials with a margin below m is at most p
//! with confidence P(at least k of n trials are among the lowest share p), which is a binomial
//! probability, whatever the distribution of margins is (Wilks 1941). With a larger rank the share is at least p in
//! the same way. So between two ranks lies the value at which just the share p is wrong.

use super::candidates::middle;
use super::confidence::{Ranks, kept, ranks};
use super::rays::{RayCount, Rays, WrongKind};
use super::trials::{Pass, Setting, Trial, accepts};
use crate::arith::{Float, smallest_normal, two_digits};
use crate::engine::Merge;
use crate::family::Stratum;
use crate::kernel::{Role, Scalar};

/// A limit of one knob by one count.
#[derive(Clone, Debug, PartialEq)]
pub struct KnobLimit<F> {
    /// The knob's place in the setting.
    pub knob: usize,
    /// The count's place in the setting.
    pub count: usize,
    /// True if values must be at or above the limit, false if at or below it.
    pub is_lower: bool,
    /// The value; none if no value of the knob keeps the share.
    pub value: Option<F>,
    /// A value beyond which more than the share is wrong, with the same confidence; none if these rays show none.
    pub far: Option<F>,
    /// At most one in this many answers is wrong at the limit.
    pub one_in: u64,
}

/// A limit that is known no better than within this factor moves a hundredfold with the seed.
const UNSURE: f64 = 30.0;

impl<F: Float> KnobLimit<F> {
    /// True if these rays show so little of where the limit is that nobody should act on its value.
    pub fn is_unsure(&self) -> bool {
        let Some(value) = self.value else {
            return false;
        };
        let Some(far) = self.far else { return true };
        let [value, far] = [value, far].map(F::to_f64);
        let ratio = value / far;
        // Zero over zero is no distance; a change of the sign is any.
        value != far && !(1.0 / UNSURE..=UNSURE).contains(&ratio)
    }
}

/// The trials of one knob and count: how many there are, and the margins at the end that decides.
#[derive(Clone)]
struct Tail<F> {
    knob: usize,
    count: usize,
    is_lower: bool,
    of: u64,
    /// How many margins may decide.
    kept: usize,
    /// Sorted, the most decisive first.
    margins: Vec<F>,
}

impl<F: Float> Tail<F> {
    fn add(&mut self, margin: F) {
        let is_lower = self.is_lower;
        let before = |a: &F, b: &F| if is_lower { b < a } else { a < b };
        if self.margins.len() == self.kept && !before(&margin, &self.margins[self.kept - 1]) {
            return;
        }
        let place = self.margins.partition_point(|kept| before(kept, &margin));
        self.margins.insert(place, margin);
        self.margins.truncate(self.kept);
    }
}

struct Tails<F>(Vec<Tail<F>>);

impl<F: Float> Merge for Tails<F> {
    fn merge(&mut self, other: Tails<F>) {
        for (tail, more) in self.0.iter_mut().zip(other.0) {
            tail.of += more.of;
            more.margins.into_iter().for_each(|margin| tail.add(margin));
        }
    }
}

/// True if a limit comes from the rays beside a triangle. It shows how near they pass, so it is not printed; but the
/// middle between it and the cracks is a good value for an edge.
fn is_beside(count: RayCount) -> bool {
    count.rays == Rays::Stratum(Stratum::Outside)
}

/// True if a count limits a knob from below, false if from above; none if such a knob is not chosen by what it counts.
fn side(role: Role, count: RayCount) -> Option<bool> {
    let Rays::Stratum(stratum) = count.rays else {
        return Some(match (role, count.kind) {
            (Role::Parallel | Role::T, WrongKind::Miss) => false,
            (Role::Parallel | Role::T, WrongKind::Hit) | (Role::T, WrongKind::SelfHit) => true,
            (Role::Edge | Role::Other, kind) => !kind.is_wrong_if_refused(),
            (Role::Parallel, WrongKind::Crack | WrongKind::SelfHit)
            | (Role::T, WrongKind::Crack) => return None,
        });
    };
    match (role, stratum, count.kind) {
        (Role::Parallel, Stratum::Grazing | Stratum::Parallel, WrongKind::Hit) => Some(true),
        (Role::T, Stratum::Shadow, WrongKind::SelfHit) => Some(true),
        (Role::Parallel | Role::T, Stratum::Interior, WrongKind::Miss) => Some(false),
        (Role::Edge | Role::Other, Stratum::Edges | Stratum::Vertices, WrongKind::Crack) => {
            Some(false)
        }
        (Role::Edge | Role::Other, Stratum::Outside, WrongKind::Hit) => Some(true),
        _ => None,
    }
}

/// The limits of every knob around given epsilons that are printed.
pub fn limits<F: Scalar>(
    setting: &Setting<'_, F>,
    epsilons: &[F],
    pass: Pass<'_>,
) -> Vec<KnobLimit<F>> {
    printed(setting, all_limits(setting, epsilons, pass))
}

/// The limits that say something of the kernel, which are printed.
pub fn printed<F: Scalar>(
    setting: &Setting<'_, F>,
    mut limits: Vec<KnobLimit<F>>,
) -> Vec<KnobLimit<F>> {
    limits.retain(|limit| !is_beside(setting.counts[limit.count]));
    limits
}

/// The limits of every knob around given epsilons, also those by the rays beside triangles.
pub fn all_limits<F: Scalar>(
    setting: &Setting<'_, F>,
    epsilons: &[F],
    pass: Pass<'_>,
) -> Vec<KnobLimit<F>> {
    let gates = setting.row.entry.info.gates;
    let kept = kept(pass.count);
    let mut none = Vec::new();
    for (knob, role) in setting
        .knobs
        .iter()
        .map(|knob| knob.gate(gates).role)
        .enumerate()
    {
        for (count, counted) in setting.counts.iter().enumerate() {
            let tail = |is_lower| Tail {
                knob,
                count,
                is_lower,
                of: 0,
                kept,
                margins: Vec::new(),
            };
            none.extend(side(role, *counted).map(tail));
        }
    }
    let add = |tails: &mut Tails<F>, trial: Trial<'_, F>| {
        for tail in tails.0.iter_mut().filter(|tail| tail.count == trial.count) {
            let margin = alone(&trial, tail.knob, epsilons);
            let counts = match tail.is_lower {
                true => trial.guards[tail.knob],
                false => is_own(&trial, tail.knob, margin),
            };
            if counts {
                tail.of += 1;
                tail.add(margin);
            }
        }
    };
    let Tails(tails) = setting.sum(pass, || Tails(none.clone()), add);
    let limit = |Tail {
                     knob,
                     count,
                     is_lower,
                     of,
                     margins,
                     ..
                 }: Tail<F>| {
        let Ranks { one_in, safe, far } = ranks(of)?;
        let margin = |rank: u64| margins.get(rank as usize - 1).copied();
        let value = value(margin(safe)?, is_lower)?;
        let far = margin(far).and_then(|margin| bound(margin, is_lower, !is_lower));
        Some(KnobLimit {
            knob,
            count,
            is_lower,
            value,
            far,
            one_in,
        })
    };
    tails.into_iter().filter_map(limit).collect()
}

/// The value of a limit by the margin that decides, in two digits; `Some(None)` if no value of the knob refuses enough,
/// and none where there is nothing to keep out, or nothing to lose.
fn value<F: Float>(margin: F, is_lower: bool) -> Option<Option<F>> {
    if is_lower && margin == F::infinity() {
        return Some(None);
    }
    bound(margin, is_lower, is_lower).map(Some)
}

/// The value at which a margin decides, in two digits, rounded up or down; none if no number is.
fn bound<F: Float>(margin: F, is_lower: bool, is_up: bool) -> Option<F> {
    let bound = if is_lower { above(margin) } else { margin };
    margin.is_finite().then(|| two_digits(bound, is_up))
}

/// By knob: a round number in the middle between its limits, if they meet on one side of zero.
pub fn between<F: Float>(limits: &[KnobLimit<F>], knobs: usize) -> Vec<Option<F>> {
    let between = |knob: usize| {
        let of_side = |is_lower: bool| {
            let found = limits
                .iter()
                .filter(|limit| limit.knob == knob && limit.is_lower == is_lower);
            // None if there is no limit, or one that no value keeps.
            let values: Option<Vec<F>> = found.map(|limit| limit.value).collect();
            let stricter = |a: F, b: F| if (a < b) == is_lower { b } else { a };
            values?.into_iter().reduce(stricter)
        };
        let (low, high) = (of_side(true)?, of_side(false)?);
        // The least normal number stands for any on its side of zero.
        let is_limit = |bound: F| 2.0 * smallest_normal::<F>() < bound.to_f64();
        if high < F::zero() {
            return (is_limit(-high) && low <= high).then(|| -middle(-high, -low));
        }
        (is_limit(low) && low <= high).then(|| middle(low, high))
    };
    (0..knobs).map(between).collect()
}

/// The largest value of one knob at which a trial is a hit while the others stay.
pub fn alone<F: Float>(trial: &Trial<'_, F>, knob: usize, epsilons: &[F]) -> F {
    let mut most = -F::infinity();
    for margins in trial.margins {
        let mut others = *margins;
        others[knob] = F::infinity();
        if accepts(&others, epsilons) && most < margins[knob] {
            most = margins[knob];
        }
    }
    most
}

/// True if losing a trial at the largest value of a knob at which it is a hit would be the knob's doing: not where
/// the others refuse each of its triangles, or the one that this knob keeps longest, as a least t does at an edge
/// that is too near.
pub(super) fn is_own<F: Float>(trial: &Trial<'_, F>, knob: usize, largest: F) -> bool {
    -F::infinity() < largest && trial.margins.iter().all(|margins| margins[knob] <= largest)
}

/// The next number above another; above zero the next that no machine flushes to zero.
fn above<F: Float>(x: F) -> F {
    let normal = smallest_normal::<F>();
    let next = x.offset_ulps(1);
    if F::zero() < next && next.to_f64() < normal {
        F::from_f64(normal)
    } else {
        next
    }
}

#[cfg(test)]
mod tests;
