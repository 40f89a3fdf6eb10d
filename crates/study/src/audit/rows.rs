//! The rows of a plan in one scalar: kernels, epsilons and contracts looked up once.

use super::row::Row;
use crate::case::Case;
use crate::contract::Contract;
use crate::engine::Observer;
use crate::kernel::{KernelIn, KernelInfo, Scalar, Verdict, verdicts_of};

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
    pub subject: &'static dyn KernelIn<F>,
    pub info: &'static KernelInfo,
    /// True of a kernel of one's own, whose mistakes are not known.
    pub is_own: bool,
    pub epsilons: Vec<F>,
    /// Which of the contracts.
    pub contract: usize,
}

impl<F: Scalar> Rows<F> {
    pub fn new(rows: &[Row]) -> Rows<F> {
        let mut contracts: Vec<Contract> = Vec::new();
        let resolve = |(number, row): (usize, &Row)| {
            let subject = F::subject(row.entry)?;
            let known = contracts
                .iter()
                .position(|contract| *contract == row.contract);
            let contract = known.unwrap_or_else(|| {
                contracts.push(row.contract);
                contracts.len() - 1
            });
            let info = row.entry.info;
            let is_own = !row.entry.is_built_in();
            Some(RowIn {
                number,
                subject,
                info,
                is_own,
                epsilons: row.epsilons(),
                contract,
            })
        };
        let each = rows.iter().enumerate().filter_map(resolve).collect();
        Rows { each, contracts }
    }
}

impl<F: Scalar> RowIn<F> {
    /// Runs the kernel on cases. Returns the nanoseconds that it took, by its own clock if it has one.
    pub fn run(
        &self,
        cases: &[Case<F>],
        verdicts: &mut [Verdict<F>],
        observer: &dyn Observer,
    ) -> u64 {
        let start = observer.now();
        let own = verdicts_of(self.subject, cases, &self.epsilons, verdicts);
        own.unwrap_or_else(|| observer.now() - start)
    }
}
