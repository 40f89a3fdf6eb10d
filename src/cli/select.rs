//! Which kernels, contracts and epsilons a command line names.

use super::exit::Failure;
use super::flags::{JUDGING, RUNNING, again, find_kernel, parsed, refuse_twice};
use super::plugins::PluginArguments;
use crate::arith::Arithmetic;
use crate::audit::{EpsilonChoice, Row};
use crate::contract::Band;
use crate::epsilon::LEAST_T;
use crate::kernel::{self, Entry};
use clap::Args;
use hairline_core::exact;
use serde::{Deserialize, Serialize};

/// The flags that choose kernels, their epsilons and the contract.
#[derive(Args, Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct KernelArguments {
    /// A kernel, or several separated by commas [default: all built-in ones, or only your own if there are
    /// some]
    #[arg(long, short, value_delimiter = ',', value_name = "NAME")]
    kernel: Vec<String>,

    /// The arithmetic in which kernels compute, or several side by side: ieee, fma, ftz, rearranged and more (see
    /// `hairline list arithmetics`); for one kernel alone write its name with +fma
    /// [default: as each kernel's name says]
    #[arg(long, value_delimiter = ',', value_name = "NAME,...", help_heading = RUNNING)]
    #[serde(default)]
    arithmetic: Vec<String>,

    /// Epsilons by gate, as parallel=1e-6,edge=0; other gates keep their source's epsilon
    #[arg(
        long,
        value_name = "GATE=VALUE,...",
        conflicts_with = "epsilon_preset",
        allow_hyphen_values = true,
        help_heading = JUDGING
    )]
    epsilon: Option<String>,

    /// The epsilons of a published library (see `hairline list presets`), or `source`
    #[arg(long, value_name = "NAME", help_heading = JUDGING)]
    epsilon_preset: Option<String>,

    /// One contract for all kernels instead of each kernel's own: a name (see `hairline list contracts`),
    /// or words such as own,coplanar=free or extent=ray,sides=both,boundary=closed
    #[arg(long, value_name = "CONTRACT", help_heading = JUDGING)]
    contract: Option<String>,

    /// Accept both answers nearer than this to the boundary between hits and misses: in longest edges of
    /// the triangle, as 1e-6, or in ulps of its largest coordinate, as 4ulps
    #[arg(long, value_name = "DISTANCE", help_heading = JUDGING)]
    band: Option<String>,

    #[command(flatten)]
    pub(super) plugins: PluginArguments,
}

/// Why a scene takes no band.
const NO_BAND: &str =
    "a scene counts cracks, which a band does not change; a tolerance is what is chosen";

impl KernelArguments {
    /// True if others name the same programs, and nothing else.
    pub fn are_named_by(&self, others: &KernelArguments) -> bool {
        let named = KernelArguments {
            plugins: others.plugins.clone(),
            ..KernelArguments::default()
        };
        named == *others && self.plugins.programs() == others.plugins.programs()
    }

    /// True if every program that these start is one that others name.
    pub fn runs_no_more_than(&self, others: &KernelArguments) -> bool {
        let named = others.plugins.programs();
        self.plugins
            .programs()
            .iter()
            .all(|program| named.contains(program))
    }

    /// Goes on after any number of crashes of a user's kernel, unless the flags set a limit.
    pub fn go_on_after_failures(mut self) -> Self {
        self.plugins.go_on_after_failures();
        self
    }

    /// The rows that the flags choose.
    pub fn rows(&self) -> Result<Vec<Row>, Failure> {
        let band: Option<Band> = parsed("--band", self.band.as_deref())?;
        let entries = self.in_arithmetics(self.entries()?)?;
        let (choice, contract) = (self.choice()?, self.contract.as_deref());
        if self.epsilon_preset.is_some() && self.names_kernels() {
            // Each kernel that is named takes the whole preset.
            entries
                .iter()
                .try_for_each(|entry| choice.rows(&[*entry], contract).map(drop))?;
        }
        let mut rows = choice.rows(&entries, contract)?;
        if band.is_some() {
            rows.iter_mut().for_each(|row| row.contract.band = band);
        }
        Ok(rows)
    }

    /// The test that is right for every ray, to stand beside the built-in kernels where no flag chooses among them.
    pub fn exact_row(&self) -> Result<Option<Row>, Failure> {
        let are_chosen =
            self.names_kernels() || self.chooses_epsilons() || !self.arithmetic.is_empty();
        let are_built_in = kernel::unnamed().iter().all(|entry| entry.is_built_in());
        if are_chosen || !are_built_in {
            return Ok(None);
        }
        let exact = find_kernel(exact::NAME)?;
        let mut rows = self.choice()?.rows(&[exact], self.contract.as_deref())?;
        for row in &mut rows {
            row.contract.band = parsed("--band", self.band.as_deref())?;
        }
        Ok(rows.pop())
    }

