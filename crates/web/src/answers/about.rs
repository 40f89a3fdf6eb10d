//! The choices: kernels, families, scenes, contracts.

use hairline::ScalarName;
use hairline::internals::case::SCENES;
use hairline::internals::corpus::lines::bare_case;
use hairline::internals::family::FAMILIES;
use hairline::internals::kernel::{KERNELS, Tunable};
use hairline::internals::map::{Ink, Spot};
use hairline::{Float, NAMED};
use serde::Serialize;
use std::collections::BTreeMap;

#[derive(Serialize)]
pub struct About {
    kernels: Vec<KernelPart>,
    families: Vec<[&'static str; 2]>,
    scenes: Vec<&'static str>,
    contracts: Vec<[&'static str; 2]>,
    /// The colours of a map, by number.
    inks: Vec<String>,
    /// By scalar: the standard cases of maps as JSON.
    spots: BTreeMap<ScalarName, Vec<(&'static str, String)>>,
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
            (
                gate.name,
                gate.refuses,
                *value,
                gate.epsilon == Tunable::Signed,
            )
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
        families: FAMILIES
            .iter()
            .map(|family| [family.name, family.promise])
            .collect(),
        scenes: SCENES.iter().map(|preset| preset.name).collect(),
        contracts: NAMED
            .iter()
            .map(|named| [named.name, named.about])
            .collect(),
        spots: [(f32::NAME, spots::<f32>()), (f64::NAME, spots::<f64>())].into(),
        inks: Ink::ALL.map(|ink| ink.name().to_owned()).to_vec(),
    }
}

fn spots<F: Float>() -> Vec<(&'static str, String)> {
    Spot::ALL
        .map(|spot| (spot.name(), bare_case(spot.case::<F>())))
        .to_vec()
}
