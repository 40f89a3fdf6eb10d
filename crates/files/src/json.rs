//! JSON objects with known fields, read through `serde_json`, and errors that name the field. A value is the
//! text of its JSON, which was checked when its object was read.

use crate::printable::printable;
use crate::suggest::nearest_name;
use serde::de::{MapAccess, Visitor};
use serde::{Deserialize, Deserializer};
use serde_json::error::Category;
use serde_json::value::RawValue;
use std::borrow::Cow;
use std::fmt;

/// The most characters of an input that a message repeats.
const EXCERPT: usize = 40;

/// The fields of an object, as they stand in the text.
#[derive(Default)]
pub struct Object<'a>(Vec<Field<'a>>);

/// A name and its value.
pub type Field<'a> = (Cow<'a, str>, &'a str);

impl<'a> Object<'a> {
    /// The fields. Those that are not `known` and duplicates are errors. `_` stands for all names that begin so.
    pub fn parse(text: &'a str, known: &[&str]) -> Result<Object<'a>, String> {
        let fields = pairs(text)?;
        for (i, (name, _)) in fields.iter().enumerate() {
            let is_note = name.starts_with('_') && known.contains(&"_");
            if !is_note && !known.contains(&name.as_ref()) {
                let near = nearest_name(name, known.iter().copied());
                let near = near
                    .filter(|near| name.len().min(near.len()) > 2)
                    .map(|near| format!(": did you mean '{near}'?"));
                let near =
                    near.unwrap_or_else(|| format!(", expected one of {}", known.join(", ")));
                return Err(format!("unknown field {}{near}", quoted(name)));
            }
            if fields[..i].iter().any(|(other, _)| other == name) {
                return Err(format!("duplicate field '{name}'"));
            }
        }
        Ok(Object(fields))
    }

    /// The value of a field, if it is there; `null` is a value.
    pub fn get(&self, field: &str) -> Option<&'a str> {
        self.0
            .iter()
            .find(|(name, _)| name == field)
            .map(|(_, value)| *value)
    }

    /// The value of a field that must be there.
    pub fn required(&self, field: &str) -> Result<&'a str, String> {
        self.get(field)
            .ok_or_else(|| format!("missing field '{field}'"))
    }

    /// The value of a field, if it is there. An error names the field.
    pub fn read<T>(
        &self,
        field: &str,
        read: impl FnOnce(&'a str) -> Result<T, String>,
    ) -> Result<Option<T>, String> {
        let read = self.get(field).map(read).transpose();
        read.map_err(|message| format!("{field}: {message}"))
    }

    /// The text of a field that must be there.
    pub fn required_string(&self, field: &str) -> Result<String, String> {
        string(self.required(field)?).map_err(|message| format!("{field}: {message}"))
    }

    /// True if the field `scalar`, which must be there, says `f32`; otherwise it says `f64`.
    pub fn is_f32(&self) -> Result<bool, String> {
        match self.required_string("scalar")?.as_str() {
            "f32" => Ok(true),
            "f64" => Ok(false),
            other => Err(format!("scalar: {} is none of f32, f64", quoted(other))),
        }
    }
}

/// A text as JSON, if it is none because of words of other languages: numbers that JSON does not know (`NaN`, `0.2f`,
/// `.5`, `0x3e4ccccd`) and names become strings, and `Vec3(1, 2, 3)` an array.
pub fn tidied(text: &str) -> Cow<'_, str> {
    let is_json = |text| serde_json::from_str::<serde::de::IgnoredAny>(text).is_ok();
    if is_json(text) {
        return Cow::Borrowed(text);
    }
    let (mut out, mut rest) = (String::new(), text);
    while let Some(first) = rest.chars().next() {
        let (token, behind) = rest.split_at(end_of_token(rest));
        match first {
            '(' => out.push('['),
            ')' => out.push(']'),
            // The name of a type or a function that makes a vector.
            c if c.is_alphabetic() && behind.trim_start().starts_with(['(', '{']) => {}
            c if is_of_word(c) && !is_json(token) => out.extend(["\"", token, "\""]),
            _ => out.push_str(token),
        }
        rest = behind;
    }
    // What is wrong with an object is better said of what it was meant to be.
    if is_json(&out) || out.starts_with('{') {
        Cow::Owned(out)
    } else {
        Cow::Borrowed(text)
    }
}

fn is_of_word(c: char) -> bool {
    c.is_ascii_alphanumeric() || "+-.#_<>".contains(c)
}

/// Where a string, a word or another character ends that begins a text. Words are `Vec3::new` and `-nan(ind)` too.
fn end_of_token(text: &str) -> usize {
    let mut chars = text.char_indices().skip(1);
    if text.starts_with('"') {
        let mut is_escaped = false;
        let end = chars.find(|(_, c)| {
            let is_end = *c == '"' && !is_escaped;
            is_escaped = *c == '\\' && !is_escaped;
            is_end
        });
        return end.map_or(text.len(), |(end, _)| end + 1);
    }
    let is_end = |place: usize, c: char| {
        let is_path = c == ':' && (text[place..].starts_with("::") || text[..place].ends_with(':'));
        !is_of_word(c) && !is_path
    };
    if !text.starts_with(is_of_word) {
        return text.chars().next().map_or(0, char::len_utf8);
    }
    let end = chars
        .find(|(place, c)| is_end(*place, *c))
        .map_or(text.len(), |(end, _)| end);
    let is_nan = text[..end]
        .trim_start_matches(['-', '+'])
        .eq_ignore_ascii_case("nan");
    let note = text[end..]
        .find(')')
        .filter(|_| is_nan && text[end..].starts_with('('));
    note.map_or(end, |note| end + note + 1)
}

