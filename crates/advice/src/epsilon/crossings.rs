//! Trials at edges and vertices that triangles share: a group of triangles, and those around it that may have its hit.
//!
//! Where rounding carries a ray over the rim of a group, a neighbour reports the hit, and nothing leaks. So the margins of
//! the triangles around it are taken too ([`Source::add_neighbours`]), but for those that the exact line meets itself:
//! their hits are their own ([`is_moved`]). A hit of such a triangle or of the group is a hit of the trial.

use super::knob::{KnobMargins, MOST_KNOBS};
use super::prepared::{Prepared, PreparedTrial};
use super::rays::{RayCount, Rays, WrongKind};
use super::trials::{Setting, is_unknown};
use crate::arith::Float;
use crate::audit::{Chunk, Source};
use crate::case::Case;
use crate::judge::{GroupTruth, is_moved};
use crate::kernel::Scalar;
use crate::oracle::Layers;
use std::cell::OnceCell;
use std::ops::Range;
use std::slice;

/// A ray that crosses a surface at an edge or vertex which triangles share, and what stands around these.
pub(super) struct Surrounded {
    count: usize,
    /// The cases of the group in its chunk.
    group: Range<usize>,
    /// Those of the triangles around it, among all that were asked.
    around: Range<usize>,
}

/// The crossings of a chunk.
pub(super) struct Crossings<F: Float> {
    each: Vec<Surrounded>,
    /// The triangles around the groups that the exact line does not meet.
    around: Vec<Case<F>>,
}

/// The triangles of a group with their margins; and those as multiples of each triangle's size, once they are asked for.
struct MeasuredGroup<'a, F: Float> {
    cases: &'a [Case<F>],
    margins: &'a [KnobMargins<F>],
    relative: OnceCell<Vec<KnobMargins<F>>>,
}

impl<F: Scalar> Setting<'_, F> {
    /// The crossings of a chunk. Where the triangles around a group are too many to be asked, nobody is accused.
    pub(super) fn crossings(&self, source: &Source, chunk: &Chunk<F>, rays: Rays) -> Crossings<F> {
        let mut crossings = Crossings {
            each: Vec::new(),
            around: Vec::new(),
        };
        let of_cracks = RayCount {
            rays,
            kind: WrongKind::Crack,
        };
        let Some(count) = self.counts.iter().position(|count| *count == of_cracks) else {
            return crossings;
        };
        let truths = chunk.group_truths(&self.row.contract);
        let mut around = Vec::new();
        for ((index, group), truth) in chunk.groups().zip(truths) {
            around.clear();
            let is_asked = truth == GroupTruth::Crossing
                && source.add_neighbours(index, &chunk.cases[group.clone()], &mut around);
            if !is_asked {
                continue;
            }
            self.keep_moved(source, &mut around);
            let start = crossings.around.len();
            crossings.around.append(&mut around);
            let around = start..crossings.around.len();
            crossings.each.push(Surrounded {
                count,
                group,
                around,
            });
        }
        crossings
    }

    /// Keeps the triangles whose hit is that of the group among them, as kernels get them.
    pub(super) fn keep_moved(&self, source: &Source, around: &mut Vec<Case<F>>) {
        let mut truths = Vec::with_capacity(around.len());
        source.ask(around, &mut truths, &mut Layers::default());
        let mut truths = truths.iter();
        around.retain(|_| {
            truths
                .next()
                .is_some_and(|it| is_moved(it, &self.row.contract))
        });
    }

    /// Adds crossings as trials. Triangles around a group come after those of the group, which is put at the end once
    /// more; those that report no hit where the group reports none are left out.
    pub(super) fn add_crossings(&self, crossings: Crossings<F>, prepared: &mut Prepared<F>) {
        let Crossings {
            each,
            around: cases,
        } = crossings;
        let (margins, values) = self.margins(&cases);
        for Surrounded {
            count,
            group,
            around: range,
        } in each
        {
            let own = MeasuredGroup {
                cases: &prepared.cases[group.clone()],
                margins: &prepared.margins[group.clone()],
                relative: OnceCell::new(),
            };
            let mut kept = Vec::new();
            for i in range {
                if !self.is_left_out(&cases[i], &margins[i], &own) {
                    kept.push(i);
                }
            }
            let trial = PreparedTrial {
                count,
                guards: [matches!(self.counts[count].rays, Rays::Stratum(_)); MOST_KNOBS],
                cases: group.clone(),
                around: kept.len(),
            };
            if kept.is_empty() {
                prepared.trials.push(trial);
                continue;
            }
            let start = prepared.cases.len();
            prepared.cases.extend_from_within(group.clone());
            prepared.margins.extend_from_within(group.clone());
            prepared.values.extend_from_within(group);
            prepared.cases.extend(kept.iter().map(|i| cases[*i]));
            prepared.margins.extend(kept.iter().map(|i| margins[*i]));
            prepared
                .values
                .extend(kept.iter().map(|i| values[*i].clone()));
            let cases = start..prepared.cases.len();
            prepared.trials.push(PreparedTrial { cases, ..trial });
        }
    }

    /// True if a triangle beside a group reports no hit where the group reports none, also where epsilons follow each
    /// triangle's size. The sizes cost more than all else here, so they are computed last, and only where they matter.
    fn is_left_out(
        &self,
        case: &Case<F>,
        margins: &KnobMargins<F>,
        group: &MeasuredGroup<'_, F>,
    ) -> bool {
        if is_unknown(margins) || !is_covered(margins, group.margins) {
            return false;
        }
        if is_refused(margins) {
            return true;
        }
        let of_group = group
            .relative
            .get_or_init(|| self.relative_margins(group.cases, group.margins));
        let relative = self.relative_margins(slice::from_ref(case), slice::from_ref(margins));
        is_covered(&relative[0], of_group)
    }
}

/// True if no epsilon accepts a triangle: its sizes do not matter then.
fn is_refused<F: Float>(margins: &KnobMargins<F>) -> bool {
    margins.contains(&-F::infinity())
}

/// True if one of some margins accepts whatever these accept.
fn is_covered<F: Float>(margins: &KnobMargins<F>, by: &[KnobMargins<F>]) -> bool {
    by.iter().any(|other| {
        margins
            .iter()
            .zip(other)
            .all(|(margin, other)| margin <= other)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn margins_are_covered_by_those_that_accept_as_much() {
        let inf = f32::INFINITY;
        let own = [[0.0, 2.0, inf], [1.0, -inf, inf]];
        for (margins, covered) in [
            ([0.0, 2.0, inf], true),
            ([-1.0, 1.0, inf], true),
            ([1.0, -inf, inf], true),
            ([0.5, 1.0, inf], false),
            ([1.0, 2.0, inf], false),
            ([f32::NAN, 0.0, inf], false),
        ] {
            assert_eq!(is_covered(&margins, &own), covered, "{margins:?}");
        }
    }
}
