//! A search for the case that needs the most growth: changes to the numbers of a case, kept if it still must be hit and its
//! margin does not rise.
//!
//! Growth is needed only where the line meets the box in next to one point. So each change is followed by a repair: one
//! slab is cut off where the line enters the last of the others.

use crate::case::{BoxCase, Boxes, NUMBERS};
use crate::family::Made;
use crate::judge::Obligation;
use crate::oracle::truth;
use crate::setup::Setup;
use crate::source::Source;
use hairline_core::case::Draw;
use hairline_core::engine::{Merge, Observer, sum};
use hairline_core::kernel::{Scalar, Subject};
use std::ops::Range;

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
pub struct Found<F: Made> {
    /// The margin: the largest epsilon at which the case is hit.
    pub margin: F,
    /// The case.
    pub case: BoxCase<F>,
    /// The start that led there.
    pub start: u64,
}

/// The best of a search so far.
struct Best<F: Made>(Option<Found<F>>);

impl<F: Made> Merge for Best<F> {
    fn merge(&mut self, other: Best<F>) {
        self.0 = self.0.into_iter().chain(other.0).reduce(lower);
    }
}

/// The lower margin of two; of equals that of the lower start.
fn lower<F: Made>(one: Found<F>, other: Found<F>) -> Found<F> {
    let is_first = one.start <= other.start;
    if other.margin < one.margin || (other.margin == one.margin && !is_first) {
        return other;
    }
    one
}

/// The case that needs the most growth, as far as a search finds it; none if no start must be hit. An error if the slab
/// test does not run in this scalar, or has no gate.
pub fn search<F: Made + Scalar>(
    search: &Search,
    observer: &dyn Observer,
) -> Result<Option<Found<F>>, String> {
    let (entry, name) = (search.setup.entry, search.setup.entry.info.name);
    let subject = F::subject(entry).ok_or_else(|| format!("{name} does not run in {}", F::NAME))?;
    if search.setup.gates().is_empty() {
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

struct Climber<'a, F: Made> {
    search: &'a Search<'a>,
    subject: &'static dyn Subject<F, Boxes>,
}

impl<F: Made> Climber<'_, F> {
    fn climb(&self, start: u64) -> Option<Found<F>> {
        let mut draw = Draw::new("search of boxes", self.search.seed, start);
        let mut case = self.search.source.case::<F>(self.search.seed, start);
        let mut margin = self.margin(&case)?;
        for _ in 0..self.search.steps {
            let next = changed(&mut draw, &case);
            let leaves = draw.below(3);
            // The rounded plane may be one place short.
            for outwards in 0..3 {
                let cut = cut_off(&next, leaves, outwards);
                let Some(found) = self.margin(&cut) else {
                    continue;
                };
                if found <= margin {
                    (case, margin) = (cut, found);
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
        if !is_ordinary(case) || Obligation::new(&truth(case), &setup.contract) != Obligation::Hit {
            return None;
        }
        let mut margins = vec![F::zero(); setup.gates().len()];
        self.subject
            .margins(setup.entry.info, &[*case], &mut margins, &mut []);
        let [first, others @ ..] = margins.as_slice() else {
            return None;
        };
        let passes = others.iter().all(|margin| F::zero() <= *margin);
        (passes && first.is_finite()).then_some(*first)
    }
}

/// True if all numbers are so far from the ends of the floats that nothing overflows or underflows.
fn is_ordinary<F: Made>(case: &BoxCase<F>) -> bool {
    let [least, most] = [-20, 20].map(|power: i32| f64::from(power).exp2());
    let is_between = |x: &F| x.is_zero() || (least..=most).contains(&x.to_f64().abs());
    case.vectors().as_flattened().iter().all(is_between)
}

/// One to three numbers moved, by one place or by up to a whole binade.
fn changed<F: Made>(draw: &mut Draw, case: &BoxCase<F>) -> BoxCase<F> {
    let mut vectors = case.vectors();
    let numbers = vectors.as_flattened_mut();
    let changes = 1 + draw.below(3);
    for _ in 0..changes {
        let number = &mut numbers[draw.below(NUMBERS - 2)];
        let reach = 1i64 << draw.integer(0, i64::from(F::DIGITS));
        *number = number.offset_ulps(draw.integer(-reach, reach));
    }
    let [origin, direction, min, max] = vectors;
    BoxCase::new(origin, direction, [min, max]).on(case.ray.t_min, case.ray.t_max)
}

/// A case whose line leaves one slab about where it enters the last of the others: its far plane is put there, and some
/// places further out.
fn cut_off<F: Made>(case: &BoxCase<F>, leaves: usize, outwards: i64) -> BoxCase<F> {
    let wide = case.widen();
    let [origin, direction, min, max] = wide.vectors();
    let is_forward = |i: usize| 0.0 < direction[i];
    let enters = |i: usize| {
        let near = if is_forward(i) { min[i] } else { max[i] };
        (near - origin[i]) / direction[i]
    };
    let others = (0..3).filter(|i| *i != leaves && direction[*i] != 0.0);
    let t = others.map(enters).fold(0.0, f64::max);
    let plane = F::from_f64(origin[leaves] + t * direction[leaves]);
    let [origin, direction, mut min, mut max] = case.vectors();
    if F::zero() < direction[leaves] {
        max[leaves] = plane.offset_ulps(outwards);
        min[leaves] = if plane < min[leaves] {
            origin[leaves]
        } else {
            min[leaves]
        };
    } else {
        min[leaves] = plane.offset_ulps(-outwards);
        max[leaves] = if max[leaves] < plane {
            origin[leaves]
        } else {
            max[leaves]
        };
    }
    BoxCase::new(origin, direction, [min, max]).on(case.ray.t_min, case.ray.t_max)
}
