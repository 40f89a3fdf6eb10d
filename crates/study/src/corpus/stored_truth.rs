//! A truth stored beside a case, and its comparison with the true one.

use super::json::{self, Object};
use super::truth_json::{ContactLine, TruthLine, fraction_text};
use crate::truth::{Facing, Feature, Place};
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::Zero;
use serde_json::json;
use std::fmt;

/// The most characters of a fraction. On the whole range of `f64` t has fewer than 4,000.
const LONGEST_FRACTION: usize = 10_000;

const CLASSES: [&str; 5] = ["transversal", "parallel", "coplanar", "degenerate", "invalid"];
const CONTACT_KINDS: [&str; 3] = ["none", "point", "segment"];

const FIELDS: [&str; 10] = [
    "name",
    "class",
    "facing",
    "t",
    "feature",
    "contact",
    "hits_closed",
    "t_exact",
    "u_exact",
    "v_exact",
];
const CONTACT_FIELDS: [&str; 3] = ["kind", "feature", "t"];

/// The truth beside a case in a corpus file: the fields of [`TruthLine`] (or of its contact), any of them,
/// in their order. Fractions are kept as [`TruthLine`] writes them.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct StoredTruth(Vec<(&'static str, StoredValue)>);

/// The value of a field.
#[derive(Clone, Debug, PartialEq, Eq)]
enum StoredValue {
    Null,
    Text(String),
    Flag(bool),
    Ends([String; 2]),
    Contact(StoredTruth),
}

impl StoredTruth {
    /// From its JSON. Unknown and duplicate fields, words that no truth has and what is no fraction
    /// are errors, which name the field.
    pub fn parse(text: &str) -> Result<StoredTruth, String> {
        StoredTruth::read(text, &FIELDS, |field, value| match field {
            "name" => json::string(value).map(StoredValue::Text),
            "class" => word(value, &CLASSES),
            "facing" => word(value, &[Facing::Front, Facing::Back].map(Facing::name)),
            "t" => word(value, &Place::ALL.map(Place::name)),
            "feature" => word(value, &Feature::ALL.map(Feature::name)),
            "contact" => StoredTruth::parse_contact(value).map(StoredValue::Contact),
            "hits_closed" => boolean(value).map(StoredValue::Flag),
            _ => fraction(value).map(StoredValue::Text),
        })
    }

    fn parse_contact(text: &str) -> Result<StoredTruth, String> {
        StoredTruth::read(text, &CONTACT_FIELDS, |field, value| match field {
            "kind" => word(value, &CONTACT_KINDS),
            "feature" => word(value, &Feature::ALL.map(Feature::name)),
            _ => {
                let [first, last] = json::array(value, "fractions")?;
                Ok(StoredValue::Ends([fraction(first)?, fraction(last)?]))
            }
        })
    }

