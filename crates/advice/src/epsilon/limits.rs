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
mod tests {
    use super::*;
    use crate::case::Draw;

    fn empty_tail<F>(is_lower: bool, of: u64, kept: usize) -> Tail<F> {
        Tail {
            knob: 1,
            count: 2,
            is_lower,
            of,
            kept,
            margins: Vec::new(),
        }
    }

    #[test]
    fn a_tail_keeps_the_most_decisive_margins_in_order() {
        let mut draw = Draw::new("tail", 1, 0);
        for lowest_first in [true, false] {
            let margins: Vec<f32> = (0..300).map(|_| draw.below(90) as f32 - 40.0).collect();
            let tail = |margins: &[f32]| {
                let mut tail = empty_tail(!lowest_first, margins.len() as u64, 64);
                margins.iter().for_each(|margin| tail.add(*margin));
                tail
            };
            let (one, other) = margins.split_at(100);
            let mut sum = Tails(vec![tail(one)]);
            sum.merge(Tails(vec![tail(other)]));
            let mut sorted = margins.clone();
            sorted.sort_by(f32::total_cmp);
            if !lowest_first {
                sorted.reverse();
            }
            for found in [sum.0.remove(0), tail(&margins)] {
                assert_eq!((found.of, &found.margins[..]), (300, &sorted[..64]));
            }
        }
    }

    #[test]
    fn a_crack_that_is_a_hit_too_near_is_not_the_edges_own() {
        // Of an edge and a least t: the triangle that is met, and its neighbour far beside it.
        let (inf, no) = (f64::INFINITY, f64::NEG_INFINITY);
        let margins = [[0.5, 1.0, inf], [-0.3, 9.0, inf], [no; 3]];
        let trial = Trial {
            count: 0,
            guards: [true; 3],
            margins: &margins,
            around: 0,
            first: None,
        };
        let own = |least_t: f64| {
            let largest = alone(&trial, 0, &[0.0, least_t, 0.0]);
            (largest, is_own(&trial, 0, largest))
        };
        assert_eq!([own(0.0), own(1.0)], [(0.5, true); 2]);
        assert_eq!([own(2.0), own(10.0)], [(-0.3, false), (no, false)]);
        // What another gate refuses is no knob's.
        let refused = Trial {
            margins: &[[no; 3]; 2],
            ..trial
        };
        assert!(!is_own(&refused, 0, no));
    }

    #[test]
    fn above_a_number_is_the_next_that_is_not_flushed() {
        let normal = f32::MIN_POSITIVE;
        for x in [
            1.0f32,
            -1.0,
            normal,
            normal.next_down(),
            -normal,
            -normal.next_down(),
        ] {
            assert_eq!(above(x), x.next_up(), "{x:e}");
        }
        for x in [
            0.0,
            f32::from_bits(1),
            normal / 2.0,
            normal.next_down().next_down(),
        ] {
            assert_eq!(above(x), normal, "{x:e}");
        }
        assert_eq!(above(-f32::from_bits(1)), 0.0);
    }

    #[test]
    fn a_limit_keeps_what_its_margin_says_in_two_digits() {
        let inf = f64::INFINITY;
        assert_eq!(
            [true, false].map(|is_lower| value(0.123, is_lower)),
            [Some(0.13), Some(0.12)].map(Some)
        );
        assert_eq!(
            [inf, -inf].map(|margin| value(margin, true)),
            [Some(None), None]
        );
        assert_eq!([inf, -inf].map(|margin| value(margin, false)), [None; 2]);
    }

