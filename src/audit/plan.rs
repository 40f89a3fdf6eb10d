//! What a run will do: rows of kernels with epsilons, sources of cases, a contract.

use super::source::Source;
use crate::arith::Float;
use crate::contract::{Contract, NAMED, NamedContract};
use crate::kernel::{Entry, Gate, PRESETS, Preset, PresetValue, Tunable, find, nearest_name};
use serde::{Deserialize, Serialize};
use std::fmt;

/// An epsilon before it is rounded to a scalar.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum EpsilonText {
    /// Decimal text, rounded to the nearest number of the scalar.
    Decimal(String),
    /// This many times the scalar's distance from 1 to the next number.
    MachineEpsilon(f64),
}

impl EpsilonText {
    /// In a scalar; none if the text is no finite number of it.
    pub fn value<F: Float>(&self) -> Option<F> {
        match self {
            EpsilonText::Decimal(text) => F::parse(text),
            EpsilonText::MachineEpsilon(factor) => Some(F::EPSILON * F::from_f64(*factor)),
        }
        .filter(F::is_finite)
    }

    /// In a scalar; none if it is too large there, or so small that it is 0.
    pub fn fitting<F: Float>(&self) -> Option<F> {
        self.value().filter(|value: &F| !value.is_zero() || self.is_zero())
    }

    /// Whether it is written as zero.
    fn is_zero(&self) -> bool {
        match self {
            EpsilonText::Decimal(text) => {
                let mut digits = text.chars().take_while(|c| !matches!(c, 'e' | 'E'));
                !digits.any(|c| matches!(c, '1'..='9'))
            }
            EpsilonText::MachineEpsilon(factor) => *factor == 0.0,
        }
    }

    /// `EPSILON`, `-EPSILON` or `k*EPSILON`; decimal text otherwise, not checked. None if k is no number.
    fn of(text: &str) -> Option<EpsilonText> {
        let Some(factor) = text.strip_suffix("EPSILON") else {
            return Some(EpsilonText::Decimal(text.to_owned()));
        };
        Some(EpsilonText::MachineEpsilon(match factor.strip_suffix('*').unwrap_or(factor) {
            "" => 1.0,
            "-" => -1.0,
            factor => factor.parse().ok()?,
        }))
    }
}

impl fmt::Display for EpsilonText {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            EpsilonText::Decimal(text) => f.write_str(text),
            EpsilonText::MachineEpsilon(factor) if *factor == 1.0 => f.write_str("EPSILON"),
            EpsilonText::MachineEpsilon(factor) if (1e-3..1e6).contains(&factor.abs()) => {
                write!(f, "{factor}*EPSILON")
            }
            EpsilonText::MachineEpsilon(factor) => write!(f, "{factor:e}*EPSILON"),
        }
    }
}

/// A kernel with its epsilons: a row of every table.
#[derive(Clone)]
pub struct Row {
    /// The kernel.
    pub entry: &'static Entry,
    /// What its epsilons are called: `source`, `zero`, `parallel=1e-6`.
    pub set: String,
    /// One a gate.
    pub epsilons: Vec<EpsilonText>,
    /// The contract it is judged by.
    pub contract: Contract,
    /// The contract's name, if it is not the kernel's own.
    pub contract_name: Option<&'static str>,
}

impl Row {
    /// The row of a kernel, its epsilons as [`Row::epsilon_argument`] writes them (none: as the source
    /// has them), and a contract by name, `own` for the kernel's own.
    pub fn named(kernel: &str, epsilons: Option<&str>, contract: &str) -> Result<Row, PlanError> {
        let entry = find(kernel).ok_or_else(|| PlanError(format!("unknown kernel '{kernel}'")))?;
        let named = NAMED.iter().find(|named| named.name == contract);
        if named.is_none() && contract != "own" {
            return Err(PlanError(format!("unknown contract '{contract}'")));
        }
        let choice = match epsilons {
            Some(text) => EpsilonChoice::parse(text)?,
            None => EpsilonChoice::Source,
        };
        Ok(choice.rows(&[entry], named)?.swap_remove(0))
    }

    /// `kernel (set)`.
    pub fn label(&self) -> String {
        format!("{} ({})", self.entry.info.name, self.set)
    }