    fn read(
        text: &str,
        known: &[&'static str],
        read: impl Fn(&str, &str) -> Result<StoredValue, String>,
    ) -> Result<StoredTruth, String> {
        let object = Object::parse(text, known)?;
        let stored = known.iter().filter_map(|&field| {
            let value = object.read(field, |value| match (value, field) {
                ("null", "class" | "kind") => Err("cannot be null".to_owned()),
                ("null", _) => Ok(StoredValue::Null),
                _ => read(field, value),
            });
            Some(value.transpose()?.map(|value| (field, value)))
        });
        stored.collect::<Result<_, _>>().map(StoredTruth)
    }

    fn of_contact(contact: &ContactLine) -> StoredTruth {
        let mut fields = vec![
            ("kind", StoredValue::Text(contact.kind.to_owned())),
            ("feature", StoredValue::word(contact.feature)),
        ];
        let ends = |t: &Option<_>| t.clone().map_or(StoredValue::Null, StoredValue::Ends);
        fields.extend(contact.t.as_ref().map(|t| ("t", ends(t))));
        StoredTruth(fields)
    }

    fn get(&self, field: &str) -> Option<&StoredValue> {
        self.0.iter().find(|(name, _)| *name == field).map(|(_, stored)| stored)
    }

    /// The stored fields, on one line.
    pub fn to_json(&self) -> String {
        let value = |stored: &StoredValue| match stored {
            StoredValue::Null => "null".to_owned(),
            StoredValue::Text(text) => json!(text).to_string(),
            StoredValue::Flag(flag) => flag.to_string(),
            StoredValue::Ends(ends) => json!(ends).to_string(),
            StoredValue::Contact(contact) => contact.to_json(),
        };
        json::object(self.0.iter().map(|(field, stored)| (*field, value(stored))))
    }

    /// Compares each stored field but the name with what the oracle says.
    pub fn check(&self, line: &TruthLine) -> Result<(), String> {
        self.compare("", &StoredTruth::from(line))
    }

    fn compare(&self, path: &str, found: &StoredTruth) -> Result<(), String> {
        for (field, stored) in self.0.iter().filter(|(field, _)| *field != "name") {
            match (stored, found.get(field).unwrap_or(&StoredValue::Null)) {
                (StoredValue::Contact(stored), StoredValue::Contact(found)) => {
                    stored.compare("contact.", found)?;
                }
                (stored, found) if stored != found => {
                    return Err(format!(
                        "stored truth is wrong: {path}{field} is {stored}, the oracle says {found}"
                    ));
                }
                _ => {}
            }
        }
        Ok(())
    }

    /// True if a fraction is stored, or null for one.
    pub fn has_fractions(&self) -> bool {
        let has_t = |stored: &StoredValue| matches!(stored, StoredValue::Contact(c) if c.get("t").is_some());
        self.0.iter().any(|(field, stored)| field.ends_with("_exact") || has_t(stored))
    }
}

impl From<&TruthLine> for StoredTruth {
    /// All fields but the name.
    fn from(line: &TruthLine) -> StoredTruth {
        let contact = line.contact.as_ref().map(StoredTruth::of_contact);
        let mut fields = vec![
            ("class", StoredValue::word(Some(line.class))),
            ("facing", StoredValue::word(line.facing)),
            ("t", StoredValue::word(line.t)),
            ("feature", StoredValue::word(line.feature)),
            ("contact", contact.map_or(StoredValue::Null, StoredValue::Contact)),
            ("hits_closed", line.hits_closed.map_or(StoredValue::Null, StoredValue::Flag)),
        ];
        let fractions =
            [("t_exact", &line.t_exact), ("u_exact", &line.u_exact), ("v_exact", &line.v_exact)];
        for (field, fraction) in fractions {
            let fraction = fraction.as_ref().map(|fraction| StoredValue::word(fraction.as_deref()));
            fields.extend(fraction.map(|fraction| (field, fraction)));
        }
        StoredTruth(fields)
    }
}

impl StoredValue {
    fn word(word: Option<&str>) -> StoredValue {
        word.map_or(StoredValue::Null, |word| StoredValue::Text(word.to_owned()))
    }
}

impl fmt::Display for StoredValue {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            StoredValue::Null => f.write_str("null"),
            StoredValue::Text(text) => write!(f, "'{text}'"),
            StoredValue::Flag(flag) => write!(f, "'{flag}'"),
            StoredValue::Ends([first, last]) => write!(f, "'[{first}, {last}]'"),
            StoredValue::Contact(contact) => match contact.get("kind") {
                Some(kind) => write!(f, "{kind}"),
                None => f.write_str("'some'"),
            },
        }
    }
}

fn word(value: &str, known: &[&str]) -> Result<StoredValue, String> {
    let text = json::string(value)?;
    if known.contains(&text.as_str()) {
        return Ok(StoredValue::Text(text));
    }
    Err(format!("{} is none of {}", json::quoted(&text), known.join(", ")))
}

fn boolean(value: &str) -> Result<bool, String> {
    let parsed = value.parse();
    parsed.map_err(|_| format!("expected true, false or null, found {}", json::excerpt(value)))
}

/// `p/q` or an integer, in a string; reduced.
fn fraction(value: &str) -> Result<String, String> {
    let text = json::string(value)?;
    match parse_fraction(&text) {
        Some(fraction) => Ok(fraction_text(&fraction)),
        None => Err(format!("{} is not a fraction p/q with q > 0", json::quoted(&text))),
    }
}

fn parse_fraction(text: &str) -> Option<BigRational> {
    let (numerator, denominator) = text.split_once('/').unwrap_or((text, "1"));
    let digits = |text: &str| !text.is_empty() && text.bytes().all(|b| b.is_ascii_digit());
    let plain = digits(numerator.strip_prefix('-').unwrap_or(numerator)) && digits(denominator);
    if !plain || text.len() > LONGEST_FRACTION {
        return None;
    }
    let denominator: BigInt = denominator.parse().ok()?;
    let numerator: BigInt = numerator.parse().ok()?;
    (!denominator.is_zero()).then(|| BigRational::new(numerator, denominator))
}

#[cfg(test)]
mod tests {
    use super::super::truth_json::tests::{contact, transversal};
    use super::*;
    use crate::truth::ContactKind;