    #[test]
    fn between_limits_that_meet_is_a_round_number() {
        let limit = |is_lower, value| KnobLimit {
            knob: 1,
            count: 0,
            is_lower,
            value,
            far: None,
            one_in: 9,
        };
        let (low, high) = (limit(true, Some(7.9e-12)), limit(false, Some(3.6e-4)));
        for (limits, middle) in [
            (vec![low.clone(), high.clone()], Some(5e-8)),
            // The strictest of each side: 1.4e-7 is in the middle.
            (
                vec![
                    limit(true, Some(1e-12)),
                    low.clone(),
                    limit(false, Some(2.5e-3)),
                    limit(false, Some(2.5e-3)),
                ],
                Some(1e-7),
            ),
            (
                vec![low.clone(), limit(false, Some(1.0)), high.clone()],
                Some(5e-8),
            ),
            (
                vec![
                    high.clone(),
                    limit(false, Some(1.0)),
                    low.clone(),
                    limit(true, Some(1e-12)),
                ],
                Some(5e-8),
            ),
            (
                vec![limit(true, Some(3.1e-6)), limit(false, Some(3.3e-6))],
                Some(3.1e-6),
            ),
            (
                vec![limit(true, Some(4e-6)), limit(false, Some(3.3e-6))],
                None,
            ),
            (vec![low.clone(), limit(false, None)], None),
            (vec![low.clone()], None),
            (vec![high.clone()], None),
            // Below zero too, where 2.1e-4 is in the middle.
            (
                vec![limit(true, Some(-6e-2)), limit(false, Some(-7.2e-7))],
                Some(-2e-4),
            ),
            (
                vec![limit(true, Some(-3.1e-6)), limit(false, Some(-3.1e-6))],
                Some(-3.1e-6),
            ),
            (
                vec![limit(true, Some(-1e-4)), limit(false, Some(-8e-4))],
                None,
            ),
            (
                vec![
                    limit(true, Some(-1e-4)),
                    limit(false, Some(-f64::MIN_POSITIVE)),
                ],
                None,
            ),
            (
                vec![limit(true, Some(-1e-4)), limit(false, Some(8e-4))],
                None,
            ),
            (
                vec![limit(true, Some(3e-9)), limit(false, Some(-7.2e-7))],
                None,
            ),
            (
                vec![limit(true, Some(3.1e-6)), limit(false, Some(3.1e-6))],
                Some(3.1e-6),
            ),
            // Both are round, or one: the first that is nearest to the middle.
            (
                vec![limit(true, Some(1e-6)), limit(false, Some(2e-6))],
                Some(1e-6),
            ),
            (
                vec![limit(true, Some(1.5e-6)), limit(false, Some(2e-6))],
                Some(2e-6),
            ),
            // Up to twice the least normal number is any above zero.
            (
                vec![limit(true, Some(2.0 * f64::MIN_POSITIVE)), high.clone()],
                None,
            ),
            (
                vec![limit(true, Some(3.0 * f64::MIN_POSITIVE)), high.clone()],
                Some(5e-156),
            ),
        ] {
            assert_eq!(between(&limits, 2), [None, middle], "{limits:?}");
        }
    }

    /// Tests a distribution whose quantiles are known: the uniform one.
    #[test]
    fn limits_are_violated_no_more_often_than_stated() {
        let (runs, n) = (4000, 700);
        let Ranks { one_in, safe, far } = ranks(n).unwrap();
        let mut beyond = [0u32; 2];
        for run in 0..runs {
            let mut draw = Draw::new("limits", 1, run);
            let mut tail = empty_tail(false, n, kept(n));
            (0..n).for_each(|_| tail.add(draw.unit()));
            // The share below a number is that number.
            let share = 1.0 / (one_in as f64);
            beyond[0] += u32::from(share < tail.margins[safe as usize - 1]);
            beyond[1] += u32::from(tail.margins[far as usize - 1] < share);
        }
        for violated in beyond.map(|count| f64::from(count) / runs as f64) {
            let chance = 3.0 * (0.05f64 * 0.95 / runs as f64).sqrt();
            assert!(violated <= 0.05 + chance, "{beyond:?}");
            // And the limit is not far from the share: no more confidence is given away than there is to be.
            assert!(0.01 < violated, "{beyond:?}");
        }
    }

    #[test]
    fn a_limit_that_could_as_well_be_elsewhere_is_unsure() {
        let limit = |value: Option<f64>, far| {
            KnobLimit {
                knob: 0,
                count: 0,
                is_lower: false,
                value,
                far,
                one_in: 9,
            }
            .is_unsure()
        };
        for (value, far, is_unsure) in [
            (1e-6, Some(2.9e-5), false),
            (1e-6, Some(3.1e-5), true),
            (3e-5, Some(1.1e-6), false),
            (-3e-5, Some(-1.1e-6), false),
            (-3e-5, Some(-9e-7), true),
            (-3e-5, Some(3e-5), true),
            (0.0, Some(0.0), false),
            (0.0, Some(1e-30), true),
            (1e-30, Some(0.0), true),
            (1e-30, None, true),
        ] {
            assert_eq!(limit(Some(value), far), is_unsure, "{value} {far:?}");
        }
        assert!(!limit(None, None));
    }
}
