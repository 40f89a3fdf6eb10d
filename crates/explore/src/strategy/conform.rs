//! Judges a user's kernel by a contract, case by case.

use crate::arith::Float;
use crate::case::Case;
use crate::contract::{Across, Contract};
use crate::corpus::lines::{StoredCase, write_case};
use crate::family::{Grouping, around};
use crate::judge::{Finding, GroupTruth, asked, group_obligation, judge, may_be_elsewhere};
use crate::kernel::{Gives, Verdict};
use crate::oracle;
use crate::truth::Truth;
use std::fmt;

/// A wrong answer of a kernel, with all that is needed to see it again.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct WrongAnswer {
    /// `false-miss`, `false-hit`, `bad-value`, `wrong-value`, `crack` or `double`.
    pub finding: &'static str,
    text: String,
}

impl fmt::Display for WrongAnswer {
    /// Several lines.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}\n{}", self.finding, self.text)
    }
}

impl std::error::Error for WrongAnswer {}

/// Checks that a kernel does on a case what a contract demands. The kernel gives t of a hit, which is the only
/// value that is judged.
pub fn conforms<F: Float>(
    kernel: impl Fn(&Case<F>) -> Option<F>,
    contract: &Contract,
    case: &Case<F>,
) -> Result<(), WrongAnswer> {
    let (truth, t) = (oracle::truth(case), kernel(case));
    let asked = asked(case, &truth, contract, false);
    let gives = Gives {
        t: true,
        uv: false,
        facing: false,
    };
    let verdict = verdict(t);
    let found = judge((contract, asked), (case, &truth), gives, &verdict);
    let Some(finding) = found.map(Finding::name) else {
        return Ok(());
    };
    let contract = contract.describe();
    let text = format!("contract {contract}\n{}", describe(case, &truth, t));
    Err(WrongAnswer { finding, text })
}

/// The same of two triangles on one edge and one ray, each alone and both together. If they face the ray
/// alike and the line passes through the inside of their union, [`Across::AtLeastOne`] demands a hit of
/// one of them (or of a triangle around them that the line does not meet: rounding has moved the hit there), and [`Across::ExactlyOne`] that the other does not hit too. A contract with
/// [`Boundary::Free`](crate::contract::Boundary::Free) leaves the edge to the two together.
pub fn conforms_together<F: Float>(
    kernel: impl Fn(&Case<F>) -> Option<F>,
    contract: &Contract,
    cases: &[Case<F>; 2],
) -> Result<(), WrongAnswer> {
    for case in cases {
        conforms(&kernel, contract, case)?;
    }
    let (truths, answers) = (
        cases.each_ref().map(oracle::truth),
        cases.each_ref().map(&kernel),
    );
    let hits = answers.iter().flatten().count();
    let owed = group_obligation(cases, &truths, contract, Grouping::SharedEdge);
    let finding = match (owed, contract.across) {
        (GroupTruth::Crossing, Across::AtLeastOne | Across::ExactlyOne) if hits == 0 => {
            if is_elsewhere(&kernel, contract, cases) {
                return Ok(());
            }
            "crack"
        }
        (GroupTruth::Crossing, Across::ExactlyOne) if hits == 2 => "double",
        _ => return Ok(()),
    };
    let each = |i: usize| describe(&cases[i], &truths[i], answers[i]);
    let contract = contract.describe();
    Err(WrongAnswer {
        finding,
        text: format!("contract {contract}\n{}\n{}", each(0), each(1)),
    })
}

/// True if rounding may have moved the hit that two triangles lack to one of a ring around them, or if there is no ring.
fn is_elsewhere<F: Float>(
    kernel: impl Fn(&Case<F>) -> Option<F>,
    contract: &Contract,
    cases: &[Case<F>; 2],
) -> bool {
    let first = oracle::truth(&cases[0]);
    let Some(crossing) = first.crossing() else {
        return false;
    };
    let Some(ring) = around(cases, Grouping::SharedEdge) else {
        return true;
    };
    let truths: Vec<Truth> = ring.iter().map(oracle::truth).collect();
    let verdicts: Vec<Verdict<F>> = ring.iter().map(|case| verdict(kernel(case))).collect();
    may_be_elsewhere(crossing.facing, &ring, &truths, &verdicts, contract)
}

/// A hit at a t, or a miss.
fn verdict<F: Float>(t: Option<F>) -> Verdict<F> {
    let miss = Verdict::miss(None);
    t.map_or(miss, |t| Verdict {
        hit: true,
        t,
        ..miss
    })
}

fn describe<F: Float>(case: &Case<F>, truth: &Truth, t: Option<F>) -> String {
    let exact = oracle::define(case)
        .exact
        .t
        .map_or(String::new(), |t| format!(", t = {t}"));
    let stored = StoredCase::of(*case);
    let kernel = t.map_or("miss".to_owned(), |t| format!("hit, t = {t:e}"));
    format!(
        "truth    {truth}{exact}\nkernel   {kernel}\nbits     {}\nexplain  hairline explain '{}'",
        case.hex(),
        write_case(&stored)
    )
}
