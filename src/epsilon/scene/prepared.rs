//! Rays of a scene with what the kernel makes of them, kept between the passes over them.

use super::knob::Margins;
use crate::arith::Float;
use crate::case::Case;
use crate::family::Stratum;
use crate::kernel::Hit;
use std::collections::BTreeMap;
use std::ops::Range;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

/// So many cases are kept, which are at most some 150 MB; every pass makes the others again.
const MOST_KEPT: usize = 600_000;

/// Some indices of a stratum.
pub(super) struct Prepared<F: Float> {
    /// The cases.
    pub cases: Vec<Case<F>>,
    /// Of each case.
    pub margins: Vec<Margins<F>>,
    /// The same as multiples of each case's own size, once they were asked for.
    pub relative: OnceLock<Vec<Margins<F>>>,
    /// What a hit of each case would report.
    pub values: Vec<Option<Hit<F>>>,
    /// Which count each trial is for, and its cases.
    pub trials: Vec<(usize, Range<usize>)>,
}

/// The rays of one seed that were prepared first.
pub struct Store<F: Float>(Mutex<Kept<F>>);

struct Kept<F: Float> {
    seed: u64,
    cases: usize,
    /// By stratum, and by the first index and the end.
    parts: BTreeMap<(Stratum, u64, u64), Arc<Prepared<F>>>,
}

impl<F: Float> Default for Store<F> {
    fn default() -> Store<F> {
        Store(Mutex::new(Kept { seed: 0, cases: 0, parts: BTreeMap::new() }))
    }
}

impl<F: Float> Store<F> {
    /// The part of a seed at a place, which is made unless it is kept. Another seed's are dropped.
    pub(super) fn part(
        &self,
        seed: u64,
        place: (Stratum, u64, u64),
        make: impl FnOnce() -> Prepared<F>,
    ) -> Arc<Prepared<F>> {
        let kept = || self.0.lock().unwrap_or_else(PoisonError::into_inner);
        {
            let mut kept = kept();
            if kept.seed != seed {
                *kept = Kept { seed, cases: 0, parts: BTreeMap::new() };
            }
            if let Some(part) = kept.parts.get(&place) {
                return part.clone();
            }
        }
        let part = Arc::new(make());
        let mut kept = kept();
        if kept.seed == seed && kept.cases + part.cases.len() <= MOST_KEPT {
            kept.cases += part.cases.len();
            kept.parts.insert(place, part.clone());
        }
        part
    }
}