    /// An error if an epsilon is too large for a scalar, or so small that it is 0 there.
    pub fn check<F: Float>(&self) -> Result<(), PlanError> {
        for (gate, text) in self.tuned() {
            if text.fitting::<F>().is_some() {
                continue;
            }
            let wrong = if text.value::<F>().is_some() { "0 in" } else { "beyond the range of" };
            let (name, gate, scalar) = (self.entry.info.name, gate.name, F::NAME);
            return Err(PlanError(format!(
                "gate '{gate}' of {name}: {text} is {wrong} {scalar} (see --scalar)"
            )));
        }
        Ok(())
    }

    /// The same in `f32`, and in `f64`, each if it is chosen and the kernel runs in it.
    pub fn check_in(&self, scalars: [bool; 2]) -> Result<(), PlanError> {
        let [in_f32, in_f64] = self.entry.scalars();
        if scalars[0] && in_f32 {
            self.check::<f32>()?;
        }
        if scalars[1] && in_f64 {
            self.check::<f64>()?;
        }
        Ok(())
    }

    /// The epsilons in a scalar, one a gate; 0 for one that [`Row::check`] refuses.
    pub fn epsilons<F: Float>(&self) -> Vec<F> {
        self.epsilons.iter().map(|text| text.value().unwrap_or(F::zero())).collect()
    }

    /// The gates that take an epsilon, with theirs.
    pub fn tuned(&self) -> impl Iterator<Item = (&'static Gate, &EpsilonText)> {
        let gates = self.entry.info.gates.iter().zip(&self.epsilons);
        gates.filter(|(gate, _)| gate.epsilon != Tunable::Fixed)
    }

    /// The `--epsilon` argument that makes this row again; none if no gate takes an epsilon.
    pub fn epsilon_argument(&self) -> Option<String> {
        let words: Vec<String> =
            self.tuned().map(|(gate, text)| format!("{}={text}", gate.name)).collect();
        (!words.is_empty()).then(|| words.join(","))
    }
}

/// How a plan's epsilons are chosen.
#[derive(Clone, Debug)]
pub enum EpsilonChoice {
    /// As the sources have it; two rows where a source gives no value.
    Source,
    /// A published library's.
    Preset(String),
    /// `gate=value` pairs, the other gates as the source has them.
    Given(Vec<(String, String)>),
}

/// Kernels, sources and a contract.
pub struct Plan {
    /// The kernels with their epsilons.
    pub rows: Vec<Row>,
    /// The sources of cases.
    pub sources: Vec<Source>,
    /// Whether to run in `f32`, and in `f64`.
    pub scalars: [bool; 2],
    /// How many examples of each class of finding to keep, by index.
    pub examples: usize,
    /// How many findings of each class, the first by index, to attribute to a cause; and on how many
    /// indices of each source, evenly spread, to measure the values of right hits.
    pub attribute: usize,
}

/// Why a plan cannot be made; one line.
#[derive(Debug, PartialEq)]
pub struct PlanError(pub String);

impl fmt::Display for PlanError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for PlanError {}

impl EpsilonChoice {
    /// From `gate=value,...`; no gate twice.
    pub fn parse(text: &str) -> Result<EpsilonChoice, PlanError> {
        let pairs = text.split(',').map(|pair| {
            let (gate, value) = pair.split_once('=').ok_or_else(|| {
                PlanError(format!("'{pair}' is not GATE=VALUE, as parallel=1e-6"))
            })?;
            Ok((gate.trim().to_owned(), value.trim().to_owned()))
        });
        let pairs: Vec<(String, String)> = pairs.collect::<Result<_, PlanError>>()?;
        if let Some(i) = (1..pairs.len()).find(|&i| pairs[..i].iter().any(|p| p.0 == pairs[i].0)) {
            return Err(PlanError(format!("gate '{}' is given twice", pairs[i].0)));
        }
        Ok(EpsilonChoice::Given(pairs))
    }

