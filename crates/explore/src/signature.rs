//! The signature of a finding: two findings with the same signature are of the same kind.

use super::objective::verdict_and_finding;
use crate::arith::ScalarName;
use crate::audit::{Attribution, Row, attribute_with};
use crate::case::Case;
use crate::judge::{Class, Finding, asked};
use crate::kernel::{ExactRun, Scalar, Verdict};
use crate::truth::Truth;
use std::fmt;

/// The kind of a finding: a reader needs to see only one of the findings with the same signature.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Signature {
    /// The kernel.
    pub kernel: &'static str,
    /// `f32` or `f64`.
    pub scalar: ScalarName,
    /// The epsilons, as `--epsilon` takes them; none if no gate takes one.
    pub epsilons: Option<String>,
    /// The finding.
    pub finding: Finding,
    /// The class of the truth.
    pub class: Class,
    /// The gate that refused; none of a hit.
    pub gate: Option<&'static str>,
    /// The first gate that refuses when the same formula is run without rounding; none if it hits, and
    /// of a kernel that does not show its gates.
    pub exactly: Option<&'static str>,
    /// Why it happened; none if the kernel does not run in exact arithmetic.
    pub attribution: Option<Attribution>,
}

impl Signature {
    /// The signature of a row's finding on a case; none if its verdict is right.
    pub fn of<F: Scalar>(row: &Row, case: &Case<F>) -> Option<Signature> {
        let epsilons: Vec<F> = row.epsilons();
        let seen = verdict_and_finding(row, &epsilons, case);
        Signature::of_seen(row, &epsilons, case, &seen)
    }

    /// The same where the case was judged already.
    pub(super) fn of_seen<F: Scalar>(
        row: &Row,
        epsilons: &[F],
        case: &Case<F>,
        (truth, verdict, finding): &(Truth, Verdict<F>, Option<Finding>),
    ) -> Option<Signature> {
        let finding = (*finding)?;
        let name = |gate: usize| row.entry.info.gates[gate].name;
        let asked = asked(case, truth, &row.contract, false);
        let subject = F::subject(row.entry);
        let exact = subject.and_then(|subject| Some(subject.gated()?.run_exact(case, epsilons)));
        Some(Signature {
            kernel: row.entry.info.name,
            scalar: F::NAME,
            epsilons: row.epsilon_argument(),
            finding,
            class: Class::of(truth),
            gate: verdict.refused_by.map(usize::from).map(name),
            exactly: exact.as_ref().and_then(ExactRun::refused_by).map(name),
            attribution: subject.and_then(|subject| {
                attribute_with(
                    subject,
                    case,
                    epsilons,
                    truth,
                    (&row.contract, asked),
                    || exact,
                )
            }),
        })
    }

    /// True if a row shows this signature on a case. Cheap checks without exact arithmetic exclude most
    /// other cases.
    pub fn is_shown<F: Scalar>(&self, row: &Row, case: &Case<F>) -> bool {
        let epsilons: Vec<F> = row.epsilons();
        let seen = verdict_and_finding(row, &epsilons, case);
        let (truth, verdict, finding) = &seen;
        let gate = verdict
            .refused_by
            .map(|gate| row.entry.info.gates[usize::from(gate)].name);
        (*finding, gate, Class::of(truth)) == (Some(self.finding), self.gate, self.class)
            && Signature::of_seen(row, &epsilons, case, &seen).as_ref() == Some(self)
    }

    /// The kind alone: the same whatever the epsilons are.
    pub fn kind(&self) -> Signature {
        Signature {
            epsilons: None,
            ..self.clone()
        }
    }
}

impl fmt::Display for Signature {
    /// `moller-trumbore (parallel=1e-6,edge=0), f32: false-miss of interior/front/within, refused by
    /// 'parallel', without rounding too (epsilon)`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.kernel)?;
        if let Some(epsilons) = &self.epsilons {
            write!(f, " ({epsilons})")?;
        }
        write!(
            f,
            ", {}: {} of {}",
            self.scalar,
            self.finding.name(),
            self.class.name()
        )?;
        if let Some(gate) = self.gate {
            write!(f, ", refused by '{gate}'")?;
        }
        match self.exactly {
            None if self.gate.is_none() && self.attribution.is_none() => Ok(()),
            same if same == self.gate => f.write_str(", without rounding too"),
            Some(gate) => write!(f, "; without rounding '{gate}' refuses"),
            None => f.write_str("; without rounding a hit"),
        }?;
        self.attribution
            .map_or(Ok(()), |attribution| write!(f, " ({})", attribution.name()))
    }
}
