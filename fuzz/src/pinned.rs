//! One kernel, chosen by the environment, and which of its disagreements end a run.

use crate::disagreement;
use hairline::internals::arith::Float;
use hairline::internals::audit::{EpsilonChoice, Row, exact_severity};
use hairline::internals::explore::Signature;
use hairline::internals::explore::inputs::Input;
use hairline::internals::judge::Finding;
use hairline::internals::kernel::{Entry, Scalar, find};
use std::env;

/// What the environment asks for.
pub struct Pinned {
    kernel: Option<&'static Entry>,
    epsilons: Option<Row>,
    findings: Vec<Finding>,
    beyond: f64,
}

impl Pinned {
    /// - `HAIRLINE_KERNEL`: this kernel instead of the one that an input names;
    /// - `HAIRLINE_EPSILON`: its epsilons, as `--epsilon` takes them, instead of the input's;
    /// - `HAIRLINE_FINDING`: `false-miss,false-hit,bad-value`, some of them: these end the run;
    /// - `HAIRLINE_BEYOND`: only where the line is farther than this from the triangle's boundary, in
    ///   longest edges.
    pub fn from_environment() -> Pinned {
        let variable = |name: &str| env::var(name).ok().filter(|text| !text.is_empty());
        let kernel = variable("HAIRLINE_KERNEL").map(|name| {
            find(&name).unwrap_or_else(|| panic!("HAIRLINE_KERNEL: no kernel '{name}'"))
        });
        let epsilons = variable("HAIRLINE_EPSILON").map(|text| {
            let kernel = kernel.expect("HAIRLINE_EPSILON needs HAIRLINE_KERNEL");
            let pairs = text.split(',').map(|pair| {
                let (gate, value) = pair.split_once('=').expect("HAIRLINE_EPSILON: gate=value");
                (gate.to_owned(), value.to_owned())
            });
            let rows = EpsilonChoice::Given(pairs.collect()).rows(&[kernel], None);
            rows.unwrap_or_else(|error| panic!("HAIRLINE_EPSILON: {error}"))
                .remove(0)
        });
        let finding = |name: &str| {
            let found = Finding::ALL
                .into_iter()
                .find(|finding| finding.name() == name);
            found.unwrap_or_else(|| panic!("HAIRLINE_FINDING: no finding '{name}'"))
        };
        let findings = variable("HAIRLINE_FINDING")
            .map_or(Vec::new(), |text| text.split(',').map(finding).collect());
        let beyond = variable("HAIRLINE_BEYOND")
            .map_or(0.0, |text| text.parse().expect("HAIRLINE_BEYOND: a number"));
        Pinned {
            kernel,
            epsilons,
            findings,
            beyond,
        }
    }

    /// The input with the kernel and the epsilons that were asked for.
    pub fn pin<F: Scalar>(&self, mut input: Input<F>) -> Input<F> {
        if let Some(kernel) = self
            .kernel
            .filter(|kernel| kernel.info.name != input.entry.info.name)
        {
            input = Input::of_source(kernel, input.case);
        }
        if let Some(row) = &self.epsilons {
            input.epsilons = row.epsilons();
        }
        input
    }

    /// The kernel's disagreement, if it is one that ends the run.
    pub fn unwanted<F: Scalar>(&self, input: &Input<F>) -> Result<(), String> {
        let Some(signature) = disagreement(input) else {
            return Ok(());
        };
        if !self.findings.contains(&signature.finding) || !self.is_beyond(input, &signature) {
            return Ok(());
        }
        let row = input.row();
        let epsilons = row
            .epsilon_argument()
            .map_or(String::new(), |e| format!(" --epsilon '{e}'"));
        let line = json(input);
        Err(format!(
            "{signature}\nhairline explain '{line}' --kernel {}{epsilons}",
            signature.kernel
        ))
    }

    fn is_beyond<F: Scalar>(&self, input: &Input<F>, signature: &Signature) -> bool {
        let extent = input.entry.info.contract.extent;
        let severity = exact_severity(&input.case, extent);
        signature.finding == Finding::BadValue
            || severity.is_some_and(|s| self.beyond <= s.in_space)
    }
}

/// The case as `hairline explain` takes it.
fn json<F: Float>(input: &Input<F>) -> String {
    let [origin, direction, a, b, c] = input.case.vectors().map(|v| v.map(number).join(","));
    let [t_min, t_max] = [input.case.ray.t_min, input.case.ray.t_max].map(number);
    format!(
        r#"{{"scalar":"{}","origin":[{origin}],"direction":[{direction}],"a":[{a}],"b":[{b}],"c":[{c}],"t_min":{t_min},"t_max":{t_max}}}"#,
        F::NAME
    )
}

fn number<F: Float>(x: F) -> String {
    if x.is_finite() {
        format!("{x:e}")
    } else {
        format!("\"{x}\"").to_lowercase()
    }
}
