//! JSON objects with known fields, read through `serde_json`, and errors that name the field.

use serde::Deserializer;
use serde::de::{MapAccess, Visitor};
use serde_json::error::Category;
use serde_json::value::RawValue;
use std::fmt;

/// The most characters of an input that a message repeats.
const EXCERPT: usize = 40;

/// The fields of an object, as they stand in the text.
#[derive(Default)]
pub(crate) struct Object<'a>(Vec<(String, &'a RawValue)>);

impl<'a> Object<'a> {
    /// The fields, whose `known` names stand between blanks. Unknown and duplicate ones are errors.
    pub fn parse(text: &'a str, known: &'static str) -> Result<Object<'a>, String> {
        let fields = pairs(text)?;
        for (i, (name, _)) in fields.iter().enumerate() {
            if !known.split(' ').any(|known| known == name) {
                let (name, known) = (quoted(name), known.replace(' ', ", "));
                return Err(format!("unknown field {name}, expected one of {known}"));
            }
            if fields[..i].iter().any(|(other, _)| other == name) {
                return Err(format!("duplicate field '{name}'"));
            }
        }
        Ok(Object(fields))
    }

    /// The value of a field, if it is there; `null` is a value.
    pub fn get(&self, field: &str) -> Option<&'a RawValue> {
        self.0.iter().find(|(name, _)| name == field).map(|(_, value)| *value)
    }

    /// The value of a field that must be there.
    pub fn required(&self, field: &str) -> Result<&'a RawValue, String> {
        self.get(field).ok_or_else(|| format!("missing field '{field}'"))
    }

    /// What a field says, if it is there. An error names it.
    pub fn read<T>(
        &self,
        field: &str,
        read: impl FnOnce(&'a RawValue) -> Result<T, String>,
    ) -> Result<Option<T>, String> {
        let read = self.get(field).map(read).transpose();
        read.map_err(|message| format!("{field}: {message}"))
    }

    /// The text of a field that must be there.
    pub fn required_string(&self, field: &str) -> Result<String, String> {
        string(self.required(field)?).map_err(|message| format!("{field}: {message}"))
    }

    /// Whether the field `scalar`, which must be there, says `f32`; otherwise it says `f64`.
    pub fn is_f32(&self) -> Result<bool, String> {
        match self.required_string("scalar")?.as_str() {
            "f32" => Ok(true),
            "f64" => Ok(false),
            other => Err(format!("scalar: {} is none of f32, f64", quoted(other))),
        }
    }
}

/// The fields of an object in their order, duplicates included.
pub(crate) fn pairs(text: &str) -> Result<Vec<(String, &RawValue)>, String> {
    if !text.trim_start().starts_with('{') {
        return Err(format!("expected an object, found {}", excerpt(text.trim_start())));
    }
    let mut reader = serde_json::Deserializer::from_str(text);
    let pairs = reader.deserialize_map(Pairs).and_then(|pairs| reader.end().map(|()| pairs));
    pairs.map_err(|error| plain_message(&error))
}

/// An object of fields whose values are JSON already.
pub(crate) fn object<'a>(fields: impl IntoIterator<Item = (&'a str, String)>) -> String {
    let fields = fields.into_iter().map(|(name, json)| format!("\"{name}\":{json}"));
    format!("{{{}}}", fields.collect::<Vec<_>>().join(","))
}

/// A JSON string.
pub(crate) fn string(value: &RawValue) -> Result<String, String> {
    if !value.get().starts_with('"') {
        return Err(format!("expected a string, found {}", excerpt(value.get())));
    }
    serde_json::from_str(value.get()).map_err(|error| plain_message(&error))
}

/// A JSON array of `N` values, which messages call `what`.
pub(crate) fn array<'a, const N: usize>(
    value: &'a RawValue,
    what: &str,
) -> Result<[&'a RawValue; N], String> {
    let elements: Vec<&RawValue> = serde_json::from_str(value.get())
        .map_err(|_| format!("expected an array of {N} {what}, found {}", excerpt(value.get())))?;
    let count = elements.len();
    elements.try_into().map_err(|_| format!("expected {N} {what}, found {count}"))
}

/// The beginning of an input, on one line.
pub(crate) fn excerpt(text: &str) -> String {
    let start: String = text.chars().take(EXCERPT).collect();
    let dots = if start.len() < text.len() { "..." } else { "" };
    let printable: String = start
        .chars()
        .map(|c| match c {
            '\u{feff}' => "\\u{feff}".to_owned(),
            c if c.is_control() => c.escape_default().to_string(),
            c => c.to_string(),
        })
        .collect();
    printable + dots
}

/// [`excerpt`] between apostrophes.
pub(crate) fn quoted(text: &str) -> String {
    format!("'{}'", excerpt(text))
}

struct Pairs;

impl<'de> Visitor<'de> for Pairs {
    type Value = Vec<(String, &'de RawValue)>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("an object")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Self::Value, A::Error> {
        let mut pairs = Vec::new();
        while let Some(pair) = map.next_entry()? {
            pairs.push(pair);
        }
        Ok(pairs)
    }
}

/// `serde_json`'s message without the line, which is always 1, with the column where the text is no
/// JSON at all, and without backticks.
fn plain_message(error: &serde_json::Error) -> String {
    let full = error.to_string();
    let place = format!(" at line {} column {}", error.line(), error.column());
    let message = full.strip_suffix(&place).unwrap_or(&full).replace('`', "'");
    match error.classify() {
        Category::Data => message,
        _ => format!("{message} at column {}", error.column()),
    }
}