    /// The rows of some kernels under this choice; a named contract overrides each kernel's own.
    pub fn rows(
        &self,
        entries: &[&'static Entry],
        named: Option<&'static NamedContract>,
    ) -> Result<Vec<Row>, PlanError> {
        let contract_name = named.map(|named| named.name);
        let mut rows = Vec::new();
        // Each given epsilon must reach a gate of some kernel.
        let missing = |(name, _): &(String, String)| Err(unknown_gate(name, entries));
        let mut applied: Vec<Result<(), PlanError>> = self.given().iter().map(missing).collect();
        for entry in entries {
            let contract = named.map_or(entry.info.contract, |named| named.contract);
            let decimals = |values: &[&str]| -> Vec<EpsilonText> {
                let text = |text: &&str| EpsilonText::of(text).expect("the kernel's own epsilons");
                values.iter().map(text).collect()
            };
            let sets = entry.info.epsilon_sets;
            match self {
                EpsilonChoice::Source => rows.extend(sets.iter().map(|set| Row {
                    entry,
                    set: set.name.to_owned(),
                    epsilons: decimals(set.values),
                    contract,
                    contract_name,
                })),
                EpsilonChoice::Preset(name) => {
                    let preset = find_preset(name)?;
                    let mut epsilons = decimals(sets[0].values);
                    if preset.entries.is_empty() {
                        epsilons.fill(EpsilonText::Decimal("0".to_owned()));
                    }
                    let mut fits = preset.entries.is_empty();
                    let mut taken = Vec::new();
                    for (gate, epsilon) in entry.info.gates.iter().zip(&mut epsilons) {
                        if let Some(found) = preset.entries.iter().find(|entry| entry.fits(gate)) {
                            *epsilon = found.value.into();
                            taken.push(gate.name);
                            fits = true;
                        }
                    }
                    if fits {
                        let set = if taken.is_empty() {
                            name.clone()
                        } else {
                            format!("{name}: {}", taken.join("+"))
                        };
                        rows.push(Row { entry, set, epsilons, contract, contract_name });
                    }
                }
                EpsilonChoice::Given(pairs) => {
                    let mut epsilons = decimals(sets[0].values);
                    let mut words = Vec::new();
                    for (i, (name, text)) in pairs.iter().enumerate() {
                        let Some(k) = entry.info.gates.iter().position(|gate| gate.name == name)
                        else {
                            continue;
                        };
                        match checked(entry.info.name, &entry.info.gates[k], text) {
                            Ok(epsilon) => {
                                epsilons[k] = epsilon;
                                applied[i] = Ok(());
                                words.push(format!("{name}={text}"));
                            }
                            // Another kernel may take it.
                            Err(error) if applied[i].is_err() => applied[i] = Err(error),
                            Err(_) => {}
                        }
                    }
                    let set =
                        if words.is_empty() { sets[0].name.to_owned() } else { words.join(",") };
                    rows.push(Row { entry, set, epsilons, contract, contract_name });
                }
            }
        }
        applied.into_iter().collect::<Result<(), PlanError>>()?;
        if rows.is_empty() {
            let EpsilonChoice::Preset(name) = self else { return Ok(rows) };
            return Err(PlanError(format!(
                "preset '{name}' fits no selected kernel: no gate has its name and dimension"
            )));
        }
        Ok(rows)
    }

    fn given(&self) -> &[(String, String)] {
        match self {
            EpsilonChoice::Given(pairs) => pairs,
            _ => &[],
        }
    }
}

/// The preset of a name.
fn find_preset(name: &str) -> Result<&'static Preset, PlanError> {
    PRESETS.iter().find(|preset| preset.name == name).ok_or_else(|| {
        let near = nearest_name(name, PRESETS.iter().map(|preset| preset.name));
        PlanError(format!(
            "unknown epsilon preset '{name}'{}",
            did_you_mean(near, "hairline list presets")
        ))
    })
}

impl From<PresetValue> for EpsilonText {
    fn from(value: PresetValue) -> EpsilonText {
        match value {
            PresetValue::Decimal(text) => EpsilonText::Decimal(text.to_owned()),
            PresetValue::MachineEpsilon(factor) => EpsilonText::MachineEpsilon(factor),
        }
    }
}

/// An epsilon that a gate can take.
fn checked(kernel: &str, gate: &Gate, text: &str) -> Result<EpsilonText, PlanError> {
    let epsilon = EpsilonText::of(text)
        .ok_or_else(|| PlanError(format!("'{text}' is not an epsilon for gate '{}'", gate.name)))?;
    let Some(value) = epsilon.value::<f64>() else {
        let name = gate.name;
        return Err(PlanError(format!(
            "'{text}' is not an epsilon for gate '{name}': expected a finite decimal number or k*EPSILON"
        )));
    };
    match gate.epsilon {
        Tunable::Fixed => {
            Err(PlanError(format!("gate '{}' of {kernel} takes no epsilon", gate.name)))
        }
        Tunable::NonNegative if value < 0.0 => Err(PlanError(format!(
            "gate '{}' of {kernel} refuses where {}: below 0 that is the same as 0, so {text} means nothing",
            gate.name, gate.refuses
        ))),
        _ => Ok(epsilon),
    }
}

