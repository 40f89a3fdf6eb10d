//! Which epsilon of a gate loses nothing: the growth of a far end, or the padding of a box.
//!
//! A margin says at once what a slab test does at every epsilon. So one run over the cases that must be hit finds the
//! largest epsilon that loses none of them, and a second one counts what it lets through that must be missed.

use crate::case::Boxes;
use crate::family::FamilyScalar;
use crate::judge::Obligation;
use crate::oracle::truth;
use crate::setup::Setup;
use crate::source::Source;
use hairline_core::engine::{Merge, Observer, sum};
use hairline_core::kernel::{KernelIn, Scalar};
use std::ops::Range;

/// How many cases go through at once.
const CHUNK: u64 = 1024;

/// A gate of a setup on a source of cases.
pub struct Question<'a> {
    /// The slab test; its other gates keep its epsilons.
    pub setup: &'a Setup,
    /// The gate whose epsilon is looked for.
    pub gate: &'a str,
    /// Where the cases come from.
    pub source: Source,
    /// How many there are.
    pub count: u64,
    /// Their seed.
    pub seed: u64,
}

/// The answer.
#[derive(Clone, Debug, PartialEq)]
pub struct Answer<F> {
    /// The cases that must be hit.
    pub must_hit: u64,
    /// The cases among them that are lost whatever this epsilon is: another gate refuses them, or a NaN or an infinity does.
    pub lost_anyway: u64,
    /// The others that are lost at an epsilon of 0.
    pub lost_at_zero: u64,
    /// The others that are lost at the setup's own epsilon.
    pub lost_at_own: u64,
    /// The largest epsilon that loses none of the others; none if there are no others.
    pub largest: Option<Largest<F>>,
    /// The cases that must be missed.
    pub must_miss: u64,
    /// The cases among them that are hit at an epsilon of 0.
    pub false_hits_at_zero: u64,
    /// The cases among them that are hit at the largest epsilon that loses nothing.
    pub false_hits_at_largest: u64,
}

/// An epsilon, and the case that allows no larger one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Largest<F> {
    /// The epsilon.
    pub epsilon: F,
    /// The index of the first case that is lost above it.
    pub index: u64,
}

/// The largest epsilon of a gate that loses nothing. An error if the slab test does not run in this scalar, or has no such
/// gate.
pub fn epsilon<F: FamilyScalar + Scalar>(
    question: &Question,
    observer: &dyn Observer,
) -> Result<Answer<F>, String> {
    let measured = Measured::<F>::new(question)?;
    let cases = 0..question.count;
    let add = |losses: &mut Losses<F>, indices| measured.each(indices, |case| losses.add(case));
    let losses = sum(cases.clone(), CHUNK, observer, Losses::default, add);
    let largest = losses.largest;
    let add = |hits: &mut FalseHits, indices| {
        measured.each(indices, |case| {
            hits.add(case, largest.map(|found| found.epsilon))
        });
    };
    let hits = sum(cases, CHUNK, observer, FalseHits::default, add);
    Ok(Answer {
        must_hit: losses.must_hit,
        lost_anyway: losses.lost_anyway,
        lost_at_zero: losses.lost_at_zero,
        lost_at_own: losses.lost_at_own,
        largest,
        must_miss: hits.must_miss,
        false_hits_at_zero: hits.at_zero,
        false_hits_at_largest: hits.at_largest,
    })
}

/// A setup that shows the margins of one of its gates.
struct Measured<'a, F: FamilyScalar> {
    question: &'a Question<'a>,
    subject: &'static dyn KernelIn<F, Boxes>,
    gate: usize,
    epsilons: Vec<F>,
}

/// A case with the margin of the gate.
struct MeasuredCase<F> {
    index: u64,
    obligation: Obligation,
    /// The largest epsilon at which it is hit; none if another gate refuses it.
    margin: Option<F>,
    /// The setup's own epsilon.
    own: F,
}

