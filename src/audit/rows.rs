//! The rows of a plan in one scalar: kernels, epsilons and contracts looked up once.

use super::row::Row;
use crate::arith::Float;
use crate::case::Case;
use crate::contract::Contract;
use crate::kernel::{Failure, KernelInfo, Scalar, Subject, Verdict};
use std::panic::{AssertUnwindSafe, catch_unwind};

/// The rows whose kernels run in a scalar.
pub(super) struct Rows<F: 'static> {
    /// In the order of the plan.
    pub each: Vec<RowIn<F>>,
    /// Their contracts, each once.
    pub contracts: Vec<Contract>,
}

/// A row in one scalar.
pub(super) struct RowIn<F: 'static> {
    /// The row's place in the plan.
    pub number: usize,
    pub subject: &'static dyn Subject<F>,
    pub info: &'static KernelInfo,
    pub epsilons: Vec<F>,
    /// Which of the contracts.
    pub contract: usize,
}

impl<F: Scalar> Rows<F> {
    pub fn new(rows: &[Row]) -> Rows<F> {
        let mut contracts: Vec<Contract> = Vec::new();
        let resolve = |(number, row): (usize, &Row)| {
            let subject = F::subject(row.entry)?;
            let known = contracts.iter().position(|contract| *contract == row.contract);
            let contract = known.unwrap_or_else(|| {
                contracts.push(row.contract);
                contracts.len() - 1
            });
            let info = row.entry.info;
            Some(RowIn { number, subject, info, epsilons: row.epsilons(), contract })
        };
        let each = rows.iter().enumerate().filter_map(resolve).collect();
        Rows { each, contracts }
    }
}

/// Runs a kernel on all cases.
pub(crate) fn verdicts_of<F: Float>(
    subject: &dyn Subject<F>,
    cases: &[Case<F>],
    epsilons: &[F],
    verdicts: &mut [Verdict<F>],
) {
    let run = |cases: &[Case<F>], verdicts: &mut [Verdict<F>]| {
        catch_unwind(AssertUnwindSafe(|| subject.run(cases, epsilons, verdicts)))
    };
    if run(cases, verdicts).is_ok() {
        return;
    }
    // Once more, one by one, to pin the cases at which it panicked.
    for i in 0..cases.len() {
        if run(&cases[i..=i], &mut verdicts[i..=i]).is_err() {
            verdicts[i] = Verdict::failed(Failure::Panic);
        }
    }
}
