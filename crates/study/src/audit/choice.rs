//! How epsilons are chosen: as sources have them, from a published library, or given.

use super::row::{Row, RowSpec};
use crate::contract::Contract;
use crate::kernel::EpsilonText;
use crate::kernel::{Entry, Gate, KERNELS, PRESETS, Preset, PresetEntry, Tunable, find};
use crate::suggest::{did_you_mean, nearest_name};
use hairline_core::{Error, ErrorKind};
use std::collections::BTreeSet;

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

impl EpsilonChoice {
    /// From `gate=value,...`.
    pub fn parse(text: &str) -> Result<EpsilonChoice, Error> {
        let pairs = text.split(',').map(|pair| {
            let (gate, value) = pair.split_once('=').ok_or_else(|| {
                Error::syntax(format!("'{pair}' is not GATE=VALUE, as parallel=1e-6"))
            })?;
            Ok((gate.trim().to_owned(), value.trim().to_owned()))
        });
        let pairs: Vec<(String, String)> = pairs.collect::<Result<_, Error>>()?;
        Ok(EpsilonChoice::Given(pairs))
    }

    /// An error if a gate is given twice.
    fn check_names(&self) -> Result<(), Error> {
        let mut seen = BTreeSet::new();
        for (gate, _) in self.given() {
            if !seen.insert(gate) {
                let line = format!("gate '{gate}' is given twice");
                return Err(Error::new(ErrorKind::Repeated, line));
            }
        }
        Ok(())
    }

    /// The rows of some kernels under this choice; a contract in words ([`Contract::from_words`])
    /// overrides each kernel's own.
    pub fn rows(
        &self,
        entries: &[&'static Entry],
        contract: Option<&str>,
    ) -> Result<Vec<Row>, Error> {
        self.check_names()?;
        let words = contract.unwrap_or("own");
        let (mut rows, mut left_over) = (Vec::new(), None);
        // Each given epsilon must reach a gate of some kernel.
        let missing = |(name, _): &(String, String)| Err(unknown_gate(name, entries));
        let mut applied: Vec<Result<(), Error>> = self.given().iter().map(missing).collect();
        for entry in entries {
            let contract = Contract::from_words(words, Some(&entry.info.contract))?;
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
                })),
                EpsilonChoice::Preset(name) => {
                    let preset = find_preset(name)?;
                    let mut epsilons = decimals(sets[0].values);
                    if preset.entries.is_empty() {
                        epsilons.fill(EpsilonText::Decimal("0".to_owned()));
                    }
                    let of_gates = match preset.over(entry.info.gates) {
                        Ok(of_gates) => of_gates,
                        Err(entry) => {
                            left_over.get_or_insert(entry);
                            continue;
                        }
                    };
                    let mut taken = Vec::new();
                    let pairs = of_gates.zip(entry.info.gates).zip(&mut epsilons);
                    for ((found, gate), epsilon) in pairs {
                        if let Some(found) = found {
                            *epsilon = EpsilonText::of(found.value).expect("a preset's epsilon");
                            taken.push(gate.name);
                        }
                    }
                    let set = match taken.is_empty() {
                        true => name.clone(),
                        false => format!("{name}: {}", taken.join("+")),
                    };
                    rows.push(Row {
                        entry,
                        set,
                        epsilons,
                        contract,
                    });
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
                    let set = if words.is_empty() {
                        sets[0].name.to_owned()
                    } else {
                        words.join(",")
                    };
                    rows.push(Row {
                        entry,
                        set,
                        epsilons,
                        contract,
                    });
                }
            }
        }
        applied.into_iter().collect::<Result<(), Error>>()?;
        if let (true, EpsilonChoice::Preset(name), Some(left_over)) =
            (rows.is_empty(), self, left_over)
        {
            return Err(unfit(name, left_over, entries));
        }
        Ok(rows)
    }

    /// The epsilons that were given, by gate.
    pub fn given(&self) -> &[(String, String)] {
        match self {
            EpsilonChoice::Given(pairs) => pairs,
            _ => &[],
        }
    }
}

/// The preset of a name.
fn find_preset(name: &str) -> Result<&'static Preset, Error> {
    PRESETS
        .iter()
        .find(|preset| preset.name == name)
        .ok_or_else(|| {
            let names = PRESETS.iter().map(|preset| preset.name);
            let advice = did_you_mean(name, names, "hairline list presets");
            let line = format!("unknown epsilon preset '{name}'{advice}");
            Error::new(ErrorKind::UnknownName, line)
        })
}

