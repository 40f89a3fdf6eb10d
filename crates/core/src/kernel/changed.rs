//! A kernel with a small change around it, under a name such as `moller-trumbore+sorted`: what a program can mend without
//! writing its kernel anew.

use super::{Gate, Gated, KernelIn, Role, Verdict};
use crate::arith::Float;
use crate::case::{Case, Triangle};
use crate::truth::Facing;
use std::cmp::Ordering;
use std::slice;

named! {
    pub names
    /// A change to a kernel's call or to the comparison of its epsilons.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum Change {
        /// Epsilons are multiplied by the sizes of the triangle and of the direction, as often as their numbers' units are.
        BySize = "by-size",
        /// The vertices are put in order (by x, then y, then z) before the call, so that neighbours start alike.
        Sorted = "sorted",
        /// A hit before t = 0 is a miss.
        Ahead = "ahead",
        /// Floats are computed by the kernel in double; t, u and v are rounded at the end.
        Double = "double",
        /// Where the number that decides at an edge is exactly 0, the kernel's answer in double counts, as in Woop's fallback.
        Fallback = "fallback",
    }
}

/// A kernel in some scalar with a change that stays in it: not [`Change::Double`], nor [`Change::Fallback`].
pub(super) struct Changed<F: Float> {
    pub change: Change,
    pub gates: &'static [Gate],
    pub kernel: &'static dyn KernelIn<F>,
}

/// The largest size of some coordinates.
fn largest<F: Float>(coordinates: impl IntoIterator<Item = F>) -> F {
    coordinates.into_iter().fold(
        F::zero(),
        |most, x| if most < x.abs() { x.abs() } else { most },
    )
}

/// True if [`Change::BySize`] changes the epsilon of a gate.
pub fn has_size(gate: &Gate) -> bool {
    gate.dimension.has_unit() && matches!(gate.role, Role::Parallel | Role::Edge)
}

/// The refusal of a gate, with an epsilon for its `e`.
pub fn refuses_at(refuses: &str, epsilon: &str) -> String {
    let ends_word = |c: char| !c.is_alphanumeric() && c != '_';
    refuses
        .split_inclusive(ends_word)
        .fold(String::new(), |text, word| {
            match (
                word.strip_prefix('e')
                    .filter(|end| end.chars().all(ends_word)),
                text.strip_suffix('-'),
            ) {
                // -(-1e-6), -0
                (Some(end), Some(text)) if epsilon.starts_with('-') || epsilon == "0" => {
                    [text, epsilon.trim_start_matches('-'), end].concat()
                }
                (Some(end), _) => [&text, epsilon, end].concat(),
                (None, _) => [&text, word].concat(),
            }
        })
}

/// The gates of [`Change::BySize`], whose texts have the sizes: `e*L*L*D`.
pub(super) fn sized(gates: &[Gate]) -> &'static [Gate] {
    let power = |name: &str, times: i8| name.repeat(times.max(0) as usize);
    let sized = |gate: &Gate| {
        let Gate {
            refuses, dimension, ..
        } = *gate;
        let sizes = power("*L", dimension.length) + &power("*D", dimension.direction);
        let refuses = match (has_size(gate), gate.role) {
            (false, _) => refuses,
            (true, Role::Parallel) => {
                String::leak(refuses_at(refuses, &format!("max(e{sizes}, TINY)")))
            }
            (true, _) => String::leak(refuses_at(refuses, &format!("e{sizes}"))),
        };
        Gate { refuses, ..*gate }
    };
    Vec::leak(gates.iter().map(sized).collect())
}

impl<F: Float> Changed<F> {
    /// Epsilons times L, the largest coordinate of b-a and c-a, and D, that of the direction, as often as the gate's
    /// dimension says. Where that is 0, an epsilon for parallel rays is TINY, the least positive float: else it would let a
    /// determinant of 0 through, and what is divided by it.
    fn by_size(&self, case: &Case<F>, epsilons: &mut [F]) {
        let [_, direction, a, b, c] = case.vectors();
        let length = largest((0..3).flat_map(|i| [b[i] - a[i], c[i] - a[i]]));
        let direction = largest(direction);
        for (gate, epsilon) in self
            .gates
            .iter()
            .zip(epsilons)
            .filter(|(gate, _)| has_size(gate))
        {
            let refuses_zero = gate.role == Role::Parallel && F::zero() < *epsilon;
            (0..gate.dimension.length).for_each(|_| *epsilon = *epsilon * length);
            (0..gate.dimension.direction).for_each(|_| *epsilon = *epsilon * direction);
            if refuses_zero && *epsilon == F::zero() {
                *epsilon = F::zero().offset_ulps(1);
            }
        }
    }
}

