//! Trials at edges and vertices that triangles share: a group of triangles, and those around it that may have its hit.
//!
//! Where rounding carries a ray over the rim of a group, a neighbour reports the hit, and nothing leaks. So the margins of
//! the triangles around it are taken too ([`Source::add_neighbours`]), but for those that the exact line meets itself:
//! their hits are their own ([`is_moved`]). A hit of such a triangle or of the group is a hit of the trial.

use super::knob::{KnobMargins, MOST_KNOBS};
use super::prepared::{Prepared, PreparedTrial};
use super::rays::{RayCount, Rays, WrongKind};
use super::shared::MadeCases;
use super::trials::{Setting, is_unknown};
use crate::arith::Float;
use crate::audit::Source;
use crate::case::Case;
use crate::judge::{GroupTruth, is_moved};
use crate::kernel::Scalar;
use crate::oracle::Layers;
use std::cell::OnceCell;
use std::ops::Range;

/// The margins of a group's triangles; and these as multiples of each triangle's size, once they are asked for.
struct MeasuredGroup<'a, F: Float> {
    places: Range<usize>,
    margins: &'a [KnobMargins<F>],
    relative: OnceCell<Vec<KnobMargins<F>>>,
}

impl<F: Scalar> Setting<'_, F> {
    /// The crossings of a chunk: groups, and the triangles around them that may have their hit. Where these are too many
    /// to be asked, nobody is accused.
    fn crossings(&self, made: &MadeCases<F>) -> Vec<(Range<usize>, Range<usize>)> {
        let truths = made.chunk.group_truths(&self.row.contract);
        let mut crossings = Vec::with_capacity(truths.len());
        let groups = made.chunk.groups().zip(&made.around.of_groups);
        for (((_, group), around), truth) in groups.zip(truths) {
            if truth != GroupTruth::Crossing {
                continue;
            }
            if let Some(around) = around {
                crossings.push((group, around.clone()));
            }
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

    /// Adds the crossings of rays that count as cracks. The margins of triangles around a group come after those of the
    /// group, which are put at the end once more; those that report no hit where the group reports none are left out.
    pub(super) fn add_crossings(&self, rays: Rays, prepared: &mut Prepared<F>) {
        let of_cracks = RayCount {
            rays,
            kind: WrongKind::Crack,
        };
        let Some(count) = self.counts.iter().position(|count| *count == of_cracks) else {
            return;
        };
        let made = prepared.made.clone();
        let own_cases = made.chunk.cases.len();
        let around = &made.around;
        let (margins, _) = self.margins(&around.cases);
        let mut kept = Vec::new();
        for (group, others) in self.crossings(&made) {
            let own = MeasuredGroup {
                places: group.clone(),
                margins: &prepared.margins[group.clone()],
                relative: OnceCell::new(),
            };
            kept.clear();
            for i in others {
                let is_its_own = !is_moved(&around.truths[i], &self.row.contract);
                let place = own_cases + i;
                if !is_its_own && !self.is_left_out(&made, place, &margins[i], &own) {
                    kept.push(i);
                }
            }
            let trial = PreparedTrial {
                count,
                guards: [matches!(rays, Rays::Stratum(_)); MOST_KNOBS],
                first: group.start,
                margins: group.clone(),
                around: kept.len(),
            };
            if kept.is_empty() {
                prepared.trials.push(trial);
                continue;
            }
            let start = prepared.margins.len();
            prepared.margins.extend_from_within(group.clone());
            prepared.others.extend(group);
            for &i in &kept {
                prepared.margins.push(margins[i]);
                prepared.others.push(own_cases + i);
            }
            let margins = start..prepared.margins.len();
            prepared.trials.push(PreparedTrial { margins, ..trial });
        }
    }

    /// True if a triangle beside a group reports no hit where the group reports none, also where epsilons follow each
    /// triangle's size.
    fn is_left_out(
        &self,
        made: &MadeCases<F>,
        place: usize,
        margins: &KnobMargins<F>,
        group: &MeasuredGroup<'_, F>,
    ) -> bool {
        if is_unknown(margins) || !is_covered(margins, group.margins) {
            return false;
        }
        if is_refused(margins) {
            return true;
        }
        let relative = |place: usize, margins| self.relative_to(made.sizes()[place], margins);
        let of_group = group.relative.get_or_init(|| {
            let all = group.places.clone().zip(group.margins);
            all.map(|(place, margins)| relative(place, margins))
                .collect()
        });
        is_covered(&relative(place, margins), of_group)
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
