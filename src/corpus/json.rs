//! JSON objects with known fields, read through `serde_json`, and errors that name the field.

#![forbid(unsafe_code)]

use serde::Deserializer;
use serde::de::{Error, MapAccess, Visitor};
use serde_json::error::Category;
use serde_json::value::RawValue;
use std::fmt;

/// The most characters of an input that a message repeats.
const EXCERPT: usize = 40;

/// The values of an object's fields as they stand in the text, in the order of `known`; none where
/// a field is missing (`null` is a value). Unknown and duplicate fields are errors.
pub(crate) fn fields<'a, const N: usize>(
    text: &'a str,
    known: [&'static str; N],
) -> Result<[Option<&'a RawValue>; N], String> {
    if !text.trim_start().starts_with('{') {
        return Err(format!("expected an object, found {}", excerpt(text.trim_start())));
    }
    let mut reader = serde_json::Deserializer::from_str(text);
    let fields = reader.deserialize_map(Fields(known)).and_then(|f| reader.end().map(|()| f));
    fields.map_err(|error| plain_message(&error))
}

/// The value of a field that must be there.
pub(crate) fn required<'a>(
    field: &str,
    value: Option<&'a RawValue>,
) -> Result<&'a RawValue, String> {
    value.ok_or_else(|| format!("missing field '{field}'"))
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

struct Fields<const N: usize>([&'static str; N]);

impl<'de, const N: usize> Visitor<'de> for Fields<N> {
    type Value = [Option<&'de RawValue>; N];

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("an object")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Self::Value, A::Error> {
        let mut values = [None; N];
        while let Some(name) = map.next_key::<String>()? {
            let Some(place) = self.0.iter().position(|known| *known == name) else {
                let known = self.0.join(", ");
                let name = quoted(&name);
                return Err(A::Error::custom(format!(
                    "unknown field {name}, expected one of {known}"
                )));
            };
            if values[place].replace(map.next_value()?).is_some() {
                return Err(A::Error::custom(format!("duplicate field '{name}'")));
            }
        }
        Ok(values)
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