/// Which vertices stand first, second and third once they are in order.
fn order<F: Float>(vertices: [[F; 3]; 3]) -> [usize; 3] {
    let mut order = [0, 1, 2];
    order.sort_by(|i, j| {
        vertices[*i]
            .partial_cmp(&vertices[*j])
            .unwrap_or(Ordering::Equal)
    });
    order
}

/// The answer about vertices in another order, said of them as they were.
fn renamed<F: Float>(verdict: &mut Verdict<F>, order: [usize; 3]) {
    let mut weights = [F::zero(); 3];
    let of_first = F::one() - verdict.u - verdict.v;
    order
        .iter()
        .zip([of_first, verdict.u, verdict.v])
        .for_each(|(i, x)| weights[*i] = x);
    if order != [0, 1, 2] {
        (verdict.u, verdict.v) = (weights[1], weights[2]);
    }
    let is_even = (order[0] + 1) % 3 == order[1];
    verdict.facing = match (verdict.facing, is_even) {
        (Some(Facing::Front), false) => Some(Facing::Back),
        (Some(Facing::Back), false) => Some(Facing::Front),
        (facing, _) => facing,
    };
}

impl<F: Float> KernelIn<F> for Changed<F> {
    fn run(&self, cases: &[Case<F>], epsilons: &[F], verdicts: &mut [Verdict<F>]) {
        let mut sized = epsilons.to_vec();
        for (case, verdict) in cases.iter().zip(verdicts) {
            let place = slice::from_mut(verdict);
            match self.change {
                Change::BySize => {
                    sized.copy_from_slice(epsilons);
                    self.by_size(case, &mut sized);
                    self.kernel.run(&[*case], &sized, place);
                }
                Change::Sorted => {
                    let vertices = case.triangle.vertices();
                    let order = order(vertices.map(Into::into));
                    let [a, b, c] = order.map(|i| vertices[i]);
                    let case = Case {
                        ray: case.ray,
                        triangle: Triangle { a, b, c },
                    };
                    self.kernel.run(&[case], epsilons, place);
                    renamed(verdict, order);
                }
                // The others are not of this type.
                Change::Ahead | Change::Double | Change::Fallback => {
                    self.kernel.run(slice::from_ref(case), epsilons, place);
                    if verdict.t < F::zero() {
                        *verdict = Verdict::miss(None);
                    }
                }
            }
        }
    }
}

/// A kernel for floats that computes in double.
pub(super) struct InDouble(pub &'static dyn KernelIn<f64>);

impl KernelIn<f32> for InDouble {
    fn run(&self, cases: &[Case<f32>], epsilons: &[f32], verdicts: &mut [Verdict<f32>]) {
        let epsilons: Vec<f64> = epsilons.iter().map(|x| f64::from(*x)).collect();
        for (case, verdict) in cases.iter().zip(verdicts) {
            let mut found = [Verdict::miss(None)];
            self.0.run(&[case.widen()], &epsilons, &mut found);
            let [
                Verdict {
                    hit,
                    refused_by,
                    facing,
                    t,
                    u,
                    v,
                    failure,
                },
            ] = found;
            let [t, u, v] = [t, u, v].map(|x| x as f32);
            *verdict = Verdict {
                hit,
                refused_by,
                facing,
                t,
                u,
                v,
                failure,
            };
        }
    }
}

/// A kernel for floats that answers in double where the number that decides at an edge is exactly 0.
pub(super) struct WithFallback {
    pub kernel: &'static dyn KernelIn<f32>,
    pub gated: &'static dyn Gated<f32>,
    pub in_double: InDouble,
}

impl KernelIn<f32> for WithFallback {
    fn run(&self, cases: &[Case<f32>], epsilons: &[f32], verdicts: &mut [Verdict<f32>]) {
        self.kernel.run(cases, epsilons, verdicts);
        let gates = self.gated.info().gates;
        for (case, verdict) in cases.iter().zip(verdicts) {
            let margins = self.gated.thresholds(case);
            let mut edges = gates
                .iter()
                .zip(margins)
                .filter(|(gate, _)| gate.role == Role::Edge);
            if edges.any(|(_, margin)| margin == 0.0) {
                self.in_double
                    .run(slice::from_ref(case), epsilons, slice::from_mut(verdict));
            }
        }
    }
}
