//! Groups at the edges and vertices of a mesh: by class of ray, which targets leak, and where something is wrong.

use super::group_count::{GroupCount, GroupOutcome, JudgedGroup};
use super::places::{PlaceFault, Places};
use crate::contract::Across;
use crate::mesh::AimedPart;
use crate::truth::Truth;
use serde::{Deserialize, Serialize};

/// The classes of rays, by how they meet their target: whether exactly, as the oracle says, and
/// whether they were made to graze a triangle.
pub const CLASSES: [&str; 4] = ["exact", "exact-grazing", "near", "near-grazing"];

/// The target of a ray, and which of [`CLASSES`] it has.
#[derive(Clone, Copy)]
pub struct AimedRay {
    pub(super) target: u32,
    pub(super) class: usize,
}

/// The sums over the rays at the edges, or at the vertices, of a mesh.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Aimed {
    /// By [`CLASSES`].
    pub classes: [GroupCount; 4],
    /// Where it went wrong, as many as the plan wants.
    pub places: Places,
    /// A bit a target: it has a crack.
    leaking: Vec<u64>,
}

impl Aimed {
    /// Adds a group, of which a contract promises something; keeps so many examples and places.
    pub(super) fn add(
        &mut self,
        (ray, group): (AimedRay, &JudgedGroup),
        across: Across,
        [examples, places]: [usize; 2],
    ) {
        let outcome = self.classes[ray.class].add(group, examples);
        let Some(fault) = fault_in(outcome, across) else {
            return;
        };
        if fault == PlaceFault::Crack {
            let word = ray.target as usize / 64;
            self.leaking.resize(self.leaking.len().max(word + 1), 0);
            self.leaking[word] |= 1 << (ray.target % 64);
        }
        self.places.add(fault, ray.target, group.index, places);
    }

    /// Adds another sum.
    pub(super) fn merge(&mut self, other: Aimed, [examples, places]: [usize; 2]) {
        for (groups, more) in self.classes.iter_mut().zip(other.classes) {
            groups.merge(more, examples);
        }
        self.places.merge(other.places, places);
        self.leaking
            .resize(self.leaking.len().max(other.leaking.len()), 0);
        self.leaking
            .iter_mut()
            .zip(other.leaking)
            .for_each(|(word, more)| *word |= more);
    }

    /// How many targets have a crack.
    pub fn leaking(&self) -> u64 {
        self.leaking
            .iter()
            .map(|word| u64::from(word.count_ones()))
            .sum()
    }
}

/// True if the exact line meets the edge that the triangles share, or the centre of the fan.
pub(super) fn is_on_target(part: AimedPart, truths: &[Truth]) -> bool {
    truths.iter().all(|truth| {
        truth.crossing().is_some_and(|crossing| match part {
            AimedPart::Edges => crossing.feature.is_edge(),
            AimedPart::Vertices => crossing.feature.is_vertex(),
        })
    })
}

/// The fault in an outcome: a crack whatever the contract, the others where it promises exactly one hit.
fn fault_in(outcome: GroupOutcome, across: Across) -> Option<PlaceFault> {
    match outcome {
        GroupOutcome::Right | GroupOutcome::Elsewhere => None,
        GroupOutcome::Crack => Some(PlaceFault::Crack),
        // Who does not promise it is not blamed for it.
        _ if across != Across::ExactlyOne => None,
        GroupOutcome::Double => Some(PlaceFault::Double),
        GroupOutcome::OddFold => Some(PlaceFault::OddFold),
    }
}
