//! A slab test as it is run: with epsilons and a contract.

use crate::case::Boxes;
use hairline_core::kernel::{Entry, EpsilonText, Tunable};
use hairline_core::{Contract, EpsilonSet, Float, Gate};

/// A slab test with one epsilon a gate, judged by a contract.
#[derive(Clone)]
pub struct Setup {
    /// The slab test.
    pub entry: &'static Entry<Boxes>,
    /// The name of its epsilons: that of a published set, or `own`.
    pub set: &'static str,
    /// Its epsilons, one a gate.
    pub values: Vec<EpsilonText>,
    /// The promise that it is judged by.
    pub contract: Contract,
}

impl std::fmt::Debug for Setup {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{} ({})", self.entry.info.name, self.set)
    }
}

impl Setup {
    /// A slab test in each of its published epsilons, by its own contract.
    pub fn published(entry: &'static Entry<Boxes>) -> Vec<Setup> {
        let setup = |set: &EpsilonSet| {
            let values = set.values.iter().map(|text| EpsilonText::of(text));
            Some(Setup {
                entry,
                set: set.name,
                values: values.collect::<Option<_>>()?,
                contract: entry.info.contract,
            })
        };
        entry.info.epsilon_sets.iter().filter_map(setup).collect()
    }

    /// This setup with another epsilon at a gate. An error if it has no such gate, or the gate takes no such epsilon.
    pub fn with(mut self, gate: &str, value: EpsilonText) -> Result<Setup, String> {
        let name = self.entry.info.name;
        let Some(place) = self.gates().iter().position(|it| it.name == gate) else {
            let names: Vec<&str> = self.gates().iter().map(|gate| gate.name).collect();
            return Err(format!(
                "{name} has no gate '{gate}'; it has {}",
                names.join(", ")
            ));
        };
        if self.gates()[place].epsilon == Tunable::Fixed {
            return Err(format!("gate '{gate}' of {name} takes no epsilon"));
        }
        if value.value::<f64>().is_none() {
            return Err(format!(
                "'{value}' is not a finite epsilon for gate '{gate}'"
            ));
        }
        self.values[place] = value;
        self.set = "own";
        Ok(self)
    }

    /// This setup, judged by another contract.
    pub fn judged_by(self, contract: Contract) -> Setup {
        Setup { contract, ..self }
    }

    /// The gates of the slab test.
    pub fn gates(&self) -> &'static [Gate] {
        self.entry.info.gates
    }

    /// The epsilons in a scalar; none if one is not a finite number of it.
    pub fn epsilons<F: Float>(&self) -> Option<Vec<F>> {
        self.values.iter().map(EpsilonText::value).collect()
    }
}
