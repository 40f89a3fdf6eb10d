//! The triangles around the groups of a chunk, with their truths: the oracle is asked once for all rows that lose a crossing
//! there.

use super::source::Source;
use crate::case::Case;
use crate::kernel::Scalar;
use crate::oracle::Layers;
use crate::truth::Truth;
use std::collections::BTreeMap;
use std::rc::Rc;

/// So many triangles of a chunk are kept, in `f64` 10 MB; those of other groups are asked for again.
const MOST_KEPT: usize = 1 << 16;

/// The triangles around a group, with its ray: as kernels get them.
pub(super) struct Neighbours<F: Scalar> {
    pub cases: Vec<Case<F>>,
    pub truths: Vec<Truth>,
}

/// The triangles around the groups of a chunk, as far as they are known.
pub(super) struct KnownNeighbours<F: Scalar> {
    /// By index; none where they are too many to be asked.
    of_groups: BTreeMap<u64, Option<Rc<Neighbours<F>>>>,
    kept: usize,
}

impl<F: Scalar> Default for KnownNeighbours<F> {
    fn default() -> Self {
        KnownNeighbours {
            of_groups: BTreeMap::new(),
            kept: 0,
        }
    }
}

impl<F: Scalar> KnownNeighbours<F> {
    /// The triangles around a group of a source; none where they are too many to be asked.
    pub fn of(
        &mut self,
        source: &Source,
        index: u64,
        group: &[Case<F>],
    ) -> Option<Rc<Neighbours<F>>> {
        if let Some(known) = self.of_groups.get(&index) {
            return known.clone();
        }
        let found = Neighbours::around(source, index, group).map(Rc::new);
        let size = found.as_ref().map_or(0, |around| around.cases.len());
        if self.kept + size <= MOST_KEPT {
            self.kept += size;
            self.of_groups.insert(index, found.clone());
        }
        found
    }
}

impl<F: Scalar> Neighbours<F> {
    fn around(source: &Source, index: u64, group: &[Case<F>]) -> Option<Neighbours<F>> {
        let mut cases = Vec::new();
        if !source.add_neighbours(index, group, &mut cases) {
            return None;
        }
        let mut truths = Vec::with_capacity(cases.len());
        source.ask(&mut cases, &mut truths, &mut Layers::default());
        Some(Neighbours { cases, truths })
    }
}
