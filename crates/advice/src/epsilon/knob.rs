//! The knobs of a kernel, which can be set: its gates' epsilons, and the least t that counts.

use crate::audit::Row;
use crate::contract::{Contract, Extent};
use crate::kernel::{Dimension, Gate, Role, Tunable};

/// The most knobs of a study: it weighs them jointly.
pub const MOST_KNOBS: usize = 3;

/// The largest epsilon of each knob at which one triangle is accepted; +inf beyond the last knob.
pub type KnobMargins<F> = [F; MOST_KNOBS];

/// By knob: if it is there to refuse a ray.
pub(super) type Guards = [bool; MOST_KNOBS];

/// One number that can be chosen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Knob {
    /// The epsilon of the gate at this place of the kernel's chain.
    Gate(usize),
    /// The least t that counts as a hit: the interval's start, or a comparison of the caller's.
    LeastT,
}

/// The name of [`Knob::LeastT`].
pub const LEAST_T: &str = "t_min";

impl Knob {
    /// All knobs of a kernel under a contract. A gate on t is one if its epsilon is a t and the kernel takes
    /// no interval; otherwise the least t is, if the kernel reports t.
    pub fn all(row: &Row) -> Vec<Knob> {
        let info = row.entry.info;
        let is_t = |gate: &Gate| gate.dimension == Dimension::new(1, -1);
        let has_interval = row.contract.extent == Extent::Interval;
        let (mut knobs, mut guards_start) = (Vec::new(), false);
        for (place, gate) in info.gates.iter().enumerate() {
            let tunable = gate.epsilon != Tunable::Fixed;
            let usable = gate.role != Role::T || is_t(gate) && !has_interval;
            if tunable && usable {
                guards_start |= gate.role == Role::T;
                knobs.push(Knob::Gate(place));
            }
        }
        if !guards_start && info.gives.t {
            knobs.push(Knob::LeastT);
        }
        knobs
    }

    /// The gate; a least t is like one on t.
    pub fn gate(self, gates: &[Gate]) -> Gate {
        match self {
            Knob::Gate(gate) => gates[gate],
            Knob::LeastT => Gate {
                name: LEAST_T,
                role: Role::T,
                refuses: "t < e",
                printed: None,
                dimension: Dimension::new(1, -1),
                epsilon: Tunable::NonNegative,
            },
        }
    }

    /// True if values below zero mean anything. A negative least t only adds hits behind the origin.
    pub fn takes_negative(self, gates: &[Gate]) -> bool {
        let gate = self.gate(gates);
        gate.epsilon == Tunable::Signed && gate.role != Role::T
    }
}

/// The contract in a scene: with a least t, a kernel that is judged on the whole line is judged on the ray.
pub fn contract_with(knobs: &[Knob], contract: &Contract) -> Contract {
    let on_line = contract.extent == Extent::Line && knobs.contains(&Knob::LeastT);
    let extent = if on_line {
        Extent::Ray
    } else {
        contract.extent
    };
    Contract {
        extent,
        ..*contract
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::audit::EpsilonChoice;
    use crate::kernel::KERNELS;

    #[test]
    fn each_kernel_has_the_knobs_that_a_caller_can_turn() {
        let of = |kernel: &str| {
            let entry = crate::kernel::find(kernel).unwrap();
            let row = &EpsilonChoice::Source.rows(&[entry], None).unwrap()[0];
            let gates = entry.info.gates;
            Knob::all(row)
                .into_iter()
                .map(|knob| knob.gate(gates).name)
                .collect::<Vec<_>>()
        };
        assert_eq!(of("moller-trumbore"), ["parallel", "edge", "t_min"]);
        assert_eq!(of("plane-unit-normal"), ["parallel", "t", "edge"]);
        assert_eq!(of("woop-watertight"), ["edge", "parallel", "t_min"]);
        assert_eq!(of("cramer"), ["parallel", "edge", "t_min"]);
        assert_eq!(of("havel-herout"), ["t_min"]);
        assert_eq!(of("scalar-triple"), ["edge"]);
        for entry in KERNELS {
            assert!(
                (1..=MOST_KNOBS).contains(&of(entry.info.name).len()),
                "{}",
                entry.info.name
            );
        }
    }

    #[test]
    fn values_below_zero_mean_something_where_the_gate_takes_them_and_is_not_on_t() {
        let gate = |role, epsilon| {
            let dimension = Dimension::new(1, 0);
            Gate {
                name: "gate",
                role,
                refuses: "",
                printed: None,
                dimension,
                epsilon,
            }
        };
        let gates = [
            gate(Role::Edge, Tunable::Signed),
            gate(Role::Edge, Tunable::NonNegative),
            gate(Role::T, Tunable::Signed),
        ];
        let knobs = [Knob::Gate(0), Knob::Gate(1), Knob::Gate(2), Knob::LeastT];
        let negative = knobs.map(|knob| knob.takes_negative(&gates));
        assert_eq!(negative, [true, false, false, false]);
        assert_eq!(
            knobs.map(|knob| knob.gate(&gates).role),
            [Role::Edge, Role::Edge, Role::T, Role::T]
        );
        assert_eq!(Knob::LeastT.gate(&gates).dimension, Dimension::new(1, -1));
        assert_eq!(
            [Knob::Gate(0), Knob::LeastT].map(|knob| knob.gate(&gates).name),
            ["gate", "t_min"]
        );
    }

    #[test]
    fn a_least_t_makes_a_ray_of_a_line_and_of_nothing_else() {
        for (extent, knobs, expected) in [
            (
                Extent::Line,
                &[Knob::Gate(0), Knob::LeastT][..],
                Extent::Ray,
            ),
            (Extent::Line, &[Knob::Gate(0)], Extent::Line),
            (Extent::Interval, &[Knob::LeastT], Extent::Interval),
            (Extent::Ray, &[Knob::LeastT], Extent::Ray),
        ] {
            let contract = Contract {
                extent,
                ..Contract::CLOSED_RAY
            };
            let expected = Contract {
                extent: expected,
                ..contract
            };
            assert_eq!(contract_with(knobs, &contract), expected);
        }
    }
}
