//! The demands of `check` for proofs: `[proved]` in hairline.toml.

use super::super::exit::Failure;
use super::super::flags::{find_kernel, find_scalar};
use super::ensure_gate;
use crate::arith::ScalarName;
use crate::audit::Row;
use crate::kernel::{Entry, Role, Scalar};
use crate::prove::{Domain, Effort, Searched, Summary, Symmetry};
use crate::record::{Unproved, WATERTIGHT};

/// A demand, as `kernel/scalar/gate=17` (no bound above 17 u in the unit domain) or
/// `kernel/scalar/watertight=true`.
struct Demand<'a> {
    text: &'a str,
    entry: &'static Entry,
    scalar: ScalarName,
    gate: &'a str,
    value: &'a str,
    most: f64,
}

/// The demands that are not met, each with what is proved instead; or with how a plan's rows run the kernel, if that is
/// not what the proof is about.
pub fn unproved(demands: &[String], rows: &[Row]) -> Result<Vec<Unproved>, Failure> {
    let mut unproved = Vec::new();
    for text in demands {
        let demand = Demand::read(text)?;
        let why = in_named_scalar!(demand.scalar, F => demand.why_not::<F>());
        let why = why?.or_else(|| demand.run_otherwise(rows));
        let kernel = demand.entry.info.name;
        unproved.extend(why.map(|why| Unproved {
            kernel: kernel.to_owned(),
            scalar: demand.scalar,
            gate: demand.gate.to_owned(),
            demanded: demand.value.to_owned(),
            why,
            command: format!("hairline prove {}", demand.entry.selector()),
        }));
    }
    Ok(unproved)
}

impl Demand<'_> {
    fn read(text: &str) -> Result<Demand<'_>, Failure> {
        let wrong = || {
            Failure::usage(format!(
                "'{text}' is no demand: KERNEL/SCALAR/GATE=UNITS or KERNEL/SCALAR/watertight=true was expected"
            ))
        };
        let (what, value) = text.rsplit_once('=').ok_or_else(wrong)?;
        let [name, scalar, gate] = what
            .split('/')
            .collect::<Vec<_>>()
            .try_into()
            .map_err(|_| wrong())?;
        let entry = find_kernel(name)?;
        let scalar = find_scalar(scalar).map_err(|_| wrong())?;
        let most = match (gate, value) {
            (WATERTIGHT, "true") => 0.0,
            (WATERTIGHT, _) => return Err(wrong()),
            _ => value.parse().ok().filter(|x| *x > 0.0).ok_or_else(wrong)?,
        };
        if gate != WATERTIGHT {
            ensure_gate(entry, gate)?;
        }
        Ok(Demand {
            text,
            entry,
            scalar,
            gate,
            value,
            most,
        })
    }

    /// Why the proof says nothing about a plan that runs the kernel, if it does not.
    fn run_otherwise(&self, rows: &[Row]) -> Option<String> {
        let name = self.entry.info.name;
        let mut own = rows
            .iter()
            .filter(|row| row.entry.info.name == name)
            .peekable();
        if own.peek().is_none() {
            let is_variant = |row: &&Row| {
                row.entry
                    .info
                    .name
                    .strip_prefix(name)
                    .is_some_and(|rest| rest.starts_with('+'))
            };
            let variant = rows.iter().find(is_variant)?.entry.info.name;
            return Some(format!("the plan runs {variant} in its place"));
        }
        let is_refusing = |row: &&Row| {
            let gates = self.entry.info.gates.iter().zip(row.epsilons::<f64>());
            gates
                .into_iter()
                .any(|(gate, e)| gate.role == Role::Edge && 0.0 < e)
        };
        let row = own.find(|row| self.gate == WATERTIGHT && is_refusing(row))?;
        Some(format!("the plan runs it at {}, above 0", row.set))
    }

    /// Why a demand is not met, if it is not.
    fn why_not<F: Searched + Scalar>(&self) -> Result<Option<String>, Failure> {
        let summary = match Summary::<F>::new(self.entry, Domain::UNIT, &[], &[], Effort::NONE) {
            Ok(summary) => summary,
            Err(why) => return Ok(Some(format!("no proof: {why}"))),
        };
        if self.gate == WATERTIGHT {
            let proved = summary.symmetry == Symmetry::ExactSigns;
            return Ok((!proved).then(|| "no longer proved watertight".to_owned()));
        }
        let Some(gate) = summary
            .gates
            .iter()
            .find(|gate| gate.gate.name == self.gate)
        else {
            return Err(Failure::usage(format!(
                "'{}': this gate compares no number",
                self.text
            )));
        };
        Ok(match &gate.bound {
            Err(why) => Some(format!("no bound: {why}")),
            Ok(bound) => {
                let units = bound.to_f64() / summary.format.unit().to_f64();
                (units > self.most).then(|| format!("the bound is {units:.4} u"))
            }
        })
    }
}
