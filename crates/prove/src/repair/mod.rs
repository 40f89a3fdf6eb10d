//! Guarded kernels: a kernel's own program that says hit, miss or ask, and whose hits and misses are proved to be right.

mod answer;
mod chain;
mod fraction;
mod margin;
mod ready;
mod steps;
mod text;

pub use answer::{Answer, Answered};
pub use chain::Chain;
pub use fraction::Literal;
pub use margin::{Margin, Margins, Scale};
pub use ready::Ready;
pub use steps::{Axes, Pattern, Step};

use super::checker;
use super::forms::Leaf;
use super::order::is_impossible;
use super::summary::{format_of, paths_of};
use crate::arith::ScalarName;
use crate::arith::recorded::{Operation, Place};
use crate::contract::{Contract, Demand, Extent, Sides};
use crate::kernel::{Entry, KernelInfo, Scalar};
use fraction::Arena;
use std::collections::BTreeMap;
use steps::Builder;

/// A kernel that says hit, miss or ask.
#[derive(Debug)]
pub struct Guarded {
    /// The kernel that it was made from.
    pub info: &'static KernelInfo,
    /// Its operations, operands first.
    pub operations: Vec<Operation>,
    /// Its decisions.
    pub steps: Step,
    /// The numbers whose signs it needs, with their margins.
    pub margins: BTreeMap<Place, Margin>,
    /// The constants of its margins.
    pub scale: Scale,
    /// `f32` or `f64`.
    pub scalar: ScalarName,
}

impl Guarded {
    /// A kernel with margins in place of its epsilons, if the checker accepts the proof that its hits and misses are
    /// right; an error in one sentence otherwise.
    pub fn new<F: Scalar>(entry: &Entry) -> Result<Guarded, String> {
        if entry.info.name.contains('+') {
            return Err("the margins take the place of epsilons, and hold with fused products and without: name the kernel without what stands behind +".to_owned());
        }
        let Contract {
            coplanar,
            degenerate,
            ..
        } = entry.info.contract;
        if [coplanar, degenerate].contains(&Demand::Hit) {
            return Err(
                "its contract wants hits in the plane of a triangle, where no margin is left"
                    .to_owned(),
            );
        }
        let mut paths = paths_of::<F>(entry)?;
        paths.retain(|path| !is_impossible(path));
        let mut builder = Builder {
            paths: &paths,
            arena: Arena::default(),
        };
        let all: Vec<usize> = (0..paths.len()).collect();
        let steps = builder.steps(&all, 0, 0)?.with_axes(&mut builder.arena);
        let scale = Scale::of(format_of::<F>());
        let mut guarded = Guarded {
            info: entry.info,
            operations: builder.arena.operations,
            steps,
            margins: BTreeMap::new(),
            scale,
            scalar: F::NAME,
        };
        guarded.keep_used();
        let steps = guarded.steps.all();
        let literals = steps.into_iter().flat_map(Step::literals);
        // The numbers whose signs decide.
        let places: Vec<Place> = literals.flat_map(Literal::places).collect();
        for place in places {
            let margin = guarded.sizes().of(place);
            let margin = margin
                .map_err(|why| format!("a number that it decides by has no margin: {why}"))?;
            guarded.margins.insert(place, margin);
        }
        checker::check_guarded(&guarded.certificate()).map_err(|refusal| refusal.message)?;
        Ok(guarded)
    }

    /// The rule for its margins.
    pub fn sizes(&self) -> Margins<'_> {
        Margins {
            operations: &self.operations,
            scale: self.scale,
        }
    }

    /// True if the size of a number is its own absolute value: inputs, differences of points, and whole numbers.
    pub fn is_leaf(&self, place: Place) -> bool {
        let operation = self.operations[place as usize];
        matches!(operation, Operation::Number(_)) || Leaf::of(operation, &self.operations).is_some()
    }

    /// Drops the operations that nothing needs.
    fn keep_used(&mut self) {
        let mut is_used = vec![false; self.operations.len()];
        self.steps
            .each(&mut |place| is_used[*place as usize] = true);
        for place in (0..self.operations.len()).rev() {
            if is_used[place] {
                for operand in self.operations[place].operands() {
                    is_used[operand as usize] = true;
                }
            }
        }
        let mut moved = Vec::with_capacity(is_used.len());
        let mut kept: Vec<Operation> = Vec::new();
        for (operation, is_used) in self.operations.iter().zip(&is_used) {
            moved.push(kept.len() as Place);
            if *is_used {
                kept.push(operation.with(|operand| moved[operand as usize]));
            }
        }
        self.steps
            .each(&mut |place| *place = moved[*place as usize]);
        self.operations = kept;
    }

    /// Its extent, and true if it hits the front only.
    pub fn promise(&self) -> (Extent, bool) {
        (
            self.info.contract.extent,
            self.info.contract.sides == Sides::Front,
        )
    }
}
