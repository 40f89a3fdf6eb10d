//! A slab test as it is run: with epsilons and a contract.

use crate::case::Boxes;
use crate::kernel::KERNELS;
use hairline_core::kernel::{Entry, EpsilonText, Scalar, Subject, Tunable};
use hairline_core::{Contract, Float, Gate};
use std::fmt;

/// A slab test with one epsilon a gate, judged by a contract.
#[derive(Clone)]
pub struct Setup {
    /// The slab test.
    pub entry: &'static Entry<Boxes>,
    /// The name of its epsilons: that of a published set, or `given`.
    pub set: &'static str,
    /// Its epsilons, one a gate.
    pub values: Vec<EpsilonText>,
    /// The promise that it is judged by.
    pub contract: Contract,
}

impl fmt::Debug for Setup {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} ({})", self.entry.info.name, self.set)
    }
}

impl Setup {
    /// A slab test in each of its published epsilons, by its own contract.
    pub fn published(entry: &'static Entry<Boxes>) -> Vec<Setup> {
        let mut setups = Vec::new();
        for set in entry.info.epsilon_sets {
            let texts = set.values.iter();
            setups.push(Setup {
                entry,
                set: set.name,
                values: texts.filter_map(|text| EpsilonText::of(text)).collect(),
                contract: entry.info.contract,
            });
        }
        setups
    }

    /// This setup with another epsilon at a gate. An error if it has no such gate, or the gate takes no such epsilon.
    pub fn with(mut self, gate: &str, value: EpsilonText) -> Result<Setup, String> {
        let place = self.place(gate)?;
        if self.gates()[place].epsilon == Tunable::Fixed {
            let name = self.entry.info.name;
            return Err(format!("gate '{gate}' of {name} takes no epsilon"));
        }
        if value.value::<f64>().is_none() {
            return Err(format!(
                "'{value}' is not a finite epsilon for gate '{gate}'"
            ));
        }
        self.values[place] = value;
        self.set = "given";
        Ok(self)
    }

    /// This setup, judged by another contract.
    pub fn judged_by(self, contract: Contract) -> Setup {
        Setup { contract, ..self }
    }

    /// True if it is one of this crate's slab tests.
    pub fn is_built_in(&self) -> bool {
        let name = self.entry.info.name;
        let base = name.split('+').next();
        KERNELS.iter().any(|entry| Some(entry.info.name) == base)
    }

    /// The gates of the slab test.
    pub fn gates(&self) -> &'static [Gate] {
        self.entry.info.gates
    }

    /// The place of a gate among them. An error if there is no gate of this name.
    pub fn place(&self, gate: &str) -> Result<usize, String> {
        let mut gates = self.gates().iter();
        gates.position(|it| it.name == gate).ok_or_else(|| {
            let name = self.entry.info.name;
            format!("{name} has no gate '{gate}'")
        })
    }

    /// The slab test in a scalar. An error if it does not run in it.
    pub fn subject<F: Scalar>(&self) -> Result<&'static dyn Subject<F, Boxes>, String> {
        F::subject(self.entry).ok_or_else(|| {
            let name = self.entry.info.name;
            format!("{name} does not run in {}", F::NAME)
        })
    }

    /// The epsilons in a scalar; none if one is not a finite number of it, or there is not one a gate.
    pub fn epsilons<F: Float>(&self) -> Option<Vec<F>> {
        if self.values.len() != self.gates().len() {
            return None;
        }
        self.values.iter().map(EpsilonText::value).collect()
    }
}
