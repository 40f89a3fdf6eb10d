//! Cases with their truths that several kernels of a table get: made once, and kept up to a number of cases.
//!
//! All strata but two have the same cases for every kernel, so that the rows of a table are compared on the same rays. The
//! cases that start or end at a kernel's own hit points are its own.

use crate::audit::{Chunk, Source, SourceSummary};
use crate::engine::Unobserved;
use crate::kernel::Scalar;
use std::collections::BTreeMap;
use std::ops::Range;
use std::sync::{Arc, Mutex, PoisonError};

/// So many cases are kept with their truths, in `f64` at most some 200 MB; each kernel makes the others again.
const MOST_SHARED: usize = 1_000_000;

/// Some indices of a source: the id of the first, which says all about the source, and the end.
type SharedPart = (String, u64);

/// The cases that were made first.
pub struct SharedCases<F: Scalar>(Mutex<KeptChunks<F>>);

struct KeptChunks<F: Scalar> {
    cases: usize,
    chunks: BTreeMap<SharedPart, Arc<Chunk<F>>>,
}

impl<F: Scalar> Default for SharedCases<F> {
    fn default() -> SharedCases<F> {
        SharedCases(Mutex::new(KeptChunks {
            cases: 0,
            chunks: BTreeMap::new(),
        }))
    }
}

impl<F: Scalar> SharedCases<F> {
    /// Some indices of a source, which are made unless they are kept.
    pub(super) fn chunk(&self, source: &Source, indices: Range<u64>) -> Arc<Chunk<F>> {
        if source.parameters.kernel.is_some() {
            return Arc::new(made(source, indices));
        }
        let part = (source.id::<F>(indices.start, None), indices.end);
        let kept = || self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(chunk) = kept().chunks.get(&part) {
            return chunk.clone();
        }
        let chunk = Arc::new(made(source, indices));
        let mut kept = kept();
        if kept.cases + chunk.cases.len() <= MOST_SHARED {
            kept.cases += chunk.cases.len();
            kept.chunks.insert(part, chunk.clone());
        }
        chunk
    }
}

/// The cases of some indices, with their truths.
pub(super) fn made<F: Scalar>(source: &Source, indices: Range<u64>) -> Chunk<F> {
    let mut summary = SourceSummary::new(0, F::NAME);
    Chunk::make(source, indices, &Unobserved, &mut summary)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::case::{Parameters, Scene};
    use crate::family::Stratum;

    fn source(stratum: Stratum, scene: &str, kernel: Option<&str>, seed: u64) -> Source {
        let parameters = Parameters {
            scene: Some(Scene::parse(scene).unwrap().0),
            kernel: kernel.map(str::to_owned),
            ..Parameters::default()
        };
        Source::of_stratum(stratum, None, parameters, seed, 64)
    }

    #[test]
    fn cases_are_shared_by_what_makes_them_and_by_nothing_less() {
        let shared = SharedCases::<f32>::default();
        let edges = source(Stratum::Edges, "room", None, 1);
        let first = shared.chunk(&edges, 0..64);
        assert!(Arc::ptr_eq(&first, &shared.chunk(&edges, 0..64)));
        assert_eq!(first.cases, made::<f32>(&edges, 0..64).cases);
        let of_kernel = Some("moller-trumbore");
        let others = [
            (source(Stratum::Edges, "room", None, 2), 0..64),
            (source(Stratum::Edges, "room,plane=axis", None, 1), 0..64),
            (source(Stratum::Vertices, "room", None, 1), 0..64),
            (source(Stratum::Shadow, "room", of_kernel, 1), 0..64),
            (edges.clone(), 0..32),
            (edges, 1..64),
        ];
        for (other, indices) in others {
            let chunk = shared.chunk(&other, indices.clone());
            assert!(!Arc::ptr_eq(&first, &chunk));
            assert_eq!(chunk.cases, made::<f32>(&other, indices).cases);
        }
        // Those of one kernel are not kept.
        let shadow = source(Stratum::Shadow, "room", of_kernel, 1);
        let twice = [(); 2].map(|()| shared.chunk(&shadow, 0..64));
        assert!(!Arc::ptr_eq(&twice[0], &twice[1]));
    }
}
