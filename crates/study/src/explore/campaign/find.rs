//! The example that a campaign keeps of one kind of finding: a simplified case, as a line of a corpus file.

use crate::audit::{Attribution, Row};
use crate::corpus::FoundBy;
use crate::corpus::lines::{AnyCase, StoredCase};
use crate::explore::{Signature, Size};
use std::fmt;

/// One example of a kind of finding.
#[derive(Clone)]
pub struct Find {
    /// The case.
    pub case: AnyCase,
    /// The kernel with its epsilons and its contract.
    pub row: Row,
    /// The signature of the row's finding on the case.
    pub signature: Signature,
    /// The version of hairline that found it.
    pub version: String,
    /// The seed of the campaign; none if it comes from elsewhere.
    pub seed: Option<u64>,
    /// The evaluations of the campaign until then.
    pub evaluations: Option<u64>,
    /// The seconds of the campaign until then.
    pub seconds: Option<f64>,
    /// The file that it was found from.
    pub from: Option<String>,
}

/// Why a stored case is not a finding of a campaign.
#[derive(Debug, PartialEq)]
pub enum FindError {
    /// It says nothing of a kernel.
    NoProvenance,
    /// Its provenance is impossible, or the row shows something else now.
    Wrong(String),
}

impl fmt::Display for FindError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            FindError::NoProvenance => f.write_str("missing field 'found': it is no find"),
            FindError::Wrong(message) => f.write_str(message),
        }
    }
}

impl Find {
    /// A row's finding on a case; none if its verdict is right.
    pub fn of(row: &Row, case: AnyCase) -> Option<Find> {
        row.check_in(case.scalars()).ok()?;
        let signature = either_scalar!(&case, case => Signature::of(row, case))?;
        Some(Find {
            case,
            row: row.clone(),
            signature,
            version: env!("CARGO_PKG_VERSION").to_owned(),
            seed: None,
            evaluations: None,
            seconds: None,
            from: None,
        })
    }

    /// The finding that a stored case holds. The case is run again, and must show the stored signature.
    pub fn of_stored(stored: &StoredCase) -> Result<Find, FindError> {
        let found = stored.found.as_ref().ok_or(FindError::NoProvenance)?;
        let wrong = |message: String| FindError::Wrong(format!("found: {message}"));
        let row = Row::named(&found.kernel, found.epsilons.as_deref(), &found.contract)
            .map_err(|error| wrong(error.0))?;
        row.check_in(stored.case.scalars()).map_err(|error| wrong(error.0))?;
        let FoundBy { signature, version, .. } = found;
        let said = format!("'{signature}', as hairline {version} found");
        let find = Find::of(&row, stored.case)
            .ok_or_else(|| wrong(format!("nothing wrong is shown, not {said}")))?;
        let (shown, finding) = (find.signature.to_string(), find.signature.finding.name());
        if shown != *signature {
            return Err(wrong(format!("'{shown}' is shown, not {said}")));
        }
        if finding != found.finding {
            return Err(wrong(format!("finding: it is a {finding}, not a '{}'", found.finding)));
        }
        let FoundBy { version, seed, evaluations, seconds, from, .. } = found.clone();
        Ok(Find { version, seed, evaluations, seconds, from, ..find })
    }

    /// As a case of a corpus file, its truth included.
    pub fn stored(&self) -> StoredCase {
        let row = self.row.spec();
        let found = FoundBy {
            version: self.version.clone(),
            kernel: row.kernel,
            epsilons: row.epsilons,
            contract: row.contract,
            finding: self.signature.finding.name().to_owned(),
            signature: self.signature.to_string(),
            seed: self.seed,
            evaluations: self.evaluations,
            seconds: self.seconds,
            from: self.from.clone(),
        };
        let stored = StoredCase::of(self.case).with_truth();
        StoredCase { name: Some(self.name()), found: Some(found), ..stored }
    }

    /// `found:kernel/scalar/finding/class/gate/gate without rounding/attribution`: a name for each
    /// kind.
    pub fn name(&self) -> String {
        let Signature { kernel, scalar, finding, class, gate, exactly, attribution, .. } =
            &self.signature;
        let named = |gate: &Option<&'static str>| gate.unwrap_or("hit");
        let (finding, class) = (finding.name(), class.name().replace('/', "-"));
        let why = attribution.map_or("untold", Attribution::name);
        format!(
            "found:{kernel}/{scalar}/{finding}/{class}/{}/{}/{why}",
            named(gate),
            named(exactly)
        )
    }

    /// How simple the case is.
    pub fn size(&self) -> Size {
        either_scalar!(&self.case, case => Size::of(case))
    }
}
