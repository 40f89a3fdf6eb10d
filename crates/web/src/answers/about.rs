//! What there is to choose: kernels, families, scenes, contracts.

use hairline::NAMED;
use hairline::internals::case::SCENES;
use hairline::internals::family::FAMILIES;
use hairline::internals::kernel::{KERNELS, Tunable};
use hairline::internals::map::Ink;
use serde::Serialize;

#[derive(Serialize)]
pub struct About {
    kernels: Vec<KernelPart>,
    families: Vec<[&'static str; 2]>,
    scenes: Vec<&'static str>,
    contracts: Vec<[&'static str; 2]>,
    /// The colours of a map, by number.
    inks: Vec<String>,
}

#[derive(Serialize)]
struct KernelPart {
    name: &'static str,
    source: &'static str,
    /// Gates that take an epsilon: name, comparison, the source's value, true if it may be negative.
    gates: Vec<(&'static str, &'static str, &'static str, bool)>,
    contract: String,
}

pub fn about() -> About {
    let kernel = |entry: &hairline::Entry| {
        let info = entry.info;
        let values = info.epsilon_sets.first().map_or(&[][..], |set| set.values);
        let gates = info.gates.iter().zip(values);
        let tuned = gates.filter(|(gate, _)| gate.epsilon != Tunable::Fixed);
        let part = |(gate, value): (&hairline::Gate, &&'static str)| {
            (gate.name, gate.refuses, *value, gate.epsilon == Tunable::Signed)
        };
        KernelPart {
            name: info.name,
            source: info.source,
            gates: tuned.map(part).collect(),
            contract: info.contract.describe(),
        }
    };
    About {
        kernels: KERNELS.iter().map(kernel).collect(),
        families: FAMILIES.iter().map(|family| [family.name, family.promise]).collect(),
        scenes: SCENES.iter().map(|preset| preset.name).collect(),
        contracts: NAMED.iter().map(|named| [named.name, named.about]).collect(),
        inks: Ink::ALL.map(Ink::hex).to_vec(),
    }
}
