//! Rays of a scene with what the kernel makes of them, kept between the passes over them.

use super::errors::{HitErrors, JudgedHit};
use super::knob::{Guards, KnobMargins};
use super::shared::MadeCases;
use crate::case::Case;
use crate::kernel::{Hit, Scalar};
use std::collections::BTreeMap;
use std::ops::Range;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

/// So many cases are kept, in `f64` at most some 300 MB; every pass makes the others again. They are those of 40,000
/// indices of each stratum, with the triangles around groups.
const MOST_KEPT: usize = 1_600_000;

/// Some indices of a stratum.
pub(super) struct Prepared<F: Scalar> {
    /// Their cases, and those of the triangles around groups.
    pub made: Arc<MadeCases<F>>,
    /// The margins of each case of the chunk, and then others.
    pub margins: Vec<KnobMargins<F>>,
    /// Whose the other margins are, by the places of [`MadeCases::case`].
    pub others: Vec<usize>,
    /// The margins as multiples of each case's own size, once they were asked for.
    pub relative: OnceLock<Vec<KnobMargins<F>>>,
    /// The values that a hit of each case of the chunk would report, and its errors once they are asked for; none where no
    /// hit can be lost.
    pub hits: Vec<(Option<Hit<F>>, OnceLock<HitErrors>)>,
    /// The trials.
    pub trials: Vec<PreparedTrial>,
}

/// A trial: what it is for, and its cases.
pub(super) struct PreparedTrial {
    /// Which of the setting's counts it is for.
    pub count: usize,
    /// Which knobs guard it.
    pub guards: Guards,
    /// Its first case.
    pub first: usize,
    /// The margins of its cases: of a group those of the group, and then those of triangles around it that may have its hit.
    pub margins: Range<usize>,
    /// How many of them are of triangles around a group.
    pub around: usize,
}

impl<F: Scalar> Prepared<F> {
    /// The hit of a trial's first case, if it can be lost.
    pub fn first_hit(&self, trial: &PreparedTrial) -> Option<JudgedHit<'_, F>> {
        let (hit, errors) = self.hits.get(trial.first)?;
        Some(JudgedHit {
            case: self.made.case(trial.first),
            hit: hit.as_ref()?,
            errors,
        })
    }

    /// The cases of the margins that are not those of the chunk.
    pub fn other_cases(&self) -> Vec<Case<F>> {
        let mut cases = Vec::with_capacity(self.others.len());
        for place in &self.others {
            cases.push(*self.made.case(*place));
        }
        cases
    }
}

/// Some indices: the kind of their rays, the place of their source among those of the kind, and where they start and end.
pub(super) type PreparedPart = (usize, usize, u64, u64);

/// The rays of one seed that were prepared first.
pub struct Store<F: Scalar>(Mutex<StoredRays<F>>);

struct StoredRays<F: Scalar> {
    seed: u64,
    cases: usize,
    parts: BTreeMap<PreparedPart, Arc<Prepared<F>>>,
}

impl<F: Scalar> Default for Store<F> {
    fn default() -> Store<F> {
        Store(Mutex::new(StoredRays {
            seed: 0,
            cases: 0,
            parts: BTreeMap::new(),
        }))
    }
}

impl<F: Scalar> Store<F> {
    /// The part of a seed at a place, which is made unless it is kept. Another seed's are dropped.
    pub(super) fn part(
        &self,
        seed: u64,
        place: PreparedPart,
        make: impl FnOnce() -> Prepared<F>,
    ) -> Arc<Prepared<F>> {
        let kept = || self.0.lock().unwrap_or_else(PoisonError::into_inner);
        {
            let mut kept = kept();
            if kept.seed != seed {
                *kept = StoredRays {
                    seed,
                    cases: 0,
                    parts: BTreeMap::new(),
                };
            }
            if let Some(part) = kept.parts.get(&place) {
                return part.clone();
            }
        }
        let part = Arc::new(make());
        let mut kept = kept();
        if kept.seed == seed && kept.cases + part.made.len() <= MOST_KEPT {
            kept.cases += part.made.len();
            kept.parts.insert(place, part.clone());
        }
        part
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::audit::{CorpusSet, Source};

    const PLACES: [PreparedPart; 3] = [(1, 0, 0, 1), (1, 0, 1, 2), (0, 0, 0, 1)];

    /// So many cases; nothing else of a part matters to what keeps it.
    fn of_cases(count: usize) -> Prepared<f32> {
        let case = Case::new([0.0; 3], [1.0; 3], [[0.0; 3]; 3]);
        let source = Source::stored(CorpusSet::default(), None);
        let mut made = MadeCases::new(&source, 0..0);
        made.around.cases = vec![case; count];
        Prepared {
            made: Arc::new(made),
            margins: Vec::new(),
            others: Vec::new(),
            relative: OnceLock::new(),
            hits: Vec::new(),
            trials: Vec::new(),
        }
    }

    /// How many cases a part has, and whether it was made now.
    fn made(store: &Store<f32>, seed: u64, place: usize, count: usize) -> (usize, bool) {
        let mut is_made = false;
        let part = store.part(seed, PLACES[place], || {
            is_made = true;
            of_cases(count)
        });
        (part.made.len(), is_made)
    }

    #[test]
    fn parts_of_one_seed_are_kept_up_to_a_number_of_cases() {
        let store = Store::default();
        let rest = MOST_KEPT - 1;
        let twice = |seed, place, count| [(); 2].map(|()| made(&store, seed, place, count));
        // Each seed has all the room.
        for seed in [0, 4] {
            assert_eq!(twice(seed, 0, 1), [(1, true), (1, false)]);
            assert_eq!(twice(seed, 1, rest), [(rest, true), (rest, false)]);
            assert_eq!(twice(seed, 2, 1), [(1, true); 2]);
        }
        // The first seed's parts are gone.
        assert_eq!(made(&store, 0, 0, 2), (2, true));
    }

    #[test]
    fn a_part_that_is_made_while_another_seed_comes_is_not_kept() {
        let store = Store::default();
        let part = store.part(5, PLACES[0], || {
            assert_eq!(made(&store, 6, 1, 1), (1, true));
            of_cases(2)
        });
        assert_eq!(part.made.len(), 2);
        assert_eq!(
            [made(&store, 6, 0, 3), made(&store, 6, 1, 3)],
            [(3, true), (1, false)]
        );
    }
}
