//! The example that a campaign keeps of one kind of finding: a simplified case, as a line of a corpus file.

use crate::audit::{Attribution, Row, RowSpec};
use crate::corpus::FoundBy;
use crate::corpus::lines::{AnyCase, StoredCase};
use crate::signature::Signature;
use crate::simplify::Size;

/// One example of a kind of finding.
#[derive(Clone)]
pub struct Find {
    /// The case.
    pub case: AnyCase,
    /// The kernel with its epsilons and its contract.
    pub row: Row,
    /// The signature of the row's finding on the case.
    pub signature: Signature,
    /// How it was found, as its line says.
    pub found: FoundBy,
}

impl Find {
    /// The finding of a signature that a row shows on a case; it does not say where it comes from.
    pub fn new(case: AnyCase, row: &Row, signature: Signature) -> Find {
        let RowSpec {
            kernel,
            epsilons,
            contract,
            ..
        } = row.spec();
        let found = FoundBy {
            version: env!("CARGO_PKG_VERSION").to_owned(),
            kernel,
            epsilons,
            contract,
            finding: signature.finding.name().to_owned(),
            signature: signature.to_string(),
            seed: None,
            evaluations: None,
            seconds: None,
            from: None,
        };
        Find {
            case,
            row: row.clone(),
            signature,
            found,
        }
    }

    /// A row's finding on a case; none if its verdict is right.
    pub fn of(row: &Row, case: AnyCase) -> Option<Find> {
        row.check_in(case.scalars()).ok()?;
        let signature = either_scalar!(&case, case => Signature::of(row, case))?;
        Some(Find::new(case, row, signature))
    }

    /// The finding that a stored case holds. The case is run again, and must show the stored signature. The error says
    /// why it is not a finding of a campaign.
    pub fn of_stored(stored: &StoredCase) -> Result<Find, String> {
        let found = stored
            .found
            .clone()
            .ok_or("missing field 'found': it is no find")?;
        let wrong = |message: String| format!("found: {message}");
        let row = Row::named(&found.kernel, found.epsilons.as_deref(), &found.contract)
            .map_err(|error| wrong(error.into()))?;
        row.check_in(stored.case.scalars())
            .map_err(|error| wrong(error.into()))?;
        let said = format!("'{}', as hairline {} found", found.signature, found.version);
        let find = Find::of(&row, stored.case)
            .ok_or_else(|| wrong(format!("nothing wrong is shown, not {said}")))?;
        let FoundBy {
            signature: shown,
            finding,
            ..
        } = &find.found;
        if *shown != found.signature {
            return Err(wrong(format!("'{shown}' is shown, not {said}")));
        }
        if *finding != found.finding {
            return Err(wrong(format!(
                "finding: it is a {finding}, not a '{}'",
                found.finding
            )));
        }
        // Epsilons and contract as this program writes them.
        let FoundBy {
            version,
            seed,
            evaluations,
            seconds,
            from,
            ..
        } = found;
        let found = FoundBy {
            version,
            seed,
            evaluations,
            seconds,
            from,
            ..find.found
        };
        Ok(Find { found, ..find })
    }

    /// As a case of a corpus file, its truth included.
    pub fn stored(&self) -> StoredCase {
        let stored = StoredCase::of(self.case).with_truth();
        StoredCase {
            name: Some(self.name()),
            found: Some(self.found.clone()),
            ..stored
        }
    }

    /// `found:kernel/scalar/finding/class/gate/gate without rounding/attribution`: a name for each
    /// kind.
    pub fn name(&self) -> String {
        let Signature {
            kernel,
            scalar,
            finding,
            class,
            gate,
            exactly,
            attribution,
            ..
        } = &self.signature;
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
