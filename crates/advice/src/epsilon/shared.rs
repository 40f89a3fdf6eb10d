//! Cases with their truths that several kernels of a table get: made once, and kept up to a number of cases.
//!
//! All strata but two have the same cases for every kernel, so that the rows of a table are compared on the same rays. The
//! cases that start or end at a kernel's own hit points are its own.

use super::relative::CaseSizes;
use crate::audit::{Chunk, Source, SourceSummary};
use crate::case::Case;
use crate::engine::Unobserved;
use crate::kernel::Scalar;
use crate::oracle::Layers;
use crate::truth::Truth;
use std::collections::BTreeMap;
use std::mem;
use std::ops::Range;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

/// So many cases are kept with their truths, in `f64` at most some 220 MB; each kernel makes the others again. They are
/// more than those of 40,000 indices of each stratum, with the triangles around groups.
const MOST_SHARED: usize = 1_600_000;

/// Some indices of a source: the id of the first, which says all about the source, and the end.
type SharedPart = (String, u64);

/// The cases of some indices with their truths, and the triangles around their groups.
pub(super) struct MadeCases<F: Scalar> {
    pub chunk: Chunk<F>,
    pub around: Around<F>,
    sizes: OnceLock<Vec<CaseSizes>>,
}

/// The triangles around the groups of a chunk, with their rays: as kernels get them.
pub(super) struct Around<F: Scalar> {
    pub cases: Vec<Case<F>>,
    pub truths: Vec<Truth>,
    /// By group: its triangles; none where they are too many to be asked.
    pub of_groups: Vec<Option<Range<usize>>>,
}

/// The cases that were made first.
pub struct SharedCases<F: Scalar>(Mutex<KeptCases<F>>);

struct KeptCases<F: Scalar> {
    cases: usize,
    parts: BTreeMap<SharedPart, Arc<MadeCases<F>>>,
}

impl<F: Scalar> Default for KeptCases<F> {
    fn default() -> KeptCases<F> {
        KeptCases {
            cases: 0,
            parts: BTreeMap::new(),
        }
    }
}

impl<F: Scalar> Default for SharedCases<F> {
    fn default() -> SharedCases<F> {
        SharedCases(Mutex::new(KeptCases::default()))
    }
}

impl<F: Scalar> SharedCases<F> {
    /// Some indices of a source, which are made unless they are kept.
    pub(super) fn part(&self, source: &Source, indices: Range<u64>) -> Arc<MadeCases<F>> {
        if source.parameters.kernel.is_some() {
            return Arc::new(MadeCases::new(source, indices));
        }
        let part = (source.id::<F>(indices.start, None), indices.end);
        let kept = || self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(made) = kept().parts.get(&part) {
            return made.clone();
        }
        let made = Arc::new(MadeCases::new(source, indices));
        let mut kept = kept();
        if kept.cases + made.len() <= MOST_SHARED {
            kept.cases += made.len();
            kept.parts.insert(part, made.clone());
        }
        made
    }

    /// Keeps none of the cases so far: what comes needs others.
    pub fn forget(&self) {
        mem::take(&mut *self.0.lock().unwrap_or_else(PoisonError::into_inner));
    }
}

impl<F: Scalar> MadeCases<F> {
    /// The cases of some indices.
    pub fn new(source: &Source, indices: Range<u64>) -> MadeCases<F> {
        let mut summary = SourceSummary::new(0, F::NAME);
        let chunk = Chunk::make(source, indices, &Unobserved, &mut summary);
        let around = Around::of(source, &chunk);
        MadeCases {
            chunk,
            around,
            sizes: OnceLock::new(),
        }
    }

    /// The sizes of all cases, by place.
    pub fn sizes(&self) -> &[CaseSizes] {
        self.sizes.get_or_init(|| {
            let mut sizes = Vec::with_capacity(self.len());
            for place in 0..self.len() {
                sizes.push(CaseSizes::of(self.case(place)));
            }
            sizes
        })
    }

    /// How many cases there are, with those around groups.
    pub fn len(&self) -> usize {
        self.chunk.cases.len() + self.around.cases.len()
    }

    /// A case of the chunk, or after these of a triangle around a group.
    pub fn case(&self, place: usize) -> &Case<F> {
        let own = &self.chunk.cases;
        own.get(place)
            .unwrap_or_else(|| &self.around.cases[place - own.len()])
    }
}

impl<F: Scalar> Around<F> {
    fn of(source: &Source, chunk: &Chunk<F>) -> Around<F> {
        let mut around = Around {
            cases: Vec::new(),
            truths: Vec::new(),
            of_groups: Vec::new(),
        };
        if !chunk.grouping.shares_a_ray() {
            return around;
        }
        for (index, group) in chunk.groups() {
            let start = around.cases.len();
            let is_asked = source.add_neighbours(index, &chunk.cases[group], &mut around.cases);
            if !is_asked {
                around.cases.truncate(start);
            }
            let end = around.cases.len();
            around.of_groups.push(is_asked.then_some(start..end));
        }
        source.ask(
            &mut around.cases,
            &mut around.truths,
            &mut Layers::default(),
        );
        around
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::case::{Parameters, Scene};
    use crate::family::Stratum;

    fn made(source: &Source, indices: Range<u64>) -> MadeCases<f32> {
        MadeCases::new(source, indices)
    }

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
        let first = shared.part(&edges, 0..64);
        assert!(Arc::ptr_eq(&first, &shared.part(&edges, 0..64)));
        assert_eq!(first.chunk.cases, made(&edges, 0..64).chunk.cases);
        let of_kernel = Some("moller-trumbore");
        let others = [
            (source(Stratum::Edges, "room", None, 2), 0..64),
            (source(Stratum::Edges, "room,plane=axis", None, 1), 0..64),
            (source(Stratum::Vertices, "room", None, 1), 0..64),
            (source(Stratum::Shadow, "room", of_kernel, 1), 0..64),
            (edges.clone(), 0..32),
            (edges.clone(), 1..64),
        ];
        for (other, indices) in others {
            let part = shared.part(&other, indices.clone());
            assert!(!Arc::ptr_eq(&first, &part));
            assert_eq!(part.chunk.cases, made(&other, indices).chunk.cases);
        }
        // Those of one kernel are not kept.
        let shadow = source(Stratum::Shadow, "room", of_kernel, 1);
        let twice = [(); 2].map(|()| shared.part(&shadow, 0..64));
        assert!(!Arc::ptr_eq(&twice[0], &twice[1]));
        // Nor is anything after a while.
        shared.forget();
        assert!(!Arc::ptr_eq(&first, &shared.part(&edges, 0..64)));
    }
}
