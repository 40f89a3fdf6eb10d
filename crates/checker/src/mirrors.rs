//! Mirror images of corners, of which one is enough: the variables whose signs have to be tried.

use super::corners::{Row, set_of};
use num_traits::Zero;

/// Equations modulo 2 about a set of variables, each a set too: it has an even number of them in common with the first.
/// An equation stands at its lowest variable, and no other equation has it as its lowest one.
struct Equations {
    known: [usize; usize::BITS as usize],
    of_unit: usize,
}

impl Equations {
    /// Adds an equation, less those that are known, so that its lowest variable is a new one. If nothing is left of it,
    /// it follows from the others.
    fn add(&mut self, mut equation: usize) {
        while equation != 0 {
            let lowest = self.lowest(equation);
            let known = &mut self.known[lowest];
            if *known == 0 {
                *known = equation;
                return;
            }
            equation ^= *known;
        }
    }

    /// The variable that an equation decides about. The unit vector's coordinates have no signs to try, so they come first.
    fn lowest(&self, equation: usize) -> usize {
        let mut candidates = equation & self.of_unit;
        if candidates == 0 {
            candidates = equation;
        }
        candidates.trailing_zeros() as usize
    }

    /// The variables that the equations decide about.
    fn decided(&self) -> usize {
        let mut decided = 0;
        for (variable, equation) in self.known.iter().enumerate() {
            if *equation != 0 {
                decided |= 1 << variable;
            }
        }
        decided
    }
}

/// The variables whose signs are tried, as bits: see "Mirrors" in the guide's "Formulas without divisions".
///
/// A mirror is a set of variables whose change of sign keeps each step or changes its sign. It keeps the size of each
/// step and of each effect, so of the corners that it joins the first is enough. The summands of one step must change
/// alike: this is an equation, modulo 2, of the set's bits. Each equation decides about its lowest variable and the
/// others are free, so a mirror can make each free variable positive. The ends of a `fixed` variable are no mirror
/// images, so both are tried, and it is in no equation.
pub fn signs_to_try<T: Zero>(rows: &[Row<T>], unit: &[usize], fixed: usize) -> usize {
    let of_unit = set_of(unit);
    let mut equations = Equations {
        known: [0; usize::BITS as usize],
        of_unit,
    };
    let mut signs: Vec<Option<usize>> = Vec::new();
    for row in rows {
        let summands = signs_of_summands(row, &signs, fixed);
        let first = summands.first().copied();
        for summand in &summands {
            equations.add(summand ^ first.unwrap_or(0));
        }
        signs.push(first);
    }
    (fixed | equations.decided()) & !of_unit
}

/// For each summand of a step that is not zero, the variables on whose signs its sign depends.
///
/// A step without a summand is zero, and computed as 0. It has no error, whatever its weight, and demands nothing.
fn signs_of_summands<T: Zero>(row: &Row<T>, above: &[Option<usize>], fixed: usize) -> Vec<usize> {
    let mut signs = Vec::new();
    if !row.constant.is_zero() {
        signs.push(0);
    }
    for multiple in &row.variables {
        signs.push((1 << multiple.variable) & !fixed);
    }
    for product in &row.products {
        let left = above[product.left];
        let right = match product.right {
            Some(right) => above[right],
            None => Some(0),
        };
        if let (Some(left), Some(right)) = (left, right) {
            signs.push(left ^ right);
        }
    }
    signs
}
