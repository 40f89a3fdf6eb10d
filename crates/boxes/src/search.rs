//! A search for the case that needs the most growth: changes to the numbers of a case, kept if it still must be hit and its
//! margin does not rise.
//!
//! Growth is needed only where the line meets the box in next to one point. So each change is followed by a repair: one
//! slab is cut off where the line enters the last of the others.

use crate::case::{BoxCase, Boxes, NUMBERS};
use crate::family::FamilyScalar;
use crate::judge::Obligation;
use crate::oracle::truth;
use crate::setup::Setup;
use crate::source::Source;
use hairline_core::case::Draw;
use hairline_core::engine::{Merge, Observer, sum};
use hairline_core::kernel::{KernelIn, Scalar};
use std::ops::Range;

/// No number of a search but 0 is smaller: 2^-20.
const LEAST: f64 = 1.0 / MOST;

/// No number of a search is larger.
const MOST: f64 = (1u64 << 20) as f64;

/// A search from the cases of a source.
pub struct Search<'a> {
    /// The slab test; the margin of its first gate is lowered.
    pub setup: &'a Setup,
    /// Where the search starts.
    pub source: Source,
    /// How many cases it starts from.
    pub starts: u64,
    /// How many changes it tries on each.
    pub steps: u64,
    /// The seed of both.
    pub seed: u64,
}

/// The case with the lowest margin.
#[derive(Clone, Copy, Debug)]
pub struct Found<F: FamilyScalar> {
    /// The margin: the largest epsilon at which the case is hit.
    pub margin: F,
    /// The case.
    pub case: BoxCase<F>,
    /// The start that led there.
    pub start: u64,
}

/// The best of a search so far.
struct Best<F: FamilyScalar>(Option<Found<F>>);

impl<F: FamilyScalar> Merge for Best<F> {
    fn merge(&mut self, other: Best<F>) {
        self.0 = self.0.into_iter().chain(other.0).reduce(lower);
    }
}

/// The lower margin of two; of equals that of the lower start.
fn lower<F: FamilyScalar>(one: Found<F>, other: Found<F>) -> Found<F> {
    let is_lower = other.margin < one.margin;
    let is_as_low = other.margin == one.margin;
    if is_lower || (is_as_low && other.start < one.start) {
        return other;
    }
    one
}

/// The case that needs the most growth, as far as a search finds it; none if no start must be hit. An error if the slab
/// test does not run in this scalar, or has no gate.
pub fn search<F: FamilyScalar + Scalar>(
    search: &Search,
    observer: &dyn Observer,
) -> Result<Option<Found<F>>, String> {
    let subject = search.setup.subject::<F>()?;
    if search.setup.gates().is_empty() {
        let name = search.setup.entry.info.name;
        return Err(format!("{name} has no gate"));
    }
    let climber = Climber { search, subject };
    let add = |best: &mut Best<F>, starts: Range<u64>| {
        for start in starts {
            best.merge(Best(climber.climb(start)));
        }
    };
    let best = sum(0..search.starts, 1, observer, || Best(None), add);
    Ok(best.0)
}

struct Climber<'a, F: FamilyScalar> {
    search: &'a Search<'a>,
    subject: &'static dyn KernelIn<F, Boxes>,
}

impl<F: FamilyScalar> Climber<'_, F> {
    fn climb(&self, start: u64) -> Option<Found<F>> {
        let Search {
            source,
            steps,
            seed,
            ..
        } = *self.search;
        let mut draw = Draw::new("search of boxes", seed, start);
        let mut case = source.case::<F>(seed, start);
        let mut margin = self.margin(&case)?;
        for _ in 0..steps {
            let next = changed(&mut draw, &case);
            let leaves = draw.below(3);
            // The rounded plane may be one place short.
            for outwards in 0..3 {
                let cut = cut_off(&next, leaves, outwards);
                let Some(found) = self.margin(&cut) else {
                    continue;
                };
                if found <= margin {
                    case = cut;
                    margin = found;
                }
                break;
            }
        }
        Some(Found {
            margin,
            case,
            start,
        })
    }

    /// The margin of a case that must be hit, and that the other gates let through.
    fn margin(&self, case: &BoxCase<F>) -> Option<F> {
        let setup = self.search.setup;
        let obligation = Obligation::new(&truth(case), &setup.contract);
        if obligation != Obligation::Hit || !is_ordinary(case) {
            return None;
        }
        let mut margins = vec![F::zero(); setup.gates().len()];
        self.subject
            .margins(setup.entry.info, &[*case], &mut margins, &mut []);
        let [first, others @ ..] = margins.as_slice() else {
            return None;
        };
        if others.iter().any(|margin| *margin < F::zero()) {
            return None;
        }
        first.is_finite().then_some(*first)
    }
}

/// True if all numbers are so far from the ends of the floats that nothing overflows or underflows.
fn is_ordinary<F: FamilyScalar>(case: &BoxCase<F>) -> bool {
    let vectors = case.vectors();
    vectors.as_flattened().iter().all(|x| {
        let size = x.to_f64().abs();
        size == 0.0 || (LEAST..=MOST).contains(&size)
    })
}

/// One to three numbers moved, by one place or by up to a whole binade.
fn changed<F: FamilyScalar>(draw: &mut Draw, case: &BoxCase<F>) -> BoxCase<F> {
    let mut vectors = case.vectors();
    let numbers = vectors.as_flattened_mut();
    let changes = 1 + draw.below(3);
    for _ in 0..changes {
        let number = &mut numbers[draw.below(NUMBERS - 2)];
        let reach = 1i64 << draw.integer(0, i64::from(F::DIGITS));
        *number = number.offset_ulps(draw.integer(-reach, reach));
    }
    case.with(vectors)
}

/// A case whose line leaves one slab about where it enters the last of the others: its far plane is put there, and some
/// places further out.
fn cut_off<F: FamilyScalar>(case: &BoxCase<F>, leaves: usize, outwards: i64) -> BoxCase<F> {
    let [origin, direction, min, max] = case.widen().vectors();
    let mut t = 0.0;
    for i in (0..3).filter(|i| *i != leaves && direction[*i] != 0.0) {
        let is_forward = direction[i] > 0.0;
        let near = if is_forward { min[i] } else { max[i] };
        t = f64::max(t, (near - origin[i]) / direction[i]);
    }
    let plane = F::from_f64(origin[leaves] + t * direction[leaves]);
    let mut vectors = case.vectors();
    let [origin, _, min, max] = &mut vectors;
    let origin = origin[leaves];
    let min = &mut min[leaves];
    let max = &mut max[leaves];
    if direction[leaves] > 0.0 {
        *max = plane.offset_ulps(outwards);
        *min = if plane < *min { origin } else { *min };
    } else {
        *min = plane.offset_ulps(-outwards);
        *max = if *max < plane { origin } else { *max };
    }
    case.with(vectors)
}
