//! The corners of a formula's box that are enough: those that differ by more than a mirror.
//!
//! A *mirror* is a set of variables whose change of sign keeps each step or changes its sign. Then each slope keeps its
//! size too, and so do all effects of errors: of corners that a mirror joins, one is enough. In d·(e1×e2), for instance,
//! the signs of d, of e1, of e2 and of all x and all y are free: 16 corners of 512 are left.
//!
//! A step's sign depends on a set of variables: it changes with an odd number of them. A product's set is the symmetric
//! difference of its factors' sets. Terms that are added up must have one set: for mirrors, the difference of two of them
//! is an equation modulo 2. A zero has no sign, is computed as 0 and demands nothing.

use super::formula::{Formula, Step};
use crate::arith::recorded::{Operation, Term};

impl Formula {
    /// The variables whose signs have to be tried, as bits: the lowest one of each independent equation. Every corner
    /// is joined to one of them by a mirror, which is the first in the order of counting. Signs of unit vectors are
    /// not tried.
    pub(super) fn signs_to_try(&self) -> u64 {
        let mut equations = Equations {
            unit: set_of(&self.unit),
            by_lowest: [0; 64],
        };
        // Its two ends are no mirror images.
        let fixed = self.below.map_or(0, |(v, _)| 1 << v);
        let mut signs: Vec<Option<u64>> = Vec::new();
        for step in &self.steps {
            let term = |(_, a, b): Term<usize>| {
                let right = b.map_or(Some(0), |b: usize| signs[b]);
                Some(signs[a]? ^ right?)
            };
            let sign = match step {
                Step::Variables(sum) => {
                    equations.alike(sum.iter().map(|(v, _)| Some(1 << v & !fixed)))
                }
                Step::Of(Operation::Number(0)) => None,
                Step::Of(Operation::Number(_)) => Some(0),
                Step::Of(_) => equations.alike(step.terms().map(term)),
            };
            signs.push(sign);
        }
        (fixed | equations.decided()) & !equations.unit
    }
}

/// Independent equations modulo 2, each at its lowest variable, those of the unit vector coming first.
struct Equations {
    unit: u64,
    by_lowest: [u64; 64],
}

impl Equations {
    /// Demands that terms change their signs alike. Returns with which variables they do, if not all are zero.
    fn alike(&mut self, terms: impl IntoIterator<Item = Option<u64>>) -> Option<u64> {
        let mut terms = terms.into_iter().flatten();
        let first = terms.next()?;
        for term in terms {
            self.insert(term ^ first);
        }
        Some(first)
    }

    /// The variables that the equations decide about, as bits.
    fn decided(&self) -> u64 {
        let mut decided = 0;
        for (v, equation) in self.by_lowest.iter().enumerate() {
            if *equation != 0 {
                decided |= 1 << v;
            }
        }
        decided
    }

    fn insert(&mut self, mut equation: u64) {
        while equation != 0 {
            let first = if equation & self.unit == 0 {
                equation
            } else {
                equation & self.unit
            };
            let known = &mut self.by_lowest[first.trailing_zeros() as usize];
            if *known == 0 {
                *known = equation;
                return;
            }
            equation ^= *known;
        }
    }
}

fn set_of(variables: &[usize]) -> u64 {
    variables.iter().fold(0, |set, v| set | 1 << v)
}
