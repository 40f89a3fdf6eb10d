//! Verdicts that come from outside, judged as a run judges those of a kernel.

use super::row::Row;
use super::run::{Audit, Runner, Sums};
use super::source::Source;
use crate::arith::Float;
use crate::case::Case;
use crate::engine::Observer;
use crate::kernel::{Scalar, Subject, Verdict};
use std::ops::Range;
use std::sync::{Mutex, PoisonError};

/// A kernel whose verdicts are handed in ahead of each run, in the order of the cases.
#[derive(Default)]
pub struct Given<F>(Mutex<Vec<Verdict<F>>>);

impl<F: Float> Subject<F> for Given<F> {
    fn run(&self, cases: &[Case<F>], _: &[F], verdicts: &mut [Verdict<F>]) {
        let given = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        assert_eq!(given.len(), cases.len(), "a verdict for each case");
        verdicts.copy_from_slice(&given);
    }
}

/// The sums over one source in one scalar, from verdicts handed in chunk by chunk.
pub struct Answers<'a, F: Scalar> {
    runner: Runner<'a, F>,
    given: &'static Given<F>,
    sums: Sums,
    examples: usize,
}

impl<'a, F: Scalar> Answers<'a, F> {
    /// For one row, whose kernel is `given`, and the source of a number.
    pub fn new(
        row: &Row,
        given: &'static Given<F>,
        examples: usize,
        attribute: usize,
        source: usize,
        observer: &'a dyn Observer,
    ) -> Self {
        let runner = Runner::new(std::slice::from_ref(row), attribute, observer);
        let sums = runner.no_sums(examples, source);
        Answers { runner, given, sums, examples }
    }

    /// Judges the verdicts on all cases of some indices.
    pub fn add(&mut self, source: &Source, indices: Range<u64>, verdicts: Vec<Verdict<F>>) {
        *self.given.0.lock().unwrap_or_else(PoisonError::into_inner) = verdicts;
        self.runner.add_chunk(source, indices, &mut self.sums);
    }

    /// Puts the sums at the end of an audit's.
    pub fn finish(self, source: &Source, audit: &mut Audit) {
        let first = audit.cells.len();
        self.runner.add_to(self.sums, audit);
        let cells = audit.cells[first..].iter_mut().collect();
        self.runner.finish_cells(cells, |_| source, self.examples);
    }
}