impl<'a, F: FamilyScalar + Scalar> Measured<'a, F> {
    fn new(question: &'a Question<'a>) -> Result<Measured<'a, F>, String> {
        let setup = question.setup;
        let not_a_number = || {
            let name = setup.entry.info.name;
            format!("an epsilon of {name} is not a number of {}", F::NAME)
        };
        Ok(Measured {
            question,
            subject: setup.subject()?,
            gate: setup.place(question.gate)?,
            epsilons: setup.epsilons().ok_or_else(not_a_number)?,
        })
    }

    fn each(&self, indices: Range<u64>, mut see: impl FnMut(&MeasuredCase<F>)) {
        let Question {
            setup,
            source,
            seed,
            ..
        } = *self.question;
        let first = indices.start;
        let cases = source.cases::<F>(seed, indices);
        let width = self.epsilons.len();
        let mut margins = vec![F::zero(); cases.len() * width];
        self.subject
            .margins(setup.entry.info, &cases, &mut margins, &mut []);
        for (place, (case, margins)) in cases.iter().zip(margins.chunks(width)).enumerate() {
            see(&MeasuredCase {
                index: first + place as u64,
                obligation: Obligation::new(&truth(case), &setup.contract),
                margin: self.margin(margins),
                own: self.epsilons[self.gate],
            });
        }
    }

    fn margin(&self, margins: &[F]) -> Option<F> {
        for (gate, margin) in margins.iter().enumerate() {
            if gate != self.gate && *margin < self.epsilons[gate] {
                return None;
            }
        }
        Some(margins[self.gate])
    }
}

/// The cases that must be hit.
#[derive(Default)]
struct Losses<F> {
    must_hit: u64,
    lost_anyway: u64,
    lost_at_zero: u64,
    lost_at_own: u64,
    largest: Option<Largest<F>>,
}

impl<F: FamilyScalar> Losses<F> {
    fn add(&mut self, case: &MeasuredCase<F>) {
        if case.obligation != Obligation::Hit {
            return;
        }
        self.must_hit += 1;
        let margin = case.margin.unwrap_or(-F::infinity());
        if margin == -F::infinity() {
            self.lost_anyway += 1;
            return;
        }
        self.lost_at_zero += u64::from(margin < F::zero());
        self.lost_at_own += u64::from(margin < case.own);
        let limit = Largest {
            epsilon: margin,
            index: case.index,
        };
        self.largest = match self.largest {
            Some(known) => Some(stricter(known, limit)),
            None => Some(limit),
        };
    }
}

/// The smaller epsilon of two; of equals that of the lower index.
fn stricter<F: FamilyScalar>(one: Largest<F>, other: Largest<F>) -> Largest<F> {
    let is_lower = other.epsilon < one.epsilon;
    let is_as_low = other.epsilon == one.epsilon;
    if is_lower || (is_as_low && other.index < one.index) {
        return other;
    }
    one
}

impl<F: FamilyScalar> Merge for Losses<F> {
    fn merge(&mut self, other: Losses<F>) {
        self.must_hit += other.must_hit;
        self.lost_anyway += other.lost_anyway;
        self.lost_at_zero += other.lost_at_zero;
        self.lost_at_own += other.lost_at_own;
        self.largest = self
            .largest
            .into_iter()
            .chain(other.largest)
            .reduce(stricter);
    }
}

/// The cases that must be missed.
#[derive(Default)]
struct FalseHits {
    must_miss: u64,
    at_zero: u64,
    at_largest: u64,
}

impl FalseHits {
    fn add<F: FamilyScalar>(&mut self, case: &MeasuredCase<F>, largest: Option<F>) {
        if case.obligation != Obligation::Miss {
            return;
        }
        self.must_miss += 1;
        let Some(margin) = case.margin else {
            return;
        };
        self.at_zero += u64::from(F::zero() <= margin);
        self.at_largest += u64::from(largest.is_some_and(|largest| largest <= margin));
    }
}

impl Merge for FalseHits {
    fn merge(&mut self, other: FalseHits) {
        self.must_miss += other.must_miss;
        self.at_zero += other.at_zero;
        self.at_largest += other.at_largest;
    }
}