fn unknown_gate(name: &str, entries: &[&'static Entry]) -> PlanError {
    let gates = || entries.iter().flat_map(|entry| entry.info.gates).map(|gate| gate.name);
    let near = nearest_name(name, gates());
    PlanError(format!(
        "no selected kernel has a gate '{name}'{}",
        did_you_mean(near, "hairline list kernels")
    ))
}

/// `; did you mean 'x'?` or where to look.
pub(crate) fn did_you_mean(near: Option<&str>, list: &str) -> String {
    match near {
        Some(near) => format!("; did you mean '{near}'?"),
        None => format!("; see `{list}`"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kernel::{KERNELS, find};

    fn rows(names: &[&str], choice: EpsilonChoice) -> Result<Vec<Row>, PlanError> {
        let entries: Vec<_> = names.iter().map(|name| find(name).unwrap()).collect();
        choice.rows(&entries, None)
    }

    fn given(pairs: &[(&str, &str)]) -> EpsilonChoice {
        EpsilonChoice::Given(
            pairs.iter().map(|(g, v)| ((*g).to_owned(), (*v).to_owned())).collect(),
        )
    }

    #[test]
    fn the_default_plan_has_two_rows_where_a_source_gives_no_value() {
        let all: Vec<_> = KERNELS.iter().collect();
        let rows = EpsilonChoice::Source.rows(&all, None).unwrap();
        let of = |name: &str| rows.iter().filter(|row| row.entry.info.name == name).count();
        assert_eq!((of("plane-unit-normal"), of("moller-trumbore")), (2, 1));
    }

    #[test]
    fn epsilons_go_to_the_gates_that_have_them() {
        let rows =
            rows(&["moller-trumbore", "half-space"], given(&[("parallel", "1e-9")])).unwrap();
        assert_eq!(rows[0].epsilons::<f32>(), [1e-9, 0.0]);
        assert_eq!(rows[0].set, "parallel=1e-9");
        assert_eq!(rows[1].set, "source");
    }

    #[test]
    fn bad_epsilons_are_refused_with_a_reason() {
        let message =
            |names: &[&str], pairs: &[(&str, &str)]| rows(names, given(pairs)).err().unwrap().0;
        assert!(
            message(&["moller-trumbore"], &[("paralel", "0")]).contains("did you mean 'parallel'?")
        );
        assert!(message(&["moller-trumbore"], &[("parallel", "-1e-6")]).contains("means nothing"));
        assert!(message(&["moller-trumbore"], &[("edge", "small")]).contains("is not an epsilon"));
        assert!(message(&["moller-trumbore"], &[("edge", "1e309")]).contains("is not an epsilon"));
        assert!(message(&["havel-herout"], &[("u", "0")]).contains("takes no epsilon"));
        assert!(
            message(&["moller-trumbore"], &[("edge", "nan*EPSILON")]).contains("is not an epsilon")
        );
        // A kernel that cannot take a value does not keep the others from taking it.
        let rows = rows(&["havel-herout", "cramer"], given(&[("t", "1e-6")])).unwrap();
        assert_eq!((rows[0].set.as_str(), rows[1].set.as_str()), ("source", "t=1e-6"));
    }

    #[test]
    fn an_epsilon_that_a_scalar_has_not_is_refused_there() {
        let row = |text: &str| rows(&["moller-trumbore"], given(&[("parallel", text)])).unwrap();
        let in_f32 = |text: &str| row(text)[0].check::<f32>().map_err(|error| error.0);
        assert!(in_f32("1e39").unwrap_err().contains("1e39 is beyond the range of f32"));
        assert!(in_f32("1e-60").unwrap_err().contains("1e-60 is 0 in f32"));
        for fine in ["0", "0.0e5", "1e-45", "3e38", "EPSILON"] {
            assert_eq!(in_f32(fine), Ok(()), "{fine}");
        }
        assert_eq!(row("1e-60")[0].check::<f64>(), Ok(()));
        assert!(row("1e-400")[0].check::<f64>().is_err());
    }

    #[test]
    fn presets_go_only_where_the_dimension_is_the_same() {
        let bvh = EpsilonChoice::Preset("bvh".to_owned());
        let taken = rows(&["moller-trumbore", "cramer", "woop-watertight"], bvh).unwrap();
        assert_eq!(taken.len(), 2, "woop's determinant has another dimension");
        assert_eq!(taken[1].epsilons::<f32>(), [f32::EPSILON, f32::EPSILON, 0.0]);
        let bullet = EpsilonChoice::Preset("bullet".to_owned());
        assert!(
            rows(&["moller-trumbore"], bullet).err().unwrap().0.contains("fits no selected kernel")
        );
    }
}
