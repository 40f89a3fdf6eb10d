//! Which gate of a kernel is there to refuse which cases.

use crate::contract::{Contract, Extent, Sides};
use crate::judge::Class;
use crate::kernel::{Gate, Tunable};

/// Which cases that must be missed a gate is there to refuse.
///
/// A gate on t guards the ends of the extent; a gate on the determinant or on n·d guards rays
/// parallel to the plane and triangles without area, and with a sign the side as well; edge gates
/// guard everything else, and whatever has no gate of its own.
#[derive(Clone, Debug)]
pub struct Duty {
    /// By [`Class::number`].
    classes: [bool; Class::COUNT],
    guards_start: bool,
}

const PARALLEL: &str = "parallel";
const T: &str = "t";

impl Duty {
    /// Of one of a kernel's gates under a contract.
    pub fn of(gates: &[Gate], gate: usize, contract: &Contract) -> Duty {
        let has = |name: &str| gates.iter().any(|gate| gate.name == name);
        let culls =
            gates.iter().any(|gate| gate.name == PARALLEL && gate.epsilon == Tunable::Signed);
        let name = gates[gate].name;
        let mut classes = [false; Class::COUNT];
        for class in Class::all() {
            let off_the_ends = class.is_off_the_interval() && contract.extent != Extent::Line;
            let from_behind = class.is_back() && contract.sides == Sides::Front;
            let within = !class.is_flat() && !off_the_ends && !from_behind;
            // Inside the triangle nothing must be missed but what lies on an open end.
            let at_an_end = within && class.part() == "interior" && contract.extent != Extent::Line;
            let outside = within && class.part() != "interior" || class.part() == "outside";
            classes[class.number()] = match name {
                PARALLEL => class.is_flat() || from_behind && culls,
                T => off_the_ends || at_an_end,
                _ => {
                    outside
                        || class.is_flat() && !has(PARALLEL)
                        || (off_the_ends || at_an_end) && !has(T)
                        || from_behind && !culls
                }
            };
        }
        let guards_start = gates[gate].guards_start() && contract.extent != Extent::Line;
        Duty { classes, guards_start }
    }

    /// Whether the gate guards a class.
    pub fn guards(&self, class: Class) -> bool {
        self.classes[class.number()]
    }

    /// Whether it is there to keep a ray from hitting the triangle that it starts on.
    pub fn guards_start(&self) -> bool {
        self.guards_start
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kernel::find;

    fn guarded(kernel: &str, gate: &str) -> Vec<String> {
        let info = find(kernel).unwrap().info;
        let gate = info.gates.iter().position(|known| known.name == gate).unwrap();
        let duty = Duty::of(info.gates, gate, &info.contract);
        Class::all().filter(|class| duty.guards(*class)).map(Class::name).collect()
    }

    #[test]
    fn each_class_is_guarded_by_the_gate_that_asks_about_it() {
        let flat = ["parallel", "coplanar", "degenerate"];
        assert_eq!(guarded("moller-trumbore", "parallel"), flat);
        assert!(guarded("plane-inside-out", "t").contains(&"interior/front/before".to_owned()));
        assert!(!guarded("plane-inside-out", "t").contains(&"outside/front/within".to_owned()));
        let at_an_open_end = "interior/front/within".to_owned();
        assert!(guarded("plane-inside-out", "t").contains(&at_an_open_end));
        assert!(!guarded("plane-inside-out", "edge").contains(&at_an_open_end));
        assert!(guarded("plane-inside-out", "edge").contains(&"outside/back/before".to_owned()));
        // Culling by the determinant's sign; by the edges' where there is no determinant.
        let culled = "interior/back/within".to_owned();
        assert!(guarded("moller-trumbore-culling", "parallel").contains(&culled));
        assert!(guarded("scalar-triple", "edge").contains(&culled));
        assert!(
            flat.iter()
                .all(|class| guarded("scalar-triple", "edge").contains(&(*class).to_owned()))
        );
    }
}