/// The fields of an object in their order, duplicates included.
pub fn pairs(text: &str) -> Result<Vec<Field<'_>>, String> {
    if !text.trim_start().starts_with('{') {
        return Err(format!(
            "expected an object, found {}",
            excerpt(text.trim_start())
        ));
    }
    let mut reader = serde_json::Deserializer::from_str(text);
    let pairs = reader
        .deserialize_map(Pairs)
        .and_then(|pairs| reader.end().map(|()| pairs));
    pairs.map_err(|error| plain_message(&error))
}

/// An object of fields whose values are JSON already.
pub fn object<'a>(fields: impl IntoIterator<Item = (&'a str, String)>) -> String {
    let fields = fields
        .into_iter()
        .map(|(name, json)| format!("\"{name}\":{json}"));
    format!("{{{}}}", fields.collect::<Vec<_>>().join(","))
}

/// A JSON string.
pub fn string(value: &str) -> Result<String, String> {
    if !value.starts_with('"') {
        return Err(format!("expected a string, found {}", excerpt(value)));
    }
    serde_json::from_str(value).map_err(|error| plain_message(&error))
}

/// A JSON array of `N` values, which messages call `what`.
pub fn array<'a, const N: usize>(value: &'a str, what: &str) -> Result<[&'a str; N], String> {
    let mut array = [""; N];
    let elements = elements(value)
        .ok_or_else(|| format!("expected an array of {N} {what}, found {}", excerpt(value)))?;
    let mut count = 0;
    for element in elements {
        if let Some(place) = array.get_mut(count) {
            *place = element;
        }
        count += 1;
    }
    if count == N {
        Ok(array)
    } else {
        Err(format!("expected {N} {what}, found {count}"))
    }
}

/// The elements of a JSON array; none of another value.
pub fn elements(value: &str) -> Option<impl Iterator<Item = &str>> {
    let inner = value.strip_prefix('[')?.strip_suffix(']')?.trim_ascii();
    let mut rest = (!inner.is_empty()).then_some(inner);
    Some(std::iter::from_fn(move || {
        let text = rest?;
        let end = end_of_first(text);
        let (element, behind) = text.split_at(end);
        rest = behind
            .trim_ascii_start()
            .strip_prefix(',')
            .map(str::trim_ascii_start);
        Some(element.trim_ascii_end())
    }))
}

/// Where the first of several values ends that commas separate. All of them are JSON already, so a number, true,
/// false or null ends at the first comma.
fn end_of_first(values: &str) -> usize {
    if values.starts_with(['"', '[', '{']) {
        let mut values = serde_json::Deserializer::from_str(values).into_iter::<&RawValue>();
        if values.next().is_some_and(|first| first.is_ok()) {
            return values.byte_offset();
        }
    }
    values
        .bytes()
        .position(|byte| byte == b',')
        .unwrap_or(values.len())
}

/// The beginning of an input, on one line.
pub fn excerpt(text: &str) -> String {
    let start: String = text.chars().take(EXCERPT).collect();
    let dots = if start.len() < text.len() { "..." } else { "" };
    printable(&start) + dots
}

/// [`excerpt`] between apostrophes.
pub fn quoted(text: &str) -> String {
    format!("'{}'", excerpt(text))
}

/// A name as it stands in the text, unless it has escapes.
#[derive(Deserialize)]
struct Name<'a>(#[serde(borrow)] Cow<'a, str>);

struct Pairs;

impl<'de> Visitor<'de> for Pairs {
    type Value = Vec<Field<'de>>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("an object")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Self::Value, A::Error> {
        let mut pairs = Vec::new();
        while let Some((Name(name), value)) = map.next_entry::<_, &RawValue>()? {
            pairs.push((name, value.get()));
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_array_is_cut_where_its_elements_end() {
        let nested = r#"[ 1 , "a,\"]," ,[2,[3]],{"b":[4,5]} ,null, -6.5e7 ]"#;
        let expected = [
            "1",
            r#""a,\"],""#,
            "[2,[3]]",
            r#"{"b":[4,5]}"#,
            "null",
            "-6.5e7",
        ];
        assert_eq!(array::<6>(nested, "values"), Ok(expected));
        assert_eq!(array::<0>("[ ]", "values"), Ok([]));
        assert_eq!(
            array::<1>("[1,2]", "numbers"),
            Err("expected 1 numbers, found 2".to_owned())
        );
        let text = Err("expected an array of 2 numbers, found \"[1,2]\"".to_owned());
        assert_eq!(array::<2>(r#""[1,2]""#, "numbers"), text);
        // As serde_json reads them.
        let read: Vec<&RawValue> = serde_json::from_str(nested).unwrap();
        assert!(
            elements(nested)
                .unwrap()
                .eq(read.iter().map(|value| value.get()))
        );
    }

    #[test]
    fn names_are_read_with_their_escapes() {
        let fields = pairs(r#"{"a":1,"\u0062":[2]}"#).unwrap();
        assert_eq!(fields, [("a".into(), "1"), ("b".into(), "[2]")]);
    }
}
