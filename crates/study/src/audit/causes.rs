//! Counts the causes of the first findings of each class, by index.

use super::attribution::{Attribution, attribute, attribute_by_running};
use super::digest::CasePlace;
use super::rows::RowIn;
use super::source::Source;
use super::tally::Tally;
use super::trials::Trials;
use crate::contract::Contract;
use crate::family::Grouping;
use crate::judge::{Class, Finding, asked, judge};
use crate::kernel::{Gives, Scalar, Verdict, verdicts_of};
use crate::oracle;
use std::collections::BTreeMap;
use std::slice;

/// How often each cause was to blame.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Causes {
    by: [Trials; Attribution::ALL.len()],
    /// Findings of kernels that do not run in exact arithmetic, and take no epsilons.
    pub untold: u64,
    /// The cause of the worst finding.
    pub worst: Option<Attribution>,
}

impl Causes {
    /// How often one was, among the findings whose cause is known.
    pub fn of(&self, attribution: Attribution) -> Trials {
        self.by[attribution as usize]
    }

    /// The causes of the findings on one ray.
    fn of_ray(attributions: impl Iterator<Item = Option<Attribution>>) -> Causes {
        let mut causes = Causes::default();
        let mut by = [0; Attribution::ALL.len()];
        for attribution in attributions {
            match attribution {
                Some(attribution) => by[attribution as usize] += 1,
                None => causes.untold += 1,
            }
        }
        let told = by.iter().sum();
        causes
            .by
            .iter_mut()
            .zip(by)
            .for_each(|(trials, count)| trials.add_ray(count, told));
        causes
    }

    fn merged(mut self, other: Causes) -> Causes {
        for (trials, more) in self.by.iter_mut().zip(&other.by) {
            trials.merge(more);
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
    let secondary = source.grouping() == Grouping::SecondaryRay;
    let on_ray = |places: &[CasePlace]| -> Vec<Option<Attribution>> {
        let made = source.make::<F>(places[0].index);
        let of_place = |place: &CasePlace| {
            let case = &source.seen(&made.cases()[place.triangle as usize]);
            let truth = oracle::truth(case);
            let asked = (contract, asked(case, &truth, contract, secondary));
            if source.instance::<F>().is_some() {
                let mut verdict = [Verdict::miss(None)];
                verdicts_of(
                    row.subject,
                    slice::from_ref(case),
                    &row.epsilons,
                    &mut verdict,
                );
                // Values are not judged in an instance.
                if judge(asked, (case, &truth), Gives::NOTHING, &verdict[0]).is_none() {
                    return Some(Attribution::Transform);
                }
            }
            match row.subject.gated() {
                Some(_) => attribute(row.subject, case, &row.epsilons, &truth, asked),
                None => {
                    attribute_by_running(row.subject, row.info, case, &row.epsilons, &truth, asked)
                }
            }
        };
        places.iter().map(of_place).collect()
    };
    let of_ray = |places: &[CasePlace]| Causes::of_ray(on_ray(places).into_iter());
    let told = tally
        .examples
        .iter()
        .filter(|((_, finding), _)| !finding.is_failure());
    let counted = told.map(|(key, examples)| {
        let places = &examples.first[..examples.first.len().min(most)];
        let rays = places.chunk_by(|a, b| a.index == b.index);
        let causes = rays.map(of_ray).fold(Causes::default(), Causes::merged);
        let worst = examples
            .worst
            .and_then(|(_, place)| on_ray(&[place]).remove(0));
        (key, Causes { worst, ..causes })
    });
    if most == 0 {
        BTreeMap::new()
    } else {
        counted.collect()
    }
}
