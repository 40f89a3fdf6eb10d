//! A case from a corpus file, and what stands beside it.

use super::FoundBy;
use super::stored_truth::StoredTruth;
use super::truth_json::TruthLine;
use crate::case::AnyCase;
use crate::files::json;
use crate::oracle;
use crate::printable::is_obeyed;

/// A case from a corpus file, and what stands beside it.
#[derive(Clone, Debug, PartialEq)]
pub struct StoredCase {
    /// The case's name.
    pub name: Option<String>,
    /// The ray and the triangle.
    pub case: AnyCase,
    /// True if the ray starts at a computed hit point on the triangle, as a shadow ray does: a hit there is a
    /// self-hit.
    pub is_secondary: bool,
    /// The truth as the file states it; not compared with anything yet.
    pub truth: Option<StoredTruth>,
    /// Counted from 1.
    pub line: usize,
    /// Why the case is in the file.
    pub why: Option<String>,
    /// Where it comes from.
    pub url: Option<String>,
    /// Which kernel shows what on it, if it was found by a campaign or by `fuzz triage`.
    pub found: Option<FoundBy>,
}

impl StoredCase {
    /// A case with nothing beside it.
    pub fn of(case: impl Into<AnyCase>) -> StoredCase {
        let case = case.into();
        StoredCase {
            name: None,
            case,
            is_secondary: false,
            truth: None,
            line: 0,
            why: None,
            url: None,
            found: None,
        }
    }

    /// Its truth, as the `truth` command prints it: with fractions, or without.
    pub fn truth_line(&self, with_fractions: bool) -> TruthLine {
        let (truth, exact) = either_scalar!(&self.case, case => {
            let truth = oracle::truth(case);
            (truth, with_fractions.then(|| oracle::exact_values(case, &truth)))
        });
        TruthLine::new(self.name.as_deref(), &truth, exact.as_ref())
    }

    /// The same with its truth.
    pub fn with_truth(self) -> StoredCase {
        StoredCase {
            truth: Some(StoredTruth::from(&self.truth_line(true))),
            ..self
        }
    }
}

/// The most bytes of a name: commands repeat it.
const LONGEST_NAME: usize = 1000;

/// An error if `hairline explain` does not take a name, or if it breaks a line of a report.
pub(super) fn check_name(name: String) -> Result<String, String> {
    let wrong = match name.chars().next() {
        None => "it is empty".to_owned(),
        Some('{') => "it begins with '{', as a case that is written as JSON does".to_owned(),
        Some('-') => "it begins with '-', as a flag does".to_owned(),
        _ if name.contains(is_obeyed) => {
            "it has a character that a terminal obeys and does not show".to_owned()
        }
        _ if name.len() > LONGEST_NAME => format!("it has more than {LONGEST_NAME} bytes"),
        _ => return Ok(name),
    };
    Err(format!(
        "{} cannot name a case: {wrong}",
        json::quoted(&name)
    ))
}