/// Why a preset is for none of some kernels: one of its epsilons has no gate there.
fn unfit(name: &str, left_over: &PresetEntry, entries: &[&'static Entry]) -> Error {
    let of = match entries {
        [entry] => entry.info.name.to_owned(),
        _ => "a selected kernel".to_owned(),
    };
    let takes_all = |entry: &&Entry| {
        find_preset(name).is_ok_and(|preset| preset.over(entry.info.gates).is_ok())
    };
    let others: Vec<&str> = KERNELS
        .iter()
        .filter(takes_all)
        .map(|entry| entry.info.name)
        .collect();
    let advice = match others.is_empty() {
        true => String::new(),
        false => format!("; it fits {}", others.join(", ")),
    };
    let (form, gate) = (left_over.form, left_over.gate);
    let line = format!(
        "preset '{name}' refuses where {form}, and no gate of {of} is a '{gate}' of that dimension{advice}"
    );
    Error::new(ErrorKind::Unsupported, line)
}

/// An epsilon that a gate can take.
fn checked(kernel: &str, gate: &Gate, text: &str) -> Result<EpsilonText, Error> {
    let epsilon = EpsilonText::of(text).ok_or_else(|| {
        Error::syntax(format!(
            "'{text}' is not an epsilon for gate '{}'",
            gate.name
        ))
    })?;
    let Some(value) = epsilon.value::<f64>() else {
        let name = gate.name;
        let plain = text.trim_end_matches(|c: char| c.is_ascii_alphabetic());
        let advice = match EpsilonText::of(plain).and_then(|plain| plain.value::<f64>()) {
            Some(_) if plain != text => format!("; write {plain}, without a suffix"),
            _ => String::new(),
        };
        return Err(Error::syntax(format!(
            "'{text}' is not an epsilon for gate '{name}': expected a finite decimal number or k*EPSILON{advice}"
        )));
    };
    match gate.epsilon {
        Tunable::Fixed => {
            let line = format!("gate '{}' of {kernel} takes no epsilon", gate.name);
            Err(Error::new(ErrorKind::Unsupported, line))
        }
        Tunable::NonNegative if value < 0.0 => {
            let line = format!(
                "gate '{}' of {kernel} refuses where {}: below 0 that is the same as 0, so {text} means nothing",
                gate.name, gate.refuses
            );
            Err(Error::new(ErrorKind::OutOfRange, line))
        }
        _ => Ok(epsilon),
    }
}

/// The most gates that an error lists.
const MOST_GATES: usize = 6;

fn unknown_gate(name: &str, entries: &[&'static Entry]) -> Error {
    let mut gates: Vec<&str> = entries
        .iter()
        .flat_map(|entry| entry.info.gates)
        .map(|gate| gate.name)
        .collect();
    gates.sort_unstable();
    gates.dedup();
    let is_t_min = ["t_min", "t-min", "tmin"].contains(&name);
    let advice = if is_t_min {
        "; a least t that your code counts is chosen by `hairline epsilon --scene` (as t_min), and \
         `hairline offset --scheme t-min=VALUE` tries it on shadow rays"
            .to_owned()
    } else if gates.is_empty() {
        ": none of its gates takes an epsilon".to_owned()
    } else if nearest_name(name, gates.iter().copied()).is_none() && gates.len() <= MOST_GATES {
        format!("; there are: {}", gates.join(", "))
    } else {
        did_you_mean(name, gates, "hairline list kernels")
    };
    let line = format!("no selected kernel has a gate '{name}'{advice}");
    Error::new(ErrorKind::UnknownName, line)
}

impl Row {
    /// The row of a kernel, its epsilons as [`Row::epsilon_argument`] writes them (none: as the source
    /// has them), and a contract in the words of [`Contract::from_words`].
    pub fn named(kernel: &str, epsilons: Option<&str>, contract: &str) -> Result<Row, Error> {
        let unknown = || {
            let line = format!(
                "unknown kernel '{kernel}': one of your own is known by its --kernel-lib or --kernel-cmd"
            );
            Error::new(ErrorKind::UnknownName, line)
        };
        let entry = find(kernel).ok_or_else(unknown)?;
        let choice = match epsilons {
            Some(text) => EpsilonChoice::parse(text)?,
            None => EpsilonChoice::Source,
        };
        Ok(choice.rows(&[entry], Some(contract))?.swap_remove(0))
    }
}

impl RowSpec {
    /// The row, if this program has its kernel.
    pub fn row(&self) -> Result<Row, Error> {
        let row = Row::named(&self.kernel, self.epsilons.as_deref(), &self.contract)?;
        Ok(Row {
            set: self.set.clone().unwrap_or(row.set),
            ..row
        })
    }
}

#[cfg(test)]
mod tests;
