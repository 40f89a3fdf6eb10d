//! Counts the causes of the first findings of each class, by index.

use super::attribution::{Attribution, attribute};
use super::digest::Place;
use super::rows::RowIn;
use super::source::Source;
use super::tally::Tally;
use crate::contract::Contract;
use crate::family::Grouping;
use crate::judge::{Class, Finding, asked};
use crate::kernel::Scalar;
use crate::oracle;
use rayon::prelude::*;
use std::collections::BTreeMap;

/// How often each cause was to blame.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Causes {
    by: [u64; Attribution::ALL.len()],
    /// Findings of kernels that do not run in exact arithmetic.
    pub untold: u64,
}

impl Causes {
    /// The count of one.
    pub fn of(&self, attribution: Attribution) -> u64 {
        self.by[attribution as usize]
    }

    /// Findings whose cause is known.
    pub fn told(&self) -> u64 {
        self.by.iter().sum()
    }

    fn add(&mut self, attribution: Option<Attribution>) {
        match attribution {
            Some(attribution) => self.by[attribution as usize] += 1,
            None => self.untold += 1,
        }
    }

    fn merged(mut self, other: Causes) -> Causes {
        for (count, more) in self.by.iter_mut().zip(other.by) {
            *count += more;
        }
        self.untold += other.untold;
        self
    }
}

/// The causes of the findings whose places a tally keeps, `most` of each class and finding.
pub(super) fn causes<F: Scalar>(
    source: &Source,
    row: &RowIn<F>,
    contract: &Contract,
    tally: &Tally,
    most: usize,
) -> BTreeMap<(Class, Finding), Causes> {
    let respawned = source.grouping() == Grouping::Respawn;
    let of_place = |place: &Place| {
        let made = source.make::<F>(place.index);
        let case = &made.cases()[place.triangle as usize];
        let truth = oracle::truth(case);
        let asked = asked(case, &truth, contract, respawned);
        let mut causes = Causes::default();
        causes.add(attribute(row.subject, case, &row.epsilons, &truth, asked));
        causes
    };
    let told = tally.examples.iter().filter(|((_, finding), _)| !finding.is_failure());
    let counted = told.map(|(key, examples)| {
        let places = &examples.first[..examples.first.len().min(most)];
        (key, places.par_iter().map(of_place).reduce(Causes::default, Causes::merged))
    });
    if most == 0 { BTreeMap::new() } else { counted.collect() }
}
