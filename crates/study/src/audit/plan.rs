//! The plan of a run: rows of kernels with epsilons, and sources of cases.

use super::row::Row;
use super::source::{Source, Stock};
use crate::mesh::{AimedPart, Surface};

/// Kernels, sources and a contract.
pub struct Plan {
    /// The kernels with their epsilons.
    pub rows: Vec<Row>,
    /// The sources of cases.
    pub sources: Vec<Source>,
    /// True for each scalar that runs: `f32`, `f64`.
    pub scalars: [bool; 2],
    /// How many examples of each class of finding to keep, by index.
    pub examples: usize,
    /// How many findings of each class, the first by index, to attribute to a cause; and on at least how many
    /// indices of each source, evenly spread, to measure the values of right hits.
    pub attribute: usize,
    /// On how many indices of each source to measure the values of right hits, if that is more.
    pub measured: usize,
    /// How many places of a mesh to keep for a drawing, of each row, part and scalar.
    pub places: usize,
}

impl Plan {
    /// A plan that counts and keeps so many examples, without causes, accuracy and places.
    pub fn new(rows: Vec<Row>, sources: Vec<Source>, scalars: [bool; 2], examples: usize) -> Plan {
        Plan {
            rows,
            sources,
            scalars,
            examples,
            attribute: 0,
            measured: 0,
            places: 0,
        }
    }

    /// The mesh whose edges and vertices it asks about; none if it asks about anything else.
    pub fn surface(&self) -> Option<&Surface> {
        let [edges, vertices] = &self.sources[..] else {
            return None;
        };
        match (&edges.stock, &vertices.stock) {
            (Stock::MeshPart(surface, AimedPart::Edges), Stock::MeshPart(..)) => Some(surface),
            _ => None,
        }
    }

    /// How many examples, findings to attribute and places a tally keeps.
    pub(super) fn limits(&self) -> [usize; 3] {
        [self.examples, self.attribute, self.places]
    }
}
