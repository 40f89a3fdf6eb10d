//! The kernel of the page: in JavaScript, or whatever JavaScript asks.

use crate::abi;
use hairline::internals::audit::{EpsilonChoice, Row};
use hairline::internals::contract::Contract;
use hairline::internals::kernel::Tunable;
use hairline::{
    Case, Dimension, Entry, EpsilonSet, Failure, Float, Gate, Gives, KernelIn, KernelInfo, Role,
    Scalar, Verdict,
};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::sync::{Mutex, PoisonError};

/// A kernel with its epsilons and the contract that it is judged by.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Chosen {
    /// A kernel of the program, if it is not the page's.
    name: Option<String>,
    /// The page's kernel.
    own: Option<Own>,
    /// As `--epsilon` takes them; the kernel's own if it is not given.
    epsilons: Option<String>,
    /// As `--contract` takes it; the kernel's own if it is not given.
    contract: Option<String>,
}

/// The page's description of its kernel.
#[derive(Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
struct Own {
    /// As `--contract` takes it.
    contract: String,
    /// True if it reports t, and true if u and v.
    gives: [bool; 2],
    /// By name.
    epsilons: BTreeMap<String, String>,
    /// The flag that chooses it on a command line.
    selector: String,
}

impl Chosen {
    /// The one row of it.
    pub fn row(&self) -> Result<Row, String> {
        let mut rows = self.rows(self.epsilons.as_deref())?;
        rows.truncate(1);
        rows.pop()
            .ok_or_else(|| "the kernel has no epsilons".to_owned())
    }

    /// The same at other epsilons.
    pub fn rows(&self, epsilons: Option<&str>) -> Result<Vec<Row>, String> {
        let entry = self.entry()?;
        let choice = match epsilons.filter(|text| !text.is_empty()) {
            Some(text) => EpsilonChoice::parse(text)?,
            None => EpsilonChoice::Source,
        };
        choice
            .rows(&[entry], self.contract.as_deref())
            .map_err(String::from)
    }

    fn entry(&self) -> Result<&'static Entry, String> {
        match (&self.name, &self.own) {
            (Some(name), None) => {
                hairline::find(name).ok_or_else(|| format!("there is no kernel '{name}'"))
            }
            (None, Some(own)) => own.entry(),
            _ => Err("a request names a kernel of the program, or describes the page's".to_owned()),
        }
    }
}

/// The entries so far: each lives as long as the page, so the same words make one entry.
static ENTRIES: Mutex<BTreeMap<String, &'static Entry>> = Mutex::new(BTreeMap::new());

impl Own {
    fn entry(&self) -> Result<&'static Entry, String> {
        let key = serde_json::to_string(self).map_err(|error| error.to_string())?;
        let mut entries = ENTRIES.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(entry) = entries.get(&key) {
            return Ok(entry);
        }
        let contract = Contract::from_words(&self.contract, None)
            .map_err(|error| format!("contract: {error}"))?;
        let leak = |text: &str| -> &'static str { text.to_owned().leak() };
        let gate = |name: &String| Gate {
            name: leak(name),
            role: Role::of_gate(name).unwrap_or(Role::Other),
            refuses: "as the kernel compares it with e",
            printed: None,
            dimension: Dimension::new(0, 0),
            epsilon: Tunable::Signed,
        };
        let gates: Vec<Gate> = self.epsilons.keys().map(gate).collect();
        let values: Vec<&'static str> = self.epsilons.values().map(|value| leak(value)).collect();
        let [t, uv] = self.gives;
        let info: &'static KernelInfo = Box::leak(Box::new(KernelInfo {
            gates: gates.leak(),
            epsilon_sets: vec![EpsilonSet {
                name: "own",
                values: values.leak(),
            }]
            .leak(),
            gives: Gives {
                t,
                uv,
                facing: false,
            },
            ..KernelInfo::own("yours", contract)
        }));
        let entry = Entry::new(info)
            .with_f32(&Page)
            .with_f64(&Page)
            .chosen_by(leak(&self.selector));
        let entry: &'static Entry = Box::leak(Box::new(entry));
        entries.insert(key, entry);
        Ok(entry)
    }
}

/// The kernel that JavaScript has at the time.
struct Page;

impl<F: Scalar> KernelIn<F> for Page {
    fn run(&self, cases: &[Case<F>], epsilons: &[F], verdicts: &mut [Verdict<F>]) {
        let numbers: Vec<[f64; 17]> = cases.iter().map(numbers).collect();
        let epsilons: Vec<f64> = epsilons.iter().map(|epsilon| epsilon.to_f64()).collect();
        let mut answers = vec![[0.0; 4]; cases.len()];
        abi::run(&numbers, &epsilons, &mut answers);
        for (verdict, [what, t, u, v]) in verdicts.iter_mut().zip(answers) {
            let [t, u, v] = [t, u, v].map(F::from_f64);
            *verdict = match what {
                1.0 => Verdict {
                    hit: true,
                    t,
                    u,
                    v,
                    ..Verdict::miss(None)
                },
                2.0 => Verdict::failed(Failure::Panic),
                _ => Verdict::miss(None),
            };
        }
    }

    /// Nobody says that raising an epsilon of the page's kernel only refuses more.
    fn tells_margins(&self) -> bool {
        false
    }
}

/// Origin, direction, a, b, c, t_min, t_max.
pub fn numbers<F: Float>(case: &Case<F>) -> [f64; 17] {
    let mut all = [0.0; 17];
    let wide = case.widen();
    all[..15].copy_from_slice(wide.vectors().as_flattened());
    (all[15], all[16]) = (wide.ray.t_min, wide.ray.t_max);
    all
}
