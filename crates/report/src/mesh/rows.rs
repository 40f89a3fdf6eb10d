//! The rows of an audit of a mesh: what a kernel did at the edges, together with what it did at the vertices.

use crate::arith::ScalarName;
use hairline_cases::mesh::AimedPart;
use hairline_record::Rate;
use hairline_record::*;

/// A kernel row in one scalar.
pub(super) struct MeshRow<'a> {
    pub part: &'a RowPart,
    pub scalar: ScalarName,
    /// At the edges, and at the vertices.
    pub at: [AtPart<'a>; 2],
}

/// The results at the edges, or at the vertices.
#[derive(Clone, Copy)]
pub(super) struct AtPart<'a> {
    pub result: &'a KernelResult,
    pub across: &'a AcrossPart,
    /// How many leak.
    pub leaking: u64,
}

impl<'a> AtPart<'a> {
    fn of(result: &'a KernelResult) -> Option<AtPart<'a>> {
        let across = result.across.as_ref()?;
        Some(AtPart {
            result,
            across,
            leaking: across.leaking.as_ref()?.count,
        })
    }

    /// Cases on which the kernel gave no verdict.
    pub fn failures(&self) -> u64 {
        let Counts {
            panics,
            crashes,
            timeouts,
            ..
        } = self.result.total;
        panics + crashes + timeouts
    }
}

/// The rows by scalar, in the order of the plan.
pub(super) fn rows<'a>(result: &'a ResultPart) -> Vec<MeshRow<'a>> {
    let row = |edges: &'a KernelResult| {
        let [kernel, set, ..] = edges.place();
        let mut of_row = result
            .results
            .iter()
            .filter(|it| it.place()[..3] == edges.place()[..3]);
        let (edges, vertices) = (AtPart::of(of_row.next()?)?, AtPart::of(of_row.next()?)?);
        let is_part = |part: &&RowPart| (&*part.kernel, &*part.set) == (kernel, set);
        let part = result.plan.rows.iter().find(is_part)?;
        Some(MeshRow {
            part,
            scalar: edges.result.scalar,
            at: [edges, vertices],
        })
    };
    let is_edges = |it: &&KernelResult| it.family.starts_with(AimedPart::Edges.name());
    result
        .results
        .iter()
        .filter(is_edges)
        .filter_map(row)
        .collect()
}

impl MeshRow<'_> {
    /// The same without published epsilons.
    pub fn short_label(&self) -> String {
        if self.part.set == "source" {
            self.part.kernel.clone()
        } else {
            self.part.label()
        }
    }

    /// The contract's promise.
    pub fn promised(&self) -> Promised {
        self.at[0].across.promised
    }

    /// How many edges and vertices leak.
    pub fn leaks(&self) -> u64 {
        self.at[0].leaking + self.at[1].leaking
    }

    /// Cases without a verdict.
    pub fn failures(&self) -> u64 {
        self.at[0].failures() + self.at[1].failures()
    }

    /// The sum of a rate over edges and vertices.
    pub fn both(&self, rate: fn(&AcrossPart) -> &Rate) -> Rate {
        Rate::sum(self.at.map(|at| rate(at.across)))
    }

    /// How many hits are promised, and whether that was kept; none if nothing is promised.
    pub fn promise(&self) -> Option<(&'static str, bool)> {
        let wrong = |rate: fn(&AcrossPart) -> &Rate| 0 < self.both(rate).count;
        let more = wrong(|across| &across.doubles) || wrong(|across| &across.odd_folds);
        let is_kept = 0 == self.leaks() && !(more && self.promised() == Promised::ExactlyOne);
        self.promised().in_short().map(|hits| (hits, is_kept))
    }
}
