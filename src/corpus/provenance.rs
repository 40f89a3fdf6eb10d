//! The provenance of a finding, stored beside its case: the kernel, the finding, and where it came from.

#![forbid(unsafe_code)]

use super::json;
use serde_json::value::RawValue;
use serde_json::{Value, json as value};

/// The field `found` of a corpus line.
#[derive(Clone, Debug, PartialEq)]
pub struct Provenance {
    /// The version of hairline that found it.
    pub version: String,
    /// The kernel.
    pub kernel: String,
    /// The epsilons, as `--epsilon` takes them; none if no gate takes one.
    pub epsilons: Option<String>,
    /// The contract's name; `own` for the kernel's own.
    pub contract: String,
    /// The finding: `false-miss`.
    pub finding: String,
    /// The signature, as `hairline fuzz shrink` prints it.
    pub signature: String,
    /// The seed of the campaign; none if it comes from elsewhere.
    pub seed: Option<u64>,
    /// The evaluations of the campaign until then.
    pub evaluations: Option<u64>,
    /// The seconds of the campaign until then.
    pub seconds: Option<f64>,
    /// The file that it was found from.
    pub from: Option<String>,
}

impl Provenance {
    /// From the JSON object that [`Provenance::to_json`] writes.
    pub(super) fn parse(text: &str) -> Result<Provenance, String> {
        let names = [
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
        let values = json::fields(text, names)?;
        let named = |field: &str, value| json::string(value).map_err(|m| format!("{field}: {m}"));
        let needed = |i: usize| named(names[i], json::required(names[i], values[i])?);
        let text = |i: usize| values[i].map(|value| named(names[i], value)).transpose();
        let count = |i: usize| values[i].map(|value| number(names[i], value)).transpose();
        Ok(Provenance {
            version: needed(0)?,
            kernel: needed(1)?,
            epsilons: text(2)?,
            contract: needed(3)?,
            finding: needed(4)?,
            signature: needed(5)?,
            seed: count(6)?,
            evaluations: count(7)?,
            seconds: values[8].map(|value| number("seconds", value)).transpose()?,
            from: text(9)?,
        })
    }

    /// As a JSON object, without the fields that are none.
    pub(super) fn to_json(&self) -> String {
        let fields: [(&str, Value); 10] = [
            ("version", value!(self.version)),
            ("kernel", value!(self.kernel)),
            ("epsilons", value!(self.epsilons)),
            ("contract", value!(self.contract)),
            ("finding", value!(self.finding)),
            ("signature", value!(self.signature)),
            ("seed", value!(self.seed)),
            ("evaluations", value!(self.evaluations)),
            ("seconds", value!(self.seconds)),
            ("from", value!(self.from)),
        ];
        let given = fields.iter().filter(|(_, value)| !value.is_null());
        let words: Vec<String> = given.map(|(name, value)| format!("\"{name}\":{value}")).collect();
        format!("{{{}}}", words.join(","))
    }
}

/// A number that is no less than zero.
fn number<T: serde::de::DeserializeOwned + PartialOrd + Default>(
    field: &str,
    value: &RawValue,
) -> Result<T, String> {
    let parsed = serde_json::from_str(value.get()).ok().filter(|n| T::default() <= *n);
    let expected = || format!("{field}: expected a number, found {}", json::excerpt(value.get()));
    parsed.ok_or_else(expected)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_written_is_read_back_and_errors_name_the_field() {
        let full = Provenance {
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
        let bare = Provenance {
            epsilons: None,
            seed: None,
            evaluations: None,
            seconds: None,
            from: None,
            ..full.clone()
        };
        for provenance in [&full, &bare] {
            assert_eq!(Provenance::parse(&provenance.to_json()).as_ref(), Ok(provenance));
        }
        for (old, new, message) in [
            ("\"kernel\":\"cramer\",", "", "missing field 'kernel'"),
            ("\"kernel\":\"cramer\"", "\"kernel\":3", "kernel: expected a string, found 3"),
            ("\"seconds\":1.5", "\"seconds\":-1.5", "seconds: expected a number, found -1.5"),
            ("\"evaluations\":7", "\"evaluations\":\"7\"", "evaluations: expected a number"),
            ("\"version\"", "\"tool\"", "unknown field 'tool', expected one of version, "),
        ] {
            let error = Provenance::parse(&full.to_json().replacen(old, new, 1)).unwrap_err();
            assert!(error.starts_with(message), "{error}");
        }
    }
}
