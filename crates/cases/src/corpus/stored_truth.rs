//! A truth stored beside a case, and its comparison with the true one.

use super::truth_json::{TruthLine, fraction_text};
use crate::files::json::{self, Object};
use crate::truth::{Facing, Feature, Place};
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::Zero;
use serde_json::Value;

/// The most characters of a fraction. On the whole range of `f64` t has fewer than 4,000.
const LONGEST_FRACTION: usize = 10_000;

const CLASSES: [&str; 5] = [
    "transversal",
    "parallel",
    "coplanar",
    "degenerate",
    "invalid",
];
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

/// A truth as a file has it: the fields that are there, in the order of [`TruthLine`].
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct StoredTruth(Vec<(&'static str, Value)>);

impl StoredTruth {
    /// From the JSON of a truth, with any of its fields.
    pub fn parse(text: &str) -> Result<StoredTruth, String> {
        let fields = read(text, &FIELDS, |field, value| match field {
            "name" => json::string(value).map(Value::from),
            "class" => word(value, &CLASSES),
            "facing" => word(value, &[Facing::Front, Facing::Back].map(Facing::name)),
            "t" => word(value, &Place::ALL.map(Place::name)),
            "feature" => word(value, &Feature::ALL.map(Feature::name)),
            "contact" => contact(value),
            "hits_closed" => boolean(value),
            _ => fraction(value),
        });
        fields.map(StoredTruth)
    }

    /// As a JSON object.
    pub fn to_json(&self) -> String {
        let json = |value: &Value| match value {
            Value::Object(contact) => {
                let fields = CONTACT_FIELDS.into_iter();
                json::object(fields.filter_map(|it| Some((it, contact.get(it)?.to_string()))))
            }
            value => value.to_string(),
        };
        json::object(self.0.iter().map(|(field, value)| (*field, json(value))))
    }

    /// Compares all that is stored, but for the name, with what is true.
    pub fn check(&self, line: &TruthLine) -> Result<(), String> {
        let found = StoredTruth::from(line);
        for (field, stored) in self.0.iter().filter(|(field, _)| *field != "name") {
            let found = found
                .0
                .iter()
                .find(|(other, _)| other == field)
                .map(|(_, value)| value);
            match (stored, found) {
                (Value::Object(stored), Some(Value::Object(found))) => {
                    for field in CONTACT_FIELDS {
                        let path = format!("contact.{field}");
                        stored
                            .get(field)
                            .map_or(Ok(()), |it| same(&path, it, found.get(field)))?;
                    }
                }
                _ => same(field, stored, found)?,
            }
        }
        Ok(())
    }

    /// True if a fraction is stored, so that those of the truth are needed to check it.
    pub fn has_fractions(&self) -> bool {
        self.0
            .iter()
            .any(|(field, value)| field.ends_with("_exact") || value.get("t").is_some())
    }
}

impl From<&TruthLine> for StoredTruth {
    fn from(line: &TruthLine) -> StoredTruth {
        // Strings under names that are strings: nothing that could fail.
        let mut all = serde_json::to_value(line).unwrap_or_default();
        let fields = FIELDS[1..].iter();
        let taken = fields.filter_map(|field| Some((*field, all.get_mut(*field)?.take())));
        StoredTruth(taken.collect())
    }
}

/// The known fields of an object, in their order.
fn read(
    text: &str,
    known: &[&'static str],
    read: impl Fn(&str, &str) -> Result<Value, String>,
) -> Result<Vec<(&'static str, Value)>, String> {
    let object = Object::parse(text, known)?;
    let stored = known.iter().filter_map(|&field| {
        let value = object.read(field, |value| match (value, field) {
            ("null", "class" | "kind") => Err("cannot be null".to_owned()),
            ("null", _) => Ok(Value::Null),
            _ => read(field, value),
        });
        Some(value.transpose()?.map(|value| (field, value)))
    });
    stored.collect()
}

fn contact(text: &str) -> Result<Value, String> {
    let fields = read(text, &CONTACT_FIELDS, |field, value| match field {
        "kind" => word(value, &CONTACT_KINDS),
        "feature" => word(value, &Feature::ALL.map(Feature::name)),
        _ => {
            let [first, last] = json::array(value, "fractions")?;
            Ok(Value::from(vec![fraction(first)?, fraction(last)?]))
        }
    })?;
    Ok(fields
        .into_iter()
        .map(|(field, value)| (field.to_owned(), value))
        .collect())
}

/// An error if a stored value is not the one that was found; a missing one is null.
fn same(path: &str, stored: &Value, found: Option<&Value>) -> Result<(), String> {
    let found = found.unwrap_or(&Value::Null);
    match stored == found {
        true => Ok(()),
        false => Err(format!(
            "stored truth is wrong: {path} is {}, the oracle says {}",
            shown(stored),
            shown(found)
        )),
    }
}

/// As a message has it: a contact by its kind.
fn shown(value: &Value) -> String {
    match value {
        Value::Null => "null".to_owned(),
        Value::String(text) => format!("'{text}'"),
        Value::Array(ends) => {
            let ends: Vec<&str> = ends.iter().filter_map(Value::as_str).collect();
            format!("'[{}]'", ends.join(", "))
        }
        Value::Object(contact) => contact.get("kind").map_or("'some'".to_owned(), shown),
        other => format!("'{other}'"),
    }
}

fn word(value: &str, known: &[&str]) -> Result<Value, String> {
    let text = json::string(value)?;
    if known.contains(&text.as_str()) {
        return Ok(Value::from(text));
    }
    Err(format!(
        "{} is none of {}",
        json::quoted(&text),
        known.join(", ")
    ))
}

fn boolean(value: &str) -> Result<Value, String> {
    let parsed = value.parse().map(Value::Bool);
    parsed.map_err(|_| {
        format!(
            "expected true, false or null, found {}",
            json::excerpt(value)
        )
    })
}

/// `p/q` or an integer, in a string; reduced.
fn fraction(value: &str) -> Result<Value, String> {
    let text = json::string(value)?;
    match parse_fraction(&text) {
        Some(fraction) => Ok(Value::from(fraction_text(&fraction))),
        None => Err(format!(
            "{} is not a fraction p/q with q > 0",
            json::quoted(&text)
        )),
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
mod tests;
