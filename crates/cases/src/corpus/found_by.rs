//! How a finding was found, stored beside its case: the kernel, the finding, and where it came from.

use crate::files::json::{self, Object};
use serde::Serialize;
use serde::de::DeserializeOwned;

/// The field `found` of a corpus line.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FoundBy {
    /// The version of hairline that found it.
    pub version: String,
    /// The kernel.
    pub kernel: String,
    /// The epsilons, as `--epsilon` takes them; none if no gate takes one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub epsilons: Option<String>,
    /// The contract's name; `own` for the kernel's own.
    pub contract: String,
    /// The finding: `false-miss`.
    pub finding: String,
    /// The signature, as `hairline fuzz shrink` prints it.
    pub signature: String,
    /// The seed of the campaign; none if it comes from elsewhere.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub seed: Option<u64>,
    /// The evaluations of the campaign until then.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub evaluations: Option<u64>,
    /// The seconds of the campaign until then.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub seconds: Option<f64>,
    /// The file that it was found from.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub from: Option<String>,
}

impl FoundBy {
    /// From the JSON object that [`FoundBy::to_json`] writes.
    pub(super) fn parse(text: &str) -> Result<FoundBy, String> {
        let known = [
            "version",
            "kernel",
            "epsilons",
            "contract",
            "finding",
            "signature",
            "seed",
            "evaluations",
            "seconds",
            "from",
        ];
        let object = Object::parse(text, &known)?;
        Ok(FoundBy {
            version: object.required_string("version")?,
            kernel: object.required_string("kernel")?,
            epsilons: object.read("epsilons", json::string)?,
            contract: object.required_string("contract")?,
            finding: object.required_string("finding")?,
            signature: object.required_string("signature")?,
            seed: object.read("seed", number)?,
            evaluations: object.read("evaluations", number)?,
            seconds: object.read("seconds", number)?,
            from: object.read("from", json::string)?,
        })
    }

    /// As a JSON object, without the fields that are none.
    pub(super) fn to_json(&self) -> String {
        // Strings and numbers under names that are strings: nothing that could fail.
        serde_json::to_string(self).unwrap_or_default()
    }
}

/// A number that is no less than zero.
fn number<T: DeserializeOwned + PartialOrd + Default>(value: &str) -> Result<T, String> {
    let parsed = serde_json::from_str(value)
        .ok()
        .filter(|n| T::default() <= *n);
    parsed.ok_or_else(|| format!("expected a number, found {}", json::excerpt(value)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_written_is_read_back_and_errors_name_the_field() {
        let full = FoundBy {
            version: "0.1.0".into(),
            kernel: "cramer".into(),
            epsilons: Some("det=1e-6".into()),
            contract: "own".into(),
            finding: "false-miss".into(),
            signature: "a \"quoted\" one".into(),
            seed: Some(u64::MAX),
            evaluations: Some(7),
            seconds: Some(1.5),
            from: Some("crash-1".into()),
        };
        let bare = FoundBy {
            epsilons: None,
            seed: None,
            evaluations: None,
            seconds: None,
            from: None,
            ..full.clone()
        };
        for provenance in [&full, &bare] {
            assert_eq!(
                FoundBy::parse(&provenance.to_json()).as_ref(),
                Ok(provenance)
            );
        }
        for (old, new, message) in [
            ("\"kernel\":\"cramer\",", "", "missing field 'kernel'"),
            (
                "\"kernel\":\"cramer\"",
                "\"kernel\":3",
                "kernel: expected a string, found 3",
            ),
            (
                "\"seconds\":1.5",
                "\"seconds\":-1.5",
                "seconds: expected a number, found -1.5",
            ),
            (
                "\"evaluations\":7",
                "\"evaluations\":\"7\"",
                "evaluations: expected a number",
            ),
            (
                "\"version\"",
                "\"tool\"",
                "unknown field 'tool', expected one of version, ",
            ),
        ] {
            let error = FoundBy::parse(&full.to_json().replacen(old, new, 1)).unwrap_err();
            assert!(error.starts_with(message), "{error}");
        }
    }
}
