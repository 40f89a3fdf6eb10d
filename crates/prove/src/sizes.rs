//! The bound of one gate by the size of the triangle: how far an epsilon carries, and each triangle's own
//! bound in a mesh.

use super::summary::{format_of, paths_of};
use super::{Domain, Dyadic, Format, Proof, Quantity};
use crate::kernel::{Entry, Path, Scalar};
use std::collections::HashMap;

/// Sizes per binary order: 64 of them, each just below a multiple of a 64th, because the errors of sums
/// double at powers of two.
const STEPS: i32 = 64;
/// Sizes from 2^-60 to 2^60.
const ORDERS: i32 = 60;

/// The bounds of one gate for triangles of different sizes.
#[derive(Debug)]
pub struct BySize {
    paths: Vec<Path>,
    gate: usize,
    known: HashMap<i32, Option<Dyadic>>,
    format: Format,
}

impl BySize {
    /// For a gate in a scalar; none of a kernel without a program.
    pub fn new<F: Scalar>(entry: &Entry, gate: usize) -> Option<BySize> {
        let paths = paths_of::<F>(entry).ok()?;
        Some(BySize {
            paths,
            gate,
            known: HashMap::new(),
            format: format_of::<F>(),
        })
    }

    /// The bound where coordinates of edges and of vectors from the origin are at most a size, rounded up to the
    /// next of the sizes that are tried; none if there is no bound or the size is out of range.
    pub fn bound(&mut self, size: f64) -> Option<Dyadic> {
        if !(size > 0.0 && size < 2f64.powi(ORDERS)) {
            return None;
        }
        let order = (size.log2().floor() as i32).max(-ORDERS);
        let in_order = size / 2f64.powi(order);
        // The smallest step whose size is not below.
        let mut place = order * STEPS + (f64::from(STEPS) * (in_order - 1.0)).floor() as i32 - 1;
        while size_of(place).to_f64() < size {
            place += 1;
        }
        self.at(place)
    }

    /// The largest size at which the bound is below an epsilon of the scalar.
    pub fn largest(&mut self, epsilon: f64) -> Option<Dyadic> {
        let epsilon = Dyadic::from_f64(epsilon)?;
        let mut holds = |place: i32| self.at(place).is_some_and(|bound| bound < epsilon);
        let mut low = -ORDERS * STEPS;
        let mut high = ORDERS * STEPS;
        if !holds(low) {
            return None;
        }
        while high - low > 1 {
            let middle = (low + high).div_euclid(2);
            if holds(middle) {
                low = middle
            } else {
                high = middle
            }
        }
        Some(size_of(low))
    }

    fn at(&mut self, place: i32) -> Option<Dyadic> {
        if let Some(known) = self.known.get(&place) {
            return *known;
        }
        let size = size_of(place);
        let domain = Domain {
            edge: size,
            reach: size,
            world: size,
            ..Domain::UNIT
        };
        let proof = Proof::new(self.paths.clone(), Some(self.gate), domain, self.format);
        let quantity = proof.gate(self.gate).and_then(Result::ok);
        let bound = quantity.and_then(Quantity::error);
        self.known.insert(place, bound);
        bound
    }
}

/// The size of a step: (513..=1023)/1024 times a power of two; the bits of a domain stay few.
fn size_of(place: i32) -> Dyadic {
    let step = place.rem_euclid(STEPS);
    Dyadic::new(
        i128::from(1023 - 8 * (STEPS - 1 - step)),
        place.div_euclid(STEPS) - 9,
    )
}
