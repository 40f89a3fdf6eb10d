//! The contents of a plan, by the names of expectations.

use crate::report::{KernelResult, Key, ResultPart};
use std::collections::{BTreeMap, BTreeSet};

/// The contents of the plan.
pub(super) struct Planned<'a> {
    results: BTreeMap<[&'a str; 4], &'a KernelResult>,
    kernels: BTreeSet<&'a str>,
    scalars: BTreeSet<&'a str>,
    families: BTreeSet<&'a str>,
}

impl<'a> Planned<'a> {
    pub fn of(result: &'a ResultPart) -> Planned<'a> {
        Planned {
            results: result.by_place(),
            kernels: result.plan.rows.iter().map(|row| row.kernel.as_str()).collect(),
            scalars: result.plan.scalars.iter().map(String::as_str).collect(),
            families: result.plan.sources.iter().map(|source| source.family.as_str()).collect(),
        }
    }

    pub fn result(&self, key: &Key) -> Option<&'a KernelResult> {
        self.results.get(&key.place()).copied()
    }

    /// True if the plan leaves out the kernel, the scalar or the family: then the expectation is about
    /// something else. A kernel that runs with other epsilons only is another matter.
    pub fn leaves_out(&self, key: &Key) -> bool {
        !self.kernels.contains(key.kernel.as_str())
            || !self.scalars.contains(key.scalar.as_str())
            || !self.families.contains(key.family.as_str())
    }
}