    #[test]
    fn a_stored_truth_is_the_printed_one_or_part_of_it() {
        for line in [transversal(), contact(ContactKind::Segment), contact(ContactKind::None)] {
            let printed = serde_json::to_string(&line).unwrap();
            let stored = StoredTruth::parse(&printed).unwrap();
            assert_eq!(stored.check(&line), Ok(()));
            assert_eq!(stored.to_json(), printed);
            assert_eq!(stored.0[0].0, "name");
            assert_eq!(stored.0[1..], StoredTruth::from(&line).0);
        }
        for part in ["{}", r#"{"name":"other"}"#, r#"{"v_exact":"3","t_exact":"-15/10"}"#] {
            assert_eq!(StoredTruth::parse(part).unwrap().check(&transversal()), Ok(()), "{part}");
        }
        let part = StoredTruth::parse(r#"{"contact":{"t":["2/6","4"]}}"#).unwrap();
        assert_eq!(part.check(&contact(ContactKind::Segment)), Ok(()));
    }

    #[test]
    fn a_wrong_truth_is_named_with_the_right_one() {
        let segment = contact(ContactKind::Segment);
        let point = contact(ContactKind::Point(Feature::EdgeAb));
        for (stored, line, is, says) in [
            (r#"{"class":"parallel"}"#, transversal(), "class is 'parallel'", "'transversal'"),
            (r#"{"facing":"back"}"#, transversal(), "facing is 'back'", "'front'"),
            (r#"{"t":"at_min"}"#, transversal(), "t is 'at_min'", "'within'"),
            (r#"{"feature":"edge_ab"}"#, transversal(), "feature is 'edge_ab'", "'vertex_a'"),
            (r#"{"feature":null}"#, transversal(), "feature is null", "'vertex_a'"),
            (r#"{"feature":"interior"}"#, point.clone(), "feature is 'interior'", "null"),
            (r#"{"contact":{}}"#, transversal(), "contact is 'some'", "null"),
            (r#"{"contact":{"kind":"none"}}"#, transversal(), "contact is 'none'", "null"),
            (r#"{"contact":null}"#, segment.clone(), "contact is null", "'segment'"),
            (
                r#"{"contact":{"kind":"none"}}"#,
                segment.clone(),
                "contact.kind is 'none'",
                "'segment'",
            ),
            (
                r#"{"contact":{"feature":"vertex_a"}}"#,
                point.clone(),
                "contact.feature is 'vertex_a'",
                "'edge_ab'",
            ),
            (
                r#"{"contact":{"t":["1/3","5"]}}"#,
                point,
                "contact.t is '[1/3, 5/1]'",
                "'[1/3, 4/1]'",
            ),
            (r#"{"contact":{"t":null}}"#, segment, "contact.t is null", "'[1/3, 4/1]'"),
            (r#"{"hits_closed":false}"#, transversal(), "hits_closed is 'false'", "'true'"),
            (r#"{"t_exact":"3/2"}"#, transversal(), "t_exact is '3/2'", "'-3/2'"),
            (r#"{"u_exact":"1"}"#, transversal(), "u_exact is '1/1'", "'0/1'"),
            (r#"{"v_exact":null}"#, transversal(), "v_exact is null", "'3/1'"),
        ] {
            let message = format!("stored truth is wrong: {is}, the oracle says {says}");
            assert_eq!(StoredTruth::parse(stored).unwrap().check(&line), Err(message));
        }
    }

    #[test]
    fn what_no_truth_has_is_refused() {
        for (text, message) in [
            ("[]", "expected an object, found []"),
            (r#"{"class":null}"#, "class: cannot be null"),
            (r#"{"class":"hit"}"#, "class: 'hit' is none of transversal, parallel, "),
            (r#"{"t":"inside"}"#, "t: 'inside' is none of before, at_min, within, at_max, beyond"),
            (r#"{"facing":3}"#, "facing: expected a string, found 3"),
            (r#"{"feature":"edge"}"#, "feature: 'edge' is none of interior, edge_ab, "),
            (r#"{"t_exact":3}"#, "t_exact: expected a string, found 3"),
            (r#"{"u_exact":"1/0"}"#, "u_exact: '1/0' is not a fraction p/q with q > 0"),
            (r#"{"u_exact":"1/-2"}"#, "u_exact: '1/-2' is not a fraction"),
            (r#"{"u_exact":"+1/2"}"#, "u_exact: '+1/2' is not a fraction"),
            (r#"{"u_exact":"0.5"}"#, "u_exact: '0.5' is not a fraction"),
            (r#"{"u_exact":"1_0"}"#, "u_exact: '1_0' is not a fraction"),
            (r#"{"hits_closed":1}"#, "hits_closed: expected true, false or null, found 1"),
            (r#"{"contact":"none"}"#, "contact: expected an object, found \"none\""),
            (r#"{"contact":{"kind":"line"}}"#, "contact: kind: 'line' is none of none, point, "),
            (r#"{"contact":{"t":["1"]}}"#, "contact: t: expected 2 fractions, found 1"),
            (
                r#"{"contact":{"t":"1"}}"#,
                "contact: t: expected an array of 2 fractions, found \"1\"",
            ),
            (
                r#"{"contact":{"u":1}}"#,
                "contact: unknown field 'u', expected one of kind, feature, t",
            ),
            (r#"{"hit":true}"#, "unknown field 'hit', expected one of name, class, facing, t, "),
            (r#"{"t":null,"t":null}"#, "duplicate field 't'"),
        ] {
            let error = StoredTruth::parse(text).unwrap_err();
            assert!(error.starts_with(message), "{text}: {error}");
        }
        let long = format!(r#"{{"u_exact":"{}"}}"#, "1".repeat(LONGEST_FRACTION + 1));
        assert!(StoredTruth::parse(&long).is_err());
    }
}