    /// The rows for a scene, where `--epsilon` also takes the least t that counts, as t_min=1e-3: its text, if
    /// it is given.
    pub fn rows_and_least_t(&self) -> Result<(Vec<Row>, Option<String>), Failure> {
        let words = self.epsilon.iter().flat_map(|text| text.split(','));
        let least = |word: &&str| word.trim().split('=').next() == Some(LEAST_T);
        let (given, gates): (Vec<&str>, Vec<&str>) = words.partition(least);
        let value = match given[..] {
            [] => return Ok((self.rows_without_band(NO_BAND)?, None)),
            [word] => word
                .split_once('=')
                .map(|(_, value)| value.trim().to_owned()),
            _ => None,
        };
        let wrong = || {
            Failure::usage(format!(
                "--epsilon: write {LEAST_T} once, as {LEAST_T}=1e-3"
            ))
        };
        let value = value.ok_or_else(wrong)?;
        let epsilon = (!gates.is_empty()).then(|| gates.join(","));
        let rows = KernelArguments {
            epsilon,
            ..self.clone()
        }
        .rows_without_band(NO_BAND)?;
        Ok((rows, Some(value)))
    }

    /// True if one contract is given for all kernels.
    pub fn names_contract(&self) -> bool {
        self.contract.is_some()
    }

    /// The rows for a command to which a band means nothing; an error with the reason if there is one.
    pub fn rows_without_band(&self, why: &str) -> Result<Vec<Row>, Failure> {
        let in_words = self
            .contract
            .as_ref()
            .is_some_and(|words| words.contains("band="));
        match self.band.is_some() || in_words {
            true => Err(Failure::usage(format!("--band: {why}"))),
            false => self.rows(),
        }
    }

    /// The flags again, as a shell takes them.
    pub fn flags(&self) -> String {
        let list = |values: &[String]| (!values.is_empty()).then(|| values.join(","));
        let flags = [
            self.plugins.flags(),
            again("--kernel", &list(&self.kernel)),
            again("--arithmetic", &list(&self.arithmetic)),
            again("--epsilon", &self.epsilon),
            again("--epsilon-preset", &self.epsilon_preset),
            again("--contract", &self.contract),
            again("--band", &self.band),
        ];
        flags.concat().join(" ")
    }

    /// True if any kernel is named.
    pub fn names_kernels(&self) -> bool {
        !self.kernel.is_empty() || self.plugins.names_kernels()
    }

    /// True if the flags choose epsilons.
    pub fn chooses_epsilons(&self) -> bool {
        self.epsilon.is_some() || self.epsilon_preset.is_some()
    }

    fn entries(&self) -> Result<Vec<&'static Entry>, Failure> {
        let mut chosen = self.plugins.entries()?;
        if self.kernel.is_empty() && chosen.is_empty() {
            return Ok(kernel::unnamed());
        }
        for name in &self.kernel {
            let entry = find_kernel(name)?;
            if !chosen.iter().any(|other| other.info.name == *name) {
                chosen.push(entry);
            }
        }
        Ok(chosen)
    }

    /// Each kernel in each arithmetic. One that is not written for every arithmetic, and one whose name
    /// says its arithmetic, runs once, as it is.
    fn in_arithmetics(&self, entries: Vec<&'static Entry>) -> Result<Vec<&'static Entry>, Failure> {
        if self.arithmetic.is_empty() {
            return Ok(entries);
        }
        let names = self.arithmetic.iter();
        let arithmetics = names.filter_map(|name| parsed("--arithmetic", Some(name)).transpose());
        let arithmetics = arithmetics.collect::<Result<Vec<_>, _>>()?;
        refuse_twice("--arithmetic", &arithmetics)?;
        let is_other = |arithmetic: &Arithmetic| *arithmetic != Arithmetic::IEEE;
        let has_others =
            |entry: &'static Entry| kernel::in_arithmetic(entry, Arithmetic::FMA).is_some();
        if arithmetics.iter().any(is_other) && !entries.iter().any(|entry| has_others(entry)) {
            let names: Vec<&str> = entries.iter().map(|entry| entry.info.name).collect();
            return Err(Failure::usage(format!(
                "--arithmetic: {} has one arithmetic only: its name says which, or it is not written for every one",
                names.join(", ")
            )));
        }
        let mut all: Vec<&'static Entry> = Vec::new();
        for entry in entries {
            refuse_other_name(entry.info.name, &arithmetics)?;
            let variants = match has_others(entry) {
                true => arithmetics
                    .iter()
                    .filter_map(|a| kernel::in_arithmetic(entry, *a))
                    .collect(),
                false => vec![entry],
            };
            for variant in variants {
                if !all.iter().any(|other| other.info.name == variant.info.name) {
                    all.push(variant);
                }
            }
        }
        Ok(all)
    }

    fn choice(&self) -> Result<EpsilonChoice, Failure> {
        if let Some(preset) = &self.epsilon_preset {
            return Ok(match preset.as_str() {
                "source" => EpsilonChoice::Source,
                name => EpsilonChoice::Preset(name.to_owned()),
            });
        }
        let Some(text) = &self.epsilon else {
            return Ok(EpsilonChoice::Source);
        };
        EpsilonChoice::parse(text).map_err(|error| Failure::usage(format!("--epsilon: {error}")))
    }
}

/// A kernel whose name says an arithmetic that is not among those asked for.
fn refuse_other_name(kernel: &str, asked: &[Arithmetic]) -> Result<(), Failure> {
    let Some((plain, form)) = kernel.split_once('+') else {
        return Ok(());
    };
    match form.parse::<Arithmetic>() {
        Ok(own) if !asked.contains(&own) => Err(Failure::usage(format!(
            "--arithmetic: {kernel} computes in {own} by its name: write {plain} for others, or leave out --arithmetic",
        ))),
        _ => Ok(()),
    }
}
